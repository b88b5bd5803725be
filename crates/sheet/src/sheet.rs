//! Drawing sheets: orthographic views on paper, to scale, with a title block and dimensions.
//!
//! ```text
//!   first angle                              third angle
//!   ┌──────────────────────────────┐         ┌──────────────────────────────┐
//!   │  ├─────────┤     ├───┤       │         │   ┌───────┐      ╱╲          │
//!   │ ┬┌───────┐       ┌───┐       │         │   │  top  │     ╱  ╲  iso    │
//!   │ ││ front │       │left       │         │   └───────┘     ╲  ╱         │
//!   │ ┴└───────┘       └───┘       │         │ ┬┌───────┐      ┌─────┐      │
//!   │  ┌───────┐        ╱╲         │         │ ││ front │      │right│      │
//!   │  │  top  │       ╱  ╲ iso    │         │ ┴└───────┘      └─────┘      │
//!   │  └───────┘       ╲  ╱        │         │  ├───────┤      ├─────┤      │
//!   │ 0──1──2 m       ┌────────────┤         │ 0──1──2 m       ┌────────────┤
//!   └─────────────────┴────────────┘         └─────────────────┴────────────┘
//! ```
//!
//! Views are aligned: views in one row have the same height, and views in one column have the same
//! width (ISO 5456-2). The scale is a standard scale (ISO 5455). The frame and title block follow
//! ISO 5457 and ISO 7200, and dimensions follow ISO 129-1.

mod angle_dimension;
mod annotation;
mod assembly_view;
mod balloon_ring;
mod center_line;
mod circle_dimension;
mod collision;
mod composition;
mod dimension;
mod dimension_board;
mod frame;
mod frame_zones;
mod free_area;
mod freehand;
mod length_dimension;
mod length_format;
mod measure;
mod overlay_marks;
mod pages;
mod paper_choice;
mod parts_table;
mod projection_symbol;
mod requested_layout;
mod requested_views;
mod scale_bar;
mod section_line;
mod sheet_fill;
mod sheet_view;
mod stepped_line;
mod surface_cache;
mod symmetry_lines;
mod title_block;
mod title_block_fields;
mod title_block_language;
mod title_block_template;
mod view_grid;
mod view_layout;
mod view_mark;
mod view_measures;
mod view_plan;
mod view_request;
mod visible_spots;

use crate::assembly::AssemblyPages;
use crate::{DimensionFault, SheetPage, SheetWarning};
use annotation::{AnnotationLayer, Extent};
use camera::NamedView;
use composition::ComposedDrawing;
use drawing::{
    FaceFill, HiddenLines, LineStyle, LineWidths, Overlay, Placement, missing_glyph_warning,
};
pub use frame_zones::SheetFrame;
use glam::DVec2;
use hidden_line::DrawError;
use homog::{Plane, World};
use length_format::LengthFormat;
pub use length_format::{DecimalMark, DimensionUnit, NumberFormat};
pub use measure::{Dimension, DimensionSide, LengthDirection, Measure};
use model::{ModelInstance, model_names};
use page::palette::WHITE;
use page::{Group, Ink, IsoLineGroup, Layer, Pen, Polyline};
use projection::SheetAngle;
pub use sheet_fill::{ScaleLimit, SheetFill};
use surface_cache::SurfaceCache;
pub use title_block_fields::TitleBlockText;
pub use title_block_language::TitleBlockLanguage;
pub use title_block_template::{TemplateError, TitleBlockTemplate};
use view_layout::{PlacedView, ViewLayout};
use view_plan::ViewPlan;
pub use view_request::{ViewPlace, ViewRequest, ViewSide};
use viewport::{DrawingScale, Paper, Rectangle};

