//! Compares a formula with its checks, and proves that the checks catch errors.

use crate::book_formulas::check_line::{Check, parse_check};
use crate::book_formulas::evaluate::evaluate_statement;
use crate::book_formulas::name_parser::is_greek;
use crate::book_formulas::page::Formula;
use crate::book_formulas::registry::all_entries;
use crate::book_formulas::scope::PreparedCheck;
use crate::book_formulas::statement::{Statement, split_rows};
use crate::book_formulas::token::{Token, TokenKind, tokenize};
use std::collections::BTreeSet;
use std::fmt;

/// Results may differ by at most this fraction of the largest entry.
const TOLERANCE: f64 = 1e-12;
/// The result of a damaged formula must differ by more than this, so that a rounding error does not
/// count as a detected change.
const NOTICED: f64 = 1e-9;

/// An error and its line on the page.
#[derive(Clone, PartialEq, Debug)]
pub struct Fault {
    pub line: usize,
    pub id: Option<String>,
    pub message: String,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let id = self.id.as_deref().unwrap_or("formula without id");
        write!(f, "{}: {id}: {}", self.line, self.message)
    }
}

/// Counts of the tested items.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Counts {
    pub numbered: usize,
    pub checks: usize,
    pub damages: usize,
    /// Names in the registry.
    pub names: BTreeSet<String>,
}

/// Finds all errors in a formula and counts the tested items.
pub fn find_faults(formula: &Formula, counts: &mut Counts) -> Vec<Fault> {
    let fault = |line, message| Fault { line, id: formula.id.clone(), message };
    counts.numbered += usize::from(formula.id.is_some());
    if let Some(id) = &formula.id {
        if formula.checks.is_empty() {
            return vec![fault(
                formula.line,
                "a numbered formula has no `% check` line".to_owned(),
            )];
        }
        if !is_known_id(id) {
            return vec![fault(formula.line, format!("no formula has the id `{id}`"))];
        }
    } else if formula.checks.is_empty() {
        return Vec::new();
    }
    let rows = match read_rows(formula) {
        Ok(rows) => rows,
        Err((line, message)) => return vec![fault(line, message)],
    };
    let mut faults = Vec::new();
    let mut checks: Vec<Vec<PreparedCheck>> = rows.iter().map(|_| Vec::new()).collect();
    for check in &formula.checks {
        counts.checks += 1;
        let ready = parse_check(&check.text).and_then(|read| {
            counts.names.extend(read.names().map(str::to_owned));
            let row = row_of(&read, rows.len())?;
            let ready = PreparedCheck::new(&read)?;
            compare(&rows[row - 1].without_left_side(), &ready).map(|()| (row, ready))
        });
        match ready {
            Ok((row, ready)) => checks[row - 1].push(ready),
            Err(message) => faults.push(fault(check.line, message)),
        }
    }
    if faults.is_empty() {
        for (number, (row, checks)) in (1..).zip(rows.iter().zip(&checks)) {
            let messages = test_row(row, number, checks, counts);
            faults.extend(messages.into_iter().map(|message| fault(formula.line, message)));
        }
    }
    faults
}

/// Returns the errors in a row, considering all its checks together.
fn test_row(
    row: &Statement,
    number: usize,
    checks: &[PreparedCheck],
    counts: &mut Counts,
) -> Vec<String> {
    if checks.is_empty() {
        return vec![format!("row {number} has no check")];
    }
    // The left side of an equation is compared if all its names have values.
    let has_left_side = checks.iter().all(|check| evaluate_statement(row, check).is_ok());
    let row = if has_left_side { row.clone() } else { row.without_left_side() };
    for check in checks {
        if let Err(message) = compare(&row, check) {
            return vec![message];
        }
        if let Some(name) = check.unused_name() {
            return vec![format!("the formula does not use `{name}`")];
        }
    }
    damage_row(&row, checks, counts)
}

/// Returns whether a name in the registry has the same part before the first dot as an id.
fn is_known_id(id: &str) -> bool {
    let family = |name| str::split(name, '.').next().unwrap_or_default().to_owned();
    all_entries().any(|entry| family(entry.name) == family(id))
}

fn read_rows(formula: &Formula) -> Result<Vec<Statement>, (usize, String)> {
    let at = |line: usize| formula.line + 1 + line;
    let tokens = tokenize(&formula.latex).map_err(|(line, message)| (at(line), message))?;
    let rows = split_rows(&tokens).map_err(|message| (formula.line, message))?;
    if rows.is_empty() { Err((formula.line, "the formula is empty".to_owned())) } else { Ok(rows) }
}

