//! Inverses with a report: the digits lost by inversion, or the reason why there is no inverse.

use crate::elimination::eliminate_full_pivoting;
use crate::{Projective, Space};

/// An inverse and its accuracy.
#[derive(Clone, Copy, PartialEq, Debug)]
#[non_exhaustive]
pub struct Inversion<A: Space, B: Space> {
    /// The inverse map.
    pub map: Projective<A, B>,
    /// The condition number ‖M‖ ‖M⁻¹‖ in the maximum row sum norm, at least 1: the factor by which
    /// relative errors may grow. It is large for a perspective projection whose near and far planes
    /// are far apart. Capped at [`f64::MAX`].
    pub condition: f64,
    /// The largest entry of |M M⁻¹ − I|: the error of the computed inverse. Capped at [`f64::MAX`],
    /// even if the product itself is out of range.
    pub residual: f64,
}

impl<A: Space, B: Space> Inversion<A, B> {
    /// Returns the number of decimal digits that inversion may lose, out of the 16 in an f64: log₁₀
    /// of the condition number.
    #[must_use]
    pub fn digits_lost(&self) -> f64 {
        libm::log10(self.condition)
    }
}

/// The reason why a map has no inverse.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum InversionError {
    /// The map flattens space, as every classical projection onto a plane does.
    #[error("the matrix is singular: its rank is {rank}, but an inverse needs rank 4")]
    Singular {
        /// The dimension of the image in homogeneous coordinates: 3 for a projection onto a plane.
        rank: usize,
    },
    /// An entry of the matrix is infinite or NaN.
    #[error("the matrix has an entry that is not finite")]
    NotFinite,
    /// The inverse has entries beyond the range of f64.
    #[error("the inverse has entries beyond the range of f64")]
    OutOfRange,
}

impl<A: Space, B: Space> Projective<A, B> {
    /// Returns the inverse map, with its condition number and residual.
    ///
    /// # Errors
    /// Returns an error if the matrix is singular (up to rounding, regardless of the units of its
    /// rows and columns) or not finite, or if the inverse is not finite.
    ///
    /// ```
    /// use homog::{Affine, Model, Projective, World};
    /// let map = Projective::from(Affine::<Model, World>::scale(1.0, 1.0, 1e-3));
    /// let inversion = map.inverse_with_report()?;
    /// assert_eq!(inversion.condition, 1000.0);
    /// assert_eq!(inversion.digits_lost(), 3.0);
    /// # Ok::<(), homog::InversionError>(())
    /// ```
    pub fn inverse_with_report(self) -> Result<Inversion<B, A>, InversionError> {
        if !self.is_finite() {
            return Err(InversionError::NotFinite);
        }
        let found = eliminate_full_pivoting(self.rows());
        let Some(rows) = found.inverse else {
            let rank = found.rank;
            let singular = InversionError::Singular { rank };
            return Err(if rank < 4 { singular } else { InversionError::OutOfRange });
        };
        let map = Projective::from_rows(rows);
        let condition = (row_sum_norm(self.rows()) * row_sum_norm(rows)).min(f64::MAX);
        let residual = self.inverse_residual(map);
        Ok(Inversion { map, condition, residual })
    }

    /// Returns the rank of the matrix up to rounding: 4 for invertible maps, 3 for projections onto
    /// a plane, 0 for the zero matrix and for matrices that are not finite.
    #[must_use]
    pub fn rank(self) -> usize {
        eliminate_full_pivoting(self.rows()).rank
    }

    fn inverse_residual(self, inverse: Projective<B, A>) -> f64 {
        let product = self.raw * inverse.raw - glam::DMat4::IDENTITY;
        if !product.is_finite() {
            return f64::MAX;
        }
        product.to_cols_array().iter().fold(0.0, |largest: f64, entry| largest.max(entry.abs()))
    }
}

fn row_sum_norm(rows: [[f64; 4]; 4]) -> f64 {
    let sum = |row: &[f64; 4]| row.iter().map(|entry| entry.abs()).sum();
    rows.iter().map(sum).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Clip, View};

    type Map = Projective<View, Clip>;

    #[test]
    fn c102_projections_onto_a_plane_report_rank_3() {
        let onto_a_plane = Map::from_rows([
            [1.0, 0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, 0.0, 0.0],
            [0.0, 0.0, -0.5, 1.0],
        ]);
        let error = onto_a_plane.inverse_with_report().expect_err("singular");
        assert_eq!(error, InversionError::Singular { rank: 3 });
        assert_eq!(onto_a_plane.inverse(), None);
    }

    #[test]
    fn the_report_states_the_lost_digits() {
        // P of PE-1 with n = -1, f = -1e6.
        let (n, f) = (-1.0, -1e6);
        let map = Map::from_rows([
            [n, 0.0, 0.0, 0.0],
            [0.0, n, 0.0, 0.0],
            [0.0, 0.0, n + f, -f * n],
            [0.0, 0.0, 1.0, 0.0],
        ]);
        let report = map.inverse_with_report().expect("regular");
        assert!(report.residual < 1e-9, "{}", report.residual);
        assert!(report.digits_lost() > 6.0 && report.digits_lost() < 13.0);
        assert_eq!(Map::from_rows([[f64::NAN; 4]; 4]).rank(), 0);
    }
}
