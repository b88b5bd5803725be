//! Sheet options: paper, title blocks, resolution, and messages about the layout; PDF text as
//! another program extracts it.

use crate::drawings::{assert_near, assert_succeeds, read_drawing, write_box};
use crate::sandbox::Sandbox;
use alberti_tests::skip::report_skip;
use std::process::Command;

/// Writes a scene whose sheet shows a box of 100 × 50 × 30 mm and has these fields.
fn write_scene(sandbox: &Sandbox, name: &str, fields: &str) {
    let text = format!("Scene(models: [(path: \"box.gltf\")], sheet: Sheet({fields}))");
    sandbox.write_file(name, text);
}

#[test]
fn paper_size_follows_the_model_size() {
    let sandbox = Sandbox::new("sheet_paper");
    for (sides, flags, page) in [
        ([0.1, 0.05, 0.03], &[][..], [210.0, 297.0]),
        ([0.4, 0.15, 0.1], &[], [594.0, 420.0]),
        ([0.1, 0.15, 0.4], &["--orientation", "portrait"], [594.0, 841.0]),
        ([0.4, 0.15, 0.1], &["--scale", "1:5"], [210.0, 297.0]),
        ([40.0, 15.0, 10.0], &[], [594.0, 420.0]),
        ([7.43, 3.0, 2.0], &[], [297.0, 210.0]),
    ] {
        write_box(&sandbox, "box", sides);
        let arguments = ["sheet", "box.gltf", "--paper", "auto", "-o", "out.svg"];
        assert_succeeds(&sandbox, &[&arguments[..], flags].concat());
        assert_eq!(read_drawing(&sandbox, "out.svg").0, page, "{sides:?} {flags:?}");
    }
}

#[test]
fn the_scale_is_explained() {
    let sandbox = Sandbox::new("sheet_scale");
    write_box(&sandbox, "box", [0.1, 0.05, 0.03]);
    let explain = |flags: &[&str]| {
        let arguments = ["sheet", "box.gltf", "-o", "out.pdf", "--explain-scale"];
        let run = sandbox.run(&[&arguments[..], flags].concat());
        assert_eq!((run.code, run.stdout.as_str()), (0, ""), "{}", run.stderr);
        run.stderr
    };
    let told = explain(&["--paper", "a4"]);
    assert!(told.starts_with("the views fill ") && told.contains(" at 1:1; at 2:1, the"), "{told}");
    let told = explain(&["--scale", "1:2"]);
    assert!(told.ends_with(" at 1:2; this scale was requested\n"), "{told}");
}

#[test]
fn the_resolution_of_a_png_can_be_set() {
    let sandbox = Sandbox::new("sheet_dpi");
    write_box(&sandbox, "box", [0.1, 0.05, 0.03]);
    for (flags, size) in [(&[][..], (1240, 1754)), (&["--dpi", "50"], (413, 585))] {
        let arguments =
            ["sheet", "box.gltf", "--paper", "a4", "--orientation", "portrait", "-o", "out.png"];
        assert_succeeds(&sandbox, &[&arguments[..], flags].concat());
        let (width, height, _) = sandbox.read_picture("out.png");
        assert_eq!((width, height), size, "{flags:?}");
    }
    assert_eq!(sandbox.run(&["sheet", "box.gltf", "--dpi", "0"]).code, 2);
}

