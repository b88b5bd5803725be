//! Areas of equal color in an image, traced as polygons.
//!
//! ```text
//!   ┌──┬──┬──┐        ●────────●      the pixel sides between two colors are followed around each
//!   │▒▒│▒▒│  │        │       ╱       area, and stair steps are straightened (Douglas and Peucker
//!   ├──┼──┼──┤   ─►   │     ╱         1973) between junctions; a junction is a pixel corner
//!   │▒▒│  │  │        │   ╱           where more than two borders meet
//!   └──┴──┴──┘        ●──●
//! ```
//!
//! The border between two junctions is straightened in the same direction for both of its areas.
//! Neighbors therefore share the same border, without gaps or overlaps.

use picture::Picture;
use std::collections::BTreeMap;

/// A pixel corner, in pixels from the upper left corner of the image, y down.
pub(super) type PixelCorner = [i32; 2];

/// The maximum distance between a straightened border and the original pixel corners, in pixels.
const TOLERANCE: f64 = 1.2;

/// Traces the areas of each color in an image as closed lines to be filled with the even-odd rule.
/// Transparent pixels belong to no area.
pub(super) fn trace_color_areas(picture: &Picture) -> BTreeMap<[u8; 4], Vec<Vec<PixelCorner>>> {
    let image = ColorImage { picture, size: [picture.width, picture.height].map(|n| n as i32) };
    let mut areas: BTreeMap<[u8; 4], Vec<Vec<PixelCorner>>> = BTreeMap::new();
    let mut visited = vec![false; picture.pixels.len()];
    for y in 0..image.size[1] {
        for x in 0..image.size[0] {
            let Some(color) = image.color([x, y]) else { continue };
            let index = (y * image.size[0] + x) as usize;
            if visited[index] || image.color([x, y - 1]) == Some(color) {
                continue;
            }
            let border = image.walk_border([x, y], color, &mut visited);
            let outline = straighten(&border);
            if outline.len() >= 3 {
                areas.entry(color).or_default().push(outline);
            }
        }
    }
    areas
}

/// The four directions along pixel sides, clockwise with y down.
const STEPS: [PixelCorner; 4] = [[1, 0], [0, 1], [-1, 0], [0, -1]];

/// For each direction, the offset from the start of a side to the pixel on its right.
const RIGHT: [PixelCorner; 4] = [[0, 0], [-1, 0], [-1, -1], [0, -1]];

/// A border corner, and whether more than two borders meet there.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
struct BorderCorner {
    at: PixelCorner,
    is_junction: bool,
}

/// An image with transparent surroundings.
struct ColorImage<'a> {
    picture: &'a Picture,
    size: [i32; 2],
}

impl ColorImage<'_> {
    /// Returns the color of a pixel, or `None` if it is transparent or outside the image.
    fn color(&self, [x, y]: PixelCorner) -> Option<[u8; 4]> {
        let is_inside = (0..self.size[0]).contains(&x) && (0..self.size[1]).contains(&y);
        let color = is_inside.then(|| self.picture.pixels[(y * self.size[0] + x) as usize]);
        color.filter(|color| color[3] > 0)
    }

    /// Follows the border of a color from the upper left corner of a pixel, with the color on the
    /// right, and marks the pixels whose upper sides it passes.
    ///
    /// Pixels that touch only at a corner belong to different areas. The returned corners are the
    /// turns of the border and the junctions.
    fn walk_border(
        &self,
        start: PixelCorner,
        color: [u8; 4],
        visited: &mut [bool],
    ) -> Vec<BorderCorner> {
        let mut corners = Vec::new();
        let (mut at, mut direction) = (start, 0);
        loop {
            if direction == 0 {
                visited[(at[1] * self.size[0] + at[0]) as usize] = true;
            }
            at = [0, 1].map(|axis| at[axis] + STEPS[direction][axis]);
            let beside = |turned: usize| {
                let pixel = RIGHT[(direction + turned) % 4];
                self.color([0, 1].map(|axis| at[axis] + pixel[axis])) == Some(color)
            };
            // The border turns right if the pixel ahead on the right has another color, and left if
            // both pixels ahead have the color.
            let turn = match (beside(0), beside(3)) {
                (false, _) => 1,
                (true, false) => 0,
                (true, true) => 3,
            };
            let is_junction = self.is_junction(at);
            if turn != 0 || is_junction {
                corners.push(BorderCorner { at, is_junction });
            }
            direction = (direction + turn) % 4;
            if at == start && direction == 0 {
                return corners;
            }
        }
    }

    /// Whether more than two borders meet at a pixel corner.
    fn is_junction(&self, at: PixelCorner) -> bool {
        let around = RIGHT.map(|pixel| self.color([0, 1].map(|axis| at[axis] + pixel[axis])));
        (0..4).filter(|&k| around[k] != around[(k + 1) % 4]).count() > 2
    }
}

