//! `cargo xtask web`: the explorer as static files for any host, and as one file for a lesson.
//!
//! ```text
//! web [--out DIR] [--skip-without-tools]
//!   --out DIR             where to write it; target/web if not said
//!   --skip-without-tools  say so and succeed where WebAssembly cannot be built
//! ```
//!
//! The folder holds the page from `crates/explorer/page`, the engine (`web.js`, `web_bg.wasm`), its
//! lessons' models, and `alberti.html`, which is all of that in one file. Sizes above the limits
//! are a failure: everybody who opens the page waits for them.

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
    println!("the explorer is in {}; alberti.html is all of it in one file", out.display());
    sizes::check_sizes(&out)
}

/// The default output folder.
pub fn site_folder() -> PathBuf {
    target_folder().join("web")
}

/// The reason why WebAssembly cannot be built here, if it cannot.
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

/// The page's files, by name.
fn page_files() -> Result<Vec<PathBuf>, String> {
    let folder = project_root().join("crates/explorer/page");
    let entries =
        fs::read_dir(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let files = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let files: BTreeSet<PathBuf> = files.filter(|path| path.is_file()).collect();
    Ok(files.into_iter().collect())
}

/// The lessons, as the engine of a page lists them.
pub fn list_lessons(site: &Path) -> Result<Vec<Value>, String> {
    let request = Request { name: "lessons.json".into(), query: "what=lessons".into() };
    let answers = Answers::ask(site, &[], &[request])?;
    let mut answer: Value = serde_json::from_slice(answers.bytes("lessons.json")?)
        .map_err(|error| format!("the lessons of the engine: {error}"))?;
    match answer["lessons"].take() {
        Value::Array(lessons) => Ok(lessons),
        _ => Err("the engine lists no lessons".to_owned()),
    }
}

/// The models in all lessons.
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

    /// Versions of each package of a lock file.
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

    /// They belong to build scripts of other rasterizers, which `tests/peers` compares.
    const NOT_OF_THE_PROGRAM: [&str; 1] = ["semver"];

    #[test]
    fn the_module_is_built_of_what_the_program_is_built_of() {
        let program = locked("Cargo.lock");
        let shared = locked("crates/web/Cargo.lock").into_iter();
        for (name, versions) in shared.filter(|it| !NOT_OF_THE_PROGRAM.contains(&it.0.as_str())) {
            let Some(own) = program.get(&name) else { continue };
            let why = "copy Cargo.lock to crates/web and run `cargo metadata` there";
            assert!(versions.is_subset(own), "{name}: {versions:?} is not {own:?}; {why}");
        }
    }
}
