//! Line styles: the edges and hidden lines to draw, and the pens and fills.

use super::face_fill::FillOptions;
use hidden_line::{DrawOptions, EdgeClass, EdgeClasses, HiddenEdges, SilhouetteMethod};
use page::palette::{BLACK, BLUEPRINT_BLUE, GRAPHITE, WHITE};
use page::{Cap, Ink, IsoLineGroup, Join, MILLIMETERS_PER_PIXEL};

/// The style of a line drawing.
///
/// The constants are complete styles. To modify one, use struct update syntax:
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
    /// The edges to draw.
    pub edges: EdgeSelection,
    /// The treatment of hidden lines.
    pub hidden_lines: HiddenLines,
    /// The crease angle in radians: two faces that meet at a larger angle form a crease.
    pub crease_angle: f64,
    /// The tangent angle in radians: two faces that meet at a larger angle without forming a crease
    /// form a tangent edge. With `None`, only a change of material makes a tangent edge.
    pub tangent_angle: Option<f64>,
    /// Whether an edge counts as smooth if the vertex normals in the file agree on both sides.
    pub asks_normals: bool,
    /// The method for silhouettes of smooth surfaces.
    pub silhouettes: SilhouetteMethod,
    /// The fraction of contrast that the farthest line loses: 0 for none, 1 for all.
    pub depth_cue: f64,
    /// The widths of the lines.
    pub line_widths: LineWidths,
    /// The color of the lines, or `None` for a color that contrasts with the paper.
    pub ink: Option<Ink>,
    /// The paper color of sheets, or `None` for white.
    pub paper: Option<Ink>,
    /// The shape of line ends.
    pub cap: Cap,
    /// The shape of line corners.
    pub join: Join,
    /// The distance between hatch lines, in millimeters.
    pub hatch_spacing: f64,
    /// The fill of faces under the lines.
    pub face_fill: FaceFill,
    /// The amplitude, in millimeters, with which hand-drawn strokes waver, or 0 for exact lines.
    pub hand_drawn: f64,
}

/// The edges that a style draws.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum EdgeSelection {
    /// All triangle edges: a wireframe.
    Facets,
    /// Silhouettes, boundaries, creases, intersections, section outlines, marked edges, and tangent
    /// edges where two materials meet smoothly.
    Features,
    /// Like `Features`, plus tangent edges as narrow lines.
    Tangents,
    /// Only silhouettes and boundaries, including those in front of other surfaces.
    Contours,
    /// Only the outline: edges next to the background.
    Silhouette,
    /// Closed loops around the whole scene and its holes or, with section planes, around the cuts.
    Outline,
}

/// The treatment of hidden lines.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum HiddenLines {
    /// Not drawn.
    Removed,
    /// Dashed.
    Dashed,
    /// Dashed if at most two faces, the two sides of one wall, are in front of them; otherwise not
    /// drawn.
    FirstLayer,
    /// Drawn like visible lines, as if the bodies were made of glass.
    Drawn,
}

/// The fill of faces under the lines.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum FaceFill {
    /// No fill.
    None,
    /// An image in which each face has one color, shaded by a fixed key light.
    Flat,
    /// Hatch lines on the faces, denser on darker faces.
    Hatching,
    /// Hatch lines on the faces that the key light leaves dark, regardless of material colors.
    ShadeHatching,
    /// Areas in tints of the ink, one gray for each material brightness, regardless of the light.
    /// Section cuts stay blank.
    Gray,
    /// Hatch lines on all faces of an object, at an angle and spacing that differ between
    /// neighboring objects. With section planes, only the cuts are hatched.
    PartHatching,
}

/// The widths of lines.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum LineWidths {
    /// One width for all lines, in pixels of 1/96 inch.
    Pixels(f64),
    /// One width for all lines, in millimeters.
    Millimeters(f64),
    /// A wide and a narrow width, as in technical drawings.
    Iso(IsoLineGroup),
}

impl LineWidths {
    /// Returns the widths for a picture scaled down by a factor, so that it looks like the larger
    /// picture seen from farther away. No line is thinner than half a pixel.
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
    /// Feature edges with hidden lines removed, 1.25 pixels wide.
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
    /// Feature edges with hidden lines dashed.
    pub const HIDDEN_DASHED: Self =
        Self { hidden_lines: HiddenLines::Dashed, ..Self::HIDDEN_REMOVED };
    /// All triangle edges, without hidden-line removal.
    pub const WIREFRAME: Self = Self {
        edges: EdgeSelection::Facets,
        hidden_lines: HiddenLines::Drawn,
        ..Self::HIDDEN_REMOVED
    };
    /// A wireframe whose lines fade with depth.
    pub const DEPTH_CUED: Self = Self { depth_cue: 0.8, ..Self::WIREFRAME };
    /// Silhouettes and boundaries, including those in front of other surfaces.
    pub const CONTOURS: Self = Self { edges: EdgeSelection::Contours, ..Self::HIDDEN_REMOVED };
    /// Only the outline.
    pub const SILHOUETTE: Self = Self { edges: EdgeSelection::Silhouette, ..Self::HIDDEN_REMOVED };
    /// Only closed loops around the whole scene and its holes.
    pub const OUTLINE: Self = Self { edges: EdgeSelection::Outline, ..Self::HIDDEN_REMOVED };
    /// Visible, hidden and tangent edges with the line types and widths of ISO 128.
    pub const TECHNICAL: Self = Self {
        edges: EdgeSelection::Tangents,
        hidden_lines: HiddenLines::Dashed,
        line_widths: LineWidths::Iso(IsoLineGroup::MM_0_5),
        ..Self::HIDDEN_REMOVED
    };
    /// Black lines with hidden lines removed, and shaded faces hatched with thin lines, as in
    /// patents.
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
    /// Hand-drawn pencil lines with hidden lines removed.
    pub const SKETCH: Self = Self {
        line_widths: LineWidths::Millimeters(0.3),
        ink: Some(GRAPHITE),
        hand_drawn: 0.35,
        ..Self::HIDDEN_REMOVED
    };
}

impl LineStyle {
    /// Returns the options for making a drawing in this style.
    ///
    /// Hatch spacing is converted to pixels of 1/96 inch. At another scale, set it again.
    #[must_use]
    pub fn to_draw_options(&self) -> DrawOptions {
        DrawOptions {
            classes: match self.edges {
                // Intersection edges are not triangle edges, so a wireframe omits them.
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

    /// Returns the fill options for a drawing in this style.
    #[must_use]
    pub fn to_fill_options(&self) -> FillOptions {
        FillOptions::new(self.face_fill)
    }
}

impl LineWidths {
    /// Returns the wide and narrow line widths in millimeters.
    #[must_use]
    pub fn wide_and_narrow(self) -> [f64; 2] {
        match self {
            Self::Pixels(pixels) => [pixels * MILLIMETERS_PER_PIXEL; 2],
            Self::Millimeters(width) => [width; 2],
            Self::Iso(group) => [group.wide_width(), group.narrow_width()],
        }
    }
}
