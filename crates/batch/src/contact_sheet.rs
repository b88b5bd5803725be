//! The contact sheet: HTML pages with all pictures and failures.
//!
//! The pages are static and need no script; pictures load when scrolled into view. A page holds up
//! to 500 pictures and failures, so that any browser can open it:
//!
//! ```text
//! index.html  index-2.html  index-3.html …
//! ```

use super::merge::MergeCounts;
use super::report::write_error;
use super::report_reader::{MERGED_REPORT, RecordLine, read_report};
use crate::BatchError;
use import::percent_encode;
use page::escape_markup;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// The number of pictures and failures per page.
const PAGE_RECORDS: u64 = 500;

/// Writes the contact sheet for a merged report with these counts.
///
/// Pictures come first, in the order of the report, then the failures with their messages. Pages
/// left over from a longer sheet are removed.
///
/// # Errors
/// Returns an error if the report cannot be read or a page cannot be written.
pub(super) fn write_contact_sheet(out_dir: &Path, counts: &MergeCounts) -> Result<(), BatchError> {
    let report = out_dir.join(MERGED_REPORT);
    let mut sheet = ContactSheet::new(out_dir, counts);
    for is_done in [true, false] {
        read_report(&report, |record, _| {
            if record.is_done() == is_done { sheet.add_record(record) } else { Ok(()) }
        })?;
    }
    sheet.finish()
}

/// A contact sheet that is being written, page by page.
struct ContactSheet<'a> {
    out_dir: &'a Path,
    counts: &'a MergeCounts,
    /// The number of this page, from 1.
    page: u64,
    /// The number of records on this page.
    records: u64,
    /// The pictures on this page.
    figures: String,
    /// The failures on this page.
    failures: String,
}

impl<'a> ContactSheet<'a> {
    fn new(out_dir: &'a Path, counts: &'a MergeCounts) -> Self {
        let (figures, failures) = (String::new(), String::new());
        Self { out_dir, counts, page: 1, records: 0, figures, failures }
    }

    /// Adds a record, after writing the current page if it is full.
    fn add_record(&mut self, record: &RecordLine<'_>) -> Result<(), BatchError> {
        if self.records == PAGE_RECORDS {
            self.write_page()?;
            self.page += 1;
            self.records = 0;
        }
        self.records += 1;
        if record.is_done() {
            self.add_figure(record);
        } else {
            let (input, message) = (escape_markup(&record.input), escape_markup(&record.message));
            let _ = writeln!(self.failures, "<dt>{input}</dt><dd><pre>{message}</pre></dd>");
        }
        Ok(())
    }

    /// Adds a picture. A picture in a tar file is listed by name only, because a browser cannot
    /// show it.
    ///
    /// File names are untrusted text and are escaped everywhere.
    fn add_figure(&mut self, record: &RecordLine<'_>) {
        let (title, name) = (escape_markup(&record.input), escape_markup(&record.output));
        let page = &mut self.figures;
        let _ = if let Some(tar) = &record.tar {
            let tar = escape_markup(tar);
            writeln!(
                page,
                "<figure title=\"{title}\">{name}<figcaption>{tar}</figcaption></figure>"
            )
        } else {
            let file = relative_url(&record.output);
            writeln!(
                page,
                "<figure><a href=\"{file}\"><img loading=\"lazy\" src=\"{file}\" alt=\"{title}\"></a>\
                 <figcaption>{name}</figcaption></figure>"
            )
        };
    }

    /// Writes the last page, which exists even without records, and removes surplus pages.
    fn finish(mut self) -> Result<(), BatchError> {
        self.write_page()?;
        (self.page + 1..)
            .map(|page| self.page_path(page))
            .take_while(|path| std::fs::remove_file(path).is_ok())
            .count();
        Ok(())
    }

    /// Writes this page, unless the file already has this content, and clears it for the next one.
    fn write_page(&mut self) -> Result<(), BatchError> {
        let mut page = String::from(PAGE_HEAD);
        let pictures = files::counted(self.counts.done, "picture", "pictures");
        let _ = writeln!(page, "<p>{pictures}, {} failed</p>", self.counts.failed);
        let links = self.page_links();
        let _ = writeln!(page, "{links}<main>\n{}</main>", self.figures);
        if !self.failures.is_empty() {
            let _ = writeln!(page, "<h2>Failed</h2>\n<dl>\n{}</dl>", self.failures);
        }
        let _ = writeln!(page, "{links}</html>");
        self.figures.clear();
        self.failures.clear();
        let path = self.page_path(self.page);
        if std::fs::read(&path).is_ok_and(|old| old == page.as_bytes()) {
            return Ok(());
        }
        // A page can be regenerated at any time and need not survive a power failure.
        let partial = path.with_extension(format!("html.{}.part", std::process::id()));
        std::fs::write(&partial, page)
            .and_then(|()| std::fs::rename(&partial, &path))
            .map_err(|cause| write_error(&path, &cause))
    }

