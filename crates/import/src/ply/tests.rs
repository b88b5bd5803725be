//! Tests of handwritten PLY files: the resulting models, and the messages about broken files.

use crate::load_bytes;
use gltf_import::linear_from_srgb;
use gltf_import::{ImportOptions, ScalarColors};
use model::{AlphaMode, Colormap, Diagnostic, Model, Topology};

fn load(bytes: &[u8]) -> Model {
    let model = load_bytes("a.ply", bytes, &ImportOptions::default());
    model.unwrap_or_else(|error| panic!("{error}"))
}

fn fault(bytes: &[u8]) -> String {
    load_bytes("a.ply", bytes, &ImportOptions::default()).unwrap_err().diagnostic.sentence()
}

fn load_leniently(bytes: &[u8]) -> Model {
    load_bytes("a.ply", bytes, &ImportOptions { lenient: true, ..ImportOptions::default() })
        .unwrap()
}

/// Returns the corner positions of each triangle.
fn corners(model: &Model) -> Vec<[[f32; 3]; 3]> {
    let primitives = model.meshes.iter().flat_map(|mesh| &mesh.primitives);
    let of = |p: &model::Primitive| {
        let at = |index: u32| p.positions[index as usize];
        p.indices.as_chunks::<3>().0.iter().map(|t| t.map(at)).collect::<Vec<_>>()
    };
    primitives.filter(|p| p.topology == Topology::Triangles).flat_map(of).collect()
}

const SQUARE: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [0.0, 2.0, 0.0]];

const HEADER: &str = "element vertex 4\nproperty short flags\nproperty float z\nproperty double x\n\
                      property list uchar char tags\nproperty float32 y\nelement note 2\n\
                      property list int short words\nproperty uchar mark\nelement face 1\n\
                      property list uint8 uint16 vertex_index\nend_header\n";

/// Returns a binary file of the square with properties in an unusual order and an unknown element.
fn binary_square(is_big: bool) -> Vec<u8> {
    let name = if is_big { "binary_big_endian" } else { "binary_little_endian" };
    let mut file = format!("ply\nformat {name} 1.0\n{HEADER}").into_bytes();
    let mut push = |bytes: &[u8]| match is_big {
        true => file.extend(bytes.iter().rev()),
        false => file.extend(bytes),
    };
    for (at, [x, y, z]) in SQUARE.into_iter().enumerate() {
        push(&[7, 1]);
        push(&z.to_le_bytes());
        push(&f64::from(x).to_le_bytes());
        push(&[at as u8]);
        (0..at).for_each(|_| push(b"\n"));
        push(&y.to_le_bytes());
    }
    for words in [0_u32, 2] {
        push(&words.to_le_bytes());
        (0..words).for_each(|_| push(&[1, 2]));
        push(&[9]);
    }
    push(&[4]);
    (0..4_u16).for_each(|at| push(&at.to_le_bytes()));
    file
}

#[test]
fn all_encodings_give_the_same_model() {
    let vertices = "7 0 0 0 0\n7 0 2 1 5 0\n7 0 2 2 5 5 2 7 0 0 3 1 2 3 2";
    let text = format!("ply\nformat ascii 1.0\n{HEADER}{vertices}\n0 1\n\n2 1 1 9\n4 0 1 2 3");
    let windows = text.replace('\n', "\r\n");
    let files =
        [text.into_bytes(), windows.into_bytes(), binary_square(false), binary_square(true)];
    let [a, b, c, d] = SQUARE;
    for file in files {
        let model = load(&file);
        assert!(model.warnings.is_empty(), "{:?}", model.warnings);
        let triangles = corners(&model);
        assert_eq!(triangles.len(), 2);
        assert!(triangles.as_flattened().iter().all(|corner| [a, b, c, d].contains(corner)));
        let normals = model.meshes[0].primitives[0].normals.as_ref().unwrap();
        assert!(normals.iter().all(|normal| *normal == [0.0, 0.0, 1.0]));
    }
}

/// Returns a text file with vertices at (0,0,0), (1,0,0) and (0,1,0) and additional properties.
fn triangle(properties: &str, values: [&str; 3], rest: &str, faces: &str) -> String {
    let [a, b, c] = values;
    format!(
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
         property float z\n{properties}{rest}end_header\n0 0 0 {a}\n1 0 0 {b}\n0 1 0 {c}\n{faces}"
    )
}

const FACE: &str = "element face 1\nproperty list uchar int vertex_indices\n";

