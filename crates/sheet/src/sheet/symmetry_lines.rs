//! Lines of symmetry: planes of symmetry of the models, seen from the side (ISO 128-2, chain lines
//! 04.1).

use super::Sheet;
use super::view_mark::ViewMark;
use super::view_plan::PlannedView;
use hidden_line::FeaturePicker;

impl Sheet {
    /// Adds the lines of symmetry to views along a plane of symmetry where they are vertical or
    /// horizontal.
    pub(super) fn add_symmetry_lines(
        &self,
        planned: &mut [&mut PlannedView],
        picker: &FeaturePicker<'_>,
    ) {
        let mut symmetry = picker.mirror_symmetry();
        for PlannedView { view, marks, .. } in planned.iter_mut().map(|planned| &mut **planned) {
            let camera = &view.camera;
            // A vertical line belongs to a plane perpendicular to the direction to the right.
            for (axis, across) in [(1, camera.right()), (0, camera.v())] {
                let mut lines = marks.iter().filter_map(ViewMark::as_center_line);
                if lines.any(|(_, known)| known == axis) {
                    continue;
                }
                if let Some(point) = symmetry.plane_across(across) {
                    marks.push(ViewMark::CenterLine { through: view.image_of(point), axis });
                }
            }
        }
    }
}
