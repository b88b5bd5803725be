//! The measured variants: settings, features compared with the picture without them, styles, and
//! commands.

use super::models::BenchModel;
use super::patched_model::Addition;
use super::run::{DRAWING, WALL};
use crate::skip::report_skip;
use std::path::Path;

const SIZE: &str = "1920x1080";
/// The size of turntable frames.
const FRAME_SIZE: &str = "640x360";
/// The size of batch pictures.
const THUMBNAIL_SIZE: &str = "256x256";

/// All styles except `shaded`, the style that they are compared with.
const STYLES: [&str; 16] = [
    "flat",
    "gouraud",
    "clay",
    "matcap",
    "normals",
    "depth",
    "uv",
    "ids",
    "toon",
    "x-ray",
    "wireframe",
    "depth-cued",
    "lines",
    "dashed",
    "silhouette",
    "technical",
];

/// A feature, the flags that enable it, and the flags of the picture without it.
type Feature = (&'static str, &'static [&'static str], &'static [&'static str]);

/// Features that flags enable.
const FEATURES: [Feature; 3] = [
    ("ambient occlusion", &["--ambient-occlusion"], &[]),
    ("AgX tone curve", &["--tone-mapping", "agx"], &["--tone-mapping", "neutral"]),
    ("anisotropy 4 over 1", &["--max-anisotropy", "4"], &["--max-anisotropy", "1"]),
];

/// Features of a light that is added to the model.
const LIGHT_FEATURES: [(Addition, Feature); 3] = [
    (Addition::Sun, ("sun shadows", &["--shadows", "on"], &["--shadows", "off"])),
    (
        Addition::Sun,
        (
            "ground with shadows",
            &["--shadows", "on", "--ground", "shadow"],
            &["--shadows", "on", "--ground", "none"],
        ),
    ),
    (Addition::Spot, ("spot light shadows", &["--shadows", "on"], &["--shadows", "off"])),
];

/// Material extensions that are added to all materials.
const MATERIAL_FEATURES: [(Addition, &str); 2] =
    [(Addition::Transmission, "glass"), (Addition::Iridescence, "iridescence")];

/// The kind of a variant. Each kind has a separate section in the tables.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Group {
    /// The default settings with each number of samples, listed by stage.
    Settings,
    Features,
    /// Styles, each compared with `shaded`.
    Styles,
    /// Thread counts, and commands other than `render`.
    Commands,
}

impl Group {
    /// Returns the title of its tables.
    pub fn title(self) -> &'static str {
        match self {
            Self::Settings => "settings",
            Self::Features => "features",
            Self::Styles => "styles",
            Self::Commands => "threads and commands",
        }
    }
}

/// A call of the program: a command and its arguments, without the output path.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Call {
    /// `render`, `animate` or `batch`.
    pub command: &'static str,
    /// Models and flags.
    pub arguments: Vec<String>,
}

/// A measurement: a call, and the call with which it is compared within each program.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Variant {
    pub group: Group,
    /// Its name in tables.
    pub name: String,
    /// The figure to compare if only one is shown.
    pub figure: &'static str,
    /// The call with the feature.
    pub on: Call,
    /// The call without the feature.
    pub off: Option<Call>,
}

/// Returns the path of the model with an addition, or the reason why it cannot be added.
pub type PatchModel<'a> = &'a dyn Fn(Addition) -> Result<std::path::PathBuf, String>;

