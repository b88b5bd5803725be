//! Functions for rectangles, viewports, paper and picking.

use crate::finite::Finite;
use crate::random::Random;
use crate::subject::Subject;
use homog::{Clip, ClipRange, PixelConvention, PixelRect, View};
use viewport::{
    DepthRange, DrawingScale, FitPolicy, Limits, Paper, PickRay, PointGrid, Rectangle, Resolution,
    Viewport, WindowToViewport, tiles,
};

pub const SUBJECTS: &[Subject] = &[
    ("viewport::Rectangle::new", |r| Some(any_rectangle(r)?.finite())),
    ("viewport::Rectangle::of_size", |r| {
        Some(Rectangle::from_size(r.size(), r.size()).ok()?.finite())
    }),
    ("viewport::Rectangle::shrunk", |r| Some(any_rectangle(r)?.shrink(r.number()).ok()?.finite())),
    ("viewport::Rectangle::inset", |r| {
        let [x, y] = [r.fraction(), r.fraction()];
        Some(any_rectangle(r)?.inset_rectangle(r.fraction(), [x, y]).ok()?.finite())
    }),
    ("viewport::Rectangle::snapped", |r| Some(any_rectangle(r)?.snap_to_pixels().ok()?.finite())),
    ("viewport::Rectangle::grid", |r| {
        let mut cells = any_rectangle(r)?.split_grid(r.count(), r.count(), r.number()).ok()?;
        Some(cells.by_ref().take(4).all(|cell| cell.finite()))
    }),
    ("viewport::Viewport::new", |r| {
        let viewport = any_viewport(r)?;
        Some((viewport.ndc_to_screen(), viewport.screen_to_ndc()).finite())
    }),
    ("viewport::Viewport::image_for", |r| {
        let viewport = Viewport::image_for(r.count(), r.count(), any_range(r)?).ok()?;
        Some((viewport.ndc_to_screen(), viewport.screen_to_ndc()).finite())
    }),
    ("viewport::Viewport::chapter", |r| {
        let viewport = Viewport::chapter(r.count(), r.count()).ok()?;
        Some((viewport.ndc_to_screen(), viewport.screen_to_ndc()).finite())
    }),
    ("viewport::Viewport::pick_matrix", |r| {
        Some(any_viewport(r)?.pick_matrix(any_rectangle(r)?).ok()?.finite())
    }),
    ("viewport::Viewport::for_tile", |r| {
        let tile = PixelRect { x: r.count(), y: r.count(), width: r.count(), height: r.count() };
        let viewport = any_viewport(r)?;
        let (moved, area) = (viewport.for_tile(tile), viewport.tile_area(tile));
        Some((moved.ndc_to_screen(), [area.x(), area.y(), area.width(), area.height()]).finite())
    }),
    ("viewport::Unprojector::point", |r| {
        let unprojector = any_viewport(r)?.unprojector::<View>(r.projective::<Clip, View>());
        Some(unprojector.unproject_point(r.point())?.finite())
    }),
    ("viewport::Unprojector::ray", |r| {
        let unprojector = any_viewport(r)?.unprojector::<View>(r.projective::<Clip, View>());
        let PickRay { ray, near, far, .. } = unprojector.pick_ray(r.numbers())?;
        Some((ray.origin, ray.direction, near, far).finite())
    }),
    ("viewport::tiles", |r| {
        let [image, largest] = [[r.count(), r.count()], [r.count(), r.count()]];
        let mut parts = tiles(image, largest).ok()?;
        let fits = |tile: PixelRect| {
            tile.width > 0
                && tile.height > 0
                && tile.x.checked_add(tile.width).is_some_and(|end| end <= image[0])
                && tile.y.checked_add(tile.height).is_some_and(|end| end <= image[1])
        };
        Some(parts.by_ref().take(16).all(fits))
    }),
    ("viewport::DepthRange::new", |r| {
        let range = DepthRange::new(r.numbers(), r.numbers()).ok()?;
        Some([range.scale(), range.offset()].finite())
    }),
    ("viewport::PixelConvention::to", |r| {
        let [from, to] = [r.pick(&PixelConvention::ALL), r.pick(&PixelConvention::ALL)];
        Some(from.convert_to(to, r.size()).ok()?.finite())
    }),
    ("viewport::Fit::place", |r| {
        let alignment = [r.fraction(), r.fraction()];
        Some(
            fit(r).place_picture([r.size(), r.size()], any_rectangle(r)?, alignment).ok()?.finite(),
        )
    }),
    ("viewport::Fit::window", |r| {
        Some(fit(r).fit_window([r.size(), r.size()], any_rectangle(r)?).ok()?.finite())
    }),
    ("viewport::Grid::new", |r| {
        let [rows, columns] = [r.count() as usize, r.count() as usize];
        let grid = PointGrid::new(rows, columns).ok()?;
        let ends = [grid.xz(0, 0), grid.xz(rows - 1, columns - 1), grid.points().nth(1)];
        Some(ends.finite() && grid.xz(rows, 0).is_none())
    }),
    ("viewport::WindowToViewport::new", |r| {
        let map = WindowToViewport::new(limits(r), limits(r)).ok()?;
        let [to_origin, scale, to_place] = map.factor_chain();
        let chain = (to_origin, scale, to_place);
        Some((map.scale_factors(), map.homography(), map.inverse().homography(), chain).finite())
    }),
    ("viewport::Resolution::rectangle", |r| {
        let resolution = Resolution::dots_per_inch(r.size()).ok()?;
        Some(resolution.to_pixel_rectangle(any_rectangle(r)?).ok()?.finite())
    }),
    ("viewport::Paper::pixels", |r| {
        let paper = Paper::new(r.size(), r.size()).ok()?;
        let resolution = Resolution::dots_per_inch(r.size()).ok()?;
        paper.pixel_size(resolution)?;
        Some(paper.rotated().to_rectangle().finite())
    }),
    ("viewport::DrawingScale::new", |r| {
        Some(DrawingScale::new(r.count(), r.count()).ok()?.ratio().finite())
    }),
    ("viewport::DrawingScale::largest_standard", |r| {
        let (thing, room) = ([r.size(), r.size()], [r.size(), r.size()]);
        Some(DrawingScale::largest_standard(thing, room)?.ratio().finite())
    }),
];

