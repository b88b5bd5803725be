//! Texture transforms (KHR_texture_transform): offset, rotation and scale of texture coordinates.

use crate::{TextureInfo, TextureSlot};

/// The transform of the texture in one material slot: scale, then rotate, then translate.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct UvTransform {
    /// Index of the material.
    pub material: usize,
    /// The slot of the material.
    pub slot: TextureSlot,
    /// Translation.
    pub offset: [f32; 2],
    /// Rotation in radians, counter-clockwise in an image in which v points down.
    pub rotation: f32,
    /// Scale factors.
    pub scale: [f32; 2],
}

/// An animatable property of a [`UvTransform`].
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum UvTransformPart {
    /// Translation, two numbers.
    Offset,
    /// Rotation, one number.
    Rotation,
    /// Scale factors, two numbers.
    Scale,
}

impl UvTransform {
    /// Returns the composed transform for [`TextureInfo::uv_matrix`], or the identity if a number
    /// is not finite.
    #[must_use]
    pub fn to_matrix(&self) -> [[f32; 3]; 2] {
        let ([u, v], [width, height]) = (self.offset, self.scale);
        let angle = f64::from(self.rotation);
        let (sin, cos) = (libm::sin(angle) as f32, libm::cos(angle) as f32);
        let map = [[cos * width, sin * height, u], [-sin * width, cos * height, v]];
        if map.as_flattened().iter().all(|x| x.is_finite()) {
            map
        } else {
            TextureInfo::IDENTITY_UV
        }
    }

    /// Sets a property. A value with the wrong number of components is ignored.
    pub fn set_part(&mut self, part: UvTransformPart, value: &[f64]) {
        match (part, value) {
            (UvTransformPart::Offset, &[u, v]) => self.offset = [u as f32, v as f32],
            (UvTransformPart::Rotation, &[angle]) => self.rotation = angle as f32,
            (UvTransformPart::Scale, &[u, v]) => self.scale = [u as f32, v as f32],
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rotation_about_the_origin_precedes_translation() {
        let mut transform = UvTransform {
            material: 0,
            slot: TextureSlot::Normal,
            offset: [0.0; 2],
            rotation: 0.0,
            scale: [1.0; 2],
        };
        assert_eq!(transform.to_matrix(), TextureInfo::IDENTITY_UV);
        transform.set_part(UvTransformPart::Offset, &[0.5, 0.25]);
        transform.set_part(UvTransformPart::Rotation, &[std::f64::consts::FRAC_PI_2]);
        transform.set_part(UvTransformPart::Scale, &[2.0, 3.0]);
        transform.set_part(UvTransformPart::Scale, &[9.0]);
        let map = transform.to_matrix();
        let image = |u: f32, v: f32| map.map(|row| row[0] * u + row[1] * v + row[2]);
        let near =
            |a: [f32; 2], b: [f32; 2]| (a[0] - b[0]).abs() < 1e-6 && (a[1] - b[1]).abs() < 1e-6;
        assert!(near(image(0.0, 0.0), [0.5, 0.25]));
        assert!(near(image(1.0, 0.0), [0.5, 0.25 - 2.0]));
        assert!(near(image(0.0, 1.0), [0.5 + 3.0, 0.25]));
    }
}
