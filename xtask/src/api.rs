//! `cargo xtask api`: compares the public interface of each library with its committed listing.
//!
//! ```text
//! api [--bless]
//! ```
//! `docs/api/CRATE.txt` lists declarations, methods and implemented traits. A change to the
//! interface changes these files, so that it shows up in review. The listings are also compared
//! with the last release tag `v…`: if anything that a caller may use has been removed or changed,
//! the first nonzero version number must be raised.

mod listing;

use crate::Outcome;
use crate::program::{capture_output, cargo_command};
use crate::skip::report_skip;
use crate::workspace::{create_folder, project_root, read_text, target_folder};
use listing::crate_listing;
use std::collections::BTreeMap;
use std::fs;
use std::process::Command;

/// Returns the libraries with a stability promise: the crates on the map, except for the program's
/// library, which is not meant for other programs.
fn libraries() -> impl Iterator<Item = &'static str> {
    crate::tidy::LAYERS.iter().map(|(name, _)| *name).filter(|name| *name != "alberti")
}

/// The compiler version of the listings. Rustdoc's pages change from version to version.
const COMPILER: &str = "1.95";

const FOLDER: &str = "docs/api";

/// The maximum number of lines printed per difference.
const MAX_PRINTED: usize = 40;

/// Compares the listings, or writes them with `--bless`.
pub fn run_api(arguments: &[String]) -> Outcome {
    let bless = match arguments {
        [] => false,
        [flag] if flag == "--bless" => true,
        _ => return Err(format!("unknown arguments `{}`", arguments.join(" "))),
    };
    let version = capture_output(Command::new("rustdoc").arg("--version"))?;
    if !version.starts_with(&format!("rustdoc {COMPILER}.")) {
        report_skip(
            "api",
            &format!("the listings are from rustdoc {COMPILER}, but this is {}", version.trim()),
        );
        return Ok(());
    }
    // This is the command of the step `docs`, so that nothing is built twice.
    let mut docs = cargo_command(&["doc", "--quiet", "--workspace", "--no-deps"]);
    capture_output(docs.env("RUSTDOCFLAGS", "-D warnings"))?;
    create_folder(&project_root().join(FOLDER))?;
    let mut faults = Vec::new();
    for name in libraries() {
        let listing = crate_listing(&target_folder().join("doc").join(name.replace('-', "_")))?;
        let path = project_root().join(FOLDER).join(format!("{name}.txt"));
        if bless {
            fs::write(&path, &listing).map_err(|error| format!("{}: {error}", path.display()))?;
        } else {
            let change = ApiChange::between(&read_text(&path).unwrap_or_default(), &listing);
            faults.extend(change.fault(name));
        }
        faults.extend(fault_since_release(name, &listing)?);
    }
    if faults.is_empty() {
        println!("{} interfaces match {FOLDER}", libraries().count());
        return Ok(());
    }
    Err(faults.join("\n"))
}

/// The lines removed from and added to a listing.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
struct ApiChange {
    removed: Vec<String>,
    added: Vec<String>,
}

impl ApiChange {
    fn between(old: &str, new: &str) -> Self {
        let [old, new] = [old, new].map(item_lines);
        let beyond = |these: &BTreeMap<String, usize>, those: &BTreeMap<String, usize>| {
            let missing = |(line, count): (&String, &usize)| {
                (those.get(line).copied().unwrap_or(0) < *count).then(|| line.clone())
            };
            these.iter().filter_map(missing).collect()
        };
        Self { removed: beyond(&old, &new), added: beyond(&new, &old) }
    }

    /// Returns the message for a listing that differs from the committed one.
    fn fault(&self, name: &str) -> Option<String> {
        if self.removed.is_empty() && self.added.is_empty() {
            return None;
        }
        Some(format!(
            "the public interface of `{name}` does not match {FOLDER}/{name}.txt:\n{}\
             \n  = help: if this is intended, run `cargo xtask api --bless` and describe the change \
             in CHANGELOG.md; lines with - break callers",
            self.shown_lines()
        ))
    }

