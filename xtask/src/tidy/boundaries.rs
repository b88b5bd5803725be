//! Crate boundaries: which crate may depend on which, and which source may name a crate.

use super::Violation;
use super::code::is_word_char;
use super::source::Source;
use crate::metadata::{Metadata, short_name};

/// Crates that only one part of the code may name, so that they can be replaced, each with the
/// paths of that part.
const NAMED_BY: &[(&str, &[&str])] = &[
    ("gltf", &["crates/gltf-import/src"]),
    ("ron", &["crates/scene-file/src"]),
    (
        "serde",
        &[
            "crates/scene-file/src",
            "crates/gltf-import/src/gltf/located_json.rs",
            "crates/batch/src",
            "crates/homog/src/interop/serde.rs",
        ],
    ),
    (
        "tiny_skia",
        &["crates/page/src/canvas", "crates/page/src/lib.rs", "crates/raster/examples/pixmap.rs"],
    ),
    ("clap", &["crates/alberti/src"]),
];

/// The crates from the bottom up. Each may depend on the listed crates or, without a list, on all
/// earlier crates. These are the arrows in the crate map.
///
/// No stage depends on another stage. `model` does not depend on scenes. `shade`, `drawing` and
/// `sheet` do not depend on the pipeline that uses them. `hidden-line` does not depend on pictures
/// or pages.
pub const LAYERS: &[(&str, Option<&[&str]>)] = &[
    ("homog", None),
    ("camera", Some(&["homog"])),
    ("projection", Some(&["homog"])),
    ("recognition", Some(&["homog", "projection"])),
    ("clip", Some(&["homog"])),
    ("viewport", Some(&["homog"])),
    ("raster", Some(&["homog", "clip", "viewport"])),
    ("arcs", Some(&[])),
    ("files", Some(&[])),
    ("picture", Some(&["files"])),
    ("page", Some(&["homog", "arcs", "picture"])),
    ("model", Some(&["homog", "raster", "files"])),
    ("gltf-import", Some(&["homog", "files", "model"])),
    ("import", Some(&["homog", "files", "model", "gltf-import"])),
    ("gltf-check", Some(&["model", "gltf-import", "import"])),
    (
        "hidden-line",
        Some(&[
            "homog",
            "camera",
            "projection",
            "clip",
            "viewport",
            "raster",
            "arcs",
            "files",
            "model",
        ]),
    ),
    ("shade", Some(&["homog", "camera", "raster", "picture", "model"])),
    ("drawing", None),
    ("sheet", None),
    ("scene-file", None),
    ("scene", None),
    ("pipeline", None),
    ("batch", None),
    ("explain", None),
    ("explorer", None),
    ("alberti", None),
];

/// The stages of the viewing pipeline.
const STAGES: &[&str] = &["homog", "camera", "projection", "clip", "viewport", "raster"];
/// The only third-party packages that all stages may depend on.
const STAGE_DEPENDENCIES: &[&str] = &["glam", "libm", "thiserror"];

/// Exceptions: vector instructions for the rasterizer, and the libraries whose types `homog`
/// converts if features enable it.
const EXTRA_DEPENDENCIES: &[(&str, &str)] =
    &[("raster", "fearless_simd"), ("homog", "mint"), ("homog", "nalgebra"), ("homog", "serde")];

/// Packages that a crate must not be built with, even indirectly: users of the library do not
/// compile the program's packages, and a program for line drawings compiles no image decoders.
const NEVER_BUILT_WITH: &[(&str, &[&str])] = &[
    ("hidden-line", &["png", "zune-jpeg", "draco-core", "gltf", "tiny-skia", "pdf-writer"]),
    ("pipeline", &["clap", "gif", "terminal_size"]),
];

/// The math crates, which promise to work without the standard library.
pub const NO_STD: &[&str] = &["homog", "camera", "projection", "recognition", "clip", "viewport"];

/// Finds crate names outside the part that may use them.
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

/// Returns whether a line of code contains a path that starts with `name`.
fn names_crate(line: &str, name: &str) -> bool {
    let path = format!("{name}::");
    line.match_indices(&path).any(|(at, _)| {
        let before = line[..at].chars().next_back();
        !before.is_some_and(|c| is_word_char(c) || c == ':')
    })
}

/// Checks that crates that promise to work without the standard library declare it.
pub fn no_std_where_promised(source: &Source) -> Vec<Violation> {
    let promised = NO_STD.iter().any(|name| source.path == format!("crates/{name}/src/lib.rs"));
    if !promised || source.code.iter().any(|line| line.trim() == "#![no_std]") {
        return Vec::new();
    }
    vec![Violation::new(&source.path, "this crate must be `#![no_std]`")]
}

/// Checks dependencies between workspace packages, and dependencies of the stages on other
/// packages.
pub fn dependencies() -> Result<Vec<Violation>, String> {
    Ok(dependency_violations(&Metadata::load()?))
}

fn dependency_violations(metadata: &Metadata) -> Vec<Violation> {
    let mut violations = Vec::new();
    for (at, (name, allowed)) in LAYERS.iter().enumerate() {
        let below: Vec<&str> = LAYERS[..at].iter().map(|(name, _)| *name).collect();
        let allowed = allowed.unwrap_or(&below);
        let manifest = format!("crates/{name}/Cargo.toml");
        let Some(package) = metadata.package(name) else {
            violations.push(Violation::new(manifest, "this package does not exist"));
            continue;
        };
        let is_stage = STAGES.contains(name);
        for dependency in &package.dependencies {
            let is_legal = if metadata.package(dependency).is_some() {
                allowed.contains(&short_name(dependency))
            } else {
                !is_stage
                    || STAGE_DEPENDENCIES.contains(&dependency.as_str())
                    || EXTRA_DEPENDENCIES.contains(&(name, dependency))
            };
            if !is_legal {
                let message = format!("`{name}` may not depend on `{dependency}`");
                violations.push(Violation::new(&manifest, message));
            }
        }
    }
    for (name, forbidden) in NEVER_BUILT_WITH {
        let built_with = metadata.transitive_dependencies(name);
        for dependency in forbidden.iter().filter(|dependency| built_with.contains(*dependency)) {
            let message = format!("`{name}` is built with `{dependency}`: see `cargo tree`");
            violations.push(Violation::new(format!("crates/{name}/Cargo.toml"), message));
        }
    }
    violations
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_importer_may_name_gltf() {
        let text =
            "//! A.\nuse gltf::Document;\n// gltf::x\nlet a = my_gltf::B; crate::gltf::c();\n";
        let places = |path: &str| {
            crate_boundaries(&Source::new(path, text))
                .into_iter()
                .map(|fault| fault.location)
                .collect::<Vec<_>>()
        };
        assert_eq!(places("crates/pipeline/src/render.rs"), ["crates/pipeline/src/render.rs:2"]);
        assert_eq!(places("crates/gltf-import/src/mesh.rs"), [""; 0]);
    }

    #[test]
    fn the_promise_of_no_std_is_checked() {
        let lib =
            |text: &str| no_std_where_promised(&Source::new("crates/clip/src/lib.rs", text)).len();
        assert_eq!((lib("//! A.\n#![no_std]\n"), lib("//! #![no_std]\n")), (0, 1));
    }
}
