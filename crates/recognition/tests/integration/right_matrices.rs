//! Sixty correct matrices from the sources and from graphics APIs, engines and libraries.

use super::formulas::*;
use super::table::{Expected, Row, Verdict};
use projection::{Convention, PrincipalPlane};

const EXACT: f64 = 1e-9;
const WINDOW: [f64; 4] = [-1.0, 3.0, -2.0, 1.0];
const INFINITY: f64 = f64::INFINITY;

fn row(name: &'static str, matrix: Rows, expected: Expected) -> Row {
    loose(name, matrix, expected, EXACT)
}

fn loose(name: &'static str, matrix: Rows, expected: Expected, tolerance: f64) -> Row {
    Row { name, matrix, verdict: Verdict::Reading(expected, 1.0), tolerance }
}

fn times(name: &'static str, factor: f64, matrix: Rows, expected: Expected) -> Row {
    Row { name, matrix, verdict: Verdict::Reading(expected, factor), tolerance: EXACT }
}

pub(crate) fn rows() -> Vec<Row> {
    let mut all = chapter();
    all.extend(slides_and_lesson());
    all.extend(point_perspectives());
    all.extend(interfaces());
    all.extend(engines_and_vision());
    all.extend(transforms());
    assert_eq!(all.len(), 60);
    all
}

