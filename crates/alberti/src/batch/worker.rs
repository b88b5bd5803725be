//! `alberti batch-worker`: renders pictures for a batch coordinator, until the coordinator exits.
//!
//! A model that hangs, crashes or uses up the memory brings down only its worker.

use super::render_flags::RenderFlags;
use super::worker_scene::SceneLoader;
use crate::CliError;
use crate::memory_limit::{limit_process_memory, parse_memory_size};
use crate::unused_flags::find_unused_overrides;
use batch::{
    FramedAnswer, PictureRequest, PictureTarget, WorkAnswer, WorkRequest, hexadecimal_sha256,
};
use files::{create_partial_file, forget_partial_file};
use files::{visible_path, visible_text};
use pipeline::{RenderContext, Renderer, Textures};
use std::io::{BufRead as _, ErrorKind, Write};
use std::path::Path;
use std::time::Instant;

/// Arguments of `alberti batch-worker`.
#[derive(Debug, clap::Args)]
pub(crate) struct WorkerArgs {
    /// Memory limit of the worker
    #[arg(long, value_name = "SIZE", value_parser = parse_memory_size)]
    memory: Option<u64>,
}

/// Answers requests until the input ends.
///
/// # Errors
/// Returns an error if a request is malformed, or if writing an answer fails.
pub(crate) fn run(args: &WorkerArgs) -> Result<(), CliError> {
    end_with_coordinator();
    if let Some(memory) = args.memory {
        limit_process_memory(memory);
    }
    let mut worker = Worker {
        loader: SceneLoader::new(args.memory),
        renderer: Renderer::default(),
        flags: None,
    };
    let mut answers = std::io::stdout().lock();
    for line in std::io::stdin().lock().lines() {
        let request: WorkRequest = serde_json::from_str(&line?)
            .map_err(|error| CliError::Usage(format!("invalid batch request: {error}")))?;
        for picture in &request.pictures {
            let (answer, mut png) = worker.answer(&request.input, picture);
            if !matches!(picture.target, PictureTarget::Pipe) {
                png.clear();
            }
            let framed = FramedAnswer { answer, follows: png.len() as u64 };
            let mut bytes = serde_json::to_vec(&framed).map_err(|error| {
                CliError::Usage(format!("cannot serialize the answer: {error}"))
            })?;
            bytes.push(b'\n');
            bytes.extend(png);
            // Flushed for each picture, because the coordinator waits for the answer.
            answers.write_all(&bytes).and_then(|()| answers.flush())?;
        }
    }
    Ok(())
}

/// Ends this process when the coordinator is killed, even in the middle of a picture.
#[cfg(target_os = "linux")]
fn end_with_coordinator() {
    use rustix::process::{Signal, set_parent_process_death_signal};
    // If the system forbids this, the worker exits at its next answer.
    let _ = set_parent_process_death_signal(Some(Signal::KILL));
}

/// Does nothing: other systems have no such signal, so the worker exits at its next answer.
#[cfg(not(target_os = "linux"))]
fn end_with_coordinator() {}

/// A worker with the state it keeps between pictures.
struct Worker {
    /// The most recently loaded model.
    loader: SceneLoader,
    /// The rendering buffers.
    renderer: Renderer,
    /// The most recently parsed flags; the next picture often has the same flags.
    flags: Option<(Vec<String>, RenderFlags)>,
}

/// The reason a picture could not be rendered.
enum PictureError {
    /// The input or a flag is wrong.
    Job(CliError),
    /// The output folder is unusable.
    Place(String),
}

impl<E: Into<CliError>> From<E> for PictureError {
    fn from(error: E) -> Self {
        Self::Job(error.into())
    }
}

/// A finished picture: PNG and warnings.
type RenderedPicture = (Vec<u8>, Vec<String>);

impl Worker {
    /// Renders and writes a picture; returns the answer, and the PNG to send after it, if any.
    fn answer(&mut self, input: &Path, picture: &PictureRequest) -> (WorkAnswer, Vec<u8>) {
        let begin = Instant::now();
        let made = self.render_picture(input, picture).and_then(|made| {
            if let PictureTarget::File { path, partial } = &picture.target {
                write_picture(path, partial, &made.0)?;
            }
            Ok(made)
        });
        let seconds = begin.elapsed().as_secs_f64();
        match made {
            Ok((png, warnings)) => {
                let answer = WorkAnswer::Done {
                    seconds,
                    warnings: warnings.len(),
                    message: warnings.into_iter().next().unwrap_or_default(),
                    bytes: png.len() as u64,
                    sha256: hexadecimal_sha256(&png),
                };
                (answer, png)
            }
            Err(PictureError::Job(error)) => {
                (WorkAnswer::Failed { seconds, message: error.to_string() }, Vec::new())
            }
            Err(PictureError::Place(message)) => (WorkAnswer::Stopped { message }, Vec::new()),
        }
    }

