//! Page model: strokes and fills on paper, for output as SVG, PDF, DXF and PNG.
//!
//! Coordinates are whole micrometers from the upper left corner, with y down. Integers are the same
//! in every format, and sums of relative steps are exact.
//!
//! ```text
//!   Page ─┬─ PlacedImage …
//!         └─ Layer (pen) ─── Group (object) ─┬─ strokes: Polyline …
//!                                            ├─ fills:   Polyline …
//!                                            └─ content: meaning of the strokes, such as text
//! ```

use core::convert::Infallible;
use glam::DVec2;
use picture::Picture;

/// The size of an image pixel on paper in millimeters, for 96 pixels per inch as in CSS.
pub const MILLIMETERS_PER_PIXEL: f64 = MILLIMETERS_PER_INCH / 96.0;

/// The length of an inch in millimeters.
pub(crate) const MILLIMETERS_PER_INCH: f64 = 25.4;

/// An ink color: opaque sRGB.
pub type Ink = [u8; 3];

/// A point on the page in micrometers.
pub type PagePoint = [i32; 2];

/// A page and everything on it, in drawing order.
///
/// `W` is the type of its warnings, chosen by the crate that makes the drawing. It can be omitted
/// if there are no warnings.
#[derive(Clone, PartialEq, Debug)]
pub struct Page<W = Infallible> {
    /// Width and height in millimeters.
    pub size: DVec2,
    /// The title of the document.
    pub title: String,
    /// The color of the paper, or `None` for a transparent background.
    pub paper: Option<Ink>,
    /// Images on the paper, under the lines.
    pub images: Vec<PlacedImage>,
    /// The layers; each is drawn over the previous layers.
    pub layers: Vec<Layer>,
    /// Warnings from the drawings on the page, without duplicates.
    pub warnings: Vec<W>,
}

/// An image on a page.
#[derive(Clone, PartialEq, Debug)]
pub struct PlacedImage {
    /// An identifier, unique on its page, in lower case with hyphens.
    pub id: String,
    /// The upper left corner in micrometers.
    pub corner: PagePoint,
    /// Width and height in micrometers, greater than 0.
    pub size: PagePoint,
    /// The pixels, stretched to `size`.
    pub picture: Picture,
}

/// Lines of one kind, drawn with one pen.
#[derive(Clone, PartialEq, Debug)]
pub struct Layer {
    /// An identifier, unique on its page, in lower case with hyphens.
    pub id: String,
    /// A human-readable title.
    pub title: String,
    /// The pen for its lines.
    pub pen: Pen,
    /// The lines, grouped by object.
    pub groups: Vec<Group>,
}

/// The lines of a layer that belong to one object.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Group {
    /// An identifier, unique in its layer; empty if the layer is not divided.
    pub id: String,
    /// The object's name.
    pub title: String,
    /// Lines.
    pub strokes: Vec<Polyline>,
    /// Areas, such as arrowheads, filled with the pen's ink by the even-odd rule.
    pub fills: Vec<Polyline>,
    /// The meaning of the strokes, for formats that support text or hatches.
    pub content: GroupContent,
}

/// The meaning of a group of strokes: lines, text or hatching.
///
/// Every format can draw the strokes. DXF also has text and hatch entities, which programs can
/// edit.
#[derive(Clone, PartialEq, Debug, Default)]
pub enum GroupContent {
    /// Lines.
    #[default]
    Lines,
    /// The characters of a line of text.
    Text(TextLine),
    /// The hatch lines of areas.
    Hatching(Vec<HatchArea>),
}

/// A line of text on a page.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct TextLine {
    /// The text.
    pub text: String,
    /// The start and end of its baseline, in micrometers.
    pub baseline: [PagePoint; 2],
    /// The height of capitals in micrometers.
    pub height: i32,
}

/// An area with parallel, equally spaced lines.
#[derive(Clone, PartialEq, Debug)]
pub struct HatchArea {
    /// Closed lines around the area and its holes, by the even-odd rule.
    pub loops: Vec<Polyline>,
    /// A point in micrometers on one of the lines or its extension.
    pub origin: PagePoint,
    /// The unit vector along the lines, with y down.
    pub direction: DVec2,
    /// The distance between lines in millimeters.
    pub spacing: f64,
}

impl GroupContent {
    /// Moves the content by a distance in micrometers, as its strokes are moved.
    pub(crate) fn move_by(&mut self, by: PagePoint) {
        let move_point = |point: &mut PagePoint| {
            *point = [point[0].saturating_add(by[0]), point[1].saturating_add(by[1])];
        };
        match self {
            Self::Lines => {}
            Self::Text(line) => line.baseline.iter_mut().for_each(move_point),
            Self::Hatching(areas) => {
                for area in areas {
                    area.loops.iter_mut().flat_map(|line| &mut line.points).for_each(move_point);
                    move_point(&mut area.origin);
                }
            }
        }
    }
}

/// A sequence of points joined by straight lines.
///
/// ```
/// use page::Polyline;
/// use glam::DVec2;
///
/// let [a, b] = [DVec2::ZERO, DVec2::new(3.0, 4.0)];
/// let line = Polyline::through_points(&[a, a, b], false).expect("two different points");
/// assert_eq!((line.points.len(), line.length()), (2, 5.0));
/// // Points closer than half a micrometer coincide on the grid.
/// assert_eq!(Polyline::through_points(&[a, a + 1e-4], false), None);
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Polyline {
    /// At least two points. Adjacent points differ.
    pub points: Vec<PagePoint>,
    /// Whether the last point is joined to the first. The first point is not repeated.
    pub closed: bool,
}

