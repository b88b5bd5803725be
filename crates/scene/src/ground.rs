//! The shadow catcher below the models: the smallest rectangle that their shadows need.

use glam::DVec3;
use homog::{Bounds, Point, World};
use model::ModelInstance;
use model::world_points;
use scene_file::file::{GroundFile, SceneFile, ShadowsFile};
use shade::Light;

/// A horizontal rectangle that shows only shadows (shadow catcher).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Ground {
    /// The corners in world space, counterclockwise as seen from above.
    pub corners: [[f32; 3]; 4],
    /// The area in which models occlude light from all directions; `None` without such light.
    pub occlusion: Option<OcclusionArea>,
}

/// The rectangle around the models within which they keep ambient light from the ground.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct OcclusionArea {
    /// The smallest coordinates in the world: x and z of the rectangle, and the height of the
    /// ground.
    pub low: Point<World>,
    /// The largest coordinates: x and z of the rectangle, and the height of the models.
    pub high: Point<World>,
    /// The width of the margin around the models.
    pub margin: f64,
}

impl OcclusionArea {
    /// Returns the border of the part that a framed picture shows. Its corners are beveled because
    /// the shadow of a box is rounded there.
    fn framed_points(&self) -> [Point<World>; 8] {
        let (low, high, height) = (self.low.raw(), self.high.raw(), self.low.y());
        let [shown, hidden] = [self.margin, (1.0 - FRAMED_MARGIN) * self.margin];
        let x = [low.x + hidden, low.x + shown, high.x - shown, high.x - hidden];
        let z = [low.z + hidden, low.z + shown, high.z - shown, high.z - hidden];
        let places = [(0, 1), (0, 2), (1, 0), (2, 0), (1, 3), (2, 3), (3, 1), (3, 2)];
        places.map(|(column, row)| Point::new(x[column], height, z[row]))
    }
}

/// The width of the margin, as a fraction of the models' height or of half the diagonal of their
/// outline from above, whichever is smaller. Objects that are only tall or only wide hide little of
/// the sky.
const OCCLUSION_MARGIN: f64 = 0.4;
/// The fraction of the margin that a framed picture shows; beyond it, occlusion is faint.
const FRAMED_MARGIN: f64 = 0.5;

/// The maximum length of a shadow, as a multiple of the diagonal of the models' bounding box. A sun
/// at the horizon casts infinite shadows; beyond this length they extend out of any picture that
/// shows the models.
const MAX_SHADOW_DIAGONALS: f64 = 20.0;

/// Resolves the ground of a scene; returns `None` if the file requests none or there are no models.
///
/// The rectangle is the bounding box of the models seen from above, extended by the shadows of its
/// eight corners under each light, and by 5% on each side. The shadow of a convex box is within the
/// hull of its corners' shadows, so no vertex of the models needs to be projected. The default
/// height is the lowest point of the models.
pub(super) fn resolve_ground(
    file: &SceneFile,
    models: &[ModelInstance],
    lights: &[Light],
    has_environment: bool,
) -> Option<Ground> {
    let Some(GroundFile::Shadow { height, .. }) = file.ground else { return None };
    let bounds = Bounds::from_points(world_points(models))?;
    let (least, greatest) = (bounds.corners()[0].raw(), bounds.corners()[7].raw());
    let height = height.map_or(least.y, scene_file::file::Finite::value);
    // A light near the horizon casts an endless shadow, so its length is limited.
    let reach = MAX_SHADOW_DIAGONALS * bounds.diagonal();
    let (mut low, mut high) = (least.min(greatest), least.max(greatest));
    for (light, corner) in lights.iter().flat_map(|light| bounds.corners().map(|c| (light, c))) {
        if let Some(place) = project_shadow(light, corner.raw(), height, reach) {
            (low, high) = (low.min(place), high.max(place));
        }
    }
    let occlusion = occlusion_area(file, least.min(greatest), least.max(greatest), height);
    // Contact shadows darken ambient light; without any, there is nothing to darken.
    let has_ambient = lights.iter().any(|light| matches!(light, Light::Ambient { .. }));
    let occlusion = occlusion.filter(|_| has_ambient || has_environment);
    if let Some(OcclusionArea { low: least, high: greatest, .. }) = occlusion {
        (low, high) = (low.min(least.raw()), high.max(greatest.raw()));
    }
    // Soft shadows extend beyond the hard shadows of the corners.
    let room = 0.05 * (high - low).max_element();
    let (x0, x1) = ((low.x - room) as f32, (high.x + room) as f32);
    let (z0, z1) = ((low.z - room) as f32, (high.z + room) as f32);
    let y = height as f32;
    let corners = [[x0, y, z0], [x0, y, z1], [x1, y, z1], [x1, y, z0]];
    Some(Ground { corners, occlusion })
}

