//! Draws a title block on a sheet from its template.

use super::{FieldValues, TitleBlockTemplate};
use crate::sheet::projection_symbol::projection_symbol;
use crate::sheet::{Sheet, rectangle_from_size};
use glam::DVec2;
use page::{Cap, Group, Ink, Join, Label, Layer, Pen, Polyline, TextAlign};
use std::collections::BTreeMap;
use viewport::{DrawingScale, Rectangle};

/// The maximum fraction of the drawing area's height that a block takes.
const MOST_OF_HEIGHT: f64 = 0.5;

/// The width of the projection symbol as a multiple of its height.
const SYMBOL_WIDTH: f64 = 3.0;

impl TitleBlockTemplate {
    /// Returns the factor that shrinks the block on small paper.
    fn scale_within(&self, frame: Rectangle) -> f64 {
        let most = DVec2::new(frame.width(), frame.height() * MOST_OF_HEIGHT);
        (most / self.size).min_element().min(1.0)
    }

    /// Returns the area of the block, in the lower right corner of the frame.
    pub(in crate::sheet) fn area(&self, frame: Rectangle) -> Rectangle {
        let size = self.size * self.scale_within(frame);
        let high = DVec2::new(frame.x() + frame.width(), frame.y() + frame.height());
        rectangle_from_size(high.x - size.x, high.y - size.y, size.x, size.y)
    }

    /// Returns all text with its fields filled in, to check for characters missing from the font.
    pub(in crate::sheet) fn contents(&self, values: &FieldValues<'_>) -> Vec<String> {
        self.texts.iter().map(|text| text.content(values)).collect()
    }

    /// Returns the lines and text of the block, with one layer for each line width.
    pub(in crate::sheet) fn layers(
        &self,
        sheet: &Sheet,
        title: &str,
        scale: Option<DrawingScale>,
        area: Rectangle,
        ink: Ink,
    ) -> Vec<Layer> {
        let scale = scale.map(|scale| scale.to_string()).unwrap_or_default();
        let values = sheet.field_values(title, &scale);
        let factor = self.scale_within(sheet.drawing_area());
        let corner = DVec2::new(area.x(), area.y());
        let on_sheet = |point: DVec2| corner + point * factor;
        // Widths are in micrometers, so that they can be ordered.
        let mut lines: BTreeMap<u32, Vec<Polyline>> = BTreeMap::new();
        let mut texts: BTreeMap<u32, Vec<Group>> = BTreeMap::new();
        let key = |width: f64| libm::round(width.max(0.0) * 1000.0) as u32;
        for line in &self.lines {
            let points: Vec<DVec2> = line.points.iter().copied().map(on_sheet).collect();
            let placed = Polyline::through_points(&points, line.closed);
            lines.entry(key(line.width * factor)).or_default().extend(placed);
        }
        for text in &self.texts {
            let (anchor, height) = (on_sheet(text.anchor), text.height * factor);
            if text.is_symbol() {
                let part = match text.align {
                    TextAlign::Start => 0.5,
                    TextAlign::Middle => 0.0,
                    TextAlign::End => -0.5,
                };
                let middle = anchor + DVec2::new(part * SYMBOL_WIDTH * height, -0.5 * height);
                let strokes = projection_symbol(sheet.projection_angle, middle, height);
                lines.entry(key(0.1 * height)).or_default().extend(strokes);
                continue;
            }
            let content = text.content(&values);
            let label = Label::new(&content, anchor, height).with_align(text.align);
            let most = text.most_width.map_or(f64::INFINITY, |most| most * factor);
            let label = label.fit_to_width(most);
            if !content.trim().is_empty() {
                texts.entry(key(0.1 * label.height)).or_default().push(label.group());
            }
        }
        let mut layers = Vec::new();
        for (index, (width, strokes)) in lines.into_iter().enumerate() {
            let pen = Pen { cap: Cap::Butt, join: Join::Miter, ..pen_of_width(width, ink) };
            let mut layer = Layer::new(layer_id("title-block", index), "title block", pen);
            layer.groups.push(Group { strokes, ..Group::default() });
            layers.push(layer);
        }
        for (index, (width, groups)) in texts.into_iter().enumerate() {
            let (id, pen) = (layer_id("title-block-text", index), pen_of_width(width, ink));
            layers.push(Layer { groups, ..Layer::new(id, "title block: text", pen) });
        }
        layers
    }
}

/// Returns a pen with a width in micrometers.
fn pen_of_width(width: u32, ink: Ink) -> Pen {
    Pen::solid(f64::from(width) / 1000.0, ink)
}

/// Returns the id of a layer: the name, followed by a number from the second layer on.
fn layer_id(name: &str, index: usize) -> String {
    if index == 0 { name.to_owned() } else { format!("{name}-{}", index + 1) }
}
