//! Parts lists on paper (ISO 7573): a table above the title block, or on separate pages.
//!
//! ```text
//!   │ 2 │ 8 │ bolt M8  │ steel │ 12.3 │      above the title block, the list is read upward,
//!   │ 1 │ 1 │ housing  │ iron  │  812 │      so that it can grow
//!   ├───┼───┼──────────┼───────┼──────┤
//!   │ Item Quantity Name … Mass in g  │
//!   ├───┴───┴──────────┴───────┴──────┤
//!   │ title block                     │
//! ```
//!
//! On a separate page, the list is read downward, column by column.

use super::frame::rectangle_outline;
use super::{Sheet, rectangle_from_size};
use crate::assembly::{PartsList, PartsListItem};
use core::ops::Range;
use glam::DVec2;
use page::{Cap, Group, Ink, Join, Label, Layer, Pen, Polyline, TextAlign};
use viewport::Rectangle;

/// The row height, in character heights.
const ROW_HEIGHT: f64 = 2.3;

/// The distance from the border of a cell to its text, in millimeters.
const INSET: f64 = 1.2;

/// The minimum factor by which text is reduced to fit its cell. Text that is still too wide is
/// truncated.
const LEAST_REDUCTION: f64 = 0.7;

/// The distance from a table on a separate page to the frame and to the title block, in
/// millimeters, enough to clear the centering marks.
const GAP: f64 = 6.0;

/// The layout of a parts list on a sheet.
#[derive(Clone, Copy, Debug)]
pub(super) struct PartsTable<'a> {
    sheet: &'a Sheet,
    list: &'a PartsList,
    letters: f64,
}

/// A column of the table: rows of the list, below or above a heading.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct TableColumn {
    /// The indices of the items.
    pub(super) rows: Range<usize>,
    /// The upper left corner.
    corner: DVec2,
    width: f64,
    /// Whether the heading is at the bottom and the list is read upward.
    is_upward: bool,
}

impl<'a> PartsTable<'a> {
    /// Creates the table of a list on a sheet.
    pub(super) fn new(sheet: &'a Sheet, list: &'a PartsList) -> Self {
        let letters = (sheet.lettering_height() * 0.7).max(2.5);
        Self { sheet, list, letters }
    }

    fn row_height(&self) -> f64 {
        self.letters * ROW_HEIGHT
    }

    /// Returns the height of the given number of rows plus the heading, in millimeters.
    fn height(&self, rows: usize) -> f64 {
        self.row_height() * (rows + 1) as f64
    }

    /// Returns the whole list as a column above the title block, if it is at most `most`
    /// millimeters high.
    pub(super) fn above_title_block(&self, most: f64) -> Option<TableColumn> {
        let (block, rows) = (self.sheet.title_block_area(), self.list.items.len());
        let corner = DVec2::new(block.x(), block.y() - self.height(rows));
        // Stay clear of the centering mark in the middle of the side.
        let is_below_mark = corner.y > 0.5 * self.sheet.paper.height() + 1.0;
        let width = block.width();
        (self.height(rows) <= most && is_below_mark).then_some(TableColumn {
            rows: 0..rows,
            corner,
            width,
            is_upward: true,
        })
    }

