//! Vertex attributes, fetched for the primitives of fragments and interpolated.
//!
//! The rasterizer writes a visibility buffer: the primitive of each fragment and the barycentric
//! weights of its vertices. Attributes are fetched only when a fragment is shaded, and only once
//! for all lanes if these belong to the same primitive.

use super::lanes::Lanes;

/// The vertex attributes that most draws need, in half a cache line.
///
/// These are the position and unit normal in the world, and the texture coordinates that most
/// textures use. They begin at [`POSITION`], [`NORMAL`] and [`UV`].
pub type Vertex = [f32; 8];

/// The offset of the position in a [`Vertex`].
pub const POSITION: usize = 0;
/// The offset of the normal in a [`Vertex`].
pub const NORMAL: usize = 3;
/// The offset of the texture coordinates in a [`Vertex`].
pub const UV: usize = 6;

/// An attribute with `K` components for each of three vertices, in all lanes.
pub(super) type Attributes<const N: usize, const K: usize> = [[Lanes<N>; K]; 3];

/// The vertex indices of the primitives of `N` fragments.
#[derive(Clone, Copy, Debug)]
pub(super) enum VertexIndices<const N: usize> {
    /// All fragments belong to one primitive.
    One([usize; 3]),
    /// Each fragment may belong to a different primitive.
    Each([[usize; 3]; N]),
}

/// The indices of the primitives of `N` fragments within their draw.
#[derive(Clone, Copy, Debug)]
pub(super) enum PrimitiveIndices<const N: usize> {
    /// All fragments belong to one primitive.
    One(usize),
    /// Each fragment may belong to a different primitive.
    Each([usize; N]),
}

impl<const N: usize> PrimitiveIndices<N> {
    /// Returns the vertices of each primitive; `vertices_of` finds them by its index.
    #[inline(always)]
    pub(super) fn vertex_indices(
        &self,
        vertices_of: impl Fn(usize) -> [usize; 3],
    ) -> VertexIndices<N> {
        match self {
            Self::One(primitive) => VertexIndices::One(vertices_of(*primitive)),
            Self::Each(primitives) => {
                let mut vertices = [[0; 3]; N];
                for (vertices, primitive) in vertices.iter_mut().zip(primitives) {
                    *vertices = vertices_of(*primitive);
                }
                VertexIndices::Each(vertices)
            }
        }
    }
}

impl<const N: usize> VertexIndices<N> {
    /// Fetches an attribute with `K` components, starting at `offset`, for each vertex.
    #[inline(always)]
    pub(super) fn fetch_attributes<const M: usize, const K: usize>(
        &self,
        values: &[[f32; M]],
        offset: usize,
    ) -> Attributes<N, K> {
        let mut attributes = [[Lanes::ZERO; K]; 3];
        match self {
            Self::One(vertices) => {
                for (attribute, &vertex) in attributes.iter_mut().zip(vertices) {
                    let value = &values[vertex];
                    for (k, component) in attribute.iter_mut().enumerate() {
                        *component = Lanes::splat(value[offset + k]);
                    }
                }
            }
            Self::Each(vertices) => {
                // A gather, lane by lane, because each vertex may be in a different cache line.
                for (lane, vertices) in vertices.iter().enumerate() {
                    for (attribute, &vertex) in attributes.iter_mut().zip(vertices) {
                        let value = &values[vertex];
                        for (k, component) in attribute.iter_mut().enumerate() {
                            component[lane] = value[offset + k];
                        }
                    }
                }
            }
        }
        attributes
    }
}

/// Interpolates an attribute: the sum over the vertices, weighted by the barycentric weights.
///
/// Given the derivatives of the weights, this returns the derivative of the attribute.
#[inline(always)]
pub(super) fn interpolate<const N: usize, const K: usize>(
    [a, b, c]: &Attributes<N, K>,
    weights: &[Lanes<N>; 3],
) -> [Lanes<N>; K] {
    let mut values = [Lanes::ZERO; K];
    for (k, value) in values.iter_mut().enumerate() {
        *value = a[k] * weights[0] + b[k] * weights[1] + c[k] * weights[2];
    }
    values
}
