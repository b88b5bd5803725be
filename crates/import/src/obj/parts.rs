//! Parts: the elements of an OBJ file, split into points, lines and triangles and sorted by group,
//! material and attributes. Each part becomes a primitive.

use super::elements::{Corner, ElementState, NONE};
use super::parser::ObjFile;
use crate::polygons::{PolygonKind, Triangulator};
use crate::text::LineCounter;
use files::counted;
use gltf_import::ImportWarnings;
use model::{Diagnostic, Topology, codes};
use std::collections::BTreeMap;

/// Smoothing groups from this number on each belong to a single polygon.
pub(super) const FLAT_GROUP: u32 = 1 << 31;

/// Attributes shared by all items of a part.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) struct PartKey {
    /// The object and group, as an index into the file's groups.
    pub(super) group: u32,
    /// The material, as an index into the file's material names.
    pub(super) material: Option<u32>,
    /// Number of indices per item: 1 for points, 2 for lines, 3 for triangles.
    pub(super) corners_per_item: usize,
    /// Whether all corners have texture coordinates.
    pub(super) has_uvs: bool,
    /// Whether all corners have normals.
    pub(super) has_normals: bool,
}

/// The points, lines or triangles of one primitive.
#[derive(Debug)]
pub(super) struct Part {
    /// The shared attributes.
    pub(super) key: PartKey,
    /// Corners of the items, as indices into the file's corners.
    pub(super) corners: Vec<u32>,
    /// The smoothing group of each item; empty in files without smoothing groups.
    pub(super) smoothing: Vec<u32>,
}

impl Part {
    /// Returns the kind of the items: points, lines or triangles.
    pub(super) const fn topology(&self) -> Topology {
        match self.key.corners_per_item {
            1 => Topology::Points,
            2 => Topology::Lines,
            _ => Topology::Triangles,
        }
    }
}

/// Splits and sorts the elements of a file. Parts are in the order of their first elements.
///
/// # Errors
/// Fails if an element has a vertex without three finite coordinates. In lenient mode, the element
/// is skipped.
pub(super) fn split_elements(
    file: &ObjFile<'_>,
    text: &[u8],
    warnings: &mut ImportWarnings,
) -> Result<Vec<Part>, Diagnostic> {
    let mut cutter = ElementCutter::new(file);
    let mut broken = 0_usize;
    for (state, elements) in file.elements.runs() {
        let mut latest = None;
        for element in elements {
            let range = file.elements.corner_range(element);
            let corners = &file.elements.corners[range.clone()];
            match cutter.find_broken_vertex(corners) {
                None => {}
                Some(None) => continue,
                Some(Some(offset)) => {
                    // Counting lines takes time, so only the first error has a location.
                    if broken == 0 {
                        let fault = broken_vertex(&LineCounter::new(text).locate(offset));
                        warnings.downgrade_if_lenient(fault, "the element is skipped")?;
                    }
                    broken += 1;
                    continue;
                }
            }
            let has_uvs = corners.iter().all(|corner| corner.uv != NONE);
            let has_normals = corners.iter().all(|corner| corner.normal != NONE);
            let attributes = (has_uvs, has_normals);
            let part = match latest {
                Some((same, part)) if same == attributes => part,
                _ => cutter.part_of(state, has_uvs, has_normals),
            };
            latest = Some((attributes, part));
            // A polygon that is not smooth forms its own group, however it is triangulated.
            let smoothing = match state.smoothing {
                0 => FLAT_GROUP | element as u32,
                group => group,
            };
            cutter.cut_element(part, smoothing, range.start as u32, corners);
        }
    }
    if broken > 1 {
        let message = match broken - 1 {
            1 => "skipped 1 more element with broken vertices".to_owned(),
            more => format!("skipped {more} more elements with broken vertices"),
        };
        warnings.push_warning("", message);
    }
    if cutter.fans > 0 {
        let polygons = counted(
            cutter.fans,
            "polygon intersects itself or is too complex",
            "polygons intersect themselves or are too complex",
        );
        let message = format!("{polygons}, so triangles may overlap");
        warnings.push_warning("", message);
    }
    Ok(cutter.parts)
}

