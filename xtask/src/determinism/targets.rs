//! Compares the program's output between compiler targets.
//!
//! The program is compiled for each target and runs the same commands as this machine's release
//! build, in an emulator if the processor is different. It must write the same bytes.

use super::outputs::Outputs;
use super::target::{TARGETS, Target};
use super::web;
use super::workload::Workload;
use crate::Outcome;
use crate::program::{Build, Program};
use crate::skip::report_skip;
use crate::tool_chain::ToolChain;
use crate::workspace::target_folder;
use std::fs;
use std::path::Path;

/// The name of the explorer's module in the list of targets.
const WEB: &str = "wasm";

/// Compares the named targets, or all targets, with the release build. A target whose tool chain is
/// missing is reported as skipped.
///
/// # Errors
/// Fails if a name is unknown, a target does not compile, or a byte differs.
pub fn compare_targets(names: &[String]) -> Outcome {
    let is_known = |name: &str| name == WEB || TARGETS.iter().any(|target| target.name == name);
    if let Some(unknown) = names.iter().find(|name| !is_known(name)) {
        let known: Vec<&str> = TARGETS.iter().map(|target| target.name).collect();
        return Err(format!("unknown target `{unknown}`; use one of {}, {WEB}", known.join(", ")));
    }
    let is_chosen = |name: &str| names.is_empty() || names.iter().any(|other| other == name);
    let workload = Workload::load()?;
    let folder = target_folder().join("determinism/targets");
    let release = Program::build(Build::Release)?;
    println!("{} commands, compared with the release build:", workload.command_count());
    let native = workload.run_with(&[release.path().into()], &folder.join("release"))?;
    print_heading();
    print_row("release", &ToolChain::own()?.version()?, &native, std::env::consts::ARCH);
    let mut differences = Vec::new();
    for target in TARGETS.iter().filter(|target| is_chosen(target.name)) {
        match compare_target(target, &workload, &native, &folder) {
            Ok(found) => differences.extend(found),
            Err(Failure::Skipped(why)) => report_skip(&format!("target {}", target.name), &why),
            Err(Failure::Failed(why)) => return Err(format!("target {}: {why}", target.name)),
        }
    }
    if !differences.is_empty() {
        let list = differences.join("\n  ");
        return Err(format!("bytes differ (see target/determinism/targets)\n  {list}"));
    }
    if is_chosen(WEB) { web::compare_web(&release) } else { Ok(()) }
}

/// The reason why a target was not compared.
enum Failure {
    Skipped(String),
    Failed(String),
}

/// Compiles and runs one target. Returns the files that differ, by name.
fn compare_target(
    target: &Target,
    workload: &Workload,
    native: &Outputs,
    folder: &Path,
) -> Result<Vec<String>, Failure> {
    let tool_chain = target.find_tools().map_err(Failure::Skipped)?;
    let program = target.build_program(&tool_chain).map_err(Failure::Failed)?;
    let folder = folder.join(target.name);
    let run = workload.run_with(&target.command_line(&program), &folder);
    let outputs = run.map_err(Failure::Failed)?;
    let version = tool_chain.version().map_err(Failure::Failed)?;
    print_row(target.name, &version, &outputs, target.about);
    let differences = native.differences(&outputs);
    if differences.is_empty() {
        // The files are copies of the release build's output.
        let removed = fs::remove_dir_all(&folder);
        removed.map_err(|error| Failure::Failed(format!("{}: {error}", folder.display())))?;
    }
    Ok(differences.into_iter().map(|file| format!("{}: {file}", target.name)).collect())
}

fn print_heading() {
    println!(
        "  {:12} {:9} {:>6} {:>11}  {:16}  about",
        "target", "compiler", "files", "bytes", "SHA-256 of all"
    );
}

fn print_row(name: &str, version: &str, outputs: &Outputs, about: &str) {
    let digest = outputs.digest();
    let [files, bytes] = [outputs.file_count() as u64, outputs.byte_count()];
    println!("  {name:12} {version:9} {files:6} {bytes:11}  {:16}  {about}", &digest[..16]);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::workspace::{project_root, read_text};

    #[test]
    fn the_page_lists_every_target() {
        let page = read_text(&project_root().join("docs/determinism.md")).unwrap();
        for name in TARGETS.iter().map(|target| target.name).chain([WEB]) {
            assert!(page.contains(&format!("| `{name}` |")), "{name}");
        }
    }

    #[test]
    fn an_unknown_target_is_an_error_that_lists_the_targets() {
        let error = compare_targets(&["z80".to_owned()]).unwrap_err();
        assert!(error.contains("z80") && error.contains("aarch64") && error.contains(WEB));
    }
}
