//! Resolution of the style of surfaces and lines.

use super::{Origin, Style};
use drawing::{LineStyle, LineWidths};
use page::IsoLineGroup;
use scene_file::PathStep::{self, Field};
use scene_file::file::{CreaseAngle, LinesFile, Positive, StyleFile, WidthFile};
use scene_file::{SceneError, SceneFile};

/// Resolves the style of a scene.
pub(super) fn resolve_style(origin: &Origin, file: &SceneFile) -> Result<Style, SceneError> {
    Ok(match &file.style {
        StyleFile::Shaded => Style::Shaded,
        StyleFile::Flat => Style::Flat,
        StyleFile::Unlit => Style::Unlit,
        StyleFile::Gouraud => Style::Gouraud,
        StyleFile::Clay => Style::Clay,
        StyleFile::Matcap => Style::Matcap,
        StyleFile::Normals => Style::Normals,
        StyleFile::Depth => Style::Depth(file.depth_colormap),
        StyleFile::UvChecker => Style::UvChecker,
        StyleFile::Ids => Style::Ids,
        StyleFile::Toon => Style::Toon,
        StyleFile::XRay => Style::XRay,
        StyleFile::Wireframe => Style::Wireframe,
        StyleFile::Lines(lines) => Style::Lines(resolve_lines(origin, lines)?),
    })
}

/// Resolves the style of a line drawing.
fn resolve_lines(origin: &Origin, file: &LinesFile) -> Result<LineStyle, SceneError> {
    Ok(LineStyle {
        edges: file.edges,
        hidden_lines: file.hidden,
        crease_angle: file.crease_degrees.unwrap_or(CreaseAngle::DEFAULT).value().to_radians(),
        tangent_angle: file.tangent_degrees.map(|angle| angle.value().to_radians()),
        asks_normals: file.crease_degrees.is_none(),
        silhouettes: file.silhouettes,
        depth_cue: file.depth_cue_percent.value() / 100.0,
        line_widths: resolve_widths(origin, file.width)?,
        ink: file.color.map(|color| color.0),
        paper: file.paper.map(|color| color.0),
        cap: file.cap,
        join: file.join,
        hatch_spacing: file.hatch_spacing_mm.value(),
        face_fill: file.face_fill,
        hand_drawn: file.hand_drawn_mm.value(),
    })
}

/// Returns the widths of wide and narrow lines.
fn resolve_widths(origin: &Origin, file: WidthFile) -> Result<LineWidths, SceneError> {
    match file {
        WidthFile::Px(pixels) => Ok(LineWidths::Pixels(pixels.value())),
        WidthFile::Mm(width) => Ok(LineWidths::Millimeters(width.value())),
        WidthFile::Iso(wide) => {
            let path = [Field("style"), Field("width")];
            resolve_iso_group(origin, wide, &path).map(LineWidths::Iso)
        }
    }
}

/// Returns the ISO 128 line group whose wide lines have this width in millimeters.
pub(super) fn resolve_iso_group(
    origin: &Origin,
    wide: Positive,
    path: &[PathStep<'_>],
) -> Result<IsoLineGroup, SceneError> {
    IsoLineGroup::from_wide_width(wide.value()).ok_or_else(|| {
        let message = format!("ISO 128 has no line group of width {}", wide.value());
        let help = "write 0.25, 0.35, 0.5, 0.7, 1, 1.4 or 2".to_owned();
        origin.error_at(path, message, Some(help))
    })
}
