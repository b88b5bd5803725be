//! What the line styles of a scene file mean.

use super::file::{CapFile, HiddenFile, JoinFile, LinesFile, ShownFile, WidthFile};
use super::locate::Step::Field;
use super::{Origin, SceneError};
use crate::color::parse_hex_codes;
use crate::drawing::{Cap, HiddenLines, Ink, IsoGroup, Join, LineLook, Shown, Widths};

/// How a line drawing looks.
pub(super) fn resolve_lines(origin: &Origin, file: &LinesFile) -> Result<LineLook, SceneError> {
    Ok(LineLook {
        shown: match file.shown {
            ShownFile::Facets => Shown::Facets,
            ShownFile::Features => Shown::Features,
            ShownFile::Tangents => Shown::Tangents,
            ShownFile::Silhouette => Shown::Silhouette,
        },
        hidden: match file.hidden {
            HiddenFile::Removed => HiddenLines::Removed,
            HiddenFile::Dashed => HiddenLines::Dashed,
            HiddenFile::Drawn => HiddenLines::Drawn,
        },
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
    })
}

fn resolve_widths(origin: &Origin, file: WidthFile) -> Result<Widths, SceneError> {
    match file {
        WidthFile::Px(pixels) => Ok(Widths::Pixels(pixels.value())),
        WidthFile::Mm(width) => Ok(Widths::Millimetres(width.value())),
        WidthFile::Iso(wide) => {
            IsoGroup::of_width(wide.value()).map(Widths::Iso).ok_or_else(|| {
                let message = format!("ISO 128 has no group of line widths {}", wide.value());
                let help = "possible are 0.25, 0.35, 0.5, 0.7, 1, 1.4 and 2; Mm(…) is any width"
                    .to_owned();
                origin.fault(&[Field("style"), Field("width")], message, Some(help))
            })
        }
    }
}

fn resolve_ink(origin: &Origin, text: &str) -> Result<Ink, SceneError> {
    parse_hex_codes(text).ok_or_else(|| {
        let message = format!("`{text}` is no colour");
        let help = "write #rgb or #rrggbb, such as #1a1f26".to_owned();
        origin.fault(&[Field("style"), Field("color")], message, Some(help))
    })
}
