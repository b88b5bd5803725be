//! Tests of drawing: samples, layers, masks and threads.

use homog::PixelRect;
use raster::{
    CullMode, Fragment, Frame, MAX_SIDE, Opacity, RasterError, Samples, ScreenVertex, SimdLevel,
    Surface,
};

fn vertex(x: f64, y: f64, depth: f64) -> ScreenVertex {
    ScreenVertex::snap(homog::Point::new(x, y, depth), 1.0).expect("within the grid")
}

/// Adds a rectangle as two triangles with the same id.
fn rectangle(frame: &mut Frame, [x0, y0, x1, y1]: [f64; 4], depth: f64, id: u32, cover: Opacity) {
    let [a, b] = [vertex(x0, y0, depth), vertex(x1, y0, depth)];
    let [c, d] = [vertex(x1, y1, depth), vertex(x0, y1, depth)];
    frame.add_triangle([a, b, c], id, cover);
    frame.add_triangle([a, c, d], id, cover);
}

/// A surface colored by id, with a mask that keeps every other column.
struct Colors(Vec<[f32; 4]>);

impl Surface for Colors {
    fn passes_alpha_test(&self, fragment: &Fragment<'_>) -> bool {
        fragment.x.is_multiple_of(2)
    }
    fn shade(&self, fragment: &Fragment<'_>) -> [f32; 4] {
        self.0[fragment.id as usize]
    }
}

fn draw(frame: &Frame, colors: &[[f32; 4]], background: [f32; 4], threads: usize) -> Vec<[f32; 4]> {
    let mut target = vec![[0.0; 4]; (frame.width() * frame.height()) as usize];
    frame.draw(&Colors(colors.to_vec()), background, threads, &mut target, |color| color);
    target
}

const RED: [f32; 4] = [1.0, 0.0, 0.0, 1.0];
const BLUE: [f32; 4] = [0.0, 0.0, 1.0, 1.0];
const CLEAR: [f32; 4] = [0.0; 4];

#[test]
fn a_pixel_is_the_mean_of_its_samples() {
    for samples in [Samples::One, Samples::Four, Samples::Eight, Samples::Sixteen] {
        let mut frame = Frame::new(3, 1, samples).expect("a small frame");
        rectangle(&mut frame, [0.0, 0.0, 1.5, 1.0], 0.5, 0, Opacity::Opaque);
        let alpha: Vec<f32> = draw(&frame, &[RED], CLEAR, 1).iter().map(|c| c[3]).collect();
        assert_eq!((alpha[0], alpha[2]), (1.0, 0.0), "{samples:?}");
        let half = if samples == Samples::One { 0.0 } else { 0.5 };
        assert!((alpha[1] - half).abs() <= 1.0 / 16.0, "{samples:?}: {}", alpha[1]);
    }
}

/// A surface colored by id; the first two ids form one smooth surface.
struct Continuous(Colors);

impl Surface for Continuous {
    fn passes_alpha_test(&self, _: &Fragment<'_>) -> bool {
        true
    }
    fn shade(&self, fragment: &Fragment<'_>) -> [f32; 4] {
        self.0.shade(fragment)
    }
    fn is_continuous(&self, first_id: u32, second_id: u32) -> bool {
        first_id.max(second_id) < 2
    }
}

#[test]
fn neighbors_in_one_surface_share_a_color_if_they_face_the_same_way() {
    let mut frame = Frame::new(3, 1, Samples::Four).expect("a small frame");
    rectangle(&mut frame, [0.0, 0.0, 0.5, 1.0], 0.5, 0, Opacity::Opaque);
    rectangle(&mut frame, [0.5, 0.0, 1.5, 1.0], 0.5, 1, Opacity::Opaque);
    rectangle(&mut frame, [1.5, 0.0, 2.5, 1.0], 0.5, 2, Opacity::Opaque);
    // On the right, the same surface seen from behind covers half of the last pixel.
    let [a, b] = [vertex(2.5, 0.0, 0.5), vertex(9.0, 0.0, 0.5)];
    let [c, d] = [vertex(9.0, 1.0, 0.5), vertex(2.5, 1.0, 0.5)];
    frame.add_triangle([a, c, b], 0, Opacity::Opaque);
    frame.add_triangle([a, d, c], 0, Opacity::Opaque);
    let colors = vec![RED, BLUE, BLUE];
    let mut target = [CLEAR; 3];
    frame.draw(&Continuous(Colors(colors)), CLEAR, 1, &mut target, |color| color);
    let half = [0.5, 0.0, 0.5, 1.0];
    // Red and blue are one surface in the first pixel but not in the others.
    assert!(target[0] == RED || target[0] == BLUE, "{target:?}");
    assert_eq!(target[1..], [BLUE, half], "{target:?}");
}

