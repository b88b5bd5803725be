//! Vertex attributes in fragments, with perspective-correct interpolation.

use crate::Fragment;
use homog::Interpolate;

impl Fragment<'_> {
    /// Interpolates an attribute at this fragment from its values at the three vertices of the
    /// primitive (IN-2).
    #[must_use]
    #[inline(always)]
    pub fn interpolate<A: Interpolate>(&self, values: [A; 3]) -> A {
        A::weighted_sum_f32(values, self.weights)
    }

    /// Returns the derivative of an attribute with respect to the column: its change per pixel to
    /// the right.
    #[must_use]
    #[inline]
    pub fn interpolate_dx<A: Interpolate>(&self, values: [A; 3]) -> A {
        A::weighted_sum_f32(values, self.weights_dx())
    }

    /// Returns the derivative of an attribute with respect to the row: its change per pixel down.
    #[must_use]
    #[inline]
    pub fn interpolate_dy<A: Interpolate>(&self, values: [A; 3]) -> A {
        A::weighted_sum_f32(values, self.weights_dy())
    }
}

/// A vertex attribute of a mesh: texture coordinates, colors, or a struct of several attributes.
///
/// ```
/// use homog::Point;
/// use raster::{CullMode, Frame, Opacity, Samples, ScreenVertex, VertexAttribute, surface_fn};
///
/// let colors = [[1.0_f32, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// let triangles = [[0_u32, 1, 2]];
/// let places = [(0.0, 8.0), (8.0, 8.0), (4.0, 0.0)];
/// let vertices = places.map(|(x, y)| ScreenVertex::snap(Point::new(x, y, 0.5), 1.0));
/// let mut frame = Frame::new(8, 8, Samples::Four)?;
/// frame.add_mesh(&vertices, &triangles, 0, Opacity::Opaque, CullMode::Nothing);
///
/// let color = VertexAttribute::new(&triangles, &colors);
/// let surface = surface_fn(|fragment| {
///     let [r, g, b] = color.at(fragment);
///     [r, g, b, 1.0]
/// });
/// let mut pixels = vec![[0.0_f32; 4]; 64];
/// frame.draw(&surface, [0.0; 4], 1, &mut pixels, |color: [f32; 4]| color);
/// let [r, g, b, alpha] = pixels[8 * 7 + 1];
/// assert!(r > 0.7 && g < 0.2 && b < 0.2 && alpha == 1.0);
/// # Ok::<(), raster::RasterError>(())
/// ```
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct VertexAttribute<'a, A> {
    /// The id of the first triangle.
    pub first_id: u32,
    /// The triangles of the mesh.
    pub triangles: &'a [[u32; 3]],
    /// The value at each vertex.
    pub values: &'a [A],
}

impl<'a, A: Interpolate> VertexAttribute<'a, A> {
    /// Creates an attribute from its values at the vertices of a mesh whose triangle ids count up
    /// from 0.
    #[must_use]
    pub const fn new(triangles: &'a [[u32; 3]], values: &'a [A]) -> Self {
        Self { first_id: 0, triangles, values }
    }

    /// Returns this attribute for a mesh whose triangle ids count up from `first_id`.
    #[must_use]
    pub const fn with_first_id(self, first_id: u32) -> Self {
        Self { first_id, ..self }
    }

    /// Returns the value at a fragment of the mesh.
    ///
    /// # Panics
    /// Panics if the fragment does not belong to a triangle of the mesh or if a vertex has no
    /// value.
    #[must_use]
    #[inline(always)]
    pub fn at(&self, fragment: &Fragment<'_>) -> A {
        fragment.interpolate(self.corners(fragment.id))
    }

    /// Returns the change of the value per pixel to the right and down. Use it to choose the mip
    /// level of a texture.
    ///
    /// # Panics
    /// Panics in the same cases as [`at`](Self::at).
    #[must_use]
    #[inline]
    pub fn derivatives(&self, fragment: &Fragment<'_>) -> [A; 2] {
        let corners = self.corners(fragment.id);
        [fragment.interpolate_dx(corners), fragment.interpolate_dy(corners)]
    }

    /// Returns the values at the corners of a triangle.
    #[inline(always)]
    fn corners(&self, id: u32) -> [A; 3] {
        let triangle = self.triangles[id.wrapping_sub(self.first_id) as usize];
        triangle.map(|vertex| self.values[vertex as usize])
    }
}
