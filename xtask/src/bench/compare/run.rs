//! One run of a program and its figures: the stages of `--timings`, wall and CPU time, and peak
//! memory.

use super::variants::Call;
use crate::workspace::{project_root, read_text};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

/// The sum of all stages.
const ALL: &str = "all";
/// The total without [`LOADING`]: the stages that features and styles affect.
pub const DRAWING: &str = "drawing";
/// The time from the start to the end of the process.
pub const WALL: &str = "wall";
/// The CPU time of the process on all cores, in steps of 10 ms.
const CPU: &str = "cpu";
/// The peak resident set size in MiB.
pub const PEAK_MEMORY: &str = "peak memory";

/// Stages that read and write files.
const LOADING: [&str; 6] = ["read", "parse", "geometry", "images", "encode", "write"];

/// Flags that have been renamed, each with its former name.
const FORMER_FLAGS: [(&str, &str); 3] =
    [("--tone-mapping", "--tone"), ("--max-anisotropy", "--anisotropy"), ("--out-dir", "--out")];

/// Figures of a run by name, in the order in which they were printed. Times are in milliseconds and
/// memory in MiB.
pub type Figures = Vec<(String, f64)>;

/// A program and how to run it.
#[derive(Clone, Debug)]
pub struct TimedProgram {
    path: PathBuf,
    /// The folder for its pictures.
    folder: PathBuf,
    /// GNU time, which measures CPU time and peak memory.
    gnu_time: Option<PathBuf>,
}

impl TimedProgram {
    /// Creates a program that writes its pictures to `folder`.
    pub fn new(path: &Path, folder: &Path, gnu_time: Option<PathBuf>) -> Self {
        Self { path: path.to_owned(), folder: folder.to_owned(), gnu_time }
    }

    /// Returns the arguments of a call, with this program's spelling of the flags and with its
    /// output path.
    pub fn adapt_call(&self, call: &Call) -> Vec<String> {
        let help = Command::new(&self.path).args([call.command, "--help"]).output();
        let help = help.map(|help| String::from_utf8_lossy(&help.stdout).into_owned());
        let mut arguments = vec![call.command.to_owned()];
        let (flag, output) =
            if call.command == "batch" { ("--out-dir", "batch") } else { ("-o", "picture.png") };
        arguments.extend(call.arguments.iter().cloned());
        arguments.push(flag.to_owned());
        arguments.push(self.folder.join(output).to_string_lossy().into_owned());
        let spelled = |word: String| spell_flag(word, help.as_deref().unwrap_or_default());
        arguments.into_iter().map(spelled).collect()
    }

    /// Runs the program once and returns the figures, or its error message in one line.
    pub fn run(&self, arguments: &[String]) -> Result<Figures, String> {
        let batch = self.folder.join("batch");
        if batch.exists() {
            // If pictures from the previous run remained, there would be no work left to measure.
            std::fs::remove_dir_all(&batch).map_err(|e| format!("{}: {e}", batch.display()))?;
        }
        let usage = self.folder.join("usage");
        let mut command = match &self.gnu_time {
            Some(gnu_time) => {
                let mut command = Command::new(gnu_time);
                command.args(["-f", "%U %S %M", "-o"]).arg(&usage).arg(&self.path);
                command
            }
            None => Command::new(&self.path),
        };
        command.args(arguments).current_dir(project_root()).stdin(Stdio::null());
        let start = Instant::now();
        let output = command.output().map_err(|e| format!("{}: {e}", self.path.display()))?;
        let wall = 1e3 * start.elapsed().as_secs_f64();
        let text = String::from_utf8_lossy(&output.stderr);
        if !output.status.success() {
            let error = text.lines().find(|line| line.starts_with("error"));
            return Err(error.or(text.lines().next()).unwrap_or("it failed").to_owned());
        }
        let mut figures = parse_timings(&text);
        figures.push((WALL.into(), wall));
        if self.gnu_time.is_some() {
            figures.extend(parse_usage(&read_text(&usage)?));
        }
        Ok(figures)
    }
}

