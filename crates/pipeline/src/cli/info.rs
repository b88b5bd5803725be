//! `alberti info`: what is in a model.

use super::Failure;
use super::args::InfoArgs;
use pipeline::import::{ImportOptions, load};
use pipeline::model::{AlphaMode, LensKind, Model, Topology};
use std::fmt::Write as _;
use std::io::Write as _;

pub(crate) fn run(args: &InfoArgs) -> Result<(), Failure> {
    let model = load(&args.file, &ImportOptions::default())?;
    let text = describe(&model);
    std::io::stdout().write_all(text.as_bytes())?;
    Ok(())
}

/// The report, a line for each subject. Writing to a `String` cannot fail.
fn describe(model: &Model) -> String {
    let mut text = format!("{}\n", model.name);
    let mut line = |name: &str, value: String| {
        let _ = writeln!(text, "  {name:<12}{value}");
    };
    line("nodes", model.nodes.len().to_string());
    line("meshes", meshes(model));
    line("shown", shown(model));
    line("bounds", bounds(model));
    line("materials", materials(model));
    line("textures", format!("{}, images {}", model.textures.len(), model.images.len()));
    line("cameras", cameras(model));
    line("skins", model.skins.len().to_string());
    line("animations", animations(model));
    line("extensions", or_none(&model.extensions_used));
    for warning in &model.warnings {
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
    let describe = |(number, lens): (usize, &pipeline::model::Lens)| {
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
    let describe = |animation: &pipeline::model::Animation| {
        let name = animation.name.as_deref().unwrap_or("unnamed");
        let (channels, seconds) = (animation.channels.len(), animation.duration_seconds);
        format!("{name}: {channels} channels, {seconds:.3} s")
    };
    or_none(&model.animations.iter().map(describe).collect::<Vec<_>>())
}

fn or_none(items: &[String]) -> String {
    if items.is_empty() { "none".to_owned() } else { items.join("; ") }
}
