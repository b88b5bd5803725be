//! Tests `alberti animate`.

use crate::gltf_builder::GltfBuilder;
use crate::sandbox::Sandbox;
use serde_json::json;
use std::process::{Command, Stdio};

/// Writes a model with a red square that moves two units to the right within a second.
fn write_moving_model(sandbox: &Sandbox) {
    let mut document = GltfBuilder::square();
    let times = document.add_floats("SCALAR", &[0.0, 1.0]);
    document.json["accessors"][times]["min"] = json!([0.0]);
    document.json["accessors"][times]["max"] = json!([1.0]);
    let places = document.add_floats("VEC3", &[0.0, 0.0, 0.0, 2.0, 0.0, 0.0]);
    document.json["animations"] = json!([{
        "samplers": [{"input": times, "output": places}],
        "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}],
    }]);
    document.write_file(sandbox, "model");
}

/// Returns the center of all red pixels, as fractions of the width and height.
fn visible_center(sandbox: &Sandbox, name: &str) -> [f64; 2] {
    let (width, height, pixels) = sandbox.read_picture(name);
    let (mut sum, mut count) = ([0.0; 2], 0.0);
    for (at, pixel) in pixels.iter().enumerate().filter(|(_, pixel)| pixel[3] == 255) {
        let (x, y) = (at % width as usize, at / width as usize);
        sum = [sum[0] + x as f64 + 0.5, sum[1] + y as f64 + 0.5];
        count += 1.0;
        assert!(pixel[0] > 200 && pixel[1] < 50, "the square is red");
    }
    assert!(count > 0.0, "{name} is empty");
    [sum[0] / count / f64::from(width), sum[1] / count / f64::from(height)]
}

#[test]
fn an_animation_becomes_one_file_per_frame() {
    let sandbox = Sandbox::new("animate_files");
    write_moving_model(&sandbox);
    let run = sandbox.run(&[
        "animate",
        "model.gltf",
        "-o",
        "f_{frame:02}.png",
        "--fps",
        "4",
        "--size",
        "80x40",
        "--view",
        "front",
    ]);
    assert_eq!((run.code, run.stderr.as_str(), run.stdout.as_str()), (0, "", ""));
    let pictures = ["f_00.png", "f_01.png", "f_02.png", "f_03.png"];
    assert_eq!(sandbox.file_names(), [&pictures[..], &["model.bin", "model.gltf"]].concat());
    let places = pictures.map(|name| visible_center(&sandbox, name));
    let step = places[1][0] - places[0][0];
    for pair in places.windows(2) {
        assert!((pair[1][0] - pair[0][0] - step).abs() < 0.01 && step > 0.02, "{places:?}");
    }
    // The camera does not follow the square: the whole motion is in the picture, and centered.
    assert!(places[0][0] > 0.1 && places[3][0] < 0.9, "{places:?}");
}

