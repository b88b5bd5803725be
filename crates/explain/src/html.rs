//! An explanation as a self-contained HTML page: diagrams, then the steps.
//!
//! The page has no script and loads nothing: style sheet, diagrams (SVG) and picture (a data URI)
//! are embedded. It follows the color scheme of the reader's system.

use super::diagrams::draw_diagrams;
use super::plain_text::format_number;
use super::transform_chain::TransformChain;
use super::{Explanation, ExplanationEntry, ItemValue, Step};
use picture::Picture;

impl Explanation {
    /// Formats the explanation as an HTML page. `chain` is the chain used for the explanation;
    /// `picture`, of any size but with the scene's aspect ratio, shows the position of the subject.
    ///
    /// The page is complete without network access. The order is subject, introduction, verdict,
    /// diagrams, steps.
    #[must_use]
    pub fn to_html(&self, chain: &TransformChain, picture: Option<&Picture>) -> String {
        let subject = escape_html(&self.subject);
        let mut page = format!(
            "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
            <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
            <title>{subject}</title>\n<style>{STYLESHEET}</style>\n</head>\n<body>\n\
            <h1>{subject}</h1>\n<p>{}</p>\n<p class=\"verdict\">{}</p>\n<div class=\"figures\">\n",
            escape_html(self.introduction().unwrap_or_default()),
            escape_html(&self.verdict)
        );
        for figure in draw_diagrams(self, chain, picture) {
            let caption = escape_html(&figure.caption);
            page += &format!("<figure>{}<figcaption>{caption}</figcaption></figure>\n", figure.svg);
        }
        page += "</div>\n<ol>\n";
        for step in &self.steps {
            page += &step_html(step);
        }
        page + "</ol>\n</body>\n</html>\n"
    }
}

/// Formats a step as a list item with a table of its values.
///
/// The id of the step is the anchor, so `page.html#clip` links to clipping. Formula ids become
/// `<code>` chips after the title.
fn step_html(step: &Step) -> String {
    let formulas = step.formula.unwrap_or_default();
    let chips: String = formulas
        .split(", ")
        .filter(|id| !id.is_empty())
        .map(|id| format!(" <code>{}</code>", escape_html(id)))
        .collect();
    let rows: String = step.items.iter().map(item_html).collect();
    let title = escape_html(&step.title);
    format!("<li id=\"{}\"><h2>{title}{chips}</h2>\n<dl>\n{rows}</dl></li>\n", step.id)
}

/// Formats a value as a term with its description.
///
/// Matrices are tables whose left and right borders act as brackets; coordinates are a list in
/// parentheses. Numbers have at most seven significant digits, as in plain text.
fn item_html(item: &ExplanationEntry) -> String {
    let value = match &item.value {
        ItemValue::Matrix(rows) => matrix_html(rows),
        ItemValue::PlanarMatrix(rows) => matrix_html(rows),
        ItemValue::Numbers(numbers) => {
            let all: Vec<String> = numbers.iter().copied().map(format_number).collect();
            format!("({})", all.join(", "))
        }
        ItemValue::Number(value) => format_number(*value),
        ItemValue::Text(words) => escape_html(words),
    };
    format!("<dt>{}</dt><dd>{value}</dd>\n", escape_html(&item.name))
}

/// Formats a matrix as a table.
fn matrix_html<const N: usize>(rows: &[[f64; N]; N]) -> String {
    let cells = |row: &[f64; N]| -> String {
        row.iter().map(|&entry| format!("<td>{}</td>", format_number(entry))).collect()
    };
    let rows: String = rows.iter().map(|row| format!("<tr>{}</tr>", cells(row))).collect();
    format!("<table>{rows}</table>")
}

/// Escapes text for HTML content and attribute values.
///
/// The ampersand is replaced first; otherwise, the other entities would be escaped again. Node and
/// model names come from files and can contain any character.
fn escape_html(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// The style sheet of the page, for light and dark color schemes.
///
/// Colors are custom properties; `prefers-color-scheme` replaces three of them. Diagrams use the
/// classes `volume`, `eye`, `subject` and `mark`.
const STYLESHEET: &str = "
:root { color-scheme: light dark; --ink: #1c2430; --paper: #fff; --faint: #8a94a3; --mark: #c62828; }
@media (prefers-color-scheme: dark) { :root { --ink: #dfe4ec; --paper: #14181e; --mark: #ff7b72; } }
body { font: 16px/1.5 system-ui, sans-serif; color: var(--ink); background: var(--paper); max-width: 68rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.5rem; } h2 { font-size: 1.1rem; margin: 2rem 0 .5rem; }
.verdict { font-size: 1.1rem; border-left: 4px solid var(--mark); padding-left: .8rem; }
.figures { display: grid; grid-template-columns: repeat(auto-fit, minmax(18rem, 1fr)); gap: 1rem; }
figure { margin: 0; } figcaption { font-size: .85rem; color: var(--faint); }
svg { width: 100%; border: 1px solid var(--faint); } svg text { fill: var(--ink); font-size: 12px; text-anchor: middle; }
.volume { stroke: var(--faint); } .eye { fill: var(--ink); }
.subject { fill: var(--mark); fill-opacity: .15; stroke: var(--mark); } circle.mark { fill: none; stroke: var(--mark); }
svg text.mark { fill: var(--mark); font-weight: bold; }
code { font-size: .8rem; border: 1px solid var(--faint); border-radius: .3rem; padding: 0 .3rem; font-weight: normal; }
dl { display: grid; grid-template-columns: minmax(8rem, max-content) 1fr; gap: .3rem 1.2rem; align-items: center; }
dt { color: var(--faint); } dd { margin: 0; font-family: ui-monospace, monospace; font-size: .9rem; overflow-x: auto; }
table { border-left: 2px solid; border-right: 2px solid; border-radius: .4rem; border-collapse: separate; }
td { padding: 0 .6rem; text-align: right; }
";
