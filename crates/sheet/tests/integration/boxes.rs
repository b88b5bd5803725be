//! Boxes of random proportions on every paper size, in both orientations and projection angles, cut
//! and uncut.

use super::lint::{faults, layer_extent};
use glam::DVec3;
use homog::{Affine, Normal, Plane, Point, World};
use model::{Mesh, Model, ModelInstance, Node, Primitive};
use projection::SheetAngle;
use sheet::{Sheet, SheetPage, SheetWarning};
use std::sync::Arc;
use viewport::{DrawingScale, Paper};

/// The papers, with their names.
pub const PAPERS: [(Paper, &str); 8] = [
    (Paper::A0, "A0"),
    (Paper::A1, "A1"),
    (Paper::A2, "A2"),
    (Paper::A3, "A3"),
    (Paper::A4, "A4"),
    (Paper::A5, "A5"),
    (Paper::LETTER, "Letter"),
    (Paper::TABLOID, "Tabloid"),
];

/// Pseudorandom numbers (SplitMix64) that are the same in every run.
pub struct Random(pub u64);

impl Random {
    /// Returns a number from 0 to 1.
    pub fn fraction(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((bits ^ (bits >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Returns a number from `low` to `high` whose logarithm is uniformly distributed.
    pub fn by_magnitude(&mut self, low: f64, high: f64) -> f64 {
        low * libm::exp(self.fraction() * libm::log(high / low))
    }
}

/// Returns a box with these sides around the origin.
pub fn box_model(size: DVec3) -> ModelInstance {
    let corner = |n: usize| {
        [0, 1, 2].map(|axis| (size[axis] * if n >> axis & 1 == 0 { -0.5 } else { 0.5 }) as f32)
    };
    let faces =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let positions: Vec<[f32; 3]> = faces.as_flattened().iter().map(|&n| corner(n)).collect();
    let indices: Vec<u32> = (0..6).flat_map(|f| [0, 1, 2, 0, 2, 3].map(|k| 4 * f + k)).collect();
    instance_of(Primitive { positions, indices, ..Primitive::default() })
}

/// Returns a model of one primitive.
pub fn instance_of(primitive: Primitive) -> ModelInstance {
    let model = Model {
        nodes: vec![Node { mesh: Some(0), ..Node::default() }],
        roots: vec![0],
        meshes: vec![Mesh { primitives: vec![primitive], ..Mesh::default() }],
        ..Model::default()
    };
    ModelInstance { model: Arc::new(model), model_to_world: Affine::scale(1.0, 1.0, 1.0) }
}

/// Returns the plane through a point that retains the side in a direction.
pub fn plane(point: DVec3, retained: DVec3) -> Plane<World> {
    let [x, y, z] = retained.to_array();
    let normal = Normal::new(x, y, z).normalized().expect("a direction");
    Plane::through(Point::from_raw(point), normal)
}

/// Returns a sheet in millimeters.
pub fn sheet((paper, name): (Paper, &str), angle: SheetAngle) -> Sheet {
    let mut sheet = Sheet::for_paper(paper, name);
    sheet.projection_angle = angle;
    sheet.millimeters_per_unit = 1.0;
    sheet.title_block.title = "Box".to_owned();
    sheet
}

/// Whether a view with this name is on the sheet.
pub fn has_view(page: &SheetPage, name: &str) -> bool {
    layer_extent(page, |id| id.starts_with(&format!("{name}-"))).is_some()
}

/// Whether the view is on the sheet or a warning reports its absence, but not both.
fn is_there_or_named(page: &SheetPage, prefix: &str, title: &str) -> bool {
    let named = SheetWarning::ViewLeftOut { view: title.to_owned() };
    has_view(page, prefix) != page.warnings.contains(&named)
}

/// The directions toward the sides that sections retain, or `None` for no section.
const SECTIONS: [Option<[f64; 3]>; 10] = [
    None,
    Some([-1.0, 0.0, 0.0]),
    Some([1.0, 0.0, 0.0]),
    Some([0.0, -1.0, 0.0]),
    Some([0.0, 1.0, 0.0]),
    Some([0.0, 0.0, -1.0]),
    Some([0.0, 0.0, 1.0]),
    Some([-1.0, -1.0, 0.0]),
    Some([0.0, -1.0, -2.0]),
    None,
];

#[test]
fn boxes_of_all_proportions_are_complete_and_legible_on_every_sheet() {
    let mut random = Random(25);
    let (mut left_out, mut messages) = (0, Vec::new());
    for number in 0..960 {
        let paper = PAPERS[number % 8];
        let paper = if number / 8 % 2 == 0 { paper } else { (paper.0.rotated(), paper.1) };
        let angle = if number / 16 % 2 == 0 { SheetAngle::First } else { SheetAngle::Third };
        let magnitude = random.by_magnitude(1.0, 10_000.0);
        let size = DVec3::from([(); 3].map(|()| magnitude * random.by_magnitude(0.02, 1.0)));
        let mut sheet = sheet(paper, angle);
        sheet.dimensions = number % 7 != 0;
        let model = [box_model(size)];
        let place = size * (random.fraction() - 0.5) * 0.9;
        let section = SECTIONS[number / 32 % SECTIONS.len()];
        let planes: Vec<_> =
            section.into_iter().map(|retained| plane(place, retained.into())).collect();
        let page = match sheet.draw(&model, &planes, 1) {
            Ok(page) => page,
            Err(error) => {
                messages.push(format!("box {number}: {error}"));
                continue;
            }
        };
        let has_side = has_view(&page, "left") || has_view(&page, "right");
        let mut found: Vec<String> = faults(&page);
        if !(has_view(&page, "front") && has_view(&page, "top") && has_side) {
            found.push("a principal view is missing".to_owned());
        }
        if !is_there_or_named(&page, "isometric", "isometric view") {
            found.push("the isometric view is missing".to_owned());
        }
        let has_line = page.layers.iter().any(|layer| layer.id == "cut-lines");
        // Each section line has two letters, and a cut view has a name below it.
        let names = page.layers.iter().find(|layer| layer.id == "cut-names");
        let is_cut = names.is_some_and(|layer| layer.groups.len() % 2 == 1);
        let is_named = page.warnings.iter().any(
            |warning| matches!(warning, SheetWarning::ViewLeftOut { view } if view == "section A-A"),
        );
        let is_shown = planes.is_empty() || has_line && is_cut != is_named;
        if !is_shown {
            found.push(format!("cut line {has_line}, cut view {is_cut}, named {is_named}"));
        }
        left_out += usize::from(!page.warnings.is_empty());
        if !found.is_empty() {
            messages.push(format!("box {number} of {size:.1} on {} {angle:?}: {found:?}", paper.1));
        }
    }
    assert!(messages.is_empty(), "{}: {:#?}", messages.len(), &messages[..messages.len().min(12)]);
    // A smaller scale is used if it leaves room, so views are rarely omitted.
    assert!(left_out <= 10, "{left_out} sheets lack a view");
}

#[test]
fn the_isometric_view_is_as_large_as_the_sheet_allows() {
    // A flat part leaves a strip beside its top view and the whole bottom of the sheet free.
    let model = [box_model(DVec3::new(250.0, 30.0, 60.0))];
    let page = sheet((Paper::A3.rotated(), "A3"), SheetAngle::First).draw(&model, &[], 1).unwrap();
    let [low, high] = layer_extent(&page, |id| id.starts_with("isometric-")).expect("a view");
    // The width is (250 + 60) cos 30°, foreshortened by √⅔, which is 219 mm at 1:1. The view is at
    // the sheet's scale or half of it.
    let width = (250.0 + 60.0) * libm::sqrt(0.5);
    let scale = (high.x - low.x) / width;
    assert!([1.0, 0.5].iter().any(|s| (scale - s).abs() < 1e-3), "{scale}");
}

#[test]
fn the_paper_is_turned_to_allow_the_larger_scale() {
    let wide = [box_model(DVec3::new(743.0, 200.0, 300.0))];
    let tall = [box_model(DVec3::new(200.0, 743.0, 200.0))];
    let portrait = sheet((Paper::A4, "A4"), SheetAngle::First);
    assert!(portrait.clone().with_best_orientation(&wide, &[]).paper.width() > 290.0);
    assert_eq!(portrait.clone().with_best_orientation(&tall, &[]).paper, Paper::A4);
    // A requested scale is kept, and the orientation is one in which it fits.
    let given = Sheet { scale: DrawingScale::new(1, 5).ok(), ..portrait };
    let turned = given.with_best_orientation(&wide, &[]);
    assert!(turned.check_layout(&wide, &[]).is_ok());
}

#[test]
fn views_without_room_at_a_requested_scale_are_reported() {
    let mut random = Random(7);
    let (mut named, mut drawn) = (0, 0);
    for number in 0..300 {
        let size = DVec3::from([(); 3].map(|()| random.by_magnitude(10.0, 45.0)));
        let mut sheet = sheet((Paper::A5.rotated(), "A5"), SheetAngle::First);
        sheet.scale = DrawingScale::new(1, 1).ok();
        let retained = [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0], [1.0, 2.0, 0.0]];
        let planes = retained.map(|retained| plane(DVec3::ZERO, retained.into()));
        // Views larger than the paper cause an error that suggests a scale.
        let Ok(page) = sheet.draw(&[box_model(size)], &planes, 1) else { continue };
        for (prefix, title) in [
            ("isometric", "isometric view"),
            ("section-a", "section A-A"),
            ("section-b", "section B-B"),
            ("section-c", "section C-C"),
            ("section-d", "section D-D"),
        ] {
            assert!(is_there_or_named(&page, prefix, title), "{number}: {size} {prefix}");
        }
        assert_eq!(faults(&page), [""; 0], "{number}: {size}");
        drawn += 1;
        named += page.warnings.len();
    }
    assert!(drawn > 20 && named > 0, "{named} of {drawn}");
}

#[test]
fn models_of_extreme_sizes_fit_at_some_scale() {
    for side in [0.5, 50.0, 1000.0, 100_000.0, 300_000.0] {
        for (paper, name) in PAPERS {
            let model = [box_model(DVec3::splat(side))];
            let page = sheet((paper, name), SheetAngle::Third).draw(&model, &[], 1);
            assert!(page.is_ok(), "{side} on {name}: {:?}", page.err());
        }
    }
    // A model of a thousand kilometers is too large, and the message states the required size.
    let model = [box_model(DVec3::splat(1e9))];
    let error = sheet(PAPERS[4], SheetAngle::First).draw(&model, &[], 1).expect_err("too large");
    assert!(error.to_string().contains("at 1:10000: they need 2000"), "{error}");
}
