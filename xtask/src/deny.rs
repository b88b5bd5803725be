//! `cargo xtask deny`: checks the dependencies against `deny.toml` and the minimum compiler
//! version.
//!
//! It checks licenses, sources, duplicate versions and `rust-version` with `cargo metadata`, for
//! the workspace and the other shipped packages. `cargo deny` reads the same file and runs too if
//! it is installed. It is not required, because building it takes longer than running all tests.
//! Advisories are not checked, because they need the network.

mod license;
mod policy;

use crate::Outcome;
use crate::program::{capture_output, cargo_command, run_command};
use crate::skip::report_skip;
use crate::workspace::{project_root, read_text};
use license::is_satisfied;
use policy::Policy;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;

/// The manifests of the shipped packages.
const SHIPPED: [&str; 2] = ["Cargo.toml", "crates/web/Cargo.toml"];

/// The manifests of all packages in the project, which must all work with the same minimum compiler
/// version.
const MANIFESTS: [&str; 4] = [
    "Cargo.toml",
    "crates/web/Cargo.toml",
    "tests/fuzz/Cargo.toml",
    "book/mdbook-alberti/Cargo.toml",
];

/// Checks the dependencies.
pub fn run_deny(arguments: &[String]) -> Outcome {
    if let Some(argument) = arguments.first() {
        return Err(format!("unknown argument `{argument}`"));
    }
    let policy = Policy::parse(&read_text(&project_root().join("deny.toml"))?)?;
    let floor = workspace_floor()?;
    let mut faults = floors_of_packages(&floor)?;
    let mut count = 0;
    for manifest in SHIPPED {
        let call = ["metadata", "--format-version", "1", "--locked", "--manifest-path", manifest];
        match capture_output(&mut cargo_command(&call)) {
            Ok(text) => {
                let json: Value = serde_json::from_str(&text).map_err(|error| error.to_string())?;
                let found = Dependency::list(&json);
                count += found.len();
                faults.extend(
                    dependency_faults(&found, &policy, &floor)?
                        .into_iter()
                        .map(|fault| format!("{manifest}: {fault}")),
                );
            }
            // Packages that only this manifest needs may not have been fetched yet.
            Err(error) if manifest != "Cargo.toml" && is_offline(&error) => {
                report_skip(&format!("deny {manifest}"), "its dependencies cannot be fetched");
            }
            Err(error) => return Err(error),
        }
    }
    if faults.is_empty() {
        println!("{count} dependencies of {} packages comply with deny.toml", SHIPPED.len());
        print_compiler(&floor)?;
        return run_cargo_deny();
    }
    Err(format!("{} problems\n  {}", faults.len(), faults.join("\n  ")))
}

/// A package from outside this project.
#[derive(Clone, PartialEq, Eq, Debug)]
struct Dependency {
    name: String,
    version: String,
    license: String,
    source: String,
    /// The oldest compiler that the package supports, if it declares one.
    floor: Option<String>,
}

impl Dependency {
    fn list(metadata: &Value) -> Vec<Self> {
        let packages = metadata["packages"].as_array().into_iter().flatten();
        let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
        let dependency = |package: &Value| {
            Some(Self {
                name: text(&package["name"]),
                version: text(&package["version"]),
                license: text(&package["license"]),
                source: package["source"].as_str()?.to_owned(),
                floor: package["rust_version"].as_str().map(str::to_owned),
            })
        };
        packages.filter_map(dependency).collect()
    }
}

/// Lists everything in the dependencies that the policy does not allow.
fn dependency_faults(
    found: &[Dependency],
    policy: &Policy,
    floor: &str,
) -> Result<Vec<String>, String> {
    let (licenses, sources) =
        (policy.list("licenses.allow")?, policy.list("sources.allow-registry")?);
    let (banned, twice) = (policy.list("bans.deny")?, policy.list("bans.skip")?);
    let mut faults = Vec::new();
    let mut versions: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    for Dependency { name, version, license, source, floor: needed } in found {
        versions.entry(name).or_default().insert(version);
        let mut fault = |what: String| faults.push(format!("{name} {version}: {what}"));
        if !is_satisfied(license, licenses) {
            fault(format!("licenses.allow does not allow `{license}`"));
        }
        let registry = source.trim_start_matches("registry+").trim_start_matches("sparse+");
        if !sources.iter().any(|allowed| allowed == registry) {
            fault(format!("its source `{source}` is not in sources.allow-registry"));
        }
        if banned.contains(name) {
            fault("bans.deny lists it".to_owned());
        }
        if needed.as_deref().is_some_and(|needed| version_numbers(needed) > version_numbers(floor))
        {
            fault(format!(
                "it needs Rust {}, but the workspace supports {floor}",
                needed.as_deref().unwrap_or("")
            ));
        }
    }
    for (name, versions) in versions.iter().filter(|(_, versions)| versions.len() > 1) {
        if !twice.iter().any(|allowed| allowed == name) {
            let list = versions.iter().copied().collect::<Vec<_>>().join(" and ");
            faults.push(format!(
                "{name}: versions {list} are used together, but bans.skip does not list the package"
            ));
        }
    }
    Ok(faults)
}

