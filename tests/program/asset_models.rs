//! Real-world animated files, from `shared/assets` next to the project or from `$ASSETS`. At the
//! time of a keyframe, the pose must equal the keyframe's value in every interpolation mode, and
//! pictures at different times must differ. The tests are reported as skipped if the folder is
//! missing.

use crate::sandbox::Sandbox;
use alberti_tests::skip::report_skip;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// Returns the path of a model, or reports a skip and returns `None` if there are no assets.
pub(crate) fn asset_path(name: &str) -> Option<PathBuf> {
    let chosen = std::env::var_os("ASSETS").map(PathBuf::from);
    let beside = alberti_tests::project_root().join("../shared/assets");
    let folder = chosen.unwrap_or(beside).join("models");
    let path = folder.join(name);
    if !folder.is_dir() {
        report_skip(name, &format!("{} was not found", folder.display()));
        return None;
    }
    assert!(path.is_file(), "{} is missing", path.display());
    Some(path)
}

/// A glTF file with its first buffer.
struct Gltf {
    json: Value,
    bytes: Vec<u8>,
}

impl Gltf {
    fn read_file(path: &Path) -> Self {
        let all = std::fs::read(path).expect("the file");
        if let Some(rest) = all.strip_prefix(b"glTF") {
            let length = u32::from_le_bytes(rest[8..12].try_into().expect("four bytes")) as usize;
            let json = serde_json::from_slice(&all[20..20 + length]).expect("JSON");
            return Self { json, bytes: all[28 + length..].to_vec() };
        }
        let json: Value = serde_json::from_slice(&all).expect("JSON");
        let uri = json["buffers"][0]["uri"].as_str().expect("a separate file");
        let bytes = std::fs::read(path.with_file_name(uri)).expect("the buffer");
        Self { json, bytes }
    }

    /// Returns the values in an accessor of tightly packed floats.
    fn read_floats(&self, accessor: &Value) -> Vec<f64> {
        let json = &self.json["accessors"][accessor.as_u64().expect("a number") as usize];
        let view = &self.json["bufferViews"][json["bufferView"].as_u64().expect("a view") as usize];
        assert_eq!(json["componentType"], 5126, "floats");
        let offset = |of: &Value| of["byteOffset"].as_u64().unwrap_or(0) as usize;
        let widths = [("SCALAR", 1), ("VEC3", 3), ("VEC4", 4)];
        let width = widths.iter().find(|(shape, _)| json["type"] == *shape).expect("a shape").1;
        let count = json["count"].as_u64().expect("a number") as usize * width;
        let words = self.bytes[offset(view) + offset(json)..].as_chunks::<4>().0;
        words[..count].iter().map(|word| f64::from(f32::from_le_bytes(*word))).collect()
    }
}

/// Returns whether two lists of numbers are equal except for rounding. Rotations may also have the
/// opposite sign.
fn are_equal_values(actual: &[f64], expected: &[f64], rotation: bool) -> bool {
    let near = |sign: f64| actual.iter().zip(expected).all(|(a, b)| (a - sign * b).abs() < 1e-5);
    actual.len() == expected.len() && (near(1.0) || rotation && near(-1.0))
}