/// Returns the rows for the textbook and the notes (S0, S1).
fn chapter() -> Vec<Row> {
    let p = Expected::P;
    let volume = |near, far| Expected::Frustum(Convention::CHAPTER, WINDOW, near, far);
    let boxed = |window, near, far| Expected::Box(Convention::CHAPTER, window, near, far);
    let pixels = [0.0, 0.0, 640.0, 480.0];
    let gaze = unit([-4.0, -3.0, -6.0]);
    let camera = m_cam([4.0, 3.0, 6.0], [-4.0, -3.0, -6.0], [0.0, 1.0, 0.0]);
    let turned = Expected::Camera([4.0, 3.0, 6.0], gaze);
    let symmetric = [-4.0, 4.0, -3.0, 3.0];
    vec![
        row("M_vp", m_vp(640.0, 480.0, false), Expected::Viewport(pixels, false, true)),
        row("exercise 1", m_vp(640.0, 480.0, true), Expected::Viewport(pixels, true, true)),
        row("M_orth", m_orth(WINDOW, -2.0, -6.0), boxed(WINDOW, 2.0, 6.0)),
        row("M_orth centered", m_orth(symmetric, -1.0, -11.0), boxed(symmetric, 1.0, 11.0)),
        row("P", self::p(-2.0, -6.0), p(-2.0, -6.0)),
        row("P of the notes, n = −1, f = −3", self::p(-1.0, -3.0), p(-1.0, -3.0)),
        row("P, 4 decimals", rounded(self::p(-0.1, -0.75), 4), p(-0.1, -0.75)),
        row("exercise 8", self::p(1.0, 2.0), p(1.0, 2.0)),
        times("P⁻¹ times nf", 12.0, p_inverse_scaled(-2.0, -6.0), Expected::PInverse(-2.0, -6.0)),
        row(
            "P⁻¹",
            scaled(p_inverse_scaled(-2.0, -6.0), 1.0 / 12.0),
            Expected::PInverse(-2.0, -6.0),
        ),
        times("M_per", -1.0, m_per(WINDOW, -2.0, -6.0), volume(2.0, 6.0)),
        row("−M_per", scaled(m_per(WINDOW, -2.0, -6.0), -1.0), volume(2.0, 6.0)),
        row(
            "exercise 10",
            m_cam([0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [1.0, 1.0, 0.0]),
            Expected::Camera([0.0, 1.0, 0.0], [0.0, -1.0, 0.0]),
        ),
        row("M_cam", camera, turned.clone()),
        loose("M_cam, 4 decimals", rounded(camera, 4), turned.clone(), 1e-3),
        loose("M_cam, 3 decimals", rounded(camera, 3), turned, 1e-2),
        row("M_OpenGL", gl_frustum(WINDOW, 2.0, 6.0), {
            Expected::Frustum(Convention::OPENGL, WINDOW, 2.0, 6.0)
        }),
    ]
}

/// Returns the rows for the slides (S4) and the lesson (S3). Here, the frustum with the moved apex
/// counts as a different projection, not as a misprint.
fn slides_and_lesson() -> Vec<Row> {
    let gl_box = |window, n, f| Expected::Box(Convention::OPENGL, window, n, f);
    let (a, b) = (0.5 * libm::sqrt(2.0), libm::sqrt(3.0) / 4.0);
    let flat = |x: [f64; 4], y: [f64; 4], z: f64| -> Rows {
        [x, y, [0.0, 0.0, 0.0, z], [0.0, 0.0, 0.0, 1.0]]
    };
    let beta = libm::asin(1.0 / libm::sqrt(3.0)).to_degrees();
    let isometric = product(rotation_x(beta), rotation_y(-45.0));
    let mut onto_picture = isometric;
    onto_picture[2] = [0.0; 4];
    vec![
        row("Ortho", gl_ortho(WINDOW, 2.0, 6.0), gl_box(WINDOW, 2.0, 6.0)),
        row("createFrustum", lesson_frustum(WINDOW, 2.0, 6.0), Expected::Moved(WINDOW, 2.0, 6.0)),
        row(
            "createPerspective of the table",
            gl(40.0, 1.5, 2.0, 40.0),
            Expected::Lens(Convention::OPENGL, 40.0, 1.5, 2.0, 40.0),
        ),
        row("T_yoz", scale([0.0, 1.0, 1.0]), Expected::Plane(PrincipalPlane::Yoz)),
        row("T_xoy", scale([1.0, 1.0, 0.0]), Expected::Plane(PrincipalPlane::Xoy)),
        row("isometric", onto_picture, Expected::Isometric),
        row(
            "cavalier, φ = 45°",
            flat([1.0, 0.0, a, 0.0], [0.0, 1.0, a, 0.0], 0.0),
            Expected::Oblique(1.0, 45.0, 0.0, false),
        ),
        row(
            "cabinet, φ = −30°",
            flat([1.0, 0.0, b, 0.0], [0.0, 1.0, -0.25, 0.0], 0.0),
            Expected::Oblique(0.5, -30.0, 0.0, false),
        ),
        loose(
            "cabinet with depth, 4 decimals, φ = 225°",
            rounded(n_shear(-0.5 * a, -0.5 * a), 4),
            Expected::Oblique(0.5, -135.0, 0.0, true),
            1e-3,
        ),
        row(
            "oblique by (1, 2, −4) onto z = 3",
            flat([1.0, 0.0, 0.25, -0.75], [0.0, 1.0, 0.5, -1.5], 3.0),
            Expected::Oblique(libm::sqrt(0.3125), libm::atan(2.0).to_degrees(), 3.0, false),
        ),
    ]
}

/// Returns the rows for the slides' matrices with vanishing points.
fn point_perspectives() -> Vec<Row> {
    let n_point = |third: [f64; 4], last: [f64; 4]| -> Rows {
        [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], third, last]
    };
    let kept = [0.0, 0.0, 1.0, 0.0];
    vec![
        row(
            "one-point, d = 5",
            n_point([0.0; 4], [0.0, 0.0, -0.2, 1.0]),
            Expected::NPoint([0.0, 0.0, -0.2], true),
        ),
        row(
            "two-point (0, q, r, 1)",
            n_point(kept, [0.0, 0.2, 0.1, 1.0]),
            Expected::NPoint([0.0, 0.2, 0.1], false),
        ),
        row(
            "three-point (p, q, r, 1)",
            n_point(kept, [0.1, 0.2, 0.3, 1.0]),
            Expected::NPoint([0.1, 0.2, 0.3], false),
        ),
    ]
}

fn n_shear(x: f64, y: f64) -> Rows {
    [[1.0, 0.0, x, 0.0], [0.0, 1.0, y, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]]
}

