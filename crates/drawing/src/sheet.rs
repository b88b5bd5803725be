//! Drawing sheets: orthographic views of an object on paper, to scale, with title block and overall
//! dimensions.
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
//! Views are aligned: those of one row have the same heights, those of one column the same widths
//! (ISO 5456-2). The scale is one of the standard series (ISO 5455). Frame and title block follow
//! ISO 5457 and ISO 7200, dimensions ISO 129-1.

mod dimension;
mod frame;
mod projection_symbol;
mod scale_bar;
mod section_line;
mod sheet_view;
mod surface_cache;
mod title_block;
mod view_layout;

use super::label::{Label, TextAlign};
use super::layout::Placement;
use super::line_style::{HiddenLines, LineStyle, LineWidths};
use super::line_type::IsoLineGroup;
use super::page::{Group, Ink, Layer, Page};
use super::palette::{BLACK, WHITE};
use crate::{DrawError, LineDrawing};
use camera::NamedView;
use glam::DVec2;
use homog::{Plane, World};
use model::{ModelInstance, model_names, world_points};
use projection::SheetAngle;
use sheet_view::SheetView;
use surface_cache::SurfaceCache;
use view_layout::{PlacedView, ViewLayout};
use viewport::{DrawingScale, Paper, Rectangle};

/// A drawing sheet: the views on it and their appearance.
///
/// ```
/// use drawing::{Sheet, TitleBlockText};
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
    /// The paper in its orientation.
    pub paper: Paper,
    /// The name of the paper, such as A3.
    pub paper_name: String,
    /// First-angle or third-angle projection: the layout of the views.
    pub projection_angle: SheetAngle,
    /// The scale; `None` for the largest of the standard series that fits.
    pub scale: Option<DrawingScale>,
    /// Millimeters in a unit of the scene.
    pub millimeters_per_unit: f64,
    /// The view beside the front view.
    pub side_view: NamedView,
    /// The axonometric view in the free corner; `None` for no such view.
    pub axonometric_view: Option<NamedView>,
    /// The line style of the views.
    pub style: LineStyle,
    /// Whether overall dimensions are drawn.
    pub dimensions: bool,
    /// The texts of the title block.
    pub title_block: TitleBlockText,
}

/// The texts of a title block (ISO 7200).
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct TitleBlockText {
    /// The title of the drawing; empty for the names of the models.
    pub title: String,
    /// The author.
    pub author: String,
    /// The date as text.
    pub date: String,
    /// The drawing number.
    pub number: String,
}

/// A sheet that cannot be drawn.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SheetError {
    /// A view cannot be drawn.
    #[error(transparent)]
    Draw(#[from] DrawError),
    /// The models have no points, lines or triangles.
    #[error("there is nothing to draw: the models have no points, lines or triangles")]
    Empty,
    /// A view has no camera or no projection.
    #[error("the {view} view cannot be drawn: {reason}")]
    View {
        /// The view.
        view: NamedView,
        /// The reason.
        reason: String,
    },
    #[error(
        "the views do not fit on {paper} at {scale}: they need {:.0} x {:.0} mm, and {:.0} x {:.0} mm are available{remedy}",
        need[0], need[1], available[0], available[1]
    )]
    /// The views are too large for the paper.
    TooLarge {
        /// The name of the paper.
        paper: String,
        /// The scale.
        scale: DrawingScale,
        /// Width and height of the views at this scale, in millimeters.
        need: [f64; 2],
        /// Width and height that are available to them, in millimeters.
        available: [f64; 2],
        /// A change that would make them fit.
        remedy: String,
    },
}

