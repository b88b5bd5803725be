//! A parser that converts the statements of an OBJ file to vertex data, elements and names.
//!
//! Source: Alias|Wavefront, *Object Files (.obj)*, Appendix B1 of the Advanced Visualizer manual;
//! vertex colors are an extension by ZBrush and MeshLab.

use super::elements::{Corner, ElementState, Elements, NONE};
use super::fault_counts::FaultCounts;
use super::parts::FLAT_GROUP;
use super::statements::StatementReader;
use crate::text::{LineCounter, Token, parse_f32, parse_integer};
use gltf_import::ImportWarnings;
use model::{Diagnostic, Topology, codes};
use std::collections::BTreeMap;

/// Statements that do not affect how a polygon mesh is drawn.
const IGNORED: [&[u8]; 6] =
    [b"lod", b"shadow_obj", b"trace_obj", b"c_interp", b"d_interp", b"bevel"];

/// The content of an OBJ file. Names are slices of its text.
#[derive(Debug, Default)]
pub(super) struct ObjFile<'a> {
    /// Positions; a position is not finite if its statement is malformed.
    pub(super) positions: Vec<[f32; 3]>,
    /// Vertex colors as stored in the file, with NaN for missing components. Shorter than
    /// `positions` if the last vertices have no colors.
    pub(super) colors: Vec<[f32; 4]>,
    /// Texture coordinates, with v pointing up.
    pub(super) uvs: Vec<[f32; 2]>,
    /// Normals of any length.
    pub(super) normals: Vec<[f32; 3]>,
    /// Points, lines and polygons.
    pub(super) elements: Elements,
    /// Objects and groups that have elements, in file order.
    pub(super) groups: Vec<GroupName<'a>>,
    /// Materials that elements use, in file order.
    pub(super) material_names: Vec<&'a [u8]>,
    /// Material libraries.
    pub(super) libraries: Vec<Token<'a>>,
    /// The index and the statement offset of each vertex without three finite coordinates.
    pub(super) broken_positions: Vec<(u32, usize)>,
    /// Whether the file has smoothing groups.
    pub(super) has_smoothing: bool,
}

/// An element's object and group by name; a missing name is empty.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Default)]
pub(super) struct GroupName<'a> {
    /// The object, from `o`.
    pub(super) object: &'a [u8],
    /// The groups, from `g`; several groups form one name.
    pub(super) group: &'a [u8],
}

/// Parses an OBJ file in UTF-8.
///
/// # Errors
/// Fails if an element refers to a vertex that does not exist. In lenient mode, the element is
/// skipped.
pub(super) fn parse_obj<'a>(
    text: &'a [u8],
    warnings: &mut ImportWarnings,
) -> Result<ObjFile<'a>, Diagnostic> {
    if text.len() > u32::MAX as usize {
        let what = format!("the file has {} bytes", text.len());
        return Err(Diagnostic::limit_exceeded("", &what, "file_bytes", u64::from(u32::MAX)));
    }
    let mut parser = ObjParser::new(text, warnings);
    while let Some(keyword) = parser.reader.next_statement() {
        parser.read_statement(keyword)?;
    }
    parser.finish()
}

/// The parser, with the state at the current statement.
struct ObjParser<'a, 'w> {
    reader: StatementReader<'a>,
    lines: LineCounter<'a>,
    warnings: &'w mut ImportWarnings,
    file: ObjFile<'a>,
    /// The object and group of the next element.
    name: GroupName<'a>,
    /// The index of `name` in the file's groups, once an element has used it.
    group: Option<u32>,
    /// The material of the next element.
    material: Option<u32>,
    /// The smoothing group of the next element.
    smoothing: u32,
    group_indices: BTreeMap<GroupName<'a>, u32>,
    material_indices: BTreeMap<&'a [u8], u32>,
    /// Whether there has been an element, even a broken one.
    has_elements: bool,
    /// References to vertices that are not yet defined, as element, offset and index.
    forward: Vec<(usize, usize, u32)>,
    faults: FaultCounts<'a>,
}

