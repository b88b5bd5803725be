//! One function under test, as the soak has it.

use crate::random::Random;

/// A name, and one call: `None` if it was refused, else whether the answer is right.
pub type Subject = (&'static str, fn(&mut Random) -> Option<bool>);
