//! Resolution of `Intrinsics`: the lens of a calibrated camera for the picture being drawn.

use super::Origin;
use super::camera_fields::PROJECTION_PATH;
use projection::{Intrinsics, ProjectionError};
use scene_file::PathStep::Field;
use scene_file::SceneError;
use scene_file::file::{Finite, Positive, ProjectionFile};

/// The rounding error in pixels that picture sizes with the same aspect ratio may have.
const SHAPE_TOLERANCE: f64 = 1.0;

/// Returns the lens of a projection with intrinsic parameters, for a picture of `picture_size`, or
/// `None` for other projections.
pub(super) fn calibrated_lens(
    projection: &ProjectionFile,
    picture_size: [u32; 2],
) -> Option<Result<Intrinsics, ProjectionError>> {
    let ProjectionFile::Intrinsics { fx, fy, cx, cy, skew, size, pixel_centers, .. } = *projection
    else {
        return None;
    };
    let size = size.map_or(picture_size, |(width, height)| [width, height]);
    // From the center of the first pixel to the center of the last.
    let middle = size.map(|side| 0.5 * f64::from(side) - 0.5 + pixel_centers.first_center());
    let center = [cx, cy].map(|given| given.map(Finite::value));
    let center = [center[0].unwrap_or(middle[0]), center[1].unwrap_or(middle[1])];
    let focal_length = [fx.value(), fy.map_or(fx.value(), Positive::value)];
    let lens = Intrinsics::new(focal_length, center, size);
    Some(
        lens.and_then(|lens| lens.with_skew(skew.value()))
            .map(|lens| lens.with_pixel_centers(pixel_centers)),
    )
}

/// Returns an error if the intrinsic parameters are for pictures with a different aspect ratio.
pub(super) fn check_calibrated_shape(
    origin: &Origin,
    projection: &ProjectionFile,
    picture_size: [u32; 2],
) -> Option<SceneError> {
    let ProjectionFile::Intrinsics { size: Some((width, height)), .. } = *projection else {
        return None;
    };
    let [columns, rows] = picture_size.map(f64::from);
    let (width_of, height_of) = (f64::from(width), f64::from(height));
    let is_similar =
        (rows * width_of - columns * height_of).abs() <= SHAPE_TOLERANCE * width_of.max(height_of);
    if is_similar {
        return None;
    }
    let message = format!(
        "the intrinsics are for pictures of {width} x {height} pixels, but {columns} x {rows} has a different aspect ratio"
    );
    let help = format!("make the image {width} x {height}, or a multiple of that size");
    let path = [&PROJECTION_PATH[..], &[Field("size")]].concat();
    Some(origin.error_at(&path, message, Some(help)))
}
