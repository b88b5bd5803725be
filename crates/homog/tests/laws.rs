//! Laws of projective maps, tested on random maps: lines and order are preserved, inverses undo the
//! map, common factors do not matter, and planes and normals transform consistently.

use homog::{
    Affine, Clip, Foreshortening, HLine2, HPoint, HPoint2, HPointKind, Homography, Model, Normal,
    Plane, Point, Projective, Vector, View, World, remap_interval,
};
use proptest::prelude::*;

type Map = Projective<View, Clip>;

fn number() -> impl Strategy<Value = f64> {
    -8.0..8.0
}

fn triple() -> impl Strategy<Value = [f64; 3]> {
    [number(), number(), number()]
}

/// Generates maps so well conditioned that rounding errors stay far below the tolerances here.
fn map() -> impl Strategy<Value = Map> {
    prop::array::uniform16(-4.0..4.0_f64)
        .prop_map(Map::from_row_major)
        .prop_filter("well-conditioned", |map| {
            map.inverse_with_report().is_ok_and(|report| report.condition < 1e3)
        })
}

fn affine() -> impl Strategy<Value = Affine<Model, World>> {
    (triple(), 0.2..5.0_f64, 0.2..5.0_f64, 0.2..5.0_f64, triple(), number()).prop_map(
        |(by, x, y, z, axis, angle)| {
            let axis = Vector::<Model>::from(axis) + Vector::X * 100.0;
            Affine::<Model, Model>::scale(x, -y, z)
                .then(Affine::rotation(axis, angle).expect("an axis"))
                .then(Affine::translation(by.into()))
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn inverses_undo_the_map(map in map(), p in triple(), w in 0.5..2.0) {
        let p = HPoint::new(p[0], p[1], p[2], w);
        let back = map.inverse().expect("regular").transform_hpoint(map.transform_hpoint(p));
        prop_assert_eq!(back.equivalent(p, 1e-10), Some(true));
    }

    #[test]
    fn c17_multiples_are_the_same_map(map in map(), p in triple(), exponent in -300..300) {
        let factor = -libm::scalbn(1.0, exponent);
        let multiple = Map::from_raw(map.raw() * factor);
        prop_assert_eq!(map.equivalent(multiple, 1e-15), Some(true));
        let (a, b) = (map.transform_point(p.into()), multiple.transform_point(p.into()));
        prop_assert_eq!(a.equivalent(b, 1e-15), Some(true));
        prop_assert_eq!(a.divide(), b.divide());
        prop_assert_eq!(multiple.rank(), 4);
    }

    #[test]
    fn c31_lines_map_to_lines_parametrized_by_f(
        map in map(), a in triple(), b in triple(), t in 0.0..1.0,
    ) {
        let (a, b) = (Point::from(a), Point::from(b));
        let [start, end, between] = [a, b, a.lerp(b, t)].map(|p| map.transform_point(p));
        if let Ok(f) = Foreshortening::from_endpoints(start, end) {
            let on_the_image = |p: HPoint<Clip>| p.divide();
            let (Some(p), Some(q), Some(seen)) =
                (on_the_image(start), on_the_image(end), on_the_image(between))
            else {
                return Ok(());
            };
            let want = p.lerp(q, f.image_parameter(t).expect("within the segment"));
            let size = 1.0 + (p - q).length() + (p - Point::ORIGIN).length();
            prop_assert!((want - seen).length() < 1e-9 * size, "{seen} is not {want}");
        }
    }

    #[test]
    fn c47_exercise_11_order_is_preserved(w in [1e-3..1e3, 1e-3..1e3], s in 0.0..1.0_f64, t in 0.0..1.0_f64) {
        let f = Foreshortening::new(w[0], w[1]).expect("both positive");
        let image = |t: f64| f.image_parameter(t).expect("within the segment");
        prop_assume!((s - t).abs() > 1e-12);
        prop_assert_eq!(s < t, image(s) < image(t));
        prop_assert!(f.derivative(t).is_some_and(|slope| slope > 0.0));
        prop_assert!((f.source_parameter(image(t)).expect("within") - t).abs() < 1e-9);
        let step = 1e-6;
        let difference = (image(t + step) - image((t - step).max(0.0))) / (t + step - (t - step).max(0.0));
        let slope = f.derivative(t).expect("within");
        prop_assert!((difference / slope - 1.0).abs() < 1e-2, "{difference} is not {slope}");
    }

    #[test]
    fn c32_points_of_a_plane_stay_on_its_image(
        map in map(), p in triple(), n in triple(), along in triple(),
    ) {
        let (p, normal) = (Point::from(p), Normal::from_raw(n.into()));
        let plane = Plane::through(p, normal);
        let image = map.transform_plane(plane).expect("regular");
        let side = Vector::from(n).cross(Vector::from(along));
        for point in [p, p + side, p - side * 3.0] {
            let at = map.transform_point(point);
            let size = image.raw().length() * at.raw().length();
            prop_assert!(image.evaluate(at).abs() <= 1e-9 * size);
        }
    }

    #[test]
    fn normals_stay_perpendicular(map in affine(), n in triple(), along in triple()) {
        let in_surface = Vector::from(n).cross(Vector::from(along));
        let normal = map.transform_normal(Normal::from_raw(n.into()));
        let (normal_size, size) = (normal.raw().length(), map.transform_vector(in_surface).length());
        prop_assert!(normal.dot(map.transform_vector(in_surface)).abs() <= 1e-12 * normal_size * size);
    }

    #[test]
    fn slices_and_single_points_give_identical_bits(
        map in map(), affine in affine(), points in prop::collection::vec(triple(), 0..9),
    ) {
        let mut images = vec![HPoint::new(0.0, 0.0, 0.0, 0.0); points.len()];
        let seen: Vec<Point<View>> = points.iter().map(|&p| p.into()).collect();
        map.transform_points_into(&seen, &mut images);
        prop_assert!(seen.iter().zip(&images).all(|(&p, &image)| map.transform_point(p) == image));
        let mut placed = vec![Point::ORIGIN; points.len()];
        let models: Vec<Point<Model>> = points.iter().map(|&p| p.into()).collect();
        affine.transform_points_into(&models, &mut placed);
        prop_assert!(models.iter().zip(&placed).all(|(&p, &image)| affine.transform_point(p) == image));
    }

    #[test]
    fn c42_lifted_points_agree_under_affine_maps(map in affine(), p in triple(), h in 0.1..10.0_f64) {
        let p = Point::<Model>::from(p);
        let multiple = HPoint::from_raw(HPoint::from(p).raw() * -h);
        let image = Projective::from(map).transform_hpoint(multiple).divide().expect("w is not 0");
        prop_assert!((image - map.transform_point(p)).length() < 1e-12);
    }

    #[test]
    fn remapping_back_restores_the_number(x in number(), a in number(), b in number(), c in number(), d in number()) {
        prop_assume!((a - b).abs() > 0.01 && (c - d).abs() > 0.01);
        let back = remap_interval(remap_interval(x, [a, b], [c, d]).expect("valid"), [c, d], [a, b]).expect("valid");
        prop_assert!((back - x).abs() < 1e-9);
        prop_assert_eq!(remap_interval(a, [a, b], [c, d]), Ok(c));
    }

    #[test]
    fn homographies_are_recovered_from_the_images_of_four_corners(rows in prop::array::uniform9(-2.0..2.0_f64)) {
        let map = Homography::from_row_major(rows);
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|c| map.transform_point(HPoint2::from(c)));
        prop_assume!(corners.iter().all(|c| c.raw().z.abs() > 0.05) && map.determinant().abs() > 0.1);
        let corners = corners.map(|c| c.divide().expect("w is not 0"));
        let found = Homography::from_unit_square(corners).expect("not on a line");
        prop_assert_eq!(found.equivalent(map, 1e-9), Some(true));
    }
}

#[test]
fn c81_parallels_meet_in_the_image_of_their_point_at_infinity() {
    // A perspective projection with w = -z: lines along (1, 2, -4) converge at (1/4, 2/4).
    let rows =
        [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 3.0, -2.0], [0.0, 0.0, -1.0, 0.0]];
    let map = Map::from_rows(rows);
    let direction = Vector::new(1.0, 2.0, -4.0);
    let HPointKind::Finite(meeting) = map.vanishing_point(direction, 0.0) else {
        panic!("the lines recede from the eye");
    };
    assert_eq!(meeting, Point::new(0.25, 0.5, -3.0));
    for start in [Point::new(5.0, -7.0, -1.0), Point::new(-3.0, 0.0, -2.0)] {
        let far =
            map.transform_point(start + direction * 1e9).divide().expect("in front of the eye");
        assert!((far - meeting).length() < 1e-8);
    }
    let names = map.principal_vanishing_points(0.0).map(|meaning| meaning.name());
    assert_eq!(names, ["direction", "direction", "point"], "one-point perspective");
}

