//! Runners for the exercises in the chapter and the misprints in the sources. For a misprint, the
//! result must match the correct form and differ from the printed form.

use crate::vectors::Runner;
use crate::vectors::chain::check_lookat;
use crate::vectors::numbers::{
    TOLERANCE, assert_all_close, assert_close, assert_matrix_close, compare_outcome, count_field,
    number_field, parse_array, parse_matrix, parse_number, parse_numbers, parse_point, text_field,
};
use crate::vectors::windows::{assert_matrix3_close, check_viewport_after_box, parse_window_map};
use camera::Camera;
use glam::DMat4;
use homog::{
    Affine, Foreshortening, HPoint, PixelConvention, Point, Projective, Vector, View, World,
};
use projection::{ApexMovedFrustum, Convention, Frustum, ProjectionError, api, chapter};
use serde_json::{Value, json};
use viewport::Viewport;

/// The runners, one per file.
pub const RUNNERS: &[(&str, Runner)] =
    &[("exercises", check_exercise), ("misprints", check_misprint)];

fn check_exercise(case: &Value, out: &Value) -> Result<(), String> {
    match count_field(case, "exercise")? {
        1 => {
            let image = Viewport::chapter(count_field(case, "nx")?, count_field(case, "ny")?);
            compare_outcome(image, out, |image| {
                let down = image.with_convention(PixelConvention::CHAPTER_Y_DOWN).ndc_to_screen();
                compare_matrix(down.raw(), out, "matrix")
            })
        }
        2 => check_viewport_after_box(case, out),
        3 => compare_outcome(perspective_matrix(case)?, out, |p| {
            let row = p.raw().row(2).to_array();
            assert_all_close("row", &row, &parse_numbers::<4>(&out["row"])?, TOLERANCE)
        }),
        4 => compare_outcome(perspective_matrix(case)?, out, |p| check_depth_order(p, case, out)),
        5 => check_heights(case, out),
        6 => check_perspective_inverse(case, out),
        7 => corners_of_m_per(case, out),
        8 => compare_outcome(chapter::p(1.0, 2.0), out, |p| compare_matrix(p.raw(), out, "matrix")),
        9 => compare_outcome(chapter::p(1.0, 2.0), out, |p| {
            let image = p.transform_point(parse_point(&case["p"])?.into());
            let ours = <[f64; 4]>::from(image);
            assert_all_close(
                "unhomogenised",
                &ours,
                &parse_numbers::<4>(&out["unhomogenised"])?,
                TOLERANCE,
            )?;
            let [x, y, z, w] = parse_numbers(&out["homogenised"])?;
            assert_close("w", 1.0, w, TOLERANCE)?;
            assert_all_close("homogenised", &divide_point(image)?, &[x, y, z], TOLERANCE)
        }),
        10 => check_lookat(&json!({"e": [0, 1, 0], "g": [0, -1, 0], "t": [1, 1, 0]}), out),
        11 => check_segment_order(case, out),
        other => Err(format!("unknown exercise {other}")),
    }
}

fn compare_matrix(ours: DMat4, out: &Value, name: &str) -> Result<(), String> {
    assert_matrix_close(name, ours, parse_matrix(&out[name])?, TOLERANCE)
}

fn divide_point(point: HPoint<View>) -> Result<[f64; 3], String> {
    point.divide().map(Into::into).ok_or_else(|| format!("{point:?} cannot be divided by w"))
}

type PerspectiveResult = Result<Projective<View, View>, ProjectionError>;

fn perspective_matrix(case: &Value) -> Result<PerspectiveResult, String> {
    Ok(chapter::p(number_field(case, "n")?, number_field(case, "f")?))
}

fn check_depth_order(p: Projective<View, View>, case: &Value, out: &Value) -> Result<(), String> {
    let depth = |z: &Value| {
        divide_point(p.transform_point(Point::new(0.0, 0.0, parse_number(z)?)))
            .map(|image| image[2])
    };
    let ours: Vec<f64> = parse_array(&case["z"])?.iter().map(depth).collect::<Result<_, _>>()?;
    let theirs: Vec<f64> =
        parse_array(&out["z"])?.iter().map(parse_number).collect::<Result<_, _>>()?;
    assert_all_close("z", &ours, &theirs, TOLERANCE)?;
    let decreasing = ours.windows(2).all(|pair| pair[0] > pair[1]);
    if decreasing == (out["strictly_decreasing"] == true) {
        Ok(())
    } else {
        Err(format!("strictly decreasing: {decreasing}"))
    }
}

