//! Camera and light flags: angles, eye and target, field of view, zoom, intensity.

use crate::sandbox::Sandbox;

type Pixels = Vec<[u8; 4]>;

fn sandbox_with_teapot(name: &str) -> Sandbox {
    let sandbox = Sandbox::new(name);
    sandbox.copy_model("teapot.glb");
    sandbox
}

fn render_pixels(sandbox: &Sandbox, input: &str, flags: &[&str]) -> Pixels {
    let default = ["render", input, "-o", "out.png", "--size", "80x60"];
    let run = sandbox.run(&[&default[..], flags].concat());
    assert_eq!(run.code, 0, "{flags:?}: {}", run.stderr);
    sandbox.read_picture("out.png").2
}

/// Returns the number of pixels that show the model.
fn covered_pixels(pixels: &Pixels) -> usize {
    pixels.iter().filter(|pixel| pixel[3] == 255).count()
}

/// Returns the sum of all red, green and blue codes where the model is visible.
fn total_brightness(pixels: &Pixels) -> u64 {
    let seen = pixels.iter().filter(|pixel| pixel[3] == 255);
    seen.flat_map(|pixel| &pixel[..3]).map(|&code| u64::from(code)).sum()
}

#[test]
fn quarter_turns_match_the_named_views() {
    let sandbox = sandbox_with_teapot("azimuth");
    let pixels = |flags: &[&str]| render_pixels(&sandbox, "teapot.glb", flags);
    for (azimuth, view) in [("0", "front"), ("90", "right"), ("180", "back"), ("-90", "left")] {
        let named = pixels(&["--view", view]);
        assert_eq!(pixels(&["--azimuth", azimuth]), named, "{view}");
        assert_eq!(pixels(&["--azimuth", azimuth, "--elevation", "0"]), named, "{view}");
    }
    assert_eq!(pixels(&["--elevation", "90"]), pixels(&["--view", "top"]));
    let orthographic = ["--azimuth", "30", "--elevation", "20", "--projection", "orthographic"];
    assert_ne!(pixels(&orthographic), pixels(&orthographic[..4]));
}

#[test]
fn flags_place_the_camera_as_a_scene_does() {
    let sandbox = sandbox_with_teapot("placed");
    let scene = |camera: &str| {
        let text = format!(
            "Scene(models: [(path: \"teapot.glb\")], camera: ({camera}), environment: Studio())"
        );
        sandbox.write_file("scene.ron", text);
        render_pixels(&sandbox, "scene.ron", &[])
    };
    let studio = "Scene(models: [(path: \"teapot.glb\")], environment: Studio())";
    let flags = |flags: &[&str]| {
        sandbox.write_file("plain.ron", studio);
        render_pixels(&sandbox, "plain.ron", flags)
    };
    assert_eq!(
        flags(&["--eye", "4,3,-5", "--target", "0,0.5,0", "--view-up", "1,1,0"]),
        scene("view: LookAt(eye: (4, 3, -5), target: (0, 0.5, 0), up: (1, 1, 0))")
    );
    assert_eq!(
        flags(&["--eye=-4,3,5", "--target=0,0,0", "--fov", "60", "--zoom", "1.5"]),
        scene(
            "view: LookAt(eye: (-4, 3, 5), target: (0, 0, 0)), projection: Perspective(fov_y_degrees: 60), zoom: 1.5"
        )
    );
}

#[test]
fn zoom_enlarges_in_every_projection() {
    let sandbox = sandbox_with_teapot("zoom");
    for projection in ["perspective", "orthographic", "isometric", "two-point"] {
        let covered = |zoom: &str| {
            let flags = ["--projection", projection, "--zoom", zoom];
            covered_pixels(&render_pixels(&sandbox, "teapot.glb", &flags)) as f64
        };
        let ratio = covered("0.9") / covered("0.45");
        assert!((3.6..4.4).contains(&ratio), "{projection}: {ratio}");
    }
}

#[test]
fn light_flags_change_lights_and_environment() {
    let sandbox = Sandbox::new("light_flags");
    sandbox.copy_model("finishes.glb");
    let pixels = |flags: &[&str]| render_pixels(&sandbox, "finishes.glb", flags);
    let bare = pixels(&[]);
    assert_eq!(pixels(&["--light-intensity", "1", "--environment-rotation", "0"]), bare);
    let [dark, bright] = ["0", "3"].map(|factor| pixels(&["--light-intensity", factor]));
    assert!(total_brightness(&dark) < total_brightness(&bare));
    assert!(total_brightness(&bare) < total_brightness(&bright));
    // The studio remains.
    assert!(total_brightness(&dark) > 0);
    assert_ne!(pixels(&["--environment-rotation", "90"]), bare);
    let sky = |angle: &str| pixels(&["--environment", "sky", "--environment-rotation", angle]);
    assert_ne!(sky("90"), sky("0"));
    let seen = pixels(&["--background", "environment"]);
    assert_eq!(covered_pixels(&seen), seen.len());
}

#[test]
fn animation_frames_have_the_same_intensity() {
    let sandbox = sandbox_with_teapot("film_intensity");
    let frame = |factor: &str| {
        let flags = ["--frames", "1", "--size", "80x60", "--light-intensity", factor];
        let call = ["animate", "teapot.glb", "--turntable", "-o", "f_{frame}.png"];
        let run = sandbox.run(&[&call[..], &flags].concat());
        assert_eq!(run.code, 0, "{}", run.stderr);
        total_brightness(&sandbox.read_picture("f_0.png").2)
    };
    assert!(frame("0.2") < frame("1"));
}
