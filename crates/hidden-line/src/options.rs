//! Options of hidden-line removal: the edge classes, the hidden parts and the faces that go into a
//! drawing.
//!
//! They say what is computed, and nothing of pens, widths and colors.

use super::EdgeClass;
use viewport::MILLIMETERS_PER_INCH;

/// Pixels of a drawing to the inch, where nothing else is said: as in CSS.
const PIXELS_PER_INCH: f64 = 96.0;

/// The content of a line drawing.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct DrawOptions {
    /// The edge classes that are drawn.
    pub classes: EdgeClasses,
    /// The treatment of hidden parts.
    pub hidden_edges: HiddenEdges,
    /// Two faces that meet at more than this angle make a crease: in radians, 0 between coplanar
    /// faces. Default: 30 degrees.
    pub crease_angle: f64,
    /// Two faces that meet at more than this angle, and at no more than a crease, make a tangent
    /// edge, in radians; `None` if only a change of material does. Default: `None`.
    pub tangent_angle: Option<f64>,
    /// Whether an edge with the same vertex normals on both sides is smooth, however sharp: scanned
    /// and sculpted surfaces have such edges. Default: true.
    pub asks_normals: bool,
    /// How silhouettes of smooth surfaces are found. Default: from the facets, exactly.
    pub silhouettes: SilhouetteMethod,
    /// Whether only the outline of everything is drawn: edges beside which there is no face, before
    /// them or behind. Default: false.
    pub outline_only: bool,
    /// The distance between hatch lines in pixels, greater than 0. Default: 2 mm at 96 pixels to
    /// the inch.
    pub hatch_spacing: f64,
    /// Whether the drawing has the outlines of the whole, or of what section planes cut, as regions.
    /// Default: no.
    pub outlines: bool,
    /// Whether faces with parts that their textures cut out, such as leaves on rectangles, neither
    /// have edges nor hide any. Default: false.
    pub leaves_out_cut_outs: bool,
    /// About the greatest number of comparisons of edges with faces, and with boxes around faces:
    /// where it is reached, parts of edges that would be hidden are visible, and the drawing has
    /// the warning [`VisibilityIncomplete`](crate::Warning::VisibilityIncomplete). Each edge may
    /// have 512, whatever the number of edges; all together have no more than 2²⁶ and 4096 for each
    /// face. Default: 2³², minutes of work.
    pub max_comparisons: u64,
    /// Whether drawings have no other limits of work: crowds of faces are drawn exactly as well,
    /// and any number of triangles, of intersections and of comparisons for each face is taken.
    /// Default: false.
    pub is_unlimited: bool,
}

/// The treatment of the hidden parts of edges.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum HiddenEdges {
    /// They are left out.
    Removed,
    /// They are drawn as segments that are not visible, to be dashed.
    Retained,
    /// As `Retained`, where at most two faces are in front of them: the two sides of one wall.
    FirstLayer,
    /// Visibility is not computed: all edges are visible from end to end, as in a wireframe.
    Ignored,
}

/// How the silhouettes of smooth surfaces are found.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum SilhouetteMethod {
    /// They are the sides of triangles where the mesh turns away from the viewer: exact for the
    /// mesh, and in zigzag near the outline of the surface that it stands for.
    Facets,
    /// They run across the triangles, where the interpolated normal is at a right angle to the line
    /// of sight (Hertzmann and Zorin 2000): smooth, and approximate. There can be gaps at cusps, and
    /// where triangles are large the line lies beside what they cover.
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

    /// The edges a draftsman would draw, where they are visible.
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

    /// Those edges with their hidden parts.
    #[must_use]
    pub const fn hidden_edges_retained() -> Self {
        Self { hidden_edges: HiddenEdges::Retained, ..Self::hidden_edges_removed() }
    }

    /// Silhouettes and boundaries, where they are visible.
    #[must_use]
    pub const fn silhouettes() -> Self {
        let classes = EdgeClasses::NONE.with(EdgeClass::Silhouette).with(EdgeClass::Boundary);
        Self { classes, ..Self::hidden_edges_removed() }
    }

    /// The outline of everything.
    #[must_use]
    pub const fn outline() -> Self {
        let classes = EdgeClasses::FEATURES
            .without(EdgeClass::Intersection)
            .without(EdgeClass::Line)
            .without(EdgeClass::Hatching);
        Self { classes, outline_only: true, ..Self::hidden_edges_removed() }
    }

    /// Every side of every face, as if surfaces were of wire.
    #[must_use]
    pub const fn wireframe() -> Self {
        Self {
            classes: EdgeClasses::ALL,
            hidden_edges: HiddenEdges::Ignored,
            ..Self::hidden_edges_removed()
        }
    }
}

/// A set of edge classes, one bit for each.
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

    /// The set with a class added.
    #[must_use]
    pub const fn with(self, class: EdgeClass) -> Self {
        Self(self.0 | 1 << class as u16)
    }

    /// The set with a class removed.
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
