//! `cargo xtask python`: builds the wheel of the Python package and tests it.
//!
//! ```text
//!  maturin ─► wheel ─► new virtual environment: only NumPy ─► a picture
//!                      and then pytest, mypy, trimesh, OpenCV … ─► the tests
//! ```
//! Without Python, its module `venv` or a package registry, the step is reported as skipped. Tests
//! whose packages cannot be installed are reported as skipped too.

use crate::Outcome;
use crate::program::{Build, Program, command_line, compile, run_command, run_visibly};
use crate::skip::report_skip;
use crate::workspace::{create_folder, list_files, project_root, target_folder};
use std::path::{Path, PathBuf};
use std::process::Command;

/// The Python package.
const PACKAGE: &str = "crates/python";
/// Packages that build wheels.
const BUILDER: &[&str] = &["maturin>=1.9,<2"];
/// Packages that most tests need.
const TEST_PACKAGES: &[&str] = &["pytest", "mypy"];
/// Packages that individual tests need. If one cannot be installed, those tests are skipped.
const PEERS: &[&str] = &[
    "trimesh",
    "networkx",
    "scipy",
    "lxml",
    "charset-normalizer",
    "pillow",
    "pycocotools",
    "pycolmap",
    "webdataset",
    "pyarrow",
    "opencv-python-headless",
    "nbclient",
    "ipykernel",
    "kubernetes-validate",
    "ray",
    "datasets",
    "mujoco",
    "gymnasium",
];
/// The maximum size of a released wheel in bytes.
const MAX_WHEEL_BYTES: u64 = 8_000_000;

/// A script that renders a picture with only NumPy installed.
const FIRST_PICTURE: &str = "
import sys, alberti
frame = alberti.render(alberti.load(sys.argv[1]), size=(320, 240), passes=('rgb', 'depth', 'ids'))
assert frame.rgb.shape == (240, 320, 3) and frame.ids.any() and frame.depth.min() > 0
print('a picture, its depth and its ids:', frame)
";

/// Builds the wheel and tests it. `--release` builds the wheel as published. `--first` only renders
/// a picture with the library from the debug build.
pub fn run_python(arguments: &[String]) -> Outcome {
    let is_release = match arguments {
        [] => false,
        [flag] if flag == "--release" => true,
        [flag] if flag == "--first" => return make_first_picture(),
        _ => return Err("the only argument is `--release` or `--first`".to_owned()),
    };
    let Some(environment) = VirtualEnvironment::create(&target_folder().join("python/build"))
        .filter(|environment| environment.install(BUILDER).is_ok())
    else {
        report_skip(
            "python",
            "python3 with venv is missing, or no package registry can be reached",
        );
        return Ok(());
    };
    let wheel = build_wheel(&environment, is_release)?;
    let bytes = std::fs::metadata(&wheel).map_err(|error| error.to_string())?.len();
    println!("{} has {bytes} bytes", wheel.display());
    if is_release && bytes > MAX_WHEEL_BYTES {
        return Err(format!("the wheel has {bytes} bytes; at most {MAX_WHEEL_BYTES} are allowed"));
    }
    test_wheel(&wheel)
}

/// Renders a picture with the package from the source tree and the library from the workspace
/// build. No wheel is packed, and nothing extra is compiled.
fn make_first_picture() -> Outcome {
    let folder = target_folder().join("python/first");
    let Some(environment) = VirtualEnvironment::create(&folder.join("environment"))
        .filter(|environment| environment.install(&["numpy"]).is_ok())
    else {
        report_skip("python-first", "python3 with venv is missing, or NumPy cannot be installed");
        return Ok(());
    };
    Program::build(Build::Debug)?;
    let package = folder.join("alberti");
    create_folder(&package)?;
    let mut files = list_files(&project_root().join(PACKAGE).join("python/alberti"), "py")?;
    let library =
        format!("{}_native{}", std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX);
    files.push(target_folder().join("debug").join(&library));
    for file in files {
        let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let name = if name == library { "_native.abi3.so".to_owned() } else { name };
        let copied = std::fs::copy(&file, package.join(name));
        copied.map_err(|error| format!("{}: {error}", file.display()))?;
    }
    let model = project_root().join("scenes/models/table.glb");
    let mut python = Command::new(environment.program("python"));
    python.env("PYTHONPATH", &folder).args(["-c", FIRST_PICTURE]).arg(model);
    run_visibly(&mut python)
}

