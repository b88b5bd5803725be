//! The views of a drawing sheet in a scene file.

use crate::number::{Finite, Positive, Triple};
use crate::schema::{named_enum, scene_enum};
use camera::NamedView;

scene_enum! {
    /// A view of a drawing sheet, or a way to show one.
    ///
    /// Views along the axes are arranged around the front view, all others where there is room;
    /// `at` sets a view's position. Points and lengths on the models are in world space, positions
    /// on paper in millimeters.
    pub enum SheetViewFile as "SheetView" {
        /// The view from a named direction. If a list contains views of this kind, they replace the
        /// standard views.
        View {
            /// The direction.
            from: NamedView,
            /// The center of the view on the paper, in millimeters from the left and from the top.
            /// Default: according to the projection angle, or where there is room.
            at: Option<(Finite, Finite)>,
            /// The scale, paper to object; if it is set, the view is placed where there is room.
            /// Default: the sheet's scale.
            scale: Option<(u32, u32)>,
            /// The text below the view. Default: none.
            caption: Option<String>,
        },
        /// An enlarged part of a view, marked there by a circle with a letter.
        Detail {
            /// The view.
            of: NamedView,
            /// The center of the circle; its depth does not matter.
            center: Triple,
            /// The radius of the circle.
            radius: Positive,
            /// The scale, paper to object. Default: two to five times the sheet's scale, the
            /// largest that fits.
            scale: Option<(u32, u32)>,
            /// The center of the detail on the paper, in millimeters from the left and from the
            /// top. Default: where there is room.
            at: Option<(Finite, Finite)>,
            /// The text below the detail. Default: its letter and scale, such as `B (5:1)`.
            caption: Option<String>,
        },
        /// A section along parallel planes joined by steps. It is shown in the view that faces the
        /// planes, or in a separate view. The view along the steps shows the cutting line.
        Stepped {
            /// The direction of the removed side, perpendicular to the planes.
            normal: Triple,
            /// The corners of the cutting line: two for each plane, with a step from one plane to
            /// the next.
            corners: Vec<Triple>,
            /// The center of the section on the paper, in millimeters from the left and from the
            /// top. Default: where there is room, or in the view that faces the planes.
            at: Option<(Finite, Finite)>,
            /// The scale, paper to object. Default: the sheet's scale.
            scale: Option<(u32, u32)>,
            /// The text below the section, in addition to its letters. Default: none.
            caption: Option<String>,
        },
        /// A view perpendicular to an oblique face, with an arrow and a letter in another view.
        Auxiliary {
            /// The direction in which the face points.
            normal: Triple,
            /// The center of the view on the paper, in millimeters from the left and from the top.
            /// Default: where there is room.
            at: Option<(Finite, Finite)>,
            /// The scale, paper to object. Default: the sheet's scale, or smaller.
            scale: Option<(u32, u32)>,
            /// The text below the view. Default: its letter.
            caption: Option<String>,
        },
        /// Cuts one half of a view, for symmetric parts; a center line separates the halves.
        HalfSection {
            /// The view.
            of: NamedView,
            /// A point on both the center line and the cutting plane. Default: the center of the
            /// models.
            point: Option<Triple>,
            /// The half that is cut, as seen on the paper. Default: `Right`.
            side: ViewSideFile = ViewSideFile::Right,
        },
        /// Cuts a view open around a point, up to a freehand line.
        LocalSection {
            /// The view.
            of: NamedView,
            /// The center of the cut: a point on the section plane.
            center: Triple,
            /// The mean distance of the freehand line from the center.
            radius: Positive,
        },
        /// Omits a part of a long model. Dimensions still give the full length.
        Broken {
            /// The view. Default: all views along the axes that show the length.
            of: Option<NamedView>,
            /// The axis along the length.
            axis: AxisFile,
            /// The start of the omitted part on this axis.
            from: Finite,
            /// The end of the omitted part.
            to: Finite,
        },
    }
}

named_enum! {
    /// A half of a view, as seen on the paper.
    pub enum ViewSideFile as "ViewSide" {
        Left = "The left half.",
        Right = "The right half.",
        Top = "The upper half.",
        Bottom = "The lower half.",
    }
}

named_enum! {
    /// An axis of the world.
    pub enum AxisFile as "Axis" {
        X = "To the right in the front view.",
        Y = "Up in the front view.",
        Z = "Toward the viewer of the front view.",
    }
}
