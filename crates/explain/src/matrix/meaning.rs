//! The meaning of a matrix in words, and its parameters as items.

use super::super::Step;
use super::super::conventions::volume_name;
use super::super::plain_text::format_number;
use projection::{
    Classical, Convention, Oblique, Orthographic, PrincipalPlane, ProjectionClass, Window,
};
use recognition::{CameraReading, Lens, MatrixMeaning, MatrixReading, ViewAxes, ViewportReading};

/// Describes a reading without a final period: meaning, parameters, convention and factor.
pub(super) fn describe_meaning(reading: &MatrixReading) -> String {
    let meaning = &reading.meaning;
    let convention = match meaning.convention() {
        Some(convention) => format!(", for {}", volume_name(convention)),
        None => String::new(),
    };
    let factor = match reading.factor {
        1.0 => String::new(),
        -1.0 if has_distance(meaning) => {
            ", times -1 (w is negative in front of the eye; negate the matrix before clipping)"
                .to_owned()
        }
        factor => format!(", all times {}", format_number(factor)),
    };
    describe_view(meaning)
        .or_else(|| describe_classical(meaning))
        .unwrap_or_else(|| describe_transform(meaning))
        + &convention
        + &factor
}

/// Whether w is the distance ahead of the eye.
fn has_distance(meaning: &MatrixMeaning) -> bool {
    matches!(
        meaning,
        MatrixMeaning::Perspective { .. }
            | MatrixMeaning::ApexMoved { .. }
            | MatrixMeaning::CameraPerspective { .. }
    )
}

fn list<const N: usize>(numbers: [f64; N]) -> String {
    let all: Vec<String> = numbers.into_iter().map(format_number).collect();
    format!("({})", all.join(", "))
}

fn window_words(w: Window) -> String {
    let [l, r, b, t] = [w.left(), w.right(), w.bottom(), w.top()].map(format_number);
    format!("left {l}, right {r}, bottom {b}, top {t}")
}

/// Returns whether the window of a perspective or a box is mirrored, and nothing else is unusual.
pub(super) fn is_mirrored(reading: &MatrixReading) -> bool {
    let window = match &reading.meaning {
        MatrixMeaning::Perspective { frustum, .. } => frustum.window(),
        MatrixMeaning::Orthographic { volume, .. } => volume.window(),
        _ => return false,
    };
    reading.factor > 0.0 && !mirror_words(window).is_empty()
}

/// Describes a window whose left and right, or bottom and top, are exchanged.
fn mirror_words(w: Window) -> &'static str {
    match (w.left() > w.right(), w.bottom() > w.top()) {
        (false, false) => "",
        (true, false) => ", mirrored left to right",
        (false, true) => ", upside down",
        (true, true) => ", rotated by 180°",
    }
}

fn depth_words(near: f64, far: f64) -> String {
    let far = if far.is_finite() { format_number(far) } else { "infinite".to_owned() };
    format!("near {}, far {far}", format_number(near))
}

fn oblique_words(oblique: &Oblique) -> String {
    let phi = oblique.phi().to_degrees();
    let recedes = if phi > 0.0 { phi - 180.0 } else { phi + 180.0 };
    let [length, phi, recedes] = [oblique.length(), phi, recedes].map(format_number);
    format!("length {length}, angle {phi}° (receding lines are drawn toward {recedes}°)")
}

/// Names an oblique projection by its length: `an oblique projection (cabinet)`.
fn oblique_name(oblique: &Oblique, what: &str) -> String {
    match Classical::Oblique(*oblique).class() {
        class @ (ProjectionClass::Cavalier | ProjectionClass::Cabinet) => {
            format!("an oblique {what} ({})", class.name())
        }
        _ => format!("an oblique {what}"),
    }
}

fn planometric_words(turn: f64, height: f64, z_up: bool, onto_plane: bool) -> String {
    let name = if height == 1.0 { "a military projection" } else { "a planometric projection" };
    let [turn, height] = [turn, height].map(format_number);
    let (plan, up) = if z_up { ("x and y", "z") } else { ("x and z", "y") };
    let depth = if onto_plane { "" } else { ", depth preserved" };
    format!(
        "{name}{depth}: the plan of {plan} rotated by {turn}°, with heights along {up} scaled by {height}"
    )
}

