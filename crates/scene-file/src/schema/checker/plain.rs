//! Checks values without named parts: numbers, strings, booleans and tuples.

use super::Checker;
use crate::number::unnamed_group;
use crate::schema::ValueType;
use crate::syntax::{
    Group, Node, NodeKind, SyntaxItem, parse_integer, parse_number, unescape_string,
};

impl Checker<'_> {
    /// Reads any number; `expected` describes the allowed numbers.
    ///
    /// A number in quotation marks gets a special hint. Infinities and NaN are parsed here and
    /// rejected by the range check.
    pub(crate) fn read_number(&mut self, node: &Node<'_>, expected: &str) -> Option<f64> {
        if let NodeKind::Number(word) = node.kind {
            let number = parse_number(word);
            if number.is_none() {
                let help = self.suggest_fraction(word, expected);
                let help = help.unwrap_or_else(|| "write numbers like 4, -1.5 or 2e-3".to_owned());
                self.report_type(node, expected, Some(help));
            }
            return number;
        }
        let help = match node.kind {
            NodeKind::String(_) => "write numbers without quotation marks, such as 1.5",
            _ => "write numbers like 4, -1.5 or 2e-3",
        };
        self.report_type(node, expected, Some(help.to_owned()));
        None
    }

    /// Returns the correction for a number with a percent sign: just the number, or a fraction.
    fn suggest_fraction(&self, word: &str, expected: &str) -> Option<String> {
        let percent = word.strip_suffix('%')?;
        let number = parse_number(percent)?;
        if self.innermost_field()?.ends_with("_percent") {
            return Some(format!("write {percent}"));
        }
        let is_fraction = expected == "a number from 0 to 1";
        is_fraction.then(|| format!("write {}", number / 100.0))
    }

    /// Checks a whole number from 0 to 2³² − 1.
    ///
    /// Like RON, it accepts decimal, hexadecimal, octal and binary numbers with underscores. `4.0`
    /// is rejected with a hint to drop the decimal point.
    pub(crate) fn check_whole_number(node: &Node<'_>, checker: &mut Checker<'_>) {
        let help = || Some("write a whole number such as 4".to_owned());
        let NodeKind::Number(word) = node.kind else {
            return checker.report_type(node, "a whole number", help());
        };
        let Some(value) = parse_integer(word) else {
            let help = Some("write a whole number such as 4, without a decimal point".to_owned());
            return checker.report_type(node, "a whole number", help);
        };
        if u32::try_from(value).is_err() {
            checker.report_type(node, &format!("a whole number from 0 to {}", u32::MAX), help());
        }
    }

    /// Reads a number that `check` accepts; `expected` describes those numbers.
    pub(crate) fn check_number<T>(
        &mut self,
        node: &Node<'_>,
        expected: &str,
        check: fn(f64) -> Option<T>,
    ) {
        let Some(value) = self.read_number(node, expected) else { return };
        if check(value).is_none() {
            self.report_value(node, &format!("expected {expected}, found {value}"), None);
        }
    }

    /// Checks for `true` or `false`.
    pub(crate) fn check_bool(node: &Node<'_>, checker: &mut Checker<'_>) {
        if !matches!(node.kind, NodeKind::Word("true" | "false")) {
            checker.report_type(node, "true or false", None);
        }
    }

    /// Checks for a string.
    pub(crate) fn check_string(node: &Node<'_>, checker: &mut Checker<'_>) {
        checker.read_string(node);
    }

    /// Returns the text of a string literal, without quotation marks and with its escapes decoded.
    pub(crate) fn read_string(&mut self, node: &Node<'_>) -> Option<String> {
        let NodeKind::String(literal) = node.kind else {
            let written = match node.kind {
                NodeKind::Word(word) | NodeKind::Number(word) => word.trim_matches('\''),
                _ => "like this",
            };
            let help = format!("write strings in double quotation marks: \"{written}\"");
            self.report_type(node, "a string", Some(help));
            return None;
        };
        match unescape_string(literal) {
            Ok(text) => Some(text),
            Err((offset, problem)) => {
                let start = node.span.start + offset;
                let help = "or write a raw string, which has no escapes: r\"C:\\path\"".to_owned();
                self.report(start..start + 1, problem, Some(help));
                None
            }
        }
    }

    /// Checks a tuple: values of these types in either kind of brackets.
    pub(super) fn check_tuple(&mut self, node: &Node<'_>, parts: &[ValueType]) {
        let Some(items) = tuple_items(node, parts.len(), self) else { return };
        for (index, (item, part)) in items.iter().zip(parts).enumerate() {
            self.check_element(index, item, part);
        }
    }
}

/// Suggests a tuple for a value that is not one: the numbers in `"320x240"` and `"1:20"`, or a
/// single number where two are expected.
fn suggest_tuple(node: &Node<'_>, count: usize, checker: &Checker<'_>) -> Option<String> {
    let parts: Vec<&str> = match node.kind {
        NodeKind::String(text) => {
            text.trim_matches('"').split(['x', '×', ':', ',', '/', '*']).map(str::trim).collect()
        }
        NodeKind::Number(number) if count == 2 => match checker.innermost_field() {
            Some("scale") => vec!["1", number],
            _ => vec![number, number],
        },
        _ if count == 4 => {
            return Some(
                "write (0, 0, 0.5, 0.5), for example: left, top, width and height".to_owned(),
            );
        }
        _ => return None,
    };
    let is_number = |part: &&str| parse_number(part).is_some();
    let fits = parts.len() == count && parts.iter().all(is_number);
    fits.then(|| format!("write ({})", parts.join(", ")))
}

impl Checker<'_> {
    /// Suggests all three axes for grid counts and steps along only two.
    pub(crate) fn suggest_three_axes(&self, group: &Group<'_>) -> Option<String> {
        let [x, z] = group.items.as_slice() else { return None };
        let (NodeKind::Number(x), NodeKind::Number(z)) = (&x.value.kind, &z.value.kind) else {
            return None;
        };
        let height = match self.innermost_field()? {
            "count" => "1",
            "step" => "0",
            _ => return None,
        };
        Some(format!("set x, y and z, where y is up; on the ground, write ({x}, {height}, {z})"))
    }
}

/// Returns the elements of a tuple of `count` values. Either kind of brackets is accepted, because
/// people write vectors both ways.
fn tuple_items<'n, 'a>(
    node: &'n Node<'a>,
    count: usize,
    checker: &mut Checker<'_>,
) -> Option<&'n [SyntaxItem<'a>]> {
    let group = unnamed_group(node);
    let expected = format!("{count} values in brackets");
    let Some(group) = group else {
        checker.report_type(node, &expected, suggest_tuple(node, count, checker));
        return None;
    };
    if group.items.len() != count {
        let problem = format!("expected {expected}, found {}", group.items.len());
        let help = checker.suggest_three_axes(group);
        checker.report_value(node, &problem, help);
        return None;
    }
    Some(&group.items)
}
