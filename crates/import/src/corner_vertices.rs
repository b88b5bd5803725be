//! Splits vertices whose corners have different colors or texture coordinates.
//!
//! PLY and 3MF attach attributes to faces and corners; a primitive has attributes only at vertices.

/// Marks the end of a list.
const NONE: u32 = u32::MAX;
/// Maximum number of attributes to compare before a vertex is split again. Without this limit, a
/// vertex with many different corners would take quadratic time.
const MAX_COMPARISONS: usize = 32;

/// The attributes of a corner other than its position.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct CornerAttributes {
    /// Texture coordinates.
    pub(super) uv: [f32; 2],
    /// Linear color.
    pub(super) color: [f32; 4],
}

impl Default for CornerAttributes {
    /// Returns the origin of the texture and the color white.
    fn default() -> Self {
        Self { uv: [0.0; 2], color: [1.0; 4] }
    }
}

/// New vertices, one for each distinct combination of an old vertex and attributes.
#[derive(Debug)]
pub(super) struct CornerVertices {
    /// For each old vertex, the new vertex added last.
    latest: Vec<u32>,
    /// For each new vertex, the previous new vertex of the same old vertex.
    before: Vec<u32>,
    /// For each new vertex, the old vertex.
    pub(super) sources: Vec<u32>,
    /// For each new vertex, its attributes.
    pub(super) attributes: Vec<CornerAttributes>,
}

impl CornerVertices {
    /// Creates a table without new vertices for this number of old vertices.
    pub(super) fn new(vertices: usize) -> Self {
        Self {
            latest: vec![NONE; vertices],
            before: Vec::new(),
            sources: Vec::new(),
            attributes: Vec::new(),
        }
    }

    /// Returns the new vertex of a corner. `vertex` must be less than the number of old vertices.
    pub(super) fn vertex_at(&mut self, vertex: u32, attributes: CornerAttributes) -> u32 {
        let latest = self.latest[vertex as usize];
        let mut candidate = latest;
        for _ in 0..MAX_COMPARISONS {
            if candidate == NONE {
                break;
            }
            if self.attributes[candidate as usize] == attributes {
                return candidate;
            }
            candidate = self.before[candidate as usize];
        }
        let new = self.sources.len() as u32;
        self.before.push(latest);
        self.sources.push(vertex);
        self.attributes.push(attributes);
        self.latest[vertex as usize] = new;
        new
    }

    /// Removes all new vertices, in time proportional to their number.
    pub(super) fn clear(&mut self) {
        for &source in &self.sources {
            self.latest[source as usize] = NONE;
        }
        self.before.clear();
        self.sources.clear();
        self.attributes.clear();
    }

    /// Returns, for each new vertex, the value of its old vertex.
    pub(super) fn gather<T: Copy>(&self, values: &[T]) -> Vec<T> {
        self.sources.iter().map(|&source| values[source as usize]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_identical_corners_share_a_vertex() {
        let mut vertices = CornerVertices::new(2);
        let white = CornerAttributes::default();
        let red = CornerAttributes { color: [1.0, 0.0, 0.0, 1.0], ..white };
        let corners = [(1, white), (1, red), (0, white), (1, white), (1, red)];
        let new = corners.map(|(vertex, attributes)| vertices.vertex_at(vertex, attributes));
        assert_eq!(new, [0, 1, 2, 0, 1]);
        assert_eq!(vertices.gather(&['a', 'b']), ['b', 'b', 'a']);
        vertices.clear();
        assert_eq!(vertices.vertex_at(1, red), 0);
    }
}
