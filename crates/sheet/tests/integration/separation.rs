//! Finds intersections between the triangles of parts.

use glam::DVec3;
use model::{ModelInstance, Topology};

/// Returns the world-space triangles of each object, or none for objects made of lines.
pub fn part_triangles(models: &[ModelInstance]) -> Vec<Vec<[DVec3; 3]>> {
    let mut parts = Vec::new();
    for placed in models {
        let model = &placed.model;
        for instance in model.mesh_instances() {
            let mesh = model.nodes[instance.node].mesh.map(|mesh| &model.meshes[mesh]);
            let mut triangles = Vec::new();
            for primitive in mesh.into_iter().flat_map(|mesh| &mesh.primitives) {
                if primitive.topology != Topology::Triangles {
                    continue;
                }
                let skinned = model.skin_primitive(instance, primitive);
                let to_world = skinned.to_model.then(placed.model_to_world);
                let point = |index: &u32| {
                    let position = skinned.positions[*index as usize].map(f64::from);
                    to_world.transform_point(position.into()).raw()
                };
                let corners: Vec<DVec3> = primitive.indices.iter().map(point).collect();
                // Collinear corners have no normal, and the neighboring triangles cover them.
                let has_area = |[a, b, c]: &[DVec3; 3]| {
                    let (one, other) = (*b - *a, *c - *a);
                    one.cross(other).length() > 1e-9 * one.length() * other.length()
                };
                triangles.extend(corners.as_chunks::<3>().0.iter().filter(|t| has_area(t)));
            }
            parts.push(triangles);
        }
    }
    parts
}

/// A box, as its minimum and maximum corners.
type Corners = [DVec3; 2];

fn corners_of(triangles: &[[DVec3; 3]]) -> Corners {
    let points = triangles.iter().flatten();
    points.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], point| {
        [low.min(*point), high.max(*point)]
    })
}

fn boxes_meet(a: &Corners, b: &Corners) -> bool {
    a[0].cmple(b[1]).all() && b[0].cmple(a[1]).all()
}

/// Returns the pairs of parts whose triangles intersect. Triangles are compared only if the boxes
/// of the parts meet.
pub fn intersecting_parts(parts: &[Vec<[DVec3; 3]>]) -> Vec<[usize; 2]> {
    let boxes: Vec<Corners> = parts.iter().map(|part| corners_of(part)).collect();
    let mut found = Vec::new();
    for (a, own) in boxes.iter().enumerate() {
        for (b, other) in boxes.iter().enumerate().skip(a + 1) {
            if boxes_meet(own, other) && triangles_intersect(&parts[a], &parts[b]) {
                found.push([a, b]);
            }
        }
    }
    found
}

/// Whether a triangle of one part intersects a triangle of another.
fn triangles_intersect(a: &[[DVec3; 3]], b: &[[DVec3; 3]]) -> bool {
    let near = |triangles: &[[DVec3; 3]], area: Corners| -> Vec<[DVec3; 3]> {
        let is_near = |one: &&[DVec3; 3]| boxes_meet(&corners_of(&[**one]), &area);
        triangles.iter().filter(is_near).copied().collect()
    };
    let (a, b) = (near(a, corners_of(b)), near(b, corners_of(a)));
    a.iter().any(|one| {
        let area = corners_of(&[*one]);
        b.iter()
            .any(|other| boxes_meet(&area, &corners_of(&[*other])) && !are_separate(*one, *other))
    })
}

/// Whether an axis separates two triangles. The candidates are their normals, the cross products of
/// their edges and, for coplanar triangles, the normals of their edges in the plane.
fn are_separate(a: [DVec3; 3], b: [DVec3; 3]) -> bool {
    let sides = |[p, q, r]: [DVec3; 3]| [q - p, r - q, p - r];
    let (a_sides, b_sides) = (sides(a), sides(b));
    let normals = [a_sides[0].cross(a_sides[1]), b_sides[0].cross(b_sides[1])];
    let products = a_sides.into_iter().flat_map(|s| b_sides.map(|t| s.cross(t)));
    let in_plane = [(a_sides, normals[0]), (b_sides, normals[1])];
    let in_plane = in_plane.into_iter().flat_map(|(sides, normal)| sides.map(|s| s.cross(normal)));
    let axes = normals.into_iter().chain(products).chain(in_plane).chain(DVec3::AXES);
    let span = |corners: [DVec3; 3], axis: DVec3| {
        let along = corners.map(|corner| corner.dot(axis));
        along
            .into_iter()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], at| [low.min(at), high.max(at)])
    };
    let mut directions = axes.into_iter().filter_map(DVec3::try_normalize);
    directions.any(|axis| {
        let ([a_low, a_high], [b_low, b_high]) = (span(a, axis), span(b, axis));
        a_high < b_low || b_high < a_low
    })
}
