//! Hatching: equally spaced parallel lines on the paper, projected back onto faces (ISO 128-50).
//!
//! ```text
//!    ╱╱╱╱╱╱│╲╲╲╲╲
//!   ╱╱╱╱╱╱╱│╲╲╲╲╲     two faces, two directions
//!   ───────┴──────
//! ```
//!
//! A line on the paper is the image of a plane through the viewer. The segment where that plane
//! cuts a face is found in the world, from the signs of a linear function at the vertices. It is
//! then an edge like any other: clipped, projected, and divided by hidden-line removal.
//!
//! Section caps are hatched at 45°, or at 30° and 60° if many parts touch. Neighboring parts differ
//! in direction or spacing, and each part has the same pattern in all its cuts. With
//! [`FaceHatching::Parts`], whole parts have such patterns. With [`FaceHatching::ByLuma`], darker
//! faces are hatched more densely.

use super::edges::SectionCap;
use super::projector::Projector;
use super::region::{Region, RegionHatching, region_edges};
use super::visibility::Aabb;
use clip::{Volume, clip_triangle};
use core::fmt;
use glam::{DVec2, DVec3, DVec4};
use std::collections::BTreeMap;
use std::f64::consts::FRAC_1_SQRT_2;

/// The maximum number of segments in one hatching.
const MAX_SEGMENTS: usize = 1 << 22;

/// The spacings that distinguish parts with the same direction, as multiples of the first.
const SPACING_FACTORS: [f64; 4] = [1.0, 1.5, 0.75, 2.0];

/// The cosine of 30°.
const HALF_SQRT_3: f64 = 0.866_025_403_784_438_6;

/// The maximum number of parts that are compared with each other, because the number of comparisons
/// grows with the square of the number of parts.
const MAX_COMPARED_PARTS: usize = 1 << 13;

/// The hatch lines on faces, in addition to those on section caps.
#[derive(Clone, Copy, Default)]
pub enum FaceHatching<'a> {
    /// No hatch lines.
    #[default]
    None,
    /// Hatch lines on all faces, with a different angle or spacing for neighboring objects. If
    /// section planes cut the models, only the cuts are hatched.
    Parts,
    /// Hatch lines whose density depends on the luma of each face: the darker, the denser. The
    /// function receives the corners of a face in world space and the linear color of its material,
    /// and returns its luma, from 0 for black to 1 for white.
    ByLuma(&'a dyn Fn([DVec3; 3], [f32; 3]) -> f64),
}

impl fmt::Debug for FaceHatching<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::None => "None",
            Self::Parts => "Parts",
            Self::ByLuma(_) => "ByLuma",
        })
    }
}

/// A family of parallel lines on the screen.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct HatchPattern {
    /// The unit normal of the lines on the screen, with y down.
    normal: DVec2,
    /// The distance between lines in pixels.
    spacing: f64,
}

impl HatchPattern {
    /// Creates lines at 45° that rise to the right, or fall if `rises` is false.
    pub(super) fn diagonal_lines(rises: bool, spacing: f64) -> Self {
        let normal = DVec2::new(if rises { 1.0 } else { -1.0 }, 1.0) * FRAC_1_SQRT_2;
        Self { normal, spacing }
    }

    /// The number of different patterns.
    const COUNT: usize = 6 * SPACING_FACTORS.len();

    /// Returns the pattern of a part by its index: first in alternating directions, then with other
    /// spacings, then at 30° and 60°.
    ///
    /// ```text
    ///   part      0      1      2        3        4         5         6      7
    ///   lines     ╱      ╲      ╱ 1.5×   ╲ 1.5×   ╱ 0.75×   ╲ 0.75×   ╱ 2×   ╲ 2×
    /// ```
    fn for_part(index: usize, distance: f64) -> Self {
        let spacing = distance * SPACING_FACTORS[index / 2 % SPACING_FACTORS.len()];
        let diagonal = Self::diagonal_lines(index.is_multiple_of(2), spacing);
        let [x, y] = match index / (2 * SPACING_FACTORS.len()) % 3 {
            0 => return diagonal,
            1 => [0.5, HALF_SQRT_3],
            _ => [HALF_SQRT_3, 0.5],
        };
        Self { normal: DVec2::new(x * diagonal.normal.x.signum(), y), spacing }
    }

