//! Items from the sources that the other tests do not cover, each tested against its formula.

use clip::{Outcode, PlaneIndex, Volume, clip_segment};
use glam::{DMat4, DVec4};
use homog::{Clip, HPoint, Point, Projective, View};

/// Points that are each beyond exactly one border, with near at +1 as in the chapter.
const BEYOND: [([f64; 3], PlaneIndex, &str); 6] = [
    ([-1.5, 0.0, 0.0], PlaneIndex::LEFT, "left"),
    ([1.5, 0.0, 0.0], PlaneIndex::RIGHT, "right"),
    ([0.0, -1.5, 0.0], PlaneIndex::BOTTOM, "bottom"),
    ([0.0, 1.5, 0.0], PlaneIndex::TOP, "top"),
    ([0.0, 0.0, 1.5], PlaneIndex::NEAR, "near"),
    ([0.0, 0.0, -1.5], PlaneIndex::FAR, "far"),
];

fn at(p: [f64; 3], w: f64) -> HPoint<Clip> {
    HPoint::new(p[0] * w, p[1] * w, p[2] * w, w)
}

/// C4, C7, C85: six named planes bound the volume, and the coordinates of a point determine which
/// of them it is beyond, for any w > 0.
#[test]
fn the_canonical_volume_has_six_named_planes() {
    let volume = Volume::CHAPTER;
    assert_eq!(volume.active_planes().planes().count(), 6);
    for w in [1e-3, 1.0, 7.0] {
        for (p, plane, name) in BEYOND {
            assert_eq!(volume.outcode(at(p, w)), Outcode::INSIDE.with_plane(plane), "{name}");
            assert_eq!(plane.to_string(), name);
            assert!(volume.plane(plane).expect("present").evaluate(at(p, w)) < 0.0);
        }
        for corner in 0..8_u8 {
            let sign = |bit: u8| if corner & bit == 0 { -1.0 } else { 1.0 };
            assert!(
                volume.contains(at([sign(1), sign(2), sign(4)], w)),
                "borders should be inside"
            );
        }
    }
}

/// The signed distance from a side of the canonical frustum, in the side's units; positive inside.
type Side = fn([f64; 3]) -> f64;

/// C87: in the canonical frustum the sides are x = ±z and y = ±z. Clipping there, before depth is
/// mapped, cuts at the same points: t = d/(d − d′), where d is the distance from a side.
#[test]
fn clipping_in_the_canonical_frustum_cuts_at_the_same_points() {
    let (near, far) = (0.25, 1.0);
    let depth = DMat4::from_cols(
        DVec4::X,
        DVec4::Y,
        DVec4::new(0.0, 0.0, (far + near) / (far - near), -1.0),
        DVec4::new(0.0, 0.0, 2.0 * far * near / (far - near), 0.0),
    );
    let depth = Projective::<View, Clip>::from_raw(depth);
    let sides: [(PlaneIndex, Side); 6] = [
        (PlaneIndex::LEFT, |[x, _, z]| x - z),
        (PlaneIndex::RIGHT, |[x, _, z]| -x - z),
        (PlaneIndex::BOTTOM, |[_, y, z]| y - z),
        (PlaneIndex::TOP, |[_, y, z]| -y - z),
        (PlaneIndex::NEAR, |[_, _, z]| -0.25 - z),
        (PlaneIndex::FAR, |[_, _, z]| z + 1.0),
    ];
    let inside = [0.1, -0.1, -0.5];
    let outside =
        [[2.0, 0.0, -0.5], [-1.0, 0.3, -0.4], [0.0, 3.0, 1.0], [0.1, -0.1, -4.0], [0.2, 0.1, 3.0]];
    for end in outside {
        let leaving = |side: Side| {
            let (d, beyond) = (side(inside), side(end));
            if beyond < 0.0 { d / (d - beyond) } else { 1.0 }
        };
        let due = sides.into_iter().map(|(plane, side)| (leaving(side), plane));
        let due = due.fold(
            (1.0, None),
            |first, (t, plane)| {
                if t < first.0 { (t, Some(plane)) } else { first }
            },
        );
        let [p, q] = [inside, end].map(|place| depth.transform_point(Point::<View>::from(place)));
        let cut = clip_segment(p, q, &Volume::CHAPTER).expect("it starts inside");
        assert!((cut.t1 - due.0).abs() < 1e-15 && cut.exit == due.1, "{end:?}: {cut:?}");
    }
}
