//! Scene overlays on sheets: point labels and axes, clear of everything else.

use super::boxes::{Random, box_model, sheet};
use super::lint::faults;
use drawing::{Overlay, PointLabel};
use glam::{DVec2, DVec3};
use homog::Point;
use page::{Group, GroupContent};
use projection::SheetAngle;
use sheet::{Sheet, SheetLabelFault, SheetPage, SheetWarning};
use viewport::{DrawingScale, Paper};

fn label(text: &str, at: DVec3) -> Overlay {
    Overlay::Label(PointLabel {
        at: Point::from_raw(at),
        text: text.to_owned(),
        offset: DVec2::ZERO,
        ink: [0; 3],
        height: 12.0,
        leader: false,
    })
}

/// Returns the point labels and axis names, in the order of the views.
fn texts(page: &SheetPage) -> Vec<&str> {
    let layer = page.layers.iter().find(|layer| layer.id == "overlay-text").expect("labels");
    layer.groups.iter().filter_map(text_of).collect()
}

fn text_of(group: &Group) -> Option<&str> {
    if let GroupContent::Text(line) = &group.content { Some(&line.text) } else { None }
}

#[test]
fn labels_and_axes_are_legible_in_every_view() {
    let mut random = Random(17);
    for (angle, paper) in [(SheetAngle::First, Paper::A4), (SheetAngle::Third, Paper::A4.rotated())]
    {
        let size = [0, 1, 2].map(|_| random.by_magnitude(8.0, 60.0));
        let size = DVec3::from(size);
        let model = [box_model(size)];
        let overlays = vec![
            Overlay::Axes(None),
            label("corner", size * 0.5),
            label("middle of the box", DVec3::ZERO),
            label("foot", size * DVec3::new(-0.5, -0.5, 0.5)),
        ];
        let page = Sheet { overlays, ..sheet((paper, "A4"), angle) }.draw(&model, &[], 1).unwrap();
        assert_eq!(faults(&page), [""; 0]);
        assert_eq!(page.warnings, []);
        let texts = texts(&page);
        // An axis along the view direction has no name, so each principal view has two names and
        // the other view three.
        assert_eq!(texts.iter().filter(|text| text.len() == 1).count(), 3 * 2 + 3, "{texts:?}");
        for text in ["corner", "middle of the box", "foot"] {
            assert_eq!(texts.iter().filter(|other| **other == text).count(), 4, "{text}");
        }
    }
}

#[test]
fn overlays_that_sheets_do_not_show_are_reported() {
    let model = [box_model(DVec3::new(40.0, 20.0, 10.0))];
    let overlays = vec![
        Overlay::Grid(None),
        Overlay::Horizon,
        Overlay::Edges,
        label("far", DVec3::new(900.0, 0.0, 0.0)),
    ];
    let sheet = Sheet { overlays, ..sheet((Paper::A4, "A4"), SheetAngle::First) };
    let warnings = sheet.draw(&model, &[], 1).unwrap().warnings;
    let of = |overlay: &str| SheetWarning::OverlayNotOnSheets { overlay: overlay.to_owned() };
    let far = |view: &str| SheetWarning::LabelNotInView {
        text: "far".to_owned(),
        view: view.to_owned(),
        fault: SheetLabelFault::Far,
    };
    for warning in [of("grid"), of("horizon"), far("front view"), far("isometric view")] {
        assert!(warnings.contains(&warning), "{warnings:?}");
    }
    // Seen from the left, the point is behind the box.
    assert!(!warnings.contains(&far("left view")) && warnings.len() == 5, "{warnings:?}");
}

#[test]
fn labels_of_large_models_stay_on_the_paper() {
    // At 50:1 the model would cover 50 km of paper, so positions around it are not searched.
    let model = [box_model(DVec3::new(1e6, 4e5, 6e5))];
    let overlays = vec![label("roof", DVec3::new(0.0, 2e5, 0.0))];
    let sheet = Sheet { overlays, ..sheet((Paper::A3.rotated(), "A3"), SheetAngle::First) };
    let page = sheet.draw(&model, &[], 1).unwrap();
    assert_eq!(faults(&page), [""; 0]);
    assert_eq!(page.warnings, []);
}

#[test]
fn more_than_a_hundred_labels_in_a_view_are_reported() {
    let model = [box_model(DVec3::new(400.0, 200.0, 300.0))];
    let overlays = (0..103).map(|k| label(&format!("{k}"), DVec3::ZERO)).collect();
    // The scale is fixed, so that the labels are placed only once.
    let scale = DrawingScale::new(1, 10).ok();
    let sheet = Sheet { overlays, scale, ..sheet((Paper::A4, "A4"), SheetAngle::First) };
    let warnings = sheet.draw(&model, &[], 1).unwrap().warnings;
    let is_surplus = |warning: &&SheetWarning| {
        matches!(warning, SheetWarning::LabelNotInView { fault: SheetLabelFault::TooMany, .. })
    };
    assert_eq!(warnings.iter().filter(is_surplus).count(), 3 * 4, "{warnings:?}");
}
