//! Arranges a line drawing in layers: one layer for each kind of line, with one group for each
//! object.
//!
//! ```text
//!   segments ─► kinds (hidden, depth band, class) ─► overlap removal ─► chains ─► layers
//!
//!   kinds by importance       layers in drawing order
//!   0  visible silhouette     hidden crease
//!   1  visible boundary       hidden silhouette
//!   2  visible crease         …
//!   …  hidden silhouette      visible silhouette    drawn last, so on top
//! ```
//!
//! The order of kinds has two effects. Layers of more important kinds are drawn over the others.
//! Where segments coincide on the page, only the most important one remains. Layers have stable
//! ids, such as `hidden-crease`, for use in style sheets and scripts.

use super::hand_drawn::draw_by_hand;
use super::line_density::Thinning;
use super::line_style::{EdgeSelection, FaceFill, HiddenLines, LineStyle, LineWidths};
use super::overlap_removal::{PageSegment, remove_overlaps};
use super::polyline_chain::{PolylineChain, join_into_chains};
use super::region_outline::{is_traced, outline_loops};
use super::speckles::{LEAST_CHAIN_LENGTH, ShortChains, remove_speckles};
use crate::Warning;
use crate::{Drawing, Page};
use glam::DVec2;
use hidden_line::{EdgeClass, EdgeSegment, Region, RegionHatching};
use page::palette::{BLACK, WHITE, ink_on_paper};
use page::{
    Group, GroupContent, HatchArea, Ink, Layer, LineType, MILLIMETERS_PER_PIXEL, Pen, PlacedImage,
    Polyline, to_micrometers,
};

/// The map from drawing pixels to page millimeters: millimeters = pixels × `scale` + `corner`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Placement {
    /// The position of the drawing's upper left corner, in millimeters.
    pub corner: DVec2,
    /// Millimeters per pixel, in x and y.
    pub scale: DVec2,
}

impl Placement {
    /// At the upper left corner of the page, with 96 pixels per inch.
    pub const PICTURE: Self =
        Self { corner: DVec2::ZERO, scale: DVec2::splat(MILLIMETERS_PER_PIXEL) };

    /// Converts a point of the drawing to millimeters on the page.
    pub fn pixels_to_page(&self, pixels: DVec2) -> DVec2 {
        self.corner + pixels * self.scale
    }

    /// Returns the closed outlines of a region on the page.
    fn region_loops(&self, region: &Region) -> Vec<Polyline> {
        let on_page = |end: DVec2| to_micrometers(self.pixels_to_page(end));
        outline_loops(region.edges.iter().map(|edge| (edge.ends.map(on_page), edge.winding)))
    }

    /// Whether the outline of a region is traced on a grid.
    pub(super) fn traces_region(&self, region: &Region) -> bool {
        let on_page = |end: DVec2| to_micrometers(self.pixels_to_page(end));
        is_traced(region.edges.iter().map(|edge| (edge.ends.map(on_page), edge.winding)))
    }

    /// Returns the area of a hatched region on the page, or `None` without hatching or outlines.
    fn hatch_area(&self, region: &Region) -> Option<HatchArea> {
        let RegionHatching { direction, spacing } = region.hatching?;
        let loops = self.region_loops(region);
        let (origin, direction) =
            (to_micrometers(self.corner), (direction * self.scale).normalize_or(DVec2::X));
        let spacing = spacing * self.scale.x;
        (!loops.is_empty()).then_some(HatchArea { loops, origin, direction, spacing })
    }
}

/// The number of depth bands in a drawing with a depth cue. Each band has a different ink.
const DEPTH_BANDS: u32 = 8;

/// A kind of line. The lines of one kind form one layer.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
struct LineKind {
    /// Whether the lines are hidden.
    hidden: bool,
    /// The depth band, where 0 is nearest; always 0 without a depth cue.
    band: u32,
    class: EdgeClass,
}

/// The kinds of lines in a style, most important first. Other modules refer to them by index.
struct LineKinds<'a> {
    style: &'a LineStyle,
    kinds: Vec<LineKind>,
    /// The nearest and farthest depths of all lines.
    depths: [f64; 2],
    /// The thinning of dense visible lines, then of dense hidden lines.
    thinning: [Thinning; 2],
}

