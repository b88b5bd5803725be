//! Functions that build projections, in every convention.

use crate::finite::Finite;
use crate::random::Random;
use crate::subject::Subject;
use homog::NdcY;
use homog::{Clip, Projective, View};
use projection::{
    ApexMovedFrustum, Axonometric, Classical, ConstructedPerspective, Convention, Decomposed,
    DepthCurve, DepthFormat, FourAngles, Fov, Frustum, Handedness, Jitter, NPoint, Oblique,
    Orthographic, Perspective, Planometric, PrincipalView, ProjectionError, Projector, SensorSize,
    VanishingPoint, ViewOffset, ViewVolume, Window, api, chapter, decompose, oblique_near_plane,
    opening_angle_of, principal_vanishing_points, readings, third_row, vanishing_point,
};
use recognition::{IntendedProjection, Misprint, misprint_of, recognize, recognize_planar};

pub const SUBJECTS: &[Subject] = &[
    ("projection::Window::new", |r| Some(any_window(r)?.finite())),
    ("projection::Window::centered", |r| Some(Window::centered(r.size(), r.size()).ok()?.finite())),
    ("projection::Frustum::new", |r| {
        let ([l, rt, b, t], [near, far]) = (r.numbers(), r.near_and_any_far());
        frustum_is_finite(Frustum::new(l, rt, b, t, near, far).ok()?, r)
    }),
    ("projection::Frustum::from_window", |r| {
        let (window, [near, far]) = (any_window(r)?, r.near_and_any_far());
        frustum_is_finite(Frustum::from_window(window, near, far).ok()?, r)
    }),
    ("projection::Frustum::from_slopes", |r| {
        let (window, [near, far]) = (any_window(r)?, r.near_and_any_far());
        frustum_is_finite(Frustum::from_slopes(window, near, far).ok()?, r)
    }),
    ("projection::Frustum::factors", |r| {
        let (frustum, c) = (any_frustum(r)?, convention(r));
        let factors = frustum.factors(c);
        Some((factors.shear, factors.scale, factors.depth).finite())
    }),
    ("projection::Frustum::view_to_canonical_frustum", |r| {
        Some(any_frustum(r)?.view_to_canonical_frustum(convention(r))?.finite())
    }),
    ("projection::Perspective::new", |r| {
        let lens = any_lens(r)?;
        let angles = [lens.fov_x(), lens.fov_y(), lens.fov_diagonal(), lens.aspect()];
        let c = convention(r);
        let maps = (lens.view_to_clip(c), lens.clip_to_view(c), lens.to_frustum().view_to_clip(c));
        Some(angles.finite() && maps.finite())
    }),
    ("projection::Perspective::try_from", |r| {
        let (window, [near, far]) = (Window::centered(r.size(), r.size()), r.near_and_any_far());
        let centered = Frustum::from_window(window.ok()?, near, far).ok()?;
        Some(Perspective::try_from(centered).ok()?.view_to_clip(convention(r)).finite())
    }),
    ("projection::Orthographic::new", |r| {
        let (volume, c) = (any_box(r)?, convention(r));
        Some((volume.view_to_clip(c), volume.clip_to_view(c)).finite())
    }),
    ("projection::Orthographic::from_window", |r| {
        let volume = Orthographic::from_window(any_window(r)?, r.number(), r.number()).ok()?;
        Some(volume.view_to_clip(convention(r)).finite())
    }),
    ("projection::ApexMovedFrustum::new", |r| {
        let ([l, rt, b, t], [near, far], c) = (r.numbers(), r.near_far(), convention(r));
        let lesson = ApexMovedFrustum::new(l, rt, b, t, near, far).ok()?;
        let steps = lesson.steps(c);
        let steps = (steps.move_apex, steps.map_depth, steps.project, steps.scale_window);
        Some((lesson.view_to_clip(c), lesson.clip_to_view(c), steps).finite())
    }),
    ("projection::FourAngles::frustum", |r| {
        let [left, right, down, up] = r.numbers().map(|angle: f64| angle / 8.0);
        let [near, far] = r.near_and_any_far();
        frustum_is_finite(FourAngles { left, right, down, up }.frustum(near, far).ok()?, r)
    }),
    ("projection::Perspective::tile", |r| {
        frustum_is_finite(any_lens(r)?.view_offset(tile(r)).ok()?, r)
    }),
    ("projection::Perspective::shifted", |r| {
        frustum_is_finite(any_lens(r)?.shifted(r.number(), r.number()).ok()?, r)
    }),
    ("projection::Perspective::jittered", |r| {
        frustum_is_finite(any_lens(r)?.jittered(jitter(r)).ok()?, r)
    }),
    ("projection::Frustum::tile", |r| {
        frustum_is_finite(any_frustum(r)?.view_offset(tile(r)).ok()?, r)
    }),
    ("projection::Frustum::shifted", |r| {
        frustum_is_finite(any_frustum(r)?.shifted(r.number(), r.number()).ok()?, r)
    }),
    ("projection::Frustum::jittered", |r| {
        frustum_is_finite(any_frustum(r)?.jittered(jitter(r)).ok()?, r)
    }),
    ("projection::Orthographic::tile", |r| {
        Some(any_box(r)?.view_offset(tile(r)).ok()?.view_to_clip(convention(r)).finite())
    }),
    ("projection::Orthographic::shifted", |r| {
        let moved = any_box(r)?.shifted(r.number(), r.number()).ok()?;
        Some(moved.view_to_clip(convention(r)).finite())
    }),
    ("projection::Orthographic::jittered", |r| {
        Some(any_box(r)?.jittered(jitter(r)).ok()?.view_to_clip(convention(r)).finite())
    }),
    ("projection::oblique_near_plane of a frustum", |r| {
        let (map, c) = (any_frustum(r)?, convention(r));
        Some(oblique_near_plane(map.view_to_clip(c), c, r.plane()).ok()?.finite())
    }),
    ("projection::oblique_near_plane of any matrix", |r| {
        let (map, c) = (r.projective(), convention(r));
        Some(oblique_near_plane(map, c, r.plane()).ok()?.finite())
    }),
    ("projection::Axonometric::by_angles", |r| {
        classical(Axonometric::by_angles(r.number(), r.number()), r)
    }),
    ("projection::Axonometric::by_normal", |r| classical(Axonometric::by_normal(r.normal()), r)),
    ("projection::Axonometric::by_foreshortening", |r| {
        classical(Axonometric::by_foreshortening(r.size(), r.size(), r.size()), r)
    }),
    ("projection::Axonometric::about", |r| classical(Axonometric::isometric().about(r.point()), r)),
    ("projection::Axonometric::drawn_angles", |r| {
        let axonometric = Axonometric::by_angles(r.number(), r.number()).ok()?;
        Some((axonometric.drawn_angles(), axonometric.foreshortening()).finite())
    }),
    ("projection::Oblique::new", |r| classical(Oblique::new(r.size(), r.number()), r)),
    ("projection::Oblique::by_angle", |r| classical(Oblique::by_angle(r.opening(), r.number()), r)),
    ("projection::Oblique::by_direction", |r| {
        classical(Oblique::by_direction(r.vector(), r.number()), r)
    }),
    ("projection::Oblique::cavalier", |r| classical(Oblique::cavalier(r.number()), r)),
    ("projection::Oblique::cabinet", |r| classical(Oblique::cabinet(r.number()), r)),
    ("projection::Oblique::factors", |r| {
        let slant = Oblique::by_direction(r.vector(), r.number()).ok()?;
        let (volume, c) = (any_box(r)?, convention(r));
        let factors = slant.factors(volume, c);
        let lengths = [slant.length(), slant.phi(), slant.alpha()];
        Some((factors.shear, factors.fit, lengths).finite())
    }),
    ("projection::Planometric::new", |r| classical(Planometric::new(r.number(), r.size()), r)),
    ("projection::Planometric::military", |r| classical(Planometric::military(r.number()), r)),
    ("projection::NPoint::new", |r| classical(NPoint::new(r.number(), r.number(), r.number()), r)),
    ("projection::NPoint::from_eye", |r| classical(NPoint::from_eye(r.number()), r)),
    ("projection::NPoint::by_vanishing_points", |r| {
        let mut maybe = || r.coin().then(|| r.number());
        let [x, y, z] = [maybe(), maybe(), maybe()];
        classical(NPoint::by_vanishing_points(x, y, z), r)
    }),
    ("projection::PrincipalView", |r| classical(Ok(r.pick(&PrincipalView::ALL)), r)),
    ("projection::Projector::from_eye", |r| {
        let projector = Projector::<View>::from_eye(r.point(), r.plane()).ok()?;
        Some((projector.onto_plane(), projector.depth_preserving()).finite())
    }),
    ("projection::Projector::along", |r| {
        let projector = Projector::<View>::along(r.vector(), r.plane()).ok()?;
        Some((projector.onto_plane(), projector.depth_preserving()).finite())
    }),
    ("projection::ConstructedPerspective::one_point", |r| {
        constructed(ConstructedPerspective::one_point(pair(r), r.size()), r)
    }),
    ("projection::ConstructedPerspective::two_point", |r| {
        constructed(ConstructedPerspective::two_point(pair(r), pair(r), r.fraction()), r)
    }),
    ("projection::ConstructedPerspective::three_point", |r| {
        constructed(ConstructedPerspective::three_point(pair(r), pair(r), pair(r)), r)
    }),
    ("projection::vanishing_point", |r| {
        Some(vanishing_point(r.projective::<View, Clip>(), r.vector()).ok()?.point().finite())
    }),
    ("projection::principal_vanishing_points", |r| {
        let found = principal_vanishing_points(r.projective::<View, Clip>()).ok()?;
        Some(found.axes.map(VanishingPoint::point).finite())
    }),
    ("projection::ViewVolume", |r| {
        let (frustum, c) = (any_frustum(r)?, convention(r));
        let volume = ViewVolume::new(frustum.view_to_clip(c), c);
        let _ = volume.contains(r.point());
        Some((volume.corners(), volume.eye()).finite())
    }),
    ("projection::ViewVolume of any matrix", |r| {
        let volume = ViewVolume::new(r.projective(), convention(r));
        let _ = (volume.planes(), volume.contains(r.point()));
        volume.corners()?;
        Some((volume.corners(), volume.eye()).finite())
    }),
    ("projection::Convention::with_depths", |r| {
        let made = Convention::OPENGL.with_depths(r.number() / 8.0, r.number() / 8.0).ok()?;
        Some((made.clip_to_clip(convention(r)), convention(r).clip_to_clip(made)).finite())
    }),
    ("projection::Convention::convert", |r| {
        let (frustum, from, to) = (any_frustum(r)?, convention(r), convention(r));
        Some(from.convert(to, frustum.view_to_clip(from)).finite())
    }),
    ("projection::DepthCurve::perspective", |r| {
        let [near, far] = r.near_and_any_far();
        depth(DepthCurve::perspective(near, far, convention(r)), r)
    }),
    ("projection::DepthCurve::parallel", |r| {
        depth(DepthCurve::parallel(r.number(), r.number(), convention(r)), r)
    }),
    ("projection::third_row", |r| Some(third_row(pair(r), pair(r)).ok()?.finite())),
    ("projection::opening_angle_of", |r| {
        Some(opening_angle_of(r.number(), r.number(), r.size()).ok()?.finite())
    }),
    ("projection::decompose", |r| decomposed(r.matrix4(), r)),
    ("projection::decompose of a frustum", |r| {
        let (frustum, c) = (any_frustum(r)?, convention(r));
        decomposed(frustum.view_to_clip(c).raw(), r)
    }),
    ("projection::readings", |r| {
        let mut read = readings(Projective::from_raw(r.matrix4()));
        Some(read.all(|(_, reading)| reading.factor.is_finite()))
    }),
    ("recognition::recognize", |r| {
        let found = recognize(r.matrix4().transpose().to_cols_array_2d());
        let factors = found.readings.iter().all(|reading| reading.factor.is_finite());
        Some(
            factors
                && found.suspicions.iter().all(|slip| {
                    slip.remedied.is_none_or(|rows| {
                        rows.as_flattened().iter().all(|entry| entry.is_finite())
                    })
                }),
        )
    }),
    ("recognition::recognize_planar", |r| {
        let rows = r.matrix4().transpose().to_cols_array_2d();
        let (found, _) = recognize_planar([0, 1, 2].map(|i| [0, 1, 2].map(|j| rows[i][j])));
        Some(found.iter().all(|reading| reading.factor.is_finite()))
    }),
    ("recognition::misprint_of", |r| {
        let wanted = IntendedProjection::Frustum(any_frustum(r)?);
        let matrix = r.pick(&Misprint::ALL).misprinted_matrix(wanted)?;
        misprint_of(matrix, wanted).map(|_| matrix.finite())
    }),
    ("projection::chapter::p", |r| two(r, chapter::p)),
    ("projection::chapter::p_inverse", |r| two(r, chapter::p_inverse)),
    ("projection::chapter::p_inverse_scaled", |r| two(r, chapter::p_inverse_scaled)),
    ("projection::chapter::m_orth", |r| signed_six(r, chapter::m_orth)),
    ("projection::chapter::m_orth_inverse", |r| signed_six(r, chapter::m_orth_inverse)),
    ("projection::chapter::m_per", |r| signed_six(r, chapter::m_per)),
    ("projection::chapter::m_per_positive", |r| signed_six(r, chapter::m_per_positive)),
    ("projection::chapter::m_per_inverse", |r| signed_six(r, chapter::m_per_inverse)),
    ("projection::chapter::window_from_fov", |r| {
        let (theta, [nx, ny]) = (r.opening(), [r.size(), r.size()]);
        Some(chapter::window_from_fov(theta, nx, ny, -r.size()).ok()?.finite())
    }),
    ("projection::chapter::fov_from_window", |r| {
        Some(chapter::fov_from_window(r.size(), -r.size()).ok()?.finite())
    }),
    ("projection::api::frustum_gl", |r| six(r, api::frustum_gl)),
    ("projection::api::frustum_rh_zo", |r| six(r, api::frustum_rh_zo)),
    ("projection::api::frustum_lh_zo", |r| six(r, api::frustum_lh_zo)),
    ("projection::api::ortho_gl", |r| six(r, api::ortho_gl)),
    ("projection::api::ortho_rh_zo", |r| six(r, api::ortho_rh_zo)),
    ("projection::api::ortho_lh_zo", |r| six(r, api::ortho_lh_zo)),
    ("projection::api::perspective_gl", |r| four(r, api::perspective_gl)),
    ("projection::api::perspective_rh_zo", |r| four(r, api::perspective_rh_zo)),
    ("projection::api::perspective_lh_zo", |r| four(r, api::perspective_lh_zo)),
    ("projection::api::perspective_rh_zo_rev", |r| four(r, api::perspective_rh_zo_rev)),
    ("projection::api::perspective_gl_inf", |r| three(r, api::perspective_gl_inf)),
    ("projection::api::perspective_rh_zo_inf", |r| three(r, api::perspective_rh_zo_inf)),
    ("projection::api::perspective_rh_zo_rev_inf", |r| three(r, api::perspective_rh_zo_rev_inf)),
];

