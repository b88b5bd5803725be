//! The report, as tables for a terminal and as JSON.

use crate::contest::{Heat, Threads};
use crate::features::BASE;
use crate::files::FileHeat;
use crate::goals::goals;
use crate::limits::KERNEL_PIXELS;
use crate::measure::{Series, Spread};
use serde_json::{Value, json};
use std::fmt::Write as _;

/// All measurements.
pub struct Figures {
    /// The name that llvmpipe reports, if it was available.
    pub llvmpipe: Option<String>,
    /// The version of f3d, if it was used.
    pub f3d: Option<String>,
    /// The scenes.
    pub scenes: Vec<Heat>,
    /// The limits of the machine.
    pub bounds: Option<Vec<Series>>,
    /// The comparison of one thread with two.
    pub threads: Vec<Threads>,
    /// The cost of shading features.
    pub features: Vec<Series>,
    /// The measurements from file to picture.
    pub files: Vec<FileHeat>,
}

/// Returns the table of a scene. Results of writing to a `String` are ignored, as it cannot fail.
pub fn scene(heat: &Heat) -> String {
    let mut text = format!("\n{}: {}\n", heat.scene, heat.about);
    table(&mut text, &heat.series, ["raster", "render"]);
    for found in &heat.agreements {
        let _ = writeln!(
            text,
            "  compared with {}: {} of {} pixels differ in coverage, {} in color",
            found.peer, found.coverage, found.drawn, found.color
        );
    }
    text
}

/// Returns the table of limits.
pub fn limits(series: &[Series]) -> String {
    let mut text =
        format!("\nlimits: the kernel fills {KERNEL_PIXELS} pixels, the area of fifty layers\n");
    table(&mut text, series, ["clear", "kernel"]);
    text
}

/// Returns the table of shading features.
pub fn features(series: &[Series]) -> String {
    let mut text = String::new();
    if !series.is_empty() {
        text += "\nfeatures: the flight helmet at 1080p, drawn by `render`\n";
        table(&mut text, series, [BASE, "1 sample"]);
    }
    text
}

/// Returns the table for a model that was drawn from its file.
pub fn file(heat: &FileHeat) -> String {
    let mut text = format!("\n{}: file to PNG, CPU time of the process\n", heat.model);
    table(&mut text, &heat.cpu, ["alberti", "f3d"]);
    for (series, (wall, peak)) in heat.cpu.iter().zip(heat.wall.iter().zip(&heat.peak)) {
        let (Some(wall), Some(peak)) = (wall, peak) else { continue };
        let (wall, peak) = (wall.median * 1e3, peak.median / 1048576.0);
        let _ = writeln!(text, "  {:22} {wall:9.1} ms wall, {peak:.0} MiB at most", series.name);
    }
    text
}

fn table(text: &mut String, series: &[Series], bases: [&str; 2]) {
    let over = |base: &str| format!("× {base}");
    let [first, second] = bases.map(over);
    let _ =
        writeln!(text, "  {:22} {:>9} {:>9}  {first:22} {second:22}", "", "median ms", "best ms");
    for one in series {
        let Some(time) = one.spread() else { continue };
        let ratio = |base: &str| {
            let base = series.iter().find(|series| series.name == base)?;
            one.over(base).map(shown)
        };
        let [first, second] = bases.map(|base| ratio(base).unwrap_or_default());
        let (median, best) = (time.median * 1e3, time.low * 1e3);
        let _ = writeln!(text, "  {:22} {median:9.2} {best:9.2}  {first:22} {second}", one.name);
    }
}

/// Returns the table of threads.
pub fn threads(threads: &[Threads]) -> String {
    let mut text = String::new();
    if !threads.is_empty() {
        text += "\ntwo threads: wall time relative to one thread; CPU time relative to wall time\n";
    }
    for Threads { peer, scene, wall, parallel, counted, same } in threads {
        let wall = wall.map_or("no quiet rounds".into(), shown);
        let parallel = parallel.map(shown).unwrap_or_default();
        let same = if *same { "same picture" } else { "DIFFERENT PICTURE" };
        let name = format!("{scene}, {peer}");
        let _ =
            writeln!(text, "  {name:34} {wall:22} {parallel:22} {counted} quiet rounds, {same}");
    }
    text
}

/// Returns the goals with their results.
pub fn held_to(figures: &Figures) -> String {
    let mut text = String::from("\ngoals\n");
    for goal in goals(figures) {
        let (verdict, sign) =
            (if goal.met() { "met   " } else { "missed" }, if goal.at_least { "≥" } else { "≤" });
        let (reached, wanted) = (shown(goal.reached), goal.wanted);
        let name = format!("{} ({})", goal.about, goal.whose);
        let _ = writeln!(text, "  {verdict} {name:74} {reached:22} {sign} {wanted:.2}");
    }
    text
}

/// Returns a median with its spread.
fn shown(Spread { low, median, high }: Spread) -> String {
    format!("{median:.2} ({low:.2} … {high:.2})")
}

/// Returns all measurements as JSON, for use by other programs.
pub fn to_json(figures: &Figures) -> Value {
    let scenes = figures.scenes.iter().map(|heat| {
        let apart = heat.agreements.iter().map(|found| {
            json!({ "peer": found.peer, "drawn": found.drawn,
                    "coverage_differs": found.coverage, "color_differs": found.color })
        });
        json!({ "name": heat.scene, "about": heat.about,
                "contestants": contestants(&heat.series, &["raster", "render"]),
                "agreement": apart.collect::<Value>() })
    });
    let files = figures.files.iter().map(|heat| {
        let column =
            |values: &[Option<Spread>]| values.iter().map(|v| spread(*v)).collect::<Value>();
        json!({ "model": heat.model, "contestants": contestants(&heat.cpu, &["alberti"]),
                "wall_seconds": column(&heat.wall), "peak_bytes": column(&heat.peak) })
    });
    let threads = figures.threads.iter().map(|found| {
        json!({ "scene": found.scene, "peer": found.peer, "wall_of_two_over_one": spread(found.wall),
                "cpu_over_wall": spread(found.parallel), "quiet_rounds": found.counted,
                "same_picture": found.same })
    });
    let goals = goals(figures);
    let goals = goals.iter().map(|goal| {
        json!({ "about": goal.about, "whose": goal.whose, "reached": spread(Some(goal.reached)),
                "wanted": goal.wanted, "at_least": goal.at_least, "met": goal.met() })
    });
    json!({
        "llvmpipe": figures.llvmpipe,
        "f3d": figures.f3d,
        "scenes": scenes.collect::<Value>(),
        "features": contestants(&figures.features, &[BASE]),
        "limits": figures.bounds.as_ref().map(|series| contestants(series, &["clear", "kernel"])),
        "threads": threads.collect::<Value>(),
        "files": files.collect::<Value>(),
        "goals": goals.collect::<Value>(),
    })
}

fn contestants(series: &[Series], bases: &[&str]) -> Value {
    let one = |one: &Series| {
        let mut value = json!({ "name": one.name, "seconds": spread(one.spread()),
                                "rounds": one.times.iter().flatten().count(),
                                "times": one.times });
        for base in bases {
            let base_series = series.iter().find(|series| series.name == *base);
            value[format!("over_{base}")] = spread(base_series.and_then(|base| one.over(base)));
        }
        value
    };
    series.iter().map(one).collect()
}

fn spread(spread: Option<Spread>) -> Value {
    spread.map_or(
        Value::Null,
        |Spread { low, median, high }| json!({ "low": low, "median": median, "high": high }),
    )
}
