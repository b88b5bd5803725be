//! Arbitrary triangles, lines and points, which must produce the same picture whether drawn whole,
//! in two parts or at any SIMD level.

use crate::numbers::Numbers;
use homog::{PixelRect, Point};
use raster::{Frame, Opacity, Samples, ScreenVertex, SimdLevel, VisibilityBuffer};

impl Numbers<'_> {
    /// Returns a coordinate with arbitrary bits, or a coordinate near the picture, on or off the
    /// grid.
    fn number(&mut self) -> f64 {
        match self.byte() % 8 {
            0 => f64::from_le_bytes(self.take()),
            1 => f64::from(f32::from_le_bytes(self.take())),
            2 => f64::from(i16::from_le_bytes(self.take())),
            3 => f64::from(i32::from_le_bytes(self.take())) / 65_536.0,
            _ => f64::from(i16::from_le_bytes(self.take())) / 256.0,
        }
    }

    fn vertex(&mut self) -> Option<ScreenVertex> {
        let point = Point::new(self.number(), self.number(), self.number().abs().fract());
        let w = if self.byte() < 128 { 1.0 } else { self.number() };
        ScreenVertex::snap(point, w)
    }
}

/// Draws a picture from its description: the size, the samples, then one primitive after another.
pub fn frames(bytes: &[u8]) {
    let mut numbers = Numbers(bytes);
    let size = [numbers.byte(), numbers.byte()].map(|side| 1 + u32::from(side) % 96);
    let samples = [Samples::One, Samples::Four, Samples::Eight, Samples::Sixteen];
    let samples = samples[usize::from(numbers.byte() % 4)];
    let split = u32::from(numbers.byte()) % size[0];
    let [width, height] = size;
    let Ok(mut whole) = Frame::new(width, height, samples) else { panic!("the size is valid") };
    let region =
        |x: u32, width: u32| Frame::for_region(PixelRect { x, y: 0, width, height }, samples);
    let mut parts = Vec::new();
    if split > 0 {
        parts.extend(region(0, split));
    }
    parts.extend(region(split, width - split));
    for id in 0..64 {
        if numbers.0.is_empty() {
            break;
        }
        let rest = numbers.0;
        for frame in parts.iter_mut().chain([&mut whole]) {
            numbers.0 = rest;
            primitive(frame, &mut numbers, id);
        }
    }
    let seen = whole.visibility_buffer();
    for level in SimdLevel::available() {
        let other = whole.clone().with_simd_level(level).visibility_buffer();
        assert!(same(&seen, &other), "{level:?} gives a different picture");
    }
    check_parts(&seen, &parts, [split, width]);
    whole.for_each_fragment(|fragment| {
        let [a, b, c] = fragment.weights;
        assert!(a.is_finite() && b.is_finite() && c.is_finite(), "a weight is not finite");
    });
}

fn primitive(frame: &mut Frame, numbers: &mut Numbers<'_>, id: u32) {
    let kind = numbers.byte();
    let cover = [Opacity::Opaque, Opacity::Masked, Opacity::Translucent][usize::from(kind / 4 % 3)];
    match kind % 4 {
        0 | 1 => {
            let corners = [numbers.vertex(), numbers.vertex(), numbers.vertex()];
            if let [Some(p), Some(q), Some(r)] = corners {
                frame.add_triangle([p, q, r], id, cover);
            }
        }
        2 => {
            let (ends, width) = ([numbers.vertex(), numbers.vertex()], numbers.number());
            if let [Some(p), Some(q)] = ends {
                frame.add_line([p, q], width, id, cover);
            }
        }
        _ => {
            let (center, size) = (numbers.vertex(), numbers.number());
            if let Some(center) = center {
                frame.add_point(center, size, id, cover);
            }
        }
    }
}

fn same(a: &VisibilityBuffer, b: &VisibilityBuffer) -> bool {
    let bits = |seen: &VisibilityBuffer| seen.depth.iter().map(|d| d.to_bits()).collect::<Vec<_>>();
    a.ids == b.ids && bits(a) == bits(b)
}

/// Checks that the parts, side by side, are equal to the whole.
fn check_parts(whole: &VisibilityBuffer, parts: &[Frame], [split, width]: [u32; 2]) {
    let mut left = 0;
    for frame in parts {
        let (seen, part_width) = (frame.visibility_buffer(), frame.width() as usize);
        for (at, id) in seen.ids.iter().enumerate() {
            let there = at / part_width * width as usize + left + at % part_width;
            assert_eq!(*id, whole.ids[there], "a part from column {left}, split at {split}");
            let depths = [seen.depth[at], whole.depth[there]].map(f32::to_bits);
            assert_eq!(depths[0], depths[1], "a depth of a part from column {left}");
        }
        left += part_width;
    }
}
