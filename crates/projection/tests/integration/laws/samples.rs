//! Random valid parameters and the comparisons that the laws need.

use glam::DMat4;
use homog::NdcY;
use homog::{Affine, Point, Vector, View};
use projection::{
    Axonometric, Convention, Fov, Frustum, Handedness, NPoint, Oblique, Orthographic, Perspective,
};
use proptest::prelude::*;

/// Configures this number of cases, or the number in `PROPTEST_CASES`. Failures are not written to
/// the source tree.
pub(crate) fn cases(cases: u32) -> ProptestConfig {
    let asked = ProptestConfig::default();
    let cases = if std::env::var_os("PROPTEST_CASES").is_some() { asked.cases } else { cases };
    let max_global_rejects = 1024 + 4 * cases;
    ProptestConfig { cases, max_global_rejects, failure_persistence: None, ..asked }
}

/// Generates all named conventions and their variants.
pub(crate) fn conventions() -> Vec<Convention> {
    let mut all = Vec::new();
    for depths in [Convention::CHAPTER, Convention::OPENGL, Convention::WEBGPU] {
        for handed in [Handedness::Right, Handedness::Left] {
            for y in [NdcY::Up, NdcY::Down] {
                let convention = depths.with_handedness(handed).with_ndc_y(y);
                all.extend([convention, convention.reversed()]);
            }
        }
    }
    all.push(Convention::OPENGL.with_depths(0.25, 0.75).expect("inside [−1, 1]"));
    all
}

pub(crate) fn convention() -> impl Strategy<Value = Convention> {
    prop::sample::select(conventions())
}

/// Generates two numbers that are not too close, in any order because windows may be mirrored.
pub(crate) fn edges() -> impl Strategy<Value = (f64, f64)> {
    (-5.0..5.0, 0.05..8.0, any::<bool>())
        .prop_map(|(a, size, mirrored)| if mirrored { (a + size, a) } else { (a, a + size) })
}

pub(crate) fn planes() -> impl Strategy<Value = (f64, f64)> {
    let near = (-3.0..1.5).prop_map(|exponent: f64| libm::exp10(exponent));
    let ratio =
        prop_oneof![4 => (0.01..4.0).prop_map(|e: f64| libm::exp10(e)), 1 => Just(f64::INFINITY)];
    (near, ratio).prop_map(|(near, ratio)| (near, near * ratio))
}

pub(crate) fn frustum() -> impl Strategy<Value = Frustum> {
    (edges(), edges(), planes()).prop_map(|((l, r), (b, t), (near, far))| {
        Frustum::new(l * near, r * near, b * near, t * near, near, far).expect("valid")
    })
}

pub(crate) fn perspective() -> impl Strategy<Value = Perspective> {
    (0.05..3.0, 0.2..5.0, planes()).prop_map(|(fov, aspect, (near, far))| {
        Perspective::new(Fov::Vertical(fov), aspect, near, far).expect("valid")
    })
}

pub(crate) fn orthographic() -> impl Strategy<Value = Orthographic> {
    (edges(), edges(), edges()).prop_map(|((l, r), (b, t), (near, far))| {
        Orthographic::new(l, r, b, t, near, far).expect("valid")
    })
}

/// Returns the largest difference between two matrices, relative to the larger of 1 and the largest
/// entry.
pub(crate) fn distance(a: DMat4, b: DMat4) -> f64 {
    let (a, b) = (a.to_cols_array(), b.to_cols_array());
    let size = b.iter().fold(1.0, |size: f64, x| size.max(x.abs()));
    a.iter().zip(b).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max) / size
}

pub(crate) fn point() -> impl Strategy<Value = Point<View>> {
    prop::array::uniform3(-3.0..3.0).prop_map(Point::from)
}

pub(crate) fn direction() -> impl Strategy<Value = Vector<View>> {
    prop::array::uniform3(-1.0_f64..1.0)
        .prop_map(Vector::from)
        .prop_filter("a direction", |direction| direction.length() > 0.1)
}

pub(crate) fn rotation() -> impl Strategy<Value = Affine<View, View>> {
    prop::array::uniform3(-3.0..3.0).prop_map(|[x, y, z]| {
        Affine::<View, View>::rotation_x(x)
            .then(Affine::<View, View>::rotation_y(y))
            .then(Affine::rotation_z(z))
    })
}

pub(crate) fn oblique() -> impl Strategy<Value = Oblique> {
    (0.05..2.0, -3.0..3.0).prop_map(|(length, phi)| Oblique::new(length, phi).expect("valid"))
}

/// Generates projections that are not upside down.
pub(crate) fn axonometric() -> impl Strategy<Value = Axonometric> {
    (-3.0..3.0, -1.5..1.5)
        .prop_map(|(alpha, beta)| Axonometric::by_angles(alpha, beta).expect("finite"))
}

pub(crate) fn npoint() -> impl Strategy<Value = NPoint> {
    let entry = || prop_oneof![Just(0.0), -0.2..-0.02, 0.02..0.2];
    (entry(), entry(), entry()).prop_filter_map("not all 0", |(p, q, r)| NPoint::new(p, q, r).ok())
}
