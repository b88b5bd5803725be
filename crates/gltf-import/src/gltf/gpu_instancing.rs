//! GPU instancing (EXT_mesh_gpu_instancing): a node draws its mesh many times.
//!
//! The translation, rotation and scale of the instances are accessors with one element per
//! instance; missing attributes default to the identity. They are composed as T · R · S and applied
//! before the node's own transform.

use super::accessor::AccessorReader;
use super::attribute::{AllowedFormats, ROTATION, TRANSLATION_OR_SCALE};
use crate::warnings::ImportWarnings;
use files::counted;
use homog::{Affine, Model as ModelSpace, Vector};
use model::{Diagnostic, Node};
use serde_json::{Map, Value};

/// The extension's name, as in `extensionsUsed`.
const EXTENSION: &str = "EXT_mesh_gpu_instancing";

/// The transform of an instance relative to its node.
type InstanceTransform = Affine<ModelSpace, ModelSpace>;

/// Reads the instance transforms of all nodes. If a node's transforms are invalid, its mesh is
/// drawn once, at the node.
///
/// The extension is ignored on a node with a skin, because skinned vertices follow the joints, not
/// the node. Individual instances with a non-finite transform are dropped.
///
/// # Errors
/// Fails if a limit is exceeded or a file cannot be read; errors in the content are warnings.
pub(super) fn import_instances(
    source: &AccessorReader<'_>,
    nodes: &mut [Node],
    warnings: &mut ImportWarnings,
) -> Result<(), Diagnostic> {
    for (at, node) in nodes.iter_mut().enumerate() {
        let json = source.root.nodes.get(at).and_then(|json| json.extensions.as_ref());
        let Some(extension) = json.and_then(|extensions| extensions.others.get(EXTENSION)) else {
            continue;
        };
        let pointer = format!("/nodes/{at}/extensions/{EXTENSION}");
        if node.skin.is_some() || node.mesh.is_none() {
            let message = "only a mesh without a skin can have instances; they are ignored";
            warnings.push_warning(&pointer, message);
            continue;
        }
        let read = match extension.get("attributes").and_then(Value::as_object) {
            Some(attributes) => {
                instance_transforms(source, attributes, &format!("{pointer}/attributes"))
            }
            None => Err(Diagnostic::invalid(&pointer, "the member `attributes` is missing")),
        };
        let all = match read {
            Err(diagnostic) if diagnostic.is_downgradable() => {
                warnings.downgrade(&diagnostic, "the mesh is shown once");
                continue;
            }
            transforms => transforms?,
        };
        let count = all.len();
        let is_visible = |transform: &InstanceTransform| transform.then(node.to_model).is_finite();
        let transforms: Vec<InstanceTransform> =
            all.into_iter().flatten().filter(is_visible).collect();
        if transforms.len() < count {
            let instances = counted(count - transforms.len(), "instance", "instances");
            let message = format!("skipped {instances} with a transform that is not finite");
            warnings.push_warning(&pointer, message);
        }
        node.instance_transforms = Some(transforms);
    }
    Ok(())
}

/// Composes the transforms from translation, rotation and scale; invalid transforms are `None`.
///
/// A transform is invalid if its quaternion has length 0, or if a number is not finite.
///
/// # Errors
/// Fails if an attribute is invalid, the counts differ, or the memory budget is exhausted.
fn instance_transforms(
    source: &AccessorReader<'_>,
    attributes: &Map<String, Value>,
    pointer: &str,
) -> Result<Vec<Option<InstanceTransform>>, Diagnostic> {
    let reader = InstanceAttributes { source, attributes, pointer };
    let translations = reader.read_attribute::<3>("TRANSLATION", &TRANSLATION_OR_SCALE)?;
    let rotations = reader.read_attribute::<4>("ROTATION", &ROTATION)?;
    let scales = reader.read_attribute::<3>("SCALE", &TRANSLATION_OR_SCALE)?;
    let counts = [
        translations.as_ref().map(Vec::len),
        rotations.as_ref().map(Vec::len),
        scales.as_ref().map(Vec::len),
    ];
    let mut counts = counts.into_iter().flatten();
    let count = counts.next().unwrap_or(0);
    if counts.any(|other| other != count) {
        return Err(Diagnostic::invalid(
            pointer,
            "the attributes must have the same number of elements",
        ));
    }
    // Charged before the list is allocated.
    source.buffers.charge_bytes(
        pointer,
        (count as u64).saturating_mul(size_of::<Option<InstanceTransform>>() as u64),
    )?;
    let transform = |at: usize| {
        let translation =
            translations.as_ref().map_or([0.0; 3], |translations| translations[at]).map(f64::from);
        let rotation = rotations.as_ref().map_or([0.0, 0.0, 0.0, 1.0], |rotations| rotations[at]);
        let [x, y, z] = scales.as_ref().map_or([1.0; 3], |scales| scales[at]).map(f64::from);
        let rotation = Affine::<ModelSpace, ModelSpace>::from_quaternion(rotation.map(f64::from))?;
        let transform = InstanceTransform::scale(x, y, z)
            .then(rotation)
            .then(Affine::translation(Vector::from(translation)));
        transform.is_finite().then_some(transform)
    };
    Ok((0..count).map(transform).collect())
}

/// Reads the instance attributes of one node.
struct InstanceAttributes<'a> {
    source: &'a AccessorReader<'a>,
    /// Accessor indices by attribute name.
    attributes: &'a Map<String, Value>,
    /// JSON pointer to the attributes.
    pointer: &'a str,
}

impl InstanceAttributes<'_> {
    /// Reads an attribute if the file has it.
    ///
    /// # Errors
    /// Fails if the member is not an index, or the accessor is invalid or has the wrong format.
    fn read_attribute<const N: usize>(
        &self,
        name: &str,
        format: &AllowedFormats,
    ) -> Result<Option<Vec<[f32; N]>>, Diagnostic> {
        let Some(value) = self.attributes.get(name) else { return Ok(None) };
        let pointer = format!("{}/{name}", self.pointer);
        let accessor =
            value.as_u64().ok_or_else(|| Diagnostic::invalid(&pointer, "expected an index"))?;
        let accessor = usize::try_from(accessor).unwrap_or(usize::MAX);
        let elements = self.source.resolve_accessor(accessor, &pointer)?;
        format.check_elements(&elements, &pointer)?;
        self.source.read_floats(&elements).map(Some)
    }
}
