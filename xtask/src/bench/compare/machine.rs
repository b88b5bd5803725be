//! The machine and the time of the measurement.

use super::revision::{Commit, current_commit};
use crate::program::capture_output;
use crate::workspace::{project_root, read_text};
use serde_json::{Value, json};
use std::path::Path;
use std::process::Command;

/// The compared programs and the machine on which they ran.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Machine {
    /// The old commit: the user's name for it, and its hash.
    pub old: String,
    /// The new commit: its hash, and whether files have changed since.
    pub new: String,
    /// The processor model.
    pub processor: String,
    /// The number of hardware threads.
    pub cores: usize,
    /// `rustc --version`.
    pub compiler: String,
    /// The system date and time, in UTC.
    pub date: Option<String>,
}

impl Machine {
    /// Queries git, the compiler and the system.
    pub fn describe(old: &Commit) -> Result<Self, String> {
        Ok(Self {
            old: format!("{} ({})", old.revision, old.hash),
            new: current_commit()?,
            processor: processor(),
            cores: std::thread::available_parallelism().map_or(1, std::num::NonZeroUsize::get),
            compiler: compiler(),
            date: date(),
        })
    }

    /// Converts this to a JSON object.
    pub fn to_json(&self) -> Value {
        let Self { old, new, processor, cores, compiler, date } = self;
        json!({
            "old": old, "new": new, "processor": processor, "cores": cores, "rustc": compiler,
            "date": date,
        })
    }
}

/// Returns the processor model, if the system reports it.
pub fn processor() -> String {
    processor_model(&read_text(Path::new("/proc/cpuinfo")).unwrap_or_default())
}

/// Returns the output of `rustc --version`.
pub fn compiler() -> String {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let output = Command::new(rustc).arg("--version").current_dir(project_root()).output();
    output
        .map(|output| String::from_utf8_lossy(&output.stdout).trim().to_owned())
        .unwrap_or_default()
}

/// Returns the system date and time, in UTC.
pub fn date() -> Option<String> {
    let date = capture_output(Command::new("date").args(["-u", "+%Y-%m-%dT%H:%M:%SZ"])).ok()?;
    Some(date.trim().to_owned())
}

fn processor_model(cpuinfo: &str) -> String {
    let model = cpuinfo.lines().find_map(|line| line.strip_prefix("model name"));
    let model = model.and_then(|rest| rest.split_once(':'));
    model.map_or("unknown processor", |(_, model)| model.trim()).to_owned()
}

#[cfg(test)]
pub mod tests {
    use super::*;

    pub fn machine() -> Machine {
        Machine {
            old: "an old commit".into(),
            new: "a new commit".into(),
            processor: "a processor".into(),
            cores: 4,
            compiler: "rustc 1.0".into(),
            date: None,
        }
    }

    #[test]
    fn processor_models_are_parsed() {
        let cpuinfo = "processor\t: 0\nmodel name\t: Some Processor @ 2 GHz\nmodel\t: 1\n";
        assert_eq!(processor_model(cpuinfo), "Some Processor @ 2 GHz");
        assert_eq!(processor_model(""), "unknown processor");
    }
}
