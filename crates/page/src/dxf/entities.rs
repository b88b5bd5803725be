//! DXF entities: lines, arcs, text and hatches in drawing coordinates.

use super::DxfOptions;
use super::layers::escape_unicode;
use super::skeleton::{FIRST_ENTITY, MODEL_SPACE};
use super::tags::TagWriter;
use crate::page::{Group, GroupContent, HatchArea, PagePoint, Polyline, TextLine};
use arcs::{ArcVertex, Circle, LineShape, recognize_arcs};
use glam::DVec2;

/// Millimeters per micrometer.
const MICROMETER: f64 = 1e-3;

/// A rectangle, as its lower left and upper right corners.
pub(super) type Extents = [DVec2; 2];

/// Returns the smallest rectangle around points.
pub(super) fn bounds_of(points: impl IntoIterator<Item = DVec2>) -> Extents {
    let far = DVec2::splat(f64::INFINITY);
    points.into_iter().fold([far, -far], |[low, high], point| [low.min(point), high.max(point)])
}

/// Writes entities, assigns their handles, and computes their bounds.
#[derive(Debug)]
pub(super) struct EntityWriter {
    tags: TagWriter,
    /// The handle of the next entity.
    handle: u32,
    /// The scale factor for the line type of the entities.
    line_type_scale: f64,
    /// The bounds of all points so far.
    bounds: Extents,
    options: DxfOptions,
}

impl EntityWriter {
    /// Creates a writer without entities.
    pub(super) fn new(options: &DxfOptions) -> Self {
        let bounds = bounds_of([]);
        Self {
            tags: TagWriter::default(),
            handle: FIRST_ENTITY,
            line_type_scale: 1.0,
            bounds,
            options: *options,
        }
    }

    /// Returns the entities and the first unused handle.
    pub(super) fn finish(self) -> (TagWriter, u32) {
        (self.tags, self.handle)
    }

    /// Returns the rectangle around all entities, or `None` if there are none.
    pub(super) fn bounds(&self) -> Option<Extents> {
        (self.bounds[0].x <= self.bounds[1].x).then_some(self.bounds)
    }

    /// Converts a page point to drawing coordinates.
    pub(super) fn place(&self, point: PagePoint) -> DVec2 {
        self.place_exactly(DVec2::new(f64::from(point[0]), f64::from(point[1])))
    }

    /// Converts a point in micrometers, which may be off the page grid, to drawing coordinates.
    ///
    /// Coordinates are divided by 1000, not multiplied by 0.001, so that coordinates on paper have
    /// the same decimals as in the other formats.
    fn place_exactly(&self, micrometers: DVec2) -> DVec2 {
        let origin = self.options.origin * 1000.0;
        let up = DVec2::new(micrometers.x - origin.x, origin.y - micrometers.y) / 1000.0;
        up * self.options.units_per_millimeter
    }

    /// Converts a length in micrometers to drawing units.
    fn length(&self, micrometers: f64) -> f64 {
        micrometers / 1000.0 * self.options.units_per_millimeter
    }

    /// Begins an entity on a layer.
    fn begin(&mut self, kind: &str, layer: &str, class: &str) {
        self.tags.tag(0, kind);
        self.tags.handle(5, self.handle);
        self.handle += 1;
        self.tags.handle(330, MODEL_SPACE);
        self.tags.tag(100, "AcDbEntity");
        self.tags.tag(8, layer);
        if self.line_type_scale != 1.0 {
            self.tags.number(48, self.line_type_scale);
        }
        self.tags.tag(100, class);
    }

    /// Extends the bounds by points.
    fn include(&mut self, points: impl IntoIterator<Item = DVec2>) {
        let [low, high] = bounds_of(points);
        self.bounds = [self.bounds[0].min(low), self.bounds[1].max(high)];
    }

