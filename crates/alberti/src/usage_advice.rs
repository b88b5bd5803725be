//! Advice on wrong command lines: flags and values of other programs lead to those of this one.
//!
//! clap compares the letters of words, which finds misspellings and otherwise misleads:
//! `--resolution` is not like `--size`. What people bring from f3d, Blender, three.js or stl-thumb
//! is in tables here, and is looked up first.

use super::args::Args;
use super::help_groups;
use super::negative_numbers::called_command;
use clap::builder::StyledStr;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Command, CommandFactory as _, Error, FromArgMatches as _};
use pipeline::scene::closest_name;
use std::ffi::OsString;
use std::path::Path;

/// Parses the command line.
///
/// # Errors
/// What is wrong with it, with advice.
pub(crate) fn parse_args(words: &[OsString]) -> Result<Args, Error> {
    let program = help_groups::group_commands(Args::command());
    let parsed = program.try_get_matches_from(words).and_then(|matches| {
        let args = Args::from_arg_matches(&matches);
        args.map_err(|error| error.format(&mut Args::command()))
    });
    parsed.map_err(|usage| {
        let mut program = Args::command();
        program.build();
        advise(usage, words, &program)
    })
}

/// Flags of other programs: their names without hyphens at the front; a flag that the command must
/// have; and what to write.
///
/// Of several rows with a name the first counts whose flag the command has. A row without a flag
/// holds for every command that draws, since it names another one.
const FOREIGN_FLAGS: &[(&str, &str, &str)] = &[
    (
        "resolution res dimensions image-size img-size imgsize geometry resize width height",
        "size",
        "--size 1920x1080",
    ),
    (
        "bg bgcolor bg-color background-color back-color clear-color",
        "background",
        "--background '#f4f1ea'",
    ),
    ("no-background transparent alpha film-transparent", "background", "--background transparent"),
    ("background-hdri hdri-background skybox", "background", "--background environment"),
    ("wireframe wire", "style", "--style wireframe"),
    ("edges show-edges e", "overlay", "--overlay edges"),
    ("toon cel cartoon", "style", "--style toon"),
    ("line-art lineart hidden-line hidden-lines freestyle", "style", "--style lines"),
    ("flat flat-shading", "style", "--style flat"),
    ("shading render-mode mode", "style", "--style shaded"),
    (
        "hdri hdr hdri-file env-map envmap environment-map ibl hdri-ambient",
        "environment",
        "--environment studio.hdr",
    ),
    (
        "hdri-rotation hdri-angle environment-angle",
        "environment-rotation",
        "--environment-rotation 90",
    ),
    ("light lights brightness light-strength key-light", "light-intensity", "--light-intensity 2"),
    (
        "ortho orthographic orthogonal parallel camera-orthographic",
        "projection",
        "--projection orthographic",
    ),
    ("perspective persp", "projection", "--projection perspective"),
    ("isometric iso", "projection", "--projection isometric"),
    ("yaw rotate-y camera-azimuth camera-azimuth-angle", "azimuth", "--azimuth 30"),
    ("pitch rotate-x camera-elevation camera-elevation-angle", "elevation", "--elevation 20"),
    ("fovy field-of-view view-angle camera-fov camera-view-angle focal-length", "fov", "--fov 35"),
    ("camera-zoom camera-zoom-factor zoom-factor", "zoom", "--zoom 1.5"),
    ("position camera-position camera-pos eye-position from", "eye", "--eye 4,3,6 --target 0,0,0"),
    ("look-at lookat focal-point camera-focal-point center", "eye", "--eye 4,3,6 --target 0,0,0"),
    ("camera-view-up camera-up viewup", "view-up", "--eye 4,3,6 --target 0,0,0 --view-up 0,1,0"),
    ("camera-direction direction viewpoint", "view", "--view front"),
    ("camera-index", "camera", "--camera 0"),
    ("ao ssao", "ambient-occlusion", "--ambient-occlusion"),
    ("antialias antialiasing anti-alias anti-aliasing msaa aa spp", "samples", "--samples 8"),
    ("tonemap tonemapping", "tone-mapping", "--tone-mapping aces"),
    ("shadow", "shadows", "--shadows on"),
    ("floor ground-plane shadow-catcher", "ground", "--ground shadow"),
    ("axis axes", "overlay", "--overlay axes"),
    ("grid", "overlay", "--overlay grid"),
    ("clip cut slice clipping-plane cross-section", "section", "--section x=0"),
    ("up-axis z-up zup", "up", "--up z"),
    ("size-px", "size", "--size 1920x1080"),
    ("units", "unit", "--unit mm"),
    ("pointsize point-sprites point-radius", "point-size", "--point-size 5"),
    (
        "scalar scalar-coloring coloring coloring-array color-by colorby attribute vertex-attribute",
        "scalars",
        "--scalars temperature",
    ),
    ("cmap color-map colour-map colormap-file lut palette", "colormap", "--colormap turbo"),
    ("clim crange coloring-range range color-range", "scalar-range", "--scalar-range 0,100"),
    ("animation-time", "time", "--time 1.5"),
    ("animation-index animation-name", "animation", "--animation 0"),
    ("frame-rate framerate", "fps", "--fps 30"),
    ("frame-count num-frames", "frames", "--frames 60"),
    ("output out outdir output-dir output-folder", "out-dir", "--out-dir pictures"),
    ("out outfile out-file output-file save export image write", "output", "--output picture.png"),
    ("paper-size page page-size", "paper", "--paper a4"),
    ("jobs cores num-threads", "threads", "--threads 4"),
    (
        "turntable orbit spin animate frames",
        "",
        "alberti animate model.glb --turntable -o turn.gif",
    ),
];

