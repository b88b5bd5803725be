//! What makes sense in a scene and is still probably not meant: a camera inside of a model, a picture of nothing.
//!
//! Everything here is found by looking: the points, lines and triangles of the scene go through its camera and its view volume
//! (CL-1), once, and what became of them is compared with what the file says.

mod depth;
mod survey;

use super::file::{ProjectionFile, ViewFile};
use super::locate::Step::{Field, Index};
use super::viewpoint::chosen_lens;
use super::{Origin, Scene, SceneError, SceneFile, Style};
use clip::PlaneIndex;
use homog::Point;
use model::LensKind;
use survey::Survey;

/// Two shapes of pictures differ if their ratios do by more than this part.
const SAME_SHAPE: f64 = 0.01;

/// Something that is probably not meant.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Advice {
    /// A name for programs, lower case with hyphens.
    pub code: &'static str,
    /// What it is, where, and what to do about it.
    pub fault: SceneError,
}

/// What is probably not meant in a scene that could be resolved.
#[must_use]
pub fn advise(origin: &Origin, file: &SceneFile, scene: &Scene) -> Vec<Advice> {
    let viewer = scene.view_projection.viewer().divide();
    let surveys: Vec<Survey> = scene
        .models
        .iter()
        .map(|placed| Survey::of(&scene.view_projection, placed, viewer))
        .collect();
    let adviser = Adviser { origin, file, scene, surveys: &surveys };
    let mut advice = Vec::new();
    advice.extend(adviser.unseen());
    advice.extend(viewer.and_then(|eye| adviser.inside(eye)));
    advice.extend(depth::cut(&adviser));
    advice.extend(depth::wasted(&adviser));
    advice.extend(adviser.shape());
    advice.extend(adviser.dark());
    advice.sort_by_key(|advice| advice.fault.span.start);
    advice
}

/// What advice is made from.
struct Adviser<'a> {
    origin: &'a Origin,
    file: &'a SceneFile,
    scene: &'a Scene,
    surveys: &'a [Survey],
}

