//! Tiles, shifts, jitter, four angles, the geometry of the view volume, and inclined near planes.

use super::samples::{
    self, convention, direction, distance, frustum, orthographic, perspective, point,
};
use glam::{DMat4, DVec3};
use homog::{Clip, HPoint, Ndc, Normal, Plane, Point, Projective, View};
use projection::{
    Convention, FourAngles, Fov, Frustum, Jitter, Orthographic, Perspective, ProjectionError,
    ViewOffset, ViewVolume, Window, oblique_near_plane, opening_angle_of,
};
use proptest::prelude::*;

/// Returns the map from tile NDC to the NDC of the whole picture: x' = a x + b.
fn tile_to_whole(tile: ViewOffset, convention: Convention) -> DMat4 {
    let (w, h) = tile.full;
    let (sx, sy) = (tile.size.0 / w, tile.size.1 / h);
    let middle = (tile.corner.0 + tile.size.0 / 2.0, tile.corner.1 + tile.size.1 / 2.0);
    let offset =
        DVec3::new(2.0 * middle.0 / w - 1.0, convention.top() * (1.0 - 2.0 * middle.1 / h), 0.0);
    DMat4::from_translation(offset) * DMat4::from_scale(DVec3::new(sx, sy, 1.0))
}

fn tile() -> impl Strategy<Value = ViewOffset> {
    (10.0..4000.0, 10.0..4000.0, -0.5..1.2, -0.5..1.2, 0.05..1.0, 0.05..1.0).prop_map(
        |(w, h, x, y, sx, sy)| ViewOffset {
            full: (w, h),
            corner: (x * w, y * h),
            size: (sx * w, sy * h),
        },
    )
}

