//! Measures the cost of doubling the input: instructions and memory at n, 2n and 4n, for each path
//! through the program.
//!
//! ```text
//!   (cost(4n) − cost(2n)) / (cost(2n) − cost(n))     2 if linear, 2.2 for n log n, 4 if quadratic
//! ```
//!
//! Taking differences cancels the cost of starting the program. Valgrind's counts are the same on
//! every machine, so the test does not depend on timing.

use alberti_tests::harness::{Tally, TemporaryFolder, map_parallel, run_program};
use alberti_tests::program_path;
use std::fmt::Write as _;
use std::path::Path;
use std::process::{Command, ExitCode, Stdio};

/// The largest growth that passes, between the 2.2 of n log n and the 4 of n².
const GREATEST_GROWTH: f64 = 2.6;

/// Memory growth below this many bytes is ignored, because growing lists double their capacity.
const LEAST_MEMORY: u64 = 4 << 20;

/// A path through the program.
struct Workload {
    name: &'static str,
    /// The name of the input file, and the function that generates its text for a size.
    file: &'static str,
    text: fn(usize) -> String,
    /// The smallest size.
    size: usize,
    /// The parts of the command before and after the file path.
    before: &'static [&'static str],
    after: &'static [&'static str],
}

/// The paths, each of which takes a second or so.
const WORKLOADS: &[Workload] = &[
    Workload {
        name: "syntax errors",
        file: "scene.ron",
        text: |n| scene_of(&"Dirextional(directoin: (0, 1, 0)),\n".repeat(n)),
        size: 100,
        before: &["scene", "check"],
        after: &[],
    },
    Workload {
        name: "semantic errors",
        file: "scene.ron",
        text: |n| scene_of(&"Directional(direction: (0, 0, 0), intensity: 1),\n".repeat(n)),
        size: 200,
        before: &["scene", "check"],
        after: &[],
    },
    Workload {
        name: "scene formatting",
        file: "scene.ron",
        text: |n| scene_of(&"Directional(direction:(0,1,0),intensity:1),".repeat(n)),
        size: 1000,
        before: &["scene", "fmt", "--check"],
        after: &[],
    },
    Workload {
        name: "shaded triangles",
        file: "soup.stl",
        text: soup,
        size: 5000,
        before: &["render"],
        after: &["--size", "64x64", "-o", "out.png"],
    },
    Workload {
        name: "line drawing",
        file: "soup.stl",
        text: soup,
        size: 500,
        before: &["render"],
        after: &["--style", "lines", "-o", "out.svg"],
    },
    Workload {
        name: "dashed line drawing",
        file: "soup.stl",
        text: soup,
        size: 500,
        before: &["render"],
        after: &["--style", "dashed", "-o", "out.svg"],
    },
    Workload {
        name: "surface as DXF",
        file: "surface.obj",
        text: surface,
        size: 1000,
        before: &["render"],
        after: &["--style", "wireframe", "-o", "out.dxf"],
    },
    Workload {
        name: "surface as PDF",
        file: "surface.obj",
        text: surface,
        size: 1000,
        before: &["render"],
        after: &["--style", "wireframe", "-o", "out.pdf"],
    },
    Workload {
        name: "points",
        file: "points.ply",
        text: points,
        size: 5000,
        before: &["render"],
        after: &["--size", "64x64", "-o", "out.png"],
    },
    Workload {
        name: "materials",
        file: "materials.obj",
        text: |n| {
            (0..n).fold("v 0 0 0\nv 1 0 0\nv 0 1 0\n".to_owned(), |text, i| {
                text + &format!("usemtl m{i}\nf 1 2 3\n")
            })
        },
        size: 500,
        before: &["render"],
        after: &["--size", "64x64", "-o", "out.png"],
    },
    Workload {
        name: "node checks",
        file: "nodes.gltf",
        text: nodes,
        size: 1000,
        before: &["check"],
        after: &[],
    },
    Workload {
        name: "node descriptions",
        file: "nodes.gltf",
        text: nodes,
        size: 1000,
        before: &["info"],
        after: &[],
    },
];

pub fn run() -> ExitCode {
    run_program("growth", |arguments| {
        let mut tally = Tally::default();
        if Command::new("valgrind").arg("--version").output().is_err() {
            tally.skip("growth", "valgrind is not installed");
            return Ok(tally);
        }
        let folder = TemporaryFolder::create("growth")?;
        let chosen: Vec<_> =
            WORKLOADS.iter().filter(|workload| arguments.select(workload.name)).collect();
        let outcomes = map_parallel(&chosen, |index, workload| {
            let folder = folder.path().join(index.to_string());
            std::fs::create_dir(&folder).map_err(|error| error.to_string())?;
            workload.judge(&folder)
        });
        for (workload, outcome) in chosen.iter().zip(outcomes) {
            tally.record(workload.name, outcome);
        }
        Ok(tally)
    })
}

