//! Cube shadow map fitting: the six cameras for a point light, cropped to its casters.
//!
//! ```text
//!   ╲           ╱    a face covers 90° plus a margin as wide as the filter's disc around a
//!    ╲┌──────┐ ╱     receiver at the border. Its window is cropped to its casters.
//!     │ ▟▛   │╱      All faces have the same texel size and near and far planes, so a
//!     └──────●───    border looks the same from both sides.
//!            │ light
//! ```
//! A face has no map if it has no casters or if the light reaches nothing in the view through it.

use super::light_fitting::{BORDER_TEXELS, LightCamera, ViewBounds, view_volume_corners};
use camera::{Basis, Camera, ViewProjection};
use glam::DVec3;
use homog::{Vector, World};
use model::{ModelInstance, Topology};
use projection::{Convention, Frustum, Window};
use scene::Scene;
use shade::{Light, Shadow, ShadowCube};

/// The directions of the faces, in the order of [`ShadowCube::faces`].
const FACE_DIRECTIONS: [[f64; 3]; 6] = [
    [1.0, 0.0, 0.0],
    [-1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, -1.0, 0.0],
    [0.0, 0.0, 1.0],
    [0.0, 0.0, -1.0],
];
/// The maximum total number of texels in the faces of all point lights, to limit memory to 0.8 GB.
/// With more lights the faces are smaller.
const MAX_CUBE_TEXELS: f64 = (1_u32 << 26) as f64;
/// The maximum ratio of the far distance to the near distance, for precision.
const MAX_DEPTH_RATIO: f64 = 1e3;

/// The cameras for a point light.
pub(super) struct CubeCameras {
    /// The cameras for the faces, in the order of [`ShadowCube::faces`].
    pub(super) faces: [Option<LightCamera>; 6],
    /// The position of the light.
    position: [f32; 3],
    /// The tangent of half the angle that the light subtends.
    spread: f64,
    /// The distance from the light to the near plane of each face.
    near: f64,
    /// The side length of a texel at distance 1.
    texel: f64,
}

impl CubeCameras {
    /// Fits cameras to a point light that casts shadows. Returns `None` for other lights and if no
    /// triangle casts a shadow.
    pub(super) fn fit_to_light(scene: &Scene, light: &Light, shadow: Shadow) -> Option<Self> {
        let Light::Point { position, range, .. } = *light else { return None };
        let eye = DVec3::from(position.map(f64::from));
        let max_slope = overlap_slope(f64::from(ShadowCube::MAX_PENUMBRA));
        let casters = CubeCasters::from_models(&scene.models, eye, f64::from(range), max_slope)?;
        let far = casters.farthest * 1.01;
        let near = (casters.nearest * 0.99).max(far / MAX_DEPTH_RATIO);
        let spread = libm::tan(0.5 * f64::from(shadow.softness));
        let texel = 2.0 / face_resolution(scene, shadow);
        let radius = (spread * (far / near - 1.0)).max(2.0 * texel);
        let slope = overlap_slope(radius.min(f64::from(ShadowCube::MAX_PENUMBRA)));
        let visible = visible_faces(scene, eye, max_slope);
        let faces = std::array::from_fn(|face| {
            let bounds = casters.slopes[face];
            let has_casters = bounds.min.x <= bounds.max.x;
            let window = CroppedWindow::around(bounds, slope, texel);
            (visible[face] && has_casters)
                .then(|| fit_face(eye, FACE_DIRECTIONS[face], &window?, [near, far]))
                .flatten()
        });
        Some(Self { faces, position, spread, near, texel })
    }

    /// Returns the shadow cube that consists of the maps rendered with these cameras.
    pub(super) fn to_cube(&self, faces: [Option<shade::ShadowMap>; 6]) -> ShadowCube {
        let (position, spread) = (self.position, self.spread as f32);
        let (nearest, texel) = (self.near as f32, self.texel as f32);
        ShadowCube { position, faces, spread, nearest, texel }
    }
}

/// Returns the slope of the outermost direction on a disc of this radius around a direction at 45°
/// from the axis.
///
/// The worst case is the corner of a face, where all coordinates are 1/√3. The disc moves x by r/√2
/// and the axis coordinate by −r/√2.
fn overlap_slope(radius: f64) -> f64 {
    let part = 1.5_f64.sqrt() * radius;
    (1.0 + part) / (1.0 - part)
}

