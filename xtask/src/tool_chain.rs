//! A compiler with the sources of the standard library, for targets whose compiled library is not
//! installed.

use crate::program::{capture_output, cargo_command};
use std::path::{Path, PathBuf};
use std::process::Command;

/// A compiler and its Cargo.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ToolChain {
    pub cargo: PathBuf,
    pub rustc: PathBuf,
    /// The folder of the compiler's libraries.
    pub root: PathBuf,
}

impl ToolChain {
    /// Returns the tool chain of this workspace.
    ///
    /// # Errors
    /// Fails if its compiler does not run.
    pub fn own() -> Result<Self, String> {
        let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
        Self::at(cargo_command(&[]).get_program().into(), rustc.into())
    }

    /// Returns Debian's tool chain.
    ///
    /// # Errors
    /// Fails if it is not installed.
    pub fn debian() -> Result<Self, String> {
        Self::at("/usr/bin/cargo".into(), "/usr/bin/rustc".into()).map_err(|_| {
            "there is no second compiler: on Debian, run `apt-get install cargo-web rustc-web`"
                .into()
        })
    }

    fn at(cargo: PathBuf, rustc: PathBuf) -> Result<Self, String> {
        let root = capture_output(Command::new(&rustc).args(["--print", "sysroot"]))?;
        Ok(Self { cargo, rustc, root: root.trim().into() })
    }

    /// Returns the workspace's tool chain if it has the sources of the standard library, otherwise
    /// Debian's.
    ///
    /// # Errors
    /// Fails if neither has them. The message explains how to install them.
    pub fn with_sources() -> Result<Self, String> {
        let candidates = [Self::own(), Self::debian()].into_iter().flatten();
        let mut with = candidates
            .filter(|candidate| candidate.root.join("lib/rustlib/src/rust/library/std").is_dir());
        with.next().ok_or_else(|| MISSING.to_owned())
    }

    /// Returns the version of the compiler, such as `1.95.0`.
    ///
    /// # Errors
    /// Fails if the compiler does not run.
    pub fn version(&self) -> Result<String, String> {
        let text = capture_output(Command::new(&self.rustc).arg("--version"))?;
        text.split(' ').nth(1).map(str::to_owned).ok_or(format!("`{text}` is not a version"))
    }

    /// Returns a command that runs Cargo in the folder `package`, with this compiler and these
    /// compiler flags. The results are written to the folder `out`.
    pub fn cargo_build(&self, package: &Path, flags: &[String], out: &Path) -> Command {
        let mut build = Command::new(&self.cargo);
        build.current_dir(package).args(["build", "--quiet", "--locked", "--release"]);
        build.env("RUSTC", &self.rustc).env("CARGO_TARGET_DIR", out).env_remove("RUSTC_WRAPPER");
        build.env("CARGO_ENCODED_RUSTFLAGS", flags.join("\u{1f}")).env_remove("RUSTFLAGS");
        build
    }
}

const MISSING: &str = "the sources of Rust's standard library, needed to compile for other \
    targets, are missing: run `rustup component add rust-src`, \
    or on Debian `apt-get install cargo-web rustc-web rust-web-src`";
