//! Sheet fill: the fraction of the paper that the views use, and what prevents the next larger
//! scale.
//!
//! ```text
//!   ┌───────────────────────────────┐
//!   │ ┌─ ─ ─ ─ ─ ─┐  ┌─ ─ ─┐        │      fill = area of the dashed rectangles
//!   │   front          left         │           / (area within the frame
//!   │ └─ ─ ─ ─ ─ ─┘  └─ ─ ─┘        │              - title block - scale bar)
//!   │ 0──1──2 m      ┌──────────────┤
//!   └────────────────┴──────────────┘
//! ```
//!
//! Each rectangle encloses a view and its annotations. The standard scales (ISO 5455) are a factor
//! of 2 or 2.5 apart, so areas differ by a factor of 4 or 6.25. A sheet whose views just miss a
//! scale is mostly empty, and the only remedy is a different paper size.

use super::annotation::Extent;
use super::view_layout::ViewLayout;
use super::view_plan::{PlannedView, ViewPlan};
use super::{Sheet, SheetError};
use core::fmt;
use homog::{Plane, World};
use model::ModelInstance;
use viewport::{DrawingScale, Rectangle};

/// The numbers n of scales 1:n and n:1 between the standard scales.
const INTERMEDIATE: [u32; 14] = [3, 4, 15, 25, 30, 40, 150, 250, 300, 400, 1500, 2500, 3000, 4000];

/// The fraction of a sheet that its views use, and the reason why they are not larger.
///
/// The `Display` text reports both in one sentence.
#[derive(Clone, PartialEq, Debug)]
pub struct SheetFill {
    /// The scale of the sheet.
    pub scale: DrawingScale,
    /// The total area of the rectangles around the views and their annotations, as a fraction of
    /// the area inside the frame without the title block and scale bar.
    pub fraction: f64,
    /// The reason why the scale is not larger.
    pub limit: ScaleLimit,
    /// The largest scale between this one and the next standard scale at which all views fit, such
    /// as 1:3. `None` if there is no such scale.
    pub between: Option<DrawingScale>,
}

/// The reason why the views of a sheet are not at the next larger standard scale.
#[derive(Clone, PartialEq, Debug)]
#[non_exhaustive]
pub enum ScaleLimit {
    /// The scale was requested.
    Given,
    /// There is no larger standard scale.
    Largest,
    /// The front, top and side views are larger than the available space.
    TooLarge {
        /// The next larger scale.
        scale: DrawingScale,
        /// The width and height of the views at this scale, in millimeters.
        need: [f64; 2],
        /// The available width and height, in millimeters.
        available: [f64; 2],
    },
    /// The front, top and side views leave no room for other views.
    NoRoom {
        /// The next larger scale.
        scale: DrawingScale,
        /// The other views' names, such as `isometric view`.
        views: Vec<String>,
    },
}

impl Sheet {
    /// Computes what fraction of the paper the views of models use, without drawing them. The
    /// models are cut by section planes.
    ///
    /// # Errors
    /// See [`draw`](Self::draw).
    pub fn fill(
        &self,
        models: &[ModelInstance],
        sections: &[Plane<World>],
    ) -> Result<SheetFill, SheetError> {
        let plan = ViewPlan::new(self, models, sections)?;
        let layout = ViewLayout::arrange_views(self, &plan)?;
        let area = |extent: Extent| {
            let size = extent[1] - extent[0];
            size.x * size.y
        };
        let of_rectangle = |rectangle: Rectangle| rectangle.width() * rectangle.height();
        let used: f64 = layout.views.iter().map(|view| area(view.extent())).sum();
        let blocks = of_rectangle(self.title_block_area()) + of_rectangle(self.scale_bar_area());
        let room = of_rectangle(self.drawing_area()) - blocks;
        let limit = self.scale_limit(&plan, layout.scale);
        let between = match limit {
            ScaleLimit::TooLarge { .. } | ScaleLimit::NoRoom { .. } => {
                self.largest_between(&plan, layout.scale)
            }
            ScaleLimit::Given | ScaleLimit::Largest => None,
        };
        let fraction = used / room.max(1e-9);
        Ok(SheetFill { scale: layout.scale, fraction, limit, between })
    }

