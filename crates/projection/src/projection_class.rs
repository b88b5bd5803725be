//! The classification tree of planar geometric projections (C73).
//!
//! ```text
//! planar geometric projection
//! ├── parallel
//! │   ├── orthographic
//! │   │   ├── multiview
//! │   │   └── axonometric
//! │   │       ├── isometric
//! │   │       ├── dimetric
//! │   │       └── trimetric
//! │   └── oblique
//! │       ├── cavalier
//! │       ├── cabinet
//! │       ├── military
//! │       └── general oblique
//! └── perspective
//!     ├── one-point
//!     ├── two-point
//!     └── three-point
//! ```

use crate::{
    Axonometric, AxonometricKind, Classical, NPoint, Oblique, ObliqueKind, Planometric,
    PrincipalView, ProjectionError,
};

/// A node of the tree.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum ProjectionClass {
    /// The root: projection onto a plane along straight projectors.
    Planar,
    /// The center of projection is at infinity.
    Parallel,
    /// The projectors are perpendicular to the plane.
    Orthographic,
    /// The plane is parallel to a principal face.
    Multiview,
    /// The plane is not parallel to any principal face.
    Axonometric,
    /// All three axes are foreshortened equally.
    Isometric,
    /// Two axes are foreshortened equally.
    Dimetric,
    /// All three axes are foreshortened differently.
    Trimetric,
    /// The projectors are oblique to the plane.
    Oblique,
    /// Depth is drawn at full length.
    Cavalier,
    /// Depth is drawn at half length.
    Cabinet,
    /// The ground plan has its true shape, and heights are drawn at full length.
    Military,
    /// Depth is drawn at any other length.
    GeneralOblique,
    /// The center of projection is a finite point.
    Perspective,
    /// One axis meets the plane.
    OnePoint,
    /// Two axes meet the plane.
    TwoPoint,
    /// Three axes meet the plane.
    ThreePoint,
}

impl ProjectionClass {
    /// All nodes in the order of the tree, with parents before their children.
    pub const ALL: [Self; 17] = [
        Self::Planar,
        Self::Parallel,
        Self::Orthographic,
        Self::Multiview,
        Self::Axonometric,
        Self::Isometric,
        Self::Dimetric,
        Self::Trimetric,
        Self::Oblique,
        Self::Cavalier,
        Self::Cabinet,
        Self::Military,
        Self::GeneralOblique,
        Self::Perspective,
        Self::OnePoint,
        Self::TwoPoint,
        Self::ThreePoint,
    ];