impl<'a, 'w> ObjParser<'a, 'w> {
    /// Creates a parser at the beginning of the text.
    fn new(text: &'a [u8], warnings: &'w mut ImportWarnings) -> Self {
        Self {
            reader: StatementReader::new(text),
            lines: LineCounter::new(text),
            warnings,
            file: ObjFile::default(),
            name: GroupName::default(),
            group: None,
            material: None,
            smoothing: 0,
            group_indices: BTreeMap::new(),
            material_indices: BTreeMap::new(),
            has_elements: false,
            forward: Vec::new(),
            faults: FaultCounts::default(),
        }
    }

    /// Reads the arguments of a statement.
    fn read_statement(&mut self, keyword: Token<'a>) -> Result<(), Diagnostic> {
        match keyword.bytes {
            b"v" => self.read_position(keyword.offset),
            b"vt" => self.read_uv(keyword.offset),
            b"vn" => {
                let [x, y, z, ..] = self.read_numbers::<3>().0;
                self.file.normals.push([x, y, z]);
            }
            b"f" | b"fo" => self.read_element(keyword.offset, Topology::Triangles)?,
            b"l" => self.read_element(keyword.offset, Topology::Lines)?,
            b"p" => self.read_element(keyword.offset, Topology::Points)?,
            b"o" => self.set_name(|name, text| *name = GroupName { object: text, group: b"" }),
            b"g" => self.set_name(|name, text| {
                name.group = if text == b"default" { b"" } else { text };
            }),
            b"usemtl" => self.set_material(),
            b"s" => self.set_smoothing(),
            b"mtllib" => self.file.libraries.push(self.reader.rest_of_line()),
            name if IGNORED.contains(&name) => {}
            name => self.faults.count_statement(name, keyword.offset),
        }
        Ok(())
    }

    /// Reads at most `N` numeric arguments, and returns them with their number. Missing or broken
    /// arguments are NaN.
    #[inline]
    fn read_numbers<const N: usize>(&mut self) -> ([f32; N], usize) {
        let (mut numbers, mut count) = ([f32::NAN; N], 0);
        while count < N
            && let Some(token) = self.reader.next_argument()
        {
            numbers[count] = parse_f32(token.bytes).unwrap_or(f32::NAN);
            count += 1;
        }
        (numbers, count)
    }

    /// Reads `v x y z`, followed by a weight or by a color with three or four components.
    ///
    /// The weight applies to rational curves and does not affect points.
    fn read_position(&mut self, offset: usize) {
        let (numbers, count) = self.read_numbers::<7>();
        let [x, y, z, r, g, b, a] = numbers;
        let index = self.file.positions.len();
        if !(x.is_finite() && y.is_finite() && z.is_finite()) {
            self.file.broken_positions.push((index as u32, offset));
        }
        self.file.positions.push([x, y, z]);
        if count >= 6 {
            self.file.colors.resize(index, [f32::NAN; 4]);
            self.file.colors.push([r, g, b, a]);
        }
    }

    /// Reads `vt u v w`. A missing v is 0; w is for 3D textures.
    fn read_uv(&mut self, offset: usize) {
        let ([u, v], count) = self.read_numbers::<2>();
        let uv = [u, if count < 2 { 0.0 } else { v }];
        if !(uv[0].is_finite() && uv[1].is_finite()) {
            self.faults.broken_uvs.count_at(offset);
        }
        self.file.uvs.push(uv.map(|x| if x.is_finite() { x } else { 0.0 }));
    }

    /// Sets the name of the following elements from the rest of the line.
    fn set_name(&mut self, change: impl FnOnce(&mut GroupName<'a>, &'a [u8])) {
        let text = self.reader.rest_of_line().bytes;
        change(&mut self.name, text);
        self.group = None;
    }

