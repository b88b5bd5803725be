//! PDFs of the editions: `print.html` printed by Chromium.

use crate::Outcome;
use crate::browser::CHROMIUM;
use crate::program::{capture_output, run_command};
use crate::skip::report_skip;
use std::path::Path;
use std::process::Command;

/// The time limit for one edition, in seconds.
const SECONDS: &str = "300";

/// The languages, and those whose fonts some machines lack.
const EDITIONS: [(&str, Option<&str>); 2] = [("en", None), ("zh", Some(":lang=zh"))];

/// Prints `viewing-LANGUAGE.pdf` into the folder of the book.
pub fn print_editions(book: &Path) -> Outcome {
    if !Path::new(CHROMIUM).exists() {
        report_skip("book", "PDF: chromium is not installed (Debian: chromium)");
        return Ok(());
    }
    for (language, fonts) in EDITIONS {
        if fonts.is_some_and(|pattern| !has_font(pattern)) {
            report_skip(
                "book",
                &format!("PDF in {language}: no font has its letters (Debian: fonts-noto-cjk)"),
            );
            continue;
        }
        let page = book.join(language).join("print.html");
        if !page.is_file() {
            return Err(format!("{} is not there: run `cargo xtask book`", page.display()));
        }
        let pdf = book.join(format!("viewing-{language}.pdf"));
        run_command(&mut print_command(&page, &pdf))?;
        println!("{}", pdf.display());
    }
    Ok(())
}

/// Chromium without a display; page numbers come from the style sheet, the outline from the
/// headings.
fn print_command(page: &Path, pdf: &Path) -> Command {
    let mut chromium = Command::new("timeout");
    chromium.args([SECONDS, CHROMIUM, "--headless", "--disable-gpu", "--no-pdf-header-footer"]);
    chromium.arg("--generate-pdf-document-outline");
    if is_root() {
        chromium.arg("--no-sandbox");
    }
    chromium.arg(format!("--print-to-pdf={}", pdf.display()));
    chromium.arg(format!("file://{}", page.display()));
    chromium
}

/// Whether a font matches a pattern of fontconfig.
fn has_font(pattern: &str) -> bool {
    capture_output(Command::new("fc-list").arg(pattern)).is_ok_and(|list| !list.trim().is_empty())
}

/// Chromium's sandbox does not work for root.
fn is_root() -> bool {
    capture_output(Command::new("id").arg("-u")).is_ok_and(|id| id.trim() == "0")
}
