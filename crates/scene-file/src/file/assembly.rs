//! Assemblies on sheets in a scene file: exploded views and densities.

use crate::number::{NonNegative, Positive};
use crate::schema::scene_struct;
use sheet::ExplosionAxis;

scene_struct! {
    /// An exploded view: the parts are moved apart, and their paths are drawn.
    pub struct ExplodedFile as "Exploded" {
        /// The direction in which parts move. Default: the axis along which the most parts line up
        /// with the largest part; in a tie, the axis along which they move least.
        pub axis: ExplosionAxis = ExplosionAxis::Auto,
        /// The minimum distance between two parts in this direction, in scene units. Default: 0.08
        /// times the assembly's diagonal.
        pub distance: Option<NonNegative> = None,
    }
}

scene_struct! {
    /// The density of a material or part.
    pub struct DensityFile as "Density" {
        /// The name of a material or part, as in the parts list; "*" for all others.
        pub of: String,
        /// The density in grams per cubic centimeter, such as 7.85 for steel.
        pub density: Positive,
    }
}
