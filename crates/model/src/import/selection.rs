//! What can be asked of a file: which of its scenes, and which of its variants.

use super::warnings::ImportWarnings;
use crate::diagnostic::{Diagnostic, codes};
use crate::{Mesh, VariantMaterial};
use gltf::json::{Root, mesh};
use serde_json::Value;

/// A thing of a file, by name or by number.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum NameOrIndex {
    /// By its place in the file, from 0.
    Index(usize),
    /// By its name.
    Name(String),
}

impl NameOrIndex {
    /// The number of the chosen one among things with these names, or why there is none. A number that is too large may
    /// be a name all the same.
    fn find_among(
        &self,
        names: &[Option<&str>],
        what: &str,
        pointer: &str,
    ) -> Result<usize, Diagnostic> {
        let named = |wanted: &str| names.iter().position(|name| *name == Some(wanted));
        let (found, wanted) = match self {
            Self::Index(at) if *at < names.len() => (Some(*at), at.to_string()),
            Self::Index(at) => (named(&at.to_string()), at.to_string()),
            Self::Name(name) => (named(name), name.clone()),
        };
        found.ok_or_else(|| {
            let known = names.iter().enumerate().map(|(at, name)| match name {
                Some(name) => format!("{at} `{name}`"),
                None => at.to_string(),
            });
            let known: Vec<String> = known.collect();
            let problem = format!("there is no {what} `{wanted}`");
            let remedy = match known.as_slice() {
                [] => format!("leave it out: the file has no {what}s"),
                known => format!("choose one of {}", known.join(", ")),
            };
            Diagnostic::error(codes::NO_SUCH_ITEM, pointer, problem, &remedy)
        })
    }
}

/// The scene that is shown: the chosen one, else the default scene, else the first.
pub(super) fn select_scene(
    root: &Root,
    choice: Option<&NameOrIndex>,
    warnings: &mut ImportWarnings,
) -> Result<usize, Diagnostic> {
    if let Some(choice) = choice {
        let names: Vec<_> = root.scenes.iter().map(|scene| scene.name.as_deref()).collect();
        return choice.find_among(&names, "scene", "/scenes");
    }
    match root.scene.map(|scene| scene.value()) {
        Some(scene) if scene >= root.scenes.len() => {
            let fault = Diagnostic::unresolved_index("/scene", "scene", scene, root.scenes.len());
            warnings.downgrade_if_lenient(fault, "the first scene is shown").map(|()| 0)
        }
        scene => Ok(scene.unwrap_or(0)),
    }
}

const VARIANTS_EXTENSION: &str = "KHR_materials_variants";

/// The names of the variants of a file.
pub(super) fn variant_names(root: &Root) -> Vec<String> {
    let extension =
        root.extensions.as_ref().and_then(|extensions| extensions.others.get(VARIANTS_EXTENSION));
    let list = extension.and_then(|extension| extension.get("variants")?.as_array());
    let name = |json: &Value| json.get("name").and_then(Value::as_str).unwrap_or("").to_owned();
    list.into_iter().flatten().map(name).collect()
}

/// The number of the chosen variant.
pub(super) fn select_variant(names: &[String], choice: &NameOrIndex) -> Result<usize, Diagnostic> {
    let names: Vec<_> = names.iter().map(|name| Some(name.as_str())).collect();
    choice.find_among(&names, "variant", &format!("/extensions/{VARIANTS_EXTENSION}/variants"))
}

/// The materials that a primitive has in the variants. What points to nothing is left out with a warning.
pub(super) fn variant_materials(
    root: &Root,
    json: &mesh::Primitive,
    pointer: &str,
    variants: usize,
    warnings: &mut ImportWarnings,
) -> Vec<VariantMaterial> {
    let extension = json.extensions.as_ref().and_then(|all| all.others.get(VARIANTS_EXTENSION));
    let mappings = extension.and_then(|extension| extension.get("mappings")?.as_array());
    let mut found = Vec::new();
    for (at, mapping) in mappings.into_iter().flatten().enumerate() {
        let pointer = format!("{pointer}/extensions/{VARIANTS_EXTENSION}/mappings/{at}");
        let index = |json: Option<&Value>| json.and_then(Value::as_u64).map(|at| at as usize);
        let material = index(mapping.get("material")).unwrap_or(usize::MAX);
        let named = mapping.get("variants").and_then(Value::as_array).into_iter().flatten();
        let fault = if material < root.materials.len() {
            let numbers = named.map(|json| index(Some(json)).unwrap_or(usize::MAX));
            let (known, lost): (Vec<_>, Vec<_>) = numbers.partition(|&at| at < variants);
            found.extend(known.iter().map(|&variant| VariantMaterial { variant, material }));
            let pointer = format!("{pointer}/variants");
            lost.first().map(|&at| Diagnostic::unresolved_index(&pointer, "variant", at, variants))
        } else {
            let pointer = format!("{pointer}/material");
            Some(Diagnostic::unresolved_index(&pointer, "material", material, root.materials.len()))
        };
        if let Some(fault) = fault {
            warnings.downgrade(&fault, "it is left out");
        }
    }
    found
}

/// The material that a primitive has in a variant, if the variant says anything of it.
pub(super) fn variant_material(
    root: &Root,
    json: &mesh::Primitive,
    variant: usize,
) -> Option<usize> {
    let all = variant_materials(root, json, "", variant + 1, &mut ImportWarnings::default());
    all.iter().find(|found| found.variant == variant).map(|found| found.material)
}

/// Gives the primitives the materials they have in a variant; those it says nothing of keep theirs.
pub(super) fn apply_variant(meshes: &mut [Mesh], variant: usize) {
    for primitive in meshes.iter_mut().flat_map(|mesh| &mut mesh.primitives) {
        if let Some(found) =
            primitive.material_variants.iter().find(|found| found.variant == variant)
        {
            primitive.material = Some(found.material);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn by_number_by_name_or_with_a_list_of_what_there_is() {
        let names = [Some("day"), None, Some("7")];
        let among = |choice: NameOrIndex| choice.find_among(&names, "scene", "/scenes");
        assert_eq!(among(NameOrIndex::Index(1)), Ok(1));
        assert_eq!(among(NameOrIndex::Index(7)), Ok(2), "a name of digits");
        assert_eq!(among(NameOrIndex::Name("day".to_owned())), Ok(0));
        let fault = among(NameOrIndex::Name("night".to_owned())).unwrap_err();
        assert_eq!(fault.code, codes::NO_SUCH_ITEM);
        assert_eq!(fault.message, "there is no scene `night`");
        assert_eq!(fault.help.unwrap(), "choose one of 0 `day`, 1, 2 `7`");
        let fault = NameOrIndex::Index(0).find_among(&[], "variant", "/v").unwrap_err();
        assert_eq!(fault.help.unwrap(), "leave it out: the file has no variants");
    }
}
