//! `alberti completions` and `alberti man`: what shells and `man` know of the program, made from its flags.

use super::{CliError, print_stdout};
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
pub(crate) fn print_completions(
    args: &CompletionArgs,
    mut program: Command,
) -> Result<(), CliError> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut program, "alberti", &mut script);
    print_stdout(&script)
}

/// Prints a manual page, or writes all of them.
pub(crate) fn print_man_pages(args: &ManArgs, program: Command) -> Result<(), CliError> {
    let mut program = program.disable_help_subcommand(true);
    program.build();
    if let Some(folder) = &args.out {
        std::fs::create_dir_all(folder).map_err(|cause| {
            CliError::Usage(format!("cannot make the folder {}: {cause}", folder.display()))
        })?;
        return write_man_pages(&program, "alberti", folder);
    }
    let mut command = &program;
    let mut name = "alberti".to_owned();
    for word in &args.command {
        command = command.find_subcommand(word).ok_or_else(|| {
            let names = command.get_subcommands().map(Command::get_name).collect::<Vec<_>>();
            CliError::Usage(format!(
                "there is no command `{word}`\n  = help: possible here: {}",
                names.join(", ")
            ))
        })?;
        name = format!("{name}-{word}");
    }
    print_stdout(&render_man_page(command, &name)?)
}

fn write_man_pages(
    command: &Command,
    name: &str,
    folder: &std::path::Path,
) -> Result<(), CliError> {
    pipeline::write_file(&folder.join(format!("{name}.1")), &render_man_page(command, name)?)?;
    let mut inner = command.get_subcommands();
    inner.try_for_each(|inner| {
        write_man_pages(inner, &format!("{name}-{}", inner.get_name()), folder)
    })
}

/// The page of a command in the language of roff.
fn render_man_page(command: &Command, name: &str) -> Result<Vec<u8>, CliError> {
    let mut page = Vec::new();
    clap_mangen::Man::new(command.clone()).title(name.to_owned()).render(&mut page)?;
    Ok(page)
}
