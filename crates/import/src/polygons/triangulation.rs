//! Triangulation of polygons in space by ear clipping.
//!
//! A polygon with n corners becomes n − 2 triangles that use its corners. It is projected along the
//! axis of the largest component of its normal (Newell's method) and then triangulated with exact
//! predicates. It may be concave or slightly nonplanar, and may have collinear or repeated corners,
//! and holes joined by bridges. Self-intersecting polygons have no triangulation; once no ear is
//! left, the rest becomes a fan.
//!
//! Sources: G. H. Meisters, *Polygons Have Ears*, 1975; for the normal, I. E. Sutherland, R. F.
//! Sproull, R. A. Schumacker, *A Characterization of Ten Hidden-Surface Algorithms*, 1974, who
//! credit M. Newell.

use super::orientation::orient2d;

/// Maximum number of point-in-triangle tests for all polygons of a file. That number takes about
/// 0.1 s.
///
/// An ear is tested only against the reflex corners within its range along the polygon's longer
/// axis, so that even large ordinary polygons take only a few tests per corner. Contrived polygons
/// can take n² tests.
const MAX_POINT_TESTS: u64 = 1 << 24;

/// The cost of examining a corner, in tests, whether or not it is an ear.
const TESTS_PER_STEP: u64 = 4;

/// The outcome of triangulating a polygon.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum PolygonKind {
    /// The triangles have the polygon's winding, and cover each part of the polygon as often as it
    /// winds around that part. Where corners coincide or are collinear, triangles may have no area.
    Simple,
    /// The polygon has no area, and becomes a fan of triangles without area.
    Flat,
    /// The polygon intersects itself or is too complex for the test limit, so at least part of it
    /// is a fan.
    Fan,
}

/// Triangulates polygons. The buffers are reused for each polygon.
#[derive(Debug)]
pub(crate) struct Triangulator {
    /// The projected corners, in counterclockwise order.
    points: Vec<[f64; 2]>,
    /// For each corner, the previous corner that has not been clipped.
    previous: Vec<u32>,
    /// For each corner, the next corner that has not been clipped.
    next: Vec<u32>,
    /// Whether each corner has not been clipped and is reflex or collinear.
    is_reflex: Vec<bool>,
    /// The axis of the plane along which the polygon is longer.
    long_axis: usize,
    /// The initially reflex corners with their points, sorted along the longer axis.
    reflex_in_order: Vec<([f64; 2], u32)>,
    /// The remaining number of tests for this file; see [`MAX_POINT_TESTS`].
    tests_left: u64,
}

impl Default for Triangulator {
    /// Returns a triangulator for the polygons of one file.
    fn default() -> Self {
        Self {
            points: Vec::new(),
            previous: Vec::new(),
            next: Vec::new(),
            is_reflex: Vec::new(),
            long_axis: 0,
            reflex_in_order: Vec::new(),
            tests_left: MAX_POINT_TESTS,
        }
    }
}

impl Triangulator {
    /// Appends the triangles of a polygon, with the polygon's winding, as corner indices from 0.
    ///
    /// A polygon with n corners always gives n − 2 triangles, or none if n is less than 3.
    /// Positions must be finite.
    pub(crate) fn triangulate(
        &mut self,
        corners: &[[f32; 3]],
        triangles: &mut Vec<[u32; 3]>,
    ) -> PolygonKind {
        let count = corners.len() as u32;
        if count < 4 {
            triangles.extend((count == 3).then_some([0, 1, 2]));
            return PolygonKind::Simple;
        }
        if !self.project(corners) {
            push_fan(0..count, triangles);
            return PolygonKind::Flat;
        }
        if self.is_visible_from_first() {
            push_fan(0..count, triangles);
            return PolygonKind::Simple;
        }
        self.link_corners();
        self.cut_ears(triangles)
    }

