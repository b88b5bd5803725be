//! `alberti info`: what is in a model.

mod json;
mod materials;
mod scenes;

use super::Failure;
use super::args::InfoArgs;
use super::pick::PickArgs;
use model::import::{ExtensionUse, Images, ImportOptions, extension_use, load};
use model::{AlphaMode, LensKind, LightKind, Model, PunctualLight, SceneRoots, Topology, Warning};
use pipeline::scene::chosen_animation;
use pipeline::scene::file::Finite;
use std::fmt::Write as _;
use std::io::Write as _;

pub(crate) fn run(args: &InfoArgs) -> Result<(), Failure> {
    let model = picked(args)?;
    let text = if args.json { json::document(args, &model) } else { describe(&model) };
    std::io::stdout().write_all(text.as_bytes())?;
    Ok(())
}

/// The model as the flags pick it. Its images are not decoded.
fn picked(args: &InfoArgs) -> Result<Model, Failure> {
    let PickArgs { scene, variant, animation, time } = &args.pick;
    let options = ImportOptions {
        scene: scene.clone().map(Into::into),
        variant: variant.clone().map(Into::into),
        images: Images::Headers,
        ..args.load.options()
    };
    let mut model = load(&args.file, &options)?;
    if animation.is_some() || time.is_some() {
        let animation =
            chosen_animation(&model, animation.as_ref()).map_err(|(problem, help)| {
                let help = help.map_or(String::new(), |help| format!("\n  = help: {help}"));
                Failure::Usage(format!("{}: {problem}{help}", args.file.display()))
            })?;
        model.pose(animation, time.map_or(0.0, Finite::value));
    }
    Ok(model)
}

/// The report, a line for each subject. Writing to a `String` cannot fail.
fn describe(model: &Model) -> String {
    let mut text = format!("{}\n", model.name);
    let mut line = |name: &str, value: String| {
        let _ = writeln!(text, "  {name:<12}{value}");
    };
    if model.scenes.len() > 1 {
        line("scenes", scenes(model));
    }
    line("nodes", model.nodes.len().to_string());
    line("meshes", meshes(model));
    line("shown", shown(model));
    line("bounds", bounds(model));
    line("materials", materials(model));
    line("textures", format!("{}, images {}", model.textures.len(), model.images.len()));
    line("cameras", cameras(model));
    if !model.lights.is_empty() {
        line("lights", lights(model));
    }
    line("skins", model.skins.len().to_string());
    line("animations", animations(model));
    if !model.variants.is_empty() {
        line("variants", or_none(&model.variants));
    }
    line("extensions", extensions(model));
    // Those about extensions are marked in the line of the extensions.
    let of_file = |warning: &&Warning| !warning.pointer.starts_with("/extensions");
    for warning in model.warnings.iter().filter(of_file) {
        line("warning", format!("{}: {}", warning.pointer, warning.message));
    }
    text
}

fn meshes(model: &Model) -> String {
    let primitives: usize = model.meshes.iter().map(|mesh| mesh.primitives.len()).sum();
    let vertices: usize =
        model.meshes.iter().flat_map(|mesh| &mesh.primitives).map(|p| p.positions.len()).sum();
    format!("{}, primitives {primitives}, vertices {vertices}", model.meshes.len())
}

/// What the shown scene draws, instances counted as often as they are shown.
fn shown(model: &Model) -> String {
    let mut counts = [0_usize; 3];
    for (_, primitive) in model.shown_primitives() {
        let kind = match primitive.topology {
            Topology::Triangles => 0,
            Topology::Lines => 1,
            Topology::Points => 2,
        };
        counts[kind] += primitive.count();
    }
    format!("triangles {}, lines {}, points {}", counts[0], counts[1], counts[2])
}

fn bounds(model: &Model) -> String {
    let Some(bounds) = model.bounds() else { return "none: nothing is shown".to_owned() };
    let triple = |p: [f64; 3]| format!("({:.6}, {:.6}, {:.6})", p[0], p[1], p[2]);
    let (min, max) = (bounds.min().into(), bounds.max().into());
    format!("{} to {}", triple(min), triple(max))
}

fn materials(model: &Model) -> String {
    let count = |wanted: fn(&AlphaMode) -> bool| {
        model.materials.iter().filter(|material| wanted(&material.alpha_mode)).count()
    };
    let masked = count(|mode| matches!(mode, AlphaMode::Mask { .. }));
    let blended = count(|mode| matches!(mode, AlphaMode::Blend));
    let double = model.materials.iter().filter(|material| material.double_sided).count();
    let all = model.materials.len();
    format!("{all}, masked {masked}, blended {blended}, double-sided {double}")
}

fn cameras(model: &Model) -> String {
    let describe = |(number, lens): (usize, &model::Lens)| {
        let name = lens.name.as_deref().unwrap_or("unnamed");
        match lens.kind {
            LensKind::Perspective { fov_y, near, far, .. } => {
                let degrees = fov_y.to_degrees();
                format!("{number} {name}: perspective, {degrees:.2} degrees, {near} to {far}")
            }
            LensKind::Orthographic { half_height, near, far, .. } => {
                let height = 2.0 * half_height;
                format!("{number} {name}: orthographic, height {height}, {near} to {far}")
            }
        }
    };
    or_none(&model.cameras.iter().enumerate().map(describe).collect::<Vec<_>>())
}

fn animations(model: &Model) -> String {
    let describe = |animation: &model::Animation| {
        let name = animation.name.as_deref().unwrap_or("unnamed");
        let (channels, seconds) = (animation.channels.len(), animation.duration_seconds);
        format!("{name}: {channels} channels, {seconds:.3} s")
    };
    or_none(&model.animations.iter().map(describe).collect::<Vec<_>>())
}

/// The scenes by name, the shown one marked.
fn scenes(model: &Model) -> String {
    let describe = |(number, scene): (usize, &SceneRoots)| {
        let shown = if model.scene == Some(number) { " (shown)" } else { "" };
        format!("{number} {}{shown}", scene.name.as_deref().unwrap_or("unnamed"))
    };
    or_none(&model.scenes.iter().enumerate().map(describe).collect::<Vec<_>>())
}

fn lights(model: &Model) -> String {
    let describe = |light: &PunctualLight| {
        let unit = if light.kind == LightKind::Directional { "lx" } else { "cd" };
        let name = light.name.as_deref().unwrap_or("unnamed");
        format!("{name}: {}, {} {unit}", light.kind.name(), light.intensity)
    };
    or_none(&model.lights.iter().map(describe).collect::<Vec<_>>())
}

/// The extensions; of those that are not drawn as they are meant to be it is said.
fn extensions(model: &Model) -> String {
    let describe = |name: &String| match extension_use(name) {
        ExtensionUse::Drawn | ExtensionUse::Harmless => name.clone(),
        ExtensionUse::Partly(how) => format!("{name} ({how})"),
        ExtensionUse::Without(_) => format!("{name} (not drawn)"),
        ExtensionUse::Refused(_) | ExtensionUse::Unknown => format!("{name} (not read)"),
    };
    or_none(&model.extensions_used.iter().map(describe).collect::<Vec<_>>())
}

fn or_none(items: &[String]) -> String {
    if items.is_empty() { "none".to_owned() } else { items.join("; ") }
}
