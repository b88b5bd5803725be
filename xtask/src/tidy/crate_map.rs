//! The crate map in `ARCHITECTURE.md`, generated from `cargo metadata`, and the maximum size of a
//! crate.

use super::boundaries::LAYERS;
use super::{Source, Violation};
use crate::Outcome;
use crate::metadata::{Metadata, short_name};
use crate::workspace::{project_root, read_text};
use std::collections::BTreeSet;

const DOCUMENT: &str = "ARCHITECTURE.md";
/// The markers before and after the map in the document.
const BEFORE: &str =
    "<!-- The crates: `cargo xtask tidy --bless` writes these lines. -->\n\n```text\n";
const AFTER: &str = "```\n";

/// The number of source lines, without tests, above which a crate must be split.
const MAX_CRATE_LINES: usize = 13_000;
/// Crates that are yet to be split, each with its limit until then.
const STILL_WHOLE: &[(&str, usize)] = &[("alberti", 14_700)];

/// Returns a violation if the map does not match the manifests.
pub fn outdated_map() -> Result<Vec<Violation>, String> {
    let text = read_text(&project_root().join(DOCUMENT))?;
    let is_current = with_map(&text, &crate_map(&Metadata::load()?))? == text;
    let message = "the crate map is outdated: run `cargo xtask tidy --bless`";
    Ok((!is_current).then(|| Violation::new(DOCUMENT, message)).into_iter().collect())
}

/// Writes the map into the document.
pub fn write_map() -> Outcome {
    let path = project_root().join(DOCUMENT);
    let text = read_text(&path)?;
    let current = with_map(&text, &crate_map(&Metadata::load()?))?;
    std::fs::write(&path, current).map_err(|error| format!("{DOCUMENT}: {error}"))
}

fn with_map(text: &str, map: &str) -> Result<String, String> {
    let missing = || format!("{DOCUMENT} has no markers for the crate map");
    let (head, rest) = text.split_once(BEFORE).ok_or_else(missing)?;
    let (_, tail) = rest.split_once(AFTER).ok_or_else(missing)?;
    Ok(format!("{head}{BEFORE}{map}{AFTER}{tail}"))
}

/// Returns a line for each crate, from the bottom up, with the crates it depends on. Crates on
/// which another listed crate already depends are omitted.
fn crate_map(metadata: &Metadata) -> String {
    let width = LAYERS.iter().map(|(name, _)| name.len()).max().unwrap_or_default();
    let line = |name: &str| {
        let below = direct_dependencies(metadata, name);
        let is_implied = |dependency: &&str| {
            below.iter().any(|other| all_below(metadata, other).contains(*dependency))
        };
        let shown: Vec<&str> = below.iter().copied().filter(|name| !is_implied(name)).collect();
        format!("{name:width$}  {}", shown.join(", ")).trim_end().to_owned() + "\n"
    };
    LAYERS.iter().map(|(name, _)| line(name)).collect()
}

/// Returns the crates on the map that a manifest names, in the order of the map.
fn direct_dependencies<'a>(metadata: &'a Metadata, name: &str) -> Vec<&'a str> {
    let Some(package) = metadata.package(name) else { return Vec::new() };
    let names: BTreeSet<&str> =
        package.dependencies.iter().map(|dependency| short_name(dependency)).collect();
    LAYERS.iter().filter_map(|(name, _)| names.get(name).copied()).collect()
}

fn all_below<'a>(metadata: &'a Metadata, name: &str) -> BTreeSet<&'a str> {
    let direct = direct_dependencies(metadata, name);
    let further = direct.iter().flat_map(|below| all_below(metadata, below));
    further.chain(direct.iter().copied()).collect()
}

/// Finds crates that have become too large to understand as a whole.
pub fn crate_lengths(sources: &[Source]) -> Vec<Violation> {
    let lines = |name: &str| {
        let folder = format!("crates/{name}/src/");
        let files = sources.iter().filter(|source| source.path.starts_with(&folder));
        let code = files.filter(|source| !is_test_file(&source.path));
        code.map(|source| source.text.lines().count()).sum::<usize>()
    };
    let too_long = |(name, _): &(&str, _)| {
        let lines = lines(name);
        let whole = STILL_WHOLE.iter().find(|(whole, _)| whole == name);
        let most = whole.map_or(MAX_CRATE_LINES, |(_, most)| *most);
        (lines > most).then(|| {
            let message = format!("{lines} lines, but at most {most} are allowed: split the crate");
            Violation::new(format!("crates/{name}"), message)
        })
    };
    LAYERS.iter().filter_map(too_long).collect()
}

fn is_test_file(path: &str) -> bool {
    path.ends_with("/tests.rs") || path.contains("/tests/")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_new_map_replaces_the_old_one() {
        let text = format!("# A\n{BEFORE}old\n{AFTER}end\n");
        assert_eq!(with_map(&text, "new\n"), Ok(format!("# A\n{BEFORE}new\n{AFTER}end\n")));
        assert!(with_map("# A\n", "new\n").is_err());
    }

    #[test]
    fn a_crate_above_the_limit_is_reported_and_tests_do_not_count() {
        let long = |path: &str| Source::new(path, "\n".repeat(MAX_CRATE_LINES));
        let tests = [long("crates/clip/src/tests.rs"), long("crates/clip/src/lib.rs")];
        assert_eq!(crate_lengths(&tests), []);
        let code = [long("crates/clip/src/a.rs"), Source::new("crates/clip/src/lib.rs", "\n")];
        assert_eq!(crate_lengths(&code).len(), 1);
    }
}
