//! A node's transform in the parts that animations move.

use glam::DVec3;
use homog::{Affine, Model as ModelSpace, Vector};

/// Scale, then rotate, then move.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Trs {
    /// The translation.
    pub translation: [f64; 3],
    /// The rotation as a quaternion x, y, z, w.
    pub rotation: [f64; 4],
    /// The factors along the axes.
    pub scale: [f64; 3],
}

impl Trs {
    /// The map they make together; `None` if the quaternion is no rotation or a number is not finite.
    #[must_use]
    pub fn to_affine(&self) -> Option<Affine<ModelSpace, ModelSpace>> {
        let [x, y, z] = self.scale;
        let turn = Affine::<ModelSpace, ModelSpace>::from_quaternion(self.rotation)?;
        let shift = Affine::translation(Vector::from_raw(DVec3::from_array(self.translation)));
        let map = Affine::<ModelSpace, ModelSpace>::scale(x, y, z).then(turn).then(shift);
        map.is_finite().then_some(map)
    }
}

impl Default for Trs {
    fn default() -> Self {
        Self { translation: [0.0; 3], rotation: [0.0, 0.0, 0.0, 1.0], scale: [1.0; 3] }
    }
}