/// Flags of other programs that have no counterpart, or several: their names, and what to do.
const FOREIGN_HABITS: &[(&str, &str)] = &[
    ("b", "it never opens a window; leave it out"),
    (
        "P python python-expr",
        "no scripts are run; `alberti scene init model.glb` begins a scene file",
    ),
    ("f render-frame", "for one moment of an animation use `--time 1.5`"),
    ("a render-anim", "`alberti animate model.glb -o film.gif` renders a whole animation"),
    ("E engine renderer", "there is one renderer; `--style` chooses a look"),
    (
        "F render-format output-format",
        "the ending of the output file decides the format, as in `-o picture.png`",
    ),
    (
        "dpi density",
        "`--size` gives the pixels; `alberti sheet model.glb --dpi 300` draws on paper, to scale",
    ),
    (
        "s",
        "`--size 1920x1080` gives the pixels, `--scalars temperature` colors by an attribute, and \
         `--from 0.5` is where an animation begins",
    ),
    ("tile montage contact-sheet", "`alberti batch` writes a contact sheet beside its pictures"),
];

/// Values of other programs: the flag, their names, and the value here.
const FOREIGN_VALUES: &[(&str, &str, &str)] = &[
    ("style", "cel cel-shaded cel-shading celshading cartoon comic anime", "toon"),
    ("style", "wire wires mesh", "wireframe"),
    ("style", "phong pbr rendered lit solid smooth realistic material textured", "shaded"),
    (
        "style",
        "line line-art lineart edges hidden-line hidden-lines hlr drawing ink freestyle",
        "lines",
    ),
    ("style", "normal normal-map", "normals"),
    ("style", "id object-id segmentation mask", "ids"),
    ("style", "xray ghost transparent glass", "x-ray"),
    ("style", "z zbuffer z-buffer depth-map", "depth"),
    ("style", "uvs checker checkerboard", "uv"),
    ("style", "pencil hand-drawn", "sketch"),
    ("style", "flat-shading faceted facetted low-poly", "flat"),
    ("projection", "ortho orthogonal parallel", "orthographic"),
    ("projection", "persp", "perspective"),
    ("projection", "iso", "isometric"),
    ("view", "behind rear", "back"),
    ("view", "side", "right"),
    ("view", "above plan", "top"),
    ("view", "below under", "bottom"),
    ("view", "3d perspective angled corner threequarter 3/4", "three-quarter"),
    ("tone-mapping", "filmic aces-filmic hill", "aces"),
    ("tone-mapping", "linear off raw standard", "none"),
];

