//! Sixty wrong matrices: misprints, matrices for row vectors, wrong signs and common factors.
//!
//! Five of them are also correct matrices of something else, as their comments explain, so both
//! readings must be reported. Misprints that are correct matrices for other parameters have no row
//! here (see `hand_typed.rs`). Only two rows are not recognized. With four decimals, M15 with
//! depths from 0.1 to 100 cannot be distinguished from a correct box from 0.1 to 50, and M17 at 45°
//! gives a scale of 2, which people also choose for lenses.

use super::formulas::*;
use super::table::{Expected, Row, Verdict};
use projection::Convention;
use recognition::Misprint;

const EXACT: f64 = 1e-9;
const WINDOW: [f64; 4] = [-1.0, 3.0, -2.0, 1.0];

pub(crate) fn rows() -> Vec<Row> {
    let mut all = row_vectors();
    all.extend(negated());
    all.extend(multiples());
    all.extend(slips_of_the_textbook_and_notes());
    all.extend(slips_of_the_lesson());
    all.extend(slips_of_the_slides());
    assert_eq!(all.len(), 60);
    all
}

fn slip(name: &'static str, matrix: Rows, misprint: Misprint) -> Row {
    Row { name, matrix, verdict: Verdict::Slip(misprint), tolerance: EXACT }
}

fn both(name: &'static str, matrix: Rows, expected: Expected, misprint: Misprint) -> Row {
    Row { name, matrix, verdict: Verdict::Both(expected, misprint), tolerance: EXACT }
}

/// Returns the rows for (24): matrices of Direct3D's helper library as printed, and column-major
/// matrices read by rows.
fn row_vectors() -> Vec<Row> {
    let wide = 16.0 / 9.0;
    let view = m_cam([4.0, 3.0, 6.0], [-4.0, -3.0, -6.0], [0.0, 1.0, 0.0]);
    let whole = product(gl(50.0, 1.5, 0.1, 100.0), view);
    let model = product(translation([3.0, 1.0, -2.0]), product(rotation_y(30.0), scale([2.0; 3])));
    let oblique = product(gl_ortho(WINDOW, 2.0, 6.0), {
        let mut shear = scale([1.0; 3]);
        (shear[0][2], shear[1][2]) = (0.5, 0.25);
        shear
    });
    let printed = [
        ("row vectors: gluPerspective", gl(60.0, wide, 0.1, 100.0)),
        ("row vectors: gluPerspective, 4 decimals", rounded(gl(60.0, wide, 0.1, 100.0), 4)),
        ("row vectors: gluPerspective, f32", single(gl(60.0, wide, 0.1, 100.0))),
        ("row vectors: glFrustum", gl_frustum(WINDOW, 2.0, 6.0)),
        ("row vectors: glOrtho", gl_ortho(WINDOW, 2.0, 6.0)),
        ("row vectors: centered glOrtho", gl_ortho([-2.0, 2.0, -1.0, 1.0], 0.1, 100.0)),
        ("D3DXMatrixPerspectiveFovLH", lh_zo(45.0, wide, 1.0, 1000.0)),
        ("D3DXMatrixOrthoOffCenterLH", lh_zo_ortho(WINDOW, 2.0, 6.0)),
        ("D3DXMatrixPerspectiveOffCenterLH", {
            let mut m = lh_zo(45.0, wide, 1.0, 1000.0);
            (m[0][2], m[1][2]) = (0.25, -0.5);
            m
        }),
        ("D3DXMatrixLookAtRH", view),
        ("D3DXMatrixLookAtRH, 3 decimals", rounded(view, 3)),
        ("row vectors: Vulkan", vulkan(45.0, wide, 0.1, 256.0)),
        ("three.js elements read by rows", gl(75.0, 1.5, 0.1, 2000.0)),
        ("row vectors: M_vp", m_vp(640.0, 480.0, false)),
        ("row vectors: exercise 1", m_vp(640.0, 480.0, true)),
        ("row vectors: M_per", m_per(WINDOW, -2.0, -6.0)),
        ("row vectors: M_orth", m_orth(WINDOW, -2.0, -6.0)),
        ("row vectors: createFrustum", lesson_frustum(WINDOW, 2.0, 6.0)),
        ("row vectors: infinite", lens(60.0, wide, [-1.0, -0.2, -1.0])),
        ("row vectors: reversed", rh_zo_reversed(50.0, 1.5, 0.2, 300.0)),
        ("row vectors: view-projection", whole),
        ("row vectors: model matrix", model),
        ("row vectors: oblique volume", oblique),
    ];
    let slips = printed
        .into_iter()
        .map(|(name, matrix)| slip(name, transposed(matrix), Misprint::Transposed));
    // This is also −nf P(−1/f, −1/n), which is less likely: it has a factor, and planes behind the
    // eye.
    let twin = slip("row vectors: P", transposed(p(-2.0, -6.0)), Misprint::Transposed);
    slips.chain([twin]).collect()
}

