//! View layout: the positions of views on a sheet, and the scale at which they fit.
//!
//! ```text
//!         column 0     column 1
//!       ┌───────────┬───────────┐
//!  row 0│   front   │   side    │      each cell holds a view with its dimensions, cut lines and
//!       ├───────────┼───────────┤      captions, so that views do not touch each other
//!  row 1│    top    │  (free)   │
//!       └───────────┴───────────┘
//! ```
//!
//! The front and side views share a row, and the front and top views share a column. The
//! axonometric view and the section views have no fixed position. Each of them is placed in the
//! best free rectangle, at a smaller scale if necessary.
//!
//! Several arrangements of the grid are tried at each scale. Some have equal gaps, on the whole
//! drawing area or above the title block. Others put the views close together to leave more room
//! beside them. The largest scale at which all views fit wins.

use super::annotation::{Extent, ViewAnnotations, overlap};
use super::free_area::{best_rectangle, free_rectangles};
use super::paper_choice::scales_of;
use super::requested_layout::{arrange_requested, requested_fault};
use super::view_grid::{GridSpacing, ViewGrid};
use super::view_plan::{PlannedView, ViewPlan};
use super::{Sheet, SheetError, scale_bar};
use crate::SheetWarning;
use glam::DVec2;
use viewport::{DrawingScale, Rectangle};

/// The distance from a cell to the frame, and half the distance between objects, in millimeters.
pub(super) const HALF_GAP: f64 = 5.0;

/// The distance from a cell to the frame, in millimeters, if [`HALF_GAP`] would force a smaller
/// scale.
const TIGHT_GAP: f64 = 0.5;

/// The minimum distance from the annotations of a view to its cell's border, in millimeters.
const ANNOTATION_GAP: f64 = 1.5;

/// The minimum scale of a view without a fixed position, as a fraction of the sheet's scale. Below
/// this, a smaller sheet scale is tried, which may leave more room.
const LEAST_FREE_SCALE: f64 = 0.2;

/// The number of smaller sheet scales to try if some views do not fit.
const SMALLER_SCALES: usize = 2;

/// The minimum length of the longer side of a view, in millimeters. Smaller views are omitted
/// unless they are at the sheet's scale.
pub(super) const LEAST_VIEW_SIZE: f64 = 8.0;

/// A view with its position and scale.
#[derive(Clone, Debug)]
pub(super) struct PlacedView<'a> {
    pub(super) planned: &'a PlannedView,
    /// The center of the view on the sheet, in millimeters, rounded to the micrometer grid.
    pub(super) center: DVec2,
    pub(super) scale: DrawingScale,
    pub(super) annotations: ViewAnnotations,
}

impl PlacedView<'_> {
    /// Returns the width and height of the object in the view, in millimeters.
    pub(super) fn object_size(&self) -> DVec2 {
        self.planned.view.size * self.scale.ratio()
    }

    /// Returns the rectangle around the view and its annotations on the sheet.
    pub(super) fn extent(&self) -> Extent {
        let half = self.object_size() * 0.5;
        self.annotations.extent_with([-half, half]).map(|corner| self.center + corner)
    }
}

/// All views with their positions.
#[derive(Clone, Debug)]
pub(super) struct ViewLayout<'a> {
    /// The scale of the sheet.
    pub(super) scale: DrawingScale,
    /// The front, top and side views, followed by the views without a fixed position.
    pub(super) views: Vec<PlacedView<'a>>,
    /// The views that could not be placed.
    pub(super) left_out: Vec<&'a PlannedView>,
    /// The area of the scale bar.
    pub(super) scale_bar: Rectangle,
    /// Warnings about views that overlap others at their requested positions.
    pub(super) overlaps: Vec<SheetWarning>,
}

/// A view with its annotations at a scale, and the space that it needs around its center.
#[derive(Clone, Debug)]
pub(super) struct ViewCell<'a> {
    pub(super) planned: &'a PlannedView,
    pub(super) scale: DrawingScale,
    pub(super) annotations: ViewAnnotations,
    pub(super) extent: Extent,
}

