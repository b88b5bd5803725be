//! Annotations of a view: its dimensions, cut lines and captions, and the space they take up.
//!
//! ```text
//!   ┌ ─ ─ ─ ─ ─ ─ ─ ┐
//!      ◄── 150 ──►         coordinates are in millimeters on paper from the center of the view;
//!   │  ┌─────────┐  │      the layout reserves space for the object and its annotations
//!      │    +    │
//!   │  └─────────┘  │
//!   └ ─ ─ ─ ─ ─ ─ ─ ┘
//! ```
//!
//! Annotations are created before the view is placed, because its position depends on their extent.

use crate::SheetLabelFault;
use glam::DVec2;
use page::{Group, Ink, Label, Layer, Pen, Polyline, TextAlign, to_millimeters};

/// The minimum distance between lines and text, in millimeters.
const LINE_CLEARANCE: f64 = 0.7;

/// An axis-aligned rectangle: its minimum and maximum corners.
pub(super) type Extent = [DVec2; 2];

/// The layers on which annotations are drawn.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum AnnotationLayer {
    /// The axes of circles and cylinders.
    CenterLines,
    /// Dimension lines, extension lines and arrowheads.
    Dimensions,
    /// The text of dimensions.
    DimensionTexts,
    /// Section lines, as narrow chain lines.
    CutLines,
    /// The wide ends of the section lines.
    CutEnds,
    /// The arrows of the section lines.
    CutArrows,
    /// Section letters and sectional view names.
    CutNames,
    /// The scales of views whose scale differs from the sheet's.
    ScaleNotes,
    /// Lines of symmetry, including those between the halves of half sections.
    SymmetryLines,
    /// Circles around details, with leader lines to their letters.
    ViewMarks,
    /// Letters of details and viewing directions, and view names.
    ViewNames,
    /// World axes and the leader lines of point labels.
    OverlayLines,
    /// Axis names and point labels.
    OverlayTexts,
}

/// A line of text beside a view.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct AnnotationText {
    pub(super) text: String,
    /// The anchor on the baseline.
    pub(super) anchor: DVec2,
    pub(super) height: f64,
    /// The direction of the baseline: to the right or upward.
    pub(super) direction: DVec2,
    pub(super) align: TextAlign,
}

/// The geometry of an annotation.
#[derive(Clone, PartialEq, Debug)]
pub(super) enum AnnotationShape {
    /// A straight line.
    Line([DVec2; 2]),
    /// Straight lines from point to point, such as the segments of an arc.
    Path(Vec<DVec2>),
    /// A polyline that ends at its first point.
    Loop(Vec<DVec2>),
    /// A filled triangle: an arrowhead.
    Head([DVec2; 3]),
    /// A line of text.
    Text(AnnotationText),
}

/// The annotations of one view.
#[derive(Clone, PartialEq, Debug, Default)]
pub(super) struct ViewAnnotations {
    items: Vec<PlacedShape>,
    /// The requested dimensions, each as a separate group.
    dimensions: Vec<PlacedDimension>,
    /// The dimensions for which there was no room, by name.
    pub(super) left_out: Vec<String>,
    /// The text of missing labels, with the reasons.
    pub(super) labels_left_out: Vec<(String, SheetLabelFault)>,
}

/// A shape with its layer and bounding rectangle. The rectangle is stored because each text
/// position is compared with every shape, and the rectangle of text depends on all its strokes.
#[derive(Clone, PartialEq, Debug)]
struct PlacedShape {
    layer: AnnotationLayer,
    shape: AnnotationShape,
    extent: Option<Extent>,
}

/// A dimension with its position.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct PlacedDimension {
    /// The number of the dimension on the sheet, from 1.
    pub(super) number: usize,
    pub(super) shapes: Vec<(AnnotationLayer, AnnotationShape)>,
}

impl AnnotationText {
    /// Returns text centered on a point.
    pub(super) fn centered(text: impl Into<String>, middle: DVec2, height: f64) -> Self {
        let anchor = middle + DVec2::Y * (0.5 * height);
        let align = TextAlign::Middle;
        Self { text: text.into(), anchor, height, direction: DVec2::X, align }
    }

    /// Returns the text as a label, with the center of the view at `origin`.
    fn label(&self, origin: DVec2) -> Label<'_> {
        let label = Label::new(&self.text, origin + self.anchor, self.height);
        label.with_direction(self.direction).with_align(self.align)
    }
}

