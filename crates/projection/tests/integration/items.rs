//! Topics and misprints of the sources that the laws do not cover, each checked against its
//! formula.

use glam::{DMat4, DVec4};
use homog::{Affine, Clip, HPoint, Ndc, Point, Projective, Screen, Vector, View, World};
use projection::{
    ApexMovedFrustum, Convention, Fov, Frustum, Oblique, Orthographic, Perspective, Window, chapter,
};

const N: f64 = -1.0;
const F: f64 = -5.0;

fn divided<S: homog::Space>(point: HPoint<S>) -> [f64; 3] {
    point.divide().expect("w is not 0").into()
}

fn close(ours: [f64; 3], due: [f64; 3]) -> bool {
    ours.iter().zip(due).all(|(a, b)| (a - b).abs() < 1e-12 * (1.0 + b.abs()))
}

/// PE-1: (x, y, z) maps to (nx/z, ny/z, n + f − fn/z). Because n and z are both negative, nothing
/// is flipped, and nearer points stay nearer.
#[test]
fn c24_p_neither_flips_nor_reorders() {
    let p = chapter::p(N, F).expect("valid");
    let mut last = f64::INFINITY;
    for z in [-1.0, -1.5, -2.0, -3.5, -5.0] {
        let image = divided(p.transform_point(Point::new(0.6, -0.8, z)));
        assert!(close(image, [N * 0.6 / z, N * -0.8 / z, N + F - F * N / z]), "{image:?}");
        assert!(image[0] > 0.0 && image[1] < 0.0, "left stays left, and up stays up");
        assert!(image[2] < last, "farther points have less depth");
        last = image[2];
    }
}

/// Read with the subscript, f_n would be a third number. Only the product f·n preserves both
/// planes.
#[test]
fn misprint_m5_the_numerator_is_the_product_of_f_and_n() {
    let image = |numerator: f64, z: f64| N + F - numerator / z;
    assert_eq!((image(F * N, N), image(F * N, F)), (N, F));
    for slip in [F, N, F + N, F - N] {
        assert!(image(slip, N) != N || image(slip, F) != F, "{slip}");
    }
    let p = chapter::p(N, F).expect("valid");
    assert_eq!(divided(p.transform_point(Point::new(0.0, 0.0, -2.0)))[2], image(F * N, -2.0));
}

/// P gives (nx, ny, (n + f)z − fn, z), which is equivalent but not equal to (nx/z, …).
#[test]
fn misprint_m11b_before_the_divide_points_are_equivalent_not_equal() {
    let image = chapter::p(N, F).expect("valid").transform_point(Point::new(0.5, 1.5, -2.0));
    assert_eq!(image.raw(), DVec4::new(N * 0.5, N * 1.5, (N + F) * -2.0 - F * N, -2.0));
    let printed = HPoint::<View>::new(N * 0.5 / -2.0, N * 1.5 / -2.0, N + F - F * N / -2.0, 1.0);
    assert_ne!(image, printed);
    assert_eq!(image.equivalent(printed, 1e-12), Some(true));
}

/// The chain is the camera matrix, P, M_orth and the viewport matrix. A single divide at the end
/// gives the same position as dividing as early as possible.
#[test]
fn c28_the_divide_comes_once_at_the_end_of_the_chain() {
    let world_to_view = Affine::<World, View>::translation(Vector::new(-2.0, 1.0, -4.0));
    let p = chapter::p(N, F).expect("valid");
    let m_orth = chapter::m_orth(-1.0, 3.0, -2.0, 1.0, N, F).expect("valid");
    let m_vp = Projective::<Clip, Screen>::from_raw(DMat4::from_cols(
        DVec4::X * 320.0,
        DVec4::Y * 240.0,
        DVec4::Z,
        DVec4::new(319.5, 239.5, 0.0, 1.0),
    ));
    let chain = world_to_view.then_project(p).then(m_orth).then(m_vp);
    let place = Point::<World>::new(2.5, -0.5, 1.0);
    let squeezed = p.transform_point(world_to_view.transform_point(place)).divide().expect("ahead");
    let step_by_step = divided(
        m_vp.transform_hpoint(HPoint::from_raw(m_orth.transform_point(squeezed).raw().extend(1.0))),
    );
    assert!(close(divided(chain.transform_point(place)), step_by_step), "{step_by_step:?}");
}

