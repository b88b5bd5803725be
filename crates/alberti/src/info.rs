//! `alberti info`: prints what a model contains.
//!
//! The model is imported as for rendering, so a model that cannot be drawn cannot be described
//! either; `check` reports why. Only the headers of image files are read: they contain the size and
//! the format, so that megabytes of pixels need not be decoded.

mod json;
mod materials;
mod scenes;

use super::args::InfoArgs;
use super::model_state::ModelStateArgs;
use super::{CliError, print_json, print_text};
use files::{counted, visible_path, visible_text};
use import::{ExtensionUse, ImageLoading, ImportOptions, extension_use, load};
use model::{
    AlphaMode, CameraProjection, Diagnostic, LightKind, Model, PunctualLight, SceneRoots, Topology,
};
use scene::select_animation;
use scene_file::file::Finite;
use std::fmt::Write as _;

/// Prints the contents of a model as text or JSON.
///
/// # Errors
/// Returns an error if the model cannot be loaded, or has no animation with the chosen name.
pub(crate) fn run(args: &InfoArgs) -> Result<(), CliError> {
    let model = load_model(args)?;
    if args.json {
        print_json(&json::info_document(args, &model))
    } else {
        print_text(&describe_model(&model))
    }
}

/// Loads the model in the state that the flags select. Only the headers of its images are read.
///
/// Either `--animation` or `--time` poses the model; the other then defaults to the first animation
/// or to 0 seconds. Without either flag, the model has the pose of its nodes in the file.
fn load_model(args: &InfoArgs) -> Result<Model, CliError> {
    let ModelStateArgs { scene, variant, animation, time } = &args.model_state;
    let options = ImportOptions {
        scene: scene.clone().map(scene::name_or_index),
        variant: variant.clone().map(scene::name_or_index),
        images: ImageLoading::Headers,
        ..args.load_options.import_options()
    };
    let mut model = load(&args.file, &options)?;
    if animation.is_some() || time.is_some() {
        let animation =
            select_animation(&model, animation.as_ref()).map_err(|(problem, help)| {
                let help = help.as_deref().map(visible_text);
                let help = help.map_or(String::new(), |help| format!("\n  = help: {help}"));
                let problem = visible_text(&problem);
                CliError::Usage(format!("{}: {problem}{help}", visible_path(&args.file)))
            })?;
        model.apply_animation(animation, time.map_or(0.0, Finite::value));
    }
    Ok(model)
}

/// The maximum number of nodes listed by name.
const LISTED_NODES: usize = 20;

/// Formats the report as text, one line per subject. Writing to a `String` cannot fail.
///
/// Most models have one scene and no lights, variants or scalars; lines about these are then
/// omitted. The others are always present, so that two models can be compared line by line:
///
/// ```text
/// fox.glb
///   nodes       24
///   meshes      1, primitives 1, vertices 1728
///   shown       triangles 576, lines 0, points 0
///   …
/// ```
fn describe_model(model: &Model) -> String {
    let mut text = format!("{}\n", visible_text(&model.name));
    let mut line = |name: &str, value: String| {
        if !value.is_empty() {
            let _ = writeln!(text, "  {name:<12}{}", visible_text(&value));
        }
    };
    if model.scenes.len() > 1 {
        line("scenes", scenes_line(model));
    }
    line("nodes", model.nodes.len().to_string());
    line("", node_names(model));
    line("meshes", meshes_line(model));
    line("shown", shown_line(model));
    line("bounds", bounds_line(model));
    line("unit", format!("{}, {} up", model.length_unit.symbol(), model.up_axis.letter()));
    line("materials", materials_line(model));
    line("", material_names(model));
    line("textures", format!("{}, images {}", model.textures.len(), model.images.len()));
    line("cameras", cameras_line(model));
    if !model.lights.is_empty() {
        line("lights", lights_line(model));
    }
    line("skins", model.skins.len().to_string());
    line("animations", animations_line(model));
    if !model.variants.is_empty() {
        line("variants", list_or_none(&model.variants));
    }
    if !model.scalar_attributes.is_empty() {
        line("scalars", list_or_none(&model.scalar_attributes));
    }
    line("extensions", extensions_line(model));
    // The extensions line already contains warnings about extensions.
    let is_about_file = |warning: &&Diagnostic| !warning.location.starts_with("/extensions");
    for warning in model.warnings.iter().filter(is_about_file) {
        line(warning.severity.name(), warning.sentence());
    }
    text
}

