//! What a style needs of primitives: what their vertices must carry, what covers what, which sides are seen.

use super::vertex_processing::material_uv_set;
use crate::scene::Style;
use model::{AlphaMode, Material, Primitive};
use raster::Opacity;

/// What a style needs.
#[derive(Clone, Copy, Debug)]
pub(super) struct VertexInputs {
    /// Whether triangles have one normal each.
    pub(super) is_flat: bool,
    /// Whether places and normals are needed also where no light falls.
    pub(super) forces_lit_inputs: bool,
    /// Whether backs are seen of surfaces with one side.
    pub(super) shows_back_faces: bool,
    /// How primitives cover what is behind them, if not as their materials have it.
    cover_rule: CoverRule,
    /// Whether the first texture coordinates are needed.
    needs_first_uv_set: bool,
}

#[derive(Clone, Copy, Debug)]
enum CoverRule {
    /// As their materials have it.
    FromMaterial,
    /// All are solid, but for the holes of masks.
    ForceSolid,
    /// All in one way.
    Force(Opacity),
}

impl VertexInputs {
    /// What a style needs; `cover` is how all primitives cover what is behind them, if not as usual.
    pub(super) fn for_style(style: Style, cover: Option<Opacity>) -> Self {
        let default_rule = match style {
            Style::XRay => CoverRule::Force(Opacity::Translucent),
            style if style.overrides_materials() => CoverRule::ForceSolid,
            _ => CoverRule::FromMaterial,
        };
        Self {
            is_flat: style == Style::Flat,
            forces_lit_inputs: style.overrides_materials(),
            shows_back_faces: style == Style::XRay,
            cover_rule: cover.map_or(default_rule, CoverRule::Force),
            needs_first_uv_set: style == Style::UvChecker,
        }
    }

    /// How surfaces of a material cover what is behind them.
    pub(super) fn material_cover_in_style(&self, material: &Material) -> Opacity {
        match (self.cover_rule, material.alpha_mode) {
            (CoverRule::Force(cover), _) => cover,
            (CoverRule::ForceSolid, AlphaMode::Opaque | AlphaMode::Blend) => Opacity::Opaque,
            _ => material_cover(material),
        }
    }

    /// The set of texture coordinates that vertices carry.
    pub(super) fn uv_set(&self, material: &Material, primitive: &Primitive) -> Option<usize> {
        if self.needs_first_uv_set {
            (!primitive.uvs.is_empty()).then_some(0)
        } else {
            material_uv_set(material, primitive)
        }
    }
}

/// How surfaces of a material cover what is behind them.
pub(super) fn material_cover(material: &Material) -> Opacity {
    match material.alpha_mode {
        AlphaMode::Opaque if material.is_transmissive() => Opacity::Translucent,
        AlphaMode::Opaque => Opacity::Opaque,
        AlphaMode::Mask { .. } => Opacity::Masked,
        AlphaMode::Blend => Opacity::Translucent,
    }
}