/// Distances in a plane parallel to the picture are drawn at the same scale at any depth.
#[test]
fn c34_orthographic_pictures_can_be_measured() {
    let map = Orthographic::new(-4.0, 4.0, -3.0, 3.0, 0.0, 20.0)
        .expect("valid")
        .view_to_clip(Convention::CHAPTER);
    for z in [-1.0, -7.0, -19.0] {
        let [a, b] =
            [[0.5, -1.0, z], [2.5, 1.0, z]].map(|p| divided(map.transform_point(p.into())));
        let (across, along) = ((b[0] - a[0]) * 4.0, (b[1] - a[1]) * 3.0);
        assert!((across - 2.0).abs() < 1e-15 && (along - 2.0).abs() < 1e-15, "at {z}");
    }
}

/// θ is measured between the midpoints of the edges. Toward the corners, the angle is larger.
#[test]
fn c49_the_angle_of_view_is_measured_between_edge_midpoints() {
    let theta = 1.1;
    let window = chapter::window_from_fov(theta, 640.0, 480.0, N).expect("valid");
    let angle = |a: Vector<View>, b: Vector<View>| libm::acos(a.dot(b) / (a.length() * b.length()));
    let at = |x, y| Vector::new(x, y, N);
    let middles = angle(at(0.0, window.bottom()), at(0.0, window.top()));
    assert!((middles - theta).abs() < 1e-14, "{middles}");
    let corners = angle(at(window.left(), window.bottom()), at(window.right(), window.top()));
    assert!(corners > theta);
    assert!((window.right() / window.top() - 640.0 / 480.0).abs() < 1e-15);
}

/// Two eyes at ±e look through one window at distance d. For each eye, the window is off-center by
/// e, and a point on the plane of the window has the same image for both eyes.
#[test]
fn c65_two_eyes_share_a_window_and_shift_it_to_opposite_sides() {
    let (e, d, near, far) = (0.03, 2.0, 0.5, 50.0);
    let seen = |eye: f64, p: Point<View>| {
        let window = [(-1.0 - eye) / d, (1.0 - eye) / d].map(|slope| slope * near);
        let eye_frustum = Frustum::new(window[0], window[1], -0.2, 0.2, near, far).expect("valid");
        let moved = p - Vector::new(eye, 0.0, 0.0);
        divided(eye_frustum.view_to_clip(Convention::OPENGL).transform_point(moved))
    };
    let [on_window, nearer, farther] = [-2.0, -1.0, -9.0].map(|z| Point::new(0.4, 0.1, z));
    let parallax = |p| seen(e, p)[0] - seen(-e, p)[0];
    assert!(parallax(on_window).abs() < 1e-15);
    assert!(parallax(nearer) < 0.0, "in front of the window, the images cross");
    assert!(parallax(farther) > 0.0);
    assert!((parallax(farther) - 2.0 * e * (1.0 - d / 9.0)).abs() < 1e-15);
}

