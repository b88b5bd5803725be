//! View requests: the views of a sheet beyond front, top, side and axonometric view, and views that
//! are shown in another way.

use camera::NamedView;
use glam::DVec2;
use homog::{Point, Vector, World};
use viewport::DrawingScale;

/// Where a view stands on its sheet, at what scale, and what is written below it.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct ViewPlace {
    /// The center of the view in millimeters from the upper left corner of the paper; `None` for
    /// the place of the projection angle, or for free room.
    pub at: Option<DVec2>,
    /// The scale; `None` for that of the sheet, and smaller in free room if it must be.
    pub scale: Option<DrawingScale>,
    /// The text below the view; `None` for none, or for letter and scale.
    pub caption: Option<String>,
}

/// A side of a view, as it lies on the paper.
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

/// A view of a sheet, or a way to show one of its views.
///
/// Without a request for a [`Named`](Self::Named) view a sheet has front, top, side and axonometric
/// view, and the requested ones beside them.
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
        /// The center of the circle: a point of the world.
        center: Point<World>,
        /// The radius of the circle, in units of the scene.
        radius: f64,
        /// Its place. Without a scale it is two to five times that of the view.
        place: ViewPlace,
    },
    /// A section along parallel planes that are joined by steps (ISO 128-3, 5.4).
    Stepped {
        /// The direction of what is removed.
        removed: Vector<World>,
        /// The corners of the line of the cut: pieces perpendicular to `removed` in turn with steps
        /// along it, a piece first and a piece last.
        corners: Vec<Point<World>>,
        /// Its place.
        place: ViewPlace,
    },
    /// A view onto a face that is oblique to the views along the axes, by an arrow with a letter.
    Auxiliary {
        /// The direction in which the face looks: towards the viewer.
        facing: Vector<World>,
        /// Its place.
        place: ViewPlace,
    },
    /// A view of which one half is cut, for parts that are symmetric (ISO 128-3, 5.5).
    HalfSection {
        /// The view.
        of: NamedView,
        /// A point of the center line and of the plane of the section; `None` for the center of
        /// the models.
        point: Option<Point<World>>,
        /// The half that is cut.
        side: ViewSide,
    },
    /// A view that is cut around a point, up to a freehand line (ISO 128-3, 5.6).
    LocalSection {
        /// The view.
        of: NamedView,
        /// The center: a point of the plane of the section.
        center: Point<World>,
        /// The mean distance of the freehand line from the center, in units of the scene.
        radius: f64,
    },
    /// A view without a part of its length (ISO 128-3, 4.4.7); dimensions remain true.
    Broken {
        /// The view; `None` for all along the axes that show the length.
        of: Option<NamedView>,
        /// The axis of the length: 0 for x, 1 for y, 2 for z.
        axis: usize,
        /// Where the part that is left out begins on this axis.
        from: f64,
        /// Where it ends.
        to: f64,
    },
}

impl ViewRequest {
    /// The place; `None` of requests that change another view.
    pub(super) const fn place(&self) -> Option<&ViewPlace> {
        match self {
            Self::Named { place, .. }
            | Self::Detail { place, .. }
            | Self::Stepped { place, .. }
            | Self::Auxiliary { place, .. } => Some(place),
            Self::HalfSection { .. } | Self::LocalSection { .. } | Self::Broken { .. } => None,
        }
    }

    /// The name for messages, such as `detail of the front view`.
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
