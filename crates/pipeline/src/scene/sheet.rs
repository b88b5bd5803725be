//! Resolution of the drawing sheet: paper, arrangement, scale and title block.

use super::file::{AxonometricView, PageOrientation, PaperSize, SheetFile, SideView};
use super::style::resolve_iso_group;
use super::syntax::PathStep::{self, Field};
use super::{Origin, SceneError};
use camera::NamedView;
use drawing::{LineStyle, LineWidths, Sheet, SheetError, TitleBlockText};
use model::{LengthUnit, ModelInstance};
use projection::SheetAngle;
use viewport::{DrawingScale, Paper};

/// Resolves the drawing sheet of a scene file for its models.
///
/// # Errors
/// If the scale has a 0, ISO 128 has no line group of the width, or the models have several units;
/// the error points into the file.
pub fn resolve_sheet(
    origin: &Origin,
    file: &SheetFile,
    models: &[ModelInstance],
) -> Result<Sheet, SceneError> {
    let (paper, name) = resolve_paper(file);
    let default_sheet = Sheet::for_paper(paper, name);
    let side_view = match (file.side_view, file.projection_angle) {
        (Some(SideView::Left), _) | (None, SheetAngle::First) => NamedView::Left,
        (Some(SideView::Right), _) | (None, SheetAngle::Third) => NamedView::Right,
    };
    let widths = match file.width {
        Some(width) => {
            let group = resolve_iso_group(origin, width, &[Field("sheet"), Field("width")])?;
            LineWidths::Iso(group)
        }
        None => default_sheet.style.line_widths,
    };
    let style = LineStyle { hidden_lines: file.hidden, line_widths: widths, ..default_sheet.style };
    Ok(Sheet {
        projection_angle: file.projection_angle,
        side_view,
        style,
        scale: file.scale.map(|scale| resolve_scale(origin, scale)).transpose()?,
        millimeters_per_unit: resolve_unit(origin, file, models)?.in_millimeters(),
        axonometric_view: axonometric_view(file.axonometric_view),
        dimensions: file.dimensions,
        title_block: TitleBlockText {
            title: file.title.clone(),
            author: file.author.clone(),
            date: file.date.clone(),
            number: file.number.clone(),
        },
        ..default_sheet
    })
}

/// The error of a sheet whose views are larger than its paper; `None` without one, or if it is
/// wrong in itself.
pub(super) fn check_sheet_layout(
    origin: &Origin,
    file: Option<&SheetFile>,
    models: &[ModelInstance],
) -> Option<SceneError> {
    let file = file?;
    let error = resolve_sheet(origin, file, models).ok()?.check_layout(models).err()?;
    let place: &[PathStep<'_>] = match (&error, file.scale) {
        (SheetError::TooLarge { .. }, Some(_)) => &[Field("sheet"), Field("scale")],
        (SheetError::TooLarge { .. }, None) => &[Field("sheet")],
        // Models without anything to draw are told of by the camera.
        _ => return None,
    };
    let message = error.to_string();
    // The remedy is the last part of the message.
    let (message, help) = match message.rsplit_once("; ") {
        Some((message, help)) => (message.to_owned(), Some(help.to_owned())),
        None => (message, None),
    };
    Some(origin.error_at(place, message, help))
}

/// The paper in its orientation, and its name on the sheet.
fn resolve_paper(file: &SheetFile) -> (Paper, &'static str) {
    let (paper, name) = match file.paper {
        PaperSize::A0 => (Paper::A0, "A0"),
        PaperSize::A1 => (Paper::A1, "A1"),
        PaperSize::A2 => (Paper::A2, "A2"),
        PaperSize::A3 => (Paper::A3, "A3"),
        PaperSize::A4 => (Paper::A4, "A4"),
        PaperSize::A5 => (Paper::A5, "A5"),
        PaperSize::Letter => (Paper::LETTER, "Letter"),
        PaperSize::Tabloid => (Paper::TABLOID, "Tabloid"),
    };
    let upright = match file.orientation {
        Some(orientation) => orientation == PageOrientation::Portrait,
        None => matches!(file.paper, PaperSize::A4 | PaperSize::A5 | PaperSize::Letter),
    };
    (if upright { paper } else { paper.rotated() }, name)
}

/// The scale as a ratio of lengths on paper to lengths of the object.
fn resolve_scale(origin: &Origin, (paper, thing): (u32, u32)) -> Result<DrawingScale, SceneError> {
    DrawingScale::new(paper, thing).map_err(|error| {
        let help = "write (1, 50) for 1:50".to_owned();
        origin.error_at(&[Field("sheet"), Field("scale")], error.to_string(), Some(help))
    })
}

/// The unit of the models: that of the sheet, else the one that all of their files have.
fn resolve_unit(
    origin: &Origin,
    file: &SheetFile,
    models: &[ModelInstance],
) -> Result<LengthUnit, SceneError> {
    if let Some(unit) = file.unit {
        return Ok(unit);
    }
    let mut units = models.iter().map(|instance| instance.model.length_unit);
    let first = units.next().unwrap_or_default();
    let Some(other) = units.find(|unit| *unit != first) else { return Ok(first) };
    let message = format!("some models are in {} and others in {}", first.symbol(), other.symbol());
    let help = "say which unit the sheet is to have: unit: Millimeter".to_owned();
    Err(origin.error_at(&[Field("sheet")], message, Some(help)))
}

/// The direction of the fourth view; `None` if there is none.
fn axonometric_view(file: AxonometricView) -> Option<NamedView> {
    match file {
        AxonometricView::None => None,
        AxonometricView::Isometric => Some(NamedView::Isometric),
        AxonometricView::Dimetric => Some(NamedView::Dimetric),
        AxonometricView::Trimetric => Some(NamedView::Trimetric),
        AxonometricView::ThreeQuarter => Some(NamedView::ThreeQuarter),
    }
}
