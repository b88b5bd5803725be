//! Seeds for the fuzz targets: real and hostile files, in the format that each target reads.

use super::assets_folder;
use super::pack::PackedModel;
use crate::program::{cargo_command, run_command};
use crate::skip::report_skip;
use crate::workspace::{list_files, project_root};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

/// The maximum size of a model. Larger files are too slow to mutate.
const LARGEST_MODEL: usize = 200 << 10;
const LARGEST_STREAM: usize = 48 << 10;

/// Writes the seeds of a target into a folder and returns their number.
pub fn write_seeds(target: &str, folder: &Path) -> Result<usize, String> {
    let mut seeds = match target {
        "model" => model_seeds().into_iter().map(|model| model.file).collect(),
        "stl" | "obj" | "mtl" | "ply" => files_with_endings(&[target]),
        "threemf" => files_with_endings(&["3mf", "3MF"]),
        "meshopt" => model_seeds().iter().flat_map(meshopt_seeds).collect(),
        "draco" => model_seeds().iter().flat_map(draco_seeds).collect(),
        "image" | "background" => image_seeds(),
        "scene" => scene_seeds()?,
        "maths" | "raster" => number_seeds(),
        // All seeds of these targets are committed.
        _ => Vec::new(),
    };
    seeds.extend(committed_cases(target)?);
    let largest = if ["model", "stl", "obj", "mtl", "ply", "threemf"].contains(&target) {
        LARGEST_MODEL
    } else {
        LARGEST_STREAM
    };
    seeds.retain(|seed: &Vec<u8>| seed.len() <= largest);
    seeds.sort();
    seeds.dedup();
    for (number, seed) in seeds.iter().enumerate() {
        let path = folder.join(format!("{number:05}"));
        fs::write(&path, seed).map_err(|error| format!("{}: {error}", path.display()))?;
    }
    if target == "model" {
        let call = ["test", "--quiet", "--package", "alberti-tests", "--test", "hostile", "--"];
        run_command(cargo_command(&call).arg("--write").arg(folder))?;
    }
    fs::read_dir(folder).map(Iterator::count).map_err(|error| error.to_string())
}

/// Returns the cases in `tests/fuzz/corpus`.
fn committed_cases(target: &str) -> Result<Vec<Vec<u8>>, String> {
    let folder = project_root().join("tests/fuzz/corpus").join(target);
    let entries =
        fs::read_dir(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut paths: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    paths.sort();
    Ok(paths.iter().filter_map(|path| fs::read(path).ok()).collect())
}

/// Returns all files below a folder with one of these extensions, sorted.
fn files_below(folder: &Path, endings: &[&str]) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut paths: Vec<PathBuf> = fs::read_dir(folder)
        .into_iter()
        .flatten()
        .filter_map(|entry| Some(entry.ok()?.path()))
        .collect();
    paths.sort();
    for path in paths {
        let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        if path.is_dir() {
            found.extend(files_below(&path, endings));
        } else if endings.contains(&ending.as_str()) {
            found.push(path);
        }
    }
    found
}

/// Returns the paths of the shared assets, scene models and test data with these extensions.
fn asset_paths(endings: &[&str]) -> Vec<PathBuf> {
    let mut paths = files_below(&project_root().join("scenes"), endings);
    paths.extend(files_below(&project_root().join("crates/model/tests"), endings));
    match assets_folder() {
        Some(assets) => paths.extend(files_below(&assets, endings)),
        None => report_skip("shared assets as seeds", "they are missing"),
    }
    paths
}

fn model_seeds() -> Vec<PackedModel> {
    asset_paths(&["glb", "gltf"]).iter().filter_map(|path| PackedModel::read_model(path)).collect()
}

/// Returns the contents of the files from [`asset_paths`].
fn files_with_endings(endings: &[&str]) -> Vec<Vec<u8>> {
    asset_paths(endings).iter().filter_map(|path| fs::read(path).ok()).collect()
}

fn scene_seeds() -> Result<Vec<Vec<u8>>, String> {
    let paths = list_files(&project_root().join("scenes"), "ron")?;
    Ok(paths.iter().filter_map(|path| fs::read(path).ok()).collect())
}

