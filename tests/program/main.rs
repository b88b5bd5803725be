//! The program as a process: its output, the files it leaves, and its exit codes.

#![allow(clippy::panic, reason = "a missing part of an answer fails the test")]
#![allow(missing_docs, unreachable_pub, reason = "in a program, `pub` means used by another file")]

mod assemblies;
mod asset_models;
mod batch;
#[cfg(unix)]
mod batch_crashes;
#[cfg(unix)]
mod batch_hostile;
mod batch_lists;
mod batch_page;
mod batch_workers;
// This module does not test the program. It is here so that the engine is linked only once.
#[path = "../book_formulas/mod.rs"]
mod book_formulas;
mod calibrated_cameras;
mod captions;
mod check;
mod colormaps;
mod compare_projections;
mod corrected_commands;
mod curve;
mod drawings;
mod dxf;
mod examples;
mod exercise;
mod exercises;
mod explain;
mod explore;
mod external_viewers;
mod files;
mod gltf_builder;
mod hostile_names;
mod info;
mod insets;
mod light;
mod light_leaks;
mod limits;
mod line_styles;
mod manual;
mod matrix;
mod matrix_answers;
mod mesh_formats;
mod meshes;
mod messages;
mod mistakes;
mod outputs;
mod overlays;
#[cfg(unix)]
mod partial_files;
mod picture_formats;
mod pictures;
mod poses;
mod reference;
mod regions;
mod sandbox;
mod scene;
mod scene_data;
mod sections;
mod sequences;
mod sheet_options;
mod skips;
mod sweep;
mod thumbnailer;
mod unused_flags;
mod unusual_sheets;
mod usage_advice;
mod variants;
mod vector_files;
mod viewpoints;
