//! The pages of a sheet: the principal views, the assembly with balloons, the parts list, and a
//! sheet for each part.
//!
//! ```text
//!   1  front, top, side and axonometric view          Sheet::draw
//!   2  assembly, in place or exploded; balloons       assembly_view
//!      (several pages if there are many balloons)
//!   3  parts list, unless it fits on page 2           parts_table
//!   4  item 1, 5  item 2 …                            Sheet::draw, of one part
//! ```

use super::assembly_view::{AssemblyLayout, BalloonTarget};
use super::parts_table::{PartsTable, TableColumn};
use super::sheet_view::SheetView;
use super::surface_cache::SurfaceCache;
use super::view_layout::extent_of_rectangle;
use super::visible_spots::{MovedParts, VisibleSpot, add_spots_on_edges, find_visible_spots};
use super::{Sheet, SheetError, title_block};
use crate::assembly::{
    AssemblyPages, MAX_EXPLODED_PARTS, PATHS, Part, PartShapes, PartsList, PartsListItem,
    exploded_models, gather_parts, part_model,
};
use crate::{AssemblyWarning, SheetPage, SheetWarning};
use camera::NamedView;
use drawing::{Drawing, HiddenLines, LineStyle, Placement};
use glam::{DVec2, DVec3};
use hidden_line::{Aabb, EdgeSegment, WeldedSurface};
use homog::{Plane, World};
use model::{ModelInstance, model_names, world_points};
use page::palette::WHITE;
use page::{Cap, Ink, Join, Layer, LineType, PlacedImage, missing_glyphs};
use viewport::DrawingScale;

/// The parts list is placed on the assembly page if it takes at most this fraction of the height
/// above the title block.
const LIST_PART: f64 = 0.4;

/// The maximum number of balloon pages. Further pages are omitted with a warning.
const MAX_BALLOON_PAGES: usize = 20;

/// The maximum number of part sheets. Further sheets are omitted with a warning.
const MAX_PART_SHEETS: usize = 500;

/// The assembly to draw: its parts, parts list and moves.
struct DrawnAssembly<'a> {
    sheet: &'a Sheet,
    models: &'a [ModelInstance],
    parts: Vec<Part>,
    list: PartsList,
    /// The move of each part, or `None` if no part moves.
    moves: Option<Vec<DVec3>>,
    warnings: Vec<SheetWarning>,
    ink: Ink,
    title: String,
}

/// The contents of the assembly pages, before the pages are numbered.
struct DrawnView {
    images: Vec<PlacedImage>,
    layers: Vec<Layer>,
    /// The balloon layers of each page; empty if there are no balloons.
    balloons: Vec<[Layer; 2]>,
    scale: DrawingScale,
    warnings: Vec<SheetWarning>,
}

