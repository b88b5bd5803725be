//! Parts: the nodes of models that have a mesh, with their names, transforms and bounding boxes.

use glam::{DMat3, DVec3};
use homog::{Affine, Bounds, Model as ModelSpace, Point, World};
use model::{MeshInstance, Model, ModelInstance, Primitive, SkinnedPrimitive, Topology};

/// An instance of a node whose mesh has lines or triangles.
#[derive(Clone, Debug)]
pub(crate) struct Part {
    /// The name, on one line; see [`part_name`].
    pub(crate) name: String,
    /// The index of the part's object in drawings of the same models.
    pub(crate) object: u32,
    /// The index of the part's model.
    pub(crate) model: usize,
    /// The node and its transform in the model.
    pub(crate) instance: MeshInstance,
    /// The bounding box in world space.
    pub(crate) bounds: Bounds<World>,
}

/// Returns the parts of models, in the order of their nodes: parents before children.
pub(crate) fn gather_parts(models: &[ModelInstance]) -> Vec<Part> {
    let mut parts = Vec::new();
    let mut object = 0;
    for (number, placed) in models.iter().enumerate() {
        let instances: Vec<MeshInstance> = placed.model.mesh_instances().collect();
        let is_alone = instances.len() == 1;
        for instance in instances {
            if let Some(bounds) = part_bounds(placed, instance) {
                let name = part_name(&placed.model, instance.node, is_alone);
                parts.push(Part { name, object, model: number, instance, bounds });
            }
            object += 1;
        }
    }
    parts
}

/// Returns the primitives of a mesh instance that have lines or triangles.
pub(crate) fn drawn_primitives(
    model: &Model,
    instance: MeshInstance,
) -> impl Iterator<Item = &Primitive> {
    let mesh = model.nodes[instance.node].mesh.and_then(|mesh| model.meshes.get(mesh));
    let primitives = mesh.map_or(&[][..], |mesh| mesh.primitives.as_slice()).iter();
    primitives.filter(|one| one.topology != Topology::Points && one.item_count() > 0)
}

/// Returns the bounding box of all vertices of lines and triangles, or `None` if there are none.
fn part_bounds(placed: &ModelInstance, instance: MeshInstance) -> Option<Bounds<World>> {
    let mut extent: Option<[DVec3; 2]> = None;
    for primitive in drawn_primitives(&placed.model, instance) {
        let skinned = placed.model.skin_primitive(instance, primitive);
        let to_world = skinned.to_model.then(placed.model_to_world);
        let mut is_used = vec![false; skinned.positions.len()];
        primitive.indices.iter().for_each(|&index| is_used[index as usize] = true);
        let used = skinned.positions.iter().zip(is_used).filter(|(_, used)| *used);
        for (position, _) in used {
            let point = to_world.transform_point(position.map(f64::from).into()).raw();
            if point.is_finite() {
                let [low, high] = extent.get_or_insert([point; 2]);
                (*low, *high) = (low.min(point), high.max(point));
            }
        }
    }
    Bounds::from_points(extent?.map(Point::from_raw))
}

impl Part {
    /// Returns the transform from skinned vertex positions to world space.
    pub(crate) fn to_world(
        &self,
        models: &[ModelInstance],
        skinned: &SkinnedPrimitive<'_>,
    ) -> Affine<ModelSpace, World> {
        skinned.to_model.then(models[self.model].model_to_world)
    }

    /// Returns the lengths and angles of the part's axes in world space (the Gram matrix of the
    /// linear map), and whether the part is mirrored.
    pub(crate) fn shape(&self, models: &[ModelInstance]) -> (DMat3, bool) {
        let to_world = self.instance.node_to_model.then(models[self.model].model_to_world).raw();
        let linear = DMat3::from_mat4(to_world);
        (linear.transpose() * linear, linear.determinant() < 0.0)
    }

