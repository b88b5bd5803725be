//! A vase on a plinth: a surface of revolution for light and shadow.

use crate::document::Document;
use crate::mesh::{Mesh, OutlinePoint, sharp_outline};
use crate::palette::{PAPER, SAND, SLATE};
use glam::{DVec2, DVec3, dvec2, dvec3};
use serde_json::json;

/// Radius and height from foot to lip, interpolated by a smooth curve.
const OUTLINE: [DVec2; 9] = [
    dvec2(0.30, 0.00),
    dvec2(0.33, 0.10),
    dvec2(0.50, 0.40),
    dvec2(0.62, 0.80),
    dvec2(0.52, 1.20),
    dvec2(0.26, 1.48),
    dvec2(0.19, 1.70),
    dvec2(0.27, 1.90),
    dvec2(0.36, 1.98),
];

/// Segments of the curve between two points of the outline.
const CURVE_STEPS: u32 = 5;

pub(crate) fn vase() -> Document {
    let mut document = Document::default();
    let glaze = document.add_double_sided("white glaze", PAPER);
    let stone = document.add_material("stone", SAND);
    let ground = document.add_material("ground", SLATE);

    let vase = document.add_mesh("vase", &[(&Mesh::lathe(&outline_curve(), 48), glaze)]);
    document.add_root("vase", Some(vase), json!({ "translation": [0.0, 1.2, 0.0] }));

    let mut plinth = Mesh::block_on(DVec3::ZERO, dvec3(1.5, 0.18, 1.5)).without_uvs();
    plinth.append(&Mesh::block_on(dvec3(0.0, 0.18, 0.0), dvec3(1.2, 0.87, 1.2)).without_uvs());
    plinth.append(&Mesh::block_on(dvec3(0.0, 1.05, 0.0), dvec3(1.4, 0.15, 1.4)).without_uvs());
    let plinth = document.add_mesh("plinth", &[(&plinth, stone)]);
    document.add_root("plinth", Some(plinth), json!({}));

    let disc = Mesh::lathe(&sharp_outline(&[(2.3, -0.15), (2.3, 0.0), (0.0, 0.0)]), 72);
    let disc = document.add_mesh("ground", &[(&disc, ground)]);
    document.add_root("ground", Some(disc), json!({}));
    document
}

/// Returns a Catmull-Rom curve through the outline (Catmull and Rom 1974), from foot to lip.
fn outline_curve() -> Vec<OutlinePoint> {
    let mut turned = Vec::new();
    let point = |i: usize| OUTLINE[i.min(OUTLINE.len() - 1)];
    for i in 0..OUTLINE.len() - 1 {
        let four = [point(i.saturating_sub(1)), point(i), point(i + 1), point(i + 2)];
        let last = u32::from(i == OUTLINE.len() - 2);
        for step in 0..CURVE_STEPS + last {
            turned.push(curve_point(four, f64::from(step) / f64::from(CURVE_STEPS)));
        }
    }
    turned
}

/// Returns the point at `t` between the second and the third of four points, and the normal to the
/// right of the curve's direction.
fn curve_point([a, b, c, d]: [DVec2; 4], t: f64) -> OutlinePoint {
    let (p, q, r) = (c - a, a * 2.0 - b * 5.0 + c * 4.0 - d, b * 3.0 - a - c * 3.0 + d);
    let place = b + (p * t + q * (t * t) + r * (t * t * t)) * 0.5;
    let way = p + q * (2.0 * t) + r * (3.0 * t * t);
    OutlinePoint { radius: place.x, height: place.y, normal: dvec2(way.y, -way.x).normalize() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_passes_through_every_point_of_the_outline() {
        let curve = outline_curve();
        assert_eq!(curve.len(), (OUTLINE.len() - 1) * CURVE_STEPS as usize + 1);
        for (turned, point) in curve.iter().step_by(CURVE_STEPS as usize).zip(OUTLINE) {
            assert!((dvec2(turned.radius, turned.height) - point).length() < 1e-12);
        }
    }
}
