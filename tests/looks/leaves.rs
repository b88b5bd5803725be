//! Three leaves with the same half-empty image: opaque, masked and blended. In every style, the
//! empty halves of the last two are transparent.

use super::styles::all_styles;
use alberti_tests::gltf::{Document, float_bytes};
use drawing::Warning;
use pipeline::{Origin, Picture, RenderContext, Renderer, Scene, Textures};
use scene::{ResolveOptions, Style};
use scene_file::file::{GroundFile, StyleFile};
use scene_file::{SceneFile, parse_scene};
use serde_json::json;
use std::fs::{create_dir_all, write};
use std::path::Path;

const MODES: [&str; 3] = ["OPAQUE", "MASK", "BLEND"];
const BACKGROUND: [u8; 4] = [0, 255, 0, 255];

/// Returns the defects in the leaves for each style. The model is written to `folder`.
pub fn judge_leaves(folder: &Path) -> Result<Vec<String>, String> {
    let written = create_dir_all(folder).and_then(|()| write(folder.join("leaves.glb"), leaves()));
    written.map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut faults = Vec::new();
    for (name, style) in all_styles() {
        let (picture, warnings, scene) = render_leaves(folder, style, false)?;
        if matches!(scene.style, Style::Wireframe | Style::Lines(_)) {
            if !warnings.contains(&Warning::Lines(hidden_line::Warning::CutOutsDrawnWhole)) {
                faults.push(format!("{name} draws whole leaves without a warning: {warnings:?}"));
            }
            continue;
        }
        for (index, mode) in MODES.iter().enumerate() {
            let [empty, full] = [25, 75].map(|x| picture.pixels[50 * 300 + 100 * index + x]);
            if full == BACKGROUND {
                faults.push(format!("{name}: the {mode} leaf is invisible"));
            }
            if (empty == BACKGROUND) != (*mode != "OPAQUE") {
                faults.push(format!("{name}: the empty half of the {mode} leaf is {empty:?}"));
            }
        }
    }
    Ok(faults)
}

/// Returns the numeric passes that a ground plane below the model changes.
pub fn judge_grounds(folder: &Path) -> Result<Vec<String>, String> {
    let mut faults = Vec::new();
    for (name, style) in all_styles() {
        let [without, with] = [false, true].map(|has_ground| {
            render_leaves(folder, style.clone(), has_ground).map(|(picture, ..)| picture)
        });
        let is_of_numbers = ["normals", "depth", "uv", "ids"].contains(&name);
        if is_of_numbers && without? != with? {
            faults.push(format!("{name} shows the shadow on the ground"));
        }
    }
    Ok(faults)
}

/// Renders the leaves from the front, so that each is 100 pixels wide and high.
fn render_leaves(
    folder: &Path,
    style: StyleFile,
    has_ground: bool,
) -> Result<(Picture, Vec<Warning>, Scene), String> {
    let text = r##"Scene(models: [(path: "leaves.glb")],
        camera: (view: LookAt(eye: (0, 0, 5), target: (0, 0, 0)),
            projection: Orthographic(left: -3, right: 3, bottom: -1, top: 1, near: 1, far: 9)),
        lights: [Directional(direction: (-1, -2, -1), intensity: 2)], shadows: On(),
        image: (size: (300, 100), background: Color("#00ff00")))"##;
    let parsed = parse_scene("leaves.ron", text).map_err(|error| error.to_string())?;
    let ground = has_ground.then_some(GroundFile::DEFAULT);
    let file = SceneFile { style, ground, ..parsed };
    let origin = Origin::from_text("leaves.ron", text, folder.to_path_buf());
    let scene = Scene::resolve(&origin, &file, &ResolveOptions::default());
    let scene = scene.map_err(|error| error.to_string())?;
    let textures = Textures::for_models(&scene.models);
    let mut picture = Picture::default();
    let context = RenderContext::new(&scene, &textures, 1);
    let warnings = Renderer::default().render(&context, &mut picture);
    let warnings = warnings.map_err(|error| error.to_string())?;
    Ok((picture, warnings, scene))
}

/// Returns three squares side by side with one texture, whose left half is transparent.
fn leaves() -> Vec<u8> {
    let mut document = Document::single_triangle();
    let mut image = Picture::<u8>::default();
    image.resize(2, 1);
    image.pixels.copy_from_slice(&[[200, 40, 40, 0], [200, 40, 40, 255]]);
    let image = document.add_buffer_view(&image.to_png());
    let vec2 = json!({"componentType": 5126, "type": "VEC2", "count": 4});
    let uvs = document.add_accessor(&float_bytes(&[0.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0]), vec2);
    let indices: Vec<u8> = [0_u16, 1, 2, 0, 2, 3].into_iter().flat_map(u16::to_le_bytes).collect();
    let scalar = json!({"componentType": 5123, "type": "SCALAR", "count": 6});
    let indices = document.add_accessor(&indices, scalar);
    let mut primitives = Vec::new();
    document.json["materials"] = json!([null, null, null]);
    for (index, mode) in MODES.iter().enumerate() {
        let (left, right) = (2.0 * index as f32 - 3.0, 2.0 * index as f32 - 1.0);
        let corners = [left, -1.0, 0.0, right, -1.0, 0.0, right, 1.0, 0.0, left, 1.0, 0.0];
        let vec3 = json!({"componentType": 5126, "type": "VEC3", "count": 4,
            "min": [left, -1.0, 0.0], "max": [right, 1.0, 0.0]});
        let positions = document.add_accessor(&float_bytes(&corners), vec3);
        primitives.push(json!({"attributes": {"POSITION": positions, "TEXCOORD_0": uvs},
            "indices": indices, "material": index}));
        document.json["materials"][index] = json!({"alphaMode": mode, "name": mode,
            "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicFactor": 0}});
    }
    document.json["meshes"] = json!([{ "primitives": primitives }]);
    document.json["textures"] = json!([{"source": 0, "sampler": 0}]);
    document.json["samplers"] = json!([{"magFilter": 9728, "minFilter": 9728}]);
    document.json["images"] = json!([{"bufferView": image, "mimeType": "image/png"}]);
    document.to_glb()
}