impl AnnotationShape {
    /// Returns the area that the shape covers, without the width of its lines.
    fn extent(&self) -> Option<Extent> {
        match self {
            Self::Line(ends) => extent_of_points(ends.iter().copied()),
            Self::Path(points) | Self::Loop(points) => extent_of_points(points.iter().copied()),
            Self::Head(corners) => extent_of_points(corners.iter().copied()),
            Self::Text(text) => {
                let strokes = text.label(DVec2::ZERO).strokes();
                extent_of_points(
                    strokes.iter().flat_map(|line| &line.points).copied().map(to_millimeters),
                )
            }
        }
    }

    /// Whether the shape, with bounds `extent`, enters a rectangle.
    fn touches(&self, extent: Option<Extent>, area: Extent) -> bool {
        match self {
            Self::Line(ends) => segment_crosses(*ends, area),
            Self::Path(points) => {
                points.windows(2).any(|pair| segment_crosses([pair[0], pair[1]], area))
            }
            Self::Loop(points) => {
                let next = points.iter().cycle().skip(1);
                points.iter().zip(next).any(|(a, b)| segment_crosses([*a, *b], area))
            }
            _ => extent.is_some_and(|extent| overlap(extent, area)),
        }
    }
}

impl AnnotationShape {
    /// Returns the shape as a group, with the center of the view at `origin`.
    fn group(&self, origin: DVec2) -> Group {
        let line = |points: &[DVec2], closed: bool| {
            let moved: Vec<DVec2> = points.iter().map(|point| origin + *point).collect();
            Polyline::through_points(&moved, closed).into_iter().collect()
        };
        match self {
            Self::Line(ends) => Group { strokes: line(ends, false), ..Group::default() },
            Self::Path(points) => Group { strokes: line(points, false), ..Group::default() },
            Self::Loop(points) => Group { strokes: line(points, true), ..Group::default() },
            Self::Head(corners) => Group { fills: line(corners, true), ..Group::default() },
            Self::Text(text) => text.label(origin).group(),
        }
    }
}

impl ViewAnnotations {
    /// Adds a shape.
    pub(super) fn push(&mut self, layer: AnnotationLayer, shape: AnnotationShape) {
        let extent = shape.extent();
        self.items.push(PlacedShape { layer, shape, extent });
    }

    /// Adds a straight line.
    pub(super) fn push_line(&mut self, layer: AnnotationLayer, ends: [DVec2; 2]) {
        self.push(layer, AnnotationShape::Line(ends));
    }

    /// Adds the first candidate that touches neither another annotation nor the object. If there is
    /// no such candidate, adds the first one anyway.
    pub(super) fn push_first_free_text(
        &mut self,
        layer: AnnotationLayer,
        candidates: impl IntoIterator<Item = AnnotationText>,
        object: Extent,
    ) {
        let mut first = None;
        for text in candidates {
            if self.is_free(&text, object) {
                return self.push(layer, AnnotationShape::Text(text));
            }
            first.get_or_insert(text);
        }
        first.into_iter().for_each(|text| self.push(layer, AnnotationShape::Text(text)));
    }

    /// Whether text touches neither another annotation nor the object.
    pub(super) fn is_free(&self, text: &AnnotationText, object: Extent) -> bool {
        let clearance = 0.25 * text.height;
        AnnotationShape::Text(text.clone()).extent().is_some_and(|[low, high]| {
            self.is_empty_area([low - clearance, high + clearance], object)
        })
    }

    /// Whether neither the object nor an annotation enters a rectangle.
    pub(super) fn is_empty_area(&self, area: Extent, object: Extent) -> bool {
        !overlap(object, area)
            && !self.shapes_with_extents().any(|(other, extent)| other.touches(extent, area))
    }

    /// Whether a line touches neither text nor arrowheads.
    pub(super) fn is_clear(&self, line: [DVec2; 2]) -> bool {
        let lies_across = |(shape, extent): (&AnnotationShape, Option<Extent>)| {
            matches!(shape, AnnotationShape::Text(_) | AnnotationShape::Head(_))
                && extent.is_some_and(|[low, high]| {
                    segment_crosses(line, [low - LINE_CLEARANCE, high + LINE_CLEARANCE])
                })
        };
        !self.shapes_with_extents().any(lies_across)
    }

