//! Lints for valid scenes that are probably unintended, such as a camera inside a model or an empty
//! picture.
//!
//! Lints examine the resolved scene. Its points, lines and triangles pass through its camera and
//! are clipped against its view volume once (CL-1). The lints compare the counts with the file.
//!
//! | code | condition |
//! | --- | --- |
//! | `nothing-visible`, `model-not-visible` | no primitive is left after clipping |
//! | `camera-inside` | the eye is enclosed by a closed surface |
//! | `cut-by-near`, `cut-by-far` | vertices within the window are outside a depth plane |
//! | `wasteful-depth-range` | the near plane is far closer than anything visible |
//! | `aspect-mismatch` | the window's aspect ratio is not the picture's |
//! | `no-light` | a shaded style without light, environment or emission |
//! | `flat-stereo` | a stereo pair whose two pictures are the same to within a pixel |
//! | `label-not-visible` | the point of a label is not in the picture |
//! | `missing-glyph` | the stroke font lacks a character of a label, a caption or a sheet |
//! | `wide-stereo` | a stereo pair whose eyes are too far apart for the distance of the models |
//! | `sections-ignored` | section planes without a line drawing that they could cut |
//! | `section-removes-all`, `section-misses` | a section plane with all models on one side |
//! | `sheet-view-missing`, `section-oblique` | a view or a section that the sheet does not show |
//! | `overlay-not-on-sheet` | an overlay that sheets do not show, such as a grid |
//! | `tiny-picture`, `tiny-model` | models below a thousandth of the picture, or below two pixels |
//! | `coincident-instances` | instances of a model at the same position |
//! | `ground-above-models` | a ground above the lowest point of the models |
//! | `narrow-field-of-view` | a field of view that is probably in radians |
//! | `color-above-one` | a light color written in bytes |
//! | `depth-on-white` | the style `Depth`, white for near surfaces, over a white background |
//! | `camera-path-turns-over` | a path through its target or parallel to up |
//!
//! Viewports with separate cameras are also checked for `nothing-visible` and `tiny-picture`.

mod camera_path;
mod coverage;
mod depth;
mod depth_style;
mod ground;
mod instances;
mod other_units;
mod sections;
#[cfg(feature = "sheets")]
mod sheet;
mod stereo;
mod text;
mod visibility_survey;

use super::lens::given_window;
use super::view_projection::select_lens;
use super::{Origin, ResolveOptions, Scene, Style};
use clip::PlaneIndex;
use homog::Point;
use model::CameraProjection;
use scene_file::PathStep::{Field, Index};
use scene_file::file::{ProjectionFile, StyleFile, ViewFile};
use scene_file::{SceneError, SceneFile};
use visibility_survey::VisibilitySurvey;

/// Aspect ratios that differ by no more than this fraction are treated as equal.
const ASPECT_TOLERANCE: f64 = 0.01;

/// A warning about a valid scene.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Lint {
    /// A stable name for programs, in lowercase with hyphens.
    pub code: &'static str,
    /// The message with its position in the file and the suggested fix.
    pub error: SceneError,
}

/// Returns the lints of a resolved scene, in file order.
///
/// The cost is one pass over all vertices, O(vertices + primitives), for the scene and for each
/// viewport with a separate camera, without rendering. Lints never make a scene invalid. `options`
/// are the options used for resolution.
#[must_use]
#[cfg_attr(not(feature = "sheets"), expect(unused_variables))]
pub fn lint_scene(
    origin: &Origin,
    file: &SceneFile,
    scene: &Scene,
    options: &ResolveOptions,
) -> Vec<Lint> {
    let surveys = survey_scene(scene);
    let adviser = Linter { origin, file, scene, surveys: &surveys };
    let mut advice = Vec::new();
    advice.extend(adviser.lint_visibility());
    // A parallel view has no eye that could be inside a model.
    let viewer = scene.view_projection.viewer().divide();
    advice.extend(viewer.and_then(|eye| adviser.lint_camera_inside(eye)));
    advice.extend(coverage::lint_tiny_picture(&adviser));
    advice.extend(coverage::lint_tiny_models(&adviser));
    advice.extend(depth::lint_depth_clipping(&adviser));
    advice.extend(depth::lint_depth_range(&adviser));
    advice.extend(adviser.lint_aspect_ratio());
    advice.extend(adviser.lint_missing_light());
    advice.extend(stereo::lint_flat_stereo(&adviser));
    advice.extend(text::lint_text(&adviser));
    advice.extend(stereo::lint_wide_stereo(&adviser));
    advice.extend(sections::lint_idle_sections(&adviser));
    #[cfg(feature = "sheets")]
    advice.extend(sheet::lint_sheet(&adviser, &options.import.allow_outside));
    advice.extend(instances::lint_coincident_instances(&adviser));
    advice.extend(ground::lint_high_ground(&adviser));
    advice.extend(lint_viewports(origin, file, scene));
    advice.extend(lint_description(origin, file));
    // The sort is stable: lints at one position stay in the order above.
    advice.sort_by_key(|advice| advice.error.span.start);
    advice
}

