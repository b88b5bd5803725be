//! Morph targets: deltas of vertex attributes. Invalid deltas are skipped with a warning.
//!
//! Deltas have the formats of the attributes they change, except that tangents have three
//! components: w, the handedness, does not morph. Deltas of texture coordinates and colors are
//! allowed (glTF 2.0 §3.7.2.2), although few renderers support them.

use super::attribute::{AllowedFormats, AttributeReader, COLOR, POSITION, TEXCOORD};
use gltf::json;
use model::{Diagnostic, MorphTarget};

/// Reads one morph target.
pub(super) struct MorphTargetReader<'r, 'a, 'w> {
    /// The primitive's attribute reader, shared because deltas cover the same range of vertices.
    pub(super) attributes: &'r mut AttributeReader<'a, 'w>,
    /// Location of the morph target.
    pub(super) pointer: String,
    /// Whether to read tangents.
    pub(super) tangents: bool,
}

impl MorphTargetReader<'_, '_, '_> {
    /// Reads the deltas. `further` contains the attributes that the JSON type lacks, by name.
    ///
    /// # Errors
    /// Fails if a limit is exceeded or a file cannot be read. An invalid delta is dropped with a
    /// warning.
    pub(super) fn read_target(
        &mut self,
        json: &json::mesh::MorphTarget,
        further: &[(String, usize)],
    ) -> Result<MorphTarget, Diagnostic> {
        let index = |accessor: Option<json::Index<_>>| accessor.map(|accessor| accessor.value());
        let mut target = MorphTarget {
            positions: self.read_deltas(index(json.positions), "POSITION", &POSITION)?,
            normals: self.read_deltas(index(json.normals), "NORMAL", &POSITION)?,
            ..MorphTarget::default()
        };
        if self.tangents {
            target.tangents = self.read_deltas(index(json.tangents), "TANGENT", &POSITION)?;
        }
        for (name, accessor) in further {
            if name == "COLOR_0" {
                // Deltas with three components do not change alpha.
                target.colors = self.read_deltas(Some(*accessor), name, &COLOR)?;
            }
            let set = name.strip_prefix("TEXCOORD_").and_then(|set| set.parse::<usize>().ok());
            if let Some(set) = set.filter(|&set| set < super::primitive::UV_SETS as usize) {
                target.uvs.resize(target.uvs.len().max(set + 1), None);
                target.uvs[set] = self.read_deltas(Some(*accessor), name, &TEXCOORD)?;
            }
        }
        Ok(target)
    }

    /// Reads the deltas of one attribute if the target has it and it is valid.
    fn read_deltas<const N: usize>(
        &mut self,
        accessor: Option<usize>,
        name: &str,
        format: &AllowedFormats,
    ) -> Result<Option<Vec<[f32; N]>>, Diagnostic> {
        let pointer = format!("{}/{name}", self.pointer);
        self.attributes.read_attribute(accessor, &pointer, format, |source, elements| {
            source.read_floats(&elements)
        })
    }
}
