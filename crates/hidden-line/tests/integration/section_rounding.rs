//! Section planes through vertices that rounding has moved off the plane: the drawing is that of
//! the exact vertices, without lines across flat walls.

use super::stage::*;
use hidden_line::EdgeClass::{Hatching, Section};
use homog::{Normal, Plane, Point, World};
use model::Primitive;
use proptest::prelude::*;
use std::f64::consts::TAU;

/// A tube around the y axis, or a prism if it has no bore.
#[derive(Clone, Debug)]
struct Tube {
    /// A multiple of 4, so that two edges of each wall are in the plane x = 0.
    sides: usize,
    radius: f64,
    /// The radius of the bore, or 0.
    bore: f64,
    /// The heights of the rings of vertices.
    heights: Vec<f32>,
}

impl Tube {
    /// Returns the mesh. `offsets` moves the vertices in the plane x = 0 along x, one after another.
    fn mesh(&self, offsets: &[f32]) -> Primitive {
        let mut positions: Vec<[f32; 3]> = Vec::new();
        let radii = [self.radius, self.bore];
        for (radius, height) in
            radii.iter().flat_map(|radius| self.heights.iter().map(move |height| (radius, height)))
        {
            positions.extend((0..self.sides).map(|side| {
                let (sine, cosine) = libm::sincos(TAU * side as f64 / self.sides as f64);
                let is_on_plane = side * 4 == self.sides || side * 4 == self.sides * 3;
                let x = if is_on_plane { 0.0 } else { (radius * cosine) as f32 };
                [x, *height, (-radius * sine) as f32]
            }));
        }
        let mut moved = offsets.iter().cycle();
        for position in positions.iter_mut().filter(|position| position[0] == 0.0) {
            position[0] = moved.next().copied().unwrap_or_default();
        }
        triangle_mesh(&positions, &self.indices())
    }

    fn indices(&self) -> Vec<u32> {
        let (n, rings) = (self.sides, self.heights.len());
        // A ring without a radius is one vertex.
        let is_solid = self.bore == 0.0;
        let vertex = |ring: usize, side: usize| {
            (ring * n + if is_solid && ring >= rings { 0 } else { side % n }) as u32
        };
        let mut indices = Vec::new();
        let mut quad = |[a, b, c, d]: [u32; 4]| indices.extend([a, b, c, a, c, d]);
        for side in 0..n {
            for ring in 0..rings - 1 {
                let wall = |ring: usize| {
                    [(ring, side), (ring, side + 1), (ring + 1, side + 1), (ring + 1, side)]
                        .map(|(ring, side)| vertex(ring, side))
                };
                quad(wall(ring));
                let [a, b, c, d] = wall(rings + ring);
                quad([a, d, c, b]);
            }
            let (low, high) = ([0, rings], [rings - 1, 2 * rings - 1]);
            let end = |[outer, inner]: [usize; 2]| {
                [(outer, side), (inner, side), (inner, side + 1), (outer, side + 1)]
                    .map(|(ring, side)| vertex(ring, side))
            };
            quad(end(low));
            let [a, b, c, d] = end(high);
            quad([a, d, c, b]);
        }
        indices
    }
}

fn any_tube() -> impl Strategy<Value = Tube> {
    let bore = prop_oneof![Just(0.0), 0.2..0.9];
    (1_usize..8, 0.5..2.0, bore, prop::collection::vec(0.1_f32..1.0, 1..3)).prop_map(
        |(quarter, radius, bore, steps)| {
            let mut heights = vec![-1.0];
            heights.extend(steps.iter().scan(-1.0, |height, step| {
                *height += step;
                Some(*height)
            }));
            Tube { sides: 4 * quarter, radius, bore: bore * radius, heights }
        },
    )
}

/// Returns the total length of the visible lines except for hatching, and of the section's outline,
/// in pixels.
fn drawn_lengths(mesh: Primitive, x: f64) -> [f64; 2] {
    let plane: Plane<World> = Plane::through(Point::new(x, 0.0, 0.0), Normal::new(-1.0, 0.0, 0.0));
    let mut scene = drawing_scene(build_model(vec![mesh]), oblique_view());
    scene.sections = vec![plane];
    let drawing = draw_scene_lines(&scene);
    assert!(drawing.warnings.is_empty(), "{:?}", drawing.warnings);
    let lines = || drawing.segments.iter().filter(|line| line.visible && line.class != Hatching);
    let length = |line: &hidden_line::EdgeSegment| line.ends[0].distance(line.ends[1]);
    let of_section = lines().filter(|line| line.class == Section);
    [lines().map(length).sum(), of_section.map(length).sum()]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn vertices_beside_the_plane_by_rounding_change_nothing(
        tube in any_tube(),
        offsets in prop::collection::vec(
            prop::sample::select(&[0.0_f32, 1e-15, -1e-15, -2.2e-15, 4.6e-15, 3e-13, -1e-12, 1e-12]),
            8..9,
        ),
    ) {
        let exact = drawn_lengths(tube.mesh(&[0.0]), 0.0);
        let moved = drawn_lengths(tube.mesh(&offsets), 0.0);
        for (exact, moved) in exact.into_iter().zip(moved) {
            prop_assert!((exact - moved).abs() < 1e-6, "{exact} and {moved}");
        }
        // Beside the plane, on the side that remains, the drawing is nearly the same. On the other
        // side, edges in the plane would remain and be drawn next to the outline of the cut.
        let beside = drawn_lengths(tube.mesh(&offsets), -1e-6);
        for (exact, beside) in exact.into_iter().zip(beside) {
            prop_assert!((exact - beside).abs() < 0.01, "{exact} and {beside}");
        }
    }
}
