//! The library's examples, built and run.

use crate::sandbox::Sandbox;
use std::path::PathBuf;
use std::process::Command;

/// Runs an example of the crate `pipeline` in a test folder, and returns its output.
fn run_example(sandbox: &Sandbox, name: &str, arguments: &[&str]) -> String {
    let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    // With the features of the whole workspace, nothing is compiled twice.
    cargo.args(["build", "--quiet", "--workspace", "--example", name]);
    let test = std::env::current_exe().expect("this test");
    let folder = test.ancestors().nth(2).expect("the folder of the profile");
    cargo.arg("--target-dir").arg(folder.parent().expect("the target folder"));
    if folder.ends_with("release") {
        cargo.arg("--release");
    }
    let built = cargo.current_dir(alberti_tests::project_root()).status().expect("cargo starts");
    assert!(built.success(), "{name} does not build");
    let program: PathBuf =
        folder.join("examples").join(format!("{name}{}", std::env::consts::EXE_SUFFIX));
    let output = Command::new(program).args(arguments).current_dir(sandbox.path_of("")).output();
    let output = output.expect("the example starts");
    let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{name}: {stderr}");
    String::from_utf8(output.stdout).expect("UTF-8")
}

#[test]
fn the_examples_match_the_program() {
    let sandbox = Sandbox::new("examples");
    sandbox.copy_model("crate.glb");
    let program = |flags: &[&str]| {
        let stderr = sandbox.run(&[&["render", "crate.glb"], flags].concat());
        assert_eq!((stderr.code, stderr.stderr.as_str()), (0, ""), "{flags:?}");
    };
    let stderr = run_example(&sandbox, "thumbnail", &["crate.glb", "thumb.png"]);
    program(&["--size", "256x256", "-o", "program.png"]);
    assert!(
        stderr.starts_with("65536 pixels")
            && sandbox.read_picture("thumb.png") == sandbox.read_picture("program.png")
    );
    run_example(&sandbox, "isometric", &["crate.glb", "drawing.svg"]);
    program(&["--projection", "isometric", "--style", "dashed", "-o", "program.svg"]);
    let read = |name: &str| std::fs::read_to_string(sandbox.path_of(name)).expect(name);
    assert_eq!(read("drawing.svg"), read("program.svg"));
    let stderr = run_example(&sandbox, "explain_pixel", &["crate.glb", "480", "360"]);
    let by_program = sandbox.run(&["explain", "crate.glb", "--pixel", "480,360"]).stdout;
    // The program's title also names the conventions.
    let below_title = |text: &str| text.split_once('\n').expect("lines").1.trim_end().to_owned();
    assert!(below_title(&stderr).starts_with(&below_title(&by_program)), "{stderr}");
    run_example(&sandbox, "depth_map", &["crate.glb", "own.npy"]);
    program(&["--passes", "depth", "--pass-format", "npy", "-o", "passed.png"]);
    let bytes = |name: &str| std::fs::read(sandbox.path_of(name)).expect(name);
    assert_eq!(bytes("own.npy"), bytes("passed.depth.npy"));
    std::fs::create_dir(sandbox.path_of("frames")).expect("a folder");
    run_example(&sandbox, "turntable", &["crate.glb", "frames"]);
    let animate = ["animate", "crate.glb", "--turntable", "--frames", "12", "--size", "320x240"];
    assert_eq!(sandbox.run(&[&animate[..], &["-o", "{frame:02}.png"]].concat()).code, 0);
    for frame in 0..12 {
        let [one, other] =
            ["frames/", ""].map(|folder| sandbox.read_picture(&format!("{folder}{frame:02}.png")));
        assert!(one == other, "frame {frame}");
    }
    run_example(&sandbox, "thousand_scenes", &["crate.glb", "scenes"]);
    for number in ["0000", "0999"] {
        let (scene, picture) = (format!("scenes/{number}.ron"), format!("scenes/{number}.png"));
        let run = sandbox.run(&["render", &scene, "--allow-outside", ".", "-o", "again.png"]);
        // The scene's model path is relative to the model's folder, so the scene is copied there.
        assert_eq!(run.code, 1, "{}", run.stderr);
        std::fs::copy(sandbox.path_of(&scene), sandbox.path_of("scene.ron")).expect(number);
        let run = sandbox.run(&["render", "scene.ron", "-o", "again.png"]);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""));
        assert!(sandbox.read_picture("again.png") == sandbox.read_picture(&picture), "{number}");
    }
}
