//! Explains why a node's mesh is visible or not, from the stages that could remove it.
//!
//! ```text
//!  tree ─► model transform ─► outcodes (trivial reject) ─► back-face test ─► alpha ─► visible
//!            not in a scene       outside of a plane         away, edge-on     transparent
//! ```
//! A primitive is counted at the first stage that removes it. If one stage removes everything, the
//! verdict names that stage and a remedy.
//!
//! The stages follow pipeline order, so the count of a later stage excludes everything that an
//! earlier one removed. Counts are exact integers; the percentage in the verdict is the only
//! rounded number.

use super::plain_text::format_number;
use super::point::{describe_node, model_point};
use super::transform_chain::{TransformChain, describe_outcode};
use super::{Explanation, Step};
use clip::{Outcode, PlaneIndex};
use glam::DVec3;
use homog::{Clip, HPoint, Point, World};
use model::ModelInstance;
use model::{AlphaMode, MeshInstance, Model, Primitive, Topology};

/// Counts the primitives of a node's mesh by the stage that removes them: view volume, back-face
/// culling or transparency.
///
/// Occlusion by other surfaces is not tested: it comes after all of these stages.
///
/// The cost is O(vertices + primitives) of the node's mesh, for each of its instances. Only the
/// node's own mesh is examined, not its children's. Skinned meshes are posed first, so the bounds
/// match the current pose.
#[must_use]
pub fn explain_node(
    chain: &TransformChain,
    model_instance: &ModelInstance,
    node: usize,
) -> Explanation {
    let model = &model_instance.model;
    let subject = describe_node(model, node);
    let mut steps = vec![tree_step(model, node)];
    let instances: Vec<MeshInstance> =
        model.mesh_instances().filter(|at| at.node == node).collect();
    if instances.is_empty() {
        return Explanation { subject, steps, verdict: explain_absence(model, node) };
    }
    let mut counts = PrimitiveCounts::default();
    for &instance in &instances {
        let mesh = model.nodes[node].mesh.and_then(|mesh| model.meshes.get(mesh));
        for primitive in mesh.into_iter().flat_map(|mesh| &mesh.primitives) {
            counts.count_primitive(chain, model_instance, instance, primitive);
        }
    }
    steps.push(counts.bounds_step());
    steps.push(counts.count_step());
    Explanation { subject, steps, verdict: counts.verdict() }
}

/// Returns the step with the path from the root to the node.
///
/// Follows the parent indices to the root and prints the path from there. The matrix is the
/// accumulated node-to-model transform, the product of the local TRS matrices along this path.
fn tree_step(model: &Model, node: usize) -> Step {
    let mut path = Vec::new();
    let mut above = Some(node);
    // The importer rejects cycles, so this loop terminates.
    while let Some(at) = above {
        path.push(describe_node(model, at));
        above = model.nodes.get(at).and_then(|node| node.parent);
    }
    path.reverse();
    let here = model.nodes.get(node);
    let mesh = here.and_then(|node| node.mesh).and_then(|mesh| model.meshes.get(mesh));
    let mesh = mesh.map_or("none".to_owned(), |mesh| {
        let name = mesh.name.as_deref().unwrap_or("unnamed");
        let count = mesh.primitives.len();
        format!("{name}, {count} {}", if count == 1 { "primitive" } else { "primitives" })
    });
    let step = Step::new("tree", "The node in its model", None)
        .with_item("path", "from the root", path.join(" › "))
        .with_item("mesh", "mesh", mesh);
    match here {
        Some(node) => step.with_item("node_to_model", "node to model", node.to_model.rows()),
        None => step,
    }
}

