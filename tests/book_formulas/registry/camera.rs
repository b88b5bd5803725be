//! Registry entries for cameras, viewing rays, stereo and intrinsics (CA-1 to CA-3).

use super::inputs::{Inputs, give};
use super::screen::pixels;
use super::{Entry, Extras};
use camera::{Basis, Camera, Orbit, StereoRig, ViewWindow};
use homog::{Point, Vector, World};
use projection::{Fov, Intrinsics, Perspective, chapter};
use std::error::Error;
use viewport::Viewport;

const GAZE: &str = "\\mathbf{g} \\mathbf{t}";
const PLACED: &str = "\\mathbf{e} \\mathbf{g} \\mathbf{t}";

pub const ENTRIES: &[Entry] = &[
    Entry::new("CA-1.w", "\\mathbf{g}", |v| {
        give(Basis::from_gaze_or_fallback(v.vector("g")?.into(), Vector::Y)?.w())
    }),
    Entry::new("CA-1.u", GAZE, |v| give(basis(v)?.u())).with_extras(basis_extras),
    Entry::new("CA-1.v", GAZE, |v| give(basis(v)?.v())).with_extras(basis_extras),
    Entry::new("CA-2", PLACED, |v| give(camera(v)?.world_to_view())).with_extras(camera_extras),
    Entry::new("CA-2.inverse", PLACED, |v| give(camera(v)?.view_to_world()))
        .with_extras(camera_extras),
    Entry::new("CA-3.u", "l r x n_x", |v| {
        let [l, r, x, n_x] = v.numbers()?;
        give(place_on_window([l, r, -1.0, 1.0], [n_x, 1.0], [x, 0.0])?.x())
    }),
    Entry::new("CA-3.v", "b t y n_y", |v| {
        let [b, t, y, n_y] = v.numbers()?;
        give(place_on_window([-1.0, 1.0, b, t], [1.0, n_y], [0.0, y])?.y())
    }),
    Entry::new("CA-3.direction", "u_s v_s d \\mathbf{g} \\mathbf{t}", |v| {
        let [u, along_v, d] = v.these("u_s v_s d")?;
        give(basis(v)?.to_world(Vector::new(u, along_v, -d)))
    })
    .with_extras(basis_extras),
    Entry::new("CA-3.origin", "u_s v_s \\mathbf{e} \\mathbf{g} \\mathbf{t}", |v| {
        let [u, along_v] = v.these("u_s v_s")?;
        give(camera(v)?.view_to_world().transform_point(Point::new(u, along_v, 0.0)))
    })
    .with_extras(camera_extras),
    Entry::new("orbit", "\\mathbf{c} \\theta \\phi d", |v| {
        let [azimuth, elevation, distance] = v.these("theta phi d")?;
        let orbit = Orbit { target: v.vector("c")?.into(), azimuth, elevation, distance };
        give(orbit.camera()?.eye())
    }),
    Entry::new("stereo.parallax", "i s D", |v| {
        let [interocular, zero_parallax, distance] = v.numbers()?;
        give(StereoRig { interocular, zero_parallax }.parallax(distance)?)
    }),
    Entry::new("stereo.window", "i s l r N", |v| {
        let [interocular, zero_parallax, left, right, distance] = v.numbers()?;
        let window = ViewWindow { left, right, bottom: -1.0, top: 1.0, distance };
        let middle = Camera::new(Point::ORIGIN, Basis::WORLD)?;
        let pair = StereoRig { interocular, zero_parallax }.off_axis_pair(middle, window)?;
        give([pair.left.window.left, pair.left.window.right])
    }),
    Entry::new("intrinsics", "f_x f_y c_x c_y s", |v| {
        let lens = intrinsics(v)?.with_skew(v.number("s")?)?;
        give(homog::Homography::from_rows(lens.to_rows()))
    }),
    Entry::new("intrinsics.focal", "\\theta n_y", |v| {
        let [theta, n_y] = v.numbers()?;
        let lens = Perspective::new(Fov::Vertical(theta), 1.0, 1.0, 2.0)?;
        give(Intrinsics::from_frustum(lens.to_frustum(), [1, pixels(n_y)?])?.focal_length()[1])
    }),
];

/// Returns the basis from **g** and **t**.
fn basis(v: &Inputs<'_>) -> Result<Basis, Box<dyn Error>> {
    Ok(Basis::from_gaze(v.vector("g")?.into(), v.vector("t")?.into())?)
}

/// Returns the camera from **e**, **g** and **t**.
pub fn camera(v: &Inputs<'_>) -> Result<Camera, Box<dyn Error>> {
    let (e, g, t) = (v.vector("e")?, v.vector("g")?, v.vector("t")?);
    Ok(Camera::look_to(e.into(), g.into(), t.into())?)
}

fn basis_extras(v: &Inputs<'_>) -> Extras {
    let basis = basis(v)?;
    let mut extras = vec![
        ("\\mathbf{u}", basis.u().into()),
        ("\\mathbf{v}", basis.v().into()),
        ("\\mathbf{w}", basis.w().into()),
    ];
    let names = [["x_u", "y_u", "z_u"], ["x_v", "y_v", "z_v"], ["x_w", "y_w", "z_w"]];
    for (names, axis) in names.into_iter().zip([basis.u(), basis.v(), basis.w()]) {
        extras.extend(components(names, axis));
    }
    Ok(extras)
}

fn camera_extras(v: &Inputs<'_>) -> Extras {
    let mut extras = basis_extras(v)?;
    extras.extend(components(["x_e", "y_e", "z_e"], v.vector("e")?.into()));
    Ok(extras)
}

fn components(
    names: [&'static str; 3],
    vector: Vector<World>,
) -> impl Iterator<Item = (&'static str, crate::book_formulas::value::Value)> {
    names.into_iter().zip(<[f64; 3]>::from(vector)).map(|(name, number)| (name, number.into()))
}

/// Returns the position of a pixel on the window: mapped back through the viewport and the box of
/// the window.
fn place_on_window(
    [l, r, b, t]: [f64; 4],
    [n_x, n_y]: [f64; 2],
    [x, y]: [f64; 2],
) -> Result<Point<homog::View>, Box<dyn Error>> {
    let viewport = Viewport::chapter(pixels(n_x)?, pixels(n_y)?)?;
    let ndc = viewport.screen_to_ndc().transform_point(Point::new(x, y, 0.0));
    let box_to_view = chapter::m_orth_inverse(l, r, b, t, -1.0, -2.0)?;
    Ok(box_to_view.transform_point(Point::new(ndc.x(), ndc.y(), ndc.z())))
}

/// Returns the intrinsics; the size of the picture does not matter here.
fn intrinsics(v: &Inputs<'_>) -> Result<Intrinsics, Box<dyn Error>> {
    let [fx, fy, cx, cy] = v.these("f_x f_y c_x c_y")?;
    Ok(Intrinsics::new([fx, fy], [cx, cy], [640, 480])?)
}
