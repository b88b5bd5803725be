//! Assemblies on sheets in a scene file: exploded views, densities.

use crate::number::{NonNegative, Positive};
use crate::schema::scene_struct;
use sheet::ExplosionAxis;

scene_struct! {
    /// An exploded view: parts moved apart, with their paths.
    pub struct ExplodedFile as "Exploded" {
        /// The direction in which parts move. Default: the axis on which most parts are in line with
        /// the largest one, or on which they move least.
        pub axis: ExplosionAxis = ExplosionAxis::Auto,
        /// The least distance of two parts along it, in units of the scene. Default: 0.08 of the
        /// diagonal of the assembly.
        pub distance: Option<NonNegative> = None,
    }
}

scene_struct! {
    /// The density of a material or of a part.
    pub struct DensityFile as "Density" {
        /// The name of a material or of a part, as in the parts list; "*" for all others.
        pub of: String,
        /// Grams in a cubic centimeter, such as 7.85 for steel.
        pub density: Positive,
    }
}
