//! Adds clipped meshes to a frame: transforms positions and clips triangles before the divide.
//!
//! ```text
//!   positions ─source_to_clip─► outcodes ─► all inside ──────────────► ÷ w, snap ─► frame
//!                                        └► some outside ─► clip_triangle ─┘
//! ```
//!
//! [`Frame::add_mesh`] accepts vertices on the screen, where a vertex behind the eye has no
//! position. Triangles with such a vertex are omitted, for example a floor under the viewer's feet.
//! Clipping cuts such triangles at the near plane while they are still in homogeneous coordinates
//! (CL-3). At the sides of the picture, a guard band far outside it replaces the planes (CL-4).

use crate::{CullMode, Frame, GUARD_BAND, Opacity, ScreenVertex, VertexProjection, signed_area};
use clip::{ClippedSegment, Outcode, Volume, clip_segment, clip_triangle};
use homog::{Affine, Clip, ClipRange, HPoint, Ndc, Projective, Screen, Space};
use viewport::Viewport;

/// The map from clip space to the pixels of a frame, with the clipping volume.
#[derive(Clone, Copy, Debug)]
pub struct ScreenProjection {
    ndc_to_screen: Affine<Ndc, Screen>,
    /// The near and far planes, and the sides moved out to the guard band.
    volume: Volume,
    /// The sign that relates the winding on the screen to the winding in clip space.
    winding: f64,
}

/// A mesh in model, world or any other space, to pass to [`Frame::add_clipped_mesh`].
#[derive(Clone, Copy, Debug, Default)]
#[non_exhaustive]
pub struct SourceMesh<'a> {
    /// The positions of the vertices.
    pub positions: &'a [[f32; 3]],
    /// The indices of each triangle's vertices.
    pub triangles: &'a [[u32; 3]],
    /// The id of the first triangle; the others count up from it.
    pub first_id: u32,
    /// How the triangles affect visibility.
    pub opacity: Opacity,
    /// The winding of the triangles to cull.
    pub cull: CullMode,
}

impl<'a> SourceMesh<'a> {
    /// Creates a mesh of opaque triangles with ids that count up from 0, without culling.
    #[must_use]
    pub const fn new(positions: &'a [[f32; 3]], triangles: &'a [[u32; 3]]) -> Self {
        let (opacity, cull) = (Opacity::Opaque, CullMode::Nothing);
        Self { positions, triangles, first_id: 0, opacity, cull }
    }

    /// Returns this mesh with ids that count up from `first_id`.
    #[must_use]
    pub const fn with_first_id(self, first_id: u32) -> Self {
        Self { first_id, ..self }
    }

    /// Returns this mesh with another opacity, such as alpha tested or translucent.
    #[must_use]
    pub const fn with_opacity(self, opacity: Opacity) -> Self {
        Self { opacity, ..self }
    }

    /// Returns this mesh with triangles of one winding culled.
    #[must_use]
    pub const fn with_culling(self, cull: CullMode) -> Self {
        Self { cull, ..self }
    }
}

impl ScreenProjection {
    /// Creates a projection through a viewport, for example one from [`Viewport::image_for`] with
    /// the frame's size and the projection's convention.
    #[must_use]
    pub fn new(viewport: &Viewport) -> Self {
        // The grid covers the pixel coordinates in GUARD_BAND; one pixel on each side is a margin
        // for rounding in the divide.
        let area = viewport.area();
        let band = |side: f64, center: f64| {
            let half = 0.5 * side;
            let low = center / half - (GUARD_BAND.start() + 1.0) / half;
            let high = (GUARD_BAND.end() - 1.0) / half - center / half;
            low.min(high).clamp(1.0, Volume::MAX_GUARD_BAND)
        };
        let [x, y] = area.center();
        let volume = Volume::for_range(viewport.range());
        let guarded = volume.with_guard_band(band(area.width(), x), band(area.height(), y));
        let rows = viewport.ndc_to_screen().rows();
        Self {
            ndc_to_screen: viewport.ndc_to_screen(),
            volume: guarded.unwrap_or(volume),
            winding: rows[0][0].signum() * rows[1][1].signum(),
        }
    }

    /// Creates a projection to an image of `width` × `height` pixels. `range` is the clip range of
    /// the projection matrix: a [`ClipRange`] or a `projection::Convention`.
    ///
    /// # Errors
    /// Returns an error if the image has no pixels.
    pub fn for_image(
        width: u32,
        height: u32,
        range: impl Into<ClipRange>,
    ) -> Result<Self, viewport::ViewportError> {
        Ok(Self::new(&Viewport::image_for(width, height, range)?))
    }

    /// Returns the clipping volume.
    #[must_use]
    pub const fn volume(&self) -> &Volume {
        &self.volume
    }

