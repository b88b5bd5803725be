//! Lights, resolved: in the world, in the units of photometry.

use super::seen::dots;

/// A light of the resolved scene. Colours are linear and already multiplied by the light's strength.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Light {
    /// Parallel light from very far away.
    Sun {
        /// The unit direction towards the light.
        towards: [f32; 3],
        /// The illuminance of a surface that faces it, in lux.
        lux: [f32; 3],
    },
    /// Light from a point.
    Point {
        /// Where it is.
        position: [f32; 3],
        /// The luminous intensity in candela: lux at distance 1.
        candela: [f32; 3],
    },
    /// The same light from everywhere.
    Ambient {
        /// The illuminance of every surface, in lux.
        lux: [f32; 3],
    },
}

impl Light {
    /// Whether the place of a surface counts, not only the way it faces.
    #[inline(always)]
    pub(super) const fn is_near(&self) -> bool {
        matches!(self, Self::Point { .. })
    }

    /// Adds the illuminance, at `places`, of surfaces with the given unit normals. `places` are read only if the light
    /// [is near](Self::is_near).
    #[inline(always)]
    pub(super) fn illuminate<const N: usize>(
        &self,
        places: &[[f32; N]; 3],
        normals: &[[f32; N]; 3],
        sums: &mut [[f32; N]; 3],
    ) {
        let (color, mut shares) = match *self {
            Self::Sun { towards: [x, y, z], lux } => {
                (lux, dots(normals, &[[x; N], [y; N], [z; N]]))
            }
            Self::Point { position, candela } => (candela, falloff(position, places, normals)),
            Self::Ambient { lux } => (lux, [1.0; N]),
        };
        for share in &mut shares {
            *share = share.max(0.0);
        }
        for (sum, color) in sums.iter_mut().zip(color) {
            for lane in 0..N {
                sum[lane] += color * shares[lane];
            }
        }
    }
}

/// What a light of one candela at `position` gives, in lux; not above 0 where surfaces face away from it, or are at it.
#[inline(always)]
fn falloff<const N: usize>(
    position: [f32; 3],
    places: &[[f32; N]; 3],
    normals: &[[f32; N]; 3],
) -> [f32; N] {
    let mut ways = *places;
    for (axis, from) in ways.iter_mut().zip(position) {
        for place in axis {
            *place = from - *place;
        }
    }
    let squares = dots(&ways, &ways);
    let mut shares = dots(normals, &ways);
    for lane in 0..N {
        let distance = squares[lane].sqrt();
        // The cosine is dot / distance, and the illuminance goes with the inverse square of the distance.
        let share = shares[lane] / (distance * distance * distance);
        shares[lane] = if distance > 0.0 { share } else { 0.0 };
    }
    shares
}
