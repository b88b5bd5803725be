//! Lighting flags: environment, exposure, tone curves, shadows and the ground.

use crate::sandbox::Sandbox;

type Pixels = Vec<[u8; 4]>;

/// Returns a sandbox with a model.
fn sandbox_with_model(name: &str, model: &str) -> Sandbox {
    let sandbox = Sandbox::new(name);
    sandbox.copy_model(model);
    sandbox
}

fn render_pixels(sandbox: &Sandbox, input: &str, flags: &[&str]) -> Pixels {
    let default = ["render", input, "-o", "out.png", "--size", "80x60"];
    let run = sandbox.run(&[&default[..], flags].concat());
    assert_eq!(run.code, 0, "{flags:?}: {}", run.stderr);
    sandbox.read_picture("out.png").2
}

/// Returns the sum of all red, green and blue codes where something is visible.
fn total_brightness(pixels: &Pixels) -> u64 {
    let seen = pixels.iter().filter(|pixel| pixel[3] == 255);
    seen.flat_map(|pixel| &pixel[..3]).map(|&code| u64::from(code)).sum()
}

/// Returns a `.hdr` file of one color.
fn hdr_file(rgbe: [u8; 4]) -> Vec<u8> {
    let mut bytes = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n".to_vec();
    bytes.extend(rgbe.repeat(8));
    bytes
}

#[test]
fn a_bare_model_is_lit_by_the_studio() {
    let sandbox = sandbox_with_model("studio", "finishes.glb");
    let bare = render_pixels(&sandbox, "finishes.glb", &[]);
    assert_eq!(render_pixels(&sandbox, "finishes.glb", &["--environment", "studio"]), bare);
    let none = render_pixels(&sandbox, "finishes.glb", &["--environment", "none"]);
    let sky = render_pixels(&sandbox, "finishes.glb", &["--environment", "sky"]);
    assert!(none != bare && sky != bare && sky != none);
    // Metals have something to reflect.
    assert!(total_brightness(&bare) > total_brightness(&none));
    // A scene file specifies its own environment.
    sandbox.write_file("scene.ron", "Scene(models: [(path: \"finishes.glb\")])");
    assert_eq!(render_pixels(&sandbox, "scene.ron", &[]), none);
}

#[test]
fn the_environment_comes_from_the_named_file() {
    let sandbox = sandbox_with_model("hdr", "finishes.glb");
    sandbox.write_file("scene.ron", "Scene(models: [(path: \"finishes.glb\")])");
    let outside = Sandbox::new("hdr_outside");
    outside.write_file("red.hdr", hdr_file([128, 0, 0, 129]));
    let path = outside.path_of("red.hdr").display().to_string();
    for input in ["finishes.glb", "scene.ron"] {
        let pixels = render_pixels(&sandbox, input, &["--environment", &path]);
        let red = pixels.iter().filter(|pixel| pixel[3] == 255);
        assert!(red.clone().count() > 100 && red.clone().all(|pixel| pixel[1] < 40), "{input}");
        assert!(red.clone().any(|pixel| pixel[0] > 200), "{input}");
    }
    let missing = sandbox.run(&["render", "finishes.glb", "--environment", "none.hdr"]);
    assert_eq!(missing.code, 1, "{}", missing.stderr);
    assert!(missing.stderr.contains("none.hdr"), "{}", missing.stderr);
    let other = sandbox.run(&["render", "finishes.glb", "--environment", "beach"]);
    assert_eq!(other.code, 2);
    assert!(other.stderr.contains("studio, sky, none or a .hdr file"), "{}", other.stderr);
}

#[test]
fn exposure_and_tone_change_brightness() {
    let sandbox = sandbox_with_model("exposure", "teapot.glb");
    let default = render_pixels(&sandbox, "teapot.glb", &[]);
    assert_eq!(
        render_pixels(&sandbox, "teapot.glb", &["--exposure", "0", "--tone-mapping", "none"]),
        default
    );
    let darker = render_pixels(&sandbox, "teapot.glb", &["--exposure", "-1.5"]);
    let brighter = render_pixels(&sandbox, "teapot.glb", &["--exposure", "1"]);
    assert!(total_brightness(&darker) < total_brightness(&default));
    assert!(total_brightness(&brighter) > total_brightness(&default));
    let curves = ["neutral", "aces", "agx"];
    let curves =
        curves.map(|curve| render_pixels(&sandbox, "teapot.glb", &["--tone-mapping", curve]));
    assert!(curves.iter().all(|curve| *curve != default) && curves[0] != curves[1]);
    for wrong in [["--exposure", "bright"], ["--exposure", "nan"], ["--tone-mapping", "filmic"]] {
        let run = sandbox.run(&[&["render", "teapot.glb"][..], &wrong].concat());
        assert_eq!(run.code, 2, "{wrong:?}");
    }
}

