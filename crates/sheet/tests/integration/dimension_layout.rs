//! Many dimensions on many sheets: numbers do not touch anything, and dimensions that do not fit
//! are reported.

use super::boxes::{PAPERS, Random, box_model, plane, sheet};
use super::dimensions::dimension;
use super::lint::faults;
use glam::DVec3;
use hidden_line::WorldCircle;
use homog::{Point, Vector, World};
use projection::SheetAngle;
use sheet::{Dimension, LengthDirection, Measure, Sheet, SheetWarning};

/// Returns a random point in a box.
fn within(random: &mut Random, size: DVec3) -> Point<World> {
    Point::from_raw(size * DVec3::from([(); 3].map(|()| random.fraction() - 0.5)))
}

/// Returns a random measure in a box.
fn measure(random: &mut Random, number: usize, size: DVec3) -> Measure {
    let direction = [
        LengthDirection::Horizontal,
        LengthDirection::Vertical,
        LengthDirection::Horizontal,
        LengthDirection::Aligned,
    ][number % 4];
    let mut points: Vec<Point<World>> = (0..2 + number % 5).map(|_| within(random, size)).collect();
    if direction == LengthDirection::Aligned {
        // All points have one coordinate in common, so that a view shows the lengths at true size.
        let depth = points[0].raw()[number % 3];
        for point in &mut points {
            let mut moved = point.raw();
            moved[number % 3] = depth;
            *point = Point::from_raw(moved);
        }
    }
    let circle = WorldCircle {
        center: points[0],
        axis: [Vector::X, Vector::Y, Vector::Z][number % 3],
        radius: size.min_element() * random.fraction() * 0.3,
        sweep: core::f64::consts::TAU,
    };
    match number % 7 {
        0 | 1 => Measure::Chain(points[..2].to_vec(), direction),
        2 => Measure::Chain(points, direction),
        3 => Measure::Baseline(points, direction),
        4 => Measure::Diameter(circle),
        5 => Measure::Radius(circle),
        _ => {
            let vertex = points[0].raw();
            let (s, t) = ([1, 2, 0][number % 3], [2, 0, 1][number % 3]);
            let side = |a: f64, b: f64| {
                let mut end = vertex;
                end[s] += size.min_element() * a;
                end[t] += size.min_element() * b;
                Point::from_raw(end)
            };
            Measure::Angle([points[0], side(0.5, 0.1), side(random.fraction() - 0.5, 0.4)])
        }
    }
}

#[test]
fn numbers_touch_nothing_on_sheets_with_random_dimensions() {
    let mut random = Random(129);
    let (mut asked, mut left_out, mut messages) = (0, 0, Vec::new());
    for number in 0..120 {
        let (paper, name) = PAPERS[number % 8];
        let paper = if number % 2 == 0 { paper.rotated() } else { paper };
        let angle = if number % 3 == 0 { SheetAngle::Third } else { SheetAngle::First };
        let size = DVec3::from([(); 3].map(|()| 20.0 + 180.0 * random.fraction()));
        let count = 1 + number % 12;
        let measures: Vec<Dimension> = (0..count)
            .map(|k| {
                let name = format!("dimension {}", k + 1);
                Dimension { name, ..dimension(measure(&mut random, number + 3 * k, size)) }
            })
            .collect();
        let planes = if number % 5 == 0 { vec![plane(DVec3::ZERO, -DVec3::X)] } else { Vec::new() };
        let sheet = Sheet { measures, ..sheet((paper, name), angle) };
        let page = match sheet.draw(&[box_model(size)], &planes, 1) {
            Ok(page) => page,
            Err(error) => {
                messages.push(format!("{number}: {error}"));
                continue;
            }
        };
        let found = faults(&page);
        if !found.is_empty() {
            messages.push(format!("{number} on {name} {angle:?}: {found:?}"));
        }
        // Each dimension is either drawn or reported.
        let layer = page.layers.iter().find(|layer| layer.id == "dimensions-text");
        let drawn = |k: usize| {
            let own = |id: &str| id == k.to_string() || id.starts_with(&format!("{k}-"));
            layer.is_some_and(|layer| layer.groups.iter().any(|group| own(&group.id)))
        };
        for k in 1..=count {
            let name = format!("dimension {k}");
            let is_named = page.warnings.iter().any(|warning| {
                matches!(warning, SheetWarning::DimensionLeftOut { dimension, .. } if *dimension == name)
            });
            if drawn(k) == is_named {
                messages.push(format!("{number}: {name} drawn {} named {is_named}", drawn(k)));
            }
            left_out += usize::from(is_named && planes.is_empty());
            asked += 1;
        }
    }
    assert!(messages.is_empty(), "{}: {:#?}", messages.len(), &messages[..messages.len().min(12)]);
    // Fewer than one dimension in twenty may be omitted.
    assert!(left_out * 20 < asked, "{left_out} of {asked}");
}
