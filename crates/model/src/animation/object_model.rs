//! Animatable properties of materials, lights and cameras, by their JSON pointers (glTF Object
//! Model).
//!
//! KHR_animation_pointer identifies its targets with these pointers. The importer uses the same
//! tables for the location and bounds of each number in the KHR_materials extensions, so each
//! property is declared only once:
//!
//! ```text
//!  property_row("extensions/KHR_materials_sheen/sheenColorFactor", 3, UNIT_RANGE, |m| …)
//!                 JSON pointer into the material                   │  │           access
//!                                                         components  bounds
//! ```
//!
//! Values set by an animation are clamped to the bounds, and dependent fields are updated. To add a
//! property, add a row.

use crate::{AlphaMode, CameraProjection, LightKind, Material, PunctualLight};
use std::f32::consts::FRAC_PI_2;
use std::f64::consts::PI;

/// An animatable property of a material, light or camera, as an index into a property table.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ObjectProperty {
    /// A property of a material.
    Material(usize),
    /// A property of a light.
    Light(usize),
    /// A property of a camera.
    Camera(usize),
}

/// A row of a property table: the pointer, number of components, bounds, and access to the numbers.
#[derive(Debug)]
pub struct PropertyRow<T> {
    /// JSON pointer into the object, without the leading slash.
    pub path: &'static str,
    /// Number of components.
    pub component_count: usize,
    /// The minimum and maximum allowed values.
    pub bounds: [f32; 2],
    /// Access to the numbers, or `None` if the object lacks the extension or texture they belong
    /// to.
    pub numbers_mut: fn(&mut T) -> Option<&mut [f32]>,
}

/// Creates a row of a property table, with the arguments in the order of the module's figure.
const fn property_row<T>(
    path: &'static str,
    width: usize,
    bounds: [f32; 2],
    numbers: fn(&mut T) -> Option<&mut [f32]>,
) -> PropertyRow<T> {
    PropertyRow { path, component_count: width, bounds, numbers_mut: numbers }
}

/// Bounds for factors and colors: [0, 1].
const UNIT_RANGE: [f32; 2] = [0.0, 1.0];
/// Bounds for intensities, thicknesses and similar numbers: finite and at least 0.
const NON_NEGATIVE: [f32; 2] = [0.0, f32::MAX];
/// Bounds for scales and angles: any finite number.
const UNBOUNDED: [f32; 2] = [f32::MIN, f32::MAX];
/// Bounds for the emissive strength. A larger strength would be a mistake, and products with it
/// could overflow.
const EMISSIVE_STRENGTH_RANGE: [f32; 2] = [0.0, 1e6];
/// Bounds that exclude zero: the minimum is the smallest normal number.
const STRICTLY_POSITIVE: [f32; 2] = [f32::MIN_POSITIVE, f32::MAX];

/// Returns access to a single number as a slice of length 1.
fn single_number(number: &mut f32) -> Option<&mut [f32]> {
    Some(std::slice::from_mut(number))
}

