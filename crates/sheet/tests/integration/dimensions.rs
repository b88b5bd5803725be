//! Dimensions read back from SVG, PDF and DXF, with lines and numbers compared with the formula.

use super::boxes::{box_model, sheet};
use super::center_lines::cylinder;
use super::formats::{read_dxf, read_pdf, read_svg};
use super::lint::faults;
use camera::NamedView;
use drawing::LineStyle;
use glam::{DVec2, DVec3};
use hidden_line::WorldCircle;
use homog::{Point, Vector, World};
use model::ModelInstance;
use page::{Label, Polyline};
use projection::SheetAngle;
use sheet::{
    Dimension, DimensionFault, DimensionUnit, LengthDirection, Measure, Sheet, SheetPage,
    SheetWarning,
};
use viewport::{DrawingScale, Paper};

/// The side lengths of the part.
const SIZE: DVec3 = DVec3::new(48.0, 32.0, 24.0);

/// The maximum difference, in millimeters, between a length from the formula and the length on
/// paper divided by the scale.
const EXACT: f64 = 0.0005;

fn point(x: f64, y: f64, z: f64) -> Point<World> {
    Point::new(x, y, z)
}

/// Returns a dimension with default settings.
pub fn dimension(measure: Measure) -> Dimension {
    let (view, side, decimals) = (None, None, None);
    Dimension { measure, view, side, decimals, name: "dimension 1".to_owned() }
}

/// Returns twenty computed pairs of points, with the direction of measurement and the view. Aligned
/// pairs are in a plane parallel to their view.
fn pairs() -> Vec<([Point<World>; 2], LengthDirection, NamedView)> {
    let wave = |k: usize, step: f64| libm::sin(step * (k as f64 + 1.0));
    let inside = |k: usize, steps: [f64; 3]| SIZE * 0.5 * DVec3::from(steps.map(|s| wave(k, s)));
    (0..20)
        .map(|k| {
            let view = [NamedView::Front, NamedView::Top, NamedView::Left][k % 3];
            let (direction, depth) = match k / 3 % 3 {
                0 => (LengthDirection::Aligned, 0.0),
                1 => (LengthDirection::Horizontal, 1.0),
                _ => (LengthDirection::Vertical, 1.0),
            };
            let [a, mut b] = [inside(k, [0.7, 1.9, 2.3]), inside(k, [3.1, 0.4, 1.3])];
            let gaze = view.from_direction().raw();
            b += gaze * (a - b).dot(gaze) * (1.0 - depth);
            ([a, b].map(Point::from_raw), direction, view)
        })
        .collect()
}

/// Returns the image of a point in a view, to the right and down.
fn image(view: NamedView, point: Point<World>) -> DVec2 {
    let p = point.raw();
    match view {
        NamedView::Front => DVec2::new(p.x, -p.y),
        NamedView::Top => DVec2::new(p.x, p.z),
        NamedView::Left => DVec2::new(p.z, -p.y),
        _ => panic!("{view}"),
    }
}

/// Draws a sheet at a scale, with this dimension as the only one.
fn page_of(dimension: Dimension, (scale, unit): (f64, DimensionUnit)) -> SheetPage {
    let mut sheet = sheet((Paper::A1.rotated(), "A1"), SheetAngle::First);
    sheet.dimensions = false;
    sheet.dimension_unit = unit;
    sheet.scale = DrawingScale::new(scale as u32, 1).ok();
    sheet.measures = vec![dimension];
    let page = sheet.draw(&[box_model(SIZE)], &[], 1).unwrap();
    assert_eq!((page.warnings.as_slice(), faults(&page)), (&[][..], Vec::new()));
    page
}

/// Whether the lines of a PDF are the strokes of this text, at any position.
fn are_strokes_of(lines: &[Vec<DVec2>], text: &str, (height, along): (f64, DVec2)) -> bool {
    let label = Label::new(text, DVec2::new(500.0, 300.0), height).with_direction(along);
    let strokes: Vec<Polyline> = label.strokes();
    let first = page::to_millimeters(strokes[0].points[0]);
    let moved = lines[0][0] - first;
    let expected = strokes.iter().map(|line| -> Vec<DVec2> {
        line.points.iter().map(|&point| page::to_millimeters(point) + moved).collect()
    });
    let near = |a: &[DVec2], b: &[DVec2]| {
        a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.distance(*b) < 0.004)
    };
    lines.len() == strokes.len() && lines.iter().zip(expected).all(|(a, b)| near(a, &b))
}