/// Compares the poses of an animation at three of its keyframes with the file, and checks that the
/// pictures differ.
fn check_animation(name: &str, path: &str, animation: usize) {
    let Some(path) = asset_path(path) else { return };
    let sandbox = Sandbox::new(&format!("real_{name}_{animation}"));
    let (gltf, file) = (Gltf::read_file(&path), path.to_string_lossy().into_owned());
    let json = &gltf.json["animations"][animation];
    let times = gltf.read_floats(&json["samplers"][0]["input"]);
    let number = animation.to_string();
    let mut pictures = Vec::new();
    for time in [times[0], times[times.len() / 3], times[times.len() * 2 / 3]] {
        let text = time.to_string();
        let pick = ["--animation", number.as_str(), "--time", text.as_str()];
        let run = sandbox.run(&[&["info", "--json", file.as_str()], &pick[..]].concat());
        assert_eq!(run.code, 0, "{}", run.stderr);
        let info: Value = serde_json::from_str(&run.stdout).expect("JSON");
        let checked = check_pose(&gltf, json, &info, time);
        assert!(checked > 0, "{name}: no channel has a keyframe at {time}");
        let size = ["--size", "96x72", "-o", "out.png"];
        let run = sandbox.run(&[&["render", file.as_str()], &pick[..], &size].concat());
        assert_eq!(run.code, 0, "{}", run.stderr);
        let pixels = sandbox.read_picture("out.png").2;
        assert!(pixels.iter().filter(|pixel| pixel[3] > 0).count() > 300, "{name} at {time}");
        pictures.push(pixels);
    }
    assert!(pictures[0] != pictures[1] || pictures[1] != pictures[2], "{name}: nothing moves");
}

/// Compares all channels that have a keyframe at this time; returns their number.
fn check_pose(gltf: &Gltf, json: &Value, info: &Value, time: f64) -> usize {
    let mut checked = 0;
    for channel in json["channels"].as_array().expect("channels") {
        let sampler = &json["samplers"][channel["sampler"].as_u64().expect("a number") as usize];
        let times = gltf.read_floats(&sampler["input"]);
        let Some(key) = times.iter().position(|&key| key == time) else { continue };
        let values = gltf.read_floats(&sampler["output"]);
        let cubic = sampler["interpolation"] == "CUBICSPLINE";
        let width = values.len() / times.len() / if cubic { 3 } else { 1 };
        let row = if cubic { 3 * key + 1 } else { key };
        let expected = &values[row * width..(row + 1) * width];
        let target = &channel["target"];
        let node = &info["nodes"][target["node"].as_u64().expect("a node") as usize];
        let path = target["path"].as_str().expect("a path");
        let actual = if path == "weights" { &node["weights"] } else { &node["transform"][path] };
        let found: Vec<f64> =
            actual.as_array().expect("numbers").iter().filter_map(Value::as_f64).collect();
        assert!(
            are_equal_values(&found, expected, path == "rotation"),
            "{channel} at {time}: expected {expected:?}, found {found:?}"
        );
        checked += 1;
    }
    checked
}

#[test]
fn cesium_man_walks() {
    check_animation("cesium-man", "cesium-man/CesiumMan.gltf", 0);
}

#[test]
fn nine_cubes_move_in_nine_ways() {
    for animation in 0..9 {
        check_animation(
            "interpolation-test",
            "interpolation-test/InterpolationTest.gltf",
            animation,
        );
    }
}

#[test]
fn eight_bars_grow_with_morph_targets() {
    for animation in 0..3 {
        check_animation("morph-stress-test", "morph-stress-test/MorphStressTest.gltf", animation);
    }
}

#[test]
fn a_skinned_cylinder_bends() {
    check_animation("skinned-cylinder", "blender-skinned-cylinder/03_skinned_cylinder.gltf", 0);
}

#[test]
fn a_skinned_skater_compressed_with_draco_is_upright() {
    let Some(path) = asset_path("skater-female-draco/model.gltf") else { return };
    let (sandbox, file) = (Sandbox::new("real_skater"), path.to_string_lossy().into_owned());
    let run = sandbox.run(&["info", "--json", file.as_str()]);
    let info: Value = serde_json::from_str(&run.stdout).expect("JSON");
    // The skater has no animation. With her arms out, she is about as wide as she is high, and her
    // feet are on the ground.
    let corner =
        |end: &str, axis: usize| info["shown"]["bounds"][end][axis].as_f64().expect("a number");
    let size = |axis| corner("max", axis) - corner("min", axis);
    assert!(corner("min", 1).abs() < 0.05 * size(1), "{}", info["shown"]["bounds"]);
    assert!((0.7..1.3).contains(&(size(0) / size(1))), "{}", info["shown"]["bounds"]);
    assert_eq!(info["skins"][0]["joints"].as_array().map(Vec::is_empty), Some(false));
}