fn with_factor(name: &'static str, right: Rows, factor: f64, expected: Expected) -> Row {
    let verdict = Verdict::Reading(expected, factor);
    Row { name, matrix: scaled(right, factor), verdict, tolerance: EXACT }
}

/// Returns the rows with w < 0 in front of the eye, which are correct as maps but not for clipping
/// (PE-3).
fn negated() -> Vec<Row> {
    let lens = |c, fovy, aspect, n, f| Expected::Lens(c, fovy, aspect, n, f);
    let (gl_c, vk, d3d) = (Convention::OPENGL, Convention::VULKAN, Convention::DIRECT3D);
    let turned = unit([-4.0, -3.0, -6.0]);
    let view = m_cam([4.0, 3.0, 6.0], [-4.0, -3.0, -6.0], [0.0, 1.0, 0.0]);
    let gl_lens = lens(gl_c, 60.0, 1.5, 0.1, 100.0);
    let mut all = vec![
        with_factor("−gluPerspective", gl(60.0, 1.5, 0.1, 100.0), -1.0, gl_lens.clone()),
        with_factor("−glFrustum", gl_frustum(WINDOW, 2.0, 6.0), -1.0, {
            Expected::Frustum(gl_c, WINDOW, 2.0, 6.0)
        }),
        with_factor(
            "−Vulkan",
            vulkan(45.0, 1.5, 0.1, 256.0),
            -1.0,
            lens(vk, 45.0, 1.5, 0.1, 256.0),
        ),
        with_factor("−Direct3D", lh_zo(45.0, 1.5, 1.0, 1000.0), -1.0, {
            lens(d3d, 45.0, 1.5, 1.0, 1000.0)
        }),
        with_factor("−glOrtho", gl_ortho(WINDOW, 2.0, 6.0), -1.0, {
            Expected::Box(gl_c, WINDOW, 2.0, 6.0)
        }),
        with_factor("−M_cam", view, -1.0, Expected::Camera([4.0, 3.0, 6.0], turned)),
    ];
    let mut printed =
        with_factor("−gluPerspective, 4 decimals", gl(60.0, 1.5, 0.1, 100.0), -1.0, gl_lens);
    (printed.matrix, printed.tolerance) = (rounded(printed.matrix, 4), 2e-3);
    all.push(printed);
    all
}

/// Returns the rows for multiples of correct matrices. They are the same maps, but their w is not a
/// distance.
fn multiples() -> Vec<Row> {
    let lens = |c, fovy, aspect, n, f| Expected::Lens(c, fovy, aspect, n, f);
    let chapter = Expected::Frustum(Convention::CHAPTER, WINDOW, 2.0, 6.0);
    vec![
        with_factor("3 gluPerspective", gl(60.0, 1.5, 0.1, 100.0), 3.0, {
            lens(Convention::OPENGL, 60.0, 1.5, 0.1, 100.0)
        }),
        with_factor("½ Vulkan", vulkan(45.0, 1.5, 0.1, 256.0), 0.5, {
            lens(Convention::VULKAN, 45.0, 1.5, 0.1, 256.0)
        }),
        with_factor("−2 (−M_per)", scaled(m_per(WINDOW, -2.0, -6.0), -1.0), -2.0, chapter),
        with_factor("10 glOrtho", gl_ortho(WINDOW, 2.0, 6.0), 10.0, {
            Expected::Box(Convention::OPENGL, WINDOW, 2.0, 6.0)
        }),
        with_factor("7 Direct3D", lh_zo(45.0, 1.5, 1.0, 1000.0), 7.0, {
            lens(Convention::DIRECT3D, 45.0, 1.5, 1.0, 1000.0)
        }),
        with_factor("100 P", p(-2.0, -6.0), 100.0, Expected::P(-2.0, -6.0)),
    ]
}

fn flat_third_row(mut translation: Rows) -> Rows {
    translation[2][2] = 0.0;
    translation
}

/// Returns the rows for M6 and M11.
fn slips_of_the_textbook_and_notes() -> Vec<Row> {
    let turn = product(rotation_x(20.0), rotation_y(-35.0));
    let printed = flat_third_row(translation([-4.0, -3.0, -6.0]));
    vec![
        // A translation by (2, 3, 3) has the same numbers.
        both(
            "M6",
            translation([2.0, 3.0, 3.0]),
            Expected::Translation([2.0, 3.0, 3.0]),
            Misprint::RepeatedTranslation,
        ),
        slip("M11", printed, Misprint::ThirdRowFlat),
        slip(
            "M11, decimals",
            flat_third_row(translation([-0.5, -1.25, -2.0])),
            Misprint::ThirdRowFlat,
        ),
        slip("M11 in M_cam", product(turn, printed), Misprint::ThirdRowFlat),
        slip(
            "M11 in M_cam, 4 decimals",
            rounded(product(turn, printed), 4),
            Misprint::ThirdRowFlat,
        ),
    ]
}