    /// Projects the corners along the largest component of the normal, in counterclockwise order.
    /// Returns `false` if there is no normal.
    fn project(&mut self, corners: &[[f32; 3]]) -> bool {
        let normal = newell_normal(corners);
        let axis = (0..3).fold(
            0,
            |most, at| {
                if normal[at].abs() > normal[most].abs() { at } else { most }
            },
        );
        if normal[axis] == 0.0 {
            return false;
        }
        let (mut right, mut up) = ((axis + 1) % 3, (axis + 2) % 3);
        if normal[axis] < 0.0 {
            (right, up) = (up, right);
        }
        self.points.clear();
        self.points.extend(corners.iter().map(|at| [at[right], at[up]].map(f64::from)));
        true
    }

    /// Returns whether the fan around the first corner is a triangulation, that is, whether the
    /// other corners are in counterclockwise order around it, within half a turn.
    ///
    /// This is true for all strictly convex polygons, which are the vast majority.
    fn is_visible_from_first(&self) -> bool {
        let [first, second, rest @ ..] = self.points.as_slice() else { return false };
        let mut before = second;
        rest.iter().all(|point| {
            let turns_left = orient2d(*first, *before, *point) > 0.0;
            before = point;
            turns_left && orient2d(*first, *second, *point) > 0.0
        })
    }

    /// Builds the ring of corners and the list of reflex corners.
    fn link_corners(&mut self) {
        let count = self.points.len() as u32;
        self.previous.clear();
        self.previous.extend((0..count).map(|at| if at == 0 { count - 1 } else { at - 1 }));
        self.next.clear();
        self.next.extend((0..count).map(|at| if at + 1 == count { 0 } else { at + 1 }));
        self.is_reflex.clear();
        for at in 0..count {
            let is_reflex = self.turn_at(at) <= 0.0;
            self.is_reflex.push(is_reflex);
        }
        self.long_axis = long_axis(&self.points);
        let Self { points, is_reflex, long_axis: axis, reflex_in_order, .. } = self;
        reflex_in_order.clear();
        let reflex = (0..count).filter(|&at| is_reflex[at as usize]);
        reflex_in_order.extend(reflex.map(|at| (points[at as usize], at)));
        reflex_in_order.sort_by(|(a, _), (b, _)| a[*axis].total_cmp(&b[*axis]));
    }

    /// Clips ears until one triangle is left. Without an ear, a collinear corner is clipped;
    /// without a collinear corner, the rest becomes a fan.
    fn cut_ears(&mut self, triangles: &mut Vec<[u32; 3]>) -> PolygonKind {
        let (mut at, mut remaining, mut since_cut) = (0_u32, self.points.len(), 0_usize);
        while remaining > 3 {
            let may_be_flat = since_cut >= remaining;
            if since_cut >= 2 * remaining || self.tests_left == 0 {
                push_fan(self.ring(at), triangles);
                return PolygonKind::Fan;
            }
            self.tests_left = self.tests_left.saturating_sub(TESTS_PER_STEP);
            let turn = self.turn_at(at);
            let is_flat = turn == 0.0 && (may_be_flat || self.is_spike(at));
            if is_flat || (turn > 0.0 && self.is_ear(at)) {
                triangles.push(self.cut(at));
                (remaining, since_cut) = (remaining - 1, 0);
                // Advance two steps, so that a row of ears does not become a fan of slivers.
                at = self.next[at as usize];
            } else {
                since_cut += 1;
            }
            at = self.next[at as usize];
        }
        let is_folded = self.turn_at(at) < 0.0;
        push_fan(self.ring(at), triangles);
        if is_folded { PolygonKind::Fan } else { PolygonKind::Simple }
    }

    /// Removes a corner from the ring and returns its triangle.
    fn cut(&mut self, at: u32) -> [u32; 3] {
        let (before, after) = (self.previous[at as usize], self.next[at as usize]);
        self.next[before as usize] = after;
        self.previous[after as usize] = before;
        self.is_reflex[at as usize] = false;
        for neighbor in [before, after] {
            // A convex corner stays convex, except perhaps in a self-intersecting polygon.
            if self.is_reflex[neighbor as usize] {
                self.is_reflex[neighbor as usize] = self.turn_at(neighbor) <= 0.0;
            }
        }
        [before, at, after]
    }

