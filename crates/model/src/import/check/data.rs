//! The numbers themselves: every accessor is read once, and held against its bounds and against what it is used for.
//!
//! One problem tells of all elements of an accessor that are wrong in one way: how many there are, and the first of them.

use super::codes::{self, Code};
use super::document::{Document, items};
use super::elements::Elements;
use super::layout::{Component, Layout};
use super::store::Store;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fmt::Display;

/// What the user of an accessor demands of its elements.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) enum Demand {
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
pub(super) struct Demands {
    by_accessor: BTreeMap<usize, Vec<(Demand, String)>>,
}

/// So many users of one accessor may have demands: each costs a comparison for every element.
const MOST_DEMANDS: usize = 16;

/// A unit vector may be longer or shorter by so much: slightly more than the error of signed bytes. The validator's numbers.
const UNIT_3: f64 = 0.00674;
const UNIT_4: f64 = 0.00769;

impl Demands {
    pub(super) fn add(&mut self, accessor: usize, demand: Demand, pointer: &str) {
        let list = self.by_accessor.entry(accessor).or_default();
        if list.len() < MOST_DEMANDS && list.iter().all(|(known, _)| *known != demand) {
            list.push((demand, pointer.to_owned()));
        }
    }
}

/// Reads all accessors that have data.
pub(super) fn check(document: &Document<'_>, store: &Store<'_>, demands: &Demands) {
    for (at, accessor) in document.all("accessors").iter().enumerate() {
        let Some(layout) = Layout::of(accessor) else { continue };
        let Some(elements) = store.elements(accessor, layout) else { continue };
        let own = demands.by_accessor.get(&at).map_or(&[][..], Vec::as_slice);
        let pointer = format!("/accessors/{at}");
        // Bytes take as long to look at as floats: the work is counted as if all numbers were floats.
        let cost = layout.count.saturating_mul(4 * layout.shape.numbers() as u64);
        // Without any data the numbers are zeros, or in a stream that an extension knows of: there is nothing to read.
        if !elements.is_hollow() && store.may_spend(&format!("{pointer}/count"), cost) {
            Reader::new(document, &elements, pointer, own).read(accessor);
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
    fn note(&mut self, wrong: bool, at: u64, value: f64) {
        if wrong {
            if self.count == 0 {
                (self.first, self.value) = (at, value);
            }
            self.count += 1;
        }
    }
}

struct Reader<'a> {
    document: &'a Document<'a>,
    elements: &'a Elements<'a>,
    pointer: String,
    demands: Vec<Watch<'a>>,
}

/// A demand, and where it is not met.
struct Watch<'a> {
    demand: Demand,
    pointer: &'a str,
    tallies: [Tally; 2],
    last: f64,
    corners: [f64; 3],
}

/// The least and the greatest number of each component, and how often the declared bounds are exceeded.
struct Extremes {
    declared: [Vec<Option<f64>>; 2],
    found: [[f64; 16]; 2],
    outside: [[u64; 16]; 2],
    strange: Tally,
}

impl<'a> Reader<'a> {
    fn new(
        document: &'a Document<'a>,
        elements: &'a Elements<'a>,
        pointer: String,
        demands: &'a [(Demand, String)],
    ) -> Self {
        let watch = |(demand, pointer): &'a (Demand, String)| Watch {
            demand: *demand,
            pointer,
            tallies: Default::default(),
            last: f64::NEG_INFINITY,
            corners: [0.0; 3],
        };
        Self { document, elements, pointer, demands: demands.iter().map(watch).collect() }
    }

    fn read(mut self, accessor: &Value) {
        let mut extremes = Extremes::new(accessor, self.elements.layout);
        let (elements, watches) = (self.elements, &mut self.demands);
        elements.each(|at, numbers| {
            extremes.see(at, numbers);
            for watch in &mut *watches {
                watch.see(elements, at, numbers);
            }
        });
        extremes.tell(self.document, &self.pointer);
        for watch in &self.demands {
            watch.tell(self.document, elements.layout.count);
        }
    }
}

impl Extremes {
    fn new(accessor: &Value, layout: Layout) -> Self {
        // Numbers of JSON have more digits than floats: what is compared is the nearest float.
        let bound = |value: &Value| {
            let number = value.as_f64()?;
            Some(if layout.component == Component::F32 { f64::from(number as f32) } else { number })
        };
        let declared =
            ["min", "max"].map(|key| items(accessor, key).iter().map(bound).collect::<Vec<_>>());
        let found = [[f64::INFINITY; 16], [f64::NEG_INFINITY; 16]];
        Self { declared, found, outside: [[0; 16]; 2], strange: Tally::default() }
    }

    fn see(&mut self, at: u64, numbers: &[f64]) {
        for (component, &number) in numbers.iter().enumerate() {
            if !number.is_finite() {
                self.strange.note(true, at, number);
                continue;
            }
            let [least, most] = &mut self.found;
            least[component] = least[component].min(number);
            most[component] = most[component].max(number);
            let [min, max] =
                [0, 1].map(|side| self.declared[side].get(component).copied().flatten());
            self.outside[0][component] += u64::from(min.is_some_and(|min| number < min));
            self.outside[1][component] += u64::from(max.is_some_and(|max| number > max));
        }
    }

