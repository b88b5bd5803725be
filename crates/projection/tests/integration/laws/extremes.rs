//! For any numbers, a builder either rejects them or returns only finite results. Nothing panics.

use super::samples::{self, convention, conventions};
use glam::DMat4;
use homog::{Clip, Normal, Plane, Point, Projective, Vector, View};
use projection::{
    ApexMovedFrustum, Axonometric, Classical, ConstructedPerspective, Convention, DepthCurve,
    DepthFormat, FourAngles, Fov, Frustum, Jitter, NPoint, Oblique, Orthographic, Perspective,
    Planometric, ProjectionError, Projector, SensorSize, ViewOffset, ViewVolume, Window, chapter,
    decompose, oblique_near_plane, opening_angle_of, principal_vanishing_points, third_row,
    vanishing_point,
};
use proptest::prelude::*;

const SPECIAL: [f64; 9] =
    [0.0, -0.0, 1.0, -1.0, f64::MAX, f64::MIN_POSITIVE, 5e-324, f64::INFINITY, f64::NAN];

/// Generates numbers of every kind, with enough common values that builders accept many of them.
fn any_number() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => -10.0..10.0,
        2 => (-320.0..310.0, any::<bool>()).prop_map(|(exponent, negative): (f64, bool)| {
            let size = libm::exp10(exponent);
            if negative { -size } else { size }
        }),
        1 => prop::num::f64::ANY,
        1 => prop::sample::select(SPECIAL.to_vec()),
    ]
}

/// Generates the magnitudes of numbers from `any_number`.
fn any_size() -> impl Strategy<Value = f64> {
    any_number().prop_map(f64::abs)
}

fn finite(name: &str, matrix: DMat4) {
    assert!(matrix.is_finite(), "{name}: {matrix}");
}

