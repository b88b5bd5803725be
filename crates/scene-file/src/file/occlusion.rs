//! The ambient occlusion of a scene file.

use crate::number::Positive;
use crate::schema::scene_struct;

scene_struct! {
    /// Screen-space ambient occlusion: corners and crevices get less ambient light. Only surfaces
    /// visible in the picture occlude them. Like the models' occlusion textures, it affects only
    /// ambient light and the environment.
    #[derive(Copy)]
    pub struct AmbientOcclusionFile as "AmbientOcclusion" {
        /// The distance up to which surfaces occlude, in world units. Default: a twelfth of the
        /// diagonal of the box around the models.
        pub radius: Option<Positive> = None,
    }
}
