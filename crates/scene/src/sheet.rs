//! Resolution of the drawing sheet: paper, arrangement, scale and title block.

use super::assembly::resolve_assembly;
use super::dimensions::resolve_dimensions;
use super::sheet_scale::{SCALE_PATH, resolve_scale};
use super::sheet_views::resolve_sheet_views;
use super::style::resolve_iso_group;
use super::surrounding_light::read_image_bytes;
use super::{Origin, Scene, Style};
use camera::NamedView;
use drawing::{LineStyle, LineWidths, Overlay};
use homog::{Plane, World};
use model::{LengthUnit, ModelInstance};
use scene_file::PathStep::Field;
use scene_file::SceneError;
use scene_file::file::{AxonometricView, PageOrientation, PaperSize, SheetFile, SideView};
use sheet::{DimensionUnit, NumberFormat, Sheet, TitleBlockTemplate, TitleBlockText};
use std::path::PathBuf;
use viewport::Paper;

/// The content of a drawing sheet, and the scene's settings that affect the sheet.
#[derive(Clone, Copy, Debug)]
pub struct SheetContent<'a> {
    /// The models.
    pub models: &'a [ModelInstance],
    /// The section planes.
    pub sections: &'a [Plane<World>],
    /// The objects that the section planes do not cut.
    pub uncut: &'a [u32],
    /// The line style of the scene, if it is a line drawing.
    pub style: Option<LineStyle>,
    /// The overlays of the scene.
    pub overlays: &'a [Overlay],
    /// The folders, in addition to the scene's folder, that may contain the custom title block.
    pub allowed_folders: &'a [PathBuf],
}

impl<'a> SheetContent<'a> {
    /// Returns the content of a resolved scene; a custom title block must be in the scene's folder.
    #[must_use]
    pub fn from_scene(scene: &'a Scene) -> Self {
        Self {
            models: &scene.models,
            sections: &scene.sections,
            uncut: &scene.uncut,
            style: if let Style::Lines(style) = scene.style { Some(style) } else { None },
            overlays: &scene.overlays,
            allowed_folders: &[],
        }
    }
}

/// Resolves the drawing sheet of a scene file that has this content.
///
/// Edges, crease angle, hidden lines, fill, color and depth cue come from the scene's line style,
/// and so do line widths in millimeters; the sheet's settings take precedence. If no orientation is
/// set, the paper is turned to give the largest scale. If no size is set, the paper is the smallest
/// that is large enough (see [`Sheet::smallest_of`]).
///
/// ```
/// use import::MemoryFolder;
/// use scene_file::file::{ModelFile, SheetFile};
/// use scene::{SheetContent, resolve_sheet};
/// use scene::{Origin, Scene};
/// use scene_file::SceneFile;
///
/// let file = SceneFile {
///     sheet: Some(SheetFile::default()),
///     ..SceneFile::new([ModelFile::new("wedge.obj")])
/// };
/// let mut folder = MemoryFolder::default();
/// let wedge = b"v 0 0 0\nv 3 0 0\nv 0 2 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
/// folder.insert("wedge.obj", wedge.to_vec());
/// // Errors point into this text. Use `Origin::from_text` for files on disk.
/// let origin = Origin::from_text_in_memory("wedge.ron", file.to_ron()?, folder);
/// let scene = Scene::resolve(&origin, &file, &Default::default())?;
///
/// let content = SheetContent::from_scene(&scene);
/// let sheet = resolve_sheet(&origin, &file.sheet.unwrap_or_default(), content)?;
/// let page = sheet.draw(&scene.models, &scene.sections, 1)?;
/// assert!(page.to_svg().contains("wedge"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Returns an error that points into the file, for example if the scale contains a 0, the models
/// have different units, or a dimension refers to a missing part.
pub fn resolve_sheet(
    origin: &Origin,
    file: &SheetFile,
    content: SheetContent<'_>,
) -> Result<Sheet, SceneError> {
    let sizes: &[PaperSize] = match &file.paper {
        PaperSize::Auto => &SERIES_A,
        size => core::slice::from_ref(size),
    };
    let (dimensions, measures) = resolve_dimensions(origin, file, content.models)?;
    let sheets = sizes.iter().map(|size| {
        let sheet = resolve_sheet_on(origin, file, *size, content)?;
        Ok(Sheet { dimensions, measures: measures.clone(), ..sheet })
    });
    let turns = file.orientation.is_none();
    let sheets = sheets.collect::<Result<_, _>>()?;
    let chosen = Sheet::smallest_of(sheets, turns, content.models, content.sections);
    chosen.ok_or_else(|| origin.error_at(&[Field("sheet")], "there is no paper size", None))
}

/// Returns the paper sizes to choose from, smallest first.
const SERIES_A: [PaperSize; 5] =
    [PaperSize::A4, PaperSize::A3, PaperSize::A2, PaperSize::A1, PaperSize::A0];

