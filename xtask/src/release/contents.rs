//! The contents of a package, below `usr`: the program, its manual pages, shell completions,
//! thumbnailer and licenses.

use crate::program::run_command;
use crate::workspace::{create_folder, list_files, project_root};
use std::fs;
use std::path::Path;
use std::process::Command;

/// A file in a package.
pub struct PackagedFile {
    /// The path below the prefix, which is `usr` in distribution packages.
    pub path: String,
    /// Its bytes.
    pub bytes: Vec<u8>,
    /// Whether it is executable.
    pub is_executable: bool,
}

impl PackagedFile {
    fn text(path: impl Into<String>, bytes: Vec<u8>) -> Self {
        Self { path: path.into(), bytes, is_executable: false }
    }
}

/// The shells with completion scripts, and the path at which each looks for its script in Debian.
const COMPLETIONS: [(&str, &str); 3] = [
    ("bash", "share/bash-completion/completions/alberti"),
    ("zsh", "share/zsh/vendor-completions/_alberti"),
    ("fish", "share/fish/vendor_completions.d/alberti.fish"),
];

/// The folder for the documents that Debian requires in a package.
const DOCUMENTS: &str = "share/doc/alberti";

/// Returns all files in a package. The program itself writes most of them.
pub fn packaged_files(program: &Path, notices: &str) -> Result<Vec<PackagedFile>, String> {
    let read = |path: &Path| fs::read(path).map_err(|error| format!("{}: {error}", path.display()));
    let mut files = vec![PackagedFile {
        path: "bin/alberti".into(),
        bytes: read(program)?,
        is_executable: true,
    }];
    for (shell, path) in COMPLETIONS {
        files.push(PackagedFile::text(path, print(program, &["completions", shell])?));
    }
    for (part, path) in [
        ("entry", "share/thumbnailers/alberti.thumbnailer"),
        ("mime", "share/mime/packages/alberti.xml"),
    ] {
        files.push(PackagedFile::text(path, print(program, &["thumbnailer", "--print", part])?));
    }
    files.extend(manual_pages(program)?);
    for name in ["README.md", "CHANGELOG.md", "LICENSE-MIT", "LICENSE-APACHE"] {
        files.push(PackagedFile::text(
            format!("{DOCUMENTS}/{name}"),
            read(&project_root().join(name))?,
        ));
    }
    files.push(PackagedFile::text(
        format!("{DOCUMENTS}/THIRD-PARTY-LICENSES"),
        notices.as_bytes().to_owned(),
    ));
    files.push(PackagedFile::text(format!("{DOCUMENTS}/copyright"), copyright()?.into_bytes()));
    files.sort_by(|a, b| a.path.cmp(&b.path));
    Ok(files)
}

/// Returns the manual pages, compressed without a timestamp or a file name.
fn manual_pages(program: &Path) -> Result<Vec<PackagedFile>, String> {
    let folder = crate::workspace::target_folder().join("man1");
    let _ = fs::remove_dir_all(&folder);
    create_folder(&folder)?;
    run_command(Command::new(program).args(["man", "--out-dir"]).arg(&folder))?;
    run_command(Command::new("gzip").args(["-n", "-9"]).args(list_files(&folder, "1")?))?;
    let page = |path: std::path::PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let bytes = fs::read(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        Ok(PackagedFile::text(format!("share/man/man1/{name}"), bytes))
    };
    list_files(&folder, "gz")?.into_iter().map(page).collect()
}

/// Runs the program and returns its output.
fn print(program: &Path, arguments: &[&str]) -> Result<Vec<u8>, String> {
    crate::program::capture_output(Command::new(program).args(arguments)).map(String::into_bytes)
}

/// Returns the Debian `copyright` file, in the machine-readable format.
fn copyright() -> Result<String, String> {
    let license = crate::workspace::read_text(&project_root().join("LICENSE-MIT"))?;
    let holder = license
        .lines()
        .find_map(|line| line.strip_prefix("Copyright (c) "))
        .ok_or("LICENSE-MIT names no copyright holder")?;
    let text: String = license
        .lines()
        .skip_while(|line| !line.starts_with("Permission"))
        .map(|line| if line.is_empty() { " .\n".to_owned() } else { format!(" {line}\n") })
        .collect();
    Ok(format!(
        "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/\n\
         Upstream-Name: alberti\n\
         Comment: The licenses of the crates in the program are in THIRD-PARTY-LICENSES.\n\n\
         Files: *\nCopyright: {holder}\nLicense: Expat or Apache-2.0\n\n\
         License: Expat\n{text}\n\
         License: Apache-2.0\n Debian systems have it in /usr/share/common-licenses/Apache-2.0.\n"
    ))
}
