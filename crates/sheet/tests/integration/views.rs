//! Requested views: details, stepped, half and local sections, auxiliary and broken views, and
//! views at requested positions.

use super::boxes::{Random, box_model, has_view, plane, sheet};
use super::lint::{Extent, faults, layer_extent};
use camera::NamedView;
use drawing::HiddenLines;
use glam::{DVec2, DVec3};
use homog::{Affine, Point, Vector, World};
use model::ModelInstance;
use page::{GroupContent, Polyline, to_millimeters};
use projection::SheetAngle;
use sheet::{Sheet, SheetError, SheetPage, SheetWarning, ViewPlace, ViewRequest, ViewSide};
use viewport::{DrawingScale, Paper};

/// Twice the grid step of a page, in millimeters, because two ends are rounded.
const GRID: f64 = 0.002;

/// Returns an A3 sheet in landscape with the given requests.
fn a3(views: Vec<ViewRequest>) -> Sheet {
    Sheet { views, ..sheet((Paper::A3.rotated(), "A3"), SheetAngle::First) }
}

/// Returns the scale `paper`:`object`.
fn scale(paper: u32, object: u32) -> Option<DrawingScale> {
    DrawingScale::new(paper, object).ok()
}

/// Returns a world point.
fn point(x: f64, y: f64, z: f64) -> Point<World> {
    Point::new(x, y, z)
}

/// Returns a box with these sides around a center.
fn box_at(size: DVec3, center: DVec3) -> ModelInstance {
    let model_to_world = Affine::translation(Vector::from_raw(center));
    ModelInstance { model_to_world, ..box_model(size) }
}

/// Returns a named view in its default place.
fn named(view: NamedView) -> ViewRequest {
    ViewRequest::Named { view, place: ViewPlace::default() }
}

/// Returns a detail of the front view in its default place.
fn detail(center: Point<World>, radius: f64) -> ViewRequest {
    ViewRequest::Detail { of: NamedView::Front, center, radius, place: ViewPlace::default() }
}

/// Returns all text on a page.
fn texts(page: &SheetPage) -> Vec<&str> {
    let groups = page.layers.iter().flat_map(|layer| &layer.groups);
    groups
        .filter_map(|group| match &group.content {
            GroupContent::Text(line) => Some(line.text.as_str()),
            _ => None,
        })
        .collect()
}

/// Returns the lines of a layer.
fn strokes<'a>(page: &'a SheetPage, id: &str) -> Vec<&'a Polyline> {
    let layers = page.layers.iter().filter(|layer| layer.id == id);
    layers.flat_map(|layer| &layer.groups).flat_map(|group| &group.strokes).collect()
}

/// Returns the extent of a view's lines, without hatching.
fn view_extent(page: &SheetPage, name: &str) -> Extent {
    let prefix = format!("{name}-");
    layer_extent(page, |id| id.starts_with(&prefix)).expect("a view")
}

/// Returns an A3 sheet in landscape with the given requests, at 1:1.
fn at_one_to_one(views: Vec<ViewRequest>) -> Sheet {
    Sheet { scale: scale(1, 1), ..a3(views) }
}

#[test]
fn a_detail_is_the_part_within_its_circle() {
    let model = [box_model(DVec3::new(100.0, 50.0, 30.0))];
    let mut sheet = at_one_to_one(vec![detail(point(50.0, 25.0, 15.0), 5.0)]);
    sheet.dimensions = false;
    let page = sheet.draw(&model, &[], 1).unwrap();
    assert_eq!((page.warnings.as_slice(), faults(&page)), (&[][..], Vec::new()));
    // The detail has the largest standard enlargement up to five times.
    assert!(texts(&page).contains(&"A (5:1)"), "{:?}", texts(&page));
    let circles: Vec<Extent> = strokes(&page, "view-marks")
        .iter()
        .filter(|line| line.closed)
        .map(|line| super::lint::extent([*line].into_iter()).expect("a circle"))
        .collect();
    let [mother, border] = circles.as_slice() else { panic!("{circles:?}") };
    let front = view_extent(&page, "front");
    let corner = DVec2::new(front[1].x, front[0].y);
    assert!(((mother[0] + mother[1]) * 0.5 - corner).length() < GRID);
    assert!((mother[1] - mother[0] - 10.0).length() < GRID, "{mother:?}");
    assert!((border[1] - border[0] - 50.0).length() < GRID, "{border:?}");
    // Two edges meet at the center. Each is 5 mm long up to the circle, at 5:1.
    let center = (border[0] + border[1]) * 0.5;
    let lines: Vec<&Polyline> = page
        .layers
        .iter()
        .filter(|layer| layer.id.starts_with("detail-a-visible"))
        .flat_map(|layer| &layer.groups)
        .flat_map(|group| &group.strokes)
        .collect();
    let length: f64 = lines.iter().map(|line| line.length()).sum();
    assert!((length - 50.0).abs() < 2.0 * GRID, "{length}");
    let points = lines.iter().flat_map(|line| &line.points).copied().map(to_millimeters);
    assert!(points.into_iter().all(|p| p.distance(center) < 25.0 + GRID));
}

