//! Free areas on a sheet: rectangles with room for views that have no fixed position.
//!
//! ```text
//!   ┌───────┬──────┐
//!   │ front │ side │      a maximal free rectangle ends at obstacles or at the frame, so its sides
//!   ├───────┼──────┤      align with theirs, and all such rectangles can be tried
//!   │  top  │ ████ │
//!   └───────┴──────┘
//! ```

use super::annotation::{Extent, overlap};
use glam::DVec2;

/// Returns all free rectangles in an area that align with sides of the area or of obstacles.
pub(super) fn free_rectangles(area: Extent, obstacles: &[Extent]) -> Vec<Extent> {
    let borders = |axis: usize| {
        let sides = obstacles.iter().flatten().chain(&area).map(|corner| corner[axis]);
        let within = sides.filter(|side| (area[0][axis]..=area[1][axis]).contains(side));
        let mut within: Vec<f64> = within.collect();
        within.sort_by(f64::total_cmp);
        within.dedup();
        within
    };
    let (xs, ys) = (borders(0), borders(1));
    let mut free = Vec::new();
    for (i, left) in xs.iter().enumerate() {
        for right in &xs[i + 1..] {
            for (k, top) in ys.iter().enumerate() {
                for bottom in &ys[k + 1..] {
                    let rectangle = [DVec2::new(*left, *top), DVec2::new(*right, *bottom)];
                    if !obstacles.iter().any(|other| overlap(*other, rectangle)) {
                        free.push(rectangle);
                    }
                }
            }
        }
    }
    free
}

/// The ratio of available to required size beyond which additional space has no value.
const AMPLE: f64 = 1.3;

/// Returns the best rectangle for a view of the given size. Prefers rectangles with ample space,
/// then rectangles that contain `wanted`, then larger rectangles.
pub(super) fn best_rectangle(free: &[Extent], size: DVec2, wanted: DVec2) -> Option<Extent> {
    let holds = |[low, high]: &&Extent| (*high - *low).cmpge(size).all();
    let score = |[low, high]: &Extent| {
        let (room, contains) =
            (*high - *low, wanted.cmpge(*low).all() && wanted.cmple(*high).all());
        let ample = (room / size.max(DVec2::splat(1e-9))).min_element().min(AMPLE);
        [ample, f64::from(u8::from(contains)), room.x * room.y]
    };
    let better = |a: Extent, b: Extent| {
        let order =
            score(&a).iter().zip(&score(&b)).map(|(a, b)| a.total_cmp(b)).find(|o| o.is_ne());
        if order.is_some_and(core::cmp::Ordering::is_lt) { b } else { a }
    };
    free.iter().filter(holds).copied().reduce(better)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn extent([x0, y0, x1, y1]: [f64; 4]) -> Extent {
        [DVec2::new(x0, y0), DVec2::new(x1, y1)]
    }

    #[test]
    fn the_corner_next_to_three_views_is_free() {
        let area = extent([0.0, 0.0, 100.0, 80.0]);
        let views =
            [[0.0, 0.0, 40.0, 30.0], [50.0, 0.0, 90.0, 30.0], [0.0, 40.0, 40.0, 70.0]].map(extent);
        let free = free_rectangles(area, &views);
        assert!(free.iter().all(|one| !views.iter().any(|view| overlap(*view, *one))));
        let corner = DVec2::new(70.0, 55.0);
        let best = best_rectangle(&free, DVec2::new(30.0, 30.0), corner);
        assert_eq!(best, Some(extent([40.0, 30.0, 100.0, 80.0])));
        assert_eq!(best_rectangle(&free, DVec2::new(61.0, 30.0), corner), None);
        assert!(free_rectangles(area, &[area]).is_empty());
    }
}
