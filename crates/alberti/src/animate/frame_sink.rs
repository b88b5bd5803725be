//! The output of a frame sequence, written one frame at a time.
//!
//! | output | format | colors | transparency |
//! | --- | --- | --- | --- |
//! | `NAME_{frame:04}.png` | one PNG per frame | 8 bits | full |
//! | `NAME.png`, `NAME.apng` | animated PNG | 8 bits | full |
//! | `NAME.gif` | animated GIF | 256 per frame | on or off |
//! | `-` | raw RGBA, for `ffmpeg -f rawvideo` | 8 bits | full |
//!
//! Frames arrive in order and are not stored: each is encoded and written before the next arrives.

use crate::CliError;
use crate::format::refuse_blender_path;
use batch::NameTemplate;
use pipeline::sequence::Sequence;
use pipeline::{AtomicFile, OutputError, Picture};
use std::cell::RefCell;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// An output for frames. A file with several frames gets its name only when it is complete.
///
/// The frames of [`Self::Files`] are written atomically and remain if the run is stopped. The raw
/// stream has no header: the reader must know the size and frame rate.
pub(super) enum FrameSink {
    /// One PNG per frame: the template of the names, and the value of `{stem}`.
    Files(NameTemplate, String),
    /// One animated PNG.
    Png { writer: Box<png::Writer<SharedFile>>, file: SharedFile, opaque: bool, path: PathBuf },
    /// One animated GIF.
    Gif { encoder: Box<gif::Encoder<SharedFile>>, fps: f64, path: PathBuf },
    /// Raw RGBA pixels, 8 bits per channel, on the standard output.
    Raw,
}

/// Returns the error for a video file name, with the ffmpeg command that produces the video.
///
/// Most players need colors at half resolution, which requires an even width and height.
fn unwritten_video_error(input: &Path, output: &Path, size: (u32, u32), fps: f64) -> CliError {
    let (width, height) = size;
    let (input, name) = (input.display(), output.display());
    let is_even = width % 2 == 0 && height % 2 == 0;
    let even = if is_even { "" } else { "-vf 'pad=ceil(iw/2)*2:ceil(ih/2)*2' " };
    CliError::Usage(format!(
        "{name}: video output is not supported\n  = help: pipe the frames to ffmpeg, with your other flags before `-o`: `alberti animate {input} --size {width}x{height} --fps {fps} --background white -o - | ffmpeg -f rawvideo -pixel_format rgba -video_size {width}x{height} -framerate {fps} -i - {even}-pix_fmt yuv420p {name}`"
    ))
}

