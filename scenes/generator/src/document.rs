//! A glTF 2.0 document under construction, and its binary container.
//!
//! Each kind of index has a separate type, so that a mesh index cannot be used for a node. The
//! bytes depend only on the model: JSON keys are sorted, and floats are written as their shortest
//! decimals.

use crate::glb::encode_glb;
use crate::mesh::Mesh;
use crate::palette::Color;
use glam::DVec3;
use serde_json::{Map, Value, json};
use std::collections::BTreeSet;

/// Index of a mesh in the document.
#[derive(Clone, Copy, Debug)]
pub struct MeshId(usize);
/// Index of a node in the document.
#[derive(Clone, Copy, Debug)]
pub struct NodeId(usize);
/// Index of a material in the document.
#[derive(Clone, Copy, Debug)]
pub struct MaterialId(usize);
/// Index of a texture in the document.
#[derive(Clone, Copy, Debug)]
pub struct TextureId(usize);

/// The interpretation of a primitive's indices (glTF 2.0, §3.7.2.1).
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum PrimitiveMode {
    /// One point per index.
    Points = 0,
    /// One segment per pair of indices.
    Lines = 1,
    /// A closed polyline.
    LineLoop = 2,
    /// An open polyline.
    LineStrip = 3,
    /// One triangle per three indices.
    Triangles = 4,
    /// Each index after the second forms a triangle with the two preceding indices.
    TriangleStrip = 5,
    /// Each index after the second forms a triangle with the preceding index and the first.
    TriangleFan = 6,
}

/// A document under construction.
#[derive(Default, Debug)]
pub struct Document {
    binary: Vec<u8>,
    buffer_views: Vec<Value>,
    accessors: Vec<Value>,
    images: Vec<Value>,
    textures: Vec<Value>,
    materials: Vec<Value>,
    meshes: Vec<Value>,
    cameras: Vec<Value>,
    nodes: Vec<Value>,
    roots: Vec<usize>,
}

const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;
const UNSIGNED_SHORT: u32 = 5123;
const UNSIGNED_INT: u32 = 5125;
const FLOAT: u32 = 5126;

impl Document {
    /// Adds a rough dielectric of one color.
    pub fn add_material(&mut self, name: &str, color: Color) -> MaterialId {
        self.add_surface(name, json!({ "baseColorFactor": opaque_factor(color) }), json!({}))
    }

    /// Adds a rough, double-sided dielectric of one color.
    pub fn add_double_sided(&mut self, name: &str, color: Color) -> MaterialId {
        self.add_surface(
            name,
            json!({ "baseColorFactor": opaque_factor(color) }),
            json!({ "doubleSided": true }),
        )
    }

    /// Adds a transparent, double-sided material with alpha mode BLEND.
    pub fn add_glass(&mut self, name: &str, color: Color, alpha: f64) -> MaterialId {
        let [r, g, b] = color.linear();
        self.add_surface(
            name,
            json!({ "baseColorFactor": [r, g, b, alpha] }),
            json!({ "alphaMode": "BLEND", "doubleSided": true }),
        )
    }

    /// Adds a material with a base color texture; `others` contains further members of the
    /// material, such as its alpha mode.
    pub fn add_textured(&mut self, name: &str, texture: TextureId, others: Value) -> MaterialId {
        self.add_surface(name, json!({ "baseColorTexture": { "index": texture.0 } }), others)
    }

    fn add_surface(&mut self, name: &str, mut surface: Value, mut others: Value) -> MaterialId {
        surface["metallicFactor"] = json!(0.0);
        surface["roughnessFactor"] = json!(0.7);
        others["name"] = json!(name);
        others["pbrMetallicRoughness"] = surface;
        self.materials.push(others);
        MaterialId(self.materials.len() - 1)
    }

    /// Adds a material with a name and other glTF members.
    pub fn add_finish(&mut self, name: &str, mut material: Value) -> MaterialId {
        material["name"] = json!(name);
        self.materials.push(material);
        MaterialId(self.materials.len() - 1)
    }

    /// Adds a texture from the bytes of a PNG, filtered trilinearly and repeated in both
    /// directions.
    pub fn add_texture(&mut self, name: &str, png: &[u8]) -> TextureId {
        let view = self.add_buffer_view(png, None);
        let image = push_index(
            &mut self.images,
            json!({ "bufferView": view, "mimeType": "image/png", "name": name }),
        );
        TextureId(push_index(
            &mut self.textures,
            json!({ "name": name, "sampler": 0, "source": image }),
        ))
    }