type Made<T> = Result<T, ProjectionError>;
type Matrix = Made<Projective<View, Clip>>;

impl Finite for Window {
    fn finite(&self) -> bool {
        let sides = [self.left(), self.right(), self.bottom(), self.top()];
        (sides, [self.width(), self.height()], self.center()).finite()
    }
}

/// Returns a variant of a named convention, sometimes with custom depths.
fn convention(r: &mut Random) -> Convention {
    let depths = [Convention::CHAPTER, Convention::OPENGL, Convention::WEBGPU];
    let mut convention = r
        .pick(&depths)
        .with_handedness(r.pick(&[Handedness::Right, Handedness::Left]))
        .with_ndc_y(r.pick(&[NdcY::Up, NdcY::Down]));
    if r.coin() {
        convention = convention.reversed();
    }
    if r.below(8) == 0 {
        convention = convention.with_depths(0.25, 0.75).unwrap_or(convention);
    }
    convention
}

fn pair(r: &mut Random) -> (f64, f64) {
    (r.number(), r.number())
}

fn any_window(r: &mut Random) -> Option<Window> {
    let [left, right, bottom, top] = r.numbers();
    Window::new(left, right, bottom, top).ok()
}

fn any_frustum(r: &mut Random) -> Option<Frustum> {
    let ([left, right, bottom, top], [near, far]) = (r.numbers(), r.near_and_any_far());
    Frustum::new(left, right, bottom, top, near, far).ok()
}

