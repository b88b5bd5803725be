//! Points to be framed, in coordinates along the camera axes relative to the center of their
//! bounds.
//!
//! Coordinates relative to the center stay accurate for small objects far from the origin. Objects
//! so small and far away that the coordinates of an eye could not distinguish their parts count as
//! one point, and one point is framed as a cube.

use crate::{Basis, Camera, FramingError};
use glam::DVec3;
use homog::{Bounds, Point, Vector, View, World};

/// The largest coordinate of a point for which sums and products with unit vectors stay finite.
const MAX_COORDINATE: f64 = 1e300;
/// Points closer together than this fraction of their distance from the origin count as one point.
const SINGLE_POINT_TOLERANCE: f64 = 1e-12;
/// An upper bound for the relative rounding error of the eye's coordinates.
const EYE_PRECISION: f64 = 1e-14;
/// The side of the cube that frames a single point, if the point's coordinates are small enough.
const SINGLE_POINT_SIDE: f64 = 1.0;
/// The minimum side as a fraction of the point's distance from the origin.
const SINGLE_POINT_RELATIVE_SIDE: f64 = 1e-6;

/// Points that can be iterated several times, in coordinates along the axes of `basis` relative to
/// `center`.
pub(crate) struct PointCoordinates<I> {
    points: I,
    basis: Basis,
    center: Point<World>,
    /// The margin on every side, which is 0 unless all points coincide.
    margin: f64,
    farthest: f64,
    pub(crate) extent: Extent,
}

/// The minimum and maximum coordinates along u, v and w.
#[derive(Clone, Copy)]
pub(crate) struct Extent {
    pub(crate) min: DVec3,
    pub(crate) max: DVec3,
}

impl Extent {
    pub(crate) fn diagonal(self) -> f64 {
        Vector::<View>::from_raw(self.max - self.min).length()
    }
}

impl<I: Iterator<Item = Point<World>> + Clone> PointCoordinates<I> {
    pub(crate) fn new(points: I, basis: Basis) -> Result<Self, FramingError> {
        let bounds = coordinate_bounds(points.clone())?;
        let farthest = bounds.min().raw().abs().max(bounds.max().raw().abs()).max_element();
        let lone = bounds.diagonal() <= SINGLE_POINT_TOLERANCE * farthest;
        let swell = if lone {
            SINGLE_POINT_SIDE.max(SINGLE_POINT_RELATIVE_SIDE * farthest) / 2.0
        } else {
            0.0
        };
        let nothing = DVec3::splat(f64::INFINITY);
        let extent = Extent { min: nothing, max: -nothing };
        let mut all =
            Self { points, basis, center: bounds.center(), margin: swell, farthest, extent };
        all.check_range(farthest <= MAX_COORDINATE)?;
        all.extent = all.measure_extent();
        Ok(all)
    }

    /// Returns whether the points count as one and are framed as a cube.
    pub(crate) fn is_single_point(&self) -> bool {
        self.margin > 0.0
    }

    fn measure_extent(&self) -> Extent {
        let mut extent = self.extent;
        self.for_each(|p| {
            extent.min = extent.min.min(p);
            extent.max = extent.max.max(p);
        });
        extent
    }

    /// Calls `see` with every point, or with the corners of the cube that frames a single point.
    pub(crate) fn for_each(&self, mut see: impl FnMut(DVec3)) {
        if self.is_single_point() {
            let cube = [DVec3::splat(-self.margin), DVec3::splat(self.margin)]
                .map(Point::<View>::from_raw);
            Bounds::from_points(cube)
                .into_iter()
                .flat_map(Bounds::corners)
                .for_each(|p| see(p.raw()));
            return;
        }
        for point in self.points.clone() {
            see(self.basis.to_view(point - self.center).raw());
        }
    }

    /// Returns the camera whose eye has the given coordinates. `smallest` is the smallest length
    /// that the position of the eye must resolve. Returns an error if the eye is too far away to
    /// resolve it.
    pub(crate) fn camera_at(
        &self,
        eye: Vector<View>,
        smallest: f64,
    ) -> Result<Camera, FramingError> {
        let eye = self.center + self.basis.to_world(eye);
        self.check_range(eye.is_finite())?;
        let reach = eye.raw().abs().max_element().max(self.farthest);
        self.check_range(smallest > 0.0 && smallest >= EYE_PRECISION * reach)?;
        Ok(Camera::new(eye, self.basis)?)
    }

    pub(crate) fn check_range(&self, within_range: bool) -> Result<(), FramingError> {
        let farthest = self.farthest;
        if within_range { Ok(()) } else { Err(FramingError::OutOfRange { farthest }) }
    }
}

fn coordinate_bounds(
    points: impl Iterator<Item = Point<World>> + Clone,
) -> Result<Bounds<World>, FramingError> {
    if let Some((index, point)) = points.clone().enumerate().find(|(_, p)| !p.is_finite()) {
        return Err(FramingError::PointNotFinite { index, point });
    }
    Bounds::from_points(points).ok_or(FramingError::NoPoints)
}