/// Explains why a node has no visible mesh.
///
/// The index is out of range, the node has no mesh (a group, joint, light or camera), or the mesh
/// is outside the drawn scene or has no instances.
fn explain_absence(model: &Model, node: usize) -> String {
    match model.nodes.get(node) {
        None => "The node does not exist.".to_owned(),
        Some(here) if here.mesh.is_none() => {
            let below = here.children.len();
            format!("It has no mesh. Child nodes: {below}.")
        }
        Some(_) if !model.node_instances().iter().any(|at| at.node == node) => {
            "It is not part of the scene that is drawn.".to_owned()
        }
        Some(_) => "Its mesh has no instances.".to_owned(),
    }
}

/// The number of points, lines and triangles by the stage that removes them.
#[derive(Default)]
struct PrimitiveCounts {
    /// The minimum and maximum corners of the bounding box in world space; `None` without vertices.
    bounds: Option<[DVec3; 2]>,
    /// The view volume planes that all vertices are outside of: the AND of all outcodes. Each of
    /// these planes rejects the whole mesh, which suggests the simplest remedy.
    common_outcode: Option<Outcode>,
    /// All points, lines and triangles of the node's mesh.
    total: usize,
    /// Trivially rejected primitives, by the first of the six planes that rejects them.
    outside: [usize; 6],
    /// Back faces culled because their material is single-sided.
    back_facing: usize,
    /// Triangles seen edge-on, without area on the screen.
    edge_on: usize,
    /// Primitives blended with alpha 0.
    transparent: usize,
    /// Primitives that no stage removes.
    visible: usize,
}

impl PrimitiveCounts {
    /// Counts all points, lines and triangles of a primitive.
    ///
    /// Positions are skinned, mapped to world and clip space in f64, and assembled by topology. A
    /// negative determinant of the transform mirrors the mesh: triangles that were counterclockwise
    /// appear clockwise, so the opposite side is culled, as the glTF specification requires.
    fn count_primitive(
        &mut self,
        chain: &TransformChain,
        model_instance: &ModelInstance,
        instance: MeshInstance,
        primitive: &Primitive,
    ) {
        let skinned = model_instance.model.skin_primitive(instance, primitive);
        let to_world = skinned.to_model.then(model_instance.model_to_world);
        let world: Vec<Point<World>> =
            skinned.positions.iter().map(|&at| to_world.transform_point(model_point(at))).collect();
        let clip: Vec<HPoint<Clip>> =
            world.iter().map(|&at| chain.world_to_clip().transform_point(at)).collect();
        let material = primitive.material.and_then(|at| model_instance.model.materials.get(at));
        let is_single_sided = material.is_none_or(|material| !material.double_sided);
        let is_transparent = material.is_some_and(|material| {
            material.alpha_mode == AlphaMode::Blend && material.base_color[3] == 0.0
        });
        let is_mirrored = to_world.raw().determinant() < 0.0;
        for item in primitive.indices.chunks_exact(primitive.topology.vertices_per_item()) {
            item.iter().for_each(|&at| self.extend_bounds(world[at as usize].raw()));
            let corners: Vec<HPoint<Clip>> = item.iter().map(|&at| clip[at as usize]).collect();
            self.classify_primitive(chain, &corners, is_transparent, |facing| {
                is_single_sided
                    && primitive.topology == Topology::Triangles
                    && facing == is_mirrored
            });
        }
    }

    /// Extends the bounding box to include a point.
    fn extend_bounds(&mut self, point: DVec3) {
        let [least, most] = self.bounds.unwrap_or([point, point]);
        self.bounds = Some([least.min(point), most.max(point)]);
    }

