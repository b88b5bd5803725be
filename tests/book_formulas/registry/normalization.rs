//! The box, the perspective matrix and the field of view (OR-1, PE-1 to PE-3, FOV-1, PR-1).

use super::inputs::{Answer, Inputs, give};
use super::screen::pixels;
use super::{Entry, Extras};
use homog::{Clip, HPoint, HPoint1, HPoint2, Point, Projective, Space, View};
use projection::{
    Convention, DepthCurve, Fov, Perspective, ProjectionError, SensorSize, chapter,
    opening_angle_of,
};
use viewport::Viewport;

const VOLUME: &str = "l r b t n f";
const VOLUME_AND_POINT: &str = "l r b t n f x y z";

pub const ENTRIES: &[Entry] = &[
    Entry::new("OR-1", VOLUME, |v| give(volume(v, chapter::m_orth)?)),
    Entry::new("OR-1.inverse", VOLUME, |v| give(volume(v, chapter::m_orth_inverse)?)),
    Entry::new("OR-1.screen", "n_x n_y l r b t n f", |v| {
        let [n_x, n_y] = v.these("n_x n_y")?;
        let viewport = Viewport::chapter(pixels(n_x)?, pixels(n_y)?)?;
        give(viewport.source_to_screen(volume(v, chapter::m_orth)?.into()))
    }),
    Entry::new("OR-1.x", "l r x", |v| {
        let [l, r, x] = v.numbers()?;
        give(
            chapter::m_orth(l, r, -1.0, 1.0, -1.0, -2.0)?
                .transform_point(Point::new(x, 0.0, 0.0))
                .x(),
        )
    }),
    Entry::new("OR-1.y", "b t y", |v| {
        let [b, t, y] = v.numbers()?;
        give(
            chapter::m_orth(-1.0, 1.0, b, t, -1.0, -2.0)?
                .transform_point(Point::new(0.0, y, 0.0))
                .y(),
        )
    }),
    Entry::new("OR-1.z", "n f z", |v| {
        let [n, f, z] = v.numbers()?;
        give(
            chapter::m_orth(-1.0, 1.0, -1.0, 1.0, n, f)?
                .transform_point(Point::new(0.0, 0.0, z))
                .z(),
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
    Entry::new("PE-1.clip", "n f x y z", |v| give(p(v)?.transform_point(point(v)?))),
    Entry::new("PE-1.point", "n f x y z", |v| divided(p(v)?.transform_point(point(v)?), None)),
    Entry::new("PE-1.x", "n x z", |v| {
        let [n, x, z] = v.numbers()?;
        divided(chapter::p(n, 2.0 * n)?.transform_point(Point::new(x, 0.0, z)), Some(0))
    }),
    Entry::new("PE-1.y", "n y z", |v| {
        let [n, y, z] = v.numbers()?;
        divided(chapter::p(n, 2.0 * n)?.transform_point(Point::new(0.0, y, z)), Some(1))
    }),
    Entry::new("PE-1.depth", "n f z", |v| p_depth(v, v.number("z")?)),
    // The canonical depth is OR-1 of z'; its slope by the distance is known.
    Entry::new("PE-1.slope", "n f z", |v| {
        let [n, f, z] = v.numbers()?;
        let slope =
            DepthCurve::perspective(-n, -f, Convention::CHAPTER)?.slope(-z).ok_or("z = 0")?;
        let box_scale = chapter::m_orth(-1.0, 1.0, -1.0, 1.0, n, f)?.rows()[2][2];
        give(-slope / box_scale)
    }),
    Entry::new("PE-1.middle", "n f", |v| p_depth(v, (v.number("n")? + v.number("f")?) / 2.0)),
    Entry::new("PE-1.order", "n f z_1 z_2", |v| {
        let depths = [p_depth(v, v.number("z_1")?)?, p_depth(v, v.number("z_2")?)?];
        Ok(depths[0].minus(&depths[1])?)
    }),
    Entry::new("PE-1.A", "n f", |v| give(p(v)?.rows()[2][2])),
    Entry::new("PE-1.B", "n f", |v| give(p(v)?.rows()[2][3])),
    Entry::new("PE-1.determinant", "n f", |v| give(p(v)?.raw().determinant())),
    Entry::new("PE-1.similar", "d y z", |v| {
        let [d, y, z] = v.numbers()?;
        give(HPoint1::project_point(d, HPoint2::from_xy(y, z)).divide().ok_or("z = 0")?)
    }),
    Entry::new("PE-2", VOLUME, |v| give(volume(v, chapter::m_per)?)),
    Entry::new("PE-2.inverse", VOLUME, |v| give(volume(v, chapter::m_per_inverse)?)),
    Entry::new("PE-2.clip", VOLUME_AND_POINT, |v| {
        give(volume(v, chapter::m_per)?.transform_point(point(v)?))
    }),
    Entry::new("PE-2.point", VOLUME_AND_POINT, |v| {
        divided(volume(v, chapter::m_per)?.transform_point(point(v)?), None)
    }),
    Entry::new("PE-2.x", "l r n x z", |v| {
        let [l, r, n, x, z] = v.numbers()?;
        let map = chapter::m_per(l, r, -1.0, 1.0, n, 2.0 * n)?;
        divided(map.transform_point(Point::new(x, 0.0, z)), Some(0))
    }),
    Entry::new("PE-2.y", "b t n y z", |v| {
        let [b, t, n, y, z] = v.numbers()?;
        let map = chapter::m_per(-1.0, 1.0, b, t, n, 2.0 * n)?;
        divided(map.transform_point(Point::new(0.0, y, z)), Some(1))
    }),
    Entry::new("PE-2.depth", "n f z", |v| {
        let [n, f, z] = v.numbers()?;
        divided(unit_m_per(n, f)?.transform_point(Point::new(0.0, 0.0, z)), Some(2))
    }),
    Entry::new("PE-2.A", "n f", |v| {
        let [n, f] = v.numbers()?;
        give(unit_m_per(n, f)?.rows()[2][2])
    }),
    Entry::new("PE-2.B", "n f", |v| {
        let [n, f] = v.numbers()?;
        give(unit_m_per(n, f)?.rows()[2][3])
    }),
    Entry::new("PE-3", VOLUME, |v| give(volume(v, chapter::m_per_positive)?)),
    Entry::new("PE-3.clip", VOLUME_AND_POINT, |v| {
        give(volume(v, chapter::m_per_positive)?.transform_point(point(v)?))
    }),
    Entry::new("FOV-1", "\\theta N", top_of_angle),
    Entry::new("FOV-1.top", "\\theta N", top_of_angle),
    Entry::new("FOV-1.right", "\\theta N n_x n_y", |v| {
        let [theta, near, n_x, n_y] = v.numbers()?;
        give(chapter::window_from_fov(theta, n_x, n_y, -near)?.right())
    })
    .with_extras(top_extra),
    Entry::new("FOV-1.angle", "t N", |v| {
        let [t, near] = v.numbers()?;
        give(chapter::fov_from_window(t, -near)?)
    }),
    Entry::new("FOV-1.horizontal", "r N", |v| {
        let [r, near] = v.numbers()?;
        give(opening_angle_of(-r, r, near)?)
    }),
    Entry::new("FOV-1.asymmetric", "b t N", |v| {
        let [b, t, near] = v.numbers()?;
        give(opening_angle_of(b, t, near)?)
    }),
    Entry::new("FOV-1.other", "\\theta a", |v| {
        let [theta, aspect] = v.numbers()?;
        give(Perspective::new(Fov::Vertical(theta), aspect, 1.0, 2.0)?.fov_x())
    }),
    Entry::new("FOV-1.focal", "h f", |v| {
        let [h, focal] = v.numbers()?;
        let fov = Fov::FocalLength { focal, film: SensorSize::Height(h) };
        give(Perspective::new(fov, 1.0, 1.0, 2.0)?.fov_y())
    }),
    Entry::new("PR-1", VOLUME, |v| give(volume(v, chapter::m_orth)?.determinant())),
    Entry::new("PR-1.perspective", VOLUME, |v| {
        give(volume(v, chapter::m_per)?.raw().determinant())
    }),
];

/// A matrix of the chapter for the six borders of a volume.
pub fn volume<T>(
    v: &Inputs<'_>,
    matrix: fn(f64, f64, f64, f64, f64, f64) -> Result<T, ProjectionError>,
) -> Result<T, Box<dyn std::error::Error>> {
    let [l, r, b, t, n, f] = v.these(VOLUME)?;
    Ok(matrix(l, r, b, t, n, f)?)
}

/// The point (x, y, z).
pub fn point<S: Space>(v: &Inputs<'_>) -> Result<Point<S>, Box<dyn std::error::Error>> {
    Ok(Point::from(v.these::<3>("x y z")?))
}

/// A point after the divide, or one of its coordinates.
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

/// `M_per` with a window that does not matter.
fn unit_m_per(n: f64, f: f64) -> Result<Projective<View, Clip>, ProjectionError> {
    chapter::m_per(-1.0, 1.0, -1.0, 1.0, n, f)
}

fn top_of_angle(v: &Inputs<'_>) -> Answer {
    let [theta, near] = v.these("theta N")?;
    give(chapter::window_from_fov(theta, 1.0, 1.0, -near)?.top())
}

fn top_extra(v: &Inputs<'_>) -> Extras {
    Ok(vec![("t", top_of_angle(v)?)])
}
