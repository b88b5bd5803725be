//! Tests the package in an empty Debian system: installs it, uses it as a user would, and removes
//! it without a trace.
//!
//! ```text
//!  debootstrap, once ─► copy ─► dpkg --install ─► picture, drawing, completion, thumbnail, manual
//!                         └──── list of files ──── the same again ◄── dpkg --purge
//! ```
//! The test needs root and `debootstrap`; without them, it is reported as skipped.

use crate::Outcome;
use crate::program::{Program, capture_output, run_command};
use crate::skip::report_skip;
use crate::workspace::{create_folder, project_root, read_text, target_folder};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The oldest supported Debian release.
const SUITE: &str = "bookworm";

/// The folder of the scenes in the trial system.
const SCENES: &str = "srv/scenes";

/// The scenes to render, each with the name of its output.
const OUTPUTS: [(&str, &str); 2] =
    [("teapot.ron", "picture.png"), ("two_point.ron", "drawing.svg")];

/// The model for the thumbnail.
const MODEL: &str = "models/house.glb";

/// Installs, uses and removes a package. Pictures must have the same bytes as outside the trial
/// system.
pub fn try_package(deb: &Path, program: &Program) -> Outcome {
    let Some(trial) = new_debian()? else { return Ok(()) };
    let before = trial.files()?;
    run_command(Command::new("cp").arg(deb).arg(trial.root.join("srv/alberti.deb")))?;
    trial.run("dpkg --install /srv/alberti.deb")?;
    trial.compare_pictures(program)?;
    trial.make_thumbnail()?;
    trial.complete()?;
    trial.run("zcat /usr/share/man/man1/alberti-render.1.gz | grep -q '^.TH'")?;
    trial.run("test -s /usr/share/doc/alberti/copyright")?;
    trial.run("dpkg --purge alberti")?;
    let after = trial.files()?;
    let left: Vec<&String> = after.symmetric_difference(&before).collect();
    if !left.is_empty() {
        return Err(format!("files left behind or wrongly removed by the package:\n  {left:?}"));
    }
    println!(
        "{}: installed, used and removed without a trace in an empty Debian system",
        deb.file_name().unwrap_or_default().to_string_lossy()
    );
    fs::remove_dir_all(&trial.root).map_err(|error| error.to_string())
}

/// A Debian system in a folder.
struct Trial {
    root: PathBuf,
}

/// Returns a fresh copy of a minimal Debian system, or `None` if that system cannot be created. The
/// original is created only once.
fn new_debian() -> Result<Option<Trial>, String> {
    let is_root = capture_output(Command::new("id").arg("-u")).is_ok_and(|id| id.trim() == "0");
    let has_tool = Command::new("debootstrap").arg("--version").output().is_ok();
    if !is_root || !has_tool {
        report_skip("package", "installing it requires root and debootstrap");
        return Ok(None);
    }
    let folder = target_folder().join("debian");
    let (empty, making) = (folder.join(SUITE), folder.join("unfinished"));
    create_folder(&folder)?;
    if !empty.is_dir() {
        let _ = fs::remove_dir_all(&making);
        let mut debootstrap = Command::new("debootstrap");
        debootstrap.args(["--variant=minbase", SUITE]).arg(&making);
        if let Err(error) = run_command(&mut debootstrap) {
            let reason = error.lines().last().unwrap_or_default().to_owned();
            report_skip("package", &format!("debootstrap failed ({reason})"));
            return Ok(None);
        }
        fs::rename(&making, &empty).map_err(|error| error.to_string())?;
    }
    let root = folder.join("trial");
    let _ = fs::remove_dir_all(&root);
    run_command(Command::new("cp").args(["--archive", "--reflink=auto"]).arg(&empty).arg(&root))?;
    let mut copy = Command::new("cp");
    copy.arg("-R").arg(project_root().join("scenes")).arg(root.join(SCENES));
    run_command(&mut copy)?;
    Ok(Some(Trial { root }))
}

impl Trial {
    /// Runs a shell command in the trial system.
    fn run(&self, line: &str) -> Result<String, String> {
        let mut chroot = Command::new("chroot");
        chroot.env_clear().env("PATH", "/usr/sbin:/usr/bin:/sbin:/bin").env("HOME", "/");
        capture_output(chroot.arg(&self.root).args(["bash", "-c", line]))
    }

    /// Lists all files, except for dpkg's records and the files that the trial itself adds.
    fn files(&self) -> Result<BTreeSet<String>, String> {
        let list = self.run("find / -xdev -printf '%p %y %m %l\\n'")?;
        let ours = ["/srv/", "/var/lib/dpkg/", "/var/log/", "/var/cache/ldconfig/"];
        let is_ours = |line: &&str| ours.iter().any(|folder| line.starts_with(folder));
        Ok(list.lines().filter(|line| !is_ours(line)).map(str::to_owned).collect())
    }

    /// Checks that a picture and a line drawing have the same bytes as outside the trial system.
    fn compare_pictures(&self, program: &Program) -> Outcome {
        let outside = target_folder().join("deb");
        create_folder(&outside)?;
        for (scene, name) in OUTPUTS {
            self.run(&format!("alberti render /{SCENES}/{scene} -o /srv/{name}"))?;
            let expected = outside.join(name);
            program.render(&project_root().join("scenes").join(scene), &expected, &[])?;
            let read = |path: &Path| fs::read(path).map_err(|error| error.to_string());
            if read(&expected)? != read(&self.root.join("srv").join(name))? {
                return Err(format!("{name} differs in an empty Debian system"));
            }
        }
        Ok(())
    }

    /// Runs the command in the thumbnailer entry, as a thumbnail service does.
    fn make_thumbnail(&self) -> Outcome {
        let entry = read_text(&self.root.join("usr/share/thumbnailers/alberti.thumbnailer"))?;
        let line = entry.lines().find_map(|line| line.strip_prefix("Exec="));
        let line = line.ok_or("the thumbnailer entry has no Exec line")?;
        let input = format!("/{SCENES}/{MODEL}");
        let line =
            line.replace("%i", &input).replace("%o", "/srv/thumbnail.png").replace("%s", "128");
        self.run(&line)?;
        let picture = fs::read(self.root.join("srv/thumbnail.png")).map_err(|e| e.to_string())?;
        // These bytes of a PNG header are the width.
        if picture.get(16..20) == Some(&128_u32.to_be_bytes()) {
            return Ok(());
        }
        Err(format!("`{line}` did not write a 128-pixel thumbnail"))
    }

    /// Checks that bash completes `alberti ren`, and that zsh recognizes its completion file.
    fn complete(&self) -> Outcome {
        let words = self.run(
            "source /usr/share/bash-completion/completions/alberti; COMP_WORDS=(alberti ren); \
             COMP_CWORD=1; _alberti alberti ren alberti; echo ${COMPREPLY[@]}",
        )?;
        if words.trim() != "render" {
            return Err(format!("bash completes `alberti ren` as `{}`", words.trim()));
        }
        let zsh = self.root.join("usr/share/zsh/vendor-completions/_alberti");
        if !read_text(&zsh)?.starts_with("#compdef alberti") {
            return Err("the zsh completions do not begin with `#compdef alberti`".into());
        }
        Ok(())
    }
}
