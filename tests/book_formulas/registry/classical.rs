//! Registry entries for classical projections, vanishing points and shears (MV-1 to VV-2).

use super::Entry;
use super::inputs::{Answer, Inputs, give};
use super::normalization::{divided, point};
use homog::{Normal, Plane, Point, Vector, View};
use projection::{
    Axonometric, Convention, Frustum, NPoint, Oblique, PrincipalPlane, Projector, VanishingPoint,
    principal_vanishing_points, vanishing_point,
};
use std::error::Error;

const ANGLES: &str = "\\alpha \\beta";
const SLANT: &str = "L_1 \\phi";

pub const ENTRIES: &[Entry] = &[
    Entry::new("MV-1", "", |_| give(PrincipalPlane::Yoz.onto_plane::<View>())),
    Entry::new("MV-2", "", |_| give(PrincipalPlane::Zox.onto_plane::<View>())),
    Entry::new("MV-3", "", |_| give(PrincipalPlane::Xoy.onto_plane::<View>())),
    Entry::new("AX-1", ANGLES, |v| give(turned(v)?.onto_plane()))
        .with_extras(|_| Ok(vec![("T_{xoy}", PrincipalPlane::Xoy.onto_plane::<View>().into())])),
    Entry::new("AX-1.alpha", "b_x b_z", |v| {
        let [x, z] = v.numbers()?;
        give(Axonometric::by_normal(Normal::new(x, 0.0, z))?.alpha())
    }),
    Entry::new("AX-1.beta", "b_x b_y b_z", |v| {
        let [x, y, z] = v.numbers()?;
        give(Axonometric::by_normal(Normal::new(x, y, z))?.beta())
    }),
    Entry::new("AX-1.x", ANGLES, |v| give(turned(v)?.foreshortening()[0])),
    Entry::new("AX-1.y", "\\beta", |v| {
        give(Axonometric::by_angles(0.5, v.number("beta")?)?.foreshortening()[1])
    }),
    Entry::new("AX-1.z", ANGLES, |v| give(turned(v)?.foreshortening()[2])),
    Entry::new("OB-1", SLANT, |v| give(slanted(v)?.onto_plane())),
    Entry::new("OB-1.length", "\\alpha", |v| {
        give(Oblique::by_angle(v.number("alpha")?, 0.5)?.length())
    }),
    Entry::new("OB-2", "a b c z_p", |v| give(along(v.numbers()?)?.onto_plane())),
    Entry::new("OB-2.length", "a b c", |v| {
        let [a, b, c] = v.numbers()?;
        give(along([a, b, c, 0.0])?.length())
    }),
    Entry::new("ONE-1", "d", |v| give(NPoint::from_eye(v.number("d")?)?.onto_plane())),
    Entry::new("ONE-1.x", "d x z", |v| {
        let [d, x, z] = v.numbers()?;
        one_point(d, [x, 0.0, z], 0)
    }),
    // The factor u is the image of x = 1.
    Entry::new("ONE-1.u", "d z", |v| {
        let [d, z] = v.numbers()?;
        one_point(d, [1.0, 0.0, z], 0)
    }),
    Entry::new("TWO-1", "q r", |v| {
        let [q, r] = v.numbers()?;
        give(NPoint::new(0.0, q, r)?.depth_preserving())
    }),
    Entry::new("THREE-1", "p q r", |v| give(n_point(v)?.depth_preserving())),
    Entry::new("THREE-1.w", "p q r x y z", |v| {
        give(n_point(v)?.depth_preserving().transform_point(point(v)?).w())
    }),
    Entry::new("THREE-1.vx", "p", |v| principal_point(NPoint::new(v.number("p")?, 0.0, 0.0)?, 0)),
    Entry::new("VN-1", "N \\mathbf{d}", |v| {
        let projector = picture_plane(v)?.onto_plane();
        let found = vanishing_point(projector, v.vector("d")?.into())?;
        let place = found.point().ok_or("the direction is parallel to the plane")?;
        give([place.x(), place.y()])
    }),
    Entry::new("VN-1.point", "N x y z", |v| {
        divided(picture_plane(v)?.onto_plane().transform_point(point(v)?), None)
    }),
    Entry::new("VN-1.line", "N \\mathbf{p} \\mathbf{d} s", |v| {
        let along = Vector::from(v.vector("d")?) * v.number("s")?;
        let image =
            picture_plane(v)?.onto_plane().transform_point(Point::from(v.vector("p")?) + along);
        let place = image.divide().ok_or("w = 0")?;
        give([place.x(), place.y()])
    }),
    Entry::new("VV-1", "a b c z_0", |v| give(along(v.numbers()?)?.depth_preserving())),
    Entry::new("VV-2", "l r b t N", |v| give(frustum(v)?.factors(Convention::OPENGL).shear)),
    Entry::new("VV-2.scale", "l r b t N", |v| give(frustum(v)?.factors(Convention::OPENGL).scale)),
    Entry::new("VV-2.depth", "N F", |v| {
        let [near, far] = v.numbers()?;
        let frustum = Frustum::new(-1.0, 1.0, -1.0, 1.0, near, far)?;
        give(frustum.factors(Convention::OPENGL).depth)
    }),
];

fn turned(v: &Inputs<'_>) -> Result<Axonometric, Box<dyn Error>> {
    let [alpha, beta] = v.these(ANGLES)?;
    Ok(Axonometric::by_angles(alpha, beta)?)
}

fn slanted(v: &Inputs<'_>) -> Result<Oblique, Box<dyn Error>> {
    let [length, phi] = v.these(SLANT)?;
    Ok(Oblique::new(length, phi)?)
}

fn along([a, b, c, plane_z]: [f64; 4]) -> Result<Oblique, projection::ProjectionError> {
    Oblique::by_direction(Vector::new(a, b, c), plane_z)
}

fn one_point(d: f64, at: [f64; 3], coordinate: usize) -> Answer {
    divided(NPoint::from_eye(d)?.onto_plane().transform_point(at.into()), Some(coordinate))
}

fn n_point(v: &Inputs<'_>) -> Result<NPoint, Box<dyn Error>> {
    let [p, q, r] = v.these("p q r")?;
    Ok(NPoint::new(p, q, r)?)
}

fn principal_point(map: NPoint, axis: usize) -> Answer {
    let found = principal_vanishing_points(map.depth_preserving())?;
    match found.axes[axis] {
        VanishingPoint::At { point, .. } => give(point),
        other => Err(format!("the axis vanishes in {other:?}").into()),
    }
}

/// Returns the projector from the origin onto the plane z = −N.
fn picture_plane(v: &Inputs<'_>) -> Result<Projector<View>, Box<dyn Error>> {
    let place = Point::new(0.0, 0.0, -v.number("N")?);
    Ok(Projector::from_eye(Point::ORIGIN, Plane::through(place, Normal::new(0.0, 0.0, 1.0)))?)
}

/// Returns the frustum; the far plane does not matter.
fn frustum(v: &Inputs<'_>) -> Result<Frustum, Box<dyn Error>> {
    let [l, r, b, t, near] = v.these("l r b t N")?;
    Ok(Frustum::new(l, r, b, t, near, 2.0 * near)?)
}