/// Returns the rows for OpenGL, Vulkan, Direct3D, Metal and WebGPU, as glm and cglm build them.
fn interfaces() -> Vec<Row> {
    let lens = |c, fovy, aspect, n, f| Expected::Lens(c, fovy, aspect, n, f);
    let wide = 16.0 / 9.0;
    let gl_lens = lens(Convention::OPENGL, 60.0, wide, 0.1, 100.0);
    let (metal, vk, d3d) = (Convention::METAL, Convention::VULKAN, Convention::DIRECT3D);
    let infinite = [-1.0, -0.2, -1.0];
    let reversed_infinite = [0.0, 0.1, -1.0];
    let page = [-8.0, 8.0, -4.5, 4.5];
    vec![
        row("gluPerspective", gl(60.0, wide, 0.1, 100.0), gl_lens.clone()),
        loose(
            "gluPerspective, 4 decimals",
            rounded(gl(60.0, wide, 0.1, 100.0), 4),
            gl_lens.clone(),
            2e-3,
        ),
        loose(
            "gluPerspective, 3 decimals",
            rounded(gl(60.0, wide, 0.1, 100.0), 3),
            gl_lens.clone(),
            2e-2,
        ),
        loose("glm::perspective in f32", single(gl(60.0, wide, 0.1, 100.0)), gl_lens, 1e-4),
        row("infinite gluPerspective", self::lens(60.0, wide, infinite), {
            lens(Convention::OPENGL, 60.0, wide, 0.1, INFINITY)
        }),
        loose(
            "glm::perspectiveRH_ZO, 4 decimals",
            rounded(rh_zo(45.0, 1.25, 0.1, 100.0), 4),
            lens(metal, 45.0, 1.25, 0.1, 100.0),
            2e-3,
        ),
        row("Vulkan", vulkan(45.0, wide, 0.1, 256.0), lens(vk, 45.0, wide, 0.1, 256.0)),
        loose(
            "Vulkan, 4 decimals",
            rounded(vulkan(45.0, wide, 0.1, 10.0), 4),
            lens(vk, 45.0, wide, 0.1, 10.0),
            2e-3,
        ),
        row("Vulkan reversed", flip_y(rh_zo_reversed(70.0, wide, 0.5, 500.0)), {
            lens(vk.reversed(), 70.0, wide, 0.5, 500.0)
        }),
        row("Vulkan box", flip_y(rh_zo_ortho(page, 1.0, 11.0)), Expected::Box(vk, page, 1.0, 11.0)),
        row("D3DXMatrixPerspectiveFovLH, columns", lh_zo(45.0, wide, 1.0, 1000.0), {
            lens(d3d, 45.0, wide, 1.0, 1000.0)
        }),
        row("D3DXMatrixOrthoOffCenterLH, columns", lh_zo_ortho(WINDOW, 2.0, 6.0), {
            Expected::Box(d3d, WINDOW, 2.0, 6.0)
        }),
        row("WebGPU reversed", rh_zo_reversed(50.0, 1.5, 0.2, 300.0), {
            lens(metal.reversed(), 50.0, 1.5, 0.2, 300.0)
        }),
        row("bevy: reversed infinite", self::lens(45.0, 1.5, reversed_infinite), {
            lens(metal.reversed(), 45.0, 1.5, 0.1, INFINITY)
        }),
        row("Unreal: reversed infinite, left-handed", self::lens(90.0, 1.0, [0.0, 10.0, 1.0]), {
            lens(d3d.reversed(), 90.0, 1.0, 10.0, INFINITY)
        }),
    ]
}