proptest! {
    #![proptest_config(samples::cases(512))]

    #[test]
    fn frusta_and_boxes_are_finite(
        e in prop::array::uniform4(any_number()),
        near in any_size(),
        far in any_size(),
    ) {
        let [l, r, b, t] = e;
        for c in conventions() {
            if let Ok(f) = Frustum::new(l, r, b, t, near, far) {
                finite("frustum", f.view_to_clip(c).raw());
                finite("frustum inverse", f.clip_to_view(c).raw());
                let factors = f.factors(c);
                finite("depth factor", factors.depth.raw());
            }
            if let Ok(o) = Orthographic::new(l, r, b, t, near, far) {
                finite("box", o.view_to_clip(c).raw());
                finite("box inverse", o.clip_to_view(c).raw());
            }
            if let Ok(m) = ApexMovedFrustum::new(l, r, b, t, near, far) {
                finite("moved", m.view_to_clip(c).raw());
                finite("moved inverse", m.clip_to_view(c).raw());
            }
        }
        for matrix in [
            chapter::m_orth(l, r, b, t, near, far).map(homog::Affine::raw),
            chapter::m_orth_inverse(l, r, b, t, near, far).map(homog::Affine::raw),
            chapter::m_per(l, r, b, t, -near, -far).map(Projective::raw),
            chapter::m_per_inverse(l, r, b, t, -near, -far).map(Projective::raw),
            chapter::p(l, r).map(Projective::raw),
            chapter::p_inverse(l, r).map(Projective::raw),
            chapter::p_inverse_scaled(l, r).map(Projective::raw),
        ]
        .into_iter()
        .flatten()
        {
            finite("chapter", matrix);
        }
    }

    #[test]
    fn lenses_and_changed_windows_are_finite(
        angle in any_number(),
        aspect in any_size(),
        film in any_size(),
        near in any_size(),
        far in any_size(),
        c in convention(),
    ) {
        let fovs = [
            Fov::Vertical(angle),
            Fov::Horizontal(angle),
            Fov::Diagonal(angle),
            Fov::FocalLength { focal: angle, film: SensorSize::Height(film) },
            Fov::FocalLength { focal: angle, film: SensorSize::Width(film) },
            Fov::FocalLength { focal: angle, film: SensorSize::Diagonal(film) },
        ];
        for lens in fovs.into_iter().filter_map(|fov| Perspective::new(fov, aspect, near, far).ok())
        {
            finite("lens", lens.view_to_clip(c).raw());
            finite("lens inverse", lens.clip_to_view(c).raw());
            finite("its frustum", lens.to_frustum().view_to_clip(c).raw());
            prop_assert!(
                lens.fov_x().is_finite() && lens.fov_y().is_finite() && lens.aspect().is_finite()
            );
            let tile = ViewOffset { full: (film, angle), corner: (near, angle), size: (aspect, film) };
            let moved = [
                lens.view_offset(tile),
                lens.shifted(angle, film),
                lens.jittered(Jitter { image: (film, far), offset: (angle, near) }),
            ];
            for frustum in moved.into_iter().flatten() {
                finite("moved window", frustum.view_to_clip(c).raw());
            }
        }
        let angles = FourAngles { left: angle, right: aspect, down: -film, up: near };
        if let Ok(eye) = angles.frustum(near, far) {
            finite("four angles", eye.view_to_clip(c).raw());
        }
        if let Ok(theta) = opening_angle_of(angle, aspect, film) {
            prop_assert!(theta.is_finite());
        }
        if let Ok((a, b)) = third_row((angle, aspect), (film, near)) {
            prop_assert!(a.is_finite() && b.is_finite());
        }
    }

    #[test]
    fn classical_projections_are_finite(
        a in any_number(),
        b in any_number(),
        d in any_number(),
        z in any_number(),
        w in any_size(),
        c in convention(),
    ) {
        let made: [Result<Classical, _>; 9] = [
            Axonometric::by_angles(a, b).map(Into::into),
            Axonometric::by_normal(Normal::new(a, b, d)).map(Into::into),
            Axonometric::by_foreshortening(a, b, d).map(Into::into),
            Oblique::new(a, b).map(Into::into),
            Oblique::by_angle(a, b).map(Into::into),
            Oblique::by_direction(Vector::new(a, b, d), z).map(Into::into),
            Planometric::new(a, b).map(Into::into),
            NPoint::new(a, b, d).map(Into::into),
            NPoint::by_vanishing_points(Some(a), Some(b), None).map(Into::into),
        ];
        let volume = Orthographic::new(-w, 2.0 * w, -1.0, 1.0, -0.1, 0.1);
        for classical in made.into_iter().flatten() {
            finite("onto plane", classical.onto_plane().raw());
            finite("depth-preserving", classical.depth_preserving().raw());
            finite("inverse", classical.depth_preserving_inverse().raw());
            let _ = (classical.class().name(), decompose(reread(classical.depth_preserving().raw()), c));
            if let Ok(map) = volume.and_then(|volume| classical.view_to_clip(volume, c)) {
                let _ = (
                    decompose(reread(map.raw()), c),
                    principal_vanishing_points(map),
                );
            }
        }
        if let Ok(moved) = Axonometric::isometric().about(Point::new(a, b, d)) {
            finite("about", moved.onto_plane().raw());
            finite("about, inverse", moved.depth_preserving_inverse().raw());
        }
    }

    #[test]
    fn projectors_and_constructed_perspectives_are_finite(
        a in any_number(),
        b in any_number(),
        d in any_number(),
        z in any_number(),
        w in any_size(),
        c in convention(),
    ) {
        let plane = Plane::<View>::from_raw(glam::DVec4::new(a, b, d, z));
        for projector in [
            Projector::from_eye(Point::new(w, a, z), plane),
            Projector::along(Vector::new(z, d, w), plane),
        ]
        .into_iter()
        .flatten()
        {
            finite("projector", projector.onto_plane().raw());
            finite("projector, depth-preserving", projector.depth_preserving().raw());
        }
        let window = Window::centered(1.0, 1.0).expect("valid");
        for drawing in [
            ConstructedPerspective::one_point((a, b), w),
            ConstructedPerspective::two_point((a, b), (d, z), 0.3),
            ConstructedPerspective::three_point((a, b), (d, z), (w, 1.0)),
        ]
        .into_iter()
        .flatten()
        {
            finite("attitude", drawing.world_to_view().raw());
            if let Ok(frustum) = drawing.frustum(window, 1.0, 2.0) {
                finite("its frustum", frustum.view_to_clip(c).raw());
            }
        }
    }

    #[test]
    fn depth_curves_and_inclined_planes_are_finite(
        near in any_size(),
        far in any_size(),
        at in any_number(),
        n in prop::array::uniform4(any_number()),
        c in convention(),
    ) {
        for curve in [DepthCurve::perspective(near, far, c), DepthCurve::parallel(near, far, c)]
            .into_iter()
            .flatten()
        {
            let numbers = [
                curve.depth(at),
                curve.distance(at),
                curve.slope(at),
                Some(curve.half_range_distance()),
                curve.resolution(at, DepthFormat::Float32).ok(),
                curve.resolution(at, DepthFormat::FixedPoint(24)).ok(),
            ];
            for (i, number) in numbers.into_iter().enumerate() {
                prop_assert!(number.is_none_or(f64::is_finite), "result {i} is {number:?}");
            }
        }
        let plane = Plane::from_raw(n.into());
        let Ok(lens) = Perspective::new(Fov::Vertical(1.0), 1.0, near, far) else { return Ok(()) };
        if let Ok(cut) = oblique_near_plane(lens.view_to_clip(c), c, plane) {
            finite("inclined", cut.raw());
        }
        let volume = ViewVolume::new(lens.view_to_clip(c), c);
        let _ = (
            volume.corners(),
            volume.planes(),
            volume.contains(Point::new(n[0], n[1], n[2])),
            volume.eye(),
        );
    }

    #[test]
    fn conventions_accept_only_depths_between_minus_one_and_one(
        near in any_number(),
        far in any_number(),
    ) {
        if let Ok(c) = Convention::OPENGL.with_depths(near, far) {
            prop_assert!(near.abs() <= 1.0 && far.abs() <= 1.0 && near != far);
            finite("conversion", c.clip_to_clip(Convention::OPENGL).raw());
        }
    }

    #[test]
    fn decomposing_any_matrix_does_not_panic(entries in prop::array::uniform16(any_number()), c in convention()) {
        let matrix = DMat4::from_cols_array(&entries);
        let _ = decompose(reread(matrix), c);
    }
}

