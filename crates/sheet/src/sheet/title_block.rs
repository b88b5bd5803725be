//! The title block (ISO 7200): title, author, scale and other fields in the lower right corner of a
//! sheet.
//!
//! ```text
//!   ┌──────────────────┬────────────┬───────────────────────┐
//!   │ Author           │ Date       │ Number                │
//!   ├──────────────────┴────────────┴───────────────────────┤
//!   │ Title                                                 │
//!   ├───────┬───────┬──────────────┬───────────┬────────────┤
//!   │ Scale │ Paper │ Dimensions   │ Projection│ Drawn with │
//!   └───────┴───────┴──────────────┴───────────┴────────────┘
//! ```

use super::frame::rectangle_outline;
use super::projection_symbol::projection_symbol;
use super::title_block_fields::{TitleBlockField, title_block_fields};
use super::title_block_language::{FieldName, TitleBlockLanguage};
use super::{Sheet, rectangle_from_size};
use glam::DVec2;
use page::{Cap, Group, Ink, Join, Label, Layer, Pen, Polyline};
use viewport::{DrawingScale, Rectangle};

/// The width of the block if the paper is wide enough, in millimeters.
const BLOCK_WIDTH: f64 = 180.0;

/// The heights of blocks with three rows and with four rows, in millimeters.
const BLOCK_HEIGHTS: [f64; 2] = [32.0, 48.0];

/// The maximum fractions of the drawing area's height for blocks with three and four rows.
const MOST_OF_HEIGHT: [f64; 2] = [0.3, 0.38];

/// The character height of field names and the width of their strokes, in millimeters.
const NAME_HEIGHT: f64 = 1.8;
const NAME_WIDTH: f64 = 0.18;
/// The height of Chinese field names and the width of their strokes, in millimeters. The characters
/// are larger because they have more strokes than Latin letters.
const CHINESE_NAME: [f64; 2] = [2.5, 0.13];
/// The character height of field values, in millimeters.
const VALUE_HEIGHT: f64 = 3.5;
/// The character height of the title, in millimeters.
const TITLE_HEIGHT: f64 = 5.0;

/// The distance from the border of a field to its text, in millimeters.
const FIELD_INSET: f64 = 1.5;

impl TitleBlockField {
    /// Returns the width and height of the field in a block, in millimeters.
    fn size(&self, block: Rectangle) -> DVec2 {
        self.corner(block, 1) - self.corner(block, 0)
    }

    /// Returns a corner of the field in a block: 0 is the upper left, 1 is the lower right.
    fn corner(&self, block: Rectangle, end: usize) -> DVec2 {
        let (x, y) = (self.x[end], self.y[end]);
        DVec2::new(block.x() + x * block.width(), block.y() + y * block.height())
    }

    /// Returns the rectangle of the field in a block.
    fn cell(&self, block: Rectangle) -> Rectangle {
        let (corner, size) = (self.corner(block, 0), self.size(block));
        rectangle_from_size(corner.x, corner.y, size.x, size.y)
    }

    /// Returns the heights of the first and second value in a field of this height.
    fn value_heights(&self, height: f64) -> [f64; 2] {
        let usual = if self.field == FieldName::Title { TITLE_HEIGHT } else { VALUE_HEIGHT };
        let share = if self.second_value.is_empty() { 0.42 } else { 0.3 };
        [usual.min(height * share), VALUE_HEIGHT.min(height * 0.21)]
    }
}

/// Returns the area of the block within the frame.
pub(super) fn title_block_area(sheet: &Sheet, frame: Rectangle) -> Rectangle {
    if let Some(template) = &sheet.title_block_template {
        return template.area(frame);
    }
    let rows = usize::from(sheet.title_block.has_all_fields());
    let most = frame.height() * MOST_OF_HEIGHT[rows];
    let (width, height) = (BLOCK_WIDTH.min(frame.width()), BLOCK_HEIGHTS[rows].min(most));
    let (right, bottom) = (frame.x() + frame.width(), frame.y() + frame.height());
    rectangle_from_size(right - width, bottom - height, width, height)
}

