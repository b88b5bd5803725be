//! Passes in a scene file: what is written of each pixel besides its color.

use crate::pass::{Pass, PassEncoding};
use crate::schema::scene_struct;

scene_struct! {
    /// The passes that `alberti render` writes beside the picture, as `picture.depth.png` and the
    /// like.
    pub struct PassesFile as "Passes" {
        /// Which ones. Default: none.
        pub write: Vec<Pass> = Vec::new(),
        /// The file format. Default: `Png`.
        pub encoding: PassEncoding = PassEncoding::Png,
    }
}
