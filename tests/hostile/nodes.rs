//! Node hierarchies that are not trees, are too deep, or exceed all limits.

use crate::hostile::case::{Case, Expected};
use alberti_tests::gltf::Document;
use serde_json::{Value, json};

fn node_case(name: &str, nodes: Value, expected: Expected) -> Case {
    Case::from_document(
        format!("nodes: {name}"),
        &Document::single_triangle().with_value("/nodes", nodes),
        expected,
    )
}

fn refusal_containing(text: &str) -> Expected {
    Expected::Says(format!("{text}; export the file again"))
}

pub fn node_cases() -> Vec<Case> {
    let mut cases = reference_cases();
    cases.extend(size_cases());
    cases.extend(transform_cases());
    cases.extend(scene_cases());
    cases.extend(position_cases());
    cases
}

/// Returns cases of a mesh with many instances, whose accessors are wrong or far too long.
fn position_cases() -> Vec<Case> {
    let case = |name: &str, attributes: Value, count: u64, expected: Expected| {
        let mut document = Document::single_triangle();
        let numbers = alberti_tests::gltf::float_bytes(&[1.0, 2.0, f32::NAN, 0.0, 0.0, 0.0]);
        document.add_accessor(&numbers, json!({"componentType": 5126, "type": "VEC3", "count": 2}));
        let zeros = |shape: &str| json!({"componentType": 5126, "type": shape, "count": count});
        let accessors =
            document.json["accessors"].as_array_mut().expect("the document has accessors");
        accessors.extend([zeros("VEC3"), zeros("VEC4")]);
        let node = json!([{"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": attributes}}}]);
        Case::from_document(
            format!("places: {name}"),
            &document.with_value("/nodes", node),
            expected,
        )
    };
    let warns =
        |text: &str| Expected::Warns(format!("/nodes/0/extensions/EXT_mesh_gpu_instancing{text}"));
    vec![
        case("zeros", json!({"TRANSLATION": 3}), 100, Expected::LoadsClean),
        case("none", json!({}), 100, Expected::LoadsClean),
        case(
            "no rotations",
            json!({"ROTATION": 4}),
            100,
            warns(" skipped 100 instances with a transform that is not finite"),
        ),
        case(
            "not a number",
            json!({"TRANSLATION": 2}),
            1,
            warns(" skipped 1 instance with a transform that is not finite"),
        ),
        case(
            "unequal",
            json!({"TRANSLATION": 2, "SCALE": 3}),
            5,
            warns(
                "/attributes the attributes must have the same number of elements; the mesh is \
                 shown once",
            ),
        ),
        case(
            "wrong shape",
            json!({"TRANSLATION": 4}),
            5,
            warns(
                "/attributes/TRANSLATION must be VEC3 of component type 5126, not VEC4 of 5126; the mesh is shown once",
            ),
        ),
        case("no accessor", json!({"TRANSLATION": 99}), 5, Expected::Warned),
        case("not an index", json!({"TRANSLATION": "x"}), 5, Expected::Warned),
        case("not an object", json!(7), 5, Expected::Warned),
        case("many", json!({"TRANSLATION": 3}), 100_000_000, Expected::Refused),
        case("more than can be counted", json!({"SCALE": 3}), u64::MAX, Expected::Refused),
    ]
}

/// Returns cases with invalid node references.
fn reference_cases() -> Vec<Case> {
    vec![
        node_case(
            "its own child",
            json!([{"children": [0]}]),
            refusal_containing("/nodes/0/children: node 0 is its own descendant"),
        ),
        node_case(
            "a cycle of three",
            json!([{"children": [1]}, {"children": [2]}, {"children": [0]}]),
            refusal_containing("/nodes/0/children: node 0 is its own descendant"),
        ),
        node_case(
            "a cycle outside the scene",
            json!([{}, {"children": [2]}, {"children": [1]}]),
            refusal_containing("/nodes/1/children: node 1 is its own descendant"),
        ),
        node_case(
            "two parents",
            json!([{"children": [1, 2]}, {"children": [2]}, {}]),
            refusal_containing("/nodes/1/children/0: node 2 already has a parent, node 0"),
        ),
        node_case(
            "a duplicate child",
            json!([{"children": [1, 1]}, {}]),
            refusal_containing("/nodes/0/children/1: node 1 already has a parent, node 0"),
        ),
        node_case(
            "a missing child",
            json!([{"children": [1]}]),
            refusal_containing("/nodes/0/children/0: there is no node 1: the file has only node 0"),
        ),
        node_case(
            "a missing mesh",
            json!([{"mesh": 1}]),
            refusal_containing("/nodes/0/mesh: there is no mesh 1: the file has only mesh 0"),
        ),
        node_case(
            "a missing skin",
            json!([{"mesh": 0, "skin": 0}]),
            refusal_containing("/nodes/0/skin: there is no skin 0: the file has none"),
        ),
    ]
}

