//! The depth table: depth after the divide against distance, and depth resolution (C48, C68; ZP-1).
//!
//! A perspective projection keeps lines straight at the expense of depth resolution: half of the
//! range is used for distances from N to 2FN/(F + N). Stored depth is rounded, and therefore many
//! large distances share one value. Floating-point numbers are finest near 0. If the far plane has
//! depth 0 (*reversed depth*), the two effects cancel.
//!
//! ```text
//!  depth(D) = F (D − N) / ((F − N) D)        for the range [0, 1] from near N to far F
//!  resolution of b-bit fixed point: ΔD ≈ D² (F − N) / (F N) / (2^b − 1)
//! ```
//! The smallest resolved step grows with the square of the distance. Doubling N halves the step,
//! while F hardly matters beyond a few hundred N.

use super::number_format::format_short;
use projection::{Convention, DepthCurve, DepthFormat, ProjectionError, chapter};
use std::fmt::Write as _;

/// The number of rows in a table with default distances.
///
/// They are enough to show the shape of the curve, and few enough for a terminal.
const DEFAULT_ROWS: u32 = 16;

/// The last distance of a table with an infinite far plane, as a multiple of the near distance.
const INFINITE_FAR_RATIO: f64 = 1e4;

/// Depth against distance, both normal and reversed.
///
/// The convention is not stored: the two curves contain its depth range in both directions.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct DepthTable {
    /// The distance of the near plane.
    near: f64,
    /// The distance of the far plane, or infinity.
    far: f64,
    /// The storage format, which determines the resolution.
    format: DepthFormat,
    /// Depth as a function of distance: normal, then reversed.
    curves: [DepthCurve; 2],
}

/// One distance with its depths and resolutions: normal, then reversed.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct DepthRow {
    /// Distance from the eye along the line of sight.
    pub distance: f64,
    /// Depth after the divide, in the range of the convention: 0 to 1, or −1 to 1.
    pub depths: [f64; 2],
    /// Resolution: the smallest step away from the eye, in world units, that changes the depth in
    /// the table's storage format.
    pub steps: [f64; 2],
}

impl DepthTable {
    /// Creates the table of a perspective projection between two planes, in a convention's depth
    /// range and in the same range reversed. `far` may be infinite.
    ///
    /// One row is computed as a test, so that planes too close together for f64 are rejected here
    /// and not halfway through a table.
    ///
    /// # Errors
    /// Returns an error unless 0 < near < far and the format has 1 to 64 bits.
    pub fn new(
        near: f64,
        far: f64,
        convention: Convention,
        format: DepthFormat,
    ) -> Result<Self, ProjectionError> {
        let curve = |convention| DepthCurve::perspective(near, far, convention);
        let curves = [curve(convention)?, curve(convention.reversed())?];
        let table = Self { near, far, format, curves };
        table.row_at(near)?;
        Ok(table)
    }

    /// Returns the curves of normal and reversed depth.
    #[must_use]
    pub const fn curves(&self) -> [DepthCurve; 2] {
        self.curves
    }

    /// Returns the storage format of depths.
    #[must_use]
    pub const fn depth_format(&self) -> DepthFormat {
        self.format
    }

    /// Returns the distances of the near and far planes. An infinite far plane counts as ten
    /// thousand near distances.
    #[must_use]
    pub fn distance_range(&self) -> [f64; 2] {
        let end = if self.far.is_finite() { self.far } else { self.near * INFINITE_FAR_RATIO };
        [self.near, end]
    }

    /// Returns up to sixteen distances from near to far in equal ratios. The inner distances are
    /// rounded to three digits.
    ///
    /// Dᵢ = N (E / N)^(i / 15). If the planes are close together, rounding can move a distance past
    /// a plane or onto its neighbor. Such distances are dropped, so there may be fewer than
    /// sixteen.
    #[must_use]
    pub fn default_distances(&self) -> Vec<f64> {
        let [near, end] = self.distance_range();
        let ratio = libm::log(end) - libm::log(near);
        let between = (1..DEFAULT_ROWS - 1).map(|row| {
            let fraction = f64::from(row) / f64::from(DEFAULT_ROWS - 1);
            let distance = near * libm::exp(ratio * fraction);
            format!("{distance:.2e}").parse().unwrap_or(distance)
        });
        let between = between.filter(|distance| *distance > near && *distance < end);
        let mut all: Vec<f64> = std::iter::once(near).chain(between).chain([end]).collect();
        all.dedup();
        all
    }

    /// Returns the depths and resolutions at a distance.
    ///
    /// # Errors
    /// Returns an error if the distance is not positive and finite, or if its depth cannot be
    /// distinguished from the next representable depth.
    pub fn row_at(&self, distance: f64) -> Result<DepthRow, ProjectionError> {
        let step = |curve: DepthCurve| curve.resolution(distance, self.format);
        let steps = [step(self.curves[0])?, step(self.curves[1])?];
        let lost = ProjectionError::Unrepresentable { what: "depth at this distance" };
        let depth = |curve: DepthCurve| curve.depth(distance).ok_or(lost);
        Ok(DepthRow { distance, depths: [depth(self.curves[0])?, depth(self.curves[1])?], steps })
    }

