//! The commands in the pages: runs each once, with a time limit, and caches its output.

use sha2::{Digest, Sha256};
use std::collections::BTreeSet;
use std::fs;
use std::io::Read as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// The time limit for one command.
const LIMIT: Duration = Duration::from_secs(60);

/// The maximum number of commands that run at the same time.
const THREADS: usize = 2;

/// The maximum depth of references between files: a scene, its model, the model's images.
const DEPTH: usize = 3;

/// The kind of a command's output.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Kind {
    /// A line drawing.
    Svg,
    /// A picture.
    Png,
    /// Text in English, or text that is the same in all languages.
    Text,
    /// Text in Chinese.
    ChineseText,
}

impl Kind {
    fn extension(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Png => "png",
            Self::Text | Self::ChineseText => "txt",
        }
    }

    fn is_text(self) -> bool {
        matches!(self, Self::Text | Self::ChineseText)
    }
}

/// A command in a page.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Job {
    /// The words after `alberti`.
    pub words: Vec<String>,
    /// The kind of its output.
    pub kind: Kind,
}

impl Job {
    /// Parses a command line; a backslash at the end continues it on the next line.
    pub fn parse(line: &str, kind: Kind) -> Result<Self, String> {
        let line = line.trim().replace("\\\n", " ");
        if line.contains('\n') {
            return Err("a block must contain one command; use `\\` to continue a line".into());
        }
        let words = shlex::split(&line).ok_or("unclosed quotation mark")?;
        match words.split_first() {
            Some((first, words)) if first == "alberti" => Ok(Self { words: words.to_vec(), kind }),
            _ => Err("a command must begin with `alberti`".into()),
        }
    }
}

/// A command runner that caches outputs.
pub struct Runner {
    program: PathBuf,
    program_hash: String,
    /// The working directory of the commands.
    root: PathBuf,
    /// The cache folder.
    cache: PathBuf,
}

impl Runner {
    /// Creates a runner for `program` with the working directory `root`.
    pub fn new(program: &Path, root: &Path, cache: &Path) -> Result<Self, String> {
        let error = |path: &Path, error: std::io::Error| format!("{}: {error}", path.display());
        let program = program.canonicalize().map_err(|found| error(program, found))?;
        let bytes = fs::read(&program).map_err(|found| error(&program, found))?;
        fs::create_dir_all(cache).map_err(|found| error(cache, found))?;
        let cache = cache.canonicalize().map_err(|found| error(cache, found))?;
        Ok(Self { program_hash: hash(&bytes), program, root: root.to_owned(), cache })
    }

    /// Returns each job's output file or error message; commands with cached output do not run.
    pub fn run_all(&self, jobs: &[Job]) -> Vec<Result<PathBuf, String>> {
        let next = Mutex::new(0);
        let answers: Mutex<Vec<Result<PathBuf, String>>> =
            Mutex::new(vec![Err("not run".into()); jobs.len()]);
        std::thread::scope(|scope| {
            for _ in 0..THREADS {
                scope.spawn(|| {
                    while let Some(at) = take_next(&next, jobs.len()) {
                        let answer = self.run(&jobs[at]);
                        if let Ok(mut answers) = answers.lock() {
                            answers[at] = answer;
                        }
                    }
                });
            }
        });
        answers.into_inner().unwrap_or_default()
    }

    fn run(&self, job: &Job) -> Result<PathBuf, String> {
        let name = format!("{}.{}", &self.key(job)[..20], job.kind.extension());
        let path = self.cache.join(&name);
        if path.is_file() {
            return Ok(path);
        }
        // Output is renamed when complete, so an interrupted build never caches partial output.
        let partial = self.cache.join(format!("partial-{name}"));
        let mut command = Command::new(&self.program);
        let locale = if job.kind == Kind::ChineseText { "zh_CN.UTF-8" } else { "C" };
        command.current_dir(&self.root).args(&job.words).env("NO_COLOR", "1").env("LC_ALL", locale);
        if !job.kind.is_text() {
            command.arg("-o").arg(&partial);
        }
        let text = run_limited(&mut command)?;
        if job.kind.is_text() {
            fs::write(&partial, text).map_err(|error| format!("{}: {error}", partial.display()))?;
        }
        fs::rename(&partial, &path)
            .map_err(|_| "the command did not write the file specified with `-o`".to_owned())?;
        Ok(path)
    }

