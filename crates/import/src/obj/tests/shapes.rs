//! Tests of vertex data, elements, groups and normals.

use super::{SQUARE, primitives, read, read_leniently, triangle_count, warnings};
use crate::load_bytes;
use gltf_import::{ImportOptions, Limits};
use model::{Primitive, Topology, codes};

#[test]
fn references_count_forward_or_backward() {
    let forwards = read(format!("{SQUARE}f 1 2 3 4")).unwrap();
    let backwards = read(format!("{SQUARE}f -4 -3 -2 -1\n")).unwrap();
    let ahead = read(format!("f 1 2 3 4\n{SQUARE}")).unwrap();
    for model in [&forwards, &backwards, &ahead] {
        let [square] = primitives(model)[..] else { panic!() };
        assert_eq!(square.indices, [0, 1, 2, 0, 2, 3]);
        assert_eq!(square.positions[2], [1.0, 1.0, 0.0]);
        assert_eq!(square.normals.as_ref().unwrap(), &[[0.0, 0.0, 1.0]; 4]);
        assert_eq!(warnings(model), "");
    }
    // Negative references count from the current statement, not from the end of the file.
    let two = read(format!("{SQUARE}f -4 -3 -2\nv 9 9 9\nf -4 -3 -2")).unwrap();
    assert_eq!(
        primitives(&two)[0].positions,
        [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]
    );
}

#[test]
fn invalid_references_are_located_errors_unless_lenient() {
    for (face, place, message) in [
        ("f 1 2 5", "line 5, column 7", "there is no vertex 5: there are 4 before this line"),
        ("f 1 0 2", "line 5, column 5", "there is no vertex 0: the first vertex is 1"),
        ("f -5 1 2", "line 5, column 3", "there is no vertex -5: there are 4 before this line"),
        (
            "f 1 2 99999999999",
            "line 5, column 7",
            "there is no vertex 99999999999: there are 4 before this line",
        ),
        ("f 1 2 x", "line 5, column 7", "\"x\" is not a reference"),
        ("f 1 2 3/1/1/1", "line 5, column 7", "\"3/1/1/1\" is not a reference"),
        ("f 1 2 3.5", "line 5, column 7", "\"3.5\" is not a reference"),
        ("l 1 7", "line 5, column 5", "there is no vertex 7: there are 4 before this line"),
    ] {
        let text = format!("{SQUARE}{face}\nf 1 2 3 4\n");
        let diagnostic = read(&text).unwrap_err().diagnostic;
        assert_eq!(diagnostic.code, codes::INVALID_DATA);
        assert_eq!(diagnostic.location, place, "{face}");
        assert!(diagnostic.message.starts_with(message), "{face}: {}", diagnostic.message);
        let model = read_leniently(&text);
        assert_eq!(triangle_count(&model), 2, "{face}");
        assert!(warnings(&model).contains("the element is skipped"));
    }
}

#[test]
fn broken_vertices_are_errors_only_if_used() {
    let text = format!("{SQUARE}v 1 nan 2\nv 1 1e39 0\nv 3.1+e2 0 0\nv 1 2\nf 1 2 3 4\n");
    assert_eq!(triangle_count(&read(&text).unwrap()), 2);
    for (vertex, line) in [(5, 5), (6, 6), (7, 7), (8, 8)] {
        let text = format!("{text}f 1 2 {vertex}\n");
        let diagnostic = read(&text).unwrap_err().diagnostic;
        assert_eq!(diagnostic.location, format!("line {line}, column 1"));
        assert_eq!(triangle_count(&read_leniently(&text)), 2);
    }
}

#[test]
fn corners_with_the_same_references_share_a_vertex() {
    let text = format!(
        "{SQUARE}vt 0 0\nvt 1 0.25\nvt 1 1\nvn 0 0 2\nvn 0 1 0\n\
         f 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 4/1/1\nf 1/1/2 3/3/1 4/1/1\n"
    );
    let model = read(text).unwrap();
    let [part] = primitives(&model)[..] else { panic!() };
    assert_eq!(part.indices, [0, 1, 2, 0, 2, 3, 4, 2, 3]);
    assert_eq!(part.positions[4], part.positions[0]);
    assert_eq!(part.normals.as_ref().unwrap()[4], [0.0, 1.0, 0.0]);
    assert_eq!(part.normals.as_ref().unwrap()[0], [0.0, 0.0, 1.0], "unit length");
    // In OBJ files, v points up; here it points down.
    assert_eq!(part.uvs[0][..3], [[0.0, 1.0], [1.0, 0.75], [1.0, 0.0]]);
}