    /// Adds a mesh of triangles.
    pub fn add_mesh(&mut self, name: &str, parts: &[(&Mesh, MaterialId)]) -> MeshId {
        let parts: Vec<_> =
            parts.iter().map(|(mesh, by)| (*mesh, *by, PrimitiveMode::Triangles)).collect();
        self.add_mesh_of_modes(name, &parts)
    }

    /// Adds a mesh whose parts each have a primitive mode.
    pub fn add_mesh_of_modes(
        &mut self,
        name: &str,
        parts: &[(&Mesh, MaterialId, PrimitiveMode)],
    ) -> MeshId {
        let primitives: Vec<Value> =
            parts.iter().map(|(mesh, by, mode)| self.primitive_json(mesh, *by, *mode)).collect();
        MeshId(push_index(&mut self.meshes, json!({ "name": name, "primitives": primitives })))
    }

    fn primitive_json(&mut self, mesh: &Mesh, material: MaterialId, mode: PrimitiveMode) -> Value {
        let mut attributes = Map::new();
        attributes.insert("POSITION".into(), self.add_positions(&mesh.positions));
        if !mesh.normals.is_empty() {
            let normals: Vec<u8> =
                mesh.normals.iter().flat_map(|normal| float_bytes(&normal.to_array())).collect();
            attributes
                .insert("NORMAL".into(), self.add_attribute(&normals, mesh.normals.len(), "VEC3"));
        }
        if !mesh.uvs.is_empty() {
            let uvs: Vec<u8> = mesh.uvs.iter().flat_map(|uv| float_bytes(&uv.to_array())).collect();
            attributes
                .insert("TEXCOORD_0".into(), self.add_attribute(&uvs, mesh.uvs.len(), "VEC2"));
        }
        if !mesh.colors.is_empty() {
            attributes.insert("COLOR_0".into(), self.add_colors(&mesh.colors));
        }
        let mut primitive = json!({ "attributes": attributes, "material": material.0 });
        if mode != PrimitiveMode::Triangles {
            primitive["mode"] = json!(mode as u32);
        }
        if !mesh.indices.is_empty() {
            primitive["indices"] = self.add_indices(mesh);
        }
        primitive
    }

    /// Adds positions, the only attribute that must have bounds (glTF 2.0, §3.7.2.1). The bounds
    /// are computed from the stored f32 values.
    fn add_positions(&mut self, positions: &[DVec3]) -> Value {
        let stored = positions.iter().map(|position| position.as_vec3().as_dvec3());
        let low = stored.clone().fold(DVec3::INFINITY, DVec3::min);
        let high = stored.fold(DVec3::NEG_INFINITY, DVec3::max);
        let bytes: Vec<u8> =
            positions.iter().flat_map(|position| float_bytes(&position.to_array())).collect();
        let accessor = self.add_attribute(&bytes, positions.len(), "VEC3");
        let last = self.accessors.len() - 1;
        self.accessors[last]["min"] = json!(low.to_array());
        self.accessors[last]["max"] = json!(high.to_array());
        accessor
    }

    fn add_attribute(&mut self, bytes: &[u8], count: usize, shape: &str) -> Value {
        let view = self.add_buffer_view(bytes, Some(ARRAY_BUFFER));
        self.add_accessor(json!({
            "bufferView": view, "componentType": FLOAT, "count": count, "type": shape,
        }))
    }

    /// Adds vertex colors in 16 bits, because linear light in 8 bits would show banding in dark
    /// areas.
    fn add_colors(&mut self, colors: &[[f64; 3]]) -> Value {
        let channels = |color: &[f64; 3]| [color[0], color[1], color[2], 1.0];
        let bytes: Vec<u8> = colors
            .iter()
            .flat_map(channels)
            .flat_map(|channel| (libm::round(channel * 65535.0) as u16).to_le_bytes())
            .collect();
        let view = self.add_buffer_view(&bytes, Some(ARRAY_BUFFER));
        self.add_accessor(json!({
            "bufferView": view, "componentType": UNSIGNED_SHORT, "normalized": true,
            "count": colors.len(), "type": "VEC4",
        }))
    }

    /// Adds indices, in 16 bits if that suffices; 65535 is the primitive restart value.
    fn add_indices(&mut self, mesh: &Mesh) -> Value {
        let short = mesh.positions.len() < 65535;
        let bytes: Vec<u8> = if short {
            mesh.indices.iter().flat_map(|index| (*index as u16).to_le_bytes()).collect()
        } else {
            mesh.indices.iter().flat_map(|index| index.to_le_bytes()).collect()
        };
        let view = self.add_buffer_view(&bytes, Some(ELEMENT_ARRAY_BUFFER));
        self.add_accessor(json!({
            "bufferView": view, "componentType": if short { UNSIGNED_SHORT } else { UNSIGNED_INT },
            "count": mesh.indices.len(), "type": "SCALAR",
        }))
    }