    /// Writes a group of the page, with its line type scaled by a factor. Text or hatching replaces
    /// the strokes.
    pub(super) fn write_group(&mut self, layer: &str, line_type_scale: f64, group: &Group) {
        self.line_type_scale = line_type_scale;
        match &group.content {
            GroupContent::Lines => {
                for line in &group.strokes {
                    self.write_line(layer, line);
                }
            }
            GroupContent::Text(text) => self.write_text(layer, text),
            GroupContent::Hatching(areas) => {
                for area in areas {
                    self.write_hatch(layer, &area.loops, Some(area));
                }
            }
        }
        if !group.fills.is_empty() {
            self.write_hatch(layer, &group.fills, None);
        }
    }

    /// Writes a line of the page as a circle, an arc, a line or a polyline.
    fn write_line(&mut self, layer: &str, line: &Polyline) {
        let tolerance = self.options.arc_tolerance / MICROMETER;
        match recognize_arcs(&line.points, line.closed, tolerance) {
            LineShape::Circle(circle) => {
                self.begin("CIRCLE", layer, "AcDbCircle");
                self.write_circle(circle);
            }
            LineShape::Arc(circle, [start, end]) => {
                self.begin("ARC", layer, "AcDbCircle");
                self.write_circle(circle);
                self.tags.tag(100, "AcDbArc");
                // With y up, angles change sign and arcs change direction.
                for (code, angle) in [(50, -end), (51, -start)] {
                    self.tags.number(code, degrees_within(angle, 360.0, 1e9));
                }
                self.include(
                    line.points.iter().map(|point| self.place(*point)).collect::<Vec<_>>(),
                );
            }
            LineShape::Path(vertices, closed) => self.write_path(layer, &vertices, closed),
        }
    }

    /// Writes the center and the radius of a circle.
    fn write_circle(&mut self, circle: Circle) {
        let (center, radius) = (self.place_exactly(circle.center), self.length(circle.radius));
        self.tags.point_in_space(10, center);
        self.tags.number(40, radius);
        self.include([center - radius, center + radius]);
    }

    /// Writes a polyline, or a line if it is a single straight segment.
    fn write_path(&mut self, layer: &str, vertices: &[ArcVertex], closed: bool) {
        let placed: Vec<DVec2> =
            vertices.iter().map(|vertex| self.place_exactly(vertex.point)).collect();
        if let ([from, to], false) = (&placed[..], closed)
            && vertices[0].bulge == 0.0
        {
            self.begin("LINE", layer, "AcDbLine");
            self.tags.point_in_space(10, *from);
            self.tags.point_in_space(11, *to);
        } else {
            self.begin("LWPOLYLINE", layer, "AcDbPolyline");
            self.tags.tag(90, vertices.len());
            // 128: line types continue around vertices.
            self.tags.tag(70, 128 + u8::from(closed));
            self.write_vertices(vertices, &placed, false);
        }
        self.include(placed);
    }

    /// Writes the vertices of a polyline. Bulges of 0 are omitted unless `always` is set.
    fn write_vertices(&mut self, vertices: &[ArcVertex], placed: &[DVec2], always: bool) {
        for (vertex, point) in vertices.iter().zip(placed) {
            self.tags.point(10, *point);
            if always || vertex.bulge != 0.0 {
                // With y up, arcs turn the opposite way.
                self.tags.number(42, -vertex.bulge);
            }
        }
    }

    /// Writes text fitted between the ends of its baseline, so that it has the same width in every
    /// font.
    fn write_text(&mut self, layer: &str, line: &TextLine) {
        if line.text.trim().is_empty() {
            return;
        }
        let [start, end] = line.baseline.map(|point| self.place(point));
        let along = end - start;
        let height = self.length(f64::from(line.height));
        self.begin("TEXT", layer, "AcDbText");
        self.tags.point_in_space(10, start);
        self.tags.number(40, height);
        self.tags.tag(1, escape_text(&line.text));
        self.tags.number(50, libm::atan2(along.y, along.x).to_degrees());
        // A single narrow character has no width to fit.
        let is_fitted = along.length() > 0.05 * height;
        self.tags.tag(72, if is_fitted { 5 } else { 0 });
        if is_fitted {
            self.tags.point_in_space(11, end);
        }
        self.tags.tag(100, "AcDbText");
        self.tags.tag(73, 0);
        let up = along.perp().normalize_or(DVec2::Y) * height;
        self.include([start, end, start + up, end + up]);
    }

