//! The family of planar projections: one subject in each projection, with class, formulas and
//! measurements.
//!
//! The measurements come from the matrix, not from the name. They are the lengths and directions of
//! the axes in a parallel projection (C76, C77) and the vanishing points of a perspective
//! projection (C80, C81).
//!
//! ```text
//!  planar ─┬─ parallel ─┬─ orthographic: multiview, isometric, dimetric, trimetric
//!          │            └─ oblique: cavalier, cabinet, military
//!          └─ perspective: one-, two-, three-point
//! ```

use super::DemonstrationError;
use super::number_format::format_short;
use camera::ViewProjection;
use drawing::Panels;
use explain::formula_ids;
use explain::formulas::find_formula;
use glam::DVec2;
use homog::{Clip, Projective, Vector, World};
use model::ModelInstance;
use projection::{
    Convention, Decomposed, ProjectionClass, Window, decompose, principal_vanishing_points,
};
use scene::{Origin, Scene};
use scene_file::file::{CameraFile, ProjectionFile, SceneFile};

/// The text at the top of the page.
const INTRODUCTION: [&str; 4] = [
    "Each panel shows the models in one projection, with its class, formula ids (look them up, as",
    "in `alberti reference OB-1`) and first formula. For parallel projections, it lists the drawn",
    "length and direction of one unit along each axis, with 0° to the right; for perspectives, the",
    "vertical field of view and the vanishing points in half heights from the center.",
];

/// The named world axes as unit vectors. Their images give foreshortening and vanishing points.
const AXES: [(&str, Vector<World>); 3] = [("x", Vector::X), ("y", Vector::Y), ("z", Vector::Z)];

/// A named projection.
#[derive(Clone, PartialEq, Debug)]
pub struct NamedProjection {
    /// The name in lowercase with hyphens. It is the panel's id and, with spaces instead of
    /// hyphens, its title.
    pub name: String,
    /// The projection as described in a scene file.
    pub projection: ProjectionFile,
}

/// Draws the models in each projection, from its default viewpoint; the scene's camera is ignored.
/// The number of threads does not change the panels.
///
/// The background is opaque white, like paper. Panels are in the order of `members`, and the title
/// names the models. The scene is resolved and drawn once for each projection.
///
/// # Errors
/// Returns an error if the scene cannot be resolved or is empty, or if the picture has no pixels.
pub fn projection_panels(
    origin: &Origin,
    file: &SceneFile,
    models: &[ModelInstance],
    members: &[NamedProjection],
    threads: usize,
) -> Result<Panels, DemonstrationError> {
    let mut title = String::new();
    let mut panels = Vec::with_capacity(members.len());
    for NamedProjection { name, projection } in members {
        let camera = CameraFile { projection: Some(projection.clone()), ..CameraFile::default() };
        let file = SceneFile { camera, ..file.clone() };
        let mut scene = Scene::from_models(origin, &file, models)?;
        scene.image.background = [1.0; 4];
        let panel = pipeline::render::render_panel(&scene, name, name.replace('-', " "), threads)?;
        let size = DVec2::new(scene.image.width.into(), scene.image.height.into());
        panels.push(panel.with_notes(projection_notes(projection, &scene.view_projection, size)));
        title = scene.model_names();
    }
    let introduction = INTRODUCTION.map(str::to_owned).to_vec();
    let title = format!("{title}: planar projections");
    Ok(Panels::new(title, panels).with_introduction(introduction))
}

/// Returns the notes of a panel: class, formulas and measurements.
///
/// A parallel projection gets the lengths and directions of the axes; a perspective projection gets
/// its field of view and vanishing points. A projection is parallel if w does not change along any
/// axis. This is known even for a matrix that cannot be decomposed.
fn projection_notes(
    projection: &ProjectionFile,
    view_projection: &ViewProjection,
    size: DVec2,
) -> Vec<String> {
    let world_to_clip = view_projection.world_to_clip();
    let decomposition =
        decompose(view_projection.view_to_clip, Convention::CHAPTER).map(|found| found.kind);
    let is_parallel =
        AXES.iter().all(|(_, axis)| world_to_clip.transform_direction(*axis).w() == 0.0);
    let volume = decomposition.ok().and_then(|kind| view_window(&kind));
    let class = classify_projection(projection, world_to_clip);
    let measurements = match volume {
        Some(ViewWindow::Parallel(window)) => {
            describe_axes(world_to_clip, size, Some(size.y / window.height()))
        }
        Some(ViewWindow::Perspective(slopes)) => {
            describe_opening_angle(slopes) + &describe_vanishing_points(world_to_clip, size)
        }
        None if is_parallel => describe_axes(world_to_clip, size, None),
        None => describe_vanishing_points(world_to_clip, size),
    };
    let formulas = formula_list(class, view_projection);
    let mut notes = vec![class_path(class), format!("formulas {formulas}"), measurements];
    notes.extend(formula_in_full(&formulas));
    notes
}

