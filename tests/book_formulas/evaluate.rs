//! Evaluates expressions.

use crate::book_formulas::expression::{Expression, Function, ProductSign};
use crate::book_formulas::name::Name;
use crate::book_formulas::parser::parse_expression;
use crate::book_formulas::statement::Statement;
use crate::book_formulas::token::Token;
use crate::book_formulas::value::Value;
use homog::{Affine, Vector, World};

/// The values of names.
pub trait Scope {
    /// Returns the value of a name, or an error if it has none.
    fn value_of(&self, name: &Name) -> Result<Value, String>;
}

/// Returns the values of a row: one for each member of an equation, or one for an inequality.
pub fn evaluate_statement(statement: &Statement, scope: &dyn Scope) -> Result<Vec<Value>, String> {
    match statement {
        Statement::Values { members, .. } => {
            members.iter().map(|member| evaluate_tokens(member, scope)).collect()
        }
        Statement::Inequality(members, are_less) => {
            let values: Vec<Value> = members
                .iter()
                .map(|member| evaluate_tokens(member, scope))
                .collect::<Result<_, _>>()?;
            let fulfilled = values.windows(2).zip(are_less).map(|(pair, &is_less)| {
                if is_less { pair[1].minus(&pair[0]) } else { pair[0].minus(&pair[1]) }
            });
            let column = fulfilled.reduce(|above, below| above?.above(&below?));
            Ok(vec![column.ok_or("an inequality must have two sides")??])
        }
    }
}

fn evaluate_tokens(tokens: &[Token], scope: &dyn Scope) -> Result<Value, String> {
    evaluate(&parse_expression(tokens)?, scope)
}

/// Evaluates an expression.
///
/// # Errors
/// Returns an error if a name has no value, shapes do not match, or a result is not finite.
pub fn evaluate(expression: &Expression, scope: &dyn Scope) -> Result<Value, String> {
    use Expression as E;
    let at = |inner: &Expression| evaluate(inner, scope);
    let value = match expression {
        E::Number(number) => Value::number(*number),
        E::Name(name) => scope.value_of(name)?,
        E::Applied(name, arguments) => apply(name, arguments, scope)?,
        E::Negative(inner) => at(inner)?.map(|entry| -entry),
        E::Sum(a, b) => at(a)?.plus(&at(b)?)?,
        E::Difference(a, b) => at(a)?.minus(&at(b)?)?,
        E::Product(ProductSign::Implicit, a, b) => at(a)?.times(&at(b)?)?,
        E::Product(ProductSign::Dot, a, b) => at(a)?.dot(&at(b)?)?,
        E::Product(ProductSign::Cross, a, b) => at(a)?.cross(&at(b)?)?,
        E::Quotient(a, b) => at(a)?.divided_by(&at(b)?)?,
        E::Power(base, exponent) => power(&at(base)?, at(exponent)?.to_number()?)?,
        E::Transpose(inner) => at(inner)?.transpose(),
        E::Function(function, arguments) => {
            call(*function, &arguments.iter().map(at).collect::<Result<Vec<_>, _>>()?)?
        }
        E::Matrix(rows) => assemble(rows, scope)?,
        E::IndexedSum { index, from, to, body } => {
            let terms = (*from..=*to)
                .map(|number| evaluate(body, &IndexedScope { outer: scope, index, number }));
            terms.reduce(|sum, term| sum?.plus(&term?)).ok_or("an empty sum")??
        }
    };
    if value.is_finite() { Ok(value) } else { Err("a value is not finite".to_owned()) }
}

/// The scope of the body of a sum: replaces an index in a subscript with its value.
struct IndexedScope<'a> {
    outer: &'a dyn Scope,
    index: &'a str,
    number: usize,
}

impl Scope for IndexedScope<'_> {
    fn value_of(&self, name: &Name) -> Result<Value, String> {
        self.outer.value_of(&name.with_index(self.index, self.number))
    }
}

/// Joins the blocks of each row, and then the rows.
fn assemble(rows: &[Vec<Expression>], scope: &dyn Scope) -> Result<Value, String> {
    let rows = rows.iter().map(|row| {
        let blocks = row.iter().map(|entry| evaluate(entry, scope));
        blocks.reduce(|left, right| left?.beside(&right?)).ok_or("an empty row")?
    });
    rows.reduce(|above: Result<Value, String>, below| above?.above(&below?)).ok_or("no row")?
}

