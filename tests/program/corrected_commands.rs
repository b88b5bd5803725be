//! The command lines that messages suggest: they keep everything that was right, and they run.

use crate::sandbox::Sandbox;

/// Returns the command in a message: the tip with the whole command, or the command to run.
fn suggested_command(message: &str) -> Option<&str> {
    let starts = ["the whole command is `alberti ", "run `alberti "];
    let rest = starts.iter().find_map(|start| message.split_once(start))?.1;
    rest.split('`').next()
}

/// Wrong command lines, and the commands that are suggested.
const CORRECTED: &[(&str, &str)] = &[
    ("render crate.glb --size 8x8 a.png", "render crate.glb --size 8x8 -o a.png"),
    ("convert crate.glb -resize 8x8 b.png", "render crate.glb --size 8x8 -o b.png"),
    (
        "crate.glb --resolution 9,8 --bg-color red --output-file c.png",
        "render crate.glb --size 9x8 --background red --output c.png",
    ),
    (
        "render crate.glb --width 9 --height 8 --wireframe -o d.png",
        "render crate.glb --size 9x8 --style wireframe -o d.png",
    ),
    (
        "render crate.glb --camera-position 4,3,6 --camera-focal-point 0,1,0 --bg 1,1,1",
        "render crate.glb --eye 4,3,6 --target 0,1,0 --background '#ffffff'",
    ),
    (
        "render crate.glb --style cel --zoom 2x --size 9 8",
        "render crate.glb --style toon --zoom 2 --size 9x8",
    ),
    ("--size 8x8 render crate.glb", "render crate.glb --size 8x8"),
    ("--size 8x8 crate.glb", "render --size 8x8 crate.glb"),
    (
        "animate crate.glb --turntable --frames 2 --size 8x8 t.gif",
        "animate crate.glb --turntable --frames 2 --size 8x8 -o t.gif",
    ),
    (
        "render crate.glb -antialias -resize 8x8 --backgroud white e.png",
        "render crate.glb --samples 8 --size 8x8 --background white -o e.png",
    ),
    (
        "montage crate.glb lamp.glb -geometry 8x8 sheet.png",
        "batch --out-dir pictures crate.glb lamp.glb --size 8x8",
    ),
    (
        "mogrify -path thumbs -thumbnail 9x9 crate.glb",
        "batch --out-dir thumbs --size 9x9 crate.glb",
    ),
    (
        "render crate.glb -xgq --size 8",
        "render crate.glb --overlay axes --overlay grid --ambient-occlusion --size 8x8",
    ),
    ("-b crate.glb -o //r_#### -f 1", "render crate.glb -o r.png"),
    (
        "animate crate.glb --turntable -f 1..3 --resolution 8x8 -o f_{frame}.png",
        "animate crate.glb --turntable --frames 3 --size 8x8 -o 'f_{frame}.png'",
    ),
    (
        "sheet crate.glb -density 90 -page A4 -o s.png",
        "sheet crate.glb --dpi 90 --paper a4 -o s.png",
    ),
];

#[test]
fn suggested_commands_keep_the_right_flags_and_run() {
    let sandbox = Sandbox::new("corrected_commands");
    sandbox.copy_model("crate.glb");
    sandbox.copy_model("lamp.glb");
    for (call, suggested) in CORRECTED {
        let words: Vec<&str> = call.split(' ').collect();
        let refused = sandbox.run(&words);
        assert_eq!(refused.code, 2, "{call}: {}", refused.stderr);
        assert_eq!(suggested_command(&refused.stderr), Some(*suggested), "{}", refused.stderr);
        let suggested = suggested.replace('\'', "");
        let words: Vec<&str> = suggested.split(' ').collect();
        let run = sandbox.run(&words);
        assert_eq!(run.code, 0, "{suggested}: {}", run.stderr);
    }
}

#[test]
fn a_mistake_without_a_single_remedy_gets_no_whole_command() {
    let sandbox = Sandbox::new("uncorrected_commands");
    sandbox.copy_model("crate.glb");
    for call in [
        "render crate.glb --resolution 8x8 --verbose",
        "render crate.glb --resolution 8x8 --nonsense",
        "render crate.glb --resolution 8x8 --tile 3",
        "render crate.glb --animation-index=-1 --resolution 8x8",
        "render crate.glb --ortho-scale 4 --resolution 8x8",
        "compare crate.glb crate.glb difference.png",
        "render crate.glb --camera-view-angle 45 --camera-orthographic",
        "animate crate.glb --turntable --frame-start 1 --frame-end 9 -o turn.mp4",
        "render crate.glb --resolution 8x8 --bg white -o frame_####.png",
    ] {
        let words: Vec<&str> = call.split(' ').collect();
        let refused = sandbox.run(&words);
        assert_eq!(refused.code, 2, "{call}: {}", refused.stderr);
        assert!(!refused.stderr.contains("whole command"), "{call}: {}", refused.stderr);
    }
}
