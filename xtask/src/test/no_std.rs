//! Checks `no_std` in the math crates by building each crate separately.
//!
//! `cargo xtask tidy` requires the attribute `#![no_std]`. This step lists the crates and features
//! of each build without dev-dependencies, none of which may bring the standard library back.

use crate::Outcome;
use crate::program::{capture_output, cargo_command, run_command};
use crate::tidy::NO_STD;

/// The allowed dependencies. Procedural macros do not count, because they run in the compiler.
const ALLOWED_DEPENDENCIES: &[&str] = &["alberti-homog", "glam", "libm", "thiserror"];

/// Builds each crate and inspects its dependency tree.
pub fn check_no_std() -> Outcome {
    for name in NO_STD {
        let package = format!("alberti-{name}");
        run_command(&mut cargo_command(&["check", "--quiet", "--package", &package]))?;
        let mut tree =
            cargo_command(&["tree", "--edges", "normal,no-proc-macro", "--prefix", "none"]);
        let tree = capture_output(tree.args(["--format", "{p}|{f}", "--package", &package]))?;
        if let Some(fault) = tree.lines().find_map(|line| dependency_fault(&package, line)) {
            return Err(format!("{name} uses the standard library: {fault}"));
        }
        println!("{name} is built without std");
    }
    Ok(())
}

/// Returns the violation in a line of the tree, `crate version …|feature,feature`.
fn dependency_fault(name: &str, line: &str) -> Option<String> {
    let (package, features) = line.split_once('|')?;
    let package = package.split_whitespace().next()?;
    let is_promised = package.strip_prefix("alberti-").is_some_and(|name| NO_STD.contains(&name));
    if package != name && !is_promised && !ALLOWED_DEPENDENCIES.contains(&package) {
        return Some(format!("it depends on {package}"));
    }
    let std = features.trim_end_matches(" (*)").split(',').any(|feature| feature == "std");
    std.then(|| format!("the feature `std` of {package} is enabled"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_crates_and_std_features_are_violations() {
        assert_eq!(dependency_fault("alberti-clip", "alberti-clip v0.1.0 (somewhere)|"), None);
        assert_eq!(dependency_fault("clip", "glam v0.34.0|f64,libm (*)"), None);
        assert!(dependency_fault("clip", "alberti-camera v0.1.0|").is_none());
        assert!(dependency_fault("clip", "alberti-shade v0.1.0|").is_some());
        assert!(dependency_fault("clip", "thiserror v2.0.0|default,std (*)").is_some());
    }
}
