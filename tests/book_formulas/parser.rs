//! Parses LaTeX expressions.
//!
//! An expression is a sum of products of factors; adjacent factors are multiplied. A function
//! applies to one factor, which may begin with a number: `\sin 2\theta`. No factor may follow `a/b`
//! without a sign, because readers disagree on its meaning.

use crate::book_formulas::expression::{Expression, Function, ProductSign};
use crate::book_formulas::name_parser;
use crate::book_formulas::token::{Token, TokenKind};

type Parsed = Result<Expression, String>;

/// Parses all tokens as one expression.
pub fn parse_expression(tokens: &[Token]) -> Parsed {
    let mut parser = Parser { tokens, at: 0, closing_bars: Vec::new() };
    let expression = parser.sum()?;
    match parser.next_token() {
        None => Ok(expression),
        Some(token) => Err(format!("unexpected {}", describe(token))),
    }
}

pub struct Parser<'a> {
    pub tokens: &'a [Token],
    pub at: usize,
    /// The tokens that close the open bars: the second bar in `|a b|` closes the first.
    closing_bars: Vec<TokenKind>,
}

/// Returns a token as shown in error messages.
pub fn describe(token: &Token) -> String {
    match &token.kind {
        TokenKind::Number(number) => format!("`{number}`"),
        TokenKind::Letter(letter) => format!("`{letter}`"),
        TokenKind::Command(name) => format!("`\\{name}`"),
        TokenKind::Symbol(symbol) => format!("`{symbol}`"),
    }
}

