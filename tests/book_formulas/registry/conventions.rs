//! Registry entries for matrices of graphics APIs and of the WebGL lessons (GL-1 to GL-3, D3D-1 to
//! D3D-6, RV-1, IF-1 to IF-3, LW-1 to LW-3, IV-1).

use super::inputs::{Answer, Inputs, give};
use super::normalization::divided;
use super::{Entry, Extras};
use homog::{Clip, Point, Projective, View, World};
use projection::{ApexMovedFrustum, Convention, Fov, ProjectionError, api};
use std::error::Error;

const VOLUME: &str = "l r b t N F";
const LENS: &str = "\\theta a N F";
const ENDLESS: &str = "\\theta a N";

pub const ENTRIES: &[Entry] = &[
    Entry::new("GL-1", VOLUME, |v| give(window(v, api::frustum_gl)?)),
    Entry::new("GL-1.x", "l r N x z", |v| {
        let [l, r, near, x, z] = v.numbers()?;
        let map = api::frustum_gl(l, r, -1.0, 1.0, near, 2.0 * near)?;
        divided(map.transform_point(Point::new(x, 0.0, z)), Some(0))
    }),
    Entry::new("GL-1.A", "N F", |v| entry_of(gl_planes(v)?, 2)),
    Entry::new("GL-1.B", "N F", |v| entry_of(gl_planes(v)?, 3)),
    Entry::new("GL-2", LENS, |v| give(lens(v, api::perspective_gl)?)).with_extras(cotangent),
    Entry::new("GL-3", VOLUME, |v| give(window(v, api::ortho_gl)?)),
    Entry::new("LW-1", VOLUME, |v| give(moved(v)?.view_to_clip(Convention::OPENGL))),
    Entry::new("D3D-1", LENS, |v| give(lens(v, api::perspective_lh_zo)?)).with_extras(cotangent),
    Entry::new("D3D-2", LENS, |v| give(lens(v, api::perspective_rh_zo)?)).with_extras(cotangent),
    Entry::new("D3D-4", VOLUME, |v| give(window(v, api::frustum_rh_zo)?)),
    Entry::new("D3D-6", VOLUME, |v| give(window(v, api::ortho_rh_zo)?)),
    Entry::new("RV-1", LENS, |v| give(lens(v, api::perspective_rh_zo_rev)?)).with_extras(cotangent),
    Entry::new("IF-3", ENDLESS, |v| give(endless(v, api::perspective_rh_zo_rev_inf)?))
        .with_extras(cotangent),
    Entry::new("convert.chapter_gl", "", |_| {
        give(Convention::CHAPTER.clip_to_clip(Convention::OPENGL))
    }),
    Entry::new("IV-1", "A B X Y C E s", |v| {
        let [a, b, x, y, c, e, s] = v.numbers()?;
        let rows = [[a, 0.0, x, 0.0], [0.0, b, y, 0.0], [0.0, 0.0, c, e], [0.0, 0.0, s, 0.0]];
        give(Projective::<World, World>::from_rows(rows).inverse().ok_or("singular")?)
    }),
];

type Matrix = Projective<View, Clip>;

fn window(
    v: &Inputs<'_>,
    matrix: fn(f64, f64, f64, f64, f64, f64) -> Result<Matrix, ProjectionError>,
) -> Result<Matrix, Box<dyn Error>> {
    let [l, r, b, t, near, far] = v.these(VOLUME)?;
    Ok(matrix(l, r, b, t, near, far)?)
}

fn unit_window(
    v: &Inputs<'_>,
    matrix: fn(f64, f64, f64, f64, f64, f64) -> Result<Matrix, ProjectionError>,
) -> Result<Matrix, Box<dyn Error>> {
    let [near, far] = v.these("N F")?;
    Ok(matrix(-1.0, 1.0, -1.0, 1.0, near, far)?)
}

fn lens(
    v: &Inputs<'_>,
    matrix: fn(f64, f64, f64, f64) -> Result<Matrix, ProjectionError>,
) -> Result<Matrix, Box<dyn Error>> {
    let [theta, aspect, near, far] = v.these(LENS)?;
    Ok(matrix(theta, aspect, near, far)?)
}

fn gl_planes(v: &Inputs<'_>) -> Result<Matrix, Box<dyn Error>> {
    unit_window(v, api::frustum_gl)
}

fn endless(
    v: &Inputs<'_>,
    matrix: fn(f64, f64, f64) -> Result<Matrix, ProjectionError>,
) -> Result<Matrix, Box<dyn Error>> {
    let [theta, aspect, near] = v.these(ENDLESS)?;
    Ok(matrix(theta, aspect, near)?)
}

/// Returns an entry of the third row.
fn entry_of(matrix: Matrix, column: usize) -> Answer {
    give(matrix.rows()[2][column])
}

/// Returns c = cot(θ/2), the reciprocal of the slope of the top side.
fn cotangent(v: &Inputs<'_>) -> Extras {
    let slopes = Fov::Vertical(v.number("theta")?).half_slopes(1.0)?;
    Ok(vec![("c", (1.0 / slopes.y).into())])
}

fn moved(v: &Inputs<'_>) -> Result<ApexMovedFrustum, Box<dyn Error>> {
    let [l, r, b, t, near, far] = v.these(VOLUME)?;
    Ok(ApexMovedFrustum::new(l, r, b, t, near, far)?)
}
