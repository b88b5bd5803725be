//! Dimension board: places dimensions one by one in the free space around a view.
//!
//! ```text
//!        │◄── 80 ──►│          a number touches neither the part (its convex hull) nor a line nor
//!      ┌─┴──────────┴─┐        another number. Extension lines may cross the part and other lines,
//!      │    part      │        but not numbers
//!      └──────────────┘
//! ```

use super::annotation::{AnnotationLayer, AnnotationShape, PlacedDimension, ViewAnnotations};
use super::collision::{convex_overlap, convex_parts};
use super::dimension::DimensionSettings;
use super::measure::{ViewDimension, ViewMeasure};
use glam::DVec2;

/// The margin around text, in character heights.
const TEXT_MARGIN: f64 = 0.2;

/// The margin between text and the lines of the same dimension, in character heights.
const OWN_MARGIN: f64 = 0.15;

/// The minimum distance between parallel dimension lines, in character heights.
const LINE_SPACING: f64 = 1.8;

/// A shape with its layer.
pub(super) type LayeredShape = (AnnotationLayer, AnnotationShape);

/// A dimension at a candidate position.
#[derive(Clone, Debug, Default)]
pub(super) struct Candidate {
    pub(super) shapes: Vec<LayeredShape>,
    /// The dimension line, if it is straight.
    pub(super) span: Option<[DVec2; 2]>,
}

/// The space around a view. Coordinates are in millimeters on paper, relative to the view's center.
#[derive(Clone, Debug)]
pub(super) struct DimensionBoard {
    /// The convex hull of the object.
    pub(super) hull: Vec<DVec2>,
    pub(super) settings: DimensionSettings,
    /// The convex parts of lines and arrowheads.
    lines: Vec<Vec<DVec2>>,
    /// The convex outlines of text, with their margin.
    texts: Vec<Vec<DVec2>>,
    /// The dimension lines.
    spans: Vec<[DVec2; 2]>,
}

impl Candidate {
    /// Whether the candidate's text is clear of its lines and of its other text.
    fn is_legible(&self, margin: f64) -> bool {
        let parts: Vec<(bool, Vec<DVec2>)> = self
            .shapes
            .iter()
            .flat_map(|(_, shape)| {
                let is_text = matches!(shape, AnnotationShape::Text(_));
                convex_parts(shape, margin).into_iter().map(move |part| (is_text, part))
            })
            .collect();
        let texts = parts.iter().enumerate().filter(|(_, (is_text, _))| *is_text);
        texts.into_iter().all(|(at, (_, text))| {
            let others = parts.iter().enumerate().filter(|(other, _)| *other != at);
            !others
                .into_iter()
                .any(|(_, (_, other))| boxes_overlap(text, other) && convex_overlap(text, other))
        })
    }

    /// Adds a shape.
    pub(super) fn push(&mut self, layer: AnnotationLayer, shape: AnnotationShape) {
        self.shapes.push((layer, shape));
    }

    /// Adds a straight line of a dimension.
    pub(super) fn push_line(&mut self, ends: [DVec2; 2]) {
        self.push(AnnotationLayer::Dimensions, AnnotationShape::Line(ends));
    }
}

impl DimensionBoard {
    /// Creates a board with the space that existing annotations and `reserved` lines leave free.
    pub(super) fn new(
        annotations: &ViewAnnotations,
        hull: Vec<DVec2>,
        reserved: Vec<[DVec2; 2]>,
        settings: DimensionSettings,
    ) -> Self {
        let lines = reserved.into_iter().map(|line| line.to_vec()).collect();
        let mut board = Self { hull, settings, lines, texts: Vec::new(), spans: Vec::new() };
        annotations.shapes().for_each(|shape| board.add_shape(shape));
        board
    }

    /// Returns the margin around text in millimeters.
    fn text_margin(&self) -> f64 {
        TEXT_MARGIN * self.settings.letters
    }

    /// Marks the space of a shape as occupied.
    fn add_shape(&mut self, shape: &AnnotationShape) {
        let parts = convex_parts(shape, self.text_margin());
        match shape {
            AnnotationShape::Text(_) => self.texts.extend(parts),
            _ => self.lines.extend(parts),
        }
    }

    /// Keeps text clear of a line that will be added later.
    pub(super) fn reserve_line(&mut self, line: [DVec2; 2]) {
        self.lines.push(line.to_vec());
    }

