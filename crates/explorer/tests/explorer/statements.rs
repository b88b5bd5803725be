//! Checks the statements of the lessons against numbers that are computed here from the formulas.

use super::{consequences, explorer_with_models, facts, json};
use explorer::Explorer;
use serde_json::Value as Json;

fn close(actual: &Json, expected: f64) {
    let actual = actual.as_f64().expect("a number");
    assert!((actual - expected).abs() < 1e-6 * expected.abs().max(1.0), "{actual} {expected}");
}

fn degrees(slope: f64) -> f64 {
    libm::atan(slope).to_degrees()
}

fn numbers(values: &Json) -> Vec<f64> {
    let values = values.as_array().expect("a list");
    values.iter().map(|value| value.as_f64().expect("a number")).collect()
}

/// C64: for a fixed window, the angle is 2 atan((t − b) / 2n), and far changes only the clipping.
#[test]
fn near_changes_the_angle_of_a_frustum_and_far_only_clips() {
    let mut explorer = explorer_with_models();
    for near in [1.0, 2.0, 5.5, 11.0] {
        let facts = facts(&mut explorer, &format!("lesson=frustum&near={near}"));
        close(&facts["fov_y_degrees"], 2.0 * degrees(1.5 / near));
        close(&facts["fov_x_degrees"], 2.0 * degrees(2.4 / near));
    }
    let picture = |explorer: &mut Explorer, far: f64| {
        let query = format!("what=picture&size=80x50&lesson=frustum&far={far}");
        explorer.answer(&query).expect("a picture").bytes
    };
    // Behind the house, the far plane does not change a single pixel; within the house, it clips.
    let behind = picture(&mut explorer, 20.0);
    assert!(picture(&mut explorer, 60.0) == behind);
    assert!(picture(&mut explorer, 11.5) != behind);
    let [near, far] =
        [18.0, 60.0].map(|far| facts(&mut explorer, &format!("lesson=frustum&far={far}")));
    assert_eq!(near["fov_y_degrees"], far["fov_y_degrees"]);
}

/// C64, M12: left and right move the window. The true frustum keeps its apex at the eye; the
/// lesson's frustum moves it to ((l + r) / 2, (b + t) / 2).
#[test]
fn the_apex_moves_only_in_the_lessons_own_frustum() {
    let mut explorer = explorer_with_models();
    let window = "lesson=frustum&left=-1&right=3&bottom=-0.5&top=2";
    let sheared = facts(&mut explorer, window);
    let moved = facts(&mut explorer, &format!("{window}&apex=moved"));
    for (at, expected) in [0.0, 0.0, 0.0].into_iter().enumerate() {
        close(&sheared["apex_view"][at], expected);
    }
    for (at, expected) in [1.0, 0.75, 0.0].into_iter().enumerate() {
        close(&moved["apex_view"][at], expected);
    }
    assert_eq!(numbers(&sheared["window"]).len(), 4);
    close(&sheared["window"][0], -1.0);
    close(&moved["window"][1], 3.0);
    // With a centered window, both give the same picture.
    let picture = |explorer: &mut Explorer, apex: &str| {
        let query = format!("what=picture&size=80x50&lesson=frustum&apex={apex}");
        explorer.answer(&query).expect("a picture").bytes
    };
    assert!(picture(&mut explorer, "eye") == picture(&mut explorer, "moved"));
    let said = consequences(&mut explorer, &format!("{window}&apex=moved"));
    assert!(said.iter().any(|sentence| sentence.contains("moved to (1, 0.75)")), "{said:?}");
}

