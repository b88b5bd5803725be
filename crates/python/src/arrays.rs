//! Validated Python arrays: numbers of any dtype and strides, converted to C order. NumPy itself
//! makes the array contiguous and casts it. Objects that cannot be read, and values that are not
//! real numbers, cause an error that names the argument.

use crate::failure::{Failure, Fallible};
use numpy::{Element, PyArray1, PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::exceptions::PyException;
use pyo3::prelude::*;

/// An array in C order.
pub(crate) struct Numbers<T> {
    /// The length along each axis.
    pub(crate) shape: Vec<usize>,
    /// The elements; the last axis varies fastest.
    pub(crate) values: Vec<T>,
}

/// Reads real numbers from an argument, as f32 or f64.
///
/// # Errors
/// Returns an error if it is not an array of numbers.
pub(crate) fn real_array<T: Element + Copy>(
    name: &str,
    value: &Bound<'_, PyAny>,
    dtype: &str,
) -> PyResult<Numbers<T>> {
    read_array(name, value, "fiu", dtype)
}

/// Reads integers from an argument.
///
/// # Errors
/// Returns an error if it is not an array of integers.
pub(crate) fn integer_array(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Numbers<i64>> {
    read_array(name, value, "iu", "int64")
}

/// Reads bytes from an argument with dtype uint8.
///
/// # Errors
/// Returns an error if the dtype is different.
pub(crate) fn byte_array(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Numbers<u8>> {
    let dtype = as_array(name, value)?.getattr("dtype")?.str()?.to_string();
    if dtype != "uint8" {
        return Err(Failure::argument(name, format!("dtype {dtype}, expected uint8")).into());
    }
    read_array(name, value, "u", "uint8")
}

/// Reads an argument whose dtype is of one of the `kinds`, and casts its elements to `dtype`.
fn read_array<T: Element + Copy>(
    name: &str,
    value: &Bound<'_, PyAny>,
    kinds: &str,
    dtype: &str,
) -> PyResult<Numbers<T>> {
    let py = value.py();
    let numpy = py.import("numpy")?;
    let given = as_array(name, value)?;
    let kind: String = given.getattr("dtype")?.getattr("kind")?.extract()?;
    let is_empty = given.getattr("size")?.extract::<usize>()? == 0;
    // An empty list has dtype float64.
    let is_wanted = kinds.contains(kind.as_str()) || (is_empty && kind == "f");
    if !is_wanted {
        let wanted = if kinds == "iu" { "integers" } else { "real numbers" };
        let found = given.getattr("dtype")?.str()?.to_string();
        return Err(Failure::argument(name, format!("dtype {found}, expected {wanted}")).into());
    }
    let options = pyo3::types::PyDict::new(py);
    options.set_item("dtype", dtype)?;
    options.set_item("order", "C")?;
    // Overflowing casts are detected from the result; NumPy does not always warn about them.
    let quiet = pyo3::types::PyDict::new(py);
    quiet.set_item("all", "ignore")?;
    let quiet = numpy.call_method("errstate", (), Some(&quiet))?;
    quiet.call_method0("__enter__")?;
    let array = numpy.call_method("asarray", (given,), Some(&options));
    quiet.call_method1("__exit__", (py.None(), py.None(), py.None()))?;
    let array = array.map_err(|error| unreadable(name, error, py))?;
    let array = array.cast_into::<PyArrayDyn<T>>()?;
    let shape = array.shape().to_vec();
    Ok(Numbers { shape, values: array.to_vec()? })
}

/// Converts any object to an array with `numpy.asarray`.
pub(crate) fn as_array<'py>(name: &str, value: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    let numpy = value.py().import("numpy")?;
    numpy.call_method1("asarray", (value,)).map_err(|error| unreadable(name, error, value.py()))
}

/// Returns the error for an object that cannot be read as an array; errors not caused by the object
/// are returned unchanged.
fn unreadable(name: &str, error: PyErr, py: Python<'_>) -> PyErr {
    if !error.is_instance_of::<PyException>(py) {
        return error;
    }
    Failure::argument(name, format!("cannot be read as an array: {}", error.value(py))).into()
}

/// Formats a shape as NumPy prints it.
pub(crate) fn shape_text(shape: &[usize]) -> String {
    match shape {
        [one] => format!("({one},)"),
        _ => format!("({})", shape.iter().map(usize::to_string).collect::<Vec<_>>().join(", ")),
    }
}

/// Returns the error for an array with the wrong shape.
pub(crate) fn wrong_shape(name: &str, shape: &[usize], wanted: &str) -> Failure {
    Failure::argument(name, format!("shape {}, expected {wanted}", shape_text(shape)))
}

/// Reads rows of `N` numbers.
///
/// # Errors
/// Returns an error if the shape is different.
pub(crate) fn rows_of<T: Copy + Default, const N: usize>(
    name: &str,
    numbers: Numbers<T>,
    letter: &str,
) -> Fallible<Vec<[T; N]>> {
    match numbers.shape[..] {
        [_, columns] if columns == N => Ok(numbers.values.as_chunks::<N>().0.to_vec()),
        _ => Err(wrong_shape(name, &numbers.shape, &format!("({letter}, {N})"))),
    }
}

/// Reads rows of `N` finite numbers.
///
/// # Errors
/// Returns an error if the shape is different, or a number is not finite.
pub(crate) fn finite_rows<const N: usize>(
    name: &str,
    value: &Bound<'_, PyAny>,
    letter: &str,
) -> PyResult<Vec<[f32; N]>> {
    let rows = rows_of::<f32, N>(name, real_array(name, value, "float32")?, letter)?;
    for (row, values) in rows.iter().enumerate() {
        if let Some(column) = values.iter().position(|value| !value.is_finite()) {
            let message = format!("is {}, expected a finite 32-bit number", values[column]);
            return Err(Failure::argument(format!("{name}[{row}, {column}]"), message).into());
        }
    }
    Ok(rows)
}

/// Reads a matrix of finite numbers, row by row.
///
/// # Errors
/// Returns an error if the shape is different, or a number is not finite.
pub(crate) fn matrix<const R: usize, const C: usize>(
    name: &str,
    value: &Bound<'_, PyAny>,
) -> PyResult<[[f64; C]; R]> {
    let numbers = real_array::<f64>(name, value, "float64")?;
    if numbers.shape != [R, C] {
        return Err(wrong_shape(name, &numbers.shape, &format!("({R}, {C})")).into());
    }
    if let Some(at) = numbers.values.iter().position(|value| !value.is_finite()) {
        let element = format!("{name}[{}, {}]", at / C, at % C);
        let message = format!("is {}, expected a finite number", numbers.values[at]);
        return Err(Failure::argument(element, message).into());
    }
    let mut rows = [[0.0; C]; R];
    for (row, values) in rows.iter_mut().zip(numbers.values.as_chunks::<C>().0) {
        *row = *values;
    }
    Ok(rows)
}

/// Reads a list of `N` finite numbers.
///
/// # Errors
/// Returns an error if the length is different, or a number is not finite.
pub(crate) fn vector<const N: usize>(name: &str, value: &Bound<'_, PyAny>) -> PyResult<[f64; N]> {
    let numbers = real_array::<f64>(name, value, "float64")?;
    let is_row = numbers.shape == [N] || numbers.shape == [N, 1] || numbers.shape == [1, N];
    let Some(values) = numbers.values.first_chunk::<N>().filter(|_| is_row) else {
        return Err(wrong_shape(name, &numbers.shape, &format!("({N},)")).into());
    };
    if let Some(at) = values.iter().position(|value| !value.is_finite()) {
        let message = format!("is {}, expected a finite number", values[at]);
        return Err(Failure::argument(format!("{name}[{at}]"), message).into());
    }
    Ok(*values)
}

/// Creates an array of this shape with these elements, without copying them.
///
/// # Errors
/// Returns an error if the number of elements does not match the shape.
pub(crate) fn new_array<'py, T: Element>(
    py: Python<'py>,
    values: Vec<T>,
    shape: &[usize],
) -> PyResult<Bound<'py, PyAny>> {
    PyArray1::from_vec(py, values).call_method1("reshape", (shape.to_vec(),))
}
