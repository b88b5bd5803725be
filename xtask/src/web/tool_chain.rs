//! The tool chain that compiles Rust to WebAssembly, with the sources of the standard library.
//!
//! The standard library is compiled together with the explorer, which makes the module a sixth
//! smaller. Sorting takes less code, and panics omit their messages, which nobody would see because
//! the page then starts another worker. The precompiled WebAssembly library from rustup offers
//! neither.

use crate::program::capture_output;
use crate::tool_chain::ToolChain;
use crate::workspace::target_folder;
use std::path::{Path, PathBuf};

/// The target triple of the compiler.
const TARGET: &str = "wasm32-unknown-unknown";

/// Every browser has supported these vector instructions since 2023. Relaxed vector instructions
/// would round differently on different machines. A panic is a trap.
const COMPILER_FLAGS: [&str; 3] =
    ["-Ctarget-feature=+simd128", "-Zunstable-options", "-Cpanic=immediate-abort"];

/// A compiler and a linker for WebAssembly.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct WebToolChain {
    compiler: ToolChain,
    linker: PathBuf,
}

impl WebToolChain {
    /// Finds a compiler with the sources of the standard library, and a linker.
    ///
    /// # Errors
    /// Fails if either is missing. The message explains how to install them.
    pub fn find() -> Result<Self, String> {
        let compiler = ToolChain::with_sources()?;
        // Debian's compiler comes without a linker, but a linker from another compiler works too.
        let own = || find_linker(&ToolChain::own().ok()?.root);
        let linker = find_linker(&compiler.root).or_else(own);
        let linker = linker.ok_or("`rust-lld` is missing, the linker that comes with rustup")?;
        Ok(Self { compiler, linker })
    }

    /// Compiles the package `web` in the given folder and returns the path of the module.
    ///
    /// # Errors
    /// Fails if it does not compile.
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

/// Returns the linker in the folder of a compiler, if there is one.
fn find_linker(root: &Path) -> Option<PathBuf> {
    let platforms = std::fs::read_dir(root.join("lib/rustlib")).ok()?;
    let name = format!("bin/rust-lld{}", std::env::consts::EXE_SUFFIX);
    platforms.filter_map(|entry| Some(entry.ok()?.path().join(&name))).find(|path| path.is_file())
}
