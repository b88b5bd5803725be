//! Classification of maps: linear, affine or projective, with the reason (HO-3).
//!
//! ```text
//!   [ a a a t ]     linear      t = 0, bottom row (0, 0, 0, 1): the origin stays
//!   [ a a a t ]     affine      bottom row (0, 0, 0, 1): parallel lines stay parallel, w stays 1
//!   [ a a a t ]     projective  anything else: w = p x + q y + r z + h varies, and where it is 0
//!   [ p q r h ]                 points map to infinity
//! ```
//!
//! Each kind includes the kinds above it. A common factor does not matter: the bottom row (0, 0, 0,
//! 5) is equivalent to (0, 0, 0, 1). One source calls perspective maps "non-linear" (misprint M27):
//! they are linear on homogeneous points, and projective but not affine on positions.

use crate::{Affine, Homography, Projective, Space};
use core::fmt;

/// The three kinds of maps that a 4×4 or 3×3 matrix can be.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum MapKind {
    /// Preserves the origin, parallel lines and ratios along lines.
    Linear,
    /// Preserves parallel lines and ratios along lines.
    Affine,
    /// Preserves lines.
    Projective,
}

/// The reason for the kind of a map.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum KindReason {
    /// Linear: no translation, and w is unchanged.
    OriginStays,
    /// Affine: w is unchanged, but the origin moves.
    OriginMoves {
        /// The image of the origin.
        to: [f64; 3],
    },
    /// Projective: w depends on the point.
    WVaries {
        /// The bottom row (p, q, r, h): w = p x + q y + r z + h.
        bottom_row: [f64; 4],
    },
    /// Projective in name only: w is 0 everywhere, so no image is a finite point.
    WVanishes,
}

/// The kind of a map, with the reason for it and the rank.
///
/// ```
/// use homog::{Clip, MapKind, Projective, View};
/// let [x, y, z] = [[2.0, 0.0, 0.0, 0.0], [0.0, 2.0, 0.0, 0.0], [0.0, 0.0, 1.0, 1.0]];
/// let rows = [x, y, z, [0.0, 0.0, -1.0, 0.0]];
/// let found = Projective::<View, Clip>::from_rows(rows).classify();
/// assert_eq!((found.kind, found.rank), (MapKind::Projective, 4));
/// assert_eq!(found.finite_vanishing_points(), 1);
/// assert_eq!(found.to_string(), "projective: w = -z depends on the point; invertible");
/// # extern crate std;
/// # use std::string::ToString;
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
#[non_exhaustive]
pub struct Classification {
    /// Linear, affine or projective.
    pub kind: MapKind,
    /// The reason for the kind.
    pub reason: KindReason,
    /// The rank of the matrix up to rounding: 4 if the map is invertible.
    pub rank: usize,
}

/// The size of rounding errors relative to the largest coordinate of a point.
const NOISE: f64 = 1e-12;

impl Classification {
    fn new(rows: [[f64; 4]; 4], rank: usize, relative: f64) -> Self {
        let largest = |numbers: &[f64]| numbers.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        let [p, q, r, h] = rows[3];
        let origin = [rows[0][3], rows[1][3], rows[2][3]];
        let linear_part = rows[..3].iter().fold(0.0, |m: f64, row| m.max(largest(&row[..3])));
        let (kind, reason) = if rows[3] == [0.0; 4] {
            (MapKind::Projective, KindReason::WVanishes)
        } else if h == 0.0 || largest(&[p, q, r]) > relative * h.abs() {
            (MapKind::Projective, KindReason::WVaries { bottom_row: rows[3] })
        } else if largest(&origin) > relative * linear_part {
            (MapKind::Affine, KindReason::OriginMoves { to: origin.map(|c| c / h) })
        } else {
            (MapKind::Linear, KindReason::OriginStays)
        };
        Self { kind, reason, rank }
    }

    /// Returns whether the map is invertible.
    #[must_use]
    pub const fn is_invertible(&self) -> bool {
        self.rank == 4
    }

    /// Returns the number of x, y and z axes with a finite vanishing point, that is, the number of
    /// nonzero entries among p, q and r. The values 1, 2 and 3 mean one-, two- and three-point
    /// perspective, and 0 means a parallel projection.
    #[must_use]
    pub fn finite_vanishing_points(&self) -> usize {
        match self.reason {
            KindReason::WVaries { bottom_row: [pqr @ .., _] } => {
                pqr.iter().filter(|&&x| x != 0.0).count()
            }
            _ => 0,
        }
    }
}

