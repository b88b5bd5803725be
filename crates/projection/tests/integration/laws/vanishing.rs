//! Vanishing points: lines approach them, axes with a finite vanishing point are counted, and
//! pictures are constructed from chosen vanishing points.

use super::samples::{self, convention, direction, frustum, npoint, oblique, point, rotation};
use homog::{Affine, Point, Projective, Vector, View, World};
use projection::{
    ConstructedPerspective, Convention, Fov, Frustum, NPoint, Perspective, PointPerspective,
    ProjectionError, VanishingPoint, Window, principal_vanishing_points, vanishing_point,
};
use proptest::prelude::*;

proptest! {
    #![proptest_config(samples::cases(96))]

    /// C81, VN-1.
    #[test]
    fn lines_approach_their_vanishing_point(
        f in frustum(),
        c in convention(),
        p in point(),
        d in direction(),
    ) {
        let map = f.view_to_clip(c);
        let VanishingPoint::At { point: goal, ahead } =
            vanishing_point(map, d).expect("a direction")
        else {
            return Ok(());
        };
        let way = if ahead { d } else { -d };
        let gap = |s: f64| (map.transform_point(p + way * s).divide().expect("in front") - goal).length();
        let (near, far) = (gap(1e4 / d.z().abs()), gap(1e7 / d.z().abs()));
        prop_assert!(
            far <= near * 1e-2 + 1e-6 * (1.0 + (goal - Point::ORIGIN).length()),
            "{near} then {far}"
        );
    }

    #[test]
    fn opposite_directions_have_the_same_vanishing_point(
        f in frustum(),
        c in convention(),
        d in direction(),
    ) {
        let map = f.view_to_clip(c);
        let (one, other) =
            (vanishing_point(map, d).expect("valid"), vanishing_point(map, -d).expect("valid"));
        prop_assert_eq!(one.point(), other.point());
        prop_assert_eq!(
            vanishing_point(map, d * 1e300).expect("valid").point().is_some(),
            one.point().is_some()
        );
    }

    /// C81.
    #[test]
    fn parallel_projections_have_no_vanishing_point(o in oblique(), d in direction()) {
        let flat = Projective::from(o.onto_plane());
        prop_assert_eq!(vanishing_point(flat, d).expect("valid").point(), None);
        let projector = vanishing_point(flat, o.direction()).expect("valid");
        prop_assert_eq!(projector, VanishingPoint::AlongProjectors);
    }

    /// C83.
    #[test]
    fn each_nonzero_entry_gives_a_principal_vanishing_point(n in npoint()) {
        let found = principal_vanishing_points(n.depth_preserving()).expect("finite");
        prop_assert_eq!(found.count(), n.count());
        let class =
            [PointPerspective::OnePoint, PointPerspective::TwoPoint, PointPerspective::ThreePoint];
        prop_assert_eq!(found.class(), class[n.count() - 1]);
        let [p, q, r] = n.bottom_row();
        let expected = [
            Point::new(1.0 / p, 0.0, 0.0),
            Point::new(0.0, 1.0 / q, 0.0),
            Point::new(0.0, 0.0, 1.0 / r),
        ];
        for (axis, due) in found.axes.iter().zip(expected) {
            if let Some(at) = axis.point() {
                prop_assert!((at - due).length() < 1e-12 * (due - Point::ORIGIN).length());
            }
        }
        let again = NPoint::by_vanishing_points(
            (p != 0.0).then_some(1.0 / p),
            (q != 0.0).then_some(1.0 / q),
            (r != 0.0).then_some(1.0 / r),
        )
        .expect("the same");
        prop_assert!((again.bottom_row()[0] - p).abs() < 1e-15);
    }

    #[test]
    fn rotating_the_object_selects_one_two_or_three_points(
        turn in rotation(),
        yaw in 0.1..1.4,
    ) {
        let lens = Perspective::new(Fov::Vertical(1.0), 1.5, 0.1, 10.0)
            .expect("valid")
            .view_to_clip(Convention::OPENGL);
        let class = |turn: Affine<View, View>| {
            principal_vanishing_points(turn.then_project(lens)).expect("finite").class()
        };
        prop_assert_eq!(class(Affine::IDENTITY), PointPerspective::OnePoint);
        prop_assert_eq!(class(Affine::rotation_y(yaw)), PointPerspective::TwoPoint);
        let skew = [Vector::X, Vector::Y, Vector::Z]
            .iter()
            .all(|axis| turn.transform_vector(*axis).z().abs() > 1e-6);
        prop_assume!(skew);
        prop_assert_eq!(class(turn), PointPerspective::ThreePoint);
    }

    #[test]
    fn constructed_pictures_have_the_chosen_vanishing_points(
        turn in rotation(),
        px in -2.0_f64..2.0,
        py in -2.0_f64..2.0,
        distance in 0.5_f64..4.0,
    ) {
        // Any orientation gives three points, and the construction finds the eye for them.
        let axes = [Vector::<View>::X, Vector::Y, Vector::Z].map(|axis| turn.transform_vector(axis));
        prop_assume!(axes.iter().all(|axis| axis.z().abs() > 0.05));
        let at = |axis: Vector<View>| {
            (px - distance * axis.x() / axis.z(), py - distance * axis.y() / axis.z())
        };
        let drawing = ConstructedPerspective::three_point(at(axes[0]), at(axes[1]), at(axes[2]))
            .expect("an eye exists");
        prop_assert!((drawing.distance() - distance).abs() < 1e-7 * distance);
        let principal = drawing.principal_point();
        prop_assert!(
            (principal.0 - px).abs() < 1e-7 * distance
                && (principal.1 - py).abs() < 1e-7 * distance
        );
        check(drawing, [Some(at(axes[0])), Some(at(axes[1])), Some(at(axes[2]))])?;
    }

    #[test]
    fn two_points_determine_a_horizon(
        x in -5.0..-0.5,
        z in 0.5..5.0,
        y in -1.0..1.0,
        fraction in 0.05..0.95,
    ) {
        let drawing = ConstructedPerspective::two_point((x, y), (z, y), fraction).expect("valid");
        check(drawing, [Some((x, y)), None, Some((z, y))])?;
        let one = ConstructedPerspective::one_point((x, y), 2.0).expect("valid");
        check(one, [None, None, Some((x, y))])?;
    }
}