#[test]
fn shadows_and_the_ground_are_switched_by_flags() {
    let sandbox = sandbox_with_model("shadows", "teapot.glb");
    let below = |pixels: &Pixels| pixels.iter().filter(|p| p[3] > 0 && p[..3] == [0; 3]).count();
    let plain = render_pixels(&sandbox, "teapot.glb", &[]);
    assert_eq!(below(&plain), 0);
    let ground = render_pixels(&sandbox, "teapot.glb", &["--ground", "shadow"]);
    assert!(below(&ground) > 15);
    sandbox.write_file(
        "scene.ron",
        "Scene(models: [(path: \"teapot.glb\")], ground: Shadow(),
        lights: [Directional(direction: (1, -1, 0), intensity: 3, shadows: On()), Ambient(intensity: 1)])",
    );
    let own = render_pixels(&sandbox, "scene.ron", &[]);
    assert_eq!(render_pixels(&sandbox, "scene.ron", &["--shadows", "on"]), own);
    assert!(below(&own) > 100);
    assert_eq!(below(&render_pixels(&sandbox, "scene.ron", &["--shadows", "off"])), 0);
    let without = render_pixels(&sandbox, "scene.ron", &["--ground", "none"]);
    assert_eq!(below(&without), 0);
    assert!(
        render_pixels(&sandbox, "scene.ron", &["--ground", "none", "--shadows", "off"]) != without
    );
    assert!(render_pixels(&sandbox, "teapot.glb", &["--ambient-occlusion"]) != plain);
}

#[test]
fn shadow_settings_out_of_range_are_located() {
    let sandbox = sandbox_with_model("shadow_settings", "crate.glb");
    for (field, location, message) in [
        ("shadows: On(size: 10)", "2:19", "invalid shadow map size: 10 texels per side"),
        ("shadows: On(softness_degrees: 40)", "2:31", "an angle from 0 to 30 degrees"),
        (
            "lights: [Directional(direction: (0, -1, 0), intensity: 1, shadows: On(size: 9000))]",
            "2:77",
            "invalid shadow map size: 9000 texels per side",
        ),
        ("ambient_occlusion: (radius: 0)", "2:29", "a number greater than 0"),
        (
            "image: (max_anisotropy: 9)",
            "2:25",
            "invalid number of samples for anisotropic filtering: 9",
        ),
        ("ground: Shadow(height: inf)", "2:24", "a finite number"),
    ] {
        sandbox
            .write_file("scene.ron", format!("Scene(models: [(path: \"crate.glb\")],\n{field})"));
        let run = sandbox.run(&["render", "scene.ron"]);
        assert_eq!(run.code, 1, "{field}");
        let location = format!("scene.ron:{location}");
        let is_reported = run.stderr.contains(&location) && run.stderr.contains(message);
        assert!(is_reported, "{field}: {}", run.stderr);
    }
}

#[test]
fn a_model_with_its_own_lights_keeps_a_dimmed_studio() {
    let sandbox = Sandbox::new("lamps");
    // One square meter that faces the viewer, and a lamp that shines on its back.
    let mut document = alberti_tests::gltf::Document::single_triangle();
    document.json["extensionsUsed"] = serde_json::json!(["KHR_lights_punctual"]);
    document.json["extensions"]["KHR_lights_punctual"] =
        serde_json::json!({"lights": [{"type": "directional", "intensity": 3.0}]});
    // Rotated by half a turn about y: the light travels along +z.
    document.json["nodes"] = serde_json::json!([
        {"mesh": 0},
        {"rotation": [0, 1, 0, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}}
    ]);
    document.json["scenes"] = serde_json::json!([{"nodes": [0, 1]}]);
    sandbox.write_file("lamp.glb", document.to_glb());
    let front = ["--view", "front"];
    let lit = render_pixels(&sandbox, "lamp.glb", &front);
    let covered = lit.iter().filter(|pixel| pixel[3] == 255).count() as u64;
    assert!(covered > 100, "{covered}");
    assert!(total_brightness(&lit) > 3 * 40 * covered, "the studio lights its front");
    let dark = render_pixels(&sandbox, "lamp.glb", &["--view", "front", "--environment", "none"]);
    assert_eq!(total_brightness(&dark), 0, "`none` emits no light");
    // From behind, the lamp's light is visible.
    let back = render_pixels(&sandbox, "lamp.glb", &["--view", "back"]);
    let none = render_pixels(&sandbox, "lamp.glb", &["--view", "back", "--environment", "none"]);
    assert!(total_brightness(&back) >= total_brightness(&none));
}

#[test]
fn lights_as_bright_as_daylight_do_not_overexpose_pictures() {
    let sandbox = Sandbox::new("daylight");
    let brightness = |lux: f64| {
        let mut document = alberti_tests::gltf::Document::single_triangle();
        document.json["extensionsUsed"] = serde_json::json!(["KHR_lights_punctual"]);
        document.json["extensions"]["KHR_lights_punctual"] =
            serde_json::json!({"lights": [{"type": "directional", "intensity": lux}]});
        document.json["nodes"] = serde_json::json!([
            {"mesh": 0},
            {"extensions": {"KHR_lights_punctual": {"light": 0}}}
        ]);
        document.json["scenes"] = serde_json::json!([{"nodes": [0, 1]}]);
        sandbox.write_file("sun.glb", document.to_glb());
        let pixels = render_pixels(&sandbox, "sun.glb", &["--view", "front"]);
        let white = pixels.iter().filter(|pixel| **pixel == [255; 4]).count();
        assert_eq!(white, 0, "{lux} lux");
        total_brightness(&pixels)
    };
    let [indoors, outdoors, dusk] = [5.0, 100_000.0, 0.5].map(brightness);
    assert!(outdoors.abs_diff(indoors) < indoors / 10, "{indoors} {outdoors}");
    assert!(dusk < indoors, "{dusk} {indoors}");
}
