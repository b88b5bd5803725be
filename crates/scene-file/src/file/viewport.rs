//! Viewports and stereo pairs in a scene file.

use super::background::BackgroundFile;
use super::camera::CameraFile;
use super::look::StyleFile;
use super::overlay::OverlayFile;
use crate::color::Color;
use crate::number::{Fraction, Positive};
use crate::schema::{named_enum, scene_enum, scene_struct};

scene_struct! {
    /// A rectangle with another view, drawn over the picture. It appears in pictures, frame
    /// sequences and line drawings; passes and `explain` use only the scene's camera. In SVG and
    /// PDF all views are line drawings. Set its position with either `at` or `pixels`.
    pub struct ViewportFile as "Viewport" {
        /// Left, top, width and height as fractions of the picture without its caption, from 0 to
        /// 1, measured from the upper left corner. Default: from `pixels`.
        pub at: Option<(Fraction, Fraction, Fraction, Fraction)> = None,
        /// Left, top, width and height in pixels, in the picture without its caption. Default: from
        /// `at`.
        pub pixels: Option<(u32, u32, u32, u32)> = None,
        /// The camera. Default: the scene's.
        pub camera: Option<CameraFile> = None,
        /// The style. Default: the scene's.
        pub style: Option<StyleFile> = None,
        /// The background, fitted to the rectangle. Default: the scene's.
        pub background: Option<BackgroundFile> = None,
        /// The overlays. Default: the scene's.
        pub overlays: Option<Vec<OverlayFile>> = None,
        /// A border, inside the rectangle. Default: none.
        pub border: Option<BorderFile> = None,
        /// A line of text below the view, like the scene's `caption`; the view fills the rest of
        /// the rectangle. Default: none.
        pub caption: Option<String> = None,
    }
}

named_enum! {
    /// The scale of the viewports with parallel projections: orthographic, axonometric and oblique.
    /// Perspective views have no scale and are unchanged.
    pub enum ViewportsScale as "ViewportsScale" {
        Individual = "Each view fills its rectangle.",
        Shared = "All parallel views share the largest scale at which every view fits, so that lengths can be compared. This holds for lines parallel to the picture plane or, in an oblique projection, to the front. No view may set the size of its window.",
    }
}

scene_struct! {
    /// The border of a viewport.
    #[derive(Eq)]
    pub struct BorderFile as "Border" {
        /// The color. Default: black.
        pub color: Color = Color::BLACK,
        /// The width in pixels, from 1 to 1000. Default: 1.
        pub width: u32 = 1,
    }
}

scene_enum! {
    /// A stereo pair: two pictures, for two eyes on either side of the camera. They look in the
    /// same direction through off-axis windows. A point at the convergence distance has the same
    /// position in both, without vertical parallax. The projection must be perspective.
    #[derive(Copy)]
    pub enum StereoFile as "Stereo" {
        /// The left eye's picture in the left half, the right eye's in the right half.
        SideBySide {
            /// The interocular distance, in world units. Default: a thirtieth of the convergence.
            eye_distance: Option<Positive>,
            /// The distance of the plane of zero parallax; nearer objects seem to come out of the
            /// picture. Default: the distance to the center of the models.
            convergence: Option<Positive>,
        },
        /// One picture on top of the other, for red-cyan glasses: red from the left eye's picture,
        /// green and blue from the right eye's.
        Anaglyph {
            /// The interocular distance, in world units. Default: a thirtieth of the convergence.
            eye_distance: Option<Positive>,
            /// The distance of the plane of zero parallax, as for `SideBySide`. Default: the
            /// distance to the center of the models.
            convergence: Option<Positive>,
        },
    }
}