impl<'a> ViewCell<'a> {
    /// Creates the cell of a view at a scale.
    pub(super) fn new(planned: &'a PlannedView, sheet: &Sheet, scale: DrawingScale) -> Self {
        Self::with_annotations(planned, scale, planned.annotate(sheet, scale))
    }

    /// Creates the cell of a view with the given annotations.
    pub(super) fn with_annotations(
        planned: &'a PlannedView,
        scale: DrawingScale,
        annotations: ViewAnnotations,
    ) -> Self {
        let half = planned.view.size * scale.ratio() * 0.5;
        let [low, high] = annotations.extent_with([-half, half]);
        let extent = [
            (low - ANNOTATION_GAP).min(-half - HALF_GAP),
            (high + ANNOTATION_GAP).max(half + HALF_GAP),
        ];
        Self { planned, scale, annotations, extent }
    }

    /// Returns the rectangle that the cell occupies if its view has this center.
    pub(super) fn extent_at(&self, center: DVec2) -> Extent {
        self.extent.map(|corner| center + corner)
    }

    /// Returns the view placed at a center.
    pub(super) fn place(self, center: DVec2) -> PlacedView<'a> {
        let Self { planned, scale, annotations, .. } = self;
        PlacedView { planned, center, scale, annotations }
    }
}

impl<'a> ViewLayout<'a> {
    /// Arranges the views at the sheet's scale, or at the largest standard scale that fits.
    ///
    /// Views stay clear of the title block and the scale bar. If no scale is set for the sheet,
    /// smaller scales are tried when a view without a fixed position does not fit.
    ///
    /// # Errors
    /// Returns [`SheetError::TooLarge`] if the views do not fit. The error suggests a scale that
    /// fits, if there is one.
    pub(super) fn arrange_views(sheet: &Sheet, plan: &'a ViewPlan) -> Result<Self, SheetError> {
        let best = Self::arrange_on_best(&[sheet], plan);
        best.map(|(_, layout)| layout).ok_or_else(|| match plan.requested.is_empty() {
            true => Self::too_large(sheet, plan),
            false => requested_fault(sheet, plan),
        })
    }

    /// Arranges views like [`arrange_views`](Self::arrange_views), on the best of the given sheets,
    /// which differ only in their paper. Also returns the index of the sheet. If sheets are equally
    /// good, the first one is used.
    pub(super) fn arrange_on_best(sheets: &[&Sheet], plan: &'a ViewPlan) -> Option<(usize, Self)> {
        let at_scale = |scale: DrawingScale| {
            let layouts = sheets.iter().map(|sheet| Self::arrange_at_scale(sheet, plan, scale));
            let numbered = layouts.enumerate().filter_map(|(at, layout)| Some((at, layout?)));
            numbered.reduce(|best, one| if one.1.is_better_than(&best.1) { one } else { best })
        };
        let mut fitting = scales_of(sheets.first()?).into_iter().filter_map(at_scale);
        let mut best = fitting.next()?;
        for smaller in fitting.take(SMALLER_SCALES) {
            if best.1.is_satisfied() {
                break;
            }
            let has_more = smaller.1.left_out.len() < best.1.left_out.len();
            if smaller.1.is_satisfied() || has_more {
                best = smaller;
            }
        }
        Some(best)
    }

    /// Returns the best arrangement at one scale, or `None` if the front, top and side views do not
    /// fit.
    pub(super) fn arrange_at_scale(
        sheet: &Sheet,
        plan: &'a ViewPlan,
        scale: DrawingScale,
    ) -> Option<Self> {
        if !plan.requested.is_empty() {
            return arrange_requested(sheet, plan, scale).ok();
        }
        let grid = ViewGrid::new(sheet, &plan.principal, scale);
        let mut best: Option<Self> = None;
        for Arrangement { area, spacing, scale_bar } in arrangements(sheet) {
            let taken = [sheet.title_block_area(), scale_bar].map(extent_of_rectangle);
            let Some(centers) = grid.place_views(area, spacing) else { continue };
            let cells = grid.cells.iter().zip(centers);
            let mut obstacles: Vec<Extent> =
                cells.clone().map(|(cell, center)| cell.extent_at(center)).collect();
            if obstacles.iter().any(|cell| taken.iter().any(|other| overlap(*cell, *other))) {
                continue;
            }
            obstacles.extend(taken);
            let views = cells.map(|(cell, center)| cell.clone().place(center)).collect();
            let (left_out, overlaps) = (Vec::new(), Vec::new());
            let mut layout = Self { scale, views, left_out, scale_bar, overlaps };
            let corner = DVec2::new(centers[2].x, centers[1].y);
            layout.place_free_views(sheet, &plan.free, obstacles, corner);
            if best.as_ref().is_none_or(|best| layout.is_better_than(best)) {
                best = Some(layout);
            }
        }
        best
    }

