//! The ground of a scene file.

use crate::scene::number::Finite;
use serde::Deserialize;

/// What is below the models.
#[derive(Clone, Copy, PartialEq, Debug, Deserialize)]
#[serde(rename = "Ground", deny_unknown_fields)]
pub enum GroundFile {
    /// A level plane that is not seen itself but for the shadows on it, as under products in a catalogue. In a transparent picture
    /// its alpha is the share of light that the shadows take from it. It is not seen from below. If the scene says nothing of
    /// `shadows`, they are `On()`.
    Shadow {
        /// Its height, y in the world. Default: that of the lowest vertex of the models.
        height: Option<Finite>,
    },
}

impl GroundFile {
    /// The ground with every default.
    pub const DEFAULT: Self = Self::Shadow { height: None };
}
