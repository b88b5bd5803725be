//! Interval sets: the hidden parts of an edge as disjoint closed intervals of its parameter s.
//!
//! ```text
//!  s   0 ├───────████████───────────██────┤ 1     two intervals; the rest is visible
//! ```
//!
//! Faces are visited in no particular order, so each insertion merges: the set always holds the
//! union of the inserted intervals, in ascending order. An insertion costs a binary search and
//! moves the intervals after it; edges rarely have more than a handful of intervals.

/// Disjoint closed intervals in ascending order; intervals that touch are merged.
#[derive(Clone, PartialEq, Debug, Default)]
pub(crate) struct OcclusionIntervals(Vec<[f64; 2]>);

impl OcclusionIntervals {
    /// Removes all intervals without freeing the memory.
    pub(crate) fn clear(&mut self) {
        self.0.clear();
    }

    /// Returns the intervals in ascending order.
    #[cfg(test)]
    pub(crate) fn as_slice(&self) -> &[[f64; 2]] {
        &self.0
    }

    /// Whether nothing is hidden.
    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Inserts the interval `[start, end]`, with `start` ≤ `end`.
    ///
    /// Intervals that overlap or touch the new interval are merged with it, so the invariant holds
    /// without a later pass.
    pub(crate) fn insert_interval(&mut self, [start, end]: [f64; 2]) {
        let first = self.0.partition_point(|interval| interval[1] < start);
        let after = self.0[first..].partition_point(|interval| interval[0] <= end) + first;
        if first == after {
            self.0.insert(first, [start, end]);
            return;
        }
        let merged = [start.min(self.0[first][0]), end.max(self.0[after - 1][1])];
        self.0[first] = merged;
        self.0.drain(first + 1..after);
    }

    /// Whether a single interval of the set contains an interval.
    ///
    /// With this test, the BVH traversal skips subtrees over a hidden part of the edge.
    pub(crate) fn contains_interval(&self, [start, end]: [f64; 2]) -> bool {
        let at = self.0.partition_point(|interval| interval[1] < end);
        self.0.get(at).is_some_and(|interval| interval[0] <= start && end <= interval[1])
    }

    /// Inserts the intersection of two other sets, by a merge that is linear in their sizes.
    ///
    /// This implements the rule for shared sides: an edge exactly behind a side is hidden where
    /// there is a face on its left *and* a face on its right.
    pub(crate) fn insert_intersection(&mut self, one: &Self, other: &Self) {
        let (mut i, mut j) = (0, 0);
        while let (Some(a), Some(b)) = (one.0.get(i), other.0.get(j)) {
            let common = [a[0].max(b[0]), a[1].min(b[1])];
            if common[0] < common[1] {
                self.insert_interval(common);
            }
            if a[1] < b[1] {
                i += 1;
            } else {
                j += 1;
            }
        }
    }

    /// Closes gaps shorter than `least`, then removes intervals shorter than `least`, including at
    /// the ends 0 and 1.
    ///
    /// Rounding leaves such slivers where faces meet. Gaps are closed first, so that a part hidden
    /// by many small faces together does not vanish. A part longer than half of an edge remains,
    /// however short the edge is.
    pub(crate) fn remove_slivers(&mut self, least: f64) {
        self.0.dedup_by(|next, last| {
            let closes = next[0] - last[1] < least;
            if closes {
                last[1] = next[1];
            }
            closes
        });
        let least = least.min(0.5);
        self.0.retain(|interval| interval[1] - interval[0] >= least);
        if let Some(first) = self.0.first_mut().filter(|first| first[0] < least) {
            first[0] = 0.0;
        }
        if let Some(last) = self.0.last_mut().filter(|last| 1.0 - last[1] < least) {
            last[1] = 1.0;
        }
    }

    /// Returns the parts of an interval outside the set, in ascending order.
    pub(crate) fn parts_outside(&self, [start, end]: [f64; 2]) -> Vec<[f64; 2]> {
        let (mut parts, mut from) = (Vec::new(), start);
        for &[low, high] in &self.0 {
            if from < low.min(end) {
                parts.push([from, low.min(end)]);
            }
            from = from.max(high);
        }
        if from < end {
            parts.push([from, end]);
        }
        parts
    }

