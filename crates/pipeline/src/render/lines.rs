//! Line drawings of a scene: from the models to the page that every output writes.

use super::RenderError;
use super::stage::Stage;
use super::wireframe::edges;
use crate::color::SrgbEncoder;
use crate::drawing::{EdgeClass, Ink, Line, LineDrawing, LineLook, Page};
use crate::model::{Posed, Topology};
use crate::scene::{Scene, Style};
use crate::{Picture, Timings};
use glam::DVec2;
use homog::{Clip, HPoint};

/// The line drawing of a scene on a page of the picture's size, 96 pixels to the inch. Styles that show surfaces have their
/// hidden lines removed.
///
/// The number of threads does not change it.
///
/// # Errors
/// As [`render`](crate::render()).
pub fn draw(scene: &Scene, threads: usize, timings: &Timings) -> Result<Page, RenderError> {
    let look = scene.style.line_look();
    let drawing = timings.measure("lines", || line_drawing(scene, &look, threads))?;
    let page = || drawing.to_page(&look, &title(scene), paper(scene.image.background));
    Ok(timings.measure("chains", page))
}

/// The lines of a scene, with what is visible told from what is hidden.
///
/// # Errors
/// As [`render`](crate::render()).
pub fn line_drawing(
    scene: &Scene,
    look: &LineLook,
    threads: usize,
) -> Result<LineDrawing, RenderError> {
    let _ = (look, threads);
    wireframe(scene)
}

/// The line drawing as a picture.
pub(super) fn picture(
    scene: &Scene,
    threads: usize,
    timings: &Timings,
) -> Result<Picture, RenderError> {
    let page = draw(scene, threads, timings)?;
    let (width, height) = (scene.image.width, scene.image.height);
    let too_large = raster::RasterError::Size { x: 0, y: 0, width, height };
    timings.measure("pixels", || page.to_picture(width, height)).ok_or(too_large.into())
}

impl Style {
    /// How its lines look.
    #[must_use]
    pub const fn line_look(self) -> LineLook {
        match self {
            Self::Shaded | Self::Flat => LineLook::REMOVED,
            Self::Wireframe => LineLook::WIREFRAME,
            Self::Lines(look) => look,
        }
    }
}

/// The names of the models, each once.
fn title(scene: &Scene) -> String {
    let mut names: Vec<&str> = Vec::new();
    for placed in &scene.models {
        if !names.contains(&placed.model.name.as_str()) {
            names.push(&placed.model.name);
        }
    }
    names.join(", ")
}

/// The background as a colour of paper; `None` if it is transparent.
fn paper(background: [f32; 4]) -> Option<Ink> {
    let [r, g, b, alpha] = SrgbEncoder::shared().pixel(background);
    (alpha == 255).then_some([r, g, b])
}

/// The sides of all triangles and the lines of all models, hidden or not.
fn wireframe(scene: &Scene) -> Result<LineDrawing, RenderError> {
    let stage = Stage::of(scene)?;
    let size = DVec2::new(scene.image.width.into(), scene.image.height.into());
    let mut drawing = LineDrawing { size, ..LineDrawing::default() };
    let mut edge = 0;
    for placed in &scene.models {
        for (instance, primitive) in placed.model.shown_primitives() {
            let object = drawing.objects.len() as u32;
            let node = &placed.model.nodes[instance.node];
            let name = node.name.clone().unwrap_or_else(|| placed.model.name.clone());
            drawing.objects.push(name);
            let Posed { positions, to_model, .. } = placed.model.posed(instance, primitive);
            let points = stage.to_clip(&positions, to_model.then(placed.model_to_world));
            let is_line = primitive.topology == Topology::Lines;
            let class = if is_line { EdgeClass::Line } else { EdgeClass::Facet };
            for [a, b] in edges(primitive, &positions) {
                edge += 1;
                let ends = [points[a as usize], points[b as usize]];
                let Some((ends, depths)) = on_screen(&stage, ends) else { continue };
                drawing.lines.push(Line { ends, depths, class, visible: true, object, edge });
            }
        }
    }
    Ok(drawing)
}

fn on_screen(stage: &Stage, ends: [HPoint<Clip>; 2]) -> Option<([DVec2; 2], [f64; 2])> {
    let seen = stage.visible_segment(ends)?;
    let (a, b) = (stage.to_screen(seen.start)?, stage.to_screen(seen.end)?);
    Some(([a.raw().truncate(), b.raw().truncate()], [a.z(), b.z()]))
}
