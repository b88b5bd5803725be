//! Words from other programs on the command line, and the advice that users get.

use crate::sandbox::Sandbox;

fn sandbox_with_teapot(name: &str) -> Sandbox {
    let sandbox = Sandbox::new(name);
    sandbox.copy_model("teapot.glb");
    sandbox
}

/// Returns whether a message contains these words, as written or with the test's model in place of
/// the example's.
fn tells(message: &str, words: &str) -> bool {
    message.contains(words) || message.contains(&words.replace("model.glb", "teapot.glb"))
}

#[test]
fn flags_from_other_programs_lead_to_their_equivalents() {
    let sandbox = sandbox_with_teapot("foreign_flags");
    for (flags, told) in [
        (&["--resolution", "8x8"][..], "use `--size 8x8`"),
        (&["--width", "8"], "the flag here is `--size`, as in `--size 1920x1080`"),
        (&["--height=8"], "the flag here is `--size`, as in `--size 1920x1080`"),
        (&["--bg-color", "red"], "use `--background red`"),
        (&["--background-color=red"], "use `--background red`"),
        (&["--wireframe"], "use `--style wireframe`"),
        (&["--hdri", "a.hdr"], "use `--environment a.hdr`"),
        (&["--camera-position", "1,2,3"], "use `--eye 1,2,3 --target 0,0,0`"),
        (&["--out-file", "a.png"], "use `--output a.png`"),
        (&["--turntable"], "run `alberti animate model.glb --turntable -o turn.gif`"),
        (&["-resize", "8x8"], "use `--size 8x8`"),
        (
            &["-e"],
            "`--style wireframe` shows all edges of the mesh, and `--overlay edges` draws outlines \
             and creases over the picture",
        ),
        (
            &["-b"],
            "this program never opens a window, so omit it; `--background white` is the color \
             behind the model",
        ),
        (
            &["--engine", "CYCLES"],
            "there is one renderer, on the CPU and without ray tracing; `--samples 16` smooths edges",
        ),
        (
            &["--dpi", "300"],
            "`--size 1920x1080` sets the size in pixels; `alberti sheet model.glb --dpi 300 -o \
             sheet.png` draws on paper, to scale",
        ),
        (&["--resolution", "200,150"], "use `--size 200x150`"),
        (&["-resize", "50%"], "use `--scale 0.5`"),
        (&["-background", "none"], "use `--background transparent`"),
        (&["-crop", "100x80+10+20"], "use `--crop 10,20,100,80`"),
        (&["--bg-color", "1,0,0"], "use `--background '#ff0000'`"),
        (&["--coloring-array=Height"], "use `--scalars Height`"),
        (&["--viewport", "64x48"], "use `--size 64x48`"),
        (&["--yfov", "0.7"], "use `--fov 40.1`"),
        (&["-f", "svg"], "use `--format svg`"),
        (&["-D"], "`alberti render --help` lists its flags"),
        (&["--reference=old.png"], "use `--compare old.png`"),
        (&["-S", "Scene.001"], "use `--scene Scene.001`"),
        (&["-j", "2"], "use `--threads 2`"),
    ] {
        let run = sandbox.run(&[&["render", "teapot.glb"], flags].concat());
        let name = flags[0].split('=').next().expect("a name");
        let told = told.replace("model.glb", "teapot.glb");
        let expected = format!("error: `{name}` is not a flag of `alberti render`; {told}\n");
        assert_eq!((run.code, run.stderr), (2, expected), "{flags:?}");
    }
}