impl Drawing {
    /// Returns the drawing as a separate page at 96 pixels per inch.
    ///
    /// `title` is the title of the document. `paper` fills the background; if the style has no ink,
    /// it also selects dark or light ink.
    #[must_use]
    pub fn to_page(&self, style: &LineStyle, title: &str, paper: Option<Ink>) -> Page {
        let mut page = Page::new(self.size * MILLIMETERS_PER_PIXEL, title, paper);
        let ink = style.ink_on(page.paper);
        let inks = [ink, paper.or(style.paper).unwrap_or(WHITE)];
        page.images.extend(self.face_fill_image(style, Placement::PICTURE, ""));
        page.layers = self.face_fill_layers(style, Placement::PICTURE, "", inks);
        page.layers.extend(self.to_layers(style, Placement::PICTURE, "", ink));
        page.warnings.clone_from(&self.warnings);
        if let Some(invisible) = style.ink.filter(|own| *own != ink) {
            page.warnings.push(Warning::InkReplaced { invisible, ink });
        }
        page
    }

    /// Returns the flat fill as an image on a page, if the drawing has one.
    ///
    /// The image covers the whole drawing, rounded to micrometers, so that lines and fill stay
    /// aligned.
    #[must_use]
    pub fn face_fill_image(
        &self,
        style: &LineStyle,
        placement: Placement,
        prefix: &str,
    ) -> Option<PlacedImage> {
        let picture = self.face_fill.clone().filter(|_| style.face_fill == FaceFill::Flat)?;
        let (corner, end) = (to_micrometers(placement.corner), placement.pixels_to_page(self.size));
        let end = to_micrometers(end);
        let size = [0, 1].map(|axis| (end[axis] - corner[axis]).max(1));
        Some(PlacedImage { id: format!("{prefix}tone"), corner, size, picture })
    }

    /// Returns the layers of the drawing, lowest first. `prefix` is prepended to their ids, so that
    /// several drawings can share a page.
    ///
    /// A kind without lines has no layer. The drawing must have been made with the options of the
    /// same style; see [`LineStyle::to_draw_options`].
    #[must_use]
    pub fn to_layers(
        &self,
        style: &LineStyle,
        placement: Placement,
        prefix: &str,
        ink: Ink,
    ) -> Vec<Layer> {
        let kinds = LineKinds::new(self, style, placement);
        let mut segments = Vec::new();
        for segment in &self.segments {
            kinds.for_each_segment(segment, |kind, ends, object| {
                segments.push(PageSegment {
                    ends: ends.map(|end| placement.pixels_to_page(end)),
                    layer: kind,
                    object,
                });
            });
        }
        let chains = join_into_chains(&remove_overlaps(&segments), |kind| kinds.joined_kind(kind));
        let chains = remove_speckles(chains, |kind| kinds.short_chains(kind));
        let layers = chains.chunk_by(|a, b| a.layer == b.layer);
        let layer = |chains: &[PolylineChain]| {
            let mut layer = self.layer_of_kind(&kinds, chains, prefix, ink);
            if kinds.kinds[chains[0].layer as usize].class == EdgeClass::Hatching {
                self.mark_hatchings(&mut layer, style, placement);
            }
            layer
        };
        let layers = layers.rev().map(layer);
        let mut layers: Vec<Layer> =
            layers.chain(self.outline_layer(&kinds, placement, prefix, ink)).collect();
        if style.hand_drawn > 0.0 {
            for group in layers.iter_mut().flat_map(|layer| &mut layer.groups) {
                group.strokes = draw_by_hand(&group.strokes, style.hand_drawn);
            }
        }
        layers
    }

    /// Returns the outline layer, with one group for the whole drawing or one for each object.
    fn outline_layer(
        &self,
        kinds: &LineKinds<'_>,
        placement: Placement,
        prefix: &str,
        ink: Ink,
    ) -> Option<Layer> {
        let style = kinds.style;
        let [width, _] = style.line_widths.wide_and_narrow();
        let pen = LineType::Continuous.to_pen(width, ink, style.cap, style.join);
        let mut layer = Layer::new(format!("{prefix}outline"), "outline", pen);
        let outlines: Vec<&Region> =
            self.regions.iter().filter(|region| region.hatching.is_none()).collect();
        for regions in outlines.chunk_by(|a, b| a.object == b.object) {
            let strokes: Vec<Polyline> =
                regions.iter().flat_map(|region| placement.region_loops(region)).collect();
            let (id, title) = match regions[0].object {
                Some(object) => (format!("{}", object + 1), self.object_name(object)),
                None => (String::new(), String::new()),
            };
            layer.groups.push(Group { id, title, strokes, ..Group::default() });
        }
        layer.groups.retain(|group| !group.strokes.is_empty());
        (!layer.groups.is_empty()).then_some(layer)
    }

