//! Packed vertex normals from a file, which determine the smooth edges of a mesh.
//!
//! A scanned or sculpted surface has facets that meet at any angle, with shared normals that make
//! it smooth. A machined part has an edge wherever the normals on the two sides differ. The angle
//! between faces cannot distinguish the two cases.
//!
//! A normal is stored as a point on an octahedron whose lower half is unfolded to form a square,
//! with 16 bits per coordinate and an error of at most 0.004° (Meyer et al., *On Floating-Point
//! Normal Vectors*, 2010).

use glam::{DVec2, DVec3};

/// An optional unit vector in the space of its primitive.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(crate) struct VertexNormal(u32);

/// Normals agree if the cosine of the angle between them is greater than this. This is 2.5°, a wide
/// tolerance, because files store normals with few bits.
const AGREEMENT_COSINE: f64 = 0.999;

/// The number of steps of a coordinate, encoded as 1 to 65,535; 0 means no normal.
const STEPS: f64 = 65_534.0;

impl VertexNormal {
    /// No normal.
    pub(crate) const NONE: Self = Self(0);

    /// Packs the direction of a vector, or returns `NONE` if it has no direction.
    pub(crate) fn pack(vector: DVec3) -> Self {
        let size = vector.abs().element_sum();
        if !(size > 0.0 && size.is_finite()) {
            return Self::NONE;
        }
        let flat = vector / size;
        let folded = if flat.z >= 0.0 {
            DVec2::new(flat.x, flat.y)
        } else {
            let sign = |x: f64| if x < 0.0 { -1.0 } else { 1.0 };
            DVec2::new((1.0 - flat.y.abs()) * sign(flat.x), (1.0 - flat.x.abs()) * sign(flat.y))
        };
        let step = |x: f64| libm::round((x * 0.5 + 0.5) * STEPS) as u32 + 1;
        Self(step(folded.x) << 16 | step(folded.y))
    }

    /// Unpacks the unit vector, or returns `None` for [`Self::NONE`].
    pub(crate) fn unpack(self) -> Option<DVec3> {
        let value = |step: u32| (f64::from(step) - 1.0) / STEPS * 2.0 - 1.0;
        let (x, y) = (value(self.0 >> 16), value(self.0 & 0xffff));
        let z = 1.0 - x.abs() - y.abs();
        let fold = (-z).max(0.0);
        let unfold = |x: f64| if x < 0.0 { x + fold } else { x - fold };
        (self != Self::NONE).then(|| DVec3::new(unfold(x), unfold(y), z).normalize_or_zero())
    }

    /// Whether both normals exist and have nearly the same direction.
    pub(crate) fn agrees_with(self, other: Self) -> bool {
        let pair = self.unpack().zip(other.unpack());
        pair.is_some_and(|(a, b)| a.dot(b) > AGREEMENT_COSINE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn packed_normals_keep_their_direction() {
        for k in 0..1000 {
            let (sine, cosine) = libm::sincos(f64::from(k) * 2.4);
            let z = f64::from(k) / 499.5 - 1.0;
            let normal =
                DVec3::new(cosine, sine, 0.0) * (1.0 - z * z).max(0.0).sqrt() + DVec3::Z * z;
            let packed = VertexNormal::pack(normal * 7.0);
            let back = packed.unpack().expect("a normal");
            assert!((back - normal).length() < 1e-4, "{normal} {back}");
            assert!(packed.agrees_with(VertexNormal::pack(normal + DVec3::splat(0.01))));
            assert!(!packed.agrees_with(VertexNormal::pack(-normal)));
        }
        assert_eq!(VertexNormal::pack(DVec3::ZERO), VertexNormal::NONE);
        assert!(!VertexNormal::NONE.agrees_with(VertexNormal::NONE));
    }
}