#[test]
fn lengths_read_back_from_every_format_match_the_formula() {
    for (unit, decimals) in [(DimensionUnit::Millimeter, 4), (DimensionUnit::Inch, 6)] {
        for (number, (points, direction, view)) in pairs().into_iter().enumerate() {
            let scale = 5.0;
            let measure = Measure::Chain(points.to_vec(), direction);
            let wanted =
                Dimension { view: Some(view), decimals: Some(decimals), ..dimension(measure) };
            let page = page_of(wanted, (scale, unit));
            let [a, b] = points.map(|point| image(view, point));
            let along = match direction {
                LengthDirection::Aligned => (b - a).normalize(),
                LengthDirection::Horizontal => DVec2::X,
                LengthDirection::Vertical => DVec2::Y,
            };
            // According to the formula, an aligned length is the distance in space.
            let expected = match direction {
                LengthDirection::Aligned => points[0].raw().distance(points[1].raw()),
                LengthDirection::Horizontal => (b.x - a.x).abs(),
                LengthDirection::Vertical => (b.y - a.y).abs(),
            };
            let (svg, dxf) = (read_svg(&page, "dimensions"), read_dxf(&page, "dimensions"));
            let pdf = read_pdf(&page, "dimensions");
            for (format, lines) in [("SVG", &svg.lines), ("PDF", &pdf), ("DXF", &dxf.lines)] {
                // The first two lines are the extension lines.
                let feet = [lines[0][0], lines[1][0]].map(|foot| foot.dot(along));
                let length = (feet[1] - feet[0]).abs() / scale;
                assert!(
                    (length - expected).abs() < EXACT,
                    "{format} {number}: {length} {expected}"
                );
                // The extension lines end on the line that the arrows touch.
                let line = lines.last().expect("a dimension line");
                assert!((line[1] - line[0]).perp_dot(along).abs() < 0.002, "{format} {number}");
            }
            let texts = [
                read_svg(&page, "dimensions-text").texts,
                read_dxf(&page, "dimensions-text").texts,
            ];
            for text in texts.iter().flatten() {
                let printed = text.parse::<f64>().expect("a number") * unit.in_millimeters();
                assert!((printed - expected).abs() < EXACT, "{number}: {text} {expected}");
            }
            let reading = if along.x.abs() < 1e-9 { -DVec2::Y } else { along * along.x.signum() };
            let strokes = read_pdf(&page, "dimensions-text");
            assert!(are_strokes_of(&strokes, &texts[0][0], (5.0, reading)), "{number}: {texts:?}");
        }
    }
}

#[test]
fn chains_and_baselines_show_all_lengths() {
    let xs = [-24.0, -11.5, 3.25, 24.0];
    let points = || xs.map(|x| point(x, 16.0, 12.0)).to_vec();
    for (measure, expected) in [
        (Measure::Chain(points(), LengthDirection::Aligned), vec!["12.5", "14.75", "20.75"]),
        (Measure::Baseline(points(), LengthDirection::Horizontal), vec!["12.5", "27.25", "48"]),
    ] {
        let page = page_of(dimension(measure), (5.0, DimensionUnit::Millimeter));
        let mut texts = read_svg(&page, "dimensions-text").texts;
        texts.sort();
        assert_eq!(texts, expected);
    }
}