/// Returns the sheet on paper of this size, in the file's orientation or the default one.
fn resolve_sheet_on(
    origin: &Origin,
    file: &SheetFile,
    size: PaperSize,
    content: SheetContent<'_>,
) -> Result<Sheet, SceneError> {
    let (paper, name) = resolve_paper(file, size);
    let default_sheet = Sheet::for_paper(paper, name);
    let side_view = file.side_view.map(|side| match side {
        SideView::Left => NamedView::Left,
        SideView::Right => NamedView::Right,
    });
    let own = content.style.unwrap_or(default_sheet.style);
    let widths = match (file.width, own.line_widths) {
        (Some(width), _) => {
            let group = resolve_iso_group(origin, width, &[Field("sheet"), Field("width")])?;
            LineWidths::Iso(group)
        }
        // Pixels do not determine a width on paper.
        (None, LineWidths::Pixels(_)) => default_sheet.style.line_widths,
        (None, widths) => widths,
    };
    let hidden_lines = file.hidden.unwrap_or(own.hidden_lines);
    let face_fill = file.face_fill.unwrap_or(own.face_fill);
    let unit = resolve_unit(origin, file, content.models)?;
    Ok(Sheet {
        projection_angle: file.projection_angle,
        side_view,
        style: LineStyle { hidden_lines, line_widths: widths, face_fill, ..own },
        scale: file.scale.map(|scale| resolve_scale(origin, scale, &SCALE_PATH)).transpose()?,
        millimeters_per_unit: unit.in_millimeters(),
        dimension_unit: file.dimension_unit.unwrap_or(match unit {
            LengthUnit::Inch | LengthUnit::Foot => DimensionUnit::Inch,
            _ => DimensionUnit::Millimeter,
        }),
        axonometric_view: axonometric_view(file.axonometric_view),
        center_lines: file.center_lines,
        symmetry_lines: file.symmetry_lines,
        title_block: resolve_title_block(origin, file)?,
        assembly: resolve_assembly(origin, file, content.models)?,
        views: resolve_sheet_views(origin, file)?,
        frame: file.frame,
        numbers: resolve_numbers(origin, file)?,
        title_block_template: resolve_template(origin, file, content.allowed_folders)?,
        uncut: content.uncut.to_vec(),
        overlays: content.overlays.to_vec(),
        ..default_sheet
    })
}

/// Resolves the text of the title block; the sheet number must not exceed the number of sheets.
fn resolve_title_block(origin: &Origin, file: &SheetFile) -> Result<TitleBlockText, SceneError> {
    if let Some((number, count)) =
        file.sheet_number.filter(|(number, count)| !(1..=*count).contains(number))
    {
        let message = format!("invalid sheet number: {number} of {count}");
        let help = "write (2, 5) for the second of five sheets".to_owned();
        return Err(origin.error_at(&[Field("sheet"), Field("sheet_number")], message, Some(help)));
    }
    Ok(TitleBlockText {
        title: file.title.clone(),
        author: file.author.clone(),
        date: file.date.clone(),
        number: file.number.clone(),
        supplementary_title: file.supplementary_title.clone(),
        owner: file.owner.clone(),
        document_type: file.document_type.clone(),
        approved_by: file.approved_by.clone(),
        revision: file.revision.clone(),
        sheet: file.sheet_number.map(|(number, count)| [number, count]),
        language: file.language,
    })
}

/// Reads the custom title block, which must be inside the scene's folder or an `allowed` folder.
fn resolve_template(
    origin: &Origin,
    file: &SheetFile,
    allowed: &[PathBuf],
) -> Result<Option<TitleBlockTemplate>, SceneError> {
    let Some(path) = &file.title_block else { return Ok(None) };
    let at = [Field("sheet"), Field("title_block")];
    let bytes = read_image_bytes(origin, &at, path, allowed)?;
    let text = String::from_utf8(bytes).map_err(|_| {
        origin.error_at(&at, format!("{path} is not an SVG file: it is not UTF-8 text"), None)
    })?;
    let template = TitleBlockTemplate::parse(&text);
    template.map(Some).map_err(|error| origin.error_at(&at, format!("{path}, {error}"), None))
}

/// Resolves the number format.
fn resolve_numbers(origin: &Origin, file: &SheetFile) -> Result<NumberFormat, SceneError> {
    let most = NumberFormat::MAX_DECIMALS;
    let fault = |decimals: u32| {
        let message = format!("too many decimal places: {decimals}; at most {most} are allowed");
        origin.error_at(&[Field("sheet"), Field("decimals")], message, None)
    };
    let decimals = match file.decimals {
        Some(decimals) => {
            let own = u8::try_from(decimals).ok().filter(|own| *own <= most);
            Some(own.ok_or_else(|| fault(decimals))?)
        }
        None => None,
    };
    Ok(NumberFormat { decimals, decimal_mark: file.decimal_mark })
}

/// Returns the paper in its orientation, and the name of its size.
fn resolve_paper(file: &SheetFile, size: PaperSize) -> (Paper, &'static str) {
    let (paper, name) = match size {
        PaperSize::A0 => (Paper::A0, "A0"),
        PaperSize::A1 => (Paper::A1, "A1"),
        PaperSize::A2 => (Paper::A2, "A2"),
        PaperSize::A3 => (Paper::A3, "A3"),
        PaperSize::A4 | PaperSize::Auto => (Paper::A4, "A4"),
        PaperSize::A5 => (Paper::A5, "A5"),
        PaperSize::Letter => (Paper::LETTER, "Letter"),
        PaperSize::Tabloid => (Paper::TABLOID, "Tabloid"),
    };
    let is_portrait = match file.orientation {
        Some(orientation) => orientation == PageOrientation::Portrait,
        None => matches!(size, PaperSize::A4 | PaperSize::A5 | PaperSize::Letter),
    };
    (if is_portrait { paper } else { paper.rotated() }, name)
}

/// Returns the unit of the models: the sheet's unit or else the unit that all models share.
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
    let help = "set the unit of the sheet: unit: Millimeter".to_owned();
    Err(origin.error_at(&[Field("sheet")], message, Some(help)))
}

/// Returns the direction of the fourth view, or `None` without a fourth view.
fn axonometric_view(file: AxonometricView) -> Option<NamedView> {
    match file {
        AxonometricView::None => None,
        AxonometricView::Isometric => Some(NamedView::Isometric),
        AxonometricView::Dimetric => Some(NamedView::Dimetric),
        AxonometricView::Trimetric => Some(NamedView::Trimetric),
        AxonometricView::ThreeQuarter => Some(NamedView::ThreeQuarter),
    }
}
