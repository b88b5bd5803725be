//! The ambient occlusion of a scene file.

use crate::scene::number::Positive;
use serde::Deserialize;

/// Less light from all around in corners and below things, as far as the picture shows what is in the way. It changes what ambient
/// light and the environment give, as the occlusion textures of models do, and not what lights with a place or a direction give.
#[derive(Clone, Copy, PartialEq, Debug, Deserialize)]
#[serde(rename = "AmbientOcclusion", deny_unknown_fields)]
pub struct AmbientOcclusionFile {
    /// How far away things still count, in the units of the world. Default: a twelfth of the diagonal of the box around the models.
    pub radius: Option<Positive>,
}
