//! Converts values from another program's notation to this program's.

use super::context;
use super::foreign_words::foreign_words;
use clap::error::{ContextKind, ErrorKind};
use clap::{Command, Error};

/// The value passed to another program's flag.
pub(super) enum Given {
    /// The value is missing, or this program's flag accepts none.
    Nothing,
    /// The advice with the value, which this program's flag accepts.
    Fits(String),
    /// This program's flag, which does not accept the value.
    FitsNot(String),
}

/// Returns the advice with the other program's value, if this program's flag accepts it.
pub(super) fn with_given_value(
    advice: &str,
    word: &str,
    words: &[String],
    command: &Command,
) -> Given {
    let (Some(given), Some((flag, rest))) = (value_of(word, words), advice.split_once(' ')) else {
        return Given::Nothing;
    };
    let Some(name) = flag.strip_prefix("--") else { return Given::Nothing };
    let example = rest.split(" --").next().unwrap_or(rest);
    // A word that selects the flag's setting, such as `wireframe`, is not an example.
    let is_choice =
        has_choices(command, name) || example == "transparent" || example == "environment";
    if example.starts_with("--") {
        return Given::Nothing;
    }
    // In f3d, -1 means all animations.
    if name == "animation" && given.starts_with('-') {
        return Given::FitsNot(flag.to_owned());
    }
    if let Some(factor) = percent(&given).filter(|_| name == "size") {
        return Given::Fits(format!("--scale {factor}"));
    }
    // One number may be the width or the height.
    if name == "size" && given.chars().all(|c| c.is_ascii_digit()) {
        let sides = following_numbers(word.split('=').next().unwrap_or(word), name, words, command);
        let sides = sides.or_else(|| both_sides(words));
        return sides.map_or_else(
            || Given::FitsNot(flag.to_owned()),
            |sides| Given::Fits(format!("{flag} {sides}")),
        );
    }
    let percentage: Option<f64> = given.parse().ok().filter(|_| word.contains("percentage"));
    if let Some(percentage) = percentage {
        return Given::Fits(format!("{flag} {}", percentage / 100.0));
    }
    if let Some(degrees) = degrees_of_radians(name, &given) {
        return Given::Fits(format!("{flag} {degrees}"));
    }
    let numbers = || following_numbers(word.split('=').next()?, name, words, command);
    match accepted_value(name, &given, command).or_else(numbers) {
        Some(value) => Given::Fits(advice.replacen(example, &quoted(&value), 1)),
        None if is_choice => Given::Nothing,
        None => Given::FitsNot(flag.to_owned()),
    }
}

/// Returns the value that follows a word on the command line, or the word's equals sign.
pub(super) fn value_of(word: &str, words: &[String]) -> Option<String> {
    let name = word.split('=').next().unwrap_or(word);
    let joined = words.iter().find_map(|it| it.strip_prefix(name)?.strip_prefix('='));
    let next = || words.iter().skip_while(|it| *it != name).nth(1);
    let given = joined.map(str::to_owned).or_else(|| next().cloned());
    let is_number =
        |value: &str| value.trim_start_matches('-').starts_with(|c: char| c.is_ascii_digit());
    given.filter(|value| !value.is_empty() && (!value.starts_with('-') || is_number(value)))
}

/// Returns a value whose numbers are separate words, as in `--size 64 48` or `--eye 3 2 5`.
pub(super) fn following_numbers(
    word: &str,
    flag: &str,
    words: &[String],
    command: &Command,
) -> Option<String> {
    let joined = format!("{word}=");
    let place = words.iter().position(|it| it == word || it.starts_with(&joined))?;
    let first = words[place].strip_prefix(&joined).map(str::to_owned);
    let rest = words[place + 1..].iter().cloned();
    let is_between = |it: &str| ["x", "×", "by"].contains(&it);
    let numbers = first.into_iter().chain(rest);
    let numbers = numbers.take_while(|it| it.parse::<f64>().is_ok() || is_between(it));
    let numbers: Vec<String> = numbers.filter(|it| !is_between(it)).collect();
    let counts = (2..=numbers.len().min(16)).rev();
    counts.map(|count| numbers[..count].join(",")).find_map(|given| {
        let meant = if flag == "size" { given.replace(',', "x") } else { given };
        accepted_value(flag, &meant, command)
    })
}

