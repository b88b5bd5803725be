//! Variants and scenes: the choices that a file offers, and the flags and fields that select them.

use crate::gltf_builder::GltfBuilder;
use crate::sandbox::Sandbox;
use serde_json::json;

/// Writes a file with a red square on the left, which is blue in the variant `blue`. Its second
/// scene also shows a square on the right.
fn write_variants_model(sandbox: &Sandbox) {
    let mut document = GltfBuilder::square();
    let blue = document.add_unlit_material([0.0, 0.0, 1.0]);
    document.json["extensionsUsed"] = json!(["KHR_materials_unlit", "KHR_materials_variants"]);
    document.json["extensions"] =
        json!({"KHR_materials_variants": {"variants": [{"name": "red"}, {"name": "blue"}]}});
    let mappings = json!([{"material": 0, "variants": [0]}, {"material": blue, "variants": [1]}]);
    document.json["meshes"][0]["primitives"][0]["extensions"] =
        json!({"KHR_materials_variants": {"mappings": mappings}});
    let right = document.push_item("/nodes", json!({"mesh": 0, "translation": [4, 0, 0]}));
    document.push_item("/scenes", json!({"nodes": [0, right], "name": "both"}));
    document.write_file(sandbox, "offer");
}

/// Returns the colors in a picture that has no antialiased edges.
fn rendered_colors(sandbox: &Sandbox, arguments: &[&str]) -> Vec<[u8; 4]> {
    let default = ["-o", "out.png", "--size", "40x20", "--view", "front", "--samples", "1"];
    let run = sandbox.run(&[arguments, &default].concat());
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{arguments:?}");
    let mut colors = sandbox.read_picture("out.png").2;
    colors.sort_unstable();
    colors.dedup();
    colors
}

const TRANSPARENT: [u8; 4] = [0; 4];
const RED: [u8; 4] = [255, 0, 0, 255];
const BLUE: [u8; 4] = [0, 0, 255, 255];

#[test]
fn a_variant_is_selected_by_name_or_number() {
    let sandbox = Sandbox::new("variants");
    write_variants_model(&sandbox);
    assert_eq!(rendered_colors(&sandbox, &["render", "offer.gltf"]), [TRANSPARENT, RED]);
    assert_eq!(
        rendered_colors(&sandbox, &["render", "offer.gltf", "--variant", "blue"]),
        [TRANSPARENT, BLUE]
    );
    assert_eq!(
        rendered_colors(&sandbox, &["render", "offer.gltf", "--variant", "0"]),
        [TRANSPARENT, RED]
    );
    let models = "(path: \"offer.gltf\", variant: Name(\"blue\")), \
                  (path: \"offer.gltf\", translation: (0, 4, 0))";
    sandbox.write_file("two.ron", format!("Scene(models: [{models}])"));
    assert_eq!(rendered_colors(&sandbox, &["render", "two.ron"]), [TRANSPARENT, BLUE, RED]);
}

#[test]
fn a_scene_is_selected_by_name_or_number() {
    let sandbox = Sandbox::new("scenes");
    write_variants_model(&sandbox);
    let width = |scene: &str| {
        let run = sandbox.run(&["info", "offer.gltf", "--json", "--scene", scene]);
        assert_eq!(run.code, 0, "{}", run.stderr);
        let info: serde_json::Value = serde_json::from_str(&run.stdout).expect("JSON");
        info["shown"]["bounds"]["max"][0].as_f64()
    };
    assert_eq!([width("0"), width("first")], [Some(1.0); 2]);
    assert_eq!([width("1"), width("both")], [Some(5.0); 2]);
    sandbox.write_file("scene.ron", "Scene(models: [(path: \"offer.gltf\", scene: Index(1))])");
    assert_eq!(rendered_colors(&sandbox, &["render", "scene.ron"]), [TRANSPARENT, RED]);
    let inked =
        |sandbox: &Sandbox| sandbox.read_picture("out.png").2.iter().filter(|p| p[3] > 0).count();
    let both = inked(&sandbox);
    rendered_colors(&sandbox, &["render", "scene.ron", "--scene", "0"]);
    assert!(inked(&sandbox) > both, "the flag overrides the scene file: one square fills more");
}

#[test]
fn unknown_choices_are_reported_with_the_available_choices() {
    let sandbox = Sandbox::new("no_such_variant");
    write_variants_model(&sandbox);
    for (flag, wanted, offered) in [
        ("--variant", "green", "choose one of 0 `red`, 1 `blue`"),
        ("--variant", "2", "choose one of 0 `red`, 1 `blue`"),
        ("--scene", "third", "choose one of 0 `first`, 1 `both`"),
    ] {
        for command in ["render", "info"] {
            let run = sandbox.run(&[command, "offer.gltf", flag, wanted]);
            assert_eq!((run.code, run.stdout.as_str()), (1, ""), "{flag} {wanted}");
            assert!(run.stderr.contains(offered), "{flag} {wanted}: {}", run.stderr);
            assert!(run.stderr.contains(&format!("`{wanted}`")), "{}", run.stderr);
        }
    }
    sandbox.write_file(
        "scene.ron",
        "Scene(models: [\n  (path: \"offer.gltf\", variant: Name(\"green\")),\n])",
    );
    let run = sandbox.run(&["render", "scene.ron"]);
    assert_eq!(run.code, 1);
    assert!(run.stderr.contains("scene.ron:2:33"), "{}", run.stderr);
    assert!(run.stderr.contains("choose one of 0 `red`, 1 `blue`"), "{}", run.stderr);
    sandbox.copy_model("crate.glb");
    let run = sandbox.run(&["render", "crate.glb", "--variant", "blue"]);
    assert!(run.stderr.contains("the file has no variants"), "{}", run.stderr);
}
