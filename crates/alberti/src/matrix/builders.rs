//! Builders for the flags of `alberti matrix`: they call the library and add factors and formulas.

use super::super::CliError;
use super::build::{BuildOptions, Built, BuiltMatrix, DISTANCES, NumberList, wrong_count};
use camera::Camera;
use explain::ApiConventions;
use glam::{DMat3, DMat4};
use homog::{Affine, Point, Space, Vector, View, World};
use projection::{
    ApexMovedFrustum, Axonometric, Convention, Fov, Frustum, Intrinsics, NPoint, Oblique,
    Orthographic, Perspective, ProjectionError, chapter,
};
use viewport::{Limits, Rectangle, WindowToViewport};

fn built(subject: String, formula: &'static str, matrix: DMat4) -> BuiltMatrix {
    BuiltMatrix { formula: Some(formula), ..BuiltMatrix::new(subject, matrix) }
}

/// Reports a rejected parameter as wrong usage.
fn refused(error: impl std::error::Error) -> CliError {
    CliError::Usage(error.to_string())
}

/// Rejects coordinates in place of distances. In the textbook's conventions, an orthographic box
/// must not begin behind the eye, because -1 would be a coordinate.
fn check_distances(flag: &str, near: f64, far: f64, least: f64) -> Result<(), CliError> {
    if near >= least && far > 0.0 {
        return Ok(());
    }
    let message = format!("--{flag} has near {near} and far {far}: {DISTANCES}");
    Err(CliError::Usage(message))
}

/// Returns the minimum near distance of a box.
fn least_near(options: BuildOptions) -> f64 {
    let textbook = [ApiConventions::Chapter, ApiConventions::ChapterYDown, ApiConventions::Alberti];
    if textbook.contains(&options.conventions()) { 0.0 } else { f64::NEG_INFINITY }
}

/// Returns the formula id of a perspective matrix in a convention.
fn perspective_formula(volume: Convention, by_angle: bool, infinite: bool) -> &'static str {
    let either = |angle, window| if by_angle { angle } else { window };
    let right_handed = volume.ahead() < 0.0;
    match volume {
        Convention::CHAPTER => either("FOV-1, PE-3", "PE-3"),
        Convention::OPENGL if infinite => "IF-1",
        Convention::OPENGL => either("GL-2", "GL-1"),
        Convention::DIRECT3D => either("D3D-1", "D3D-3"),
        _ if volume.near_depth() > volume.far_depth() && infinite && right_handed => "IF-3",
        _ if volume.near_depth() > volume.far_depth() => "RV-1",
        _ if infinite => "IF-2",
        _ => either("D3D-2", "D3D-4"),
    }
}

/// Returns the formula id of an orthographic matrix in a convention; WI-3 for rare conventions.
fn box_formula(volume: Convention) -> &'static str {
    match volume {
        Convention::CHAPTER => "OR-1",
        Convention::OPENGL => "GL-3",
        Convention::DIRECT3D => "D3D-5",
        Convention::VULKAN | Convention::WEBGPU => "D3D-6",
        _ => "WI-3",
    }
}

/// Replaces rounding noise with 0: entries below 1e-15, and offsets below 1e-15 times the largest.
fn without_noise(matrix: DMat4) -> DMat4 {
    let clean = |column: glam::DVec4| {
        let kept = column.to_array().map(|entry| if entry.abs() < 1e-15 { 0.0 } else { entry });
        glam::DVec4::from_array(kept)
    };
    let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(clean);
    let offset = matrix.w_axis.truncate();
    let least = 1e-15 * offset.abs().max_element().max(1.0);
    let kept = offset.to_array().map(|entry| if entry.abs() < least { 0.0 } else { entry });
    DMat4::from_cols(x, y, z, glam::DVec3::from_array(kept).extend(matrix.w_axis.w))
}

fn perspective_of(subject: String, frustum: Frustum, options: BuildOptions) -> BuiltMatrix {
    let volume = options.volume();
    let factors = frustum.factors(volume);
    let matrix = frustum.view_to_clip(volume).raw();
    let formula = perspective_formula(volume, false, frustum.far().is_infinite());
    let note = (volume == Convention::CHAPTER).then_some(
        "-M_per: w is the distance ahead. The textbook prints the negative, M_per (PE-2): w = z",
    );
    let factors = vec![
        ("shear, the center line onto the line of sight", factors.shear.raw()),
        ("scale, sides to x, y = ±distance", factors.scale.raw()),
        ("depth, and w = distance", factors.depth.raw()),
    ];
    BuiltMatrix { factors, note, factor_formula: Some("VV-2"), ..built(subject, formula, matrix) }
}