/// Returns the error for an element with a vertex that has no valid position.
fn broken_vertex(location: &str) -> Diagnostic {
    let message = "an element uses this vertex, which does not have three finite coordinates";
    let help = "export the file again, or load it with --lenient";
    Diagnostic::error(codes::INVALID_DATA, location, message, help)
}

/// The parts so far, and the state of the triangulation.
struct ElementCutter<'a> {
    file: &'a ObjFile<'a>,
    parts: Vec<Part>,
    part_indices: BTreeMap<PartKey, usize>,
    triangulator: Triangulator,
    /// Corners of the current polygon.
    polygon: Vec<[f32; 3]>,
    /// Triangles of the current polygon.
    triangles: Vec<[u32; 3]>,
    /// Number of polygons that were split into fans.
    fans: usize,
}

impl<'a> ElementCutter<'a> {
    /// Creates a cutter without parts.
    fn new(file: &'a ObjFile<'a>) -> Self {
        Self {
            file,
            parts: Vec::new(),
            part_indices: BTreeMap::new(),
            triangulator: Triangulator::default(),
            polygon: Vec::new(),
            triangles: Vec::new(),
            fans: 0,
        }
    }

    /// Returns the part for an element, adding it if necessary.
    fn part_of(&mut self, state: ElementState, has_uvs: bool, has_normals: bool) -> usize {
        let ElementState { group, material, topology, .. } = state;
        let corners_per_item = topology.vertices_per_item();
        let has_normals = has_normals && topology == Topology::Triangles;
        let key = PartKey { group, material, corners_per_item, has_uvs, has_normals };
        let parts = &mut self.parts;
        *self.part_indices.entry(key).or_insert_with(|| {
            parts.push(Part { key, corners: Vec::new(), smoothing: Vec::new() });
            parts.len() - 1
        })
    }

    /// Returns the offset of the first broken vertex statement that an element uses. The offset is
    /// `None` for a vertex that does not exist, which has already been reported.
    fn find_broken_vertex(&self, corners: &[Corner]) -> Option<Option<usize>> {
        if corners.iter().any(|corner| corner.position as usize >= self.file.positions.len()) {
            return Some(None);
        }
        let broken = &self.file.broken_positions;
        if broken.is_empty() {
            return None;
        }
        let find = |corner: &Corner| broken.binary_search_by_key(&corner.position, |at| at.0).ok();
        corners.iter().find_map(find).map(|at| Some(broken[at].1))
    }

    /// Appends the points, lines or triangles of an element to a part.
    fn cut_element(&mut self, part: usize, smoothing: u32, first: u32, corners: &[Corner]) {
        let count = corners.len() as u32;
        let part = &mut self.parts[part];
        let before = part.corners.len();
        match (part.key.corners_per_item, count) {
            (1, _) => part.corners.extend(first..first + count),
            (2, _) => part.corners.extend((1..count).flat_map(|at| [first + at - 1, first + at])),
            (_, 3) => part.corners.extend([first, first + 1, first + 2]),
            _ => {
                let position = |corner: &Corner| self.file.positions[corner.position as usize];
                self.polygon.clear();
                self.polygon.extend(corners.iter().map(position));
                self.triangles.clear();
                let kind = self.triangulator.triangulate(&self.polygon, &mut self.triangles);
                self.fans += usize::from(kind == PolygonKind::Fan);
                part.corners.extend(self.triangles.as_flattened().iter().map(|at| first + at));
            }
        }
        if self.file.has_smoothing {
            let items = (part.corners.len() - before) / part.key.corners_per_item;
            part.smoothing.extend(std::iter::repeat_n(smoothing, items));
        }
    }
}
