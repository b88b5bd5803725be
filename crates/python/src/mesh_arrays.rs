//! Meshes from validated Python arrays: vertices, faces, colors, textures and materials.

use crate::arrays::{self, Numbers};
use crate::detached::run_detached;
use crate::failure::{Failure, Fallible};
use crate::keywords::Keywords;
use crate::loading::{affine_map, crease_angle, limits, place_model};
use crate::mesh_colors::{read_colors, read_texture};
use crate::mesh_material::read_material;
use crate::subject::Subject;
use homog::Affine;
use import::{ImportOptions, Limits, MeshArrays, MeshNode, load_arrays};
use pipeline::Origin;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyTuple};

/// A node from Python: its name, the index of its mesh, and the matrix from the mesh to the model.
type NodeOfPython<'py> = (Option<String>, usize, Bound<'py, PyAny>);

/// Makes a model from meshes; without nodes, each mesh appears once, untransformed.
#[pyfunction]
pub(crate) fn build_model(
    py: Python<'_>,
    meshes: Vec<Bound<'_, PyDict>>,
    nodes: Option<Vec<NodeOfPython<'_>>>,
    options: &Bound<'_, PyDict>,
) -> PyResult<Subject> {
    let options = Keywords(options);
    let import = ImportOptions {
        limits: limits(&options)?,
        up: options.named("up")?,
        length_unit: options.named("unit")?,
        crease_angle: crease_angle(&options)?,
        ..ImportOptions::default()
    };
    let read = |mesh: &Bound<'_, PyDict>| read_mesh(&Keywords(mesh), &import.limits);
    let meshes: Vec<MeshArrays> = meshes.iter().map(read).collect::<PyResult<_>>()?;
    let nodes = match nodes {
        Some(nodes) => nodes.into_iter().map(read_node).collect::<PyResult<_>>()?,
        None => (0..meshes.len()).map(|mesh| default_node(&meshes, mesh)).collect::<Vec<_>>(),
    };
    let name = options.text("name")?.unwrap_or_default();
    run_detached(py, move |_| -> Fallible<Subject> {
        let model = load_arrays(&name, meshes, &nodes, &import).map_err(|diagnostic| Failure {
            code: diagnostic.code,
            pointer: diagnostic.location,
            message: diagnostic.message,
            help: diagnostic.help,
        })?;
        let (origin, file) = Origin::from_model_bytes(&name, Vec::new());
        Ok(Subject::new(origin, file, vec![place_model(model)]))
    })
}

/// Creates the node of a mesh that appears once.
fn default_node(meshes: &[MeshArrays], mesh: usize) -> MeshNode {
    MeshNode { name: meshes[mesh].name.clone(), mesh, to_model: Affine::IDENTITY }
}

/// Reads a node.
fn read_node(node: NodeOfPython<'_>) -> PyResult<MeshNode> {
    let (name, mesh, matrix) = node;
    let argument = format!("transform of {}", name.as_deref().unwrap_or("a node"));
    Ok(MeshNode { name, mesh, to_model: affine_map(&argument, &matrix)? })
}

