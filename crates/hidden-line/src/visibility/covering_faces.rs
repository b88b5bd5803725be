//! The number of faces in front of each part of an edge: Appel's quantitative invisibility.
//!
//! ```text
//!  faces   0    1     2        3    2   0
//!  s   0 ├────┼─────┼────────┼────┼───┼────┤ 1     behind more than two faces: ████
//!                            ██████
//! ```
//!
//! Visibility depends only on whether the number is zero. Drawings of assemblies need the number
//! itself: dashed lines are legible behind one wall, whose two sides are two faces, but turn into a
//! black cloud behind many walls.

use super::occluder::Occlusion;
use super::occluders::{MeshOccluders, OcclusionScratch, Tolerance};
use super::occlusion_intervals::OcclusionIntervals;
use super::projected_edge::ProjectedEdge;
use super::screen_bvh::{ScreenEdge, TriangleMesh};

/// The positions along an edge where the number of faces in front of it changes.
///
/// Changes are counted in half faces: an edge that runs exactly behind a side is hidden by the
/// faces on its left and on its right together.
#[derive(Clone, Debug, Default)]
struct FaceCount {
    changes: Vec<(f64, i64)>,
}

impl FaceCount {
    /// Adds the occlusion by one face.
    fn insert(&mut self, occlusion: Occlusion) {
        let (interval, halves) = match occlusion {
            Occlusion::Interior(interval) => (interval, 2),
            Occlusion::Along(side) => (side.interval, 1),
            // Cracks are ignored here. A face that is only beside the edge would be counted in
            // addition to the face that hides the edge.
            Occlusion::Beside(_) => return,
        };
        self.changes.extend([(interval[0], halves), (interval[1], -halves)]);
    }

    /// Returns the intervals with more than `most` faces in front.
    fn intervals_above(&mut self, most: u32) -> OcclusionIntervals {
        self.changes.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut intervals = OcclusionIntervals::default();
        let (mut halves, mut start) = (0, None);
        for &(s, change) in &self.changes {
            halves += change;
            let is_above = halves / 2 > i64::from(most);
            match start {
                None if is_above => start = Some(s),
                Some(from) if !is_above => {
                    intervals.insert_interval([from, s]);
                    start = None;
                }
                _ => {}
            }
        }
        intervals
    }
}

impl<M: TriangleMesh> MeshOccluders<M> {
    /// Returns the intervals of s with more than `most` faces in front of an edge; slivers shorter
    /// than the tolerance are removed. The result is incomplete if no work is left in `scratch`.
    pub(crate) fn intervals_behind_faces(
        &self,
        edge: &ProjectedEdge,
        most: u32,
        scratch: &mut OcclusionScratch,
    ) -> OcclusionIntervals {
        let tolerance = Tolerance { crack: 0.0, ..self.tolerance };
        let on_screen = ScreenEdge::new(edge, self.respects_depth);
        let mut count = FaceCount::default();
        let mut nodes: Vec<u32> = self.screen.root_node().into_iter().collect();
        while let Some(node) = nodes.pop() {
            if !scratch.take_work(1) {
                break;
            }
            if self.screen.interval_behind(node, &on_screen).is_none() {
                continue;
            }
            match self.screen.contents(node) {
                Ok(children) => nodes.extend(children),
                Err(triangles) => {
                    if !scratch.take_work(triangles.len()) {
                        break;
                    }
                    for triangle in triangles {
                        let found = |one| count.insert(one);
                        self.occlude_edge(triangle, edge, &on_screen, &tolerance, found);
                    }
                }
            }
        }
        let mut intervals = count.intervals_above(most);
        intervals.remove_slivers(self.tolerance.min_part / edge.screen_length());
        intervals
    }
}

#[cfg(test)]
mod tests {
    use super::super::occluder::SideInterval;
    use super::*;

    #[test]
    fn faces_are_counted_in_halves_where_they_share_a_side() {
        let mut count = FaceCount::default();
        count.insert(Occlusion::Interior([0.1, 0.9]));
        count.insert(Occlusion::Interior([0.3, 0.6]));
        let side = |interval, is_left| SideInterval { interval, is_left, is_wide: true, object: 0 };
        count.insert(Occlusion::Along(side([0.4, 1.0], true)));
        assert_eq!(count.intervals_above(1).as_slice(), [[0.3, 0.6]]);
        assert_eq!(count.intervals_above(2).as_slice(), [[0.0; 2]; 0]);
        count.insert(Occlusion::Along(side([0.5, 0.8], false)));
        assert_eq!(count.intervals_above(2).as_slice(), [[0.5, 0.6]]);
        assert_eq!(count.intervals_above(1).as_slice(), [[0.3, 0.8]]);
        assert_eq!(count.intervals_above(0).as_slice(), [[0.1, 0.9]]);
    }

    #[test]
    fn faces_that_meet_count_as_one() {
        let mut count = FaceCount::default();
        for occlusion in [[0.0, 0.5], [0.5, 1.0]] {
            count.insert(Occlusion::Interior(occlusion));
        }
        assert_eq!(count.intervals_above(0).as_slice(), [[0.0, 1.0]]);
        assert_eq!(count.intervals_above(1).as_slice(), [[0.0; 2]; 0]);
    }
}
