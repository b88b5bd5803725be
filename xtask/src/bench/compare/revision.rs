//! The program of another commit, built in a clone below the target folder and reused by later
//! runs.

use crate::program::{Program, capture_output, run_command};
use crate::workspace::{project_root, target_folder};
use std::path::{Path, PathBuf};
use std::process::Command;

/// A commit of this repository.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Commit {
    /// The revision as the user wrote it, such as `main~3`.
    pub revision: String,
    /// Its full hash.
    pub hash: String,
}

impl Commit {
    /// Looks up a revision: a branch, a tag, a hash or anything else that git understands.
    pub fn resolve(revision: &str) -> Result<Self, String> {
        let hash = capture_output(git(project_root()).args([
            "rev-parse",
            "--verify",
            "--end-of-options",
            &format!("{revision}^{{commit}}"),
        ]))
        .map_err(|error| format!("`{revision}` is not a commit of this repository: {error}"))?;
        Ok(Self { revision: revision.to_owned(), hash: hash.trim().to_owned() })
    }

    /// Returns the abbreviated hash, as git shows it.
    pub fn short(&self) -> &str {
        self.hash.get(..12).unwrap_or(&self.hash)
    }

    /// Builds the release program of the commit, or finds an existing build.
    ///
    /// The folder is a clone, not a git worktree: a target folder may be removed at any time, and a
    /// removed worktree would leave an entry in the repository.
    pub fn build_program(&self) -> Result<Program, String> {
        let folder = self.clone_folder();
        if !self.is_checked_out(&folder) {
            self.check_out(&folder)?;
        }
        Program::build_checkout(&folder)
            .map_err(|error| format!("cannot build the program of {}: {error}", self.short()))
    }

    fn clone_folder(&self) -> PathBuf {
        target_folder().join("bench").join(self.short())
    }

    fn is_checked_out(&self, folder: &Path) -> bool {
        // Without its own `.git`, git would use the enclosing repository.
        let head = || capture_output(git(folder).args(["rev-parse", "HEAD"]));
        folder.join(".git").exists()
            && folder.join("Cargo.toml").exists()
            && head().is_ok_and(|head| head.trim() == self.hash)
    }

    fn check_out(&self, folder: &Path) -> Result<(), String> {
        if folder.exists() {
            std::fs::remove_dir_all(folder)
                .map_err(|error| format!("{}: {error}", folder.display()))?;
        }
        let root = project_root();
        run_command(git(root).args(["clone", "--quiet", "--no-checkout"]).arg(root).arg(folder))?;
        run_command(git(folder).args(["checkout", "--quiet", "--detach", &self.hash]))
    }
}

/// Returns the current commit, followed by ` + changes` if the files differ from it.
pub fn current_commit() -> Result<String, String> {
    let hash = capture_output(git(project_root()).args(["rev-parse", "HEAD"]))?;
    let changed = ["status", "--porcelain", "--untracked-files=no"];
    let changed = !capture_output(git(project_root()).args(changed))?.trim().is_empty();
    Ok(format!("{}{}", hash.trim(), if changed { " + changes" } else { "" }))
}

fn git(folder: &Path) -> Command {
    let mut git = Command::new("git");
    git.arg("-C").arg(folder);
    git
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_name_the_unknown_revision() {
        for revision in ["no-such-branch", "--version", ""] {
            let error = Commit::resolve(revision).unwrap_err();
            assert!(error.starts_with(&format!("`{revision}` is not a commit")), "{error}");
        }
    }
}
