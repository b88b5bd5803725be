//! Validation of meshes: attributes, indices and morph targets (glTF 2.0 §3.7.2).
//!
//! This module checks the declared names, formats and counts, which does not require buffer data.
//! Rules about the stored values are passed to [`data`](super::data), which reads every accessor
//! once.

use super::codes::{self, DiagnosticCode};
use super::data::{ElementRule, ElementRules};
use super::document::{
    CheckedDocument, array_items, escape_pointer_token, index_member, integer_member,
    object_members,
};
use super::formats::{self, Semantic};
use super::layout::{AccessorLayout, ComponentType};
use super::materials::{self, MaterialRequirements};
use super::usage::{AccessorUse, UsageMap};
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::fmt::Display;

/// Validates all meshes, and records rules for the elements of their accessors.
///
/// All primitives of a mesh must have the same number of morph targets, and `weights` must have one
/// entry per target.
///
/// Renderers blend all primitives of a mesh with the same weights, so the counts must agree. The
/// first primitive sets the expected count, and each primitive that deviates is reported once.
pub(super) fn check_meshes(
    document: &CheckedDocument<'_>,
    usage: &UsageMap<'_>,
    demands: &mut ElementRules,
) {
    let needs = materials::material_requirements(document);
    for (at, mesh) in document.root_array("meshes").iter().enumerate() {
        let primitives = array_items(mesh, "primitives");
        let targets = primitives.first().map_or(0, |first| array_items(first, "targets").len());
        for (part, primitive) in primitives.iter().enumerate() {
            let pointer = format!("/meshes/{at}/primitives/{part}");
            let count = array_items(primitive, "targets").len();
            if count != targets {
                let message = format_args!(
                    "the number of morph targets is {count}, but the first primitive has {targets}"
                );
                let code = &codes::MESH_PRIMITIVES_UNEQUAL_TARGETS_COUNT;
                document.diagnostics.add(code, &pointer, message);
            }
            let (demands, needs) = (&mut *demands, needs.as_slice());
            PrimitiveChecker {
                document,
                usage,
                rules: demands,
                requirements: needs,
                primitive,
                pointer,
            }
            .check_primitive();
        }
        let weights = array_items(mesh, "weights").len();
        if weights != 0 && !primitives.is_empty() && weights != targets {
            let message = format_args!(
                "the number of weights is {weights}, but the number of morph targets is {targets}"
            );
            let pointer = format_args!("/meshes/{at}/weights");
            document.diagnostics.add(&codes::MESH_INVALID_WEIGHTS_COUNT, pointer, message);
        }
    }
}

/// The context for validating one primitive.
struct PrimitiveChecker<'a, 'd> {
    document: &'a CheckedDocument<'a>,
    usage: &'a UsageMap<'a>,
    /// The rules for accessor elements, collected for the pass over the data.
    rules: &'d mut ElementRules,
    /// The vertex attributes that each material requires.
    requirements: &'a [MaterialRequirements],
    /// The JSON of the primitive.
    primitive: &'a Value,
    /// The JSON pointer of the primitive.
    pointer: String,
}

/// A primitive's attributes with existing accessors, as names and the accessors' indices and JSON.
type ResolvedAttributes<'a> = Vec<(&'a str, usize, &'a Value)>;

/// The number of elements of each attribute of a primitive.
///
/// `None` means an accessor without a valid `count`. Morph targets must match these counts: a
/// displacement needs the base attribute, and one value per vertex (glTF 2.0 §3.7.2.2).
type AttributeCounts<'a> = BTreeMap<&'a str, Option<u64>>;

