//! The style of line drawings in a scene file: choice of edges, hidden lines and line widths.

use crate::color::Color;
use crate::number::{CreaseAngle, HandDrawn, HatchSpacing, Percent, Positive};
use crate::schema::{scene_enum, scene_struct};
use drawing::{EdgeSelection, FaceFill, HiddenLines};
use hidden_line::SilhouetteMethod;
use page::{Cap, Join};

scene_struct! {
    /// The style of a line drawing.
    pub struct LinesFile as "Lines" {
        /// The edges to draw. Default: `Features`.
        pub edges: EdgeSelection = EdgeSelection::Features,
        /// The treatment of hidden lines. Default: `Removed`.
        pub hidden: HiddenLines = HiddenLines::Removed,
        /// Faces that meet at more than this angle have a crease edge between them. Default: 30,
        /// but no crease edge where the model's vertex normals are the same on both sides.
        pub crease_degrees: Option<CreaseAngle> = None,
        /// Faces that meet at more than this angle without a crease, such as a flat face and its
        /// fillet, have a tangent edge between them. Default: only where the material changes.
        pub tangent_degrees: Option<CreaseAngle> = None,
        /// The method for finding silhouettes of smooth surfaces. Default: `Facets`.
        pub silhouettes: SilhouetteMethod = SilhouetteMethod::Facets,
        /// The contrast that the farthest line loses, in percent. Default: 0.
        pub depth_cue_percent: Percent = Percent::ZERO,
        /// The width of the lines. Default: 1.25 pixels.
        pub width: WidthFile = WidthFile::DEFAULT,
        /// The color of the lines. Default: dark on light, light on dark.
        pub color: Option<Color> = None,
        /// The color of the paper, unless the image has a background. Default: white, which SVG,
        /// PDF and DXF omit.
        pub paper: Option<Color> = None,
        /// The shape of line ends. Default: `Round`.
        pub cap: Cap = Cap::Round,
        /// The shape of line joins. Default: `Round`.
        pub join: Join = Join::Round,
        /// The distance between hatch lines, in millimeters on paper, from 0.1 to 1000. It applies
        /// to the section cuts of `sections` and to the parts of `face_fill: PartHatching`; with
        /// `face_fill: Hatching` it is the smallest distance. Default: 2.
        pub hatch_spacing_mm: HatchSpacing = HatchSpacing::DEFAULT,
        /// The fill of the faces under the lines. Default: `None`.
        pub face_fill: FaceFill = FaceFill::None,
        /// The amplitude of the wobble of hand-drawn lines, from 0 to 5 millimeters on paper.
        /// Unless it is 0, each line is drawn twice. Default: 0, exact lines.
        pub hand_drawn_mm: HandDrawn = HandDrawn::EXACT,
    }
}

scene_enum! {
    /// The width of lines.
    #[derive(Copy)]
    pub enum WidthFile as "Width" {
        /// In pixels, 96 per inch of paper.
        Px(Positive),
        /// In millimeters.
        Mm(Positive),
        /// An ISO 128 line group, by the width of its wide lines in millimeters: 0.25, 0.35, 0.5,
        /// 0.7, 1, 1.4 or 2. Narrow lines are half as wide.
        Iso(Positive),
    }
}

impl WidthFile {
    /// 1.25 pixels.
    pub const DEFAULT: Self = Self::Px(Positive::constant(1.25));
    /// 0.5 mm and 0.25 mm.
    pub const DEFAULT_ISO: Self = Self::Iso(Positive::constant(0.5));
}
