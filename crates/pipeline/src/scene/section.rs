//! Resolution of section planes.

use super::file::SectionFile;
use super::syntax::PathStep::{Field, Index};
use super::{Origin, SceneError};
use homog::{Normal, Plane, Point, World};

/// More cuts than this are a slip, and each costs another pass over the models.
const MAX_SECTIONS: usize = 16;

/// The planes of the sections. Their normals have length 1 and point to the half that is retained.
pub(super) fn resolve_sections(
    origin: &Origin,
    sections: &[SectionFile],
) -> Result<Vec<Plane<World>>, SceneError> {
    check_section_count(origin, sections)?;
    let numbered = sections.iter().enumerate();
    numbered.map(|(at, section)| resolve_section(origin, at, section)).collect()
}

/// Whether there are not too many sections.
pub(super) fn check_section_count(
    origin: &Origin,
    sections: &[SectionFile],
) -> Result<(), SceneError> {
    if sections.len() <= MAX_SECTIONS {
        return Ok(());
    }
    let message = format!("{} sections are more than {MAX_SECTIONS}", sections.len());
    Err(origin.error_at(&[Field("sections")], message, None))
}

/// The plane of a section. Its normal has length 1 and points to the half that is retained.
pub(super) fn resolve_section(
    origin: &Origin,
    at: usize,
    section: &SectionFile,
) -> Result<Plane<World>, SceneError> {
    let [x, y, z] = section.normal.0;
    // Scaled first, so that no square leaves the range of numbers.
    let largest = x.abs().max(y.abs()).max(z.abs());
    let unit = Normal::<World>::new(-x / largest, -y / largest, -z / largest).normalized();
    let fault = || {
        let path = [Field("sections"), Index(at), Field("normal")];
        let help =
            "the normal points to the half that is removed, such as normal: (0, 0, 1)".to_owned();
        origin.error_at(&path, "a section needs a direction: its normal has no length", Some(help))
    };
    let unit = unit.filter(|_| largest > 0.0).ok_or_else(fault)?;
    Ok(Plane::through(Point::from(section.point.0), unit))
}
