//! `alberti scene init`: creates a commented scene file for a model.
//!
//! The file is a starting point for editing: it contains the default view and light as explicit
//! fields, and comments for everything else that the model offers.
//!
//! ```text
//! // fox.glb: 576 triangles, 0.256 wide, 0.788 high, 1.545 deep.
//! Scene(
//!     models: [Model(path: "fox.glb", …)],
//!     camera: Camera(view: Frame(from: ThreeQuarter, padding_percent: 5), …),
//!     …
//! )
//! ```

use crate::load_options::LoadArgs;
use crate::{CliError, print_message, print_text};
use files::visible_path;
use model::{Model, Topology};
use pipeline::{Origin, ResolveError, Scene};
use scene::ResolveOptions;
use scene_file::file::NonNegative;
use scene_file::format_source;
use shade::Light;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Arguments of `alberti scene init`.
#[derive(Debug, clap::Args)]
pub(crate) struct InitArgs {
    /// Model (.gltf, .glb, .stl, .obj, .ply, .3mf)
    model: PathBuf,
    /// Output file; `-` is the standard output [default: the model's name with .ron, next to it]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Replace an existing file
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    load_options: LoadArgs,
}

/// Writes the scene file, prints its path, and warns if reading the model needs permission.
///
/// The model is loaded to learn its size, cameras and lights. The text is built without indentation
/// and then formatted as by `scene fmt`, which also proves that it parses.
///
/// # Errors
/// Returns an error if the output exists and `--force` is not set, if the model cannot be loaded,
/// or if the file cannot be written.
pub(crate) fn run(args: &InitArgs) -> Result<(), CliError> {
    let output = args.output.clone().unwrap_or_else(|| args.model.with_extension("ron"));
    let to_stdout = output.as_os_str() == "-";
    if !to_stdout && !args.force && output.exists() {
        let name = visible_path(&output);
        return Err(CliError::Usage(format!(
            "{name} already exists\n  = help: choose another name with -o FILE, or replace it with --force"
        )));
    }
    let (origin, file) = Origin::from_model_path(&args.model);
    let scene = Scene::resolve(
        &origin,
        &file,
        &ResolveOptions::with_import(args.load_options.import_options()),
    )?;
    let folder = if to_stdout { Path::new("") } else { output.parent().unwrap_or(Path::new("")) };
    let path = relative_path(folder, &args.model);
    let text =
        starter_scene(&path, &output.display().to_string(), &scene, args.load_options.crease);
    let text = format_source(&path, &text).map_err(ResolveError::from)?;
    if to_stdout {
        print_text(&text)?;
    } else {
        pipeline::write_file(&output, text.as_bytes())?;
        print_text(&format!("{}\n", visible_path(&output)))?;
    }
    if path.starts_with("..") || Path::new(&path).is_absolute() {
        let folder = args.model.parent().filter(|folder| !folder.as_os_str().is_empty());
        let folder = visible_path(folder.unwrap_or(Path::new(".")));
        let message = format!(
            "the model is not below the scene's folder: commands that read the scene need --allow-outside {folder}"
        );
        print_message("warning", &message);
    }
    Ok(())
}

/// Returns the path of a file relative to the scene's folder, with `/` as the separator.
///
/// Makes both paths canonical first, so that symbolic links and `..` do not matter.
///
/// If a path cannot be made canonical, for example because its folder does not exist yet, the
/// file's path is returned unchanged.
fn relative_path(folder: &Path, file: &Path) -> String {
    let here = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let (Ok(from), Ok(to)) = (here.canonicalize(), file.canonicalize()) else {
        return file.display().to_string();
    };
    let common = from.components().zip(to.components()).take_while(|(a, b)| a == b).count();
    let up = from.components().skip(common).map(|_| "..".to_owned());
    let down =
        to.components().skip(common).map(|part| part.as_os_str().to_string_lossy().into_owned());
    up.chain(down).collect::<Vec<_>>().join("/")
}

