//! Benchmarks that transform arrays of points.

use crate::measure::Variant;
use crate::scene::{Blocks, model_points, model_to_clip, model_to_world};
use glam::{DVec3, DVec4, Vec3, Vec4};
use homog::{HPoint, Point};
use std::hint::black_box;

pub fn to_clip_cached() -> Vec<Variant> {
    to_clip_variants(Blocks::Cached)
}

pub fn to_clip_uncached() -> Vec<Variant> {
    to_clip_variants(Blocks::Uncached)
}

pub fn to_world_cached() -> Vec<Variant> {
    to_world_variants(Blocks::Cached)
}

pub fn to_world_uncached() -> Vec<Variant> {
    to_world_variants(Blocks::Uncached)
}

/// Returns a variant that transforms each block of `points` into a block of `images`.
fn mapping_variant<P: 'static, Q: 'static>(
    name: &'static str,
    blocks: Blocks,
    points: Vec<P>,
    mut images: Vec<Q>,
    transform: impl Fn(&[P], &mut [Q]) + 'static,
) -> Variant {
    let mut turn = 0;
    Variant::new(name, move || {
        turn += 1;
        blocks.for_each_block(turn, |range| {
            transform(black_box(&points[range.clone()]), &mut images[range]);
            black_box(&mut images);
        });
    })
}

fn to_clip_variants(blocks: Blocks) -> Vec<Variant> {
    let count = blocks.total_points();
    let (map, points) = (model_to_clip(), model_points(count));
    let matrix = map.raw();
    let narrow = matrix.as_mat4();
    let raw: Vec<DVec3> = points.iter().map(|point| point.raw()).collect();
    let small: Vec<Vec3> = raw.iter().map(|point| point.as_vec3()).collect();
    let nowhere = HPoint::new(0.0, 0.0, 0.0, 0.0);
    vec![
        mapping_variant(
            "plain loop of DMat4 * DVec4",
            blocks,
            raw,
            vec![DVec4::ZERO; count],
            move |p, q| {
                for (point, image) in p.iter().zip(q) {
                    *image = matrix * point.extend(1.0);
                }
            },
        ),
        mapping_variant(
            "plain loop of Mat4 * Vec4",
            blocks,
            small,
            vec![Vec4::ZERO; count],
            move |p, q| {
                for (point, image) in p.iter().zip(q) {
                    *image = narrow * point.extend(1.0);
                }
            },
        ),
        mapping_variant(
            "Projective::point",
            blocks,
            points.clone(),
            vec![nowhere; count],
            move |p, q| {
                for (point, image) in p.iter().zip(q) {
                    *image = map.transform_point(*point);
                }
            },
        ),
        mapping_variant(
            "Projective::points_into",
            blocks,
            points,
            vec![nowhere; count],
            move |p, q| {
                map.transform_points_into(p, q);
            },
        ),
    ]
}

fn to_world_variants(blocks: Blocks) -> Vec<Variant> {
    let count = blocks.total_points();
    let (map, points) = (model_to_world(), model_points(count));
    let matrix = map.raw();
    let narrow = matrix.as_mat4();
    let raw: Vec<DVec3> = points.iter().map(|point| point.raw()).collect();
    let small: Vec<Vec3> = raw.iter().map(|point| point.as_vec3()).collect();
    let places = vec![Point::ORIGIN; count];
    vec![
        mapping_variant(
            "plain loop of DMat4::transform_point3",
            blocks,
            raw.clone(),
            raw,
            move |p, q| {
                for (point, image) in p.iter().zip(q) {
                    *image = matrix.transform_point3(*point);
                }
            },
        ),
        mapping_variant(
            "plain loop of Mat4::transform_point3",
            blocks,
            small.clone(),
            small,
            move |p, q| {
                for (point, image) in p.iter().zip(q) {
                    *image = narrow.transform_point3(*point);
                }
            },
        ),
        mapping_variant("Affine::point", blocks, points.clone(), places.clone(), move |p, q| {
            for (point, image) in p.iter().zip(q) {
                *image = map.transform_point(*point);
            }
        }),
        mapping_variant("Affine::points_into", blocks, points, places, move |p, q| {
            map.transform_points_into(p, q);
        }),
    ]
}
