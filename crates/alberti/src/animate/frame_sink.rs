//! The output of a frame sequence, which takes one frame after the other.

use crate::CliError;
use crate::template::NameTemplate;
use pipeline::sequence::Sequence;
use pipeline::{AtomicFile, OutputError, Picture};
use std::cell::RefCell;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// An output of frames. A file of several frames appears under its name once it is complete.
pub(super) enum FrameSink {
    /// One PNG per frame, with the value of `{stem}`.
    Files(NameTemplate, String),
    /// One animated PNG.
    Png { writer: Box<png::Writer<SharedFile>>, file: SharedFile, opaque: bool, path: PathBuf },
    /// One animated GIF.
    Gif { encoder: Box<gif::Encoder<SharedFile>>, fps: f64, path: PathBuf },
    /// Raw RGBA pixels, 8 bits per channel, on the standard output.
    Raw,
}

impl FrameSink {
    /// Opens the output that a name stands for; nothing appears under the name yet.
    ///
    /// # Errors
    ///
    /// If the name has no supported extension, or the file cannot be created.
    pub(super) fn open(
        input: &Path,
        output: &Path,
        film: &Sequence,
        fps: f64,
    ) -> Result<Self, CliError> {
        let name = output.to_string_lossy();
        if name == "-" {
            return Ok(Self::Raw);
        }
        let stem = input.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let template =
            NameTemplate::parse(&name, &["stem"], &["frame"]).map_err(CliError::Usage)?;
        if template.has_field("frame") {
            if !name.to_lowercase().ends_with(".png") {
                let help = "frames are written as PNG: NAME_{frame:04}.png";
                return Err(CliError::Usage(format!(
                    "{name} does not end in .png\n  = help: {help}"
                )));
            }
            return Ok(Self::Files(template, stem));
        }
        match output.extension().map(|ending| ending.to_string_lossy().to_lowercase()).as_deref() {
            Some("png" | "apng") => Self::open_png(output, film, fps),
            Some("gif") => Self::open_gif(output, film, fps),
            _ => Err(CliError::Usage(format!(
                "unsupported output {name}: expected NAME_{{frame:04}}.png, .png, .gif or -"
            ))),
        }
    }

    /// Opens an animated PNG: RGB if every frame is opaque, else RGBA.
    ///
    /// The delay of a frame is a fraction of 16-bit numbers, 1000 / (1000 fps).
    fn open_png(output: &Path, film: &Sequence, fps: f64) -> Result<Self, CliError> {
        let ((width, height), opaque) = (film.image_size(), film.is_opaque());
        let file = SharedFile::create(output)?;
        let mut encoder = png::Encoder::new(file.clone(), width, height);
        encoder.set_color(if opaque { png::ColorType::Rgb } else { png::ColorType::Rgba });
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        encoder.set_compression(png::Compression::Fast);
        let fault = |error| png_error(output, error);
        encoder.set_animated(film.frame_count() as u32, 0).map_err(fault)?;
        encoder
            .set_frame_delay(1000, libm::round(1000.0 * fps).min(65_535.0) as u16)
            .map_err(fault)?;
        let writer = Box::new(encoder.write_header().map_err(fault)?);
        Ok(Self::Png { writer, file, opaque, path: output.to_owned() })
    }

    /// Opens an animated GIF that repeats forever.
    fn open_gif(output: &Path, film: &Sequence, fps: f64) -> Result<Self, CliError> {
        let (width, height) = film.image_size();
        let (Ok(width), Ok(height)) = (u16::try_from(width), u16::try_from(height)) else {
            let most = u16::MAX;
            return Err(CliError::Usage(format!(
                "the width and height of a GIF are at most {most}, but the frames are {width} x {height}"
            )));
        };
        let fault = |error| gif_error(output, error);
        let file = SharedFile::create(output)?;
        let mut encoder = gif::Encoder::new(file, width, height, &[]).map_err(fault)?;
        encoder.set_repeat(gif::Repeat::Infinite).map_err(fault)?;
        Ok(Self::Gif { encoder: Box::new(encoder), fps, path: output.to_owned() })
    }