#[test]
fn habits_from_other_programs_do_not_write_wrong_files() {
    let sandbox = sandbox_with_teapot("foreign_habits");
    for (words, told) in [
        (
            &["render", "teapot.glb", "-quality", "80"][..],
            "`-quality` is not a flag of `alberti render`; it needs two hyphens here: `--quality 80`",
        ),
        (&["render", "teapot.glb", "out.jpg"], "run `alberti render teapot.glb -o out.jpg`"),
        (
            &["animate", "teapot.glb", "--turntable", "-o", "o.%04d.png"],
            "use -o 'o.{frame:04}.png'",
        ),
        (
            &["animate", "teapot.glb", "--turntable", "-o", "o_####.png"],
            "use -o 'o_{frame:04}.png'",
        ),
        (&["render", "teapot.glb", "--up", "-Y"], "the axis that points up is x, y or z"),
        (&["render", "teapot.glb", "--crop", "9x8+1+2"], "write `--crop 1,2,9,8`"),
        (&["render", "teapot.glb", "--color", "1,0,0"], "`--color` sets when messages are colored"),
        (&["render", "teapot.glb", "-o", "png:-"], "write `--format png -o -`"),
        (&["render", "teapot.glb", "+repage", "-o", "a.png"], "a flag begins with `--`"),
        (
            &["render", "teapot.glb", "-o", "a.png", "--", "--gpu"],
            "everything after `--` is taken as a model",
        ),
        (&["render", "teapot.glb", "-o", "//frame_####"], "use -o 'frame_{index:04}.png'"),
        (&["render", "teapot.glb", "-o", "png:out.png"], "write `--format png -o out.png`"),
        (&["--background", "teapot.glb", "-f", "1"], "run `alberti render teapot.glb`"),
        (&["-b", "teapot.glb", "-o", "//a", "-f", "1"], "run `alberti render teapot.glb -o a.png`"),
        (&["render", "teapot.glb", "--background"], "sets the color behind the model"),
        (&["render", "teapot.glb", "-F", "JPEG"], "use `--format jpeg`"),
        (&["animate", "teapot.glb", "-s", "1"], "a film begins with the first frame, so omit it"),
        (&["animate", "teapot.glb", "-frames:v", "4"], "use `--frames 4`"),
        (&["--background", "a.blend", "-f", "1"], "export the .blend file as .glb"),
        (&["-b", "teapot.glb", "-a"], "run `alberti animate teapot.glb -o film.gif`"),
        (&["--background", "--python", "a.py"], "runs no scripts, so omit `--background`"),
        (&["animate", "teapot.glb", "-e", "48"], "use `--frames 48`"),
        (&["render", "teapot.glb", "-F", "OPEN_EXR"], "EXR files hold passes"),
        (&["batch", "teapot.glb", "--format", "webp"], "pictures are PNG files"),
        (
            &["render", "teapot.glb", "-xtgans"],
            "use `--overlay axes --tone-mapping aces --overlay grid",
        ),
        (&["render", "teapot.glb", "--format", "OPEN_EXR", "-o", "a.exr"], "-o picture.png`"),
        (&["thumbnailer", "teapot.glb", "-thumbnail", "9x9", "t.png"], "--size 128`"),
        (&["convert", "teapot.glb", "a.png"], "run `alberti render teapot.glb -o a.png`"),
        (&["thumbnail", "teapot.glb", "-o", "t.png"], "render --size 256x256 teapot.glb -o t.png`"),
        (&["-b", "teapot.glb", "-o", "b.png"], "run `alberti render teapot.glb -o b.png`"),
        (&["--size", "8x8", "render", "teapot.glb"], "flags come after the command"),
        (&["-o", "a.png", "render", "teapot.glb"], "run `alberti render teapot.glb -o a.png`"),
        (&["render", "teapot.glb", "--render-output", "r.png"], "`-o r.png` names the output"),
    ] {
        let run = sandbox.run(words);
        assert_ne!(run.code, 0, "{words:?}: {}", run.stderr);
        assert!(tells(&run.stderr, told), "{words:?}: {}", run.stderr);
    }
    let files = std::fs::read_dir(sandbox.path_of(".")).expect("the folder").count();
    assert_eq!(files, 1, "only the model exists");
}

#[test]
fn tips_are_never_misleading() {
    let sandbox = sandbox_with_teapot("tips");
    let unknown = sandbox.run(&["render", "teapot.glb", "--lenient", "--qwerty"]);
    assert!(!unknown.stderr.contains("tip:"), "{}", unknown.stderr);
    // The usage line would claim that `--lenient` is required.
    assert!(!unknown.stderr.contains("Usage:"), "{}", unknown.stderr);
    let cel = sandbox.run(&["render", "teapot.glb", "--style", "cel"]);
    assert!(cel.stderr.contains("`--style toon`\n"), "{}", cel.stderr);
    let misspelled = sandbox.run(&["render", "teapot.glb", "--enviroment", "sky"]);
    assert!(misspelled.stderr.contains("did you mean `--environment`?"), "{}", misspelled.stderr);
}

