//! Models that are empty, open or oddly named yield a correct sheet or a message.

use crate::sandbox::{RunResult, Sandbox};

/// The flags that draw every page of an assembly.
const ALL_PAGES: [&str; 4] = ["--parts-list=list.csv", "--balloons", "--exploded", "--part-sheets"];

/// Returns a cube as OBJ, which extends from `x` to `x + 1` and follows `first` vertices in the
/// file.
fn cube(x: i32, first: usize) -> String {
    let mut text = String::new();
    for corner in 0..8 {
        let [a, b, c] = [corner & 1, corner >> 1 & 1, corner >> 2 & 1];
        text += &format!("v {} {b} {c}\n", x + a);
    }
    for face in [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
    {
        text += &format!("f {}\n", face.map(|index| (index + first + 1).to_string()).join(" "));
    }
    text
}

/// Draws the sheet of an OBJ file with these flags, in every format.
fn draw_everywhere(name: &str, obj: &str, flags: &[&str]) -> (Sandbox, RunResult) {
    let sandbox = Sandbox::new(name);
    sandbox.write_file("model.obj", obj);
    let draw = |output: &str| sandbox.run(&[&["sheet", "model.obj", "-o", output], flags].concat());
    for output in ["out.pdf", "out.dxf"] {
        let run = draw(output);
        assert_eq!(run.code, 0, "{}", run.stderr);
    }
    let run = draw("out.svg");
    assert_eq!(run.code, 0, "{}", run.stderr);
    (sandbox, run)
}

#[test]
fn models_without_size_or_lines_are_reported() {
    let point = "v 1 2 3\n".repeat(3) + "f 1 2 3\n";
    for flags in [&[][..], &ALL_PAGES, &["--face-fill", "gray"], &["--face-fill", "flat"]] {
        let (_, run) = draw_everywhere("unusual_no_size", &point, flags);
        assert!(run.stderr.contains("the views are empty"), "{}", run.stderr);
    }
    // Lines count as parts, and points are drawn too.
    for (own, flags) in [("l 1 2 3\n", &ALL_PAGES[..]), ("p 1 2 3\n", &[])] {
        let obj = format!("v 0 0 0\nv 1 1 1\nv 1 0 0\n{own}");
        let (_, run) = draw_everywhere("unusual_lines", &obj, flags);
        assert_eq!(run.stderr, "", "{own}");
    }
}

#[test]
fn part_names_are_drawn_and_quoted_on_one_short_line() {
    let long = "\u{5d0}".repeat(10_000);
    let names = ["bolt\u{7}\u{1b}[31m", "\u{202e}evil", "\u{5d1}\u{5d5}", "\u{1f600}", &long, ""];
    let mut obj = String::new();
    for (index, name) in names.iter().enumerate() {
        obj += &format!("o {name}\n{}", cube(3 * index as i32, 8 * index));
    }
    let (sandbox, run) = draw_everywhere("unusual_names", &obj, &ALL_PAGES);
    for line in run.stderr.lines() {
        assert!(line.chars().count() < 300, "{line}");
        assert!(!line.chars().any(|c| c.is_control() || c == '\u{202e}'), "{line:?}");
    }
    assert!(run.stderr.contains("the drawing font lacks"), "{}", run.stderr);
    let list = std::fs::read_to_string(sandbox.path_of("list.csv")).expect("a list");
    assert!(list.contains(",evil,") && list.contains(",bolt [31m,"), "{list}");
}

#[test]
fn cuts_through_open_meshes_are_reported() {
    // A cube without its last face.
    let mut open = cube(0, 0);
    open.truncate(open.rfind("f ").expect("a face"));
    let flags = [&ALL_PAGES[..], &["--section", "z=0.5"]].concat();
    let (_, run) = draw_everywhere("unusual_open", &open, &flags);
    assert!(run.stderr.contains("is not closed"), "{}", run.stderr);
}

#[test]
fn nothing_is_written_if_nothing_fits() {
    let sandbox = Sandbox::new("unusual_large");
    sandbox.write_file("model.obj", "v 0 0 0\nv 1e9 1e9 1e9\nv 1e9 0 0\nf 1 2 3\n");
    let draw = ["sheet", "model.obj", "--paper", "a5", "-o", "out.svg"];
    let run = sandbox.run(&[&draw[..], &ALL_PAGES].concat());
    assert!(run.code == 1 && run.stderr.contains("they need 7.07e7 x 4.08e7 mm"), "{}", run.stderr);
    assert_eq!(sandbox.file_names(), ["model.obj"]);
}

#[test]
fn title_blocks_must_be_below_the_scene_or_an_allowed_folder() {
    let sandbox = Sandbox::new("unusual_title_block");
    std::fs::create_dir(sandbox.path_of("inner")).expect("a folder");
    sandbox.write_file("inner/model.obj", cube(0, 0));
    let block = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"100mm\" height=\"20mm\" \
                 viewBox=\"0 0 100 20\"><path d=\"M0 0H100V20H0Z\" fill=\"none\" \
                 stroke=\"#000\" stroke-width=\"0.5\"/></svg>";
    sandbox.write_file("block.svg", block);
    let scene = "Scene(\n    models: [(path: \"model.obj\")],\n    \
                 sheet: Sheet(title_block: \"../block.svg\"),\n)";
    sandbox.write_file("inner/scene.ron", scene);
    let draw = ["sheet", "inner/scene.ron", "-o", "out.svg"];
    let run = sandbox.run(&draw);
    assert!(run.code == 1 && run.stderr.contains("scene.ron:3:"), "{}", run.stderr);
    assert!(run.stderr.contains("--allow-outside"), "{}", run.stderr);
    let run = sandbox.run(&[&draw[..], &["--allow-outside", "."]].concat());
    assert_eq!(run.code, 0, "{}", run.stderr);
}

#[test]
fn models_too_small_to_be_seen_are_reported() {
    let shrunk = |line: &str| line.replace('1', if line.starts_with('v') { "1e-6" } else { "1" });
    let tiny: String = cube(0, 0).lines().map(|line| shrunk(line) + "\n").collect();
    for (obj, is_tiny) in [(tiny.as_str(), true), (&cube(0, 0), false)] {
        let (_, run) = draw_everywhere("unusual_tiny", obj, &["--unit", "mm"]);
        let told = run.stderr.contains("smaller than a millimeter");
        assert_eq!(told, is_tiny, "{}", run.stderr);
    }
}
