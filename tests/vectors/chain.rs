//! The chain from the world to the screen and back: CA-1, CA-2, PL-1, UN-1, UN-2.

use crate::Runner;
use crate::explained::explained;
use crate::numbers::{TOLERANCE, close, close_all, close_matrix, field, judge, matrix, numbers};
use crate::numbers::{pairs, point, point4, text};
use crate::projection::build;
use crate::windows::whole_image;
use camera::{Camera, CameraError};
use clip::Volume;
use homog::{Clip, HPoint, Point, Projective, View, World};
use serde_json::Value;
use viewport::Viewport;

/// One per file.
pub const RUNNERS: &[(&str, Runner)] = &[
    ("lookat", lookat),
    ("pipeline_points", pipeline_points),
    ("unproject", unproject),
    ("pick_rays", pick_rays),
];

/// Screen positions may be off by this part of the image's size.
const SCREEN: f64 = 1e-11;
/// Unprojected points have been through an inverse.
const UNPROJECTED: f64 = 1e-9;

pub fn camera(case: &Value) -> Result<Result<Camera, CameraError>, String> {
    let (eye, gaze, up) = (point(&case["e"])?, point(&case["g"])?, point(&case["t"])?);
    Ok(Camera::look_to(eye.into(), gaze.into(), up.into()))
}

pub fn lookat(case: &Value, out: &Value) -> Result<(), String> {
    judge(camera(case)?, out, |camera| {
        for (name, ours) in [("u", camera.u()), ("v", camera.v()), ("w", camera.w())] {
            close_all(name, &<[f64; 3]>::from(ours), &point(&out[name])?, TOLERANCE)?;
        }
        let theirs = matrix(&out["matrix"])?;
        close_matrix("matrix", camera.world_to_view().raw(), theirs, TOLERANCE)
    })
}

/// Camera, projection and viewport of a case, with the inverses in closed form.
struct Chain {
    camera: Camera,
    view_to_clip: Projective<View, Clip>,
    clip_to_view: Projective<Clip, View>,
    viewport: Viewport,
    kind: Kind,
}

/// What the rest of the chain must know of the projection.
struct Kind {
    volume: Volume,
    near_far: [f64; 2],
    /// −1 for M_per, whose visible points have w < 0.
    sign: f64,
}