/// Returns the compressed views of a model, as the target `meshopt` reads them.
fn meshopt_seeds(model: &PackedModel) -> Vec<Vec<u8>> {
    let views = model.json["bufferViews"].as_array().into_iter().flatten();
    let stream = |view: &Value| {
        let named = |name: &str| view["extensions"].get(name);
        let packed = named("EXT_meshopt_compression").or(named("KHR_meshopt_compression"))?;
        let filter = packed["filter"].as_str().unwrap_or("NONE");
        let kind = match (packed["mode"].as_str()?, filter) {
            ("ATTRIBUTES", "OCTAHEDRAL") => 1,
            ("ATTRIBUTES", "QUATERNION") => 2,
            ("ATTRIBUTES", "EXPONENTIAL") => 3,
            ("ATTRIBUTES", "COLOR") => 4,
            ("ATTRIBUTES", _) => 0,
            ("TRIANGLES", _) => 5,
            _ => 6,
        };
        let stride = packed["byteStride"].as_u64()?;
        let stride = if kind < 5 { stride / 4 } else { u64::from(stride == 4) };
        let [low, high, ..] = packed["count"].as_u64()?.to_le_bytes();
        let mut seed = vec![kind, stride as u8, low, high];
        seed.extend(model.view_bytes(packed)?);
        Some(seed)
    };
    views.filter_map(stream).collect()
}

/// Returns the compressed primitives of a model, as the target `draco` reads them.
fn draco_seeds(model: &PackedModel) -> Vec<Vec<u8>> {
    let meshes = model.json["meshes"].as_array().into_iter().flatten();
    let primitives = meshes.flat_map(|mesh| mesh["primitives"].as_array().into_iter().flatten());
    let count = |accessor: &Value| {
        model.json["accessors"].get(accessor.as_u64()? as usize)?["count"].as_u64()
    };
    let stream = |primitive: &Value| {
        let packed = primitive["extensions"].get("KHR_draco_mesh_compression")?;
        let number =
            |name: &str| packed["attributes"][name].as_u64().map_or(15, |n| n.min(15) as u8);
        let vertices = count(&primitive["attributes"]["POSITION"])?.to_le_bytes();
        let faces = (count(&primitive["indices"])? / 3).to_le_bytes();
        let ids = number("POSITION") | number("NORMAL") << 4;
        let more = number("TEXCOORD_0") | number("COLOR_0") << 4;
        let mut seed = vec![vertices[0], vertices[1], faces[0], faces[1], ids, more];
        let view = packed["bufferView"].as_u64()? as usize;
        seed.extend(model.view_bytes(model.json["bufferViews"].get(view)?)?);
        Some(seed)
    };
    primitives.filter_map(stream).collect()
}

/// Returns image files and images from models, each preceded by the number of its format.
fn image_seeds() -> Vec<Vec<u8>> {
    let kind = |file: &[u8]| match file {
        [0x89, b'P', ..] => 0,
        [0xFF, 0xD8, ..] => 1,
        [b'R', b'I', ..] => 2,
        [0xAB, b'K', ..] => 3,
        _ => 4,
    };
    let marked = |file: &[u8]| [&[kind(file)], file].concat();
    let files = asset_paths(&["png", "jpg", "jpeg", "webp", "ktx2"]);
    let mut seeds: Vec<Vec<u8>> =
        files.iter().filter_map(|path| Some(marked(&fs::read(path).ok()?))).collect();
    for model in model_seeds() {
        let images = model.json["images"].as_array().into_iter().flatten();
        let views = images.filter_map(|image| {
            model.json["bufferViews"].get(image["bufferView"].as_u64()? as usize)
        });
        seeds.extend(views.filter_map(|view| model.view_bytes(view)).map(marked));
    }
    seeds
}

/// Returns sequences of random bytes (SplitMix64), each preceded by the number of a function. There
/// are fewer than 512 functions.
fn number_seeds() -> Vec<Vec<u8>> {
    let mut state = 0u64;
    let mut word = || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)).to_le_bytes()
    };
    let seed = |number: u16| {
        let bytes: Vec<u8> = (0..40).flat_map(|_| word()).collect();
        [&number.to_le_bytes()[..], &bytes].concat()
    };
    (0..512).map(seed).collect()
}
