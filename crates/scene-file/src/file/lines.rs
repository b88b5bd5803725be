//! The style of line drawings in a scene file: which edges, how hidden ones show, how wide.

use crate::color::Color;
use crate::number::{CreaseAngle, HandDrawn, HatchSpacing, Percent, Positive};
use crate::schema::{scene_enum, scene_struct};
use drawing::{EdgeSelection, FaceFill, HiddenLines};
use hidden_line::SilhouetteMethod;
use page::{Cap, Join};

scene_struct! {
    /// The style of a line drawing.
    pub struct LinesFile as "Lines" {
        /// Which edges are drawn. Default: `Features`.
        pub edges: EdgeSelection = EdgeSelection::Features,
        /// How hidden lines are drawn. Default: `Removed`.
        pub hidden: HiddenLines = HiddenLines::Removed,
        /// Faces that meet at more than this angle have a crease edge between them. Default: 30,
        /// but none where the model's vertex normals are the same on both sides of the edge.
        pub crease_degrees: Option<CreaseAngle> = None,
        /// Faces that meet at more than this angle, but at no crease, have a tangent edge between
        /// them, as between a flat face and its fillet. Default: only a change of material has one.
        pub tangent_degrees: Option<CreaseAngle> = None,
        /// How silhouettes of smooth surfaces are found. Default: `Facets`.
        pub silhouettes: SilhouetteMethod = SilhouetteMethod::Facets,
        /// How much of its contrast the farthest line loses. Default: 0.
        pub depth_cue_percent: Percent = Percent::ZERO,
        /// The width of the lines. Default: 1.25 pixels.
        pub width: WidthFile = WidthFile::DEFAULT,
        /// The color of the lines. Default: dark on light, light on dark.
        pub color: Option<Color> = None,
        /// The color of the paper, unless the image has a background. Default: white, which SVG, PDF
        /// and DXF leave out.
        pub paper: Option<Color> = None,
        /// How lines end. Default: `Round`.
        pub cap: Cap = Cap::Round,
        /// How lines join at corners. Default: `Round`.
        pub join: Join = Join::Round,
        /// The distance between hatch lines, in millimeters of the paper, from 0.1 to 1000: on the
        /// section cuts of `sections` and on the parts of `face_fill: PartHatching`, and the closest
        /// on faces with `face_fill: Hatching`. Default: 2.
        pub hatch_spacing_mm: HatchSpacing = HatchSpacing::DEFAULT,
        /// The fill of the faces under the lines. Default: `None`.
        pub face_fill: FaceFill = FaceFill::None,
        /// How far lines waver about their true place, in millimeters of the paper from 0 to 5, as
        /// if drawn by hand; each is drawn twice. Default: 0, exact lines.
        pub hand_drawn_mm: HandDrawn = HandDrawn::EXACT,
    }
}

scene_enum! {
    /// The width of lines.
    #[derive(Copy)]
    pub enum WidthFile as "Width" {
        /// In pixels, of which an inch of paper has 96.
        Px(Positive),
        /// In millimeters.
        Mm(Positive),
        /// A line group of ISO 128 by the width of its wide lines in millimeters: 0.25, 0.35, 0.5,
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
