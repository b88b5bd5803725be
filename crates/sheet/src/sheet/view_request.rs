//! View requests: views in addition to the front, top, side and axonometric views of a sheet, and
//! changes to views.

use camera::NamedView;
use glam::DVec2;
use homog::{Point, Vector, World};
use viewport::DrawingScale;

/// The position, scale and caption of a view on its sheet.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct ViewPlace {
    /// The center of the view, in millimeters from the upper left corner of the paper, or `None` to
    /// place it according to the projection angle or in an empty area.
    pub at: Option<DVec2>,
    /// The scale. `None` means the sheet's scale. A view that is placed in an empty area may get a
    /// smaller scale so that it fits.
    pub scale: Option<DrawingScale>,
    /// The text below the view. `None` means no text, or the letter and scale for views that have
    /// them.
    pub caption: Option<String>,
}

/// A side of a view, as seen on paper.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ViewSide {
    /// The left half.
    Left,
    /// The right half.
    Right,
    /// The upper half.
    Top,
    /// The lower half.
    Bottom,
}

/// A view on a sheet, or a change to one of its views.
///
/// If no [`Named`](Self::Named) view is requested, a sheet has front, top, side and axonometric
/// views in addition to the requested views.
#[derive(Clone, PartialEq, Debug)]
#[non_exhaustive]
pub enum ViewRequest {
    /// The view from a named direction.
    Named {
        /// The direction.
        view: NamedView,
        /// The position, scale and caption.
        place: ViewPlace,
    },
    /// Part of a view at a larger scale. A circle and a letter mark the part in that view.
    Detail {
        /// The view that is enlarged.
        of: NamedView,
        /// The center of the circle, in world space.
        center: Point<World>,
        /// The radius of the circle, in scene units.
        radius: f64,
        /// The position, scale and caption. By default, the scale is two to five times the view's.
        place: ViewPlace,
    },
    /// A section along parallel planes joined by steps (ISO 128-3, 5.4).
    Stepped {
        /// The direction of the removed part.
        removed: Vector<World>,
        /// The corners of the cut line. Pieces perpendicular to `removed` alternate with steps
        /// along it; the line begins and ends with a piece.
        corners: Vec<Point<World>>,
        /// The position, scale and caption.
        place: ViewPlace,
    },
    /// A view of a face that is oblique to the views along the axes, with an arrow and a letter.
    Auxiliary {
        /// The direction in which the face points, toward the viewer.
        facing: Vector<World>,
        /// The position, scale and caption.
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
    /// A view with a local section around a point, bounded by a freehand line (ISO 128-3, 5.6).
    LocalSection {
        /// The view.
        of: NamedView,
        /// The center, a point in the section plane.
        center: Point<World>,
        /// The mean distance of the freehand line from the center, in scene units.
        radius: f64,
    },
    /// A view without part of its length (ISO 128-3, 4.4.7). Dimensions state the full lengths.
    Broken {
        /// The view, or `None` for all views along the axes that show the length.
        of: Option<NamedView>,
        /// The axis of the length: 0 for x, 1 for y, 2 for z.
        axis: usize,
        /// The start of the omitted part along this axis.
        from: f64,
        /// The end of the omitted part.
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
            Self::Broken { of: Some(of), .. } => format!("break in the {of} view"),
            Self::Broken { of: None, .. } => "break".to_owned(),
        }
    }
}
