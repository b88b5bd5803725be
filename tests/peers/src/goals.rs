//! The goals: the ratios that the rasterizer was designed to achieve.
//!
//! Nothing fails here; the report lists the goals that are met.

use crate::measure::{Series, Spread};
use crate::report::Figures;

/// A goal with its result.
pub struct Goal {
    /// The comparison.
    pub about: String,
    /// The contestant to which the figure applies: `raster`, `render` or `alberti`.
    pub whose: &'static str,
    /// The figure.
    pub reached: Spread,
    /// The bound.
    pub wanted: f64,
    /// Whether the bound is a minimum rather than a maximum.
    pub at_least: bool,
}

impl Goal {
    /// Returns whether the median is within the bound.
    pub fn met(&self) -> bool {
        if self.at_least {
            self.reached.median >= self.wanted
        } else {
            self.reached.median <= self.wanted
        }
    }
}

/// The scene, the peer, and the peer's required time as a multiple of ours.
const FASTER: [(&str, &str, f64); 14] = [
    ("sphere-1m", "llvmpipe", 2.2),
    ("sphere-1m", "euc 0.5", 2.2),
    ("sphere-4m", "llvmpipe", 2.2),
    ("sphere-4m", "euc 0.5", 3.0),
    ("helmet", "llvmpipe", 1.6),
    ("helmet", "euc 0.5", 3.0),
    ("layers-back-to-front-flat", "llvmpipe", 3.0),
    ("layers-back-to-front-flat", "euc 0.5", 3.0),
    ("layers-back-to-front-textured", "llvmpipe", 10.0),
    ("layers-back-to-front-textured", "euc 0.5", 3.0),
    ("layers-front-to-back-flat", "llvmpipe", 15.0),
    ("layers-front-to-back-flat", "euc 0.5", 3.0),
    ("layers-front-to-back-textured", "llvmpipe", 15.0),
    ("layers-front-to-back-textured", "euc 0.5", 3.0),
];

/// The models whose CPU time must be at most a fifth of f3d's.
const HELD_TO_F3D: [&str; 2] = ["flight-helmet", "cave"];

/// Returns the goals for which there are figures.
pub fn goals(figures: &Figures) -> Vec<Goal> {
    let mut found = faster(figures);
    found.extend(instructions(figures));
    found.extend(samples(figures));
    found.extend(limits(figures));
    for threads in &figures.threads {
        let Some(reached) = threads.wall else { continue };
        let about = format!("{}: wall time of two threads over one", threads.scene);
        found.push(Goal { about, whose: threads.peer, reached, wanted: 0.58, at_least: false });
    }
    found.extend(files(figures));
    found
}

fn faster(figures: &Figures) -> Vec<Goal> {
    let mut found = Vec::new();
    for (scene, peer, wanted) in FASTER {
        let Some(heat) = figures.scenes.iter().find(|heat| heat.scene == scene) else { continue };
        for whose in ["raster", "render"] {
            if let Some(reached) = over(&heat.series, peer, whose) {
                let about = format!("{scene}: time of {peer} over ours");
                found.push(Goal { about, whose, reached, wanted, at_least: true });
            }
        }
    }
    found
}

fn instructions(figures: &Figures) -> Vec<Goal> {
    let goal = |heat: &crate::contest::Heat| {
        let reached = over(&heat.series, "raster, baseline", "raster")?;
        let about = format!("{}: baseline instructions over the best", heat.scene);
        Some(Goal { about, whose: "raster", reached, wanted: 1.6, at_least: false })
    };
    figures.scenes.iter().filter_map(goal).collect()
}

fn samples(figures: &Figures) -> Vec<Goal> {
    let helmet = figures.scenes.iter().find(|heat| heat.scene == "helmet");
    let Some(heat) = helmet else { return Vec::new() };
    let goal = |many: &str, one: &str, whose, wanted, at_least| {
        let about = format!("helmet: time of {many} over {one}");
        Some(Goal { about, whose, reached: over(&heat.series, many, one)?, wanted, at_least })
    };
    [
        goal("raster 4x", "raster", "raster", 1.6, false),
        goal("render 4x", "render", "render", 1.6, false),
        goal("llvmpipe 4x", "raster 4x", "raster", 1.8, true),
        goal("llvmpipe 4x", "render 4x", "render", 1.8, true),
    ]
    .into_iter()
    .flatten()
    .collect()
}

fn limits(figures: &Figures) -> Vec<Goal> {
    let Some(series) = &figures.bounds else { return Vec::new() };
    let goal = |a: &str, b: &str, about: &str, wanted, at_least| {
        let reached = over(series, a, b)?;
        Some(Goal { about: about.into(), whose: "raster", reached, wanted, at_least })
    };
    [
        goal(
            "kernel",
            "back to front, flat",
            "fifty flat layers: share of the kernel's rate",
            0.6,
            true,
        ),
        goal(
            "front to back, flat",
            "clear",
            "fifty layers front to back over clearing",
            4.0,
            false,
        ),
        goal(
            "back to front, textured",
            "back to front, flat",
            "fifty layers: textured over flat",
            1.4,
            false,
        ),
    ]
    .into_iter()
    .flatten()
    .collect()
}

fn files(figures: &Figures) -> Vec<Goal> {
    let mut found = Vec::new();
    for heat in &figures.files {
        let [ours, theirs] = &heat.cpu[..] else { continue };
        let whose = "alberti";
        let held = HELD_TO_F3D.iter().any(|name| heat.model.starts_with(name));
        if let Some(reached) = ours.over(theirs).filter(|_| held) {
            let about = format!("{}: CPU time over f3d's", heat.model);
            found.push(Goal { about, whose, reached, wanted: 0.2, at_least: false });
        }
        if let [Some(ours), Some(theirs)] = &heat.peak[..] {
            let about = format!("{}: peak memory over f3d's", heat.model);
            let reached = ours.times(1.0 / theirs.median);
            found.push(Goal { about, whose, reached, wanted: 1.0 / 3.0, at_least: false });
        }
    }
    found
}

/// Returns the first time as a multiple of the second.
fn over(series: &[Series], first: &str, second: &str) -> Option<Spread> {
    let find = |name: &str| series.iter().find(|series| series.name == name);
    find(first)?.over(find(second)?)
}
