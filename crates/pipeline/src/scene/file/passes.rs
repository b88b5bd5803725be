//! Passes in a scene file: what is written of each pixel besides its colour.

use serde::Deserialize;

/// The passes that `alberti render` writes beside the picture, as `picture.depth.png` and the like.
#[derive(Clone, PartialEq, Debug, Default, Deserialize)]
#[serde(rename = "Passes", deny_unknown_fields, default)]
pub struct PassesFile {
    /// Which ones. Default: none.
    pub write: Vec<PassFile>,
    /// How they are written. Default: `Png`.
    pub encoding: PassEncodingFile,
}

/// What a pass tells of the surface that is nearest at each pixel's centre.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Deserialize)]
#[serde(rename = "Pass")]
pub enum PassFile {
    /// How far ahead of the eye it is along the view axis, in units of the scene.
    Depth,
    /// How far it is from the eye, in units of the scene.
    Distance,
    /// The unit normal in the world, on the side that is seen, without normal maps.
    Normal,
    /// The same in view space: x to the right, y up, z towards the viewer.
    ViewNormal,
    /// The place in the world, in units of the scene.
    Position,
    /// The texture coordinates of `TEXCOORD_0`.
    Uv,
    /// The shares of the triangle's corners, from 0 to 1; they add up to 1.
    Barycentric,
    /// The number of the point, line or triangle in the scene, from 1; 0 where nothing is.
    Id,
    /// The number of the model in the scene, from 1.
    Model,
    /// The number of the node in its model, from 1.
    Node,
    /// The number of the mesh in its model, from 1.
    Mesh,
    /// The number of the material in its model, from 1; 0 also for the default one.
    Material,
    /// How many fragments cover the pixel's centre, hidden ones too.
    Overdraw,
    /// The share of the pixel's samples that something covers, from 0 to 1.
    Coverage,
}

/// How passes are written.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Deserialize)]
#[serde(rename = "PassEncoding")]
pub enum PassEncodingFile {
    /// As PNG of 16 bits; the text chunk `Description` says what the codes mean.
    #[default]
    Png,
    /// As NumPy reads them: f32, or u32 for whole numbers.
    Npy,
}