/// The animatable properties of materials.
#[rustfmt::skip]
pub static MATERIAL_PROPERTIES: [PropertyRow<Material>; 30] = [
    property_row("pbrMetallicRoughness/baseColorFactor", 4, UNIT_RANGE, |m| Some(&mut m.base_color)),
    property_row("pbrMetallicRoughness/metallicFactor", 1, UNIT_RANGE, |m| single_number(&mut m.metallic)),
    property_row("pbrMetallicRoughness/roughnessFactor", 1, UNIT_RANGE, |m| single_number(&mut m.roughness)),
    property_row("emissiveFactor", 3, UNIT_RANGE, |m| Some(&mut m.emission.color)),
    property_row("alphaCutoff", 1, NON_NEGATIVE, |m| match &mut m.alpha_mode {
        AlphaMode::Mask { cutoff } => single_number(cutoff),
        _ => None,
    }),
    property_row("normalTexture/scale", 1, UNBOUNDED, |m| single_number(&mut m.normal_texture.as_mut()?.scale)),
    property_row("occlusionTexture/strength", 1, UNIT_RANGE, |m| single_number(&mut m.occlusion_texture.as_mut()?.strength)),
    property_row("extensions/KHR_materials_emissive_strength/emissiveStrength", 1, EMISSIVE_STRENGTH_RANGE, |m| single_number(&mut m.emission.strength)),
    property_row("extensions/KHR_materials_ior/ior", 1, NON_NEGATIVE, |m| single_number(&mut m.extensions.ior)),
    property_row("extensions/KHR_materials_dispersion/dispersion", 1, NON_NEGATIVE, |m| single_number(&mut m.extensions.dispersion)),
    property_row("extensions/KHR_materials_specular/specularFactor", 1, UNIT_RANGE, |m| single_number(&mut m.extensions.specular.as_mut()?.factor)),
    property_row("extensions/KHR_materials_specular/specularColorFactor", 3, NON_NEGATIVE, |m| Some(&mut m.extensions.specular.as_mut()?.color)),
    property_row("extensions/KHR_materials_pbrSpecularGlossiness/diffuseFactor", 4, UNIT_RANGE, |m| m.extensions.specular_glossiness.is_some().then_some(m.base_color.as_mut_slice())),
    property_row("extensions/KHR_materials_pbrSpecularGlossiness/specularFactor", 3, UNIT_RANGE, |m| Some(&mut m.extensions.specular_glossiness.as_mut()?.specular)),
    property_row("extensions/KHR_materials_pbrSpecularGlossiness/glossinessFactor", 1, UNIT_RANGE, |m| single_number(&mut m.extensions.specular_glossiness.as_mut()?.glossiness)),
    property_row("extensions/KHR_materials_clearcoat/clearcoatFactor", 1, UNIT_RANGE, |m| single_number(&mut m.extensions.clearcoat.as_mut()?.factor)),
    property_row("extensions/KHR_materials_clearcoat/clearcoatRoughnessFactor", 1, UNIT_RANGE, |m| single_number(&mut m.extensions.clearcoat.as_mut()?.roughness)),
    property_row("extensions/KHR_materials_clearcoat/clearcoatNormalTexture/scale", 1, UNBOUNDED, |m| single_number(&mut m.extensions.clearcoat.as_mut()?.normal_texture.as_mut()?.scale)),
    property_row("extensions/KHR_materials_sheen/sheenColorFactor", 3, UNIT_RANGE, |m| Some(&mut m.extensions.sheen.as_mut()?.color)),
    property_row("extensions/KHR_materials_sheen/sheenRoughnessFactor", 1, UNIT_RANGE, |m| single_number(&mut m.extensions.sheen.as_mut()?.roughness)),
    property_row("extensions/KHR_materials_transmission/transmissionFactor", 1, UNIT_RANGE, |m| single_number(&mut m.extensions.transmission.as_mut()?.factor)),
    property_row("extensions/KHR_materials_volume/thicknessFactor", 1, NON_NEGATIVE, |m| single_number(&mut m.extensions.volume.as_mut()?.thickness)),
    property_row("extensions/KHR_materials_volume/attenuationDistance", 1, STRICTLY_POSITIVE, |m| single_number(&mut m.extensions.volume.as_mut()?.attenuation_distance)),
    property_row("extensions/KHR_materials_volume/attenuationColor", 3, UNIT_RANGE, |m| Some(&mut m.extensions.volume.as_mut()?.attenuation_color)),
    property_row("extensions/KHR_materials_iridescence/iridescenceFactor", 1, UNIT_RANGE, |m| single_number(&mut m.extensions.iridescence.as_mut()?.factor)),
    property_row("extensions/KHR_materials_iridescence/iridescenceIor", 1, [1.0, f32::MAX], |m| single_number(&mut m.extensions.iridescence.as_mut()?.ior)),
    property_row("extensions/KHR_materials_iridescence/iridescenceThicknessMinimum", 1, NON_NEGATIVE, |m| single_number(&mut m.extensions.iridescence.as_mut()?.thickness_minimum)),
    property_row("extensions/KHR_materials_iridescence/iridescenceThicknessMaximum", 1, NON_NEGATIVE, |m| single_number(&mut m.extensions.iridescence.as_mut()?.thickness_maximum)),
    property_row("extensions/KHR_materials_anisotropy/anisotropyStrength", 1, UNIT_RANGE, |m| single_number(&mut m.extensions.anisotropy.as_mut()?.strength)),
    property_row("extensions/KHR_materials_anisotropy/anisotropyRotation", 1, UNBOUNDED, |m| single_number(&mut m.extensions.anisotropy.as_mut()?.rotation)),
];

/// The animatable properties of lights.
#[rustfmt::skip]
pub static LIGHT_PROPERTIES: [PropertyRow<PunctualLight>; 5] = [
    property_row("color", 3, UNIT_RANGE, |light| Some(&mut light.color)),
    property_row("intensity", 1, NON_NEGATIVE, |light| single_number(&mut light.intensity)),
    property_row("range", 1, STRICTLY_POSITIVE, |light| match &mut light.kind {
        LightKind::Point { range } | LightKind::Spot { range, .. } => single_number(range),
        LightKind::Directional => None,
    }),
    property_row("spot/innerConeAngle", 1, [0.0, FRAC_PI_2], |light| match &mut light.kind {
        LightKind::Spot { inner_cone_angle: inner, .. } => single_number(inner),
        _ => None,
    }),
    property_row("spot/outerConeAngle", 1, [0.0, FRAC_PI_2], |light| match &mut light.kind {
        LightKind::Spot { outer_cone_angle: outer, .. } => single_number(outer),
        _ => None,
    }),
];