    /// Records, in each group of a layer, the areas that its hatch lines fill, unless the style
    /// also hatches faces by luma.
    fn mark_hatchings(&self, layer: &mut Layer, style: &LineStyle, placement: Placement) {
        if matches!(style.face_fill, FaceFill::Hatching | FaceFill::ShadeHatching) {
            return;
        }
        for group in &mut layer.groups {
            let is_here = |region: &&Region| {
                region.object.is_some_and(|object| group.id == format!("{}", object + 1))
            };
            let areas: Vec<HatchArea> = self
                .regions
                .iter()
                .filter(is_here)
                .filter_map(|region| placement.hatch_area(region))
                .collect();
            if !areas.is_empty() {
                group.content = GroupContent::Hatching(areas);
            }
        }
    }

    /// Returns the name of an object; empty if it has none.
    fn object_name(&self, object: u32) -> String {
        self.objects.get(object as usize).cloned().unwrap_or_default()
    }

    /// Creates one layer from the chains of one kind.
    fn layer_of_kind(
        &self,
        kinds: &LineKinds<'_>,
        chains: &[PolylineChain],
        prefix: &str,
        ink: Ink,
    ) -> Layer {
        let kind = kinds.kinds[chains[0].layer as usize];
        let (id, title) = kind.layer_names(kinds.style);
        let mut layer = Layer::new(format!("{prefix}{id}"), title, kinds.pen_for_kind(kind, ink));
        for group in chains.chunk_by(|a, b| a.object == b.object) {
            let object = group[0].object;
            let title = self.object_name(object);
            let strokes = group.iter().map(|chain| chain.polyline.clone()).collect();
            let id = format!("{}", object + 1);
            layer.groups.push(Group { id, title, strokes, ..Group::default() });
        }
        layer
    }
}

impl LineStyle {
    /// Returns the ink of the style on paper of a given color: the style's own ink if it has one
    /// that can be seen there, otherwise an ink that contrasts with the paper, as in
    /// [`ink_on_paper`].
    #[must_use]
    pub fn ink_on(&self, paper: Option<Ink>) -> Ink {
        self.ink.filter(|ink| can_be_seen(*ink, paper)).unwrap_or_else(|| ink_on_paper(paper))
    }

    /// Returns the ink of a sheet: the style's ink, or black if it has none. An ink that cannot be
    /// seen on the style's paper is replaced by one that contrasts with the paper.
    #[must_use]
    pub fn ink_of_sheet(&self) -> Ink {
        let paper = Some(self.paper.unwrap_or(WHITE));
        let ink = self.ink.unwrap_or(BLACK);
        if can_be_seen(ink, paper) { ink } else { ink_on_paper(paper) }
    }
}

/// The smallest difference from the paper, in any of the channels red, green and blue, at which ink
/// can be seen.
const LEAST_CONTRAST: u8 = 32;

/// Whether lines in this ink can be seen on the paper. On transparent paper, all inks can.
fn can_be_seen(ink: Ink, paper: Option<Ink>) -> bool {
    let differs = |paper: Ink| ink.iter().zip(paper).any(|(a, b)| a.abs_diff(b) >= LEAST_CONTRAST);
    paper.is_none_or(differs)
}

impl<'a> LineKinds<'a> {
    /// Collects the kinds of lines that a style draws, and the range of depths.
    fn new(drawing: &Drawing, style: &'a LineStyle, placement: Placement) -> Self {
        let depths = drawing.segments.iter().flat_map(|segment| segment.depths);
        let nearest = depths.clone().fold(0.0, f64::max);
        let farthest = depths.fold(nearest, f64::min);
        let bands = if style.depth_cue > 0.0 { DEPTH_BANDS } else { 1 };
        let mut kinds = Vec::new();
        for hidden in [false, true] {
            for band in 0..bands {
                let classes =
                    EdgeClass::ALL.into_iter().filter(|class| selects_class(style, *class, hidden));
                kinds.extend(classes.map(|class| LineKind { hidden, band, class }));
            }
        }
        // Facets are construction lines, so even hidden feature edges take precedence over them.
        kinds.sort_by_key(|kind| (kind.class == EdgeClass::Facet, kind.hidden, kind.band));
        let thinning = thinning_for_style(drawing, style, placement);
        Self { style, kinds, depths: [nearest, farthest], thinning }
    }

