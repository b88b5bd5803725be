//! Panels: drawings side by side on one page, with captions.
//!
//! ```text
//!  ┌───────────┐ ┌───────────┐ ┌───────────┐
//!  │           │ │           │ │           │     row by row; columns are as wide, and
//!  └───────────┘ └───────────┘ └───────────┘     rows as high, as their largest panel
//!   isometric     dimetric      cavalier
//!   AX-1 …        AX-1 …        OB-1 …
//! ```

mod html;

use super::Warning;
use crate::Page;
use glam::DVec2;
use page::palette::{GRAY, INK, WHITE};
use page::{Group, Label, Layer, Pen, Polyline};

/// The margin around all panels, in millimeters.
const MARGIN: f64 = 8.0;
/// The gap between panels, in millimeters.
const PANEL_GAP: f64 = 7.0;

/// The height of the page's title, in millimeters.
const HEADING_HEIGHT: f64 = 4.5;
/// The height of a panel's title, in millimeters.
const TITLE_HEIGHT: f64 = 3.0;
/// The height of a panel's notes, in millimeters.
const NOTE_HEIGHT: f64 = 2.0;
/// The distance between baselines, in character heights.
const LEADING: f64 = 1.75;

/// A drawing with a caption.
#[derive(Clone, PartialEq, Debug)]
pub struct Panel {
    /// An identifier, unique among the panels, in lower case with hyphens.
    pub id: String,
    /// The first line of the caption, in larger type.
    pub title: String,
    /// Lines of text below the title.
    pub notes: Vec<String>,
    /// The drawing.
    pub page: Page,
}

/// A page of drawings side by side.
///
/// ```
/// use drawing::{Page, Panel, Panels};
/// use glam::DVec2;
///
/// let panel = |id: &str| Panel {
///     id: id.to_owned(),
///     title: id.to_owned(),
///     notes: Vec::new(),
///     page: Page::new(DVec2::new(40.0, 30.0), id, None),
/// };
/// let panels = Panels::new("four views", ["a", "b", "c", "d"].map(panel).to_vec());
/// assert_eq!(panels.columns, 2);
/// assert!(panels.to_page().size.x > 80.0 && panels.to_html().contains("<figure id=\"d\">"));
/// ```
#[derive(Clone, PartialEq, Debug)]
pub struct Panels {
    /// The title of the page.
    pub title: String,
    /// Lines below the title that describe the page and the units of its numbers.
    pub introduction: Vec<String>,
    /// The number of panels in a row, at least 1.
    pub columns: usize,
    /// The panels, row by row from the left.
    pub panels: Vec<Panel>,
}

impl Panel {
    /// Returns the panel with the given notes.
    #[must_use]
    pub fn with_notes(self, notes: Vec<String>) -> Self {
        Self { notes, ..self }
    }

    /// Returns the width and height including the caption, in millimeters.
    fn outer_size(&self) -> DVec2 {
        let text = TITLE_HEIGHT * LEADING + self.notes.len() as f64 * NOTE_HEIGHT * LEADING;
        self.page.size + DVec2::new(0.0, text)
    }

    /// Returns the title and notes, with their upper left corner at `at`.
    fn text_groups(&self, at: DVec2) -> (Group, Vec<Group>) {
        let named = |id: String, group| Group { id, title: self.title.clone(), ..group };
        let width = self.page.size.x;
        let first = at + DVec2::new(0.0, TITLE_HEIGHT * LEADING * 0.85);
        let title = Label::new(&self.title, first, TITLE_HEIGHT).fit_to_width(width).group();
        let notes = self.notes.iter().enumerate().map(|(line, note)| {
            let below = first + DVec2::new(0.0, (line + 1) as f64 * NOTE_HEIGHT * LEADING);
            let label = Label::new(note, below, NOTE_HEIGHT).fit_to_width(width);
            named(format!("{}.{}", self.id, line + 1), label.group())
        });
        (named(self.id.clone(), title), notes.collect())
    }
}

impl Panels {
    /// Arranges up to three panels in one row, and more in a grid with about as many rows as
    /// columns.
    #[must_use]
    pub fn new(title: impl Into<String>, panels: Vec<Panel>) -> Self {
        let count = panels.len();
        let columns = if count <= 3 { count } else { (1..).find(|n| n * n >= count).unwrap_or(1) };
        Self { title: title.into(), introduction: Vec::new(), columns: columns.max(1), panels }
    }

    /// Returns the panels with lines of text below the title; HTML joins them into a paragraph.
    #[must_use]
    pub fn with_introduction(self, introduction: Vec<String>) -> Self {
        Self { introduction, ..self }
    }

    /// Returns the warnings about all drawings, without duplicates.
    #[must_use]
    pub fn warnings(&self) -> Vec<Warning> {
        let all = self.panels.iter().flat_map(|panel| panel.page.warnings.iter().cloned());
        let mut warnings: Vec<Warning> = all.collect();
        warnings.sort_unstable();
        warnings.dedup();
        warnings
    }

