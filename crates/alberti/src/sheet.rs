//! `alberti sheet`: orthographic views of a scene or a model on paper, to scale.
//!
//! The pages are vector drawings; a PNG is a rasterization of such a page. If the scene file has no
//! sheet, or if the input is a bare model, all fields have their defaults.

mod assembly;
mod page_files;
mod parts_list_json;

use super::CliError;
use super::format::{DEFAULT_QUALITY, DxfArgs, OutputFormat, image_warning};
use super::load_options::LoadArgs;
use super::messages::{print_message, print_note, print_warnings};
use super::model_state::ModelStateArgs;
use super::options::option_parser;
use super::progress::Progress;
use super::render::{open_input, thread_count};
use super::section::SectionArgs;
use assembly::AssemblyArgs;
use drawing::{FaceFill, HiddenLines};
use import::{ImageLoading, ImportOptions};
use page::{DxfOptions, Page};
use page_files::{PageNames, write_all};
use pipeline::{Origin, Picture, Scene};
use projection::SheetAngle;
use scene::{ResolveOptions, SheetContent, Style};
use scene_file::file::{AxonometricView, DimensionsFile, PageOrientation, PaperSize, SheetFile};
use sheet::{DecimalMark, DimensionUnit, SheetFrame, SheetPage, SheetWarning, TitleBlockLanguage};
use std::path::PathBuf;
use viewport::{Paper, Resolution};

/// The resolution of pages written as PNG, in dots per inch.
///
/// An A4 page then has 1240 × 1754 pixels, is legible on a screen, and takes less than a megabyte.
pub(super) const DEFAULT_DPI: u32 = 150;

/// Arguments of `alberti sheet`; each flag replaces the field of the scene's `sheet`.
#[derive(Debug, clap::Args)]
pub(crate) struct SheetArgs {
    /// Scene (.ron) or model (.gltf, .glb, .stl, .obj, .ply, .3mf)
    input: PathBuf,
    /// Output file (.pdf, .svg, .dxf or .png) [default: the input's name with .pdf, in the current
    /// folder]
    ///
    /// A PDF holds all pages. Other formats get one file per page: out.svg becomes out-1.svg,
    /// out-2.svg and so on; {page} in a name is the page number.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Paper size [default: a3]
    #[arg(long, value_name = "SIZE", value_parser = option_parser::<PaperSize>())]
    paper: Option<PaperSize>,
    /// Page orientation [default: whichever makes the views larger]
    #[arg(long, value_parser = option_parser::<PageOrientation>())]
    orientation: Option<PageOrientation>,
    /// First-angle or third-angle arrangement of the views (ISO 5456-2) [default: first]
    #[arg(long, value_parser = option_parser::<SheetAngle>())]
    projection_angle: Option<SheetAngle>,
    /// Scale, paper to model, such as 1:50 [default: the largest standard scale that fits]
    #[arg(long, value_name = "N:M", value_parser = parse_scale)]
    scale: Option<(u32, u32)>,
    /// Axonometric view in addition to the three principal views [default: isometric]
    #[arg(long, value_name = "VIEW", value_parser = option_parser::<AxonometricView>())]
    axonometric: Option<AxonometricView>,
    /// Hidden lines in uncut views along the axes [default: as in the scene's line style, else
    /// dashed]
    #[arg(long, value_parser = option_parser::<HiddenLines>())]
    hidden_lines: Option<HiddenLines>,
    /// Fill of the faces under the lines; grays or hatching distinguish parts [default: as in the
    /// scene's line style, else none]
    #[arg(long, value_name = "FILL", value_parser = option_parser::<FaceFill>())]
    face_fill: Option<FaceFill>,
    /// Omit all dimensions
    #[arg(long)]
    no_dimensions: bool,
    /// Title in the title block [default: the model names]
    #[arg(long)]
    title: Option<String>,
    /// Author in the title block
    #[arg(long)]
    author: Option<String>,
    /// Date in the title block, as it should be printed
    #[arg(long)]
    date: Option<String>,
    /// Drawing number in the title block
    #[arg(long)]
    number: Option<String>,
    /// Language of the names in the title block [default: english]
    #[arg(long, value_parser = option_parser::<TitleBlockLanguage>())]
    language: Option<TitleBlockLanguage>,
    /// Border around the drawing area [default: plain]
    #[arg(long, value_parser = option_parser::<SheetFrame>())]
    frame: Option<SheetFrame>,
    /// Unit for lengths [default: in if the model is in inches or feet, else mm]
    #[arg(long, value_name = "UNIT", value_parser = option_parser::<DimensionUnit>())]
    dimension_unit: Option<DimensionUnit>,
    /// Maximum number of decimals in lengths [default: 2 in millimeters, 3 in inches]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=6))]
    decimals: Option<u32>,
    /// Decimal separator [default: point]
    #[arg(long, value_parser = option_parser::<DecimalMark>())]
    decimal_mark: Option<DecimalMark>,
    /// Resolution of a PNG in dpi, from 10 to 1200 [default: 150]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(10..=1200))]
    dpi: Option<u32>,
    /// Report how much of the drawing area the views fill, and why the scale is not larger
    #[arg(long)]
    explain_scale: bool,
    #[command(flatten)]
    assembly: AssemblyArgs,
    #[command(flatten)]
    dxf: DxfArgs,
    #[command(flatten)]
    section: SectionArgs,
    #[command(flatten)]
    model_state: ModelStateArgs,
    /// Number of threads; does not change the sheet [default: one per core]
    #[arg(long, value_name = "N", value_parser = crate::options::parse_thread_count)]
    threads: Option<u16>,
    #[command(flatten)]
    load_options: LoadArgs,
}