#[test]
fn help_has_familiar_groups() {
    let sandbox = Sandbox::new("help_groups");
    let help = sandbox.run(&["render", "--help"]).stdout;
    let headings: Vec<&str> = help
        .lines()
        .filter(|line| line.ends_with(':') && !line.starts_with(' '))
        .map(|line| line.trim_end_matches(':'))
        .collect();
    for heading in ["Input", "Camera", "Picture", "Light", "Lines", "Output"] {
        let count = headings.iter().filter(|known| **known == heading).count();
        assert_eq!(count, 1, "{heading}: {headings:?}");
    }
    let group_of = |flag: &str| {
        let at = help.find(&format!("--{flag} ")).or_else(|| help.find(&format!("--{flag}\n")));
        let before = &help[..at.expect(flag)];
        let heading =
            before.lines().rev().find(|line| line.ends_with(':') && !line.starts_with(' '));
        heading.map(|line| line.trim_end_matches(':').to_owned()).expect(flag)
    };
    for (flag, heading) in [
        ("background", "Picture"),
        ("bits", "Picture"),
        ("azimuth", "Camera"),
        ("section", "Lines"),
        ("arc-tolerance", "Lines"),
        ("threads", "Output"),
        ("exposure", "Light"),
        ("time", "Input"),
    ] {
        assert_eq!(group_of(flag), heading, "{flag}");
    }
    let top = sandbox.run(&["--help"]).stdout;
    for group in ["Pictures:", "Files:", "Learning:", "Options:", "Examples:"] {
        assert!(top.contains(&format!("\n{group}\n")), "{group}: {top}");
    }
}

/// Attempts by users of f3d, Blender or ImageMagick, and the advice they get.
#[test]
fn observed_habits_get_advice() {
    let sandbox = sandbox_with_teapot("tried_habits");
    std::fs::create_dir(sandbox.path_of("empty")).expect("a folder");
    for (words, told) in [
        (&["render", "models/*.glb"][..], "this pattern matches no file"),
        (
            &["render", "https://a.org/a.glb"],
            "download the file first, as in `curl -O https://a.org/a.glb`",
        ),
        (&["render", "teapot.glb", "--ambient-occlusion", "on"], "takes no value: omit `on`"),
        (&["render", "teapot.glb", "-o", "."], ". is a folder\n  = help: name a file in it"),
        (
            &["render", "teapot.glb", "--view", "front,top"],
            "`--view` takes one direction; `--views front,top` renders a picture from each",
        ),
        (
            &["render", "teapot.glb", "--compare", "a.png", "--tolerance", "1%"],
            "invalid value '1%' for '--tolerance': expected a whole number, without a unit",
        ),
        (
            &["animate", "teapot.glb", "--turntable", "--frames", "0", "-o", "a.gif"],
            "invalid value '0' for '--frames': expected a whole number from 1 to 100000",
        ),
        (
            &["info", "teapot.glb", "teapot.glb"],
            "`alberti info` reads one file, and `teapot.glb` is a second file",
        ),
        (&["compare", "a.png", "b.png"], "`magick compare a.png b.png difference.png`"),
        (&["sheet", "teapot.glb", "--size", "800x600"], "`--paper a4` sets the page size"),
        (&["batch", "nothere", "--out-dir", "th"], "failed: nothere: the file does not exist"),
        (&["render", "+Iteapot.glb", "+W64", "+Oo.png"], "a flag begins with `--`"),
        (&["batch", "empty", "-o", "thumbs"], "use `--out-dir thumbs`"),
        (&["batch", "empty", "--out-dir", "th"], "warning: nothing to draw"),
        (&["thumbnailer", "-s", "128", "teapot.glb", "t.png"], "--size 128` sets the side length"),
        (
            &["render", "teapot.glb", "--size=8x8", "--background", "transparent", "-o", "a.jpg"],
            "a JPEG has no transparency",
        ),
        (
            &[
                "animate",
                "teapot.glb",
                "--turntable",
                "--size=8x8",
                "--frames=2",
                "--fps=1000",
                "-o",
                "t.gif",
            ],
            "viewers slow down a GIF with more than 50 frames per second",
        ),
        (&["render", "teapot.glb", "--output-dir", "out"], "a template names the outputs"),
        (&["version"], "run `alberti --version`"),
    ] {
        let run = sandbox.run(words);
        assert!(tells(&run.stderr, told), "{words:?}: {}", run.stderr);
    }
}

