//! Region outlines: simple closed loops around an area, which may touch but never cross.
//!
//! ```text
//!   ┌───────┐              ┌───────┐
//!   │   ┌───┼───┐          │       └───┐
//!   │   │   │   │    ─►    │           │      sides within the area are removed,
//!   └───┼───┘   │          └───┐       │      and the others are joined into loops
//!       └───────┘              └───────┘
//! ```
//!
//! 1. Sides are placed on the grid of the page and cut where they cross. Crossings are rounded to
//!    the grid too, and every side that passes through the grid cell of a point is routed through
//!    that point. This is snap rounding (Hobby 1999), which adds no crossings. It is repeated until
//!    no crossings remain.
//! 2. The winding number next to a side is the number of faces there, counted along a ray in
//!    integer arithmetic. A side is part of the outline if there are faces on exactly one side of
//!    it.
//! 3. At each point, as many outline sides begin as end, so they form loops. Each loop keeps the
//!    area on its left and is divided where it touches itself.
//!
//! The number of crossings between random triangles grows with the square of the number of
//! triangles. If there are too many crossings, the area is sampled on a fine grid, and its border
//! follows the cells of the grid.

mod coverage;

use coverage::traced_border;
use page::{PagePoint, Polyline};
use std::collections::BTreeMap;

/// A point in micrometers.
type Point = [i64; 2];

/// A side from its smaller to its larger end in sort order, and its multiplicity.
type Side = ([Point; 2], i32);

/// The maximum number of snap rounding passes; normally one or two remove all crossings.
const MAX_ROUNDS: usize = 8;

/// The mean width, in micrometers, below which a loop is a gap between faces.
const MIN_WIDTH: f64 = 2.0;

/// Returns the loops around the area enclosed by sides, which must form closed curves. With x to
/// the right and y up, loops are counterclockwise around material and clockwise around holes.
pub(super) fn outline_loops(sides: impl Iterator<Item = ([PagePoint; 2], i32)>) -> Vec<Polyline> {
    let widen = |point: PagePoint| point.map(i64::from);
    let mut sides = merge_sides(sides.map(|(ends, sign)| (ends.map(widen), sign)).collect());
    let border = match find_crossings(&sides) {
        None => traced_border(&sides),
        Some(mut crossings) => {
            for _ in 0..MAX_ROUNDS {
                if crossings.is_empty() {
                    break;
                }
                sides = snap_to_points(&sides, crossings);
                // The limit grows with the number of pieces, and pieces rarely cross, so it is not
                // exceeded here.
                crossings = find_crossings(&sides).unwrap_or_default();
            }
            border_sides(&sides)
        }
    };
    let loops = join_loops(&border);
    loops.iter().filter_map(|points| finish_loop(points)).collect()
}

/// Whether sides cross so often that the outline is traced on a grid.
pub(super) fn is_traced(sides: impl Iterator<Item = ([PagePoint; 2], i32)>) -> bool {
    let widen = |point: PagePoint| point.map(i64::from);
    let sides = merge_sides(sides.map(|(ends, sign)| (ends.map(widen), sign)).collect());
    find_crossings(&sides).is_none()
}

/// The maximum number of crossings of an exact outline, without [`CROSSINGS_PER_SIDE`] per side.
const ANY_CROSSINGS: usize = 1 << 14;
/// The additional crossings for each side; see [`ANY_CROSSINGS`].
const CROSSINGS_PER_SIDE: usize = 8;

/// Orients sides from the smaller to the larger end, adds up the multiplicities of equal sides, and
/// drops sides that cancel out.
fn merge_sides(mut sides: Vec<Side>) -> Vec<Side> {
    for (ends, sign) in &mut sides {
        if ends[0] > ends[1] {
            ends.swap(0, 1);
            *sign = -*sign;
        }
    }
    sides.retain(|([a, b], _)| a != b);
    sides.sort_unstable();
    let sums = sides.chunk_by(|a, b| a.0 == b.0);
    let sums = sums.map(|same| (same[0].0, same.iter().map(|(_, sign)| sign).sum::<i32>()));
    sums.filter(|(_, sign)| *sign != 0).collect()
}

/// Returns the cross product of the vectors from `from` to `a` and to `b`.
fn cross(from: Point, a: Point, b: Point) -> i128 {
    let [a, b] = [a, b].map(|to| [0, 1].map(|axis| i128::from(to[axis] - from[axis])));
    a[0] * b[1] - a[1] * b[0]
}

