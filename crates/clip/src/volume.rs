//! View volumes as tables of planes in clip space.
//!
//! A plane is a row (a, b, c, d); a point (x, y, z, w) is inside if a x + b y + c z + d w ≥ 0. The
//! boundary is part of the volume. Conventions differ only in the two rows for z:
//!
//! | volume | near | far | depth near … far |
//! | --- | --- | --- | --- |
//! | [`Volume::CHAPTER`] | w − z ≥ 0 | w + z ≥ 0 | 1 … −1 (PE-3) |
//! | [`Volume::OPENGL`] | w + z ≥ 0 | w − z ≥ 0 | −1 … 1 (CL-1) |
//! | [`Volume::ZERO_ONE`] | z ≥ 0 | w − z ≥ 0 | 0 … 1 |
//! | [`Volume::ZERO_ONE_REVERSED`] | w − z ≥ 0 | z ≥ 0 | 1 … 0 |

use crate::sutherland_hodgman::safe_scale;
use crate::{MAX_PLANES, Outcode, PlaneIndex};
use core::fmt;
use glam::DVec4;
use homog::{Clip, ClipRange, HPoint, Plane};
use thiserror::Error;

/// An error in adding a plane or setting a guard band.
#[derive(Clone, Copy, PartialEq, Debug, Error)]
#[non_exhaustive]
pub enum VolumeError {
    /// A coefficient of a plane is infinite or NaN, or all are zero.
    #[error(
        "{coefficients:?} is not a plane: its four coefficients must be finite and not all zero"
    )]
    NoPlane {
        /// The coefficients (a, b, c, d).
        coefficients: [f64; 4],
    },
    /// All plane slots are in use.
    #[error("too many planes: a volume has at most {MAX_PLANES}, six for the box and ten more")]
    TooManyPlanes,
    /// A guard band factor is out of range.
    #[error(
        "guard band factor {name} = {value} is out of range: it must be from 1 to {max}",
        max = Volume::MAX_GUARD_BAND
    )]
    GuardBand {
        /// The name of the parameter, `kx` or `ky`.
        name: &'static str,
        /// The rejected value.
        value: f64,
    },
}

/// A convex part of clip space, as a table of at most [`MAX_PLANES`] planes.
///
/// ```
/// use clip::{PlaneIndex, Volume};
/// use homog::HPoint;
/// let point = HPoint::new(0.0, 0.0, -3.0, 2.0);
/// assert!(Volume::CHAPTER.outcode(point).contains(PlaneIndex::FAR));
/// assert!(Volume::OPENGL.outcode(point).contains(PlaneIndex::NEAR));
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Volume {
    planes: [DVec4; MAX_PLANES],
    active_planes: Outcode,
}

impl Volume {
    /// [−1, 1]³ with near at z = +1: the volume of the textbook (Shirley and Marschner, ch. 8) and
    /// of the pipeline (PE-3).
    pub const CHAPTER: Self = Self::canonical(ClipRange::CHAPTER);
    /// [−1, 1]³ with near at z = −1: OpenGL's volume (CL-1, GL-1).
    pub const OPENGL: Self = Self::canonical(ClipRange::OPENGL);
    /// z in [0, 1] with near at 0: used by Direct3D, Vulkan, Metal and WebGPU (CL-1, D3D-1 to
    /// D3D-6).
    pub const ZERO_ONE: Self = Self::canonical(ClipRange::ZERO_ONE);
    /// z in [0, 1] with near at 1: the same APIs with reversed depth (RV-1).
    pub const ZERO_ONE_REVERSED: Self = Self::canonical(ClipRange::ZERO_ONE.reversed());
    /// The widest guard band; beyond it, plane equations would lose too many digits.
    pub const MAX_GUARD_BAND: f64 = 1_048_576.0;

    /// Returns the canonical volume for a clip range, given as a [`ClipRange`] or a
    /// `projection::Convention`.
    ///
    /// y runs from −w to w whether it points up or down, so only the depth range matters here.
    ///
    /// ```
    /// use clip::Volume;
    /// use homog::ClipRange;
    /// assert_eq!(Volume::for_range(ClipRange::VULKAN), Volume::ZERO_ONE);
    /// ```
    #[must_use]
    pub fn for_range(range: impl Into<ClipRange>) -> Self {
        Self::canonical(range.into())
    }