pub(super) fn build_perspective(list: &NumberList, options: BuildOptions) -> Built {
    let [fovy, aspect, near, far] = list.exactly("perspective")?;
    check_distances("perspective", near, far, 0.0)?;
    let lens = Perspective::new(Fov::vertical_degrees(fovy), aspect, near, far).map_err(refused)?;
    let subject = format!(
        "A perspective projection: vertical field of view {fovy}°, aspect {aspect}, near {near}, far {far}"
    );
    let matrix = lens.view_to_clip(options.volume()).raw();
    let formula = Some(perspective_formula(options.volume(), true, far.is_infinite()));
    Ok(BuiltMatrix { matrix, formula, ..perspective_of(subject, lens.to_frustum(), options) })
}

fn volume_words([l, r, b, t, n, f]: [f64; 6]) -> String {
    format!("left {l}, right {r}, bottom {b}, top {t}, near {n}, far {f}")
}

pub(super) fn build_frustum(list: &NumberList, options: BuildOptions) -> Built {
    let numbers: [f64; 6] = list.exactly("frustum")?;
    let [l, r, b, t, n, f] = numbers;
    check_distances("frustum", n, f, 0.0)?;
    let frustum = Frustum::new(l, r, b, t, n, f).map_err(refused)?;
    let subject = format!("A perspective projection: {}", volume_words(numbers));
    Ok(perspective_of(subject, frustum, options))
}

pub(super) fn build_moved_apex(list: &NumberList, options: BuildOptions) -> Built {
    let numbers: [f64; 6] = list.exactly("moved-apex")?;
    let [l, r, b, t, n, f] = numbers;
    check_distances("moved-apex", n, f, 0.0)?;
    let frustum = ApexMovedFrustum::new(l, r, b, t, n, f).map_err(refused)?;
    let steps = frustum.steps(options.volume());
    let factors = vec![
        ("Eq2, the apex to the origin", steps.move_apex.raw()),
        ("Eq7, the depth, and w = distance", steps.map_depth.raw()),
        ("Eq3, x and y onto the near plane", steps.project.raw()),
        ("Eq6, the window to 2 × 2", steps.scale_window.raw()),
    ];
    let subject = format!("A perspective projection, apex moved: {}", volume_words(numbers));
    let matrix = frustum.view_to_clip(options.volume()).raw();
    Ok(BuiltMatrix { factors, ..built(subject, "LW-1", matrix) })
}

pub(super) fn build_intrinsics(list: &NumberList, options: BuildOptions) -> Built {
    let [fx, fy, cx, cy, width, height, near, far] = list.exactly("intrinsics")?;
    check_distances("intrinsics", near, far, 0.0)?;
    let side = |name: &str, value: f64| {
        let is_whole = value >= 1.0 && value <= f64::from(u32::MAX) && value == libm::floor(value);
        let message = || format!("--intrinsics: the {name} must be a whole number, not {value}");
        is_whole.then_some(value as u32).ok_or_else(|| CliError::Usage(message()))
    };
    let size = [side("width", width)?, side("height", height)?];
    let lens = Intrinsics::new([fx, fy], [cx, cy], size).map_err(refused)?;
    let frustum = lens.to_frustum(near, far).map_err(refused)?;
    let subject = format!(
        "A calibrated camera: fx {fx}, fy {fy}, cx {cx}, cy {cy}, {width} x {height} pixels, near {near}, far {far}"
    );
    Ok(perspective_of(subject, frustum, options))
}

pub(super) fn build_ortho(list: &NumberList, options: BuildOptions) -> Built {
    let numbers: [f64; 6] = list.exactly("ortho")?;
    let [l, r, b, t, n, f] = numbers;
    check_distances("ortho", n, f, least_near(options))?;
    if n > f {
        return Err(refused(ProjectionError::FarNotBeyondNear { near: n, far: f }));
    }
    let volume = Orthographic::new(l, r, b, t, n, f).map_err(refused)?;
    let subject = format!("An orthographic box: {}", volume_words(numbers));
    let matrix = volume.view_to_clip(options.volume()).raw();
    let middle = DMat4::from_translation(-matrix.inverse().w_axis.truncate());
    let [x, y, z] = [matrix.x_axis.x, matrix.y_axis.y, matrix.z_axis.z];
    let scale = DMat4::from_scale(glam::DVec3::new(x, y, z));
    let factors = vec![("translation, the center to the origin", middle), ("scale", scale)];
    let formula = box_formula(options.volume());
    Ok(BuiltMatrix { factors, ..built(subject, formula, matrix) })
}

pub(super) fn build_p(list: &NumberList, _: BuildOptions) -> Built {
    let [n, f] = list.exactly("p")?;
    let matrix = chapter::p(n, f).map_err(refused)?.raw();
    let note = Some(
        "the inverse below is P⁻¹ itself; the textbook prints n f P⁻¹, without fractions, as \
         `alberti explain --planes N,F` does",
    );
    Ok(BuiltMatrix { note, ..built(format!("The textbook's P: n = {n}, f = {f}"), "PE-1", matrix) })
}

