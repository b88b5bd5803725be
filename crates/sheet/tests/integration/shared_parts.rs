//! Line drawings of machined parts from CAD, in `shared/repro/parts` next to the repository. The
//! tests are reported as skipped if the folder is missing.

use super::boxes::plane;
use super::fill::skip;
use camera::{Camera, ViewProjection};
use glam::DVec3;
use hidden_line::{Agreement, DrawOptions, EdgeClass, Subject, draw, verify_with_z_buffer};
use homog::{Affine, Plane, Point, Vector, World};
use import::{ImportOptions, load};
use model::ModelInstance;
use projection::{Convention, Orthographic};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Returns the folder of the parts, or reports that a test is skipped.
fn parts_folder(test: &str) -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/repro/parts");
    if !folder.is_dir() {
        skip::report_skip(test, &format!("{} was not found", folder.display()));
        return None;
    }
    Some(folder)
}

/// The drawing of a part in an isometric view.
struct PartDrawing {
    /// The length of the visible lines without hatching, in units of the model.
    length: f64,
    agreement: Agreement,
}

/// Draws a part, cut by planes, and compares the drawing with its z-buffer image.
fn draw_part(part: &[ModelInstance], sections: &[Plane<World>]) -> PartDrawing {
    let eye = Point::new(300.0, 300.0, 300.0);
    let camera = Camera::look_to(eye, -Vector::new(1.0, 1.0, 1.0), Vector::Y);
    let window = Orthographic::new(-200.0, 200.0, -200.0, 200.0, -2000.0, 2000.0).unwrap();
    let subject = Subject {
        models: part,
        view_projection: ViewProjection {
            camera: camera.unwrap(),
            view_to_clip: window.view_to_clip(Convention::CHAPTER),
        },
        size: [1600; 2],
        caption_height: 0,
        sections,
        uncut: &[],
    };
    let drawing = draw(&subject, &DrawOptions::default(), 2).unwrap();
    let lines = drawing.segments.iter().filter(|line| line.visible);
    let lines = lines.filter(|line| line.class != EdgeClass::Hatching);
    let length = lines.map(|line| line.ends[0].distance(line.ends[1]) / 4.0).sum();
    PartDrawing { length, agreement: verify_with_z_buffer(&subject, &drawing.segments).unwrap() }
}

/// Loads a part.
fn load_part(path: &Path) -> [ModelInstance; 1] {
    let model = Arc::new(load(path, &ImportOptions::default()).unwrap());
    [ModelInstance { model, model_to_world: Affine::scale(1.0, 1.0, 1.0) }]
}

/// The vertices of these parts on their planes of symmetry are off them by up to 5e-15.
#[test]
fn planes_of_symmetry_cut_parts_without_false_lines() {
    let Some(folder) = parts_folder("sections of shared parts") else { return };
    for (name, axis, expected) in [
        ("hs.stl", DVec3::X, 615.84),
        ("knob.stl", DVec3::Z, 338.63),
        ("elbow.stl", DVec3::Z, 747.84),
        ("bolt.stl", DVec3::Z, 179.04),
    ] {
        let part = load_part(&folder.join(name));
        let length = draw_part(&part, &[plane(DVec3::ZERO, -axis)]).length;
        // The expected lengths are those of files, which omit the shortest lines.
        assert!((length - expected).abs() < 0.005 * expected, "{name}: {length}, not {expected}");
        // The same lines remain beside the plane, on the side that is retained.
        let beside = draw_part(&part, &[plane(axis * -0.0005, -axis)]).length;
        assert!((length - beside).abs() < 0.02, "{name}: {length} and {beside}");
    }
    // Beyond the plane, an edge of the bolt's head in the plane is drawn beside its section.
    let bolt = load_part(&folder.join("bolt.stl"));
    let [at, beyond] =
        [0.0, 0.0005].map(|z| draw_part(&bolt, &[plane(DVec3::Z * z, -DVec3::Z)]).length);
    let edge = (6.4 - 0.9) * (2.0_f64 / 3.0).sqrt();
    assert!((beyond - at - edge).abs() < 0.1, "{beyond} is not {at} + {edge}");
}

#[test]
fn lines_of_parts_have_a_reason_in_the_z_buffer_image() {
    let Some(folder) = parts_folder("lines of shared parts") else { return };
    let mut files: Vec<PathBuf> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    let is_stl = |file: &&PathBuf| file.extension().is_some_and(|extension| extension == "stl");
    // In the assembly, bodies of one object overlap.
    let is_assembly = |file: &PathBuf| file.ends_with("asm_all.stl");
    for file in files.iter().filter(is_stl) {
        let part = load_part(file);
        let planes = [DVec3::X, DVec3::Z].map(|axis| plane(DVec3::ZERO, -axis));
        let cuts: &[&[Plane<World>]] =
            if is_assembly(file) { &[&[]] } else { &[&[], &planes[..1], &planes[1..]] };
        for cut in cuts {
            let agreement = draw_part(&part, cut).agreement;
            assert_eq!(agreement.groundless_length, 0.0, "{}: {cut:?}", file.display());
        }
    }
}
