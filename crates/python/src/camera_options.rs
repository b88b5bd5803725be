//! Camera options: position and lens, converted to the types of a scene file.

use crate::arrays;
use crate::failure::{Failure, Fallible};
use crate::keywords::{Keywords, not_a};
use camera::{CameraAxes, CameraError, Extrinsics, NamedView};
use homog::PixelCenters;
use projection::Intrinsics;
use pyo3::prelude::*;
use scene_file::file::{
    CameraChoice, CameraFile, DEFAULT_PADDING, FieldOfView, Finite, FromFile, Positive,
    ProjectionFile, RotationFile, Triple, ViewFile,
};

/// Reads the position, direction and lens of a camera.
///
/// # Errors
/// Returns an error if an option has the wrong type, is not finite, or does not define a camera.
pub(crate) fn read_camera(options: &Keywords<'_, '_>) -> PyResult<CameraFile> {
    let (view, projection) = (read_view(options)?, read_lens(options)?);
    Ok(CameraFile { view, projection, ..CameraFile::default() })
}

/// Reads the camera position: from eye and target, R and t, a pose, the name of a camera in the
/// model, or a direction.
fn read_view(options: &Keywords<'_, '_>) -> PyResult<ViewFile> {
    if let Some(eye) = options.vector("eye")? {
        let target = options.vector("target")?.unwrap_or_default();
        let up = options.vector("up")?.unwrap_or([0.0, 1.0, 0.0]);
        return Ok(ViewFile::LookAt { eye: Triple(eye), target: Triple(target), up: Triple(up) });
    }
    if let Some(rotation) = options.value("R")? {
        return read_extrinsics(options, &rotation);
    }
    if let Some(pose) = options.value("pose")? {
        return read_pose(options, &pose);
    }
    if let Some(of_model) = options.value("of_model")? {
        let index = of_model.extract().map(CameraChoice::Index);
        let choice = index.or_else(|_| of_model.extract().map(CameraChoice::Name));
        let choice = choice.map_err(|_| not_a("camera", &of_model, "a name or an index"))?;
        return Ok(ViewFile::FromModel(choice));
    }
    let from = options.value("direction")?.map(|value| read_direction(&value)).transpose()?;
    let padding_percent = match options.number("padding")? {
        None => DEFAULT_PADDING,
        Some(percent) => scene_file::file::NonNegative::new(percent).ok_or_else(|| {
            let message = format!("is {percent}, expected a number of at least 0");
            PyErr::from(Failure::argument("padding", message))
        })?,
    };
    Ok(ViewFile::Frame { from, padding_percent })
}

/// Reads the direction from which a model is framed: a name or a vector.
fn read_direction(value: &Bound<'_, PyAny>) -> PyResult<FromFile> {
    let Ok(name) = value.extract::<String>() else {
        return Ok(FromFile::Direction(Triple(arrays::vector("direction", value)?)));
    };
    let wanted = name.replace('_', "-").to_lowercase();
    let known = NamedView::ALL.into_iter().find(|view| view.name() == wanted);
    known.map(FromFile::from).ok_or_else(|| {
        let names = NamedView::ALL.map(NamedView::name).join(", ");
        Failure::argument("direction", format!("is {name:?}, expected a vector or one of {names}"))
            .into()
    })
}

/// Reads the rotation and translation from the world to the camera.
fn read_extrinsics(options: &Keywords<'_, '_>, rotation: &Bound<'_, PyAny>) -> PyResult<ViewFile> {
    let axes = options.named("axes")?.unwrap_or(CameraAxes::OpenCv);
    let translation = options.vector("t")?.unwrap_or_default();
    let mut rows = read_rotation(rotation)?;
    if options.flag("transposed")? {
        rows = [0, 1, 2].map(|column| [0, 1, 2].map(|row: usize| rows[row][column]));
    }
    let checked = Extrinsics::new(rows, translation, axes);
    checked.map_err(|error| wrong_rotation("R", &error))?;
    let rotation = rotation_file(rows);
    Ok(ViewFile::Extrinsics { rotation, translation: Triple(translation), axes })
}

/// Reads a rotation: a matrix, a rotation vector (axis times angle in radians), or a quaternion (w,
/// x, y, z).
fn read_rotation(value: &Bound<'_, PyAny>) -> PyResult<[[f64; 3]; 3]> {
    let numbers = arrays::real_array::<f64>("R", value, "float64")?;
    let from_quaternion = |quaternion: [f64; 4]| -> Fallible<[[f64; 3]; 3]> {
        let camera = Extrinsics::from_quaternion(quaternion, [0.0; 3], CameraAxes::OpenCv);
        Ok(camera.map_err(|error| Failure::argument("R", error.to_string()))?.rotation())
    };
    match numbers.shape[..] {
        [3, 3] => arrays::matrix("R", value),
        [4] => Ok(from_quaternion(arrays::vector("R", value)?)?),
        [3] | [3, 1] | [1, 3] => {
            let [x, y, z]: [f64; 3] = arrays::vector("R", value)?;
            let angle = glam::DVec3::new(x, y, z).length();
            let (sine, cosine) = libm::sincos(0.5 * angle);
            // The limit of sin(angle / 2) / angle at 0.
            let scale = if angle > 0.0 { sine / angle } else { 0.5 };
            Ok(from_quaternion([cosine, x * scale, y * scale, z * scale])?)
        }
        _ => {
            let wanted = "a matrix (3, 3), a rotation vector (3,) or a quaternion (4,) w, x, y, z";
            Err(arrays::wrong_shape("R", &numbers.shape, wanted).into())
        }
    }
}

