//! Animated poses, compared with the formulas of glTF 2.0 (appendix C) and with the keyframes in
//! real files. `info --json` reports the pose in numbers.

use crate::gltf_builder::GltfBuilder;
use crate::sandbox::Sandbox;
use serde_json::{Value, json};

/// Returns the output of `info --json` for a file.
fn info_json(sandbox: &Sandbox, arguments: &[&str]) -> Value {
    let run = sandbox.run(&[&["info", "--json"][..], arguments].concat());
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{arguments:?}");
    serde_json::from_str(&run.stdout).expect("JSON")
}

fn json_numbers(value: &Value) -> Vec<f64> {
    let list = value.as_array().expect("a list of numbers");
    list.iter().map(|number| number.as_f64().expect("a number")).collect()
}

fn assert_near(actual: &Value, expected: &[f64], what: &str) {
    let found = json_numbers(actual);
    let near = found.len() == expected.len()
        && found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6);
    assert!(near, "{what}: {found:?} instead of {expected:?}");
}

/// Writes a square whose node moves and turns linearly and grows by a cubic spline. A second node
/// moves in steps, and the weights, the material, the light and the camera also change.
fn write_animated_model(sandbox: &Sandbox) {
    let mut document = GltfBuilder::square();
    let [zero_to_two, steps] =
        [[0.0, 2.0], [0.5, 1.0]].map(|times| document.add_floats("SCALAR", &times));
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let samplers = [
        (zero_to_two, "LINEAR", document.add_floats("VEC3", &[0.0, 0.0, 0.0, 4.0, 8.0, -2.0])),
        // From rest to a quarter turn about y.
        (
            zero_to_two,
            "LINEAR",
            document.add_floats("VEC4", &[0.0, 0.0, 0.0, 1.0, 0.0, half, 0.0, half]),
        ),
        // x² from 0 to 2, so that its slopes are 0 and 4; y and z stay 1.
        (
            zero_to_two,
            "CUBICSPLINE",
            document.add_floats(
                "VEC3",
                &[
                    9.0, 9.0, 9.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 4.0, 0.0, 0.0, 4.0, 1.0, 1.0, 9.0,
                    9.0, 9.0,
                ],
            ),
        ),
        (steps, "STEP", document.add_floats("VEC3", &[1.0, 0.0, 0.0, 2.0, 0.0, 0.0])),
        (zero_to_two, "LINEAR", document.add_floats("SCALAR", &[0.0, 1.0, 1.0, 0.5])),
        (
            zero_to_two,
            "LINEAR",
            document.add_floats("VEC4", &[1.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0]),
        ),
        (zero_to_two, "LINEAR", document.add_floats("SCALAR", &[100.0, 0.0])),
        (zero_to_two, "LINEAR", document.add_floats("SCALAR", &[0.5, 1.5])),
    ];
    let samplers: Vec<Value> = samplers.iter().map(|(input, interpolation, output)| {
        json!({"input": input, "interpolation": interpolation, "output": output})
    }).collect();
    let node = |node: usize, path: &str| json!({"node": node, "path": path});
    let pointer = |to: &str| json!({"path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": to}}});
    let targets = [
        node(0, "translation"),
        node(0, "rotation"),
        node(0, "scale"),
        node(1, "translation"),
        node(0, "weights"),
        pointer("/materials/0/pbrMetallicRoughness/baseColorFactor"),
        pointer("/extensions/KHR_lights_punctual/lights/0/intensity"),
        pointer("/cameras/0/perspective/yfov"),
    ];
    let channels: Vec<Value> = targets
        .iter()
        .enumerate()
        .map(|(sampler, target)| json!({"sampler": sampler, "target": target}))
        .collect();
    document.json["animations"] =
        json!([{"name": "all", "samplers": samplers, "channels": channels}]);
    add_camera_and_light(&mut document);
    document.write_file(sandbox, "moving");
}

/// Adds morph targets to the square, and a second node with a light and a camera.
fn add_camera_and_light(document: &mut GltfBuilder) {
    let morph = document.add_floats("VEC3", &[0.0; 12]);
    document.json["meshes"][0]["primitives"][0]["targets"] =
        json!([{"POSITION": morph}, {"POSITION": morph}]);
    document.json["extensionsUsed"] =
        json!(["KHR_animation_pointer", "KHR_lights_punctual", "KHR_materials_unlit"]);
    document.json["extensions"] = json!({"KHR_lights_punctual": {"lights": [{"type": "point"}]}});
    document.json["cameras"] =
        json!([{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}]);
    document.push_item(
        "/nodes",
        json!({"mesh": 0, "camera": 0, "extensions": {"KHR_lights_punctual": {"light": 0}}}),
    );
}