/// A drawing sheet: which views it shows, and how they look.
///
/// ```
/// use sheet::{Sheet, TitleBlockText};
/// use viewport::Paper;
///
/// let sheet = Sheet {
///     title_block: TitleBlockText { author: "L. B. Alberti".to_owned(), ..Default::default() },
///     ..Sheet::for_paper(Paper::A4, "A4")
/// };
/// assert!(sheet.dimensions && sheet.scale.is_none());
/// // Without models there is nothing to draw.
/// let error = sheet.draw(&[], &[], 1).expect_err("no models");
/// assert!(error.to_string().contains("nothing to draw"));
/// ```
#[derive(Clone, PartialEq, Debug)]
pub struct Sheet {
    /// The paper, including its orientation.
    pub paper: Paper,
    /// The name of the paper, such as A3.
    pub paper_name: String,
    /// First-angle or third-angle projection, which determines the layout of the views.
    pub projection_angle: SheetAngle,
    /// The scale, or `None` for the largest standard scale that fits.
    pub scale: Option<DrawingScale>,
    /// Millimeters per scene unit.
    pub millimeters_per_unit: f64,
    /// The unit of the dimensions and the scale bar.
    pub dimension_unit: DimensionUnit,
    /// The view beside the front view. `None` means the left view in first-angle projection and the
    /// right view in third-angle projection, or the opposite view if only that one faces a section
    /// plane.
    pub side_view: Option<NamedView>,
    /// The axonometric view, placed in free space on the sheet, or `None` to omit it.
    pub axonometric_view: Option<NamedView>,
    /// The line style of the views.
    pub style: LineStyle,
    /// Whether to draw overall dimensions.
    pub dimensions: bool,
    /// Additional dimensions, numbered in this order.
    pub measures: Vec<Dimension>,
    /// Whether to draw center lines of circles and the axes of round parts.
    pub center_lines: bool,
    /// Whether to draw lines of symmetry. A view has one if it sees a symmetry plane of the models
    /// edge-on, as a vertical or horizontal line.
    ///
    /// The models count as symmetric if reflected vertices are on faces and reflected edges are on
    /// edges, within 1/20,000 of the models' diagonal.
    pub symmetry_lines: bool,
    /// The objects that section planes do not cut, as indices among all instances of meshes.
    pub uncut: Vec<u32>,
    /// The text of the title block.
    pub title_block: TitleBlockText,
    /// The pages that show the models as an assembly of parts; see
    /// [`draw_pages`](Self::draw_pages).
    pub assembly: AssemblyPages,
    /// Requests that add or replace views, or that cut or break them locally.
    pub views: Vec<ViewRequest>,
    /// The border around the drawing area.
    pub frame: SheetFrame,
    /// The number format of the dimensions and the scale bar.
    pub numbers: NumberFormat,
    /// A custom title block, or `None` for the default one.
    pub title_block_template: Option<TitleBlockTemplate>,
    /// Point labels and world axes, drawn on the first page in every view that shows the whole
    /// object. Other overlays cause a warning.
    pub overlays: Vec<Overlay>,
}

/// The reason why a sheet cannot be drawn.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SheetError {
    /// A view cannot be drawn.
    #[error(transparent)]
    Draw(#[from] DrawError),
    /// The models have no points, lines or triangles.
    #[error("there is nothing to draw: the models have no points, lines or triangles")]
    Empty,
    /// A view has no valid camera or projection.
    #[error("the {view} view cannot be drawn: {reason}")]
    View {
        /// The name of the view.
        view: String,
        /// The reason.
        reason: String,
    },
    /// A view cannot be drawn as requested.
    #[error("view {number} of the sheet, the {view}: {reason}")]
    Request {
        /// The number of the request, from 1.
        number: usize,
        /// The name of the view.
        view: String,
        /// The reason.
        reason: String,
    },
    /// A view extends beyond the frame at the requested position.
    #[error(
        "view {number} of the sheet, the {view}, extends beyond the frame at this position: its \
         center must be {:.0} to {:.0} mm from the left and {:.0} to {:.0} mm from the top",
        x[0], x[1], y[0], y[1]
    )]
    Outside {
        /// The number of the request, from 1.
        number: usize,
        /// The name of the view.
        view: String,
        /// The minimum and maximum distance of the view's center from the left, in millimeters.
        x: [f64; 2],
        /// The minimum and maximum distance of the view's center from the top, in millimeters.
        y: [f64; 2],
    },
    #[error(
        "the views do not fit on {paper} at {scale}: they need {} x {} mm, but {:.0} x {:.0} mm are available{remedy}",
        in_few_digits(need[0]), in_few_digits(need[1]), available[0], available[1]
    )]
    /// The views are too large for the paper.
    TooLarge {
        /// The name of the paper.
        paper: String,
        /// The scale.
        scale: DrawingScale,
        /// The width and height of the views at this scale, in millimeters.
        need: [f64; 2],
        /// The available width and height, in millimeters.
        available: [f64; 2],
        /// The end of the message, which suggests a change that would make the views fit.
        remedy: String,
    },
}

