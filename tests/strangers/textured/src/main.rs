//! A software renderer that draws a textured floor under the eye, with a sign standing on it.

use projection::{Convention, Fov, Perspective};
use raster::{Frame, Samples, ScreenProjection, SourceMesh, VertexAttribute, surface_fn};

const SIZE: (u32, u32) = (320, 240);

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // The floor begins behind the eye; the sign stands on it.
    let positions = [
        [-40.0, -1.0, 4.0_f32],
        [40.0, -1.0, 4.0],
        [40.0, -1.0, -40.0],
        [-40.0, -1.0, -40.0],
        [-1.0, -1.0, -5.0],
        [1.0, -1.0, -5.0],
        [1.0, 0.8, -5.0],
        [-1.0, 0.8, -5.0],
    ];
    let uvs = [
        [0.0, 0.0],
        [80.0, 0.0],
        [80.0, 44.0],
        [0.0, 44.0_f32],
        [0.0, 0.0],
        [4.0, 0.0],
        [4.0, 4.0],
        [0.0, 4.0],
    ];
    let triangles = [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]];

    let convention = Convention::VULKAN;
    let lens = Perspective::new(Fov::vertical_degrees(60.0), 4.0 / 3.0, 0.1, 100.0)?;
    let mut frame = Frame::new(SIZE.0, SIZE.1, Samples::Four)?;
    let mesh = SourceMesh::new(&positions, &triangles);
    frame.add_clipped_mesh(
        &ScreenProjection::for_image(SIZE.0, SIZE.1, convention)?,
        lens.view_to_clip(convention),
        mesh,
    );

    let uv = VertexAttribute::new(&triangles, &uvs);
    let surface = surface_fn(|fragment| {
        let [u, v] = uv.at(fragment);
        let light = if (u.floor() + v.floor()).rem_euclid(2.0) < 1.0 { 0.9 } else { 0.2 };
        if fragment.id < 2 { [light, light, light, 1.0] } else { [light, 0.3 * light, 0.1, 1.0] }
    });
    let mut pixels = vec![[0_u8; 4]; (SIZE.0 * SIZE.1) as usize];
    frame.draw(&surface, [0.5, 0.7, 1.0, 1.0], 2, &mut pixels, |color: [f32; 4]| {
        color.map(|c| (c * 255.0 + 0.5) as u8)
    });

    std::fs::write(std::env::temp_dir().join("textured.ppm"), ppm(&pixels))?;
    let floor =
        pixels[(SIZE.0 * 180) as usize..].iter().filter(|[r, g, b, _]| r == g && g == b).count();
    println!("{floor} gray pixels in the lowest quarter");
    assert!(floor > (SIZE.0 * 60 * 9 / 10) as usize);
    Ok(())
}

fn ppm(pixels: &[[u8; 4]]) -> Vec<u8> {
    let header = format!("P6 {} {} 255\n", SIZE.0, SIZE.1).into_bytes();
    header.into_iter().chain(pixels.iter().flat_map(|pixel| pixel[..3].to_vec())).collect()
}