/// C62: a small field of view magnifies, a wrong aspect ratio distorts, and near and far only clip.
#[test]
fn a_small_field_of_view_enlarges_and_a_wrong_aspect_ratio_distorts() {
    let mut explorer = explorer_with_models();
    let ndc = |explorer: &mut Explorer, state: &str| {
        let state = json(explorer, &format!("what=state&lesson=perspective&{state}"));
        numbers(&state["journey"]["spaces"][4]["value"])
    };
    let usual = ndc(&mut explorer, "fov=40");
    let narrow = ndc(&mut explorer, "fov=20");
    let factor = libm::tan(20_f64.to_radians()) / libm::tan(10_f64.to_radians());
    assert!((narrow[1] / usual[1] - factor).abs() < 1e-9);
    let wide = ndc(&mut explorer, "aspect=3.2");
    assert!((wide[0] / usual[0] - 0.5).abs() < 1e-5 && (wide[1] - usual[1]).abs() < 1e-5);
    // Near and far do not affect x and y.
    for planes in ["near=1", "near=6", "far=60"] {
        let other = ndc(&mut explorer, planes);
        assert!((other[0] - usual[0]).abs() < 1e-12 && (other[1] - usual[1]).abs() < 1e-12);
    }
    let said = consequences(&mut explorer, "lesson=perspective&near=9");
    assert!(said.iter().any(|all| all.contains("clips the front corner")), "{said:?}");
    let clipped = facts(&mut explorer, "lesson=perspective&near=9");
    assert!(clipped["clipped_by"]["near"].as_u64() > Some(0));
}

/// Every triangle is inside, clipped or outside.
#[test]
fn every_triangle_is_counted_once() {
    let mut explorer = explorer_with_models();
    for near in [1.0, 7.0, 9.0, 11.0] {
        let facts = facts(&mut explorer, &format!("lesson=perspective&near={near}"));
        let counts = ["inside", "clipped", "outside"].map(|key| facts[key].as_u64());
        let sum: u64 = counts.into_iter().flatten().sum();
        assert_eq!(sum, 262);
    }
}

/// C65: the parallax of a point at distance D is e (1 − c / D).
#[test]
fn parallax_matches_the_formula_for_off_axis_pairs() {
    let mut explorer = explorer_with_models();
    let state = "lesson=stereo&eyes=0.5&convergence=10";
    let facts = facts(&mut explorer, state);
    let nearest = facts["model_near"].as_f64().expect("a distance");
    let parallax = 0.5 * (1.0 - 10.0 / nearest);
    let said = consequences(&mut explorer, state);
    let expected = format!("crossed parallax {}", (parallax.abs() * 1000.0).round() / 1000.0);
    assert!(said[0].contains(&expected), "{expected}: {said:?}");
}

/// C94: a parallel projection has no apex, and w stays 1.
#[test]
fn w_stays_1_in_an_orthographic_view() {
    let mut explorer = explorer_with_models();
    for lesson in ["ortho", "orthographic-volume"] {
        let state = json(&mut explorer, &format!("what=state&lesson={lesson}"));
        assert_eq!(state["facts"]["apex"], Json::Null);
        let clip = numbers(&state["journey"]["spaces"][3]["value"]);
        assert!((clip[3] - 1.0).abs() < 1e-12, "{clip:?}");
    }
}

/// Exercise 7: M_per (r, t, n, 1) = (n, n, n, n), so the corner is at (1, 1, 1).
#[test]
fn the_window_corner_maps_to_1_1_1() {
    let mut explorer = explorer_with_models();
    let state = json(&mut explorer, "what=state&lesson=exercises&exercise=7");
    for ndc in numbers(&state["journey"]["spaces"][4]["value"]) {
        assert!((ndc - 1.0).abs() < 1e-9, "{ndc}");
    }
}

/// C68: for n = 2 and f = 40, depth 0 is at 80/21, and the table runs from −1 to 1.
#[test]
fn the_middle_of_the_depth_range_is_at_the_harmonic_mean() {
    let mut explorer = explorer_with_models();
    let state = json(&mut explorer, "what=state&lesson=depth-table&near=2&far=40");
    let table = &state["depth_table"];
    close(&table["half_range_distance"], 80.0 / 21.0);
    let rows = table["rows"].as_array().expect("rows");
    close(&rows[0][1], -1.0);
    close(&rows[rows.len() - 1][1], 1.0);
    for row in rows {
        let distance = row[0].as_f64().expect("a distance");
        close(&row[1], -80.0 * 2.0 / (38.0 * distance) + 42.0 / 38.0);
    }
}

