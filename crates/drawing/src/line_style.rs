//! Line style: the selection of edges, hidden lines, pens and fills of a line drawing.

use super::face_fill::FillOptions;
use hidden_line::{DrawOptions, EdgeClass, EdgeClasses, HiddenEdges, SilhouetteMethod};
use page::palette::{BLACK, BLUEPRINT_BLUE, GRAPHITE, WHITE};
use page::{Cap, Ink, IsoLineGroup, Join, MILLIMETERS_PER_PIXEL};

/// The appearance of a line drawing.
///
/// Constants are complete styles; change one with the update syntax:
///
/// ```
/// use drawing::{HiddenLines, LineStyle, LineWidths};
/// use page::IsoLineGroup;
///
/// let style = LineStyle {
///     line_widths: LineWidths::Iso(IsoLineGroup::MM_0_35),
///     ..LineStyle::TECHNICAL
/// };
/// assert_eq!(style.hidden_lines, HiddenLines::Dashed);
/// assert_eq!(style.line_widths.wide_and_narrow(), [0.35, 0.18]);
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LineStyle {
    /// The edges that are drawn.
    pub edges: EdgeSelection,
    /// The treatment of hidden lines.
    pub hidden_lines: HiddenLines,
    /// Two faces that meet at more than this angle, in radians, have an edge between them.
    pub crease_angle: f64,
    /// Two faces that meet at more than this angle, in radians, but at no crease, have a tangent
    /// edge between them; `None` if only a change of material makes one.
    pub tangent_angle: Option<f64>,
    /// Whether there is no crease where the vertex normals of the file agree on both sides.
    pub asks_normals: bool,
    /// How silhouettes of smooth surfaces are found.
    pub silhouettes: SilhouetteMethod,
    /// The part of its contrast that the farthest line loses: 0 for none, 1 for all.
    pub depth_cue: f64,
    /// The widths of the lines.
    pub line_widths: LineWidths,
    /// The color of the lines; `None` for one that contrasts with the paper.
    pub ink: Option<Ink>,
    /// The color of the paper of sheets; `None` for white.
    pub paper: Option<Ink>,
    /// The ends of lines.
    pub cap: Cap,
    /// The corners of lines.
    pub join: Join,
    /// The distance between hatch lines in millimeters.
    pub hatch_spacing: f64,
    /// The fill of faces under the lines.
    pub face_fill: FaceFill,
    /// How far strokes waver about their true place, in millimeters, as if drawn by hand; 0 for
    /// exact lines.
    pub hand_drawn: f64,
}

/// The edges that a style draws.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum EdgeSelection {
    /// The sides of all triangles: a wireframe.
    Facets,
    /// Silhouettes, boundaries, creases, intersections, section outlines, marked edges, and
    /// tangent edges, where two materials meet smoothly.
    Features,
    /// As `Features`, with tangent edges as narrow lines.
    Tangents,
    /// Silhouettes and boundaries only, also where they run before other surfaces.
    Contours,
    /// The outline alone: edges beside which there is nothing.
    Silhouette,
    /// Closed loops around the whole and its holes; with section planes, around what they cut.
    Outline,
}

/// The treatment of hidden lines.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum HiddenLines {
    /// They are not drawn.
    Removed,
    /// They are dashed.
    Dashed,
    /// They are dashed where at most two faces are in front of them, the two sides of one wall;
    /// those farther behind are not drawn.
    FirstLayer,
    /// They are drawn like visible ones, as if the bodies were of glass.
    Drawn,
}

/// The fill of faces under the lines.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum FaceFill {
    /// No fill.
    None,
    /// An image in which each face has one color, shaded by a fixed key light.
    Flat,
    /// Hatch lines on the faces, the denser the darker a face is.
    Hatching,
    /// Hatch lines on the faces that the key light leaves dark, whatever the colors of the
    /// materials.
    ShadeHatching,
    /// Areas of one gray for each brightness of the materials, whatever the light: tints of the ink.
    /// Section cuts stay blank.
    Gray,
    /// Hatch lines on all faces of an object, at an angle and a spacing that its neighbors do not
    /// have. Where section planes cut, only their cuts are hatched.
    PartHatching,
}

/// The widths of lines.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum LineWidths {
    /// One width for all, in pixels of 1/96 inch.
    Pixels(f64),
    /// One width for all, in millimeters.
    Millimeters(f64),
    /// A wide and a narrow width, as in technical drawings.
    Iso(IsoLineGroup),
}

impl LineWidths {
    /// The widths in a picture that is smaller by a factor, so that it looks as the larger one seen
    /// from farther away; no line is thinner than half a pixel.
    ///
    /// ```
    /// use drawing::LineWidths;
    ///
    /// assert_eq!(LineWidths::Pixels(4.0).scaled(0.25), LineWidths::Pixels(1.0));
    /// assert_eq!(LineWidths::Millimeters(0.3).scaled(0.01), LineWidths::Pixels(0.5));
    /// ```
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        let pixels = match self {
            Self::Pixels(width) => width,
            Self::Millimeters(width) => width / MILLIMETERS_PER_PIXEL,
            Self::Iso(group) => group.wide_width() / MILLIMETERS_PER_PIXEL,
        };
        Self::Pixels((pixels * factor).max(0.5))
    }
}

