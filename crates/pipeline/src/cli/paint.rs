//! How the files of a picture are made: the picture band by band, passes and comparison beside it, all of them or none.

use super::Failure;
use super::args::RenderArgs;
use super::compare::Comparison;
use super::format::Format;
use super::passes::drafts;
use super::progress::Progress;
use pipeline::render::{band_rows, passes};
use pipeline::scene::Outputs;
use pipeline::{Channel, Draft, OutputError, Paint, Picture, Region, Scene, Timings, draw};
use std::io::{BufWriter, Write};
use std::path::PathBuf;
use std::process::ExitCode;

/// All that the files of a picture depend on.
pub(super) struct Painting<'a> {
    pub(super) args: &'a RenderArgs,
    pub(super) scene: &'a Scene,
    pub(super) outputs: Outputs,
    pub(super) output: PathBuf,
    pub(super) format: Format,
    pub(super) threads: usize,
    pub(super) timings: &'a Timings,
}

/// What was written.
pub(super) struct Painted {
    /// The part of the picture that was drawn.
    pub(super) region: Region,
    /// The files, the picture first.
    pub(super) files: Vec<PathBuf>,
    /// The picture, if someone wants to look at it.
    pub(super) picture: Option<Picture>,
    /// What the comparison has found, if one was asked for.
    pub(super) comparison: Option<Comparison>,
}

impl Painted {
    /// How the program ends: with 1 if the picture is not what it was compared with. Says so, unless a report does.
    pub(super) fn verdict(&self, silent: bool) -> ExitCode {
        let Some(comparison) = &self.comparison else { return ExitCode::SUCCESS };
        if !silent {
            // Nothing else can be done where nobody listens.
            let _ = writeln!(std::io::stderr(), "{comparison}");
        }
        if comparison.agrees() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
    }
}

impl Painting<'_> {
    /// Makes all files, and puts them in their places when all are whole.
    pub(super) fn write(&self, progress: &Progress) -> Result<Painted, Failure> {
        let region = self.args.part.region(self.scene.image)?;
        if self.format != Format::Png && (self.wants_picture() || self.args.part.is_partial()) {
            let text = "--crop, --tile, --compare and --show are for pictures: name a .png with -o";
            return Err(Failure::Usage(text.to_owned()));
        }
        let reference = self.args.compare.reference(region)?;
        let (draft, picture) = match self.format {
            Format::Png if self.outputs.deep => self.picture::<u16>(region)?,
            Format::Png => self.picture::<u8>(region)?,
            Format::Svg | Format::Pdf => (self.drawing()?, None),
        };
        let mut drafts = self.passes(region)?;
        drafts.insert(0, (self.output.clone(), draft));
        let comparison = reference.as_ref().zip(picture.as_ref()).map(|(reference, picture)| {
            self.args.compare.compared(reference, picture, &self.output)
        });
        let comparison = match comparison.transpose()? {
            Some((comparison, file)) => {
                drafts.push(file);
                Some(comparison)
            }
            None => None,
        };
        progress.stage("writing");
        let files = drafts.iter().map(|(path, _)| path.clone()).collect();
        self.timings
            .measure("write", || drafts.into_iter().try_for_each(|(_, draft)| draft.finish()))?;
        Ok(Painted { region, files, picture, comparison })
    }

    fn wants_picture(&self) -> bool {
        self.args.show || self.args.compare.is_wanted()
    }

    /// The picture as a PNG file, and in memory if it is to be looked at.
    fn picture<C: Channel>(&self, region: Region) -> Result<(Draft, Option<Picture>), Failure> {
        let mut paint = Paint::new(self.scene, self.threads, self.timings)?;
        let draft = Draft::of(&self.output)?;
        let mut out = BufWriter::new(draft);
        let mut kept = self.wants_picture().then(Picture::default);
        let rows = band_rows(region.width);
        let written = paint.write_png(&mut out, region, rows, |band: &Picture<C>| {
            if let Some(kept) = &mut kept {
                let bytes = |pixel: &[C; 4]| pixel.map(C::to_byte);
                kept.pixels.extend(band.pixels.iter().map(bytes));
                (kept.width, kept.height) = (band.width, kept.height + band.height);
            }
        });
        let fault = |cause| OutputError { path: self.output.clone(), cause };
        written.map_err(|error| match error {
            pipeline::PaintError::Render(error) => Failure::Render(error),
            pipeline::PaintError::Output(cause) => Failure::Output(fault(cause)),
        })?;
        let draft = out.into_inner().map_err(|error| fault(error.into_error()))?;
        Ok((draft, kept))
    }

    /// The line drawing as a file.
    fn drawing(&self) -> Result<Draft, Failure> {
        let page = draw(self.scene, self.threads, self.timings)?;
        let bytes = self.timings.measure("encode", || self.format.vectors(&[page]));
        let mut draft = Draft::of(&self.output)?;
        let fault = |cause| OutputError { path: self.output.clone(), cause };
        draft.write_all(&bytes).map_err(fault)?;
        Ok(draft)
    }

    fn passes(&self, region: Region) -> Result<Vec<(PathBuf, Draft)>, Failure> {
        let wanted = &self.outputs.passes;
        if wanted.is_empty() {
            return Ok(Vec::new());
        }
        let buffers = passes(self.scene, region, wanted, self.threads, self.timings)?;
        drafts(&self.output, &buffers, self.outputs.encoding)
    }
}
