//! Scalar attributes of primitives: custom attributes such as `_TEMPERATURE`, with accessors of
//! type `SCALAR`.
//!
//! The colors cover the value range of the whole model, so the values of all primitives are
//! collected first and converted to colors afterwards.

use super::attribute::{AttributeReader, CUSTOM_SCALAR};
use crate::ScalarColors;
use crate::scalars::bare_name;
use crate::warnings::ImportWarnings;
use gltf::json;
use gltf::json::Root;
use gltf::json::accessor::Type;
use gltf::json::mesh::{Primitive, Semantic};
use gltf::json::validation::Checked;
use model::{Diagnostic, Material, Model};

/// The values of one primitive.
#[derive(Debug)]
struct PrimitiveScalars {
    /// The index of the mesh.
    mesh: usize,
    /// The index of the primitive in the mesh.
    primitive: usize,
    /// One value per vertex.
    values: Vec<f32>,
}

/// The values of the attribute that the options name, by primitive.
#[derive(Debug, Default)]
pub(super) struct CollectedScalars {
    /// The attribute, if the options name one.
    pub(super) attribute: Option<Semantic>,
    /// The values of the primitives that have the attribute, in file order.
    primitives: Vec<PrimitiveScalars>,
}

/// Returns all scalar attribute names, without duplicates, in alphabetical order.
pub(super) fn scalar_attributes(root: &Root) -> Vec<String> {
    let is_scalar = |accessor: &json::Index<json::Accessor>| {
        let accessor = root.accessors.get(accessor.value());
        accessor.is_some_and(|accessor| accessor.type_ == Checked::Valid(Type::Scalar))
    };
    let primitives = root.meshes.iter().flat_map(|mesh| &mesh.primitives);
    let names = primitives.flat_map(|primitive: &Primitive| {
        primitive.attributes.iter().filter_map(|(semantic, accessor)| match semantic {
            Checked::Valid(semantic @ Semantic::Extras(_)) if is_scalar(accessor) => {
                Some(semantic.to_string())
            }
            _ => None,
        })
    });
    let mut names: Vec<String> = names.collect();
    names.sort();
    names.dedup();
    names
}

impl CollectedScalars {
    /// Creates an empty list of values for the attribute that the options name.
    ///
    /// # Errors
    /// Fails if the model has no such attribute.
    pub(super) fn new(colors: Option<&ScalarColors>, model: &Model) -> Result<Self, Diagnostic> {
        let Some(colors) = colors else { return Ok(Self::default()) };
        let index = colors.find_among(&model.scalar_attributes, "/meshes")?;
        let bare = bare_name(&model.scalar_attributes[index]).to_owned();
        Ok(Self { attribute: Some(Semantic::Extras(bare)), primitives: Vec::new() })
    }

    /// Reads the values of a primitive if it has the attribute.
    ///
    /// `named` returns the accessor of an attribute, if it exists, and the attribute's location.
    ///
    /// # Errors
    /// Fails if a limit is exceeded or a file cannot be read. Invalid values are skipped with a
    /// warning.
    pub(super) fn read_values(
        &mut self,
        mesh: usize,
        primitive: usize,
        attributes: &mut AttributeReader<'_, '_>,
        named: impl Fn(Semantic) -> (Option<usize>, String),
    ) -> Result<(), Diagnostic> {
        let Some(attribute) = &self.attribute else { return Ok(()) };
        let (accessor, pointer) = named(attribute.clone());
        let values =
            attributes.read_attribute(accessor, &pointer, &CUSTOM_SCALAR, |source, elements| {
                // Charge the budget for the conversion to colors.
                source.charge_array(elements.accessor, elements.count, 16)?;
                source.read_floats::<1>(&elements)
            })?;
        if let Some(values) = values.map(Vec::into_flattened) {
            self.primitives.push(PrimitiveScalars { mesh, primitive, values });
        }
        Ok(())
    }

    /// Sets the colors of primitives with values, and gives these primitives a plain white
    /// material.
    ///
    /// Their material variants and `COLOR_0` morph deltas are removed, because these would change
    /// the meaning of a color.
    pub(super) fn color_primitives(
        self,
        colors: &ScalarColors,
        model: &mut Model,
        warnings: &mut ImportWarnings,
    ) {
        let arrays: Vec<&[f32]> = self.primitives.iter().map(|of| of.values.as_slice()).collect();
        let arrays = colors.color_arrays(&arrays, "/meshes", warnings);
        let white = model.materials.len();
        model.materials.push(Material { name: Some("scalars".to_owned()), ..Material::white() });
        for (scalars, colors) in self.primitives.iter().zip(arrays) {
            let primitive = &mut model.meshes[scalars.mesh].primitives[scalars.primitive];
            // A broken primitive has been replaced by an empty primitive.
            if primitive.positions.len() == colors.len() {
                primitive.colors = Some(colors);
                primitive.material = Some(white);
                primitive.material_variants.clear();
                primitive.morph_targets.iter_mut().for_each(|target| target.colors = None);
            }
        }
    }
}