/// PE-1: the midpoint of the depths maps to (n² + f²) / (n + f).
#[test]
fn the_midpoint_of_the_depths_moves_toward_far() {
    let mut explorer = explorer_with_models();
    let said = consequences(&mut explorer, "lesson=midpoint-depth&n=-4&f=-40");
    let image = -((16.0_f64 + 1600.0) / 44.0 * 1000.0).round() / 1000.0;
    assert!(said[0].contains("z = -22") && said[0].contains(&image.to_string()), "{said:?}");
}

/// AX-1: the view is isometric at 45° and asin(1/√3), with factors of √(2/3).
#[test]
fn equal_foreshortening_is_isometric() {
    let mut explorer = explorer_with_models();
    let said = consequences(&mut explorer, "lesson=axonometric");
    assert!(
        said[0].contains("x 0.816, y 0.817, z 0.816 (isometric)")
            || said[0].contains("x 0.816, y 0.816"),
        "{said:?}"
    );
    let said = consequences(&mut explorer, "lesson=axonometric&alpha=20&beta=50");
    assert!(said[0].contains("trimetric"), "{said:?}");
}

/// C36: some corners are behind the eye, so the order of clipping and dividing matters.
#[test]
fn a_floor_that_extends_behind_the_eye_has_corners_with_negative_w() {
    let mut explorer = explorer_with_models();
    let behind = facts(&mut explorer, "lesson=tear&z=0")["behind_eye"].as_u64();
    assert!(behind > Some(100), "{behind:?}");
    for what in ["picture", "volume", "drawing"] {
        let state = "size=60x60&samples=1&lesson=tear";
        let [torn, clipped] = ["divide", "clip"].map(|order| {
            explorer.answer(&format!("what={what}&{state}&order={order}")).expect("a picture")
        });
        assert!(torn != clipped, "{what}");
    }
    let torn = json(&mut explorer, "what=state&lesson=tear&order=divide");
    assert_eq!((&torn["scene"], &torn["command"]), (&Json::Null, &Json::Null));
    let error = explorer.answer("what=pick&lesson=tear&order=divide&pixel=9,9").expect_err("torn");
    assert_eq!(error.code, "nothing_there");
}

/// The floor is below the eye, so nothing may be above the horizon. Divided by a negative w, the
/// part behind the eye appears there.
#[test]
fn divided_first_the_floor_behind_the_eye_appears_above_the_horizon() {
    let mut explorer = explorer_with_models();
    let mut drawn_in_the_sky = |order: &str| {
        let query = format!("what=picture&size=64x40&samples=1&lesson=tear&order={order}");
        let pixels = explorer.answer(&query).expect("a picture").bytes;
        let sky = &pixels.as_chunks::<4>().0[..64 * 8];
        sky.iter().filter(|pixel| **pixel != [0xee, 0xf2, 0xf5, 0xff]).count()
    };
    assert_eq!(drawn_in_the_sky("clip"), 0);
    assert!(drawn_in_the_sky("divide") > 100);
}

/// A triangle can be outside several planes, and a sentence explains this overlap.
#[test]
fn overlapping_counts_are_explained() {
    let mut explorer = explorer_with_models();
    let said = consequences(&mut explorer, "lesson=tear");
    let facts = facts(&mut explorer, "lesson=tear");
    let [clipped, outside] = ["clipped", "outside"].map(|key| {
        let verb = if facts[key] == 1 { "is" } else { "are" };
        format!("{} {verb}", facts[key])
    });
    let totals = format!("in total, {clipped} clipped and {outside} entirely outside.");
    assert!(said.iter().any(|sentence| sentence.ends_with(&totals)), "{said:?}");
}

