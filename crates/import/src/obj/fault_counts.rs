//! Counts errors that do not affect the shape of a model. Each kind is reported once, with the
//! location of the first occurrence.

use super::elements::NONE;
use crate::text::LineCounter;
use gltf_import::ImportWarnings;
use std::collections::BTreeMap;

/// Maximum number of different statements that warnings name.
const MAX_NAMED_STATEMENTS: usize = 16;

/// The number of occurrences of each kind of error.
#[derive(Default)]
pub(super) struct FaultCounts<'a> {
    /// Elements with too few vertices.
    pub(super) short_elements: Occurrences,
    /// References to texture coordinates that do not exist.
    pub(super) missing_uvs: Occurrences,
    /// References to normals that do not exist.
    pub(super) missing_normals: Occurrences,
    /// Texture coordinates that are not numbers.
    pub(super) broken_uvs: Occurrences,
    /// Statements that are not read, by name.
    statements: BTreeMap<&'a [u8], Occurrences>,
    /// Other statements, beyond [`MAX_NAMED_STATEMENTS`].
    further_statements: Occurrences,
}

/// The number of occurrences, and the offset of the first, or 0 if it has no location.
#[derive(Clone, Copy, Default)]
pub(super) struct Occurrences {
    count: usize,
    first: usize,
}

impl Occurrences {
    /// Counts one occurrence.
    pub(super) fn count_at(&mut self, offset: usize) {
        if self.count == 0 {
            self.first = offset;
        }
        self.count += 1;
    }

    /// Counts a reference to an attribute that does not exist, and returns [`NONE`].
    pub(super) fn count_none(&mut self, offset: usize) -> u32 {
        self.count_at(offset);
        NONE
    }
}

impl<'a> FaultCounts<'a> {
    /// Counts a statement that is not read.
    pub(super) fn count_statement(&mut self, name: &'a [u8], offset: usize) {
        if self.statements.len() < MAX_NAMED_STATEMENTS || self.statements.contains_key(name) {
            self.statements.entry(name).or_default().count_at(offset);
        } else {
            self.further_statements.count_at(offset);
        }
    }

    /// Adds one warning for each kind, in file order.
    pub(super) fn report(&self, lines: &mut LineCounter<'_>, warnings: &mut ImportWarnings) {
        let kinds = [
            (
                self.short_elements,
                "an element with too few vertices is skipped",
                "elements with too few vertices are skipped",
            ),
            (
                self.missing_uvs,
                "a reference to missing texture coordinates is ignored",
                "references to missing texture coordinates are ignored",
            ),
            (
                self.missing_normals,
                "a reference to a missing normal is replaced by a computed normal",
                "references to missing normals are replaced by computed normals",
            ),
            (
                self.broken_uvs,
                "a texture coordinate that is not a number is set to 0",
                "texture coordinates that are not numbers are set to 0",
            ),
            (
                self.further_statements,
                "one more statement is ignored",
                "more statements are ignored",
            ),
        ];
        let told = kinds.map(|(fault, one, many)| match fault.count {
            1 => (fault, one.to_owned()),
            count => (fault, format!("{count} {many}")),
        });
        let mut told = told.to_vec();
        for (name, fault) in &self.statements {
            // The name of a statement may consist of any bytes.
            let name: String = String::from_utf8_lossy(name).chars().take(32).collect();
            let message = match fault.count {
                1 => format!("a {name:?} statement is ignored"),
                count => format!("{count} {name:?} statements are ignored"),
            };
            told.push((*fault, message));
        }
        told.retain(|(fault, _)| fault.count > 0);
        told.sort_by_key(|(fault, _)| fault.first);
        for (fault, message) in told {
            let location = match fault.first {
                0 => String::new(),
                first => lines.locate(first),
            };
            warnings.push_warning(&location, message);
        }
    }
}
