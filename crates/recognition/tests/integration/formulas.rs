//! The matrices of the literature, entry by entry, without the crate's builders.
//!
//! Matrices are listed by rows, for column vectors. Formula ids are from `docs/formulas.md`. N and
//! F are distances; n and f are the textbook's signed coordinates.

pub(crate) type Rows = [[f64; 4]; 4];

pub(crate) fn product(a: Rows, b: Rows) -> Rows {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..4).map(|k| a[i][k] * b[k][j]).sum::<f64>()))
}

pub(crate) fn transposed(m: Rows) -> Rows {
    std::array::from_fn(|i| std::array::from_fn(|j| m[j][i]))
}

pub(crate) fn scaled(m: Rows, factor: f64) -> Rows {
    m.map(|row| row.map(|entry| entry * factor))
}

/// Rounds a matrix as if printed with the given number of decimals.
pub(crate) fn rounded(m: Rows, decimals: usize) -> Rows {
    m.map(|row| row.map(|x| format!("{x:.decimals$}").parse::<f64>().expect("a number") + 0.0))
}

/// Rounds a matrix to f32, as in programs with f32 matrices.
pub(crate) fn single(m: Rows) -> Rows {
    m.map(|row| row.map(|x| f64::from(x as f32)))
}

pub(crate) fn cot_half(fovy_degrees: f64) -> f64 {
    1.0 / libm::tan(fovy_degrees.to_radians() / 2.0)
}

/// GL-1.
pub(crate) fn gl_frustum([l, r, b, t]: [f64; 4], n: f64, f: f64) -> Rows {
    [
        [2.0 * n / (r - l), 0.0, (r + l) / (r - l), 0.0],
        [0.0, 2.0 * n / (t - b), (t + b) / (t - b), 0.0],
        [0.0, 0.0, -(f + n) / (f - n), -2.0 * f * n / (f - n)],
        [0.0, 0.0, -1.0, 0.0],
    ]
}

/// Returns a perspective projection with the rows (0, 0, a, b) for depth and (0, 0, w, 0) for w.
pub(crate) fn lens(fovy_degrees: f64, aspect: f64, [a, b, w]: [f64; 3]) -> Rows {
    let c = cot_half(fovy_degrees);
    [[c / aspect, 0.0, 0.0, 0.0], [0.0, c, 0.0, 0.0], [0.0, 0.0, a, b], [0.0, 0.0, w, 0.0]]
}

/// GL-2: gluPerspective, glm::perspective, cglm, three.js, Unity's projectionMatrix.
pub(crate) fn gl(fovy: f64, aspect: f64, n: f64, f: f64) -> Rows {
    lens(fovy, aspect, [-(f + n) / (f - n), -2.0 * f * n / (f - n), -1.0])
}

/// D3D-2: Metal, WebGPU, glm::perspectiveRH_ZO.
pub(crate) fn rh_zo(fovy: f64, aspect: f64, n: f64, f: f64) -> Rows {
    lens(fovy, aspect, [-f / (f - n), -f * n / (f - n), -1.0])
}

/// D3D-2 with the y row negated: Vulkan.
pub(crate) fn vulkan(fovy: f64, aspect: f64, n: f64, f: f64) -> Rows {
    flip_y(rh_zo(fovy, aspect, n, f))
}

/// D3D-1, for column vectors.
pub(crate) fn lh_zo(fovy: f64, aspect: f64, n: f64, f: f64) -> Rows {
    lens(fovy, aspect, [f / (f - n), -f * n / (f - n), 1.0])
}

/// RV-1.
pub(crate) fn rh_zo_reversed(fovy: f64, aspect: f64, n: f64, f: f64) -> Rows {
    lens(fovy, aspect, [n / (f - n), f * n / (f - n), -1.0])
}

pub(crate) fn flip_y(mut m: Rows) -> Rows {
    m[1] = m[1].map(|x| -x + 0.0);
    m
}

/// Returns a box with the depth row (0, 0, a, c).
fn fit([l, r, b, t]: [f64; 4], [a, c]: [f64; 2]) -> Rows {
    [
        [2.0 / (r - l), 0.0, 0.0, -(r + l) / (r - l)],
        [0.0, 2.0 / (t - b), 0.0, -(t + b) / (t - b)],
        [0.0, 0.0, a, c],
        [0.0, 0.0, 0.0, 1.0],
    ]
}

/// OR-1, signed.
pub(crate) fn m_orth(window: [f64; 4], n: f64, f: f64) -> Rows {
    fit(window, [2.0 / (n - f), -(n + f) / (n - f)])
}

/// GL-3.
pub(crate) fn gl_ortho(window: [f64; 4], n: f64, f: f64) -> Rows {
    fit(window, [-2.0 / (f - n), -(f + n) / (f - n)])
}

