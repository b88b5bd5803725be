//! The published patches of Martin Newell's teapot (University of Utah, 1975).
//!
//! There are 32 bicubic Bézier patches. The last four form the bottom that Frank Crow added ("The
//! Origins of the Teapot", IEEE Computer Graphics and Applications 7(1), 1987). The published table
//! lists 306 control points. All but a few dozen follow from the others. Body, lid and bottom are
//! outlines swept about the axis in four quarters, with inner control points at 0.56 of the radius,
//! where a circle would need 0.5523. Handle and spout are halves with their mirror images. This
//! file contains only the outlines and halves, and builds the 32 patches from them. The test
//! compares the patches with entries of the table.
//!
//! z is up, as in the table; the spout points along +x and the handle along −x.

use glam::{DVec3, dvec3};

/// A bicubic patch: four rows of four control points.
pub(crate) type Patch = [[DVec3; 4]; 4];

/// A part of the pot and its patches.
pub(crate) struct Part {
    pub(crate) name: &'static str,
    pub(crate) patches: Vec<Patch>,
}

/// A point of an outline: radius, height, and the position of a quarter circle's inner control
/// points as a fraction of the radius.
type Ring = (f64, f64, f64);

const QUARTER: f64 = 0.56;
/// Newell's lid knob is a little rounder: 0.45 for a radius of 0.8.
const KNOB: f64 = 0.5625;

const RIM: [Ring; 4] = [
    (1.4, 2.4, QUARTER),
    (1.3375, 2.53125, QUARTER),
    (1.4375, 2.53125, QUARTER),
    (1.5, 2.4, QUARTER),
];
const UPPER_BODY: [Ring; 4] =
    [(1.5, 2.4, QUARTER), (1.75, 1.875, QUARTER), (2.0, 1.35, QUARTER), (2.0, 0.9, QUARTER)];
const LOWER_BODY: [Ring; 4] =
    [(2.0, 0.9, QUARTER), (2.0, 0.45, QUARTER), (1.5, 0.225, QUARTER), (1.5, 0.15, QUARTER)];
const LID_KNOB: [Ring; 4] =
    [(0.0, 3.15, QUARTER), (0.8, 3.15, KNOB), (0.0, 2.85, QUARTER), (0.2, 2.7, QUARTER)];
const LID: [Ring; 4] =
    [(0.2, 2.7, QUARTER), (0.4, 2.55, QUARTER), (1.3, 2.55, QUARTER), (1.3, 2.4, QUARTER)];
/// From the foot to the center, the reverse of the table's order, so that the outside faces down.
const BOTTOM: [Ring; 4] =
    [(1.5, 0.15, QUARTER), (1.5, 0.075, QUARTER), (1.425, 0.0, QUARTER), (0.0, 0.0, QUARTER)];

/// One half of the handle or spout, with y ≤ 0: rows run along the tube, columns around it.
type HalfPatch = [[[f64; 3]; 4]; 4];

const UPPER_HANDLE: HalfPatch = [
    [[-1.6, 0.0, 2.025], [-1.6, -0.3, 2.025], [-1.5, -0.3, 2.25], [-1.5, 0.0, 2.25]],
    [[-2.3, 0.0, 2.025], [-2.3, -0.3, 2.025], [-2.5, -0.3, 2.25], [-2.5, 0.0, 2.25]],
    [[-2.7, 0.0, 2.025], [-2.7, -0.3, 2.025], [-3.0, -0.3, 2.25], [-3.0, 0.0, 2.25]],
    [[-2.7, 0.0, 1.8], [-2.7, -0.3, 1.8], [-3.0, -0.3, 1.8], [-3.0, 0.0, 1.8]],
];
const LOWER_HANDLE: HalfPatch = [
    [[-2.7, 0.0, 1.8], [-2.7, -0.3, 1.8], [-3.0, -0.3, 1.8], [-3.0, 0.0, 1.8]],
    [[-2.7, 0.0, 1.575], [-2.7, -0.3, 1.575], [-3.0, -0.3, 1.35], [-3.0, 0.0, 1.35]],
    [[-2.5, 0.0, 1.125], [-2.5, -0.3, 1.125], [-2.65, -0.3, 0.9375], [-2.65, 0.0, 0.9375]],
    [[-2.0, 0.0, 0.9], [-2.0, -0.3, 0.9], [-1.9, -0.3, 0.6], [-1.9, 0.0, 0.6]],
];
const LOWER_SPOUT: HalfPatch = [
    [[1.7, 0.0, 1.425], [1.7, -0.66, 1.425], [1.7, -0.66, 0.6], [1.7, 0.0, 0.6]],
    [[2.6, 0.0, 1.425], [2.6, -0.66, 1.425], [3.1, -0.66, 0.825], [3.1, 0.0, 0.825]],
    [[2.3, 0.0, 2.1], [2.3, -0.25, 2.1], [2.4, -0.25, 2.025], [2.4, 0.0, 2.025]],
    [[2.7, 0.0, 2.4], [2.7, -0.25, 2.4], [3.3, -0.25, 2.4], [3.3, 0.0, 2.4]],
];
const UPPER_SPOUT: HalfPatch = [
    [[2.7, 0.0, 2.4], [2.7, -0.25, 2.4], [3.3, -0.25, 2.4], [3.3, 0.0, 2.4]],
    [[2.8, 0.0, 2.475], [2.8, -0.25, 2.475], [3.525, -0.25, 2.49375], [3.525, 0.0, 2.49375]],
    [[2.9, 0.0, 2.475], [2.9, -0.15, 2.475], [3.45, -0.15, 2.5125], [3.45, 0.0, 2.5125]],
    [[2.8, 0.0, 2.4], [2.8, -0.15, 2.4], [3.2, -0.15, 2.4], [3.2, 0.0, 2.4]],
];

