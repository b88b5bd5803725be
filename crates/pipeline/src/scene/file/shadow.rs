//! The shadows of a scene file.

use crate::scene::number::Softness;
use serde::Deserialize;

/// Whether a light casts shadows, and what they are like. Suns and spots can; points cast none.
///
/// Masked materials cast the shadow of what is left of them; those that are blended, or let light through, cast none.
#[derive(Clone, Copy, PartialEq, Debug, Deserialize)]
#[serde(rename = "Shadows", deny_unknown_fields)]
pub enum ShadowsFile {
    /// None.
    Off,
    /// By a shadow map: the picture that the light has of the scene.
    On {
        /// The texels of the map's longer side, from 64 to 8192. What is finer than a texel casts no shadow; each takes 12 bytes.
        /// Default: 2048.
        size: Option<u32>,
        /// How large the light looks in the sky, in degrees across, from 0 to 30: what is farther from its shadow casts it with
        /// softer borders, and 0 makes them all sharp. Default: 0.53, as the sun.
        softness_degrees: Option<Softness>,
    },
}

impl ShadowsFile {
    /// Shadows with every default.
    pub const DEFAULT: Self = Self::On { size: None, softness_degrees: None };
}
