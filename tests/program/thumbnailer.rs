//! `alberti thumbnailer`: the files it installs, its pictures, and its limits.

use crate::meshes::stl_box;
use crate::sandbox::{RunResult, Sandbox};
use std::fs::File;
use std::io::Read as _;
use std::path::Path;

/// Returns the files below a folder, as paths relative to it, sorted.
fn files_below(folder: &Path) -> Vec<String> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        for entry in std::fs::read_dir(next).into_iter().flatten().flatten() {
            let path = entry.path();
            let name = path.strip_prefix(folder).expect("a path below the folder").to_owned();
            if path.is_dir() { folders.push(path) } else { found.push(name.display().to_string()) }
        }
    }
    found.sort();
    found
}

const ENTRY: &str = "thumbnailers/alberti.thumbnailer";
const MIME_TYPES: &str = "mime/packages/alberti.xml";

/// Checks that the file is refused with this message, and that only `files` remain.
fn assert_refuses(sandbox: &Sandbox, arguments: &[&str], words: &str, files: &[&str]) {
    let run = sandbox.run(&[&["thumbnailer"], arguments].concat());
    assert_eq!(run.code, 1, "{arguments:?}: {}", run.stderr);
    assert!(run.stderr.starts_with("error: "), "{arguments:?}: {}", run.stderr);
    assert!(run.stderr.contains(words), "{arguments:?}: {}", run.stderr);
    assert_eq!(sandbox.file_names(), files, "{arguments:?}");
}

#[test]
fn both_files_are_installed_for_a_user_and_removed_again() {
    let sandbox = Sandbox::new("thumbnailer_install");
    let data = sandbox.path_of("data");
    let run = |flag: &str| {
        let run = sandbox.run_with_variable(("XDG_DATA_HOME", &data), &["thumbnailer", flag]);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{flag}");
        run.stdout
    };
    for _ in 0..2 {
        let said = run("--install");
        for name in [ENTRY, MIME_TYPES] {
            let path = data.join(name);
            assert!(path.is_file(), "{name}");
            assert!(said.contains(&format!("wrote {}\n", path.display())), "{said}");
        }
        // If update-mime-database is installed, the new database has the mesh formats, one of which
        // Debian's own database lacks.
        if said.contains("\nran update-mime-database ") {
            let globs = std::fs::read_to_string(data.join("mime/globs2")).expect("a database");
            for glob in ["50:model/x-ply:*.ply", "60:model/obj:*.obj", "50:model/stl:*.stl"] {
                assert!(globs.contains(glob), "{globs}");
            }
        } else {
            assert!(said.contains("update-mime-database is not installed"), "{said}");
        }
    }
    let entry = std::fs::read_to_string(data.join(ENTRY)).expect("the entry");
    let program = alberti_tests::program_path().expect("the program");
    let exec = format!("Exec={} thumbnailer %i %o --size %s\n", program.display());
    assert!(entry.starts_with("[Thumbnailer Entry]\n") && entry.contains(&exec), "{entry}");
    std::fs::write(data.join("thumbnailers/other.thumbnailer"), "").expect("another entry");
    let said = run("--uninstall");
    assert!(said.starts_with("removed "), "{said}");
    let left = files_below(&data);
    assert!(left.contains(&"thumbnailers/other.thumbnailer".to_owned()), "{left:?}");
    assert!(!left.iter().any(|name| name.contains("alberti")), "{left:?}");
    assert!(run("--uninstall").contains("does not exist\n"));
}

