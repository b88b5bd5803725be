//! Cleanup of temporary files that killed runs left in the report folder.

use super::report::host_name;
use std::path::Path;

/// Removes temporary files from runs whose processes on this machine have ended.
///
/// Runs on other machines may share the folder, but their processes cannot be checked from here.
pub(super) fn remove_left_over(reports: &Path) {
    let entries = std::fs::read_dir(reports);
    for entry in entries.into_iter().flatten().flatten() {
        let is_file = entry.file_type().is_ok_and(|kind| kind.is_file());
        let process = entry.file_name().to_str().and_then(|name| process_of(name, &host_name()));
        if is_file && process.is_some_and(is_dead) {
            // Another run may have just removed it.
            let _ = std::fs::remove_file(entry.path());
        }
    }
}

/// Returns the process ID in a name such as `1-of-1.HOST.4711.3.0.part` or
/// `1-of-1.HOST.4711.3.tar.part`.
fn process_of(name: &str, host: &str) -> Option<u32> {
    let parts: Vec<&str> = name.split('.').collect();
    let [_, of, process, _run, _slot, "part"] = parts[..] else { return None };
    process.parse().ok().filter(|_| of == host)
}

/// Returns whether the process is known not to exist; not all systems report this.
fn is_dead(process: u32) -> bool {
    Path::new("/proc/self").exists() && !Path::new("/proc").join(process.to_string()).exists()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn process_ids_come_only_from_temporary_files_of_this_machine() {
        assert_eq!(process_of("1-of-1.a.4711.3.0.part", "a"), Some(4711));
        assert_eq!(process_of("1-of-1.a.4711.3.tar.part", "a"), Some(4711));
        for name in ["1-of-1.b.4711.3.0.part", "1-of-1.a.4711.3.jsonl", "a.part", "1.a.x.3.0.part"]
        {
            assert_eq!(process_of(name, "a"), None, "{name}");
        }
    }
}
