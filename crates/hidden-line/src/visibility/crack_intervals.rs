//! The parts of an edge behind the sides of faces, and the parts that faces on both sides of the
//! edge hide together.
//!
//! ```text
//!    ███████ │ ▓▓▓▓▓▓▓      Together, a face on the left and a face on the right hide a line
//!    ███████ │ ▓▓▓▓▓▓▓      that runs exactly behind the side where they meet. They also hide a
//!    ███████ │ ▓▓▓▓▓▓▓      line in a crack between two objects that is narrower than a pen. A
//!       A   edge   B        single object has no cracks: the faces on both sides are its own.
//! ```

use super::occluder::SideInterval;
use super::occlusion_intervals::OcclusionIntervals;

/// The parts of an edge behind the sides of faces, for faces on its left and on its right.
#[derive(Clone, Debug, Default)]
pub(super) struct SideIntervals {
    pub(super) left: OcclusionIntervals,
    pub(super) right: OcclusionIntervals,
}

impl SideIntervals {
    /// Adds a face.
    pub(super) fn insert(&mut self, part: SideInterval) {
        let side = if part.is_left { &mut self.left } else { &mut self.right };
        side.insert_interval(part.interval);
    }

    /// Clears the intervals without freeing the memory.
    pub(super) fn clear(&mut self) {
        self.left.clear();
        self.right.clear();
    }
}

/// The parts of an edge near the sides of faces, each with the object of the face.
#[derive(Clone, Debug, Default)]
pub(super) struct CrackIntervals(Vec<SideInterval>);

impl CrackIntervals {
    /// Adds a face.
    pub(super) fn insert(&mut self, part: SideInterval) {
        self.0.push(part);
    }

    /// Clears the intervals without freeing the memory.
    pub(super) fn clear(&mut self) {
        self.0.clear();
    }

    /// Adds the parts with one object on the left and another on the right to a set.
    ///
    /// Sweeps over the ends of all intervals in O(n log n), for any number of objects. In an
    /// assembly with rows of identical parts, an edge runs behind the sides of hundreds of objects.
    pub(super) fn insert_into(&mut self, hidden: &mut OcclusionIntervals) {
        self.0.sort_by_key(|part| part.object);
        let objects = self.0.chunk_by(|one, next| one.object == next.object);
        let mut ends: Vec<SweepEnd> = Vec::new();
        for (parts, object) in objects.zip(0..) {
            for &SideInterval { interval: [start, end], is_left, .. } in parts {
                ends.push(SweepEnd { at: start, object, is_left, opens: true });
                ends.push(SweepEnd { at: end, object, is_left, opens: false });
            }
        }
        if ends.last().is_none_or(|last| last.object == 0) {
            return;
        }
        ends.sort_by(|a, b| a.at.total_cmp(&b.at));
        let mut sweep = Sweep::default();
        sweep.open.resize(1 + ends.iter().map(|end| end.object).max().unwrap_or(0), [0; 2]);
        for (index, end) in ends.iter().enumerate() {
            sweep.pass(end);
            if let Some(next) = ends.get(index + 1)
                && end.at < next.at
                && sweep.is_in_crack()
            {
                hidden.insert_interval([end.at, next.at]);
            }
        }
    }
}

/// The start or the end of an interval, on one side of the edge.
#[derive(Clone, Copy, Debug)]
struct SweepEnd {
    at: f64,
    /// The index of the object among the objects beside the edge.
    object: usize,
    is_left: bool,
    opens: bool,
}

/// The faces beside the edge at the current position of a sweep.
#[derive(Debug, Default)]
struct Sweep {
    /// The number of faces of each object, on the right and on the left.
    open: Vec<[u32; 2]>,
    /// The number of objects that have any faces, on the right and on the left.
    sides: [u32; 2],
    /// The number of objects that have any faces on either side.
    objects: u32,
}

impl Sweep {
    /// Moves past the start or the end of an interval.
    fn pass(&mut self, end: &SweepEnd) {
        let side = usize::from(end.is_left);
        let open = &mut self.open[end.object];
        let (had_side, had_any) = (open[side] > 0, *open != [0; 2]);
        open[side] = if end.opens { open[side] + 1 } else { open[side].saturating_sub(1) };
        let (has_side, has_any) = (open[side] > 0, *open != [0; 2]);
        self.sides[side] = self.sides[side] + u32::from(has_side) - u32::from(had_side);
        self.objects = self.objects + u32::from(has_any) - u32::from(had_any);
    }

    /// Whether there is one object on the left and another on the right.
    fn is_in_crack(&self) -> bool {
        self.sides[0] > 0 && self.sides[1] > 0 && self.objects > 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn part(object: u32, is_left: bool, interval: [f64; 2]) -> SideInterval {
        SideInterval { interval, is_left, is_wide: true, object }
    }

    #[test]
    fn cracks_are_between_two_objects() {
        let mut cracks = CrackIntervals::default();
        cracks.insert(part(7, true, [0.0, 0.5]));
        cracks.insert(part(7, false, [0.1, 0.4]));
        let mut hidden = OcclusionIntervals::default();
        cracks.insert_into(&mut hidden);
        assert_eq!(hidden.as_slice(), [[0.0; 2]; 0]);
        cracks.insert(part(3, false, [0.2, 0.9]));
        cracks.insert(part(3, true, [0.3, 0.9]));
        cracks.insert_into(&mut hidden);
        assert_eq!(hidden.as_slice(), [[0.2, 0.5]]);
    }

    #[test]
    fn a_sweep_finds_the_overlaps_of_pairs_of_objects() {
        let mut state = 5_u64;
        let mut below = |most: u64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888);
            (state >> 40) % most
        };
        for _ in 0..200 {
            let objects = 1 + below(6) as u32;
            let parts: Vec<SideInterval> = (0..below(14))
                .map(|_| {
                    let ends = [below(20), below(20)].map(|end| end as f64 / 20.0);
                    let interval = [ends[0].min(ends[1]), ends[0].max(ends[1])];
                    part(below(objects.into()) as u32, below(2) == 0, interval)
                })
                .collect();
            let mut cracks = CrackIntervals::default();
            let mut expected = OcclusionIntervals::default();
            for one in &parts {
                cracks.insert(*one);
                for other in &parts {
                    let low = one.interval[0].max(other.interval[0]);
                    let high = one.interval[1].min(other.interval[1]);
                    if one.is_left && !other.is_left && one.object != other.object && low < high {
                        expected.insert_interval([low, high]);
                    }
                }
            }
            let mut actual = OcclusionIntervals::default();
            cracks.insert_into(&mut actual);
            assert_eq!(actual, expected, "{parts:?}");
        }
    }
}
