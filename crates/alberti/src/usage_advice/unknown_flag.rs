//! Advice on flags that a command does not have.

use super::foreign_words::foreign_words;
use super::given_value::{
    Given, accepted_value, following_numbers, lens_angle, quoted, value_of, with_given_value,
};
use super::{context, full_name, has_flag, is_misspelling, takes_value, with_hyphens};
use crate::format::OutputFormat;
use crate::negative_numbers::called_command;
use clap::error::ContextKind;
use clap::{Command, Error};
use scene_file::closest_name;
use std::ffi::OsString;
use std::path::Path;

/// Returns advice on a flag that does not exist.
pub(super) fn advise_on_flag(
    error: &Error,
    words: &[OsString],
    program: &Command,
) -> Option<String> {
    let command = called_command(program, words);
    let word = whole_word(context(error, ContextKind::InvalidArg)?, words);
    let words: Vec<String> = words.iter().map(|it| it.to_string_lossy().into_owned()).collect();
    let (word, words) = with_value_apart(word, words);
    let name = word.split('=').next().unwrap_or(&word).to_owned();
    let stem = name.trim_start_matches('-');
    let position = |word: &str| words.iter().position(|it| it == word);
    let before_command = command.get_name() == program.get_name()
        || position(&name).is_some_and(|at| position(command.get_name()) > Some(at));
    let no_window = before_command.then(|| advise_on_no_window(&name, &words)).flatten();
    let advice = no_window.or_else(|| advise_on_negative_number(&name, &words, command));
    if advice.is_some() {
        return advice;
    }
    if let Some(help) = what_to_write(&name, &word, &words, command) {
        let command = full_name(command);
        return Some(format!("`{name}` is not a flag of `{command}`; {help}"));
    }
    if before_command && let Some(advice) = advise_before_command(&name, program) {
        return Some(advice);
    }
    if !name.starts_with('-') && Path::new(&name).extension().is_some() {
        let command = full_name(command);
        return Some(format!(
            "`{command}` reads one file, and `{name}` is a second file; for several files, use a loop: `for f in *.glb; do {command} \"$f\"; done`"
        ));
    }
    if let Some(advice) = advise_on_detached_value(&words, command) {
        return Some(advice);
    }
    if !name.starts_with('-') {
        let is_number = name.parse::<u16>().is_ok();
        let flag = ["port", "size"].into_iter().find(|flag| is_number && has_flag(command, flag));
        let help = flag.map_or(String::new(), |flag| format!(": use `--{flag} {name}`"));
        return Some(format!("unexpected argument `{name}` for `{}`{help}", full_name(command)));
    }
    Some(format!(
        "`{name}` is not a flag of `{}`; {}",
        full_name(command),
        similar_flag(stem, command)
    ))
}

/// Returns advice on a flag that the command does not have, without the flag itself.
pub(super) fn flag_advice(name: &str, word: &str, words: &[String], command: &Command) -> String {
    let help = what_to_write(name, word, words, command);
    help.unwrap_or_else(|| similar_flag(name.trim_start_matches('-'), command))
}

/// Returns the flag that was probably misspelled or shortened; otherwise, where to find all flags.
fn similar_flag(stem: &str, command: &Command) -> String {
    let names: Vec<&str> = command.get_arguments().filter_map(|flag| flag.get_long()).collect();
    let begun = || {
        let mut longer =
            names.iter().copied().filter(|name| stem.len() > 2 && name.starts_with(stem));
        longer.next().filter(|_| longer.next().is_none())
    };
    let similar = closest_name(stem, &names).filter(|similar| is_misspelling(stem, similar));
    let similar = similar.or_else(begun);
    match similar {
        Some(similar) => format!("did you mean `--{similar}`?"),
        None => format!("`{} --help` lists its flags", full_name(command)),
    }
}

