//! The tool chain that compiles Rust to WebAssembly: a compiler with the sources of the standard
//! library.
//!
//! They are compiled with the explorer. Panics without a message, which nobody would read since the
//! page starts another worker, and sorting in less code take a sixth off the module. The compiled
//! WebAssembly library that rustup has offers neither.

use crate::program::capture_output;
use crate::tool_chain::ToolChain;
use crate::workspace::target_folder;
use std::path::{Path, PathBuf};

/// The target of the compiler.
const TARGET: &str = "wasm32-unknown-unknown";

/// Vector instructions are those that every browser has had since 2023; relaxed ones would round
/// differently on each machine. A panic is a trap.
const COMPILER_FLAGS: [&str; 3] =
    ["-Ctarget-feature=+simd128", "-Zunstable-options", "-Cpanic=immediate-abort"];

/// A compiler for WebAssembly, and a linker.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct WebToolChain {
    compiler: ToolChain,
    linker: PathBuf,
}

impl WebToolChain {
    /// The compiler with the sources of the standard library.
    ///
    /// # Errors
    /// There is none, or no linker; the message says how to get them.
    pub fn find() -> Result<Self, String> {
        let compiler = ToolChain::with_sources()?;
        // Debian's has no linker; another compiler's works too.
        let own = || find_linker(&ToolChain::own().ok()?.root);
        let linker = find_linker(&compiler.root).or_else(own);
        let linker = linker.ok_or("there is no `rust-lld`, the linker that comes with rustup")?;
        Ok(Self { compiler, linker })
    }

    /// Compiles the package `web` in the given folder; returns the path of the module.
    ///
    /// # Errors
    /// It does not compile.
    pub fn build_module(&self, package: &Path) -> Result<PathBuf, String> {
        let out = target_folder().join("web-build");
        let flags = COMPILER_FLAGS.map(str::to_owned);
        let mut build = self.compiler.cargo_build(package, &flags, &out);
        build.args(["--package", "web", "--target", TARGET, "-Zbuild-std=std,panic_abort"]);
        build.arg("-Zbuild-std-features=optimize_for_size").env("RUSTC_BOOTSTRAP", "1");
        build.env("CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER", &self.linker);
        capture_output(&mut build)?;
        Ok(out.join(TARGET).join("release/web.wasm"))
    }
}

/// The linker in the folder of a compiler.
fn find_linker(root: &Path) -> Option<PathBuf> {
    let platforms = std::fs::read_dir(root.join("lib/rustlib")).ok()?;
    let name = format!("bin/rust-lld{}", std::env::consts::EXE_SUFFIX);
    platforms.filter_map(|entry| Some(entry.ok()?.path().join(&name))).find(|path| path.is_file())
}
