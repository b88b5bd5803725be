//! Ambient occlusion leaves no dark dots where surfaces end, with any number of samples.

use super::styles::keep_few;
use pipeline::{Origin, Picture, Scene, render};
use scene_file::parse_scene;
use std::path::Path;

/// Models with inner silhouettes: a torus that overlaps itself, dense meshes, and a helmet full of
/// edges.
const MODELS: [&str; 5] =
    ["bearing", "dense-sphere-draco-quantized", "flight-helmet", "teapot", "torus"];
/// The sample counts to test.
const SAMPLES: [u32; 4] = [1, 4, 8, 16];
/// The fraction of its neighbors' light below which a pixel is a dot.
const DOT: f64 = 0.25;

/// Returns the dots in a model's pictures in uniform light, or none for models that are not listed.
pub(super) fn find_dots(model: &Path, name: &str) -> Vec<String> {
    let mut faults = Vec::new();
    if !MODELS.contains(&name) {
        return faults;
    }
    let mut counts = SAMPLES.to_vec();
    keep_few(&mut counts, name, 1);
    for samples in counts {
        let picture = |occlusion| render_model(model, samples, occlusion).unwrap_or_default();
        let visibility = Visibility::of_pictures(&picture("ambient_occlusion: ()"), &picture(""));
        if visibility.mean() > 0.999 {
            faults.push(format!("{samples} samples: nothing is occluded"));
        }
        for [x, y] in visibility.dots() {
            faults.push(format!("{samples} samples: occlusion leaves a dot at {x}, {y}"));
        }
    }
    faults
}

/// Returns a picture of a model that is lit from all directions.
fn render_model(model: &Path, samples: u32, occlusion: &str) -> Option<Picture> {
    let (folder, file) = (model.parent()?, model.file_name()?.to_str()?);
    let text = format!(
        r#"Scene(models: [(path: "{file}")], lights: [Ambient(intensity: 3)],
        image: (size: (400, 300), samples: {samples}), {occlusion})"#
    );
    let scene = parse_scene("made.ron", &text).ok()?;
    let origin = Origin::from_text("made.ron", text, folder.to_path_buf());
    render(&Scene::resolve(&origin, &scene, &Default::default()).ok()?, 1).ok()
}

/// The fraction of the light that remains at each pixel after occlusion.
struct Visibility {
    width: usize,
    /// The fractions in rows from the top; NaN for pixels without a surface or with a black
    /// surface.
    values: Vec<f64>,
}

impl Visibility {
    fn of_pictures(with: &Picture, without: &Picture) -> Self {
        let pairs = with.pixels.iter().zip(&without.pixels);
        let values = pairs.map(|(with, without)| {
            let is_visible = without[3] == 255 && without[1] >= 30;
            if is_visible { linear(with[1]) / linear(without[1]) } else { f64::NAN }
        });
        Self { width: with.width as usize, values: values.collect() }
    }

    /// Returns the mean over all surfaces.
    fn mean(&self) -> f64 {
        let known = || self.values.iter().filter(|value| !value.is_nan());
        known().sum::<f64>() / known().count() as f64
    }

    /// Returns the pixels that are much darker than the median of the 3 × 3 pixels around them.
    fn dots(&self) -> Vec<[usize; 2]> {
        let height = self.values.len() / self.width.max(1);
        let inner =
            (1..height.saturating_sub(1)).flat_map(|y| (1..self.width - 1).map(move |x| [x, y]));
        inner.filter(|&pixel| self.at(pixel) < DOT * self.median_around(pixel)).collect()
    }

    fn at(&self, [x, y]: [usize; 2]) -> f64 {
        self.values[y * self.width + x]
    }

    fn median_around(&self, [x, y]: [usize; 2]) -> f64 {
        let around = (y - 1..=y + 1).flat_map(|y| (x - 1..=x + 1).map(move |x| [x, y]));
        let mut known: Vec<f64> =
            around.map(|pixel| self.at(pixel)).filter(|value| !value.is_nan()).collect();
        known.sort_unstable_by(f64::total_cmp);
        known.get(known.len() / 2).copied().unwrap_or(f64::NAN)
    }
}

/// Converts an sRGB code to linear light.
fn linear(code: u8) -> f64 {
    let srgb = f64::from(code) / 255.0;
    if srgb <= 0.04045 { srgb / 12.92 } else { libm::pow((srgb + 0.055) / 1.055, 2.4) }
}
