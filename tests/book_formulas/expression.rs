//! Expression trees.

use crate::book_formulas::name::Name;

#[derive(Clone, PartialEq, Debug)]
pub enum Expression {
    Number(f64),
    Name(Name),
    /// A name before a parenthesis: a function such as `R_x(\beta)`, or else a product.
    Applied(Name, Vec<Expression>),
    Negative(Box<Expression>),
    Sum(Box<Expression>, Box<Expression>),
    Difference(Box<Expression>, Box<Expression>),
    Product(ProductSign, Box<Expression>, Box<Expression>),
    Quotient(Box<Expression>, Box<Expression>),
    Power(Box<Expression>, Box<Expression>),
    Transpose(Box<Expression>),
    Function(Function, Vec<Expression>),
    /// Rows of blocks. A list in parentheses is a column.
    Matrix(Vec<Vec<Expression>>),
    IndexedSum {
        index: String,
        from: usize,
        to: usize,
        body: Box<Expression>,
    },
}

/// The notation of a product. Between columns, it distinguishes dot and cross products.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ProductSign {
    Implicit,
    Dot,
    Cross,
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Function {
    Sin,
    Cos,
    Tan,
    Cot,
    Arcsin,
    Arccos,
    Arctan,
    Atan2,
    Sqrt,
    Ln,
    Exp,
    Min,
    Max,
    Determinant,
    Diagonal,
    /// `|x|` and `\lVert v \rVert`.
    Length,
}

impl Function {
    /// Returns the function that `\sin` or `\operatorname{atan2}` denotes.
    pub fn named(name: &str) -> Option<Self> {
        Some(match name {
            "sin" => Self::Sin,
            "cos" => Self::Cos,
            "tan" => Self::Tan,
            "cot" => Self::Cot,
            "arcsin" | "asin" => Self::Arcsin,
            "arccos" | "acos" => Self::Arccos,
            "arctan" | "atan" => Self::Arctan,
            "atan2" => Self::Atan2,
            "ln" => Self::Ln,
            "exp" => Self::Exp,
            "min" => Self::Min,
            "max" => Self::Max,
            "det" => Self::Determinant,
            "diag" => Self::Diagonal,
            _ => return None,
        })
    }
}