/// The numbers are finite, but their products are not.
#[test]
fn parameters_whose_products_overflow_are_rejected() {
    let c = Convention::OPENGL;
    assert!(matches!(
        Window::new(-1e308, 1e308, -1.0, 1.0),
        Err(ProjectionError::Unrepresentable { .. })
    ));
    assert!(matches!(
        Frustum::new(-1e150, 1e150, -1e150, 1e150, 1e-159, 1.0),
        Err(ProjectionError::Unrepresentable { .. })
    ));
    let tiny = 4e-309;
    assert!(matches!(
        ApexMovedFrustum::new(0.0, tiny, 0.0, 1.0, tiny * 1e60, 1.0),
        Err(ProjectionError::Unrepresentable { .. })
    ));
    let volume = Orthographic::new(0.0, 1e-200, 0.0, 1.0, 0.0, 1.0).expect("valid");
    let slanted = Classical::from(Oblique::new(1e200, 0.0).expect("valid"));
    assert!(matches!(
        slanted.view_to_clip(volume, c),
        Err(ProjectionError::Unrepresentable { .. })
    ));
    let mut nearly_parallel = DMat4::IDENTITY;
    (nearly_parallel.x_axis.x, nearly_parallel.x_axis.w) = (1e200, 1e-200);
    let map = Projective::<View, Clip>::from_raw(nearly_parallel);
    assert!(matches!(
        vanishing_point(map, Vector::X),
        Err(ProjectionError::Unrepresentable { .. })
    ));
    assert!(matches!(
        principal_vanishing_points(map),
        Err(ProjectionError::Unrepresentable { .. })
    ));
    let deep = DMat4::from_diagonal(glam::DVec4::new(1e-308, 1e-308, 1e-308, 1.0));
    let shallow = DMat4::from_translation(glam::DVec3::new(1e308, 0.0, 0.0)) * deep;
    assert_eq!(ViewVolume::new(Projective::from_raw(shallow), c).corners(), None);
    let shallow = DMat4::from_diagonal(glam::DVec4::new(1.0, 1.0, 1e-308, 1.0));
    assert_eq!(ViewVolume::new(Projective::from_raw(shallow), c).eye(), None);
}

fn reread(matrix: DMat4) -> Projective<View, Clip> {
    Projective::from_raw(matrix)
}
