//! Functions for points, maps and remappings.

use crate::finite::Finite;
use crate::random::Random;
use crate::subject::Subject;
use glam::DVec3;
use homog::{
    Affine, Bounds, Clip, CoordinateFrame, Foreshortening, HLine2, HPoint1, HPoint2, Homography,
    Model, Projective, Screen, View, World, perspective_weights, remap_interval,
};
use std::fmt::Write;

pub const SUBJECTS: &[Subject] = &[
    ("homog::HPoint::divide", |r| Some(r.hpoint::<Clip>().divide()?.finite())),
    ("homog::HPoint::meaning_within", |r| {
        Some(r.hpoint::<Clip>().kind_within(r.fraction()).finite())
    }),
    ("homog::HPoint::equivalent", |r| {
        r.hpoint::<Clip>().equivalent(r.hpoint(), r.fraction()).map(|_| true)
    }),
    ("homog::Hom1::divide", |r| Some(HPoint1::new(r.number(), r.number()).divide()?.finite())),
    ("homog::Hom2::divide", |r| Some(hom2(r).divide()?.finite())),
    ("homog::Hom2::join", |r| Some(hom2(r).join(hom2(r))?.finite())),
    ("homog::Line2::meet", |r| Some(line(r).meet(line(r))?.finite())),
    ("homog::Vector::normalized", |r| Some(r.vector::<World>().normalized()?.finite())),
    ("homog::Normal::normalized", |r| Some(r.normal::<World>().normalized()?.finite())),
    ("homog::Affine::inverse", |r| Some(r.affine::<Model, World>().inverse()?.finite())),
    ("homog::Affine::rotation", |r| {
        Some(Affine::<World, World>::rotation(r.vector(), r.number())?.finite())
    }),
    ("homog::Affine::from_quaternion", |r| {
        Some(Affine::<Model, World>::from_quaternion(r.numbers())?.finite())
    }),
    ("homog::Affine::plane", |r| {
        Some(r.affine::<Model, World>().transform_plane(r.plane())?.finite())
    }),
    ("homog::Affine::windowing", |r| {
        Some(Affine::<View, Clip>::windowing(r.points(), r.points()).ok()?.finite())
    }),
    ("homog::Projective::inverse", |r| Some(r.projective::<View, Clip>().inverse()?.finite())),
    ("homog::Projective::inverse_with_report", |r| {
        let report = r.projective::<View, Clip>().inverse_with_report().ok()?;
        Some((report.map, report.condition, report.residual).finite())
    }),
    ("homog::Projective::plane", |r| {
        Some(r.projective::<View, Clip>().transform_plane(r.plane())?.finite())
    }),
    ("homog::Projective::to_affine", |r| {
        let matrix = r.affine::<View, Screen>().raw() * r.number();
        for entry in matrix.to_cols_array() {
            r.given(entry);
        }
        Some(Projective::<View, Screen>::from_raw(matrix).to_affine()?.finite())
    }),
    ("homog::Projective::classify_within", |r| {
        let classification = r.projective::<View, Clip>().classify_within(r.fraction());
        Some(classification.rank <= 4 && classification.finite_vanishing_points() <= 3)
    }),
    ("homog::Projective::vanishing_point", |r| {
        Some(r.projective::<View, Clip>().vanishing_point(r.vector(), r.fraction()).finite())
            .filter(|finite| *finite)
    }),
    ("homog::Projective::equivalent", |r| {
        let (a, b) = (r.projective::<View, Clip>(), r.projective());
        a.equivalent(b, r.fraction()).map(|_| true)
    }),
    ("homog::Projective::display", display),
    ("homog::Homography::inverse", |r| Some(homography(r).inverse()?.finite())),
    ("homog::Homography::line", |r| Some(homography(r).transform_line(line(r))?.finite())),
    ("homog::Homography::from_unit_square", |r| {
        let corners = std::array::from_fn(|_| r.numbers());
        Some(Homography::from_unit_square(corners)?.finite())
    }),
    ("homog::Homography::windowing", |r| {
        let (from, to) =
            (std::array::from_fn(|_| r.numbers()), std::array::from_fn(|_| r.numbers()));
        Some(Homography::windowing(from, to).ok()?.finite())
    }),
    ("homog::remap", |r| Some(remap_interval(r.number(), r.numbers(), r.numbers()).ok()?.finite())),
    ("homog::Frame::new", |r| {
        let axes = [r.vector(), r.vector(), r.vector()];
        let frame = CoordinateFrame::<World>::new(r.point(), axes).ok()?;
        Some((frame.local_to_parent::<Model>(), frame.parent_to_local::<Model>()).finite())
    }),
    ("homog::Bounds::of", |r| Some(Bounds::<World>::from_points(r.points::<_, 4>())?.finite())),
    ("homog::Foreshortening::image", |r| {
        Some(foreshortening(r)?.image_parameter(r.number())?.finite())
    }),
    ("homog::Foreshortening::source", |r| {
        Some(foreshortening(r)?.source_parameter(r.number())?.finite())
    }),
    ("homog::Foreshortening::derivative", |r| {
        Some(foreshortening(r)?.derivative(r.number())?.finite())
    }),
    ("homog::Foreshortening::attribute", |r| {
        Some(foreshortening(r)?.interpolate_attribute(r.number(), r.number(), r.number())?.finite())
    }),
    ("homog::Foreshortening on its segment", on_the_segment),
    ("homog::perspective_weights", |r| {
        Some(perspective_weights(r.numbers(), r.numbers())?.finite())
    }),
];

fn hom2(r: &mut Random) -> HPoint2 {
    HPoint2::from_raw(DVec3::from(r.numbers()))
}

fn line(r: &mut Random) -> HLine2 {
    HLine2::from_raw(DVec3::from(r.numbers()))
}

fn homography(r: &mut Random) -> Homography {
    Homography::from_raw(r.matrix3())
}

fn foreshortening(r: &mut Random) -> Option<Foreshortening> {
    Foreshortening::new(r.size(), r.size()).ok()
}

/// Checks that a parameter from 0 to 1 on the segment always has an image, which is also from 0 to
/// 1.
fn on_the_segment(r: &mut Random) -> Option<bool> {
    let (f, t) = (foreshortening(r)?, r.fraction());
    if !(0.0..=1.0).contains(&t) {
        return None;
    }
    let inside = |s: Option<f64>| s.is_some_and(|s| (0.0..=1.0).contains(&s));
    Some(inside(f.image_parameter(t)) && inside(f.source_parameter(t)))
}

/// Checks that a matrix of arbitrary numbers can be displayed.
fn display(r: &mut Random) -> Option<bool> {
    let map: Projective<View, Clip> = r.projective();
    let mut text = String::new();
    write!(text, "{}", map.display()).ok()?;
    Some(!text.is_empty())
}
