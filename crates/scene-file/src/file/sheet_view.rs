//! The views of a drawing sheet in a scene file.

use crate::number::{Finite, Positive, Triple};
use crate::schema::{named_enum, scene_enum};
use camera::NamedView;

scene_enum! {
    /// A view of a drawing sheet, or a way to show one.
    ///
    /// Views along the axes stand about the front view, all others where the sheet is free, and
    /// every view with `at` there. Points and lengths of the models are in the world, those of the
    /// paper in millimeters.
    pub enum SheetViewFile as "SheetView" {
        /// The view from a named direction. A list with views of this kind names all that there
        /// are.
        View {
            /// The direction.
            from: NamedView,
            /// The center of the view on the paper, in millimeters from the left and from the top.
            /// Default: as the projection angle says, or where the sheet is free.
            at: Option<(Finite, Finite)>,
            /// The scale, paper to object; the view then stands where the sheet is free. Default:
            /// that of the sheet.
            scale: Option<(u32, u32)>,
            /// The text below the view. Default: none.
            caption: Option<String>,
        },
        /// A part of a view, enlarged. The view has a circle around it, with a letter.
        Detail {
            /// The view.
            of: NamedView,
            /// The center of the circle; its depth does not matter.
            center: Triple,
            /// The radius of the circle.
            radius: Positive,
            /// The scale, paper to object. Default: two to five times that of the sheet, the
            /// largest that fits.
            scale: Option<(u32, u32)>,
            /// The center of the detail on the paper, in millimeters from the left and from the
            /// top. Default: where the sheet is free.
            at: Option<(Finite, Finite)>,
            /// The text below the detail. Default: letter and scale, such as `B (5:1)`.
            caption: Option<String>,
        },
        /// A section along parallel planes that are joined by steps. It is shown by the view that
        /// looks onto the planes, or by one of its own; the view along the steps has its line.
        Stepped {
            /// The direction of what is removed, perpendicular to the planes.
            normal: Triple,
            /// The corners of the line: two for each plane, and a step from one plane to the next.
            corners: Vec<Triple>,
            /// The center of the section on the paper, in millimeters from the left and from the
            /// top. Default: where the sheet is free, or in the view that looks onto the planes.
            at: Option<(Finite, Finite)>,
            /// The scale, paper to object. Default: that of the sheet.
            scale: Option<(u32, u32)>,
            /// A text below the section, besides its letters. Default: none.
            caption: Option<String>,
        },
        /// A view straight onto an oblique face, with an arrow and a letter in another view.
        Auxiliary {
            /// The direction in which the face looks.
            normal: Triple,
            /// The center of the view on the paper, in millimeters from the left and from the top.
            /// Default: where the sheet is free.
            at: Option<(Finite, Finite)>,
            /// The scale, paper to object. Default: that of the sheet, or smaller.
            scale: Option<(u32, u32)>,
            /// The text below the view. Default: its letter.
            caption: Option<String>,
        },
        /// Cuts one half of a view, for symmetric parts; a center line stands between the halves.
        HalfSection {
            /// The view.
            of: NamedView,
            /// A point of the center line and of the plane. Default: the center of the models.
            point: Option<Triple>,
            /// The half that is cut, as it lies on the paper. Default: `Right`.
            side: ViewSideFile = ViewSideFile::Right,
        },
        /// Cuts a view around a point, up to a freehand line.
        LocalSection {
            /// The view.
            of: NamedView,
            /// The middle of what is cut: a point of the plane of the section.
            center: Triple,
            /// The mean distance of the freehand line from the center.
            radius: Positive,
        },
        /// Leaves out a part of a long model. Dimensions remain those of the whole.
        Broken {
            /// The view. Default: all views along the axes that show the length.
            of: Option<NamedView>,
            /// The axis of the length.
            axis: AxisFile,
            /// Where the part begins on this axis.
            from: Finite,
            /// Where it ends.
            to: Finite,
        },
    }
}

named_enum! {
    /// A half of a view, as it lies on the paper.
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
        Z = "Towards the viewer of the front view.",
    }
}
