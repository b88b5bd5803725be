//! `alberti render`: several inputs, name templates, standard input and output.

use crate::sandbox::Sandbox;

#[test]
fn a_template_names_the_files_of_several_inputs_and_views() {
    let sandbox = Sandbox::new("templates");
    for model in ["crate.glb", "lamp.glb"] {
        sandbox.copy_model(model);
    }
    std::fs::create_dir(sandbox.path_of("out")).expect("a folder");
    let small = ["--size", "16x12", "--samples", "1"];
    let render = |flags: &[&str]| {
        let run = sandbox.run(&[&["render", "crate.glb", "lamp.glb"], flags, &small[..]].concat());
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{flags:?}");
    };
    render(&[]);
    render(&["--views", "front,iso", "-o", "out/{index:03}_{stem}_{view}_{frame}_{{x}}.png"]);
    render(&["--views", "top,left"]);
    for name in ["crate.png", "lamp.png", "crate_top.png", "crate_left.png", "lamp_top.png"] {
        assert!(
            sandbox.file_names().contains(&name.to_owned()),
            "{name}: {:?}",
            sandbox.file_names()
        );
    }
    for name in [
        "out/000_crate_front_0_{x}.png",
        "out/001_crate_isometric_1_{x}.png",
        "out/002_lamp_front_0_{x}.png",
        "out/003_lamp_isometric_1_{x}.png",
    ] {
        assert_eq!(sandbox.read_picture(name).0, 16, "{name}");
    }
    let front = [
        "render",
        "lamp.glb",
        "--view",
        "front",
        "-o",
        "one.png",
        "--size",
        "16x12",
        "--samples",
        "1",
    ];
    assert_eq!(sandbox.run(&front).code, 0);
    assert!(
        sandbox.read_picture("one.png") == sandbox.read_picture("out/002_lamp_front_0_{x}.png")
    );
}

#[test]
fn colliding_names_are_refused_before_anything_is_drawn() {
    let sandbox = Sandbox::new("collisions");
    sandbox.copy_model("crate.glb");
    sandbox.copy_model("lamp.glb");
    for (flags, words) in [
        (
            &["-o", "all.png"][..],
            "the pictures of crate.glb and lamp.glb would both be written to all.png",
        ),
        (&["--views", "front,top", "-o", "{stem}.png"], "would both be written to crate.png"),
        (&["-o", "-"], "cannot write 2 pictures to the standard output"),
        (&["-o", "{stm}.png"], "unknown field `{stm}`"),
        (
            &["-o", "{stem}.xyz"],
            "unsupported output format; use .png, .jpg, .webp, .svg, .pdf or .dxf",
        ),
        (&["-o", "{stem}.tiff"], "TIFF output is not supported"),
    ] {
        let run = sandbox.run(&[&["render", "crate.glb", "lamp.glb"], flags].concat());
        assert!(run.code == 1 && run.stderr.contains(words), "{flags:?}: {}", run.stderr);
        assert_eq!(sandbox.file_names(), ["crate.glb", "lamp.glb"], "{flags:?}");
    }
}

#[test]
fn one_bad_input_does_not_stop_the_others() {
    let sandbox = Sandbox::new("one_bad");
    sandbox.copy_model("crate.glb");
    sandbox.write_file("bad.glb", "nothing");
    let run = sandbox.run(&["render", "bad.glb", "crate.glb", "--size", "16x16"]);
    assert!(run.code == 1 && run.stderr.starts_with("error: bad.glb: "), "{}", run.stderr);
    assert_eq!(sandbox.file_names(), ["bad.glb", "crate.glb", "crate.png"]);
}

#[test]
fn models_are_read_from_standard_input_and_pictures_written_to_standard_output() {
    let sandbox = Sandbox::new("pipes");
    sandbox.copy_model("crate.glb");
    let model = std::fs::read(sandbox.path_of("crate.glb")).expect("the model");
    let small = ["--size", "24x18"];
    let file = sandbox.run(&[&["render", "crate.glb", "-o", "file.png"], &small[..]].concat());
    assert_eq!(file.code, 0);
    let expected = std::fs::read(sandbox.path_of("file.png")).expect("a picture");
    let piped = sandbox.run_with_input(&[&["render", "-", "-o", "-"], &small[..]].concat(), &model);
    assert!(piped == (0, expected), "a model is read and a picture is written");
    let scene = b"Scene(models: [(path: \"crate.glb\")], image: (size: (24, 18)))";
    sandbox.write_file("scene.ron", scene);
    assert_eq!(sandbox.run(&["render", "scene.ron"]).code, 0);
    let expected = std::fs::read(sandbox.path_of("scene.png")).expect("a picture");
    assert!(
        sandbox.run_with_input(&["render", "-", "-o", "-"], scene) == (0, expected),
        "a scene is read"
    );
    for (format, magic) in [("svg", &b"<svg"[..]), ("pdf", b"%PDF-"), ("dxf", b"0\nSECTION\n")] {
        let (code, bytes) =
            sandbox.run_with_input(&["render", "-", "-o", "-", "--format", format], &model);
        assert!(code == 0 && bytes.starts_with(magic), "{format}");
    }
    assert_eq!(sandbox.run_with_input(&[&["render", "-"], &small[..]].concat(), &model).0, 0);
    assert!(sandbox.file_names().contains(&"stdin.png".to_owned()));
    let run = sandbox.stderr_with_input(&["render", "-"], b"Scene(modles: [])");
    assert!(run.contains("--> <stdin>:1:7") && run.contains("did you mean `models`?"), "{run}");
    let run = sandbox.stderr_with_input(&["render", "-", "--max-file-bytes", "1k"], &model);
    assert!(run.contains("raise --max-file-bytes"), "{run}");
}

#[test]
fn a_picture_is_scaled() {
    let sandbox = Sandbox::new("scaled");
    sandbox.copy_model("crate.glb");
    sandbox
        .write_file("scene.ron", "Scene(models: [(path: \"crate.glb\")], image: (size: (30, 20)))");
    for (flags, size) in [
        (&["--scale", "2"][..], (60, 40)),
        (&["--scale", "0.5"], (15, 10)),
        (&["--size", "8x6", "--scale", "1.5"], (12, 9)),
    ] {
        let run = sandbox.run(&[&["render", "scene.ron", "-o", "out.png"], flags].concat());
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{flags:?}");
        let (width, height, _) = sandbox.read_picture("out.png");
        assert_eq!((width, height), size, "{flags:?}");
    }
}
