//! `alberti info`.

use crate::bench::Bench;

#[test]
fn a_model_is_described_line_by_line() {
    let bench = Bench::new("info");
    bench.bring("crate.glb");
    let run = bench.run(&["info", "crate.glb"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    for subject in ["meshes", "shown", "bounds", "materials", "cameras", "extensions", "animations"]
    {
        assert!(run.stdout.contains(&format!("\n  {subject} ")), "{subject}: {}", run.stdout);
    }
    assert!(run.stdout.contains("triangles "), "{}", run.stdout);
}

#[test]
fn a_file_that_is_no_model_is_refused() {
    let bench = Bench::new("info_refused");
    bench.write("text.glb", "hello");
    let run = bench.run(&["info", "text.glb"]);
    assert_eq!((run.code, run.stdout.as_str()), (1, ""));
    assert!(run.stderr.contains("text.glb"), "{}", run.stderr);
}
