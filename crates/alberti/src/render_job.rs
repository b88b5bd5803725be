//! Writes a picture with its passes and its comparison: all files or none.
//!
//! A raster image is rendered and encoded band by band, so that memory does not limit its size.
//! Every file is written under a temporary name and renamed once all are complete.
//!
//! ```text
//!  scene ─► bands of rows ─► encoder ─► .part file ──┐
//!        └► passes, comparison ─► .part files ───────┴─► renamed, the picture first
//! ```
//! A run that fails before renaming leaves every existing file unchanged and removes its temporary
//! files. Only the renaming itself can be interrupted between two files; even then each file is
//! complete.

use super::CliError;
use super::args::RenderArgs;
use super::format::{DEFAULT_QUALITY, OutputFormat, image_warning};
use super::messages::{print_note, print_stdout};
use super::passes::create_pass_files;
use super::progress::Progress;
use super::render::tasks::RenderTask;
use drawing::Warning;
use homog::PixelRect;
use picture::PictureComparison;
use pipeline::render::{BitDepth, render_passes, rows_per_band};
use pipeline::{
    AtomicFile, OutputError, Picture, RenderContext, Renderer, Scene, Textures, Timings, Workers,
    draw_lines, dxf_options,
};
use scene::Outputs;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

/// A resolved scene, with everything else that its output files depend on.
///
/// It borrows the flags and the scene, because several pictures share the flags, and the report
/// needs the scene after the files are written.
pub(super) struct RenderJob<'a> {
    /// The flags of the command.
    pub(super) args: &'a RenderArgs,
    /// The input, format and output of this picture.
    pub(super) task: &'a RenderTask,
    /// The resolved scene.
    pub(super) scene: &'a Scene,
    /// The bit depth and the passes.
    pub(super) outputs: Outputs,
    /// The number of threads.
    pub(super) threads: usize,
    /// The stopwatch for the stages.
    pub(super) timings: &'a Timings,
}

/// The files that were written, and the contents that are needed later.
///
/// It exists only after all files are in place, so a report can read them back.
pub(super) struct RenderOutput {
    /// The rendered rectangle of the picture.
    pub(super) region: PixelRect,
    /// The files, beginning with the picture.
    pub(super) files: Vec<PathBuf>,
    /// The picture, if it is compared or shown in the terminal.
    pub(super) picture: Option<Picture>,
    /// Warnings of the line drawing.
    pub(super) warnings: Vec<Warning>,
    /// The result of `--compare`.
    pub(super) comparison: Option<PictureComparison>,
}

impl RenderOutput {
    /// Whether the picture agrees with its reference, if it has one. Prints the comparison unless
    /// `silent`, which is set if a JSON report contains it.
    pub(super) fn matches_reference(&self, silent: bool) -> bool {
        let Some(comparison) = &self.comparison else { return true };
        if !silent {
            print_note(&comparison.to_string());
        }
        comparison.agrees()
    }
}

/// An encoded picture that is not yet in place, with its pixels if they are needed.
struct EncodedPicture {
    /// The destination, which contains the encoded bytes.
    sink: PictureSink,
    /// The pixels, if they are compared or shown.
    picture: Option<Picture>,
    /// Warnings of the line drawing.
    warnings: Vec<Warning>,
}

/// The destination of a picture: a temporary file, or memory for the standard output.
///
/// The standard output gets the bytes when all are ready, so that a failed run writes nothing.
enum PictureSink {
    /// The target's name, for error messages, and its temporary file.
    File(PathBuf, BufWriter<AtomicFile>),
    /// All bytes of the picture. A streamed picture would be cut short by an error halfway.
    Stdout(Vec<u8>),
}

impl Write for PictureSink {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        match self {
            Self::File(_, file) => file.write(bytes),
            Self::Stdout(all) => all.write(bytes),
        }
    }

    fn flush(&mut self) -> std::io::Result<()> {
        match self {
            Self::File(_, file) => file.flush(),
            Self::Stdout(_) => Ok(()),
        }
    }
}

