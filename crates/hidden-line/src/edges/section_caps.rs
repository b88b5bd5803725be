//! Section caps: grouping of the loops of a cut into outlines with holes, and triangulation.
//!
//! ```text
//!   ┌──────────────┐ ↺ outline, area > 0
//!   │  ┌────────┐  │
//!   │  │ ↻ hole │  │   area < 0: belongs to the smallest outline around it
//!   │  │ ┌────┐ │  │
//!   │  │ │ ↺  │ │  │   an island is an outline again
//!   │  │ └────┘ │  │
//!   │  └────────┘  │
//!   └──────────────┘
//! ```
//!
//! Loops of a consistently oriented surface run counterclockwise around material and clockwise
//! around holes. Each outline is capped separately. Overlapping bodies of one object, which are
//! common in game models, get overlapping caps. An even-odd rule over all loops would instead cut
//! holes where the bodies overlap.

use clip::Outline;
use homog::{Plane, Point, World};

/// A closed loop in the section plane; the last point is joined to the first.
pub(super) type SectionLoop = Vec<Point<World>>;

/// The maximum number of points in the loops of one object: triangulation takes quadratic time.
const MAX_CAP_POINTS: usize = 1 << 14;

/// Triangulates the caps that one object's loops enclose, or returns `None` if there are more than
/// [`MAX_CAP_POINTS`] points.
pub(super) fn triangulate_caps(
    loops: Vec<SectionLoop>,
    plane: Plane<World>,
) -> Option<Vec<[Point<World>; 3]>> {
    if loops.iter().map(Vec::len).sum::<usize>() > MAX_CAP_POINTS {
        return None;
    }
    let regions = group_holes_with_outlines(loops, plane);
    let cap = |loops| Outline { loops, open: Vec::new() }.triangulate_cap(plane);
    Some(regions.into_iter().flat_map(cap).collect())
}

/// Groups loops by region: an outline first, then its holes.
///
/// The sign of the total area determines the orientation of the surface, so an object turned inside
/// out by a negative scale is also handled. A hole without an outline around it is a body modeled
/// inside out, and becomes an outline.
fn group_holes_with_outlines(
    loops: Vec<SectionLoop>,
    plane: Plane<World>,
) -> Vec<Vec<SectionLoop>> {
    let axes = PlaneAxes::dominant(plane);
    let mut outer: Vec<(f64, Vec<SectionLoop>)> = Vec::new();
    let mut holes: Vec<SectionLoop> = Vec::new();
    let areas: Vec<f64> = loops.iter().map(|points| axes.doubled_area(points)).collect();
    // A negative total area means that the surface is inside out, for example after a reflection.
    let sign = if areas.iter().sum::<f64>() < 0.0 { -1.0 } else { 1.0 };
    for (points, area) in loops.into_iter().zip(areas) {
        if area * sign < 0.0 {
            holes.push(points);
        } else {
            outer.push((area * sign, vec![points]));
        }
    }
    outer.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    for hole in holes {
        let around =
            outer.iter_mut().find(|(_, region)| axes.loop_contains_point(&region[0], hole[0]));
        match around {
            Some((_, region)) => region.push(hole),
            // A hole outside every outline is a body modeled inside out.
            None => outer.push((f64::INFINITY, vec![hole])),
        }
    }
    outer.into_iter().map(|(_, region)| region).collect()
}

/// Two-dimensional coordinates in a plane, along the two axes most nearly parallel to it.
///
/// The axis nearest to the normal is dropped. The other two are ordered so that loops have positive
/// areas if they run counterclockwise as seen from the tip of the normal. Unlike a rotation,
/// dropping an axis preserves the coordinates bit for bit.
struct PlaneAxes {
    axes: [usize; 2],
}