fn box_words(o: &Orthographic) -> String {
    let (w, depth) = (o.window(), depth_words(o.near(), o.far()));
    // A window of pixels has its origin in the upper left corner.
    let is_screen = w.left() == 0.0 && w.top() == 0.0 && w.width() > 0.0;
    let mirrored = if is_screen { "" } else { mirror_words(w) };
    format!("orthographic{mirrored}: {}, {depth}", window_words(w))
}

/// Describes view volumes, also combined with a camera; `None` for other maps.
fn describe_view(meaning: &MatrixMeaning) -> Option<String> {
    Some(match meaning {
        MatrixMeaning::Perspective { frustum: f, .. } => {
            let (window, depth) = (window_words(f.window()), depth_words(f.near(), f.far()));
            let mirrored = mirror_words(f.window());
            format!("a perspective projection{mirrored}: {window}, {depth}")
        }
        MatrixMeaning::InversePerspective { frustum: f, .. } => {
            let (window, depth) = (window_words(f.window()), depth_words(f.near(), f.far()));
            format!("the inverse of a perspective projection: {window}, {depth}")
        }
        MatrixMeaning::ApexMoved { frustum: f, .. } => {
            let (window, depth) = (window_words(f.window()), depth_words(f.near(), f.far()));
            format!("the lesson's perspective with its apex moved (LW-1): {window}, {depth}")
        }
        MatrixMeaning::ObliqueNear { .. } => {
            "a perspective projection with an oblique near plane".to_owned()
        }
        MatrixMeaning::Orthographic { volume, .. } => box_words(volume),
        MatrixMeaning::CameraPerspective { camera, frustum: f, .. } => {
            let (window, depth) = (window_words(f.window()), depth_words(f.near(), f.far()));
            let world = world_words(meaning);
            let camera = camera_words(camera);
            format!(
                "a camera and a perspective projection in one{world}: {camera}, {window}, {depth}"
            )
        }
        MatrixMeaning::PerspectiveToPixels {
            size,
            y_down,
            integer_centers,
            camera,
            frustum: f,
            ..
        } => {
            let (window, depth) = (window_words(f.window()), depth_words(f.near(), f.far()));
            let camera = camera.map(|camera| format!("a camera ({}), ", camera_words(&camera)));
            let camera = camera.unwrap_or_default();
            let viewport = image_words(*size, "", *y_down, *integer_centers);
            format!(
                "{camera}a perspective projection and a viewport in one: {window}, {depth}, {viewport}"
            )
        }
        MatrixMeaning::CameraOrthographic { camera, volume: o, .. } => {
            let (window, depth) = (window_words(o.window()), depth_words(o.near(), o.far()));
            let (gaze, world) = (list(camera.gaze), world_words(meaning));
            format!(
                "a camera and an orthographic box in one{world}: gaze {gaze}, {window}, {depth} \
                 from the origin of the world (the eye may be anywhere)"
            )
        }
        _ => return None,
    })
}

/// Describes the handedness of the world if it is left-handed.
fn world_words(meaning: &MatrixMeaning) -> &'static str {
    let left_handed = meaning.convention().is_some_and(|convention| convention.ahead() > 0.0);
    if left_handed { ", in a left-handed world" } else { "" }
}

