//! Resolution of the views of a drawing sheet.

use super::Origin;
use super::sheet_scale::resolve_scale;
use glam::DVec2;
use homog::{Point, Vector, World};
use scene_file::PathStep::{self, Field, Index};
use scene_file::SceneError;
use scene_file::file::{AxisFile, Finite, SheetFile, SheetViewFile, Triple, ViewSideFile};
use sheet::{SheetError, ViewPlace, ViewRequest, ViewSide};

/// Resolves the views that a sheet requests.
///
/// # Errors
/// Returns an error that points into the file if a scale contains a 0.
pub(super) fn resolve_sheet_views(
    origin: &Origin,
    file: &SheetFile,
) -> Result<Vec<ViewRequest>, SceneError> {
    let numbered = file.views.iter().enumerate();
    numbered.map(|(index, view)| resolve_view(origin, index, view)).collect()
}

/// Resolves one view in the list.
fn resolve_view(
    origin: &Origin,
    index: usize,
    view: &SheetViewFile,
) -> Result<ViewRequest, SceneError> {
    let place =
        |at: &Option<(Finite, Finite)>, scale: Option<(u32, u32)>, caption: &Option<String>| {
            let path = [Field("sheet"), Field("views"), Index(index), Field("scale")];
            Ok::<ViewPlace, SceneError>(ViewPlace {
                at: at.map(|(x, y)| DVec2::new(x.value(), y.value())),
                scale: scale.map(|scale| resolve_scale(origin, scale, &path)).transpose()?,
                caption: caption.clone(),
            })
        };
    let point = |triple: &Triple| -> Point<World> { Point::from(triple.0) };
    let direction = |triple: &Triple| -> Vector<World> { Vector::from(triple.0) };
    Ok(match view {
        SheetViewFile::View { from, at, scale, caption } => {
            ViewRequest::Named { view: *from, place: place(at, *scale, caption)? }
        }
        SheetViewFile::Detail { of, center, radius, scale, at, caption } => ViewRequest::Detail {
            of: *of,
            center: point(center),
            radius: radius.value(),
            place: place(at, *scale, caption)?,
        },
        SheetViewFile::Stepped { normal, corners, at, scale, caption } => ViewRequest::Stepped {
            removed: direction(normal),
            corners: corners.iter().map(point).collect(),
            place: place(at, *scale, caption)?,
        },
        SheetViewFile::Auxiliary { normal, at, scale, caption } => {
            ViewRequest::Auxiliary { facing: direction(normal), place: place(at, *scale, caption)? }
        }
        SheetViewFile::HalfSection { of, point: center, side } => {
            let side = match side {
                ViewSideFile::Left => ViewSide::Left,
                ViewSideFile::Right => ViewSide::Right,
                ViewSideFile::Top => ViewSide::Top,
                ViewSideFile::Bottom => ViewSide::Bottom,
            };
            ViewRequest::HalfSection { of: *of, point: center.as_ref().map(point), side }
        }
        SheetViewFile::LocalSection { of, center, radius } => {
            ViewRequest::LocalSection { of: *of, center: point(center), radius: radius.value() }
        }
        SheetViewFile::Broken { of, axis, from, to } => {
            let axis = match axis {
                AxisFile::X => 0,
                AxisFile::Y => 1,
                AxisFile::Z => 2,
            };
            ViewRequest::Broken { of: *of, axis, from: from.value(), to: to.value() }
        }
    })
}

/// Converts an error in the views of a sheet to an error that points into the file; returns `None`
/// for other errors.
#[must_use]
pub fn sheet_view_error(origin: &Origin, error: &SheetError) -> Option<SceneError> {
    let (number, path, message) = match error {
        SheetError::Request { number, view, reason } => {
            (number, None, format!("the {view}: {reason}"))
        }
        SheetError::Outside { number, view, x, y } => {
            let message = format!(
                "the {view} extends beyond the frame: its center must be {:.0} to {:.0} mm from \
                 the left and {:.0} to {:.0} mm from the top",
                x[0], x[1], y[0], y[1]
            );
            (number, Some(Field("at")), message)
        }
        _ => return None,
    };
    let view = [Field("sheet"), Field("views"), Index(number.saturating_sub(1))];
    let path: Vec<PathStep<'_>> = view.into_iter().chain(path).collect();
    Some(origin.error_at(&path, message, None))
}
