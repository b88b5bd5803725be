//! Overlap removal: keeps only the most important segment where collinear segments overlap.
//!
//! ```text
//!   visible  ├────────┤                     ├────────┤
//!   hidden       ├────────────┤      ─►              ├────┤
//!   hidden                ├───────┤                       ├──┤   merged with the previous one
//! ```
//!
//! In a front view, the back edges are exactly behind the front edges. Lines drawn twice would be
//! darker, and dashes would fill each other's gaps. Precedence follows technical drawing practice:
//! visible lines before hidden lines (ISO 128-2). Adjacent segments of one object and layer are
//! merged.
//!
//! Segments are grouped by their supporting line, rounded to a grid; sorting takes O(n log n) and
//! dominates the cost.

use glam::DVec2;
use std::collections::BTreeMap;

/// A straight segment on the page, in millimeters.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct PageSegment {
    pub(super) ends: [DVec2; 2],
    /// The layer; a lower number is more important.
    pub(super) layer: u32,
    /// The object that the segment belongs to.
    pub(super) object: u32,
}

/// The distance, in millimeters, below which segments coincide: one step of the page grid.
const GRID_STEP: f64 = 1e-3;

/// Slopes that differ by less than this count as equal. Across the longest sheet, 1.2 m, such lines
/// diverge by less than a grid step.
const SLOPE_STEP: f64 = 0.5e-6;

/// Segments shorter than this, in millimeters, are left unchanged, because their direction is too
/// uncertain.
const MIN_LENGTH: f64 = 0.02;

/// A segment on its supporting line, from `from` to `to` along the dominant axis.
#[derive(Clone, Copy, Debug)]
struct LineInterval {
    layer: u32,
    object: u32,
    /// The position of the segment in the input, which the output restores.
    input_index: usize,
    ends: [DVec2; 2],
    from: f64,
    to: f64,
}

/// A supporting line rounded to a grid, shared by collinear segments: whether it is steep, its
/// slope and its height.
type SupportLine = (bool, i64, i64);

/// Removes the parts covered by more important segments, and merges adjacent segments. The result
/// keeps the input order.
pub(super) fn remove_overlaps(segments: &[PageSegment]) -> Vec<PageSegment> {
    let center = bounds_center(segments);
    let mut retained: Vec<(usize, PageSegment)> = Vec::with_capacity(segments.len());
    let mut intervals: Vec<(SupportLine, LineInterval)> = Vec::new();
    for (index, segment) in segments.iter().enumerate() {
        match support_line(segment, center) {
            Some((support, from, to, ends)) => {
                let PageSegment { layer, object, .. } = *segment;
                intervals.push((
                    support,
                    LineInterval { layer, object, input_index: index, ends, from, to },
                ));
            }
            None => retained.push((index, *segment)),
        }
    }
    intervals.sort_unstable_by(|(one, a), (two, b)| {
        let of_span = |interval: &LineInterval| (interval.layer, interval.object);
        one.cmp(two)
            .then(of_span(a).cmp(&of_span(b)))
            .then(a.from.total_cmp(&b.from))
            .then(a.input_index.cmp(&b.input_index))
    });
    for line in intervals.chunk_by(|(a, _), (b, _)| a == b) {
        push_uncovered_segments(line, &mut retained);
    }
    retained.sort_by_key(|(index, _)| *index);
    retained.into_iter().map(|(_, segment)| segment).collect()
}

/// Returns the center of the segments' bounding box, an origin for which rounded slopes matter
/// least.
fn bounds_center(segments: &[PageSegment]) -> DVec2 {
    let bounds = |f: fn(DVec2, DVec2) -> DVec2, start: f64| {
        segments.iter().flat_map(|segment| segment.ends).fold(DVec2::splat(start), f)
    };
    let (least, greatest) = (bounds(DVec2::min, f64::INFINITY), bounds(DVec2::max, -f64::INFINITY));
    let middle = (least + greatest) * 0.5;
    if middle.is_finite() { middle } else { DVec2::ZERO }
}

