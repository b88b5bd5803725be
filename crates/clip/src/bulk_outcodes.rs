//! Arrays of points: projection and outcodes in one pass.
//!
//! Most meshes are completely visible or completely hidden. [`OutcodeSummary`] detects both cases
//! with two comparisons. For other meshes, the outcodes of a triangle's corners decide whether to
//! clip it:
//!
//! ```
//! use clip::{OutcodeSummary, Outcode, Volume};
//! use homog::{Clip, HPoint, Model, Projective};
//! let model_to_clip = Projective::<Model, Clip>::from_raw(glam::DMat4::IDENTITY);
//! let positions = [[0.0_f32, 0.0, 0.0], [0.5, 0.5, 0.5], [3.0, 0.0, 0.0]];
//! let mut points = [HPoint::<Clip>::new(0.0, 0.0, 0.0, 1.0); 3];
//! let mut outcodes = [Outcode::INSIDE; 3];
//! let volume = Volume::CHAPTER;
//! let summary =
//!     volume.project_positions(model_to_clip, &positions, &mut points, &mut outcodes);
//! assert!(!summary.is_inside() && !summary.is_outside()); // test each triangle
//! assert_eq!(summary.count, 3);
//! ```

use crate::{Outcode, Volume};
use glam::{DVec4, Mat4, Vec4};
use homog::{Clip, HPoint, Point, Projective, Space};

/// The outcodes of an array of points, combined.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct OutcodeSummary {
    /// The number of points examined: the length of the shortest slice.
    pub count: usize,
    /// The planes that at least one point is outside of.
    pub any_outside: Outcode,
    /// The planes that all points are outside of; empty if there are no points.
    pub all_outside: Outcode,
}

impl OutcodeSummary {
    const EMPTY: Self = Self { count: 0, any_outside: Outcode::INSIDE, all_outside: Outcode::ALL };

    /// Returns whether every point is inside; if so, everything between the points is also inside.
    #[must_use]
    pub fn is_inside(&self) -> bool {
        self.any_outside.is_inside()
    }

    /// Returns whether all points are outside of one plane; if so, everything between the points is
    /// also outside.
    #[must_use]
    pub fn is_outside(&self) -> bool {
        !self.all_outside.is_inside()
    }

    fn add_outcode(&mut self, code: Outcode) {
        self.count += 1;
        self.any_outside |= code;
        self.all_outside = self.all_outside & code;
    }

    fn finish(self) -> Self {
        if self.count == 0 { Self { all_outside: Outcode::INSIDE, ..self } } else { self }
    }
}

impl Volume {
    /// Computes the outcodes of many points. Extra elements of the longer slice are ignored.
    pub fn compute_outcodes(
        &self,
        points: &[HPoint<Clip>],
        outcodes: &mut [Outcode],
    ) -> OutcodeSummary {
        let mut summary = OutcodeSummary::EMPTY;
        for (point, code) in points.iter().zip(outcodes) {
            *code = self.outcode(*point);
            summary.add_outcode(*code);
        }
        summary.finish()
    }

    /// Projects many positions in f64 and computes their outcodes. Extra elements of the longer
    /// slices are ignored.
    pub fn project_positions<S: Space>(
        &self,
        source_to_clip: Projective<S, Clip>,
        positions: &[[f32; 3]],
        points: &mut [HPoint<Clip>],
        outcodes: &mut [Outcode],
    ) -> OutcodeSummary {
        let mut summary = OutcodeSummary::EMPTY;
        for ((position, point), code) in positions.iter().zip(points).zip(outcodes) {
            *point = source_to_clip.transform_point(Point::from(position.map(f64::from)));
            *code = self.outcode(*point);
            summary.add_outcode(*code);
        }
        summary.finish()
    }

