//! Requested dimensions: lengths, circles and angles in world space, each shown in a view at true
//! size.
//!
//! ```text
//!   Measure (world) ─► the first view with a true image ─► ViewMeasure (millimeters of the object
//!                                                          from the center of the view, y down)
//! ```
//!
//! A view shows at true size:
//! - a length that is perpendicular to the view direction;
//! - a circle whose axis is parallel to the view direction;
//! - an angle whose plane is perpendicular to the view direction.
//!
//! Nothing else is dimensioned, because a number that cannot be measured on the paper would mislead
//! anyone who works from the drawing.

use super::sheet_view::{SheetView, ViewName};
use crate::DimensionFault;
use camera::NamedView;
use glam::{DVec2, DVec3};
use hidden_line::WorldCircle;
use homog::{Plane, Point, World};

/// The maximum sine of the angle between directions that count as parallel. A length tilted this
/// far out of the view plane has a relative error of 5·10⁻⁹.
const TRUE_SINE: f64 = 1e-4;

/// A dimension requested for a sheet.
#[derive(Clone, PartialEq, Debug)]
pub struct Dimension {
    /// The lengths, angle or circle to measure.
    pub measure: Measure,
    /// The view that shows the dimension, or `None` for the first view that shows it at true size.
    pub view: Option<NamedView>,
    /// The side of the part on which the dimension line is drawn, or `None` for the side with
    /// shorter extension lines. Applies only to lengths.
    pub side: Option<DimensionSide>,
    /// The maximum number of decimal places, or `None` for the sheet's default.
    pub decimals: Option<u32>,
    /// The name in warnings, such as `dimension 3`.
    pub name: String,
}

/// The lengths, angle or circle that a dimension measures.
#[derive(Clone, PartialEq, Debug)]
pub enum Measure {
    /// Lengths between neighboring points, on one line.
    Chain(Vec<Point<World>>, LengthDirection),
    /// Lengths from the first point to each of the others, on parallel lines.
    Baseline(Vec<Point<World>>, LengthDirection),
    /// The diameter of a circle.
    Diameter(WorldCircle),
    /// The radius of a circle.
    Radius(WorldCircle),
    /// The angle at the first point between the directions to the other two.
    Angle([Point<World>; 3]),
}

/// The direction along which a length is measured.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum LengthDirection {
    /// From the first point to the last.
    #[default]
    Aligned,
    /// Across the view, from left to right.
    Horizontal,
    /// Upward in the view.
    Vertical,
}

/// A side of a view.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum DimensionSide {
    /// Above the part.
    Above,
    /// Below the part.
    Below,
    /// To the left of the part.
    Left,
    /// To the right of the part.
    Right,
}

/// The image of a measure in a view, in object millimeters from the center of the view, with y
/// down.
#[derive(Clone, PartialEq, Debug)]
pub(super) enum ViewMeasure {
    /// Lengths between the images of points along a unit vector that points to the right or upward.
    /// `prefix` precedes the number.
    Lengths { feet: Vec<DVec2>, along: DVec2, is_baseline: bool, prefix: &'static str },
    /// A circle seen face-on. `prefix` precedes the number, which is `radii` times the radius.
    Round { center: DVec2, radius: f64, prefix: &'static str, radii: f64 },
    /// An angle, defined by its vertex and the ends of its sides.
    Angle { vertex: DVec2, ends: [DVec2; 2] },
}

/// A dimension in the view that shows it.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct ViewDimension {
    /// The number of the dimension on the sheet, from 1.
    pub(super) number: usize,
    pub(super) measure: ViewMeasure,
    pub(super) side: Option<DimensionSide>,
    pub(super) decimals: Option<u32>,
    pub(super) name: String,
}

impl DimensionSide {
    /// Returns the unit vector from the part toward this side, on paper.
    pub(super) const fn outward(self) -> DVec2 {
        match self {
            Self::Above => DVec2::NEG_Y,
            Self::Below => DVec2::Y,
            Self::Left => DVec2::NEG_X,
            Self::Right => DVec2::X,
        }
    }
}

impl SheetView {
    /// Returns the image of a point, in object millimeters from the center of the view, with y
    /// down.
    pub(super) fn image_of(&self, point: Point<World>) -> DVec2 {
        let seen = self.camera.world_to_view().transform_point(point).raw();
        DVec2::new(seen.x, -seen.y) * self.millimeters_per_unit
    }