/// Returns the visibility survey of each model in a scene, in scene order.
fn survey_scene(scene: &Scene) -> Vec<VisibilitySurvey> {
    let survey = |placed| VisibilitySurvey::from_model(scene, placed);
    scene.models.iter().map(survey).collect()
}

/// Warns about viewports whose cameras see nothing, or almost nothing.
fn lint_viewports(origin: &Origin, file: &SceneFile, scene: &Scene) -> Vec<Lint> {
    if file.viewports.len() != scene.insets.len() {
        return Vec::new();
    }
    let mut advice = Vec::new();
    let numbered = file.viewports.iter().zip(&scene.insets).enumerate();
    for (number, (_, inset)) in numbered.filter(|(_, (own, _))| own.camera.is_some()) {
        let origin = &origin.for_viewport(number);
        let surveys = survey_scene(&inset.scene);
        let adviser = Linter { origin, file, scene: &inset.scene, surveys: &surveys };
        advice.extend(adviser.lint_nothing_visible());
        advice.extend(coverage::lint_tiny_picture(&adviser));
    }
    advice
}

/// Returns the lints of a scene file that do not depend on models, even if the file has mistakes.
#[must_use]
pub fn lint_description(origin: &Origin, file: &SceneFile) -> Vec<Lint> {
    let mut advice: Vec<Lint> = camera_path::lint_camera_path(origin, file).into_iter().collect();
    advice.extend(depth_style::lint_white_background(origin, file));
    advice.extend(other_units::lint_field_of_view(origin, file));
    advice.extend(other_units::lint_light_colors(origin, file));
    let is_drawn = |style: &StyleFile| matches!(style, StyleFile::Lines(_));
    let insets = file.viewports.iter().filter_map(|viewport| viewport.style.as_ref());
    let cuts_drawing = file.sheet.is_some() || insets.chain([&file.style]).any(is_drawn);
    if !file.sections.is_empty() && !cuts_drawing {
        let message = "sections cut only line drawings, but this scene has none";
        let help = "choose style: Lines(), or draw the scene with `alberti sheet`".to_owned();
        let error = origin.error_at(&[Field("sections")], message, Some(help));
        advice.push(Lint { code: "sections-ignored", error });
    }
    advice
}

/// The scene under inspection, in every form that lints need.
struct Linter<'a> {
    /// The file and its text, for positions in messages.
    origin: &'a Origin,
    /// The scene as written, which distinguishes chosen values from defaults.
    file: &'a SceneFile,
    /// The resolved scene.
    scene: &'a Scene,
    /// The visibility survey of each model, in scene order.
    surveys: &'a [VisibilitySurvey],
}