/// The error of clap with a tip that helps, or an error in its place.
///
/// `program` has all its flags declared; `words` are those of the command line.
fn advise(mut error: Error, words: &[OsString], program: &Command) -> Error {
    // `to pass '--zoom' as a value, use '-- --zoom'` is never what was meant.
    error.remove(ContextKind::Suggested);
    let message = match error.kind() {
        ErrorKind::UnknownArgument => advise_on_flag(&mut error, words, program),
        ErrorKind::InvalidSubcommand => advise_on_command(&error, program),
        ErrorKind::InvalidValue => {
            advise_on_value(&mut error);
            None
        }
        ErrorKind::ArgumentConflict => {
            advise_on_conflict(&mut error);
            None
        }
        _ => None,
    };
    match message {
        Some(message) => Error::raw(error.kind(), message + "\n").with_cmd(program),
        None => error,
    }
}

/// The string of a context of an error.
fn context(error: &Error, kind: ContextKind) -> Option<&str> {
    match error.get(kind) {
        Some(ContextValue::String(text)) => Some(text),
        _ => None,
    }
}

/// What to write in place of a flag that does not exist; a similar name of clap's is kept only if
/// it is very similar.
fn advise_on_flag(error: &mut Error, words: &[OsString], program: &Command) -> Option<String> {
    let command = called_command(program, words);
    let word = whole_word(context(error, ContextKind::InvalidArg)?, words);
    let name = word.split('=').next().unwrap_or(&word).to_owned();
    let stem = name.trim_start_matches('-');
    if let Some(help) = foreign_habit(stem) {
        return Some(format!(
            "`{name}` is not a flag of `{}`; {help}",
            full_name(command, program)
        ));
    }
    if !name.starts_with("--") && has_flag(command, stem) {
        return Some(format!("`{name}` needs two hyphens here: `--{stem}`"));
    }
    let short = name.strip_prefix('-').filter(|short| foreign_flag(short, command).is_some());
    let Some(flag) = name.strip_prefix("--").or(short) else {
        return advise_on_detached_value(words, command);
    };
    if let Some(advice) = foreign_flag(flag, command) {
        let help = match with_given_value(advice, &word, words, command) {
            _ if advice.starts_with("alberti ") => format!("run `{advice}`"),
            Given::Nothing => format!("use `{advice}`"),
            Given::Fits(advice) => format!("use `{advice}`"),
            Given::FitsNot(flag) => format!("the flag here is `{flag}`, as in `{advice}`"),
        };
        return Some(format!(
            "`{name}` is not a flag of `{}`; {help}",
            full_name(command, program)
        ));
    }
    if command.get_name() == program.get_name() {
        let render = program.find_subcommand("render")?;
        let help = "flags come after the command";
        return has_flag(render, flag).then(|| {
            format!("`{name}` is not a flag of `alberti` itself; {help}, as in `alberti render model.glb {name} …`")
        });
    }
    let names: Vec<&str> = command.get_arguments().filter_map(|flag| flag.get_long()).collect();
    if closest_name(flag, &names).is_none_or(|similar| differs_widely(flag, similar)) {
        error.remove(ContextKind::SuggestedArg);
    }
    None
}

/// The word that was typed: of `-resize` the parser tells `-r` alone.
fn whole_word(told: &str, words: &[OsString]) -> String {
    let is_long = |word: &&str| {
        !word.starts_with("--")
            && word.starts_with(told)
            && word[1..].chars().all(char::is_alphabetic)
    };
    let typed = (told.chars().count() == 2 && !told.starts_with("--"))
        .then(|| words.iter().filter_map(|word| word.to_str()).find(is_long));
    typed.flatten().unwrap_or(told).to_owned()
}

/// What to do about a flag of another program that has no counterpart.
fn foreign_habit(word: &str) -> Option<&'static str> {
    let is_meant = |(words, _): &&(&str, &str)| words.split(' ').any(|known| known == word);
    FOREIGN_HABITS.iter().find(is_meant).map(|(_, help)| *help)
}

/// Whether two names are too different for one to be a misspelling of the other: more than a third
/// of the letters of the longer one are missing in the other, wherever they stand.
fn differs_widely(word: &str, name: &str) -> bool {
    let mut rest: Vec<char> = name.chars().collect();
    let shared = word.chars().filter(|letter| {
        let at = rest.iter().position(|other| other == letter);
        at.map(|at| rest.swap_remove(at)).is_some()
    });
    let longest = word.chars().count().max(name.chars().count());
    3 * shared.count() < 2 * longest
}