/// Returns cases with trees that are deep or wide, or only appear so.
fn size_cases() -> Vec<Case> {
    let chain = |length: usize| {
        let node = |at: usize| {
            if at + 1 < length { json!({"children": [at + 1]}) } else { json!({"mesh": 0}) }
        };
        Value::Array((0..length).map(node).collect())
    };
    let doubled: Vec<Value> = (0..61)
        .map(|at| if at < 60 { json!({"children": [at + 1, at + 1]}) } else { json!({}) })
        .collect();
    let deep = "raise the limit `node_depth` (--max-node-depth) if you trust the file";
    vec![
        node_case("2^60 paths", Value::Array(doubled), Expected::Refused),
        node_case("1,024 deep", chain(1024), Expected::LoadsClean),
        node_case(
            "1,025 deep",
            chain(1025),
            Expected::Says(format!(
                "/nodes/1024: the node tree is 1025 levels deep, more than the limit of 1024; {deep}"
            )),
        ),
        node_case("50,000 deep", chain(50_000), Expected::Refused),
        node_case("50,000 wide", json!(vec![json!({"mesh": 0}); 50_000]), Expected::LoadsClean),
    ]
}

fn transform_cases() -> Vec<Case> {
    let matrix = |last: [f64; 4]| {
        let mut matrix =
            [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0];
        for (column, value) in last.into_iter().enumerate() {
            matrix[4 * column + 3] = value;
        }
        json!([{"mesh": 0, "matrix": matrix}])
    };
    let huge =
        json!([{"scale": [1e200, 1, 1], "children": [1]}, {"mesh": 0, "scale": [1e200, 1, 1]}]);
    vec![
        node_case(
            "a projective matrix",
            matrix([0.0, 0.0, -1.0, 0.0]),
            refusal_containing(
                "/nodes/0/matrix: the last row of the matrix is [0.0, 0.0, -1.0, 0.0], \
                 not [0, 0, 0, 1]",
            ),
        ),
        node_case("a rounded matrix", matrix([0.0, 1e-9, 0.0, 0.999_999_9]), Expected::LoadsClean),
        node_case("zero matrix", json!([{"mesh": 0, "matrix": vec![0; 16]}]), Expected::Refused),
        node_case(
            "15 numbers",
            json!([{"mesh": 0, "matrix": vec![0; 15]}]),
            refusal_containing("/nodes/0/matrix: expected 16 numbers"),
        ),
        node_case(
            "zero rotation",
            json!([{"mesh": 0, "rotation": [0, 0, 0, 0]}]),
            refusal_containing("/nodes/0/rotation: [0.0, 0.0, 0.0, 0.0] is not a rotation"),
        ),
        node_case(
            "long rotation",
            json!([{"mesh": 0, "rotation": [0, 0, 5e200, 5e200]}]),
            Expected::LoadsClean,
        ),
        node_case("zero scale", json!([{"mesh": 0, "scale": [0, 0, 0]}]), Expected::LoadsClean),
        node_case("mirror", json!([{"mesh": 0, "scale": [-1, 1, 1]}]), Expected::LoadsClean),
        node_case(
            "a product that overflows",
            huge,
            refusal_containing("/nodes/1: the accumulated transform overflows"),
        ),
        node_case(
            "far away",
            json!([{"mesh": 0, "translation": [1e300, 0, 0]}]),
            Expected::Anything,
        ),
    ]
}

fn scene_cases() -> Vec<Case> {
    let scene = |name: &str, member: &str, value: Value, expected: Expected| {
        let document = Document::single_triangle()
            .with_value("/nodes", json!([{"children": [1]}, {"mesh": 0}]));
        Case::from_document(
            format!("scenes: {name}"),
            &document.with_value(member, value),
            expected,
        )
    };
    vec![
        scene(
            "a missing scene",
            "/scene",
            json!(1),
            refusal_containing("/scene: there is no scene 1: the file has only scene 0"),
        ),
        scene(
            "a missing node",
            "/scenes/0/nodes",
            json!([2]),
            refusal_containing("/scenes/0/nodes/0: there is no node 2: the file has nodes 0 to 1"),
        ),
        scene(
            "a child as a root",
            "/scenes/0/nodes",
            json!([1]),
            Expected::Warns(
                "/scenes/0/nodes node 1 is listed as a root but has a parent".to_owned(),
            ),
        ),
        scene("a child and its parent as roots", "/scenes/0/nodes", json!([0, 1]), Expected::Loads),
        scene(
            "a duplicate node",
            "/scenes/0/nodes",
            json!([0, 0]),
            Expected::Warns(
                "/scenes/0/nodes/1 the node is listed twice; it is shown once".to_owned(),
            ),
        ),
        scene("no scenes", "/scenes", json!([]), Expected::Refused),
    ]
}