/// The point picked at a pixel projects to that pixel.
#[test]
fn picked_points_project_to_the_picked_pixel() {
    let mut explorer = explorer_with_models();
    for (lesson, pixel) in
        [("frustum", [300, 200]), ("viewport", [250, 200]), ("stereo", [480, 200])]
    {
        let query = format!("what=pick&lesson={lesson}&pixel={},{}", pixel[0], pixel[1]);
        let picked = json(&mut explorer, &query);
        let point = numbers(&picked["position"]);
        let steps = picked["explanation"]["steps"].as_array().expect("steps");
        assert!(steps.iter().any(|step| step["id"] == "clip" || step["id"] == "divide"));
        if lesson == "frustum" {
            let query =
                format!("what=state&lesson={lesson}&pin={},{},{}", point[0], point[1], point[2]);
            let state = json(&mut explorer, &query);
            let screen = numbers(&state["journey"]["spaces"][5]["value"]);
            let from_top = 400.0 - screen[1];
            assert!(
                (screen[0] - 300.5).abs() < 1.0 && (from_top - 200.5).abs() < 1.0,
                "{screen:?}"
            );
        }
    }
}

/// UN-2: the line of sight through the mouse hits the surface that is visible there.
#[test]
fn picking_hits_the_visible_surface() {
    let mut explorer = explorer_with_models();
    let said = consequences(&mut explorer, "lesson=picking&x=50&y=60");
    assert!(said[1].starts_with("It first hits the model at ("), "{said:?}");
    let said = consequences(&mut explorer, "lesson=picking&x=2&y=2");
    assert_eq!(said[1], "It misses the model.");
}

/// VP-1: x_s = x + (x_ndc + 1) w / 2, y_s = y + (y_ndc + 1) h / 2 from the bottom.
#[test]
fn screen_coordinates_start_at_the_viewport_corner() {
    let mut explorer = explorer_with_models();
    let query = "what=state&size=600x400&lesson=viewport&x=10&y=20&width=50&height=60";
    let spaces = json(&mut explorer, query)["journey"]["spaces"].take();
    let [ndc, screen] = [4, 5].map(|at| numbers(&spaces[at]["value"]));
    assert!((screen[0] - (60.0 + (ndc[0] + 1.0) * 150.0)).abs() < 1e-9, "{screen:?} {ndc:?}");
    assert!((screen[1] - (80.0 + (ndc[1] + 1.0) * 120.0)).abs() < 1e-9, "{screen:?} {ndc:?}");
}

/// IN-1: the point a fraction t along a segment maps to a fraction f(t) along the image.
#[test]
fn f_of_t_is_the_fraction_along_the_image() {
    let mut explorer = explorer_with_models();
    let mut seen = |t: f64| {
        let query = format!("what=state&lesson=exercises&exercise=11&t={t}");
        let spaces = json(&mut explorer, &query)["journey"]["spaces"].take();
        numbers(&spaces[5]["value"])
    };
    let [a, b, middle] = [0.0, 1.0, 0.5].map(&mut seen);
    let fraction = (middle[0] - a[0]) / (b[0] - a[0]);
    let said = consequences(&mut explorer, "lesson=exercises&exercise=11&t=0.5");
    let expected = format!("f(t) = {}", (fraction * 1e4).round() / 1e4);
    assert!(fraction > 0.5 && said[0].contains(&expected), "{expected}: {said:?}");
}

/// OB-1, TWO-1, WV-2: numbers in the classical lessons.
#[test]
fn classical_lessons_state_the_expected_numbers() {
    let mut explorer = explorer_with_models();
    for (state, expected) in [
        ("lesson=oblique", "α = 45°: cavalier"),
        ("lesson=oblique&length=0.5", "α = 63.4°: cabinet"),
        ("lesson=oblique&length=0", "α = 90°: orthographic"),
        ("lesson=two-point&x=-2&z=3", "5 half heights apart"),
        ("lesson=window-viewport&window_width=8&window_height=4&width=100", "sx = sy = 80 pixels"),
        ("lesson=window-viewport&fit=stretch&width=100&height=100", "sx = 64 and sy = 66.67"),
        ("lesson=normalization&left=-1&right=3&near=2", "Shear: x + 0.5 z"),
    ] {
        let said = consequences(&mut explorer, state);
        assert!(said[0].contains(expected), "{state}: {said:?}");
    }
}
