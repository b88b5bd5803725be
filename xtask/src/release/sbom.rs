//! The bill of materials: CycloneDX 1.5 as JSON, without times and random numbers.

use super::Release;
use super::third_party::Dependency;
use serde_json::{Value, json};

/// What the program is built with, for programs that look for known vulnerabilities.
pub fn bill_of_materials(release: &Release, dependencies: &[Dependency]) -> String {
    let (program, others): (Vec<&Dependency>, Vec<&Dependency>) =
        dependencies.iter().partition(|dependency| dependency.name == "alberti");
    let references: Vec<String> = others.iter().map(|other| package_url(other)).collect();
    let reference = format!("pkg:cargo/alberti@{}", release.version);
    let document = json!({
        "bomFormat": "CycloneDX",
        "specVersion": "1.5",
        "version": 1,
        "metadata": { "component": {
            "type": "application",
            "bom-ref": reference,
            "name": "alberti",
            "version": release.version,
            "purl": reference,
            "licenses": program.first().map(|program| licenses(program)),
        }},
        "components": others.iter().map(|other| component(other)).collect::<Vec<_>>(),
        "dependencies": [{ "ref": reference, "dependsOn": references }],
    });
    format!("{document:#}\n")
}

fn component(dependency: &Dependency) -> Value {
    let mut component = json!({
        "type": "library",
        "bom-ref": package_url(dependency),
        "name": dependency.name,
        "version": dependency.version,
        "purl": package_url(dependency),
        "licenses": licenses(dependency),
    });
    if let Some(checksum) = &dependency.checksum {
        component["hashes"] = json!([{ "alg": "SHA-256", "content": checksum }]);
    }
    component
}

fn licenses(dependency: &Dependency) -> Value {
    json!([{ "expression": dependency.license }])
}

fn package_url(dependency: &Dependency) -> String {
    format!("pkg:cargo/{}@{}", dependency.name, dependency.version.replace('+', "%2B"))
}