#[test]
fn colors_of_every_type_are_srgb() {
    let names =
        |kind: &str| ["red", "green", "blue"].map(|c| format!("property {kind} {c}\n")).concat();
    // The linear light of an sRGB value at or near 0.5 (IEC 61966-2-1).
    for (kind, half, one, expected) in [
        ("uchar", "128", "255", 0.215_860_5),
        ("ushort", "32768", "65535", 0.214_048_1),
        ("float", "0.5", "1", 0.214_041_1),
        ("float", "127.5", "255", 0.214_041_1),
    ] {
        let [a, b, c] = [format!("{one} 0 0"), format!("0 {half} 0"), format!("0 0 {one}")];
        let model = load(triangle(&names(kind), [&a, &b, &c], FACE, "3 0 1 2").as_bytes());
        let colors = model.meshes[0].primitives[0].colors.as_ref().unwrap();
        assert_eq!(colors[0], [1.0, 0.0, 0.0, 1.0], "{kind}");
        assert!((colors[1][1] - expected).abs() < 1e-6, "{kind}: {:?}", colors[1]);
        assert_eq!(colors[2], [0.0, 0.0, 1.0, 1.0], "{kind}");
    }
}

#[test]
fn alpha_blends_unless_it_is_zero_everywhere() {
    let rgba = ["red", "green", "blue", "alpha"].map(|c| format!("property uchar {c}\n")).concat();
    let of = |alpha: [u8; 3]| {
        let values = alpha.map(|alpha| format!("1 2 3 {alpha}"));
        load(triangle(&rgba, values.each_ref().map(String::as_str), FACE, "3 0 1 2").as_bytes())
    };
    let alpha = |model: &Model| model.meshes[0].primitives[0].colors.as_ref().unwrap()[0][3];
    for (values, expected, mode) in [
        ([51, 255, 255], 0.2, AlphaMode::Blend),
        ([255, 255, 255], 1.0, AlphaMode::Opaque),
        ([0, 0, 0], 1.0, AlphaMode::Opaque),
    ] {
        let model = of(values);
        assert_eq!((alpha(&model), model.materials[0].alpha_mode), (expected, mode));
    }
}

#[test]
fn face_colors_split_vertices() {
    let faces = "element face 2\nproperty list uchar int vertex_indices\nproperty uchar red\n\
                 property uchar green\nproperty uchar blue\n";
    let model = load(triangle("", [""; 3], faces, "3 0 1 2 255 0 0\n3 2 1 0 0 0 255").as_bytes());
    let primitive = &model.meshes[0].primitives[0];
    let colors = primitive.colors.as_ref().unwrap();
    let color_at = |corner: usize| colors[primitive.indices[corner] as usize];
    assert!((0..3).all(|at| color_at(at) == [1.0, 0.0, 0.0, 1.0]));
    assert!((3..6).all(|at| color_at(at) == [0.0, 0.0, 1.0, 1.0]));
}

#[test]
fn points_lines_and_strips_are_read() {
    let cloud = load(triangle("", [""; 3], "", "").as_bytes());
    assert_eq!(cloud.meshes[0].primitives[0].topology, Topology::Points);
    assert_eq!(cloud.meshes[0].primitives[0].indices, [0, 1, 2]);
    let edges = "element edge 2\nproperty int vertex1\nproperty int vertex2\n";
    let lines = load(triangle("", [""; 3], edges, "0 1\n1 2").as_bytes());
    assert_eq!(lines.meshes[0].primitives[0].topology, Topology::Lines);
    assert_eq!(lines.meshes[0].primitives[0].indices, [0, 1, 1, 2]);
    let strips = "element tristrips 1\nproperty list int int vertex_indices\n";
    let model = load(triangle("", [""; 3], strips, "8 0 1 2 0 -1 2 1 0").as_bytes());
    let [a, b, c] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    assert_eq!(corners(&model), [[a, b, c], [c, b, a], [c, b, a]]);
}

#[test]
fn items_that_are_not_finite_are_skipped() {
    let file = triangle("", [""; 3], FACE, "3 0 1 2").replace("1 0 0 \n", "nan 1e39 0\n");
    let model = load(file.as_bytes());
    assert!(corners(&model).is_empty());
    assert_eq!(model.warnings.len(), 1);
}

#[test]
fn errors_have_a_location_and_lenient_reading_continues() {
    let bad_index = triangle("", [""; 3], &FACE.replace("face 1", "face 2"), "3 0 1 3\n3 0 1 2");
    let message = fault(bad_index.as_bytes());
    assert!(
        message.starts_with("line 13, column 8: there is no vertex 3: the file has 3"),
        "{message}"
    );
    assert_eq!(corners(&load_leniently(bad_index.as_bytes())).len(), 1);
    let mut truncated = binary_square(false);
    truncated.truncate(truncated.len() - 1);
    let message = fault(&truncated);
    assert!(message.contains("the file ends in the middle of its data"), "{message}");
    assert!(message.starts_with(&format!("byte {}", truncated.len() - 1)), "{message}");
    assert!(corners(&load_leniently(&truncated)).is_empty());
    let word = triangle("", ["", "x", ""], FACE, "3 0 1 2");
    assert!(fault(word.as_bytes()).starts_with("line 11, column 7: \"x\" is not a number"));
}