impl Sheet {
    /// Draws the sheet with the pages of the [assembly](Self::assembly), with up to `threads`
    /// threads. The number of threads does not change the pages.
    ///
    /// The first page is the one from [`draw`](Self::draw). If there are several pages, the title
    /// block shows the page number and the page count.
    ///
    /// # Errors
    /// See [`draw`](Self::draw). Also returns an error if the assembly or a part is larger than the
    /// paper at every standard scale.
    pub fn draw_pages(
        &self,
        models: &[ModelInstance],
        sections: &[Plane<World>],
        threads: usize,
    ) -> Result<Vec<SheetPage>, SheetError> {
        if !self.assembly.has_pages() {
            return Ok(vec![self.draw(models, sections, threads)?]);
        }
        let assembly = DrawnAssembly::new(self, models);
        if assembly.parts.is_empty() {
            let mut page = self.draw(models, sections, threads)?;
            page.warnings.push(SheetWarning::Assembly(AssemblyWarning::NoParts));
            return Ok(vec![page]);
        }
        // Surfaces are welded once and shared by all pages.
        let mut surfaces = SurfaceCache::new(models, &self.uncut);
        let table = PartsTable::new(self, &assembly.list);
        let options = &self.assembly;
        let most = (self.title_block_area().y() - self.drawing_area().y()) * LIST_PART;
        let beside = table.above_title_block(most);
        let beside = beside.filter(|_| options.parts_list && options.has_view());
        let view = match options.has_view() {
            true => Some(assembly.draw_view(&table, beside.as_ref(), &mut surfaces, threads)?),
            false => None,
        };
        let has_own_pages = options.parts_list && beside.is_none();
        let list_pages = if has_own_pages { table.pages() } else { Vec::new() };
        let part_sheets = if options.part_sheets { assembly.list.items.as_slice() } else { &[] };
        let part_sheets = &part_sheets[..part_sheets.len().min(MAX_PART_SHEETS)];
        // A view without balloons still needs a page.
        let view_pages = view.as_ref().map_or(0, |view| view.balloons.len().max(1));
        let total = 1 + view_pages + list_pages.len() + part_sheets.len();
        let numbered = |number: usize| self.numbered(number, total);
        let mut pages = vec![numbered(1).draw_views(models, sections, &mut surfaces, threads)?];
        pages[0].warnings.extend(assembly.warnings.iter().cloned());
        for index in 0..view_pages {
            let Some(view) = &view else { break };
            // The list is beside the view only on the view's first page.
            let list = beside.as_ref().filter(|_| index == 0).map(|column| (&table, column));
            let sheet = numbered(pages.len() + 1);
            pages.push(assembly.view_page(&sheet, view, index, list));
        }
        for columns in &list_pages {
            let mut page = assembly.empty_page();
            numbered(pages.len() + 1).add_border(&mut page, None, assembly.ink);
            page.layers.extend(table.layers(columns, assembly.ink));
            pages.push(page);
        }
        for item in part_sheets {
            let sheet = numbered(pages.len() + 1);
            pages.push(assembly.draw_part_sheet(sheet, item, threads)?);
        }
        for page in &mut pages {
            page.warnings.sort_unstable();
            page.warnings.dedup();
        }
        Ok(pages)
    }

    /// Returns the sheet as page `number` of `total`.
    fn numbered(&self, number: usize, total: usize) -> Self {
        let mut sheet = self.clone();
        let numbers = [number, total].map(|count| u32::try_from(count).unwrap_or(u32::MAX));
        sheet.title_block.sheet = (total > 1).then_some(numbers);
        sheet
    }

    /// Adds a frame and a title block, which has no scale on a page without a view.
    fn add_border(&self, page: &mut SheetPage, scale: Option<DrawingScale>, ink: Ink) {
        let block = self.title_block_area();
        // Tables and views extend to the frame, so the centering marks stop there.
        let contents = [extent_of_rectangle(self.drawing_area())];
        page.layers.extend(self.frame_layers(&contents, ink));
        let title = page.title.clone();
        page.layers.extend(title_block::title_block_layers(self, &title, scale, block, ink));
    }
}

impl<'a> DrawnAssembly<'a> {
    /// Collects the parts of models and computes their list and moves.
    fn new(sheet: &'a Sheet, models: &'a [ModelInstance]) -> Self {
        let AssemblyPages { densities, explosion, part_sheets, .. } = &sheet.assembly;
        let parts = gather_parts(models);
        let unit = sheet.millimeters_per_unit;
        let list = PartsList::from_parts(models, &parts, densities, unit);
        let mut warnings = list.warnings.clone();
        warnings.extend(unreadable_names(&list));
        let mut explosion = explosion.as_ref();
        // The time to compute an explosion is quadratic in the number of parts.
        if explosion.is_some() && parts.len() > MAX_EXPLODED_PARTS {
            warnings.push(SheetWarning::Assembly(AssemblyWarning::TooManyPartsToExplode {
                most: MAX_EXPLODED_PARTS,
            }));
            explosion = None;
        }
        if *part_sheets && list.items.len() > MAX_PART_SHEETS {
            let count = list.items.len() - MAX_PART_SHEETS;
            warnings.push(SheetWarning::Assembly(AssemblyWarning::PartSheetsLeftOut { count }));
        }
        let moves = explosion.map(|settings| settings.moves(&PartShapes::new(&parts, models)));
        let title = match sheet.title_block.title.as_str() {
            "" => model_names(models),
            title => title.to_owned(),
        };
        let ink = sheet.style.ink_of_sheet();
        Self { sheet, models, parts, list, moves, warnings, ink, title }
    }

