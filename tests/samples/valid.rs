//! Valid files, each with one feature of glTF 2.0 or of an extension.

use super::{
    Sample, add_floats, add_indices, add_times, quad, quad_material, textured_quad, triangle,
};
use crate::gltf::Document;
use serde_json::{Value, json};

/// Returns all valid samples as binary files.
pub(super) fn valid_samples() -> Vec<Sample> {
    let groups = [geometry(), materials(), nodes(), animations(), extensions(), odd_files()];
    groups.into_iter().flatten().collect()
}

/// Returns a binary file that is drawn.
fn sample(name: &str, document: &Document, triangles: usize) -> Sample {
    Sample::valid(name, "model.glb", document.to_glb(), triangles)
}

/// Returns the quad with these indices and this primitive mode.
fn quad_of_mode(mode: u32, indices: &[u16]) -> Document {
    let mut document = quad();
    let indices = add_indices(&mut document, indices);
    document
        .with_value("/meshes/0/primitives/0/indices", json!(indices))
        .with_value("/meshes/0/primitives/0/mode", json!(mode))
}

/// Returns files for index types, primitive modes and accessor layouts.
fn geometry() -> Vec<Sample> {
    let mut bytes_as_indices = quad();
    let accessor = json!({"componentType": 5121, "type": "SCALAR", "count": 6});
    bytes_as_indices.add_accessor(&[0, 1, 2, 0, 2, 3], accessor);
    let bytes_as_indices = bytes_as_indices.with_value("/meshes/0/primitives/0/indices", json!(4));
    let mut sparse = triangle();
    let indices = sparse.add_buffer_view(&[2, 0]);
    let values = sparse.add_buffer_view(&crate::gltf::float_bytes(&[0.5, 1.0, 0.0]));
    let sparse = sparse.with_value(
        "/accessors/0/sparse",
        json!({"count": 1, "indices": {"bufferView": indices, "componentType": 5123},
            "values": {"bufferView": values}}),
    );
    let mut colored = quad();
    let color = json!({"componentType": 5121, "type": "VEC4", "count": 4, "normalized": true});
    let color = colored.add_accessor(&[255, 0, 0, 255, 0, 255, 0, 255].repeat(2), color);
    let colored = colored.with_value("/meshes/0/primitives/0/attributes/COLOR_0", json!(color));
    vec![
        sample("triangle", &triangle(), 1),
        sample(
            "triangle-without-indices",
            &triangle().without_value("/meshes/0/primitives/0/indices"),
            1,
        ),
        sample("quad", &quad(), 2),
        sample("indices-of-8-bits", &bytes_as_indices, 2),
        sample("large-grid-with-indices-of-32-bits", &large_grid(), 2 * 299 * 299),
        sample("points", &quad_of_mode(0, &[0, 1, 2, 3]), 0),
        sample("lines", &quad_of_mode(1, &[0, 1, 2, 3]), 0),
        sample("line-loop", &quad_of_mode(2, &[0, 1, 2, 3]), 0),
        sample("line-strip", &quad_of_mode(3, &[0, 1, 2, 3]), 0),
        sample("triangle-strip", &quad_of_mode(5, &[0, 1, 3, 2]), 2),
        sample("triangle-fan", &quad_of_mode(6, &[0, 1, 2, 3]), 2),
        sample("interleaved", &interleaved(), 1),
        sample("quantized", &quantized(), 1),
        sample("sparse-accessor", &sparse, 1),
        sample("vertex-colors", &colored, 2),
    ]
}

/// Returns a grid of 300 × 300 vertices, which are more than 16-bit indices can address.
fn large_grid() -> Document {
    const SIDE: u32 = 300;
    let mut document = triangle();
    let positions: Vec<f32> = (0..SIDE * SIDE)
        .flat_map(|at| [at % SIDE, at / SIDE, (at % 7) * (at % 7) % 7].map(|x| x as f32))
        .collect();
    let cells = (0..(SIDE - 1) * (SIDE - 1)).map(|at| at % (SIDE - 1) + at / (SIDE - 1) * SIDE);
    let indices = cells.flat_map(|a| [a, a + 1, a + SIDE + 1, a, a + SIDE + 1, a + SIDE]);
    let indices: Vec<u8> = indices.flat_map(u32::to_le_bytes).collect();
    let positions = add_floats(&mut document, "VEC3", &positions);
    document.json["accessors"][positions]["min"] = json!([0, 0, 0]);
    // Squares modulo 7 are 0, 1, 2 or 4, so z is at most 4.
    document.json["accessors"][positions]["max"] = json!([SIDE - 1, SIDE - 1, 4]);
    let accessor = json!({"componentType": 5125, "type": "SCALAR", "count": indices.len() / 4});
    let indices = document.add_accessor(&indices, accessor);
    document.with_value(
        "/meshes/0/primitives/0",
        json!({"attributes": {"POSITION": positions}, "indices": indices}),
    )
}

