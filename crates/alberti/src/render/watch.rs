//! `render --watch`: renders again when the inputs, or files they use, change.
//!
//! The times and lengths of files are polled a few times a second, which works on every file
//! system. A change counts once two successive polls agree, because editors and exporters may take
//! a while to write a file.

use crate::CliError;
use crate::messages::{print_message, print_note};
use files::counted;
use scene::referenced_files;
use scene_file::is_scene_file;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::{Duration, SystemTime};

/// The time between two polls.
const INTERVAL: Duration = Duration::from_millis(150);
/// The maximum number of watched files.
const MAX_FILES: usize = 4096;
/// The maximum length of a file that is searched for file names.
const MAX_SEARCHED_BYTES: u64 = 64 << 20;

/// The modification time and length of each file; `None` if it does not exist.
type Stamps = BTreeMap<PathBuf, Option<(SystemTime, u64)>>;

/// Runs `make` now and after every change, and prints its errors, until the program is interrupted.
///
/// # Errors
/// Returns an error if an input is the standard input, or if the output is the standard output.
pub(super) fn repeat(
    inputs: &[PathBuf],
    to_stdout: bool,
    mut make: impl FnMut() -> Result<(), CliError>,
) -> Result<(), CliError> {
    if inputs.iter().any(|input| input.as_os_str() == "-") || to_stdout {
        let message = "--watch needs files: the standard input does not change, and the \
                       standard output can hold only one picture";
        return Err(CliError::Usage(message.to_owned()));
    }
    loop {
        // Stamped before rendering, so that a change during rendering causes another run.
        let before = stamp_files(inputs);
        if let Err(error) = make() {
            print_message("error", &error.to_message());
        }
        let files = counted(before.len(), "file", "files");
        print_note(&format!("watching {files}; press Ctrl+C to stop"));
        let mut now = stamp_files(inputs);
        while now == before {
            sleep(INTERVAL);
            now = stamp_files(inputs);
        }
        // Editors write in several steps: wait until nothing changes.
        loop {
            sleep(INTERVAL);
            let later = stamp_files(inputs);
            if later == now {
                break;
            }
            now = later;
        }
    }
}

/// Returns the stamps of all files that the inputs use.
fn stamp_files(inputs: &[PathBuf]) -> Stamps {
    let mut stamps = Stamps::new();
    let mut waiting: Vec<PathBuf> = inputs.to_vec();
    while let Some(path) = waiting.pop() {
        if stamps.len() == MAX_FILES || stamps.contains_key(&path) {
            continue;
        }
        let about = std::fs::metadata(&path).ok().filter(std::fs::Metadata::is_file);
        let is_short = about.as_ref().is_some_and(|about| about.len() <= MAX_SEARCHED_BYTES);
        stamps.insert(path.clone(), about.and_then(|it| Some((it.modified().ok()?, it.len()))));
        if is_short {
            waiting.extend(used_files(&path));
        }
    }
    stamps
}

/// Returns the existing files that a scene or a model names.
fn used_files(path: &Path) -> Vec<PathBuf> {
    let Ok(bytes) = std::fs::read(path) else { return Vec::new() };
    let names: Vec<String> = if is_scene_file(path) {
        // Any text between quotation marks may be a path.
        let text = String::from_utf8_lossy(&bytes);
        text.split('"').skip(1).step_by(2).map(str::to_owned).collect()
    } else {
        referenced_files(&path.to_string_lossy(), &bytes)
    };
    let folder = path.parent().unwrap_or(Path::new(""));
    let paths = names.iter().filter(|name| !name.is_empty()).map(|name| folder.join(name));
    paths.filter(|path| path.is_file()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_files_of_a_scene_and_its_models_are_found() {
        let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
        let scene = scenes.join("teapot.ron");
        let stamps = stamp_files(std::slice::from_ref(&scene));
        assert!(stamps.contains_key(&scene) && stamps.len() > 1, "{stamps:?}");
        assert!(stamps.keys().any(|path| path.ends_with("models/teapot.glb")), "{stamps:?}");
    }
}
