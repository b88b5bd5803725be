//! Pictures: sizes, backgrounds, and repeatable bytes.

use crate::sandbox::Sandbox;

#[test]
fn flags_override_the_scene() {
    let sandbox = Sandbox::new("flags");
    sandbox.copy_model("crate.glb");
    sandbox.write_file(
        "scene.ron",
        "Scene(models: [(path: \"crate.glb\")], image: (size: (30, 20), background: Color(\"#f00\")))",
    );
    assert_eq!(sandbox.run(&["render", "scene.ron"]).code, 0);
    let (width, height, pixels) = sandbox.read_picture("scene.png");
    assert_eq!((width, height, pixels[0]), (30, 20, [255, 0, 0, 255]));
    let flags = ["--size", "50x40", "--background", "#00f", "--view", "top", "--samples", "1"];
    let run = sandbox.run(&[&["render", "scene.ron", "-o", "other.png"][..], &flags].concat());
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let (width, height, pixels) = sandbox.read_picture("other.png");
    assert_eq!((width, height, pixels[0]), (50, 40, [0, 0, 255, 255]));
}

#[test]
fn timings_name_the_stages_and_change_nothing() {
    let sandbox = Sandbox::new("timings");
    sandbox.copy_model("crate.glb");
    let flags = ["--size", "40x30", "--timings"];
    let run = sandbox.run(&[&["render", "crate.glb"][..], &flags].concat());
    assert_eq!(run.code, 0, "{}", run.stderr);
    let stages: Vec<_> = run.stderr.lines().filter_map(|line| line.split("  ").next()).collect();
    let expected = ["read", "parse", "geometry", "images", "frame", "mip chains", "vertices"];
    assert_eq!(stages, [&expected[..], &["pixels", "encode", "write", "all"]].concat());
    let timed = sandbox.read_picture("crate.png");
    assert_eq!(sandbox.run(&["render", "crate.glb", "--size", "40x30"]).stderr, "");
    assert_eq!(sandbox.read_picture("crate.png"), timed);
}

#[test]
fn a_transparent_background_has_no_halo() {
    let sandbox = Sandbox::new("transparent");
    sandbox.copy_model("spheres.glb");
    let render = |name: &str, background: &str| {
        let flags = ["--size", "64x32", "--view", "front", "--background", background];
        let run = sandbox.run(&[&["render", "spheres.glb", "-o", name][..], &flags].concat());
        assert_eq!(run.code, 0, "{}", run.stderr);
        sandbox.read_picture(name).2
    };
    let clear = render("clear.png", "transparent");
    let white = render("white.png", "#fff");
    let partly = clear.iter().filter(|pixel| (1..255).contains(&pixel[3])).count();
    assert!(partly > 20, "edges are soft");
    for (at, (clear, white)) in clear.iter().zip(&white).enumerate() {
        match clear[3] {
            0 => assert_eq!((*clear, *white), ([0; 4], [255; 4]), "pixel {at}"),
            255 => assert_eq!(clear, white, "pixel {at}"),
            alpha => {
                // Blended over white in linear light, the partly transparent pixel must have the
                // opaque picture's color.
                let share = f64::from(alpha) / 255.0;
                for k in 0..3 {
                    let over = srgb_to_linear(clear[k]) * share + 1.0 - share;
                    let difference = (over - srgb_to_linear(white[k])).abs();
                    assert!(difference < 0.02, "pixel {at}, channel {k}: {difference}");
                }
            }
        }
    }
}

fn srgb_to_linear(code: u8) -> f64 {
    let srgb = f64::from(code) / 255.0;
    if srgb <= 0.04045 { srgb / 12.92 } else { libm::pow((srgb + 0.055) / 1.055, 2.4) }
}

#[test]
fn pictures_do_not_depend_on_threads_or_repetition() {
    let sandbox = Sandbox::new("same_bytes");
    sandbox.copy_model("teapot.glb");
    let bytes = |name: &str, threads: &str| {
        let flags = ["-o", name, "--size", "333x222", "--threads", threads];
        let run = sandbox.run(&[&["render", "teapot.glb"][..], &flags].concat());
        assert_eq!(run.code, 0, "{}", run.stderr);
        std::fs::read(sandbox.path_of(name)).expect("a picture")
    };
    let first = bytes("a.png", "1");
    assert!(
        first == bytes("b.png", "1")
            && first == bytes("c.png", "2")
            && first == bytes("d.png", "5")
    );
}

#[test]
fn every_view_style_and_projection_shows_something() {
    let sandbox = Sandbox::new("views");
    sandbox.copy_model("house.glb");
    let views = [
        "front",
        "back",
        "left",
        "right",
        "top",
        "bottom",
        "three-quarter",
        "isometric",
        "dimetric",
        "trimetric",
    ];
    for view in views {
        for style in ["shaded", "flat", "wireframe"] {
            for projection in ["perspective", "orthographic"] {
                let flags = ["--view", view, "--style", style, "--projection", projection];
                let size = ["--size", "48x32", "-o", "out.png"];
                let run = sandbox.run(&[&["render", "house.glb"][..], &flags, &size].concat());
                assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{flags:?}");
                let (_, _, pixels) = sandbox.read_picture("out.png");
                // Line drawings are dark on white paper; shaded pictures are opaque on a
                // transparent background.
                let on_paper = |pixel: &[u8; 4]| 255 - pixel[0].min(pixel[1]).min(pixel[2]);
                let coverage = |pixel: &[u8; 4]| match style {
                    "wireframe" => on_paper(pixel),
                    _ => pixel[3],
                };
                let inked = pixels.iter().filter(|pixel| coverage(pixel) > 0).count();
                assert!(inked > 48 * 32 / 16, "{flags:?}: {inked} pixels");
                // Framing leaves a margin of 5 percent, so nothing touches the border. Dense
                // wireframes consist of hairlines, whose antialiasing covers one more pixel at 30
                // of 255.
                let border =
                    |n: usize| n.is_multiple_of(48) || n % 48 == 47 || !(48..48 * 31).contains(&n);
                let touches =
                    pixels.iter().enumerate().any(|(n, pixel)| border(n) && coverage(pixel) > 48);
                assert!(!touches, "{flags:?}");
            }
        }
    }
}

#[test]
fn c36_the_floor_has_no_gaps_with_the_eye_just_above_it() {
    let sandbox = Sandbox::new("floor");
    sandbox.copy_model("floor.glb");
    for height in [0.1, 0.01, 0.001] {
        sandbox.write_file(
            "scene.ron",
            format!(
                "Scene(models: [(path: \"floor.glb\")], camera: (
                   view: LookTo(eye: (0.3, {height}, 0.2), gaze: (0.02, 0, -1)),
                   projection: Perspective(fov_y_degrees: 60)),
                 image: (size: (200, 120), background: Color(\"#f0f\"), samples: 1))"
            ),
        );
        let run = sandbox.run(&["render", "scene.ron"]);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""));
        let (width, _, pixels) = sandbox.read_picture("scene.png");
        let rows: Vec<usize> = pixels
            .chunks(width as usize)
            .map(|row| row.iter().filter(|pixel| **pixel == [255, 0, 255, 255]).count())
            .collect();
        // The horizon is at row 60. A little below it, where the sides of the floor are outside the
        // picture, every pixel is covered.
        let torn: Vec<usize> = (66..120).filter(|&row| rows[row] > 0).collect();
        assert!(torn.is_empty(), "eye at {height}: background in rows {torn:?}");
        assert_eq!(rows[0], width as usize, "sky above");
    }
}
