//! Registry entries for depth as a function of distance (GL-1, LW-3, D3D-1 to D3D-6, RV-1, IF-1 to
//! IF-3, ZP-1).

use super::Entry;
use super::inputs::{Answer, Inputs, give};
use projection::{Convention, DepthCurve, DepthFormat};

const AT: &str = "N F D";
const ZERO_ONE: Convention = Convention::DIRECT3D;

pub const ENTRIES: &[Entry] = &[
    Entry::new("GL-3.depth", AT, |v| parallel_depth(v, Convention::OPENGL)),
    Entry::new("LW-3", AT, |v| depth(v, Convention::OPENGL)),
    Entry::new("LW-3.c1", "N F", |v| give(coefficients(v)?.1)),
    Entry::new("LW-3.c2", "N F", |v| give(coefficients(v)?.0)),
    Entry::new("LW-3.zero", "N F", half_range),
    Entry::new("ZP-1", AT, |v| depth(v, ZERO_ONE)),
    Entry::new("ZP-1.slope", AT, |v| slope(v, ZERO_ONE)),
    Entry::new("ZP-1.reversed", AT, |v| depth(v, ZERO_ONE.reversed())),
    Entry::new("ZP-1.infinite", "N D", |v| endless_depth(v, ZERO_ONE.reversed())),
    Entry::new("ZP-1.step", "N F D B", |v| {
        let [near, far, at, bits] = v.numbers()?;
        let bits =
            (1..=64).find(|&whole| f64::from(whole) == bits).ok_or("B must be from 1 to 64")?;
        let curve = DepthCurve::perspective(near, far, ZERO_ONE)?;
        give(curve.resolution(at, DepthFormat::FixedPoint(bits))?)
    }),
];

fn depth(v: &Inputs<'_>, convention: Convention) -> Answer {
    let [near, far, at] = v.numbers()?;
    give(DepthCurve::perspective(near, far, convention)?.depth(at).ok_or("D = 0")?)
}

fn endless_depth(v: &Inputs<'_>, convention: Convention) -> Answer {
    let [near, at] = v.numbers()?;
    give(DepthCurve::perspective(near, f64::INFINITY, convention)?.depth(at).ok_or("D = 0")?)
}

fn parallel_depth(v: &Inputs<'_>, convention: Convention) -> Answer {
    let [near, far, at] = v.numbers()?;
    give(DepthCurve::parallel(near, far, convention)?.depth(at).ok_or("no depth")?)
}

fn slope(v: &Inputs<'_>, convention: Convention) -> Answer {
    let [near, far, at] = v.numbers()?;
    give(DepthCurve::perspective(near, far, convention)?.slope(at).ok_or("D = 0")?)
}

fn half_range(v: &Inputs<'_>) -> Answer {
    let [near, far] = v.numbers()?;
    give(DepthCurve::perspective(near, far, Convention::OPENGL)?.half_range_distance())
}

fn coefficients(v: &Inputs<'_>) -> Result<(f64, f64), Box<dyn std::error::Error>> {
    let [near, far] = v.numbers()?;
    Ok(DepthCurve::perspective(near, far, Convention::OPENGL)?.coefficients())
}
