//! The exercises of the chapter, and the misprints of the sources: the right form must come out, the printed one must
//! not.

use crate::Runner;
use crate::chain::lookat;
use crate::numbers::{
    TOLERANCE, close, close_all, close_matrix, count, field, judge, list, matrix, number, numbers,
    point, text,
};
use crate::windows::{close_matrix3, viewport_after_box, window_map};
use camera::Camera;
use glam::DMat4;
use homog::{Affine, Foreshortening, HPoint, Point, Projective, Vector, View, World};
use projection::{ApexMovedFrustum, Convention, Frustum, ProjectionError, api, chapter};
use serde_json::{Value, json};
use viewport::{PixelConvention, Viewport};

/// One per file.
pub const RUNNERS: &[(&str, Runner)] = &[("exercises", exercise), ("misprints", misprint)];

fn exercise(case: &Value, out: &Value) -> Result<(), String> {
    match count(case, "exercise")? {
        1 => {
            let image = Viewport::chapter(count(case, "nx")?, count(case, "ny")?);
            judge(image, out, |image| {
                let down = image.with_convention(PixelConvention::CHAPTER_Y_DOWN).ndc_to_screen();
                same(down.raw(), out, "matrix")
            })
        }
        2 => viewport_after_box(case, out),
        3 => judge(p(case)?, out, |p| {
            let row = p.raw().row(2).to_array();
            close_all("row", &row, &numbers::<4>(&out["row"])?, TOLERANCE)
        }),
        4 => judge(p(case)?, out, |p| order_of_depths(p, case, out)),
        5 => heights(case, out),
        6 => inverse_of_p(case, out),
        7 => corners_of_m_per(case, out),
        8 => judge(chapter::p(1.0, 2.0), out, |p| same(p.raw(), out, "matrix")),
        9 => judge(chapter::p(1.0, 2.0), out, |p| {
            let image = p.point(point(&case["p"])?.into());
            let ours = <[f64; 4]>::from(image);
            close_all("unhomogenised", &ours, &numbers::<4>(&out["unhomogenised"])?, TOLERANCE)?;
            let [x, y, z, w] = numbers(&out["homogenised"])?;
            close("w", 1.0, w, TOLERANCE)?;
            close_all("homogenised", &divided(image)?, &[x, y, z], TOLERANCE)
        }),
        10 => lookat(&json!({"e": [0, 1, 0], "g": [0, -1, 0], "t": [1, 1, 0]}), out),
        11 => order_on_segments(case, out),
        other => Err(format!("unknown exercise {other}")),
    }
}

fn same(ours: DMat4, out: &Value, name: &str) -> Result<(), String> {
    close_matrix(name, ours, matrix(&out[name])?, TOLERANCE)
}

fn divided(point: HPoint<View>) -> Result<[f64; 3], String> {
    point.divide().map(Into::into).ok_or_else(|| format!("{point:?} does not divide"))
}

type P = Result<Projective<View, View>, ProjectionError>;

fn p(case: &Value) -> Result<P, String> {
    Ok(chapter::p(field(case, "n")?, field(case, "f")?))
}

fn order_of_depths(p: Projective<View, View>, case: &Value, out: &Value) -> Result<(), String> {
    let depth =
        |z: &Value| divided(p.point(Point::new(0.0, 0.0, number(z)?))).map(|image| image[2]);
    let ours: Vec<f64> = list(&case["z"])?.iter().map(depth).collect::<Result<_, _>>()?;
    let theirs: Vec<f64> = list(&out["z"])?.iter().map(number).collect::<Result<_, _>>()?;
    close_all("z", &ours, &theirs, TOLERANCE)?;
    let decreasing = ours.windows(2).all(|pair| pair[0] > pair[1]);
    if decreasing == (out["strictly_decreasing"] == true) {
        Ok(())
    } else {
        Err(format!("strictly decreasing: {decreasing}"))
    }
}

