//! The difference between two pictures, as computed by the script `score.py` of the reference
//! pictures.
//!
//! Edges may differ by half a pixel, so each pixel is compared with the closest color in its 3 × 3
//! neighborhood in the other picture, and vice versa.

use crate::references::picture::Picture;

/// The difference between two equally large pictures.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Score {
    /// The mean difference over all channels, from 0 to 255.
    pub mean: f64,
    /// The 95th percentile of the pixels' differences from the closest color.
    pub p95: f64,
    /// The fraction of pixels whose difference is above 8.
    pub fraction_above: f64,
    /// The fraction of pixels that only one of the pictures covers. The background is the color of
    /// the reference's upper left pixel.
    pub silhouette: f64,
}

/// Returns the score of a picture against its reference, or `None` if their sizes differ.
pub fn score_picture(ours: &Picture, reference: &Picture) -> Option<Score> {
    if (ours.width, ours.height) != (reference.width, reference.height) {
        return None;
    }
    let count = ours.pixels.len();
    let there = nearest_neighbor_steps(ours, reference);
    let back = nearest_neighbor_steps(reference, ours);
    let mut differences: Vec<u8> = there.into_iter().zip(back).map(|(a, b)| a.max(b)).collect();
    let above = differences.iter().filter(|&&d| d > 8).count();
    differences.sort_unstable();
    let pairs = || ours.pixels.iter().zip(&reference.pixels);
    let step = |a: u8, b: u8| u64::from(a.abs_diff(b));
    let sum: u64 = pairs().flat_map(|(a, b)| [0, 1, 2].map(|k| step(a[k], b[k]))).sum();
    let background = reference.pixels[0];
    let is_covered = |pixel: &[u8; 3]| largest_step(*pixel, background) > 2;
    let one_sided = pairs().filter(|(a, b)| is_covered(a) != is_covered(b)).count();
    Some(Score {
        mean: sum as f64 / (3 * count) as f64,
        p95: percentile(&differences, 0.95),
        fraction_above: above as f64 / count as f64,
        silhouette: one_sided as f64 / count as f64,
    })
}

/// Returns the largest difference in any channel.
pub fn largest_step(a: [u8; 3], b: [u8; 3]) -> u8 {
    // The loop is unrolled by hand, because it runs for every pixel and its neighbors and the tests
    // are not optimized.
    a[0].abs_diff(b[0]).max(a[1].abs_diff(b[1])).max(a[2].abs_diff(b[2]))
}

/// Returns for each pixel of `a` the smallest difference from the 3 × 3 neighbors of the same
/// position in `b`. At the border, some neighbors are missing.
fn nearest_neighbor_steps(a: &Picture, b: &Picture) -> Vec<u8> {
    let (width, height) = (a.width as usize, a.height as usize);
    let mut least = vec![255; width * height];
    for (at, least) in least.iter_mut().enumerate() {
        if a.pixels[at] == b.pixels[at] {
            *least = 0;
            continue;
        }
        let (x, y) = (at % width, at / width);
        for row in y.saturating_sub(1)..=(y + 1).min(height - 1) {
            for column in x.saturating_sub(1)..=(x + 1).min(width - 1) {
                *least = largest_step(a.pixels[at], b.pixels[row * width + column]).min(*least);
            }
        }
    }
    least
}

/// Returns a percentile of sorted numbers with linear interpolation, as in NumPy.
fn percentile(sorted: &[u8], fraction: f64) -> f64 {
    let position = fraction * (sorted.len() - 1) as f64;
    let (below, rest) = (position as usize, position - position.floor());
    let above = sorted[(below + 1).min(sorted.len() - 1)];
    f64::from(sorted[below]) + (f64::from(above) - f64::from(sorted[below])) * rest
}

/// The output of `score.py` for the pairs below.
const EXPECTED_SCORES: [&str; 3] = [
    "mean 0.0000 p95 0.0000 share 0.0000 silhouette 0.0000",
    "mean 31.5927 p95 0.0000 share 0.0104 silhouette 0.1250",
    "mean 25.0403 p95 52.0000 share 0.2397 silhouette 0.0000",
];

/// Compares the scores of some generated pictures with the output of the script.
///
/// # Errors
/// Returns an error if a score differs.
pub fn compare_with_script() -> Result<(), String> {
    let made = |width: u32, height: u32, seed: u32, shift: u32| {
        let pixel = |n: u32| {
            let (x, y) = (n % width + shift, n / width);
            let inside = (x / 5 + y / 4 + seed).is_multiple_of(3);
            let channel = |k: u32| ((x * x * 3 + y * 7 + k * 31 + seed * x * y) % 61 * 4) as u8;
            if n > 0 && inside { [0, 1, 2].map(channel) } else { [51; 3] }
        };
        Picture { width, height, pixels: (0..width * height).map(pixel).collect() }
    };
    for (number, (ours, reference, printed)) in [
        (made(64, 48, 0, 0), made(64, 48, 0, 0), EXPECTED_SCORES[0]),
        (made(64, 48, 0, 0), made(64, 48, 0, 1), EXPECTED_SCORES[1]),
        (made(37, 23, 2, 0), made(37, 23, 5, 0), EXPECTED_SCORES[2]),
    ]
    .into_iter()
    .enumerate()
    {
        let actual =
            score_picture(&ours, &reference).map_or_else(String::new, |score| score.to_string());
        if actual != printed {
            return Err(format!("pair {number}: score.py prints {printed}, actual {actual}"));
        }
    }
    Ok(())
}

impl std::fmt::Display for Score {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { mean, p95, fraction_above: share, silhouette } = self;
        write!(f, "mean {mean:.4} p95 {p95:.4} share {share:.4} silhouette {silhouette:.4}")
    }
}
