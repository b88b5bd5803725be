//! Runners for projection matrices, fields of view and depth (OR-1 to LW-3, D3D-1 to IV-1, FOV-1,
//! ZP-1).

use crate::vectors::Runner;
use crate::vectors::numbers::{
    TOLERANCE, assert_all_close, assert_close, assert_matrix_close, compare_outcome, number_field,
    parse_array, parse_matrix, parse_point, parse_point4, text_field,
};
use glam::DMat4;
use homog::{Clip, HPoint, Point, Projective, Space, View};
use projection::{
    ApexMovedFrustum, Convention, DepthCurve, DepthFormat, Fov, Frustum, Orthographic, Perspective,
    ProjectionError, api, chapter, opening_angle_of,
};
use serde_json::Value;

/// The runners, one per file.
pub const RUNNERS: &[(&str, Runner)] = &[
    ("proj_orth", check_matrix_and_maps),
    ("proj_p", check_perspective_matrix),
    ("proj_per", check_matrix_and_maps),
    ("proj_frustum_gl", check_matrix_and_maps),
    ("proj_perspective_gl", check_matrix_and_maps),
    ("proj_ortho_gl", check_matrix_and_maps),
    ("proj_frustum_lw", check_matrix_and_maps),
    ("proj_zero_one", check_matrix_and_maps),
    ("proj_reversed_infinite", check_matrix_and_maps),
    ("proj_inverse", check_inverse),
    ("lw_ztable", check_lesson_table),
    ("fov", check_field_of_view),
    ("depth_precision", check_depth_precision),
];

/// The difference from the expected result, if any.
pub type CheckResult = Result<(), String>;
pub type BuiltMatrices = Result<(DMat4, DMat4), ProjectionError>;

/// Returns the convention of an interface's builder.
fn builder_convention(builder: &str) -> Convention {
    match builder {
        name if name.ends_with("_rh_zo_rev") || name.ends_with("_rh_zo_rev_inf") => {
            Convention::WEBGPU.reversed()
        }
        name if name.contains("_rh_zo") => Convention::WEBGPU,
        name if name.contains("_lh_zo") => Convention::DIRECT3D,
        _ => Convention::OPENGL,
    }
}

/// Returns the matrix from the named builder, and its closed-form inverse.
pub fn build_projection(case: &Value) -> Result<BuiltMatrices, String> {
    let builder = text_field(case, "builder")?;
    if builder.starts_with("perspective") {
        return build_from_angle(builder, case);
    }
    let edge = |name| number_field(case, name);
    let (l, r, b, t, n, f) =
        (edge("l")?, edge("r")?, edge("b")?, edge("t")?, edge("n")?, edge("f")?);
    let c = builder_convention(builder);
    let ortho = || Orthographic::new(l, r, b, t, n, f).map(|o| o.clip_to_view(c).raw());
    let frustum = || Frustum::new(l, r, b, t, n, f).map(|o| o.clip_to_view(c).raw());
    Ok(match builder {
        "orth" => chapter::m_orth(l, r, b, t, n, f)
            .and_then(|m| Ok((m.raw(), chapter::m_orth_inverse(l, r, b, t, n, f)?.raw()))),
        "per" => chapter::m_per(l, r, b, t, n, f)
            .and_then(|m| Ok((m.raw(), chapter::m_per_inverse(l, r, b, t, n, f)?.raw()))),
        "frustum_lw" => ApexMovedFrustum::new(l, r, b, t, n, f)
            .map(|lesson| (lesson.view_to_clip(c).raw(), lesson.clip_to_view(c).raw())),
        "frustum_gl" => api::frustum_gl(l, r, b, t, n, f).and_then(|m| Ok((m.raw(), frustum()?))),
        "frustum_rh_zo" => {
            api::frustum_rh_zo(l, r, b, t, n, f).and_then(|m| Ok((m.raw(), frustum()?)))
        }
        "frustum_lh_zo" => {
            api::frustum_lh_zo(l, r, b, t, n, f).and_then(|m| Ok((m.raw(), frustum()?)))
        }
        "ortho_gl" => api::ortho_gl(l, r, b, t, n, f).and_then(|m| Ok((m.raw(), ortho()?))),
        "ortho_rh_zo" => api::ortho_rh_zo(l, r, b, t, n, f).and_then(|m| Ok((m.raw(), ortho()?))),
        "ortho_lh_zo" => api::ortho_lh_zo(l, r, b, t, n, f).and_then(|m| Ok((m.raw(), ortho()?))),
        other => return Err(format!("unknown builder {other}")),
    })
}