/// Returns the number of texels per 90° of a face: the requested number, or fewer if there are many
/// lights.
fn face_resolution(scene: &Scene, shadow: Shadow) -> f64 {
    let is_cube = |light: &&Light| matches!(light, Light::Point { shadow: Some(_), .. });
    let cubes = scene.lights.iter().filter(is_cube).count().max(1) as f64;
    let overlap = overlap_slope(f64::from(ShadowCube::MAX_PENUMBRA));
    let limit = (MAX_CUBE_TEXELS / (6.0 * cubes)).sqrt() / overlap;
    f64::from(shadow.resolution).min(limit.floor()).max(16.0)
}

/// Returns the camera of one face.
fn fit_face(
    eye: DVec3,
    direction: [f64; 3],
    cropped: &CroppedWindow,
    [near, far]: [f64; 2],
) -> Option<LightCamera> {
    let gaze = Vector::<World>::from(direction);
    let basis = Basis::from_gaze_or_fallback(gaze, Vector::Y).ok()?;
    let camera = Camera::new(eye.to_array().into(), basis).ok()?;
    let frustum = Frustum::from_slopes(cropped.window, near, far).ok()?;
    Some(LightCamera {
        view_projection: ViewProjection {
            camera,
            view_to_clip: frustum.view_to_clip(Convention::CHAPTER),
        },
        size: cropped.size,
        center: eye + gaze.raw() * (0.5 * (near + far)),
        // All faces of the cube share one penumbra.
        penumbra: 0.0,
        depth_at_infinity: Some(-near / (far - near)),
    })
}

/// A window on the texel grid of a whole face.
struct CroppedWindow {
    /// The window at distance 1.
    window: Window,
    /// Width and height in texels, at least 16.
    size: [u32; 2],
}

impl CroppedWindow {
    /// Returns the window around slopes with a margin for the filter, within `slope` of the axis.
    fn around(bounds: ViewBounds, slope: f64, texel: f64) -> Option<Self> {
        let room = ((slope - 1.0) / texel).ceil() + BORDER_TEXELS;
        let end = (slope / texel).ceil() + BORDER_TEXELS;
        let span = |min: f64, max: f64| {
            let first = ((min / texel).floor() - room).max(-end);
            let last = ((max / texel).ceil() + room).min(end).max(first + 16.0);
            (first * texel, last * texel, (last - first) as u32)
        };
        let (left, right, width) = span(bounds.min.x, bounds.max.x);
        let (bottom, top, height) = span(bounds.min.y, bounds.max.y);
        let window = Window::new(left, right, bottom, top).ok()?;
        Some(Self { window, size: [width, height] })
    }
}

/// Converts a position relative to the light to the coordinates of a face: right, up and along the
/// face's axis.
fn face_coordinates(face: usize, p: DVec3) -> DVec3 {
    // The axes of `Basis::from_gaze_or_fallback` for these directions.
    match face {
        0 => DVec3::new(p.z, p.y, p.x),
        1 => DVec3::new(-p.z, p.y, -p.x),
        2 => DVec3::new(p.x, p.z, p.y),
        3 => DVec3::new(p.x, -p.z, -p.y),
        4 => DVec3::new(-p.x, p.y, p.z),
        _ => DVec3::new(p.x, p.y, -p.z),
    }
}

/// Returns five bits per face, one for each plane of the face that a position is outside of.
///
/// A triangle or a volume is outside a face if all its corners share one of the face's bits.
fn outside_bits(p: DVec3, slope: f64) -> u32 {
    (0..6).fold(0, |bits, face| {
        let DVec3 { x, y, z } = face_coordinates(face, p);
        let limit = slope * z;
        let outside = [z <= 0.0, x > limit, -x > limit, y > limit, -y > limit];
        let own = (0..5).fold(0, |own, side| own | u32::from(outside[side]) << side);
        bits | own << (5 * face)
    })
}

/// Whether the bits that all positions share place them outside a face.
const fn is_outside_of(face: usize, common_bits: u32) -> bool {
    common_bits >> (5 * face) & 31 != 0
}

/// Returns the faces through which the light reaches anything in the view.
///
/// All of the ground counts, because it is drawn beyond the far plane of the view too.
fn visible_faces(scene: &Scene, eye: DVec3, slope: f64) -> [bool; 6] {
    let Some(corners) = view_volume_corners(scene) else { return [true; 6] };
    let ground = scene.ground.iter().flat_map(|ground| ground.corners);
    let points = corners.into_iter().chain(ground.map(|corner| corner.map(f64::from).into()));
    let common = points.fold(u32::MAX, |common, point| common & outside_bits(point - eye, slope));
    std::array::from_fn(|face| !is_outside_of(face, common))
}

/// The extent and distances of the triangles around a point light.
struct CubeCasters {
    /// The slopes of the triangles on each face; empty if there are no triangles.
    slopes: [ViewBounds; 6],
    /// A distance along the axes within which there are no triangles.
    nearest: f64,
    /// The maximum vertex distance along the axes.
    farthest: f64,
}

