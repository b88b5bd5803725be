//! Camera flags: a direction around the models or a position, the field of view and the zoom.

use super::CliError;
use super::messages::print_message;
use super::number_list::parse_numbers;
use super::scene_overrides::frame_padding;
use scene_file::file::{
    CameraFile, FieldOfView, Finite, FromFile, Positive, ProjectionFile, Triple, ViewFile,
};

/// The position and the field of view of the camera.
#[derive(Clone, Debug, Default, clap::Args)]
pub(crate) struct ViewpointArgs {
    /// Frame all models from this angle around them: 0 is the front, 90 the right side
    ///
    /// If only one of --azimuth and --elevation is set, the other angle is 0.
    #[arg(
        help_heading = "Camera",
        long,
        value_name = "DEGREES",
        allow_hyphen_values = true,
        value_parser = parse_azimuth,
        conflicts_with_all = ["view", "camera"]
    )]
    azimuth: Option<Finite>,
    /// Frame all models from this angle above their horizon, from -90 to 90
    #[arg(
        help_heading = "Camera",
        long,
        value_name = "DEGREES",
        allow_hyphen_values = true,
        value_parser = parse_elevation,
        conflicts_with_all = ["view", "camera"]
    )]
    elevation: Option<Finite>,
    /// Position of the camera, with --target
    #[arg(
        help_heading = "Camera",
        long,
        value_name = "X,Y,Z",
        allow_hyphen_values = true,
        value_parser = parse_triple,
        requires = "target",
        conflicts_with_all = ["view", "camera", "azimuth", "elevation"]
    )]
    eye: Option<Triple>,
    /// Point that the camera looks at, with --eye
    #[arg(
        help_heading = "Camera",
        long,
        value_name = "X,Y,Z",
        allow_hyphen_values = true,
        value_parser = parse_triple,
        requires = "eye"
    )]
    target: Option<Triple>,
    /// Direction that points up in the picture, with --eye [default: 0,1,0]
    // It is not called `up`, because `--up` sets the axis of a model that points up.
    #[arg(
        help_heading = "Camera",
        long = "view-up",
        value_name = "X,Y,Z",
        allow_hyphen_values = true,
        value_parser = parse_triple,
        requires = "eye"
    )]
    view_up: Option<Triple>,
    /// Vertical field of view of a perspective projection, between 0 and 180 [default: 35]
    #[arg(help_heading = "Camera", long, value_name = "DEGREES", value_parser = parse_field_of_view, conflicts_with = "intrinsics")]
    fov: Option<FieldOfView>,
    /// Magnify the view by this factor, about the center of the picture
    #[arg(help_heading = "Camera", long, value_name = "FACTOR", value_parser = parse_zoom)]
    zoom: Option<Positive>,
}

impl ViewpointArgs {
    /// Whether a flag sets the camera's position.
    pub(crate) const fn places_camera(&self) -> bool {
        self.azimuth.is_some() || self.elevation.is_some() || self.eye.is_some()
    }

    /// Replaces the camera fields with the values of the flags.
    ///
    /// # Errors
    /// Returns an error if `--fov` is set for a projection without a field of view.
    pub(crate) fn apply_to(&self, file: &mut CameraFile) -> Result<(), CliError> {
        if self.azimuth.is_some() || self.elevation.is_some() {
            let [azimuth, elevation] =
                [self.azimuth, self.elevation].map(Option::unwrap_or_default);
            let direction = direction_of(azimuth.value(), elevation.value());
            let padding_percent = frame_padding(file);
            let from = Some(FromFile::Direction(Triple(direction)));
            file.view = ViewFile::Frame { from, padding_percent };
        }
        if let (Some(eye), Some(target)) = (self.eye, self.target) {
            let up = self.view_up.unwrap_or(Triple([0.0, 1.0, 0.0]));
            file.view = ViewFile::LookAt { eye, target, up };
        }
        if let Some(zoom) = self.zoom {
            file.zoom = zoom;
        }
        self.fov.map_or(Ok(()), |angle| set_field_of_view(file, angle))
    }
}

