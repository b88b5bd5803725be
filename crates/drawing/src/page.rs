//! A page: strokes and fills on paper, as every output writes them.
//!
//! Coordinates are whole micrometres from the upper left corner, y down. Being whole they are the same in SVG, PDF and PNG, and
//! relative steps between them add up without error.

use super::Warning;
use glam::DVec2;
use shade::Picture;

/// Millimetres of a picture's pixel on paper: 96 of them make an inch, as in CSS.
pub const MILLIMETERS_PER_PIXEL: f64 = viewport::MILLIMETERS_PER_INCH / 96.0;

/// A colour of ink: sRGB, opaque.
pub type Ink = [u8; 3];

/// A place on the page in micrometres.
pub type PagePoint = [i32; 2];

/// A page with everything on it, in the order in which it is drawn.
#[derive(Clone, PartialEq, Debug)]
pub struct Page {
    /// Width and height in millimetres.
    pub size: DVec2,
    /// What the page shows.
    pub title: String,
    /// The colour of the paper; `None` for no colour.
    pub paper: Option<Ink>,
    /// Pictures on the paper, under the lines.
    pub images: Vec<PlacedImage>,
    /// What is drawn, one layer over the other.
    pub layers: Vec<Layer>,
    /// What could not be drawn as it should, each once.
    pub warnings: Vec<Warning>,
}

/// A picture on a page.
#[derive(Clone, PartialEq, Debug)]
pub struct PlacedImage {
    /// A name for programs: lower case, hyphens, unique on its page.
    pub id: String,
    /// The upper left corner in micrometres.
    pub corner: PagePoint,
    /// Width and height in micrometres, greater than 0.
    pub size: PagePoint,
    /// The picture, stretched to this size.
    pub picture: Picture,
}

/// Lines of one kind, drawn with one pen.
#[derive(Clone, PartialEq, Debug)]
pub struct Layer {
    /// A name for programs: lower case, hyphens, unique on its page.
    pub id: String,
    /// A name for people.
    pub title: String,
    /// What its lines are drawn with.
    pub pen: Pen,
    /// Its lines, by what they belong to.
    pub groups: Vec<Group>,
}

/// The lines of a layer that belong to one object.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Group {
    /// A name for programs, unique in its layer; empty if the layer is not divided.
    pub id: String,
    /// The object's name.
    pub title: String,
    /// Lines.
    pub strokes: Vec<Polyline>,
    /// Areas filled with the pen's ink, such as arrowheads; even ones inside odd ones are holes.
    pub fills: Vec<Polyline>,
}

/// Points joined by straight lines.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Polyline {
    /// The points, at least two, neighbours different.
    pub points: Vec<PagePoint>,
    /// Whether the last one is joined to the first, which is not there twice.
    pub closed: bool,
}

/// What lines are drawn with.
#[derive(Clone, PartialEq, Debug)]
pub struct Pen {
    /// The width of the line in millimetres.
    pub width: f64,
    /// The colour.
    pub ink: Ink,
    /// Lengths of dashes and gaps in turn, in millimetres; none for a continuous line. Each polyline begins anew, with a pattern
    /// fitted to its length: [`Pen::fitted_dashes`].
    pub dashes: Vec<f64>,
    /// How lines end.
    pub cap: Cap,
    /// How lines turn corners.
    pub join: Join,
}

/// How lines end.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Cap {
    /// At the end.
    Butt,
    /// With a half disc around the end.
    #[default]
    Round,
    /// Half a width beyond the end.
    Square,
}

/// How lines turn corners.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Join {
    /// Outer sides meet in a point, unless it is four widths away.
    Miter,
    /// With a disc around the corner.
    #[default]
    Round,
    /// The corner is cut off.
    Bevel,
}

impl Page {
    /// An empty page.
    #[must_use]
    pub fn new(size: DVec2, title: impl Into<String>, paper: Option<Ink>) -> Self {
        let (images, layers, warnings) = (Vec::new(), Vec::new(), Vec::new());
        Self { size, title: title.into(), paper, images, layers, warnings }
    }
}

impl Layer {
    /// An empty layer.
    #[must_use]
    pub fn new(id: impl Into<String>, title: impl Into<String>, pen: Pen) -> Self {
        Self { id: id.into(), title: title.into(), pen, groups: Vec::new() }
    }
}

impl Pen {
    /// A pen for continuous lines with round ends and corners.
    #[must_use]
    pub fn solid(width: f64, ink: Ink) -> Self {
        Self { width, ink, dashes: Vec::new(), cap: Cap::Round, join: Join::Round }
    }
}

impl Polyline {
    /// The polyline through points given in millimetres, without those that repeat their neighbour; `None` if fewer than two
    /// are left.
    #[must_use]
    pub fn through_points(millimetres: &[DVec2], closed: bool) -> Option<Self> {
        let mut points: Vec<PagePoint> = millimetres.iter().copied().map(to_micrometers).collect();
        points.dedup();
        if closed && points.first() == points.last() {
            points.pop();
        }
        (points.len() >= 2).then_some(Self { points, closed })
    }

    /// The length in millimetres.
    #[must_use]
    pub fn length(&self) -> f64 {
        let last = self.closed.then(|| [self.points[self.points.len() - 1], self.points[0]]);
        let sides = self.points.windows(2).map(|pair| [pair[0], pair[1]]).chain(last);
        sides.map(|[a, b]| (to_millimeters(a) - to_millimeters(b)).length()).sum()
    }
}

/// The nearest place of the grid; what is too far away for it is brought to its border.
#[must_use]
pub fn to_micrometers(millimetres: DVec2) -> PagePoint {
    // Casting is exact for whole numbers and cuts off at the ends of the range.
    (millimetres * 1000.0).to_array().map(|c| libm::round(c) as i32)
}

/// A place of the grid in millimetres.
#[must_use]
pub fn to_millimeters([x, y]: PagePoint) -> DVec2 {
    DVec2::new(f64::from(x), f64::from(y)) / 1000.0
}
