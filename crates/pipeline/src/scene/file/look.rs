//! How a scene file wants its picture: the style, the size, the background.

use serde::Deserialize;

/// How surfaces are drawn.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Deserialize)]
#[serde(rename = "Style")]
pub enum StyleFile {
    /// Lit, with the smooth normals of the file.
    #[default]
    Shaded,
    /// Lit, each triangle with one normal.
    Flat,
    /// The edges of all triangles, the hidden ones too.
    Wireframe,
}

/// The picture.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(rename = "Image", deny_unknown_fields, default)]
pub struct ImageFile {
    /// Width and height in pixels.
    pub size: (u32, u32),
    /// What is seen where no model is.
    pub background: BackgroundFile,
    /// Coverage samples per pixel: 1, 4, 8 or 16.
    pub samples: u32,
}

impl Default for ImageFile {
    fn default() -> Self {
        Self { size: (960, 720), background: BackgroundFile::Transparent, samples: 4 }
    }
}

/// What is seen where no model is.
#[derive(Clone, PartialEq, Eq, Debug, Default, Deserialize)]
#[serde(rename = "Background")]
pub enum BackgroundFile {
    /// Nothing: alpha is 0.
    #[default]
    Transparent,
    /// A colour as on a web page: `#rgb` or `#rrggbb`.
    Color(String),
}
