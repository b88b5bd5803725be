//! Random projections in the syntax of scene files.

use crate::drawing::bits::Random;

/// The projections by their names in scene files, where each is an enum variant.
pub const PROJECTIONS: &[&str] = &[
    "Perspective",
    "Orthographic",
    "Frustum",
    "ApexMovedFrustum",
    "Multiview",
    "Isometric",
    "Dimetric",
    "Trimetric",
    "Axonometric",
    "Cavalier",
    "Cabinet",
    "Oblique",
    "Military",
    "OnePoint",
    "TwoPoint",
    "ThreePoint",
    "NPoint",
    "Intrinsics",
];

/// Returns a projection of this name with random parameters, some of which are invalid.
pub fn random_projection(name: &str, r: &mut Random) -> String {
    let angle = |r: &mut Random| format!("angle_degrees: {}", r.between(-180.0, 180.0));
    let fields = match name {
        "Perspective" => random_lens(r),
        "Orthographic" => random_parallel_window(r),
        "Frustum" | "ApexMovedFrustum" => {
            let window = random_window(r);
            format!("{window}, near: {}", r.between(0.5, 2.0))
        }
        "Multiview" => r.choose(&["Front", "Back", "Left", "Right", "Top", "Bottom"]).to_owned(),
        "Axonometric" => {
            let [x, y, z] = [0; 3].map(|_| r.between(0.4, 1.0));
            format!("x: {x}, y: {y}, z: {z}")
        }
        "Cavalier" | "Cabinet" => angle(r),
        "Oblique" => format!("length: {}, {}", r.between(0.0, 1.5), angle(r)),
        "Military" => {
            let rotation = r.between(-180.0, 180.0);
            format!("rotation_degrees: {rotation}, height: {}", r.between(0.0, 1.5))
        }
        "OnePoint" => {
            let [x, y] = [0; 2].map(|_| r.between(-2.0, 2.0));
            format!("at: ({x}, {y}), distance: {}", r.between(0.3, 6.0))
        }
        "TwoPoint" => {
            let [x, z] = [r.between(-6.0, 0.5), r.between(-0.5, 6.0)];
            let [y1, y2] = [0; 2].map(|_| r.between(-1.0, 1.0));
            format!("x: ({x}, {y1}), z: ({z}, {y2}), fraction: {}", r.between(-0.05, 1.05))
        }
        "ThreePoint" => {
            let [x, z] = [r.between(-6.0, -1.0), r.between(1.0, 6.0)];
            let [y1, y2] = [0; 2].map(|_| r.between(-1.0, 2.0));
            let below = r.between(-8.0, -1.0);
            let y = format!("({}, {below})", r.between(-1.0, 1.0));
            format!("x: ({x}, {y1}), y: {y}, z: ({z}, {y2})")
        }
        "NPoint" => {
            // Some are so large that part of the models is behind the eye.
            let [p, q, r] = [0; 3].map(|_| if r.once_in(4) { 0.0 } else { r.between(-1.2, 1.2) });
            format!("p: {p}, q: {q}, r: {r}")
        }
        "Intrinsics" => random_intrinsics(r),
        _ => return name.to_owned(),
    };
    format!("{name}({fields})")
}

/// Returns an angle, and sometimes a shift and planes.
fn random_lens(r: &mut Random) -> String {
    let angle = r.between(5.0, 120.0);
    let which = r.choose(&["fov_y_degrees", "fov_x_degrees", "fov_diagonal_degrees"]);
    let mut fields = format!("{which}: {angle}");
    if r.once_in(3) {
        let [x, y] = [0; 2].map(|_| r.between(-0.6, 0.6));
        fields += &format!(", shift: ({x}, {y})");
    }
    if r.once_in(4) {
        let near = r.between(0.05, 4.0);
        fields += &format!(", near: {near}, far: {}", r.between(2.0, 20.0));
    }
    fields
}

/// Returns focal lengths, and sometimes a principal point and a skew.
fn random_intrinsics(r: &mut Random) -> String {
    let mut fields = format!("fx: {}", r.between(100.0, 800.0));
    if r.once_in(2) {
        let [cx, cy] = [0; 2].map(|_| r.between(50.0, 250.0));
        fields += &format!(", fy: {}, cx: {cx}, cy: {cy}", r.between(100.0, 800.0));
    }
    if r.once_in(3) {
        fields += &format!(", skew: {}, pixel_centers: Half", r.between(-60.0, 60.0));
    }
    fields
}

/// Returns a height, a window or nothing, and sometimes planes.
fn random_parallel_window(r: &mut Random) -> String {
    let mut fields = match r.below(3) {
        0 => String::new(),
        1 => format!("{}, ", random_window(r)),
        _ => format!("height: {}, ", r.between(0.5, 6.0)),
    };
    if r.once_in(4) {
        let near = r.between(-3.0, 3.0);
        fields += &format!("near: {near}, far: {}", r.between(1.0, 9.0));
    }
    fields
}

/// Returns a window by its borders, sometimes with reversed borders or zero size.
fn random_window(r: &mut Random) -> String {
    let [left, bottom] = [0; 2].map(|_| r.between(-2.0, 0.5));
    let [right, top] = [0; 2].map(|_| r.between(0.4, 2.0));
    if r.once_in(6) {
        return format!("left: {right}, right: {left}, bottom: {bottom}, top: {top}");
    }
    format!("left: {left}, right: {right}, bottom: {bottom}, top: {top}")
}
