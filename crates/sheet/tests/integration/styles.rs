//! Units, missing characters and styles on sheets.

use super::boxes::{box_model, sheet};
use super::lint::faults;
use drawing::FaceFill;
use drawing::Warning;
use glam::DVec3;
use projection::SheetAngle;
use sheet::{DimensionUnit, Sheet, SheetWarning};
use viewport::Paper;

#[test]
fn lengths_are_written_in_inches() {
    let model = [box_model(DVec3::new(4.0, 2.0, 1.0))];
    let with_unit = |unit: DimensionUnit| {
        let mut sheet = sheet((Paper::A4, "A4"), SheetAngle::First);
        (sheet.millimeters_per_unit, sheet.dimension_unit) = (25.4, unit);
        let page = sheet.draw(&model, &[], 1).unwrap();
        assert_eq!(faults(&page), [""; 0]);
        let strokes = |id: &str| -> usize {
            let layer = page.layers.iter().find(|layer| layer.id == id).expect("a layer");
            layer.groups.iter().map(|group| group.strokes.len()).sum()
        };
        strokes("dimensions-text")
    };
    // 4, 2 and 1 have fewer strokes than 101.6, 50.8 and 25.4.
    let [inches, millimeters] = [DimensionUnit::Inch, DimensionUnit::Millimeter].map(with_unit);
    assert!(inches < 8 && millimeters > 12, "{inches} {millimeters}");
}

#[test]
fn titles_with_missing_characters_are_reported() {
    let model = [box_model(DVec3::ONE)];
    let mut sheet = sheet((Paper::A4, "A4"), SheetAngle::First);
    sheet.title_block.title = "轴承 B".to_owned();
    sheet.title_block.author = "Ångström".to_owned();
    let page = sheet.draw(&model, &[], 1).unwrap();
    let [SheetWarning::Drawing(Warning::GlyphsMissing { text, characters })] =
        page.warnings.as_slice()
    else {
        panic!("{:?}", page.warnings)
    };
    assert_eq!((text.as_str(), characters.as_str()), ("轴承 B", "轴承"));
}

#[test]
fn tones_are_drawn_under_every_view() {
    let model = [box_model(DVec3::new(40.0, 20.0, 10.0))];
    let sheet = sheet((Paper::A4, "A4"), SheetAngle::First);
    let style = drawing::LineStyle { face_fill: FaceFill::Flat, ..sheet.style };
    let page = Sheet { style, ..sheet }.draw(&model, &[], 1).unwrap();
    let ids: Vec<&str> = page.images.iter().map(|image| image.id.as_str()).collect();
    assert_eq!(ids, ["front-tone", "top-tone", "left-tone", "isometric-tone"]);
}

#[test]
fn gray_areas_are_drawn_under_every_view() {
    let model = [box_model(DVec3::new(40.0, 20.0, 10.0))];
    let sheet = sheet((Paper::A4, "A4"), SheetAngle::First);
    let style = drawing::LineStyle { face_fill: FaceFill::Gray, ..sheet.style };
    let page = Sheet { style, ..sheet }.draw(&model, &[], 1).unwrap();
    assert_eq!(page.images, []);
    let ids = page.layers.iter().map(|layer| layer.id.as_str());
    let ids: Vec<&str> = ids.filter(|id| id.contains("-gray-")).collect();
    assert_eq!(ids, ["front-gray-31", "top-gray-31", "left-gray-31", "isometric-gray-31"]);
    assert_eq!(faults(&page), [""; 0]);
}

/// Parts do not touch in an exploded view, but they keep the hatching of their original positions.
#[test]
fn exploded_parts_keep_their_hatching() {
    let model = [super::parts_models::stacked_assembly(3, 1)];
    let mut sheet = sheet((Paper::A4, "A4"), SheetAngle::First);
    sheet.style.face_fill = FaceFill::PartHatching;
    let directions = |sheet: &Sheet, prefix: &str| -> Vec<bool> {
        let pages = sheet.draw_pages(&model, &[], 1).unwrap();
        let id = format!("{prefix}-visible-hatching");
        let layer = pages[1].layers.iter().find(|layer| layer.id == id).expect("hatching");
        let rises = |group: &page::Group| {
            let [a, b] = [group.strokes[0].points[0], group.strokes[0].points[1]];
            (b[0] > a[0]) == (b[1] < a[1])
        };
        layer.groups.iter().map(rises).collect()
    };
    sheet.assembly.balloons = true;
    let together = directions(&sheet, "assembly");
    sheet.assembly.explosion = Some(sheet::ExplosionSettings::default());
    assert_eq!(directions(&sheet, "exploded"), together);
    assert!(together.contains(&true) && together.contains(&false), "{together:?}");
}
