//! Caps: triangulated cut faces of sections.
//!
//! ```text
//!   ┌───────────────┐        A hole is joined to its outline by a bridge that is walked twice,
//!   │   ┌───┐       │        which leaves one ring. Ears are then cut from it: corners whose
//!   │   │   ●───────●        triangle contains no other corner of the ring (Meisters, 1975;
//!   │   └───┘       │        bridges as in Eberly, 1998).
//!   └───────────────┘
//! ```
//!
//! Only points of the outline become corners, so the cap meets the sides of the solid without
//! cracks.

use crate::Outline;
use alloc::vec::Vec;
use homog::{Plane, Point, Space};

impl<S: Space> Outline<S> {
    /// Returns the triangles of the cut face. They are counterclockwise as seen from the removed
    /// side; the normal of the plane points to the other side.
    ///
    /// Areas within an odd number of loops are filled, and the direction of a loop does not matter
    /// (even-odd rule). If loops cross each other, which never happens for a solid, they are only
    /// partly filled. The time grows with the square of the number of points.
    ///
    /// ```
    /// use clip::Outline;
    /// use homog::{Normal, Plane, Point, World};
    /// let corner = |x: f64, y: f64| Point::<World>::new(x, y, 0.0);
    /// let square = |r: f64| vec![corner(-r, -r), corner(r, -r), corner(r, r), corner(-r, r)];
    /// let frame = Outline { loops: vec![square(2.0), square(1.0)], open: vec![] };
    /// let cap = frame.triangulate_cap(Plane::through(Point::ORIGIN, Normal::new(0.0, 0.0, -1.0)));
    /// let area = |[a, b, c]: [Point<World>; 3]| (b - a).cross(c - a).z() / 2.0;
    /// assert_eq!(cap.into_iter().map(area).sum::<f64>(), 16.0 - 4.0);
    /// ```
    #[must_use]
    pub fn triangulate_cap(&self, plane: Plane<S>) -> Vec<[Point<S>; 3]> {
        let chart = PlanarPoints::project_loops(&self.loops, plane);
        let mut triangles = Vec::new();
        for ring in chart.outer_rings(&self.loops) {
            chart.clip_ears(ring, &mut triangles);
        }
        let points: Vec<Point<S>> = self.loops.iter().flatten().copied().collect();
        triangles.into_iter().map(|corners| corners.map(|i| points[i])).collect()
    }
}

/// All points of the outline in two coordinates of the plane, oriented as seen from the removed
/// side.
struct PlanarPoints {
    points: Vec<[f64; 2]>,
}

/// The indices of points.
type VertexRing = Vec<usize>;

impl PlanarPoints {
    /// Drops the axis nearest to the normal, and swaps the others if the view would be from the
    /// wrong side.
    fn project_loops<S: Space>(loops: &[Vec<Point<S>>], plane: Plane<S>) -> Self {
        let normal = plane.normal().raw().to_array();
        let size = normal.map(f64::abs);
        let left_out = (0..3).fold(0, |best, i| if size[i] > size[best] { i } else { best });
        let (u, v) = ((left_out + 1) % 3, (left_out + 2) % 3);
        let (u, v) = if normal[left_out] > 0.0 { (v, u) } else { (u, v) };
        let place = |point: &Point<S>| [point.raw()[u], point.raw()[v]];
        Self { points: loops.iter().flatten().map(place).collect() }
    }

    /// Returns twice the signed area of a triangle: positive if its corners are counterclockwise.
    fn signed_area(&self, [a, b, c]: [usize; 3]) -> f64 {
        let [a, b, c] = [a, b, c].map(|i| self.points[i]);
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    }

    fn ring_area(&self, ring: &[usize]) -> f64 {
        let Some(&first) = ring.first() else { return 0.0 };
        ring.windows(2).map(|edge| self.signed_area([first, edge[0], edge[1]])).sum()
    }

    /// Returns whether a ray from the point to the right meets the ring an odd number of times.
    fn ring_contains(&self, ring: &[usize], point: usize) -> bool {
        let [x, y] = self.points[point];
        ring_edges(ring).fold(false, |inside, (i, j)| {
            let ([x0, y0], [x1, y1]) = (self.points[i], self.points[j]);
            let crosses = (y0 > y) != (y1 > y);
            inside ^ (crosses && x < x0 + (y - y0) / (y1 - y0) * (x1 - x0))
        })
    }

    /// Returns one counterclockwise ring for each outline that is not a hole, joined with its
    /// holes.
    fn outer_rings<S: Space>(&self, loops: &[Vec<Point<S>>]) -> Vec<VertexRing> {
        let mut start = 0;
        let numbered = loops.iter().map(|points| {
            start += points.len();
            (start - points.len()..start).collect::<VertexRing>()
        });
        let loops: Vec<VertexRing> = numbered.filter(|ring| ring.len() >= 3).collect();
        // Loops of a solid do not touch, so one point of a loop represents all of it.
        let encloses = |i: usize, j: usize| i != j && self.ring_contains(&loops[i], loops[j][0]);
        let all = 0..loops.len();
        let depth = |j: usize| all.clone().filter(|&i| encloses(i, j)).count();
        let depths: Vec<usize> = all.clone().map(depth).collect();
        let joined = all.clone().filter(|&i| depths[i] % 2 == 0).map(|i| {
            let holes = all.clone().filter(|&j| depths[j] == depths[i] + 1 && encloses(i, j));
            let holes = holes.map(|j| self.orient_ring(&loops[j], -1.0)).collect();
            self.join_holes(self.orient_ring(&loops[i], 1.0), holes)
        });
        joined.collect()
    }

