//! Tests for drawing sheets: every view is placed or reported, and nothing is drawn over text.

#![allow(unreachable_pub, reason = "in a test, `pub` means that another file uses the item")]
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail with a panic")]

mod assemblies;
mod balloons;
mod boxes;
mod center_lines;
mod dimension_layout;
mod dimensions;
mod fill;
mod formats;
mod lint;
mod overlays;
mod parts_models;
mod sections;
mod separation;
mod shared_parts;
mod styles;
mod symmetry_lines;
mod title_blocks;
mod views;