/// Reads a pose from the camera to the world.
fn read_pose(options: &Keywords<'_, '_>, pose: &Bound<'_, PyAny>) -> PyResult<ViewFile> {
    let axes = options.named("axes")?.unwrap_or(CameraAxes::OpenGl);
    let shape = arrays::real_array::<f64>("pose", pose, "float64")?.shape;
    let rows: [[f64; 4]; 3] = if shape == [3, 4] {
        arrays::matrix("pose", pose)?
    } else {
        let rows: [[f64; 4]; 4] = arrays::matrix("pose", pose)?;
        if rows[3] != [0.0, 0.0, 0.0, 1.0] {
            let message = format!("its last row is {:?}, expected [0, 0, 0, 1]", rows[3]);
            return Err(Failure::argument("pose", message).into());
        }
        [rows[0], rows[1], rows[2]]
    };
    let (rotation, eye) = (rows.map(|[x, y, z, _]| [x, y, z]), rows.map(|row| row[3]));
    let checked = Extrinsics::from_pose(rotation, eye, axes);
    checked.map_err(|error| wrong_rotation("pose", &error))?;
    Ok(ViewFile::Pose { rotation: rotation_file(rotation), eye: Triple(eye), axes })
}

/// Returns the error for a matrix that is not a rotation, with a way to find the nearest one.
fn wrong_rotation(argument: &str, error: &CameraError) -> Failure {
    let failure = Failure::argument(argument, error.to_string());
    if !matches!(error, CameraError::NotRotation { .. }) {
        return failure;
    }
    let part = if argument == "pose" { "pose[:3, :3]" } else { argument };
    failure.with_help(format!(
        "use the nearest rotation: U, _, Vt = np.linalg.svd({part}); {part} = U @ Vt"
    ))
}

/// Converts a rotation to the form used in scene files.
pub(crate) fn rotation_file([x, y, z]: [[f64; 3]; 3]) -> RotationFile {
    RotationFile::Rows((Triple(x), Triple(y), Triple(z)))
}

/// Reads the lens, or returns `None` if the options do not specify a lens.
fn read_lens(options: &Keywords<'_, '_>) -> PyResult<Option<ProjectionFile>> {
    let (near, far) = (options.positive("near")?, options.positive("far")?);
    if let Some(k) = options.value("K")? {
        return read_intrinsics(options, &k, [near, far]).map(Some);
    }
    let height = options.positive("height")?;
    if height.is_some() || options.flag("orthographic")? {
        let ahead = |plane: Option<Positive>| plane.and_then(|plane| Finite::new(plane.value()));
        return Ok(Some(ProjectionFile::Orthographic {
            height,
            left: None,
            right: None,
            bottom: None,
            top: None,
            near: ahead(near),
            far: ahead(far),
        }));
    }
    let angles = [options.number("fov_y")?, options.number("fov_x")?];
    if angles == [None; 2] && near.is_none() && far.is_none() {
        return Ok(None);
    }
    let angle = |name: &str, angle: Option<f64>| -> PyResult<Option<FieldOfView>> {
        let Some(angle) = angle else { return Ok(None) };
        let wrong = format!("is {angle}, expected an angle between 0 and 180 degrees");
        FieldOfView::new(angle).map(Some).ok_or_else(|| Failure::argument(name, wrong).into())
    };
    if angles.iter().all(Option::is_some) {
        let message = "pass only one of fov_y and fov_x; the other follows from the size";
        return Err(Failure::argument("fov_x", message).into());
    }
    Ok(Some(ProjectionFile::Perspective {
        fov_y_degrees: angle("fov_y", angles[0])?,
        fov_x_degrees: angle("fov_x", angles[1])?,
        fov_diagonal_degrees: None,
        shift: (Finite::ZERO, Finite::ZERO),
        near,
        far,
    }))
}

/// Reads the lens from a matrix K or (fx, fy, cx, cy).
fn read_intrinsics(
    options: &Keywords<'_, '_>,
    k: &Bound<'_, PyAny>,
    [near, far]: [Option<Positive>; 2],
) -> PyResult<ProjectionFile> {
    let size = options.size("size")?;
    let pixel_centers = options.named("pixel_centers")?.unwrap_or(PixelCenters::Integer);
    let numbers = arrays::real_array::<f64>("K", k, "float64")?;
    let rows = match numbers.shape[..] {
        [3, 3] => arrays::matrix::<3, 3>("K", k)?,
        [4] => {
            let [fx, fy, cx, cy] = arrays::vector::<4>("K", k)?;
            [[fx, 0.0, cx], [0.0, fy, cy], [0.0, 0.0, 1.0]]
        }
        _ => {
            let wanted = "(3, 3), or (4,) for fx, fy, cx, cy";
            return Err(arrays::wrong_shape("K", &numbers.shape, wanted).into());
        }
    };
    let (width, height) = size.unwrap_or((1, 1));
    let lens = Intrinsics::from_rows(rows, [width, height]);
    let lens = lens.map_err(|error| Failure::argument("K", error.to_string()))?;
    let wrong = || PyErr::from(Failure::argument("K", "its numbers are out of range"));
    let positive = |number: f64| Positive::new(number).ok_or_else(wrong);
    let finite = |number: f64| Finite::new(number).ok_or_else(wrong);
    let ([fx, fy], [cx, cy]) = (lens.focal_length(), lens.principal_point());
    Ok(ProjectionFile::Intrinsics {
        fx: positive(fx)?,
        fy: Some(positive(fy)?),
        cx: Some(finite(cx)?),
        cy: Some(finite(cy)?),
        skew: finite(lens.skew())?,
        size,
        pixel_centers,
        near,
        far,
    })
}
