//! `alberti thumbnailer`: thumbnails for file managers, following freedesktop.org conventions.
//!
//! ```text
//!  file manager ─► thumbnail service ─► alberti.thumbnailer ─► alberti thumbnailer INPUT OUTPUT
//!                   MIME type of the file: alberti.xml              within time and memory
//! ```
//! A thumbnail service runs the program on any file in a folder. Within the limits, any input leads
//! to a complete picture or a nonzero exit code, never to part of a picture.

mod deadline;
mod installation;

use super::CliError;
use super::memory_limit::{import_limits, limit_process_memory, parse_memory_size};
use super::render::{open_input, thread_count};
use clap::ValueEnum;
use deadline::Deadline;
use files::{visible_path, visible_text};
use import::Limits;
use import::{ImportError, ImportOptions};
use model::codes;
use pipeline::{
    Monitor, OutputError, RenderContext, RenderError, Renderer, ResolveError, Scene, Textures,
    write_file,
};
use scene::{ResolveOptions, Style};
use std::fs::OpenOptions;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Arguments of `alberti thumbnailer`.
#[derive(Debug, clap::Args)]
pub(crate) struct ThumbnailerArgs {
    /// Model (.gltf, .glb, .stl, .obj, .ply, .3mf) or scene (.ron)
    ///
    /// Broken, missing and unsupported parts are skipped if anything is left to show.
    #[arg(required_unless_present_any = ["install", "uninstall", "print"], requires = "output")]
    input: Option<PathBuf>,
    /// PNG file to write
    output: Option<PathBuf>,
    /// Width and height of the picture in pixels
    #[arg(long, value_name = "N", default_value = "256", value_parser = clap::value_parser!(u32).range(1..=4096))]
    size: u32,
    /// Time limit in seconds, after which the program exits without a picture
    #[arg(long, value_name = "N", default_value = "10", value_parser = clap::value_parser!(u32).range(1..=86_400))]
    max_seconds: u32,
    /// Memory limit, at least 64MiB; it also limits the sizes of files, arrays and images
    ///
    /// An input that would need more is rejected before it is read. On Linux the system enforces
    /// this limit too (RLIMIT_DATA).
    #[arg(long, value_name = "SIZE", default_value = "1GiB", value_parser = parse_memory_size)]
    max_memory_bytes: u64,
    /// Install the thumbnailer and the MIME types for the current user, or below --prefix
    ///
    /// Writes thumbnailers/alberti.thumbnailer and mime/packages/alberti.xml to $XDG_DATA_HOME
    /// (by default ~/.local/share) and runs update-mime-database. Then restart the file manager. To
    /// retry files that had no thumbnail before, remove ~/.cache/thumbnails/fail.
    #[arg(long, conflicts_with_all = ["input", "uninstall", "print"])]
    install: bool,
    /// Remove the files that --install writes
    #[arg(long, conflicts_with_all = ["input", "print"])]
    uninstall: bool,
    /// Folder to install in, such as /usr/local; the files are written below DIR/share
    #[arg(long, value_name = "DIR", conflicts_with_all = ["input", "print"])]
    prefix: Option<PathBuf>,
    /// Print one of the two files that --install writes, for packagers
    #[arg(long, value_name = "FILE", conflicts_with = "input")]
    print: Option<InstalledFile>,
}

/// The files that make a file manager show thumbnails.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum InstalledFile {
    /// The thumbnailer entry, alberti.thumbnailer, for a program in the PATH
    Entry,
    /// The MIME types for shared-mime-info, alberti.xml
    Mime,
}

/// Renders one thumbnail, or installs, removes or prints the thumbnailer files.
///
/// # Errors
/// Returns an error if the input cannot be shown within the limits, or if a file cannot be written.
pub(crate) fn run(args: &ThumbnailerArgs) -> Result<(), CliError> {
    let prefix = args.prefix.as_deref();
    match (&args.input, &args.output) {
        (Some(input), Some(output)) => {
            render_thumbnail(args, input, output).map_err(with_memory_help)
        }
        _ if args.install => installation::install_files(prefix),
        _ if args.uninstall => installation::remove_files(prefix),
        _ => match args.print {
            Some(InstalledFile::Mime) => super::print_stdout(installation::MIME_TYPES.as_bytes()),
            _ => {
                let entry = installation::entry_of("alberti".as_ref())?;
                super::print_stdout(entry.as_bytes())
            }
        },
    }
}

/// Maximum number of threads for a thumbnail: each needs memory, and thumbnails are small.
const MAX_THREADS: usize = 8;

/// Renders and writes a square picture, if time and memory suffice.
fn render_thumbnail(args: &ThumbnailerArgs, input: &Path, output: &Path) -> Result<(), CliError> {
    limit_process_memory(args.max_memory_bytes);
    let deadline = Deadline::start(args.max_seconds)?;
    let import = ImportOptions {
        limits: import_limits(&Limits::default(), args.max_memory_bytes),
        lenient: true,
        ..ImportOptions::default()
    };
    let (origin, mut file) = open_input(input, &import)?;
    let (width, height) = std::mem::replace(&mut file.image.size, (args.size, args.size));
    let mut scene = Scene::resolve(&origin, &file, &ResolveOptions::with_import(import))?;
    // Lines as wide as in a full drawing would merge into blots.
    let factor = f64::from(args.size) / f64::from(width.max(height));
    let insets = scene.insets.iter_mut().map(|inset| &mut inset.scene.style);
    for style in insets.chain([&mut scene.style]) {
        if let Style::Lines(lines) = style
            && factor < 1.0
        {
            lines.line_widths = lines.line_widths.scaled(factor);
        }
    }
    let textures = Textures::for_scene(&scene);
    let threads = thread_count(None).min(MAX_THREADS);
    let monitor: Arc<dyn Monitor> = Arc::new(deadline.cancel_token().clone());
    let context = RenderContext::new(&scene, &textures, threads).with_monitor(&monitor);
    match Renderer::default().render_png(&context) {
        Ok((png, _)) => deadline.finish(|| Ok(write_thumbnail(output, &png)?)),
        Err(RenderError::Canceled) => deadline.finish(|| Err(deadline::timeout(args.max_seconds))),
        Err(error) => Err(error.into()),
    }
}

/// Writes a picture completely or not at all.
///
/// A new file replaces the old one, unless the old one is empty: tumbler creates an empty file,
/// keeps it open, and reads from it afterward.
fn write_thumbnail(path: &Path, png: &[u8]) -> Result<(), OutputError> {
    if path.metadata().map_or(true, |old| !old.is_file() || old.len() > 0) {
        return write_file(path, png);
    }
    let written = OpenOptions::new().write(true).open(path).and_then(|mut file| {
        file.write_all(png).inspect_err(|_| {
            // Best effort: an error is already being reported.
            let _ = file.set_len(0);
        })
    });
    written.map_err(|cause| OutputError { path: path.to_owned(), cause })
}

/// Names this command's flags in a limit error, since they differ from other commands' flags.
fn with_memory_help(error: CliError) -> CliError {
    match error {
        CliError::Resolve(ResolveError::Model(ImportError { file, diagnostic, .. }))
            if diagnostic.code == codes::LIMIT_EXCEEDED =>
        {
            CliError::Usage(format!(
                "{}: {}\n  = help: raise --max-memory-bytes; `alberti render` has a flag for each \
                 limit",
                visible_path(file),
                visible_text(&diagnostic.message)
            ))
        }
        other => other,
    }
}
