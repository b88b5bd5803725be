//! The commands that each target runs: pictures, passes, drawings, animations and explanations.

use super::outputs::Outputs;
use crate::Outcome;
use crate::program::command_line;
use crate::skip::report_skip;
use crate::workspace::{create_folder, list_scenes, project_root};
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// Commands for each scene and each model. The pictures are small, because emulated processors are
/// slow.
const FOR_EACH_INPUT: &[&str] = &[
    "render {input} --size 160x120 --pass-format npy --passes depth,distance,normal,view-normal,\
        position,uv,barycentric,id,model,node,mesh,material,overdraw,coverage -o {name}.png",
    "render {input} -o {name}.svg",
    "render {input} -o {name}.pdf",
    "render {input} -o {name}.dxf",
    "animate {input} --frames 2 --size 96x72 -o {name}.gif",
    "explain {input} --size 160x120 --pixel 80,60 --json",
    "explain {input} --segment 0.3,0.2,0.1,-2,-1,40 --json",
];

/// Commands that run once: the other subcommands, the other styles, and an error.
const ONCE: &[&str] = &[
    "render {scenes}/product.ron --size 160x120 --style toon -o once_toon.png",
    "render {scenes}/product.ron --size 160x120 --bits 16 --tone-mapping agx -o once_agx.png",
    "render {scenes}/product.ron --size 160x120 --environment sky --ambient-occlusion -o once_sky.png",
    "render {scenes}/models/finishes.glb --views front,top,iso --size 96x96 -o once_{{view}}.png",
    "render {scenes}/models/tower.glb --style technical --section x=0.1 -o once_section.svg",
    "animate {scenes}/models/bearing.glb --turntable=90 --frames 4 --size 96x72 -o once_film.png",
    "sheet {scenes}/models/bearing.glb --paper a4 -o once_sheet.pdf",
    "sheet {scenes}/models/bearing.glb --paper a4 -o once_sheet.svg",
    "sheet {scenes}/models/bearing.glb --paper a4 --section z=0 -o once_sheet.dxf",
    "render {scenes}/models/teapot.glb --style outline -o once_outline.dxf",
    "compare-projections {scenes}/models/house.glb -o once_projections.html",
    "sweep {scenes}/house.ron --vary angle --from 0 --to 90 -o once_sweep.svg",
    "curve depth --near 0.1 --far 1000 -o once_curve.svg",
    "demo wrap-around -o once_wrap_around.svg",
    "info {scenes}/models/teapot.glb --json",
    "matrix --json 1,0,0,0,0,1,0,0,0,0,-3,-4,0,0,-1,0",
    "explain --matrix 2,0,0,0,0,2,0,0,0,0,-3,-4,0,0,-1,0 --point 0.1,0.2,-3",
    "explain {scenes}/teapot.ron --model 1 --node body --triangle 7 --html",
    "explain {scenes}/teapot.ron --node cup --triangle 7",
    "explain {scenes}/product.ron --point 0.3,0.2,0.1",
    "reference",
];

/// Models of all kinds, from the shared folder of test models.
const SHARED_MODELS: &[&str] = &[
    "models/alpha-blend-mode-test/AlphaBlendModeTest.glb",
    "models/blender-vertex-color/22_vertex_color.gltf",
    "models/boolean/boolean.glb",
    "models/cesium-man/CesiumMan.gltf",
    "models/clear-coat-test/ClearCoatTest.glb",
    "models/egyptian-cat-webp/cat.glb",
    "models/glass-table/glass-table.glb",
    "models/interpolation-test/InterpolationTest.gltf",
    "models/lights-punctual/Lights.glb",
    "models/morph-stress-test/MorphStressTest.gltf",
    "models/pirate-meshopt/pirate.glb",
    "models/playcanvas-cube/playcanvas-cube.glb",
    "models/skater-female-draco/model.gltf",
    "models/texture-settings-test/TextureSettingsTest.gltf",
    "meshes/3mf/production_components.3mf",
    "meshes/obj/fuze.obj",
    "meshes/ply/featuretype.ply",
    "meshes/stl/20mm-xyz-cube.stl",
];