impl LineStyle {
    /// Features with hidden lines removed, 1.25 pixels wide.
    pub const HIDDEN_REMOVED: Self = Self {
        edges: EdgeSelection::Features,
        hidden_lines: HiddenLines::Removed,
        crease_angle: 30.0 * core::f64::consts::PI / 180.0,
        tangent_angle: None,
        asks_normals: true,
        silhouettes: SilhouetteMethod::Facets,
        depth_cue: 0.0,
        line_widths: LineWidths::Pixels(1.25),
        ink: None,
        paper: None,
        cap: Cap::Round,
        join: Join::Round,
        hatch_spacing: 2.0,
        face_fill: FaceFill::None,
        hand_drawn: 0.0,
    };
    /// Features with hidden lines dashed.
    pub const HIDDEN_DASHED: Self =
        Self { hidden_lines: HiddenLines::Dashed, ..Self::HIDDEN_REMOVED };
    /// The sides of all triangles, none hidden.
    pub const WIREFRAME: Self = Self {
        edges: EdgeSelection::Facets,
        hidden_lines: HiddenLines::Drawn,
        ..Self::HIDDEN_REMOVED
    };
    /// A wireframe whose lines fade with depth.
    pub const DEPTH_CUED: Self = Self { depth_cue: 0.8, ..Self::WIREFRAME };
    /// Silhouettes and boundaries, also where they run before other surfaces.
    pub const CONTOURS: Self = Self { edges: EdgeSelection::Contours, ..Self::HIDDEN_REMOVED };
    /// The outline alone.
    pub const SILHOUETTE: Self = Self { edges: EdgeSelection::Silhouette, ..Self::HIDDEN_REMOVED };
    /// The outline of the whole alone, as closed loops.
    pub const OUTLINE: Self = Self { edges: EdgeSelection::Outline, ..Self::HIDDEN_REMOVED };
    /// Visible, hidden and tangent edges with the line types and widths of ISO 128.
    pub const TECHNICAL: Self = Self {
        edges: EdgeSelection::Tangents,
        hidden_lines: HiddenLines::Dashed,
        line_widths: LineWidths::Iso(IsoLineGroup::MM_0_5),
        ..Self::HIDDEN_REMOVED
    };
    /// Black lines without hidden ones, and faces in shade hatched by thin lines, as in patents.
    pub const PATENT: Self = Self {
        line_widths: LineWidths::Iso(IsoLineGroup::MM_0_35),
        ink: Some(BLACK),
        hatch_spacing: 1.2,
        face_fill: FaceFill::ShadeHatching,
        ..Self::HIDDEN_REMOVED
    };
    /// White lines on blue paper, with the line types and widths of ISO 128.
    pub const BLUEPRINT: Self =
        Self { ink: Some(WHITE), paper: Some(BLUEPRINT_BLUE), ..Self::TECHNICAL };
    /// Lines without hidden ones as drawn by hand, with a pencil.
    pub const SKETCH: Self = Self {
        line_widths: LineWidths::Millimeters(0.3),
        ink: Some(GRAPHITE),
        hand_drawn: 0.35,
        ..Self::HIDDEN_REMOVED
    };
}

impl LineStyle {
    /// The options with which a drawing for this style is made.
    ///
    /// Hatch spacing is converted to pixels of 1/96 inch; a drawing at another scale sets it anew.
    #[must_use]
    pub fn to_draw_options(&self) -> DrawOptions {
        DrawOptions {
            classes: match self.edges {
                // Intersection edges are not sides of triangles, so a wireframe omits them.
                EdgeSelection::Facets => EdgeClasses::ALL.without(EdgeClass::Intersection),
                EdgeSelection::Features | EdgeSelection::Tangents => EdgeClasses::FEATURES,
                EdgeSelection::Contours => DrawOptions::silhouettes().classes,
                EdgeSelection::Silhouette => DrawOptions::outline().classes,
                EdgeSelection::Outline => EdgeClasses::NONE,
            },
            outlines: self.edges == EdgeSelection::Outline,
            hidden_edges: match self.hidden_lines {
                _ if self.edges == EdgeSelection::Outline => HiddenEdges::Ignored,
                HiddenLines::Removed => HiddenEdges::Removed,
                HiddenLines::Dashed => HiddenEdges::Retained,
                HiddenLines::FirstLayer => HiddenEdges::FirstLayer,
                HiddenLines::Drawn => HiddenEdges::Ignored,
            },
            crease_angle: self.crease_angle,
            tangent_angle: self.tangent_angle,
            asks_normals: self.asks_normals,
            silhouettes: self.silhouettes,
            outline_only: self.edges == EdgeSelection::Silhouette,
            hatch_spacing: self.hatch_spacing / MILLIMETERS_PER_PIXEL,
            ..DrawOptions::default()
        }
    }

    /// The fill of a drawing for this style.
    #[must_use]
    pub fn to_fill_options(&self) -> FillOptions {
        FillOptions::new(self.face_fill)
    }
}

impl LineWidths {
    /// The widths of wide and of narrow lines in millimeters.
    #[must_use]
    pub fn wide_and_narrow(self) -> [f64; 2] {
        match self {
            Self::Pixels(pixels) => [pixels * MILLIMETERS_PER_PIXEL; 2],
            Self::Millimeters(width) => [width; 2],
            Self::Iso(group) => [group.wide_width(), group.narrow_width()],
        }
    }
}
