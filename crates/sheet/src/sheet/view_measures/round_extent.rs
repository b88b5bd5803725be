//! The extents of round parts: the circles beyond the facets that approximate them.
//!
//! ```text
//!        ___●___        The facets of a cylinder end short of its circle unless a vertex is at the
//!     ●╱         ╲●     extreme. A flange of Ø120 would be dimensioned as 120 × 119.96.
//! ```

use super::super::sheet_view::SheetView;
use super::super::view_plan::{PlannedView, ViewPlan};
use crate::Sheet;
use core::f64::consts::TAU;
use glam::DVec2;
use hidden_line::{FeaturePicker, WorldCircle};
use homog::Point;
use model::ModelInstance;

/// The largest distance between a circle and its facets, as a fraction of the radius. Points of a
/// recognized circle are at most 29.5° apart, so it is 1 − cos 14.75°.
const LARGEST_SAGITTA: f64 = 0.033;

impl ViewPlan {
    /// Finds how far the circles of the models extend beyond their facets in each view with overall
    /// dimensions.
    pub(in super::super) fn add_round_extents(&mut self, sheet: &Sheet, models: &[ModelInstance]) {
        let Self { principal, free, requested, .. } = self;
        let all = principal.iter_mut().chain(free).chain(requested);
        let mut planned: Vec<&mut PlannedView> =
            all.filter(|planned| !planned.dimensions.is_empty()).collect();
        if planned.is_empty() {
            return;
        }
        let picker = FeaturePicker::new(models, sheet.style.crease_angle);
        let mut circles: Vec<WorldCircle> = picker.circles(None).collect();
        circles.retain(|circle| TAU - circle.sweep < 1e-6);
        for planned in &mut planned {
            planned.measures.round_excess = planned.drawn_view().round_excess(&circles);
        }
    }
}

impl SheetView {
    /// Returns the width and height by which full circles extend beyond the object in this view, in
    /// object millimeters.
    ///
    /// A circle that extends farther than its facets can cause belongs to a part that a section
    /// removes, and is ignored.
    fn round_excess(&self, circles: &[WorldCircle]) -> DVec2 {
        let half = self.size * 0.5;
        let mut beyond = [DVec2::ZERO; 2];
        for circle in circles {
            let center = self.image_of(circle.center);
            let axis_end = Point::from_raw(circle.center.raw() + circle.axis.raw());
            let axis = (self.image_of(axis_end) - center) / self.millimeters_per_unit;
            let radius = circle.radius * self.millimeters_per_unit;
            let reach = (DVec2::ONE - axis * axis).max(DVec2::ZERO).map(f64::sqrt) * radius;
            for (beyond, side) in beyond.iter_mut().zip([center, -center]) {
                let excess = side + reach - half;
                let is_sagitta = excess.cmple(DVec2::splat(LARGEST_SAGITTA * radius));
                *beyond = beyond.max(DVec2::select(is_sagitta, excess, DVec2::ZERO));
            }
        }
        beyond[0] + beyond[1]
    }
}
