//! Material overrides: changes to a model's materials, applied after it is loaded and posed.
//!
//! An override replaces factors of metallic-roughness materials. It also drops the texture of a
//! replaced factor, because glTF multiplies the two: red paint on a blue texture would be black.

use super::Origin;
use model::{AlphaMode, Emission, Material, Model};
use scene_file::PathStep::{self, Field, Index};
use scene_file::file::{AlphaModeFile, Color, MaterialFile, MaterialsFile};
use scene_file::{SceneError, SceneErrors, suggest_name};

/// Changes the materials of the model with this index in the scene.
///
/// # Errors
/// Returns an error for every override of materials that the model does not have.
pub(super) fn override_materials(
    origin: &Origin,
    number: usize,
    changes: &[MaterialFile],
    model: &mut Model,
) -> Result<(), SceneErrors> {
    let mut errors = Vec::new();
    for (at, change) in changes.iter().enumerate() {
        let place = OverridePath {
            origin,
            path: [Field("models"), Index(number), Field("materials"), Index(at)],
        };
        let change = MaterialOverride { file: change };
        match select_materials(&place, &change.file.of, model) {
            Ok(selected) => {
                selected.into_iter().for_each(|at| change.apply_to(&mut model.materials[at]));
            }
            Err(error) => errors.push(error),
        }
    }
    SceneErrors::from_list(errors).map_or(Ok(()), Err)
}

/// The path of an override in the file.
struct OverridePath<'a> {
    origin: &'a Origin,
    path: [PathStep<'a>; 4],
}

impl OverridePath<'_> {
    /// Creates an error that points at a field of the override.
    fn error_at(&self, field: &str, message: String, help: Option<String>) -> SceneError {
        self.origin.error_at(&[&self.path[..], &[Field(field)]].concat(), message, help)
    }
}

/// Returns the selected materials' indices.
fn select_materials(
    place: &OverridePath<'_>,
    of: &MaterialsFile,
    model: &mut Model,
) -> Result<Vec<usize>, SceneError> {
    let count = model.materials.len();
    let (found, wanted): (Vec<usize>, _) = match of {
        MaterialsFile::All => {
            // Primitives without a material get one, so that the override reaches them.
            assign_missing_materials(model);
            return Ok((0..model.materials.len()).collect());
        }
        MaterialsFile::Index(at) => ((0..count).filter(|n| n == at).collect(), at.to_string()),
        MaterialsFile::Name(name) => {
            let is_meant = |n: &usize| model.materials[*n].name.as_ref() == Some(name);
            ((0..count).filter(is_meant).collect(), name.clone())
        }
    };
    if !found.is_empty() {
        return Ok(found);
    }
    let message = format!("the model {} has no material `{wanted}`", model.name);
    let mut names: Vec<String> = match of {
        MaterialsFile::Index(_) => (0..count).map(|n| n.to_string()).collect(),
        _ => model.materials.iter().filter_map(|material| material.name.clone()).collect(),
    };
    names.dedup();
    let help = match (names.is_empty(), count) {
        (true, 0) => "it has no materials: use of: All".to_owned(),
        (true, _) => {
            format!("its materials have no names: use of: Index(0) to Index({})", count - 1)
        }
        _ => suggest_name(&wanted, &names).unwrap_or_default(),
    };
    Err(place.error_at("of", message, Some(help)))
}

/// Gives surfaces without a material a default one that can be changed.
fn assign_missing_materials(model: &mut Model) {
    let new = model.materials.len();
    let primitives = model.meshes.iter_mut().flat_map(|mesh| &mut mesh.primitives);
    let mut without = primitives.filter(|primitive| primitive.material.is_none()).peekable();
    if without.peek().is_some() {
        without.for_each(|primitive| primitive.material = Some(new));
        model.materials.push(Material::default());
    }
}

/// An override of one material.
struct MaterialOverride<'a> {
    file: &'a MaterialFile,
}

impl MaterialOverride<'_> {
    /// Replaces the fields of a material that the override sets. Drops the textures of replaced
    /// fields, unless `keep_textures` is set; the new values then multiply them.
    fn apply_to(&self, material: &mut Material) {
        let Self { file, .. } = self;
        if let Some([r, g, b]) = file.base_color.map(Color::to_linear) {
            // Colors in scene files have no alpha; the material's remains.
            material.base_color = [r, g, b, material.base_color[3]];
        }
        if let Some(alpha) = file.alpha {
            material.base_color[3] = alpha.value() as f32;
        }
        if let Some(metallic) = file.metallic {
            material.metallic = metallic.value() as f32;
        }
        if let Some(roughness) = file.roughness {
            material.roughness = roughness.value() as f32;
        }
        self.apply_emission(material);
        if let Some(mode) = file.alpha_mode {
            material.alpha_mode = match mode {
                AlphaModeFile::Opaque => AlphaMode::Opaque,
                AlphaModeFile::Mask { cutoff } => AlphaMode::Mask { cutoff: cutoff.value() as f32 },
                AlphaModeFile::Blend => AlphaMode::Blend,
            };
        }
        material.double_sided = file.double_sided.unwrap_or(material.double_sided);
        material.unlit = file.unlit.unwrap_or(material.unlit);
        if !file.keep_textures {
            self.remove_overridden_textures(material);
        }
    }

    /// Replaces the color of the emitted light, its strength, or both. Shading uses their product.
    fn apply_emission(&self, material: &mut Material) {
        let strength = self.file.emissive_strength.map(|strength| strength.value() as f32);
        if let Some(color) = self.file.emissive.map(Color::to_linear) {
            material.emission = Emission { color, strength: 1.0 };
        }
        if let Some(strength) = strength {
            material.emission.strength = strength;
        }
        if self.file.emissive.is_some() || strength.is_some() {
            material.emissive = material.emission.scaled_color();
        }
    }

    /// Removes the textures of the fields that the override sets.
    fn remove_overridden_textures(&self, material: &mut Material) {
        if self.file.base_color.is_some() {
            material.base_color_texture = None;
        }
        if self.file.metallic.is_some() || self.file.roughness.is_some() {
            material.metallic_roughness_texture = None;
        }
        if self.file.emissive.is_some() {
            material.emissive_texture = None;
        }
    }
}