/// Parses a version's three numbers.
fn version_numbers(version: &str) -> [u32; 3] {
    let mut numbers = version.split('.').map(|number| number.parse().unwrap_or(0));
    [(); 3].map(|()| numbers.next().unwrap_or(0))
}

/// Returns the oldest compiler version that the workspace supports.
fn workspace_floor() -> Result<String, String> {
    let manifest = read_text(&project_root().join("Cargo.toml"))?;
    rust_version(&manifest).ok_or_else(|| "Cargo.toml has no rust-version".into())
}

fn rust_version(manifest: &str) -> Option<String> {
    let line = manifest.lines().find_map(|line| line.strip_prefix("rust-version = \""))?;
    Some(line.split('"').next()?.to_owned())
}

/// Lists packages whose `rust-version` differs from the workspace's.
fn floors_of_packages(floor: &str) -> Result<Vec<String>, String> {
    let mut faults = Vec::new();
    for manifest in MANIFESTS {
        let found = rust_version(&read_text(&project_root().join(manifest))?);
        if found.as_deref() != Some(floor) {
            let found = found.unwrap_or_else(|| "none".into());
            faults.push(format!(
                "{manifest}: rust-version is {found}, but the workspace has {floor}"
            ));
        }
    }
    Ok(faults)
}

/// Reports whether the tests run with the oldest supported compiler. Only then is support for that
/// compiler tested.
fn print_compiler(floor: &str) -> Outcome {
    let compiler = std::env::var_os("RUSTC").unwrap_or("rustc".into());
    let text = capture_output(Command::new(compiler).arg("--version").current_dir(project_root()))?;
    let version = text.split_whitespace().nth(1).unwrap_or_default();
    let [[major, minor, _], [floor_major, floor_minor, _]] = [version, floor].map(version_numbers);
    if (major, minor) == (floor_major, floor_minor) {
        println!("these tests run with the oldest supported compiler, {version}");
    } else {
        report_skip(
            "deny rust-version",
            &format!(
                "these tests run with {version}, but the oldest supported compiler is {floor}"
            ),
        );
    }
    Ok(())
}

/// Returns whether Cargo failed because it could not reach a registry.
fn is_offline(error: &str) -> bool {
    ["download", "network", "offline", "resolve host"].iter().any(|word| error.contains(word))
}

/// Checks the policy with `cargo deny`, if it is installed.
fn run_cargo_deny() -> Outcome {
    if run_command(&mut cargo_command(&["deny", "--version"])).is_err() {
        println!("cargo-deny is not installed, so its checks are skipped");
        return Ok(());
    }
    run_command(&mut cargo_command(&["deny", "check", "licenses", "bans", "sources"]))
}

#[cfg(test)]
mod tests {
    use super::*;

    const POLICY: &str = "[licenses]\nallow = [\"MIT\"]\n[bans]\ndeny = [\"bad\"]\nskip = [\"syn\"]\n\
        [sources]\nallow-registry = [\"https://registry\"]\n";

    fn dependency(name: &str, version: &str) -> Dependency {
        Dependency {
            name: name.into(),
            version: version.into(),
            license: "MIT".into(),
            source: "registry+https://registry".into(),
            floor: Some("1.80".into()),
        }
    }

    #[test]
    fn each_part_of_the_policy_finds_its_violation() {
        let policy = Policy::parse(POLICY).unwrap();
        let good = dependency("a", "1.0.0");
        let faults = |found: &[Dependency]| dependency_faults(found, &policy, "1.95").unwrap();
        let twice = |name: &str| vec![dependency(name, "1.0.0"), dependency(name, "2.0.0")];
        assert_eq!(faults(std::slice::from_ref(&good)), Vec::<String>::new());
        assert_eq!(faults(&twice("syn")), Vec::<String>::new());
        let table = [
            (vec![Dependency { license: "GPL-3.0-only".into(), ..good.clone() }], "licenses.allow"),
            (vec![Dependency { license: String::new(), ..good.clone() }], "licenses.allow"),
            (vec![Dependency { source: "git+https://x".into(), ..good.clone() }], "sources"),
            (vec![Dependency { floor: Some("1.96".into()), ..good.clone() }], "1.96"),
            (vec![dependency("bad", "1.0.0")], "bans.deny"),
            (twice("a"), "bans.skip"),
        ];
        for (found, expected) in table {
            let faults = faults(&found);
            assert!(faults.len() == 1 && faults[0].contains(expected), "{expected}: {faults:?}");
        }
    }

    #[test]
    fn versions_are_compared_numerically() {
        assert!(version_numbers("1.100") > version_numbers("1.95"));
        assert!(version_numbers("1.95.1") > version_numbers("1.95"));
        assert_eq!(version_numbers("1.95.0"), version_numbers("1.95"));
    }
}