    /// Returns this projection with another clipping volume, for example with additional planes or
    /// without a near or far plane.
    #[must_use]
    pub const fn with_volume(self, volume: Volume) -> Self {
        Self { volume, ..self }
    }

    /// Returns the viewport transform.
    #[must_use]
    pub const fn ndc_to_screen(&self) -> Affine<Ndc, Screen> {
        self.ndc_to_screen
    }

    /// Divides a point by w, applies the viewport transform and snaps it. Returns `None` if the
    /// point cannot be drawn without clipping.
    #[must_use]
    #[inline]
    pub fn snap(&self, point: HPoint<Clip>) -> Option<ScreenVertex> {
        ScreenVertex::snap(self.ndc_to_screen.transform_point(point.divide()?), point.w())
    }

    /// Returns the screen vertices of a primitive, or `None` if any of them cannot be drawn.
    #[must_use]
    #[inline]
    pub fn snap_all<const N: usize>(&self, points: [HPoint<Clip>; N]) -> Option<[ScreenVertex; N]> {
        let mut vertices = [self.snap(*points.first()?)?; N];
        for (vertex, point) in vertices.iter_mut().zip(points).skip(1) {
            *vertex = self.snap(point)?;
        }
        Some(vertices)
    }

    /// Returns whether a triangle that may extend behind the eye survives culling.
    ///
    /// Its winding before the divide is the sign of the determinant of its vertices' (x, y, w)
    /// (Olano and Greer, *Triangle Scan Conversion using 2D Homogeneous Coordinates*, 1997).
    /// It is correct even with vertices behind the eye, where the divide would reverse the winding.
    fn retains(&self, cull: CullMode, [p, q, r]: [HPoint<Clip>; 3]) -> bool {
        let [[px, py, _, pw], [qx, qy, _, qw], [rx, ry, _, rw]] = [p, q, r].map(<[f64; 4]>::from);
        let determinant =
            px * (qy * rw - ry * qw) + py * (qw * rx - rw * qx) + pw * (qx * ry - rx * qy);
        cull.retains(sign(determinant * self.winding))
    }
}

/// Returns the sign of a number as −1, 0 or 1, with 0 for NaN.
fn sign(x: f64) -> i64 {
    i64::from(x > 0.0) - i64::from(x < 0.0)
}

impl Frame {
    /// Adds a mesh in any space: transforms it, clips it before the divide, culls it and snaps it.
    /// Triangles that cross the near plane are cut there; the weights of their fragments refer to
    /// the whole triangle.
    ///
    /// ```
    /// use projection::{Convention, Fov, Perspective};
    /// use raster::{Frame, Samples, ScreenProjection, SourceMesh};
    ///
    /// // A floor one unit below the eye, from behind it to the horizon.
    /// let corners = [[-900.0, -1.0, 9.0], [900.0, -1.0, 9.0], [0.0, -1.0, -900.0]];
    /// let floor = SourceMesh::new(&corners, &[[0, 1, 2]]);
    ///
    /// let lens = Perspective::new(Fov::vertical_degrees(60.0), 4.0 / 3.0, 0.1, 100.0)?;
    /// let convention = Convention::VULKAN;
    /// let screen = ScreenProjection::for_image(48, 36, convention)?;
    /// let mut frame = Frame::new(48, 36, Samples::One)?;
    /// frame.add_clipped_mesh(&screen, lens.view_to_clip(convention), floor);
    ///
    /// let ids = frame.visibility_buffer().ids;
    /// // The floor covers the lower half: 18 rows of 48 pixels.
    /// assert_eq!(ids.iter().filter(|id| id.is_some()).count(), 864);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn add_clipped_mesh<S: Space>(
        &mut self,
        screen: &ScreenProjection,
        source_to_clip: Projective<S, Clip>,
        mesh: SourceMesh<'_>,
    ) {
        let SourceMesh { positions, triangles, first_id, opacity, cull } = mesh;
        let (mut vertices, simd_level) = (Vec::new(), self.simd_level());
        if screen.holds_box_of(source_to_clip, positions) {
            let (ndc_to_screen, threads) = (screen.ndc_to_screen, 1);
            let way =
                VertexProjection { to_clip: source_to_clip, ndc_to_screen, simd_level, threads };
            way.project_positions(positions, &mut vertices);
            return self.add_mesh(&vertices, triangles, first_id, opacity, cull);
        }
        let mut points = vec![HPoint::new(0.0, 0.0, 0.0, 1.0); positions.len()];
        let mut outcodes = vec![Outcode::INSIDE; positions.len()];
        screen.volume.project_positions(source_to_clip, positions, &mut points, &mut outcodes);
        vertices.resize(positions.len(), None);
        ScreenVertex::divide_and_snap_points(
            &points,
            screen.ndc_to_screen,
            simd_level,
            &mut vertices,
        );
        // A vertex between the eye and the near plane may still project onto the screen.
        for (vertex, code) in vertices.iter_mut().zip(&outcodes) {
            *vertex = vertex.filter(|_| code.is_inside());
        }
        for (id, triangle) in (first_id..).zip(triangles) {
            let corners = triangle.map(|index| vertices.get(index as usize).copied().flatten());
            if let [Some(p), Some(q), Some(r)] = corners {
                if cull.retains(signed_area([p, q, r])) {
                    self.add_triangle([p, q, r], id, opacity);
                }
                continue;
            }
            let corners = triangle.map(|index| points.get(index as usize).copied());
            if let [Some(p), Some(q), Some(r)] = corners {
                self.clip_triangle(screen, [p, q, r], id, opacity, cull);
            }
        }
    }

    /// Clips a triangle in clip space and adds the visible part.
    pub fn clip_triangle(
        &mut self,
        screen: &ScreenProjection,
        points: [HPoint<Clip>; 3],
        id: u32,
        opacity: Opacity,
        cull: CullMode,
    ) {
        if !screen.retains(cull, points) {
            return;
        }
        // Add the clipped polygon as a fan.
        for part in clip_triangle(points, &screen.volume).triangles() {
            if let Some(corners) = screen.snap_all(part.map(|vertex| vertex.point)) {
                let weights = part.map(|vertex| vertex.weights.map(|weight| weight as f32));
                self.add_clipped_triangle(corners, weights, id, opacity);
            }
        }
    }

    /// Clips a line in clip space and adds the visible part, `width` pixels wide.
    pub fn clip_line(
        &mut self,
        screen: &ScreenProjection,
        ends: [HPoint<Clip>; 2],
        width: f64,
        id: u32,
        opacity: Opacity,
    ) {
        let Some(visible) = clip_segment(ends[0], ends[1], &screen.volume) else { return };
        let ClippedSegment { start, end, t0, t1, .. } = visible;
        if let Some(ends) = screen.snap_all([start, end]) {
            self.add_clipped_line(ends, [t0 as f32, t1 as f32], width, id, opacity);
        }
    }
}

