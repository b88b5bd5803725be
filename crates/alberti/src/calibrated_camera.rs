//! Flags for calibrated cameras: intrinsics, and extrinsics or a pose.

use super::number_list::parse_number_list;
use super::options::option_parser;
use camera::CameraAxes;
use homog::PixelCenters;
use scene_file::file::{
    CameraFile, Finite, Positive, ProjectionFile, RotationFile, Triple, ViewFile,
};

/// A camera as specified by calibration, photogrammetry or a data set.
#[derive(Clone, Debug, Default, clap::Args)]
pub(crate) struct CalibratedCameraArgs {
    /// Camera intrinsics: focal lengths and principal point in pixels
    ///
    /// Also accepts all nine entries of the matrix K, row by row. The values must apply to
    /// pictures of the same size as this one.
    #[arg(
        help_heading = "Camera",
        long,
        value_name = "FX,FY,CX,CY",
        value_parser = parse_intrinsics,
        allow_hyphen_values = true,
        conflicts_with = "projection"
    )]
    intrinsics: Option<ProjectionFile>,
    /// Coordinates of pixel centers, for the principal point of --intrinsics [default: integer]
    #[arg(help_heading = "Camera", long, value_parser = option_parser::<PixelCenters>(), requires = "intrinsics")]
    pixel_centers: Option<PixelCenters>,
    /// Rotation and translation from the world to the camera: the 12 entries of [R|t], row by row
    #[arg(
        help_heading = "Camera",
        long,
        value_name = "NUMBERS",
        value_parser = parse_frame,
        allow_hyphen_values = true,
        conflicts_with_all = ["view", "camera", "pose", "azimuth", "elevation", "eye"]
    )]
    extrinsics: Option<CameraFrame>,
    /// Pose of the camera in the world: 12 numbers, row by row; the last column is the eye's
    /// position
    #[arg(
        help_heading = "Camera",
        long,
        value_name = "NUMBERS",
        value_parser = parse_frame,
        allow_hyphen_values = true,
        conflicts_with_all = ["view", "camera", "azimuth", "elevation", "eye"]
    )]
    pose: Option<CameraFrame>,
    /// Directions of the camera's axes [default: opencv for --extrinsics, opengl for --pose]
    #[arg(help_heading = "Camera", long, value_name = "AXES", value_parser = option_parser::<CameraAxes>())]
    camera_axes: Option<CameraAxes>,
}

/// A 3 × 4 matrix: the rows of its rotation, and its last column.
#[derive(Clone, Copy, Debug)]
struct CameraFrame {
    rotation: [[f64; 3]; 3],
    column: [f64; 3],
}

impl CameraFrame {
    /// Returns the rotation as written in a scene file.
    fn to_rotation_file(self) -> RotationFile {
        let [x, y, z] = self.rotation.map(Triple);
        RotationFile::Rows((x, y, z))
    }
}

impl CalibratedCameraArgs {
    /// Whether a flag sets the camera's position.
    pub(crate) const fn places_camera(&self) -> bool {
        self.extrinsics.is_some() || self.pose.is_some()
    }

    /// Whether the camera's axes are set without its position.
    pub(crate) const fn has_axes_alone(&self) -> bool {
        self.camera_axes.is_some() && !self.places_camera()
    }

    /// Replaces the scene's view and projection as the flags specify.
    pub(crate) fn apply_to(&self, file: &mut CameraFile) {
        if let Some(frame) = self.extrinsics {
            let (rotation, translation) = (frame.to_rotation_file(), Triple(frame.column));
            let axes = self.camera_axes.unwrap_or(CameraAxes::OpenCv);
            file.view = ViewFile::Extrinsics { rotation, translation, axes };
        }
        if let Some(frame) = self.pose {
            let (rotation, eye) = (frame.to_rotation_file(), Triple(frame.column));
            let axes = self.camera_axes.unwrap_or(CameraAxes::OpenGl);
            file.view = ViewFile::Pose { rotation, eye, axes };
        }
        if let Some(lens) = &self.intrinsics {
            let mut lens = lens.clone();
            if let (Some(given), ProjectionFile::Intrinsics { pixel_centers, .. }) =
                (self.pixel_centers, &mut lens)
            {
                *pixel_centers = given;
            }
            file.projection = Some(lens);
        }
    }
}

/// Parses `FX,FY,CX,CY`, or K row by row.
fn parse_intrinsics(text: &str) -> Result<ProjectionFile, String> {
    let numbers = parse_number_list(text)?;
    let (fx, fy, cx, cy, skew) = match *numbers.as_slice() {
        [fx, fy, cx, cy] => (fx, fy, cx, cy, 0.0),
        [fx, skew, cx, 0.0, fy, cy, 0.0, 0.0, 1.0] => (fx, fy, cx, cy, skew),
        _ => {
            let found = files::counted(numbers.len(), "number", "numbers");
            return Err(format!(
                "expected fx,fy,cx,cy or K as fx,skew,cx,0,fy,cy,0,0,1; found {found}"
            ));
        }
    };
    let focal = |value: f64| Positive::new(value).ok_or("focal lengths must be greater than 0");
    let finite = |value: f64| Finite::new(value).ok_or("numbers must be finite");
    Ok(ProjectionFile::Intrinsics {
        fx: focal(fx)?,
        fy: Some(focal(fy)?),
        cx: Some(finite(cx)?),
        cy: Some(finite(cy)?),
        skew: finite(skew)?,
        size: None,
        pixel_centers: PixelCenters::Integer,
        near: None,
        far: None,
    })
}

/// Parses three rows of four numbers; a fourth row 0,0,0,1 may follow.
fn parse_frame(text: &str) -> Result<CameraFrame, String> {
    let numbers = parse_number_list(text)?;
    let rows = match numbers.as_slice() {
        [rows @ .., 0.0, 0.0, 0.0, 1.0] if numbers.len() == 16 => rows,
        rows if rows.len() == 12 => rows,
        _ => {
            let found = numbers.len();
            return Err(format!(
                "expected 12 numbers, or 16 whose last row is 0,0,0,1; found {found}"
            ));
        }
    };
    let row = |at: usize| [rows[4 * at], rows[4 * at + 1], rows[4 * at + 2]];
    let rotation = [0, 1, 2].map(row);
    Ok(CameraFrame { rotation, column: [rows[3], rows[7], rows[11]] })
}
