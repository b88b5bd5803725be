//! A frame: the draw list of one picture, and primitive assembly from vertices to screen triangles.
//!
//! ```text
//!   ScreenVertex ×3 ─► cull by winding ─► drop if no sample ─► orient clockwise ─► buffer
//! ```
//!
//! Triangles are stored in submission order, which breaks depth ties: of two triangles at the same
//! depth, the one added first wins.

use crate::buffer_pool::BufferPool;
use crate::edge_function::signed_area;
use crate::parallel::for_each_parallel;
use crate::primitive::{
    ScreenTriangle, WeightSource, normalize_inv_w, triangulate_line, triangulate_point,
};
use crate::screen_vertex::SUBPIXELS;
use crate::tile_grid::{TileGrid, TileRange};
use crate::triangle_buffer::{CHUNK_TRIANGLES, TriangleBuffer, TriangleChunk};
use crate::{
    CullMode, DepthBuffer, DepthCompare, Monitor, Opacity, RasterError, Samples, ScreenVertex,
    SimdLevel, SourceWeights,
};
use core::ops::Range;
use homog::PixelRect;
use std::sync::Arc;

/// The maximum width and height of a picture in pixels.
pub const MAX_SIDE: u32 = 16384;

/// Meshes with fewer triangles are assembled by one thread, because starting a second takes longer
/// than it saves.
const PARALLEL_TRIANGLES: usize = 8 * CHUNK_TRIANGLES;

/// The primitives of one picture and the settings for drawing them.
///
/// Add primitives with [`add_triangle`](Self::add_triangle), [`add_mesh`](Self::add_mesh),
/// [`add_line`](Self::add_line) and [`add_point`](Self::add_point), then [`draw`](Self::draw). At
/// equal depth, the primitive added first wins, for any number of threads.
#[derive(Clone, Debug)]
pub struct Frame {
    /// The pixels that the frame shows, in the coordinates of the whole picture.
    pub(crate) region: PixelRect,
    /// The sample pattern of each pixel.
    pub(crate) samples: Samples,
    /// The vector instructions for rasterizing and shading tiles.
    pub(crate) simd_level: SimdLevel,
    /// The screen triangles in submission order.
    pub(crate) triangles: TriangleBuffer,
    /// The source weights of triangles that are part of another primitive: see
    /// [`WeightSource::Clipped`].
    pub(crate) source_weights: Vec<SourceWeights>,
    /// The maximum number of threads for assembling a mesh.
    threads: usize,
    /// The depth function.
    pub(crate) compare: DepthCompare,
    /// The initial depths, if any.
    pub(crate) initial_depth: Option<Arc<DepthBuffer>>,
    /// The observer that is notified of finished bands and can cancel drawing.
    pub(crate) monitor: Option<Arc<dyn Monitor>>,
    /// Buffers from the last drawing, for reuse.
    pub(crate) buffers: BufferPool,
}

/// The triangles of a mesh on the screen, to pass to [`Frame::add_mesh_runs`].
#[derive(Clone, Copy, Debug)]
pub struct MeshTriangles<'a> {
    /// The vertices; a vertex is `None` if it cannot be drawn without clipping.
    pub vertices: &'a [Option<ScreenVertex>],
    /// The indices of each triangle's vertices.
    pub triangles: &'a [[u32; 3]],
    /// The id of the first triangle; the others count up from it.
    pub first_id: u32,
    /// How the triangles affect visibility.
    pub opacity: Opacity,
    /// The winding of the triangles to cull.
    pub cull: CullMode,
}

impl Frame {
    /// Creates an empty frame of `width` × `height` pixels.
    ///
    /// # Errors
    /// Returns [`RasterError::Size`] unless both sides are between 1 and [`MAX_SIDE`].
    pub fn new(width: u32, height: u32, samples: Samples) -> Result<Self, RasterError> {
        Self::for_region(PixelRect::from_size(width, height), samples)
    }

