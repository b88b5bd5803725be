//! Every projection builder against the formulas of its topic (OR-1 to VV-2, FOV-1, ZP-1).

use crate::Runner;
use crate::numbers::{
    TOLERANCE, assert_all_close, assert_close, assert_matrix_close, compare_outcome, number_field,
    parse_array, parse_matrix, parse_number, parse_numbers, parse_point, parse_point4, text_field,
};
use glam::DMat4;
use homog::{Clip, HPoint, Normal, Plane, Point, Projective, Space, Vector, View};
use projection::{
    ApexMovedFrustum, Axonometric, Convention, DepthCurve, DepthFormat, Fov, Frustum, NPoint,
    Oblique, Orthographic, Perspective, PrincipalPlane, ProjectionError, Projector, VanishingPoint,
    api, chapter, opening_angle_of, principal_vanishing_points, vanishing_point,
};
use serde_json::Value;

/// One per file.
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
    ("multiview_axonometric", check_axonometric),
    ("oblique", check_oblique),
    ("npoint", check_npoint),
    ("vanishing_points", check_vanishing_points),
    ("normalisation", check_normalization),
    ("fov", check_field_of_view),
    ("depth_precision", check_depth_precision),
];

type CheckResult = Result<(), String>;
pub type BuiltMatrices = Result<(DMat4, DMat4), ProjectionError>;

/// Convention and sort of the interfaces' builders.
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

/// The matrix as the named builder makes it, and the closed-form inverse.
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