/// Other programs' flags for a width and for a height.
pub(super) const SIDES: [[&str; 4]; 2] =
    [["--width", "-w", "-W", "--resolution-x"], ["--height", "-h", "-H", "--resolution-y"]];

/// Returns the size from two flags, such as `--width 64 --height 48`.
fn both_sides(words: &[String]) -> Option<String> {
    let [width, height] = SIDES.map(|names| {
        let value = names.iter().find_map(|name| value_of(name, words))?;
        value.parse::<u32>().ok()
    });
    Some(format!("{}x{}", width?, height?))
}

/// Quotes a value for a shell.
pub(super) fn quoted(value: &str) -> String {
    let is_plain = value.chars().all(|c| c.is_ascii_alphanumeric() || "._-,/=+:".contains(c));
    if is_plain { value.to_owned() } else { format!("'{value}'") }
}

/// Returns a value that a flag accepts: the given one, or its equivalent in this program.
pub(super) fn accepted_value(flag: &str, given: &str, command: &Command) -> Option<String> {
    let lower = given.to_ascii_lowercase();
    // Values from a list are written as in the help.
    if has_choices(command, flag) && is_accepted(flag, &lower, command) {
        return Some(lower);
    }
    let meant = [
        Some(given.to_owned()),
        Some(lower),
        foreign_value(flag, given),
        rewritten(flag, given),
        percent(given)
            .filter(|_| ["zoom", "scale", "light-intensity"].contains(&flag))
            .map(|factor| factor.to_string()),
        // The thumbnailer's pictures are square: `128x128` is `128`.
        given.split_once('x').filter(|(width, height)| width == height).map(|it| it.0.to_owned()),
    ];
    meant.into_iter().flatten().find(|value| is_accepted(flag, value, command))
}

/// Returns the equivalent of another program's value.
pub(super) fn foreign_value(flag: &str, given: &str) -> Option<String> {
    let given = given.to_ascii_lowercase().replace('_', "-");
    let mut values = foreign_words("value");
    values.find(|row| row.owner == flag && row.has(&given)).map(|row| row.advice.to_owned())
}

/// Returns a value in this program's notation: `200,150` as `200x150`, `1,0,0` as `#ff0000`, and
/// `100x80+10+20` as `10,20,100,80`.
fn rewritten(flag: &str, given: &str) -> Option<String> {
    match flag {
        "size" => Some(rewritten_size(given)),
        "zoom" => Some(given.trim_end_matches(['x', 'X']).to_owned()),
        "fov" if given.ends_with("mm") => lens_angle(given.trim_end_matches("mm")),
        "frames" => {
            let (first, last) = given.split_once("..").or_else(|| given.split_once(['-', ':']))?;
            let ends: [u32; 2] = [first.trim().parse().ok()?, last.trim().parse().ok()?];
            Some((ends[1].checked_sub(ends[0])? + 1).to_string())
        }
        "fps" => Some(given.trim_end_matches(|c: char| c.is_alphabetic()).trim().to_owned()),
        "from" | "to" | "time" => seconds(given),
        "quality" => {
            let quality: f64 = given.trim_end_matches('%').trim().parse().ok()?;
            let whole = if quality < 1.0 { 100.0 } else { 1.0 };
            Some(libm::round(quality * whole).to_string())
        }
        "azimuth"
        | "elevation"
        | "fov"
        | "crease"
        | "environment-rotation"
        | "turntable"
        | "point-size" => {
            let number = given.trim_end_matches(|c: char| c.is_alphabetic() || c == '°');
            Some(number.trim().to_owned())
        }
        "exposure" => Some(given.to_ascii_lowercase().trim_end_matches("ev").trim().to_owned()),
        "scalar-range" => {
            let ends = given.trim_matches(['(', ')', '[', ']']).split([':', ' ', ';', ',']);
            let ends: Vec<&str> = ends.filter(|end| !end.is_empty()).collect();
            Some(ends.join(","))
        }
        "scale" => drawing_scale(given),
        "background" if given.eq_ignore_ascii_case("none") => Some("transparent".to_owned()),
        "background" if given.starts_with("0x") => Some(format!("#{}", &given[2..])),
        "background" => hex_color(given).or_else(|| Some(given.replace([' ', '-', '_'], ""))),
        "crop" => {
            let (size, [x, y]) = given.split_once('+').and_then(|(size, place)| {
                let (x, y) = place.split_once('+')?;
                Some((size, [x, y]))
            })?;
            let (width, height) = size.split_once('x')?;
            Some(format!("{x},{y},{width},{height}"))
        }
        "eye" | "target" | "view-up" => {
            let numbers = given.split([' ', ',', ';', '(', ')', '[', ']', '<', '>']);
            Some(numbers.filter(|number| !number.is_empty()).collect::<Vec<_>>().join(","))
        }
        _ => None,
    }
}

