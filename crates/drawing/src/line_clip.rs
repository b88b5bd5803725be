//! Clips line drawings to areas of the picture, and merges the clipped parts.
//!
//! ```text
//!   ──────╱─────╲──────        ╱─────╲        lines and hatch lines are cut where they
//!        │       │      ─►    │       │       cross the border
//!   ──────╲─────╱──────        ╲─────╱
//! ```
//!
//! Each line is cut where it crosses the border, and the midpoint of each part decides whether the
//! part is kept. An area keeps exactly the parts that its complement removes, so nothing is drawn
//! twice. Depth is linear on the screen, so the depths of parts are interpolated.

use super::Drawing;
use glam::DVec2;
use hidden_line::{EdgeSegment, Region, RegionEdge};

/// The number of corners of the polygon that represents a disc. Its sides deviate from the circle
/// by 0.02% of the radius.
const DISC_CORNERS: u32 = 180;

/// An area of the picture in pixels, with y down.
#[derive(Clone, PartialEq, Debug)]
pub enum ClipArea {
    /// A disc.
    Disc {
        /// The center.
        center: DVec2,
        /// The radius.
        radius: f64,
    },
    /// A star-shaped polygon: its whole border is visible from its center.
    Star {
        /// The point from which the whole border is visible.
        center: DVec2,
        /// The corners in order.
        corners: Vec<DVec2>,
    },
}

/// The part of a drawing that is kept.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ClipSide {
    /// The part within the area.
    Inside,
    /// The part outside it.
    Outside,
}

impl ClipArea {
    /// Returns the half-plane to the left of a line, as seen with y up, as a polygon large enough
    /// for any drawing.
    pub fn half_plane(point: DVec2, along: DVec2) -> Self {
        const FAR: f64 = 1e6;
        let (along, left) = (along * FAR, DVec2::new(along.y, -along.x) * FAR);
        let corners =
            vec![point - along, point + along, point + along + left, point - along + left];
        Self::Star { center: point + left * 0.5, corners }
    }

    /// Returns the area as a star-shaped polygon: its center and corners.
    fn to_star(&self) -> (DVec2, Vec<DVec2>) {
        match self {
            Self::Star { center, corners } => (*center, corners.clone()),
            Self::Disc { center, radius } => {
                (*center, circle_points(*center, *radius, DISC_CORNERS))
            }
        }
    }

    /// Whether a point is inside (even-odd rule).
    pub fn contains(&self, point: DVec2) -> bool {
        match self {
            Self::Disc { center, radius } => point.distance_squared(*center) < radius * radius,
            Self::Star { corners, .. } => sides(corners).fold(false, |inside, [a, b]| {
                let crosses = (a.y > point.y) != (b.y > point.y);
                inside ^ (crosses && point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x))
            }),
        }
    }

    /// Returns the sorted fractions at which a line crosses the border, together with 0 and 1.
    fn crossings(&self, [a, b]: [DVec2; 2]) -> Vec<f64> {
        let mut cuts = vec![0.0, 1.0];
        let step = b - a;
        match self {
            Self::Disc { center, radius } => {
                // |a + t · step − center|² = radius²
                let from = a - *center;
                let (p, q, r) = (
                    step.length_squared(),
                    from.dot(step),
                    from.length_squared() - radius * radius,
                );
                let root = q * q - p * r;
                if p > 0.0 && root > 0.0 {
                    cuts.extend([(-q - root.sqrt()) / p, (-q + root.sqrt()) / p]);
                }
            }
            Self::Star { corners, .. } => {
                for [from, to] in sides(corners) {
                    let (side, across) = (to - from, step.perp_dot(to - from));
                    let along = (from - a).perp_dot(step) / across;
                    if across != 0.0 && (0.0..=1.0).contains(&along) {
                        cuts.push((from - a).perp_dot(side) / across);
                    }
                }
            }
        }
        cuts.retain(|t| (0.0..=1.0).contains(t));
        cuts.sort_by(f64::total_cmp);
        cuts.dedup();
        cuts
    }

    /// Returns the parts of a line on one side of the border, as intervals of fractions.
    pub fn intervals(&self, ends: [DVec2; 2], side: ClipSide) -> Vec<[f64; 2]> {
        let wanted = side == ClipSide::Inside;
        let mut kept: Vec<[f64; 2]> = Vec::new();
        for pair in self.crossings(ends).windows(2) {
            if self.contains(ends[0].lerp(ends[1], (pair[0] + pair[1]) * 0.5)) != wanted {
                continue;
            }
            match kept.last_mut() {
                Some(last) if last[1] == pair[0] => last[1] = pair[1],
                _ => kept.push([pair[0], pair[1]]),
            }
        }
        kept
    }
}

