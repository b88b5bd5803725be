//! Materials of meshes: one color and metallic-roughness factors, or the keys of an MTL library, as
//! trimesh keeps them.
//!
//! The keys become a material by the rule of the OBJ importer
//! (`model/src/import/obj/material.rs`).

use crate::failure::Failure;
use crate::keywords::{Keywords, not_a};
use crate::mesh_colors::{linear_colors, linear_fraction};
use model::{AlphaMode, Material, Specular};
use pipeline::scene::file::Color;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// The diffuse color, sRGB encoded, of a library that gives none.
const PLAIN_COLOR: [f64; 3] = [0.8; 3];
/// The largest diffuse color of a metal, and the least specular one.
const METAL_THRESHOLD: f64 = 0.04;

/// Reads the material; `None` if nothing is said of it.
///
/// # Errors
/// If a factor is not in its range, or a color is none.
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

/// A material that is blended if its color is translucent.
fn with_alpha_mode(material: Material) -> Material {
    let is_translucent = material.base_color[3] < 1.0;
    let alpha_mode = if is_translucent { AlphaMode::Blend } else { AlphaMode::Opaque };
    Material { alpha_mode, ..material }
}

/// A number from 0 to 1.
fn fraction(mesh: &Keywords<'_, '_>, name: &str) -> PyResult<Option<f32>> {
    let Some(number) = mesh.number(name)? else { return Ok(None) };
    if (0.0..=1.0).contains(&number) {
        return Ok(Some(number as f32));
    }
    let message = format!("is {number}, expected a number from 0 to 1");
    Err(Failure::argument(name, message).into())
}

/// A color by its name or by its channels.
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

/// The material of the keys `Kd`, `Ks`, `Ns`, `illum`, `d` and `Tr`.
fn read_mtl(keys: &Keywords<'_, '_>, has_texture: bool) -> PyResult<Material> {
    let diffuse = keys.vector::<3>("kd")?;
    let beside = diffuse.filter(|color| !has_texture || *color != [0.0; 3]);
    let usual = if has_texture { [1.0; 3] } else { PLAIN_COLOR };
    let linear = |color: [f64; 3]| color.map(|channel| linear_fraction(channel.clamp(0.0, 1.0)));
    let illumination = keys.number("illum")?;
    let is_matte = illumination == Some(1.0);
    let exponent = keys.number("ns")?.unwrap_or(0.0).max(0.0);
    let specular = keys.vector::<3>("ks")?.filter(|_| !is_matte).unwrap_or_default();
    let specular = specular.map(|channel| channel.clamp(0.0, 1.0));
    let largest = |color: [f64; 3]| color.into_iter().fold(0.0, f64::max);
    let is_black = diffuse.is_some_and(|color| largest(color) < METAL_THRESHOLD);
    let is_metal = is_black && largest(specular) >= METAL_THRESHOLD && !has_texture;
    let alpha = match (keys.number("d")?, keys.number("tr")?) {
        (Some(dissolve), _) => dissolve,
        // `Tr` 1 alone would make everything invisible: programs that write it mean the opposite.
        (None, Some(transparency)) if transparency < 1.0 => 1.0 - transparency,
        _ => 1.0,
    };
    let [r, g, b] = linear(if is_metal { specular } else { beside.unwrap_or(usual) });
    let mut material = Material {
        base_color: [r, g, b, alpha.clamp(0.0, 1.0) as f32],
        metallic: if is_metal { 1.0 } else { 0.0 },
        roughness: if is_matte { 1.0 } else { (2.0 / (exponent + 2.0)).sqrt().sqrt() as f32 },
        unlit: illumination == Some(0.0),
        double_sided: true,
        ..Material::plain()
    };
    let strength = (2.0 * largest(specular)).min(1.0);
    let color = specular.map(|channel| if strength > 0.0 { 2.0 * channel / strength } else { 1.0 });
    if !is_metal && (strength != 1.0 || color != [1.0; 3]) {
        let color = color.map(|channel| channel as f32);
        let layer = Specular { factor: strength as f32, color, ..Specular::default() };
        material.extensions.specular = Some(Box::new(layer));
    }
    Ok(with_alpha_mode(material))
}
