//! Light by flags: surroundings, exposure, tone curves, shadows and the ground.

use crate::bench::Bench;

type Pixels = Vec<[u8; 4]>;

/// A bench with a model, and pictures of it by flags.
fn bench(name: &str, model: &str) -> Bench {
    let bench = Bench::new(name);
    bench.bring(model);
    bench
}

fn picture(bench: &Bench, input: &str, flags: &[&str]) -> Pixels {
    let usual = ["render", input, "-o", "out.png", "--size", "80x60"];
    let run = bench.run(&[&usual[..], flags].concat());
    assert_eq!(run.code, 0, "{flags:?}: {}", run.stderr);
    bench.picture("out.png").2
}

/// The sum of all codes of red, green and blue where something is.
fn brightness(pixels: &Pixels) -> u64 {
    let seen = pixels.iter().filter(|pixel| pixel[3] == 255);
    seen.flat_map(|pixel| &pixel[..3]).map(|&code| u64::from(code)).sum()
}

/// A `.hdr` file of one colour.
fn hdr(rgbe: [u8; 4]) -> Vec<u8> {
    let mut bytes = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n".to_vec();
    bytes.extend(rgbe.repeat(8));
    bytes
}

#[test]
fn a_bare_model_stands_in_the_studio() {
    let bench = bench("studio", "finishes.glb");
    let bare = picture(&bench, "finishes.glb", &[]);
    assert_eq!(picture(&bench, "finishes.glb", &["--environment", "studio"]), bare);
    let none = picture(&bench, "finishes.glb", &["--environment", "none"]);
    let sky = picture(&bench, "finishes.glb", &["--environment", "sky"]);
    assert!(none != bare && sky != bare && sky != none);
    // Metals have something to mirror.
    assert!(brightness(&bare) > brightness(&none));
    // A scene file says itself what is around.
    bench.write("scene.ron", "Scene(models: [(path: \"finishes.glb\")])");
    assert_eq!(picture(&bench, "scene.ron", &[]), none);
}

#[test]
fn surroundings_come_from_a_file_that_is_named() {
    let bench = bench("hdr", "finishes.glb");
    bench.write("scene.ron", "Scene(models: [(path: \"finishes.glb\")])");
    let outside = Bench::new("hdr_outside");
    outside.write("red.hdr", hdr([128, 0, 0, 129]));
    let path = outside.path("red.hdr").display().to_string();
    for input in ["finishes.glb", "scene.ron"] {
        let pixels = picture(&bench, input, &["--environment", &path]);
        let red = pixels.iter().filter(|pixel| pixel[3] == 255);
        assert!(red.clone().count() > 100 && red.clone().all(|pixel| pixel[1] < 40), "{input}");
        assert!(red.clone().any(|pixel| pixel[0] > 200), "{input}");
    }
    let missing = bench.run(&["render", "finishes.glb", "--environment", "none.hdr"]);
    assert_eq!(missing.code, 1, "{}", missing.stderr);
    assert!(missing.stderr.contains("none.hdr"), "{}", missing.stderr);
    let other = bench.run(&["render", "finishes.glb", "--environment", "beach"]);
    assert_eq!(other.code, 2);
    assert!(other.stderr.contains("studio, sky, none and a .hdr file"), "{}", other.stderr);
}

#[test]
fn exposure_and_tone_change_brightness() {
    let bench = bench("exposure", "teapot.glb");
    let usual = picture(&bench, "teapot.glb", &[]);
    assert_eq!(picture(&bench, "teapot.glb", &["--exposure", "0", "--tone", "none"]), usual);
    let darker = picture(&bench, "teapot.glb", &["--exposure", "-1.5"]);
    let brighter = picture(&bench, "teapot.glb", &["--exposure", "1"]);
    assert!(brightness(&darker) < brightness(&usual));
    assert!(brightness(&brighter) > brightness(&usual));
    let curves = ["neutral", "aces", "agx"];
    let curves = curves.map(|curve| picture(&bench, "teapot.glb", &["--tone", curve]));
    assert!(curves.iter().all(|curve| *curve != usual) && curves[0] != curves[1]);
    for wrong in [["--exposure", "bright"], ["--exposure", "nan"], ["--tone", "filmic"]] {
        let run = bench.run(&[&["render", "teapot.glb"][..], &wrong].concat());
        assert_eq!(run.code, 2, "{wrong:?}");
    }
}

#[test]
fn shadows_and_the_ground_are_switched_by_flags() {
    let bench = bench("shadows", "teapot.glb");
    let below = |pixels: &Pixels| pixels.iter().filter(|p| p[3] > 0 && p[..3] == [0; 3]).count();
    let plain = picture(&bench, "teapot.glb", &[]);
    assert_eq!(below(&plain), 0);
    let ground = picture(&bench, "teapot.glb", &["--ground", "shadow"]);
    assert!(below(&ground) > 15);
    bench.write(
        "scene.ron",
        "Scene(models: [(path: \"teapot.glb\")], ground: Shadow(),
        lights: [Sun(direction: (1, -1, 0), lux: 3, shadows: On()), Ambient(lux: 1)])",
    );
    let own = picture(&bench, "scene.ron", &[]);
    assert_eq!(picture(&bench, "scene.ron", &["--shadows", "on"]), own);
    assert!(below(&own) > 100);
    assert_eq!(below(&picture(&bench, "scene.ron", &["--shadows", "off"])), 0);
    let without = picture(&bench, "scene.ron", &["--ground", "none"]);
    assert_eq!(below(&without), 0);
    assert!(picture(&bench, "scene.ron", &["--ground", "none", "--shadows", "off"]) != without);
    assert!(picture(&bench, "teapot.glb", &["--ambient-occlusion"]) != plain);
}

#[test]
fn settings_of_shadows_out_of_range_are_pointed_at() {
    let bench = bench("shadow_settings", "crate.glb");
    for (field, place, message) in [
        ("shadows: On(size: 10)", "2:19", "a shadow map cannot have 10 texels on a side"),
        ("shadows: On(softness_degrees: 40)", "2:31", "an angle from 0 to 30 degrees"),
        (
            "lights: [Sun(direction: (0, -1, 0), lux: 1, shadows: On(size: 9000))]",
            "2:63",
            "a shadow map cannot have 9000 texels on a side",
        ),
        ("ambient_occlusion: (radius: 0)", "2:29", "a number greater than 0"),
        ("image: (anisotropy: 9)", "2:21", "textures cannot be read at 9 places"),
        ("ground: Shadow(height: inf)", "2:24", "a finite number"),
    ] {
        bench.write("scene.ron", format!("Scene(models: [(path: \"crate.glb\")],\n{field})"));
        let run = bench.run(&["render", "scene.ron"]);
        assert_eq!(run.code, 1, "{field}");
        let place = format!("scene.ron:{place}");
        let told = run.stderr.contains(&place) && run.stderr.contains(message);
        assert!(told, "{field}: {}", run.stderr);
    }
}