    /// Whether the part contains lines.
    pub(crate) fn has_lines(&self, models: &[ModelInstance]) -> bool {
        let mut primitives = drawn_primitives(&models[self.model].model, self.instance);
        primitives.any(|primitive| primitive.topology != Topology::Triangles)
    }

    /// Calls `visit` with each triangle of the part, in world space.
    pub(crate) fn for_each_triangle(
        &self,
        models: &[ModelInstance],
        mut visit: impl FnMut([DVec3; 3]),
    ) {
        let model = &models[self.model].model;
        for primitive in drawn_primitives(model, self.instance) {
            if primitive.topology != Topology::Triangles {
                continue;
            }
            let skinned = model.skin_primitive(self.instance, primitive);
            let to_world = self.to_world(models, &skinned);
            let position = |index: u32| {
                let position = skinned.positions[index as usize].map(f64::from);
                to_world.transform_point(position.into()).raw()
            };
            let triangles = primitive.indices.as_chunks::<3>().0;
            triangles.iter().for_each(|triangle| visit(triangle.map(position)));
        }
    }
}

/// Returns the name of a part: the name of its node, its mesh, or the nearest named ancestor. If
/// none of them has a name, returns the model's name if this is its only part, otherwise `part`.
fn part_name(model: &Model, node: usize, is_alone: bool) -> String {
    let own = model.nodes[node].name.as_deref();
    let mesh = || model.nodes[node].mesh.and_then(|mesh| model.meshes[mesh].name.as_deref());
    let candidates = core::iter::once(own).chain(core::iter::once_with(mesh)).flatten();
    if let Some(name) = candidates.map(one_line).find(|name| !name.is_empty()) {
        return name;
    }
    // The importer rejects cycles, but the count bounds the loop in any case.
    let mut above = model.nodes[node].parent;
    for _ in 0..model.nodes.len() {
        let Some(parent) = above.and_then(|parent| model.nodes.get(parent)) else { break };
        let name = parent.name.as_deref().map(one_line).unwrap_or_default();
        if !name.is_empty() {
            return name;
        }
        above = parent.parent;
    }
    let name = one_line(&model.name);
    if is_alone && !name.is_empty() { name } else { "part".to_owned() }
}

/// Removes control characters and direction marks from a string and separates its words with single
/// spaces.
pub(crate) fn one_line(text: &str) -> String {
    let is_mark = |c: char| matches!(c, '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}');
    let plain = |c: char| if c.is_control() || is_mark(c) { ' ' } else { c };
    let plain: String = text.chars().map(plain).collect();
    plain.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use model::{Mesh, Node};

    #[test]
    fn names_are_written_on_one_line() {
        for (text, line) in [
            ("bolt\r\n M8\t\u{202e}x", "bolt M8 x"),
            ("  ", ""),
            ("\u{0}\u{7}", ""),
            ("\u{5d1}\u{5d5}\u{5e8}\u{5d2}", "\u{5d1}\u{5d5}\u{5e8}\u{5d2}"),
        ] {
            assert_eq!(one_line(text), line);
        }
    }

    #[test]
    fn an_unnamed_part_has_the_name_of_its_nearest_named_ancestor() {
        let node = |name: Option<&str>, parent, mesh| Node {
            name: name.map(str::to_owned),
            parent,
            mesh,
            ..Node::default()
        };
        let mut model = Model {
            name: "engine".to_owned(),
            nodes: vec![
                node(Some("wheel"), None, None),
                node(Some(""), Some(0), None),
                node(None, Some(1), Some(0)),
                node(Some("hub"), None, Some(0)),
                node(None, None, Some(0)),
            ],
            meshes: vec![Mesh::default()],
            ..Model::default()
        };
        for (index, alone, name) in
            [(2, false, "wheel"), (3, false, "hub"), (4, false, "part"), (4, true, "engine")]
        {
            assert_eq!(part_name(&model, index, alone), name);
        }
        model.meshes[0].name = Some("rim".to_owned());
        assert_eq!(part_name(&model, 2, false), "rim");
    }
}