/// Describes classical projections; `None` for other maps.
fn describe_classical(meaning: &MatrixMeaning) -> Option<String> {
    Some(match meaning {
        MatrixMeaning::ObliqueVolume { projection, volume: o, .. } => {
            let (window, depth) = (window_words(o.window()), depth_words(o.near(), o.far()));
            let name = oblique_name(projection, "volume");
            format!("{name}: {}, {window}, {depth}", oblique_words(projection))
        }
        MatrixMeaning::ObliqueShear { projection } => {
            let name = oblique_name(projection, "projection");
            format!("{name} with depth preserved: {}", oblique_words(projection))
        }
        MatrixMeaning::ObliqueOntoPlane { projection } => {
            let plane = format_number(projection.plane_z());
            if projection.length() == 0.0 {
                format!("an orthographic projection onto the plane z = {plane}")
            } else {
                let name = oblique_name(projection, "projection");
                format!("{name} onto the plane z = {plane}: {}", oblique_words(projection))
            }
        }
        MatrixMeaning::PrincipalView { plane } => {
            let axis = match plane {
                PrincipalPlane::Yoz => "x",
                PrincipalPlane::Zox => "y",
                PrincipalPlane::Xoy => "z",
            };
            format!("an orthographic projection onto the plane {axis} = 0")
        }
        MatrixMeaning::AxonometricOntoPlane { projection } => {
            let name = Classical::Axonometric(*projection).class().name();
            format!(
                "an axonometric projection ({name}) onto the picture plane, foreshortening {}",
                list(projection.foreshortening())
            )
        }
        MatrixMeaning::Planometric { turn_degrees, height, z_up, onto_plane } => {
            planometric_words(*turn_degrees, *height, *z_up, *onto_plane)
        }
        MatrixMeaning::CentralOntoPlane { plane_z, onto_plane } => {
            let plane = format_number(*plane_z);
            let depth = if *onto_plane { ", z dropped" } else { "" };
            format!("a perspective projection from the origin onto the plane z = {plane}{depth}")
        }
        MatrixMeaning::NPoint { projection, onto_plane } => {
            let class = Classical::NPoint(*projection).class();
            let kept = if *onto_plane { "onto the plane z = 0" } else { "depth preserved" };
            format!(
                "a {} perspective, {kept}: (p, q, r) = {}",
                class.name(),
                list(projection.bottom_row())
            )
        }
        _ => return None,
    })
}

fn camera_words(camera: &CameraReading) -> String {
    format!("eye {}, gaze {}, up {}", list(camera.eye), list(camera.gaze), list(camera.up))
}

/// Names the axes of the view space.
fn axes_words(camera: &CameraReading) -> &'static str {
    match camera.axes {
        ViewAxes::Direct3d => "looks along +z, as in Direct3D",
        ViewAxes::OpenCv => "looks along +z with y down, as in OpenCV",
        _ => "looks along -z, as in OpenGL",
    }
}

fn viewport_words(v: &ViewportReading) -> String {
    let [x, y] = [v.x, v.y].map(format_number);
    let origin = if v.x == 0.0 && v.y == 0.0 { String::new() } else { format!(" at ({x}, {y})") };
    image_words([v.width, v.height], &origin, v.y_down, v.integer_centers)
}

fn image_words(size: [f64; 2], origin: &str, y_down: bool, integer_centers: bool) -> String {
    let [width, height] = size.map(format_number);
    let rows = if y_down { "y down" } else { "y up" };
    let centers = if integer_centers { "at integers" } else { "at half-integers" };
    format!("the viewport of {width} × {height} pixels{origin}, with {rows} and centers {centers}")
}

