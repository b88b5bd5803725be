//! Finds the circles through runs of points.

use glam::DVec2;

/// The minimum number of points in an arc.
const MIN_ARC_POINTS: usize = 8;

/// The angle at and above which a step is a corner.
const MAX_STEP_DEGREES: f64 = 29.5;

/// The relative tolerance for differences between steps. Rounding to the grid adds to it.
const STEP_TOLERANCE: f64 = 0.02;

/// The maximum radius, as a multiple of the extent of the points. Flatter runs are too uncertain.
const MAX_RADIUS_FACTOR: f64 = 50.0;

/// The maximum angle of an arc in a polyline. It is slightly less than a full turn, because a bulge
/// cannot express a full circle.
const MAX_SWEEP: f64 = 0.97 * core::f64::consts::TAU;

/// A vertex of a polyline whose sides are lines and arcs.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ArcVertex {
    /// The position in grid steps.
    pub point: DVec2,
    /// The tangent of a quarter of the angle of the arc to the next vertex. It is positive if the
    /// arc turns from x to y, and 0 for a line.
    pub bulge: f64,
}

/// A circle in grid steps.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Circle {
    /// The center.
    pub center: DVec2,
    /// The radius.
    pub radius: f64,
}

/// A polyline converted to lines and arcs.
#[derive(Clone, PartialEq, Debug)]
pub enum LineShape {
    /// A full circle.
    Circle(Circle),
    /// A single arc from one angle to a larger angle, in radians, measured from x toward y.
    Arc(Circle, [f64; 2]),
    /// Straight sides and arcs, and whether the last vertex is joined to the first.
    Path(Vec<ArcVertex>, bool),
}

/// Converts a polyline to lines and arcs. Points become arcs where they are on circles within the
/// tolerance, in grid steps. A tolerance of 0 disables arcs.
///
/// The polyline must have at least two points, and adjacent points must differ. `closed` specifies
/// whether the last point is joined to the first, which must not be repeated.
#[must_use]
pub fn recognize_arcs(points: &[[i32; 2]], closed: bool, tolerance: f64) -> LineShape {
    let points: Vec<DVec2> = points.iter().copied().map(grid_point).collect();
    let straight = |points: &[DVec2]| -> Vec<ArcVertex> {
        points.iter().map(|&point| ArcVertex { point, bulge: 0.0 }).collect()
    };
    if tolerance <= 0.0 || points.len() < MIN_ARC_POINTS {
        return LineShape::Path(straight(&points), closed);
    }
    if closed && let Some(circle) = full_circle(&points, tolerance) {
        return LineShape::Circle(circle);
    }
    // Starts a closed line at a corner, so that its first point does not split an arc.
    let start = if closed { corner_index(&points, tolerance) } else { 0 };
    let mut ring: Vec<DVec2> = points[start..].iter().chain(&points[..start]).copied().collect();
    if closed {
        ring.push(ring[0]);
    }
    let vertices = arc_vertices(&ring, tolerance);
    if let [from, to] = vertices[..]
        && from.bulge != 0.0
        && !closed
        && let Some(circle) = circle_of(&ring, tolerance)
    {
        return LineShape::Arc(circle, arc_angles(circle, [from.point, to.point], from.bulge));
    }
    let mut vertices = vertices;
    if closed {
        vertices.pop();
    }
    LineShape::Path(vertices, closed)
}

/// Converts a grid point to a vector.
fn grid_point([x, y]: [i32; 2]) -> DVec2 {
    DVec2::new(f64::from(x), f64::from(y))
}

/// Returns the circle through a closed line, if all of its steps are equal.
fn full_circle(points: &[DVec2], tolerance: f64) -> Option<Circle> {
    let half = points.len() / 2;
    let near = fit_circle([points[0], points[half / 2], points[half]])?;
    let circle = best_circle(points, near.center)?;
    let mut ring = points.to_vec();
    ring.extend([points[0], points[1]]);
    let is_round = has_arc_steps(&ring, circle, tolerance);
    let turns = turn_sum(&ring[..=points.len()], circle);
    (is_round && (turns.abs() - core::f64::consts::TAU).abs() < 1e-6).then_some(circle)
}

/// Returns the sum of the angles of all steps about the center of a circle.
fn turn_sum(points: &[DVec2], circle: Circle) -> f64 {
    points.windows(2).map(|pair| step_angle(pair[0], pair[1], circle)).sum()
}

/// Returns the angle of a step about the center of a circle, from −π to π.
fn step_angle(from: DVec2, to: DVec2, circle: Circle) -> f64 {
    let (a, b) = (from - circle.center, to - circle.center);
    libm::atan2(a.perp_dot(b), a.dot(b))
}

/// Returns the index of a point on a closed line where an arc begins or ends, or 0 if there is no
/// such point.
fn corner_index(points: &[DVec2], tolerance: f64) -> usize {
    let count = points.len();
    let is_arc = |first: usize| {
        // Four points do not suffice, because the corners of an isosceles trapezoid are on a
        // circle.
        let five = [0, 1, 2, 3, 4].map(|k| points[(first + k) % count]);
        fit_circle([five[0], five[2], five[4]])
            .is_some_and(|circle| has_arc_steps(&five, circle, tolerance))
    };
    let is_corner = |index: &usize| {
        let ends = is_arc(index + count - 4) && !is_arc(index + count - 3);
        ends || is_arc(*index) && !is_arc(index + count - 1)
    };
    (0..count).find(is_corner).unwrap_or(0)
}

