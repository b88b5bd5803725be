//! Random scenes over all projections: lines must match the z-buffer, or the scene must be rejected
//! with a reason.
//!
//! ```text
//!  number ─► splitmix64 ─► scene text ──────► parse, resolve ─► lines ─► verify
//!                                                └► rejected with a reason
//! ```
//!
//! A scene is text, so a failing scene can be written to a file and drawn by the program. Its text
//! depends only on its number. The projections take turns; their parameters include unreasonable
//! values, because the program has to reject those.

use alberti_tests::harness::{Tally, map_parallel};
use hidden_line::{DrawOptions, HiddenEdges, LineDrawing, draw, verify_with_z_buffer};
use import::{ImportOptions, load};
use model::{Model, ModelInstance};
use pipeline::{Origin, Scene, render};
use raster::Samples;
use scene::Style;
use scene_file::parse_scene;
use scene_file::reference::Shape;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::drawing::bits::Random;
use crate::drawing::random_projection::{PROJECTIONS, random_projection};

/// The number of scenes.
pub const COUNT: usize = 1000;

/// The allowed fractions: the limit of `--verify`, the limit for lines hidden by slivers that
/// contain no sample, and the limit for the outline.
const ALLOWED: [f64; 3] = [super::MAX_DISAGREEMENT, 0.005, super::MAX_DISAGREEMENT];

/// Scene models that have only faces and are larger than a few pixels in every view.
const MODELS: [&str; 8] = [
    "bearing.glb",
    "crate.glb",
    "house.glb",
    "lamp.glb",
    "room.glb",
    "table.glb",
    "teapot.glb",
    "vase.glb",
];

/// The outcome of a scene that was drawn or rejected.
enum Verdict {
    /// Three fractions:
    /// - `denied`: of the visible length, the part hidden in the z-buffer
    /// - `contradicted`: of all lines, the part drawn as hidden but visible in the z-buffer
    /// - `unlined`: of the shaded picture's outline, the part without a line
    Drawn { denied: f64, contradicted: f64, unlined: f64 },
    /// The scene was rejected for this reason.
    Refused(String),
}

/// Checks the scenes that have these numbers, records each result, and prints the figures.
pub fn check_random_scenes(numbers: Vec<usize>, folder: &Path) -> Result<Tally, String> {
    check_projections()?;
    let models = load_models(folder)?;
    let count = numbers.len();
    let verdicts = map_parallel(&numbers, |_, &number| {
        let text = scene_text(number, &models);
        check_scene(&text, &models).map_err(|reason| format!("{reason}\n{text}"))
    });
    let mut tally = Tally::default();
    let mut reasons: BTreeMap<String, usize> = BTreeMap::new();
    let mut worst = [(0.0_f64, 0); 3];
    for (number, verdict) in numbers.into_iter().zip(verdicts) {
        let outcome = verdict.and_then(|verdict| match verdict {
            Verdict::Refused(reason) => {
                *reasons.entry(reason).or_default() += 1;
                Ok(())
            }
            Verdict::Drawn { denied, contradicted, unlined } => {
                let measured = [denied, contradicted, unlined];
                for (worst, measured) in worst.iter_mut().zip(measured) {
                    *worst = if measured > worst.0 { (measured, number) } else { *worst };
                }
                let is_right = measured.iter().zip(ALLOWED).all(|(m, allowed)| *m <= allowed);
                let text = scene_text(number, &models);
                if is_right { Ok(()) } else { Err(format!("{}\n{text}", describe(measured))) }
            }
        });
        tally.record(&format!("random/{number}"), outcome);
    }
    let refused: usize = reasons.values().sum();
    println!("{count} random scenes, {refused} rejected; the worst:");
    println!("  {}", describe(worst.map(|(measured, _)| measured)));
    println!("  in the scenes {:?}", worst.map(|(_, number)| number));
    reasons.iter().for_each(|(reason, count)| println!("  rejected {count:4}: {reason}"));
    Ok(tally)
}