impl Workload {
    fn judge(&self, folder: &Path) -> Result<(), String> {
        let costs: Result<Vec<[u64; 2]>, String> =
            [1, 2, 4].map(|times| self.cost(folder, self.size * times)).into_iter().collect();
        let costs = costs?;
        let growth = |kind: usize| {
            let [one, two, four] = [0, 1, 2].map(|index: usize| costs[index][kind] as f64);
            (four - two) / (two - one).max(1.0)
        };
        let [instructions, memory] = [growth(0), growth(1)];
        println!(
            "{:22} {:>14} instructions, growth {instructions:.2}; {:>6} kB, growth {memory:.2}",
            self.name,
            costs[2][0],
            costs[2][1] / 1000
        );
        if instructions > GREATEST_GROWTH {
            return Err(format!("instructions grow by {instructions:.2}: {costs:?}"));
        }
        if costs[2][1] - costs[1][1] > LEAST_MEMORY && memory > GREATEST_GROWTH {
            return Err(format!("memory grows by {memory:.2}: {costs:?}"));
        }
        Ok(())
    }

    /// Returns the number of instructions and the peak number of allocated bytes.
    fn cost(&self, folder: &Path, size: usize) -> Result<[u64; 2], String> {
        let path = folder.join(self.file);
        std::fs::write(&path, (self.text)(size)).map_err(|error| error.to_string())?;
        let counted = self.run(folder, &path, "callgrind")?;
        let total = counted.lines().find_map(|line| line.strip_prefix("summary: "));
        let total = total.and_then(|total| total.split_whitespace().next()?.parse().ok());
        let weighed = self.run(folder, &path, "massif")?;
        let sizes = weighed.lines().filter_map(|line| line.strip_prefix("mem_heap_B="));
        let most = sizes.filter_map(|size| size.parse().ok()).max();
        Ok([total.ok_or("no instruction count")?, most.ok_or("no memory measurement")?])
    }

    /// Runs the program under a valgrind tool and returns the tool's output.
    fn run(&self, folder: &Path, path: &Path, tool: &str) -> Result<String, String> {
        let profile = folder.join(tool);
        let mut command = Command::new("valgrind");
        command.arg(format!("--tool={tool}"));
        command.arg(format!("--{tool}-out-file={}", profile.display()));
        command.arg(program_path()?).args(self.before).arg(path).args(self.after);
        if self.before == ["render"] {
            command.args(["--threads", "1"]);
        }
        command.current_dir(folder).stdout(Stdio::null()).stderr(Stdio::null());
        let status = command.status().map_err(|error| error.to_string())?;
        // A scene with errors exits with 1, which is the expected result.
        if !matches!(status.code(), Some(0 | 1)) {
            return Err(format!("the program exited with {status}"));
        }
        std::fs::read_to_string(&profile).map_err(|error| error.to_string())
    }
}

/// Returns a scene with these lights, whose model does not exist.
fn scene_of(lights: &str) -> String {
    format!("Scene(models: [(path: \"missing.glb\")], lights: [{lights}])")
}

/// Returns numbers from 0 to 1, which are the same in every run.
fn random_numbers() -> impl FnMut() -> f64 {
    let mut state = 1_u64;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (state >> 40) as f64 / f64::from(1 << 24)
    }
}

/// Returns random triangles, each a tenth of the size of the whole.
fn soup(count: usize) -> String {
    let mut next = random_numbers();
    let mut text = "solid soup\n".to_owned();
    for _ in 0..count {
        let center = [next(), next(), next()];
        text.push_str("facet normal 0 0 0\nouter loop\n");
        for _ in 0..3 {
            let [x, y, z] = center.map(|part| part + 0.1 * next());
            let _ = writeln!(text, "vertex {x} {y} {z}");
        }
        text.push_str("endloop\nendfacet\n");
    }
    text + "endsolid\n"
}

/// Returns a rough surface of about this many triangles.
fn surface(count: usize) -> String {
    let side = libm::sqrt(count as f64 / 2.0) as usize + 1;
    let mut next = random_numbers();
    let mut text = String::new();
    for y in 0..side {
        for x in 0..side {
            let _ = writeln!(text, "v {x} {y} {}", next());
        }
    }
    for y in 1..side {
        for x in 1..side {
            let corner = y * side + x + 1;
            let (left, below) = (corner - 1, corner - side);
            let _ = writeln!(text, "f {corner} {left} {below}\nf {left} {} {below}", below - 1);
        }
    }
    text
}

/// Returns random points.
fn points(count: usize) -> String {
    let mut next = random_numbers();
    let mut text = format!(
        "ply\nformat ascii 1.0\nelement vertex {count}\nproperty float x\nproperty float y\n\
         property float z\nend_header\n"
    );
    for _ in 0..count {
        let _ = writeln!(text, "{} {} {}", next(), next(), next());
    }
    text
}

/// Returns nodes in a row, without meshes.
fn nodes(count: usize) -> String {
    let node = |index: usize| format!("{{\"translation\":[{index},0,0]}}");
    let nodes: Vec<String> = (0..count).map(node).collect();
    let roots: Vec<String> = (0..count).map(|index| index.to_string()).collect();
    format!(
        "{{\"asset\":{{\"version\":\"2.0\"}},\"scene\":0,\"scenes\":[{{\"nodes\":[{}]}}],\"nodes\":[{}]}}",
        roots.join(","),
        nodes.join(",")
    )
}