#[test]
fn a_detail_of_a_cut_view_has_its_hatching() {
    let model = [box_model(DVec3::new(100.0, 50.0, 30.0))];
    let cut = plane(DVec3::ZERO, -DVec3::Z);
    let sheet = at_one_to_one(vec![detail(point(50.0, 25.0, 0.0), 5.0)]);
    let page = sheet.draw(&model, &[cut], 1).unwrap();
    assert_eq!((page.warnings.as_slice(), faults(&page)), (&[][..], Vec::new()));
    let [low, high] =
        layer_extent(&page, |id| id == "detail-b-visible-hatching").expect("hatching");
    // The hatching covers a quarter of the disc.
    assert!((high - low).max_element() <= 25.0 + GRID, "{low} {high}");
    assert!((high - low).min_element() > 20.0, "{low} {high}");
}

/// Returns two boxes side by side. In the front view, the right box is closer to the viewer.
fn two_depths() -> [ModelInstance; 2] {
    [
        box_at(DVec3::new(50.0, 40.0, 20.0), DVec3::new(-25.0, 0.0, 0.0)),
        box_at(DVec3::new(50.0, 40.0, 20.0), DVec3::new(25.0, 0.0, 20.0)),
    ]
}

/// Returns a stepped section through the middle of both boxes.
fn stepped(place: ViewPlace) -> ViewRequest {
    let corners = [[-20.0, 0.0], [0.0, 0.0], [0.0, 20.0], [30.0, 20.0]];
    let corners = corners.map(|[x, z]| point(x, 0.0, z)).to_vec();
    ViewRequest::Stepped { removed: Vector::Z, corners, place }
}

#[test]
fn a_stepped_section_cuts_each_strip_with_its_plane() {
    let page = at_one_to_one(vec![stepped(ViewPlace::default())]);
    let page = page.draw(&two_depths(), &[], 1).unwrap();
    assert_eq!((page.warnings.as_slice(), faults(&page)), (&[][..], Vec::new()));
    assert!(texts(&page).contains(&"A-A"));
    // Both boxes are hatched over their full 50 mm.
    let [low, high] = layer_extent(&page, |id| id == "front-visible-hatching").expect("hatching");
    assert!(high.x - low.x > 97.0 && high.x - low.x < 100.0 + GRID, "{low} {high}");
    // In the top view the line runs across both boxes with the step, plus 4 mm at each end.
    let lines = strokes(&page, "cut-lines");
    let [line] = lines.as_slice() else { panic!("{lines:?}") };
    assert_eq!((line.points.len(), line.closed), (4, false));
    assert!((line.length() - (100.0 + 20.0 + 2.0 * 4.0)).abs() < 3.0 * GRID, "{}", line.length());
    // The ends and corners are wide, which makes two wide lines for each of the three pieces.
    assert_eq!(strokes(&page, "cut-ends").len(), 6);
    let top = view_extent(&page, "top");
    let middle = (top[0] + top[1]) * 0.5;
    let step = [line.points[1], line.points[2]].map(to_millimeters);
    assert!(step.iter().all(|point| (point.x - middle.x).abs() < GRID));
    // In the top view, z points down the sheet. The second plane is 20 mm closer to the viewer of
    // the front view.
    assert!((step[1].y - step[0].y - 20.0).abs() < GRID, "{step:?}");
}