/// Returns the supporting line of a segment and its interval on that line, or `None` if the segment
/// has no clear direction.
///
/// Lines are written as y = slope · x + height, with x and y swapped if they are steep, so that
/// slopes stay within ±1. Slope and height are rounded to a grid, so collinear segments from
/// different computations share a key. Two collinear segments whose values round to different grid
/// points are missed. Both are then drawn, which does no harm.
fn support_line(
    segment: &PageSegment,
    center: DVec2,
) -> Option<(SupportLine, f64, f64, [DVec2; 2])> {
    let [a, b] = segment.ends.map(|end| end - center);
    let along = b - a;
    let steep = along.y.abs() > along.x.abs();
    let swap_axes = |v: DVec2| if steep { DVec2::new(v.y, v.x) } else { v };
    let (a, along) = (swap_axes(a), swap_axes(along));
    if !(along.x.abs() >= MIN_LENGTH && along.is_finite()) {
        return None;
    }
    let slope = along.y / along.x;
    let height = a.y - a.x * slope;
    let round = |value: f64, step: f64| libm::round(value / step) as i64;
    let support = (steep, round(slope, SLOPE_STEP), round(height, GRID_STEP));
    let (from, to) = (a.x, a.x + along.x);
    let [start, end] = segment.ends;
    let forward = from <= to;
    let ends = if forward { [start, end] } else { [end, start] };
    Some((support, from.min(to), from.max(to), ends))
}

/// Pushes the parts of one line's intervals that are not covered by a more important interval.
///
/// Intervals are sorted by importance, then along the line. Intervals of equal importance are
/// merged, reduced to the parts that earlier intervals leave uncovered, and then cover later
/// intervals.
fn push_uncovered_segments(
    line: &[(SupportLine, LineInterval)],
    retained: &mut Vec<(usize, PageSegment)>,
) {
    let mut covered = CoveredIntervals::default();
    for equals in line.chunk_by(|(_, a), (_, b)| (a.layer, a.object) == (b.layer, b.object)) {
        let joined = merge_touching(equals.iter().map(|(_, interval)| *interval));
        joined.iter().for_each(|interval| covered.push_uncovered_parts(interval, retained));
        joined.into_iter().for_each(|interval| covered.cover_interval(interval));
    }
}

/// The covered parts of a line, keyed by their starts. No two of them touch.
#[derive(Default)]
struct CoveredIntervals(BTreeMap<i64, LineInterval>);

/// Maps a float to an integer with the same order (IEEE 754 total order), for use as a map key.
///
/// The bit patterns of negative numbers descend; flipping all bits except the sign makes them
/// ascend.
fn total_order_key(number: f64) -> i64 {
    let bits = number.to_bits() as i64;
    bits ^ (((bits >> 63) as u64) >> 1) as i64
}

impl CoveredIntervals {
    /// Adds an interval, merged with any that it touches.
    ///
    /// Merged intervals are removed from the map for good, so the total time is O(n log n).
    fn cover_interval(&mut self, mut interval: LineInterval) {
        while let Some((&at, last)) =
            self.0.range(..=total_order_key(interval.to + GRID_STEP)).next_back()
        {
            if last.to + GRID_STEP < interval.from {
                break;
            }
            if last.from < interval.from {
                (interval.from, interval.ends[0]) = (last.from, last.ends[0]);
            }
            if last.to > interval.to {
                (interval.to, interval.ends[1]) = (last.to, last.ends[1]);
            }
            self.0.remove(&at);
        }
        self.0.insert(total_order_key(interval.from), interval);
    }

    /// Pushes the uncovered parts of an interval that are longer than two grid steps.
    ///
    /// ```text
    ///   covered       ├────┤     ├──┤
    ///   interval   ├───────────────────┤
    ///   pushed     ├──┤    ├─────┤  ├──┤
    /// ```
    ///
    /// A part begins exactly at the end of the interval that covers its neighbor, so lines meet
    /// without gaps.
    fn push_uncovered_parts(
        &self,
        interval: &LineInterval,
        retained: &mut Vec<(usize, PageSegment)>,
    ) {
        let mut rest = *interval;
        let mut keep = |from: f64, to: f64, ends| {
            if to - from > 2.0 * GRID_STEP {
                let segment = PageSegment { ends, layer: interval.layer, object: interval.object };
                retained.push((interval.input_index, segment));
            }
        };
        let (from, to) = (total_order_key(interval.from), total_order_key(interval.to));
        let before = self.0.range(..from).next_back().filter(|(_, cover)| cover.to > interval.from);
        for (_, cover) in before.into_iter().chain(self.0.range(from..to.max(from))) {
            keep(rest.from, cover.from, [rest.ends[0], cover.ends[0]]);
            (rest.from, rest.ends[0]) = (cover.to, cover.ends[1]);
        }
        keep(rest.from, rest.to, rest.ends);
    }
}

