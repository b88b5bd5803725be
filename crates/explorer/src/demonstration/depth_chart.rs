//! The depth table as a page: charts of depth and resolution against distance, and the table rows.
//!
//! ```text
//!  ┌ heading ────────────────────────────┐
//!  │ depth      ╭──── normal    │ table   │   Both charts have the same distance axis, either
//!  │           ╱ ╭─── reversed  │ …       │   logarithmic or linear; the resolution axis is always
//!  │ resolution ╱╱              │         │   logarithmic, since it spans many powers of ten.
//!  └─────────────────────────────────────┘
//! ```

use super::depth_table::{DepthRow, DepthTable};
use super::number_format::format_short;
use drawing::{Axis, AxisMark, Chart, Curve, Page, Spacing};
use glam::DVec2;
use page::{Group, Ink, Label, Layer, Pen, TextAlign};
use projection::DepthFormat;

/// The color of text and axes.
const INK: Ink = [26, 31, 38];
/// The color of normal-depth curves.
const NORMAL_INK: Ink = [26, 86, 176];
/// The color of reversed-depth curves, which are also dashed.
const REVERSED_INK: Ink = [179, 38, 30];

/// The minimum page size in millimeters: A4 landscape. Long tables make the page longer.
const PAGE_SIZE: DVec2 = DVec2::new(297.0, 210.0);
/// The width and height of each chart in millimeters.
const CHART_SIZE: DVec2 = DVec2::new(150.0, 66.0);
/// The upper left corner of the depth chart.
const UPPER_CHART_CORNER: DVec2 = DVec2::new(24.0, 38.0);
/// The upper left corner of the resolution chart.
const LOWER_CHART_CORNER: DVec2 = DVec2::new(24.0, 126.0);
/// The upper left corner of the table.
const TABLE_CORNER: DVec2 = DVec2::new(184.0, 36.0);

/// The right edges of the table columns, in millimeters from the left edge of the table. Cells are
/// right-aligned, so the decimal points in a column nearly line up.
const COLUMN_ENDS: [f64; 5] = [18.0, 38.0, 59.0, 80.0, 105.0];

/// The text height of the heading in millimeters.
const HEADING_HEIGHT: f64 = 4.5;
/// The text height of the notes and the table in millimeters.
const LETTER_HEIGHT: f64 = 2.3;
/// The line spacing of the table, as a multiple of the text height.
const LINE_SPACING: f64 = 2.1;

/// The number of samples in a curve: more than a printer resolves, and enough for every tooth of
/// the floating-point resolution.
const CURVE_SAMPLES: u32 = 800;

impl DepthTable {
    /// Draws the curves and the table on a page, with this distance spacing.
    ///
    /// The charts are sampled separately; `rows` appear only in the table. Each table line takes
    /// 4.83 mm, so 31 rows fit on A4. With more rows the page grows downward.
    #[must_use]
    pub fn to_page(&self, rows: &[DepthRow], distances: Spacing) -> Page {
        let table_end = TABLE_CORNER.y + (rows.len() + 2) as f64 * LETTER_HEIGHT * LINE_SPACING;
        let size = DVec2::new(PAGE_SIZE.x, PAGE_SIZE.y.max(table_end + 10.0));
        let title = "Depth after the perspective divide";
        let mut page = Page::new(size, title, Some([255; 3]));
        let [depths, steps] = self.build_charts(distances);
        page.layers.extend(depths.to_layers(UPPER_CHART_CORNER, CHART_SIZE));
        page.layers.extend(steps.to_layers(LOWER_CHART_CORNER, CHART_SIZE));
        page.layers
            .extend([heading_layer(title, &self.notes()), table_layer(&self.table_cells(rows))]);
        page
    }