#[test]
fn poses_follow_the_specification() {
    let sandbox = Sandbox::new("poses");
    write_animated_model(&sandbox);
    // A cubic with these end values and slopes is x²; after a quarter of the time, the angle is a
    // quarter of a right angle.
    for (time, part, step) in [
        ("0.25", 0.125, 1.0),
        ("0.5", 0.25, 1.0),
        ("1.5", 0.75, 2.0),
        ("9", 1.0, 2.0),
        ("-1", 0.0, 1.0),
    ] {
        let info = info_json(&sandbox, &["moving.gltf", "--time", time]);
        let what = |of: &str| format!("{of} at {time}");
        let transform = &info["nodes"][0]["transform"];
        assert_near(
            &transform["translation"],
            &[4.0 * part, 8.0 * part, -2.0 * part],
            &what("translation"),
        );
        let angle = std::f64::consts::FRAC_PI_4 * part;
        assert_near(
            &transform["rotation"],
            &[0.0, libm::sin(angle), 0.0, libm::cos(angle)],
            &what("rotation"),
        );
        let seconds = 2.0 * part;
        assert_near(&transform["scale"], &[seconds * seconds, 1.0, 1.0], &what("scale"));
        assert_near(
            &info["nodes"][1]["transform"]["translation"],
            &[step, 0.0, 0.0],
            &what("step"),
        );
        assert_near(&info["nodes"][0]["weights"], &[part, 1.0 - 0.5 * part], &what("weights"));
        assert_near(
            &info["materials"][0]["base_color"],
            &[1.0 - part, part, 0.0, 1.0],
            &what("color"),
        );
        assert_near(
            &json!([info["lights"][0]["intensity"]]),
            &[100.0 * (1.0 - part)],
            &what("light"),
        );
        assert_near(&json!([info["cameras"][0]["fov_y"]]), &[0.5 + part], &what("camera"));
        assert_eq!(info["shown"]["time"], json!(time.parse::<f64>().expect("a number")));
    }
    let described = info_json(&sandbox, &["moving.gltf"]);
    assert_eq!(described["animations"][0]["duration"], json!(2.0));
    assert_eq!(
        described["animations"][0]["channels"][5]["target"],
        json!("/materials/0/pbrMetallicRoughness/baseColorFactor")
    );
    assert_eq!(described["materials"][0]["base_color"], json!([1.0, 0.0, 0.0, 1.0]), "at rest");
}

/// After its end, an animation holds its last pose; a later time causes a warning.
#[test]
fn times_after_the_end_are_reported() {
    let sandbox = Sandbox::new("late_times");
    write_animated_model(&sandbox);
    let late = sandbox.run(&["render", "moving.gltf", "--size=8x8", "--time", "9"]);
    assert!(late.stderr.contains("the animation ends at 2 s, before --time 9"), "{}", late.stderr);
    let film = ["animate", "moving.gltf", "--size=8x8", "--frames=2", "-o", "film.gif", "--to"];
    let run = sandbox.run(&[&film[..], &["9"]].concat());
    assert!(run.stderr.contains("the animation ends at 2 s: later frames"), "{}", run.stderr);
    for whole in [
        sandbox.run(&[&film[..], &["2"]].concat()),
        sandbox.run(&["render", "moving.gltf", "--size=8x8", "--time", "2"]),
    ] {
        assert!(!whole.stderr.contains("ends at"), "{}", whole.stderr);
    }
}

#[test]
fn dangling_animation_pointers_are_reported_and_skipped() {
    let sandbox = Sandbox::new("lost_pointers");
    write_animated_model(&sandbox);
    let text = std::fs::read_to_string(sandbox.path_of("moving.gltf")).expect("the file");
    for lost in [
        "/materials/7/alphaCutoff",
        "/materials/0/alphaCutoff",
        "/nodes/0/extras",
        "yfov",
        "",
        "/cameras/0/orthographic/xmag",
    ] {
        sandbox.write_file("lost.gltf", text.replace("/cameras/0/perspective/yfov", lost));
        let info = info_json(&sandbox, &["lost.gltf", "--time", "1"]);
        assert_eq!(info["animations"][0]["channels"].as_array().map(Vec::len), Some(7), "{lost}");
        let at = "/animations/0/channels/7/target/extensions/KHR_animation_pointer/pointer";
        let warnings = info["warnings"].as_array().expect("a list");
        assert!(warnings.iter().any(|warning| warning["pointer"] == at), "{lost}: {warnings:?}");
    }
}

#[test]
fn the_picture_shows_the_pose() {
    let sandbox = Sandbox::new("posed_picture");
    write_animated_model(&sandbox);
    let flags = ["--size", "32x32", "--view", "front", "--samples", "1", "--animation", "all"];
    for (time, red, green) in [("0.5", 225, 137), ("1", 188, 188), ("1.5", 137, 225)] {
        let run = sandbox.run(
            &[&["render", "moving.gltf", "-o", "out.png", "--time", time], &flags[..]].concat(),
        );
        assert_eq!(run.code, 0, "{}", run.stderr);
        let (_, _, pixels) = sandbox.read_picture("out.png");
        let seen = pixels.iter().filter(|pixel| pixel[3] == 255);
        // In linear light, (red, green) is (0.75, 0.25), (0.5, 0.5) and (0.25, 0.75).
        assert!(seen.clone().count() > 20, "at {time}");
        assert!(
            seen.clone().all(|pixel| pixel[..3] == [red, green, 0]),
            "at {time}: {:?}",
            seen.clone().next()
        );
    }
}