/// Finds the points, rounded to the grid, where sides cross or touch, except at common ends.
/// Includes ends that are on other sides. Returns `None` if there are too many points.
///
/// Sweeps along x over the sides, sorted by their smaller ends.
fn find_crossings(sides: &[Side]) -> Option<Vec<Point>> {
    let most = ANY_CROSSINGS + CROSSINGS_PER_SIDE * sides.len();
    let mut crossings = Vec::new();
    let mut active: Vec<usize> = Vec::new();
    for (index, (ends, _)) in sides.iter().enumerate() {
        active.retain(|&other| sides[other].0[1][0] >= ends[0][0]);
        let (low, high) = (ends[0][1].min(ends[1][1]), ends[0][1].max(ends[1][1]));
        for &other in &active {
            let other = &sides[other].0;
            if other[0][1].max(other[1][1]) >= low && other[0][1].min(other[1][1]) <= high {
                add_crossings(*ends, *other, &mut crossings);
            }
        }
        active.push(index);
        if crossings.len() > most {
            return None;
        }
    }
    crossings.sort_unstable();
    crossings.dedup();
    Some(crossings)
}

/// Adds the point where two sides meet, unless it is an end of both.
fn add_crossings([a, b]: [Point; 2], [c, d]: [Point; 2], crossings: &mut Vec<Point>) {
    let [from_c, from_d] = [cross(a, b, c), cross(a, b, d)];
    let [from_a, from_b] = [cross(c, d, a), cross(c, d, b)];
    let apart = |one: i128, other: i128| one > 0 && other > 0 || one < 0 && other < 0;
    if apart(from_c, from_d) || apart(from_a, from_b) {
        return;
    }
    if from_c == from_d {
        // For collinear sides, adds the ends of each side that are on the other.
        let on = |point: Point, [low, high]: [Point; 2]| low < point && point < high;
        crossings.extend([c, d].into_iter().filter(|&end| from_c == 0 && on(end, [a, b])));
        crossings.extend([a, b].into_iter().filter(|&end| from_c == 0 && on(end, [c, d])));
        return;
    }
    let (part, whole) = (from_a, from_a - from_b);
    let at = [0, 1].map(|axis| {
        let span = i128::from(b[axis] - a[axis]) * part;
        let (doubled, whole) = if whole < 0 { (-2 * span, -whole) } else { (2 * span, whole) };
        a[axis] + (doubled + whole).div_euclid(2 * whole) as i64
    });
    let is_end = |ends: [Point; 2]| ends.contains(&at);
    if !(is_end([a, b]) && is_end([c, d])) {
        crossings.push(at);
    }
}

/// Routes every side through all ends and crossings whose grid cells it passes through.
fn snap_to_points(sides: &[Side], crossings: Vec<Point>) -> Vec<Side> {
    let mut points = crossings;
    points.extend(sides.iter().flat_map(|(ends, _)| *ends));
    let columns = PointColumns::new(points);
    let mut pieces = Vec::with_capacity(sides.len());
    for &(ends, sign) in sides {
        let path = columns.points_on(ends);
        pieces.extend(path.windows(2).map(|pair| ([pair[0], pair[1]], sign)));
    }
    merge_sides(pieces)
}

/// Points in columns of equal width, sorted by y within each column.
struct PointColumns {
    columns: BTreeMap<i64, Vec<Point>>,
    width: i64,
}

impl PointColumns {
    fn new(mut points: Vec<Point>) -> Self {
        points.sort_unstable();
        points.dedup();
        let span = points.last().zip(points.first()).map_or(0, |(last, first)| last[0] - first[0]);
        let count = libm::sqrt(points.len() as f64) as i64 + 1;
        let width = span / count + 1;
        let mut columns: BTreeMap<i64, Vec<Point>> = BTreeMap::new();
        for point in points {
            columns.entry(point[0].div_euclid(width)).or_default().push(point);
        }
        columns.values_mut().for_each(|column| column.sort_unstable_by_key(|[x, y]| [*y, *x]));
        Self { columns, width }
    }