/// Lists the materials by index and name; overrides in scene files accept either.
fn material_names(model: &Model) -> String {
    let names = model.materials.iter().map(|material| material.name.as_deref());
    named_items(names, usize::MAX)
}

/// Lists the first named nodes by index and name; `--json` lists all.
fn node_names(model: &Model) -> String {
    named_items(model.nodes.iter().map(|node| node.name.as_deref()), LISTED_NODES)
}

/// Lists the named items with their indices, and the number of unnamed items, of which some
/// exporters leave hundreds.
fn named_items<'a>(names: impl Iterator<Item = Option<&'a str>>, most: usize) -> String {
    let (mut listed, mut unlisted, mut unnamed) = (Vec::new(), 0, 0);
    for (index, name) in names.enumerate() {
        match name {
            Some(name) if listed.len() < most => listed.push(format!("{index} {name}")),
            Some(_) => unlisted += 1,
            None => unnamed += 1,
        }
    }
    listed.extend((unlisted > 0).then(|| format!("{unlisted} more in --json")));
    listed.extend((unnamed > 0).then(|| format!("{unnamed} without a name")));
    listed.join("; ")
}

/// Counts the meshes, primitives and vertices in the file.
///
/// Each mesh counts once, however often it is instanced; vertices are counted as in the file,
/// before any welding.
fn meshes_line(model: &Model) -> String {
    let primitives: usize = model.meshes.iter().map(|mesh| mesh.primitives.len()).sum();
    let vertices: usize =
        model.meshes.iter().flat_map(|mesh| &mesh.primitives).map(|p| p.positions.len()).sum();
    format!("{}, primitives {primitives}, vertices {vertices}", model.meshes.len())
}

/// Counts the triangles, lines and points that the scene draws.
///
/// Every instance of a mesh counts, from several nodes or from EXT_mesh_gpu_instancing: this line
/// measures rendering work, and the `meshes` line measures file size.
fn shown_line(model: &Model) -> String {
    let mut counts = [0_usize; 3];
    for (_, primitive) in model.scene_primitives() {
        let kind = match primitive.topology {
            Topology::Triangles => 0,
            Topology::Lines => 1,
            Topology::Points => 2,
        };
        counts[kind] += primitive.item_count();
    }
    format!("triangles {}, lines {}, points {}", counts[0], counts[1], counts[2])
}

/// Formats the axis-aligned bounds of the drawn scene.
///
/// The box is computed in the selected pose, in model space: right-handed, y up, with lengths in
/// units of the file.
fn bounds_line(model: &Model) -> String {
    let Some(bounds) = model.bounds() else { return "none: nothing is shown".to_owned() };
    let triple = |p: [f64; 3]| format!("({:.6}, {:.6}, {:.6})", p[0], p[1], p[2]);
    let (min, max) = (bounds.min().into(), bounds.max().into());
    format!("{} to {}", triple(min), triple(max))
}

/// Counts all materials, and the masked, blended and double-sided ones.
///
/// Masked and blended materials cost more to draw, because their texels decide visibility;
/// double-sided surfaces are not culled.
fn materials_line(model: &Model) -> String {
    let count = |wanted: fn(&AlphaMode) -> bool| {
        model.materials.iter().filter(|material| wanted(&material.alpha_mode)).count()
    };
    let masked = count(|mode| matches!(mode, AlphaMode::Mask { .. }));
    let blended = count(|mode| matches!(mode, AlphaMode::Blend));
    let double = model.materials.iter().filter(|material| material.double_sided).count();
    let all = model.materials.len();
    format!("{all}, masked {masked}, blended {blended}, double-sided {double}")
}

