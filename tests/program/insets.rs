//! Several views in one picture, backgrounds, copies, changed materials and camera paths.

use crate::sandbox::Sandbox;
use crate::vector_files::{PagePoint, parse_svg};

fn render_fields(sandbox: &Sandbox, name: &str, fields: &str) -> (u32, u32, Vec<[u8; 4]>) {
    let scene = format!("{name}.ron");
    sandbox.write_file(&scene, format!("Scene(models: [(path: \"crate.glb\")], {fields})"));
    let run = sandbox.run(&["render", &scene]);
    // A view that faces away from the models to show the background is empty.
    let is_empty = run.stderr.starts_with("warning: the picture is empty: everything is behind");
    assert!(run.code == 0 && (run.stderr.is_empty() || is_empty), "{}", run.stderr);
    sandbox.read_picture(&format!("{name}.png"))
}

/// Returns the pixels of a rectangle: left, top, width, height.
fn cut_out(
    (width, _, pixels): &(u32, u32, Vec<[u8; 4]>),
    [x, y, across, down]: [u32; 4],
) -> Vec<[u8; 4]> {
    let row = |row: u32| {
        let start = (row * width + x) as usize;
        &pixels[start..start + across as usize]
    };
    (y..y + down).flat_map(row).copied().collect()
}

/// Explicit lights, because default lights follow the scene's own camera, not the moving camera.
const IMAGE: &str =
    "image: (size: (40, 30)), lights: [Directional(direction: (-1, -2, -1), intensity: 3)]";
const GRADIENT: &str = "Gradient(colors: [\"#102030\", \"#f0e0d0\"])";

#[test]
fn a_viewport_matches_its_cameras_own_picture() {
    let sandbox = Sandbox::new("viewports");
    sandbox.copy_model("crate.glb");
    let camera = "camera: (view: Frame(from: Top), projection: Orthographic())";
    let viewport = format!("pixels: (20, 8, 30, 24), {camera}, style: Clay");
    let both = format!(
        "image: (size: (80, 60), background: {GRADIENT}), viewports: [({viewport}), (at: (0.75, 0.5, 0.25, 0.5), \
         background: Color(\"#f00\"), border: (color: \"#0f0\", width: 2))]"
    );
    let all = render_fields(&sandbox, "all", &both);
    let inner = format!("image: (size: (30, 24), background: {GRADIENT}), {camera}, style: Clay");
    assert_eq!(cut_out(&all, [20, 8, 30, 24]), render_fields(&sandbox, "inner", &inner).2);
    let outer = format!("image: (size: (80, 60), background: {GRADIENT})");
    let outer = render_fields(&sandbox, "outer", &outer);
    assert_eq!(cut_out(&all, [0, 0, 20, 60]), cut_out(&outer, [0, 0, 20, 60]));
    assert_eq!(cut_out(&all, [60, 30, 20, 2]), [[0, 255, 0, 255]; 40]);
    assert_eq!(cut_out(&all, [62, 32, 1, 1]), [[255, 0, 0, 255]]);
    // A crop has the same pixels as the whole picture, including views and gradient.
    let run = sandbox.run(&["render", "all.ron", "-o", "part.png", "--crop", "15,5,50,40"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    assert_eq!(sandbox.read_picture("part.png").2, cut_out(&all, [15, 5, 50, 40]));
}

/// In a drawing, a viewport shows exactly its camera's drawing and erases everything under it.
#[test]
fn a_viewport_in_a_drawing_has_the_lines_of_its_camera() {
    let sandbox = Sandbox::new("drawn_viewports");
    sandbox.copy_model("crate.glb");
    let draw = |name: &str, fields: &str| {
        let scene = format!("Scene(models: [(path: \"crate.glb\")], style: Lines(), {fields})");
        sandbox.write_file("scene.ron", scene);
        let run = sandbox.run(&["render", "scene.ron", "-o", name]);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""));
        parse_svg(&std::fs::read_to_string(sandbox.path_of(name)).expect("an SVG")).1
    };
    let camera = "camera: (view: Frame(from: Top), projection: Orthographic())";
    // 96 pixels are 25.4 millimeters.
    let inset =
        format!("pixels: (96, 192, 192, 96), {camera}, border: (color: \"#0f0\", width: 4)");
    let both = draw("both.svg", &format!("image: (size: (384, 384)), viewports: [({inset})]"));
    let alone = draw("alone.svg", &format!("image: (size: (192, 96)), {camera}"));
    for (id, lines) in &alone {
        let moved = |line: &Vec<PagePoint>| {
            line.iter().map(|[x, y]| [x + 25.4, y + 50.8]).collect::<Vec<PagePoint>>()
        };
        let [moved, drawn] =
            [lines.iter().map(moved).collect(), both[&format!("view-1-{id}")].clone()]
                .map(|lines: Vec<Vec<PagePoint>>| lines.concat());
        let near = |[a, b]: [&PagePoint; 2]| (a[0] - b[0]).abs() + (a[1] - b[1]).abs() < 1e-6;
        assert_eq!(moved.len(), drawn.len());
        assert!(moved.iter().zip(&drawn).all(|(a, b)| near([a, b])), "{id}");
    }
    for (id, lines) in both.iter().filter(|(id, _)| !id.starts_with("view-")) {
        let inside = |[x, y]: &PagePoint| *x > 25.401 && *x < 76.199 && *y > 50.801 && *y < 76.199;
        assert!(!lines.iter().flatten().any(inside), "{id}");
    }
    assert!(both.contains_key("view-1-border"));
    // The two eyes of a stereo pair are two such viewports, but an anaglyph consists of pixels.
    let pair = draw("pair.svg", "stereo: SideBySide()");
    assert!(pair.keys().any(|id| id.starts_with("view-1-")));
    assert!(pair.keys().any(|id| id.starts_with("view-2-")));
    sandbox.write_file("scene.ron", "Scene(models: [(path: \"crate.glb\")], stereo: Anaglyph())");
    let run = sandbox.run(&["render", "scene.ron", "-o", "anaglyph.svg"]);
    assert_eq!(run.code, 0);
    assert!(run.stderr.contains("only PNG pictures can be anaglyphs"), "{}", run.stderr);
}

