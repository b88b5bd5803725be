//! The files that tell file managers about the thumbnailer: its entry and the MIME types.
//!
//! ```text
//!  $XDG_DATA_HOME/thumbnailers/alberti.thumbnailer      or below PREFIX/share
//!  $XDG_DATA_HOME/mime/packages/alberti.xml             then update-mime-database
//! ```
//! Sources: the shared MIME-info specification, the XDG base directory specification, and the parts
//! of a `.thumbnailer` file that tumbler and gnome-desktop read.

use crate::CliError;
use crate::messages::print_stdout;
use pipeline::write_file;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The MIME types of all formats, for shared-mime-info.
///
/// Debian's shared-mime-info 2.2 and later has types for glTF, STL, OBJ and 3MF, but not for PLY.
pub(super) const MIME_TYPES: &str = include_str!("mime_types.xml");

/// The MIME types in the entry, including aliases that are in use.
const MIME_TYPE_NAMES: [&str; 13] = [
    "model/gltf+json",
    "model/gltf-binary",
    "model/stl",
    "model/x.stl-ascii",
    "model/x.stl-binary",
    "application/sla",
    "model/obj",
    "model/x-ply",
    "model/ply",
    "application/ply",
    "application/x-ply",
    "model/3mf",
    "application/vnd.ms-3mfdocument",
];

/// Returns the thumbnailer entry for a program.
///
/// # Errors
/// Returns an error if the program's path cannot be written into such a file.
pub(super) fn entry_of(program: &Path) -> Result<String, CliError> {
    let path = program.to_str().filter(|path| !path.contains(char::is_control));
    let path = path.ok_or_else(|| {
        CliError::Usage(format!(
            "the path of the program, {}, cannot be written into a thumbnailer entry",
            program.display()
        ))
    })?;
    let types: String = MIME_TYPE_NAMES.iter().flat_map(|name| [*name, ";"]).collect();
    Ok(format!(
        "[Thumbnailer Entry]\nTryExec={}\nExec={} thumbnailer %i %o --size %s\nMimeType={types}\n",
        escape_value(path),
        escape_value(&quote_argument(path)),
    ))
}

/// Quotes an argument of `Exec`, which is split into words as in a shell; `%` begins a field code.
fn quote_argument(path: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "/._-+".contains(c);
    if path.chars().all(is_plain) {
        return path.to_owned();
    }
    format!("'{}'", path.replace('\'', r"'\''").replace('%', "%%"))
}

/// Escapes a key file value, in which a backslash begins an escape.
fn escape_value(text: &str) -> String {
    text.replace('\\', r"\\")
}

/// Writes both files, updates the database, and reports these steps.
///
/// # Errors
/// Returns an error if there is no data folder, or if a file or the database cannot be written.
pub(super) fn install_files(prefix: Option<&Path>) -> Result<(), CliError> {
    let folder = data_folder(prefix)?;
    let program = std::env::current_exe().map_err(|cause| {
        CliError::Usage(format!("cannot find the path of the program: {cause}"))
    })?;
    if program.file_stem().is_some_and(|name| name.to_string_lossy().starts_with("python")) {
        let message = "the program runs inside Python, where file managers cannot start it\n  = \
                       help: install it with cargo install --path crates/alberti";
        return Err(CliError::Usage(message.to_owned()));
    }
    let mut done = String::new();
    for (path, content) in file_paths(&folder).iter().zip([entry_of(&program)?, MIME_TYPES.into()])
    {
        if let Some(parent) = path.parent() {
            std::fs::create_dir_all(parent).map_err(|cause| {
                CliError::Usage(format!("cannot create the folder {}: {cause}", parent.display()))
            })?;
        }
        write_file(path, content.as_bytes())?;
        done += &format!("wrote {}\n", path.display());
    }
    done += &update_database(&folder)?;
    print_stdout(done.as_bytes())
}

