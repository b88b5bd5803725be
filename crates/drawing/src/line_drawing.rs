//! What the hidden-line engine hands to the outputs: pieces of edges on the screen.

use super::Warning;
use glam::DVec2;
use shade::Picture;

/// Why an edge is drawn.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum EdgeClass {
    /// Between a face that looks to the viewer and one that does not.
    Silhouette,
    /// The border of a surface: only one face ends there.
    Boundary,
    /// Two faces meet at more than the crease angle.
    Crease,
    /// Two surfaces cross.
    Intersection,
    /// The border of a cut through the model.
    Section,
    /// The file marks it as an edge to be drawn.
    Marked,
    /// Two smooth surfaces meet without a visible bend.
    Tangent,
    /// A line primitive of the model.
    Line,
    /// A line of hatching: on a cut face, or for the tone of any face.
    Hatching,
    /// Any other side of a triangle; only wireframes show it.
    Facet,
}

/// A piece of an edge that is visible, or hidden, from end to end.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct EdgeSegment {
    /// The ends on the screen: pixels, y down, in f64.
    pub ends: [DVec2; 2],
    /// The depths of the ends, from 0 at the far plane to 1 at the near plane.
    pub depths: [f64; 2],
    /// Why the edge is drawn.
    pub class: EdgeClass,
    /// Whether nothing is in front of it.
    pub visible: bool,
    /// The object it belongs to: a place in [`LineDrawing::objects`].
    pub object: u32,
    /// The edge it is a piece of, counted through the drawing; all pieces of an edge have the same number.
    pub edge: u32,
}

/// All lines of a scene in a fixed order: by object, by edge, along the edge.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct LineDrawing {
    /// The width and height of the picture in pixels.
    pub size: DVec2,
    /// The names of the objects, as the nodes of the models have them.
    pub objects: Vec<String>,
    /// The pieces.
    pub segments: Vec<EdgeSegment>,
    /// The tones of the faces under the lines, if the options want them flat: a picture that fills the drawing.
    pub face_fill: Option<Picture>,
    /// What could not be drawn as it should, each once.
    pub warnings: Vec<Warning>,
}
