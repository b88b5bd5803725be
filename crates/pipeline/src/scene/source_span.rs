//! Finds the place of a value in the text of a RON file, so that an error can point at it.
//!
//! RON gives positions for faults of grammar only. What is wrong by meaning (a missing file, near beyond far) is known by
//! its path, such as `models`, 0, `path`; this walks the text along such a path. It reads text that has been
//! parsed before, so it need not judge, only find; where it cannot follow it stops at the last value it found.

use core::ops::Range;

/// A step into a value.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum PathStep<'a> {
    /// The field of a struct or of an enum's variant.
    Field(&'a str),
    /// The element of a list or tuple, from 0.
    Index(usize),
}

/// The bytes of the value at the end of `path`, or of the last value on the way that is there.
pub(crate) fn span_of(source: &str, path: &[PathStep<'_>]) -> Range<usize> {
    follow(source, path).0
}

/// Whether there is a value at the end of `path`.
pub(crate) fn has_value(source: &str, path: &[PathStep<'_>]) -> bool {
    follow(source, path).1
}

/// Whether the whole scene has a field of this name in its own text.
pub(crate) fn has_field(source: &str, field: &str) -> bool {
    follow(source, &[PathStep::Field(field)]).1
}

/// The last value on the path that is there, and whether it is the one at the path's end.
fn follow(source: &str, path: &[PathStep<'_>]) -> (Range<usize>, bool) {
    let mut walker = Walker { source, at: 0 };
    walker.skip_attributes();
    let mut value = walker.value();
    for step in path {
        match walker.step_into(&value, *step) {
            Some(inner) => value = inner,
            None => return (value, false),
        }
    }
    (value, true)
}

struct Walker<'a> {
    source: &'a str,
    at: usize,
}

impl Walker<'_> {
    fn rest(&self) -> &str {
        &self.source[self.at..]
    }

    fn peek(&self) -> Option<char> {
        self.rest().chars().next()
    }

    fn eat(&mut self, expected: char) -> bool {
        self.skip_blanks();
        let found = self.peek() == Some(expected);
        if found {
            self.at += expected.len_utf8();
        }
        found
    }

    fn skip_while(&mut self, wanted: impl Fn(char) -> bool) {
        let rest = self.rest();
        self.at += rest.find(|c| !wanted(c)).unwrap_or(rest.len());
    }

    /// Skips white space and both kinds of comment.
    fn skip_blanks(&mut self) {
        loop {
            self.skip_while(char::is_whitespace);
            let rest = self.rest();
            if rest.starts_with("//") {
                self.skip_while(|c| c != '\n');
            } else if rest.starts_with("/*") {
                self.at += rest.find("*/").map_or(rest.len(), |end| end + 2);
            } else {
                return;
            }
        }
    }

    /// Skips `#![enable(…)]` lines at the top.
    fn skip_attributes(&mut self) {
        self.skip_blanks();
        while self.rest().starts_with("#!") {
            self.skip_while(|c| c != '\n');
            self.skip_blanks();
        }
    }

    fn skip_name(&mut self) {
        self.skip_while(|c| c.is_alphanumeric() || "_.+-#".contains(c));
    }

    fn skip_string(&mut self) {
        self.at += 1;
        let rest = self.rest();
        let mut escaped = false;
        let end = rest.find(|c| {
            let ends = c == '"' && !escaped;
            escaped = c == '\\' && !escaped;
            ends
        });
        self.at += end.map_or(rest.len(), |end| end + 1);
    }

    /// Moves past the value that begins here and returns its bytes.
    fn value(&mut self) -> Range<usize> {
        self.skip_blanks();
        let start = self.at;
        if self.peek() == Some('"') {
            self.skip_string();
            return start..self.at;
        }
        self.skip_name();
        let mut end = self.at;
        self.skip_blanks();
        if matches!(self.peek(), Some('(' | '[' | '{')) {
            self.skip_group();
            end = self.at;
        }
        self.at = end;
        start..end
    }

    /// Moves past a bracketed group; the brackets match, for the text has been parsed.
    fn skip_group(&mut self) {
        let mut depth = 0;
        while let Some(next) = self.peek() {
            match next {
                '"' => {
                    self.skip_string();
                    continue;
                }
                '(' | '[' | '{' => depth += 1,
                ')' | ']' | '}' => depth -= 1,
                _ => {}
            }
            self.at += next.len_utf8();
            if depth == 0 {
                return;
            }
            self.skip_blanks();
        }
    }

    /// The part of `value` that `step` names.
    fn step_into(&mut self, value: &Range<usize>, step: PathStep<'_>) -> Option<Range<usize>> {
        self.at = value.start;
        self.skip_name();
        if !(self.eat('(') || self.eat('[') || self.eat('{')) {
            return None;
        }
        for index in 0.. {
            self.skip_blanks();
            if self.at >= value.end - 1 {
                return None;
            }
            let first = self.value();
            let (name, inner) =
                if self.eat(':') { (Some(first), self.value()) } else { (None, first) };
            let found = match step {
                PathStep::Index(wanted) => wanted == index,
                PathStep::Field(wanted) => name.is_some_and(|name| &self.source[name] == wanted),
            };
            if found {
                return Some(inner);
            }
            if !self.eat(',') {
                return None;
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use PathStep::{Field, Index};

    const SOURCE: &str = r#"#![enable(implicit_some)]
// A scene (with a bracket in a comment.
Scene(
    models: [Model(path: "a\"(b.glb"), (path: "c.glb", translate: (1, -2.5, 3))],
    camera: (view: LookAt(eye: (4, 3, 6), /* up: */ target: [0, 1, 0])),
    style: Flat,
)"#;

    fn found(path: &[PathStep<'_>]) -> &'static str {
        &SOURCE[span_of(SOURCE, path)]
    }

    #[test]
    fn values_are_found_by_their_path() {
        assert_eq!(found(&[Field("models"), Index(0), Field("path")]), r#""a\"(b.glb""#);
        assert_eq!(found(&[Field("models"), Index(1), Field("translate"), Index(1)]), "-2.5");
        assert_eq!(found(&[Field("camera"), Field("view"), Field("target")]), "[0, 1, 0]");
        assert_eq!(found(&[Field("style")]), "Flat");
    }

    #[test]
    fn a_path_that_leads_nowhere_ends_at_the_last_value_on_it() {
        let up = found(&[Field("camera"), Field("view"), Field("up")]);
        assert!(up.starts_with("LookAt(") && up.ends_with("[0, 1, 0])"), "{up}");
        assert_eq!(found(&[Field("style"), Index(3)]), "Flat");
        assert_eq!(found(&[Field("models"), Index(7)]).chars().next(), Some('['));
    }

    #[test]
    fn fields_of_the_whole_scene_are_there_or_not() {
        let there =
            ["models", "camera", "style", "view", "lights"].map(|field| has_field(SOURCE, field));
        assert_eq!(there, [true, true, true, false, false]);
    }

    #[test]
    fn broken_text_does_not_break_it() {
        for cut in 0..SOURCE.len() {
            let _ = span_of(&SOURCE[..cut], &[Field("camera"), Field("view"), Field("target")]);
        }
    }
}