/// Computes an integer power of a number or matrix, or any power of a positive number.
fn power(base: &Value, exponent: f64) -> Result<Value, String> {
    if let (Ok(number), true) = (base.to_number(), exponent.fract() != 0.0 || exponent > 8.0) {
        return Ok(Value::number(libm::pow(number, exponent)));
    }
    let Some(count) = (0..=8_u8).find(|&count| f64::from(count) == exponent.abs()) else {
        return Err(format!("unsupported exponent {exponent}"));
    };
    let base = if exponent < 0.0 { base.inverse()? } else { base.clone() };
    let [size, columns] = base.shape();
    if size != columns {
        return Err(format!("unsupported power of {}", base.describe()));
    }
    (0..count).try_fold(Value::diagonal(&vec![1.0; size]), |power, _| power.times(&base))
}

/// Evaluates `R_x(\beta)`, `T(\mathbf t)` or `S(s_x, s_y, s_z)`, unless the name has a value.
fn apply(name: &Name, arguments: &[Expression], scope: &dyn Scope) -> Result<Value, String> {
    let values: Vec<Value> =
        arguments.iter().map(|argument| evaluate(argument, scope)).collect::<Result<_, _>>()?;
    let column = values.iter().cloned().reduce(|a, b| a.above(&b).unwrap_or(a));
    let column = column.ok_or("empty parentheses")?;
    if let Ok(factor) = scope.value_of(name) {
        return factor.times(&column);
    }
    let map: Affine<World, World> = match (name.to_string().as_str(), column.entries()) {
        ("R_x", [angle]) => Affine::rotation_x(*angle),
        ("R_y", [angle]) => Affine::rotation_y(*angle),
        ("R_z", [angle]) => Affine::rotation_z(*angle),
        ("T", [x, y, z]) => Affine::translation(Vector::new(*x, *y, *z)),
        ("S", [x, y, z]) => Affine::scale(*x, *y, *z),
        ("T", [x, y]) => {
            return Ok(Value::matrix([[1.0, 0.0, *x], [0.0, 1.0, *y], [0.0, 0.0, 1.0]]));
        }
        ("S", [x, y]) => return Ok(Value::diagonal(&[*x, *y, 1.0])),
        _ => {
            return Err(format!(
                "`{name}` has no value and is not a function of {} numbers",
                values.len()
            ));
        }
    };
    Ok(map.into())
}

fn call(function: Function, arguments: &[Value]) -> Result<Value, String> {
    match (function, arguments) {
        (Function::Length, [value]) => return value.length(),
        (Function::Determinant, [value]) => return value.determinant(),
        _ => {}
    }
    let numbers: Vec<f64> = arguments.iter().map(Value::to_number).collect::<Result<_, _>>()?;
    if function == Function::Diagonal {
        return Ok(Value::diagonal(&numbers));
    }
    let number = match (function, &numbers[..]) {
        (Function::Sin, [x]) => libm::sin(*x),
        (Function::Cos, [x]) => libm::cos(*x),
        (Function::Tan, [x]) => libm::tan(*x),
        (Function::Cot, [x]) => 1.0 / libm::tan(*x),
        (Function::Arcsin, [x]) => libm::asin(*x),
        (Function::Arccos, [x]) => libm::acos(*x),
        (Function::Arctan, [x]) => libm::atan(*x),
        (Function::Atan2, [y, x]) => libm::atan2(*y, *x),
        (Function::Sqrt, [x]) => x.sqrt(),
        (Function::Ln, [x]) => libm::log(*x),
        (Function::Exp, [x]) => libm::exp(*x),
        (Function::Min, [x, y]) => x.min(*y),
        (Function::Max, [x, y]) => x.max(*y),
        _ => return Err(format!("{function:?} does not have {} arguments", numbers.len())),
    };
    Ok(Value::number(number))
}

#[cfg(test)]
mod tests {
    use super::{Scope, evaluate_statement};
    use crate::book_formulas::name::Name;
    use crate::book_formulas::statement::split_rows;
    use crate::book_formulas::token::tokenize;
    use crate::book_formulas::value::Value;

    /// A scope with a = 2, b = 3 …, the vectors p = (1, 2, 3) and q = (4, 5, 7), λ0 = 10 and λ1 = 20.
    struct Letters;

    impl Scope for Letters {
        fn value_of(&self, name: &Name) -> Result<Value, String> {
            let numbers = [("a", 2.0), ("b", 3.0), ("x_e", 5.0), ("z'", 7.0), ("theta", 0.25)];
            let more = [("lambda_0", 10.0), ("lambda_1", 20.0), ("x_{wmin}", 11.0)];
            let key = name.key().to_string();
            match key.as_str() {
                "\\mathbf{p}" => Ok(Value::column(&[1.0, 2.0, 3.0])),
                "\\mathbf{q}" => Ok(Value::column(&[4.0, 5.0, 7.0])),
                _ => {
                    let mut all = numbers.iter().chain(&more);
                    let found = all.find(|(letter, _)| *letter == key);
                    Ok(Value::number(found.ok_or(format!("no {key}"))?.1))
                }
            }
        }
    }

