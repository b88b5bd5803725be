//! The numbers themselves: every accessor is read once, and held against its bounds and against what it is used for.
//!
//! One problem tells of all elements of an accessor that are wrong in one way: how many there are, and the first of them.

use super::codes::{self, DiagnosticCode};
use super::document::{CheckedDocument, array_items};
use super::elements::AccessorElements;
use super::layout::{AccessorLayout, ComponentType};
use super::store::BufferStore;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fmt::Display;

/// What the user of an accessor demands of its elements.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) enum ElementRule {
    /// Unit vectors; the fourth number of four is −1 or 1.
    Unit,
    /// Numbers from 0 to 1.
    Clamped,
    /// Indices below the number of vertices; `triangles` if three each make one.
    Indices { vertices: u64, triangles: bool },
    /// Times: not negative, rising.
    Times,
    /// Unit quaternions; of splines every third of three, beginning with the second.
    Quaternions { spline: bool },
    /// Matrices whose last row is 0, 0, 0, 1.
    Matrices,
}

/// The demands on all accessors, each with the pointer of the member that makes it.
#[derive(Default, Debug)]
pub(super) struct ElementRules {
    by_accessor: BTreeMap<usize, Vec<(ElementRule, String)>>,
}

/// So many users of one accessor may have demands: each costs a comparison for every element.
const MAX_RULES: usize = 16;

/// A unit vector may be longer or shorter by so much: slightly more than the error of signed bytes. The validator's numbers.
const UNIT_VECTOR_TOLERANCE: f64 = 0.00674;
const UNIT_QUATERNION_TOLERANCE: f64 = 0.00769;

impl ElementRules {
    pub(super) fn add(&mut self, accessor: usize, demand: ElementRule, pointer: &str) {
        let list = self.by_accessor.entry(accessor).or_default();
        if list.len() < MAX_RULES && list.iter().all(|(known, _)| *known != demand) {
            list.push((demand, pointer.to_owned()));
        }
    }
}

/// Reads all accessors that have data.
pub(super) fn check_data(
    document: &CheckedDocument<'_>,
    store: &BufferStore<'_>,
    demands: &ElementRules,
) {
    for (at, accessor) in document.root_array("accessors").iter().enumerate() {
        let Some(layout) = AccessorLayout::from_accessor(accessor) else { continue };
        let Some(elements) = store.accessor_elements(accessor, layout) else { continue };
        let own = demands.by_accessor.get(&at).map_or(&[][..], Vec::as_slice);
        let pointer = format!("/accessors/{at}");
        // Bytes take as long to look at as floats: the work is counted as if all numbers were floats.
        let cost = layout.count.saturating_mul(4 * layout.element_type.component_count() as u64);
        // Without any data the numbers are zeros, or in a stream that an extension knows of: there is nothing to read.
        if !elements.has_no_data() && store.charge_budget(&format!("{pointer}/count"), cost) {
            AccessorScan::new(document, &elements, pointer, own).scan_elements(accessor);
        }
    }
}

/// How many elements are wrong in one way, and the first of them.
#[derive(Clone, Default, Debug)]
struct Tally {
    count: u64,
    first: u64,
    value: f64,
}

impl Tally {
    fn record_if(&mut self, wrong: bool, at: u64, value: f64) {
        if wrong {
            if self.count == 0 {
                (self.first, self.value) = (at, value);
            }
            self.count += 1;
        }
    }
}

struct AccessorScan<'a> {
    document: &'a CheckedDocument<'a>,
    elements: &'a AccessorElements<'a>,
    pointer: String,
    scans: Vec<RuleScan<'a>>,
}

/// A demand, and where it is not met.
struct RuleScan<'a> {
    rule: ElementRule,
    pointer: &'a str,
    tallies: [Tally; 2],
    last: f64,
    triangle: [f64; 3],
}

/// The least and the greatest number of each component, and how often the declared bounds are exceeded.
struct BoundsScan {
    declared: [Vec<Option<f64>>; 2],
    actual: [[f64; 16]; 2],
    outside: [[u64; 16]; 2],
    non_finite: Tally,
}

