//! Every projection builder against the formulas of its topic (OR-1 to VV-2, FOV-1, ZP-1).

use crate::Runner;
use crate::numbers::{
    TOLERANCE, close, close_all, close_matrix, field, judge, list, matrix, number, numbers, point,
    point4, text,
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
    ("proj_orth", matrix_and_maps),
    ("proj_p", p),
    ("proj_per", matrix_and_maps),
    ("proj_frustum_gl", matrix_and_maps),
    ("proj_perspective_gl", matrix_and_maps),
    ("proj_ortho_gl", matrix_and_maps),
    ("proj_frustum_lw", matrix_and_maps),
    ("proj_zero_one", matrix_and_maps),
    ("proj_reversed_infinite", matrix_and_maps),
    ("proj_inverse", inverse),
    ("lw_ztable", lesson_table),
    ("multiview_axonometric", axonometric),
    ("oblique", oblique),
    ("npoint", npoint),
    ("vanishing_points", vanishing),
    ("normalisation", normalisation),
    ("fov", field_of_view),
    ("depth_precision", depth_precision),
];

type Check = Result<(), String>;
pub type Built = Result<(DMat4, DMat4), ProjectionError>;

/// Convention and sort of the interfaces' builders.
fn convention(builder: &str) -> Convention {
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
pub fn build(case: &Value) -> Result<Built, String> {
    let builder = text(case, "builder")?;
    if builder.starts_with("perspective") {
        return by_angle(builder, case);
    }
    let edge = |name| field(case, name);
    let (l, r, b, t, n, f) =
        (edge("l")?, edge("r")?, edge("b")?, edge("t")?, edge("n")?, edge("f")?);
    let c = convention(builder);
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

fn by_angle(builder: &str, case: &Value) -> Result<Built, String> {
    let (fovy, aspect, n) = (field(case, "fovy")?, field(case, "aspect")?, field(case, "n")?);
    let far = || field(case, "f");
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
    Ok(built.and_then(|m| Ok((m.raw(), lens()?.clip_to_view(convention(builder)).raw()))))
}

fn matrix_and_maps(case: &Value, out: &Value) -> Check {
    judge(build(case)?, out, |(ours, _)| {
        close_matrix("matrix", ours, matrix(&out["matrix"])?, TOLERANCE)?;
        maps(Projective::<View, Clip>::from_raw(ours), out, "clip", "ndc")
    })
}

fn maps<B: Space>(map: Projective<View, B>, out: &Value, before: &str, after: &str) -> Check {
    for case in list(&out["maps"])? {
        let image = map.point(point(&case["p"])?.into());
        if case.get(before).is_some() {
            close_all(before, &<[f64; 4]>::from(image), &point4(&case[before])?, TOLERANCE)?;
        }
        close_all(after, &divided(image)?, &point(&case[after])?, TOLERANCE)?;
    }
    Ok(())
}

fn divided<S: Space>(image: HPoint<S>) -> Result<[f64; 3], String> {
    image.divide().map(Into::into).ok_or_else(|| format!("{image:?} does not divide"))
}

fn inverse(case: &Value, out: &Value) -> Check {
    judge(build(case)?, out, |(ours, inverse)| {
        close_matrix("inverse", inverse, matrix(&out["inverse"])?, TOLERANCE)?;
        let det = field(out, "det")?;
        close("det", ours.determinant() / det, 1.0, 1e-11)
    })
}

fn p(case: &Value, out: &Value) -> Check {
    let (n, f) = (field(case, "n")?, field(case, "f")?);
    let refused = [chapter::p_inverse(n, f).is_err(), chapter::p_inverse_scaled(n, f).is_err()];
    if refused != [out.get("error").is_some(); 2] {
        return Err(format!("the inverses are refused: {refused:?}"));
    }
    judge(chapter::p(n, f), out, |p| {
        close_matrix("matrix", p.raw(), matrix(&out["matrix"])?, TOLERANCE)?;
        let inverse = chapter::p_inverse(n, f).map_err(|e| e.to_string())?;
        close_matrix("inverse", inverse.raw(), matrix(&out["inverse"])?, TOLERANCE)?;
        let scaled = chapter::p_inverse_scaled(n, f).map_err(|e| e.to_string())?;
        close_matrix("scaled", scaled.raw(), matrix(&out["inverse_scaled_by_nf"])?, TOLERANCE)?;
        let middle = divided(p.point(Point::new(0.0, 0.0, (n + f) / 2.0)))?[2];
        close("z_mid_image", middle, field(out, "z_mid_image")?, TOLERANCE)?;
        maps(p, out, "h", "point")
    })
}

fn lesson_table(case: &Value, out: &Value) -> Check {
    let curve =
        DepthCurve::perspective(field(case, "near")?, field(case, "far")?, Convention::OPENGL);
    judge(curve, out, |curve| {
        if case.get("z").is_some() {
            let depth = curve.depth(-field(case, "z")?).ok_or("has no depth")?;
            if out.get("printed").is_some() {
                close("printed", depth, field(out, "printed")?, 5e-5)?;
            }
            return close("z_clip", depth, field(out, "z_clip")?, TOLERANCE);
        }
        let (c2, c1) = curve.coefficients();
        close("c1", c1, field(out, "c1")?, TOLERANCE)?;
        close("c2", c2, field(out, "c2")?, TOLERANCE)?;
        close("z_of_zero", -curve.half_range_distance(), field(out, "z_of_zero")?, TOLERANCE)?;
        let zero = curve.distance(0.0).ok_or("has no distance")?;
        close("distance(0)", -zero, field(out, "z_of_zero")?, TOLERANCE)
    })
}

fn axonometric(case: &Value, out: &Value) -> Check {
    match text(case, "op")? {
        "multiview" => multiview(case, out),
        "axonometric" => {
            let built = Axonometric::by_angles(field(case, "alpha")?, field(case, "beta")?);
            let origin = point(&case["origin"])?.into();
            judge(built.and_then(|built| built.about(origin)), out, |ours| {
                close_matrix(
                    "matrix",
                    ours.onto_plane().raw(),
                    matrix(&out["matrix"])?,
                    TOLERANCE,
                )?;
                let kept = ours.depth_kept().raw();
                close_matrix(
                    "matrix_depth_kept",
                    kept,
                    matrix(&out["matrix_depth_kept"])?,
                    TOLERANCE,
                )?;
                close_all(
                    "foreshortening",
                    &ours.foreshortening(),
                    &point(&out["foreshortening"])?,
                    TOLERANCE,
                )?;
                let q = ours.onto_plane().point(point(&case["p"])?.into());
                close_all("q", &<[f64; 3]>::from(q), &point(&out["q"])?, TOLERANCE)
            })
        }
        "axonometric_from_normal" => {
            let normal = Normal::from_raw(point(&case["normal"])?.into());
            judge(Axonometric::by_normal(normal), out, |ours| {
                close("alpha", ours.alpha(), field(out, "alpha")?, TOLERANCE)?;
                close("beta", ours.beta(), field(out, "beta")?, TOLERANCE)?;
                close_matrix("matrix", ours.onto_plane().raw(), matrix(&out["matrix"])?, TOLERANCE)
            })
        }
        other => Err(format!("unknown op {other}")),
    }
}

fn multiview(case: &Value, out: &Value) -> Check {
    let plane = match text(case, "plane")? {
        "yoz" => PrincipalPlane::Yoz,
        "zox" => PrincipalPlane::Zox,
        "xoy" => PrincipalPlane::Xoy,
        other => return Err(format!("unknown plane {other}")),
    };
    let flat = plane.onto_plane::<View>();
    close_matrix("matrix", flat.raw(), matrix(&out["matrix"])?, 0.0)?;
    let q = flat.point(point(&case["p"])?.into());
    close_all("q", &<[f64; 3]>::from(q), &point(&out["q"])?, 0.0)
}

fn oblique(case: &Value, out: &Value) -> Check {
    let built = match text(case, "op")? {
        "oblique" => Oblique::new(field(case, "L1")?, field(case, "phi")?),
        "oblique_angle" => Oblique::by_angle(field(case, "alpha")?, field(case, "phi")?),
        "oblique_dir" => Oblique::by_direction(point(&case["dir"])?.into(), field(case, "zp")?),
        other => return Err(format!("unknown op {other}")),
    };
    judge(built, out, |ours| {
        let flat = ours.onto_plane();
        close_matrix("matrix", flat.raw(), matrix(&out["matrix"])?, TOLERANCE)?;
        let answers = [("alpha", ours.alpha()), ("L1", ours.length()), ("phi", ours.phi())];
        for (name, value) in answers.into_iter().filter(|(name, _)| out.get(name).is_some()) {
            close(name, value, field(out, name)?, TOLERANCE)?;
        }
        if out.get("direction").is_some() {
            let direction = <[f64; 3]>::from(ours.direction());
            close_all("direction", &direction, &point(&out["direction"])?, TOLERANCE)?;
        }
        if out.get("q").is_some() {
            let q = flat.point(point(&case["p"])?.into());
            close_all("q", &<[f64; 3]>::from(q), &point(&out["q"])?, TOLERANCE)?;
        }
        same_from_first_principles(ours)
    })
}

/// A direction and a plane give the same matrices.
fn same_from_first_principles(ours: Oblique) -> Check {
    let plane = Plane::through(Point::new(0.0, 0.0, ours.plane_z()), Normal::new(0.0, 0.0, 1.0));
    let principles = Projector::along(ours.direction(), plane).map_err(|e| e.to_string())?;
    close_matrix("onto", principles.onto_plane().raw(), ours.onto_plane().raw(), 1e-11)?;
    close_matrix("kept", principles.depth_kept().raw(), ours.depth_kept().raw(), 1e-11)
}

fn npoint(case: &Value, out: &Value) -> Check {
    let built = match text(case, "op")? {
        "one_point" => NPoint::from_eye(field(case, "d")?),
        "n_point" => NPoint::new(field(case, "p")?, field(case, "q")?, field(case, "r")?),
        other => return Err(format!("unknown op {other}")),
    };
    let images = built.map_err(|e| e.to_string()).and_then(|ours| {
        let flat = images(ours.onto_plane(), &case["points"])?;
        Ok((ours, flat, images(ours.depth_kept(), &case["points"])?))
    });
    judge(images, out, |(ours, flat, kept)| {
        close_matrix("matrix", ours.onto_plane().raw(), matrix(&out["matrix"])?, TOLERANCE)?;
        same_points("points", &flat, &out["points"])?;
        if out.get("matrix_depth_kept").is_none() {
            return Ok(());
        }
        let theirs = matrix(&out["matrix_depth_kept"])?;
        close_matrix("matrix_depth_kept", ours.depth_kept().raw(), theirs, TOLERANCE)?;
        same_points("points_depth_kept", &kept, &out["points_depth_kept"])?;
        principal_points(ours, out)
    })
}

/// The images, an error where a point has none.
fn images(map: Projective<View, View>, points: &Value) -> Result<Vec<[f64; 3]>, String> {
    list(points)?.iter().map(|p| divided(map.point(point(p)?.into()))).collect()
}

fn same_points(name: &str, ours: &[[f64; 3]], theirs: &Value) -> Check {
    for (ours, theirs) in ours.iter().zip(list(theirs)?) {
        close_all(name, ours, &point(theirs)?, TOLERANCE)?;
    }
    Ok(())
}

fn principal_points(ours: NPoint, out: &Value) -> Check {
    let found = principal_vanishing_points(ours.depth_kept()).map_err(|e| e.to_string())?;
    let count = out["count"].as_u64().and_then(|count| usize::try_from(count).ok());
    if Some(found.count()) != count || Some(ours.count()) != count {
        return Err(format!("has {} vanishing points, not {count:?}", found.count()));
    }
    let theirs = list(&out["principal_vanishing_points_depth_kept"])?;
    for (ours, theirs) in found.axes.iter().zip(theirs) {
        match (ours.point(), theirs) {
            (None, Value::Null) => {}
            (Some(at), theirs) => {
                close_all("vanishing point", &<[f64; 3]>::from(at), &point(theirs)?, TOLERANCE)?;
            }
            (None, theirs) => return Err(format!("vanishes nowhere, not at {theirs}")),
        }
    }
    Ok(())
}

fn vanishing(case: &Value, out: &Value) -> Check {
    let direction = point(&case["direction"])?;
    match text(case, "op")? {
        "vanishing_frustum_gl" => {
            let [l, r, b] = [field(case, "l")?, field(case, "r")?, field(case, "b")?];
            let [t, n, f] = [field(case, "t")?, field(case, "n")?, field(case, "f")?];
            let frustum = Frustum::new(l, r, b, t, n, f).map_err(|e| e.to_string())?;
            let map = frustum.view_to_clip(Convention::OPENGL);
            judge(vanishing_point(map, direction.into()), out, |ours| vanishes(ours, out, "ndc"))
        }
        "vanishing_one_point" => {
            let map = NPoint::from_eye(field(case, "d")?).map_err(|e| e.to_string())?.onto_plane();
            judge(vanishing_point(map, direction.into()), out, |ours| vanishes(ours, out, "xy"))
        }
        "vanishing_camera" => {
            let world_to_clip = camera_and_lens(case)?;
            let ours = vanishing_point(world_to_clip, direction.into());
            judge(ours, out, |ours| vanishes(ours, out, "ndc_xy"))
        }
        other => Err(format!("unknown op {other}")),
    }
}

fn camera_and_lens(case: &Value) -> Result<Projective<homog::World, Clip>, String> {
    let (e, g, t) = (point(&case["e"])?, point(&case["g"])?, point(&case["t"])?);
    let camera =
        camera::Camera::look_to(e.into(), g.into(), t.into()).map_err(|e| e.to_string())?;
    let fov = Fov::Vertical(field(case, "fovy")?);
    let lens = Perspective::new(fov, field(case, "aspect")?, field(case, "n")?, field(case, "f")?);
    let lens = lens.map_err(|e| e.to_string())?;
    Ok(camera.world_to_view().then_project(lens.view_to_clip(Convention::OPENGL)))
}

fn vanishes<S: Space>(ours: VanishingPoint<S>, out: &Value, at: &str) -> Check {
    let infinite = out["at_infinity"] == true;
    match ours {
        VanishingPoint::At { point, ahead } if !infinite => {
            let theirs = list(&out[at])?.iter().map(number).collect::<Result<Vec<_>, _>>()?;
            let place = <[f64; 3]>::from(point);
            close_all(at, &place[..theirs.len()], &theirs, 1e-11)?;
            match out.get("in_front") {
                Some(front) if *front != ahead => Err(format!("in_front is {ahead}")),
                _ => Ok(()),
            }
        }
        VanishingPoint::AtInfinity { direction } if infinite => {
            let [x, y] = numbers::<2>(&out["direction"])?;
            let cross = direction.x() * y - direction.y() * x;
            let size = direction.length() * (x * x + y * y).sqrt();
            close("direction, across", cross / size, 0.0, TOLERANCE)
        }
        other => Err(format!("is {other:?}")),
    }
}

fn normalisation(case: &Value, out: &Value) -> Check {
    let edge = |name| field(case, name);
    let (l, r, b, t, n, f) =
        (edge("l")?, edge("r")?, edge("b")?, edge("t")?, edge("n")?, edge("f")?);
    if text(case, "op")? == "frustum" {
        return judge(Frustum::new(l, r, b, t, n, f), out, |ours| skewed_frustum(ours, out));
    }
    let direction: Vector<View> = point(&case["dir"])?.into();
    let slant = Oblique::by_direction(direction, edge("z0")?);
    let prism = slant.and_then(|slant| Ok((slant, Orthographic::new(l, r, b, t, n, f)?)));
    judge(prism, out, |(slant, volume)| {
        let factors = slant.factors(volume, Convention::OPENGL);
        close_matrix("shear", factors.shear.raw(), matrix(&out["shear"])?, TOLERANCE)?;
        close_matrix("matrix", factors.view_to_clip().raw(), matrix(&out["matrix"])?, TOLERANCE)?;
        maps(factors.view_to_clip(), out, "clip", "ndc")
    })
}

fn skewed_frustum(ours: Frustum, out: &Value) -> Check {
    let factors = ours.factors(Convention::OPENGL);
    close_matrix("shear", factors.shear.raw(), matrix(&out["shear"])?, TOLERANCE)?;
    close_matrix("scale", factors.scale.raw(), matrix(&out["scale"])?, TOLERANCE)?;
    close_matrix("depth", factors.depth.raw(), matrix(&out["depth"])?, TOLERANCE)?;
    close_matrix("matrix", factors.view_to_clip().raw(), matrix(&out["matrix"])?, TOLERANCE)?;
    let unit = ours.view_to_canonical_frustum(Convention::OPENGL).ok_or("has no far plane")?;
    close_matrix("unit_slope_far_1", unit.raw(), matrix(&out["unit_slope_far_1"])?, TOLERANCE)?;
    for case in list(&out["maps"])? {
        let p = point(&case["p"])?.into();
        let sheared = factors.shear.point(p);
        close_all("sheared", &<[f64; 3]>::from(sheared), &point(&case["sheared"])?, TOLERANCE)?;
        let scaled = <[f64; 3]>::from(factors.scale.point(sheared));
        close_all("unit_slope", &scaled, &point(&case["unit_slope"])?, TOLERANCE)?;
        let far_1 = <[f64; 3]>::from(unit.point(p));
        close_all("far_at_minus_1", &far_1, &point(&case["far_at_minus_1"])?, TOLERANCE)?;
    }
    Ok(())
}

fn field_of_view(case: &Value, out: &Value) -> Check {
    match text(case, "op")? {
        "window_from_fov" => {
            let (theta, nx, ny) = (field(case, "theta")?, field(case, "nx")?, field(case, "ny")?);
            let (n, f) = (field(case, "n")?, field(case, "f")?);
            let window = chapter::window_from_fov(theta, nx, ny, n);
            judge(window, out, |w| {
                let edges = [w.left(), w.right(), w.bottom(), w.top()];
                let theirs =
                    [field(out, "l")?, field(out, "r")?, field(out, "b")?, field(out, "t")?];
                close_all("window", &edges, &theirs, TOLERANCE)?;
                let across =
                    opening_angle_of(w.left(), w.right(), -n).map_err(|e| e.to_string())?;
                close("theta_horizontal", across, field(out, "theta_horizontal")?, TOLERANCE)?;
                let [l, r, b, t] = edges;
                let per = chapter::m_per(l, r, b, t, n, f).map_err(|e| e.to_string())?;
                close_matrix("matrix_per", per.raw(), matrix(&out["matrix_per"])?, TOLERANCE)
            })
        }
        "fov_from_window" => {
            let theta = chapter::fov_from_window(field(case, "t")?, field(case, "n")?);
            judge(theta, out, |theta| close("theta", theta, field(out, "theta")?, TOLERANCE))
        }
        "fov_of_asymmetric" => {
            let theta = opening_angle_of(field(case, "b")?, field(case, "t")?, field(case, "n")?);
            judge(theta, out, |theta| close("theta", theta, field(out, "theta")?, TOLERANCE))
        }
        other => Err(format!("unknown op {other}")),
    }
}

fn depth_precision(case: &Value, out: &Value) -> Check {
    let (near, far) = (field(case, "near")?, field(case, "far")?);
    let distance = field(case, "distance")?;
    let forward = DepthCurve::perspective(near, far, Convention::WEBGPU);
    let both = forward.and_then(|forward| {
        Ok((forward, DepthCurve::perspective(near, far, Convention::WEBGPU.reversed())?))
    });
    judge(both, out, |(forward, reversed)| {
        let depth = |curve: DepthCurve| curve.depth(distance).ok_or("has no depth");
        close("depth_zero_one", depth(forward)?, field(out, "depth_zero_one")?, TOLERANCE)?;
        close("depth_reversed", depth(reversed)?, field(out, "depth_reversed")?, TOLERANCE)?;
        let (float, fixed) = (DepthFormat::Float32, DepthFormat::FixedPoint(24));
        step(forward, distance, float, out, "step_float32_zero_one")?;
        step(reversed, distance, float, out, "step_float32_reversed")?;
        step(forward, distance, fixed, out, "step_unorm24_estimate")
    })
}

/// Steps are small, so they are compared by their ratio.
fn step(curve: DepthCurve, distance: f64, format: DepthFormat, out: &Value, name: &str) -> Check {
    let ours = curve.resolution(distance, format).map_err(|e| e.to_string())?;
    close(name, ours / field(out, name)?, 1.0, 1e-9)
}