fn build_from_angle(builder: &str, case: &Value) -> Result<BuiltMatrices, String> {
    let (fovy, aspect, n) =
        (number_field(case, "fovy")?, number_field(case, "aspect")?, number_field(case, "n")?);
    let far = || number_field(case, "f");
    let built = match builder {
        "perspective_gl" => api::perspective_gl(fovy, aspect, n, far()?),
        "perspective_rh_zo" => api::perspective_rh_zo(fovy, aspect, n, far()?),
        "perspective_lh_zo" => api::perspective_lh_zo(fovy, aspect, n, far()?),
        "perspective_rh_zo_rev" => api::perspective_rh_zo_rev(fovy, aspect, n, far()?),
        "perspective_gl_inf" => api::perspective_gl_inf(fovy, aspect, n),
        "perspective_rh_zo_inf" => api::perspective_rh_zo_inf(fovy, aspect, n),
        "perspective_rh_zo_rev_inf" => api::perspective_rh_zo_rev_inf(fovy, aspect, n),
        other => return Err(format!("unknown builder {other}")),
    };
    let far = if case.get("f").is_some() { far()? } else { f64::INFINITY };
    let lens = || Perspective::new(Fov::Vertical(fovy), aspect, n, far);
    Ok(built.and_then(|m| Ok((m.raw(), lens()?.clip_to_view(builder_convention(builder)).raw()))))
}

fn check_matrix_and_maps(case: &Value, out: &Value) -> CheckResult {
    compare_outcome(build_projection(case)?, out, |(ours, _)| {
        assert_matrix_close("matrix", ours, parse_matrix(&out["matrix"])?, TOLERANCE)?;
        check_mapped_points(Projective::<View, Clip>::from_raw(ours), out, "clip", "ndc")
    })
}

pub fn check_mapped_points<B: Space>(
    map: Projective<View, B>,
    out: &Value,
    before: &str,
    after: &str,
) -> CheckResult {
    for case in parse_array(&out["maps"])? {
        let image = map.transform_point(parse_point(&case["p"])?.into());
        if case.get(before).is_some() {
            assert_all_close(
                before,
                &<[f64; 4]>::from(image),
                &parse_point4(&case[before])?,
                TOLERANCE,
            )?;
        }
        assert_all_close(after, &divide_point(image)?, &parse_point(&case[after])?, TOLERANCE)?;
    }
    Ok(())
}

pub fn divide_point<S: Space>(image: HPoint<S>) -> Result<[f64; 3], String> {
    image.divide().map(Into::into).ok_or_else(|| format!("{image:?} cannot be divided by w"))
}

fn check_inverse(case: &Value, out: &Value) -> CheckResult {
    compare_outcome(build_projection(case)?, out, |(ours, inverse)| {
        assert_matrix_close("inverse", inverse, parse_matrix(&out["inverse"])?, TOLERANCE)?;
        let det = number_field(out, "det")?;
        assert_close("det", ours.determinant() / det, 1.0, 1e-11)
    })
}

fn check_perspective_matrix(case: &Value, out: &Value) -> CheckResult {
    let (n, f) = (number_field(case, "n")?, number_field(case, "f")?);
    let refused = [chapter::p_inverse(n, f).is_err(), chapter::p_inverse_scaled(n, f).is_err()];
    if refused != [out.get("error").is_some(); 2] {
        return Err(format!("the inverses are rejected: {refused:?}"));
    }
    compare_outcome(chapter::p(n, f), out, |p| {
        assert_matrix_close("matrix", p.raw(), parse_matrix(&out["matrix"])?, TOLERANCE)?;
        let inverse = chapter::p_inverse(n, f).map_err(|e| e.to_string())?;
        assert_matrix_close("inverse", inverse.raw(), parse_matrix(&out["inverse"])?, TOLERANCE)?;
        let scaled = chapter::p_inverse_scaled(n, f).map_err(|e| e.to_string())?;
        assert_matrix_close(
            "scaled",
            scaled.raw(),
            parse_matrix(&out["inverse_scaled_by_nf"])?,
            TOLERANCE,
        )?;
        let middle = divide_point(p.transform_point(Point::new(0.0, 0.0, (n + f) / 2.0)))?[2];
        assert_close("z_mid_image", middle, number_field(out, "z_mid_image")?, TOLERANCE)?;
        check_mapped_points(p, out, "h", "point")
    })
}

