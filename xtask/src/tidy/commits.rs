//! Rule for commits: a large commit must explain why it was made.

use super::Violation;
use crate::program::capture_output;
use crate::workspace::project_root;
use std::process::Command;

/// The last commit to which the rule does not apply.
const SINCE: &str = "d734859d";

/// The minimum number of changed lines for which a commit needs a body.
const MIN_LARGE: u64 = 400;

/// Finds large commits without a body. If the history is missing, as in an archive, nothing is
/// checked.
pub fn large_commits_without_reason() -> Vec<Violation> {
    let mut log = Command::new("git");
    log.current_dir(project_root()).args(["log", "--no-merges", "--numstat"]);
    log.args(["--format=%x01%h%x02%s%x02%b%x02", &format!("{SINCE}..HEAD")]);
    let text = capture_output(&mut log).unwrap_or_default();
    text.split('\u{1}').filter_map(violation_of).collect()
}

/// Returns the violation in a log entry, which has the hash, the subject and the body, then a line
/// for each file.
fn violation_of(entry: &str) -> Option<Violation> {
    let mut parts = entry.splitn(4, '\u{2}');
    let (hash, subject, body) = (parts.next()?, parts.next()?, parts.next()?);
    let lines: u64 = parts.next()?.lines().map(changed_lines).sum();
    if lines < MIN_LARGE || !body.trim().is_empty() {
        return None;
    }
    let message = format!("changes {lines} lines without a body: explain why (\"{subject}\")");
    Some(Violation::new(format!("commit {hash}"), message))
}

/// Returns the number of lines added and removed in a file. Pictures, for which git prints `-`,
/// lock files and generated listings do not count, because nobody writes them by hand.
fn changed_lines(line: &str) -> u64 {
    let mut columns = line.split('\t');
    let counts = [columns.next(), columns.next()];
    let path = columns.next().unwrap_or_default();
    if path.ends_with(".lock") || path.starts_with("docs/api/") {
        return 0;
    }
    counts.iter().filter_map(|count| count.and_then(|count| count.parse::<u64>().ok())).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_large_commit_needs_a_body() {
        let entry = |body: &str, count: u64| {
            format!(
                "1a2b3c\u{2}Move it\u{2}{body}\u{2}\n\n{count}\t0\ta.rs\n9999\t0\tCargo.lock\n-\t-\ta.png\n"
            )
        };
        assert!(violation_of(&entry("", MIN_LARGE)).is_some());
        assert_eq!(violation_of(&entry("Because.", MIN_LARGE)), None);
        assert_eq!(violation_of(&entry("", MIN_LARGE - 1)), None);
    }
}
