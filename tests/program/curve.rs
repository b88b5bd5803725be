//! `alberti curve depth` and `alberti demo wrap-around`: checks plots, tables and demonstrations
//! against their formulas.

use crate::drawings::{assert_succeeds, read_drawing};
use crate::sandbox::Sandbox;
use crate::vector_files::layer_bounds;

/// Returns the rows of a CSV table as numbers.
fn curve_csv(sandbox: &Sandbox, flags: &[&str]) -> Vec<[f64; 5]> {
    assert_succeeds(sandbox, &[&["curve", "depth", "-o", "out.csv"], flags].concat());
    let text = std::fs::read_to_string(sandbox.path_of("out.csv")).expect("a table");
    assert!(text.starts_with("distance,depth,reversed_depth,step,reversed_step\n"));
    let row = |line: &str| {
        let numbers: Vec<f64> = line.split(',').map(|word| word.parse().expect(word)).collect();
        <[f64; 5]>::try_from(numbers).expect("five numbers")
    };
    text.lines().skip(1).map(row).collect()
}

/// The lesson's table for near 2 and far 40 (C68); some values are compared as printed, to four
/// decimal places.
#[test]
fn the_lesson_table_is_reproduced() {
    let sandbox = Sandbox::new("curve_lesson");
    let lesson = ["--near", "2", "--far", "40", "--range", "minus-one-one"];
    let at = ["--distances", "2,3,4,5,6,8,10,12,14,16,18,20,25,30,35,40"];
    let rows = curve_csv(&sandbox, &[&lesson[..], &at].concat());
    assert_eq!(rows.len(), 16);
    for [distance, depth, reversed, ..] in rows {
        assert!((depth - (21.0 - 80.0 / distance) / 19.0).abs() < 1e-14, "{distance}: {depth}");
        assert!((depth + reversed).abs() < 1e-14);
    }
    let run = sandbox.run(&[&["curve", "depth"], &lesson[..], &at].concat());
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    for (distance, printed) in
        [("2", "-1.0000"), ("3", "-0.2982"), ("4", "0.0526"), ("5", "0.2632")]
    {
        let has = |line: &str| line.split_whitespace().take(2).eq([distance, printed]);
        assert!(run.stdout.lines().any(has), "{}", run.stdout);
    }
    assert!(run.stdout.contains("2FN/(F+N) = 3.8095"), "{}", run.stdout);
    assert_succeeds(&sandbox, &[&["curve", "depth", "-o", "out.md"], &lesson[..], &at].concat());
    let markdown = std::fs::read_to_string(sandbox.path_of("out.md")).expect("a table");
    assert!(markdown.contains("| 3 | -0.2982 | 0.2982 |"), "{markdown}");
}

/// In fixed point, a step is D²(F − N)/(F N) divided by the number of intervals in the range. In
/// floating point, it is the gap to the nearest f32, divided by the slope.
#[test]
fn steps_match_the_depth_formats() {
    let sandbox = Sandbox::new("curve_steps");
    let planes = ["--near", "0.1", "--far", "1000", "--distances", "0.15,1,10,250,950"];
    for (bits, parts) in [("16", 65_535.0), ("24", 16_777_215.0)] {
        for [distance, .., step, reversed] in
            curve_csv(&sandbox, &[&planes[..], &["--bits", bits]].concat())
        {
            let expected = distance * distance * 999.9 / 100.0 / parts;
            assert!(
                (step / expected - 1.0).abs() < 1e-9 && (reversed / expected - 1.0).abs() < 1e-9,
                "{distance}"
            );
        }
    }
    for [distance, depth, reversed, step, step_reversed] in
        curve_csv(&sandbox, &[&planes[..], &["--bits", "32f"]].concat())
    {
        let slope = 100.0 / 999.9 / (distance * distance);
        for (depth, step) in [(depth, step), (reversed, step_reversed)] {
            let rounded = depth as f32;
            let gaps = [rounded.next_up() - rounded, rounded - rounded.next_down()];
            let fits = gaps.iter().any(|gap| (step / (f64::from(*gap) / slope) - 1.0).abs() < 0.01);
            assert!(fits, "{distance}: {step}");
        }
    }
}

