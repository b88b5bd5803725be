//! One function under test, as in the soak.

use crate::random::Random;

/// A name and one call: `None` if it was refused, otherwise whether the answer is right.
pub type Subject = (&'static str, fn(&mut Random) -> Option<bool>);
