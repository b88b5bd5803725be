//! The instances of a model in a scene file.

use super::ModelFile;
use crate::number::{Finite, NonNegative, Scale, Triple};
use crate::schema::{scene_enum, scene_struct};

scene_enum! {
    /// Instances of a model. The model is first scaled and rotated by its own fields. Each instance
    /// is then moved to its position, and finally all are moved together by the model's
    /// `translation`. A scene has at most 100,000 instances.
    pub enum InstancesFile as "Instances" {
        /// In rows, columns and layers. The first instance is at the model's position, and the
        /// others are offset from it.
        Grid {
            /// The instance counts along x, y and z, each at least 1.
            count: (u32, u32, u32),
            /// The distances between neighbors along x, y and z, in world units.
            step: Triple,
        },
        /// On a circle around the model's position.
        Circle {
            /// The number of instances, at least 1.
            count: u32,
            /// The radius in world units.
            radius: NonNegative,
            /// The axis of the circle, perpendicular to its plane. Its length does not matter, but
            /// must not be 0. Default: y, a horizontal circle.
            axis: Triple = Triple::Y_AXIS,
            /// The position of the first instance in degrees, counterclockwise around the axis: 0
            /// is toward x, or toward y if the axis is x. Default: 0.
            start_degrees: Finite = Finite::ZERO,
            /// The angle over which the instances are spread. On a full circle, the last instance
            /// is one step before the first; otherwise it is at the end of the angle. Default: 360.
            sweep_degrees: Finite = FULL_CIRCLE,
            /// Whether each instance rotates with its position, so that the same side of every
            /// instance faces the center. Default: true.
            rotate_copies: bool = true,
        },
        /// Each with a separate transform.
        List(Vec<InstanceFile>),
    }
}
/// 360 degrees.
const FULL_CIRCLE: Finite = Finite::constant(360.0);

scene_struct! {
    /// An instance and its transform: scale, then rotation, then translation.
    #[derive(Copy)]
    pub struct InstanceFile as "Instance" {
        /// The translation in world units. Default: (0, 0, 0).
        pub translation: Triple = Triple::ZERO,
        /// Rotations about the x, then the y, then the z axis, in degrees. Default: (0, 0, 0).
        pub rotation_degrees: Triple = Triple::ZERO,
        /// One scale factor for all axes, or one for each; none may be 0. Default: 1.
        pub scale: Scale = Scale::ONE,
    }
}

impl ModelFile {
    /// Returns the number of instances of the model, at most `usize::MAX`.
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