/// Arguments of `alberti render teapot.glb`, and the advice for them.
const FLAGS_OF_RENDER: &[(&[&str], &str)] = &[
    (&["-x"], "for axes, use `--overlay axes`; a format needs no flag"),
    (&["--threads", "0"], "omit the flag to use all processors"),
    (&["--camera=0,0,5"], "to place a camera, use `--eye 0,0,5 --target 0,0,0`"),
    (&["--camera-view-up", "0,0,1"], "use `--view-up 0,0,1 --eye 4,3,6 --target 0,0,0`"),
    (&["--focal-length", "50"], "use `--fov 27`, the vertical angle of view of a 50 mm lens"),
    (&["--max-size=100"], "`--max-file-bytes 100MiB`"),
    (&["--shadow", "off"], "use `--shadows off`"),
    (&["--view-transform", "AgX"], "use `--tone-mapping agx`"),
    (&["--ambient-occlusion=true"], "`--ambient-occlusion` takes no value: omit `=true`"),
    (&["--near", "0.1"], "the near and far planes are placed around the model"),
    (
        &["--scene", "main.ron"],
        "to render a scene file, make it the input: `alberti render main.ron`",
    ),
    (&["--size", "1080p"], "tip: write `--size 1920x1080`"),
    (&["--background", "0xff0000"], "tip: write `--background '#ff0000'`"),
    (&["--background", "trasparent"], "tip: write `--background transparent`"),
    (&["--background", "0,0,0,0"], "tip: write `--background transparent`"),
    (&["--background", "a.jpg"], "`image: (background: Picture(path: \"a.jpg\"))`"),
    (&["--environment", "a.exr"], "`magick a.exr a.hdr`"),
    (&["--samples", "128"], "tip: write `--samples 16`"),
    (&["--zoom", "50%"], "tip: write `--zoom 0.5`"),
    (&["--size", "512"], "tip: write `--size 512x512`"),
    (&["--time", "1.5s"], "tip: write `--time 1.5`"),
    (&["--scalar-range", "0:100"], "tip: write `--scalar-range 0,100`"),
    (&["--compare", "none.png"], "cannot compare with none.png: the file does not exist"),
    (&["--compare", "text.png"], "cannot compare with text.png: it is not a PNG file"),
    (&["--size", "64", "48"], "tip: write `--size 64x48`"),
    (&["--eye", "3", "-2", "5"], "`--eye` takes one value: write `--eye 3,-2,5`"),
    (&["--eye", "3,2,5", "--look-at", "0,1,0"], "use `--target 0,1,0`\n"),
    (&["--lens", "35"], "use `--fov 37.8`, the vertical angle of view of a 35 mm lens"),
    (&["--fov", "50mm"], "tip: write `--fov 27`"),
    (&["--scale", "10%"], "tip: write `--scale 0.1`"),
    (&["--quality", "80%"], "write `--quality 80`"),
    (&["--up", "-Z"], "to turn a model over, use `rotation_degrees`"),
    (&["--view", "front-left"], "tip: for other directions, use angles, as in `--azimuth 45"),
    (&["--scalar-coloring"], "the flag here is `--scalars`, as in `--scalars temperature`"),
    (&["out.tiff"], "TIFF output is not supported"),
    (&["--json", "out.json"], "redirect its report, as in `--json > out.json`"),
    (&["--background"], "`#`, which starts a comment in a shell"),
    (&["--format", "OPEN_EXR"], "`--passes depth --pass-format exr"),
    (&["-o", "//out/render_", "--format=png"], "write -o out/render_"),
    (&["teapot.glb", "-o", "out/a.png"], "use a template, as in -o 'out/{stem}_{index}.png'"),
    (&["--resolution-percentage", "50"], "use `--scale 0.5`"),
    (&["--export-type=pdf"], "use `--format pdf`"),
    (&["-Tsvg"], "use `--format svg`"),
    (&["--export-dpi=300"], "`alberti sheet model.glb --dpi 300 -o sheet.png`"),
    (
        &["--background", "#FF000080"],
        "a background color has no alpha; write `--background '#FF0000'`",
    ),
    (&["-hide_banner"], "only warnings and errors are printed"),
    (&["--actions", "x"], "`alberti render --help` lists its flags"),
    (&["-o", "PNG32:a.png"], "write `--format png -o a.png`"),
    (&["--camera-rotation-x", "3"], "`alberti render --help` lists its flags"),
    (&["--size", "64", "x", "48"], "tip: write `--size 64x48`"),
    (&["-b", "ffffff"], "`--background white` is the color behind the model"),
    (&["--light=off"], "use `--light-intensity 0`"),
    (&["--view=axes,scales"], "invalid value 'axes,scales'"),
    (&["--views", "front,top", "-o", "a.png"], "use a template, as in -o '{stem}_{view}.png'\n"),
    (&["--paper", "a4"], "`alberti sheet model.glb --paper a4` draws on paper"),
    (&["-a"], "`--samples 8` smooths edges"),
    (&["-s", "1"], "`--size 1920x1080` sets the size in pixels, and `--scalars temperature`"),
    (&["--colour", "white"], "`--background white` is the color behind the model"),
    (&["--size", "50%"], "`--scale 0.5` scales the width and height"),
    (&["--background", "rgba(255,255,255,0.5)"], "a background color has no alpha"),
    (&["-w", "64", "-h", "48"], "use `--size 64x48`"),
    (&["-h", "48"], "`--size 1920x1080` sets the size"),
    (&["--width", "64", "--height", "48"], "use `--size 64x48`"),
    (&["--view", "45,30"], "for angles, use `--azimuth 45 --elevation 30`"),
    (&["--elev", "30"], "use `--elevation 30`"),
    (&["--tone", "aces"], "did you mean `--tone-mapping`?"),
    (&["-ss", "1.5"], "use `--time 1.5`"),
    (&["--figsize", "8,6"], "sizes are in pixels"),
    (&["--camera", "perspective"], "`--projection` for the projection"),
    (&["--up", "0,0,1"], "tip: write `--up z`"),
    (&["--color", "red"], "`--color` sets when messages are colored"),
    (&["--output-dir", "out/"], "as in `-o 'out/{stem}.png'`"),
    (&["-o", "out/"], "is a folder"),
    (&["\u{2014}size", "64x48"], "it begins with a dash; flags begin with two hyphens"),
    (&["-o", "a.exr"], "`--passes depth --pass-format exr -o picture.png`"),
    (&["--qwerty"], "`--qwerty` is not a flag of `alberti render`; `alberti render --help` lists"),
    (&["--samplse", "4"], "did you mean `--samples`?"),
];