    /// Returns the points whose cells a side passes through, from one end of the side to the other.
    fn points_on(&self, [a, b]: [Point; 2]) -> Vec<Point> {
        let along = [b[0] - a[0], b[1] - a[1]];
        let columns = (a[0] - 1).div_euclid(self.width)..=(b[0] + 1).div_euclid(self.width);
        let mut found = Vec::new();
        for (&column, points) in self.columns.range(columns) {
            let [low, high] = self.heights_in_column([a, b], column);
            let first = points.partition_point(|[_, y]| *y < low);
            let near = points[first..].iter().take_while(|[_, y]| *y <= high);
            found.extend(near.copied().filter(|&point| passes_cell([a, b], point)));
        }
        let position = |point: Point| -> i128 {
            (0..2).map(|axis| i128::from(point[axis] - a[axis]) * i128::from(along[axis])).sum()
        };
        found.sort_by_key(|&point| (position(point), point));
        // The ends are placed explicitly, because other points in their cells may be just as far
        // along the side.
        found.retain(|point| *point != a && *point != b);
        found.insert(0, a);
        found.push(b);
        found
    }

    /// Returns the minimum and maximum y of a side in a column, with a margin of at least one cell.
    fn heights_in_column(&self, [a, b]: [Point; 2], column: i64) -> [i64; 2] {
        if a[0] == b[0] {
            return [a[1].min(b[1]) - 1, a[1].max(b[1]) + 1];
        }
        let at = |x: i64| {
            let x = x.clamp(a[0], b[0]);
            let rise = i128::from(b[1] - a[1]) * i128::from(x - a[0]);
            a[1] + rise.div_euclid(i128::from(b[0] - a[0])) as i64
        };
        let ends = [at(column * self.width - 1), at((column + 1) * self.width + 1)];
        [ends[0].min(ends[1]) - 2, ends[0].max(ends[1]) + 2]
    }
}

/// Whether a side passes through the cell of a point: the square of one grid step around it.
fn passes_cell([a, b]: [Point; 2], point: Point) -> bool {
    let is_beside = |axis: usize| {
        let (low, high) = (a[axis].min(b[axis]), a[axis].max(b[axis]));
        point[axis] < low || point[axis] > high
    };
    if is_beside(0) || is_beside(1) {
        return false;
    }
    let reach = i128::from((b[0] - a[0]).abs() + (b[1] - a[1]).abs());
    2 * cross(a, b, point).abs() <= reach
}

/// Returns the sides between the area and its surroundings, with the area on their left.
fn border_sides(sides: &[Side]) -> Vec<[Point; 2]> {
    let rows = SideRows::new(sides);
    let mut border = Vec::new();
    for (index, &([a, b], sign)) in sides.iter().enumerate() {
        // The winding number above a horizontal side, or to the right of any other side.
        let beyond = rows.winding_beyond(sides, index);
        let rises = b[1] > a[1];
        let (left, right) = if a[1] == b[1] {
            (beyond, beyond - sign)
        } else if rises {
            (beyond + sign, beyond)
        } else {
            (beyond, beyond - sign)
        };
        match (left > 0, right > 0) {
            (true, false) => border.push([a, b]),
            (false, true) => border.push([b, a]),
            _ => {}
        }
    }
    border
}

/// The non-horizontal sides, in rows of equal height.
struct SideRows {
    rows: Vec<Vec<usize>>,
    low: i64,
    height: i64,
}

impl SideRows {
    fn new(sides: &[Side]) -> Self {
        let heights = || sides.iter().flat_map(|(ends, _)| ends.map(|end| end[1]));
        let (low, high) = (heights().min().unwrap_or(0), heights().max().unwrap_or(0));
        let count = 4 * libm::sqrt(sides.len() as f64) as i64 + 1;
        let height = (high - low) / count + 1;
        let mut rows = vec![Vec::new(); count as usize + 1];
        for (index, ([a, b], _)) in
            sides.iter().enumerate().filter(|(_, (e, _))| e[0][1] != e[1][1])
        {
            let (from, to) = (a[1].min(b[1]), a[1].max(b[1]));
            for row in (from - low) / height..=(to - low) / height {
                rows[row as usize].push(index);
            }
        }
        Self { rows, low, height }
    }

    /// Returns the winding number next to the middle of a side: just beyond the middle in x, or in
    /// y if the side is horizontal.
    ///
    /// A ray from there to the right counts the sides that it crosses. A side includes its lower
    /// end but not its upper end. Coordinates are doubled, so that the middle is at integers.
    fn winding_beyond(&self, sides: &[Side], index: usize) -> i32 {
        let [a, b] = sides[index].0;
        let middle = [a[0] + b[0], a[1] + b[1]];
        let row = (middle[1].div_euclid(2) - self.low) / self.height;
        // A middle halfway between two grid steps may be in either row.
        let next = ((middle[1] + 1).div_euclid(2) - self.low) / self.height;
        let mut winding = 0;
        let rows = &self.rows[row as usize..=next as usize];
        for (at, in_row) in rows.iter().enumerate() {
            for &other in in_row {
                let (ends, sign) = sides[other];
                let is_repeated = at > 0 && rows[0].contains(&other);
                if other == index || is_repeated {
                    continue;
                }
                winding += crossing_of_ray(middle, ends.map(|end| end.map(|c| 2 * c)), sign);
            }
        }
        winding
    }
}

