//! Laws of viewports: points mapped to the screen map back, conventions can be converted to each
//! other, and parts add up to the whole.

use glam::{DMat4, DVec4};
use homog::{
    Clip, ClipRange, HPoint, Ndc, PixelConvention, PixelRect, Point, Projective, Screen, View,
};
use proptest::prelude::*;
use viewport::{DepthRange, FitPolicy, Limits, Rectangle, Viewport, WindowToViewport, tiles};

fn rectangle() -> impl Strategy<Value = Rectangle> {
    (-5000.0..5000.0, -5000.0..5000.0, 0.5..9000.0, 0.5..9000.0)
        .prop_map(|(x, y, w, h)| Rectangle::new(x, y, w, h).expect("positive sizes"))
}

fn depth() -> impl Strategy<Value = DepthRange> {
    let fixed =
        [DepthRange::KEEP, DepthRange::ZERO_ONE, DepthRange::ZERO_ONE_FLIPPED, DepthRange::NEGATED];
    prop_oneof![
        prop::sample::select(fixed.to_vec()),
        (0.0..0.5, 0.6..1.0)
            .prop_map(|(n, f)| DepthRange::new([-1.0, 1.0], [n, f]).expect("different")),
    ]
}

fn viewport() -> impl Strategy<Value = Viewport> {
    (rectangle(), prop::sample::select(PixelConvention::ALL.to_vec()), depth()).prop_map(
        |(area, convention, depth)| Viewport::new(area, convention, ClipRange::OPENGL, depth),
    )
}

fn ndc() -> impl Strategy<Value = Point<Ndc>> {
    [-1.5..1.5, -1.5..1.5, -1.0..1.0].prop_map(Point::from)
}

