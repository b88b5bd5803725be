//! A corpus of small glTF files written by this code: ordinary, unusual and broken files, with the
//! expected outcome of each.
//!
//! The tests `corpus` and `check` use it in every clone. Its folder `models` contains valid files,
//! and `bad` contains broken files. For each file, the manifest lists the errors that the Khronos
//! glTF validator reports and the outcome of rendering.

mod broken;
mod containers;
mod valid;

use crate::gltf::Document;
use crate::manifest::{Row, format_manifest};
use serde_json::{Value, json};
use std::path::Path;

/// One model of the corpus, in a separate folder.
#[derive(Clone, Debug)]
pub struct Sample {
    row: Row,
    /// The file names and contents; `row` describes the first file.
    files: Vec<(String, Vec<u8>)>,
}

impl Sample {
    /// Creates a valid file that is drawn. `triangles` is the count in the manifest.
    fn valid(name: &str, file_name: &str, bytes: Vec<u8>, triangles: usize) -> Self {
        let row = Row {
            path: format!("models/{name}/{file_name}"),
            scene_triangles: Some(triangles),
            expected: Some("drawn".to_owned()),
            ..Row::default()
        };
        Self { row, files: vec![(file_name.to_owned(), bytes)] }
    }

    /// Creates a broken file. `errors` are the codes that a validator reports.
    fn broken(name: &str, file_name: &str, bytes: Vec<u8>, errors: &[&str]) -> Self {
        let row = Row {
            path: format!("bad/{name}/{file_name}"),
            validator_errors: errors.iter().map(|code| (*code).to_owned()).collect(),
            ..Row::default()
        };
        Self { row, files: vec![(file_name.to_owned(), bytes)] }
    }

    /// Adds a file that the model refers to by URI.
    fn beside(mut self, name: &str, bytes: Vec<u8>) -> Self {
        self.files.push((name.to_owned(), bytes));
        self
    }

    /// Sets a different rendering outcome: `drawn`, `blank`, or part of the reason for a rejection.
    fn expect(mut self, outcome: &str) -> Self {
        self.row.expected = Some(outcome.to_owned());
        self
    }
}

/// Returns all samples.
///
/// # Errors
/// Returns an error if a texture cannot be encoded.
pub fn all_samples() -> Result<Vec<Sample>, String> {
    let mut samples = valid::valid_samples();
    for (name, bytes) in scene_models::all_models()? {
        let mut sample = Sample::valid(&format!("scene {name}"), name, bytes, 0);
        sample.row.scene_triangles = None;
        samples.push(sample);
    }
    samples.extend(containers::container_samples());
    samples.extend(broken::broken_samples());
    Ok(samples)
}

/// Writes all samples and their `MANIFEST.tsv` to a folder, which is created if necessary.
///
/// # Errors
/// Returns an error that names the file if one cannot be written.
pub fn write_samples(folder: &Path) -> Result<(), String> {
    let samples = all_samples()?;
    for sample in &samples {
        let path = folder.join(&sample.row.path);
        let parent = path.parent().unwrap_or(folder);
        for (name, bytes) in &sample.files {
            let path = parent.join(name);
            let create = path.parent().map_or(Ok(()), std::fs::create_dir_all);
            create
                .and_then(|()| std::fs::write(&path, bytes))
                .map_err(|error| format!("{}: {error}", path.display()))?;
        }
    }
    let rows: Vec<Row> = samples.into_iter().map(|sample| sample.row).collect();
    let path = folder.join("MANIFEST.tsv");
    std::fs::write(&path, format_manifest(&rows)).map_err(|e| format!("{}: {e}", path.display()))
}

/// Returns a valid triangle with the bounds of its positions.
fn triangle() -> Document {
    Document::single_triangle()
        .with_value("/accessors/0/min", json!([0, 0, 0]))
        .with_value("/accessors/0/max", json!([1, 1, 0]))
}

/// Returns a valid quad of two triangles. Accessors 0 to 3 are positions, normals, texture
/// coordinates and indices.
fn quad() -> Document {
    let mut document = triangle();
    document.bytes.clear();
    document.json["accessors"] = json!([]);
    document.json["bufferViews"] = json!([]);
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let positions: Vec<f32> = corners.iter().flat_map(|&[x, y]| [x, y, 0.0]).collect();
    let uvs: Vec<f32> = corners.iter().flat_map(|&[x, y]| [x, 1.0 - y]).collect();
    add_floats(&mut document, "VEC3", &positions);
    add_floats(&mut document, "VEC3", &[0.0, 0.0, 1.0].repeat(4));
    add_floats(&mut document, "VEC2", &uvs);
    add_indices(&mut document, &[0, 1, 2, 0, 2, 3]);
    document.json["accessors"][0]["min"] = json!([0, 0, 0]);
    document.json["accessors"][0]["max"] = json!([1, 1, 0]);
    document.with_value(
        "/meshes/0/primitives/0",
        json!({"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3}),
    )
}

/// Returns a quad with a 2 × 2 base color texture and this material.
fn textured_quad(material: &Value) -> Document {
    let mut document = quad();
    let view = document.add_buffer_view(&crate::gltf::encode_png(2, 2));
    document.json["images"] = json!([{"bufferView": view, "mimeType": "image/png"}]);
    document.json["textures"] = json!([{"source": 0}]);
    quad_material(document, material)
}

/// Returns the document with a material on its first primitive, and lists the material's
/// extensions.
fn quad_material(mut document: Document, material: &Value) -> Document {
    if let Some(extensions) = material["extensions"].as_object() {
        let names: Vec<&String> = extensions.keys().collect();
        document.json["extensionsUsed"] = json!(names);
    }
    document.json["materials"] = json!([material]);
    document.with_value("/meshes/0/primitives/0/material", json!(0))
}

/// Adds an accessor of floats and returns its index.
fn add_floats(document: &mut Document, shape: &str, values: &[f32]) -> usize {
    let width = match shape {
        "SCALAR" => 1,
        "VEC2" => 2,
        "VEC3" => 3,
        "VEC4" => 4,
        _ => 16,
    };
    let accessor = json!({"componentType": 5126, "type": shape, "count": values.len() / width});
    document.add_accessor(&crate::gltf::float_bytes(values), accessor)
}

/// Adds an accessor of 16-bit indices and returns its index.
fn add_indices(document: &mut Document, indices: &[u16]) -> usize {
    let bytes: Vec<u8> = indices.iter().flat_map(|index| index.to_le_bytes()).collect();
    let accessor = json!({"componentType": 5123, "type": "SCALAR", "count": indices.len()});
    document.add_accessor(&bytes, accessor)
}

/// Adds times with their bounds, as required for an animation, and returns the accessor index.
fn add_times(document: &mut Document, times: &[f32]) -> usize {
    let index = add_floats(document, "SCALAR", times);
    document.json["accessors"][index]["min"] = json!([times.first()]);
    document.json["accessors"][index]["max"] = json!([times.last()]);
    index
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_sample_has_a_unique_path() {
        let samples = all_samples().unwrap();
        let paths: BTreeSet<&str> = samples.iter().map(|sample| &*sample.row.path).collect();
        assert_eq!(paths.len(), samples.len());
    }

    #[test]
    fn broken_samples_state_their_errors_and_valid_samples_have_none() {
        for sample in all_samples().unwrap() {
            let is_bad = sample.row.group() == "bad";
            assert_eq!(sample.row.validator_errors.is_empty(), !is_bad, "{}", sample.row.path);
        }
    }
}