/// Returns the text of the scene, before formatting.
///
/// Every comment that shows a field is valid RON, so you only need to remove the slashes to try it.
/// Writing to a `String` cannot fail.
///
/// Strings are written with `{:?}`, whose escapes are valid in RON.
fn starter_scene(path: &str, output: &str, scene: &Scene, crease: Option<f64>) -> String {
    let placed = &scene.models[0];
    let model = &placed.model;
    let mut text = header_comment(model, path, output);
    let _ = write!(text, "Scene(\nmodels: [\nModel(\npath: {path:?},\n");
    write_conventions(&mut text, model, crease);
    write_model_states(&mut text, model);
    text.push_str(
        "// translation: (0, 0, 0), rotation_degrees: (0, 30, 0), scale: 1,\n),\n],\ncamera: Camera(\n",
    );
    write_views(&mut text, scene);
    text.push_str("// or Orthographic(), Isometric, Cavalier(), TwoPoint() …\nprojection: Perspective(fov_y_degrees: 35),\n),\n");
    write_light(&mut text, scene);
    text.push_str(
        "\n// or Flat, Wireframe, Lines(hidden: Dashed)\nstyle: Shaded,\n\
         image: Image(\nsize: (960, 720),\n// or Transparent\nbackground: Color(\"#f4f1ea\"),\n",
    );
    let exposure = libm::log2(f64::from(scene.tone_mapper.exposure));
    if placed.model.scene_lights().next().is_some() {
        text.push_str("// Bright lights keep their colors.\ntone_mapping: Neutral,\n");
    }
    if exposure != 0.0 {
        let _ = writeln!(
            text,
            "// In stops; the model's lights are bright.\nexposure_ev: {exposure:.4},"
        );
    }
    text.push_str("),\n// overlays: [Axes(), Grid()],\n)\n");
    text
}

/// Writes a bare model's lighting: its lights or else a key light, and the studio environment.
fn write_light(text: &mut String, scene: &Scene) {
    let placed = &scene.models[0];
    let has_lights = placed.model.scene_lights().next().is_some();
    if has_lights {
        text.push_str("// The lights of the model; more can be added: Directional(direction: (-1, -2, -1), intensity: 2.6).\n");
        text.push_str("lights: [FromModels],\n");
    } else if let Some(Light::Sun { to_light, lux: [lux, ..], .. }) = scene.lights.first() {
        let [x, y, z] = to_light.map(|coordinate| -coordinate);
        text.push_str("// The intensity of a directional light is in lux; a white matte surface has a luminance of intensity / π.\n");
        let _ = writeln!(
            text,
            "lights: [Directional(direction: ({x:.4}, {y:.4}, {z:.4}), intensity: {lux})],"
        );
    }
    let studio = if has_lights { NonNegative::DIMMED_STUDIO } else { NonNegative::BARE_STUDIO };
    let strength = studio.value() / f64::from(scene.tone_mapper.exposure);
    let strength = libm::round(strength * 1e4) / 1e4;
    text.push_str("// or Sky(), Uniform(), File(path: …)\n");
    let _ = writeln!(text, "environment: Studio(strength: {strength}),");
}

/// Returns the comment at the top: the model's size, and commands to try next.
///
/// The commands can be copied unchanged if the path has no spaces.
fn header_comment(model: &Model, path: &str, output: &str) -> String {
    let triangles =
        model.scene_primitives().filter(|(_, part)| part.topology == Topology::Triangles);
    let triangles: usize = triangles.map(|(_, part)| part.item_count()).sum();
    let triangles = files::counted(triangles, "triangle", "triangles");
    let [x, y, z] =
        model.bounds().map_or([0.0; 3], |bounds| (bounds.max() - bounds.min()).raw().to_array());
    format!(
        "// {}: {triangles}, {x:.3} wide, {y:.3} high, {z:.3} deep.\n\
         // Render: alberti render {output}\n\
         // Validate: alberti scene check {output}\n\
         // Reference for all fields: alberti scene doc\n",
        single_line(path)
    )
}

