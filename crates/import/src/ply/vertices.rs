//! The vertices of a PLY file: positions, normals, texture coordinates, colors and scalars.

use super::body::Body;
use super::header::{Header, PlyElement, PlyProperty, ScalarType};
use gltf_import::ImportWarnings;
use gltf_import::{linear_from_srgb, linear_table};
use model::Diagnostic;

/// Index in a row for the value of an unused property.
const UNUSED: usize = 15;
/// Index in a row of red, which green, blue and alpha follow.
const COLOR: usize = 8;
/// Index in a row of the first base color component of a Gaussian splat.
const SPLAT_COLOR: usize = 12;
/// The spherical harmonic of degree 0: 1 / (2 √π).
const SH_DEGREE_0: f32 = 0.282_094_8;

/// The vertex attributes. Arrays that are present have one entry per vertex.
#[derive(Default, Debug)]
pub(crate) struct Vertices {
    /// Positions as stored in the file; they may be infinite or NaN.
    pub(crate) positions: Vec<[f32; 3]>,
    /// Normals of any length.
    pub(crate) normals: Option<Vec<[f32; 3]>>,
    /// Texture coordinates with (0, 0) at the upper left.
    pub(crate) uvs: Option<Vec<[f32; 2]>>,
    /// Linear colors with alpha.
    pub(crate) colors: Option<Vec<[f32; 4]>>,
    /// Values of the property to show as colors.
    pub(crate) scalars: Option<Vec<f64>>,
}

/// A vertex as stored in the file.
struct VertexRow {
    /// The known properties, by their [index](row_place).
    values: [f32; 16],
    /// The value of the property to show as colors, or NaN if there is none.
    scalar: f64,
}

/// Returns the index of a property in a row, which has the order x y z, nx ny nz, s t, red green
/// blue alpha, f_dc_0 to f_dc_2.
fn row_place(name: &str) -> usize {
    match name {
        "x" => 0,
        "y" => 1,
        "z" => 2,
        "nx" | "normal_x" => 3,
        "ny" | "normal_y" => 4,
        "nz" | "normal_z" => 5,
        "s" | "u" | "texture_u" | "texture_s" => 6,
        "t" | "v" | "texture_v" | "texture_t" => 7,
        "f_dc_0" => SPLAT_COLOR,
        "f_dc_1" => SPLAT_COLOR + 1,
        "f_dc_2" => SPLAT_COLOR + 2,
        _ => color_channel(name).map_or(UNUSED, |channel| COLOR + channel),
    }
}

/// Returns the color channel of a vertex or face property.
pub(super) fn color_channel(name: &str) -> Option<usize> {
    match name.strip_prefix("diffuse_").unwrap_or(name) {
        "red" | "r" => Some(0),
        "green" | "g" => Some(1),
        "blue" | "b" => Some(2),
        "alpha" | "a" => Some(3),
        _ => None,
    }
}

/// Returns the numeric vertex properties without a predefined meaning, by name in alphabetical
/// order and without duplicates.
pub(super) fn scalar_attributes(header: &Header) -> Vec<String> {
    let elements = header.elements.iter().filter(|element| element.name == "vertex");
    let properties = elements.flat_map(|element| &element.properties);
    let scalars = properties.filter(|p| p.list_length.is_none() && row_place(&p.name) == UNUSED);
    let mut names: Vec<String> = scalars.map(|property| property.name.clone()).collect();
    names.sort();
    names.dedup();
    names
}

/// Reads the vertices. `scalar` is the property that is read as the scalar of each vertex.
///
/// # Errors
/// Fails if the vertices lack x, y or z, or the file ends before the last vertex. In lenient mode,
/// the vertices before the error are used.
pub(super) fn read_vertices(
    body: &mut Body<'_>,
    element: &PlyElement,
    scalar: Option<&str>,
    warnings: &mut ImportWarnings,
) -> Result<Vertices, Diagnostic> {
    let places: Vec<usize> = element
        .properties
        .iter()
        .map(|p| if p.list_length.is_some() { UNUSED } else { row_place(&p.name) })
        .collect();
    let has = |wanted: usize, count: usize| (wanted..wanted + count).all(|p| places.contains(&p));
    if !has(0, 3) && element.count > 0 {
        return Err(body.fault("the vertices need the properties x, y and z"));
    }
    let is_splat = has(SPLAT_COLOR, 3) && !has(COLOR, 3);
    if is_splat {
        let message = "the vertices are Gaussian splats; their centers are shown as points";
        warnings.push_warning("element vertex", message);
    }
    let mut vertices = Vertices {
        positions: Vec::with_capacity(body.plausible_records(element)),
        normals: has(3, 3).then(Vec::new),
        uvs: has(6, 2).then(Vec::new),
        colors: (has(COLOR, 3) || is_splat).then(Vec::new),
        scalars: scalar.map(|_| Vec::new()),
    };
    let is_scalar = |p: &PlyProperty| p.list_length.is_none() && scalar == Some(&*p.name);
    let scalar = element.properties.iter().position(is_scalar);
    for _ in 0..element.count {
        match read_row(body, &element.properties, &places, scalar) {
            Ok(row) => {
                vertices.push_row(&row, is_splat);
                body.end_record();
            }
            Err(fault) => {
                warnings.downgrade_if_lenient(fault, "the remaining vertices are skipped")?;
                break;
            }
        }
    }
    vertices.finish_colors(&element.properties, warnings);
    Ok(vertices)
}