    /// Returns notes on the whole table: the planes and format, and the distance up to which half
    /// of the range is used. If F is finite, the last note gives the distance N + F − NF/D to which
    /// the chapter's P moves the midpoint D (C48).
    #[must_use]
    pub fn notes(&self) -> Vec<String> {
        let format = match self.format {
            DepthFormat::FixedPoint(bits) => format!("{bits}-bit fixed point"),
            DepthFormat::Float32 => "32-bit floating point".to_owned(),
        };
        let half_range_distance = format_short(self.curves[0].half_range_distance(), 5);
        let planes = [self.near, self.far].map(|distance| format_short(distance, 6));
        let mut notes = vec![
            format!("near {}, far {}, {format}; distances in scene units", planes[0], planes[1]),
            format!("half of the range covers distances up to 2FN/(F+N) = {half_range_distance}"),
        ];
        notes.extend(self.moved_midpoint().map(|[middle, moved]| {
            let [middle, moved] = [middle, moved].map(|distance| format_short(distance, 5));
            format!("P keeps both planes and moves the midpoint from {middle} to {moved}")
        }));
        notes
    }

    /// Returns the midpoint between the planes and the distance to which the chapter's P moves it
    /// before scaling, or `None` for an infinite far plane.
    ///
    /// The chapter's P has the rows (n, 0, 0, 0), (0, n, 0, 0), (0, 0, n + f, −fn), (0, 0, 1, 0):
    /// it maps z to n + f − fn/z, which leaves n and f in place and moves everything between them
    /// away from the eye.
    #[must_use]
    pub fn moved_midpoint(&self) -> Option<[f64; 2]> {
        let midpoint = 0.5 * self.near + 0.5 * self.far;
        let p = chapter::p(-self.near, -self.far).ok()?;
        let moved = p.transform_point(homog::Point::new(0.0, 0.0, -midpoint)).divide()?;
        Some([midpoint, -moved.z()])
    }

    /// Formats rows as plain text with aligned columns.
    ///
    /// The notes come first, one per line, then a blank line and the right-aligned table. All cells
    /// are ASCII, so the byte length is the width.
    #[must_use]
    pub fn to_text(&self, rows: &[DepthRow]) -> String {
        let cells = self.table_cells(rows);
        let widths: Vec<usize> = (0..5)
            .map(|column| cells.iter().map(|row| row[column].len()).max().unwrap_or(0))
            .collect();
        let mut text = self.notes().join("\n") + "\n\n";
        for row in &cells {
            let line: Vec<String> =
                row.iter().zip(&widths).map(|(cell, &width)| format!("{cell:>width$}")).collect();
            let _ = writeln!(text, "{}", line.join("   "));
        }
        text
    }

    /// Formats rows as a Markdown table.
    ///
    /// The notes form a sentence above the table. The table's second line right-aligns all columns.
    #[must_use]
    pub fn to_markdown(&self, rows: &[DepthRow]) -> String {
        let mut text = self.notes().join("; ") + ".\n\n";
        for (number, row) in self.table_cells(rows).iter().enumerate() {
            let _ = writeln!(text, "| {} |", row.join(" | "));
            if number == 0 {
                text += "| ---: | ---: | ---: | ---: | ---: |\n";
            }
        }
        text
    }

    /// Returns the cells of a table, column names first. There is no step at the far plane, because
    /// no depth is farther.
    ///
    /// Depths have four decimals, distances have six significant digits, and steps have three.
    /// Adding 0 turns −0, which would look like a negative depth, into 0.
    pub(super) fn table_cells(&self, rows: &[DepthRow]) -> Vec<[String; 5]> {
        let names = ["distance", "depth", "reversed", "step", "step reversed"].map(str::to_owned);
        let fixed = |depth: f64| format!("{:.4}", depth + 0.0);
        let row = |row: &DepthRow| {
            let is_last = row.distance >= self.far;
            let [step, other] =
                row.steps.map(|step| if is_last { "-".to_owned() } else { format_short(step, 3) });
            let [depth, reversed] = row.depths.map(fixed);
            [format_short(row.distance, 6), depth, reversed, step, other]
        };
        std::iter::once(names).chain(rows.iter().map(row)).collect()
    }