impl<'a> AccessorScan<'a> {
    fn new(
        document: &'a CheckedDocument<'a>,
        elements: &'a AccessorElements<'a>,
        pointer: String,
        demands: &'a [(ElementRule, String)],
    ) -> Self {
        let watch = |(demand, pointer): &'a (ElementRule, String)| RuleScan {
            rule: *demand,
            pointer,
            tallies: Default::default(),
            last: f64::NEG_INFINITY,
            triangle: [0.0; 3],
        };
        Self { document, elements, pointer, scans: demands.iter().map(watch).collect() }
    }

    fn scan_elements(mut self, accessor: &Value) {
        let mut extremes = BoundsScan::new(accessor, self.elements.layout);
        let (elements, watches) = (self.elements, &mut self.scans);
        elements.for_each_element(|at, numbers| {
            extremes.visit_element(at, numbers);
            for watch in &mut *watches {
                watch.visit_element(elements, at, numbers);
            }
        });
        extremes.report_bounds(self.document, &self.pointer);
        for watch in &self.scans {
            watch.report_violations(self.document, elements.layout.count);
        }
    }
}

impl BoundsScan {
    fn new(accessor: &Value, layout: AccessorLayout) -> Self {
        // Numbers of JSON have more digits than floats: what is compared is the nearest float.
        let bound = |value: &Value| {
            let number = value.as_f64()?;
            Some(if layout.component_type == ComponentType::F32 {
                f64::from(number as f32)
            } else {
                number
            })
        };
        let declared = ["min", "max"]
            .map(|key| array_items(accessor, key).iter().map(bound).collect::<Vec<_>>());
        let actual = [[f64::INFINITY; 16], [f64::NEG_INFINITY; 16]];
        Self { declared, actual, outside: [[0; 16]; 2], non_finite: Tally::default() }
    }

    fn visit_element(&mut self, at: u64, numbers: &[f64]) {
        for (component, &number) in numbers.iter().enumerate() {
            if !number.is_finite() {
                self.non_finite.record_if(true, at, number);
                continue;
            }
            let [least, most] = &mut self.actual;
            least[component] = least[component].min(number);
            most[component] = most[component].max(number);
            let [min, max] =
                [0, 1].map(|side| self.declared[side].get(component).copied().flatten());
            self.outside[0][component] += u64::from(min.is_some_and(|min| number < min));
            self.outside[1][component] += u64::from(max.is_some_and(|max| number > max));
        }
    }

    fn report_bounds(&self, document: &CheckedDocument<'_>, pointer: &str) {
        let Tally { count, first, value } = self.non_finite;
        if count > 0 {
            let message = format_args!(
                "{count} numbers are not finite; the first, in element {first}, is {value}"
            );
            document.diagnostics.add(&codes::ACCESSOR_INVALID_FLOAT, pointer, message);
        }
        let sides = [
            (
                "min",
                "least",
                &codes::ACCESSOR_MIN_MISMATCH,
                &codes::ACCESSOR_ELEMENT_OUT_OF_MIN_BOUND,
            ),
            (
                "max",
                "greatest",
                &codes::ACCESSOR_MAX_MISMATCH,
                &codes::ACCESSOR_ELEMENT_OUT_OF_MAX_BOUND,
            ),
        ];
        for (side, (key, word, mismatch, outside)) in sides.into_iter().enumerate() {
            for (component, declared) in self.declared[side].iter().enumerate().take(16) {
                let (Some(declared), found) = (*declared, self.actual[side][component]) else {
                    continue;
                };
                if !found.is_finite() || declared == found {
                    continue;
                }
                let pointer = format!("{pointer}/{key}/{component}");
                let message =
                    format_args!("the {word} number is {found}, and the bound says {declared}");
                document.diagnostics.add(mismatch, &pointer, message);
                let count = self.outside[side][component];
                if count > 0 {
                    let message = format_args!("{count} elements are beyond the bound {declared}");
                    document.diagnostics.add(outside, &pointer, message);
                }
            }
        }
    }
}

