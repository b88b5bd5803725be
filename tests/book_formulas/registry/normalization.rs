//! Registry entries for the box, the perspective matrix and the field of view (OR-1, PE-1 to PE-3,
//! FOV-1, PR-1).

use super::inputs::{Answer, Inputs, give};
use super::{Entry, Extras};
use homog::{HPoint, HPoint1, HPoint2, Point, Projective, Space, View};
use projection::{Fov, Perspective, ProjectionError, chapter};

const VOLUME: &str = "l r b t n f";

pub const ENTRIES: &[Entry] = &[
    Entry::new("OR-1", VOLUME, |v| give(volume(v, chapter::m_orth)?)),
    Entry::new("OR-1.x", "l r x", |v| {
        let [l, r, x] = v.numbers()?;
        give(
            chapter::m_orth(l, r, -1.0, 1.0, -1.0, -2.0)?
                .transform_point(Point::new(x, 0.0, 0.0))
                .x(),
        )
    }),
    Entry::new("PE-1", "n f", |v| give(p(v)?)),
    Entry::new("PE-1.inverse", "n f", |v| {
        let [n, f] = v.numbers()?;
        give(chapter::p_inverse(n, f)?)
    }),
    Entry::new("PE-1.scaled_inverse", "n f", |v| {
        let [n, f] = v.numbers()?;
        give(chapter::p_inverse_scaled(n, f)?)
    }),
    Entry::new("PE-1.point", "n f x y z", |v| divided(p(v)?.transform_point(point(v)?), None)),
    Entry::new("PE-1.middle", "n f", |v| p_depth(v, (v.number("n")? + v.number("f")?) / 2.0)),
    Entry::new("PE-1.order", "n f z_1 z_2", |v| {
        let depths = [p_depth(v, v.number("z_1")?)?, p_depth(v, v.number("z_2")?)?];
        Ok(depths[0].minus(&depths[1])?)
    }),
    Entry::new("PE-1.similar", "d y z", |v| {
        let [d, y, z] = v.numbers()?;
        give(HPoint1::project_point(d, HPoint2::from_xy(y, z)).divide().ok_or("z = 0")?)
    }),
    Entry::new("PE-2", VOLUME, |v| give(volume(v, chapter::m_per)?)),
    Entry::new("PE-3", VOLUME, |v| give(volume(v, chapter::m_per_positive)?)),
    Entry::new("FOV-1.top", "\\theta N", top_of_angle),
    Entry::new("FOV-1.right", "\\theta N n_x n_y", |v| {
        let [theta, near, n_x, n_y] = v.numbers()?;
        give(chapter::window_from_fov(theta, n_x, n_y, -near)?.right())
    })
    .with_extras(top_extra),
    Entry::new("FOV-1.other", "\\theta a", |v| {
        let [theta, aspect] = v.numbers()?;
        give(Perspective::new(Fov::Vertical(theta), aspect, 1.0, 2.0)?.fov_x())
    }),
    Entry::new("PR-1", VOLUME, |v| give(volume(v, chapter::m_orth)?.determinant())),
];

/// Returns one of the chapter's matrices for the six bounds of a volume.
pub fn volume<T>(
    v: &Inputs<'_>,
    matrix: fn(f64, f64, f64, f64, f64, f64) -> Result<T, ProjectionError>,
) -> Result<T, Box<dyn std::error::Error>> {
    let [l, r, b, t, n, f] = v.these(VOLUME)?;
    Ok(matrix(l, r, b, t, n, f)?)
}

/// Returns the point (x, y, z).
pub fn point<S: Space>(v: &Inputs<'_>) -> Result<Point<S>, Box<dyn std::error::Error>> {
    Ok(Point::from(v.these::<3>("x y z")?))
}

/// Returns a point after the perspective division, or one of its coordinates.
pub fn divided<S: Space>(point: HPoint<S>, coordinate: Option<usize>) -> Answer {
    let place = <[f64; 3]>::from(point.divide().ok_or("w = 0")?);
    match coordinate {
        Some(coordinate) => give(place[coordinate]),
        None => give(place),
    }
}

fn p(v: &Inputs<'_>) -> Result<Projective<View, View>, Box<dyn std::error::Error>> {
    let [n, f] = v.these("n f")?;
    Ok(chapter::p(n, f)?)
}

fn p_depth(v: &Inputs<'_>, z: f64) -> Answer {
    divided(p(v)?.transform_point(Point::new(0.0, 0.0, z)), Some(2))
}

fn top_of_angle(v: &Inputs<'_>) -> Answer {
    let [theta, near] = v.these("theta N")?;
    give(chapter::window_from_fov(theta, 1.0, 1.0, -near)?.top())
}

fn top_extra(v: &Inputs<'_>) -> Extras {
    Ok(vec![("t", top_of_angle(v)?)])
}
