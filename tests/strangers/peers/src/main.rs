//! Draws one textured mesh with three rasterizers. `ours.rs`, `euc.rs` and `retrofire.rs` contain
//! the same program, which clears the picture and projects the vertices in every round. Line counts
//! and pictures are compared and, with `--time`, also the best times of several rounds in one
//! process.

mod euc;
mod ours;
mod retrofire;
mod scene;

use scene::Scene;
use std::time::{Duration, Instant};

fn main() {
    for (name, is_sheet) in [("A sheet in front of the eye", true), ("Hills to the horizon", false)]
    {
        println!("{name}:");
        compare(&Scene::new(is_sheet));
    }
}

fn compare(scene: &Scene) {
    let rounds = if std::env::args().any(|word| word == "--time") { 25 } else { 1 };
    let (mut one, mut two) = (ours::Program::new(scene, 1), ours::Program::new(scene, 2));
    let (mut euc, mut retrofire) = (euc::Program::new(scene), retrofire::Program::new(scene));
    let mut programs: [(&str, &mut dyn FnMut()); 4] = [
        ("raster, one thread", &mut || one.draw()),
        ("raster, two threads", &mut || two.draw()),
        ("euc 0.5.3", &mut || euc.draw()),
        ("retrofire 0.4.0", &mut || retrofire.draw()),
    ];
    let mut best = [Duration::MAX; 4];
    for _ in 0..rounds {
        for (index, (_, draw)) in programs.iter_mut().enumerate() {
            let begin = Instant::now();
            draw();
            best[index] = best[index].min(begin.elapsed());
        }
    }
    let names = programs.map(|(name, _)| name);
    let pictures = [one.pixels(), two.pixels(), euc.pixels(), retrofire.pixels()];
    for (index, name) in names.iter().enumerate() {
        let same = pictures[index].iter().zip(pictures[0]);
        let apart = same.filter(|(a, b)| (0..3).any(|k| a[k].abs_diff(b[k]) > 24)).count();
        let ratio = best[index].as_secs_f64() / best[0].as_secs_f64();
        let time =
            format!(", {:.2} ms, {ratio:.2} times the first", best[index].as_secs_f64() * 1e3);
        println!("{name:20} {apart} pixels differ{}", if rounds > 1 { &time } else { "" });
        // Pixels at the edges of texels and bumps may differ.
        assert!(apart < pictures[0].len() / 10, "{name}: {apart}");
    }
    assert!(pictures[0] == pictures[1], "the number of threads changes the picture");
}
