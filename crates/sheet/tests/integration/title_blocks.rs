//! Title blocks, zones and number formats: all text is present and touches nothing.

use super::boxes::{PAPERS, box_model, sheet};
use super::lint::{faults, layer_extent};
use drawing::Warning;
use glam::{DVec2, DVec3};
use page::GroupContent;
use projection::SheetAngle;
use sheet::{
    DecimalMark, DimensionUnit, NumberFormat, Sheet, SheetFrame, SheetPage, SheetWarning,
    TitleBlockLanguage, TitleBlockTemplate, TitleBlockText,
};
use viewport::Paper;

/// Returns all text on a page.
fn texts(page: &SheetPage) -> Vec<&str> {
    let groups = page.layers.iter().flat_map(|layer| &layer.groups);
    let texts = groups.filter_map(|group| match &group.content {
        GroupContent::Text(line) => Some(line.text.as_str()),
        _ => None,
    });
    texts.filter(|text| !text.is_empty()).collect()
}

/// Returns a title block text with every field set.
fn all_fields(language: TitleBlockLanguage) -> TitleBlockText {
    TitleBlockText {
        title: "Bearing, gyrated".to_owned(),
        author: "L. B. Alberti".to_owned(),
        date: "2026-11-23".to_owned(),
        number: "1-042".to_owned(),
        supplementary_title: "Assembly of eight parts".to_owned(),
        owner: "Alberti".to_owned(),
        document_type: "Assembly drawing".to_owned(),
        approved_by: "A. Dürer".to_owned(),
        revision: "B".to_owned(),
        sheet: Some([2, 5]),
        language,
    }
}

#[test]
fn all_fields_are_legible_on_every_paper_in_every_language() {
    let model = [box_model(DVec3::new(80.0, 50.0, 30.0))];
    for paper in PAPERS {
        for paper in [paper, (paper.0.rotated(), paper.1)] {
            for (language, names) in [
                (TitleBlockLanguage::English, ["Legal owner", "Approved by", "Sheet"]),
                (TitleBlockLanguage::German, ["Gesetzlicher Eigentümer", "Genehmigt von", "Blatt"]),
                (TitleBlockLanguage::Chinese, ["单位名称", "批准", "页"]),
            ] {
                let title_block = all_fields(language);
                let own = sheet(paper, SheetAngle::First);
                let own = Sheet { title_block, frame: SheetFrame::Zones, ..own };
                let page = own.draw(&model, &[], 1).unwrap();
                assert_eq!(page.warnings, [], "{}", paper.1);
                assert_eq!(faults(&page), [""; 0], "{} {language:?}", paper.1);
                let texts = texts(&page);
                let values = ["Bearing, gyrated", "Assembly of eight parts", "2/5", "A. Dürer"];
                for text in names.into_iter().chain(values).chain([language.code(), "B", "A"]) {
                    assert!(texts.contains(&text), "{text} on {}: {texts:?}", paper.1);
                }
            }
        }
    }
}

#[test]
fn the_small_block_shows_the_sheet_number() {
    let model = [box_model(DVec3::new(80.0, 50.0, 30.0))];
    let mut own = sheet((Paper::A4, "A4"), SheetAngle::First);
    assert!(texts(&own.draw(&model, &[], 1).unwrap()).contains(&"Drawn with"));
    own.title_block.sheet = Some([3, 4]);
    let page = own.draw(&model, &[], 1).unwrap();
    assert!(texts(&page).contains(&"3/4") && texts(&page).contains(&"Sheet"));
    assert_eq!(faults(&page), [""; 0]);
}

#[test]
fn zones_and_trimming_marks_are_outside_the_frame() {
    let model = [box_model(DVec3::new(80.0, 50.0, 30.0))];
    let mut own = sheet((Paper::A3.rotated(), "A3"), SheetAngle::First);
    own.frame = SheetFrame::Zones;
    let page = own.draw(&model, &[], 1).unwrap();
    let at = |id: &str| layer_extent(&page, |own| own == id).unwrap();
    assert_eq!(at("frame-zones"), [DVec2::new(15.0, 5.0), DVec2::new(415.0, 292.0)]);
    assert_eq!(at("frame-trimming"), [DVec2::ZERO, DVec2::new(420.0, 297.0)]);
    let [low, high] = at("frame-zone-names");
    assert!(low.x > 15.0 && low.y > 5.0 && high.x < 415.0 && high.y < 292.0, "{low} {high}");
}

