//! Tests of depth functions, depth buffers, second passes, clipped meshes and monitors.

use homog::{ClipRange, Point, Projective, View};
use proptest::prelude::*;
use raster::{
    CullMode, DepthBuffer, DepthCompare, Frame, Monitor, Opacity, RasterError, Samples,
    ScreenProjection, ScreenVertex, SourceMesh, surface_fn,
};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use viewport::Viewport;

const SIDE: u32 = 80;

type Corners = [[f64; 3]; 3];

fn filled(frame: Frame, triangles: &[Corners], first_id: u32) -> Frame {
    let mut frame = frame;
    for (id, corners) in (first_id..).zip(triangles) {
        let vertex = |[x, y, z]: [f64; 3]| ScreenVertex::snap(Point::new(x, y, z), 1.0);
        let corners = corners.map(|corner| vertex(corner).expect("on the grid"));
        frame.add_triangle(corners, id, Opacity::Opaque);
    }
    frame
}

fn frame(samples: Samples) -> Frame {
    Frame::new(SIDE, SIDE, samples).expect("a frame")
}

/// Returns the ids that a depth function should leave, found by drawing each triangle separately.
fn expected_ids(triangles: &[Corners], compare: DepthCompare) -> Vec<Option<u32>> {
    let empty = match compare {
        DepthCompare::Less | DepthCompare::LessEqual => f32::INFINITY,
        _ => f32::NEG_INFINITY,
    };
    let mut there = vec![(empty, None); (SIDE * SIDE) as usize];
    for (id, corners) in (0..).zip(triangles) {
        let alone = filled(frame(Samples::One), &[*corners], id).visibility_buffer();
        for (place, (depth, id)) in there.iter_mut().zip(alone.depth.iter().zip(alone.ids)) {
            let passes = match compare {
                DepthCompare::Greater => *depth > place.0,
                DepthCompare::GreaterEqual => *depth >= place.0,
                DepthCompare::Less => *depth < place.0,
                DepthCompare::LessEqual => *depth <= place.0,
                DepthCompare::Equal => *depth == place.0,
                _ => true,
            };
            if id.is_some() && passes {
                *place = (*depth, id);
            }
        }
    }
    there.into_iter().map(|(_, id)| id).collect()
}

