//! The vertex attributes, opacity and visible faces that a style needs for each draw call.
//!
//! A style that overrides materials (clay, normals, ids …) still needs their alpha values and
//! double-sided flags. Styles that show the base color draw blended materials as translucent; other
//! styles use one color per fragment, with holes instead of translucency. The X-ray style makes
//! everything translucent and also shows back faces.

use super::vertex_processing::material_uv_set;
use model::{AlphaMode, Material, Primitive};
use raster::Opacity;
use scene::Style;

/// The inputs that a style needs.
#[derive(Clone, Copy, Debug)]
pub(super) struct VertexInputs {
    /// Whether each triangle has a single normal (flat shading).
    pub(super) is_flat: bool,
    /// Whether positions and normals are also needed for unlit materials.
    pub(super) forces_lit_inputs: bool,
    /// Whether back faces of single-sided materials are visible.
    pub(super) shows_back_faces: bool,
    /// The rule for deriving opacity from the material.
    opacity_rule: OpacityRule,
    /// Whether the first set of texture coordinates is always needed.
    needs_first_uv_set: bool,
}

/// The rule for the opacity of primitives in a style.
#[derive(Clone, Copy, Debug)]
enum OpacityRule {
    /// Derived from the alpha mode and transmission of the material.
    FromMaterial,
    /// Derived only from the alpha mode.
    AlphaMode,
    /// Opaque, with holes from masked materials and from the textures of blended materials.
    CutOut,
    /// The same opacity for all primitives.
    Force(Opacity),
}

impl VertexInputs {
    /// Returns the inputs that a style needs. `opacity` overrides the opacity of all primitives.
    pub(super) fn for_style(style: Style, opacity: Option<Opacity>) -> Self {
        let default_rule = match style {
            Style::XRay => OpacityRule::Force(Opacity::Translucent),
            Style::Unlit | Style::Gouraud | Style::Toon => OpacityRule::AlphaMode,
            style if style.overrides_materials() => OpacityRule::CutOut,
            _ => OpacityRule::FromMaterial,
        };
        Self {
            is_flat: style == Style::Flat,
            forces_lit_inputs: style.overrides_materials(),
            shows_back_faces: style == Style::XRay,
            opacity_rule: opacity.map_or(default_rule, OpacityRule::Force),
            needs_first_uv_set: style == Style::UvChecker,
        }
    }

    /// Returns the opacity of a material's surfaces in the style.
    pub(super) fn opacity(&self, material: &Material) -> Opacity {
        match (self.opacity_rule, material.alpha_mode) {
            (OpacityRule::Force(opacity), _) => opacity,
            (OpacityRule::AlphaMode | OpacityRule::CutOut, AlphaMode::Opaque) => Opacity::Opaque,
            (OpacityRule::CutOut, AlphaMode::Blend) => Opacity::Masked,
            // Such glass already includes the background in its color, so it can be drawn as
            // opaque: only visible fragments are shaded, without the cost of layers.
            (_, AlphaMode::Opaque) if material.bends_transmitted_light() => Opacity::Opaque,
            _ => material_opacity(material),
        }
    }

    /// Whether a material's surfaces are in the transmission framebuffer, the picture behind glass,
    /// which excludes glass and blended surfaces.
    pub(super) fn is_behind_glass(&self, material: &Material) -> bool {
        self.opacity(material) != Opacity::Translucent && !material.bends_transmitted_light()
    }

    /// Returns the index of the texture coordinate set that vertices carry, if any.
    pub(super) fn uv_set(&self, material: &Material, primitive: &Primitive) -> Option<usize> {
        if self.needs_first_uv_set {
            (!primitive.uvs.is_empty()).then_some(0)
        } else {
            material_uv_set(material, primitive)
        }
    }
}

/// Returns the opacity of a material: its glTF alpha mode, or translucent if it has transmission
/// (`KHR_materials_transmission`).
pub(super) fn material_opacity(material: &Material) -> Opacity {
    match material.alpha_mode {
        AlphaMode::Opaque if material.is_transmissive() => Opacity::Translucent,
        AlphaMode::Opaque => Opacity::Opaque,
        AlphaMode::Mask { .. } => Opacity::Masked,
        AlphaMode::Blend => Opacity::Translucent,
    }
}