/// Returns the rows for three.js, Unity, OpenCV and COLMAP.
fn engines_and_vision() -> Vec<Row> {
    let gl_convention = Convention::OPENGL;
    let page = [-8.0, 8.0, -4.5, 4.5];
    let view = m_cam([2.0, -1.0, 5.0], [-2.0, 1.0, -4.0], [0.0, 1.0, 0.0]);
    let k = |fx: f64, fy, cx, cy| -> Rows {
        [[fx, 0.0, cx, 0.0], [0.0, fy, cy, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]]
    };
    let whole = product(gl(50.0, 1.5, 0.1, 100.0), view);
    let placed = |c, fovy, n, f| Expected::CameraLens([2.0, -1.0, 5.0], c, fovy, n, f);
    vec![
        row("three.js PerspectiveCamera", gl(75.0, 1.5, 0.1, 2000.0), {
            Expected::Lens(gl_convention, 75.0, 1.5, 0.1, 2000.0)
        }),
        row("three.js OrthographicCamera", gl_ortho(page, 0.1, 1000.0), {
            Expected::Box(gl_convention, page, 0.1, 1000.0)
        }),
        row("Unity projectionMatrix", gl(60.0, 1.6, 0.3, 1000.0), {
            Expected::Lens(gl_convention, 60.0, 1.6, 0.3, 1000.0)
        }),
        row("Unity GetGPUProjectionMatrix", flip_y(rh_zo_reversed(60.0, 1.6, 0.3, 1000.0)), {
            Expected::Lens(Convention::VULKAN.reversed(), 60.0, 1.6, 0.3, 1000.0)
        }),
        row("OpenCV K", k(525.0, 525.0, 319.5, 239.5), {
            Expected::Intrinsics([525.0, 525.0, 319.5, 239.5])
        }),
        row("COLMAP pose", opencv(view), {
            Expected::Camera([2.0, -1.0, 5.0], unit([-2.0, 1.0, -4.0]))
        }),
        row("view-projection", whole, placed(gl_convention, 50.0, 0.1, 100.0)),
        loose("view-projection, f32", single(whole), placed(gl_convention, 50.0, 0.1, 100.0), 2e-2),
        row("inverse of gluPerspective", inverse_gl(60.0, 1.5, 0.1, 100.0), {
            Expected::InverseLens(gl_convention, 60.0, 1.5, 0.1, 100.0)
        }),
    ]
}

/// IV-1.
fn inverse_gl(fovy: f64, aspect: f64, n: f64, f: f64) -> Rows {
    let (c, a, b) = (cot_half(fovy), -(f + n) / (f - n), -2.0 * f * n / (f - n));
    [
        [aspect / c, 0.0, 0.0, 0.0],
        [0.0, 1.0 / c, 0.0, 0.0],
        [0.0, 0.0, 0.0, -1.0],
        [0.0, 0.0, 1.0 / b, a / b],
    ]
}

/// Returns the rows for transforms without a camera.
fn transforms() -> Vec<Row> {
    let rotation = [[0.0, -1.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
    let mut turn = scale([1.0; 3]);
    turn[..3].copy_from_slice(&rotation);
    let mut shear = scale([1.0; 3]);
    shear[0][1] = 0.5;
    let model = product(translation([3.0, 0.0, -2.0]), product(rotation_y(30.0), scale([2.0; 3])));
    let to_origin = product(scale([20.0, 30.0, 1.0]), translation([2.0, -5.0, 0.0]));
    let windowing = product(translation([100.0, 50.0, 0.0]), to_origin);
    let h = 0.5 * libm::sqrt(2.0);
    let mirror = [
        [1.0 - 2.0 * h * h, -2.0 * h * h, 0.0, 4.0 * h],
        [-2.0 * h * h, 1.0 - 2.0 * h * h, 0.0, 4.0 * h],
        [0.0, 0.0, 1.0, 0.0],
        [0.0, 0.0, 0.0, 1.0],
    ];
    vec![
        row("scale", scale([2.0, 3.0, 4.0]), Expected::Scale([2.0, 3.0, 4.0])),
        row("rotation", turn, Expected::Rotation([0.0, 0.0, 1.0], 90.0)),
        row("shear", shear, {
            Expected::Shear([[1.0, 0.5, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
        }),
        row("model matrix", model, Expected::Model([3.0, 0.0, -2.0], [2.0; 3])),
        row("window to viewport", windowing, {
            Expected::Windowing([20.0, 30.0, 1.0], [140.0, -100.0, 0.0])
        }),
        row("mirror x + y = 2√2", mirror, Expected::Reflection([h, h, 0.0], 2.0)),
    ]
}