/// The name of a command with that of the program before it.
fn full_name(command: &Command, program: &Command) -> String {
    match command.get_name() {
        name if name == program.get_name() => name.to_owned(),
        name => format!("{} {name}", program.get_name()),
    }
}

/// Whether a command has a flag of this long name.
fn has_flag(command: &Command, name: &str) -> bool {
    command.get_arguments().any(|flag| flag.get_long() == Some(name))
}

/// What to write for a flag of another program.
fn foreign_flag(word: &str, command: &Command) -> Option<&'static str> {
    let word = word.to_ascii_lowercase().replace('_', "-");
    let is_meant = |(words, flag, _): &&(&str, &str, &str)| {
        let is_known =
            if flag.is_empty() { has_flag(command, "style") } else { has_flag(command, flag) };
        is_known && words.split(' ').any(|known| known == word)
    };
    FOREIGN_FLAGS.iter().find(is_meant).map(|(.., advice)| *advice)
}

/// The value that was given for another program's flag.
enum Given {
    /// No value was given, or the flag here takes none.
    Nothing,
    /// The flag here takes it: the advice with the value.
    Fits(String),
    /// The flag here, which does not take it.
    FitsNot(String),
}

/// The advice with the value that was given for the other program's flag, where the flag here takes
/// it.
fn with_given_value(advice: &str, word: &str, words: &[OsString], command: &Command) -> Given {
    let words: Vec<String> = words.iter().map(|it| it.to_string_lossy().into_owned()).collect();
    let name = word.split('=').next().unwrap_or(word);
    let joined = words.iter().find_map(|it| it.strip_prefix(name)?.strip_prefix('='));
    let next = || words.iter().skip_while(|it| *it != name).nth(1);
    let given = joined.map(str::to_owned).or_else(|| next().cloned());
    let given = given.filter(|value| !value.starts_with('-') && !value.is_empty());
    let (Some(given), Some((flag, rest))) = (given, advice.split_once(' ')) else {
        return Given::Nothing;
    };
    let example = rest.split(" --").next().unwrap_or(rest);
    let attempt = [command.get_name().to_owned(), format!("{flag}={given}")];
    let is_valid = match command.clone().try_get_matches_from(attempt) {
        Ok(_) => true,
        Err(error) => error.kind() == ErrorKind::MissingRequiredArgument,
    };
    // A word that chooses what the flag is set to, such as `wireframe`, is no example.
    let takes_any = example.contains(|c: char| c.is_ascii_digit() || c == '#' || c == '.');
    if !takes_any || !flag.starts_with("--") {
        return Given::Nothing;
    }
    if !is_valid {
        return Given::FitsNot(flag.to_owned());
    }
    let is_plain = given.chars().all(|c| c.is_ascii_alphanumeric() || "._-,/=+:".contains(c));
    let given = if is_plain { given } else { format!("'{given}'") };
    Given::Fits(advice.replacen(example, &given, 1))
}

/// What to write for a value that was given apart from a flag that wants an equals sign, as in
/// `--turntable 180`.
fn advise_on_detached_value(words: &[OsString], command: &Command) -> Option<String> {
    let words: Vec<&str> = words.iter().filter_map(|word| word.to_str()).collect();
    words.windows(2).find_map(|pair| {
        let [flag, value] = *pair else { return None };
        let name = flag.strip_prefix("--")?;
        let wants_equals =
            |known: &clap::Arg| known.get_long() == Some(name) && known.is_require_equals_set();
        value.parse::<f64>().ok()?;
        command.get_arguments().any(wants_equals).then(|| {
            format!("the value of `{flag}` comes after an equals sign: write `{flag}={value}`")
        })
    })
}

/// Commands of other programs, and what to write.
const FOREIGN_COMMANDS: &[(&str, &str)] = &[
    (
        "view show open display preview",
        "to look at a model run `alberti explore model.glb`; to make a picture, `alberti render model.glb`",
    ),
    ("thumbnail thumb", "run `alberti render model.glb --size 256x256 -o thumb.png`"),
    ("turntable spin video film movie", "run `alberti animate model.glb --turntable -o turn.gif`"),
    (
        "draw drawing lines",
        "run `alberti render model.glb --style lines -o drawing.svg`, or `alberti sheet model.glb` for views to scale",
    ),
    ("validate lint verify", "run `alberti check model.glb`"),
    ("inspect stat stats identify", "run `alberti info model.glb`"),
    (
        "convert export",
        "it renders models and does not convert them: use another program, such as Blender",
    ),
    ("init new", "run `alberti scene init model.glb`"),
];

