//! A lint of sheets: no text touches another text or a line, and all of it lies within the frame.

use drawing::{Page, Polyline, to_millimeters};
use glam::DVec2;

/// A rectangle by its least and its greatest corner.
pub type Extent = [DVec2; 2];

/// The layers whose groups are texts.
fn is_text_layer(id: &str) -> bool {
    const TEXTS: [&str; 7] = [
        "dimensions-text",
        "cut-names",
        "other-scale",
        "scale-bar-text",
        "title-block-names",
        "title-block-title",
        "title-block-text",
    ];
    TEXTS.contains(&id)
}

/// The rectangle around lines, `None` without any.
fn extent<'a>(lines: impl Iterator<Item = &'a Polyline>) -> Option<Extent> {
    let points = lines.flat_map(|line| &line.points).copied().map(to_millimeters);
    points.fold(None, |extent: Option<Extent>, p| {
        Some(extent.map_or([p; 2], |[low, high]| [low.min(p), high.max(p)]))
    })
}

/// The extent of the layers that a test chooses.
pub fn layer_extent(page: &Page, wanted: impl Fn(&str) -> bool) -> Option<Extent> {
    let layers = page.layers.iter().filter(|layer| wanted(&layer.id));
    extent(layers.flat_map(|layer| &layer.groups).flat_map(|g| g.strokes.iter().chain(&g.fills)))
}

/// The sides of a polyline.
fn sides(line: &Polyline) -> impl Iterator<Item = [DVec2; 2]> {
    let count = line.points.len();
    let sides = if line.closed { count } else { count - 1 };
    (0..sides).map(move |k| [k, (k + 1) % count].map(|at| to_millimeters(line.points[at])))
}

/// Whether a side comes into a rectangle.
fn crosses([a, b]: [DVec2; 2], [low, high]: Extent) -> bool {
    let mut span = [0.0_f64, 1.0_f64];
    for axis in 0..2 {
        let (from, step) = (a[axis], b[axis] - a[axis]);
        if step == 0.0 {
            if from <= low[axis] || from >= high[axis] {
                return false;
            }
            continue;
        }
        let (s, t) = ((low[axis] - from) / step, (high[axis] - from) / step);
        span = [span[0].max(s.min(t)), span[1].min(s.max(t))];
    }
    span[0] < span[1]
}

/// Faults of a sheet, in words; empty if nothing is.
pub fn faults(page: &Page) -> Vec<String> {
    let mut faults = Vec::new();
    let mut texts: Vec<(&str, Extent)> = Vec::new();
    for layer in page.layers.iter().filter(|layer| is_text_layer(&layer.id)) {
        let half = DVec2::splat(0.5 * layer.pen.width);
        let groups = layer.groups.iter().filter_map(|group| extent(group.strokes.iter()));
        texts.extend(groups.map(|[low, high]| (layer.id.as_str(), [low - half, high + half])));
    }
    for (index, (id, area)) in texts.iter().enumerate() {
        for (other_id, other) in &texts[index + 1..] {
            let apart = area[1].cmple(other[0]).any() || other[1].cmple(area[0]).any();
            if !apart {
                faults.push(format!("{id} at {} touches {other_id} at {}", area[0], other[0]));
            }
        }
    }
    for layer in page.layers.iter().filter(|layer| !is_text_layer(&layer.id)) {
        let half = DVec2::splat(0.5 * layer.pen.width);
        let lines = layer.groups.iter().flat_map(|group| group.strokes.iter().chain(&group.fills));
        for side in lines.flat_map(sides) {
            for (id, [low, high]) in &texts {
                if crosses(side, [*low - half, *high + half]) {
                    faults.push(format!("{id} at {low} touches {} at {}", layer.id, side[0]));
                }
            }
        }
    }
    let inside = layer_extent(page, |id| id != "frame");
    let frame = page.layers.iter().find(|layer| layer.id == "frame").expect("a frame");
    let frame = extent(frame.groups[0].strokes[..1].iter()).expect("a frame");
    if inside.is_some_and(|[low, high]| low.cmplt(frame[0]).any() || high.cmpgt(frame[1]).any()) {
        faults.push(format!("{inside:?} is not within the frame {frame:?}"));
    }
    faults.dedup();
    faults
}
