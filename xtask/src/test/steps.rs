//! The test steps, in the order in which they run.

use super::artifacts::TestPrograms;
use super::step::{Action, Step};
use super::{no_std, oldest_rust};
use crate::Outcome;
use crate::program::{cargo_command, compile, run_visibly};
use crate::tidy::NO_STD;

/// Returns all steps. The first tier has cheap checks, then one build, then everything that runs
/// the built programs. In the second tier, the steps that find the most problems per minute come
/// first, because CI may not reach the end.
pub fn all_steps() -> Result<Vec<Step>, String> {
    let mut steps = cheap_steps();
    steps.extend(build_steps());
    steps.extend(suite_steps());
    steps.extend(interface_steps());
    let second = [release_steps(), later_steps(), build_variant_steps()];
    steps.extend(second.into_iter().flatten().map(Step::second));
    Ok(steps)
}

fn cheap_steps() -> Vec<Step> {
    vec![
        Step::cargo(
            "fmt",
            "all code is formatted",
            &[
                "fmt --all --check",
                "fmt --manifest-path book/mdbook-alberti/Cargo.toml --check",
                "fmt --manifest-path tests/strangers/Cargo.toml --all --check",
            ],
        )
        .shared(),
        Step::built_in("tidy", "project rules that no lint covers", || crate::tidy::run_tidy(&[]))
            .shared(),
        Step::built_in(
            "models",
            "the committed scene models match the code that generates them",
            || crate::models::run_models(&["--check".into()]),
        )
        .shared(),
        Step::built_in("conformance", "every topic has a test, and the table lists it", || {
            crate::conformance::run_conformance(&["--check".into()])
        })
        .shared(),
        Step::built_in(
            "deny",
            "dependencies have the licenses, sources and versions that deny.toml allows",
            || crate::deny::run_deny(&[]),
        )
        .shared(),
    ]
}

fn build_steps() -> Vec<Step> {
    vec![
        Step::cargo(
            "clippy",
            "clippy reports no warnings, including in packages for other tools",
            &["clippy --quiet --workspace --all-targets -- -D warnings"],
        ),
        Step::built_in("no-std", "the math crates build without std", no_std::check_no_std)
            .shared(),
        Step::built_in("build", "programs and tests compile", || TestPrograms::build().map(drop)),
        Step::built_in("docs", "the documentation builds without warnings", build_documentation),
        Step::built_in(
            "api",
            "the public interfaces match docs/api, and the version allows their changes",
            || crate::api::run_api(&[]),
        )
        .shared(),
    ]
}

fn build_documentation() -> Outcome {
    let mut cargo = cargo_command(&["doc", "--quiet", "--workspace", "--no-deps"]);
    compile(|| run_visibly(cargo.env("RUSTDOCFLAGS", "-D warnings")))
}

/// Returns the suites of the first tier, the slowest first.
fn suite_steps() -> Vec<Step> {
    let suite = |name, about: &str| Step::new(name, about, Action::Suite(name)).shared();
    vec![
        Step::new("units", "unit and integration tests of the crates", Action::CrateTests).shared(),
        suite("hostile", "malicious files against the importer, with time and memory limits"),
        Step::cargo(
            "doctests",
            "the examples in the documentation run",
            &["test --quiet --workspace --doc -- --skip book_pages"],
        )
        .shared(),
        Step::new(
            "program",
            "the command line: flags, messages, exit codes, output files",
            Action::Program("", Some("book_formulas")),
        )
        .shared(),
        Step::new(
            "book_formulas",
            "the formulas in the book agree with the crates",
            Action::Program("book_formulas", None),
        )
        .shared(),
        suite(
            "drawing",
            "line drawings against the z-buffer: models and a tenth of the random scenes",
        ),
        suite(
            "corpus",
            "valid, unusual and broken glTF files are rendered or rejected with a reason",
        ),
        suite("looks", "pictures are not black, empty or unlit"),
        suite("references", "pictures against ray-traced references, with the glTF formulas"),
        suite("assemblies", "sheets of models with several parts: a tenth of the models"),
        suite("goldens", "every scene against its golden image, pixel by pixel"),
        suite("schemas", "every JSON document against its JSON Schema"),
        suite("check", "the diagnostics of `alberti check` against the Khronos validator's"),
        suite("vectors", "the stage crates against exact answers"),
        suite("meshes", "triangles and bounds of STL, OBJ, PLY and 3MF files against a manifest"),
    ]
}

/// Returns quick tests of the page and of Python, which need other tool chains.
fn interface_steps() -> Vec<Step> {
    vec![
        Step::built_in("page", "the explorer's page in a browser: the first lesson", || {
            crate::browser::run_browser(&["--first".into()])
        })
        .shared(),
        Step::built_in("python-first", "Python renders a picture, its depth and its ids", || {
            crate::python::run_python(&["--first".into()])
        })
        .shared(),
    ]
}

