//! The viewport: the map from the canonical square to a rectangle of pixels (VP-1 to VP-3).

use crate::error::check_positive;
use crate::{DepthRange, Rectangle, ViewportError};
use homog::{Affine, ClipRange, Ndc, PixelConvention, Point, Screen, Vector, YAxis};

/// A rectangle of pixels on which the canonical square [−1, 1]² is drawn, with the target depth
/// range.
///
/// The rectangle is in whole pixels from the corner of the image: in any convention, `x = 10, width
/// = 5` selects pixels 10 to 14. The convention determines the coordinates: these five pixels cover
/// [10, 15] with half-integer centers and [9½, 14½] with integer centers. If y points up, y is
/// measured from the bottom row; if y points down, from the top row. In both cases, the top of the
/// canonical square (y = +1, or −1 in Vulkan's range) is at the top edge of the picture.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Viewport {
    area: Rectangle,
    convention: PixelConvention,
    range: ClipRange,
    depth: DepthRange,
}

impl Viewport {
    /// Creates a viewport on `area` for points in a clip space with this `range`.
    #[must_use]
    pub const fn new(
        area: Rectangle,
        convention: PixelConvention,
        range: ClipRange,
        depth: DepthRange,
    ) -> Self {
        Self { area, convention, range, depth }
    }

    /// Creates a viewport on a whole image, with the pipeline's convention: half-integer centers, y
    /// down, depth 1 at the near plane and 0 at the far plane. `range` is the clip range of the
    /// projection: a [`ClipRange`] or a `projection::Convention`.
    ///
    /// ```
    /// use homog::{ClipRange, Point};
    /// use viewport::Viewport;
    /// // The upper left corner at the near plane, in OpenGL's and in Vulkan's clip space.
    /// for (range, corner) in [
    ///     (ClipRange::OPENGL, Point::new(-1.0, 1.0, -1.0)),
    ///     (ClipRange::VULKAN, Point::new(-1.0, -1.0, 0.0)),
    /// ] {
    ///     let image = Viewport::image_for(640, 480, range)?;
    ///     assert_eq!(image.ndc_to_screen() * corner, Point::new(0.0, 0.0, 1.0));
    /// }
    /// # Ok::<(), viewport::ViewportError>(())
    /// ```
    ///
    /// # Errors
    /// Returns an error if the image has no pixels.
    pub fn image_for(
        width: u32,
        height: u32,
        range: impl Into<ClipRange>,
    ) -> Result<Self, ViewportError> {
        let (area, range) = (Rectangle::from_size(width.into(), height.into())?, range.into());
        let depth = DepthRange::new([range.near_depth(), range.far_depth()], [1.0, 0.0])?;
        Ok(Self::new(area, PixelConvention::IMAGE, range, depth))
    }

    /// Creates a viewport on a whole image of `nx` by `ny` pixels, with the convention of the
    /// textbook (Shirley and Marschner, ch. 8): integer centers, y up, z unchanged (VP-1).
    ///
    /// # Errors
    /// Returns an error if the image has no pixels.
    pub fn chapter(nx: u32, ny: u32) -> Result<Self, ViewportError> {
        let area = Rectangle::new(
            0.0,
            0.0,
            check_positive("nx", nx.into())?,
            check_positive("ny", ny.into())?,
        )?;
        Ok(Self::new(area, PixelConvention::CHAPTER, ClipRange::CHAPTER, DepthRange::KEEP))
    }

    /// Returns this viewport with another pixel convention.
    #[must_use]
    pub const fn with_convention(self, convention: PixelConvention) -> Self {
        Self { convention, ..self }
    }

    /// Returns this viewport for another clip range; the depth range does not change.
    #[must_use]
    pub const fn with_range(self, range: ClipRange) -> Self {
        Self { range, ..self }
    }

    /// Returns this viewport with another depth range.
    #[must_use]
    pub const fn with_depth(self, depth: DepthRange) -> Self {
        Self { depth, ..self }
    }

    /// Returns the rectangle, in whole pixels from the corner of the image.
    #[must_use]
    pub const fn area(&self) -> Rectangle {
        self.area
    }

    /// Returns the pixel convention.
    #[must_use]
    pub const fn convention(&self) -> PixelConvention {
        self.convention
    }

    /// Returns the clip range of the points that the viewport accepts.
    #[must_use]
    pub const fn range(&self) -> ClipRange {
        self.range
    }

    /// Returns the depth range.
    #[must_use]
    pub const fn depth(&self) -> DepthRange {
        self.depth
    }