/// Returns the part of the ground that models within a bounding box occlude, or `None` if they are
/// not above the ground or the scene turns shadows off.
fn occlusion_area(
    file: &SceneFile,
    least: DVec3,
    greatest: DVec3,
    height: f64,
) -> Option<OcclusionArea> {
    let top = greatest.y - height;
    if file.shadows == Some(ShadowsFile::Off) || top <= 0.0 {
        return None;
    }
    let outline = DVec3 { y: 0.0, ..greatest - least };
    let margin = OCCLUSION_MARGIN * top.min(0.5 * outline.length());
    let beside = DVec3::new(margin, 0.0, margin);
    let low = Point::from_raw(DVec3 { y: height, ..least } - beside);
    let high = Point::from_raw(greatest + beside);
    (margin > 0.0).then_some(OcclusionArea { low, high, margin })
}

/// Returns the shadows of the models' points on the ground, in world space, for a camera that also
/// frames the shadows.
///
/// These are the shadows of directional light from above, and the darkest part of the occlusion by
/// the models. A shadow is at most as long as the diagonal of the models' bounding box. The picture
/// shows only part of longer shadows, such as a cube's under a sun below 30°. Lamps near the models
/// have no such limit and are ignored.
pub(super) fn shadow_points(
    ground: Ground,
    models: &[ModelInstance],
    lights: &[Light],
) -> Vec<Point<World>> {
    let points = world_points(models);
    let reach = Bounds::from_points(points.iter().copied()).map_or(0.0, Bounds::diagonal);
    let height = f64::from(ground.corners[0][1]);
    let is_from_above =
        |light: &&Light| matches!(light, Light::Sun { to_light: [_, y, _], .. } if *y > 0.0);
    let shadows = lights.iter().filter(is_from_above).flat_map(|light| {
        let above = points.iter().map(|point| point.raw()).filter(|point| point.y > height);
        above.filter_map(|point| project_shadow(light, point, height, reach))
    });
    let occlusion = ground.occlusion.iter().flat_map(OcclusionArea::framed_points);
    shadows.map(Point::from_raw).chain(occlusion).collect()
}

/// Returns the shadow of a world point on the plane y = `height`, at most `reach` away
/// horizontally.
///
/// p' = p + d_xz (p_y − height) / (−d_y), where d is the direction in which light travels. The
/// result is `None` for lights without shadows and for ambient lights. Upward or horizontal light
/// has d_y ≥ 0; the divisor is then bounded, and `reach` limits the length.
fn project_shadow(light: &Light, place: DVec3, height: f64, reach: f64) -> Option<DVec3> {
    light.shadow()?;
    let travel = match light {
        Light::Sun { to_light: towards, .. } => -DVec3::from(towards.map(f64::from)),
        Light::Point { position, .. }
        | Light::Spot { position, .. }
        | Light::Legacy { position, .. } => place - DVec3::from(position.map(f64::from)),
        Light::Ambient { .. } => return None,
    };
    let drop = (place.y - height).max(0.0);
    let flat = DVec3::new(travel.x, 0.0, travel.z);
    // Horizontal light casts infinite shadows.
    let down = (-travel.y).max(1e-9 * travel.length());
    let way = flat * (drop / down);
    let far = way.length();
    let way = if far > reach { way * (reach / far) } else { way };
    let place = Point::<World>::new(place.x + way.x, height, place.z + way.z).raw();
    place.is_finite().then_some(place)
}
