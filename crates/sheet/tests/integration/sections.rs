//! Sections on sheets: each has either a section line and a view, or a warning.

use super::boxes::{box_model, has_view, plane, sheet};
use super::lint::{faults, layer_extent};
use glam::{DVec2, DVec3};
use hidden_line::Warning as Lines;
use homog::{Affine, Bounds};
use import::{ImportOptions, load};
use model::ModelInstance;
use projection::SheetAngle;
use sheet::Sheet;
use std::path::Path;
use std::sync::Arc;
use viewport::Paper;

/// Returns an A3 sheet in landscape.
fn a3(angle: SheetAngle) -> Sheet {
    sheet((Paper::A3.rotated(), "A3"), angle)
}

#[test]
fn a_section_across_x_cuts_the_side_view_that_faces_it() {
    let model = [box_model(DVec3::new(100.0, 50.0, 30.0))];
    for (angle, retained, side) in [
        (SheetAngle::First, -1.0, "right"),
        (SheetAngle::First, 1.0, "left"),
        (SheetAngle::Third, -1.0, "right"),
        (SheetAngle::Third, 1.0, "left"),
    ] {
        let cut = plane(DVec3::X * 20.0, DVec3::X * retained);
        let page = a3(angle).draw(&model, &[cut], 1).unwrap();
        let ids: Vec<&str> = page.layers.iter().map(|layer| layer.id.as_str()).collect();
        assert!(ids.contains(&format!("{side}-visible-hatching").as_str()), "{ids:?}");
        assert!(ids.contains(&"cut-lines") && ids.contains(&"cut-names"), "{ids:?}");
        assert_eq!((page.warnings.as_slice(), faults(&page)), (&[][..], Vec::new()));
    }
}

#[test]
fn planes_that_no_view_faces_get_separate_views() {
    let model = [box_model(DVec3::new(100.0, 50.0, 30.0))];
    for retained in [DVec3::Z, DVec3::Y, DVec3::new(-1.0, -1.0, 0.0), DVec3::new(0.0, 1.0, -2.0)] {
        let page = a3(SheetAngle::First).draw(&model, &[plane(DVec3::ZERO, retained)], 1).unwrap();
        assert!(has_view(&page, "section-a"), "{retained}: {:?}", page.warnings);
        assert!(page.layers.iter().any(|layer| layer.id == "cut-lines"), "{retained}");
        assert_eq!(faults(&page), [""; 0], "{retained}");
    }
    // The two planes have the same viewing direction, but only one of them can cut the view.
    let planes = [5.0, -5.0].map(|z| plane(DVec3::Z * z, -DVec3::Z));
    let page = a3(SheetAngle::First).draw(&model, &planes, 1).unwrap();
    assert!(has_view(&page, "front") && has_view(&page, "section-b"));
    assert_eq!(faults(&page), [""; 0]);
}

#[test]
fn an_auxiliary_view_shows_the_line_of_an_oblique_plane() {
    let model = [box_model(DVec3::new(100.0, 50.0, 30.0))];
    let oblique = plane(DVec3::ZERO, DVec3::new(-1.0, -1.0, -1.0));
    let page = a3(SheetAngle::First).draw(&model, &[oblique], 1).unwrap();
    assert_eq!((page.warnings.as_slice(), faults(&page)), (&[][..], Vec::new()));
    for name in ["section-a", "auxiliary-b"] {
        assert!(has_view(&page, name), "{name}");
    }
    assert!(page.layers.iter().any(|layer| layer.id == "isometric-visible-section"));
    // The line passes through the middle of the auxiliary view, which sees the plane edge-on.
    let [low, high] = layer_extent(&page, |id| id == "cut-lines").expect("a line");
    let view = layer_extent(&page, |id| id.starts_with("auxiliary-b-")).expect("a view");
    let middle = |[low, high]: [DVec2; 2]| (low + high) * 0.5;
    assert!((middle([low, high]) - middle(view)).length() < 0.002, "{low} {high} {view:?}");
}