/// Describes affine maps, viewports, intrinsics, and the textbook's P.
fn describe_transform(meaning: &MatrixMeaning) -> String {
    match meaning {
        MatrixMeaning::Identity => "the identity".to_owned(),
        MatrixMeaning::Translation { by } => format!("a translation by {}", list(*by)),
        MatrixMeaning::Scale { factors } => format!("a scaling by {}", list(*factors)),
        MatrixMeaning::Windowing { scale, offset } => {
            format!(
                "windowing: a scaling by {}, then a translation by {}",
                list(*scale),
                list(*offset)
            )
        }
        MatrixMeaning::Reflection { normal, distance } => {
            let (normal, distance) = (list(*normal), format_number(*distance));
            format!("a reflection in the plane with normal {normal} at distance {distance}")
        }
        MatrixMeaning::Rotation { axis, angle_degrees, .. } => {
            format!("a rotation by {}° about {}", format_number(*angle_degrees), list(*axis))
        }
        MatrixMeaning::Camera(camera) => {
            let axes = axes_words(camera);
            format!("a camera transform: {}, for a view space that {axes}", camera_words(camera))
        }
        MatrixMeaning::CameraPose(camera) => {
            let axes = axes_words(camera);
            let camera = camera_words(camera);
            format!("a camera pose (view to world): {camera}, for a view space that {axes}")
        }
        MatrixMeaning::Shear { linear, .. } => {
            let [x, y, z] = linear.map(list);
            format!("a shear with the rows {x}, {y}, {z}")
        }
        MatrixMeaning::ModelTransform { translation, axis, angle_degrees, scale } => {
            let first = match scale {
                [1.0, 1.0, 1.0] => String::new(),
                scale => format!("scale {}, ", list(*scale)),
            };
            let (turn, axis) = (format_number(*angle_degrees), list(*axis));
            let moved = list(*translation);
            format!(
                "a model transform: {first}rotation by {turn}° about {axis}, translation {moved}"
            )
        }
        MatrixMeaning::Viewport(viewport) => viewport_words(viewport),
        MatrixMeaning::Intrinsics(k) => {
            let [fx, fy, cx, cy] = [k.fx, k.fy, k.cx, k.cy].map(format_number);
            format!("camera intrinsics: fx {fx}, fy {fy}, cx {cx}, cy {cy}")
        }
        MatrixMeaning::ChapterP { n, f } => {
            format!("the textbook's P: n = {}, f = {}", format_number(*n), format_number(*f))
        }
        MatrixMeaning::ChapterPInverse { n, f } => {
            let [n, f] = [*n, *f].map(format_number);
            format!("the inverse of the textbook's P: n = {n}, f = {f}")
        }
        MatrixMeaning::Affine => "an affine map without a name".to_owned(),
        _ => "a projective map without a name".to_owned(),
    }
}

/// Returns the step with the first reading and all its parameters; `None` for a map without a name.
pub(super) fn meaning_steps(reading: &MatrixReading) -> Option<Step> {
    let meaning = &reading.meaning;
    if !meaning.is_named() {
        return None;
    }
    let step = Step::new("meaning", "Most likely reading", None).with_item(
        "reading",
        "reading",
        describe_meaning(reading),
    );
    let step = match meaning.convention() {
        Some(convention) => step.with_item("convention", "convention", volume_name(convention)),
        None => step,
    };
    let step = add_parameters(step, meaning);
    Some(step.with_item("factor", "common factor", reading.factor))
}

fn add_parameters(step: Step, meaning: &MatrixMeaning) -> Step {
    match meaning {
        meaning if meaning.convention().is_some() => add_view_parameters(step, meaning),
        MatrixMeaning::ObliqueShear { projection }
        | MatrixMeaning::ObliqueOntoPlane { projection } => add_oblique(step, projection),
        MatrixMeaning::Camera(camera) | MatrixMeaning::CameraPose(camera) => {
            add_camera(step.with_item("axes", "view space", axes_words(camera)), camera, "gaze")
        }
        MatrixMeaning::Rotation { camera, .. } => {
            add_camera(step, camera, "gaze, if it looks along -z")
        }
        MatrixMeaning::ModelTransform { translation, axis, angle_degrees, scale } => step
            .with_item("scale", "scale, applied first", *scale)
            .with_item("axis", "axis of the rotation", *axis)
            .with_item("angle", "angle of the rotation, degrees", *angle_degrees)
            .with_item("translation", "translation", *translation),
        MatrixMeaning::NPoint { projection, .. } => match projection.eye().divide() {
            Some(eye) => step.with_item("eye", "eye", <[f64; 3]>::from(eye)),
            None => step,
        },
        MatrixMeaning::CentralOntoPlane { plane_z, .. } => {
            step.with_item("plane", "plane z", *plane_z).with_item("eye", "eye", [0.0; 3])
        }
        MatrixMeaning::ChapterP { n, f } | MatrixMeaning::ChapterPInverse { n, f } => {
            step.with_item("n", "n", *n).with_item("f", "f", *f)
        }
        MatrixMeaning::Viewport(v) => step
            .with_item("size", "width, height", [v.width, v.height])
            .with_item("origin", "x, y", [v.x, v.y])
            .with_item("y", "y", if v.y_down { "down" } else { "up" })
            .with_item("depth", "depth of z = -1 and z = 1", v.depth),
        MatrixMeaning::Intrinsics(k) => step
            .with_item("focal_lengths", "fx, fy", [k.fx, k.fy])
            .with_item("principal_point", "cx, cy", [k.cx, k.cy])
            .with_item("skew", "skew", k.skew),
        MatrixMeaning::Windowing { scale, offset } => {
            let ends = |end: f64| [0, 1, 2].map(|axis| scale[axis] * end + offset[axis]);
            step.with_item("low", "(-1, -1, -1) maps to", ends(-1.0))
                .with_item("origin", "(0, 0, 0) maps to", ends(0.0))
                .with_item("high", "(1, 1, 1) maps to", ends(1.0))
        }
        _ => step,
    }
}

