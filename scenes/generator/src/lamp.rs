//! A desk lamp of nested nodes: base, two arms, head. Rotating a joint moves all nodes below it.
//!
//! ```text
//!  base ─► lower arm ─► upper arm ─► head (a matrix) ─► bulb
//! ```
//! Each arm is modeled along the y axis of its node and ends at the next joint's node.

use crate::document::{Document, rotation_quaternion};
use crate::mesh::{Mesh, sharp_outline};
use crate::palette::{BRICK, CREAM, INK, OCHRE};
use glam::DVec3;
use serde_json::{Value, json};

const LOWER_ARM: f64 = 1.5;
const UPPER_ARM: f64 = 1.3;

pub(crate) fn lamp() -> Document {
    let mut document = Document::default();
    let enamel = document.add_double_sided("enamel", BRICK);
    let steel = document.add_material("steel", INK);
    let brass = document.add_material("brass", OCHRE);
    let milk = document.add_material("milk glass", CREAM);

    let joint = Mesh::sphere(0.11, 20);
    let foot = Mesh::lathe(
        &sharp_outline(&[
            (0.0, 0.0),
            (0.62, 0.0),
            (0.62, 0.08),
            (0.12, 0.16),
            (0.12, 0.28),
            (0.0, 0.28),
        ]),
        40,
    );
    let foot = document.add_mesh("foot", &[(&foot, enamel)]);
    let arm = |length| Mesh::post(0.05, 0.05, length, 16);
    let lower = document.add_mesh("lower arm", &[(&arm(LOWER_ARM), steel), (&joint, brass)]);
    let upper = document.add_mesh("upper arm", &[(&arm(UPPER_ARM), steel), (&joint, brass)]);
    let head = document.add_mesh("head", &[(&shade_mesh(), enamel), (&joint, brass)]);
    let bulb = document.add_mesh("bulb", &[(&Mesh::sphere(0.2, 24), milk)]);

    let base = document.add_root("base", Some(foot), json!({}));
    let lower = document.add_child(base, "lower arm", Some(lower), joint_node(0.3, DVec3::Z, 28.0));
    let upper =
        document.add_child(lower, "upper arm", Some(upper), joint_node(LOWER_ARM, DVec3::Z, -86.0));
    let head = document.add_child(upper, "head", Some(head), head_matrix());
    document.add_child(head, "bulb", Some(bulb), json!({ "translation": [0.0, 0.52, 0.0] }));
    document
}

/// Returns the node of a joint, translated along the previous part, then rotated.
fn joint_node(at: f64, axis: DVec3, degrees: f64) -> Value {
    json!({ "translation": [0.0, at, 0.0], "rotation": rotation_quaternion(axis, degrees) })
}

/// Returns the head's transform as a column-major matrix: −78° about z at the end of the upper arm,
/// scaled by 1.1 along its axis.
fn head_matrix() -> Value {
    let (sine, cosine) = libm::sincos((-78.0_f64).to_radians());
    let length = 1.1;
    json!({ "matrix": [
        cosine, sine, 0.0, 0.0,
        -sine * length, cosine * length, 0.0, 0.0,
        0.0, 0.0, 1.0, 0.0,
        0.0, UPPER_ARM, 0.0, 1.0,
    ] })
}

/// Builds a bell about the y axis, open at the top.
fn shade_mesh() -> Mesh {
    Mesh::lathe(
        &sharp_outline(&[(0.0, 0.1), (0.16, 0.1), (0.18, 0.24), (0.5, 0.72), (0.5, 0.78)]),
        40,
    )
}
