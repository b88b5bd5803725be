//! A frame: the primitives of one picture, in the order in which they were given.

use crate::buffer_pool::BufferPool;
use crate::edge_function::signed_area;
use crate::parallel::for_each_parallel;
use crate::primitive::{
    ScreenTriangle, WeightSource, normalize_inv_w, triangulate_line, triangulate_point,
};
use crate::screen_vertex::SUBPIXEL_BITS;
use crate::tile_grid::{FrameRegion, TileGrid, TileRange};
use crate::triangle_buffer::{CHUNK_TRIANGLES, TriangleBuffer, TriangleChunk};
use crate::{CullMode, Opacity, RasterError, Samples, ScreenVertex, SimdLevel, SourceWeights};
use core::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// The longest side of a picture in pixels.
pub const MAX_SIDE: u32 = 16384;

/// The primitives of one picture.
///
/// Fill it with [`add_triangle`](Self::add_triangle), [`add_line`](Self::add_line) and [`add_point`](Self::add_point), then
/// [`draw`](Self::draw) it. At equal depth the primitive given first wins, whatever the number of threads.
#[derive(Clone, Debug)]
pub struct Frame {
    pub(crate) region: FrameRegion,
    pub(crate) samples: Samples,
    pub(crate) simd_level: SimdLevel,
    pub(crate) triangles: TriangleBuffer,
    pub(crate) source_weights: Vec<SourceWeights>,
    threads: usize,
    /// Drawing ends early once this is true.
    cancel: Option<Arc<AtomicBool>>,
    /// What the last drawing left behind for the next.
    pub(crate) buffers: BufferPool,
}

/// Meshes of fewer triangles are added by one thread: starting another takes as long.
const PARALLEL_TRIANGLES: usize = 8 * CHUNK_TRIANGLES;

impl Frame {
    /// An empty frame of `width` × `height` pixels.
    ///
    /// # Errors
    /// [`RasterError::Size`] unless both sides are between 1 and [`MAX_SIDE`].
    pub fn new(width: u32, height: u32, samples: Samples) -> Result<Self, RasterError> {
        Self::for_region([0, 0], [width, height], samples)
    }

    /// An empty frame that shows a part of a larger picture: `size` pixels from the pixel `corner` on.
    ///
    /// Vertices and fragments keep their places in the whole picture, and parts that are drawn one by one have the
    /// pixels of the whole, bit for bit: so pictures too large for memory are drawn, or only what has changed.
    ///
    /// # Errors
    /// [`RasterError::Size`] unless both sides are at least 1 and the part ends within [`MAX_SIDE`].
    pub fn for_region(
        corner: [u32; 2],
        size: [u32; 2],
        samples: Samples,
    ) -> Result<Self, RasterError> {
        let part = check_region(corner, size)?;
        Ok(Self {
            region: part,
            samples,
            simd_level: SimdLevel::best(),
            triangles: TriangleBuffer::default(),
            source_weights: Vec::new(),
            threads: 1,
            cancel: None,
            buffers: BufferPool::default(),
        })
    }

    /// The same frame, drawn with the given instructions: for measurements, and for proofs that they do not matter.
    #[must_use]
    pub fn with_simd_level(self, instructions: SimdLevel) -> Self {
        Self { simd_level: instructions, ..self }
    }

    /// The same frame, whose large [`add_mesh`](Self::add_mesh)es are added by up to so many threads; 1 unless told otherwise. The
    /// frame does not depend on it.
    #[must_use]
    pub fn with_threads(self, threads: usize) -> Self {
        Self { threads, ..self }
    }

    /// The same frame, whose [drawing](Self::draw) begins no further row of tiles once `stop` is true. What the target then holds
    /// is no picture.
    #[must_use]
    pub fn with_cancel_flag(self, stop: Arc<AtomicBool>) -> Self {
        Self { cancel: Some(stop), ..self }
    }

    pub(crate) fn is_canceled(&self) -> bool {
        self.cancel.as_ref().is_some_and(|stop| stop.load(Ordering::Relaxed))
    }

    /// The instructions that it is drawn with.
    #[must_use]
    pub const fn simd_level(&self) -> SimdLevel {
        self.simd_level
    }

    /// Takes all primitives out again for a picture of another size, or of other samples, and keeps the memory.
    ///
    /// # Errors
    /// As [`new`](Self::new); the frame is then as it was.
    pub fn reset(&mut self, width: u32, height: u32, samples: Samples) -> Result<(), RasterError> {
        self.region = check_region([0, 0], [width, height])?;
        self.samples = samples;
        self.clear();
        Ok(())
    }

    /// Takes all primitives out again and keeps the memory for the next picture.
    pub fn clear(&mut self) {
        self.triangles.clear();
        self.source_weights.clear();
    }

