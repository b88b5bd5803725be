//! Regions: areas that faces cover on the screen, represented by their border edges.
//!
//! ```text
//!    ┌─────┐
//!    │╲    │     the diagonal runs both ways and cancels out; a remaining edge
//!    │  ╲  │     has more faces on one side than on the other
//!    └─────┘
//! ```
//!
//! Every triangle is oriented positively on the screen, and the directed sides of all triangles are
//! summed. The winding number of the sum around a point is the number of triangles that cover it,
//! even if the mesh is open, self-intersecting or inside out. Shared vertices have identical bits
//! on the screen, and adjacent triangles are clipped to identical points, so sides cancel exactly.

use super::projector::Projector;
use clip::{Volume, clip_triangle};
use glam::{DVec2, DVec3};

/// A directed side with its multiplicity: the number of faces on its left minus the number on its
/// right, as if y pointed up.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct RegionEdge {
    /// The ends on the screen, in pixels, with y down.
    pub ends: [DVec2; 2],
    /// The multiplicity; never 0.
    pub winding: i32,
}

/// An area on the screen covered by at least one face.
#[derive(Clone, PartialEq, Debug)]
pub struct Region {
    /// The object that the area belongs to, or `None` for the whole scene.
    pub object: Option<u32>,
    /// The sides of the covering faces that did not cancel; other faces may cover some of them.
    pub edges: Vec<RegionEdge>,
    /// The hatch lines in the area.
    pub hatching: Option<RegionHatching>,
}

/// Equally spaced parallel lines, one of which passes through the upper left corner of the screen.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct RegionHatching {
    /// The unit vector along the lines, with y down.
    pub direction: DVec2,
    /// The distance between lines in pixels.
    pub spacing: f64,
}

/// Returns the sides of the area that triangles cover on the screen, sorted.
///
/// Triangles are clipped to the view volume, so the border of the picture may be a side.
pub fn region_edges(
    triangles: impl Iterator<Item = [DVec3; 3]>,
    projector: &Projector,
) -> Vec<RegionEdge> {
    let mut sides: Vec<([DVec2; 2], i32)> = Vec::new();
    for vertices in triangles {
        let clip = vertices.map(|vertex| projector.world_to_clip_point(vertex));
        let polygon: Option<Vec<DVec2>> = clip_triangle(clip, &Volume::CHAPTER)
            .vertices()
            .iter()
            .map(|vertex| Some(projector.project_to_screen(vertex.point)?.truncate()))
            .collect();
        add_polygon(&polygon.unwrap_or_default(), &mut sides);
    }
    sides.sort_unstable_by(|(a, _), (b, _)| compare_ends(a, b));
    let sums = sides.chunk_by(|(a, _), (b, _)| a == b).map(|same| RegionEdge {
        ends: same[0].0,
        winding: same.iter().map(|(_, sign)| sign).sum(),
    });
    sums.filter(|edge| edge.winding != 0).collect()
}

/// Adds the sides of a convex polygon, each from its lower end to its higher end, with a sign.
fn add_polygon(polygon: &[DVec2], sides: &mut Vec<([DVec2; 2], i32)>) {
    let Some(&first) = polygon.first() else { return };
    let fan = polygon.windows(2).map(|pair| (pair[0] - first).perp_dot(pair[1] - first));
    let area = fan.sum::<f64>();
    if area == 0.0 {
        return;
    }
    let turn = if area > 0.0 { 1 } else { -1 };
    for (&from, &to) in polygon.iter().zip(polygon.iter().cycle().skip(1)) {
        // Adding 0 turns −0 into 0, so equal points have identical bits.
        let (from, to) = (from + DVec2::ZERO, to + DVec2::ZERO);
        match compare_points(from, to) {
            std::cmp::Ordering::Less => sides.push(([from, to], turn)),
            std::cmp::Ordering::Greater => sides.push(([to, from], -turn)),
            std::cmp::Ordering::Equal => {}
        }
    }
}

/// Orders points by x, then by y.
fn compare_points(a: DVec2, b: DVec2) -> std::cmp::Ordering {
    a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y))
}

/// Orders sides by their first ends, then by their second ends.
fn compare_ends(a: &[DVec2; 2], b: &[DVec2; 2]) -> std::cmp::Ordering {
    compare_points(a[0], b[0]).then(compare_points(a[1], b[1]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shared_sides_cancel_in_any_orientation() {
        let [a, b, c, d] = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]].map(DVec2::from);
        let mut sides = Vec::new();
        add_polygon(&[a, b, c], &mut sides);
        add_polygon(&[a, d, c], &mut sides);
        let diagonal: i32 =
            sides.iter().filter(|(ends, _)| *ends == [a, c]).map(|(_, sign)| sign).sum();
        assert_eq!((sides.len(), diagonal), (6, 0));
        let mut none = Vec::new();
        add_polygon(&[a, b, a], &mut none);
        assert_eq!(none, []);
    }
}
