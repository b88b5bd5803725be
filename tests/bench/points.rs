//! Transforming arrays of points.

use crate::measure::Way;
use crate::scene::{Blocks, model_points, model_to_clip, model_to_world};
use glam::{DVec3, DVec4, Vec3, Vec4};
use homog::{HPoint, Point};
use std::hint::black_box;

pub fn to_clip_cached() -> Vec<Way> {
    to_clip(Blocks::Cached)
}

pub fn to_clip_uncached() -> Vec<Way> {
    to_clip(Blocks::Uncached)
}

pub fn to_world_cached() -> Vec<Way> {
    to_world(Blocks::Cached)
}

pub fn to_world_uncached() -> Vec<Way> {
    to_world(Blocks::Uncached)
}

/// A way that turns each block of `points` into a block of `images`.
fn way<P: 'static, Q: 'static>(
    name: &'static str,
    blocks: Blocks,
    points: Vec<P>,
    mut images: Vec<Q>,
    transform: impl Fn(&[P], &mut [Q]) + 'static,
) -> Way {
    let mut turn = 0;
    Way::new(name, move || {
        turn += 1;
        blocks.each(turn, |range| {
            transform(black_box(&points[range.clone()]), &mut images[range]);
            black_box(&mut images);
        });
    })
}

fn to_clip(blocks: Blocks) -> Vec<Way> {
    let count = blocks.total();
    let (map, points) = (model_to_clip(), model_points(count));
    let matrix = map.raw();
    let narrow = matrix.as_mat4();
    let raw: Vec<DVec3> = points.iter().map(|point| point.raw()).collect();
    let small: Vec<Vec3> = raw.iter().map(|point| point.as_vec3()).collect();
    let nowhere = HPoint::new(0.0, 0.0, 0.0, 0.0);
    vec![
        way("plain loop of DMat4 * DVec4", blocks, raw, vec![DVec4::ZERO; count], move |p, q| {
            for (point, image) in p.iter().zip(q) {
                *image = matrix * point.extend(1.0);
            }
        }),
        way("plain loop of Mat4 * Vec4", blocks, small, vec![Vec4::ZERO; count], move |p, q| {
            for (point, image) in p.iter().zip(q) {
                *image = narrow * point.extend(1.0);
            }
        }),
        way("Projective::point", blocks, points.clone(), vec![nowhere; count], move |p, q| {
            for (point, image) in p.iter().zip(q) {
                *image = map.point(*point);
            }
        }),
        way("Projective::points_into", blocks, points, vec![nowhere; count], move |p, q| {
            map.points_into(p, q);
        }),
    ]
}

fn to_world(blocks: Blocks) -> Vec<Way> {
    let count = blocks.total();
    let (map, points) = (model_to_world(), model_points(count));
    let matrix = map.raw();
    let narrow = matrix.as_mat4();
    let raw: Vec<DVec3> = points.iter().map(|point| point.raw()).collect();
    let small: Vec<Vec3> = raw.iter().map(|point| point.as_vec3()).collect();
    let places = vec![Point::ORIGIN; count];
    vec![
        way("plain loop of DMat4::transform_point3", blocks, raw.clone(), raw, move |p, q| {
            for (point, image) in p.iter().zip(q) {
                *image = matrix.transform_point3(*point);
            }
        }),
        way("plain loop of Mat4::transform_point3", blocks, small.clone(), small, move |p, q| {
            for (point, image) in p.iter().zip(q) {
                *image = narrow.transform_point3(*point);
            }
        }),
        way("Affine::point", blocks, points.clone(), places.clone(), move |p, q| {
            for (point, image) in p.iter().zip(q) {
                *image = map.point(*point);
            }
        }),
        way("Affine::points_into", blocks, points, places, move |p, q| map.points_into(p, q)),
    ]
}
