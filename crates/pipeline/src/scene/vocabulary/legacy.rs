//! Words of older scene files by place. `alberti scene fmt` writes the new ones.

/// A word that was replaced.
#[derive(Clone, Copy, Debug)]
pub(in crate::scene) struct LegacyWord {
    /// The struct, variant (`Light::Directional`) or enum that the word stands in, by its name of
    /// today.
    pub(in crate::scene) owner: &'static str,
    pub(in crate::scene) old: &'static str,
    pub(in crate::scene) new: &'static str,
}

/// A row of the table.
const fn word(owner: &'static str, old: &'static str, new: &'static str) -> LegacyWord {
    LegacyWord { owner, old, new }
}

/// Every word that was replaced.
pub(in crate::scene) const LEGACY_WORDS: &[LegacyWord] = &[
    word("Light", "Sun", "Directional"),
    word("Light::Directional", "lux", "intensity"),
    word("Light::Point", "candela", "intensity"),
    word("Light::Spot", "candela", "intensity"),
    word("Light::Spot", "inner_degrees", "inner_cone_degrees"),
    word("Light::Spot", "outer_degrees", "outer_cone_degrees"),
    word("Light::Ambient", "lux", "intensity"),
    word("Model", "translate", "translation"),
    word("Model", "rotate_degrees", "rotation_degrees"),
    word("Instance", "translate", "translation"),
    word("Instance", "rotate_degrees", "rotation_degrees"),
    word("Instances::Circle", "turned", "rotate_copies"),
    word("Projection::Military", "turn_degrees", "rotation_degrees"),
    word("Environment::Studio", "rotate_degrees", "rotation_degrees"),
    word("Environment::File", "rotate_degrees", "rotation_degrees"),
    word("Image", "anisotropy", "max_anisotropy"),
    word("Lines", "shown", "edges"),
    word("Lines", "tone", "face_fill"),
    word("Lines", "hatch_mm", "hatch_spacing_mm"),
    word("FaceFill", "Blank", "None"),
    word("Sheet", "angle", "projection_angle"),
    word("Sheet", "side", "side_view"),
    word("Sheet", "axonometric", "axonometric_view"),
    word("Unit", "Metre", "Meter"),
    word("Unit", "Centimetre", "Centimeter"),
    word("Unit", "Millimetre", "Millimeter"),
];