/// VV-1: the shear x − (a/c)(z − z0), y − (b/c)(z − z0) makes the projectors parallel to z. Then a
/// box suffices, and the slanted edges of the prism become edges of the cube.
#[test]
fn c86_a_slanted_prism_is_sheared_straight_and_fitted() {
    let (a, b, c) = (0.6, -0.4, -1.5);
    let slant = Oblique::by_direction(Vector::new(a, b, c), 0.0).expect("slanted");
    let volume = Orthographic::new(-1.0, 3.0, -2.0, 1.0, 1.0, 9.0).expect("valid");
    let factors = slant.factors(volume, Convention::OPENGL);
    let p = Point::<View>::new(0.3, 0.7, -4.0);
    let sheared = factors.shear.transform_point(p);
    let due = [p.x() - a / c * p.z(), p.y() - b / c * p.z(), p.z()];
    assert!(close(sheared.into(), due), "{sheared:?}");
    assert_eq!(factors.fit, volume.view_to_clip(Convention::OPENGL));
    for (z, depth) in [(-1.0, -1.0), (-9.0, 1.0)] {
        let corner = Point::new(3.0 + a / c * z, 1.0 + b / c * z, z);
        assert!(close(divided(factors.view_to_clip().transform_point(corner)), [1.0, 1.0, depth]));
    }
}

/// For every projection, the visible part fills the same cube, so a clipper does not depend on the
/// projection.
#[test]
fn c89_parallel_and_perspective_views_fill_the_same_cube() {
    let c = Convention::CHAPTER;
    let volume = Orthographic::new(-1.0, 3.0, -2.0, 1.0, 2.0, 6.0).expect("valid");
    let slant = Oblique::cabinet(0.5).expect("valid");
    let frustum = Frustum::new(-1.0, 3.0, -2.0, 1.0, 2.0, 6.0).expect("valid");
    let straight = (volume.view_to_clip(c), volume.clip_to_view(c));
    let slanted = slant.view_to_clip(volume, c);
    let slanted = (slanted, slanted.inverse().expect("regular"));
    let central = (frustum.view_to_clip(c), frustum.clip_to_view(c));
    for (view_to_clip, clip_to_view) in [straight, slanted, central] {
        for corner in 0..8_u8 {
            let sign = |bit: u8| if corner & bit == 0 { -1.0 } else { 1.0 };
            let ndc = [sign(1), sign(2), sign(4)];
            let seen = clip_to_view.transform_hpoint(HPoint::new(ndc[0], ndc[1], ndc[2], 1.0));
            let seen = seen.divide().expect("a corner");
            assert!(
                seen.z() < 0.0 && close(divided(view_to_clip.transform_point(seen)), ndc),
                "{seen:?}"
            );
            assert!(view_to_clip.transform_point(seen).w() > 0.0);
        }
    }
}

/// The cube [0, 1]³ is the canonical cube scaled by one half and moved along all three axes, not
/// only along z.
#[test]
fn misprint_m7_the_unit_cube_is_moved_along_three_axes() {
    let frustum = Frustum::new(-1.0, 3.0, -2.0, 1.0, 2.0, 6.0).expect("valid");
    let cube = [Point::<Ndc>::new(-1.0, -1.0, -1.0), Point::new(1.0, 1.0, 1.0)];
    let unit = [Point::<Ndc>::ORIGIN, Point::new(1.0, 1.0, 1.0)];
    let to_unit = Affine::windowing(cube, unit).expect("a cube");
    let image = |x, y, z| {
        let ndc =
            frustum.view_to_clip(Convention::OPENGL).transform_point(Point::new(x, y, z)).divide();
        to_unit.transform_point(ndc.expect("ahead")).into()
    };
    assert!(close(image(-1.0, -2.0, -2.0), [0.0; 3]) && close(image(9.0, 3.0, -6.0), [1.0; 3]));
    // A volume that is zero to one only in depth, as in graphics APIs, is different.
    let depth_only =
        frustum.view_to_clip(Convention::WEBGPU).transform_point(Point::new(-1.0, -2.0, -2.0));
    assert!(close(divided(depth_only), [-1.0, -1.0, 0.0]));
}

