//! What the sheet of a scene file means.

use super::file::{
    AngleFile, AxonometricFile, OrientationFile, PaperFile, SheetFile, SideFile, UnitFile,
};
use super::source_span::PathStep::Field;
use super::style::{resolve_hidden, resolve_iso_group};
use super::{Origin, SceneError};
use camera::NamedView;
use drawing::{LineWidths, Sheet, TitleBlockText};
use projection::SheetAngle;
use viewport::{DrawingScale, MILLIMETERS_PER_INCH, Paper};

/// The sheet that a scene file describes.
///
/// # Errors
/// If its scale or its width of lines is none; the error points at its place in the file.
pub fn resolve_sheet(origin: &Origin, file: &SheetFile) -> Result<Sheet, SceneError> {
    let (paper, name) = resolve_paper(file);
    let usual = Sheet::for_paper(paper, name);
    let (angle, side) = match file.angle {
        AngleFile::First => (SheetAngle::First, NamedView::Left),
        AngleFile::Third => (SheetAngle::Third, NamedView::Right),
    };
    let side = match file.side {
        None => side,
        Some(SideFile::Left) => NamedView::Left,
        Some(SideFile::Right) => NamedView::Right,
    };
    let widths = match file.width {
        Some(width) => {
            let group = resolve_iso_group(origin, width, &[Field("sheet"), Field("width")])?;
            LineWidths::Iso(group)
        }
        None => usual.style.line_widths,
    };
    let mut look = usual.style;
    (look.hidden_lines, look.line_widths) = (resolve_hidden(file.hidden), widths);
    Ok(Sheet {
        projection_angle: angle,
        side_view: side,
        style: look,
        scale: file.scale.map(|scale| resolve_scale(origin, scale)).transpose()?,
        millimeters_per_unit: unit_in_millimeters(file.unit),
        axonometric_view: axonometric_view(file.axonometric),
        dimensions: file.dimensions,
        title_block: TitleBlockText {
            title: file.title.clone(),
            author: file.author.clone(),
            date: file.date.clone(),
            number: file.number.clone(),
        },
        ..usual
    })
}
fn resolve_paper(file: &SheetFile) -> (Paper, &'static str) {
    let (paper, name) = match file.paper {
        PaperFile::A0 => (Paper::A0, "A0"),
        PaperFile::A1 => (Paper::A1, "A1"),
        PaperFile::A2 => (Paper::A2, "A2"),
        PaperFile::A3 => (Paper::A3, "A3"),
        PaperFile::A4 => (Paper::A4, "A4"),
        PaperFile::A5 => (Paper::A5, "A5"),
        PaperFile::Letter => (Paper::LETTER, "Letter"),
        PaperFile::Tabloid => (Paper::TABLOID, "Tabloid"),
    };
    let upright = match file.orientation {
        Some(orientation) => orientation == OrientationFile::Portrait,
        None => matches!(file.paper, PaperFile::A4 | PaperFile::A5 | PaperFile::Letter),
    };
    (if upright { paper } else { paper.rotated() }, name)
}

fn resolve_scale(origin: &Origin, (paper, thing): (u32, u32)) -> Result<DrawingScale, SceneError> {
    DrawingScale::new(paper, thing).map_err(|error| {
        let help = "write (1, 50) for 1:50".to_owned();
        origin.error_at(&[Field("sheet"), Field("scale")], error.to_string(), Some(help))
    })
}

fn unit_in_millimeters(file: UnitFile) -> f64 {
    match file {
        UnitFile::Metre => 1000.0,
        UnitFile::Centimetre => 10.0,
        UnitFile::Millimetre => 1.0,
        UnitFile::Inch => MILLIMETERS_PER_INCH,
        UnitFile::Foot => 12.0 * MILLIMETERS_PER_INCH,
    }
}

fn axonometric_view(file: AxonometricFile) -> Option<NamedView> {
    match file {
        AxonometricFile::None => None,
        AxonometricFile::Isometric => Some(NamedView::Isometric),
        AxonometricFile::Dimetric => Some(NamedView::Dimetric),
        AxonometricFile::Trimetric => Some(NamedView::Trimetric),
        AxonometricFile::ThreeQuarter => Some(NamedView::ThreeQuarter),
    }
}