    /// Returns an empty page.
    fn empty_page(&self) -> SheetPage {
        let (paper, color) = (self.sheet.paper, self.sheet.style.paper.unwrap_or(WHITE));
        SheetPage::new(DVec2::new(paper.width(), paper.height()), self.title.clone(), Some(color))
    }

    /// Draws the view of all parts and arranges it on its page.
    fn draw_view(
        &self,
        table: &PartsTable<'_>,
        beside: Option<&TableColumn>,
        surfaces: &mut SurfaceCache<'_>,
        threads: usize,
    ) -> Result<DrawnView, SheetError> {
        let sheet = self.sheet;
        let exploded =
            self.moves.as_ref().map(|moves| exploded_models(self.models, &self.parts, moves));
        let drawn_models = exploded.as_deref().unwrap_or(self.models);
        let name = sheet.axonometric_view.unwrap_or(NamedView::Isometric);
        let points = world_points(drawn_models);
        let view = SheetView::frame_points(&points, name, sheet.millimeters_per_unit)?;
        let count = if sheet.assembly.balloons { self.list.items.len() } else { 0 };
        let list = beside.map(|column| table.area(column));
        let layout = AssemblyLayout::arrange(sheet, &view, list, count)
            .ok_or_else(|| sheet.assembly_too_large(&view))?;
        let style = LineStyle { hidden_lines: HiddenLines::Removed, ..sheet.style };
        let mut drawing = match &exploded {
            Some(models) => {
                let corners = |part: &Part| [part.bounds.min().raw(), part.bounds.max().raw()];
                let boxes = self.parts.iter().map(|part| Aabb::from_points(corners(part)));
                let surface = WeldedSurface::new(models, &[], &[]).exploded_from(boxes);
                view.draw(&surface, &style, layout.scale, threads)?
            }
            None => view.draw(surfaces.cut_by(&[]), &style, layout.scale, threads)?,
        };
        let paths = take_paths(&mut drawing, exploded.is_some());
        let placement = view.placement(&drawing, layout.scale, layout.center);
        let prefix = if exploded.is_some() { "exploded-" } else { "assembly-" };
        let mut layers = self.path_layers(&paths, &style, placement);
        layers.extend(drawing.to_layers(&style, placement, prefix, self.ink));
        let drawn = drawing.warnings.iter().cloned();
        let mut warnings: Vec<SheetWarning> = drawn.map(SheetWarning::from).collect();
        let mut balloons = Vec::new();
        if sheet.assembly.balloons {
            let moves = self.moves.clone().unwrap_or_else(|| vec![DVec3::ZERO; self.parts.len()]);
            let moved = MovedParts { parts: &self.parts, models: self.models, moves: &moves };
            let mut spots = find_visible_spots(&moved, &view);
            // In an exploded view, object indices equal part indices.
            let object = |part: usize| match exploded {
                Some(_) => part as u32,
                None => self.parts[part].object,
            };
            add_spots_on_edges(&mut spots, &drawing, object, &view);
            let targets = self.balloon_targets(&spots, &layout, &view, &mut warnings);
            balloons = self.place_balloons(&layout, &targets, &mut warnings);
        }
        let inks = [self.ink, sheet.style.paper.unwrap_or(WHITE)];
        // Fills are drawn below the lines, so they are inserted at the start.
        layers.splice(0..0, drawing.face_fill_layers(&style, placement, prefix, inks));
        let images = drawing.face_fill_image(&style, placement, prefix).into_iter().collect();
        Ok(DrawnView { images, layers, balloons, scale: layout.scale, warnings })
    }

