//! Compares front fragments and overdraw with frames of one primitive each.

use homog::Point;
use raster::{Fragment, Frame, Opacity, Samples, ScreenVertex, Surface};

const SIZE: [u32; 2] = [150, 100];

/// A surface with holes.
struct Holed;

impl Surface for Holed {
    fn passes_alpha_test(&self, fragment: &Fragment<'_>) -> bool {
        (fragment.x / 3 + fragment.y / 5).is_multiple_of(2)
    }
    fn shade(&self, _: &Fragment<'_>) -> [f32; 4] {
        [0.0; 4]
    }
}

/// Returns many intersecting triangles with a random depth at each corner.
fn triangles() -> Vec<[ScreenVertex; 3]> {
    let mut state = 12_345_u32;
    let mut random = |most: f64| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state >> 8) / f64::from(1 << 24) * most
    };
    let mut vertex = || {
        let place = Point::new(random(150.0), random(100.0), random(1.0));
        ScreenVertex::snap(place, 1.0 + random(3.0)).expect("a vertex in the picture")
    };
    (0..60).map(|_| [vertex(), vertex(), vertex()]).collect()
}

fn frame(primitives: &[([ScreenVertex; 3], u32, Opacity)]) -> Frame {
    let mut frame = Frame::new(SIZE[0], SIZE[1], Samples::One).expect("a small frame");
    for (corners, id, cover) in primitives {
        frame.add_triangle(*corners, *id, *cover);
    }
    frame
}

fn cover_of(id: u32) -> Opacity {
    [Opacity::Opaque, Opacity::Masked, Opacity::Translucent][id as usize % 3]
}

/// Returns, for each pixel, the primitives that cover its center and their depths, found by drawing
/// each separately.
fn covering() -> Vec<Vec<(u32, f32)>> {
    let mut all = vec![Vec::new(); (SIZE[0] * SIZE[1]) as usize];
    for (id, corners) in (0..).zip(triangles()) {
        let seen = frame(&[(corners, id, Opacity::Opaque)]).visibility_buffer();
        for (at, pixel) in all.iter_mut().enumerate().filter(|(at, _)| seen.ids[*at].is_some()) {
            let (x, y) = (at as u32 % SIZE[0], at as u32 / SIZE[0]);
            let is_there = cover_of(id) != Opacity::Masked || (x / 3 + y / 5).is_multiple_of(2);
            if is_there {
                pixel.push((id, seen.depth[at]));
            }
        }
    }
    all
}

#[test]
fn front_fragments_are_the_nearest_for_any_number_of_threads() {
    let given: Vec<_> = (0..).zip(triangles()).map(|(id, c)| (c, id, cover_of(id))).collect();
    let frame = frame(&given);
    for threads in 1..=3 {
        let mut found = vec![None; (SIZE[0] * SIZE[1]) as usize];
        frame.map_front_fragments(&Holed, threads, &mut found, |fragment| {
            let sum: f32 = fragment.weights.iter().sum();
            assert!((sum - 1.0).abs() < 1e-5, "{:?}", fragment.weights);
            Some(fragment.id)
        });
        let mut ids = vec![u32::MAX; found.len()];
        frame.write_front_ids(&Holed, threads, &mut ids);
        let missing = |id: &u32| (*id != u32::MAX).then_some(*id);
        assert!(ids.iter().map(missing).eq(found.iter().copied()), "{threads} threads");
        for (at, (pixel, found)) in covering().iter().zip(&found).enumerate() {
            let nearest = pixel.iter().max_by(|(_, a), (_, b)| a.total_cmp(b));
            assert_eq!(nearest.map(|(id, _)| *id), *found, "pixel {at}: {pixel:?}");
        }
    }
}

#[test]
fn overdraw_counts_hidden_layers() {
    let translucent = |(id, corners)| (corners, id, Opacity::Translucent);
    let frame = frame(&(0..).zip(triangles()).map(translucent).collect::<Vec<_>>());
    /// Applies the holes only to masked primitives.
    struct Kept;
    impl Surface for Kept {
        fn passes_alpha_test(&self, fragment: &Fragment<'_>) -> bool {
            cover_of(fragment.id) != Opacity::Masked || Holed.passes_alpha_test(fragment)
        }
        fn shade(&self, _: &Fragment<'_>) -> [f32; 4] {
            [0.0; 4]
        }
    }
    let mut counts = vec![0; (SIZE[0] * SIZE[1]) as usize];
    frame.count_overdraw(&Kept, 2, &mut counts);
    let due: Vec<u32> = covering().iter().map(|pixel| pixel.len() as u32).collect();
    assert!(due.iter().any(|count| *count > 8), "the triangles overlap too little");
    assert_eq!(counts, due);
}