    /// Returns the pattern as the hatching of a region.
    fn region_hatching(&self) -> RegionHatching {
        RegionHatching { direction: -self.normal.perp(), spacing: self.spacing }
    }

    /// Returns the indices of the lines between two positions along the normal; line i is at i ·
    /// spacing.
    fn line_range(&self, [from, to]: [f64; 2]) -> std::ops::RangeInclusive<i64> {
        // A float-to-int cast saturates.
        libm::ceil(from / self.spacing) as i64..=libm::floor(to / self.spacing) as i64
    }

    /// Returns the linear function of homogeneous screen coordinates (x, y, z, w) that is zero on a
    /// line: n·(x, y) − i · spacing · w.
    fn line_function(&self, line: i64) -> DVec4 {
        let at = line as f64 * self.spacing;
        DVec4::new(self.normal.x, self.normal.y, 0.0, -at)
    }
}

/// The hatch lines on a set of faces.
#[derive(Debug, Default)]
pub(super) struct Hatching {
    /// Segments in the world, each with its object.
    pub(super) segments: Vec<([DVec3; 2], u32)>,
    /// The visible caps, with their patterns.
    pub(super) regions: Vec<Region>,
    /// Whether segments are missing because there were too many.
    pub(super) is_cut_off: bool,
}

impl Hatching {
    /// Hatches section caps: triangles by object and section plane. The caps of one object must be
    /// consecutive.
    ///
    /// Collinear segments from a cap's triangles are joined to hide the triangulation.
    pub(super) fn hatch_caps(
        caps: &[SectionCap],
        projector: &Projector,
        spacing: f64,
        touching: f64,
    ) -> Self {
        let mut hatching = Self::default();
        for (cap, part) in caps.iter().zip(assign_cap_patterns(caps, touching)) {
            let pattern = HatchPattern::for_part(part, spacing);
            let mut by_line = Vec::new();
            if cap.faces_viewer(projector) {
                hatching.regions.push(Region {
                    object: Some(cap.object),
                    edges: region_edges(cap.triangles.iter().copied(), projector),
                    hatching: Some(pattern.region_hatching()),
                });
            }
            for triangle in &cap.triangles {
                hatching.is_cut_off |= hatching.segments.len() + by_line.len() > MAX_SEGMENTS;
                if hatching.is_cut_off {
                    return hatching;
                }
                let push = |line, ends| by_line.push((line, ends));
                hatch_triangle(*triangle, projector, &pattern, |_| true, push);
            }
            let segments = join_collinear_segments(by_line, touching);
            hatching.segments.extend(segments.into_iter().map(|ends| (ends, cap.object)));
        }
        hatching
    }

    /// Hatches the faces of each part with a pattern that differs from its neighbors' and is the
    /// same for every viewer. Parts whose boxes touch are neighbors.
    pub(super) fn hatch_parts(
        faces: impl Iterator<Item = ([DVec3; 3], u32)>,
        boxes: BTreeMap<u32, Aabb>,
        projector: &Projector,
        spacing: f64,
        touching: f64,
    ) -> Self {
        let part = |(object, bounds): (u32, Aabb)| {
            let boxes = vec![bounds.expanded_by(DVec3::splat(touching))];
            HatchedPart { object, boxes, pattern: 0 }
        };
        let mut parts: Vec<HatchedPart> = boxes.into_iter().map(part).collect();
        choose_patterns(&mut parts);
        let patterns: BTreeMap<u32, HatchPattern> = parts
            .iter()
            .map(|part| (part.object, HatchPattern::for_part(part.pattern, spacing)))
            .collect();
        let mut hatching = Self::default();
        for (vertices, object) in faces {
            if hatching.segments.len() > MAX_SEGMENTS {
                hatching.is_cut_off = true;
                break;
            }
            let push = |_, ends| hatching.segments.push((ends, object));
            if let Some(pattern) = patterns.get(&object) {
                hatch_triangle(vertices, projector, pattern, |_| true, push);
            }
        }
        hatching
    }

