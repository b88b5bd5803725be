//! One part in every mesh format: the same triangles produce the same picture, byte for byte.

use crate::drawings::assert_succeeds;
use crate::sandbox::Sandbox;
use std::fmt::Write as _;

/// A round part with creases: vertices and triangles, z up, in millimeters.
struct Part {
    positions: Vec<[f32; 3]>,
    triangles: Vec<[usize; 3]>,
}

/// Returns a solid of revolution: a closed profile of radius and height around the z axis.
fn turned_part() -> Part {
    const PROFILE: [[f32; 2]; 6] =
        [[10.0, 0.0], [20.0, 0.0], [20.0, 5.0], [14.0, 9.0], [14.0, 20.0], [10.0, 20.0]];
    const SIDES: usize = 24;
    let position = |index: usize| {
        let [radius, height] = PROFILE[index % 6];
        let angle = std::f32::consts::TAU * (index / 6) as f32 / SIDES as f32;
        [radius * libm::cosf(angle), radius * libm::sinf(angle), height]
    };
    let quad = |index: usize| {
        let (side, at) = (index / 6, index % 6);
        let next = |side: usize, at: usize| side % SIDES * 6 + at % 6;
        let [a, b, c, d] =
            [next(side, at), next(side + 1, at), next(side + 1, at + 1), next(side, at + 1)];
        [[a, b, c], [a, c, d]]
    };
    let count = 6 * SIDES;
    Part {
        positions: (0..count).map(position).collect(),
        triangles: (0..count).flat_map(quad).collect(),
    }
}

impl Part {
    /// Returns one line for each vertex and each triangle.
    fn lines(
        &self,
        vertex: impl Fn([f32; 3]) -> String,
        triangle: impl Fn([usize; 3]) -> String,
    ) -> String {
        let vertices = self.positions.iter().map(|position| vertex(*position));
        vertices.chain(self.triangles.iter().map(|corners| triangle(*corners))).collect()
    }

    fn ascii_stl(&self) -> Vec<u8> {
        let mut text = "solid part\n".to_owned();
        for corners in &self.triangles {
            text.push_str("facet normal 0 0 0\n outer loop\n");
            for corner in corners {
                let [x, y, z] = self.positions[*corner];
                let _ = writeln!(text, "  vertex {x} {y} {z}");
            }
            text.push_str(" endloop\nendfacet\n");
        }
        text.push_str("endsolid part\n");
        text.into_bytes()
    }

    fn binary_stl(&self) -> Vec<u8> {
        let mut file = b"solid by a program that does not know better".to_vec();
        file.resize(80, b' ');
        file.extend((self.triangles.len() as u32).to_le_bytes());
        for corners in &self.triangles {
            file.extend([0; 12]);
            let numbers = corners.iter().flat_map(|corner| self.positions[*corner]);
            file.extend(numbers.flat_map(f32::to_le_bytes));
            file.extend([0; 2]);
        }
        file
    }

    fn obj(&self) -> Vec<u8> {
        let vertex = |[x, y, z]: [f32; 3]| format!("v {x} {y} {z}\n");
        let face = |[a, b, c]: [usize; 3]| format!("f {} {} {}\n", a + 1, b + 1, c + 1);
        self.lines(vertex, face).into_bytes()
    }

    /// Returns the header of a PLY file.
    fn ply_header(&self, format: &str) -> String {
        format!(
            "ply\nformat {format} 1.0\nelement vertex {}\nproperty float x\nproperty float y\n\
             property float z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
            self.positions.len(),
            self.triangles.len()
        )
    }

    fn ascii_ply(&self) -> Vec<u8> {
        let vertex = |[x, y, z]: [f32; 3]| format!("{x} {y} {z}\n");
        let face = |[a, b, c]: [usize; 3]| format!("3 {a} {b} {c}\n");
        (self.ply_header("ascii") + &self.lines(vertex, face)).into_bytes()
    }