    /// Whether a candidate is clear of everything that it must avoid.
    pub(super) fn is_free(&self, candidate: &Candidate) -> bool {
        let margin = self.text_margin();
        let is_shape_free = |shape: &AnnotationShape| {
            let is_text = matches!(shape, AnnotationShape::Text(_));
            convex_parts(shape, margin).iter().all(|part| {
                let meets =
                    |other: &Vec<DVec2>| boxes_overlap(part, other) && convex_overlap(part, other);
                let meets_line =
                    || convex_overlap(part, &self.hull) || self.lines.iter().any(meets);
                !(self.texts.iter().any(meets) || is_text && meets_line())
            })
        };
        let is_span_free = candidate.span.is_none_or(|span| {
            let beside = |other: &[DVec2; 2]| self.run_beside(span, *other);
            !self.spans.iter().any(beside)
        });
        is_span_free
            && candidate.is_legible(OWN_MARGIN * self.settings.letters)
            && candidate.shapes.iter().all(|(_, shape)| is_shape_free(shape))
    }

    /// Whether two dimension lines are so close that they could be mistaken for one.
    fn run_beside(&self, a: [DVec2; 2], b: [DVec2; 2]) -> bool {
        let along = (a[1] - a[0]).normalize_or(DVec2::X);
        let other = (b[1] - b[0]).normalize_or(DVec2::X);
        let distance = (b[0] - a[0]).perp_dot(along).abs();
        let reach = |ends: [DVec2; 2]| {
            let [s, t] = ends.map(|end| end.dot(along));
            [s.min(t), s.max(t)]
        };
        let ([low, high], [other_low, other_high]) = (reach(a), reach(b));
        along.perp_dot(other).abs() < 0.2
            && distance < LINE_SPACING * self.settings.letters
            && low < other_high
            && other_low < high
    }

    /// Marks the space of a candidate as occupied.
    pub(super) fn take(&mut self, candidate: &Candidate) {
        candidate.shapes.iter().for_each(|(_, shape)| self.add_shape(shape));
        self.spans.extend(candidate.span);
    }

    /// Places dimensions: lengths first, from the shortest to the longest, then angles, then
    /// circles.
    pub(super) fn place_all(
        &mut self,
        dimensions: &[ViewDimension],
        annotations: &mut ViewAnnotations,
    ) {
        let mut order: Vec<&ViewDimension> = dimensions.iter().collect();
        order.sort_by(|a, b| {
            let (a_key, b_key) = (rank(a), rank(b));
            a_key.0.cmp(&b_key.0).then(a_key.1.total_cmp(&b_key.1)).then(a.number.cmp(&b.number))
        });
        for dimension in order {
            let places: Option<Vec<Candidate>> = self.candidates(dimension).into_iter().collect();
            let places = places.unwrap_or_default();
            places.iter().for_each(|candidate| self.take(candidate));
            let shapes: Vec<LayeredShape> =
                places.into_iter().flat_map(|candidate| candidate.shapes).collect();
            if shapes.is_empty() {
                annotations.left_out.push(dimension.name.clone());
            } else {
                annotations.push_dimension(PlacedDimension { number: dimension.number, shapes });
            }
        }
    }

    /// Returns a free position for a dimension, or one for each of its lengths.
    fn candidates(&self, dimension: &ViewDimension) -> Vec<Option<Candidate>> {
        match &dimension.measure {
            ViewMeasure::Lengths { .. } => self.length_candidates(dimension),
            ViewMeasure::Round { .. } => vec![self.leader_candidate(dimension)],
            ViewMeasure::Angle { .. } => vec![self.angle_candidate(dimension)],
        }
    }

    /// Formats a length, given in object millimeters, in the unit of the sheet.
    pub(super) fn length_text(&self, dimension: &ViewDimension, millimeters: f64) -> String {
        self.settings.format.with_decimals(dimension.decimals).text(millimeters)
    }
}

/// Returns the sort key for the order in which dimensions are placed.
fn rank(dimension: &ViewDimension) -> (u8, f64) {
    match &dimension.measure {
        ViewMeasure::Lengths { feet, along, .. } => {
            let places = feet.iter().map(|foot| foot.dot(*along));
            let [low, high] = places.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], at| {
                [low.min(at), high.max(at)]
            });
            (0, high - low)
        }
        ViewMeasure::Angle { .. } => (1, 0.0),
        ViewMeasure::Round { radius, .. } => (2, -radius),
    }
}

/// Whether the boxes around points overlap: a cheap test that usually fails.
fn boxes_overlap(a: &[DVec2], b: &[DVec2]) -> bool {
    let around = |points: &[DVec2]| {
        let far = DVec2::splat(f64::INFINITY);
        points.iter().fold((far, -far), |(low, high), point| (low.min(*point), high.max(*point)))
    };
    let ((low, high), (other_low, other_high)) = (around(a), around(b));
    low.cmple(other_high).all() && other_low.cmple(high).all()
}
