//! `cargo xtask release`: builds the release files reproducibly, so that anyone can build the same
//! bytes.
//!
//! ```text
//! release OUT               write everything for users to an empty folder
//! release --check           do a dry run: build everything twice, in two folders, and test it
//! release --deb [PROGRAM]   pack the release build or PROGRAM for Debian, and test the package
//! release --crates          pack the crates for the registry without building them
//! ```
//! Nothing is published; `RELEASING.md` explains how to publish. The command needs the Debian tools
//! `tar`, `gzip`, `dpkg-deb`, `sha256sum`, and, to test the package, `debootstrap`.

mod archives;
mod build;
mod contents;
pub mod crates;
mod debian;
mod sbom;
mod third_party;

use crate::Outcome;
use crate::metadata::Metadata;
use crate::program::{Build, Program, capture_output};
use crate::workspace::{create_folder, list_files, project_root, read_text, target_folder};
use build::Programs;
use std::fs;
use std::path::Path;
use std::process::Command;

/// The maximum size of the program in a package, in bytes. The goal is 8,000,000. Link-time
/// optimization (`lto`) does not save enough, and pictures then take 70 % more instructions.
const MAX_PROGRAM_BYTES: u64 = 10_600_000;

/// Builds or checks the release files.
pub fn run_release(arguments: &[String]) -> Outcome {
    let here = std::env::current_dir().map_err(|error| error.to_string())?;
    match arguments {
        [flag] if flag == "--check" => check_release(),
        [flag] if flag == "--crates" => crates::package_crates(false),
        [flag] if flag == "--deb" => check_debian_package(&Program::build(Build::Release)?),
        [flag, program] if flag == "--deb" => {
            check_debian_package(&Program::at(&here.join(program)))
        }
        [folder] if !folder.starts_with('-') => {
            let out = here.join(folder);
            if out.read_dir().is_ok_and(|mut entries| entries.next().is_some()) {
                return Err(format!("{} is not empty", out.display()));
            }
            let folder = target_folder().join("release-build");
            write_release(&Release::read()?, project_root(), &folder, &out).map(drop)
        }
        _ => Err("use one of OUT, --check, --crates, --deb [PROGRAM]".to_owned()),
    }
}

/// The version and time of a release.
pub struct Release {
    /// The workspace version.
    pub version: String,
    /// The time in seconds since 1970: `SOURCE_DATE_EPOCH` or, if it is not set, the time of the
    /// last commit.
    pub epoch: String,
}

impl Release {
    fn read() -> Result<Self, String> {
        let metadata = Metadata::load()?;
        let program = metadata.package("alberti").ok_or("the package alberti is missing")?;
        let epoch = match std::env::var("SOURCE_DATE_EPOCH") {
            Ok(epoch) => epoch,
            Err(_) => {
                let mut git = Command::new("git");
                git.current_dir(project_root()).args(["log", "-1", "--format=%ct"]);
                capture_output(&mut git).map_err(|error| {
                    format!("{error}\n  = help: outside a checkout, set SOURCE_DATE_EPOCH")
                })?
            }
        };
        Ok(Self { version: program.version.clone(), epoch: epoch.trim().to_owned() })
    }
}

/// Builds the sources in a folder and writes all release files.
fn write_release(
    release: &Release,
    sources: &Path,
    target: &Path,
    out: &Path,
) -> Result<Programs, String> {
    create_folder(out)?;
    let programs = build::build_programs(sources, target)?;
    check_size(&programs.dynamic)?;
    let dependencies = third_party::shipped_dependencies()?;
    let notices = third_party::license_texts(&dependencies)?;
    let bill = sbom::bill_of_materials(release, &dependencies);
    let staging = target.join("staging");
    let files = contents::packaged_files(&programs.dynamic, &notices)?;
    archives::write_deb(release, &files, &staging.join("deb"), out)?;
    let files = contents::packaged_files(&programs.standalone, &notices)?;
    archives::write_tar(release, &files, &staging.join("tar"), out)?;
    write_file(&out.join(format!("alberti-{}.cdx.json", release.version)), bill.as_bytes())?;
    write_file(&out.join("THIRD-PARTY-LICENSES.txt"), notices.as_bytes())?;
    archives::write_checksums(out)?;
    println!("{}: {} files", out.display(), fs::read_dir(out).map_or(0, Iterator::count));
    Ok(programs)
}

/// Builds two releases from two copies of the sources, in folders with different names, and checks
/// that they are identical.
fn check_release() -> Outcome {
    crates::package_crates(true)?;
    let folder = target_folder().join("release-check");
    let _ = fs::remove_dir_all(&folder);
    let names = ["one", "the other folder"];
    // Copy the sources immediately, so that work can continue during the check.
    let release = Release::read()?;
    names.iter().try_for_each(|name| build::copy_sources(&folder.join(name).join("sources")))?;
    let mut builds = Vec::new();
    for name in names {
        let sources = folder.join(name).join("sources");
        let out = folder.join(name).join("out");
        let target = folder.join(name).join("target");
        let programs = write_release(&release, &sources, &target, &out)?;
        builds.push((read_text(&out.join(archives::CHECKSUMS))?, out, programs));
    }
    let [(first, out, programs), (second, ..)] = builds.as_slice() else { return Ok(()) };
    print!("{first}");
    if first != second {
        let folder = folder.display();
        return Err(format!("two builds differ (see {folder}):\n{first}and\n{second}"));
    }
    println!("two builds in different folders have the same bytes");
    let deb = list_files(out, "deb")?.pop().ok_or("the Debian package is missing")?;
    debian::try_package(&deb, &Program::at(&programs.dynamic))
}

/// Packs a program for Debian and tests the package.
fn check_debian_package(program: &Program) -> Outcome {
    let release = Release::read()?;
    let folder = target_folder().join("deb");
    create_folder(&folder)?;
    let notices = third_party::license_texts(&third_party::shipped_dependencies()?)?;
    let files = contents::packaged_files(program.path(), &notices)?;
    let deb = archives::write_deb(&release, &files, &folder.join("staging"), &folder)?;
    debian::try_package(&deb, program)
}

/// Checks that a program stays small.
fn check_size(program: &Path) -> Outcome {
    let bytes = fs::metadata(program).map_err(|error| error.to_string())?.len();
    println!("{} has {bytes} bytes", program.display());
    if bytes > MAX_PROGRAM_BYTES {
        return Err(format!(
            "the program has {bytes} bytes; at most {MAX_PROGRAM_BYTES} are allowed"
        ));
    }
    Ok(())
}

/// Writes a file. The error message names the file.
fn write_file(path: &Path, bytes: &[u8]) -> Outcome {
    fs::write(path, bytes).map_err(|error| format!("{}: {error}", path.display()))
}
