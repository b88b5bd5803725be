//! Builds the package `web` into the two files that a browser loads, `web.js` and `web_bg.wasm`.

use super::tool_chain::WebToolChain;
use crate::program::{capture_output, cargo_command, run_command};
use crate::workspace::{create_folder, project_root, target_folder};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Builds the module into a folder.
///
/// # Errors
/// Fails if a tool is missing or fails.
pub fn build_module(out: &Path) -> Result<(), String> {
    let tool_chain = WebToolChain::find()?;
    let wasm_opt = install_wasm_opt()?;
    let package = project_root().join("crates/web");
    println!("compiling to WebAssembly, which takes minutes the first time");
    let compiled = tool_chain.build_module(&package)?;
    let module = out.join("web_bg.wasm");
    if is_current(&module, &compiled) {
        return Ok(());
    }
    write_bindings(&package, &compiled, out)?;
    let smaller = out.join("smaller.wasm");
    let mut optimize = Command::new("node");
    optimize.arg(wasm_opt).arg(&module).args(WASM_OPT_FLAGS).arg("-o").arg(&smaller);
    run_command(&mut optimize)?;
    fs::rename(&smaller, &module).map_err(|error| format!("{}: {error}", module.display()))
}

/// Returns whether the module is newer than the compiled package and this program.
fn is_current(module: &Path, compiled: &Path) -> bool {
    let time = |path: &Path| fs::metadata(path).and_then(|metadata| metadata.modified()).ok();
    let sources = [time(compiled), std::env::current_exe().ok().as_deref().and_then(time)];
    time(module).is_some_and(|made| sources.iter().all(|source| source.is_some_and(|at| at < made)))
}

/// Flags that optimize for size, because the compiler has already optimized the code that must be
/// fast.
const WASM_OPT_FLAGS: [&str; 1] = ["-Oz"];

/// Writes the JavaScript bindings of the module.
fn write_bindings(package: &Path, compiled: &Path, out: &Path) -> Result<(), String> {
    let mut bindgen = cargo_command(&["run", "--quiet", "--locked", "--package", "web-bindgen"]);
    bindgen.current_dir(package).env("CARGO_TARGET_DIR", target_folder().join("web-build"));
    run_command(bindgen.arg("--").args([compiled, out]))
}

/// Installs the pinned `wasm-opt` with npm if it is missing, and returns its path.
fn install_wasm_opt() -> Result<PathBuf, String> {
    let folder = target_folder().join("web-build/npm");
    create_folder(&folder)?;
    let mut is_current = true;
    for name in ["package.json", "package-lock.json"] {
        let pinned = fs::read(project_root().join("crates/web").join(name));
        let pinned = pinned.map_err(|error| format!("crates/web/{name}: {error}"))?;
        let copy = folder.join(name);
        is_current &= fs::read(&copy).is_ok_and(|known| known == pinned);
        fs::write(&copy, pinned).map_err(|error| format!("{}: {error}", copy.display()))?;
    }
    let program = folder.join("node_modules/binaryen/bin/wasm-opt");
    if !is_current || !program.is_file() {
        let mut npm = Command::new("npm");
        npm.current_dir(&folder).args(["ci", "--no-audit", "--no-fund", "--ignore-scripts"]);
        capture_output(&mut npm)
            .map_err(|error| format!("cannot install `wasm-opt` with Node's `npm`\n{error}"))?;
    }
    Ok(program)
}
