//! What is wrong with the text of a scene file, in words: what the parser found, what it wanted, and what to do.

use core::ops::Range;
use ron::error::Error as Code;
use serde_path_to_error::Path;

const SAMPLE: &str = "a scene looks like this: Scene(models: [(path: \"model.glb\")])";

/// What is wrong and, where it can be told, what to do. `at` is the place in `source` that the error points at.
pub(super) fn explain_parse_error(
    code: &Code,
    path: Option<&Path>,
    source: &str,
    at: &Range<usize>,
) -> (String, Option<String>) {
    let place = path.map(ToString::to_string).filter(|path| path != "." && path != "?");
    let at_place =
        |what: &str| place.as_ref().map_or(what.to_owned(), |p| format!("`{p}`: {what}"));
    match code {
        Code::ExpectedFloat => {
            (at_place("expected a number"), help("numbers stand by themselves, such as 1.5"))
        }
        Code::ExpectedInteger => (at_place("expected a whole number"), help("such as 4")),
        Code::IntegerOutOfBounds => {
            (at_place("expected a whole number from 0 to 4294967295"), help("such as 4"))
        }
        Code::ExpectedBoolean => (at_place("expected true or false"), None),
        Code::ExpectedString => {
            (at_place("expected a text"), help("texts stand in quotation marks: \"like this\""))
        }
        Code::ExpectedArray => (
            at_place("expected a list"),
            help("lists stand in square brackets, also those of one element: [ … ]"),
        ),
        Code::ExpectedIdentifier => {
            let asked = place.as_ref().map(|place| {
                format!("`alberti scene doc {place}` lists the words that are possible")
            });
            (at_place("expected one of several words, without quotation marks"), asked)
        }
        Code::ExpectedNamedStructLike(_) if !ends(source, at) => {
            let name = place.as_ref().and(struct_name(code));
            name.map_or(("this is no scene".to_owned(), help(SAMPLE)), |name| {
                let write = format!("write {name}(…), or just (…), with its fields inside");
                (at_place(&format!("expected `{name}`")), Some(write))
            })
        }
        Code::InvalidValueForType { expected, found } => {
            (at_place(&format!("expected {expected}, found {}", plain(found))), None)
        }
        Code::Message(message) => (at_place(message), None),
        _ => name_fault(code)
            .or_else(|| grammar_fault(code, source, at))
            .unwrap_or_else(|| (at_place(&lower_first(&code.to_string())), None)),
    }
}

/// A fault of a name: a field or a variant that is not there, is missing, or is there twice.
fn name_fault(code: &Code) -> Option<(String, Option<String>)> {
    Some(match code {
        Code::NoSuchStructField { expected, found, outer } => {
            let owner = outer.as_ref().map_or(String::new(), |outer| format!(" in `{outer}`"));
            (format!("unexpected field `{found}`{owner}"), suggest_name(found, expected))
        }
        Code::NoSuchEnumVariant { expected, found, outer } => {
            let owner = outer.as_ref().map_or(String::new(), |outer| format!(" for `{outer}`"));
            (format!("unexpected `{found}`{owner}"), suggest_name(found, expected))
        }
        Code::MissingStructField { field, outer } => {
            let owner = outer.as_ref().map_or(String::new(), |outer| format!(" of `{outer}`"));
            (format!("the field `{field}`{owner} is missing"), Some(format!("add `{field}: …`")))
        }
        Code::DuplicateStructField { field, .. } => {
            (format!("the field `{field}` is there twice"), help("remove one of them"))
        }
        Code::ExpectedDifferentStructName { expected, found } => (
            format!("expected `{expected}`, found `{found}`"),
            Some(format!("write {expected}(…), or just (…)")),
        ),
        Code::SuggestRawIdentifier(found) | Code::InvalidIdentifier(found) => (
            format!("expected the name of a field, found `{found}`"),
            help("a field is written `name: value`; numbers have a decimal point and no comma"),
        ),
        _ => return None,
    })
}

