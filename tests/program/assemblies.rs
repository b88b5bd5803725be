//! Assembly sheets as the program writes them: page files, parts lists, messages.

use crate::drawings::assert_succeeds;
use crate::sandbox::Sandbox;

/// Returns a sandbox with the bearing from `scenes`: a housing, a bush, a ring, a shaft and four
/// bolts.
fn bearing(name: &str) -> Sandbox {
    let sandbox = Sandbox::new(name);
    let model = alberti_tests::project_root().join("scenes/models/bearing.glb");
    sandbox.write_file("bearing.glb", std::fs::read(model).expect("the bearing"));
    sandbox
}

/// Returns the content of a file; bytes that are not UTF-8 are replaced.
fn read_text(sandbox: &Sandbox, name: &str) -> String {
    let bytes = std::fs::read(sandbox.path_of(name)).expect("a file");
    String::from_utf8_lossy(&bytes).into_owned()
}

#[test]
fn pages_are_numbered_files_or_one_pdf() {
    let sandbox = bearing("assembly_pages");
    let explode = "--exploded";
    let flags = ["sheet", "bearing.glb", "--unit", "mm", "--balloons", explode, "--part-sheets"];
    assert_succeeds(&sandbox, &[&flags[..], &["-o", "out.svg"]].concat());
    // Views, balloons and five different parts.
    for page in 1..=7 {
        let text = read_text(&sandbox, &format!("out-{page}.svg"));
        assert_eq!(text.contains("id=\"balloons\""), page == 2, "{page}");
    }
    assert!(!sandbox.path_of("out.svg").exists() && !sandbox.path_of("out-8.svg").exists());
    assert_succeeds(&sandbox, &[&flags[..], &["-o", "{stem}_{page:02}.dxf"]].concat());
    assert!(sandbox.path_of("bearing_07.dxf").exists());
    assert_succeeds(&sandbox, &[&flags[..], &["-o", "out.pdf"]].concat());
    let pdf = read_text(&sandbox, "out.pdf");
    assert!(pdf.contains("/Count 7"), "the PDF does not have seven pages");
    // A single page keeps its name.
    assert_succeeds(&sandbox, &["sheet", "bearing.glb", "--unit", "mm", "-o", "one.svg"]);
    assert!(sandbox.path_of("one.svg").exists());
    let run = sandbox.run(&[&flags[..], &["-o", "{page}.pdf"]].concat());
    assert!(run.code == 1 && run.stderr.contains("a PDF holds all pages"), "{}", run.stderr);
}

#[test]
fn nothing_is_written_if_one_page_fails() {
    let sandbox = bearing("assembly_unwritten");
    let list = "--parts-list=missing/list.csv";
    let run = sandbox.run(&["sheet", "bearing.glb", "--balloons", list, "-o", "out.svg"]);
    assert!(run.code == 1 && run.stderr.contains("list.csv"), "{}", run.stderr);
    assert_eq!(sandbox.file_names(), ["bearing.glb"]);
}

#[test]
fn parts_lists_are_drawn_and_written() {
    let sandbox = bearing("assembly_list");
    sandbox.write_file(
        "scene.ron",
        "Scene(\n    models: [(path: \"bearing.glb\")],\n    sheet: Sheet(unit: Centimeter, densities: \
         [Density(of: \"steel\", density: 7.85), Density(of: \"shaft\", density: 8)]),\n)",
    );
    assert_succeeds(&sandbox, &["sheet", "scene.ron", "--parts-list=list.csv", "-o", "out.svg"]);
    let list = read_text(&sandbox, "list.csv");
    let rows: Vec<Vec<&str>> = list.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows[0], ["item", "quantity", "name", "material", "mass_grams"]);
    assert_eq!(rows.len(), 6);
    assert_eq!(rows[5][..4], ["5", "4", "bolt", "steel"]);
    // A twelve-sided prism, 4 mm across and 1.5 mm high.
    let mass = 3.0 * 0.2 * 0.2 * 0.15 * 7.85;
    let found: f64 = rows[5][4].parse().expect("a mass");
    assert!((found - mass).abs() < 0.001, "expected {mass}, found {found}");
    assert!(!rows[4][4].is_empty() && rows[1][4].is_empty(), "{rows:?}");
    assert!(read_text(&sandbox, "out-2.svg").contains("id=\"parts-list\""));
    let run = sandbox.run(&["sheet", "scene.ron", "--parts-list=list.txt"]);
    assert!(run.code == 2 && run.stderr.contains("ends in .csv or .json"), "{}", run.stderr);
    assert_succeeds(&sandbox, &["sheet", "scene.ron", "--parts-list=list.json", "-o", "out.svg"]);
    let json: serde_json::Value =
        serde_json::from_str(&read_text(&sandbox, "list.json")).expect("JSON");
    let bolt = &json["items"][4];
    assert_eq!((&bolt["quantity"], &bolt["name"]), (&4.into(), &"bolt".into()));
    assert_eq!(bolt["mass_grams"].as_f64(), rows[5][4].parse().ok());
    assert!(json["items"][0]["mass_grams"].is_null(), "{json}");
    let parts = bolt["parts"].as_array().expect("the positions of the bolts");
    let paths: Vec<String> = parts.iter().map(|part| part["path"].to_string()).collect();
    assert!(paths.len() == 4 && paths[0].ends_with("\"bolt 1\"]"), "{paths:?}");
    sandbox.write_file(
        "wrong.ron",
        "Scene(\n    models: [(path: \"bearing.glb\")],\n    sheet: Sheet(\n        \
         densities: [Density(of: \"stel\", density: 7.85)],\n    ),\n)",
    );
    let run = sandbox.run(&["sheet", "wrong.ron", "-o", "out.svg"]);
    assert!(run.code == 1 && run.stderr.contains("wrong.ron:4:"), "{}", run.stderr);
    assert!(run.stderr.contains("did you mean `steel`?"), "{}", run.stderr);
}

#[test]
fn exploded_views_have_paths() {
    let sandbox = bearing("assembly_exploded");
    for flag in ["--exploded", "--exploded=y", "--exploded=all"] {
        assert_succeeds(&sandbox, &["sheet", "bearing.glb", flag, "-o", "out.svg"]);
        let page = read_text(&sandbox, "out-2.svg");
        assert!(page.contains("id=\"path-visible-line\"") && !page.contains("id=\"balloons\""));
    }
    let run = sandbox.run(&["sheet", "bearing.glb", "--exploded=w", "-o", "out.svg"]);
    assert_eq!(run.code, 2, "{}", run.stderr);
}
