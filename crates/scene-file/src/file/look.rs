//! The style and the image of a scene file.

use super::background::BackgroundFile;
use super::lines::{LinesFile, WidthFile};
use crate::color::Color;
use crate::number::{Finite, HandDrawn, HatchSpacing, Percent, PointSize, Positive};
use crate::schema::{scene_enum, scene_struct};
use drawing::{EdgeSelection, FaceFill, HiddenLines};
use page::palette::{BLUEPRINT_BLUE, GRAPHITE};
use shade::ToneMapping;

scene_enum! {
    /// The style, which defines how surfaces are drawn.
    pub enum StyleFile as "Style" {
        /// Physically based shading, with the smooth normals of the file.
        Shaded,
        /// Physically based shading, with one normal per triangle.
        Flat,
        /// The base colors of the materials (albedo), without light, exposure or tone mapping.
        Unlit,
        /// Gouraud shading: matte material colors, lit at the vertices and interpolated.
        Gouraud,
        /// Matte clay in the scene's light.
        Clay,
        /// A material capture of glazed clay: colors from the normal in view space, regardless of
        /// the scene's lights.
        Matcap,
        /// World-space normals as colors: red, green and blue are (n + 1) / 2.
        Normals,
        /// Depth as gray: the nearer, the brighter. It looks best on a black background.
        Depth,
        /// A checkerboard from texture coordinates, with 8 squares per unit; red grows with u,
        /// green with v.
        UvChecker,
        /// A color for each mesh primitive.
        Ids,
        /// Cel shading: the material colors in three steps of light, with outlines.
        Toon,
        /// X-ray: translucent surfaces, denser the more nearly they are seen edge-on.
        XRay,
        /// The edges of all triangles, including hidden ones.
        Wireframe,
        /// A line drawing. Default: hidden lines removed.
        Lines(LinesFile),
    }
}

