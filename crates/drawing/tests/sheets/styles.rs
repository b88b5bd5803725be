//! Units, letters and styles of sheets.

use crate::boxes::{box_model, sheet};
use crate::lint::faults;
use drawing::{DimensionUnit, FaceFill, Sheet, Warning};
use glam::DVec3;
use projection::SheetAngle;
use viewport::Paper;

#[test]
fn inches_are_written_as_inches() {
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
fn titles_in_letters_that_the_font_lacks_are_named() {
    let model = [box_model(DVec3::ONE)];
    let mut sheet = sheet((Paper::A4, "A4"), SheetAngle::First);
    sheet.title_block.title = "轴承 B".to_owned();
    sheet.title_block.author = "Ångström".to_owned();
    let page = sheet.draw(&model, &[], 1).unwrap();
    let [Warning::GlyphsMissing { text, characters }] = page.warnings.as_slice() else {
        panic!("{:?}", page.warnings)
    };
    assert_eq!((text.as_str(), characters.as_str()), ("轴承 B", "轴承"));
}

#[test]
fn tones_lie_under_every_view() {
    let model = [box_model(DVec3::new(40.0, 20.0, 10.0))];
    let sheet = sheet((Paper::A4, "A4"), SheetAngle::First);
    let style = drawing::LineStyle { face_fill: FaceFill::Flat, ..sheet.style };
    let page = Sheet { style, ..sheet }.draw(&model, &[], 1).unwrap();
    let ids: Vec<&str> = page.images.iter().map(|image| image.id.as_str()).collect();
    assert_eq!(ids, ["front-tone", "top-tone", "left-tone", "isometric-tone"]);
}
