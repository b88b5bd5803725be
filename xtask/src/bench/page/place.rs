//! The machine, time, commit and peers of the measurements on the page.

use super::tables::{list, text};
use crate::bench::compare::machine::{compiler, date, processor};
use crate::bench::compare::revision::current_commit;
use crate::workspace::{project_root, read_text};
use serde_json::Value;
use std::fmt::Write as _;
use std::path::Path;

/// The number of running threads per core above which a machine counts as busy.
const BUSY: f64 = 0.3;

/// The machine, the commit and the time.
#[derive(Default)]
pub struct Place {
    processor: String,
    cores: usize,
    system: String,
    compiler: String,
    commit: String,
    date: String,
    euc: String,
    /// The load before the measurement: the number of running threads, averaged over a minute.
    load_before: Option<f64>,
    /// The load after the measurement.
    pub load_after: Option<f64>,
}

impl Place {
    /// Queries the system, the compiler and git before anything is measured.
    pub fn describe() -> Result<Self, String> {
        Ok(Self {
            processor: processor(),
            cores: std::thread::available_parallelism().map_or(1, std::num::NonZeroUsize::get),
            system: system(),
            compiler: compiler(),
            commit: current_commit()?,
            date: date().unwrap_or_default(),
            euc: locked_version("euc"),
            load_before: load(),
            load_after: None,
        })
    }

    /// Formats the section of the page. The versions of Mesa and f3d come from the figures.
    pub fn to_markdown(&self, figures: &Value) -> String {
        let or_missing = |value: &Value| match text(value) {
            "" => "not installed, skipped".to_owned(),
            version => version.to_owned(),
        };
        let peers = format!(
            "llvmpipe: {}; euc {}; f3d: {}",
            or_missing(&figures["llvmpipe"]),
            self.euc,
            or_missing(&figures["f3d"])
        );
        let shown = |load: Option<f64>| load.map_or("unknown".into(), |load| format!("{load:.2}"));
        let load = format!("{}, then {}", shown(self.load_before), shown(self.load_after));
        let rows = [
            ("processor", format!("{}, {} threads", self.processor, self.cores)),
            ("system", self.system.clone()),
            ("compiler", self.compiler.clone()),
            ("commit", self.commit.clone()),
            ("date", self.date.clone()),
            ("peers", peers),
            ("rounds", rounds(figures).to_string()),
            ("machine load before and after", load),
        ];
        let mut text = "\n## Setup\n\n| | |\n| --- | --- |\n".to_owned();
        for (name, value) in rows {
            let _ = writeln!(text, "| {name} | {value} |");
        }
        if self.was_busy() {
            text += "\n**The machine was busy with other work.** Ratios within a round still compare like with like, but caches and clock \
                     speeds were shared. Repeat the run on a quiet machine before you rely on a figure.\n";
        }
        text
    }

    /// Returns whether the machine was busy at the start. The load at the end includes this
    /// measurement itself.
    fn was_busy(&self) -> bool {
        self.load_before.is_some_and(|load| load > BUSY * self.cores as f64)
    }
}

/// Returns the number of rounds, not counting the warm-up round.
fn rounds(figures: &Value) -> usize {
    let contestants = list(&figures["scenes"]).iter().flat_map(|scene| list(&scene["contestants"]));
    contestants.map(|one| list(&one["times"]).len()).max().unwrap_or(0)
}

/// Returns the number of running threads, averaged over the last minute, if the system reports it.
pub fn load() -> Option<f64> {
    read_text(Path::new("/proc/loadavg")).ok()?.split(' ').next()?.parse().ok()
}

/// Returns the name of the system.
fn system() -> String {
    let about = read_text(Path::new("/etc/os-release")).unwrap_or_default();
    let name = about.lines().find_map(|line| line.strip_prefix("PRETTY_NAME="));
    name.map_or(std::env::consts::OS, |name| name.trim_matches('"')).to_owned()
}

/// Returns the version of a package that the peers are built with.
fn locked_version(name: &str) -> String {
    let lock = read_text(&project_root().join("Cargo.lock")).unwrap_or_default();
    let after = lock.split_once(&format!("name = \"{name}\"\nversion = \"")).map(|(_, rest)| rest);
    after.and_then(|rest| rest.split('"').next()).unwrap_or("of unknown version").to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_busy_machine_is_reported() {
        let at = |load| Place { cores: 4, load_before: Some(load), ..Place::default() };
        let text = |load| at(load).to_markdown(&Value::Null);
        assert!(text(2.0).contains("was busy") && !text(0.5).contains("was busy"));
        assert!(text(0.5).contains("| machine load before and after | 0.50, then unknown |"));
        assert!(locked_version("euc").starts_with("0.5"));
    }
}
