//! How a scene file wants its picture: the style, the size, the background.

use super::background::BackgroundFile;
use super::lines::{EdgeSelectionFile, HiddenFile, LinesFile, WidthFile};
use crate::scene::number::{Finite, Percent};
use serde::Deserialize;

/// How surfaces are drawn.
#[derive(Clone, PartialEq, Debug, Default, Deserialize)]
#[serde(rename = "Style")]
pub enum StyleFile {
    /// Lit, with the smooth normals of the file.
    #[default]
    Shaded,
    /// Lit, each triangle with one normal.
    Flat,
    /// Lit at the corners of triangles and blended over them, matt, in the colours of the materials.
    Gouraud,
    /// Matt clay in the light of the scene.
    Clay,
    /// As a ball of glazed clay whose surface faces the viewer alike, whatever the light of the scene.
    Matcap,
    /// Normals in the world as colours: red, green and blue are (n + 1) / 2.
    Normals,
    /// The nearer, the brighter.
    Depth,
    /// A checkerboard by texture coordinates, 8 squares for each unit; red grows with u, green with v.
    UvChecker,
    /// A colour for each part.
    Ids,
    /// The colours of the materials in three steps of light, with outlines.
    Toon,
    /// As if of glass: surfaces are denser the more they lie along the line of sight.
    XRay,
    /// The edges of all triangles, the hidden ones too.
    Wireframe,
    /// A line drawing. Default: hidden lines removed.
    Lines(LinesFile),
}

impl StyleFile {
    /// Hidden lines removed.
    #[must_use]
    pub fn lines_hidden_removed() -> Self {
        Self::Lines(LinesFile::default())
    }

    /// Hidden lines dashed.
    #[must_use]
    pub fn lines_hidden_dashed() -> Self {
        Self::Lines(LinesFile { hidden: HiddenFile::Dashed, ..LinesFile::default() })
    }

    /// The outline alone.
    #[must_use]
    pub fn lines_silhouette() -> Self {
        Self::Lines(LinesFile { shown: EdgeSelectionFile::Silhouette, ..LinesFile::default() })
    }

    /// A wireframe that is paler the farther away it is.
    #[must_use]
    pub fn lines_depth_cued() -> Self {
        let (shown, hidden) = (EdgeSelectionFile::Facets, HiddenFile::Drawn);
        let depth_cue_percent = Percent::EIGHTY;
        Self::Lines(LinesFile { shown, hidden, depth_cue_percent, ..LinesFile::default() })
    }

    /// Visible, hidden and tangent edges with the line types and widths of ISO 128.
    #[must_use]
    pub fn lines_technical() -> Self {
        let (shown, hidden, width) =
            (EdgeSelectionFile::Tangents, HiddenFile::Dashed, WidthFile::DEFAULT_ISO);
        Self::Lines(LinesFile { shown, hidden, width, ..LinesFile::default() })
    }
}

/// The picture.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(rename = "Image", deny_unknown_fields, default)]
pub struct ImageFile {
    /// Width and height in pixels, each from 1 to 1048576. Default: (960, 720).
    pub size: (u32, u32),
    /// What is seen where no model is. Default: `Transparent`.
    pub background: BackgroundFile,
    /// Coverage samples per pixel: 1, 4, 8 or 16. Default: 4.
    pub samples: u32,
    /// The bits of each channel in a PNG: 8 or 16. Default: 8.
    pub bits: u32,
    /// The exposure in stops: each doubles all light. Default: 0.
    pub exposure_ev: Option<Finite>,
    /// The curve that brings bright light into the range of a picture. Default: none.
    pub tone_mapping: ToneMappingFile,
    /// How many places textures are read at along the longer side of what a pixel covers of them, from 1 to 8: surfaces that are
    /// seen from the side are blurred with 1, and sharp with more. Default: 4.
    pub anisotropy: u32,
}

impl Default for ImageFile {
    fn default() -> Self {
        Self {
            size: (960, 720),
            background: BackgroundFile::Transparent,
            samples: 4,
            bits: 8,
            exposure_ev: None,
            tone_mapping: ToneMappingFile::None,
            anisotropy: 4,
        }
    }
}

/// The curve that brings light beyond 1 into the range of a picture.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Deserialize)]
#[serde(rename = "ToneMapping")]
pub enum ToneMappingFile {
    /// None: it is cut off.
    #[default]
    None,
    /// Khronos PBR Neutral: keeps colours as they are but for highlights.
    Neutral,
    /// ACES as films have it, by the fit of Hill.
    Aces,
    /// AgX of Sobotka.
    AgX,
}