/// Checks that an affine map gives the same point for (x, y, z, 1) and (hx, hy, hz, h).
fn check_heights(case: &Value, out: &Value) -> Result<(), String> {
    let map =
        Affine::<World, World>::from_raw(parse_matrix(&case["matrix"])?).ok_or("is not affine")?;
    let (p, h) = (Point::from(parse_point(&case["p"])?), number_field(case, "h")?);
    let theirs = parse_point(&out["point"])?;
    assert_all_close("point", &<[f64; 3]>::from(map.transform_point(p)), &theirs, TOLERANCE)?;
    let lifted = HPoint::from_raw(p.raw().extend(1.0) * h);
    let image = Projective::from(map).transform_hpoint(lifted);
    assert_close("h", image.w(), h, TOLERANCE)?;
    let place = image.divide().ok_or("h is 0")?;
    assert_all_close("point from h", &<[f64; 3]>::from(place), &theirs, TOLERANCE)
}

fn check_perspective_inverse(case: &Value, out: &Value) -> Result<(), String> {
    let (n, f) = (number_field(case, "n")?, number_field(case, "f")?);
    compare_outcome(chapter::p_inverse_scaled(n, f), out, |scaled| {
        compare_matrix(scaled.raw(), out, "inverse_scaled_by_nf")?;
        let p = chapter::p(n, f).map_err(|error| error.to_string())?;
        compare_matrix(p.then(scaled).raw(), out, "product")
    })
}

fn corners_of_m_per(case: &Value, out: &Value) -> Result<(), String> {
    let [l, r, b, t, n, f] = parse_frustum_edges(case)?;
    compare_outcome(chapter::m_per(l, r, b, t, n, f), out, |m| {
        let image = |x, y, z| {
            let image =
                m.transform_point(Point::new(x, y, z)).divide().ok_or("cannot be divided by w")?;
            Ok::<_, String>(<[f64; 3]>::from(image))
        };
        for (name, ours) in
            [("image_of_r_t_n", image(r, t, n)?), ("image_of_l_b_n", image(l, b, n)?)]
        {
            assert_all_close(name, &ours, &parse_point(&out[name])?, TOLERANCE)?;
        }
        assert_close("z_of_far", image(0.0, 0.0, f)?[2], number_field(out, "z_of_far")?, TOLERANCE)
    })
}

fn check_segment_order(case: &Value, out: &Value) -> Result<(), String> {
    let f = Foreshortening::new(number_field(case, "w_r")?, number_field(case, "w_R")?);
    compare_outcome(f, out, |f| {
        for (name, t) in [("f0", 0.0), ("f1", 1.0), ("f_half", 0.5)] {
            assert_close(
                name,
                f.image_parameter(t).ok_or("has no image")?,
                number_field(out, name)?,
                TOLERANCE,
            )?;
        }
        for (name, t) in [("derivative_at_0", 0.0), ("derivative_at_1", 1.0)] {
            assert_close(
                name,
                f.derivative(t).ok_or("has no derivative")?,
                number_field(out, name)?,
                TOLERANCE,
            )?;
        }
        Ok(())
    })
}

/// Parses `[l, r, b, t, n, f]` from a case.
fn parse_frustum_edges(case: &Value) -> Result<[f64; 6], String> {
    let mut edges = [0.0; 6];
    for (edge, name) in edges.iter_mut().zip(["l", "r", "b", "t", "n", "f"]) {
        *edge = number_field(case, name)?;
    }
    Ok(edges)
}

/// Checks that our matrix matches the correct form and not the printed form.
fn check_correct_and_printed(
    ours: DMat4,
    out: &Value,
    correct: &str,
    printed: &str,
) -> Result<(), String> {
    compare_matrix(ours, out, correct)?;
    match assert_matrix_close(printed, ours, parse_matrix(&out[printed])?, TOLERANCE) {
        Ok(()) => Err(format!("matches the printed form {printed}")),
        Err(_) => Ok(()),
    }
}