    /// Computes a hash of everything on which a command's output depends.
    fn key(&self, job: &Job) -> String {
        let mut all = format!("{}\n{:?}\n{:?}\n", self.program_hash, job.kind, job.words);
        let mut files = BTreeSet::new();
        for word in &job.words {
            collect_inputs(&self.root.join(word), DEPTH, &mut files);
        }
        for file in files {
            all += &hash(&fs::read(file).unwrap_or_default());
        }
        hash(all.as_bytes())
    }
}

fn take_next(next: &Mutex<usize>, count: usize) -> Option<usize> {
    let mut next = next.lock().ok()?;
    let at = *next;
    *next += 1;
    (at < count).then_some(at)
}

/// Collects a file and, if its format is text, the files that it names in quotation marks.
fn collect_inputs(path: &Path, depth: usize, found: &mut BTreeSet<PathBuf>) {
    if !path.is_file() || !found.insert(path.to_owned()) || depth == 0 {
        return;
    }
    let is_text = path.extension().is_some_and(|name| name == "ron" || name == "gltf");
    let Some(text) = is_text.then(|| fs::read_to_string(path).ok()).flatten() else { return };
    let folder = path.parent().unwrap_or(Path::new("."));
    for name in text.split('"').skip(1).step_by(2).filter(|name| name.len() < 200) {
        collect_inputs(&folder.join(name), depth - 1, found);
    }
}

/// Computes a SHA-256 hash in hexadecimal.
pub fn hash(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Runs a command and returns its output; a command that exceeds the time limit is an error.
fn run_limited(command: &mut Command) -> Result<Vec<u8>, String> {
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().map_err(|error| error.to_string())?;
    let readers = [
        child.stdout.take().map(|stream| read_all(Box::new(stream))),
        child.stderr.take().map(|stream| read_all(Box::new(stream))),
    ];
    let start = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().map_err(|error| error.to_string())? {
            break status;
        }
        if start.elapsed() > LIMIT {
            // Killing a command that has just exited fails, but that is harmless.
            let _ = child.kill();
            let _ = child.wait();
            return Err(format!("the command exceeded the time limit of {} s", LIMIT.as_secs()));
        }
        std::thread::sleep(Duration::from_millis(5));
    };
    let [out, error] =
        readers.map(|reader| reader.and_then(|it| it.join().ok()).unwrap_or_default());
    if status.success() {
        return Ok(out);
    }
    Err(format!("the command failed ({status})\n{}", String::from_utf8_lossy(&error).trim_end()))
}

fn read_all(mut stream: Box<dyn std::io::Read + Send>) -> std::thread::JoinHandle<Vec<u8>> {
    std::thread::spawn(move || {
        let mut bytes = Vec::new();
        // If reading fails, the output read so far is used.
        let _ = stream.read_to_end(&mut bytes);
        bytes
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_single_alberti_commands_are_accepted() {
        let job = Job::parse("alberti render a.ron \\\n  --label 'a b'\n", Kind::Svg).unwrap();
        assert_eq!(job.words, ["render", "a.ron", "--label", "a b"]);
        for line in ["rm -r x", "alberti info a\nalberti info b", "alberti 'x", ""] {
            assert!(Job::parse(line, Kind::Text).is_err(), "{line}");
        }
    }

    #[test]
    fn referenced_files_are_inputs() {
        let folder = std::env::temp_dir().join("mdbook-alberti-inputs");
        fs::create_dir_all(&folder).unwrap();
        fs::write(folder.join("a.ron"), "(model: \"b.gltf\", other: \"none\")").unwrap();
        fs::write(folder.join("b.gltf"), "{}").unwrap();
        let mut found = BTreeSet::new();
        collect_inputs(&folder.join("a.ron"), DEPTH, &mut found);
        assert_eq!(found.len(), 2);
    }
}
