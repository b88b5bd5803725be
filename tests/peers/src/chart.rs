//! The chart, with one bar per contestant for each scene. The length of a bar is the logarithm of
//! the contestant's time relative to ours.

use crate::contest::Heat;
use crate::measure::Spread;
use crate::report::Figures;
use std::fmt::Write as _;

const WIDTH: f64 = 900.0;
/// The start of the bars; the longest bar ends at `RIGHT`.
const LEFT: f64 = 150.0;
const RIGHT: f64 = 820.0;
const ROW: f64 = 18.0;
const HEADING: f64 = 34.0;
/// The smallest ratio on the scale; `MOST` is the largest.
const LEAST: f64 = 0.25;
const MOST: f64 = 256.0;

/// Returns the SVG.
pub fn svg(figures: &Figures) -> String {
    let rows = |heat: &Heat| HEADING + ROW * heat.series.len() as f64;
    let height = 60.0 + figures.scenes.iter().map(rows).sum::<f64>();
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" font-family=\"sans-serif\" \
         font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n\
         <text x=\"16\" y=\"24\" font-size=\"15\">CPU time relative to raster, one thread, 1920 × 1080: medians and spread</text>\n"
    );
    let mut y = 34.0;
    grid(&mut text, y, height - 12.0);
    for heat in &figures.scenes {
        scene(&mut text, heat, y);
        y += rows(heat);
    }
    text + "</svg>\n"
}

/// Returns the position of a ratio on the scale.
fn place(ratio: f64) -> f64 {
    let share = libm::log2(ratio.clamp(LEAST, MOST) / LEAST) / libm::log2(MOST / LEAST);
    LEFT + share * (RIGHT - LEFT)
}

fn grid(text: &mut String, top: f64, bottom: f64) {
    let mut ratio = LEAST;
    while ratio <= MOST {
        let (x, color) = (place(ratio), if ratio == 1.0 { "#555555" } else { "#dddddd" });
        let _ = writeln!(
            text,
            "<line x1=\"{x:.1}\" x2=\"{x:.1}\" y1=\"{top:.0}\" y2=\"{bottom:.0}\" stroke=\"{color}\"/>\
             <text x=\"{x:.1}\" y=\"{bottom:.0}\" dy=\"10\" text-anchor=\"middle\" fill=\"#555555\">{ratio}</text>"
        );
        ratio *= 2.0;
    }
}

fn scene(text: &mut String, heat: &Heat, top: f64) {
    let y = top + 22.0;
    let _ =
        writeln!(text, "<text x=\"16\" y=\"{y:.0}\" font-weight=\"bold\">{}</text>", heat.about);
    let Some(ours) = heat.series.iter().find(|series| series.name == "raster") else { return };
    for (row, series) in heat.series.iter().enumerate() {
        if let Some(ratio) = series.over(ours) {
            bar(text, &series.name, ratio, top + HEADING + ROW * row as f64);
        }
    }
}

fn bar(text: &mut String, name: &str, ratio: Spread, y: f64) {
    let own = name.starts_with('r');
    let color = if own { "#2f6f9f" } else { "#c98a3b" };
    let (start, end) = (place(LEAST), place(ratio.median));
    let (low, high) = (place(ratio.low), place(ratio.high));
    let middle = y + ROW / 2.0 - 3.0;
    let _ = writeln!(
        text,
        "<text x=\"{:.0}\" y=\"{:.1}\" text-anchor=\"end\">{name}</text>\
         <rect x=\"{start:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{:.0}\" fill=\"{color}\"/>\
         <line x1=\"{low:.1}\" x2=\"{high:.1}\" y1=\"{middle:.1}\" y2=\"{middle:.1}\" stroke=\"#222222\"/>\
         <text x=\"{:.1}\" y=\"{:.1}\">{:.2}</text>",
        LEFT - 6.0,
        middle + 4.0,
        y - 2.0,
        end - start,
        ROW - 4.0,
        end.max(high) + 6.0,
        middle + 4.0,
        ratio.median
    );
}
