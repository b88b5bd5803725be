//! Clips pages: removes the lines inside or outside a rectangle.
//!
//! ```text
//!   ───────┌┄┄┄┄┄┄┄┄┐───────   erased inside, to make room for another view
//!          └┄┄┄┄┄┄┄┄┘
//! ```
//!
//! Filled areas, such as arrowheads, are small. They are kept or removed as a whole.

use super::page::{GroupContent, Page, PagePoint, Polyline, to_micrometers};
use glam::DVec2;

/// The parts of lines that are kept.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Keep {
    /// The parts inside the rectangle, including its border.
    Inside,
    /// The parts outside it, including its border.
    Outside,
}

/// A rectangle on the page in micrometers, as its upper left and lower right corners.
type PageRect = [PagePoint; 2];

impl<W> Page<W> {
    /// Erases the lines inside a rectangle between two corners in millimeters. Images stay.
    ///
    /// ```
    /// use page::{Group, Layer, Page, Pen, Polyline};
    /// use glam::DVec2;
    ///
    /// let mut page: Page = Page::new(DVec2::new(40.0, 30.0), "a line", None);
    /// let mut layer = Layer::new("lines", "lines", Pen::solid(0.5, [0, 0, 0]));
    /// let line = Polyline::through_points(&[DVec2::new(5.0, 5.0), DVec2::new(35.0, 5.0)], false);
    /// layer.groups.push(Group { strokes: line.into_iter().collect(), ..Group::default() });
    /// page.layers.push(layer);
    /// page.erase_rectangle(DVec2::new(10.0, 0.0), DVec2::new(20.0, 10.0));
    /// let lengths: Vec<f64> =
    ///     page.layers[0].groups[0].strokes.iter().map(Polyline::length).collect();
    /// assert_eq!(lengths, [5.0, 15.0]);
    /// ```
    pub fn erase_rectangle(&mut self, low: DVec2, high: DVec2) {
        self.clip_layers([low, high].map(to_micrometers), Keep::Outside);
    }

    /// Removes the parts of lines that are off the page.
    pub fn crop_to_border(&mut self) {
        self.clip_layers([DVec2::ZERO, self.size].map(to_micrometers), Keep::Inside);
    }

    /// Clips all layers and removes those that become empty.
    fn clip_layers(&mut self, rect: PageRect, keep: Keep) {
        for group in self.layers.iter_mut().flat_map(|layer| &mut layer.groups) {
            let strokes: Vec<Polyline> =
                group.strokes.iter().flat_map(|line| clip(line, rect, keep)).collect();
            if strokes != group.strokes {
                // Clipping turns text into lines and changes the outline of hatching.
                group.content = GroupContent::Lines;
                group.strokes = strokes;
            }
            group.fills.retain(|area| keeps_area(area, rect, keep));
        }
        for layer in &mut self.layers {
            layer.groups.retain(|group| !group.strokes.is_empty() || !group.fills.is_empty());
        }
        self.layers.retain(|layer| !layer.groups.is_empty());
    }
}

/// Returns whether a filled area is kept: with `Inside`, if it is entirely in the rectangle; with
/// `Outside`, if it is entirely outside.
fn keeps_area(area: &Polyline, [low, high]: PageRect, keep: Keep) -> bool {
    let on_axis = |axis: usize| {
        let at = || area.points.iter().map(move |point| point[axis]);
        let (least, most) = (at().min().unwrap_or(0), at().max().unwrap_or(0));
        match keep {
            Keep::Inside => least >= low[axis] && most <= high[axis],
            Keep::Outside => least >= high[axis] || most <= low[axis],
        }
    };
    match keep {
        Keep::Inside => on_axis(0) && on_axis(1),
        Keep::Outside => on_axis(0) || on_axis(1),
    }
}

/// Returns the parts of a line that are kept, or the line itself if it is kept whole.
fn clip(line: &Polyline, rect: PageRect, keep: Keep) -> Vec<Polyline> {
    let closing = line.closed.then(|| [line.points[line.points.len() - 1], line.points[0]]);
    let sides = line.points.windows(2).map(|pair| [pair[0], pair[1]]).chain(closing);
    let parts: Vec<[PagePoint; 2]> =
        sides.clone().flat_map(|side| kept_parts(side, rect, keep)).collect();
    if sides.eq(parts.iter().copied()) {
        return vec![line.clone()];
    }
    let mut clipped: Vec<Polyline> = Vec::new();
    for [from, to] in parts {
        match clipped.last_mut() {
            Some(run) if run.points.last() == Some(&from) => run.points.push(to),
            _ => clipped.push(Polyline { points: vec![from, to], closed: false }),
        }
    }
    clipped
}

