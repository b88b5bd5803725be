//! Checks view volumes that become boxes, and the grid of a height field.

use super::resolve_text;
use homog::Point;
use std::collections::BTreeSet;
use viewport::PointGrid;

#[test]
fn c88_a_scenes_frustum_becomes_the_box_and_nearer_stays_nearer() {
    let scene = resolve_text(
        "Scene(models: [(path: \"crate.glb\", translation: (0, 0, -4))],
         camera: (view: LookTo(eye: (0, 0, 0), gaze: (0, 0, -1)),
                  projection: Frustum(left: -1, right: 3, bottom: -1, top: 2, near: 2, far: 6)),
         image: (size: (400, 300)))",
    );
    let map = scene.view_projection.world_to_clip();
    let ndc =
        |x: f64, y: f64, z: f64| map.transform_point(Point::new(x, y, z)).divide().expect("ahead");
    // The corners of the window on z = −2, and of its enlargement by 3 on z = −6; near is at +1.
    for (scale, z, depth) in [(1.0, -2.0, 1.0), (3.0, -6.0, -1.0)] {
        for (x, u) in [(-1.0, -1.0), (3.0, 1.0)] {
            for (y, v) in [(-1.0, -1.0), (2.0, 1.0)] {
                let corner = ndc(scale * x, scale * y, z);
                assert!((corner - Point::new(u, v, depth)).length() < 1e-12, "{corner:?}");
            }
        }
    }
    // For any x and y, the nearer of two points has the greater depth.
    let places: Vec<(f64, f64, f64)> = (0..60)
        .map(|k: u32| {
            let [a, b, c] = [7, 11, 13].map(|factor| f64::from(k * factor % 60) / 59.0);
            (4.0 * a - 1.0, 3.0 * b - 1.0, -2.0 - 4.0 * c)
        })
        .collect();
    let pairs = places.iter().flat_map(|p| places.iter().map(move |q| (p, q)));
    let ordered = pairs.filter(|(p, q)| p.2 > q.2 + 1e-9);
    let mut count = 0;
    for ((x, y, z), (x2, y2, z2)) in ordered {
        assert!(ndc(*x, *y, *z).z() > ndc(*x2, *y2, *z2).z(), "{z} should be nearer than {z2}");
        count += 1;
    }
    assert!(count > 1000);
    // A box in the middle of the frustum is distorted: its far side is narrower than its near side.
    let width = |z: f64| ndc(1.0, 0.0, z).x() - ndc(0.0, 0.0, z).x();
    assert!((width(-2.0) / width(-6.0) - 3.0).abs() < 1e-12);
}

#[test]
fn c98_the_mexican_hat_covers_the_index_grid_and_has_its_heights() {
    let scene = resolve_text("Scene(models: [(path: \"mexican_hat.glb\")])");
    let positions = &scene.models[0].model.meshes[0].primitives[0].positions;
    let grid = PointGrid::new(49, 49).expect("a grid");
    // Positions in files are quantized: a step of the grid is 1/24.
    let index = |x: f64| libm::round((x + 1.0) * 24.0) as i64;
    let mut seen = BTreeSet::new();
    let mut peak = f64::MIN;
    for [x, y, z] in positions.iter().map(|position| position.map(f64::from)) {
        let (i, j) = (index(x), index(z));
        let place = grid.xz(i as usize, j as usize).expect("a point of the grid");
        assert!((x - place[0]).abs() < 1e-6 && (z - place[1]).abs() < 1e-6, "({x}, {z})");
        // Row i of n is at 2i/(n − 1) − 1: the first at −1, the last at 1.
        assert!((place[0] - (2.0 * i as f64 / 48.0 - 1.0)).abs() < 1e-12);
        let radius = std::f64::consts::TAU * (x * x + z * z).sqrt();
        let height = if radius == 0.0 { 1.0 } else { libm::sin(radius) / radius };
        assert!((y - 0.9 * height).abs() < 1e-5, "({x}, {y}, {z})");
        peak = peak.max(y);
        seen.insert((i, j));
    }
    assert_eq!(seen.len(), 49 * 49, "every point of the grid");
    assert!((peak - 0.9).abs() < 1e-6);
}
