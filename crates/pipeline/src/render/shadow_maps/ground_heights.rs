//! Height maps of the models, seen from below and from above, for ground occlusion.
//!
//! ```text
//!   ▼ ▼ ▼ ▼ ▼ ▼   highest surfaces      two orthographic depth passes over one grid
//!     ▟███▙
//!   ▲ ▲ ▲ ▲ ▲ ▲   lowest surfaces
//!  ───────────── ground
//! ```

use super::ShadowMapRenderer;
use super::light_fitting::LightCamera;
use crate::render::RenderError;
use crate::render::context::RenderContext;
use camera::{Basis, Camera, ViewProjection};
use homog::{Point, Vector};
use projection::{Convention, Orthographic, Window};
use scene::OcclusionArea;
use shade::{GroundGrid, GroundOcclusion, HeightSlab, ShadowMap};

/// The maximum number of cells along the grid's longer side.
const MAX_GRID_CELLS: u32 = 192;
/// The number of pixels per cell along the picture's longer side. A contact shadow is smooth, so
/// small pictures do not need more cells.
const PIXELS_PER_CELL: u32 = 3;

/// The depths of a height map and the planes that bound them.
struct HeightMap {
    map: ShadowMap,
    /// The heights above the ground at depths 1 and 0.
    heights: [f64; 2],
}

impl HeightMap {
    /// Returns the height of a texel above the ground, or `None` if the texel is empty.
    fn height(&self, index: usize) -> Option<f32> {
        let depth = f64::from(self.map.texels[index].depth);
        let [near, far] = self.heights;
        depth.is_finite().then_some((far + (near - far) * depth) as f32)
    }
}

impl ShadowMapRenderer {
    /// Renders the occlusion of the scene's ground in light from all directions, or returns `None`
    /// if the ground shows no occlusion.
    pub(super) fn render_ground_occlusion(
        &mut self,
        context: &RenderContext<'_>,
    ) -> Result<Option<GroundOcclusion>, RenderError> {
        let area = context.scene.ground.and_then(|ground| ground.occlusion);
        let [width, height] = context.image_size();
        let cells = (width.max(height) / PIXELS_PER_CELL).clamp(32, MAX_GRID_CELLS);
        let Some((area, grid)) = area.and_then(|area| Some((area, occlusion_grid(area, cells)?)))
        else {
            return Ok(None);
        };
        let Some(lowest) = self.render_heights(context, area, grid, true)? else {
            return Ok(None);
        };
        let Some(highest) = self.render_heights(context, area, grid, false)? else {
            return Ok(None);
        };
        let [columns, rows] = grid.size;
        // Seen from below, rows run in the opposite direction.
        let mirrored = |index: usize| (rows - 1 - index / columns) * columns + index % columns;
        let slab = |index: usize| {
            let (low, high) = (lowest.height(mirrored(index))?, highest.height(index)?);
            let low = low.max(0.0);
            // A single sheet gets a small thickness instead of zero.
            Some(HeightSlab { low, high: high.max(low * (1.0 + 1e-4) + 1e-4 * grid.cell) })
        };
        let slabs: Vec<_> =
            (0..columns * rows).map(|index| slab(index).unwrap_or(HeightSlab::EMPTY)).collect();
        // The order is reversed, so that each map later gets the same memory again.
        self.map_pool.extend([highest.map, lowest.map]);
        Ok(Some(GroundOcclusion::compute(grid, &slabs, context.threads)))
    }

    /// Renders the surfaces nearest to the ground or farthest from it.
    fn render_heights(
        &mut self,
        context: &RenderContext<'_>,
        area: OcclusionArea,
        grid: GroundGrid,
        from_below: bool,
    ) -> Result<Option<HeightMap>, RenderError> {
        let top = area.high.y() - area.low.y();
        let (below, above) = (-0.01 * top, 1.01 * top);
        let heights = if from_below { [below, above] } else { [above, below] };
        let Some(camera) = height_camera(area, grid, heights) else { return Ok(None) };
        let map = self.render_map(context, &camera)?;
        Ok(Some(HeightMap { map, heights }))
    }
}

/// Returns the grid of an area, with `cells` square cells along its longer side, or `None` if the
/// area is too large or too small for `f32`.
fn occlusion_grid(area: OcclusionArea, cells: u32) -> Option<GroundGrid> {
    let (low, extent) = (area.low.raw(), area.high.raw() - area.low.raw());
    let cell = extent.x.max(extent.z) / f64::from(cells);
    // A frame has at least 16 pixels per side.
    let count = |side: f64| ((side / cell).ceil() as usize).clamp(16, cells as usize);
    let (cell_f32, fade) = (cell as f32, area.margin as f32);
    let corner = [low.x as f32, low.z as f32];
    let is_usable = cell_f32.is_normal() && corner.iter().all(|c| c.is_finite());
    let size = [count(extent.x), count(extent.z)];
    is_usable.then_some(GroundGrid { corner, cell: cell_f32, size, fade })
}

/// Returns the orthographic camera over a grid, looking from the first to the second height.
fn height_camera(area: OcclusionArea, grid: GroundGrid, heights: [f64; 2]) -> Option<LightCamera> {
    let [near, far] = heights;
    let gaze = if near < far { Vector::Y } else { -Vector::Y };
    // The camera looks straight up or down: x is to the right, and z is up or down in the picture.
    let basis = Basis::from_gaze_or_fallback(gaze, Vector::Y).ok()?;
    let cell = f64::from(grid.cell);
    let [half_x, half_z] = grid.size.map(|count| 0.5 * count as f64 * cell);
    let (x, z) = (f64::from(grid.corner[0]) + half_x, f64::from(grid.corner[1]) + half_z);
    let eye = Point::new(x, area.low.y() + near, z);
    let camera = Camera::new(eye, basis).ok()?;
    let window = Window::new(-half_x, half_x, -half_z, half_z).ok()?;
    let volume = Orthographic::from_window(window, 0.0, (far - near).abs()).ok()?;
    Some(LightCamera {
        view_projection: ViewProjection {
            camera,
            view_to_clip: volume.view_to_clip(Convention::CHAPTER),
        },
        size: grid.size.map(|count| count as u32),
        center: eye.raw(),
        penumbra: 0.0,
        depth_at_infinity: None,
    })
}
