//! Named views: the six principal views and the common axonometric views.
//!
//! ```text
//!             Top
//!            (+y)
//!
//!   Left    Front    Right    Back
//!   (−x)    (+z)     (+x)     (−z)
//!
//!           Bottom
//!            (−y)
//! ```
//!
//! Models face +z with +y up, as in glTF. The viewer of the front view is on the +z axis and looks
//! along −z, with +x on the right. As on a drawing, "right" is the viewer's right, not the right
//! hand of the figure.
//!
//! A name selects a direction and a view-up. Framing decides how far away the camera is.

use crate::Basis;
use core::fmt;
use core::str::FromStr;
use homog::{Vector, World};

/// A named view.
///
/// ```
/// use camera::NamedView;
/// let view: NamedView = "three-quarter".parse()?;
/// assert_eq!(view, NamedView::ThreeQuarter);
/// assert_eq!("Iso".parse(), Ok(NamedView::Isometric));
/// # Ok::<(), camera::UnknownView>(())
/// ```
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum NamedView {
    /// From +z: the face of the model.
    Front,
    /// From −z.
    Back,
    /// From −x, which is on the viewer's left in the front view.
    Left,
    /// From +x, which is on the viewer's right in the front view.
    Right,
    /// From +y, looking down. The front of the model is at the bottom of the picture.
    Top,
    /// From −y, looking up. The front of the model is at the top of the picture.
    Bottom,
    /// From (1, 1, 1): all three axes foreshortened equally, by √(2/3).
    Isometric,
    /// From (1, 1, √7). The foreshortening ratios of x, y and z are 1, 1 and ½, as in ISO 5456-3.
    /// The x axis is drawn at 7° to the horizontal and the z axis at 42°.
    Dimetric,
    /// From (2, 3, 6): three different foreshortening factors, √45/7, √40/7 and √13/7.
    Trimetric,
    /// From (2, 1, 2): halfway between front and right and slightly from above, as in product
    /// photographs.
    ThreeQuarter,
}

impl NamedView {
    /// All views, with the principal views first.
    pub const ALL: [Self; 10] = [
        Self::Front,
        Self::Back,
        Self::Left,
        Self::Right,
        Self::Top,
        Self::Bottom,
        Self::Isometric,
        Self::Dimetric,
        Self::Trimetric,
        Self::ThreeQuarter,
    ];

    /// The six views along the axes, used in multiview drawings.
    pub const PRINCIPAL: [Self; 6] =
        [Self::Front, Self::Back, Self::Left, Self::Right, Self::Top, Self::Bottom];

    /// Returns the name in lower case.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Front => "front",
            Self::Back => "back",
            Self::Left => "left",
            Self::Right => "right",
            Self::Top => "top",
            Self::Bottom => "bottom",
            Self::Isometric => "isometric",
            Self::Dimetric => "dimetric",
            Self::Trimetric => "trimetric",
            Self::ThreeQuarter => "three-quarter",
        }
    }

    /// Returns the unit vector from the model to the viewer.
    #[must_use]
    #[allow(
        clippy::wrong_self_convention,
        reason = "`from` means the viewing direction, not a conversion"
    )]
    pub fn from_direction(self) -> Vector<World> {
        let direction = match self {
            Self::Front => Vector::Z,
            Self::Back => -Vector::Z,
            Self::Left => -Vector::X,
            Self::Right => Vector::X,
            Self::Top => Vector::Y,
            Self::Bottom => -Vector::Y,
            Self::Isometric => Vector::new(1.0, 1.0, 1.0),
            Self::Dimetric => Vector::new(1.0, 1.0, libm::sqrt(7.0)),
            Self::Trimetric => Vector::new(2.0, 3.0, 6.0),
            Self::ThreeQuarter => Vector::new(2.0, 1.0, 2.0),
        };
        direction / direction.length()
    }

    /// Returns the gaze direction: opposite to [`from_direction`](Self::from_direction), a unit
    /// vector.
    #[must_use]
    pub fn gaze(self) -> Vector<World> {
        -self.from_direction()
    }

    /// Returns the view-up: +y, but −z for the top view and +z for the bottom view.
    #[must_use]
    pub fn up(self) -> Vector<World> {
        match self {
            Self::Top => -Vector::Z,
            Self::Bottom => Vector::Z,
            _ => Vector::Y,
        }
    }

    /// Returns the orientation of a camera with this view.
    #[must_use]
    pub fn basis(self) -> Basis {
        // No view has an up vector parallel to its gaze; the tests check every view.
        Basis::from_gaze(self.gaze(), self.up()).unwrap_or(Basis::WORLD)
    }
}

