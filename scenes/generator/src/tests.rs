//! Invariants of every model, checked by a reader that shares no code with the writer.

use super::all_models;
use serde_json::Value;

/// The contents of a `.glb` file: its JSON and its binary chunk.
struct Glb {
    json: Value,
    binary: Vec<u8>,
}

fn parsed_models() -> Vec<(&'static str, Glb)> {
    all_models().unwrap().into_iter().map(|(name, bytes)| (name, parse_glb(&bytes))).collect()
}

fn parse_glb(bytes: &[u8]) -> Glb {
    let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
    assert_eq!((&bytes[..4], word(4), word(8)), (&b"glTF"[..], 2, bytes.len()));
    let json_length = word(12);
    assert_eq!(&bytes[16..20], b"JSON");
    let rest = 20 + json_length;
    assert_eq!((json_length % 4, &bytes[rest + 4..rest + 8]), (0, &b"BIN\0"[..]));
    let binary = bytes[rest + 8..].to_vec();
    assert_eq!(word(rest), binary.len());
    Glb { json: serde_json::from_slice(&bytes[20..rest]).unwrap(), binary }
}

impl Glb {
    /// Returns the values of an accessor, element by element.
    fn accessor_values(&self, accessor: &Value) -> Vec<f64> {
        let accessor = &self.json["accessors"][as_index(accessor)];
        let view = &self.json["bufferViews"][as_index(&accessor["bufferView"])];
        let (start, length) = (as_index(&view["byteOffset"]), as_index(&view["byteLength"]));
        let bytes = &self.binary[start..start + length];
        let numbers: Vec<f64> = match as_index(&accessor["componentType"]) {
            5123 => {
                bytes.chunks_exact(2).map(|b| f64::from(u16::from_le_bytes([b[0], b[1]]))).collect()
            }
            5126 => bytes
                .chunks_exact(4)
                .map(|b| f64::from(f32::from_le_bytes(b.try_into().unwrap())))
                .collect(),
            other => panic!("component type {other}"),
        };
        let width = match accessor["type"].as_str().unwrap() {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            _ => 4,
        };
        assert_eq!(numbers.len(), as_index(&accessor["count"]) * width);
        numbers
    }

    fn primitives(&self) -> impl Iterator<Item = &Value> {
        as_array(&self.json["meshes"]).iter().flat_map(|mesh| as_array(&mesh["primitives"]))
    }
}

fn as_index(value: &Value) -> usize {
    value.as_u64().unwrap() as usize
}

fn as_array(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

#[test]
fn attributes_are_finite_and_of_equal_length_and_indices_are_in_range() {
    for (name, glb) in parsed_models() {
        for primitive in glb.primitives() {
            let attributes = primitive["attributes"].as_object().unwrap();
            let count = |accessor| as_index(&glb.json["accessors"][as_index(accessor)]["count"]);
            let vertices = count(&attributes["POSITION"]);
            for accessor in attributes.values() {
                assert_eq!(count(accessor), vertices, "{name}");
                assert!(
                    glb.accessor_values(accessor).iter().all(|value| value.is_finite()),
                    "{name}"
                );
            }
            let Some(indices) = primitive.get("indices") else { continue };
            let indices = glb.accessor_values(indices);
            assert!(!indices.is_empty(), "{name}");
            assert!(indices.iter().all(|index| (*index as usize) < vertices), "{name}");
        }
    }
}

#[test]
fn position_bounds_are_exact() {
    for (name, glb) in parsed_models() {
        for primitive in glb.primitives() {
            let accessor = &primitive["attributes"]["POSITION"];
            let numbers = glb.accessor_values(accessor);
            for axis in 0..3 {
                let values = numbers.iter().skip(axis).step_by(3).copied();
                let stated = |key: &str| {
                    glb.json["accessors"][as_index(accessor)][key][axis].as_f64().unwrap()
                };
                let low = values.clone().fold(f64::INFINITY, f64::min);
                let high = values.fold(f64::NEG_INFINITY, f64::max);
                // The JSON parser may be off in the last bit of a double; as an f32, the value is
                // exact.
                assert_eq!(low as f32, stated("min") as f32, "{name}");
                assert_eq!(high as f32, stated("max") as f32, "{name}");
            }
        }
    }
}

#[test]
fn normals_have_unit_length() {
    for (name, glb) in parsed_models() {
        for accessor in
            glb.primitives().filter_map(|primitive| primitive["attributes"].get("NORMAL"))
        {
            for normal in glb.accessor_values(accessor).chunks_exact(3) {
                let length = normal.iter().map(|value| value * value).sum::<f64>();
                assert!((length - 1.0).abs() < 1e-6, "{name} {normal:?}");
            }
        }
    }
}

#[test]
fn triangles_face_in_the_direction_of_their_normals() {
    for (name, glb) in parsed_models() {
        for primitive in glb.primitives().filter(|primitive| primitive.get("mode").is_none()) {
            let [positions, normals] = ["POSITION", "NORMAL"]
                .map(|key| glb.accessor_values(&primitive["attributes"][key]));
            let at = |from: &[f64], i: f64| glam::DVec3::from_slice(&from[i as usize * 3..]);
            for face in glb.accessor_values(&primitive["indices"]).chunks_exact(3) {
                let [a, b, c] = [0, 1, 2].map(|corner| at(&positions, face[corner]));
                let mean = face.iter().fold(glam::DVec3::ZERO, |sum, &i| sum + at(&normals, i));
                assert!((b - a).cross(c - a).dot(mean) > 0.0, "{name} {a} {b} {c} {mean}");
            }
        }
    }
}

#[test]
fn every_model_is_small_and_every_node_has_a_name() {
    for (name, bytes) in all_models().unwrap() {
        assert!(bytes.len() <= super::MAX_BYTES, "{name} has {} bytes", bytes.len());
        let glb = parse_glb(&bytes);
        assert!(as_array(&glb.json["nodes"]).iter().all(|node| node["name"].is_string()), "{name}");
    }
}
