//! Pinhole cameras described by intrinsic parameters, as in camera calibration (C61, GL-1).
//!
//! ```text
//!      [ fx  s  cx ]     column = fx X/Z + s Y/Z + cx      X right, Y down, Z in front of the eye
//!  K = [  0 fy  cy ]     row    =          fy Y/Z + cy
//!      [  0  0   1 ]
//! ```
//!
//! Source: R. Hartley, A. Zisserman, *Multiple View Geometry in Computer Vision*, 2nd ed., 2004,
//! §6.1; names as in OpenCV's `calib3d` module.

use crate::error::{check_finite, check_positive};
use crate::frustum::check_planes;
use crate::matrix::{DepthRow, from_rows, is_bounded, is_invertible};
use crate::{Convention, Frustum, ProjectionError, Window};
use glam::{DMat4, DVec4};
use homog::{Clip, PixelCenters, Point, Projective, View};

/// The perspective projection of a pinhole camera, described by its focal lengths and principal
/// point in pixels.
///
/// # Guarantees
/// All numbers are finite, and fx, fy, width and height are positive.
///
/// ```
/// use homog::{PixelCenters, Point};
/// use projection::Intrinsics;
/// let lens = Intrinsics::new([500.0, 500.0], [319.5, 239.5], [640, 480])?;
/// // One unit to the right and two ahead: 250 columns to the right of the principal point.
/// let pixel = lens.project(Point::new(1.0, 0.0, -2.0)).expect("in front of the eye");
/// assert_eq!(pixel, [569.5, 239.5]);
/// assert_eq!(lens.pixel_centers(), PixelCenters::Integer);
/// # Ok::<(), projection::ProjectionError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Intrinsics {
    focal_length: [f64; 2],
    principal_point: [f64; 2],
    skew: f64,
    size: [u32; 2],
    pixel_centers: PixelCenters,
}

impl Intrinsics {
    /// Creates a lens with focal lengths (fx, fy) and principal point (cx, cy), in pixels, for
    /// pictures of `size` (columns, rows). There is no skew, and pixel centers are at integers.
    ///
    /// # Errors
    /// Returns an error if a number is not finite, or a focal length or a side is not positive.
    pub fn new(
        [fx, fy]: [f64; 2],
        [cx, cy]: [f64; 2],
        size: [u32; 2],
    ) -> Result<Self, ProjectionError> {
        let focal_length = [check_positive("fx", fx)?, check_positive("fy", fy)?];
        let principal_point = [check_finite("cx", cx)?, check_finite("cy", cy)?];
        check_positive("width", f64::from(size[0]))?;
        check_positive("height", f64::from(size[1]))?;
        let pixel_centers = PixelCenters::Integer;
        Self { focal_length, principal_point, skew: 0.0, size, pixel_centers }.checked()
    }

    /// Creates a lens from the matrix K, row by row. A multiple of K is accepted and divided by its
    /// last entry.
    ///
    /// # Errors
    /// Returns the same errors as [`new`](Self::new), and an error if `K[1][0]` is not 0 or the
    /// last row is not (0, 0, positive).
    pub fn from_rows(rows: [[f64; 3]; 3], size: [u32; 2]) -> Result<Self, ProjectionError> {
        for value in rows.as_flattened() {
            check_finite("K", *value)?;
        }
        let [[fx, skew, cx], [shear, fy, cy], [p, q, scale]] = rows;
        for (parameter, value) in [("K[1][0]", shear), ("K[2][0]", p), ("K[2][1]", q)] {
            if value != 0.0 {
                return Err(ProjectionError::OutOfRange { parameter, value, allowed: "0" });
            }
        }
        check_positive("K[2][2]", scale)?;
        Self::new([fx / scale, fy / scale], [cx / scale, cy / scale], size)?.with_skew(skew / scale)
    }

    /// Returns this lens with skew s, the entry `K[0][1]`, in pixels. Points shift to the right by
    /// s/fy columns per row downward.
    ///
    /// # Errors
    /// Returns an error if the skew is not finite or is too large to compute with.
    pub fn with_skew(self, skew: f64) -> Result<Self, ProjectionError> {
        Self { skew: check_finite("skew", skew)?, ..self }.checked()
    }

    /// Returns this lens with the same numbers, interpreted under another pixel-center convention.
    #[must_use]
    pub const fn with_pixel_centers(self, pixel_centers: PixelCenters) -> Self {
        Self { pixel_centers, ..self }
    }

