//! A ray tracer for spheres and rectangles, with one ray through the center of every pixel and
//! exact intersections.

use super::brdf::{Lights, Material};
use crate::references::picture::Picture;
use glam::DVec3;

/// A surface in the world.
#[derive(Clone, Copy, Debug)]
pub enum Shape {
    /// A sphere.
    Sphere { center: DVec3, radius: f64 },
    /// A rectangle from a vertex along two perpendicular edges, facing `right × up`.
    Rectangle { origin: DVec3, right: DVec3, up: DVec3 },
}

/// A shape and its material.
#[derive(Clone, Copy, Debug)]
pub struct Surface {
    pub shape: Shape,
    pub material: Material,
}

/// A camera: eye, target, view-up vector, and vertical field of view in degrees.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    pub eye: DVec3,
    pub target: DVec3,
    pub up: DVec3,
    pub fov_y_degrees: f64,
}

/// A picture to compute.
#[derive(Clone, Debug)]
pub struct World {
    pub surfaces: Vec<Surface>,
    pub camera: Camera,
    pub lights: Lights,
    /// The background in sRGB codes.
    pub background: [u8; 3],
}

impl Shape {
    /// Returns the distance and unit normal where a ray first hits the front of the shape.
    fn intersect(&self, origin: DVec3, direction: DVec3) -> Option<(f64, DVec3)> {
        match *self {
            Self::Sphere { center, radius } => {
                let offset = origin - center;
                let half = offset.dot(direction);
                let discriminant = half * half - offset.length_squared() + radius * radius;
                let distance = -half - (discriminant >= 0.0).then(|| discriminant.sqrt())?;
                let normal = (offset + direction * distance) / radius;
                (distance > 0.0).then_some((distance, normal))
            }
            Self::Rectangle { origin: vertex, right, up } => {
                let normal = right.cross(up).normalize();
                let slope = normal.dot(direction);
                let distance = normal.dot(vertex - origin) / slope;
                let inside = origin + direction * distance - vertex;
                let fraction = |edge: DVec3| inside.dot(edge) / edge.length_squared();
                let unit = 0.0..=1.0;
                let hit = slope < 0.0
                    && distance > 0.0
                    && unit.contains(&fraction(right))
                    && unit.contains(&fraction(up));
                hit.then_some((distance, normal))
            }
        }
    }
}

impl World {
    /// Renders the picture with one sample per pixel.
    pub fn render(&self, width: u32, height: u32) -> Picture {
        let Camera { eye, target, up, fov_y_degrees } = self.camera;
        let backward = (eye - target).normalize();
        let right = up.cross(backward).normalize();
        let upward = backward.cross(right);
        let half_height = libm::tan(fov_y_degrees.to_radians() / 2.0);
        let half_width = half_height * f64::from(width) / f64::from(height);
        let pixels = (0..width * height).map(|index| {
            let (column, row) = (index % width, index / width);
            let x = (2.0 * (f64::from(column) + 0.5) / f64::from(width) - 1.0) * half_width;
            let y = (1.0 - 2.0 * (f64::from(row) + 0.5) / f64::from(height)) * half_height;
            self.trace(eye, (right * x + upward * y - backward).normalize())
        });
        Picture { width, height, pixels: pixels.collect() }
    }

    /// Returns the color along a ray. All surfaces are blended from back to front in linear light.
    fn trace(&self, eye: DVec3, direction: DVec3) -> [u8; 3] {
        let hit = |surface: &Surface| {
            let (distance, normal) = surface.shape.intersect(eye, direction)?;
            Some((distance, normal, surface.material))
        };
        let mut hits: Vec<(f64, DVec3, Material)> = self.surfaces.iter().filter_map(hit).collect();
        hits.sort_by(|a, b| b.0.total_cmp(&a.0));
        if hits.is_empty() {
            return self.background;
        }
        let mut color = self.background.map(decode_srgb);
        for (_, normal, material) in hits {
            let shaded = material.shade(normal, -direction, &self.lights);
            for channel in 0..3 {
                color[channel] += (shaded[channel] - color[channel]) * material.alpha;
            }
        }
        color.map(encode_srgb)
    }
}

/// Converts an sRGB code to linear light (IEC 61966-2-1).
fn decode_srgb(code: u8) -> f64 {
    let encoded = f64::from(code) / 255.0;
    if encoded <= 0.04045 { encoded / 12.92 } else { libm::pow((encoded + 0.055) / 1.055, 2.4) }
}

/// Clamps linear light to the range from 0 to 1, and returns the nearest sRGB code.
fn encode_srgb(light: f64) -> u8 {
    let light = light.clamp(0.0, 1.0);
    let encoded = if light <= 0.0031308 {
        12.92 * light
    } else {
        1.055 * libm::pow(light, 1.0 / 2.4) - 0.055
    };
    libm::round(encoded * 255.0) as u8
}
