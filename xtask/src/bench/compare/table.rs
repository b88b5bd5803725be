//! The report as text: the stages and variants of each model, then of all models combined.

use super::machine::Machine;
use super::measurement::{ALL_MODELS, Measurement};
use super::run::PEAK_MEMORY;
use super::spread::Spread;
use super::summary::{VariantSummary, model_names, refusals, summarize};
use super::variants::Group;
use std::fmt::Write as _;

/// The text of a cell without a figure.
const MISSING: &str = "—";

const LEGEND: &str = "
Ratios are medians of rounds (least–greatest). Old and new are the programs of the two commits.
on/off is a feature over none, a style over shaded, two threads over one, within a program.
What is compared there is drawing: all stages but those that read and write files; of threads and
commands it is wall time.
";

/// Formats all tables.
pub fn report(machine: &Machine, measurements: &[Measurement]) -> String {
    let Machine { old, new, processor, cores, .. } = machine;
    let mut text = format!("old: {old}\nnew: {new}\n{processor}, {cores} cores\n");
    text += LEGEND;
    let models = model_names(measurements);
    for model in &models {
        text += &section(model, &summarize(measurements, Some(model)), true);
    }
    text += &match models.len() {
        // Show only the batch, because the rest would repeat the figures for this model.
        1 => section(ALL_MODELS, &summarize(measurements, Some(ALL_MODELS)), true),
        _ => section("over all models", &summarize(measurements, None), false),
    };
    let refusals = refusals(measurements);
    if !refusals.is_empty() {
        let _ = write!(text, "\nRefused:\n  {}\n", refusals.join("\n  "));
    }
    text
}

/// Formats the tables of one model, with times, or of all models, without times.
fn section(title: &str, summaries: &[VariantSummary<'_>], times: bool) -> String {
    let mut text = String::new();
    for summary in summaries.iter().filter(|summary| summary.group == Group::Settings) {
        let _ = write!(text, "\n{title}: {}\n{}", summary.name, stage_table(summary, times));
    }
    for group in [Group::Features, Group::Styles, Group::Commands] {
        let rows: Vec<&VariantSummary<'_>> =
            summaries.iter().filter(|summary| summary.group == group).collect();
        if !rows.is_empty() {
            let _ = write!(text, "\n{title}: {}\n{}", group.title(), variant_table(&rows));
        }
    }
    text
}

fn stage_table(summary: &VariantSummary<'_>, times: bool) -> String {
    let heading: &[&str] =
        if times { &["stage", "old ms", "new ms", "new/old"] } else { &["stage", "new/old"] };
    let mut rows = vec![heading.iter().map(|word| (*word).to_owned()).collect()];
    for name in summary.figure_names() {
        let unit = if name == PEAK_MEMORY { " (MiB)" } else { "" };
        let mut row = vec![format!("{name}{unit}")];
        if times {
            row.extend(summary.figure_pair(name).map(|figure| {
                figure.map_or(MISSING.to_owned(), |figure| format!("{:.2}", figure.median))
            }));
        }
        row.push(ratio_text(summary.new_over_old_of(name)));
        rows.push(row);
    }
    align(&rows)
}

fn variant_table(summaries: &[&VariantSummary<'_>]) -> String {
    let heading = ["", "new/old", "old: on/off", "new: on/off", "memory new/old"];
    let mut rows = vec![heading.map(str::to_owned).to_vec()];
    for summary in summaries {
        let ratios = [
            summary.new_over_old(),
            summary.old_on_over_off(),
            summary.new_on_over_off(),
            summary.memory_ratio(),
        ];
        rows.push([summary.name.to_owned()].into_iter().chain(ratios.map(ratio_text)).collect());
    }
    align(&rows)
}

fn ratio_text(ratio: Option<Spread>) -> String {
    ratio.map_or(MISSING.to_owned(), |Spread { min, median, max }| {
        format!("{median:.2} ({min:.2}–{max:.2})")
    })
}

/// Aligns the columns: each is as wide as its widest cell, the first is left-aligned, and the
/// others are right-aligned.
fn align(rows: &[Vec<String>]) -> String {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let cell_width = |row: &Vec<String>, at: usize| row.get(at).map_or(0, |c| c.chars().count());
    let width = |at: usize| rows.iter().map(|row| cell_width(row, at)).max().unwrap_or(0);
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut text = String::new();
    for row in rows {
        let mut line = String::new();
        for (at, cell) in row.iter().enumerate() {
            let width = widths[at];
            let _ = match at {
                0 => write!(line, "  {cell:width$}"),
                _ => write!(line, "  {cell:>width$}"),
            };
        }
        text += line.trim_end();
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::super::machine::tests::machine;
    use super::super::summary::tests::sample;
    use super::*;

    #[test]
    fn columns_are_aligned_by_character_count() {
        let rows = [["a", "1.00 (1–2)"], ["bcd", "—"]].map(|row| row.map(str::to_owned).to_vec());
        assert_eq!(align(&rows), "  a    1.00 (1–2)\n  bcd           —\n");
    }

    #[test]
    fn a_report_covers_each_model_all_models_and_refusals() {
        let text = report(&machine(), &sample());
        let after = |title: &str| text.split(title).nth(1).unwrap_or_else(|| panic!("{title}"));
        let cells = |title: &str, name: &str| -> Vec<&str> {
            let mut lines = after(title).lines();
            lines.find(|line| line.contains(name)).unwrap().split_whitespace().collect()
        };
        let pixels = cells("\na: 1 sample\n", "pixels");
        assert_eq!(pixels, ["pixels", "2.00", "2.00", "1.00", "(0.50–1.50)"]);
        assert!(after("\nover all models: 1 sample\n").contains("1.75 (0.50–2.00)"));
        let toon = cells("\na: styles\n", "<toon>");
        assert_eq!(toon, ["<toon>", "—", "—", "3.00", "(2.00–4.00)", "—"]);
        assert!(after("\nRefused:\n").contains("old: a, <toon>: error: no such style"));
        assert!(text.contains("an old commit") && text.contains("4 cores"));
    }
}
