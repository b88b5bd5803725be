//! `cargo xtask browser`: tests the explorer's page in a real browser, with pictures from the
//! program and from WebAssembly.
//!
//! The tests are in `tests/browser/main.mjs`. They need Chromium, Node and two npm packages, which
//! are fetched once. Tests whose tools are missing are reported as skipped.

use crate::Outcome;
use crate::program::{Build, Program, capture_output, run_command, run_visibly};
use crate::skip::report_skip;
use crate::workspace::{project_root, target_folder};
use std::path::{Path, PathBuf};
use std::process::Command;

/// The path where Debian installs Chromium. Playwright's own browsers are not used.
pub const CHROMIUM: &str = "/usr/bin/chromium";

/// The minimum major version of Node for Playwright.
const NODE: u32 = 20;

/// The time limit for fetching the packages, in seconds.
const FETCH_SECONDS: &str = "120";

/// Runs the tests, or reports why they are skipped. `--first` runs only the first lesson's tests.
pub fn run_browser(arguments: &[String]) -> Outcome {
    let is_first = match arguments {
        [] => false,
        [flag] if flag == "--first" => true,
        _ => return Err("the only argument is `--first`".to_owned()),
    };
    let folder = project_root().join("tests/browser");
    if let Some(missing) = missing_tool(&folder) {
        report_skip("browser", &missing);
        return Ok(());
    }
    let program = Program::build(Build::Debug)?;
    let mut node = Command::new("node");
    node.current_dir(&folder).arg("main.mjs").arg(program.path());
    if is_first {
        return run_visibly(node.arg("--first"));
    }
    match current_site() {
        Some(site) => drop(node.arg(site)),
        None => report_skip(
            "browser",
            "WebAssembly in the browser: this page has not been built; run `cargo xtask web`",
        ),
    }
    run_visibly(&mut node)
}

/// Returns the first missing requirement of the tests, if any.
pub fn missing_tool(folder: &Path) -> Option<String> {
    if !Path::new(CHROMIUM).exists() {
        return Some("chromium is not installed (Debian: chromium)".into());
    }
    let version = capture_output(Command::new("node").arg("--version")).ok();
    let major = version.as_deref().and_then(|text| text.trim_start_matches('v').split('.').next());
    match major.and_then(|major| major.parse::<u32>().ok()) {
        Some(major) if major >= NODE => {}
        Some(major) => {
            return Some(format!("node {major} is too old; {NODE} or later is required"));
        }
        None => return Some("node is not installed (Debian: nodejs)".into()),
    }
    let has_packages = ["playwright-core", "axe-core"]
        .iter()
        .all(|name| folder.join("node_modules").join(name).is_dir());
    let mut npm = Command::new("timeout");
    npm.args([FETCH_SECONDS, "npm", "ci", "--no-audit", "--no-fund"]).current_dir(folder);
    if !has_packages && run_command(&mut npm).is_err() {
        return Some("npm cannot fetch playwright-core and axe-core".into());
    }
    None
}

/// Returns the folder that `cargo xtask web` wrote, if it contains the current page.
pub fn current_site() -> Option<PathBuf> {
    let site = target_folder().join("web");
    site.join("web_bg.wasm").metadata().ok()?;
    let page = std::fs::read_dir(project_root().join("crates/explorer/page")).ok()?;
    let is_same = |path: PathBuf| {
        let copy = site.join(path.file_name().unwrap_or_default());
        std::fs::read(path).ok() == std::fs::read(copy).ok()
    };
    page.flatten().all(|file| is_same(file.path())).then_some(site)
}
