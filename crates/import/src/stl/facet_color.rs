//! Facet colors: the two conventions for the 16 bits after each triangle of a binary file.
//!
//! | program | bits 0–4, 5–9, 10–14 | bit 15 |
//! | --- | --- | --- |
//! | VisCAM, SolidView | blue, green, red | 1: the facet has this color |
//! | Materialise Magics | red, green, blue | 0: the facet has this color; 1: the header's color |
//!
//! A file follows the second convention if its header contains `COLOR=` and four bytes. Other
//! programs write 0 in all facets.

use gltf_import::linear_from_srgb;
use model::{Material, Primitive};
use std::collections::BTreeMap;

/// The code for facets without an individual color.
const DEFAULT_CODE: u16 = 1 << 15;

/// The facet colors of a binary file.
#[derive(Debug, Default)]
pub(super) struct FacetColors {
    /// The color in the header, sRGB encoded, if the file follows the Magics convention.
    header: Option<[u8; 3]>,
    /// The color of each triangle, with red in the upper bits, or [`DEFAULT_CODE`]. Triangles after
    /// the last colored triangle are not listed.
    codes: Vec<u16>,
    /// Whether any facet has a nonzero attribute.
    has_attributes: bool,
}

impl FacetColors {
    /// Detects the convention of a file from its first 80 bytes.
    pub(super) fn from_header(header: &[u8]) -> Self {
        let key = b"COLOR=";
        let at = header.windows(key.len()).position(|window| window == key);
        let color = at.and_then(|at| header.get(at + key.len()..at + key.len() + 4));
        let header = color.and_then(|color| color.first_chunk().copied());
        Self { header, ..Self::default() }
    }

    /// Records the attribute of the triangle that was added last.
    #[inline]
    pub(super) fn record(&mut self, triangle: usize, attribute: u16) {
        if attribute == 0 && self.header.is_none() {
            return;
        }
        self.has_attributes |= attribute != 0;
        let [low, middle, high] = [0, 5, 10].map(|shift| attribute >> shift & 31);
        let own = match self.header {
            Some(_) => (attribute >> 15 == 0).then_some([low, middle, high]),
            None => (attribute >> 15 == 1).then_some([high, middle, low]),
        };
        if let Some([red, green, blue]) = own {
            self.codes.resize(triangle, DEFAULT_CODE);
            self.codes.push(red << 10 | green << 5 | blue);
        }
    }

    /// Sets the vertex colors of a primitive to the colors of its triangles. Vertices shared by
    /// triangles of different colors are split. Without colors, the primitive is unchanged.
    ///
    /// Some programs write a color in the header and 0, the code for black, in all facets. Such
    /// facets get the color in the header.
    pub(super) fn apply_to(mut self, primitive: &mut Primitive) {
        if !self.has_attributes {
            self.codes.clear();
        }
        if self.header.is_none() && self.codes.is_empty() {
            return;
        }
        self.codes.resize(primitive.item_count(), DEFAULT_CODE);
        let codes = split_vertices(primitive, &self.codes);
        primitive.colors = Some(codes.into_iter().map(|code| self.linear_color(code)).collect());
    }

    /// Returns the linear color for a code, with alpha.
    fn linear_color(&self, code: u16) -> [f32; 4] {
        let encoded = match self.header {
            _ if code != DEFAULT_CODE => {
                [10, 5, 0].map(|shift| f32::from(code >> shift & 31) / 31.0)
            }
            Some(header) => header.map(|channel| f32::from(channel) / 255.0),
            None => return Material::plain().base_color,
        };
        let [red, green, blue] = encoded.map(linear_from_srgb);
        [red, green, blue, 1.0]
    }
}

/// Splits vertices shared by triangles with different codes, and returns the code of each vertex.
fn split_vertices(primitive: &mut Primitive, codes: &[u16]) -> Vec<u16> {
    let Primitive { indices, positions, normals, .. } = primitive;
    let mut of_vertex: Vec<Option<u16>> = vec![None; positions.len()];
    let mut copies: BTreeMap<(u32, u16), u32> = BTreeMap::new();
    for (corners, &code) in indices.as_chunks_mut::<3>().0.iter_mut().zip(codes) {
        for corner in corners {
            let vertex = *corner as usize;
            if *of_vertex[vertex].get_or_insert(code) == code {
                continue;
            }
            *corner = *copies.entry((*corner, code)).or_insert_with(|| {
                positions.push(positions[vertex]);
                normals.iter_mut().for_each(|normals| normals.push(normals[vertex]));
                of_vertex.push(Some(code));
                (of_vertex.len() - 1) as u32
            });
        }
    }
    of_vertex.into_iter().map(|code| code.unwrap_or(DEFAULT_CODE)).collect()
}
