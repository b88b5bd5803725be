//! Polyline chaining: joins segments with common endpoints into polylines.
//!
//! Corners can then be mitered or rounded, dashes continue around corners, and files are smaller.
//! Endpoints are equal if they are the same point of the page's micrometer grid. At a junction of
//! more than two segments, a chain continues in the straightest direction.
//!
//! ```text
//!             │                     │
//!    ─────────●─────────    ─►   ═══╪═══   two chains cross: each continues straight ahead
//!             │                     │
//! ```

use super::overlap_removal::PageSegment;
use page::{PagePoint, Polyline, to_micrometers};

/// A polyline in one layer, from one object.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct PolylineChain {
    pub(super) layer: u32,
    pub(super) object: u32,
    pub(super) polyline: Polyline,
}

/// The cosine of 60°, the largest turn of a chain at a junction of more than two segments.
const MIN_TURN_COSINE: f64 = 0.5;

/// The maximum distance of a removed point from the line between its neighbors, in micrometers.
const COLLINEAR_TOLERANCE: f64 = 1.0;

/// The maximum number of consecutive points that are removed. Every new point retests all points of
/// the run, so the time grows with the square of the run's length.
const MAX_DROPPED_RUN: usize = 64;

/// Joins segments into chains, ordered by layer, by object and by first segment.
///
/// `pen_of_layer` returns the same number for layers whose lines continue each other, such as all
/// dashed layers; otherwise a dash pattern would restart where the class of a line changes. A chain
/// that crosses several layers is put in the layer where it is longest.
///
/// The time is O(n log n) for sorting the ends, plus a bounded cost per point in
/// [`remove_collinear`].
pub(super) fn join_into_chains(
    segments: &[PageSegment],
    pen_of_layer: impl Fn(u32) -> u32,
) -> Vec<PolylineChain> {
    let key = |segment: &PageSegment| (pen_of_layer(segment.layer), segment.object);
    let mut order: Vec<&PageSegment> = segments.iter().collect();
    order.sort_by_key(|segment| (key(segment), segment.layer));
    let mut chains: Vec<PolylineChain> = order
        .chunk_by(|a, b| key(a) == key(b))
        .flat_map(|group| {
            let object = group[0].object;
            let lines = SegmentGraph::new(group).into_polylines();
            let chain = move |(polyline, layer)| PolylineChain { layer, object, polyline };
            lines.into_iter().map(chain)
        })
        .collect();
    chains.sort_by_key(|chain| (chain.layer, chain.object));
    chains
}

/// The grid segments of one pen and one object, and their connections.
struct SegmentGraph {
    /// The two ends of each segment.
    segments: Vec<[PagePoint; 2]>,
    /// The layer of each segment.
    layers: Vec<u32>,
    /// For each end: its point, its segment, and which end of the segment it is. Entries are sorted
    /// so that ends at the same point are neighbors.
    ends: Vec<(PagePoint, u32, u8)>,
    /// Whether each segment is already in a chain.
    is_used: Vec<bool>,
}

impl SegmentGraph {
    /// Snaps segments to the grid, and drops duplicates and zero-length segments.
    fn new(segments: &[&PageSegment]) -> Self {
        let on_grid = |segment: &&PageSegment| (segment.ends.map(to_micrometers), segment.layer);
        let on_page = segments.iter().map(on_grid).filter(|([a, b], _)| a != b);
        let on_page: Vec<([PagePoint; 2], u32)> = on_page.collect();
        let (segments, layers): (Vec<_>, Vec<_>) =
            drop_duplicate_segments(&on_page).into_iter().unzip();
        let mut ends: Vec<_> = (0_u32..)
            .zip(&segments)
            .flat_map(|(index, [a, b])| [(*a, index, 0), (*b, index, 1)])
            .collect();
        ends.sort_unstable();
        let is_used = vec![false; segments.len()];
        Self { segments, layers, ends, is_used }
    }

