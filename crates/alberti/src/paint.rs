//! How the files of a picture are made: the picture band by band, passes and comparison beside it, all of them or none.

use super::args::RenderArgs;
use super::compare::Comparison;
use super::format::Format;
use super::passes::drafts;
use super::progress::Progress;
use super::render::jobs::Job;
use super::{Failure, say};
use drawing::Warning;
use homog::PixelRect;
use pipeline::render::{band_rows, passes};
use pipeline::scene::Outputs;
use pipeline::{Channel, Draft, OutputError, Paint, Picture, Scene, Timings, draw};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

/// All that the files of a picture depend on.
pub(super) struct Painting<'a> {
    pub(super) args: &'a RenderArgs,
    pub(super) job: &'a Job,
    pub(super) scene: &'a Scene,
    pub(super) outputs: Outputs,
    pub(super) threads: usize,
    pub(super) timings: &'a Timings,
}

/// What was written.
pub(super) struct Painted {
    /// The part of the picture that was drawn.
    pub(super) region: PixelRect,
    /// The files, the picture first.
    pub(super) files: Vec<PathBuf>,
    /// The picture, if someone wants to look at it.
    pub(super) picture: Option<Picture>,
    /// What could not be drawn as it should.
    pub(super) warnings: Vec<Warning>,
    /// What the comparison has found, if one was asked for.
    pub(super) comparison: Option<Comparison>,
}

impl Painted {
    /// Whether the picture is what it was compared with, if it was. Says so, unless a report does.
    pub(super) fn agrees(&self, silent: bool) -> bool {
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
struct Made {
    sink: Sink,
    picture: Option<Picture>,
    warnings: Vec<Warning>,
}

/// Where the bytes of a picture go.
enum Sink {
    File(PathBuf, BufWriter<Draft>),
    Stdout(Vec<u8>),
}

impl Write for Sink {
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

impl Painting<'_> {
    /// Makes all files, and puts them in their places when all are whole.
    pub(super) fn write(&self, progress: &Progress) -> Result<Painted, Failure> {
        let region = self.args.part.region(self.scene.image)?;
        self.check()?;
        let reference = self.args.compare.reference(region)?;
        let Made { sink, picture, warnings } = match self.job.format {
            Format::Png if self.outputs.deep => self.picture::<u16>(region)?,
            Format::Png => self.picture::<u8>(region)?,
            Format::Svg | Format::Pdf => self.drawing()?,
        };
        let (mut drafts, mut comparison) = (Vec::new(), None);
        if let Some(output) = &self.job.output {
            drafts = self.passes(output, region)?;
            if let Some((reference, picture)) = reference.as_ref().zip(picture.as_ref()) {
                let (found, file) = self.args.compare.compared(reference, picture, output)?;
                drafts.push(file);
                comparison = Some(found);
            }
        }
        progress.stage("writing");
        let files = drafts.iter().map(|(path, _)| path.clone());
        let files = self.job.output.iter().cloned().chain(files).collect();
        self.timings.measure("write", || {
            match sink {
                Sink::File(path, file) => {
                    let fault = |cause| OutputError { path, cause };
                    file.into_inner().map_err(|error| fault(error.into_error()))?.finish()?;
                }
                Sink::Stdout(bytes) => say(&bytes)?,
            }
            drafts.into_iter().try_for_each(|(_, draft)| draft.finish().map_err(Failure::from))
        })?;
        Ok(Painted { region, files, picture, warnings, comparison })
    }

    fn wants_picture(&self) -> bool {
        self.args.show || self.args.compare.is_wanted()
    }

    /// That what is asked for goes together.
    fn check(&self) -> Result<(), Failure> {
        let wrong = if self.job.format != Format::Png
            && (self.wants_picture() || self.args.part.is_partial())
        {
            "--crop, --tile, --compare and --show are for pictures: name a .png with -o"
        } else if self.job.output.is_none()
            && (self.wants_picture() || self.args.json || !self.outputs.passes.is_empty())
        {
            "--passes, --compare, --show and --json do not go with a picture on the standard output: name a file with -o"
        } else {
            return Ok(());
        };
        Err(Failure::Usage(wrong.to_owned()))
    }

    fn sink(&self) -> Result<Sink, Failure> {
        Ok(match &self.job.output {
            Some(path) => Sink::File(path.clone(), BufWriter::new(Draft::of(path)?)),
            None => Sink::Stdout(Vec::new()),
        })
    }

    fn fault(&self, cause: std::io::Error) -> Failure {
        match &self.job.output {
            Some(path) => OutputError { path: path.clone(), cause }.into(),
            None => cause.into(),
        }
    }

    /// The picture as a PNG file.
    fn picture<C: Channel>(&self, region: PixelRect) -> Result<Made, Failure> {
        let mut paint = Paint::new(self.scene, self.threads, self.timings)?;
        let mut sink = self.sink()?;
        let mut picture = self.wants_picture().then(Picture::default);
        let rows = band_rows(region.width);
        let written = paint.write_png(&mut sink, region, rows, |band: &Picture<C>| {
            if let Some(kept) = &mut picture {
                let bytes = |pixel: &[C; 4]| pixel.map(C::to_byte);
                kept.pixels.extend(band.pixels.iter().map(bytes));
                (kept.width, kept.height) = (band.width, kept.height + band.height);
            }
        });
        written.map_err(|error| match error {
            pipeline::PaintError::Render(error) => Failure::Render(error),
            pipeline::PaintError::Output(cause) => self.fault(cause),
        })?;
        Ok(Made { sink, picture, warnings: paint.into_warnings() })
    }

    /// The line drawing as a file.
    fn drawing(&self) -> Result<Made, Failure> {
        let mut page = draw(self.scene, self.threads, self.timings)?;
        let warnings = std::mem::take(&mut page.warnings);
        let bytes = self.timings.measure("encode", || self.job.format.vectors(&[page]));
        let mut sink = self.sink()?;
        sink.write_all(&bytes).map_err(|cause| self.fault(cause))?;
        Ok(Made { sink, picture: None, warnings })
    }

    fn passes(&self, output: &Path, region: PixelRect) -> Result<Vec<(PathBuf, Draft)>, Failure> {
        let wanted = &self.outputs.passes;
        if wanted.is_empty() {
            return Ok(Vec::new());
        }
        let buffers = passes(self.scene, region, wanted, self.threads, self.timings)?;
        drafts(output, &buffers, self.outputs.encoding)
    }
}
