//! Targets: how the program is compiled for a target and run on this machine.

use crate::program::capture_output;
use crate::tool_chain::ToolChain;
use crate::workspace::{create_folder, project_root, target_folder};
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A build configuration to compare with the release build: it differs in processor, C library,
/// compiler or optimization.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    pub name: &'static str,
    /// The description of the target in the printed table.
    pub about: &'static str,
    compiler: Compiler,
    /// Compiler flags, after the profile's flags; `{own}` is a folder for this target.
    flags: &'static [&'static str],
    /// Cargo settings, as environment variables.
    settings: &'static [(&'static str, &'static str)],
    /// Words before the program's path on the command line: an emulator or another loader.
    runner: &'static [&'static str],
}

/// The compiler of a target.
#[derive(Clone, Copy, Debug)]
enum Compiler {
    /// The workspace's compiler, for this machine.
    Own,
    /// Debian's compiler, for this machine.
    Second,
    /// A compiler that also compiles the standard library for the named target, with the named
    /// linker.
    WithSources { triple: &'static str, linker: &'static str, packages: &'static str },
}

/// Compiler flags that reduce optimization. Every change is tested on emulated processors, and
/// compiling for them takes longer than running on them. The targets `opt-1` and `native` compare
/// optimizations.
const QUICK: &[&str] = &["-Copt-level=1", "-Ccodegen-units=16"];

/// All targets. The processors differ in their vector instructions (NEON or none), in pointer size
/// and in the sign of NaN, and i686 passes numbers in x87 registers.
pub const TARGETS: &[Target] = &[
    Target {
        name: "aarch64",
        about: "AArch64 with NEON, emulated by QEMU",
        compiler: Compiler::WithSources {
            triple: "aarch64-unknown-linux-gnu",
            linker: "aarch64-linux-gnu-gcc",
            packages: "gcc-aarch64-linux-gnu libc6-dev-arm64-cross qemu-user-static",
        },
        flags: QUICK,
        settings: &[],
        runner: &["qemu-aarch64-static", "-L", "/usr/aarch64-linux-gnu"],
    },
    Target {
        name: "armv7",
        about: "32-bit ARM without vector instructions, emulated by QEMU",
        compiler: Compiler::WithSources {
            triple: "armv7-unknown-linux-gnueabihf",
            linker: "arm-linux-gnueabihf-gcc",
            packages: "gcc-arm-linux-gnueabihf libc6-dev-armhf-cross qemu-user-static",
        },
        flags: QUICK,
        settings: &[],
        runner: &["qemu-arm-static", "-L", "/usr/arm-linux-gnueabihf"],
    },
    Target {
        name: "i686",
        about: "32-bit x86",
        compiler: Compiler::WithSources {
            triple: "i686-unknown-linux-gnu",
            linker: "i686-linux-gnu-gcc",
            packages: "gcc-i686-linux-gnu libc6-dev-i386-cross",
        },
        flags: QUICK,
        settings: &[],
        // This machine can run the program; the loader only needs the path of the 32-bit C library.
        runner: &[
            "/usr/i686-linux-gnu/lib/ld-linux.so.2",
            "--library-path",
            "/usr/i686-linux-gnu/lib",
        ],
    },
    Target {
        name: "musl",
        about: "x86-64, linked statically with the musl C library",
        compiler: Compiler::WithSources {
            triple: "x86_64-unknown-linux-musl",
            linker: "musl-gcc",
            packages: "musl-tools",
        },
        // The compiler lacks startup files and libraries for musl, so use GCC's.
        flags: &[
            QUICK[0],
            QUICK[1],
            "-Ctarget-feature=+crt-static",
            "-Crelocation-model=static",
            "-Clink-self-contained=no",
            "-Lnative={own}",
        ],
        settings: &[],
        runner: &[],
    },
    Target {
        name: "compiler",
        about: "another compiler version",
        compiler: Compiler::Second,
        flags: &[],
        settings: &[],
        runner: &[],
    },
    Target {
        name: "opt-1",
        about: "little optimization",
        compiler: Compiler::Own,
        flags: QUICK,
        settings: &[],
        runner: &[],
    },
    Target {
        name: "native",
        about: "full optimization across crates, for the processor of this machine",
        compiler: Compiler::Own,
        flags: &["-Copt-level=3", "-Ctarget-cpu=native"],
        settings: &[("CARGO_PROFILE_RELEASE_LTO", "fat")],
        runner: &[],
    },
];

impl Target {
    /// Finds the compiler for the target.
    ///
    /// # Errors
    /// Fails if the compiler, its linker or its emulator is missing. The message explains how to
    /// install it.
    pub fn find_tools(&self) -> Result<ToolChain, String> {
        let Compiler::WithSources { linker, packages, .. } = self.compiler else {
            return match self.compiler {
                Compiler::Second => ToolChain::debian(),
                _ => ToolChain::own(),
            };
        };
        let programs = [linker].into_iter().chain(self.runner.first().copied());
        let has = |program: &&str| Command::new(program).arg("--version").output().is_ok();
        if let Some(missing) = programs.into_iter().find(|program| !has(program)) {
            return Err(format!(
                "`{missing}` is not installed: on Debian, run `apt-get install {packages}`"
            ));
        }
        ToolChain::with_sources()
    }

    /// Compiles the program and returns its path.
    ///
    /// # Errors
    /// Fails if the program does not compile.
    pub fn build_program(&self, tool_chain: &ToolChain) -> Result<PathBuf, String> {
        println!("compiling target {}", self.name);
        let targets = target_folder().join("targets");
        let own = targets.join(self.name);
        create_folder(&own)?;
        let flag = |flag: &&str| flag.replace("{own}", &own.to_string_lossy());
        let flags: Vec<String> = self.flags.iter().map(flag).collect();
        let Compiler::WithSources { triple, linker, .. } = self.compiler else {
            let mut build = tool_chain.cargo_build(project_root(), &flags, &own);
            build.args(["--package", "alberti", "--bin", "alberti"]);
            capture_output(build.envs(self.settings.iter().copied()))?;
            return Ok(own.join("release/alberti"));
        };
        if linker == "musl-gcc" {
            provide_unwinder(&own)?;
        }
        // All targets share one folder, so that programs that run during compilation are compiled
        // only once.
        let mut build = tool_chain.cargo_build(project_root(), &flags, &targets);
        build.args(["--package", "alberti", "--bin", "alberti", "--target", triple]);
        build.arg("-Zbuild-std=std,panic_unwind").env("RUSTC_BOOTSTRAP", "1");
        let variable = triple.to_uppercase().replace('-', "_");
        build.env(format!("CARGO_TARGET_{variable}_LINKER"), linker);
        capture_output(build.envs(self.settings.iter().copied()))?;
        Ok(targets.join(triple).join("release/alberti"))
    }

    /// Returns the command line: the runner, if any, and the program.
    pub fn command_line(&self, program: &Path) -> Vec<OsString> {
        let words = self.runner.iter().map(OsString::from);
        words.chain([program.into()]).collect()
    }
}

/// Provides GCC's unwinder under the name that the standard library for musl expects.
fn provide_unwinder(folder: &Path) -> Result<(), String> {
    let path = capture_output(Command::new("gcc").arg("-print-file-name=libgcc_eh.a"))?;
    let copied = fs::copy(path.trim(), folder.join("libunwind.a"));
    copied.map(drop).map_err(|error| format!("{}: {error}", path.trim()))
}
