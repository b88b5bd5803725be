//! A check line with the values of its names and the crates' results, for evaluating a formula.

use crate::book_formulas::check_line::{Check, Given, Reference};
use crate::book_formulas::evaluate::Scope;
use crate::book_formulas::name::Name;
use crate::book_formulas::registry::{Entry, Inputs, find_entry};
use crate::book_formulas::value::Value;
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

/// A check line whose values and expected result are known.
#[derive(Debug)]
pub struct PreparedCheck {
    pub expected: Value,
    /// The values in the check line.
    values: BTreeMap<Name, Value>,
    /// The values that the crates supply.
    extras: BTreeMap<Name, Value>,
    /// The names that refer to other entries, each with its entry, which may need further values.
    behind: BTreeMap<Name, &'static Entry>,
    target: Reference,
    used: RefCell<BTreeSet<Name>>,
}

impl PreparedCheck {
    pub fn new(check: &Check) -> Result<Self, String> {
        let entry = find_entry(&check.target.name)?;
        let mut values: BTreeMap<Name, Value> = BTreeMap::new();
        for (name, given) in &check.givens {
            if let Given::Value(value) = given {
                values.insert(name.clone(), value.clone());
            }
        }
        let mut behind = BTreeMap::new();
        let mut named = BTreeMap::new();
        for (name, given) in &check.givens {
            let Given::Reference(reference) = given else { continue };
            let other = find_entry(&reference.name)?;
            let value = reference.select(&answer(other, &values)?)?;
            let name = if value.is_column() { name.as_bold() } else { name.clone() };
            behind.insert(name.clone(), other);
            named.insert(name, value);
        }
        values.extend(named);
        let expected = check.target.select(&answer(entry, &values)?)?;
        let extras = match entry.extras {
            Some(extras) => extras(&Inputs::new(entry.variables, &values)),
            None => Ok(Vec::new()),
        };
        let extras = extras.map_err(|error| error.to_string())?;
        let extras = extras.into_iter().map(|(name, value)| (Name::parse(name).key(), value));
        let prepared = Self {
            expected,
            values,
            extras: extras.collect(),
            behind,
            target: check.target.clone(),
            used: RefCell::default(),
        };
        prepared.check_givens(entry)?;
        Ok(prepared)
    }

    /// Checks that each value belongs to the entry, or to an entry that a name refers to.
    fn check_givens(&self, entry: &Entry) -> Result<(), String> {
        let takes = |entry: &Entry, name: &Name| Inputs::takes(entry.variables, name);
        for name in self.values.keys().filter(|name| !self.behind.contains_key(*name)) {
            if !takes(entry, name) && !self.behind.values().any(|other| takes(other, name)) {
                return Err(format!(
                    "{} has no variable `{name}`; it has `{}`",
                    entry.name, entry.variables
                ));
            }
        }
        Ok(())
    }

    /// Returns a name whose value was not used when the formula was evaluated.
    pub fn unused_name(&self) -> Option<&Name> {
        let used = self.used.borrow();
        let uses_extras = self.extras.keys().any(|name| used.contains(name));
        let behind_used = |name: &Name| {
            let mut entries = self.behind.iter().filter(|(name, _)| used.contains(*name));
            entries.any(|(_, entry)| Inputs::takes(entry.variables, name))
        };
        let of_whole = self.target.index.is_empty() && !uses_extras;
        self.values.keys().find(|name| {
            let is_needed = of_whole || self.behind.contains_key(*name);
            is_needed && !used.contains(*name) && !behind_used(name)
        })
    }
}

fn answer(entry: &Entry, values: &BTreeMap<Name, Value>) -> Result<Value, String> {
    let value = (entry.build)(&Inputs::new(entry.variables, values));
    value.map_err(|error| format!("{}: {error}", entry.name))
}

impl Scope for PreparedCheck {
    /// Returns the value of a name. A plain letter also matches a bold value; a bold letter also
    /// matches a plain matrix, but not a number.
    fn value_of(&self, name: &Name) -> Result<Value, String> {
        let key = name.key();
        let other = Name { is_bold: !key.is_bold, ..key.clone() };
        for name in [&key, &other] {
            let found = self.values.get(name).or_else(|| self.extras.get(name));
            let fits = |value: &&Value| name == &key || !key.is_bold || value.to_number().is_err();
            if let Some(value) = found.filter(fits) {
                self.used.borrow_mut().insert(name.clone());
                return Ok(value.clone());
            }
        }
        Err(format!("`{key}` has no value in the check line"))
    }
}
