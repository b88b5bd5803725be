//! What a style needs of primitives: what their vertices must carry, what covers what, which sides are seen.

use super::vertices::uv_set;
use crate::scene::Style;
use model::{AlphaMode, Material, Primitive};
use raster::Cover;

/// What a style needs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Needs {
    /// Whether triangles have one normal each.
    pub(super) is_flat: bool,
    /// Whether places and normals are needed also where no light falls.
    pub(super) all: bool,
    /// Whether backs are seen of surfaces with one side.
    pub(super) backs: bool,
    /// How primitives cover what is behind them, if not as their materials have it.
    covers: Covers,
    /// Whether the first texture coordinates are needed.
    uvs: bool,
}

#[derive(Clone, Copy, Debug)]
enum Covers {
    /// As their materials have it.
    Materials,
    /// All are solid, but for the holes of masks.
    Solid,
    /// All in one way.
    As(Cover),
}

impl Needs {
    /// What a style needs; `cover` is how all primitives cover what is behind them, if not as usual.
    pub(super) fn of(style: Style, cover: Option<Cover>) -> Self {
        let usual = match style {
            Style::XRay => Covers::As(Cover::Translucent),
            style if style.look_is_own() => Covers::Solid,
            _ => Covers::Materials,
        };
        Self {
            is_flat: style == Style::Flat,
            all: style.look_is_own(),
            backs: style == Style::XRay,
            covers: cover.map_or(usual, Covers::As),
            uvs: style == Style::UvChecker,
        }
    }

    /// How surfaces of a material cover what is behind them.
    pub(super) fn cover(&self, material: &Material) -> Cover {
        match (self.covers, material.alpha_mode) {
            (Covers::As(cover), _) => cover,
            (Covers::Solid, AlphaMode::Opaque | AlphaMode::Blend) => Cover::Solid,
            _ => cover_of(material),
        }
    }

    /// The set of texture coordinates that vertices carry.
    pub(super) fn uv_set(&self, material: &Material, primitive: &Primitive) -> Option<usize> {
        if self.uvs {
            (!primitive.uvs.is_empty()).then_some(0)
        } else {
            uv_set(material, primitive)
        }
    }
}

/// How surfaces of a material cover what is behind them.
pub(super) fn cover_of(material: &Material) -> Cover {
    match material.alpha_mode {
        AlphaMode::Opaque if material.transmits() => Cover::Translucent,
        AlphaMode::Opaque => Cover::Solid,
        AlphaMode::Mask { .. } => Cover::Masked,
        AlphaMode::Blend => Cover::Translucent,
    }
}