#[test]
fn the_background_never_shows_between_adjacent_triangles() {
    let mut frame = Frame::new(40, 40, Samples::Eight).expect("a small frame");
    let at = |i: i32, j: i32| {
        let wobble = f64::from((i * 7 + j * 13) % 5) * 0.37;
        vertex(f64::from(i) * 7.3 - 10.0 + wobble, f64::from(j) * 6.1 - 10.0 - wobble, 0.5)
    };
    for i in 0..10 {
        for j in 0..12 {
            frame.add_triangle([at(i, j), at(i + 1, j), at(i + 1, j + 1)], 0, Opacity::Opaque);
            frame.add_triangle([at(i, j), at(i + 1, j + 1), at(i, j + 1)], 0, Opacity::Opaque);
        }
    }
    assert!(draw(&frame, &[RED], [0.0, 1.0, 0.0, 1.0], 1).iter().all(|&color| color == RED));
}

#[test]
fn layers_are_blended_back_to_front_in_any_submission_order() {
    // Half-transparent red and blue, premultiplied, over white; the opaque rectangle hides the
    // layer behind it.
    let colors = [[0.5, 0.0, 0.0, 0.5], [0.0, 0.0, 0.5, 0.5], [0.0, 1.0, 0.0, 1.0]];
    let white = [1.0; 4];
    let mut pictures = Vec::new();
    for order in [[0, 1], [1, 0]] {
        for samples in [Samples::One, Samples::Four] {
            let mut frame = Frame::new(4, 4, samples).expect("a small frame");
            for id in order {
                let depth = if id == 0 { 0.25 } else { 0.75 };
                rectangle(&mut frame, [0.0, 0.0, 4.0, 4.0], depth, id, Opacity::Translucent);
            }
            rectangle(&mut frame, [0.0, 0.0, 2.0, 4.0], 0.5, 2, Opacity::Opaque);
            let picture = draw(&frame, &colors, white, 1);
            // Blue over red over white; blue over green where the rectangle hides the red.
            assert_eq!(picture[3], [0.5, 0.25, 0.75, 1.0]);
            assert_eq!(picture[0], [0.0, 0.5, 0.5, 1.0]);
            pictures.push(picture);
        }
    }
    assert!(pictures.iter().all(|picture| *picture == pictures[0]));
}

#[test]
fn masked_surfaces_hide_only_where_they_pass_the_alpha_test() {
    let mut frame = Frame::new(4, 1, Samples::One).expect("a small frame");
    rectangle(&mut frame, [0.0, 0.0, 4.0, 1.0], 0.75, 0, Opacity::Masked);
    rectangle(&mut frame, [0.0, 0.0, 4.0, 1.0], 0.5, 1, Opacity::Opaque);
    assert_eq!(draw(&frame, &[RED, BLUE], CLEAR, 1), [RED, BLUE, RED, BLUE]);
}

#[test]
fn threads_and_simd_levels_do_not_change_the_picture() {
    let mut frame = Frame::new(200, 333, Samples::Four).expect("a frame of several tiles");
    let colors = crowd(&mut frame);
    let once = draw(&frame, &colors, CLEAR, 1);
    for threads in [2, 3, 7, 100] {
        assert!(draw(&frame, &colors, CLEAR, threads) == once, "{threads} threads");
    }
    for instructions in SimdLevel::available() {
        let again = frame.clone().with_simd_level(instructions);
        assert!(draw(&again, &colors, CLEAR, 1) == once, "{instructions:?}");
        assert!(again.visibility_buffer() == frame.visibility_buffer(), "{instructions:?}");
    }
}

#[test]
fn regions_match_the_full_picture() {
    let mut whole = Frame::new(200, 333, Samples::Four).expect("a frame of several tiles");
    let colors = crowd(&mut whole);
    let picture = draw(&whole, &colors, CLEAR, 1);
    let depth = whole.visibility_buffer().depth;
    for ([x, y], [width, height]) in
        [([0, 0], [64, 64]), ([1, 1], [199, 332]), ([63, 127], [2, 2]), ([71, 200], [100, 7])]
    {
        let mut part =
            Frame::for_region(PixelRect { x, y, width, height }, Samples::Four).expect("a part");
        crowd(&mut part);
        let shown = draw(&part, &colors, CLEAR, 3);
        let near = part.visibility_buffer().depth;
        for (row, column) in (0..height).flat_map(|row| (0..width).map(move |c| (row, c))) {
            let there = ((y + row) * 200 + x + column) as usize;
            let here = (row * width + column) as usize;
            assert_eq!(shown[here], picture[there], "({column}, {row}) of {width} x {height}");
            assert_eq!(near[here], depth[there], "({column}, {row}) of {width} x {height}");
        }
    }
}

