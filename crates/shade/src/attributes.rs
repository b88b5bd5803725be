//! Corners: what the vertices of the fragments' primitives carry, fetched once where all are of one primitive.

/// What a vertex carries in most draws, in one line of the processor's cache.
///
/// Its place in the world, its unit normal there, and the texture coordinates that most textures are read by:
/// `PLACE`, `NORMAL` and `UV` are where they begin.
pub type Vertex = [f32; 8];

/// Where the place begins in a [`Vertex`].
pub const POSITION: usize = 0;
/// Where the normal begins in a [`Vertex`].
pub const NORMAL: usize = 3;
/// Where the texture coordinates begin in a [`Vertex`].
pub const UV: usize = 6;

/// For each corner, some of what the vertices carry, in all lanes.
pub(super) type Attributes<const N: usize, const K: usize> = [[[f32; N]; K]; 3];

/// The numbers of the vertices of some fragments' primitives.
#[derive(Clone, Copy, Debug)]
pub(super) enum VertexIndices<const N: usize> {
    /// All fragments are of one primitive.
    One([usize; 3]),
    /// Each fragment may be of a primitive of its own.
    Each([[usize; 3]; N]),
}

/// The places of some fragments' primitives among those of their draw.
#[derive(Clone, Copy, Debug)]
pub(super) enum PrimitiveIndices<const N: usize> {
    /// All fragments are of one primitive.
    One(usize),
    /// Each fragment may be of a primitive of its own.
    Each([usize; N]),
}

impl<const N: usize> PrimitiveIndices<N> {
    /// What `number` says of the corners of each.
    #[inline(always)]
    pub(super) fn vertex_indices(&self, number: impl Fn(usize) -> [usize; 3]) -> VertexIndices<N> {
        match self {
            Self::One(item) => VertexIndices::One(number(*item)),
            Self::Each(items) => {
                let mut corners = [[0; 3]; N];
                for lane in 0..N {
                    corners[lane] = number(items[lane]);
                }
                VertexIndices::Each(corners)
            }
        }
    }
}

impl<const N: usize> VertexIndices<N> {
    /// `K` numbers of each corner, from the one at `first` on.
    #[inline(always)]
    pub(super) fn fetch_attributes<const M: usize, const K: usize>(
        &self,
        values: &[[f32; M]],
        first: usize,
    ) -> Attributes<N, K> {
        let mut carried = [[[0.0; N]; K]; 3];
        match self {
            Self::One(corners) => {
                for corner in 0..3 {
                    let value = &values[corners[corner]];
                    for k in 0..K {
                        carried[corner][k] = [value[first + k]; N];
                    }
                }
            }
            Self::Each(corners) => {
                for lane in 0..N {
                    for corner in 0..3 {
                        let value = &values[corners[lane][corner]];
                        for k in 0..K {
                            carried[corner][k][lane] = value[first + k];
                        }
                    }
                }
            }
        }
        carried
    }
}

/// What the corners carry, each times its weight, summed.
#[inline(always)]
pub(super) fn interpolate<const N: usize, const K: usize>(
    [a, b, c]: &Attributes<N, K>,
    weights: &[[f32; N]; 3],
) -> [[f32; N]; K] {
    let mut blended = [[0.0; N]; K];
    for k in 0..K {
        for lane in 0..N {
            blended[k][lane] = a[k][lane] * weights[0][lane]
                + b[k][lane] * weights[1][lane]
                + c[k][lane] * weights[2][lane];
        }
    }
    blended
}
