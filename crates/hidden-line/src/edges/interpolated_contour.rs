//! Interpolated contours: approximate silhouettes of smooth surfaces, across their triangles.
//!
//! ```text
//!          +                        n·v is given at the vertices and linear along the sides: it is
//!         ╱ ╲                       zero on a line across the triangle. The lines of adjacent
//!     ●──╱───╲──●  n·v = 0          triangles continue each other.
//!       ╱     ╲
//!      − ───── −
//! ```
//!
//! The method follows Hertzmann and Zorin, *Illustrating smooth surfaces* (2000). The silhouette of
//! the mesh consists of triangle sides, so it zigzags near the silhouette of the surface that the
//! mesh approximates. A vertex normal is the average over the faces that smooth edges join there.
//! Where the surface is convex, Phong tessellation (Boubekeur and Alexa 2008) lifts points from the
//! triangles toward the curved surface; otherwise faces of the mesh would hide them.
//!
//! This is an approximation that fails in known ways. A contour can have gaps or loose ends at
//! cusps, where it runs along the line of sight, because visibility is computed from the mesh. The
//! contour is not the border of the area that the mesh covers: with large triangles, it runs beside
//! that border. Where it ends at a crease, it misses the crease by the height of the lift. Averaged
//! normals round off edges that are slightly too blunt to be creases, so their silhouettes can be
//! missing.

use super::classify::EdgeClassifier;
use super::half_edges::{HalfEdge, HalfEdges};
use super::world_mesh::{Face, WorldMesh};
use crate::projector::Projector;
use glam::DVec3;

/// The weight of Phong tessellation in the lift. The authors' value raises the middle of an arc
/// slightly above the circle.
const LIFT: f64 = 0.75;

/// Returns the contours of all smooth faces for one viewer, face by face, with their objects.
pub(super) fn interpolated_contours(
    mesh: &WorldMesh,
    half_edges: &HalfEdges,
    classifier: &EdgeClassifier<'_>,
    projector: &Projector,
) -> Vec<([DVec3; 2], u32)> {
    let normals = SmoothNormals::new(mesh, half_edges, classifier);
    let mut contours = Vec::new();
    for (face, index) in mesh.faces.iter().zip(0..) {
        let corners = [0, 1, 2].map(|k| normals.corner(mesh, face, index, k, projector));
        let side = |k: usize| crossing(corners[k], corners[(k + 1) % 3]);
        let mut crossings = (0..3).filter_map(side);
        if let (Some(from), Some(to)) = (crossings.next(), crossings.next())
            && from != to
        {
            contours.push(([from, to], face.object));
        }
    }
    contours
}

/// A corner of a face, with its value of n·v for one viewer.
#[derive(Clone, Copy)]
struct Corner {
    vertex: u32,
    position: DVec3,
    normal: DVec3,
    facing: f64,
}

/// Returns the lifted point of a side where n·v is zero, or `None` if n·v has the same sign at both
/// ends.
///
/// The point is computed from the lower vertex to the higher, so both faces get identical bits.
fn crossing(one: Corner, other: Corner) -> Option<DVec3> {
    let [a, b] = if one.vertex < other.vertex { [one, other] } else { [other, one] };
    if (a.facing > 0.0) == (b.facing > 0.0) {
        return None;
    }
    let t = a.facing / (a.facing - b.facing);
    let flat = a.position.lerp(b.position, t);
    // Where the surface is concave along the side, the side is already in front of it.
    let onto_plane = |corner: Corner| {
        let height = (flat - corner.position).dot(corner.normal);
        flat - corner.normal * height.min(0.0)
    };
    Some(flat.lerp(onto_plane(a).lerp(onto_plane(b), t), LIFT))
}

/// Unit normals of the face corners, shared by corners that are joined across smooth edges.
struct SmoothNormals {
    /// The first corner of each corner's fan, with three corners per face.
    fans: Vec<u32>,
    /// The normals by corner; only the entries of first corners are used.
    normals: Vec<DVec3>,
}

impl SmoothNormals {
    /// Joins corners across smooth edges into fans, and adds up the area vectors of the faces of
    /// each fan.
    fn new(mesh: &WorldMesh, half_edges: &HalfEdges, classifier: &EdgeClassifier<'_>) -> Self {
        let mut fans: Vec<u32> = (0..mesh.faces.len() as u32 * 3).collect();
        for (ends, sides) in half_edges.edges() {
            let &[one, other] = sides else { continue };
            if classifier.is_smooth_between(one, other) {
                for end in ends {
                    let corners = [one, other].map(|side| corner_at(mesh, side, end));
                    join_fans(&mut fans, corners);
                }
            }
        }
        for corner in 0..fans.len() as u32 {
            fans[corner as usize] = first_of_fan(&fans, corner);
        }
        let mut normals = vec![DVec3::ZERO; fans.len()];
        for (face, index) in mesh.faces.iter().zip(0_usize..) {
            let [a, b, c] = face.vertices.map(|vertex| mesh.points[vertex as usize]);
            let area = (b - a).cross(c - a);
            fans[3 * index..3 * index + 3].iter().for_each(|&fan| normals[fan as usize] += area);
        }
        normals.iter_mut().for_each(|normal| *normal = normal.normalize_or_zero());
        Self { fans, normals }
    }

    /// Returns a corner of a face for this viewer.
    fn corner(
        &self,
        mesh: &WorldMesh,
        face: &Face,
        index: usize,
        k: usize,
        projector: &Projector,
    ) -> Corner {
        let vertex = face.vertices[k];
        let position = mesh.points[vertex as usize];
        let normal = self.normals[self.fans[3 * index + k] as usize];
        Corner { vertex, position, normal, facing: normal.dot(projector.towards_viewer(position)) }
    }
}

/// Returns the index of the corner at a vertex in the face of a half-edge.
fn corner_at(mesh: &WorldMesh, side: HalfEdge, vertex: u32) -> u32 {
    let vertices = mesh.faces[side.face() as usize].vertices;
    let k = vertices.iter().position(|&other| other == vertex).unwrap_or(0);
    side.face() * 3 + k as u32
}

/// Returns the first corner of the fan that contains a corner.
fn first_of_fan(fans: &[u32], mut corner: u32) -> u32 {
    while fans[corner as usize] != corner {
        corner = fans[corner as usize];
    }
    corner
}

/// Merges the fans of two corners, with path compression.
fn join_fans(fans: &mut [u32], corners: [u32; 2]) {
    let [a, b] = corners.map(|corner| first_of_fan(fans, corner));
    fans[a.max(b) as usize] = a.min(b);
    corners.into_iter().for_each(|corner| fans[corner as usize] = a.min(b));
}