    fn add_accessor(&mut self, accessor: Value) -> Value {
        json!(push_index(&mut self.accessors, accessor))
    }

    fn add_buffer_view(&mut self, bytes: &[u8], target: Option<u32>) -> usize {
        let offset = self.binary.len();
        self.binary.extend(bytes);
        self.binary.resize(self.binary.len().next_multiple_of(4), 0);
        let mut view = json!({ "buffer": 0, "byteOffset": offset, "byteLength": bytes.len() });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        push_index(&mut self.buffer_views, view)
    }

    /// Adds a root node to the scene. `members` contains its transform and other members of a glTF
    /// node.
    pub fn add_root(&mut self, name: &str, mesh: Option<MeshId>, members: Value) -> NodeId {
        let node = self.add_node(name, mesh, members);
        self.roots.push(node.0);
        node
    }

    /// Adds a child to another node.
    pub fn add_child(
        &mut self,
        of: NodeId,
        name: &str,
        mesh: Option<MeshId>,
        members: Value,
    ) -> NodeId {
        let node = self.add_node(name, mesh, members);
        match &mut self.nodes[of.0]["children"] {
            Value::Array(children) => children.push(json!(node.0)),
            none => *none = json!([node.0]),
        }
        node
    }

    fn add_node(&mut self, name: &str, mesh: Option<MeshId>, mut members: Value) -> NodeId {
        members["name"] = json!(name);
        if let Some(mesh) = mesh {
            members["mesh"] = json!(mesh.0);
        }
        NodeId(push_index(&mut self.nodes, members))
    }

    /// Adds a root node with a camera at `eye`, rotated by the unit quaternion `rotation` (x, y, z,
    /// w); it looks along its −z axis. `lens` is the glTF camera object.
    pub fn add_camera(
        &mut self,
        name: &str,
        lens: Value,
        eye: [f64; 3],
        rotation: [f64; 4],
    ) -> NodeId {
        let mut camera = lens;
        camera["name"] = json!(name);
        let camera = push_index(&mut self.cameras, camera);
        self.add_root(
            name,
            None,
            json!({ "camera": camera, "translation": eye, "rotation": rotation }),
        )
    }

    /// Returns the bytes of a `.glb` file (glTF 2.0, §4.4).
    pub fn into_glb(self) -> Vec<u8> {
        encode_glb(self.to_json().to_string().as_bytes(), &self.binary)
    }

    fn to_json(&self) -> Value {
        let mut document = json!({
            "asset": { "version": "2.0", "generator": "cargo xtask models",
                       "copyright": "The Alberti developers, MIT OR Apache-2.0" },
            "scene": 0,
            "scenes": [{ "nodes": self.roots }],
            "buffers": [{ "byteLength": self.binary.len() }],
        });
        // glTF forbids empty lists, so they are omitted.
        for (key, list) in [
            ("bufferViews", &self.buffer_views),
            ("accessors", &self.accessors),
            ("images", &self.images),
            ("textures", &self.textures),
            ("materials", &self.materials),
            ("meshes", &self.meshes),
            ("cameras", &self.cameras),
            ("nodes", &self.nodes),
        ] {
            if !list.is_empty() {
                document[key] = json!(list);
            }
        }
        let extensions =
            self.materials.iter().filter_map(|material| material["extensions"].as_object());
        let names: BTreeSet<&String> = extensions.flat_map(|all| all.keys()).collect();
        if !names.is_empty() {
            document["extensionsUsed"] = json!(names);
        }
        if !self.textures.is_empty() {
            // LINEAR, LINEAR_MIPMAP_LINEAR, REPEAT.
            document["samplers"] =
                json!([{ "magFilter": 9729, "minFilter": 9987, "wrapS": 10497, "wrapT": 10497 }]);
        }
        document
    }
}

/// Returns a rotation by `degrees` about an axis as glTF's unit quaternion (x, y, z, w).
pub fn rotation_quaternion(axis: DVec3, degrees: f64) -> [f64; 4] {
    let (sine, cosine) = libm::sincos(degrees.to_radians() / 2.0);
    let [x, y, z] = (axis * sine).to_array();
    [x, y, z, cosine]
}

fn push_index(list: &mut Vec<Value>, value: Value) -> usize {
    list.push(value);
    list.len() - 1
}

fn opaque_factor(color: Color) -> [f64; 4] {
    let [r, g, b] = color.linear();
    [r, g, b, 1.0]
}

fn float_bytes(values: &[f64]) -> Vec<u8> {
    values.iter().flat_map(|value| (*value as f32).to_le_bytes()).collect()
}