    /// Returns the columns on each page of a list on separate pages. There is at least one page.
    ///
    /// Wide paper has additional columns beside the column above the title block.
    pub(super) fn pages(&self) -> Vec<Vec<TableColumn>> {
        let (frame, block) = (self.sheet.drawing_area(), self.sheet.title_block_area());
        // Rounding must not lose a column that fits exactly.
        let beside = ((block.x() - frame.x()) / block.width() + 1e-9).floor() as usize;
        // The heading takes one row. At least one row must remain, or the loop below would not end.
        let rows_in = |height: f64| ((height / self.row_height()).floor() as usize).max(2) - 1;
        let width = (block.width() - 2.0 * GAP).max(0.5 * block.width());
        let inset = 0.5 * (block.width() - width);
        let below = rows_in(frame.height() - 2.0 * GAP);
        let mut column_places: Vec<(f64, usize)> =
            (0..beside).map(|column| (frame.x() + block.width() * column as f64, below)).collect();
        column_places.push((block.x(), rows_in(block.y() - frame.y() - 2.0 * GAP)));
        let count = self.list.items.len();
        let (mut pages, mut next) = (Vec::new(), 0);
        while next < count || pages.is_empty() {
            let mut columns = Vec::new();
            for &(x, most) in &column_places {
                let rows = next..count.min(next + most);
                if !rows.is_empty() || columns.is_empty() {
                    next = rows.end;
                    let corner = DVec2::new(x + inset, frame.y() + GAP);
                    columns.push(TableColumn { rows, corner, width, is_upward: false });
                }
            }
            pages.push(columns);
        }
        pages
    }

    /// Returns the area of a column, including its heading.
    pub(super) fn area(&self, column: &TableColumn) -> Rectangle {
        let [x, y] = column.corner.to_array();
        rectangle_from_size(x, y, column.width, self.height(column.rows.len()))
    }

    /// Returns the layers with the cell borders and the text in the cells.
    pub(super) fn layers(&self, columns: &[TableColumn], ink: Ink) -> [Layer; 2] {
        let pen = Pen { cap: Cap::Butt, join: Join::Miter, ..Pen::solid(0.18, ink) };
        let mut borders = Layer::new("parts-list", "parts list", pen);
        let pen = Pen::solid(self.letters * 0.1, ink);
        let mut texts = Layer::new("parts-list-text", "parts list: text", pen);
        for column in columns {
            borders.groups.push(self.border_group(column));
            let heading = if column.is_upward { column.rows.len() } else { 0 };
            self.add_row(&mut texts, column, heading, &self.headings());
            for (row, item) in self.list.items[column.rows.clone()].iter().enumerate() {
                let row = if column.is_upward { heading - 1 - row } else { row + 1 };
                self.add_row(&mut texts, column, row, &self.texts_of_item(item));
            }
        }
        [borders, texts]
    }

    /// Returns the lines around the rows and between the cells.
    fn border_group(&self, column: &TableColumn) -> Group {
        let area = self.area(column);
        let (left, top) = (area.x(), area.y());
        let (right, bottom) = (left + area.width(), top + area.height());
        let mut strokes = vec![rectangle_outline(area)];
        let mut push = |ends: [DVec2; 2]| strokes.extend(Polyline::through_points(&ends, false));
        for row in 1..=column.rows.len() {
            let y = top + self.row_height() * row as f64;
            push([DVec2::new(left, y), DVec2::new(right, y)]);
        }
        for (start, _) in &self.cells(column.width)[1..] {
            let x = left + start;
            push([DVec2::new(x, top), DVec2::new(x, bottom)]);
        }
        Group { strokes, ..Group::default() }
    }

    /// Returns the start and width of each cell in a row of the given width, in millimeters.
    fn cells(&self, width: f64) -> Vec<(f64, f64)> {
        let parts: &[f64] = if self.list.has_masses {
            &[0.08, 0.09, 0.42, 0.27, 0.14]
        } else {
            &[0.08, 0.09, 0.53, 0.3]
        };
        let mut start = 0.0;
        let cell = |part: &f64| {
            let cell = (start, width * part);
            start += cell.1;
            cell
        };
        parts.iter().map(cell).collect()
    }

    /// Returns the column headings.
    fn headings(&self) -> Vec<String> {
        let mut names = ["Item", "Qty", "Name", "Material"].map(str::to_owned).to_vec();
        if self.list.has_masses {
            names.push(format!("Mass in {}", self.mass_unit().0));
        }
        names
    }