impl fmt::Display for MapKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Linear => "linear",
            Self::Affine => "affine",
            Self::Projective => "projective",
        })
    }
}

impl fmt::Display for KindReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OriginStays => f.write_str("w does not change, and neither does the origin"),
            Self::OriginMoves { to } => {
                let [x, y, z] = without_noise(*to);
                write!(f, "w does not change, but the origin moves to ({x}, {y}, {z})")
            }
            Self::WVaries { bottom_row } => {
                f.write_str("w = ")?;
                write_linear_form(f, *bottom_row)?;
                f.write_str(" depends on the point")
            }
            Self::WVanishes => f.write_str("w is 0 everywhere, so no point has an image"),
        }
    }
}

/// Replaces coordinates that are only rounding errors of the largest one with 0.
fn without_noise(point: [f64; 3]) -> [f64; 3] {
    let largest = point.iter().fold(0.0, |m: f64, c| m.max(c.abs()));
    point.map(|c| if c.abs() <= NOISE * largest { 0.0 } else { c })
}

/// Writes the linear form p x + q y + r z + h without zero terms or factors of 1.
fn write_linear_form(f: &mut fmt::Formatter<'_>, coefficients: [f64; 4]) -> fmt::Result {
    let mut first = true;
    for (c, name) in coefficients.into_iter().zip(["x", "y", "z", ""]) {
        if c == 0.0 {
            continue;
        }
        f.write_str(match (first, c < 0.0) {
            (true, false) => "",
            (true, true) => "-",
            (false, false) => " + ",
            (false, true) => " - ",
        })?;
        first = false;
        match (c.abs(), name) {
            (1.0, "x" | "y" | "z") => f.write_str(name)?,
            (size, "") => write!(f, "{size}")?,
            (size, name) => write!(f, "{size} {name}")?,
        }
    }
    Ok(())
}

impl fmt::Display for Classification {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}; ", self.kind, self.reason)?;
        match self.rank {
            4 => f.write_str("invertible"),
            rank => write!(f, "singular, with rank {rank}"),
        }
    }
}

impl<A: Space, B: Space> Projective<A, B> {
    /// Classifies this map based on its exact entries.
    #[must_use]
    pub fn classify(self) -> Classification {
        self.classify_within(0.0)
    }

    /// Classifies this map with a tolerance, for computed matrices. The entries p, q and r count as
    /// 0 up to `relative` times |h|, and translations up to `relative` times the largest entry of
    /// the linear part.
    #[must_use]
    pub fn classify_within(self, relative: f64) -> Classification {
        Classification::new(self.rows(), self.rank(), relative)
    }

    /// Returns the affine map that equals this one up to a factor, or `None` if w depends on the
    /// point.
    ///
    /// ```
    /// use homog::{Affine, Model, Projective, Vector, World};
    /// let shift = Affine::<Model, World>::translation(Vector::new(1.0, 2.0, 3.0));
    /// let thrice = shift.rows().map(|row| row.map(|entry| 3.0 * entry));
    /// let thrice = Projective::<Model, World>::from_rows(thrice);
    /// assert_eq!(thrice.to_affine(), Some(shift));
    /// ```
    #[must_use]
    pub fn to_affine(self) -> Option<Affine<A, B>> {
        let h = self.raw.w_axis.w;
        let rows = self.rows().map(|row| row.map(|entry| entry / h));
        Affine::from_rows(rows).filter(|map| map.is_finite())
    }
}

impl<A: Space, B: Space> Affine<A, B> {
    /// Classifies this map as linear if the origin stays fixed, or else as affine.
    #[must_use]
    pub fn classify(self) -> Classification {
        Projective::from(self).classify()
    }
}

impl Homography {
    /// Returns the kind of this planar map, based on its exact entries.
    #[must_use]
    pub fn kind(self) -> MapKind {
        let [[_, _, x], [_, _, y], [p, q, h]] = self.rows();
        match () {
            () if p != 0.0 || q != 0.0 || h == 0.0 => MapKind::Projective,
            () if x != 0.0 || y != 0.0 => MapKind::Affine,
            () => MapKind::Linear,
        }
    }
}