    /// Places the views without a fixed position one by one, each at the largest scale that fits.
    fn place_free_views(
        &mut self,
        sheet: &Sheet,
        free: &'a [PlannedView],
        mut obstacles: Vec<Extent>,
        corner: DVec2,
    ) {
        let [low, high] = extent_of_rectangle(sheet.drawing_area());
        let area = [low + HALF_GAP, high - HALF_GAP];
        for planned in free {
            let rectangles = free_rectangles(area, &obstacles);
            match fit_into(sheet, planned, self.scale, &rectangles, corner) {
                Some((cell, center)) => {
                    obstacles.push(cell.extent_at(center));
                    self.views.push(cell.place(center));
                }
                None => self.left_out.push(planned),
            }
        }
    }

    /// Whether every view has a position and a scale not much smaller than the sheet's, and no
    /// views overlap.
    pub(super) fn is_satisfied(&self) -> bool {
        self.cramped_views().next().is_none() && self.overlaps.is_empty()
    }

    /// Returns the views that have no position, or a scale much smaller than the sheet's.
    pub(super) fn cramped_views(&self) -> impl Iterator<Item = &'a PlannedView> {
        let least = LEAST_FREE_SCALE * self.scale.ratio() * (1.0 - 1e-9);
        let small = self.views.iter().filter(move |view| view.scale.ratio() < least);
        self.left_out.iter().copied().chain(small.map(|view| view.planned))
    }

    /// Returns the width and height that the front, top and side views need at a scale, in
    /// millimeters.
    pub(super) fn least_size(sheet: &Sheet, plan: &ViewPlan, scale: DrawingScale) -> DVec2 {
        ViewGrid::new(sheet, &plan.principal, scale).total_size()
    }

    /// Returns the width and height that are always available for views, in millimeters.
    pub(super) fn room_above_blocks(sheet: &Sheet) -> DVec2 {
        let [low, high] = area_above_blocks(sheet, TIGHT_GAP);
        (high - low).max(DVec2::ZERO)
    }

    /// Whether this layout has a larger sheet scale than `other` or, at the same scale, more views
    /// or the same number at larger scales.
    pub(super) fn is_better_than(&self, other: &Self) -> bool {
        let score = |layout: &Self| {
            let scales = layout.views.iter().map(|placed| placed.scale.ratio());
            [layout.scale.ratio(), -(layout.left_out.len() as f64), scales.product::<f64>()]
        };
        let (own, others) = (score(self), score(other));
        // The tolerance is needed because the last digits of a product of scales depend on the
        // order of its factors.
        let differs = |(a, b): &(f64, f64)| (a - b).abs() > 1e-9 * a.abs().max(b.abs());
        own.into_iter().zip(others).find(differs).is_some_and(|(a, b)| a > b)
    }

    /// Returns the extents of everything in the frame: the views with their annotations, the title
    /// block and the scale bar.
    pub(super) fn contents(&self, title_block: Rectangle) -> Vec<Extent> {
        let blocks = [title_block, self.scale_bar].map(extent_of_rectangle);
        self.views.iter().map(PlacedView::extent).chain(blocks).collect()
    }

    /// Returns the error that states the required and available sizes and a remedy.
    fn too_large(sheet: &Sheet, plan: &ViewPlan) -> SheetError {
        let fits =
            |scale: &&DrawingScale| ViewLayout::arrange_at_scale(sheet, plan, **scale).is_some();
        let fitting = sheet.scale.and_then(|_| DrawingScale::STANDARD.iter().find(fits));
        let smallest = DrawingScale::STANDARD[DrawingScale::STANDARD.len() - 1];
        let scale = sheet.scale.unwrap_or(smallest);
        let remedy = match fitting {
            Some(fitting) => format!("; {fitting} fits"),
            None => "; use larger paper, or set the unit of the model".to_owned(),
        };
        let need = Self::least_size(sheet, plan, scale).to_array();
        let available = Self::room_above_blocks(sheet).to_array();
        SheetError::TooLarge { paper: sheet.paper_name.clone(), scale, need, available, remedy }
    }
}