/// Returns the layers with the borders, the lettering in three stroke widths, and the projection
/// symbol.
///
/// Text that is too wide for its field is reduced in height. On small paper, the block and its
/// characters shrink.
pub(super) fn title_block_layers(
    sheet: &Sheet,
    title: &str,
    scale: Option<DrawingScale>,
    area: Rectangle,
    ink: Ink,
) -> Vec<Layer> {
    if let Some(template) = &sheet.title_block_template {
        return template.layers(sheet, title, scale, area, ink);
    }
    let fields = title_block_fields(sheet, title, scale);
    let border = |width| Pen { cap: Cap::Butt, join: Join::Miter, ..Pen::solid(width, ink) };
    let mut borders = Layer::new("title-block", "title block", border(0.35));
    borders.groups.push(Group { strokes: vec![rectangle_outline(area)], ..Group::default() });
    let [name_height, name_width] = match sheet.title_block.language {
        TitleBlockLanguage::Chinese => CHINESE_NAME,
        TitleBlockLanguage::English | TitleBlockLanguage::German => [NAME_HEIGHT, NAME_WIDTH],
    };
    let names = Pen::solid(name_width, ink);
    let mut names = Layer::new("title-block-names", "title block: names", names);
    let heading = Pen::solid(0.5, ink);
    let mut heading = Layer::new("title-block-title", "title block: title", heading);
    let mut values = Layer::new("title-block-text", "title block: text", Pen::solid(0.35, ink));
    for field in &fields {
        let cell = field.cell(area);
        let (corner, size) = (field.corner(area, 0), field.size(area));
        borders.groups[0].strokes.push(rectangle_outline(cell));
        let text_width = size.x - 2.0 * FIELD_INSET;
        let small = name_height.min(size.y * 0.2 * name_height / NAME_HEIGHT);
        let name = Label::new(
            field.name,
            corner + DVec2::new(FIELD_INSET, FIELD_INSET * 0.8 + small),
            small,
        );
        names.groups.push(name.fit_to_width(text_width).group());
        let [height, second_height] = field.value_heights(size.y);
        let below = if field.second_value.is_empty() { 0.19 } else { 0.14 };
        let foot = corner + DVec2::new(FIELD_INSET, size.y - size.y * below);
        let second = Label::new(&field.second_value, foot, second_height);
        let up = if field.second_value.is_empty() { 0.0 } else { 1.6 * second_height };
        let value = Label::new(&field.value, foot - DVec2::Y * up, height);
        let layer = if field.field == FieldName::Title { &mut heading } else { &mut values };
        layer.groups.push(value.fit_to_width(text_width).group());
        if field.field == FieldName::Projection {
            names.groups.push(symbol_group(sheet, &name, cell));
        }
        if !field.second_value.is_empty() {
            values.groups.push(second.fit_to_width(text_width).group());
        }
    }
    vec![borders, names, heading, values]
}

/// The distance from the field name to the projection symbol, in millimeters.
const SYMBOL_DISTANCE: f64 = 1.4;

/// Returns the projection symbol in its field, to the right of the field's name.
fn symbol_group(sheet: &Sheet, name: &Label<'_>, cell: Rectangle) -> Group {
    // The symbol is three times as wide as it is high.
    let room = cell.width() - 2.0 * FIELD_INSET - name.width() - SYMBOL_DISTANCE;
    let height = (cell.height() * 0.62).min(room / 3.0).max(1.0);
    let right = cell.x() + cell.width() - FIELD_INSET;
    let middle = DVec2::new(right - 1.5 * height, cell.y() + cell.height() - height * 0.8);
    let strokes: Vec<Polyline> = projection_symbol(sheet.projection_angle, middle, height);
    Group { strokes, ..Group::default() }
}