/// Command lines, and the advice for them.
const COMMAND_LINES: &[(&[&str], &str)] = &[
    (&["montage", "teapot.glb"], "which writes `index.html` next to the pictures"),
    (&["scene", "validate", "a.ron"], "run `alberti scene check a.ron`"),
    (&["sheet", "teapot.glb", "--scale", "50%"], "tip: write `--scale 1:2`"),
    (&["teapot.glb", "-o", "a.png"], "run `alberti render teapot.glb -o a.png`"),
    (&["rendr", "teapot.glb"], "`rendr` is not a command of `alberti`; did you mean `render`?"),
    (&["man", "rendr"], "did you mean `render`?"),
    (&["-v"], "`alberti --version` prints the version"),
    (&["sheet", "teapot.glb", "--format", "svg"], "as in `-o sheet.pdf`, so omit it"),
    (&["info", "-i", "teapot.glb"], "as in `alberti info model.glb`"),
    (&["animate", "teapot.glb", "--frames", "1..10", "-o", "a.gif"], "write `--frames 10`"),
    (&["animate", "teapot.glb", "-o", "film"], "missing file extension"),
    (&["animate", "teapot.glb", "-ss", "1", "-o", "a.gif"], "use `--from 1`"),
    (&["render", "lfs.glb"], "this is a Git LFS pointer"),
    (&["render", "page.glb"], "this is a web page, which is not supported; download the model"),
    (&["batch", "teapot.glb", "--out-dir", "a", "-j4"], "use `--threads 4`"),
    (&["animate", "teapot.glb", "-o", "f_%03d.png"], "use -o 'f_{frame:03}.png'"),
    (&["render"], "or `-` to read one from the standard input"),
    (&["render", "scene.yaml"], "`alberti scene init model.glb` writes one"),
    (&["animate", "teapot.glb", "a.gif"], "run `alberti animate teapot.glb -o a.gif`"),
    (&["explore", "teapot.glb", "8080"], "use `--port 8080`"),
    (&["render", "scene.ron"], "scene.ron: the file does not exist"),
    (&["check", "teapot.glb", "-o", "a.txt"], "`alberti check model.glb > report.txt`"),
    (&["simplify", "teapot.glb"], "this program reads models and never changes them"),
    (&["-o", "a.png", "teapot.glb"], "flags come after the command"),
    (&["-v"], "`alberti --version` prints the version"),
    (&["sheet", "teapot.glb", "--format", "svg"], "as in `-o sheet.pdf`, so omit it"),
    (&["info", "-i", "teapot.glb"], "as in `alberti info model.glb`"),
    (&["animate", "teapot.glb", "--frames", "1..10", "-o", "a.gif"], "write `--frames 10`"),
    (&["animate", "teapot.glb", "-o", "film"], "missing file extension"),
    (&["render", "scene.ron"], "scene.ron: the file does not exist"),
    (&["explore", "--host", "0.0.0.0"], "the page is served to this machine only"),
];

