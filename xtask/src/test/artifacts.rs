//! The test programs, built by a single Cargo call and then run directly.

use crate::Outcome;
use crate::program::{capture_output, cargo_command, compile, run_visibly};
use crate::workspace::{create_folder, target_folder};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The package of the cross-crate tests.
const TESTS: &str = "alberti-tests";

/// A test program that Cargo built.
struct TestProgram {
    /// The name of its package.
    package: String,
    /// The name of the target: the library or a test file.
    target: String,
    path: PathBuf,
    /// The folder of the package, in which tests run.
    folder: PathBuf,
}

/// All test programs, and the program `alberti` that they run.
pub struct TestPrograms {
    programs: Vec<TestProgram>,
    alberti: PathBuf,
}

impl TestPrograms {
    /// Builds everything that is not up to date.
    ///
    /// It always builds the whole workspace, because Cargo unifies features across the selected
    /// packages and would compile most crates again for any other selection.
    pub fn build() -> Result<Self, String> {
        let call = ["build", "--workspace", "--lib", "--bins", "--tests", "--examples"];
        let mut cargo = cargo_command(&call);
        cargo.args(["--quiet", "--message-format", "json-render-diagnostics"]);
        let messages = compile(|| capture_output(&mut cargo))?;
        let mut built = Self { programs: Vec::new(), alberti: PathBuf::new() };
        for line in messages.lines() {
            let Ok(message) = serde_json::from_str::<Value>(line) else { continue };
            built.add_artifact(&message);
        }
        if built.alberti.as_os_str().is_empty() {
            return Err("cargo did not build the program `alberti`".into());
        }
        Ok(built)
    }

    fn add_artifact(&mut self, message: &Value) {
        let Some(path) = message["executable"].as_str().map(PathBuf::from) else { return };
        let folder = Path::new(message["manifest_path"].as_str().unwrap_or_default());
        let folder = folder.parent().unwrap_or(folder).to_owned();
        let package = package_name(message["package_id"].as_str().unwrap_or_default());
        let target = message["target"]["name"].as_str().unwrap_or_default().to_owned();
        if message["profile"]["test"] == true {
            self.programs.push(TestProgram { package, target, path, folder });
        } else if target == "alberti" {
            self.alberti = path;
        }
    }

    /// Runs the unit tests and the integration tests of all crates.
    pub fn run_crate_tests(&self, variables: &[(&str, &str)]) -> Outcome {
        let is_of_crate = |program: &&TestProgram| {
            program.package != TESTS || !matches!(program.target.as_str(), "suites" | "program")
        };
        // Run all of them, so that a failure in one crate does not hide a failure in another.
        let run = |program| self.run(program, &[], variables).err();
        let faults: Vec<String> =
            self.programs.iter().filter(is_of_crate).filter_map(run).collect();
        if faults.is_empty() { Ok(()) } else { Err(faults.join("\n")) }
    }

    /// Runs a suite in `tests/suites.rs`.
    pub fn run_suite(&self, name: &str, variables: &[(&str, &str)]) -> Outcome {
        self.run(self.find("suites")?, &[name], variables)
    }

    /// Runs the tests in `tests/program` whose names contain `part` and not `without`.
    pub fn run_program_tests(
        &self,
        part: &str,
        without: Option<&str>,
        variables: &[(&str, &str)],
    ) -> Outcome {
        let mut arguments = vec![part];
        arguments.extend(without.iter().flat_map(|without| ["--skip", *without]));
        self.run(self.find("program")?, &arguments, variables)
    }

    fn find(&self, target: &str) -> Result<&TestProgram, String> {
        let is_it = |program: &&TestProgram| program.package == TESTS && program.target == target;
        self.programs
            .iter()
            .find(is_it)
            .ok_or_else(|| format!("cargo did not build the tests `{target}`"))
    }

    fn run(&self, program: &TestProgram, words: &[&str], variables: &[(&str, &str)]) -> Outcome {
        println!("{} {}", program.package, program.target);
        create_folder(&target_folder().join("tmp"))?;
        let mut command = Command::new(&program.path);
        command.args(words).current_dir(&program.folder).env("ALBERTI", &self.alberti);
        if program.package == "xtask" {
            // xtask's own tests skip on purpose; those skips stay out of the log.
            command.env_remove("SKIP_LOG");
        }
        // Nobody needs the output of a thousand passing tests.
        if program.target != "suites" {
            command.arg("--quiet");
        }
        run_visibly(command.envs(named_folders()).envs(variables.iter().copied()))
    }
}

/// Returns the test data folders from environment variables, as absolute paths, because the tests
/// run in a different folder.
fn named_folders() -> Vec<(&'static str, PathBuf)> {
    let here = std::env::current_dir().unwrap_or_default();
    let named = |name| Some((name, here.join(std::env::var_os(name)?)));
    ["VECTORS", "ASSETS", "REFERENCES"].into_iter().filter_map(named).collect()
}

/// Returns the name in a package id such as `path+file:///…/crates/clip#alberti-clip@0.1.0`. Cargo
/// omits the name if it is the same as the folder name.
fn package_name(id: &str) -> String {
    let (path, version) = id.rsplit_once('#').unwrap_or((id, ""));
    let folder = path.rsplit('/').next().unwrap_or_default();
    version.split_once('@').map_or(folder, |(name, _)| name).to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn package_names_are_parsed_from_ids() {
        assert_eq!(package_name("path+file:///a/crates/clip#alberti-clip@0.1.0"), "alberti-clip");
        assert_eq!(package_name("path+file:///a/xtask#0.1.0"), "xtask");
    }
}