    /// Counts one point, line or triangle. `culled` takes `true` for a front face or `false` for a
    /// back face and returns whether that face is culled.
    ///
    /// The tests are, in order: trivial rejection (the AND of the vertices' outcodes is not 0),
    /// facing (edge-on if the area is 0), culling, alpha. A primitive outside several planes is
    /// counted at the first of them, so that the counts add up to the total.
    fn classify_primitive(
        &mut self,
        chain: &TransformChain,
        corners: &[HPoint<Clip>],
        is_transparent: bool,
        culled: impl Fn(bool) -> bool,
    ) {
        let codes: Vec<Outcode> =
            corners.iter().map(|&at| chain.clip_volume().outcode(at)).collect();
        let rejected = Outcode::trivially_rejects(&codes);
        self.total += 1;
        let common = self.common_outcode.unwrap_or(Outcode::ALL);
        self.common_outcode = Some(codes.iter().fold(common, |all, &code| all & code));
        if let Some(plane) = rejected.planes().next() {
            if let Some(count) = self.outside.get_mut(plane.index()) {
                *count += 1;
            }
        } else if let Some(facing) = chain.is_front_facing(corners) {
            match (culled(facing), is_transparent) {
                (true, _) => self.back_facing += 1,
                (false, true) => self.transparent += 1,
                (false, false) => self.visible += 1,
            }
        } else {
            self.edge_on += 1;
        }
    }

    /// Returns the step with the bounding box and its relation to the view volume.
    ///
    /// The box is in world units. If it is outside one plane, this step explains the missing mesh.
    fn bounds_step(&self) -> Step {
        let step = Step::new("bounds", "Bounding box", Some("CL-1"));
        let Some([min, most]) = self.bounds else {
            return step.with_item(
                "empty",
                "nothing",
                "the mesh has no points, lines or triangles",
            );
        };
        let common = self.common_outcode.unwrap_or(Outcode::INSIDE);
        let place = if common.is_inside() {
            "not outside any one plane".to_owned()
        } else {
            describe_outcode(common)
        };
        step.with_item("least", "minimum x, y, z in world space", min.to_array())
            .with_item("most", "maximum x, y, z", most.to_array())
            .with_item("outside", "the whole mesh is", place)
    }

    /// Returns the step with the counts.
    ///
    /// Planes that reject nothing are omitted from the list. Primitives that cross a plane count as
    /// visible: they are clipped only in part.
    fn count_step(&self) -> Step {
        let mut step = Step::new("counts", "Points, lines and triangles", Some("CL-1, CL-3, RA-1"))
            .with_item("all", "all", self.total as f64);
        for (plane, &count) in PlaneIndex::BOX.iter().zip(&self.outside) {
            if count > 0 {
                let name = format!("outside the {plane} plane");
                step.add_item(format!("outside_{plane}"), name, count as f64);
            }
        }
        step.with_item("away", "back-facing, single-sided", self.back_facing as f64)
            .with_item("edge_on", "seen edge-on", self.edge_on as f64)
            .with_item("transparent", "fully transparent", self.transparent as f64)
            .with_item("left", "in the view volume", self.visible as f64)
    }

    /// States the result in a sentence: the stage that removes everything, or the visible fraction.
    ///
    /// The first condition that explains everything wins: an empty mesh, one plane that rejects
    /// all, a visible remainder, culling, or alpha. A mesh that is rejected partly by one plane and
    /// partly by another has no single cause.
    fn verdict(&self) -> String {
        let common = self.common_outcode.unwrap_or(Outcode::INSIDE);
        if self.total == 0 {
            "Its mesh has no points, lines or triangles.".to_owned()
        } else if !common.is_inside() {
            format!("It is not in the picture: the whole mesh is {}.", describe_outcode(common))
        } else if self.visible > 0 {
            let percentage = format_number(100.0 * self.visible as f64 / self.total as f64);
            format!(
                "Points, lines and triangles in the view volume: {} of {} ({percentage}%). Any that are not visible are behind other surfaces.",
                self.visible, self.total
            )
        } else if self.back_facing > 0
            && self.back_facing + self.edge_on >= self.total - self.outside.iter().sum::<usize>()
        {
            "Its triangles face away from the camera, and its material is single-sided: set doubleSided, or move the camera.".to_owned()
        } else if self.transparent > 0 {
            "Its material is fully transparent: the base color's alpha is 0.".to_owned()
        } else {
            "None of it reaches the picture.".to_owned()
        }
    }
}
