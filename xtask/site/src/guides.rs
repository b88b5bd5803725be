//! Runs the commands in the guides, to check their output and to update their pictures.
//!
//! The commands run in a folder that initially contains only the models that the guide links to.
//! Code blocks have these meanings:
//!
//! - `sh` is run by the shell, where `alberti` is the program. Pictures that the commands write are
//!   shown below the block. Warnings are failures too.
//! - `text` directly after an `sh` block is the expected output. A line `…` matches any number of
//!   lines, and a line that ends in `…` matches any ending.
//! - A block with a file name after its language, such as `ron two_views.ron`, is written to that
//!   file.
//!
//! All other blocks are only shown.

use crate::Outcome;
use crate::files::{copy, empty_folder, relative, write};
use crate::markdown::{Part, divide, escape};
use crate::program::Program;
use crate::site::Site;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

const FOLDER: &str = "docs/guide";

/// The maximum number of pictures shown below a block.
const MOST_PICTURES: usize = 6;

/// Returns the paths of the guides, the overview first.
pub fn guide_paths(site: &Site) -> Result<Vec<String>, String> {
    let mut names = site.names_in(FOLDER)?;
    names.retain(|name| name.ends_with(".md"));
    names.sort_by_key(|name| (name != "README.md", name.clone()));
    Ok(names.into_iter().map(|name| format!("{FOLDER}/{name}")).collect())
}

/// Runs the commands of all guides and adds their pages.
pub fn run_guides(site: &mut Site, program: &Program) -> Outcome {
    for path in guide_paths(site)? {
        let page = crate::documents::place_for(&site.root, &path);
        let text = site.read_text(&path)?;
        let run = GuideRun::new(site, &path, &page, &text)?;
        let text =
            run.run_blocks(site, program, &text).map_err(|error| format!("{path}: {error}"))?;
        let document = site.translate(&path, &page, &text)?;
        site.add_page(&page, Some("Guides"), document);
    }
    Ok(())
}

/// A guide whose commands are being run.
struct GuideRun {
    /// The folder in which the commands run.
    folder: PathBuf,
    /// The guide's page in the site.
    page: String,
}

impl GuideRun {
    fn new(site: &Site, path: &str, page: &str, text: &str) -> Result<Self, String> {
        let name = path.trim_end_matches(".md").rsplit('/').next().unwrap_or_default();
        let folder = std::path::absolute(site.out.with_extension("run").join(name));
        let folder = folder.map_err(|error| error.to_string())?;
        empty_folder(&folder)?;
        for model in linked_models(text) {
            let name = model.rsplit('/').next().unwrap_or(model);
            copy(&site.root.join(model), &folder.join(name))?;
        }
        Ok(Self { folder, page: page.to_owned() })
    }

    /// Runs the blocks of the text. Returns the text with the pictures inserted after the blocks
    /// that wrote them.
    fn run_blocks(&self, site: &Site, program: &Program, text: &str) -> Result<String, String> {
        let mut result = String::new();
        let mut printed = None;
        for part in divide(text) {
            let (words, code) = match part {
                Part::Text(text) => {
                    printed = printed.filter(|_| text.trim().is_empty());
                    result += &text;
                    continue;
                }
                Part::Code(words, code) => (words, code),
            };
            result += &format!("```{words}\n{code}```\n");
            let mut pictures = String::new();
            match (words.as_str(), printed.take()) {
                ("sh", _) => {
                    let before = self.file_times();
                    printed = Some(program.run_script(&self.folder, &code)?);
                    pictures = self.new_pictures(site, &before)?;
                }
                ("text", Some(printed)) => compare(&code, &printed)?,
                (words, _) => {
                    if let Some((_, file)) = words.split_once(' ') {
                        write(&self.folder.join(file), code.as_bytes())?;
                    }
                }
            }
            result += &pictures;
        }
        Ok(result)
    }

