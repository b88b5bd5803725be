//! Flags that choose the state of a model: its glTF scene, material variant, animation and time.
//!
//! The flags apply to every model of a scene; a scene file can set each model's state separately.

use super::{CliError, print_message};
use pipeline::{Origin, ResolveError, Scene, SceneFile};
use scene::CameraPath;
use scene_file::file::{Choice, Finite, ModelFile};

/// The state of a model; each flag replaces the field of the same name in a scene file.
#[derive(Clone, Debug, Default, clap::Args)]
pub(crate) struct ModelStateArgs {
    /// Scene of the model, by name or index [default: the model's own default]
    #[arg(help_heading = "Input", long, value_name = "NAME|INDEX", value_parser = parse_choice)]
    pub(crate) scene: Option<Choice>,
    /// Material variant of the model (KHR_materials_variants), by name or index
    #[arg(help_heading = "Input", long, value_name = "NAME|INDEX", value_parser = parse_choice)]
    pub(crate) variant: Option<Choice>,
    /// Animation that poses the model, by name or index [default: the first if --time is set]
    #[arg(help_heading = "Input", long, value_name = "NAME|INDEX", value_parser = parse_choice)]
    pub(crate) animation: Option<Choice>,
    /// Time of the animation and of the scene's camera path, in seconds [default: 0 if --animation
    /// is set]
    ///
    /// For a scene with a camera path, the picture is the frame that `animate` shows at that time.
    /// Models move only if the scene or --animation names their animation.
    #[arg(help_heading = "Input", long, value_name = "SECONDS", value_parser = parse_time, allow_hyphen_values = true)]
    pub(crate) time: Option<Finite>,
}

impl ModelStateArgs {
    /// Replaces the fields of all models in a scene.
    ///
    /// In a scene with a camera path, `--time` without `--animation` is the time of the path; it
    /// poses only models whose animation or time the scene sets.
    pub(crate) fn apply_to_scene(&self, file: &mut SceneFile) {
        let moves_camera = file.camera_path.is_some();
        for model in &mut file.models {
            let is_animated = model.animation.is_some() || model.time.is_some();
            let rests = moves_camera && self.animation.is_none() && !is_animated;
            let state = if rests { Self { time: None, ..self.clone() } } else { self.clone() };
            state.apply_to(model);
        }
    }

    /// Moves the camera of a scene to its position on the camera path at `--time`, if both exist.
    ///
    /// Only the camera moves, as in a sequence: lights stay where the scene's own camera puts them.
    ///
    /// # Errors
    /// Returns an error if the keyframes are invalid, or if there is no view at that time.
    pub(crate) fn place_camera(
        &self,
        origin: &Origin,
        file: &SceneFile,
        scene: &mut Scene,
    ) -> Result<(), CliError> {
        let Some(time) = self.time else { return Ok(()) };
        let path = CameraPath::from_scene_file(origin, file).map_err(ResolveError::from)?;
        if let Some(path) = path {
            let ([begin, end], time) = (path.time_range(), time.value());
            if time > end {
                let message = format!(
                    "the camera path ends at {end} s, before --time {time}: the picture shows its last keyframe"
                );
                print_message("warning", &message);
            } else if time < begin {
                let message = format!(
                    "the camera path begins at {begin} s, after --time {time}: the picture shows its first keyframe"
                );
                print_message("warning", &message);
            }
            path.place_camera(origin, time, scene).map_err(ResolveError::from)?;
        } else {
            warn_of_late_time(time.value(), scene);
        }
        Ok(())
    }

    /// Replaces the fields of a scene's model with the values of the flags.
    ///
    /// Choosing something that a model lacks causes an error when the model is loaded.
    pub(crate) fn apply_to(&self, model: &mut ModelFile) {
        let replace = |flag: &Option<Choice>, field: &mut Option<Choice>| {
            if flag.is_some() {
                field.clone_from(flag);
            }
        };
        replace(&self.scene, &mut model.scene);
        replace(&self.variant, &mut model.variant);
        replace(&self.animation, &mut model.animation);
        model.time = self.time.or(model.time);
    }
}

/// Warns about a time after the end of every animation.
fn warn_of_late_time(time: f64, scene: &Scene) {
    let animations = scene.models.iter().flat_map(|placed| &placed.model.animations);
    let end = animations.map(|animation| animation.duration_seconds).fold(0.0, f64::max);
    if end > 0.0 && time > end {
        let message = format!(
            "the animation ends at {end} s, before --time {time}: the picture shows its last pose"
        );
        print_message("warning", &message);
    }
}

/// Parses an index if the text is a whole number, and a name otherwise.
///
/// A name that is a whole number can be chosen only in a scene file, as `Name("3")`.
fn parse_choice(text: &str) -> Result<Choice, String> {
    Ok(text.parse().map_or_else(|_| Choice::Name(text.to_owned()), Choice::Index))
}

/// Parses a finite number of seconds.
fn parse_time(text: &str) -> Result<Finite, String> {
    let seconds = text.parse().ok().and_then(Finite::new);
    seconds.ok_or_else(|| "expected a number of seconds, such as 1.5".to_owned())
}