/// Returns all variants of one model. Impossible variants are reported on standard output.
pub fn model_variants(model: &BenchModel, frames: usize, patch: PatchModel<'_>) -> Vec<Variant> {
    let path = model.path.as_path();
    let settings = ["1", "4"].map(|samples| Variant {
        group: Group::Settings,
        name: if samples == "1" { "1 sample".into() } else { format!("{samples} samples") },
        figure: DRAWING,
        on: render(path, samples, &[]),
        off: None,
    });
    let mut variants = settings.to_vec();
    variants.extend(FEATURES.map(|feature| flag_feature(path, feature)));
    for (addition, feature) in LIGHT_FEATURES {
        match patch(addition) {
            Ok(lit) => variants.push(flag_feature(&lit, feature)),
            Err(reason) => report_skip(&format!("{} of {}", feature.0, model.name), &reason),
        }
    }
    for (addition, name) in MATERIAL_FEATURES {
        match patch(addition) {
            Ok(changed) => variants.push(compared(
                Group::Features,
                name,
                render(&changed, "4", &[]),
                render(path, "4", &[]),
            )),
            Err(reason) => report_skip(&format!("{name} of {}", model.name), &reason),
        }
    }
    variants.extend(STYLES.map(|style| {
        let [on, off] = [style, "shaded"].map(|style| render(path, "4", &["--style", style]));
        compared(Group::Styles, style, on, off)
    }));
    let [on, off] = ["2", "1"].map(|threads| render(path, "4", &["--threads", threads]));
    variants.push(Variant { figure: WALL, ..compared(Group::Commands, "2 threads", on, off) });
    variants.push(turntable(path, frames));
    variants
}

/// Returns a variant that renders a small picture of every model in one call.
pub fn batch_variant(models: &[BenchModel]) -> Variant {
    let mut arguments: Vec<String> = models.iter().map(|model| text(&model.path)).collect();
    arguments.extend(["--size", THUMBNAIL_SIZE, "--threads", "1"].map(str::to_owned));
    let name = format!("batch at {THUMBNAIL_SIZE}");
    let on = Call { command: "batch", arguments };
    Variant { group: Group::Commands, name, figure: WALL, on, off: None }
}

fn turntable(model: &Path, frames: usize) -> Variant {
    let count = frames.to_string();
    let flags = ["--turntable", "--frames", &count, "--size", FRAME_SIZE, "--threads", "1"];
    let arguments = [text(model)].into_iter().chain(flags.map(str::to_owned)).collect();
    let on = Call { command: "animate", arguments };
    let name = format!("turntable, {frames} frames");
    Variant { group: Group::Commands, name, figure: WALL, on, off: None }
}

fn flag_feature(model: &Path, (name, on, off): Feature) -> Variant {
    compared(Group::Features, name, render(model, "4", on), render(model, "4", off))
}

fn compared(group: Group, name: &str, on: Call, off: Call) -> Variant {
    Variant { group, name: name.to_owned(), figure: DRAWING, on, off: Some(off) }
}

/// Returns a call that renders a picture with one thread, unless the flags say otherwise.
fn render(model: &Path, samples: &str, flags: &[&str]) -> Call {
    let mut arguments = vec![text(model)];
    arguments.extend(["--size", SIZE, "--samples", samples, "--timings"].map(str::to_owned));
    if !flags.contains(&"--threads") {
        arguments.extend(["--threads", "1"].map(str::to_owned));
    }
    arguments.extend(flags.iter().map(|flag| (*flag).to_owned()));
    Call { command: "render", arguments }
}

fn text(path: &Path) -> String {
    path.to_string_lossy().into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::PathBuf;

    fn model() -> BenchModel {
        BenchModel { name: "a".into(), path: "a.glb".into() }
    }

    #[test]
    fn only_the_feature_differs_from_the_counterpart() {
        let variants = model_variants(&model(), 12, &|_| Ok(PathBuf::from("patched.glb")));
        let named = |name: &str| variants.iter().find(|variant| variant.name == name).unwrap();
        let occlusion = named("ambient occlusion");
        let mut off = occlusion.off.clone().unwrap().arguments;
        off.push("--ambient-occlusion".into());
        assert_eq!(occlusion.on.arguments, off);
        let glass = named("glass");
        assert_eq!(glass.on.arguments[1..], glass.off.as_ref().unwrap().arguments[1..]);
        assert_eq!(glass.on.arguments[0], "patched.glb");
        let threads = |call: &Call| call.arguments.iter().filter(|a| *a == "--threads").count();
        assert!(variants.iter().all(|variant| threads(&variant.on) == 1), "one thread option");
    }

    #[test]
    fn variants_that_do_not_apply_to_a_model_are_omitted() {
        let all = model_variants(&model(), 12, &|_| Ok(PathBuf::new())).len();
        let fewer = model_variants(&model(), 12, &|_| Err("no materials".into())).len();
        assert_eq!(all - fewer, LIGHT_FEATURES.len() + MATERIAL_FEATURES.len());
    }
}
