//! View grid: the front, top and side views in two columns and two rows.
//!
//! ```text
//!   first angle             third angle
//!   ┌───────┬──────┐        ┌───────┬──────┐
//!   │ front │ left │        │  top  │      │
//!   ├───────┼──────┤        ├───────┼──────┤
//!   │  top  │      │        │ front │ right│
//!   └───────┴──────┘        └───────┴──────┘
//! ```

use super::Sheet;
use super::annotation::Extent;
use super::sheet_view::ViewName;
use super::view_layout::{ViewCell, snap_to_grid};
use super::view_plan::PlannedView;
use camera::NamedView;
use glam::DVec2;
use projection::SheetAngle;
use viewport::DrawingScale;

/// The distribution of the free space along an axis.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum GridSpacing {
    /// The space is divided equally among the gaps.
    Equal,
    /// The gaps are 0, and the space follows the views.
    Close,
}

/// The cells of the three views at a scale, with their columns and rows.
#[derive(Clone, Debug)]
pub(super) struct ViewGrid<'a> {
    /// The front, top and side views.
    pub(super) cells: [ViewCell<'a>; 3],
    /// The column and row of each view.
    places: [[usize; 2]; 3],
    /// The space that views need before and after their centers, for each axis and each column or
    /// row.
    spans: [[[f64; 2]; 2]; 2],
}

impl<'a> ViewGrid<'a> {
    /// Creates the grid for a sheet's projection angle.
    ///
    /// First-angle projection places a view opposite the side from which the object is seen, and
    /// third-angle projection places it on that side.
    pub(super) fn new(sheet: &Sheet, principal: &'a [PlannedView; 3], scale: DrawingScale) -> Self {
        let first = sheet.projection_angle == SheetAngle::First;
        // In first-angle projection, the left view is drawn on the right.
        let is_left_view = principal[2].view.name == ViewName::Named(NamedView::Left);
        let side_is_right = first == is_left_view;
        let (front_column, front_row) = (usize::from(!side_is_right), usize::from(!first));
        let places = [
            [front_column, front_row],
            [front_column, 1 - front_row],
            [1 - front_column, front_row],
        ];
        let cells = principal.each_ref().map(|planned| ViewCell::new(planned, sheet, scale));
        let span = |axis: usize, index: usize| {
            let of_index = cells.iter().zip(places).filter(|(_, place)| place[axis] == index);
            of_index.fold([0.0_f64; 2], |[before, after], (cell, _)| {
                [before.max(-cell.extent[0][axis]), after.max(cell.extent[1][axis])]
            })
        };
        let spans = [0, 1].map(|axis| [span(axis, 0), span(axis, 1)]);
        Self { cells, places, spans }
    }

    /// Returns the width and height of the grid with all annotations, in millimeters.
    pub(super) fn total_size(&self) -> DVec2 {
        DVec2::from(self.spans.map(|spans| spans.as_flattened().iter().sum()))
    }

    /// Returns the centers of the three views in an area, or `None` if the grid is larger than the
    /// area.
    pub(super) fn place_views(
        &self,
        [low, high]: Extent,
        spacing: [GridSpacing; 2],
    ) -> Option<[DVec2; 3]> {
        let rest = high - low - self.total_size();
        if rest.min_element() < 0.0 {
            return None;
        }
        let middles = [0, 1].map(|axis| {
            let gap = match spacing[axis] {
                GridSpacing::Equal => rest[axis] / 3.0,
                GridSpacing::Close => 0.0,
            };
            let [[before, after], [next_before, _]] = self.spans[axis];
            let first = low[axis] + gap + before;
            [first, first + after + gap + next_before]
        });
        let center = |[column, row]: [usize; 2]| DVec2::new(middles[0][column], middles[1][row]);
        Some(self.places.map(|place| snap_to_grid(center(place))))
    }
}
