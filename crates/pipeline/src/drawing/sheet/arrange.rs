//! Where views stand on a sheet, and at which scale they fit.
//!
//! Views stand in columns and rows; the front view and those beside it share their row, the front view and those above or below it
//! their column. The room that is left is shared out between them. The title block may stand under a view where there is room for
//! both; otherwise the views stay above it.

use super::view::View;
use super::{Sheet, SheetError, rectangle};
use camera::NamedView;
use glam::DVec2;
use projection::{PrincipalView, SheetAngle};
use viewport::{DrawingScale, Rectangle};

/// The least distance between two views, and to the frame, in millimetres.
const GAP: f64 = 10.0;

/// The room for a dimension line and its text beside a view, in heights of letters.
const DIMENSION_ROOM: f64 = 4.0;

/// The views in their places.
#[derive(Debug)]
pub(super) struct Arrangement<'a> {
    pub(super) scale: DrawingScale,
    /// The front view, the view from above, the one from the side, and the axonometric one if there is one, each with its centre on
    /// the sheet.
    placed: Vec<(&'a View, DVec2)>,
    /// Whether the view from above stands under the front view.
    pub(super) top_is_below: bool,
}

/// Columns and rows of the views: sizes in millimetres of the thing.
struct Table<'a> {
    views: Vec<(&'a View, [usize; 2])>,
    columns: [f64; 2],
    rows: [f64; 2],
    /// Room that does not grow with the scale: for dimensions left of the columns and above or below the rows.
    left: f64,
    above: f64,
    below: f64,
}

