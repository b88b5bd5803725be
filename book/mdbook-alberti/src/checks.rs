//! Checks the pages and the built book: links and anchors, sizes, ids, topics, committed figures.

use crate::arguments::Arguments;
use crate::edition::Edition;
use crate::language::Language;
use crate::marks::Marks;
use crate::page::{Page, plain_text};
use crate::topics::Topics;
use crate::translation::translate_page;
use anyhow::{Result, anyhow};
use polib::catalog::Catalog;
use polib::metadata::CatalogMetadata;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// The maximum size of a page with its figures, in bytes.
const PAGE_LIMIT: u64 = 400_000;

/// The error for a link to a missing file.
const NO_FILE: &str = "the file does not exist";

/// The page that lists every misprint.
const MISPRINTS: &str = "printed-wrong";

/// Runs all checks; prints counts and errors.
pub fn check(arguments: &Arguments) -> Result<()> {
    let edition = arguments.edition()?;
    let mut faults = source_faults(&edition)?;
    for language in Language::ALL {
        let folder = edition.out.join(language.code());
        faults.extend(edition_faults(&folder, &edition)?);
    }
    faults.iter().for_each(|fault| println!("{fault}"));
    if faults.is_empty() { Ok(()) } else { Err(anyhow!("{} errors in the book", faults.len())) }
}

/// Finds errors in the page sources.
fn source_faults(edition: &Edition) -> Result<Vec<String>> {
    let mut faults = Vec::new();
    let mut pages = Vec::new();
    let mut formulas: BTreeMap<String, String> = BTreeMap::new();
    for (name, title) in edition.pages()? {
        let path = edition.source.join(format!("{name}.md"));
        let text =
            fs::read_to_string(&path).map_err(|error| anyhow!("{}: {error}", path.display()))?;
        let english = Marks::read(&text);
        for fence in english.fences.iter().filter(|fence| fence.kind() == "formula") {
            let (id, here) = (fence.arguments(), format!("{name}.md:{}", fence.line));
            if let Some(other) = formulas.get(id).filter(|_| !id.is_empty()) {
                faults.push(format!("{here}: formula {id} also appears at {other}"));
            }
            formulas.insert(id.to_owned(), here);
        }
        faults.extend(round_trip_fault(&text).map(|fault| format!("{name}.md: {fault}")));
        let marks = Marks::read(&text);
        pages.push(Page { name, title, english, text, marks });
    }
    let topics = Topics::parse(&fs::read_to_string(edition.root.join("tests/CONFORMANCE.md"))?);
    if edition.is_partial {
        return Ok(faults);
    }
    faults.extend(topics.missing(&pages).iter().map(|id| format!("no page marks the topic {id}")));
    faults.extend(unnamed_misprints(&topics, &pages));
    faults.extend(committed_figures(edition)?);
    println!(
        "{} pages, {} numbered formulas, {} topics",
        pages.len(),
        formulas.len(),
        topics.titles().count()
    );
    Ok(faults)
}

/// Describes the first mark that changes when a page is split into messages and reassembled.
fn round_trip_fault(text: &str) -> Option<String> {
    let again = match translate_page(text, &Catalog::new(CatalogMetadata::new())) {
        Ok(again) => again,
        Err(error) => return Some(error),
    };
    let parts = |text: &str| {
        let marks = Marks::read(text);
        let codes = marks.spans.iter().map(|span| span.code.clone());
        let blocks = marks.fences.iter().map(|it| {
            let words =
                it.caption.as_ref().map_or(String::new(), |caption| plain_text(&caption.text));
            format!("{} {} {words}", it.info, it.body)
        });
        codes.chain(blocks).chain(marks.heading_ids()).collect::<Vec<_>>()
    };
    let (before, after) = (parts(text), parts(&again));
    let lost = before.iter().zip(&after).find(|(a, b)| a != b);
    let fault = lost.map(|(a, b)| format!("translation would change `{a}` to `{b}`"));
    fault.or((before.len() != after.len()).then(|| "translation would lose marks".into()))
}

fn unnamed_misprints(topics: &Topics, pages: &[Page]) -> Vec<String> {
    let of_page: Vec<&Page> = pages.iter().filter(|page| page.name == MISPRINTS).collect();
    let named: BTreeSet<&str> = of_page
        .iter()
        .flat_map(|page| &page.english.spans)
        .map(|span| span.code.as_str())
        .collect();
    let misprints = topics.ids().filter(|id| id.starts_with('M'));
    misprints
        .filter(|id| !named.contains(id))
        .map(|id| format!("{MISPRINTS}.md: {id} is missing"))
        .collect()
}

/// Finds pictures among the book's committed files.
fn committed_figures(edition: &Edition) -> Result<Vec<String>> {
    let mut git = std::process::Command::new("git");
    let output = git.current_dir(&edition.book).args(["ls-files", "."]).output();
    let Ok(output) = output.map_err(|error| println!("SKIPPED book: git ls-files: {error}")) else {
        return Ok(Vec::new());
    };
    let files = String::from_utf8_lossy(&output.stdout).into_owned();
    let is_picture = |name: &&str| {
        ["svg", "png", "jpg", "pdf"].iter().any(|end| name.ends_with(&format!(".{end}")))
    };
    Ok(files
        .lines()
        .filter(is_picture)
        .map(|name| format!("book/{name}: figures are generated, so do not commit them"))
        .collect())
}

