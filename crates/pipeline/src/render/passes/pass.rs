//! The passes there are.

/// What a pass tells of each pixel.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Pass {
    /// How far ahead of the eye the place is, along the view axis, in units of the scene; +∞ where nothing is.
    Depth,
    /// How far the place is from the eye, in units of the scene; +∞ where nothing is.
    Distance,
    /// The unit normal in the world, on the side that is seen: the smooth one of the file, without normal maps. 0 where nothing is.
    Normal,
    /// The same in view space: x to the right, y up, z towards the viewer.
    ViewNormal,
    /// Where the place is in the world; 0 where nothing is.
    Position,
    /// Texture coordinates, of the set `TEXCOORD_0`: u to the right, v down in the texture. 0 where there are none.
    Uv,
    /// The shares of the triangle's three corners; they add up to 1, and are 0 where nothing is.
    Barycentric,
    /// The number of the point, line or triangle, from 1 in the order of the scene; 0 where nothing is.
    Id,
    /// The number of the model in the scene, from 1.
    Model,
    /// The number of the node in its model, from 1: the index of glTF and one.
    Node,
    /// The number of the mesh, in the same way.
    Mesh,
    /// The number of the material, in the same way; 0 also where the default material is.
    Material,
    /// How many fragments cover the pixel's centre, hidden ones too.
    Overdraw,
    /// The share of the pixel's samples that something covers, from 0 to 1.
    Coverage,
}

/// How passes are written.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum PassEncoding {
    /// PNG of 16 bits, with what the codes mean in a text chunk.
    #[default]
    Png,
    /// The numbers themselves, f32 or u32, as NumPy reads them.
    Npy,
}

impl PassEncoding {
    /// The end of the names of its files.
    #[must_use]
    pub const fn file_extension(self) -> &'static str {
        match self {
            Self::Png => "png",
            Self::Npy => "npy",
        }
    }
}

impl Pass {
    /// All of them.
    pub const ALL: [Self; 14] = [
        Self::Depth,
        Self::Distance,
        Self::Normal,
        Self::ViewNormal,
        Self::Position,
        Self::Uv,
        Self::Barycentric,
        Self::Id,
        Self::Model,
        Self::Node,
        Self::Mesh,
        Self::Material,
        Self::Overdraw,
        Self::Coverage,
    ];

    /// Its name in flags and in the names of files.
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
            Self::Node => "node",
            Self::Mesh => "mesh",
            Self::Material => "material",
            Self::Overdraw => "overdraw",
            Self::Coverage => "coverage",
        }
    }

    /// How many numbers a pixel has.
    #[must_use]
    pub const fn channels(self) -> usize {
        match self {
            Self::Normal | Self::ViewNormal | Self::Position | Self::Barycentric => 3,
            Self::Uv => 2,
            _ => 1,
        }
    }

    /// Whether its numbers are whole ones.
    #[must_use]
    pub const fn is_integer(self) -> bool {
        matches!(
            self,
            Self::Id | Self::Model | Self::Node | Self::Mesh | Self::Material | Self::Overdraw
        )
    }

    /// What it has where nothing is seen.
    #[must_use]
    pub const fn empty_value(self) -> f32 {
        if matches!(self, Self::Depth | Self::Distance) { f32::INFINITY } else { 0.0 }
    }
}
