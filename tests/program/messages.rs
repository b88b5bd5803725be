//! Messages: usage, mistakes in scenes, and exit codes.

use crate::sandbox::Sandbox;

#[test]
fn help_and_version_are_complete() {
    let sandbox = Sandbox::new("help");
    let help = sandbox.run(&["--help"]);
    assert_eq!(help.code, 0);
    for word in ["render", "info", "check", "Examples:", "Exit codes:"] {
        assert!(help.stdout.contains(word), "{word}");
    }
    let version = sandbox.run(&["--version"]);
    assert_eq!(version.stdout.trim(), concat!("alberti ", env!("CARGO_PKG_VERSION")));
    let render = sandbox.run(&["render", "--help"]);
    for flag in ["--output", "--size", "--style", "--camera", "--view", "--background", "--samples"]
    {
        assert!(render.stdout.contains(flag), "{flag}");
    }
}

#[test]
fn wrong_usage_exits_with_code_2() {
    let sandbox = Sandbox::new("usage");
    let wrong: [&[&str]; 8] = [
        &[],
        &["rendr"],
        &["render"],
        &["render", "a.glb", "--size", "0x10"],
        &["render", "a.glb", "--size", "huge"],
        &["render", "a.glb", "--style", "cubist"],
        &["render", "a.glb", "--camera", "a", "--view", "front"],
        &["render", "a.glb", "--threads", "0"],
    ];
    for arguments in wrong {
        let run = sandbox.run(arguments);
        assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{arguments:?}");
        assert!(!run.stderr.is_empty(), "{arguments:?}");
    }
}

#[test]
fn a_mistake_in_a_scene_is_shown_at_its_location() {
    let sandbox = Sandbox::new("pointed");
    sandbox.copy_model("crate.glb");
    sandbox.write_file(
        "scene.ron",
        "Scene(\n    models: [(path: \"crate.glb\")],\n    camera: (view: LookAt(eye: (4, 3, 5), traget: (0, 0, 0))),\n)\n",
    );
    let run = sandbox.run(&["render", "scene.ron"]);
    assert_eq!(run.code, 1);
    let expected = "\
error: unexpected field `traget` in `LookAt`
 --> scene.ron:3:43
  |
3 |     camera: (view: LookAt(eye: (4, 3, 5), traget: (0, 0, 0))),
  |                                           ^^^^^^
  |
  = help: did you mean `target`?
";
    assert_eq!(run.stderr, expected);
}

#[test]
fn invalid_values_are_also_located() {
    let sandbox = Sandbox::new("senseless");
    sandbox.copy_model("crate.glb");
    let scene = |rest: &str| format!("Scene(\n  models: [(path: \"crate.glb\")],\n  {rest}\n)");
    for (rest, location, words) in [
        (
            "camera: (view: LookAt(eye: (0, 3, 0), target: (0, 0, 0)))",
            "3:18",
            "parallel to the gaze",
        ),
        ("camera: (view: LookTo(eye: (0, 3, 0), gaze: (0, 0, 0)))", "3:18", "gaze"),
        ("camera: (view: FromModel(Index(0)))", "3:18", "no camera"),
        ("camera: (view: Frame(padding_percent: 50))", "3:18", "padding"),
        ("camera: (projection: Perspective(near: 5, far: 2))", "3:24", "far"),
        ("lights: [Directional(direction: (0, 0, 0), intensity: 1)]", "3:35", "direction"),
        ("image: (samples: 3)", "3:20", "1, 4, 8 or 16"),
        ("image: (size: (0, 10))", "3:17", "0 x 10"),
        ("image: (size: (2000000, 10))", "3:17", "1048576"),
        ("image: (background: Color(\"mauve\"))", "3:29", "#rrggbb"),
    ] {
        sandbox.write_file("scene.ron", scene(rest));
        let run = sandbox.run(&["render", "scene.ron"]);
        assert_eq!(run.code, 1, "{rest}");
        let pointed = run.stderr.contains(&format!("--> scene.ron:{location}\n"));
        assert!(pointed && run.stderr.contains(words), "{rest}:\n{}", run.stderr);
    }
    for (model, words) in [
        ("no_such.glb", "no_such.glb"),
        ("/etc/hostname", "points outside the scene's folder"),
        ("../crate.glb", "points outside the scene's folder"),
        ("scene.ron", "scene.ron"),
    ] {
        sandbox.write_file("scene.ron", format!("Scene(models: [\n  (path: \"{model}\"),\n])"));
        let run = sandbox.run(&["render", "scene.ron"]);
        assert_eq!(run.code, 1, "{model}");
        let pointed = run.stderr.contains("--> scene.ron:2:10\n");
        assert!(pointed && run.stderr.contains(words), "{model}:\n{}", run.stderr);
    }
}

#[test]
fn a_missing_camera_is_reported_with_the_existing_cameras() {
    let sandbox = Sandbox::new("cameras");
    sandbox.copy_model("room.glb");
    let run = sandbox.run(&["render", "room.glb", "--camera", "nobody", "--size", "16x16"]);
    assert_eq!(run.code, 1);
    assert!(
        run.stderr.contains("nobody") && run.stderr.contains("the cameras are 0 `from the door`"),
        "{}",
        run.stderr
    );
}

/// While a large picture is drawn, the terminal shows the stage, the elapsed seconds and the
/// completed fraction. Afterward, they are erased.
#[cfg(target_os = "linux")]
#[test]
fn a_terminal_shows_the_progress_of_a_large_picture() {
    let sandbox = Sandbox::new("terminal_progress");
    sandbox.copy_model("crate.glb");
    let program = alberti_tests::program_path().expect("the program");
    let command = format!(
        "{} render crate.glb --size 3000x3000 --samples 1 --threads 1 -o a.png",
        program.display()
    );
    let mut script = std::process::Command::new("script");
    script.args(["-qec", &command, "/dev/null"]).current_dir(sandbox.path_of("."));
    let Ok(output) = script.stdin(std::process::Stdio::null()).output() else {
        alberti_tests::skip::report_skip("progress on a terminal", "script is not installed");
        return;
    };
    let shown = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{shown}");
    // Each line overwrites the previous one.
    let lines: Vec<&str> = shown.split("\r\u{1b}[K").collect();
    let percent = |line: &&str| line.strip_suffix(" %")?.rsplit(' ').next()?.parse::<u32>().ok();
    let done: Vec<u32> = lines.iter().filter_map(percent).collect();
    assert!(done.len() > 2 && done.is_sorted(), "{shown:?}");
    assert!(done.first() < done.last() && done.iter().all(|part| *part <= 100), "{shown:?}");
    assert!(lines.iter().any(|line| line.starts_with("rendering … ")), "{shown:?}");
    assert_eq!(lines.last().map(|line| line.trim()), Some(""), "{shown:?}");
}
