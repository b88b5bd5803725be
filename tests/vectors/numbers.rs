//! Reads numbers, points and matrices from vector files, and compares our results with theirs.

use glam::{DMat4, DVec4};
use serde_json::Value;
use std::fmt::Display;

/// The tolerance for f64 code, from the README of the vectors.
pub const TOLERANCE: f64 = 1e-12;

/// Parses a number. `"NaN"`, `"inf"` and `"-inf"` are strings in the files, because JSON has no
/// such numbers.
pub fn parse_number(value: &Value) -> Result<f64, String> {
    match value {
        Value::String(name) if ["NaN", "inf", "-inf"].contains(&name.as_str()) => {
            name.parse().map_err(|error| format!("{name}: {error}"))
        }
        _ => value.as_f64().ok_or_else(|| format!("{value} is not a number")),
    }
}

/// Returns the number in the field `name`.
pub fn number_field(object: &Value, name: &str) -> Result<f64, String> {
    parse_number(&object[name]).map_err(|error| format!("{name}: {error}"))
}

/// Returns the whole number in the field `name`, as a count.
pub fn count_field(object: &Value, name: &str) -> Result<u32, String> {
    let count = object[name].as_u64().and_then(|count| count.try_into().ok());
    count.ok_or_else(|| format!("{name}: {} is not a count", object[name]))
}

/// Returns the string in the field `name`.
pub fn text_field<'a>(object: &'a Value, name: &str) -> Result<&'a str, String> {
    object[name].as_str().ok_or_else(|| format!("{name}: {} is not a string", object[name]))
}

/// Returns the items of a list.
pub fn parse_array(value: &Value) -> Result<&[Value], String> {
    value.as_array().map(Vec::as_slice).ok_or_else(|| format!("{value} is not a list"))
}

/// Returns the items of two lists of the same length, side by side.
pub fn zip_arrays<'a>(
    ours: &'a Value,
    theirs: &'a Value,
) -> Result<impl Iterator<Item = (&'a Value, &'a Value)>, String> {
    let (ours, theirs) = (parse_array(ours)?, parse_array(theirs)?);
    if ours.len() != theirs.len() {
        return Err(format!("the case has {} inputs but {} outputs", ours.len(), theirs.len()));
    }
    Ok(ours.iter().zip(theirs))
}

/// Parses a list of exactly `N` numbers.
pub fn parse_numbers<const N: usize>(value: &Value) -> Result<[f64; N], String> {
    let numbers = parse_array(value)?.iter().map(parse_number).collect::<Result<Vec<_>, _>>()?;
    numbers.try_into().map_err(|_| format!("{value} is not a list of {N} numbers"))
}

/// Parses a point or vector (x, y, z).
pub fn parse_point(value: &Value) -> Result<[f64; 3], String> {
    parse_numbers(value)
}

/// Parses a homogeneous point (x, y, z, w).
pub fn parse_point4(value: &Value) -> Result<[f64; 4], String> {
    parse_numbers(value)
}

/// Parses a 4×4 matrix from a list of rows.
pub fn parse_matrix(value: &Value) -> Result<DMat4, String> {
    let rows: Vec<[f64; 4]> =
        parse_array(value)?.iter().map(parse_numbers).collect::<Result<_, _>>()?;
    let rows: [[f64; 4]; 4] =
        rows.try_into().map_err(|_| format!("{value} is not a list of four rows"))?;
    Ok(DMat4::from_cols_array_2d(&rows).transpose())
}

/// Checks that |ours − theirs| ≤ tolerance · max(1, |theirs|).
pub fn assert_close(name: &str, ours: f64, theirs: f64, tolerance: f64) -> Result<(), String> {
    let allowed = tolerance * theirs.abs().max(1.0);
    if (ours - theirs).abs() <= allowed {
        return Ok(());
    }
    Err(format!("{name} is {ours:?}, not {theirs:?}: off by {:e}", (ours - theirs).abs()))
}

/// Compares ours with theirs, number by number.
pub fn assert_all_close(
    name: &str,
    ours: &[f64],
    theirs: &[f64],
    tolerance: f64,
) -> Result<(), String> {
    if ours.len() != theirs.len() {
        return Err(format!("{name} has {} numbers, not {}", ours.len(), theirs.len()));
    }
    let mut pairs = ours.iter().zip(theirs).enumerate();
    pairs.try_for_each(|(i, (&a, &b))| assert_close(&format!("{name}[{i}]"), a, b, tolerance))
}

/// Compares ours with theirs, entry by entry.
pub fn assert_matrix_close(
    name: &str,
    ours: DMat4,
    theirs: DMat4,
    tolerance: f64,
) -> Result<(), String> {
    for row in 0..4 {
        let [a, b]: [DVec4; 2] = [ours.row(row), theirs.row(row)];
        assert_all_close(&format!("{name}[{row}]"), &a.to_array(), &b.to_array(), tolerance)?;
    }
    Ok(())
}

/// Compares a result with an expectation that may be a rejection (`{"error": …}`, with any code).
/// `check` receives the result if one is expected.
pub fn compare_outcome<T, E: Display>(
    ours: Result<T, E>,
    out: &Value,
    check: impl FnOnce(T) -> Result<(), String>,
) -> Result<(), String> {
    match (ours, out.get("error")) {
        (Err(_), Some(_)) => Ok(()),
        (Ok(_), Some(code)) => Err(format!("must be rejected: {code}")),
        (Err(error), None) => Err(format!("is rejected: {error}")),
        (Ok(ours), None) => check(ours),
    }
}