impl Linter<'_> {
    /// Returns the name of a model for messages.
    fn model_name(&self, model: usize) -> &str {
        &self.scene.models[model].model.name
    }

    /// Returns the surveys of the scene's models, each with the numbers of the model and of its
    /// first instance.
    ///
    /// A model counts as a whole: it is not a mistake if some trees of a forest are outside the
    /// picture.
    fn survey_models(&self) -> Vec<(usize, usize, VisibilitySurvey)> {
        let mut first = 0;
        let models = self.file.models.iter().enumerate().map(|(number, entry)| {
            let instances = first..(first + entry.instance_count()).min(self.surveys.len());
            first = instances.end;
            let own = self.surveys[instances.clone()].iter();
            (
                number,
                instances.start,
                own.fold(VisibilitySurvey::default(), VisibilitySurvey::merge),
            )
        });
        models.collect()
    }

    /// Warns about models outside the view volume. If all models are outside, one warning at the
    /// camera replaces the warnings per model, since the camera is the more likely cause.
    fn lint_visibility(&self) -> Vec<Lint> {
        if let Some(lint) = self.lint_nothing_visible() {
            return vec![lint];
        }
        let models = self.survey_models().into_iter();
        let unseen = models.filter(|(_, _, survey)| survey.is_unseen());
        let advice = unseen.map(|(number, instance, survey)| {
            let what = describe_rejection(self.scene, &survey);
            let message = format!("{} is not in the picture: {what}", self.model_name(instance));
            let help = "move it into view, or remove it".to_owned();
            let fault =
                self.origin.error_at(&[Field("models"), Index(number)], message, Some(help));
            Lint { code: "model-not-visible", error: fault }
        });
        advice.collect()
    }

    /// Warns about a camera that sees none of the models.
    fn lint_nothing_visible(&self) -> Option<Lint> {
        if self.surveys.is_empty() || !self.surveys.iter().all(VisibilitySurvey::is_unseen) {
            return None;
        }
        let whole = self.surveys.iter().fold(VisibilitySurvey::default(), VisibilitySurvey::merge);
        let message =
            format!("nothing is in the picture: {}", describe_rejection(self.scene, &whole));
        let help = suggest_visibility_fix(self.scene, &whole);
        let error = self.origin.error_at(&[Field("camera")], message, Some(help));
        Some(Lint { code: "nothing-visible", error })
    }

    /// Warns about an eye inside a closed model, of which only back faces would be visible. Names
    /// the first such model; `eye` is in world space.
    fn lint_camera_inside(&self, eye: Point<homog::World>) -> Option<Lint> {
        let number = self.surveys.iter().position(VisibilitySurvey::encloses_eye)?;
        let [x, y, z] = eye.raw().to_array();
        let message =
            format!("the eye at ({x:.3}, {y:.3}, {z:.3}) is inside {}", self.model_name(number));
        let help = "move the eye out, or use Frame(…), which shows everything";
        let fault =
            self.origin.error_at(&[Field("camera"), Field("view")], message, Some(help.to_owned()));
        Some(Lint { code: "camera-inside", error: fault })
    }

    /// Warns about an aspect ratio of the window, or of a model's camera, that differs from the
    /// picture's.
    ///
    /// A frustum with fixed sides stretches the picture; a model's camera shows more or less at the
    /// sides, since only its vertical angle is used. Ratios within [`ASPECT_TOLERANCE`] pass,
    /// because cameras often store 1.7778 for 16 : 9.
    fn lint_aspect_ratio(&self) -> Option<Lint> {
        let image = self.scene.image;
        let view_size = image.view_size();
        let picture = view_size.x / view_size.y;
        let (what, shape, place) = match (&self.file.camera.projection, &self.file.camera.view) {
            (Some(projection), _) => {
                let [left, right, bottom, top] = given_window(projection)?;
                let what = match projection {
                    ProjectionFile::Orthographic { .. } => "the window of Orthographic",
                    ProjectionFile::ApexMovedFrustum { .. } => "the window of ApexMovedFrustum",
                    _ => "the window of Frustum",
                };
                (what, ((right - left) / (top - bottom)).abs(), "projection")
            }
            (None, ViewFile::FromModel(choice)) => {
                let lens = select_lens(self.origin, &self.scene.models, choice)?;
                let shape = match lens.projection {
                    // A camera without an aspect ratio takes the picture's.
                    CameraProjection::Perspective { aspect, .. } => aspect?,
                    CameraProjection::Orthographic { half_width, half_height, .. } => {
                        half_width / half_height
                    }
                };
                ("the model's camera", shape, "view")
            }
            _ => return None,
        };
        if (picture / shape - 1.0).abs() <= ASPECT_TOLERANCE {
            return None;
        }
        let effect = if place == "projection" {
            "everything is stretched"
        } else {
            "the picture shows more or less at the sides"
        };
        let message =
            format!("{what} is {shape:.3} : 1, but the picture is {picture:.3} : 1, so {effect}");
        let width = libm::round(view_size.y * shape).max(1.0);
        let help = format!(
            "for a picture of that shape, write image: (size: ({width}, {}))",
            image.height
        );
        let fault = self.origin.error_at(&[Field("camera"), Field(place)], message, Some(help));
        Some(Lint { code: "aspect-mismatch", error: fault })
    }

    /// Warns about a shaded style without any light source: no light, no environment, and no unlit
    /// or emissive material. Scenes without the field `lights` get a default key light and never
    /// trigger this.
    fn lint_missing_light(&self) -> Option<Lint> {
        let scene = self.scene;
        let lit = matches!(scene.style, Style::Shaded | Style::Flat);
        let shines =
            |at: &model::Material| at.unlit || at.emissive.iter().any(|channel| *channel > 0.0);
        let alone = scene.models.iter().flat_map(|placed| &placed.model.materials).any(shines);
        if !lit || alone || !scene.lights.is_empty() || scene.environment.is_some() {
            return None;
        }
        let message = "there is no light: surfaces will be black";
        let help = "remove `lights`, or add one: lights: [Directional(direction: (-1, -2, -1), intensity: 3), Ambient(intensity: 1)]";
        let fault = self.origin.error_at(&[Field("lights")], message, Some(help.to_owned()));
        Some(Lint { code: "no-light", error: fault })
    }
}