/// Returns the sides of a polygon.
fn sides(corners: &[DVec2]) -> impl Iterator<Item = [DVec2; 2]> {
    corners.iter().zip(corners.iter().cycle().skip(1)).map(|(a, b)| [*a, *b])
}

/// Returns equally spaced points on a circle.
pub fn circle_points(center: DVec2, radius: f64, count: u32) -> Vec<DVec2> {
    let at = |k: u32| {
        let (sine, cosine) = libm::sincos(std::f64::consts::TAU * f64::from(k) / f64::from(count));
        center + DVec2::new(cosine, sine) * radius
    };
    (0..count).map(at).collect()
}

/// Returns the point at a fraction `t` of a line; the endpoints are exact.
pub fn point_at([a, b]: [DVec2; 2], t: f64) -> DVec2 {
    if t == 1.0 { b } else { a.lerp(b, t) }
}

impl Drawing {
    /// Returns the part of the drawing inside or outside an area. The outside part has no regions.
    pub fn clipped(mut self, area: &ClipArea, side: ClipSide) -> Self {
        let segments = self.segments.iter().flat_map(|segment| {
            let parts = area.intervals(segment.ends, side).into_iter();
            parts.map(|part| EdgeSegment {
                ends: part.map(|t| point_at(segment.ends, t)),
                depths: part
                    .map(|t| segment.depths[0] + (segment.depths[1] - segment.depths[0]) * t),
                ..*segment
            })
        });
        self.segments = segments.filter(|segment| segment.ends[0] != segment.ends[1]).collect();
        let regions = self.regions.into_iter().filter(|_| side == ClipSide::Inside);
        self.regions = regions.map(|region| clip_region(region, area)).collect();
        self.mask_face_fill(|pixel| area.contains(pixel) == (side == ClipSide::Inside));
        self
    }

    /// Makes the fill transparent at positions that `keeps` rejects, given in drawing pixels.
    fn mask_face_fill(&mut self, keeps: impl Fn(DVec2) -> bool) {
        let size = self.size;
        let Some(fill) = &mut self.face_fill else { return };
        let step = size / DVec2::new(f64::from(fill.width), f64::from(fill.height));
        for (index, pixel) in fill.pixels.iter_mut().enumerate() {
            let index = index as u32;
            let at = DVec2::new(f64::from(index % fill.width), f64::from(index / fill.width));
            if !keeps((at + 0.5) * step) {
                *pixel = [0; 4];
            }
        }
    }

    /// Returns the drawing moved by a vector in pixels; its fill moves by whole pixels.
    pub fn moved_by(mut self, by: DVec2) -> Self {
        self.segments.iter_mut().flat_map(|segment| &mut segment.ends).for_each(|end| *end += by);
        let edges = self.regions.iter_mut().flat_map(|region| &mut region.edges);
        edges.flat_map(|edge| &mut edge.ends).for_each(|end| *end += by);
        if let Some(fill) = &mut self.face_fill {
            let [width, height] = [fill.width, fill.height].map(i64::from);
            let scale = DVec2::new(width as f64, height as f64) / self.size;
            let [dx, dy] = (by * scale).to_array().map(|shift| libm::round(shift) as i64);
            let source = |index: usize| {
                let (x, y) = (index as i64 % width - dx, index as i64 / width - dy);
                let is_there = (0..width).contains(&x) && (0..height).contains(&y);
                if is_there { fill.pixels[(y * width + x) as usize] } else { [0; 4] }
            };
            fill.pixels = (0..fill.pixels.len()).map(source).collect();
        }
        self
    }

    /// Adds the lines of another drawing of the same models and size, and its fill where this
    /// drawing has none.
    pub fn merge(&mut self, other: Self) {
        let offset = self.segments.iter().map(|segment| segment.edge + 1).max().unwrap_or(0);
        let moved = |segment: EdgeSegment| EdgeSegment { edge: segment.edge + offset, ..segment };
        self.segments.extend(other.segments.into_iter().map(moved));
        self.segments.sort_by_key(|segment| segment.object);
        self.regions.extend(other.regions);
        match (&mut self.face_fill, other.face_fill) {
            (Some(fill), Some(added)) => {
                for (pixel, other) in fill.pixels.iter_mut().zip(added.pixels) {
                    if pixel[3] == 0 {
                        *pixel = other;
                    }
                }
            }
            (Some(_), None) => {}
            (fill, added) => *fill = added,
        }
        self.warnings.extend(other.warnings);
        self.warnings.sort_unstable();
        self.warnings.dedup();
    }
}

