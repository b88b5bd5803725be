//! Words of other programs on the command line: what people are told to type.

use crate::sandbox::Sandbox;

fn sandbox_with_teapot(name: &str) -> Sandbox {
    let sandbox = Sandbox::new(name);
    sandbox.copy_model("teapot.glb");
    sandbox
}

#[test]
fn flags_of_other_programs_lead_to_ours() {
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
        (&["-e"], "use `--overlay edges`"),
        (&["-b"], "it never opens a window; leave it out"),
        (&["--engine", "CYCLES"], "there is one renderer; `--style` chooses a look"),
        (
            &["--dpi", "300"],
            "`--size` gives the pixels; `alberti sheet model.glb --dpi 300` draws on paper, to scale",
        ),
    ] {
        let run = sandbox.run(&[&["render", "teapot.glb"], flags].concat());
        let name = flags[0].split('=').next().expect("a name");
        let expected = format!("error: `{name}` is not a flag of `alberti render`; {told}\n");
        assert_eq!((run.code, run.stderr), (2, expected), "{flags:?}");
    }
}

#[test]
fn habits_of_other_programs_do_not_make_wrong_files() {
    let sandbox = sandbox_with_teapot("foreign_habits");
    for (words, told) in [
        (
            &["render", "teapot.glb", "-quality", "80"][..],
            "`-quality` needs two hyphens here: `--quality`",
        ),
        (&["render", "teapot.glb", "out.jpg"], "run `alberti render teapot.glb -o out.jpg`"),
        (&["animate", "teapot.glb", "--turntable", "-o", "o.%04d.png"], "write 'o.{frame:04}.png'"),
        (&["animate", "teapot.glb", "--turntable", "-o", "o_####.png"], "write 'o_{frame:04}.png'"),
        (&["render", "teapot.glb", "--up", "-Y"], "invalid value '-Y' for '--up <AXIS>'"),
    ] {
        let run = sandbox.run(words);
        assert_ne!(run.code, 0, "{words:?}: {}", run.stderr);
        assert!(run.stderr.contains(told), "{words:?}: {}", run.stderr);
    }
    let files = std::fs::read_dir(sandbox.path_of(".")).expect("the folder").count();
    assert_eq!(files, 1, "only the model is there");
}

#[test]
fn tips_are_never_nonsense() {
    let sandbox = sandbox_with_teapot("tips");
    let unknown = sandbox.run(&["render", "teapot.glb", "--qwerty"]);
    assert!(!unknown.stderr.contains("tip:"), "{}", unknown.stderr);
    let cel = sandbox.run(&["render", "teapot.glb", "--style", "cel"]);
    assert!(cel.stderr.contains("'toon'\n"), "{}", cel.stderr);
    let misspelt = sandbox.run(&["render", "teapot.glb", "--enviroment", "sky"]);
    assert!(misspelt.stderr.contains("'--environment'"), "{}", misspelt.stderr);
}

#[test]
fn help_has_groups_that_people_know() {
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