/// Finds the largest scale, up to the sheet's, at which a view fits into a free rectangle. Returns
/// its cell at that scale, and the center.
fn fit_into<'a>(
    sheet: &Sheet,
    planned: &'a PlannedView,
    sheet_scale: DrawingScale,
    rectangles: &[Extent],
    corner: DVec2,
) -> Option<(ViewCell<'a>, DVec2)> {
    let smaller = DrawingScale::STANDARD.into_iter().filter(|s| s.ratio() < sheet_scale.ratio());
    for scale in core::iter::once(sheet_scale).chain(smaller) {
        let longest = scale.to_paper_length(planned.view.size.max_element());
        if scale != sheet_scale && longest < LEAST_VIEW_SIZE {
            return None;
        }
        let cell = if scale == sheet_scale {
            ViewCell::new(planned, sheet, scale)
        } else {
            // A view at a different scale must state its scale.
            let annotations = planned.annotate_with_scale(sheet, scale);
            ViewCell::with_annotations(planned, scale, annotations)
        };
        let [low, high] = cell.extent;
        if let Some(rectangle) = best_rectangle(rectangles, high - low, corner) {
            let middle = (rectangle[0] + rectangle[1]) * 0.5;
            let center = snap_to_grid(middle - (low + high) * 0.5);
            return Some((cell, center));
        }
    }
    None
}

/// A way to place the grid of views on a sheet.
pub(super) struct Arrangement {
    pub(super) area: Extent,
    pub(super) spacing: [GridSpacing; 2],
    pub(super) scale_bar: Rectangle,
}

/// Returns the arrangements to try, with the most even spacing first.
///
/// The last arrangements leave less space between the views and the frame, or move the scale bar
/// out of the way.
pub(super) fn arrangements(sheet: &Sheet) -> Vec<Arrangement> {
    let [low, high] = extent_of_rectangle(sheet.drawing_area());
    let whole = |gap: f64| [low + gap, high - gap];
    let [above, tight] = [HALF_GAP, TIGHT_GAP].map(|gap| area_above_blocks(sheet, gap));
    let (equal, close) = (GridSpacing::Equal, GridSpacing::Close);
    let [usual, other] = scale_bar::scale_bar_areas(sheet);
    let ways = [
        (whole(HALF_GAP), [equal, equal], usual),
        (above, [equal, equal], usual),
        (whole(HALF_GAP), [equal, close], usual),
        (whole(HALF_GAP), [close, equal], usual),
        (whole(HALF_GAP), [close, close], usual),
        (tight, [equal, equal], usual),
        (whole(TIGHT_GAP), [close, close], usual),
        (whole(TIGHT_GAP), [equal, close], other),
        (whole(TIGHT_GAP), [close, close], other),
    ];
    ways.map(|(area, spacing, scale_bar)| Arrangement { area, spacing, scale_bar }).into()
}

/// Returns the area above the title block and scale bar, at a distance from the frame.
fn area_above_blocks(sheet: &Sheet, gap: f64) -> Extent {
    let [low, high] = extent_of_rectangle(sheet.drawing_area());
    let blocks = sheet.title_block_area().y().min(sheet.scale_bar_area().y());
    [low + gap, DVec2::new(high.x - gap, blocks)]
}

/// Converts a rectangle to its corners.
pub(super) fn extent_of_rectangle(area: Rectangle) -> Extent {
    let low = DVec2::new(area.x(), area.y());
    [low, low + DVec2::new(area.width(), area.height())]
}

/// Returns the nearest point on the micrometer grid, in millimeters.
pub(super) fn snap_to_grid(point: DVec2) -> DVec2 {
    page::to_millimeters(page::to_micrometers(point))
}
