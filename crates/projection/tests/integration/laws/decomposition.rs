//! Tests that decompose(build(p)) = p for every builder and convention.

use super::samples::{
    self, axonometric, convention, distance, frustum, npoint, oblique, orthographic, perspective,
    point, rotation,
};
use glam::{DMat4, DVec4};
use homog::{Affine, Clip, HPoint, Normal, Plane, Point, Projective, Vector, View};
use projection::{
    ApexMovedFrustum, Classical, Convention, DecomposeError, Decomposed, Frustum, Orthographic,
    Perspective, decompose, oblique_near_plane, readings,
};
use proptest::prelude::*;

fn same_frustum(found: Frustum, made: Frustum) {
    let c = Convention::WEBGPU.reversed();
    let apart = distance(found.view_to_clip(c).raw(), made.view_to_clip(c).raw());
    assert!(apart < 1e-9, "{found:?} is not {made:?}");
    let (near, far) =
        (found.near() / made.near(), made.near() / found.far() - made.near() / made.far());
    assert!((near - 1.0).abs() < 1e-9 && far.abs() < 1e-9, "{found:?} is not {made:?}");
}

fn same_box(found: Orthographic, made: Orthographic) {
    let c = Convention::CHAPTER;
    let apart = distance(found.clip_to_view(c).raw(), made.clip_to_view(c).raw());
    assert!(apart < 1e-9, "{found:?} is not {made:?}");
}

fn kind(matrix: DMat4, c: Convention) -> Decomposed {
    decompose(reread(matrix), c).expect("a projection").kind
}

/// Returns the projection matrix with a placement in right-handed view space applied before it, for
/// either handedness of the projection.
fn placed(placement: Affine<View, View>, c: Convention, matrix: DMat4) -> DMat4 {
    let turn = DMat4::from_diagonal(DVec4::new(1.0, 1.0, -c.ahead(), 1.0));
    matrix * turn * placement.raw() * turn
}