/// Lists the cameras by index and name, with their projections.
///
/// Angles are the vertical field of view in degrees, heights are window heights in scene units, and
/// the last two numbers are the near and far distances.
fn cameras_line(model: &Model) -> String {
    let describe = |(number, lens): (usize, &model::ModelCamera)| {
        let name = lens.name.as_deref().unwrap_or("unnamed");
        // Rounded for readability: many exporters turn 0.05 into 0.04999999701976776.
        let short = |distance: f64| distance as f32;
        match lens.projection {
            CameraProjection::Perspective { fov_y, near, far, .. } => {
                let degrees = fov_y.to_degrees();
                format!(
                    "{number} {name}: perspective, {degrees:.2} degrees, {} to {}",
                    short(near),
                    short(far)
                )
            }
            CameraProjection::Orthographic { half_height, near, far, .. } => {
                let [height, near, far] = [2.0 * half_height, near, far].map(short);
                format!("{number} {name}: orthographic, height {height}, {near} to {far}")
            }
        }
    };
    list_or_none(&model.cameras.iter().enumerate().map(describe).collect::<Vec<_>>())
}

/// Lists the animations by name, with their channels and duration.
fn animations_line(model: &Model) -> String {
    let describe = |animation: &model::Animation| {
        let name = animation.name.as_deref().unwrap_or("unnamed");
        let channels = counted(animation.channels.len(), "channel", "channels");
        format!("{name}: {channels}, {:.3} s", animation.duration_seconds)
    };
    list_or_none(&model.animations.iter().map(describe).collect::<Vec<_>>())
}

/// Lists the file's scenes by name and marks the drawn scene.
fn scenes_line(model: &Model) -> String {
    let describe = |(number, scene): (usize, &SceneRoots)| {
        let shown = if model.active_scene == Some(number) { " (shown)" } else { "" };
        format!("{number} {}{shown}", scene.name.as_deref().unwrap_or("unnamed"))
    };
    list_or_none(&model.scenes.iter().enumerate().map(describe).collect::<Vec<_>>())
}

/// Lists the punctual lights by name, with their intensity and its unit.
///
/// Directional lights have an illuminance in lux, point and spot lights a luminous intensity in
/// candela (KHR_lights_punctual).
fn lights_line(model: &Model) -> String {
    let describe = |light: &PunctualLight| {
        let unit = if light.kind == LightKind::Directional { "lx" } else { "cd" };
        let name = light.name.as_deref().unwrap_or("unnamed");
        format!("{name}: {}, {} {unit}", light.kind.gltf_name(), light.intensity)
    };
    list_or_none(&model.lights.iter().map(describe).collect::<Vec<_>>())
}

/// Lists the file's extensions, with a note on each that is not fully supported.
///
/// `(not drawn)` means that the model is shown without the effect. `(not read)` means that the
/// extension is unknown, or that models that require it are rejected.
fn extensions_line(model: &Model) -> String {
    let describe = |name: &String| match extension_use(name) {
        ExtensionUse::Drawn | ExtensionUse::Harmless => name.clone(),
        ExtensionUse::Partly(how) => format!("{name} ({how})"),
        ExtensionUse::Without(_) => format!("{name} (not drawn)"),
        ExtensionUse::Refused(_) | ExtensionUse::Unknown => format!("{name} (not read)"),
    };
    list_or_none(&model.extensions_used.iter().map(describe).collect::<Vec<_>>())
}

/// Joins a list on one line; an empty list becomes `none`.
fn list_or_none(items: &[String]) -> String {
    if items.is_empty() { "none".to_owned() } else { items.join("; ") }
}