#[test]
fn pdf_text_is_found_by_another_reader() {
    let sandbox = Sandbox::new("sheet_text");
    write_box(&sandbox, "box", [0.1, 0.05, 0.03]);
    write_scene(
        &sandbox,
        "scene.ron",
        "paper: A4, orientation: Landscape, scale: (1, 1), title: \"Größe 轴承\", author: \"Zoë\", decimal_mark: Comma, \
         owner: \"Alberti\", language: Chinese",
    );
    let run = sandbox.run(&["sheet", "scene.ron", "-o", "out.pdf"]);
    // The drawing font lacks these characters, but the invisible text layer of the PDF has them.
    assert!(run.code == 0 && run.stderr.contains("the drawing font lacks 轴承"), "{}", run.stderr);
    let read = |flags: &[&str]| {
        let path = sandbox.path_of("out.pdf").display().to_string();
        let run = Command::new("pdftotext").args(flags).args([path.as_str(), "-"]).output();
        run.ok().map(|run| {
            assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
            assert_eq!(String::from_utf8_lossy(&run.stderr), "");
            String::from_utf8(run.stdout).expect("text")
        })
    };
    let Some(text) = read(&["-raw"]) else {
        return report_skip("PDF text", "pdftotext is not installed");
    };
    for word in ["Größe 轴承", "Zoë", "Alberti", "100", "50", "30", "单位名称", "1:1", "A4", "zh"]
    {
        assert!(text.contains(word), "{word}: {text}");
    }
    // Searchable words lie over their drawn letters: the title begins 1.5 mm from the block's
    // border.
    let boxes = read(&["-bbox"]).expect("a reader");
    let line = boxes.lines().find(|line| line.contains(">Größe<")).expect("the title");
    let attribute = |name: &str| {
        let (_, rest) = line.split_once(&format!("{name}=\"")).expect(name);
        rest.split('"').next().and_then(|text| text.parse::<f64>().ok()).expect("a number")
    };
    assert_near(attribute("xMin") * 25.4 / 72.0, 287.0 - 180.0 + 1.5);
    let upper = attribute("yMin") * 25.4 / 72.0;
    assert!((152.0 + 20.0..200.0 - 10.0).contains(&upper), "{upper}");
}

#[test]
fn a_custom_title_block_is_read_or_its_error_is_reported() {
    let sandbox = Sandbox::new("sheet_block");
    write_box(&sandbox, "box", [0.1, 0.05, 0.03]);
    write_scene(&sandbox, "scene.ron", "title: \"Box\", title_block: \"block.svg\"");
    let good = "<svg viewBox=\"0 0 90 20\"><rect width=\"90\" height=\"20\"/>\n\
                <text x=\"2\" y=\"8\">{title}, {scale}</text></svg>";
    sandbox.write_file("block.svg", good);
    assert_succeeds(&sandbox, &["sheet", "scene.ron", "-o", "out.svg"]);
    let (_, layers) = read_drawing(&sandbox, "out.svg");
    let block = layers.get("title-block").expect("a block");
    assert_eq!(block[0][..2], [[320.0, 267.0], [410.0, 267.0]]);
    for (svg, told) in [
        (
            good.replace("title}", "titel}"),
            "block.svg, line 2, column 1: there is no field `titel`",
        ),
        (
            good.replace("<rect", "<ellipse"),
            "block.svg, line 1, column 26: `ellipse` is not supported",
        ),
        ("\u{0}".to_owned(), "a title block must be an SVG file"),
    ] {
        sandbox.write_file("block.svg", svg);
        for command in
            [&["sheet", "scene.ron", "-o", "no.svg"][..], &["scene", "check", "scene.ron"]]
        {
            let run = sandbox.run(command);
            let message = run.stdout + &run.stderr;
            assert!(run.code == 1 && message.contains(told), "{command:?}: {message}");
            assert!(message.contains("scene.ron:1:"), "{message}");
        }
    }
    write_scene(&sandbox, "scene.ron", "title_block: \"../block.svg\"");
    let run = sandbox.run(&["sheet", "scene.ron", "-o", "no.svg"]);
    assert!(run.code == 1 && run.stderr.contains("points outside the scene's folder"));
    assert!(!sandbox.file_names().contains(&"no.svg".to_owned()));
}

#[test]
fn invalid_numbers_are_reported() {
    let sandbox = Sandbox::new("sheet_numbers");
    write_box(&sandbox, "box", [0.1, 0.05, 0.03]);
    for (fields, told) in [
        ("decimals: 7", "too many decimal places: 7; at most 6 are allowed"),
        ("sheet_number: (3, 2)", "invalid sheet number: 3 of 2"),
        ("sheet_number: (0, 2)", "invalid sheet number: 0 of 2"),
    ] {
        write_scene(&sandbox, "scene.ron", fields);
        let run = sandbox.run(&["scene", "check", "scene.ron"]);
        assert!(run.code == 1 && run.stdout.contains(told), "{fields}: {}", run.stdout);
    }
}