/// Returns the parts of a side that are kept, in the direction of the side.
fn kept_parts(side: [PagePoint; 2], rect: PageRect, keep: Keep) -> Vec<[PagePoint; 2]> {
    let inside = inside_interval(side, rect, keep == Keep::Inside);
    let intervals = match (keep, inside) {
        (Keep::Inside, None) => Vec::new(),
        (Keep::Inside, Some(interval)) => vec![interval],
        (Keep::Outside, None) => vec![[0.0, 1.0]],
        (Keep::Outside, Some([from, to])) => vec![[0.0, from], [to, 1.0]],
    };
    let parts = intervals.into_iter().map(|interval| interval.map(|t| point_on(side, t)));
    parts.filter(|[from, to]| from != to).collect()
}

/// Returns the point at a fraction of a side. The ends are exact.
fn point_on([from, to]: [PagePoint; 2], t: f64) -> PagePoint {
    if t == 1.0 {
        return to;
    }
    [0, 1].map(|axis| {
        let span = f64::from(to[axis]) - f64::from(from[axis]);
        libm::round(f64::from(from[axis]) + span * t) as i32
    })
}

/// Returns the interval of fractions in which a side is inside the rectangle (Liang–Barsky), or
/// `None` if it is outside. If `closed`, the border counts as inside.
fn inside_interval(
    [from, to]: [PagePoint; 2],
    [low, high]: PageRect,
    closed: bool,
) -> Option<[f64; 2]> {
    let (mut start, mut end) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        let at = f64::from(from[axis]);
        let [low, high] = [low[axis], high[axis]].map(f64::from);
        let span = f64::from(to[axis]) - at;
        if span == 0.0 {
            let is_outside = if closed { at < low || at > high } else { at <= low || at >= high };
            if is_outside {
                return None;
            }
            continue;
        }
        let [a, b] = [(low - at) / span, (high - at) / span];
        (start, end) = (start.max(a.min(b)), end.min(a.max(b)));
    }
    (start < end).then_some([start, end])
}

#[cfg(test)]
mod tests {
    use super::*;

    const RECT: PageRect = [[10, 10], [30, 20]];

    fn open(points: &[PagePoint]) -> Polyline {
        Polyline { points: points.to_vec(), closed: false }
    }

    #[test]
    fn parts_inside_and_outside_add_up_to_the_line() {
        let line = open(&[[0, 15], [20, 15], [20, 40]]);
        let inside = open(&[[10, 15], [20, 15], [20, 20]]);
        assert_eq!(clip(&line, RECT, Keep::Inside), [inside]);
        let outside = [open(&[[0, 15], [10, 15]]), open(&[[20, 20], [20, 40]])];
        assert_eq!(clip(&line, RECT, Keep::Outside), outside);
    }

    #[test]
    fn both_modes_keep_lines_on_the_border() {
        let border =
            Polyline { points: vec![[10, 10], [30, 10], [30, 20], [10, 20]], closed: true };
        for keep in [Keep::Inside, Keep::Outside] {
            assert_eq!(clip(&border, RECT, keep), std::slice::from_ref(&border));
        }
        let around = Polyline { points: vec![[0, 0], [40, 0], [40, 30], [0, 30]], closed: true };
        assert_eq!(clip(&around, RECT, Keep::Outside), std::slice::from_ref(&around));
        assert_eq!(clip(&around, RECT, Keep::Inside), []);
    }

    #[test]
    fn areas_are_kept_or_removed_as_a_whole() {
        let area =
            |x: i32| Polyline { points: vec![[x, 12], [x + 4, 12], [x + 2, 16]], closed: true };
        for (x, inside, outside) in
            [(12, true, false), (8, false, false), (40, false, true), (30, false, true)]
        {
            assert_eq!(keeps_area(&area(x), RECT, Keep::Inside), inside, "{x}");
            assert_eq!(keeps_area(&area(x), RECT, Keep::Outside), outside, "{x}");
        }
    }
}
