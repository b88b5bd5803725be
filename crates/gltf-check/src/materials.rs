//! Validation of materials, their requirements on meshes that use them, and punctual lights.

use super::codes;
use super::diagnostics::Diagnostics;
use super::document::{
    CheckedDocument, array_items, extension_object, index_member, integer_member,
};
use serde_json::Value;

/// Validates all materials, and the lights of KHR_lights_punctual.
///
/// The schema covers single values. This function checks rules that relate two members, and the gap
/// in the range of `ior`.
///
/// The schema walk validates texture references; neither textures nor images are accessed here.
pub(super) fn check_materials(document: &CheckedDocument<'_>) {
    for (at, material) in document.root_array("materials").iter().enumerate() {
        let mode = material.get("alphaMode").and_then(Value::as_str).unwrap_or("OPAQUE");
        if mode != "MASK" && material.get("alphaCutoff").is_some() {
            let message = format_args!("alphaCutoff has no effect with alphaMode {mode}");
            let pointer = format_args!("/materials/{at}/alphaCutoff");
            document.diagnostics.add(&codes::MATERIAL_ALPHA_CUTOFF_INVALID_MODE, pointer, message);
        }
        let ior =
            extension_object(material, "KHR_materials_ior").and_then(|e| e.get("ior")?.as_f64());
        if let Some(ior) = ior.filter(|&ior| ior > 0.0 && ior < 1.0) {
            let message = format_args!("ior is {ior} but must be 0 or at least 1");
            let pointer = format_args!("/materials/{at}/extensions/KHR_materials_ior/ior");
            document.diagnostics.add(&codes::VALUE_NOT_IN_RANGE, pointer, message);
        }
    }
    let lights = extension_object(document.root, "KHR_lights_punctual");
    for (at, light) in
        lights.map_or(&[][..], |lights| array_items(lights, "lights")).iter().enumerate()
    {
        check_light(document, at, light);
    }
}

/// Validates a punctual light: a spot light needs a `spot` with ordered cone angles.
///
/// Missing angles default to 0 and π/4. With equal angles, the falloff is undefined, because its
/// formula divides by their difference.
fn check_light(document: &CheckedDocument<'_>, at: usize, light: &Value) {
    let pointer = format!("/extensions/KHR_lights_punctual/lights/{at}");
    let is_spot = light.get("type").and_then(Value::as_str) == Some("spot");
    let Some(spot) = light.get("spot") else {
        if is_spot {
            let message = "missing property `spot`, which a spot light requires";
            document.diagnostics.add(
                &codes::UNDEFINED_PROPERTY,
                format_args!("{pointer}/spot"),
                message,
            );
        }
        return;
    };
    let angle = |key: &str, default: f64| match spot.get(key) {
        None => Some(default),
        Some(angle) => angle.as_f64(),
    };
    let inner = angle("innerConeAngle", 0.0);
    let outer = angle("outerConeAngle", std::f64::consts::FRAC_PI_4);
    if let (Some(inner), Some(outer)) = (inner, outer)
        && outer <= inner
    {
        let message =
            format_args!("outerConeAngle {outer} must be greater than innerConeAngle {inner}");
        let code = &codes::KHR_LIGHTS_PUNCTUAL_LIGHT_SPOT_ANGLES;
        document.diagnostics.add(code, format_args!("{pointer}/spot/outerConeAngle"), message);
    }
}

/// The vertex attributes that a material requires.
///
/// A primitive without these attributes is drawn without the texture, or with generated tangents.
#[derive(Clone, Copy, Default, Debug)]
pub(super) struct MaterialRequirements {
    /// The largest texture coordinate set that the textures use.
    max_uv_set: Option<u64>,
    /// Whether the material has a normal map. If a mesh has no tangents, they are generated from
    /// the map's texture coordinates.
    has_normal_map: bool,
    /// Whether the material needs tangents even without a normal map, for anisotropy or a clearcoat
    /// normal map.
    needs_tangents: bool,
}

/// Collects the requirements of all materials.
pub(super) fn material_requirements(document: &CheckedDocument<'_>) -> Vec<MaterialRequirements> {
    let of = |material: &Value| {
        let mut needs = MaterialRequirements::default();
        find_max_uv_set(material, &mut needs.max_uv_set);
        let of_coat = extension_object(material, "KHR_materials_clearcoat")
            .is_some_and(|coat| coat.get("clearcoatNormalTexture").is_some());
        needs.needs_tangents =
            of_coat || extension_object(material, "KHR_materials_anisotropy").is_some();
        needs.has_normal_map = material.get("normalTexture").is_some();
        needs
    };
    document.root_array("materials").iter().map(of).collect()
}

impl MaterialRequirements {
    /// Validates the attributes of a primitive against the material.
    ///
    /// `sets` is the primitive's number of texture coordinate sets, and `pointer` its `material`
    /// member.
    pub(super) fn check_primitive(
        self,
        diagnostics: &Diagnostics,
        pointer: &str,
        sets: u64,
        has_tangents: bool,
    ) {
        if let Some(set) = self.max_uv_set.filter(|&set| set >= sets) {
            let message = format_args!("the material needs TEXCOORD_{set}");
            diagnostics.add(&codes::MESH_PRIMITIVE_TOO_FEW_TEXCOORDS, pointer, message);
        }
        if has_tangents {
            return;
        }
        if self.has_normal_map {
            let message =
                "the material needs tangents; they are generated because the mesh has none";
            diagnostics.add(&codes::MESH_PRIMITIVE_GENERATED_TANGENT_SPACE, pointer, message);
        } else if self.needs_tangents {
            let message =
                "the material needs tangents, which cannot be generated without a normal map";
            diagnostics.add(&codes::MESH_PRIMITIVE_NO_TANGENT_SPACE, pointer, message);
        }
    }
}

/// Finds the largest `texCoord` in all texture infos below a JSON value.
///
/// A texture info is any object with an `index`, so the texture infos of extensions are found
/// without a list. KHR_texture_transform may override its `texCoord`.
///
/// The recursion is as deep as the JSON, whose depth is limited.
fn find_max_uv_set(value: &Value, most: &mut Option<u64>) {
    let Some(members) = value.as_object() else { return };
    if index_member(value, "index").is_some() {
        let transform = extension_object(value, "KHR_texture_transform");
        let own = transform.and_then(|transform| integer_member(transform, "texCoord"));
        let set = own.or(integer_member(value, "texCoord")).unwrap_or(0);
        *most = Some(most.map_or(set, |most| most.max(set)));
    }
    members
        .iter()
        .filter(|(name, _)| *name != "extras")
        .for_each(|(_, v)| find_max_uv_set(v, most));
}