/// Returns the equations of the first formula that has any, in characters of the stroke font.
fn formula_in_full(ids: &str) -> Option<String> {
    let (id, equation) = ids.split(", ").find_map(|id| {
        let equation = find_formula(id)?.equations().collect::<Vec<_>>().join(", ");
        (!equation.is_empty()).then_some((id, equation))
    })?;
    let letters = [("φ", "phi"), ("α", "alpha"), ("β", "beta"), ("√", "sqrt")];
    let spelled = letters.iter().fold(equation, |text, (from, to)| text.replace(from, to));
    Some(format!("{id}: {spelled}"))
}

/// Returns the path of classes that ends at this class, such as `parallel, oblique, cavalier`.
///
/// The root, which all classes share, is omitted.
fn class_path(class: ProjectionClass) -> String {
    let mut names: Vec<&str> = class.ancestors().map(ProjectionClass::name).collect();
    names.pop();
    names.reverse();
    names.join(", ")
}

/// Returns the class of a projection, from its name or, for perspective projections, from the
/// number of vanishing points.
///
/// Parallel projections in a scene file already have the name of their class. The class of a
/// perspective projection depends on the camera: turning the camera changes a one-point perspective
/// into a two-point perspective with the same lens.
fn classify_projection(
    projection: &ProjectionFile,
    map: Projective<World, Clip>,
) -> ProjectionClass {
    use ProjectionFile as P;
    match projection {
        P::Multiview(_) => ProjectionClass::Multiview,
        P::Isometric => ProjectionClass::Isometric,
        P::Dimetric => ProjectionClass::Dimetric,
        P::Trimetric => ProjectionClass::Trimetric,
        P::Axonometric { .. } => ProjectionClass::Axonometric,
        P::Cavalier { .. } => ProjectionClass::Cavalier,
        P::Cabinet { .. } => ProjectionClass::Cabinet,
        P::Oblique { .. } => ProjectionClass::GeneralOblique,
        P::Military { .. } => ProjectionClass::Military,
        P::Orthographic { .. } => ProjectionClass::Orthographic,
        _ => match principal_vanishing_points(map).map(|points| points.count()) {
            Ok(1) => ProjectionClass::OnePoint,
            Ok(2) => ProjectionClass::TwoPoint,
            Ok(3) => ProjectionClass::ThreePoint,
            _ => ProjectionClass::Perspective,
        },
    }
}

/// Returns the formula ids of the projection's class and then of its matrix, without duplicates.
///
/// A linear search is enough to remove duplicates, because there are only a few ids.
fn formula_list(class: ProjectionClass, view_projection: &ViewProjection) -> String {
    let named = match class {
        ProjectionClass::Multiview => "MV-1",
        _ if class.ancestors().any(|above| above == ProjectionClass::Axonometric) => "AX-1",
        _ if class.ancestors().any(|above| above == ProjectionClass::Oblique) => "OB-1, VV-1",
        _ if class.ancestors().any(|above| above == ProjectionClass::Perspective) => "VN-1",
        _ => "",
    };
    let of_matrix = formula_ids(view_projection.view_to_clip).unwrap_or_default();
    let mut all: Vec<&str> = Vec::new();
    let each = named.split(", ").chain(of_matrix.split(", "));
    each.filter(|id| !id.is_empty()).for_each(|id| {
        if !all.contains(&id) {
            all.push(id);
        }
    });
    all.join(", ")
}

/// The window of a projection, in units that depend on the kind of projection.
enum ViewWindow {
    /// In units of the picture plane.
    Parallel(Window),
    /// On the plane one unit in front of the eye.
    Perspective(Window),
}

/// Returns the window of a decomposed projection, or `None` if its matrix does not determine a
/// window.
///
/// A frustum is measured by slopes (x and y per unit of distance), which do not depend on the
/// position of its near plane.
fn view_window(kind: &Decomposed) -> Option<ViewWindow> {
    Some(match kind {
        Decomposed::Frustum(frustum) => ViewWindow::Perspective(frustum.slopes()),
        Decomposed::Orthographic(volume)
        | Decomposed::Classical { volume, .. }
        | Decomposed::PlacedOrthographic { volume, .. } => ViewWindow::Parallel(volume.window()),
        _ => return None,
    })
}