impl Parser<'_> {
    pub fn next_token(&self) -> Option<&Token> {
        self.tokens.get(self.at)
    }

    pub fn is_at(&self, symbol: char) -> bool {
        self.next_token().is_some_and(|token| token.is_symbol(symbol))
    }

    pub fn is_at_command(&self, name: &str) -> bool {
        self.next_token().is_some_and(|token| token.is_command(name))
    }

    pub fn take(&mut self, symbol: char) -> bool {
        let is_there = self.is_at(symbol);
        self.at += usize::from(is_there);
        is_there
    }

    pub fn take_command(&mut self, name: &str) -> bool {
        let is_there = self.is_at_command(name);
        self.at += usize::from(is_there);
        is_there
    }

    pub fn expect(&mut self, symbol: char) -> Result<(), String> {
        if self.take(symbol) {
            return Ok(());
        }
        let found = self.next_token().map_or("the end".to_owned(), describe);
        Err(format!("expected `{symbol}`, found {found}"))
    }

    fn sum(&mut self) -> Parsed {
        let mut sum = if self.take('-') {
            Expression::Negative(self.product()?.into())
        } else {
            self.take('+');
            self.product()?
        };
        loop {
            if self.take('+') {
                sum = Expression::Sum(sum.into(), self.product()?.into());
            } else if self.take('-') {
                sum = Expression::Difference(sum.into(), self.product()?.into());
            } else {
                return Ok(sum);
            }
        }
    }

    fn product(&mut self) -> Parsed {
        let mut product = self.factor()?;
        let mut follows_slash = false;
        loop {
            let sign = if self.take('/') {
                product = Expression::Quotient(product.into(), self.signed_factor()?.into());
                follows_slash = true;
                continue;
            } else if self.take_command("cdot") || self.take('*') {
                ProductSign::Dot
            } else if self.take_command("times") {
                ProductSign::Cross
            } else if self.begins_factor() {
                if follows_slash {
                    return Err("a factor follows a/b; write \\frac{a}{b}".to_owned());
                }
                ProductSign::Implicit
            } else {
                return Ok(product);
            };
            let factor = match sign {
                ProductSign::Implicit => self.factor()?,
                _ => self.signed_factor()?,
            };
            product = Expression::Product(sign, product.into(), factor.into());
            follows_slash = false;
        }
    }

    /// Parses a factor after `/` or a multiplication sign; the factor may be negative.
    fn signed_factor(&mut self) -> Parsed {
        if self.take('-') {
            return Ok(Expression::Negative(self.factor()?.into()));
        }
        self.factor()
    }

    fn begins_factor(&self) -> bool {
        self.next_token().is_some_and(|token| match &token.kind {
            TokenKind::Number(_) | TokenKind::Letter(_) => true,
            bar if self.closing_bars.last() == Some(bar) => false,
            TokenKind::Symbol(symbol) => "([{|".contains(*symbol),
            TokenKind::Command(name) => {
                !["end", "\\", "rvert", "rVert", "rbrace"].contains(&name.as_str())
            }
        })
    }

    /// Parses a primary expression with its exponents.
    fn factor(&mut self) -> Parsed {
        let mut factor = self.primary()?;
        while self.take('^') {
            factor = self.raised(factor)?;
        }
        Ok(factor)
    }

    fn raised(&mut self, base: Expression) -> Parsed {
        let start = self.at;
        if self.takes_transpose() {
            return Ok(Expression::Transpose(base.into()));
        }
        self.at = start;
        Ok(Expression::Power(base.into(), self.argument()?.into()))
    }

    /// Returns whether the exponent is a transpose: `T`, `\top` or `\mathsf{T}`, with or without
    /// braces.
    fn takes_transpose(&mut self) -> bool {
        if self.take('{') {
            return self.takes_transpose() && self.take('}');
        }
        if self.take_command("mathsf") || self.take_command("mathrm") || self.take_command("mathbf")
        {
            return self.takes_transpose();
        }
        let is_letter = |token: &Token| token.kind == TokenKind::Letter('T');
        let is_there = self.is_at_command("top") || self.next_token().is_some_and(is_letter);
        self.at += usize::from(is_there);
        is_there
    }

    /// Parses a group in braces or a single token, the argument of `\frac` and `^`.
    fn argument(&mut self) -> Parsed {
        if !self.take('{') {
            return self.primary();
        }
        let inner = self.sum()?;
        self.expect('}')?;
        Ok(inner)
    }

    fn primary(&mut self) -> Parsed {
        let Some(token) = self.next_token() else {
            return Err("unexpected end of the formula".into());
        };
        match token.kind.clone() {
            TokenKind::Number(number) => {
                self.at += 1;
                Ok(Expression::Number(number))
            }
            TokenKind::Symbol('{') => self.argument(),
            TokenKind::Symbol(opening @ ('(' | '[')) => self.parenthesis(opening),
            TokenKind::Symbol('|') => self.length(&TokenKind::Symbol('|')),
            TokenKind::Letter(_) => self.variable(),
            TokenKind::Command(name) => self.command(&name),
            TokenKind::Symbol(_) => Err(format!("unexpected {}", describe(token))),
        }
    }

    /// Parses an expression in parentheses, or a column `(a, b, c)`.
    fn parenthesis(&mut self, opening: char) -> Parsed {
        let mut entries = self.list(opening)?;
        match entries.len() {
            1 => Ok(entries.remove(0)),
            _ => Ok(Expression::Matrix(entries.into_iter().map(|entry| vec![entry]).collect())),
        }
    }

    fn list(&mut self, opening: char) -> Result<Vec<Expression>, String> {
        self.expect(opening)?;
        let bars = std::mem::take(&mut self.closing_bars);
        let mut entries = vec![self.sum()?];
        while self.take(',') {
            entries.push(self.sum()?);
        }
        self.expect(if opening == '(' { ')' } else { ']' })?;
        self.closing_bars = bars;
        Ok(entries)
    }

    fn length(&mut self, closing: &TokenKind) -> Parsed {
        self.at += 1;
        self.closing_bars.push(closing.clone());
        let inner = self.sum()?;
        self.closing_bars.pop();
        match self.next_token() {
            Some(token) if token.kind == *closing => self.at += 1,
            _ => return Err("unclosed bar".to_owned()),
        }
        Ok(Expression::Function(Function::Length, vec![inner]))
    }

    fn variable(&mut self) -> Parsed {
        let name = name_parser::parse_name(self)?;
        let is_function = matches!(name.base.as_str(), "R" | "T" | "S") && self.is_at('(');
        if is_function {
            return Ok(Expression::Applied(name, self.list('(')?));
        }
        Ok(Expression::Name(name))
    }

    fn command(&mut self, name: &str) -> Parsed {
        if name_parser::begins_name(name) {
            return self.variable();
        }
        self.at += 1;
        match name {
            "frac" | "tfrac" | "dfrac" => {
                let numerator = self.argument()?;
                Ok(Expression::Quotient(numerator.into(), self.argument()?.into()))
            }
            "sqrt" => Ok(Expression::Function(Function::Sqrt, vec![self.argument()?])),
            "pi" => Ok(Expression::Number(std::f64::consts::PI)),
            "begin" => self.matrix(),
            "sum" => self.indexed_sum(),
            "underbrace" => {
                let inner = self.argument()?;
                name_parser::skip_subscript(self)?;
                Ok(inner)
            }
            "lvert" | "lVert" | "|" => {
                self.at -= 1;
                let closing = if name == "|" { "|".to_owned() } else { name.replace('l', "r") };
                self.length(&TokenKind::Command(closing))
            }
            "operatorname" => {
                let word = name_parser::read_word(self)?;
                let function = Function::named(&word);
                self.function(function.ok_or(format!("unknown \\operatorname{{{word}}}"))?)
            }
            _ => match Function::named(name) {
                Some(function) => self.function(function),
                None => Err(format!("unknown command `\\{name}` in a checked formula")),
            },
        }
    }

    fn function(&mut self, function: Function) -> Parsed {
        let exponent = if self.take('^') { Some(self.argument()?) } else { None };
        let arguments = if self.is_at('(') { self.list('(')? } else { vec![self.one_factor()?] };
        let value = Expression::Function(function, arguments);
        Ok(match exponent {
            Some(exponent) => Expression::Power(value.into(), exponent.into()),
            None => value,
        })
    }

    /// Parses the argument of a function without parentheses: `\theta`, `2\theta`,
    /// `\frac{\theta}{2}`.
    fn one_factor(&mut self) -> Parsed {
        let first = self.factor()?;
        let is_number = matches!(first, Expression::Number(_));
        if is_number && self.begins_factor() && !self.is_at('(') {
            let second = self.factor()?;
            return Ok(Expression::Product(ProductSign::Implicit, first.into(), second.into()));
        }
        Ok(first)
    }

    /// Parses the part after `\begin`: `{bmatrix} a & b \\ c & d \end{bmatrix}`.
    fn matrix(&mut self) -> Parsed {
        let kind = name_parser::read_word(self)?;
        if !["bmatrix", "pmatrix", "matrix", "smallmatrix"].contains(&kind.as_str()) {
            return Err(format!("unknown \\begin{{{kind}}}"));
        }
        let bars = std::mem::take(&mut self.closing_bars);
        let mut rows = vec![vec![self.sum()?]];
        loop {
            if self.take('&') {
                let entry = self.sum()?;
                rows.last_mut().ok_or("no row")?.push(entry);
            } else if self.take_command("\\") {
                if !self.is_at_command("end") {
                    rows.push(vec![self.sum()?]);
                }
            } else if self.take_command("end") {
                break;
            } else {
                let found = self.next_token().map_or("the end".to_owned(), describe);
                return Err(format!("unexpected {found} in a matrix"));
            }
        }
        if name_parser::read_word(self)? != kind {
            return Err(format!("\\begin{{{kind}}} has a different \\end"));
        }
        self.closing_bars = bars;
        Ok(Expression::Matrix(rows))
    }

    /// Parses the part after `\sum`: `_{i=0}^{2} body`, where the body is the rest of the product.
    fn indexed_sum(&mut self) -> Parsed {
        let form = "a sum must have the form \\sum_{i=0}^{2}";
        self.expect('_')?;
        self.expect('{')?;
        let Some(TokenKind::Letter(index)) = self.next_token().map(|token| token.kind.clone())
        else {
            return Err(form.to_owned());
        };
        self.at += 1;
        self.expect('=')?;
        let from = self.bound()?;
        self.expect('}')?;
        self.expect('^')?;
        let braced = self.take('{');
        let to = self.bound()?;
        if braced {
            self.expect('}')?;
        }
        if to - from > 16 {
            return Err(form.to_owned());
        }
        let body = self.product()?.into();
        Ok(Expression::IndexedSum { index: index.to_string(), from, to, body })
    }

    fn bound(&mut self) -> Result<usize, String> {
        let Some(TokenKind::Number(number)) = self.next_token().map(|token| token.kind.clone())
        else {
            return Err("the bounds of a sum must be numbers".to_owned());
        };
        self.at += 1;
        (0..100).find(|&whole| whole as f64 == number).ok_or("a bound must be 0, 1, 2 …".to_owned())
    }
}