    /// Returns this lens with its principal point converted to another pixel-center convention.
    #[must_use]
    pub fn in_pixel_centers(self, pixel_centers: PixelCenters) -> Self {
        let by = pixel_centers.first_center() - self.pixel_centers.first_center();
        let principal_point = self.principal_point.map(|center| center + by);
        Self { principal_point, pixel_centers, ..self }
    }

    /// Returns the lens of a picture that shows the window of a frustum, with pixel centers at
    /// half-integers.
    ///
    /// # Errors
    /// Returns an error if the window is mirrored or a size is 0.
    pub fn from_frustum(frustum: Frustum, size: [u32; 2]) -> Result<Self, ProjectionError> {
        let slopes = frustum.slopes();
        let [width, height] = size.map(f64::from);
        let fx = width / (slopes.right() - slopes.left());
        let fy = height / (slopes.top() - slopes.bottom());
        let lens = Self::new([fx, fy], [-slopes.left() * fx, slopes.top() * fy], size)?;
        Ok(lens.with_pixel_centers(PixelCenters::Half))
    }

    /// Recovers the lens from a matrix like the result of [`view_to_clip`](Self::view_to_clip). The
    /// lens has pixel centers at half-integers.
    ///
    /// # Errors
    /// Returns an error if the matrix is not the perspective projection of an unrotated camera, or
    /// if it mirrors the picture.
    pub fn from_view_to_clip(
        view_to_clip: Projective<View, Clip>,
        convention: Convention,
        size: [u32; 2],
    ) -> Result<Self, ProjectionError> {
        let rows = view_to_clip.raw().transpose();
        let (ahead, top) = (convention.ahead(), convention.top());
        let (x, y, w) = (rows.x_axis, rows.y_axis * top, rows.w_axis);
        let depth = w.z * ahead;
        let is_pinhole = [x.w, y.x, y.w, w.x, w.y, w.w].into_iter().all(|entry| entry == 0.0);
        if !is_pinhole || !is_invertible(depth) {
            return Err(ProjectionError::NotPinhole);
        }
        let [width, height] = size.map(|side| 0.5 * f64::from(side));
        let (x, y) = (x / depth, y / depth);
        let focal_length = [x.x * width, y.y * height];
        let center = [(1.0 + x.z * ahead) * width, (1.0 - y.z * ahead) * height];
        let lens = Self::new(focal_length, center, size)?.with_skew(-x.y * width)?;
        Ok(lens.with_pixel_centers(PixelCenters::Half))
    }

    /// Returns the focal lengths fx and fy, in pixels.
    #[must_use]
    pub const fn focal_length(self) -> [f64; 2] {
        self.focal_length
    }

    /// Returns the principal point (cx, cy): where the line of sight meets the picture, in pixels.
    #[must_use]
    pub const fn principal_point(self) -> [f64; 2] {
        self.principal_point
    }

    /// Returns the skew s, the entry `K[0][1]`, in pixels.
    #[must_use]
    pub const fn skew(self) -> f64 {
        self.skew
    }

    /// Returns the number of columns and rows of the picture.
    #[must_use]
    pub const fn size(self) -> [u32; 2] {
        self.size
    }

    /// Returns the pixel-center convention.
    #[must_use]
    pub const fn pixel_centers(self) -> PixelCenters {
        self.pixel_centers
    }

    /// Returns the matrix K, row by row.
    #[must_use]
    pub const fn to_rows(self) -> [[f64; 3]; 3] {
        let ([fx, fy], [cx, cy]) = (self.focal_length, self.principal_point);
        [[fx, self.skew, cx], [0.0, fy, cy], [0.0, 0.0, 1.0]]
    }

    /// Returns the pixel coordinates of a point, or `None` if it is not in front of the eye.
    ///
    /// View space is right-handed, with y up and z backward; the axes of K are (x, −y, −z).
    #[must_use]
    pub fn project(self, point: Point<View>) -> Option<[f64; 2]> {
        let ([fx, fy], [cx, cy]) = (self.focal_length, self.principal_point);
        let ahead = -point.z();
        let [x, y] = [point.x() / ahead, -point.y() / ahead];
        let pixel = [fx * x + self.skew * y + cx, fy * y + cy];
        (ahead > 0.0 && pixel.into_iter().all(f64::is_finite)).then_some(pixel)
    }

    /// Returns the view-space point seen at the given pixel coordinates, at distance `depth` in
    /// front of the eye along the line of sight. It is not finite if the input is not.
    #[must_use]
    pub fn unproject(self, [column, row]: [f64; 2], depth: f64) -> Point<View> {
        let ([fx, fy], [cx, cy]) = (self.focal_length, self.principal_point);
        let y = (row - cy) / fy;
        let x = (column - cx - self.skew * y) / fx;
        Point::new(x * depth, -y * depth, -depth)
    }