/// Clips a region to an area.
///
/// Points outside are pulled in to the border, along rays to the center. That retraction keeps
/// closed chains closed, so the winding numbers inside the area do not change.
fn clip_region(region: Region, area: &ClipArea) -> Region {
    let (center, corners) = area.to_star();
    let star = ClipArea::Star { center, corners };
    let ClipArea::Star { corners, .. } = &star else { return region };
    let mut edges = Vec::new();
    for edge in &region.edges {
        let push = |edges: &mut Vec<RegionEdge>, from: DVec2, to: DVec2| {
            if from != to {
                edges.push(RegionEdge { ends: [from, to], winding: edge.winding });
            }
        };
        for pair in star.crossings(edge.ends).windows(2) {
            let ends = [pair[0], pair[1]].map(|t| point_at(edge.ends, t));
            if star.contains((ends[0] + ends[1]) * 0.5) {
                push(&mut edges, ends[0], ends[1]);
                continue;
            }
            // A cut between the ends of the line is already on the border.
            let drawn_in = |t: f64, end: DVec2| {
                let is_crossing = t > 0.0 && t < 1.0 || star.contains(end);
                if is_crossing { end } else { border_point(center, corners, end) }
            };
            let mut last = drawn_in(pair[0], ends[0]);
            for corner in corners_between(center, corners, ends) {
                push(&mut edges, last, corner);
                last = corner;
            }
            push(&mut edges, last, drawn_in(pair[1], ends[1]));
        }
    }
    Region { edges, ..region }
}

/// Returns the point where the ray from the center through a point leaves a polygon.
fn border_point(center: DVec2, corners: &[DVec2], point: DVec2) -> DVec2 {
    let ray = point - center;
    let hit = |[a, b]: [DVec2; 2]| {
        let across = ray.perp_dot(b - a);
        let along = (a - center).perp_dot(ray) / across;
        let t = (a - center).perp_dot(b - a) / across;
        (across != 0.0 && (0.0..=1.0).contains(&along) && t > 0.0).then_some(t)
    };
    let t = sides(corners).filter_map(hit).fold(0.0_f64, f64::max);
    if t > 0.0 { center + ray * t } else { point }
}

/// Returns the polygon corners that a ray from the center passes as it sweeps from one end of a
/// line to the other.
fn corners_between(center: DVec2, corners: &[DVec2], ends: [DVec2; 2]) -> Vec<DVec2> {
    let [from, to] = ends.map(|end| end - center);
    let turn = from.perp_dot(to).signum();
    let is_between = |corner: &&DVec2| {
        let ray = **corner - center;
        from.perp_dot(ray) * turn > 0.0 && ray.perp_dot(to) * turn > 0.0
    };
    let mut between: Vec<DVec2> = corners.iter().filter(is_between).copied().collect();
    between.sort_by(|a, b| {
        let cross = (*a - center).perp_dot(*b - center) * turn;
        0.0_f64.total_cmp(&cross)
    });
    between
}

#[cfg(test)]
mod tests {
    use super::*;
    use hidden_line::EdgeClass;
    use picture::Picture;

    fn segment(ends: [DVec2; 2]) -> EdgeSegment {
        let class = EdgeClass::Crease;
        EdgeSegment { ends, depths: [0.0, 1.0], class, visible: true, object: 0, edge: 0 }
    }

    fn drawing(ends: [DVec2; 2]) -> Drawing {
        let size = DVec2::splat(100.0);
        Drawing { size, segments: vec![segment(ends)], ..Drawing::default() }
    }

    #[test]
    fn lines_are_cut_at_the_circle() {
        let area = ClipArea::Disc { center: DVec2::splat(50.0), radius: 5.0 };
        // A chord at distance 3 from the center has length 2 · 4.
        let ends = [DVec2::new(0.0, 53.0), DVec2::new(100.0, 53.0)];
        let inside = drawing(ends).clipped(&area, ClipSide::Inside);
        let [part] = inside.segments.as_slice() else { panic!("{:?}", inside.segments) };
        assert!((part.ends[0] - DVec2::new(46.0, 53.0)).length() < 1e-12);
        assert!((part.ends[1] - DVec2::new(54.0, 53.0)).length() < 1e-12);
        assert!((part.depths[0] - 0.46).abs() < 1e-12 && (part.depths[1] - 0.54).abs() < 1e-12);
        let outside = drawing(ends).clipped(&area, ClipSide::Outside).segments;
        assert_eq!((outside.len(), outside[0].ends[1]), (2, part.ends[0]));
        // A tangent, and a line that misses the circle, are outside.
        for y in [55.0, 60.0] {
            let ends = [DVec2::new(0.0, y), DVec2::new(100.0, y)];
            assert_eq!(drawing(ends).clipped(&area, ClipSide::Inside).segments, []);
            assert_eq!(drawing(ends).clipped(&area, ClipSide::Outside).segments, [segment(ends)]);
        }
    }

