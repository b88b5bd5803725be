//! Checks that the math crates compile with their declared `rust-version`.
//!
//! Debian 12 has that compiler in addition to a newer one. The compiler is unpacked into the target
//! folder, not installed.

use crate::Outcome;
use crate::program::{capture_output, cargo_command, run_command};
use crate::skip::report_skip;
use crate::tidy::NO_STD;
use crate::workspace::{create_folder, list_files, target_folder};
use std::path::{Path, PathBuf};
use std::process::Command;

/// The compiler version in the manifests, without the patch number.
const VERSION: &str = "1.85";

/// Checks each math crate with the oldest compiler.
pub fn check_oldest_rust() -> Outcome {
    let compiler = match unpack_compiler() {
        Ok(compiler) => compiler,
        Err(reason) => {
            report_skip("oldest-rust", &format!("no Rust {VERSION}: {reason}"));
            return Ok(());
        }
    };
    for name in NO_STD {
        let manifest = format!("crates/{name}/Cargo.toml");
        let text = crate::workspace::read_text(&crate::workspace::project_root().join(&manifest))?;
        if !text.contains(&format!("\nrust-version = \"{VERSION}\"\n")) {
            return Err(format!("{manifest} must have the line rust-version = \"{VERSION}\""));
        }
        let package = format!("alberti-{name}");
        // The workspace as a whole needs a newer compiler.
        let mut cargo = cargo_command(&["check", "--quiet", "--ignore-rust-version", "--package"]);
        cargo.arg(&package).env("RUSTC", &compiler);
        run_command(cargo.env("CARGO_TARGET_DIR", target_folder().join("oldest-rust/target")))?;
        println!("{package} compiles with Rust {VERSION}");
    }
    Ok(())
}

/// Unpacks the compiler from Debian's packages and returns a script that runs it.
fn unpack_compiler() -> Result<PathBuf, String> {
    let folder = target_folder().join("oldest-rust");
    let script = folder.join("rustc");
    if script.exists() {
        return Ok(script);
    }
    let known = capture_output(Command::new("apt-cache").args(["madison", "rustc-web"]))?;
    let versions = known.lines().filter_map(|line| line.split('|').nth(1));
    let is_meant = |version: &&str| version.starts_with(&format!("{VERSION}."));
    let version = versions.map(str::trim).find(is_meant);
    let version = version.ok_or("apt-get does not have this package")?;
    let packages = folder.join("packages");
    create_folder(&packages)?;
    let of_version = |package: &str| format!("{package}={version}");
    let mut download = Command::new("apt-get");
    download.args(["download", "--quiet", "libllvm19", "libz3-4", "libstd-rust-web-1.85"]);
    download.args([of_version("rustc-web"), of_version("libstd-rust-web-dev")]);
    run_command(download.current_dir(&packages))?;
    let root = folder.join("root");
    for package in list_files(&packages, "deb")? {
        run_command(Command::new("dpkg").arg("-x").arg(&package).arg(&root))?;
    }
    write_script(&script, &root)?;
    Ok(script)
}

#[cfg(unix)]
fn write_script(script: &Path, root: &Path) -> Outcome {
    use std::os::unix::fs::PermissionsExt as _;

    let libraries = capture_output(Command::new("find").arg(root).args(["-name", "*.so*"]))?;
    let folder = |line: &str| Path::new(line).parent().map(|folder| folder.display().to_string());
    let mut folders: Vec<String> = libraries.lines().filter_map(folder).collect();
    folders.sort();
    folders.dedup();
    let usr = root.join("usr");
    let text = format!(
        "#!/bin/sh\nLD_LIBRARY_PATH='{}' exec '{}/bin/rustc' --sysroot '{}' \"$@\"\n",
        folders.join(":"),
        usr.display(),
        usr.display()
    );
    let failed = |error: std::io::Error| format!("{}: {error}", script.display());
    std::fs::write(script, text).map_err(failed)?;
    std::fs::set_permissions(script, std::fs::Permissions::from_mode(0o755)).map_err(failed)
}

#[cfg(not(unix))]
fn write_script(_: &Path, _: &Path) -> Outcome {
    Err("this is not Debian".to_owned())
}
