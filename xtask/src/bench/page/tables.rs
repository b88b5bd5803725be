//! The tables of the page, formatted from the figures that `tests/peers` writes.

use serde_json::Value;
use std::fmt::Write as _;

/// Returns the elements of an array, or an empty slice for any other value.
pub fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

/// Returns a string, or an empty one for any other value.
pub fn text(value: &Value) -> &str {
    value.as_str().unwrap_or_default()
}

/// Formats a median with its minimum and maximum.
pub fn ratio(spread: &Value) -> String {
    scaled(spread, 1.0)
}

fn scaled(spread: &Value, factor: f64) -> String {
    let [low, median, high] = ["low", "median", "high"].map(|key| spread[key].as_f64());
    let (Some(low), Some(median), Some(high)) = (low, median, high) else { return "–".into() };
    format!("{:.2} ({:.2} … {:.2})", median * factor, low * factor, high * factor)
}

/// Formats a scene: its contestants and the differences between their pictures.
pub fn scene(scene: &Value) -> String {
    let mut markdown = format!("\n### {}\n\n{}.\n\n", text(&scene["name"]), text(&scene["about"]));
    markdown += &contestants(&scene["contestants"], &["raster", "render"]);
    for found in list(&scene["agreement"]) {
        let _ = write!(
            markdown,
            "\nCompared with {}: coverage differs in {} of {} pixels, color in {}.\n",
            text(&found["peer"]),
            found["coverage_differs"],
            found["drawn"],
            found["color_differs"]
        );
    }
    markdown
}

/// Formats the section for one series of measurements.
pub fn contest(title: &str, series: &Value, bases: &[&str]) -> String {
    if list(series).is_empty() {
        return String::new();
    }
    format!("\n## {title}\n\n{}", contestants(series, bases))
}

/// Formats times in milliseconds and as multiples of the base times in the same round.
fn contestants(series: &Value, bases: &[&str]) -> String {
    let over: String = bases.iter().map(|base| format!(" × {base} |")).collect();
    let mut markdown = format!("| | ms |{over}\n| --- | --- |{}\n", " --- |".repeat(bases.len()));
    for one in list(series) {
        let _ = write!(markdown, "| {} | {} |", text(&one["name"]), scaled(&one["seconds"], 1e3));
        for base in bases {
            let _ = write!(markdown, " {} |", ratio(&one[format!("over_{base}")]));
        }
        markdown.push('\n');
    }
    markdown
}

/// Formats the comparison from file to PNG: CPU time, wall time and memory.
pub fn files(files: &Value) -> String {
    let mut markdown = String::new();
    if list(files).is_empty() {
        return markdown;
    }
    markdown += "\n## From file to PNG\n\n| model | program | CPU ms | × alberti | wall ms | MiB |\n| --- | --- | --- | --- | --- | --- |\n";
    for file in list(files) {
        for (at, one) in list(&file["contestants"]).iter().enumerate() {
            let _ = writeln!(
                markdown,
                "| {} | {} | {} | {} | {} | {} |",
                text(&file["model"]),
                text(&one["name"]),
                scaled(&one["seconds"], 1e3),
                ratio(&one["over_alberti"]),
                scaled(&file["wall_seconds"][at], 1e3),
                scaled(&file["peak_bytes"][at], 1.0 / 1_048_576.0),
            );
        }
    }
    markdown
}

/// Formats the speedup from a second thread.
pub fn threads(threads: &Value) -> String {
    let mut markdown = String::new();
    if list(threads).is_empty() {
        return markdown;
    }
    markdown += "\n## Two threads\n\nWall time divided by the wall time with one thread, in rounds in which that thread had its core to itself.\n\n\
                 | scene | contestant | wall time | quiet rounds | same picture |\n| --- | --- | --- | --- | --- |\n";
    for found in list(threads) {
        let _ = writeln!(
            markdown,
            "| {} | {} | {} | {} | {} |",
            text(&found["scene"]),
            text(&found["peer"]),
            ratio(&found["wall_of_two_over_one"]),
            found["quiet_rounds"],
            if found["same_picture"] == true { "yes" } else { "NO" }
        );
    }
    markdown
}

/// Formats the goals.
pub fn goals(goals: &Value) -> String {
    let mut markdown = String::new();
    if list(goals).is_empty() {
        return markdown;
    }
    markdown += "\n## Goals\n\n| | comparison | measured | goal |\n| --- | --- | --- | --- |\n";
    for goal in list(goals) {
        let verdict = if goal["met"] == true { "met" } else { "missed" };
        markdown += &format!("| {verdict} {}", goal_row(goal));
    }
    markdown
}

/// Formats a goal: the comparison, the result and the bound.
pub fn goal_row(goal: &Value) -> String {
    let sign = if goal["at_least"] == true { "≥" } else { "≤" };
    let wanted = goal["wanted"].as_f64().unwrap_or_default();
    let (about, whose) = (text(&goal["about"]), text(&goal["whose"]));
    format!("| {about} ({whose}) | {} | {sign} {wanted:.2} |\n", ratio(&goal["reached"]))
}
