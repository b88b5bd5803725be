//! The transmission framebuffer: a picture of all opaque surfaces, read by refracting and rough
//! glass to show the objects behind it (as in the Khronos sample viewer and three.js).
//!
//! ```text
//!   opaque surfaces ─► linear radiance, alpha ──┐
//!                                               ├─► mip levels ─► lookup at the exit of the ray,
//!   backdrop, where ─► display colors, alpha ───┘                 at the level for the roughness
//!   not covered
//! ```
//!
//! Surfaces and a visible environment are stored as light, which is tone mapped together with the
//! light that the glass reflects. The backdrop and background are already display colors and are
//! not tone mapped, so they are stored separately. Everything is premultiplied, so glass is also
//! transparent over an empty part of a transparent background.

use super::mip_levels::MipLevels;
use super::refraction::{blur_levels, channel_iors, refracted_exits};
use crate::lanes::{Lanes, Rgb, Vec3Lanes};
use crate::material_inputs::MaterialInputs;
use crate::surface_geometry::SurfaceGeometry;
use crate::{Backdrop, Draw};
use glam::{DMat4, DVec3};
use raster::for_each_parallel;

/// The maximum radiance of a texel, the largest finite half float. A single infinite texel, from a
/// sun or its reflection, would spoil all levels.
const MAX_RADIANCE: f32 = 65_504.0;

/// A picture of the opaque surfaces of a scene, with its mip levels.
#[derive(Clone, Debug)]
pub struct TransmissionFramebuffer {
    /// The projection from positions to the picture.
    projection: ScreenProjection,
    /// The radiance of surfaces and a visible environment.
    surfaces: MipLevels,
    /// The visible display colors of the backdrop over the background.
    backdrop: Option<MipLevels>,
    /// The premultiplied display color of the background.
    background: [f32; 4],
}

/// The view of a transmission framebuffer, which maps positions in the world to texels.
#[derive(Clone, Copy, Debug)]
pub struct ScreenProjection {
    /// The width and height of the framebuffer in texels.
    size: [u32; 2],
    /// The origin that positions are relative to.
    origin: [f32; 3],
    /// The rows of the matrix from relative positions to (x·w, y·w, w).
    rows: [[f32; 4]; 3],
}

/// The light that arrives through a surface from behind.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LightBehind<const N: usize> {
    /// The premultiplied radiance of surfaces.
    pub(crate) radiance: Rgb<N>,
    /// The premultiplied display colors of backdrop and background.
    pub(crate) display: Rgb<N>,
    /// The combined alpha of both.
    pub(crate) alpha: Lanes<N>,
}

impl<const N: usize> LightBehind<N> {
    /// No light, and nothing that blocks light.
    const NONE: Self = Self { radiance: Rgb::ZERO, display: Rgb::ZERO, alpha: Lanes::ZERO };
}

impl ScreenProjection {
    /// Creates the view for a framebuffer of `size` texels.
    ///
    /// `world_to_screen` maps the world to texels from the upper left corner. Positions are taken
    /// relative to `origin`, which should be near the surfaces, for precision in `f32`.
    #[must_use]
    pub fn new(size: [u32; 2], world_to_screen: DMat4, origin: DVec3) -> Self {
        let origin = origin.as_vec3();
        let to_screen = world_to_screen * DMat4::from_translation(origin.as_dvec3());
        let rows = [0, 1, 3].map(|row| to_screen.row(row).as_vec4().to_array());
        Self { size, origin: origin.to_array(), rows }
    }

    /// Projects positions to texels. The result is arbitrary for positions behind the eye.
    #[inline(always)]
    fn project<const N: usize>(&self, positions: Vec3Lanes<N>) -> [Lanes<N>; 2] {
        let Vec3Lanes { x, y, z } = positions - Vec3Lanes::splat(self.origin);
        let [column, row, w] = self.rows.map(|[a, b, c, d]| x * a + y * b + z * c + d);
        let inv_w = 1.0 / w;
        [column * inv_w, row * inv_w]
    }
}

