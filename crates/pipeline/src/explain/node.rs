//! A node: why its mesh is seen, or what keeps it from being seen.

use super::chain::{Chain, planes};
use super::place::{node_name, to_point};
use super::text::number;
use super::{Explanation, Step};
use clip::{Outcode, PlaneIndex};
use glam::DVec3;
use homog::{Clip, HPoint, Point, World};
use model::ModelInstance;
use model::{AlphaMode, Instance, Model, Primitive, Topology};

/// Tells what becomes of all that a node shows.
///
/// That something stands in front of it is not looked at: what is hidden has come through all of these stages.
#[must_use]
pub fn explain_node(chain: &Chain, placed: &ModelInstance, node: usize) -> Explanation {
    let model = &placed.model;
    let subject = node_name(model, node);
    let mut steps = vec![tree_step(model, node)];
    let instances: Vec<Instance> = model.shown_meshes().filter(|at| at.node == node).collect();
    if instances.is_empty() {
        return Explanation { subject, steps, verdict: absent(model, node) };
    }
    let mut fates = Fates::default();
    for &instance in &instances {
        let mesh = model.nodes[node].mesh.and_then(|mesh| model.meshes.get(mesh));
        for primitive in mesh.into_iter().flat_map(|mesh| &mesh.primitives) {
            fates.count(chain, placed, instance, primitive);
        }
    }
    steps.push(fates.bounds_step());
    steps.push(fates.count_step());
    Explanation { subject, steps, verdict: fates.verdict() }
}

/// Where the node is in the tree.
fn tree_step(model: &Model, node: usize) -> Step {
    let mut path = Vec::new();
    let mut above = Some(node);
    // A forest without cycles: the importer has seen to that.
    while let Some(at) = above {
        path.push(node_name(model, at));
        above = model.nodes.get(at).and_then(|node| node.parent);
    }
    path.reverse();
    let here = model.nodes.get(node);
    let mesh = here.and_then(|node| node.mesh).and_then(|mesh| model.meshes.get(mesh));
    let mesh = mesh.map_or("none".to_owned(), |mesh| {
        let name = mesh.name.as_deref().unwrap_or("without a name");
        format!("{name}, {} primitives", mesh.primitives.len())
    });
    let step = Step::new("tree", "The node in its model", None)
        .with("path", "from the root", path.join(" › "))
        .with("mesh", "mesh", mesh);
    match here {
        Some(node) => step.with("node_to_model", "node to model", node.to_model.rows()),
        None => step,
    }
}

/// Why a node shows no mesh.
fn absent(model: &Model, node: usize) -> String {
    match model.nodes.get(node) {
        None => "There is no such node.".to_owned(),
        Some(here) if here.mesh.is_none() => {
            let below = here.children.len();
            format!("It has no mesh of its own to show; {below} nodes are directly below it.")
        }
        Some(_) if !model.instances().iter().any(|at| at.node == node) => {
            "It is not below a root of the scene that is shown.".to_owned()
        }
        Some(_) => "It shows its mesh at no place at all.".to_owned(),
    }
}

/// What becomes of all points, lines and triangles.
#[derive(Default)]
struct Fates {
    bounds: Option<[DVec3; 2]>,
    /// The planes that everything is outside of.
    common: Option<Outcode>,
    all: usize,
    /// Wholly outside of one plane, for each of the six.
    outside: [usize; 6],
    /// Seen from behind, with a material that has no back.
    away: usize,
    /// Without area on the screen.
    edge_on: usize,
    /// With a material that is wholly transparent.
    transparent: usize,
    left: usize,
}