    fn orient_ring(&self, ring: &[usize], sign: f64) -> VertexRing {
        let mut ring = ring.to_vec();
        if self.ring_area(&ring) * sign < 0.0 {
            ring.reverse();
        }
        ring
    }

    /// Joins holes to their outline, starting with the rightmost, so no bridge crosses a hole that
    /// is not joined yet.
    fn join_holes(&self, mut outline: VertexRing, mut holes: Vec<VertexRing>) -> VertexRing {
        let x = |&i: &usize| self.points[i][0];
        for hole in &mut holes {
            let by_x = |&a: &usize, &b: &usize| x(&hole[a]).total_cmp(&x(&hole[b]));
            let rightmost = (0..hole.len()).max_by(by_x).unwrap_or(0);
            hole.rotate_left(rightmost);
        }
        holes.sort_by(|a, b| x(&b[0]).total_cmp(&x(&a[0])));
        for hole in holes {
            let Some(at) = self.find_bridge(&outline, hole[0]) else { continue };
            let back = [hole[0], outline[at]];
            let bridged: VertexRing = outline[..=at]
                .iter()
                .chain(&hole)
                .chain(&back)
                .chain(&outline[at + 1..])
                .copied()
                .collect();
            outline = bridged;
        }
        outline
    }

    /// Returns the index in the outline of a corner visible from a point inside. A ray from the
    /// point to the right meets some edge first. The corner is the right end of that edge, or a
    /// corner that hides that end.
    fn find_bridge(&self, outline: &[usize], point: usize) -> Option<usize> {
        let [x, y] = self.points[point];
        let mut nearest: Option<(f64, usize)> = None;
        for (at, (i, j)) in ring_edges(outline).enumerate() {
            let ([x0, y0], [x1, y1]) = (self.points[i], self.points[j]);
            // The outline is counterclockwise, so the edges to the right go upward.
            if !(y0 <= y && y < y1) {
                continue;
            }
            let meets = x0 + (y - y0) / (y1 - y0) * (x1 - x0);
            if meets >= x && nearest.is_none_or(|(best, _)| meets < best) {
                let end = if x0 > x1 { at } else { (at + 1) % outline.len() };
                nearest = Some((meets, end));
            }
        }
        let (meets, end) = nearest?;
        Some(self.blocking_vertex(outline, point, meets, end).unwrap_or(end))
    }

    /// Returns the corner at the smallest angle from straight right, among the reflex corners
    /// within a triangle. The triangle is formed by the point, the point where the ray meets the
    /// edge, and the end of that edge.
    fn blocking_vertex(
        &self,
        outline: &[usize],
        point: usize,
        meets: f64,
        end: usize,
    ) -> Option<usize> {
        let ([x, y], [ex, ey]) = (self.points[point], self.points[outline[end]]);
        let inside = |[px, py]: [f64; 2]| {
            let side = |a: [f64; 2], b: [f64; 2]| {
                (b[0] - a[0]) * (py - a[1]) - (b[1] - a[1]) * (px - a[0])
            };
            let sides =
                [side([x, y], [meets, y]), side([meets, y], [ex, ey]), side([ex, ey], [x, y])];
            px > x && (sides.iter().all(|&s| s >= 0.0) || sides.iter().all(|&s| s <= 0.0))
        };
        let slope = |at: usize| {
            let [px, py] = self.points[outline[at]];
            (py - y).abs() / (px - x)
        };
        let others = (0..outline.len()).filter(|&at| at != end && inside(self.points[outline[at]]));
        let reflex = others.filter(|&at| self.signed_area(ring_corner(outline, at)) < 0.0);
        reflex.min_by(|&a, &b| slope(a).total_cmp(&slope(b)))
    }

    /// Clips ears until nothing is left.
    fn clip_ears(&self, mut ring: VertexRing, triangles: &mut Vec<[usize; 3]>) {
        let (mut at, mut refused) = (0, 0);
        while ring.len() > 2 {
            at %= ring.len();
            // After a full round without an ear, only flat corners are left, or the loops cross.
            let stuck = refused > ring.len();
            let ear = ring_corner(&ring, at);
            if stuck || self.is_ear(&ring, ear) {
                if self.signed_area(ear) > 0.0 {
                    triangles.push(ear);
                }
                ring.remove(at);
                refused = 0;
                // Advancing by two makes fans less likely.
                at += 1;
            } else {
                refused += 1;
                at += 1;
            }
        }
    }

    fn is_ear(&self, ring: &[usize], ear: [usize; 3]) -> bool {
        let is_corner = |i: usize| ear.iter().any(|&corner| self.points[corner] == self.points[i]);
        let within = |i: usize| {
            let [a, b, c] = ear;
            [[a, b, i], [b, c, i], [c, a, i]].into_iter().all(|side| self.signed_area(side) >= 0.0)
        };
        self.signed_area(ear) > 0.0 && !ring.iter().any(|&i| !is_corner(i) && within(i))
    }
}

/// Returns the edges of a ring, as indices of their points.
fn ring_edges(ring: &[usize]) -> impl Iterator<Item = (usize, usize)> {
    ring.iter().copied().zip(ring.iter().copied().cycle().skip(1))
}

/// Returns a corner with the points before and after it.
fn ring_corner(ring: &[usize], at: usize) -> [usize; 3] {
    let count = ring.len();
    [ring[(at + count - 1) % count], ring[at], ring[(at + 1) % count]]
}
