//! Checks that a real thumbnail service makes a thumbnail for every format, using the files that
//! `alberti thumbnailer --install` writes.
//!
//! The service is tumbler, from Xfce. It runs on a separate message bus, without a display, in the
//! test's own folders. If it is not installed, the step is reported as skipped; `.ci/run` installs
//! it if it can.

mod samples;

use alberti_tests::harness::{Tally, TemporaryFolder, run_program};
use std::collections::BTreeMap;
use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

/// The requested side length of the thumbnails, which the specification calls `normal`.
const SIDE: &str = "128";

pub fn run() -> ExitCode {
    run_program("thumbnails", |_| {
        let mut tally = Tally::default();
        if let Some(missing) = missing_program() {
            tally.skip("thumbnails", &missing);
            return Ok(tally);
        }
        let folder = TemporaryFolder::create("thumbnails")?;
        let service = ThumbnailService::prepare(folder.path())?;
        let made = service.queue_files()?;
        for name in samples::SHOWN {
            tally.record(name, service.check_thumbnail(name, &made));
        }
        let outcome = match made.get(samples::BROKEN) {
            None => Ok(()),
            Some(_) => Err("a broken file has a thumbnail".to_owned()),
        };
        tally.record(samples::BROKEN, outcome);
        Ok(tally)
    })
}

/// Returns a message that names the first missing program and its Debian package.
fn missing_program() -> Option<String> {
    let names = [
        ("dbus-run-session", "dbus-daemon"),
        ("gdbus", "libglib2.0-bin"),
        ("update-mime-database", "shared-mime-info"),
    ];
    let is_missing = |name: &str| Command::new(name).arg("--version").output().is_err();
    let program = names.into_iter().find(|(name, _)| is_missing(name));
    let service = ["/usr/share/dbus-1/services/org.xfce.Tumbler.Thumbnailer1.service"];
    let service = service.into_iter().find(|path| !Path::new(path).is_file());
    let (name, package) = program.or(service.map(|_| ("tumblerd", "tumbler")))?;
    Some(format!("{name} is not installed (Debian: {package})"))
}

/// A thumbnail service that uses only the test's folders.
struct ThumbnailService {
    /// The folder that contains all others.
    folder: PathBuf,
    /// The program that draws the thumbnails.
    program: PathBuf,
}

impl ThumbnailService {
    /// Writes the files for which thumbnails are requested, and installs the thumbnailer.
    fn prepare(folder: &Path) -> Result<Self, String> {
        let service = Self { folder: folder.to_owned(), program: alberti_tests::program_path()? };
        for part in ["models", "cache", "home", "run"] {
            let path = folder.join(part);
            std::fs::create_dir_all(&path).map_err(|e| format!("{}: {e}", path.display()))?;
        }
        samples::write_samples(&folder.join("models"))?;
        let mut install = Command::new(&service.program);
        service.run(install.args(["thumbnailer", "--install"]))?;
        Ok(service)
    }

    /// Runs a program in the service's folders; returns its output.
    fn run(&self, command: &mut Command) -> Result<String, String> {
        let path = |name: &str| self.folder.join(name);
        let output = command
            .env("HOME", path("home"))
            .env("XDG_DATA_HOME", path("data"))
            .env("XDG_CACHE_HOME", path("cache"))
            .env("XDG_RUNTIME_DIR", path("run"))
            .env("XDG_CONFIG_HOME", path("config"))
            .env("XDG_DATA_DIRS", "/usr/share")
            .env_remove("DISPLAY")
            .output()
            .map_err(|error| format!("{}: {error}", command.get_program().display()))?;
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        if output.status.success() {
            return Ok(text);
        }
        let said = String::from_utf8_lossy(&output.stderr);
        Err(format!("{} failed: {said}{text}", command.get_program().display()))
    }

