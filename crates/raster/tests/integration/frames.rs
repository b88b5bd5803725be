//! Tests of filling and drawing frames repeatedly, with any number of threads and without new
//! allocations.

use homog::Point;
use raster::{CullMode, Fragment, Frame, Opacity, Samples, ScreenVertex, Surface};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

/// Counts shaded pixels and requests cancellation at the first one.
#[derive(Default)]
struct Impatient {
    shaded: AtomicU32,
    stop: Arc<AtomicBool>,
}

impl Surface for Impatient {
    fn passes_alpha_test(&self, _: &Fragment<'_>) -> bool {
        true
    }

    fn shade(&self, _: &Fragment<'_>) -> [f32; 4] {
        self.stop.store(true, Ordering::Relaxed);
        self.shaded.fetch_add(1, Ordering::Relaxed);
        [1.0; 4]
    }
}

#[test]
fn canceled_drawing_does_not_start_another_row_of_tiles() {
    let surface = Impatient::default();
    let frame = Frame::new(64, 1024, Samples::One).expect("a frame");
    let mut frame = frame.with_monitor(Arc::<AtomicBool>::clone(&surface.stop));
    let corners = [(0.0, 0.0), (64.0, 0.0), (0.0, 2048.0)]
        .map(|(x, y)| ScreenVertex::snap(Point::new(x, y, 0.5), 1.0).expect("on the grid"));
    frame.add_triangle(corners, 0, Opacity::Opaque);
    let mut pixels = vec![[0.0_f32; 4]; 64 * 1024];
    frame.draw(&surface, [0.0; 4], 1, &mut pixels, |color: [f32; 4]| color);
    let shaded = surface.shaded.into_inner();
    assert!(
        shaded > 0 && shaded <= 64 * 128,
        "{shaded} pixels are shaded, expected one row of tiles"
    );
}

const SIZE: (u32, u32) = (200, 150);

/// A half-transparent lattice that covers half of the pixels.
struct Lattice;

impl Surface for Lattice {
    fn passes_alpha_test(&self, fragment: &Fragment<'_>) -> bool {
        (fragment.x + fragment.y).is_multiple_of(2)
    }

    fn shade(&self, fragment: &Fragment<'_>) -> [f32; 4] {
        let [r, g, b] = fragment.weights.map(|weight| weight * 0.5);
        [r, g, b, 0.5]
    }
}

/// Returns a grid of `side` × `side` quads of varying depth over the whole picture.
fn net(side: u32) -> (Vec<Option<ScreenVertex>>, Vec<[u32; 3]>) {
    let place = |k: u32, length: u32| f64::from(k) / f64::from(side) * f64::from(length);
    let vertices = (0..=side).flat_map(|j| (0..=side).map(move |i| (i, j))).map(|(i, j)| {
        let depth = f64::from((i * 7 + j * 13) % 11) / 11.0;
        ScreenVertex::snap(Point::new(place(i, SIZE.0), place(j, SIZE.1), depth), 1.0 + depth)
    });
    let quads = (0..side).flat_map(|j| (0..side).map(move |i| j * (side + 1) + i));
    let triangles = quads.flat_map(|a| {
        let below = a + side + 1;
        [[a, a + 1, below], [a + 1, below, below + 1]]
    });
    (vertices.collect(), triangles.collect())
}

fn draw(frame: &Frame, threads: usize, pixels: &mut [[u32; 4]]) {
    frame.draw(&Lattice, [0.25; 4], threads, pixels, |color: [f32; 4]| color.map(f32::to_bits));
}

#[test]
fn threads_do_not_change_a_mesh_or_its_picture() {
    let (vertices, triangles) = net(180);
    for cull in [CullMode::Nothing, CullMode::Clockwise] {
        let mut first: Option<Vec<[u32; 4]>> = None;
        for threads in 1..=3 {
            let frame = Frame::new(SIZE.0, SIZE.1, Samples::Four).expect("a small frame");
            let mut frame = frame.with_threads(threads);
            // Add small meshes before and after a large mesh, which begins a separate chunk.
            frame.add_mesh(&vertices, &triangles[..100], 70_000, Opacity::Opaque, cull);
            frame.add_mesh(&vertices, &triangles, 0, Opacity::Opaque, cull);
            frame.add_mesh(&vertices, &triangles[100..300], 80_000, Opacity::Translucent, cull);
            let mut pixels = vec![[0; 4]; (SIZE.0 * SIZE.1) as usize];
            draw(&frame, threads, &mut pixels);
            assert!(*first.get_or_insert_with(|| pixels.clone()) == pixels, "{threads} threads");
        }
    }
}

#[test]
fn redrawing_a_frame_allocates_nothing() {
    let (vertices, triangles) = net(40);
    let mut pixels = vec![[0; 4]; (SIZE.0 * SIZE.1) as usize];
    for samples in [Samples::One, Samples::Four] {
        let mut frame = Frame::new(SIZE.0, SIZE.1, samples).expect("a small frame");
        let mut fill_and_draw = || {
            frame.clear();
            for cover in [Opacity::Opaque, Opacity::Masked, Opacity::Translucent] {
                frame.add_mesh(&vertices, &triangles, 0, cover, CullMode::Nothing);
            }
            draw(&frame, 1, &mut pixels);
        };
        let first = allocation_counter::measure(&mut fill_and_draw);
        assert!(first.count_total > 0, "the first drawing should allocate");
        let second = allocation_counter::measure(&mut fill_and_draw);
        assert_eq!(second.count_total, 0, "{samples:?}");
    }
}