fn any_box(r: &mut Random) -> Option<Orthographic> {
    let [left, right, bottom, top, near, far] = r.numbers();
    Orthographic::new(left, right, bottom, top, near, far).ok()
}

fn any_lens(r: &mut Random) -> Option<Perspective> {
    let fov = match r.below(6) {
        0 => Fov::Vertical(r.opening()),
        1 => Fov::Horizontal(r.opening()),
        2 => Fov::Diagonal(r.opening()),
        3 => Fov::FocalLength { focal: r.size(), film: SensorSize::Height(r.size()) },
        4 => Fov::FocalLength { focal: r.size(), film: SensorSize::Width(r.size()) },
        _ => Fov::FocalLength { focal: r.size(), film: SensorSize::Diagonal(r.size()) },
    };
    let (aspect, [near, far]) = (r.size(), r.near_and_any_far());
    Perspective::new(fov, aspect, near, far).ok()
}

fn tile(r: &mut Random) -> ViewOffset {
    let [full, size] = [(r.size(), r.size()), (r.size(), r.size())];
    ViewOffset { full, corner: pair(r), size }
}

fn jitter(r: &mut Random) -> Jitter {
    Jitter { image: (r.size(), r.size()), offset: pair(r) }
}

fn frustum_is_finite(frustum: Frustum, r: &mut Random) -> Option<bool> {
    let c = convention(r);
    let maps = (frustum.view_to_clip(c), frustum.clip_to_view(c));
    Some((maps, frustum.window(), frustum.slopes()).finite())
}

