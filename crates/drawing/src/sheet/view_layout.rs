//! View layout: the positions of views on a sheet, and the scale at which they fit.
//!
//! ```text
//!         column 0     column 1
//!       ┌───────────┬───────────┐
//!  row 0│   front   │   side    │
//!       ├───────────┼───────────┤
//!  row 1│    top    │   (axo)   │
//!       └───────────┴───────────┘
//! ```
//!
//! The front view and the side view share a row, the front view and the top view a column. Gaps are
//! equal. The axonometric view goes to the free corner, at a smaller scale if it must.
//!
//! Two areas are tried: the whole drawing area, where the title block may happen to lie under no
//! view, and the area above the title block. The larger scale wins.

use super::sheet_view::SheetView;
use super::{Sheet, SheetError, rectangle_from_size};
use camera::NamedView;
use glam::DVec2;
use projection::SheetAngle;
use viewport::{DrawingScale, Rectangle};

/// The least distance between two views, and to the frame, in millimeters.
const VIEW_GAP: f64 = 10.0;

/// The margin for a dimension line and its text beside a view, in heights of letters.
const DIMENSION_MARGIN: f64 = 4.0;

/// A view with its position and scale.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlacedView<'a> {
    pub(super) view: &'a SheetView,
    /// The center of the view on the sheet, in millimeters.
    pub(super) center: DVec2,
    pub(super) scale: DrawingScale,
}

/// All views with their positions.
#[derive(Debug)]
pub(super) struct ViewLayout<'a> {
    /// The scale of the sheet.
    pub(super) scale: DrawingScale,
    /// Front, top and side view, and the axonometric one if there is one.
    pub(super) views: Vec<PlacedView<'a>>,
    /// Whether the top view is below the front view: first-angle projection.
    pub(super) is_top_below: bool,
}

impl<'a> ViewLayout<'a> {
    /// Arranges the views at the sheet's scale, or at the largest standard scale that fits.
    ///
    /// Views must stay clear of title block and scale bar. Where the axonometric view finds no free
    /// corner, it is left out.
    ///
    /// # Errors
    /// [`SheetError::TooLarge`] if they do not fit; it names a scale that would, if there is one.
    pub(super) fn arrange_views(
        sheet: &Sheet,
        principal: [&'a SheetView; 3],
        axonometric: Option<&'a SheetView>,
    ) -> Result<Self, SheetError> {
        let grid = ViewGrid::new(sheet, principal);
        let area = sheet.drawing_area();
        let block = sheet.title_block_area();
        let height = area.height() - block.height();
        let above_block = rectangle_from_size(area.x(), area.y(), area.width(), height);
        let candidates = [area, above_block].into_iter().filter_map(|area| {
            let scale = match sheet.scale {
                Some(scale) => grid.fits_at_scale(scale, area).then_some(scale)?,
                None => grid.largest_fitting_scale(area)?,
            };
            let placed = grid.place_views(scale, area);
            let keeps_off = |placed: &PlacedView<'_>| {
                placed.keeps_distance(block, VIEW_GAP * 0.5)
                    && placed.keeps_distance(sheet.scale_bar_area(), 1.5)
            };
            placed.iter().all(keeps_off).then_some((scale, placed, area))
        });
        // At equal scales the first area is larger.
        let best = candidates.reduce(|a, b| if b.0.ratio() > a.0.ratio() { b } else { a });
        let (scale, mut placed, area) = best.ok_or_else(|| {
            let any = Sheet { scale: None, ..sheet.clone() };
            let fitting = sheet.scale.and_then(|_| Self::arrange_views(&any, principal, None).ok());
            grid.too_large_error(sheet, above_block, fitting.map(|fitting| fitting.scale))
        })?;
        let corner = free_corner_area(&placed, area, block);
        placed.extend(axonometric.and_then(|view| place_in_corner(view, corner?, scale)));
        Ok(Self { scale, views: placed, is_top_below: grid.is_top_below })
    }

