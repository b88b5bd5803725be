//! Layout of requested views: at requested positions, in the grid around the front view, or in free
//! space.
//!
//! ```text
//!   1. views with a requested position are placed there
//!   2. views along the axes form columns and rows around the front view
//!   3. all others are placed in free rectangles, one by one
//! ```
//!
//! The scale is the largest at which all views fit, as for the default views.

use super::annotation::{Extent, overlap};
use super::free_area::{best_rectangle, free_rectangles};
use super::paper_choice::scales_of as scales_of_sheet;
use super::view_grid::GridSpacing;
use super::view_layout::{
    Arrangement, HALF_GAP, LEAST_VIEW_SIZE, PlacedView, ViewCell, ViewLayout, arrangements,
    extent_of_rectangle, snap_to_grid,
};
use super::view_plan::{PlannedView, ViewPlan};
use super::view_request::ViewRequest;
use super::{Sheet, SheetError};
use crate::SheetWarning;
use glam::DVec2;
use viewport::DrawingScale;

/// The range of enlargement factors for a detail without its own scale.
const DETAIL_ENLARGEMENT: [f64; 2] = [1.9, 5.1];

/// The views of a grid at a scale, with the column and row of each.
struct RequestedGrid<'a> {
    cells: Vec<(ViewCell<'a>, [usize; 2])>,
    /// The space that views need before and after their centers, for each axis and each column or
    /// row.
    spans: [Vec<[f64; 2]>; 2],
}

/// Returns the cell of a view at a scale, with the scale written below the view if it differs from
/// the sheet's.
fn cell_at<'a>(
    planned: &'a PlannedView,
    sheet: &Sheet,
    scale: DrawingScale,
    sheet_scale: DrawingScale,
) -> ViewCell<'a> {
    let annotations = if scale == sheet_scale {
        planned.annotate(sheet, scale)
    } else {
        planned.annotate_with_scale(sheet, scale)
    };
    ViewCell::with_annotations(planned, scale, annotations)
}