    /// Returns the mass unit and its value in grams: kilograms if a part has one kilogram or more.
    fn mass_unit(&self) -> (&'static str, f64) {
        let masses = self.list.items.iter().filter_map(|item| item.mass);
        if masses.fold(0.0, f64::max) >= 1000.0 { ("kg", 1000.0) } else { ("g", 1.0) }
    }

    /// Returns the cell contents of an item. An unknown mass is left blank.
    fn texts_of_item(&self, item: &PartsListItem) -> Vec<String> {
        let mut texts = vec![
            item.number.to_string(),
            item.quantity.to_string(),
            item.name.clone(),
            item.material.clone(),
        ];
        if self.list.has_masses {
            let (_, grams) = self.mass_unit();
            texts.push(item.mass.map(|mass| format_mass(mass / grams)).unwrap_or_default());
        }
        texts
    }

    /// Adds the text of a row, with counts centered and masses right-aligned.
    fn add_row(&self, layer: &mut Layer, column: &TableColumn, row: usize, texts: &[String]) {
        let foot = (ROW_HEIGHT - 1.0) * 0.5 * self.letters;
        let y = column.corner.y + self.row_height() * (row + 1) as f64 - foot;
        for (index, ((start, width), text)) in
            self.cells(column.width).iter().zip(texts).enumerate()
        {
            let room = width - 2.0 * INSET;
            let text = cut_to_width(text, self.letters * LEAST_REDUCTION, room);
            let (align, x) = match index {
                0 | 1 => (TextAlign::Middle, 0.5 * width),
                4 => (TextAlign::End, width - INSET),
                _ => (TextAlign::Start, INSET),
            };
            let x = column.corner.x + start + x;
            let label = Label::new(&text, DVec2::new(x, y), self.letters).with_align(align);
            if !text.is_empty() {
                layer.groups.push(label.fit_to_width(room).group());
            }
        }
    }
}

/// Truncates text to the width `room` at a character height, and marks the cut with three dots.
fn cut_to_width(text: &str, height: f64, room: f64) -> String {
    let fits = |text: &str| Label::new(text, DVec2::ZERO, height).width() <= room;
    // A character, including spacing, is wider than a tenth of its height.
    let most = (room / (0.1 * height)).max(0.0) as usize;
    let characters: Vec<char> = text.chars().take(most.saturating_add(1)).collect();
    if characters.len() <= most && fits(text) {
        return text.to_owned();
    }
    let cut = |count: usize| {
        let start: String = characters[..count].iter().collect();
        format!("{}...", start.trim_end())
    };
    // Bisect to find the longest prefix that fits; longer text is always wider.
    let (mut low, mut high) = (0, characters.len());
    while low + 1 < high {
        let middle = usize::midpoint(low, high);
        if fits(&cut(middle)) { low = middle } else { high = middle }
    }
    cut(low)
}

/// Formats a mass with up to four significant digits and three decimals, or as a larger integer.
fn format_mass(mass: f64) -> String {
    let decimals = match mass {
        mass if mass >= 999.95 => 0,
        mass if mass >= 99.995 => 1,
        mass if mass >= 9.9995 => 2,
        _ => 3,
    };
    let text = format!("{mass:.decimals$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn masses_have_four_significant_digits() {
        for (mass, text) in
            [(812.0, "812"), (12.345, "12.35"), (0.5, "0.5"), (123_456.7, "123457"), (0.0, "0")]
        {
            assert_eq!(format_mass(mass), text);
        }
    }

    #[test]
    fn long_names_are_truncated() {
        let long = "a very long name of a part ".repeat(4000);
        let cut = cut_to_width(&long, 2.0, 60.0);
        assert!(cut.starts_with("a very long") && cut.ends_with("..."), "{cut}");
        let width = Label::new(&cut, DVec2::ZERO, 2.0).width();
        assert!((50.0..=60.0).contains(&width), "{width}");
        assert_eq!(cut_to_width("bolt", 2.0, 60.0), "bolt");
    }
}
