//! Writes `docs/topics.md`: each topic and formula with the pages of the book that cover it, and
//! each misprint with its correction.
//!
//! `alberti reference` prints the entries, so their formulas are plain text, not LaTeX.

use super::book::{BookMarks, MISPRINT_PAGE};
use super::items::{ITEMS, Item, MISPRINTS};
use crate::workspace::{project_root, read_text};
use std::collections::BTreeMap;

const OPENING: &str = "\
# Topics

This page lists the topics that the sources teach (C), the misprints found in them (M) and the formulas, each with the pages of the book
that cover it. `cargo xtask conformance` generates this file from the book, and `alberti reference C61` prints an entry.
";

/// The chapters of the book: their names, titles and texts, in the order of its contents.
pub struct Chapters(Vec<(String, String, String)>);

impl Chapters {
    /// Reads the chapters that the contents list.
    pub fn read() -> Result<Self, String> {
        let folder = project_root().join(super::BOOK_PATH);
        let contents = read_text(&folder.join("SUMMARY.md"))?;
        let files = contents.lines().filter_map(|line| line.rsplit_once("](")?.1.split(')').next());
        let read = |file: &str| {
            let text = read_text(&folder.join(file))?;
            let title = text.lines().find_map(|line| line.strip_prefix("# ")).unwrap_or(file);
            Ok((file.trim_end_matches(".md").to_owned(), title.to_owned(), text))
        };
        files.map(read).collect::<Result<_, String>>().map(Self)
    }

    /// Links to the chapters with these names.
    fn links(&self, names: &[&str]) -> String {
        let named = self.0.iter().filter(|(name, ..)| names.contains(&name.as_str()));
        let links = named.map(|(name, title, _)| format!("[{title}](../book/src/{name}.md)"));
        links.collect::<Vec<_>>().join(", ")
    }

    /// Returns the chapters in which each formula is displayed, by id.
    fn formulas(&self) -> BTreeMap<&str, Vec<&str>> {
        let mut found: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
        for (name, _, text) in &self.0 {
            let fences = text.lines().filter_map(|line| {
                let line = line.trim_start_matches(['>', ' ']);
                line.strip_prefix("```formula ")
            });
            // A dot separates the parts of a formula's derivation.
            for id in fences.flat_map(str::split_whitespace).filter(|id| !id.contains('.')) {
                let names = found.entry(id).or_default();
                if !names.contains(&name.as_str()) {
                    names.push(name);
                }
            }
        }
        found
    }

    fn text(&self, name: &str) -> &str {
        self.0.iter().find(|(other, ..)| other == name).map_or("", |(.., text)| text)
    }
}

/// Writes the whole document.
pub fn topics_document(chapters: &Chapters, marks: &BookMarks) -> String {
    let link = |item: &Item| chapters.links(&marks.pages_of(&item.id).collect::<Vec<_>>());
    let mut text = OPENING.to_owned() + "\n## Topics\n";
    for item in ITEMS.iter() {
        text += &format!("\n**{}, {}**\n\nBook: {}\n", item.id, item.title, link(item));
    }
    text += "\n## Misprints\n";
    for item in MISPRINTS.iter() {
        let (body, command) = correction(chapters.text(MISPRINT_PAGE), &item.id);
        text += &format!("\n**{}, {}**\n\n{body}\n\n{command}", item.id, item.title);
        text += &format!("Book: {}\n", link(item));
    }
    text += "\n## Formulas\n";
    for (id, names) in chapters.formulas() {
        text += &format!("\n**{id}**\n\nBook: {}\n", chapters.links(&names));
    }
    text
}

/// Returns the text of a misprint on the errata page, without its tests, and the line with its
/// command.
fn correction(page: &str, id: &str) -> (String, String) {
    let mark = format!("> **Misprint** `{id}` ");
    let block = page.split_once(&mark).map_or("", |(_, rest)| rest);
    let lines = block.lines().map_while(|line| {
        // The first line has lost its mark.
        line.strip_prefix("> ").or((!line.is_empty() && block.starts_with(line)).then_some(line))
    });
    let block = lines.collect::<Vec<_>>().join(" ");
    let (before, after) = ["Test: ", "Tests: "]
        .into_iter()
        .find_map(|word| block.split_once(word))
        .unwrap_or((&block, ""));
    let command = after.split_once("Command: `").and_then(|(_, rest)| rest.split('`').next());
    let command = command.map_or(String::new(), |command| format!("Command: `{command}`\n\n"));
    // The rows of the table of misprints, such as (26), are in the book only.
    let is_row = |text: &str| text.starts_with('(') && text[1..].starts_with(char::is_numeric);
    let body = match before.split_once(") ") {
        Some((row, body)) if is_row(row) && row.len() < 5 => body,
        _ => before,
    };
    (plain_math(body.trim()).replace("](", "](../book/src/"), command)
}

/// Returns Markdown with its LaTeX formulas in plain text.
fn plain_math(text: &str) -> String {
    let mut parts = text.split("`$");
    let mut plain = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (formula, rest) = part.split_once("$`").unwrap_or((part, ""));
        plain += &format!("`{}`{rest}", plain_formula(formula));
    }
    plain
}

fn plain_formula(latex: &str) -> String {
    const WORDS: [(&str, &str); 11] = [
        ("\\mathrm{diag}", "diag"),
        ("\\mathrm{fovy}", "fovy"),
        ("\\mathrm{aspect}", "aspect"),
        ("\\cdot", "·"),
        ("\\sim", "~"),
        ("\\alpha", "α"),
        ("\\varphi", "φ"),
        ("\\ldots", "…"),
        ("\\le", "≤"),
        ("\\,", " "),
        ("\\;", " "),
    ];
    let mut plain = latex.to_owned();
    for (word, meaning) in WORDS {
        plain = plain.replace(word, meaning);
    }
    while let Some((before, rest)) = plain.split_once("\\frac{") {
        let Some((numerator, rest)) = rest.split_once("}{") else { break };
        let Some((denominator, rest)) = rest.split_once('}') else { break };
        let [above, below] = [numerator, denominator].map(|part| {
            let is_sum = part.contains([' ', '+', '-', '·']) || part.contains("tan");
            if is_sum { format!("({part})") } else { part.to_owned() }
        });
        let is_factor = rest.trim_start().starts_with(char::is_alphanumeric);
        let (open, close) = if is_factor { ("(", ")") } else { ("", "") };
        plain = format!("{before}{open}{above}/{below}{close}{rest}");
    }
    let plain = plain.replace('\\', "").replace(['{', '}'], "").replace('-', "−");
    plain.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_become_plain_text() {
        for (latex, plain) in [
            ("y_s = \\frac{d}{z}\\,y", "y_s = (d/z) y"),
            ("z' = n + f - \\frac{fn}{z}", "z' = n + f − fn/z"),
            ("-\\frac{F+N}{F-N}", "−(F+N)/(F−N)"),
            ("x_p = x + L\\cos\\varphi", "x_p = x + Lcosφ"),
            ("T(-X_{w,\\min}, Y_{w,\\min})", "T(−X_w,min, Y_w,min)"),
        ] {
            assert_eq!(plain_formula(latex), plain);
        }
    }

    #[test]
    fn a_misprint_has_a_correction_and_a_command() {
        let page = "> **Misprint** `M1` (1) `$d$` is\n> wrong. Test: `a.rs`, `b`. Command:\n> `alberti x`.\n\n> more";
        let (text, command) = correction(page, "M1");
        assert_eq!(
            (text.as_str(), command.as_str()),
            ("`d` is wrong.", "Command: `alberti x`\n\n")
        );
    }
}
