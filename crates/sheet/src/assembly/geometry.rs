//! Identical parts: parts with the same triangles, lines, materials and size, at any position.
//!
//! Meshes are compared by content, so copies in a file count as one part. A mirror image is a
//! different part. Meshes that have the same shape but different vertex positions in the file count
//! as different, because positions are compared as stored.

use super::part::{Part, drawn_primitives};
use glam::DMat3;
use model::{MeshInstance, Model, ModelInstance, Primitive};
use std::collections::BTreeMap;
use std::sync::Arc;

/// The maximum relative difference, due to rounding, between the lengths and angles of identical
/// parts.
const SHAPE_TOLERANCE: f64 = 1e-5;

/// The maximum number of sizes compared per mesh. Parts of further sizes all count as different.
const MAX_SIZES: usize = 1000;

/// A size at which a mesh occurs: its Gram matrix, whether it is mirrored, and its class number.
type SizeClass = (DMat3, bool, usize);

/// Assigns the same class number to identical parts.
pub(super) struct PartClasses<'a> {
    models: &'a [ModelInstance],
    /// The first part with each mesh content, by digest, as its model index and instance.
    contents: BTreeMap<u64, Vec<(usize, MeshInstance)>>,
    /// The content keys of undeformed meshes, by the first model with the mesh and the mesh index.
    rigid: BTreeMap<(usize, usize), (u64, usize)>,
    /// The sizes that occur for each content, with their class numbers.
    sizes: BTreeMap<(u64, usize), Vec<SizeClass>>,
    count: usize,
}

impl<'a> PartClasses<'a> {
    /// Creates an empty set of classes.
    pub(super) fn new(models: &'a [ModelInstance]) -> Self {
        Self {
            models,
            contents: BTreeMap::new(),
            rigid: BTreeMap::new(),
            sizes: BTreeMap::new(),
            count: 0,
        }
    }

    /// Returns the class of a part.
    pub(super) fn class_of(&mut self, part: &Part) -> usize {
        let content = self.content_of(part);
        let (shape, mirrored) = part.shape(self.models);
        let sizes = self.sizes.entry(content).or_default();
        let equal = |(other, is_mirrored, _): &&(DMat3, bool, usize)| {
            *is_mirrored == mirrored && are_close(shape, *other)
        };
        if let Some((.., class)) = sizes.iter().take(MAX_SIZES).find(equal) {
            return *class;
        }
        let class = self.count;
        self.count += 1;
        sizes.push((shape, mirrored, class));
        class
    }

    /// Returns the digest of a part's mesh and the index of its content among the contents with
    /// this digest.
    fn content_of(&mut self, part: &Part) -> (u64, usize) {
        let model = &self.models[part.model].model;
        // Instances of one model share its meshes, so they use the cache entry of the first
        // instance.
        let is_same = |other: &ModelInstance| Arc::ptr_eq(&other.model, model);
        let first = self.models.iter().take(part.model).position(is_same).unwrap_or(part.model);
        let node = &model.nodes[part.instance.node];
        // A skinned or morphed mesh has a different shape at each node.
        let deforms = node.skin.is_some()
            || drawn_primitives(model, part.instance).any(|one| !one.morph_targets.is_empty());
        let key = (first, node.mesh.unwrap_or(usize::MAX));
        if !deforms && let Some(known) = self.rigid.get(&key) {
            return *known;
        }
        let digest = digest_of_mesh(model, part.instance);
        let same_digest = self.contents.entry(digest).or_default();
        // Digests may collide, so the contents must be compared too.
        let is_equal = |(number, instance): &(usize, MeshInstance)| {
            let other = &self.models[*number].model;
            meshes_are_equal(model, part.instance, other, *instance)
        };
        let content = same_digest.iter().position(is_equal).unwrap_or_else(|| {
            same_digest.push((part.model, part.instance));
            same_digest.len() - 1
        });
        if !deforms {
            self.rigid.insert(key, (digest, content));
        }
        (digest, content)
    }
}

/// Whether two Gram matrices are equal up to rounding.
fn are_close(a: DMat3, b: DMat3) -> bool {
    let size = a.x_axis.x + a.y_axis.y + a.z_axis.z;
    (a - b).to_cols_array().iter().all(|difference| difference.abs() <= SHAPE_TOLERANCE * size)
}

/// Returns the material properties that distinguish parts in a list: the name and base color.
fn material_key<'a>(model: &'a Model, primitive: &Primitive) -> (Option<&'a str>, [u32; 4]) {
    let material = primitive.material.and_then(|index| model.materials.get(index));
    let color = material.map_or([1.0; 4], |material| material.base_color);
    (material.and_then(|material| material.name.as_deref()), color.map(f32::to_bits))
}

/// Returns a digest that is equal for identical meshes (Fowler–Noll–Vo, word by word).
fn digest_of_mesh(model: &Model, instance: MeshInstance) -> u64 {
    let mut digest = 0xcbf2_9ce4_8422_2325_u64;
    let mut add = |word: u32| {
        digest = (digest ^ u64::from(word)).wrapping_mul(0x0100_0000_01b3);
        digest ^= digest >> 29;
    };
    for primitive in drawn_primitives(model, instance) {
        add(primitive.topology as u32);
        primitive.indices.iter().for_each(|index| add(*index));
        let skinned = model.skin_primitive(instance, primitive);
        skinned.positions.as_flattened().iter().for_each(|coordinate| add(coordinate.to_bits()));
        let (name, color) = material_key(model, primitive);
        name.into_iter().flat_map(str::bytes).for_each(|byte| add(byte.into()));
        color.into_iter().for_each(&mut add);
    }
    digest
}

/// Whether two meshes have the same triangles, lines and materials, bit for bit.
fn meshes_are_equal(
    model: &Model,
    instance: MeshInstance,
    other_model: &Model,
    other_instance: MeshInstance,
) -> bool {
    let mut own = drawn_primitives(model, instance);
    let mut others = drawn_primitives(other_model, other_instance);
    loop {
        let (a, b) = match (own.next(), others.next()) {
            (None, None) => return true,
            (Some(a), Some(b)) => (a, b),
            _ => return false,
        };
        // Bit patterns are compared because NaN must equal itself.
        let positions = |model: &Model, instance, primitive| {
            let skinned = model.skin_primitive(instance, primitive);
            let bits = skinned.positions.as_flattened().iter().map(|c| c.to_bits());
            bits.collect::<Vec<u32>>()
        };
        let is_equal = a.topology == b.topology
            && a.indices == b.indices
            && material_key(model, a) == material_key(other_model, b)
            && positions(model, instance, a) == positions(other_model, other_instance, b);
        if !is_equal {
            return false;
        }
    }
}