/// D3D-6.
pub(crate) fn rh_zo_ortho(window: [f64; 4], n: f64, f: f64) -> Rows {
    fit(window, [-1.0 / (f - n), -n / (f - n)])
}

/// D3D-5.
pub(crate) fn lh_zo_ortho(window: [f64; 4], n: f64, f: f64) -> Rows {
    fit(window, [1.0 / (f - n), -n / (f - n)])
}

/// PE-1.
pub(crate) fn p(n: f64, f: f64) -> Rows {
    [[n, 0.0, 0.0, 0.0], [0.0, n, 0.0, 0.0], [0.0, 0.0, n + f, -f * n], [0.0, 0.0, 1.0, 0.0]]
}

/// nf P⁻¹ as printed.
pub(crate) fn p_inverse_scaled(n: f64, f: f64) -> Rows {
    [[f, 0.0, 0.0, 0.0], [0.0, f, 0.0, 0.0], [0.0, 0.0, 0.0, f * n], [0.0, 0.0, -1.0, n + f]]
}

/// PE-2, signed.
pub(crate) fn m_per([l, r, b, t]: [f64; 4], n: f64, f: f64) -> Rows {
    [
        [2.0 * n / (r - l), 0.0, (l + r) / (l - r), 0.0],
        [0.0, 2.0 * n / (t - b), (b + t) / (b - t), 0.0],
        [0.0, 0.0, (f + n) / (n - f), 2.0 * f * n / (f - n)],
        [0.0, 0.0, 1.0, 0.0],
    ]
}

/// LW-1.
pub(crate) fn lesson_frustum([l, r, b, t]: [f64; 4], n: f64, f: f64) -> Rows {
    [
        [2.0 * n / (r - l), 0.0, 0.0, -n * (r + l) / (r - l)],
        [0.0, 2.0 * n / (t - b), 0.0, -n * (t + b) / (t - b)],
        [0.0, 0.0, -(f + n) / (f - n), -2.0 * f * n / (f - n)],
        [0.0, 0.0, -1.0, 0.0],
    ]
}

/// VP-1; if y points down, the scale of y is negated (VP-2).
pub(crate) fn m_vp(nx: f64, ny: f64, y_down: bool) -> Rows {
    let y = if y_down { -ny / 2.0 } else { ny / 2.0 };
    [
        [nx / 2.0, 0.0, 0.0, (nx - 1.0) / 2.0],
        [0.0, y, 0.0, (ny - 1.0) / 2.0],
        [0.0, 0.0, 1.0, 0.0],
        [0.0, 0.0, 0.0, 1.0],
    ]
}

pub(crate) fn translation([x, y, z]: [f64; 3]) -> Rows {
    [[1.0, 0.0, 0.0, x], [0.0, 1.0, 0.0, y], [0.0, 0.0, 1.0, z], [0.0, 0.0, 0.0, 1.0]]
}

pub(crate) fn scale([x, y, z]: [f64; 3]) -> Rows {
    [[x, 0.0, 0.0, 0.0], [0.0, y, 0.0, 0.0], [0.0, 0.0, z, 0.0], [0.0, 0.0, 0.0, 1.0]]
}

pub(crate) fn rotation_x(degrees: f64) -> Rows {
    let (s, c) = libm::sincos(degrees.to_radians());
    [[1.0, 0.0, 0.0, 0.0], [0.0, c, -s, 0.0], [0.0, s, c, 0.0], [0.0, 0.0, 0.0, 1.0]]
}

pub(crate) fn rotation_y(degrees: f64) -> Rows {
    let (s, c) = libm::sincos(degrees.to_radians());
    [[c, 0.0, s, 0.0], [0.0, 1.0, 0.0, 0.0], [-s, 0.0, c, 0.0], [0.0, 0.0, 0.0, 1.0]]
}

pub(crate) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(crate) fn unit(a: [f64; 3]) -> [f64; 3] {
    let length = libm::sqrt(a.iter().map(|x| x * x).sum::<f64>());
    a.map(|x| x / length)
}

/// CA-1 and CA-2, from eye, gaze and view-up.
pub(crate) fn m_cam(eye: [f64; 3], gaze: [f64; 3], up: [f64; 3]) -> Rows {
    let w = unit(gaze.map(|x| -x));
    let u = unit(cross(up, w));
    let row = |a: [f64; 3]| [a[0], a[1], a[2], -(a[0] * eye[0] + a[1] * eye[1] + a[2] * eye[2])];
    [row(u), row(cross(w, u)), row(w), [0.0, 0.0, 0.0, 1.0]]
}

/// Converts OpenGL's view space to the view space of OpenCV and COLMAP: negates y and z.
pub(crate) fn opencv(view: Rows) -> Rows {
    let mut turned = flip_y(view);
    turned[2] = turned[2].map(|x| -x + 0.0);
    turned
}
