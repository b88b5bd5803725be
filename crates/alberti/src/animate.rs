//! `alberti animate`: a turntable or an animation as image files, APNG, GIF or raw frames.
//!
//! ```text
//!  scene ─► motion, times, frame count ─► frames in order ─► PNG files, APNG, GIF, raw bytes
//! ```
//! The scene is loaded and resolved once. The models are then posed and rendered for each frame.
//! Frames are rendered in parallel, one per thread, and written in order; only a few frames per
//! thread are in memory at a time.

mod frame_sink;

use super::CliError;
use super::load_options::LoadArgs;
use super::messages::{print_message, print_warnings};
use super::progress::ProgressCounter;
use super::render::thread_count;
use super::scene_overrides::SceneOverrideArgs;
use super::unused_flags::find_unused_overrides;
use frame_sink::FrameSink;
use model::ModelInstance;
use pipeline::sequence::{Motion, Sequence, SequenceError};
use pipeline::{Origin, ResolveError, Scene};
use scene::{CameraPath, select_animation};
use scene_file::file::{Choice, Finite, SceneFile};
use std::path::PathBuf;

/// Arguments of `alberti animate`.
#[derive(Debug, clap::Args)]
pub(crate) struct AnimateArgs {
    /// Scene (.ron) or model (.gltf, .glb, .stl, .obj, .ply, .3mf)
    input: PathBuf,
    /// Output: NAME_{frame:04}.png for one file per frame, NAME.png for an animated PNG, NAME.gif,
    /// or - for raw RGBA frames on the standard output
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Rotate the models by this angle instead of playing their animation
    /// [default: 360, if they have no animation]
    #[arg(
        long,
        value_name = "DEGREES",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "360",
        value_parser = parse_finite
    )]
    turntable: Option<Finite>,
    /// Number of frames [default: the length of the animation; 120 for a turntable]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    frames: Option<u32>,
    /// Frames per second
    #[arg(long, value_name = "N", default_value = "30", value_parser = parse_frame_rate)]
    fps: f64,
    /// Start time in seconds; a time after --to plays the animation backward [default: 0]
    #[arg(long, value_name = "SECONDS", value_parser = parse_finite, allow_hyphen_values = true)]
    from: Option<Finite>,
    /// End time in seconds [default: the end of the animation]
    #[arg(long, value_name = "SECONDS", value_parser = parse_finite, allow_hyphen_values = true)]
    to: Option<Finite>,
    /// Number of threads; does not change the frames [default: one per core]
    #[arg(long, value_name = "N", value_parser = crate::options::parse_thread_count)]
    threads: Option<u16>,
    #[command(flatten)]
    overrides: SceneOverrideArgs,
    #[command(flatten)]
    load_options: LoadArgs,
}

/// Renders the frames and writes each as soon as it is ready.
///
/// Model warnings are printed first: they apply to every frame, and users should learn about a
/// missing texture before hundreds of frames are rendered without it.
///
/// # Errors
/// Returns an error if the input is invalid, a frame cannot be rendered, or writing the output
/// fails. No animation file is left behind in that case; PNG files for finished frames remain.
pub(crate) fn run(args: &AnimateArgs) -> Result<(), CliError> {
    let (origin, file, scene) = args.overrides.open_scene(&args.input, &args.load_options)?;
    let unused = find_unused_overrides(&args.overrides, &scene, false);
    unused.iter().for_each(|warning| print_message("warning", warning));
    print_warnings::<drawing::Warning>(&scene, &[], false);
    if args.fps > MAX_GIF_FPS && args.output.extension().is_some_and(|ending| ending == "gif") {
        let message = "viewers slow down a GIF with more than 50 frames per second; use --fps 50, \
                       or write an animated PNG, as in -o film.png";
        print_message("warning", message);
    }
    let film = args.build_sequence(&origin, &file, scene)?;
    let mut sink = FrameSink::open(&args.input, &args.output, &film, args.fps)?;
    let counter = ProgressCounter::start(film.frame_count());
    let drawn = film.render_frames(thread_count(args.threads), |frame, picture| {
        counter.increment();
        sink.write_frame(frame, picture)
    });
    match drawn {
        Ok(()) => sink.finish(),
        Err(SequenceError::Output(failure)) => Err(failure),
        Err(SequenceError::Render(error)) => Err(error.into()),
        Err(SequenceError::Scene(error)) => Err(error.into()),
        Err(other) => Err(CliError::Usage(other.to_string())),
    }
}

/// GIF delays are whole hundredths of a second, and viewers ignore a delay below two.
const MAX_GIF_FPS: f64 = 50.0;