/// Reads a record. `places` has the row index of each property, and `scalar` is the index of the
/// property to show as colors.
fn read_row(
    body: &mut Body<'_>,
    properties: &[PlyProperty],
    places: &[usize],
    scalar: Option<usize>,
) -> Result<VertexRow, Diagnostic> {
    let mut row = VertexRow { values: [0.0; 16], scalar: f64::NAN };
    for (index, (property, &place)) in properties.iter().zip(places).enumerate() {
        match property.list_length {
            None => {
                let number = body.next_number(property.scalar)?;
                row.values[place] = number as f32;
                if scalar == Some(index) {
                    row.scalar = number;
                }
            }
            Some(length) => {
                let count = body.next_list_length(length, property.scalar)?;
                body.skip_numbers(count, property.scalar)?;
            }
        }
    }
    Ok(row)
}

impl Vertices {
    /// Adds a vertex. Its color is not yet decoded.
    fn push_row(&mut self, VertexRow { values: row, scalar }: &VertexRow, is_splat: bool) {
        self.positions.push([row[0], row[1], row[2]]);
        if let Some(scalars) = &mut self.scalars {
            scalars.push(*scalar);
        }
        if let Some(normals) = &mut self.normals {
            normals.push([row[3], row[4], row[5]]);
        }
        if let Some(uvs) = &mut self.uvs {
            uvs.push([row[6], 1.0 - row[7]]);
        }
        if let Some(colors) = &mut self.colors {
            let splat = |at: usize| (0.5 + SH_DEGREE_0 * row[SPLAT_COLOR + at]).clamp(0.0, 1.0);
            colors.push(if is_splat {
                [splat(0), splat(1), splat(2), 1.0]
            } else {
                [row[COLOR], row[COLOR + 1], row[COLOR + 2], row[COLOR + 3]]
            });
        }
    }

    /// Decodes the colors, which are still raw values from the file.
    fn finish_colors(&mut self, properties: &[PlyProperty], warnings: &mut ImportWarnings) {
        if let Some(colors) = &mut self.colors {
            linearize_colors(colors, properties, warnings, "element vertex");
        }
    }
}

/// Decodes sRGB colors from raw values: bytes, other integers, or floats.
///
/// If floats exceed 1, all are treated as values up to 255, which some programs write. Alpha is 1
/// if the file has no alpha or if it is 0 everywhere.
pub(super) fn linearize_colors(
    colors: &mut [[f32; 4]],
    properties: &[PlyProperty],
    warnings: &mut ImportWarnings,
    location: &str,
) {
    let scalar_of = |channel| {
        let mut properties = properties.iter().filter(|property| property.list_length.is_none());
        properties.find(|p| color_channel(&p.name) == Some(channel)).map(|p| p.scalar)
    };
    let scalar = scalar_of(0).unwrap_or(ScalarType::F32);
    let alpha = scalar_of(3);
    let mut scales = [scalar.color_scale(), alpha.map_or(1.0, ScalarType::color_scale)];
    if scales[0] == 1.0 && colors.iter().any(|color| color[..3].iter().any(|&x| x > 1.0)) {
        warnings
            .push_warning(location, "the colors exceed 1; they are read as numbers from 0 to 255");
        scales[0] = 255.0;
        if alpha == Some(scalar) {
            scales[1] = 255.0;
        }
    }
    let has_alpha = alpha.is_some() && colors.iter().any(|color| color[3] > 0.0);
    if alpha.is_some() && !has_alpha && !colors.is_empty() {
        warnings.push_warning(location, "alpha is 0 everywhere; the colors are treated as opaque");
    }
    let table = linear_table();
    for color in colors {
        for channel in &mut color[..3] {
            // The cast maps NaN to 0.
            *channel = match scalar {
                ScalarType::U8 => table[usize::from(*channel as u8)],
                _ => linear_from_srgb(clamp_to_unit(*channel / scales[0])),
            };
        }
        color[3] = if has_alpha { clamp_to_unit(color[3] / scales[1]) } else { 1.0 };
    }
}

/// Returns the nearest number in [0, 1], or 0 for NaN.
fn clamp_to_unit(value: f32) -> f32 {
    if value > 0.0 { value.min(1.0) } else { 0.0 }
}
