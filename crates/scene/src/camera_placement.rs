//! Camera placement in a scene file: explicit, framed around the models, or taken from a model.

use camera::{Camera, CameraError, Extrinsics};
use scene_file::file::{CameraChoice, Finite, FromFile, RotationFile, Triple, ViewFile};

/// The way the camera is placed.
pub(super) enum CameraPlacement<'a> {
    /// As specified in the file.
    Placed(Camera),
    /// Framed so that all models just fit in the picture.
    Framed {
        /// The direction from which the models are seen, if specified.
        from: Option<&'a FromFile>,
        /// The margin, as a fraction of the picture's width or height.
        padding: f64,
    },
    /// Taken from a camera in a model.
    OfModel(&'a CameraChoice),
}

impl<'a> CameraPlacement<'a> {
    /// Returns the placement that a file describes.
    pub(super) fn from_file(view: &'a ViewFile) -> Result<Self, CameraError> {
        Ok(match view {
            ViewFile::LookAt { eye, target, up } => {
                Self::Placed(Camera::look_at(eye.0.into(), target.0.into(), up.0.into())?)
            }
            ViewFile::LookTo { eye, gaze, up } => {
                Self::Placed(Camera::look_to(eye.0.into(), gaze.0.into(), up.0.into())?)
            }
            ViewFile::Extrinsics { rotation, translation, axes } => {
                let rows = rotation_rows(rotation)?;
                Self::Placed(Extrinsics::new(rows, translation.0, *axes)?.to_camera()?)
            }
            ViewFile::Pose { rotation, eye, axes } => {
                let rows = rotation_rows(rotation)?;
                Self::Placed(Extrinsics::from_pose(rows, eye.0, *axes)?.to_camera()?)
            }
            ViewFile::Frame { from, padding_percent } => {
                Self::Framed { from: from.as_ref(), padding: padding_percent.value() / 100.0 }
            }
            ViewFile::FromModel(choice) => Self::OfModel(choice),
        })
    }
}

/// Returns the matrix of a rotation, row by row.
fn rotation_rows(rotation: &RotationFile) -> Result<[[f64; 3]; 3], CameraError> {
    let rows = |(x, y, z): &(Triple, Triple, Triple)| [x.0, y.0, z.0];
    match rotation {
        RotationFile::Rows(triples) => Ok(rows(triples)),
        RotationFile::Columns(triples) => {
            let columns = rows(triples);
            Ok([0, 1, 2].map(|row: usize| columns.map(|column| column[row])))
        }
        RotationFile::Quaternion((w, x, y, z)) => {
            let parts = [w, x, y, z].map(|part: &Finite| part.value());
            Ok(Extrinsics::from_quaternion(parts, [0.0; 3], Default::default())?.rotation())
        }
    }
}