    /// Returns the name if this is a named view.
    pub(super) fn named_view(&self) -> Option<NamedView> {
        match self.name {
            ViewName::Named(name) => Some(name),
            _ => None,
        }
    }

    /// Returns the unit vector along the view direction.
    fn gaze_vector(&self) -> DVec3 {
        self.camera.gaze().raw()
    }

    /// Whether a vector is parallel to the plane of the view.
    pub(super) fn shows_true(&self, vector: DVec3) -> bool {
        vector.dot(self.gaze_vector()).abs() <= TRUE_SINE * vector.length()
    }

    /// Whether a unit vector is parallel to the view direction.
    pub(super) fn looks_along(&self, unit: DVec3) -> bool {
        unit.cross(self.gaze_vector()).length() <= TRUE_SINE
    }

    /// Whether the sections of the view retain a point.
    fn retains(&self, point: Point<World>) -> bool {
        let slack = 1e-6 * self.size.max_element() / self.millimeters_per_unit;
        self.sections.iter().all(|plane: &Plane<World>| plane.evaluate(point) >= -slack)
    }
}

impl Measure {
    /// Returns the measured points.
    fn points(&self) -> Vec<Point<World>> {
        match self {
            Self::Chain(points, _) | Self::Baseline(points, _) => points.clone(),
            Self::Diameter(circle) | Self::Radius(circle) => vec![circle.center],
            Self::Angle(points) => points.to_vec(),
        }
    }

