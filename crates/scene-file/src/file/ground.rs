//! The ground of a scene file.

use crate::number::Finite;
use crate::schema::scene_enum;

scene_enum! {
    /// The ground below the models.
    #[derive(Copy)]
    pub enum GroundFile as "Ground" {
        /// A shadow catcher: a level plane that only shows the shadows on it, as under products in
        /// a catalog. In a transparent picture its alpha is the fraction of light that the shadows
        /// take from it. It is not visible from below. If the scene has no `shadows`, they are
        /// `On()`. An environment and ambient light leave a soft shadow around what stands on it,
        /// unless `shadows` are `Off`.
        Shadow {
            /// Its height, y in the world. Default: that of the lowest vertex of the models.
            height: Option<Finite>,
            /// Whether a view that frames the models frames their shadows too. Default: true;
            /// otherwise shadows may leave the picture.
            framed: bool = true,
        },
    }
}

impl GroundFile {
    /// The ground with every default.
    pub const DEFAULT: Self = Self::Shadow { height: None, framed: true };
}
