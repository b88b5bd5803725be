//! The third-party code in the program, and the licenses that must accompany it.

use crate::program::{capture_output, cargo_command};
use crate::workspace::{project_root, read_text};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// A crate that is linked into the program.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Dependency {
    /// Its name on the registry.
    pub name: String,
    /// Its version.
    pub version: String,
    /// Its license, as an SPDX expression.
    pub license: String,
    /// The SHA-256 of its archive, from the lock file; `None` for crates of the project.
    pub checksum: Option<String>,
    /// The location of its sources.
    pub folder: PathBuf,
}

impl Dependency {
    /// Returns whether the crate belongs to the project itself.
    pub fn is_ours(&self) -> bool {
        self.checksum.is_none()
    }
}

/// Returns all crates that are linked into the program on this machine, sorted, excluding
/// procedural macros and build dependencies.
pub fn shipped_dependencies() -> Result<Vec<Dependency>, String> {
    let mut tree = cargo_command(&["tree", "--locked", "--package", "alberti", "--prefix", "none"]);
    tree.args(["--edges", "normal,no-proc-macro", "--format", "{p}"]);
    let linked: BTreeSet<(String, String)> =
        capture_output(&mut tree)?.lines().filter_map(name_and_version).collect();
    let text =
        capture_output(&mut cargo_command(&["metadata", "--locked", "--format-version", "1"]))?;
    let metadata: Value = serde_json::from_str(&text).map_err(|error| error.to_string())?;
    let checksums = checksums(&read_text(&project_root().join("Cargo.lock"))?);
    let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    let mut found: Vec<Dependency> = metadata["packages"]
        .as_array()
        .into_iter()
        .flatten()
        .map(|package| {
            let key = (text(&package["name"]), text(&package["version"]));
            let manifest = PathBuf::from(text(&package["manifest_path"]));
            Dependency {
                license: text(&package["license"]).replace('/', " OR "),
                checksum: checksums.get(&key).cloned(),
                folder: manifest.parent().unwrap_or(&manifest).to_owned(),
                name: key.0,
                version: key.1,
            }
        })
        .filter(|package| linked.contains(&(package.name.clone(), package.version.clone())))
        .collect();
    found.sort();
    Ok(found)
}

/// Parses the name and the version in a line of `cargo tree`, such as `png v0.18.1`.
fn name_and_version(line: &str) -> Option<(String, String)> {
    let mut words = line.split_whitespace();
    Some((words.next()?.to_owned(), words.next()?.strip_prefix('v')?.to_owned()))
}

/// Returns the checksums in a lock file, by name and version.
fn checksums(lock: &str) -> BTreeMap<(String, String), String> {
    let field = |package: &str, name: &str| {
        let line = package.lines().find_map(|line| line.strip_prefix(name))?;
        Some(line.trim_start_matches(" = ").trim_matches('"').to_owned())
    };
    lock.split("[[package]]")
        .filter_map(|package| {
            let key = (field(package, "name")?, field(package, "version")?);
            Some((key, field(package, "checksum")?))
        })
        .collect()
}

/// Returns a document with the licenses of all third-party crates and of the standard library.
///
/// # Errors
/// Fails if a crate includes no license text and cannot be used under the Apache License.
pub fn license_texts(dependencies: &[Dependency]) -> Result<String, String> {
    let mut users_by_text: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let apache = read_text(&project_root().join("LICENSE-APACHE"))?;
    let mut list = String::new();
    for dependency in dependencies.iter().filter(|dependency| !dependency.is_ours()) {
        let Dependency { name, version, license, folder, .. } = dependency;
        list += &format!("  {name} {version}: {license}\n");
        let mut texts = texts_in(folder)?;
        if texts.is_empty() {
            // The Apache License does not require a copyright line from the crate itself.
            if !license.contains("Apache-2.0") {
                return Err(format!(
                    "{name} {version} does not include the text of its license `{license}`"
                ));
            }
            texts.push(apache.clone());
        }
        for text in texts {
            users_by_text.entry(text).or_default().push(format!("{name} {version}"));
        }
    }
    users_by_text.entry(apache).or_default().push("the Rust standard library".to_owned());
    let mut page = format!(
        "The program alberti is licensed as MIT OR Apache-2.0. It contains the following\n\
         software under the listed licenses, whose texts follow.\n\n{list}  \
         the Rust standard library: MIT OR Apache-2.0\n\n\
         The program for download, which needs no C library, also contains the GNU C Library\n\
         (LGPL-2.1-or-later) and libgcc (GPL-3.0-or-later WITH GCC-exception-3.1). The sources of\n\
         alberti are sufficient to link it with other versions of them.\n"
    );
    let mut sections: Vec<(Vec<String>, String)> =
        users_by_text.into_iter().map(|(text, users)| (users, text)).collect();
    sections.sort();
    for (users, text) in sections {
        page += &format!("\n{}\n{}\n\n{}\n", "=".repeat(80), users.join(", "), text.trim_end());
    }
    Ok(page)
}

/// Returns the texts of the licenses and notices in a folder, with LF line endings.
fn texts_in(folder: &Path) -> Result<Vec<String>, String> {
    let entries = fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let is_license = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy().to_uppercase();
        let begins = ["LICENSE", "LICENCE", "COPYING", "COPYRIGHT", "NOTICE", "UNLICENSE"];
        path.is_file() && begins.iter().any(|begin| name.starts_with(begin))
    };
    let mut paths: Vec<PathBuf> =
        entries.filter_map(|entry| Some(entry.ok()?.path())).filter(is_license).collect();
    paths.sort();
    paths.iter().map(|path| Ok(read_text(path)?.replace("\r\n", "\n"))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_the_tree_and_the_lock_file_are_parsed() {
        let key = ("png".to_owned(), "0.18.1".to_owned());
        assert_eq!(name_and_version("png v0.18.1 (*)"), Some(key.clone()));
        let lock = "version = 4\n\n[[package]]\nname = \"png\"\nversion = \"0.18.1\"\n\
                    checksum = \"ab\"\n\n[[package]]\nname = \"ours\"\nversion = \"0.1.0\"\n";
        assert_eq!(checksums(lock), BTreeMap::from([(key, "ab".to_owned())]));
    }
}
