//! Sheet fill and paper choice: views fill at least 45% of the drawing area, or no larger standard
//! scale fits in either orientation.

#[path = "../../../../tests/skip.rs"]
pub mod skip;

use super::boxes::{PAPERS, Random, box_model, sheet};
use super::lint::{faults, layer_extent};
use glam::{DVec2, DVec3};
use homog::Affine;
use import::{ImportOptions, load};
use model::ModelInstance;
use projection::SheetAngle;
use sheet::{ScaleLimit, Sheet, SheetFill};
use std::io::Write as _;
use std::path::Path;
use std::sync::Arc;
use viewport::{DrawingScale, Paper};

/// The minimum fraction of the drawing area that views should fill.
const LEAST_FILL: f64 = 0.45;

/// Returns a box of random proportions.
fn random_box(random: &mut Random, least: f64) -> (DVec3, [ModelInstance; 1]) {
    let magnitude = random.by_magnitude(10.0, 5_000.0);
    let size = DVec3::from([(); 3].map(|()| magnitude * random.by_magnitude(least, 1.0)));
    (size, [box_model(size)])
}

/// Returns the next larger standard scale.
fn next_scale(scale: DrawingScale) -> Option<DrawingScale> {
    DrawingScale::STANDARD.into_iter().rev().find(|s| s.ratio() > scale.ratio())
}

/// Returns the sheet at this scale in both orientations.
fn both_at(sheet: &Sheet, scale: DrawingScale) -> [Sheet; 2] {
    [sheet.paper, sheet.paper.rotated()].map(|paper| Sheet {
        paper,
        scale: Some(scale),
        ..sheet.clone()
    })
}

/// Describes why a sheet should be fuller, or returns an empty string if it is full enough.
fn fault_of_fill(sheet: &Sheet, models: &[ModelInstance], fill: &SheetFill) -> String {
    if fill.fraction >= LEAST_FILL || fill.limit == ScaleLimit::Largest {
        return String::new();
    }
    let Some(next) = next_scale(fill.scale) else { return "there is a larger scale".to_owned() };
    match &fill.limit {
        ScaleLimit::TooLarge { scale, .. } if *scale == next => {
            let fits = |one: Sheet| one.check_layout(models, &[]).is_ok();
            let fitting = both_at(sheet, next).into_iter().any(fits);
            if fitting { format!("{next} fits: {fill}") } else { String::new() }
        }
        ScaleLimit::NoRoom { scale, views } if *scale == next && !views.is_empty() => String::new(),
        _ => format!("the limit is not reported: {fill}"),
    }
}

#[test]
fn views_fill_the_sheet_or_the_next_standard_scale_does_not_fit() {
    let mut random = Random(3);
    let (mut faulty, mut full) = (Vec::new(), 0);
    for number in 0..640 {
        let (size, model) = random_box(&mut random, 0.1);
        let angle = if number / 8 % 2 == 0 { SheetAngle::First } else { SheetAngle::Third };
        let sheet = sheet(PAPERS[number % 8], angle).with_best_orientation(&model, &[]);
        let fill = sheet.fill(&model, &[]).unwrap();
        full += usize::from(fill.fraction >= LEAST_FILL);
        let fault = fault_of_fill(&sheet, &model, &fill);
        if !fault.is_empty() {
            faulty.push(format!("{size:.0} on {} {angle:?}: {fault}", sheet.paper_name));
        }
        // The expected size is the size of the bare objects plus 45 mm for gaps and dimensions.
        let ScaleLimit::TooLarge { scale, .. } = fill.limit else { continue };
        let bare = DVec2::new(size.x + size.z, size.y + size.z) * scale.ratio() + 45.0;
        for paper in [sheet.paper, sheet.paper.rotated()] {
            let frame = DVec2::new(paper.width() - 30.0, paper.height() - 20.0);
            if bare.x < frame.x && bare.y < frame.y - 42.0 && fill.fraction < LEAST_FILL {
                faulty.push(format!("{size:.0} {angle:?}: {bare} of {frame} at {scale}: {fill}"));
            }
        }
    }
    assert!(faulty.is_empty(), "{}: {:#?}", faulty.len(), &faulty[..faulty.len().min(12)]);
    assert!(full > 150, "{full} sheets are full");
}