    /// Creates an empty frame that shows a region of a larger picture.
    ///
    /// Vertices and fragments use the coordinates of the whole picture. Regions drawn one by one
    /// match the whole, bit for bit. Use regions to draw pictures too large for memory, or to
    /// redraw only the part that has changed.
    ///
    /// # Errors
    /// Returns [`RasterError::Size`] unless both sides are at least 1 and the region ends within
    /// [`MAX_SIDE`].
    pub fn for_region(region: PixelRect, samples: Samples) -> Result<Self, RasterError> {
        Ok(Self {
            region: check_region(region)?,
            samples,
            simd_level: SimdLevel::best(),
            triangles: TriangleBuffer::default(),
            source_weights: Vec::new(),
            threads: 1,
            compare: DepthCompare::default(),
            initial_depth: None,
            monitor: None,
            buffers: BufferPool::default(),
        })
    }

    /// Returns this frame with another SIMD level. Use it for benchmarks, and to test that the
    /// level does not affect the picture.
    #[must_use]
    pub fn with_simd_level(self, simd_level: SimdLevel) -> Self {
        Self { simd_level, ..self }
    }

    /// Returns this frame with large [meshes](Self::add_mesh) assembled by up to `threads` threads
    /// (default: 1). The result does not depend on the number.
    #[must_use]
    pub fn with_threads(self, threads: usize) -> Self {
        Self { threads, ..self }
    }

    /// Returns this frame with a monitor. `monitor` is notified of each finished row of tiles, and
    /// can cancel drawing before the next row starts. If drawing ends early, the target contains an
    /// unfinished picture.
    #[must_use]
    pub fn with_monitor(self, monitor: Arc<dyn Monitor>) -> Self {
        Self { monitor: Some(monitor), ..self }
    }

    /// Returns this frame without its primitives and with another depth function.
    #[must_use]
    pub fn with_depth_compare(mut self, compare: DepthCompare) -> Self {
        self.clear();
        Self { compare, ..self }
    }

    /// Returns this frame with initial depths, for a second pass.
    ///
    /// Fragments that fail the depth test against them appear neither in pictures nor in id
    /// buffers.
    ///
    /// # Errors
    /// Returns [`RasterError::DepthCount`] if the pixels or samples of the buffer do not match the
    /// frame.
    pub fn with_depth_buffer(self, depths: Arc<DepthBuffer>) -> Result<Self, RasterError> {
        if !depths.fits(self.region, self.samples) {
            let expected = self.region.area() * self.samples.count();
            return Err(RasterError::DepthCount { expected, found: depths.sample_count() });
        }
        Ok(Self { initial_depth: Some(depths), ..self })
    }

    /// Returns whether drawing should stop.
    pub(crate) fn is_canceled(&self) -> bool {
        self.monitor.as_ref().is_some_and(Monitor::is_canceled)
    }

    /// Returns the vector instructions used for drawing the frame.
    #[must_use]
    pub const fn simd_level(&self) -> SimdLevel {
        self.simd_level
    }

    /// Removes all primitives, changes the size and samples, and keeps the memory. The initial
    /// depths and the monitor are also removed.
    ///
    /// # Errors
    /// Returns the same errors as [`new`](Self::new); the frame is then unchanged.
    pub fn reset(&mut self, width: u32, height: u32, samples: Samples) -> Result<(), RasterError> {
        self.region = check_region(PixelRect::from_size(width, height))?;
        self.samples = samples;
        (self.initial_depth, self.monitor) = (None, None);
        self.clear();
        Ok(())
    }

    /// Removes all primitives and keeps the memory for the next picture.
    pub fn clear(&mut self) {
        self.triangles.clear();
        self.source_weights.clear();
    }