/// The size, in millimeters on paper, that at least one view must have to be readable.
const LEAST_DRAWING: f64 = 1.0;

/// Returns a length in whole units, or with an exponent if it has more than six digits.
fn in_few_digits(length: f64) -> String {
    if length < 1e6 { format!("{length:.0}") } else { format!("{length:.2e}") }
}

impl Sheet {
    /// Returns a technical drawing on the given paper, in first-angle projection, with a left view,
    /// an isometric view and overall dimensions.
    ///
    /// The line group grows with the paper: 0.35 mm up to A5, 0.5 mm up to A2, then 0.7 mm.
    #[must_use]
    pub fn for_paper(paper: Paper, paper_name: impl Into<String>) -> Self {
        let group = match paper.width().max(paper.height()) {
            side if side > 650.0 => IsoLineGroup::MM_0_7,
            side if side < 250.0 => IsoLineGroup::MM_0_35,
            _ => IsoLineGroup::MM_0_5,
        };
        Self {
            paper,
            paper_name: paper_name.into(),
            projection_angle: SheetAngle::First,
            scale: None,
            millimeters_per_unit: 1000.0,
            dimension_unit: DimensionUnit::Millimeter,
            side_view: None,
            axonometric_view: Some(NamedView::Isometric),
            style: LineStyle { line_widths: LineWidths::Iso(group), ..LineStyle::TECHNICAL },
            dimensions: true,
            measures: Vec::new(),
            center_lines: false,
            symmetry_lines: false,
            uncut: Vec::new(),
            title_block: TitleBlockText::default(),
            assembly: AssemblyPages::default(),
            views: Vec::new(),
            frame: SheetFrame::Plain,
            numbers: NumberFormat::default(),
            title_block_template: None,
            overlays: Vec::new(),
        }
    }

    /// Draws models, cut open by section planes, with up to `threads` threads. The number of
    /// threads does not change the page. Parts lists, exploded views and part sheets are on
    /// additional pages; see [`draw_pages`](Self::draw_pages).
    ///
    /// # Errors
    /// Returns an error if there is nothing to draw, if a view cannot be drawn, or if the views do
    /// not fit on the paper.
    pub fn draw(
        &self,
        models: &[ModelInstance],
        sections: &[Plane<World>],
        threads: usize,
    ) -> Result<SheetPage, SheetError> {
        self.draw_views(models, sections, &mut SurfaceCache::new(models, &self.uncut), threads)
    }

    /// Draws models like [`draw`](Self::draw), with surfaces that are shared between pages.
    fn draw_views(
        &self,
        models: &[ModelInstance],
        sections: &[Plane<World>],
        surfaces: &mut SurfaceCache<'_>,
        threads: usize,
    ) -> Result<SheetPage, SheetError> {
        let plan = ViewPlan::new(self, models, sections)?;
        let layout = ViewLayout::arrange_views(self, &plan)?;
        let size = DVec2::new(self.paper.width(), self.paper.height());
        let paper = Some(self.style.paper.unwrap_or(WHITE));
        let mut page = SheetPage::new(size, self.title_of(models), paper);
        let ink = self.style.ink_of_sheet();
        page.warnings = self.warnings_of_layout(&plan, &layout, &page.title);
        let mut is_empty = true;
        for placed in &layout.views {
            let style = self.style_of_view(placed);
            let composed = placed.planned.draw(surfaces, &style, placed.scale, threads)?;
            is_empty &= composed.drawing.is_empty();
            self.add_view(&mut page, placed, composed, &style);
        }
        let largest = layout.views.iter().map(|placed| placed.object_size().max_element());
        if is_empty {
            page.warnings.push(SheetWarning::NothingDrawn);
        } else if largest.fold(0.0, f64::max) < LEAST_DRAWING {
            page.warnings.push(SheetWarning::ViewsTiny);
        }
        // Several views may give the same warning.
        page.warnings.sort_unstable();
        page.warnings.dedup();
        self.draw_annotations(&mut page, &layout, ink);
        Ok(page)
    }

