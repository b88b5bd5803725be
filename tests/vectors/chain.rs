//! Runners for the chain from the world to the screen and back (CA-1, CA-2, PL-1, UN-1, UN-2).

use crate::vectors::Runner;
use crate::vectors::explained::check_explained;
use crate::vectors::numbers::{
    TOLERANCE, assert_all_close, assert_close, assert_matrix_close, compare_outcome, number_field,
    parse_matrix, parse_numbers,
};
use crate::vectors::numbers::{parse_point, parse_point4, text_field, zip_arrays};
use crate::vectors::projection::build_projection;
use crate::vectors::windows::full_image_viewport;
use camera::{Camera, CameraError};
use clip::Volume;
use homog::{Clip, ClipRange, HPoint, Point, Projective, View, World};
use serde_json::Value;
use viewport::Viewport;

/// The runners, one per file.
pub const RUNNERS: &[(&str, Runner)] = &[
    ("lookat", check_lookat),
    ("pipeline_points", check_pipeline_points),
    ("unproject", check_unproject),
    ("pick_rays", check_pick_rays),
];

/// The tolerance for screen positions, as a fraction of the image size.
const SCREEN_TOLERANCE: f64 = 1e-11;
/// The tolerance for unprojected points, which depend on an inverse.
const UNPROJECTED_TOLERANCE: f64 = 1e-9;

pub fn parse_camera(case: &Value) -> Result<Result<Camera, CameraError>, String> {
    let (eye, gaze, up) =
        (parse_point(&case["e"])?, parse_point(&case["g"])?, parse_point(&case["t"])?);
    Ok(Camera::look_to(eye.into(), gaze.into(), up.into()))
}

pub fn check_lookat(case: &Value, out: &Value) -> Result<(), String> {
    compare_outcome(parse_camera(case)?, out, |camera| {
        for (name, ours) in [("u", camera.u()), ("v", camera.v()), ("w", camera.w())] {
            assert_all_close(name, &<[f64; 3]>::from(ours), &parse_point(&out[name])?, TOLERANCE)?;
        }
        let theirs = parse_matrix(&out["matrix"])?;
        assert_matrix_close("matrix", camera.world_to_view().raw(), theirs, TOLERANCE)
    })
}

/// The camera, projection and viewport of a case, with closed-form inverses.
struct ViewChain {
    camera: Camera,
    view_to_clip: Projective<View, Clip>,
    clip_to_view: Projective<Clip, View>,
    viewport: Viewport,
    kind: ProjectionKind,
}

/// The properties of the projection that the rest of the chain needs.
struct ProjectionKind {
    volume: Volume,
    range: ClipRange,
    /// The sign of w at visible points, which is −1 for M_per.
    sign: f64,
}

impl ViewChain {
    fn from_case(case: &Value) -> Result<Self, String> {
        let mut parameters = case["projection"].clone();
        parameters["builder"] = parameters["kind"].clone();
        let (forth, back) = build_projection(&parameters)?.map_err(|error| error.to_string())?;
        let kind = projection_kind(text_field(&case["projection"], "kind")?);
        let viewport = full_image_viewport(&case["viewport"])?;
        Ok(Self {
            camera: parse_camera(&case["camera"])?.map_err(|error| error.to_string())?,
            view_to_clip: Projective::from_raw(forth),
            clip_to_view: Projective::from_raw(back),
            viewport: viewport.map_err(|error| error.to_string())?.with_range(kind.range),
            kind,
        })
    }

    fn world_to_clip(&self) -> Projective<World, Clip> {
        self.camera.world_to_view().then_project(self.view_to_clip)
    }

    fn clip_to_world(&self) -> Projective<Clip, World> {
        self.clip_to_view.then(self.camera.view_to_world())
    }

    fn image_size(&self) -> f64 {
        self.viewport.area().width().max(self.viewport.area().height())
    }
}

fn projection_kind(name: &str) -> ProjectionKind {
    let range = match name {
        "per" | "orth" => ClipRange::CHAPTER,
        name if name.contains("_zo_rev") => ClipRange::ZERO_ONE.reversed(),
        name if name.contains("_zo") => ClipRange::ZERO_ONE,
        _ => ClipRange::OPENGL,
    };
    let sign = if name == "per" { -1.0 } else { 1.0 };
    ProjectionKind { volume: Volume::for_range(range), range, sign }
}

fn check_pipeline_points(case: &Value, out: &Value) -> Result<(), String> {
    compare_outcome(ViewChain::from_case(case), out, |chain| {
        check_projected_points(&chain, case, out)
    })
}

