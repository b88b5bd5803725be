//! Lines of symmetry: symmetry planes of the models, seen edge-on (ISO 128-2, chain lines 04.1).

use super::Sheet;
use super::view_mark::ViewMark;
use super::view_plan::PlannedView;
use hidden_line::FeaturePicker;

impl Sheet {
    /// Adds lines of symmetry to the views that see a symmetry plane edge-on, as a vertical or
    /// horizontal line.
    pub(super) fn add_symmetry_lines(
        &self,
        planned: &mut [&mut PlannedView],
        picker: &FeaturePicker<'_>,
    ) {
        let mut symmetry = picker.mirror_symmetry();
        for PlannedView { view, marks, .. } in planned.iter_mut().map(|planned| &mut **planned) {
            let camera = &view.camera;
            // The symmetry plane of a vertical line is perpendicular to the camera's right vector.
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