/// Writes the up axis and unit, possibly overridden by flags, unless glTF's, and any crease angle.
fn write_conventions(text: &mut String, model: &Model, crease: Option<f64>) {
    let Model { up_axis, length_unit, .. } = model;
    if (*up_axis, *length_unit) != Default::default() {
        let _ = writeln!(text, "up: {up_axis:?},\nunit: {length_unit:?},");
    }
    crease.iter().for_each(|angle| text.push_str(&format!("crease_degrees: {angle},\n")));
}

/// Writes comments for the scenes, variants and animations that the model offers.
///
/// Items without a name are chosen by index. Nothing is written for a model with one scene and
/// neither variants nor animations.
fn write_model_states(text: &mut String, model: &Model) {
    let names = |all: Vec<Option<&str>>, field: &str, text: &mut String| {
        for (number, name) in all.into_iter().enumerate() {
            let choice = name.map_or(format!("Index({number})"), |name| format!("Name({name:?})"));
            let _ = writeln!(text, "// {field}: {choice},");
        }
    };
    if model.scenes.len() > 1 {
        text.push_str("// Scenes of the model; if none is chosen, its default scene is used:\n");
        names(model.scenes.iter().map(|scene| scene.name.as_deref()).collect(), "scene", text);
    }
    if !model.variants.is_empty() {
        text.push_str("// Material variants of the model:\n");
        names(model.variants.iter().map(|name| Some(name.as_str())).collect(), "variant", text);
    }
    if let Some(longest) = model.animations.iter().map(|one| one.duration_seconds).reduce(f64::max)
    {
        let _ = writeln!(
            text,
            "// Animations of the model, up to {longest:.3} s long, and the time in seconds:"
        );
        names(model.animations.iter().map(|one| one.name.as_deref()).collect(), "animation", text);
        text.push_str("// time: 0.5,\n");
    }
}

/// Writes the default view, with the equivalent `LookAt` and the model's cameras as comments.
///
/// The target of the `LookAt` is the point on the view axis nearest to the center of the model.
///
/// Numbers have four decimals, enough to edit and short enough to read; the active view stays
/// exact, because it has no coordinates.
fn write_views(text: &mut String, scene: &Scene) {
    let model = &scene.models[0].model;
    let camera = scene.view_projection.camera;
    let middle = model.bounds().map(|bounds| bounds.center().raw()).unwrap_or_default();
    let (eye, gaze) = (camera.eye().raw(), camera.gaze().raw());
    let target = eye + gaze * (middle - eye).dot(gaze);
    let triple = |p: glam::DVec3| format!("({:.4}, {:.4}, {:.4})", p.x, p.y, p.z);
    text.push_str("// Frames everything from the front, slightly from the right and above.\n");
    text.push_str(
        "view: Frame(from: ThreeQuarter, padding_percent: 5),\n// The same view in numbers:\n",
    );
    let _ = writeln!(text, "// view: LookAt(eye: {}, target: {}),", triple(eye), triple(target));
    let mut cameras = Vec::new();
    for instance in model.node_instances() {
        let node = &model.nodes[instance.node];
        let Some(number) = node.camera else { continue };
        let name = model.cameras[number].name.as_ref().or(node.name.as_ref());
        cameras.push(name.map_or(format!("Index({number})"), |name| format!("Name({name:?})")));
    }
    if !cameras.is_empty() {
        text.push_str("// Cameras of the model; they include their projections:\n");
    }
    for camera in cameras {
        let _ = writeln!(text, "// view: FromModel({camera}),");
    }
}

/// Replaces control characters, so that a name cannot end a comment.
///
/// Names come from files: a line break in a name would otherwise turn the rest of the name into
/// fields of the scene.
fn single_line(name: &str) -> String {
    name.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}
