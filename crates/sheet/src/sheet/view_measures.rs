//! The dimensions and center lines of views, and their assignment to views.

mod round_extent;

use super::Sheet;
use super::annotation::ViewAnnotations;
use super::center_line::{CENTER_LINE_OVERHANG, CenterLines};
use super::collision::convex_hull;
use super::dimension::{DimensionSettings, OverallSide};
use super::dimension_board::DimensionBoard;
use super::measure::ViewDimension;
use super::sheet_view::SheetView;
use super::view_mark::ViewMark;
use super::view_plan::{PlannedView, ViewPlan};
use crate::SheetWarning;
use glam::DVec2;
use hidden_line::{FeaturePicker, WorldCircle};
use model::{ModelInstance, world_points};

/// The maximum length of extension lines of overall dimensions, in character heights.
const FAR: f64 = 200.0;

/// The dimensions and center lines of a view.
#[derive(Clone, Debug, Default)]
pub(super) struct ViewMeasures {
    center_lines: CenterLines,
    dimensions: Vec<ViewDimension>,
    /// The convex hull of the object, in object millimeters from the center of the view, with y
    /// down.
    hull: Vec<DVec2>,
    /// The width and height by which circles extend beyond their facets, in object millimeters.
    pub(super) round_excess: DVec2,
}

impl ViewPlan {
    /// Assigns each dimension to the view that shows it, and warns about dimensions that no view
    /// shows. Adds center lines to every view that can have them.
    pub(super) fn add_measures(&mut self, sheet: &Sheet, models: &[ModelInstance]) {
        self.add_round_extents(sheet, models);
        if sheet.measures.is_empty() && !sheet.center_lines && !sheet.symmetry_lines {
            return;
        }
        let Self { principal, free, requested, warnings } = self;
        let usual = principal.iter_mut().chain(free.iter_mut()).filter(|_| requested.is_empty());
        let mut planned: Vec<&mut PlannedView> = usual.collect();
        if planned.is_empty() {
            planned.extend(requested);
        }
        planned.retain(|planned| planned.takes_measures());
        for (dimension, number) in sheet.measures.iter().zip(1..) {
            let views: Vec<&SheetView> = planned.iter().map(|planned| &planned.view).collect();
            match dimension.choose_view(&views) {
                Ok((at, measure)) => planned[at].measures.dimensions.push(ViewDimension {
                    number,
                    measure,
                    side: dimension.side,
                    decimals: dimension.decimals,
                    name: dimension.name.clone(),
                }),
                Err(fault) => {
                    let dimension = dimension.name.clone();
                    warnings.push(SheetWarning::DimensionLeftOut { dimension, fault });
                }
            }
        }
        if sheet.center_lines || sheet.symmetry_lines {
            let picker = FeaturePicker::new(models, sheet.style.crease_angle);
            sheet.add_center_lines(&mut planned, &picker);
        }
        let points = world_points(models);
        for planned in planned {
            let PlannedView { view, measures, .. } = planned;
            // Computing the hull takes a pass over all points, and the hull is needed only to place
            // dimensions.
            if !measures.dimensions.is_empty() {
                let images = points.iter().map(|&point| view.image_of(point)).collect();
                measures.hull = convex_hull(images);
            }
        }
    }
}

impl Sheet {
    /// Adds lines of symmetry, and center lines that do not coincide with them.
    fn add_center_lines(&self, planned: &mut [&mut PlannedView], picker: &FeaturePicker<'_>) {
        if self.symmetry_lines {
            self.add_symmetry_lines(planned, picker);
        }
        if !self.center_lines {
            return;
        }
        let circles: Vec<WorldCircle> = picker.circles(None).collect();
        for PlannedView { view, marks, measures, .. } in planned.iter_mut().map(|one| &mut **one) {
            let symmetry = marks.iter().filter_map(ViewMark::as_center_line).collect();
            measures.center_lines = CenterLines::in_view(view, &circles).beside(symmetry);
        }
    }
}

impl ViewMeasures {
    /// Returns the space that center lines may take up around the object, in millimeters on paper.
    pub(super) fn reserve(&self) -> f64 {
        if self.center_lines.is_empty() { 0.0 } else { CENTER_LINE_OVERHANG }
    }

    /// Adds the dimensions at a scale, clear of everything placed so far and of the overall
    /// dimensions that are added later.
    pub(super) fn annotate(
        &self,
        annotations: &mut ViewAnnotations,
        overall: &[OverallSide],
        half: DVec2,
        settings: &DimensionSettings,
    ) {
        self.center_lines.annotate(annotations, settings.scale);
        if self.dimensions.is_empty() {
            return;
        }
        let hull = self.hull.iter().map(|point| *point * settings.scale.ratio()).collect();
        let reserved = overall.iter().flat_map(|side| {
            let (outward, far) = (side.outward(), FAR * settings.letters);
            let corner = outward.abs() * half * (outward.x + outward.y);
            let across = outward.perp().abs() * half;
            [corner + across, corner - across].map(|foot| [foot, foot + outward * far])
        });
        let mut board = DimensionBoard::new(annotations, hull, reserved.collect(), *settings);
        board.place_all(&self.dimensions, annotations);
    }
}
