//! The test models: 300 good models, three broken models, one that takes minutes, and one that
//! needs 8 GB.

use crate::cluster::slurm::{create_folder, write_file};
use alberti_tests::gltf::{Document, float_bytes};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::Path;

/// The number of models that can be drawn.
const GOOD: usize = 300;
/// The number of vertices around a torus and around its tube.
const RINGS: u16 = 48;
const SIDES: u16 = 24;
/// The number of translucent layers in the model that takes minutes.
const LAYERS: usize = 8_000;
/// The number of points in the model that needs a lot of memory, at 12 bytes per point.
const POINTS: usize = 700_000_000;

/// The jobs, by picture name.
pub struct Jobs {
    /// The jobs that can be drawn.
    pub good: Vec<String>,
    /// The jobs that fail, with part of the message.
    pub bad: BTreeMap<String, &'static str>,
}

/// Writes the models and `jobs.jsonl` into a folder. The bad models are spread among the good ones.
pub fn write_models(folder: &Path) -> Result<Jobs, String> {
    let models = folder.join("models");
    create_folder(&models)?;
    let mut lines: Vec<Value> = Vec::new();
    let mut jobs = Jobs { good: Vec::new(), bad: BTreeMap::new() };
    let mut bad = bad_models().into_iter();
    for number in 0..GOOD {
        let name = format!("torus-{number:03}");
        write_bytes(&models.join(format!("{name}.glb")), &torus(number).to_glb())?;
        lines.push(job_line(&format!("{name}.glb"), &name));
        jobs.good.push(format!("{name}.png"));
        if number % 50 == 25
            && let Some(BadModel { name, content, reason, flags }) = bad.next()
        {
            write_bytes(&models.join(name), &content)?;
            let stem = name.split('.').next().unwrap_or(name);
            let mut line = job_line(name, stem);
            for (flag, value) in flags {
                line[*flag] = json!(value);
            }
            lines.push(line);
            jobs.bad.insert(format!("{stem}.png"), reason);
        }
    }
    let text: String = lines.iter().map(|line| format!("{line}\n")).collect();
    write_file(&folder.join("jobs.jsonl"), &text)?;
    Ok(jobs)
}

/// Returns a line of the list; paths are relative to its folder.
fn job_line(file: &str, stem: &str) -> Value {
    json!({"input": format!("models/{file}"), "output": format!("{stem}.png")})
}

fn write_bytes(path: &Path, bytes: &[u8]) -> Result<(), String> {
    std::fs::write(path, bytes).map_err(|error| format!("{}: {error}", path.display()))
}

/// A model that fails.
struct BadModel {
    name: &'static str,
    content: Vec<u8>,
    /// Part of the message in the job's record.
    reason: &'static str,
    /// Additional members of the job's line.
    flags: &'static [(&'static str, &'static str)],
}

/// Returns the five models that fail.
fn bad_models() -> [BadModel; 5] {
    let mut cut = torus(0).to_glb();
    cut.truncate(cut.len() / 2);
    let broken = |name, content, reason| BadModel { name, content, reason, flags: &[] };
    [
        broken("cut-off.glb", cut, ""),
        broken("spins.glb", layers().to_glb(), "--job-seconds"),
        broken("no-model.gltf", b"{\"asset\": ".to_vec(), ""),
        BadModel {
            name: "wants-memory.glb",
            content: points().to_glb(),
            reason: "array_bytes",
            // These limits are raised, as for trusted files; the limit that follows from
            // --job-memory remains.
            flags: &[
                ("max-array-bytes", "16GiB"),
                ("max-array-growth", "1G"),
                ("max-scene-items", "1G"),
            ],
        },
        broken(
            "out-of-bounds.glb",
            torus(1).with_value("/accessors/2/count", json!(100_000)).to_glb(),
            "",
        ),
    ]
}

/// Returns a bumpy torus with a unique shape and color.
fn torus(number: usize) -> Document {
    let mut document = Document::single_triangle();
    let (lobes, tube) = ((number % 7) as f64, 0.25 + 0.02 * (number % 11) as f64);
    let mut positions: Vec<f32> = Vec::new();
    for ring in 0..RINGS {
        let around = f64::from(ring) / f64::from(RINGS) * std::f64::consts::TAU;
        for side in 0..SIDES {
            let angle = f64::from(side) / f64::from(SIDES) * std::f64::consts::TAU;
            let bump = tube * (1.0 + 0.2 * libm::cos(lobes * around + 3.0 * angle));
            let radius = 1.0 + bump * libm::cos(angle);
            let point =
                [radius * libm::cos(around), bump * libm::sin(angle), radius * libm::sin(around)];
            positions.extend(point.map(|value| value as f32));
        }
    }
    let vertex = |ring: u16, side: u16| (ring % RINGS) * SIDES + side % SIDES;
    let quads = (0..RINGS).flat_map(|ring| (0..SIDES).map(move |side| (ring, side)));
    let indices = quads.flat_map(|(ring, side)| {
        let (a, b) = (vertex(ring, side), vertex(ring, side + 1));
        let (c, d) = (vertex(ring + 1, side), vertex(ring + 1, side + 1));
        [a, b, c, c, b, d]
    });
    let bytes: Vec<u8> = indices.flat_map(u16::to_le_bytes).collect();
    let position = json!({"componentType": 5126, "type": "VEC3", "count": positions.len() / 3});
    let position = document.add_accessor(&float_bytes(&positions), position);
    let index = json!({"componentType": 5123, "type": "SCALAR", "count": bytes.len() / 2});
    let index = document.add_accessor(&bytes, index);
    let color = |step: usize| ((number * step) % 17) as f64 / 17.0;
    document.json["materials"] = json!([{"doubleSided": true, "pbrMetallicRoughness":
        {"baseColorFactor": [color(3), color(5), color(7), 1], "metallicFactor": color(2), "roughnessFactor": 0.4}}]);
    document.json["meshes"][0]["primitives"][0] =
        json!({"attributes": {"POSITION": position}, "indices": index, "material": 0});
    document
}

/// Creates thousands of translucent triangles, one behind another, each of which is shaded at every
/// pixel.
fn layers() -> Document {
    let mut document = Document::single_triangle();
    let layer = |at: usize| json!({"mesh": 0, "translation": [0, 0, at as f64 / LAYERS as f64]});
    document.json["nodes"] = (0..LAYERS).map(layer).collect();
    document.json["scenes"][0]["nodes"] = (0..LAYERS).collect();
    document.json["materials"] = json!([{"alphaMode": "BLEND", "doubleSided": true,
        "pbrMetallicRoughness": {"baseColorFactor": [1, 0.5, 0.25, 0.01]}}]);
    document.json["meshes"][0]["primitives"][0]["material"] = json!(0);
    document
}

/// Returns a point cloud in a few bytes, using a sparse accessor in which all values but one are
/// zero.
fn points() -> Document {
    let mut document = Document::single_triangle();
    let at = document.add_buffer_view(&7_u32.to_le_bytes());
    let value = document.add_buffer_view(&float_bytes(&[1.0; 3]));
    document.json["accessors"][0] = json!({"componentType": 5126, "type": "VEC3", "count": POINTS,
        "min": [0, 0, 0], "max": [1, 1, 1], "sparse": {"count": 1,
            "indices": {"bufferView": at, "componentType": 5125}, "values": {"bufferView": value}}});
    document.json["meshes"][0]["primitives"][0] = json!({"mode": 0, "attributes": {"POSITION": 0}});
    document
}
