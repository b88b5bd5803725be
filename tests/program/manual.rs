//! `alberti completions`, `alberti man`, and message colors.

use crate::sandbox::Sandbox;

#[test]
fn completions_have_the_commands_and_flags() {
    let sandbox = Sandbox::new("completions");
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let run = sandbox.run(&["completions", shell]);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{shell}");
        for word in ["render", "projection", "turntable", "overlay", "exercise"] {
            assert!(run.stdout.contains(word), "{shell}: {word}");
        }
        assert!(
            run.stdout == sandbox.run(&["completions", shell]).stdout,
            "{shell}: the two scripts are equal"
        );
    }
    assert_eq!(sandbox.run(&["completions", "cmd"]).code, 2);
}

#[test]
fn every_command_has_a_manual_page() {
    let sandbox = Sandbox::new("man");
    let run = sandbox.run(&["man"]);
    assert!(run.code == 0 && run.stdout.contains(".TH alberti 1"), "{}", run.stdout);
    let render = sandbox.run(&["man", "render"]).stdout;
    assert!(render.contains("alberti\\-render") && render.contains("\\-\\-size"), "{render}");
    assert_eq!(sandbox.run(&["man", "--out-dir", "pages"]).code, 0);
    let page = |name: &str| std::fs::read_to_string(sandbox.path_of("pages").join(name));
    for command in ["sheet", "info", "check", "animate", "batch", "explain", "matrix", "scene-init"]
    {
        assert!(
            page(&format!("alberti-{command}.1")).is_ok_and(|page| page.contains(".SH OPTIONS")),
            "{command}"
        );
    }
    assert_eq!(page("alberti-render.1").expect("the page"), render);
    let run = sandbox.run(&["man", "cook"]);
    assert!(run.code == 1 && run.stderr.contains("render, sheet"), "{}", run.stderr);
    assert!(!run.stderr.contains("batch-worker"), "{}", run.stderr);
}

#[test]
fn messages_are_colored_only_on_request() {
    let sandbox = Sandbox::new("colours");
    sandbox.write_file("scene.ron", "Scene(modles: [])");
    let stderr = |flags: &[&str]| sandbox.run(&[&["render", "scene.ron"], flags].concat()).stderr;
    let plain = stderr(&[]);
    assert!(plain.starts_with("error: unexpected field") && !plain.contains('\x1b'), "{plain}");
    assert_eq!(stderr(&["--color", "never"]), plain);
    let colored = stderr(&["--color", "always"]);
    assert!(colored.starts_with("\x1b[1;31merror\x1b[0m: "), "{colored:?}");
    let mut bare = String::new();
    for (number, part) in colored.split("\x1b[").enumerate() {
        bare.push_str(if number == 0 { part } else { part.split_once('m').expect("a color").1 });
    }
    assert_eq!(bare, plain, "the text is the same");
    let check = sandbox.run(&["scene", "check", "scene.ron", "--color", "always"]).stdout;
    assert!(check.contains("\x1b["), "{check:?}");
}
