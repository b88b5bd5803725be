//! Tests `alberti info`.

use crate::gltf_builder::GltfBuilder;
use crate::sandbox::Sandbox;
use serde_json::{Value, json};

#[test]
fn a_model_is_described_line_by_line() {
    let sandbox = Sandbox::new("info");
    sandbox.copy_model("crate.glb");
    let run = sandbox.run(&["info", "crate.glb"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    for subject in ["meshes", "shown", "bounds", "materials", "cameras", "extensions", "animations"]
    {
        assert!(run.stdout.contains(&format!("\n  {subject} ")), "{subject}: {}", run.stdout);
    }
    assert!(run.stdout.contains("triangles "), "{}", run.stdout);
}

/// The names by which overrides in scene files select materials and nodes.
#[test]
fn materials_and_nodes_are_listed_by_name() {
    let sandbox = Sandbox::new("info_names");
    let mut document = GltfBuilder::square();
    document.json["materials"] = json!([{"name": "glaze"}, {}]);
    document.json["nodes"][0]["name"] = json!("plate");
    document.write_file(&sandbox, "model");
    let run = sandbox.run(&["info", "model.gltf"]);
    let lines: Vec<&str> = run.stdout.lines().map(str::trim).collect();
    assert!(lines.contains(&"0 glaze; 1 without a name"), "{}", run.stdout);
    assert!(lines.iter().any(|line| line.starts_with("0 plate")), "{}", run.stdout);
}

#[test]
fn a_file_that_is_not_a_model_is_refused() {
    let sandbox = Sandbox::new("info_refused");
    sandbox.write_file("text.glb", "hello");
    for flags in [&[][..], &["--json"]] {
        let run = sandbox.run(&[&["info", "text.glb"], flags].concat());
        assert_eq!((run.code, run.stdout.as_str()), (1, ""));
        assert!(run.stderr.contains("text.glb"), "{}", run.stderr);
    }
}

/// Returns the output of `info --json` for a document.
fn info_json(sandbox: &Sandbox, document: &mut GltfBuilder) -> Value {
    document.write_file(sandbox, "model");
    let run = sandbox.run(&["info", "--json", "model.gltf"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    serde_json::from_str(&run.stdout).expect("JSON")
}

#[test]
fn json_lists_counts_and_instances() {
    let sandbox = Sandbox::new("info_json");
    let mut document = GltfBuilder::square();
    document.json["nodes"][0]["scale"] = json!([-2, 1, 1]);
    document.json["nodes"][0]["children"] = json!([1]);
    document.push_item("/nodes", json!({"mesh": 0, "name": "child", "translation": [0, 3, 0]}));
    let line = json!({"attributes": {"POSITION": 0}, "mode": 2});
    document.push_item("/meshes/0/primitives", line);
    document.json["extensionsUsed"] =
        json!(["KHR_materials_unlit", "ACME_gizmo", "KHR_materials_diffuse_transmission"]);
    let info = info_json(&sandbox, &mut document);
    assert_eq!(info["schema"], json!({"name": "alberti-info", "version": 1}));
    let bounds = json!({"min": [-2.0, -1.0, 0.0], "max": [2.0, 4.0, 0.0]});
    assert_eq!(info["shown"]["bounds"], bounds);
    assert_eq!(info["scenes"], json!([{"name": "first", "nodes": [0], "bounds": bounds}]));
    let count = |times: usize| {
        json!({"primitives": 2 * times, "vertices": 8 * times, "triangles": 2 * times,
            "lines": 4 * times, "points": 0})
    };
    assert_eq!((&info["counts"], &info["shown"]["counts"]), (&count(1), &count(2)));
    assert_eq!(info["meshes"][0]["shown"], 2);
    assert_eq!(info["nodes"][1]["name"], "child");
    assert_eq!(info["nodes"][1]["to_model"][13], 3.0, "the matrix is listed column by column");
    let status = |at: usize| (&info["extensions"][at]["name"], &info["extensions"][at]["status"]);
    assert_eq!(status(0), (&json!("ACME_gizmo"), &json!("unknown")));
    let diffuse = json!("KHR_materials_diffuse_transmission");
    assert_eq!(status(1), (&diffuse, &json!("not drawn")));
    assert_eq!(status(2), (&json!("KHR_materials_unlit"), &json!("drawn")));
}

#[test]
fn glass_is_described_as_showing_opaque_surfaces() {
    let sandbox = Sandbox::new("info_glass");
    let mut document = GltfBuilder::square();
    let extensions = ["KHR_materials_transmission", "KHR_materials_volume"];
    document.json["extensionsUsed"] = json!(extensions);
    let info = info_json(&sandbox, &mut document);
    let [transmission, volume] = [&info["extensions"][0], &info["extensions"][1]];
    assert_eq!(
        (&transmission["name"], &volume["name"]),
        (&json!(extensions[0]), &json!(extensions[1]))
    );
    assert_eq!(
        (&transmission["status"], &volume["status"]),
        (&json!("drawn in part"), &json!("drawn"))
    );
    let note = transmission["note"].as_str().expect("a note");
    assert!(note.contains("opaque surfaces"), "{note}");
    let text = sandbox.run(&["info", "model.gltf"]).stdout;
    assert!(text.contains(&format!("KHR_materials_transmission ({note})")), "{text}");
}

#[test]
fn anisotropy_is_described_as_approximate_under_an_environment() {
    let sandbox = Sandbox::new("info_anisotropy");
    let mut document = GltfBuilder::square();
    document.json["extensionsUsed"] = json!(["KHR_materials_anisotropy"]);
    let info = info_json(&sandbox, &mut document);
    let entry = &info["extensions"][0];
    assert_eq!(entry["status"], json!("drawn in part"));
    let note = entry["note"].as_str().expect("a note");
    assert!(note.contains("environment") && note.contains("not stretched"), "{note}");
    let text = sandbox.run(&["info", "model.gltf"]).stdout;
    assert!(text.contains(&format!("KHR_materials_anisotropy ({note})")), "{text}");
}

/// Returns a material with every member that a material can have. Some values are out of range.
fn material_with_all_extensions() -> Value {
    let transform = json!({"KHR_texture_transform": {"offset": [0.5, 0], "texCoord": 1}});
    let texture = |index: usize| json!({"index": index, "texCoord": 0});
    json!({
        "pbrMetallicRoughness": {"metallicFactor": 0.25, "roughnessFactor": 1.5, "metallicRoughnessTexture": texture(0)},
        "normalTexture": {"index": 1, "scale": -2, "extensions": transform},
        "occlusionTexture": {"index": 0, "strength": 0.5},
        "emissiveFactor": [0.5, 0, 1], "alphaMode": "MASK", "alphaCutoff": 0.3,
        "extensions": {
            "KHR_materials_emissive_strength": {"emissiveStrength": 4},
            "KHR_materials_ior": {"ior": 1.8},
            "KHR_materials_dispersion": {"dispersion": 0.1},
            "KHR_materials_specular": {"specularFactor": 0.5, "specularColorFactor": [2, 1, 1], "specularColorTexture": texture(0)},
            "KHR_materials_clearcoat": {"clearcoatFactor": 1, "clearcoatNormalTexture": {"index": 1, "scale": 3}},
            "KHR_materials_sheen": {"sheenColorFactor": [0.1, 0.2, 0.3], "sheenRoughnessFactor": 0.4},
            "KHR_materials_transmission": {"transmissionFactor": 7},
            "KHR_materials_volume": {"thicknessFactor": 2, "attenuationColor": [1, 0.5, 0]},
            "KHR_materials_iridescence": {"iridescenceFactor": 1, "iridescenceThicknessMaximum": 500},
            "KHR_materials_anisotropy": {"anisotropyStrength": 0.6, "anisotropyRotation": "x"},
        }
    })
}

#[test]
fn json_lists_material_extensions() {
    let sandbox = Sandbox::new("info_materials");
    let mut document = GltfBuilder::square();
    document.json["materials"][0] = material_with_all_extensions();
    document.json["textures"] = json!([{"source": 0}, {}]);
    document.json["images"] = json!([{"uri": "missing.png", "name": "look"}]);
    let info = info_json(&sandbox, &mut document);
    let material = &info["materials"][0];
    assert_eq!((&material["metallic"], &material["roughness"]), (&json!(0.25), &json!(1.0)));
    assert_eq!(material["emissive"], json!([2.0, 0.0, 4.0]));
    assert_eq!((&material["alpha_mode"], &material["alpha_cutoff"]), (&json!("MASK"), &json!(0.3)));
    let expected = json!({
        "emissive_strength": {"strength": 4.0},
        "ior": {"ior": 1.8},
        "dispersion": {"dispersion": 0.1},
        "specular": {"factor": 0.5, "color": [2.0, 1.0, 1.0]},
        "clearcoat": {"factor": 1.0, "roughness": 0.0},
        "sheen": {"color": [0.1, 0.2, 0.3], "roughness": 0.4},
        "transmission": {"factor": 1.0},
        "volume": {"thickness": 2.0, "attenuation_distance": null, "attenuation_color": [1.0, 0.5, 0.0]},
        "iridescence": {"factor": 1.0, "ior": 1.3, "thickness_nanometres": [100.0, 500.0]},
        "anisotropy": {"strength": 0.6, "rotation": 0.0},
    });
    assert_eq!(material["extensions"], expected);
    let slots: Vec<&Value> =
        material["textures"].as_array().expect("a list").iter().map(|used| &used["slot"]).collect();
    let coat = "extensions/KHR_materials_clearcoat/clearcoatNormalTexture";
    let color = "extensions/KHR_materials_specular/specularColorTexture";
    let expected = [
        "pbrMetallicRoughness/metallicRoughnessTexture",
        "normalTexture",
        "occlusionTexture",
        color,
        coat,
    ];
    assert_eq!(slots, expected);
    assert_eq!(material["textures"][1]["uv_set"], 1, "the transform's set takes precedence");
    assert_eq!(material["textures"][1]["transformed"], true);
    assert_eq!(info["images"], json!([{"name": "look", "uri": "missing.png", "file": null}]));
    let assert_listed = |pointer: &str| {
        let warnings = info["warnings"].as_array().expect("a list");
        assert!(warnings.iter().any(|w| w["pointer"] == pointer), "{pointer}: {warnings:?}");
    };
    assert_listed("/materials/0/pbrMetallicRoughness/roughnessFactor");
    assert_listed("/materials/0/extensions/KHR_materials_transmission/transmissionFactor");
    assert_listed("/materials/0/extensions/KHR_materials_anisotropy/anisotropyRotation");
}

#[test]
fn json_lists_the_edges_declared_visible() {
    let sandbox = Sandbox::new("info_edges");
    let mut document = GltfBuilder::square();
    // The example in the extension's specification: values 2, 0, 1 and 0, 2, 0 for the two
    // triangles.
    let bits = document
        .add_accessor(&[18, 2], &json!({"componentType": 5121, "type": "SCALAR", "count": 2}));
    let strings = document.add_accessor(
        &[0, 1, 2, 255, 3, 0],
        &json!({"componentType": 5121, "type": "SCALAR", "count": 6}),
    );
    let outline = document
        .add_accessor(&[0, 1, 2, 9], &json!({"componentType": 5121, "type": "SCALAR", "count": 4}));
    document.json["meshes"][0]["primitives"][0]["extensions"] = json!({
        "EXT_mesh_primitive_edge_visibility": {"visibility": bits, "lineStrings": [{"indices": strings}]},
        "CESIUM_primitive_outline": {"indices": outline},
    });
    let info = info_json(&sandbox, &mut document);
    let edges = &info["meshes"][0]["primitives"][0]["edges"];
    // Lines 0-1, 1-2, 3-0 of the strings and 0-1 of the outline; there is no vertex 9.
    assert_eq!(*edges, json!({"hard": 2, "silhouette": 1, "lines": 4, "material": null}));
    let pointer = "/meshes/0/primitives/0/extensions/CESIUM_primitive_outline/indices";
    assert_eq!(info["warnings"][0]["pointer"], pointer);
}