#[test]
fn a_stepped_section_can_be_placed_at_a_position() {
    let place = ViewPlace { at: Some(DVec2::new(330.0, 200.0)), ..ViewPlace::default() };
    let page = at_one_to_one(vec![stepped(place)]).draw(&two_depths(), &[], 1).unwrap();
    assert_eq!((page.warnings.as_slice(), faults(&page)), (&[][..], Vec::new()));
    let [low, high] = view_extent(&page, "section-a");
    assert!(((low + high) * 0.5 - DVec2::new(330.0, 200.0)).length() < GRID, "{low} {high}");
    assert!(has_view(&page, "front"));
}

#[test]
fn stepped_sections_without_a_view_along_the_steps_are_reported() {
    let views = vec![named(NamedView::Front), stepped(ViewPlace::default())];
    let page = at_one_to_one(views).draw(&two_depths(), &[], 1).unwrap();
    assert_eq!(page.warnings, [SheetWarning::CutLineNotShown { section: "A-A".to_owned() }]);
}

#[test]
fn a_half_section_cuts_the_requested_half() {
    let model = [box_model(DVec3::new(100.0, 50.0, 30.0))];
    for (side, axis, is_upper) in [
        (ViewSide::Left, 0, false),
        (ViewSide::Right, 0, true),
        (ViewSide::Top, 1, false),
        (ViewSide::Bottom, 1, true),
    ] {
        let views = vec![ViewRequest::HalfSection { of: NamedView::Front, point: None, side }];
        let page = at_one_to_one(views).draw(&model, &[], 1).unwrap();
        assert_eq!((page.warnings.as_slice(), faults(&page)), (&[][..], Vec::new()), "{side:?}");
        let front = view_extent(&page, "front");
        let middle = (front[0] + front[1]) * 0.5;
        let hatching = layer_extent(&page, |id| id == "front-visible-hatching").expect("hatching");
        let (near, far) = if is_upper {
            (hatching[0][axis] - middle[axis], front[1][axis] - hatching[1][axis])
        } else {
            (middle[axis] - hatching[1][axis], hatching[0][axis] - front[0][axis])
        };
        // Hatch lines begin within one spacing, 2 mm, of the border.
        assert!((-GRID..3.0).contains(&near) && (-GRID..3.0).contains(&far), "{side:?}");
        let center = strokes(&page, "symmetry-lines");
        let [line] = center.as_slice() else { panic!("{center:?}") };
        let side = front[1][1 - axis] - front[0][1 - axis];
        assert!((line.length() - side - 6.0).abs() < GRID);
        assert!((to_millimeters(line.points[0])[axis] - middle[axis]).abs() < GRID);
        assert!(page.layers.iter().all(|layer| !layer.id.starts_with("front-hidden")));
    }
}

#[test]
fn a_local_section_is_cut_within_its_freehand_line() {
    let model = [box_model(DVec3::new(100.0, 60.0, 30.0))];
    let local = |center| ViewRequest::LocalSection { of: NamedView::Front, center, radius: 12.0 };
    let page = at_one_to_one(vec![local(point(10.0, 5.0, 0.0))]).draw(&model, &[], 1).unwrap();
    assert_eq!((page.warnings.as_slice(), faults(&page)), (&[][..], Vec::new()));
    let front = view_extent(&page, "front");
    let center = (front[0] + front[1]) * 0.5 + DVec2::new(10.0, -5.0);
    for id in ["front-visible-hatching", "front-break-lines"] {
        let lines = strokes(&page, id);
        let points = lines.iter().flat_map(|line| &line.points).copied().map(to_millimeters);
        let most = points.map(|p| p.distance(center)).fold(0.0_f64, f64::max);
        assert!(most > 11.0 && most < 12.0 * 1.08 + GRID, "{id}: {most}");
    }
    // The freehand line is the same in every drawing.
    let again = at_one_to_one(vec![local(point(10.0, 5.0, 0.0))]).draw(&model, &[], 2).unwrap();
    assert!(page == again);
    // At the border, the freehand line ends at the outline.
    let page = at_one_to_one(vec![local(point(50.0, 0.0, 0.0))]).draw(&model, &[], 1).unwrap();
    let front = layer_extent(&page, |id| {
        id.starts_with("front-visible-crease") || id.starts_with("front-visible-silhouette")
    })
    .expect("an outline");
    let line = layer_extent(&page, |id| id == "front-break-lines").expect("a freehand line");
    assert!(line[1].x <= front[1].x + GRID && line[1].x > front[1].x - 0.5, "{line:?} {front:?}");
}

