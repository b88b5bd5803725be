//! What the line styles of a scene file mean.

use super::file::{
    CapFile, HiddenFile, JoinFile, LinesFile, ShownFile, StyleFile, ToneFile, WidthFile,
};
use super::locate::Step::{self, Field};
use super::number::Positive;
use super::{Origin, SceneError, Style};
use drawing::{Cap, HiddenLines, Ink, IsoGroup, Join, LineLook, Shown, Tone, Widths};
use shade::color::parse_hex_codes;

/// How a scene is drawn.
pub(super) fn resolve_style(origin: &Origin, file: &StyleFile) -> Result<Style, SceneError> {
    Ok(match file {
        StyleFile::Shaded => Style::Shaded,
        StyleFile::Flat => Style::Flat,
        StyleFile::Gouraud => Style::Gouraud,
        StyleFile::Clay => Style::Clay,
        StyleFile::Matcap => Style::Matcap,
        StyleFile::Normals => Style::Normals,
        StyleFile::Depth => Style::Depth,
        StyleFile::UvChecker => Style::UvChecker,
        StyleFile::Ids => Style::Ids,
        StyleFile::Toon => Style::Toon,
        StyleFile::XRay => Style::XRay,
        StyleFile::Wireframe => Style::Wireframe,
        StyleFile::Lines(lines) => Style::Lines(resolve_lines(origin, lines)?),
    })
}

/// How a line drawing looks.
fn resolve_lines(origin: &Origin, file: &LinesFile) -> Result<LineLook, SceneError> {
    Ok(LineLook {
        shown: match file.shown {
            ShownFile::Facets => Shown::Facets,
            ShownFile::Features => Shown::Features,
            ShownFile::Tangents => Shown::Tangents,
            ShownFile::Silhouette => Shown::Silhouette,
        },
        hidden: resolve_hidden(file.hidden),
        crease: file.crease_degrees.value().to_radians(),
        depth_cue: file.depth_cue_percent.value() / 100.0,
        widths: resolve_widths(origin, file.width)?,
        ink: file.color.as_deref().map(|text| resolve_ink(origin, text)).transpose()?,
        cap: match file.cap {
            CapFile::Butt => Cap::Butt,
            CapFile::Round => Cap::Round,
            CapFile::Square => Cap::Square,
        },
        join: match file.join {
            JoinFile::Miter => Join::Miter,
            JoinFile::Round => Join::Round,
            JoinFile::Bevel => Join::Bevel,
        },
        hatch: file.hatch_mm.value(),
        tone: match file.tone {
            ToneFile::Blank => Tone::Blank,
            ToneFile::Flat => Tone::Flat,
            ToneFile::Hatching => Tone::Hatching,
        },
    })
}

pub(super) fn resolve_hidden(file: HiddenFile) -> HiddenLines {
    match file {
        HiddenFile::Removed => HiddenLines::Removed,
        HiddenFile::Dashed => HiddenLines::Dashed,
        HiddenFile::Drawn => HiddenLines::Drawn,
    }
}

fn resolve_widths(origin: &Origin, file: WidthFile) -> Result<Widths, SceneError> {
    match file {
        WidthFile::Px(pixels) => Ok(Widths::Pixels(pixels.value())),
        WidthFile::Mm(width) => Ok(Widths::Millimetres(width.value())),
        WidthFile::Iso(wide) => {
            iso_group(origin, wide, &[Field("style"), Field("width")]).map(Widths::Iso)
        }
    }
}

/// The group of line widths with wide lines of this width.
pub(super) fn iso_group(
    origin: &Origin,
    wide: Positive,
    at: &[Step<'_>],
) -> Result<IsoGroup, SceneError> {
    IsoGroup::of_width(wide.value()).ok_or_else(|| {
        let message = format!("ISO 128 has no group of line widths {}", wide.value());
        let help = "possible are 0.25, 0.35, 0.5, 0.7, 1, 1.4 and 2".to_owned();
        origin.fault(at, message, Some(help))
    })
}

fn resolve_ink(origin: &Origin, text: &str) -> Result<Ink, SceneError> {
    parse_hex_codes(text).ok_or_else(|| {
        let message = format!("`{text}` is no colour");
        let help = "write #rgb or #rrggbb, such as #1a1f26".to_owned();
        origin.fault(&[Field("style"), Field("color")], message, Some(help))
    })
}