#[cfg(test)]
mod tests {
    extern crate alloc;
    use super::*;
    use crate::{Clip, Model, Vector, View, World};
    use alloc::string::ToString;

    #[test]
    fn c15_every_kind_has_its_reason() {
        let turn = Affine::<Model, World>::rotation_z(0.3);
        assert_eq!(
            turn.classify().to_string(),
            "linear: w does not change, and neither does the origin; invertible"
        );
        let moved = turn.then(Affine::<World, World>::translation(Vector::new(0.0, 2.5, 0.0)));
        assert_eq!(moved.classify().reason, KindReason::OriginMoves { to: [0.0, 2.5, 0.0] });
        let scaled = Projective::<Model, World>::tagged(moved.raw * -4.0);
        assert_eq!(scaled.classify().kind, MapKind::Affine, "up to a factor");
        let flat = Affine::<Model, World>::scale(1.0, 1.0, 0.0);
        assert_eq!((flat.classify().kind, flat.classify().rank), (MapKind::Linear, 3));
        let nothing = Projective::<View, Clip>::from_rows([[0.0; 4]; 4]).classify();
        assert_eq!((nothing.reason, nothing.rank), (KindReason::WVanishes, 0));
    }

    #[test]
    fn rounding_errors_of_the_origin_are_shown_as_zero() {
        let reason = KindReason::OriginMoves { to: [5.551_115_123_125_783e-16, -2.5, -0.0] };
        let text = reason.to_string();
        assert_eq!(text, "w does not change, but the origin moves to (0, -2.5, 0)");
    }

    #[test]
    fn c58_misprint_m27_perspective_is_linear_in_four_coordinates_but_not_affine() {
        let rows = [
            [1.0, 0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, 3.0, -2.0],
            [0.0, 0.5, -1.0, 0.25],
        ];
        let map = Projective::<View, Clip>::from_rows(rows);
        let found = map.classify();
        assert_eq!(found.kind, MapKind::Projective);
        assert_eq!(found.finite_vanishing_points(), 2);
        assert!(found.to_string().contains("w = 0.5 y - z + 0.25"), "{found}");
        assert_eq!(map.to_affine(), None);
        let (a, b) = ([1.0, 2.0, 3.0, 4.0], [-5.0, 6.0, 7.0, 8.0]);
        let sum: [f64; 4] = core::array::from_fn(|i| a[i] + b[i]);
        let image = |v: [f64; 4]| map.transform_hpoint(v.into()).raw;
        assert_eq!(image(sum), image(a) + image(b));
    }

    #[test]
    fn c83_nonzero_p_q_r_count_the_vanishing_points() {
        for [p, q, r, count] in
            [[0.0, 0.0, -0.5, 1.0], [0.0, 0.2, -0.5, 2.0], [0.1, 0.2, -0.5, 3.0], [0.0; 4]]
        {
            let mut rows = Affine::<View, View>::IDENTITY.rows();
            rows[3] = [p, q, r, 1.0];
            let map = Projective::<View, Clip>::from_rows(rows);
            assert_eq!(map.classify().finite_vanishing_points() as f64, count, "{p} {q} {r}");
            let places =
                map.principal_vanishing_points(0.0).map(|meaning| meaning.name() == "point");
            assert_eq!(places, [p != 0.0, q != 0.0, r != 0.0]);
        }
    }

    #[test]
    fn rounding_errors_can_be_ignored() {
        let mut almost = glam::DMat4::IDENTITY;
        almost.x_axis.w = 1e-17;
        let almost = Projective::<View, Clip>::tagged(almost);
        assert_eq!(almost.classify().kind, MapKind::Projective);
        assert_eq!(almost.classify_within(1e-12).kind, MapKind::Linear);
    }

    #[test]
    fn planar_maps_are_classified() {
        let kind = |rows| Homography::from_rows(rows).kind();
        let (x, y, z) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 2.0]);
        assert_eq!(kind([x, y, z]), MapKind::Linear);
        assert_eq!(kind([[1.0, 0.0, 5.0], y, z]), MapKind::Affine);
        assert_eq!(kind([x, y, [0.0, 1.0, 1.0]]), MapKind::Projective);
    }
}