/// Returns what a side adds to the winding number around a point, on a ray to the right.
fn crossing_of_ray(point: Point, [a, b]: [Point; 2], sign: i32) -> i32 {
    let rises = b[1] > a[1];
    let (low, high) = if rises { (a, b) } else { (b, a) };
    if point[1] < low[1] || point[1] >= high[1] || cross(low, high, point) <= 0 {
        return 0;
    }
    if rises { sign } else { -sign }
}

/// Joins directed sides into loops, each divided where it touches itself.
fn join_loops(sides: &[[Point; 2]]) -> Vec<Vec<Point>> {
    let mut sorted = sides.to_vec();
    sorted.sort_unstable();
    let mut used = vec![false; sorted.len()];
    let mut loops = Vec::new();
    for first in 0..sorted.len() {
        if used[first] {
            continue;
        }
        let mut path = vec![sorted[first][0]];
        let mut places = BTreeMap::from([(sorted[first][0], 0)]);
        let mut at = first;
        while !used[at] {
            used[at] = true;
            let [from, here] = sorted[at];
            // A loop is divided at a point that it has already visited.
            if let Some(&start) = places.get(&here) {
                let closed = path.split_off(start);
                for point in &closed {
                    places.remove(point);
                }
                loops.push(closed);
            }
            places.insert(here, path.len());
            path.push(here);
            let Some(next) = next_side(&sorted, &used, from, here) else { break };
            at = next;
        }
    }
    loops
}

/// Returns the first unused side that starts at `here`, clockwise from the direction back to
/// `from`. This side bounds the same part of the area.
fn next_side(sides: &[[Point; 2]], used: &[bool], from: Point, here: Point) -> Option<usize> {
    let first = sides.partition_point(|[start, _]| *start < here);
    let starting = (first..sides.len()).take_while(|&index| sides[index][0] == here);
    let mut best: Option<usize> = None;
    for index in starting.filter(|&index| !used[index]) {
        let is_nearer =
            |other: usize| is_clockwise_before(here, from, sides[index][1], sides[other][1]);
        if best.is_none_or(is_nearer) {
            best = Some(index);
        }
    }
    best
}

/// Whether the direction to `a` comes before the direction to `b`, clockwise around `center` from
/// the direction to `from`.
fn is_clockwise_before(center: Point, from: Point, a: Point, b: Point) -> bool {
    // Directions in the half turn clockwise from `from` come first, then the other half.
    let half = |to: Point| {
        let turn = cross(center, from, to);
        let ahead: i128 =
            (0..2).map(|k| i128::from(from[k] - center[k]) * i128::from(to[k] - center[k])).sum();
        match turn {
            t if t < 0 => 0,
            0 if ahead < 0 => 1,
            t if t > 0 => 2,
            _ => 3,
        }
    };
    half(a).cmp(&half(b)).then_with(|| cross(center, a, b).cmp(&0)).is_lt()
}

/// Converts a loop to a polyline without collinear points, or returns `None` if it is only a gap.
fn finish_loop(points: &[Point]) -> Option<Polyline> {
    let count = points.len();
    let at = |index: usize| points[index % count];
    let bends = |&index: &usize| cross(at(index + count - 1), at(index), at(index + 1)) != 0;
    let kept: Vec<Point> = (0..count).filter(bends).map(at).collect();
    let pairs = || kept.iter().zip(kept.iter().cycle().skip(1));
    let doubled: i128 = pairs().map(|(a, b)| cross([0, 0], *a, *b)).sum();
    let length = |(a, b): (&Point, &Point)| libm::hypot((b[0] - a[0]) as f64, (b[1] - a[1]) as f64);
    let perimeter: f64 = pairs().map(length).sum();
    let is_area = kept.len() >= 3 && doubled.unsigned_abs() as f64 > MIN_WIDTH * perimeter;
    // This cannot overflow: page points are `i32`, and crossings are between page points.
    let narrow = |point: &Point| point.map(|c| c as i32);
    is_area.then(|| Polyline { points: kept.iter().map(narrow).collect(), closed: true })
}

#[cfg(test)]
mod tests;