fn bottom_row_one(mut m: Rows) -> Rows {
    m[3][3] = 1.0;
    m
}

/// Returns the rows for M14: Eq4, Eq5, Eq7 and the product.
fn slips_of_the_lesson() -> Vec<Row> {
    let divide = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
    let mut eq4 = bottom_row_one(scale([1.0; 3]));
    eq4[..3].copy_from_slice(&divide);
    eq4[3][2] = -1.0;
    let mut eq5 = eq4;
    (eq5[0][0], eq5[1][1]) = (2.0, 2.0);
    let mut eq7 = eq4;
    let (n, f) = (2.0, 40.0);
    eq7[2] = [0.0, 0.0, -(f + n) / (f - n), 2.0 * f * n / (n - f)];
    let whole = bottom_row_one(gl(60.0, 1.5, 2.0, 40.0));
    vec![
        // The one-point perspective of an eye at distance 1 has the same numbers.
        both("M14, Eq4", eq4, Expected::NPoint([0.0, 0.0, -1.0], false), Misprint::BottomRowOne),
        slip("M14, Eq5", eq5, Misprint::BottomRowOne),
        slip("M14, Eq7", eq7, Misprint::BottomRowOne),
        slip("M14, Eq7, 4 decimals", rounded(eq7, 4), Misprint::BottomRowOne),
        slip("M14 in the product", whole, Misprint::BottomRowOne),
        slip("M14 in the product, 4 decimals", rounded(whole, 4), Misprint::BottomRowOne),
        slip("M14 in createFrustum", bottom_row_one(lesson_frustum(WINDOW, 2.0, 6.0)), {
            Misprint::BottomRowOne
        }),
    ]
}

fn offset_sign(mut m: Rows) -> Rows {
    m[2][3] = -m[2][3];
    m
}

/// Returns a centered perspective projection with the given scale of y.
fn with_scale(scale_y: f64, aspect: f64) -> Rows {
    let mut m = gl(60.0, aspect, 0.1, 100.0);
    (m[0][0], m[1][1]) = (scale_y / aspect, scale_y);
    m
}

/// Returns the rows for M15, M16, M17 and M19.
fn slips_of_the_slides() -> Vec<Row> {
    let half_of_tangent = |degrees: f64| 2.0 / libm::tan(degrees.to_radians());
    let radians = |degrees: f64| 1.0 / libm::tan(degrees / 2.0);
    let offset_one = |window| {
        let mut m = gl_frustum(window, 2.0, 6.0);
        m[0][2] = 1.0;
        m
    };
    vec![
        // The textbook's volume seen along +z has the same numbers.
        both(
            "M15",
            offset_sign(gl_ortho(WINDOW, 2.0, 6.0)),
            Expected::Box(Convention::CHAPTER.left_handed(), WINDOW, 2.0, 6.0),
            Misprint::OrthoOffsetSign,
        ),
        both(
            "M15, 0.1 to 100",
            offset_sign(gl_ortho(WINDOW, 0.1, 100.0)),
            Expected::Box(Convention::CHAPTER.left_handed(), WINDOW, 0.1, 100.0),
            Misprint::OrthoOffsetSign,
        ),
        slip("M15, 4 decimals", rounded(offset_sign(gl_ortho(WINDOW, 0.1, 100.0)), 4), {
            Misprint::OrthoOffsetSign
        }),
        // A frustum with a window from x = 0 to x = 4 has the same numbers.
        both(
            "M16",
            offset_one(WINDOW),
            Expected::Frustum(Convention::OPENGL, [0.0, 4.0, -2.0, 1.0], 2.0, 6.0),
            Misprint::FrustumOffsetOne,
        ),
        slip("M17, 60°", with_scale(half_of_tangent(60.0), 1.5), Misprint::HalfOfTangent),
        slip("M17, 45°", with_scale(half_of_tangent(45.0), 2.0), Misprint::HalfOfTangent),
        slip("M17, 30°", with_scale(half_of_tangent(30.0), 4.0 / 3.0), Misprint::HalfOfTangent),
        slip("M19, 45", with_scale(radians(45.0), 1.5), Misprint::Degrees),
        slip("M19, 60", with_scale(radians(60.0), 1.5), Misprint::Degrees),
        slip("M19, 75", with_scale(radians(75.0), 4.0 / 3.0), Misprint::Degrees),
        slip("M19, 30, f32", single(with_scale(radians(30.0), 2.0)), Misprint::Degrees),
    ]
}
