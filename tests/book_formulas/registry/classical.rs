//! Classical projections, vanishing points and shears (MV-1 to VV-2).

use super::Entry;
use super::inputs::{Answer, Inputs, give};
use super::normalization::{divided, point};
use super::points::projective;
use homog::{Normal, Plane, Point, Projective, Vector, View};
use projection::{
    Axonometric, Convention, Frustum, NPoint, Oblique, Orthographic, PrincipalPlane, Projector,
    VanishingPoint, principal_vanishing_points, vanishing_point,
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
    Entry::new("AX-1.about", "\\alpha \\beta o_x o_y o_z", |v| {
        let origin = Point::from(v.these::<3>("o_x o_y o_z")?);
        give(turned(v)?.about(origin)?.onto_plane())
    })
    .with_extras(|_| Ok(vec![("T_{xoy}", PrincipalPlane::Xoy.onto_plane::<View>().into())])),
    Entry::new("AX-1.shear", ANGLES, |v| give(turned(v)?.depth_preserving())),
    Entry::new("AX-1.rx", "\\beta", |v| {
        give(Axonometric::by_angles(0.0, v.number("beta")?)?.depth_preserving())
    }),
    Entry::new("AX-1.ry", "\\alpha", |v| {
        give(Axonometric::by_angles(v.number("alpha")?, 0.0)?.depth_preserving())
    }),
    Entry::new("AX-1.point", "\\alpha \\beta x y z", |v| {
        let image = turned(v)?.onto_plane().transform_point(point(v)?);
        give([image.x(), image.y()])
    }),
    Entry::new("AX-1.linear", ANGLES, |v| {
        let rows = turned(v)?.onto_plane().rows();
        Ok(crate::value::Value::matrix([rows[0], rows[1]].map(|[x, y, z, _]| [x, y, z])))
    }),
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
    Entry::new("AX-1.squares", ANGLES, |v| {
        give(turned(v)?.foreshortening().iter().map(|factor| factor * factor).sum::<f64>())
    }),
    Entry::new("AX-1.isometric_beta", "", |_| give(Axonometric::isometric().beta())),
    Entry::new("AX-1.isometric", "", |_| give(Axonometric::isometric().foreshortening()[0])),
    Entry::new("OB-1", SLANT, |v| give(slanted(v)?.onto_plane())),
    Entry::new("OB-1.shear", SLANT, |v| give(slanted(v)?.depth_preserving())),
    Entry::new("OB-1.point", "L_1 \\phi x y z", |v| {
        give(slanted(v)?.onto_plane().transform_point(point(v)?))
    }),
    Entry::new("OB-1.x", "L_1 \\phi x z", |v| {
        let [x, z] = v.these("x z")?;
        give(slanted(v)?.onto_plane().transform_point(Point::new(x, 0.0, z)).x())
    }),
    Entry::new("OB-1.y", "L_1 \\phi y z", |v| {
        let [y, z] = v.these("y z")?;
        give(slanted(v)?.onto_plane().transform_point(Point::new(0.0, y, z)).y())
    }),
    Entry::new("OB-1.length", "\\alpha", |v| {
        give(Oblique::by_angle(v.number("alpha")?, 0.5)?.length())
    }),
    Entry::new("OB-1.direction", SLANT, |v| give(slanted(v)?.direction())),
    Entry::new("OB-2", "a b c z_p", |v| give(along(v.numbers()?)?.onto_plane())),
    Entry::new("OB-2.zero", "a b c", |v| {
        let [a, b, c] = v.numbers()?;
        give(along([a, b, c, 0.0])?.onto_plane())
    }),
    Entry::new("OB-2.point", "a b c z_p x y z", |v| {
        give(along(v.these("a b c z_p")?)?.onto_plane().transform_point(point(v)?))
    }),
    Entry::new("OB-2.x", "a c z_p x z", |v| {
        let [a, c, z_p, x, z] = v.numbers()?;
        give(along([a, 0.0, c, z_p])?.onto_plane().transform_point(Point::new(x, 0.0, z)).x())
    }),
    Entry::new("OB-2.y", "b c z_p y z", |v| {
        let [b, c, z_p, y, z] = v.numbers()?;
        give(along([0.0, b, c, z_p])?.onto_plane().transform_point(Point::new(0.0, y, z)).y())
    }),
    Entry::new("OB-2.length", "a b c", |v| {
        let [a, b, c] = v.numbers()?;
        give(along([a, b, c, 0.0])?.length())
    }),
    Entry::new("OB-2.phi", "a b c", |v| {
        let [a, b, c] = v.numbers()?;
        give(along([a, b, c, 0.0])?.phi())
    }),
    Entry::new("ONE-1", "d", |v| give(NPoint::from_eye(v.number("d")?)?.onto_plane())),
    Entry::new("ONE-1.keep", "d", |v| give(NPoint::from_eye(v.number("d")?)?.depth_preserving())),
    Entry::new("ONE-1.point", "d x y z", |v| {
        divided(NPoint::from_eye(v.number("d")?)?.onto_plane().transform_point(point(v)?), None)
    }),
    Entry::new("ONE-1.x", "d x z", |v| {
        let [d, x, z] = v.numbers()?;
        one_point(d, [x, 0.0, z], 0)
    }),
    Entry::new("ONE-1.y", "d y z", |v| {
        let [d, y, z] = v.numbers()?;
        one_point(d, [0.0, y, z], 1)
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
    Entry::new("TWO-1.plane", "q r", |v| {
        let [q, r] = v.numbers()?;
        give(NPoint::new(0.0, q, r)?.onto_plane())
    }),
    Entry::new("TWO-1.w", "q r y z", |v| {
        let [q, r, y, z] = v.numbers()?;
        give(NPoint::new(0.0, q, r)?.depth_preserving().transform_point(Point::new(0.0, y, z)).w())
    }),
    Entry::new("THREE-1", "p q r", |v| give(n_point(v)?.depth_preserving())),
    Entry::new("THREE-1.plane", "p q r", |v| give(n_point(v)?.onto_plane())),
    Entry::new("THREE-1.w", "p q r x y z", |v| {
        give(n_point(v)?.depth_preserving().transform_point(point(v)?).w())
    }),
    Entry::new("THREE-1.point", "p q r x y z", |v| {
        divided(n_point(v)?.depth_preserving().transform_point(point(v)?), None)
    }),
    Entry::new("THREE-1.vx", "p", |v| principal_point(NPoint::new(v.number("p")?, 0.0, 0.0)?, 0)),
    Entry::new("THREE-1.vy", "q", |v| principal_point(NPoint::new(0.0, v.number("q")?, 0.0)?, 1)),
    Entry::new("THREE-1.vz", "r", |v| principal_point(NPoint::new(0.0, 0.0, v.number("r")?)?, 2)),
    Entry::new("VN-1", "N \\mathbf{d}", |v| {
        let projector = picture_plane(v)?.onto_plane();
        let found = vanishing_point(projector, v.vector("d")?.into())?;
        let place = found.point().ok_or("the direction is parallel to the plane")?;
        give([place.x(), place.y()])
    }),
    Entry::new("VN-1.point", "N x y z", |v| {
        divided(picture_plane(v)?.onto_plane().transform_point(point(v)?), None)
    }),
    // The crates choose another factor; in the book the entry of x is N.
    Entry::new("VN-1.matrix", "N", |v| {
        let rows = picture_plane(v)?.onto_plane().rows();
        let factor = v.number("N")? / rows[0][0];
        give(Projective::<View, View>::from_rows(rows.map(|row| row.map(|entry| entry * factor))))
    }),
    Entry::new("VN-1.image", "M \\mathbf{d}", |v| {
        give(projective(v, "M")?.transform_direction(v.vector("d")?.into()))
    }),
    Entry::new("VN-1.depth", "N F", |v| {
        let [near, far] = v.numbers()?;
        let lens = Frustum::new(-1.0, 1.0, -1.0, 1.0, near, far)?.view_to_clip(Convention::OPENGL);
        give(vanishing_point(lens, -Vector::Z)?.point().ok_or("at infinity")?.z())
    }),
    Entry::new("VN-1.line", "N \\mathbf{p} \\mathbf{d} s", |v| {
        let along = Vector::from(v.vector("d")?) * v.number("s")?;
        let image =
            picture_plane(v)?.onto_plane().transform_point(Point::from(v.vector("p")?) + along);
        let place = image.divide().ok_or("w = 0")?;
        give([place.x(), place.y()])
    }),
    Entry::new("VV-1", "a b c z_0", |v| give(along(v.numbers()?)?.depth_preserving())),
    Entry::new("VV-1.point", "a b c z_0 x y z", |v| {
        give(along(v.these("a b c z_0")?)?.depth_preserving().transform_point(point(v)?))
    }),
    Entry::new("VV-1.product", "\\mathbf{d} z_0 l r b t N F", |v| {
        let [l, r, b, t, near, far] = v.these("l r b t N F")?;
        let volume = Orthographic::new(l, r, b, t, near, far)?;
        let slant = Oblique::by_direction(v.vector("d")?.into(), v.number("z_0")?)?;
        give(slant.view_to_clip(volume, Convention::OPENGL))
    }),
    Entry::new("VV-2", "l r b t N", |v| give(frustum(v)?.factors(Convention::OPENGL).shear)),
    Entry::new("VV-2.shear", "l r b t N", |v| give(frustum(v)?.factors(Convention::OPENGL).shear)),
    Entry::new("VV-2.scale", "l r b t N", |v| give(frustum(v)?.factors(Convention::OPENGL).scale)),
    Entry::new("VV-2.depth", "N F", |v| {
        let [near, far] = v.numbers()?;
        let frustum = Frustum::new(-1.0, 1.0, -1.0, 1.0, near, far)?;
        give(frustum.factors(Convention::OPENGL).depth)
    }),
    Entry::new("VV-2.unit", "l r b t N F", |v| {
        let [l, r, b, t, near, far] = v.numbers()?;
        let frustum = Frustum::new(l, r, b, t, near, far)?;
        give(frustum.view_to_canonical_frustum(Convention::OPENGL).ok_or("no far plane")?)
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

/// From the origin onto the plane z = −N.
fn picture_plane(v: &Inputs<'_>) -> Result<Projector<View>, Box<dyn Error>> {
    let place = Point::new(0.0, 0.0, -v.number("N")?);
    Ok(Projector::from_eye(Point::ORIGIN, Plane::through(place, Normal::new(0.0, 0.0, 1.0)))?)
}

/// The far plane does not matter.
fn frustum(v: &Inputs<'_>) -> Result<Frustum, Box<dyn Error>> {
    let [l, r, b, t, near] = v.these("l r b t N")?;
    Ok(Frustum::new(l, r, b, t, near, 2.0 * near)?)
}
