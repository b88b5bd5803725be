//! The shadows of a scene file.

use crate::number::Softness;
use crate::schema::scene_enum;

scene_enum! {
    /// Whether a light casts shadows, and how soft they are. Directional, point and spot lights
    /// can.
    ///
    /// Masked materials cast the shadow of their opaque parts; blended and transmissive ones cast
    /// none.
    #[derive(Copy)]
    pub enum ShadowsFile as "Shadows" {
        /// None.
        Off,
        /// By a shadow map: a depth image of the scene from the light.
        On {
            /// The texels of the map's longer side, from 64 to 8192. Details finer than a texel
            /// cast no shadow; each takes 12 bytes. A point light has six maps, each with so many
            /// texels for 90°; all point lights together have 67 million at most, and smaller maps
            /// beyond that. Default: 2048.
            size: Option<u32>,
            /// The angle that the light subtends, in degrees, from 0 to 30: shadows get softer with
            /// the distance from what casts them, and 0 makes them all sharp. Default: 0.53, as the
            /// sun.
            softness_degrees: Option<Softness>,
        },
    }
}

impl ShadowsFile {
    /// Shadows with every default.
    pub const DEFAULT: Self = Self::On { size: None, softness_degrees: None };
}