    /// Projects many positions in f32, with half the memory and about seven digits. Use it for
    /// previews and bounds; where pixels depend on the result, use [`Self::project_positions`].
    ///
    /// Every coordinate is ((x·m₀ + y·m₁) + z·m₂) + m₃, added in this order, so the bits are the
    /// same on every machine.
    pub fn project_positions_f32<S: Space>(
        &self,
        source_to_clip: Projective<S, Clip>,
        positions: &[[f32; 3]],
        points: &mut [[f32; 4]],
        outcodes: &mut [Outcode],
    ) -> OutcodeSummary {
        let [a, b, c, d] = matrix_columns_f32(source_to_clip);
        let mut summary = OutcodeSummary::EMPTY;
        for ((&[x, y, z], point), code) in positions.iter().zip(points).zip(outcodes) {
            for i in 0..4 {
                point[i] = ((x * a[i] + y * b[i]) + z * c[i]) + d[i];
            }
            *code = self.outcode(HPoint::from(point.map(f64::from)));
            summary.add_outcode(*code);
        }
        summary.finish()
    }
}

fn matrix_columns_f32<S: Space>(map: Projective<S, Clip>) -> [[f32; 4]; 4] {
    let column = |c: DVec4| -> Vec4 { c.as_vec4() };
    let m = map.raw();
    Mat4::from_cols(column(m.x_axis), column(m.y_axis), column(m.z_axis), column(m.w_axis))
        .to_cols_array_2d()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DMat4;
    use homog::Model;

    fn wide() -> Projective<Model, Clip> {
        let rows = [
            [1.5, 0.1, 0.0, 0.2],
            [0.0, 2.0, 0.3, 0.0],
            [0.1, 0.0, 1.0, -0.5],
            [0.0, 0.2, -1.0, 0.7],
        ];
        Projective::from_raw(DMat4::from_cols_array_2d(&rows).transpose())
    }

    #[test]
    fn arrays_match_single_points() {
        let positions: [[f32; 3]; 64] = core::array::from_fn(|i| {
            [i as f32 * 0.11 - 3.0, (i % 7) as f32 * 0.4 - 1.0, (i % 5) as f32 - 2.0]
        });
        let (mut points, mut narrow) = ([HPoint::new(0.0, 0.0, 0.0, 0.0); 64], [[0.0_f32; 4]; 64]);
        let (mut codes, mut again, mut rough) =
            ([Outcode::INSIDE; 64], [Outcode::INSIDE; 64], [Outcode::INSIDE; 64]);
        let volume = Volume::CHAPTER.with_guard_band(2.0, 1.5).expect("allowed").without_far();
        let summary = volume.project_positions(wide(), &positions, &mut points, &mut codes);
        assert_eq!(volume.compute_outcodes(&points, &mut again), summary);
        volume.project_positions_f32(wide(), &positions, &mut narrow, &mut rough);
        for i in 0..64 {
            let expected = wide().transform_point(Point::from(positions[i].map(f64::from)));
            assert_eq!(points[i], expected);
            assert_eq!([codes[i], again[i]], [volume.outcode(expected); 2]);
            let off = (HPoint::<Clip>::from(narrow[i].map(f64::from)).raw() - expected.raw()).abs();
            assert!(off.max_element() < 1e-5, "{i}: off by {off}");
        }
        let some = codes.iter().fold(Outcode::INSIDE, |all, &code| all | code);
        assert_eq!(
            (summary.count, summary.any_outside, summary.all_outside),
            (64, some, Outcode::trivially_rejects(&codes))
        );
    }

    #[test]
    fn only_the_length_of_the_shortest_slice_is_processed() {
        let mut points = [HPoint::new(0.0, 0.0, 0.0, 0.0); 2];
        let summary = Volume::OPENGL.project_positions(
            wide(),
            &[[0.0; 3]; 5],
            &mut points,
            &mut [Outcode::INSIDE; 1],
        );
        assert_eq!(summary.count, 1);
        let nothing = Volume::OPENGL.compute_outcodes(&[], &mut [Outcode::INSIDE; 1]);
        assert!(nothing.is_inside() && !nothing.is_outside());
    }
}