    /// Returns the width in pixels.
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.region.width
    }

    /// Returns the height in pixels.
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.region.height
    }

    /// Adds a whole triangle of either winding.
    ///
    /// Nothing is culled by winding. To cull back faces, check [`signed_area`] first or add a mesh.
    ///
    /// Degenerate triangles and triangles between samples are dropped, because they cover no
    /// sample.
    pub fn add_triangle(&mut self, vertices: [ScreenVertex; 3], id: u32, opacity: Opacity) {
        self.push_unclipped(vertices, id, opacity);
    }

    /// Adds the triangles of a mesh, with ids that count up from `first_id`.
    ///
    /// Triangles with a vertex that is `None` or not in the mesh are dropped. So are triangles that
    /// are degenerate, culled by winding, or without a sample of the frame in their bounds.
    pub fn add_mesh(
        &mut self,
        vertices: &[Option<ScreenVertex>],
        triangles: &[[u32; 3]],
        first_id: u32,
        opacity: Opacity,
        cull: CullMode,
    ) {
        let all = 0..triangles.len();
        let mesh = MeshTriangles { vertices, triangles, first_id, opacity, cull };
        self.add_mesh_runs(mesh, std::slice::from_ref(&all));
    }

    /// Adds the triangles of a mesh that are in `runs`, in order. They keep their ids in the mesh.
    ///
    /// Runs must be sorted and must not overlap; any part of a run beyond the mesh is ignored.
    ///
    /// With several threads, triangles are assembled in chunks of 4096. The order of the buffer,
    /// and with it the winner at equal depth, does not depend on how the chunks are distributed.
    pub fn add_mesh_runs(&mut self, mesh: MeshTriangles<'_>, runs: &[Range<usize>]) {
        // One rectangle test serves all triangles of the mesh, because it depends only on the
        // frame.
        let (bounds, compare) = (self.sample_bounds(), self.compare);
        let count: usize = runs.iter().map(ExactSizeIterator::len).sum();
        if self.threads > 1 && count >= PARALLEL_TRIANGLES {
            // Chunk n gets the part of the runs in the n-th group of 4096 triangles of the mesh, so
            // the order of chunks is the order of triangles for any number of threads.
            let first = self.triangles.chunks_in_use();
            let chunk_count = mesh.triangles.len().div_ceil(CHUNK_TRIANGLES);
            let chunks = self.triangles.append_chunks(chunk_count).iter_mut();
            for_each_parallel(self.threads, chunks.enumerate(), |(index, chunk)| {
                let slice = index * CHUNK_TRIANGLES..(index + 1) * CHUNK_TRIANGLES;
                // Find the runs that extend into this chunk by binary search.
                let before = runs.partition_point(|run| run.end <= slice.start);
                for run in runs[before..].iter().take_while(|run| run.start < slice.end) {
                    let run = run.start.max(slice.start)..run.end.min(slice.end);
                    mesh.assemble_run(bounds, compare, run, chunk);
                }
            });
            self.triangles.remove_empty_chunks(first);
            return;
        }
        // With one thread, fill chunk by chunk.
        for run in runs {
            let mut rest = run.clone();
            while !rest.is_empty() {
                let (chunk, space) = self.triangles.open_with_space();
                let end = rest.end.min(rest.start + space);
                mesh.assemble_run(bounds, compare, rest.start..end, chunk);
                rest.start = end;
            }
        }
    }

    /// Adds part of a clipped triangle.
    ///
    /// `weights` contains the weights of the source triangle's vertices at each of these vertices.
    /// They convert the weights of fragments to weights in the source triangle.
    pub fn add_clipped_triangle(
        &mut self,
        vertices: [ScreenVertex; 3],
        weights: SourceWeights,
        id: u32,
        opacity: Opacity,
    ) {
        self.push_clipped(vertices, weights, id, opacity);
    }

    /// Adds a line `width` pixels wide, as a rectangle whose square ends are flush with the ends of
    /// the line.
    ///
    /// Its fragments have weights for the two ends and 0 for the third vertex.
    pub fn add_line(&mut self, ends: [ScreenVertex; 2], width: f64, id: u32, opacity: Opacity) {
        for (vertices, weights) in triangulate_line(ends, width).into_iter().flatten() {
            self.push_clipped(vertices, weights, id, opacity);
        }
    }

    /// Adds part of a clipped line, like [`add_line`](Self::add_line), with the parameters of its
    /// ends along the source line: 0 at the first end and 1 at the second.
    pub fn add_clipped_line(
        &mut self,
        ends: [ScreenVertex; 2],
        parameters: [f32; 2],
        width: f64,
        id: u32,
        opacity: Opacity,
    ) {
        let source = parameters.map(|t| [1.0 - t, t, 0.0]);
        for (vertices, weights) in triangulate_line(ends, width).into_iter().flatten() {
            let at_end = |weight: [f32; 3]| if weight[0] > 0.0 { source[0] } else { source[1] };
            self.push_clipped(vertices, weights.map(at_end), id, opacity);
        }
    }

    /// Adds a point as a square of `size` pixels. Its fragments have the weights (1, 0, 0).
    pub fn add_point(&mut self, center: ScreenVertex, size: f64, id: u32, opacity: Opacity) {
        for (vertices, weights) in triangulate_point(center, size) {
            self.push_clipped(vertices, weights, id, opacity);
        }
    }

    /// Assembles one whole triangle and appends it, unless it is degenerate or covers no sample.
    fn push_unclipped(&mut self, vertices: [ScreenVertex; 3], id: u32, opacity: Opacity) {
        // Without tiles, the triangle is outside the region or between samples.
        let Some(tiles) = self.sample_bounds().touched_tiles(vertices) else { return };
        let area = signed_area(vertices);
        let vertices = oriented_depths(self.compare.negates(), vertices);
        if let Some(triangle) = assemble_triangle(vertices, area, id, opacity) {
            self.triangles.push(triangle, tiles);
        }
    }

    /// Assembles a triangle that is part of a primitive, and stores its weights in a separate
    /// table.
    ///
    /// Vertices and weights are swapped together if the winding requires it, so the source needs no
    /// flag for that.
    fn push_clipped(
        &mut self,
        vertices: [ScreenVertex; 3],
        [at_p, at_q, at_r]: SourceWeights,
        id: u32,
        opacity: Opacity,
    ) {
        let Some(tiles) = self.sample_bounds().touched_tiles(vertices) else { return };
        let [p, q, r] = vertices;
        let (vertices, weights) = match signed_area(vertices) {
            0 => return,
            1.. => (vertices, [at_p, at_q, at_r]),
            _ => ([p, r, q], [at_p, at_r, at_q]),
        };
        // Store an index instead of nine weights: most triangles have no weights, and all remain
        // small.
        let source = WeightSource::Clipped(self.source_weights.len() as u32);
        self.source_weights.push(weights);
        let vertices = normalize_inv_w(oriented_depths(self.compare.negates(), vertices));
        self.triangles.push(ScreenTriangle { vertices, id, source, opacity }, tiles);
    }

    /// Returns the test that determines whether a triangle can cover a sample of this frame.
    fn sample_bounds(&self) -> SampleBounds {
        SampleBounds { grid: TileGrid::new(self.region), samples: self.samples }
    }
}

