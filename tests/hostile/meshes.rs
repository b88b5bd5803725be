//! Mutants of small files in every mesh format.

use crate::hostile::case::{Case, Expected};
use crate::hostile::mutants::{Random, mutate};
use alberti_tests::threemf::encode_3mf;

/// The number of mutants per format.
const MUTANTS: usize = 2_000;

/// A function that makes small files in a format.
type Files = fn() -> Vec<Vec<u8>>;

/// The formats, with the file names that select them and small files to mutate.
const FORMATS: [(&str, Files); 5] = [
    ("model.stl", stl_files),
    ("model.obj", obj_files),
    ("model.ply", ply_files),
    ("model.3mf", threemf_files),
    // The text is mutated before it is archived, so that the checksum is correct.
    (MODEL_PART, threemf_parts),
];

/// The name of the mutants that are archived.
const MODEL_PART: &str = "3dmodel.model";

pub fn mesh_cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for (file_name, files) in FORMATS {
        let files = files();
        let finish = |file: Vec<u8>| if file_name == MODEL_PART { encode_3mf(&file) } else { file };
        for (at, file) in files.iter().enumerate() {
            let case =
                Case::new(format!("{file_name} {at}"), finish(file.clone()), Expected::Loads);
            cases.push(Case { file_name, ..case });
        }
        for number in 0..MUTANTS {
            let mut random = Random::new(number as u64);
            let file = &files[number % files.len()];
            let mut mutant = file.clone();
            for _ in 0..=random.below(4) {
                mutate(&mut mutant, &files, &mut random);
            }
            let name = format!("{file_name} mutant {number}");
            cases.push(Case { file_name, ..Case::new(name, finish(mutant), Expected::Anything) });
        }
    }
    cases
}

/// Returns two solids as text, and a binary file with colors in either convention.
fn stl_files() -> Vec<Vec<u8>> {
    let text = "solid a b\nfacet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  \
                vertex 1 1e0 -0.0\n endloop\nendfacet\nendsolid a b\nsolid\nfacet normal 0 0 0\nouter \
                loop\nvertex 0 0 0\nvertex 1 1 0\nvertex 0 1 2.5e-3\nendloop\nendfacet\nendsolid\n";
    let binary = |header: &[u8], attributes: [u16; 3]| {
        let mut file = header.to_vec();
        file.resize(80, b' ');
        file.extend(3u32.to_le_bytes());
        for (at, attribute) in attributes.into_iter().enumerate() {
            let x = at as f32;
            let numbers = [0.0, 0.0, 1.0, 0.0, 0.0, x, 1.0, x, 0.0, 1.0, 1.0, -0.0];
            numbers.iter().for_each(|number: &f32| file.extend(number.to_le_bytes()));
            file.extend(attribute.to_le_bytes());
        }
        file
    };
    vec![
        text.as_bytes().to_vec(),
        binary(b"solid made by a program", [0, 0x801F, 0xFC00]),
        binary(b"COLOR=\x10\x20\x30\xFF", [0x8000, 31, 31 << 10]),
    ]
}

/// Returns files with every supported statement, with faces that use all kinds of references, and
/// with a point cloud.
fn obj_files() -> Vec<Vec<u8>> {
    let text = "# two squares\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0 \nv 0.5 0.25 0 1\nvt 0 0\nvt 1 0 0\n\
                vn 0 0 1\no first thing\ng a b\nusemtl red\ns 1\nf 1/1/1 2/2/1 3//1 -1\ns off\n\
                f -5/-2 -4/-1 -3/1 \\\n-2/2\nl 1 2 3\np 1 2\ng\nf 1 2 3 4 1 2 3\nvp 1 2\n";
    let colors =
        "mtllib none.mtl\r\nv 0 0 0 1 0 0\r\nv 1 0 1e-3 0 1 0 0.5\r\nv 1 1 0\r\nf 1 2 3\r\n";
    let points = "v 0 0 0\nv 1 2 3\nv -1 +2. .5\n";
    [text, colors, points].map(|text| text.as_bytes().to_vec()).to_vec()
}

