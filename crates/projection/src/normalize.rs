//! View-volume normalization, factor by factor: shear, scale to the canonical volume, map the
//! depth.
//!
//! ```text
//!  skewed frustum ──shear──► centered ──scale──► sides x, y = ±D ──depth──► [−1, 1]³, divided
//!  skewed prism   ──shear──► centered ──fit──────────────────────────────► [−1, 1]³
//! ```
//!
//! Afterward, a single clipper works for all projections (VV-1, VV-2; C86..C89).

use crate::matrix::from_rows;
use crate::{Convention, Frustum, Oblique, Orthographic};
use glam::DMat4;
use homog::{Affine, Clip, Projective, View};

/// The factors of a parallel projection, in the order in which a point passes through them
/// (VV-1, C86).
#[derive(Clone, Copy, PartialEq, Debug)]
#[non_exhaustive]
pub struct ParallelFactors {
    /// Makes the projectors perpendicular to the plane.
    pub shear: Affine<View, View>,
    /// Moves and scales the sheared box to the canonical volume.
    pub fit: Projective<View, Clip>,
}

impl ParallelFactors {
    /// Returns the product of the factors.
    #[must_use]
    pub fn view_to_clip(self) -> Projective<View, Clip> {
        self.shear.then_project(self.fit)
    }
}

impl Oblique {
    /// Returns the factors for the oblique prism whose window is in the plane of projection
    /// (VV-1, C86).
    ///
    /// `volume` contains the window on that plane and the near and far distances from z = 0.
    #[must_use]
    pub fn factors(self, volume: Orthographic, convention: Convention) -> ParallelFactors {
        let right_handed = convention.right_handed();
        let fit = volume.view_to_clip(right_handed);
        let shear = self.depth_preserving();
        if convention == right_handed {
            return ParallelFactors { shear, fit };
        }
        let mut turned = shear.raw();
        turned.z_axis.x = -turned.z_axis.x;
        turned.z_axis.y = -turned.z_axis.y;
        let shear = Affine::from_raw(turned).unwrap_or(shear);
        ParallelFactors { shear, fit: volume.view_to_clip(convention) }
    }

    /// Returns the complete projection of the oblique prism, with shear and fit in one matrix.
    #[must_use]
    pub fn view_to_clip(
        self,
        volume: Orthographic,
        convention: Convention,
    ) -> Projective<View, Clip> {
        self.factors(volume, convention).view_to_clip()
    }
}

/// The factors of a frustum, in the order in which a point passes through them (VV-2, C87, C88).
#[derive(Clone, Copy, PartialEq, Debug)]
#[non_exhaustive]
pub struct FrustumFactors {
    /// Puts the center line of the volume on the line of sight.
    pub shear: Affine<View, View>,
    /// Moves the sides to x = ±D and y = ±D.
    pub scale: Affine<View, View>,
    /// Maps the depth and sets w to the distance: frustum to prism.
    pub depth: Projective<View, Clip>,
}

impl FrustumFactors {
    /// Returns the product of the factors.
    #[must_use]
    pub fn view_to_clip(self) -> Projective<View, Clip> {
        self.shear.then(self.scale).then_project(self.depth)
    }
}

impl Frustum {
    /// Returns the shear, scale and depth map, whose product is
    /// [`view_to_clip`](Self::view_to_clip) (VV-2, C87).
    #[must_use]
    pub fn factors(self, convention: Convention) -> FrustumFactors {
        let (near, window) = (self.near(), self.window());
        let (x, y) = window.center();
        let away = convention.ahead() / near;
        let shear = from_rows([
            [1.0, 0.0, -x * away, 0.0],
            [0.0, 1.0, -y * away, 0.0],
            [0.0, 0.0, 1.0, 0.0],
            [0.0, 0.0, 0.0, 1.0],
        ]);
        let whole = self.view_to_clip(convention).raw();
        let mut depth = DMat4::IDENTITY;
        depth.y_axis.y = convention.top();
        depth.z_axis.z = whole.z_axis.z;
        depth.z_axis.w = whole.z_axis.w;
        depth.w_axis.z = whole.w_axis.z;
        depth.w_axis.w = 0.0;
        FrustumFactors {
            shear: Affine::from_raw(shear).unwrap_or(Affine::IDENTITY),
            scale: Affine::scale(2.0 * near / window.width(), 2.0 * near / window.height(), 1.0),
            depth: Projective::from_raw(depth),
        }
    }

    /// Returns the shear and scale to the canonical frustum of the slides, whose sides are x = ±D
    /// and y = ±D and whose far plane is at distance 1.
    ///
    /// Returns `None` if there is no far plane or the window is too narrow for a finite scale.
    #[must_use]
    pub fn view_to_canonical_frustum(self, convention: Convention) -> Option<Affine<View, View>> {
        let shrink = 1.0 / self.far();
        let factors = self.factors(convention);
        let whole = factors.shear.then(factors.scale).then(Affine::scale(shrink, shrink, shrink));
        (self.far().is_finite() && whole.is_finite()).then_some(whole)
    }
}
