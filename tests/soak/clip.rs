//! Functions for clipping. For any points and any volume, the result must be finite.

use crate::finite::Finite;
use crate::random::Random;
use crate::subject::Subject;
use clip::{
    ClipVertex, Outcode, Outline, PlaneIndex, Volume, clip_convex, clip_point, clip_polyline,
    clip_segment, clip_triangle, cut_triangle, segment_outcomes,
};
use homog::{Clip, HPoint, Point, World};

pub const SUBJECTS: &[Subject] = &[
    ("clip::Volume::outcode", |r| {
        let (volume, point) = (volume(r), r.hpoint());
        let code = volume.outcode(point);
        let finite = point.is_finite();
        // A plane is compared only where the sign of its sum of four products is certain.
        let agrees = |i: PlaneIndex| {
            let distance = volume.plane(i).map_or(0.0, |plane| plane.evaluate(point));
            let certain = distance.is_finite() && i <= PlaneIndex::FAR;
            !certain || code.contains(i) == (distance < 0.0)
        };
        let right = if finite {
            volume.active_planes().planes().all(agrees)
        } else {
            code == volume.active_planes()
        };
        Some(right && volume.active_planes().bits() | code.bits() == volume.active_planes().bits())
    }),
    ("clip::Volume::contains", |r| volume(r).contains(r.hpoint()).then_some(true)),
    ("clip::Volume::with_plane", |r| {
        let volume = volume(r).with_plane(r.plane()).ok()?;
        let planes: Vec<_> = volume.active_planes().planes().map(|i| volume.plane(i)).collect();
        Some(planes.finite())
    }),
    ("clip::Volume::with_guard_band", |r| {
        let volume = Volume::CHAPTER.with_guard_band(r.size(), r.size()).ok()?;
        let planes: Vec<_> = volume.active_planes().planes().map(|i| volume.plane(i)).collect();
        Some(planes.finite())
    }),
    ("clip::Volume::outcodes", |r| {
        let points: [HPoint<Clip>; 4] = std::array::from_fn(|_| r.hpoint());
        let mut codes = [Outcode::INSIDE; 4];
        let extent = volume(r).compute_outcodes(&points, &mut codes);
        Some(
            extent.count == 4
                && extent.any_outside.bits() & extent.all_outside.bits()
                    == extent.all_outside.bits(),
        )
    }),
    ("clip::Volume::project", |r| {
        let positions: [[f32; 3]; 2] = std::array::from_fn(|_| r.numbers().map(|x: f64| x as f32));
        let (mut points, mut codes) = ([HPoint::new(0.0, 0.0, 0.0, 0.0); 2], [Outcode::INSIDE; 2]);
        let map = r.projective::<World, Clip>();
        Some(volume(r).project_positions(map, &positions, &mut points, &mut codes).count == 2)
    }),
    ("clip::Volume::project_f32", |r| {
        let positions: [[f32; 3]; 2] = std::array::from_fn(|_| r.numbers().map(|x: f64| x as f32));
        let (mut points, mut codes) = ([[0.0; 4]; 2], [Outcode::INSIDE; 2]);
        let map = r.projective::<World, Clip>();
        Some(volume(r).project_positions_f32(map, &positions, &mut points, &mut codes).count == 2)
    }),
    ("clip::clip_point", |r| Some(clip_point(r.hpoint(), &volume(r))?.finite())),
    ("clip::clip_segment", |r| {
        let cut = clip_segment(r.hpoint(), r.hpoint(), &volume(r))?;
        Some((cut.start, cut.end, cut.t0, cut.t1).finite())
    }),
    ("clip::segment_fates", |r| {
        let fates = segment_outcomes(r.hpoint(), r.hpoint(), &volume(r));
        fates.rejected.is_inside().then_some(true)
    }),
    ("clip::clip_triangle", |r| {
        let corners = std::array::from_fn(|_| r.hpoint());
        let left = clip_triangle(corners, &volume(r));
        (!left.is_empty()).then(|| left.vertices().iter().all(Finite::finite))
    }),
    ("clip::clip_convex", |r| {
        let corners: Vec<HPoint<Clip>> = (0..r.below(7)).map(|_| r.hpoint()).collect();
        let left = clip_convex(&corners, &volume(r));
        let finite = |(i, point): (usize, &HPoint<Clip>)| {
            point.finite() && left.weights(i).is_some_and(|w| w.iter().all(|w| w.is_finite()))
        };
        (!left.is_empty()).then(|| left.points().iter().enumerate().all(finite))
    }),
    ("clip::clip_polyline", |r| {
        let points: Vec<HPoint<Clip>> = (0..r.below(7)).map(|_| r.hpoint()).collect();
        let parts = clip_polyline(&points, &volume(r));
        let mut left = parts.iter().flatten();
        (!parts.is_empty()).then(|| left.all(|point| (point.point, point.t).finite()))
    }),
    ("clip::cut_triangle", |r| {
        let left = cut_triangle::<World>(r.points(), r.plane());
        let finite = left.vertices().iter().all(|vertex| (vertex.point, vertex.weights).finite());
        (!left.vertices().is_empty()).then_some(finite && left.edge().finite())
    }),
    ("clip::Outline::of_edges", |r| {
        let outline = Outline::from_edges(&edges(r));
        Some((outline.loops, outline.open).finite())
    }),
    ("clip::Outline::cap", |r| {
        let corners = r.points::<World, 4>();
        let plane = r.plane();
        let sides = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        let cuts = sides.map(|side| cut_triangle(side.map(|i: usize| corners[i]), plane).edge());
        let edges: Vec<_> = cuts.into_iter().flatten().collect();
        let cap = Outline::from_edges(&edges).triangulate_cap(plane);
        (!cap.is_empty()).then(|| cap.finite())
    }),
    ("clip::Outline::cap of any edges", |r| {
        let cap = Outline::from_edges(&edges(r)).triangulate_cap(r.plane());
        (!cap.is_empty()).then(|| cap.finite())
    }),
];

impl Finite for ClipVertex {
    fn finite(&self) -> bool {
        (self.point, self.weights).finite()
    }
}

/// Returns one of the conventions' volumes, perhaps without its far plane, or with a guard band or
/// custom planes.
fn volume(r: &mut Random) -> Volume {
    let canonical = [Volume::CHAPTER, Volume::OPENGL, Volume::ZERO_ONE, Volume::ZERO_ONE_REVERSED];
    let mut volume = r.pick(&canonical);
    if r.below(8) == 0 {
        volume = volume.without_far();
    }
    if r.below(8) == 0 {
        volume = volume.with_guard_band(r.size(), r.size()).unwrap_or(volume);
    }
    if r.below(4) == 0 {
        for _ in 0..=r.below(3) {
            volume = volume.with_plane(r.plane()).unwrap_or(volume);
        }
    }
    volume
}

/// Returns edges between a few points, so that some share an endpoint.
fn edges(r: &mut Random) -> Vec<[Point<World>; 2]> {
    let points = r.points::<World, 5>();
    (0..r.below(9)).map(|_| [points[r.below(5)], points[r.below(5)]]).collect()
}