/// Returns the projection of a scene. Projections take turns, except that the last projection gets
/// every nineteenth scene.
fn projection_name(number: usize) -> &'static str {
    match PROJECTIONS {
        [.., last] if number % 19 == 18 => last,
        [others @ .., _] => others[number % others.len()],
        [] => "Perspective",
    }
}

/// Checks that every projection of the scene language is used.
fn check_projections() -> Result<(), String> {
    let types = scene_file::reference::all_types();
    let projection = types.iter().find(|entry| entry.name == "Projection").map(|entry| entry.shape);
    let Some(Shape::Variants(variants)) = projection else {
        return Err("the language has no projections".to_owned());
    };
    match variants.iter().find(|variant| !PROJECTIONS.contains(&variant.name)) {
        Some(variant) => Err(format!("no random scene uses the projection {}", variant.name)),
        None => Ok(()),
    }
}

/// Describes the three fractions in words.
fn describe(measured: [f64; 3]) -> String {
    let [denied, contradicted, unlined] = measured.map(|fraction| fraction * 100.0);
    format!(
        "{denied:.4} % of the visible length is hidden, {contradicted:.4} % of all lines is dashed but visible, {unlined:.4} % of the outline has no line"
    )
}

/// Returns the fraction of the shaded picture's outline (pixels next to one without a surface) that
/// has no visible line nearby. Returns 0 if a depth plane cuts the models, because such cuts have
/// no lines.
fn outline_without_line(mut scene: Scene, drawing: &LineDrawing) -> Result<f64, String> {
    let world_to_clip = scene.view_projection.world_to_clip();
    let is_cut = scene.world_points().into_iter().any(|point| {
        let clip = world_to_clip.transform_point(point);
        clip.w() <= 0.0 || clip.z().abs() > clip.w()
    });
    if is_cut {
        return Ok(0.0);
    }
    scene.style = Style::Flat;
    scene.image.background = [0.0; 4];
    scene.image.samples = Samples::One;
    let picture = render(&scene, 1).map_err(|error| error.to_string())?;
    let (width, height) = (scene.image.width, scene.image.height);
    let mut lined = vec![false; (width * height) as usize];
    for segment in drawing.segments.iter().filter(|segment| segment.visible) {
        let [from, to] = segment.ends;
        let steps = ((to - from).length() * 2.0).ceil().max(1.0);
        for step in 0..=steps as u32 {
            let at = from + (to - from) * (f64::from(step) / steps);
            let (x, y) = (at.x.floor() as i64, at.y.floor() as i64);
            for (x, y) in (y - 1..=y + 1).flat_map(|y| (x - 1..=x + 1).map(move |x| (x, y))) {
                if (0..i64::from(width)).contains(&x) && (0..i64::from(height)).contains(&y) {
                    lined[(y * i64::from(width) + x) as usize] = true;
                }
            }
        }
    }
    let is_shown = |x: u32, y: u32| picture.pixel(x, y).is_some_and(|pixel| pixel[3] > 0);
    let (mut outline, mut unlined) = (0_u32, 0_u32);
    for (x, y) in (1..height - 1).flat_map(|y| (1..width - 1).map(move |x| (x, y))) {
        let beside = [(x - 1, y), (x + 1, y), (x, y - 1), (x, y + 1)];
        if is_shown(x, y) && beside.into_iter().any(|(x, y)| !is_shown(x, y)) {
            outline += 1;
            unlined += u32::from(!lined[(y * width + x) as usize]);
        }
    }
    Ok(f64::from(unlined) / f64::from(outline.max(1)))
}

/// Returns the models by file name, with both sides of all surfaces shown, because line drawings do
/// not distinguish back faces.
fn load_models(folder: &Path) -> Result<Vec<(&'static str, Arc<Model>)>, String> {
    let load_model = |name: &'static str| {
        let model = load(&folder.join(name), &ImportOptions::default());
        let mut model = model.map_err(|error| error.to_string())?;
        model.materials.iter_mut().for_each(|material| material.double_sided = true);
        Ok((name, Arc::new(model)))
    };
    MODELS.into_iter().map(load_model).collect()
}