/// A fault of commas, colons, brackets and quotation marks.
fn grammar_fault(code: &Code, source: &str, at: &Range<usize>) -> Option<(String, Option<String>)> {
    let rest = &source[at.start.min(source.len())..];
    let open = || open_bracket(&source[..at.start.min(source.len())]);
    Some(match code {
        Code::Eof | Code::ExpectedNamedStructLike(_) if source.trim().is_empty() => {
            ("the file is empty".into(), help(SAMPLE))
        }
        Code::Eof | Code::ExpectedNamedStructLike(_) => {
            // The last bracket may be the one that the error points at.
            let open = open_bracket(source)
                .map(|(bracket, line)| format!("close the `{bracket}` of line {line}"));
            ("the file ends too early".into(), open.or(help(SAMPLE)))
        }
        Code::ExpectedComma | Code::ExpectedArrayEnd | Code::ExpectedStructLikeEnd => {
            let found = rest.chars().next();
            let advice = match (found, open()) {
                (Some(')' | ']' | '}'), Some((bracket, line))) => {
                    format!("the `{bracket}` of line {line} is closed by `{}`", partner(bracket))
                }
                (Some(c), _) if c.is_ascii_digit() || c == '.' => {
                    "whole numbers have no decimal point; fields and elements are parted by commas"
                        .into()
                }
                _ => "put a comma before it: fields and elements are parted by commas".into(),
            };
            ("expected a comma or a closing bracket here".into(), Some(advice))
        }
        Code::ExpectedMapColon => {
            ("expected a colon here".into(), help("a field is written `name: value`"))
        }
        Code::ExpectedStringEnd => {
            ("the text that begins here has no end".into(), help("close it with a quotation mark"))
        }
        Code::UnclosedBlockComment => {
            ("the comment that begins here has no end".into(), help("close it with */"))
        }
        Code::TrailingCharacters => (
            "there is something behind the scene's last bracket".into(),
            help("a file has one scene: put it inside of the brackets, or remove it"),
        ),
        Code::ExceededRecursionLimit => (
            "the brackets are nested too deeply".into(),
            help("no field of a scene needs that many"),
        ),
        _ => return None,
    })
}

/// Whether nothing but blanks stands from a place on.
fn ends(source: &str, at: &Range<usize>) -> bool {
    source.get(at.start..).is_none_or(|rest| rest.trim().is_empty())
}

#[allow(clippy::unnecessary_wraps, reason = "it stands where a help may be missing")]
fn help(text: &str) -> Option<String> {
    Some(text.to_owned())
}

fn struct_name(code: &Code) -> Option<&'static str> {
    match code {
        Code::ExpectedNamedStructLike(name) if !name.is_empty() => Some(name),
        _ => None,
    }
}

/// What serde calls a value, without its words for kinds of numbers.
fn plain(found: &str) -> &str {
    let kinds = [
        "the unsigned integer ",
        "the signed integer ",
        "the floating point number ",
        "the string ",
    ];
    kinds.iter().find_map(|kind| found.strip_prefix(kind)).unwrap_or(found)
}

fn partner(bracket: char) -> char {
    match bracket {
        '[' => ']',
        '{' => '}',
        _ => ')',
    }
}

/// The innermost bracket that is open at the end of a text, and its line.
fn open_bracket(text: &str) -> Option<(char, usize)> {
    let mut open = Vec::new();
    let mut line = 1;
    for token in super::format::tokens(text) {
        line += token.line_breaks_before;
        match (token.kind, token.text.chars().next()) {
            (super::format::TokenKind::Open, Some(bracket)) => open.push((bracket, line)),
            (super::format::TokenKind::Close, _) => drop(open.pop()),
            _ => {}
        }
        line += token.text.matches('\n').count();
    }
    open.pop()
}

fn lower_first(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or(String::new(), |first| first.to_lowercase().chain(chars).collect())
}

/// "Did you mean", or the list of what is possible.
pub(super) fn suggest_name<S: AsRef<str>>(found: &str, expected: &[S]) -> Option<String> {
    let likeness = |name: &str| strsim::jaro_winkler(&found.to_lowercase(), &name.to_lowercase());
    let best =
        expected.iter().map(AsRef::as_ref).max_by(|a, b| likeness(a).total_cmp(&likeness(b)))?;
    if likeness(best) > 0.8 {
        return Some(format!("did you mean `{best}`?"));
    }
    let names: Vec<String> = expected.iter().map(|name| format!("`{}`", name.as_ref())).collect();
    Some(format!("possible here: {}", names.join(", ")))
}