impl ScreenProjection {
    /// Returns whether the bounding box of the positions is inside the volume, so that no clipping
    /// is needed.
    fn holds_box_of<S: Space>(
        &self,
        source_to_clip: Projective<S, Clip>,
        positions: &[[f32; 3]],
    ) -> bool {
        let (mut least, mut greatest) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
        let mut is_finite = true;
        for position in positions {
            for axis in 0..3 {
                least[axis] = least[axis].min(position[axis]);
                greatest[axis] = greatest[axis].max(position[axis]);
                is_finite &= position[axis].is_finite();
            }
        }
        if !is_finite || positions.is_empty() {
            return false;
        }
        let ends = [least, greatest];
        let corners: [[f32; 3]; 8] =
            std::array::from_fn(|corner| [0, 1, 2].map(|axis| ends[corner >> axis & 1][axis]));
        let mut points = corners.map(|_| HPoint::new(0.0, 0.0, 0.0, 1.0));
        let mut outcodes = [Outcode::INSIDE; 8];
        self.volume
            .project_positions(source_to_clip, &corners, &mut points, &mut outcodes)
            .is_inside()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn winding_is_correct_with_vertices_behind_the_eye() {
        let screen =
            |range| ScreenProjection::new(&Viewport::image_for(8, 8, range).expect("size"));
        let up = screen(ClipRange::CHAPTER);
        let corners =
            [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)].map(|(x, y)| HPoint::new(x, y, 0.0, 1.0));
        let [p, q, r] = corners;
        // Moving a vertex through the plane of the eye, along the line from another vertex, leaves
        // the same face visible.
        let [[qx, qy, ..], [rx, ry, ..]] = [q, r].map(<[f64; 4]>::from);
        let behind = HPoint::new(4.0 * qx - 3.0 * rx, 4.0 * qy - 3.0 * ry, 0.0, 1.0);
        for triangle in [[p, q, r], [p, behind, r]] {
            let [a, b, c] = triangle;
            // Counterclockwise in the picture: a front face.
            assert!(up.retains(CullMode::Clockwise, triangle));
            assert!(!up.retains(CullMode::CounterClockwise, triangle));
            assert!(!up.retains(CullMode::Clockwise, [a, c, b]));
            assert!(up.retains(CullMode::Nothing, [a, c, b]));
            // With y down, the same coordinates show the other face.
            assert!(!screen(ClipRange::VULKAN).retains(CullMode::Clockwise, triangle));
        }
    }
}