fn check_projected_points(chain: &ViewChain, case: &Value, out: &Value) -> Result<(), String> {
    let whole = chain.viewport.source_to_screen(chain.world_to_clip());
    let theirs = parse_matrix(&out["matrix"])?;
    let size = theirs.to_cols_array().into_iter().fold(1.0, |size: f64, x| size.max(x.abs()));
    assert_matrix_close(
        "matrix / its size",
        whole.raw() * (1.0 / size),
        theirs * (1.0 / size),
        1e-13,
    )?;
    for (p, theirs) in zip_arrays(&case["points"], &out["points"])? {
        let world = parse_point(p)?.into();
        check_projected_point(chain, world, theirs)?;
        if matches!(text_field(&case["projection"], "kind")?, "per" | "orth") {
            let view_projection = (chain.camera, chain.view_to_clip.raw(), chain.kind.sign);
            check_explained(view_projection, &chain.viewport, world, theirs)?;
        }
    }
    Ok(())
}

fn check_projected_point(
    chain: &ViewChain,
    world: Point<World>,
    out: &Value,
) -> Result<(), String> {
    let view = chain.camera.world_to_view().transform_point(world);
    assert_close("distance", -view.z(), number_field(out, "distance")?, 1e-11)?;
    let clip = chain.world_to_clip().transform_point(world);
    assert_all_close("clip", &<[f64; 4]>::from(clip), &parse_point4(&out["clip"])?, 1e-11)?;
    let signed = HPoint::from_raw(clip.raw() * chain.kind.sign);
    let inside = chain.kind.volume.contains(signed);
    if Some(inside) != out["inside"].as_bool() {
        return Err(format!("inside is {inside}, not {}", out["inside"]));
    }
    if out["ndc"].is_null() {
        return Ok(());
    }
    let ndc = clip.divide().ok_or("w is 0")?;
    assert_all_close("ndc", &<[f64; 3]>::from(ndc), &parse_point(&out["ndc"])?, 1e-11)?;
    let screen = chain.viewport.ndc_to_screen().transform_point(ndc);
    let [x, y, depth] = parse_point(&out["screen"])?;
    let size = chain.image_size();
    assert_close("screen x / size", screen.x() / size, x / size, SCREEN_TOLERANCE)?;
    assert_close("screen y / size", screen.y() / size, y / size, SCREEN_TOLERANCE)?;
    assert_close("depth", screen.z(), depth, SCREEN_TOLERANCE)
}

fn check_unproject(case: &Value, out: &Value) -> Result<(), String> {
    compare_outcome(ViewChain::from_case(case), out, |chain| {
        check_unprojected_points(&chain, case, out)
    })
}

fn check_unprojected_points(chain: &ViewChain, case: &Value, out: &Value) -> Result<(), String> {
    let back = chain.viewport.unprojector(chain.clip_to_world());
    let ours = back.screen_to_source().raw();
    assert_matrix_close("inverse", ours, parse_matrix(&out["inverse"])?, UNPROJECTED_TOLERANCE)?;
    let by_elimination = chain.world_to_clip().inverse().ok_or("the chain is singular")?;
    let again = chain.viewport.unprojector(by_elimination);
    for (screen, theirs) in zip_arrays(&case["screen"], &out["world"])? {
        let (screen, theirs) = (parse_point(screen)?.into(), parse_point(theirs)?);
        for (name, back) in [("closed form", back), ("elimination", again)] {
            let world = back.unproject_point(screen).ok_or("the point is at infinity")?;
            assert_all_close(name, &<[f64; 3]>::from(world), &theirs, UNPROJECTED_TOLERANCE)?;
        }
    }
    Ok(())
}

fn check_pick_rays(case: &Value, out: &Value) -> Result<(), String> {
    compare_outcome(ViewChain::from_case(case), out, |chain| check_rays(&chain, case, out))
}

fn check_rays(chain: &ViewChain, case: &Value, out: &Value) -> Result<(), String> {
    let back = chain.viewport.unprojector(chain.clip_to_world());
    for (pixel, theirs) in zip_arrays(&case["pixels"], &out["rays"])? {
        let pick = back.pick_ray(parse_numbers(pixel)?).ok_or("there is no ray")?;
        let far = pick.far.divide().ok_or("the far point is at infinity")?;
        let points = [("near_point", pick.near), ("far_point", far), ("origin", pick.ray.origin)];
        for (name, ours) in points {
            assert_all_close(
                name,
                &<[f64; 3]>::from(ours),
                &parse_point(&theirs[name])?,
                UNPROJECTED_TOLERANCE,
            )?;
        }
        let direction = <[f64; 3]>::from(pick.ray.direction);
        assert_all_close(
            "direction",
            &direction,
            &parse_point(&theirs["direction"])?,
            UNPROJECTED_TOLERANCE,
        )?;
    }
    Ok(())
}