#[test]
fn missing_attributes_are_computed_or_absent() {
    let text =
        format!("{SQUARE}vt 0 0\nvn 1 0 0\nf 1/1 2/1 3\nf 1//1 3//1 4\nf 1/9/9 2/1/1 3/1/1\n");
    let model = read(text).unwrap();
    for part in primitives(&model) {
        assert!(part.uvs.is_empty());
        assert!(part.normals.as_ref().unwrap().iter().all(|normal| *normal == [0.0, 0.0, 1.0]));
    }
    assert_eq!(triangle_count(&model), 3);
    assert!(warnings(&model).contains("a reference to missing texture coordinates is ignored"));
    assert!(warnings(&model).contains("a reference to a missing normal is replaced"));
    let zero = read(format!("{SQUARE}vn 0 0 0\nvn x\nf 1//1 2//1 3//2")).unwrap();
    assert_eq!(primitives(&zero)[0].normals.as_ref().unwrap(), &[[0.0, 0.0, 1.0]; 3]);
    assert!(warnings(&zero).contains("3 normals without a direction are replaced"));
}

#[test]
fn concave_polygons_are_triangulated() {
    let model = read("v 0 0 0\nv 4 4 0\nv 0 8 0\nv 2 4 0\nf 1 2 3 4").unwrap();
    let [arrowhead] = primitives(&model)[..] else { panic!() };
    let doubled_area = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|at| arrowhead.positions[at as usize]);
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    };
    let areas: Vec<f32> = arrowhead.indices.as_chunks().0.iter().map(doubled_area).collect();
    assert_eq!(areas, [8.0, 8.0]);
    let crossed = read(format!("{SQUARE}f 1 3 2 4\n")).unwrap();
    assert_eq!(triangle_count(&crossed), 2);
}

#[test]
fn lines_and_points_are_read() {
    let model = read(format!("{SQUARE}l 1 2 3\nl 1/1 4/1\np 1 -1\nf 1 2 3")).unwrap();
    let [lines, points, surface] = primitives(&model)[..] else { panic!() };
    assert_eq!((lines.topology, &lines.indices[..]), (Topology::Lines, &[0, 1, 1, 2, 0, 3][..]));
    assert_eq!((points.topology, points.item_count()), (Topology::Points, 2));
    assert_eq!(points.positions[1], [0.0, 1.0, 0.0]);
    assert_eq!((lines.normals.is_none(), surface.item_count()), (true, 1));
    // A file with only vertices is a point cloud, but a file whose elements are all broken is not.
    let cloud = read(format!("{SQUARE}v nan 0 0")).unwrap();
    let [points] = primitives(&cloud)[..] else { panic!() };
    assert_eq!((points.topology, points.item_count()), (Topology::Points, 4));
    assert!(primitives(&read_leniently(&format!("{SQUARE}f 1 2 9"))).is_empty());
    assert!(read("# nothing\nv 0 0 0\nf 1\n").unwrap().nodes.is_empty());
}

#[test]
fn vertex_colors_are_srgb_and_may_be_bytes() {
    let model = read("v 0 0 0 1 0.5 0\nv 1 0 0\nv 0 1 0 0 0 1 0.25\nf 1 2 3").unwrap();
    let colors = primitives(&model)[0].colors.clone().unwrap();
    // sRGB 0.5 is linear 0.214041 (IEC 61966-2-1).
    assert!((colors[0][1] - 0.214_041).abs() < 1e-6, "{colors:?}");
    assert_eq!(colors[1], [1.0; 4]);
    assert_eq!(colors[2], [0.0, 0.0, 1.0, 0.25]);
    let bytes = read("v 0 0 0 255 0 0\nv 1 0 0 0 0 255\nv 0 1 0 0 0 0\nf 1 2 3").unwrap();
    assert_eq!(primitives(&bytes)[0].colors.as_ref().unwrap()[0], [1.0, 0.0, 0.0, 1.0]);
    assert!(warnings(&bytes).contains("numbers from 0 to 255"));
    // A weight is not a color, and does not move the vertex.
    let weights = read("v 2 0 0 2\nv 1 0 0 1\nv 0 1 0 1\nf 1 2 3").unwrap();
    assert_eq!(primitives(&weights)[0].colors, None);
    assert_eq!(primitives(&weights)[0].positions[0], [2.0, 0.0, 0.0]);
}

