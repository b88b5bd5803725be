//! An entry of the formulas as an HTML page, for browsers.

use super::Formula;

impl Formula {
    /// Returns a page with the name, the text, the sources, the command, and the pages of the book.
    #[must_use]
    pub fn to_html(&self) -> String {
        let mut body = format!("<h1>{}</h1>\n", escape(self.name));
        for block in blocks(self.text) {
            body += &match block {
                Block::Paragraph(text) => format!("<p>{}</p>\n", code_spans(&text)),
                Block::Verbatim(text) => format!("<pre>{}</pre>\n", escape(&text)),
            };
        }
        for source in self.sources() {
            body += &format!("<p>Source: {}</p>\n", escape(&source.replace('*', "")));
        }
        if let Some(command) = self.command {
            body += &format!("<p>Command: <code>{}</code></p>\n", escape(command));
        }
        let pages: Vec<String> =
            self.book_pages().map(|(title, file)| escape(&format!("{title} ({file})"))).collect();
        if !pages.is_empty() {
            body += &format!("<p>Book: {}</p>\n", pages.join(", "));
        }
        let title = escape(self.name);
        format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width\">\n<title>{title}</title>\n\
             {body}</html>\n"
        )
    }
}

enum Block {
    Paragraph(String),
    /// The lines of a matrix or a table.
    Verbatim(String),
}

/// Splits Markdown into paragraphs, fenced blocks and tables.
fn blocks(text: &str) -> Vec<Block> {
    let mut blocks = Vec::new();
    let mut is_fenced = false;
    for line in text.lines() {
        if line.starts_with("```") {
            is_fenced = !is_fenced;
            blocks.push(Block::Verbatim(String::new()));
        } else if is_fenced || line.starts_with('|') {
            match blocks.last_mut() {
                Some(Block::Verbatim(lines)) => *lines += &format!("{line}\n"),
                _ => blocks.push(Block::Verbatim(format!("{line}\n"))),
            }
        } else if line.is_empty() {
            blocks.push(Block::Paragraph(String::new()));
        } else {
            match blocks.last_mut() {
                Some(Block::Paragraph(lines)) => *lines += &format!("{line} "),
                _ => blocks.push(Block::Paragraph(format!("{line} "))),
            }
        }
    }
    blocks.retain(|block| match block {
        Block::Paragraph(text) | Block::Verbatim(text) => !text.is_empty(),
    });
    blocks
}

/// Returns a paragraph as HTML, with its code spans.
fn code_spans(text: &str) -> String {
    let parts = escape(text.trim());
    let mut html = String::new();
    for (at, part) in parts.split('`').enumerate() {
        html += &if at % 2 == 1 { format!("<code>{part}</code>") } else { part.to_owned() };
    }
    html
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::super::find_formula;

    #[test]
    fn a_formula_is_a_page_with_its_matrix_and_book_page() {
        let page = find_formula("PE-1").expect("a formula").to_html();
        for part in [
            "<h1>PE-1, the perspective matrix P and its inverse</h1>",
            "<code>(x, y, z) → (n x/z, n y/z, n + f − f n/z)</code>",
            "<pre>    ┌ n 0  0    0  ┐",
            "<p>Command: <code>alberti explain --planes 1,2 --point 2,3,4</code></p>",
            "<p>Book: Normalization (normalization.md)</p>",
        ] {
            assert!(page.contains(part), "{part}: {page}");
        }
        let misprint = find_formula("M14").expect("a misprint").to_html();
        assert!(!misprint.contains("Source") && misprint.contains("Errata (printed-wrong.md)"));
    }
}