impl RuleScan<'_> {
    fn visit_element(&mut self, elements: &AccessorElements<'_>, at: u64, numbers: &[f64]) {
        let length = |numbers: &[f64]| {
            let squares = numbers.iter().map(|&x| elements.dequantize(x)).map(|x| x * x);
            squares.sum::<f64>().sqrt()
        };
        let [first, second] = &mut self.tallies;
        match self.rule {
            ElementRule::Unit => {
                let length = length(&numbers[..numbers.len().min(3)]);
                first.record_if(
                    length.is_finite() && (length - 1.0).abs() > UNIT_VECTOR_TOLERANCE,
                    at,
                    length,
                );
                let sign = numbers.get(3).map_or(1.0, |&sign| elements.dequantize(sign));
                second.record_if(sign.abs() != 1.0, at, sign);
            }
            ElementRule::Clamped => {
                for &number in numbers {
                    first.record_if(
                        !(0.0..=1.0).contains(&number) && number.is_finite(),
                        at,
                        number,
                    );
                }
            }
            ElementRule::Indices { vertices, triangles } => {
                let index = numbers[0];
                first.record_if(index >= vertices as f64, at, index);
                second.record_if(index == elements.layout.component_type.max_value(), at, index);
                self.triangle[(at % 3) as usize] = index;
                let [a, b, c] = self.triangle;
                if triangles && at % 3 == 2 && (a == b || b == c || c == a) {
                    self.last = self.last.max(0.0) + 1.0;
                }
            }
            ElementRule::Times => {
                first.record_if(numbers[0] < 0.0, at, numbers[0]);
                second.record_if(numbers[0] <= self.last && numbers[0] >= 0.0, at, numbers[0]);
                self.last = numbers[0];
            }
            ElementRule::Quaternions { spline } if !spline || at % 3 == 1 => {
                let length = length(numbers);
                first.record_if(
                    length.is_finite() && (length - 1.0).abs() > UNIT_QUATERNION_TOLERANCE,
                    at,
                    length,
                );
            }
            ElementRule::Quaternions { .. } => {}
            ElementRule::Matrices => {
                for (slot, expected) in [(3, 0.0), (7, 0.0), (11, 0.0), (15, 1.0)] {
                    let number = numbers.get(slot).copied().unwrap_or(expected);
                    first.record_if(number != expected, at, number);
                }
            }
        }
    }

    fn report_violations(&self, document: &CheckedDocument<'_>, total: u64) {
        let say = |code: &DiagnosticCode, tally: &Tally, what: &dyn Display| {
            let Tally { count, first, value } = tally;
            if *count > 0 {
                let message = format_args!(
                    "{what} (how many: {count} of {total}; the first is {value}, in element {first})"
                );
                document.diagnostics.add(code, self.pointer, message);
            }
        };
        let [first, second] = &self.tallies;
        match self.rule {
            ElementRule::Unit => {
                say(&codes::ACCESSOR_VECTOR3_NON_UNIT, first, &"vectors are not of unit length");
                say(&codes::ACCESSOR_INVALID_SIGN, second, &"signs are neither 1 nor -1");
            }
            ElementRule::Clamped => {
                say(&codes::ACCESSOR_NON_CLAMPED, first, &"numbers are not in [0, 1]");
            }
            ElementRule::Indices { vertices, .. } => {
                let what = format_args!("indices have no vertex, of which there are {vertices}");
                say(&codes::ACCESSOR_INDEX_OOB, first, &what);
                let what = "indices are the largest number, which restarts strips elsewhere";
                say(&codes::ACCESSOR_INDEX_PRIMITIVE_RESTART, second, &what);
                if self.last > 0.0 {
                    let message =
                        format_args!("{} triangles have two corners at one vertex", self.last);
                    let code = &codes::ACCESSOR_INDEX_TRIANGLE_DEGENERATE;
                    document.diagnostics.add(code, self.pointer, message);
                }
            }
            ElementRule::Times => {
                say(&codes::ACCESSOR_ANIMATION_INPUT_NEGATIVE, first, &"times are negative");
                say(&codes::ACCESSOR_ANIMATION_INPUT_NON_INCREASING, second, &"times do not rise");
            }
            ElementRule::Quaternions { .. } => {
                let code = &codes::ACCESSOR_ANIMATION_SAMPLER_OUTPUT_NON_NORMALIZED_QUATERNION;
                say(code, first, &"rotations are not of unit length");
            }
            ElementRule::Matrices => {
                let what = "numbers of the last rows are not 0, 0, 0, 1";
                say(&codes::ACCESSOR_INVALID_IBM, first, &what);
            }
        }
    }
}