/// The name of a style in flags, and a function that returns the style.
type NamedStyle = (&'static str, fn() -> StyleFile);

impl StyleFile {
    /// The styles by their names in flags, with default fields.
    pub const NAMED: [NamedStyle; 22] = [
        ("shaded", || Self::Shaded),
        ("flat", || Self::Flat),
        ("unlit", || Self::Unlit),
        ("gouraud", || Self::Gouraud),
        ("clay", || Self::Clay),
        ("matcap", || Self::Matcap),
        ("normals", || Self::Normals),
        ("depth", || Self::Depth),
        ("uv", || Self::UvChecker),
        ("ids", || Self::Ids),
        ("toon", || Self::Toon),
        ("x-ray", || Self::XRay),
        ("wireframe", || Self::Wireframe),
        ("depth-cued", Self::lines_depth_cued),
        ("lines", Self::lines_hidden_removed),
        ("dashed", Self::lines_hidden_dashed),
        ("silhouette", Self::lines_silhouette),
        ("outline", Self::lines_outline),
        ("technical", Self::lines_technical),
        ("patent", Self::lines_patent),
        ("blueprint", Self::lines_blueprint),
        ("sketch", Self::lines_sketch),
    ];

    /// Whether this style receives the light of an environment.
    #[must_use]
    pub const fn shows_environment(&self) -> bool {
        matches!(self, Self::Shaded | Self::Flat | Self::Gouraud | Self::Clay | Self::Toon)
    }

    /// Returns a line drawing with hidden lines removed.
    #[must_use]
    pub fn lines_hidden_removed() -> Self {
        Self::Lines(LinesFile::default())
    }

    /// Returns a line drawing with hidden lines dashed.
    #[must_use]
    pub fn lines_hidden_dashed() -> Self {
        Self::Lines(LinesFile { hidden: HiddenLines::Dashed, ..LinesFile::default() })
    }

    /// Returns a line drawing of only the outline against the background.
    #[must_use]
    pub fn lines_silhouette() -> Self {
        Self::Lines(LinesFile { edges: EdgeSelection::Silhouette, ..LinesFile::default() })
    }

    /// Returns a line drawing of only the outline, as closed loops around the whole shape and its
    /// holes.
    #[must_use]
    pub fn lines_outline() -> Self {
        Self::Lines(LinesFile { edges: EdgeSelection::Outline, ..LinesFile::default() })
    }

    /// Returns a wireframe whose lines fade with depth.
    #[must_use]
    pub fn lines_depth_cued() -> Self {
        let (edges, hidden) = (EdgeSelection::Facets, HiddenLines::Drawn);
        let depth_cue_percent = Percent::EIGHTY;
        Self::Lines(LinesFile { edges, hidden, depth_cue_percent, ..LinesFile::default() })
    }

    /// Returns a line drawing of visible, hidden and tangent edges with the line types and widths
    /// of ISO 128.
    #[must_use]
    pub fn lines_technical() -> Self {
        let (edges, hidden, width) =
            (EdgeSelection::Tangents, HiddenLines::Dashed, WidthFile::DEFAULT_ISO);
        Self::Lines(LinesFile { edges, hidden, width, ..LinesFile::default() })
    }

    /// Returns a drawing in black lines without hidden lines, with shaded faces hatched, as in
    /// patents.
    #[must_use]
    pub fn lines_patent() -> Self {
        Self::Lines(LinesFile {
            width: WidthFile::Iso(Positive::constant(0.35)),
            color: Some(Color::BLACK),
            hatch_spacing_mm: HatchSpacing::PATENT,
            face_fill: FaceFill::ShadeHatching,
            ..LinesFile::default()
        })
    }

    /// Returns a drawing in white lines on blue paper, with the line types and widths of ISO 128.
    #[must_use]
    pub fn lines_blueprint() -> Self {
        Self::Lines(LinesFile {
            edges: EdgeSelection::Tangents,
            hidden: HiddenLines::Dashed,
            width: WidthFile::DEFAULT_ISO,
            color: Some(Color::WHITE),
            paper: Some(Color(BLUEPRINT_BLUE)),
            ..LinesFile::default()
        })
    }

    /// Returns a drawing in lines that look hand-drawn in pencil, without hidden lines.
    #[must_use]
    pub fn lines_sketch() -> Self {
        Self::Lines(LinesFile {
            width: WidthFile::Mm(Positive::constant(0.3)),
            color: Some(Color(GRAPHITE)),
            hand_drawn_mm: HandDrawn::SKETCH,
            ..LinesFile::default()
        })
    }

    /// Returns the style with its ISO 128 line group, if any, limited to suit a picture of this
    /// size in pixels: to 0.25 mm below 300 pixels, and to 0.35 mm below 600.
    #[must_use]
    pub fn with_fitting_lines(self, size: (u32, u32)) -> Self {
        let (width, height) = size;
        let most = match width.min(height) {
            0..300 => 0.25,
            300..600 => 0.35,
            _ => return self,
        };
        match self {
            Self::Lines(mut lines) => {
                if let WidthFile::Iso(wide) = &mut lines.width
                    && wide.value() > most
                {
                    *wide = Positive::constant(most);
                }
                Self::Lines(lines)
            }
            other => other,
        }
    }

    /// Returns the style without hidden lines, if it is a line drawing. A section shows the inside,
    /// where hidden lines would only confuse the reader (ISO 128-3).
    #[must_use]
    pub fn without_hidden_lines(self) -> Self {
        match self {
            Self::Lines(lines) => Self::Lines(LinesFile { hidden: HiddenLines::Removed, ..lines }),
            other => other,
        }
    }
}

scene_struct! {
    /// The image to render.
    pub struct ImageFile as "Image" {
        /// Width and height in pixels, each from 1 to 1048576. Default: (960, 720).
        pub size: (u32, u32) = (960, 720),
        /// The background. Default: `Transparent`; white paper in line drawings, which SVG, PDF and
        /// DXF omit.
        pub background: Option<BackgroundFile> = None,
        /// Coverage samples per pixel (MSAA): 1, 4, 8 or 16. Default: 4.
        pub samples: u32 = 4,
        /// The bits of each channel in a PNG: 8 or 16. Default: 8.
        pub bits: u32 = 8,
        /// The exposure in stops: each stop doubles all light. Default: 0; automatic if there is no
        /// scene file and the model's lights are too bright.
        pub exposure_ev: Option<Finite> = None,
        /// The tone mapping curve, which brings bright light into the range of the picture.
        /// Default: `None`; `Neutral` for a model with lights but without a scene file.
        pub tone_mapping: Option<ToneMapping> = None,
        /// The maximum number of samples for anisotropic texture filtering, from 1 to 8. With 1,
        /// surfaces at grazing angles are blurred; with more, they are sharper. Default: 4.
        pub max_anisotropy: u32 = 4,
        /// The size of the models' points in pixels, from 1 to 256; glTF does not define it. Line
        /// drawings draw points as strokes instead. Default: 3.
        pub point_size: PointSize = PointSize::DEFAULT,
    }
}
