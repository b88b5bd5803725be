//! The software bill of materials: CycloneDX 1.5 as JSON, without timestamps or random numbers.

use super::Release;
use super::third_party::Dependency;
use serde_json::{Value, json};

/// Lists the crates that the program is built from, for tools that look for known vulnerabilities.
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

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::PathBuf;

    #[test]
    fn the_bill_is_for_the_program_and_lists_the_rest_as_components() {
        let dependency = |name: &str, version: &str, checksum: Option<&str>| Dependency {
            name: name.into(),
            version: version.into(),
            license: "MIT".into(),
            checksum: checksum.map(str::to_owned),
            folder: PathBuf::new(),
        };
        let all = [dependency("alberti", "1.0.0", None), dependency("x", "2.0.0+3", Some("ab"))];
        let release = Release { version: "1.0.0".into(), epoch: "0".into() };
        let bill: Value = serde_json::from_str(&bill_of_materials(&release, &all)).unwrap();
        assert_eq!(bill["metadata"]["component"]["purl"], "pkg:cargo/alberti@1.0.0");
        assert_eq!(bill["components"].as_array().map(Vec::len), Some(1));
        let component = &bill["components"][0];
        assert_eq!(component["purl"], "pkg:cargo/x@2.0.0%2B3");
        assert_eq!(component["licenses"][0]["expression"], "MIT");
        assert_eq!(component["hashes"][0], json!({ "alg": "SHA-256", "content": "ab" }));
        assert_eq!(bill["dependencies"][0]["dependsOn"][0], component["bom-ref"]);
    }
}