impl PlaneAxes {
    /// Chooses the axes for a plane by dropping the axis of the largest component of its normal.
    fn dominant(plane: Plane<World>) -> Self {
        let normal = plane.normal().raw().to_array();
        let size = normal.map(f64::abs);
        let left_out = (0..3).fold(0, |best, i| if size[i] > size[best] { i } else { best });
        let (u, v) = ((left_out + 1) % 3, (left_out + 2) % 3);
        Self { axes: if normal[left_out] < 0.0 { [v, u] } else { [u, v] } }
    }

    /// Returns the two coordinates of a point.
    fn plane_coordinates(&self, point: Point<World>) -> [f64; 2] {
        self.axes.map(|axis| point.raw()[axis])
    }

    /// Returns twice the signed area of a loop (shoelace formula), relative to its first point to
    /// avoid cancellation far from the origin.
    fn doubled_area(&self, points: &[Point<World>]) -> f64 {
        let [x, y] = self.plane_coordinates(points[0]);
        let from = |point| {
            let [px, py] = self.plane_coordinates(point);
            [px - x, py - y]
        };
        let turn = |pair: &[Point<World>]| {
            let ([ax, ay], [bx, by]) = (from(pair[0]), from(pair[1]));
            ax * by - ay * bx
        };
        points.windows(2).map(turn).sum()
    }

    /// Whether a loop contains a point: a ray from the point along the first axis crosses the loop
    /// an odd number of times (Jordan curve theorem).
    fn loop_contains_point(&self, points: &[Point<World>], point: Point<World>) -> bool {
        let [x, y] = self.plane_coordinates(point);
        let ends = points.iter().zip(points.iter().cycle().skip(1));
        ends.fold(false, |inside, (a, b)| {
            let ([x0, y0], [x1, y1]) = (self.plane_coordinates(*a), self.plane_coordinates(*b));
            let crosses = (y0 > y) != (y1 > y);
            inside ^ (crosses && x < x0 + (y - y0) / (y1 - y0) * (x1 - x0))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use homog::Normal;

    fn square_loop(x: f64, r: f64, turns_left: bool) -> SectionLoop {
        let mut vertices =
            [[-r, -r], [r, -r], [r, r], [-r, r]].map(|[a, b]| Point::new(x + a, b, 5.0));
        if !turns_left {
            vertices.reverse();
        }
        vertices.to_vec()
    }

    fn cap_area(loops: Vec<SectionLoop>) -> f64 {
        let plane = Plane::through(Point::new(0.0, 0.0, 5.0), Normal::new(0.0, 0.0, 1.0));
        let area = |[a, b, c]: [Point<World>; 3]| (b - a).cross(c - a).length() / 2.0;
        triangulate_caps(loops, plane).expect("few points").into_iter().map(area).sum()
    }

    #[test]
    fn holes_stay_open_and_islands_in_them_are_filled() {
        let frame = vec![
            square_loop(0.0, 3.0, true),
            square_loop(0.0, 2.0, false),
            square_loop(0.0, 1.0, true),
        ];
        assert_eq!(cap_area(frame), 36.0 - 16.0 + 4.0);
    }

    #[test]
    fn overlapping_bodies_are_both_filled() {
        // Two crossing bodies, then one body inside the other.
        assert_eq!(cap_area(vec![square_loop(0.0, 2.0, true), square_loop(3.0, 2.0, true)]), 32.0);
        assert_eq!(cap_area(vec![square_loop(0.0, 2.0, true), square_loop(0.0, 1.0, true)]), 20.0);
    }

    #[test]
    fn inside_out_surfaces_get_the_same_caps() {
        assert_eq!(
            cap_area(vec![square_loop(0.0, 3.0, false), square_loop(0.0, 2.0, true)]),
            36.0 - 16.0
        );
        assert_eq!(cap_area(vec![square_loop(0.0, 2.0, true), square_loop(9.0, 1.0, false)]), 20.0);
    }

    #[test]
    fn too_many_points_are_rejected() {
        let plane = Plane::through(Point::ORIGIN, Normal::new(0.0, 0.0, 1.0));
        assert_eq!(triangulate_caps(vec![vec![Point::ORIGIN; MAX_CAP_POINTS + 1]], plane), None);
    }
}