impl<'a> PrimitiveChecker<'a, '_> {
    /// Reports a diagnostic at a member of the primitive, or at the primitive itself.
    fn report(&self, code: &DiagnosticCode, member: &str, message: impl Display) {
        let slash = if member.is_empty() { "" } else { "/" };
        let pointer = format_args!("{}{slash}{member}", self.pointer);
        self.document.diagnostics.add(code, pointer, message);
    }

    /// Validates attributes, indices, mode, material requirements and morph targets, in this order.
    ///
    /// The order follows the dependencies: the attributes determine the number of vertices, which
    /// limits the indices. The number of indices, or of vertices if there are no indices, must fit
    /// the mode.
    fn check_primitive(&mut self) {
        let Some(named) = object_members(self.primitive, "attributes") else {
            self.check_indices(None);
            return;
        };
        let sets = if named.is_empty() { 0 } else { self.check_names(named) };
        let attributes = self.resolve_attributes(named);
        let vertices = self.check_attributes(&attributes);
        let indices = self.check_indices(vertices);
        self.check_mode(indices.or(vertices));
        if let Some(needs) =
            index_member(self.primitive, "material").and_then(|at| self.requirements.get(at))
        {
            let pointer = format!("{}/material", self.pointer);
            needs.check_primitive(
                self.document.diagnostics,
                &pointer,
                sets,
                named.contains_key("TANGENT"),
            );
        }
        let counts = attributes
            .iter()
            .map(|(name, _, json)| (*name, integer_member(json, "count")))
            .collect();
        for (at, target) in array_items(self.primitive, "targets").iter().enumerate() {
            if let Some(target) = target.as_object() {
                self.check_morph_target(at, target, &counts);
            }
        }
    }

    /// Returns the attributes whose accessors exist; the schema walk has reported the others.
    ///
    /// The accessor JSON is looked up once here instead of in each check.
    fn resolve_attributes(&self, named: &'a Map<String, Value>) -> ResolvedAttributes<'a> {
        let accessors = self.document.root_array("accessors");
        let find = |(name, value): (&'a String, &Value)| {
            let at = usize::try_from(super::document::as_whole_number(value)?).ok()?;
            Some((name.as_str(), at, accessors.get(at)?))
        };
        named.iter().filter_map(find).collect()
    }

    /// Validates attribute names and their numbering, and returns the number of `TEXCOORD` sets.
    ///
    /// Sets must be numbered from 0 without gaps, and there must be as many sets of joints as of
    /// weights (glTF 2.0 §3.7.2.1).
    ///
    /// Gaps are an error because renderers stop at the first missing set. The check does not need
    /// to sort the indices: `n` distinct indices are consecutive from 0 if and only if the largest
    /// is `n − 1`.
    fn check_names(&self, named: &Map<String, Value>) -> u64 {
        for name in named.keys().filter(|name| Semantic::from_name(name).is_none()) {
            let message = format_args!("unknown attribute {name:?}");
            let member = format!("attributes/{}", escape_pointer_token(name));
            self.report(&codes::MESH_PRIMITIVE_INVALID_ATTRIBUTE, &member, message);
        }
        if !named.contains_key("POSITION") {
            let message = "missing POSITION: the primitive is not drawn";
            self.report(&codes::MESH_PRIMITIVE_NO_POSITION, "attributes", message);
        }
        if named.contains_key("TANGENT") && !named.contains_key("NORMAL") {
            let message = "TANGENT has no effect without NORMAL";
            self.report(
                &codes::MESH_PRIMITIVE_TANGENT_WITHOUT_NORMAL,
                "attributes/TANGENT",
                message,
            );
        }
        let counts = ["TEXCOORD", "COLOR", "JOINTS", "WEIGHTS"].map(|kind| {
            let numbers = named.keys().filter_map(|name| match Semantic::from_name(name) {
                Some(Semantic::Numbered(found, number)) if found == kind => Some(number),
                _ => None,
            });
            let (count, last) =
                numbers.fold((0, 0), |(count, last), n| (count + 1, u64::from(n).max(last)));
            if count > 0 && last + 1 != count {
                let message = format_args!(
                    "{kind} attributes are not numbered consecutively from 0: the count is {count}, but the last is {kind}_{last}"
                );
                let code = &codes::MESH_PRIMITIVE_INDEXED_SEMANTIC_CONTINUITY;
                self.report(code, &format!("attributes/{kind}_0"), message);
                return 0;
            }
            count
        });
        if counts[2] != counts[3] {
            let message = format_args!(
                "the numbers of JOINTS sets ({}) and WEIGHTS sets ({}) differ",
                counts[2], counts[3]
            );
            self.report(&codes::MESH_PRIMITIVE_JOINTS_WEIGHTS_MISMATCH, "attributes", message);
        }
        counts[0]
    }

    /// Validates the formats and counts of all attributes, and returns the number of vertices.
    ///
    /// The number of vertices is the count of `POSITION`, or of the first attribute if there are no
    /// positions.
    ///
    /// All counts must be equal, because one index selects all attributes of a vertex.
    fn check_attributes(&mut self, attributes: &ResolvedAttributes<'_>) -> Option<u64> {
        let mut vertices = None;
        // POSITION is first, because its count is the number of vertices.
        let position = attributes.iter().find(|(name, ..)| *name == "POSITION");
        for &(name, at, accessor) in position.into_iter().chain(attributes) {
            let member = format!("attributes/{}", escape_pointer_token(name));
            let pointer = format!("{}/{member}", self.pointer);
            self.usage.note_accessor(at, AccessorUse::Attribute, &pointer);
            self.usage.note_vertex_accessor(at, &pointer);
            self.check_format(name, accessor, &member, false);
            if let Some(layout) = AccessorLayout::from_accessor(accessor) {
                self.add_element_rules(name, at, layout, &pointer);
            }
            let count = integer_member(accessor, "count");
            match (vertices, count) {
                (None, count) => vertices = count,
                (Some(vertices), Some(count)) if count != vertices => {
                    let message = format_args!(
                        "the count is {count}, but the number of vertices is {vertices}"
                    );
                    self.report(&codes::MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT, &member, message);
                }
                _ => {}
            }
        }
        vertices
    }

    /// Records rules for the elements of an attribute in a valid format.
    ///
    /// Normals and tangents are unit vectors; float colors are in [0, 1].
    ///
    /// Only float colors can be outside [0, 1]; normalized integers cannot. Values in an invalid
    /// format are not read.
    fn add_element_rules(&mut self, name: &str, at: usize, layout: AccessorLayout, pointer: &str) {
        let quantized = self.document.uses_extension("KHR_mesh_quantization");
        let formats = Semantic::from_name(name)
            .and_then(|semantic| semantic.allowed_formats(false, quantized));
        if !formats.is_some_and(|formats| formats::is_allowed(layout, &formats)) {
            return;
        }
        match name {
            "NORMAL" | "TANGENT" => self.rules.add(at, ElementRule::Unit, pointer),
            "COLOR_0" if layout.component_type == ComponentType::F32 => {
                self.rules.add(at, ElementRule::Clamped, pointer);
            }
            _ => {}
        }
    }

    /// Validates the format, bounds and alignment of an attribute.
    ///
    /// `POSITION` needs `min` and `max`. The offset and stride of vertex data must be multiples of
    /// four bytes (glTF 2.0 §3.7.2.1).
    fn check_format(&self, name: &str, accessor: &Value, member: &str, in_target: bool) {
        let Some(layout) = AccessorLayout::from_accessor(accessor) else { return };
        let has_bounds = accessor.get("min").is_some() && accessor.get("max").is_some();
        if name == "POSITION" && !has_bounds {
            let message = "the POSITION accessor must have min and max";
            self.report(&codes::MESH_PRIMITIVE_POSITION_ACCESSOR_WITHOUT_BOUNDS, member, message);
        }
        let quantized = self.document.uses_extension("KHR_mesh_quantization");
        match Semantic::from_name(name)
            .map(|semantic| semantic.allowed_formats(in_target, quantized))
        {
            Some(Some(formats)) if !formats::is_allowed(layout, &formats) => {
                let message =
                    format_args!("this attribute cannot have the format {}", layout.format_name());
                self.report(
                    &codes::MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT,
                    member,
                    message,
                );
            }
            None | Some(None) if layout.component_type == ComponentType::U32 => {
                let message = "an attribute cannot have the component type UNSIGNED_INT";
                self.report(
                    &codes::MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_UNSIGNED_INT,
                    member,
                    message,
                );
            }
            _ => {}
        }
        let view =
            layout.buffer_view.and_then(|view| self.document.root_array("bufferViews").get(view));
        let stride = match view.map(|view| integer_member(view, "byteStride")) {
            None => 4,
            Some(stride) => stride.unwrap_or(layout.element_size() as u64),
        };
        let is_aligned = stride.is_multiple_of(4);
        if !layout.byte_offset.is_multiple_of(4) || !is_aligned {
            let message = "vertex data must be aligned to 4 bytes";
            self.report(&codes::MESH_PRIMITIVE_ACCESSOR_UNALIGNED, member, message);
        }
    }

    /// Validates the format of the indices, and returns their number.
    ///
    /// Range, restart values and degenerate triangles are checked in the pass over the data.
    fn check_indices(&mut self, vertices: Option<u64>) -> Option<u64> {
        let at = index_member(self.primitive, "indices")?;
        let accessor = self.document.root_array("accessors").get(at)?;
        let pointer = format!("{}/indices", self.pointer);
        self.usage.note_accessor(at, AccessorUse::Indices, &pointer);
        if self.usage.has_stride(at) {
            let message = "byteStride must not be set on the buffer view of indices";
            self.report(
                &codes::MESH_PRIMITIVE_INDICES_ACCESSOR_WITH_BYTESTRIDE,
                "indices",
                message,
            );
        }
        let layout = AccessorLayout::from_accessor(accessor)?;
        if formats::is_allowed(layout, &formats::INDEX_FORMATS) {
            let triangles = integer_member(self.primitive, "mode").unwrap_or(4) == 4;
            let demand = ElementRule::Indices { vertices: vertices.unwrap_or(0), triangles };
            self.rules.add(at, demand, &pointer);
        } else {
            let message = format_args!("indices cannot have the format {}", layout.format_name());
            self.report(&codes::MESH_PRIMITIVE_INDICES_ACCESSOR_INVALID_FORMAT, "indices", message);
        }
        Some(layout.count)
    }

    /// Validates that the vertices or indices form whole primitives of the mode.
    fn check_mode(&self, count: Option<u64>) {
        let Some(count) = count else { return };
        let fits = match integer_member(self.primitive, "mode").unwrap_or(4) {
            1 => count.is_multiple_of(2),
            2 | 3 => count >= 2,
            4 => count.is_multiple_of(3),
            5 | 6 => count >= 3,
            _ => true,
        };
        if !fits {
            let message =
                format_args!("{count} is not a valid number of vertices or indices for this mode");
            self.report(&codes::MESH_PRIMITIVE_INCOMPATIBLE_MODE, "", message);
        }
    }

    /// Validates that the attributes of a morph target can be displaced, exist in the base mesh,
    /// and match its number of elements.
    fn check_morph_target(
        &self,
        at: usize,
        target: &'a Map<String, Value>,
        base: &AttributeCounts<'_>,
    ) {
        for name in target.keys() {
            let is_movable = match Semantic::from_name(name) {
                Some(Semantic::Numbered(kind, _)) => kind == "TEXCOORD" || kind == "COLOR",
                other => other.is_some(),
            };
            if !is_movable {
                let member = format!("targets/{at}/{}", escape_pointer_token(name));
                let message = format_args!("{name:?} cannot be an attribute of a morph target");
                self.report(&codes::MESH_PRIMITIVE_INVALID_ATTRIBUTE, &member, message);
            }
        }
        for (name, accessor, json) in self.resolve_attributes(target) {
            let member = format!("targets/{at}/{}", escape_pointer_token(name));
            let pointer = format!("{}/{member}", self.pointer);
            self.usage.note_accessor(accessor, AccessorUse::Attribute, &pointer);
            self.usage.note_vertex_accessor(accessor, &pointer);
            self.check_format(name, json, &member, true);
            match base.get(name) {
                None => {
                    let message = format_args!("the base mesh has no {name}");
                    let code = &codes::MESH_PRIMITIVE_MORPH_TARGET_NO_BASE_ACCESSOR;
                    self.report(code, &member, message);
                }
                Some(count) if *count != integer_member(json, "count") => {
                    let message = "the base mesh has a different number of elements";
                    let code = &codes::MESH_PRIMITIVE_MORPH_TARGET_INVALID_ATTRIBUTE_COUNT;
                    self.report(code, &member, message);
                }
                Some(_) => {}
            }
        }
    }
}
