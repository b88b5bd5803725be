//! Picks the point under the mouse in five conventions, and checks that the hit is the same in all
//! of them.

use camera::{
    Camera,
    homog::{Bounds, Normal, Plane, Point, Vector},
};
use projection::{Convention, Fov, Perspective};
use viewport::Viewport;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let camera = Camera::look_at(Point::new(2.0, 3.0, 6.0), Point::ORIGIN, Vector::Y)?;
    let lens = Perspective::new(Fov::vertical_degrees(40.0), 640.0 / 480.0, 0.5, 50.0)?;
    let triangle = [[-1.0, 0.5, 1.0], [1.5, -0.5, 1.2], [0.2, 2.0, -0.5]].map(Point::from);
    let floor = Plane::through(Point::new(0.0, -1.0, 0.0), Normal::new(0.0, 1.0, 0.0));
    let bounds = Bounds::from_points(triangle).ok_or("no points")?;
    let mouse = [352.5, 150.5];

    let mut hits = Vec::new();
    for (name, convention) in [
        ("chapter", Convention::CHAPTER),
        ("OpenGL", Convention::OPENGL),
        ("Vulkan", Convention::VULKAN),
        ("Vulkan, reversed", Convention::VULKAN.reversed()),
        ("Metal", Convention::METAL),
    ] {
        let clip_to_world = camera.view_to_world() * lens.clip_to_view(convention);
        let image = Viewport::image_for(640, 480, convention)?;
        let ray = image.unprojector(clip_to_world).pick_ray(mouse).ok_or("no ray")?.ray;
        let hit = ray.hit_triangle(triangle).ok_or("missed")?;
        let [enter, leave] = ray.hit_bounds(bounds).ok_or("missed the box")?;
        assert!(enter <= hit.t && hit.t <= leave);
        println!(
            "{name:>17}: at {:.3}, {:.6} away, the floor {:.6}",
            ray.at(hit.t),
            hit.t,
            ray.hit_plane(floor).ok_or("missed the floor")?
        );
        // Project the point back: it is under the mouse.
        let to_clip = lens.view_to_clip(convention) * camera.world_to_view();
        let ndc = (to_clip * ray.at(hit.t)).divide().ok_or("behind the eye")?;
        let pixel = image.ndc_to_screen() * ndc;
        assert!((pixel.x() - mouse[0]).hypot(pixel.y() - mouse[1]) < 1e-9);
        hits.push(hit);
    }
    assert!(
        hits.iter().all(|hit| (hit.t - hits[0].t).abs() < 1e-9 && hit.is_front == hits[0].is_front)
    );
    Ok(())
}