/// Returns text to replace a flag: the flag with two hyphens, or this program's equivalent.
pub(super) fn what_to_write(
    name: &str,
    word: &str,
    words: &[String],
    command: &Command,
) -> Option<String> {
    let stem = name.trim_start_matches('-');
    let is_ours = has_flag(command, stem);
    if !name.starts_with("--") && is_ours {
        let value = value_of(word, words).filter(|_| takes_value(command, stem));
        let meant = value.as_ref().and_then(|value| accepted_value(stem, value, command));
        let text = meant.as_ref().map_or(String::new(), |meant| format!(" {}", quoted(meant)));
        if meant == value || meant.is_none() {
            return Some(format!("it needs two hyphens here: `--{stem}{text}`"));
        }
        Some(format!("use `--{stem}{text}`"))
    } else if let Some(format) = chosen_format(name, words, command) {
        Some(format!("use `--format {format}`"))
    } else if let Some(folder) = chosen_folder(stem, words, command) {
        Some(format!("a template names the outputs, as in `-o '{folder}/{{stem}}.png'`"))
    } else if let Some(help) = lens_advice(stem, words, command) {
        Some(help)
    } else if let Some(help) = foreign_habit(stem, command) {
        Some(help.to_owned())
    } else if let Some(flags) = combined_flags(name, command) {
        Some(format!("short flags cannot be combined: use `{flags}`"))
    } else {
        foreign_flag(stem, command).map(|advice| {
            let advice = without_given_flags(advice, words, command);
            let advice = advice.as_str();
            match with_given_value(advice, word, words, command) {
                _ if advice.starts_with("alberti ") => format!("run `{advice}`"),
                Given::Nothing if is_only_an_example(advice) => {
                    let flag = advice.split(' ').next().unwrap_or(advice);
                    format!("the flag here is `{flag}`, as in `{advice}`")
                }
                Given::Nothing => format!("use `{advice}`"),
                Given::Fits(advice) => format!("use `{advice}`"),
                Given::FitsNot(flag) => format!("the flag here is `{flag}`, as in `{advice}`"),
            }
        })
    }
}

/// Returns the flags here for f3d's short flags in one word, such as `-xgq`, except for some
/// without a counterpart.
fn combined_flags(name: &str, command: &Command) -> Option<String> {
    const FLAGS: [(char, &str); 6] = [
        ('x', "--overlay axes"),
        ('g', "--overlay grid"),
        ('e', "--overlay edges"),
        ('a', "--samples 8"),
        ('q', "--ambient-occlusion"),
        ('t', "--tone-mapping aces"),
    ];
    let letters = name.strip_prefix('-').filter(|letters| !letters.starts_with('-'))?;
    let is_known = foreign_flag(letters, command).is_some() || !has_flag(command, "overlay");
    if is_known || letters == "page" || letters.len() < 2 {
        return None;
    }
    let letters = letters.trim_matches(['n', 's', 'p']).chars();
    let find = |letter| Some(FLAGS.iter().find(|flag| flag.0 == letter)?.1);
    let flags = letters.map(find).collect::<Option<Vec<_>>>()?;
    (!flags.is_empty()).then(|| flags.join(" "))
}

/// Returns the format that `-f svg`, `-Tsvg` or `--export-type=svg` selects in other programs,
/// unless the value is a frame number.
fn chosen_format(name: &str, words: &[String], command: &Command) -> Option<String> {
    let known = [
        "f",
        "F",
        "T",
        "export-type",
        "export-format",
        "render-format",
        "output-format",
        "image-format",
    ];
    let joined = name.strip_prefix("-T").filter(|format| !format.is_empty());
    let is_known = known.contains(&&*with_hyphens(name.trim_start_matches('-')));
    let value = joined.map(str::to_owned).or_else(|| value_of(name, words).filter(|_| is_known))?;
    has_flag(command, "format").then(|| accepted_value("format", &value, command)).flatten()
}

