//! The book's translation catalogs: templates, updates, checks, coverage.

use crate::arguments::Arguments;
use crate::edition::Edition;
use crate::language::Language;
use crate::marks::Marks;
use crate::style::message_faults;
use crate::topics::Topics;
use crate::translation::{
    find_translation, messages, needs_translation, read_catalog, translate_page, update_catalog,
};
use anyhow::{Result, anyhow, bail};
use polib::catalog::Catalog;
use polib::metadata::CatalogMetadata;
use polib::po_file;
use std::fs;
use std::path::{Path, PathBuf};

/// The page whose catalog contains the topic titles.
const TOPICS: &str = "topics";

/// The name of the catalog with the page titles.
const SUMMARY: &str = "SUMMARY";

/// A page and its messages.
struct Extracted {
    name: String,
    messages: Vec<String>,
}

/// Writes a template, `FOLDER/PAGE.pot`, for each page.
pub fn write_templates(arguments: &Arguments) -> Result<()> {
    let [folder] = &arguments.names[..] else { bail!("usage: pot FOLDER") };
    let folder = Path::new(folder);
    let empty = Catalog::new(CatalogMetadata::new());
    for Extracted { name, messages } in extract(&arguments.edition()?)? {
        write(&update_catalog(&name, "", &messages, &empty), &folder.join(format!("{name}.pot")))?;
    }
    Ok(())
}

/// Updates the catalogs to match the current pages, then prints the coverage.
pub fn update(arguments: &Arguments) -> Result<()> {
    let edition = arguments.edition()?;
    for language in translations() {
        for Extracted { name, messages } in selected(extract(&edition)?, &arguments.names)? {
            let path = catalog_path(&edition, language, &name);
            let old = read_catalog(&path).map_err(|error| anyhow!(error))?;
            let new = update_catalog(&name, language.code(), &messages, &old);
            write(&new, &path)?;
        }
    }
    coverage(arguments)
}

/// Lists the errors in the catalogs; fails if there are any.
pub fn check(arguments: &Arguments) -> Result<()> {
    let edition = arguments.edition()?;
    let mut faults = Vec::new();
    for language in translations() {
        for Extracted { name, messages } in selected(extract(&edition)?, &arguments.names)? {
            let path = catalog_path(&edition, language, &name);
            let catalog = match read_catalog(&path) {
                Ok(catalog) => catalog,
                Err(error) => {
                    faults.push(error);
                    continue;
                }
            };
            for message in catalog.messages() {
                let (msgid, msgstr) = (message.msgid(), message.msgstr().unwrap_or_default());
                let mut found = Vec::new();
                if !messages.iter().any(|known| known == msgid) && needs_translation(msgid) {
                    found.push(
                        "the page has no such message; run `update` to update the catalog"
                            .to_owned(),
                    );
                } else if message.is_fuzzy() {
                    found.push(
                        "this message is fuzzy; compare it with the source, then remove the mark"
                            .into(),
                    );
                } else if !msgstr.is_empty() {
                    found = message_faults(msgid, msgstr);
                }
                let start: String = msgid.chars().take(60).collect();
                faults.extend(found.iter().map(|fault| format!("{name}.po: “{start}”: {fault}")));
            }
            faults.extend(structure_fault(&edition, &name, &catalog)?);
        }
    }
    faults.iter().for_each(|fault| println!("{fault}"));
    if faults.is_empty() { Ok(()) } else { Err(anyhow!("{} errors in the catalogs", faults.len())) }
}

/// Checks that a translated page has as many blocks, captions and headings as its source.
fn structure_fault(edition: &Edition, name: &str, catalog: &Catalog) -> Result<Option<String>> {
    let path = edition.source.join(format!("{name}.md"));
    if name == SUMMARY || !path.is_file() {
        return Ok(None);
    }
    let text = fs::read_to_string(path)?;
    let translated = match translate_page(&text, catalog) {
        Ok(translated) => translated,
        Err(error) => return Ok(Some(format!("{name}.po: {error}"))),
    };
    let count = |text: &str| {
        let marks = Marks::read(text);
        let captions = marks.fences.iter().filter(|fence| fence.caption.is_some()).count();
        [marks.fences.len(), captions, marks.headings.len()]
    };
    let (before, after) = (count(&text), count(&translated));
    Ok((before != after).then(|| {
        format!("{name}.po: the translation has {after:?} fenced blocks, captions and headings, but the source has {before:?}")
    }))
}

