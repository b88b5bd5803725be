//! How a line drawing looks: which lines are drawn, how hidden ones show, and with what pens.

use super::EdgeClass;
use super::linetype::IsoGroup;
use super::options::{EdgeClasses, Hidden, Options};
use super::page::{Cap, Ink, Join, MILLIMETRES_PER_PIXEL};

/// How a line drawing looks.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LineLook {
    /// Which lines are drawn.
    pub shown: Shown,
    /// What becomes of hidden lines.
    pub hidden: HiddenLines,
    /// Two faces that meet at more than this angle, in radians, have an edge between them.
    pub crease: f64,
    /// How much of its contrast the farthest line loses: 0 for none, 1 for all.
    pub depth_cue: f64,
    /// How wide lines are.
    pub widths: Widths,
    /// The colour of the lines; `None` for a dark or a light one, as the paper wants it.
    pub ink: Option<Ink>,
    /// How lines end.
    pub cap: Cap,
    /// How lines turn corners.
    pub join: Join,
    /// The distance between lines of hatching in millimetres.
    pub hatch: f64,
    /// What is on the faces under the lines.
    pub tone: Tone,
}

/// Which lines are drawn.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Shown {
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
pub enum Tone {
    /// Nothing.
    Blank,
    /// A picture in which each face has one tone.
    Flat,
    /// Lines, the closer the darker the face is.
    Hatching,
}

/// How wide lines are.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Widths {
    /// All alike, in pixels of 1/96 inch.
    Pixels(f64),
    /// All alike, in millimetres.
    Millimetres(f64),
    /// Wide and narrow lines as in technical drawing.
    Iso(IsoGroup),
}

impl LineLook {
    /// Features, hidden lines removed, 1.25 pixels wide.
    pub const REMOVED: Self = Self {
        shown: Shown::Features,
        hidden: HiddenLines::Removed,
        crease: 30.0 * core::f64::consts::PI / 180.0,
        depth_cue: 0.0,
        widths: Widths::Pixels(1.25),
        ink: None,
        cap: Cap::Round,
        join: Join::Round,
        hatch: 2.0,
        tone: Tone::Blank,
    };
    /// The same with hidden lines dashed.
    pub const DASHED: Self = Self { hidden: HiddenLines::Dashed, ..Self::REMOVED };
    /// The sides of all triangles, seen through.
    pub const WIREFRAME: Self =
        Self { shown: Shown::Facets, hidden: HiddenLines::Drawn, ..Self::REMOVED };
    /// A wireframe that is paler the farther away it is.
    pub const DEPTH_CUED: Self = Self { depth_cue: 0.8, ..Self::WIREFRAME };
    /// The outline alone.
    pub const SILHOUETTE: Self = Self { shown: Shown::Silhouette, ..Self::REMOVED };
    /// Visible, hidden and tangent edges with the line types and widths of ISO 128.
    pub const TECHNICAL: Self = Self {
        shown: Shown::Tangents,
        hidden: HiddenLines::Dashed,
        widths: Widths::Iso(IsoGroup::HALF),
        ..Self::REMOVED
    };
}

impl LineLook {
    /// What must be drawn for it.
    #[must_use]
    pub fn options(&self) -> Options {
        Options {
            classes: match self.shown {
                // Where surfaces cross there is no side of a triangle.
                Shown::Facets => EdgeClasses::ALL.without(EdgeClass::Intersection),
                Shown::Features => EdgeClasses::FEATURES.without(EdgeClass::Tangent),
                Shown::Tangents => EdgeClasses::FEATURES,
                Shown::Silhouette => Options::silhouettes().classes,
            },
            hidden: match self.hidden {
                HiddenLines::Removed => Hidden::Removed,
                HiddenLines::Dashed => Hidden::Kept,
                HiddenLines::Drawn => Hidden::Ignored,
            },
            crease: self.crease,
            hatch: self.hatch / MILLIMETRES_PER_PIXEL,
            tone: self.tone,
            ..Options::default()
        }
    }
}

impl Widths {
    /// The widths of wide and of narrow lines in millimetres.
    #[must_use]
    pub fn wide_and_narrow(self) -> [f64; 2] {
        match self {
            Self::Pixels(pixels) => [pixels * MILLIMETRES_PER_PIXEL; 2],
            Self::Millimetres(width) => [width; 2],
            Self::Iso(group) => [group.wide(), group.narrow()],
        }
    }
}
