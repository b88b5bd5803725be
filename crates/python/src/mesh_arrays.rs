//! Meshes as arrays of Python: vertices, faces, colors, textures and materials, checked.

use crate::arrays::{self, Numbers};
use crate::detached::run_detached;
use crate::failure::{Failure, Fallible};
use crate::keywords::{Keywords, not_a};
use crate::loading::{affine_map, limits, place_model};
use crate::subject::Subject;
use homog::Affine;
use model::import::{ImportOptions, Limits, MeshArrays, MeshNode, decode_image, load_arrays};
use model::{AlphaMode, Image, Material};
use pipeline::Origin;
use pipeline::scene::file::Color;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyList, PyTuple};

/// A node of Python: its name, the index of its mesh, and the matrix to the model.
type NodeOfPython<'py> = (Option<String>, usize, Bound<'py, PyAny>);

/// Makes a model of meshes; without nodes each mesh is shown where its vertices say.
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
        crease_angle: crease(&options)?,
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

/// The node of a mesh that is shown once.
fn default_node(meshes: &[MeshArrays], mesh: usize) -> MeshNode {
    MeshNode { name: meshes[mesh].name.clone(), mesh, to_model: Affine::IDENTITY }
}

/// Reads a node.
fn read_node((name, mesh, matrix): NodeOfPython<'_>) -> PyResult<MeshNode> {
    let argument = format!("transform of {}", name.as_deref().unwrap_or("a node"));
    Ok(MeshNode { name, mesh, to_model: affine_map(&argument, &matrix)? })
}

/// The crease angle in degrees.
fn crease(options: &Keywords<'_, '_>) -> PyResult<Option<f64>> {
    let angle = options.number("crease")?;
    if let Some(angle) = angle.filter(|angle| !(0.0..=180.0).contains(angle)) {
        let message = format!("is {angle}, expected an angle from 0 to 180 degrees");
        return Err(Failure::argument("crease", message).into());
    }
    Ok(angle)
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
            // From the lower left of the image to the upper left.
            Some(uvs.into_iter().map(|[u, v]| [u, 1.0 - v]).collect())
        }
        None => None,
    };
    let image = mesh.value("texture")?.map(|value| read_texture(&value, limits)).transpose()?;
    if image.is_some() && uvs.is_none() {
        let message = "needs texture coordinates: give uv";
        return Err(Failure::argument("texture", message).into());
    }
    let [vertex_colors, face_colors] = read_colors(mesh, [positions.len(), lengths.len()])?;
    let has_colors = image.is_some() || vertex_colors.is_some() || face_colors.is_some();
    let material = read_material(mesh, has_colors)?;
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

/// Numbers of corners, and the vertices of all corners.
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

/// Indices of vertices.
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

/// The error of an index out of range.
fn no_vertex(name: &str, [row, column]: [usize; 2], vertex: i64, vertices: usize) -> Failure {
    let message = format!("is {vertex}, and there are {vertices} vertices");
    Failure::argument(format!("{name}[{row}, {column}]"), message)
}

/// Colors of the vertices and of the faces, linear; `counts` has their numbers.
fn read_colors(
    mesh: &Keywords<'_, '_>,
    counts: [usize; 2],
) -> PyResult<[Option<Vec<[f32; 4]>>; 2]> {
    let Some(value) = mesh.value("colors")? else { return Ok([None, None]) };
    let (shape, colors) = linear_colors("colors", &value)?;
    let [vertices, faces] = counts;
    match shape[..] {
        [rows, 3 | 4] if rows == vertices => Ok([Some(colors), None]),
        [rows, 3 | 4] if rows == faces => Ok([None, Some(colors)]),
        _ => {
            let wanted =
                format!("({vertices}, 3 or 4) for vertices or ({faces}, 3 or 4) for faces");
            Err(arrays::wrong_shape("colors", &shape, &wanted).into())
        }
    }
}

/// sRGB colors of bytes or of fractions, as linear ones with alpha; and the shape they had.
fn linear_colors(name: &str, value: &Bound<'_, PyAny>) -> PyResult<(Vec<usize>, Vec<[f32; 4]>)> {
    let kind: String =
        arrays::as_array(name, value)?.getattr("dtype")?.getattr("kind")?.extract()?;
    let most = if kind == "f" { 1.0 } else { 255.0 };
    let Numbers { shape, values } = arrays::real_array::<f64>(name, value, "float64")?;
    if let Some(at) = values.iter().position(|channel| !(0.0..=most).contains(channel)) {
        let element = format!("{name}.flat[{at}]");
        let message = format!("is {}, expected a number from 0 to {most}", values[at]);
        return Err(Failure::argument(element, message).into());
    }
    let channels = shape.last().copied().unwrap_or(0);
    if !(3..=4).contains(&channels) {
        return Err(arrays::wrong_shape(name, &shape, "(…, 3) or (…, 4)").into());
    }
    let to_linear = |color: &[f64]| {
        let [r, g, b] = [0, 1, 2].map(|at: usize| linear_channel(color[at], most));
        [r, g, b, color.get(3).map_or(1.0, |alpha| (alpha / most) as f32)]
    };
    Ok((shape, values.chunks_exact(channels).map(to_linear).collect()))
}