#[test]
fn circles_and_angles_have_their_symbols() {
    let circle = WorldCircle {
        center: point(3.0, 2.0, 12.0),
        axis: Vector::Z,
        radius: 7.5,
        sweep: core::f64::consts::TAU,
    };
    let angle = [point(-24.0, -16.0, 12.0), point(24.0, -16.0, 12.0), point(-4.0, 4.0, 12.0)];
    for (measure, expected) in [
        (Measure::Diameter(circle), "Ø15"),
        (Measure::Radius(circle), "R7.5"),
        (Measure::Angle(angle), "45°"),
    ] {
        let page = page_of(dimension(measure), (5.0, DimensionUnit::Millimeter));
        assert_eq!(read_svg(&page, "dimensions-text").texts, [expected]);
    }
    // The arrow of a diameter touches the circle and is on a line through its center.
    let page = page_of(dimension(Measure::Diameter(circle)), (5.0, DimensionUnit::Millimeter));
    let shaft = &read_svg(&page, "dimensions").lines[0];
    let front = super::lint::layer_extent(&page, |id| id.starts_with("front-visible")).unwrap();
    let center = (front[0] + front[1]) * 0.5 + image(NamedView::Front, circle.center) * 5.0;
    assert!((shaft[0].distance(center) - 37.5).abs() < 0.002, "{shaft:?} {center}");
    assert!(
        (shaft[1] - shaft[0]).normalize().perp_dot((shaft[0] - center).normalize()).abs() < 1e-3
    );
}

#[test]
fn dimensions_without_a_true_view_are_reported() {
    let slanted = Measure::Chain(
        vec![point(-24.0, -16.0, -12.0), point(24.0, 16.0, 12.0)],
        LengthDirection::Aligned,
    );
    let deep = Measure::Chain(
        vec![point(0.0, 0.0, -12.0), point(0.0, 16.0, 12.0)],
        LengthDirection::Aligned,
    );
    let same = Measure::Chain(vec![point(1.0, 2.0, 3.0); 2], LengthDirection::Aligned);
    let draw = |measure: &Measure, view: Option<NamedView>| {
        let wanted = Dimension { view, ..dimension(measure.clone()) };
        let sheet = Sheet { measures: vec![wanted], ..sheet((Paper::A3, "A3"), SheetAngle::First) };
        let warnings = sheet.draw(&[box_model(SIZE)], &[], 1).unwrap().warnings;
        warnings.into_iter().find_map(|warning| match warning {
            SheetWarning::DimensionLeftOut { fault, .. } => Some(fault),
            _ => None,
        })
    };
    let (front, back) = (NamedView::Front, NamedView::Back);
    assert_eq!(draw(&slanted, None), Some(DimensionFault::NowhereTrue));
    assert_eq!(draw(&deep, None), None);
    let shown_in = Some(NamedView::Left);
    assert_eq!(
        draw(&deep, Some(front)),
        Some(DimensionFault::Foreshortened { view: front, shown_in })
    );
    assert_eq!(draw(&deep, Some(back)), Some(DimensionFault::NoSuchView(back)));
    assert_eq!(draw(&same, None), Some(DimensionFault::NoExtent));
}

/// Returns the values of a model's overall dimensions, in ascending order.
fn overall_lengths(model: ModelInstance) -> Vec<String> {
    let sheet = Sheet { dimensions: true, ..sheet((Paper::A3.rotated(), "A3"), SheetAngle::First) };
    let page = sheet.draw(&[model], &[], 1).unwrap();
    let mut texts = read_dxf(&page, "dimensions-text").texts;
    texts.sort();
    texts
}

#[test]
fn overall_dimensions_of_round_parts_measure_the_circle() {
    // With 30 sides, the facet at 90° is 0.07 mm inside the circle.
    for axis in [DVec3::Y, DVec3::X, DVec3::Z] {
        assert_eq!(
            overall_lengths(cylinder(DVec3::new(3.0, 1.0, 2.0), axis, (12.5, 40.0, 30))),
            ["25", "25", "40"],
            "{axis}"
        );
    }
    // With ten sides, it is a prism: 2 · 12.5 mm · cos 18° from side to side.
    let prism = overall_lengths(cylinder(DVec3::ZERO, DVec3::Y, (12.5, 40.0, 10)));
    assert_eq!(prism, ["23.78", "25", "40"]);
}

#[test]
fn ink_in_the_color_of_the_paper_is_replaced() {
    let white = LineStyle { ink: Some([255; 3]), ..LineStyle::TECHNICAL };
    let sheet = Sheet { style: white, ..sheet((Paper::A3, "A3"), SheetAngle::First) };
    let page = sheet.draw(&[box_model(SIZE)], &[], 1).unwrap();
    assert!(page.layers.iter().all(|layer| layer.pen.ink[0] < 128), "{:?}", page.layers[0].pen);
}
