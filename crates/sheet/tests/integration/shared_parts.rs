//! Line drawings of machined parts from CAD, in `shared/repro/parts` next to the repository. The
//! tests are reported as skipped if the folder is missing.

use super::boxes::plane;
use super::fill::skip;
use camera::{Camera, ViewProjection};
use glam::DVec3;
use hidden_line::{DrawOptions, EdgeClass, Subject, draw};
use homog::{Affine, Point, Vector};
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

/// Returns the length of the visible lines of a sectioned part in an isometric view, without
/// hatching, in units of the model.
fn sectioned_length(part: &[ModelInstance], axis: DVec3, at: f64) -> f64 {
    let camera =
        Camera::look_to(Point::new(300.0, 300.0, 300.0), -Vector::new(1.0, 1.0, 1.0), Vector::Y);
    let window = Orthographic::new(-200.0, 200.0, -200.0, 200.0, -2000.0, 2000.0).unwrap();
    let subject = Subject {
        models: part,
        view_projection: ViewProjection {
            camera: camera.unwrap(),
            view_to_clip: window.view_to_clip(Convention::CHAPTER),
        },
        size: [400; 2],
        caption_height: 0,
        sections: &[plane(axis * at, -axis)],
        uncut: &[],
    };
    let drawing = draw(&subject, &DrawOptions::default(), 2).unwrap();
    let lines = drawing.segments.iter().filter(|line| line.class != EdgeClass::Hatching);
    lines.filter(|line| line.visible).map(|line| line.ends[0].distance(line.ends[1])).sum()
}

/// The vertices of these parts on their planes of symmetry are off them by up to 5e-15.
#[test]
fn planes_of_symmetry_cut_parts_without_false_lines() {
    let Some(folder) = parts_folder("sections of shared parts") else { return };
    for (name, axis, expected) in [
        ("hs", DVec3::X, 615.84),
        ("knob", DVec3::Z, 338.63),
        ("elbow", DVec3::Z, 747.84),
        ("bolt", DVec3::Z, 179.04),
    ] {
        let model =
            load(&folder.join(name).with_extension("stl"), &ImportOptions::default()).unwrap();
        let part = [ModelInstance {
            model: Arc::new(model),
            model_to_world: Affine::scale(1.0, 1.0, 1.0),
        }];
        let length = sectioned_length(&part, axis, 0.0);
        // The expected lengths are those of files, which omit the shortest lines.
        assert!(
            (length - expected).abs() < 0.005 * expected,
            "{name}: {length}, expected {expected}"
        );
        // The same lines remain beside the plane, on the side that is retained.
        let beside = sectioned_length(&part, axis, -0.0005);
        assert!((length - beside).abs() < 0.02, "{name}: {length} and {beside}");
    }
}
