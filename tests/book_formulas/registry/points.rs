//! Points, maps and linear remapping (HO-1 to HO-5, LI-1, WI-2, WI-3).

use super::Entry;
use super::inputs::{Answer, Inputs, give};
use glam::DVec3;
use homog::{
    Affine, HPoint, HPoint1, HPoint2, Homography, Ndc, Normal, Plane, Point, Projective, Vector,
    View, World, remap_interval,
};

const MAP: &str = "a_1 b_1 c_1 d_1 a_2 b_2 c_2 d_2 a_3 b_3 c_3 d_3 e f g h x y z";
const BOX_2: &str = "x_l x_h y_l y_h x_l' x_h' y_l' y_h'";
const BOX_3: &str = "x_l x_h y_l y_h z_l z_h x_l' x_h' y_l' y_h' z_l' z_h'";

pub const ENTRIES: &[Entry] = &[
    Entry::new("HO-1", "x y z w", divide),
    Entry::new("HO-1.divide", "x y z w", divide),
    Entry::new("HO-1.point", "x y z", |v| {
        give(HPoint::from(Point::<World>::from(v.numbers::<3>()?)))
    }),
    Entry::new("HO-1.direction", "x y z", |v| {
        give(HPoint::from(Vector::<World>::from(v.numbers::<3>()?)))
    }),
    Entry::new("HO-1.one", "x h", |v| {
        let [x, h] = v.numbers()?;
        give(HPoint1::new(x, h).divide().ok_or("h = 0")?)
    }),
    Entry::new("HO-1.two", "x y h", |v| {
        let [x, y, h] = v.numbers()?;
        give(HPoint2::new(x, y, h).divide().ok_or("h = 0")?)
    }),
    Entry::new("HO-2", "x y z w \\alpha", |v| {
        let [x, y, z, w, alpha] = v.numbers()?;
        let (one, other) =
            (hpoint([x, y, z, w]), HPoint::from_raw(hpoint([x, y, z, w]).raw() * alpha));
        if one.equivalent(other, 1e-12) != Some(true) {
            return Err("the crates hold them for different places".into());
        }
        give(one.divide().ok_or("w = 0")?)
    }),
    Entry::new("HO-2.minors", "\\mathbf{a} \\mathbf{b}", |v| {
        let point = |letter| v.vector(letter).map(|p| HPoint2::from_raw(DVec3::from(p)));
        give(point("a")?.join(point("b")?).ok_or("both are one place")?.raw().to_array())
    }),
    Entry::new("HO-3", MAP, |v| give(map_and_point(v)?.divide().ok_or("w = 0")?)),
    Entry::new("HO-3.clip", MAP, |v| give(map_and_point(v)?)),
    Entry::new("HO-3.x", "a_1 b_1 c_1 d_1 e f g h x y z", |v| {
        let [a, b, c, d, e, f, g, h, x, y, z] = v.numbers()?;
        let rows = [[a, b, c, d], [0.0; 4], [0.0; 4], [e, f, g, h]];
        let image =
            Projective::<World, World>::from_rows(rows).transform_point(Point::new(x, y, z));
        give(image.divide().ok_or("w = 0")?.x())
    }),
    Entry::new("HO-3.image", "M \\mathbf{p}", |v| apply(v, false)),
    Entry::new("HO-3.divided", "M \\mathbf{p}", |v| apply(v, true)),
    Entry::new("HO-3.product", "A B", |v| give(projective(v, "B")?.then(projective(v, "A")?))),
    Entry::new("HO-4", "t_x t_y t_z", |v| {
        give(Affine::<World, World>::translation(Vector::from(v.numbers::<3>()?)))
    }),
    Entry::new("HO-4.image", "t_x t_y t_z x y z w", |v| {
        let by = Vector::from(v.these::<3>("t_x t_y t_z")?);
        let map = Projective::from(Affine::<World, World>::translation(by));
        give(map.transform_hpoint(hpoint(v.these("x y z w")?)))
    }),
    Entry::new("HO-4.scale", "s_x s_y s_z", |v| {
        let [x, y, z] = v.numbers()?;
        give(Affine::<World, World>::scale(x, y, z))
    }),
    Entry::new("HO-4.rotation_x", "\\theta", |v| {
        give(Affine::<World, World>::rotation_x(v.number("theta")?))
    }),
    Entry::new("HO-4.rotation_y", "\\theta", |v| {
        give(Affine::<World, World>::rotation_y(v.number("theta")?))
    }),
    Entry::new("HO-4.rotation_z", "\\theta", |v| {
        give(Affine::<World, World>::rotation_z(v.number("theta")?))
    }),
    Entry::new("HO-5", "M \\mathbf{p} h", |v| {
        let scaled = hpoint(v.matrix("\\mathbf{p}")?.to_column()?).raw() * v.number("h")?;
        give(projective(v, "M")?.transform_hpoint(HPoint::from_raw(scaled)))
    }),
    Entry::new("LI-1", "x a b c d", |v| {
        let [x, a, b, c, d] = v.numbers()?;
        give(remap_interval(x, [a, b], [c, d])?)
    }),
    Entry::new("WI-2", BOX_2, |v| {
        let [xl, xh, yl, yh, xl2, xh2, yl2, yh2] = v.numbers()?;
        give(Homography::windowing([[xl, yl], [xh, yh]], [[xl2, yl2], [xh2, yh2]])?)
    }),
    Entry::new("WI-3", BOX_3, |v| {
        let [xl, xh, yl, yh, zl, zh, xl2, xh2, yl2, yh2, zl2, zh2] = v.numbers()?;
        let from = [Point::<View>::new(xl, yl, zl), Point::new(xh, yh, zh)];
        let to = [Point::<Ndc>::new(xl2, yl2, zl2), Point::new(xh2, yh2, zh2)];
        give(Affine::windowing(from, to)?)
    }),
    Entry::new("WI-2.scale", "l h L H", |v| give(window_row(v.numbers()?)?[0])),
    Entry::new("WI-2.offset", "l h L H", |v| give(window_row(v.numbers()?)?[2])),
    Entry::new("WI-2.point", "x l h L H", |v| {
        let [x, l, h, to_l, to_h] = v.numbers()?;
        give(remap_interval(x, [l, h], [to_l, to_h])?)
    }),
    Entry::new("plane", "\\mathbf{n} \\mathbf{p} \\mathbf{q}", |v| {
        let [a, b, c] = v.vector("n")?;
        let plane = Plane::<World>::through(v.vector("p")?.into(), Normal::new(a, b, c));
        give(plane.evaluate(Point::from(v.vector("q")?)))
    }),
    // The crates leave out the division by the determinant: the length of a normal is free.
    Entry::new("normal", "M \\mathbf{n}", |v| {
        let linear = Homography::from_rows(v.matrix("M")?.to_square()?).raw();
        let map = Affine::<World, World>::from_raw(glam::DMat4::from_mat3(linear));
        let map = map.ok_or("M is not affine")?;
        let [a, b, c] = v.vector("n")?;
        give((map.transform_normal(Normal::new(a, b, c)).raw() / map.determinant()).to_array())
    }),
    Entry::new("determinant", "M", |v| match v.matrix("M")?.to_square::<3>() {
        Ok(rows) => give(Homography::from_rows(rows).determinant()),
        Err(_) => {
            let map = Affine::<World, World>::from_rows(v.matrix("M")?.to_square()?);
            give(map.ok_or("M is not affine")?.determinant())
        }
    }),
    Entry::new("inverse", "M", |v| match v.matrix("M")?.to_square::<3>() {
        Ok(rows) => give(Homography::from_rows(rows).inverse().ok_or("M is singular")?),
        Err(_) => give(projective(v, "M")?.inverse().ok_or("M is singular")?),
    }),
];