#[test]
fn the_curves_are_drawn_in_every_format() {
    let sandbox = Sandbox::new("curve_formats");
    for bits in ["24", "32f"] {
        let flags = ["curve", "depth", "--near", "0.1", "--far", "inf", "--bits", bits, "-o"];
        for name in ["out.svg", "out.pdf", "out.png"] {
            assert_succeeds(&sandbox, &[&flags[..], &[name]].concat());
        }
        let (page, layers) = read_drawing(&sandbox, "out.svg");
        assert_eq!(page, [297.0, 210.0]);
        for id in ["depth-normal", "depth-reversed", "step-normal", "step-reversed", "table"] {
            let [low, high] = layer_bounds(&layers, |layer| layer == id);
            assert!(low[0] > 0.0 && high[0] < page[0] && high[1] < page[1], "{id}");
        }
        // Both depth curves span the whole range and cross at its midpoint, at twice the near
        // distance.
        let [low, high] = layer_bounds(&layers, |layer| layer == "depth-axes");
        let mark = layers["depth-marks"][0][0][0];
        let part = (mark - low[0]) / (high[0] - low[0]);
        assert!((part - std::f64::consts::LOG10_2 / 4.0).abs() < 0.01, "{part}");
    }
}

/// On a linear axis, the mark for half the depth range is at its distance, 2FN/(F + N).
#[test]
fn the_distance_axis_can_be_linear() {
    let sandbox = Sandbox::new("curve_linear");
    let flags = ["curve", "depth", "--near", "2", "--far", "40", "-o", "out.svg"];
    for (more, expected) in [
        (&["--axis", "linear"][..], (80.0 / 21.0 - 2.0) / 38.0),
        // log(40/21) / log 20
        (&[], 0.215092),
    ] {
        assert_succeeds(&sandbox, &[&flags[..], more].concat());
        let (_, layers) = read_drawing(&sandbox, "out.svg");
        let [low, high] = layer_bounds(&layers, |layer| layer == "depth-normal");
        let mark = layers["depth-marks"][0][0][0];
        let part = (mark - low[0]) / (high[0] - low[0]);
        assert!((part - expected).abs() < 0.01, "{more:?}: {part}");
    }
}

/// C36: segments that extend behind the eye are torn in two if they are divided without clipping.
#[test]
fn the_wrap_around_is_shown_with_and_without_clipping() {
    let sandbox = Sandbox::new("wrap_around");
    assert_succeeds(&sandbox, &["demo", "wrap-around"]);
    let (_, layers) = read_drawing(&sandbox, "wrap-around.svg");
    let [_, frame] = layer_bounds(&layers, |id| id == "frames");
    let [top, _] = layer_bounds(&layers, |id| id == "frames");
    let horizon = 0.5 * (top[1] + frame[1]);
    let span = |id: &str| layer_bounds(&layers, |layer| layer == id);
    assert!(span("clipped-crossing")[0][1] > horizon && span("clipped-ahead")[0][1] > horizon);
    assert!(!layers.contains_key("clipped-behind"));
    let torn = span("divided-crossing");
    assert!(torn[0][1] < horizon && torn[1][1] > horizon, "{torn:?}");
    assert!(span("divided-behind")[1][1] < horizon);
    let first = std::fs::read(sandbox.path_of("wrap-around.svg")).expect("a drawing");
    assert_succeeds(&sandbox, &["demo", "wrap-around"]);
    assert!(first == std::fs::read(sandbox.path_of("wrap-around.svg")).expect("a drawing"));
    assert_succeeds(&sandbox, &["demo", "wrap-around", "-o", "wrap-around.html"]);
    let html = std::fs::read_to_string(sandbox.path_of("wrap-around.html")).expect("a page");
    assert!(html.contains("(1, 0, 3) has w = -3 and maps to (-0.433, 0.924)"), "{html}");
}

#[test]
fn errors_are_reported_and_leave_no_file() {
    let sandbox = Sandbox::new("curve_mistakes");
    let depth = |flags: &[&str]| sandbox.run(&[&["curve", "depth"], flags].concat());
    for (flags, message) in [
        (&["--near", "2", "--far", "1"][..], "near"),
        (&["--near", "0", "--far", "1"], "near"),
        (&["--near", "nan", "--far", "1"], "near"),
        (&["--near", "1", "--far", "2", "--distances", "0"], "distance"),
        (
            &["--near", "1", "--far", "2", "-o", "out.html"],
            "unsupported output format; use .svg, .pdf, .dxf, .png, .txt, .md, .csv or .json",
        ),
    ] {
        let run = depth(flags);
        let is_reported = run.stderr.starts_with("error: ") && run.stderr.contains(message);
        assert!(run.code == 1 && is_reported, "{flags:?}: {}", run.stderr);
    }
    for bits in ["0", "65", "16f", "many"] {
        let run = depth(&["--near", "1", "--far", "2", "--bits", bits]);
        assert!(run.code == 2 && run.stderr.contains("or 32f"), "{bits}: {}", run.stderr);
    }
    assert_eq!(depth(&["--near", "1"]).code, 2);
    assert_eq!(sandbox.run(&["demo", "wrap-around", "-o", "wrap-around"]).code, 1);
    assert_eq!(sandbox.run(&["demo"]).code, 2);
    assert_eq!(sandbox.file_names(), [""; 0]);
}