/// The linear value of an sRGB channel: of bytes by the table, of fractions by the formula.
fn linear_channel(channel: f64, most: f64) -> f32 {
    if most == 1.0 {
        let decoded = if channel <= 0.04045 {
            channel / 12.92
        } else {
            libm::pow((channel + 0.055) / 1.055, 2.4)
        };
        return decoded as f32;
    }
    shade::color::srgb_to_linear_table()[channel as usize]
}

/// A texture: an array of bytes, or the content of an image file.
fn read_texture(value: &Bound<'_, PyAny>, limits: &Limits) -> PyResult<Image> {
    if let Ok(bytes) = value.cast::<PyBytes>() {
        let image = decode_image(bytes.as_bytes(), limits.image_texels);
        return Ok(image.map_err(|message| Failure::argument("texture", message))?);
    }
    let array = arrays::as_array("texture", value)?;
    let dtype = array.getattr("dtype")?.str()?.to_string();
    let Numbers { shape, values } = arrays::integer_array("texture", &array)?;
    let (height, width, channels) = match shape[..] {
        [height, width] => (height, width, 1),
        [height, width, channels @ (1 | 3 | 4)] => (height, width, channels),
        _ => return Err(arrays::wrong_shape("texture", &shape, "(height, width, 3 or 4)").into()),
    };
    if dtype != "uint8" {
        return Err(Failure::argument("texture", format!("dtype {dtype}, expected uint8")).into());
    }
    let side = limits.image_side as usize;
    if height == 0 || width == 0 || height.max(width) > side {
        let message = format!("has {width} x {height} texels, expected sides from 1 to {side}");
        return Err(Failure::argument("texture", message).into());
    }
    let texel = |channels: &[i64]| match *channels {
        [gray] => [gray, gray, gray, 255],
        [r, g, b] => [r, g, b, 255],
        [r, g, b, a, ..] => [r, g, b, a],
        _ => [0; 4],
    };
    let rgba = values.chunks_exact(channels).map(|c| texel(c).map(|value| value as u8)).collect();
    Ok(Image { width: width as u32, height: height as u32, rgba })
}

/// The material; `None` if nothing is said of it.
fn read_material(mesh: &Keywords<'_, '_>, has_colors: bool) -> PyResult<Option<Material>> {
    let fraction = |name: &str| -> PyResult<Option<f32>> {
        let Some(number) = mesh.number(name)? else { return Ok(None) };
        if (0.0..=1.0).contains(&number) {
            return Ok(Some(number as f32));
        }
        let message = format!("is {number}, expected a number from 0 to 1");
        Err(Failure::argument(name, message).into())
    };
    let color = mesh.value("color")?.map(|value| read_color(&value)).transpose()?;
    let (metallic, roughness) = (fraction("metallic")?, fraction("roughness")?);
    let double_sided = mesh.value("double_sided")?.is_none() || mesh.flag("double_sided")?;
    if color.is_none() && metallic.is_none() && roughness.is_none() && double_sided {
        return Ok(None);
    }
    let plain = Material::plain();
    let usual = if has_colors { [1.0; 4] } else { plain.base_color };
    let base_color = color.unwrap_or(usual);
    let is_translucent = base_color[3] < 1.0;
    Ok(Some(Material {
        base_color,
        metallic: metallic.unwrap_or(plain.metallic),
        roughness: roughness.unwrap_or(plain.roughness),
        double_sided,
        alpha_mode: if is_translucent { AlphaMode::Blend } else { AlphaMode::Opaque },
        ..plain
    }))
}

/// A color by its name or by its channels.
fn read_color(value: &Bound<'_, PyAny>) -> PyResult<[f32; 4]> {
    if let Ok(name) = value.extract::<String>() {
        let Some(color) = Color::parse(&name) else {
            return Err(not_a("color", value, "#rrggbb, the name of a color, or numbers").into());
        };
        let [r, g, b] = color.to_linear();
        return Ok([r, g, b, 1.0]);
    }
    match &linear_colors("color", value)?.1[..] {
        [color] => Ok(*color),
        _ => Err(not_a("color", value, "one color of 3 or 4 channels").into()),
    }
}
