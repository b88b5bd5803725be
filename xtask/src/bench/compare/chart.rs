//! The chart: a bar for each ratio over all models, extending left or right from a line at 1.
//!
//! Positions are logarithmic, so half the time is as far from the line as twice the time.

use super::machine::Machine;
use super::measurement::Measurement;
use super::spread::Spread;
use super::summary::{VariantSummary, summarize};
use super::variants::Group;
use std::fmt::Write as _;

const WIDTH: f64 = 900.0;
/// The x coordinate of the left end of the scale, which extends to [`RIGHT`].
const LEFT: f64 = 190.0;
const RIGHT: f64 = 800.0;
const BAR: f64 = 16.0;
const HEADING: f64 = 34.0;
/// The scale extends at most to this ratio and its inverse; longer bars are cut off at its ends and
/// labeled with their value.
const GREATEST: f64 = 16.0;

const GRAY: &str = "#9a9a9a";
const BLUE: &str = "#2f6f9f";

/// A bar: a ratio with its name.
struct Bar<'a> {
    name: &'a str,
    ratio: Option<Spread>,
    color: &'static str,
}

/// A group of bars.
struct Panel<'a> {
    title: String,
    bars: Vec<Bar<'a>>,
}

/// Draws the chart as an SVG.
pub fn to_svg(machine: &Machine, measurements: &[Measurement]) -> String {
    let summaries = summarize(measurements, None);
    let panels = panels(&summaries);
    let height = 114.0 + panels.iter().map(panel_height).sum::<f64>();
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" \
         font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n\
         <text x=\"16\" y=\"24\" font-size=\"15\">Ratios of times and memory over all models: \
         medians and spread</text>\n<text x=\"16\" y=\"44\">old: {}</text>\n\
         <text x=\"16\" y=\"60\">new: {}</text>\n\
         <text x=\"16\" y=\"76\">{}, {} cores</text>\n",
        escape_xml(&machine.old),
        escape_xml(&machine.new),
        escape_xml(&machine.processor),
        machine.cores
    );
    let greatest = scale_end(&panels);
    let mut top = 86.0;
    draw_grid(&mut text, greatest, top, height - 22.0);
    for panel in &panels {
        draw_panel(&mut text, panel, greatest, top);
        top += panel_height(panel);
    }
    text + "</svg>\n"
}

