//! Benchmarks that clip mesh triangles.

use crate::measure::Variant;
use crate::scene::{POINT_COUNT, coordinate};
use clip::{Outcode, Volume, clip_triangle};
use glam::DVec4;
use homog::{Clip, HPoint};
use std::hint::black_box;

/// Projected points and the triangles between them, three indices each.
struct Mesh {
    points: Vec<HPoint<Clip>>,
    triangles: Vec<[usize; 3]>,
}

impl Mesh {
    fn triangle_points(&self, triangle: [usize; 3]) -> [HPoint<Clip>; 3] {
        triangle.map(|i| self.points[i])
    }
}

/// Returns 100,000 of the 2 × 224 × 224 triangles of a square. A tenth of them cross the edge of
/// the picture or are outside it.
fn floor_mesh() -> Mesh {
    const SIDE: usize = 224;
    let at = |i: usize| (i as f64 / SIDE as f64 * 2.0 - 1.0) * 1.05;
    let point = |i: usize, j: usize| {
        let w = 4.0 + at(j);
        HPoint::new(at(i) * w, at(j) * w, 0.5 * w * coordinate(i * 7 + j), w)
    };
    let points = (0..=SIDE).flat_map(|j| (0..=SIDE).map(move |i| (i, j)));
    let points = points.map(|(i, j)| point(i, j)).collect();
    let index = |i: usize, j: usize| j * (SIDE + 1) + i;
    let cells = (0..SIDE).flat_map(|j| (0..SIDE).map(move |i| (i, j)));
    let halves = cells.flat_map(|(i, j)| {
        let [a, b, c, d] = [index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)];
        [[a, b, c], [a, c, d]]
    });
    let mut triangles: Vec<_> = halves.collect();
    triangles.truncate(POINT_COUNT);
    Mesh { points, triangles }
}

/// Returns triangles across the right or top border of the picture.
fn border_mesh() -> Mesh {
    let point = |i: usize| {
        let out = if i.is_multiple_of(3) { 1.5 } else { 0.8 };
        let along = coordinate(11 * i);
        let [x, y] = if (i / 3).is_multiple_of(2) { [out, along] } else { [along, out] };
        let w = 3.0 + coordinate(i);
        HPoint::new(x * w, y * w, 0.3 * w, w)
    };
    let points = (0..3 * POINT_COUNT).map(point).collect();
    Mesh { points, triangles: (0..POINT_COUNT).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect() }
}

/// Clips with the textbook Sutherland–Hodgman loop: against all six planes in turn, without
/// weights, and without regard to the direction of a shared edge.
fn clip_as_in_textbooks(triangle: [DVec4; 3], polygon: &mut Polygon) {
    polygon.corners[..3].copy_from_slice(&triangle);
    polygon.count = 3;
    for plane in PLANES {
        let whole = *polygon;
        polygon.count = 0;
        for i in 0..whole.count {
            let (start, end) = (whole.corners[i], whole.corners[(i + 1) % whole.count]);
            let (from, to) = (plane.dot(start), plane.dot(end));
            if from >= 0.0 {
                polygon.push(start);
            }
            if (from >= 0.0) != (to >= 0.0) {
                polygon.push(start + (end - start) * (from / (from - to)));
            }
        }
    }
}

#[derive(Clone, Copy)]
struct Polygon {
    corners: [DVec4; 9],
    count: usize,
}

impl Polygon {
    fn push(&mut self, corner: DVec4) {
        self.corners[self.count] = corner;
        self.count += 1;
    }
}

const PLANES: [DVec4; 6] = [
    DVec4::new(1.0, 0.0, 0.0, 1.0),
    DVec4::new(-1.0, 0.0, 0.0, 1.0),
    DVec4::new(0.0, 1.0, 0.0, 1.0),
    DVec4::new(0.0, -1.0, 0.0, 1.0),
    DVec4::new(0.0, 0.0, 1.0, 1.0),
    DVec4::new(0.0, 0.0, -1.0, 1.0),
];

pub fn mostly_visible() -> Vec<Variant> {
    variants(floor_mesh)
}

pub fn all_clipped() -> Vec<Variant> {
    variants(border_mesh)
}

fn variants(mesh: fn() -> Mesh) -> Vec<Variant> {
    let plain = mesh();
    let mut polygon = Polygon { corners: [DVec4::ZERO; 9], count: 0 };
    let by_textbook = Variant::new("plain loop of the textbook's six planes", move || {
        for &triangle in black_box(&plain.triangles) {
            clip_as_in_textbooks(plain.triangle_points(triangle).map(HPoint::raw), &mut polygon);
            black_box(&mut polygon);
        }
    });
    let each = mesh();
    let clip_each = Variant::new("clip_triangle for each, with weights", move || {
        for &triangle in black_box(&each.triangles) {
            black_box(clip_triangle(each.triangle_points(triangle), &Volume::CHAPTER).vertices());
        }
    });
    let sorted = mesh();
    let mut codes = vec![Outcode::INSIDE; sorted.points.len()];
    let by_outcodes =
        Variant::new("Volume::outcodes, then clip_triangle where needed", move || {
            black_box(Volume::CHAPTER.compute_outcodes(black_box(&sorted.points), &mut codes));
            for &triangle in &sorted.triangles {
                let of_corners = triangle.map(|i| codes[i]);
                let corners = sorted.triangle_points(triangle);
                if Outcode::trivially_accepts(&of_corners) {
                    black_box(corners);
                } else if Outcode::trivially_rejects(&of_corners).is_inside() {
                    black_box(clip_triangle(corners, &Volume::CHAPTER).vertices());
                }
            }
        });
    vec![by_textbook, clip_each, by_outcodes]
}
