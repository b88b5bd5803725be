//! From the background that a scene file asks for to what is painted behind the models.

use super::file::{BackgroundFile, EnvironmentFile, FitFile, SceneFile};
use super::locate::Step::{self, Field, Index};
use super::surroundings::read_bytes;
use super::{Origin, SceneError};
use model::import::decode_image;
use shade::Fit;
use shade::Gradient;
use shade::Painting;
use shade::Photo;
use shade::color::{parse_hex, parse_hex_codes};
use std::path::PathBuf;
use std::sync::Arc;

/// The most colours of a gradient.
const MOST_COLORS: usize = 16;
/// The most pixels of a picture behind the models.
const MOST_TEXELS: u64 = 1 << 26;
const PATH: [Step<'static>; 2] = [Field("image"), Field("background")];

impl SceneFile {
    /// The paths of all pictures around and behind the models, from the scene's folder on.
    pub fn pictures(&self) -> impl Iterator<Item = &str> {
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

fn fault(origin: &Origin, rest: &[Step<'_>], message: String, help: Option<&str>) -> SceneError {
    origin.fault(&[&PATH, rest].concat(), message, help.map(str::to_owned))
}

fn no_color(origin: &Origin, rest: &[Step<'_>], text: &str) -> SceneError {
    let help = Some("write #rgb or #rrggbb, such as #f4f1ea");
    fault(origin, rest, format!("`{text}` is no colour"), help)
}

/// What all samples begin with where nothing is drawn: linear, multiplied by alpha. Where a painting covers it, a colour of the paper that lines can be told from.
pub(super) fn ground_color(origin: &Origin, file: &SceneFile) -> Result<[f32; 4], SceneError> {
    let opaque = |[r, g, b]: [f32; 3]| [r, g, b, 1.0];
    match &file.image.background {
        BackgroundFile::Transparent => Ok([0.0; 4]),
        BackgroundFile::Environment { .. }
            if matches!(file.environment, None | Some(EnvironmentFile::Dark)) =>
        {
            let help = Some("add one, such as environment: Studio()");
            let message = "the scene has no environment to be seen".to_owned();
            Err(fault(origin, &[], message, help))
        }
        BackgroundFile::Environment { .. } => Ok([0.0, 0.0, 0.0, 1.0]),
        BackgroundFile::Color(text) => {
            parse_hex(text).map(opaque).ok_or_else(|| no_color(origin, &[], text))
        }
        BackgroundFile::Gradient { colors, angle_degrees } => {
            let angle = angle_degrees.value().to_radians();
            Ok(gradient(origin, colors, angle, file.image.size)?.middle())
        }
        BackgroundFile::Picture { color, .. } => match color {
            None => Ok([0.0; 4]),
            Some(text) => {
                parse_hex(text).map(opaque).ok_or_else(|| no_color(origin, &[Field("color")], text))
            }
        },
    }
}

fn gradient(
    origin: &Origin,
    colors: &[String],
    angle: f64,
    (width, height): (u32, u32),
) -> Result<Gradient, SceneError> {
    if !(2..=MOST_COLORS).contains(&colors.len()) {
        let message = format!("a gradient cannot have {} colours", colors.len());
        let help = Some("from 2 to 16 are possible; one alone is Color(\"#…\")");
        return Err(fault(origin, &[Field("colors")], message, help));
    }
    let numbered = colors.iter().enumerate();
    let codes = numbered.map(|(at, text)| {
        let at = [Field("colors"), Index(at)];
        parse_hex_codes(text).ok_or_else(|| no_color(origin, &at, text))
    });
    let codes = codes.collect::<Result<Vec<_>, _>>()?;
    Ok(Gradient::new(&codes, angle, [width, height]))
}

/// What is painted behind the models; `None` for plain backgrounds. A picture's file may lie in one of the `allowed` folders too.
pub(super) fn painting(
    origin: &Origin,
    file: &SceneFile,
    allowed: &[PathBuf],
) -> Result<Option<Arc<Painting>>, SceneError> {
    let (width, height) = file.image.size;
    let painting = match &file.image.background {
        BackgroundFile::Gradient { colors, angle_degrees } => {
            let angle = angle_degrees.value().to_radians();
            Painting::Gradient(gradient(origin, colors, angle, file.image.size)?)
        }
        BackgroundFile::Picture { path, fit, .. } => {
            let at = [Field("image"), Field("background"), Field("path")];
            let bytes = read_bytes(origin, &at, path, allowed)?;
            let image = decode_image(&bytes, MOST_TEXELS).map_err(|problem| {
                fault(origin, &[Field("path")], format!("{path}: {problem}"), None)
            })?;
            let fit = match fit {
                FitFile::Stretch => Fit::Stretch,
                FitFile::Cover => Fit::Cover,
                FitFile::Contain => Fit::Contain,
            };
            let color = ground_color(origin, file)?;
            Painting::Photo(Photo::new(&image, fit, [width, height], color))
        }
        _ => return Ok(None),
    };
    Ok(Some(Arc::new(painting)))
}