/// Checks all matrices of a classical projection, including its maps to and from clip space for a
/// random volume.
fn classical(made: Made<impl Into<Classical>>, r: &mut Random) -> Option<bool> {
    let made = made.ok()?.into();
    let matrices = (made.onto_plane(), made.depth_preserving(), made.depth_preserving_inverse());
    let (volume, c) = (any_box(r), convention(r));
    let picture = volume.map(|volume| (made.view_to_clip(volume, c), made.clip_to_view(volume, c)));
    Some((matrices, picture).finite())
}

fn constructed(made: Made<ConstructedPerspective>, r: &mut Random) -> Option<bool> {
    let made = made.ok()?;
    let numbers = (made.principal_point(), made.distance(), made.world_to_view()).finite();
    let (Some(window), [near, far]) = (any_window(r), r.near_and_any_far()) else {
        return Some(numbers);
    };
    let frustum = made.frustum(window, near, far);
    let map = frustum.map(|frustum| frustum.view_to_clip(convention(r)));
    Some(numbers && map.finite())
}

fn depth(curve: Made<DepthCurve>, r: &mut Random) -> Option<bool> {
    let (curve, at) = (curve.ok()?, r.number());
    let (a, b) = curve.coefficients();
    let steps =
        [DepthFormat::Float32, DepthFormat::FixedPoint(24)].map(|f| curve.resolution(at, f));
    let there_and_back = [curve.depth(at), curve.distance(at), curve.slope(at)];
    Some((there_and_back, steps, [a, b, curve.half_range_distance()]).finite())
}

