//! The common parts of all pages: the frame, the menu and the style sheet.

use crate::files::relative;
use crate::markdown::escape;
use crate::site::Page;

/// The style sheet of all pages.
pub const STYLE: &str = include_str!("style.css");

/// The minimum number of sections for which a page lists its sections.
const LISTED_SECTIONS: usize = 3;

/// Returns a whole page. The menu follows the content, so that on narrow screens the content comes
/// first.
pub fn page_html(path: &str, page: &Page, menu: &str) -> String {
    let document = &page.document;
    let [style, start] = ["style.css", "index.html"].map(|target| relative(path, target));
    let title = match path {
        "index.html" => "Alberti".to_owned(),
        _ => format!("{} · Alberti", escape(&document.title)),
    };
    let sections = if document.sections.len() < LISTED_SECTIONS {
        String::new()
    } else {
        let item = |(anchor, text): &(String, String)| {
            format!("<li><a href=\"#{anchor}\">{}</a></li>\n", escape(text))
        };
        let items: String = document.sections.iter().map(item).collect();
        format!(
            "<nav class=\"sections\" aria-label=\"On this page\" tabindex=\"0\">\n<ul>\n{items}</ul>\n</nav>\n"
        )
    };
    format!(
        "<!doctype html>
<html lang=\"en\">
<meta charset=\"utf-8\">
<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">
<meta name=\"color-scheme\" content=\"light dark\">
<title>{title}</title>
<link rel=\"stylesheet\" href=\"{style}\">
<header><a href=\"{start}\">Alberti</a> <a class=\"to-menu\" href=\"#menu\">Menu</a></header>
<div class=\"frame\">
{sections}<main>
{}</main>
<nav class=\"menu\" id=\"menu\" aria-label=\"All pages\">
{menu}</nav>
</div>
</html>
",
        document.html
    )
}

/// Returns the menu item of a page, marked if it is the current page.
pub fn menu_item(current: &str, path: &str, title: &str) -> String {
    let mark = if current == path { " aria-current=\"page\"" } else { "" };
    format!("<li><a href=\"{}\"{mark}>{}</a></li>\n", relative(current, path), escape(title))
}
