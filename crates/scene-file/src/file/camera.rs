//! The camera of a scene file: its position and direction, and its projection.

use super::projection::ProjectionFile;
use crate::number::{Finite, NonNegative, Positive, Triple};
use crate::schema::{scene_enum, scene_struct};
use camera::{CameraAxes, NamedView};

scene_struct! {
    /// The camera: its position and direction, and its projection.
    pub struct CameraFile as "Camera" {
        /// The position and direction. Default: framed from the direction that suits the
        /// projection.
        pub view: ViewFile = ViewFile::DEFAULT,
        /// The projection. Default: from the model's camera with `FromModel`, otherwise
        /// perspective.
        pub projection: Option<ProjectionFile> = None,
        /// The magnification about the center of the image. Default: 1.
        pub zoom: Positive = Positive::ONE,
    }
}

scene_enum! {
    /// The position and direction of the camera.
    pub enum ViewFile as "View" {
        /// From one point toward another.
        LookAt {
            /// The position of the eye.
            eye: Triple,
            /// The point the camera looks at, which becomes the center of the image.
            target: Triple,
            /// The view-up vector: the direction that points up in the image. Default: y.
            up: Triple = Triple::Y_AXIS,
        },
        /// From a point in a given direction.
        LookTo {
            /// The position of the eye.
            eye: Triple,
            /// The direction of gaze.
            gaze: Triple,
            /// The view-up vector. Default: y.
            up: Triple = Triple::Y_AXIS,
        },
        /// From the rotation and translation from world to camera, as calibration programs report
        /// them: camera = R · world + t.
        Extrinsics {
            /// The rotation R.
            rotation: RotationFile,
            /// The translation t: the world's origin in camera coordinates.
            translation: Triple,
            /// The directions of the camera's axes. Default: `OpenCv`.
            axes: CameraAxes = CameraAxes::OpenCv,
        },
        /// From the pose of the camera in the world, as in NeRF datasets: world = R · camera + eye.
        Pose {
            /// The rotation R, whose columns are the camera's axes.
            rotation: RotationFile,
            /// The position of the eye.
            eye: Triple,
            /// The directions of the camera's axes. Default: `OpenGl`.
            axes: CameraAxes = CameraAxes::OpenGl,
        },
        /// From a direction, at the distance where everything just fits in the image: the models
        /// and, with `ground`, the shadows that directional lights cast on it, up to the length of
        /// the models' diagonal.
        Frame {
            /// The direction. Default: `ThreeQuarter`, and `Front` for classical projections.
            from: Option<FromFile>,
            /// The margin on each side, as a percentage of the image's width or height. Default: 5.
            padding_percent: NonNegative = DEFAULT_PADDING,
        },
        /// A camera in the first model that has cameras.
        FromModel(CameraChoice),
    }
}

impl ViewFile {
    /// Everything, framed from the direction that suits the projection.
    pub const DEFAULT: Self = Self::Frame { from: None, padding_percent: DEFAULT_PADDING };
}

/// The margin of framed pictures, in percent.
pub const DEFAULT_PADDING: NonNegative = NonNegative::FIVE;

scene_enum! {
    /// A rotation.
    pub enum RotationFile as "Rotation" {
        /// From the three rows of its matrix, which multiplies column vectors.
        Rows((Triple, Triple, Triple)),
        /// From the three columns of its matrix: the rows of a matrix that multiplies row vectors,
        /// as in PyTorch3D.
        Columns((Triple, Triple, Triple)),
        /// From a quaternion (w, x, y, z), as in COLMAP. Its length does not matter.
        Quaternion((Finite, Finite, Finite, Finite)),
    }
}

scene_enum! {
    /// The direction from which a picture is framed.
    pub enum FromFile as "From" {
        /// From +z, which is the front in glTF.
        Front,
        /// From −z.
        Back,
        /// From −x.
        Left,
        /// From +x.
        Right,
        /// From +y.
        Top,
        /// From −y.
        Bottom,
        /// From the front, slightly from the right and above.
        ThreeQuarter,
        /// From (1, 1, 1), which foreshortens all three axes equally.
        Isometric,
        /// x and y foreshortened equally, z to half their length: 7° and 42° on the page.
        Dimetric,
        /// A different foreshortening factor on each axis.
        Trimetric,
        /// From the direction of a vector; (1, 0, 0) is from the right.
        Direction(Triple),
    }
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

scene_enum! {
    /// One of a model's cameras.
    #[derive(Eq)]
    pub enum CameraChoice as "CameraChoice" {
        /// By index in the file, from 0.
        Index(usize),
        /// By its name or its node's name.
        Name(String),
    }
}
