//! Runners for classical projections, vanishing points and normalization (MV-1 to VV-2).

use crate::vectors::Runner;
use crate::vectors::numbers::{
    TOLERANCE, assert_all_close, assert_close, assert_matrix_close, compare_outcome, number_field,
    parse_array, parse_matrix, parse_number, parse_numbers, parse_point, text_field,
};
use crate::vectors::projection::{CheckResult, check_mapped_points, divide_point};
use homog::{Clip, Normal, Plane, Point, Projective, Space, Vector, View};
use projection::{
    Axonometric, Convention, Fov, Frustum, NPoint, Oblique, Orthographic, Perspective,
    PrincipalPlane, Projector, VanishingPoint, principal_vanishing_points, vanishing_point,
};
use serde_json::Value;

/// The runners, one per file.
pub const RUNNERS: &[(&str, Runner)] = &[
    ("multiview_axonometric", check_axonometric),
    ("oblique", check_oblique),
    ("npoint", check_npoint),
    ("vanishing_points", check_vanishing_points),
    ("normalisation", check_normalization),
];

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

/// Checks that a direction and a plane give the same matrices.
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

/// Returns the images, or an error if a point has none.
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
        return Err(format!("has {} vanishing points, expected {count:?}", found.count()));
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
            (None, theirs) => return Err(format!("has no vanishing point, but expected {theirs}")),
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