impl Scene {
    /// Explains why a picture of the scene shows nothing.
    #[must_use]
    pub fn empty_reason(&self) -> String {
        let surveys = survey_scene(self);
        let whole = surveys.iter().fold(VisibilitySurvey::default(), VisibilitySurvey::merge);
        if whole.total == 0 {
            "there is nothing to draw".to_owned()
        } else if whole.is_unseen() {
            let fix = suggest_visibility_fix(self, &whole);
            format!("{}; {fix}", describe_rejection(self, &whole))
        } else {
            "everything is edge-on, transparent or too small; look from another side, or move \
             closer"
                .to_owned()
        }
    }
}

/// Whether all vertices are behind the eye of a perspective; a parallel projection has no eye
/// (w = 0).
fn is_behind_eye(scene: &Scene, survey: &VisibilitySurvey) -> bool {
    let perspective = scene.view_projection.viewer().w() != 0.0;
    perspective && survey.depth_range().is_some_and(|(_, far)| far <= 0.0)
}

/// Describes the planes that everything is outside of. Without such a plane, counts the primitives
/// outside each of the six planes; a primitive may be outside several.
fn describe_rejection(scene: &Scene, survey: &VisibilitySurvey) -> String {
    if is_behind_eye(scene, survey) {
        return "everything is behind the camera".to_owned();
    }
    let counts = PlaneIndex::BOX.iter().zip(survey.outside).filter(|(_, count)| *count > 0);
    let whole = counts.clone().filter(|(_, count)| *count == survey.total);
    let whole: Vec<String> = whole.map(|(plane, _)| plane.to_string()).collect();
    match whole.as_slice() {
        [] => {
            let each = counts.map(|(plane, count)| format!("{count} outside the {plane} plane"));
            let each = each.collect::<Vec<_>>().join(", ");
            format!("of {} points, lines and triangles, {each}", survey.total)
        }
        [plane] => format!("everything is outside the {plane} plane"),
        planes => format!("everything is outside the {} planes", files::listed(planes)),
    }
}

/// Suggests a fix: turn the camera if the models are behind it, change the depth planes if they
/// reject the models, otherwise aim at the models. Distances are along the gaze, in world units.
fn suggest_visibility_fix(scene: &Scene, survey: &VisibilitySurvey) -> String {
    let of = |plane: PlaneIndex| survey.outside[plane.index()] == survey.total;
    let span = survey.depth_range();
    let in_depth = span.filter(|_| of(PlaneIndex::NEAR) || of(PlaneIndex::FAR));
    match in_depth {
        _ if is_behind_eye(scene, survey) => {
            "turn the camera around, or write `view: Frame(from: Front)`".to_owned()
        }
        Some((near, far)) => format!(
            "it is {near:.4} to {far:.4} in front of the eye: remove `near` and `far`, or make them enclose that range"
        ),
        None => {
            "look toward it, or write `view: Frame(from: Front)`, which finds a suitable position"
                .to_owned()
        }
    }
}
