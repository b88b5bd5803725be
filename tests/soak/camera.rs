//! Functions for cameras, framing, stereo and screens.

use crate::finite::Finite;
use crate::random::Random;
use crate::subject::Subject;
use camera::{
    Basis, Camera, CameraView, NamedView, Orbit, Orientation, ParallelFraming, ScreenCorners,
    Slopes, StereoPair, StereoRig, ViewWindow, apex_moved_view, frame_oblique, frame_parallel,
    frame_perspective,
};
use homog::{Point, World};

pub const SUBJECTS: &[Subject] = &[
    ("camera::Basis::from_gaze", |r| Some(Basis::from_gaze(r.vector(), r.vector()).ok()?.finite())),
    ("camera::Basis::from_gaze_or_fallback", |r| {
        Some(Basis::from_gaze_or_fallback(r.vector(), r.vector()).ok()?.finite())
    }),
    ("camera::Basis::from_azimuth_elevation", |r| {
        Some(Basis::from_azimuth_elevation(r.number(), r.number()).ok()?.finite())
    }),
    ("camera::Basis::rolled", |r| Some(basis(r)?.rolled(r.number()).ok()?.finite())),
    ("camera::Camera::look_at", |r| {
        Some(Camera::look_at(r.point(), r.point(), r.vector()).ok()?.finite())
    }),
    ("camera::Camera::look_to", |r| Some(look_to(r)?.finite())),
    ("camera::Camera::look_at_or_fallback", |r| {
        Some(Camera::look_at_or_fallback(r.point(), r.point(), r.vector()).ok()?.finite())
    }),
    ("camera::Camera::look_to_or_fallback", |r| {
        Some(Camera::look_to_or_fallback(r.point(), r.vector(), r.vector()).ok()?.finite())
    }),
    ("camera::Camera::from_frame", |r| {
        Some(Camera::from_frame(r.affine::<homog::Model, World>()).ok()?.finite())
    }),
    ("camera::Camera::moved", |r| Some(look_to(r)?.moved(r.vector()).ok()?.finite())),
    ("camera::Attitude::basis", |r| {
        let [yaw, pitch, roll] = r.numbers();
        let basis = Orientation { yaw, pitch, roll }.basis().ok()?;
        let Orientation { yaw, pitch, roll } = Orientation::from_basis(basis);
        Some(basis.finite() && [yaw, pitch, roll].finite())
    }),
    ("camera::Orbit::camera", |r| Some(orbit(r).camera().ok()?.finite())),
    ("camera::Orbit::of", |r| {
        let there = orbit(r);
        let camera = if r.coin() { there.camera().ok()? } else { look_to(r)? };
        let Orbit { target, azimuth, elevation, distance } =
            Orbit::from_camera(camera, there.target)?;
        Some((target, [azimuth, elevation, distance]).finite())
    }),
    ("camera::Orbit::turntable", |r| {
        let frames = r.count() % 8;
        let mut cameras = orbit(r).turntable(frames).map(Orbit::camera);
        Some(cameras.all(|camera| camera.is_ok_and(|camera| camera.finite())))
            .filter(|finite| *finite)
    }),
    ("camera::Slopes::vertical_angle", |r| {
        Some(numbers(Slopes::vertical_angle(r.opening(), r.size()).ok()?).finite())
    }),
    ("camera::Slopes::padded", |r| Some(numbers(slopes(r).padded(r.fraction()).ok()?).finite())),
    ("camera::frame_perspective", |r| {
        let points = cloud(r);
        let framing = frame_perspective(points, basis(r)?, slopes(r), padding(r)).ok()?;
        Some(framing.camera.finite() && [framing.near, framing.far].finite())
    }),
    ("camera::frame_parallel", |r| {
        let points = cloud(r);
        parallel(frame_parallel(points, basis(r)?, r.size(), padding(r)).ok()?)
    }),
    ("camera::frame_oblique", |r| {
        let points = cloud(r);
        let projectors = r.vector();
        parallel(frame_oblique(points, basis(r)?, projectors, r.size(), padding(r)).ok()?)
    }),
    ("camera::ViewWindow::at", |r| Some(window(r).at_distance(r.size()).ok()?.finite())),
    ("camera::ViewWindow::slopes", |r| Some(numbers(window(r).slopes().ok()?).finite())),
    ("camera::StereoRig::pair", |r| pair(rig(r).off_axis_pair(look_to(r)?, window(r)).ok()?)),
    ("camera::StereoRig::pair_apex_moved", |r| {
        pair(rig(r).pair_apex_moved(look_to(r)?, window(r)).ok()?)
    }),
    ("camera::StereoRig::parallax", |r| Some(rig(r).parallax(r.size()).ok()?.finite())),
    ("camera::apex_moved", |r| Some(apex_moved_view(look_to(r)?, window(r)).ok()?.finite())),
    ("camera::ScreenCorners::view_from", |r| Some(screen(r).view_from(r.point()).ok()?.finite())),
];