/// Returns positions and normals in one buffer view with a stride of 24 bytes.
fn interleaved() -> Document {
    let mut document = triangle();
    let vertices: [f32; 18] =
        [0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    let view = document.add_buffer_view(&crate::gltf::float_bytes(&vertices));
    document.json["bufferViews"][view]["byteStride"] = json!(24);
    document.json["accessors"] = json!([
        {"bufferView": view, "componentType": 5126, "type": "VEC3", "count": 3,
            "min": [0, 0, 0], "max": [1, 1, 0]},
        document.json["accessors"][1],
        {"bufferView": view, "byteOffset": 12, "componentType": 5126, "type": "VEC3", "count": 3},
    ]);
    document.with_value("/meshes/0/primitives/0/attributes/NORMAL", json!(2))
}

/// Returns positions in normalized 16-bit integers (KHR_mesh_quantization).
fn quantized() -> Document {
    let mut document = triangle();
    let positions: [i16; 12] = [0, 0, 0, 0, 32767, 0, 0, 0, 0, 32767, 0, 0];
    let bytes: Vec<u8> = positions.iter().flat_map(|x| x.to_le_bytes()).collect();
    let view = document.add_buffer_view(&bytes);
    document.json["bufferViews"][view]["byteStride"] = json!(8);
    document.json["accessors"][0] = json!({"bufferView": view, "componentType": 5122, "type": "VEC3", "count": 3,
        "normalized": true, "min": [0, 0, 0], "max": [32767, 32767, 0]});
    for list in ["extensionsUsed", "extensionsRequired"] {
        document.json[list] = json!(["KHR_mesh_quantization"]);
    }
    document.with_value("/nodes/0/scale", json!([2, 2, 2]))
}

/// Returns files for alpha modes, textures and core factors.
fn materials() -> Vec<Sample> {
    let textured = |mode: &str| {
        textured_quad(&json!({"alphaMode": mode, "doubleSided": true,
            "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}))
    };
    let metal = json!({"emissiveFactor": [0, 0, 0.5], "pbrMetallicRoughness": {
        "baseColorFactor": [1, 0.8, 0.3, 1], "metallicFactor": 1, "roughnessFactor": 0.2}});
    let maps = json!({"normalTexture": {"index": 0, "scale": 0.5}, "occlusionTexture": {"index": 0},
        "emissiveTexture": {"index": 0}, "emissiveFactor": [1, 1, 1],
        "pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": 0}}});
    let mut samplers = textured("OPAQUE").with_value(
        "/samplers",
        json!([{"magFilter": 9728, "minFilter": 9984, "wrapS": 33071, "wrapT": 33648}]),
    );
    samplers.json["textures"][0]["sampler"] = json!(0);
    let mut transformed = textured("OPAQUE");
    transformed.json["extensionsUsed"] = json!(["KHR_texture_transform"]);
    transformed.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] =
        json!({"KHR_texture_transform": {"offset": [0.5, 0], "rotation": 0.5, "scale": [2, 2]}});
    vec![
        sample("textured", &textured("OPAQUE"), 2),
        sample("alpha-mask", &textured("MASK"), 2),
        sample("alpha-blend", &textured("BLEND"), 2),
        sample("metal", &quad_material(quad(), &metal), 2),
        sample("all-core-textures", &textured_quad(&maps), 2),
        sample("sampler-modes", &samplers, 2),
        sample("texture-transform", &transformed, 2),
    ]
}

/// Returns files for hierarchies, transforms, cameras and scenes.
fn nodes() -> Vec<Sample> {
    let hierarchy = json!([
        {"children": [1, 2], "rotation": [0, 0, 0.6, 0.8]},
        {"mesh": 0, "translation": [2, 0, 0]},
        {"mesh": 0, "matrix": [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1]},
    ]);
    let cameras = json!([
        {"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}},
        {"type": "orthographic", "orthographic": {"xmag": 2, "ymag": 2, "znear": 0, "zfar": 9}},
    ]);
    let with_cameras = triangle().with_value("/cameras", cameras).with_value(
        "/nodes",
        json!([{"mesh": 0}, {"camera": 0, "translation": [0, 0, 3]},
            {"camera": 1, "translation": [0, 0, 3]}]),
    );
    let mut chain: Vec<Value> =
        (1..200).map(|child| json!({"children": [child], "translation": [0.1, 0, 0]})).collect();
    chain.push(json!({"mesh": 0}));
    vec![
        sample("node-hierarchy", &triangle().with_value("/nodes", hierarchy), 2),
        sample("mirrored-node", &triangle().with_value("/nodes/0/scale", json!([1, -1, 1])), 1),
        sample("deep-hierarchy", &triangle().with_value("/nodes", json!(chain)), 1),
        sample("cameras", &with_cameras.with_value("/scenes/0/nodes", json!([0, 1, 2])), 1),
        sample("no-default-scene", &triangle().without_value("/scene"), 1),
        sample(
            "second-scene-is-the-default",
            &quad()
                .with_value("/scenes", json!([{"nodes": [0]}, {"nodes": [1]}]))
                .with_value("/nodes", json!([{"mesh": 0, "scale": [9, 9, 9]}, {"mesh": 0}]))
                .with_value("/scene", json!(1)),
            2,
        ),
    ]
}

/// Returns files for skins, morph targets and interpolation modes.
fn animations() -> Vec<Sample> {
    let mut morphed = triangle();
    let offsets = add_floats(&mut morphed, "VEC3", &[0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 0.5, 0.0]);
    morphed.json["accessors"][offsets]["min"] = json!([0, 0, 0]);
    morphed.json["accessors"][offsets]["max"] = json!([0.5, 0.5, 0]);
    morphed.json["meshes"][0]["primitives"][0]["targets"] = json!([{"POSITION": offsets}]);
    morphed.json["meshes"][0]["weights"] = json!([0.5]);
    let mut samples = vec![sample("morph-target", &morphed, 1), sample("skinned", &skinned(), 1)];
    for (mode, copies) in [("STEP", 1), ("LINEAR", 1), ("CUBICSPLINE", 3)] {
        let mut document = triangle();
        let times = add_times(&mut document, &[0.0, 1.0]);
        let values = add_floats(&mut document, "VEC3", &[0.5, 0.0, 0.0].repeat(2 * copies));
        document.json["animations"] = json!([{
            "samplers": [{"input": times, "output": values, "interpolation": mode}],
            "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}]);
        samples.push(sample(&format!("animation {mode}"), &document, 1));
    }
    samples
}

/// Returns a triangle bound to two joints.
fn skinned() -> Document {
    let mut document = triangle();
    let joints = json!({"componentType": 5121, "type": "VEC4", "count": 3});
    let joints = document.add_accessor(&[0, 1, 0, 0].repeat(3), joints);
    let weights = add_floats(&mut document, "VEC4", &[0.25, 0.75, 0.0, 0.0].repeat(3));
    let identity: Vec<f32> = (0..16).map(|at| if at % 5 == 0 { 1.0 } else { 0.0 }).collect();
    let matrices = add_floats(&mut document, "MAT4", &identity.repeat(2));
    let attributes = &mut document.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = json!(joints);
    attributes["WEIGHTS_0"] = json!(weights);
    document.json["skins"] = json!([{"joints": [1, 2], "inverseBindMatrices": matrices}]);
    document.json["nodes"] = json!([{"mesh": 0, "skin": 0}, {"children": [2]},
        {"translation": [0.5, 0, 0]}]);
    document.with_value("/scenes/0/nodes", json!([0, 1]))
}

/// Returns files for the supported extensions: each KHR_materials extension on a quad, lights,
/// variants and instances.
fn extensions() -> Vec<Sample> {
    let materials = [
        ("unlit", json!({})),
        ("ior", json!({"ior": 1.8})),
        ("specular", json!({"specularFactor": 0.5, "specularColorFactor": [1, 0.5, 0.5]})),
        ("clearcoat", json!({"clearcoatFactor": 1, "clearcoatRoughnessFactor": 0.1})),
        ("sheen", json!({"sheenColorFactor": [1, 0, 0], "sheenRoughnessFactor": 0.5})),
        ("transmission", json!({"transmissionFactor": 0.8})),
        ("iridescence", json!({"iridescenceFactor": 1, "iridescenceIor": 1.5})),
        ("anisotropy", json!({"anisotropyStrength": 0.5, "anisotropyRotation": 1})),
        ("emissive_strength", json!({"emissiveStrength": 4})),
        ("dispersion", json!({"dispersion": 0.5})),
    ];
    let mut samples: Vec<Sample> = Vec::new();
    for (name, extension) in materials {
        let full_name = format!("KHR_materials_{name}");
        let mut all = json!({full_name.as_str(): extension});
        if name == "dispersion" {
            // Dispersion acts on the light that a volume transmits.
            all["KHR_materials_transmission"] = json!({"transmissionFactor": 1});
            all["KHR_materials_volume"] = json!({"thicknessFactor": 0.1});
        }
        let mut material = json!({"extensions": all, "emissiveFactor": [0.1, 0.1, 0.1]});
        if name == "anisotropy" {
            // Tangents are derived from the texture coordinates of the normal texture.
            material["normalTexture"] = json!({"index": 0});
        }
        samples.push(sample(&full_name, &quad_material(textured_quad(&json!({})), &material), 2));
    }
    let mut lit = quad();
    lit.json["extensionsUsed"] = json!(["KHR_lights_punctual"]);
    lit.json["extensions"] = json!({"KHR_lights_punctual": {"lights": [
        {"type": "directional", "intensity": 2}, {"type": "point", "color": [1, 0, 0]},
        {"type": "spot", "spot": {"innerConeAngle": 0.2, "outerConeAngle": 0.6}}]}});
    lit.json["nodes"] = (0..4).map(|at| match at {
        0 => json!({"mesh": 0}),
        _ => json!({"translation": [0, 0, 2], "extensions": {"KHR_lights_punctual": {"light": at - 1}}}),
    }).collect();
    samples.push(sample(
        "KHR_lights_punctual",
        &lit.with_value("/scenes/0/nodes", json!([0, 1, 2, 3])),
        2,
    ));
    let mut variants = quad_material(quad(), &json!({}));
    variants.json["extensionsUsed"] = json!(["KHR_materials_variants"]);
    variants.json["extensions"] =
        json!({"KHR_materials_variants": {"variants": [{"name": "red"}, {"name": "blue"}]}});
    variants.json["meshes"][0]["primitives"][0]["extensions"] = json!({"KHR_materials_variants":
        {"mappings": [{"material": 0, "variants": [0, 1]}]}});
    samples.push(sample("KHR_materials_variants", &variants, 2));
    let mut instanced = triangle();
    let translations =
        add_floats(&mut instanced, "VEC3", &[0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 4.0, 0.0, 0.0]);
    instanced.json["extensionsUsed"] = json!(["EXT_mesh_gpu_instancing"]);
    instanced.json["nodes"][0]["extensions"] =
        json!({"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": translations}}});
    samples.push(sample("EXT_mesh_gpu_instancing", &instanced, 3));
    samples
}

/// Returns valid files with unusual content.
fn odd_files() -> Vec<Sample> {
    let extras = triangle()
        .with_value("/extras", json!({"a": [1, {"b": null}]}))
        .with_value("/asset/copyright", json!("nobody"))
        .with_value("/meshes/0/name", json!("Dreieck \u{1F53A}"));
    let mut unknown_extension = triangle();
    unknown_extension.json["extensionsUsed"] = json!(["VENDOR_unknown"]);
    unknown_extension.json["extensions"] = json!({"VENDOR_unknown": {"any": "thing"}});
    let mut custom_attribute = triangle();
    let values = add_floats(&mut custom_attribute, "SCALAR", &[1.0, 2.0, 3.0]);
    let custom_attribute = custom_attribute
        .with_value("/meshes/0/primitives/0/attributes/_TEMPERATURE", json!(values));
    let degenerate = {
        let mut document = quad();
        let indices = add_indices(&mut document, &[0, 1, 2, 0, 0, 3]);
        document.with_value("/meshes/0/primitives/0/indices", json!(indices))
    };
    let nothing = Sample::valid(
        "empty-asset",
        "model.gltf",
        b"{\"asset\": {\"version\": \"2.0\"}}".to_vec(),
        0,
    );
    let no_mesh = triangle().with_value("/nodes", json!([{"name": "empty"}]));
    vec![
        sample("extras-and-names", &extras, 1),
        sample("unknown-optional-extension", &unknown_extension, 1),
        sample("custom-attribute", &custom_attribute, 1),
        sample("degenerate-triangle", &degenerate, 2),
        nothing.expect("nothing to draw"),
        sample("nodes-without-a-mesh", &no_mesh, 0).expect("nothing to draw"),
    ]
}