/// What to do with a file, a folder or another program's command in the place of a command.
fn advise_on_command(error: &Error, program: &Command) -> Option<String> {
    let word = context(error, ContextKind::InvalidSubcommand)?;
    let is_meant = |(words, _): &&(&str, &str)| words.split(' ').any(|known| known == word);
    if let Some((_, advice)) = FOREIGN_COMMANDS.iter().find(is_meant) {
        return Some(format!("`{word}` is not a command of `alberti`; {advice}"));
    }
    let path = Path::new(word);
    if path.is_dir() {
        return Some(format!(
            "`{word}` is a folder, not a command; to render the models in it, run `{} batch {word} --out-dir pictures`",
            program.get_name()
        ));
    }
    let is_file = path.is_file() || path.extension().is_some();
    is_file.then(|| {
        format!(
            "`{word}` is a file, not a command; to render it, run `{} render {word}`",
            program.get_name()
        )
    })
}

/// Puts the value that another program's name means in the place of clap's tip.
fn advise_on_value(error: &mut Error) {
    let flag = context(error, ContextKind::InvalidArg).unwrap_or_default();
    let flag = flag.trim_start_matches('-').split([' ', '=']).next().unwrap_or_default();
    let value = context(error, ContextKind::InvalidValue).unwrap_or_default().to_ascii_lowercase();
    let value = value.replace('_', "-");
    let is_meant = |(name, words, _): &&(&str, &str, &str)| {
        *name == flag && words.split(' ').any(|known| known == value)
    };
    if let Some((.., meant)) = FOREIGN_VALUES.iter().find(is_meant) {
        let meant = ContextValue::String((*meant).to_owned());
        error.insert(ContextKind::SuggestedValue, meant);
    }
}

/// Says what to do about two flags that exclude each other.
fn advise_on_conflict(error: &mut Error) {
    let is_repeated = error.get(ContextKind::InvalidArg) == error.get(ContextKind::PriorArg);
    let tip = if is_repeated { "give it once" } else { "keep one of them" };
    let tip = ContextValue::StyledStrs(vec![StyledStr::from(tip)]);
    error.insert(ContextKind::Suggested, tip);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::Args;

    /// All commands with their flags.
    fn built_program() -> Command {
        let mut program = Args::command();
        program.build();
        program
    }

    /// Each piece of advice parses as it is printed, on a command that has the flag; no name in the
    /// table is a flag that the command has.
    #[test]
    fn advice_is_accepted_by_the_commands_that_get_it() {
        let program = built_program();
        for (words, flag, advice) in FOREIGN_FLAGS {
            let flag = if flag.is_empty() { "style" } else { flag };
            let with_flag = program.get_subcommands().filter(|command| has_flag(command, flag));
            let mut count = 0;
            for command in with_flag.filter(|command| !command.is_hide_set()) {
                for word in words.split(' ') {
                    let is_own = has_flag(command, word);
                    assert!(!is_own || foreign_flag(word, command).is_some(), "{word}");
                }
                count += 1;
            }
            assert!(count > 0, "no command has --{flag}, for {advice}");
            if !advice.starts_with("alberti")
                && has_flag(program.find_subcommand("render").expect("render"), flag)
            {
                let words = format!("alberti render a.glb {}", advice.replace('\'', ""));
                let parsed = Args::command().try_get_matches_from(words.split(' '));
                assert!(parsed.is_ok(), "{advice}: {:?}", parsed.err());
            }
        }
    }

    #[test]
    fn every_value_of_the_table_exists() {
        let program = built_program();
        let render = program.find_subcommand("render").expect("render");
        for (flag, words, value) in FOREIGN_VALUES {
            let flag = render
                .get_arguments()
                .find(|known| known.get_long() == Some(flag))
                .expect("a flag");
            let names: Vec<String> = flag
                .get_possible_values()
                .iter()
                .map(|known| known.get_name().to_owned())
                .collect();
            assert!(names.iter().any(|name| name == value), "{value}: {names:?}");
            for word in words.split(' ') {
                assert!(!names.iter().any(|name| name == word), "{word} is a value itself");
            }
        }
    }
}
