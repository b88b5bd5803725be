//! Section planes: the `--section` flag.

use scene_file::file::{SceneFile, SectionFile};

/// Section planes of a line drawing.
#[derive(Clone, Debug, Default, clap::Args)]
pub(crate) struct SectionArgs {
    /// Cut the models in a line drawing open at a plane; repeatable
    ///
    /// x=0.5 removes everything with a larger x, and -x=0.5 removes everything with a smaller x.
    /// Six numbers, as in 0,1,0,1,0,1, are a point on the plane and a vector into the removed part.
    #[arg(
        help_heading = "Lines",
        long = "section",
        value_name = "PLANE",
        value_parser = parse_section_plane,
        allow_hyphen_values = true
    )]
    pub(crate) sections: Vec<SectionFile>,
}

impl SectionArgs {
    /// Appends the planes from the flags to the scene's planes.
    pub(crate) fn append_to(&self, file: &mut SceneFile) {
        file.sections.extend(self.sections.iter().cloned());
    }
}

/// Parses `AXIS=VALUE`, `-AXIS=VALUE`, or a point and a normal as six numbers.
///
/// The normal points to the side that is removed.
///
/// ```text
/// x=0.5           point (0.5, 0, 0), normal ( 1, 0, 0)
/// -z=-2           point (0, 0, -2),  normal ( 0, 0, -1)
/// 0,1,0,1,0,1     point (0, 1, 0),   normal ( 1, 0, 1)
/// ```
/// The normal need not have unit length.
///
/// # Errors
/// Returns an error if the text has another form or a nonfinite number, or if the normal is zero.
fn parse_section_plane(text: &str) -> Result<SectionFile, String> {
    let fault = || {
        "expected a plane such as x=0.5 or -z=0, or six numbers: a point and a vector into the removed part".to_owned()
    };
    let number = |text: &str| text.trim().parse::<f64>().map_err(|_| fault());
    let (point, normal) = if let Some((axis, at)) = text.split_once('=') {
        let (sign, axis) =
            axis.trim().strip_prefix('-').map_or((1.0, axis.trim()), |axis| (-1.0, axis));
        let axis = ["x", "y", "z"].iter().position(|name| *name == axis).ok_or_else(fault)?;
        let (mut point, mut normal) = ([0.0; 3], [0.0; 3]);
        (point[axis], normal[axis]) = (number(at)?, sign);
        (point, normal)
    } else {
        let numbers = text.split(',').map(number).collect::<Result<Vec<f64>, _>>()?;
        let &[a, b, c, x, y, z] = numbers.as_slice() else { return Err(fault()) };
        ([a, b, c], [x, y, z])
    };
    SectionFile::new(point, normal).ok_or_else(fault)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planes_are_parsed_from_an_axis_or_six_numbers() {
        let plane = |text| parse_section_plane(text).map(|s| (s.point.0, s.normal.0));
        assert_eq!(plane("x=0.5"), Ok(([0.5, 0.0, 0.0], [1.0, 0.0, 0.0])));
        assert_eq!(plane("-z=-2"), Ok(([0.0, 0.0, -2.0], [0.0, 0.0, -1.0])));
        assert_eq!(plane("1, 2,3,0,-1,1"), Ok(([1.0, 2.0, 3.0], [0.0, -1.0, 1.0])));
        for wrong in
            ["", "x", "x=", "w=1", "x=nan", "1,2,3", "1,2,3,0,0,0", "1,2,3,4,5,6,7", "x=1e999"]
        {
            assert!(plane(wrong).is_err(), "{wrong}");
        }
    }
}