    /// Checks, without drawing anything, whether the views of models, cut by section planes, fit on
    /// the paper. Returns the warnings about views, sections and text that [`draw`](Self::draw)
    /// would give.
    ///
    /// # Errors
    /// See [`draw`](Self::draw).
    pub fn check_layout(
        &self,
        models: &[ModelInstance],
        sections: &[Plane<World>],
    ) -> Result<Vec<SheetWarning>, SheetError> {
        let plan = ViewPlan::new(self, models, sections)?;
        let layout = ViewLayout::arrange_views(self, &plan)?;
        Ok(self.warnings_of_layout(&plan, &layout, &self.title_of(models)))
    }

    /// Returns the title specified for the title block or, if that is empty, the model names.
    fn title_of(&self, models: &[ModelInstance]) -> String {
        let own = &self.title_block.title;
        if own.is_empty() { model_names(models) } else { own.clone() }
    }

    /// Returns warnings about views not shown as requested, and about missing characters.
    fn warnings_of_layout(
        &self,
        plan: &ViewPlan,
        layout: &ViewLayout<'_>,
        title: &str,
    ) -> Vec<SheetWarning> {
        let mut warnings = plan.warnings.clone();
        let left_out = layout.left_out.iter();
        warnings.extend(left_out.map(|view| SheetWarning::ViewLeftOut { view: view.title() }));
        let without_room = layout.views.iter().flat_map(|placed| &placed.annotations.left_out);
        warnings.extend(without_room.map(|dimension| SheetWarning::DimensionLeftOut {
            dimension: dimension.clone(),
            fault: DimensionFault::NoRoom,
        }));
        for placed in &layout.views {
            let view = || placed.planned.title();
            let labels = placed.annotations.labels_left_out.iter().cloned();
            warnings.extend(labels.map(|(text, fault)| SheetWarning::LabelNotInView {
                text,
                view: view(),
                fault,
            }));
        }
        warnings.extend(layout.overlaps.iter().cloned());
        match &self.title_block_template {
            Some(template) => {
                let scale = layout.scale.to_string();
                let contents = template.contents(&self.field_values(title, &scale));
                let missing = contents.iter().filter_map(|text| missing_glyph_warning(text));
                warnings.extend(missing.map(SheetWarning::from));
            }
            None => {
                let own = self.title_block.texts().into_iter().filter(|text| *text != title);
                let texts = core::iter::once(title).chain(own);
                warnings.extend(texts.filter_map(missing_glyph_warning).map(SheetWarning::from));
            }
        }
        warnings
    }

    /// Returns the style of a view's lines.
    ///
    /// Hidden lines are removed from axonometric views and sectional views, where they would only
    /// be confusing (ISO 128-3). Part hatching is removed from cut views, where hatching marks the
    /// cut.
    fn style_of_view(&self, placed: &PlacedView<'_>) -> LineStyle {
        let is_outside = placed.planned.is_outside_view();
        let hidden_lines = if is_outside { self.style.hidden_lines } else { HiddenLines::Removed };
        let face_fill = match self.style.face_fill {
            FaceFill::PartHatching if placed.planned.is_cut() => FaceFill::None,
            fill => fill,
        };
        LineStyle { hidden_lines, face_fill, ..self.style }
    }

