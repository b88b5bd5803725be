//! Mesh materials: one color and metallic-roughness factors, or the keys of an MTL library, as
//! stored by trimesh. The keys are converted to a material as in the OBJ importer.

use crate::failure::Failure;
use crate::keywords::{Keywords, not_a};
use crate::mesh_colors::linear_colors;
use import::PhongMaterial;
use model::{AlphaMode, Material, Specular};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use scene_file::file::Color;

/// Reads the material, or returns `None` if the mesh does not define a material.
///
/// # Errors
/// Returns an error if a factor is out of range or a color is invalid.
pub(crate) fn read_material(
    mesh: &Keywords<'_, '_>,
    [has_texture, has_colors]: [bool; 2],
) -> PyResult<Option<Material>> {
    if let Some(keys) = mesh.value("mtl")? {
        let keys = keys.cast::<PyDict>()?;
        return read_mtl(&Keywords(keys), has_texture).map(Some);
    }
    let color = mesh.value("color")?.map(|value| read_color(&value)).transpose()?;
    let (metallic, roughness) = (fraction(mesh, "metallic")?, fraction(mesh, "roughness")?);
    if let Some(keys) = mesh.value("phong")? {
        return read_phong(&Keywords(keys.cast::<PyDict>()?)).map(Some);
    }
    let double_sided = mesh.value("double_sided")?.is_none() || mesh.flag("double_sided")?;
    if color.is_none() && metallic.is_none() && roughness.is_none() && double_sided {
        return Ok(None);
    }
    let plain = Material::plain();
    let usual = if has_texture || has_colors { [1.0; 4] } else { plain.base_color };
    let material = Material {
        base_color: color.unwrap_or(usual),
        metallic: metallic.unwrap_or(plain.metallic),
        roughness: roughness.unwrap_or(plain.roughness),
        double_sided,
        ..plain
    };
    Ok(Some(with_alpha_mode(material)))
}

/// Creates a material that is blended if its color is translucent.
fn with_alpha_mode(material: Material) -> Material {
    let is_translucent = material.base_color[3] < 1.0;
    let alpha_mode = if is_translucent { AlphaMode::Blend } else { AlphaMode::Opaque };
    Material { alpha_mode, ..material }
}

/// Reads a number from 0 to 1.
fn fraction(mesh: &Keywords<'_, '_>, name: &str) -> PyResult<Option<f32>> {
    let Some(number) = mesh.number(name)? else { return Ok(None) };
    if (0.0..=1.0).contains(&number) {
        return Ok(Some(number as f32));
    }
    let message = format!("is {number}, expected a number from 0 to 1");
    Err(Failure::argument(name, message).into())
}

/// Reads a color, by name or by channels.
fn read_color(value: &Bound<'_, PyAny>) -> PyResult<[f32; 4]> {
    if let Ok(name) = value.extract::<String>() {
        let Some(color) = Color::parse(&name) else {
            return Err(not_a("color", value, "#rrggbb, the name of a color, or numbers").into());
        };
        let [r, g, b] = color.to_linear();
        return Ok([r, g, b, 1.0]);
    }
    match &linear_colors("color", value)?.1[..] {
        [color] => Ok(*color),
        _ => Err(not_a("color", value, "one color of 3 or 4 channels").into()),
    }
}

/// Creates the material from the keys `Kd`, `Ks`, `Ns`, `illum`, `d` and `Tr`.
fn read_mtl(keys: &Keywords<'_, '_>, has_texture: bool) -> PyResult<Material> {
    let number = |name: &str| Ok::<_, PyErr>(keys.number(name)?.map(|number| number as f32));
    let color = |name: &str| -> PyResult<Option<[f32; 3]>> {
        Ok(keys.vector::<3>(name)?.map(|color| color.map(|channel| channel as f32)))
    };
    let phong = PhongMaterial {
        diffuse: color("kd")?,
        specular: color("ks")?,
        exponent: number("ns")?,
        illumination: number("illum")?,
        dissolve: number("d")?,
        transparency: number("tr")?,
        has_texture,
    };
    Ok(phong.to_material())
}

/// Creates the material of a fixed-function pipeline from linear keys: `diffuse` (4), `emission`
/// (3), `f0`, `roughness`, and the flags `unlit`, `blend` and `double_sided`.
fn read_phong(keys: &Keywords<'_, '_>) -> PyResult<Material> {
    let f0 = keys.number("f0")?.unwrap_or(0.0) as f32;
    let emissive = keys.vector::<3>("emission")?.unwrap_or_default();
    let mut material = Material {
        base_color: keys.vector::<4>("diffuse")?.unwrap_or([1.0; 4]).map(|c| c as f32),
        roughness: fraction(keys, "roughness")?.unwrap_or(1.0),
        metallic: 0.0,
        emissive: emissive.map(|channel| channel as f32),
        alpha_mode: if keys.flag("blend")? { AlphaMode::Blend } else { AlphaMode::Opaque },
        double_sided: keys.flag("double_sided")?,
        unlit: keys.flag("unlit")?,
        ..Material::plain()
    };
    // Factors up to 1 reflect as much at grazing angles; colors scale only the reflection at
    // normal incidence, which is 0.04 for the default index of refraction.
    let strength = f0 / 0.04;
    let factor = strength.clamp(0.0, 1.0);
    let color = [if strength > 1.0 { strength } else { 1.0 }; 3];
    material.extensions.specular =
        Some(Box::new(Specular { factor, texture: None, color, color_texture: None }));
    Ok(material)
}
