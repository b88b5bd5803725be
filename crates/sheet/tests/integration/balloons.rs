//! A lint for assembly pages: balloons do not touch each other, contain their numbers, and have
//! nothing drawn over them.

use super::lint::{Extent, layer_extent};
use glam::DVec2;
use page::{GroupContent, Layer, Polyline, to_millimeters};
use sheet::SheetPage;

/// Returns the circle through the corners of a polygon: its center and radius.
fn circle_of(line: &Polyline) -> (DVec2, f64) {
    let corners = || line.points.iter().copied().map(to_millimeters);
    let center = corners().sum::<DVec2>() / line.points.len() as f64;
    (center, corners().map(|corner| (corner - center).length()).fold(0.0, f64::max))
}

/// Returns the distance from a point to a segment.
fn distance(point: DVec2, [a, b]: [DVec2; 2]) -> f64 {
    let along = b - a;
    let t = ((point - a).dot(along) / along.length_squared().max(1e-12)).clamp(0.0, 1.0);
    (point - a - along * t).length()
}

/// Returns the straight segments of a line.
fn pieces(line: &Polyline) -> impl Iterator<Item = [DVec2; 2]> {
    let count = line.points.len();
    let pieces = if line.closed { count } else { count - 1 };
    (0..pieces).map(move |k| [k, (k + 1) % count].map(|at| to_millimeters(line.points[at])))
}

/// Returns the layer with an id, if the page has it.
pub fn layer<'a>(page: &'a SheetPage, id: &str) -> Option<&'a Layer> {
    page.layers.iter().find(|layer| layer.id == id)
}

/// Returns the text of a layer.
pub fn texts(page: &SheetPage, id: &str) -> Vec<String> {
    let groups = layer(page, id).into_iter().flat_map(|layer| &layer.groups);
    let text = |content: &GroupContent| match content {
        GroupContent::Text(line) => Some(line.text.clone()),
        _ => None,
    };
    groups.filter_map(|group| text(&group.content)).collect()
}

/// Describes the faults in the balloons on a page.
pub fn balloon_faults(page: &SheetPage) -> Vec<String> {
    let Some(balloons) = layer(page, "balloons") else { return Vec::new() };
    let mut faults = Vec::new();
    let circles: Vec<(&str, DVec2, f64)> = balloons
        .groups
        .iter()
        .map(|group| {
            let (center, radius) = circle_of(&group.strokes[0]);
            (group.id.as_str(), center, radius + 0.5 * balloons.pen.width)
        })
        .collect();
    if texts(page, "balloon-numbers") != circles.iter().map(|(id, ..)| *id).collect::<Vec<_>>() {
        faults.push("the numbers do not match the balloons".to_owned());
    }
    for (index, (id, center, radius)) in circles.iter().enumerate() {
        for (other_id, other, other_radius) in &circles[index + 1..] {
            if (*center - *other).length() < radius + other_radius {
                faults.push(format!("balloon {id} touches {other_id}"));
            }
        }
        let numbers = &layer(page, "balloon-numbers").expect("numbers").groups[index];
        let ink = numbers.strokes.iter().flat_map(|line| &line.points);
        if ink.copied().map(to_millimeters).any(|p| (p - *center).length() > radius - 0.4) {
            faults.push(format!("the number of balloon {id} touches its circle"));
        }
        for layer in &page.layers {
            for group in &layer.groups {
                let is_own =
                    layer.id == "balloon-numbers" || layer.id == "balloons" && group.id == *id;
                let lines = group.strokes.iter().chain(&group.fills).flat_map(pieces);
                let near = radius + 0.5 * layer.pen.width;
                if !is_own && lines.into_iter().any(|piece| distance(*center, piece) < near) {
                    faults.push(format!("balloon {id} touches {} {}", layer.id, group.id));
                }
            }
        }
    }
    faults
}

/// Describes which leaders on a page cross.
pub fn crossing_leaders(page: &SheetPage) -> Vec<String> {
    let Some(balloons) = layer(page, "balloons") else { return Vec::new() };
    let leaders: Vec<(&str, [DVec2; 2])> = balloons
        .groups
        .iter()
        .filter_map(|group| group.strokes.get(1).map(|line| (group.id.as_str(), line)))
        .flat_map(|(id, line)| pieces(line).map(move |piece| (id, piece)))
        .collect();
    let side = |[a, b]: [DVec2; 2], p: DVec2| (b - a).perp_dot(p - a);
    let mut faults = Vec::new();
    for (index, (id, a)) in leaders.iter().enumerate() {
        for (other, b) in &leaders[index + 1..] {
            let apart =
                side(*a, b[0]) * side(*a, b[1]) >= 0.0 || side(*b, a[0]) * side(*b, a[1]) >= 0.0;
            if !apart {
                faults.push(format!("the leaders of {id} and {other} cross"));
            }
        }
    }
    faults
}

/// Returns the extent of the assembly view.
pub fn view_extent(page: &SheetPage) -> Option<Extent> {
    layer_extent(page, |id| id.starts_with("assembly-") || id.starts_with("exploded-"))
}
