//! Passes in a scene file: data for each pixel in addition to its color.

use crate::pass::{Pass, PassEncoding};
use crate::schema::scene_struct;

scene_struct! {
    /// The passes that `alberti render` writes next to the picture, as `picture.depth.png` and so
    /// on.
    pub struct PassesFile as "Passes" {
        /// The passes to write. Default: none.
        pub write: Vec<Pass> = Vec::new(),
        /// The file format. Default: `Png`.
        pub encoding: PassEncoding = PassEncoding::Png,
    }
}