/// Returns a size in this program's notation: `200,150!` as `200x150`. The missing side of
/// `640x` or `x480` follows from the shape of a picture without `--size`.
fn rewritten_size(given: &str) -> String {
    let given = given.trim_matches(['!', '^', '>', '<', '(', ')', '[', ']']);
    let sides = given.trim_end_matches("px").split([',', ' ', ':', '*', 'X', '×', 'x']);
    let sides: Vec<&str> = sides.collect();
    let number = |side: &str| side.parse::<u32>().ok().filter(|side| *side > 3);
    let given = sides.iter().filter(|side| !side.is_empty()).copied().collect::<Vec<_>>().join("x");
    match sides[..] {
        [side] => format!("{side}x{side}"),
        [width, ""] => number(width).map_or(given, |width| format!("{width}x{}", width / 4 * 3)),
        ["", height] => {
            number(height).map_or(given, |height| format!("{}x{height}", height / 3 * 4))
        }
        _ => given,
    }
}

/// Converts a color of three numbers, up to 1 or up to 255, to hexadecimal digits; four numbers
/// with an alpha of 0 become `transparent`.
fn hex_color(given: &str) -> Option<String> {
    let numbers = given.trim_start_matches(|c: char| c.is_alphabetic() || "([".contains(c));
    let numbers = numbers.trim_end_matches([')', ']']).split([',', ' ']);
    let numbers = numbers.filter(|word| !word.is_empty());
    let channels: Vec<f64> = numbers.map(|word| word.trim().parse().ok()).collect::<Option<_>>()?;
    // An alpha between transparent and opaque cannot be expressed.
    let has_alpha = matches!(channels[..], [_, _, _, alpha] if ![0.0, 1.0, 255.0].contains(&alpha));
    if has_alpha {
        return None;
    }
    let [red, green, blue] = match channels[..] {
        [.., alpha] if channels.len() == 4 && alpha == 0.0 => {
            return Some("transparent".to_owned());
        }
        [red, green, blue] | [red, green, blue, _] => [red, green, blue],
        _ => return None,
    };
    let whole = if channels.iter().all(|channel| *channel <= 1.0) { 255.0 } else { 1.0 };
    let [red, green, blue] = [red, green, blue].map(|it| (it * whole).round() as u8);
    Some(format!("#{red:02x}{green:02x}{blue:02x}"))
}

/// Converts a drawing scale from another notation: `0.5`, `50%` or `1/2` to `1:2`, `2` to `2:1`.
fn drawing_scale(given: &str) -> Option<String> {
    if let Some((paper, model)) = given.split_once(['/', ':']) {
        return Some(format!("{}:{}", paper.trim(), model.trim()));
    }
    let factor = percent(given).or_else(|| given.parse().ok())?;
    let whole = if factor < 1.0 { 1.0 / factor } else { factor };
    let is_whole = factor > 0.0 && (whole - whole.round()).abs() < 1e-9 * whole;
    is_whole.then(|| {
        let whole = whole.round();
        if factor < 1.0 { format!("1:{whole}") } else { format!("{whole}:1") }
    })
}