    const fn canonical(range: ClipRange) -> Self {
        // Each depth plane faces the other, so the order of the depths gives the sign.
        // Adding to 0 keeps −0 out of the table.
        let (near, far) = (range.near_depth(), range.far_depth());
        let side = if far < near { -1.0 } else { 1.0 };
        let near = DVec4::new(0.0, 0.0, side, 0.0 - side * near);
        let far = DVec4::new(0.0, 0.0, -side, 0.0 + side * far);
        let mut planes = [DVec4::ZERO; MAX_PLANES];
        planes[0] = DVec4::new(1.0, 0.0, 0.0, 1.0);
        planes[1] = DVec4::new(-1.0, 0.0, 0.0, 1.0);
        planes[2] = DVec4::new(0.0, 1.0, 0.0, 1.0);
        planes[3] = DVec4::new(0.0, -1.0, 0.0, 1.0);
        planes[4] = near;
        planes[5] = far;
        Self { planes, active_planes: Outcode::from_bits(BOX_BITS) }
    }

    /// Returns this volume without its near plane, for geometry that may begin anywhere in front of
    /// the eye. The side planes keep w from becoming negative, and their cuts have w > 0 except at
    /// the eye itself.
    #[must_use]
    pub fn without_near(mut self) -> Self {
        self.active_planes = self.active_planes.without_plane(PlaneIndex::NEAR);
        self
    }

    /// Returns this volume without its far plane, for projections that extend to infinity (IF-1 to
    /// IF-3).
    #[must_use]
    pub fn without_far(mut self) -> Self {
        self.active_planes = self.active_planes.without_plane(PlaneIndex::FAR);
        self
    }

    /// Returns this volume with its sides moved out to |x| ≤ `kx` w and |y| ≤ `ky` w (CL-4).
    ///
    /// Triangles that extend beyond the image but not beyond the band need no clipping there; the
    /// rasterizer's bounding box handles them. With a band factor of k, screen coordinates are up
    /// to k times half the image size from the center.
    ///
    /// # Errors
    /// Returns [`VolumeError::GuardBand`] unless both factors are from 1 to
    /// [`Self::MAX_GUARD_BAND`].
    pub fn with_guard_band(mut self, kx: f64, ky: f64) -> Result<Self, VolumeError> {
        for (name, value) in [("kx", kx), ("ky", ky)] {
            if !(1.0..=Self::MAX_GUARD_BAND).contains(&value) {
                return Err(VolumeError::GuardBand { name, value });
            }
        }
        for (plane, k) in self.planes.iter_mut().zip([kx, kx, ky, ky]) {
            plane.w = k;
        }
        Ok(self)
    }

    /// Returns this volume with one more plane; the negative side of the plane is outside.
    ///
    /// Use [`homog::Projective::transform_plane`] for a plane in world space.
    ///
    /// # Errors
    /// Returns [`VolumeError::NoPlane`] if a coefficient is not finite or all are zero, and
    /// [`VolumeError::TooManyPlanes`] if all plane slots are in use.
    pub fn with_plane(mut self, plane: Plane<Clip>) -> Result<Self, VolumeError> {
        let largest = plane.raw().abs().max_element();
        if !plane.raw().is_finite() || largest == 0.0 {
            return Err(VolumeError::NoPlane { coefficients: plane.raw().to_array() });
        }
        let free = (PlaneIndex::BOX.len()..MAX_PLANES).filter_map(PlaneIndex::new);
        let free = free.clone().find(|&place| !self.active_planes.contains(place));
        let place = free.ok_or(VolumeError::TooManyPlanes)?;
        self.planes[place.index()] = plane.raw() / largest;
        self.active_planes = self.active_planes.with_plane(place);
        Ok(self)
    }

    /// Returns the set of planes that bound the volume.
    #[must_use]
    pub const fn active_planes(&self) -> Outcode {
        self.active_planes
    }

