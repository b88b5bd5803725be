//! The program's help, with commands grouped by task.

use clap::Command;

/// The groups of commands, in help order.
const GROUPS: [(&str, &[&str]); 5] = [
    ("Pictures", &["render", "animate", "batch", "thumbnailer"]),
    ("Drawings on paper", &["sheet", "compare-projections", "sweep", "curve"]),
    ("Files", &["info", "check", "scene"]),
    ("Learning", &["explain", "explore", "matrix", "exercise", "demo"]),
    ("Help", &["reference", "man", "completions", "help"]),
];
/// The column in which descriptions begin.
const DESCRIPTION_COLUMN: usize = 22;
/// The maximum line length.
const MAX_COLUMNS: usize = 100;

/// Returns the program with its commands grouped in the help.
pub(crate) fn group_commands(program: Command) -> Command {
    let mut text = String::from("{about-with-newline}\n{usage-heading} {usage}\n\n");
    for (title, names) in GROUPS {
        text.push_str(&format!("{title}:\n"));
        for name in names {
            let described = program.find_subcommand(name).and_then(Command::get_about);
            // clap adds `help` when it parses.
            let about = described.map_or_else(|| HELP_OF_HELP.to_owned(), ToString::to_string);
            text.push_str(&command_lines(name, &about));
        }
        text.push('\n');
    }
    text.push_str("Options:\n{options}{after-help}");
    program.help_template(text)
}

/// The description of the command `help`.
const HELP_OF_HELP: &str = "Print the help for a command";

/// Returns the help lines of a command: its name and its wrapped description.
fn command_lines(name: &str, about: &str) -> String {
    let (mut text, mut column) = (format!("  {name:<20}"), DESCRIPTION_COLUMN);
    for word in about.split_whitespace() {
        let length = word.chars().count();
        if column + length > MAX_COLUMNS {
            text.truncate(text.trim_end().len());
            text.push_str(&format!("\n{:DESCRIPTION_COLUMN$}", ""));
            column = DESCRIPTION_COLUMN;
        }
        text.push_str(word);
        text.push(' ');
        column += length + 1;
    }
    format!("{}\n", text.trim_end())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::Args;
    use clap::CommandFactory as _;

    #[test]
    fn every_command_is_in_one_group() {
        let program = Args::command();
        let shown = program.get_subcommands().filter(|command| !command.is_hide_set());
        let mut expected: Vec<&str> = shown.map(Command::get_name).chain(["help"]).collect();
        let mut grouped: Vec<&str> =
            GROUPS.iter().flat_map(|(_, names)| names.iter().copied()).collect();
        expected.sort_unstable();
        grouped.sort_unstable();
        assert_eq!(grouped, expected);
        let help = group_commands(program).render_long_help().to_string();
        assert!(help.lines().all(|line| line.chars().count() <= MAX_COLUMNS), "{help}");
    }
}