/// Draws the sheet and writes it.
///
/// The output's extension is checked before the model is loaded.
///
/// # Errors
/// Returns an error if the input is invalid, if the views do not fit the paper at the requested
/// scale, or if writing the output fails.
pub(crate) fn run(args: &SheetArgs) -> Result<(), CliError> {
    let output = args.output.clone().map_or_else(|| default_output(args), Ok)?;
    let format = OutputFormat::from_path(&output)?;
    let names = PageNames::parse(&args.input, &output, format)?;
    let progress = Progress::start("loading");
    let (origin, mut file) = open_input(&args.input, &args.load_options.import_options())?;
    file.models.iter_mut().for_each(|model| args.model_state.apply_to(model));
    args.section.append_to(&mut file);
    // The sheet has its own views, so the scene's camera is ignored even if it is invalid.
    file.camera = scene_file::file::CameraFile::default();
    let mut sheet_file = file.sheet.take().unwrap_or_default();
    apply_overrides(&mut sheet_file, args);
    // Line drawings have no textures.
    let import =
        ImportOptions { images: ImageLoading::Headers, ..args.load_options.import_options() };
    let options = ResolveOptions::with_import(import);
    let scene = Scene::resolve(&origin, &file, &options)?;
    let allowed_folders = &*options.import.allow_outside;
    let content = SheetContent { allowed_folders, ..SheetContent::from_scene(&scene) };
    let mut sheet = scene::resolve_sheet(&origin, &sheet_file, content)
        .map_err(pipeline::ResolveError::from)?;
    if let Some(degrees) = args.load_options.crease {
        (sheet.style.crease_angle, sheet.style.asks_normals) = (degrees.to_radians(), false);
    }
    progress.enter_stage("drawing");
    let pages = sheet
        .draw_pages(&scene.models, &scene.sections, thread_count(args.threads))
        .map_err(|error| sheet_error(&origin, error))?;
    progress.enter_stage("writing");
    let mut warnings = warnings_of_pages(&pages);
    if !matches!(scene.style, Style::Lines(_) | Style::Shaded) {
        warnings.push(SheetWarning::StyleIgnored);
    }
    let lost_images = pages.iter().find_map(|page| image_warning(format, page));
    warnings.extend(lost_images.map(SheetWarning::from));
    let dpi = args.dpi.unwrap_or(DEFAULT_DPI);
    let encode = |page: &SheetPage| match format {
        format if format.is_raster() => {
            format.encode_picture(&rasterize_page(page, dpi)?, DEFAULT_QUALITY)
        }
        OutputFormat::Dxf => Ok(page.to_dxf(&args.dxf.apply_to(DxfOptions::on_paper(page)))),
        _ => Ok(format.encode_pages(std::slice::from_ref(page))),
    };
    let mut files = match format {
        OutputFormat::Pdf => vec![(output, format.encode_pages(&pages))],
        _ => names.files(&pages, encode)?,
    };
    files.extend(args.assembly.list_file(&sheet, &scene.models));
    write_all(&files)?;
    drop(progress);
    if args.explain_scale {
        print_note(&sheet.fill(&scene.models, &scene.sections)?.to_string());
    }
    print_warnings(&scene, &warnings, true);
    warn_of_unused_dpi(args, format);
    Ok(())
}

