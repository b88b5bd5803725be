//! Flags that have no effect on a picture: a line drawing has no exposure, and a PNG has no arcs.
//!
//! They cause warnings, not errors, because one command line often renders many pictures, and a
//! flag may not apply to all of them.

use super::args::{RenderArgs, StyleArg};
use super::format::OutputFormat;
use super::render::tasks::RenderTask;
use super::scene_overrides::SceneOverrideArgs;
use clap::ValueEnum as _;
use files::visible_path;
use pipeline::Scene;
use scene::Style;
use scene_file::file::{BackgroundFile, StyleFile};

/// Returns the warnings about unused flags for a picture made by `render`.
pub(super) fn find_unused_flags(
    args: &RenderArgs,
    task: &RenderTask,
    scene: &Scene,
) -> Vec<String> {
    let is_vector = !task.format.is_raster();
    let mut warnings = find_unused_overrides(&task.overrides, scene, is_vector);
    if is_vector {
        warnings.extend(undrawn_style(task));
    }
    if args.dxf.has_tolerance() && task.format != OutputFormat::Dxf {
        warnings.push("--arc-tolerance does nothing here: only a DXF has arcs".to_owned());
    }
    if args.quality.is_some() && task.format != OutputFormat::Jpeg {
        warnings.push(
            "--quality does nothing here: it applies only to JPEG; write a .jpg to use it"
                .to_owned(),
        );
    }
    let named = task.output.as_deref().and_then(|path| OutputFormat::from_path(path).ok());
    if let (Some(output), true) = (&task.output, named.is_some_and(|named| named != task.format)) {
        let format = task.format.extension().to_uppercase();
        warnings.push(format!(
            "{} contains {format}, because --format overrides the file extension",
            visible_path(output)
        ));
    }
    if task.overrides.background == Some(BackgroundFile::Transparent)
        && task.format == OutputFormat::Jpeg
    {
        warnings.push(
            "--background transparent does nothing here: a JPEG has no transparency; write a .png"
                .to_owned(),
        );
    }
    if args.region.asks_sixteen_bits() && task.format != OutputFormat::Png {
        warnings.push("--bits 16 does nothing here: only a PNG has 16 bits per channel".to_owned());
    }
    warnings
}

/// Returns the warnings about unused flags that change a scene. `is_vector` is true if the output
/// has lines regardless of style.
pub(super) fn find_unused_overrides(
    flags: &SceneOverrideArgs,
    scene: &Scene,
    is_vector: bool,
) -> Vec<String> {
    let mut unused: Vec<&str> = Vec::new();
    let draws_lines = is_vector || !scene.style.draws_surfaces();
    let light = &flags.light;
    let reason = if draws_lines {
        let samples = [("--samples", flags.samples), ("--max-anisotropy", flags.max_anisotropy)];
        unused.extend(samples.iter().filter(|(_, flag)| flag.is_some()).map(|(name, _)| *name));
        unused.extend(light.ground_flags());
        "a line drawing has no shading".to_owned()
    } else {
        let has_light = has_light(scene.style);
        let lacks = if has_light { "neither shadows nor ambient occlusion" } else { "no lighting" };
        format!("the `{}` style has {lacks}", style_name(scene.style))
    };
    if scene.style.is_false_color() && !draws_lines {
        unused.extend(light.ground_flags());
    }
    let shows_environment = !is_vector && scene.image.environment_blur.is_some();
    if draws_lines || !has_light(scene.style) {
        unused.extend(light.light_flags(shows_environment));
    }
    if !has_shadows(scene.style) || draws_lines {
        unused.extend(light.shadow_flags(scene.ground.is_some() && !draws_lines));
    }
    let mut warnings = flags.colormap.find_unused(scene, draws_lines, style_name(scene.style));
    if !unused.is_empty() {
        let verb = if unused.len() == 1 { "does" } else { "do" };
        warnings.push(format!("{} {verb} nothing here: {reason}", files::listed(&unused)));
    }
    if flags.calibrated.has_axes_alone() {
        let message = "--camera-axes does nothing here: it applies only to --extrinsics and --pose";
        warnings.push(message.to_owned());
    }
    warnings
}

/// Returns the warning that a surface style was requested but lines are drawn.
fn undrawn_style(task: &RenderTask) -> Option<String> {
    let style = task.overrides.style.filter(|style| is_surface_style(*style))?;
    let name = style.to_possible_value()?.get_name().to_owned();
    let format = task.format.extension().to_uppercase();
    Some(format!(
        "--style {name} does nothing here: {format} output is always a line drawing; to show surfaces, write a .png"
    ))
}

/// Whether a style shows surfaces.
fn is_surface_style(style: StyleArg) -> bool {
    !matches!(StyleFile::from(style), StyleFile::Lines(_) | StyleFile::Wireframe)
}

/// Whether surfaces of a style are lit by the scene's lights.
const fn has_light(style: Style) -> bool {
    matches!(style, Style::Shaded | Style::Flat | Style::Gouraud | Style::Clay | Style::Toon)
}

/// Whether surfaces of a style have shadows and ambient occlusion.
const fn has_shadows(style: Style) -> bool {
    matches!(style, Style::Shaded | Style::Flat)
}

/// Returns the name of a style as a value of `--style`.
const fn style_name(style: Style) -> &'static str {
    match style {
        Style::Shaded => "shaded",
        Style::Flat => "flat",
        Style::Unlit => "unlit",
        Style::Gouraud => "gouraud",
        Style::Clay => "clay",
        Style::Matcap => "matcap",
        Style::Normals => "normals",
        Style::Depth(_) => "depth",
        Style::UvChecker => "uv",
        Style::Ids => "ids",
        Style::Toon => "toon",
        Style::XRay => "x-ray",
        Style::Wireframe => "wireframe",
        Style::Lines(_) => "lines",
    }
}
