//! 10,000 random matrices of every kind that `alberti matrix` builds; recognition must return their
//! parameters.

use super::formulas::{self, Rows};
use super::table::{Expected, is_expected};
use glam::DMat4;
use homog::Vector;
use projection::{
    ApexMovedFrustum, Convention, Fov, Frustum, NPoint, Oblique, Orthographic, Perspective, chapter,
};
use recognition::{MatrixMeaning, recognize};

/// SplitMix64 (Steele, Lea and Flood 2014), which gives the same numbers on every machine.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    /// Returns a number in an interval, either with three digits, as people write numbers, or with
    /// all digits.
    fn number(&mut self, low: f64, high: f64) -> f64 {
        let part = (self.bits() >> 11) as f64 / (1_u64 << 53) as f64;
        let x = low + (high - low) * part;
        if self.bits() % 2 == 0 { x } else { format!("{x:.2e}").parse().expect("a number") }
    }

    pub(crate) fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[(self.bits() % from.len() as u64) as usize]
    }

    fn near_far(&mut self) -> [f64; 2] {
        let near = self.number(0.05, 5.0);
        [near, near * self.number(2.0, 900.0)]
    }

    fn window(&mut self) -> [f64; 4] {
        let [l, b] = [self.number(-4.0, 2.0), self.number(-4.0, 2.0)];
        let [width, height] = [self.number(0.5, 6.0), self.number(0.5, 6.0)];
        [l, l + width, b, b + height]
    }
}

/// The conventions that `--convention` accepts, plain and reversed.
const CONVENTIONS: [Convention; 8] = [
    Convention::OPENGL,
    Convention::CHAPTER,
    Convention::VULKAN,
    Convention::DIRECT3D,
    Convention::WEBGPU,
    Convention::VULKAN.reversed(),
    Convention::DIRECT3D.reversed(),
    Convention::WEBGPU.reversed(),
];

type Built = (DMat4, Expected);

fn perspective(random: &mut Random) -> Option<Built> {
    let (c, [n, f]) = (random.pick(&CONVENTIONS), random.near_far());
    let (fovy, aspect) = (random.number(5.0, 150.0), random.number(0.4, 3.0));
    let lens = Perspective::new(Fov::vertical_degrees(fovy), aspect, n, f).ok()?;
    Some((lens.view_to_clip(c).raw(), Expected::Lens(c, fovy, aspect, n, f)))
}

fn frustum(random: &mut Random) -> Option<Built> {
    let (c, [n, f], w) = (random.pick(&CONVENTIONS), random.near_far(), random.window());
    let frustum = Frustum::new(w[0], w[1], w[2], w[3], n, f).ok()?;
    Some((frustum.view_to_clip(c).raw(), Expected::Frustum(c, w, n, f)))
}

fn ortho(random: &mut Random) -> Option<Built> {
    let (c, [n, f], w) = (random.pick(&CONVENTIONS), random.near_far(), random.window());
    let volume = Orthographic::new(w[0], w[1], w[2], w[3], n, f).ok()?;
    Some((volume.view_to_clip(c).raw(), Expected::Box(c, w, n, f)))
}

fn moved(random: &mut Random) -> Option<Built> {
    let ([n, f], w) = (random.near_far(), random.window());
    let frustum = ApexMovedFrustum::new(w[0], w[1], w[2], w[3], n, f).ok()?;
    Some((frustum.view_to_clip(Convention::OPENGL).raw(), Expected::Moved(w, n, f)))
}

fn textbook(random: &mut Random) -> Option<Built> {
    let (n, f) = (-random.number(0.1, 5.0), -random.number(5.5, 90.0));
    match random.pick(&[0, 1, 2]) {
        0 => Some((chapter::p(n, f).ok()?.raw(), Expected::P(n, f))),
        1 => Some((chapter::p_inverse(n, f).ok()?.raw(), Expected::PInverse(n, f))),
        _ => Some((chapter::p_inverse_scaled(n, f).ok()?.raw(), Expected::PInverse(n, f))),
    }
}

fn oblique(random: &mut Random) -> Option<Built> {
    let (length, phi) = (random.number(0.1, 2.0), random.number(-179.0, 179.0));
    let projection = Oblique::new(length, phi.to_radians()).ok()?;
    let kept = random.pick(&[true, false]);
    let matrix = if kept { projection.depth_preserving() } else { projection.onto_plane() }.raw();
    Some((matrix, Expected::Oblique(length, phi, 0.0, kept)))
}

fn prism(random: &mut Random) -> Option<Built> {
    let (c, [n, f], w) = (random.pick(&CONVENTIONS), random.near_far(), random.window());
    let (length, phi) = (random.number(0.1, 2.0), random.number(-179.0, 179.0));
    let volume = Orthographic::new(w[0], w[1], w[2], w[3], n, f).ok()?;
    let projection = Oblique::new(length, phi.to_radians()).ok()?;
    let matrix = projection.view_to_clip(volume, c).raw();
    Some((matrix, Expected::Prism(c, [length, phi], w, n, f)))
}