#[test]
fn a_broken_view_is_shorter_but_states_true_dimensions() {
    let model = [box_model(DVec3::new(1000.0, 40.0, 30.0))];
    let broken = ViewRequest::Broken { of: None, axis: 0, from: -400.0, to: 350.0 };
    let whole = a3(Vec::new()).draw(&model, &[], 1).unwrap();
    let page = a3(vec![broken]).draw(&model, &[], 1).unwrap();
    assert_eq!((page.warnings.as_slice(), faults(&page)), (&[][..], Vec::new()));
    assert!(texts(&page).contains(&"1000"), "{:?}", texts(&page));
    let height = |page: &SheetPage| {
        let [low, high] = view_extent(page, "front");
        (high.y - low.y) / 40.0
    };
    // The whole object fits at 1:5. Without 750 mm there is room for 1:1.
    assert!((height(&whole) - 0.2).abs() < 1e-4 && (height(&page) - 1.0).abs() < 1e-4);
    for name in ["front", "top"] {
        let [low, high] = view_extent(&page, name);
        assert!((high.x - low.x - 250.0).abs() < GRID, "{name}: {low} {high}");
        // There is a gap of 3 mm between two freehand lines that run from edge to edge.
        let lines = strokes(&page, &format!("{name}-break-lines"));
        assert_eq!(lines.len(), 2, "{name}");
        let tall = if name == "front" { 40.0 } else { 30.0 };
        for line in lines {
            let [from, to] = [line.points[0], line.points[line.points.len() - 1]];
            let span = (to_millimeters(from) - to_millimeters(to)).abs();
            assert!((span.y - tall).abs() < GRID, "{name}: {span}");
        }
    }
}

#[test]
fn sections_and_details_account_for_the_omitted_part() {
    let model = [box_model(DVec3::new(1000.0, 40.0, 30.0))];
    let broken = ViewRequest::Broken { of: None, axis: 0, from: -400.0, to: 350.0 };
    let views = vec![broken.clone(), detail(point(500.0, 20.0, 15.0), 10.0)];
    let cuts = [plane(DVec3::X * 400.0, DVec3::X)];
    let page = a3(views).draw(&model, &cuts, 1).unwrap();
    assert_eq!((page.warnings.as_slice(), faults(&page)), (&[][..], Vec::new()));
    let [low, high] = view_extent(&page, "front");
    let scale = (high.y - low.y) / 40.0;
    // The cut is 100 mm from the right end.
    let line = to_millimeters(strokes(&page, "cut-lines")[0].points[0]);
    assert!((high.x - line.x - 100.0 * scale).abs() < GRID, "{line} {high}");
    let views = vec![broken, detail(point(0.0, 20.0, 15.0), 10.0)];
    let error = a3(views).draw(&model, &[], 1).expect_err("left out");
    assert!(error.to_string().contains("view 2 of the sheet"), "{error}");
    assert!(error.to_string().contains("omitted part"), "{error}");
}

#[test]
fn an_auxiliary_view_shows_an_oblique_face_at_true_size() {
    // The plate is 80 by 30 mm, at 30° to the front.
    let turn = Affine::rotation_y(30.0_f64.to_radians());
    let plate = box_model(DVec3::new(80.0, 30.0, 4.0));
    let plate = [ModelInstance { model_to_world: turn, ..plate }];
    let facing =
        Vector::new(libm::sin(30.0_f64.to_radians()), 0.0, libm::cos(30.0_f64.to_radians()));
    let views = vec![ViewRequest::Auxiliary { facing, place: ViewPlace::default() }];
    let page = at_one_to_one(views).draw(&plate, &[], 1).unwrap();
    assert_eq!((page.warnings.as_slice(), faults(&page)), (&[][..], Vec::new()));
    let [low, high] = view_extent(&page, "auxiliary-a");
    assert!((high - low - DVec2::new(80.0, 30.0)).length() < 2.0 * GRID, "{low} {high}");
    // The letter appears at the arrow and below the view.
    assert_eq!(texts(&page).iter().filter(|text| **text == "A").count(), 2);
    let [low, high] = view_extent(&page, "front");
    let width = 80.0 * libm::cos(30.0_f64.to_radians()) + 4.0 * libm::sin(30.0_f64.to_radians());
    assert!((high.x - low.x - width).abs() < GRID);
}