#[test]
fn encodings_line_ends_and_continuations_are_handled() {
    let plain = format!("{SQUARE}g näme\nf 1 2 3 4");
    let utf_16 = |swap: bool| -> Vec<u8> {
        let units = format!("\u{FEFF}{plain}").encode_utf16().collect::<Vec<_>>();
        units.iter().flat_map(|u| if swap { u.to_be_bytes() } else { u.to_le_bytes() }).collect()
    };
    let files = [
        plain.clone().into_bytes(),
        format!("\u{FEFF}{plain}").into_bytes(),
        utf_16(false),
        utf_16(true),
        plain.replace('\n', "\r\n").into_bytes(),
        plain.replace('\n', "\r").into_bytes(),
        plain.replace("f 1 2 3 4", "f 1 2 \\\n 3\\\r\n 4").into_bytes(),
        plain
            .replace("f 1", "# a comment \\\n\n  f\t1")
            .replace("3 4", "3 4 # and one more")
            .into_bytes(),
    ];
    for file in files {
        let model = read(&file).unwrap();
        assert_eq!(triangle_count(&model), 2, "{}", String::from_utf8_lossy(&file));
        assert_eq!(model.nodes[0].name.as_deref(), Some("näme"));
    }
}

#[test]
fn names_that_are_not_utf_8_are_read_as_latin_1() {
    let model = read([SQUARE.as_bytes(), b"o T\xFCr\nf 1 2 3"].concat()).unwrap();
    assert_eq!(model.nodes[0].name.as_deref(), Some("Tür"));
}

#[test]
fn objects_and_groups_become_nodes() {
    let model = read(format!(
        "{SQUARE}f 1 2 3\no Table\nf 1 2 3\ng top part\nf 1 2 3\ng legs\nf 1 2 3\no Chair\nf 1 2 3\n\
         g default\nf 2 3 4\no Table\ng legs\nf 2 3 4\ng never used\n"
    ))
    .unwrap();
    let names: Vec<_> = model.nodes.iter().map(|node| node.name.as_deref()).collect();
    assert_eq!(names, [None, Some("Table"), Some("top part"), Some("legs"), Some("Chair")]);
    assert_eq!(model.roots, [0, 1, 4]);
    assert_eq!(model.nodes[1].children, [2, 3]);
    assert_eq!((model.nodes[2].parent, model.nodes[4].parent), (Some(1), None));
    let triangles = |node: usize| {
        let mesh = &model.meshes[model.nodes[node].mesh.unwrap()];
        (mesh.name.as_deref(), mesh.primitives.iter().map(Primitive::item_count).sum::<usize>())
    };
    assert_eq!(triangles(1), (Some("Table"), 1));
    assert_eq!(triangles(3), (Some("legs"), 2));
    assert_eq!(triangles(4), (Some("Chair"), 2));
}

#[test]
fn many_objects_take_linear_time() {
    let mut text = String::from(SQUARE);
    for object in 0..65_537 {
        text.push_str(&format!("o part {object}\nusemtl m{}\nf 1 2 3\n", object % 3));
    }
    let model = read(&text).unwrap();
    assert_eq!((model.nodes.len(), model.meshes.len()), (65_537, 65_537));
    assert_eq!(model.nodes[65_536].name.as_deref(), Some("part 65536"));
    assert_eq!(triangle_count(&model), 65_537);
    let options = ImportOptions {
        limits: Limits { nodes: 1000, ..Limits::default() },
        ..ImportOptions::default()
    };
    let error = load_bytes("many.obj", text.as_bytes(), &options).unwrap_err();
    assert_eq!(error.diagnostic.code, codes::LIMIT_EXCEEDED);
}

/// Two squares at a right angle that share an edge.
const FOLD: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 0 1 1\n";

#[test]
fn normals_follow_smoothing_groups_or_the_crease_angle() {
    let vertex_count = |text: &str, crease_angle: Option<f64>| {
        let options = ImportOptions { crease_angle, ..ImportOptions::default() };
        let model = load_bytes("fold.obj", text.as_bytes(), &options).unwrap();
        primitives(&model).iter().map(|part| part.positions.len()).sum::<usize>()
    };
    // The two vertices of the edge are shared if it is smooth, and duplicated if it is a crease.
    for (faces, crease_angle, expected) in [
        ("f 1 2 3 4\nf 1 4 6 5", None, 8),
        ("f 1 2 3 4\nf 1 4 6 5", Some(95.0), 6),
        ("s 1\nf 1 2 3 4\nf 1 4 6 5", None, 6),
        ("s 1\nf 1 2 3 4\ns 2\nf 1 4 6 5", None, 8),
        ("s off\nf 1 2 3 4\nf 1 4 6 5", Some(95.0), 8),
        ("s 0\nf 1 2 3 4\nf 1 4 6 5", None, 8),
        ("s 7\ng one\nf 1 2 3 4\ng two\nf 1 4 6 5", None, 8),
    ] {
        assert_eq!(vertex_count(&format!("{FOLD}{faces}"), crease_angle), expected, "{faces}");
    }
    // Normals are continuous across groups and materials, although the vertices are separate.
    let model = read(format!("{FOLD}s 7\nusemtl a\nf 1 2 3 4\nusemtl b\nf 1 4 6 5")).unwrap();
    let half = std::f32::consts::FRAC_1_SQRT_2;
    for part in primitives(&model) {
        let corner = part.positions.iter().position(|at| *at == [0.0; 3]).unwrap();
        let normal = part.normals.as_ref().unwrap()[corner];
        assert!((normal[0] - half).abs() < 1e-6 && (normal[2] - half).abs() < 1e-6, "{normal:?}");
    }
    // Vertices at the same position count as one.
    let soup = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 0\nv 1 1 0\nv 0 1 0.2\nf 1 2 3\nf 4 5 6\n";
    let model = read(soup).unwrap();
    let normals = primitives(&model)[0].normals.clone().unwrap();
    assert_eq!((normals[0], normals[2]), (normals[3], normals[4]));
}