/// Straightens a closed border by removing corners, but never junctions.
fn straighten(border: &[BorderCorner]) -> Vec<PixelCorner> {
    let first = match border.iter().position(|corner| corner.is_junction) {
        Some(first) => first,
        None => {
            let least = border.iter().enumerate().min_by_key(|(_, corner)| corner.at);
            least.map_or(0, |(index, _)| index)
        }
    };
    let mut ring: Vec<BorderCorner> =
        border[first..].iter().chain(&border[..first]).copied().collect();
    ring.extend(ring.first().copied());
    let junctions = (1..ring.len()).filter(|&index| ring[index].is_junction);
    let mut ends: Vec<usize> = junctions.collect();
    if ends.last() != Some(&(ring.len() - 1)) {
        ends.push(ring.len() - 1);
    }
    let mut outline = Vec::new();
    let mut from = 0;
    for to in ends {
        let part: Vec<PixelCorner> = ring[from..=to].iter().map(|corner| corner.at).collect();
        let kept = straighten_part(part);
        outline.extend_from_slice(&kept[..kept.len() - 1]);
        from = to;
    }
    outline
}

/// Straightens a part of a border by removing corners, but never its endpoints. A reversed part
/// gives the reversed result.
fn straighten_part(mut part: Vec<PixelCorner>) -> Vec<PixelCorner> {
    let last = part.len() - 1;
    let is_reversed = if part[0] == part[last] {
        part[1.min(last)] > part[last.saturating_sub(1)]
    } else {
        part[0] > part[last]
    };
    if is_reversed {
        part.reverse();
    }
    let mut keeps = vec![false; part.len()];
    (keeps[0], keeps[last]) = (true, true);
    let mut ranges = vec![(0, last)];
    while let Some((from, to)) = ranges.pop() {
        let far = |best: Option<(usize, f64)>, index: usize| {
            let distance = squared_distance(part[index], [part[from], part[to]]);
            match best {
                Some((_, most)) if distance <= most => best,
                _ => Some((index, distance)),
            }
        };
        let farthest = (from + 1..to).fold(None, far);
        if let Some((index, _)) = farthest.filter(|(_, most)| *most > TOLERANCE * TOLERANCE) {
            keeps[index] = true;
            ranges.extend([(from, index), (index, to)]);
        }
    }
    let mut kept: Vec<PixelCorner> =
        part.iter().zip(keeps).filter(|(_, keeps)| *keeps).map(|(corner, _)| *corner).collect();
    if is_reversed {
        kept.reverse();
    }
    kept
}