/// An affine map gives the same place for (x, y, z, 1) and for (hx, hy, hz, h).
fn heights(case: &Value, out: &Value) -> Result<(), String> {
    let map = Affine::<World, World>::from_raw(matrix(&case["matrix"])?).ok_or("is not affine")?;
    let (p, h) = (Point::from(point(&case["p"])?), field(case, "h")?);
    let theirs = point(&out["point"])?;
    close_all("point", &<[f64; 3]>::from(map.point(p)), &theirs, TOLERANCE)?;
    let lifted = HPoint::from_raw(p.raw().extend(1.0) * h);
    let image = Projective::from(map).hpoint(lifted);
    close("h", image.w(), h, TOLERANCE)?;
    let place = image.divide().ok_or("h is 0")?;
    close_all("point from h", &<[f64; 3]>::from(place), &theirs, TOLERANCE)
}

fn inverse_of_p(case: &Value, out: &Value) -> Result<(), String> {
    let (n, f) = (field(case, "n")?, field(case, "f")?);
    judge(chapter::p_inverse_scaled(n, f), out, |scaled| {
        same(scaled.raw(), out, "inverse_scaled_by_nf")?;
        let p = chapter::p(n, f).map_err(|error| error.to_string())?;
        same(p.then(scaled).raw(), out, "product")
    })
}

fn corners_of_m_per(case: &Value, out: &Value) -> Result<(), String> {
    let [l, r, b, t, n, f] = edges(case)?;
    judge(chapter::m_per(l, r, b, t, n, f), out, |m| {
        let image = |x, y, z| {
            let image = m.point(Point::new(x, y, z)).divide().ok_or("does not divide")?;
            Ok::<_, String>(<[f64; 3]>::from(image))
        };
        for (name, ours) in
            [("image_of_r_t_n", image(r, t, n)?), ("image_of_l_b_n", image(l, b, n)?)]
        {
            close_all(name, &ours, &point(&out[name])?, TOLERANCE)?;
        }
        close("z_of_far", image(0.0, 0.0, f)?[2], field(out, "z_of_far")?, TOLERANCE)
    })
}

fn order_on_segments(case: &Value, out: &Value) -> Result<(), String> {
    let f = Foreshortening::new(field(case, "w_r")?, field(case, "w_R")?);
    judge(f, out, |f| {
        for (name, t) in [("f0", 0.0), ("f1", 1.0), ("f_half", 0.5)] {
            close(name, f.image(t).ok_or("has no image")?, field(out, name)?, TOLERANCE)?;
        }
        for (name, t) in [("derivative_at_0", 0.0), ("derivative_at_1", 1.0)] {
            close(name, f.derivative(t).ok_or("has no derivative")?, field(out, name)?, TOLERANCE)?;
        }
        Ok(())
    })
}

/// `[l, r, b, t, n, f]` of a case.
fn edges(case: &Value) -> Result<[f64; 6], String> {
    let mut edges = [0.0; 6];
    for (edge, name) in edges.iter_mut().zip(["l", "r", "b", "t", "n", "f"]) {
        *edge = field(case, name)?;
    }
    Ok(edges)
}

/// Ours is the correct form and is not the printed one.
fn right(ours: DMat4, out: &Value, correct: &str, printed: &str) -> Result<(), String> {
    same(ours, out, correct)?;
    match close_matrix(printed, ours, matrix(&out[printed])?, TOLERANCE) {
        Ok(()) => Err(format!("is the form called {printed}")),
        Err(_) => Ok(()),
    }
}

