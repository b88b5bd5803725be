//! HTML output of panels: one self-contained page of figures, with searchable text.
//!
//! Drawings are inline SVG and captions are HTML text. The page has no external scripts, fonts or
//! images, so it can be mailed and archived. Figures wrap to the width of the window.

use super::{Page, Panel, Panels};
use glam::DVec2;
use page::escape_markup;
use std::fmt::Write as _;

/// The style sheet of the page: figures wrap to the width of the window.
const STYLE_SHEET: &str = "
  body { margin: 2rem auto; max-width: 100rem; padding: 0 2rem; font: 15px/1.5 Georgia, serif; color: #1a1f26; background: #fff; }
  main { display: flex; flex-wrap: wrap; gap: 2rem 1.5rem; }
  figure { margin: 0; }
  svg { display: block; border: 1px solid #969ca3; }
  figcaption { padding-top: .4rem; }
  figcaption span { display: block; font-size: .85em; }
";

impl Panels {
    /// Returns all panels as an HTML page that does not refer to other files.
    #[must_use]
    pub fn to_html(&self) -> String {
        let title = escape_markup(&self.title);
        let mut html = format!(
            "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<title>{title}</title>\n\
             <style>{STYLE_SHEET}</style>\n<h1>{title}</h1>\n"
        );
        if !self.introduction.is_empty() {
            let _ = writeln!(html, "<p>{}</p>", escape_markup(&self.introduction.join(" ")));
        }
        html += "<main>\n";
        self.panels.iter().for_each(|panel| push_figure(&mut html, panel));
        html += "</main>\n</html>\n";
        html
    }
}

/// Appends a panel as a `<figure>` with its drawing as inline SVG.
///
/// All figures on an HTML page share one id namespace, so layer ids are prefixed with the panel id.
fn push_figure(html: &mut String, panel: &Panel) {
    let mut page = Page::new(panel.page.size, panel.title.clone(), panel.page.paper);
    page.paste_page(&panel.page, DVec2::ZERO, &format!("{}-", panel.id));
    let (id, svg, title) = (escape_markup(&panel.id), page.to_svg(), escape_markup(&panel.title));
    let _ = write!(html, "<figure id=\"{id}\">\n{svg}<figcaption><b>{title}</b>");
    for note in &panel.notes {
        let _ = write!(html, "<span>{}</span>", escape_markup(note));
    }
    *html += "</figcaption>\n</figure>\n";
}
