//! How the files of a picture are made: the picture band by band, passes and comparison beside it, all of them or none.

use super::args::RenderArgs;
use super::compare::PictureComparison;
use super::format::OutputFormat;
use super::passes::create_pass_files;
use super::progress::Progress;
use super::render::tasks::RenderTask;
use super::{CliError, print_stdout};
use drawing::Warning;
use homog::PixelRect;
use pipeline::render::{render_passes, rows_per_band};
use pipeline::scene::Outputs;
use pipeline::{
    AtomicFile, Channel, OutputError, Picture, RenderContext, Renderer, Scene, Textures, Timings,
    draw_lines,
};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

/// All that the files of a picture depend on.
pub(super) struct RenderJob<'a> {
    pub(super) args: &'a RenderArgs,
    pub(super) task: &'a RenderTask,
    pub(super) scene: &'a Scene,
    pub(super) outputs: Outputs,
    pub(super) threads: usize,
    pub(super) timings: &'a Timings,
}

/// What was written.
pub(super) struct RenderOutput {
    /// The part of the picture that was drawn.
    pub(super) region: PixelRect,
    /// The files, the picture first.
    pub(super) files: Vec<PathBuf>,
    /// The picture, if someone wants to look at it.
    pub(super) picture: Option<Picture>,
    /// What could not be drawn as it should.
    pub(super) warnings: Vec<Warning>,
    /// What the comparison has found, if one was asked for.
    pub(super) comparison: Option<PictureComparison>,
}

impl RenderOutput {
    /// Whether the picture is what it was compared with, if it was. Says so, unless a report does.
    pub(super) fn matches_reference(&self, silent: bool) -> bool {
        let Some(comparison) = &self.comparison else { return true };
        if !silent {
            // Nothing else can be done where nobody listens.
            let _ = writeln!(std::io::stderr(), "{comparison}");
        }
        comparison.agrees()
    }
}

/// The picture as a file that is not yet in its place, or as bytes for the standard output; in memory too if it is to be looked at;
/// and what could not be drawn.
struct EncodedPicture {
    sink: PictureSink,
    picture: Option<Picture>,
    warnings: Vec<Warning>,
}

/// Where the bytes of a picture go.
enum PictureSink {
    File(PathBuf, BufWriter<AtomicFile>),
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
    /// Makes all files, and puts them in their places when all are whole.
    pub(super) fn write_files(&self, progress: &Progress) -> Result<RenderOutput, CliError> {
        let region = self.args.region.resolve_region(self.scene.image)?;
        self.check_combination()?;
        let reference = self.args.compare.load_reference(region)?;
        let EncodedPicture { sink, picture, warnings } = match self.task.format {
            OutputFormat::Png if self.outputs.sixteen_bit => self.encode_picture::<u16>(region)?,
            OutputFormat::Png => self.encode_picture::<u8>(region)?,
            OutputFormat::Svg | OutputFormat::Pdf => self.encode_drawing()?,
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

    fn needs_picture(&self) -> bool {
        self.args.show || self.args.compare.is_requested()
    }

    /// That what is asked for goes together.
    fn check_combination(&self) -> Result<(), CliError> {
        let wrong = if self.task.format != OutputFormat::Png
            && (self.needs_picture() || self.args.region.is_partial())
        {
            "--crop, --tile, --compare and --show are for pictures: name a .png with -o"
        } else if self.task.output.is_none()
            && (self.needs_picture() || self.args.json || !self.outputs.passes.is_empty())
        {
            "--passes, --compare, --show and --json do not go with a picture on the standard output: name a file with -o"
        } else {
            return Ok(());
        };
        Err(CliError::Usage(wrong.to_owned()))
    }

    fn open_sink(&self) -> Result<PictureSink, CliError> {
        Ok(match &self.task.output {
            Some(path) => {
                PictureSink::File(path.clone(), BufWriter::new(AtomicFile::create(path)?))
            }
            None => PictureSink::Stdout(Vec::new()),
        })
    }

    fn output_error(&self, cause: std::io::Error) -> CliError {
        match &self.task.output {
            Some(path) => OutputError { path: path.clone(), cause }.into(),
            None => cause.into(),
        }
    }

    /// The picture as a PNG file.
    fn encode_picture<C: Channel>(&self, region: PixelRect) -> Result<EncodedPicture, CliError> {
        let textures = self.timings.measure("mip chains", || Textures::for_scene(self.scene));
        let context = RenderContext::new(self.scene, &textures, self.threads);
        let mut renderer = Renderer::default();
        let mut prepared = renderer.prepare(&context.with_timings(self.timings))?;
        let mut sink = self.open_sink()?;
        let mut picture = self.needs_picture().then(Picture::default);
        let rows = rows_per_band(region.width);
        let written = prepared.write_png(&mut sink, region, rows, |band: &Picture<C>| {
            if let Some(retained) = &mut picture {
                let bytes = |pixel: &[C; 4]| pixel.map(C::to_byte);
                retained.pixels.extend(band.pixels.iter().map(bytes));
                (retained.width, retained.height) = (band.width, retained.height + band.height);
            }
        });
        written.map_err(|error| match error {
            pipeline::WritePngError::Render(error) => CliError::Render(error),
            pipeline::WritePngError::Output(cause) => self.output_error(cause),
        })?;
        Ok(EncodedPicture { sink, picture, warnings: prepared.into_warnings() })
    }

    /// The line drawing as a file.
    fn encode_drawing(&self) -> Result<EncodedPicture, CliError> {
        let mut page = draw_lines(self.scene, self.threads, self.timings)?;
        let warnings = std::mem::take(&mut page.warnings);
        let bytes = self.timings.measure("encode", || self.task.format.encode_pages(&[page]));
        let mut sink = self.open_sink()?;
        sink.write_all(&bytes).map_err(|cause| self.output_error(cause))?;
        Ok(EncodedPicture { sink, picture: None, warnings })
    }

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