    /// Width in pixels.
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.region.width
    }

    /// Height in pixels.
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.region.height
    }

    /// Adds a whole triangle; its corners may run either way. Leave out those that face away, if they are to be
    /// invisible: see [`signed_area`].
    pub fn add_triangle(&mut self, corners: [ScreenVertex; 3], id: u32, cover: Opacity) {
        self.push_unclipped(corners, signed_area(corners), id, cover);
    }

    /// Adds the triangles of a mesh, named `first_id` and so on in their order. Triangles with a vertex that is missing, or
    /// that the mesh does not have, are left out, and so are those with a negative [`signed_area`] if
    /// `cull` asks for it, and those with a positive one if it asks for the others.
    pub fn add_mesh(
        &mut self,
        vertices: &[Option<ScreenVertex>],
        triangles: &[[u32; 3]],
        first_id: u32,
        cover: Opacity,
        cull: CullMode,
    ) {
        let all = 0..triangles.len();
        self.add_mesh_runs(vertices, triangles, std::slice::from_ref(&all), first_id, cover, cull);
    }

    /// As [`add_mesh`](Self::add_mesh), with some of the triangles only: `runs` of them, in their order. They keep their names.
    ///
    /// Runs must not overlap; what of them is not in the mesh is left out.
    pub fn add_mesh_runs(
        &mut self,
        vertices: &[Option<ScreenVertex>],
        triangles: &[[u32; 3]],
        runs: &[Range<usize>],
        first_id: u32,
        cover: Opacity,
        cull: CullMode,
    ) {
        let mesh = MeshTriangles {
            vertices,
            triangles,
            first_id,
            sample_bounds: self.sample_bounds(),
            opacity: cover,
            cull,
        };
        let count: usize = runs.iter().map(ExactSizeIterator::len).sum();
        if self.threads > 1 && count >= PARALLEL_TRIANGLES {
            let first = self.triangles.chunks_in_use();
            let chunks =
                self.triangles.append_chunks(triangles.len().div_ceil(CHUNK_TRIANGLES)).iter_mut();
            for_each_parallel(self.threads, chunks.enumerate(), |(number, chunk)| {
                let whole = number * CHUNK_TRIANGLES..(number + 1) * CHUNK_TRIANGLES;
                let before = runs.partition_point(|run| run.end <= whole.start);
                for run in runs[before..].iter().take_while(|run| run.start < whole.end) {
                    mesh.assemble_triangles(
                        run.start.max(whole.start)..run.end.min(whole.end),
                        chunk,
                    );
                }
            });
            self.triangles.remove_empty_chunks(first);
            return;
        }
        for run in runs {
            let mut rest = run.clone();
            while !rest.is_empty() {
                let (chunk, room) = self.triangles.open_with_space();
                let end = rest.end.min(rest.start + room);
                mesh.assemble_triangles(rest.start..end, chunk);
                rest.start = end;
            }
        }
    }

    /// Adds a piece of a triangle that was clipped; `weights` lead from its corners to those of the source.
    pub fn add_clipped_triangle(
        &mut self,
        corners: [ScreenVertex; 3],
        weights: SourceWeights,
        id: u32,
        cover: Opacity,
    ) {
        self.push_clipped(corners, weights, id, cover);
    }

    /// Adds a line `width` pixels wide. Its fragments have weights of the two ends, and 0 for the third corner.
    pub fn add_line(&mut self, ends: [ScreenVertex; 2], width: f64, id: u32, cover: Opacity) {
        for (corners, weights) in triangulate_line(ends, width).into_iter().flatten() {
            self.push_clipped(corners, weights, id, cover);
        }
    }

    /// Adds a piece of a line that was clipped: as [`add_line`](Self::add_line), with the places of the piece's ends in the
    /// source line, 0 at its first and 1 at its second end.
    pub fn add_clipped_line(
        &mut self,
        ends: [ScreenVertex; 2],
        places: [f32; 2],
        width: f64,
        id: u32,
        cover: Opacity,
    ) {
        let source = places.map(|t| [1.0 - t, t, 0.0]);
        for (corners, weights) in triangulate_line(ends, width).into_iter().flatten() {
            let at_end = |weight: [f32; 3]| if weight[0] > 0.0 { source[0] } else { source[1] };
            self.push_clipped(corners, weights.map(at_end), id, cover);
        }
    }

    /// Adds a point as a square of `size` pixels. Its fragments have the weights (1, 0, 0).
    pub fn add_point(&mut self, center: ScreenVertex, size: f64, id: u32, cover: Opacity) {
        for (corners, weights) in triangulate_point(center, size) {
            self.push_clipped(corners, weights, id, cover);
        }
    }

    fn push_unclipped(&mut self, corners: [ScreenVertex; 3], area: i64, id: u32, cover: Opacity) {
        let Some(tiles) = self.sample_bounds().touched_tiles(corners) else { return };
        if let Some(piece) = assemble_triangle(corners, area, id, cover) {
            self.triangles.push(piece, tiles);
        }
    }

    fn push_clipped(
        &mut self,
        corners: [ScreenVertex; 3],
        [at_p, at_q, at_r]: SourceWeights,
        id: u32,
        cover: Opacity,
    ) {
        let Some(tiles) = self.sample_bounds().touched_tiles(corners) else { return };
        let [p, q, r] = corners;
        let (corners, weights) = match signed_area(corners) {
            0 => return,
            1.. => (corners, [at_p, at_q, at_r]),
            _ => ([p, r, q], [at_p, at_r, at_q]),
        };
        let source = WeightSource::Clipped(self.source_weights.len() as u32);
        self.source_weights.push(weights);
        self.triangles.push(
            ScreenTriangle { corners: normalize_inv_w(corners), id, source, opacity: cover },
            tiles,
        );
    }

    fn sample_bounds(&self) -> SampleBounds {
        SampleBounds { grid: TileGrid::new(self.region), offset_range: self.samples.offset_range() }
    }
}