    /// Requests thumbnails of all files from the service, starting with the broken file, and waits
    /// for them. Returns the thumbnails by file name.
    fn queue_files(&self) -> Result<BTreeMap<String, PathBuf>, String> {
        let names: Vec<&str> = [samples::BROKEN].into_iter().chain(samples::SHOWN).collect();
        let uris = names
            .iter()
            .map(|name| format!("'file://{}'", self.folder.join("models").join(name).display()));
        let uris = format!("[{}]", uris.collect::<Vec<_>>().join(","));
        let types = names.iter().map(|name| format!("'{}'", samples::mime_type(name)));
        let types = format!("[{}]", types.collect::<Vec<_>>().join(","));
        let mut session = Command::new("dbus-run-session");
        let count = samples::SHOWN.len().to_string();
        self.run(session.args(["--", "sh", "-c", SESSION, "sh", &uris, &types, &count]))?;
        let folder = self.folder.join("cache/thumbnails/normal");
        let mut made = BTreeMap::new();
        for entry in std::fs::read_dir(&folder).into_iter().flatten().flatten() {
            let uri = thumbnail_uri(&entry.path())?;
            let name = uri.rsplit('/').next().unwrap_or_default();
            made.insert(name.to_owned(), entry.path());
        }
        Ok(made)
    }

    /// Checks that the thumbnail of a file is the picture that the program renders from it.
    fn check_thumbnail(&self, name: &str, made: &BTreeMap<String, PathBuf>) -> Result<(), String> {
        let thumbnail = made.get(name).ok_or("the service did not make a thumbnail")?;
        let expected = self.folder.join("expected.png");
        let model = self.folder.join("models").join(name);
        let mut thumbnailer = Command::new(&self.program);
        thumbnailer.arg("thumbnailer").args([&model, &expected]).args(["--size", SIDE]);
        self.run(&mut thumbnailer)?;
        let (pictures, expected) =
            (alberti_tests::read_png(thumbnail)?, alberti_tests::read_png(&expected)?);
        let shown = expected.2.iter().filter(|pixel| pixel[3] == 255).count();
        if shown < 1_000 {
            return Err(format!("only {shown} pixels of the picture are opaque"));
        }
        let is_same = |(a, b): (&[u8; 4], &[u8; 4])| a == b || (a[3] == 0 && b[3] == 0);
        if pictures.0 == expected.0
            && pictures.1 == expected.1
            && pictures.2.iter().zip(&expected.2).all(is_same)
        {
            return Ok(());
        }
        Err("the thumbnail differs from the program's picture".to_owned())
    }
}

/// Queues files with their types, and exits after a minute or once there are as many thumbnails as
/// the last argument says. The service notifies only the requester, which has exited by then.
const SESSION: &str = r#"
name=org.freedesktop.thumbnails.Thumbnailer1
path=/org/freedesktop/thumbnails/Thumbnailer1
# The MIME type is passed, because a busy service does not answer a query for it.
gdbus call --session --dest $name --object-path $path --method $name.Queue "$1" "$2" normal default 'uint32 0' || exit
tries=0
until [ "$(find "$XDG_CACHE_HOME" -name '*.png' | wc -l)" -ge "$3" ]; do
  tries=$((tries + 1))
  [ $tries -lt 300 ] || exit 0
  sleep 0.2
done
"#;

/// Returns the URI of the file to which a thumbnail belongs, as stored in the thumbnail.
fn thumbnail_uri(path: &Path) -> Result<String, String> {
    let problem = |error: String| format!("{}: {error}", path.display());
    let file = File::open(path).map_err(|error| problem(error.to_string()))?;
    let reader = png::Decoder::new(BufReader::new(file)).read_info();
    let reader = reader.map_err(|error| problem(error.to_string()))?;
    let texts = &reader.info().uncompressed_latin1_text;
    let uri = texts.iter().find(|text| text.keyword == "Thumb::URI");
    uri.map(|text| text.text.clone()).ok_or_else(|| problem("it has no Thumb::URI".to_owned()))
}
