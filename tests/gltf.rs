//! Small glTF documents for tests: JSON and one buffer. Tests may change both freely.

#![allow(clippy::missing_panics_doc, reason = "a test that misuses its own document should stop")]

use scene_models::glb::encode_glb;
use serde_json::{Value, json};

/// A glTF document and the bytes of its only buffer.
#[derive(Clone, Debug)]
pub struct Document {
    /// The document as written, valid or not.
    pub json: Value,
    /// Buffer 0, stored in the binary chunk.
    pub bytes: Vec<u8>,
}

impl Document {
    /// Returns one indexed triangle. Accessor 0 holds the positions, without bounds, and accessor 1
    /// the indices.
    #[must_use]
    pub fn single_triangle() -> Self {
        let mut document = Self {
            json: json!({
                "asset": {"version": "2.0"},
                "scene": 0,
                "scenes": [{"nodes": [0]}],
                "nodes": [{"mesh": 0}],
                "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
                "accessors": [], "bufferViews": [], "buffers": [{"byteLength": 0}]
            }),
            bytes: Vec::new(),
        };
        let positions: [f32; 9] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
        document.add_accessor(
            &float_bytes(&positions),
            json!({"componentType": 5126, "type": "VEC3", "count": 3}),
        );
        let indices = [0u8, 0, 1, 0, 2, 0];
        document
            .add_accessor(&indices, json!({"componentType": 5123, "type": "SCALAR", "count": 3}));
        document
    }