/// Finds errors in the built pages.
fn edition_faults(folder: &Path, edition: &Edition) -> Result<Vec<String>> {
    let mut faults = Vec::new();
    let mut pages: BTreeMap<PathBuf, String> = BTreeMap::new();
    for (name, _) in edition.pages()? {
        let path = folder.join(format!("{name}.html"));
        let html =
            fs::read_to_string(&path).map_err(|error| anyhow!("{}: {error}", path.display()))?;
        pages.insert(path, html);
    }
    let path = folder.join("print.html");
    let print = fs::read_to_string(&path)?;
    let (mut largest, mut links) = ((0, String::new()), 0);
    for (path, html) in &pages {
        let size = html.len() as u64 + figure_bytes(path, html);
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if size > PAGE_LIMIT {
            faults.push(format!(
                "{}: {size} bytes with its figures; the limit is {PAGE_LIMIT}",
                path.display()
            ));
        }
        largest = largest.max((size, name));
        faults.extend(
            repeated_ids(html)
                .iter()
                .map(|id| format!("{}: the id `{id}` appears more than once", path.display())),
        );
    }
    pages.insert(path, print);
    let mut cache = BTreeMap::new();
    for (path, html) in &pages {
        for link in attributes(html, &["href", "src"]) {
            links += 1;
            // In a partial build, links to missing pages are not reported.
            let is_left_out = edition.is_partial
                && link.split('#').next().is_some_and(|file| file.ends_with(".html"));
            if let Some(fault) = link_fault(path, link, &pages, &mut cache)
                && !(is_left_out && fault == NO_FILE)
            {
                faults.push(format!("{}: {link}: {fault}", path.display()));
            }
        }
    }
    println!(
        "{}: {links} links; the largest page is {} with {} bytes",
        folder.display(),
        largest.1,
        largest.0
    );
    Ok(faults)
}

/// Returns the total size of a page's figures in bytes.
fn figure_bytes(path: &Path, html: &str) -> u64 {
    let figures: BTreeSet<&str> =
        attributes(html, &["src"]).filter(|src| src.starts_with("figures/")).collect();
    let folder = path.parent().unwrap_or(Path::new("."));
    figures.iter().filter_map(|src| Some(fs::metadata(folder.join(src)).ok()?.len())).sum()
}

fn repeated_ids(html: &str) -> Vec<&str> {
    let mut seen = BTreeSet::new();
    attributes(html, &["id"]).filter(|id| !seen.insert(*id)).collect()
}

/// Returns the values of the named attributes outside scripts.
fn attributes<'a>(html: &'a str, names: &'a [&str]) -> impl Iterator<Item = &'a str> {
    let parts = html.split("<script").enumerate().map(|(at, part)| {
        if at == 0 { part } else { part.split_once("</script>").map_or("", |(_, rest)| rest) }
    });
    parts.flat_map(move |part| {
        names.iter().flat_map(move |name| {
            let values = part.match_indices(name).filter_map(move |(at, _)| {
                let is_start = part[..at].ends_with([' ', '\n']);
                let value = part[at + name.len()..].strip_prefix("=\"").filter(|_| is_start)?;
                value.split('"').next()
            });
            values.collect::<Vec<_>>()
        })
    })
}

/// Returns why a link is broken, or `None` if it works or needs no check.
fn link_fault(
    page: &Path,
    link: &str,
    pages: &BTreeMap<PathBuf, String>,
    cache: &mut BTreeMap<PathBuf, Option<String>>,
) -> Option<&'static str> {
    if ["http://", "https://", "mailto:", "data:"].iter().any(|scheme| link.starts_with(scheme)) {
        return None;
    }
    let link = link.replace("&amp;", "&");
    let (file, anchor) =
        link.split_once('#').map_or((link.as_str(), None), |(file, anchor)| (file, Some(anchor)));
    let target =
        if file.is_empty() { page.to_owned() } else { normal_path(&page.parent()?.join(file)) };
    if !target.is_file() {
        return Some(NO_FILE);
    }
    // The fragment of a link to the explorer's page is a state, not an anchor.
    let anchor = anchor.filter(|_| !target.ends_with("explorer/index.html"))?;
    let html = pages.get(&target).or_else(|| {
        let read = cache.entry(target.clone()).or_insert_with(|| fs::read_to_string(&target).ok());
        read.as_ref()
    })?;
    let is_there = attributes(html, &["id"]).any(|id| id == anchor);
    (!is_there).then_some("the anchor does not exist")
}

/// Resolves `..` in a path.
fn normal_path(path: &Path) -> PathBuf {
    let mut out = PathBuf::new();
    for part in path.components() {
        if part == std::path::Component::ParentDir {
            out.pop();
        } else {
            out.push(part);
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn attributes_in_scripts_are_ignored() {
        let html = "<a href=\"a\" data-href=\"b\"><script src=\"x\">let a = '<a href=\"c\">';</script><img src=\"d\">";
        assert_eq!(attributes(html, &["href", "src"]).collect::<Vec<_>>(), ["a", "d"]);
        assert_eq!(repeated_ids("<p id=\"a\"><p id=\"b\"><p id=\"a\">"), ["a"]);
    }

    #[test]
    fn broken_links_are_found() {
        let folder = std::env::temp_dir().join("mdbook-alberti-links");
        fs::create_dir_all(&folder).unwrap();
        let page = folder.join("a.html");
        fs::write(&page, "<p id=\"x\">").unwrap();
        let pages = BTreeMap::from([(page.clone(), "<p id=\"x\">".to_owned())]);
        let fault = |link: &str| link_fault(&page, link, &pages, &mut BTreeMap::new());
        for good in ["#x", "a.html", "a.html#x", "https://example.org/#y"] {
            assert_eq!(fault(good), None, "{good}");
        }
        for bad in ["#y", "b.html", "a.html#y"] {
            assert!(fault(bad).is_some(), "{bad}");
        }
    }
}