/// Builds a map from a window to a viewport.
fn windowing(random: &mut Random) -> Option<Built> {
    let [from, to] = [random.window(), random.window()];
    let scale = [0, 2].map(|i| (to[i + 1] - to[i]) / (from[i + 1] - from[i]));
    let offset = [0, 1].map(|i| to[2 * i] - scale[i] * from[2 * i]);
    let (scale, offset) = ([scale[0], scale[1], 1.0], [offset[0], offset[1], 0.0]);
    let matrix = formulas::product(formulas::translation(offset), formulas::scale(scale));
    Some((matrix_of(matrix), Expected::Windowing(scale, offset)))
}

fn n_point(random: &mut Random) -> Option<Built> {
    let terms = [0; 3].map(|_| random.number(-0.9, 0.9));
    let projection = NPoint::new(terms[0], terms[1], terms[2]).ok()?;
    let flat = random.pick(&[true, false]);
    let matrix = if flat { projection.onto_plane() } else { projection.depth_preserving() };
    Some((matrix.raw(), Expected::NPoint(terms, flat)))
}

fn look_at(random: &mut Random) -> Option<Built> {
    let [eye, target] = [0, 1].map(|_| [0; 3].map(|_| random.number(-9.0, 9.0)));
    let gaze = [0, 1, 2].map(|i| target[i] - eye[i]);
    let matrix = formulas::m_cam(eye, gaze, [0.0, 1.0, 0.0]);
    let gaze = formulas::unit(gaze);
    Some((matrix_of(matrix), Expected::Camera(eye, gaze)))
}

fn viewport(random: &mut Random) -> Option<Built> {
    let size = [0; 2].map(|_| (random.bits() % 3998 + 2) as f64);
    let y_down = random.pick(&[true, false]);
    let matrix = formulas::m_vp(size[0], size[1], y_down);
    Some((matrix_of(matrix), Expected::Viewport([0.0, 0.0, size[0], size[1]], y_down, true)))
}

fn transform(random: &mut Random) -> Option<Built> {
    let by = [0; 3].map(|_| random.number(-9.0, 9.0));
    let vector = Vector::<homog::View>::new(by[0], by[1], by[2]);
    let degrees = random.number(1.0, 179.0);
    match random.pick(&[0, 1]) {
        0 => Some((matrix_of(formulas::translation(by)), Expected::Translation(by))),
        _ => {
            let turn =
                homog::Affine::<homog::View, homog::View>::rotation(vector, degrees.to_radians())?;
            Some((turn.raw(), Expected::Rotation(formulas::unit(by), degrees)))
        }
    }
}

fn matrix_of(rows: Rows) -> DMat4 {
    DMat4::from_cols_array_2d(&rows).transpose()
}

/// The builders for every kind of matrix with parameters.
const BUILDERS: [fn(&mut Random) -> Option<Built>; 12] = [
    perspective,
    frustum,
    ortho,
    moved,
    textbook,
    oblique,
    prism,
    windowing,
    n_point,
    look_at,
    viewport,
    transform,
];

#[test]
fn ten_thousand_random_matrices_are_read_back() {
    let mut random = Random(17);
    let (mut first, mut equal, mut lost, mut called) = (0, 0, Vec::new(), Vec::new());
    for count in 0..10_000 {
        let (matrix, expected) = BUILDERS[count % BUILDERS.len()](&mut random).expect("valid");
        let found = recognize(matrix.transpose().to_cols_array_2d());
        let right = |meaning: &MatrixMeaning| is_expected(meaning, &expected, 1e-6);
        if right(&found.first().meaning) {
            first += 1;
        } else if found.readings.iter().take(6).any(|reading| right(&reading.meaning)) {
            equal += 1;
        } else {
            lost.push(format!("{expected:?} is read as {:?}", found.first().meaning));
        }
        if let Some(misprint) = found.misprint() {
            called.push(format!("{expected:?} is reported as {:?}", misprint.misprint));
        }
    }
    println!("the expected reading is first {first} times and second to sixth {equal} times");
    assert_eq!((lost.first(), called.first()), (None, None), "{} and {}", lost.len(), called.len());
    assert!(first > 9_500, "the expected reading is first {first} times and later {equal} times");
}

#[test]
fn rounded_matrices_are_not_reported_as_misprints() {
    let mut random = Random(4);
    let mut called = Vec::new();
    for count in 0..10_000 {
        let (matrix, expected) = BUILDERS[count % BUILDERS.len()](&mut random).expect("valid");
        let rows = matrix.transpose().to_cols_array_2d();
        for printed in
            [formulas::rounded(rows, 3), formulas::rounded(rows, 4), formulas::single(rows)]
        {
            let found = recognize(printed);
            if let Some(misprint) = found.misprint() {
                called.push(format!(
                    "{expected:?} is reported as {:?}: {printed:?}",
                    misprint.misprint
                ));
            }
        }
    }
    assert!(
        called.is_empty(),
        "{} of 30,000, such as\n{}",
        called.len(),
        called[..called.len().min(9)].join("\n")
    );
}
