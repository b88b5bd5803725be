//! Validation of accessor data against the declared bounds and the rules of the accessor's users.
//!
//! Each accessor is read once, however many users it has. All elements that violate a rule share
//! one diagnostic, which reports their number and the first of them.
//!
//! Rules are collected first and tested last: the checks of meshes, skins and animations determine
//! which rules apply to an accessor, and this pass reads its elements.
//!
//! ```text
//!  meshes, skins, animations ──add──► ElementRules ──► AccessorScan ──► one diagnostic per rule
//!                                    by accessor      one pass over the elements
//! ```
//!
//! The time is proportional to the number of components times the number of rules, at most
//! [`MAX_RULES`] per accessor.

use super::codes::{self, DiagnosticCode};
use super::document::{CheckedDocument, array_items};
use super::elements::AccessorElements;
use super::layout::{AccessorLayout, ComponentType};
use super::store::BufferStore;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fmt::Display;

/// A rule for the elements of an accessor, set by a member that refers to the accessor.
///
/// Rules are compared for equality so that each is tested once, however many primitives share an
/// accessor. Non-finite values are left to the bounds check, which reports them.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) enum ElementRule {
    /// Unit vectors, tested after dequantization. A fourth component is the handedness of a
    /// tangent, −1 or 1.
    Unit,
    /// Values in [0, 1], such as vertex colors.
    Clamped,
    /// Indices less than the number of vertices; with `triangles`, every three form a triangle.
    ///
    /// The largest value of the component type is the primitive restart value of graphics APIs,
    /// which glTF forbids (§3.7.2.1).
    Indices { vertices: u64, triangles: bool },
    /// Keyframe times in seconds: not negative, strictly increasing.
    Times,
    /// Unit quaternions; for cubic splines, only the value between the two tangents.
    Quaternions { spline: bool },
    /// Affine matrices in column-major order: the last row, components 3, 7, 11 and 15, is 0, 0, 0,
    /// 1.
    Matrices,
}

/// The rules for the elements of all accessors, each with a pointer to the member that sets it.
#[derive(Default, Debug)]
pub(super) struct ElementRules {
    /// The rules of each accessor; a rule set by several members is stored once, with the first
    /// pointer.
    by_accessor: BTreeMap<usize, Vec<(ElementRule, String)>>,
}

/// The maximum number of rules for one accessor; each costs a comparison per element.
///
/// In ordinary files, an accessor has one or two rules. Without a maximum, a small file in which
/// thousands of primitives index one accessor, each with a different number of vertices, would take
/// quadratic time.
const MAX_RULES: usize = 16;

/// The tolerance for the length of unit vectors, slightly more than the rounding error of signed
/// bytes. This constant and the next have the values of the Khronos validator.
const UNIT_VECTOR_TOLERANCE: f64 = 0.00674;
/// The tolerance for the length of unit quaternions.
///
/// It is larger than for vectors, because the fourth quantized component adds to the error.
const UNIT_QUATERNION_TOLERANCE: f64 = 0.00769;

impl ElementRules {
    /// Adds a rule for an accessor's elements, unless it already has this rule or too many rules.
    ///
    /// `pointer` refers to the member that sets the rule; violations are reported there.
    pub(super) fn add(&mut self, accessor: usize, demand: ElementRule, pointer: &str) {
        let list = self.by_accessor.entry(accessor).or_default();
        if list.len() < MAX_RULES && list.iter().all(|(known, _)| *known != demand) {
            list.push((demand, pointer.to_owned()));
        }
    }
}

/// Reads the elements of all accessors that have data, and reports rule violations.
///
/// The work is charged to the memory budget, so a small file that declares many elements cannot
/// take long. Such files are possible because accessors without data take no space, and
/// overlapping accessors share the same bytes.
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
        // The time depends on the number of components, not on their size, so charge 4 bytes each.
        let cost = layout.count.saturating_mul(4 * layout.element_type.component_count() as u64);
        // An accessor without data is all zeros, or its data is in an extension's stream.
        if !elements.has_no_data() && store.charge_budget(&format!("{pointer}/count"), cost) {
            AccessorScan::new(document, &elements, pointer, own).scan_elements(accessor);
        }
    }
}