    /// Writes a hatch: the pattern of an area, or a solid fill.
    fn write_hatch(&mut self, layer: &str, loops: &[Polyline], area: Option<&HatchArea>) {
        self.begin("HATCH", layer, "AcDbHatch");
        self.tags.point_in_space(10, DVec2::ZERO);
        self.tags.tags("210=0.0|220=0.0|230=1.0");
        self.tags.tag(2, if area.is_some() { "ANSI31" } else { "SOLID" });
        self.tags.tag(70, u8::from(area.is_none()));
        self.tags.tag(71, 0);
        self.tags.tag(91, loops.len());
        for (index, line) in loops.iter().enumerate() {
            self.write_hatch_loop(line, index == 0);
        }
        self.tags.tag(75, 0);
        match area {
            Some(area) => self.write_pattern(area),
            None => self.tags.tags("76=1"),
        }
        self.tags.tag(98, 0);
    }

    /// Writes a boundary loop of a hatch; the first loop is external.
    fn write_hatch_loop(&mut self, line: &Polyline, is_first: bool) {
        let vertices: Vec<ArcVertex> = match recognize_arcs(&line.points, line.closed, 0.0) {
            LineShape::Path(vertices, _) => vertices,
            LineShape::Circle(_) | LineShape::Arc(..) => Vec::new(),
        };
        let placed: Vec<DVec2> =
            vertices.iter().map(|vertex| self.place_exactly(vertex.point)).collect();
        self.tags.tag(92, if is_first { 3 } else { 2 });
        self.tags.tags("72=0|73=1");
        self.tags.tag(93, vertices.len());
        self.write_vertices(&vertices, &placed, false);
        self.tags.tag(97, 0);
        self.include(placed);
    }

    /// Writes the pattern of a hatch: one family of parallel continuous lines.
    fn write_pattern(&mut self, area: &HatchArea) {
        let along = DVec2::new(area.direction.x, -area.direction.y);
        // The angle is rounded, because a view's scales in x and y differ slightly: its size is
        // rounded to whole pixels.
        let angle = degrees_within(libm::atan2(along.y, along.x), 180.0, 1e5);
        let spacing = area.spacing * self.options.units_per_millimeter;
        // The lines of the predefined pattern rise at 45° with a spacing of 3.175 mm, so it is
        // rotated and scaled.
        self.tags.tag(76, 1);
        self.tags.number(52, if angle < 45.0 { angle + 135.0 } else { angle - 45.0 });
        self.tags.number(41, spacing / 3.175);
        self.tags.tags("77=0|78=1");
        self.tags.number(53, angle);
        let base = self.place(area.origin);
        self.tags.number(43, base.x);
        self.tags.number(44, base.y);
        let offset = along.perp() * spacing;
        self.tags.number(45, offset.x);
        self.tags.number(46, offset.y);
        self.tags.tag(79, 0);
    }
}

/// Returns an angle in degrees, rounded to 1/`parts` of a degree, from 0 to less than a period.
fn degrees_within(radians: f64, period: f64, parts: f64) -> f64 {
    let degrees = libm::round(radians.to_degrees() * parts) / parts;
    degrees - period * libm::floor(degrees / period)
}

/// Escapes sequences that readers would interpret as codes, such as `%%` or `^`.
fn escape_text(text: &str) -> String {
    let text = if text.contains("%%") { text.replace('%', "%%%") } else { text.to_owned() };
    escape_unicode(&text.replace('^', "^ "))
}
