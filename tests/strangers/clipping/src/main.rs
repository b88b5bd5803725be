//! Clips a polygon with colors to a room and to the cone of a light, without any projection.

use clip::{
    ConvexVolume,
    homog::{Bounds, Interpolate, Plane, Point, World},
};

clip::homog::space!(
    /// The space of a lamp at its origin that shines along −z.
    Lamp, "lamp"
);

#[derive(Clone, Copy, Debug, PartialEq)]
struct Vertex {
    color: [f32; 3],
    uv: [f32; 2],
}

impl Interpolate for Vertex {
    fn weighted_sum<const N: usize>(all: [Self; N], weights: [f64; N]) -> Self {
        Self {
            color: Interpolate::weighted_sum(all.map(|vertex| vertex.color), weights),
            uv: Interpolate::weighted_sum(all.map(|vertex| vertex.uv), weights),
        }
    }
}

fn main() -> Result<(), clip::VolumeError> {
    let room = ConvexVolume::<World>::from_bounds(
        Bounds::from_points([[0.0; 3], [4.0, 3.0, 5.0]].map(Point::from)).expect("two points"),
    );
    let banner = [
        (Point::new(-2.0, 1.0, 1.0), Vertex { color: [1.0, 0.0, 0.0], uv: [0.0, 0.0] }),
        (Point::new(6.0, 1.0, 1.0), Vertex { color: [0.0, 1.0, 0.0], uv: [1.0, 0.0] }),
        (Point::new(6.0, 2.0, 1.0), Vertex { color: [0.0, 0.0, 1.0], uv: [1.0, 1.0] }),
        (Point::new(-2.0, 2.0, 1.0), Vertex { color: [1.0, 1.0, 1.0], uv: [0.0, 1.0] }),
    ];
    let inside = room.clip_polygon(&banner);
    assert_eq!(inside.len(), 4);
    assert!(
        inside
            .iter()
            .all(|(place, vertex)| (vertex.uv[0] - (place.x() as f32 + 2.0) / 8.0).abs() < 1e-6)
    );

    // The cone of a lamp as sixty planes, far more than a graphics card supports.
    let mut cone = ConvexVolume::<Lamp>::new();
    for step in 0..60 {
        let (s, c) = (f64::from(step) * std::f64::consts::TAU / 60.0).sin_cos();
        cone = cone.with_plane(Plane::new(-c, -s, -0.5, 0.0))?;
    }
    let wall = [[-9.0, -9.0], [9.0, -9.0], [9.0, 9.0], [-9.0, 9.0]]
        .map(|[x, y]| (Point::<Lamp>::new(x, y, -4.0), ()));
    let lit = cone.clip_polygon(&wall);
    let radius = lit.iter().map(|(place, ())| place.x().hypot(place.y())).fold(0.0, f64::max);
    println!("{} corners, {radius:.4} from the center", lit.len());
    assert!(lit.len() == 60 && (2.0..2.01).contains(&radius));
    assert_eq!(
        cone.clip_segment([Point::<Lamp>::new(0.0, 0.0, 2.0), Point::new(0.0, 0.0, -2.0)]),
        Some([0.5, 1.0])
    );
    Ok(())
}
