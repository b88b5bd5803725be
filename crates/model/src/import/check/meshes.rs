//! Meshes: their attributes, indices and morph targets (glTF 2.0 §3.7.2).

use super::codes::{self, Code};
use super::data::{Demand, Demands};
use super::document::{Document, escaped, index, integer, items, members};
use super::formats::{self, Semantic};
use super::layout::{Component, Layout};
use super::materials::{self, Needs};
use super::usage::{Usage, Use};
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::fmt::Display;

/// Checks all meshes; notes what is demanded of accessors.
pub(super) fn check(document: &Document<'_>, usage: &Usage<'_>, demands: &mut Demands) {
    let needs = materials::needs(document);
    for (at, mesh) in document.all("meshes").iter().enumerate() {
        let primitives = items(mesh, "primitives");
        let targets = primitives.first().map_or(0, |first| items(first, "targets").len());
        for (part, primitive) in primitives.iter().enumerate() {
            let pointer = format!("/meshes/{at}/primitives/{part}");
            let count = items(primitive, "targets").len();
            if count != targets {
                let message =
                    format_args!("{count} morph targets, and {targets} in the first primitive");
                let code = &codes::MESH_PRIMITIVES_UNEQUAL_TARGETS_COUNT;
                document.findings.add(code, &pointer, message);
            }
            let (demands, needs) = (&mut *demands, needs.as_slice());
            Checker { document, usage, demands, needs, primitive, pointer }.check();
        }
        let weights = items(mesh, "weights").len();
        if weights != 0 && !primitives.is_empty() && weights != targets {
            let message = format_args!("{weights} weights for {targets} morph targets");
            let pointer = format_args!("/meshes/{at}/weights");
            document.findings.add(&codes::MESH_INVALID_WEIGHTS_COUNT, pointer, message);
        }
    }
}

struct Checker<'a, 'd> {
    document: &'a Document<'a>,
    usage: &'a Usage<'a>,
    demands: &'d mut Demands,
    needs: &'a [Needs],
    primitive: &'a Value,
    pointer: String,
}

/// The attributes of a primitive by their names, as far as they are accessors that exist.
type Attributes<'a> = Vec<(&'a str, usize, &'a Value)>;

/// How many elements the attributes of a primitive have.
type Counts<'a> = BTreeMap<&'a str, Option<u64>>;