    /// Returns the plane with this index, scaled so that its largest coefficient has magnitude 1
    /// (or the guard band factor), or `None` if the volume has no such plane.
    #[must_use]
    pub fn plane(&self, index: PlaneIndex) -> Option<Plane<Clip>> {
        let present = self.active_planes.contains(index);
        present.then(|| Plane::from_raw(self.planes[index.index()]))
    }

    /// Returns the planes that a point is outside of (CL-1): all, if the point is not finite.
    #[inline]
    #[must_use]
    pub fn outcode(&self, point: HPoint<Clip>) -> Outcode {
        let raw = point.raw();
        // Most points of most pictures are inside, so this fast test comes first.
        if self.active_planes.bits() & !BOX_BITS == 0 && self.is_in_box(raw) {
            return Outcode::INSIDE;
        }
        if raw.is_finite() { self.full_outcode(raw) } else { self.active_planes }
    }

    /// Returns whether a point is certainly finite and inside all six planes of the box, including
    /// any that the volume lacks.
    #[inline]
    fn is_in_box(&self, point: DVec4) -> bool {
        /// Above this, the bounds of x and y may overflow.
        const SAFE: f64 = 1e300;
        let along_z = |plane: DVec4| plane.z * point.z + plane.w * point.w >= 0.0;
        (point.x.abs() <= self.planes[0].w * point.w)
            & (point.y.abs() <= self.planes[2].w * point.w)
            & along_z(self.planes[4])
            & along_z(self.planes[5])
            & (point.z.abs() < SAFE)
            & (point.w < SAFE)
    }

    /// Returns the outcode of a finite point. For the box, the sums in [`Self::plane_distance`] are
    /// computed without their zero terms; their signs are correct even on overflow.
    #[inline]
    fn full_outcode(&self, point: DVec4) -> Outcode {
        let [kx, ky] = [self.planes[0].w * point.w, self.planes[2].w * point.w];
        let along_z = |plane: DVec4| plane.z * point.z + plane.w * point.w;
        let distances = [
            kx + point.x,
            kx - point.x,
            ky + point.y,
            ky - point.y,
            along_z(self.planes[4]),
            along_z(self.planes[5]),
        ];
        let mut bits = 0;
        for (i, distance) in distances.into_iter().enumerate() {
            bits |= u16::from(distance < 0.0) << i;
        }
        let boxed = Outcode::from_bits(bits & self.active_planes.bits());
        if self.active_planes.bits() & !BOX_BITS == 0 {
            boxed
        } else {
            boxed | self.added_outcode(point)
        }
    }

    fn added_outcode(&self, point: DVec4) -> Outcode {
        let added = Outcode::from_bits(self.active_planes.bits() & !BOX_BITS);
        let scaled = point * safe_scale(&[point]);
        let outside = |&plane: &PlaneIndex| self.plane_distance(plane, scaled) < 0.0;
        added.planes().filter(outside).fold(Outcode::INSIDE, Outcode::with_plane)
    }

    /// Returns whether the point is inside or on the boundary, finite, and not the zero vector,
    /// which is not a point.
    #[must_use]
    pub fn contains(&self, point: HPoint<Clip>) -> bool {
        point.w() > 0.0 && self.outcode(point).is_inside()
    }

    /// Returns the signed distance of a point from a plane, in the plane's units; positive inside.
    pub(crate) fn plane_distance(&self, index: PlaneIndex, point: DVec4) -> f64 {
        self.planes[index.index()].dot(point)
    }

    /// Moves a computed crossing exactly onto its plane, if the plane is one of the box. User
    /// planes are usually oblique, so no single coordinate could be set.
    pub(crate) fn snap_to_plane(&self, index: PlaneIndex, mut point: DVec4) -> DVec4 {
        if index <= PlaneIndex::FAR {
            let (axis, plane) = (index.index() / 2, self.planes[index.index()]);
            point[axis] = 0.0 - plane[axis] * (plane.w * point.w);
        }
        point
    }

    /// Moves a point that rounding left just outside the box onto it, so clipping is idempotent.
    pub(crate) fn clamp_to_box(&self, point: DVec4) -> DVec4 {
        let outside = self.full_outcode(point).planes();
        outside.fold(point, |point, index| self.snap_to_plane(index, point))
    }
}