impl AnimateArgs {
    /// Returns the sequence that the flags and the scene describe.
    ///
    /// A turntable rotates the models; otherwise their animations play, and the camera follows its
    /// keyframes, if any. Start, end and number of frames default to the animation's.
    ///
    /// | flags and scene | motion | default number of frames |
    /// | --- | --- | --- |
    /// | `--turntable` | models rotate by the angle | 120 |
    /// | an animation | its time runs from start to end | length × frames per second |
    /// | camera keyframes only | the camera moves | length × frames per second |
    /// | none of these | models rotate by 360° | 120 |
    ///
    /// The end is the time of the frame after the last, so that a loop does not show its first
    /// picture twice. If the start is after the end, the animation plays backward. Camera keyframes
    /// can be combined with any of these motions; they then determine the default start and end
    /// times, and thus the default number of frames.
    ///
    /// # Errors
    /// Returns an error if the scene selects an animation that the model does not have, or the
    /// camera keyframes are invalid.
    fn build_sequence(
        &self,
        origin: &Origin,
        file: &SceneFile,
        scene: Scene,
    ) -> Result<Sequence, CliError> {
        let animations = choose_animations(&scene.models, file)?;
        let ends = scene.models.iter().zip(&animations).filter_map(|(placed, &animation)| {
            Some(placed.model.animations.get(animation?)?.duration_seconds)
        });
        let end = ends.fold(0.0, f64::max);
        let path = CameraPath::from_scene_file(origin, file).map_err(ResolveError::from)?;
        let [begin, end] = path.as_ref().map_or([0.0, end], CameraPath::time_range);
        let from = self.from.map_or(begin, Finite::value);
        let to = self.to.map_or(end, Finite::value);
        let motion = match self.turntable {
            None if animations.iter().any(Option::is_some) => {
                Motion::Animations { animations, from, to }
            }
            // Only the camera moves, along its keyframes.
            None if path.is_some() => Motion::Turntable { angle: 0.0 },
            degrees => {
                Motion::Turntable { angle: degrees.map_or(360.0, Finite::value).to_radians() }
            }
        };
        self.warn_of_times(&motion, path.is_some(), end);
        let frames = match (&motion, self.frames) {
            (_, Some(frames)) => frames as usize,
            (Motion::Turntable { .. }, None) if path.is_none() => 120,
            (_, None) => libm::round((to - from).abs() * self.fps).clamp(1.0, 100_000.0) as usize,
        };
        let film = Sequence::new(origin, file, scene, motion, frames)?;
        match path {
            None => Ok(film),
            Some(path) => Ok(film.with_camera_path(origin, &path, [from, to])?),
        }
    }
}

impl AnimateArgs {
    /// Warns if `--time`, `--from` or `--to` has no effect, or if `--to` is after the end.
    fn warn_of_times(&self, motion: &Motion, has_path: bool, end: f64) {
        let is_timeless = matches!(motion, Motion::Turntable { .. }) && !has_path;
        if self.overrides.model_state.time.is_some() {
            let message =
                "--time does nothing here, because every frame has a time; use --from and --to";
            print_message("warning", message);
        }
        if is_timeless && (self.from.is_some() || self.to.is_some()) {
            let message = "--from and --to do nothing here: a turntable has no times; its length is \
                           --frames divided by --fps";
            print_message("warning", message);
        } else if !is_timeless && self.to.is_some_and(|to| to.value() > end) {
            let message = format!(
                "the animation ends at {end} s: later frames show its last pose (--from and \
                 --to are in seconds)"
            );
            print_message("warning", &message);
        }
    }
}

/// Returns the animation of each model instance: the one the scene selects, or the model's first.
///
/// There is one entry per instance, in the order of the scene file. `None` means that the model
/// does not move.
///
/// # Errors
/// Returns an error if a model lacks the selected animation; the message lists its animations.
fn choose_animations(
    models: &[ModelInstance],
    file: &SceneFile,
) -> Result<Vec<Option<usize>>, CliError> {
    let chosen = |(placed, choice): (&ModelInstance, Option<&Choice>)| {
        if placed.model.animations.is_empty() && choice.is_none() {
            return Ok(None);
        }
        select_animation(&placed.model, choice).map(Some).map_err(|(problem, help)| {
            let help = help.map_or(String::new(), |help| format!("\n  = help: {help}"));
            CliError::Usage(format!("{}: {problem}{help}", placed.model.name))
        })
    };
    let choices = file
        .models
        .iter()
        .flat_map(|model| std::iter::repeat_n(model.animation.as_ref(), model.instance_count()));
    models.iter().zip(choices).map(chosen).collect()
}

/// Parses a finite number.
///
/// Rejects NaN and infinite numbers, which Rust parses: angles and times must be finite.
fn parse_finite(text: &str) -> Result<Finite, String> {
    text.parse()
        .ok()
        .and_then(Finite::new)
        .ok_or_else(|| "expected a number, such as 1.5".to_owned())
}

/// Parses a frame rate from 0.1 to 1000.
///
/// Fractions such as `23.976` are allowed.
fn parse_frame_rate(text: &str) -> Result<f64, String> {
    let rate = text.parse().ok().filter(|rate: &f64| (0.1..=1000.0).contains(rate));
    rate.ok_or_else(|| "expected a number from 0.1 to 1000".to_owned())
}