/// The animatable properties of cameras, with one number each. The first four are for perspective
/// cameras.
const CAMERA_PROPERTIES: [&str; 8] = [
    "perspective/yfov",
    "perspective/aspectRatio",
    "perspective/znear",
    "perspective/zfar",
    "orthographic/xmag",
    "orthographic/ymag",
    "orthographic/znear",
    "orthographic/zfar",
];

impl ObjectProperty {
    /// Returns the material property at a JSON pointer into the material, without the leading
    /// slash.
    #[must_use]
    pub fn for_material(path: &str) -> Option<Self> {
        MATERIAL_PROPERTIES.iter().position(|row| row.path == path).map(Self::Material)
    }

    /// Returns the light property at a JSON pointer into the light, without the leading slash.
    #[must_use]
    pub fn for_light(path: &str) -> Option<Self> {
        LIGHT_PROPERTIES.iter().position(|row| row.path == path).map(Self::Light)
    }

    /// Returns the camera property at a JSON pointer into the camera, without the leading slash.
    #[must_use]
    pub fn for_camera(path: &str) -> Option<Self> {
        CAMERA_PROPERTIES.iter().position(|row| *row == path).map(Self::Camera)
    }

    /// Returns the JSON pointer to this property of the material, light or camera at an index.
    #[must_use]
    pub fn json_pointer(self, of: usize) -> String {
        let (list, path) = match self {
            Self::Material(row_index) => {
                ("materials", MATERIAL_PROPERTIES.get(row_index).map(|row| row.path))
            }
            Self::Light(row_index) => (
                "extensions/KHR_lights_punctual/lights",
                LIGHT_PROPERTIES.get(row_index).map(|row| row.path),
            ),
            Self::Camera(row_index) => ("cameras", CAMERA_PROPERTIES.get(row_index).copied()),
        };
        format!("/{list}/{of}/{}", path.unwrap_or_default())
    }

    /// Returns the number of components.
    #[must_use]
    pub fn component_count(self) -> usize {
        match self {
            Self::Material(row_index) => {
                MATERIAL_PROPERTIES.get(row_index).map_or(0, |row| row.component_count)
            }
            Self::Light(row_index) => {
                LIGHT_PROPERTIES.get(row_index).map_or(0, |row| row.component_count)
            }
            Self::Camera(_) => 1,
        }
    }
}

/// Sets the components of a property, each clamped to its bounds.
///
/// Returns `None` if the object lacks the property. Values that are not finite or have the wrong
/// length are ignored.
///
/// Clamping keeps materials valid for every animation; even in a valid file, a cubic spline may
/// overshoot its keyframes.
fn set_clamped<T>(
    table: &[PropertyRow<T>],
    row_index: usize,
    object: &mut T,
    value: &[f64],
) -> Option<()> {
    let row = table.get(row_index)?;
    let numbers = (row.numbers_mut)(object)?;
    if numbers.len() == value.len() && value.iter().all(|x| x.is_finite()) {
        for (number, &value) in numbers.iter_mut().zip(value) {
            *number = (value as f32).clamp(row.bounds[0], row.bounds[1]);
        }
    }
    Some(())
}

impl Material {
    /// Sets a property, clamped to its bounds.
    pub fn set_property(&mut self, row_index: usize, value: &[f64]) {
        set_clamped(&MATERIAL_PROPERTIES, row_index, self, value);
        self.update_derived();
    }

    /// Recomputes the emitted radiance and the metallic-roughness approximation of
    /// specular-glossiness, and makes the index of refraction valid.
    pub fn update_derived(&mut self) {
        self.emissive = self.emission.scaled_color();
        if self.extensions.ior > 0.0 {
            self.extensions.ior = self.extensions.ior.max(1.0);
        }
        if let Some(spec_gloss) = &self.extensions.specular_glossiness {
            self.metallic = 0.0;
            self.roughness = 1.0 - spec_gloss.glossiness;
        }
    }
}

impl PunctualLight {
    /// Sets a property, clamped to its bounds.
    pub fn set_property(&mut self, row_index: usize, value: &[f64]) {
        set_clamped(&LIGHT_PROPERTIES, row_index, self, value);
        self.order_cone_angles();
    }

    /// Restores the invariant inner < outer for the cone angles of a spot light.
    ///
    /// Shading divides by the difference of their cosines. Both corrections are far too small to be
    /// visible.
    pub fn order_cone_angles(&mut self) {
        if let LightKind::Spot { inner_cone_angle: inner, outer_cone_angle: outer, .. } =
            &mut self.kind
        {
            *outer = outer.max(1e-4);
            *inner = inner.min(*outer * 0.9999);
        }
    }
}