proptest! {
    #![proptest_config(samples::cases(96))]

    #[test]
    fn a_tile_shows_its_part_of_the_picture(
        f in frustum(),
        p in perspective(),
        o in orthographic(),
        t in tile(),
        c in convention(),
    ) {
        let back = tile_to_whole(t, c);
        for (tiled, whole) in [
            (f.view_offset(t).expect("valid").view_to_clip(c), f.view_to_clip(c)),
            (p.view_offset(t).expect("valid").view_to_clip(c), p.view_to_clip(c)),
            (o.view_offset(t).expect("valid").view_to_clip(c), o.view_to_clip(c)),
        ] {
            prop_assert!(distance(back * tiled.raw(), whole.raw()) < 1e-10);
        }
    }

    #[test]
    fn neighboring_tiles_share_their_edge_exactly(f in frustum(), cut in 1_u32..99) {
        let (full, at) = ((100.0, 80.0), f64::from(cut));
        let left =
            f.view_offset(ViewOffset { full, corner: (0.0, 0.0), size: (at, 80.0) }).expect("valid").window();
        let right = f
            .view_offset(ViewOffset { full, corner: (at, 0.0), size: (100.0 - at, 80.0) })
            .expect("valid")
            .window();
        prop_assert_eq!(left.right(), right.left());
        prop_assert_eq!((left.left(), right.right()), (f.window().left(), f.window().right()));
        prop_assert_eq!((left.top(), left.bottom()), (f.window().top(), f.window().bottom()));
    }

    #[test]
    fn jitter_moves_the_picture_opposite_to_the_sample(
        f in frustum(),
        c in convention(),
        dx in -0.5..0.5,
        dy in -0.5..0.5,
        p in point(),
    ) {
        let image = (640.0, 480.0);
        let moved = f.jittered(Jitter { image, offset: (dx, dy) }).expect("valid").view_to_clip(c);
        let (before, after) = (f.view_to_clip(c).transform_point(p), moved.transform_point(p));
        prop_assume!(before.w() > 0.1);
        prop_assert!((after.w() - before.w()).abs() < 1e-12);
        let pixels = |a: f64, b: f64, size: f64| (b - a) / before.w() * size / 2.0;
        let size = 1.0 + before.raw().length() / before.w() * 640.0;
        prop_assert!((pixels(before.x(), after.x(), image.0) + dx).abs() < 1e-10 * size);
        prop_assert!((pixels(before.y(), after.y(), image.1) - c.top() * dy).abs() < 1e-10 * size);
    }

    #[test]
    fn a_shift_preserves_the_window_size_and_the_eye(
        p in perspective(),
        x in -2.0..2.0,
        y in -2.0..2.0,
    ) {
        let shifted = p.shifted(x, y).expect("valid");
        let (w, from) = (shifted.window(), p.to_frustum().window());
        prop_assert!(
            (w.width() / from.width() - 1.0).abs() < 1e-12
                && (w.aspect() / p.aspect() - 1.0).abs() < 1e-12
        );
        prop_assert!(
            (w.center().0 - x * from.width()).abs() < 1e-12 * (1.0 + x.abs()) * from.width()
        );
        let volume = ViewVolume::new(shifted.view_to_clip(Convention::OPENGL), Convention::OPENGL);
        let eye = volume.eye().expect("regular").divide().expect("finite");
        prop_assert!((eye - Point::ORIGIN).length() < 1e-9 * p.near());
    }

    #[test]
    fn four_angles_are_the_angles_to_the_edges(
        l in -1.5_f64..1.4,
        width in 0.05..1.0,
        d in -1.5_f64..1.4,
        height in 0.05..1.0,
    ) {
        let (r, u) = (f64::min(l + width, 1.5), f64::min(d + height, 1.5));
        let eye =
            FourAngles { left: l, right: r, down: d, up: u }.frustum(0.1, 10.0).expect("valid");
        let (s, opening) = (eye.slopes(), |a, b| opening_angle_of(a, b, 1.0).expect("valid"));
        prop_assert!((opening(s.left(), s.right()) - (r - l)).abs() < 1e-12);
        prop_assert!((opening(s.bottom(), s.top()) - (u - d)).abs() < 1e-12);
        prop_assert!((opening(0.0, s.right()) - r).abs() < 1e-12);
    }

    /// C85, C4: compares the corners, the planes and the containment test of the view volume.
    #[test]
    fn corners_planes_and_containment_agree(
        f in frustum(),
        o in orthographic(),
        c in convention(),
        x in -1.2..1.2,
        y in -1.2..1.2,
        t in -0.2..1.2,
    ) {
        for map in [f.view_to_clip(c), o.view_to_clip(c)] {
            let volume = ViewVolume::new(map, c);
            let corners = volume.corners().expect("regular");
            for (corner, plane) in [(0, 4), (0, 0), (1, 1), (1, 2), (2, 3), (6, 5), (6, 1), (4, 0)]
            {
                let (corner, plane) = (corners[corner], volume.planes()[plane]);
                let size = plane.raw().length() * corner.raw().length();
                prop_assert!(plane.evaluate(corner).abs() <= 1e-9 * size);
            }
            let depth = c.near_depth() + t * (c.far_depth() - c.near_depth());
            let ndc = Point::<Ndc>::new(x, y, depth);
            let Some(seen) = map
                .inverse()
                .expect("regular")
                .transform_hpoint(HPoint::<Clip>::new(x, y, depth, 1.0))
                .divide()
            else {
                continue;
            };
            let margin = (1.0 - f64::abs(x))
                .abs()
                .min((1.0 - f64::abs(y)).abs())
                .min(f64::abs(t))
                .min(f64::abs(1.0 - t));
            if margin > 1e-6 && map.transform_point(seen).w() > 0.0 && t < 1.0 {
                prop_assert_eq!(volume.contains(seen), c.contains(ndc));
            }
        }
    }

    #[test]
    fn an_inclined_near_plane_does_not_change_the_picture(
        p in perspective(),
        o in orthographic(),
        c in convention(),
        n in direction(),
        q in point(),
    ) {
        for map in [p.view_to_clip(c), o.view_to_clip(c)] {
            let plane = Plane::through(q, Normal::from_raw(n.raw()));
            let Ok(cut) = oblique_near_plane(map, c, plane) else { continue };
            check_cut(map, cut, plane, c)?;
        }
    }
}