/// Returns the parts of the pot, in the order of the published table.
#[must_use]
pub(crate) fn teapot_parts() -> Vec<Part> {
    let turned = |outlines: &[&[Ring; 4]]| {
        outlines.iter().flat_map(|rings| quarter_patches(rings)).collect()
    };
    let halves =
        |list: &[&HalfPatch]| list.iter().flat_map(|half| mirrored_patches(half)).collect();
    vec![
        Part { name: "body", patches: turned(&[&RIM, &UPPER_BODY, &LOWER_BODY]) },
        Part { name: "handle", patches: halves(&[&UPPER_HANDLE, &LOWER_HANDLE]) },
        Part { name: "spout", patches: halves(&[&LOWER_SPOUT, &UPPER_SPOUT]) },
        Part { name: "lid", patches: turned(&[&LID_KNOB, &LID]) },
        Part { name: "bottom", patches: turned(&[&BOTTOM]) },
    ]
}

/// Sweeps an outline about the z axis: four patches, clockwise seen from above.
fn quarter_patches(outline: &[Ring; 4]) -> [Patch; 4] {
    let first = outline.map(|(radius, z, share)| {
        let inner = radius * share;
        [
            dvec3(radius, 0.0, z),
            dvec3(radius, -inner, z),
            dvec3(inner, -radius, z),
            dvec3(0.0, -radius, z),
        ]
    });
    let turn = |patch: Patch| patch.map(|row| row.map(|p| dvec3(p.y, -p.x, p.z)));
    let second = turn(first);
    let third = turn(second);
    [first, second, third, turn(third)]
}

/// Returns a half and its mirror image in the plane y = 0, whose columns run the other way so that
/// the outside stays outside.
fn mirrored_patches(half: &HalfPatch) -> [Patch; 2] {
    let patch = half.map(|row| row.map(DVec3::from));
    let mirrored = patch.map(|[a, b, c, d]| [d, c, b, a].map(|p| dvec3(p.x, -p.y, p.z)));
    [patch, mirrored]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// (patch, row, column) in the published table, all counted from 0, and the control point
    /// there.
    const PUBLISHED: [(usize, usize, usize, [f64; 3]); 14] = [
        (0, 0, 1, [1.4, -0.784, 2.4]),
        (1, 1, 1, [-0.749, -1.3375, 2.53125]),
        (2, 3, 3, [0.0, 1.5, 2.4]),
        (3, 2, 2, [1.4375, 0.805, 2.53125]),
        (5, 1, 2, [-1.75, -0.98, 1.875]),
        (10, 2, 1, [-1.5, 0.84, 0.225]),
        (13, 3, 0, [-3.0, 0.0, 1.8]),
        (14, 3, 2, [-1.9, -0.3, 0.6]),
        (15, 2, 2, [-2.5, 0.3, 1.125]),
        (17, 1, 1, [3.1, 0.66, 0.825]),
        (18, 2, 2, [3.45, -0.15, 2.5125]),
        (21, 1, 1, [-0.45, -0.8, 3.15]),
        (23, 2, 3, [0.0, 0.0, 2.85]),
        (27, 2, 1, [0.728, 1.3, 2.55]),
    ];

    #[test]
    fn patches_match_the_published_table() {
        let patches: Vec<Patch> =
            teapot_parts().into_iter().flat_map(|part| part.patches).collect();
        assert_eq!(patches.len(), 32);
        for (patch, row, column, expected) in PUBLISHED {
            let found = patches[patch][row][column];
            assert!(
                (found - DVec3::from(expected)).length() < 1e-12,
                "{patch} {row} {column}: {found}"
            );
        }
    }

    #[test]
    fn neighboring_patches_share_a_border() {
        for part in teapot_parts() {
            let column = |patch: &Patch, i: usize| patch.map(|row| row[i]);
            let all = &part.patches;
            for patch in all {
                let right = column(patch, 3);
                assert!(all.iter().any(|other| column(other, 0) == right), "{}", part.name);
            }
        }
    }
}