    /// The area that the object takes in a view on the sheet.
    pub(super) fn view_area(&self, name: NamedView) -> Option<Rectangle> {
        self.views.iter().find(|placed| placed.view.name == name).map(PlacedView::object_area)
    }
}

impl PlacedView<'_> {
    /// The area that the object takes on the sheet.
    pub(super) fn object_area(&self) -> Rectangle {
        let size = self.view.size * self.scale.ratio();
        let corner = self.center - size * 0.5;
        rectangle_from_size(corner.x, corner.y, size.x, size.y)
    }

    /// Whether the view is at least this far from a rectangle, in x or in y.
    fn keeps_distance(&self, other: Rectangle, distance: f64) -> bool {
        let half = self.view.size * self.scale.ratio() * 0.5 + DVec2::splat(distance);
        let between = (self.center - DVec2::from(other.center())).abs();
        between.x >= half.x + other.width() * 0.5 || between.y >= half.y + other.height() * 0.5
    }
}

/// The free corner of the grid, beside the top view and opposite the side view, without the title
/// block; `None` if too small.
///
/// ```text
///   ┌───────┬──────┐        ┌───────┬──────┐
///   │ front │ side │        │  top  │ ████ │      █ the free corner: first angle, third angle
///   ├───────┼──────┤        ├───────┼──────┤
///   │  top  │ ████ │        │ front │ side │
///   └───────┴──────┘        └───────┴──────┘
/// ```
fn free_corner_area(
    placed: &[PlacedView<'_>],
    area: Rectangle,
    block: Rectangle,
) -> Option<Rectangle> {
    let [top, side] = [placed.get(1)?.object_area(), placed.get(2)?.object_area()];
    let ends = |low: f64, size: f64| [low, low + size];
    let beside = |taken: [f64; 2], whole: [f64; 2], is_after: bool| {
        if is_after {
            [taken[1] + VIEW_GAP, whole[1] - VIEW_GAP]
        } else {
            [whole[0] + VIEW_GAP, taken[0] - VIEW_GAP]
        }
    };
    let across = ends(area.x(), area.width());
    let along = ends(area.y(), area.height());
    let is_right = side.x() > top.x();
    let is_below = top.y() > side.y();
    let x = beside(ends(top.x(), top.width()), across, is_right);
    let mut y = beside(ends(side.y(), side.height()), along, is_below);
    if is_below && x[1] > block.x() {
        y[1] = y[1].min(block.y() - VIEW_GAP);
    }
    let size = [x[1] - x[0], y[1] - y[0]];
    size.iter()
        .all(|side| *side > VIEW_GAP)
        .then(|| rectangle_from_size(x[0], y[0], size[0], size[1]))
}

/// The view centered in a corner, at the largest standard scale that fits and is at most `most`.
fn place_in_corner(
    view: &SheetView,
    corner: Rectangle,
    most: DrawingScale,
) -> Option<PlacedView<'_>> {
    let available = [corner.width(), corner.height()];
    let fits = |scale: DrawingScale| {
        (0..2).all(|axis| scale.to_paper_length(view.size[axis]) <= available[axis])
    };
    let scale = if fits(most) {
        most
    } else {
        DrawingScale::largest_standard(view.size.to_array(), available)?
    };
    Some(PlacedView { view, center: corner.center().into(), scale })
}

