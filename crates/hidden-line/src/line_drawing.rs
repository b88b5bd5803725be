//! Line drawing: the result of hidden-line removal as segments on the screen.
//!
//! ```text
//!   edge 7   ●━━━━━━━━━━●╌╌╌╌╌╌╌●━━━━━━━●     three segments: visible, hidden, visible;
//!            0         s₁      s₂       1     neighbors share their endpoints bit for bit
//! ```

use super::{Region, Warning};
use glam::DVec2;

/// The reason why an edge is drawn: the first class that applies, in order of importance.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum EdgeClass {
    /// An edge between a front-facing and a back-facing face.
    Silhouette,
    /// The border of a surface: an edge with a single face.
    Boundary,
    /// An edge where two faces meet at more than the crease angle.
    Crease,
    /// A segment where two faces intersect.
    Intersection,
    /// The outline of a section through a model.
    Section,
    /// A side or line that the file marks as an edge.
    Marked,
    /// An edge without a crease, between different materials or at more than the tangent angle.
    Tangent,
    /// A line primitive, or a point primitive drawn as a stroke of two pixels.
    Line,
    /// A hatch line on a section cap or on another face.
    Hatching,
    /// Any other side of a triangle; drawn only in wireframes.
    Facet,
}

impl EdgeClass {
    /// All classes, in order of importance.
    pub const ALL: [Self; 10] = [
        Self::Silhouette,
        Self::Boundary,
        Self::Crease,
        Self::Intersection,
        Self::Section,
        Self::Marked,
        Self::Tangent,
        Self::Line,
        Self::Hatching,
        Self::Facet,
    ];

    /// Returns the name of the class, in lower case.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Silhouette => "silhouette",
            Self::Boundary => "boundary",
            Self::Crease => "crease",
            Self::Intersection => "intersection",
            Self::Section => "section",
            Self::Marked => "marked",
            Self::Tangent => "tangent",
            Self::Line => "line",
            Self::Hatching => "hatching",
            Self::Facet => "facet",
        }
    }
}

/// A segment of an edge that is either visible or hidden from end to end.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct EdgeSegment {
    /// The ends on the screen, in pixels, with y down.
    pub ends: [DVec2; 2],
    /// The depths of the ends, 0 at the far plane and 1 at the near plane.
    pub depths: [f64; 2],
    /// The reason why the edge is drawn.
    pub class: EdgeClass,
    /// Whether the segment is visible: no face is in front of it.
    pub visible: bool,
    /// The object that the edge belongs to: an index into [`LineDrawing::objects`].
    pub object: u32,
    /// The index of the edge in the drawing, shared by all its segments.
    pub edge: u32,
}

/// All segments of a scene in a fixed order: by object, then by edge, then along the edge.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct LineDrawing {
    /// The width and height of the image in pixels.
    pub size: DVec2,
    /// The object names, from the nodes of the models.
    pub objects: Vec<String>,
    /// The visible segments, and the hidden segments if the options retain them.
    pub segments: Vec<EdgeSegment>,
    /// The visible section caps with their hatch patterns, and the outlines if requested.
    pub regions: Vec<Region>,
    /// Warnings about the drawing, without duplicates.
    pub warnings: Vec<Warning>,
}

impl LineDrawing {
    /// Whether the drawing is empty.
    pub fn is_empty(&self) -> bool {
        self.segments.is_empty() && self.regions.is_empty()
    }
}