#[test]
fn a_prefix_and_packages_get_the_same_files() {
    let sandbox = Sandbox::new("thumbnailer_prefix");
    let run = sandbox.run(&["thumbnailer", "--install", "--prefix", "usr"]);
    // If installed, update-mime-database notes that this folder is not searched.
    assert_eq!(run.code, 0, "{}", run.stderr);
    let read = |name: &str| {
        std::fs::read_to_string(sandbox.path_of("usr/share").join(name)).expect("a file")
    };
    let print = |what: &str| sandbox.run(&["thumbnailer", "--print", what]).stdout;
    assert_eq!(print("mime"), read(MIME_TYPES));
    let types = |entry: &str| entry.lines().last().map(str::to_owned);
    assert_eq!(types(&print("entry")), types(&read(ENTRY)));
    assert!(print("entry").contains("\nExec=alberti thumbnailer %i %o --size %s\n"));
    for wrong in [
        &["thumbnailer"][..],
        &["thumbnailer", "only.stl"],
        &["thumbnailer", "--install", "--uninstall"],
        &["thumbnailer", "a.stl", "a.png", "--install"],
        &["thumbnailer", "a.stl", "a.png", "--max-memory-bytes", "1MiB"],
        &["thumbnailer", "a.stl", "a.png", "--max-seconds", "0"],
    ] {
        assert_eq!(sandbox.run(wrong).code, 2, "{wrong:?}");
    }
}

#[test]
fn every_format_has_a_square_thumbnail() {
    let sandbox = Sandbox::new("thumbnailer_formats");
    sandbox.copy_model("teapot.glb");
    sandbox.write_file("part.stl", stl_box([40.0, 20.0, 30.0]));
    let tetrahedron = "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    // A missing library is skipped.
    sandbox.write_file("part.obj", format!("mtllib missing.mtl\n{tetrahedron}"));
    sandbox.write_file(
        "part.ply",
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n\
         property float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n\
         0 0 0\n2 0 0\n0 2 0\n0 0 2\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n",
    );
    let mut pictures = Vec::new();
    for input in ["teapot.glb", "part.stl", "part.obj", "part.ply"] {
        let output = format!("{input}.png");
        let run = sandbox.run(&["thumbnailer", input, &output, "--size", "64"]);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{input}");
        let (width, height, pixels) = sandbox.read_picture(&output);
        assert_eq!((width, height), (64, 64), "{input}");
        let shown = pixels.iter().filter(|pixel| pixel[3] == 255).count();
        assert!((400..4000).contains(&shown), "{input}: {shown} pixels");
        pictures.push(pixels);
    }
    assert!(pictures[2] == pictures[3], "the same solid in two formats");
}