#[test]
fn declared_counts_are_not_trusted() {
    for (encoding, count) in [("ascii", u64::MAX), ("binary_little_endian", 1 << 60)] {
        for element in ["vertex", "face", "tristrips", "edge", "other"] {
            let file = format!(
                "ply\nformat {encoding} 1.0\nelement {element} {count}\nproperty float x\n\
                 property float y\nproperty float z\nend_header\n"
            );
            assert!(fault(file.as_bytes()).contains("the file ends"), "{file}");
        }
    }
    // A record without properties takes no bytes.
    let file = format!("ply\nformat ascii 1.0\nelement a {}\nend_header\n", u64::MAX);
    assert!(load(file.as_bytes()).meshes[0].primitives.is_empty());
}

#[test]
fn files_that_other_readers_accept_are_read_with_warnings() {
    let text = b"ply\nformat ascii 1.0\nCreated by somebody\nelement vertex 4\nproperty float x\n\
        property float y\nproperty float z\nelement face 2\n\
        property list uchar int vertex_indices\nend_header\n\
        0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 255 128 0\n3 0 2 3 255 128 0\n";
    let model = load(text);
    let expected = [
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]],
        [[0.0; 3], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
    ];
    assert_eq!(corners(&model), expected);
    let warnings: Vec<String> = model.warnings.iter().map(Diagnostic::sentence).collect();
    assert_eq!(warnings.len(), 2, "{warnings:?}");
    assert!(warnings[0].starts_with("line 3: `Created by somebody` is not a line of a PLY header"));
    assert!(warnings[1].contains("2 records from here on have more numbers"), "{warnings:?}");
    // Several records may still share a line.
    let joined = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
        property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
        0 0 0 1 0 0 1 1 0 3 0 1 2\n";
    let model = load(joined.as_bytes());
    assert_eq!((corners(&model).len(), model.warnings.len()), (1, 0));
}

/// Three adjacent triangles. All vertices of a triangle have the same `quality`, which is NaN for
/// the last triangle.
const QUALITIES: &str = "ply\nformat ascii 1.0\nelement vertex 9\nproperty float x\n\
    property float y\nproperty float z\nproperty double quality\nproperty uchar red\n\
    property uchar green\nproperty uchar blue\nproperty short flags\nelement face 3\n\
    property list uchar int vertex_indices\nend_header\n\
    0 0 0 -2 9 9 9 1\n1 0 0 -2 9 9 9 1\n0 1 0 -2 9 9 9 1\n\
    2 0 0 6 9 9 9 1\n3 0 0 6 9 9 9 1\n2 1 0 6 9 9 9 1\n\
    4 0 0 nan 9 9 9 1\n5 0 0 nan 9 9 9 1\n4 1 0 nan 9 9 9 1\n\
    3 0 1 2\n3 3 4 5\n3 6 7 8\n";

#[test]
fn a_scalar_property_replaces_colors() {
    let scalars = ScalarColors { attribute: "quality".to_owned(), ..ScalarColors::default() };
    let options = ImportOptions { scalars: Some(scalars), ..ImportOptions::default() };
    let model = load_bytes("a.ply", QUALITIES.as_bytes(), &options).unwrap();
    assert_eq!(model.scalar_attributes, ["flags", "quality"]);
    assert_eq!(model.active_scalar_attribute, Some(1));
    let primitive = &model.meshes[0].primitives[0];
    assert_eq!(model.materials[primitive.material.unwrap()].base_color, [1.0; 4]);
    let colors = primitive.colors.as_ref().unwrap();
    for (x, code) in [
        (0.0, Colormap::Viridis.srgb_at(0.0)),
        (2.0, Colormap::Viridis.srgb_at(1.0)),
        (4.0, [0.5; 3]),
    ] {
        let vertex = primitive.positions.iter().position(|position| position[0] == x).unwrap();
        let [r, g, b] = code.map(linear_from_srgb);
        assert_eq!(colors[vertex], [r, g, b, 1.0], "{x}");
    }
    let warnings: Vec<String> = model.warnings.iter().map(Diagnostic::sentence).collect();
    let expected = "element vertex: 3 of 9 values of `quality` are not finite; they are drawn gray";
    assert_eq!(warnings, [expected]);
    // Without the option, the colors in the file are used.
    assert_eq!(load(QUALITIES.as_bytes()).active_scalar_attribute, None);
}

#[test]
fn the_error_for_a_missing_scalar_property_lists_the_others() {
    let fault = |name: &str, file: &str, attribute: &str| {
        let scalars = ScalarColors { attribute: attribute.to_owned(), ..ScalarColors::default() };
        let options = ImportOptions { scalars: Some(scalars), ..ImportOptions::default() };
        let error = load_bytes(name, file.as_bytes(), &options).unwrap_err().diagnostic;
        assert_eq!(error.code, model::codes::NO_SUCH_ITEM);
        error.sentence()
    };
    let missing = "the vertices have no scalar attribute `red`; choose one of `flags`, `quality`";
    assert_eq!(fault("a.ply", QUALITIES, "red"), missing);
    let message = fault("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "quality");
    assert!(message.contains("have no scalar attributes such as `quality`"), "{message}");
}
