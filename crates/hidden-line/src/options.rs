//! Options of hidden-line removal: the edge classes, hidden parts and faces included in a drawing.
//!
//! They control the computed lines, not pens, widths or colors.

use super::EdgeClass;
use viewport::MILLIMETERS_PER_INCH;

/// The default number of drawing pixels per inch, as in CSS.
const PIXELS_PER_INCH: f64 = 96.0;

/// The content of a line drawing.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct DrawOptions {
    /// The edge classes that are drawn.
    pub classes: EdgeClasses,
    /// The treatment of hidden parts.
    pub hidden_edges: HiddenEdges,
    /// Two faces that meet at more than this angle form a crease, in radians, 0 between coplanar
    /// faces. Default: 30 degrees.
    pub crease_angle: f64,
    /// Two faces that meet at more than this angle, but do not form a crease, form a tangent edge,
    /// in radians; `None` if only a change of material does. Default: `None`.
    pub tangent_angle: Option<f64>,
    /// Whether an edge with the same vertex normals on both sides is smooth, however sharp: scanned
    /// and sculpted surfaces have such edges. Default: true.
    pub asks_normals: bool,
    /// The method for silhouettes of smooth surfaces. Default: exact, from the facets.
    pub silhouettes: SilhouetteMethod,
    /// Whether to draw only the outline of everything: edges with no face beside them, in front or
    /// behind. Default: false.
    pub outline_only: bool,
    /// The distance between hatch lines in pixels, greater than 0. Default: 2 mm at 96 pixels per
    /// inch.
    pub hatch_spacing: f64,
    /// Whether to add the outlines of the whole, or of the cuts of section planes, as regions.
    /// Default: no.
    pub outlines: bool,
    /// Whether to ignore faces whose textures have cut-outs, such as leaves on rectangles: they
    /// neither have edges nor hide any. Default: false.
    pub leaves_out_cut_outs: bool,
    /// The approximate maximum number of comparisons of edges with faces and with boxes around
    /// faces. If it is reached, some hidden parts of edges are drawn as visible, with the warning
    /// [`VisibilityIncomplete`](crate::Warning::VisibilityIncomplete). Each edge may have 512, for
    /// any number of edges; all together have at most 2²⁶ plus 4096 per face. Default: 2³², minutes
    /// of work.
    pub max_comparisons: u64,
    /// Whether to lift all other work limits: crowds of faces are drawn exactly too, and any number
    /// of triangles, intersections and comparisons per face is allowed. Default: false.
    pub is_unlimited: bool,
}

/// The treatment of the hidden parts of edges.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum HiddenEdges {
    /// Not drawn.
    Removed,
    /// Drawn as segments that are not visible, to be dashed.
    Retained,
    /// Like `Retained`, if at most two faces are in front of them: the two sides of one wall.
    FirstLayer,
    /// Not computed: all edges are visible from end to end, as in a wireframe.
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
    /// with large triangles the line is beside the covered area.
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

    /// Options for the visible edges that a draftsman would draw.
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

    /// Options for those edges with their hidden parts.
    #[must_use]
    pub const fn hidden_edges_retained() -> Self {
        Self { hidden_edges: HiddenEdges::Retained, ..Self::hidden_edges_removed() }
    }

    /// Options for visible silhouettes and boundaries.
    #[must_use]
    pub const fn silhouettes() -> Self {
        let classes = EdgeClasses::NONE.with(EdgeClass::Silhouette).with(EdgeClass::Boundary);
        Self { classes, ..Self::hidden_edges_removed() }
    }

    /// Options for the outline of everything.
    #[must_use]
    pub const fn outline() -> Self {
        let classes = EdgeClasses::FEATURES
            .without(EdgeClass::Intersection)
            .without(EdgeClass::Line)
            .without(EdgeClass::Hatching);
        Self { classes, outline_only: true, ..Self::hidden_edges_removed() }
    }

    /// Options for every side of every face, as if surfaces were made of wire.
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

    /// All but facets.
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