    fn tell(&self, document: &Document<'_>, pointer: &str) {
        let Tally { count, first, value } = self.strange;
        if count > 0 {
            let message = format_args!(
                "{count} numbers are not finite; the first, in element {first}, is {value}"
            );
            document.findings.add(&codes::ACCESSOR_INVALID_FLOAT, pointer, message);
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
                let (Some(declared), found) = (*declared, self.found[side][component]) else {
                    continue;
                };
                if !found.is_finite() || declared == found {
                    continue;
                }
                let pointer = format!("{pointer}/{key}/{component}");
                let message =
                    format_args!("the {word} number is {found}, and the bound says {declared}");
                document.findings.add(mismatch, &pointer, message);
                let count = self.outside[side][component];
                if count > 0 {
                    let message = format_args!("{count} elements are beyond the bound {declared}");
                    document.findings.add(outside, &pointer, message);
                }
            }
        }
    }
}

impl Watch<'_> {
    fn see(&mut self, elements: &Elements<'_>, at: u64, numbers: &[f64]) {
        let length = |numbers: &[f64]| {
            let squares = numbers.iter().map(|&x| elements.meaning(x)).map(|x| x * x);
            squares.sum::<f64>().sqrt()
        };
        let [first, second] = &mut self.tallies;
        match self.demand {
            Demand::Unit => {
                let length = length(&numbers[..numbers.len().min(3)]);
                first.note(length.is_finite() && (length - 1.0).abs() > UNIT_3, at, length);
                let sign = numbers.get(3).map_or(1.0, |&sign| elements.meaning(sign));
                second.note(sign.abs() != 1.0, at, sign);
            }
            Demand::Clamped => {
                for &number in numbers {
                    first.note(!(0.0..=1.0).contains(&number) && number.is_finite(), at, number);
                }
            }
            Demand::Indices { vertices, triangles } => {
                let index = numbers[0];
                first.note(index >= vertices as f64, at, index);
                second.note(index == elements.layout.component.largest(), at, index);
                self.corners[(at % 3) as usize] = index;
                let [a, b, c] = self.corners;
                if triangles && at % 3 == 2 && (a == b || b == c || c == a) {
                    self.last = self.last.max(0.0) + 1.0;
                }
            }
            Demand::Times => {
                first.note(numbers[0] < 0.0, at, numbers[0]);
                second.note(numbers[0] <= self.last && numbers[0] >= 0.0, at, numbers[0]);
                self.last = numbers[0];
            }
            Demand::Quaternions { spline } if !spline || at % 3 == 1 => {
                let length = length(numbers);
                first.note(length.is_finite() && (length - 1.0).abs() > UNIT_4, at, length);
            }
            Demand::Quaternions { .. } => {}
            Demand::Matrices => {
                for (place, due) in [(3, 0.0), (7, 0.0), (11, 0.0), (15, 1.0)] {
                    let number = numbers.get(place).copied().unwrap_or(due);
                    first.note(number != due, at, number);
                }
            }
        }
    }

    fn tell(&self, document: &Document<'_>, total: u64) {
        let say = |code: &Code, tally: &Tally, what: &dyn Display| {
            let Tally { count, first, value } = tally;
            if *count > 0 {
                let message = format_args!(
                    "{what} (how many: {count} of {total}; the first is {value}, in element {first})"
                );
                document.findings.add(code, self.pointer, message);
            }
        };
        let [first, second] = &self.tallies;
        match self.demand {
            Demand::Unit => {
                say(&codes::ACCESSOR_VECTOR3_NON_UNIT, first, &"vectors are not of unit length");
                say(&codes::ACCESSOR_INVALID_SIGN, second, &"signs are neither 1 nor -1");
            }
            Demand::Clamped => {
                say(&codes::ACCESSOR_NON_CLAMPED, first, &"numbers are not in [0, 1]");
            }
            Demand::Indices { vertices, .. } => {
                let what = format_args!("indices have no vertex, of which there are {vertices}");
                say(&codes::ACCESSOR_INDEX_OOB, first, &what);
                let what = "indices are the largest number, which restarts strips elsewhere";
                say(&codes::ACCESSOR_INDEX_PRIMITIVE_RESTART, second, &what);
                if self.last > 0.0 {
                    let message =
                        format_args!("{} triangles have two corners at one vertex", self.last);
                    let code = &codes::ACCESSOR_INDEX_TRIANGLE_DEGENERATE;
                    document.findings.add(code, self.pointer, message);
                }
            }
            Demand::Times => {
                say(&codes::ACCESSOR_ANIMATION_INPUT_NEGATIVE, first, &"times are negative");
                say(&codes::ACCESSOR_ANIMATION_INPUT_NON_INCREASING, second, &"times do not rise");
            }
            Demand::Quaternions { .. } => {
                let code = &codes::ACCESSOR_ANIMATION_SAMPLER_OUTPUT_NON_NORMALIZED_QUATERNION;
                say(code, first, &"rotations are not of unit length");
            }
            Demand::Matrices => {
                let what = "numbers of the last rows are not 0, 0, 0, 1";
                say(&codes::ACCESSOR_INVALID_IBM, first, &what);
            }
        }
    }
}
