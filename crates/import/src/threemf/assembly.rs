//! Builds a 3MF assembly: converts items and components to nodes, some with an object's mesh.
//!
//! Components share objects, so the number of nodes can grow exponentially with the size of the
//! file. It is computed and compared with the limits before any node is created.

use super::model_part::ObjectReference;
use super::package::Package;
use files::counted;
use gltf_import::ImportWarnings;
use gltf_import::Limits;
use homog::{Affine, Model as ModelSpace};
use model::{Diagnostic, Model, Node};
use std::collections::BTreeMap;

/// The object index of a removed placement.
const REMOVED: usize = usize::MAX;

/// An object with its transform.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placement {
    /// Index of the object.
    object: usize,
    /// The transform from the object's coordinates to the parent's.
    transform: Affine<ModelSpace, ModelSpace>,
}

/// The objects of all parts, and their hierarchy.
#[derive(Debug, Default)]
pub(super) struct Assembly {
    objects: Vec<AssemblyObject>,
    /// The objects of each part, by id.
    by_id: Vec<BTreeMap<u32, u32>>,
    /// The number of references to objects that are not shown.
    hidden: usize,
}

/// An object without its mesh.
#[derive(Debug, Default)]
struct AssemblyObject {
    name: Option<String>,
    location: String,
    is_shown: bool,
    /// Index of the object's mesh in the model, if it has one.
    mesh: Option<usize>,
    components: Vec<Placement>,
    /// How far the object's nodes have been counted.
    progress: Progress,
    /// Number of nodes for the object and everything below it.
    nodes: u64,
    /// Number of levels in the object's node tree.
    depth: usize,
}

/// The counting state of an object.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
enum Progress {
    #[default]
    Unknown,
    Begun,
    Counted,
}

impl Assembly {
    /// Adds an object and returns its index. If two objects have the same part and id, references
    /// use the first.
    pub(super) fn push_object(&mut self, part: usize, object: &super::object::Object) -> usize {
        let at = self.objects.len();
        if self.by_id.len() <= part {
            self.by_id.resize_with(part + 1, BTreeMap::new);
        }
        self.by_id[part].entry(object.id).or_insert(at as u32);
        self.objects.push(AssemblyObject {
            name: object.name.clone(),
            location: object.location.clone(),
            is_shown: object.is_shown,
            ..AssemblyObject::default()
        });
        at
    }

    /// Resolves the references in a part to objects. References to objects that are not shown are
    /// skipped.
    ///
    /// # Errors
    /// Fails if a referenced object does not exist. In lenient mode the reference is skipped.
    pub(super) fn resolve(
        &mut self,
        references: &[ObjectReference],
        part_of: impl Fn(&ObjectReference) -> Option<usize>,
        warnings: &mut ImportWarnings,
    ) -> Result<Vec<Placement>, Diagnostic> {
        let mut placements = Vec::with_capacity(references.len());
        for reference in references {
            let object = part_of(reference)
                .and_then(|part| self.by_id.get(part)?.get(&reference.id))
                .map(|&object| object as usize);
            match object {
                Some(object) if self.objects[object].is_shown => {
                    placements.push(Placement { object, transform: reference.transform });
                }
                Some(_) => self.hidden += 1,
                None => {
                    let place = reference.path.as_deref().map(|path| format!(" in {path:?}"));
                    let message =
                        format!("there is no object {}{}", reference.id, place.unwrap_or_default());
                    let fault = Diagnostic::invalid(&reference.location, message);
                    warnings.downgrade_if_lenient(fault, "it is skipped")?;
                }
            }
        }
        Ok(placements)
    }

    /// Sets the components of an object.
    pub(super) fn set_components(&mut self, object: usize, components: Vec<Placement>) {
        self.objects[object].components = components;
    }

    /// Sets the mesh of an object.
    pub(super) fn set_mesh(&mut self, object: usize, mesh: usize) {
        self.objects[object].mesh = Some(mesh);
    }

    /// Returns whether an object is built; [`Self::count_nodes`] must have been called.
    pub(super) fn is_built(&self, object: usize) -> bool {
        self.objects[object].progress == Progress::Counted
    }

    /// Returns all shown objects that are not components, for files with an empty build section.
    pub(super) fn top_objects(&self) -> Vec<Placement> {
        let mut is_top: Vec<bool> = self.objects.iter().map(|object| object.is_shown).collect();
        for component in self.objects.iter().flat_map(|object| &object.components) {
            is_top[component.object] = false;
        }
        let tops = (0..is_top.len()).filter(|&at| is_top[at]);
        tops.map(|object| Placement { object, transform: Affine::IDENTITY }).collect()
    }

