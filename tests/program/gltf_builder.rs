//! Small glTF files, built in code.

use crate::sandbox::Sandbox;
use serde_json::{Value, json};

/// A glTF document with the bytes of its only buffer.
pub(crate) struct GltfBuilder {
    pub(crate) json: Value,
    bytes: Vec<u8>,
}

impl GltfBuilder {
    /// Returns a square from (−1, −1, 0) to (1, 1, 0) that faces +z, with a red unlit material;
    /// node 0 shows it.
    pub(crate) fn square() -> Self {
        let mut document = Self {
            json: json!({
                "asset": {"version": "2.0"},
                "scene": 0,
                "scenes": [{"nodes": [0], "name": "first"}],
                "nodes": [{"mesh": 0}],
                "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 6, "material": 0}]}],
                "materials": [],
                "accessors": [], "bufferViews": [], "buffers": [{"byteLength": 0}]
            }),
            bytes: Vec::new(),
        };
        document
            .add_floats("VEC3", &[-1.0, -1.0, 0.0, 1.0, -1.0, 0.0, 1.0, 1.0, 0.0, -1.0, 1.0, 0.0]);
        document.add_unlit_material([1.0, 0.0, 0.0]);
        document
    }

    /// Adds an accessor with these floats and returns its index.
    pub(crate) fn add_floats(&mut self, shape: &str, values: &[f32]) -> usize {
        let width = match shape {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            _ => 4,
        };
        let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        self.add_accessor(
            &bytes,
            &json!({"componentType": 5126, "type": shape, "count": values.len() / width}),
        )
    }

    /// Adds an accessor with these bytes and returns its index.
    pub(crate) fn add_accessor(&mut self, bytes: &[u8], json: &Value) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let view = json!({"buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len()});
        self.bytes.extend(bytes);
        self.json["buffers"][0]["byteLength"] = json!(self.bytes.len());
        let mut json = json.clone();
        json["bufferView"] = json!(self.push_item("/bufferViews", view));
        self.push_item("/accessors", json)
    }

    /// Adds a material of one color and returns its index.
    pub(crate) fn add_unlit_material(&mut self, [r, g, b]: [f32; 3]) -> usize {
        let factor = json!({"baseColorFactor": [r, g, b, 1.0]});
        self.push_item(
            "/materials",
            json!({"pbrMetallicRoughness": factor, "extensions": {"KHR_materials_unlit": {}}}),
        )
    }

    /// Appends to the array at a JSON pointer; returns the index.
    pub(crate) fn push_item(&mut self, pointer: &str, value: Value) -> usize {
        let list = self.json.pointer_mut(pointer).and_then(Value::as_array_mut).expect("a list");
        list.push(value);
        list.len() - 1
    }

    /// Writes `NAME.gltf` and `NAME.bin` to a sandbox.
    pub(crate) fn write_file(&mut self, sandbox: &Sandbox, name: &str) {
        self.json["buffers"][0]["uri"] = json!(format!("{name}.bin"));
        sandbox.write_file(&format!("{name}.bin"), &self.bytes);
        sandbox.write_file(&format!("{name}.gltf"), self.json.to_string());
    }
}
