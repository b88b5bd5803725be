//! Parses the blocks of figures and writes their HTML elements.

use crate::command::{Job, Kind, hash};
use crate::language::Language;
use crate::marks::Fence;
use std::fs;
use std::path::{Path, PathBuf};

/// The maximum width of a figure in CSS pixels, equal to the width of the text column.
const WIDEST: f64 = 640.0;

/// The parsed contents of a block ```` ```alberti ````.
#[derive(PartialEq, Eq, Debug)]
pub struct FigureMark {
    /// The command that draws the figure.
    pub job: Job,
    /// The query string that shows the figure's state in the explorer, if specified.
    pub explore: Option<String>,
}

impl FigureMark {
    /// Parses a block, which must have a caption.
    pub fn parse(fence: &Fence) -> Result<Self, String> {
        let (mut kind, mut explore) = (Kind::Svg, None);
        let words = shlex::split(fence.arguments()).ok_or("unclosed quotation mark")?;
        for word in words {
            match word.split_once('=') {
                Some(("format", "svg")) => kind = Kind::Svg,
                Some(("format", "png")) => kind = Kind::Png,
                Some(("explore", query)) => explore = Some(query.to_owned()),
                _ => {
                    return Err(format!(
                        "unknown attribute `{word}`; expected format=png or explore=\"…\""
                    ));
                }
            }
        }
        if fence.caption.as_ref().is_none_or(|caption| caption.text.trim().is_empty()) {
            return Err(
                "the paragraph after a figure must be its caption, *emphasized* as a whole".into(),
            );
        }
        let job = Job::parse(&fence.body, kind)?;
        if job.words.iter().any(|word| word == "-o" || word == "--output") {
            return Err("the command of a figure must not specify an output file".into());
        }
        Ok(Self { job, explore })
    }
}

/// A figure that has been drawn.
pub struct Figure<'a> {
    /// The file in the cache.
    pub path: &'a Path,
    /// The caption as HTML.
    pub caption: &'a str,
    /// The caption without markup.
    pub alt: &'a str,
    /// The query string for the explorer, if its page is published with the book.
    pub explore: Option<&'a str>,
    /// The language of the page.
    pub language: Language,
}

impl Figure<'_> {
    /// Returns the element as a single line of HTML.
    pub fn to_html(&self) -> Result<String, String> {
        let bytes =
            fs::read(self.path).map_err(|error| format!("{}: {error}", self.path.display()))?;
        let (width, height) = size(&bytes).ok_or("cannot read the size of the figure")?;
        let factor = (WIDEST / width).min(1.0);
        let (width, height) = ((width * factor).round(), (height * factor).round());
        let name = self.path.file_name().unwrap_or_default().to_string_lossy();
        let link = self.explore.map_or_else(String::new, |query| {
            let words = self.language.texts().explore;
            let query = escape_attribute(query);
            format!(" <a class=\"explore\" href=\"../explorer/index.html#{query}&amp;lang={}\">{words}</a>", self.language.code())
        });
        Ok(format!(
            "<figure><img src=\"figures/{name}\" alt=\"{}\" width=\"{width}\" height=\"{height}\" \
             data-hash=\"{}\"><figcaption>{}{link}</figcaption></figure>",
            escape_attribute(self.alt),
            hash(&bytes),
            self.caption.replace('\n', " ")
        ))
    }
}

/// Escapes text for an attribute between double quotation marks.
pub fn escape_attribute(text: &str) -> String {
    text.replace('&', "&amp;").replace('"', "&quot;").replace('<', "&lt;").replace('>', "&gt;")
}

/// Returns the width and height of a PNG or SVG file in CSS pixels.
fn size(bytes: &[u8]) -> Option<(f64, f64)> {
    if bytes.starts_with(b"\x89PNG") {
        let number = |at: usize| {
            Some(f64::from(u32::from_be_bytes(bytes.get(at..at + 4)?.try_into().ok()?)))
        };
        return Some((number(16)?, number(20)?));
    }
    let text = std::str::from_utf8(bytes).ok()?;
    let root = text.get(text.find("<svg")?..)?.split('>').next()?;
    let length = |name: &str| {
        let value = root.split(&format!(" {name}=\"")).nth(1)?.split('"').next()?;
        let digits = value.trim_end_matches(|letter: char| letter.is_alphabetic() || letter == '%');
        let factor = match &value[digits.len()..] {
            "mm" => 96.0 / 25.4,
            "" | "px" => 1.0,
            "pt" => 96.0 / 72.0,
            _ => return None,
        };
        Some(digits.parse::<f64>().ok()? * factor)
    };
    Some((length("width")?, length("height")?))
}

/// Copies figures to a folder, which is created if it is missing.
pub fn copy_figures(paths: &[PathBuf], folder: &Path) -> Result<(), String> {
    fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    for path in paths {
        let target = folder.join(path.file_name().unwrap_or_default());
        fs::copy(path, &target).map_err(|error| format!("{}: {error}", target.display()))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::marks::Marks;

    #[test]
    fn attributes_and_captions_are_parsed() {
        let text = "```alberti format=png explore=\"lesson=near-far&n=2\"\nalberti render a.ron\n```\n\n*A.*\n";
        let mark = FigureMark::parse(&Marks::read(text).fences[0]).unwrap();
        assert_eq!(mark.job.kind, Kind::Png);
        assert_eq!(mark.explore.as_deref(), Some("lesson=near-far&n=2"));
        let faults = [
            "```alberti\nalberti render a.ron\n```\n\nNo caption.\n",
            "```alberti size=3\nalberti render a.ron\n```\n\n*A.*\n",
            "```alberti\nalberti render a.ron -o b.svg\n```\n\n*A.*\n",
        ];
        for text in faults {
            assert!(FigureMark::parse(&Marks::read(text).fences[0]).is_err(), "{text}");
        }
    }

    #[test]
    fn sizes_are_converted_to_css_pixels() {
        assert_eq!(size(b"<svg xmlns=\"x\" width=\"25.4mm\" height=\"12\">"), Some((96.0, 12.0)));
        let png = [b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR".as_slice(), &[0, 0, 2, 0, 0, 0, 1, 0]].concat();
        assert_eq!(size(&png), Some((512.0, 256.0)));
        assert_eq!(size(b"<svg width=\"100%\" height=\"1\">"), None);
    }
}