/// The grid of the three principal views: two columns and two rows, in millimeters of the object.
struct ViewGrid<'a> {
    /// Each view with its column and row.
    views: [(&'a SheetView, [usize; 2]); 3],
    columns: [f64; 2],
    rows: [f64; 2],
    /// The margin for dimensions, which does not grow with the scale: left of the columns, and
    /// above or below the rows.
    dimension_margin: f64,
    is_top_below: bool,
}

impl<'a> ViewGrid<'a> {
    /// The grid of a sheet's projection angle.
    ///
    /// In first-angle projection a view stands opposite to the side from which it is seen, in
    /// third-angle projection on that side.
    fn new(sheet: &Sheet, [front, top, side]: [&'a SheetView; 3]) -> Self {
        let first = sheet.projection_angle == SheetAngle::First;
        // First angle: the view from the left is drawn on the right.
        let side_is_right = first == (side.name == NamedView::Left);
        let (front_column, front_row) = (usize::from(!side_is_right), usize::from(!first));
        let views = [
            (front, [front_column, front_row]),
            (top, [front_column, 1 - front_row]),
            (side, [1 - front_column, front_row]),
        ];
        let largest = |axis: usize, index: usize| {
            let sizes = views.iter().filter(|(_, cell)| cell[axis] == index);
            sizes.map(|(view, _)| view.size[axis]).fold(0.0, f64::max)
        };
        Self {
            columns: [largest(0, 0), largest(0, 1)],
            rows: [largest(1, 0), largest(1, 1)],
            views,
            dimension_margin: if sheet.dimensions {
                DIMENSION_MARGIN * sheet.lettering_height()
            } else {
                0.0
            },
            is_top_below: first,
        }
    }

    /// The size of an area without gaps and dimensions.
    fn available_size(&self, area: Rectangle) -> [f64; 2] {
        [area.width(), area.height()].map(|side| side - self.dimension_margin - 3.0 * VIEW_GAP)
    }

    /// The size of all columns and rows, in millimeters of the object.
    fn total_size(&self) -> [f64; 2] {
        [self.columns[0] + self.columns[1], self.rows[0] + self.rows[1]]
    }

    /// Whether the grid fits an area at a scale.
    fn fits_at_scale(&self, scale: DrawingScale, area: Rectangle) -> bool {
        let [width, height] = self.available_size(area);
        let [x, y] = self.total_size().map(|size| scale.to_paper_length(size));
        x <= width && y <= height
    }

    /// The largest standard scale at which the grid fits.
    fn largest_fitting_scale(&self, area: Rectangle) -> Option<DrawingScale> {
        DrawingScale::largest_standard(self.total_size(), self.available_size(area))
    }

    /// The views with their centers on the sheet; what is left of the area is divided equally among
    /// the gaps.
    fn place_views(&self, scale: DrawingScale, area: Rectangle) -> Vec<PlacedView<'a>> {
        let [width, height] = self.available_size(area);
        let [x, y] = self.total_size().map(|size| scale.to_paper_length(size));
        let gaps = [(width - x) / 3.0 + VIEW_GAP, (height - y) / 3.0 + VIEW_GAP];
        let middles = |sizes: [f64; 2], start: f64, gap: f64| {
            let [first, second] = sizes.map(|size| scale.to_paper_length(size));
            [start + gap + first * 0.5, start + 2.0 * gap + first + second * 0.5]
        };
        let above = if self.is_top_below { self.dimension_margin } else { 0.0 };
        let columns = middles(self.columns, area.x() + self.dimension_margin, gaps[0]);
        let rows = middles(self.rows, area.y() + above, gaps[1]);
        let center = |[column, row]: [usize; 2]| DVec2::new(columns[column], rows[row]);
        let placed =
            |&(view, cell): &(&'a SheetView, _)| PlacedView { view, center: center(cell), scale };
        self.views.iter().map(placed).collect()
    }

    /// The error with needed and available size, and a remedy.
    fn too_large_error(
        &self,
        sheet: &Sheet,
        area: Rectangle,
        fitting: Option<DrawingScale>,
    ) -> SheetError {
        let smallest = DrawingScale::STANDARD[DrawingScale::STANDARD.len() - 1];
        let scale = sheet.scale.unwrap_or(smallest);
        let remedy = match fitting {
            Some(fitting) => format!("; {fitting} fits"),
            None => "; use larger paper, or set the unit of the model".to_owned(),
        };
        let need = self.total_size().map(|size| scale.to_paper_length(size));
        let available = self.available_size(area).map(|side| side.max(0.0));
        SheetError::TooLarge { paper: sheet.paper_name.clone(), scale, need, available, remedy }
    }
}