impl Sheet {
    /// A technical drawing on this paper: first angle, the view from the left, an isometric view,
    /// overall dimensions.
    ///
    /// Line groups grow with the paper: 0.35 mm up to A5, 0.5 mm up to A2, 0.7 mm beyond.
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
            side_view: NamedView::Left,
            axonometric_view: Some(NamedView::Isometric),
            style: LineStyle { line_widths: LineWidths::Iso(group), ..LineStyle::TECHNICAL },
            dimensions: true,
            title_block: TitleBlockText::default(),
        }
    }

    /// Draws models, cut open by section planes, with up to `threads` threads; their number does
    /// not change the page.
    ///
    /// # Errors
    /// If there is nothing to draw, a view cannot be drawn, or the views are larger than the paper.
    pub fn draw(
        &self,
        models: &[ModelInstance],
        sections: &[Plane<World>],
        threads: usize,
    ) -> Result<Page, SheetError> {
        let (principal, axonometric) = self.frame_views(models)?;
        let layout = ViewLayout::arrange_views(self, principal.each_ref(), axonometric.as_ref())?;
        let title = if self.title_block.title.is_empty() {
            model_names(models)
        } else {
            self.title_block.title.clone()
        };
        let size = DVec2::new(self.paper.width(), self.paper.height());
        let mut page = Page::new(size, title, Some(WHITE));
        let ink = self.style.ink.unwrap_or(BLACK);
        let mut surfaces = SurfaceCache::new(models);
        for placed in &layout.views {
            let shown = sections.iter().copied().filter(|plane| placed.shows_section(*plane));
            let shown: Vec<Plane<World>> = shown.collect();
            let style = self.style_of_view(placed, !shown.is_empty());
            let drawing =
                placed.view.draw(surfaces.cut_by(&shown), &style, placed.scale, threads)?;
            self.add_view(&mut page, placed, drawing, &style);
        }
        page.layers.extend(section_line::section_line_layers(self, sections, &layout, ink));
        self.draw_annotations(&mut page, &layout, ink);
        Ok(page)
    }

    /// Whether the views of models fit on the paper, without drawing them.
    ///
    /// # Errors
    /// As for [`draw`](Self::draw).
    pub fn check_layout(&self, models: &[ModelInstance]) -> Result<(), SheetError> {
        let (principal, axonometric) = self.frame_views(models)?;
        ViewLayout::arrange_views(self, principal.each_ref(), axonometric.as_ref()).map(drop)
    }

    /// The front, top and side view, and the axonometric one if there is one.
    fn frame_views(
        &self,
        models: &[ModelInstance],
    ) -> Result<([SheetView; 3], Option<SheetView>), SheetError> {
        let points = world_points(models);
        let view =
            |name: NamedView| SheetView::frame_points(&points, name, self.millimeters_per_unit);
        let principal = [view(NamedView::Front)?, view(NamedView::Top)?, view(self.side_view)?];
        Ok((principal, self.axonometric_view.map(view).transpose()?))
    }

    /// The style of a view's lines.
    ///
    /// Hidden lines are removed from axonometric views and from sectional views, where they would
    /// only confuse (ISO 128-3).
    fn style_of_view(&self, placed: &PlacedView<'_>, is_cut: bool) -> LineStyle {
        let is_outside = NamedView::PRINCIPAL.contains(&placed.view.name) && !is_cut;
        let hidden_lines = if is_outside { self.style.hidden_lines } else { HiddenLines::Removed };
        LineStyle { hidden_lines, ..self.style }
    }

    /// Puts the drawing of a view onto the page, with the name of the view before its layers' ids.
    fn add_view(
        &self,
        page: &mut Page,
        placed: &PlacedView<'_>,
        drawing: LineDrawing,
        style: &LineStyle,
    ) {
        let placement = placed.view.placement(&drawing, placed.scale, placed.center);
        let (prefix, ink) = (format!("{}-", placed.view.name), self.style.ink.unwrap_or(BLACK));
        page.images.extend(drawing.face_fill_image(placement, &prefix));
        page.layers.extend(drawing.to_layers(style, placement, &prefix, ink));
        page.warnings.extend(drawing.warnings);
        page.warnings.sort_unstable();
        page.warnings.dedup();
    }

    /// The scale below a view whose scale is not that of the sheet.
    fn scale_note_layer(&self, layout: &ViewLayout<'_>, ink: Ink) -> Option<Layer> {
        let other = layout.views.iter().find(|placed| placed.scale != layout.scale)?;
        let (area, height) = (other.object_area(), self.lettering_height());
        let at = DVec2::new(other.center.x, area.y() + area.height() + 1.8 * height);
        let text = other.scale.to_string();
        let label = Label::new(&text, at, height).with_align(TextAlign::Middle);
        let mut layer = Layer::new("other-scale", "scale of the last view", label.pen(ink));
        layer.groups.push(Group { strokes: label.strokes(), ..Group::default() });
        Some(layer)
    }

    /// Draws dimensions, scale bar, frame and title block.
    fn draw_annotations(&self, page: &mut Page, layout: &ViewLayout<'_>, ink: Ink) {
        if self.dimensions {
            page.layers.extend(dimension::overall_dimension_layers(self, layout, ink));
        }
        page.layers.extend(self.scale_note_layer(layout, ink));
        page.layers.push(scale_bar::scale_bar_layer(self, layout.scale, ink));
        let block = self.title_block_area();
        page.layers.push(frame::frame_layer(self.paper, block, ink));
        let title = page.title.clone();
        page.layers.extend(title_block::title_block_layers(self, &title, layout.scale, block, ink));
    }

    /// The line group, 0.5 mm if the style has other widths.
    fn line_width_group(&self) -> IsoLineGroup {
        match self.style.line_widths {
            LineWidths::Iso(group) => group,
            _ => IsoLineGroup::MM_0_5,
        }
    }

    /// The height of letters in millimeters: a standard size (ISO 3098) for the line group.
    fn lettering_height(&self) -> f64 {
        match self.line_width_group().wide_width() {
            wide if wide < 0.4 => 2.5,
            wide if wide < 0.6 => 3.5,
            _ => 5.0,
        }
    }

    /// The area within the frame.
    fn drawing_area(&self) -> Rectangle {
        frame::area_within_frame(self.paper)
    }

    /// The area of the scale bar: the lower left corner of the frame, or above a title block as
    /// wide as the frame.
    fn scale_bar_area(&self) -> Rectangle {
        scale_bar::scale_bar_area(self)
    }

    /// The area of the title block: the lower right corner of the frame.
    fn title_block_area(&self) -> Rectangle {
        title_block::title_block_area(self.drawing_area())
    }
}

/// A rectangle from values that are finite by construction; its sides are made positive.
fn rectangle_from_size(x: f64, y: f64, width: f64, height: f64) -> Rectangle {
    let fallback = || Rectangle::from_size(1.0, 1.0);
    let rectangle = Rectangle::new(x, y, width.max(1e-6), height.max(1e-6)).or_else(|_| fallback());
    rectangle.unwrap_or_else(|_| Paper::A4.to_rectangle())
}