pub(super) fn build_oblique(list: &NumberList, options: BuildOptions) -> Built {
    let &[length, angle, ref rest @ ..] = list.0.as_slice() else {
        return Err(wrong_count("--oblique", "2 or 8", list.0.len()));
    };
    let oblique = Oblique::new(length, angle.to_radians()).map_err(refused)?;
    let subject = format!("An oblique projection: length {length}, angle {angle}°");
    if rest.is_empty() {
        options.refuse_volume("--oblique without a volume")?;
        let matrix =
            if options.onto_plane { oblique.onto_plane() } else { oblique.depth_preserving() };
        return Ok(built(subject, "OB-1", matrix.raw()));
    }
    let numbers: [f64; 6] = NumberList(rest.to_vec()).exactly("oblique with a volume")?;
    let [l, r, b, t, n, f] = numbers;
    if options.onto_plane {
        let message = "--onto-plane drops z, but --oblique with a volume keeps it; omit the flag \
                       or the volume";
        return Err(CliError::Usage(message.to_owned()));
    }
    check_distances("oblique", n, f, least_near(options))?;
    let volume = Orthographic::new(l, r, b, t, n, f).map_err(refused)?;
    let factors = oblique.factors(volume, options.volume());
    let matrix = factors.view_to_clip().raw();
    let factors = vec![
        ("shear: projectors perpendicular to the picture", factors.shear.raw()),
        ("fit, the box to the canonical volume", factors.fit.raw()),
    ];
    let subject = format!("{subject}, {}", volume_words(numbers));
    Ok(BuiltMatrix { factors, ..built(subject, "OB-1, VV-1", matrix) })
}

pub(super) fn build_axonometric(list: &NumberList, options: BuildOptions) -> Built {
    let [alpha, beta] = list.exactly("axonometric")?;
    let projection =
        Axonometric::by_angles(alpha.to_radians(), beta.to_radians()).map_err(refused)?;
    let matrix =
        if options.onto_plane { projection.onto_plane() } else { projection.depth_preserving() };
    let mut factors = vec![
        ("rotation about y by −α", Affine::<View, View>::rotation_y(-alpha.to_radians()).raw()),
        ("rotation about x by β", Affine::<View, View>::rotation_x(beta.to_radians()).raw()),
    ];
    if options.onto_plane {
        let drop = Affine::<View, View>::scale(1.0, 1.0, 0.0).raw();
        factors.push(("projection onto the plane z = 0", drop));
    }
    let subject = format!("An axonometric projection: α = {alpha}°, β = {beta}°");
    Ok(BuiltMatrix { factors, ..built(subject, "AX-1", matrix.raw()) })
}

pub(super) fn build_n_point(list: &NumberList, options: BuildOptions) -> Built {
    let [p, q, r] = list.exactly("n-point")?;
    let projection = NPoint::new(p, q, r).map_err(refused)?;
    let matrix =
        if options.onto_plane { projection.onto_plane() } else { projection.depth_preserving() };
    let points = match projection.count() {
        1 => "one vanishing point".to_owned(),
        count => format!("{count} vanishing points"),
    };
    let subject = format!("A perspective projection with {points}: ({p}, {q}, {r}, 1)");
    let formula = match projection.count() {
        1 => "ONE-1",
        2 => "TWO-1",
        _ => "THREE-1",
    };
    Ok(built(subject, formula, matrix.raw()))
}

pub(super) fn build_look_at(list: &NumberList, options: BuildOptions) -> Built {
    let [ex, ey, ez, tx, ty, tz, ux, uy, uz] = match list.0.len() {
        6 => NumberList([&list.0[..], &[0.0, 1.0, 0.0]].concat()).exactly("look-at")?,
        9 => list.exactly("look-at")?,
        found => {
            return Err(wrong_count("--look-at", "6 or 9", found));
        }
    };
    let up = Vector::<World>::new(ux, uy, uz);
    let camera = Camera::look_at(Point::new(ex, ey, ez), Point::new(tx, ty, tz), up);
    let subject = format!("A camera at ({ex}, {ey}, {ez}) that looks at ({tx}, {ty}, {tz})");
    Ok(camera_of(subject, camera.map_err(refused)?, options))
}

pub(super) fn build_look_to(list: &NumberList, options: BuildOptions) -> Built {
    let [ex, ey, ez, gx, gy, gz, ux, uy, uz] = match list.0.len() {
        6 => NumberList([&list.0[..], &[0.0, 1.0, 0.0]].concat()).exactly("look-to")?,
        9 => list.exactly("look-to")?,
        found => {
            return Err(wrong_count("--look-to", "6 or 9", found));
        }
    };
    let (gaze, up) = (Vector::<World>::new(gx, gy, gz), Vector::new(ux, uy, uz));
    let camera = Camera::look_to(Point::new(ex, ey, ez), gaze, up).map_err(refused)?;
    let subject = format!("A camera at ({ex}, {ey}, {ez}) that looks along ({gx}, {gy}, {gz})");
    Ok(camera_of(subject, camera, options))
}

