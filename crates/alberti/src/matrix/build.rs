//! Matrices from parameters: the flags, and the library's builder behind each.

use super::super::CliError;
use super::parse_number;
use camera::Camera;
use glam::{DMat3, DMat4};
use homog::{Affine, Point, Space, Vector, View, World};
use pipeline::explain::ApiConventions;
use projection::{
    ApexMovedFrustum, Axonometric, Convention, Fov, Frustum, NPoint, Oblique, Orthographic,
    Perspective, chapter,
};
use viewport::{Limits, Rectangle, Viewport, WindowToViewport};

/// The matrix to build; distances are positive, angles in degrees.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Matrix from parameters")]
#[group(multiple = false)]
pub(super) struct BuildArgs {
    /// Perspective by its vertical field of view in degrees; FAR may be `inf`
    #[arg(long, value_name = "FOVY,ASPECT,NEAR,FAR", value_parser = parse_list, allow_hyphen_values = true)]
    perspective: Option<NumberList>,
    /// Perspective by its window on the near plane, as glFrustum; F may be `inf`
    #[arg(long, value_name = "L,R,B,T,N,F", value_parser = parse_list, allow_hyphen_values = true)]
    frustum: Option<NumberList>,
    /// Perspective of the WebGL lesson: its apex moved behind the window's center
    #[arg(long, value_name = "L,R,B,T,N,F", value_parser = parse_list, allow_hyphen_values = true)]
    moved_apex: Option<NumberList>,
    /// Orthographic box, as glOrtho
    #[arg(long, value_name = "L,R,B,T,N,F", value_parser = parse_list, allow_hyphen_values = true)]
    ortho: Option<NumberList>,
    /// The textbook's P for its signed n and f, such as -1,-10
    #[arg(long, value_name = "N,F", value_parser = parse_list, allow_hyphen_values = true)]
    p: Option<NumberList>,
    /// Oblique projection by the drawn length of a unit of depth and its angle in degrees; with six
    /// more numbers the whole volume
    #[arg(long, value_name = "LENGTH,ANGLE[,L,R,B,T,N,F]", value_parser = parse_list, allow_hyphen_values = true)]
    oblique: Option<NumberList>,
    /// Axonometric projection by the angles about y and x in degrees; 45,35.26439 is isometric
    #[arg(long, value_name = "ALPHA,BETA", value_parser = parse_list, allow_hyphen_values = true)]
    axonometric: Option<NumberList>,
    /// One-, two- or three-point perspective by its bottom row (p, q, r, 1)
    #[arg(long, value_name = "P,Q,R", value_parser = parse_list, allow_hyphen_values = true)]
    n_point: Option<NumberList>,
    /// Camera by its eye, the point it looks at and, unless it is y, the direction that is up
    #[arg(long, value_name = "EYE,TARGET[,UP]", value_parser = parse_list, allow_hyphen_values = true)]
    look_at: Option<NumberList>,
    /// Viewport of an image, or of a rectangle in one
    #[arg(long, value_name = "[X,Y,]WIDTH,HEIGHT", value_parser = parse_list, allow_hyphen_values = true)]
    viewport: Option<NumberList>,
    /// Window to viewport: left, right, bottom and top of both
    #[arg(long, value_name = "L,R,B,T,L,R,B,T", value_parser = parse_list, allow_hyphen_values = true)]
    window_to_viewport: Option<NumberList>,
    /// Translation
    #[arg(long, value_name = "X,Y,Z", value_parser = parse_list, allow_hyphen_values = true)]
    translate: Option<NumberList>,
    /// Scale
    #[arg(long, value_name = "X,Y,Z", value_parser = parse_list, allow_hyphen_values = true)]
    scale: Option<NumberList>,
    /// Rotation about an axis through the origin
    #[arg(long, value_name = "X,Y,Z,DEGREES", value_parser = parse_list, allow_hyphen_values = true)]
    rotate: Option<NumberList>,
}

/// Numbers separated by commas; how many depends on the flag.
#[derive(Clone, Debug)]
struct NumberList(Vec<f64>);

fn parse_list(text: &str) -> Result<NumberList, String> {
    text.split(',').map(|word| parse_number(word.trim())).collect::<Result<_, _>>().map(NumberList)
}

impl NumberList {
    fn exactly<const N: usize>(&self, flag: &str) -> Result<[f64; N], CliError> {
        let found = self.0.len();
        <[f64; N]>::try_from(self.0.as_slice())
            .map_err(|_| CliError::Usage(format!("--{flag} takes {N} numbers, found {found}")))
    }
}