    /// Covers the graph with polylines and returns each with its layer. Every unused segment is
    /// extended forward, then backward unless the chain has closed.
    fn into_polylines(mut self) -> Vec<(Polyline, u32)> {
        let mut lines = Vec::new();
        for index in 0..self.segments.len() {
            if self.is_used[index] {
                continue;
            }
            self.is_used[index] = true;
            let mut points = self.segments[index].to_vec();
            let mut chain = vec![index];
            self.extend_chain(&mut points, &mut chain);
            let closed = points.len() > 3 && points.first() == points.last();
            if closed {
                points.pop();
            } else {
                points.reverse();
                self.extend_chain(&mut points, &mut chain);
                points.reverse();
            }
            let layer = self.longest_layer(&chain);
            lines.push((Polyline { points: remove_collinear(points, closed), closed }, layer));
        }
        lines
    }

    /// Returns the layer with the largest total length among these segments; in a tie, the lowest.
    fn longest_layer(&self, chain: &[usize]) -> u32 {
        let mut lengths: Vec<(u32, f64)> = Vec::new();
        for &index in chain {
            let [a, b] = self.segments[index];
            let [x, y] = grid_offset(a, b);
            let (layer, length) = (self.layers[index], libm::hypot(x, y));
            match lengths.iter_mut().find(|(other, _)| *other == layer) {
                Some((_, total)) => *total += length,
                None => lengths.push((layer, length)),
            }
        }
        lengths.sort_by(|(a, x), (b, y)| y.total_cmp(x).then(a.cmp(b)));
        lengths.first().map_or(0, |(layer, _)| *layer)
    }

    /// Extends a chain from its last point until no segment continues it or it closes. Adds the
    /// segments to `chain`.
    ///
    /// `points` has at least two points, and the segment between them is already used.
    fn extend_chain(&mut self, points: &mut Vec<PagePoint>, chain: &mut Vec<usize>) {
        while let Some((index, next)) =
            self.next_segment(points[points.len() - 2], points[points.len() - 1])
        {
            self.is_used[index] = true;
            chain.push(index);
            points.push(next);
            if next == points[0] {
                return;
            }
        }
    }

    /// Finds the unused segment that best continues a chain from `before` through `here`, and its
    /// far end.
    ///
    /// ```text
    ///             ╱ best: the smallest turn
    ///   before ──● here
    ///             ╲ also incident; at a junction, a candidate only up to 60°
    /// ```
    ///
    /// If only two segments meet, the chain continues at any angle.
    fn next_segment(&self, before: PagePoint, here: PagePoint) -> Option<(usize, PagePoint)> {
        let first = self.ends.partition_point(|(point, ..)| *point < here);
        let incident = self.ends[first..].iter().take_while(|(point, ..)| *point == here);
        let is_crossing = incident.clone().nth(2).is_some();
        let mut best: Option<(f64, usize, PagePoint)> = None;
        for &(_, index, end) in incident {
            let (index, next) =
                (index as usize, self.segments[index as usize][usize::from(1 - end)]);
            let cosine = turn_cosine(before, here, next);
            let continues = !self.is_used[index] && (!is_crossing || cosine >= MIN_TURN_COSINE);
            if continues && best.is_none_or(|(other, ..)| cosine > other) {
                best = Some((cosine, index, next));
            }
        }
        best.map(|(_, index, next)| (index, next))
    }
}

/// Removes later duplicates, in either direction, and keeps the order.
fn drop_duplicate_segments(segments: &[([PagePoint; 2], u32)]) -> Vec<([PagePoint; 2], u32)> {
    let sorted = |([a, b], _): ([PagePoint; 2], u32)| [a.min(b), a.max(b)];
    let mut order: Vec<u32> = (0..segments.len() as u32).collect();
    order.sort_by_key(|&at| (sorted(segments[at as usize]), at));
    order.dedup_by_key(|at| sorted(segments[*at as usize]));
    order.sort_unstable();
    order.into_iter().map(|at| segments[at as usize]).collect()
}

