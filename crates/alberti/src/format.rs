//! The format of an output, by the end of its name.

use super::error::CliError;
use drawing::{Page, to_pdf};
use std::path::Path;

/// What an output is written as.
#[derive(Clone, Copy, PartialEq, Eq, Debug, clap::ValueEnum)]
pub(crate) enum OutputFormat {
    /// Pixels
    Png,
    /// A line drawing
    Svg,
    /// A line drawing on a page
    Pdf,
}

impl OutputFormat {
    /// The format of a file of this name.
    pub(super) fn from_path(output: &Path) -> Result<Self, CliError> {
        let ending = output.extension().map(|ending| ending.to_string_lossy().to_lowercase());
        match ending.as_deref() {
            Some("png") => Ok(Self::Png),
            Some("svg") => Ok(Self::Svg),
            Some("pdf") => Ok(Self::Pdf),
            _ => {
                let name = output.display();
                let help = "name it so, or say what it is with --format";
                Err(CliError::Usage(format!(
                    "the output {name} does not end in .png, .svg or .pdf\n  = help: {help}"
                )))
            }
        }
    }

    /// The end of the names of such files.
    pub(super) fn extension(self) -> &'static str {
        match self {
            Self::Png => "png",
            Self::Svg => "svg",
            Self::Pdf => "pdf",
        }
    }

    /// Pages in a format of lines; an SVG has the first alone.
    pub(super) fn encode_pages(self, pages: &[Page]) -> Vec<u8> {
        match self {
            Self::Pdf => to_pdf(pages),
            Self::Png | Self::Svg => {
                pages.first().map(Page::to_svg).unwrap_or_default().into_bytes()
            }
        }
    }
}