/// Prints the translated percentage of each page; fails if a total is below the minimum.
pub fn coverage(arguments: &Arguments) -> Result<()> {
    let edition = arguments.edition()?;
    let mut all_complete = true;
    for language in translations() {
        println!("coverage of {}:", language.code());
        let [mut all, mut done] = [0, 0];
        for Extracted { name, messages } in extract(&edition)? {
            let path = catalog_path(&edition, language, &name);
            let catalog = read_catalog(&path).map_err(|error| anyhow!(error))?;
            let translated =
                messages.iter().filter(|msgid| find_translation(&catalog, msgid).is_some()).count();
            println!(
                "  {name:15} {translated:4} of {:4}  {:5.1} %",
                messages.len(),
                percent(translated, messages.len())
            );
            all += messages.len();
            done += translated;
        }
        println!("  {:15} {done:4} of {all:4}  {:5.1} %", "all pages", percent(done, all));
        all_complete &= arguments.least.is_none_or(|least| percent(done, all) >= least);
    }
    if all_complete {
        Ok(())
    } else {
        Err(anyhow!("less than {}% is translated", arguments.least.unwrap_or(0.0)))
    }
}

fn percent(part: usize, all: usize) -> f64 {
    if all == 0 { 100.0 } else { 100.0 * part as f64 / all as f64 }
}

/// Returns the languages that have catalogs.
fn translations() -> impl Iterator<Item = Language> {
    Language::ALL.into_iter().filter(|language| *language != Language::English)
}

fn catalog_path(edition: &Edition, language: Language, page: &str) -> PathBuf {
    edition.catalogs.join(language.code()).join(format!("{page}.po"))
}

fn selected(pages: Vec<Extracted>, names: &[String]) -> Result<Vec<Extracted>> {
    if let Some(unknown) = names.iter().find(|name| !pages.iter().any(|page| page.name == **name)) {
        bail!("no page `{unknown}`");
    }
    let is_selected = |page: &Extracted| names.is_empty() || names.contains(&page.name);
    Ok(pages.into_iter().filter(is_selected).collect())
}

/// Returns the messages of all pages.
fn extract(edition: &Edition) -> Result<Vec<Extracted>> {
    let pages = edition.pages()?;
    let titles = pages.iter().map(|(_, title)| title.clone()).collect();
    let mut out = vec![Extracted { name: SUMMARY.into(), messages: titles }];
    for (name, _) in pages {
        let path = edition.source.join(format!("{name}.md"));
        let text =
            fs::read_to_string(&path).map_err(|error| anyhow!("{}: {error}", path.display()))?;
        let mut messages =
            messages(&text).map_err(|error| anyhow!("{}: {error}", path.display()))?;
        if name == TOPICS {
            let topics =
                Topics::parse(&fs::read_to_string(edition.root.join("tests/CONFORMANCE.md"))?);
            messages.extend(
                topics.titles().filter(|title| needs_translation(title)).map(str::to_owned),
            );
        }
        out.push(Extracted { name, messages });
    }
    Ok(out)
}

fn write(catalog: &Catalog, path: &Path) -> Result<()> {
    fs::create_dir_all(path.parent().unwrap_or(Path::new(".")))?;
    po_file::write(catalog, path).map_err(|error| anyhow!("{}: {error}", path.display()))?;
    // The library writes an empty line first.
    let text = fs::read_to_string(path)?;
    fs::write(path, format!("{}\n", text.trim()))?;
    println!("{}", path.display());
    Ok(())
}