/// Splits a short flag from its value, as in `-j4`.
pub(super) fn with_value_apart(word: String, words: Vec<String>) -> (String, Vec<String>) {
    let is_joined = word.len() > 2
        && word.chars().nth(1).is_some_and(char::is_alphabetic)
        && word[2..].chars().all(|c| c.is_ascii_digit());
    if !word.starts_with('-') || !is_joined {
        return (word, words);
    }
    let (flag, value) = word.split_at(2);
    let apart = words.into_iter().flat_map(|it| match it == word {
        true => vec![flag.to_owned(), value.to_owned()],
        false => vec![it],
    });
    let apart = apart.collect();
    (flag.to_owned(), apart)
}

/// Returns advice on a negative number after another number, as in `--eye 3 -2 5`.
fn advise_on_negative_number(name: &str, words: &[String], command: &Command) -> Option<String> {
    name.parse::<f64>().ok()?;
    let before = words.iter().take_while(|word| *word != name);
    let flag = before.filter(|word| word.starts_with("--")).last()?.split('=').next()?;
    let meant = following_numbers(flag, flag.trim_start_matches('-'), words, command)?;
    Some(format!("`{flag}` takes one value: write `{flag} {meant}`"))
}

/// Removes flags that are already present from a piece of advice, such as `--target 0,0,0 --eye
/// 4,3,6` next to an `--eye` or another program's `--camera-position`.
fn without_given_flags(advice: &str, words: &[String], command: &Command) -> String {
    let first_word = |advice: &str| advice.split(' ').next().unwrap_or(advice).to_owned();
    let is_given = |part: &str| {
        let flag = format!("--{}", first_word(part));
        let names = words.iter().filter_map(|word| word.split('=').next()?.strip_prefix('-'));
        names.map(|name| name.trim_start_matches('-')).any(|name| {
            let meant = foreign_flag(name, command).map(first_word);
            format!("--{name}") == flag || meant.as_ref() == Some(&flag)
        })
    };
    if advice.starts_with("alberti ") {
        return advice.to_owned();
    }
    let mut parts = advice.split(" --");
    let first = parts.next().unwrap_or(advice).to_owned();
    parts.filter(|part| !is_given(part)).fold(first, |kept, part| format!("{kept} --{part}"))
}

/// Returns the output folder passed to a command that expects a template.
fn chosen_folder(stem: &str, words: &[String], command: &Command) -> Option<String> {
    let names = ["output-dir", "outdir", "out-dir", "output-folder"];
    let is_meant = command.get_name() == "render" && names.contains(&&*with_hyphens(stem));
    let folder = value_of(&format!("--{stem}"), words).filter(|_| is_meant)?;
    Some(folder.trim_end_matches('/').to_owned())
}

/// Whether the value in a piece of advice is only an example that probably does not exist here.
fn is_only_an_example(advice: &str) -> bool {
    let flags = ["environment", "scalars", "compare", "camera", "animation", "variant", "pose"];
    let flag = advice.split(' ').next().and_then(|flag| flag.strip_prefix("--"));
    flag.is_some_and(|flag| flags.contains(&flag))
}

/// Returns advice on a focal length in millimeters: the equivalent angle of view.
fn lens_advice(stem: &str, words: &[String], command: &Command) -> Option<String> {
    let is_length = ["focal-length", "focal", "lens", "lens-mm"].contains(&&*with_hyphens(stem));
    let length = value_of(&format!("--{stem}"), words).filter(|_| is_length)?;
    let length = length.trim_end_matches("mm").trim();
    let angle = lens_angle(length).filter(|_| has_flag(command, "fov"))?;
    Some(format!(
        "use `--fov {angle}`, the vertical angle of view of a {length} mm lens on full frame"
    ))
}