/// Commands for the program, which run in parallel in a shared folder that is empty at first.
pub struct Workload {
    commands: Vec<WorkloadCommand>,
}

/// A command and the file for its output.
struct WorkloadCommand {
    arguments: Vec<OsString>,
    printed: String,
}

impl Workload {
    /// Loads all commands. Shared models that are missing are reported as skipped.
    pub fn load() -> Result<Self, String> {
        let mut inputs: Vec<(String, PathBuf)> =
            list_scenes()?.into_iter().map(|scene| (scene.name, scene.path)).collect();
        let assets = std::env::var_os("ASSETS").unwrap_or_else(|| "../shared/assets".into());
        for name in SHARED_MODELS {
            let path = project_root().join(&assets).join(name);
            if path.is_file() {
                let stem = name.split('/').skip(1).collect::<Vec<_>>().join("_");
                inputs.push((stem.replace('.', "_"), path));
            } else {
                report_skip(name, &format!("it is not in {}", path.display()));
            }
        }
        let each = inputs.iter().flat_map(|(name, path)| {
            FOR_EACH_INPUT.iter().enumerate().map(move |(number, line)| {
                WorkloadCommand::parse(line, name, path, &format!("{name}_{number}.txt"))
            })
        });
        let once = ONCE.iter().enumerate().map(|(number, line)| {
            WorkloadCommand::parse(line, "", Path::new(""), &format!("once_{number}.txt"))
        });
        Ok(Self { commands: each.chain(once).collect() })
    }

    /// Returns the number of commands.
    pub fn command_count(&self) -> usize {
        self.commands.len()
    }

    /// Runs all commands and reads the files that they wrote. `program` is a command line that ends
    /// with the program's path.
    ///
    /// # Errors
    /// Fails if the program does not start. If the program itself fails, its status is stored with
    /// its output.
    pub fn run_with(&self, program: &[OsString], folder: &Path) -> Result<Outputs, String> {
        if folder.exists() {
            fs::remove_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        }
        create_folder(folder)?;
        let next = AtomicUsize::new(0);
        let work = || {
            while let Some(command) = self.commands.get(next.fetch_add(1, Ordering::Relaxed)) {
                command.run_with(program, folder)?;
            }
            Ok(())
        };
        let count = thread::available_parallelism().map_or(1, usize::from);
        thread::scope(|scope| {
            let workers: Vec<_> = (0..count).map(|_| scope.spawn(work)).collect();
            workers.into_iter().try_for_each(|worker| {
                worker.join().unwrap_or_else(|_| Err("a thread panicked".to_owned()))
            })
        })?;
        Outputs::read(folder)
    }
}

impl WorkloadCommand {
    /// Parses a command and replaces the names in braces. Paths may contain spaces.
    fn parse(line: &str, name: &str, input: &Path, printed: &str) -> Self {
        let scenes = project_root().join("scenes");
        let word = |word: &str| match word {
            "{input}" => input.as_os_str().to_owned(),
            word => {
                let word = word.replace("{scenes}", &scenes.to_string_lossy());
                let word = word.replace("{name}", name).replace("{{", "{").replace("}}", "}");
                word.into()
            }
        };
        Self { arguments: line.split_whitespace().map(word).collect(), printed: printed.into() }
    }

    /// Runs the command, and stores its status and its output.
    fn run_with(&self, program: &[OsString], folder: &Path) -> Outcome {
        let (first, rest) = program.split_first().ok_or("the command line is empty")?;
        let mut command = Command::new(first);
        command.args(rest).args(&self.arguments).current_dir(folder);
        let output =
            command.output().map_err(|error| format!("{}: {error}", command_line(&command)))?;
        let status = output.status.code().map_or("killed".into(), |code| code.to_string());
        let mut text = format!("status {status}\n").into_bytes();
        text.extend(output.stdout);
        text.extend(output.stderr);
        let path = folder.join(&self.printed);
        fs::write(&path, text).map_err(|error| format!("{}: {error}", path.display()))
    }
}
