//! Options for hidden-line removal: the edge classes, hidden parts and faces included in a drawing.
//!
//! They determine which lines are computed, not their pens, widths or colors.

use super::EdgeClass;
use viewport::MILLIMETERS_PER_INCH;

/// The default number of drawing pixels per inch, as in CSS.
const PIXELS_PER_INCH: f64 = 96.0;

/// Options that determine the content of a line drawing.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct DrawOptions {
    /// The edge classes to draw.
    pub classes: EdgeClasses,
    /// The treatment of the hidden parts of edges.
    pub hidden_edges: HiddenEdges,
    /// The crease angle in radians: two faces that meet at a larger angle form a crease. The angle
    /// between coplanar faces is 0. Default: 30 degrees.
    pub crease_angle: f64,
    /// The tangent angle in radians: two faces that meet at a larger angle without forming a crease
    /// form a tangent edge. With `None`, only a change of material makes a tangent edge. Default:
    /// `None`.
    pub tangent_angle: Option<f64>,
    /// Whether an edge with the same vertex normals on both sides counts as smooth, up to an angle
    /// of 85 degrees. Scanned and sculpted surfaces have such edges. Default: true.
    pub asks_normals: bool,
    /// The method for silhouettes of smooth surfaces. Default: exact, from the facets.
    pub silhouettes: SilhouetteMethod,
    /// Whether to draw only the outline of the whole scene: the edges that no face covers on the
    /// screen, at any depth. Default: false.
    pub outline_only: bool,
    /// The distance between hatch lines in pixels, greater than 0. Default: 2 mm at 96 pixels per
    /// inch.
    pub hatch_spacing: f64,
    /// Whether to return outlines as regions: of the section cuts if there are any, otherwise of
    /// the whole scene. Default: false.
    pub outlines: bool,
    /// Whether to ignore faces whose textures have cut-outs, such as leaves on rectangles. Ignored
    /// faces have no edges and hide nothing. Default: false.
    pub leaves_out_cut_outs: bool,
    /// The approximate maximum number of comparisons of edges with faces and with boxes around
    /// faces. If it is reached, some hidden parts of edges are drawn as visible, with the warning
    /// [`VisibilityIncomplete`](crate::Warning::VisibilityIncomplete). An average of 512 per edge
    /// is always allowed. Unless [`is_unlimited`](Self::is_unlimited) is set, the total is also
    /// limited to 2²⁶ plus 4096 per face. Default: 2³², which takes minutes.
    pub max_comparisons: u64,
    /// Whether to lift all other work limits: crowds of faces are also drawn exactly, and any
    /// number of triangles, intersections and comparisons per face is allowed. Default: false.
    pub is_unlimited: bool,
}

/// The treatment of the hidden parts of edges.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum HiddenEdges {
    /// Not drawn.
    Removed,
    /// Returned as segments that are not visible, usually drawn dashed.
    Retained,
    /// Like `Retained`, but only for parts behind at most two faces: the two sides of one wall.
    FirstLayer,
    /// Not computed: every edge is visible from end to end, as in a wireframe.
    Ignored,
}

/// The method for silhouettes of smooth surfaces.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum SilhouetteMethod {
    /// The sides of triangles where the mesh turns away from the viewer: exact for the mesh, but a
    /// zigzag near the outline of the surface that it approximates.
    Facets,
    /// Lines across the triangles, where the interpolated normal is perpendicular to the line of
    /// sight (Hertzmann and Zorin 2000): smooth, but approximate. There can be gaps at cusps, and
    /// with large triangles the line runs beside the covered area instead of along its border.
    Interpolated,
}

impl Default for DrawOptions {
    fn default() -> Self {
        Self::hidden_edges_removed()
    }
}

impl DrawOptions {
    /// 30 degrees, in radians.
    const DEFAULT_CREASE_ANGLE: f64 = std::f64::consts::FRAC_PI_6;

    /// Returns options for the visible edges that a draftsman would draw.
    #[must_use]
    pub const fn hidden_edges_removed() -> Self {
        Self {
            classes: EdgeClasses::FEATURES,
            hidden_edges: HiddenEdges::Removed,
            crease_angle: Self::DEFAULT_CREASE_ANGLE,
            tangent_angle: None,
            asks_normals: true,
            silhouettes: SilhouetteMethod::Facets,
            outline_only: false,
            hatch_spacing: 2.0 / (MILLIMETERS_PER_INCH / PIXELS_PER_INCH),
            outlines: false,
            leaves_out_cut_outs: false,
            max_comparisons: 1 << 32,
            is_unlimited: false,
        }
    }

    /// Returns options for the edges that a draftsman would draw, including their hidden parts.
    #[must_use]
    pub const fn hidden_edges_retained() -> Self {
        Self { hidden_edges: HiddenEdges::Retained, ..Self::hidden_edges_removed() }
    }

    /// Returns options for visible silhouettes and boundaries.
    #[must_use]
    pub const fn silhouettes() -> Self {
        let classes = EdgeClasses::NONE.with(EdgeClass::Silhouette).with(EdgeClass::Boundary);
        Self { classes, ..Self::hidden_edges_removed() }
    }

    /// Returns options for the outline of the whole scene.
    #[must_use]
    pub const fn outline() -> Self {
        let classes = EdgeClasses::FEATURES
            .without(EdgeClass::Intersection)
            .without(EdgeClass::Line)
            .without(EdgeClass::Hatching);
        Self { classes, outline_only: true, ..Self::hidden_edges_removed() }
    }

    /// Returns options for every side of every face, as if surfaces were made of wire.
    #[must_use]
    pub const fn wireframe() -> Self {
        Self {
            classes: EdgeClasses::ALL,
            hidden_edges: HiddenEdges::Ignored,
            ..Self::hidden_edges_removed()
        }
    }
}

/// A set of edge classes, one bit per class.
///
/// ```
/// use hidden_line::{EdgeClass, EdgeClasses};
///
/// let outlines = EdgeClasses::NONE.with(EdgeClass::Silhouette).with(EdgeClass::Boundary);
/// assert!(outlines.contains(EdgeClass::Boundary) && !outlines.contains(EdgeClass::Crease));
/// assert!(!EdgeClasses::FEATURES.contains(EdgeClass::Facet));
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct EdgeClasses(u16);

impl EdgeClasses {
    /// The empty set.
    pub const NONE: Self = Self(0);

    /// Every class.
    pub const ALL: Self = Self(u16::MAX);

    /// Every class except facets.
    pub const FEATURES: Self = Self::ALL.without(EdgeClass::Facet);

    /// Returns the set with a class added.
    #[must_use]
    pub const fn with(self, class: EdgeClass) -> Self {
        Self(self.0 | 1 << class as u16)
    }

    /// Returns the set with a class removed.
    #[must_use]
    pub const fn without(self, class: EdgeClass) -> Self {
        Self(self.0 & !(1 << class as u16))
    }

    /// Whether a class is in the set.
    #[must_use]
    pub const fn contains(self, class: EdgeClass) -> bool {
        self.0 >> class as u16 & 1 == 1
    }
}