    /// Returns all panels on one white page.
    ///
    /// Each row and column is as large as its largest panel. Captions are strokes, so the page can
    /// be written in every format.
    #[must_use]
    pub fn to_page(&self) -> Page {
        let sizes: Vec<DVec2> = self.panels.iter().map(Panel::outer_size).collect();
        let columns = self.columns.max(1);
        let widths: Vec<f64> = (0..columns.min(sizes.len()))
            .map(|x| largest_side(sizes.iter().skip(x).step_by(columns).map(|size| size.x)))
            .collect();
        let heights: Vec<f64> =
            sizes.chunks(columns).map(|row| largest_side(row.iter().map(|size| size.y))).collect();
        let lines = self.introduction.len() as f64 * NOTE_HEIGHT * LEADING;
        let top = MARGIN + HEADING_HEIGHT + lines + PANEL_GAP;
        let sum = |sides: &[f64]| sides.iter().map(|side| side + PANEL_GAP).sum::<f64>();
        let size = DVec2::new(
            sum(&widths) - PANEL_GAP + 2.0 * MARGIN,
            top + sum(&heights) - PANEL_GAP + MARGIN,
        );
        let mut page = Page::new(size, self.title.clone(), Some(WHITE));
        let pen = Pen::solid(0.13, GRAY);
        let mut frames = Layer::new("frames", "panel borders", pen);
        let mut names = Layer::new("names", "names", Pen::solid(TITLE_HEIGHT * 0.1, INK));
        let mut notes = Layer::new("notes", "notes", Pen::solid(NOTE_HEIGHT * 0.1, INK));
        for (index, panel) in self.panels.iter().enumerate() {
            let (x, y) = (index % columns, index / columns);
            let corner = DVec2::new(MARGIN + sum(&widths[..x]), top + sum(&heights[..y]));
            page.paste_page(&panel.page, corner, &format!("{}-", panel.id));
            frames.groups.push(frame_group(panel, corner));
            let (name, note) = panel.text_groups(corner + DVec2::new(0.0, panel.page.size.y));
            names.groups.push(name);
            notes.groups.extend(note);
        }
        let at = DVec2::new(MARGIN, MARGIN + HEADING_HEIGHT);
        let heading =
            Label::new(&self.title, at, HEADING_HEIGHT).fit_to_width(size.x - 2.0 * MARGIN);
        let mut layer = Layer::new("heading", "page heading", heading.pen(INK));
        layer.groups.push(heading.group());
        for (line, words) in self.introduction.iter().enumerate() {
            let below = at + DVec2::new(0.0, (line + 1) as f64 * NOTE_HEIGHT * LEADING);
            let label = Label::new(words, below, NOTE_HEIGHT).fit_to_width(size.x - 2.0 * MARGIN);
            notes.groups.push(label.group());
        }
        page.layers.extend([frames, names, notes, layer]);
        page.warnings = self.warnings();
        page
    }
}

/// Returns the largest of several lengths, or 0 if there are none.
fn largest_side(sides: impl Iterator<Item = f64>) -> f64 {
    sides.fold(0.0, f64::max)
}

/// Returns the border of a panel.
fn frame_group(panel: &Panel, corner: DVec2) -> Group {
    let [w, h] = panel.page.size.to_array();
    let corners = [[0.0, 0.0], [w, 0.0], [w, h], [0.0, h]].map(|c| corner + DVec2::from(c));
    let strokes = Polyline::through_points(&corners, true).into_iter().collect();
    Group { id: panel.id.clone(), title: panel.title.clone(), strokes, ..Group::default() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use page::to_millimeters;

    /// Returns a panel of 40 × 30 mm with a diagonal.
    fn panel(id: &str) -> Panel {
        let mut page = Page::new(DVec2::new(40.0, 30.0), id, None);
        let mut layer = Layer::new("lines", "lines", Pen::solid(0.2, INK));
        let diagonal = Polyline::through_points(&[DVec2::ZERO, DVec2::new(40.0, 30.0)], false);
        layer.groups.push(Group { strokes: diagonal.into_iter().collect(), ..Group::default() });
        page.layers.push(layer);
        let notes = vec!["a < b".to_owned()];
        Panel { id: id.to_owned(), title: id.to_uppercase(), notes, page }
    }

    #[test]
    fn panels_form_rows_and_do_not_touch() {
        let panels = Panels::new("five", ["a", "b", "c", "d", "e"].map(panel).to_vec());
        assert_eq!(panels.columns, 3);
        let page = panels.to_page();
        let corner = |id: &str| {
            let layer = page.layers.iter().find(|layer| layer.id == format!("{id}-lines"));
            layer.map(|layer| to_millimeters(layer.groups[0].strokes[0].points[0])).expect(id)
        };
        let [a, b, d] = ["a", "b", "d"].map(corner);
        assert_eq!(b - a, DVec2::new(40.0 + PANEL_GAP, 0.0));
        assert!(d.x == a.x && d.y > a.y + 30.0 + TITLE_HEIGHT + NOTE_HEIGHT);
        assert!((page.size.x - (3.0 * 40.0 + 2.0 * PANEL_GAP + 2.0 * MARGIN)).abs() < 1e-9);
        assert!(page.size.y > d.y + 30.0 + TITLE_HEIGHT + NOTE_HEIGHT);
    }

    #[test]
    fn html_output_is_self_contained_with_unique_ids() {
        let html = Panels::new("<two>", vec![panel("a"), panel("b")]).to_html();
        assert!(html.contains("<h1>&lt;two&gt;</h1>") && html.contains("a &lt; b"));
        assert!(!html.contains("src=") && !html.contains("<two>"));
        for id in ["id=\"a-lines\"", "id=\"b-lines\""] {
            assert_eq!(html.matches(id).count(), 1, "{id}");
        }
    }
}
