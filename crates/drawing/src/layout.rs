//! From a line drawing to the layers of a page: a layer for each kind of line, a group for each object.

use super::chain::{Chain, chained};
use super::linetype::LineType;
use super::look::{HiddenLines, LineLook, Shown};
use super::overlap::{Piece, once};
use super::page::{Group, Ink, Layer, MILLIMETRES_PER_PIXEL, Page, Pasted, Pen, micrometres};
use super::{EdgeClass, Line, LineDrawing};
use glam::DVec2;

/// Where a drawing goes on a page: millimetres = pixels × `scale` + `corner`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Placement {
    /// Where the upper left corner of the drawing comes to lie, in millimetres.
    pub corner: DVec2,
    /// Millimetres for each pixel, in both directions.
    pub scale: DVec2,
}

impl Placement {
    /// At the upper left corner of the page, 96 pixels to the inch.
    pub const PICTURE: Self =
        Self { corner: DVec2::ZERO, scale: DVec2::splat(MILLIMETRES_PER_PIXEL) };

    fn place(&self, pixels: DVec2) -> DVec2 {
        self.corner + pixels * self.scale
    }
}

/// The most bands of depth that are told apart.
const BANDS: u32 = 8;

/// A kind of line: what a layer is made of. The most important kind comes first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
struct Kind {
    hidden: bool,
    /// 0 is nearest; always 0 without depth cue.
    band: u32,
    class: EdgeClass,
}

/// The kinds of lines of a look, and the numbers the rest of the way knows them by.
struct Kinds<'a> {
    look: &'a LineLook,
    kinds: Vec<Kind>,
    /// The nearest and the farthest depth of all lines.
    depths: [f64; 2],
}

impl LineDrawing {
    /// The drawing as a picture of its own.
    #[must_use]
    pub fn to_page(&self, look: &LineLook, title: &str, paper: Option<Ink>) -> Page {
        let mut page = Page::new(self.size * MILLIMETRES_PER_PIXEL, title, paper);
        page.pictures.extend(self.pasted(Placement::PICTURE, ""));
        page.layers = self.layers(look, Placement::PICTURE, "", page.ink(look));
        page.warnings.clone_from(&self.warnings);
        page
    }

    /// The tones of the faces, to be pasted under the lines, if there are any.
    #[must_use]
    pub fn pasted(&self, placement: Placement, prefix: &str) -> Option<Pasted> {
        let picture = self.tone.clone()?;
        let (corner, end) = (micrometres(placement.corner), placement.place(self.size));
        let end = micrometres(end);
        let size = [0, 1].map(|axis| (end[axis] - corner[axis]).max(1));
        Some(Pasted { id: format!("{prefix}tone"), corner, size, picture })
    }

    /// The layers of the drawing, the lowest first. `prefix` begins their names, so that several drawings go on one page.
    #[must_use]
    pub fn layers(
        &self,
        look: &LineLook,
        placement: Placement,
        prefix: &str,
        ink: Ink,
    ) -> Vec<Layer> {
        let kinds = Kinds::of(self, look);
        let mut pieces = Vec::new();
        for line in &self.lines {
            kinds.pieces(line, |kind, ends, object| {
                pieces.push(Piece {
                    ends: ends.map(|end| placement.place(end)),
                    layer: kind,
                    object,
                });
            });
        }
        let chains = chained(&once(&pieces));
        let layers = chains.chunk_by(|a, b| a.layer == b.layer);
        let layer = |chains: &[Chain]| self.layer(&kinds, chains, prefix, ink);
        layers.rev().map(layer).collect()
    }

    fn layer(&self, kinds: &Kinds<'_>, chains: &[Chain], prefix: &str, ink: Ink) -> Layer {
        let kind = kinds.kinds[chains[0].layer as usize];
        let (id, title) = kind.names(kinds.look);
        let mut layer = Layer::new(format!("{prefix}{id}"), title, kinds.pen(kind, ink));
        for group in chains.chunk_by(|a, b| a.object == b.object) {
            let object = group[0].object;
            let title = self.objects.get(object as usize).cloned().unwrap_or_default();
            let strokes = group.iter().map(|chain| chain.line.clone()).collect();
            let id = format!("{}", object + 1);
            layer.groups.push(Group { id, title, strokes, fills: Vec::new() });
        }
        layer
    }
}

impl Page {
    /// The ink of a look on this page: its own, or one that stands out from the paper.
    #[must_use]
    pub fn ink(&self, look: &LineLook) -> Ink {
        let is_dark = self.paper.is_some_and(|[r, g, b]| {
            let [r, g, b] = [r, g, b].map(u32::from);
            r * 299 + g * 587 + b * 114 < 118_000
        });
        look.ink.unwrap_or(if is_dark { [240, 243, 246] } else { [26, 31, 38] })
    }
}

impl<'a> Kinds<'a> {
    fn of(drawing: &LineDrawing, look: &'a LineLook) -> Self {
        let depths = drawing.lines.iter().flat_map(|line| line.depths);
        let nearest = depths.clone().fold(0.0, f64::max);
        let farthest = depths.fold(nearest, f64::min);
        let bands = if look.depth_cue > 0.0 { BANDS } else { 1 };
        let mut kinds = Vec::new();
        for hidden in [false, true] {
            for band in 0..bands {
                let classes =
                    EdgeClass::ALL.into_iter().filter(|class| draws(look, *class, hidden));
                kinds.extend(classes.map(|class| Kind { hidden, band, class }));
            }
        }
        // A line that is only there in thought is less than one that is hidden.
        kinds.sort_by_key(|kind| (kind.class == EdgeClass::Facet, kind.hidden, kind.band));
        Self { look, kinds, depths: [nearest, farthest] }
    }

