//! Two sentences at the start of an explanation: the content of the page, and its units.

use super::{Explanation, ItemValue};

/// The introduction to the stages from the world to the screen.
const PIPELINE: &str = "\
Each step prints its matrices and where it takes the subject, in the order of the viewing \
pipeline: model, camera, projection, clipping, divide by w, viewport. Lengths of the world and of \
view space are in units of the scene (meters in glTF), clip space and NDC have no unit, the screen \
is in pixels; matrices stand before column vectors, so products are read from right to left.";

/// The introduction to points under a single matrix.
const BARE_MAP: &str = "\
One matrix stands before homogeneous points (x, y, z, w), written as columns, and each image is \
divided by its own w at the end. There is no camera and no picture: numbers are in the units of \
the points, depth z included.";

/// The introduction to the classification of a matrix.
const MATRIX: &str = "\
Sixteen numbers are read as a matrix that stands before column vectors, and compared with the \
projections of the textbooks and graphics interfaces. Windows and planes are in the units of view \
space; near and far are distances ahead of the eye.";

/// The introduction to the classification of a 3×3 matrix.
const PLANAR_MATRIX: &str = "\
Nine numbers are read as a matrix that stands before column vectors (x, y, w) of the plane, and \
compared with maps of the plane, camera intrinsics and rotations of space.";

impl Explanation {
    /// Two sentences for the reader of the page: what it shows, and in which units.
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
