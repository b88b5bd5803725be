//! Registry entries for points, maps and linear remapping (HO-1 to HO-5, LI-1, WI-2, WI-3).

use super::Entry;
use super::inputs::{Answer, Inputs, give};
use homog::{
    Affine, HPoint, Homography, Ndc, Normal, Plane, Point, Projective, Vector, View, World,
    remap_interval,
};

const BOX_3: &str = "x_l x_h y_l y_h z_l z_h x_l' x_h' y_l' y_h' z_l' z_h'";

pub const ENTRIES: &[Entry] = &[
    Entry::new("HO-1", "x y z w", divide),
    Entry::new("HO-2", "x y z w \\alpha", |v| {
        let [x, y, z, w, alpha] = v.numbers()?;
        let (one, other) =
            (hpoint([x, y, z, w]), HPoint::from_raw(hpoint([x, y, z, w]).raw() * alpha));
        if one.equivalent(other, 1e-12) != Some(true) {
            return Err("the crates consider p and αp different points".into());
        }
        give(one.divide().ok_or("w = 0")?)
    }),
    Entry::new("HO-3.x", "a_1 b_1 c_1 d_1 e f g h x y z", |v| {
        let [a, b, c, d, e, f, g, h, x, y, z] = v.numbers()?;
        let rows = [[a, b, c, d], [0.0; 4], [0.0; 4], [e, f, g, h]];
        let image =
            Projective::<World, World>::from_rows(rows).transform_point(Point::new(x, y, z));
        give(image.divide().ok_or("w = 0")?.x())
    }),
    Entry::new("HO-4", "t_x t_y t_z", |v| {
        give(Affine::<World, World>::translation(Vector::from(v.numbers::<3>()?)))
    }),
    Entry::new("HO-4.image", "t_x t_y t_z x y z w", |v| {
        let by = Vector::from(v.these::<3>("t_x t_y t_z")?);
        let map = Projective::from(Affine::<World, World>::translation(by));
        give(map.transform_hpoint(hpoint(v.these("x y z w")?)))
    }),
    Entry::new("HO-5", "M \\mathbf{p} h", |v| {
        let scaled = hpoint(v.matrix("\\mathbf{p}")?.to_column()?).raw() * v.number("h")?;
        give(projective(v, "M")?.transform_hpoint(HPoint::from_raw(scaled)))
    }),
    Entry::new("LI-1", "x a b c d", |v| {
        let [x, a, b, c, d] = v.numbers()?;
        give(remap_interval(x, [a, b], [c, d])?)
    }),
    Entry::new("WI-3", BOX_3, |v| {
        let [xl, xh, yl, yh, zl, zh, xl2, xh2, yl2, yh2, zl2, zh2] = v.numbers()?;
        let from = [Point::<View>::new(xl, yl, zl), Point::new(xh, yh, zh)];
        let to = [Point::<Ndc>::new(xl2, yl2, zl2), Point::new(xh2, yh2, zh2)];
        give(Affine::windowing(from, to)?)
    }),
    Entry::new("WI-2.scale", "l h L H", |v| give(window_row(v.numbers()?)?[0])),
    Entry::new("WI-2.offset", "l h L H", |v| give(window_row(v.numbers()?)?[2])),
    Entry::new("plane", "\\mathbf{n} \\mathbf{p} \\mathbf{q}", |v| {
        let [a, b, c] = v.vector("n")?;
        let plane = Plane::<World>::through(v.vector("p")?.into(), Normal::new(a, b, c));
        give(plane.evaluate(Point::from(v.vector("q")?)))
    }),
];

/// Returns the map from a space to itself whose matrix is the value of a name.
pub fn projective(v: &Inputs<'_>, name: &str) -> Result<Projective<World, World>, String> {
    Ok(Projective::from_rows(v.matrix(name)?.to_square()?))
}

fn hpoint([x, y, z, w]: [f64; 4]) -> HPoint<World> {
    HPoint::new(x, y, z, w)
}

fn divide(v: &Inputs<'_>) -> Answer {
    give(hpoint(v.numbers()?).divide().ok_or("w = 0")?)
}

/// Returns the first row of the windowing map of one axis: scale, 0, offset.
fn window_row([l, h, to_l, to_h]: [f64; 4]) -> Result<[f64; 3], homog::RemapError> {
    let map = Homography::windowing([[l, 0.0], [h, 1.0]], [[to_l, 0.0], [to_h, 1.0]])?;
    Ok(map.rows()[0])
}