    /// Appends one frame, or writes it to a file of its own.
    pub(super) fn write_frame(&mut self, frame: usize, picture: &Picture) -> Result<(), CliError> {
        match self {
            Self::Files(template, stem) => {
                Ok(picture.write_png(&template.expand_fields(|_| stem.clone(), |_| frame))?)
            }
            Self::Png { writer, opaque, path, .. } => {
                let all = picture.pixels.as_flattened();
                let rgb: Vec<u8>;
                let data = if *opaque {
                    rgb = picture.pixels.iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect();
                    &rgb
                } else {
                    all
                };
                writer.write_image_data(data).map_err(|error| png_error(path, error))
            }
            Self::Gif { encoder, fps, path } => {
                let shown = gif_frame(picture, frame_delay(frame, *fps));
                encoder.write_frame(&shown).map_err(|error| gif_error(path, error))
            }
            Self::Raw => Ok(std::io::stdout().write_all(picture.pixels.as_flattened())?),
        }
    }

    /// Finishes a file of several frames and renames it into place.
    pub(super) fn finish(self) -> Result<(), CliError> {
        match self {
            Self::Files(..) => Ok(()),
            Self::Png { writer, file, path, .. } => {
                writer.finish().map_err(|error| png_error(&path, error))?;
                file.finish(path)
            }
            Self::Gif { encoder, path, .. } => {
                let file = encoder.into_inner().map_err(|error| gif_error(&path, error))?;
                file.finish(path)
            }
            Self::Raw => Ok(std::io::stdout().flush()?),
        }
    }
}

/// A temporary file shared with an encoder that owns its writer and does not return it.
#[derive(Clone)]
pub(super) struct SharedFile(Rc<RefCell<BufWriter<AtomicFile>>>);

impl SharedFile {
    /// Creates the temporary file of an output.
    fn create(output: &Path) -> Result<Self, CliError> {
        Ok(Self(Rc::new(RefCell::new(BufWriter::new(AtomicFile::create(output)?)))))
    }

    /// Renames the file into place; the encoder must have been dropped.
    fn finish(self, path: PathBuf) -> Result<(), CliError> {
        let Ok(file) = Rc::try_unwrap(self.0) else { return Ok(()) };
        let draft = file.into_inner().into_inner();
        let draft = draft.map_err(|error| OutputError { path, cause: error.into_error() })?;
        Ok(draft.finish()?)
    }
}

impl Write for SharedFile {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.borrow_mut().write(bytes)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.0.borrow_mut().flush()
    }
}

/// The display time of a GIF frame in hundredths of a second, rounded so that the sum is exact.
fn frame_delay(frame: usize, fps: f64) -> u16 {
    let until = |frame: usize| libm::round(100.0 * frame as f64 / fps);
    (until(frame + 1) - until(frame)).min(65_535.0) as u16
}

/// Quantizes a picture to a palette of 256 colors of its own.
///
/// GIF has no partial transparency: alpha below one half becomes transparent, the rest opaque.
fn gif_frame(picture: &Picture, delay: u16) -> gif::Frame<'static> {
    let mut pixels: Vec<u8> = picture
        .pixels
        .iter()
        .flat_map(|&[r, g, b, alpha]| if alpha < 128 { [0; 4] } else { [r, g, b, 255] })
        .collect();
    let (width, height) = (picture.width as u16, picture.height as u16);
    let mut frame = gif::Frame::from_rgba_speed(width, height, &mut pixels, 10);
    frame.delay = delay;
    frame.dispose = gif::DisposalMethod::Background;
    frame
}

/// An error of the PNG encoder as an error about the output.
fn png_error(path: &Path, error: png::EncodingError) -> CliError {
    let cause = match error {
        png::EncodingError::IoError(cause) => cause,
        other => std::io::Error::other(other.to_string()),
    };
    OutputError { path: path.to_owned(), cause }.into()
}

/// An error of the GIF encoder as an error about the output.
fn gif_error(path: &Path, error: gif::EncodingError) -> CliError {
    let cause = match error {
        gif::EncodingError::Io(cause) => cause,
        other => std::io::Error::other(other.to_string()),
    };
    OutputError { path: path.to_owned(), cause }.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn delays_of_a_gif_add_up() {
        let all: u32 = (0..30).map(|frame| u32::from(frame_delay(frame, 30.0))).sum();
        assert_eq!(all, 100);
    }
}
