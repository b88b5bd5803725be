//! Registry entries for the chain, its inverse and hidden lines (PL-1 to PL-3, UN-1, UN-2, HL-1).

use super::camera::camera;
use super::inputs::{Answer, Inputs, give};
use super::normalization::volume;
use super::screen::pixels;
use super::{Entry, Extras};
use camera::{ViewProjection, ViewTransform};
use clip::{Volume, clip_segment};
use homog::{Clip, HPoint, Normal, Plane, Point, Projective, View, World};
use projection::chapter;
use std::error::Error;
use viewport::{Unprojector, Viewport};

const CHAIN: &str = "n_x n_y l r b t n f \\mathbf{e} \\mathbf{g} \\mathbf{t}";
const NO_CROSSING: &str = "a and b must be on different sides of the plane";
const SEGMENT: &str = "\\mathbf{n} \\mathbf{p} \\mathbf{a} \\mathbf{b}";

pub const ENTRIES: &[Entry] = &[
    Entry::new("PL-1", CHAIN, |v| give(world_to_screen(v, perspective(v)?)?))
        .with_extras(chain_extras),
    Entry::new("PL-2", "x y w", |v| {
        let [x, y, w] = v.numbers()?;
        let place = HPoint::<World>::new(x, y, 0.0, w).divide().ok_or("w = 0")?;
        give([place.x(), place.y()])
    }),
    Entry::new("PL-3", "n_x n_y", |v| {
        let [n_x, n_y] = v.numbers()?;
        give(chapter::window_from_fov(1.0, n_x, n_y, -1.0)?.aspect())
    }),
    Entry::new(
        "UN-1",
        "n_x n_y l r b t n f \\mathbf{e} \\mathbf{g} \\mathbf{t} x_s y_s z_s",
        |v| {
            let [x, y, z] = v.these("x_s y_s z_s")?;
            give(unprojector(v)?.screen_to_source().transform_hpoint(HPoint::new(x, y, z, 1.0)))
        },
    )
    .with_extras(chain_extras),
    Entry::new("UN-2", "n_x n_y l r b t n f \\mathbf{e} \\mathbf{g} \\mathbf{t} x_s y_s", |v| {
        let ray = unprojector(v)?.pick_ray(v.these("x_s y_s")?).ok_or("no ray")?;
        give(ray.ray.direction.normalized().ok_or("no direction")?)
    })
    .with_extras(ray_extras),
    Entry::new("HL-1.t", SEGMENT, crossing),
];

/// Returns `M_per`, whose w is negative in front of the eye, as in the chapter.
fn perspective(v: &Inputs<'_>) -> Result<Projective<View, Clip>, Box<dyn Error>> {
    volume(v, chapter::m_per)
}

fn parallel(v: &Inputs<'_>) -> Result<Projective<View, Clip>, Box<dyn Error>> {
    Ok(volume(v, chapter::m_orth)?.into())
}

fn screen(v: &Inputs<'_>) -> Result<Viewport, Box<dyn Error>> {
    let [n_x, n_y] = v.these("n_x n_y")?;
    Ok(Viewport::chapter(pixels(n_x)?, pixels(n_y)?)?)
}

fn world_to_screen(
    v: &Inputs<'_>,
    view_to_clip: Projective<View, Clip>,
) -> Result<Projective<World, homog::Screen>, Box<dyn Error>> {
    let view = ViewProjection { camera: camera(v)?, view_to_clip };
    Ok(ViewTransform::new(&view, screen(v)?.ndc_to_screen()).world_to_screen())
}

fn chain_extras(v: &Inputs<'_>) -> Extras {
    let p = chapter::p(v.number("n")?, v.number("f")?)?;
    Ok(vec![
        ("M_{vp}", screen(v)?.ndc_to_screen().into()),
        ("M_{per}", perspective(v)?.into()),
        ("M_{orth}", parallel(v)?.into()),
        ("P", p.into()),
        ("M_{cam}", camera(v)?.world_to_view().into()),
        ("M", world_to_screen(v, perspective(v)?)?.into()),
    ])
}

fn unprojector(v: &Inputs<'_>) -> Result<Unprojector<World>, Box<dyn Error>> {
    let view = ViewProjection { camera: camera(v)?, view_to_clip: perspective(v)? };
    let clip_to_world = view.world_to_clip().inverse().ok_or("the chain has no inverse")?;
    Ok(screen(v)?.unprojector(clip_to_world))
}

/// Returns the unprojected points on the near and far planes, at depths 1 and −1.
fn ray_extras(v: &Inputs<'_>) -> Extras {
    let [x, y] = v.these("x_s y_s")?;
    let unprojector = unprojector(v)?;
    let place = |depth| unprojector.unproject_point(Point::new(x, y, depth)).ok_or("no point");
    let (near, far) = (place(1.0)?, place(-1.0)?);
    let mut extras = chain_extras(v)?;
    extras.extend([("\\mathbf{p}_n", near.into()), ("\\mathbf{p}_f", far.into())]);
    Ok(extras)
}

fn plane(v: &Inputs<'_>) -> Result<Plane<World>, Box<dyn Error>> {
    let [x, y, z] = v.vector("n")?;
    Ok(Plane::through(v.vector("p")?.into(), Normal::new(x, y, z)))
}

/// Clips the segment by the plane; the other planes of the volume are too far away to cut it.
fn crossing(v: &Inputs<'_>) -> Answer {
    let end = |letter| v.vector(letter).map(|[x, y, z]| HPoint::<Clip>::new(x, y, z, 1.0));
    let shrink = |p: HPoint<Clip>| HPoint::new(p.x(), p.y(), p.z(), 1024.0 * p.w());
    let raw = plane(v)?.raw();
    let plane = Plane::from_raw(glam::DVec4::new(raw.x, raw.y, raw.z, raw.w / 1024.0));
    let volume = Volume::OPENGL.with_plane(plane)?;
    let cut = clip_segment(shrink(end("a")?), shrink(end("b")?), &volume).ok_or(NO_CROSSING)?;
    match (cut.t0 > 0.0, cut.t1 < 1.0) {
        (true, false) => give(cut.t0),
        (false, true) => give(cut.t1),
        _ => Err(NO_CROSSING.into()),
    }
}