impl fmt::Display for NamedView {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// The error for a string that is not the name of a view.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[error(
    "unknown view: use front, back, left, right, top, bottom, isometric, dimetric, \
     trimetric or three-quarter"
)]
pub struct UnknownView;

impl FromStr for NamedView {
    type Err = UnknownView;

    /// Parses the name of a view. Case, hyphens, underscores and spaces are ignored. `iso` means
    /// isometric, and `rear` means back.
    fn from_str(text: &str) -> Result<Self, UnknownView> {
        let means = |name: &str| normalized_letters(text).eq(normalized_letters(name));
        match () {
            () if means("iso") => Ok(Self::Isometric),
            () if means("rear") => Ok(Self::Back),
            () => Self::ALL.into_iter().find(|view| means(view.name())).ok_or(UnknownView),
        }
    }
}

/// Returns the characters used to compare names: lower case, without hyphens, underscores or
/// spaces.
fn normalized_letters(text: &str) -> impl Iterator<Item = char> {
    let filler = |c: &char| matches!(c, '-' | '_' | ' ');
    text.trim().chars().filter(move |c| !filler(c)).map(|c| c.to_ascii_lowercase())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_view_has_a_basis_that_looks_along_its_gaze() {
        for view in NamedView::ALL {
            let basis = Basis::from_gaze(view.gaze(), view.up());
            assert!(basis.is_ok(), "{view} has no basis");
            assert!((view.basis().gaze() - view.gaze()).length() < 1e-15, "{view}");
            assert!(view.basis().v().dot(view.up()) > 0.5, "{view} is upside down");
        }
    }

    #[test]
    fn right_is_the_viewers_right_and_the_top_view_has_the_front_at_the_bottom() {
        assert_eq!(NamedView::Front.basis().u(), NamedView::Right.from_direction());
        assert_eq!(NamedView::Top.basis().v(), -NamedView::Front.from_direction());
        assert_eq!(NamedView::Bottom.basis().v(), NamedView::Front.from_direction());
        assert_eq!(NamedView::Top.basis().u(), Vector::X);
        assert_eq!(NamedView::Back.basis().u(), -Vector::X);
    }

    #[test]
    fn axonometric_views_have_the_documented_foreshortening() {
        let foreshortening = |view: NamedView| {
            let basis = view.basis();
            [Vector::X, Vector::Y, Vector::Z]
                .map(|axis| libm::hypot(basis.u().dot(axis), basis.v().dot(axis)))
        };
        let isometric = libm::sqrt(2.0 / 3.0);
        let root = |square: f64| libm::sqrt(square) / 7.0;
        let dimetric = libm::sqrt(8.0) / 3.0;
        for (view, want) in [
            (NamedView::Isometric, [isometric; 3]),
            (NamedView::Dimetric, [dimetric, dimetric, dimetric / 2.0]),
            (NamedView::Trimetric, [root(45.0), root(40.0), root(13.0)]),
        ] {
            for (got, want) in foreshortening(view).into_iter().zip(want) {
                assert!((got - want).abs() < 1e-15, "{view}: {got} is not {want}");
            }
        }
        let basis = NamedView::Dimetric.basis();
        let angle = |axis: Vector<World>| {
            libm::atan2(basis.v().dot(axis), basis.u().dot(axis)).to_degrees()
        };
        assert!((angle(Vector::X) + 7.18).abs() < 0.01, "x at {}", angle(Vector::X));
        assert!((angle(Vector::Z) + 180.0 - 41.41).abs() < 0.01, "z at {}", angle(Vector::Z));
    }

    #[test]
    fn names_round_trip_and_unknown_names_are_rejected() {
        for view in NamedView::ALL {
            assert_eq!(view.name().parse(), Ok(view));
        }
        assert_eq!("Three_Quarter".parse(), Ok(NamedView::ThreeQuarter));
        assert_eq!("THREE QUARTER".parse(), Ok(NamedView::ThreeQuarter));
        for strange in ["", "fron", "front2", "isometrisch"] {
            assert_eq!(strange.parse::<NamedView>(), Err(UnknownView), "{strange}");
        }
    }
}