    /// Reads `usemtl name`. Without a name it selects the default material.
    fn set_material(&mut self) {
        let name = self.reader.rest_of_line().bytes;
        self.material = (!name.is_empty()).then(|| {
            let next = self.file.material_names.len() as u32;
            *self.material_indices.entry(name).or_insert_with(|| {
                self.file.material_names.push(name);
                next
            })
        });
    }

    /// Reads `s 1`, `s off` or `s 0`.
    fn set_smoothing(&mut self) {
        self.file.has_smoothing = true;
        let group = self.reader.next_argument().map(|token| match token.bytes {
            b"on" => 1,
            bytes => parse_integer(bytes)
                .map_or(0, |group| group.rem_euclid(i64::from(FLAT_GROUP)) as u32),
        });
        self.smoothing = group.unwrap_or(0);
    }

    /// Returns the state of the next element.
    fn element_state(&mut self, topology: Topology) -> ElementState {
        let group = *self.group.get_or_insert_with(|| {
            let next = self.file.groups.len() as u32;
            *self.group_indices.entry(self.name).or_insert_with(|| {
                self.file.groups.push(self.name);
                next
            })
        });
        ElementState { topology, group, material: self.material, smoothing: self.smoothing }
    }

    /// Reads `f`, `l` or `p`: an element made of vertex references.
    fn read_element(&mut self, offset: usize, topology: Topology) -> Result<(), Diagnostic> {
        self.has_elements = true;
        let start = self.file.elements.corners.len();
        let pending = self.forward.len();
        while let Some(token) = self.reader.next_argument() {
            match self.read_corner(token) {
                Ok(corner) => self.file.elements.corners.push(corner),
                Err(message) => {
                    self.file.elements.corners.truncate(start);
                    self.forward.truncate(pending);
                    return self.leave_out(token.offset, message);
                }
            }
        }
        let count = self.file.elements.corners.len() - start;
        if count < topology.vertices_per_item() {
            self.file.elements.corners.truncate(start);
            self.forward.truncate(pending);
            self.faults.short_elements.count_at(offset);
            return Ok(());
        }
        let state = self.element_state(topology);
        self.file.elements.finish_element(state);
        Ok(())
    }

    /// Reports an element that cannot be read, which is an error except in lenient mode.
    fn leave_out(&mut self, offset: usize, message: String) -> Result<(), Diagnostic> {
        let location = self.lines.locate(offset);
        let help = "export the file again, or load it with --lenient";
        let fault = Diagnostic::error(codes::INVALID_DATA, &location, message, help);
        self.warnings.downgrade_if_lenient(fault, "the element is skipped")
    }

    /// Reads a vertex reference: `p`, `p/t`, `p//n` or `p/t/n`.
    #[inline]
    fn read_corner(&mut self, token: Token<'a>) -> Result<Corner, String> {
        let mut rest = token.bytes;
        let position = take_integer(&mut rest).ok_or_else(|| not_a_reference(token))?;
        let count = self.file.positions.len();
        let position = match resolve_index(position, count) {
            Some(index) if (index as usize) < count => index,
            // A reference to a later vertex is valid if that vertex follows, which `finish` checks.
            Some(index) => {
                self.forward.push((self.file.elements.ends.len(), token.offset, index));
                index
            }
            None => return Err(missing_vertex(&position.to_string(), count)),
        };
        let (mut uv, mut normal) = (NONE, NONE);
        if let [b'/', after @ ..] = rest {
            rest = after;
            if let Some(reference) = take_integer(&mut rest) {
                let index = resolve_index(reference, self.file.uvs.len());
                uv = index.unwrap_or_else(|| self.faults.missing_uvs.count_none(token.offset));
            }
            if let [b'/', after @ ..] = rest {
                rest = after;
                if let Some(reference) = take_integer(&mut rest) {
                    let index = resolve_index(reference, self.file.normals.len());
                    normal = index
                        .unwrap_or_else(|| self.faults.missing_normals.count_none(token.offset));
                }
            }
        }
        if rest.is_empty() {
            Ok(Corner { position, uv, normal })
        } else {
            Err(not_a_reference(token))
        }
    }