#[test]
fn views_form_columns_and_rows_around_the_front_view() {
    let model = [box_model(DVec3::new(40.0, 30.0, 20.0))];
    for angle in [SheetAngle::First, SheetAngle::Third] {
        let mut sheet = a3(NamedView::PRINCIPAL.map(named).to_vec());
        sheet.projection_angle = angle;
        let page = sheet.draw(&model, &[], 1).unwrap();
        assert_eq!((page.warnings.as_slice(), faults(&page)), (&[][..], Vec::new()));
        let center = |name: &str| {
            let [low, high] = view_extent(&page, name);
            (low + high) * 0.5
        };
        let front = center("front");
        let across = if angle == SheetAngle::First { 1.0 } else { -1.0 };
        for (name, direction) in [
            ("left", DVec2::X * across),
            ("right", -DVec2::X * across),
            ("top", DVec2::Y * across),
            ("bottom", -DVec2::Y * across),
            ("back", DVec2::X),
        ] {
            let offset = center(name) - front;
            assert!(offset.dot(direction) > 30.0, "{name}: {offset}");
            assert!(offset.perp_dot(direction).abs() < GRID, "{name}: {offset}");
        }
        assert!(!has_view(&page, "isometric"));
    }
}

#[test]
fn views_can_have_individual_positions_scales_and_captions() {
    let model = [box_model(DVec3::new(40.0, 30.0, 20.0))];
    let at = DVec2::new(300.0, 80.0);
    let place = ViewPlace { at: Some(at), scale: scale(2, 1), caption: Some("Plan".to_owned()) };
    let views = vec![named(NamedView::Front), ViewRequest::Named { view: NamedView::Top, place }];
    let page = at_one_to_one(views).draw(&model, &[], 1).unwrap();
    assert_eq!((page.warnings.as_slice(), faults(&page)), (&[][..], Vec::new()));
    let [low, high] = view_extent(&page, "top");
    assert!(((low + high) * 0.5 - at).length() < GRID);
    assert!((high - low - DVec2::new(80.0, 40.0)).length() < GRID);
    assert!(texts(&page).contains(&"Plan") && texts(&page).contains(&"2:1"));
}

#[test]
fn misplaced_views_are_reported() {
    let model = [box_model(DVec3::new(40.0, 30.0, 20.0))];
    let draw = |at: [f64; 2]| {
        let place = ViewPlace { at: Some(at.into()), ..ViewPlace::default() };
        let top = ViewRequest::Named { view: NamedView::Top, place };
        at_one_to_one(vec![named(NamedView::Front), top]).draw(&model, &[], 1)
    };
    let error = draw([25.0, 80.0]).expect_err("outside");
    // The frame begins at 20 mm, and the view is 40 mm wide.
    assert!(
        matches!(&error, SheetError::Outside { number: 2, view, x, .. }
        if view == "top view" && (x[0] - 40.0).abs() < 20.0),
        "{error}"
    );
    let page = draw([370.0, 270.0]).unwrap();
    let overlap = |other: &str| SheetWarning::ViewOverlaps {
        view: "top view".to_owned(),
        other: other.to_owned(),
    };
    assert_eq!(page.warnings, [overlap("title block")]);
}

