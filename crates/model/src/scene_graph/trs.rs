//! TRS properties: a node's local transform as translation, rotation and scale.

use glam::DVec3;
use homog::{Affine, Model as ModelSpace, Vector};

/// Translation, rotation and scale, applied as M = T · R · S: scale first, then rotate, then
/// translate (glTF 2.0 §3.5.2).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Trs {
    /// Translation along x, y and z.
    pub translation: [f64; 3],
    /// Rotation as a quaternion x, y, z, w, which need not be normalized.
    pub rotation: [f64; 4],
    /// Scale factors along x, y and z.
    pub scale: [f64; 3],
}

impl Trs {
    /// Returns the composed transform, or `None` if the quaternion is zero or the result is not
    /// finite.
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