/// Warns about a resolution for an output without pixels.
fn warn_of_unused_dpi(args: &SheetArgs, format: OutputFormat) {
    if args.dpi.is_some() && !format.is_raster() {
        let message = "--dpi does nothing here: it applies only to PNG; write a .png to use it";
        print_message("warning", message);
    }
}

/// Returns the error for a sheet that cannot be drawn, with its position in the scene file.
fn sheet_error(origin: &Origin, error: sheet::SheetError) -> CliError {
    match scene::sheet_view_error(origin, &error) {
        Some(mistake) => CliError::Scene(mistake),
        None => CliError::Sheet(error),
    }
}

/// Returns the warnings about all pages, without duplicates.
fn warnings_of_pages(pages: &[SheetPage]) -> Vec<SheetWarning> {
    let all = pages.iter().flat_map(|page| &page.warnings);
    let mut warnings: Vec<SheetWarning> = all.cloned().collect();
    warnings.sort_unstable();
    warnings.dedup();
    warnings
}

/// Returns the input's name with the extension `.pdf`, in the current folder.
///
/// # Errors
/// Returns an error if the input's path has no file name, such as `..`.
fn default_output(args: &SheetArgs) -> Result<PathBuf, CliError> {
    let stem = args.input.file_stem();
    let stem = stem.ok_or_else(|| CliError::Usage("name the output with -o FILE".to_owned()))?;
    Ok(PathBuf::from(stem).with_extension("pdf"))
}

/// Rasterizes a page at a resolution in dots per inch.
///
/// Other commands with pages call it with [`DEFAULT_DPI`]. The resolution must not depend on the
/// display: output is the same on every machine.
pub(super) fn rasterize_page<W>(page: &Page<W>, dpi: u32) -> Result<Picture, CliError> {
    let size = || {
        let paper = Paper::new(page.size.x, page.size.y).ok()?;
        let [width, height] = paper.pixel_size(Resolution::dots_per_inch(dpi.into()).ok()?)?;
        page.to_picture(width, height)
    };
    size().ok_or_else(|| {
        let message =
            format!("the paper is too large for a picture at {dpi} dpi; write a .pdf instead");
        CliError::Usage(message)
    })
}

/// Replaces the fields of the scene's sheet with the values of the flags.
///
/// `--no-dimensions` can only turn dimensions off; no flag turns them on again.
fn apply_overrides(sheet: &mut SheetFile, args: &SheetArgs) {
    args.paper.into_iter().for_each(|paper| sheet.paper = paper);
    args.orientation.into_iter().for_each(|orientation| sheet.orientation = Some(orientation));
    args.projection_angle.into_iter().for_each(|angle| sheet.projection_angle = angle);
    sheet.unit = args.load_options.unit.or(sheet.unit);
    args.axonometric.into_iter().for_each(|view| sheet.axonometric_view = view);
    args.hidden_lines.into_iter().for_each(|hidden| sheet.hidden = Some(hidden));
    sheet.face_fill = args.face_fill.or(sheet.face_fill);
    sheet.scale = args.scale.or(sheet.scale);
    if args.no_dimensions {
        sheet.dimensions = DimensionsFile::none();
    }
    args.assembly.apply_to(sheet);
    args.language.into_iter().for_each(|language| sheet.language = language);
    args.frame.into_iter().for_each(|frame| sheet.frame = frame);
    sheet.dimension_unit = args.dimension_unit.or(sheet.dimension_unit);
    sheet.decimals = args.decimals.or(sheet.decimals);
    args.decimal_mark.into_iter().for_each(|mark| sheet.decimal_mark = mark);
    let texts = [
        (&mut sheet.title, &args.title),
        (&mut sheet.author, &args.author),
        (&mut sheet.date, &args.date),
        (&mut sheet.number, &args.number),
    ];
    for (field, text) in texts {
        text.iter().for_each(|text| field.clone_from(text));
    }
}

/// Parses `PAPER:MODEL`, two whole numbers above 0.
///
/// The first number is the length on paper: `1:50` reduces, `2:1` enlarges.
fn parse_scale(text: &str) -> Result<(u32, u32), String> {
    let fault = || "expected PAPER:MODEL, such as 1:50 or 2:1".to_owned();
    let (paper, model) = text.split_once(':').ok_or_else(fault)?;
    let number = |digits: &str| digits.trim().parse().ok().filter(|n| *n > 0).ok_or_else(fault);
    Ok((number(paper)?, number(model)?))
}
