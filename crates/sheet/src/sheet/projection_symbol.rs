//! Projection symbol (ISO 5456-2): a truncated cone, seen from the side and from its narrow end.
//!
//! ```text
//!   first angle      ╱│          third angle       │╲
//!                   ╱ │  (◯)                  (◯)  │ ╲
//!                   ╲ │                            │ ╱
//!                    ╲│                            │╱
//! ```

use glam::DVec2;
use page::Polyline;
use projection::SheetAngle;

/// The number of sides of the polygon that approximates a circle.
const CIRCLE_SIDES: u32 = 48;

/// Returns the symbol for a projection angle, centered at a point. The cone is as long as it is
/// high, and half as high at its narrow end.
///
/// The second view shows the narrow end as two circles: in first-angle projection it is to the
/// right of the cone, and in third-angle projection to the left.
pub(super) fn projection_symbol(angle: SheetAngle, middle: DVec2, height: f64) -> Vec<Polyline> {
    let half = height * 0.5;
    // In first-angle projection the left view, which shows the narrow end, is to the right of the
    // cone.
    let side = match angle {
        SheetAngle::First => 1.0,
        SheetAngle::Third => -1.0,
    };
    let cone = middle - DVec2::new(side * height * 0.8, 0.0);
    let eye = middle + DVec2::new(side * height * 0.8, 0.0);
    let cone_point = |x: f64, y: f64| cone + DVec2::new(x, y) * half;
    // In both projection angles, the narrow end of the cone is on its left.
    let corners = [
        cone_point(-1.0, -0.5),
        cone_point(1.0, -1.0),
        cone_point(1.0, 1.0),
        cone_point(-1.0, 0.5),
    ];
    let axis_ends = |center: DVec2| {
        [center - DVec2::new(half * 1.4, 0.0), center + DVec2::new(half * 1.4, 0.0)]
    };
    let vertical = [eye - DVec2::new(0.0, half * 1.2), eye + DVec2::new(0.0, half * 1.2)];
    let lines = [
        Polyline::through_points(&corners, true),
        circle_polygon(eye, half),
        circle_polygon(eye, half * 0.5),
        Polyline::through_points(&axis_ends(cone), false),
        Polyline::through_points(&axis_ends(eye), false),
        Polyline::through_points(&vertical, false),
    ];
    lines.into_iter().flatten().collect()
}

/// Returns a circle as a closed polyline.
fn circle_polygon(center: DVec2, radius: f64) -> Option<Polyline> {
    let point = |k: u32| {
        let angle = core::f64::consts::TAU * f64::from(k) / f64::from(CIRCLE_SIDES);
        let (sin, cos) = libm::sincos(angle);
        center + DVec2::new(cos, sin) * radius
    };
    Polyline::through_points(&(0..CIRCLE_SIDES).map(point).collect::<Vec<_>>(), true)
}