    /// Hatches faces by luma, from 0 for black to 1 for white: the darker, the denser. The darkest
    /// faces are hatched in both directions.
    pub(super) fn hatch_faces_by_luma(
        faces: impl Iterator<Item = ([DVec3; 3], u32, f64)>,
        projector: &Projector,
        spacing: f64,
    ) -> Self {
        let mut hatching = Self::default();
        let patterns = [true, false].map(|rises| HatchPattern::diagonal_lines(rises, spacing));
        let limits = [MAX_HATCHED_LUMA, MAX_CROSS_HATCHED_LUMA];
        for (vertices, object, luma) in faces {
            for (pattern, limit) in patterns.iter().zip(limits) {
                if hatching.segments.len() > MAX_SEGMENTS {
                    hatching.is_cut_off = true;
                    return hatching;
                }
                let is_drawn = |line: i64| luma < limit * line_luma_factor(line);
                let push = |_, ends| hatching.segments.push((ends, object));
                hatch_triangle(vertices, projector, pattern, is_drawn, push);
            }
        }
        hatching
    }
}

/// The maximum luma of hatched faces.
const MAX_HATCHED_LUMA: f64 = 0.88;

/// The maximum luma of cross-hatched faces.
const MAX_CROSS_HATCHED_LUMA: f64 = 0.4;

/// Returns the fraction of the luma limit below which a line is drawn on a face. As faces get
/// darker, every fourth line is drawn first, then every second line, then all lines.
///
/// The densities are nested, so lines on adjacent faces continue each other.
fn line_luma_factor(line: i64) -> f64 {
    match line & 3 {
        0 => 1.0,
        2 => 0.82,
        _ => 0.64,
    }
}

/// The hatched faces of one object, with the index of their pattern.
struct HatchedPart {
    object: u32,
    /// The boxes around its faces, or around each cap, with the touching distance as a margin.
    boxes: Vec<Aabb>,
    pattern: usize,
}

/// Assigns a pattern index to each cap by greedy coloring, so that objects whose caps may touch get
/// different patterns.
fn assign_cap_patterns(caps: &[SectionCap], touching: f64) -> Vec<usize> {
    let mut parts: Vec<HatchedPart> = Vec::new();
    for SectionCap { object, triangles, .. } in caps {
        let bounds = Aabb::from_points(triangles.iter().flatten().copied());
        let bounds = bounds.expanded_by(DVec3::splat(touching));
        match parts.last_mut().filter(|part| part.object == *object) {
            Some(part) => part.boxes.push(bounds),
            None => parts.push(HatchedPart { object: *object, boxes: vec![bounds], pattern: 0 }),
        }
    }
    choose_patterns(&mut parts);
    let pattern_of = |object: u32| parts.iter().find(|part| part.object == object);
    caps.iter().map(|cap| pattern_of(cap.object).map_or(0, |part| part.pattern)).collect()
}

/// Assigns each part the lowest pattern index not used by an earlier part near it.
///
/// Parts beyond [`MAX_COMPARED_PARTS`] cycle through the patterns.
fn choose_patterns(parts: &mut [HatchedPart]) {
    for index in 0..parts.len() {
        if index >= MAX_COMPARED_PARTS {
            parts[index].pattern = index % HatchPattern::COUNT;
            continue;
        }
        let (colored, rest) = parts.split_at_mut(index);
        let part = &mut rest[0];
        let touches = |other: &&HatchedPart| {
            part.boxes.iter().any(|a| other.boxes.iter().any(|b| a.intersects(b)))
        };
        let mut used: Vec<usize> = colored.iter().filter(touches).map(|p| p.pattern).collect();
        used.sort_unstable();
        used.dedup();
        part.pattern = used.iter().zip(0..).take_while(|(used, free)| **used == *free).count();
    }
}

