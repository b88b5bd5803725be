//! The ambient occlusion of a scene file.

use crate::number::Positive;
use crate::schema::scene_struct;

scene_struct! {
    /// Screen-space ambient occlusion: corners and crevices get less ambient light, as far as the
    /// picture shows what occludes it. Like the occlusion textures of models it changes ambient
    /// light and the environment, and no other lights.
    #[derive(Copy)]
    pub struct AmbientOcclusionFile as "AmbientOcclusion" {
        /// The distance up to which surfaces occlude, in the units of the world. Default: a twelfth
        /// of the diagonal of the box around the models.
        pub radius: Option<Positive> = None,
    }
}
