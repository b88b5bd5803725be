//! Bicubic Bézier patches: points, and normals from the derivatives.
//!
//! `P(u, v) = Σ B_i(v) B_j(u) p_ij` with Bernstein's cubics (Bézier 1968; Foley et al., 2nd ed.,
//! §11.3.2). `u` runs along a row of control points, `v` from row to row. Normals are `P_u × P_v`.
//! At a pole, where all control points of a row coincide, `P_u` is zero. Near a pole,
//! `P_u ≈ ±v P_uv`, so the mixed derivative gives the limit of the direction.

use crate::mesh::Mesh;
use glam::{DVec3, DVec4, dvec4};

/// Four rows of four control points.
type Patch = [[DVec3; 4]; 4];

/// Adds a patch as a grid of `steps` by `steps` cells whose front faces along `P_u × P_v`.
pub(crate) fn tessellate(mesh: &mut Mesh, patch: &Patch, steps: u32) {
    let first = mesh.positions.len() as u32;
    for row in 0..=steps {
        for column in 0..=steps {
            let [u, v] = [column, row].map(|step| f64::from(step) / f64::from(steps));
            mesh.add_vertex(
                patch_point(patch, bernstein_cubics(u), bernstein_cubics(v)),
                patch_normal(patch, u, v),
            );
        }
    }
    mesh.add_grid_triangles(first, steps + 1, steps + 1);
}

fn patch_normal(patch: &Patch, u: f64, v: f64) -> DVec3 {
    let along_v = patch_point(patch, bernstein_cubics(u), bernstein_slopes(v));
    let along_u = patch_point(patch, bernstein_slopes(u), bernstein_cubics(v));
    if along_u.length() > 1e-9 {
        return along_u.cross(along_v).normalize();
    }
    // Away from the pole: forward from the first row, backward from the last.
    let away = if v < 0.5 { 1.0 } else { -1.0 };
    let opening = patch_point(patch, bernstein_slopes(u), bernstein_slopes(v)) * away;
    opening.cross(along_v).normalize()
}

/// Computes the weighted sum of the control points, with a weight for each column and each row.
fn patch_point(patch: &Patch, columns: DVec4, rows: DVec4) -> DVec3 {
    let blend = |points: [DVec3; 4], weights: DVec4| {
        points[0] * weights.x
            + points[1] * weights.y
            + points[2] * weights.z
            + points[3] * weights.w
    };
    blend(patch.map(|row| blend(row, columns)), rows)
}

/// Evaluates Bernstein's cubics at `t`.
fn bernstein_cubics(t: f64) -> DVec4 {
    let s = 1.0 - t;
    dvec4(s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t)
}

/// Evaluates the derivatives of Bernstein's cubics at `t`.
fn bernstein_slopes(t: f64) -> DVec4 {
    let s = 1.0 - t;
    dvec4(-3.0 * s * s, 3.0 * s * s - 6.0 * s * t, 6.0 * s * t - 3.0 * t * t, 3.0 * t * t)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::teapot_patches::teapot_parts;

    #[test]
    fn normals_are_perpendicular_to_small_steps_on_the_surface() {
        let step = 1e-6;
        for patch in teapot_parts().iter().flat_map(|part| &part.patches) {
            for (u, v) in [(0.3, 0.4), (0.7, 0.1), (0.5, 0.9)] {
                let at = |u, v| patch_point(patch, bernstein_cubics(u), bernstein_cubics(v));
                let normal = patch_normal(patch, u, v);
                assert!(normal.dot((at(u + step, v) - at(u - step, v)) / step).abs() < 1e-6);
                assert!(normal.dot((at(u, v + step) - at(u, v - step)) / step).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn normal_at_a_pole_is_the_limit_of_nearby_normals() {
        let poles = [("lid", 0.0, DVec3::Z), ("bottom", 1.0, DVec3::NEG_Z)];
        for (name, v, axis) in poles {
            let part = teapot_parts().into_iter().find(|part| part.name == name).unwrap();
            assert!(patch_normal(&part.patches[0], 0.3, v).dot(axis) > 0.999_999, "{name}");
        }
    }
}
