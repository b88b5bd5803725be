//! Temporary files that a killed run left in the report folder.

use super::report::host_name;
use std::path::Path;

/// Removes the temporary files of runs on this machine whose process is dead.
///
/// Runs on other machines may share the folder; their processes are unknown here.
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

/// The process in a name such as `1-of-1.HOST.4711.3.0.part` or `1-of-1.HOST.4711.3.tar.part`.
fn process_of(name: &str, host: &str) -> Option<u32> {
    let parts: Vec<&str> = name.split('.').collect();
    let [_, of, process, _run, _slot, "part"] = parts[..] else { return None };
    process.parse().ok().filter(|_| of == host)
}

/// Whether the system reports that there is no such process; not all systems do.
fn is_dead(process: u32) -> bool {
    Path::new("/proc/self").exists() && !Path::new("/proc").join(process.to_string()).exists()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_temporary_files_of_this_machine_have_a_process() {
        assert_eq!(process_of("1-of-1.a.4711.3.0.part", "a"), Some(4711));
        assert_eq!(process_of("1-of-1.a.4711.3.tar.part", "a"), Some(4711));
        for name in ["1-of-1.b.4711.3.0.part", "1-of-1.a.4711.3.jsonl", "a.part", "1.a.x.3.0.part"]
        {
            assert_eq!(process_of(name, "a"), None, "{name}");
        }
    }
}
