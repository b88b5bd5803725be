//! Normals: which way a surface faces at a fragment.

use super::Draw;
use super::corners::{Carried, Corners, NORMAL, PLACE, blend};
use super::seen::dots;

/// Some vectors, or places, in lanes.
type Vectors<const N: usize> = [[f32; N]; 3];

impl Draw<'_> {
    /// What the corners carry of places in the world.
    #[inline(always)]
    pub(super) fn places<const N: usize>(&self, corners: &Corners<N>) -> Carried<N, 3> {
        corners.carried(&self.vertices, PLACE)
    }

    /// The unit normals on the front side; `faces` are those of the triangles, which count where there are no others.
    #[inline(always)]
    pub(super) fn front_normals<const N: usize>(
        &self,
        corners: &Corners<N>,
        weights: &[[f32; N]; 3],
        faces: &Vectors<N>,
    ) -> Vectors<N> {
        let mut normals = *faces;
        if self.smooth {
            normals = blend(&corners.carried(&self.vertices, NORMAL), weights);
        }
        let squares = dots(&normals, &normals);
        let mut all_are_long = true;
        for lane in 0..N {
            let length = squares[lane].sqrt();
            all_are_long &= length > 0.0 && length < f32::INFINITY;
            for axis in &mut normals {
                axis[lane] /= length;
            }
        }
        if !all_are_long {
            self.stand_in(corners, &squares, &mut normals);
        }
        normals
    }

    /// Where the normal is too short or too long to have a direction, that of the face, or any.
    #[cold]
    fn stand_in<const N: usize>(
        &self,
        corners: &Corners<N>,
        squares: &[f32; N],
        normals: &mut Vectors<N>,
    ) {
        let faces = self.face_normals(&self.places(corners));
        for lane in 0..N {
            if !(squares[lane] > 0.0 && squares[lane].is_finite()) {
                let face = [0, 1, 2].map(|axis: usize| faces[axis][lane]);
                let unit = unit(face).unwrap_or([0.0, 0.0, 1.0]);
                for (axis, value) in normals.iter_mut().zip(unit) {
                    axis[lane] = value;
                }
            }
        }
    }

    /// Perpendicular to the triangles with corners at these places, on their front side; the lengths are twice their areas.
    #[inline(always)]
    pub(super) fn face_normals<const N: usize>(&self, [a, b, c]: &Carried<N, 3>) -> Vectors<N> {
        let mut normals = [[0.0; N]; 3];
        let sign = if self.mirrored { -1.0 } else { 1.0 };
        for lane in 0..N {
            let [ux, uy, uz] =
                [b[0][lane] - a[0][lane], b[1][lane] - a[1][lane], b[2][lane] - a[2][lane]];
            let [vx, vy, vz] =
                [c[0][lane] - a[0][lane], c[1][lane] - a[1][lane], c[2][lane] - a[2][lane]];
            normals[0][lane] = sign * (uy * vz - uz * vy);
            normals[1][lane] = sign * (uz * vx - ux * vz);
            normals[2][lane] = sign * (ux * vy - uy * vx);
        }
        normals
    }
}

/// Turns those normals round whose faces are seen from behind.
///
/// The face's own normal decides which side is seen: a smooth one may lean away from the viewer near the outline of a body
/// and is right to do so. `viewer` is the eye, homogeneous.
#[inline(always)]
pub(super) fn turn_to_viewer<const N: usize>(
    normals: &mut Vectors<N>,
    faces: &Vectors<N>,
    places: &Vectors<N>,
    viewer: [f32; 4],
) {
    let mut ways = *places;
    for axis in 0..3 {
        for lane in 0..N {
            ways[axis][lane] = viewer[axis] - places[axis][lane] * viewer[3];
        }
    }
    let towards = dots(faces, &ways);
    for axis in normals {
        for lane in 0..N {
            axis[lane] = if towards[lane] < 0.0 { -axis[lane] } else { axis[lane] };
        }
    }
}

/// The vector at length 1; `None` if it is too short or too long to have a direction.
fn unit(v: [f32; 3]) -> Option<[f32; 3]> {
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    (length > 0.0 && length.is_finite()).then(|| v.map(|c| c / length))
}