    /// Returns the image of the measure in a view, with a rank (lower is better), or the reason why
    /// the view does not show the measure at true size.
    pub(super) fn image_in(&self, view: &SheetView) -> Result<(ViewMeasure, u8), DimensionFault> {
        if !self.points().iter().all(|&point| view.retains(point)) {
            return Err(DimensionFault::CutAway);
        }
        match self {
            Self::Chain(points, direction) => lengths_in(view, points, *direction, false),
            Self::Baseline(points, direction) => lengths_in(view, points, *direction, true),
            Self::Diameter(circle) => circle_in(view, circle, "Ø", 2.0),
            Self::Radius(circle) => circle_in(view, circle, "R", 1.0),
            Self::Angle(points) => angle_in(view, points),
        }
    }
}

/// Returns the image of lengths between points.
///
/// Horizontal and vertical lengths are true in every view, but a view where the length equals the
/// distance between the points is preferred.
fn lengths_in(
    view: &SheetView,
    points: &[Point<World>],
    direction: LengthDirection,
    is_baseline: bool,
) -> Result<(ViewMeasure, u8), DimensionFault> {
    let [Some(first), Some(last)] = [points.first(), points.last()] else {
        return Err(DimensionFault::NoExtent);
    };
    let span = last.raw() - first.raw();
    let feet: Vec<DVec2> = points.iter().map(|&point| view.image_of(point)).collect();
    let along = match direction {
        LengthDirection::Horizontal => DVec2::X,
        LengthDirection::Vertical => DVec2::NEG_Y,
        LengthDirection::Aligned if span == DVec3::ZERO => return Err(DimensionFault::NoExtent),
        LengthDirection::Aligned if !view.shows_true(span) => {
            return Err(DimensionFault::NowhereTrue);
        }
        LengthDirection::Aligned => reading_direction(feet[feet.len() - 1] - feet[0]),
    };
    let measured = (feet[feet.len() - 1] - feet[0]).dot(along).abs();
    if measured < 1e-6 {
        return Err(DimensionFault::NoExtent);
    }
    let whole = span.length() * view.millimeters_per_unit;
    // Compares 1 − cos φ with a tolerance, where φ is the angle between the length and `along`.
    let rank = u8::from(whole - measured > TRUE_SINE * TRUE_SINE * whole);
    Ok((ViewMeasure::Lengths { feet, along, is_baseline, prefix: "" }, rank))
}

/// Returns the image of a circle: the circle itself, or its diameter if it is seen from the side.
fn circle_in(
    view: &SheetView,
    circle: &WorldCircle,
    prefix: &'static str,
    radii: f64,
) -> Result<(ViewMeasure, u8), DimensionFault> {
    let axis = circle.axis.raw();
    let center = view.image_of(circle.center);
    let radius = circle.radius * view.millimeters_per_unit;
    if view.looks_along(axis) {
        return Ok((ViewMeasure::Round { center, radius, prefix, radii }, 0));
    }
    if radii != 2.0 || !view.shows_true(axis) {
        return Err(DimensionFault::NowhereTrue);
    }
    let axis_end = view.image_of(Point::from_raw(circle.center.raw() + axis));
    let along = reading_direction((axis_end - center).perp());
    let feet = vec![center - along * radius, center + along * radius];
    Ok((ViewMeasure::Lengths { feet, along, is_baseline: false, prefix }, 1))
}

/// Returns the image of an angle.
fn angle_in(
    view: &SheetView,
    points: &[Point<World>; 3],
) -> Result<(ViewMeasure, u8), DimensionFault> {
    let [vertex, from, to] = points.map(Point::raw);
    let normal = (from - vertex).normalize_or_zero().cross((to - vertex).normalize_or_zero());
    if normal.length() < TRUE_SINE {
        return Err(DimensionFault::NoExtent);
    }
    if !view.looks_along(normal.normalize()) {
        return Err(DimensionFault::NowhereTrue);
    }
    let [vertex, from, to] = points.map(|point| view.image_of(point));
    Ok((ViewMeasure::Angle { vertex, ends: [from, to] }, 0))
}

/// Returns the unit vector along a line, in the direction that reads to the right or upward.
fn reading_direction(line: DVec2) -> DVec2 {
    let unit = line.normalize_or(DVec2::X);
    let is_upright = unit.x.abs() < 1e-9;
    let reads = if is_upright { unit.y < 0.0 } else { unit.x > 0.0 };
    if reads { unit } else { -unit }
}

impl Dimension {
    /// Chooses the view that shows the dimension, as an index into `views`, and the image in it.
    ///
    /// # Errors
    /// Returns the reason if the requested view, or by default every view, fails to show the
    /// dimension.
    pub(super) fn choose_view(
        &self,
        views: &[&SheetView],
    ) -> Result<(usize, ViewMeasure), DimensionFault> {
        let images = views.iter().map(|view| self.measure.image_in(view));
        let images: Vec<Result<(ViewMeasure, u8), DimensionFault>> = images.collect();
        let best = || {
            let shown = images.iter().enumerate();
            let shown =
                shown.filter_map(|(at, image)| image.as_ref().ok().map(|image| (at, image)));
            // If the ranks are equal, the earlier view is preferred.
            shown.min_by_key(|(at, (_, rank))| (*rank, *at))
        };
        if let Some(name) = self.view {
            let named = views.iter().position(|view| view.named_view() == Some(name));
            let index = named.ok_or(DimensionFault::NoSuchView(name))?;
            return match &images[index] {
                Ok((measure, _)) => Ok((index, measure.clone())),
                Err(DimensionFault::NowhereTrue) => {
                    let shown_in = best().and_then(|(at, _)| views[at].named_view());
                    Err(DimensionFault::Foreshortened { view: name, shown_in })
                }
                Err(fault) => Err(*fault),
            };
        }
        // Views fail for different reasons; the most informative one is reported.
        let fault = || {
            let faults = images.iter().filter_map(|image| image.as_ref().err());
            faults.copied().max_by_key(|fault| match fault {
                DimensionFault::CutAway => 0,
                DimensionFault::NowhereTrue => 1,
                _ => 2,
            })
        };
        match best() {
            Some((at, (measure, _))) => Ok((at, measure.clone())),
            None => Err(fault().unwrap_or(DimensionFault::NowhereTrue)),
        }
    }
}
