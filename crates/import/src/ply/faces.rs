//! The faces of a PLY file: polygons, triangle strips, and face and corner attributes.

use super::body::Body;
use super::header::{PlyElement, PlyProperty};
use super::vertices::{color_channel, linearize_colors};
use gltf_import::ImportWarnings;
use model::Diagnostic;

/// Polygons, stored one after another in shared arrays.
#[derive(Default, Debug)]
pub(crate) struct Faces {
    /// The number of corners of each face.
    pub(crate) lengths: Vec<u32>,
    /// Vertex indices of all corners, all less than the declared number of vertices.
    pub(crate) corners: Vec<u32>,
    /// Texture coordinates of all corners, with (0, 0) at the upper left.
    pub(crate) uvs: Option<Vec<[f32; 2]>>,
    /// The linear color of each face.
    pub(crate) colors: Option<Vec<[f32; 4]>>,
    /// The texture of each face, as an index into the file's textures.
    pub(crate) textures: Option<Vec<u32>>,
    /// The number of faces with fewer than three corners, which are skipped.
    pub(crate) without_area: usize,
}

/// The meaning of a face property.
#[derive(Clone, Copy, PartialEq, Debug)]
enum FaceProperty {
    Corners,
    Uvs,
    Color(usize),
    Texture,
    Unused,
}

impl FaceProperty {
    fn from_property(property: &PlyProperty) -> Self {
        match (property.list_length.is_some(), property.name.as_str()) {
            (true, "vertex_indices" | "vertex_index" | "vertex_indexes") => Self::Corners,
            (true, "texcoord") => Self::Uvs,
            (false, "texnumber") => Self::Texture,
            (false, name) => color_channel(name).map_or(Self::Unused, Self::Color),
            _ => Self::Unused,
        }
    }
}

/// A face that is being read.
#[derive(Default)]
struct FaceRecord {
    corners: Vec<u32>,
    uvs: Vec<f32>,
    color: [f32; 4],
    texture: u32,
}

/// Reads the polygons of an element.
///
/// # Errors
/// Fails if an index refers to a missing vertex, or the file ends before the last face. In lenient
/// mode, the face or all remaining faces are skipped.
pub(super) fn read_faces(
    body: &mut Body<'_>,
    element: &PlyElement,
    vertices: u64,
    warnings: &mut ImportWarnings,
) -> Result<Faces, Diagnostic> {
    let kinds: Vec<_> = element.properties.iter().map(FaceProperty::from_property).collect();
    let has = |kind| kinds.contains(&kind);
    if !has(FaceProperty::Corners) {
        if element.count > 0 {
            let message = "the faces have no `vertex_indices` list; they are skipped";
            warnings.push_warning("element face", message);
        }
        body.skip_element(element)?;
        return Ok(Faces::default());
    }
    // A declared count may be far larger than the file, so the remaining bytes limit the capacity.
    let capacity = body.plausible_records(element);
    let mut faces = Faces {
        lengths: Vec::with_capacity(capacity),
        corners: Vec::with_capacity(capacity.saturating_mul(3)),
        uvs: has(FaceProperty::Uvs).then(Vec::new),
        colors: (0..3).all(|channel| has(FaceProperty::Color(channel))).then(Vec::new),
        textures: has(FaceProperty::Texture).then(Vec::new),
        without_area: 0,
    };
    let mut record = FaceRecord::default();
    for _ in 0..element.count {
        match record.read(body, &element.properties, &kinds, vertices) {
            Ok(None) => faces.push_face(&record),
            Ok(Some(fault)) => warnings.downgrade_if_lenient(fault, "the face is skipped")?,
            Err(fault) => {
                warnings.downgrade_if_lenient(fault, "the remaining faces are skipped")?;
                break;
            }
        }
        body.end_record();
    }
    if let Some(colors) = &mut faces.colors {
        linearize_colors(colors, &element.properties, warnings, "element face");
    }
    Ok(faces)
}

impl FaceRecord {
    /// Reads a face. An error that affects only this face is returned as `Ok(Some(error))`.
    ///
    /// # Errors
    /// Fails if nothing after the error can be read.
    fn read(
        &mut self,
        body: &mut Body<'_>,
        properties: &[PlyProperty],
        kinds: &[FaceProperty],
        vertices: u64,
    ) -> Result<Option<Diagnostic>, Diagnostic> {
        let mut fault = None;
        self.uvs.clear();
        for (property, &kind) in properties.iter().zip(kinds) {
            let scalar = property.scalar;
            match (property.list_length, kind) {
                (Some(length), FaceProperty::Corners) => {
                    let count = body.next_list_length(length, scalar)?;
                    self.corners.clear();
                    for _ in 0..count {
                        let vertex = body.next_number(scalar)?;
                        // A bad index does not end the loop: the rest of the record must be
                        // consumed.
                        if !(vertex >= 0.0 && vertex < vertices as f64) {
                            fault.get_or_insert_with(|| no_such_vertex(body, vertex, vertices));
                        }
                        self.corners.push(vertex as u32);
                    }
                }
                (Some(length), FaceProperty::Uvs) => {
                    for _ in 0..body.next_list_length(length, scalar)? {
                        self.uvs.push(body.next_number(scalar)? as f32);
                    }
                }
                (Some(length), _) => {
                    let count = body.next_list_length(length, scalar)?;
                    body.skip_numbers(count, scalar)?;
                }
                (None, FaceProperty::Color(channel)) => {
                    self.color[channel] = body.next_number(scalar)? as f32;
                }
                (None, FaceProperty::Texture) => self.texture = body.next_number(scalar)? as u32,
                (None, _) => drop(body.next_number(scalar)?),
            }
        }
        Ok(fault)
    }
}

