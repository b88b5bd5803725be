//! The camera of a scene file: where it is, and how it projects.

use super::projection::ProjectionFile;
use crate::scene::number::{NonNegative, Triple};
use camera::NamedView;
use serde::Deserialize;

/// The camera: where it is, and how it projects.
#[derive(Clone, PartialEq, Debug, Default, Deserialize)]
#[serde(rename = "Camera", deny_unknown_fields, default)]
pub struct CameraFile {
    /// Where the eye is and where it looks. Default: framed from the side that suits the projection.
    pub view: ViewFile,
    /// The projection; a camera of the model's brings its own. Default: perspective.
    pub projection: Option<ProjectionFile>,
}

/// Where the eye is and where it looks.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(rename = "View", deny_unknown_fields)]
pub enum ViewFile {
    /// From a place towards another.
    LookAt {
        /// The place of the eye.
        eye: Triple,
        /// The place looked at, which becomes the centre of the picture.
        target: Triple,
        /// The view-up vector: the direction that is to point up in the picture. Default: y.
        #[serde(default = "Triple::y_axis")]
        up: Triple,
    },
    /// From a place in a direction.
    LookTo {
        /// The place of the eye.
        eye: Triple,
        /// The direction of gaze.
        gaze: Triple,
        /// The view-up vector. Default: y.
        #[serde(default = "Triple::y_axis")]
        up: Triple,
    },
    /// From a direction, at the distance at which everything just fits.
    Frame {
        /// Where from. Default: `ThreeQuarter`, and `Front` for classical projections.
        from: Option<FromFile>,
        /// The margin on each side, in per cent of the picture's side. Default: 5.
        #[serde(default = "default_padding")]
        padding_percent: NonNegative,
    },
    /// A camera of the first model that has cameras.
    FromModel(CameraChoice),
}

impl Default for ViewFile {
    fn default() -> Self {
        Self::Frame { from: None, padding_percent: DEFAULT_PADDING }
    }
}

/// The margin, in per cent, of framed pictures that name none.
pub const DEFAULT_PADDING: NonNegative = NonNegative::FIVE;

fn default_padding() -> NonNegative {
    DEFAULT_PADDING
}

/// The direction a picture is framed from.
#[derive(Clone, PartialEq, Debug, Default, Deserialize)]
#[serde(rename = "From")]
pub enum FromFile {
    /// The side that faces +z, which is the front in glTF.
    Front,
    /// The side that faces −z.
    Back,
    /// The side that faces −x.
    Left,
    /// The side that faces +x.
    Right,
    /// The side that faces +y.
    Top,
    /// The side that faces −y.
    Bottom,
    /// From the front, a little from the right and from above.
    #[default]
    ThreeQuarter,
    /// From the front, the right and above alike, so that all three axes are shortened alike.
    Isometric,
    /// x and y shortened alike, z twice as much: 7° and 42° on the page.
    Dimetric,
    /// Each axis shortened by a factor of its own.
    Trimetric,
    /// From the direction of a vector: (1, 0, 0) is from the right.
    Direction(Triple),
}

impl From<NamedView> for FromFile {
    fn from(view: NamedView) -> Self {
        match view {
            NamedView::Front => Self::Front,
            NamedView::Back => Self::Back,
            NamedView::Left => Self::Left,
            NamedView::Right => Self::Right,
            NamedView::Top => Self::Top,
            NamedView::Bottom => Self::Bottom,
            NamedView::ThreeQuarter => Self::ThreeQuarter,
            NamedView::Isometric => Self::Isometric,
            NamedView::Dimetric => Self::Dimetric,
            NamedView::Trimetric => Self::Trimetric,
        }
    }
}

/// Which camera of a model.
#[derive(Clone, PartialEq, Eq, Debug, Deserialize)]
pub enum CameraChoice {
    /// By its place in the file, from 0.
    Index(usize),
    /// By its own name or that of its node.
    Name(String),
}
