//! A lint for sheets: text does not touch other text or lines, and everything is inside the frame.

use glam::DVec2;
use page::{Group, GroupContent, Polyline, to_millimeters};
use sheet::SheetPage;

/// A rectangle, as its minimum and maximum corners.
pub type Extent = [DVec2; 2];

/// Whether a layer contains text.
fn is_text_layer(id: &str) -> bool {
    const TEXTS: [&str; 12] = [
        "frame-zone-names",
        "dimensions-text",
        "cut-names",
        "other-scale",
        "overlay-text",
        "balloon-numbers",
        "parts-list-text",
        "view-names",
        "scale-bar-text",
        "title-block-names",
        "title-block-title",
        "title-block-text",
    ];
    TEXTS.contains(&id) || id.starts_with("title-block-text-")
}

/// Returns the rectangle around lines, or `None` if there are none.
pub fn extent<'a>(lines: impl Iterator<Item = &'a Polyline>) -> Option<Extent> {
    let points = lines.flat_map(|line| &line.points).copied().map(to_millimeters);
    points.fold(None, |extent: Option<Extent>, p| {
        Some(extent.map_or([p; 2], |[low, high]| [low.min(p), high.max(p)]))
    })
}

/// Returns the extent of the selected layers.
pub fn layer_extent(page: &SheetPage, wanted: impl Fn(&str) -> bool) -> Option<Extent> {
    let layers = page.layers.iter().filter(|layer| wanted(&layer.id));
    extent(layers.flat_map(|layer| &layer.groups).flat_map(|g| g.strokes.iter().chain(&g.fills)))
}

/// Returns the segments of a polyline.
fn sides(line: &Polyline) -> impl Iterator<Item = [DVec2; 2]> {
    let count = line.points.len();
    let sides = if line.closed { count } else { count - 1 };
    (0..sides).map(move |k| [k, (k + 1) % count].map(|at| to_millimeters(line.points[at])))
}

/// Whether two convex outlines are separated along the normal of one of their sides.
fn are_apart(a: &[DVec2], b: &[DVec2]) -> bool {
    let normals = |points: &[DVec2]| -> Vec<DVec2> {
        let sides = (0..points.len()).map(|k| points[(k + 1) % points.len()] - points[k]);
        sides.filter_map(|side| side.perp().try_normalize()).collect()
    };
    let reach = |points: &[DVec2], axis: DVec2| {
        let along = points.iter().map(|point| point.dot(axis));
        along.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], at| [l.min(at), h.max(at)])
    };
    normals(a).into_iter().chain(normals(b)).any(|axis| {
        let ([low, high], [other_low, other_high]) = (reach(a, axis), reach(b, axis));
        high <= other_low || other_high <= low
    })
}

/// Returns the corners of the rectangle around text, with a margin. The rectangle is slanted if the
/// text is.
fn text_outline(group: &Group, margin: f64) -> Option<Vec<DVec2>> {
    let [low, high] = extent(group.strokes.iter())?;
    if let GroupContent::Text(line) = &group.content {
        let [start, end] = line.baseline.map(to_millimeters);
        let along = (end - start).normalize_or(DVec2::X);
        if along.x.abs() > 1e-3 && along.y.abs() > 1e-3 {
            let up = DVec2::new(along.y, -along.x);
            let height = f64::from(line.height) / 1000.0 + margin;
            let (start, end) = (start - along * margin, end + along * margin);
            let corners =
                [start - up * margin, end - up * margin, end + up * height, start + up * height];
            return Some(corners.to_vec());
        }
    }
    let (low, high) = (low - margin, high + margin);
    Some(vec![low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)])
}

/// Describes the faults in a sheet. Returns an empty list if there are none.
pub fn faults(page: &SheetPage) -> Vec<String> {
    let mut faults = Vec::new();
    let mut texts: Vec<(&str, Vec<DVec2>)> = Vec::new();
    for layer in page.layers.iter().filter(|layer| is_text_layer(&layer.id)) {
        let half = 0.5 * layer.pen.width;
        let outlines = layer.groups.iter().filter_map(|group| text_outline(group, half));
        texts.extend(outlines.map(|outline| (layer.id.as_str(), outline)));
    }
    for (index, (id, area)) in texts.iter().enumerate() {
        for (other_id, other) in &texts[index + 1..] {
            if !are_apart(area, other) {
                faults.push(format!("{id} at {} touches {other_id} at {}", area[0], other[0]));
            }
        }
    }
    for layer in page.layers.iter().filter(|layer| !is_text_layer(&layer.id)) {
        let half = 0.5 * layer.pen.width;
        let lines = layer.groups.iter().flat_map(|group| group.strokes.iter().chain(&group.fills));
        for [a, b] in lines.flat_map(sides) {
            // The outline of the line, including its width.
            let across = (b - a).perp().normalize_or_zero() * half;
            let line = [a + across, b + across, b - across, a - across];
            for (id, area) in &texts {
                if !are_apart(&line, area) {
                    faults.push(format!("{id} at {} touches {} at {a}", area[0], layer.id));
                }
            }
        }
    }
    let inside = layer_extent(page, |id| !id.starts_with("frame"));
    let frame = page.layers.iter().find(|layer| layer.id == "frame").expect("a frame");
    let frame = extent(frame.groups[0].strokes[..1].iter()).expect("a frame");
    if inside.is_some_and(|[low, high]| low.cmplt(frame[0]).any() || high.cmpgt(frame[1]).any()) {
        faults.push(format!("{inside:?} is not within the frame {frame:?}"));
    }
    faults.dedup();
    faults
}