    /// Formats rows as JSON with all digits, for programs. Each column is a list of numbers.
    ///
    /// The keys match the CSV columns; `notes` contains the sentences above the table.
    #[must_use]
    pub fn to_json(&self, rows: &[DepthRow]) -> String {
        let column = |of: fn(&DepthRow) -> f64| -> Vec<f64> { rows.iter().map(of).collect() };
        let json = serde_json::json!({
            "notes": self.notes(),
            "distance": column(|row| row.distance),
            "depth": column(|row| row.depths[0]),
            "reversed_depth": column(|row| row.depths[1]),
            "step": column(|row| row.steps[0]),
            "reversed_step": column(|row| row.steps[1]),
        });
        format!("{json:#}\n")
    }

    /// Formats rows as CSV with all digits, for programs: a header line, then a line per distance.
    ///
    /// Numbers have the fewest digits that parse to the same f64. The step at the far plane is a
    /// number here, not a dash.
    #[must_use]
    pub fn to_csv(&self, rows: &[DepthRow]) -> String {
        let mut text = "distance,depth,reversed_depth,step,reversed_step\n".to_owned();
        for DepthRow { distance, depths: [depth, reversed], steps: [step, other] } in rows {
            let _ = writeln!(text, "{distance},{depth},{reversed},{step},{other}");
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(near: f64, far: f64, convention: Convention, format: DepthFormat) -> DepthTable {
        DepthTable::new(near, far, convention, format).expect("a table")
    }

    /// C68: near 2 and far 40, as printed in the lesson.
    #[test]
    fn the_table_matches_the_lesson() {
        let table = table(2.0, 40.0, Convention::OPENGL, DepthFormat::FixedPoint(24));
        for (distance, printed) in
            [(2.0, "-1.0000"), (3.0, "-0.2982"), (4.0, "0.0526"), (40.0, "1.0000")]
        {
            let row = table.row_at(distance).expect("a row");
            let exact = 21.0 / 19.0 - 80.0 / 19.0 / distance;
            assert!((row.depths[0] - exact).abs() < 1e-12);
            assert_eq!(table.table_cells(&[row])[1][1], printed);
            assert_eq!(row.depths[1], -row.depths[0]);
        }
        assert!(table.notes()[1].ends_with("= 3.8095"), "{:?}", table.notes());
    }

    /// C48: n = −1, f = −3, z = −2 maps to −2.5.
    #[test]
    fn the_midpoint_moves_away_from_the_eye() {
        let one_to_three = table(1.0, 3.0, Convention::CHAPTER, DepthFormat::Float32);
        assert_eq!(one_to_three.moved_midpoint(), Some([2.0, 2.5]));
        let open = table(1.0, f64::INFINITY, Convention::WEBGPU, DepthFormat::Float32);
        assert_eq!(open.moved_midpoint(), None);
        assert_eq!((open.notes().len(), open.distance_range()), (2, [1.0, 1e4]));
    }

    /// ZP-1: a depth step spans a distance of D²(F−N)/(FN) times its fraction of the depth range.
    #[test]
    fn steps_grow_with_the_square_of_the_distance() {
        let table = table(0.1, 1000.0, Convention::WEBGPU, DepthFormat::FixedPoint(24));
        for distance in table.default_distances() {
            let row = table.row_at(distance).expect("a row");
            let expected = distance * distance * 999.9 / 100.0 / 16_777_215.0;
            assert!(row.steps.iter().all(|step| (step / expected - 1.0).abs() < 1e-9), "{row:?}");
        }
        // With floating point, reversed depth is finer by orders of magnitude at large distances.
        let float = DepthTable { format: DepthFormat::Float32, ..table };
        let row = float.row_at(950.0).expect("a row");
        assert!(row.steps[0] > 0.5 && row.steps[1] < 1e-5, "{row:?}");
    }

    #[test]
    fn default_distances_run_from_near_to_far() {
        for (near, far) in [(0.1, 1000.0), (2.0, 40.0), (1.0, 1.001), (3.0, f64::INFINITY)] {
            let table = table(near, far, Convention::WEBGPU, DepthFormat::Float32);
            let distances = table.default_distances();
            assert_eq!([distances[0], distances[distances.len() - 1]], table.distance_range());
            assert!(distances.windows(2).all(|pair| pair[0] < pair[1]), "{distances:?}");
        }
    }

    #[test]
    fn tables_can_be_written_as_text_markdown_and_csv() {
        let table = table(1.0, 4.0, Convention::WEBGPU, DepthFormat::FixedPoint(8));
        let rows: Vec<DepthRow> = [1.0, 2.0].iter().filter_map(|&d| table.row_at(d).ok()).collect();
        assert_eq!(rows.len(), 2);
        let text = table.to_text(&rows);
        assert!(text.contains("distance    depth   reversed"), "{text}");
        let markdown = table.to_markdown(&rows);
        assert!(markdown.contains("| 2 | 0.6667 | 0.3333 |"), "{markdown}");
        let csv = table.to_csv(&rows);
        let numbers = csv.lines().nth(2).expect("a line").split(',').nth(1).expect("a number");
        assert_eq!(numbers.parse::<f64>().ok(), Some(rows[1].depths[0]));
    }
}