impl FrameSink {
    /// Opens the output for a name; nothing appears under the name yet.
    ///
    /// A name with the field `{frame}` means one file per frame, even if there is only one frame.
    ///
    /// # Errors
    /// Returns an error if the name has no supported extension, or the file cannot be created.
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
        refuse_blender_path(output)?;
        let stem = input.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let template =
            NameTemplate::parse(&name, &["stem"], &["frame"]).map_err(CliError::Usage)?;
        if template.has_field("frame") {
            if !name.to_lowercase().ends_with(".png") {
                let help = "write frames as PNG: NAME_{frame:04}.png";
                return Err(CliError::Usage(format!(
                    "{name} does not end in .png\n  = help: {help}"
                )));
            }
            return Ok(Self::Files(template, stem));
        }
        match output.extension().map(|ending| ending.to_string_lossy().to_lowercase()).as_deref() {
            Some("png" | "apng") => Self::open_png(output, film, fps),
            Some("gif") => Self::open_gif(output, film, fps),
            Some("mp4" | "m4v" | "mov" | "mkv" | "webm" | "avi" | "webp") => {
                Err(unwritten_video_error(input, output, film.image_size(), fps))
            }
            ending => {
                let what = if ending.is_some() {
                    "unsupported file extension"
                } else {
                    "missing file extension"
                };
                Err(CliError::Usage(format!(
                    "{name}: {what}\n  = help: write NAME.gif or NAME.png for one animated file, NAME_{{frame:04}}.png for one file per frame, or - for raw frames"
                )))
            }
        }
    }

    /// Opens an animated PNG: RGB if every frame is opaque, otherwise RGBA.
    ///
    /// A frame's delay is stored as a fraction of two 16-bit numbers: 1000 / (1000 fps).
    ///
    /// The factor 1000 makes rates such as 23.976 exact to a thousandth. Rates above 65.535 frames
    /// per second do not fit and play at 65.535.
    ///
    /// Whether all frames are opaque must be known before the first one is written, because the
    /// color type is in the header. The scene's background determines it. The file loops forever (0
    /// repetitions).
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
    ///
    /// The global palette is empty, because every frame has a palette.
    ///
    /// # Errors
    /// Returns an error if a side exceeds 65,535 pixels, the limit of the format's 16-bit fields.
    fn open_gif(output: &Path, film: &Sequence, fps: f64) -> Result<Self, CliError> {
        let (width, height) = film.image_size();
        let (Ok(width), Ok(height)) = (u16::try_from(width), u16::try_from(height)) else {
            let most = u16::MAX;
            return Err(CliError::Usage(format!(
                "a GIF can be at most {most} pixels wide and high, but the frames are {width} x {height}"
            )));
        };
        let fault = |error| gif_error(output, error);
        let file = SharedFile::create(output)?;
        let mut encoder = gif::Encoder::new(file, width, height, &[]).map_err(fault)?;
        encoder.set_repeat(gif::Repeat::Infinite).map_err(fault)?;
        Ok(Self::Gif { encoder: Box::new(encoder), fps, path: output.to_owned() })
    }

    /// Appends one frame, or writes it to a separate file.
    ///
    /// In the animated formats, every frame must have the size of the first, which [`Sequence`]
    /// guarantees. Alpha is dropped from opaque frames only, never blended.
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
    ///
    /// Callers must call this: a sink that is dropped unfinished removes its temporary file, as a
    /// failed run should.
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
///
/// The encoder holds one clone and [`FrameSink`] the other, so that the file can be renamed after
/// the encoder has written its last chunk. Everything happens on one thread, so `Rc` is enough.
#[derive(Clone)]
pub(super) struct SharedFile(Rc<RefCell<BufWriter<AtomicFile>>>);

impl SharedFile {
    /// Creates the temporary file for an output.
    fn create(output: &Path) -> Result<Self, CliError> {
        Ok(Self(Rc::new(RefCell::new(BufWriter::new(AtomicFile::create(output)?)))))
    }

    /// Renames the file into place; the encoder must have been dropped.
    ///
    /// If another clone is still alive, nothing is renamed, and the last clone removes the file.
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

/// Returns the display time of a GIF frame in hundredths of a second; the total is exact.
///
/// It is the difference between two rounded times, not a rounded difference. At 30 frames per
/// second, the delays are 3, 4, 3, 3, 4, 3 …, and 30 of them last exactly one second. Many viewers
/// raise delays below 2, that is, rates above 50, to 10.
fn frame_delay(frame: usize, fps: f64) -> u16 {
    let until = |frame: usize| libm::round(100.0 * frame as f64 / fps);
    (until(frame + 1) - until(frame)).min(65_535.0) as u16
}

/// Quantizes a picture to 256 colors, chosen for this picture.
///
/// GIF has no partial transparency: alpha below one half becomes transparent, the rest opaque.
///
/// NeuQuant computes the palette with a sampling factor of 10, that is, from a tenth of the pixels:
/// the `gif` crate's compromise between speed (30) and quality (1). Each frame is erased before the
/// next, because transparent pixels would otherwise show the previous frame.
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

/// Converts a PNG encoder error to an error about the output.
///
/// Only I/O errors come from the system. Others, such as a wrong amount of data, become I/O errors
/// with the encoder's message, so that both kinds are reported with the file name.
fn png_error(path: &Path, error: png::EncodingError) -> CliError {
    let cause = match error {
        png::EncodingError::IoError(cause) => cause,
        other => std::io::Error::other(other.to_string()),
    };
    OutputError { path: path.to_owned(), cause }.into()
}

/// Converts a GIF encoder error to an error about the output.
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
    fn gif_delays_add_up() {
        let all: u32 = (0..30).map(|frame| u32::from(frame_delay(frame, 30.0))).sum();
        assert_eq!(all, 100);
    }
}
