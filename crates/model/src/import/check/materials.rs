//! Materials, and what they demand of the meshes that use them; lights, which are as easily told.

use super::codes;
use super::document::{Document, extension, index, integer, items};
use super::findings::Findings;
use serde_json::Value;

/// Checks all materials, and the lights.
pub(super) fn check(document: &Document<'_>) {
    for (at, material) in document.all("materials").iter().enumerate() {
        let mode = material.get("alphaMode").and_then(Value::as_str).unwrap_or("OPAQUE");
        if mode != "MASK" && material.get("alphaCutoff").is_some() {
            let message = format_args!("a cutoff means nothing to alphaMode {mode}");
            let pointer = format_args!("/materials/{at}/alphaCutoff");
            document.findings.add(&codes::MATERIAL_ALPHA_CUTOFF_INVALID_MODE, pointer, message);
        }
        let ior = extension(material, "KHR_materials_ior").and_then(|e| e.get("ior")?.as_f64());
        if let Some(ior) = ior.filter(|&ior| ior > 0.0 && ior < 1.0) {
            let message = format_args!("{ior} is neither 0 nor from 1 on");
            let pointer = format_args!("/materials/{at}/extensions/KHR_materials_ior/ior");
            document.findings.add(&codes::VALUE_NOT_IN_RANGE, pointer, message);
        }
    }
    let lights = extension(document.root, "KHR_lights_punctual");
    for (at, light) in lights.map_or(&[][..], |lights| items(lights, "lights")).iter().enumerate() {
        check_light(document, at, light);
    }
}

fn check_light(document: &Document<'_>, at: usize, light: &Value) {
    let pointer = format!("/extensions/KHR_lights_punctual/lights/{at}");
    let is_spot = light.get("type").and_then(Value::as_str) == Some("spot");
    let Some(spot) = light.get("spot") else {
        if is_spot {
            let message = "a spot light must have the member `spot`";
            document.findings.add(
                &codes::UNDEFINED_PROPERTY,
                format_args!("{pointer}/spot"),
                message,
            );
        }
        return;
    };
    let angle = |key: &str, usual: f64| match spot.get(key) {
        None => Some(usual),
        Some(angle) => angle.as_f64(),
    };
    let inner = angle("innerConeAngle", 0.0);
    let outer = angle("outerConeAngle", std::f64::consts::FRAC_PI_4);
    if let (Some(inner), Some(outer)) = (inner, outer)
        && outer <= inner
    {
        let message = format_args!("the outer angle {outer} is not above the inner one, {inner}");
        let code = &codes::KHR_LIGHTS_PUNCTUAL_LIGHT_SPOT_ANGLES;
        document.findings.add(code, format_args!("{pointer}/spot/outerConeAngle"), message);
    }
}

/// What a material demands of the meshes that use it.
#[derive(Clone, Copy, Default, Debug)]
pub(super) struct Needs {
    /// The largest set of texture coordinates that its textures name.
    set: Option<u64>,
    has_normal_map: bool,
    tangents: bool,
}

/// The demands of all materials.
pub(super) fn needs(document: &Document<'_>) -> Vec<Needs> {
    let of = |material: &Value| {
        let mut needs = Needs::default();
        largest_set(material, &mut needs.set);
        let of_coat = extension(material, "KHR_materials_clearcoat")
            .is_some_and(|coat| coat.get("clearcoatNormalTexture").is_some());
        needs.tangents = of_coat || extension(material, "KHR_materials_anisotropy").is_some();
        needs.has_normal_map = material.get("normalTexture").is_some();
        needs
    };
    document.all("materials").iter().map(of).collect()
}

impl Needs {
    /// Checks a primitive with so many sets of texture coordinates; `pointer` is where it names the material.
    pub(super) fn check(self, findings: &Findings, pointer: &str, sets: u64, has_tangents: bool) {
        if let Some(set) = self.set.filter(|&set| set >= sets) {
            let message = format_args!("the material needs TEXCOORD_{set}");
            findings.add(&codes::MESH_PRIMITIVE_TOO_FEW_TEXCOORDS, pointer, message);
        }
        if has_tangents {
            return;
        }
        if self.has_normal_map {
            let message = "the material needs tangents, which are derived where the mesh has none";
            findings.add(&codes::MESH_PRIMITIVE_GENERATED_TANGENT_SPACE, pointer, message);
        } else if self.tangents {
            let message = "the material needs tangents, and nothing tells how to derive them";
            findings.add(&codes::MESH_PRIMITIVE_NO_TANGENT_SPACE, pointer, message);
        }
    }
}

/// The largest set of texture coordinates that the textures of a material name, wherever in it they stand.
fn largest_set(value: &Value, most: &mut Option<u64>) {
    let Some(members) = value.as_object() else { return };
    if index(value, "index").is_some() {
        let transform = extension(value, "KHR_texture_transform");
        let own = transform.and_then(|transform| integer(transform, "texCoord"));
        let set = own.or(integer(value, "texCoord")).unwrap_or(0);
        *most = Some(most.map_or(set, |most| most.max(set)));
    }
    members.iter().filter(|(name, _)| *name != "extras").for_each(|(_, v)| largest_set(v, most));
}