/// Builds the wheel into an empty folder.
fn build_wheel(environment: &VirtualEnvironment, is_release: bool) -> Result<PathBuf, String> {
    let folder = target_folder().join("python/wheels");
    // A leftover from another version could be mistaken for the new wheel.
    let _ = std::fs::remove_dir_all(&folder);
    create_folder(&folder)?;
    let mut maturin = Command::new(environment.program("maturin"));
    maturin.current_dir(project_root().join(PACKAGE));
    maturin.args(["build", "--quiet", "--locked", "--out"]).arg(&folder);
    maturin.env("CARGO_TARGET_DIR", target_folder());
    maturin.args(["--interpreter".as_ref(), environment.program("python").as_os_str()]);
    if is_release {
        maturin.arg("--release");
        // The program calls `pipeline` once per command, but Python scripts fill passes and make
        // drawings in loops, so speed matters more here.
        maturin.args(["--config", "profile.release.package.alberti-pipeline.opt-level=3"]);
        maturin.args(["--config", "profile.release.package.alberti-drawing.opt-level=2"]);
        maturin.args(["--config", "profile.release.package.alberti-hidden-line.opt-level=2"]);
    }
    compile(|| run_command(&mut maturin))?;
    list_files(&folder, "whl")?.pop().ok_or_else(|| "maturin wrote no wheel".to_owned())
}

/// Installs the wheel with only NumPy and renders a picture, then installs the packages that the
/// tests need and runs the tests.
fn test_wheel(wheel: &Path) -> Outcome {
    let environment = VirtualEnvironment::create(&target_folder().join("python/test"))
        .ok_or("cannot create a second virtual environment")?;
    environment.install(&[wheel.to_string_lossy().as_ref()])?;
    let model = project_root().join("scenes/models/table.glb");
    let python = || environment.isolated_python();
    run_visibly(python().args(["-c", FIRST_PICTURE]).arg(model))?;
    if environment.install(TEST_PACKAGES).is_err() {
        report_skip("python", &format!("{} cannot be installed", TEST_PACKAGES.join(" and ")));
        return Ok(());
    }
    for peer in PEERS {
        if environment.install(&[*peer]).is_err() {
            report_skip("python", &format!("{peer} cannot be installed"));
        }
    }
    let program = Program::build(Build::Debug)?;
    let package = project_root().join(PACKAGE);
    let mut tests = python();
    tests.args(["-m", "pytest", "-rs", "-p", "no:cacheprovider", "tests"]);
    run_visibly(tests.env("ALBERTI", program.path()).current_dir(&package))?;
    let mut types = python();
    types.args(["-m", "mypy", "--strict", "--cache-dir", "/dev/null"]);
    types.args(["--package", "alberti"]);
    run_visibly(types.current_dir(&package))
}

/// A Python virtual environment.
pub struct VirtualEnvironment {
    folder: PathBuf,
}

impl VirtualEnvironment {
    /// Creates an environment, replacing an existing one. Returns `None` if Python cannot create
    /// it.
    pub fn create(folder: &Path) -> Option<Self> {
        let mut python = Command::new("python3");
        python.args(["-m", "venv", "--clear"]).arg(folder);
        run_command(&mut python).ok()?;
        Some(Self { folder: folder.to_owned() })
    }

    /// Returns the path of one of its programs.
    fn program(&self, name: &str) -> PathBuf {
        self.folder.join("bin").join(name)
    }

    /// Returns a command that runs its Python, isolated from other packages and from the current
    /// folder.
    pub fn isolated_python(&self) -> Command {
        let mut python = Command::new(self.program("python"));
        python.arg("-I");
        python
    }

    /// Installs packages.
    pub fn install(&self, packages: &[&str]) -> Outcome {
        let mut pip = Command::new(self.program("python"));
        pip.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check"]).args(packages);
        println!("{}", command_line(&pip));
        run_command(&mut pip)
    }
}
