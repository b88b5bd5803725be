//! The instances of a model in a scene file.

use super::ModelFile;
use crate::number::{Finite, NonNegative, Scale, Triple};
use crate::schema::{scene_enum, scene_struct};

scene_enum! {
    /// Instances of a model. The model is scaled and rotated first, as its own fields say; then
    /// each instance is moved to its position; then all of them are moved together by the model's
    /// `translation`. A scene has 100,000 instances at most.
    pub enum InstancesFile as "Instances" {
        /// In rows, columns and layers: the first instance where the model is, the others beside
        /// it.
        Grid {
            /// The counts along x, y and z, each at least 1.
            count: (u32, u32, u32),
            /// The distances between neighbors along x, y and z, in the world's units.
            step: Triple,
        },
        /// On a circle around where the model is.
        Circle {
            /// The count, at least 1.
            count: u32,
            /// The radius in the world's units.
            radius: NonNegative,
            /// The axis of the circle, which is perpendicular to it; its length does not matter,
            /// but is not 0. Default: y, a level circle.
            axis: Triple = Triple::Y_AXIS,
            /// The position of the first instance in degrees, counter-clockwise around the axis: 0
            /// is towards x; about the axis x, towards y. Default: 0.
            start_degrees: Finite = Finite::ZERO,
            /// The angle that the instances divide: of a full circle the last is one step before
            /// the first, else it is at the end. Default: 360.
            sweep_degrees: Finite = FULL_CIRCLE,
            /// Whether each instance is rotated with its position, so that all show the same side
            /// to the center. Default: true.
            rotate_copies: bool = true,
        },
        /// Each with a transform of its own.
        List(Vec<InstanceFile>),
    }
}
/// 360 degrees.
const FULL_CIRCLE: Finite = Finite::constant(360.0);

scene_struct! {
    /// An instance: scaled, then rotated, then translated.
    #[derive(Copy)]
    pub struct InstanceFile as "Instance" {
        /// The translation in the world's units. Default: (0, 0, 0).
        pub translation: Triple = Triple::ZERO,
        /// Rotations about the x, then the y, then the z axis, in degrees. Default: (0, 0, 0).
        pub rotation_degrees: Triple = Triple::ZERO,
        /// One factor for all axes, or one for each; none of them 0. Default: 1.
        pub scale: Scale = Scale::ONE,
    }
}

impl ModelFile {
    /// The number of instances of the model, at most `usize::MAX`.
    #[must_use]
    pub fn instance_count(&self) -> usize {
        match &self.instances {
            None => 1,
            Some(InstancesFile::Grid { count: (x, y, z), .. }) => {
                let sides = [x, y, z].map(|&side| side as usize);
                sides.iter().fold(1, |product: usize, &side| product.saturating_mul(side))
            }
            Some(InstancesFile::Circle { count, .. }) => *count as usize,
            Some(InstancesFile::List(list)) => list.len(),
        }
    }
}
