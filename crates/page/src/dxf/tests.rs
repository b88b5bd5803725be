//! Tests of DXF output, which is read back tag by tag.

use super::*;
use crate::page::{Group, GroupContent, HatchArea, Layer, Pen, Polyline};
use crate::{Label, LineType};

/// Parses the tags of a file.
fn read_tags(file: &[u8]) -> Vec<(u16, String)> {
    let text = std::str::from_utf8(file).expect("ASCII");
    assert!(text.is_ascii());
    let lines: Vec<&str> = text.lines().collect();
    assert!(lines.len().is_multiple_of(2));
    let pair = |pair: &[&str]| (pair[0].parse().expect("a group code"), pair[1].to_owned());
    lines.chunks(2).map(pair).collect()
}

/// Returns the entities of one kind, each as a list of tags.
fn entities_of<'a>(tags: &'a [(u16, String)], kind: &str) -> Vec<&'a [(u16, String)]> {
    let starts = tags.iter().enumerate().filter(|(_, (code, _))| *code == 0).map(|(at, _)| at);
    let ends = starts.clone().skip(1).chain([tags.len()]);
    let all = starts.zip(ends).map(|(from, to)| &tags[from..to]);
    all.filter(|entity| entity[0].1 == kind).collect()
}

fn value(entity: &[(u16, String)], code: u16) -> &str {
    entity.iter().find(|(other, _)| *other == code).map_or("", |(_, value)| value)
}

/// Returns a page with a line, a dashed polyline, a circle, text and hatching.
fn page() -> Page {
    let mut page: Page = Page::new(DVec2::new(100.0, 50.0), "parts", None);
    let mut lines = Layer::new("lines", "lines", Pen::solid(0.5, [255, 0, 0]));
    let straight = Polyline { points: vec![[10_000, 40_000], [90_250, 40_000]], closed: false };
    let (sin, cos): (Vec<f64>, Vec<f64>) =
        (0..24).map(|k| libm::sincos(core::f64::consts::TAU * f64::from(k) / 24.0)).unzip();
    let ring: Vec<DVec2> =
        sin.iter().zip(&cos).map(|(s, c)| DVec2::new(50.0 + 5.0 * c, 20.0 + 5.0 * s)).collect();
    let round = Polyline::through_points(&ring, true).expect("a ring");
    lines.groups.push(Group { strokes: vec![straight, round], ..Group::default() });
    let pen = LineType::Dashed.to_pen(0.25, [0; 3], Default::default(), Default::default());
    let mut hidden = Layer::new("hidden", "hidden", pen);
    let square =
        Polyline { points: vec![[0, 0], [9000, 0], [9000, 9000], [0, 9000]], closed: true };
    let area = HatchArea {
        loops: vec![square.clone()],
        origin: [0, 0],
        direction: DVec2::new(1.0, -1.0).normalize(),
        spacing: 2.0,
    };
    hidden.groups.push(Group { title: "Deckel".into(), strokes: vec![square], ..Group::default() });
    let mut more = Layer::new("more", "more", Pen::solid(0.25, [0; 3]));
    more.groups.push(Label::new("Ø 12^3", DVec2::new(20.0, 30.0), 3.5).group());
    let content = GroupContent::Hatching(vec![area]);
    more.groups.push(Group { content, ..Group::default() });
    page.layers.extend([lines, hidden, more]);
    page
}

#[test]
fn paper_coordinates_start_at_the_lower_left_corner() {
    let page = page();
    let tags = read_tags(&page.to_dxf(&DxfOptions::on_paper(&page)));
    let line = entities_of(&tags, "LINE")[0];
    let coordinates = [10, 20, 11, 21].map(|code| value(line, code));
    assert_eq!(coordinates, ["10.0", "10.0", "90.25", "10.0"]);
    assert_eq!(value(line, 8), "lines");
    let circle = entities_of(&tags, "CIRCLE")[0];
    let number = |code| value(circle, code).parse::<f64>().expect("a number");
    assert!((number(10) - 50.0).abs() < 1e-3 && (number(20) - 30.0).abs() < 1e-3);
    assert!((number(40) - 5.0).abs() < 1e-3);
    let square = entities_of(&tags, "LWPOLYLINE")[0];
    let dashed = ["hidden.Deckel", "0.25", "4", "129"];
    assert_eq!([8, 48, 90, 70].map(|code| value(square, code)), dashed);
    let text = entities_of(&tags, "TEXT")[0];
    assert_eq!([1, 40, 72].map(|code| value(text, code)), ["\\U+00D8 12^ 3", "3.5", "5"]);
    let hatch = entities_of(&tags, "HATCH")[0];
    let number = |code| value(hatch, code).parse::<f64>().expect("a number");
    // Lines that rise to the right at 45°, two millimeters apart.
    assert!(number(53) == 45.0 && (libm::hypot(number(45), number(46)) - 2.0).abs() < 1e-12);
    assert_eq!(value(hatch, 91), "1");
}

#[test]
fn units_scale_lengths_and_move_the_origin() {
    let page = page();
    let origin = DVec2::new(10.0, 40.0);
    let options = DxfOptions {
        unit: Some(DxfUnit::Inch),
        units_per_millimeter: 0.5,
        origin,
        ..DxfOptions::on_paper(&page)
    };
    let tags = read_tags(&page.to_dxf(&options));
    let line = entities_of(&tags, "LINE")[0];
    assert_eq!([10, 20, 11, 21].map(|code| value(line, code)), ["0.0", "0.0", "40.125", "0.0"]);
    let unit = tags.iter().position(|(_, name)| name == "$INSUNITS").expect("a unit");
    assert_eq!(tags[unit + 1], (70, "1".to_owned()));
}

#[test]
fn handles_are_unique_and_owners_exist() {
    let page = page();
    let file = page.to_dxf(&DxfOptions::on_paper(&page));
    assert_eq!(file, page.to_dxf(&DxfOptions::on_paper(&page)));
    let tags = read_tags(&file);
    let number = |text: &String| u32::from_str_radix(text, 16).expect("a handle");
    let seed = tags.iter().position(|(_, name)| name == "$HANDSEED").expect("a seed") + 1;
    let is_handle =
        |&(at, (code, _)): &(usize, &(u16, String))| matches!(code, 5 | 105) && at != seed;
    let mut handles: Vec<u32> =
        tags.iter().enumerate().filter(is_handle).map(|(_, (_, text))| number(text)).collect();
    handles.sort_unstable();
    assert!(handles.windows(2).all(|pair| pair[0] != pair[1]));
    assert!(handles.iter().all(|handle| *handle < number(&tags[seed].1)));
    let owners = tags.iter().filter(|(code, _)| matches!(code, 330 | 340 | 350));
    assert!(owners.map(|(_, text)| number(text)).all(|at| at == 0 || handles.contains(&at)));
}

#[test]
fn an_empty_page_gives_a_valid_file() {
    let page: Page = Page::new(DVec2::new(10.0, 20.0), "", None);
    let tags = read_tags(&page.to_dxf(&DxfOptions::on_paper(&page)));
    let extent = tags.iter().position(|(_, name)| name == "$EXTMAX").expect("extents");
    assert_eq!((tags[extent + 1].1.as_str(), tags[extent + 2].1.as_str()), ("10.0", "20.0"));
    assert_eq!(tags.last(), Some(&(0, "EOF".to_owned())));
}