impl TransmissionFramebuffer {
    /// Creates the framebuffer from a picture of all opaque surfaces.
    ///
    /// `surfaces` is linear premultiplied radiance, in rows from the top. Behind it are the
    /// backdrop and the `background`, a linear premultiplied display color. Uses up to `threads`
    /// threads, with the same result for any number.
    #[must_use]
    pub fn new(
        projection: ScreenProjection,
        mut surfaces: Vec<[f32; 4]>,
        backdrop: Option<&Backdrop>,
        background: [f32; 4],
        threads: usize,
    ) -> Self {
        // NaN becomes 0, because a single texel would otherwise spoil all levels.
        let bounded = |light: f32| if light > 0.0 { light.min(MAX_RADIANCE) } else { 0.0 };
        for texel in &mut surfaces {
            *texel = texel.map(bounded);
        }
        let backdrop = backdrop.map(|backdrop| {
            let texels =
                visible_backdrop(backdrop, background, &surfaces, projection.size, threads);
            MipLevels::new(texels, projection.size, threads)
        });
        let surfaces = MipLevels::new(surfaces, projection.size, threads);
        Self { projection, surfaces, backdrop, background }
    }

    /// Computes the light behind the surfaces of a draw, refracted and blurred but not yet tinted.
    ///
    /// This is not inlined into the shading kernel: most fragments do not need it, and wider
    /// instructions would not speed up its reads from memory.
    #[inline(never)]
    pub(crate) fn light_behind<const N: usize>(
        &self,
        draw: &Draw<'_>,
        inputs: &MaterialInputs<N>,
        geometry: &SurfaceGeometry<N>,
    ) -> LightBehind<N> {
        let [width, height] = self.projection.size;
        let ior = draw.material.extensions.ior;
        let levels = blur_levels(inputs.roughness, ior, width.max(height) as f32);
        let lengths = inputs.layers.thickness * draw.world_scale;
        let [red, green, blue] = channel_iors(draw);
        // With dispersion, each channel is refracted separately; alpha uses the green ray. The loop
        // keeps the lookup, which is inlined, to one copy.
        let iors = [green, red, blue];
        let count = if red == blue { 1 } else { iors.len() };
        let mut light = LightBehind::NONE;
        for (index, ior) in iors.into_iter().take(count).enumerate() {
            let found = self.sample(refracted_exits(geometry, ior, lengths), levels);
            match index {
                0 => light = found,
                1 => (light.radiance.r, light.display.r) = (found.radiance.r, found.display.r),
                _ => (light.radiance.b, light.display.b) = (found.radiance.b, found.display.b),
            }
        }
        light
    }

    /// Samples the mean light around positions in the world, each at a mip level.
    #[inline(always)]
    fn sample<const N: usize>(&self, positions: Vec3Lanes<N>, levels: Lanes<N>) -> LightBehind<N> {
        let [x, y] = self.projection.project(positions);
        let mut light = LightBehind::NONE;
        for lane in 0..N {
            let (place, level) = ([x[lane], y[lane]], levels[lane]);
            let [r, g, b, alpha] = self.surfaces.sample(place, level);
            let behind = match &self.backdrop {
                Some(backdrop) => backdrop.sample(place, level),
                None => self.background.map(|channel| channel * (1.0 - alpha)),
            };
            [light.radiance.r[lane], light.radiance.g[lane], light.radiance.b[lane]] = [r, g, b];
            let [r, g, b, behind_alpha] = behind;
            [light.display.r[lane], light.display.g[lane], light.display.b[lane]] = [r, g, b];
            light.alpha[lane] = (alpha + behind_alpha).min(1.0);
        }
        light
    }
}

/// Computes the visible share of the backdrop over the background at each texel.
fn visible_backdrop(
    backdrop: &Backdrop,
    background: [f32; 4],
    surfaces: &[[f32; 4]],
    [width, height]: [u32; 2],
    threads: usize,
) -> Vec<[f32; 4]> {
    let mut texels = vec![[0.0; 4]; surfaces.len()];
    let rows = texels.chunks_mut(width as usize).zip(surfaces.chunks(width as usize));
    for_each_parallel(threads, rows.enumerate(), |(y, (texels, surfaces))| {
        for (x, (texel, [.., alpha])) in texels.iter_mut().zip(surfaces).enumerate() {
            let place = [(x as f32 + 0.5) / width as f32, (y as f32 + 0.5) / height as f32];
            let color = backdrop.color_at(place);
            *texel = [0, 1, 2, 3]
                .map(|k: usize| (color[k] + background[k] * (1.0 - color[3])) * (1.0 - alpha));
        }
    });
    texels
}