#[test]
fn the_fill_is_the_area_of_the_views() {
    // Without annotations and at a requested scale, the fill follows from a formula.
    let model = [box_model(DVec3::new(80.0, 40.0, 20.0))];
    let mut sheet = sheet((Paper::A4.rotated(), "A4"), SheetAngle::First);
    sheet.scale = DrawingScale::new(1, 1).ok();
    (sheet.dimensions, sheet.axonometric_view) = (false, None);
    let fill = sheet.fill(&model, &[]).unwrap();
    assert_eq!(fill.limit, ScaleLimit::Given);
    let room = 267.0 * 190.0 - 180.0 * 32.0;
    let views = 80.0 * 40.0 + 80.0 * 20.0 + 20.0 * 40.0;
    // The scale bar takes up less than 2% of the area.
    let fraction = views / room;
    assert!(fill.fraction > fraction && fill.fraction < 1.02 * fraction, "{fill}");
    assert!(fill.to_string().ends_with("this scale was requested"), "{fill}");
}

#[test]
fn the_chosen_orientation_has_the_largest_scale() {
    let mut random = Random(11);
    for number in 0..400 {
        let (size, model) = random_box(&mut random, 0.02);
        let angle = if number % 2 == 0 { SheetAngle::First } else { SheetAngle::Third };
        let portrait = sheet(PAPERS[number % 8], angle);
        let rotated = Sheet { paper: portrait.paper.rotated(), ..portrait.clone() };
        let scale = |sheet: &Sheet| sheet.fill(&model, &[]).unwrap().scale.ratio();
        let chosen = portrait.clone().with_best_orientation(&model, &[]);
        let best = scale(&portrait).max(scale(&rotated));
        let has_all = |sheet: &Sheet| sheet.draw(&model, &[], 1).unwrap().warnings.is_empty();
        // A smaller scale is chosen only if the larger one omits a view.
        let larger = if scale(&portrait) == best { &portrait } else { &rotated };
        assert!(scale(&chosen) == best || has_all(&chosen) && !has_all(larger), "{size}");
    }
}

/// Returns sheets on a series of papers, from the smallest to the largest.
fn series(angle: SheetAngle) -> Vec<Sheet> {
    let papers = [4, 3, 2, 1, 0].map(|at| PAPERS[at]);
    papers.map(|paper| sheet(paper, angle)).into()
}

#[test]
fn the_smallest_paper_has_room_for_the_part_at_full_size() {
    let mut random = Random(5);
    let mut chosen = [0; 5];
    for _ in 0..200 {
        let (size, model) = random_box(&mut random, 0.2);
        let sheets = series(SheetAngle::First);
        let smallest = Sheet::smallest_of(sheets.clone(), true, &model, &[]).unwrap();
        let scale = smallest.fill(&model, &[]).unwrap().scale.ratio();
        let at = sheets.iter().position(|sheet| sheet.paper_name == smallest.paper_name).unwrap();
        chosen[at] += 1;
        let on = |k: usize| {
            let turned = sheets[k].clone().with_best_orientation(&model, &[]);
            turned.fill(&model, &[]).unwrap().scale.ratio()
        };
        if scale >= 1.0 {
            assert!(at == 0 || on(at - 1) < 1.0, "{size}: {}", smallest.paper_name);
        } else {
            assert!(on(4) < 1.0 && (at == 4 || on(at + 1) <= scale), "{size}");
            assert!((0..at).all(|k| on(k) < on(k + 1)), "{size}");
        }
    }
    assert!(chosen.iter().filter(|count| **count > 0).count() >= 4, "{chosen:?}");
    assert_eq!(Sheet::smallest_of(Vec::new(), true, &[], &[]), None);
    let first = Sheet::smallest_of(series(SheetAngle::Third), true, &[], &[]);
    assert_eq!(first, series(SheetAngle::Third).into_iter().next());
}

#[test]
fn the_smallest_paper_for_a_requested_scale_fits_all_views() {
    let model = [box_model(DVec3::new(300.0, 200.0, 100.0))];
    for (scale, name) in [((1, 5), "A4"), ((1, 2), "A3"), ((1, 1), "A2"), ((2, 1), "A0")] {
        let given = DrawingScale::new(scale.0, scale.1).ok();
        let sheets = series(SheetAngle::First);
        let sheets = sheets.into_iter().map(|one| Sheet { scale: given, ..one }).collect();
        let smallest = Sheet::smallest_of(sheets, true, &model, &[]).unwrap();
        assert_eq!(smallest.paper_name, name, "{scale:?}");
        assert!(smallest.draw(&model, &[], 1).unwrap().warnings.is_empty());
    }
}