impl CameraProjection {
    /// Sets a number unless the projection would become invalid.
    ///
    /// The change is made in a copy and validated as a whole, because validity involves two
    /// numbers: near must remain less than far.
    pub fn set_property(&mut self, row_index: usize, value: f64) {
        let mut changed = *self;
        match (&mut changed, row_index) {
            (Self::Perspective { fov_y, .. }, 0) => *fov_y = value,
            (Self::Perspective { aspect, .. }, 1) => *aspect = Some(value),
            (Self::Perspective { near, .. }, 2) | (Self::Orthographic { near, .. }, 6) => {
                *near = value;
            }
            (Self::Perspective { far, .. }, 3) | (Self::Orthographic { far, .. }, 7) => {
                *far = value;
            }
            (Self::Orthographic { half_width, .. }, 4) => *half_width = value.abs(),
            (Self::Orthographic { half_height, .. }, 5) => *half_height = value.abs(),
            _ => return,
        }
        if value.is_finite() && changed.is_valid() {
            *self = changed;
        }
    }

    /// Returns whether this type of projection has the property.
    pub fn has_property(&self, field: ObjectProperty) -> bool {
        match (self, field) {
            (Self::Perspective { .. }, ObjectProperty::Camera(row_index)) => row_index < 4,
            (Self::Orthographic { .. }, ObjectProperty::Camera(row_index)) => row_index >= 4,
            _ => false,
        }
    }

    /// Returns whether the parameters define a view volume.
    fn is_valid(&self) -> bool {
        match *self {
            Self::Perspective { fov_y, aspect, near, far } => {
                fov_y > 0.0
                    && fov_y < PI
                    && aspect.is_none_or(|a| a > 0.0)
                    && near > 0.0
                    && far > near
            }
            Self::Orthographic { half_width, half_height, near, far } => {
                half_width > 0.0 && half_height > 0.0 && near >= 0.0 && far > near
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Volume;

    #[test]
    fn every_row_has_its_declared_number_of_components() {
        let mut material = Material::default();
        let extensions = &mut material.extensions;
        extensions.specular = Some(Box::default());
        extensions.volume = Some(Box::new(Volume::default()));
        extensions.iridescence = Some(Box::default());
        for PropertyRow {
            path,
            component_count: width,
            bounds: [min, max],
            numbers_mut: numbers,
        } in &MATERIAL_PROPERTIES
        {
            if let Some(numbers) = numbers(&mut material) {
                assert_eq!(numbers.len(), *width, "{path}");
                let inside = numbers.iter().all(|x| x >= min && (x <= max || x.is_infinite()));
                assert!(inside, "{path}: the default is out of bounds");
            }
        }
        assert_eq!(
            ObjectProperty::for_material("emissiveFactor").map(ObjectProperty::component_count),
            Some(3)
        );
        assert_eq!(
            ObjectProperty::for_light("intensity").map(ObjectProperty::component_count),
            Some(1)
        );
        assert_eq!(ObjectProperty::for_camera("perspective/fov"), None);
    }

    #[test]
    fn properties_are_clamped_and_dependent_fields_updated() {
        let mut material = Material::default();
        let field = |path| match ObjectProperty::for_material(path) {
            Some(ObjectProperty::Material(row_index)) => row_index,
            _ => panic!("{path}"),
        };
        material.set_property(field("emissiveFactor"), &[0.5, 2.0, -1.0]);
        material.set_property(
            field("extensions/KHR_materials_emissive_strength/emissiveStrength"),
            &[4.0],
        );
        assert_eq!(material.emissive, [2.0, 4.0, 0.0]);
        material.set_property(field("extensions/KHR_materials_ior/ior"), &[0.5]);
        assert_eq!(material.extensions.ior, 1.0);
        material.set_property(field("extensions/KHR_materials_ior/ior"), &[0.0]);
        assert_eq!(material.extensions.ior, 0.0);
        material.set_property(field("pbrMetallicRoughness/baseColorFactor"), &[0.5; 3]);
        assert_eq!(material.base_color, [1.0; 4], "three numbers are not a color with alpha");
    }

    #[test]
    fn cameras_stay_valid() {
        let mut lens =
            CameraProjection::Perspective { fov_y: 1.0, aspect: None, near: 1.0, far: 2.0 };
        lens.set_property(0, 0.5);
        lens.set_property(2, 3.0);
        lens.set_property(3, f64::NAN);
        lens.set_property(7, 9.0);
        let expected =
            CameraProjection::Perspective { fov_y: 0.5, aspect: None, near: 1.0, far: 2.0 };
        assert_eq!(lens, expected);
    }
}
