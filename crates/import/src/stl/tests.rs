//! Tests of the STL importer with valid and broken files in both formats.

use super::*;
use crate::load_bytes;
use gltf_import::ImportOptions;
use model::{Model, Severity};

/// Returns a binary file with these triangles and their attributes.
fn binary(header: &[u8], triangles: &[([[f32; 3]; 3], u16)]) -> Vec<u8> {
    let mut file = header.to_vec();
    file.resize(80, b' ');
    file.extend((triangles.len() as u32).to_le_bytes());
    for (corners, attribute) in triangles {
        file.extend([0; 12]);
        corners.as_flattened().iter().for_each(|x| file.extend(x.to_le_bytes()));
        file.extend(attribute.to_le_bytes());
    }
    file
}

/// The two triangles of a square; they share two vertices.
const SQUARE: [[[f32; 3]; 3]; 2] = [
    [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]],
    [[-0.0, 0.0, 0.0], [1.0, 1.0, -0.0], [0.0, 1.0, 0.0]],
];

/// Returns the square as text with this line end.
fn ascii(end: &str) -> String {
    let facet = |corners: [[f32; 3]; 3]| {
        let vertex = |[x, y, z]: [f32; 3]| format!("vertex {x:e} {y} {z:.3}{end}");
        let vertices: String = corners.into_iter().map(vertex).collect();
        format!("facet normal 0 0 1{end}outer loop{end}{vertices}endloop{end}endfacet{end}")
    };
    let facets: String = SQUARE.into_iter().map(facet).collect();
    format!("solid the part{end}{facets}endsolid the part")
}

fn read(bytes: &[u8]) -> Model {
    load_bytes("part.stl", bytes, &ImportOptions::default()).expect("a model")
}

fn refusal(bytes: &[u8]) -> String {
    let error = load_bytes("part.stl", bytes, &ImportOptions::default()).unwrap_err();
    error.diagnostic.sentence()
}