#[test]
fn checking_a_scene_warns_about_problems_with_the_sheet() {
    let sandbox = Sandbox::new("sheet_check");
    write_box(&sandbox, "box", [0.1, 0.05, 0.03]);
    let section = |normal: &str| format!("Section(normal: {normal}, point: (0.05, 0.02, 0.02))");
    let many: Vec<String> = (1..=12).map(|k| section(&format!("(1, {k}, 0)"))).collect();
    for (fields, code, told) in [
        (
            "author: \"a\u{202e}\u{5d0}\u{7}\")".to_owned(),
            "missing-glyph",
            "the drawing font lacks \\u{202e}\u{5d0}\\u{7} in",
        ),
        (
            format!("paper: A4, scale: (4, 3)), sections: [{}]", many.join(", ")),
            "sheet-view-missing",
            "there is no room for the section",
        ),
    ] {
        let text = format!("Scene(models: [(path: \"box.gltf\")], sheet: Sheet({fields})");
        sandbox.write_file("scene.ron", text);
        let checked = sandbox.run(&["scene", "check", "scene.ron"]);
        let drawn = sandbox.run(&["sheet", "scene.ron", "-o", "out.pdf"]);
        // The check finds errors in the model, too, but none in the scene. The sheet is still
        // drawn.
        assert!(checked.stdout.contains("scene.ron: no mistakes, "), "{}", checked.stdout);
        assert_eq!(drawn.code, 0, "{}", drawn.stderr);
        let head = format!("warning[{code}]: ");
        assert!(checked.stdout.contains(&head), "{code}: {}", checked.stdout);
        assert!(checked.stdout.contains(told) && drawn.stderr.contains(told), "{}", drawn.stderr);
    }
}

#[test]
fn the_title_block_path_in_an_included_file_is_relative_to_that_file() {
    let sandbox = Sandbox::new("sheet_included_block");
    write_box(&sandbox, "box", [0.1, 0.05, 0.03]);
    std::fs::create_dir(sandbox.path_of("lib")).expect("a folder");
    sandbox.write_file(
        "lib/block.svg",
        "<svg viewBox=\"0 0 90 20\"><rect width=\"90\" height=\"20\"/></svg>",
    );
    sandbox.write_file("lib/sheet.ron", "Scene(sheet: Sheet(title_block: \"block.svg\"))");
    let scene = "Scene(include: \"lib/sheet.ron\", models: [(path: \"box.gltf\")])";
    sandbox.write_file("scene.ron", scene);
    assert_succeeds(&sandbox, &["sheet", "scene.ron", "-o", "out.svg"]);
    let (_, layers) = read_drawing(&sandbox, "out.svg");
    let block = layers.get("title-block").expect("a block");
    assert_eq!(block[0][..2], [[320.0, 267.0], [410.0, 267.0]]);
}

#[test]
fn checking_a_scene_reads_title_blocks_only_where_allowed() {
    let sandbox = Sandbox::new("sheet_check_block");
    std::fs::create_dir(sandbox.path_of("inner")).expect("a folder");
    sandbox.copy_model("crate.glb");
    std::fs::rename(sandbox.path_of("crate.glb"), sandbox.path_of("inner/crate.glb"))
        .expect("a model");
    sandbox
        .write_file("block.svg", "<svg viewBox=\"0 0 90 20\"><text y=\"8\">{author}</text></svg>");
    let sheet = "Sheet(title_block: \"../block.svg\", author: \"\u{5d0}\")";
    let text = format!("Scene(models: [(path: \"crate.glb\")], sheet: {sheet})");
    sandbox.write_file("inner/scene.ron", text);
    let check = ["scene", "check", "inner/scene.ron"];
    let run = sandbox.run(&check);
    assert!(run.stdout.contains("points outside the scene's folder"), "{}", run.stdout);
    let run = sandbox.run(&[&check[..], &["--allow-outside", "."]].concat());
    assert!(run.stdout.contains("warning[missing-glyph]"), "{}", run.stdout);
}