impl Finite for Rectangle {
    fn finite(&self) -> bool {
        let far = [self.x() + self.width(), self.y() + self.height()];
        ([self.x(), self.y(), self.width(), self.height()], far, self.center()).finite()
    }
}

fn any_rectangle(r: &mut Random) -> Option<Rectangle> {
    Rectangle::new(r.number(), r.number(), r.size(), r.size()).ok()
}

fn any_range(r: &mut Random) -> Option<ClipRange> {
    let [near, far] = r.numbers();
    let fixed = [ClipRange::CHAPTER, ClipRange::OPENGL, ClipRange::ZERO_ONE, ClipRange::VULKAN];
    let range = r.pick(&fixed);
    if r.coin() { Some(range) } else { range.with_depths(near, far).ok() }
}

fn any_viewport(r: &mut Random) -> Option<Viewport> {
    let fixed =
        [DepthRange::KEEP, DepthRange::ZERO_ONE, DepthRange::ZERO_ONE_FLIPPED, DepthRange::NEGATED];
    let depth =
        if r.coin() { r.pick(&fixed) } else { DepthRange::new(r.numbers(), r.numbers()).ok()? };
    Some(Viewport::new(any_rectangle(r)?, r.pick(&PixelConvention::ALL), any_range(r)?, depth))
}

fn fit(r: &mut Random) -> FitPolicy {
    r.pick(&[
        FitPolicy::Stretch,
        FitPolicy::Contain,
        FitPolicy::Cover,
        FitPolicy::FixedWidth,
        FitPolicy::FixedHeight,
    ])
}

fn limits(r: &mut Random) -> Limits {
    Limits { x: r.numbers(), y: r.numbers() }
}
