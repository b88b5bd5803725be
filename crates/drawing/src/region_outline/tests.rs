//! Compares outlines with known areas, and tests that the outlines of random triangles wind around
//! exactly the points that the triangles cover.

use super::*;

/// Returns the directed sides of a polygon.
fn polygon(points: &[[i32; 2]]) -> Vec<([PagePoint; 2], i32)> {
    let next = points.iter().cycle().skip(1);
    points.iter().zip(next).map(|(&a, &b)| ([a, b], 1)).collect()
}

fn square(x: i32, y: i32, side: i32) -> Vec<([PagePoint; 2], i32)> {
    polygon(&[[x, y], [x + side, y], [x + side, y + side], [x, y + side]])
}

/// Returns twice the signed area of a loop.
fn doubled_area(line: &Polyline) -> i64 {
    let points: Vec<Point> = line.points.iter().map(|point| point.map(i64::from)).collect();
    let pairs = points.iter().zip(points.iter().cycle().skip(1));
    pairs.map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum()
}

fn areas(sides: Vec<([PagePoint; 2], i32)>) -> Vec<i64> {
    let mut areas: Vec<i64> =
        outline_loops(sides.into_iter()).iter().map(|line| doubled_area(line) / 2).collect();
    areas.sort_unstable();
    areas
}

/// Whether the sides of the loops meet only at the common ends of neighbors or where two loops
/// touch.
fn are_simple(loops: &[Polyline]) -> bool {
    let sides: Vec<Side> = loops
        .iter()
        .flat_map(|line| {
            let points: Vec<Point> = line.points.iter().map(|p| p.map(i64::from)).collect();
            let next: Vec<Point> =
                points.iter().cycle().skip(1).take(points.len()).copied().collect();
            points.into_iter().zip(next).map(|(a, b)| ([a, b], 1))
        })
        .collect();
    let repeats = |line: &Polyline| {
        let mut points = line.points.clone();
        points.sort_unstable();
        points.windows(2).any(|pair| pair[0] == pair[1])
    };
    let merged = merge_sides(sides.clone());
    merged.len() == sides.len()
        && find_crossings(&merged).is_some_and(|crossings| crossings.is_empty())
        && !loops.iter().any(repeats)
}

#[test]
fn outlines_of_squares_enclose_the_area_of_their_union() {
    let both = |other| [square(0, 0, 1000), other].concat();
    assert_eq!(areas(square(0, 0, 1000)), [1_000_000]);
    assert_eq!(areas(both(square(500, 500, 1000))), [1_750_000]);
    assert_eq!(areas(both(square(200, 200, 100))), [1_000_000]);
    assert_eq!(areas(both(square(1000, 0, 1000))), [2_000_000]);
    // Touching only at a corner: two loops.
    assert_eq!(areas(both(square(1000, 1000, 1000))), [1_000_000, 1_000_000]);
    // A hole, and another that touches the outline at a point.
    let mut hole = square(200, 200, 100);
    hole.iter_mut().for_each(|(_, sign)| *sign = -1);
    assert_eq!(areas(both(hole)), [-10_000, 1_000_000]);
    let kite: Vec<_> = polygon(&[[0, 500], [300, 300], [600, 500], [300, 700]])
        .into_iter()
        .map(|(ends, _)| (ends, -1))
        .collect();
    assert_eq!(areas(both(kite)), [-120_000, 1_000_000]);
}

#[test]
fn enclosed_narrow_gaps_are_closed() {
    // A gap of one micrometer between two halves stays, because it is open at both ends.
    let halves = [
        polygon(&[[0, 0], [500, 0], [500, 1000], [0, 1000]]),
        polygon(&[[501, 0], [1000, 0], [1000, 1000], [501, 1000]]),
    ];
    assert_eq!(areas(halves.concat()).len(), 2);
    // The same gap inside a plate is closed.
    let mut gap = polygon(&[[500, 100], [501, 100], [501, 900], [500, 900]]);
    gap.iter_mut().for_each(|(_, sign)| *sign = -1);
    assert_eq!(areas([square(0, 0, 1000), gap].concat()), [1_000_000]);
}

