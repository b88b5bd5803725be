//! The shadows of a scene file.

use crate::number::Softness;
use crate::schema::scene_enum;

scene_enum! {
    /// Whether a light casts shadows, and how soft they are. Only directional, point and spot
    /// lights can cast them.
    ///
    /// Masked materials cast shadows of their opaque parts; blended and transmissive materials cast
    /// none.
    #[derive(Copy)]
    pub enum ShadowsFile as "Shadows" {
        /// No shadows.
        Off,
        /// From a shadow map: a depth image of the scene as seen from the light.
        On {
            /// The number of texels along the map's longer side, from 64 to 8192. Details finer
            /// than a texel cast no shadow. Each texel takes 12 bytes. A point light has six such
            /// maps, each covering 90°. All point lights together have at most 67 million texels;
            /// beyond that, their maps shrink. Default: 2048.
            size: Option<u32>,
            /// The angle that the light subtends, in degrees from 0 to 30. Shadow edges get softer
            /// with distance from the object that casts them; 0 makes all edges hard. Default:
            /// 0.53, like the sun.
            softness_degrees: Option<Softness>,
        },
    }
}

impl ShadowsFile {
    /// Shadows with all defaults.
    pub const DEFAULT: Self = Self::On { size: None, softness_degrees: None };
}