/// Returns the row to which a check applies.
fn row_of(check: &Check, count: usize) -> Result<usize, String> {
    match check.row {
        None if count == 1 => Ok(1),
        None => Err(format!("the formula has {count} rows; write `% check row 1 …`")),
        Some(row) if row <= count => Ok(row),
        Some(row) => Err(format!("the formula has no row {row}, only {count}")),
    }
}

fn compare(row: &Statement, check: &PreparedCheck) -> Result<(), String> {
    for value in evaluate_statement(row, check)? {
        if !value.is_close(&check.expected, TOLERANCE) {
            let expected = &check.expected;
            return Err(if value.shape() == expected.shape() {
                format!("the formula gives\n    {value}, but the crates give\n    {expected}")
            } else {
                let (ours, theirs) = (value.describe(), expected.describe());
                format!(
                    "the formula gives {ours}, {value}, but the crates give {theirs}, {expected}"
                )
            });
        }
    }
    Ok(())
}

/// Changes each number, sign, letter and angle function of a row, one at a time. Each change must
/// be detected by some check.
fn damage_row(row: &Statement, checks: &[PreparedCheck], counts: &mut Counts) -> Vec<String> {
    let mut letters: Vec<TokenKind> = Vec::new();
    for token in row.members().iter().flatten().filter(|token| is_letter(&token.kind)) {
        if !letters.contains(&token.kind) {
            letters.push(token.kind.clone());
        }
    }
    let mut unnoticed = Vec::new();
    for (member, tokens) in row.members().iter().enumerate() {
        for (at, token) in tokens.iter().enumerate() {
            for kind in damage(&token.kind, &letters) {
                counts.damages += 1;
                let damaged = Token { kind, line: token.line };
                let changed = row.with_token(member, at, damaged.clone());
                if !checks.iter().any(|check| notices(check, &changed)) {
                    unnoticed.push(describe_damage(tokens, at, &damaged));
                }
            }
        }
    }
    unnoticed
}

/// Returns the replacements for a token: a different number, sign or angle function, or each of the
/// other letters in the row.
fn damage(kind: &TokenKind, letters: &[TokenKind]) -> Vec<TokenKind> {
    match kind {
        TokenKind::Number(number) => vec![TokenKind::Number(number + 1.0)],
        TokenKind::Symbol('+') => vec![TokenKind::Symbol('-')],
        TokenKind::Symbol('-') => vec![TokenKind::Symbol('+')],
        TokenKind::Command(name) if other_function(name).is_some() => other_function(name)
            .map(|other| TokenKind::Command(other.to_owned()))
            .into_iter()
            .collect(),
        _ if is_letter(kind) => letters.iter().filter(|letter| *letter != kind).cloned().collect(),
        _ => Vec::new(),
    }
}

fn other_function(name: &str) -> Option<&'static str> {
    Some(match name {
        "sin" => "cos",
        "cos" => "sin",
        "tan" => "cot",
        "cot" => "tan",
        _ => return None,
    })
}

fn is_letter(kind: &TokenKind) -> bool {
    match kind {
        TokenKind::Letter(_) => true,
        TokenKind::Command(name) => is_greek(name),
        _ => false,
    }
}

fn notices(check: &PreparedCheck, changed: &Statement) -> bool {
    match evaluate_statement(changed, check) {
        Ok(values) => values.iter().any(|value| !value.is_close(&check.expected, NOTICED)),
        Err(_) => true,
    }
}

fn describe_damage(tokens: &[Token], at: usize, damaged: &Token) -> String {
    let text = |token: &Token| match &token.kind {
        TokenKind::Number(number) => number.to_string(),
        TokenKind::Letter(letter) => letter.to_string(),
        TokenKind::Command(name) => format!("\\{name} "),
        TokenKind::Symbol(symbol) => symbol.to_string(),
    };
    let join = |tokens: &[Token]| tokens.iter().map(text).collect::<String>();
    let (before, after) =
        (&tokens[at.saturating_sub(8)..at], &tokens[at + 1..tokens.len().min(at + 9)]);
    format!(
        "no check detects {} for {} in `{}«{}»{}`; choose other values or add a check",
        text(damaged),
        text(&tokens[at]),
        join(before),
        text(&tokens[at]),
        join(after)
    )
}

