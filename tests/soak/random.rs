//! Random arguments, which are mostly ordinary numbers and sometimes numbers of every other kind.
//!
//! The fuzzer uses this file too, with its own source of bits.

use crate::bits::Bits;
use glam::{DMat3, DMat4, DVec3, DVec4};
use homog::{Affine, HPoint, Normal, Plane, Point, Projective, Space, Vector};
use std::f64::consts::PI;

/// The kinds of numbers that a call draws. If every number could be of any kind, functions with six
/// numbers would reject almost every call.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Mood {
    /// Numbers from −10 to 10, integers, zero with either sign, and repeats of the previous number.
    Ordinary,
    /// The ordinary numbers, and every magnitude from subnormal to the largest.
    Extreme,
    /// All of these, NaN, infinities, and arbitrary bit patterns.
    Anything,
}

/// The generator, with records of the current call.
pub struct Random {
    bits: Bits,
    mood: Mood,
    last: f64,
    only_finite: bool,
    drawn: Option<Vec<f64>>,
}

const EXTREMES: [f64; 12] = [
    f64::MAX,
    f64::MIN,
    f64::MIN_POSITIVE,
    -f64::MIN_POSITIVE,
    5e-324,
    -5e-324,
    f64::EPSILON,
    1.0 + f64::EPSILON,
    1.0 - f64::EPSILON / 2.0,
    1e154,
    1e-154,
    9_007_199_254_740_993.0,
];

impl Random {
    /// Creates a generator that draws the arguments of a call from these bits.
    pub fn new(bits: Bits) -> Self {
        let (mood, drawn) = (Mood::Ordinary, None);
        let mut random = Self { bits, mood, last: 0.0, only_finite: true, drawn };
        random.settle();
        random
    }

    /// Works like [`Self::new`], but also records the numbers it draws.
    pub fn recording(bits: Bits) -> Self {
        Self { drawn: Some(Vec::new()), ..Self::new(bits) }
    }

    /// Begins another call; returns the bits from which its arguments are drawn.
    pub fn begin(&mut self) -> Bits {
        self.bits.next();
        self.settle();
        self.bits
    }

    /// Chooses the mood of a call without consuming bits.
    fn settle(&mut self) {
        self.mood = match self.bits.peek() & 7 {
            0..=4 => Mood::Ordinary,
            5 | 6 => Mood::Extreme,
            _ => Mood::Anything,
        };
        self.only_finite = true;
        self.last = 0.0;
    }

    /// Returns whether no argument of this call was NaN or infinite.
    pub fn drew_only_finite(&self) -> bool {
        self.only_finite
    }

    pub fn drawn(&self) -> &[f64] {
        self.drawn.as_deref().unwrap_or_default()
    }

    /// Returns an integer from 0 to `count` − 1.
    pub fn below(&mut self, count: usize) -> usize {
        (self.bits.next() >> 32) as usize % count
    }