/// Checks that a region is not empty and ends within [`MAX_SIDE`].
///
/// The sum of origin and side is checked for overflow.
fn check_region(region: PixelRect) -> Result<PixelRect, RasterError> {
    let PixelRect { x, y, width, height } = region;
    let fits = |from: u32, side: u32| {
        side > 0 && from.checked_add(side).is_some_and(|end| end <= MAX_SIDE)
    };
    if !fits(x, width) || !fits(y, height) {
        return Err(RasterError::Size { x, y, width, height });
    }
    Ok(region)
}

impl MeshTriangles<'_> {
    /// Appends a run of triangles, with negated depths if the depth function requires it.
    fn assemble_run(
        &self,
        bounds: SampleBounds,
        compare: DepthCompare,
        run: Range<usize>,
        chunk: &mut TriangleChunk,
    ) {
        if compare.negates() {
            self.assemble_triangles::<true>(bounds, run, chunk);
        } else {
            self.assemble_triangles::<false>(bounds, run, chunk);
        }
    }

    /// Assembles primitives: appends the triangles of a run that are not culled and may cover a
    /// sample.
    ///
    /// The tests run in this order: missing vertices, winding, bounds, degeneracy. Most triangles
    /// of a fine mesh fail the bounds test.
    fn assemble_triangles<const NEGATES: bool>(
        &self,
        bounds: SampleBounds,
        run: Range<usize>,
        chunk: &mut TriangleChunk,
    ) {
        let vertex = |index: u32| self.vertices.get(index as usize).copied().flatten();
        let first_id = self.first_id.wrapping_add(run.start as u32);
        let end = run.end.min(self.triangles.len());
        let triangles = self.triangles.get(run.start..end).unwrap_or_default();
        chunk.reserve(triangles.len());
        for (id, &[p, q, r]) in (first_id..).zip(triangles) {
            let (Some(p), Some(q), Some(r)) = (vertex(p), vertex(q), vertex(r)) else { continue };
            // Back-face culling: the sign of the area is the winding on the screen.
            let area = signed_area([p, q, r]);
            if !self.cull.retains(area) {
                continue;
            }
            // In a mesh finer than the pixels, most triangles are dropped here, before any setup.
            let Some(tiles) = bounds.touched_tiles([p, q, r]) else { continue };
            let vertices = oriented_depths(NEGATES, [p, q, r]);
            if let Some(triangle) = assemble_triangle(vertices, area, id, self.opacity) {
                chunk.push(triangle, tiles);
            }
        }
    }
}