proptest! {
    #![proptest_config(samples::cases(96))]

    #[test]
    fn frusta_are_recovered_for_any_common_factor(
        f in frustum(),
        c in convention(),
        factor in -3.0..3.0,
    ) {
        prop_assume!(f64::abs(factor) > 0.01);
        let found = decompose(reread(f.view_to_clip(c).raw() * factor), c).expect("a frustum");
        prop_assert!((found.factor / factor - 1.0).abs() < 1e-12);
        let Decomposed::Frustum(back) = found.kind else { panic!("{:?}", found.kind) };
        same_frustum(back, f);
    }

    #[test]
    fn perspectives_are_recovered_with_their_angles(p in perspective(), c in convention()) {
        let Decomposed::Frustum(back) = kind(p.view_to_clip(c).raw(), c) else {
            panic!("a frustum")
        };
        let back = Perspective::try_from(back).expect("centered");
        prop_assert!(
            (back.fov_y() - p.fov_y()).abs() < 1e-12
                && (back.aspect() / p.aspect() - 1.0).abs() < 1e-12
        );
    }

    #[test]
    fn boxes_are_recovered(o in orthographic(), c in convention()) {
        let Decomposed::Orthographic(back) = kind(o.view_to_clip(c).raw(), c) else {
            panic!("a box")
        };
        same_box(back, o);
    }

    #[test]
    fn apex_moved_frusta_are_recovered_as_such(f in frustum(), c in convention()) {
        let (w, far) = (f.window(), f.far().min(1e4 * f.near()));
        prop_assume!(f64::abs(w.center().0) > 1e-6 * f.near());
        let made = ApexMovedFrustum::new(w.left(), w.right(), w.bottom(), w.top(), f.near(), far)
            .expect("valid");
        let Decomposed::ApexMoved(back) = kind(made.view_to_clip(c).raw(), c) else {
            panic!("moved")
        };
        same_frustum(back.about_apex(), made.about_apex());
        prop_assert!(
            (back.apex() - made.apex()).length()
                < 1e-9 * (1.0 + (made.apex() - Point::ORIGIN).length())
        );
    }

    #[test]
    fn camera_and_lens_are_separated(
        f in frustum(),
        c in convention(),
        turn in rotation(),
        eye in point(),
    ) {
        let camera = Affine::translation(Point::ORIGIN - eye).then(turn);
        let whole = placed(camera, c, f.view_to_clip(c).raw());
        match kind(whole, c) {
            Decomposed::PlacedFrustum { placement, frustum } => {
                let again = placed(placement, c, frustum.view_to_clip(c).raw());
                prop_assert!(distance(again, whole) < 1e-9);
            }
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn oblique_prisms_are_recovered(o in oblique(), volume in orthographic(), c in convention()) {
        let Decomposed::Classical { projection: Classical::Oblique(back), volume: box_back } =
            kind(o.view_to_clip(volume, c).raw(), c)
        else {
            panic!("oblique")
        };
        prop_assert!((back.direction() - o.direction()).length() < 1e-9);
        let again = back.view_to_clip(box_back, c).raw();
        prop_assert!(distance(again, o.view_to_clip(volume, c).raw()) < 1e-9);
    }

    #[test]
    fn axonometric_projections_are_recovered(
        a in axonometric(),
        volume in orthographic(),
        c in convention(),
    ) {
        let made = Classical::from(a).view_to_clip(volume, c).expect("parallel").raw();
        match kind(made, c) {
            Decomposed::Classical { projection, volume } => {
                let again = projection.view_to_clip(volume, c).expect("parallel").raw();
                prop_assert!(distance(again, made) < 1e-9);
            }
            // A mirrored window corresponds to a different rotation.
            Decomposed::PlacedOrthographic { placement, volume } => {
                let again = placed(placement, c, volume.view_to_clip(c).raw());
                prop_assert!(distance(again, made) < 1e-9);
            }
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn classical_matrices_without_volume_are_recovered(
        n in npoint(),
        o in oblique(),
        a in axonometric(),
        c in convention(),
    ) {
        prop_assert_eq!(kind(n.depth_preserving().raw(), c), Decomposed::NPoint(n));
        let Decomposed::Flat { center, projection } = kind(n.onto_plane().raw(), c) else {
            panic!("flat")
        };
        prop_assert_eq!(projection, Some(n.into()));
        prop_assert!(n.onto_plane().transform_hpoint(center).raw().length() < 1e-9 * center.raw().length());
        let Decomposed::Flat { center, projection: Some(Classical::Oblique(back)) } =
            kind(o.onto_plane().raw(), c)
        else {
            panic!("flat")
        };
        prop_assert!((back.direction() - o.direction()).length() < 1e-9);
        prop_assert_eq!(center.w(), 0.0);
        let Decomposed::Flat { projection: Some(Classical::Axonometric(back)), .. } =
            kind(a.onto_plane().raw(), c)
        else {
            panic!("flat")
        };
        prop_assert!(distance(back.onto_plane().raw(), a.onto_plane().raw()) < 1e-9);
    }

    #[test]
    fn inclined_near_planes_are_recovered(
        p in perspective(),
        c in convention(),
        x in -0.5..0.5,
        y in -0.5..0.5,
    ) {
        let far_side = (2.0 * p.near()).min(0.5 * p.near() + 0.5 * p.far());
        let normal = Normal::new(0.3 * x + 0.01, 0.3 * y, c.ahead());
        let mirror = Plane::through(Point::new(0.0, 0.0, c.ahead() * far_side), normal);
        let Ok(cut) = oblique_near_plane(p.view_to_clip(c), c, mirror) else { return Ok(()) };
        let Decomposed::ObliqueNear { near_plane, slopes, .. } = kind(cut.raw(), c) else {
            panic!("inclined")
        };
        // The plane is in right-handed camera coordinates.
        let turned = mirror.raw() * DVec4::new(1.0, 1.0, -c.ahead(), 1.0) / normal.raw().length();
        prop_assert!((near_plane.raw() - turned).length() < 1e-9 * (1.0 + turned.length()));
        prop_assert!((slopes.right() / p.half_slopes().x - 1.0).abs() < 1e-9);
    }

    #[test]
    fn arbitrary_matrices_are_decomposed_or_rejected_without_panic(
        entries in prop::array::uniform16(-2.0_f64..2.0),
        hole in 0..16_usize,
    ) {
        let mut zeroed = entries.map(|entry| if entry.abs() < 0.7 { 0.0 } else { entry });
        for matrix in [DMat4::from_cols_array(&entries), DMat4::from_cols_array(&zeroed)] {
            let _ = readings(reread(matrix)).count();
        }
        zeroed[hole] = f64::NAN;
        let refused = decompose(reread(DMat4::from_cols_array(&zeroed)), Convention::OPENGL);
        let (row, column) = (hole % 4, hole / 4);
        prop_assert_eq!(refused, Err(DecomposeError::NotFinite { row, column }));
    }
}

#[test]
fn an_opengl_matrix_is_also_a_zero_to_one_matrix_with_a_farther_near_plane() {
    let made = Frustum::new(-1.0, 1.0, -1.0, 1.0, 2.0, 40.0).expect("valid");
    let matrix = made.view_to_clip(Convention::OPENGL).raw();
    let near_in = |wanted: Convention| {
        let found =
            readings(reread(matrix)).find(|(c, _)| *c == wanted).map(|(_, found)| found.kind);
        let Some(Decomposed::Frustum(found)) = found else { panic!("{found:?}") };
        found.near()
    };
    assert!((near_in(Convention::OPENGL) - 2.0).abs() < 1e-12);
    assert!((near_in(Convention::WEBGPU) - 80.0 / 21.0).abs() < 1e-12);
}

#[test]
fn lost_dimensions_are_reported() {
    let rank = |matrix: DMat4| match decompose(reread(matrix), Convention::OPENGL) {
        Err(DecomposeError::RankTooLow { rank }) => rank,
        other => panic!("{other:?}"),
    };
    assert_eq!(rank(DMat4::ZERO), 0);
    assert_eq!(rank(DMat4::from_diagonal(DVec4::X)), 1);
    assert_eq!(rank(DMat4::from_diagonal(DVec4::new(3.0, 0.0, 0.0, 1e-9))), 2);
    let flat =
        decompose(reread(DMat4::from_diagonal(DVec4::new(0.0, 1.0, 1.0, 1.0))), Convention::OPENGL);
    let Ok(projection::Decomposition { kind: Decomposed::Flat { center, .. }, .. }) = flat else {
        panic!("{flat:?}")
    };
    assert_eq!(center, HPoint::from(Vector::X));
}

fn reread(matrix: DMat4) -> Projective<View, Clip> {
    Projective::from_raw(matrix)
}
