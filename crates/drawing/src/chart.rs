//! Charts: curves over linear or logarithmic axes, drawn as strokes on a page.
//!
//! ```text
//!   depth    ── normal   - - reversed
//!   1 ┤        ______─────      ticks are round numbers: powers of ten times 1, 2 and 5,
//!     │    _-¯                  or only powers of ten on an axis that spans many
//!   0 ┼──┬─────┬─────┬──
//!        1    10    100  distance
//! ```

mod axis;

pub use axis::{Axis, Spacing};

use axis::format_tick;
use glam::DVec2;
use page::palette::{INK, LIGHT_GRAY};
use page::{Cap, Group, Ink, Join, Label, Layer, LineType, Pen, Polyline, TextAlign};

/// The height of characters in millimeters.
const LETTER_HEIGHT: f64 = 2.2;
/// The length of a tick in millimeters.
const TICK_LENGTH: f64 = 1.0;

/// The line width of curves in millimeters.
const CURVE_WIDTH: f64 = 0.35;
/// The line width of axes and grid in millimeters.
const AXIS_WIDTH: f64 = 0.13;

/// The length of the line sample in the legend, in millimeters.
const LEGEND_SAMPLE: f64 = 9.0;

/// A chart: two axes, curves, and marked values.
///
/// ```
/// use drawing::{Axis, Chart, Curve, Spacing};
/// use page::palette;
/// use glam::DVec2;
///
/// let spacing = Spacing::Linear;
/// let axis = |title: &str, from, to| Axis { title: title.into(), from, to, spacing };
/// let parabola = (0..=20).map(|n| f64::from(n) / 10.0).map(|x| [x, x * x]).collect();
/// let chart = Chart {
///     id: "parabola".into(),
///     x: axis("x", 0.0, 2.0),
///     y: axis("x²", 0.0, 4.0),
///     curves: vec![Curve {
///         id: "curve".into(),
///         title: "x²".into(),
///         ink: palette::BLUE,
///         dashed: false,
///         points: parabola,
///     }],
///     marks: Vec::new(),
/// };
/// let layers = chart.to_layers(DVec2::new(20.0, 20.0), DVec2::new(100.0, 60.0));
/// assert!(layers.iter().any(|layer| layer.id == "parabola-curve"));
/// ```
#[derive(Clone, PartialEq, Debug)]
pub struct Chart {
    /// An identifier, unique on its page, in lower case with hyphens.
    pub id: String,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// The curves, drawn in this order.
    pub curves: Vec<Curve>,
    /// Marked values on the x axis.
    pub marks: Vec<AxisMark>,
}

/// A curve of a chart.
#[derive(Clone, PartialEq, Debug)]
pub struct Curve {
    /// An identifier, unique in its chart.
    pub id: String,
    /// The name in the legend.
    pub title: String,
    /// The color.
    pub ink: Ink,
    /// Whether the curve is dashed, so that a curve under it shows through.
    pub dashed: bool,
    /// The points of the curve, in units of the axes; clamped to the axis ranges.
    pub points: Vec<[f64; 2]>,
}

/// A value on the x axis with a note.
#[derive(Clone, PartialEq, Debug)]
pub struct AxisMark {
    /// The value.
    pub value: f64,
    /// The note.
    pub text: String,
}

/// A chart placed on a page.
#[derive(Clone, Copy)]
struct Plot<'a> {
    chart: &'a Chart,
    /// The upper left corner in millimeters.
    corner: DVec2,
    /// Width and height in millimeters.
    size: DVec2,
}

impl Chart {
    /// Returns the layers of the chart. Its axes span the rectangle with the given upper left
    /// corner and size, in millimeters. Tick labels, axis titles and the legend are outside it.
    #[must_use]
    pub fn to_layers(&self, corner: DVec2, size: DVec2) -> Vec<Layer> {
        let plot = Plot { chart: self, corner, size };
        let mut layers =
            vec![plot.grid_layer(), plot.axes_layer(), plot.marks_layer(), plot.text_layer()];
        let curves = self.curves.iter().enumerate();
        layers.extend(curves.map(|(index, curve)| plot.curve_layer(index, curve)));
        layers.retain(|layer| layer.groups.iter().any(|group| !group.strokes.is_empty()));
        layers
    }
}

