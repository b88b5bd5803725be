//! Output name templates, such as `{stem}_{view}.png` or `frames/{frame:04}.png`.
//!
//! ```text
//! {stem}_{view}.png       fox_front.png
//! frames/{frame:04}.png   frames/0007.png
//! {{{frame}}}.png         {7}.png
//! ```
//! Each command defines its own fields. An unknown field is an error, not literal text, because
//! otherwise a typo would write all pictures to one file.

use std::path::PathBuf;

/// A name with fields in braces; `{{` and `}}` are literal braces.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct NameTemplate {
    /// The pieces of the name, in order; literal pieces are never empty and never adjacent.
    parts: Vec<TemplatePart>,
}

/// A piece of a template, in the order of the name.
#[derive(Clone, PartialEq, Eq, Debug)]
enum TemplatePart {
    /// Literal text, with braces already unescaped.
    Text(String),
    /// A text field, by name.
    Word(&'static str),
    /// A number field, zero-padded to at least this many digits.
    Number(&'static str, usize),
}

/// Returns the error for a counter such as `%04d` (printf, ffmpeg) or `####` (Blender) in a name.
fn counter_of_others(text: &str, number: &str) -> Option<String> {
    let hashes =
        text.find("##").map(|at| at..at + text[at..].chars().take_while(|c| *c == '#').count());
    let printf = text.match_indices('%').find_map(|(at, _)| {
        let digits = text[at + 1..].chars().take_while(char::is_ascii_digit).count();
        let behind = text[at + 1 + digits..].strip_prefix('d')?;
        (!behind.starts_with(char::is_alphanumeric)).then_some(at..at + digits + 2)
    });
    let counter = printf.or(hashes)?;
    // `//` is the model's folder in Blender, but the root of the disk here.
    let before = text[..counter.start].trim_start_matches("//");
    let after = &text[counter.end..];
    let ending = if after.contains('.') { "" } else { ".png" };
    let digits: String = text[counter.clone()].chars().filter(char::is_ascii_digit).collect();
    let digits: usize = digits.parse().ok().filter(|digits| *digits > 0).unwrap_or(4);
    let meant = format!("{before}{{{number}:0{digits}}}{after}{ending}");
    Some(format!(
        "`{}` is not a counter here\n  = help: to write one file per picture, use -o '{meant}'",
        &text[counter]
    ))
}

impl NameTemplate {
    /// Parses a template whose fields may be these `words` and `numbers`.
    ///
    /// The scan finds the next brace, takes the text before it, and then either an escaped brace or
    /// a field up to the next `}`.
    ///
    /// # Errors
    /// Returns an error if a brace is unmatched, if a field is unknown, or if the name contains
    /// another program's counter, `%04d` or `####`. The message lists the known fields.
    pub fn parse(
        text: &str,
        words: &[&'static str],
        numbers: &[&'static str],
    ) -> Result<Self, String> {
        if let Some(field) = numbers.first().and_then(|number| counter_of_others(text, number)) {
            return Err(field);
        }
        let mut parts = Vec::new();
        let mut rest = text;
        while let Some(at) = rest.find(['{', '}']) {
            let (before, brace) = rest.split_at(at);
            push_text(&mut parts, before);
            if let Some(behind) = brace.strip_prefix("{{").or(brace.strip_prefix("}}")) {
                push_text(&mut parts, &brace[..1]);
                rest = behind;
                continue;
            }
            let inside = brace.strip_prefix('{').and_then(|inside| inside.split_once('}'));
            let (field, behind) = inside.ok_or_else(|| {
                format!("unmatched brace in the template {text}\n  = help: write {{{{ and }}}} for braces")
            })?;
            parts.push(parse_field(text, field, words, numbers)?);
            rest = behind;
        }
        push_text(&mut parts, rest);
        Ok(Self { parts })
    }

    /// Returns whether the template has this field.
    ///
    /// Commands use it to distinguish a name for many files from a name for one file.
    #[must_use]
    pub fn has_field(&self, field: &str) -> bool {
        self.parts.iter().any(|part| match part {
            TemplatePart::Text(_) => false,
            TemplatePart::Word(name) | TemplatePart::Number(name, _) => *name == field,
        })
    }

    /// Returns the name with every field replaced by its value.
    ///
    /// Characters that are not valid in a file name become `_`, so that a value cannot point to
    /// another folder. Only the field `{folder}` keeps its `/`.
    #[must_use]
    pub fn expand_fields(
        &self,
        word: impl Fn(&str) -> String,
        number: impl Fn(&str) -> usize,
    ) -> PathBuf {
        let fill = |part: &TemplatePart| match part {
            TemplatePart::Text(text) => text.clone(),
            TemplatePart::Word("folder") => {
                let value = word("folder");
                let parts: Vec<String> = value.split('/').map(sanitize_file_name).collect();
                parts.join("/")
            }
            TemplatePart::Word(name) => sanitize_file_name(&word(name)),
            TemplatePart::Number(name, digits) => format!("{:01$}", number(name), *digits),
        };
        PathBuf::from(self.parts.iter().map(fill).collect::<String>())
    }
}

/// Appends literal text, joined to the text before it.
///
/// Joining keeps equal templates equal: `a{{b` has one part, not three.
fn push_text(parts: &mut Vec<TemplatePart>, text: &str) {
    match parts.last_mut() {
        _ if text.is_empty() => {}
        Some(TemplatePart::Text(last)) => last.push_str(text),
        _ => parts.push(TemplatePart::Text(text.to_owned())),
    }
}

/// Parses the inside of a pair of braces: `NAME`, or `NAME:0N` for `N` digits.
///
/// `N` is from 1 to 9, written with a leading zero as in Rust's format strings; without that zero,
/// numbers would be padded with spaces.
///
/// # Errors
///
/// Returns an error with a fix if the field is unknown, or if a text field has digits.
fn parse_field(
    text: &str,
    field: &str,
    words: &[&'static str],
    numbers: &[&'static str],
) -> Result<TemplatePart, String> {
    let (name, format) =
        field.split_once(':').map_or((field, None), |(name, format)| (name, Some(format)));
    let found = |names: &[&'static str]| names.iter().copied().find(|known| *known == name);
    if let Some(number) = found(numbers) {
        let digits = format.map_or(Some(1), |format| {
            format.strip_prefix('0')?.parse().ok().filter(|digits| (1..=9).contains(digits))
        });
        return digits.map(|digits| TemplatePart::Number(number, digits)).ok_or_else(|| {
            format!("invalid number format `{{{field}}}` in the template {text}\n  = help: write {{{name}}}, or {{{name}:04}} for four digits")
        });
    }
    match (found(words), format) {
        (Some(word), None) => Ok(TemplatePart::Word(word)),
        (Some(_), Some(_)) => Err(format!(
            "the text field `{{{field}}}` in the template {text} allows no digits\n  = help: write {{{name}}}"
        )),
        (None, _) => {
            let known = words.iter().chain(numbers).map(|name| format!("{{{name}}}"));
            let known = known.collect::<Vec<_>>().join(", ");
            Err(format!(
                "unknown field `{{{name}}}` in the template {text}\n  = help: use one of {known}; write {{{{ and }}}} for braces"
            ))
        }
    }
}

/// Makes a value part of a file name: separators and characters that any system forbids become `_`.
///
/// The list follows Windows, which forbids all separators and control characters. The literal text
/// of a template is not changed, because it may name folders.
fn sanitize_file_name(word: &str) -> String {
    let safe = |c: char| if c.is_control() || "/\\:*?\"<>|".contains(c) { '_' } else { c };
    word.chars().map(safe).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn expanded(text: &str) -> Result<String, String> {
        let template = NameTemplate::parse(text, &["stem", "view"], &["frame"])?;
        let path = template.expand_fields(|name| format!("<{name}/a>"), |_| 7);
        Ok(path.to_string_lossy().into_owned())
    }

    #[test]
    fn fields_are_expanded() {
        let all = [
            ("a.png", "a.png"),
            ("{stem}.png", "_stem_a_.png"),
            ("x/{frame:04}_{frame}.png", "x/0007_7.png"),
            ("{{{frame}}}.png", "{7}.png"),
            ("", ""),
        ];
        for (text, expected) in all {
            assert_eq!(expanded(text).as_deref(), Ok(expected), "{text}");
        }
        let template = NameTemplate::parse("{stem}", &["stem"], &[]).expect("a template");
        assert!(template.has_field("stem") && !template.has_field("view"));
    }

    #[test]
    fn counters_of_other_programs_are_rejected() {
        for (name, meant) in [
            ("out.%04d.png", "'out.{frame:04}.png'"),
            ("a_%d.png", "'a_{frame:04}.png'"),
            ("b_####.png", "'b_{frame:04}.png'"),
            ("//b_####", "'b_{frame:04}.png'"),
        ] {
            let message = NameTemplate::parse(name, &[], &["frame"]).unwrap_err();
            assert!(message.contains(meant), "{message}");
        }
        for name in ["100%.png", "#1.png", "50%done.png", "%0.png"] {
            assert!(NameTemplate::parse(name, &[], &["frame"]).is_ok(), "{name}");
        }
    }

    #[test]
    fn malformed_templates_are_rejected() {
        for (text, words) in [
            ("{stem", "unmatched brace"),
            ("stem}", "unmatched brace"),
            ("{stm}", "{stem}, {view}, {frame}"),
            ("{}", "use one of"),
            ("{frame:4}", "{frame:04}"),
            ("{frame:00}", "{frame:04}"),
            ("{stem:04}", "no digits"),
        ] {
            let message = expanded(text).expect_err(text);
            assert!(message.contains(words), "{text}: {message}");
        }
    }
}