impl Finite for Basis {
    fn finite(&self) -> bool {
        (self.u(), self.v(), self.w()).finite()
    }
}

impl Finite for Camera {
    fn finite(&self) -> bool {
        (self.eye(), self.basis(), self.world_to_view(), self.view_to_world()).finite()
    }
}

impl Finite for ViewWindow {
    fn finite(&self) -> bool {
        [self.left, self.right, self.bottom, self.top, self.distance].finite()
    }
}

impl Finite for CameraView {
    fn finite(&self) -> bool {
        (self.camera, self.window).finite()
    }
}

/// Returns the basis of the front view or a random basis.
fn basis(r: &mut Random) -> Option<Basis> {
    if r.coin() {
        return Some(NamedView::Front.basis());
    }
    Basis::from_gaze(r.vector(), r.vector()).ok()
}

fn look_to(r: &mut Random) -> Option<Camera> {
    Camera::look_to(r.point(), r.vector(), r.vector()).ok()
}

fn orbit(r: &mut Random) -> Orbit {
    let [azimuth, elevation] = r.numbers();
    Orbit { target: r.point(), azimuth, elevation, distance: r.size() }
}

/// Returns four sides, mostly with left less than right and bottom less than top.
fn sides(r: &mut Random) -> [f64; 4] {
    let mut pair = || {
        let [a, b] = r.numbers();
        if a > b && r.below(16) > 0 { [b, a] } else { [a, b] }
    };
    let ([left, right], [bottom, top]) = (pair(), pair());
    [left, right, bottom, top]
}

fn slopes(r: &mut Random) -> Slopes {
    let [left, right, bottom, top] = sides(r);
    Slopes { left, right, bottom, top }
}

fn numbers(slopes: Slopes) -> [f64; 4] {
    [slopes.left, slopes.right, slopes.bottom, slopes.top]
}

fn window(r: &mut Random) -> ViewWindow {
    let [left, right, bottom, top] = sides(r);
    ViewWindow { left, right, bottom, top, distance: r.size() }
}

/// Returns a padding, mostly below one half.
fn padding(r: &mut Random) -> f64 {
    let padding = r.fraction() / 2.0;
    r.instead(padding)
}

/// Returns one to four points.
fn cloud(r: &mut Random) -> Vec<Point<World>> {
    (0..=r.below(4)).map(|_| r.point()).collect()
}

fn rig(r: &mut Random) -> StereoRig {
    StereoRig { interocular: r.size(), zero_parallax: r.size() }
}

/// Returns the corners of a screen whose sides are perpendicular, except for rounding errors.
fn screen(r: &mut Random) -> ScreenCorners {
    let lower_left = r.point();
    let across = r.vector::<World>();
    let along = across.cross(r.vector()) * (1.0 / 16.0);
    let [lower_right, upper_left] = [lower_left + across, lower_left + along];
    for corner in [lower_right, upper_left] {
        for coordinate in <[f64; 3]>::from(corner) {
            r.given(coordinate);
        }
    }
    ScreenCorners { lower_left, lower_right, upper_left }
}

fn pair(pair: StereoPair) -> Option<bool> {
    Some((pair.left, pair.right).finite())
}

fn parallel(framing: ParallelFraming) -> Option<bool> {
    let ParallelFraming { camera, left, right, bottom, top, near, far, .. } = framing;
    Some((camera, [left, right, bottom, top, near, far]).finite())
}