    /// Calls `push` with each drawn part of a segment and the index of its kind.
    ///
    /// Segments of kinds that the style does not draw are skipped.
    fn for_each_segment(&self, segment: &EdgeSegment, mut push: impl FnMut(u32, [DVec2; 2], u32)) {
        let hidden = !segment.visible && self.style.hidden_lines != HiddenLines::Drawn;
        let kind_index = |band: u32| {
            let kind = LineKind { hidden, band, class: segment.class };
            self.kinds.iter().position(|other| *other == kind).map(|at| at as u32)
        };
        if self.style.depth_cue == 0.0 {
            let kind = kind_index(0);
            return kind.into_iter().for_each(|kind| push(kind, segment.ends, segment.object));
        }
        for (band, ends) in self.split_by_depth(segment) {
            kind_index(band).into_iter().for_each(|kind| push(kind, ends, segment.object));
        }
    }

    /// Splits a segment into parts by depth band.
    ///
    /// Depth is linear on the screen, so each band border cuts a segment at the fraction t =
    /// (border − from) / (to − from).
    fn split_by_depth(&self, segment: &EdgeSegment) -> Vec<(u32, [DVec2; 2])> {
        let [nearest, farthest] = self.depths;
        let span = nearest - farthest;
        let scaled = |depth: f64| {
            let part = if span > 0.0 { (nearest - depth) / span } else { 0.0 };
            part.clamp(0.0, 1.0) * f64::from(DEPTH_BANDS)
        };
        let [from, to] = segment.depths.map(scaled);
        let mut cuts = vec![0.0, 1.0];
        if from != to {
            let within = (1..DEPTH_BANDS).map(|border| (f64::from(border) - from) / (to - from));
            cuts.extend(within.filter(|t| *t > 0.0 && *t < 1.0));
            cuts.sort_by(f64::total_cmp);
        }
        let at = |t: f64| {
            if t == 1.0 { segment.ends[1] } else { segment.ends[0].lerp(segment.ends[1], t) }
        };
        let part = |pair: &[f64]| {
            let middle = from + (to - from) * (pair[0] + pair[1]) * 0.5;
            ((middle as u32).min(DEPTH_BANDS - 1), [at(pair[0]), at(pair[1])])
        };
        cuts.windows(2).map(part).collect()
    }

    /// Returns the first kind whose lines are chained with lines of this kind, so that dashes
    /// continue where the class of a hidden line changes.
    fn joined_kind(&self, index: u32) -> u32 {
        let kind = self.kinds[index as usize];
        let continues = |other: &LineKind| {
            other.hidden && other.band == kind.band && other.class != EdgeClass::Facet
        };
        if !continues(&kind) || kind.class == EdgeClass::Facet {
            return index;
        }
        self.kinds.iter().position(continues).map_or(index, |first| first as u32)
    }

    /// Returns the treatment of short chains of a kind. Wireframes, hatching and lines from the
    /// model itself keep all chains.
    fn short_chains(&self, index: u32) -> ShortChains {
        let kind = self.kinds[index as usize];
        let [wide, _] = self.style.line_widths.wide_and_narrow();
        let least = wide.max(LEAST_CHAIN_LENGTH);
        match kind.class {
            EdgeClass::Line => ShortChains::Retained,
            _ if self.style.edges == EdgeSelection::Facets => ShortChains::Retained,
            // An outline must stay closed.
            _ if self.style.edges == EdgeSelection::Silhouette => ShortChains::RemovedAlone(least),
            EdgeClass::Intersection => ShortChains::Removed(least),
            EdgeClass::Crease => ShortChains::RemovedUnlessBridge(least),
            EdgeClass::Silhouette | EdgeClass::Boundary | EdgeClass::Tangent => {
                ShortChains::RemovedAtEnds(least)
            }
            _ => ShortChains::Retained,
        }
    }

