//! Angles between edges and between faces: the vertex, and a point on each side.

use super::picking::Picked;
use glam::DVec3;
use hidden_line::PickedFeature;

/// Edges are not in one plane if the distance between their nearest points is more than this
/// fraction of the distance between their midpoints.
const SKEW: f64 = 1e-3;

/// The error for a pair of picks, and a suggested fix.
type Fault = (&'static str, &'static str);

/// Returns the vertex of the angle between two edges or two faces, and a point on each of its
/// sides.
pub(super) fn angle_points(from: &Picked, to: &Picked) -> Result<[DVec3; 3], Fault> {
    match (from, to) {
        (Picked::Edge(a), Picked::Edge(b)) => between_edges(a, b),
        (Picked::Face(a), Picked::Face(b)) => between_faces(a, b),
        _ => Err((
            "an angle needs two edges, two faces, or a vertex and two points",
            "add vertex: …, or pick two edges",
        )),
    }
}

/// Returns the angle between two edges, toward the midpoint of each.
fn between_edges(a: &PickedFeature, b: &PickedFeature) -> Result<[DVec3; 3], Fault> {
    let [(p, u), (q, v)] = [a, b].map(|edge| (edge.middle.raw(), edge.direction.raw()));
    let normal = u.cross(v);
    if normal.length() < 1e-6 {
        return Err(("the edges are parallel", "pick edges that meet, or measure their distance"));
    }
    let apart = (q - p).dot(normal.normalize()).abs();
    if apart > SKEW * p.distance(q) {
        return Err((
            "the edges are not in one plane",
            "pick edges of one face, or specify a vertex and two points",
        ));
    }
    let vertex = p + u * ((q - p).cross(v).dot(normal) / normal.length_squared());
    let side = |middle: DVec3, along: DVec3| {
        if middle.distance(vertex) > 1e-9 { middle } else { vertex + along }
    };
    Ok([vertex, side(p, u), side(q, v)])
}

/// Returns the angle between two faces, in the plane perpendicular to both through the center of
/// the first.
fn between_faces(a: &PickedFeature, b: &PickedFeature) -> Result<[DVec3; 3], Fault> {
    let [(p, m), (q, n)] = [a, b].map(|face| (face.middle.raw(), face.direction.raw()));
    let axis = m.cross(n);
    if axis.length() < 1e-6 {
        return Err(("the faces are parallel", "pick faces that meet, or measure their distance"));
    }
    let axis = axis.normalize();
    // The intersection of three planes (Goldman 1990).
    let determinant = m.dot(n.cross(axis));
    let vertex = (n.cross(axis) * p.dot(m) + axis.cross(m) * q.dot(n) + m.cross(n) * p.dot(axis))
        / determinant;
    let level = |point: DVec3| point - axis * (point - vertex).dot(axis);
    Ok([vertex, level(p), level(q)])
}
