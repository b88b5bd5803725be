//! Output formats and their file extensions.
//!
//! Commands with a plot or panels accept further extensions, such as `.html` or `.csv`, and check
//! these before they look up an [`OutputFormat`].

mod dxf;
mod raster;

pub(crate) use dxf::{DxfArgs, image_warning};
pub(crate) use raster::{DEFAULT_QUALITY, parse_quality};

use super::error::CliError;
use clap::ValueEnum as _;
use files::visible_path;
use page::{DxfOptions, Page, to_pdf};
use std::path::Path;

/// The format of an output file.
#[derive(Clone, Copy, PartialEq, Eq, Debug, clap::ValueEnum)]
pub(crate) enum OutputFormat {
    /// Raster image
    Png,
    /// Raster image without alpha, with lossy compression
    #[value(alias = "jpg")]
    Jpeg,
    /// Raster image with lossless compression
    Webp,
    /// Line drawing
    Svg,
    /// Line drawing on a page
    Pdf,
    /// Line drawing for CAD and CAM programs
    Dxf,
}

impl OutputFormat {
    /// Returns a file's format from its extension, ignoring case.
    ///
    /// An unknown extension is an error rather than a PNG, because a typo such as `model.sgv` would
    /// otherwise produce a file that no program opens.
    ///
    /// # Errors
    /// Returns an error if the extension is unknown.
    pub(super) fn from_path(output: &Path) -> Result<Self, CliError> {
        if let Some(error) = prefix_error(&visible_path(output).to_string()) {
            return Err(error);
        }
        let ending = output.extension().map(|ending| ending.to_string_lossy().to_lowercase());
        match ending.as_deref() {
            Some("png") => Ok(Self::Png),
            Some("jpg" | "jpeg" | "jpe") => Ok(Self::Jpeg),
            Some("webp") => Ok(Self::Webp),
            Some("svg") => Ok(Self::Svg),
            Some("pdf") => Ok(Self::Pdf),
            Some("dxf") => Ok(Self::Dxf),
            ending => Err(Self::unknown_extension_error(output, ending.unwrap_or_default())),
        }
    }

    /// Whether the extension indicates a picture or a video, in a supported format or not.
    pub(super) fn is_known(output: &Path) -> bool {
        let ending = output.extension().map(|ending| ending.to_string_lossy().to_lowercase());
        let known = [
            "png", "jpg", "jpeg", "jpe", "webp", "svg", "pdf", "dxf", "tif", "tiff", "bmp", "exr",
            "gif", "mp4", "mov", "webm", "mkv", "avi", "avif", "tga", "ps", "eps", "hdr",
        ];
        ending.is_some_and(|ending| known.contains(&ending.as_str()))
    }

    /// Returns the error for an unsupported extension, with a way to get such a file, if any.
    fn unknown_extension_error(output: &Path, ending: &str) -> CliError {
        let name = visible_path(output);
        let unwritten = |format: &str, help: String| {
            CliError::Usage(format!("{name}: {format} output is not supported\n  = help: {help}"))
        };
        let convert = |format: &str| {
            let png = output.with_extension("png");
            let png = visible_path(&png);
            unwritten(
                format,
                format!(
                    "write {png} and convert it, for example with ImageMagick: `magick {png} {name}`"
                ),
            )
        };
        match ending {
            "exr" | "npy" => unwritten(
                &format!("{} picture", ending.to_uppercase()),
                format!(
                    "depth, normals and other passes are written as {} files, next to the picture: `--passes depth --pass-format {ending} -o picture.png`",
                    ending.to_uppercase()
                ),
            ),
            "glb" | "gltf" | "obj" | "stl" | "ply" | "3mf" | "fbx" | "usdz" => unwritten(
                "model",
                "models are drawn, not converted; to convert them, use a program such as Blender"
                    .into(),
            ),
            "dwg" => unwritten(
                "DWG",
                format!("write {} instead", visible_path(output.with_extension("dxf"))),
            ),
            "csv" | "json" => {
                unwritten("text", "`--json` prints a report about the picture".into())
            }
            "ppm" | "pgm" | "pnm" | "ico" | "heic" | "jp2" | "jxl" => {
                convert(&ending.to_uppercase())
            }
            "avif" => convert("AVIF"),
            "tif" | "tiff" => convert("TIFF"),
            "bmp" => convert("BMP"),
            "tga" => convert("TGA"),
            "eps" | "ps" => unwritten(
                "PostScript",
                format!("write {} instead", output.with_extension("pdf").display()),
            ),
            "gif" | "mp4" | "m4v" | "mov" | "webm" | "mkv" | "avi" => {
                moving_picture_error(output, ending)
            }
            _ if output.is_dir() || name.ends_with('/') => CliError::Usage(format!(
                "{name} is a folder\n  = help: name a file in it, as in -o '{}'",
                visible_path(output.join("{stem}.png"))
            )),
            _ => CliError::Usage(format!(
                "{name}: unsupported output format; use .png, .jpg, .webp, .svg, .pdf or .dxf"
            )),
        }
    }