impl<'a> RequestedGrid<'a> {
    /// Arranges the views around the front view, without empty columns and rows.
    fn new(sheet: &Sheet, views: &'a [PlannedView], scale: DrawingScale) -> Self {
        let placed = || views.iter().filter_map(|one| Some((one, one.grid?)));
        // Grid positions may have gaps, which take no space.
        let [columns, rows] = [0, 1].map(|axis| {
            let mut used: Vec<i32> = placed().map(|(_, place)| place[axis]).collect();
            used.sort_unstable();
            used.dedup();
            used
        });
        let index = |used: &[i32], place: i32| used.iter().take_while(|at| **at < place).count();
        let cells: Vec<(ViewCell<'a>, [usize; 2])> = placed()
            .map(|(one, [column, row])| {
                let place = [index(&columns, column), index(&rows, row)];
                (cell_at(one, sheet, scale, scale), place)
            })
            .collect();
        let span = |axis: usize, index: usize| {
            let of_index = cells.iter().filter(|(_, place)| place[axis] == index);
            of_index.fold([0.0_f64; 2], |[before, after], (cell, _)| {
                [before.max(-cell.extent[0][axis]), after.max(cell.extent[1][axis])]
            })
        };
        let spans = [
            (0..columns.len()).map(|index| span(0, index)).collect(),
            (0..rows.len()).map(|index| span(1, index)).collect(),
        ];
        Self { cells, spans }
    }

    /// Returns the size of all columns and rows with their annotations, in millimeters.
    fn total_size(&self) -> DVec2 {
        let sum = |spans: &Vec<[f64; 2]>| spans.as_flattened().iter().sum::<f64>();
        DVec2::new(sum(&self.spans[0]), sum(&self.spans[1]))
    }

    /// Returns the centers of the views in an area, or `None` if the grid is larger than the area.
    fn place_views(&self, [low, high]: Extent, spacing: [GridSpacing; 2]) -> Option<Vec<DVec2>> {
        let rest = high - low - self.total_size();
        if rest.min_element() < 0.0 {
            return None;
        }
        let middles = [0, 1].map(|axis| {
            let spans = &self.spans[axis];
            let gap = match spacing[axis] {
                GridSpacing::Equal => rest[axis] / (spans.len() + 1) as f64,
                GridSpacing::Close => 0.0,
            };
            let mut at = low[axis];
            let middle = |[before, after]: &[f64; 2]| {
                let middle = at + gap + before;
                at = middle + after;
                middle
            };
            spans.iter().map(middle).collect::<Vec<f64>>()
        });
        let center = |[column, row]: [usize; 2]| DVec2::new(middles[0][column], middles[1][row]);
        Some(self.cells.iter().map(|(_, place)| snap_to_grid(center(*place))).collect())
    }
}

/// Returns the reason why requested views cannot be arranged at the sheet's scale or, if none is
/// set, at the smallest standard scale.
pub(super) fn requested_fault(sheet: &Sheet, plan: &ViewPlan) -> SheetError {
    let mut scales = scales_of_sheet(sheet).into_iter().rev();
    let fault = scales.find_map(|scale| arrange_requested(sheet, plan, scale).err());
    fault.unwrap_or(SheetError::Empty)
}

/// Returns warnings about views that overlap others at their requested positions.
fn find_overlaps(views: &[PlacedView<'_>], blocks: [(&str, Extent); 2]) -> Vec<SheetWarning> {
    let is_placed = |view: &PlacedView<'_>| view.planned.place.at.is_some();
    let mut warnings = Vec::new();
    for (index, view) in views.iter().enumerate() {
        let others = views.iter().enumerate();
        // An overlap of two views with requested positions is reported once.
        let others = others.filter(|(at, other)| *at > index || *at < index && !is_placed(other));
        let others = others.map(|(_, other)| (other.planned.title(), other.extent()));
        let blocks = blocks.iter().map(|(name, area)| ((*name).to_owned(), *area));
        let over = others.chain(blocks).filter(|(_, area)| overlap(view.extent(), *area));
        let over = over.filter(|_| is_placed(view));
        let view = || view.planned.title();
        warnings.extend(over.map(|(other, _)| SheetWarning::ViewOverlaps { view: view(), other }));
    }
    warnings
}

/// Returns the best arrangement of requested views at one scale.
///
/// # Errors
/// Returns [`SheetError::TooLarge`] if the views do not fit, or [`SheetError::Outside`] if a view
/// extends beyond the frame at its requested position.
pub(super) fn arrange_requested<'a>(
    sheet: &Sheet,
    plan: &'a ViewPlan,
    scale: DrawingScale,
) -> Result<ViewLayout<'a>, SheetError> {
    let mut taken = vec![];
    let mut placed = Vec::new();
    for planned in &plan.requested {
        let Some(at) = planned.place.at else { continue };
        let own = planned.place.scale.unwrap_or(scale);
        let cell = cell_at(planned, sheet, own, scale);
        check_place(sheet, &cell, at)?;
        taken.push(cell.extent_at(at));
        placed.push(cell.place(snap_to_grid(at)));
    }
    taken.push(extent_of_rectangle(sheet.title_block_area()));
    let grid = RequestedGrid::new(sheet, &plan.requested, scale);
    let mut best: Option<ViewLayout<'a>> = None;
    for Arrangement { area, spacing, scale_bar } in arrangements(sheet) {
        let bar = extent_of_rectangle(scale_bar);
        let Some(centers) = grid.place_views(area, spacing) else { continue };
        let cells = || grid.cells.iter().map(|(cell, _)| cell).zip(centers.iter().copied());
        let mut obstacles: Vec<Extent> =
            cells().map(|(cell, center)| cell.extent_at(center)).collect();
        let is_taken = |cell: &Extent| taken.iter().chain([&bar]).any(|o| overlap(*cell, *o));
        if obstacles.iter().any(is_taken) {
            continue;
        }
        obstacles.extend(taken.iter().chain([&bar]));
        let mut views = placed.clone();
        views.extend(cells().map(|(cell, center)| cell.clone().place(center)));
        let (left_out, overlaps) = (Vec::new(), Vec::new());
        let mut layout = ViewLayout { scale, views, left_out, scale_bar, overlaps };
        place_others(&mut layout, sheet, &plan.requested, obstacles);
        let block = extent_of_rectangle(sheet.title_block_area());
        // Views at requested positions may overlap, which only causes a warning.
        layout.overlaps =
            find_overlaps(&layout.views, [("title block", block), ("scale bar", bar)]);
        if best.as_ref().is_none_or(|best| layout.is_better_than(best)) {
            best = Some(layout);
        }
    }
    best.ok_or_else(|| too_large(sheet, &grid, scale))
}