/// Returns the vertices, with depths negated if necessary so that the greater depth wins.
#[inline(always)]
fn oriented_depths(negates: bool, mut vertices: [ScreenVertex; 3]) -> [ScreenVertex; 3] {
    if negates {
        for vertex in &mut vertices {
            vertex.depth = -vertex.depth;
        }
    }
    vertices
}

/// Assembles a whole triangle with its vertices clockwise on the screen, or returns `None` if it is
/// degenerate.
///
/// `area` is the [`signed_area`] of the vertices, already computed for culling.
#[inline(always)]
fn assemble_triangle(
    [p, q, r]: [ScreenVertex; 3],
    area: i64,
    id: u32,
    opacity: Opacity,
) -> Option<ScreenTriangle> {
    // Edge functions are positive inside for only one winding. Swapping two vertices reverses it;
    // the source records this, and fragments get their weights in the original vertex order.
    let (vertices, source) = match area {
        0 => return None,
        1.. => ([p, q, r], WeightSource::Unclipped),
        _ => ([p, r, q], WeightSource::Flipped),
    };
    Some(ScreenTriangle { vertices: normalize_inv_w(vertices), id, source, opacity })
}

/// Tests whether a triangle's bounds contain a sample of the frame, and finds the tiles they touch.
///
/// It is conservative: a bounding rectangle may contain a sample that the triangle does not cover.
#[derive(Clone, Copy)]
struct SampleBounds {
    /// The tiles of the frame's region.
    grid: TileGrid,
    /// The samples of a pixel.
    samples: Samples,
}

impl SampleBounds {
    /// Returns the tiles of the frame that a triangle's bounds touch, or `None` if they touch no
    /// tile or contain no sample.
    #[inline(always)]
    fn touched_tiles(&self, [p, q, r]: [ScreenVertex; 3]) -> Option<TileRange> {
        // The bounding box in grid steps.
        let x = [p.x.min(q.x).min(r.x), p.x.max(q.x).max(r.x)];
        let y = [p.y.min(q.y).min(r.y), p.y.max(q.y).max(r.y)];
        let (width, height) = (x[1].wrapping_sub(x[0]), y[1].wrapping_sub(y[0]));
        // A box at least as wide and tall as a pixel contains every sample of the pattern.
        let is_large = (width >= SUBPIXELS - 1) & (height >= SUBPIXELS - 1);
        if is_large || self.holds_sample([x[0], y[0]], [width, height]) {
            self.grid.tiles_in_bounds(x, y)
        } else {
            None
        }
    }

    /// Returns whether a box contains a sample, given its minimum corner and its size in grid
    /// steps.
    ///
    /// Bounds are closed: a sample on the border counts, because the top-left rule may assign it to
    /// the triangle. Samples repeat with every pixel, so the distance to the next one is a
    /// remainder.
    #[inline(always)]
    fn holds_sample(&self, [left, top]: [i32; 2], [width, height]: [i32; 2]) -> bool {
        let mut holds = false;
        for (x, y) in self.samples.grid_offsets() {
            let right = x.wrapping_sub(left) & (SUBPIXELS - 1);
            let down = y.wrapping_sub(top) & (SUBPIXELS - 1);
            holds |= (right <= width) & (down <= height);
        }
        holds
    }
}