    /// Hands on the parts of a line that are drawn, with the number of their kind.
    fn pieces(&self, line: &Line, mut hand_on: impl FnMut(u32, [DVec2; 2], u32)) {
        let hidden = !line.visible && self.look.hidden != HiddenLines::Drawn;
        let number = |band: u32| {
            let kind = Kind { hidden, band, class: line.class };
            self.kinds.iter().position(|other| *other == kind).map(|at| at as u32)
        };
        if self.look.depth_cue == 0.0 {
            let number = number(0);
            return number.into_iter().for_each(|kind| hand_on(kind, line.ends, line.object));
        }
        for (band, ends) in self.bands(line) {
            number(band).into_iter().for_each(|kind| hand_on(kind, ends, line.object));
        }
    }

    /// The parts of a line in each band of depth. Depth is linear on the screen.
    fn bands(&self, line: &Line) -> Vec<(u32, [DVec2; 2])> {
        let [nearest, farthest] = self.depths;
        let span = nearest - farthest;
        let scaled = |depth: f64| {
            let part = if span > 0.0 { (nearest - depth) / span } else { 0.0 };
            part.clamp(0.0, 1.0) * f64::from(BANDS)
        };
        let [from, to] = line.depths.map(scaled);
        let mut cuts = vec![0.0, 1.0];
        if from != to {
            let within = (1..BANDS).map(|border| (f64::from(border) - from) / (to - from));
            cuts.extend(within.filter(|t| *t > 0.0 && *t < 1.0));
            cuts.sort_by(f64::total_cmp);
        }
        let at = |t: f64| if t == 1.0 { line.ends[1] } else { line.ends[0].lerp(line.ends[1], t) };
        let part = |pair: &[f64]| {
            let middle = from + (to - from) * (pair[0] + pair[1]) * 0.5;
            ((middle as u32).min(BANDS - 1), [at(pair[0]), at(pair[1])])
        };
        cuts.windows(2).map(part).collect()
    }

    fn pen(&self, kind: Kind, ink: Ink) -> Pen {
        let look = self.look;
        let [wide, narrow] = look.widths.wide_and_narrow();
        let is_narrow =
            kind.hidden || matches!(kind.class, EdgeClass::Tangent | EdgeClass::Hatching);
        let width = if is_narrow { narrow } else { wide };
        let line_type = if kind.hidden { LineType::Dashed } else { LineType::Continuous };
        let ink = if kind.band == 0 { ink } else { paler(ink, look.depth_cue, kind.band) };
        line_type.pen(width, ink, look.cap, look.join)
    }
}

/// Ink with some of its contrast to white paper lost, or with dark paper in mind to black.
fn paler(ink: Ink, most: f64, band: u32) -> Ink {
    let part = most * f64::from(band) / f64::from(BANDS - 1);
    let ground = if ink.iter().map(|c| u32::from(*c)).sum::<u32>() > 384 { 0.0 } else { 255.0 };
    let mixed = |c: u8| f64::from(c) + (ground - f64::from(c)) * part;
    ink.map(|channel| libm::round(mixed(channel)) as u8)
}

/// Whether a look draws lines of a class.
fn draws(look: &LineLook, class: EdgeClass, hidden: bool) -> bool {
    if hidden && look.hidden == HiddenLines::Removed {
        return false;
    }
    match class {
        EdgeClass::Silhouette | EdgeClass::Boundary => true,
        EdgeClass::Facet => look.shown == Shown::Facets,
        EdgeClass::Hatching => !hidden && look.shown != Shown::Silhouette,
        // What is only there in thought is not drawn where it is hidden.
        EdgeClass::Tangent => {
            look.shown == Shown::Tangents && !hidden || look.shown == Shown::Facets
        }
        _ => look.shown != Shown::Silhouette,
    }
}

impl EdgeClass {
    /// All classes, the most important first.
    pub const ALL: [Self; 10] = [
        Self::Silhouette,
        Self::Boundary,
        Self::Crease,
        Self::Intersection,
        Self::Section,
        Self::Marked,
        Self::Tangent,
        Self::Line,
        Self::Hatching,
        Self::Facet,
    ];

    /// The name of lines of this class, in lower case.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Silhouette => "silhouette",
            Self::Boundary => "boundary",
            Self::Crease => "crease",
            Self::Intersection => "intersection",
            Self::Section => "section",
            Self::Marked => "marked",
            Self::Tangent => "tangent",
            Self::Line => "line",
            Self::Hatching => "hatching",
            Self::Facet => "facet",
        }
    }
}

impl Kind {
    /// The names of the layer, for programs and for people.
    fn names(self, look: &LineLook) -> (String, String) {
        let class = self.class.name();
        let sight = match (self.hidden, look.hidden) {
            (true, _) => "hidden",
            (false, HiddenLines::Drawn) => "all",
            (false, _) => "visible",
        };
        let (mut id, mut title) = (format!("{sight}-{class}"), format!("{sight}: {class}"));
        if look.depth_cue > 0.0 {
            id += &format!("-{}", self.band + 1);
            title += &format!(", depth {} of {BANDS}", self.band + 1);
        }
        (id, title)
    }
}