/// Checks that a view at its requested position is inside the frame.
fn check_place(sheet: &Sheet, cell: &ViewCell<'_>, at: DVec2) -> Result<(), SheetError> {
    let [low, high] = extent_of_rectangle(sheet.drawing_area());
    let half = cell.planned.view.size * cell.scale.ratio() * 0.5;
    let [before, after] = cell.annotations.extent_with([-half, half]);
    let (least, most) = (low - before, high - after);
    if at.cmpge(least).all() && at.cmple(most).all() {
        return Ok(());
    }
    let view = cell.planned.title();
    let too_large = least.cmpgt(most).any();
    let need = (after - before).to_array();
    Err(if too_large {
        let paper = sheet.paper_name.clone();
        let (available, scale) = ((high - low).to_array(), cell.scale);
        let remedy = format!("; choose a smaller scale for the {view}");
        SheetError::TooLarge { paper, scale, need, available, remedy }
    } else {
        let place = &cell.planned.place;
        let is_it = |request: &ViewRequest| request.place() == Some(place);
        let number = sheet.views.iter().position(is_it).map_or(1, |index| index + 1);
        SheetError::Outside { number, view, x: [least.x, most.x], y: [least.y, most.y] }
    })
}

/// Places the views without a grid cell or requested position, each at the largest scale that fits.
fn place_others<'a>(
    layout: &mut ViewLayout<'a>,
    sheet: &Sheet,
    views: &'a [PlannedView],
    mut obstacles: Vec<Extent>,
) {
    let [low, high] = extent_of_rectangle(sheet.drawing_area());
    let area = [low + HALF_GAP, high - HALF_GAP];
    for planned in views.iter().filter(|one| one.grid.is_none() && one.place.at.is_none()) {
        let rectangles = free_rectangles(area, &obstacles);
        let wanted = (low + high) * 0.5;
        let fits = scales_of(planned, layout.scale).into_iter().find_map(|scale| {
            let cell = cell_at(planned, sheet, scale, layout.scale);
            let [low, high] = cell.extent;
            let rectangle = best_rectangle(&rectangles, high - low, wanted)?;
            let middle = (rectangle[0] + rectangle[1]) * 0.5;
            Some((cell, snap_to_grid(middle - (low + high) * 0.5)))
        });
        match fits {
            Some((cell, center)) => {
                obstacles.push(cell.extent_at(center));
                layout.views.push(cell.place(center));
            }
            None => layout.left_out.push(planned),
        }
    }
}

/// Returns the scales at which a view may be drawn, best first.
fn scales_of(planned: &PlannedView, sheet_scale: DrawingScale) -> Vec<DrawingScale> {
    if let Some(own) = planned.place.scale {
        return vec![own];
    }
    let standard = DrawingScale::STANDARD.into_iter();
    let factor = |scale: &DrawingScale| scale.ratio() / sheet_scale.ratio();
    if planned.detail_radius.is_some() {
        let [least, most] = DETAIL_ENLARGEMENT;
        return standard.filter(|scale| (least..=most).contains(&factor(scale))).collect();
    }
    let is_legible = |scale: &DrawingScale| {
        let longest = planned.view.size.max_element();
        scale.to_paper_length(longest) >= LEAST_VIEW_SIZE
    };
    let smaller = standard.filter(|scale| factor(scale) < 1.0).filter(is_legible);
    core::iter::once(sheet_scale).chain(smaller).collect()
}

/// Returns the error with the required and available sizes.
fn too_large(sheet: &Sheet, grid: &RequestedGrid<'_>, scale: DrawingScale) -> SheetError {
    let need = grid.total_size().to_array();
    let [low, high] = extent_of_rectangle(sheet.drawing_area());
    let remedy = match sheet.scale {
        Some(_) => "; use larger paper, a smaller scale or fewer views".to_owned(),
        None => "; use larger paper or fewer views, or set the unit of the model".to_owned(),
    };
    let (paper, available) = (sheet.paper_name.clone(), (high - low).to_array());
    SheetError::TooLarge { paper, scale, need, available, remedy }
}
