//! The format of an output, by the end of its name.

use super::failure::Failure;
use pipeline::drawing::{Page, to_pdf};
use std::path::Path;

/// What an output is written as.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Format {
    Png,
    Svg,
    Pdf,
}

impl Format {
    /// The format of a file of this name.
    pub(super) fn of(output: &Path) -> Result<Self, Failure> {
        let ending = output.extension().map(|ending| ending.to_string_lossy().to_lowercase());
        match ending.as_deref() {
            Some("png") => Ok(Self::Png),
            Some("svg") => Ok(Self::Svg),
            Some("pdf") => Ok(Self::Pdf),
            _ => {
                let name = output.display();
                Err(Failure::Usage(format!("the output {name} does not end in .png, .svg or .pdf")))
            }
        }
    }

    /// Pages in a format of lines; an SVG has the first alone.
    pub(super) fn vectors(self, pages: &[Page]) -> Vec<u8> {
        match self {
            Self::Pdf => to_pdf(pages),
            Self::Png | Self::Svg => {
                pages.first().map(Page::to_svg).unwrap_or_default().into_bytes()
            }
        }
    }
}
