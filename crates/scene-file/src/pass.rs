//! The render passes, with the type, channels and empty value of each.
//!
//! | passes | type | channels | empty |
//! | --- | --- | --- | --- |
//! | depth, distance | f32 | 1 | +∞ |
//! | normal, view-normal, position, barycentric | f32 | 3 | 0 |
//! | uv | f32 | 2 | 0 |
//! | coverage | f32 | 1 | 0 |
//! | id, model, object, node, mesh, material, overdraw | u32 | 1 | 0 |

/// A render pass: one quantity per pixel, from the nearest surface at its center.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Pass {
    /// Distance from the eye along the view axis (planar depth), in scene units; +∞ for background
    /// pixels.
    Depth,
    /// Distance from the eye, in scene units; +∞ for background pixels.
    Distance,
    /// Unit normal in world space, on the visible side: the interpolated vertex normal, without
    /// normal maps. 0 for background pixels.
    Normal,
    /// Unit normal in view space: x to the right, y up, z toward the viewer.
    ViewNormal,
    /// Position in world space; 0 for background pixels.
    Position,
    /// Texture coordinates from the set `TEXCOORD_0`: u to the right, v down in the texture. 0 for
    /// surfaces without them.
    Uv,
    /// Barycentric weights of the triangle's vertices; their sum is 1, or 0 for background pixels.
    Barycentric,
    /// Primitive id of the point, line or triangle, counted from 1 in scene order; 0 for background
    /// pixels.
    Id,
    /// The model, counted from 1 in scene order; 0 for background pixels.
    Model,
    /// The object: an instance of a mesh, counted from 1 through all models. Copies of a model and
    /// of an instanced mesh (EXT_mesh_gpu_instancing) are different objects. 0 for background
    /// pixels.
    Object,
    /// The node, counted from 1 through all models; in the first model, its glTF index plus 1. 0
    /// for background pixels.
    Node,
    /// The mesh, counted from 1 through all different models; in the first, its glTF index plus 1.
    /// 0 for background pixels.
    Mesh,
    /// The material, counted like meshes; 0 also for the default material.
    Material,
    /// Number of fragments at the pixel's center, including hidden ones.
    Overdraw,
    /// Fraction of the pixel's samples that a surface covers, from 0 to 1.
    Coverage,
}

/// The file format of a pass.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum PassEncoding {
    /// PNG with 16 bits per channel; a text chunk explains the codes.
    #[default]
    Png,
    /// NumPy array of the exact values, f32 or u32.
    Npy,
    /// OpenEXR image of the exact values, f32 or u32, for compositing programs.
    Exr,
}

impl PassEncoding {
    /// Returns the file name extension, without a dot.
    #[must_use]
    pub const fn file_extension(self) -> &'static str {
        match self {
            Self::Png => "png",
            Self::Npy => "npy",
            Self::Exr => "exr",
        }
    }
}

impl Pass {
    /// All passes.
    pub const ALL: [Self; 15] = [
        Self::Depth,
        Self::Distance,
        Self::Normal,
        Self::ViewNormal,
        Self::Position,
        Self::Uv,
        Self::Barycentric,
        Self::Id,
        Self::Model,
        Self::Object,
        Self::Node,
        Self::Mesh,
        Self::Material,
        Self::Overdraw,
        Self::Coverage,
    ];

    /// Returns the name in flags and in file names.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Depth => "depth",
            Self::Distance => "distance",
            Self::Normal => "normal",
            Self::ViewNormal => "view-normal",
            Self::Position => "position",
            Self::Uv => "uv",
            Self::Barycentric => "barycentric",
            Self::Id => "id",
            Self::Model => "model",
            Self::Object => "object",
            Self::Node => "node",
            Self::Mesh => "mesh",
            Self::Material => "material",
            Self::Overdraw => "overdraw",
            Self::Coverage => "coverage",
        }
    }

    /// Returns the number of values per pixel.
    #[must_use]
    pub const fn channels(self) -> usize {
        match self {
            Self::Normal | Self::ViewNormal | Self::Position | Self::Barycentric => 3,
            Self::Uv => 2,
            _ => 1,
        }
    }

    /// Whether the values are integers.
    #[must_use]
    pub const fn is_integer(self) -> bool {
        matches!(
            self,
            Self::Id
                | Self::Model
                | Self::Object
                | Self::Node
                | Self::Mesh
                | Self::Material
                | Self::Overdraw
        )
    }

    /// Returns the value for background pixels.
    #[must_use]
    pub const fn empty_value(self) -> f32 {
        if matches!(self, Self::Depth | Self::Distance) { f32::INFINITY } else { 0.0 }
    }
}
