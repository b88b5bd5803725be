//! Matrices of the interfaces and of the lesson (GL-1 to GL-3, D3D-1 to D3D-6, RV-1, IF-1 to IF-3,
//! LW-1 to LW-3, IV-1).

use super::inputs::{Answer, Inputs, give};
use super::normalization::{divided, point};
use super::{Entry, Extras};
use homog::{Clip, Point, Projective, View, World};
use projection::{
    ApexMovedFrustum, ApexMovedSteps, Convention, Fov, Frustum, Perspective, ProjectionError, api,
};
use std::error::Error;

const VOLUME: &str = "l r b t N F";
const VOLUME_AND_POINT: &str = "l r b t N F x y z";
const LENS: &str = "\\theta a N F";
const ENDLESS: &str = "\\theta a N";

pub const ENTRIES: &[Entry] = &[
    Entry::new("GL-1", VOLUME, |v| give(window(v, api::frustum_gl)?)),
    Entry::new("GL-1.inverse", VOLUME, |v| give(frustum(v)?.clip_to_view(Convention::OPENGL))),
    Entry::new("GL-1.clip", VOLUME_AND_POINT, |v| {
        give(window(v, api::frustum_gl)?.transform_point(point(v)?))
    }),
    Entry::new("GL-1.point", VOLUME_AND_POINT, |v| {
        divided(window(v, api::frustum_gl)?.transform_point(point(v)?), None)
    }),
    Entry::new("GL-1.x", "l r N x z", |v| {
        let [l, r, near, x, z] = v.numbers()?;
        let map = api::frustum_gl(l, r, -1.0, 1.0, near, 2.0 * near)?;
        divided(map.transform_point(Point::new(x, 0.0, z)), Some(0))
    }),
    Entry::new("GL-1.y", "b t N y z", |v| {
        let [b, t, near, y, z] = v.numbers()?;
        let map = api::frustum_gl(-1.0, 1.0, b, t, near, 2.0 * near)?;
        divided(map.transform_point(Point::new(0.0, y, z)), Some(1))
    }),
    Entry::new("GL-1.A", "N F", |v| entry_of(gl_planes(v)?, 2)),
    Entry::new("GL-1.B", "N F", |v| entry_of(gl_planes(v)?, 3)),
    Entry::new("GL-2", LENS, |v| give(lens(v, api::perspective_gl)?)).with_extras(cotangent),
    Entry::new("LW-2", LENS, |v| give(lens(v, api::perspective_gl)?)).with_extras(cotangent),
    Entry::new("GL-2.x", "\\theta a", |v| {
        let [theta, aspect] = v.numbers()?;
        give(api::perspective_gl(theta, aspect, 1.0, 2.0)?.rows()[0][0])
    })
    .with_extras(cotangent),
    Entry::new("GL-2.y", "\\theta", |v| {
        give(api::perspective_gl(v.number("theta")?, 1.0, 1.0, 2.0)?.rows()[1][1])
    }),
    Entry::new("GL-2.top", "\\theta N", |v| {
        let [theta, near] = v.numbers()?;
        give(by_angle(theta, 1.0, near)?.window().top())
    }),
    Entry::new("GL-2.right", "\\theta a N", |v| {
        let [theta, aspect, near] = v.numbers()?;
        give(by_angle(theta, aspect, near)?.window().right())
    }),
    Entry::new("GL-3", VOLUME, |v| give(window(v, api::ortho_gl)?)),
    Entry::new("GL-3.inverse", VOLUME, |v| {
        let [l, r, b, t, near, far] = v.numbers()?;
        let volume = projection::Orthographic::new(l, r, b, t, near, far)?;
        give(volume.clip_to_view(Convention::OPENGL))
    }),
    Entry::new("LW-1", VOLUME, |v| give(moved(v)?.view_to_clip(Convention::OPENGL))),
    Entry::new("LW-1.apex", "l r b t", |v| {
        let [l, r, b, t] = v.numbers()?;
        give(ApexMovedFrustum::new(l, r, b, t, 1.0, 2.0)?.apex())
    }),
    Entry::new("LW-1.move", "l r b t", |v| {
        let [l, r, b, t] = v.numbers()?;
        give(steps([l, r, b, t, 1.0, 2.0])?.move_apex)
    }),
    Entry::new("LW-1.map_depth", "N F", |v| {
        let [near, far] = v.numbers()?;
        give(steps([-1.0, 1.0, -1.0, 1.0, near, far])?.map_depth)
    }),
    Entry::new("LW-1.project", "N", |v| {
        let near = v.number("N")?;
        give(steps([-1.0, 1.0, -1.0, 1.0, near, 2.0 * near])?.project)
    }),
    Entry::new("LW-1.scale", "l r b t", |v| {
        let [l, r, b, t] = v.numbers()?;
        give(steps([l, r, b, t, 1.0, 2.0])?.scale_window)
    }),
    Entry::new("LW-1.clip", VOLUME_AND_POINT, |v| {
        give(moved(v)?.view_to_clip(Convention::OPENGL).transform_point(point(v)?))
    }),
    Entry::new("LW-1.point", VOLUME_AND_POINT, |v| {
        divided(moved(v)?.view_to_clip(Convention::OPENGL).transform_point(point(v)?), None)
    }),
    Entry::new("D3D-1", LENS, |v| give(lens(v, api::perspective_lh_zo)?)).with_extras(cotangent),
    Entry::new("D3D-2", LENS, |v| give(lens(v, api::perspective_rh_zo)?)).with_extras(cotangent),
    Entry::new("D3D-3", VOLUME, |v| give(window(v, api::frustum_lh_zo)?)),
    Entry::new("D3D-4", VOLUME, |v| give(window(v, api::frustum_rh_zo)?)),
    Entry::new("D3D-5", VOLUME, |v| give(window(v, api::ortho_lh_zo)?)),
    Entry::new("D3D-6", VOLUME, |v| give(window(v, api::ortho_rh_zo)?)),
    Entry::new("RV-1", LENS, |v| give(lens(v, api::perspective_rh_zo_rev)?)).with_extras(cotangent),
    Entry::new("D3D-1.A", "N F", |v| entry_of(planes(v, api::perspective_lh_zo)?, 2)),
    Entry::new("D3D-1.B", "N F", |v| entry_of(planes(v, api::perspective_lh_zo)?, 3)),
    Entry::new("D3D-2.A", "N F", |v| entry_of(planes(v, api::perspective_rh_zo)?, 2)),
    Entry::new("D3D-2.B", "N F", |v| entry_of(planes(v, api::perspective_rh_zo)?, 3)),
    Entry::new("RV-1.A", "N F", |v| entry_of(planes(v, api::perspective_rh_zo_rev)?, 2)),
    Entry::new("RV-1.B", "N F", |v| entry_of(planes(v, api::perspective_rh_zo_rev)?, 3)),
    Entry::new("D3D-3.A", "N F", |v| entry_of(unit_window(v, api::frustum_lh_zo)?, 2)),
    Entry::new("D3D-3.B", "N F", |v| entry_of(unit_window(v, api::frustum_lh_zo)?, 3)),
    Entry::new("D3D-4.A", "N F", |v| entry_of(unit_window(v, api::frustum_rh_zo)?, 2)),
    Entry::new("D3D-4.B", "N F", |v| entry_of(unit_window(v, api::frustum_rh_zo)?, 3)),
    Entry::new("D3D-5.A", "N F", |v| entry_of(unit_window(v, api::ortho_lh_zo)?, 2)),
    Entry::new("D3D-5.B", "N F", |v| entry_of(unit_window(v, api::ortho_lh_zo)?, 3)),
    Entry::new("D3D-6.A", "N F", |v| entry_of(unit_window(v, api::ortho_rh_zo)?, 2)),
    Entry::new("D3D-6.B", "N F", |v| entry_of(unit_window(v, api::ortho_rh_zo)?, 3)),
    Entry::new("IF-1", ENDLESS, |v| give(endless(v, api::perspective_gl_inf)?))
        .with_extras(cotangent),
    Entry::new("IF-2", ENDLESS, |v| give(endless(v, api::perspective_rh_zo_inf)?))
        .with_extras(cotangent),
    Entry::new("IF-3", ENDLESS, |v| give(endless(v, api::perspective_rh_zo_rev_inf)?))
        .with_extras(cotangent),
    Entry::new("zero_one", "", |_| {
        give(Convention::OPENGL.clip_to_clip(Convention::DIRECT3D.right_handed()))
    }),
    Entry::new("reverse", "", |_| {
        give(Convention::DIRECT3D.clip_to_clip(Convention::DIRECT3D.reversed()))
    }),
    Entry::new("convert.chapter_gl", "", |_| {
        give(Convention::CHAPTER.clip_to_clip(Convention::OPENGL))
    }),
    Entry::new("IV-1", "A B X Y C E s", |v| {
        let [a, b, x, y, c, e, s] = v.numbers()?;
        let rows = [[a, 0.0, x, 0.0], [0.0, b, y, 0.0], [0.0, 0.0, c, e], [0.0, 0.0, s, 0.0]];
        give(Projective::<World, World>::from_rows(rows).inverse().ok_or("singular")?)
    }),
    Entry::new("IV-1.frustum", VOLUME, |v| give(frustum(v)?.clip_to_view(Convention::OPENGL))),
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

/// For the third row the angle does not matter.
fn planes(
    v: &Inputs<'_>,
    matrix: fn(f64, f64, f64, f64) -> Result<Matrix, ProjectionError>,
) -> Result<Matrix, Box<dyn Error>> {
    let [near, far] = v.these("N F")?;
    Ok(matrix(1.0, 1.0, near, far)?)
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

/// An entry of the third row.
fn entry_of(matrix: Matrix, column: usize) -> Answer {
    give(matrix.rows()[2][column])
}

fn by_angle(theta: f64, aspect: f64, near: f64) -> Result<Frustum, ProjectionError> {
    Ok(Perspective::new(Fov::Vertical(theta), aspect, near, 2.0 * near)?.to_frustum())
}

/// c = cot(θ/2), one divided by the slope of the upper side.
fn cotangent(v: &Inputs<'_>) -> Extras {
    let slopes = Fov::Vertical(v.number("theta")?).half_slopes(1.0)?;
    Ok(vec![("c", (1.0 / slopes.y).into())])
}

fn frustum(v: &Inputs<'_>) -> Result<Frustum, Box<dyn Error>> {
    let [l, r, b, t, near, far] = v.these(VOLUME)?;
    Ok(Frustum::new(l, r, b, t, near, far)?)
}

fn moved(v: &Inputs<'_>) -> Result<ApexMovedFrustum, Box<dyn Error>> {
    let [l, r, b, t, near, far] = v.these(VOLUME)?;
    Ok(ApexMovedFrustum::new(l, r, b, t, near, far)?)
}

/// The steps of LW-1; a step depends on some of the six numbers only.
fn steps([l, r, b, t, near, far]: [f64; 6]) -> Result<ApexMovedSteps, ProjectionError> {
    Ok(ApexMovedFrustum::new(l, r, b, t, near, far)?.steps(Convention::OPENGL))
}