impl<'a> Arrangement<'a> {
    pub(super) fn of(
        sheet: &Sheet,
        principal: &[&'a View; 3],
        axonometric: Option<&'a View>,
    ) -> Result<Self, SheetError> {
        let table = Table::of(sheet, principal, axonometric);
        let area = sheet.drawing_area();
        let block = sheet.title_block_area();
        let above_block =
            rectangle(area.x(), area.y(), area.width(), area.height() - block.height());
        let candidates = [area, above_block].into_iter().filter_map(|area| {
            let scale = match sheet.scale {
                Some(scale) => table.fits(scale, area).then_some(scale)?,
                None => table.largest_scale(area)?,
            };
            // The scale bar stands at the left of the title block.
            let foot = rectangle(
                sheet.drawing_area().x(),
                block.y(),
                sheet.drawing_area().width(),
                block.height(),
            );
            let placed = table.place(scale, area);
            let free = placed.iter().all(|(view, centre)| apart(view, *centre, scale, foot));
            free.then_some((scale, placed))
        });
        // At equal scales the first has more room.
        let best = candidates.reduce(|a, b| if b.0.ratio() > a.0.ratio() { b } else { a });
        let (scale, placed) = best.ok_or_else(|| table.too_large(sheet, above_block))?;
        Ok(Self { scale, placed, top_is_below: sheet.angle == SheetAngle::First })
    }

    /// The views with their centres.
    pub(super) fn views(&self) -> impl Iterator<Item = (&'a View, DVec2)> {
        self.placed.iter().copied()
    }

    /// Where the object of a view is on the sheet.
    pub(super) fn area_of(&self, name: NamedView) -> Option<Rectangle> {
        let (view, centre) = self.views().find(|(view, _)| view.name == name)?;
        let size = view.size * self.scale.ratio();
        let corner = centre - size * 0.5;
        Some(rectangle(corner.x, corner.y, size.x, size.y))
    }
}

/// Whether a view keeps off a rectangle.
fn apart(view: &View, centre: DVec2, scale: DrawingScale, other: Rectangle) -> bool {
    let half = view.size * scale.ratio() * 0.5 + DVec2::splat(GAP * 0.5);
    let distance = (centre - DVec2::from(other.centre())).abs();
    distance.x >= half.x + other.width() * 0.5 || distance.y >= half.y + other.height() * 0.5
}

impl<'a> Table<'a> {
    fn of(sheet: &Sheet, principal: &[&'a View; 3], axonometric: Option<&'a View>) -> Self {
        let column_of = |name: NamedView| {
            let (x, y) = principal_view(name).place(sheet.angle);
            [x, -y]
        };
        let mut places: Vec<(&View, [i32; 2])> =
            principal.iter().map(|view| (*view, column_of(view.name))).collect();
        // The axonometric view stands in the corner that the others leave free.
        let corner = [places[2].1[0], places[1].1[1]];
        places.extend(axonometric.map(|view| (view, corner)));
        let least = |axis: usize| places.iter().map(|(_, place)| place[axis]).min().unwrap_or(0);
        let (left, top) = (least(0), least(1));
        let views: Vec<_> = places
            .iter()
            .map(|(view, [x, y])| (*view, [usize::from(*x > left), usize::from(*y > top)]))
            .collect();
        let most = |axis: usize, number: usize| {
            let sizes = views.iter().filter(|(_, place)| place[axis] == number);
            sizes.map(|(view, _)| view.size[axis]).fold(0.0, f64::max)
        };
        let room = if sheet.dimensions { DIMENSION_ROOM * sheet.lettering() } else { 0.0 };
        let first = sheet.angle == SheetAngle::First;
        Self {
            columns: [most(0, 0), most(0, 1)],
            rows: [most(1, 0), most(1, 1)],
            views,
            left: room,
            above: if first { room } else { 0.0 },
            below: if first { 0.0 } else { room },
        }
    }

    /// What is left of an area for the views themselves.
    fn room(&self, area: Rectangle) -> [f64; 2] {
        let width = area.width() - self.left - 3.0 * GAP;
        [width, area.height() - self.above - self.below - 3.0 * GAP]
    }

    fn size(&self) -> [f64; 2] {
        [self.columns[0] + self.columns[1], self.rows[0] + self.rows[1]]
    }

    fn fits(&self, scale: DrawingScale, area: Rectangle) -> bool {
        let [width, height] = self.room(area);
        let [x, y] = self.size().map(|size| scale.to_paper(size));
        x <= width && y <= height
    }

    fn largest_scale(&self, area: Rectangle) -> Option<DrawingScale> {
        DrawingScale::largest_standard(self.size(), self.room(area))
    }

    /// The views with their centres on the sheet.
    fn place(&self, scale: DrawingScale, area: Rectangle) -> Vec<(&'a View, DVec2)> {
        let [width, height] = self.room(area);
        let [x, y] = self.size().map(|size| scale.to_paper(size));
        let gaps = DVec2::new((width - x) / 3.0 + GAP, (height - y) / 3.0 + GAP);
        let middles = |sizes: [f64; 2], start: f64, gap: f64| {
            let [first, second] = sizes.map(|size| scale.to_paper(size));
            [start + gap + first * 0.5, start + 2.0 * gap + first + second * 0.5]
        };
        let columns = middles(self.columns, area.x() + self.left, gaps.x);
        let rows = middles(self.rows, area.y() + self.above, gaps.y);
        let centre = |[column, row]: [usize; 2]| DVec2::new(columns[column], rows[row]);
        self.views.iter().map(|(view, place)| (*view, centre(*place))).collect()
    }

    fn too_large(&self, sheet: &Sheet, area: Rectangle) -> SheetError {
        let smallest = DrawingScale::STANDARD[DrawingScale::STANDARD.len() - 1];
        let scale = sheet.scale.unwrap_or(smallest);
        let remedy = match self.largest_scale(area) {
            Some(fitting) => format!("; {fitting} fits"),
            None => "; take larger paper, or say what a unit of the model is".to_owned(),
        };
        let need = self.size().map(|size| scale.to_paper(size));
        SheetError::TooLarge {
            paper: sheet.paper_name.clone(),
            scale,
            need,
            room: self.room(area),
            remedy,
        }
    }
}

/// The principal view of that name; the front view for all others.
fn principal_view(name: NamedView) -> PrincipalView {
    match name {
        NamedView::Back => PrincipalView::Back,
        NamedView::Left => PrincipalView::Left,
        NamedView::Right => PrincipalView::Right,
        NamedView::Top => PrincipalView::Top,
        NamedView::Bottom => PrincipalView::Bottom,
        _ => PrincipalView::Front,
    }
}