    /// Returns the layers with the paths of parts, as narrow chain lines.
    fn path_layers(&self, paths: &Drawing, style: &LineStyle, placement: Placement) -> Vec<Layer> {
        let mut layers = paths.to_layers(style, placement, "path-", self.ink);
        let width = self.sheet.line_width_group().narrow_width();
        for layer in &mut layers {
            "part paths".clone_into(&mut layer.title);
            layer.pen = LineType::LongDashedDotted.to_pen(width, self.ink, Cap::Butt, Join::Miter);
        }
        layers
    }

    /// Returns the items, each with the best spot for its leader among the item's parts. Warns
    /// about items that are not visible.
    fn balloon_targets(
        &self,
        spots: &[Option<VisibleSpot>],
        layout: &AssemblyLayout,
        view: &SheetView,
        warnings: &mut Vec<SheetWarning>,
    ) -> Vec<BalloonTarget<'_>> {
        let (mut targets, mut hidden) = (Vec::new(), Vec::new());
        for item in &self.list.items {
            // Parts are sorted by object.
            let number = |object: &u32| self.parts.binary_search_by_key(object, |p| p.object).ok();
            let of_item = item.objects.iter().filter_map(number).filter_map(|at| spots[at]);
            let of_item: Vec<VisibleSpot> = of_item.collect();
            match outermost_clear_spot(&of_item, view) {
                Some(spot) => {
                    targets.push(BalloonTarget { item, spot: layout.on_page(&spot, view) });
                }
                None => hidden.push(item),
            }
        }
        if let Some(first) = hidden.first() {
            let (number, part, count) = (first.number, first.name.clone(), hidden.len());
            warnings.push(SheetWarning::Assembly(AssemblyWarning::NotVisible {
                number,
                part,
                count,
            }));
        }
        targets
    }

    /// Places the balloons of all pages, as many per page as fit, and warns about balloons that do
    /// not fit.
    fn place_balloons(
        &self,
        layout: &AssemblyLayout,
        targets: &[BalloonTarget<'_>],
        warnings: &mut Vec<SheetWarning>,
    ) -> Vec<[Layer; 2]> {
        let width = self.sheet.line_width_group().narrow_width();
        // Some positions cannot be used, because a balloon there would block the leaders of others.
        let capacity = (layout.capacity() * 2 / 3).max(1);
        let page_count = targets.len().div_ceil(capacity).max(1);
        // Balloons are spread evenly over the pages, so that the last page is not almost empty.
        let each = targets.len().div_ceil(page_count).max(1);
        let mut pages = Vec::new();
        let mut left_out = Vec::new();
        for chunk in targets.chunks(each) {
            if pages.len() == MAX_BALLOON_PAGES {
                left_out.extend(chunk.iter().map(|target| target.item));
                continue;
            }
            let (layers, rest) = layout.balloon_layers(chunk, width, self.ink);
            left_out.extend(rest);
            pages.push(layers);
        }
        if let Some(first) = left_out.first() {
            let (number, count) = (first.number, left_out.len());
            warnings
                .push(SheetWarning::Assembly(AssemblyWarning::BalloonsLeftOut { number, count }));
        }
        pages
    }

    /// Returns an assembly page with its view, its balloons, and the list if it is on this page.
    fn view_page(
        &self,
        sheet: &Sheet,
        view: &DrawnView,
        index: usize,
        list: Option<(&PartsTable<'_>, &TableColumn)>,
    ) -> SheetPage {
        let mut page = self.empty_page();
        page.images.clone_from(&view.images);
        page.layers.clone_from(&view.layers);
        page.layers.extend(view.balloons.get(index).into_iter().flatten().cloned());
        if let Some((table, column)) = list {
            page.layers.extend(table.layers(core::slice::from_ref(column), self.ink));
        }
        page.warnings.clone_from(&view.warnings);
        sheet.add_border(&mut page, Some(view.scale), self.ink);
        page
    }

    /// Draws the sheet of one item, with its principal views and its name as the title.
    fn draw_part_sheet(
        &self,
        mut sheet: Sheet,
        item: &PartsListItem,
        threads: usize,
    ) -> Result<SheetPage, SheetError> {
        let part = item
            .objects
            .first()
            .and_then(|object| self.parts.iter().find(|part| part.object == *object));
        let Some(part) = part else { return Err(SheetError::Empty) };
        sheet.title_block.title.clone_from(&item.name);
        let number = &mut sheet.title_block.number;
        *number = match number.as_str() {
            "" => item.number.to_string(),
            number => format!("{number}-{}", item.number),
        };
        sheet.scale = None;
        // The requested views, overlays and dimensions belong to the whole assembly.
        sheet.views.clear();
        sheet.overlays.clear();
        sheet.measures.clear();
        sheet.draw(&[part_model(part, self.models)], &[], threads)
    }
}

impl Sheet {
    /// Returns the error for an assembly that does not fit at any standard scale.
    fn assembly_too_large(&self, view: &SheetView) -> SheetError {
        let scale = DrawingScale::STANDARD[DrawingScale::STANDARD.len() - 1];
        let area = self.drawing_area();
        SheetError::TooLarge {
            paper: self.paper_name.clone(),
            scale,
            need: (view.size * scale.ratio()).to_array(),
            available: [area.width(), self.title_block_area().y() - area.y()],
            remedy: "; use larger paper, or set the unit of the model".to_owned(),
        }
    }
}

/// Returns the spot where the leader for identical parts ends. Among the spots with at least 60% of
/// the largest clearance, it is the one closest to the border of the view.
fn outermost_clear_spot(spots: &[VisibleSpot], view: &SheetView) -> Option<VisibleSpot> {
    let clearest = spots.iter().map(|spot| spot.clearance).fold(0.0, f64::max);
    let clear = spots.iter().filter(|spot| spot.clearance >= 0.6 * clearest).copied();
    let outward = |spot: &VisibleSpot| (spot.at / view.size.max(DVec2::splat(1e-300))).abs();
    let farther = |a: VisibleSpot, b: VisibleSpot| {
        if outward(&b).max_element() > outward(&a).max_element() { b } else { a }
    };
    clear.reduce(farther)
}

/// Removes the paths of the parts, which are the last object, from a drawing and returns them.
fn take_paths(drawing: &mut Drawing, is_exploded: bool) -> Drawing {
    let last = drawing.objects.len().wrapping_sub(1) as u32;
    let has_paths = is_exploded && drawing.objects.last().is_some_and(|name| name == PATHS);
    let is_path = |segment: &EdgeSegment| has_paths && segment.object == last;
    let (paths, lines) = drawing.segments.iter().copied().partition(is_path);
    drawing.segments = lines;
    Drawing {
        size: drawing.size,
        objects: drawing.objects.clone(),
        segments: paths,
        ..Drawing::default()
    }
}

/// Returns the warning about names in the list with characters missing from the font, or `None` if
/// there are no such names.
fn unreadable_names(list: &PartsList) -> Option<SheetWarning> {
    let is_unreadable = |text: &str| !missing_glyphs(text).is_empty();
    let mut names = list
        .items
        .iter()
        .flat_map(|item| [&item.name, &item.material])
        .filter(|text| is_unreadable(text));
    let name = names.next()?.clone();
    let count = 1 + names.count();
    Some(SheetWarning::Assembly(AssemblyWarning::NamesUnreadable { name, count }))
}