fn check_lesson_table(case: &Value, out: &Value) -> CheckResult {
    let curve = DepthCurve::perspective(
        number_field(case, "near")?,
        number_field(case, "far")?,
        Convention::OPENGL,
    );
    compare_outcome(curve, out, |curve| {
        if case.get("z").is_some() {
            let depth = curve.depth(-number_field(case, "z")?).ok_or("has no depth")?;
            if out.get("printed").is_some() {
                assert_close("printed", depth, number_field(out, "printed")?, 5e-5)?;
            }
            return assert_close("z_clip", depth, number_field(out, "z_clip")?, TOLERANCE);
        }
        let (c2, c1) = curve.coefficients();
        assert_close("c1", c1, number_field(out, "c1")?, TOLERANCE)?;
        assert_close("c2", c2, number_field(out, "c2")?, TOLERANCE)?;
        assert_close(
            "z_of_zero",
            -curve.half_range_distance(),
            number_field(out, "z_of_zero")?,
            TOLERANCE,
        )?;
        let zero = curve.distance(0.0).ok_or("has no distance")?;
        assert_close("distance(0)", -zero, number_field(out, "z_of_zero")?, TOLERANCE)
    })
}

fn check_field_of_view(case: &Value, out: &Value) -> CheckResult {
    match text_field(case, "op")? {
        "window_from_fov" => {
            let (theta, nx, ny) = (
                number_field(case, "theta")?,
                number_field(case, "nx")?,
                number_field(case, "ny")?,
            );
            let (n, f) = (number_field(case, "n")?, number_field(case, "f")?);
            let window = chapter::window_from_fov(theta, nx, ny, n);
            compare_outcome(window, out, |w| {
                let edges = [w.left(), w.right(), w.bottom(), w.top()];
                let theirs = [
                    number_field(out, "l")?,
                    number_field(out, "r")?,
                    number_field(out, "b")?,
                    number_field(out, "t")?,
                ];
                assert_all_close("window", &edges, &theirs, TOLERANCE)?;
                let across =
                    opening_angle_of(w.left(), w.right(), -n).map_err(|e| e.to_string())?;
                assert_close(
                    "theta_horizontal",
                    across,
                    number_field(out, "theta_horizontal")?,
                    TOLERANCE,
                )?;
                let [l, r, b, t] = edges;
                let per = chapter::m_per(l, r, b, t, n, f).map_err(|e| e.to_string())?;
                assert_matrix_close(
                    "matrix_per",
                    per.raw(),
                    parse_matrix(&out["matrix_per"])?,
                    TOLERANCE,
                )
            })
        }
        "fov_from_window" => {
            let theta =
                chapter::fov_from_window(number_field(case, "t")?, number_field(case, "n")?);
            compare_outcome(theta, out, |theta| {
                assert_close("theta", theta, number_field(out, "theta")?, TOLERANCE)
            })
        }
        "fov_of_asymmetric" => {
            let theta = opening_angle_of(
                number_field(case, "b")?,
                number_field(case, "t")?,
                number_field(case, "n")?,
            );
            compare_outcome(theta, out, |theta| {
                assert_close("theta", theta, number_field(out, "theta")?, TOLERANCE)
            })
        }
        other => Err(format!("unknown op {other}")),
    }
}

fn check_depth_precision(case: &Value, out: &Value) -> CheckResult {
    let (near, far) = (number_field(case, "near")?, number_field(case, "far")?);
    let distance = number_field(case, "distance")?;
    let forward = DepthCurve::perspective(near, far, Convention::WEBGPU);
    let both = forward.and_then(|forward| {
        Ok((forward, DepthCurve::perspective(near, far, Convention::WEBGPU.reversed())?))
    });
    compare_outcome(both, out, |(forward, reversed)| {
        let depth = |curve: DepthCurve| curve.depth(distance).ok_or("has no depth");
        assert_close(
            "depth_zero_one",
            depth(forward)?,
            number_field(out, "depth_zero_one")?,
            TOLERANCE,
        )?;
        assert_close(
            "depth_reversed",
            depth(reversed)?,
            number_field(out, "depth_reversed")?,
            TOLERANCE,
        )?;
        let (float, fixed) = (DepthFormat::Float32, DepthFormat::FixedPoint(24));
        check_depth_step(forward, distance, float, out, "step_float32_zero_one")?;
        check_depth_step(reversed, distance, float, out, "step_float32_reversed")?;
        check_depth_step(forward, distance, fixed, out, "step_unorm24_estimate")
    })
}

/// Checks a depth step. Steps are small, so their ratio is compared.
fn check_depth_step(
    curve: DepthCurve,
    distance: f64,
    format: DepthFormat,
    out: &Value,
    name: &str,
) -> CheckResult {
    let ours = curve.resolution(distance, format).map_err(|e| e.to_string())?;
    assert_close(name, ours / number_field(out, name)?, 1.0, 1e-9)
}
