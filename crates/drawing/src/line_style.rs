//! How a line drawing looks: which lines are drawn, how hidden ones show, and with what pens.

use super::EdgeClass;
use super::line_type::IsoLineGroup;
use super::options::{DrawOptions, EdgeClasses, HiddenEdges};
use super::page::{Cap, Ink, Join, MILLIMETERS_PER_PIXEL};

/// How a line drawing looks.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LineStyle {
    /// Which lines are drawn.
    pub edges: EdgeSelection,
    /// What becomes of hidden lines.
    pub hidden_lines: HiddenLines,
    /// Two faces that meet at more than this angle, in radians, have an edge between them.
    pub crease_angle: f64,
    /// How much of its contrast the farthest line loses: 0 for none, 1 for all.
    pub depth_cue: f64,
    /// How wide lines are.
    pub line_widths: LineWidths,
    /// The colour of the lines; `None` for a dark or a light one, as the paper wants it.
    pub ink: Option<Ink>,
    /// How lines end.
    pub cap: Cap,
    /// How lines turn corners.
    pub join: Join,
    /// The distance between lines of hatching in millimetres.
    pub hatch_spacing: f64,
    /// What is on the faces under the lines.
    pub face_fill: FaceFill,
}

/// Which lines are drawn.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum EdgeSelection {
    /// The sides of all triangles: a wireframe.
    Facets,
    /// What a draughtsman would draw: outlines, borders, creases, where bodies cross.
    Features,
    /// Features, and where one smooth surface goes over into another.
    Tangents,
    /// Outlines and borders only.
    Silhouette,
}

/// What becomes of hidden lines.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum HiddenLines {
    /// They are not drawn.
    Removed,
    /// They are dashed.
    Dashed,
    /// They are drawn as if the bodies were of glass.
    Drawn,
}

/// What is on the faces under the lines.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum FaceFill {
    /// Nothing.
    None,
    /// A picture in which each face has one tone.
    Flat,
    /// Lines, the closer the darker the face is.
    Hatching,
}

/// How wide lines are.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum LineWidths {
    /// All alike, in pixels of 1/96 inch.
    Pixels(f64),
    /// All alike, in millimetres.
    Millimeters(f64),
    /// Wide and narrow lines as in technical drawing.
    Iso(IsoLineGroup),
}

impl LineStyle {
    /// Features, hidden lines removed, 1.25 pixels wide.
    pub const HIDDEN_REMOVED: Self = Self {
        edges: EdgeSelection::Features,
        hidden_lines: HiddenLines::Removed,
        crease_angle: 30.0 * core::f64::consts::PI / 180.0,
        depth_cue: 0.0,
        line_widths: LineWidths::Pixels(1.25),
        ink: None,
        cap: Cap::Round,
        join: Join::Round,
        hatch_spacing: 2.0,
        face_fill: FaceFill::None,
    };
    /// The same with hidden lines dashed.
    pub const HIDDEN_DASHED: Self =
        Self { hidden_lines: HiddenLines::Dashed, ..Self::HIDDEN_REMOVED };
    /// The sides of all triangles, seen through.
    pub const WIREFRAME: Self = Self {
        edges: EdgeSelection::Facets,
        hidden_lines: HiddenLines::Drawn,
        ..Self::HIDDEN_REMOVED
    };
    /// A wireframe that is paler the farther away it is.
    pub const DEPTH_CUED: Self = Self { depth_cue: 0.8, ..Self::WIREFRAME };
    /// The outline alone.
    pub const SILHOUETTE: Self = Self { edges: EdgeSelection::Silhouette, ..Self::HIDDEN_REMOVED };
    /// Visible, hidden and tangent edges with the line types and widths of ISO 128.
    pub const TECHNICAL: Self = Self {
        edges: EdgeSelection::Tangents,
        hidden_lines: HiddenLines::Dashed,
        line_widths: LineWidths::Iso(IsoLineGroup::MM_0_5),
        ..Self::HIDDEN_REMOVED
    };
}

impl LineStyle {
    /// What must be drawn for it.
    #[must_use]
    pub fn to_draw_options(&self) -> DrawOptions {
        DrawOptions {
            classes: match self.edges {
                // Where surfaces cross there is no side of a triangle.
                EdgeSelection::Facets => EdgeClasses::ALL.without(EdgeClass::Intersection),
                EdgeSelection::Features => EdgeClasses::FEATURES.without(EdgeClass::Tangent),
                EdgeSelection::Tangents => EdgeClasses::FEATURES,
                EdgeSelection::Silhouette => DrawOptions::silhouettes().classes,
            },
            hidden_edges: match self.hidden_lines {
                HiddenLines::Removed => HiddenEdges::Removed,
                HiddenLines::Dashed => HiddenEdges::Retained,
                HiddenLines::Drawn => HiddenEdges::Ignored,
            },
            crease_angle: self.crease_angle,
            hatch_spacing: self.hatch_spacing / MILLIMETERS_PER_PIXEL,
            face_fill: self.face_fill,
            ..DrawOptions::default()
        }
    }
}

impl LineWidths {
    /// The widths of wide and of narrow lines in millimetres.
    #[must_use]
    pub fn wide_and_narrow(self) -> [f64; 2] {
        match self {
            Self::Pixels(pixels) => [pixels * MILLIMETERS_PER_PIXEL; 2],
            Self::Millimeters(width) => [width; 2],
            Self::Iso(group) => [group.wide_width(), group.narrow_width()],
        }
    }
}