/// Returns the squared distance of a corner from the segment between two others.
fn squared_distance(point: PixelCorner, [a, b]: [PixelCorner; 2]) -> f64 {
    let between = |from: PixelCorner, to: PixelCorner| {
        [0, 1].map(|axis| f64::from(to[axis]) - f64::from(from[axis]))
    };
    let dot = |u: [f64; 2], v: [f64; 2]| u[0] * v[0] + u[1] * v[1];
    let (along, from_a, from_b) = (between(a, b), between(a, point), between(b, point));
    let (length, at) = (dot(along, along), dot(along, from_a));
    if at <= 0.0 {
        dot(from_a, from_a)
    } else if at >= length {
        dot(from_b, from_b)
    } else {
        let across = along[0] * from_a[1] - along[1] * from_a[0];
        across * across / length
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns an image from rows of letters, one letter per color; dots are transparent.
    fn image(rows: &[&str]) -> Picture {
        let color = |letter: u8| if letter == b'.' { [0; 4] } else { [letter, 0, 0, 255] };
        Picture {
            width: rows[0].len() as u32,
            height: rows.len() as u32,
            pixels: rows.iter().flat_map(|row| row.bytes().map(color)).collect(),
        }
    }

    /// Returns twice the area of outlines; holes count as negative.
    fn doubled_area(outlines: &[Vec<PixelCorner>]) -> i32 {
        let sides = |outline: &[PixelCorner]| -> i32 {
            let next = outline.iter().cycle().skip(1);
            outline.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum()
        };
        outlines.iter().map(|outline| sides(outline)).sum()
    }

    #[test]
    fn rectangles_keep_their_corners_and_holes() {
        let picture = image(&["aaaaaa", "a....a", "a.bb.a", "a.bb.a", "a....a", "aaaaaa"]);
        let areas = trace_color_areas(&picture);
        let [a, b] = [b'a', b'b'].map(|letter| &areas[&[letter, 0, 0, 255]]);
        assert_eq!(b, &[vec![[2, 2], [4, 2], [4, 4], [2, 4]]]);
        assert_eq!((a.len(), doubled_area(a)), (2, 2 * (36 - 16)));
    }

    #[test]
    fn neighbors_share_their_border() {
        // A disc of three colors in a transparent frame.
        let side = 200_i32;
        let color = |at: i32| {
            let (x, y) = (at % side - 100, at / side - 100);
            let letter = match () {
                () if x * x + y * y > 95 * 95 => b'.',
                () if y > 0 && x * 3 < y => b'a',
                () if x > 0 => b'b',
                () => b'c',
            };
            if letter == b'.' { [0; 4] } else { [letter, 0, 0, 255] }
        };
        let pixels = (0..side * side).map(color).collect();
        let areas = trace_color_areas(&Picture { width: 200, height: 200, pixels });
        let mut sides = BTreeMap::new();
        for outline in areas.values().flatten() {
            for (a, b) in outline.iter().zip(outline.iter().cycle().skip(1)) {
                *sides.entry((*a.min(b), *a.max(b))).or_insert(0) += if a < b { 1 } else { -1 };
            }
        }
        // Sides that are not shared are on the outline of the disc.
        for ((a, b), sum) in sides {
            let radius =
                |at: PixelCorner| libm::hypot(f64::from(at[0] - 100), f64::from(at[1] - 100));
            let is_outer = radius(a) > 93.0 && radius(b) > 93.0;
            assert_eq!(sum != 0, is_outer, "{a:?} {b:?}");
        }
        let whole = areas.values().map(|outlines| doubled_area(outlines)).sum::<i32>();
        let disc = std::f64::consts::TAU * 95.0 * 95.0;
        assert!((f64::from(whole) - disc).abs() < 0.01 * disc, "{whole} {disc}");
        let corners: usize = areas.values().flatten().map(Vec::len).sum();
        assert!(corners < 150, "{corners} corners: stair steps remain");
    }

    #[test]
    fn pixels_that_touch_only_at_a_corner_have_separate_borders() {
        let areas = trace_color_areas(&image(&["aa..", "aa..", "..aa", "..aa"]));
        assert_eq!(areas.values().map(Vec::len).sum::<usize>(), 2);
    }
}