#[test]
fn c3_a_chain_is_the_product_of_its_factors() {
    let model_to_world = Affine::<Model, World>::rotation_y(0.5);
    let world_to_view = Affine::<World, View>::translation(Vector::new(0.0, 0.0, -5.0));
    let view_to_clip = Map::from_row_major(core::array::from_fn(|i| (i * i % 7) as f64));
    let chain = model_to_world.then(world_to_view).then_project(view_to_clip);
    assert_eq!(chain.raw(), view_to_clip.raw() * (world_to_view.raw() * model_to_world.raw()));
}

/// The input is finite, but products of its entries exceed the range of f64. The result is `None`,
/// not infinity.
#[test]
fn overflow_gives_none() {
    let stretch = Affine::<World, World>::scale(1e-200, 1.0, 1.0);
    let steep = Plane::from_raw(glam::DVec4::new(1e200, 1.0, 1.0, 1.0));
    assert_eq!(stretch.transform_plane(steep), None);
    assert_eq!(Projective::from(stretch).transform_plane(steep), None);
    let flat = Homography::from_rows([[1e-200, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    assert_eq!(flat.transform_line(HLine2::new(1e200, 1.0, 1.0)), None);
    let uneven = Affine::<World, World>::scale(1e-160, 1e160, 1e160);
    let report = Projective::from(uneven).inverse_with_report().expect("regular");
    assert_eq!(report.condition, f64::MAX);
}

#[test]
fn c20_w_may_be_0_in_between() {
    // The first map sends the plane z = 0 to infinity, and the second brings it back. There is no
    // divide in between.
    let with_bottom = |bottom: [f64; 4]| {
        let [x, y, z, _] = Affine::<World, World>::IDENTITY.rows();
        Projective::<World, World>::from_rows([x, y, z, bottom])
    };
    let away = with_bottom([0.0, 0.0, 1.0, 0.0]);
    let back = with_bottom([0.5, 0.0, 0.0, 0.0]);
    let p = Point::new(4.0, 6.0, 0.0);
    assert_eq!(away.transform_point(p).divide(), None);
    assert_eq!(away.then(back).transform_point(p).divide(), Some(Point::new(2.0, 3.0, 0.0)));
}

#[test]
fn c51_multiples_of_a_lifted_point() {
    let place = Point::<World>::new(1.0, 4.0, 7.0);
    for v in [[2.0, 8.0, 14.0, 2.0], [-0.1, -0.4, -0.7, -0.1], [1.0, 4.0, 7.0, 1.0]] {
        let point = HPoint::<World>::from(v);
        assert!((point.divide().expect("w is not 0") - place).length() < 1e-15);
        assert_eq!(point.equivalent(place.into(), 1e-15), Some(true));
    }
}
