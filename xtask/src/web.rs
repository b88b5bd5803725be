//! `cargo xtask web`: builds the explorer as static files for any web host, and as a single file
//! for use in class.
//!
//! ```text
//! web [--out DIR] [--skip-without-tools]
//!   --out DIR             the output folder; default target/web
//!   --skip-without-tools  report a skip and succeed if WebAssembly cannot be built
//! ```
//!
//! The folder contains the page from `crates/explorer/page`, the engine (`web.js`, `web_bg.wasm`),
//! the models of the lessons, and `alberti.html`, which combines all of that in one file. Files
//! above their size limits are an error, because everyone who opens the page waits for them.

mod module;
mod node;
mod sizes;
mod tool_chain;

pub use node::{Answers, Request};

use crate::Outcome;
use crate::skip::report_skip;
use crate::workspace::{create_folder, project_root, target_folder};
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Builds the page and checks its sizes.
pub fn run_web(arguments: &[String]) -> Outcome {
    let mut out = site_folder();
    let mut may_skip = false;
    let mut words = arguments.iter();
    while let Some(word) = words.next() {
        match word.as_str() {
            "--out" => out = project_root().join(words.next().ok_or("--out needs a folder")?),
            "--skip-without-tools" => may_skip = true,
            other => return Err(format!("unknown argument `{other}`")),
        }
    }
    if let Some(missing) = missing_tools().filter(|_| may_skip) {
        report_skip("web", &missing);
        return Ok(());
    }
    build_site(&out)?;
    println!("the explorer is in {}; alberti.html contains all of it in one file", out.display());
    sizes::check_sizes(&out)
}

/// Returns the default output folder.
pub fn site_folder() -> PathBuf {
    target_folder().join("web")
}

/// Returns the reason why WebAssembly cannot be built on this machine, if there is one.
pub fn missing_tools() -> Option<String> {
    let tool_chain = tool_chain::WebToolChain::find().err();
    tool_chain.or_else(node::missing_node)
}

/// Builds the page into a folder.
pub fn build_site(out: &Path) -> Outcome {
    create_folder(out)?;
    module::build_module(out)?;
    for path in page_files()? {
        copy_file(&path, &out.join(path.file_name().unwrap_or_default()))?;
    }
    for name in lesson_models(out)? {
        let target = out.join(&name);
        create_folder(target.parent().unwrap_or(out))?;
        copy_file(&project_root().join("scenes").join(&name), &target)?;
    }
    node::write_single_file(out)
}

/// Returns the page's files, by name.
fn page_files() -> Result<Vec<PathBuf>, String> {
    let folder = project_root().join("crates/explorer/page");
    let entries =
        fs::read_dir(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let files = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let files: BTreeSet<PathBuf> = files.filter(|path| path.is_file()).collect();
    Ok(files.into_iter().collect())
}

/// Returns the lessons that the engine of a page lists.
pub fn list_lessons(site: &Path) -> Result<Vec<Value>, String> {
    let request = Request { name: "lessons.json".into(), query: "what=lessons".into() };
    let answers = Answers::ask(site, &[], &[request])?;
    let mut answer: Value = serde_json::from_slice(answers.bytes("lessons.json")?)
        .map_err(|error| format!("cannot parse the engine's list of lessons: {error}"))?;
    match answer["lessons"].take() {
        Value::Array(lessons) => Ok(lessons),
        _ => Err("the engine lists no lessons".to_owned()),
    }
}

/// Returns every lesson's models.
fn lesson_models(site: &Path) -> Result<BTreeSet<String>, String> {
    let lessons = list_lessons(site)?;
    let models = lessons.iter().filter_map(|lesson| lesson["models"].as_array()).flatten();
    Ok(models.filter_map(|name| name.as_str().map(str::to_owned)).collect())
}

fn copy_file(from: &Path, to: &Path) -> Outcome {
    let copied = fs::copy(from, to);
    copied.map(drop).map_err(|error| format!("{}: {error}", from.display()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::workspace::read_text;
    use std::collections::BTreeMap;

    /// Returns the versions of each package in a lock file.
    fn locked(path: &str) -> BTreeMap<String, BTreeSet<String>> {
        let text = read_text(&project_root().join(path)).unwrap();
        let quoted = |line: &str| line.split('"').nth(1).map(str::to_owned);
        let mut versions: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
        let mut name = None;
        for line in text.lines() {
            if line.starts_with("name = ") {
                name = quoted(line);
            } else if line.starts_with("version = ")
                && let Some((name, version)) = name.take().zip(quoted(line))
            {
                versions.entry(name).or_default().insert(version);
            }
        }
        versions
    }

    /// Packages for build scripts of other rasterizers, which `tests/peers` compares.
    const NOT_OF_THE_PROGRAM: [&str; 1] = ["semver"];

    #[test]
    fn the_module_uses_the_same_versions_as_the_program() {
        let program = locked("Cargo.lock");
        let shared = locked("crates/web/Cargo.lock").into_iter();
        for (name, versions) in shared.filter(|it| !NOT_OF_THE_PROGRAM.contains(&it.0.as_str())) {
            let Some(own) = program.get(&name) else { continue };
            let why = "copy Cargo.lock to crates/web and run `cargo metadata` there";
            assert!(versions.is_subset(own), "{name}: {versions:?} is not {own:?}; {why}");
        }
    }
}