#[test]
fn ignored_statements_are_reported_once() {
    let text = format!(
        "{SQUARE}vp 0.1\nvp 0.2\ncstype bspline\ndeg 3\ncurv 0 1 1 2\nend\nlod 3\nf 1 2 3\ncall a.obj\n"
    );
    let model = read(text).unwrap();
    let told = warnings(&model);
    assert!(told.contains("line 5, column 1: 2 \"vp\" statements are ignored"), "{told}");
    assert_eq!(told.lines().count(), 6, "{told}");
    assert_eq!(triangle_count(&model), 1);
    let many: String = (0..1000).map(|at| format!("x{at} 1\n")).collect();
    let model = read(format!("{SQUARE}{many}f 1 2 3")).unwrap();
    assert!(warnings(&model).contains("984 more statements are ignored"));
    assert!(model.warnings.len() < 20);
}

#[test]
fn huge_coordinates_are_read() {
    let model = read("v 0 0 0\nv 1e30 0 0\nv 0 1e30 0\nf 1 2 3").unwrap();
    let [part] = primitives(&model)[..] else { panic!() };
    assert_eq!(part.normals.as_ref().unwrap(), &[[0.0, 0.0, 1.0]; 3]);
    assert_eq!(part.positions[1][0], 1e30);
}

#[test]
fn array_limits_are_enforced() {
    let text = format!("{SQUARE}{}", "f 1 2 3\n".repeat(100));
    let limits = Limits { array_bytes: 1000, ..Limits::default() };
    let options = ImportOptions { limits, ..ImportOptions::default() };
    let error = load_bytes("a.obj", text.as_bytes(), &options).unwrap_err();
    assert_eq!(error.diagnostic.code, codes::LIMIT_EXCEEDED);
}

#[test]
fn modified_bytes_do_not_panic() {
    let text = format!(
        "mtllib a.mtl\n{SQUARE}vt 0 0\nvn 0 0 1\no a\ng b\nusemtl c\ns 1\nf 1/1/1 2//1 3/1 -1\nl 1 2 3\np 1 2\n\
         f 1 2 3 4 1 2 \\\n 3\nv 1 2 3 0.5 0.5 0.5\n"
    );
    let mut state = 1_u64;
    let mut random = |below: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (state >> 33) as usize % below
    };
    let mut read_some = 0;
    for _ in 0..4000 {
        let mut bytes = text.clone().into_bytes();
        for _ in 0..=random(4) {
            let at = random(bytes.len());
            match random(4) {
                0 => bytes[at] = random(256) as u8,
                1 => bytes.truncate(at.max(1)),
                2 => bytes[at] = b"0123456789-/.\\\n\r #e"[random(19)],
                _ => {
                    let piece = bytes[at..].to_vec();
                    bytes.extend(piece);
                }
            }
        }
        let options = ImportOptions { lenient: random(2) == 0, ..ImportOptions::default() };
        if let Ok(model) = load_bytes("x.obj", &bytes, &options) {
            read_some += usize::from(triangle_count(&model) > 0);
            for part in primitives(&model) {
                assert!(part.indices.iter().all(|at| (*at as usize) < part.positions.len()));
                assert!(part.positions.as_flattened().iter().all(|x| x.is_finite()));
                assert!(part.normals.iter().flatten().flatten().all(|x| x.is_finite()));
                assert!(part.uvs.iter().flatten().flatten().all(|x| x.is_finite()));
            }
        }
    }
    assert!(read_some > 1000, "{read_some}");
}
