//! Every projection builder against the formulas of its topic.

use crate::Runner;

/// One per file.
pub const RUNNERS: &[(&str, Runner)] = &[];