/// Returns the second-tier steps for other machines and for the release files.
fn release_steps() -> Vec<Step> {
    vec![
        Step::built_in(
            "determinism",
            "release and debug builds produce the same bytes, with any number of threads",
            || crate::determinism::run_determinism(&[]),
        ),
        Step::built_in(
            "package",
            "the Debian package works in an empty Debian system, and no file remains after removal",
            || crate::release::run_release(&["--deb".into()]),
        ),
        Step::built_in(
            "oldest-rust",
            "the math crates build with the oldest compiler that they declare",
            oldest_rust::check_oldest_rust,
        ),
        Step::built_in(
            "strangers",
            "programs of outside users build against the packed crates and run",
            || crate::strangers::run_strangers(&[]),
        ),
        Step::built_in("aarch64", "AArch64 in an emulator produces the same bytes", || {
            crate::determinism::run_determinism(&["--targets=aarch64".into()])
        }),
        Step::built_in(
            "web",
            "the explorer builds for browsers, and its files are within their size limits",
            || crate::web::run_web(&["--skip-without-tools".into()]),
        ),
        Step::built_in(
            "instructions",
            "fixed workloads take no more instructions than recorded",
            || crate::bench::run_bench(&["--instructions".into()]),
        ),
    ]
}

/// Returns the second-tier steps with full tests, many of which need other tool chains.
fn later_steps() -> Vec<Step> {
    let suite = |step, suite, about: &str| Step::new(step, about, Action::Suite(suite)).shared();
    vec![
        suite("growth", "growth", "twice the input takes about twice the instructions and memory"),
        suite("looks-all", "looks", "every model in every style, still and as a thumbnail"),
        Step::built_in(
            "browser",
            "the explorer's lessons work in a browser, with mouse and keyboard",
            || crate::browser::run_browser(&[]),
        )
        .shared(),
        Step::built_in(
            "python",
            "the wheel renders pictures in an empty environment, and its tests pass",
            || crate::python::run_python(&[]),
        )
        .shared(),
        Step::built_in(
            "dxf",
            "DXF files pass another program's audit",
            || crate::dxf::run_dxf(&[]),
        )
        .shared(),
        Step::built_in(
            "site",
            "the documentation pages build, the guides' commands work, and no link is broken",
            || crate::docs::run_docs(&[]),
        )
        .shared(),
        Step::built_in(
            "book",
            "the book's numbers are correct, no link is broken, and both editions are complete",
            || crate::book::run_book(&["--test".into()]),
        )
        .shared(),
        suite("cluster", "cluster", "`alberti batch` on a Slurm cluster with failing nodes"),
        suite("thumbnails", "thumbnails", "thumbnails of every format from a thumbnail service"),
        suite("drawing-all", "drawing", "line drawings: every random scene"),
        Step::new(
            "units-all",
            "unit and integration tests: every random case, and sheets of a thousand parts",
            Action::CrateTests,
        )
        .shared(),
        Step::new(
            "scenes-all",
            "scenes in RON and JSON: every random case",
            Action::Program("scene_data", None),
        )
        .shared(),
        suite("hostile-all", "hostile", "malicious files: each from a file and from memory"),
        suite("assemblies-all", "assemblies", "sheets of every model with several parts"),
    ]
}

/// Returns the second-tier steps for other kinds of builds.
fn build_variant_steps() -> Vec<Step> {
    let maths: String = NO_STD.iter().map(|name| format!(" --package alberti-{name}")).collect();
    vec![
        Step::cargo(
            "book-code",
            "the Rust code in the book runs",
            &["test --quiet --workspace --doc book_pages"],
        ),
        Step::built_in(
            "web-bytes",
            "WebAssembly renders the same pictures as the program",
            crate::determinism::compare_web_pictures,
        ),
        Step::built_in("outside", "packages outside the workspace compile", check_outside),
        Step::built_in(
            "crates",
            "every crate can be packed for the registry, with a complete manifest",
            || crate::release::run_release(&["--crates".into()]),
        ),
        Step::cargo(
            "maths",
            "unit tests and doctests of the math crates, built separately",
            &[&format!("test --quiet{maths}")],
        ),
    ]
}

/// Compiles all targets of the packages outside the workspace, which no other step compiles.
fn check_outside() -> Outcome {
    for manifest in ["tests/fuzz", "crates/web", "book/mdbook-alberti"] {
        let mut cargo = cargo_command(&["check", "--quiet", "--locked", "--all-targets"]);
        cargo.arg("--manifest-path").arg(format!("{manifest}/Cargo.toml"));
        cargo.env("CARGO_TARGET_DIR", crate::workspace::target_folder().join("outside"));
        compile(|| run_visibly(&mut cargo)).map_err(|error| format!("{manifest}: {error}"))?;
        println!("{manifest} compiles");
    }
    Ok(())
}
