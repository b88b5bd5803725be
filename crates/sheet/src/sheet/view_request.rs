//! View requests: additional views of a sheet beyond front, top, side and axonometric views, and
//! changes to views.

use camera::NamedView;
use glam::DVec2;
use homog::{Point, Vector, World};
use viewport::DrawingScale;

/// The position, scale and caption of a view on its sheet.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct ViewPlace {
    /// The center of the view, in millimeters from the upper left corner of the paper, or `None`
    /// for the position given by the projection angle, or for free space.
    pub at: Option<DVec2>,
    /// The scale, or `None` for the sheet's scale, or a smaller one in free space if necessary.
    pub scale: Option<DrawingScale>,
    /// The text below the view, or `None` for none, or for letter and scale.
    pub caption: Option<String>,
}

/// A side of a view, on the paper.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ViewSide {
    /// The half to the left.
    Left,
    /// The half to the right.
    Right,
    /// The upper half.
    Top,
    /// The lower half.
    Bottom,
}

/// A view of a sheet, or a change to one of its views.
///
/// Without a request for a [`Named`](Self::Named) view, a sheet has front, top, side and
/// axonometric views in addition to the requested ones.
#[derive(Clone, PartialEq, Debug)]
#[non_exhaustive]
pub enum ViewRequest {
    /// The view from a named direction.
    Named {
        /// The direction.
        view: NamedView,
        /// Its place.
        place: ViewPlace,
    },
    /// A part of a view at a larger scale, within a circle that the view shows with a letter.
    Detail {
        /// The view that is enlarged.
        of: NamedView,
        /// The center of the circle, in world space.
        center: Point<World>,
        /// The radius of the circle, in scene units.
        radius: f64,
        /// Its place. By default its scale is two to five times the scale of the view.
        place: ViewPlace,
    },
    /// A section along parallel planes joined by steps (ISO 128-3, 5.4).
    Stepped {
        /// The direction of the removed part.
        removed: Vector<World>,
        /// The corners of the cut line: pieces perpendicular to `removed` alternate with steps
        /// along it, beginning and ending with a piece.
        corners: Vec<Point<World>>,
        /// Its place.
        place: ViewPlace,
    },
    /// A view onto a face oblique to the views along the axes, with an arrow and a letter.
    Auxiliary {
        /// The direction that the face points in: toward the viewer.
        facing: Vector<World>,
        /// Its place.
        place: ViewPlace,
    },
    /// A view with one half cut, for symmetric parts (ISO 128-3, 5.5).
    HalfSection {
        /// The view.
        of: NamedView,
        /// A point on the center line and in the section plane, or `None` for the center of the
        /// models.
        point: Option<Point<World>>,
        /// The half that is cut.
        side: ViewSide,
    },
    /// A view cut around a point, up to a freehand line (ISO 128-3, 5.6).
    LocalSection {
        /// The view.
        of: NamedView,
        /// The center: a point in the section plane.
        center: Point<World>,
        /// The mean distance of the freehand line from the center, in scene units.
        radius: f64,
    },
    /// A view without a part of its length (ISO 128-3, 4.4.7); dimensions remain true.
    Broken {
        /// The view, or `None` for all views along the axes that show the length.
        of: Option<NamedView>,
        /// The axis of the length: 0 for x, 1 for y, 2 for z.
        axis: usize,
        /// The start of the omitted part on this axis.
        from: f64,
        /// Its end.
        to: f64,
    },
}

impl ViewRequest {
    /// Returns the place, or `None` for requests that change another view.
    pub(super) const fn place(&self) -> Option<&ViewPlace> {
        match self {
            Self::Named { place, .. }
            | Self::Detail { place, .. }
            | Self::Stepped { place, .. }
            | Self::Auxiliary { place, .. } => Some(place),
            Self::HalfSection { .. } | Self::LocalSection { .. } | Self::Broken { .. } => None,
        }
    }

    /// Returns the name for messages, such as `detail of the front view`.
    pub(super) fn title(&self) -> String {
        match self {
            Self::Named { view, .. } => format!("{view} view"),
            Self::Detail { of, .. } => format!("detail of the {of} view"),
            Self::Stepped { .. } => "stepped section".to_owned(),
            Self::Auxiliary { .. } => "auxiliary view".to_owned(),
            Self::HalfSection { of, .. } => format!("half section of the {of} view"),
            Self::LocalSection { of, .. } => format!("local section of the {of} view"),
            Self::Broken { of: Some(of), .. } => format!("break of the {of} view"),
            Self::Broken { of: None, .. } => "break".to_owned(),
        }
    }
}