    /// Adds the drawing of a view to the page, in layers whose ids begin with the view's name.
    fn add_view(
        &self,
        page: &mut SheetPage,
        placed: &PlacedView<'_>,
        ComposedDrawing { drawing, break_lines }: ComposedDrawing,
        style: &LineStyle,
    ) {
        let view = &placed.planned.drawn_view();
        let placement: Placement = view.placement(&drawing, placed.scale, placed.center);
        let (prefix, ink) = (format!("{}-", view.name), self.style.ink_of_sheet());
        let inks = [ink, self.style.paper.unwrap_or(WHITE)];
        // Fills come first, because lines are drawn over them.
        page.images.extend(drawing.face_fill_image(style, placement, &prefix));
        page.layers.extend(drawing.face_fill_layers(style, placement, &prefix, inks));
        page.layers.extend(drawing.to_layers(style, placement, &prefix, ink));
        let pen = Pen::solid(self.line_width_group().narrow_width(), ink);
        let mut layer = Layer::new(format!("{prefix}break-lines"), "break lines", pen);
        let on_page = |line: &Vec<DVec2>| {
            let points: Vec<DVec2> = line.iter().map(|p| placement.pixels_to_page(*p)).collect();
            Polyline::through_points(&points, false)
        };
        let strokes: Vec<Polyline> = break_lines.iter().filter_map(on_page).collect();
        if !strokes.is_empty() {
            layer.groups.push(Group { strokes, ..Group::default() });
            page.layers.push(layer);
        }
        page.warnings.extend(drawing.warnings.into_iter().map(SheetWarning::from));
    }

    /// Draws the dimensions and annotations of views, the scale bar, the frame and the title block.
    fn draw_annotations(&self, page: &mut SheetPage, layout: &ViewLayout<'_>, ink: Ink) {
        for kind in AnnotationLayer::ALL {
            let mut layer = kind.to_layer(self.line_width_group(), self.lettering_height(), ink);
            for placed in &layout.views {
                layer.groups.extend(placed.annotations.groups(kind, placed.center));
            }
            page.layers.extend((!layer.groups.is_empty()).then_some(layer));
        }
        page.layers.extend(scale_bar::scale_bar_layers(self, layout.scale_bar, layout.scale, ink));
        let block = self.title_block_area();
        page.layers.extend(self.frame_layers(&layout.contents(block), ink));
        let title = page.title.clone();
        let scale = Some(layout.scale);
        page.layers.extend(title_block::title_block_layers(self, &title, scale, block, ink));
    }

    /// Returns the frame, with zones if requested. Centering marks stop at it to avoid the
    /// contents.
    fn frame_layers(&self, contents: &[Extent], ink: Ink) -> Vec<Layer> {
        let frame = frame::frame_layer(self.paper, self.frame, contents, ink);
        let zones = match self.frame {
            SheetFrame::Plain => Vec::new(),
            SheetFrame::Zones => frame_zones::zone_layers(self.paper, ink),
        };
        core::iter::once(frame).chain(zones).collect()
    }

    /// Returns the line group, or the 0.5 mm group if the style has other widths.
    fn line_width_group(&self) -> IsoLineGroup {
        match self.style.line_widths {
            LineWidths::Iso(group) => group,
            _ => IsoLineGroup::MM_0_5,
        }
    }

    /// Returns the format of lengths.
    fn length_format(&self) -> LengthFormat {
        LengthFormat { unit: self.dimension_unit, numbers: self.numbers }
    }

    /// Returns the character height in millimeters: a standard size (ISO 3098) for the line group.
    fn lettering_height(&self) -> f64 {
        match self.line_width_group().wide_width() {
            wide if wide < 0.4 => 2.5,
            wide if wide < 0.6 => 3.5,
            _ => 5.0,
        }
    }

    /// Returns the area within the frame.
    fn drawing_area(&self) -> Rectangle {
        frame::area_within_frame(self.paper)
    }

    /// Returns the default area of the scale bar.
    fn scale_bar_area(&self) -> Rectangle {
        scale_bar::scale_bar_areas(self)[0]
    }

    /// Returns the area of the title block: the lower right corner of the frame.
    fn title_block_area(&self) -> Rectangle {
        title_block::title_block_area(self, self.drawing_area())
    }
}

/// Returns a rectangle with positive sides, or a fallback if a value is not finite.
fn rectangle_from_size(x: f64, y: f64, width: f64, height: f64) -> Rectangle {
    let fallback = || Rectangle::from_size(1.0, 1.0);
    let rectangle = Rectangle::new(x, y, width.max(1e-6), height.max(1e-6)).or_else(|_| fallback());
    rectangle.unwrap_or_else(|_| Paper::A4.to_rectangle())
}
