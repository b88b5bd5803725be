//! Rows of a formula, and the members of their equations and inequalities.

use crate::book_formulas::token::Token;

/// One row of a formula.
#[derive(Clone, PartialEq, Debug)]
pub enum Statement {
    /// The members of an equation, or the whole row if it has no relation. Every member must
    /// evaluate to the value being checked, except that the first may be the left side, which in
    /// most equations is only a name.
    Values { members: Vec<Vec<Token>>, has_left_side: bool },
    /// The members, and the relations between them: `true` for ≤ and `false` for ≥. The value is
    /// the margin of each relation: the larger side minus the smaller side.
    Inequality(Vec<Vec<Token>>, Vec<bool>),
}

impl Statement {
    pub fn members(&self) -> &[Vec<Token>] {
        match self {
            Self::Values { members, .. } | Self::Inequality(members, _) => members,
        }
    }

    /// Returns the statement without the left side of an equation, which has no value if it is a
    /// name.
    pub fn without_left_side(&self) -> Self {
        match self {
            Self::Values { members, has_left_side: true } => {
                Self::Values { members: members[1..].to_vec(), has_left_side: false }
            }
            _ => self.clone(),
        }
    }

    /// Creates a copy with one token replaced.
    pub fn with_token(&self, member: usize, at: usize, token: Token) -> Self {
        let mut changed = self.clone();
        match &mut changed {
            Self::Values { members, .. } | Self::Inequality(members, _) => {
                members[member][at] = token;
            }
        }
        changed
    }
}

/// Returns the rows of `\begin{aligned}`, or the only row of any other formula.
pub fn split_rows(tokens: &[Token]) -> Result<Vec<Statement>, String> {
    let rows = split_at(strip_environment(tokens), |token| token.is_command("\\"));
    let rows = rows.iter().map(|(row, _)| trim_row(row));
    rows.filter(|row| !row.is_empty()).map(|row| split_members(&row)).collect()
}

/// Returns the tokens between `\begin{aligned}` and its end.
fn strip_environment(tokens: &[Token]) -> &[Token] {
    let word = |tokens: &[Token]| {
        tokens
            .iter()
            .filter_map(|token| match token.kind {
                crate::book_formulas::token::TokenKind::Letter(letter) => Some(letter),
                _ => None,
            })
            .collect::<String>()
    };
    let end = tokens.iter().rposition(|token| !token.is_symbol('.') && !token.is_symbol(','));
    let tokens = &tokens[..end.map_or(0, |end| end + 1)];
    let closing = |tokens: &[Token]| tokens.iter().position(|token| token.is_symbol('}'));
    let (Some(first), Some(open)) = (tokens.first(), closing(tokens)) else { return tokens };
    let kind = word(&tokens[..open]);
    let is_known = ["aligned", "gathered", "split", "align", "gather"].contains(&kind.as_str());
    let last = tokens.iter().rposition(|token| token.is_command("end"));
    match last {
        Some(last) if first.is_command("begin") && is_known => &tokens[open + 1..last],
        _ => tokens,
    }
}

/// Returns the tokens without alignment marks and the final period.
fn trim_row(row: &[Token]) -> Vec<Token> {
    let mut depth = 0_i32;
    let mut kept = Vec::new();
    for token in row {
        depth += depth_change(token);
        if depth > 0 || !token.is_symbol('&') {
            kept.push(token.clone());
        }
    }
    while kept.last().is_some_and(|token| token.is_symbol('.') || token.is_symbol(',')) {
        kept.pop();
    }
    kept
}

fn depth_change(token: &Token) -> i32 {
    let is_any = |symbols: &str| symbols.chars().any(|symbol| token.is_symbol(symbol));
    if is_any("({[") || token.is_command("begin") {
        1
    } else if is_any(")}]") || token.is_command("end") {
        -1
    } else {
        0
    }
}

/// Returns the parts between separators outside brackets, with the separator after each part.
fn split_at(
    tokens: &[Token],
    is_separator: impl Fn(&Token) -> bool,
) -> Vec<(&[Token], Option<&Token>)> {
    let (mut depth, mut start) = (0, 0);
    let mut parts = Vec::new();
    for (at, token) in tokens.iter().enumerate() {
        depth += depth_change(token);
        if depth == 0 && is_separator(token) {
            parts.push((&tokens[start..at], Some(token)));
            start = at + 1;
        }
    }
    parts.push((&tokens[start..], None));
    parts
}

fn is_equality(token: &Token) -> bool {
    let commands = ["mapsto", "longmapsto", "to", "rightarrow", "coloneqq", "approx", "equiv"];
    token.is_symbol('=') || commands.iter().any(|name| token.is_command(name))
}

/// Returns whether a token is an arrow or `\coloneqq`, whose left side is not evaluated.
fn is_assignment(token: &Token) -> bool {
    let is_equation = ["approx", "equiv"].iter().any(|name| token.is_command(name));
    is_equality(token) && !token.is_symbol('=') && !is_equation
}

fn is_less(token: &Token) -> bool {
    token.is_symbol('<') || ["le", "leq", "lt"].iter().any(|name| token.is_command(name))
}

fn is_greater(token: &Token) -> bool {
    token.is_symbol('>') || ["ge", "geq", "gt"].iter().any(|name| token.is_command(name))
}

fn split_members(row: &[Token]) -> Result<Statement, String> {
    let parts = split_at(row, |token| is_equality(token) || is_less(token) || is_greater(token));
    let members = |from: usize| parts[from..].iter().map(|(part, _)| part.to_vec()).collect();
    let relations: Vec<&Token> = parts.iter().filter_map(|(_, relation)| *relation).collect();
    let equalities = relations.iter().filter(|token| is_equality(token)).count();
    if relations.is_empty() {
        Ok(Statement::Values { members: members(0), has_left_side: false })
    } else if is_assignment(relations[0]) && equalities == relations.len() {
        Ok(Statement::Values { members: members(1), has_left_side: false })
    } else if equalities == relations.len() {
        Ok(Statement::Values { members: members(0), has_left_side: true })
    } else if equalities == 0 {
        Ok(Statement::Inequality(
            members(0),
            relations.iter().map(|token| is_less(token)).collect(),
        ))
    } else {
        Err("a row has both = and an inequality".to_owned())
    }
}
