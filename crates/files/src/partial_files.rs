//! Temporary files: this process leaves none behind, and removes those left by dead processes.
//!
//! ```text
//!  a.png.4711.part ── renamed ─► a.png
//!   │ locked by its process   └ a signal: remove_partial_files
//!   └ left behind by kill -9: the next process that writes a.png removes it
//! ```

use std::collections::{BTreeMap, BTreeSet};
use std::ffi::{OsStr, OsString};
use std::fs::{File, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// This process's temporary files.
static OWN: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// Other processes' temporary files, for each folder that this process has searched.
static FOREIGN: Mutex<BTreeMap<PathBuf, Vec<ForeignFile>>> = Mutex::new(BTreeMap::new());

/// The age at which an unlocked temporary file counts as abandoned, even if its process is not
/// known to be dead.
const ABANDONED_AGE: Duration = Duration::from_secs(60);

/// A temporary file of another process.
#[derive(Debug)]
struct ForeignFile {
    name: String,
    /// The name of the target file.
    target: String,
    process: u32,
}

/// Creates the temporary file for a target, and removes files that dead processes left for it.
pub(crate) fn create(target: &Path) -> io::Result<(PathBuf, File)> {
    let folder = target.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = folder.unwrap_or(Path::new("."));
    let name = target.file_name().unwrap_or_default();
    remove_abandoned(folder, name);
    let mut partial_name = name.to_owned();
    partial_name.push(format!(".{}.part", std::process::id()));
    let path = target.with_file_name(partial_name);
    let file = create_partial_file(&path)?;
    Ok((path, file))
}

/// Creates a temporary file that [`remove_partial_files`] removes unless it has been
/// [forgotten](forget_partial_file).
///
/// # Errors
/// See [`File::create`].
pub fn create_partial_file(path: &Path) -> io::Result<File> {
    // The list stays locked during the creation, so that a signal cannot leave the file behind.
    let mut own = lock(&OWN);
    let file = File::create(path)?;
    own.insert(path.to_owned());
    drop(own);
    // Best effort: if the file is not locked, other processes wait until it is old.
    let _ = file.try_lock();
    Ok(file)
}

/// Makes [`remove_partial_files`] remove a file that a child process creates.
pub fn register_partial_file(path: PathBuf) {
    lock(&OWN).insert(path);
}

/// Forgets a temporary file that has been renamed or removed.
pub fn forget_partial_file(path: &Path) {
    lock(&OWN).remove(path);
}

/// Removes a temporary file.
pub(crate) fn remove(path: &Path) {
    // Best effort: there is no caller left to report an error to.
    let _ = std::fs::remove_file(path);
    forget_partial_file(path);
}

/// Removes all of this process's temporary files and calls `end`, which must end the process. No
/// temporary file can be created in the meantime.
///
/// Call this when a signal interrupts the program.
pub fn remove_partial_files(end: impl FnOnce()) {
    let own = lock(&OWN);
    for path in own.iter() {
        // The file may have just been renamed.
        let _ = std::fs::remove_file(path);
    }
    end();
}

/// Removes a target's temporary files whose processes are dead.
fn remove_abandoned(folder: &Path, target: &OsStr) {
    let mut foreign = lock(&FOREIGN);
    // A batch folder can have many files, so it is read only once.
    let files = foreign.entry(folder.to_owned()).or_insert_with(|| foreign_files(folder));
    for file in files.iter().filter(|file| target == file.target.as_str()) {
        let path = folder.join(&file.name);
        if is_abandoned(&path, file.process) {
            // The file may be gone already, or belong to another user.
            let _ = std::fs::remove_file(path);
        }
    }
    files.retain(|file| target != file.target.as_str());
}

/// Returns other processes' temporary files in a folder.
fn foreign_files(folder: &Path) -> Vec<ForeignFile> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    entries.filter_map(|entry| ForeignFile::from_name(entry.file_name())).collect()
}

impl ForeignFile {
    /// Parses a name such as `a.png.4711.part`. Returns `None` for other names and for this
    /// process's files.
    fn from_name(name: OsString) -> Option<Self> {
        let name = name.into_string().ok()?;
        let (target, process) = name.strip_suffix(".part")?.rsplit_once('.')?;
        let process = process.parse().ok().filter(|process| *process != std::process::id())?;
        Some(Self { target: target.to_owned(), process, name })
    }
}

/// Whether a temporary file is no longer being written.
///
/// The process may run on another machine that shares the folder, so a locked file counts as in
/// use.
fn is_abandoned(path: &Path, process: u32) -> bool {
    let is_file = path.symlink_metadata().is_ok_and(|metadata| metadata.is_file());
    let Some(file) = is_file.then(|| OpenOptions::new().write(true).open(path).ok()).flatten()
    else {
        return false;
    };
    let modified = file.metadata().and_then(|metadata| metadata.modified()).ok();
    let age = modified.and_then(|modified| modified.elapsed().ok()).unwrap_or_default();
    file.try_lock().is_ok() && (is_dead(process) || age >= ABANDONED_AGE)
}

/// Whether the system reports that the process does not exist.
fn is_dead(process: u32) -> bool {
    Path::new("/proc/self").exists() && !Path::new("/proc").join(process.to_string()).exists()
}

/// Locks a mutex, whose content is valid even if another thread panicked.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_temporary_files_are_recognized() {
        let parts = |name: &str| {
            let file = ForeignFile::from_name(name.into())?;
            Some((file.target, file.process))
        };
        assert_eq!(parts("a.b.png.12.part"), Some(("a.b.png".into(), 12)));
        let own = format!("a.png.{}.part", std::process::id());
        for name in ["a.png", "a.png.part", "12.part", "a.png.x.part", own.as_str()] {
            assert_eq!(parts(name), None, "{name}");
        }
    }
}
