//! The contact sheet: all pictures on one page, and what failed.

use super::report::{FAILED, Record};
use std::fmt::Write as _;

/// The page; it needs nothing but the pictures beside it.
pub(super) fn html(records: &[Record]) -> String {
    let (failed, shown): (Vec<&Record>, Vec<&Record>) =
        records.iter().partition(|record| record.status == FAILED);
    let mut page = String::from(HEAD);
    let _ = writeln!(page, "<p>{} pictures, {} failed</p>\n<main>", shown.len(), failed.len());
    for record in shown {
        let (file, name) = (link(&record.output), escaped(&record.output));
        let title = escaped(&record.input);
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
            let (input, message) = (escaped(&record.input), escaped(&record.message));
            let _ = writeln!(page, "<dt>{input}</dt><dd><pre>{message}</pre></dd>");
        }
        page += "</dl>\n";
    }
    page + "</html>\n"
}

const HEAD: &str = "<!DOCTYPE html>
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

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}

/// A path as a relative URL.
fn link(path: &str) -> String {
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
        assert_eq!(link("a b/c#d%.png"), "./a%20b/c%23d%25.png");
        assert_eq!(escaped("<a & \"b\">"), "&lt;a &amp; &quot;b&quot;>");
    }
}