/// Checks that the axes of the world vanish at these positions in the picture.
fn check(
    drawing: ConstructedPerspective,
    places: [Option<(f64, f64)>; 3],
) -> Result<(), TestCaseError> {
    let frustum = drawing
        .frustum(Window::new(-1.0, 1.0, -1.0, 1.0).expect("valid"), 0.1, 9.0)
        .expect("valid");
    let turn = drawing.world_to_view();
    prop_assert!((turn.determinant() - 1.0).abs() < 1e-9, "a rotation, not a reflection");
    let map: Projective<World, _> = turn.then_project(frustum.view_to_clip(Convention::CHAPTER));
    let found = principal_vanishing_points(map).expect("finite").axes;
    for (axis, place) in found.iter().zip(places) {
        match (axis.point(), place) {
            (Some(at), Some((x, y))) => {
                let size = 1.0 + x.abs() + y.abs();
                prop_assert!(
                    (at.x() - x).abs() < 1e-6 * size && (at.y() - y).abs() < 1e-6 * size,
                    "{at:?}"
                );
            }
            (None, None) => {}
            (found, wanted) => prop_assert!(false, "{found:?} is not {wanted:?}"),
        }
    }
    Ok(())
}

#[test]
fn impossible_vanishing_points_are_rejected() {
    let three = ConstructedPerspective::three_point;
    assert!(
        matches!(
            three((0.0, 0.0), (1.0, 0.0), (2.0, 0.0)),
            Err(ProjectionError::ImpossibleVanishingPoints { .. })
        ),
        "collinear"
    );
    assert!(
        matches!(
            three((0.0, 0.0), (1.0, 0.0), (0.0, 1.0)),
            Err(ProjectionError::ImpossibleVanishingPoints { .. })
        ),
        "a right angle"
    );
    assert!(
        matches!(
            three((-1.0, 0.0), (1.0, 0.0), (0.0, 0.5)),
            Err(ProjectionError::ImpossibleVanishingPoints { .. })
        ),
        "an obtuse angle"
    );
    assert!(matches!(
        three((-1.0, 0.0), (1.0, 0.0), (0.0, f64::NAN)),
        Err(ProjectionError::NotFinite { .. })
    ));
    assert!(three((-1.0, 0.0), (0.0, -2.0), (1.0, 0.0)).is_ok());
    let two = ConstructedPerspective::two_point;
    assert!(matches!(
        two((1.0, 0.0), (1.0, 0.0), 0.5),
        Err(ProjectionError::ImpossibleVanishingPoints { .. })
    ));
    assert!(matches!(two((1.0, 0.0), (2.0, 0.0), 0.0), Err(ProjectionError::OutOfRange { .. })));
    assert!(matches!(
        ConstructedPerspective::one_point((0.0, 0.0), 0.0),
        Err(ProjectionError::OutOfRange { .. })
    ));
    let map = Frustum::new(-1.0, 1.0, -1.0, 1.0, 1.0, 2.0)
        .expect("valid")
        .view_to_clip(Convention::OPENGL);
    assert!(matches!(vanishing_point(map, Vector::ZERO), Err(ProjectionError::ZeroVector { .. })));
    assert!(matches!(
        vanishing_point(map, Vector::new(f64::NAN, 0.0, 1.0)),
        Err(ProjectionError::NotFinite { .. })
    ));
}
