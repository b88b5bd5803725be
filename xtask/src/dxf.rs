//! `cargo xtask dxf`: reads the program's DXF files back with ezdxf.
//!
//! The checks are in `tests/dxf/check.py`. They cover every scene and model, and parts with known
//! cross sections. ezdxf is installed in a virtual environment. If that fails, the step is reported
//! as skipped.

use crate::Outcome;
use crate::program::{Build, Program, run_visibly};
use crate::python::VirtualEnvironment;
use crate::skip::report_skip;
use crate::workspace::{project_root, target_folder};
use std::path::PathBuf;

/// The package that reads the files.
const READER: &str = "ezdxf>=1.3,<2";

/// Draws scenes and models as DXF and checks the files.
pub fn run_dxf(_arguments: &[String]) -> Outcome {
    let folder = target_folder().join("dxf");
    let Some(environment) = VirtualEnvironment::create(&folder.join("environment"))
        .filter(|environment| environment.install(&[READER]).is_ok())
    else {
        report_skip("dxf", "python3 with venv is missing, or ezdxf cannot be installed");
        return Ok(());
    };
    let program = Program::build(Build::Debug)?;
    let root = project_root();
    let mut check = environment.isolated_python();
    check.arg(root.join("tests/dxf/check.py")).arg(program.path()).arg(folder.join("files"));
    check.args([root.join("scenes"), root.join("scenes/models")]);
    match asset_folder() {
        Some(assets) => drop(check.arg(assets)),
        None => report_skip("dxf", "shared models: the folder ASSETS is missing"),
    }
    run_visibly(&mut check)
}

/// Returns the folder of shared models, if it exists.
fn asset_folder() -> Option<PathBuf> {
    let folder = std::env::var_os("ASSETS").map(PathBuf::from);
    let folder = folder.unwrap_or_else(|| project_root().join("../shared/assets"));
    Some(folder.join("models")).filter(|models| models.is_dir())
}
