//! The package of a 3MF file (Open Packaging Conventions): parts in a zip archive, and the
//! relationship that identifies the model.

use super::archive::{Archive, Entry};
use super::xml::{Element, XmlReader};
use crate::text::decode_text;
use gltf_import::ImportWarnings;
use gltf_import::Limits;
use gltf_import::MemoryBudget;
use gltf_import::percent_decode;
use model::{Diagnostic, codes};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// The end of the relationship type for the model. The rest varies, because it contains a year.
const MODEL_RELATIONSHIP: &str = "/3dmodel";

/// The parts of a 3MF file.
#[derive(Debug)]
pub(super) struct Package<'a> {
    archive: Archive<'a>,
    /// Archive entries by lowercase name, because OPC ignores case.
    parts: BTreeMap<String, usize>,
    budget: MemoryBudget<'a>,
}

impl<'a> Package<'a> {
    /// Opens the package in an archive.
    ///
    /// # Errors
    /// Fails if the archive is broken or two parts have the same name. In lenient mode, the first
    /// of the two is used.
    pub(super) fn from_bytes(
        bytes: &'a [u8],
        limits: &'a Limits,
        warnings: &mut ImportWarnings,
    ) -> Result<Self, Diagnostic> {
        let archive = Archive::from_bytes(bytes)?;
        let mut parts = BTreeMap::new();
        for (at, entry) in archive.entries.iter().enumerate() {
            if !is_part_name(&entry.name) {
                let message = "the name points outside the archive; the entry is skipped";
                warnings.push_warning(&entry.name, message);
            } else if *parts.entry(entry.name.to_ascii_lowercase()).or_insert(at) != at {
                let fault =
                    Diagnostic::invalid(&entry.name, "the archive has two entries with this name");
                warnings.downgrade_if_lenient(fault, "the first is used")?;
            }
        }
        Ok(Self { archive, parts, budget: MemoryBudget::new(limits) })
    }

    /// Finds the entry of a part by name, with or without a leading `/`, escaped or not.
    fn find_part(&self, name: &str) -> Option<&Entry> {
        let name = name.trim_start_matches('/').to_ascii_lowercase();
        let at = self.parts.get(&name).or_else(|| self.parts.get(&percent_decode(&name)?));
        at.and_then(|&at| self.archive.entries.get(at))
    }

    /// Returns the name of a part as stored in the archive, if it exists.
    pub(super) fn part_name(&self, name: &str) -> Option<&str> {
        self.find_part(name).map(|entry| entry.name.as_str())
    }

    /// Reads the content of a part. `location` is where the file refers to the part.
    ///
    /// # Errors
    /// Fails if there is no such part, or it cannot be read.
    pub(super) fn read_part(
        &self,
        name: &str,
        location: &str,
    ) -> Result<Cow<'a, [u8]>, Diagnostic> {
        let Some(entry) = self.find_part(name) else {
            let message = format!("the archive has no entry {name:?}");
            let help = "export the file again";
            return Err(Diagnostic::error(codes::MISSING_DATA, location, message, help));
        };
        self.archive.read_entry(entry, &self.budget)
    }

    /// Charges memory for data derived from the file, in addition to its parts.
    ///
    /// # Errors
    /// Fails if a limit is exceeded.
    pub(super) fn charge_bytes(&self, location: &str, bytes: u64) -> Result<(), Diagnostic> {
        self.budget.charge_bytes(location, bytes, self.archive.byte_count())
    }

    /// Returns the name of the model part: the target of the package's relationship, or else the
    /// only part with a model file name.
    ///
    /// # Errors
    /// Fails if there is no model part, which means that the archive is not a 3MF file.
    pub(super) fn model_part(&self, warnings: &mut ImportWarnings) -> Result<String, Diagnostic> {
        const RELATIONSHIPS: &str = "_rels/.rels";
        if self.part_name(RELATIONSHIPS).is_some() {
            let content = self.read_part(RELATIONSHIPS, "")?;
            match find_model_target(&decode_text(&content)) {
                Ok(Some(target)) if self.part_name(&target).is_some() => return Ok(target),
                Ok(_) => {}
                Err(fault) => warnings.downgrade_if_lenient(fault, "it is skipped")?,
            }
        }
        let mut models = self.archive.entries.iter().map(|entry| entry.name.as_str()).filter(|n| {
            let name = n.to_ascii_lowercase();
            name == "3d/3dmodel.model" || name.ends_with(".model") && !name.contains("/objects/")
        });
        let Some(model) = models.next() else {
            let message = "this zip archive is not a 3MF file: no relationship leads to a 3D model";
            let help = "use a .gltf, .glb, .stl, .obj, .ply or .3mf file";
            return Err(Diagnostic::error(codes::UNKNOWN_FORMAT, RELATIONSHIPS, message, help));
        };
        let message = format!("no relationship leads to a 3D model; {model} is used");
        warnings.push_warning(RELATIONSHIPS, message);
        Ok(model.to_owned())
    }
}

/// Returns whether a name is relative and without `..`, so that it stays within the archive.
fn is_part_name(name: &str) -> bool {
    !name.starts_with('/') && !name.contains([':', '\0']) && name.split('/').all(|s| s != "..")
}

/// Finds the target of the first relationship to a model.
fn find_model_target(text: &[u8]) -> Result<Option<String>, Diagnostic> {
    let mut reader = XmlReader::new(text, "_rels/.rels");
    let Some(_) = reader.next_child(0)? else { return Ok(None) };
    let is_model = |element: &Element<'_>| {
        let kind = element.attribute("Type").unwrap_or_default();
        kind.to_ascii_lowercase().ends_with(MODEL_RELATIONSHIP.as_bytes())
    };
    while let Some(relationship) = reader.next_child(1)? {
        if is_model(&relationship) {
            return Ok(relationship.text_attribute("Target"));
        }
    }
    Ok(None)
}