#[cfg(test)]
mod tests {
    use super::{Counts, find_faults};
    use crate::book_formulas::page::find_formulas;

    fn faults(block: &str) -> Vec<String> {
        let formulas = find_formulas(&format!("```formula {block}\n```\n"));
        let found = find_faults(&formulas[0], &mut Counts::default());
        found.iter().map(ToString::to_string).collect()
    }

    #[test]
    fn correct_formulas_pass() {
        let p = "P = \\begin{bmatrix} n & 0 & 0 & 0 \\\\ 0 & n & 0 & 0 \\\\ 0 & 0 & n+f & -fn \\\\ \
                 0 & 0 & 1 & 0 \\end{bmatrix}";
        let none: [&str; 0] = [];
        assert_eq!(faults(&format!("PE-1\n{p}\n% check n=-2 f=-5 : PE-1")), none);
        assert_eq!(
            faults(&format!("PE-1\n{p}\n% check N=2 F=5 : PE-1")),
            ["3: PE-1: `n` has no value in the check line"]
        );
        assert_eq!(faults("PE-1\nA = n + f\n% check n=-2 f=-5 : PE-1[2][2]"), none);
        let product = "PE-2\nM_{per} = M_{orth} P\n% check M_{orth}=OR-1 P=PE-1 l=-1 r=3 b=-2 t=4 n=-2 f=-5 : PE-2";
        assert_eq!(faults(product), none);
        let identity = "HO-1\n(\\frac{x}{w}, y/w, z/w) = \\frac{1}{w} (x, y, z)\n% check x=2 y=3 z=4 w=5 : HO-1";
        assert_eq!(faults(identity), none);
        assert_eq!(faults("\nanything \\foo"), none);
    }

    #[test]
    fn errors_name_their_line() {
        let wrong = [
            (
                "GL-1.A\nA = \\frac{F+N}{F-N}\n% check N=2 F=5 : GL-1.A",
                "3: GL-1.A: the formula gives",
            ),
            ("PE-1\nP = n", "1: PE-1: a numbered formula has no"),
            ("matrix\nP = n\n% check n=1 : matrix", "1: matrix: no formula has the id"),
            ("PE-1\nP = n\n% check n=1 : PE-1.depht", "3: PE-1: unknown name `PE-1.depht`"),
            (
                "LI-1\ny = x\n% check x=2 q=4 a=3 b=5 c=7 d=9 : LI-1",
                "3: LI-1: LI-1 has no variable `q`",
            ),
            (
                "HO-1\n(x, y/w, z/w) = \\frac{1}{w} (x, y, z)\n% check x=2 y=3 z=4 w=5 : HO-1",
                "1: HO-1: the formula gives",
            ),
            ("HO-4\n\n\\foo\n% check t_x=2 t_y=3 t_z=4 : HO-4", "4: HO-4: "),
            (
                "HO-1\n(x, y, z, 1)\n% check x=2 y=3 z=4 w=5 : HO-1",
                "3: HO-1: the formula gives a column of 4",
            ),
            (
                "GL-1\n\\begin{aligned} A &= -\\frac{F+N}{F-N} \\\\ B &= N \\end{aligned}\n% check row 1 N=2 F=5 : GL-1.A",
                "1: GL-1: row 2 has no check",
            ),
        ];
        for (block, start) in wrong {
            let found = faults(block);
            assert!(found.first().is_some_and(|first| first.starts_with(start)), "{found:?}");
        }
    }

    #[test]
    fn checks_that_miss_a_change_are_errors() {
        // At x = a, the factor has no effect.
        let line =
            "LI-1\ny = c + 2 (x - a) \\frac{d - c}{2 (b - a)}\n% check x=2 a=2 b=5 c=3 d=7 : LI-1";
        let blind = faults(line);
        assert!(blind.iter().any(|fault| fault.contains("no check detects 3 for 2")), "{blind:?}");
        assert!(faults(&format!("{line}\n% check x=4 a=2 b=5 c=3 d=9 : LI-1")).is_empty());
        let equal = "WI-2\ns = \\frac{H - L}{h - l}\n% check l=2 h=6 L=2 H=5 : WI-2.scale";
        assert!(faults(equal).iter().any(|fault| fault.contains("no check detects l for L")));
    }
}