impl RenderJob<'_> {
    /// Writes all files, and renames them into place once all are complete.
    ///
    /// Cheap checks that can fail come first: region, flag combination, reference size. Then the
    /// picture is rendered and encoded, then its passes and comparison; all of them exist under
    /// temporary names before the first is renamed.
    ///
    /// A picture on the standard output has neither passes nor a comparison, because their names
    /// derive from its name; [`check_combination`](Self::check_combination) rejects their flags.
    ///
    /// # Errors
    /// Returns an error if flags contradict each other, if the reference cannot be read, if
    /// rendering fails, or if a file cannot be written.
    pub(super) fn write_files(&self, progress: &Progress) -> Result<RenderOutput, CliError> {
        let region = self.args.region.resolve_region(self.scene.image)?;
        self.check_combination()?;
        let reference = self.args.compare.load_reference(region)?;
        let EncodedPicture { sink, picture, warnings } = match self.task.format {
            format if format.is_raster() => self.encode_picture(region, progress)?,
            _ => self.encode_drawing(progress)?,
        };
        let (mut drafts, mut comparison) = (Vec::new(), None);
        if let Some(output) = &self.task.output {
            drafts = self.create_pass_files(output, region)?;
            if let Some((reference, picture)) = reference.as_ref().zip(picture.as_ref()) {
                let (result, file) =
                    self.args.compare.create_comparison(reference, picture, output)?;
                drafts.push(file);
                comparison = Some(result);
            }
        }
        progress.enter_stage("writing");
        let files = drafts.iter().map(|(path, _)| path.clone());
        let files = self.task.output.iter().cloned().chain(files).collect();
        self.timings.measure("write", || {
            match sink {
                PictureSink::File(path, file) => {
                    let fault = |cause| OutputError { path, cause };
                    file.into_inner().map_err(|error| fault(error.into_error()))?.finish()?;
                }
                PictureSink::Stdout(bytes) => print_stdout(&bytes)?,
            }
            drafts.into_iter().try_for_each(|(_, draft)| draft.finish().map_err(CliError::from))
        })?;
        Ok(RenderOutput { region, files, picture, warnings, comparison })
    }

    /// Whether the pixels are needed in addition to the file.
    ///
    /// The pixels of a PNG are normally dropped band by band; only `--compare` and `--show` keep
    /// the whole picture in memory, at four bytes per pixel.
    fn needs_picture(&self) -> bool {
        self.args.show || self.args.compare.is_requested()
    }

    /// Rejects flag combinations that make no sense with the output format or destination.
    ///
    /// clap cannot check these, because the format may follow from the extension of the output, and
    /// passes may be requested by the scene instead of a flag.
    fn check_combination(&self) -> Result<(), CliError> {
        let wrong = if !self.task.format.is_raster()
            && (self.needs_picture() || self.args.region.is_partial())
        {
            "--crop, --band, --compare and --show need a raster image: name a .png with -o"
        } else if self.task.output.is_none()
            && (self.needs_picture() || self.args.json || !self.outputs.passes.is_empty())
        {
            "--passes, --compare, --show and --json cannot be used with a picture on the standard output: name a file with -o"
        } else {
            return Ok(());
        };
        Err(CliError::Usage(wrong.to_owned()))
    }

    /// Opens the destination of the picture.
    ///
    /// The temporary file is created only when there is something to write: scene errors leave no
    /// trace in the folder.
    fn open_sink(&self) -> Result<PictureSink, CliError> {
        Ok(match &self.task.output {
            Some(path) => {
                PictureSink::File(path.clone(), BufWriter::new(AtomicFile::create(path)?))
            }
            None => PictureSink::Stdout(Vec::new()),
        })
    }

    /// Converts an I/O error to an error about the destination.
    ///
    /// Encoders report errors without a path; the message must name the destination.
    fn output_error(&self, cause: std::io::Error) -> CliError {
        match &self.task.output {
            Some(path) => OutputError { path: path.clone(), cause }.into(),
            None => cause.into(),
        }
    }

    /// Renders and encodes the region: band by band for a PNG, as a whole for other formats.
    ///
    /// A PNG needs memory for one band and the encoder, regardless of its height; bands have the
    /// same pixels as the whole picture. `--compare` and `--show` work on an 8-bit copy.
    ///
    /// Rendering and writing errors arrive as one type and are separated here, so that a full disk
    /// is reported with the file name.
    fn encode_picture(
        &self,
        region: PixelRect,
        progress: &Progress,
    ) -> Result<EncodedPicture, CliError> {
        let textures = self.timings.measure("mip chains", || Textures::for_scene(self.scene));
        let monitor = progress.monitor();
        let context = RenderContext::new(self.scene, &textures, self.threads);
        let context = context.with_timings(self.timings).with_monitor(&monitor);
        let mut renderer = Renderer::default();
        let mut prepared = renderer.prepare(&context)?;
        progress.enter_stage("rendering");
        if self.task.format != OutputFormat::Png {
            self.task.format.check_size([region.width, region.height])?;
            let mut whole = Picture::default();
            prepared.render_region(region, &mut whole)?;
            let quality = self.args.quality.unwrap_or(DEFAULT_QUALITY);
            let encode = || self.task.format.encode_picture(&whole, quality);
            let bytes = self.timings.measure("encode", encode)?;
            let mut sink = self.open_sink()?;
            sink.write_all(&bytes).map_err(|cause| self.output_error(cause))?;
            let picture = self.needs_picture().then_some(whole);
            return Ok(EncodedPicture { sink, picture, warnings: prepared.into_warnings() });
        }
        let mut sink = self.open_sink()?;
        let mut picture = self.needs_picture().then(Picture::default);
        let rows = rows_per_band(region.width);
        let depth = if self.outputs.sixteen_bit { BitDepth::Sixteen } else { BitDepth::Eight };
        let written = prepared.write_png(&mut sink, region, rows, depth, picture.as_mut());
        written.map_err(|error| match error {
            pipeline::WritePngError::Render(error) => CliError::Render(error),
            pipeline::WritePngError::Output(cause) => self.output_error(cause),
        })?;
        Ok(EncodedPicture { sink, picture, warnings: prepared.into_warnings() })
    }

    /// Draws the scene as lines and encodes it as SVG, PDF or DXF.
    ///
    /// A drawing is small, so it is encoded in memory. Its warnings are moved out of the page and
    /// printed after the file is written.
    fn encode_drawing(&self, progress: &Progress) -> Result<EncodedPicture, CliError> {
        let monitor = progress.monitor();
        let workers = Workers::monitored(self.threads, &*monitor);
        let mut page = draw_lines(self.scene, workers, self.timings)?;
        let format = self.task.format;
        let mut warnings = std::mem::take(&mut page.warnings);
        warnings.extend(image_warning(format, &page));
        let bytes = self.timings.measure("encode", || match format {
            OutputFormat::Dxf => {
                page.to_dxf(&self.args.dxf.apply_to(dxf_options(self.scene, &page)))
            }
            _ => format.encode_pages(&[page]),
        });
        let mut sink = self.open_sink()?;
        sink.write_all(&bytes).map_err(|cause| self.output_error(cause))?;
        Ok(EncodedPicture { sink, picture: None, warnings })
    }

    /// Renders the passes and writes them to temporary files next to the picture.
    ///
    /// Passes are rendered separately: they have one property per pixel center and neither overlays
    /// nor background. Nothing is rendered if no pass is requested. After an error, the created
    /// files are dropped, which removes them.
    fn create_pass_files(
        &self,
        output: &Path,
        region: PixelRect,
    ) -> Result<Vec<(PathBuf, AtomicFile)>, CliError> {
        let wanted = &self.outputs.passes;
        if wanted.is_empty() {
            return Ok(Vec::new());
        }
        let buffers = render_passes(self.scene, region, wanted, self.threads, self.timings)?;
        create_pass_files(output, &buffers, self.outputs.encoding)
    }
}
