//! What the line styles of a scene file mean.

use super::file::{
    CapFile, EdgeSelectionFile, FaceFillFile, HiddenFile, JoinFile, LinesFile, StyleFile, WidthFile,
};
use super::number::Positive;
use super::source_span::PathStep::{self, Field};
use super::{Origin, SceneError, Style};
use drawing::{
    Cap, EdgeSelection, FaceFill, HiddenLines, Ink, IsoLineGroup, Join, LineStyle, LineWidths,
};
use shade::color::parse_hex_srgb;

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
fn resolve_lines(origin: &Origin, file: &LinesFile) -> Result<LineStyle, SceneError> {
    Ok(LineStyle {
        edges: match file.shown {
            EdgeSelectionFile::Facets => EdgeSelection::Facets,
            EdgeSelectionFile::Features => EdgeSelection::Features,
            EdgeSelectionFile::Tangents => EdgeSelection::Tangents,
            EdgeSelectionFile::Silhouette => EdgeSelection::Silhouette,
        },
        hidden_lines: resolve_hidden(file.hidden),
        crease_angle: file.crease_degrees.value().to_radians(),
        depth_cue: file.depth_cue_percent.value() / 100.0,
        line_widths: resolve_widths(origin, file.width)?,
        ink: file.color.as_deref().map(|text| resolve_line_color(origin, text)).transpose()?,
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
        hatch_spacing: file.hatch_mm.value(),
        face_fill: match file.tone {
            FaceFillFile::Blank => FaceFill::None,
            FaceFillFile::Flat => FaceFill::Flat,
            FaceFillFile::Hatching => FaceFill::Hatching,
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

fn resolve_widths(origin: &Origin, file: WidthFile) -> Result<LineWidths, SceneError> {
    match file {
        WidthFile::Px(pixels) => Ok(LineWidths::Pixels(pixels.value())),
        WidthFile::Mm(width) => Ok(LineWidths::Millimeters(width.value())),
        WidthFile::Iso(wide) => {
            resolve_iso_group(origin, wide, &[Field("style"), Field("width")]).map(LineWidths::Iso)
        }
    }
}

/// The group of line widths with wide lines of this width.
pub(super) fn resolve_iso_group(
    origin: &Origin,
    wide: Positive,
    at: &[PathStep<'_>],
) -> Result<IsoLineGroup, SceneError> {
    IsoLineGroup::from_wide_width(wide.value()).ok_or_else(|| {
        let message = format!("ISO 128 has no group of line widths {}", wide.value());
        let help = "possible are 0.25, 0.35, 0.5, 0.7, 1, 1.4 and 2".to_owned();
        origin.error_at(at, message, Some(help))
    })
}

fn resolve_line_color(origin: &Origin, text: &str) -> Result<Ink, SceneError> {
    parse_hex_srgb(text).ok_or_else(|| {
        let message = format!("`{text}` is no colour");
        let help = "write #rgb or #rrggbb, such as #1a1f26".to_owned();
        origin.error_at(&[Field("style"), Field("color")], message, Some(help))
    })
}
