//! Lints for valid numbers that were probably meant in a different unit.

use super::Lint;
use crate::Origin;
use scene_file::PathStep::{Field, Index};
use scene_file::SceneFile;
use scene_file::file::{LightFile, ProjectionFile};

/// Warns about a field of view in degrees that would be ordinary in radians: below π.
pub(super) fn lint_field_of_view(origin: &Origin, file: &SceneFile) -> Option<Lint> {
    let Some(ProjectionFile::Perspective { fov_y_degrees: Some(angle), .. }) =
        &file.camera.projection
    else {
        return None;
    };
    let angle = angle.value();
    if angle >= core::f64::consts::PI {
        return None;
    }
    let message = format!("a field of view of {angle} degrees is very narrow");
    let degrees = libm::round(angle.to_degrees() * 10.0) / 10.0;
    let help = format!("if it is in radians, write fov_y_degrees: {degrees}");
    let place = [Field("camera"), Field("projection"), Field("fov_y_degrees")];
    let error = origin.error_at(&place, message, Some(help));
    Some(Lint { code: "narrow-field-of-view", error })
}

/// Warns about light colors with numbers above 1, probably bytes; linear white is (1, 1, 1).
pub(super) fn lint_light_colors(origin: &Origin, file: &SceneFile) -> Vec<Lint> {
    let lights = file.lights.iter().flatten().enumerate();
    let lint = |(number, light): (usize, &LightFile)| {
        let (LightFile::Directional { color, .. }
        | LightFile::Point { color, .. }
        | LightFile::Spot { color, .. }
        | LightFile::Ambient { color, .. }) = light
        else {
            return None;
        };
        let brightest = color.0.into_iter().fold(0.0, f64::max);
        if brightest <= 1.0 {
            return None;
        }
        let message = format!("this color is {brightest} times as bright as white, (1, 1, 1)");
        let help = "write it with numbers from 0 to 1 or as \"#ffe0c0\", and make the light \
                    stronger with its `intensity`";
        let place = [Field("lights"), Index(number), Field("color")];
        let error = origin.error_at(&place, message, Some(help.to_owned()));
        Some(Lint { code: "color-above-one", error })
    };
    lights.filter_map(lint).collect()
}