    /// Returns the common name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Planar => "planar geometric projection",
            Self::Parallel => "parallel",
            Self::Orthographic => "orthographic",
            Self::Multiview => "multiview",
            Self::Axonometric => "axonometric",
            Self::Isometric => "isometric",
            Self::Dimetric => "dimetric",
            Self::Trimetric => "trimetric",
            Self::Oblique => "oblique",
            Self::Cavalier => "cavalier",
            Self::Cabinet => "cabinet",
            Self::Military => "military",
            Self::GeneralOblique => "general oblique",
            Self::Perspective => "perspective",
            Self::OnePoint => "one-point",
            Self::TwoPoint => "two-point",
            Self::ThreePoint => "three-point",
        }
    }

    /// Returns the parent class, or `None` for the root.
    #[must_use]
    pub const fn parent(self) -> Option<Self> {
        match self {
            Self::Planar => None,
            Self::Parallel | Self::Perspective => Some(Self::Planar),
            Self::Orthographic | Self::Oblique => Some(Self::Parallel),
            Self::Multiview | Self::Axonometric => Some(Self::Orthographic),
            Self::Isometric | Self::Dimetric | Self::Trimetric => Some(Self::Axonometric),
            Self::Cavalier | Self::Cabinet | Self::Military | Self::GeneralOblique => {
                Some(Self::Oblique)
            }
            Self::OnePoint | Self::TwoPoint | Self::ThreePoint => Some(Self::Perspective),
        }
    }

    /// Returns the classes directly below this one, in order.
    pub fn children(self) -> impl Iterator<Item = Self> {
        Self::ALL.into_iter().filter(move |class| class.parent() == Some(self))
    }

    /// Returns this class, its parent, and so on up to the root.
    pub fn ancestors(self) -> impl Iterator<Item = Self> {
        core::iter::successors(Some(self), |class| class.parent())
    }

    /// Returns whether this class is a leaf.
    #[must_use]
    pub fn is_leaf(self) -> bool {
        self.children().next().is_none()
    }

    /// Returns the builder for projections of this class, or `None` if the class is not a leaf.
    #[must_use]
    pub const fn builder(self) -> Option<&'static str> {
        Some(match self {
            Self::Multiview => "PrincipalView::{Front, Back, Right, Left, Top, Bottom}",
            Self::Isometric => "Axonometric::isometric()",
            Self::Dimetric => {
                "Axonometric::by_foreshortening(x, y, z), two equal; Axonometric::dimetric_42_7()"
            }
            Self::Trimetric => "Axonometric::by_foreshortening(x, y, z), all different",
            Self::Cavalier => "Oblique::cavalier(phi)",
            Self::Cabinet => "Oblique::cabinet(phi)",
            Self::Military => "Planometric::military(turn)",
            Self::GeneralOblique => {
                "Oblique::new(length, phi), by_angle(alpha, phi), by_direction(direction, z)"
            }
            Self::OnePoint => "NPoint::from_eye(d), ConstructedPerspective::one_point",
            Self::TwoPoint => "NPoint::new(0, q, r), ConstructedPerspective::two_point",
            Self::ThreePoint => "NPoint::new(p, q, r), ConstructedPerspective::three_point",
            Self::Planar
            | Self::Parallel
            | Self::Orthographic
            | Self::Axonometric
            | Self::Oblique
            | Self::Perspective => return None,
        })
    }

    /// Returns a typical projection of this class, as shown in a gallery, or `None` if the class is
    /// not a leaf.
    #[must_use]
    pub fn example(self) -> Option<Classical> {
        let typical: Result<Classical, ProjectionError> = match self {
            Self::Multiview => Ok(PrincipalView::Front.into()),
            Self::Isometric => Ok(Axonometric::isometric().into()),
            Self::Dimetric => Ok(Axonometric::dimetric_42_7().into()),
            Self::Trimetric => Axonometric::by_foreshortening(1.0, 0.9, 0.6).map(Into::into),
            Self::Cavalier => Oblique::cavalier(FROM_LOWER_LEFT).map(Into::into),
            Self::Cabinet => Oblique::cabinet(FROM_LOWER_LEFT).map(Into::into),
            Self::Military => Planometric::military(DEGREES_45).map(Into::into),
            Self::GeneralOblique => Oblique::new(0.7, FROM_LOWER_LEFT).map(Into::into),
            Self::OnePoint => NPoint::from_eye(5.0).map(Into::into),
            Self::TwoPoint => NPoint::new(0.1, 0.0, -0.15).map(Into::into),
            Self::ThreePoint => NPoint::new(0.1, -0.08, -0.15).map(Into::into),
            Self::Planar
            | Self::Parallel
            | Self::Orthographic
            | Self::Axonometric
            | Self::Oblique
            | Self::Perspective => return None,
        };
        typical.ok()
    }
}

const DEGREES_45: f64 = core::f64::consts::FRAC_PI_4;
/// Drawing z, which points to the viewer, to the lower left shows the top and right sides.
const FROM_LOWER_LEFT: f64 = 5.0 * DEGREES_45;

impl Classical {
    /// Returns the leaf of the tree for this projection.
    #[must_use]
    pub fn class(self) -> ProjectionClass {
        match self {
            Self::Multiview(_) => ProjectionClass::Multiview,
            Self::Axonometric(axonometric) => match axonometric.kind() {
                AxonometricKind::Isometric => ProjectionClass::Isometric,
                AxonometricKind::Dimetric => ProjectionClass::Dimetric,
                AxonometricKind::Trimetric => ProjectionClass::Trimetric,
                AxonometricKind::Multiview => ProjectionClass::Multiview,
            },
            Self::Oblique(oblique) => match oblique.kind() {
                ObliqueKind::Orthographic => ProjectionClass::Multiview,
                ObliqueKind::Cavalier => ProjectionClass::Cavalier,
                ObliqueKind::Cabinet => ProjectionClass::Cabinet,
                ObliqueKind::General => ProjectionClass::GeneralOblique,
            },
            Self::Planometric(plan) if plan.height() == 0.0 => ProjectionClass::Multiview,
            Self::Planometric(plan) if plan.height() == 1.0 => ProjectionClass::Military,
            Self::Planometric(_) => ProjectionClass::GeneralOblique,
            Self::NPoint(perspective) => match perspective.count() {
                1 => ProjectionClass::OnePoint,
                2 => ProjectionClass::TwoPoint,
                _ => ProjectionClass::ThreePoint,
            },
        }
    }
}