    /// Renders one picture; returns it with the warnings about its models and the drawing.
    ///
    /// Rendering is single-threaded, because the workers themselves run in parallel.
    fn render_picture(
        &mut self,
        input: &Path,
        picture: &PictureRequest,
    ) -> Result<RenderedPicture, PictureError> {
        if self.flags.as_ref().is_none_or(|(words, _)| *words != picture.flags) {
            let flags = parse_flags(&picture.flags)?;
            self.flags = Some((picture.flags.clone(), flags));
        }
        let Some((_, flags)) = &self.flags else {
            return Err(CliError::Usage("no flags".to_owned()).into());
        };
        let scene = self.loader.load_scene(input, picture.scene.as_deref(), flags)?;
        let textures = Textures::for_scene(&scene);
        let context = RenderContext::new(&scene, &textures, 1);
        let (png, drawing) = self.renderer.render_png(&context).map_err(CliError::from)?;
        let warnings = scene.models.iter().flat_map(|placed| &placed.model.warnings);
        let warnings = warnings.map(model::Diagnostic::sentence);
        let unused = find_unused_overrides(&flags.overrides, &scene, false);
        let warnings = warnings.chain(drawing.iter().map(ToString::to_string)).chain(unused);
        Ok((png, warnings.collect()))
    }
}

/// Parses flags; an error message about a wrong value is a single line.
fn parse_flags(words: &[String]) -> Result<RenderFlags, CliError> {
    RenderFlags::parse(words).map_err(|error| {
        let visible: Vec<String> = words.iter().map(|word| visible_text(word).into()).collect();
        CliError::Usage(RenderFlags::parse(&visible).err().unwrap_or(error))
    })
}

/// Writes a picture atomically: to this worker's temporary file, which is then renamed.
///
/// The picture's folder is created only now, so that failed models leave no empty folders.
fn write_picture(path: &Path, partial: &Path, png: &[u8]) -> Result<(), PictureError> {
    let fault = |what: &Path, cause: std::io::Error| {
        let message = format!("cannot write {}: {cause}", visible_path(what));
        match cause.kind() {
            // The name is wrong, so the job fails.
            ErrorKind::InvalidFilename
            | ErrorKind::InvalidInput
            | ErrorKind::IsADirectory
            | ErrorKind::NotADirectory
            | ErrorKind::AlreadyExists => PictureError::Job(CliError::Usage(message)),
            _ => PictureError::Place(message),
        }
    };
    if let Some(folder) = path.parent() {
        // The temporary file is in the folder of the reports, below the output folder.
        if let Some(out_dir) = partial.parent().and_then(Path::parent) {
            check_inside(path, folder, out_dir)?;
        }
        std::fs::create_dir_all(folder).map_err(|cause| fault(folder, cause))?;
    }
    let written = create_partial_file(partial).and_then(|mut file| {
        file.write_all(png)?;
        // The data is synced before the rename, so a crash leaves the old picture or the new one.
        file.sync_all()?;
        std::fs::rename(partial, path)
    });
    let written = written.map_err(|cause| {
        // Best effort: an error is already being reported.
        let _ = std::fs::remove_file(partial);
        fault(path, cause)
    });
    forget_partial_file(partial);
    written
}

/// Checks that a picture's folder, with symbolic links resolved, is below the output folder.
///
/// Missing parts of its path will be created as real folders.
fn check_inside(path: &Path, folder: &Path, out_dir: &Path) -> Result<(), PictureError> {
    let existing = folder.ancestors().find(|folder| folder.exists()).unwrap_or(folder);
    let is_inside = match (existing.canonicalize(), out_dir.canonicalize()) {
        (Ok(folder), Ok(out_dir)) => folder.starts_with(out_dir),
        // The system reports its error when the folder is created.
        _ => true,
    };
    if is_inside {
        return Ok(());
    }
    Err(PictureError::Place(format!(
        "cannot write {}: a symbolic link leads out of the output folder\n  = help: remove the link, \
         or choose another output",
        visible_path(path)
    )))
}
