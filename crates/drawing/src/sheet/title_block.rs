//! Title block (ISO 7200): title, author, scale and other fields in the lower right corner of a
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
use super::{Sheet, rectangle_from_size};
use crate::{Cap, Group, Ink, Join, Label, Layer, Pen, Polyline};
use glam::DVec2;
use viewport::{DrawingScale, Rectangle};

/// Width of the block where the paper is wide enough, and its height, in millimeters.
const BLOCK_SIZE: [f64; 2] = [180.0, 32.0];

/// The height of letters of field names, in millimeters.
const NAME_HEIGHT: f64 = 1.8;
/// The height of letters of field values, in millimeters.
const VALUE_HEIGHT: f64 = 3.5;
/// The height of letters of the title, in millimeters.
const TITLE_HEIGHT: f64 = 5.0;

/// The distance from the border of a field to its text, in millimeters.
const FIELD_INSET: f64 = 1.5;

/// A field: its extent as fractions of the block, its name, and its value.
struct TitleBlockField<'a> {
    x: [f64; 2],
    y: [f64; 2],
    name: &'a str,
    value: String,
    height: f64,
}

impl TitleBlockField<'_> {
    /// Width and height of the field in a block, in millimeters.
    fn size(&self, block: Rectangle) -> DVec2 {
        self.corner(block, 1) - self.corner(block, 0)
    }

    /// The upper left (0) or lower right (1) corner of the field in a block.
    fn corner(&self, block: Rectangle, end: usize) -> DVec2 {
        let (x, y) = (self.x[end], self.y[end]);
        DVec2::new(block.x() + x * block.width(), block.y() + y * block.height())
    }

    /// The rectangle of the field in a block.
    fn cell(&self, block: Rectangle) -> Rectangle {
        let (corner, size) = (self.corner(block, 0), self.size(block));
        rectangle_from_size(corner.x, corner.y, size.x, size.y)
    }
}

/// The area of the block within the frame.
pub(super) fn title_block_area(frame: Rectangle) -> Rectangle {
    let width = BLOCK_SIZE[0].min(frame.width());
    let height = BLOCK_SIZE[1].min(frame.height() * 0.3);
    let (right, bottom) = (frame.x() + frame.width(), frame.y() + frame.height());
    rectangle_from_size(right - width, bottom - height, width, height)
}

/// The borders, the lettering in its three widths, and the projection symbol.
///
/// Text that is too wide for its field is reduced in height. On small paper the block shrinks, and
/// letters with it.
pub(super) fn title_block_layers(
    sheet: &Sheet,
    title: &str,
    scale: Option<DrawingScale>,
    area: Rectangle,
    ink: Ink,
) -> Vec<Layer> {
    let fields = title_block_fields(sheet, title, scale);
    let border = |width| Pen { cap: Cap::Butt, join: Join::Miter, ..Pen::solid(width, ink) };
    let mut borders = Layer::new("title-block", "title block", border(0.35));
    borders.groups.push(Group { strokes: vec![rectangle_outline(area)], ..Group::default() });
    let mut names = Layer::new("title-block-names", "title block: names", Pen::solid(0.18, ink));
    let heading = Pen::solid(0.5, ink);
    let mut heading = Layer::new("title-block-title", "title block: title", heading);
    let mut values = Layer::new("title-block-text", "title block: text", Pen::solid(0.35, ink));
    for field in &fields {
        let cell = field.cell(area);
        let (corner, size) = (field.corner(area, 0), field.size(area));
        borders.groups[0].strokes.push(rectangle_outline(cell));
        let text_width = size.x - 2.0 * FIELD_INSET;
        let small = NAME_HEIGHT.min(size.y * 0.2);
        let name = Label::new(
            field.name,
            corner + DVec2::new(FIELD_INSET, FIELD_INSET * 0.8 + small),
            small,
        );
        names.groups.push(name.fit_to_width(text_width).group());
        let foot = corner + DVec2::new(FIELD_INSET, size.y - size.y * 0.19);
        let value = Label::new(&field.value, foot, field.height.min(size.y * 0.42));
        let layer = if field.height == TITLE_HEIGHT { &mut heading } else { &mut values };
        layer.groups.push(value.fit_to_width(text_width).group());
        if field.name == PROJECTION_FIELD {
            names.groups.push(symbol_group(sheet, cell));
        }
    }
    vec![borders, names, heading, values]
}

/// The width of the name of the field with the projection symbol, with what is around it, in
/// millimeters.
const PROJECTION_NAME_WIDTH: f64 = 14.5;

/// The name of the field with the projection symbol.
const PROJECTION_FIELD: &str = "Projection";

/// The fields in reading order.
///
/// Columns and rows are fractions of the block, so that it scales with narrow paper.
fn title_block_fields<'a>(
    sheet: &Sheet,
    title: &str,
    scale: Option<DrawingScale>,
) -> Vec<TitleBlockField<'a>> {
    let rows = [[0.0, 0.31], [0.31, 0.69], [0.69, 1.0]];
    let field = |row: usize, from: f64, to: f64, name: &'a str, value: &str| TitleBlockField {
        x: [from, to],
        y: rows[row],
        name,
        value: value.to_owned(),
        height: if row == 1 { TITLE_HEIGHT } else { VALUE_HEIGHT },
    };
    let titles = &sheet.title_block;
    let numbers = titles.sheet.map(|[number, count]| format!("{number}/{count}"));
    let number_end = if numbers.is_some() { 0.87 } else { 1.0 };
    let scale = scale.map(|scale| scale.to_string()).unwrap_or_default();
    let mut fields = vec![
        field(0, 0.0, 0.4, "Author", &titles.author),
        field(0, 0.4, 0.64, "Date", &titles.date),
        field(0, 0.64, number_end, "Number", &titles.number),
        field(1, 0.0, 1.0, "Title", title),
        field(2, 0.0, 0.17, "Scale", &scale),
        field(2, 0.17, 0.31, "Paper", &sheet.paper_name),
        field(2, 0.31, 0.52, "Dimensions in", sheet.dimension_unit.symbol()),
        field(2, 0.52, 0.74, PROJECTION_FIELD, ""),
        field(2, 0.74, 1.0, "Drawn with", "alberti"),
    ];
    fields.extend(numbers.map(|numbers| field(0, number_end, 1.0, "Sheet", &numbers)));
    fields
}

/// The projection symbol in its field, to the right of the field's name.
fn symbol_group(sheet: &Sheet, cell: Rectangle) -> Group {
    // The symbol is three times as wide as it is high.
    let room = cell.width() - PROJECTION_NAME_WIDTH - FIELD_INSET;
    let height = (cell.height() * 0.62).min(room / 3.0).max(1.0);
    let right = cell.x() + cell.width() - FIELD_INSET;
    let middle = DVec2::new(right - 1.5 * height, cell.y() + cell.height() - height * 0.8);
    let strokes: Vec<Polyline> = projection_symbol(sheet.projection_angle, middle, height);
    Group { strokes, ..Group::default() }
}