/// Returns an OpenGL frustum with its eye at the origin (GL-1).
fn frustum(near: f64, far: f64) -> Projective<View, Clip> {
    let (c, e) = (-(far + near) / (far - near), -2.0 * far * near / (far - near));
    Projective::from_raw(DMat4::from_cols(
        DVec4::new(1.7, 0.0, 0.0, 0.0),
        DVec4::new(0.0, 2.1, 0.0, 0.0),
        DVec4::new(0.1, -0.2, c, -1.0),
        DVec4::new(0.0, 0.0, e, 0.0),
    ))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    /// C97, WV-3.
    #[test]
    fn points_mapped_to_the_screen_map_back(viewport in viewport(), p in ndc()) {
        let there = viewport.ndc_to_screen().transform_point(p);
        let back = viewport.screen_to_ndc().transform_point(there);
        prop_assert!((back - p).length() < 1e-10, "{p:?} maps back to {back:?}");
    }

    #[test]
    fn up_stays_up_and_left_stays_left(viewport in viewport()) {
        let map = viewport.ndc_to_screen();
        let [low, high] = [-1.0, 1.0].map(|c| map.transform_point(Point::new(c, c, 0.0)));
        prop_assert!(low.x() < high.x());
        let upwards = high.y() > low.y();
        prop_assert_eq!(upwards, viewport.convention().y == homog::YAxis::Up);
    }

    /// VP-4: converting the pixels of a whole-image viewport to another convention gives the same
    /// result as the viewport in that convention.
    #[test]
    fn conventions_convert_into_each_other(
        size in (1..4000_u32, 1..4000_u32),
        from in prop::sample::select(PixelConvention::ALL.to_vec()),
        to in prop::sample::select(PixelConvention::ALL.to_vec()),
        p in ndc(),
    ) {
        let image = Viewport::chapter(size.0, size.1).expect("has pixels");
        let convert = from.convert_to(to, size.1.into()).expect("has rows");
        let converted = convert.transform_point(image.with_convention(from).ndc_to_screen().transform_point(p));
        let direct = image.with_convention(to).ndc_to_screen().transform_point(p);
        prop_assert!((converted - direct).length() < 1e-11 * 4000.0);
        let back = to.convert_to(from, size.1.into()).expect("has rows");
        let q = Point::<Screen>::new(17.0, 3.25, 0.5);
        prop_assert!((back.transform_point(convert.transform_point(q)) - q).length() < 1e-12 * 4000.0);
    }

    /// C53, C95, C96; also for points outside the window.
    #[test]
    fn both_methods_of_window_to_viewport_agree(
        limits in prop::collection::vec(-100.0..100.0, 8),
        p in [-300.0..300.0, -300.0..300.0],
    ) {
        let take = |i: usize| Limits { x: [limits[i], limits[i + 1]], y: [limits[i + 2], limits[i + 3]] };
        let (window, viewport) = (take(0), take(4));
        let wide = (window.x[1] - window.x[0]).abs().min((window.y[1] - window.y[0]).abs());
        prop_assume!(wide > 0.1);
        let map = WindowToViewport::new(window, viewport).expect("not empty");
        let (ratio, chain) = (map.map_by_ratio(p), map.map_by_chain(p));
        for i in 0..2 {
            prop_assert!((ratio[i] - chain[i]).abs() < 1e-9, "{ratio:?} is not {chain:?}");
            let off = (map.inverse().map_by_ratio(ratio)[i] - p[i]).abs();
            prop_assert!(off < 1e-6 * map.scale_factors()[i].abs().recip().max(1.0));
        }
    }

    /// Each pixel is in exactly one tile, and no tile is larger than requested.
    #[test]
    fn tiles_cover_the_image(image in [1..70_u32, 1..70_u32], largest in [1..40_u32, 1..40_u32]) {
        let mut times = vec![0; (image[0] * image[1]) as usize];
        for PixelRect { x, y, width, height } in tiles(image, largest).expect("not empty") {
            prop_assert!((1..=largest[0]).contains(&width) && (1..=largest[1]).contains(&height));
            for row in y..y + height {
                for column in x..x + width {
                    times[(row * image[0] + column) as usize] += 1;
                }
            }
        }
        prop_assert!(times.iter().all(|&times| times == 1));
    }

    /// The pixel position of a point in a tile is its position in the whole image minus the tile's
    /// corner. The pick matrix of the tile, followed by a viewport of the tile's size, gives the
    /// same position.
    #[test]
    fn a_tile_shows_its_part_of_the_whole(
        p in ndc(),
        convention in prop::sample::select(PixelConvention::ALL.to_vec()),
        tile in (0..600_u32, 0..400_u32, 1..200_u32, 1..200_u32),
    ) {
        let tile = PixelRect { x: tile.0, y: tile.1, width: tile.2, height: tile.3 };
        let whole = Viewport::chapter(800, 600).expect("has pixels").with_convention(convention);
        let in_whole = whole.ndc_to_screen().transform_point(p);
        let corner = Point::<Screen>::new(tile.x.into(), tile.y.into(), 0.0) - Point::ORIGIN;
        let in_tile = whole.for_tile(tile).ndc_to_screen().transform_point(p);
        prop_assert!((in_tile + corner - in_whole).length() < 1e-10);

        let pick = whole.pick_matrix(whole.tile_area(tile)).expect("not too small");
        let picked = pick.transform_hpoint(HPoint::from_raw(p.raw().extend(1.0))).divide().expect("w is 1");
        let small = Viewport::chapter(tile.width, tile.height).expect("has pixels").with_convention(convention);
        let by_pick = small.ndc_to_screen().transform_point(picked);
        prop_assert!((by_pick - in_tile).length() < 1e-9, "{by_pick:?} is not {in_tile:?}");
    }

    /// C1, C26, UN-1, UN-2: an unprojected point projects back, and the ray of a pixel runs from
    /// the eye through the pixel.
    #[test]
    fn rays_run_from_the_eye_through_their_pixel(
        viewport in viewport(),
        p in ndc(),
        near in 0.1..10.0,
        reach in 1.5..1000.0,
    ) {
        let view_to_clip = frustum(near, near * reach);
        let back = viewport.unprojector(view_to_clip.inverse().expect("regular"));
        let screen = viewport.ndc_to_screen().transform_point(p);
        let point = back.unproject_point(screen).expect("finite");
        let again = viewport.source_to_screen(view_to_clip).transform_point(point).divide().expect("in front");
        prop_assert!((again - screen).length() < 1e-8 * 1e4, "{again:?} is not {screen:?}");

        let pick = back.pick_ray([screen.x(), screen.y()]).expect("a ray exists");
        prop_assert!((pick.ray.origin - Point::ORIGIN).length() < 1e-9 * near);
        prop_assert!((pick.near.z() + near).abs() < 1e-9 * near);
        let along = (point - Point::ORIGIN).normalized().expect("not the eye");
        prop_assert!((along - pick.ray.direction).length() < 1e-9);
    }

    #[test]
    fn contained_pictures_fit_and_covering_pictures_leave_no_margin(
        picture in [0.1..10.0, 0.1..10.0],
        place in rectangle(),
        align in [0.0..1.0, 0.0..1.0],
    ) {
        for fit in [FitPolicy::Contain, FitPolicy::Cover] {
            let drawn = fit.place_picture(picture, place, align).expect("positive sizes");
            prop_assert!((drawn.aspect() - picture[0] / picture[1]).abs() < 1e-10 * drawn.aspect());
            let spare = [place.width() - drawn.width(), place.height() - drawn.height()];
            let [mut tight, mut loose] = spare;
            if tight.abs() > loose.abs() {
                core::mem::swap(&mut tight, &mut loose);
            }
            prop_assert!(tight.abs() < 1e-9);
            let spared = if fit == FitPolicy::Contain { loose } else { -loose };
            prop_assert!(spared > -1e-9, "{fit:?} leaves {loose}");
            let window = fit.fit_window(picture, place).expect("positive sizes");
            prop_assert!((window[0] / window[1] - place.aspect()).abs() < 1e-10 * place.aspect());
        }
    }
}