    /// Returns the frustum with the same window. The skew must be 0.
    ///
    /// # Errors
    /// Returns an error if the skew is not 0 or 0 < near < far does not hold.
    pub fn to_frustum(self, near: f64, far: f64) -> Result<Frustum, ProjectionError> {
        if self.skew != 0.0 {
            let (parameter, value) = ("skew", self.skew);
            return Err(ProjectionError::OutOfRange { parameter, value, allowed: "0" });
        }
        let ([fx, fy], [cx, cy]) = (self.focal_length, self.corner_principal_point());
        let [width, height] = self.size.map(f64::from);
        let slopes = Window::new(-cx / fx, (width - cx) / fx, (cy - height) / fy, cy / fy)?;
        Frustum::from_slopes(slopes, near, far)
    }

    /// Returns the projection matrix; `far` may be infinite.
    ///
    /// ```text
    ///  x' = 2fx/w x − 2s/w y + (2cx/w − 1) D    with cx, cy from the corner of the picture,
    ///  y' =          2fy/h y + (1 − 2cy/h) D    D the distance in front of the eye; depth by GL-1
    /// ```
    ///
    /// # Errors
    /// Returns an error unless 0 < near < far.
    pub fn view_to_clip(
        self,
        [near, far]: [f64; 2],
        convention: Convention,
    ) -> Result<Projective<View, Clip>, ProjectionError> {
        check_planes(near, far)?;
        let depth = DepthRow::central(near, far, convention);
        let ([x, y], [right, up]) = (self.scale(), self.center());
        let skew = -self.skew * 2.0 / f64::from(self.size[0]);
        let (ahead, top) = (convention.ahead(), convention.top());
        Ok(Projective::from_raw(from_rows([
            [x, skew, right * ahead, 0.0],
            [0.0, top * y, top * up * ahead, 0.0],
            [0.0, 0.0, depth.factor * ahead, depth.offset],
            [0.0, 0.0, ahead, 0.0],
        ])))
    }

    /// Returns the inverse of [`view_to_clip`](Self::view_to_clip) in closed form (IV-1).
    ///
    /// # Errors
    /// Returns an error unless 0 < near < far.
    pub fn clip_to_view(
        self,
        [near, far]: [f64; 2],
        convention: Convention,
    ) -> Result<Projective<Clip, View>, ProjectionError> {
        check_planes(near, far)?;
        let depth = DepthRow::central(near, far, convention);
        let ([x, y], [right, up]) = (self.scale(), self.center());
        let skew = self.skew * 2.0 / f64::from(self.size[0]) / (x * y);
        let (ahead, top) = (convention.ahead(), convention.top());
        Ok(Projective::from_raw(DMat4::from_cols(
            DVec4::new(1.0 / x, 0.0, 0.0, 0.0),
            DVec4::new(top * skew, top / y, 0.0, 0.0),
            DVec4::new(0.0, 0.0, 0.0, 1.0 / depth.offset),
            DVec4::new(-right / x - up * skew, -up / y, ahead, -depth.factor / depth.offset),
        )))
    }

    /// Returns the scale factors from slopes to NDC, to the right and upward.
    fn scale(self) -> [f64; 2] {
        let [width, height] = self.size.map(f64::from);
        [2.0 * self.focal_length[0] / width, 2.0 * self.focal_length[1] / height]
    }

    /// Returns the position of the line of sight, in NDC with y up.
    fn center(self) -> [f64; 2] {
        let ([width, height], [cx, cy]) = (self.size.map(f64::from), self.corner_principal_point());
        [2.0 * cx / width - 1.0, 1.0 - 2.0 * cy / height]
    }

    /// Returns the principal point, measured from the corner of the picture.
    fn corner_principal_point(self) -> [f64; 2] {
        self.in_pixel_centers(PixelCenters::Half).principal_point
    }

    /// Rejects values that would overflow in the matrix or in its inverse.
    fn checked(self) -> Result<Self, ProjectionError> {
        let ([x, y], [right, up]) = (self.scale(), self.center());
        let usable = is_invertible(x)
            && is_invertible(y)
            && is_invertible(x * y)
            && [right, up, right / x, up / y, self.skew, self.skew * up / (x * y)]
                .into_iter()
                .all(is_bounded);
        usable.then_some(self).ok_or(ProjectionError::Unrepresentable { what: "set of intrinsics" })
    }
}