/// The conventions and form of the matrix.
#[derive(Clone, Copy, Debug)]
pub(super) struct BuildOptions {
    pub(super) conventions: ApiConventions,
    pub(super) reversed: bool,
    pub(super) onto_plane: bool,
}

impl BuildOptions {
    fn volume(self) -> Convention {
        let volume = self.conventions.canonical_volume();
        if self.reversed { volume.reversed() } else { volume }
    }
}

/// A matrix with its factors.
#[derive(Debug)]
pub(super) struct BuiltMatrix {
    /// Its name with the parameters.
    pub(super) subject: String,
    /// The ids of its formulas.
    pub(super) formula: &'static str,
    pub(super) matrix: DMat4,
    /// Names and matrices, in the order a point passes them; their product is the matrix.
    pub(super) factors: Vec<(&'static str, DMat4)>,
}

type Built = Result<BuiltMatrix, CliError>;

/// A refused parameter is wrong usage.
fn refused(error: impl std::error::Error) -> CliError {
    CliError::Usage(error.to_string())
}

impl BuildArgs {
    /// Builds the matrix that a flag asks for; `None` without a flag.
    ///
    /// # Errors
    /// If the number of parameters is wrong, or the builder refuses one.
    pub(super) fn build(&self, options: BuildOptions) -> Option<Built> {
        type Builder = fn(&NumberList, BuildOptions) -> Built;
        let builders: [(&Option<NumberList>, Builder); 14] = [
            (&self.perspective, build_perspective),
            (&self.frustum, build_frustum),
            (&self.moved_apex, build_moved_apex),
            (&self.ortho, build_ortho),
            (&self.p, build_p),
            (&self.oblique, build_oblique),
            (&self.axonometric, build_axonometric),
            (&self.n_point, build_n_point),
            (&self.look_at, build_look_at),
            (&self.viewport, build_viewport),
            (&self.window_to_viewport, build_window_to_viewport),
            (&self.translate, build_translation),
            (&self.scale, build_scale),
            (&self.rotate, build_rotation),
        ];
        let asked = builders.into_iter().find_map(|(list, build)| Some((list.as_ref()?, build)));
        asked.map(|(list, build)| build(list, options))
    }
}

fn built(subject: String, formula: &'static str, matrix: DMat4) -> BuiltMatrix {
    BuiltMatrix { subject, formula, matrix, factors: Vec::new() }
}

/// The matrix with 0 for entries of its rotation that are rounding: below 1e-15 of a row of length
/// 1.
fn without_rounding(matrix: DMat4) -> DMat4 {
    let clean = |column: glam::DVec4| {
        let kept = column.to_array().map(|entry| if entry.abs() < 1e-15 { 0.0 } else { entry });
        glam::DVec4::from_array(kept)
    };
    let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(clean);
    DMat4::from_cols(x, y, z, matrix.w_axis)
}

fn perspective_of(subject: String, frustum: Frustum, options: BuildOptions) -> BuiltMatrix {
    let factors = frustum.factors(options.volume());
    let matrix = frustum.view_to_clip(options.volume()).raw();
    let formula = match options.conventions {
        ApiConventions::Alberti | ApiConventions::Chapter => "PE-2, PE-3, VV-2",
        ApiConventions::OpenGl => "GL-1, VV-2",
        _ => "D3D-2, VV-2",
    };
    let factors = vec![
        ("shear, the center line onto the line of sight", factors.shear.raw()),
        ("scale, sides to x, y = ±distance", factors.scale.raw()),
        ("depth, and w = distance", factors.depth.raw()),
    ];
    BuiltMatrix { factors, ..built(subject, formula, matrix) }
}

fn build_perspective(list: &NumberList, options: BuildOptions) -> Built {
    let [fovy, aspect, near, far] = list.exactly("perspective")?;
    let lens = Perspective::new(Fov::vertical_degrees(fovy), aspect, near, far).map_err(refused)?;
    let subject = format!(
        "A perspective: vertical field of view {fovy}°, aspect {aspect}, near {near}, far {far}"
    );
    let matrix = lens.view_to_clip(options.volume()).raw();
    Ok(BuiltMatrix { matrix, ..perspective_of(subject, lens.to_frustum(), options) })
}

fn volume_words([l, r, b, t, n, f]: [f64; 6]) -> String {
    format!("left {l}, right {r}, bottom {b}, top {t}, near {n}, far {f}")
}

fn build_frustum(list: &NumberList, options: BuildOptions) -> Built {
    let numbers: [f64; 6] = list.exactly("frustum")?;
    let [l, r, b, t, n, f] = numbers;
    let frustum = Frustum::new(l, r, b, t, n, f).map_err(refused)?;
    Ok(perspective_of(format!("A perspective: {}", volume_words(numbers)), frustum, options))
}

fn build_moved_apex(list: &NumberList, options: BuildOptions) -> Built {
    let numbers: [f64; 6] = list.exactly("moved-apex")?;
    let [l, r, b, t, n, f] = numbers;
    let frustum = ApexMovedFrustum::new(l, r, b, t, n, f).map_err(refused)?;
    let steps = frustum.steps(options.volume());
    let factors = vec![
        ("Eq2, the apex to the origin", steps.move_apex.raw()),
        ("Eq7, the depth, and w = distance", steps.map_depth.raw()),
        ("Eq3, x and y onto the near plane", steps.project.raw()),
        ("Eq6, the window to 2 × 2", steps.scale_window.raw()),
    ];
    let subject = format!("A perspective with its apex moved: {}", volume_words(numbers));
    let matrix = frustum.view_to_clip(options.volume()).raw();
    Ok(BuiltMatrix { factors, ..built(subject, "LW-1", matrix) })
}

fn build_ortho(list: &NumberList, options: BuildOptions) -> Built {
    let numbers: [f64; 6] = list.exactly("ortho")?;
    let [l, r, b, t, n, f] = numbers;
    let volume = Orthographic::new(l, r, b, t, n, f).map_err(refused)?;
    let subject = format!("An orthographic box: {}", volume_words(numbers));
    let matrix = volume.view_to_clip(options.volume()).raw();
    let middle = DMat4::from_translation(-matrix.inverse().w_axis.truncate());
    let [x, y, z] = [matrix.x_axis.x, matrix.y_axis.y, matrix.z_axis.z];
    let scale = DMat4::from_scale(glam::DVec3::new(x, y, z));
    let factors = vec![("translation, the center to the origin", middle), ("scale", scale)];
    Ok(BuiltMatrix { factors, ..built(subject, "OR-1, GL-3", matrix) })
}

fn build_p(list: &NumberList, _: BuildOptions) -> Built {
    let [n, f] = list.exactly("p")?;
    let matrix = chapter::p(n, f).map_err(refused)?.raw();
    Ok(built(format!("The textbook's P: n = {n}, f = {f}"), "PE-1", matrix))
}

fn build_oblique(list: &NumberList, options: BuildOptions) -> Built {
    let &[length, angle, ref rest @ ..] = list.0.as_slice() else {
        return Err(CliError::Usage("--oblique takes 2 or 8 numbers".to_owned()));
    };
    let oblique = Oblique::new(length, angle.to_radians()).map_err(refused)?;
    let subject = format!("An oblique projection: length {length}, angle {angle}°");
    if rest.is_empty() {
        let matrix =
            if options.onto_plane { oblique.onto_plane() } else { oblique.depth_preserving() };
        return Ok(built(subject, "OB-1", matrix.raw()));
    }
    let numbers: [f64; 6] = NumberList(rest.to_vec()).exactly("oblique with a volume")?;
    let [l, r, b, t, n, f] = numbers;
    let volume = Orthographic::new(l, r, b, t, n, f).map_err(refused)?;
    let factors = oblique.factors(volume, options.volume());
    let matrix = factors.view_to_clip().raw();
    let factors = vec![
        ("shear, the projectors upright", factors.shear.raw()),
        ("fit, the box to the canonical volume", factors.fit.raw()),
    ];
    let subject = format!("{subject}, {}", volume_words(numbers));
    Ok(BuiltMatrix { factors, ..built(subject, "OB-1, VV-1", matrix) })
}

fn build_axonometric(list: &NumberList, options: BuildOptions) -> Built {
    let [alpha, beta] = list.exactly("axonometric")?;
    let projection =
        Axonometric::by_angles(alpha.to_radians(), beta.to_radians()).map_err(refused)?;
    let matrix =
        if options.onto_plane { projection.onto_plane() } else { projection.depth_preserving() };
    let factors = vec![
        ("rotation about y by −α", Affine::<View, View>::rotation_y(-alpha.to_radians()).raw()),
        ("rotation about x by β", Affine::<View, View>::rotation_x(beta.to_radians()).raw()),
    ];
    let subject = format!("An axonometric projection: α = {alpha}°, β = {beta}°");
    Ok(BuiltMatrix { factors, ..built(subject, "AX-1", matrix.raw()) })
}

fn build_n_point(list: &NumberList, options: BuildOptions) -> Built {
    let [p, q, r] = list.exactly("n-point")?;
    let projection = NPoint::new(p, q, r).map_err(refused)?;
    let matrix =
        if options.onto_plane { projection.onto_plane() } else { projection.depth_preserving() };
    let points = match projection.count() {
        1 => "one vanishing point".to_owned(),
        count => format!("{count} vanishing points"),
    };
    let subject = format!("A perspective of {points}: ({p}, {q}, {r}, 1)");
    Ok(built(subject, "ONE-1, TWO-1, THREE-1", matrix.raw()))
}

fn build_look_at(list: &NumberList, options: BuildOptions) -> Built {
    let [ex, ey, ez, tx, ty, tz, ux, uy, uz] = match list.0.len() {
        6 => NumberList([&list.0[..], &[0.0, 1.0, 0.0]].concat()).exactly("look-at")?,
        9 => list.exactly("look-at")?,
        found => {
            let message = format!("--look-at takes 6 or 9 numbers, found {found}");
            return Err(CliError::Usage(message));
        }
    };
    let (eye, up) = (Point::new(ex, ey, ez), Vector::<World>::new(ux, uy, uz));
    let camera = Camera::look_at(eye, Point::new(tx, ty, tz), up).map_err(refused)?;
    // A view space that looks along +z has the same x and y.
    let turn = DMat4::from_diagonal(glam::DVec4::new(1.0, 1.0, -options.volume().ahead(), 1.0));
    let view = camera.world_to_view().raw();
    let rotation = DMat4::from_mat3(DMat3::from_mat4(view));
    let subject = format!("A camera at ({ex}, {ey}, {ez}) that looks at ({tx}, {ty}, {tz})");
    let factors = vec![
        ("translation, the eye to the origin", DMat4::from_translation(-eye.raw())),
        ("rotation, u v w to the axes", turn * rotation),
    ];
    Ok(BuiltMatrix { factors, ..built(subject, "CA-1, CA-2", without_rounding(turn * view)) })
}

fn build_viewport(list: &NumberList, options: BuildOptions) -> Built {
    let [x, y, width, height] = match *list.0.as_slice() {
        [width, height] => [0.0, 0.0, width, height],
        [x, y, width, height] => [x, y, width, height],
        _ => return Err(CliError::Usage("--viewport takes 2 or 4 numbers".to_owned())),
    };
    let area = Rectangle::new(x, y, width, height).map_err(refused)?;
    let conventions = options.conventions;
    let viewport = Viewport::new(area, conventions.pixel_convention(), conventions.depth_range());
    let subject = format!("A viewport of {width} × {height} pixels at ({x}, {y})");
    Ok(built(subject, "VP-1, VP-3", viewport.ndc_to_screen().raw()))
}

/// A map of the plane as one of space that leaves z alone.
fn lift(plane: DMat3) -> DMat4 {
    let [x, y, w] = [plane.x_axis, plane.y_axis, plane.z_axis];
    let column = |v: glam::DVec3| glam::DVec4::new(v.x, v.y, 0.0, v.z);
    DMat4::from_cols(column(x), column(y), glam::DVec4::Z, column(w))
}

fn build_window_to_viewport(list: &NumberList, _: BuildOptions) -> Built {
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
    finite.then(|| built(subject, formula, map.raw())).ok_or(CliError::Usage(message))
}

fn build_translation(list: &NumberList, _: BuildOptions) -> Built {
    let [x, y, z] = list.exactly("translate")?;
    let map = Affine::<World, World>::translation(Vector::new(x, y, z));
    affine(format!("A translation by ({x}, {y}, {z})"), "HO-4", map)
}

fn build_scale(list: &NumberList, _: BuildOptions) -> Built {
    let [x, y, z] = list.exactly("scale")?;
    affine(format!("A scale by ({x}, {y}, {z})"), "HO-5", Affine::<World, World>::scale(x, y, z))
}

fn build_rotation(list: &NumberList, _: BuildOptions) -> Built {
    let [x, y, z, degrees] = list.exactly("rotate")?;
    let map = Affine::<World, World>::rotation(Vector::new(x, y, z), degrees.to_radians());
    let map =
        map.ok_or_else(|| CliError::Usage("--rotate needs an axis other than 0,0,0".into()))?;
    affine(format!("A rotation by {degrees}° about ({x}, {y}, {z})"), "HO-5", map)
}