    /// Returns the rectangle around the object and all annotations.
    pub(super) fn extent_with(&self, object: Extent) -> Extent {
        let extents = self.shapes_with_extents().filter_map(|(_, extent)| extent);
        extents.fold(object, |[low, high], other| [low.min(other[0]), high.max(other[1])])
    }

    /// Returns the rectangle around the object and the requested dimensions.
    pub(super) fn extent_of_dimensions(&self, object: Extent) -> Extent {
        let shapes = self.dimensions.iter().flat_map(|dimension| &dimension.shapes);
        let extents = shapes.filter_map(|(_, shape)| shape.extent());
        extents.fold(object, |[low, high], other| [low.min(other[0]), high.max(other[1])])
    }

    /// Adds a requested dimension.
    pub(super) fn push_dimension(&mut self, dimension: PlacedDimension) {
        self.dimensions.push(dimension);
    }

    /// Returns all shapes, with dimensions last.
    pub(super) fn shapes(&self) -> impl Iterator<Item = &AnnotationShape> {
        let of_dimensions = self.dimensions.iter().flat_map(|dimension| &dimension.shapes);
        self.items.iter().map(|placed| &placed.shape).chain(of_dimensions.map(|(_, shape)| shape))
    }

    /// Returns all shapes with their bounding rectangles, with dimensions last.
    fn shapes_with_extents(&self) -> impl Iterator<Item = (&AnnotationShape, Option<Extent>)> {
        let of_dimensions = self.dimensions.iter().flat_map(|dimension| &dimension.shapes);
        let of_dimensions = of_dimensions.map(|(_, shape)| (shape, shape.extent()));
        self.items.iter().map(|placed| (&placed.shape, placed.extent)).chain(of_dimensions)
    }

    /// Returns the annotations of one layer as groups, with the center of the view at `origin`.
    pub(super) fn groups(
        &self,
        layer: AnnotationLayer,
        origin: DVec2,
    ) -> impl Iterator<Item = Group> {
        let of_layer = self.items.iter().filter(move |placed| placed.layer == layer);
        let own = self.dimensions.iter().flat_map(move |one| one.groups(layer, origin));
        of_layer.map(move |placed| placed.shape.group(origin)).chain(own)
    }
}

impl PlacedDimension {
    /// Returns the shapes of one layer: a group with all lines, and a group for each text.
    ///
    /// The group ids are the number of the dimension, followed by the index of the text if the
    /// dimension has several.
    fn groups(&self, layer: AnnotationLayer, origin: DVec2) -> Vec<Group> {
        let of_layer = self.shapes.iter().filter(|(other, _)| *other == layer);
        let (mut lines, mut groups) = (Group::default(), Vec::new());
        for (_, shape) in of_layer {
            let group = shape.group(origin);
            if let AnnotationShape::Text(_) = shape {
                groups.push(group);
            } else {
                lines.strokes.extend(group.strokes);
                lines.fills.extend(group.fills);
            }
        }
        let texts = groups.len();
        for (group, index) in groups.iter_mut().zip(1..) {
            let own = self.number;
            group.id = if texts > 1 { format!("{own}-{index}") } else { own.to_string() };
        }
        if !(lines.strokes.is_empty() && lines.fills.is_empty()) {
            lines.id = self.number.to_string();
            groups.push(lines);
        }
        groups
    }
}

impl AnnotationLayer {
    /// All layers in drawing order.
    pub(super) const ALL: [Self; 13] = [
        Self::SymmetryLines,
        Self::ViewMarks,
        Self::ViewNames,
        Self::CenterLines,
        Self::CutLines,
        Self::CutEnds,
        Self::CutArrows,
        Self::CutNames,
        Self::Dimensions,
        Self::DimensionTexts,
        Self::ScaleNotes,
        Self::OverlayLines,
        Self::OverlayTexts,
    ];