    /// Returns the largest intermediate scale, below 2.5 times this one, at which all views fit.
    fn largest_between(&self, plan: &ViewPlan, scale: DrawingScale) -> Option<DrawingScale> {
        let reach = scale.ratio() * (1.0 + 1e-9)..scale.ratio() * 2.5 * (1.0 - 1e-9);
        let mut between: Vec<DrawingScale> = INTERMEDIATE
            .into_iter()
            .flat_map(|n| [DrawingScale::new(n, 1), DrawingScale::new(1, n)])
            .flatten()
            .filter(|one| reach.contains(&one.ratio()))
            .collect();
        between.sort_by(|a, b| b.ratio().total_cmp(&a.ratio()));
        let holds_all = |one: &DrawingScale| {
            let layout = ViewLayout::arrange_at_scale(self, plan, *one);
            layout.is_some_and(|layout| layout.is_satisfied())
        };
        between.into_iter().find(holds_all)
    }

    /// Returns the reason why the views are not at the next larger scale.
    fn scale_limit(&self, plan: &ViewPlan, scale: DrawingScale) -> ScaleLimit {
        if self.scale.is_some() {
            return ScaleLimit::Given;
        }
        let larger = DrawingScale::STANDARD.into_iter().rev().find(|s| s.ratio() > scale.ratio());
        let Some(larger) = larger else { return ScaleLimit::Largest };
        if let Some(layout) = ViewLayout::arrange_at_scale(self, plan, larger) {
            let views = layout.cramped_views().map(PlannedView::title).collect();
            return ScaleLimit::NoRoom { scale: larger, views };
        }
        let need = ViewLayout::least_size(self, plan, larger).to_array();
        let available = ViewLayout::room_above_blocks(self).to_array();
        ScaleLimit::TooLarge { scale: larger, need, available }
    }
}

impl fmt::Display for SheetFill {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (percent, scale) = (libm::round(self.fraction * 100.0), self.scale);
        write!(f, "the views fill {percent}% of the drawing area at {scale}; ")?;
        self.limit.fmt(f)?;
        match self.between {
            Some(between) => write!(f, "; {between}, which is not a standard scale, fits"),
            None => Ok(()),
        }
    }
}

impl fmt::Display for ScaleLimit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Given => f.write_str("this scale was requested"),
            Self::Largest => f.write_str("there is no larger standard scale"),
            Self::TooLarge { scale, need, available } => write!(
                f,
                "at {scale}, the next standard scale, the front, top and side views need \
                 {:.0} x {:.0} mm, but {:.0} x {:.0} mm are available",
                need[0], need[1], available[0], available[1]
            ),
            Self::NoRoom { scale, views } => write!(
                f,
                "at {scale}, the next standard scale, there is no room for the {}",
                views.join(", the ")
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fill_is_described_in_one_sentence() {
        let [scale, next] = [7, 6].map(|at| DrawingScale::STANDARD[at]);
        let fill = |limit, between| SheetFill { scale, fraction: 0.384, limit, between };
        let (need, available) = ([391.2, 262.0], [257.0, 158.4]);
        let limit = ScaleLimit::TooLarge { scale: next, need, available };
        assert_eq!(
            fill(limit, DrawingScale::new(1, 4).ok()).to_string(),
            "the views fill 38% of the drawing area at 1:5; at 1:2, the next standard scale, \
             the front, top and side views need 391 x 262 mm, but 257 x 158 mm are available; \
             1:4, which is not a standard scale, fits"
        );
        let views = ["section A-A", "isometric view"].map(str::to_owned).to_vec();
        let text = fill(ScaleLimit::NoRoom { scale: next, views }, None).to_string();
        assert!(text.ends_with("no room for the section A-A, the isometric view"), "{text}");
    }
}