/// Adds the parameters of view volumes, also combined with a camera and a viewport.
fn add_view_parameters(step: Step, meaning: &MatrixMeaning) -> Step {
    match meaning {
        MatrixMeaning::Perspective { frustum: f, lens, convention }
        | MatrixMeaning::InversePerspective { frustum: f, lens, convention } => {
            let step = add_window(step, f.window(), [f.near(), f.far()]);
            add_lens(step, lens, *convention)
        }
        MatrixMeaning::ApexMoved { frustum: f, .. } => {
            let step = add_window(step, f.window(), [f.near(), f.far()]);
            step.with_item("apex", "apex", <[f64; 3]>::from(f.apex()))
        }
        MatrixMeaning::Orthographic { volume, .. } => {
            add_window(step, volume.window(), [volume.near(), volume.far()])
        }
        MatrixMeaning::ObliqueVolume { projection, volume, .. } => {
            let step = add_window(step, volume.window(), [volume.near(), volume.far()]);
            add_oblique(step, projection)
        }
        MatrixMeaning::CameraPerspective { camera, frustum: f, lens, convention } => {
            let step =
                add_window(add_camera(step, camera, "gaze"), f.window(), [f.near(), f.far()]);
            add_lens(step, lens, *convention)
        }
        MatrixMeaning::PerspectiveToPixels {
            size, camera, frustum: f, lens, convention, ..
        } => {
            let step = match camera {
                Some(camera) => add_camera(step, camera, "gaze"),
                None => step,
            };
            let step = step.with_item("size", "width, height", *size);
            let step = add_window(step, f.window(), [f.near(), f.far()]);
            add_lens(step, lens, *convention)
        }
        MatrixMeaning::CameraOrthographic { camera, volume, .. } => {
            let step = step.with_item("gaze", "gaze", camera.gaze).with_item("up", "up", camera.up);
            add_window(step, volume.window(), [volume.near(), volume.far()])
        }
        _ => step,
    }
}

fn add_camera(step: Step, camera: &CameraReading, gaze: &str) -> Step {
    step.with_item("eye", "eye", camera.eye)
        .with_item("gaze", gaze, camera.gaze)
        .with_item("up", "up", camera.up)
        .with_item("right", "right", camera.right)
}

fn add_window(step: Step, w: Window, [near, far]: [f64; 2]) -> Step {
    let step = step
        .with_item("window", "left, right, bottom, top", [w.left(), w.right(), w.bottom(), w.top()])
        .with_item("near", "near", near);
    if far.is_finite() {
        step.with_item("far", "far", far)
    } else {
        step.with_item("far", "far", "infinite")
    }
}

fn add_lens(step: Step, lens: &Lens, convention: Convention) -> Step {
    let step = step
        .with_item("fov_y", "vertical field of view, degrees", lens.fov_y_degrees)
        .with_item("fov_x", "horizontal field of view, degrees", lens.fov_x_degrees)
        .with_item("aspect", "aspect, width / height", lens.aspect)
        .with_item("focal_lengths", "focal lengths, half widths and heights", lens.focal_lengths);
    let turned = convention.ahead() > 0.0;
    step.with_item("looks", "looks along", if turned { "+z" } else { "-z" })
}

fn add_oblique(step: Step, oblique: &Oblique) -> Step {
    let phi = oblique.phi().to_degrees();
    step.with_item("length", "drawn length of a unit of depth", oblique.length())
        .with_item("angle", "angle of the depth axis, degrees, for z toward the viewer", phi)
        .with_item("projectors", "projectors to plane, degrees", oblique.alpha().to_degrees())
        .with_item("plane", "plane z", oblique.plane_z())
}