#[test]
fn lines_in_thumbnails_are_thin_enough_to_distinguish() {
    let sandbox = Sandbox::new("thumbnailer_lines");
    sandbox.write_file("box.stl", stl_box([1.0; 3]));
    // A hundred boxes side by side: at full line width, everything would be black.
    let scene = "Scene(
        models: [(path: \"box.stl\", instances: Grid(count: (10, 1, 10), step: (1.5, 1, 1.5)))],
        style: Lines(width: Mm(0.7)), image: (size: (1600, 1600)),
    )";
    sandbox.write_file("boxes.ron", scene);
    let run = sandbox.run(&["thumbnailer", "boxes.ron", "boxes.png", "--size", "128"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let (.., pixels) = sandbox.read_picture("boxes.png");
    let bright = pixels.iter().filter(|pixel| pixel[0] > 128).count();
    let dark = pixels.iter().filter(|pixel| pixel[0] < 200).count();
    assert!(bright > pixels.len() / 2, "{bright} of {} pixels are bright", pixels.len());
    assert!(dark > pixels.len() / 50, "{dark} of {} pixels are dark", pixels.len());
}

#[test]
fn an_empty_file_is_filled_in_place() {
    let sandbox = Sandbox::new("thumbnailer_in_place");
    sandbox.copy_model("crate.glb");
    // As thumbnail services do, the test creates the file for the program and reads it through the
    // same handle.
    let options = File::options().read(true).write(true).create_new(true).to_owned();
    let mut file = options.open(sandbox.path_of("out.png")).expect("an empty file");
    let run = sandbox.run(&["thumbnailer", "crate.glb", "out.png", "--size", "32"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let mut bytes = Vec::new();
    file.read_to_end(&mut bytes).expect("the picture");
    assert!(bytes.starts_with(b"\x89PNG"), "{} bytes", bytes.len());
    assert_eq!(std::fs::read(sandbox.path_of("out.png")).expect("the same file"), bytes);
    assert_eq!(sandbox.file_names(), ["crate.glb", "out.png"]);
}

#[test]
fn broken_and_huge_inputs_end_without_a_picture() {
    let sandbox = Sandbox::new("thumbnailer_hostile");
    let part = "o.png";
    let inputs: [(&str, &[u8], &str); 5] = [
        ("a.stl", b"", ""),
        ("b.glb", b"glTF but not really", ""),
        ("c.obj", b"v 0 0 0\nf 1 2 3\n", ""),
        (
            "d.ply",
            b"ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\n\
              property float y\nproperty float z\nend_header\n",
            "",
        ),
        ("e.3mf", b"PK\x03\x04\0\0\0\0", ""),
    ];
    inputs.iter().for_each(|(name, content, _)| sandbox.write_file(name, content));
    // A sparse file, which occupies far less space on the disk than its size.
    File::create(sandbox.path_of("f.stl")).and_then(|file| file.set_len(1 << 36)).expect("a file");
    let mut facets = vec![0; 80];
    facets.extend(400_000_u32.to_le_bytes());
    facets.resize(84 + 50 * 400_000, 0);
    sandbox.write_file("g.stl", facets);
    let names = ["a.stl", "b.glb", "c.obj", "d.ply", "e.3mf", "f.stl", "g.stl"];
    for (input, _, words) in inputs {
        assert_refuses(&sandbox, &[input, part], words, &names);
    }
    assert_refuses(&sandbox, &["missing.stl", part], "missing.stl", &names);
    assert_refuses(&sandbox, &[".", part], "", &names);
    let help = "raise --max-memory-bytes";
    assert_refuses(&sandbox, &["f.stl", part], help, &names);
    assert_refuses(&sandbox, &["g.stl", part, "--max-memory-bytes", "64MiB"], help, &names);
    sandbox.write_file(part, "the old picture");
    let names = ["a.stl", "b.glb", "c.obj", "d.ply", "e.3mf", "f.stl", "g.stl", part];
    assert_refuses(&sandbox, &["a.stl", part], "", &names);
    let old = std::fs::read_to_string(sandbox.path_of(part)).expect("the old picture");
    assert_eq!(old, "the old picture");
}

#[test]
fn an_input_that_never_arrives_times_out() {
    let sandbox = Sandbox::new("thumbnailer_time");
    let mut child = sandbox.start(&["thumbnailer", "-", "out.png", "--max-seconds", "1"]);
    // The pipe is held open: the program waits for bytes, and the wait cannot be canceled.
    let pipe = child.stdin.take();
    let run = RunResult::of(child.wait_with_output().expect("the program ends"));
    drop(pipe);
    assert_eq!(run.code, 1);
    assert_eq!(run.stderr, "error: timed out after 1 s; raise --max-seconds\n");
    assert_eq!(sandbox.file_names(), [""; 0]);
}

#[cfg(target_os = "linux")]
#[test]
fn the_system_kills_a_thumbnailer_that_needs_more_memory() {
    let sandbox = Sandbox::new("thumbnailer_memory");
    sandbox.copy_model("crate.glb");
    let flags = ["--size", "4096", "--max-memory-bytes", "64MiB"];
    let child = sandbox.start(&[&["thumbnailer", "crate.glb", "out.png"], &flags[..]].concat());
    let output = child.wait_with_output().expect("the program ends");
    assert!(!output.status.success(), "the pixels by themselves take 64 MiB");
    assert_eq!(sandbox.file_names(), ["crate.glb"]);
}
