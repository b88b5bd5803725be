//! The `alberti` program, which renders, draws, validates and explains 3D models.
//!
//! [`run`] is the entry point of `main.rs` and of the Python package's `alberti` command.
//!
//! Each command is a module with an arguments struct and a `run` function. Only this crate prints:
//! results go to the standard output, messages to the standard error stream. It uses, among others:
//!
//! | crate | contents |
//! | --- | --- |
//! | [`homog`] | typed points, vectors, homogeneous points, affine and projective maps |
//! | [`camera`] | the camera transform: look-at, named views, framing, stereo, rays |
//! | [`projection`] | every planar projection by name, API conventions, inverses, decomposition |
//! | [`clip`](../clip/index.html) | clipping in homogeneous space, before the perspective divide |
//! | [`viewport`] | window to viewport, pixel conventions, paper, unprojection |
//! | [`raster`] | coverage (`rasterize.rs`), depth test, multisampling, deterministic tiles |
//! | [`model`] | models as plain arrays; poses, skinning and morph targets |
//! | [`shade`] | glTF materials, lights, environments, tone mapping |
//! | [`drawing`] | hidden-line drawings: line styles, fills, overlays, charts |
//! | [`scene_file`] | the scene language: types, errors with carets, formatter, reference |
//! | [`scene`](../scene/index.html) | resolution of scene files, lints |
//! | [`pipeline`] | the renderer, passes, sequences |
//! | [`batch`](../batch/index.html) | many pictures: jobs, workers, reports, shards, tar files |
//! | [`explain`](../explain/index.html) | every step for a point, a triangle, a pixel or a matrix |

mod animate;
mod args;
mod batch;
mod calibrated_camera;
mod check;
mod color;
mod compare;
mod compare_projections;
mod curve;
mod deferred;
mod demo;
mod error;
mod exercise;
mod explain;
mod explore;
mod format;
mod help_groups;
mod info;
mod light;
mod load_options;
mod manual;
mod matrix;
mod memory_limit;
mod messages;
mod model_state;
mod negative_numbers;
mod number_list;
mod options;
mod page_output;
mod panel_subject;
mod passes;
mod program;
mod progress;
mod reference;
mod region;
mod render;
mod render_job;
mod render_report;
mod scene;
mod scene_overrides;
mod section;
mod sheet;
mod signals;
mod sweep;
mod terminal_image;
mod thumbnailer;
mod unused_flags;
mod usage_advice;
mod viewpoint;

pub use program::{run_program, run_within};
pub use signals::clean_up_on_signals;

use args::{Args, Command};
use clap::CommandFactory as _;
use deferred::Deferred;
use error::CliError;
use messages::{print_json, print_message, print_note, print_stdout, print_text, print_usage};
use std::ffi::OsString;
use std::process::ExitCode;

/// Runs the program with its arguments, the first of which is its name; returns the exit code.
///
/// The exit code is 0 for success, 1 for a failure or errors found by a check, and 2 for wrong
/// usage (set by clap). It is 3 for a batch that had to stop, and 128 or more after a signal.
///
/// A failure is printed as `error: MESSAGE` on the standard error stream. Commands whose result is
/// a verdict return 1 without an error message.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let words = negative_numbers::join_negative_numbers(arguments, Args::command);
    let args = match usage_advice::parse_args(&words) {
        Ok(args) => args,
        Err(usage) => {
            print_usage(&usage);
            return u8::try_from(usage.exit_code()).unwrap_or(2);
        }
    };
    run_command(args).unwrap_or_else(|failure| {
        print_message("error", &failure.to_message());
        1
    })
}

/// Runs the command that the arguments specify.
///
/// # Errors
/// Returns an error if the input is invalid or the work fails; the error has not been printed yet.
pub(crate) fn run_command(args: Args) -> Result<u8, CliError> {
    let verdict = |code: ExitCode| u8::from(code != ExitCode::SUCCESS);
    color::set_color_choice(args.color);
    match args.command {
        Command::Render(Deferred(args)) => return render::run(&args).map(verdict),
        Command::Sheet(Deferred(args)) => sheet::run(&args)?,
        Command::Info(Deferred(args)) => info::run(&args)?,
        Command::Check(Deferred(args)) => return check::run(&args).map(verdict),
        Command::Matrix(Deferred(args)) => matrix::run(&args)?,
        Command::Explain(Deferred(args)) => explain::run(&args)?,
        Command::Explore(args) => explore::run(&args)?,
        Command::Exercise(Deferred(args)) => return exercise::run(&args).map(verdict),
        Command::CompareProjections(Deferred(args)) => compare_projections::run(&args)?,
        Command::Sweep(Deferred(args)) => sweep::run(&args)?,
        Command::Curve(args) => curve::run(&args)?,
        Command::Demo(args) => demo::run(&args)?,
        Command::Animate(Deferred(args)) => animate::run(&args)?,
        Command::Batch(Deferred(args)) => return batch::run(args),
        Command::BatchWorker(args) => batch::run_worker(&args)?,
        Command::Thumbnailer(Deferred(args)) => thumbnailer::run(&args)?,
        Command::Scene(args) => return scene::run(&args).map(verdict),
        Command::Completions(Deferred(args)) => manual::print_completions(&args, &Args::command())?,
        Command::Man(Deferred(args)) => manual::print_man_pages(&args, Args::command())?,
        Command::Reference(Deferred(args)) => reference::run(&args, Args::command())?,
    }
    Ok(0)
}