#[test]
fn custom_title_blocks_are_in_the_corner_with_fields_filled_in() {
    let svg = "<svg viewBox='0 0 120 24'><rect width='120' height='24' stroke-width='0.7'/>
        <path d='M0 12H120M60 12v12'/><text x='2' y='8' font-size='7'>{title}</text>
        <text x='2' y='20'>{scale} {unit} {sheet}/{sheets}</text>
        <text x='118' y='20' text-anchor='end' textLength='40'>{projection}</text></svg>";
    let template = TitleBlockTemplate::parse(svg).unwrap();
    let model = [box_model(DVec3::new(80.0, 50.0, 30.0))];
    for (paper, corner) in [((Paper::A4, "A4"), [80.0, 263.0]), ((Paper::A3, "A3"), [167.0, 386.0])]
    {
        let own = sheet(paper, SheetAngle::First);
        let own = Sheet { title_block_template: Some(template.clone()), ..own };
        let page = own.draw(&model, &[], 1).unwrap();
        let [low, high] = layer_extent(&page, |id| id.starts_with("title-block")).unwrap();
        assert_eq!((low, high), (corner.into(), DVec2::from(corner) + DVec2::new(120.0, 24.0)));
        let texts = texts(&page);
        assert!(
            texts.contains(&"Box") && texts.iter().any(|text| text.ends_with(":1 mm 1/1")),
            "{texts:?}"
        );
        assert_eq!(faults(&page), [""; 0], "{}", paper.1);
    }
    // The block shrinks on narrow paper. Characters missing from the font are reported.
    let own = sheet((Paper::new(100.0, 140.0).unwrap(), "own"), SheetAngle::First);
    let mut own = Sheet { title_block_template: Some(template), ..own };
    own.title_block.title = "轴承".to_owned();
    let page = own.draw(&model, &[], 1).unwrap();
    let [low, high] = layer_extent(&page, |id| id.starts_with("title-block")).unwrap();
    assert!((high.x - low.x - 80.0).abs() < 1e-3, "{low} {high}");
    assert!(matches!(
        page.warnings.as_slice(),
        [SheetWarning::Drawing(Warning::GlyphsMissing { .. })]
    ));
}

#[test]
fn lengths_have_the_requested_format() {
    let model = [box_model(DVec3::new(1803.4, 412.75, 61.1))];
    let dimensions = |unit, decimals, decimal_mark| {
        let mut own = sheet((Paper::A3.rotated(), "A3"), SheetAngle::First);
        (own.dimension_unit, own.numbers) = (unit, NumberFormat { decimals, decimal_mark });
        let page = own.draw(&model, &[], 1).unwrap();
        assert_eq!(faults(&page), [""; 0]);
        let layer = page.layers.iter().find(|layer| layer.id == "dimensions-text").unwrap();
        let text = |group: &page::Group| match &group.content {
            GroupContent::Text(line) => line.text.clone(),
            _ => String::new(),
        };
        layer.groups.iter().map(text).collect::<Vec<String>>()
    };
    let (mm, inch, foot) =
        (DimensionUnit::Millimeter, DimensionUnit::Inch, DimensionUnit::FootInch);
    let (point, comma) = (DecimalMark::Point, DecimalMark::Comma);
    assert_eq!(dimensions(mm, None, point), ["1803", "412.75", "61.1"]);
    assert_eq!(dimensions(mm, Some(1), comma), ["1803,4", "412,8", "61,1"]);
    assert_eq!(dimensions(inch, Some(3), point), ["71", "16.25", "2.406"]);
    assert_eq!(dimensions(foot, None, point), ["5'-11\"", "1'-4 1/4\"", "2 3/8\""]);
}