impl fmt::Display for Volume {
    /// Writes one line per plane, with its name and coefficients.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.active_planes.planes().try_for_each(|index| {
            let row = self.planes[index.index()];
            writeln!(f, "{index:>8}  {:6} {:6} {:6} {:6}", row.x, row.y, row.z, row.w)
        })
    }
}

/// The bits of the six planes of the box.
const BOX_BITS: u16 = 0b11_1111;

#[cfg(test)]
mod tests {
    use super::*;

    fn codes(volume: Volume, points: [[f64; 4]; 4]) -> [u16; 4] {
        points.map(|p| volume.outcode(p.into()).bits())
    }

    #[test]
    fn conventions_differ_only_in_the_depth_rows() {
        let behind_far_low_none = [
            [0.0, 0.0, -2.0, 1.0],
            [0.0, 0.0, -0.5, 1.0],
            [0.0, 0.0, 2.0, 1.0],
            [9.0, -9.0, 0.5, 1.0],
        ];
        let [near, far] = [1 << 4, 1 << 5];
        assert_eq!(codes(Volume::CHAPTER, behind_far_low_none), [far, 0, near, 0b110]);
        assert_eq!(codes(Volume::OPENGL, behind_far_low_none), [near, 0, far, 0b110]);
        assert_eq!(codes(Volume::ZERO_ONE, behind_far_low_none), [near, near, far, 0b110]);
        assert_eq!(codes(Volume::ZERO_ONE_REVERSED, behind_far_low_none), [far, far, near, 0b110]);
        assert_eq!(codes(Volume::CHAPTER.without_far(), behind_far_low_none), [0, 0, near, 0b110]);
    }

    #[test]
    fn boundary_points_are_inside_and_nonfinite_points_are_outside() {
        for x in [-1.0, 1.0] {
            assert!(Volume::CHAPTER.contains(HPoint::new(x, x, x, 1.0)));
            assert!(!Volume::CHAPTER.contains(HPoint::new(x * 1.0000000000000002, x, x, 1.0)));
        }
        for bad in [f64::NAN, f64::INFINITY] {
            for i in 0..4 {
                let mut p = [0.0, 0.0, 0.0, 1.0];
                p[i] = bad;
                assert_eq!(Volume::CHAPTER.outcode(p.into()).bits(), 0b11_1111, "{p:?}");
            }
        }
        assert!(!Volume::CHAPTER.contains(HPoint::new(0.0, 0.0, 0.0, 0.0)));
        assert!(Volume::CHAPTER.contains(HPoint::new(f64::MAX, -f64::MAX, 0.0, f64::MAX)));
    }

    #[test]
    fn negative_depth_is_outside_however_large_the_other_coordinates() {
        let behind = HPoint::new(0.0, f64::MAX, -3e-310, f64::MAX);
        assert_eq!(Volume::ZERO_ONE.outcode(behind).bits(), 1 << 4);
        assert_eq!(Volume::ZERO_ONE.outcode(HPoint::new(0.0, f64::MAX, 0.0, 1e159)).bits(), 1 << 3);
    }

    #[test]
    fn guard_bands_and_planes_are_validated() {
        let band = Volume::CHAPTER.with_guard_band(8.0, 2.0).expect("allowed");
        assert_eq!(band.outcode(HPoint::new(7.0, 3.0, 0.0, 1.0)).bits(), 1 << 3);
        for k in [0.5, -1.0, 1e9, f64::NAN, f64::INFINITY] {
            assert!(Volume::CHAPTER.with_guard_band(1.0, k).is_err(), "{k}");
        }
        let through_the_middle = Plane::from_raw(DVec4::new(1e300, 0.0, 0.0, 0.0));
        let mut volume = Volume::CHAPTER;
        for _ in 0..10 {
            volume = volume.with_plane(through_the_middle).expect("a free slot");
        }
        assert_eq!(volume.outcode(HPoint::new(-0.5, 0.0, 0.0, 1.0)).bits(), 0xffc0);
        assert_eq!(volume.with_plane(through_the_middle), Err(VolumeError::TooManyPlanes));
        for bad in [DVec4::ZERO, DVec4::NAN, DVec4::INFINITY] {
            assert!(Volume::CHAPTER.with_plane(Plane::from_raw(bad)).is_err());
        }
    }
}