impl Adviser<'_> {
    fn name(&self, model: usize) -> &str {
        &self.scene.models[model].model.name
    }

    /// Models that are not in the picture, or one piece of advice if none is.
    fn unseen(&self) -> Vec<Advice> {
        let is_unseen = |survey: &Survey| survey.all > 0 && survey.inside == 0;
        if !self.surveys.is_empty() && self.surveys.iter().all(is_unseen) {
            let whole = self.surveys.iter().fold(Survey::default(), Survey::with);
            let message = format!("nothing is in the picture: {}", self.rejected(&whole));
            let help = self.help_against(&whole);
            let fault = self.origin.fault(&[Field("camera")], message, Some(help));
            return vec![Advice { code: "nothing-visible", fault }];
        }
        let unseen = self.surveys.iter().enumerate().filter(|(_, survey)| is_unseen(survey));
        let advice = unseen.map(|(number, survey)| {
            let what = self.rejected(survey);
            let message = format!("{} is not in the picture: {what}", self.name(number));
            let help = "place it where the camera looks, or leave it out".to_owned();
            let fault = self.origin.fault(&[Field("models"), Index(number)], message, Some(help));
            Advice { code: "model-not-visible", fault }
        });
        advice.collect()
    }

    /// An eye inside of a closed model.
    fn inside(&self, eye: Point<homog::World>) -> Option<Advice> {
        let number = self.surveys.iter().position(Survey::surrounds)?;
        let [x, y, z] = eye.raw().to_array();
        let message =
            format!("the eye at ({x:.3}, {y:.3}, {z:.3}) is inside of {}", self.name(number));
        let help = "move the eye out; Frame(…) finds a place from which everything is seen";
        let fault =
            self.origin.fault(&[Field("camera"), Field("view")], message, Some(help.to_owned()));
        Some(Advice { code: "camera-inside", fault })
    }

    /// A picture of another shape than the camera or the window.
    fn shape(&self) -> Option<Advice> {
        let image = self.scene.image;
        let picture = f64::from(image.width) / f64::from(image.height);
        let (what, shape, place) = match (&self.file.camera.projection, &self.file.camera.view) {
            (Some(ProjectionFile::Frustum { left, right, bottom, top, .. }), _) => {
                let shape = (right.value() - left.value()) / (top.value() - bottom.value());
                ("the window of the Frustum", shape.abs(), "projection")
            }
            (None, ViewFile::FromModel(choice)) => {
                let lens = chosen_lens(self.origin, &self.scene.models, choice)?;
                let shape = match lens.kind {
                    LensKind::Perspective { aspect, .. } => aspect?,
                    LensKind::Orthographic { half_width, half_height, .. } => {
                        half_width / half_height
                    }
                };
                ("the model's camera", shape, "view")
            }
            _ => return None,
        };
        if (picture / shape - 1.0).abs() <= SAME_SHAPE {
            return None;
        }
        let effect = if place == "projection" {
            "everything is stretched"
        } else {
            "it shows more, or less, at the sides"
        };
        let message =
            format!("{what} is {shape:.3} : 1 and the picture {picture:.3} : 1: {effect}");
        let width = libm::round(f64::from(image.height) * shape).max(1.0);
        let help = format!("a picture of that shape: image: (size: ({width}, {}))", image.height);
        let fault = self.origin.fault(&[Field("camera"), Field(place)], message, Some(help));
        Some(Advice { code: "aspect-mismatch", fault })
    }

    /// Surfaces that wait for light in vain.
    fn dark(&self) -> Option<Advice> {
        let scene = self.scene;
        let lit = matches!(scene.style, Style::Shaded | Style::Flat);
        let shines =
            |at: &model::Material| at.unlit || at.emissive.iter().any(|channel| *channel > 0.0);
        let alone = scene.models.iter().flat_map(|placed| &placed.model.materials).any(shines);
        if !lit || alone || !scene.lights.is_empty() || scene.environment.is_some() {
            return None;
        }
        let message = "there is no light: surfaces will be black";
        let help = "leave `lights` out, or add one: lights: [Sun(direction: (-1, -2, -1), lux: 3), Ambient(lux: 1)]";
        let fault = self.origin.fault(&[Field("lights")], message, Some(help.to_owned()));
        Some(Advice { code: "no-light", fault })
    }

    /// Whether all of it is behind the eye of a perspective.
    fn is_behind(&self, survey: &Survey) -> bool {
        let perspective = self.scene.view_projection.viewer().w() != 0.0;
        perspective && survey.nearest_and_farthest().is_some_and(|(_, far)| far <= 0.0)
    }

    /// Which planes everything is outside of, in words.
    fn rejected(&self, survey: &Survey) -> String {
        if self.is_behind(survey) {
            return "all of it is behind the eye".to_owned();
        }
        let counts = PlaneIndex::BOX.iter().zip(survey.outside).filter(|(_, count)| *count > 0);
        let whole = counts.clone().filter(|(_, count)| *count == survey.all);
        let whole: Vec<String> = whole.map(|(plane, _)| plane.to_string()).collect();
        match whole.as_slice() {
            [] => {
                let each = counts.map(|(plane, count)| format!("{count} outside of {plane}"));
                let each = each.collect::<Vec<_>>().join(", ");
                format!("of {} points, lines and triangles {each}", survey.all)
            }
            [plane] => format!("all of it is outside of the {plane} plane"),
            [planes @ .., last] => {
                format!(
                    "all of it is outside of the {} and the {last} plane",
                    planes.join(", the ")
                )
            }
        }
    }

    /// What to do if nothing is seen.
    fn help_against(&self, survey: &Survey) -> String {
        let of = |plane: PlaneIndex| survey.outside[plane.index()] == survey.all;
        let span = survey.nearest_and_farthest();
        let in_depth = span.filter(|_| of(PlaneIndex::NEAR) || of(PlaneIndex::FAR));
        match in_depth {
            _ if self.is_behind(survey) => "turn the camera round, or use Frame(…)".to_owned(),
            Some((near, far)) => format!(
                "it is {near:.4} to {far:.4} before the eye: leave `near` and `far` out, or set them around that"
            ),
            None => {
                "look towards it, or use Frame(…), which finds the place to look from".to_owned()
            }
        }
    }
}