/// Checks that a model is the square, without warnings.
fn assert_square(model: &Model) {
    assert_eq!(model.warnings, []);
    let primitive = &model.meshes[0].primitives[0];
    assert_eq!(primitive.indices, [0, 1, 2, 0, 2, 3]);
    assert_eq!(primitive.positions, [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
    assert_eq!(primitive.normals.as_deref(), Some(&[[0.0, 0.0, 1.0]; 4][..]));
    assert_eq!((model.length_unit, model.up_axis), (LengthUnit::Millimeter, UpAxis::Z));
    // The square is on the ground, behind the x axis.
    let bounds = model.bounds().unwrap();
    assert_eq!((bounds.min().into(), bounds.max().into()), ([0.0, 0.0, -1.0], [1.0, 0.0, 0.0]));
}

#[test]
fn binary_files_are_read_with_any_header() {
    let facets = SQUARE.map(|corners| (corners, 0));
    for header in [&b""[..], b"made by a program", b"solid part", b"solid facet normal endsolid"] {
        assert_square(&read(&binary(header, &facets)));
    }
}

#[test]
fn text_is_read_with_every_line_end_and_encoding() {
    for end in ["\n", "\r\n", "\r", " ", "\t\n\n"] {
        let text = ascii(end);
        let model = read(text.as_bytes());
        assert_square(&model);
        assert_eq!(model.nodes[0].name.as_deref(), Some("the part"), "{end:?}");
        assert_square(&read(text.to_uppercase().as_bytes()));
        assert_square(&read(format!("\u{FEFF}\n{text}").as_bytes()));
        let utf_16: Vec<u8> =
            format!("\u{FEFF}{text}").encode_utf16().flat_map(u16::to_le_bytes).collect();
        assert_square(&read(&utf_16));
    }
}

#[test]
fn each_solid_becomes_a_node() {
    let text = format!("{0}\nsolid empty\nendsolid\n{0}", ascii("\n"));
    let model = read(text.as_bytes());
    assert_eq!((model.meshes.len(), model.nodes.len(), model.roots.len()), (2, 4, 2));
    let empty = read(b"solid nothing\nendsolid nothing\n");
    assert_eq!((empty.meshes.len(), empty.warnings.len()), (0, 0));
}

#[test]
fn normals_need_not_be_valid() {
    for normal in ["nan nan nan", "-1.#IND 0 0", "", "0 0", "a b c"] {
        let text = ascii("\n").replace("normal 0 0 1", &format!("normal {normal}"));
        assert_square(&read(text.as_bytes()));
    }
}

#[test]
fn triangles_with_non_finite_corners_are_skipped() {
    let mut facets = SQUARE.map(|corners| (corners, 0)).to_vec();
    facets.insert(1, ([[f32::NAN, 0.0, 0.0], [0.0; 3], [1.0; 3]], 0));
    let model = read(&binary(b"", &facets));
    assert_eq!(model.meshes[0].primitives[0].item_count(), 2);
    let warning = model.warnings[0].sentence();
    let message = "skipped 1 triangle with corners that are not finite";
    assert_eq!(warning, format!("byte 134: {message}"));
    let text = ascii("\n").replacen("vertex 1e0 0", "vertex inf 0", 1);
    assert_eq!(
        read(text.as_bytes()).warnings[0].sentence(),
        format!("line 2, column 1: {message}")
    );
}

#[test]
fn triangles_without_area_are_retained() {
    let mut facets = SQUARE.map(|corners| (corners, 0)).to_vec();
    facets.insert(0, ([[0.0; 3]; 3], 0));
    facets.push(([[0.0; 3], [0.5, 0.0, 0.0], [1.0, 0.0, 0.0]], 0));
    let model = read(&binary(b"", &facets));
    assert_eq!(model.meshes[0].primitives[0].item_count(), 4);
    assert!(model.meshes[0].primitives[0].normals.iter().flatten().all(|n| *n == [0.0, 0.0, 1.0]));
}

#[test]
fn a_surface_without_area_causes_a_warning() {
    let line = [[0.0; 3], [0.5, 0.0, 0.0], [1.0, 0.0, 0.0]];
    let model = read(&binary(b"", &[(line, 0)]));
    let told: Vec<String> = model.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(
        told,
        ["warning[LEFT_OUT] no triangle in the file has an area; export the model again"]
    );
    assert!(read(&binary(b"", &[(line, 0), (SQUARE[0], 0)])).warnings.is_empty());
}

#[test]
fn a_huge_triangle_is_read() {
    let far = SQUARE[0].map(|corner| corner.map(|x| x * 1e30));
    let model = read(&binary(b"", &[(far, 0)]));
    assert_eq!(model.bounds().unwrap().max().raw().x, f64::from(1e30_f32));
    assert_eq!(model.meshes[0].primitives[0].normals.as_deref(), Some(&[[0.0, 0.0, 1.0]; 3][..]));
}

#[test]
fn truncated_files_are_errors_or_read_leniently() {
    let file = binary(b"solid", &SQUARE.map(|corners| (corners, 0)));
    let text = ascii("\n");
    for (bytes, message) in [
        (&file[..150], "byte 80: the file declares 2 triangles but has 1; the file is truncated"),
        (b"part", "this is not an STL file: it has 4 bytes and does not begin with solid"),
        (&text.as_bytes()[..200], "line 13, column 12: the file ends where a number is expected"),
        (b"", "the file is empty"),
    ] {
        let said = refusal(bytes);
        assert!(said.starts_with(message), "{said}");
    }
    let lenient = ImportOptions { lenient: true, ..ImportOptions::default() };
    for bytes in [&file[..150], &text.as_bytes()[..200]] {
        let model = load_bytes("part.stl", bytes, &lenient).expect("the available part");
        assert_eq!(model.meshes[0].primitives[0].item_count(), 1);
        assert!(!model.warnings.is_empty());
    }
    let model = read(text.strip_suffix("endsolid the part").unwrap().as_bytes());
    let message = "the last solid lacks endsolid; the file may be truncated";
    assert_eq!(model.warnings[0].sentence(), format!("line 16, column 1: {message}"));
}

#[test]
fn wrong_triangle_counts_are_reported() {
    let file = binary(b"", &SQUARE.map(|corners| (corners, 0)));
    let mut uncounted = file.clone();
    uncounted[80] = 0;
    let model = read(&uncounted);
    assert_eq!(model.meshes[0].primitives[0].item_count(), 2);
    assert_eq!(
        model.warnings[0].sentence(),
        "byte 80: the file declares no triangles but has 2; all are read"
    );
    let model = read(&[&file[..], b"more"].concat());
    assert_eq!(model.warnings[0].sentence(), "byte 184: ignored 4 bytes after the last triangle");
}

#[test]
fn unexpected_words_are_reported_with_a_location() {
    for (from, to, message) in [
        (
            "vertex 1e0",
            "vertex 1,5",
            "line 5, column 8: expected a number, found \"1,5\"; export the file again",
        ),
        ("outer", "inner", "line 2, column 20: \"outer\" is not reached"),
        (
            "endloop",
            "vertex 1 2 3\nendloop",
            "line 7, column 1: expected endloop, found \"vertex\"; export",
        ),
        (
            "endfacet",
            "endfacets",
            "line 8, column 1: expected endfacet, found \"endfacets\"; export the",
        ),
        (
            "endfacet\n",
            "endfacet\ncolor 1 0 0\n",
            "line 9, column 1: expected facet, found \"color\"; export",
        ),
    ] {
        let text = ascii("\n").replacen(from, to, 1);
        let said = refusal(text.as_bytes());
        assert!(from == "outer" || said.starts_with(message), "{said}");
        let lenient = ImportOptions { lenient: true, ..ImportOptions::default() };
        let model = load_bytes("part.stl", text.as_bytes(), &lenient).expect("the rest");
        assert!(model.meshes[0].primitives[0].item_count() >= 1, "{to}");
    }
}

/// Returns the linear colors of the square's two triangles, if the file has colors.
fn colors(header: &[u8], attributes: [u16; 2]) -> Option<[[f32; 4]; 2]> {
    let facets = [(SQUARE[0], attributes[0]), (SQUARE[1], attributes[1])];
    let model = read(&binary(header, &facets));
    let primitive = &model.meshes[0].primitives[0];
    let colors = primitive.colors.as_ref()?;
    assert_eq!(
        (colors.len(), primitive.normals.as_ref().unwrap().len()),
        (primitive.positions.len(), colors.len())
    );
    assert_eq!(model.materials[0].base_color, [1.0; 4]);
    let triangle = |at: usize| {
        let corners = [0, 1, 2].map(|k| colors[primitive.indices[3 * at + k] as usize]);
        assert!(corners[0] == corners[1] && corners[1] == corners[2]);
        corners[0]
    };
    Some([triangle(0), triangle(1)])
}

#[test]
fn both_color_conventions_are_read() {
    let plain = Material::plain().base_color;
    let (red, blue) = ([1.0, 0.0, 0.0, 1.0], [0.0, 0.0, 1.0, 1.0]);
    assert_eq!(colors(b"", [0, 0]), None);
    assert_eq!(colors(b"", [0x1F, 0x7C00]), None, "without bit 15");
    assert_eq!(colors(b"", [0x8000 | 31 << 10, 0x801F]), Some([red, blue]));
    assert_eq!(colors(b"", [0, 0x801F]), Some([plain, blue]));
    let magics = b"COLOR=\x00\xFF\x00\xFFMATERIAL=";
    let green = [0.0, 1.0, 0.0, 1.0];
    assert_eq!(colors(magics, [31, 31 << 10]), Some([red, blue]));
    assert_eq!(colors(magics, [0x8000, 0xFFFF]), Some([green, green]));
    assert_eq!(colors(magics, [0, 31]), Some([[0.0, 0.0, 0.0, 1.0], red]));
    assert_eq!(colors(magics, [0, 0]), Some([green, green]), "only the header color");
}

#[test]
fn many_solids_are_read() {
    let text = ascii(" ").repeat(65_537).replace("endsolid the part", "endsolid the part\n");
    let model = read(text.as_bytes());
    assert_eq!(model.meshes.len(), 65_537);
    let limits = gltf_import::Limits { nodes: 100, ..gltf_import::Limits::default() };
    let options = ImportOptions { limits, ..ImportOptions::default() };
    let error = load_bytes("part.stl", text.as_bytes(), &options).unwrap_err();
    assert_eq!(error.diagnostic.code, codes::LIMIT_EXCEEDED);
}

#[test]
fn options_override_axis_unit_and_crease_angle() {
    let options = ImportOptions {
        up: Some(UpAxis::Y),
        length_unit: Some(LengthUnit::Inch),
        crease_angle: Some(180.0),
        ..ImportOptions::default()
    };
    let corner = [
        [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]],
        [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]],
    ];
    let file = binary(b"", &corner.map(|corners| (corners, 0)));
    let model = load_bytes("part.stl", &file, &options).unwrap();
    assert_eq!((model.length_unit, model.up_axis), (LengthUnit::Inch, UpAxis::Y));
    assert_eq!(model.bounds().unwrap().max().raw().to_array(), [1.0; 3]);
    assert_eq!(model.meshes[0].primitives[0].positions.len(), 4);
    assert_eq!(read(&file).meshes[0].primitives[0].positions.len(), 6);
}

#[test]
fn wrong_extensions_are_reported() {
    let file = binary(b"", &SQUARE.map(|corners| (corners, 0)));
    let model = load_bytes("part.glb", &file, &ImportOptions::default()).unwrap();
    assert_eq!(model.warnings[0].severity, Severity::Info);
    let sentence = "the name suggests glTF, but the content is STL; rename it to end in .stl";
    assert_eq!(model.warnings[0].sentence(), sentence);
}