/// Models with different proportions. The last is a scan with 130,000 triangles.
const SHARED_MODELS: [(&str, f64); 8] = [
    ("models/cesium-milk-truck/CesiumMilkTruck.gltf", 1000.0),
    ("models/low-poly-tree/low-poly-tree.glb", 1000.0),
    ("meshes/stl/plate_holes.STL", 1.0),
    ("meshes/stl/large_block.STL", 1.0),
    ("meshes/stl/round.stl", 1.0),
    ("meshes/stl/idler_riser.STL", 25.4),
    ("meshes/obj/regr01.obj", 1.0),
    ("models/blender-vertex-count-32bit/01_vertex_count_32bit.gltf", 1000.0),
];

#[test]
fn missing_shared_models_are_reported() {
    let log = Path::new(env!("CARGO_TARGET_TMPDIR")).join("skips-fill");
    let _ = std::fs::remove_file(&log);
    let mut test = std::process::Command::new(std::env::current_exe().unwrap());
    test.args(["shared_models_fill_their_sheets"]).env("ASSETS", "/nowhere").env("SKIP_LOG", &log);
    assert!(test.output().unwrap().status.success());
    let reported = std::fs::read_to_string(log).unwrap();
    assert!(reported.starts_with("SKIPPED fill of shared models: /nowhere"), "{reported}");
}

#[test]
fn shared_models_fill_their_sheets() {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/assets");
    let folder = std::env::var_os("ASSETS").map_or(beside, Into::into);
    if !folder.is_dir() {
        let reason = format!("{} was not found", folder.display());
        return skip::report_skip("fill of shared models", &reason);
    }
    let mut models: Vec<(String, f64, ModelInstance)> = Vec::new();
    for (name, unit) in SHARED_MODELS {
        let model = Arc::new(load(&folder.join(name), &ImportOptions::default()).unwrap());
        let model_to_world = Affine::scale(1.0, 1.0, 1.0);
        models.push((name.to_owned(), unit, ModelInstance { model, model_to_world }));
    }
    // Engine-sized boxes 743 mm long, with various proportions.
    for [y, z] in [[200.0, 300.0], [350.0, 350.0], [500.0, 300.0], [600.0, 450.0]] {
        models.push((format!("engine {y} {z}"), 1.0, box_model(DVec3::new(743.0, y, z))));
    }
    for (name, unit, model) in models {
        let model = [model];
        for paper in [PAPERS[4], PAPERS[3]] {
            for angle in [SheetAngle::First, SheetAngle::Third] {
                let mut sheet = sheet(paper, angle);
                sheet.millimeters_per_unit = unit;
                let sheet = sheet.with_best_orientation(&model, &[]);
                let fill = sheet.fill(&model, &[]).unwrap();
                let _ = writeln!(std::io::stdout(), "{name} {} {angle:?}: {fill}", paper.1);
                assert_eq!(fault_of_fill(&sheet, &model, &fill), "", "{name} {}", paper.1);
            }
        }
    }
}

#[test]
fn tight_sheets_are_legible() {
    // The views just fit. The size is found by growing a box until the scale decreases.
    for (paper, angle) in [(PAPERS[4], SheetAngle::First), (PAPERS[3], SheetAngle::Third)] {
        let at = |side: f64| {
            let model = [box_model(DVec3::new(side, side * 0.7, side * 0.5))];
            let sheet = sheet(paper, angle).with_best_orientation(&model, &[]);
            let scale = sheet.fill(&model, &[]).unwrap().scale.ratio();
            (sheet, model, scale)
        };
        let mut side = 30.0;
        while at(side + 0.25).2 == at(30.0).2 {
            side += 0.25;
        }
        let (sheet, model, _) = at(side);
        let page = sheet.draw(&model, &[], 1).unwrap();
        assert_eq!(faults(&page), [""; 0], "{side}");
        assert!(layer_extent(&page, |id| id.starts_with("isometric-")).is_some());
    }
}
