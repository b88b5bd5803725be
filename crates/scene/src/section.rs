//! Resolution of section planes.

use super::Origin;
use super::diagnostics::Diagnostics;
use homog::{Normal, Plane, Point, World};
use scene_file::PathStep::{Field, Index};
use scene_file::SceneError;
use scene_file::file::SectionFile;

/// The maximum number of sections. A longer list is probably a mistake, and each section costs
/// another pass over the models.
const MAX_SECTIONS: usize = 16;

/// Returns the planes of the sections. Their normals have length 1 and point to the half that is
/// retained.
pub(super) fn resolve_sections(
    origin: &Origin,
    sections: &[SectionFile],
    faults: &mut Diagnostics,
) -> Option<Vec<Plane<World>>> {
    if sections.len() > MAX_SECTIONS {
        let message =
            format!("too many sections: {}; at most {MAX_SECTIONS} are allowed", sections.len());
        faults.report(origin.error_at(&[Field("sections")], message, None));
    }
    let numbered = sections.iter().enumerate();
    let planes: Vec<_> =
        numbered.map(|(at, section)| faults.take(resolve_section(origin, at, section))).collect();
    planes.into_iter().collect()
}

/// Returns the plane of a section. Its normal has length 1 and points to the half that is retained.
fn resolve_section(
    origin: &Origin,
    at: usize,
    section: &SectionFile,
) -> Result<Plane<World>, SceneError> {
    let [x, y, z] = section.normal.0;
    // Scale first, so that no square overflows or underflows.
    let largest = x.abs().max(y.abs()).max(z.abs());
    let unit = Normal::<World>::new(-x / largest, -y / largest, -z / largest).normalized();
    let fault = || {
        let path = [Field("sections"), Index(at), Field("normal")];
        let help =
            "point the normal toward the half to remove, such as normal: (0, 0, 1)".to_owned();
        origin.error_at(&path, "the normal of a section must not be (0, 0, 0)", Some(help))
    };
    let unit = unit.filter(|_| largest > 0.0).ok_or_else(fault)?;
    Ok(Plane::through(Point::from(section.point.0), unit))
}