impl<'a> Checker<'a, '_> {
    fn say(&self, code: &Code, member: &str, message: impl Display) {
        let slash = if member.is_empty() { "" } else { "/" };
        let pointer = format_args!("{}{slash}{member}", self.pointer);
        self.document.findings.add(code, pointer, message);
    }

    fn check(&mut self) {
        let Some(named) = members(self.primitive, "attributes") else {
            self.check_indices(None);
            return;
        };
        let sets = if named.is_empty() { 0 } else { self.check_names(named) };
        let attributes = self.resolved(named);
        let vertices = self.check_attributes(&attributes);
        let indices = self.check_indices(vertices);
        self.check_mode(indices.or(vertices));
        if let Some(needs) = index(self.primitive, "material").and_then(|at| self.needs.get(at)) {
            let pointer = format!("{}/material", self.pointer);
            needs.check(self.document.findings, &pointer, sets, named.contains_key("TANGENT"));
        }
        let counts =
            attributes.iter().map(|(name, _, json)| (*name, integer(json, "count"))).collect();
        for (at, target) in items(self.primitive, "targets").iter().enumerate() {
            if let Some(target) = target.as_object() {
                self.check_target(at, target, &counts);
            }
        }
    }

    fn resolved(&self, named: &'a Map<String, Value>) -> Attributes<'a> {
        let accessors = self.document.all("accessors");
        let find = |(name, value): (&'a String, &Value)| {
            let at = usize::try_from(super::document::whole(value)?).ok()?;
            Some((name.as_str(), at, accessors.get(at)?))
        };
        named.iter().filter_map(find).collect()
    }

    /// Names that glTF knows, numbered without gaps, and fitting each other; gives the number of sets of texture coordinates.
    fn check_names(&self, named: &Map<String, Value>) -> u64 {
        for name in named.keys().filter(|name| Semantic::of(name).is_none()) {
            let message = format_args!("{name:?} is no attribute of glTF");
            let member = format!("attributes/{}", escaped(name));
            self.say(&codes::MESH_PRIMITIVE_INVALID_ATTRIBUTE, &member, message);
        }
        if !named.contains_key("POSITION") {
            let message = "there are no positions; nothing is drawn";
            self.say(&codes::MESH_PRIMITIVE_NO_POSITION, "attributes", message);
        }
        if named.contains_key("TANGENT") && !named.contains_key("NORMAL") {
            let message = "tangents without normals mean nothing";
            self.say(&codes::MESH_PRIMITIVE_TANGENT_WITHOUT_NORMAL, "attributes/TANGENT", message);
        }
        let counts = ["TEXCOORD", "COLOR", "JOINTS", "WEIGHTS"].map(|kind| {
            let numbers = named.keys().filter_map(|name| match Semantic::of(name) {
                Some(Semantic::Numbered(found, number)) if found == kind => Some(number),
                _ => None,
            });
            let (count, last) =
                numbers.fold((0, 0), |(count, last), n| (count + 1, u64::from(n).max(last)));
            if count > 0 && last + 1 != count {
                let message = format_args!(
                    "{count} attributes {kind} go up to number {last}: some are missing"
                );
                let code = &codes::MESH_PRIMITIVE_INDEXED_SEMANTIC_CONTINUITY;
                self.say(code, &format!("attributes/{kind}_0"), message);
                return 0;
            }
            count
        });
        if counts[2] != counts[3] {
            let message = format_args!("{} sets of joints and {} of weights", counts[2], counts[3]);
            self.say(&codes::MESH_PRIMITIVE_JOINTS_WEIGHTS_MISMATCH, "attributes", message);
        }
        counts[0]
    }

    /// The formats of all attributes; gives the number of vertices.
    fn check_attributes(&mut self, attributes: &Attributes<'_>) -> Option<u64> {
        let mut vertices = None;
        // The number of vertices is that of the positions, wherever they stand.
        let position = attributes.iter().find(|(name, ..)| *name == "POSITION");
        for &(name, at, accessor) in position.into_iter().chain(attributes) {
            let member = format!("attributes/{}", escaped(name));
            let pointer = format!("{}/{member}", self.pointer);
            self.usage.accessor(at, Use::Attribute, &pointer);
            self.usage.vertices(at, &pointer);
            self.check_format(name, accessor, &member, false);
            if let Some(layout) = Layout::of(accessor) {
                self.demand(name, at, layout, &pointer);
            }
            let count = integer(accessor, "count");
            match (vertices, count) {
                (None, count) => vertices = count,
                (Some(vertices), Some(count)) if count != vertices => {
                    let message = format_args!("{count} values for {vertices} vertices");
                    self.say(&codes::MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT, &member, message);
                }
                _ => {}
            }
        }
        vertices
    }

    fn demand(&mut self, name: &str, at: usize, layout: Layout, pointer: &str) {
        let quantized = self.document.uses("KHR_mesh_quantization");
        let formats = Semantic::of(name).and_then(|semantic| semantic.formats(false, quantized));
        if !formats.is_some_and(|formats| formats::is_one_of(layout, &formats)) {
            return;
        }
        match name {
            "NORMAL" | "TANGENT" => self.demands.add(at, Demand::Unit, pointer),
            "COLOR_0" if layout.component == Component::F32 => {
                self.demands.add(at, Demand::Clamped, pointer);
            }
            _ => {}
        }
    }

    fn check_format(&self, name: &str, accessor: &Value, member: &str, in_target: bool) {
        let Some(layout) = Layout::of(accessor) else { return };
        let has_bounds = accessor.get("min").is_some() && accessor.get("max").is_some();
        if name == "POSITION" && !has_bounds {
            let message = "the accessor of positions must have min and max";
            self.say(&codes::MESH_PRIMITIVE_POSITION_ACCESSOR_WITHOUT_BOUNDS, member, message);
        }
        let quantized = self.document.uses("KHR_mesh_quantization");
        match Semantic::of(name).map(|semantic| semantic.formats(in_target, quantized)) {
            Some(Some(formats)) if !formats::is_one_of(layout, &formats) => {
                let message = format_args!("it cannot be {}", layout.format());
                self.say(
                    &codes::MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT,
                    member,
                    message,
                );
            }
            None | Some(None) if layout.component == Component::U32 => {
                let message = "no attribute can be of UNSIGNED_INT";
                self.say(&codes::MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_UNSIGNED_INT, member, message);
            }
            _ => {}
        }
        let view = layout.view.and_then(|view| self.document.all("bufferViews").get(view));
        let stride = match view.map(|view| integer(view, "byteStride")) {
            None => 4,
            Some(stride) => stride.unwrap_or(layout.size() as u64),
        };
        let is_aligned = stride.is_multiple_of(4);
        if !layout.offset.is_multiple_of(4) || !is_aligned {
            let message = "the data of vertices must begin at multiples of 4 bytes";
            self.say(&codes::MESH_PRIMITIVE_ACCESSOR_UNALIGNED, member, message);
        }
    }

    /// The format of the indices; gives how many there are.
    fn check_indices(&mut self, vertices: Option<u64>) -> Option<u64> {
        let at = index(self.primitive, "indices")?;
        let accessor = self.document.all("accessors").get(at)?;
        let pointer = format!("{}/indices", self.pointer);
        self.usage.accessor(at, Use::Indices, &pointer);
        if self.usage.has_stride(at) {
            let message = "the view of indices must not have a stride";
            self.say(&codes::MESH_PRIMITIVE_INDICES_ACCESSOR_WITH_BYTESTRIDE, "indices", message);
        }
        let layout = Layout::of(accessor)?;
        if formats::is_one_of(layout, &formats::INDICES) {
            let triangles = integer(self.primitive, "mode").unwrap_or(4) == 4;
            let demand = Demand::Indices { vertices: vertices.unwrap_or(0), triangles };
            self.demands.add(at, demand, &pointer);
        } else {
            let message = format_args!("indices cannot be {}", layout.format());
            self.say(&codes::MESH_PRIMITIVE_INDICES_ACCESSOR_INVALID_FORMAT, "indices", message);
        }
        Some(layout.count)
    }

    fn check_mode(&self, count: Option<u64>) {
        let Some(count) = count else { return };
        let fits = match integer(self.primitive, "mode").unwrap_or(4) {
            1 => count.is_multiple_of(2),
            2 | 3 => count >= 2,
            4 => count.is_multiple_of(3),
            5 | 6 => count >= 3,
            _ => true,
        };
        if !fits {
            let message = format_args!("{count} vertices do not make whole lines or triangles");
            self.say(&codes::MESH_PRIMITIVE_INCOMPATIBLE_MODE, "", message);
        }
    }

    fn check_target(&self, at: usize, target: &'a Map<String, Value>, base: &Counts<'_>) {
        for name in target.keys() {
            let is_movable = match Semantic::of(name) {
                Some(Semantic::Numbered(kind, _)) => kind == "TEXCOORD" || kind == "COLOR",
                other => other.is_some(),
            };
            if !is_movable {
                let member = format!("targets/{at}/{}", escaped(name));
                let message = format_args!("{name:?} is no attribute of a morph target");
                self.say(&codes::MESH_PRIMITIVE_INVALID_ATTRIBUTE, &member, message);
            }
        }
        for (name, accessor, json) in self.resolved(target) {
            let member = format!("targets/{at}/{}", escaped(name));
            let pointer = format!("{}/{member}", self.pointer);
            self.usage.accessor(accessor, Use::Attribute, &pointer);
            self.usage.vertices(accessor, &pointer);
            self.check_format(name, json, &member, true);
            match base.get(name) {
                None => {
                    let message = format_args!("the mesh itself has no {name}");
                    let code = &codes::MESH_PRIMITIVE_MORPH_TARGET_NO_BASE_ACCESSOR;
                    self.say(code, &member, message);
                }
                Some(count) if *count != integer(json, "count") => {
                    let message = "it has not as many elements as the mesh itself";
                    let code = &codes::MESH_PRIMITIVE_MORPH_TARGET_INVALID_ATTRIBUTE_COUNT;
                    self.say(code, &member, message);
                }
                Some(_) => {}
            }
        }
    }
}