/// Returns the vector from one grid point to another, in micrometers.
fn grid_offset([x0, y0]: PagePoint, [x1, y1]: PagePoint) -> [f64; 2] {
    [f64::from(x1) - f64::from(x0), f64::from(y1) - f64::from(y0)]
}

/// Returns the cosine of the angle by which a path from `a` to `c` turns at `b`.
fn turn_cosine(a: PagePoint, b: PagePoint, c: PagePoint) -> f64 {
    let ([x0, y0], [x1, y1]) = (grid_offset(a, b), grid_offset(b, c));
    let squares = (x0 * x0 + y0 * y0) * (x1 * x1 + y1 * y1);
    (x0 * x1 + y0 * y1) / libm::sqrt(squares)
}

/// Removes points on the segment between their neighbors.
///
/// A greedy pass lets the run grow as long as all points dropped since the last retained point are
/// within [`COLLINEAR_TOLERANCE`] of the segment to the next point. Every dropped point is tested
/// against the *final* segment, so errors do not accumulate along a curve of many small steps.
/// Errors would accumulate if each point were compared only with its neighbors.
fn remove_collinear(points: Vec<PagePoint>, closed: bool) -> Vec<PagePoint> {
    let mut retained = vec![points[0]];
    let mut dropped: Vec<PagePoint> = Vec::new();
    let ends = points[1..].iter().chain(closed.then_some(&points[0]));
    let mut last = points[0];
    for (at, &next) in ends.enumerate() {
        let from = retained[retained.len() - 1];
        if at > 0 {
            dropped.push(last);
            let flat = dropped.iter().all(|&point| lies_on_segment(from, point, next));
            if !flat || dropped.len() > MAX_DROPPED_RUN {
                retained.push(last);
                dropped.clear();
            }
        }
        last = next;
    }
    if !closed {
        retained.push(last);
    }
    if retained.len() < 2 { points } else { retained }
}