/// Returns the drawn length of each axis unit and its direction, counterclockwise from the right.
///
/// `pixels` is the length of a unit of the picture plane. If the matrix does not determine that
/// length, the longest axis is assumed to be at full scale, as in the plan of a military
/// projection.
///
/// The image of an axis d is the vector M (d, 0), scaled from NDC to pixels. Its length divided by
/// the length of a unit is the foreshortening ratio: √(2/3) = 0.816 for isometric, 1 and ½ for the
/// receding axes of cavalier and cabinet. An axis shorter than 1e-9 counts as seen end-on.
fn describe_axes(map: Projective<World, Clip>, size: DVec2, pixels: Option<f64>) -> String {
    let images = AXES.map(|(name, axis)| {
        let image = map.transform_direction(axis);
        (name, DVec2::new(image.x(), image.y()) * size * 0.5)
    });
    let length = |image: DVec2| libm::sqrt(image.length_squared());
    let longest = images.iter().map(|(_, image)| length(*image)).fold(0.0, f64::max);
    let unit = pixels.unwrap_or(longest);
    let drawn = images.map(|(name, image)| {
        let length_in_units = length(image) / unit;
        if length_in_units < 1e-9 {
            return format!("{name} as a point");
        }
        let degrees = libm::atan2(image.y, image.x).to_degrees();
        let degrees = libm::round(degrees * 10.0) / 10.0;
        format!(
            "{name} {} at {}°",
            format_short(length_in_units, 3),
            format_short(degrees.rem_euclid(360.0), 4)
        )
    });
    drawn.join(" · ")
}

/// Returns the vertical field of view of a perspective projection.
///
/// The result is atan(top) − atan(bottom), which is also correct for windows off the line of sight.
fn describe_opening_angle(slopes: Window) -> String {
    let degrees = (libm::atan(slopes.top()) - libm::atan(slopes.bottom())).to_degrees();
    format!("{}° high · ", format_short(degrees, 3))
}

/// Returns the vanishing points of the axes, in half heights of the picture from its center.
///
/// Axes parallel to the picture plane have their vanishing point at infinity and are omitted. Both
/// coordinates have the same unit, because x is multiplied by the aspect ratio.
fn describe_vanishing_points(map: Projective<World, Clip>, size: DVec2) -> String {
    let Ok(points) = principal_vanishing_points(map) else { return String::new() };
    let aspect = size.x / size.y;
    let all = AXES.iter().zip(points.axes).filter_map(|((name, _), point)| {
        let point = point.point()?;
        let rounded = |c: f64| format_short(libm::round(c * 100.0) / 100.0, 4);
        Some(format!("{name} to ({}, {})", rounded(point.x() * aspect), rounded(point.y())))
    });
    all.collect::<Vec<String>>().join(" · ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::demonstration::test_scene::house_scene;

    fn notes_for(projection: ProjectionFile) -> Vec<String> {
        let (origin, file, scene) = house_scene();
        let members = [NamedProjection { name: "one".to_owned(), projection }];
        let panels = projection_panels(&origin, &file, &scene.models, &members, 1).expect("panels");
        panels.panels[0].notes.clone()
    }

    /// Factors are √(2/3) in isometric, and √(8)/3 and √(2)/3 in the dimetric projection with 42°
    /// and 7°. Depth has full length in cavalier and half length in cabinet projections; military
    /// projections keep the plan undistorted.
    #[test]
    fn parallel_projections_foreshorten_axes_as_in_the_textbooks() {
        let cases = [
            (
                ProjectionFile::Isometric,
                "AX-1",
                "x 0.816 at 330° · y 0.816 at 90° · z 0.816 at 210°",
            ),
            (
                ProjectionFile::Dimetric,
                "AX-1",
                "x 0.943 at 352.8° · y 0.943 at 90° · z 0.471 at 221.4°",
            ),
            (ProjectionFile::cavalier(), "OB-1", "x 1 at 0° · y 1 at 90° · z 1 at 225°"),
            (ProjectionFile::cabinet(), "OB-1", "x 1 at 0° · y 1 at 90° · z 0.5 at 225°"),
            (ProjectionFile::military(), "OB-1", "x 1 at 45° · y 1 at 90° · z 1 at 315°"),
            (
                ProjectionFile::Multiview(projection::PrincipalView::Front),
                "MV-1",
                "x 1 at 0° · y 1 at 90° · z as a point",
            ),
        ];
        for (projection, formula, axes) in cases {
            let notes = notes_for(projection.clone());
            assert!(notes[1].contains(formula), "{projection:?}: {notes:?}");
            let is_equation = notes[3].starts_with(&format!("{formula}: "));
            assert!(is_equation && notes[3].contains(['=', '→']), "{projection:?}: {notes:?}");
            assert_eq!(notes[2], axes, "{projection:?}");
        }
    }

    #[test]
    fn perspectives_are_named_after_their_vanishing_points() {
        let cases = [
            (ProjectionFile::one_point(), "perspective, one-point", "z to (0.35, 0.45)"),
            (
                ProjectionFile::two_point(),
                "perspective, two-point",
                "x to (-3.2, 0.4) · z to (2.4, 0.4)",
            ),
            (
                ProjectionFile::three_point(),
                "perspective, three-point",
                "x to (-3.2, 1.2) · y to (0.1, -5) · z to (2.4, 1.2)",
            ),
            (ProjectionFile::PERSPECTIVE, "perspective, three-point", "35° high"),
        ];
        for (projection, class, numbers) in cases {
            let notes = notes_for(projection);
            assert_eq!(notes[0], class);
            assert!(
                notes[1].contains("VN-1, PE-1, PE-3") && notes[2].contains(numbers),
                "{notes:?}"
            );
        }
    }
}