/// Returns advice on Blender's `-b` or `--background` before a file: Alberti never opens a window.
fn advise_on_no_window(name: &str, words: &[String]) -> Option<String> {
    let is_file = |file: &String| Path::new(file).extension().is_some();
    if !["-b", "--background"].contains(&name) {
        return None;
    }
    let Some(file) = value_of(name, words) else {
        let help = "to render a model, run `alberti render model.glb`";
        return Some(format!(
            "this program opens no window and runs no scripts, so omit `{name}`; {help}"
        ));
    };
    let file = Some(file).filter(is_file)?;
    let has = |flag: &str| words.iter().any(|word| word == flag);
    let help = if has("-a") || has("--render-anim") {
        format!("to render the animation, run `alberti animate {} -o film.gif`", quoted(&file))
    } else if file.to_ascii_lowercase().ends_with(".blend") {
        "export the .blend file as .glb and run `alberti render model.glb`".to_owned()
    } else {
        let output = value_of("-o", words).map(|name| {
            // `//` is the scene's folder in Blender, and `####` the frame number.
            let name = name.trim_start_matches('/').trim_end_matches(['#', '_']);
            let has_format = OutputFormat::is_known(Path::new(name));
            format!(" -o {}", quoted(&format!("{name}{}", if has_format { "" } else { ".png" })))
        });
        format!("run `alberti render {}{}`", quoted(&file), output.unwrap_or_default())
    };
    let is_short = name == "-b";
    let color =
        if is_short { "" } else { "; here, `--background` sets the color behind the model" };
    Some(format!("this program never opens a window, so omit `{name}`: {help}{color}"))
}

/// Returns advice on a flag before any command.
fn advise_before_command(name: &str, program: &Command) -> Option<String> {
    let stem = if name == "-o" { "output" } else { name.strip_prefix("--")? };
    has_flag(program.find_subcommand("render")?, stem).then(|| {
        format!(
            "`{name}` is not a flag of `alberti` itself; flags come after the command: run `alberti render model.glb {name} …`"
        )
    })
}

/// Returns the whole word that was typed; for `-resize`, the parser reports only `-r`.
pub(super) fn whole_word(told: &str, words: &[OsString]) -> String {
    let is_long = |word: &&str| {
        !word.starts_with("--")
            && word.starts_with(told)
            && word[1..].chars().all(|c| c.is_alphanumeric() || ":_-".contains(c))
    };
    let typed = (told.chars().count() == 2 && !told.starts_with("--"))
        .then(|| words.iter().filter_map(|word| word.to_str()).find(is_long));
    typed.flatten().unwrap_or(told).to_owned()
}

/// Returns advice on another program's flag that has no counterpart here, or several counterparts.
fn foreign_habit(word: &str, command: &Command) -> Option<&'static str> {
    let word = with_hyphens(word);
    let holds = |owner: &str| owner.is_empty() || owner == command.get_name();
    foreign_words("habit").find(|row| holds(row.owner) && row.has(&word)).map(|row| row.advice)
}

/// Returns text to replace another program's flag.
pub(super) fn foreign_flag(word: &str, command: &Command) -> Option<&'static str> {
    let word = with_hyphens(word);
    // A flag without an owner belongs to all commands that draw, and these have a style.
    let is_known = |flag: &str| has_flag(command, if flag.is_empty() { "style" } else { flag });
    foreign_words("flag").find(|row| is_known(row.owner) && row.has(&word)).map(|row| row.advice)
}

/// Returns text to replace a separate value after a flag that needs an equals sign, as in
/// `--turntable 180`.
fn advise_on_detached_value(words: &[String], command: &Command) -> Option<String> {
    words.windows(2).find_map(|pair| {
        let [flag, value] = pair else { return None };
        let name = flag.strip_prefix("--")?;
        let wants_equals =
            |known: &clap::Arg| known.get_long() == Some(name) && known.is_require_equals_set();
        value.parse::<f64>().ok()?;
        command.get_arguments().any(wants_equals).then(|| {
            format!("the value of `{flag}` must follow an equals sign: write `{flag}={value}`")
        })
    })
}
