//! Shares vertices within a primitive between corners with the same position, texture coordinates
//! and normal.

use super::elements::{Corner, NONE};

/// Maximum number of vertices to compare at one position before a new vertex is added. Without this
/// limit, a position with many vertices would take quadratic time; with it, some identical corners
/// get separate vertices.
const MAX_COMPARISONS: usize = 32;

/// Collects the vertices of one primitive at a time, in the order of their first use.
#[derive(Debug)]
pub(super) struct VertexSharing {
    /// For each position, the vertex added last.
    latest: Vec<u32>,
    /// For each vertex, the previous vertex at the same position.
    before: Vec<u32>,
    /// The corner that each vertex represents.
    pub(super) corners: Vec<Corner>,
}

impl VertexSharing {
    /// Creates a table without any vertices.
    pub(super) fn new(positions: usize) -> Self {
        Self { latest: vec![NONE; positions], before: Vec::new(), corners: Vec::new() }
    }

    /// Returns the vertex of a corner. The position must be in range.
    #[inline]
    pub(super) fn vertex_at(&mut self, corner: Corner) -> u32 {
        let latest = self.latest[corner.position as usize];
        let mut candidate = latest;
        for _ in 0..MAX_COMPARISONS {
            if candidate == NONE {
                break;
            }
            if self.corners[candidate as usize] == corner {
                return candidate;
            }
            candidate = self.before[candidate as usize];
        }
        let new = self.corners.len() as u32;
        self.corners.push(corner);
        self.before.push(latest);
        self.latest[corner.position as usize] = new;
        new
    }

    /// Removes all vertices, in time proportional to their number.
    pub(super) fn clear(&mut self) {
        for corner in &self.corners {
            self.latest[corner.position as usize] = NONE;
        }
        self.before.clear();
        self.corners.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn identical_corners_share_a_vertex() {
        let mut sharing = VertexSharing::new(3);
        let corner = |position, uv, normal| Corner { position, uv, normal };
        let corners =
            [corner(2, 0, NONE), corner(0, 0, NONE), corner(2, 1, NONE), corner(2, 0, NONE)];
        assert_eq!(corners.map(|corner| sharing.vertex_at(corner)), [0, 1, 2, 0]);
        sharing.clear();
        assert_eq!(sharing.vertex_at(corner(2, 1, NONE)), 0);
        assert_eq!(sharing.corners, [corner(2, 1, NONE)]);
    }

    #[test]
    fn a_position_with_many_vertices_takes_linear_time() {
        let mut sharing = VertexSharing::new(1);
        for uv in 0..300_000 {
            sharing.vertex_at(Corner { position: 0, uv, normal: NONE });
        }
        assert_eq!(sharing.corners.len(), 300_000);
    }
}
