//! The introduction of an explanation: the contents of the page, and their units.

use super::{Explanation, ItemValue};

/// The introduction to the stages from the world to the screen.
const PIPELINE: &str = "\
The steps follow the viewing pipeline: model, camera, projection, clipping, divide by w, \
viewport. Each step shows its matrices and the resulting coordinates of the subject. Lengths in world \
and view space are in scene units (meters in glTF), clip space and NDC have no unit, and screen \
coordinates are in pixels. Matrices multiply column vectors, so products are read from right to left.";

/// The introduction to points under a single matrix.
const BARE_MAP: &str = "\
One matrix multiplies homogeneous points (x, y, z, w), written as columns, and each image is \
divided by its w at the end. There is no camera and no picture: all numbers, including depth z, \
are in the units of the points.";

/// The introduction to the classification of a matrix.
const MATRIX: &str = "\
Sixteen numbers are read as a matrix for column vectors and compared with the projections of \
textbooks and graphics APIs. Windows and planes are in the units of view space; near and far are \
distances ahead of the eye.";

/// The introduction to the classification of a 3×3 matrix.
const PLANAR_MATRIX: &str = "\
Nine numbers are read as a matrix for column vectors (x, y, w) and compared with maps of the \
plane, camera intrinsics and rotations of space.";

impl Explanation {
    /// Introduces the page in a few sentences: its contents and their units.
    ///
    /// `None` for subjects that need neither, such as a node that is not shown.
    #[must_use]
    pub fn introduction(&self) -> Option<&'static str> {
        let has_step = |id: &str| self.steps.iter().any(|step| step.id == id);
        let is_planar = |value: &ItemValue| matches!(value, ItemValue::PlanarMatrix(_));
        let matrix = match self.steps.iter().flat_map(|step| &step.items).next() {
            Some(item) if is_planar(&item.value) => PLANAR_MATRIX,
            _ => MATRIX,
        };
        [("camera", PIPELINE), ("map", BARE_MAP), ("readings", matrix)]
            .into_iter()
            .find_map(|(id, words)| has_step(id).then_some(words))
    }
}