/// The number of violations of one rule, and the element and value of the first.
///
/// One diagnostic with a count replaces potentially millions.
#[derive(Clone, Default, Debug)]
struct Tally {
    /// The number of violations.
    count: u64,
    /// The index of the first element that violates the rule.
    first: u64,
    /// The offending value in that element.
    value: f64,
}

impl Tally {
    /// Counts a violation if `wrong`, and stores the first.
    fn record_if(&mut self, wrong: bool, at: u64, value: f64) {
        if wrong {
            if self.count == 0 {
                (self.first, self.value) = (at, value);
            }
            self.count += 1;
        }
    }
}

/// One pass over the elements of an accessor.
struct AccessorScan<'a> {
    document: &'a CheckedDocument<'a>,
    elements: &'a AccessorElements<'a>,
    /// The JSON pointer of the accessor.
    pointer: String,
    /// The rules of the accessor's users, with their violations so far.
    scans: Vec<RuleScan<'a>>,
}

/// A rule with its violations and the state carried from one element to the next.
///
/// Only some rules use `last` and `triangle`; a separate state for each rule would require a second
/// enum with the same variants.
struct RuleScan<'a> {
    rule: ElementRule,
    /// The pointer to the member that sets the rule, where violations are reported.
    pointer: &'a str,
    /// The violations; some rules have two parts with separate codes.
    tallies: [Tally; 2],
    /// The previous keyframe time, or the number of degenerate triangles.
    last: f64,
    /// The last three indices.
    triangle: [f64; 3],
}

/// The actual bounds of each component, and how often the declared bounds are exceeded.
///
/// Bounds are compared before dequantization: `min` and `max` of normalized integers are the stored
/// integers (glTF 2.0 §3.6.2.5).
struct BoundsScan {
    /// `min` and `max` as declared; `None` for values other than numbers.
    declared: [Vec<Option<f64>>; 2],
    /// The minimum and maximum of each component; an element has at most 16.
    actual: [[f64; 16]; 2],
    /// For each component, the number of elements below `min`, and the number above `max`.
    outside: [[u64; 16]; 2],
    /// Infinities and NaNs, which glTF forbids.
    non_finite: Tally,
}

impl<'a> AccessorScan<'a> {
    /// Prepares a pass over the elements of an accessor with the rules of all its users.
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

