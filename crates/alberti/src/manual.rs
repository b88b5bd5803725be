//! `alberti completions` and `alberti man`: what shells and `man` know of the program, made from its flags.

use super::{Failure, say};
use clap::Command;
use clap_complete::Shell;
use std::path::PathBuf;

#[derive(Debug, clap::Args)]
pub(crate) struct CompletionArgs {
    /// The shell
    shell: Shell,
}

#[derive(Debug, clap::Args)]
pub(crate) struct ManArgs {
    /// A command, such as render or scene init [default: the program as a whole]
    command: Vec<String>,
    /// Write the pages of the program and of every command into this folder
    #[arg(long, value_name = "DIR", conflicts_with = "command")]
    out: Option<PathBuf>,
}

/// Prints the completions of a shell. They are made in memory first: a reader that closes its end is no failure.
pub(crate) fn completions(args: &CompletionArgs, mut program: Command) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut program, "alberti", &mut script);
    say(&script)
}

/// Prints a manual page, or writes all of them.
pub(crate) fn pages(args: &ManArgs, program: Command) -> Result<(), Failure> {
    let mut program = program.disable_help_subcommand(true);
    program.build();
    if let Some(folder) = &args.out {
        std::fs::create_dir_all(folder).map_err(|cause| {
            Failure::Usage(format!("cannot make the folder {}: {cause}", folder.display()))
        })?;
        return write_all(&program, "alberti", folder);
    }
    let mut command = &program;
    let mut name = "alberti".to_owned();
    for word in &args.command {
        command = command.find_subcommand(word).ok_or_else(|| {
            let names = command.get_subcommands().map(Command::get_name).collect::<Vec<_>>();
            Failure::Usage(format!(
                "there is no command `{word}`\n  = help: possible here: {}",
                names.join(", ")
            ))
        })?;
        name = format!("{name}-{word}");
    }
    say(&page(command, &name)?)
}

fn write_all(command: &Command, name: &str, folder: &std::path::Path) -> Result<(), Failure> {
    pipeline::write_file(&folder.join(format!("{name}.1")), &page(command, name)?)?;
    let mut inner = command.get_subcommands();
    inner.try_for_each(|inner| write_all(inner, &format!("{name}-{}", inner.get_name()), folder))
}

/// The page of a command in the language of roff.
fn page(command: &Command, name: &str) -> Result<Vec<u8>, Failure> {
    let mut page = Vec::new();
    clap_mangen::Man::new(command.clone()).title(name.to_owned()).render(&mut page)?;
    Ok(page)
}
