//! Writes packages. The same contents always produce the same bytes, regardless of time and user.

use super::contents::PackagedFile;
use super::{Release, write_file};
use crate::Outcome;
use crate::program::{capture_output, run_command};
use crate::workspace::create_folder;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The name of the checksum file.
pub const CHECKSUMS: &str = "SHA256SUMS";

/// Writes a Debian package with `dpkg-deb`.
pub fn write_deb(
    release: &Release,
    files: &[PackagedFile],
    staging: &Path,
    out: &Path,
) -> Result<PathBuf, String> {
    lay_out(files, &staging.join("usr"), staging)?;
    let machine = capture_output(Command::new("dpkg").arg("--print-architecture"))?;
    let machine = machine.trim();
    let program =
        files.iter().find(|file| file.is_executable).ok_or("the package contains no program")?;
    let bytes: usize = files.iter().map(|file| file.bytes.len()).sum();
    let control = format!(
        "Package: alberti\nVersion: {version}\nArchitecture: {machine}\n\
         Maintainer: {maintainer}\nSection: graphics\nPriority: optional\n\
         Installed-Size: {size}\nDepends: {depends}\n\
         Description: render, draw, validate and explain 3D models\n \
         Renders glTF, STL, OBJ, PLY and 3MF files and scenes on the CPU to pictures\n \
         and exact line drawings, without a GPU or a display; the same input gives\n \
         the same bytes on every machine. Shows thumbnails in file managers.\n",
        version = release.version,
        maintainer = std::env::var("DEBIAN_MAINTAINER").unwrap_or("The Alberti developers".into()),
        size = bytes.div_ceil(1024),
        depends = dependencies(&program.bytes),
    );
    create_folder(&staging.join("DEBIAN"))?;
    write_file(&staging.join("DEBIAN/control"), control.as_bytes())?;
    run_command(Command::new("chmod").args(["-R", "u=rwX,go=rX"]).arg(staging))?;
    let deb = out.join(format!("alberti_{}_{machine}.deb", release.version));
    let mut dpkg = Command::new("dpkg-deb");
    dpkg.args(["--root-owner-group", "-Zxz", "--threads-max=1", "--build"]);
    dpkg.arg(staging).arg(&deb).env("SOURCE_DATE_EPOCH", &release.epoch);
    run_command(&mut dpkg)?;
    Ok(deb)
}

/// Returns the Debian packages that a program needs: the C library, in the version that its symbols
/// require, and the unwinding library, if it is linked.
fn dependencies(program: &[u8]) -> String {
    let mentions = |text: &[u8]| program.windows(text.len()).any(|part| part == text);
    // glibc supports packed relocations from this version on.
    let relocations = mentions(b"GLIBC_ABI_DT_RELR\0").then_some(36);
    let symbols = (2..100).rev().find(|number| mentions(format!("GLIBC_2.{number}\0").as_bytes()));
    let libc = symbols.max(relocations).unwrap_or(36);
    let unwinding = if mentions(b"libgcc_s.so.1\0") { ", libgcc-s1" } else { "" };
    format!("libc6 (>= 2.{libc}){unwinding}")
}

/// Writes the download archive, a single folder that can be unpacked anywhere.
pub fn write_tar(release: &Release, files: &[PackagedFile], staging: &Path, out: &Path) -> Outcome {
    let name = format!("alberti-{}-{}-linux", release.version, std::env::consts::ARCH);
    lay_out(files, &staging.join(&name), staging)?;
    run_command(Command::new("chmod").args(["-R", "u=rwX,go=rX"]).arg(staging))?;
    let tar = out.join(format!("{name}.tar"));
    let mut command = Command::new("tar");
    command.args(["--sort=name", "--format=ustar", "--owner=0", "--group=0", "--numeric-owner"]);
    command.arg(format!("--mtime=@{}", release.epoch)).arg("-C").arg(staging);
    run_command(command.arg("-cf").arg(&tar).arg(&name))?;
    run_command(Command::new("gzip").args(["-n", "-9", "--force"]).arg(&tar))
}

/// Writes the checksums of all files in a folder, for use with `sha256sum --check`.
pub fn write_checksums(out: &Path) -> Outcome {
    let entries = fs::read_dir(out).map_err(|error| format!("{}: {error}", out.display()))?;
    let names: BTreeSet<_> = entries.filter_map(|entry| Some(entry.ok()?.file_name())).collect();
    let sums = capture_output(Command::new("sha256sum").args(&names).current_dir(out))?;
    write_file(&out.join(CHECKSUMS), sums.as_bytes())
}

/// Writes files below a prefix in an empty staging folder.
fn lay_out(files: &[PackagedFile], prefix: &Path, staging: &Path) -> Outcome {
    let _ = fs::remove_dir_all(staging);
    for file in files {
        let path = prefix.join(&file.path);
        create_folder(path.parent().unwrap_or(prefix))?;
        write_file(&path, &file.bytes)?;
        if file.is_executable {
            run_command(Command::new("chmod").arg("755").arg(&path))?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_depends_on_the_newest_symbols_that_it_uses() {
        let old = b"\0GLIBC_2.2.5\0GLIBC_2.34\0GLIBC_2.9\0";
        assert_eq!(dependencies(old), "libc6 (>= 2.34)");
        let new = b"\0libgcc_s.so.1\0GLIBC_2.17\0GLIBC_ABI_DT_RELR\0";
        assert_eq!(dependencies(new), "libc6 (>= 2.36), libgcc-s1");
    }
}
