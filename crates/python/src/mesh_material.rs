//! Mesh materials: one color and metallic-roughness factors, or the keys of an MTL library, as
//! stored by trimesh. The keys are converted to a material as in the OBJ importer.

use crate::failure::Failure;
use crate::keywords::{Keywords, not_a};
use crate::mesh_colors::linear_colors;
use import::PhongMaterial;
use model::{AlphaMode, Material};
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