    /// Visits every element once, then reports the violations.
    ///
    /// Bounds and rules are tested in a single traversal, because decoding an element costs more
    /// than testing it.
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
    /// Reads the declared bounds of an accessor.
    ///
    /// The schema walk has already reported bounds that are not numbers; their components are not
    /// compared.
    fn new(accessor: &Value, layout: AccessorLayout) -> Self {
        // A JSON number may have more digits than a float, so compare the nearest float.
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

    /// Updates the actual bounds from one element, and counts its components outside the declared
    /// bounds.
    ///
    /// NaNs and infinities are counted and skipped, because they would make every later comparison
    /// meaningless.
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

    /// Reports non-finite values, and declared bounds that differ from the actual bounds.
    ///
    /// Bounds must be exact (glTF 2.0 §3.6.2.5). If the declared bounds are too narrow, the
    /// number of elements outside them is also reported.
    fn report_bounds(&self, document: &CheckedDocument<'_>, pointer: &str) {
        let Tally { count, first, value } = self.non_finite;
        if count > 0 {
            let message =
                format_args!("non-finite values: {count}; the first is {value} in element {first}");
            document.diagnostics.add(&codes::ACCESSOR_INVALID_FLOAT, pointer, message);
        }
        let bounds = [
            ("min", &codes::ACCESSOR_MIN_MISMATCH, &codes::ACCESSOR_ELEMENT_OUT_OF_MIN_BOUND),
            ("max", &codes::ACCESSOR_MAX_MISMATCH, &codes::ACCESSOR_ELEMENT_OUT_OF_MAX_BOUND),
        ];
        for (side, (key, mismatch, outside)) in bounds.into_iter().enumerate() {
            for (component, declared) in self.declared[side].iter().enumerate().take(16) {
                let (Some(declared), actual) = (*declared, self.actual[side][component]) else {
                    continue;
                };
                if !actual.is_finite() || declared == actual {
                    continue;
                }
                let pointer = format!("{pointer}/{key}/{component}");
                let message = format_args!(
                    "the declared {key} is {declared}, but the actual {key} is {actual}"
                );
                document.diagnostics.add(mismatch, &pointer, message);
                let count = self.outside[side][component];
                if count > 0 {
                    let relation = ["below", "above"][side];
                    let message =
                        format_args!("elements {relation} the declared {key} {declared}: {count}");
                    document.diagnostics.add(outside, &pointer, message);
                }
            }
        }
    }
}

impl RuleScan<'_> {
    /// Tests one element against the rule.
    ///
    /// `numbers` are the stored components; `elements` dequantizes them if the rule applies to the
    /// dequantized value. Each violation is counted under its code.
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

    /// Reports violations of the rule in an accessor of `total` elements.
    ///
    /// Messages have the form "… (3 of 24; the first is 1.5 in element 7)", which locates the
    /// defect without listing every element.
    fn report_violations(&self, document: &CheckedDocument<'_>, total: u64) {
        let say = |code: &DiagnosticCode, tally: &Tally, what: &dyn Display| {
            let Tally { count, first, value } = tally;
            if *count > 0 {
                let message = format_args!(
                    "{what} ({count} of {total}; the first is {value} in element {first})"
                );
                document.diagnostics.add(code, self.pointer, message);
            }
        };
        let [first, second] = &self.tallies;
        match self.rule {
            ElementRule::Unit => {
                say(&codes::ACCESSOR_VECTOR3_NON_UNIT, first, &"vectors are not of unit length");
                say(&codes::ACCESSOR_INVALID_SIGN, second, &"tangent signs are neither 1 nor -1");
            }
            ElementRule::Clamped => {
                say(&codes::ACCESSOR_NON_CLAMPED, first, &"values are not in [0, 1]");
            }
            ElementRule::Indices { vertices, .. } => {
                let what = format_args!("indices are not less than the vertex count {vertices}");
                say(&codes::ACCESSOR_INDEX_OOB, first, &what);
                let what = "indices have the primitive restart value";
                say(&codes::ACCESSOR_INDEX_PRIMITIVE_RESTART, second, &what);
                if self.last > 0.0 {
                    let message =
                        format_args!("degenerate triangles, with two equal indices: {}", self.last);
                    let code = &codes::ACCESSOR_INDEX_TRIANGLE_DEGENERATE;
                    document.diagnostics.add(code, self.pointer, message);
                }
            }
            ElementRule::Times => {
                say(&codes::ACCESSOR_ANIMATION_INPUT_NEGATIVE, first, &"times are negative");
                say(
                    &codes::ACCESSOR_ANIMATION_INPUT_NON_INCREASING,
                    second,
                    &"times are not strictly increasing",
                );
            }
            ElementRule::Quaternions { .. } => {
                let code = &codes::ACCESSOR_ANIMATION_SAMPLER_OUTPUT_NON_NORMALIZED_QUATERNION;
                say(code, first, &"quaternions are not of unit length");
            }
            ElementRule::Matrices => {
                let what = "values in the last row are not 0, 0, 0, 1";
                say(&codes::ACCESSOR_INVALID_IBM, first, &what);
            }
        }
    }
}
