//! An explanation as a page: one file that asks for nothing else, with figures beside the steps.

use super::chain::Chain;
use super::figures::figures;
use super::text::number;
use super::{Explanation, Item, Step, Value};
use shade::Picture;

impl Explanation {
    /// The explanation as an HTML page. `chain` is the one that was explained; `picture`, of any size and the same sides as the
    /// scene's, shows where the subject lands.
    #[must_use]
    pub fn to_html(&self, chain: &Chain, picture: Option<&Picture>) -> String {
        let subject = escaped(&self.subject);
        let mut page = format!(
            "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
            <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
            <title>{subject}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n\
            <h1>{subject}</h1>\n<p class=\"verdict\">{}</p>\n<div class=\"figures\">\n",
            escaped(&self.verdict)
        );
        for figure in figures(self, chain, picture) {
            let caption = escaped(&figure.caption);
            page += &format!("<figure>{}<figcaption>{caption}</figcaption></figure>\n", figure.svg);
        }
        page += "</div>\n<ol>\n";
        for step in &self.steps {
            page += &section(step);
        }
        page + "</ol>\n</body>\n</html>\n"
    }
}

fn section(step: &Step) -> String {
    let formulas = step.formula.unwrap_or_default();
    let chips: String = formulas
        .split(", ")
        .filter(|id| !id.is_empty())
        .map(|id| format!(" <code>{}</code>", escaped(id)))
        .collect();
    let rows: String = step.items.iter().map(row).collect();
    let title = escaped(&step.title);
    format!("<li id=\"{}\"><h2>{title}{chips}</h2>\n<dl>\n{rows}</dl></li>\n", step.id)
}

fn row(item: &Item) -> String {
    let value = match &item.value {
        Value::Matrix(rows) => {
            let cells = |row: &[f64; 4]| -> String {
                row.iter().map(|&entry| format!("<td>{}</td>", number(entry))).collect()
            };
            let rows: String = rows.iter().map(|row| format!("<tr>{}</tr>", cells(row))).collect();
            format!("<table>{rows}</table>")
        }
        Value::Numbers(numbers) => {
            let all: Vec<String> = numbers.iter().copied().map(number).collect();
            format!("({})", all.join(", "))
        }
        Value::Number(value) => number(*value),
        Value::Words(words) => escaped(words),
    };
    format!("<dt>{}</dt><dd>{value}</dd>\n", escaped(&item.name))
}

/// Text with nothing in it that HTML would read as its own.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

const STYLE: &str = "
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
