//! Prints the editions to PDF: Chromium prints the `print.html` of each.

use crate::Outcome;
use crate::browser::CHROMIUM;
use crate::program::{capture_output, run_command};
use crate::skip::report_skip;
use std::path::Path;
use std::process::Command;

/// The time limit for one edition, in seconds.
const SECONDS: &str = "300";

/// The languages, each with a font pattern if some machines lack its fonts.
const EDITIONS: [(&str, Option<&str>); 2] = [("en", None), ("zh", Some(":lang=zh"))];

/// Prints `viewing-LANGUAGE.pdf` into the book's folder.
pub fn print_editions(book: &Path) -> Outcome {
    if !Path::new(CHROMIUM).exists() {
        report_skip("book", "PDF: chromium is not installed (Debian: chromium)");
        return Ok(());
    }
    for (language, fonts) in EDITIONS {
        if fonts.is_some_and(|pattern| !has_font(pattern)) {
            report_skip(
                "book",
                &format!("PDF in {language}: no font for it is installed (Debian: fonts-noto-cjk)"),
            );
            continue;
        }
        let page = book.join(language).join("print.html");
        if !page.is_file() {
            return Err(format!("{} is missing: run `cargo xtask book`", page.display()));
        }
        let pdf = book.join(format!("viewing-{language}.pdf"));
        run_command(&mut print_command(&page, &pdf))?;
        println!("{}", pdf.display());
    }
    Ok(())
}

/// Returns a command that runs Chromium without a display. Page numbers come from the style sheet,
/// and the outline comes from the headings.
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

/// Returns whether a font matches a fontconfig pattern.
fn has_font(pattern: &str) -> bool {
    capture_output(Command::new("fc-list").arg(pattern)).is_ok_and(|list| !list.trim().is_empty())
}

/// Returns whether the user is root, for whom Chromium's sandbox does not work.
fn is_root() -> bool {
    capture_output(Command::new("id").arg("-u")).is_ok_and(|id| id.trim() == "0")
}