    /// Returns the file extension, without the dot.
    pub(super) fn extension(self) -> &'static str {
        match self {
            Self::Png => "png",
            Self::Jpeg => "jpg",
            Self::Webp => "webp",
            Self::Svg => "svg",
            Self::Pdf => "pdf",
            Self::Dxf => "dxf",
        }
    }

    /// Encodes pages in a vector format; an SVG or a DXF holds only the first.
    ///
    /// A PDF contains them all, and their sizes may differ. A DXF is in millimeters on paper.
    /// Raster formats are treated as SVG here: callers rasterize the page before they call this
    /// function.
    pub(super) fn encode_pages<W>(self, pages: &[Page<W>]) -> Vec<u8> {
        match self {
            Self::Pdf => to_pdf(pages),
            Self::Dxf => {
                let encode = |page: &Page<W>| page.to_dxf(&DxfOptions::on_paper(page));
                pages.first().map(encode).unwrap_or_default()
            }
            Self::Png | Self::Jpeg | Self::Webp | Self::Svg => {
                pages.first().map(Page::to_svg).unwrap_or_default().into_bytes()
            }
        }
    }
}

/// Returns the error for a video as the output of a command that writes stills.
fn moving_picture_error(output: &Path, ending: &str) -> CliError {
    let (name, gif) = (visible_path(output), output.with_extension("gif"));
    let gif = visible_path(&gif);
    let turn = "alberti animate MODEL --turntable";
    let help = match ending {
        "gif" => format!("`{turn} -o {gif}` writes an animation"),
        _ => format!(
            "`{turn} -o {gif}` writes an animation; for a video, pipe the frames to ffmpeg: `{turn} --size 960x720 --background white -o - | ffmpeg -f rawvideo -pixel_format rgba -video_size 960x720 -framerate 30 -i - -pix_fmt yuv420p {name}`"
        ),
    };
    CliError::Usage(format!("{name}: this command writes still pictures\n  = help: {help}"))
}

/// Refuses `//out/render_`, which is relative to the scene's folder in Blender and to the root of
/// the file system everywhere else.
///
/// # Errors
/// Returns an error if the path begins with two slashes.
pub(crate) fn refuse_blender_path(output: &Path) -> Result<(), CliError> {
    let name = visible_path(output);
    match name.strip_prefix("//") {
        Some(rest) if !rest.contains('#') => Err(CliError::Usage(format!(
            "{name}: two slashes at the beginning of a path have no meaning here\n  = help: for a path in the current folder, write -o {rest}"
        ))),
        _ => Ok(()),
    }
}

/// Returns the error for a name in ImageMagick's style, such as `png:-` or `png:out.png`.
fn prefix_error(name: &str) -> Option<CliError> {
    let (format, rest) = name.split_once(':')?;
    let format = format.trim_end_matches(|c: char| c.is_ascii_digit());
    let format = if format.eq_ignore_ascii_case("jpg") { "jpeg" } else { format };
    let format = format.to_ascii_lowercase();
    OutputFormat::from_str(&format, true).ok()?;
    Some(CliError::Usage(format!(
        "{name}: a format in front of the name is not supported\n  = help: write `--format {format} -o {rest}`"
    )))
}
