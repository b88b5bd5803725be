//! `cargo xtask bench --page`: compares the rasterizer and the program with others. Writes the page
//! `docs/benchmarks.md` and every individual time to `docs/benchmarks.csv`.
//!
//! ```text
//! cargo xtask bench --page                      # 15 minutes on a quiet machine
//! cargo xtask bench --page --rounds 3           # faster but less accurate
//! ```
//!
//! It measures the same things as `cargo xtask bench raster` and takes the same arguments. The page
//! states the machine, the time, the commit and the load. Losses are listed first.

mod losses;
mod place;
mod tables;

use crate::Outcome;
use crate::workspace::{project_root, read_text, target_folder};
use place::Place;
use serde_json::Value;
use std::fmt::Write as _;
use std::path::Path;

/// Runs the measurements, then writes the page and the CSV file.
pub fn run_page(arguments: &[String]) -> Outcome {
    // The program is built before the load is read, so that this build does not count as load.
    let program = crate::program::Program::build(crate::program::Build::Release)?;
    super::raster::build_peers()?;
    let mut place = Place::describe()?;
    super::raster::run_peers(&program, arguments)?;
    place.load_after = place::load();
    let text = read_text(&target_folder().join("bench/raster.json"))?;
    let figures: Value = serde_json::from_str(&text).map_err(|error| error.to_string())?;
    let counts = super::instructions::recorded_counts()?;
    let folder = project_root().join("docs");
    write(&folder.join("benchmarks.md"), &page(&place, &figures, &counts))?;
    write(&folder.join("benchmarks.csv"), &rows(&figures))
}

fn write(path: &Path, text: &str) -> Outcome {
    println!("{}", path.display());
    std::fs::write(path, text).map_err(|error| format!("{}: {error}", path.display()))
}

const INTRODUCTION: &str = "\
# Benchmarks

Written by `cargo xtask bench --page`. All figures come from one run on one machine, with the programs that are installed there;
[benchmarks.csv](benchmarks.csv) lists every individual time. The comparisons in which Alberti is slower come first.
";

const METHOD: &str = "
## Method

- All contestants draw the same vertices at 1920 × 1080 in one process with one thread. After a warm-up round, each round runs every
  contestant once, in a different order. The results are the thread's CPU time and the ratios within each round, because a busy machine
  slows all contestants alike. Tables show medians, with the minimum and maximum in parentheses.
- `raster` is the crate of that name, with the same plain shader as its peers. `render` is all of `pipeline::render`: it shades the same
  scene with every feature that the program uses. \"4x\" means four samples per pixel. Slow contestants run fewer rounds.
- In the comparison of files, each program runs as a separate process that reads the file and writes a PNG. The system measures CPU time
  and peak memory. f3d runs on a virtual display and draws with Mesa's llvmpipe.
- Renderers that use a graphics card, and programs that take minutes per picture, are not compared.
- `tests/peers/README.md` lists what you need to run the benchmarks. Times are not asserted, because they depend on more than the code.
  The instruction counts at the end are asserted; another run reproduces them exactly.
";

/// Formats the page.
fn page(place: &Place, figures: &Value, counts: &super::instructions::RecordedCounts) -> String {
    let mut text = INTRODUCTION.to_owned();
    text += &place.to_markdown(figures);
    text += &losses::to_markdown(figures);
    text += METHOD;
    text += "\n## Scenes\n";
    for scene in tables::list(&figures["scenes"]) {
        text += &tables::scene(scene);
    }
    text += &tables::files(&figures["files"]);
    text += &tables::contest("Limits of the machine", &figures["limits"], &["clear", "kernel"]);
    text +=
        &tables::contest("Cost of shading features", &figures["features"], &["default picture"]);
    text += &tables::threads(&figures["threads"]);
    text += &tables::goals(&figures["goals"]);
    let _ = write!(
        text,
        "\n## Instructions\n\nCounted by callgrind, with the program compiled by {}:\n\n",
        counts.compiler
    );
    text += "| work | instructions |\n| --- | --- |\n";
    for (name, count) in &counts.counts {
        let _ = writeln!(text, "| {name} | {count} |");
    }
    text
}

/// Formats every individual time: the subject, the contestant, the round, and the seconds.
fn rows(figures: &Value) -> String {
    let mut text = "subject,contestant,round,cpu_seconds\n".to_owned();
    let mut add = |subject: &str, contestants: &Value| {
        for one in tables::list(contestants) {
            for (round, time) in tables::list(&one["times"]).iter().enumerate() {
                if let Some(time) = time.as_f64() {
                    let name = tables::text(&one["name"]).replace(',', " ");
                    let _ = writeln!(text, "{subject},{name},{},{time:.6}", round + 1);
                }
            }
        }
    };
    for scene in tables::list(&figures["scenes"]) {
        add(tables::text(&scene["name"]), &scene["contestants"]);
    }
    add("limits", &figures["limits"]);
    add("features", &figures["features"]);
    for file in tables::list(&figures["files"]) {
        add(tables::text(&file["model"]), &file["contestants"]);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn spread(median: f64) -> Value {
        json!({ "low": median / 2.0, "median": median, "high": median * 2.0 })
    }

    fn contestant(name: &str, seconds: f64, over: f64) -> Value {
        json!({ "name": name, "seconds": spread(seconds), "over_raster": spread(over),
                "times": [seconds, null] })
    }

    #[test]
    fn rows_are_individual_times_and_losses_come_first() {
        let figures = json!({
            "llvmpipe": "llvmpipe 1", "f3d": null, "limits": null,
            "scenes": [{ "name": "floor", "about": "a floor", "agreement": [], "contestants": [
                contestant("raster", 0.002, 1.0), contestant("fast, other", 0.001, 0.5),
            ]}],
            "goals": [{ "about": "time", "whose": "raster", "reached": spread(1.0), "wanted": 2.0,
                        "at_least": true, "met": false }],
        });
        assert_eq!(
            rows(&figures),
            "subject,contestant,round,cpu_seconds\n\
             floor,raster,1,0.002000\nfloor,fast  other,1,0.001000\n"
        );
        let counts = super::super::instructions::RecordedCounts::default();
        let page = page(&Place::default(), &figures, &counts);
        let at = |part: &str| page.find(part).unwrap_or_else(|| panic!("{part}: {page}"));
        assert!(at("fast, other | 0.50 (0.25 … 1.00)") < at("## Method"), "{page}");
        assert!(at("| time (raster) | 1.00 (0.50 … 2.00) | ≥ 2.00 |") < at("## Scenes"));
        assert!(page.contains("| raster | 2.00 (1.00 … 4.00) |"), "{page}");
    }
}