    fn binary_ply(&self) -> Vec<u8> {
        let mut file = self.ply_header("binary_big_endian").into_bytes();
        file.extend(self.positions.iter().flatten().flat_map(|number| number.to_be_bytes()));
        for corners in &self.triangles {
            file.push(3);
            file.extend(corners.iter().flat_map(|corner| (*corner as u32).to_be_bytes()));
        }
        file
    }

    fn threemf(&self) -> Vec<u8> {
        let vertex = |[x, y, z]: [f32; 3]| format!("<vertex x=\"{x}\" y=\"{y}\" z=\"{z}\"/>");
        let face = |[a, b, c]: [usize; 3]| format!("<triangle v1=\"{a}\" v2=\"{b}\" v3=\"{c}\"/>");
        let elements = self.lines(vertex, face);
        let elements = elements.replacen("<triangle ", "</vertices><triangles><triangle ", 1);
        let model = format!(
            "<?xml version=\"1.0\"?><model unit=\"millimeter\" \
             xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\"><resources>\
             <object id=\"1\"><mesh><vertices>{elements}</triangles></mesh></object></resources>\
             <build><item objectid=\"1\"/></build></model>"
        );
        let relationships = "<Relationships><Relationship Target=\"/3D/3dmodel.model\" Id=\"r\" \
             Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>";
        stored_zip(&[
            ("_rels/.rels", relationships.as_bytes()),
            ("3D/3dmodel.model", model.as_bytes()),
        ])
    }
}

/// Returns a zip archive whose entries are not compressed.
fn stored_zip(entries: &[(&str, &[u8])]) -> Vec<u8> {
    let (mut file, mut directory) = (Vec::new(), Vec::new());
    for (name, content) in entries {
        let (offset, size) = (file.len() as u32, (content.len() as u32).to_le_bytes());
        let mut fields = [20_u16, 0, 0, 0, 0].map(u16::to_le_bytes).concat();
        fields.extend(crc32fast::hash(content).to_le_bytes());
        fields.extend([size, size].concat());
        fields.extend((name.len() as u16).to_le_bytes());
        fields.extend([0, 0]);
        file.extend([b"PK\x03\x04", &fields[..], name.as_bytes(), content].concat());
        directory.extend([b"PK\x01\x02\x14\0", &fields[..], &[0; 10]].concat());
        directory.extend([&offset.to_le_bytes(), name.as_bytes()].concat());
    }
    let (offset, count) = (file.len() as u32, (entries.len() as u16).to_le_bytes());
    file.extend(&directory);
    file.extend([b"PK\x05\x06\0\0\0\0", &count[..], &count].concat());
    file.extend([(directory.len() as u32).to_le_bytes(), offset.to_le_bytes()].concat());
    file.extend([0, 0]);
    file
}

#[test]
fn all_formats_give_the_same_picture_and_drawing() {
    let (sandbox, part) = (Sandbox::new("mesh_formats"), turned_part());
    let files = [
        ("part.stl", part.ascii_stl()),
        ("part.stl", part.binary_stl()),
        ("part.obj", part.obj()),
        ("part.ply", part.ascii_ply()),
        ("part.ply", part.binary_ply()),
        ("part.3mf", part.threemf()),
    ];
    let mut first = None;
    for (name, file) in files {
        sandbox.write_file(name, file);
        let [picture, drawing] = ["out.png", "out.svg"].map(|output| {
            let flags = ["render", name, "--up", "z", "--unit", "mm", "--size", "160x120"];
            assert_succeeds(&sandbox, &[&flags[..], &["-o", output]].concat());
            std::fs::read(sandbox.path_of(output)).expect("the output")
        });
        // Only some formats name their parts, and drawings contain the names.
        let drawing = String::from_utf8(drawing).expect("text");
        let paths = drawing.lines().filter(|line| line.starts_with("<path"));
        let paths: Vec<String> = paths.map(str::to_owned).collect();
        let (first_picture, first_paths) =
            first.get_or_insert_with(|| (picture.clone(), paths.clone()));
        assert!(picture == *first_picture, "the picture of {name}");
        assert_eq!(paths, *first_paths, "the drawing of {name}");
    }
}