/// Points on the plane get the near depth, points in front of it are on the visible side, and no
/// corner is beyond the far plane.
fn check_cut(
    map: Projective<View, Clip>,
    cut: Projective<View, Clip>,
    plane: Plane<View>,
    c: Convention,
) -> Result<(), TestCaseError> {
    let (old, new) = (map.raw().transpose(), cut.raw().transpose());
    prop_assert_eq!((old.x_axis, old.y_axis, old.w_axis), (new.x_axis, new.y_axis, new.w_axis));
    let depth_row = ViewVolume::new(cut, c).planes()[4].raw();
    let (ours, due) = (depth_row / depth_row.length(), plane.raw() / plane.raw().length());
    prop_assert!((ours - due).length() < 1e-9, "the near plane is the requested plane");
    let inwards = (c.far_depth() - c.near_depth()).signum();
    let beyond = ViewVolume::new(map, c).corners().expect("regular").into_iter().all(|corner| {
        let clip = cut.transform_hpoint(corner);
        (clip.z() - c.far_depth() * clip.w()) * inwards <= 1e-9 * clip.raw().length().max(1.0)
    });
    prop_assert!(beyond, "the far plane cuts nothing from the old volume");
    Ok(())
}

#[test]
fn mirrors_behind_the_eye_or_beyond_the_volume_are_rejected() {
    let c = Convention::OPENGL;
    let map = Perspective::new(Fov::Vertical(1.0), 1.0, 1.0, 10.0).expect("valid").view_to_clip(c);
    let at = |z: f64, n: f64| Plane::through(Point::new(0.0, 0.0, z), Normal::new(0.0, 0.0, n));
    assert!(oblique_near_plane(map, c, at(-3.0, -1.0)).is_ok());
    assert!(
        matches!(
            oblique_near_plane(map, c, at(-3.0, 1.0)),
            Err(ProjectionError::OutOfRange { .. })
        ),
        "the eye must be behind the plane"
    );
    assert!(
        matches!(
            oblique_near_plane(map, c, at(-11.0, -1.0)),
            Err(ProjectionError::OutOfRange { .. })
        ),
        "no part of the volume is left"
    );
    assert!(matches!(
        oblique_near_plane(map, c, at(f64::NAN, -1.0)),
        Err(ProjectionError::NotFinite { .. })
    ));
    assert!(matches!(
        oblique_near_plane(map, c, at(-3.0, 0.0)),
        Err(ProjectionError::ZeroVector { .. })
    ));
}

#[test]
fn empty_tiles_are_rejected() {
    let lens = Perspective::new(Fov::Vertical(1.0), 1.0, 1.0, 10.0).expect("valid");
    for size in [(0.0, 1.0), (1.0, -1.0), (f64::NAN, 1.0), (1.0, f64::INFINITY)] {
        assert!(
            lens.view_offset(ViewOffset { full: (8.0, 8.0), corner: (0.0, 0.0), size }).is_err()
        );
        assert!(
            lens.view_offset(ViewOffset { full: size, corner: (0.0, 0.0), size: (1.0, 1.0) })
                .is_err()
        );
        assert!(matches!(
            lens.jittered(Jitter { image: size, offset: (0.0, 0.0) }),
            Err(ProjectionError::NotFinite { .. } | ProjectionError::OutOfRange { .. })
        ));
    }
    assert!(matches!(lens.shifted(f64::NAN, 0.0), Err(ProjectionError::NotFinite { .. })));
    let wide = FourAngles { left: -1.6, right: 0.1, down: -0.1, up: 0.1 };
    assert!(matches!(wide.frustum(1.0, 2.0), Err(ProjectionError::OutOfRange { .. })));
    assert!(matches!(
        Frustum::from_slopes(Window::centered(1.0, 1.0).expect("valid"), 1.0, 1.0),
        Err(ProjectionError::EmptyDepth { .. })
    ));
    assert!(
        Orthographic::from_window(Window::centered(1.0, 1.0).expect("valid"), 1.0, f64::NAN)
            .is_err()
    );
}