    /// Returns the links to the previous and next pages, or an empty string if there is only one
    /// page.
    fn page_links(&self) -> String {
        let pages = (self.counts.done + self.counts.failed).div_ceil(PAGE_RECORDS).max(1);
        if pages == 1 {
            return String::new();
        }
        let link = |page: u64, text: &str| match page {
            page if (1..=pages).contains(&page) => {
                format!("<a href=\"./{}\">{text}</a>", page_name(page))
            }
            _ => text.to_owned(),
        };
        let (before, after) = (link(self.page - 1, "previous"), link(self.page + 1, "next"));
        let (first, last) = (link(1, "first"), link(pages, "last"));
        let at = self.page;
        format!("<nav>{first} · {before} · page {at} of {pages} · {after} · {last}</nav>\n")
    }

    fn page_path(&self, page: u64) -> PathBuf {
        self.out_dir.join(page_name(page))
    }
}

/// Returns the file name of a page.
fn page_name(page: u64) -> String {
    if page == 1 { "index.html".to_owned() } else { format!("index-{page}.html") }
}

/// The head of the page, with its style sheet.
const PAGE_HEAD: &str = "<!DOCTYPE html>
<html lang=\"en\">
<meta charset=\"utf-8\">
<title>Contact sheet</title>
<style>
body { font: 14px/1.4 sans-serif; margin: 2em; background: #f4f1ea; color: #222 }
main { display: grid; grid-template-columns: repeat(auto-fill, minmax(200px, 1fr)); gap: 1em }
figure { margin: 0; overflow-wrap: anywhere } nav { margin: 1em 0 }
img { width: 100%; background: #fff; border: 1px solid #ccc } pre { white-space: pre-wrap }
</style>
";

/// Converts a path to a relative URL, percent-encoded.
///
/// The leading `./` marks it as relative even if the name looks absolute.
///
/// ```text
/// a b/c#d.png  ─►  ./a%20b/c%23d.png
/// ```
fn relative_url(path: &str) -> String {
    format!("./{}", percent_encode(path))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::merge::merge_reports;
    use crate::test_records::{ReportFolder, done_record, failed_record};

    /// Writes the sheet of a report with these counts, and returns its page names.
    fn write_sheet(folder: &ReportFolder, done: usize, failed: usize) -> Vec<String> {
        let records: Vec<_> = (0..done)
            .map(|at| done_record(&format!("{at:04}.png"), "k"))
            .chain((0..failed).map(|at| failed_record(&format!("<{at}>.png"), "k")))
            .collect();
        let _ = std::fs::remove_file(folder.path().join(MERGED_REPORT));
        folder.add_report("reports/1-of-1.a.1.1.jsonl", &records);
        let counts = merge_reports(folder.path(), None).unwrap();
        write_contact_sheet(folder.path(), &counts).unwrap();
        let entries = std::fs::read_dir(folder.path()).unwrap();
        let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
        let mut names: Vec<String> = names.filter(|name| name.contains("index")).collect();
        names.sort();
        names
    }

    #[test]
    fn names_are_escaped() {
        assert_eq!(relative_url("a b/c#d%.png"), "./a%20b/c%23d%25.png");
        assert_eq!(escape_markup("<a & \"b\">"), "&lt;a &amp; &quot;b&quot;&gt;");
    }

    #[test]
    fn pictures_are_paged_and_failures_follow_them() {
        let folder = ReportFolder::new("sheet");
        assert_eq!(write_sheet(&folder, 999, 2), ["index-2.html", "index-3.html", "index.html"]);
        let pages =
            ["index.html", "index-2.html", "index-3.html"].map(|name| folder.read_text(name));
        let count = |page: &str, word: &str| page.matches(word).count();
        let figures = pages.each_ref().map(|page| count(page, "<figure>"));
        let failures = pages.each_ref().map(|page| count(page, "<dt>"));
        assert_eq!((figures, failures), ([500, 499, 0], [0, 1, 1]));
        for page in &pages {
            assert!(page.contains("999 pictures, 2 failed"), "{page}");
            assert!(page.contains("of 3") && !page.contains("<0>"), "{page}");
        }
        assert!(pages[1].contains("href=\"./index.html\"") && pages[1].contains("./index-3.html"));
    }

    #[test]
    fn surplus_pages_of_an_earlier_sheet_are_removed() {
        let folder = ReportFolder::new("sheet-shorter");
        assert_eq!(write_sheet(&folder, 1001, 0).len(), 3);
        assert_eq!(write_sheet(&folder, 1, 1), ["index.html"]);
        let page = folder.read_text("index.html");
        assert!(!page.contains("<nav>") && page.contains("./0000.png"), "{page}");
        assert_eq!(write_sheet(&folder, 0, 0), ["index.html"]);
    }
}