fn corners() -> impl Strategy<Value = Corners> {
    // Use only a few depths, so that some are equal.
    let corner = (-20.0..100.0_f64, -20.0..100.0_f64, 0..4_u32);
    let depth = prop::bool::ANY;
    ([corner.clone(), corner.clone(), corner], depth).prop_map(|(corners, is_level)| {
        let level = f64::from(corners[0].2);
        corners.map(|(x, y, z)| [x, y, 0.25 * if is_level { level } else { f64::from(z) }])
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn depth_functions_leave_the_expected_ids(triangles in prop::collection::vec(corners(), 1..12)) {
        for compare in [
            DepthCompare::Greater,
            DepthCompare::GreaterEqual,
            DepthCompare::Less,
            DepthCompare::LessEqual,
            DepthCompare::Equal,
            DepthCompare::Always,
        ] {
            let drawn = frame(Samples::One).with_depth_compare(compare);
            let ids = filled(drawn, &triangles, 0).visibility_buffer().ids;
            prop_assert_eq!(ids, expected_ids(&triangles, compare), "{:?}", compare);
        }
    }

    #[test]
    fn two_passes_match_one_pass(
        first in prop::collection::vec(corners(), 1..8),
        second in prop::collection::vec(corners(), 1..8),
        samples in prop::sample::select(vec![Samples::One, Samples::Four, Samples::Sixteen]),
        less in prop::bool::ANY,
    ) {
        let compare = if less { DepthCompare::Less } else { DepthCompare::Greater };
        let empty = || frame(samples).with_depth_compare(compare);
        let surface = surface_fn(|fragment| [fragment.id as f32, 1.0, 0.0, 1.0]);
        let both: Vec<Corners> = first.iter().chain(&second).copied().collect();
        let whole = filled(empty(), &both, 1);
        let depths = filled(empty(), &first, 1).depth_buffer(&surface, 2);
        let over = empty().with_depth_buffer(Arc::new(depths)).expect("it fits");
        let over = filled(over, &second, 1 + first.len() as u32);
        prop_assert_eq!(over.depth_buffer(&surface, 1), whole.depth_buffer(&surface, 3));

        // Drawing the second pass over the first gives the same picture as one pass, if no pixel is
        // divided between them.
        if samples == Samples::One {
            let sky = [0.0, 0.0, 1.0, 1.0];
            let draw = |frame: &Frame| {
                let mut pixels = vec![[0.0; 4]; (SIDE * SIDE) as usize];
                frame.draw(&surface, sky, 2, &mut pixels, |color: [f32; 4]| color);
                pixels
            };
            let mut passes = draw(&filled(empty(), &first, 1));
            over.draw_over(&surface, 2, &mut passes);
            prop_assert_eq!(passes, draw(&whole));
        }
    }

    /// Runs a depth-only pass, then a pass that shades fragments at exactly that depth.
    #[test]
    fn a_depth_pre_pass_hides_nothing(triangles in prop::collection::vec(corners(), 1..10)) {
        let surface = surface_fn(|_| [1.0; 4]);
        let once = filled(frame(Samples::One), &triangles, 0);
        let depths = Arc::new(once.depth_buffer(&surface, 1));
        let equal = frame(Samples::One).with_depth_compare(DepthCompare::Equal);
        let again = filled(equal.with_depth_buffer(depths).expect("it fits"), &triangles, 0);
        let (once, again) = (once.visibility_buffer(), again.visibility_buffer());
        prop_assert_eq!(once.depth, again.depth);
        prop_assert!(once.ids.iter().zip(again.ids).all(|(a, b)| a.is_some() == b.is_some()));
    }
}

#[test]
fn depth_buffers_of_another_size_are_rejected() {
    let refused = DepthBuffer::from_depths(4, 4, vec![0.0; 15]);
    assert_eq!(refused, Err(RasterError::DepthCount { expected: 16, found: 15 }));
    let small = Arc::new(DepthBuffer::from_depths(4, 4, vec![0.5; 16]).expect("16 depths"));
    assert!(frame(Samples::One).with_depth_buffer(Arc::clone(&small)).is_err());
    let frame = Frame::new(4, 4, Samples::Four).expect("a frame");
    let error = frame.with_depth_buffer(small).err();
    assert_eq!(error, Some(RasterError::DepthCount { expected: 64, found: 16 }));
}

/// Returns a perspective projection with a 90-degree field of view, near 0.5, far 100, and w > 0 in
/// front of the eye (PE-3).
fn lens() -> Projective<View, homog::Clip> {
    let (near, far) = (-0.5, -100.0);
    Projective::from_rows([
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, -(near + far) / (near - far), 2.0 * far * near / (near - far)],
        [0.0, 0.0, -1.0, 0.0],
    ])
}

/// Regression test: a floor under the eye, cut by the near plane, covered no pixel (finding 6.4).
#[test]
fn a_floor_under_the_eye_covers_the_lower_half() {
    let positions = [[-500.0, -1.0, 9.0], [500.0, -1.0, 9.0], [0.0, -1.0, -99.0_f32]];
    let mesh = SourceMesh::new(&positions, &[[0, 1, 2]]).with_first_id(7);
    let screen = ScreenProjection::new(
        &Viewport::image_for(SIDE, SIDE, ClipRange::CHAPTER).expect("pixels"),
    );
    let mut floor = frame(Samples::One);
    floor.add_clipped_mesh(&screen, lens(), mesh);
    let buffer = floor.visibility_buffer();
    // The floor starts just below the horizon, 99 units ahead; the bottom row is 1 unit ahead.
    for (index, id) in (0..).zip(&buffer.ids) {
        let (x, row) = (index % SIDE, index / SIDE);
        let expected = row > SIDE / 2 && (row >= SIDE / 2 + 8 || x.abs_diff(SIDE / 2) < 20);
        if expected {
            assert_eq!(*id, Some(7), "pixel {x}, {row}");
        } else if row < SIDE / 2 {
            assert_eq!(*id, None, "pixel {x}, {row}");
        }
    }
    // Weights refer to the whole triangle: interpolated z matches the distance.
    floor.for_each_fragment(|fragment| {
        let z: f32 = fragment.interpolate([9.0, 9.0, -99.0_f32]);
        let below = (f64::from(fragment.y) + 0.5 - 40.0) / 40.0;
        assert!((f64::from(z) + 1.0 / below).abs() < 2e-3 / (below * below), "{z} at {below}");
    });
    // Seen from above, front faces are counterclockwise.
    for (cull, is_drawn) in [(CullMode::Clockwise, true), (CullMode::CounterClockwise, false)] {
        let mut floor = frame(Samples::One);
        floor.add_clipped_mesh(&screen, lens(), mesh.with_culling(cull));
        let covered = floor.visibility_buffer().ids.iter().any(Option::is_some);
        assert_eq!(covered, is_drawn, "{cull:?}");
    }
}

/// Invalid vertices are skipped without a panic.
#[test]
fn nonfinite_positions_are_skipped() {
    let screen = ScreenProjection::new(
        &Viewport::image_for(SIDE, SIDE, ClipRange::CHAPTER).expect("pixels"),
    );
    for odd in [f32::NAN, f32::INFINITY, f32::MAX] {
        let positions = [[-1.0, -1.0, -2.0], [1.0, -1.0, -2.0], [0.0, 1.0, -2.0], [odd, 0.0, -2.0]];
        let mut drawn = frame(Samples::One);
        let triangles = [[0, 1, 3], [0, 1, 2], [0, 1, 9]];
        let mesh = SourceMesh::new(&positions, &triangles);
        drawn.add_clipped_mesh(&screen, lens(), mesh);
        let ids = drawn.visibility_buffer().ids;
        assert!(ids.contains(&Some(1)), "{odd}");
        assert!(!ids.contains(&Some(2)), "triangle with a missing vertex");
        assert!(odd == f32::MAX || !ids.contains(&Some(0)), "{odd}");
    }
}

#[derive(Debug, Default)]
struct Progress(AtomicU64);

impl Monitor for Progress {
    fn report_progress(&self, done: u64, total: u64) {
        self.0.fetch_max(1000 * done / total, Ordering::Relaxed);
    }
}

#[test]
fn monitors_are_notified_at_the_end() {
    let progress = Arc::new(Progress::default());
    let monitor: Arc<dyn Monitor> = Arc::clone(&progress) as _;
    let drawn = Frame::new(64, 640, Samples::One).expect("a frame").with_monitor(monitor);
    let mut pixels = vec![[0.0_f32; 4]; 64 * 640];
    drawn.draw(&surface_fn(|_| [1.0; 4]), [0.0; 4], 2, &mut pixels, |color: [f32; 4]| color);
    assert_eq!(progress.0.load(Ordering::Relaxed), 1000);
}