/// The part of a picture from the pixel `corner` on, if there is one of this size.
fn check_region(corner: [u32; 2], size: [u32; 2]) -> Result<FrameRegion, RasterError> {
    let ([x, y], [width, height]) = (corner, size);
    let fits = |from: u32, side: u32| {
        side > 0 && from.checked_add(side).is_some_and(|end| end <= MAX_SIDE)
    };
    if !fits(x, width) || !fits(y, height) {
        return Err(RasterError::Size { x, y, width, height });
    }
    Ok(FrameRegion { x, y, width, height })
}

/// A mesh on its way into a frame.
struct MeshTriangles<'a> {
    vertices: &'a [Option<ScreenVertex>],
    triangles: &'a [[u32; 3]],
    first_id: u32,
    sample_bounds: SampleBounds,
    opacity: Opacity,
    cull: CullMode,
}

impl MeshTriangles<'_> {
    /// Appends the pieces of some of its triangles.
    fn assemble_triangles(&self, run: Range<usize>, chunk: &mut TriangleChunk) {
        let vertex = |n: u32| self.vertices.get(n as usize).copied().flatten();
        let first_id = self.first_id.wrapping_add(run.start as u32);
        let end = run.end.min(self.triangles.len());
        let triangles = self.triangles.get(run.start..end).unwrap_or_default();
        chunk.reserve(triangles.len());
        for (id, &[p, q, r]) in (first_id..).zip(triangles) {
            let (Some(p), Some(q), Some(r)) = (vertex(p), vertex(q), vertex(r)) else { continue };
            let area = signed_area([p, q, r]);
            if !self.cull.retains(area) {
                continue;
            }
            let Some(tiles) = self.sample_bounds.touched_tiles([p, q, r]) else { continue };
            if let Some(piece) = assemble_triangle([p, q, r], area, id, self.opacity) {
                chunk.push(piece, tiles);
            }
        }
    }
}

/// A whole triangle as a piece; `None` if it has no area.
#[inline(always)]
fn assemble_triangle(
    [p, q, r]: [ScreenVertex; 3],
    area: i64,
    id: u32,
    cover: Opacity,
) -> Option<ScreenTriangle> {
    let (corners, source) = match area {
        0 => return None,
        1.. => ([p, q, r], WeightSource::Unclipped),
        _ => ([p, r, q], WeightSource::Flipped),
    };
    Some(ScreenTriangle { corners: normalize_inv_w(corners), id, source, opacity: cover })
}

/// Which triangles are kept: those that may cover a sample of the picture's part.
#[derive(Clone, Copy)]
struct SampleBounds {
    grid: TileGrid,
    /// The least and the greatest offset of samples.
    offset_range: (i32, i32),
}

impl SampleBounds {
    /// The tiles of the part that a triangle's bounds touch; `None` if it touches none, or if its bounds hold no sample: of meshes
    /// finer than the pixels most triangles hold none.
    #[inline(always)]
    fn touched_tiles(&self, [p, q, r]: [ScreenVertex; 3]) -> Option<TileRange> {
        let (least, greatest) = self.offset_range;
        // Pixels from the first whose last sample is not before the bounds to the last whose first is not behind.
        let holds = |[low, high]: [i32; 2]| {
            (low - greatest + 255) >> SUBPIXEL_BITS <= (high - least) >> SUBPIXEL_BITS
        };
        let x = [p.x.min(q.x).min(r.x), p.x.max(q.x).max(r.x)];
        let y = [p.y.min(q.y).min(r.y), p.y.max(q.y).max(r.y)];
        if holds(x) & holds(y) { self.grid.tiles_in_bounds(x, y) } else { None }
    }
}
