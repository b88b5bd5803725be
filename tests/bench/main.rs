//! The speed of bulk operations, compared with plain loops over glam's matrices.
//!
//! `cargo xtask bench [NAME…]` runs the optimized benchmarks; arguments select benchmarks whose
//! names contain them. Every benchmark does one job in several variants, which take turns. The
//! output is the time of each variant as a multiple of the first variant's time in the same turn.
//! This ratio is the median over all turns, with the range that contains 80% of them. A busy or
//! slow machine slows all variants equally. No result counts as a failure.

#![allow(clippy::print_stdout, reason = "a program writes to standard output")]
#![allow(unreachable_pub, reason = "modules of a program cannot be used elsewhere")]

mod measure;
mod outcodes;
mod points;
mod scene;
mod triangles;

use measure::Variant;
use std::process::ExitCode;

/// A job and the variants that do it. The first variant is the baseline.
struct Benchmark {
    name: &'static str,
    about: &'static str,
    variants: fn() -> Vec<Variant>,
}

const BENCHMARKS: &[Benchmark] = &[
    Benchmark {
        name: "points/cached",
        about: "100,000 points to clip space: the same thousand, a hundred times",
        variants: points::to_clip_cached,
    },
    Benchmark {
        name: "points/uncached",
        about: "100,000 points to clip space, each from main memory",
        variants: points::to_clip_uncached,
    },
    Benchmark {
        name: "affine/cached",
        about: "100,000 points to world space: the same thousand, a hundred times",
        variants: points::to_world_cached,
    },
    Benchmark {
        name: "affine/uncached",
        about: "100,000 points to world space, each from main memory",
        variants: points::to_world_uncached,
    },
    Benchmark {
        name: "outcodes/cached",
        about: "the outcodes of 100,000 points: the same thousand, a hundred times",
        variants: outcodes::cached_blocks,
    },
    Benchmark {
        name: "outcodes/uncached",
        about: "the outcodes of 100,000 points, each from main memory",
        variants: outcodes::uncached_blocks,
    },
    Benchmark {
        name: "project/cached",
        about: "100,000 f32 positions to clip space with outcodes: a thousand, a hundred times",
        variants: outcodes::project_cached,
    },
    Benchmark {
        name: "project/uncached",
        about: "100,000 f32 positions to clip space with outcodes, each from main memory",
        variants: outcodes::project_uncached,
    },
    Benchmark {
        name: "triangles/visible",
        about: "100,000 triangles of a floor, 90% of them fully visible",
        variants: triangles::mostly_visible,
    },
    Benchmark {
        name: "triangles/cut",
        about: "100,000 triangles, all of them cut by at least one plane",
        variants: triangles::all_clipped,
    },
];

fn main() -> ExitCode {
    let names: Vec<String> =
        std::env::args().skip(1).filter(|argument| !argument.starts_with('-')).collect();
    let chosen = |benchmark: &&Benchmark| {
        names.is_empty() || names.iter().any(|part| benchmark.name.contains(part.as_str()))
    };
    let mut count = 0;
    for Benchmark { name, about, variants: ways } in BENCHMARKS.iter().filter(chosen) {
        println!("{name}: {about}");
        for line in measure::compare_variants(ways()) {
            println!("{line}");
        }
        count += 1;
    }
    if count > 0 {
        return ExitCode::SUCCESS;
    }
    let all: Vec<&str> = BENCHMARKS.iter().map(|benchmark| benchmark.name).collect();
    println!("no such benchmark; the benchmarks are {}", all.join(", "));
    ExitCode::from(2)
}
