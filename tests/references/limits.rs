//! The maximum allowed difference of each picture from its reference.

use crate::references::score::Score;
use std::path::Path;

/// Upper bounds of [`Score::fraction_above`] and [`Score::silhouette`].
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Limits {
    pub fraction_above: f64,
    pub silhouette: f64,
}

/// The limits for core metallic-roughness and unlit materials.
const CORE: Limits = Limits { fraction_above: 0.010, silhouette: 0.002 };
/// The limits for materials with layers, which renderers combine differently.
const LAYERED_MATERIALS: Limits = Limits { fraction_above: 0.03, silhouette: 0.002 };
/// The extensions that add layers.
const LAYER_EXTENSIONS: [&[u8]; 3] =
    [b"KHR_materials_clearcoat", b"KHR_materials_transmission", b"KHR_materials_sheen"];

/// References from which our pictures deviate intentionally, with the limits that this needs and
/// the reason.
const EXCEPTIONS: [(&str, Limits, &str); 2] = [
    (
        "alpha-blend-mode-test",
        Limits { fraction_above: 0.014, silhouette: 0.0022 },
        "(alpha applies to linear light, §3.9.4, but the reference blends sRGB codes; the upper edge of the BLEND pane is 0.0075 \
     pixels above the centers of a row, and the reference rasterizes in sixteenths of a pixel)",
    ),
    (
        "rough-metals",
        Limits { fraction_above: 0.02, silhouette: 0.002 },
        "(geometric specular antialiasing adds the variation of normals within a pixel to the roughness, mostly at the rim)",
    ),
];

/// Returns the limits of a reference, and the reason for an exception.
pub fn limits_for(name: &str, model: &Path) -> (Limits, &'static str) {
    if let Some((_, limits, why)) = EXCEPTIONS.iter().find(|(known, ..)| *known == name) {
        return (*limits, why);
    }
    let bytes = std::fs::read(model).unwrap_or_default();
    let has = |name: &&[u8]| bytes.windows(name.len()).any(|window| window == *name);
    (if LAYER_EXTENSIONS.iter().any(has) { LAYERED_MATERIALS } else { CORE }, "")
}

impl Limits {
    /// Returns whether a score is within the limits.
    pub fn allow(&self, score: &Score) -> bool {
        score.fraction_above <= self.fraction_above && score.silhouette <= self.silhouette
    }
}
