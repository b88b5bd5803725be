//! Benchmarks that compute outcodes for arrays of points, with and without projecting them.

use crate::measure::Variant;
use crate::scene::{Blocks, model_to_clip, position};
use clip::{Outcode, Volume};
use glam::{DMat4, DVec4, Mat4, Vec3, Vec4};
use homog::{Clip, HPoint};
use std::hint::black_box;

pub fn cached_blocks() -> Vec<Variant> {
    outcode_variants(Blocks::Cached)
}

pub fn uncached_blocks() -> Vec<Variant> {
    outcode_variants(Blocks::Uncached)
}

pub fn project_cached() -> Vec<Variant> {
    projecting_variants(Blocks::Cached)
}

pub fn project_uncached() -> Vec<Variant> {
    projecting_variants(Blocks::Uncached)
}

/// Computes an outcode without the library, by six comparisons with w.
fn outcode_by_hand(p: DVec4) -> u16 {
    u16::from(p.x < -p.w)
        | u16::from(p.x > p.w) << 1
        | u16::from(p.y < -p.w) << 2
        | u16::from(p.y > p.w) << 3
        | u16::from(p.z > p.w) << 4
        | u16::from(p.z < -p.w) << 5
}

fn outcode_variants(blocks: Blocks) -> Vec<Variant> {
    let (map, count) = (model_to_clip(), blocks.total_points());
    let points: Vec<HPoint<Clip>> =
        (0..count).map(|i| map.transform_point(position(i).into())).collect();
    let raw: Vec<DVec4> = points.iter().map(|point| point.raw()).collect();
    let volume = Volume::CHAPTER;
    let (mut codes, mut turn) = (vec![0_u16; count], 0);
    let plain = Variant::new("plain loop of six comparisons of DVec4", move || {
        turn += 1;
        blocks.for_each_block(turn, |range| {
            for (point, code) in black_box(&raw[range.clone()]).iter().zip(&mut codes[range]) {
                *code = outcode_by_hand(*point);
            }
            black_box(&mut codes);
        });
    });
    let (mut codes, mut turn, one_by_one) = (vec![Outcode::INSIDE; count], 0, points.clone());
    let single = Variant::new("Volume::outcode", move || {
        turn += 1;
        blocks.for_each_block(turn, |range| {
            let points = black_box(&one_by_one[range.clone()]);
            for (point, code) in points.iter().zip(&mut codes[range]) {
                *code = volume.outcode(*point);
            }
            black_box(&mut codes);
        });
    });
    let (mut codes, mut turn) = (vec![Outcode::INSIDE; count], 0);
    let bulk = Variant::new("Volume::outcodes, with the extent", move || {
        turn += 1;
        blocks.for_each_block(turn, |range| {
            black_box(
                volume.compute_outcodes(black_box(&points[range.clone()]), &mut codes[range]),
            );
            black_box(&mut codes);
        });
    });
    vec![plain, single, bulk]
}

/// Points with their images and outcodes.
struct Arrays<Q, C> {
    positions: Vec<[f32; 3]>,
    images: Vec<Q>,
    codes: Vec<C>,
}

impl<Q: Copy + 'static, C: Copy + 'static> Arrays<Q, C> {
    fn new(count: usize, image: Q, code: C) -> Self {
        let positions = (0..count).map(|i| position(i).map(|c| c as f32)).collect();
        Self { positions, images: vec![image; count], codes: vec![code; count] }
    }

    /// Returns a variant that projects each block.
    fn outcode_variant(
        mut self,
        name: &'static str,
        blocks: Blocks,
        project: impl Fn(&[[f32; 3]], &mut [Q], &mut [C]) + 'static,
    ) -> Variant {
        let mut turn = 0;
        Variant::new(name, move || {
            turn += 1;
            blocks.for_each_block(turn, |range| {
                let positions = black_box(&self.positions[range.clone()]);
                project(positions, &mut self.images[range.clone()], &mut self.codes[range]);
                black_box((&mut self.images, &mut self.codes));
            });
        })
    }
}

fn projecting_variants(blocks: Blocks) -> Vec<Variant> {
    let (map, count, volume) = (model_to_clip(), blocks.total_points(), Volume::CHAPTER);
    let wide: DMat4 = map.raw();
    let narrow: Mat4 = wide.as_mat4();
    let nowhere = HPoint::<Clip>::new(0.0, 0.0, 0.0, 0.0);
    vec![
        Arrays::new(count, DVec4::ZERO, ()).outcode_variant(
            "plain loop of DMat4 * DVec4, no outcodes",
            blocks,
            move |positions, images, _| {
                for (position, image) in positions.iter().zip(images) {
                    *image = wide * Vec3::from(*position).as_dvec3().extend(1.0);
                }
            },
        ),
        Arrays::new(count, DVec4::ZERO, 0_u16).outcode_variant(
            "the same with six comparisons",
            blocks,
            move |positions, images, codes| {
                for ((position, image), code) in positions.iter().zip(images).zip(codes) {
                    *image = wide * Vec3::from(*position).as_dvec3().extend(1.0);
                    *code = outcode_by_hand(*image);
                }
            },
        ),
        Arrays::new(count, nowhere, Outcode::INSIDE).outcode_variant(
            "Volume::project",
            blocks,
            move |positions, images, codes| {
                black_box(volume.project_positions(map, positions, images, codes));
            },
        ),
        Arrays::new(count, Vec4::ZERO, ()).outcode_variant(
            "plain loop of Mat4 * Vec4, no outcodes",
            blocks,
            move |positions, images, _| {
                for (position, image) in positions.iter().zip(images) {
                    *image = narrow * Vec3::from(*position).extend(1.0);
                }
            },
        ),
        Arrays::new(count, [0.0_f32; 4], Outcode::INSIDE).outcode_variant(
            "Volume::project_f32",
            blocks,
            move |positions, images, codes| {
                black_box(volume.project_positions_f32(map, positions, images, codes));
            },
        ),
    ]
}