#[test]
fn planes_beside_the_part_are_reported() {
    let model = [box_model(DVec3::new(100.0, 50.0, 30.0))];
    for (z, retained, warning) in [
        (16.0, -DVec3::Z, Lines::SectionMisses { number: 1 }.into()),
        (15.0, -DVec3::Z, Lines::SectionMisses { number: 1 }.into()),
        (16.0, DVec3::Z, Lines::SectionRemovesAll { number: 1 }.into()),
    ] {
        let beside = plane(DVec3::Z * z, retained);
        let page = a3(SheetAngle::Third).draw(&model, &[beside], 1).unwrap();
        assert_eq!(page.warnings, [warning]);
        assert!(page.layers.iter().all(|layer| !layer.id.starts_with("cut-")));
        assert!(has_view(&page, "front") && has_view(&page, "isometric"));
    }
}

#[test]
fn the_axonometric_view_frames_the_retained_part() {
    let model = [box_model(DVec3::new(2000.0, 50.0, 50.0))];
    let scale = |planes: &[_]| {
        let page = a3(SheetAngle::First).draw(&model, planes, 1).unwrap();
        let [low, high] = layer_extent(&page, |id| id.starts_with("isometric-")).expect("a view");
        high.y - low.y
    };
    // A tenth of the length remains, so the view is smaller at the sheet's scale.
    let cut = plane(DVec3::X * -800.0, -DVec3::X);
    assert!(scale(&[cut]) < 0.5 * scale(&[]), "{} {}", scale(&[cut]), scale(&[]));
}

#[test]
fn scene_models_are_legible_with_three_sections() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/models");
    for name in ["bearing.glb", "house.glb", "lamp.glb", "table.glb", "tower.glb", "vase.glb"] {
        let model = Arc::new(load(&folder.join(name), &ImportOptions::default()).unwrap());
        let model_to_world = Affine::scale(1.0, 1.0, 1.0);
        let models = [ModelInstance { model, model_to_world }];
        let points = model::world_points(&models);
        let middle = Bounds::from_points(points).expect("points").center().raw();
        let planes = [-DVec3::X, -DVec3::Z, DVec3::new(1.0, 0.0, 1.0)];
        let planes = planes.map(|retained| plane(middle, retained));
        for angle in [SheetAngle::First, SheetAngle::Third] {
            let mut sheet = a3(angle);
            sheet.millimeters_per_unit = 1000.0;
            let page = sheet.draw(&models, &planes, 1).unwrap();
            assert_eq!(faults(&page), [""; 0], "{name} {angle:?}");
        }
    }
}

#[test]
fn shafts_and_bolts_are_neither_cut_nor_hatched() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/models/bearing.glb");
    let model = Arc::new(load(&path, &ImportOptions::default()).unwrap());
    let models = [ModelInstance { model, model_to_world: Affine::scale(1.0, 1.0, 1.0) }];
    let cut = plane(DVec3::ZERO, -DVec3::Z);
    // The fourth object is the shaft, followed by the bolts.
    let hatched = |uncut: &[u32]| -> Vec<String> {
        let sheet = Sheet { uncut: uncut.to_vec(), ..a3(SheetAngle::First) };
        let page = sheet.draw(&models, &[cut], 1).unwrap();
        let layer = page.layers.iter().find(|layer| layer.id == "front-visible-hatching");
        layer.expect("hatching").groups.iter().map(|group| group.title.clone()).collect()
    };
    let parts = ["housing", "bush", "ring", "shaft", "bolt 1", "bolt 2"];
    assert_eq!(hatched(&[]), parts);
    assert_eq!(hatched(&[3, 4, 5, 6, 7]), parts[..3]);
    // Uncut parts protrude from cut parts, so the shaft is visible from the front.
    let sheet = Sheet { uncut: vec![3], ..a3(SheetAngle::First) };
    let page = sheet.draw(&models, &[cut], 1).unwrap();
    let shaft = |layer: &page::Layer| -> f64 {
        let own = layer.groups.iter().filter(|group| group.title == "shaft");
        own.flat_map(|group| &group.strokes).map(page::Polyline::length).sum()
    };
    let of_view = page.layers.iter().filter(|layer| layer.id.starts_with("front-visible"));
    assert!(of_view.map(shaft).sum::<f64>() > 0.0);
    assert!(
        page.layers.iter().all(|layer| layer.id != "front-visible-section" || shaft(layer) == 0.0)
    );
}
