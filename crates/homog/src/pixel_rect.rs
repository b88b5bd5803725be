//! Rectangles of whole pixels: regions, tiles and bands of an image.

/// A rectangle of whole pixels, relative to the first column and row of its image.
///
/// ```
/// use homog::PixelRect;
/// let image = PixelRect::from_size(640, 480);
/// let region = PixelRect { x: 600, y: 0, width: 100, height: 10 };
/// let visible = PixelRect { width: 40, ..region };
/// assert_eq!(image.intersection(region), Some(visible));
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct PixelRect {
    /// The first column.
    pub x: u32,
    /// The first row, counted in the same direction as the rows of the image.
    pub y: u32,
    /// The number of columns.
    pub width: u32,
    /// The number of rows.
    pub height: u32,
}

impl PixelRect {
    /// Returns the rectangle that covers an image of this size.
    #[must_use]
    pub const fn from_size(width: u32, height: u32) -> Self {
        Self { x: 0, y: 0, width, height }
    }

    /// Returns the intersection of the two rectangles, or `None` if they do not overlap.
    #[must_use]
    pub fn intersection(self, other: Self) -> Option<Self> {
        let (x, y) = (self.x.max(other.x), self.y.max(other.y));
        let width = self.right().min(other.right()).checked_sub(x)?;
        let height = self.bottom().min(other.bottom()).checked_sub(y)?;
        (width > 0 && height > 0).then_some(Self { x, y, width, height })
    }

    /// Returns band `index` of `count` horizontal bands, counted from the top. The heights of the
    /// bands differ by at most one row.
    ///
    /// If the rectangle has fewer rows than bands, some bands are empty.
    #[must_use]
    pub fn nth_band(self, index: u32, count: u32) -> Self {
        let row = |n: u32| {
            let rows = u64::from(self.height) * u64::from(n) / u64::from(count.max(1));
            rows as u32
        };
        let (from, to) = (row(index), row(index.saturating_add(1)));
        Self { y: self.y + from, height: to - from, ..self }
    }

    /// Returns horizontal bands of at most `rows` rows, from top to bottom. They are split at image
    /// rows that are multiples of `rows`.
    pub fn bands(self, rows: u32) -> impl Iterator<Item = Self> {
        let rows = rows.max(1);
        let mut next = self.y;
        core::iter::from_fn(move || {
            let from = next;
            next = (from / rows + 1).saturating_mul(rows).min(self.bottom());
            (from < next).then(|| Self { y: from, height: next - from, ..self })
        })
    }

    /// Returns the number of pixels.
    #[must_use]
    pub const fn area(self) -> usize {
        self.width as usize * self.height as usize
    }

    /// Returns the column just past the last one.
    #[must_use]
    pub const fn right(self) -> u32 {
        self.x.saturating_add(self.width)
    }

    /// Returns the row just past the last one.
    #[must_use]
    pub const fn bottom(self) -> u32 {
        self.y.saturating_add(self.height)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    extern crate std;
    use std::vec::Vec;

    #[test]
    fn bands_start_at_multiples_and_tile_the_rectangle() {
        let region = PixelRect { x: 3, y: 70, width: 5, height: 200 };
        let bands: Vec<_> = region.bands(64).collect();
        assert_eq!(
            bands.iter().map(|b| [b.y, b.height]).collect::<Vec<_>>(),
            [[70, 58], [128, 64], [192, 64], [256, 14]]
        );
        let parts: Vec<_> = (0..7).map(|n| region.nth_band(n, 7)).collect();
        assert_eq!(parts.iter().map(|band| band.height).sum::<u32>(), 200);
        assert!(parts.windows(2).all(|pair| pair[0].bottom() == pair[1].y));
        assert!(parts.iter().all(|band| band.height.abs_diff(200 / 7) <= 1));
    }
}