    /// Returns the two charts: depth and resolution against distance.
    ///
    /// The depth axis is linear and contains [0, 1], or [−1, 1] for OpenGL's range. A dashed line
    /// marks the distance 2FN/(F + N), up to which half of the range is used. Normal curves are
    /// solid and reversed curves are dashed, so that the charts are readable without color.
    fn build_charts(&self, spacing: Spacing) -> [Chart; 2] {
        let samples = self.sample_rows(spacing);
        let [from, to] = self.distance_range();
        let title = format!("distance in scene units, {} axis", spacing_name(spacing));
        let x = Axis { title, from, to, spacing };
        let curve = |which: usize, of: &dyn Fn(&DepthRow) -> [f64; 2]| Curve {
            id: ["normal", "reversed"][which].to_owned(),
            title: ["normal", "reversed"][which].to_owned(),
            ink: [NORMAL_INK, REVERSED_INK][which],
            dashed: which == 1,
            points: samples.iter().map(|row| [row.distance, of(row)[which]]).collect(),
        };
        let curves = |of: &dyn Fn(&DepthRow) -> [f64; 2]| vec![curve(0, of), curve(1, of)];
        let ends = samples.iter().flat_map(|row| row.depths);
        let (low, high) = ends.fold((0.0_f64, 1.0_f64), |(l, h), d| (l.min(d), h.max(d)));
        let half = self.curves()[0].half_range_distance();
        let [finest, coarsest] = step_range(&samples, self.depth_format());
        [
            Chart {
                id: "depth".to_owned(),
                x: x.clone(),
                y: Axis {
                    title: "depth, linear axis".to_owned(),
                    from: low,
                    to: high,
                    spacing: Spacing::Linear,
                },
                curves: curves(&|row| row.depths),
                marks: vec![AxisMark {
                    value: half,
                    text: format!("half at {}", format_short(half, 4)),
                }],
            },
            Chart {
                id: "step".to_owned(),
                x,
                y: Axis {
                    title: "smallest step in scene units, logarithmic axis".to_owned(),
                    from: finest,
                    to: coarsest,
                    spacing: Spacing::Logarithmic,
                },
                curves: curves(&|row| row.steps)
                    .into_iter()
                    .map(|curve| drop_steps_below(curve, finest))
                    .collect(),
                marks: Vec::new(),
            },
        ]
    }

    /// Returns densely sampled rows, evenly spaced on the distance axis.
    ///
    /// D(s) = N (E / N)^(s / samples) on a logarithmic axis, and N + (E − N) s / samples on a
    /// linear axis. The first and last samples are exactly the ends of the range, without the
    /// rounding error of `exp`. Distances whose depth cannot be represented are dropped.
    fn sample_rows(&self, spacing: Spacing) -> Vec<DepthRow> {
        let [near, end] = self.distance_range();
        let ratio = libm::log(end) - libm::log(near);
        let distance = |sample: u32| match sample {
            0 => near,
            CURVE_SAMPLES => end,
            sample => {
                let fraction = f64::from(sample) / f64::from(CURVE_SAMPLES);
                match spacing {
                    Spacing::Linear => near + (end - near) * fraction,
                    Spacing::Logarithmic => near * libm::exp(ratio * fraction),
                }
            }
        };
        (0..=CURVE_SAMPLES).filter_map(|sample| self.row_at(distance(sample)).ok()).collect()
    }
}

/// Returns the word for the spacing of an axis.
const fn spacing_name(spacing: Spacing) -> &'static str {
    match spacing {
        Spacing::Linear => "linear",
        Spacing::Logarithmic => "logarithmic",
    }
}

/// Returns the range of the resolution axis, from finest to coarsest. Near depth 0, floating-point
/// resolution becomes arbitrarily fine, so the finest fiftieth is omitted to keep the rest
/// readable.
///
/// Fixed point has a constant step in depth, so its finest steps are kept. The last sample is
/// always excluded, because there is no step at the far plane. Sorting makes this O(n log n).
fn step_range(samples: &[DepthRow], format: DepthFormat) -> [f64; 2] {
    let left_out = if format == DepthFormat::Float32 { 50 } else { usize::MAX };
    let before_last = samples.len().saturating_sub(1);
    let before_last = samples[..before_last].iter();
    let mut steps: Vec<f64> = before_last.flat_map(|row| row.steps).collect();
    steps.sort_by(f64::total_cmp);
    let (Some(&finest), Some(&coarsest)) = (steps.get(steps.len() / left_out), steps.last()) else {
        return [0.5, 2.0];
    };
    // The margin is needed if all steps are equal.
    if coarsest > finest * 2.0 { [finest, coarsest] } else { [finest * 0.5, finest * 4.0] }
}

/// Returns the part of a curve that is not below a value, without the last sample, because there is
/// no step at the far plane.
fn drop_steps_below(mut curve: Curve, least: f64) -> Curve {
    curve.points.pop();
    curve.points.retain(|[_, step]| *step >= least);
    curve
}