/// Finds GNU time, the only implementation of `time` with a configurable output format.
pub fn find_gnu_time() -> Option<PathBuf> {
    let path = PathBuf::from("/usr/bin/time");
    let version = Command::new(&path).arg("--version").output().ok()?;
    let text = [version.stdout, version.stderr].concat();
    String::from_utf8_lossy(&text).contains("GNU").then_some(path)
}

fn spell_flag(word: String, help: &str) -> String {
    let has = |flag: &str| help.split([' ', '[', '=', '\n', ',']).any(|word| word == flag);
    let former = FORMER_FLAGS.into_iter().find(|(flag, _)| *flag == word);
    match former {
        Some((flag, former)) if !has(flag) && has(former) => former.to_owned(),
        _ => word,
    }
}

/// Parses the stages in a program's output, and adds their sum and their sum without the file
/// stages.
fn parse_timings(text: &str) -> Figures {
    let mut figures: Figures = text.lines().filter_map(parse_stage).collect();
    let figure = |name: &str| figures.iter().find(|(known, _)| known == name).map(|(_, ms)| *ms);
    if let Some(all) = figure(ALL) {
        let loading: f64 = LOADING.into_iter().filter_map(figure).sum();
        figures.push((DRAWING.into(), all - loading));
    }
    figures
}

/// Parses a line such as `mip chains      7.38 ms`.
fn parse_stage(line: &str) -> Option<(String, f64)> {
    let (name, number) = line.strip_suffix(" ms")?.rsplit_once(' ')?;
    let milliseconds: f64 = number.parse().ok()?;
    let name = name.trim_end();
    let is_name = name.starts_with(|c: char| c.is_ascii_lowercase())
        && name.chars().all(|c| c.is_ascii_alphabetic() || c == ' ' || c == '-');
    (is_name && milliseconds.is_finite()).then(|| (name.to_owned(), milliseconds))
}

/// Parses the last line of GNU time's output: seconds of user time and of system time, and KiB of
/// memory.
fn parse_usage(text: &str) -> Figures {
    let words = text.lines().last().unwrap_or_default().split_whitespace();
    let numbers: Vec<f64> = words.filter_map(|word| word.parse().ok()).collect();
    let [user, system, memory] = numbers[..] else { return Vec::new() };
    vec![(CPU.into(), 1e3 * (user + system)), (PEAK_MEMORY.into(), memory / 1024.0)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn timings_are_found_among_other_lines() {
        let text = "read            0.04 ms\nwarning: it took 3 ms\nmip chains      7.38 ms\n\
                    pixels        200.00 ms\nencode         10.00 ms\nall           217.42 ms\n";
        let figures = parse_timings(text);
        let names: Vec<&str> = figures.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["read", "mip chains", "pixels", "encode", "all", "drawing"]);
        assert_eq!(figures[1].1, 7.38);
        assert!((figures[5].1 - 207.38).abs() < 1e-9, "the sum without read and encode");
        assert!(parse_timings("error: unexpected argument '--timings'").is_empty());
    }

    #[test]
    fn lines_that_are_not_stages_are_ignored() {
        for line in ["", " ms", "pixels ms", "pixels NaN ms", "pixels 1.0 s", "3 ms", "a: 3 ms"] {
            assert_eq!(parse_stage(line), None, "{line}");
        }
    }

    #[test]
    fn flags_are_spelled_as_the_program_expects() {
        let former = "      --tone <CURVE>\n      --out <DIR>\n";
        let spelled = |word: &str, help: &str| spell_flag(word.to_owned(), help);
        assert_eq!(spelled("--tone-mapping", former), "--tone");
        assert_eq!(spelled("--out-dir", former), "--out");
        assert_eq!(spelled("--out-dir", "--out-dir <DIR>, and not --out"), "--out-dir");
        assert_eq!(spelled("--max-anisotropy", former), "--max-anisotropy");
    }

    #[test]
    fn usage_is_read_from_the_last_line() {
        let figures = parse_usage("Command exited with non-zero status 1\n0.25 0.5 2048\n");
        assert_eq!(figures, [("cpu".to_owned(), 750.0), ("peak memory".to_owned(), 2.0)]);
        assert!(parse_usage("").is_empty() && parse_usage("1.0 2.0\n").is_empty());
    }
}