fn check_mapped_points<B: Space>(
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

fn divide_point<S: Space>(image: HPoint<S>) -> Result<[f64; 3], String> {
    image.divide().map(Into::into).ok_or_else(|| format!("{image:?} does not divide"))
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
        return Err(format!("the inverses are refused: {refused:?}"));
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

fn check_axonometric(case: &Value, out: &Value) -> CheckResult {
    match text_field(case, "op")? {
        "multiview" => check_multiview(case, out),
        "axonometric" => {
            let built =
                Axonometric::by_angles(number_field(case, "alpha")?, number_field(case, "beta")?);
            let origin = parse_point(&case["origin"])?.into();
            compare_outcome(built.and_then(|built| built.about(origin)), out, |ours| {
                assert_matrix_close(
                    "matrix",
                    ours.onto_plane().raw(),
                    parse_matrix(&out["matrix"])?,
                    TOLERANCE,
                )?;
                let kept = ours.depth_preserving().raw();
                assert_matrix_close(
                    "matrix_depth_kept",
                    kept,
                    parse_matrix(&out["matrix_depth_kept"])?,
                    TOLERANCE,
                )?;
                assert_all_close(
                    "foreshortening",
                    &ours.foreshortening(),
                    &parse_point(&out["foreshortening"])?,
                    TOLERANCE,
                )?;
                let q = ours.onto_plane().transform_point(parse_point(&case["p"])?.into());
                assert_all_close("q", &<[f64; 3]>::from(q), &parse_point(&out["q"])?, TOLERANCE)
            })
        }
        "axonometric_from_normal" => {
            let normal = Normal::from_raw(parse_point(&case["normal"])?.into());
            compare_outcome(Axonometric::by_normal(normal), out, |ours| {
                assert_close("alpha", ours.alpha(), number_field(out, "alpha")?, TOLERANCE)?;
                assert_close("beta", ours.beta(), number_field(out, "beta")?, TOLERANCE)?;
                assert_matrix_close(
                    "matrix",
                    ours.onto_plane().raw(),
                    parse_matrix(&out["matrix"])?,
                    TOLERANCE,
                )
            })
        }
        other => Err(format!("unknown op {other}")),
    }
}

fn check_multiview(case: &Value, out: &Value) -> CheckResult {
    let plane = match text_field(case, "plane")? {
        "yoz" => PrincipalPlane::Yoz,
        "zox" => PrincipalPlane::Zox,
        "xoy" => PrincipalPlane::Xoy,
        other => return Err(format!("unknown plane {other}")),
    };
    let flat = plane.onto_plane::<View>();
    assert_matrix_close("matrix", flat.raw(), parse_matrix(&out["matrix"])?, 0.0)?;
    let q = flat.transform_point(parse_point(&case["p"])?.into());
    assert_all_close("q", &<[f64; 3]>::from(q), &parse_point(&out["q"])?, 0.0)
}

fn check_oblique(case: &Value, out: &Value) -> CheckResult {
    let built = match text_field(case, "op")? {
        "oblique" => Oblique::new(number_field(case, "L1")?, number_field(case, "phi")?),
        "oblique_angle" => {
            Oblique::by_angle(number_field(case, "alpha")?, number_field(case, "phi")?)
        }
        "oblique_dir" => {
            Oblique::by_direction(parse_point(&case["dir"])?.into(), number_field(case, "zp")?)
        }
        other => return Err(format!("unknown op {other}")),
    };
    compare_outcome(built, out, |ours| {
        let flat = ours.onto_plane();
        assert_matrix_close("matrix", flat.raw(), parse_matrix(&out["matrix"])?, TOLERANCE)?;
        let answers = [("alpha", ours.alpha()), ("L1", ours.length()), ("phi", ours.phi())];
        for (name, value) in answers.into_iter().filter(|(name, _)| out.get(name).is_some()) {
            assert_close(name, value, number_field(out, name)?, TOLERANCE)?;
        }
        if out.get("direction").is_some() {
            let direction = <[f64; 3]>::from(ours.direction());
            assert_all_close("direction", &direction, &parse_point(&out["direction"])?, TOLERANCE)?;
        }
        if out.get("q").is_some() {
            let q = flat.transform_point(parse_point(&case["p"])?.into());
            assert_all_close("q", &<[f64; 3]>::from(q), &parse_point(&out["q"])?, TOLERANCE)?;
        }
        same_from_first_principles(ours)
    })
}

/// A direction and a plane give the same matrices.
fn same_from_first_principles(ours: Oblique) -> CheckResult {
    let plane = Plane::through(Point::new(0.0, 0.0, ours.plane_z()), Normal::new(0.0, 0.0, 1.0));
    let principles = Projector::along(ours.direction(), plane).map_err(|e| e.to_string())?;
    assert_matrix_close("onto", principles.onto_plane().raw(), ours.onto_plane().raw(), 1e-11)?;
    assert_matrix_close(
        "kept",
        principles.depth_preserving().raw(),
        ours.depth_preserving().raw(),
        1e-11,
    )
}

fn check_npoint(case: &Value, out: &Value) -> CheckResult {
    let built = match text_field(case, "op")? {
        "one_point" => NPoint::from_eye(number_field(case, "d")?),
        "n_point" => NPoint::new(
            number_field(case, "p")?,
            number_field(case, "q")?,
            number_field(case, "r")?,
        ),
        other => return Err(format!("unknown op {other}")),
    };
    let images = built.map_err(|e| e.to_string()).and_then(|ours| {
        let flat = project_points(ours.onto_plane(), &case["points"])?;
        Ok((ours, flat, project_points(ours.depth_preserving(), &case["points"])?))
    });
    compare_outcome(images, out, |(ours, flat, kept)| {
        assert_matrix_close(
            "matrix",
            ours.onto_plane().raw(),
            parse_matrix(&out["matrix"])?,
            TOLERANCE,
        )?;
        compare_points("points", &flat, &out["points"])?;
        if out.get("matrix_depth_kept").is_none() {
            return Ok(());
        }
        let theirs = parse_matrix(&out["matrix_depth_kept"])?;
        assert_matrix_close("matrix_depth_kept", ours.depth_preserving().raw(), theirs, TOLERANCE)?;
        compare_points("points_depth_kept", &kept, &out["points_depth_kept"])?;
        check_principal_points(ours, out)
    })
}

/// The images, an error where a point has none.
fn project_points(map: Projective<View, View>, points: &Value) -> Result<Vec<[f64; 3]>, String> {
    parse_array(points)?
        .iter()
        .map(|p| divide_point(map.transform_point(parse_point(p)?.into())))
        .collect()
}

fn compare_points(name: &str, ours: &[[f64; 3]], theirs: &Value) -> CheckResult {
    for (ours, theirs) in ours.iter().zip(parse_array(theirs)?) {
        assert_all_close(name, ours, &parse_point(theirs)?, TOLERANCE)?;
    }
    Ok(())
}

fn check_principal_points(ours: NPoint, out: &Value) -> CheckResult {
    let found = principal_vanishing_points(ours.depth_preserving()).map_err(|e| e.to_string())?;
    let count = out["count"].as_u64().and_then(|count| usize::try_from(count).ok());
    if Some(found.count()) != count || Some(ours.count()) != count {
        return Err(format!("has {} vanishing points, not {count:?}", found.count()));
    }
    let theirs = parse_array(&out["principal_vanishing_points_depth_kept"])?;
    for (ours, theirs) in found.axes.iter().zip(theirs) {
        match (ours.point(), theirs) {
            (None, Value::Null) => {}
            (Some(at), theirs) => {
                assert_all_close(
                    "vanishing point",
                    &<[f64; 3]>::from(at),
                    &parse_point(theirs)?,
                    TOLERANCE,
                )?;
            }
            (None, theirs) => return Err(format!("vanishes nowhere, not at {theirs}")),
        }
    }
    Ok(())
}

fn check_vanishing_points(case: &Value, out: &Value) -> CheckResult {
    let direction = parse_point(&case["direction"])?;
    match text_field(case, "op")? {
        "vanishing_frustum_gl" => {
            let [l, r, b] =
                [number_field(case, "l")?, number_field(case, "r")?, number_field(case, "b")?];
            let [t, n, f] =
                [number_field(case, "t")?, number_field(case, "n")?, number_field(case, "f")?];
            let frustum = Frustum::new(l, r, b, t, n, f).map_err(|e| e.to_string())?;
            let map = frustum.view_to_clip(Convention::OPENGL);
            compare_outcome(vanishing_point(map, direction.into()), out, |ours| {
                check_vanishing_point(ours, out, "ndc")
            })
        }
        "vanishing_one_point" => {
            let map =
                NPoint::from_eye(number_field(case, "d")?).map_err(|e| e.to_string())?.onto_plane();
            compare_outcome(vanishing_point(map, direction.into()), out, |ours| {
                check_vanishing_point(ours, out, "xy")
            })
        }
        "vanishing_camera" => {
            let world_to_clip = world_to_clip(case)?;
            let ours = vanishing_point(world_to_clip, direction.into());
            compare_outcome(ours, out, |ours| check_vanishing_point(ours, out, "ndc_xy"))
        }
        other => Err(format!("unknown op {other}")),
    }
}

fn world_to_clip(case: &Value) -> Result<Projective<homog::World, Clip>, String> {
    let (e, g, t) = (parse_point(&case["e"])?, parse_point(&case["g"])?, parse_point(&case["t"])?);
    let camera =
        camera::Camera::look_to(e.into(), g.into(), t.into()).map_err(|e| e.to_string())?;
    let fov = Fov::Vertical(number_field(case, "fovy")?);
    let lens = Perspective::new(
        fov,
        number_field(case, "aspect")?,
        number_field(case, "n")?,
        number_field(case, "f")?,
    );
    let lens = lens.map_err(|e| e.to_string())?;
    Ok(camera.world_to_view().then_project(lens.view_to_clip(Convention::OPENGL)))
}

fn check_vanishing_point<S: Space>(ours: VanishingPoint<S>, out: &Value, at: &str) -> CheckResult {
    let infinite = out["at_infinity"] == true;
    match ours {
        VanishingPoint::At { point, ahead } if !infinite => {
            let theirs =
                parse_array(&out[at])?.iter().map(parse_number).collect::<Result<Vec<_>, _>>()?;
            let place = <[f64; 3]>::from(point);
            assert_all_close(at, &place[..theirs.len()], &theirs, 1e-11)?;
            match out.get("in_front") {
                Some(front) if *front != ahead => Err(format!("in_front is {ahead}")),
                _ => Ok(()),
            }
        }
        VanishingPoint::AtInfinity { direction } if infinite => {
            let [x, y] = parse_numbers::<2>(&out["direction"])?;
            let cross = direction.x() * y - direction.y() * x;
            let size = direction.length() * (x * x + y * y).sqrt();
            assert_close("direction, across", cross / size, 0.0, TOLERANCE)
        }
        other => Err(format!("is {other:?}")),
    }
}

fn check_normalization(case: &Value, out: &Value) -> CheckResult {
    let edge = |name| number_field(case, name);
    let (l, r, b, t, n, f) =
        (edge("l")?, edge("r")?, edge("b")?, edge("t")?, edge("n")?, edge("f")?);
    if text_field(case, "op")? == "frustum" {
        return compare_outcome(Frustum::new(l, r, b, t, n, f), out, |ours| {
            check_sheared_frustum(ours, out)
        });
    }
    let direction: Vector<View> = parse_point(&case["dir"])?.into();
    let slant = Oblique::by_direction(direction, edge("z0")?);
    let prism = slant.and_then(|slant| Ok((slant, Orthographic::new(l, r, b, t, n, f)?)));
    compare_outcome(prism, out, |(slant, volume)| {
        let factors = slant.factors(volume, Convention::OPENGL);
        assert_matrix_close("shear", factors.shear.raw(), parse_matrix(&out["shear"])?, TOLERANCE)?;
        assert_matrix_close(
            "matrix",
            factors.view_to_clip().raw(),
            parse_matrix(&out["matrix"])?,
            TOLERANCE,
        )?;
        check_mapped_points(factors.view_to_clip(), out, "clip", "ndc")
    })
}

fn check_sheared_frustum(ours: Frustum, out: &Value) -> CheckResult {
    let factors = ours.factors(Convention::OPENGL);
    assert_matrix_close("shear", factors.shear.raw(), parse_matrix(&out["shear"])?, TOLERANCE)?;
    assert_matrix_close("scale", factors.scale.raw(), parse_matrix(&out["scale"])?, TOLERANCE)?;
    assert_matrix_close("depth", factors.depth.raw(), parse_matrix(&out["depth"])?, TOLERANCE)?;
    assert_matrix_close(
        "matrix",
        factors.view_to_clip().raw(),
        parse_matrix(&out["matrix"])?,
        TOLERANCE,
    )?;
    let unit = ours.view_to_canonical_frustum(Convention::OPENGL).ok_or("has no far plane")?;
    assert_matrix_close(
        "unit_slope_far_1",
        unit.raw(),
        parse_matrix(&out["unit_slope_far_1"])?,
        TOLERANCE,
    )?;
    for case in parse_array(&out["maps"])? {
        let p = parse_point(&case["p"])?.into();
        let sheared = factors.shear.transform_point(p);
        assert_all_close(
            "sheared",
            &<[f64; 3]>::from(sheared),
            &parse_point(&case["sheared"])?,
            TOLERANCE,
        )?;
        let scaled = <[f64; 3]>::from(factors.scale.transform_point(sheared));
        assert_all_close("unit_slope", &scaled, &parse_point(&case["unit_slope"])?, TOLERANCE)?;
        let far_1 = <[f64; 3]>::from(unit.transform_point(p));
        assert_all_close(
            "far_at_minus_1",
            &far_1,
            &parse_point(&case["far_at_minus_1"])?,
            TOLERANCE,
        )?;
    }
    Ok(())
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

/// Steps are small, so they are compared by their ratio.
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