fn decomposed(matrix: glam::DMat4, r: &mut Random) -> Option<bool> {
    let c = convention(r);
    let found = decompose(Projective::from_raw(matrix), c).ok()?;
    let finite = match found.kind {
        Decomposed::Frustum(frustum) => frustum.view_to_clip(c).finite(),
        Decomposed::ApexMoved(lesson) => lesson.view_to_clip(c).finite(),
        Decomposed::PlacedFrustum { placement, frustum } => {
            (placement, frustum.view_to_clip(c)).finite()
        }
        Decomposed::ObliqueNear { placement, slopes, near_plane } => {
            (placement, slopes, near_plane).finite()
        }
        Decomposed::Orthographic(volume) => volume.view_to_clip(c).finite(),
        Decomposed::Classical { projection, volume } => {
            (projection.depth_preserving(), volume.view_to_clip(c)).finite()
        }
        Decomposed::PlacedOrthographic { placement, volume } => {
            (placement, volume.view_to_clip(c)).finite()
        }
        Decomposed::NPoint(projection) => projection.depth_preserving().finite(),
        Decomposed::Flat { center, projection } => {
            (center, projection.map(Classical::onto_plane)).finite()
        }
    };
    Some(finite && found.factor.is_finite())
}

fn two(r: &mut Random, build: fn(f64, f64) -> Made<Projective<View, View>>) -> Option<bool> {
    Some(build(r.number(), r.number()).ok()?.finite())
}

type Six<T> = fn(f64, f64, f64, f64, f64, f64) -> T;

/// Builds a matrix from distances to the near and far planes.
fn six(r: &mut Random, build: Six<Matrix>) -> Option<bool> {
    let ([left, right, bottom, top], [near, far]) = (r.numbers(), r.near_far());
    Some(build(left, right, bottom, top, near, far).ok()?.finite())
}

/// Builds a matrix from the coordinates of the near and far planes, which are negative.
fn signed_six<T: Finite>(r: &mut Random, build: Six<Made<T>>) -> Option<bool> {
    let ([left, right, bottom, top], [near, far]) = (r.numbers(), r.near_far());
    Some(build(left, right, bottom, top, -near, -far).ok()?.finite())
}

fn four(r: &mut Random, build: fn(f64, f64, f64, f64) -> Matrix) -> Option<bool> {
    let (fovy, aspect, [near, far]) = (r.opening(), r.size(), r.near_far());
    Some(build(fovy, aspect, near, far).ok()?.finite())
}

fn three(r: &mut Random, build: fn(f64, f64, f64) -> Matrix) -> Option<bool> {
    Some(build(r.opening(), r.size(), r.size()).ok()?.finite())
}