/// Whether a point is on the segment from `from` to `to`, within the tolerance.
///
/// With d = to − from and p = point − from, this tests 0 ≤ d·p ≤ |d|² and |d × p| ≤ tolerance ·
/// |d|, squared to avoid the square root.
fn lies_on_segment(from: PagePoint, point: PagePoint, to: PagePoint) -> bool {
    let ([dx, dy], [px, py]) = (grid_offset(from, to), grid_offset(from, point));
    let square = dx * dx + dy * dy;
    let (along, across) = (dx * px + dy * py, dx * py - dy * px);
    (0.0..=square).contains(&along)
        && across * across <= COLLINEAR_TOLERANCE * COLLINEAR_TOLERANCE * square
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;

    /// Returns the chains of segments in millimeters, all from one layer and object.
    fn chains_in_millimeters(segments: &[[f64; 4]]) -> Vec<(Vec<[i32; 2]>, bool)> {
        let segment = |&[x0, y0, x1, y1]: &[f64; 4]| PageSegment {
            ends: [DVec2::new(x0, y0), DVec2::new(x1, y1)],
            layer: 0,
            object: 0,
        };
        let segments: Vec<PageSegment> = segments.iter().map(segment).collect();
        let in_millimeters =
            |line: Polyline| line.points.iter().map(|p| p.map(|c| c / 1000)).collect();
        join_into_chains(&segments, |layer| layer)
            .into_iter()
            .map(|chain| (in_millimeters(chain.polyline.clone()), chain.polyline.closed))
            .collect()
    }

    #[test]
    fn the_sides_of_a_square_in_any_order_form_one_closed_line() {
        let square = [
            [0.0, 0.0, 1.0, 0.0],
            [1.0, 1.0, 0.0, 1.0],
            [1.0, 1.0, 1.0, 0.0],
            [0.0, 1.0, 0.0, 0.0],
        ];
        let expected = (vec![[0, 0], [1, 0], [1, 1], [0, 1]], true);
        assert_eq!(chains_in_millimeters(&square), [expected]);
    }

    #[test]
    fn an_open_chain_grows_at_both_ends_and_loses_collinear_points() {
        let line = [
            [2.0, 0.0, 3.0, 0.0],
            [1.0, 0.0, 2.0, 0.0],
            [3.0, 0.0, 3.0, 5.0],
            [1.0, 0.0, 0.0, 0.0],
        ];
        assert_eq!(chains_in_millimeters(&line), [(vec![[0, 0], [3, 0], [3, 5]], false)]);
    }

    #[test]
    fn at_a_junction_the_straightest_segment_continues() {
        let cross = [
            [0.0, 5.0, 5.0, 5.0],
            [5.0, 0.0, 5.0, 5.0],
            [5.0, 5.0, 10.0, 5.0],
            [5.0, 5.0, 5.0, 10.0],
        ];
        let expected = [(vec![[0, 5], [10, 5]], false), (vec![[5, 0], [5, 10]], false)];
        assert_eq!(chains_in_millimeters(&cross), expected);
        // In a T, the bar is one line and the stem is another.
        let expected = [(vec![[0, 5], [10, 5]], false), (vec![[5, 5], [5, 10]], false)];
        assert_eq!(chains_in_millimeters(&[cross[0], cross[3], cross[2]]), expected);
    }

    #[test]
    fn duplicates_and_segments_shorter_than_a_grid_step_are_dropped() {
        let twice = [[0.0, 0.0, 1.0, 2.0], [1.0, 2.0, 0.0, 0.0], [0.0, 0.0, 0.0001, 0.0]];
        assert_eq!(chains_in_millimeters(&twice), [(vec![[0, 0], [1, 2]], false)]);
    }

    #[test]
    fn lines_of_one_pen_continue_across_layers() {
        let segment = |from: f64, to: f64, layer: u32| PageSegment {
            ends: [DVec2::new(from, 0.0), DVec2::new(to, 0.0)],
            layer,
            object: 0,
        };
        let segments = [segment(0.0, 1.0, 1), segment(1.0, 4.0, 2), segment(4.0, 5.0, 3)];
        let layers = |chains: Vec<PolylineChain>| -> Vec<(u32, PagePoint, PagePoint)> {
            let ends = |line: &Polyline| (line.points[0], line.points[line.points.len() - 1]);
            chains.iter().map(|c| (c.layer, ends(&c.polyline).0, ends(&c.polyline).1)).collect()
        };
        let joined = layers(join_into_chains(&segments, |layer| u32::from(layer == 3)));
        assert_eq!(joined, [(2, [0, 0], [4000, 0]), (3, [4000, 0], [5000, 0])]);
        assert_eq!(layers(join_into_chains(&segments, |layer| layer)).len(), 3);
    }

    #[test]
    fn a_circle_with_many_sides_keeps_its_shape() {
        let point = |k: usize| {
            let (sin, cos) = libm::sincos(k as f64 / 1000.0 * core::f64::consts::TAU);
            [50.0 * cos, 50.0 * sin]
        };
        let side = |k: usize| {
            let ([x0, y0], [x1, y1]) = (point(k), point((k + 1) % 1000));
            [x0, y0, x1, y1]
        };
        let sides: Vec<[f64; 4]> = (0..1000).map(side).collect();
        let segments: Vec<PageSegment> = sides
            .iter()
            .map(|s| PageSegment {
                ends: [DVec2::new(s[0], s[1]), DVec2::new(s[2], s[3])],
                layer: 2,
                object: 7,
            })
            .collect();
        let chains = join_into_chains(&segments, |layer| layer);
        assert_eq!(chains.len(), 1);
        let Polyline { points, closed } = &chains[0].polyline;
        assert!(*closed && points.len() > 400 && points.len() <= 1000, "{}", points.len());
        for &[x, y] in points {
            assert!((libm::hypot(f64::from(x), f64::from(y)) - 50_000.0).abs() < 1.0, "{x} {y}");
        }
        assert!((chains[0].polyline.length() - 100.0 * core::f64::consts::PI).abs() < 0.01);
    }
}