/// Merges touching intervals; the input must be sorted by start.
fn merge_touching(intervals: impl Iterator<Item = LineInterval>) -> Vec<LineInterval> {
    let mut joined: Vec<LineInterval> = Vec::new();
    for interval in intervals {
        match joined.last_mut() {
            Some(last) if interval.from <= last.to + GRID_STEP => {
                last.input_index = last.input_index.min(interval.input_index);
                if interval.to > last.to {
                    (last.to, last.ends[1]) = (interval.to, interval.ends[1]);
                }
            }
            _ => joined.push(interval),
        }
    }
    joined
}

#[cfg(test)]
mod tests {
    use super::*;

    fn segment(layer: u32, object: u32, [x0, y0, x1, y1]: [f64; 4]) -> PageSegment {
        PageSegment { ends: [DVec2::new(x0, y0), DVec2::new(x1, y1)], layer, object }
    }

    /// Returns the x ranges of the segments that remain on the line y = x/2.
    fn remaining_on_line(segments: &[(u32, u32, f64, f64)]) -> Vec<(u32, u32, f64, f64)> {
        let on_line = |&(layer, object, a, b): &_| segment(layer, object, [a, a / 2.0, b, b / 2.0]);
        let round = |x: f64| libm::round(x * 1e6) / 1e6;
        let segments: Vec<PageSegment> = segments.iter().map(on_line).collect();
        let rest = remove_overlaps(&segments);
        rest.iter().map(|p| (p.layer, p.object, round(p.ends[0].x), round(p.ends[1].x))).collect()
    }

    #[test]
    fn visible_segments_cover_hidden_ones() {
        let rest = remaining_on_line(&[(1, 0, 4.0, 9.0), (0, 0, 0.0, 5.0), (1, 1, 8.0, 12.0)]);
        assert_eq!(rest, [(1, 0, 5.0, 9.0), (0, 0, 0.0, 5.0), (1, 1, 9.0, 12.0)]);
        // The first segment, with its ends swapped, is covered at both ends and in the middle.
        let rest = remaining_on_line(&[
            (2, 0, 10.0, 0.0),
            (1, 0, 4.0, 5.0),
            (0, 3, -1.0, 1.0),
            (0, 4, 8.0, 20.0),
        ]);
        let parts = [(2, 0, 1.0, 4.0), (2, 0, 5.0, 8.0)];
        assert_eq!(rest[..2], parts);
        assert_eq!(rest[2..], [(1, 0, 4.0, 5.0), (0, 3, -1.0, 1.0), (0, 4, 8.0, 20.0)]);
    }

    #[test]
    fn touching_segments_merge_and_duplicates_are_drawn_once() {
        assert_eq!(
            remaining_on_line(&[(0, 0, 0.0, 1.0), (0, 0, 1.0, 2.0), (0, 0, 0.5, 3.0)]),
            [(0, 0, 0.0, 3.0)]
        );
        assert_eq!(remaining_on_line(&[(0, 0, 0.0, 1.0), (0, 0, 1.0, 0.0)]), [(0, 0, 0.0, 1.0)]);
        // Other objects and other layers keep their lines.
        let apart = [(0, 0, 0.0, 1.0), (0, 1, 1.0, 2.0), (1, 1, 2.0, 3.0)];
        assert_eq!(remaining_on_line(&apart), apart);
    }

    #[test]
    fn a_hundred_thousand_collinear_segments_take_little_time() {
        let count = 100_000_u32;
        let at = |k: u32| f64::from(k) * 0.25;
        let many: Vec<PageSegment> =
            (0..count).map(|k| segment(0, count - k, [at(k), 0.0, at(k) + 0.5, 0.0])).collect();
        let rest = remove_overlaps(&many);
        // Objects are in descending order, so each takes precedence over the previous one.
        assert_eq!(rest.len(), many.len());
        let length: f64 =
            rest.iter().map(|segment| (segment.ends[1] - segment.ends[0]).length()).sum();
        assert!((length - at(count) - 0.25).abs() < 1e-6, "{length}");
    }

    #[test]
    fn parallel_and_crossing_segments_remain() {
        let segments = [
            segment(0, 0, [0.0, 0.0, 10.0, 0.0]),
            segment(1, 0, [0.0, 0.01, 10.0, 0.01]),
            segment(1, 0, [5.0, -5.0, 5.0, 5.0]),
            segment(1, 0, [0.0, 0.0, 10.0, 0.01]),
            segment(1, 0, [3.0, 0.0, 3.001, 0.0]),
        ];
        assert_eq!(remove_overlaps(&segments), segments);
        assert_eq!(remove_overlaps(&[]), []);
    }
}