/// Removes both files, updates the database, and reports these steps.
///
/// # Errors
/// Returns an error if there is no data folder, or if a file or the database cannot be changed.
pub(super) fn remove_files(prefix: Option<&Path>) -> Result<(), CliError> {
    let folder = data_folder(prefix)?;
    let mut done = String::new();
    let mut is_changed = false;
    for path in file_paths(&folder) {
        match std::fs::remove_file(&path) {
            Ok(()) => {
                is_changed = true;
                done += &format!("removed {}\n", path.display());
            }
            Err(cause) if cause.kind() == ErrorKind::NotFound => {
                done += &format!("{} does not exist\n", path.display());
            }
            Err(cause) => {
                return Err(CliError::Usage(format!("cannot remove {}: {cause}", path.display())));
            }
        }
    }
    if is_changed {
        done += &update_database(&folder)?;
    }
    print_stdout(done.as_bytes())
}

/// Returns the paths of the entry and the MIME types below a data folder.
fn file_paths(folder: &Path) -> [PathBuf; 2] {
    [folder.join("thumbnailers/alberti.thumbnailer"), folder.join("mime/packages/alberti.xml")]
}

/// Returns the data folder below a prefix, or else the user's data folder (XDG).
fn data_folder(prefix: Option<&Path>) -> Result<PathBuf, CliError> {
    if let Some(prefix) = prefix {
        return Ok(prefix.join("share"));
    }
    // Relative paths must be ignored.
    let named =
        |name: &str| std::env::var_os(name).map(PathBuf::from).filter(|path| path.is_absolute());
    let of_home = || named("HOME").map(|home| home.join(".local/share"));
    named("XDG_DATA_HOME").or_else(of_home).ok_or_else(|| {
        CliError::Usage(
            "neither XDG_DATA_HOME nor HOME names a folder; use --prefix DIR".to_owned(),
        )
    })
}

/// Runs update-mime-database on the MIME types below a data folder; returns what to print.
fn update_database(folder: &Path) -> Result<String, CliError> {
    let mime = folder.join("mime");
    let run = Command::new("update-mime-database").arg(&mime).stdout(Stdio::null()).status();
    let call = format!("update-mime-database {}", mime.display());
    match run {
        Ok(status) if status.success() => Ok(format!("ran {call}\n")),
        Ok(status) => Err(CliError::Usage(format!("{call} failed: {status}"))),
        Err(cause) if cause.kind() == ErrorKind::NotFound => Ok(format!(
            "update-mime-database is not installed (shared-mime-info); install it and run {call}\n"
        )),
        Err(cause) => Err(CliError::Usage(format!("cannot run {call}: {cause}"))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use import::FileFormat;

    #[test]
    fn every_extension_and_type_is_in_the_mime_types() {
        for extension in FileFormat::ALL.iter().flat_map(|format| format.extensions()) {
            assert!(MIME_TYPES.contains(&format!("pattern=\"*.{extension}\"")), "{extension}");
        }
        for name in MIME_TYPE_NAMES {
            assert!(MIME_TYPES.contains(&format!(" type=\"{name}\"")), "{name}");
        }
    }

    #[test]
    fn paths_are_quoted_for_a_shell_and_escaped_for_a_key_file() {
        let entry = |path: &str| entry_of(path.as_ref()).unwrap_or_default();
        let lines = |path: &str| entry(path).lines().skip(1).take(2).collect::<Vec<_>>().join("|");
        assert_eq!(
            lines("/usr/bin/alberti"),
            "TryExec=/usr/bin/alberti|Exec=/usr/bin/alberti thumbnailer %i %o --size %s"
        );
        assert_eq!(
            lines("/a b/it's 100%/\\x"),
            "TryExec=/a b/it's 100%/\\\\x|\
             Exec='/a b/it'\\\\''s 100%%/\\\\x' thumbnailer %i %o --size %s"
        );
        assert!(entry_of("/a\nb".as_ref()).is_err());
    }
}