impl Chain {
    fn of(case: &Value) -> Result<Self, String> {
        let mut parameters = case["projection"].clone();
        parameters["builder"] = parameters["kind"].clone();
        let (forth, back) = build(&parameters)?.map_err(|error| error.to_string())?;
        Ok(Self {
            camera: camera(&case["camera"])?.map_err(|error| error.to_string())?,
            view_to_clip: Projective::from_raw(forth),
            clip_to_view: Projective::from_raw(back),
            viewport: whole_image(&case["viewport"])?.map_err(|error| error.to_string())?,
            kind: kind(text(&case["projection"], "kind")?),
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

fn kind(name: &str) -> Kind {
    let (volume, near_far) = match name {
        "per" | "orth" => (Volume::CHAPTER, [1.0, -1.0]),
        name if name.contains("_zo_rev") => (Volume::ZERO_ONE_REVERSED, [1.0, 0.0]),
        name if name.contains("_zo") => (Volume::ZERO_ONE, [0.0, 1.0]),
        _ => (Volume::OPENGL, [-1.0, 1.0]),
    };
    Kind { volume, near_far, sign: if name == "per" { -1.0 } else { 1.0 } }
}

fn pipeline_points(case: &Value, out: &Value) -> Result<(), String> {
    judge(Chain::of(case), out, |chain| points_through(&chain, case, out))
}

fn points_through(chain: &Chain, case: &Value, out: &Value) -> Result<(), String> {
    let whole = chain.viewport.source_to_screen(chain.world_to_clip());
    let theirs = matrix(&out["matrix"])?;
    let size = theirs.to_cols_array().into_iter().fold(1.0, |size: f64, x| size.max(x.abs()));
    close_matrix("matrix / its size", whole.raw() * (1.0 / size), theirs * (1.0 / size), 1e-13)?;
    for (p, theirs) in pairs(&case["points"], &out["points"])? {
        let world = point(p)?.into();
        one_point(chain, world, theirs)?;
        if matches!(text(&case["projection"], "kind")?, "per" | "orth") {
            let view_projection = (chain.camera, chain.view_to_clip.raw(), chain.kind.sign);
            explained(view_projection, &chain.viewport, world, theirs)?;
        }
    }
    Ok(())
}

fn one_point(chain: &Chain, world: Point<World>, out: &Value) -> Result<(), String> {
    let view = chain.camera.world_to_view().point(world);
    close("distance", -view.z(), field(out, "distance")?, 1e-11)?;
    let clip = chain.world_to_clip().point(world);
    close_all("clip", &<[f64; 4]>::from(clip), &point4(&out["clip"])?, 1e-11)?;
    let upright = HPoint::from_raw(clip.raw() * chain.kind.sign);
    let inside = chain.kind.volume.contains(upright);
    if Some(inside) != out["inside"].as_bool() {
        return Err(format!("inside is {inside}, not {}", out["inside"]));
    }
    if out["ndc"].is_null() {
        return Ok(());
    }
    let ndc = clip.divide().ok_or("w is 0")?;
    close_all("ndc", &<[f64; 3]>::from(ndc), &point(&out["ndc"])?, 1e-11)?;
    let screen = chain.viewport.ndc_to_screen().point(ndc);
    let [x, y, depth] = point(&out["screen"])?;
    let size = chain.image_size();
    close("screen x / size", screen.x() / size, x / size, SCREEN)?;
    close("screen y / size", screen.y() / size, y / size, SCREEN)?;
    close("depth", screen.z(), depth, SCREEN)
}

fn unproject(case: &Value, out: &Value) -> Result<(), String> {
    judge(Chain::of(case), out, |chain| points_back(&chain, case, out))
}

fn points_back(chain: &Chain, case: &Value, out: &Value) -> Result<(), String> {
    let back = chain.viewport.unprojector(chain.clip_to_world());
    let ours = back.screen_to_source().raw();
    close_matrix("inverse", ours, matrix(&out["inverse"])?, UNPROJECTED)?;
    let by_elimination = chain.world_to_clip().inverse().ok_or("the chain is singular")?;
    let again = chain.viewport.unprojector(by_elimination);
    for (screen, theirs) in pairs(&case["screen"], &out["world"])? {
        let (screen, theirs) = (point(screen)?.into(), point(theirs)?);
        for (name, back) in [("closed form", back), ("elimination", again)] {
            let world = back.point(screen).ok_or("the point is at infinity")?;
            close_all(name, &<[f64; 3]>::from(world), &theirs, UNPROJECTED)?;
        }
    }
    Ok(())
}

fn pick_rays(case: &Value, out: &Value) -> Result<(), String> {
    judge(Chain::of(case), out, |chain| rays(&chain, case, out))
}

fn rays(chain: &Chain, case: &Value, out: &Value) -> Result<(), String> {
    let back = chain.viewport.unprojector(chain.clip_to_world());
    for (pixel, theirs) in pairs(&case["pixels"], &out["rays"])? {
        let ray = back.ray(numbers(pixel)?, chain.kind.near_far).ok_or("there is no ray")?;
        let far = ray.far.divide().ok_or("the far point is at infinity")?;
        let points = [("near_point", ray.near), ("far_point", far), ("origin", ray.origin)];
        for (name, ours) in points {
            close_all(name, &<[f64; 3]>::from(ours), &point(&theirs[name])?, UNPROJECTED)?;
        }
        let direction = <[f64; 3]>::from(ray.direction);
        close_all("direction", &direction, &point(&theirs["direction"])?, UNPROJECTED)?;
    }
    Ok(())
}