    /// Returns the map M_vp (VP-1 to VP-3, DP-1).
    ///
    /// ```text
    /// [ w/2   0   0  x + w/2 + c ]      c = −½ for integer centers, 0 for half-integer centers;
    /// [  0  ±h/2  0  y + h/2 + c ]      + if y keeps its direction, − if it flips;
    /// [  0    0   s       o      ]      s and o are from the depth range
    /// [  0    0   0       1      ]
    /// ```
    #[must_use]
    pub fn ndc_to_screen(&self) -> Affine<Ndc, Screen> {
        let [sx, sy] = self.pixel_scale();
        let [ox, oy] = self.pixel_center();
        Affine::from_frame(
            Vector::new(sx, 0.0, 0.0),
            Vector::new(0.0, sy, 0.0),
            Vector::new(0.0, 0.0, self.depth.scale()),
            Point::new(ox, oy, self.depth.offset()),
        )
    }

    /// Returns the inverse map in closed form (WV-3): from pixels and depth to the canonical
    /// volume.
    #[must_use]
    pub fn screen_to_ndc(&self) -> Affine<Screen, Ndc> {
        let [sx, sy] = self.pixel_scale();
        let [ox, oy] = self.pixel_center();
        let (sz, oz) = (self.depth.scale(), self.depth.offset());
        Affine::from_frame(
            Vector::new(1.0 / sx, 0.0, 0.0),
            Vector::new(0.0, 1.0 / sy, 0.0),
            Vector::new(0.0, 0.0, 1.0 / sz),
            Point::new(-ox / sx, -oy / sy, -oz / sz),
        )
    }

    fn pixel_scale(&self) -> [f64; 2] {
        let up = match self.convention.y {
            YAxis::Up => 0.5,
            YAxis::Down => -0.5,
        };
        [self.area.width() * 0.5, self.area.height() * (up * self.range.top())]
    }

    fn pixel_center(&self) -> [f64; 2] {
        let border = self.convention.centers.image_border();
        self.area.center().map(|middle| middle + border)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use homog::PixelCenters;

    #[test]
    fn the_square_fills_the_image_in_every_convention() {
        // (y, centers, image of the square's lower left corner, image of its upper right corner)
        // for 640 by 480 pixels
        let table = [
            (YAxis::Up, PixelCenters::Integer, [-0.5, -0.5], [639.5, 479.5]),
            (YAxis::Up, PixelCenters::Half, [0.0, 0.0], [640.0, 480.0]),
            (YAxis::Down, PixelCenters::Integer, [-0.5, 479.5], [639.5, -0.5]),
            (YAxis::Down, PixelCenters::Half, [0.0, 480.0], [640.0, 0.0]),
        ];
        let image = Viewport::chapter(640, 480).expect("has pixels");
        for (y, centers, low, high) in table {
            let map = image.with_convention(PixelConvention { y, centers }).ndc_to_screen();
            assert_eq!(
                map.transform_point(Point::new(-1.0, -1.0, 0.5)),
                Point::new(low[0], low[1], 0.5)
            );
            assert_eq!(
                map.transform_point(Point::new(1.0, 1.0, 0.5)),
                Point::new(high[0], high[1], 0.5)
            );
        }
    }

    #[test]
    fn near_is_one_and_far_is_zero_in_the_pipelines_image() {
        let map =
            Viewport::image_for(4, 2, ClipRange::CHAPTER).expect("has pixels").ndc_to_screen();
        assert_eq!(map.transform_point(Point::new(-1.0, 1.0, 1.0)), Point::new(0.0, 0.0, 1.0));
        assert_eq!(map.transform_point(Point::new(1.0, -1.0, -1.0)), Point::new(4.0, 2.0, 0.0));
        assert!(Viewport::image_for(0, 2, ClipRange::CHAPTER).is_err());
    }
    /// Regression test: a Vulkan projection was upside down in an image (finding 6.3).
    #[test]
    fn top_stays_up_and_near_is_one_in_every_range() {
        let reversed = ClipRange::ZERO_ONE.reversed();
        let odd = ClipRange::VULKAN.with_depths(0.25, -0.5).expect("allowed");
        for range in [
            ClipRange::CHAPTER,
            ClipRange::OPENGL,
            ClipRange::ZERO_ONE,
            ClipRange::VULKAN,
            reversed,
            odd,
        ] {
            let map = Viewport::image_for(4, 2, range).expect("has pixels").ndc_to_screen();
            let upper_left = Point::new(-1.0, range.top(), range.near_depth());
            let lower_right = Point::new(1.0, -range.top(), range.far_depth());
            assert_eq!(map * upper_left, Point::new(0.0, 0.0, 1.0), "{range:?}");
            assert_eq!(map * lower_right, Point::new(4.0, 2.0, 0.0), "{range:?}");
        }
    }
}