fn panels<'a>(summaries: &'a [VariantSummary<'a>]) -> Vec<Panel<'a>> {
    let in_group = |group| summaries.iter().filter(move |summary| summary.group == group);
    let mut panels = Vec::new();
    for summary in in_group(Group::Settings) {
        let bar = |name| Bar { name, ratio: summary.new_over_old_of(name), color: BLUE };
        let bars = summary.figure_names().into_iter().map(bar).collect();
        panels.push(Panel { title: format!("new/old: {}", summary.name), bars });
    }
    for group in [Group::Features, Group::Styles, Group::Commands] {
        let bar = |summary: &'a VariantSummary<'a>| Bar {
            name: summary.name,
            ratio: summary.new_over_old(),
            color: BLUE,
        };
        let bars = in_group(group).map(bar).collect();
        panels.push(Panel { title: format!("new/old: {}", group.title()), bars });
    }
    for group in [Group::Features, Group::Styles, Group::Commands] {
        let compared = in_group(group).filter(|summary| summary.is_compared());
        let pairs = compared.map(|summary| {
            [
                Bar { name: summary.name, ratio: summary.old_on_over_off(), color: GRAY },
                Bar { name: "", ratio: summary.new_on_over_off(), color: BLUE },
            ]
        });
        let bars: Vec<Bar<'_>> = pairs.flatten().collect();
        let title = format!("on/off: {} (old gray, new blue)", group.title());
        panels.push(Panel { title, bars });
    }
    panels.retain(|panel| panel.bars.iter().any(|bar| bar.ratio.is_some()));
    panels
}

fn panel_height(panel: &Panel<'_>) -> f64 {
    HEADING + BAR * panel.bars.len() as f64
}

/// Returns the smallest power of two for which all medians are on the scale, at most [`GREATEST`].
fn scale_end(panels: &[Panel<'_>]) -> f64 {
    let ratios = panels.iter().flat_map(|panel| &panel.bars).filter_map(|bar| bar.ratio);
    let farthest = ratios.map(|ratio| ratio.median.max(1.0 / ratio.median)).fold(1.0, f64::max);
    let mut end = 2.0;
    while end < farthest && end < GREATEST {
        end *= 2.0;
    }
    end
}

/// Returns the x coordinate of a ratio.
fn ratio_x(ratio: f64, greatest: f64) -> f64 {
    let ratio = ratio.clamp(1.0 / greatest, greatest);
    let share = libm::log2(ratio) / libm::log2(greatest);
    f64::midpoint(LEFT, RIGHT) + share * (RIGHT - LEFT) / 2.0
}

fn draw_grid(text: &mut String, greatest: f64, top: f64, bottom: f64) {
    let mut ratio = 1.0 / greatest;
    while ratio <= greatest {
        let (x, color) =
            (ratio_x(ratio, greatest), if ratio == 1.0 { "#333333" } else { "#dddddd" });
        let _ = writeln!(
            text,
            "<line x1=\"{x:.1}\" x2=\"{x:.1}\" y1=\"{top:.0}\" y2=\"{bottom:.0}\" \
             stroke=\"{color}\"/><text x=\"{x:.1}\" y=\"{:.0}\" text-anchor=\"middle\" \
             fill=\"#555555\">{}</text>",
            bottom + 14.0,
            scale_number(ratio)
        );
        ratio *= 2.0;
    }
}

/// Formats a power of two: 1/4, 1/2, 1, 2, 4.
fn scale_number(ratio: f64) -> String {
    if ratio < 1.0 { format!("1/{}", 1.0 / ratio) } else { ratio.to_string() }
}

fn draw_panel(text: &mut String, panel: &Panel<'_>, greatest: f64, top: f64) {
    let (y, title) = (top + 22.0, escape_xml(&panel.title));
    let _ = writeln!(text, "<text x=\"16\" y=\"{y:.0}\" font-weight=\"bold\">{title}</text>");
    for (row, bar) in panel.bars.iter().enumerate() {
        draw_bar(text, bar, greatest, top + HEADING + BAR * row as f64);
    }
}

fn draw_bar(text: &mut String, bar: &Bar<'_>, greatest: f64, top: f64) {
    let baseline = top + BAR - 5.0;
    let name = escape_xml(bar.name);
    let _ = write!(
        text,
        "<text x=\"{:.0}\" y=\"{baseline:.1}\" text-anchor=\"end\">{name}</text>",
        LEFT - 6.0
    );
    let one = ratio_x(1.0, greatest);
    let Some(Spread { min, median, max }) = bar.ratio else {
        let x = one + 6.0;
        let _ = writeln!(text, "<text x=\"{x:.1}\" y=\"{baseline:.1}\" fill=\"#777777\">—</text>");
        return;
    };
    let [x, low, high] = [median, min, max].map(|ratio| ratio_x(ratio, greatest));
    let middle = top + BAR / 2.0 - 1.0;
    let _ = writeln!(
        text,
        "<rect x=\"{:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{:.0}\" fill=\"{}\"/>\
         <line x1=\"{low:.1}\" x2=\"{high:.1}\" y1=\"{middle:.1}\" y2=\"{middle:.1}\" \
         stroke=\"#222222\"/><text x=\"{:.1}\" y=\"{baseline:.1}\">{median:.2}</text>",
        x.min(one),
        top + 1.0,
        (x - one).abs(),
        BAR - 4.0,
        bar.color,
        high.max(one) + 6.0
    );
}

fn escape_xml(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::super::machine::tests::machine;
    use super::super::summary::tests::sample;
    use super::*;

    #[test]
    fn a_ratio_and_its_inverse_are_equally_far_from_one() {
        let place = |ratio| ratio_x(ratio, 4.0);
        assert_eq!((place(0.25), place(4.0), place(100.0)), (LEFT, RIGHT, RIGHT));
        assert!((place(2.0) + place(0.5) - 2.0 * place(1.0)).abs() < 1e-9);
    }

    #[test]
    fn the_scale_contains_the_medians() {
        let bar = |median| Bar {
            name: "",
            ratio: Some(Spread { min: 0.01, median, max: 99.0 }),
            color: BLUE,
        };
        let end = |median| scale_end(&[Panel { title: String::new(), bars: vec![bar(median)] }]);
        assert_eq!((end(1.1), end(0.3), end(5.0), end(1000.0)), (2.0, 4.0, 8.0, GREATEST));
    }

    #[test]
    fn every_variant_has_a_bar_or_a_dash() {
        let svg = to_svg(&machine(), &sample());
        assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
        assert!(svg.contains("&lt;toon>") && !svg.contains("<toon>"));
        // Three figures for the setting, then clay new/old, clay old and new on/off, and toon new
        // on/off.
        assert_eq!(svg.matches("<rect x=").count(), 7);
        assert_eq!(svg.matches(">—<").count(), 2, "toon new/old and old on/off");
    }
}
