//! The ground of a scene file.

use crate::number::Finite;
use crate::schema::scene_enum;

scene_enum! {
    /// The ground below the models.
    #[derive(Copy)]
    pub enum GroundFile as "Ground" {
        /// A shadow catcher: a horizontal plane that shows only the shadows on it, as under
        /// products in a catalog. In a transparent picture, its alpha is the fraction of light that
        /// the shadows block. It is invisible from below. If the scene does not set `shadows`, they
        /// are `On()`. An environment and ambient light leave a soft shadow around objects on it,
        /// unless `shadows` are `Off`.
        Shadow {
            /// Its y coordinate in world space. Default: the height of the models' lowest vertex.
            height: Option<Finite>,
            /// Whether a view that frames the models also frames their shadows; otherwise shadows
            /// may extend beyond the picture. Default: true.
            framed: bool = true,
        },
    }
}

impl GroundFile {
    /// The ground with all defaults.
    pub const DEFAULT: Self = Self::Shadow { height: None, framed: true };
}
