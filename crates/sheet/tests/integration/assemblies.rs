//! Assemblies: parts lists, balloons, exploded views and part sheets.

use super::balloons::{balloon_faults, crossing_leaders, layer, texts, view_extent};
use super::boxes::sheet;
use super::lint::faults;
use super::parts_models::{
    assembly, box_primitive, letters, placed, prism_primitive, scattered_parts, stacked_assembly,
};
use super::separation::{intersecting_parts, part_triangles};
use glam::DVec3;
use homog::Affine;
use model::{Node, Topology};
use projection::SheetAngle;
use sheet::{
    AssemblyPages, AssemblyWarning, ExplosionAxis, ExplosionSettings, PartDensity, PartsList,
    Sheet, SheetPage, SheetWarning, explode_models,
};
use std::sync::Arc;
use viewport::Paper;

/// Returns a sheet with every page of an assembly.
fn assembly_sheet(paper: (Paper, &'static str)) -> Sheet {
    let assembly = AssemblyPages { parts_list: true, balloons: true, ..AssemblyPages::default() };
    Sheet { assembly, ..sheet(paper, SheetAngle::First) }
}

/// The papers used in most tests.
const PAPERS: [(Paper, &str); 2] = [(Paper::A3, "A3"), (Paper::A4, "A4")];

/// Describes all faults on the pages.
fn faults_of_pages(pages: &[SheetPage]) -> Vec<String> {
    let numbered = pages.iter().zip(1..);
    numbered
        .flat_map(|(page, number)| {
            let found = faults(page).into_iter().chain(balloon_faults(page));
            found.map(move |fault| format!("page {number}: {fault}"))
        })
        .collect()
}

#[test]
fn an_assembly_of_fifty_parts_has_a_correct_list_and_legible_pages() {
    // There are ten kinds of parts, five of each.
    let models = [stacked_assembly(10, 5)];
    for (paper, name) in PAPERS {
        for paper in [paper, paper.rotated()] {
            for explosion in [None, Some(ExplosionSettings::default())] {
                let mut sheet = assembly_sheet((paper, name));
                sheet.assembly.explosion = explosion;
                let pages = sheet.draw_pages(&models, &[], 2).unwrap();
                assert_eq!(faults_of_pages(&pages), [""; 0], "{name}");
                assert_eq!(crossing_leaders(&pages[1]), [""; 0], "{name}");
                let list: Vec<String> =
                    pages.iter().flat_map(|page| texts(page, "parts-list-text")).collect();
                for kind in 0..10 {
                    let material = if kind % 5 == 0 { "steel" } else { "brass" };
                    let row =
                        [(kind + 1).to_string(), "5".to_owned(), format!("part {}", letters(kind))];
                    let found =
                        list.windows(4).any(|cells| cells[..3] == row && cells[3] == material);
                    assert!(found, "{row:?} is not in {list:?}");
                }
                let numbers: Vec<String> =
                    pages.iter().flat_map(|page| texts(page, "balloon-numbers")).collect();
                let warnings = pages[1].warnings.iter();
                let hidden = warnings.map(|warning| match warning {
                    SheetWarning::Assembly(AssemblyWarning::NotVisible { count, .. }) => *count,
                    _ => 0,
                });
                let hidden: usize = hidden.sum();
                assert_eq!(numbers.len() + hidden, 10, "{:?}", pages[1].warnings);
                assert!(explosion.is_none() || hidden == 0, "{:?}", pages[1].warnings);
                let count = pages.len();
                for (page, number) in pages.iter().zip(1..) {
                    let values = texts(page, "title-block-text");
                    assert!(values.contains(&format!("{number}/{count}")), "{values:?}");
                }
            }
        }
    }
}

#[test]
fn fifty_different_parts_take_three_pages() {
    let models = [stacked_assembly(50, 1)];
    let mut sheet = assembly_sheet((Paper::A3.rotated(), "A3"));
    sheet.assembly.explosion = Some(ExplosionSettings { axis: ExplosionAxis::Y, distance: None });
    let pages = sheet.draw_pages(&models, &[], 2).unwrap();
    assert_eq!((pages.len(), faults_of_pages(&pages)), (3, Vec::new()));
    assert_eq!(crossing_leaders(&pages[1]), [""; 0]);
    assert_eq!(texts(&pages[1], "balloon-numbers").len(), 50, "{:?}", pages[1].warnings);
    // The third page has 50 rows in two columns, each with a heading.
    assert_eq!(texts(&pages[2], "parts-list-text").len(), 2 * 4 + 50 * 4);
    assert!(layer(&pages[1], "parts-list").is_none());
}

#[test]
fn a_thousand_parts_are_listed_and_numbered() {
    // A thousand parts take a minute, so only `cargo xtask test units-all` uses that many.
    let (parts, each) =
        if std::env::var_os("THOROUGH").is_some() { (1000, 100) } else { (150, 15) };
    for (kinds, models) in [(parts, scattered_parts(parts)), (10, stacked_assembly(10, each))] {
        let models = [models];
        let mut sheet = assembly_sheet((Paper::A1.rotated(), "A1"));
        sheet.assembly.explosion = Some(ExplosionSettings::default());
        let pages = sheet.draw_pages(&models, &[], 2).unwrap();
        let rows: usize =
            pages.iter().map(|page| texts(page, "parts-list-text").len()).sum::<usize>() / 4;
        let headings = pages
            .iter()
            .map(|page| texts(page, "parts-list-text").iter().filter(|t| *t == "Qty").count());
        assert_eq!(rows - headings.sum::<usize>(), kinds);
        let numbers = pages.iter().map(|page| texts(page, "balloon-numbers").len());
        let found = numbers.sum::<usize>();
        assert!(found * 10 > kinds * 9, "{found} of {kinds}: {:?}", pages[1].warnings);
        for page in pages.iter().skip(1) {
            assert_eq!(faults(page), [""; 0]);
            assert_eq!(balloon_faults(page), [""; 0]);
        }
    }
}

#[test]
fn masses_are_volume_times_density() {
    let hexagon = prism_primitive(10.0, 30.0, 6);
    let mut open = box_primitive(DVec3::splat(10.0));
    open.indices.truncate(30);
    let models = [assembly(
        vec![
            (box_primitive(DVec3::new(10.0, 20.0, 30.0)), "steel"),
            (hexagon, "brass"),
            (open, "steel"),
            (box_primitive(DVec3::ONE), ""),
        ],
        vec![
            ("block".to_owned(), 0, placed(DVec3::X * 100.0, 0.7)),
            ("bar".to_owned(), 1, Affine::scale(-2.0, 1.0, 1.0)),
            ("tray".to_owned(), 2, placed(DVec3::Y * 1e4, 0.0)),
            ("cube".to_owned(), 3, Affine::IDENTITY),
        ],
    )];
    let density = |of: &str, grams_per_cubic_centimeter| PartDensity {
        of: of.to_owned(),
        grams_per_cubic_centimeter,
    };
    let densities = [density("steel", 8.0), density("bar", 2.0), density("*", 1.0)];
    let list = PartsList::new(&models, &densities, 1.0);
    // A hexagon with circumradius r has an area of 3/2 √3 r². The scale makes it twice as wide.
    let bar = 1.5 * libm::sqrt(3.0) * 100.0 * 30.0 * 2.0 / 1000.0 * 2.0;
    let expected = [Some(6.0 * 8.0), Some(bar), None, Some(0.001)];
    for (item, expected) in list.items.iter().zip(expected) {
        match (item.mass, expected) {
            (Some(mass), Some(known)) => assert!((mass / known - 1.0).abs() < 1e-6, "{item:?}"),
            (mass, known) => assert_eq!(mass, known),
        }
    }
    assert_eq!(
        list.warnings,
        [SheetWarning::Assembly(AssemblyWarning::MassUnknown { part: "tray".to_owned() })]
    );
    let csv = list.to_csv();
    assert!(
        csv.starts_with("item,quantity,name,material,mass_grams\r\n1,1,block,steel,48.000\r\n")
    );
}

#[test]
fn only_identical_copies_count_as_one_part() {
    let size = DVec3::new(3.0, 2.0, 1.0);
    let nodes: Vec<(String, usize, Affine<_, _>)> = vec![
        ("bolt.001".to_owned(), 0, placed(DVec3::X * 5.0, 0.0)),
        // This bolt is rotated and uses the copy of the mesh.
        ("bolt.002".to_owned(), 1, placed(DVec3::X * 15.0, 1.1)),
        ("bolt".to_owned(), 0, placed(DVec3::X * 25.0, 0.3)),
        // These differ in size, handedness, name and material, in this order.
        ("bolt.003".to_owned(), 0, Affine::scale(1.1, 1.0, 1.0)),
        ("bolt.004".to_owned(), 0, Affine::scale(-1.0, 1.0, 1.0)),
        ("screw".to_owned(), 0, placed(DVec3::Z * 20.0, 0.0)),
        ("bolt.005".to_owned(), 2, placed(DVec3::Z * 30.0, 0.0)),
    ];
    let shared = (box_primitive(size), "steel");
    let models = [assembly(vec![shared.clone(), shared, (box_primitive(size), "brass")], nodes)];
    // The copy's material has the same name and color as the first material.
    let list = PartsList::new(&models, &[], 1.0);
    let found: Vec<(usize, &str, &str)> = list
        .items
        .iter()
        .map(|item| (item.quantity, item.name.as_str(), item.material.as_str()))
        .collect();
    assert_eq!(
        found,
        [
            (3, "bolt", "steel"),
            (1, "bolt.003", "steel"),
            (1, "bolt.004", "steel"),
            (1, "screw", "steel"),
            (1, "bolt.005", "brass"),
        ]
    );
    // If the model occurs twice, every part occurs twice.
    let twice = [models[0].clone(), models[0].clone()];
    let doubled = PartsList::new(&twice, &[], 1.0);
    assert!(doubled.items.iter().zip(&list.items).all(|(a, b)| a.quantity == 2 * b.quantity));
}

#[test]
fn exploded_parts_do_not_intersect() {
    use ExplosionAxis::{All, Auto, X, Y, Z};
    // Rotated pins pass through plates, so that many parts intersect before they are moved.
    let models = [stacked_assembly(12, 4)];
    assert!(intersecting_parts(&part_triangles(&models)).len() > 10);
    for axis in [Auto, X, Y, Z, All] {
        let exploded = explode_models(&models, &ExplosionSettings { axis, distance: None });
        let parts = part_triangles(&exploded);
        // The last object contains the paths.
        assert_eq!((parts.len(), intersecting_parts(&parts)), (49, Vec::new()), "{axis:?}");
    }
}

#[test]
fn bolts_leave_on_the_free_side() {
    // A hub on a flange is one part, and the bolts are on the flange, below the middle of that
    // part.
    let mut housing = box_primitive(DVec3::new(40.0, 4.0, 40.0));
    let hub = prism_primitive(10.0, 20.0, 24);
    let first = housing.positions.len() as u32;
    housing.positions.extend(hub.positions.iter().map(|[x, y, z]| [*x, y + 12.0, *z]));
    housing.indices.extend(hub.indices.iter().map(|index| index + first));
    housing.normals = None;
    let mut nodes = vec![("housing".to_owned(), 0, Affine::IDENTITY)];
    for (x, z) in [(-15.0, 0.0), (15.0, 0.0), (0.0, -15.0), (0.0, 15.0)] {
        nodes.push(("bolt".to_owned(), 1, placed(DVec3::new(x, 3.0, z), 0.0)));
    }
    let bolt = prism_primitive(2.0, 2.0, 6);
    let models = [assembly(vec![(housing, "steel"), (bolt, "steel")], nodes)];
    let settings = ExplosionSettings { axis: ExplosionAxis::Y, distance: Some(5.0) };
    let exploded = explode_models(&models, &settings);
    let parts = part_triangles(&exploded);
    assert_eq!(intersecting_parts(&parts), Vec::<[usize; 2]>::new());
    for bolt in &parts[1..5] {
        let low = bolt.iter().flatten().map(|corner| corner.y).fold(f64::INFINITY, f64::min);
        // The bolts end up beside the hub, 5 above the flange, which ends at 2.
        assert!((low - 7.0).abs() < 1e-6, "{low}");
    }
}

#[test]
fn unusual_names_are_drawn_or_reported() {
    let shape = || (box_primitive(DVec3::new(3.0, 2.0, 1.0)), "");
    let long = "a name of many words ".repeat(200);
    let names = [
        "",
        "\u{0}\u{7}\n",
        "a\r\nb\t\u{202e}c",
        "\u{5d1}\u{5d5}\u{5e8}\u{5d2}",
        "螺栓",
        &long,
        "x",
        "x",
    ];
    let primitives: Vec<_> = (0..names.len())
        .map(|k| (box_primitive(DVec3::new(3.0, 2.0, 1.0 + k as f64)), ""))
        .chain([shape()])
        .collect();
    let nodes = names
        .iter()
        .enumerate()
        .map(|(k, name)| ((*name).to_owned(), k, placed(DVec3::X * (10.0 * k as f64), 0.0)))
        .collect();
    let mut instance = assembly(primitives, nodes);
    let model = Arc::make_mut(&mut instance.model);
    // The part is at the end of a chain of ten thousand nodes.
    for depth in 0..10_000 {
        let index = model.nodes.len();
        let parent = (depth > 0).then(|| index - 1);
        match parent {
            Some(parent) => model.nodes[parent].children.push(index),
            None => model.roots.push(index),
        }
        let mesh = (depth == 9999).then_some(8);
        model.nodes.push(Node { parent, mesh, ..Node::default() });
    }
    let mut sheet = assembly_sheet((Paper::A4, "A4"));
    sheet.assembly.part_sheets = true;
    let pages = sheet.draw_pages(&[instance], &[], 1).unwrap();
    assert_eq!(faults_of_pages(&pages), [""; 0]);
    let list: Vec<String> = pages.iter().flat_map(|page| texts(page, "parts-list-text")).collect();
    for text in ["part", "a b c", "\u{5d1}\u{5d5}\u{5e8}\u{5d2}", "螺栓", "x"] {
        assert!(list.iter().any(|cell| cell == text), "{text} is not in {list:?}");
    }
    assert!(list.iter().any(|cell| cell.starts_with("a name of many") && cell.ends_with("...")));
    let unreadable = |warning: &SheetWarning| matches!(warning, SheetWarning::Assembly(AssemblyWarning::NamesUnreadable { name, count: 2 }) if name.starts_with('\u{5d1}'));
    assert!(pages[0].warnings.iter().any(unreadable), "{:?}", pages[0].warnings);
}

#[test]
fn every_item_has_a_sheet_at_a_suitable_scale() {
    let models = [stacked_assembly(6, 2)];
    let mut sheet = assembly_sheet((Paper::A4, "A4"));
    sheet.title_block.number = "7-100".to_owned();
    sheet.assembly = AssemblyPages { part_sheets: true, ..AssemblyPages::default() };
    let pages = sheet.draw_pages(&models, &[], 1).unwrap();
    assert_eq!((pages.len(), faults_of_pages(&pages)), (7, Vec::new()));
    for (page, kind) in pages[1..].iter().zip(0..) {
        assert_eq!(page.title, format!("part {}", letters(kind)));
        let values = texts(page, "title-block-text");
        assert!(values.contains(&format!("7-100-{}", kind + 1)), "{values:?}");
        // Parts that are tilted in the assembly are drawn upright: 6 mm high, or 4 mm for a plate.
        let lengths = texts(page, "dimensions-text");
        let height = if kind % 5 == 0 { "4" } else { "6" };
        assert!(lengths.iter().any(|length| length == height), "{lengths:?}");
    }
}

#[test]
fn models_without_parts_are_reported() {
    let mut points = box_primitive(DVec3::ONE);
    points.topology = Topology::Points;
    let models = [assembly(vec![(points, "")], vec![("cloud".to_owned(), 0, Affine::IDENTITY)])];
    let pages = assembly_sheet((Paper::A4, "A4")).draw_pages(&models, &[], 1).unwrap();
    assert_eq!(
        (
            pages.len(),
            pages[0].warnings.contains(&SheetWarning::Assembly(AssemblyWarning::NoParts))
        ),
        (1, true)
    );
}

#[test]
fn a_sheet_without_an_assembly_has_only_the_page_from_draw() {
    let models = [stacked_assembly(3, 2)];
    let plain = sheet((Paper::A4, "A4"), SheetAngle::First);
    let page = plain.draw(&models, &[], 1).unwrap();
    assert_eq!(plain.draw_pages(&models, &[], 2).unwrap(), [page]);
    let pages = assembly_sheet((Paper::A4, "A4")).draw_pages(&models, &[], 1).unwrap();
    assert!(view_extent(&pages[1]).is_some());
}