/// Returns the color name, or other value of the flag, that is most similar to a value.
pub(super) fn similar_color(flag: &str, given: &str) -> Option<String> {
    let names = scene_file::color_names().chain(["transparent", "environment"]);
    let names: Vec<&str> = names.collect();
    let similar = || scene_file::closest_name(given, &names).map(str::to_owned);
    (flag == "background").then(similar).flatten()
}

/// Converts a field of view from radians, as Python programs use, to degrees.
fn degrees_of_radians(name: &str, given: &str) -> Option<f64> {
    let radians: f64 = given.parse().ok().filter(|_| name == "fov")?;
    let degrees = libm::round(radians.to_degrees() * 10.0) / 10.0;
    (0.0..core::f64::consts::PI).contains(&radians).then_some(degrees)
}

/// Returns the vertical angle of view in degrees of a full-frame lens, from its focal length.
pub(super) fn lens_angle(millimeters: &str) -> Option<String> {
    let length: f64 = millimeters.trim().parse().ok().filter(|length| *length > 0.0)?;
    let degrees = 2.0 * libm::atan(12.0 / length).to_degrees();
    Some((libm::round(degrees * 10.0) / 10.0).to_string())
}

/// Returns the number of seconds in `1.5s` or `00:01:30`.
fn seconds(given: &str) -> Option<String> {
    let parts = given.trim_end_matches("sec").trim_end_matches('s').split(':');
    let parts: Vec<f64> = parts.map(|part| part.trim().parse().ok()).collect::<Option<_>>()?;
    Some(parts.into_iter().fold(0.0, |sum, part| 60.0 * sum + part).to_string())
}

/// Converts a percentage to a factor, such as `50%` to 0.5.
fn percent(given: &str) -> Option<f64> {
    let percent: f64 = given.strip_suffix('%')?.parse().ok()?;
    (percent > 0.0).then_some(percent / 100.0)
}

/// Whether a flag has a list of possible values.
fn has_choices(command: &Command, name: &str) -> bool {
    let flag = command.get_arguments().find(|flag| flag.get_long() == Some(name));
    flag.is_some_and(|flag| !flag.get_possible_values().is_empty())
}

/// Whether a flag accepts a value.
fn is_accepted(flag: &str, value: &str, command: &Command) -> bool {
    let attempt = [command.get_name().to_owned(), format!("--{flag}={value}")];
    match command.clone().try_get_matches_from(attempt) {
        Ok(_) => true,
        Err(error) => error.kind() == ErrorKind::MissingRequiredArgument,
    }
}

/// Returns the flag, without hyphens, and the value from an error about a value.
pub(super) fn invalid_value(error: &Error) -> Option<(String, String)> {
    let flag = context(error, ContextKind::InvalidArg)?;
    let flag = flag.trim_start_matches('-').split([' ', '=']).next()?;
    let value = context(error, ContextKind::InvalidValue)?;
    Some((flag.to_owned(), value.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_from_other_programs_are_rewritten() {
        for (flag, given, meant) in [
            ("size", "200,150", "200x150"),
            ("size", "200x150!", "200x150"),
            ("background", "none", "transparent"),
            ("background", "1,0,0.5", "#ff0080"),
            ("background", "rgb(255, 0, 10)", "#ff000a"),
            ("background", "rgb(255,0,10)", "#ff000a"),
            ("crop", "100x80+10+20", "10,20,100,80"),
            ("eye", "1 2 3", "1,2,3"),
        ] {
            assert_eq!(rewritten(flag, given).unwrap_or_default(), meant, "{flag} {given}");
        }
    }

    #[test]
    fn a_value_follows_its_flag_or_an_equals_sign() {
        let words = ["render", "--bg=red", "--roll", "-30", "-e", "-b"].map(str::to_owned);
        for (word, value) in
            [("--bg", Some("red")), ("--roll", Some("-30")), ("-e", None), ("-b", None)]
        {
            assert_eq!(value_of(word, &words).as_deref(), value, "{word}");
        }
    }
}