/// Adds two hundred triangles, a third of them translucent and a third masked, and returns their
/// colors.
fn crowd(frame: &mut Frame) -> Vec<[f32; 4]> {
    let colors: Vec<[f32; 4]> =
        (0..200_u32).map(|n| [n as f32 / 200.0, 0.3, 1.0 - n as f32 / 300.0, 0.8]).collect();
    for id in 0..200_u32 {
        let f = f64::from(id);
        let corner = |k: f64| {
            vertex(
                (f * 37.0 + k * 91.0) % 260.0 - 30.0,
                (f * 59.0 + k * 133.0) % 400.0 - 30.0,
                ((f * 17.0 + k * 29.0) % 100.0) / 100.0,
            )
        };
        let cover = [Opacity::Translucent, Opacity::Opaque, Opacity::Masked][id as usize % 3];
        frame.add_triangle([corner(0.0), corner(1.0), corner(2.0)], id, cover);
    }
    colors
}

#[test]
fn sizes_out_of_range_are_rejected() {
    for (width, height) in [(0, 5), (5, 0), (MAX_SIDE + 1, 1), (1, u32::MAX)] {
        let error = Frame::new(width, height, Samples::One).expect_err("an invalid size");
        assert_eq!(error, RasterError::Size { x: 0, y: 0, width, height });
        assert!(error.to_string().contains(&format!("{width} x {height}")), "{error}");
    }
    let beyond = PixelRect { x: MAX_SIDE, y: 3, width: 1, height: 1 };
    let error = Frame::for_region(beyond, Samples::One).expect_err("an invalid size");
    assert_eq!(error, RasterError::Size { x: MAX_SIDE, y: 3, width: 1, height: 1 });
}

#[test]
fn points_without_a_screen_vertex_are_not_drawn() {
    let wrong = [
        ScreenVertex::new(i32::MIN, 0, 0.5, 1.0),
        ScreenVertex::new(0, i32::MAX, 0.5, 1.0),
        ScreenVertex::new(0, 0, f32::NAN, 1.0),
        ScreenVertex::new(0, 0, f32::INFINITY, 1.0),
        ScreenVertex::new(0, 0, 2e6, 1.0),
        ScreenVertex::new(0, 0, 0.5, f32::NAN),
        ScreenVertex::new(0, 0, 0.5, f32::INFINITY),
        ScreenVertex::new(0, 0, 0.5, 0.0),
        ScreenVertex::new(0, 0, 0.5, -1.0),
    ];
    assert_eq!(wrong, [None; 9]);
    let mut frame = Frame::new(8, 8, Samples::Four).expect("a small frame");
    let good = vertex(2.0, 2.0, 0.5);
    let vertices = [Some(good), None, Some(vertex(8.0, 0.0, 0.5))];
    let triangles = [[0, 2, 1], [0, 2, 7], [u32::MAX, 0, 2]];
    frame.add_mesh(&vertices, &triangles, 0, Opacity::Opaque, CullMode::Nothing);
    assert!(draw(&frame, &[RED; 7], CLEAR, 1).iter().all(|&color| color == CLEAR));
    // A line of any width is drawn within the grid.
    for width in [1e12, f64::INFINITY, f64::NAN, -3.0] {
        frame.add_line([good, vertex(5.0, 3.0, 0.5)], width, 0, Opacity::Opaque);
    }
    let _ = draw(&frame, &[RED; 7], CLEAR, 1);
}

#[test]
fn meshes_are_culled_by_winding() {
    let corners = [vertex(0.0, 0.0, 0.5), vertex(8.0, 0.0, 0.5), vertex(0.0, 8.0, 0.5)].map(Some);
    let seen = |cull: CullMode| {
        let mut frame = Frame::new(8, 8, Samples::One).expect("a small frame");
        frame.add_mesh(&corners, &[[0, 1, 2], [0, 2, 1]], 5, Opacity::Opaque, cull);
        frame.visibility_buffer().ids[0]
    };
    assert_eq!([CullMode::Nothing, CullMode::CounterClockwise].map(seen), [Some(5); 2]);
    assert_eq!(seen(CullMode::Clockwise), Some(6));
}

