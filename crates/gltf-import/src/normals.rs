//! Repairs normals, so that every normal of an imported primitive has unit length.

use glam::{DVec3, Vec3};
use model::{Primitive, Topology};

/// Counts of corrected normals.
#[derive(Default, Debug, PartialEq, Eq)]
pub struct NormalRepairs {
    /// Normals that had a direction but not unit length.
    pub lengths: usize,
    /// Normals without a direction (zero, infinite or NaN).
    pub replaced: usize,
}

/// Normalizes all normals. A normal without a direction is replaced by the area-weighted mean
/// normal of the triangles around its vertex, or by (0, 0, 1) if that has no direction either.
///
/// Deviations of up to 2%, which quantization to bytes can cause, are corrected but not counted.
/// The time is linear; the sums over triangles are computed only if a normal has no direction.
/// Comparing the squared length avoids a square root for normals that are already correct.
pub fn normalize_normals(primitive: &mut Primitive) -> NormalRepairs {
    let mut repairs = NormalRepairs::default();
    let Some(mut normals) = primitive.normals.take() else { return repairs };
    let mut undirected = Vec::new();
    for (vertex, normal) in normals.iter_mut().enumerate() {
        let [x, y, z] = Vec3::from_array(*normal).as_dvec3().to_array();
        let square = x * x + y * y + z * z;
        if (square - 1.0).abs() < 1e-6 {
            continue;
        }
        if square > 1e-30 && square.is_finite() {
            let length = square.sqrt();
            *normal = [x / length, y / length, z / length].map(|x| x as f32);
            repairs.lengths += usize::from((length - 1.0).abs() > 0.02);
        } else {
            undirected.push(vertex);
        }
    }
    repairs.replaced = undirected.len();
    if !undirected.is_empty() {
        let means = area_weighted_normals(primitive);
        for vertex in undirected {
            let mean = means[vertex];
            let unit = if mean.length_squared() > 0.0 { mean.normalize() } else { DVec3::Z };
            normals[vertex] = unit.to_array().map(|x| x as f32);
        }
    }
    primitive.normals = Some(normals);
    repairs
}

/// Computes for each vertex the sum of its triangles' normals, each with a length of twice the
/// triangle's area.
///
/// The cross product of two edges has this length, so no normalization is needed, and slivers have
/// little weight.
fn area_weighted_normals(primitive: &Primitive) -> Vec<DVec3> {
    let mut sums = vec![DVec3::ZERO; primitive.positions.len()];
    if primitive.topology != Topology::Triangles {
        return sums;
    }
    for corners in primitive.indices.as_chunks::<3>().0 {
        let [a, b, c] =
            corners.map(|i| DVec3::from(primitive.positions[i as usize].map(f64::from)));
        let normal = (b - a).cross(c - a);
        for &corner in corners {
            sums[corner as usize] += normal;
        }
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_are_normalized_or_replaced() {
        let mut primitive = Primitive {
            indices: vec![0, 1, 2],
            positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [5.0; 3]],
            normals: Some(vec![[0.0, 0.0, 2.0], [0.0; 3], [f32::NAN, 0.0, 0.0], [0.0; 3]]),
            ..Primitive::default()
        };
        assert_eq!(normalize_normals(&mut primitive), NormalRepairs { lengths: 1, replaced: 3 });
        let up = [0.0, 1.0, 0.0];
        assert_eq!(primitive.normals.unwrap(), [[0.0, 0.0, 1.0], up, up, [0.0, 0.0, 1.0]]);
    }
}
