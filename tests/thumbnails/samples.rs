//! One file in each format, and a broken file.

use alberti_tests::threemf::encode_3mf;
use std::path::Path;

/// The files that must have thumbnails.
pub const SHOWN: [&str; 6] = ["a.glb", "b.gltf", "c.stl", "d.obj", "e.ply", "f.3mf"];

/// The file that must not have a thumbnail.
pub const BROKEN: &str = "broken.stl";

/// Returns the MIME type that a file manager determines for a file.
pub fn mime_type(name: &str) -> &'static str {
    match name.rsplit('.').next() {
        Some("glb") => "model/gltf-binary",
        Some("gltf") => "model/gltf+json",
        Some("stl") => "model/stl",
        Some("obj") => "model/obj",
        Some("ply") => "model/x-ply",
        _ => "model/3mf",
    }
}

/// The vertices and faces of a tetrahedron.
const CORNERS: [[i32; 3]; 4] = [[0, 0, 0], [2, 0, 0], [0, 2, 0], [0, 0, 2]];
const FACES: [[usize; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];

/// Writes all files into a folder.
///
/// # Errors
/// Returns an error that names the file if one cannot be written.
pub fn write_samples(folder: &Path) -> Result<(), String> {
    let read = |path: &str| {
        let path = alberti_tests::project_root().join(path);
        std::fs::read(&path).map_err(|error| format!("{}: {error}", path.display()))
    };
    for (name, content) in [
        ("a.glb", read("scenes/models/teapot.glb")?),
        ("b.gltf", read("docs/exercises/triangle.gltf")?),
        ("c.stl", stl_text().into_bytes()),
        ("d.obj", obj_text().into_bytes()),
        ("e.ply", ply_text().into_bytes()),
        ("f.3mf", encode_3mf(threemf_part().as_bytes())),
        (BROKEN, b"solid broken\nfacet normal".to_vec()),
    ] {
        let path = folder.join(name);
        std::fs::write(&path, content).map_err(|error| format!("{}: {error}", path.display()))?;
    }
    Ok(())
}

/// Joins numbers with spaces.
fn joined<T: ToString>(numbers: &[T]) -> String {
    numbers.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ")
}

fn stl_text() -> String {
    let vertex = |&corner: &usize| format!("vertex {}\n", joined(&CORNERS[corner]));
    let facet = |face: &[usize; 3]| {
        let vertices: String = face.iter().map(vertex).collect();
        format!("facet normal 0 0 0\nouter loop\n{vertices}endloop\nendfacet\n")
    };
    format!("solid s\n{}endsolid s\n", FACES.iter().map(facet).collect::<String>())
}

fn obj_text() -> String {
    let corners = CORNERS.iter().map(|corner| format!("v {}\n", joined(corner)));
    let faces = FACES.iter().map(|face| format!("f {}\n", joined(&face.map(|at| at + 1))));
    corners.chain(faces).collect()
}

fn ply_text() -> String {
    let header = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n\
                  property float z\nelement face 4\nproperty list uchar int vertex_indices\n\
                  end_header\n";
    let corners = CORNERS.iter().map(|corner| joined(corner) + "\n");
    let faces = FACES.iter().map(|face| format!("3 {}\n", joined(face)));
    [header.to_owned()].into_iter().chain(corners).chain(faces).collect()
}

fn threemf_part() -> String {
    let vertices = CORNERS.map(|[x, y, z]| format!(r#"<vertex x="{x}" y="{y}" z="{z}"/>"#));
    let triangles = FACES.map(|[a, b, c]| format!(r#"<triangle v1="{a}" v2="{b}" v3="{c}"/>"#));
    format!(
        r#"<?xml version="1.0"?><model unit="millimeter"
xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources><object id="1"><mesh>
<vertices>{}</vertices><triangles>{}</triangles></mesh></object></resources><build>
<item objectid="1"/></build></model>"#,
        vertices.concat(),
        triangles.concat()
    )
}
