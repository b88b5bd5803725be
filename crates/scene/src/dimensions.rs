//! Resolves the dimensions of a sheet to the world-space points that they measure.
//!
//! ```text
//!   Length(from: Edge(near: …), to: Node(name: "lid"))
//!            │                    │
//!            ▼ picker             ▼ node tree, bounds
//!          edge (a line)        point          ─► the two points whose distance is measured
//! ```

mod angle;
mod picking;

use super::Origin;
use angle::angle_points;
use camera::NamedView;
use core::f64::consts::TAU;
use hidden_line::WorldCircle;
use homog::{Point, World};
use model::ModelInstance;
use picking::{Picked, Picking};
use scene_file::PathStep::{self, Field, Index};
use scene_file::SceneError;
use scene_file::file::{DimensionFile, DimensionView, PickFile, PlaceFile, SheetFile};
use sheet::{Dimension, DimensionSide, LengthDirection, Measure};

/// The maximum number of decimal places.
const MAX_DECIMALS: u32 = 6;

/// The maximum number of dimensions on a sheet, which never has room for more.
const MAX_DIMENSIONS: usize = 500;

/// The maximum number of largest circles that one entry may dimension.
const MAX_DIAMETERS: u32 = 50;

/// The angle in radians by which an arc with a diameter may be shorter than half a turn.
const HALF_TURN_SLACK: f64 = 0.01;

/// Returns the path of a dimension in the scene file.
fn path_of<'a>(index: usize, steps: &[PathStep<'a>]) -> Vec<PathStep<'a>> {
    let start = [Field("sheet"), Field("dimensions"), Index(index)];
    start.into_iter().chain(steps.iter().copied()).collect()
}

/// Returns whether a sheet has overall dimensions, and resolves its other dimensions.
///
/// Without models, only the description itself is checked.
///
/// # Errors
/// Returns an error if a name does not exist, nothing can be picked, or the picked parts have no
/// distance or angle between them.
pub(super) fn resolve_dimensions(
    origin: &Origin,
    file: &SheetFile,
    models: &[ModelInstance],
) -> Result<(bool, Vec<Dimension>), SceneError> {
    let list = &file.dimensions.0;
    if list.len() > MAX_DIMENSIONS {
        let message =
            format!("too many dimensions: {}; at most {MAX_DIMENSIONS} are allowed", list.len());
        return Err(origin.error_at(&[Field("sheet"), Field("dimensions")], message, None));
    }
    let picking = Picking::new(origin, models);
    let (mut has_overall, mut dimensions) = (false, Vec::new());
    for (index, entry) in list.iter().enumerate() {
        let resolver = DimensionResolver { picking: &picking, index };
        resolver.check(entry)?;
        has_overall |= *entry == DimensionFile::Overall;
        if !models.is_empty() {
            dimensions.extend(resolver.resolve(entry)?);
        }
    }
    Ok((has_overall, dimensions))
}

/// Resolves one dimension.
struct DimensionResolver<'a> {
    picking: &'a Picking<'a>,
    /// The dimension's index in the list.
    index: usize,
}

/// A pick and its path in a dimension.
type PointPath<'a> = (&'a PickFile, Vec<PathStep<'static>>);

