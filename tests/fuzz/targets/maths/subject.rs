//! One function under test, as in the soak test.

use crate::random::Random;

/// A name and one call, which returns `None` if it was rejected, otherwise whether the result is
/// correct.
pub type Subject = (&'static str, fn(&mut Random) -> Option<bool>);
