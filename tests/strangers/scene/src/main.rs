//! Builds a scene in memory from arrays, renders it to a PNG with a depth pass, and writes it as
//! text that can be read again.

use pipeline::render::passes::{Pass, render_passes};
use pipeline::scene::file::{CameraFile, LightFile, ModelFile};
use pipeline::{PixelRect, Scene, SceneFile, render};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let roof =
        [[-1.0, 0.0, -1.0], [1.0, 0.0, -1.0], [1.0, 0.0, 1.0], [-1.0, 0.0, 1.0], [0.0, 1.2, 0.0]];
    let faces = [4, 1, 0, 4, 2, 1, 4, 3, 2, 4, 0, 3, 0, 1, 2, 0, 2, 3];
    let scene = Scene::builder()
        .mesh(roof, faces)
        .camera(CameraFile::look_at([2.0, 2.0, 4.0], [0.0, 0.3, 0.0]))
        .light(LightFile::directional([-1.0, -2.0, -1.0], 2.0)?)
        .size(160, 120)
        .build()?;
    let picture = render(&scene, 2)?;
    let png = picture.to_png();
    let whole = PixelRect::from_size(160, 120);
    let depth = render_passes(&scene, whole, &[Pass::Depth], 1, &Default::default())?;
    println!("{} bytes of PNG, {} pass", png.len(), depth.len());
    std::fs::write(std::env::temp_dir().join("scene.png"), &png)?;
    assert!(
        png.starts_with(b"\x89PNG")
            && picture.pixel(80, 60).is_some_and(|[.., alpha]| alpha == 255)
    );

    let mut file = SceneFile::new([ModelFile::new("roof.glb").at([0.0, 0.5, 0.0])]);
    file.camera = CameraFile::look_at([2.0, 2.0, 4.0], [0.0; 3]);
    let text = file.to_ron()?;
    assert_eq!(SceneFile::from_ron(&text)?, file);
    Ok(())
}