/// Calls `push` with the index and the world-space segment of each line that crosses a triangle.
///
/// ```text
///   n·p on the screen   ├── i ── i+1 ── i+2 ──┤     lines between the minimum and maximum
///                       minimum         maximum     position of the clipped triangle's vertices
/// ```
///
/// A line is the zero set of a linear function of clip coordinates, so its segment is found in the
/// world without inverting the projection. The segments cross the whole unclipped triangle;
/// hidden-line removal clips them. Lines that `is_drawn` rejects are skipped.
fn hatch_triangle(
    vertices: [DVec3; 3],
    projector: &Projector,
    pattern: &HatchPattern,
    is_drawn: impl Fn(i64) -> bool,
    mut push: impl FnMut(i64, [DVec3; 2]),
) {
    let clip = vertices.map(|vertex| projector.world_to_clip_point(vertex));
    let clipped = clip_triangle(clip, &Volume::CHAPTER);
    let positions =
        clipped.vertices().iter().filter_map(|vertex| projector.project_to_screen(vertex.point));
    let extent = positions.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], position| {
        let at = pattern.normal.dot(position.truncate());
        [least.min(at), most.max(at)]
    });
    if extent[0] > extent[1] {
        return;
    }
    let to_screen = projector.world_to_screen();
    let images = vertices.map(|vertex| to_screen * vertex.extend(1.0));
    for line in pattern.line_range(extent).filter(|line| is_drawn(*line)) {
        let function = pattern.line_function(line);
        let heights = images.map(|image| function.dot(image));
        zero_segment(vertices, heights).into_iter().for_each(|ends| push(line, ends));
    }
}

/// Returns the segment of a triangle where a linear function with the given vertex values is zero,
/// or `None` if it is empty or a point.
fn zero_segment(vertices: [DVec3; 3], heights: [f64; 3]) -> Option<[DVec3; 2]> {
    let mut ends = [None; 2];
    for k in 0..3 {
        let (one, other) =
            ((vertices[k], heights[k]), (vertices[(k + 1) % 3], heights[(k + 1) % 3]));
        if (one.1 < 0.0) == (other.1 < 0.0) {
            continue;
        }
        // The orientation is the same for both faces at the side, so neighbors meet at
        // bit-identical points.
        let rises = one.0.to_array() < other.0.to_array();
        let ((p, from), (q, to)) = if rises { (one, other) } else { (other, one) };
        let position = p + (q - p) * (from / (from - to));
        ends[usize::from(ends[0].is_some())] = Some(position);
    }
    let [Some(a), Some(b)] = ends else { return None };
    (a != b && a.is_finite() && b.is_finite()).then_some([a, b])
}

/// Joins coplanar segments on the same hatch line if the gap between them is at most `touching`.
fn join_collinear_segments(mut by_line: Vec<(i64, [DVec3; 2])>, touching: f64) -> Vec<[DVec3; 2]> {
    by_line.sort_by_key(|(line, _)| *line);
    let mut joined = Vec::new();
    for on_line in by_line.chunk_by_mut(|(a, _), (b, _)| a == b) {
        join_on_line(on_line, touching, &mut joined);
    }
    joined
}

/// Joins the segments of one hatch line by interval union along the direction of the longest
/// segment.
fn join_on_line(on_line: &mut [(i64, [DVec3; 2])], touching: f64, joined: &mut Vec<[DVec3; 2]>) {
    let longest = |a: &DVec3, b: &DVec3| a.length_squared().total_cmp(&b.length_squared());
    let along = on_line.iter().map(|(_, [a, b])| *b - *a).max_by(longest);
    let along = along.unwrap_or_default().normalize_or_zero();
    for (_, ends) in on_line.iter_mut() {
        if along.dot(ends[1] - ends[0]) < 0.0 {
            ends.reverse();
        }
    }
    on_line.sort_by(|(_, a), (_, b)| along.dot(a[0]).total_cmp(&along.dot(b[0])));
    let first = joined.len();
    for (_, ends) in on_line.iter() {
        match joined[first..].last_mut() {
            Some(last) if along.dot(ends[0] - last[1]) <= touching => {
                if along.dot(ends[1] - last[1]) > 0.0 {
                    last[1] = ends[1];
                }
            }
            _ => joined.push(*ends),
        }
    }
}
