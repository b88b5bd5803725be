//! Which part may know which: the arrows of the code map, as rules.

use super::Violation;
use super::code::is_word_char;
use super::source::Source;
use crate::workspace::{project_root, read_text};

/// Crates that only one part may name, so that they can be exchanged, and the paths that part
/// begins with.
const NAMED_BY: &[(&str, &[&str])] = &[
    ("gltf", &["crates/model/src/import"]),
    ("ron", &["crates/pipeline/src/scene"]),
    ("serde", &["crates/pipeline/src/scene"]),
    ("tiny_skia", &["crates/drawing/src/canvas", "crates/raster/examples/pixmap.rs"]),
    ("clap", &["crates/alberti/src"]),
];

/// The stages: no stage knows another, and all that a stage may depend on.
const STAGES: &[&str] = &["homog", "camera", "projection", "clip", "viewport", "raster"];
const STAGE_DEPENDENCIES: &[&str] = &["homog", "glam", "libm", "thiserror"];

/// What a stage may depend on besides: the vector instructions of the rasteriser.
const EXTRA_DEPENDENCIES: &[(&str, &str)] = &[("raster", "fearless_simd")];

/// The stages that promise to work without the standard library.
pub const NO_STD: &[&str] = &["homog", "camera", "projection", "clip", "viewport"];

pub fn crate_boundaries(source: &Source) -> Vec<Violation> {
    if !source.path.starts_with("crates/") {
        return Vec::new();
    }
    let forbidden =
        NAMED_BY.iter().filter(|(_, by)| !by.iter().any(|part| source.path.starts_with(part)));
    let lines = |name: &str, by: &[&str]| {
        let message = format!("only {} may name `{name}`", by.join(" and "));
        let naming = source.code.iter().enumerate().filter(|(_, line)| names_crate(line, name));
        naming
            .map(|(i, _)| Violation::new(source.line_text(i + 1), message.clone()))
            .collect::<Vec<_>>()
    };
    forbidden.flat_map(|(name, by)| lines(name, by)).collect()
}

/// Whether a line of code has `name` at the head of a path.
fn names_crate(line: &str, name: &str) -> bool {
    let path = format!("{name}::");
    line.match_indices(&path).any(|(at, _)| {
        let before = line[..at].chars().next_back();
        !before.is_some_and(|c| is_word_char(c) || c == ':')
    })
}

pub fn no_std_where_promised(source: &Source) -> Vec<Violation> {
    let promised = NO_STD.iter().any(|name| source.path == format!("crates/{name}/src/lib.rs"));
    if !promised || source.code.iter().any(|line| line.trim() == "#![no_std]") {
        return Vec::new();
    }
    vec![Violation::new(&source.path, "this crate promises `#![no_std]`")]
}

/// The dependencies of the stages' manifests.
pub fn dependencies() -> Result<Vec<Violation>, String> {
    let mut faults = Vec::new();
    for stage in STAGES {
        let manifest = read_text(&project_root().join("crates").join(stage).join("Cargo.toml"))?;
        faults.extend(stage_dependencies(stage, &manifest));
    }
    Ok(faults)
}

fn stage_dependencies(stage: &str, manifest: &str) -> Vec<Violation> {
    let strange = manifest_table(manifest, "[dependencies]").into_iter().filter(|name| {
        let own = stage == "homog" && name == "homog";
        let allowed = STAGE_DEPENDENCIES.contains(&name.as_str());
        own || !(allowed || EXTRA_DEPENDENCIES.contains(&(stage, name.as_str())))
    });
    let message = |name: String| format!("a stage may not depend on `{name}`");
    strange
        .map(|name| Violation::new(format!("crates/{stage}/Cargo.toml"), message(name)))
        .collect()
}

/// The keys of a table of a manifest, up to the next table.
fn manifest_table(manifest: &str, header: &str) -> Vec<String> {
    let lines = manifest.lines().map(str::trim).skip_while(|line| *line != header).skip(1);
    let entries = lines.take_while(|line| !line.starts_with('[')).filter(|line| line.contains('='));
    let key =
        |line: &str| line.chars().take_while(|c| is_word_char(*c) || *c == '-').collect::<String>();
    entries.filter(|line| !line.starts_with('#')).map(key).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gltf_is_named_by_the_importer_alone() {
        let text =
            "//! A.\nuse gltf::Document;\n// gltf::x\nlet a = my_gltf::B; crate::gltf::c();\n";
        let places = |path: &str| {
            crate_boundaries(&Source::new(path, text))
                .into_iter()
                .map(|fault| fault.location)
                .collect::<Vec<_>>()
        };
        assert_eq!(
            places("crates/pipeline/src/scene/file.rs"),
            ["crates/pipeline/src/scene/file.rs:2"]
        );
        assert_eq!(places("crates/model/src/import/mesh.rs"), [""; 0]);
    }

    #[test]
    fn stages_know_only_homog() {
        let manifest = r#"
[dependencies]
homog.workspace = true
# x = 1
clip = { path = "a" }

[dev-dependencies]
proptest = "1"
"#;
        let faults = stage_dependencies("camera", manifest);
        assert_eq!(faults.len(), 1);
        assert!(faults[0].message.contains("`clip`"));
        assert_eq!(stage_dependencies("homog", "[dependencies]\nhomog = \"1\"\n").len(), 1);
    }

    #[test]
    fn a_promise_of_no_std_is_kept() {
        let lib =
            |text: &str| no_std_where_promised(&Source::new("crates/clip/src/lib.rs", text)).len();
        assert_eq!((lib("//! A.\n#![no_std]\n"), lib("//! #![no_std]\n")), (0, 1));
    }
}
