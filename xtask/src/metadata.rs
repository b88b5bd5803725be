//! The packages of the workspace, from `cargo metadata`.

use crate::program::{capture_output, cargo_command};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

/// A package of the workspace.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Package {
    /// The name in its manifest.
    pub name: String,
    /// The version in its manifest.
    pub version: String,
    /// Its normal dependencies by name, without those for tests and build scripts.
    pub dependencies: Vec<String>,
    /// Its integration tests with their source files, sorted by name.
    pub tests: Vec<(String, PathBuf)>,
}

/// The packages of the workspace and everything they depend on.
#[derive(Clone, Debug)]
pub struct Metadata {
    /// The members of the workspace.
    pub packages: Vec<Package>,
    /// For each package id, its name and the ids of its normal dependencies, with the features of
    /// the whole workspace.
    resolved: BTreeMap<String, (String, Vec<String>)>,
}

impl Metadata {
    /// Runs `cargo metadata`.
    pub fn load() -> Result<Self, String> {
        let text = capture_output(&mut cargo_command(&["metadata", "--format-version", "1"]))?;
        let json =
            serde_json::from_str(&text).map_err(|error| format!("cargo metadata: {error}"))?;
        Ok(Self::from_json(&json))
    }

    fn from_json(json: &Value) -> Self {
        let members = as_list(&json["workspace_members"]);
        let all = as_list(&json["packages"]);
        let packages = all.iter().filter(|package| members.contains(&package["id"]));
        let name_by_id: BTreeMap<String, String> = all
            .iter()
            .map(|package| (as_text(&package["id"]), as_text(&package["name"])))
            .collect();
        let node = |node: &Value| {
            let id = as_text(&node["id"]);
            let dependencies = as_list(&node["deps"]).iter().filter(|dependency| {
                as_list(&dependency["dep_kinds"]).iter().any(|kind| kind["kind"].is_null())
            });
            let ids = dependencies.map(|dependency| as_text(&dependency["pkg"])).collect();
            (id.clone(), (name_by_id.get(&id).cloned().unwrap_or_default(), ids))
        };
        Self {
            packages: packages.map(Package::from_json).collect(),
            resolved: as_list(&json["resolve"]["nodes"]).iter().map(node).collect(),
        }
    }

    /// Returns a package of the workspace, given its name or its name in code.
    pub fn package(&self, name: &str) -> Option<&Package> {
        self.packages
            .iter()
            .find(|package| package.name == name || short_name(&package.name) == name)
    }

    /// Returns every direct and indirect dependency of a package, by name.
    pub fn transitive_dependencies(&self, name: &str) -> BTreeSet<&str> {
        let roots = self.resolved.iter().filter(|(_, (known, _))| short_name(known) == name);
        let mut pending: Vec<&String> = roots.flat_map(|(_, (_, ids))| ids).collect();
        let (mut visited, mut names) = (BTreeSet::new(), BTreeSet::new());
        while let Some(id) = pending.pop() {
            if let Some((name, ids)) = self.resolved.get(id).filter(|_| visited.insert(id)) {
                names.insert(name.as_str());
                pending.extend(ids);
            }
        }
        names
    }
}

impl Package {
    fn from_json(json: &Value) -> Self {
        let normal = as_list(&json["dependencies"]).iter().filter(|entry| entry["kind"].is_null());
        let targets = as_list(&json["targets"]).iter();
        let tests = targets.filter(|target| as_list(&target["kind"]).iter().any(|k| k == "test"));
        Self {
            name: as_text(&json["name"]),
            version: as_text(&json["version"]),
            dependencies: normal.map(|entry| as_text(&entry["name"])).collect(),
            tests: tests
                .map(|target| (as_text(&target["name"]), as_text(&target["src_path"]).into()))
                .collect(),
        }
    }
}

/// Returns the name of a package in code. Package names have a prefix, because the short names are
/// taken on the registry.
pub fn short_name(package: &str) -> &str {
    package.strip_prefix("alberti-").unwrap_or(package)
}

fn as_text(value: &Value) -> String {
    value.as_str().unwrap_or_default().to_owned()
}

fn as_list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn sample() -> Metadata {
        let dependency = |id: &str, kind: Value| json!({"pkg": id, "dep_kinds": [{"kind": kind}]});
        Metadata::from_json(&json!({
            "workspace_members": ["a"],
            "packages": [
                {"id": "a", "name": "alpha",
                    "dependencies": [{"name": "beta", "kind": null}, {"name": "delta", "kind": "dev"}],
                    "targets": [{"name": "laws", "kind": ["test"], "src_path": "tests/laws.rs"},
                        {"name": "alpha", "kind": ["lib"], "src_path": "src/lib.rs"}]},
                {"id": "b", "name": "beta"}, {"id": "c", "name": "gamma"}, {"id": "d", "name": "delta"},
            ],
            "resolve": {"nodes": [
                {"id": "a", "deps": [dependency("b", json!(null)), dependency("d", json!("dev"))]},
                {"id": "b", "deps": [dependency("c", json!(null)), dependency("b", json!(null))]},
                {"id": "c", "deps": []}, {"id": "d", "deps": []},
            ]},
        }))
    }

    #[test]
    fn workspace_packages_list_their_normal_dependencies_and_tests() {
        let metadata = sample();
        assert_eq!(metadata.packages.len(), 1);
        let alpha = metadata.package("alpha").unwrap();
        assert_eq!(alpha.dependencies, ["beta"]);
        assert_eq!(alpha.tests, [("laws".to_owned(), PathBuf::from("tests/laws.rs"))]);
    }

    #[test]
    fn dependencies_are_followed_through_all_packages() {
        let metadata = sample();
        let names: Vec<&str> = metadata.transitive_dependencies("alpha").into_iter().collect();
        assert_eq!(names, ["beta", "gamma"]);
    }
}