fn misprint(case: &Value, out: &Value) -> Result<(), String> {
    let refused = |error: ProjectionError| error.to_string();
    match text(case, "id")? {
        "004-frustum-col3" => {
            let [l, r, b, t, n, f] = edges(case)?;
            let ours = api::frustum_gl(l, r, b, t, n, f).map_err(refused)?;
            right(ours.raw(), out, "correct", "printed")
        }
        "004-ortho-z-translation" => {
            let [l, r, b, t, n, f] = edges(case)?;
            let ours = api::ortho_gl(l, r, b, t, n, f).map_err(refused)?;
            right(ours.raw(), out, "correct", "printed")
        }
        "003-eq4-5-7-w" => {
            let (n, f) = (field(case, "n")?, field(case, "f")?);
            // With the window [−n, n]² the frustum's x and y rows are those of the identity.
            let ours = api::frustum_gl(-n, n, -n, n, n, f).map_err(refused)?;
            right(ours.raw(), out, "correct", "printed")
        }
        "003-eq9-vs-glFrustum" => apex_moved(case, out),
        "001-mcam-third-row" => {
            let eye = Point::from(point(&case["e"])?);
            let camera = Camera::look_to(eye, -Vector::Z, Vector::Y).map_err(|e| e.to_string())?;
            right(camera.world_to_view().raw(), out, "correct", "printed")
        }
        "004-window-viewport-sign" => {
            let map = window_map(case)?.map_err(|error| error.to_string())?;
            close_matrix3("correct", map.homography().raw(), &out["correct"])?;
            let printed = close_matrix3("printed", map.homography().raw(), &out["printed"]);
            printed.err().map(|_| ()).ok_or_else(|| "is the printed form".to_owned())
        }
        "000-translation-ty-twice" => {
            let by = Vector::<World>::from(point(&case["t"])?);
            right(Affine::<World, World>::translation(by).raw(), out, "correct", "printed")
        }
        "000-algorithm-without-P" => {
            let [l, r, b, t, n, f] = edges(case)?;
            let ours = chapter::m_per(l, r, b, t, n, f).map_err(refused)?;
            right(ours.raw(), out, "correct", "printed")?;
            // What is printed is a matrix as well, but that of the box: w stays 1 and nothing is foreshortened.
            let orth = chapter::m_orth(l, r, b, t, n, f).map_err(refused)?;
            same(orth.raw(), out, "printed")
        }
        "004-perspective-tan" => angle(case, out),
        "000-gl-vs-per" => {
            let [l, r, b, t, n, f] = edges(case)?;
            let frustum = Frustum::new(l, r, b, t, n, f).map_err(refused)?;
            same(frustum.view_to_clip(Convention::OPENGL).raw(), out, "M_OpenGL")?;
            let chapter = frustum.view_to_clip(Convention::CHAPTER);
            let turned = Convention::CHAPTER.convert(Convention::OPENGL, chapter);
            same(turned.raw(), out, "minus_flip_M_per")
        }
        other => Err(format!("unknown misprint {other}")),
    }
}

fn apex_moved(case: &Value, out: &Value) -> Result<(), String> {
    let [l, r, b, t, n, f] = edges(case)?;
    let lesson = ApexMovedFrustum::new(l, r, b, t, n, f).map_err(|error| error.to_string())?;
    right(lesson.view_to_clip(Convention::OPENGL).raw(), out, "eq9", "glFrustum")?;
    let frustum = api::frustum_gl(l, r, b, t, n, f).map_err(|error| error.to_string())?;
    right(frustum.raw(), out, "glFrustum", "eq9")
}

fn angle(case: &Value, out: &Value) -> Result<(), String> {
    let matrix = api::perspective_gl(field(case, "fovy")?, field(case, "aspect")?, 1.0, 2.0);
    let raw = matrix.map_err(|error| error.to_string())?.raw();
    let ours = [raw.x_axis.x, raw.y_axis.y];
    close_all("diagonal", &ours, &numbers::<2>(&out["correct_diag"])?, TOLERANCE)?;
    let printed = close_all("diagonal", &ours, &numbers::<2>(&out["printed_diag"])?, TOLERANCE);
    printed.err().map(|_| ()).ok_or_else(|| "is the printed form".to_owned())
}
