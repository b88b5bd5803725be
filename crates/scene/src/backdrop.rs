//! Resolution of the background: a color, or a backdrop with a gradient or an image.
//!
//! ```text
//!  none                 white in line drawings, else like Transparent
//!  Transparent          0, 0, 0, 0
//!  Color                linear color, alpha 1
//!  Environment          drawn by the renderer along the view rays
//!  Gradient, Picture    a backdrop behind the models, over the clear color
//! ```

use super::Origin;
use super::surrounding_light::{may_have_environment, read_image_bytes};
use import::decode_image;
use scene_file::PathStep::{self, Field};
use scene_file::SceneError;
use scene_file::file::{BackgroundFile, Color, SceneFile, StyleFile};
use shade::Backdrop;
use shade::BackdropImage;
use shade::Gradient;
use std::path::PathBuf;
use std::sync::Arc;

/// The maximum number of colors in a gradient, evenly spaced.
const MAX_GRADIENT_COLORS: usize = 16;
/// The maximum number of pixels in a backdrop image, 67 million. It limits the memory that a small
/// compressed file can demand.
const MAX_IMAGE_TEXELS: u64 = 1 << 26;
/// The path of the background in a scene file; viewports have separate backgrounds.
const BACKGROUND_PATH: [PathStep<'static>; 2] = [Field("image"), Field("background")];

/// Creates an error that points to the value at the end of `rest`, inside the background.
fn background_error(
    origin: &Origin,
    rest: &[PathStep<'_>],
    message: String,
    help: Option<&str>,
) -> SceneError {
    origin.error_at(&[&BACKGROUND_PATH, rest].concat(), message, help.map(str::to_owned))
}

/// Returns the clear color of all samples, linear and premultiplied by alpha.
///
/// Behind a gradient, it is the gradient's center color; behind an image, the color specified with
/// the image, visible where the image does not cover the frame. Automatic line colors contrast with
/// the clear color.
///
/// # Errors
/// Returns an error if the background is the environment but the scene has none.
pub(super) fn resolve_background_color(
    origin: &Origin,
    file: &SceneFile,
) -> Result<[f32; 4], SceneError> {
    let opaque = |[r, g, b]: [f32; 3]| [r, g, b, 1.0];
    let Some(background) = &file.image.background else {
        // Line drawings are on paper by default; other pictures have a transparent background.
        return Ok(default_paper(&file.style).map_or([0.0; 4], |color| opaque(color.to_linear())));
    };
    match background {
        BackgroundFile::Transparent => Ok([0.0; 4]),
        BackgroundFile::Environment { .. } if !may_have_environment(origin, file) => {
            let help = Some("add one, such as environment: Studio()");
            let message = "the scene has no environment to show".to_owned();
            Err(background_error(origin, &[], message, help))
        }
        // The environment covers every sample, so this black only determines automatic line colors.
        BackgroundFile::Environment { .. } => Ok([0.0, 0.0, 0.0, 1.0]),
        BackgroundFile::Color(color) => Ok(opaque(color.to_linear())),
        BackgroundFile::Gradient { colors, angle_degrees } => {
            let angle = angle_degrees.value().to_radians();
            Ok(resolve_gradient(origin, colors, angle, file.image.size)?.center_color())
        }
        BackgroundFile::Picture { color, .. } => {
            Ok(color.map_or([0.0; 4], |color| opaque(color.to_linear())))
        }
    }
}

/// Returns the default paper of a style for a scene without a background: white for line drawings,
/// otherwise none.
fn default_paper(style: &StyleFile) -> Option<Color> {
    match style {
        StyleFile::Wireframe => Some(Color::WHITE),
        StyleFile::Lines(lines) => Some(lines.paper.unwrap_or(Color::WHITE)),
        _ => None,
    }
}

/// Whether the background is just the white paper that line drawings have by default.
pub(super) fn is_blank_paper(file: &SceneFile) -> bool {
    let is_blank = match &file.style {
        StyleFile::Lines(lines) => lines.paper.is_none(),
        style => *style == StyleFile::Wireframe,
    };
    is_blank && file.image.background.is_none()
}

/// Resolves a linear gradient of `colors` in the direction `angle`, in radians, over an image of
/// width × height pixels.
///
/// # Errors
/// Returns an error if there are fewer than 2 or more than 16 colors.
fn resolve_gradient(
    origin: &Origin,
    colors: &[Color],
    angle: f64,
    size: (u32, u32),
) -> Result<Gradient, SceneError> {
    if !(2..=MAX_GRADIENT_COLORS).contains(&colors.len()) {
        let message = format!("a gradient needs 2 to 16 colors, not {}", colors.len());
        let help = Some("for a single color, write Color(\"#…\")");
        return Err(background_error(origin, &[Field("colors")], message, help));
    }
    let (width, height) = size;
    let codes: Vec<[u8; 3]> = colors.iter().map(|color| color.0).collect();
    Ok(Gradient::new(&codes, angle, [width, height]))
}

/// Returns the backdrop behind the models, a gradient or an image, or `None` for plain backgrounds.
///
/// The image is decoded and fitted to the frame once, and renderers share it. The image file may
/// also be in one of the `allowed` folders.
///
/// # Errors
/// Returns an error if the file is outside the allowed folders, cannot be read, is too large or is
/// not an image.
pub(super) fn resolve_backdrop(
    origin: &Origin,
    file: &SceneFile,
    allowed: &[PathBuf],
) -> Result<Option<Arc<Backdrop>>, SceneError> {
    let (width, height) = file.image.size;
    let backdrop = match &file.image.background {
        Some(BackgroundFile::Gradient { colors, angle_degrees }) => {
            let angle = angle_degrees.value().to_radians();
            Backdrop::Gradient(resolve_gradient(origin, colors, angle, file.image.size)?)
        }
        Some(BackgroundFile::Picture { path, fit, .. }) => {
            let at = [Field("image"), Field("background"), Field("path")];
            let bytes = read_image_bytes(origin, &at, path, allowed)?;
            let image = decode_image(&bytes, MAX_IMAGE_TEXELS).map_err(|problem| {
                background_error(origin, &[Field("path")], format!("{path}: {problem}"), None)
            })?;
            let color = resolve_background_color(origin, file)?;
            Backdrop::Image(BackdropImage::new(&image, *fit, [width, height], color))
        }
        _ => return Ok(None),
    };
    Ok(Some(Arc::new(backdrop)))
}