impl DimensionResolver<'_> {
    /// Creates an error that points at a part of the dimension.
    fn error(
        &self,
        steps: &[PathStep<'_>],
        message: impl Into<String>,
        help: Option<&str>,
    ) -> SceneError {
        let path = path_of(self.index, steps);
        self.picking.origin.error_at(&path, message, help.map(ToOwned::to_owned))
    }

    /// Performs the checks that do not depend on models: decimals, counts and sides.
    fn check(&self, entry: &DimensionFile) -> Result<(), SceneError> {
        let decimals = match entry {
            DimensionFile::Overall => None,
            DimensionFile::Length { decimals, .. }
            | DimensionFile::Chain { decimals, .. }
            | DimensionFile::Baseline { decimals, .. }
            | DimensionFile::Diameter { decimals, .. }
            | DimensionFile::Radius { decimals, .. }
            | DimensionFile::LargestDiameters { decimals, .. }
            | DimensionFile::Angle { decimals, .. } => *decimals,
        };
        if let Some(decimals) = decimals.filter(|decimals| *decimals > MAX_DECIMALS) {
            let message = format!("too many decimal places: {decimals}");
            return Err(self.error(&[Field("decimals")], message, Some("use 0 to 6")));
        }
        match entry {
            DimensionFile::Chain { points, .. } if points.len() < 2 => {
                let message = "a chain needs at least two points";
                Err(self.error(&[Field("points")], message, None))
            }
            DimensionFile::Baseline { to, .. } if to.is_empty() => {
                Err(self.error(&[Field("to")], "`to` needs at least one point", None))
            }
            DimensionFile::LargestDiameters { count, .. }
                if !(1..=MAX_DIAMETERS).contains(count) =>
            {
                let message = format!("invalid count: {count}");
                Err(self.error(&[Field("count")], message, Some("use 1 to 50")))
            }
            DimensionFile::Length { direction, side: Some(side), .. }
            | DimensionFile::Chain { direction, side: Some(side), .. }
            | DimensionFile::Baseline { direction, side: Some(side), .. } => {
                self.check_side(*direction, *side)
            }
            _ => Ok(()),
        }
    }

    /// Checks that a dimension line in this direction can be on the given side.
    fn check_side(
        &self,
        direction: LengthDirection,
        side: DimensionSide,
    ) -> Result<(), SceneError> {
        let is_level = matches!(side, DimensionSide::Above | DimensionSide::Below);
        let (message, help) = match (direction, is_level) {
            (LengthDirection::Horizontal, false) => {
                ("a horizontal length cannot be placed beside the part", "write Above or Below")
            }
            (LengthDirection::Vertical, true) => (
                "a vertical length cannot be placed above or below the part",
                "write Left or Right",
            ),
            _ => return Ok(()),
        };
        Err(self.error(&[Field("side")], message, Some(help)))
    }

    /// Returns the dimensions of an entry: usually one, none for `Overall`, several for the largest
    /// diameters.
    fn resolve(&self, entry: &DimensionFile) -> Result<Vec<Dimension>, SceneError> {
        let one = |kind, measure, view, side, decimals| {
            vec![self.dimension(kind, measure, view, side, decimals)]
        };
        Ok(match entry {
            DimensionFile::Overall => Vec::new(),
            DimensionFile::Length { from, to, direction, view, side, decimals } => {
                let measure = Measure::Chain(self.distance(from, to)?, *direction);
                one("Length", measure, *view, *side, *decimals)
            }
            DimensionFile::Chain { points, direction, view, side, decimals } => {
                let places = points.iter().enumerate();
                let paths = places.map(|(at, pick)| (pick, vec![Field("points"), Index(at)]));
                let measure = Measure::Chain(self.points(paths)?, *direction);
                one("Chain", measure, *view, *side, *decimals)
            }
            DimensionFile::Baseline { from, to, direction, view, side, decimals } => {
                let others = to.iter().enumerate();
                let others = others.map(|(at, pick)| (pick, vec![Field("to"), Index(at)]));
                let first = core::iter::once((from, vec![Field("from")]));
                let measure = Measure::Baseline(self.points(first.chain(others))?, *direction);
                one("Baseline", measure, *view, *side, *decimals)
            }
            DimensionFile::Diameter { circle, view, decimals } => {
                let circle = self.diameter_circle(circle)?;
                one("Diameter", Measure::Diameter(circle), *view, None, *decimals)
            }
            DimensionFile::Radius { circle, view, decimals } => {
                one("Radius", Measure::Radius(self.circle(circle)?), *view, None, *decimals)
            }
            DimensionFile::LargestDiameters { count, decimals } => {
                self.largest_diameters(*count as usize, *decimals)
            }
            DimensionFile::Angle { from, to, vertex, view, decimals } => {
                let measure = Measure::Angle(self.angle(from, to, vertex.as_ref())?);
                one("Angle", measure, *view, None, *decimals)
            }
        })
    }

    /// Builds a dimension with its name.
    fn dimension(
        &self,
        kind: &str,
        measure: Measure,
        view: Option<DimensionView>,
        side: Option<DimensionSide>,
        decimals: Option<u32>,
    ) -> Dimension {
        let name = format!("dimension {} ({kind})", self.index + 1);
        Dimension { measure, view: view.map(named_view), side, decimals, name }
    }

    /// Finds the part that a pick names; errors point at the pick in the scene file.
    fn pick(&self, pick: &PickFile, steps: &[PathStep<'static>]) -> Result<Picked, SceneError> {
        self.picking.pick(pick, &path_of(self.index, steps))
    }

    /// Resolves several picks as points.
    fn points<'p>(
        &self,
        paths: impl Iterator<Item = PointPath<'p>>,
    ) -> Result<Vec<Point<World>>, SceneError> {
        paths.map(|(pick, steps)| Ok(Point::from_raw(self.pick(pick, &steps)?.point()))).collect()
    }

    /// Finds the circle at a position.
    fn circle(&self, place: &PlaceFile) -> Result<WorldCircle, SceneError> {
        self.picking.circle(place, &path_of(self.index, &[Field("circle")]))
    }

    /// Finds the circle at a position, which must span at least half a turn: a shorter arc has no
    /// diameter to measure.
    fn diameter_circle(&self, place: &PlaceFile) -> Result<WorldCircle, SceneError> {
        let circle = self.circle(place)?;
        if circle.sweep < core::f64::consts::PI - HALF_TURN_SLACK {
            let degrees = libm::round(circle.sweep.to_degrees());
            let message = format!("this is an arc of {degrees}°, which has no diameter");
            let help = "dimension its radius: Radius(circle: …)";
            return Err(self.error(&[Field("circle")], message, Some(help)));
        }
        Ok(circle)
    }

    /// Returns the two points that determine the distance between two picks.
    fn distance(&self, from: &PickFile, to: &PickFile) -> Result<Vec<Point<World>>, SceneError> {
        let picked = [self.pick(from, &[Field("from")])?, self.pick(to, &[Field("to")])?];
        let feet = picked[0].perpendicular_to(&picked[1]).ok_or_else(|| {
            let message = format!("{} and {} are not parallel", picked[0].noun(), picked[1].noun());
            let help = "measure from a point on one, such as Vertex(near: …), to the other";
            self.error(&[Field("to")], message, Some(help))
        })?;
        Ok(feet.map(Point::from_raw).to_vec())
    }

    /// Returns the vertex of an angle and a point on each of its sides.
    fn angle(
        &self,
        from: &PickFile,
        to: &PickFile,
        vertex: Option<&PickFile>,
    ) -> Result<[Point<World>; 3], SceneError> {
        let picked = [self.pick(from, &[Field("from")])?, self.pick(to, &[Field("to")])?];
        let vertex = vertex.map(|vertex| self.pick(vertex, &[Field("vertex")])).transpose()?;
        let points = match vertex {
            Some(vertex) => Ok([vertex.point(), picked[0].point(), picked[1].point()]),
            None => angle_points(&picked[0], &picked[1]),
        };
        let points = points.map_err(|(message, help)| self.error(&[], message, Some(help)))?;
        Ok(points.map(Point::from_raw))
    }

    /// Returns the diameters of the largest full circles, one for each radius.
    fn largest_diameters(&self, count: usize, decimals: Option<u32>) -> Vec<Dimension> {
        let mut circles: Vec<WorldCircle> = self.picking.picker.circles(None).collect();
        circles.retain(|circle| TAU - circle.sweep < 1e-6);
        circles.sort_by(|a, b| b.radius.total_cmp(&a.radius));
        circles.dedup_by(|a, b| (a.radius - b.radius).abs() <= 1e-5 * b.radius);
        circles.truncate(count);
        let dimension = |circle: WorldCircle| {
            self.dimension("LargestDiameters", Measure::Diameter(circle), None, None, decimals)
        };
        circles.into_iter().map(dimension).collect()
    }
}

/// Returns the named view for a dimension view.
const fn named_view(view: DimensionView) -> NamedView {
    match view {
        DimensionView::Front => NamedView::Front,
        DimensionView::Back => NamedView::Back,
        DimensionView::Left => NamedView::Left,
        DimensionView::Right => NamedView::Right,
        DimensionView::Top => NamedView::Top,
        DimensionView::Bottom => NamedView::Bottom,
    }
}