    /// Returns twice the signed area of the triangle at a remaining corner, which is positive if
    /// the corner is convex.
    fn turn_at(&self, at: u32) -> f64 {
        let [a, b, c] = self.ear_triangle(at);
        orient2d(a, b, c)
    }

    /// Returns the triangle that clipping a corner would remove.
    fn ear_triangle(&self, at: u32) -> [[f64; 2]; 3] {
        let around = [self.previous[at as usize], at, self.next[at as usize]];
        around.map(|corner| self.points[corner as usize])
    }

    /// Returns whether the edge to a collinear corner doubles back on itself or has no length.
    fn is_spike(&self, at: u32) -> bool {
        let [a, b, c] = self.ear_triangle(at);
        let is_between = |k: usize| a[k].min(c[k]) <= b[k] && b[k] <= a[k].max(c[k]);
        b == a || b == c || !is_between(0) || !is_between(1)
    }

    /// Returns whether the triangle at a convex corner, including its edges, contains no other
    /// corner.
    ///
    /// Corners at the same position as a corner of the triangle are ignored, because they are the
    /// ends of bridges to holes. Only reflex corners need a test: of the corners in the triangle,
    /// the one farthest from the edge that clipping would add is reflex.
    fn is_ear(&mut self, at: u32) -> bool {
        let [a, b, c] = self.ear_triangle(at);
        let [low, high] = [f64::min, f64::max].map(|f| [0, 1].map(|k| f(f(a[k], b[k]), c[k])));
        let axis = self.long_axis;
        let from = self.reflex_in_order.partition_point(|(p, _)| p[axis] < low[axis]);
        let mut tests = 1;
        let mut is_blocked = false;
        for &(p, other) in &self.reflex_in_order[from..] {
            tests += 1;
            if p[axis] > high[axis] || is_blocked {
                break;
            }
            is_blocked = p[1 - axis] >= low[1 - axis]
                && p[1 - axis] <= high[1 - axis]
                && self.is_reflex[other as usize]
                && ![a, b, c].contains(&p)
                && orient2d(a, b, p) >= 0.0
                && orient2d(b, c, p) >= 0.0
                && orient2d(c, a, p) >= 0.0;
        }
        self.tests_left = self.tests_left.saturating_sub(tests);
        !is_blocked
    }

    /// Returns the remaining corners in order, starting at one of them.
    fn ring(&self, from: u32) -> impl Iterator<Item = u32> + use<'_> {
        let after = move |at: &u32| Some(self.next[*at as usize]).filter(|next| *next != from);
        std::iter::successors(Some(from), after)
    }
}

/// Returns the axis along which the points extend farther.
fn long_axis(points: &[[f64; 2]]) -> usize {
    let extent = |axis: usize| {
        let values = || points.iter().map(|point| point[axis]);
        values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min)
    };
    usize::from(extent(1) > extent(0))
}

/// Appends the triangles between the first corner and each edge not adjacent to it.
fn push_fan(corners: impl IntoIterator<Item = u32>, triangles: &mut Vec<[u32; 3]>) {
    let mut corners = corners.into_iter();
    let (Some(first), Some(mut before)) = (corners.next(), corners.next()) else { return };
    for corner in corners {
        triangles.push([first, before, corner]);
        before = corner;
    }
}

/// Returns the sum of the cross products of a polygon's edges: the polygon's normal, with a length
/// of twice the area.
fn newell_normal(corners: &[[f32; 3]]) -> [f64; 3] {
    let mut normal = [0.0; 3];
    let Some(origin) = corners.first().map(|at| at.map(f64::from)) else { return normal };
    // Coordinates are relative to the first corner, so a small distant polygon loses no precision.
    let from_origin = |at: &[f32; 3]| -> [f64; 3] {
        std::array::from_fn(|axis| f64::from(at[axis]) - origin[axis])
    };
    let mut a = [0.0; 3];
    for b in corners.iter().map(from_origin) {
        normal[0] += a[1] * b[2] - a[2] * b[1];
        normal[1] += a[2] * b[0] - a[0] * b[2];
        normal[2] += a[0] * b[1] - a[1] * b[0];
        a = b;
    }
    normal
}

#[cfg(test)]
mod tests;
