//! Lints for models that are barely visible: specks in the picture.

use super::{Lint, Linter, VisibilitySurvey};
use scene_file::PathStep::{Field, Index};

/// Models are specks if the width and height of their bounding rectangle are below this fraction of
/// the picture's, so that the rectangle covers less than a thousandth of the area.
const LEAST_SIDE: f64 = 0.0316;
/// One of several models is a speck if it is smaller than this in both directions, in pixels.
const LEAST_PIXELS: f64 = 2.0;

/// Returns one warning, located at the field `camera`, if all models together are a speck.
pub(super) fn lint_tiny_picture(adviser: &Linter<'_>) -> Option<Lint> {
    let whole = adviser.surveys.iter().fold(VisibilitySurvey::default(), VisibilitySurvey::merge);
    let [width, height] = whole.window_part()?;
    if width.max(height) >= LEAST_SIDE {
        return None;
    }
    let [across, down] = pixels(adviser, [width, height]);
    let message = format!(
        "the models cover less than a thousandth of the picture: {across:.1} x {down:.1} pixels"
    );
    let help = "move the camera closer, or use Frame(…), which fills the picture".to_owned();
    let error = adviser.origin.error_at(&[Field("camera")], message, Some(help));
    Some(Lint { code: "tiny-picture", error })
}

/// Warns about each model smaller than two pixels in a scene with several models, such as a model
/// in meters next to one in millimeters.
pub(super) fn lint_tiny_models(adviser: &Linter<'_>) -> Vec<Lint> {
    let models = adviser.survey_models();
    if models.len() < 2 {
        return Vec::new();
    }
    let tiny = models.into_iter().filter_map(|(number, instance, survey)| {
        let [across, down] = pixels(adviser, survey.window_part()?);
        if across.max(down) >= LEAST_PIXELS {
            return None;
        }
        let name = adviser.model_name(instance);
        let message = format!("{name} covers only {across:.2} x {down:.2} pixels of the picture");
        let help = "give the model a larger `scale`, or remove it; file formats use different units, such as meters in glTF and millimeters in STL".to_owned();
        let path = [Field("models"), Index(number)];
        let error = adviser.origin.error_at(&path, message, Some(help));
        Some(Lint { code: "tiny-model", error })
    });
    tiny.collect()
}

/// Converts fractions of the picture's sides to pixels.
fn pixels(adviser: &Linter<'_>, [width, height]: [f64; 2]) -> [f64; 2] {
    let image = adviser.scene.image;
    [width * f64::from(image.width), height * f64::from(image.height)]
}