impl CubeCasters {
    /// Collects the triangles of the models that begin within the range of a light at `eye`, or
    /// returns `None` if there are none.
    ///
    /// Slopes are bounded by `max_slope`.
    fn from_models(
        models: &[ModelInstance],
        eye: DVec3,
        range: f64,
        max_slope: f64,
    ) -> Option<Self> {
        let (nearest, farthest) = (f64::INFINITY, 0.0);
        let mut casters = Self { slopes: [ViewBounds::EMPTY; 6], nearest, farthest };
        let mut vertices = Vec::new();
        for ModelInstance { model, model_to_world } in models {
            for (instance, primitive) in model.scene_primitives() {
                if primitive.topology != Topology::Triangles {
                    continue;
                }
                let skinned = model.skin_primitive(instance, primitive);
                let to_world = skinned.to_model.then(*model_to_world).raw();
                let relative = |position: &[f32; 3]| {
                    to_world.transform_point3(DVec3::from(position.map(f64::from))) - eye
                };
                let with_bits = |p: DVec3| (p, outside_bits(p, max_slope));
                vertices.clear();
                vertices.extend(skinned.positions.iter().map(relative).map(with_bits));
                for triangle in primitive.indices.as_chunks::<3>().0 {
                    let triangle = triangle.map(|index| vertices[index as usize]);
                    casters.add_triangle(triangle, range, max_slope);
                }
            }
        }
        let is_lit = casters.farthest > 0.0 && casters.farthest.is_finite();
        is_lit.then_some(casters)
    }

    /// Adds a triangle, given by its vertices and their outside bits.
    fn add_triangle(&mut self, triangle: [(DVec3, u32); 3], range: f64, max_slope: f64) {
        let positions = triangle.map(|(position, _)| position);
        let [a, b, c] = positions;
        let plane_distance = (b - a).cross(c - a).normalize_or_zero().dot(a).abs();
        let is_in_range = plane_distance < range && positions.iter().all(|p| p.is_finite());
        if !is_in_range {
            return;
        }
        // A bit that all vertices share means that the triangle is outside a plane of a face.
        let common = triangle.iter().fold(u32::MAX, |common, (_, bits)| common & bits);
        for (face, slopes) in self.slopes.iter_mut().enumerate() {
            if is_outside_of(face, common) {
                continue;
            }
            let own = positions.map(|p| face_coordinates(face, p));
            let least = own.iter().fold(f64::INFINITY, |least, p| least.min(p.z));
            // The distance of a point on the face is at most √(1 + 2 slope²) times its depth.
            let by_plane = plane_distance / (1.0 + 2.0 * max_slope * max_slope).sqrt();
            self.nearest = self.nearest.min(by_plane.max(least));
            self.farthest = own.iter().fold(self.farthest, |most, p| most.max(p.z));
            let limit = DVec3::new(max_slope, max_slope, 0.0);
            if least > 0.0 {
                for p in own {
                    let slope = DVec3::new(p.x / p.z, p.y / p.z, 0.0);
                    slopes.include(slope.clamp(-limit, limit));
                }
            } else {
                // A triangle that extends behind the light may cover any slope.
                slopes.include(-limit);
                slopes.include(limit);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn face_coordinates_match_the_cameras() {
        let position = DVec3::new(1.0, 2.0, 3.0);
        for (face, direction) in FACE_DIRECTIONS.into_iter().enumerate() {
            let gaze = Vector::<World>::from(direction);
            let basis = Basis::from_gaze_or_fallback(gaze, Vector::Y).expect("a direction");
            let camera = Camera::new([0.0; 3].into(), basis).expect("a camera");
            let seen = camera.world_to_view().transform_point(position.to_array().into()).raw();
            let expected = DVec3::new(seen.x, seen.y, -seen.z);
            assert_eq!(face_coordinates(face, position), expected, "face {face}");
        }
    }

    #[test]
    fn positions_are_outside_every_face_that_does_not_see_them() {
        for (face, direction) in FACE_DIRECTIONS.into_iter().enumerate() {
            let bits = outside_bits(DVec3::from(direction) * 2.0, 1.2);
            let seen: Vec<usize> = (0..6).filter(|&at| !is_outside_of(at, bits)).collect();
            assert_eq!(seen, [face]);
        }
        // Near a border, within the overlap, two faces see the position.
        let bits = outside_bits(DVec3::new(1.0, 1.1, 0.0), 1.2);
        assert!(!is_outside_of(0, bits) && !is_outside_of(2, bits) && is_outside_of(4, bits));
    }
}