    /// Returns a document with one of each core object: a skinned, textured triangle with normals,
    /// vertex colors and a morph target, a camera, an animation and a sparse accessor.
    #[must_use]
    pub fn with_all_members() -> Self {
        let mut document = Self::single_triangle();
        let vec3 = |count: usize| json!({"componentType": 5126, "type": "VEC3", "count": count});
        let normals = document.add_accessor(&float_bytes(&[0.0, 0.0, 1.0].repeat(3)), vec3(3));
        let uv = json!({"componentType": 5126, "type": "VEC2", "count": 3});
        let uvs = document.add_accessor(&float_bytes(&[0.0, 1.0, 0.5, 0.25, 0.0, 0.75]), uv);
        let color = json!({"componentType": 5121, "type": "VEC4", "count": 3, "normalized": true});
        let colors = document.add_accessor(&[255; 12], color);
        let joint = json!({"componentType": 5121, "type": "VEC4", "count": 3});
        let joints = document.add_accessor(&[0; 12], joint);
        let weight = json!({"componentType": 5126, "type": "VEC4", "count": 3});
        let weights = document.add_accessor(&float_bytes(&[1.0, 0.0, 0.0, 0.0].repeat(3)), weight);
        let moved = document.add_accessor(&float_bytes(&[0.5; 9]), vec3(3));
        let identity: Vec<f32> = (0..16).map(|at| if at % 5 == 0 { 1.0 } else { 0.0 }).collect();
        let matrix = json!({"componentType": 5126, "type": "MAT4", "count": 1});
        let bind = document.add_accessor(&float_bytes(&identity), matrix);
        let time = json!({"componentType": 5126, "type": "SCALAR", "count": 2});
        let times = document.add_accessor(&float_bytes(&[0.0, 1.5]), time);
        let moves = document.add_accessor(&float_bytes(&[0.0; 6]), vec3(2));
        let image = document.add_buffer_view(&encode_png(2, 2));
        let at = document.add_buffer_view(&[0, 0, 0, 0]);
        document.json["accessors"][0]["sparse"] = json!({"count": 1,
            "indices": {"bufferView": at, "componentType": 5123}, "values": {"bufferView": 0, "byteOffset": 0}});
        document.json["meshes"][0]["name"] = json!("triangle");
        document.json["meshes"][0]["weights"] = json!([0.5]);
        document.json["meshes"][0]["primitives"][0] = json!({"indices": 1, "material": 0, "mode": 4,
            "targets": [{"POSITION": moved, "NORMAL": moved}],
            "attributes": {"POSITION": 0, "NORMAL": normals, "TEXCOORD_0": uvs, "COLOR_0": colors,
                "JOINTS_0": joints, "WEIGHTS_0": weights}});
        document.json["nodes"] = json!([
            {"mesh": 0, "skin": 0, "weights": [1], "children": [1, 2], "name": "top"},
            {"translation": [0, 0, 1], "rotation": [0, 0, 0, 1], "scale": [1, 1, 1]},
            {"camera": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}]);
        document.json["skins"] =
            json!([{"joints": [1], "inverseBindMatrices": bind, "skeleton": 1}]);
        document.json["cameras"] = json!([
            {"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1, "zfar": 100, "aspectRatio": 1.5}},
            {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "znear": 0, "zfar": 10}}]);
        document.json["materials"] = json!([{"name": "paint", "doubleSided": true, "alphaMode": "MASK", "alphaCutoff": 0.5,
            "emissiveFactor": [0, 0, 1], "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 1], "metallicFactor": 0,
                "roughnessFactor": 1, "baseColorTexture": {"index": 0, "texCoord": 0,
                    "extensions": {"KHR_texture_transform": {"offset": [0, 0], "rotation": 0.5, "scale": [1, 1], "texCoord": 0}}}},
            "extensions": {"KHR_materials_unlit": {}, "KHR_materials_emissive_strength": {"emissiveStrength": 2},
                "KHR_materials_pbrSpecularGlossiness": {"diffuseFactor": [1, 1, 1, 1], "glossinessFactor": 0.5,
                    "diffuseTexture": {"index": 0}}}}]);
        document.json["textures"] = json!([{"source": 0, "sampler": 0}]);
        document.json["samplers"] =
            json!([{"magFilter": 9728, "minFilter": 9987, "wrapS": 33071, "wrapT": 33648}]);
        document.json["images"] = json!([{"bufferView": image, "mimeType": "image/png"}]);
        document.json["animations"] = json!([{"name": "move",
            "samplers": [{"input": times, "output": moves, "interpolation": "LINEAR"}],
            "channels": [{"sampler": 0, "target": {"node": 1, "path": "translation"}}]}]);
        document.json["extensionsUsed"] = json!(["KHR_materials_unlit", "KHR_texture_transform"]);
        document
    }

    /// Returns a document with everything in [`Self::with_all_members`], and with the rare
    /// attributes and every extension. These are tangents, a second set of joints, morph targets
    /// for all attributes, lights, variants, edge visibility, animation pointers and every
    /// KHR_materials extension.
    #[must_use]
    pub fn with_extensions() -> Self {
        let mut document = Self::with_all_members();
        let vec4 = json!({"componentType": 5126, "type": "VEC4", "count": 3});
        let tangents =
            document.add_accessor(&float_bytes(&[1.0, 0.0, 0.0, 1.0].repeat(3)), vec4.clone());
        let colors = document.add_accessor(&float_bytes(&[0.25; 12]), vec4.clone());
        let weights = document.add_accessor(&float_bytes(&[0.5; 12]), vec4);
        let bytes = |count: usize| json!({"componentType": 5121, "type": "SCALAR", "count": count});
        let joint = json!({"componentType": 5121, "type": "VEC4", "count": 3});
        let joints = document.add_accessor(&[0; 12], joint);
        let bits = document.add_accessor(&[0b10_01_10], bytes(1));
        let string = document.add_accessor(&[0, 1, 255, 1, 2], bytes(5));
        let outline = document.add_accessor(&[2, 0], bytes(2));
        let primitive = &mut document.json["meshes"][0]["primitives"][0];
        primitive["attributes"]["TANGENT"] = json!(tangents);
        primitive["attributes"]["JOINTS_1"] = json!(joints);
        primitive["attributes"]["WEIGHTS_1"] = json!(weights);
        let moved = primitive["targets"][0]["POSITION"].clone();
        let uvs = primitive["attributes"]["TEXCOORD_0"].clone();
        primitive["targets"][0]["TANGENT"] = moved;
        primitive["targets"][0]["COLOR_0"] = json!(colors);
        primitive["targets"][0]["TEXCOORD_0"] = uvs;
        primitive["extensions"] = json!({
            "KHR_materials_variants": {"mappings": [{"material": 0, "variants": [0, 1]}]},
            "EXT_mesh_primitive_edge_visibility":
                {"visibility": bits, "material": 0, "lineStrings": [{"indices": string, "material": 0}]},
            "CESIUM_primitive_outline": {"indices": outline}});
        document.json["extensions"] = json!({
            "KHR_materials_variants": {"variants": [{"name": "a"}, {"name": "b"}]},
            "KHR_lights_punctual": {"lights": [{"type": "spot", "color": [1, 1, 1], "intensity": 3, "range": 2,
                "name": "lamp", "spot": {"innerConeAngle": 0.25, "outerConeAngle": 0.5}}]}});
        document.json["nodes"][1]["extensions"] = json!({"KHR_lights_punctual": {"light": 0}});
        document.add_materials();
        document.animate_by_pointers();
        document
    }

    /// Adds every extension to the material.
    fn add_materials(&mut self) {
        let texture = json!({"index": 0, "texCoord": 0});
        let material = &mut self.json["materials"][0];
        material["pbrMetallicRoughness"]["metallicRoughnessTexture"] = texture.clone();
        material["normalTexture"] = json!({"index": 0, "scale": 2,
            "extensions": {"KHR_texture_transform": {"rotation": 0.5}}});
        material["occlusionTexture"] = json!({"index": 0, "strength": 0.5});
        let more = [
            ("ior", json!({"ior": 1.25})),
            ("dispersion", json!({"dispersion": 0.5})),
            (
                "specular",
                json!({"specularFactor": 0.5, "specularColorFactor": [2, 1, 1],
                "specularTexture": texture, "specularColorTexture": texture}),
            ),
            (
                "clearcoat",
                json!({"clearcoatFactor": 0.5, "clearcoatTexture": texture,
                "clearcoatNormalTexture": {"index": 0, "scale": 0.5}}),
            ),
            ("sheen", json!({"sheenColorFactor": [1, 0, 0], "sheenRoughnessFactor": 0.5})),
            ("transmission", json!({"transmissionFactor": 0.5})),
            ("volume", json!({"thicknessFactor": 1, "attenuationDistance": 2})),
            ("iridescence", json!({"iridescenceFactor": 1, "iridescenceIor": 1.5})),
            ("anisotropy", json!({"anisotropyStrength": 0.5, "anisotropyRotation": 1})),
        ];
        for (name, json) in more {
            material["extensions"][format!("KHR_materials_{name}")] = json;
        }
    }

    /// Animates a property of the material, one of the light, one of a texture, and a morph weight
    /// (KHR_animation_pointer).
    fn animate_by_pointers(&mut self) {
        let one = json!({"componentType": 5126, "type": "SCALAR", "count": 2});
        let output = self.add_accessor(&float_bytes(&[0.0, 1.0]), one);
        let animation = &mut self.json["animations"][0];
        let input = animation["samplers"][0]["input"].clone();
        let samplers = animation["samplers"].as_array_mut().expect("the animation has samplers");
        samplers.push(json!({"input": input, "output": output}));
        for pointer in [
            "/materials/0/extensions/KHR_materials_ior/ior",
            "/extensions/KHR_lights_punctual/lights/0/spot/outerConeAngle",
            "/materials/0/normalTexture/extensions/KHR_texture_transform/rotation",
            "/nodes/0/weights/0",
        ] {
            let extensions = json!({"KHR_animation_pointer": {"pointer": pointer}});
            let target = json!({"path": "pointer", "extensions": extensions});
            let channels =
                animation["channels"].as_array_mut().expect("the animation has channels");
            channels.push(json!({"sampler": 1, "target": target}));
        }
    }

    /// Adds a buffer view with these bytes and returns its index.
    pub fn add_buffer_view(&mut self, bytes: &[u8]) -> usize {
        let start = self.bytes.len();
        self.bytes.extend(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.json["buffers"][0]["byteLength"] = json!(self.bytes.len());
        let views = self.json["bufferViews"].as_array_mut().expect("the document has buffer views");
        views.push(json!({"buffer": 0, "byteOffset": start, "byteLength": bytes.len()}));
        views.len() - 1
    }

    /// Adds an accessor with a new buffer view and returns its index.
    pub fn add_accessor(&mut self, bytes: &[u8], mut accessor: Value) -> usize {
        accessor["bufferView"] = json!(self.add_buffer_view(bytes));
        let accessors = self.json["accessors"].as_array_mut().expect("the document has accessors");
        accessors.push(accessor);
        accessors.len() - 1
    }

    /// Returns the document with the member at a JSON pointer replaced or added. Its parent must
    /// exist.
    #[must_use]
    pub fn with_value(mut self, pointer: &str, value: Value) -> Self {
        let (parent, member) = pointer.rsplit_once('/').expect("a pointer begins with a slash");
        let parent = self.json.pointer_mut(parent).expect("the parent exists");
        match member.parse::<usize>() {
            Ok(index) if parent.is_array() => parent[index] = value,
            _ => parent[member] = value,
        }
        self
    }

    /// Returns the document without the member at a JSON pointer.
    #[must_use]
    pub fn without_value(mut self, pointer: &str) -> Self {
        let (parent, member) = pointer.rsplit_once('/').expect("a pointer begins with a slash");
        let parent = self.json.pointer_mut(parent).expect("the parent exists");
        if let Some(members) = parent.as_object_mut() {
            members.remove(member);
        }
        self
    }

    /// Returns the document as a binary glTF file.
    #[must_use]
    pub fn to_glb(&self) -> Vec<u8> {
        encode_glb(self.json.to_string().as_bytes(), &self.bytes)
    }
}

/// Returns the little-endian bytes of 32-bit floats.
#[must_use]
pub fn float_bytes(numbers: &[f32]) -> Vec<u8> {
    numbers.iter().flat_map(|number| number.to_le_bytes()).collect()
}

/// Returns a valid single-color PNG in 8-bit RGBA.
#[must_use]
pub fn encode_png(width: u32, height: u32) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgba);
    let pixels = vec![128; (width * height * 4) as usize];
    let written = encoder.write_header().and_then(|mut writer| writer.write_image_data(&pixels));
    written.expect("a small PNG can be written to memory");
    bytes
}