/// The map of one space to itself with the rows that a name has.
pub fn projective(v: &Inputs<'_>, name: &str) -> Result<Projective<World, World>, String> {
    Ok(Projective::from_rows(v.matrix(name)?.to_square()?))
}

fn hpoint([x, y, z, w]: [f64; 4]) -> HPoint<World> {
    HPoint::new(x, y, z, w)
}

fn divide(v: &Inputs<'_>) -> Answer {
    give(hpoint(v.numbers()?).divide().ok_or("w = 0")?)
}

fn map_and_point(v: &Inputs<'_>) -> Result<HPoint<World>, Box<dyn std::error::Error>> {
    let map = Projective::<World, World>::from_rows([
        v.these("a_1 b_1 c_1 d_1")?,
        v.these("a_2 b_2 c_2 d_2")?,
        v.these("a_3 b_3 c_3 d_3")?,
        v.these("e f g h")?,
    ]);
    Ok(map.transform_point(Point::from(v.these::<3>("x y z")?)))
}

/// A matrix times a homogeneous point of the plane or of space.
fn apply(v: &Inputs<'_>, divided: bool) -> Answer {
    let p = v.matrix("\\mathbf{p}")?;
    if let Ok(rows) = v.matrix("M")?.to_square::<3>() {
        let point = HPoint2::from_raw(DVec3::from(p.to_column::<3>()?));
        let image = Homography::from_rows(rows).transform_point(point);
        return if divided {
            give(image.divide().ok_or("h = 0")?)
        } else {
            give(image.raw().to_array())
        };
    }
    let image = projective(v, "M")?.transform_hpoint(hpoint(p.to_column()?));
    if divided { give(image.divide().ok_or("w = 0")?) } else { give(image) }
}

/// The first row of the windowing of one axis: scale, 0, offset.
fn window_row([l, h, to_l, to_h]: [f64; 4]) -> Result<[f64; 3], homog::RemapError> {
    let map = Homography::windowing([[l, 0.0], [h, 1.0]], [[to_l, 0.0], [to_h, 1.0]])?;
    Ok(map.rows()[0])
}