#[test]
fn invalid_requests_are_rejected() {
    let model = [box_model(DVec3::new(40.0, 30.0, 20.0))];
    let broken = |from, to| ViewRequest::Broken { of: None, axis: 0, from, to };
    let half = |of| ViewRequest::HalfSection { of, point: None, side: ViewSide::Right };
    for (views, expected) in [
        (vec![named(NamedView::Top), detail(point(0.0, 0.0, 0.0), 5.0)], "has no front view"),
        (vec![detail(point(90.0, 0.0, 0.0), 5.0)], "outside the view"),
        (vec![detail(point(0.0, 0.0, 0.0), 0.0)], "radius"),
        (vec![broken(0.0, 30.0)], "inside the models"),
        (vec![broken(5.0, 5.0)], "inside the models"),
        (vec![broken(0.0, 5.0), half(NamedView::Front)], "already"),
        (vec![half(NamedView::Front), half(NamedView::Front)], "already"),
        (vec![named(NamedView::Top), named(NamedView::Top)], "twice"),
        (
            vec![ViewRequest::LocalSection {
                of: NamedView::Front,
                center: point(0.0, 0.0, 10.5),
                radius: 3.0,
            }],
            "cuts nothing",
        ),
        (
            vec![ViewRequest::Auxiliary { facing: Vector::ZERO, place: ViewPlace::default() }],
            "must not be (0, 0, 0)",
        ),
        (vec![detail(point(0.0, 0.0, 0.0), 5.0); 40], "at most 24 views"),
    ] {
        let error = a3(views).draw(&model, &[], 1).expect_err(expected);
        assert!(error.to_string().contains(expected), "{error}");
    }
}

/// Returns a random request for a box of this size.
fn random_request(random: &mut Random, size: DVec3) -> ViewRequest {
    let mut about = |size: f64| (random.fraction() - 0.5) * size;
    let center = point(about(size.x), about(size.y), about(size.z * 0.9));
    let place = ViewPlace::default();
    let radius = 0.3 * size.min_element();
    match (random.fraction() * 6.0) as u32 {
        0 => ViewRequest::Detail { of: NamedView::Top, center, radius, place },
        1 => detail(center, radius),
        2 => ViewRequest::Auxiliary { facing: Vector::new(1.0, 0.0, 1.0), place },
        3 => ViewRequest::LocalSection { of: NamedView::Front, center, radius },
        4 => {
            let x = size.x * 0.5;
            let z = size.z * 0.2;
            let corners = [[-x, 0.0], [0.0, 0.0], [0.0, z], [x, z]];
            let corners = corners.map(|[x, z]| point(x, 0.0, z)).to_vec();
            ViewRequest::Stepped { removed: Vector::Z, corners, place }
        }
        _ => ViewRequest::Broken { of: None, axis: 0, from: -0.3 * size.x, to: 0.2 * size.x },
    }
}

#[test]
fn sheets_with_random_requests_are_legible() {
    let mut random = Random(11);
    let (mut drawn, mut left_out, mut messages) = (0, 0, Vec::new());
    for number in 0..160 {
        let size = DVec3::from([(); 3].map(|()| 20.0 + 200.0 * random.fraction()));
        let (paper, name) = [(Paper::A4, "A4"), (Paper::A3, "A3"), (Paper::A2, "A2")][number % 3];
        let paper = if number % 2 == 0 { paper } else { paper.rotated() };
        let angle = if number % 4 < 2 { SheetAngle::First } else { SheetAngle::Third };
        let count = 1 + number % 3;
        let views = (0..count).map(|_| random_request(&mut random, size)).collect();
        let mut sheet = Sheet { views, ..sheet((paper, name), angle) };
        sheet.style.hidden_lines = HiddenLines::Removed;
        let retained = [[0.0, -1.0, 0.0], [-1.0, -1.0, 0.0], [-1.0, -1.0, -1.0]][number % 3];
        let cut = plane(DVec3::ZERO, retained.into());
        let cuts = if number % 5 == 0 { vec![cut] } else { Vec::new() };
        match sheet.draw(&[box_model(size)], &cuts, 1) {
            Ok(page) => {
                drawn += 1;
                left_out += page.warnings.len();
                messages.extend(faults(&page).iter().map(|fault| format!("{number}: {fault}")));
            }
            // Two requests may be for the same view.
            Err(SheetError::Request { .. }) => {}
            Err(error) => panic!("{number}: {error}"),
        }
    }
    assert!(messages.is_empty(), "{}: {:#?}", messages.len(), &messages[..messages.len().min(12)]);
    assert!(drawn > 100 && left_out < drawn / 4, "{drawn} drawn, {left_out} warnings");
}
