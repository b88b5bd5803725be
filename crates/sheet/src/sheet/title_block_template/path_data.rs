//! Paths of straight lines: the SVG commands M, L, H, V and Z, absolute and relative.

use super::TemplateError;
use glam::DVec2;

/// The largest coordinate in millimeters, far larger than any sheet of paper.
const MAX_COORDINATE: f64 = 1e5;

/// Points, and whether the line through the points is closed.
pub(super) type Line = (Vec<DVec2>, bool);

/// Parses a finite number up to [`MAX_COORDINATE`].
pub(super) fn parse_number(text: &str) -> Option<f64> {
    let number: f64 = text.trim().parse().ok()?;
    (number.abs() <= MAX_COORDINATE).then_some(number)
}

/// Splits a list into words, which are numbers and command letters, with the byte positions where
/// they begin.
///
/// Numbers may be separated by whitespace or commas. A sign or a second decimal point also begins a
/// new number, as in the output of drawing programs.
fn words(text: &str, start: usize) -> Vec<(&str, usize)> {
    let mut words = Vec::new();
    let bytes = text.as_bytes();
    let mut at = 0;
    while at < bytes.len() {
        let begin = at;
        let c = bytes[at];
        if c.is_ascii_whitespace() || c == b',' {
            at += 1;
            continue;
        }
        let is_number = |c: u8| c.is_ascii_digit() || matches!(c, b'+' | b'-' | b'.');
        // Take a whole character, so that slices end at character boundaries.
        at += text[at..].chars().next().map_or(1, char::len_utf8);
        if is_number(c) {
            let mut has_point = c == b'.';
            while let Some(next) = bytes.get(at) {
                let is_exponent = matches!(next, b'e' | b'E');
                let is_sign = matches!(next, b'+' | b'-') && matches!(bytes[at - 1], b'e' | b'E');
                if *next == b'.' && has_point
                    || !(next.is_ascii_digit() || *next == b'.' || is_exponent || is_sign)
                {
                    break;
                }
                has_point |= *next == b'.';
                at += 1;
            }
        }
        words.push((&text[begin..at], start + begin));
    }
    words
}

/// Parses the numbers in an attribute. Returns an empty list if the attribute is missing.
pub(super) fn parse_numbers(
    source: &str,
    attribute: Option<(&str, usize)>,
) -> Result<Vec<f64>, TemplateError> {
    let Some((text, start)) = attribute else { return Ok(Vec::new()) };
    let number = |(word, at): (&str, usize)| {
        parse_number(word)
            .ok_or_else(|| TemplateError::at(source, at, format!("`{word}` is not a number")))
    };
    words(text, start).into_iter().map(number).collect()
}

/// Parses the path in an attribute into lines.
pub(super) fn parse_path(
    source: &str,
    attribute: Option<(&str, usize)>,
) -> Result<Vec<Line>, TemplateError> {
    let Some((text, start)) = attribute else { return Ok(Vec::new()) };
    let mut lines: Vec<Line> = Vec::new();
    let (mut pen, mut command) = (DVec2::ZERO, None);
    let mut words = words(text, start).into_iter().peekable();
    while let Some(&(word, at)) = words.peek() {
        let fault = |message: String| TemplateError::at(source, at, message);
        if let Some(letter) = word.chars().next().filter(char::is_ascii_alphabetic) {
            words.next();
            command = Some(letter);
            if letter.eq_ignore_ascii_case(&'z') {
                let line =
                    lines.last_mut().ok_or_else(|| fault("a path must begin with M".to_owned()))?;
                line.1 = true;
                pen = line.0[0];
                command = None;
                continue;
            }
        }
        let mut number = || {
            let Some((word, at)) = words.next() else {
                let end = start + text.len();
                return Err(TemplateError::at(source, end, "missing number at the end".to_owned()));
            };
            parse_number(word).ok_or_else(|| {
                TemplateError::at(source, at, format!("missing number before `{word}`"))
            })
        };
        let letter = command.ok_or_else(|| fault(format!("`{word}` does not follow a command")))?;
        let origin = if letter.is_ascii_lowercase() { pen } else { DVec2::ZERO };
        let to = match letter.to_ascii_uppercase() {
            'M' | 'L' => origin + DVec2::new(number()?, number()?),
            'H' => DVec2::new(origin.x + number()?, pen.y),
            'V' => DVec2::new(pen.x, origin.y + number()?),
            _ => {
                let remedy = "use straight lines: M, L, H, V and Z";
                return Err(fault(format!("the command `{letter}` is not supported; {remedy}")));
            }
        };
        if letter.eq_ignore_ascii_case(&'m') {
            lines.push((vec![to], false));
            // Additional points after M are lines.
            command = Some(if letter == 'm' { 'l' } else { 'L' });
        } else {
            match lines.last_mut() {
                None => return Err(fault("a path must begin with M".to_owned())),
                // After Z, the next line begins where the previous line began.
                Some((_, true)) => lines.push((vec![pen, to], false)),
                Some((points, false)) => points.push(to),
            }
        }
        pen = to;
    }
    Ok(lines)
}