    /// Returns the pen of a kind. The pen is narrow for hidden, tangent and hatch lines and dashed
    /// for hidden lines; its ink fades with depth.
    fn pen_for_kind(&self, kind: LineKind, ink: Ink) -> Pen {
        let style = self.style;
        let [wide, narrow] = style.line_widths.wide_and_narrow();
        let is_narrow = kind.hidden
            || kind.class == EdgeClass::Hatching
            || kind.class == EdgeClass::Tangent && style.edges != EdgeSelection::Features;
        let width = if is_narrow { narrow } else { wide };
        let line_type = if kind.hidden { LineType::Dashed } else { LineType::Continuous };
        let Thinning { width: width_factor, contrast } = self.thinning[usize::from(kind.hidden)];
        let cue = style.depth_cue * f64::from(kind.band) / f64::from(DEPTH_BANDS - 1);
        let faded = if contrast < 1.0 { 1.0 - (1.0 - cue) * contrast } else { cue };
        let ink = if faded > 0.0 { faded_ink(ink, faded) } else { ink };
        line_type.to_pen(width * width_factor, ink, style.cap, style.join)
    }
}

/// Returns the thinning of dense lines in a style, first for visible lines, then for hidden lines.
///
/// Only wireframes and hidden lines are thinned, because these lines overlap each other. In other
/// styles, the visible lines are the drawing itself. Sheets are to scale and keep the requested
/// widths and ink.
fn thinning_for_style(drawing: &Drawing, style: &LineStyle, placement: Placement) -> [Thinning; 2] {
    if placement != Placement::PICTURE {
        return [Thinning::NONE; 2];
    }
    let [wide, narrow] = style.line_widths.wide_and_narrow().map(|mm| mm / MILLIMETERS_PER_PIXEL);
    let keeps_width = !matches!(style.line_widths, LineWidths::Pixels(_));
    match style.hidden_lines {
        HiddenLines::Drawn if style.edges == EdgeSelection::Facets => {
            [Thinning::for_lines(drawing, wide, keeps_width, |_| true), Thinning::NONE]
        }
        HiddenLines::Dashed | HiddenLines::FirstLayer => {
            let hidden = |segment: &EdgeSegment| !segment.visible;
            [Thinning::NONE, Thinning::for_lines(drawing, narrow, keeps_width, hidden)]
        }
        HiddenLines::Drawn | HiddenLines::Removed => [Thinning::NONE; 2],
    }
}

/// Fades an ink by a fraction of its contrast, toward white or, for light inks on dark paper,
/// toward black.
fn faded_ink(ink: Ink, part: f64) -> Ink {
    let ground = if ink.iter().map(|c| u32::from(*c)).sum::<u32>() > 384 { 0.0 } else { 255.0 };
    let mixed = |c: u8| f64::from(c) + (ground - f64::from(c)) * part;
    ink.map(|channel| libm::round(mixed(channel)) as u8)
}

/// Whether a style draws edges of a class.
fn selects_class(style: &LineStyle, class: EdgeClass, hidden: bool) -> bool {
    if hidden && style.hidden_lines == HiddenLines::Removed {
        return false;
    }
    // In a model without faces, all lines and points are drawn, regardless of the style.
    let is_own = matches!(class, EdgeClass::Line | EdgeClass::Marked);
    if !is_own && !style.to_draw_options().classes.contains(class) {
        return false;
    }
    match class {
        EdgeClass::Hatching => !hidden,
        // Tangent edges do not mark a bend, so they are skipped where they are hidden.
        EdgeClass::Tangent => !hidden || style.edges == EdgeSelection::Facets,
        _ => true,
    }
}

impl LineKind {
    /// Returns the id and title of the layer.
    fn layer_names(self, style: &LineStyle) -> (String, String) {
        let class = self.class.name();
        let visibility = match (self.hidden, style.hidden_lines) {
            (true, _) => "hidden",
            (false, HiddenLines::Drawn) => "all",
            (false, _) => "visible",
        };
        let (mut id, mut title) =
            (format!("{visibility}-{class}"), format!("{visibility}: {class}"));
        if style.depth_cue > 0.0 {
            id += &format!("-{}", self.band + 1);
            title += &format!(", depth {} of {DEPTH_BANDS}", self.band + 1);
        }
        (id, title)
    }
}
