//! Paper choice: the orientation, and the smallest sufficient size.
//!
//! ```text
//!   scale     A4 portrait  A4 landscape
//!   1:2       no           no
//!   1:5       no           yes               the larger scale wins, then more views, then
//!   1:10      yes          yes               the scales of the views
//! ```

use super::Sheet;
use super::view_layout::ViewLayout;
use super::view_plan::ViewPlan;
use homog::{Plane, World};
use model::ModelInstance;
use viewport::DrawingScale;

impl Sheet {
    /// Turns the paper to portrait or landscape, whichever makes models larger or fits more views.
    /// Leaves the paper unchanged if both are equally good.
    #[must_use]
    pub fn with_best_orientation(
        self,
        models: &[ModelInstance],
        sections: &[Plane<World>],
    ) -> Self {
        let Ok(plan) = ViewPlan::new(&self, models, sections) else { return self };
        self.turned_for(&plan)
    }

    /// Returns the first sufficient sheet of a list that goes from the smallest paper to the
    /// largest:
    ///
    /// - if a scale is set, the first sheet on which all views fit at that scale;
    /// - otherwise the first sheet on which all views fit at 1:1 or larger;
    /// - if the views do not fit even on the largest paper, the first sheet for which the next
    ///   larger paper does not allow a larger scale.
    ///
    /// If `turns` is set, each sheet is used in its best orientation. Returns the first sheet if
    /// there are no models, and `None` if there are no sheets. The sheets may differ only in paper
    /// and line widths.
    #[must_use]
    pub fn smallest_of(
        sheets: Vec<Self>,
        turns: bool,
        models: &[ModelInstance],
        sections: &[Plane<World>],
    ) -> Option<Self> {
        if sheets.len() == 1 && !turns {
            return sheets.into_iter().next();
        }
        let plan = ViewPlan::new(sheets.first()?, models, sections);
        let Ok(plan) = plan else { return sheets.into_iter().next() };
        let turned = sheets.into_iter().map(|own| if turns { own.turned_for(&plan) } else { own });
        let sheets: Vec<Self> = turned.collect();
        let layouts: Vec<Option<ViewLayout<'_>>> =
            sheets.iter().map(|sheet| ViewLayout::arrange_views(sheet, &plan).ok()).collect();
        let ratio = |at: usize| layouts[at].as_ref().map_or(0.0, |layout| layout.scale.ratio());
        let is_enough = |layout: &ViewLayout<'_>| {
            layout.is_satisfied() && (sheets[0].scale.is_some() || layout.scale.ratio() >= 1.0)
        };
        let enough = layouts.iter().position(|layout| layout.as_ref().is_some_and(is_enough));
        let last = sheets.len() - 1;
        let is_no_smaller = |at: &usize| ratio(*at) > 0.0 && ratio(*at) >= ratio(at + 1);
        let chosen = enough.or_else(|| (0..last).find(is_no_smaller)).unwrap_or(last);
        sheets.into_iter().nth(chosen)
    }

    /// Turns the sheet to its best orientation for these views.
    fn turned_for(self, plan: &ViewPlan) -> Self {
        let rotated = Self { paper: self.paper.rotated(), ..self.clone() };
        let both = [&self, &rotated];
        let at_own_scale = ViewLayout::arrange_on_best(&both, plan);
        let is_rotated = at_own_scale.map(|(at, _)| at == 1).unwrap_or_else(|| {
            // The requested scale fits in neither orientation, so the orientation that allows the
            // larger scale is used.
            let any = both.map(|sheet| Self { scale: None, ..sheet.clone() });
            let best = ViewLayout::arrange_on_best(&any.each_ref(), plan);
            best.is_some_and(|(at, _)| at == 1)
        });
        if is_rotated { rotated } else { self }
    }
}

/// Returns the scales to try on a sheet, largest first.
pub(super) fn scales_of(sheet: &Sheet) -> Vec<DrawingScale> {
    sheet.scale.map_or(DrawingScale::STANDARD.to_vec(), |scale| vec![scale])
}