#[test]
fn a_turntable_is_the_same_animated_png_with_any_number_of_threads() {
    let sandbox = Sandbox::new("animate_turntable");
    sandbox.copy_model("crate.glb");
    let turn = |name: &str, more: &[&str]| {
        let run =
            ["animate", "crate.glb", "-o", name, "--turntable", "--frames", "8", "--size", "48x48"];
        let run = sandbox.run(&[&run[..], more].concat());
        assert_eq!((run.code, run.stderr.as_str()), (0, ""));
        std::fs::read(sandbox.path_of(name)).expect("the animation")
    };
    let one = turn("one.png", &["--threads", "1"]);
    assert_eq!(one, turn("three.png", &["--threads", "3"]));
    let mut reader = png::Decoder::new(std::io::Cursor::new(&one)).read_info().expect("a PNG");
    let control = reader.info().animation_control().copied().expect("an animation");
    assert_eq!((control.num_frames, control.num_plays), (8, 0));
    let mut bytes = vec![0; reader.output_buffer_size().expect("a small picture")];
    let mut frames = Vec::new();
    for _ in 0..8 {
        reader.next_frame(&mut bytes).expect("a frame");
        assert_eq!(
            reader.info().frame_control().map(|frame| (frame.delay_num, frame.delay_den)),
            Some((1000, 30000))
        );
        frames.push(bytes.clone());
    }
    assert!(frames.windows(2).all(|pair| pair[0] != pair[1]), "consecutive frames must differ");
    let run =
        sandbox.run(&["animate", "crate.glb", "-o", "t.gif", "--frames", "4", "--size", "32x32"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let gif = std::fs::read(sandbox.path_of("t.gif")).expect("a film");
    assert!(gif.starts_with(b"GIF89a") && gif.ends_with(b";"));
    assert!(!sandbox.file_names().iter().any(|name| name.ends_with(".part")));
}

#[test]
fn raw_frames_can_be_piped() {
    let sandbox = Sandbox::new("animate_raw");
    sandbox.copy_model("crate.glb");
    let program = alberti_tests::program_path().expect("the program");
    let output = Command::new(program)
        .args(["animate", "crate.glb", "-o", "-", "--frames", "3", "--size", "20x10"])
        .current_dir(sandbox.path_of(""))
        .stderr(Stdio::inherit())
        .output()
        .expect("the program starts");
    assert!(output.status.success());
    assert_eq!(output.stdout.len(), 3 * 20 * 10 * 4);
}

#[test]
fn invalid_sequences_are_rejected() {
    let sandbox = Sandbox::new("animate_refused");
    sandbox.copy_model("crate.glb");
    let cases: [(&[&str], i32, &str); 4] = [
        (&["-o", "film.mp4"], 1, "film.mp4: video output is not supported"),
        (&["-o", "f_{frame:4}.png"], 1, "write {frame}, or {frame:04}"),
        (&["-o", "f.png", "--fps", "0"], 2, "from 0.1 to 1000"),
        (&["-o", "f.png", "--animation", "Walk"], 1, "`crate` has no animations"),
    ];
    for (arguments, code, reason) in cases {
        let run = sandbox.run(&[&["animate", "crate.glb"], arguments].concat());
        assert_eq!(run.code, code, "{arguments:?}");
        assert!(run.stderr.contains(reason), "{arguments:?}: {}", run.stderr);
        assert_eq!(sandbox.file_names(), ["crate.glb"]);
    }
}

/// With a camera path, `render --time` produces the same picture as the frame of `animate` at that
/// time.
#[test]
fn a_still_of_a_camera_path_matches_the_frame_at_its_time() {
    let sandbox = Sandbox::new("camera_path_still");
    sandbox.copy_model("crate.glb");
    sandbox.write_file(
        "scene.ron",
        "Scene(models: [(path: \"crate.glb\")], image: (size: (80, 60)), camera_path: (keys: [
            (time: 0, eye: (4, 3, 5), target: (0, 0.5, 0)),
            (time: 2, eye: (-4, 2, 6), target: (0, 0.5, 0), fov_y_degrees: 50),
        ]))",
    );
    let film = ["animate", "scene.ron", "-o", "f_{frame}.png", "--from", "1.5", "--to", "2"];
    let run = sandbox.run(&[&film[..], &["--frames", "1"]].concat());
    assert_eq!(run.code, 0, "{}", run.stderr);
    for (time, name) in [("1.5", "still.png"), ("0", "start.png")] {
        let run = sandbox.run(&["render", "scene.ron", "--time", time, "-o", name]);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{time}");
    }
    for (time, told) in [("9", "the camera path ends at 2 s"), ("-1", "begins at 0 s")] {
        let time = format!("--time={time}");
        let run = sandbox.run(&["render", "scene.ron", &time, "-o", "late.png"]);
        assert!(run.code == 0 && run.stderr.contains(told), "{time}: {}", run.stderr);
    }
    let bytes = |name: &str| std::fs::read(sandbox.path_of(name)).expect("a picture");
    assert_eq!(bytes("still.png"), bytes("f_0.png"));
    assert_ne!(bytes("still.png"), bytes("start.png"));
}