/// Returns the title and notes at the top of the page.
///
/// Text is drawn with a stroke font, so the page needs no font file. The notes are one line,
/// compressed to 270 mm if necessary.
fn heading_layer(title: &str, notes: &[String]) -> Layer {
    let mut layer = Layer::new("heading", "heading", Pen::solid(LETTER_HEIGHT * 0.1, INK));
    let left = UPPER_CHART_CORNER.x - 12.0;
    let mut strokes = Label::new(title, DVec2::new(left, 14.0), HEADING_HEIGHT).strokes();
    let at = DVec2::new(left, 14.0 + HEADING_HEIGHT * 1.4);
    strokes.extend(Label::new(&notes.join(" · "), at, LETTER_HEIGHT).fit_to_width(270.0).strokes());
    layer.groups.push(Group { strokes, ..Group::default() });
    layer
}

/// Returns the rows as text, with right-aligned columns.
///
/// Each row is a group with the id `row-0`, `row-1`, … Row 0 contains the column names and has a
/// gap of 1.5 mm below it.
fn table_layer(cells: &[[String; 5]]) -> Layer {
    let mut layer = Layer::new("table", "table", Pen::solid(LETTER_HEIGHT * 0.1, INK));
    for (number, row) in cells.iter().enumerate() {
        let down =
            number as f64 * LETTER_HEIGHT * LINE_SPACING + if number > 0 { 1.5 } else { 0.0 };
        let strokes = row.iter().zip(COLUMN_ENDS).flat_map(|(cell, end)| {
            let at = TABLE_CORNER + DVec2::new(end, down);
            Label::new(cell, at, LETTER_HEIGHT).with_align(TextAlign::End).strokes()
        });
        let strokes = strokes.collect();
        let id = format!("row-{number}");
        layer.groups.push(Group { id, title: row[0].clone(), strokes, ..Group::default() });
    }
    layer
}

#[cfg(test)]
mod tests {
    use super::*;
    use page::to_millimeters;
    use projection::Convention;

    /// The drawn curve matches the formula, F(D − N)/((F − N)D), to a micrometer on the page.
    #[test]
    fn drawn_curves_match_the_formula() {
        let table = DepthTable::new(2.0, 40.0, Convention::WEBGPU, DepthFormat::Float32);
        let page = table.expect("a table").to_page(&[], Spacing::Logarithmic);
        let layer = page.layers.iter().find(|layer| layer.id == "depth-normal").expect("a curve");
        let points = &layer.groups[0].strokes[0].points;
        assert!(points.len() > 500);
        for &sample in points {
            let [x, y] = ((to_millimeters(sample) - UPPER_CHART_CORNER) / CHART_SIZE).to_array();
            let distance = 2.0 * libm::pow(20.0, x);
            let depth = 40.0 * (distance - 2.0) / (38.0 * distance);
            assert!((1.0 - y - depth).abs() < 2e-5, "{distance}: {} {depth}", 1.0 - y);
        }
    }

    #[test]
    fn axis_titles_name_quantity_and_spacing() {
        let table = DepthTable::new(2.0, 40.0, Convention::WEBGPU, DepthFormat::Float32);
        let table = table.expect("a table");
        for (spacing, words) in
            [(Spacing::Linear, "linear axis"), (Spacing::Logarithmic, "logarithmic axis")]
        {
            let [depth, step] = table.build_charts(spacing);
            for chart in [&depth, &step] {
                assert_eq!(chart.x.title, format!("distance in scene units, {words}"));
                assert_eq!(chart.x.spacing, spacing);
            }
            assert!(depth.y.title.ends_with("linear axis"), "{}", depth.y.title);
            assert!(step.y.title.contains("scene units"), "{}", step.y.title);
        }
    }

    #[test]
    fn every_depth_range_and_format_can_be_drawn() {
        for (near, far) in [(1e-3, f64::INFINITY), (1.0, 1.000_001), (1e-6, 1e9)] {
            for format in
                [DepthFormat::Float32, DepthFormat::FixedPoint(1), DepthFormat::FixedPoint(64)]
            {
                for convention in [Convention::OPENGL, Convention::WEBGPU] {
                    let table = DepthTable::new(near, far, convention, format).expect("a table");
                    let page = table.to_page(&[], Spacing::Linear);
                    let curves = page.layers.iter().filter(|layer| layer.id.ends_with("-normal"));
                    assert_eq!(curves.count(), 2, "{near} {far} {format:?}");
                }
            }
        }
    }
}