/// Returns the vertices for an open run of points. A greedy pass takes the longest arc from each
/// point.
fn arc_vertices(points: &[DVec2], tolerance: f64) -> Vec<ArcVertex> {
    let mut vertices = Vec::new();
    let mut at = 0;
    while at + 1 < points.len() {
        let (length, bulge) = longest_arc(&points[at..], tolerance).unwrap_or((1, 0.0));
        vertices.push(ArcVertex { point: points[at], bulge });
        at += length;
    }
    vertices.push(ArcVertex { point: points[points.len() - 1], bulge: 0.0 });
    vertices
}

/// Returns the number of steps of the longest arc that begins at the first point, and its bulge.
///
/// The run is extended in doubling steps while it is an arc, then bisection finds its end, in O(n
/// log n).
fn longest_arc(points: &[DVec2], tolerance: f64) -> Option<(usize, f64)> {
    let arc = |count: usize| {
        let run = points.get(..count)?;
        let circle = circle_of(run, tolerance)?;
        let sweep = turn_sum(run, circle);
        (sweep.abs() <= MAX_SWEEP).then(|| libm::tan(sweep * 0.25))
    };
    let mut best = (MIN_ARC_POINTS, arc(MIN_ARC_POINTS)?);
    let mut step = MIN_ARC_POINTS;
    let mut grows = true;
    while step > 0 {
        match arc(best.0 + step) {
            Some(bulge) => {
                best = (best.0 + step, bulge);
                step *= if grows { 2 } else { 1 };
            }
            None => grows = false,
        }
        if !grows {
            step /= 2;
        }
    }
    Some((best.0 - 1, best.1))
}

/// Returns the circle through a run of points, or `None` if they do not form an arc.
fn circle_of(points: &[DVec2], tolerance: f64) -> Option<Circle> {
    let last = points.len() - 1;
    let circle = fit_circle([points[0], points[last / 2], points[last]])
        .or_else(|| fit_circle([points[0], points[last / 3], points[2 * last / 3]]))?;
    let spread = points.iter().fold(0.0, |most: f64, point| most.max(point.distance(points[0])));
    let is_arc =
        circle.radius <= MAX_RADIUS_FACTOR * spread && has_arc_steps(points, circle, tolerance);
    is_arc.then_some(circle)
}

/// Whether the points of a run are on a circle and its steps form an arc. All steps must turn the
/// same way and, except for short steps and the first and last step, be equal.
fn has_arc_steps(points: &[DVec2], circle: Circle, tolerance: f64) -> bool {
    let is_on = |point: &DVec2| (point.distance(circle.center) - circle.radius).abs() <= tolerance;
    if !points.iter().all(is_on) {
        return false;
    }
    let angles: Vec<f64> =
        points.windows(2).map(|pair| step_angle(pair[0], pair[1], circle)).collect();
    let inner = &angles[1..angles.len() - 1];
    let longest = inner.iter().fold(0.0, |most: f64, angle| most.max(angle.abs()));
    let sense = if inner.iter().sum::<f64>() < 0.0 { -1.0 } else { 1.0 };
    // Rounding moves both ends of a step by up to 0.7 grid steps.
    let slack = longest * STEP_TOLERANCE + 2.0 / circle.radius;
    let is_short =
        |angle: f64| circle.radius * (1.0 - libm::cos(0.5 * angle)) <= tolerance && angle > 0.0;
    let mut turns = angles.iter().map(|angle| angle * sense);
    let [first, last] = [angles[0], angles[angles.len() - 1]].map(|angle| angle * sense);
    longest < MAX_STEP_DEGREES.to_radians()
        && [first, last].iter().all(|&end| end > 0.0 && end <= longest + slack || is_short(end))
        && turns.all(|turn| turn > 0.0)
        && inner.iter().all(|angle| longest - angle * sense <= slack || is_short(angle * sense))
}

/// Returns the circle through three points, or `None` if they are collinear.
fn fit_circle([a, b, c]: [DVec2; 3]) -> Option<Circle> {
    let (b, c) = (b - a, c - a);
    let doubled = 2.0 * b.perp_dot(c);
    let (bb, cc) = (b.length_squared(), c.length_squared());
    let center = DVec2::new(c.y * bb - b.y * cc, b.x * cc - c.x * bb) / doubled;
    let radius = center.length();
    (doubled != 0.0 && radius.is_finite()).then_some(Circle { center: a + center, radius })
}

/// Returns the least-squares circle through points (Kåsa 1976). For precision, `about` must be near
/// the center.
fn best_circle(points: &[DVec2], about: DVec2) -> Option<Circle> {
    let count = points.len() as f64;
    let mean = points.iter().fold(DVec2::ZERO, |sum, point| sum + (*point - about)) / count;
    let (mut xx, mut xy, mut yy, mut right) = (0.0, 0.0, 0.0, DVec2::ZERO);
    for point in points {
        let arm = *point - about - mean;
        (xx, xy, yy) = (xx + arm.x * arm.x, xy + arm.x * arm.y, yy + arm.y * arm.y);
        right += arm * (0.5 * arm.length_squared());
    }
    let determinant = xx * yy - xy * xy;
    let shift = DVec2::new(right.x * yy - right.y * xy, right.y * xx - right.x * xy) / determinant;
    let center = about + mean + shift;
    let radius = points.iter().map(|point| point.distance(center)).sum::<f64>() / count;
    (radius.is_finite() && radius > 0.0).then_some(Circle { center, radius })
}

/// Returns the angles of an arc's two endpoints. The second is larger by the angle of the arc.
fn arc_angles(circle: Circle, [from, to]: [DVec2; 2], bulge: f64) -> [f64; 2] {
    let angle = |point: DVec2| {
        let arm = point - circle.center;
        libm::atan2(arm.y, arm.x)
    };
    let sweep = 4.0 * libm::atan(bulge.abs());
    let start = if bulge > 0.0 { angle(from) } else { angle(to) };
    [start, start + sweep]
}

#[cfg(test)]
mod tests;