/// Found by the fuzzer: 1/w times the area of a triangle may be too large for an `f32`, or it may
/// be 0.
#[test]
fn weights_are_finite_and_add_up_to_1_for_every_w() {
    let corners = [(0.25, 7.75), (7.5, 6.5), (3.0, 0.5)];
    let weights = |ws: [f64; 3]| {
        let mut frame = Frame::new(8, 8, Samples::One).expect("a small frame");
        let at = |k: usize| homog::Point::new(corners[k].0, corners[k].1, 0.5);
        let vertices = [0, 1, 2].map(|k| ScreenVertex::snap(at(k), ws[k]).expect("drawable"));
        frame.add_triangle(vertices, 0, Opacity::Opaque);
        let mut all = Vec::new();
        frame.for_each_fragment(|seen| {
            all.push([seen.weights, seen.weights_dx(), seen.weights_dy()]);
        });
        all
    };
    let usual = weights([1.0; 3]);
    assert!(usual.len() > 16);
    let sizes = [1e-38, 1e-30, 1e-12, 1.0, 1e12, 1e30, 1e44];
    for ws in sizes.into_iter().flat_map(|a| sizes.map(|b| sizes.map(|c| [a, b, c]))).flatten() {
        let all = weights(ws);
        assert!(all.as_flattened().as_flattened().iter().all(|x| x.is_finite()), "{ws:?}");
        for [[a, b, c], ..] in &all {
            let whole = (a + b + c - 1.0).abs() < 1e-5 && a.min(*b).min(*c) >= 0.0;
            assert!(whole, "{ws:?}: {a} {b} {c}");
        }
        let alike = ws[0] == ws[1] && ws[1] == ws[2];
        let mut pairs = all.iter().zip(&usual);
        let near = |(a, b): (&[[f32; 3]; 3], &[[f32; 3]; 3])| {
            let differences = a.as_flattened().iter().zip(b.as_flattened());
            differences.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max) < 1e-5
        };
        assert!(!alike || pairs.all(near), "{ws:?}");
    }
}

/// C2: lines hide only their own pixels, and triangles hide everything behind them.
#[test]
fn c2_wireframes_hide_only_their_own_pixels_and_triangles_hide_more() {
    let line = |frame: &mut Frame, ends: [[f64; 2]; 2], depth: f64, id: u32| {
        let ends = ends.map(|[x, y]| vertex(x, y, depth));
        frame.add_line(ends, 1.0, id, Opacity::Opaque);
    };
    let pixels_of = |frame: &Frame, id: u32| -> Vec<usize> {
        let ids = frame.visibility_buffer().ids;
        (0..ids.len()).filter(|at| ids[*at] == Some(id)).collect()
    };
    let far_line = [[2.0, 8.5], [14.0, 8.5]];
    let mut alone = Frame::new(16, 16, Samples::One).expect("a small frame");
    line(&mut alone, far_line, 0.2, 0);
    let whole = pixels_of(&alone, 0);
    assert_eq!(whole, (2..14).map(|x| 8 * 16 + x).collect::<Vec<usize>>());
    // The outline of a square in front of the line hides the two pixels where they cross.
    let corners = [[4.5, 4.5], [11.5, 4.5], [11.5, 11.5], [4.5, 11.5]];
    let mut wireframe = alone.clone();
    for side in 0..4 {
        line(&mut wireframe, [corners[side], corners[(side + 1) % 4]], 0.8, 1);
    }
    let crossed = [8 * 16 + 4, 8 * 16 + 11];
    let left: Vec<usize> = whole.iter().copied().filter(|at| !crossed.contains(at)).collect();
    assert_eq!(pixels_of(&wireframe, 0), left);
    assert!(crossed.iter().all(|at| pixels_of(&wireframe, 1).contains(at)));
    // The filled square hides every pixel of the line whose center is in [4.5, 11.5).
    let mut solid = alone.clone();
    rectangle(&mut solid, [4.5, 4.5, 11.5, 11.5], 0.8, 2, Opacity::Opaque);
    let outside = |at: &usize| !(4..11).contains(&(at % 16));
    let left: Vec<usize> = whole.into_iter().filter(outside).collect();
    assert_eq!(pixels_of(&solid, 0), left);
}
