//! Inspected pixels have the colors of the picture and list the triangles visible there.

use pipeline::render::inspect_pixel;
use pipeline::scene::ResolveOptions;
use pipeline::{Origin, Scene, render};
use std::path::Path;

const SCENES: [&str; 10] = [
    "teapot",
    "crates",
    "lamp",
    "lights",
    "mexican_hat",
    "panes",
    "primitives",
    "room",
    "spheres",
    "finishes",
];

#[test]
fn a_thousand_inspected_pixels_match_their_pictures() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    // A random number generator that gives the same positions everywhere (Lehmer, 1951).
    let mut state = 20_261_121_u64;
    let mut below = |count: u32| {
        state = state * 48_271 % 2_147_483_647;
        (state % u64::from(count)) as u32
    };
    let mut seen = 0;
    for name in SCENES {
        let (origin, mut file) =
            Origin::read_scene(&folder.join(format!("{name}.ron"))).expect("a committed scene");
        file.image.size = (160, 120);
        let scene = Scene::resolve(&origin, &file, &ResolveOptions::default()).expect("a scene");
        let picture = render(&scene, 2).expect("a picture");
        for _ in 0..100 {
            let (x, y) = (below(160), below(120));
            let told = inspect_pixel(&scene, x, y).expect("a picture").expect("a shaded pixel");
            assert_eq!(Some(told.color), picture.pixel(x, y), "{name} ({x}, {y}): {told:?}");
            seen += usize::from(!told.fragments.is_empty());
        }
        assert_eq!(inspect_pixel(&scene, 160, 0).expect("a picture"), None);
    }
    assert!(seen > 300, "too few pixels show a surface: {seen}");
}