/// Eq1 of the lesson moves the apex to the origin, by minus mid_x and minus mid_y.
#[test]
fn misprint_m13_both_midpoints_are_subtracted() {
    let lesson = ApexMovedFrustum::new(-1.0, 3.0, -2.0, 1.0, 2.0, 6.0).expect("valid");
    let (mid_x, mid_y) = (1.0, -0.5);
    let steps = lesson.steps(Convention::OPENGL);
    let by = |y: f64| Affine::<View, View>::translation(Vector::new(-mid_x, y, 0.0));
    assert_eq!(steps.move_apex, by(-mid_y));
    let top_edge = |first: Affine<View, View>| {
        let rest = steps.map_depth.then(steps.project).then(steps.scale_window);
        divided(first.then_project(rest).transform_point(Point::new(0.0, 1.0, -2.0)))[1]
    };
    assert!((top_edge(by(-mid_y)) - 1.0).abs() < 1e-15);
    assert!((top_edge(by(mid_y)) - 1.0).abs() > 0.5, "with +mid_y, the top edge is not at the top");
}

/// A window from (−1, 1) to (1, 1) has no height; the lesson's window starts at (−1, −1).
#[test]
fn misprint_m14b_a_window_has_two_different_corners() {
    assert!(Window::new(-1.0, 1.0, 1.0, 1.0).is_err());
    let window = Window::new(-1.0, 1.0, -1.0, 1.0).expect("two by two");
    let frustum = Frustum::from_window(window, 1.0, 5.0).expect("valid");
    let map = frustum.view_to_clip(Convention::OPENGL);
    assert!(close(divided(map.transform_point(Point::new(-1.0, -1.0, -1.0))), [-1.0; 3]));
    assert!(close(divided(map.transform_point(Point::new(1.0, 1.0, -1.0))), [1.0, 1.0, -1.0]));
}

/// Ortho is a translation, by −((−near) + (−far))/2 along z, followed by a scale. If the
/// parenthesis is closed too early, −(−near) + (−far)/2, the box is not centered.
#[test]
fn misprint_m15b_the_box_is_moved_by_the_mean_of_near_and_far() {
    let (near, far) = (2.0, 6.0);
    let product = |z: f64| {
        let to_center = Affine::<View, View>::translation(Vector::new(-1.0, 0.5, z));
        to_center.then(Affine::<View, View>::scale(2.0 / 4.0, 2.0 / 3.0, -2.0 / (far - near))).raw()
    };
    let ours = Orthographic::new(-1.0, 3.0, -2.0, 1.0, near, far)
        .expect("valid")
        .view_to_clip(Convention::OPENGL)
        .raw();
    assert!(ours.abs_diff_eq(product(-((-near) + (-far)) / 2.0), 1e-15));
    assert!(!ours.abs_diff_eq(product(-(-near) + (-far) / 2.0), 0.1));
}

/// GL-2 and D3D-1, entry by entry: the same lens for two graphics APIs, defined by height or by
/// width.
#[test]
fn c60_c92_matrix_entries_of_a_lens_in_two_apis() {
    let (fov, aspect, near, far) = (0.9, 1.6, 0.5, 8.0);
    let lens = Perspective::new(Fov::Vertical(fov), aspect, near, far).expect("valid");
    let cot = 1.0 / libm::tan(fov / 2.0);
    let rows = |c: Convention| lens.view_to_clip(c).raw().transpose().to_cols_array_2d();
    let span = far - near;
    let opengl = [-(far + near) / span, -2.0 * far * near / span, -1.0];
    let direct3d = [far / span, -far * near / span, 1.0];
    for (convention, due) in [(Convention::OPENGL, opengl), (Convention::DIRECT3D, direct3d)] {
        let r = rows(convention);
        assert!(close([r[0][0], r[1][1], r[2][2]], [cot / aspect, cot, due[0]]), "{r:?}");
        assert!(close([r[2][3], r[3][2], r[3][3]], [due[1], due[2], 0.0]), "{r:?}");
    }
    let by_width = 2.0 * libm::atan(aspect * libm::tan(fov / 2.0));
    let by_width = Perspective::new(Fov::Horizontal(by_width), aspect, near, far).expect("valid");
    assert!((by_width.fov_y() - fov).abs() < 1e-15);
}