    fn shown_lines(&self) -> String {
        let removed = self.removed.iter().map(|line| format!("  - {line}"));
        let lines: Vec<String> =
            removed.chain(self.added.iter().map(|line| format!("  + {line}"))).collect();
        let rest = match lines.len().saturating_sub(MAX_PRINTED) {
            0 => String::new(),
            rest => format!("\n  … and {rest} more lines"),
        };
        lines.iter().take(MAX_PRINTED).cloned().collect::<Vec<_>>().join("\n") + &rest
    }
}

/// Counts how often each line occurs under its item, whose name is put in front of the line.
fn item_lines(listing: &str) -> BTreeMap<String, usize> {
    let (mut item, mut lines) = ("", BTreeMap::new());
    for line in listing.lines() {
        let text = match line.strip_prefix(' ') {
            Some(_) => format!("{item}: {}", line.trim()),
            None => line.to_owned(),
        };
        if !line.starts_with(' ') {
            item = line;
        }
        *lines.entry(text).or_insert(0) += 1;
    }
    lines
}

/// Reports items removed since the last release if the version does not allow that.
fn fault_since_release(name: &str, listing: &str) -> Result<Option<String>, String> {
    let mut describe = Command::new("git");
    describe.args(["describe", "--tags", "--abbrev=0", "--match", "v[0-9]*"]);
    let Ok(tag) = capture_output(describe.current_dir(project_root())) else {
        // There is no release yet, or the history is missing.
        return Ok(None);
    };
    let tag = tag.trim();
    let mut show = Command::new("git");
    show.args(["show", &format!("{tag}:{FOLDER}/{name}.txt")]).current_dir(project_root());
    let Ok(old) = capture_output(&mut show) else { return Ok(None) };
    let removed = ApiChange { added: Vec::new(), ..ApiChange::between(&old, listing) };
    let version = workspace_version(&read_text(&project_root().join("Cargo.toml"))?)?;
    let is_allowed = removed.removed.is_empty()
        || compatibility_number(&version) != compatibility_number(tag.trim_start_matches('v'));
    Ok((!is_allowed).then(|| {
        format!(
            "`{name}` {version} breaks callers of {tag}:\n{}\n  = help: raise the version to the \
             next incompatible one, or restore the removed items",
            removed.shown_lines()
        )
    }))
}

/// Returns the workspace version.
fn workspace_version(manifest: &str) -> Result<String, String> {
    let line = manifest.lines().find_map(|line| line.strip_prefix("version = \""));
    let version = line.and_then(|rest| rest.split('"').next());
    version.map(str::to_owned).ok_or_else(|| "Cargo.toml has no version".into())
}

/// Returns the version numbers up to the first nonzero one: versions that share them are
/// compatible.
fn compatibility_number(version: &str) -> Vec<&str> {
    let numbers: Vec<&str> = version.split(['.', '-', '+']).take(3).collect();
    let first = numbers.iter().position(|number| *number != "0").unwrap_or(numbers.len());
    numbers.into_iter().take(first + 1).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn removed_and_added_lines_are_listed_with_their_item() {
        let old = "a::B\n    pub struct B;\n    impl B\n        pub fn c()\n";
        let new =
            "a::B\n    pub struct B;\n    impl B\n        pub fn d()\na::E\n    pub struct E;\n";
        let change = ApiChange::between(old, new);
        assert_eq!(change.removed, ["a::B: pub fn c()"]);
        assert_eq!(change.added, ["a::B: pub fn d()", "a::E", "a::E: pub struct E;"]);
        assert!(change.fault("a").is_some_and(|text| text.contains("  - a::B: pub fn c()")));
        assert_eq!(ApiChange::between(old, old).fault("a"), None);
    }

    #[test]
    fn the_first_nonzero_number_determines_compatibility() {
        assert_eq!(compatibility_number("0.1.3"), compatibility_number("0.1.9"));
        assert_ne!(compatibility_number("0.1.3"), compatibility_number("0.2.0"));
        assert_eq!(compatibility_number("1.4.0"), compatibility_number("1.5.2"));
        assert_ne!(compatibility_number("0.0.1"), compatibility_number("0.0.2"));
        assert_eq!(
            workspace_version("[workspace.package]\nversion = \"0.1.0\"\n").unwrap(),
            "0.1.0"
        );
    }
}