    /// Returns all files with their modification times.
    fn file_times(&self) -> BTreeMap<PathBuf, SystemTime> {
        let mut found = BTreeMap::new();
        list_files(&self.folder, &mut found);
        found
    }

    /// Copies changed pictures into the site and returns the HTML that shows them.
    fn new_pictures(
        &self,
        site: &Site,
        before: &BTreeMap<PathBuf, SystemTime>,
    ) -> Result<String, String> {
        let mut html = String::new();
        let after = self.file_times();
        let is_picture = |path: &Path| {
            let ending = path.extension().unwrap_or_default();
            ["png", "svg", "gif"].iter().any(|known| ending == *known)
        };
        let changed = after
            .iter()
            .filter(|(path, time)| is_picture(path) && before.get(*path) != Some(time))
            .map(|(path, _)| path);
        for path in changed.take(MOST_PICTURES) {
            let name = path.strip_prefix(&self.folder).unwrap_or(path).to_string_lossy();
            let place = format!("{}/{name}", self.page.trim_end_matches(".html"));
            copy(path, &site.out.join(&place))?;
            let (source, name) = (escape(&relative(&self.page, &place)), escape(&name));
            html += &format!(
                "<figure><img src=\"{source}\" loading=\"lazy\" alt=\"{name}\"><figcaption>{name}</figcaption></figure>\n"
            );
        }
        // Markdown passes HTML through unchanged if it is between blank lines.
        Ok(if html.is_empty() { html } else { format!("\n<div class=\"made\">\n{html}</div>\n\n") })
    }
}

fn list_files(folder: &Path, found: &mut BTreeMap<PathBuf, SystemTime>) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        match entry.metadata() {
            Ok(about) if about.is_dir() => list_files(&path, found),
            Ok(about) => {
                found.insert(path, about.modified().unwrap_or(SystemTime::UNIX_EPOCH));
            }
            Err(_) => {}
        }
    }
}

/// Returns the repository paths of the models that a guide links to.
fn linked_models(text: &str) -> Vec<&str> {
    let targets = text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    let mut models: Vec<&str> = targets
        .filter_map(|target| target.strip_prefix("../../"))
        .filter(|path| path.starts_with("scenes/models/"))
        .collect();
    models.sort_unstable();
    models.dedup();
    models
}

/// Checks that a block printed the expected text.
fn compare(expected: &str, printed: &str) -> Outcome {
    let mut lines = printed.lines().map(str::trim_end);
    let mut may_skip = false;
    for wanted in expected.lines().map(str::trim_end) {
        if wanted == "…" {
            may_skip = true;
            continue;
        }
        let matches = |line: &str| match wanted.strip_suffix('…') {
            Some(start) => line.starts_with(start),
            None => line == wanted,
        };
        let found = if may_skip { lines.any(matches) } else { lines.next().is_some_and(matches) };
        if !found {
            return Err(format!("the guide expects\n{wanted}\nbut the output is\n{printed}"));
        }
        may_skip = false;
    }
    if may_skip || lines.next().is_none() {
        return Ok(());
    }
    Err(format!("the output has more lines than the guide expects:\n{printed}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn output_is_compared_line_by_line() {
        let printed = "one\ntwo 2.5 ms\nthree\n";
        for right in ["one\ntwo 2.5 ms\nthree\n", "one\ntwo …\nthree", "…\nthree", "one\n…"] {
            assert_eq!(compare(right, printed), Ok(()), "{right}");
        }
        for wrong in ["one\ntwo …", "two …\n…", "…\nfour\n…", "one\nthree\n…"] {
            assert!(compare(wrong, printed).is_err(), "{wrong}");
        }
    }

    #[test]
    fn linked_models_are_found() {
        let text = "[a](../../scenes/models/a.glb), [b](../conventions.md), [a](../../scenes/models/a.glb)";
        assert_eq!(linked_models(text), ["scenes/models/a.glb"]);
    }
}
