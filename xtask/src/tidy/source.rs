//! Source files for the rules: their text, and their code without comments or strings.

use super::code::blank_comments_and_strings;
use crate::workspace::{project_root, read_text, relative_path};
use std::fs;
use std::path::{Path, PathBuf};

/// A Rust source file.
pub struct Source {
    /// The path relative to the workspace root, with forward slashes.
    pub path: String,
    /// The unchanged text of the file.
    pub text: String,
    /// The lines with comments and literals blanked out, so that only code remains.
    pub code: Vec<String>,
}

impl Source {
    /// Creates a source file from its path and text.
    pub fn new(path: impl Into<String>, text: impl Into<String>) -> Self {
        let text = text.into();
        let code = blank_comments_and_strings(&text).lines().map(str::to_owned).collect();
        Self { path: path.into(), text, code }
    }

    /// Returns whether the file belongs to a library crate, not to a program, a test or an example.
    pub fn is_library(&self) -> bool {
        let program = ["crates/alberti/src/"];
        self.path.starts_with("crates/")
            && self.path.contains("/src/")
            && !program.iter().any(|part| self.path.starts_with(part))
    }

    /// Returns the lines of code before the file's tests, each with its number.
    pub fn code_without_tests(&self) -> impl Iterator<Item = (usize, &str)> {
        let lines = self.code.iter().take_while(|line| line.trim() != "#[cfg(test)]");
        lines.enumerate().map(|(i, line)| (i + 1, line.as_str()))
    }

    /// Formats a location in this file: `PATH:LINE`.
    pub fn line_text(&self, number: usize) -> String {
        format!("{}:{number}", self.path)
    }
}

/// Reads every Rust file in the workspace.
pub fn rust_files() -> Result<Vec<Source>, String> {
    let paths = walk_files(project_root())?;
    let rust = paths.iter().filter(|path| path.extension().is_some_and(|actual| actual == "rs"));
    rust.map(|path| Ok(Source::new(relative_path(path), read_text(path)?))).collect()
}

/// Returns the path and text of every text file in the workspace.
pub fn text_files() -> Result<Vec<(String, String)>, String> {
    let text = ["rs", "toml", "ron", "md", "lock", "svg", "sh", "po", "py", "pyi", "tsv"];
    let mut paths = walk_files(project_root())?;
    paths.retain(|path| {
        path.extension().is_some_and(|found| text.iter().any(|known| found == *known))
    });
    paths.iter().map(|path| Ok((relative_path(path), read_text(path)?))).collect()
}

/// Returns all files below a folder, sorted, excluding build output, hidden folders and links.
/// Linked files are read at their targets.
fn walk_files(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let mut found = Vec::new();
    let entries = fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut paths: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    paths.sort();
    for path in paths {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if path.is_symlink() {
            continue;
        }
        if path.is_dir() {
            if !matches!(&*name, "target" | "node_modules") && !name.starts_with('.') {
                found.extend(walk_files(&path)?);
            }
        } else {
            found.push(path);
        }
    }
    Ok(found)
}