impl Fates {
    fn count(
        &mut self,
        chain: &Chain,
        placed: &ModelInstance,
        instance: Instance,
        primitive: &Primitive,
    ) {
        let posed = placed.model.posed(instance, primitive);
        let to_world = posed.to_model.then(placed.model_to_world);
        let world: Vec<Point<World>> =
            posed.positions.iter().map(|&at| to_world.point(to_point(at))).collect();
        let clip: Vec<HPoint<Clip>> =
            world.iter().map(|&at| chain.world_to_clip().point(at)).collect();
        let material = primitive.material.and_then(|at| placed.model.materials.get(at));
        let one_sided = material.is_none_or(|material| !material.double_sided);
        let transparent = material.is_some_and(|material| {
            material.alpha_mode == AlphaMode::Blend && material.base_color[3] == 0.0
        });
        let mirrored = to_world.raw().determinant() < 0.0;
        for item in primitive.indices.chunks_exact(primitive.topology.corners()) {
            item.iter().for_each(|&at| self.grow(world[at as usize].raw()));
            let corners: Vec<HPoint<Clip>> = item.iter().map(|&at| clip[at as usize]).collect();
            self.judge(chain, &corners, transparent, |facing| {
                one_sided && primitive.topology == Topology::Triangles && facing == mirrored
            });
        }
    }

    fn grow(&mut self, point: DVec3) {
        let [least, most] = self.bounds.unwrap_or([point, point]);
        self.bounds = Some([least.min(point), most.max(point)]);
    }

    /// Counts a point, line or triangle. `culled` tells whether one that shows its front to the viewer (or does not) is left out.
    fn judge(
        &mut self,
        chain: &Chain,
        corners: &[HPoint<Clip>],
        transparent: bool,
        culled: impl Fn(bool) -> bool,
    ) {
        let codes: Vec<Outcode> = corners.iter().map(|&at| chain.volume().outcode(at)).collect();
        let rejected = Outcode::rejects(&codes);
        self.all += 1;
        let common = self.common.unwrap_or(Outcode::EVERY);
        self.common = Some(codes.iter().fold(common, |all, &code| all & code));
        if let Some(plane) = rejected.planes().next() {
            if let Some(count) = self.outside.get_mut(plane.index()) {
                *count += 1;
            }
        } else if let Some(facing) = chain.shows_front(corners) {
            match (culled(facing), transparent) {
                (true, _) => self.away += 1,
                (false, true) => self.transparent += 1,
                (false, false) => self.left += 1,
            }
        } else {
            self.edge_on += 1;
        }
    }

    fn bounds_step(&self) -> Step {
        let step = Step::new("bounds", "Where all of it is", Some("CL-1"));
        let Some([least, most]) = self.bounds else {
            return step.with("empty", "nothing", "the mesh has no points, lines or triangles");
        };
        let common = self.common.unwrap_or(Outcode::INSIDE);
        step.with("least", "least x, y, z of the world", least.to_array())
            .with("most", "greatest x, y, z", most.to_array())
            .with("outside", "all of it", planes(common))
    }

    fn count_step(&self) -> Step {
        let mut step = Step::new(
            "counts",
            "Its points, lines and triangles",
            Some("CL-1, CL-3, RA-1"),
        )
        .with("all", "all", self.all as f64);
        for (plane, &count) in PlaneIndex::BOX.iter().zip(&self.outside) {
            if count > 0 {
                let name = format!("outside of {plane}");
                step.add(format!("outside_{plane}"), name, count as f64);
            }
        }
        step.with("away", "seen from behind, one-sided", self.away as f64)
            .with("edge_on", "seen edge-on", self.edge_on as f64)
            .with("transparent", "wholly transparent", self.transparent as f64)
            .with("left", "in the view volume", self.left as f64)
    }

    fn verdict(&self) -> String {
        let common = self.common.unwrap_or(Outcode::INSIDE);
        if self.all == 0 {
            "Its mesh has no points, lines or triangles.".to_owned()
        } else if !common.is_inside() {
            format!("It is not in the picture: all of it is {}.", planes(common))
        } else if self.left > 0 {
            let share = number(100.0 * self.left as f64 / self.all as f64);
            format!(
                "{} of {} ({share} %) come into the view volume; what is not seen of them is behind something else.",
                self.left, self.all
            )
        } else if self.away > 0
            && self.away + self.edge_on >= self.all - self.outside.iter().sum::<usize>()
        {
            "Its triangles are seen from behind, and its material has no back: set doubleSided, or look from elsewhere.".to_owned()
        } else if self.transparent > 0 {
            "Its material is wholly transparent: the base colour's alpha is 0.".to_owned()
        } else {
            "None of it reaches the picture.".to_owned()
        }
    }
}
