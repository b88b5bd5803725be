//! `alberti render --json`: the report on a rendered picture.
//!
//! New members may be added in any release; [`VERSION`] increases when a member is removed or
//! changes its meaning.
//!
//! ```json
//! {
//!   "schema": {"name": "alberti-render", "version": 1},
//!   "input": "fox.glb",
//!   "image": {"size": [960, 720], "region": [0, 0, 960, 720], "samples": 4, "bits": 8},
//!   "models": [{"name": "fox.glb", "triangles": 576, "lines": 0, "points": 0, "warnings": []}],
//!   "warnings": [], "comparison": null, "milliseconds": {"write": 1.07},
//!   "files": [{"path": "fox.png", "bytes": 81234, "sha256": "9f86d0…"}]
//! }
//! ```
//! For several pictures, several documents are printed one after the other.

use super::render_job::{RenderJob, RenderOutput};
use super::{CliError, print_json};
use batch::{ContentDigest, to_hexadecimal};
use homog::PixelRect;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::fs::File;
use std::path::Path;

/// The version of the JSON schema.
const VERSION: u32 = 1;

/// Prints the report on one picture.
///
/// `warnings` are about flags and the line drawing; each model has its own warnings. `milliseconds`
/// lists the stages in alphabetical order. `share_beyond` is the fraction of differing pixels, from
/// 0 to 1.
///
/// # Errors
/// Returns an error if a file cannot be read back, or if the report cannot be printed.
pub(super) fn print_report(
    job: &RenderJob<'_>,
    output: &RenderOutput,
    unused_flags: &[String],
) -> Result<(), CliError> {
    let PixelRect { x, y, width, height } = output.region;
    let scene = job.scene;
    let files: Result<Vec<Value>, CliError> =
        output.files.iter().map(|path| file_json(path)).collect();
    let comparison = output.comparison.map(|found| {
        json!({
            "agrees": found.agrees(),
            "greatest_difference": found.max_difference,
            "share_beyond": found.differing_fraction(),
            "tolerance": found.tolerance,
        })
    });
    let milliseconds = |(stage, took): (&'static str, std::time::Duration)| {
        (stage, json!(1e3 * took.as_secs_f64()))
    };
    let timings: BTreeMap<&str, Value> =
        job.timings.stages().into_iter().map(milliseconds).collect();
    let report = json!({
        "schema": {"name": "alberti-render", "version": VERSION},
        "input": job.task.input.to_string_lossy(),
        "image": {
            "size": [scene.image.width, scene.image.height],
            "region": [x, y, width, height],
            "samples": scene.image.samples.count(),
            "bits": if job.outputs.sixteen_bit { 16 } else { 8 },
        },
        "camera": camera_json(job),
        "models": models_json(job),
        "warnings": unused_flags
            .iter()
            .cloned()
            .chain(output.warnings.iter().map(ToString::to_string))
            .collect::<Vec<_>>(),
        "comparison": comparison,
        "milliseconds": timings,
        "files": files?,
    });
    print_json(&format!("{report:#}\n"))
}

/// Returns the eye and the view space axes in world space, and the projection matrix by rows.
///
/// `back` points from the scene to the eye: view space is right-handed, and the camera looks along
/// its negative third axis. The matrix is for column vectors.
fn camera_json(job: &RenderJob<'_>) -> Value {
    let view_projection = job.scene.view_projection;
    let camera = view_projection.camera;
    let rows = [0, 1, 2, 3].map(|n| view_projection.view_to_clip.raw().row(n).to_array());
    json!({
        "eye": <[f64; 3]>::from(camera.eye()),
        "right": camera.u().raw().to_array(),
        "up": camera.v().raw().to_array(),
        "back": camera.w().raw().to_array(),
        "view_to_clip": rows,
    })
}

/// Returns the model instances, with their primitive counts and warnings.
///
/// A model with several instances has one entry per instance, in the order of the scene. A mesh
/// counts once for every node that draws it.
fn models_json(job: &RenderJob<'_>) -> Vec<Value> {
    let model = |placed: &model::ModelInstance| {
        let model = &placed.model;
        let count = |topology| -> usize {
            let shown = model.scene_primitives().map(|(_, primitive)| primitive);
            shown.filter(|p| p.topology == topology).map(model::Primitive::item_count).sum()
        };
        let warnings = model.warnings.iter().map(|warning| {
            json!({"pointer": warning.location.to_string(), "message": warning.message.to_string()})
        });
        json!({
            "name": model.name,
            "triangles": count(model::Topology::Triangles),
            "lines": count(model::Topology::Lines),
            "points": count(model::Topology::Points),
            "warnings": warnings.collect::<Vec<_>>(),
        })
    };
    job.scene.models.iter().map(model).collect()
}

/// Returns the path of a file, its size, and the SHA-256 of its content.
///
/// The file is read back from the disk in blocks of 64 KiB, so the hash covers the bytes as
/// written, and large files need no more memory.
///
/// # Errors
/// Returns an error if the file cannot be read.
fn file_json(path: &Path) -> Result<Value, CliError> {
    let ContentDigest { bytes, sha256 } = ContentDigest::of_reader(&mut File::open(path)?)?;
    let sha256 = to_hexadecimal(&sha256);
    Ok(json!({"path": path.to_string_lossy(), "bytes": bytes, "sha256": sha256}))
}
