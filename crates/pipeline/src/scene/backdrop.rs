//! From the background that a scene file asks for to what is painted behind the models.

use super::file::{BackgroundFile, EnvironmentFile, FitFile, SceneFile};
use super::source_span::PathStep::{self, Field, Index};
use super::surrounding_light::read_image_bytes;
use super::{Origin, SceneError};
use model::import::decode_image;
use shade::Backdrop;
use shade::BackdropImage;
use shade::Gradient;
use shade::ImageFit;
use shade::color::{parse_hex_color, parse_hex_srgb};
use std::path::PathBuf;
use std::sync::Arc;

/// The most colours of a gradient.
const MAX_GRADIENT_COLORS: usize = 16;
/// The most pixels of a picture behind the models.
const MAX_IMAGE_TEXELS: u64 = 1 << 26;
const BACKGROUND_PATH: [PathStep<'static>; 2] = [Field("image"), Field("background")];

impl SceneFile {
    /// The paths of all pictures around and behind the models, from the scene's folder on.
    pub fn image_paths(&self) -> impl Iterator<Item = &str> {
        let own = self.viewports.iter().filter_map(|viewport| viewport.background.as_ref());
        let behind =
            own.chain([&self.image.background]).filter_map(|background| match background {
                BackgroundFile::Picture { path, .. } => Some(path.as_str()),
                _ => None,
            });
        let around = match &self.environment {
            Some(EnvironmentFile::File { path, .. }) => Some(path.as_str()),
            _ => None,
        };
        around.into_iter().chain(behind)
    }
}

fn background_error(
    origin: &Origin,
    rest: &[PathStep<'_>],
    message: String,
    help: Option<&str>,
) -> SceneError {
    origin.error_at(&[&BACKGROUND_PATH, rest].concat(), message, help.map(str::to_owned))
}

fn color_error(origin: &Origin, rest: &[PathStep<'_>], text: &str) -> SceneError {
    let help = Some("write #rgb or #rrggbb, such as #f4f1ea");
    background_error(origin, rest, format!("`{text}` is no colour"), help)
}

/// What all samples begin with where nothing is drawn: linear, multiplied by alpha. Where a painting covers it, a colour of the paper that lines can be told from.
pub(super) fn resolve_background_color(
    origin: &Origin,
    file: &SceneFile,
) -> Result<[f32; 4], SceneError> {
    let opaque = |[r, g, b]: [f32; 3]| [r, g, b, 1.0];
    match &file.image.background {
        BackgroundFile::Transparent => Ok([0.0; 4]),
        BackgroundFile::Environment { .. }
            if matches!(file.environment, None | Some(EnvironmentFile::Dark)) =>
        {
            let help = Some("add one, such as environment: Studio()");
            let message = "the scene has no environment to be seen".to_owned();
            Err(background_error(origin, &[], message, help))
        }
        BackgroundFile::Environment { .. } => Ok([0.0, 0.0, 0.0, 1.0]),
        BackgroundFile::Color(text) => {
            parse_hex_color(text).map(opaque).ok_or_else(|| color_error(origin, &[], text))
        }
        BackgroundFile::Gradient { colors, angle_degrees } => {
            let angle = angle_degrees.value().to_radians();
            Ok(resolve_gradient(origin, colors, angle, file.image.size)?.center_color())
        }
        BackgroundFile::Picture { color, .. } => match color {
            None => Ok([0.0; 4]),
            Some(text) => parse_hex_color(text)
                .map(opaque)
                .ok_or_else(|| color_error(origin, &[Field("color")], text)),
        },
    }
}

fn resolve_gradient(
    origin: &Origin,
    colors: &[String],
    angle: f64,
    (width, height): (u32, u32),
) -> Result<Gradient, SceneError> {
    if !(2..=MAX_GRADIENT_COLORS).contains(&colors.len()) {
        let message = format!("a gradient cannot have {} colours", colors.len());
        let help = Some("from 2 to 16 are possible; one alone is Color(\"#…\")");
        return Err(background_error(origin, &[Field("colors")], message, help));
    }
    let numbered = colors.iter().enumerate();
    let codes = numbered.map(|(at, text)| {
        let at = [Field("colors"), Index(at)];
        parse_hex_srgb(text).ok_or_else(|| color_error(origin, &at, text))
    });
    let codes = codes.collect::<Result<Vec<_>, _>>()?;
    Ok(Gradient::new(&codes, angle, [width, height]))
}

/// What is painted behind the models; `None` for plain backgrounds. A picture's file may lie in one of the `allowed` folders too.
pub(super) fn resolve_backdrop(
    origin: &Origin,
    file: &SceneFile,
    allowed: &[PathBuf],
) -> Result<Option<Arc<Backdrop>>, SceneError> {
    let (width, height) = file.image.size;
    let painting = match &file.image.background {
        BackgroundFile::Gradient { colors, angle_degrees } => {
            let angle = angle_degrees.value().to_radians();
            Backdrop::Gradient(resolve_gradient(origin, colors, angle, file.image.size)?)
        }
        BackgroundFile::Picture { path, fit, .. } => {
            let at = [Field("image"), Field("background"), Field("path")];
            let bytes = read_image_bytes(origin, &at, path, allowed)?;
            let image = decode_image(&bytes, MAX_IMAGE_TEXELS).map_err(|problem| {
                background_error(origin, &[Field("path")], format!("{path}: {problem}"), None)
            })?;
            let fit = match fit {
                FitFile::Stretch => ImageFit::Stretch,
                FitFile::Cover => ImageFit::Cover,
                FitFile::Contain => ImageFit::Contain,
            };
            let color = resolve_background_color(origin, file)?;
            Backdrop::Image(BackdropImage::new(&image, fit, [width, height], color))
        }
        _ => return Ok(None),
    };
    Ok(Some(Arc::new(painting)))
}