/// Returns text and binary files with faces, strips, edges, colors, texture coordinates and unknown
/// elements.
fn ply_files() -> Vec<Vec<u8>> {
    let text = "ply\nformat ascii 1.0\ncomment TextureFile none.png\nelement vertex 5\n\
                property float x\nproperty float y\nproperty double z\nproperty uchar red\n\
                property uchar green\nproperty uchar blue\nproperty uchar alpha\nelement face 2\n\
                property list uchar int vertex_indices\nproperty list uchar float texcoord\n\
                property int texnumber\nelement odd 1\nproperty list int short words\n\
                element tristrips 1\nproperty list int int vertex_indices\nelement edge 1\n\
                property int vertex1\nproperty int vertex2\nend_header\n\
                0 0 0 255 0 0 255\n1 0 0 0 255 0 255\n1 1 0 0 0 255 128\n0 1 0 9 9 9 9\n\
                0.5 2e-1 0 1 2 3 4\n4 0 1 2 3 8 0 0 1 0 1 1 0 1 0\n3 0 1 4 6 0 0 1 0 1 1 1\n\
                2 7 8\n5 0 1 2 -1 3\n0 4\n";
    let mut files = vec![text.as_bytes().to_vec()];
    for (name, is_big) in [("binary_little_endian", false), ("binary_big_endian", true)] {
        let file = format!(
            "ply\r\nformat {name} 1.0\r\nelement vertex 3\r\nproperty float x\r\n\
             property float y\r\nproperty float z\r\nproperty float nx\r\nproperty float ny\r\n\
             property float nz\r\nelement face 1\r\nproperty list uint uint vertex_index\r\n\
             end_header\r\n"
        );
        let mut body = Vec::new();
        let mut push = |word: u32| match is_big {
            true => body.extend(word.to_be_bytes()),
            false => body.extend(word.to_le_bytes()),
        };
        for corner in [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.5_f32]] {
            corner.iter().chain(&[0.0, 0.0, 2.0]).for_each(|x| push(x.to_bits()));
        }
        [3, 0, 1, 2].into_iter().for_each(&mut push);
        files.push([file.as_bytes(), &body].concat());
    }
    files
}

/// Returns a file with objects, components, items and every kind of property.
fn threemf_parts() -> Vec<Vec<u8>> {
    let text = r##"<?xml version="1.0"?><model unit="inch" requiredextensions="m"
xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
xmlns:m="http://schemas.microsoft.com/3dmanufacturing/material/2015/02"><resources>
<basematerials id="5"><base name="a" displaycolor="#FF0000"/><base name="b" displaycolor="#0000FF80"/>
</basematerials><m:colorgroup id="6"><m:color color="#00FF00"/><m:color color="#102030"/>
</m:colorgroup><m:texture2d id="4" path="/3D/a.png"/><m:texture2dgroup id="7" texid="4">
<m:tex2coord u="0" v="1e-1"/></m:texture2dgroup><m:compositematerials id="8" matid="5"
matindices="0 1"><m:composite values="1 3"/></m:compositematerials><m:multiproperties id="9"
pids="5 6" blendmethods="multiply"><m:multi pindices="0 1"/></m:multiproperties>
<object id="1" pid="5" pindex="1"><mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="3" y="0"
z="0"/><vertex x="0" y="4" z="0"/><vertex x="0" y="0" z="5"/></vertices><triangles>
<triangle v1="0" v2="2" v3="1"/><triangle v1="0" v2="1" v3="3" pid="6" p1="0" p2="1" p3="0"/>
<triangle v1="0" v2="3" v3="2" pid="8" p1="0"/><triangle v1="1" v2="2" v3="3" pid="9" p1="0"/>
</triangles></mesh></object><object id="2"><components><component objectid="1"/>
<component objectid="1" transform="1 0 0 0 1 0 0 0 1 9 0 0"/></components></object></resources><build>
<item objectid="2" transform="0 1 0 -1 0 0 0 0 1 0 0 7"/><item objectid="1"/></build></model>"##;
    vec![text.as_bytes().to_vec()]
}

/// Returns 3MF archives, each with a file from [`threemf_parts`].
fn threemf_files() -> Vec<Vec<u8>> {
    threemf_parts().iter().map(|part| encode_3mf(part)).collect()
}