    #[test]
    fn a_merged_fill_goes_under_the_existing_fill() {
        let ends = [DVec2::ZERO, DVec2::splat(100.0)];
        let filled = |pixels: Vec<[u8; 4]>| Drawing {
            face_fill: Some(Picture { width: 2, height: 1, pixels }),
            ..drawing(ends)
        };
        let (red, green) = ([255, 0, 0, 255], [0, 255, 0, 255]);
        let pixels = |upper: Drawing, lower: Drawing| {
            let mut merged = upper;
            merged.merge(lower);
            merged.face_fill.map(|fill| fill.pixels)
        };
        let half = || filled(vec![red, [0; 4]]);
        assert_eq!(pixels(half(), filled(vec![green; 2])), Some(vec![red, green]));
        assert_eq!(pixels(drawing(ends), half()), Some(vec![red, [0; 4]]));
        assert_eq!(pixels(half(), drawing(ends)), Some(vec![red, [0; 4]]));
        assert_eq!(pixels(drawing(ends), drawing(ends)), None);
    }

    #[test]
    fn the_two_sides_of_a_half_plane_divide_a_line_completely() {
        let (point, along) = (DVec2::new(40.0, 0.0), DVec2::Y);
        let area = ClipArea::half_plane(point, along);
        for y in [0.0, 10.0, 33.0] {
            let ends = [DVec2::new(0.0, y), DVec2::new(100.0, y + 7.0)];
            let length = |side| -> f64 {
                let parts = drawing(ends).clipped(&area, side).segments;
                parts.iter().map(|part| part.ends[0].distance(part.ends[1])).sum()
            };
            let whole = ends[0].distance(ends[1]);
            let [inside, outside] = [ClipSide::Inside, ClipSide::Outside].map(length);
            assert!((inside + outside - whole).abs() < 1e-9);
            assert!((inside / whole - 0.6).abs() < 1e-9, "{inside} of {whole}");
        }
    }

    /// Returns the area enclosed by the edges of a region, by the shoelace formula.
    fn area_of(region: &Region) -> f64 {
        let part =
            |edge: &RegionEdge| 0.5 * f64::from(edge.winding) * edge.ends[0].perp_dot(edge.ends[1]);
        region.edges.iter().map(part).sum()
    }

    #[test]
    fn regions_are_cut_to_the_area() {
        let corners = [[0.0, 0.0], [100.0, 0.0], [100.0, 60.0], [0.0, 60.0]].map(DVec2::from);
        let edges = sides(&corners).map(|ends| RegionEdge { ends, winding: 1 }).collect();
        let region = Region { object: None, edges, hatching: None };
        let half = ClipArea::half_plane(DVec2::new(40.0, 0.0), DVec2::Y);
        assert!((area_of(&clip_region(region.clone(), &half)) - 60.0 * 60.0).abs() < 1e-6);
        // Discs inside the region, across its border, around it and outside it.
        let disc = |x: f64, radius: f64| ClipArea::Disc { center: DVec2::new(x, 30.0), radius };
        let circle = |radius: f64| std::f64::consts::PI * radius * radius;
        for (area, expected) in [
            (disc(50.0, 20.0), circle(20.0)),
            (disc(0.0, 20.0), 0.5 * circle(20.0)),
            (disc(50.0, 90.0), 6000.0),
            (disc(200.0, 50.0), 0.0),
        ] {
            let found = area_of(&clip_region(region.clone(), &area));
            assert!((found - expected).abs() <= expected * 3e-4 + 1e-9, "{found} {expected}");
        }
    }

    #[test]
    fn edges_of_merged_drawings_stay_distinct() {
        let ends = [DVec2::ZERO, DVec2::ONE];
        let mut merged = drawing(ends);
        merged.merge(drawing(ends).moved_by(DVec2::X));
        let edges: Vec<u32> = merged.segments.iter().map(|segment| segment.edge).collect();
        assert_eq!((edges.as_slice(), merged.segments[1].ends[0]), (&[0, 1][..], DVec2::X));
    }
}