#[test]
fn stereo_views_agree_in_the_plane_of_convergence() {
    let sandbox = Sandbox::new("stereo");
    sandbox.copy_model("crate.glb");
    let camera = "camera: (view: LookAt(eye: (0, 0.5, 5), target: (0, 0.5, 0)))";
    let image = "image: (size: (60, 60), background: Color(\"#fff\"))";
    let mono = render_fields(&sandbox, "mono", &format!("{camera}, {image}"));
    let wide = "image: (size: (120, 60), background: Color(\"#fff\"))";
    // Both eyes converge on the crate's front, so its outline is where a single eye sees it.
    let pair = "stereo: SideBySide(convergence: 4.5, eye_distance: 0.3)";
    let pair = render_fields(&sandbox, "pair", &format!("{camera}, {wide}, {pair}"));
    let dark = |pixels: Vec<[u8; 4]>| pixels.iter().filter(|p| **p != [255; 4]).count();
    let counts =
        [dark(mono.2), dark(cut_out(&pair, [0, 0, 60, 60])), dark(cut_out(&pair, [60, 0, 60, 60]))];
    let near = |a: usize, b: usize| a.abs_diff(b) * 12 < a;
    assert!(near(counts[0], counts[1]) && near(counts[1], counts[2]), "{counts:?}");
    assert_ne!(cut_out(&pair, [0, 0, 60, 60]), cut_out(&pair, [60, 0, 60, 60]));
    // Red comes from the left eye, green and blue from the right eye.
    let glasses = "stereo: Anaglyph(convergence: 4.5, eye_distance: 0.3)";
    let glasses = render_fields(&sandbox, "glasses", &format!("{camera}, {image}, {glasses}"));
    let (left, right) = (cut_out(&pair, [0, 0, 60, 60]), cut_out(&pair, [60, 0, 60, 60]));
    let mixed: Vec<_> = left.iter().zip(&right).map(|(l, r)| [l[0], r[1], r[2], 255]).collect();
    assert_eq!(glasses.2, mixed);
}

#[test]
fn background_pictures_are_drawn_unless_they_are_outside_the_folder() {
    let sandbox = Sandbox::new("background_picture");
    sandbox.copy_model("crate.glb");
    let red = "image: (size: (8, 8), background: Color(\"#c00\")), camera: (view: LookTo(eye: (0, 0, 9), gaze: (0, 0, 1)))";
    render_fields(&sandbox, "red", red);
    let behind = "background: Picture(path: \"red.png\", fit: Contain, color: \"#00c\")";
    let image = render_fields(&sandbox, "framed", &format!("image: (size: (40, 20), {behind})"));
    assert_eq!(cut_out(&image, [0, 0, 1, 1]), [[0, 0, 204, 255]]);
    assert_eq!(cut_out(&image, [11, 0, 1, 1]), [[204, 0, 0, 255]]);
    let lines = format!("image: (size: (40, 20), {behind}), style: Lines()");
    let lines = render_fields(&sandbox, "lines", &lines);
    assert_eq!(cut_out(&lines, [0, 0, 1, 1]), [[0, 0, 204, 255]]);
    assert_eq!(cut_out(&lines, [10, 0, 1, 1]), [[204, 0, 0, 255]]);
}

#[test]
fn copies_and_changed_materials_are_visible() {
    let sandbox = Sandbox::new("copies");
    sandbox.copy_model("crate.glb");
    sandbox.write_file(
        "scene.ron",
        "Scene(models: [(path: \"crate.glb\", instances: Grid(count: (2, 1, 1), step: (4, 0, 0)), \
         materials: [(base_color: \"#00f\", unlit: true)])], camera: (view: Frame(from: Front), \
         projection: Orthographic()), image: (size: (90, 30)))",
    );
    let run = sandbox.run(&["render", "scene.ron"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let picture = sandbox.read_picture("scene.png");
    let blue = |x: u32| cut_out(&picture, [x, 15, 1, 1])[0];
    assert_eq!([blue(10), blue(45), blue(80)], [[0, 0, 255, 255], [0; 4], [0, 0, 255, 255]]);
}

#[test]
fn a_camera_moves_along_its_keyframes() {
    let sandbox = Sandbox::new("camera_path");
    sandbox.copy_model("crate.glb");
    let key =
        |time: f64, x: f64| format!("(time: {time}, eye: ({x}, 0.5, 6), target: ({x}, 0.5, 0))");
    let keys =
        format!("camera_path: (keys: [{}, {}], curve: Linear)", key(1.0, 0.0), key(2.0, 2.0));
    sandbox
        .write_file("way.ron", format!("Scene(models: [(path: \"crate.glb\")], {IMAGE}, {keys})"));
    let run = sandbox.run(&["animate", "way.ron", "-o", "f_{frame}.png", "--fps", "4"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(!sandbox.path_of("f_4.png").exists());
    for (frame, x) in [(0, 0.0), (1, 0.5), (3, 1.5)] {
        let camera = format!("camera: (view: LookAt(eye: ({x}, 0.5, 6), target: ({x}, 0.5, 0)))");
        let still = render_fields(&sandbox, "still", &format!("{IMAGE}, {camera}"));
        assert_eq!(sandbox.read_picture(&format!("f_{frame}.png")), still, "{frame}");
    }
}
