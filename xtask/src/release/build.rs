//! Builds the programs of a release without paths of this machine, so that the bytes depend only on
//! the sources.

use super::write_file;
use crate::Outcome;
use crate::program::{capture_output, cargo_command, run_command};
use crate::workspace::{create_folder, project_root};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The two variants of the released program.
pub struct Programs {
    /// For distribution packages. It uses the system's C library.
    pub dynamic: PathBuf,
    /// For download. It needs only the kernel.
    pub standalone: PathBuf,
}

/// Builds both programs. They differ only in linking, so everything else is compiled once.
pub fn build_programs(sources: &Path, target: &Path) -> Result<Programs, String> {
    let compiler = Compiler::ask()?;
    let build = |name: &str, flags: &[&str]| {
        let mut cargo = cargo_command(&["rustc", "--quiet", "--locked", "--release"]);
        // With an explicit target, the flags do not apply to procedural macros, which cannot be
        // linked statically.
        cargo.args(["--package", "alberti", "--bin", "alberti", "--target", &compiler.host]);
        cargo.arg("--").args(flags).current_dir(sources);
        cargo.env("CARGO_TARGET_DIR", target).env_remove("RUSTFLAGS");
        cargo.env("CARGO_ENCODED_RUSTFLAGS", compiler.remapped_paths(sources, target));
        run_command(&mut cargo)?;
        let folder = target.join("programs").join(name);
        create_folder(&folder)?;
        let (from, to) =
            (target.join(&compiler.host).join("release/alberti"), folder.join("alberti"));
        fs::copy(&from, &to).map_err(|error| format!("{}: {error}", from.display()))?;
        Ok::<PathBuf, String>(to)
    };
    Ok(Programs {
        dynamic: build("dynamic", &[])?,
        standalone: build("standalone", &["-Ctarget-feature=+crt-static"])?,
    })
}

/// The properties of the compiler.
struct Compiler {
    host: String,
    commit: String,
    sysroot: String,
}

impl Compiler {
    fn ask() -> Result<Self, String> {
        let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
        let about = capture_output(Command::new(&rustc).arg("-vV").current_dir(project_root()))?;
        let field = |name: &str| {
            let found = about.lines().find_map(|line| line.strip_prefix(name));
            found
                .map(|value| value.trim().to_owned())
                .ok_or(format!("rustc does not report {name}"))
        };
        let mut sysroot = Command::new(&rustc);
        sysroot.args(["--print", "sysroot"]).current_dir(project_root());
        Ok(Self {
            host: field("host:")?,
            commit: field("commit-hash:")?,
            sysroot: capture_output(&mut sysroot)?.trim().to_owned(),
        })
    }

    /// Returns the flags that replace paths of this machine in panic messages.
    fn remapped_paths(&self, sources: &Path, target: &Path) -> String {
        // If several prefixes match, the last one applies.
        let pairs = [
            (cargo_home(), "cargo".to_owned()),
            (sources.to_owned(), "alberti".to_owned()),
            (target.to_owned(), "target".to_owned()),
            // Use the path that appears on machines without the standard library's sources.
            (
                PathBuf::from(&self.sysroot).join("lib/rustlib/src/rust"),
                format!("/rustc/{}", self.commit),
            ),
        ];
        let flags = pairs.map(|(from, to)| format!("--remap-path-prefix={}={to}", from.display()));
        flags.join("\u{1f}")
    }
}

/// Returns Cargo's folder for downloaded files.
pub fn cargo_home() -> PathBuf {
    std::env::var_os("CARGO_HOME").map(PathBuf::from).unwrap_or_else(|| {
        PathBuf::from(std::env::var_os("HOME").unwrap_or_default()).join(".cargo")
    })
}

/// Copies all files under version control, in their current state, to a folder.
pub fn copy_sources(to: &Path) -> Outcome {
    let mut git = Command::new("git");
    let files = capture_output(
        git.current_dir(project_root())
            .args(["ls-files", "--cached", "--others"])
            .args(["--exclude-standard", "-z"]),
    )?;
    for name in files.split('\0').filter(|name| !name.is_empty()) {
        let (from, to) = (project_root().join(name), to.join(name));
        create_folder(to.parent().unwrap_or(&to))?;
        let fault = |error: std::io::Error| format!("{}: {error}", from.display());
        let kind = from.symlink_metadata().map_err(fault)?;
        if kind.is_symlink() {
            copy_link(&from, &to)?;
        } else {
            write_file(&to, &fs::read(&from).map_err(fault)?)?;
        }
    }
    Ok(())
}

/// Copies a symbolic link without following it.
fn copy_link(from: &Path, to: &Path) -> Outcome {
    run_command(Command::new("cp").args(["--no-dereference"]).arg(from).arg(to))
}