/// Returns the scene with a number.
fn scene_text(number: usize, models: &[(&'static str, Arc<Model>)]) -> String {
    let mut random = Random::new(number as u64);
    let projection = random_projection(projection_name(number), &mut random);
    let (model, _) = random.choose(models);
    let (width, height) = random.choose(&[(480, 360), (360, 480), (400, 400), (640, 240)]);
    let view = random_view(&mut random);
    format!(
        "Scene(\n  models: [(path: \"models/{model}\")],\n  camera: ({view}projection: {projection}),\n  style: Lines(),\n  image: (size: ({width}, {height})),\n)\n"
    )
}

/// Returns a view, or an empty string for the projection's default view.
fn random_view(random: &mut Random) -> String {
    let mut direction = || {
        let [x, y, z] = [0; 3].map(|_| random.between(-1.0, 1.0));
        format!("({x}, {y}, {z})")
    };
    let [from, gaze, eye] = [direction(), direction(), direction()];
    match random.below(8) {
        0 | 1 => String::new(),
        2 | 3 => format!("view: Frame(from: Direction({from})), "),
        4 => {
            let padding = random.below(20);
            format!("view: Frame(from: Direction({from}), padding_percent: {padding}), ")
        }
        5 => format!("view: LookTo(eye: {eye}, gaze: {gaze}), "),
        _ => {
            let [x, y, z] = [0; 3].map(|_| random.between(-9.0, 9.0));
            format!("view: LookAt(eye: ({x}, {y}, {z}), target: {gaze}), ")
        }
    }
}

/// Draws a scene and compares its visible and hidden lines with the z-buffer.
fn check_scene(text: &str, models: &[(&'static str, Arc<Model>)]) -> Result<Verdict, String> {
    let file = parse_scene("random.ron", text).map_err(|errors| errors.to_string());
    let file = match file {
        Ok(file) => file,
        Err(errors) => return Ok(Verdict::Refused(reason_of(&errors))),
    };
    let (name, model) = models
        .iter()
        .find(|(name, _)| file.models[0].path.ends_with(name))
        .ok_or("a missing model")?;
    let origin = Origin::from_text("random.ron", text, PathBuf::from(name));
    let instance = ModelInstance {
        model: Arc::clone(model),
        model_to_world: homog::Affine::scale(1.0, 1.0, 1.0),
    };
    let scene = match Scene::from_models(&origin, &file, &[instance]) {
        Ok(scene) => scene,
        Err(error) => return Ok(Verdict::Refused(reason_of(&error.to_string()))),
    };
    let subject = scene.drawing_subject();
    let options = DrawOptions { hidden_edges: HiddenEdges::Retained, ..DrawOptions::default() };
    let drawing = draw(&subject, &options, 1).map_err(|error| error.to_string())?;
    let agreement =
        verify_with_z_buffer(&subject, &drawing.segments).map_err(|error| error.to_string())?;
    // Distant models have few lines, so a single point matters a lot; two pixels are allowed.
    let visible = agreement.visible_length.max(1000.0);
    let denied = agreement.denied_length / visible;
    let contradicted = agreement.contradicted_length / (visible + agreement.hidden_length);
    let unlined = outline_without_line(scene.clone(), &drawing)?;
    Ok(Verdict::Drawn { denied, contradicted, unlined })
}

/// Returns the message of a rejection without its numbers or location.
fn reason_of(message: &str) -> String {
    let lines: Vec<&str> = message.lines().collect();
    let first = lines.first().map_or("", |line| line.trim());
    let words = first.split_whitespace().map(|word| {
        let is_number = word.trim_matches(|c: char| !c.is_ascii_digit() && c != '-').parse::<f64>();
        if is_number.is_ok() { "…" } else { word }
    });
    words.collect::<Vec<_>>().join(" ")
}