fn camera_of(subject: String, camera: Camera, options: BuildOptions) -> BuiltMatrix {
    // A left-handed world has the same up vector and line of sight, but the opposite right vector.
    let left_handed = options.volume().ahead() > 0.0;
    let side = if left_handed { -1.0 } else { 1.0 };
    let turn = DMat4::from_diagonal(glam::DVec4::new(side, 1.0, side, 1.0));
    let note = left_handed.then_some(
        "XMMatrixLookAtLH: the world is left-handed too, and z is the distance ahead; for a \
         right-handed world (glTF), use --conventions webgpu",
    );
    let view = camera.world_to_view().raw();
    let rotation = without_noise(DMat4::from_mat3(DMat3::from_mat4(view)));
    let factors = vec![
        ("translation, the eye to the origin", DMat4::from_translation(-camera.eye().raw())),
        ("rotation, u v w to the axes", turn * rotation),
    ];
    BuiltMatrix { factors, note, ..built(subject, "CA-1, CA-2", without_noise(turn * view)) }
}

pub(super) fn build_viewport(list: &NumberList, options: BuildOptions) -> Built {
    let [x, y, width, height] = match *list.0.as_slice() {
        [width, height] => [0.0, 0.0, width, height],
        [x, y, width, height] => [x, y, width, height],
        _ => return Err(wrong_count("--viewport", "2 or 4", list.0.len())),
    };
    let area = Rectangle::new(x, y, width, height).map_err(refused)?;
    let conventions = options.conventions();
    let viewport = conventions.viewport(area);
    let subject = format!("A viewport of {width} × {height} pixels at ({x}, {y})");
    Ok(built(subject, conventions.viewport_formulas(), viewport.ndc_to_screen().raw()))
}

/// Extends a map of the plane to space, keeping z unchanged.
fn lift(plane: DMat3) -> DMat4 {
    let [x, y, w] = [plane.x_axis, plane.y_axis, plane.z_axis];
    let column = |v: glam::DVec3| glam::DVec4::new(v.x, v.y, 0.0, v.z);
    DMat4::from_cols(column(x), column(y), glam::DVec4::Z, column(w))
}

pub(super) fn build_window_to_viewport(list: &NumberList, _: BuildOptions) -> Built {
    let [l, r, b, t, vl, vr, vb, vt] = list.exactly("window-to-viewport")?;
    let (window, viewport) = (Limits { x: [l, r], y: [b, t] }, Limits { x: [vl, vr], y: [vb, vt] });
    let map = WindowToViewport::new(window, viewport).map_err(refused)?;
    let [to_origin, scale, to_place] = map.factor_chain().map(|factor| lift(factor.raw()));
    let subject =
        format!("The window [{l}, {r}] × [{b}, {t}] to the viewport [{vl}, {vr}] × [{vb}, {vt}]");
    let factors = vec![
        ("translation, the window to the origin", to_origin),
        ("scale", scale),
        ("translation to the viewport", to_place),
    ];
    Ok(BuiltMatrix { factors, ..built(subject, "WV-1, WV-2", lift(map.homography().raw())) })
}

fn affine<S: Space>(subject: String, formula: &'static str, map: Affine<S, S>) -> Built {
    let finite = map.is_finite();
    let message = "every number must be finite".to_owned();
    let matrix = without_noise(map.raw());
    finite.then(|| built(subject, formula, matrix)).ok_or(CliError::Usage(message))
}

pub(super) fn build_translation(list: &NumberList, _: BuildOptions) -> Built {
    let [x, y, z] = list.exactly("translate")?;
    let map = Affine::<World, World>::translation(Vector::new(x, y, z));
    affine(format!("A translation by ({x}, {y}, {z})"), "HO-4", map)
}

pub(super) fn build_scale(list: &NumberList, _: BuildOptions) -> Built {
    let [x, y, z] = list.exactly("scale")?;
    affine(format!("A scale by ({x}, {y}, {z})"), "WI-3", Affine::<World, World>::scale(x, y, z))
}

pub(super) fn build_rotation(list: &NumberList, _: BuildOptions) -> Built {
    let [x, y, z, degrees] = list.exactly("rotate")?;
    let map = Affine::<World, World>::rotation(Vector::new(x, y, z), degrees.to_radians());
    let map =
        map.ok_or_else(|| CliError::Usage("--rotate needs an axis other than 0,0,0".into()))?;
    affine(format!("A rotation by {degrees}° about ({x}, {y}, {z})"), "HO-3", map)
}