/// The attributes with which lines are stroked.
#[derive(Clone, PartialEq, Debug)]
pub struct Pen {
    /// The line width in millimeters.
    pub width: f64,
    /// The color.
    pub ink: Ink,
    /// Alternating lengths of dashes and gaps in millimeters; empty for a continuous line. Each
    /// polyline starts a new pattern, fitted to its length by [`Pen::fitted_dashes`].
    pub dashes: Vec<f64>,
    /// The shape of line ends.
    pub cap: Cap,
    /// The shape of line corners.
    pub join: Join,
}

/// The shape of line ends.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Cap {
    /// Ends flat at the end point.
    Butt,
    /// Adds a half disc around the end point.
    #[default]
    Round,
    /// Extends by half a line width.
    Square,
}

/// The shape of line corners.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Join {
    /// Extends the outer sides to a point, up to a miter limit of 4.
    Miter,
    /// Adds a disc around the corner.
    #[default]
    Round,
    /// Cuts the corner off.
    Bevel,
}

/// A page without its warnings: the input of the format writers.
#[derive(Clone, Copy)]
pub(crate) struct PageContent<'a> {
    pub(crate) size: DVec2,
    pub(crate) title: &'a str,
    pub(crate) paper: Option<Ink>,
    pub(crate) images: &'a [PlacedImage],
    pub(crate) layers: &'a [Layer],
}

impl<W> Page<W> {
    /// Creates an empty page; the size is in millimeters.
    #[must_use]
    pub fn new(size: DVec2, title: impl Into<String>, paper: Option<Ink>) -> Self {
        let (images, layers, warnings) = (Vec::new(), Vec::new(), Vec::new());
        Self { size, title: title.into(), paper, images, layers, warnings }
    }

    /// Converts the warnings to another type, for example to the warning type of a higher-level
    /// crate.
    #[must_use]
    pub fn map_warnings<V>(self, map: impl FnMut(W) -> V) -> Page<V> {
        let Self { size, title, paper, images, layers, warnings } = self;
        let warnings = warnings.into_iter().map(map).collect();
        Page { size, title, paper, images, layers, warnings }
    }

    /// Returns the page without its warnings.
    pub(crate) fn content(&self) -> PageContent<'_> {
        let Self { size, title, paper, images, layers, .. } = self;
        PageContent { size: *size, title, paper: *paper, images, layers }
    }
}

impl<W: Clone> Page<W> {
    /// Puts the content of another page onto this page, with its upper left corner at `corner`, in
    /// millimeters.
    ///
    /// `prefix` is prepended to the ids of images and layers, so that they stay unique.
    pub fn paste_page(&mut self, other: &Self, corner: DVec2, prefix: &str) {
        let by = to_micrometers(corner);
        let moved = |point: PagePoint| [point[0] + by[0], point[1] + by[1]];
        self.images.extend(other.images.iter().cloned().map(|pasted| PlacedImage {
            id: format!("{prefix}{}", pasted.id),
            corner: moved(pasted.corner),
            ..pasted
        }));
        for layer in &other.layers {
            let mut layer = layer.clone();
            layer.id = format!("{prefix}{}", layer.id);
            for group in &mut layer.groups {
                let lines = group.strokes.iter_mut().chain(&mut group.fills);
                lines.flat_map(|line| &mut line.points).for_each(|point| *point = moved(*point));
                group.content.move_by(by);
            }
            self.layers.push(layer);
        }
        self.warnings.extend(other.warnings.iter().cloned());
    }
}

impl Layer {
    /// Creates an empty layer.
    #[must_use]
    pub fn new(id: impl Into<String>, title: impl Into<String>, pen: Pen) -> Self {
        Self { id: id.into(), title: title.into(), pen, groups: Vec::new() }
    }
}

impl Pen {
    /// Creates a pen for continuous lines with round caps and joins.
    #[must_use]
    pub fn solid(width: f64, ink: Ink) -> Self {
        Self { width, ink, dashes: Vec::new(), cap: Cap::Round, join: Join::Round }
    }
}

impl Polyline {
    /// Creates a polyline through points in millimeters, omitting points that coincide with the
    /// previous point on the grid.
    ///
    /// Returns `None` if fewer than two points remain.
    #[must_use]
    pub fn through_points(millimeters: &[DVec2], closed: bool) -> Option<Self> {
        let mut points: Vec<PagePoint> = millimeters.iter().copied().map(to_micrometers).collect();
        points.dedup();
        if closed && points.first() == points.last() {
            points.pop();
        }
        (points.len() >= 2).then_some(Self { points, closed })
    }

    /// Returns the length in millimeters.
    #[must_use]
    pub fn length(&self) -> f64 {
        let last = self.closed.then(|| [self.points[self.points.len() - 1], self.points[0]]);
        let sides = self.points.windows(2).map(|pair| [pair[0], pair[1]]).chain(last);
        sides.map(|[a, b]| (to_millimeters(a) - to_millimeters(b)).length()).sum()
    }
}

/// Rounds to the nearest grid point, and saturates if the point is too far away.
///
/// Ties round away from zero. The grid extends to ±2147 m, far beyond any paper.
#[must_use]
pub fn to_micrometers(millimeters: DVec2) -> PagePoint {
    // A float-to-int cast is exact for integers and saturates.
    (millimeters * 1000.0).to_array().map(|c| libm::round(c) as i32)
}

/// Converts a grid point to millimeters.
#[must_use]
pub fn to_millimeters([x, y]: PagePoint) -> DVec2 {
    DVec2::new(f64::from(x), f64::from(y)) / 1000.0
}
