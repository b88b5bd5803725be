//! Keyword arguments: a dictionary of options, each read by name and type. The Python functions
//! define the signatures; an option that is `None` is treated as absent.

use crate::arrays;
use crate::failure::Failure;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use scene_file::file::Positive;
use scene_file::options::NamedOption;

/// Options of a call.
pub(crate) struct Keywords<'a, 'py>(pub(crate) &'a Bound<'py, PyDict>);

impl<'py> Keywords<'_, 'py> {
    /// Returns an option, or `None` if it is absent.
    pub(crate) fn value(&self, name: &str) -> PyResult<Option<Bound<'py, PyAny>>> {
        Ok(self.0.get_item(name)?.filter(|value| !value.is_none()))
    }

    /// Reads an option of any type that PyO3 can convert; `wanted` describes the type in words.
    fn extract<T>(&self, name: &str, wanted: &str) -> PyResult<Option<T>>
    where
        T: for<'a> FromPyObject<'a, 'py>,
    {
        let Some(value) = self.value(name)? else { return Ok(None) };
        let found = value.extract::<T>();
        found.map(Some).map_err(|_| not_a(name, &value, wanted).into())
    }

    /// Reads a string.
    pub(crate) fn text(&self, name: &str) -> PyResult<Option<String>> {
        self.extract(name, "a string")
    }

    /// Reads a flag.
    pub(crate) fn flag(&self, name: &str) -> PyResult<bool> {
        Ok(self.extract(name, "True or False")?.unwrap_or(false))
    }

    /// Reads a finite number.
    pub(crate) fn number(&self, name: &str) -> PyResult<Option<f64>> {
        let Some(number) = self.extract::<f64>(name, "a number")? else { return Ok(None) };
        if number.is_finite() {
            return Ok(Some(number));
        }
        Err(Failure::argument(name, format!("is {number}, expected a finite number")).into())
    }

    /// Reads a number greater than 0.
    pub(crate) fn positive(&self, name: &str) -> PyResult<Option<Positive>> {
        let Some(number) = self.number(name)? else { return Ok(None) };
        let wrong = || {
            let message = format!("is {number}, expected a number greater than 0");
            PyErr::from(Failure::argument(name, message))
        };
        Positive::new(number).map(Some).ok_or_else(wrong)
    }

    /// Reads an integer of at least 0.
    pub(crate) fn count(&self, name: &str) -> PyResult<Option<usize>> {
        self.extract(name, "a whole number of at least 0")
    }

    /// Reads the width and height in pixels.
    pub(crate) fn size(&self, name: &str) -> PyResult<Option<(u32, u32)>> {
        let Some(value) = self.value(name)? else { return Ok(None) };
        let sides = value.extract::<[i64; 2]>();
        let wanted = "(width, height) in pixels";
        let [width, height] = sides.map_err(|_| PyErr::from(not_a(name, &value, wanted)))?;
        let most = i64::from(scene::MAX_IMAGE_SIDE);
        let fits = |side: i64| (1..=most).contains(&side);
        if fits(width) && fits(height) {
            return Ok(Some((width as u32, height as u32)));
        }
        let message = format!("is ({width}, {height}), expected sides from 1 to {most}");
        Err(Failure::argument(name, message).into())
    }

    /// Reads a list of finite numbers.
    pub(crate) fn vector<const N: usize>(&self, name: &str) -> PyResult<Option<[f64; N]>> {
        self.value(name)?.map(|value| arrays::vector(name, &value)).transpose()
    }

    /// Reads a value that the library identifies by name.
    pub(crate) fn named<T: NamedOption>(&self, name: &str) -> PyResult<Option<T>> {
        let Some(text) = self.text(name)? else { return Ok(None) };
        let wanted = plain_name(&text);
        let found = T::ALL.iter().copied().find(|known| plain_name(known.name()) == wanted);
        found.map(Some).ok_or_else(|| {
            let names: Vec<String> = T::ALL.iter().map(|known| known.flag_name()).collect();
            Failure::argument(name, format!("is {text:?}, expected one of {}", names.join(", ")))
                .into()
        })
    }
}

/// Normalizes a name: Python, flags and scene files differ in case, hyphens and underscores.
pub(crate) fn plain_name(name: &str) -> String {
    let letters = name.chars().filter(|c| !matches!(c, '-' | '_' | ' '));
    letters.flat_map(char::to_lowercase).collect()
}

/// Returns the error for a value of the wrong type.
pub(crate) fn not_a(name: &str, value: &Bound<'_, PyAny>, wanted: &str) -> Failure {
    let found = value.repr().map_or_else(|_| "?".to_owned(), |text| text.to_string());
    let found: String = found.chars().take(80).collect();
    Failure::argument(name, format!("is {found}, expected {wanted}"))
}
