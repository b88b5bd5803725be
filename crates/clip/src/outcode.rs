//! Outcodes: one bit per plane that a point is outside of (CL-1; Cohen and Sutherland, about 1967).
//!
//! ```text
//!   bit 0 left   1 right   2 bottom   3 top   4 near   5 far   6… user planes
//!
//!      1001 │ 1000 │ 1010          a | b = 0   both inside all planes: accept
//!      ─────┼──────┼─────          a & b ≠ 0   both outside of one plane: reject
//!      0001 │ 0000 │ 0010          otherwise   look closer
//!      ─────┼──────┼─────
//!      0101 │ 0100 │ 0110          (bits 3 to 0: top, bottom, right, left)
//! ```

use core::fmt;
use core::ops::{BitAnd, BitOr, BitOrAssign};

/// The maximum number of planes in a volume: the six of the box and ten more.
pub const MAX_PLANES: usize = 16;

/// The index of a plane in its volume: six named planes, then the user planes.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct PlaneIndex(u8);

impl PlaneIndex {
    /// The plane of minimum x.
    pub const LEFT: Self = Self(0);
    /// The plane of maximum x.
    pub const RIGHT: Self = Self(1);
    /// The plane of minimum y.
    pub const BOTTOM: Self = Self(2);
    /// The plane of maximum y.
    pub const TOP: Self = Self(3);
    /// The plane toward the eye.
    pub const NEAR: Self = Self(4);
    /// The plane away from the eye.
    pub const FAR: Self = Self(5);
    /// The six planes of the box, in order.
    pub const BOX: [Self; 6] =
        [Self::LEFT, Self::RIGHT, Self::BOTTOM, Self::TOP, Self::NEAR, Self::FAR];

    /// Returns the `n`-th user plane, counted from 0, or `None` beyond the capacity of a volume.
    #[must_use]
    pub fn added(n: usize) -> Option<Self> {
        Self::new(n.checked_add(Self::BOX.len())?)
    }

    /// Returns the plane with this number, or `None` unless it is below [`MAX_PLANES`].
    #[must_use]
    pub fn new(index: usize) -> Option<Self> {
        u8::try_from(index).ok().filter(|_| index < MAX_PLANES).map(Self)
    }

    /// Returns the number of the plane, counted from 0.
    #[must_use]
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}

impl fmt::Display for PlaneIndex {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const NAMES: [&str; 6] = ["left", "right", "bottom", "top", "near", "far"];
        match NAMES.get(self.index()) {
            Some(name) => f.pad(name),
            None => write!(f, "plane {}", self.index() - NAMES.len()),
        }
    }
}

/// A set of planes that a point is outside of.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Default, Debug)]
pub struct Outcode(u16);

impl Outcode {
    /// No planes: the point is inside.
    pub const INSIDE: Self = Self(0);
    /// All planes.
    pub const ALL: Self = Self(u16::MAX);

    /// Creates the set with these bits: bit i represents plane i.
    #[must_use]
    pub const fn from_bits(bits: u16) -> Self {
        Self(bits)
    }

    /// Returns one bit per plane: bit i represents plane i.
    #[must_use]
    pub const fn bits(self) -> u16 {
        self.0
    }

    /// Returns whether the set is empty.
    #[must_use]
    pub const fn is_inside(self) -> bool {
        self.0 == 0
    }

    /// Returns whether `plane` is in the set.
    #[must_use]
    pub const fn contains(self, plane: PlaneIndex) -> bool {
        self.0 >> plane.0 & 1 == 1
    }

    /// Returns the set with `plane` added.
    #[must_use]
    pub const fn with_plane(self, plane: PlaneIndex) -> Self {
        Self(self.0 | 1 << plane.0)
    }

    /// Returns the set with `plane` removed.
    #[must_use]
    pub const fn without_plane(self, plane: PlaneIndex) -> Self {
        Self(self.0 & !(1 << plane.0))
    }

    /// Returns whether points with these outcodes, and everything between them, are inside: `a |
    /// b | … = 0`.
    #[must_use]
    pub fn trivially_accepts(outcodes: &[Self]) -> bool {
        outcodes.iter().all(|code| code.is_inside())
    }

    /// Returns the planes that all of these points are outside of, `a & b & …`. If there is such a
    /// plane, nothing between the points is inside.
    #[must_use]
    pub fn trivially_rejects(outcodes: &[Self]) -> Self {
        let all = outcodes.iter().copied().reduce(|a, b| a & b);
        all.unwrap_or_default()
    }

    /// Returns the planes of the set, in order.
    pub fn planes(self) -> impl Iterator<Item = PlaneIndex> + Clone {
        let mut rest = self.0;
        core::iter::from_fn(move || {
            let lowest = rest.trailing_zeros() as u8;
            (rest != 0).then(|| {
                rest &= rest - 1;
                PlaneIndex(lowest)
            })
        })
    }
}

impl BitAnd for Outcode {
    type Output = Self;
    fn bitand(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }
}

impl BitOr for Outcode {
    type Output = Self;
    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl BitOrAssign for Outcode {
    fn bitor_assign(&mut self, other: Self) {
        self.0 |= other.0;
    }
}

impl fmt::Display for Outcode {
    /// Writes the plane names joined by `+`, or `inside` if the set is empty.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_inside() {
            return f.pad("inside");
        }
        for (i, plane) in self.planes().enumerate() {
            write!(f, "{}{plane}", if i == 0 { "" } else { "+" })?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::string::ToString;

    #[test]
    fn sets_contain_added_planes_and_print_their_names() {
        let code = Outcode::INSIDE.with_plane(PlaneIndex::LEFT).with_plane(PlaneIndex::FAR);
        assert_eq!(code.bits(), 0b10_0001);
        assert_eq!(code.to_string(), "left+far");
        assert_eq!(code.without_plane(PlaneIndex::FAR).to_string(), "left");
        assert_eq!(Outcode::INSIDE.to_string(), "inside");
        let names = PlaneIndex::BOX.map(|plane| plane.to_string());
        assert_eq!(names, ["left", "right", "bottom", "top", "near", "far"]);
        let added = PlaneIndex::added(9).expect("the last plane");
        assert_eq!(added.to_string(), "plane 9");
        assert_eq!(PlaneIndex::added(10), None);
        assert_eq!(PlaneIndex::added(usize::MAX), None);
        assert_eq!(Outcode::ALL.planes().count(), MAX_PLANES);
    }

    #[test]
    fn outcodes_decide_trivial_acceptance_and_rejection() {
        let [a, b] = [0b01, 0b11].map(Outcode::from_bits);
        assert_eq!(Outcode::trivially_rejects(&[a, b]), a);
        assert!(Outcode::trivially_rejects(&[a, Outcode::INSIDE]).is_inside());
        assert!(!Outcode::trivially_accepts(&[a, Outcode::INSIDE]));
        assert!(Outcode::trivially_accepts(&[Outcode::INSIDE; 3]));
        assert!(Outcode::trivially_rejects(&[]).is_inside());
    }
}