    /// Counts the nodes that the items will have, before any node is created.
    ///
    /// # Errors
    /// Fails if an object contains itself (in lenient mode, that reference is skipped), or if there
    /// are more nodes or levels than the limits allow.
    pub(super) fn count_nodes(
        &mut self,
        items: &[Placement],
        package: &Package<'_>,
        limits: &Limits,
        warnings: &mut ImportWarnings,
    ) -> Result<(), Diagnostic> {
        let (mut nodes, mut depth) = (1, 0);
        for item in items {
            self.count_object(item.object, warnings)?;
            nodes += self.objects[item.object].nodes;
            depth = depth.max(self.objects[item.object].depth);
            // Checked in the loop, so that the sum cannot overflow.
            if nodes > limits.nodes as u64 {
                let what = format!("the build has at least {nodes} nodes");
                let limit = limits.nodes as u64;
                return Err(Diagnostic::limit_exceeded("", &what, "nodes", limit));
            }
        }
        if depth > limits.node_depth {
            let what = format!("the components are {depth} levels deep");
            let limit = limits.node_depth as u64;
            return Err(Diagnostic::limit_exceeded("", &what, "node_depth", limit));
        }
        if self.hidden > 0 {
            let objects = counted(self.hidden, "object", "objects");
            let message = format!("skipped {objects} of type support or other");
            warnings.push_warning("", message);
        }
        package.charge_bytes("", nodes * size_of::<Node>() as u64)
    }

    /// Counts the nodes of an object and its components, without recursion.
    fn count_object(
        &mut self,
        object: usize,
        warnings: &mut ImportWarnings,
    ) -> Result<(), Diagnostic> {
        let mut stack = Vec::new();
        if self.objects[object].progress == Progress::Unknown {
            self.objects[object].progress = Progress::Begun;
            stack.push((object, 0));
        }
        while let Some((at, next)) = stack.pop() {
            let Some(&component) = self.objects[at].components.get(next) else {
                self.finish_count(at);
                continue;
            };
            match self.objects[component.object].progress {
                Progress::Counted => stack.push((at, next + 1)),
                Progress::Unknown => {
                    self.objects[component.object].progress = Progress::Begun;
                    stack.push((at, next + 1));
                    stack.push((component.object, 0));
                }
                // An object whose count has begun but not ended is an ancestor of this object.
                Progress::Begun => {
                    let location = &self.objects[at].location;
                    let fault = Diagnostic::invalid(location, "the object contains itself");
                    warnings.downgrade_if_lenient(fault, "that reference is skipped")?;
                    self.objects[at].components[next].object = REMOVED;
                    stack.push((at, next + 1));
                }
            }
        }
        Ok(())
    }

    /// Completes the counts of an object whose components have been counted.
    fn finish_count(&mut self, at: usize) {
        self.objects[at].components.retain(|component| component.object != REMOVED);
        let components = self.objects[at].components.iter();
        let (mut nodes, mut depth) = (1_u64, 0);
        for component in components.map(|component| &self.objects[component.object]) {
            nodes = nodes.saturating_add(component.nodes);
            depth = depth.max(component.depth);
        }
        let object = &mut self.objects[at];
        (object.nodes, object.depth) = (nodes, depth + 1);
        object.progress = Progress::Counted;
    }

    /// Creates the nodes of the items. They get a common root unless there is exactly one item.
    ///
    /// # Errors
    /// Fails if a product of transforms overflows. In lenient mode the node gets its parent's
    /// transform.
    pub(super) fn build_nodes(
        &self,
        items: &[Placement],
        model: &mut Model,
        warnings: &mut ImportWarnings,
    ) -> Result<(), Diagnostic> {
        model.roots.push(0);
        let root = (items.len() != 1).then(|| {
            model.nodes.push(Node::default());
            0
        });
        // Reversed, so that nodes are created in the order of the file.
        let mut stack: Vec<_> = items.iter().rev().map(|&item| (item, root)).collect();
        while let Some((placement, parent)) = stack.pop() {
            let object = &self.objects[placement.object];
            let around =
                parent.map_or(Affine::IDENTITY, |parent: usize| model.nodes[parent].to_model);
            let mut to_parent = placement.transform;
            if !to_parent.then(around).is_finite() {
                let message = "the accumulated transform overflows";
                let fault = Diagnostic::invalid(&object.location, message);
                warnings.downgrade_if_lenient(fault, "its transform is ignored")?;
                to_parent = Affine::IDENTITY;
            }
            let at = model.nodes.len();
            if let Some(parent) = parent {
                model.nodes[parent].children.push(at);
            }
            model.nodes.push(Node {
                name: object.name.clone(),
                to_parent,
                trs: None,
                to_model: to_parent.then(around),
                parent,
                mesh: object.mesh,
                ..Node::default()
            });
            stack.extend(object.components.iter().rev().map(|&component| (component, Some(at))));
        }
        Ok(())
    }
}