    /// Creates an empty layer, whose pen depends on the line group or the character height.
    pub(super) fn to_layer(self, group: page::IsoLineGroup, letters: f64, ink: Ink) -> Layer {
        // Butt caps end exactly at the measured point. Round caps would extend beyond it.
        let butt = |width| Pen { cap: page::Cap::Butt, ..Pen::solid(width, ink) };
        let chain = || {
            page::LineType::LongDashedDotted.to_pen(
                group.narrow_width(),
                ink,
                page::Cap::Butt,
                page::Join::Miter,
            )
        };
        // In ISO 3098 type B, lines are a tenth of the character height wide.
        let lettering = || Pen::solid(letters * 0.1, ink);
        let (id, title, pen) = match self {
            Self::CenterLines => ("center-lines", "center lines", chain()),
            Self::CutLines => ("cut-lines", "cutting lines", chain()),
            Self::CutEnds => ("cut-ends", "cutting line ends", butt(group.wide_width())),
            Self::CutArrows => ("cut-arrows", "cutting line arrows", butt(group.lettering_width())),
            Self::CutNames => {
                ("cut-names", "section names", Pen::solid(group.lettering_width(), ink))
            }
            Self::Dimensions => ("dimensions", "dimensions", butt(group.narrow_width())),
            Self::DimensionTexts => ("dimensions-text", "dimensions: text", lettering()),
            Self::ScaleNotes => ("other-scale", "view scales", lettering()),
            Self::SymmetryLines => ("symmetry-lines", "lines of symmetry", chain()),
            Self::ViewMarks => ("view-marks", "view marks", butt(group.narrow_width())),
            Self::OverlayLines => ("overlay-lines", "overlays", butt(group.narrow_width())),
            Self::OverlayTexts => ("overlay-text", "overlays: text", lettering()),
            Self::ViewNames => {
                ("view-names", "view names", Pen::solid(group.lettering_width(), ink))
            }
        };
        Layer::new(id, title, pen)
    }
}

/// Returns the rectangle around points, or `None` if there are none.
fn extent_of_points(points: impl Iterator<Item = DVec2>) -> Option<Extent> {
    points.fold(None, |extent: Option<Extent>, point| {
        Some(extent.map_or([point; 2], |[low, high]| [low.min(point), high.max(point)]))
    })
}

/// Whether two rectangles overlap in more than an edge.
pub(super) fn overlap(a: Extent, b: Extent) -> bool {
    a[0].x < b[1].x && b[0].x < a[1].x && a[0].y < b[1].y && b[0].y < a[1].y
}

/// Whether a straight line enters a rectangle (the Liang–Barsky slab test).
fn segment_crosses([a, b]: [DVec2; 2], [low, high]: Extent) -> bool {
    let mut span = [0.0_f64, 1.0_f64];
    for axis in 0..2 {
        let (from, step) = (a[axis], b[axis] - a[axis]);
        if step == 0.0 {
            if from <= low[axis] || from >= high[axis] {
                return false;
            }
            continue;
        }
        let (s, t) = ((low[axis] - from) / step, (high[axis] - from) / step);
        span = [span[0].max(s.min(t)), span[1].min(s.max(t))];
    }
    span[0] < span[1]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_avoids_lines_and_the_object() {
        let object = [DVec2::splat(-10.0), DVec2::splat(10.0)];
        let mut annotations = ViewAnnotations::default();
        let below = DVec2::new(0.0, 14.0);
        annotations.push_line(
            AnnotationLayer::Dimensions,
            [below - DVec2::X * 9.0, below + DVec2::X * 9.0],
        );
        let text = |y: f64| AnnotationText::centered("A-A", DVec2::new(0.0, y), 3.5);
        annotations.push_first_free_text(
            AnnotationLayer::CutNames,
            [text(0.0), text(11.0), text(14.0), text(20.0), text(30.0)],
            object,
        );
        let [low, high] = annotations.extent_with(object);
        assert!(low == object[0] && (21.0..23.0).contains(&high.y), "{low} {high}");
    }

    #[test]
    fn lines_whose_boxes_overlap_a_rectangle_may_miss_it() {
        let area = [DVec2::ZERO, DVec2::ONE];
        let at = |x: f64, y: f64| DVec2::new(x, y);
        assert!(segment_crosses([at(-1.0, 0.5), at(2.0, 0.5)], area));
        assert!(segment_crosses([at(0.2, 0.2), at(0.3, 0.3)], area));
        assert!(!segment_crosses([at(-1.0, 0.5), at(0.5, 2.5)], area));
        assert!(!segment_crosses([at(1.0, -1.0), at(1.0, 2.0)], area));
    }
}