    fn values(latex: &str) -> Result<Vec<Value>, String> {
        let tokens = tokenize(latex).map_err(|(_, message)| message)?;
        evaluate_statement(&split_rows(&tokens)?[0].without_left_side(), &Letters)
    }

    fn number(latex: &str) -> f64 {
        values(latex).unwrap()[0].to_number().unwrap()
    }

    #[test]
    fn products_take_precedence_over_sums() {
        assert_eq!(number("f(x) = 2ab - \\frac{b}{a} b + (-a^2)"), 3.5);
        assert_eq!(number("a - (b - z') / a"), 4.0);
        assert_eq!(number("a \\cdot -b"), -6.0);
        assert_eq!(number("\\frac12 x_{e} + x_{w,\\min}"), 13.5);
    }

    #[test]
    fn functions_apply_to_one_factor() {
        let (sine, cosine) = (libm::sin(0.5), libm::cos(0.25));
        assert_eq!(number("\\sin 2\\theta"), sine);
        assert_eq!(number("\\cos\\theta a"), cosine * 2.0);
        assert_eq!(number("\\cos^2\\theta"), cosine * cosine);
        assert_eq!(number("\\tan(\\theta/2)"), libm::tan(0.125));
        assert_eq!(number("\\operatorname{atan2}(a, -b)"), libm::atan2(2.0, -3.0));
        assert_eq!(number("\\sqrt{a^2 + 12} + |a - b|b"), 7.0);
    }

    #[test]
    fn vectors_have_products_and_lengths() {
        assert_eq!(number("\\mathbf p \\cdot (\\mathbf{q} - \\mathbf p)"), 21.0);
        assert_eq!(number("\\lVert \\mathbf{p} \\times \\mathbf q\\rVert^2"), 35.0);
        assert_eq!(number("\\mathbf{p}^T \\mathbf{q}"), 35.0);
        assert_eq!(number("\\sum_{i=0}^{1} \\lambda_i a + a"), 62.0);
    }

    #[test]
    fn matrices_columns_and_powers_are_evaluated() {
        let product = "\\begin{bmatrix} 1 & 0 \\\\ a & 2 \\end{bmatrix} (3, b) = (3, 12)";
        assert_eq!(values(product).unwrap()[0], Value::column(&[3.0, 12.0]));
        let inverse = "x = \\begin{pmatrix} 2 & 0 \\\\ 0 & 4 \\end{pmatrix}^{-1} = \\operatorname{diag}(1/2, 1/4)";
        let both = values(inverse).unwrap();
        assert!(both[0].is_close(&both[1], 1e-15));
        let blocks = "\\begin{bmatrix} \\mathbf p & \\mathbf q \\\\ 0 & 1 \\end{bmatrix}";
        assert_eq!(values(blocks).unwrap()[0].shape(), [4, 2]);
    }

    #[test]
    fn the_value_of_an_inequality_is_its_margin() {
        assert_eq!(values("-b \\le a \\le b").unwrap()[0], Value::column(&[5.0, 1.0]));
        assert_eq!(number("a - b \\ge 0"), -1.0);
        assert_eq!(number("a < b"), 1.0);
    }

    #[test]
    fn unknown_names_and_invalid_syntax_are_errors() {
        for wrong in
            ["\\foo a", "a/b a", "c", "(a, b", "\\frac{a}", "a b)", "|a", "a \\text{ b}", ""]
        {
            assert!(values(&format!("y = {wrong}")).is_err(), "{wrong}");
        }
        assert!(values("y = a < b").is_err());
        assert!(values("\\begin{bmatrix} 1 & 2 \\\\ 3 \\end{bmatrix}").is_err());
    }

    #[test]
    fn rows_of_aligned_equations_are_separate() {
        let latex = "\\begin{aligned} x' &= a + b \\\\ y' &= b, \\\\[2pt] &= 4 \\end{aligned}.";
        let rows = split_rows(&tokenize(latex).unwrap()).unwrap();
        assert_eq!(rows.len(), 3);
        let all = rows.iter().map(|row| {
            evaluate_statement(&row.without_left_side(), &Letters).unwrap()[0].to_number()
        });
        assert_eq!(all.collect::<Result<Vec<_>, _>>(), Ok(vec![5.0, 3.0, 4.0]));
    }
}