/// Pseudorandom numbers from a linear congruential generator.
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, limit: i32) -> i32 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) % limit as u64) as i32
    }
}

#[test]
fn outlines_wind_around_the_points_that_triangles_cover() {
    let mut numbers = Numbers(7);
    for round in 0..60 {
        // Small grids have many coincidences; large grids have long sides.
        let limit = [12, 200, 4000, 1_000_000][round % 4] * 20;
        let mut triangles = Vec::new();
        for _ in 0..3 + numbers.below(30) {
            let [a, b, c] = [(); 3].map(|()| [(); 2].map(|()| numbers.below(limit) / 20 * 20));
            let wide = [a, b, c].map(|point| point.map(i64::from));
            let turns = cross(wide[0], wide[1], wide[2]);
            match turns {
                0 => {}
                t if t > 0 => triangles.push([a, b, c]),
                _ => triangles.push([a, c, b]),
            }
        }
        let sides = triangles.iter().flat_map(|corners| polygon(corners));
        let loops = outline_loops(sides);
        assert!(are_simple(&loops), "round {round}");
        for _ in 0..200 {
            let point = [(); 2].map(|()| i64::from(numbers.below(limit)));
            let distance = |[a, b]: [Point; 2]| {
                let length = libm::hypot((b[0] - a[0]) as f64, (b[1] - a[1]) as f64);
                cross(a, b, point) as f64 / length
            };
            let within = |corners: &[PagePoint; 3]| {
                let wide = corners.map(|corner| corner.map(i64::from));
                (0..3).map(|k| distance([wide[k], wide[(k + 1) % 3]])).fold(f64::INFINITY, f64::min)
            };
            let depth = triangles.iter().map(within).fold(f64::NEG_INFINITY, f64::max);
            // Rounding may move a side across a point near it.
            if depth.abs() < 3.0 {
                continue;
            }
            let doubled = point.map(|c| 2 * c + 1);
            let winding: i32 = loops
                .iter()
                .flat_map(|line| {
                    let ends: Vec<Point> =
                        line.points.iter().map(|p| p.map(|c| 2 * i64::from(c))).collect();
                    let next: Vec<Point> =
                        ends.iter().cycle().skip(1).take(ends.len()).copied().collect();
                    ends.into_iter().zip(next).collect::<Vec<_>>()
                })
                .map(|(a, b)| crossing_of_ray(doubled, [a, b], 1))
                .sum();
            assert_eq!(winding, i32::from(depth > 0.0), "round {round}, {point:?}");
        }
    }
}

#[test]
fn outlines_with_too_many_crossings_are_traced_on_the_grid() {
    // A thousand sticks in each direction give a million crossings in a 20 mm square.
    let stick = |at: i32| [[at, 0], [at + 10, 0], [at + 10, 20_000], [at, 20_000]];
    let sticks = (0..1000).map(|k| stick(20 * k));
    let sides = sticks.flat_map(|vertical| {
        let horizontal = vertical.map(|[x, y]| [y, x]);
        // Reversed, because swapping x and y also reverses the orientation.
        let horizontal = [horizontal[3], horizontal[2], horizontal[1], horizontal[0]];
        [polygon(&vertical), polygon(&horizontal)].concat()
    });
    let sides: Vec<_> = sides.collect();
    assert!(is_traced(sides.iter().copied()));
    let loops = outline_loops(sides.into_iter());
    let area: i64 = loops.iter().map(|line| doubled_area(line) / 2).sum();
    // The sticks and gaps are finer than the grid, so the area depends on the samples.
    assert!(area > 200_000_000 && area <= 441_000_000, "{area}");
    assert!(loops.iter().all(|line| line.closed && line.points.len() >= 4));
    // A square between two grid steps keeps its size to within a cell.
    let square = square(130, 70, 7000);
    let border = traced_border(&merge_sides(
        square.iter().map(|(ends, sign)| (ends.map(|end| end.map(i64::from)), *sign)).collect(),
    ));
    let traced = finish_loop(&join_loops(&border)[0]).expect("a loop");
    assert!((doubled_area(&traced) / 2 - 49_000_000).abs() < 2 * 7000 * 100, "{traced:?}");
    assert_eq!(traced.points.len(), 4);
}
