//! A glTF 2.0 document while it is being made, and its `.glb` form.
//!
//! Every index that glTF asks for is a small type of its own here, so a mesh cannot be named where
//! a node is due. The bytes depend on nothing but the model: keys are sorted, floats are written by
//! their shortest decimal.

use super::mesh::Mesh;
use super::palette::Color;
use crate::glb::glb;
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

/// How the indices of a primitive are read (glTF 2.0, §3.7.2.1).
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Mode {
    Points = 0,
    Lines = 1,
    LineLoop = 2,
    LineStrip = 3,
    Triangles = 4,
    TriangleStrip = 5,
    TriangleFan = 6,
}

/// A document under construction.
#[derive(Default)]
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
    /// A plain, rough material of one colour.
    pub fn material(&mut self, name: &str, color: Color) -> MaterialId {
        self.material_from(name, json!({ "baseColorFactor": opaque(color) }), json!({}))
    }

    /// A plain material seen from both sides.
    pub fn double_sided(&mut self, name: &str, color: Color) -> MaterialId {
        self.material_from(
            name,
            json!({ "baseColorFactor": opaque(color) }),
            json!({ "doubleSided": true }),
        )
    }

    /// A material that lets what is behind it through, by `alpha` (glTF's BLEND).
    pub fn glass(&mut self, name: &str, color: Color, alpha: f64) -> MaterialId {
        let [r, g, b] = color.linear();
        self.material_from(
            name,
            json!({ "baseColorFactor": [r, g, b, alpha] }),
            json!({ "alphaMode": "BLEND", "doubleSided": true }),
        )
    }

    /// A material with a picture; `others` are further members of the material, such as its alpha
    /// mode.
    pub fn textured(&mut self, name: &str, texture: TextureId, others: Value) -> MaterialId {
        self.material_from(name, json!({ "baseColorTexture": { "index": texture.0 } }), others)
    }

    fn material_from(&mut self, name: &str, mut surface: Value, mut others: Value) -> MaterialId {
        surface["metallicFactor"] = json!(0.0);
        surface["roughnessFactor"] = json!(0.7);
        others["name"] = json!(name);
        others["pbrMetallicRoughness"] = surface;
        self.materials.push(others);
        MaterialId(self.materials.len() - 1)
    }

    /// A material as glTF has it, with all of its members but the name.
    pub fn finish(&mut self, name: &str, mut material: Value) -> MaterialId {
        material["name"] = json!(name);
        self.materials.push(material);
        MaterialId(self.materials.len() - 1)
    }

    /// A PNG picture, smoothly filtered and repeated in both directions.
    pub fn texture(&mut self, name: &str, png: &[u8]) -> TextureId {
        let view = self.buffer_view(png, None);
        let image = push(
            &mut self.images,
            json!({ "bufferView": view, "mimeType": "image/png", "name": name }),
        );
        TextureId(push(&mut self.textures, json!({ "name": name, "sampler": 0, "source": image })))
    }

    /// A mesh of triangles.
    pub fn mesh(&mut self, name: &str, parts: &[(&Mesh, MaterialId)]) -> MeshId {
        let parts: Vec<_> = parts.iter().map(|(mesh, by)| (*mesh, *by, Mode::Triangles)).collect();
        self.mesh_of(name, &parts)
    }

    /// A mesh whose parts say how their indices are read.
    pub fn mesh_of(&mut self, name: &str, parts: &[(&Mesh, MaterialId, Mode)]) -> MeshId {
        let primitives: Vec<Value> =
            parts.iter().map(|(mesh, by, mode)| self.primitive(mesh, *by, *mode)).collect();
        MeshId(push(&mut self.meshes, json!({ "name": name, "primitives": primitives })))
    }

    fn primitive(&mut self, mesh: &Mesh, material: MaterialId, mode: Mode) -> Value {
        let mut attributes = Map::new();
        attributes.insert("POSITION".into(), self.positions(&mesh.positions));
        if !mesh.normals.is_empty() {
            let normals: Vec<u8> =
                mesh.normals.iter().flat_map(|normal| floats(&normal.to_array())).collect();
            attributes
                .insert("NORMAL".into(), self.attribute(&normals, mesh.normals.len(), "VEC3"));
        }
        if !mesh.uvs.is_empty() {
            let uvs: Vec<u8> = mesh.uvs.iter().flat_map(|uv| floats(&uv.to_array())).collect();
            attributes.insert("TEXCOORD_0".into(), self.attribute(&uvs, mesh.uvs.len(), "VEC2"));
        }
        if !mesh.colors.is_empty() {
            attributes.insert("COLOR_0".into(), self.colors(&mesh.colors));
        }
        let mut primitive = json!({ "attributes": attributes, "material": material.0 });
        if mode != Mode::Triangles {
            primitive["mode"] = json!(mode as u32);
        }
        if !mesh.indices.is_empty() {
            primitive["indices"] = self.indices(mesh);
        }
        primitive
    }

    /// Positions are the one attribute that must come with its bounds (glTF 2.0, §3.7.2.1), as the
    /// stored f32 have them.
    fn positions(&mut self, positions: &[DVec3]) -> Value {
        let stored = positions.iter().map(|position| position.as_vec3().as_dvec3());
        let low = stored.clone().fold(DVec3::INFINITY, DVec3::min);
        let high = stored.fold(DVec3::NEG_INFINITY, DVec3::max);
        let bytes: Vec<u8> =
            positions.iter().flat_map(|position| floats(&position.to_array())).collect();
        let accessor = self.attribute(&bytes, positions.len(), "VEC3");
        let last = self.accessors.len() - 1;
        self.accessors[last]["min"] = json!(low.to_array());
        self.accessors[last]["max"] = json!(high.to_array());
        accessor
    }

    fn attribute(&mut self, bytes: &[u8], count: usize, shape: &str) -> Value {
        let view = self.buffer_view(bytes, Some(ARRAY_BUFFER));
        self.accessor(json!({
            "bufferView": view, "componentType": FLOAT, "count": count, "type": shape,
        }))
    }

    /// Sixteen bits a channel: linear light in eight would show bands in the dark.
    fn colors(&mut self, colors: &[[f64; 3]]) -> Value {
        let channels = |color: &[f64; 3]| [color[0], color[1], color[2], 1.0];
        let bytes: Vec<u8> = colors
            .iter()
            .flat_map(channels)
            .flat_map(|channel| (libm::round(channel * 65535.0) as u16).to_le_bytes())
            .collect();
        let view = self.buffer_view(&bytes, Some(ARRAY_BUFFER));
        self.accessor(json!({
            "bufferView": view, "componentType": UNSIGNED_SHORT, "normalized": true,
            "count": colors.len(), "type": "VEC4",
        }))
    }

    /// Sixteen-bit indices where they suffice; 65535 itself is reserved.
    fn indices(&mut self, mesh: &Mesh) -> Value {
        let short = mesh.positions.len() < 65535;
        let bytes: Vec<u8> = if short {
            mesh.indices.iter().flat_map(|index| (*index as u16).to_le_bytes()).collect()
        } else {
            mesh.indices.iter().flat_map(|index| index.to_le_bytes()).collect()
        };
        let view = self.buffer_view(&bytes, Some(ELEMENT_ARRAY_BUFFER));
        self.accessor(json!({
            "bufferView": view, "componentType": if short { UNSIGNED_SHORT } else { UNSIGNED_INT },
            "count": mesh.indices.len(), "type": "SCALAR",
        }))
    }

    fn accessor(&mut self, accessor: Value) -> Value {
        json!(push(&mut self.accessors, accessor))
    }

    fn buffer_view(&mut self, bytes: &[u8], target: Option<u32>) -> usize {
        let offset = self.binary.len();
        self.binary.extend(bytes);
        self.binary.resize(self.binary.len().next_multiple_of(4), 0);
        let mut view = json!({ "buffer": 0, "byteOffset": offset, "byteLength": bytes.len() });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        push(&mut self.buffer_views, view)
    }

    /// A node at the top of the scene. `members` are its transform and whatever else glTF gives to
    /// a node.
    pub fn root(&mut self, name: &str, mesh: Option<MeshId>, members: Value) -> NodeId {
        let node = self.node(name, mesh, members);
        self.roots.push(node.0);
        node
    }

    /// A node below another one.
    pub fn child(
        &mut self,
        of: NodeId,
        name: &str,
        mesh: Option<MeshId>,
        members: Value,
    ) -> NodeId {
        let node = self.node(name, mesh, members);
        match &mut self.nodes[of.0]["children"] {
            Value::Array(children) => children.push(json!(node.0)),
            none => *none = json!([node.0]),
        }
        node
    }

    fn node(&mut self, name: &str, mesh: Option<MeshId>, mut members: Value) -> NodeId {
        members["name"] = json!(name);
        if let Some(mesh) = mesh {
            members["mesh"] = json!(mesh.0);
        }
        NodeId(push(&mut self.nodes, members))
    }

    /// A camera at the top of the scene, at `eye` and turned by the unit quaternion `rotation` (x,
    /// y, z, w); it looks along its own −z. `lens` is the camera as glTF writes it.
    pub fn camera(&mut self, name: &str, lens: Value, eye: [f64; 3], rotation: [f64; 4]) -> NodeId {
        let mut camera = lens;
        camera["name"] = json!(name);
        let camera = push(&mut self.cameras, camera);
        self.root(name, None, json!({ "camera": camera, "translation": eye, "rotation": rotation }))
    }

    /// The whole document as the bytes of a `.glb` file (glTF 2.0, §4.4).
    pub fn into_glb(self) -> Vec<u8> {
        glb(self.json().to_string().as_bytes(), &self.binary)
    }

    fn json(&self) -> Value {
        let mut document = json!({
            "asset": { "version": "2.0", "generator": "cargo xtask models",
                       "copyright": "The Alberti developers, MIT OR Apache-2.0" },
            "scene": 0,
            "scenes": [{ "nodes": self.roots }],
            "buffers": [{ "byteLength": self.binary.len() }],
        });
        // glTF wants a list left out rather than empty.
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
            // Linear between texels and between the sizes of the picture; repeating.
            document["samplers"] =
                json!([{ "magFilter": 9729, "minFilter": 9987, "wrapS": 10497, "wrapT": 10497 }]);
        }
        document
    }
}

/// A rotation by `degrees` about an axis, as glTF's unit quaternion (x, y, z, w).
pub fn turn(axis: DVec3, degrees: f64) -> [f64; 4] {
    let (sine, cosine) = libm::sincos(degrees.to_radians() / 2.0);
    let [x, y, z] = (axis * sine).to_array();
    [x, y, z, cosine]
}

fn push(list: &mut Vec<Value>, value: Value) -> usize {
    list.push(value);
    list.len() - 1
}

fn opaque(color: Color) -> [f64; 4] {
    let [r, g, b] = color.linear();
    [r, g, b, 1.0]
}

fn floats(values: &[f64]) -> Vec<u8> {
    values.iter().flat_map(|value| (*value as f32).to_le_bytes()).collect()
}
