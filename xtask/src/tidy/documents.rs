//! Rules for Markdown documents: links and paths must lead to files, and code blocks must name a
//! language.

use super::Violation;
use super::source::text_files;
use crate::workspace::{project_root, read_text};
use std::path::Path;

/// Folders of the workspace. A word in a document that begins with one of them is a path.
const FOLDERS: [&str; 5] = ["crates/", "scenes/", "tests/", "xtask/", ".ci/"];

/// Finds broken links and paths, and code blocks without a language.
pub fn broken_links() -> Result<Vec<Violation>, String> {
    let files = text_files()?;
    let documents = files.iter().filter(|(path, _)| path.ends_with(".md"));
    Ok(documents
        .flat_map(|(path, text)| document_links(path, text, |at| project_root().join(at).exists()))
        .collect())
}

/// Checks that the version in `CITATION.cff` is the workspace version.
pub fn citation_version() -> Result<Vec<Violation>, String> {
    let read = |name: &str| read_text(&project_root().join(name));
    let (citation, manifest) = (read("CITATION.cff")?, read("Cargo.toml")?);
    let cited = citation.lines().find_map(|line| line.strip_prefix("version: "));
    let is_ours = |cited: &str| manifest.contains(&format!("\nversion = \"{cited}\"\n"));
    let message = "use the version from the workspace's Cargo.toml";
    let fault = (!cited.is_some_and(is_ours)).then(|| Violation::new("CITATION.cff", message));
    Ok(fault.into_iter().collect())
}

fn document_links(path: &str, text: &str, exists: impl Fn(&Path) -> bool) -> Vec<Violation> {
    let folder = Path::new(path).parent().unwrap_or(Path::new(""));
    let mut faults = Vec::new();
    let mut fenced = false;
    for (i, line) in text.lines().enumerate() {
        let place = || format!("{path}:{}", i + 1);
        if let Some(language) = line.trim_start().strip_prefix("```") {
            if !fenced && language.trim().is_empty() {
                faults.push(Violation::new(place(), "specify the language of this code block"));
            }
            fenced = !fenced;
            continue;
        }
        let missing = |target: &&str| !exists(&folder.join(target));
        for target in link_targets(line).filter(|_| !fenced).filter(missing) {
            faults.push(Violation::new(place(), format!("`{target}` does not exist")));
        }
        for target in project_paths(line).filter(|target| !exists(Path::new(target))) {
            faults.push(Violation::new(place(), format!("`{target}` does not exist")));
        }
    }
    if fenced {
        faults.push(Violation::new(path, "a code block is not closed"));
    }
    faults
}

/// Returns the targets of the Markdown links to files in a line.
fn link_targets(line: &str) -> impl Iterator<Item = &str> {
    let targets =
        line.split("](").skip(1).filter_map(|rest| rest.split_once(')')).map(|(target, _)| target);
    let files = targets.map(|target| target.split('#').next().unwrap_or(target));
    files.filter(|target| !target.is_empty() && !target.contains("://"))
}

/// Returns the words in a line that are paths from the workspace root. Placeholders such as `NAME`
/// do not count.
fn project_paths(line: &str) -> impl Iterator<Item = &str> {
    let words = line.split(|c: char| c.is_whitespace() || "`()[]\"',;|".contains(c));
    let words = words.map(|word| word.trim_end_matches(['.', ':']));
    let placeholder =
        |word: &str| word.contains(['*', '<', '{', '…', '$']) || word.contains("NAME");
    words.filter(move |word| {
        FOLDERS.iter().any(|folder| word.starts_with(folder)) && !placeholder(word)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn faults(text: &str) -> usize {
        let exists = |path: &Path| {
            ["scenes/a.ron", "docs/b.md"].iter().any(|known| path == Path::new(known))
        };
        document_links("docs/x.md", text, exists).len()
    }

    #[test]
    fn links_are_followed_from_the_document_and_paths_from_the_root() {
        let table = [
            ("[b](b.md) and [web](https://example.org)", 0),
            ("[c](c.md) and [b](b.md#part)", 1),
            ("run `alberti render scenes/a.ron`.", 0),
            ("run `alberti render scenes/c.ron`", 1),
            ("`tests/goldens/NAME.png` and `crates/*`", 0),
        ];
        for (line, expected) in table {
            assert_eq!(faults(line), expected, "{line}");
        }
    }

    #[test]
    fn code_blocks_must_have_a_language_and_be_closed() {
        assert_eq!(
            (faults("```rust\n[a](c)\n```"), faults("```\nx\n```"), faults("```sh\nx")),
            (0, 1, 1)
        );
    }
}