    pub fn pick<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.below(all.len())]
    }

    pub fn coin(&mut self) -> bool {
        self.bits.next() >> 63 == 1
    }

    /// Returns an arbitrary 32-bit number or, half of the time, a small one.
    pub fn count(&mut self) -> u32 {
        let bits = self.bits.next();
        let count = (bits >> 32) as u32;
        let count = if bits & 1 == 0 { count % 64 } else { count };
        self.given(count.into());
        count
    }

    /// Returns a number of a kind that the current call allows.
    pub fn number(&mut self) -> f64 {
        let mood = self.mood;
        let number = self.of(mood);
        self.last = number;
        self.given(number)
    }

    pub fn numbers<const N: usize>(&mut self) -> [f64; N] {
        std::array::from_fn(|_| self.number())
    }

    /// Returns a number, in most cases its absolute value.
    pub fn size(&mut self) -> f64 {
        let number = self.number();
        if self.below(32) == 0 { number } else { self.instead(number.abs()) }
    }

    /// Returns two sizes, mostly with the smaller first.
    pub fn near_far(&mut self) -> [f64; 2] {
        let [a, b] = [self.size(), self.size()];
        if a > b && self.below(32) > 0 { [b, a] } else { [a, b] }
    }

    /// Works like [`Self::near_far`], but the far distance is sometimes infinite.
    pub fn near_and_any_far(&mut self) -> [f64; 2] {
        let [near, far] = self.near_far();
        [near, if self.below(8) == 0 { f64::INFINITY } else { far }]
    }

    /// Returns a number mostly between 0 and π.
    pub fn opening(&mut self) -> f64 {
        let number = self.number();
        if self.below(8) == 0 { number } else { self.instead(number.abs() % PI) }
    }

    /// Returns a number mostly between 0 and 1.
    pub fn fraction(&mut self) -> f64 {
        let number = self.number();
        if self.below(8) == 0 { number } else { self.instead(number.abs().fract()) }
    }

    /// Records an argument that was computed from others, and returns it.
    pub fn given(&mut self, argument: f64) -> f64 {
        self.only_finite &= argument.is_finite();
        if let Some(drawn) = &mut self.drawn {
            drawn.push(argument);
        }
        argument
    }

    /// Records an argument in place of the number from which it was computed, and returns it.
    pub fn instead(&mut self, argument: f64) -> f64 {
        if let Some(drawn) = &mut self.drawn {
            drawn.pop();
        }
        self.given(argument)
    }

    fn of(&mut self, mood: Mood) -> f64 {
        let bits = self.bits.next();
        let unit = (bits >> 11) as f64 * (1.0 / 9_007_199_254_740_992.0);
        match (mood, bits & 15) {
            (Mood::Anything, 0) => f64::NAN,
            (Mood::Anything, 1) => f64::INFINITY,
            (Mood::Anything, 2) => f64::NEG_INFINITY,
            (Mood::Anything, 3) => f64::from_bits(self.bits.next()),
            (Mood::Anything, _) => self.of(Mood::Extreme),
            (Mood::Extreme, 0 | 1) => EXTREMES[(bits >> 32) as usize % EXTREMES.len()],
            (Mood::Extreme, 2..=7) => signed(libm::exp10(unit * 632.0 - 324.0), bits),
            (Mood::Extreme, _) => self.of(Mood::Ordinary),
            (Mood::Ordinary, 0) => signed(0.0, bits),
            (Mood::Ordinary, 1 | 2) => libm::trunc(unit * 21.0 - 10.0),
            (Mood::Ordinary, 3) => self.last,
            (Mood::Ordinary, 4) => -self.last,
            (Mood::Ordinary, _) => unit * 20.0 - 10.0,
        }
    }
}

fn signed(size: f64, bits: u64) -> f64 {
    if bits & 16 == 0 { size } else { -size }
}

/// Methods that create values made of several numbers.
impl Random {
    pub fn point<S: Space>(&mut self) -> Point<S> {
        Point::from(self.numbers())
    }

    pub fn points<S: Space, const N: usize>(&mut self) -> [Point<S>; N] {
        std::array::from_fn(|_| self.point())
    }

    pub fn vector<S: Space>(&mut self) -> Vector<S> {
        Vector::from(self.numbers())
    }

    pub fn normal<S: Space>(&mut self) -> Normal<S> {
        Normal::from_raw(DVec3::from(self.numbers()))
    }

    pub fn plane<S: Space>(&mut self) -> Plane<S> {
        Plane::from_raw(DVec4::from(self.numbers()))
    }

    pub fn hpoint<S: Space>(&mut self) -> HPoint<S> {
        HPoint::from(self.numbers::<4>())
    }

    pub fn matrix3(&mut self) -> DMat3 {
        DMat3::from_cols_array(&self.numbers())
    }

    pub fn matrix4(&mut self) -> DMat4 {
        DMat4::from_cols_array(&self.numbers())
    }

    pub fn affine<A: Space, B: Space>(&mut self) -> Affine<A, B> {
        let [x, y, z] = [self.vector(), self.vector(), self.vector()];
        Affine::from_frame(x, y, z, self.point())
    }

    pub fn projective<A: Space, B: Space>(&mut self) -> Projective<A, B> {
        Projective::from_raw(self.matrix4())
    }
}