/// Returns the error for an index of a missing vertex.
pub(super) fn no_such_vertex(body: &Body<'_>, vertex: f64, vertices: u64) -> Diagnostic {
    body.fault(&format!("there is no vertex {vertex}: the file has {vertices}, numbered from 0"))
}

impl Faces {
    /// Adds a face if it has at least three corners.
    fn push_face(&mut self, record: &FaceRecord) {
        let count = record.corners.len();
        if count < 3 {
            self.without_area += 1;
            return;
        }
        self.lengths.push(count as u32);
        self.corners.extend_from_slice(&record.corners);
        if let Some(uvs) = &mut self.uvs {
            let pairs = record.uvs.as_chunks().0;
            if pairs.len() == count {
                uvs.extend(pairs.iter().map(|&[s, t]| [s, 1.0 - t]));
            } else {
                uvs.resize(uvs.len() + count, [0.0; 2]);
            }
        }
        if let Some(colors) = &mut self.colors {
            colors.push(record.color);
        }
        if let Some(textures) = &mut self.textures {
            textures.push(record.texture);
        }
    }
}

/// Reads triangle strips: lists of vertices in which −1 starts a new strip.
///
/// Every second triangle of a strip is reversed, so that all face the same way.
///
/// # Errors
/// Fails in the same cases as [`read_faces`].
pub(super) fn read_strips(
    body: &mut Body<'_>,
    element: &PlyElement,
    vertices: u64,
    warnings: &mut ImportWarnings,
) -> Result<Faces, Diagnostic> {
    let mut faces = Faces::default();
    for _ in 0..element.count {
        for property in &element.properties {
            let Some(length) = property.list_length else {
                body.next_number(property.scalar)?;
                continue;
            };
            let count = body.next_list_length(length, property.scalar)?;
            if FaceProperty::from_property(property) != FaceProperty::Corners {
                body.skip_numbers(count, property.scalar)?;
                continue;
            }
            let (mut last, mut in_strip) = ([0; 2], 0_usize);
            for _ in 0..count {
                let vertex = body.next_number(property.scalar)?;
                if !(vertex >= 0.0 && vertex < vertices as f64) {
                    if vertex != -1.0 {
                        let fault = no_such_vertex(body, vertex, vertices);
                        warnings.downgrade_if_lenient(fault, "the strip ends before it")?;
                    }
                    in_strip = 0;
                    continue;
                }
                let vertex = vertex as u32;
                if in_strip >= 2 {
                    let [a, b] = if in_strip % 2 == 0 { last } else { [last[1], last[0]] };
                    faces.lengths.push(3);
                    faces.corners.extend([a, b, vertex]);
                }
                last = [last[1], vertex];
                in_strip += 1;
            }
        }
        // Records without properties take no bytes, so the file size does not limit their count.
        if element.properties.is_empty() {
            break;
        }
    }
    Ok(faces)
}

/// Reads edges as pairs of vertices.
///
/// # Errors
/// Fails in the same cases as [`read_faces`].
pub(super) fn read_edges(
    body: &mut Body<'_>,
    element: &PlyElement,
    vertices: u64,
    warnings: &mut ImportWarnings,
) -> Result<Vec<u32>, Diagnostic> {
    let end = |name: &str| {
        element.properties.iter().position(|p| p.name == name && p.list_length.is_none())
    };
    let (Some(first), Some(second)) = (end("vertex1"), end("vertex2")) else {
        body.skip_element(element)?;
        return Ok(Vec::new());
    };
    let mut edges = Vec::with_capacity(2 * body.plausible_records(element));
    let mut ends = [0.0; 2];
    for _ in 0..element.count {
        for (at, property) in element.properties.iter().enumerate() {
            match property.list_length {
                Some(length) => {
                    let count = body.next_list_length(length, property.scalar)?;
                    body.skip_numbers(count, property.scalar)?;
                }
                None => {
                    let number = body.next_number(property.scalar)?;
                    if at == first || at == second {
                        ends[usize::from(at == second)] = number;
                    }
                }
            }
        }
        match ends.iter().find(|&&end| !(end >= 0.0 && end < vertices as f64)) {
            None => edges.extend(ends.map(|end| end as u32)),
            Some(&end) => {
                let fault = no_such_vertex(body, end, vertices);
                warnings.downgrade_if_lenient(fault, "the edge is skipped")?;
            }
        }
    }
    Ok(edges)
}