fn check_misprint(case: &Value, out: &Value) -> Result<(), String> {
    let refused = |error: ProjectionError| error.to_string();
    match text_field(case, "id")? {
        "004-frustum-col3" => {
            let [l, r, b, t, n, f] = parse_frustum_edges(case)?;
            let ours = api::frustum_gl(l, r, b, t, n, f).map_err(refused)?;
            check_correct_and_printed(ours.raw(), out, "correct", "printed")
        }
        "004-ortho-z-translation" => {
            let [l, r, b, t, n, f] = parse_frustum_edges(case)?;
            let ours = api::ortho_gl(l, r, b, t, n, f).map_err(refused)?;
            check_correct_and_printed(ours.raw(), out, "correct", "printed")
        }
        "003-eq4-5-7-w" => {
            let (n, f) = (number_field(case, "n")?, number_field(case, "f")?);
            // With the window [−n, n]², the x and y rows of the frustum matrix equal the
            // identity's.
            let ours = api::frustum_gl(-n, n, -n, n, n, f).map_err(refused)?;
            check_correct_and_printed(ours.raw(), out, "correct", "printed")
        }
        "003-eq9-vs-glFrustum" => check_moved_apex(case, out),
        "001-mcam-third-row" => {
            let eye = Point::from(parse_point(&case["e"])?);
            let camera = Camera::look_to(eye, -Vector::Z, Vector::Y).map_err(|e| e.to_string())?;
            check_correct_and_printed(camera.world_to_view().raw(), out, "correct", "printed")
        }
        "004-window-viewport-sign" => {
            let map = parse_window_map(case)?.map_err(|error| error.to_string())?;
            assert_matrix3_close("correct", map.homography().raw(), &out["correct"])?;
            let printed = assert_matrix3_close("printed", map.homography().raw(), &out["printed"]);
            printed.err().map(|_| ()).ok_or_else(|| "is the printed form".to_owned())
        }
        "000-translation-ty-twice" => {
            let by = Vector::<World>::from(parse_point(&case["t"])?);
            let ours = Affine::<World, World>::translation(by);
            check_correct_and_printed(ours.raw(), out, "correct", "printed")
        }
        "000-algorithm-without-P" => {
            let [l, r, b, t, n, f] = parse_frustum_edges(case)?;
            let ours = chapter::m_per(l, r, b, t, n, f).map_err(refused)?;
            check_correct_and_printed(ours.raw(), out, "correct", "printed")?;
            // The printed matrix is the matrix of the box, in which w stays 1 and nothing is
            // foreshortened.
            let orth = chapter::m_orth(l, r, b, t, n, f).map_err(refused)?;
            compare_matrix(orth.raw(), out, "printed")
        }
        "004-perspective-tan" => check_angle(case, out),
        "000-gl-vs-per" => {
            let [l, r, b, t, n, f] = parse_frustum_edges(case)?;
            let frustum = Frustum::new(l, r, b, t, n, f).map_err(refused)?;
            compare_matrix(frustum.view_to_clip(Convention::OPENGL).raw(), out, "M_OpenGL")?;
            let chapter = frustum.view_to_clip(Convention::CHAPTER);
            let flipped = Convention::CHAPTER.convert(Convention::OPENGL, chapter);
            compare_matrix(flipped.raw(), out, "minus_flip_M_per")
        }
        other => Err(format!("unknown misprint {other}")),
    }
}

fn check_moved_apex(case: &Value, out: &Value) -> Result<(), String> {
    let [l, r, b, t, n, f] = parse_frustum_edges(case)?;
    let lesson = ApexMovedFrustum::new(l, r, b, t, n, f).map_err(|error| error.to_string())?;
    check_correct_and_printed(
        lesson.view_to_clip(Convention::OPENGL).raw(),
        out,
        "eq9",
        "glFrustum",
    )?;
    let frustum = api::frustum_gl(l, r, b, t, n, f).map_err(|error| error.to_string())?;
    check_correct_and_printed(frustum.raw(), out, "glFrustum", "eq9")
}

fn check_angle(case: &Value, out: &Value) -> Result<(), String> {
    let matrix =
        api::perspective_gl(number_field(case, "fovy")?, number_field(case, "aspect")?, 1.0, 2.0);
    let raw = matrix.map_err(|error| error.to_string())?.raw();
    let ours = [raw.x_axis.x, raw.y_axis.y];
    assert_all_close("diagonal", &ours, &parse_numbers::<2>(&out["correct_diag"])?, TOLERANCE)?;
    let printed =
        assert_all_close("diagonal", &ours, &parse_numbers::<2>(&out["printed_diag"])?, TOLERANCE);
    printed.err().map(|_| ()).ok_or_else(|| "is the printed form".to_owned())
}