impl Plot<'_> {
    /// Returns a layer of the chart that contains the given strokes.
    fn plot_layer(&self, id: &str, title: &str, pen: Pen, strokes: Vec<Polyline>) -> Layer {
        let mut layer = Layer::new(format!("{}-{id}", self.chart.id), title, pen);
        layer.groups.push(Group { strokes, ..Group::default() });
        layer
    }

    /// Returns the x coordinate on the page of a value on the x axis.
    fn page_x(&self, value: f64) -> f64 {
        self.corner.x + self.chart.x.fraction_at(value) * self.size.x
    }

    /// Returns the y coordinate on the page of a value on the y axis.
    fn page_y(&self, value: f64) -> f64 {
        self.corner.y + (1.0 - self.chart.y.fraction_at(value)) * self.size.y
    }

    /// Returns the x coordinate of the right edge of the plot.
    fn right_edge(&self) -> f64 {
        self.corner.x + self.size.x
    }

    /// Returns the y coordinate of the bottom edge of the plot.
    fn bottom_edge(&self) -> f64 {
        self.corner.y + self.size.y
    }

    /// Returns a vertical line across the full height of the plot.
    fn vertical_line(&self, x: f64) -> Option<Polyline> {
        Polyline::through_points(
            &[DVec2::new(x, self.corner.y), DVec2::new(x, self.bottom_edge())],
            false,
        )
    }

    /// Returns a layer with grid lines at all ticks.
    fn grid_layer(&self) -> Layer {
        let uprights =
            self.chart.x.ticks().into_iter().filter_map(|x| self.vertical_line(self.page_x(x)));
        let levels = self.chart.y.ticks().into_iter().filter_map(|y| {
            let y = self.page_y(y);
            let ends = [DVec2::new(self.corner.x, y), DVec2::new(self.right_edge(), y)];
            Polyline::through_points(&ends, false)
        });
        let strokes = uprights.chain(levels).collect();
        self.plot_layer("grid", "grid", Pen::solid(AXIS_WIDTH, LIGHT_GRAY), strokes)
    }

    /// Returns a layer with the two axes and their ticks.
    fn axes_layer(&self) -> Layer {
        let (low, far) = (DVec2::new(self.corner.x, self.bottom_edge()), self.right_edge());
        let cross = [self.corner, low, DVec2::new(far, low.y)];
        let ticks_x = self.chart.x.ticks().into_iter().filter_map(|x| {
            let at = DVec2::new(self.page_x(x), low.y);
            Polyline::through_points(&[at, at + DVec2::new(0.0, TICK_LENGTH)], false)
        });
        let ticks_y = self.chart.y.ticks().into_iter().filter_map(|y| {
            let at = DVec2::new(low.x, self.page_y(y));
            Polyline::through_points(&[at, at - DVec2::new(TICK_LENGTH, 0.0)], false)
        });
        let strokes =
            Polyline::through_points(&cross, false).into_iter().chain(ticks_x).chain(ticks_y);
        self.plot_layer("axes", "axes", Pen::solid(AXIS_WIDTH, INK), strokes.collect())
    }

    /// Returns a layer with dashed lines at the marked values.
    fn marks_layer(&self) -> Layer {
        let lines =
            self.chart.marks.iter().filter_map(|mark| self.vertical_line(self.page_x(mark.value)));
        let pen = LineType::Dashed.to_pen(AXIS_WIDTH, INK, Cap::Butt, Join::Round);
        self.plot_layer("marks", "marked values", pen, lines.collect())
    }

    /// Returns a layer with the tick labels, axis titles, notes and curve names.
    fn text_layer(&self) -> Layer {
        let mut strokes = Vec::new();
        let mut write = |text: &str, at: DVec2, align: TextAlign| {
            strokes.extend(Label::new(text, at, LETTER_HEIGHT).with_align(align).strokes());
        };
        let below = self.bottom_edge() + TICK_LENGTH + LETTER_HEIGHT * 1.6;
        for x in self.chart.x.ticks() {
            write(&format_tick(x), DVec2::new(self.page_x(x), below), TextAlign::Middle);
        }
        for y in self.chart.y.ticks() {
            let at =
                DVec2::new(self.corner.x - TICK_LENGTH - 1.0, self.page_y(y) + LETTER_HEIGHT * 0.5);
            write(&format_tick(y), at, TextAlign::End);
        }
        let title = DVec2::new(self.right_edge(), below + LETTER_HEIGHT * 1.7);
        write(&self.chart.x.title, title, TextAlign::End);
        let above = self.corner.y - LETTER_HEIGHT;
        write(&self.chart.y.title, DVec2::new(self.corner.x, above), TextAlign::Start);
        for mark in &self.chart.marks {
            let is_left = self.chart.x.fraction_at(mark.value) < 0.5;
            let (by, align) =
                if is_left { (1.5, TextAlign::Start) } else { (-1.5, TextAlign::End) };
            let at = DVec2::new(self.page_x(mark.value) + by, self.corner.y + LETTER_HEIGHT * 1.8);
            write(&mark.text, at, align);
        }
        for (index, curve) in self.chart.curves.iter().enumerate() {
            write(
                &curve.title,
                self.legend_point(index) + DVec2::new(LEGEND_SAMPLE + 1.5, 0.0),
                TextAlign::Start,
            );
        }
        self.plot_layer("text", "numbers and labels", Pen::solid(LETTER_HEIGHT * 0.1, INK), strokes)
    }

    /// Returns the start of a curve's legend entry, on the baseline. The legend is right-aligned
    /// above the plot.
    fn legend_point(&self, index: usize) -> DVec2 {
        let names = self.chart.curves.iter().skip(index);
        let width = |curve: &Curve| {
            let name = Label::new(&curve.title, DVec2::ZERO, LETTER_HEIGHT);
            LEGEND_SAMPLE + 1.5 + name.width() + 5.0
        };
        DVec2::new(
            self.right_edge() + 5.0 - names.map(width).sum::<f64>(),
            self.corner.y - LETTER_HEIGHT,
        )
    }

    /// Returns the layer of a curve, including its legend sample.
    fn curve_layer(&self, index: usize, curve: &Curve) -> Layer {
        let on_page = |&[x, y]: &[f64; 2]| DVec2::new(self.page_x(x), self.page_y(y));
        let points: Vec<DVec2> = curve.points.iter().map(on_page).collect();
        let sample = self.legend_point(index) - DVec2::new(0.0, LETTER_HEIGHT * 0.5);
        let sample = [sample, sample + DVec2::new(LEGEND_SAMPLE, 0.0)];
        let line = Polyline::through_points(&points, false);
        let strokes = line.into_iter().chain(Polyline::through_points(&sample, false)).collect();
        let line_type = if curve.dashed { LineType::Dashed } else { LineType::Continuous };
        let pen = line_type.to_pen(CURVE_WIDTH, curve.ink, Cap::Butt, Join::Round);
        self.plot_layer(&curve.id, &curve.title, pen, strokes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use page::to_millimeters;

    #[test]
    fn curve_points_map_through_the_axes() {
        let axis = |from: f64, to: f64, spacing| Axis { title: "t".to_owned(), from, to, spacing };
        let chart = Chart {
            id: "c".to_owned(),
            x: axis(1.0, 100.0, Spacing::Logarithmic),
            y: axis(-1.0, 1.0, Spacing::Linear),
            curves: vec![Curve {
                id: "k".to_owned(),
                title: "k".to_owned(),
                ink: [0; 3],
                dashed: false,
                points: vec![[1.0, -1.0], [10.0, 0.5], [100.0, 1.0]],
            }],
            marks: vec![AxisMark { value: 10.0, text: "ten".to_owned() }],
        };
        let layers = chart.to_layers(DVec2::new(20.0, 30.0), DVec2::new(100.0, 40.0));
        let of = |id: &str| layers.iter().find(|layer| layer.id == id).expect(id);
        let points = &of("c-k").groups[0].strokes[0].points;
        let actual: Vec<[f64; 2]> = points.iter().map(|p| to_millimeters(*p).to_array()).collect();
        assert_eq!(actual, [[20.0, 70.0], [70.0, 40.0], [120.0, 30.0]]);
        let mark = to_millimeters(of("c-marks").groups[0].strokes[0].points[0]);
        assert_eq!(mark, DVec2::new(70.0, 30.0));
    }
}