    /// Checks forward references, and reports the counted faults.
    fn finish(mut self) -> Result<ObjFile<'a>, Diagnostic> {
        let count = self.file.positions.len();
        for (element, offset, index) in std::mem::take(&mut self.forward) {
            if index as usize >= count {
                self.leave_out(offset, missing_vertex(&(u64::from(index) + 1).to_string(), count))?;
                // Mark the element for the builder, which skips it.
                let start = self.file.elements.corner_range(element).start;
                self.file.elements.corners[start].position = NONE;
            }
        }
        if !self.has_elements {
            self.make_points();
        }
        self.clear_missing_attributes();
        self.faults.report(&mut self.lines, self.warnings);
        Ok(self.file)
    }

    /// Creates a point for every vertex, because a file without elements is a point cloud.
    fn make_points(&mut self) {
        let is_finite = |position: &[f32; 3]| position.iter().all(|x| x.is_finite());
        for at in 0..self.file.positions.len() {
            if is_finite(&self.file.positions[at]) {
                let corner = Corner { position: at as u32, uv: NONE, normal: NONE };
                self.file.elements.corners.push(corner);
                let state = self.element_state(Topology::Points);
                self.file.elements.finish_element(state);
            }
        }
    }

    /// Removes references to texture coordinates and normals that do not exist.
    fn clear_missing_attributes(&mut self) {
        let Self { file, faults, .. } = self;
        let (uvs, normals) = (file.uvs.len() as u32, file.normals.len() as u32);
        for corner in &mut file.elements.corners {
            if corner.uv >= uvs && corner.uv != NONE {
                corner.uv = faults.missing_uvs.count_none(0);
            }
            if corner.normal >= normals && corner.normal != NONE {
                corner.normal = faults.missing_normals.count_none(0);
            }
        }
    }
}

/// Consumes an integer with an optional sign at the beginning of the bytes. Returns `None` if it is
/// missing or has more than 18 digits.
#[inline]
fn take_integer(rest: &mut &[u8]) -> Option<i64> {
    let is_negative = rest.first() == Some(&b'-');
    let signed = is_negative || rest.first() == Some(&b'+');
    let digits = &rest[usize::from(signed)..];
    let (mut value, mut length) = (0_i64, 0);
    while let Some(digit) =
        digits.get(length).map(|byte| byte.wrapping_sub(b'0')).filter(|d| *d <= 9)
    {
        value = value.wrapping_mul(10).wrapping_add(i64::from(digit));
        length += 1;
    }
    if length == 0 || length > 18 {
        return None;
    }
    *rest = &digits[length..];
    Some(if is_negative { -value } else { value })
}

/// Converts a reference (1 for the first item, −1 for the last of `count`) to a zero-based index.
/// Returns `None` if no such item can exist. An item whose index is `count` or more may be defined
/// later.
#[inline]
fn resolve_index(reference: i64, count: usize) -> Option<u32> {
    let index = if reference > 0 { reference - 1 } else { count as i64 + reference };
    let is_relative_and_zero = reference == 0;
    u32::try_from(index).ok().filter(|index| *index != NONE && !is_relative_and_zero)
}

/// Returns the message for a reference to a vertex that does not exist.
fn missing_vertex(reference: &str, count: usize) -> String {
    match (reference, count) {
        ("0", _) => "there is no vertex 0: the first vertex is 1".to_owned(),
        (_, 0) => format!("there is no vertex {reference}: there are none before this line"),
        (_, 1) => format!("there is no vertex {reference}: there is only one before this line"),
        _ => format!("there is no vertex {reference}: there are {count} before this line"),
    }
}

/// Returns the message for a word that is not a vertex reference.
fn not_a_reference(token: Token<'_>) -> String {
    let word: String = token.to_text().chars().take(32).collect();
    format!("{word:?} is not a reference to a vertex such as 1, 1/2, 1//3 or 1/2/3")
}