/// Words and values from f3d, Blender, POV-Ray and ffmpeg that mean something else here.
#[test]
fn values_from_other_programs_are_translated() {
    let sandbox = sandbox_with_teapot("translated_values");
    sandbox.write_file("text.png", "not a picture");
    sandbox.write_file("scene.yaml", "models:\n  - path: teapot.glb\n");
    sandbox.write_file("lfs.glb", "version https://git-lfs.github.com/spec/v1\n");
    sandbox.write_file("page.glb", "<!DOCTYPE html>\n<title>Sign in</title>\n");
    for (words, told) in FLAGS_OF_RENDER {
        let run = sandbox.run(&[&["render", "teapot.glb"], *words].concat());
        assert!(run.code != 0 && tells(&run.stderr, told), "{words:?}: {}", run.stderr);
    }
    let unlike = sandbox.run(&["render", "teapot.glb", "--style", "foo"]);
    assert!(!unlike.stderr.contains("tip:"), "{}", unlike.stderr);
    for (words, told) in COMMAND_LINES {
        let run = sandbox.run(words);
        assert!(run.code != 0 && tells(&run.stderr, told), "{words:?}: {}", run.stderr);
    }
}

/// An action that is probably unintended is reported.
#[test]
fn flags_without_effect_cause_warnings() {
    let sandbox = sandbox_with_teapot("idle_flags");
    let film = ["animate", "teapot.glb", "--turntable", "--frames=2", "--size=8x8", "-o", "a.gif"];
    let run = sandbox.run(&[&film[..], &["--to", "1"]].concat());
    assert!(run.stderr.contains("a turntable has no times"), "{}", run.stderr);
    let run = sandbox.run(&["render", "teapot.glb", "--size=8x8", "--format=JPEG", "-o", "a.png"]);
    assert_eq!(
        run.stderr,
        "warning: a.png contains JPG, because --format overrides the file extension\n"
    );
    let run = sandbox.run(&["render", "teapot.glb", "--size=8x8", "--fov", "0.785"]);
    assert_eq!(run.code, 0);
    assert!(run.stderr.contains("if the value is in radians, write --fov 45"), "{}", run.stderr);
    let run = sandbox.run(&["render", "teapot.glb", "--size=8x8", "--view", "Front"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let render = ["render", "teapot.glb", "--size=8x8"];
    let told = sandbox.stderr_with_output_in("a.png", &render);
    let expected = "the picture is written to teapot.png, not to the standard output";
    assert!(told.contains(expected), "{told}");
    assert_eq!(sandbox.stderr_with_output_in("a.log", &render), "");
    std::fs::create_dir(sandbox.path_of("scenes")).expect("a folder");
    let run = sandbox.run(&["scene", "init", "teapot.glb", "-o", "scenes/teapot.ron"]);
    assert!(run.stderr.ends_with("need --allow-outside .\n"), "{}", run.stderr);
}

/// Scenes in place of models and models in place of scenes, and syntax from other languages instead
/// of RON.
#[test]
fn scenes_in_other_languages_get_advice() {
    let sandbox = sandbox_with_teapot("tried_scenes");
    sandbox.write_file("scene.ron", "# a comment\nScene(models: [(path: \"teapot.glb\")])\n");
    sandbox.write_file("pov.ron", "camera { location <0, 2, -3> }\nsphere { <0, 1, 2>, 2 }\n");
    sandbox.write_file("json.ron", "{\"models\": [{\"path\": \"teapot.glb\"}]}\n");
    sandbox.write_file("yaml.ron", "models:\n  - path: teapot.glb\n");
    sandbox.write_file("quoted.ron", "Scene(models: [(path: 'teapot.glb')])\n");
    let scene = |field: &str| format!("Scene(models: [(path: \"teapot.glb\")], {field})\n");
    sandbox.write_file("hash.ron", scene("image: (background: Color(#ff8800))"));
    sandbox.write_file("number.ron", scene("image: (background: Color(0xff8800))"));
    sandbox.write_file("light.ron", scene("lights: [(type: \"sun\", strength: 3.0)]"));
    sandbox.write_file("turned.ron", scene("camera: (rotation: (60, 0, 45))"));
    sandbox.write_file("frame.ron", scene("frame: 12"));
    sandbox.write_file("exposure.ron", scene("exposure: 1.0"));
    sandbox.write_file("size.ron", scene("image: (width: 64, height: 48)"));
    sandbox.write_file("type.ron", scene("style: Style(Toon())"));
    sandbox.write_file("bare.ron", "Scene(models: [Model(\"teapot.glb\")])\n");
    sandbox.write_file("lower.ron", "Scene(models: [model(path: \"teapot.glb\")])\n");
    sandbox.write_file("scene.json", "{\"models\": [\"teapot.glb\"]}\n");
    for (words, told) in [
        (&["scene", "check", "hash.ron"][..], "write the color in quotation marks: \"#ff8800\""),
        (&["scene", "check", "number.ron"], "write the color in quotation marks: \"#ff8800\""),
        (
            &["scene", "check", "light.ron"],
            "write one of Directional(…), Point(…), Spot(…), FromModels",
        ),
        (&["scene", "check", "turned.ron"], "a camera has no rotation angles"),
        (
            &["scene", "check", "frame.ron"],
            "to choose a moment of an animation, set a model's `time`",
        ),
        (&["scene", "check", "exposure.ron"], "write it as image: (exposure_ev: …)"),
        (&["scene", "check", "size.ron"], "write the size as size: (640, 480)"),
        (&["scene", "check", "type.ron"], "remove `Style(…)` and write Toon()"),
        (&["scene", "check", "bare.ron"], "write Model(path: \"teapot.glb\")"),
        (&["scene", "check", "lower.ron"], "write Model(…), or just (…)"),
        (&["render", "scene.json"], "if this is a scene, write it in RON"),
        (&["info", "scene.ron"], "this is a scene, not a model"),
        (&["scene", "check", "teapot.glb"], "teapot.glb is not a scene"),
        (&["scene", "check", "scene.ron"], "start comments with `//`"),
        (&["scene", "check", "pov.ron"], "pov.ron: 1 mistake"),
        (&["scene", "check", "json.ron"], "this looks like JSON"),
        (&["scene", "check", "yaml.ron"], "this looks like YAML"),
        (
            &["scene", "check", "quoted.ron"],
            "write strings in double quotation marks: \"teapot.glb\"",
        ),
    ] {
        let run = sandbox.run(words);
        let shown = run.stderr + &run.stdout;
        assert!(shown.contains(told), "{words:?}: {shown}");
    }
}
