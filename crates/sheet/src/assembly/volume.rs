//! Volumes of closed meshes, by the divergence theorem.
//!
//! ```text
//!   V = ∑ a · (b × c) / 6      over all triangles abc: the signed volumes of pyramids
//!                              with their tips at one point
//! ```
//!
//! A mesh is closed if each edge occurs equally often in both directions. Overlapping pieces count
//! twice.

use super::part::{Part, drawn_primitives};
use glam::{DMat3, DVec3};
use model::{ModelInstance, Topology};

/// Returns the volume of a part in cubic world units, or `None` if its mesh is open or has no
/// triangles.
pub(super) fn part_volume(part: &Part, models: &[ModelInstance]) -> Option<f64> {
    let model = &models[part.model].model;
    let mut corners: Vec<[f32; 3]> = Vec::new();
    let mut scale = 1.0;
    for primitive in drawn_primitives(model, part.instance) {
        if primitive.topology != Topology::Triangles {
            continue;
        }
        let skinned = model.skin_primitive(part.instance, primitive);
        // All primitives of a part have the same scale.
        scale = DMat3::from_mat4(part.to_world(models, &skinned).raw()).determinant().abs();
        // Adding 0 turns −0 into 0, so that both give the same position.
        let corner = |&index: &u32| skinned.positions[index as usize].map(|c| c + 0.0);
        corners.extend(primitive.indices.iter().map(corner));
    }
    let triangles = corners.as_chunks::<3>().0;
    if triangles.is_empty() || !is_closed(triangles) {
        return None;
    }
    let point = |[x, y, z]: [f32; 3]| DVec3::new(x.into(), y.into(), z.into());
    // The tip of the pyramids is a corner of the mesh, because their sum would lose precision if
    // the origin were far away.
    let tip = point(triangles[0][0]);
    let pyramid = |triangle: &[[f32; 3]; 3]| {
        let [a, b, c] = triangle.map(|corner| point(corner) - tip);
        a.dot(b.cross(c)) / 6.0
    };
    let volume = triangles.iter().map(pyramid).sum::<f64>().abs() * scale;
    volume.is_finite().then_some(volume)
}

/// Whether every triangle edge occurs equally often in both directions.
fn is_closed(triangles: &[[[f32; 3]; 3]]) -> bool {
    let mut order: Vec<([u32; 3], u32)> =
        triangles.as_flattened().iter().zip(0..).map(|(c, at)| (c.map(f32::to_bits), at)).collect();
    order.sort_unstable();
    let mut ids = vec![0_u32; order.len()];
    let mut id = 0;
    for (at, (bits, corner)) in order.iter().enumerate() {
        if at > 0 && order[at - 1].0 != *bits {
            id += 1;
        }
        ids[*corner as usize] = id;
    }
    let mut sides: Vec<([u32; 2], i32)> = Vec::with_capacity(ids.len());
    for &[a, b, c] in ids.as_chunks::<3>().0 {
        for [from, to] in [[a, b], [b, c], [c, a]] {
            if from != to {
                sides.push(([from.min(to), from.max(to)], if from < to { 1 } else { -1 }));
            }
        }
    }
    sides.sort_unstable();
    let balanced = |run: &[([u32; 2], i32)]| run.iter().map(|(_, way)| way).sum::<i32>() == 0;
    sides.chunk_by(|(a, _), (b, _)| a == b).all(balanced)
}