/// Sets the vertical field of view of a perspective projection, replacing any other.
fn set_field_of_view(file: &mut CameraFile, angle: FieldOfView) -> Result<(), CliError> {
    match file.projection.get_or_insert(ProjectionFile::PERSPECTIVE) {
        ProjectionFile::Perspective {
            fov_y_degrees, fov_x_degrees, fov_diagonal_degrees, ..
        } => {
            (*fov_y_degrees, *fov_x_degrees, *fov_diagonal_degrees) = (Some(angle), None, None);
            warn_of_radians(angle.value());
            Ok(())
        }
        _ => Err(CliError::Usage(
            "`--fov` cannot be used with this projection: it applies only to `--projection perspective`\n  = help: use `--projection perspective`, or `--zoom 1.5` instead of `--fov` to make the model larger"
                .to_owned(),
        )),
    }
}

/// Warns about an angle in degrees below π, which may be meant in radians.
fn warn_of_radians(degrees: f64) {
    if degrees < core::f64::consts::PI {
        let meant = libm::round(degrees.to_degrees() * 10.0) / 10.0;
        let message = format!(
            "a field of view of {degrees} degrees is very narrow; if the value is in radians, write --fov {meant}"
        );
        print_message("warning", &message);
    }
}

/// Returns the direction from the models to the eye for angles in degrees.
///
/// Quarter turns are exact, so that they produce the same picture as the named views.
fn direction_of(azimuth: f64, elevation: f64) -> [f64; 3] {
    let ([sin, cos], [up, level]) = (sine_and_cosine(azimuth), sine_and_cosine(elevation));
    [sin * level, up, cos * level]
}

/// Returns the sine and cosine of an angle in degrees, exact for quarter turns.
fn sine_and_cosine(degrees: f64) -> [f64; 2] {
    let turn = degrees.rem_euclid(360.0);
    let quarters =
        [(0.0, [0.0, 1.0]), (90.0, [1.0, 0.0]), (180.0, [0.0, -1.0]), (270.0, [-1.0, 0.0])];
    let exact = quarters.into_iter().find(|(angle, _)| *angle == turn);
    exact.map_or_else(
        || [libm::sin(turn.to_radians()), libm::cos(turn.to_radians())],
        |(_, values)| values,
    )
}

/// Parses an angle in degrees.
fn parse_azimuth(text: &str) -> Result<Finite, String> {
    let angle = text.parse().ok().and_then(Finite::new);
    angle.ok_or_else(|| "expected an angle in degrees, such as 30".to_owned())
}

/// Parses an angle from −90 to 90 degrees.
fn parse_elevation(text: &str) -> Result<Finite, String> {
    let angle = text.parse().ok().filter(|angle| (-90.0..=90.0).contains(angle));
    angle
        .and_then(Finite::new)
        .ok_or_else(|| "expected an angle in degrees from -90 (below) to 90 (above)".to_owned())
}

/// Parses an angle between 0 and 180 degrees.
fn parse_field_of_view(text: &str) -> Result<FieldOfView, String> {
    let angle = text.parse().ok().and_then(FieldOfView::new);
    angle.ok_or_else(|| "expected an angle between 0 and 180 degrees, such as 35".to_owned())
}

/// Parses a factor from 0.001 to 1000.
fn parse_zoom(text: &str) -> Result<Positive, String> {
    let factor = text.parse().ok().filter(|factor| (0.001..=1000.0).contains(factor));
    factor
        .and_then(Positive::new)
        .ok_or_else(|| "expected a factor from 0.001 to 1000, such as 1.5".to_owned())
}

/// Parses three numbers.
fn parse_triple(text: &str) -> Result<Triple, String> {
    parse_numbers(text).map(Triple)
}
