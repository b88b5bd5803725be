//! Files: the paths of pictures, and the files that a failed run leaves behind.

use crate::sandbox::Sandbox;

#[test]
fn by_default_the_picture_is_written_to_the_current_folder() {
    let sandbox = Sandbox::new("default_output");
    sandbox.copy_model("teapot.glb");
    let run = sandbox.run(&["render", "teapot.glb", "--size", "40x30"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    assert_eq!(sandbox.file_names(), ["teapot.glb", "teapot.png"]);
    assert_eq!(sandbox.read_picture("teapot.png").0, 40);
}

#[test]
fn a_failed_run_leaves_the_old_picture_and_nothing_else() {
    let sandbox = Sandbox::new("failed_run");
    sandbox.write_file("out.png", "the old picture");
    sandbox.write_file("broken.glb", "glTF but not really");
    sandbox.write_file("broken.ron", "Scene(models: [(path: \"missing.glb\")])");
    for input in ["broken.glb", "broken.ron", "missing.glb", "missing.ron", "."] {
        let run = sandbox.run(&["render", input, "-o", "out.png"]);
        assert_eq!(run.code, 1, "{input}");
        assert!(run.stderr.starts_with("error: "), "{input}: {}", run.stderr);
        assert_eq!(sandbox.file_names(), ["broken.glb", "broken.ron", "out.png"], "{input}");
        let old = std::fs::read_to_string(sandbox.path_of("out.png")).expect("the old picture");
        assert_eq!(old, "the old picture", "{input}");
    }
}

#[test]
fn misspelled_models_get_a_suggestion_and_folders_a_hint_about_batch() {
    let sandbox = Sandbox::new("misspelt_model");
    sandbox.copy_model("crate.glb");
    let run = sandbox.run(&["render", "crat.glb", "-o", "out.png"]);
    assert_eq!(run.code, 1);
    let expected =
        "error: crat.glb: the file does not exist\n  = help: did you mean `crate.glb`?\n";
    assert_eq!(run.stderr, expected);
    let run = sandbox.run(&["render", ".", "-o", "out.png"]);
    assert_eq!(run.code, 1);
    assert!(run.stderr.contains("alberti batch ."), "{}", run.stderr);
    assert_eq!(sandbox.file_names(), ["crate.glb"]);
}

#[test]
fn flag_values_are_case_insensitive() {
    let sandbox = Sandbox::new("capital_values");
    sandbox.copy_model("crate.glb");
    let sheet = |paper: &str, out: &str| {
        sandbox.run(&["sheet", "crate.glb", "--paper", paper, "-o", out]).code
    };
    assert_eq!((sheet("A4", "capital.svg"), sheet("a4", "small.svg")), (0, 0));
    let read = |name| std::fs::read(sandbox.path_of(name)).expect("the sheet");
    assert!(read("capital.svg") == read("small.svg"));
}

#[test]
fn unwritable_outputs_are_reported_by_name() {
    let sandbox = Sandbox::new("bad_output");
    sandbox.copy_model("crate.glb");
    let run = sandbox.run(&["render", "crate.glb", "-o", "no/such/folder/out.png"]);
    assert_eq!(run.code, 1);
    assert!(run.stderr.contains("no/such/folder/out.png"), "{}", run.stderr);
    assert!(
        run.stderr.contains("help: create the folder `no/such/folder` first"),
        "{}",
        run.stderr
    );
    let run = sandbox.run(&["render", "crate.glb", "-o", "out.tga"]);
    assert_eq!(run.code, 1);
    assert!(run.stderr.contains("out.tga") && run.stderr.contains(".png"), "{}", run.stderr);
    assert_eq!(sandbox.file_names(), ["crate.glb"]);
}

#[test]
fn a_scene_cannot_leave_its_folder_unless_allowed() {
    let sandbox = Sandbox::new("sandbox");
    sandbox.copy_model("crate.glb");
    std::fs::create_dir(sandbox.path_of("inner")).expect("a folder");
    sandbox.write_file("inner/scene.ron", "Scene(models: [(path: \"../crate.glb\")])");
    let run = sandbox.run(&["render", "inner/scene.ron", "--size", "16x16"]);
    assert_eq!(run.code, 1);
    assert!(run.stderr.contains("--allow-outside"), "{}", run.stderr);
    let run =
        sandbox.run(&["render", "inner/scene.ron", "--size", "16x16", "--allow-outside", "."]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
}
