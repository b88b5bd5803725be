//! Resolves primitive modes: expands strips, loops and fans into lists of lines or triangles.
//!
//! ```text
//!  line strip      line loop       triangle strip      triangle fan
//!  0──1  ╱3        0──1            0───2───4           1───2
//!     │ ╱          │  │            │╲  │╲  │           │ ╱ ╱ ╲
//!     2            3──2            1───3───5           0──────3
//!  01 12 23        01 12 23 30     012 132 234 354     120 230
//! ```
//!
//! Every second triangle of a strip is flipped, so that all have the same winding. The vertex order
//! follows glTF 2.0 §3.7.2.1.

use gltf::json::mesh::Mode;
use model::Topology;

/// Expands a sequence of vertices into a list. Leftover vertices that do not form another item are
/// dropped.
///
/// Lists need up to three times as many indices as strips, but later steps then have only one case
/// to handle. Degenerate triangles, which stitch strips together, are retained, because they cover
/// no pixels.
pub(super) fn expand_to_list(mode: Mode, mut vertices: Vec<u32>) -> (Topology, Vec<u32>) {
    let topology = match mode {
        Mode::Points => Topology::Points,
        Mode::Lines | Mode::LineLoop | Mode::LineStrip => Topology::Lines,
        Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan => Topology::Triangles,
    };
    let list = match mode {
        Mode::Points | Mode::Lines | Mode::Triangles => {
            vertices.truncate(vertices.len() - vertices.len() % topology.vertices_per_item());
            vertices
        }
        Mode::LineStrip => line_strip(&vertices),
        Mode::LineLoop => line_loop(&vertices),
        Mode::TriangleStrip => triangle_strip(&vertices),
        Mode::TriangleFan => triangle_fan(&vertices),
    };
    (topology, list)
}

/// Returns the lines between consecutive vertices: n vertices give n − 1 lines.
fn line_strip(vertices: &[u32]) -> Vec<u32> {
    vertices.array_windows().flat_map(|&[a, b]: &[u32; 2]| [a, b]).collect()
}

/// Returns the lines of a strip, closed by a line from the last vertex to the first.
fn line_loop(vertices: &[u32]) -> Vec<u32> {
    let mut lines = line_strip(vertices);
    if let [first, .., last] = vertices {
        lines.extend([*last, *first]);
    }
    lines
}

/// Returns the triangles that every three consecutive vertices form; every second triangle is
/// flipped to preserve the winding.
fn triangle_strip(vertices: &[u32]) -> Vec<u32> {
    let triangle = |(at, &[a, b, c]): (usize, &[u32; 3])| match at % 2 {
        0 => [a, b, c],
        _ => [a, c, b],
    };
    vertices.array_windows().enumerate().flat_map(triangle).collect()
}

/// Returns the triangles around the first vertex, each with two consecutive vertices of the rim.
///
/// The order `a b hub` follows the specification; a cyclic permutation would have the same winding
/// but different edge numbers.
fn triangle_fan(vertices: &[u32]) -> Vec<u32> {
    let Some((&hub, rim)) = vertices.split_first() else { return Vec::new() };
    rim.array_windows().flat_map(|&[a, b]: &[u32; 2]| [a, b, hub]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_mode_is_expanded() {
        let table: [(Mode, Topology, &[u32]); 7] = [
            (Mode::Points, Topology::Points, &[0, 1, 2, 3, 4]),
            (Mode::Lines, Topology::Lines, &[0, 1, 2, 3]),
            (Mode::LineStrip, Topology::Lines, &[0, 1, 1, 2, 2, 3, 3, 4]),
            (Mode::LineLoop, Topology::Lines, &[0, 1, 1, 2, 2, 3, 3, 4, 4, 0]),
            (Mode::Triangles, Topology::Triangles, &[0, 1, 2]),
            (Mode::TriangleStrip, Topology::Triangles, &[0, 1, 2, 1, 3, 2, 2, 3, 4]),
            (Mode::TriangleFan, Topology::Triangles, &[1, 2, 0, 2, 3, 0, 3, 4, 0]),
        ];
        for (mode, topology, expected) in table {
            assert_eq!(
                expand_to_list(mode, vec![0, 1, 2, 3, 4]),
                (topology, expected.to_vec()),
                "{mode:?}"
            );
        }
    }

    #[test]
    fn too_few_vertices_give_no_items() {
        use Mode::{LineLoop, LineStrip, Lines, TriangleFan, TriangleStrip, Triangles};
        for mode in [Lines, LineLoop, LineStrip, Triangles, TriangleStrip, TriangleFan] {
            assert!(expand_to_list(mode, Vec::new()).1.is_empty(), "{mode:?}");
            assert!(expand_to_list(mode, vec![7]).1.is_empty(), "{mode:?}");
        }
        assert!(expand_to_list(TriangleStrip, vec![0, 1]).1.is_empty());
        assert!(expand_to_list(TriangleFan, vec![0, 1]).1.is_empty());
    }
}