/// Reads a mesh and its material.
fn read_mesh(mesh: &Keywords<'_, '_>, limits: &Limits) -> PyResult<MeshArrays> {
    let Some(vertices) = mesh.value("vertices")? else {
        return Err(Failure::argument("vertices", "is None, expected an array (V, 3)").into());
    };
    let positions = arrays::finite_rows::<3>("vertices", &vertices, "V")?;
    let (lengths, corners) = match mesh.value("faces")? {
        Some(faces) => read_faces(&faces, positions.len())?,
        None => (Vec::new(), Vec::new()),
    };
    let line_ends = match mesh.value("lines")? {
        Some(lines) => {
            read_indices("lines", arrays::integer_array("lines", &lines)?, positions.len())?
        }
        None => Vec::new(),
    };
    let rows = |name: &str, count: usize, rows: usize| {
        let message = format!("has {rows} rows for {count} vertices");
        (rows == count).then_some(()).ok_or_else(|| Failure::argument(name, message))
    };
    let normals = match mesh.value("normals")? {
        Some(value) => {
            let normals = arrays::finite_rows::<3>("normals", &value, "V")?;
            rows("normals", positions.len(), normals.len())?;
            Some(normals)
        }
        None => None,
    };
    let uvs = match mesh.value("uv")? {
        Some(value) => {
            let uvs = arrays::finite_rows::<2>("uv", &value, "V")?;
            rows("uv", positions.len(), uvs.len())?;
            // Moves the origin from the lower left of the image to the upper left.
            Some(uvs.into_iter().map(|[u, v]| [u, 1.0 - v]).collect())
        }
        None => None,
    };
    let image = mesh.value("texture")?.map(|value| read_texture(&value, limits)).transpose()?;
    if image.is_some() && uvs.is_none() {
        let message = "needs texture coordinates; pass uv";
        return Err(Failure::argument("texture", message).into());
    }
    let [vertex_colors, face_colors] = read_colors(mesh, [positions.len(), lengths.len()])?;
    let has_colors = vertex_colors.is_some() || face_colors.is_some();
    let material = read_material(mesh, [image.is_some(), has_colors])?;
    Ok(MeshArrays {
        name: mesh.text("name")?,
        positions,
        lengths,
        corners,
        line_ends,
        normals,
        uvs,
        vertex_colors,
        face_colors,
        image,
        material,
    })
}

/// Returns the number of corners of each face, and the vertex index of every corner.
fn read_faces(faces: &Bound<'_, PyAny>, vertices: usize) -> PyResult<(Vec<u32>, Vec<u32>)> {
    let is_list = faces.is_instance_of::<PyList>() || faces.is_instance_of::<PyTuple>();
    if is_list && let Ok(polygons) = faces.extract::<Vec<Vec<i64>>>() {
        let (mut lengths, mut corners) = (Vec::new(), Vec::new());
        for (face, polygon) in polygons.iter().enumerate() {
            if polygon.len() < 3 {
                let message = format!("has {} vertices, expected 3 or more", polygon.len());
                return Err(Failure::argument(format!("faces[{face}]"), message).into());
            }
            lengths.push(polygon.len() as u32);
            for (corner, &vertex) in polygon.iter().enumerate() {
                let index = u32::try_from(vertex).ok().filter(|i| (*i as usize) < vertices);
                corners.push(
                    index.ok_or_else(|| no_vertex("faces", [face, corner], vertex, vertices))?,
                );
            }
        }
        return Ok((lengths, corners));
    }
    let numbers = arrays::integer_array("faces", faces)?;
    match numbers.shape[..] {
        [count, corners] if corners >= 3 => {
            let lengths = vec![corners as u32; count];
            Ok((lengths, read_indices("faces", numbers, vertices)?))
        }
        [0] => Ok((Vec::new(), Vec::new())),
        _ => {
            Err(arrays::wrong_shape("faces", &numbers.shape, "(F, 3), or (F, n) with n ≥ 3").into())
        }
    }
}

/// Reads vertex indices.
fn read_indices(name: &str, numbers: Numbers<i64>, vertices: usize) -> PyResult<Vec<u32>> {
    let [_, columns] = numbers.shape[..] else {
        return Err(arrays::wrong_shape(name, &numbers.shape, "two axes").into());
    };
    if name == "lines" && columns != 2 {
        return Err(arrays::wrong_shape(name, &numbers.shape, "(L, 2)").into());
    }
    let index = |(at, vertex): (usize, i64)| {
        let index = u32::try_from(vertex).ok().filter(|index| (*index as usize) < vertices);
        index.ok_or_else(|| no_vertex(name, [at / columns, at % columns], vertex, vertices))
    };
    let indices: Result<Vec<u32>, Failure> =
        numbers.values.into_iter().enumerate().map(index).collect();
    Ok(indices?)
}

/// Returns the error for an index out of range.
fn no_vertex(name: &str, [row, column]: [usize; 2], vertex: i64, vertices: usize) -> Failure {
    let message = format!("is {vertex}, but there are {vertices} vertices");
    Failure::argument(format!("{name}[{row}, {column}]"), message)
}
