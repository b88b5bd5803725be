//! The tool chain that compiles Rust to WebAssembly here: a compiler with the sources of the standard library.
//!
//! They are compiled with the explorer: a panic without a message, which nobody would read since the
//! page starts another worker, and sorting in less code take a sixth off the module. The compiled
//! library that rustup has for WebAssembly has neither.

use crate::program::{capture_output, cargo_command};
use crate::workspace::target_folder;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The target of the compiler.
const TARGET: &str = "wasm32-unknown-unknown";

/// Vector instructions are those that every browser has had since 2023; relaxed ones would round as
/// each machine likes. A panic is a trap.
const COMPILER_FLAGS: [&str; 3] =
    ["-Ctarget-feature=+simd128", "-Zunstable-options", "-Cpanic=immediate-abort"];

/// A compiler for WebAssembly, and the Cargo that goes with it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ToolChain {
    cargo: PathBuf,
    rustc: PathBuf,
    linker: PathBuf,
}

impl ToolChain {
    /// The compiler of this workspace if it has the sources of the standard library, or else
    /// Debian's.
    ///
    /// # Errors
    /// Neither has them; the message says how to get them.
    pub fn find() -> Result<Self, String> {
        let own_rustc = PathBuf::from(std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()));
        let own_cargo = PathBuf::from(cargo_command(&[]).get_program());
        let own_root = sysroot(&own_rustc);
        let candidates =
            [(own_cargo, own_rustc), ("/usr/bin/cargo".into(), "/usr/bin/rustc".into())];
        for (cargo, rustc) in candidates {
            let Some(root) = sysroot(&rustc) else { continue };
            let has_sources = root.join("lib/rustlib/src/rust/library/std").is_dir();
            // Debian's has no linker; that of another compiler does as well.
            let linker = find_linker(&root).or_else(|| find_linker(own_root.as_deref()?));
            if let Some(linker) = linker.filter(|_| has_sources) {
                return Ok(Self { cargo, rustc, linker });
            }
        }
        Err(MISSING.to_owned())
    }

    /// Compiles the package `web`, whose folder is given; gives the path of the module.
    ///
    /// # Errors
    /// It does not compile.
    pub fn build_module(&self, package: &Path) -> Result<PathBuf, String> {
        let out = target_folder().join("web-build");
        let mut build = Command::new(&self.cargo);
        build.current_dir(package).args(["build", "--quiet", "--locked", "--package", "web"]);
        build.args(["--release", "--target", TARGET, "-Zbuild-std=std,panic_abort"]);
        build.arg("-Zbuild-std-features=optimize_for_size");
        build.env("RUSTC", &self.rustc).env("RUSTC_BOOTSTRAP", "1");
        build.env("CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER", &self.linker);
        build.env("CARGO_ENCODED_RUSTFLAGS", COMPILER_FLAGS.join("\u{1f}")).env_remove("RUSTFLAGS");
        capture_output(build.env("CARGO_TARGET_DIR", &out).env_remove("RUSTC_WRAPPER"))?;
        Ok(out.join(TARGET).join("release/web.wasm"))
    }
}

const MISSING: &str = "the sources of Rust's standard library are missing, which are compiled to \
    WebAssembly: run `rustup component add rust-src`, \
    or on Debian `apt-get install cargo-web rustc-web rust-web-src`";

/// The folder of a compiler, if it runs.
fn sysroot(rustc: &Path) -> Option<PathBuf> {
    let path = capture_output(Command::new(rustc).args(["--print", "sysroot"])).ok()?;
    Some(PathBuf::from(path.trim()))
}

/// The linker in the folder of a compiler.
fn find_linker(root: &Path) -> Option<PathBuf> {
    let platforms = std::fs::read_dir(root.join("lib/rustlib")).ok()?;
    let name = format!("bin/rust-lld{}", std::env::consts::EXE_SUFFIX);
    platforms.filter_map(|entry| Some(entry.ok()?.path().join(&name))).find(|path| path.is_file())
}