    /// Divides [0, 1] at the ends of the intervals and returns the parts in ascending order, with
    /// `true` for hidden parts.
    ///
    /// Empty parts are skipped, so a set that begins at 0 does not yield an empty visible part.
    pub(crate) fn divide_unit_interval(&self) -> impl Iterator<Item = ([f64; 2], bool)> + '_ {
        let starts = std::iter::once(0.0).chain(self.0.iter().map(|interval| interval[1]));
        let ends = self.0.iter().map(|interval| Some(*interval)).chain([None]);
        starts.zip(ends).flat_map(|(start, interval)| {
            let gap = ([start, interval.map_or(1.0, |interval| interval[0])], false);
            let gap = (gap.0[0] < gap.0[1]).then_some(gap);
            gap.into_iter().chain(interval.map(|interval| (interval, true)))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn interval_set(intervals: &[[f64; 2]]) -> OcclusionIntervals {
        let mut set = OcclusionIntervals::default();
        intervals.iter().for_each(|&interval| set.insert_interval(interval));
        set
    }

    #[test]
    fn touching_intervals_are_merged() {
        let intervals = interval_set(&[[0.5, 0.6], [0.1, 0.2], [0.8, 0.9], [0.2, 0.5]]);
        assert_eq!(intervals.as_slice(), [[0.1, 0.6], [0.8, 0.9]]);
        assert_eq!(interval_set(&[[0.1, 0.2], [0.3, 0.4], [0.0, 1.0]]).as_slice(), [[0.0, 1.0]]);
    }

    #[test]
    fn only_parts_of_a_single_interval_are_contained() {
        let intervals = interval_set(&[[0.1, 0.4], [0.5, 0.9]]);
        assert!(intervals.contains_interval([0.1, 0.4]) && intervals.contains_interval([0.6, 0.6]));
        assert!(
            !intervals.contains_interval([0.3, 0.6])
                && !intervals.contains_interval([0.0, 0.2])
                && !intervals.contains_interval([0.8, 1.0])
        );
    }

    #[test]
    fn intersections_of_sets_are_inserted() {
        let mut intervals = interval_set(&[[0.0, 0.1]]);
        intervals.insert_intersection(
            &interval_set(&[[0.2, 0.5], [0.6, 0.9]]),
            &interval_set(&[[0.4, 0.7], [0.9, 1.0]]),
        );
        assert_eq!(intervals.as_slice(), [[0.0, 0.1], [0.4, 0.5], [0.6, 0.7]]);
    }

    #[test]
    fn slivers_are_removed() {
        let mut intervals =
            interval_set(&[[0.001, 0.2], [0.201, 0.4], [0.6, 0.601], [0.8, 0.9999]]);
        intervals.remove_slivers(0.01);
        assert_eq!(intervals.as_slice(), [[0.0, 0.4], [0.8, 1.0]]);
        // An edge far shorter than the minimum part keeps the interval that hides most of it.
        let mut intervals = interval_set(&[[0.1, 1.0]]);
        intervals.remove_slivers(40.0);
        assert_eq!(intervals.as_slice(), [[0.0, 1.0]]);
    }

    #[test]
    fn parts_outside_a_set_are_its_gaps_within_the_interval() {
        let intervals = interval_set(&[[0.1, 0.3], [0.5, 0.6]]);
        assert_eq!(intervals.parts_outside([0.0, 1.0]), [[0.0, 0.1], [0.3, 0.5], [0.6, 1.0]]);
        assert_eq!(intervals.parts_outside([0.2, 0.4]), [[0.3, 0.4]]);
        assert_eq!(intervals.parts_outside([0.15, 0.25]), [[0.0; 2]; 0]);
        assert_eq!(intervals.parts_outside([0.7, 0.8]), [[0.7, 0.8]]);
    }

    #[test]
    fn the_parts_cover_the_whole_edge() {
        let parts: Vec<_> =
            interval_set(&[[0.0, 0.25], [0.5, 0.75]]).divide_unit_interval().collect();
        let expected =
            [([0.0, 0.25], true), ([0.25, 0.5], false), ([0.5, 0.75], true), ([0.75, 1.0], false)];
        assert_eq!(parts, expected);
        assert_eq!(
            OcclusionIntervals::default().divide_unit_interval().collect::<Vec<_>>(),
            [([0.0, 1.0], false)]
        );
    }
}
