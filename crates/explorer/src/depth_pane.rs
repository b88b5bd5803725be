//! The `depth` pane: depth after the divide against distance, with the model's range marked.

use crate::ExplorerError;
use crate::demonstration::DepthTable;
use crate::facts::Facts;
use crate::number_text::decimals;
use crate::words::{Words, words};
use drawing::{Axis, AxisMark, Chart, Curve, Page, Spacing};
use explain::ApiConventions;
use glam::DVec2;
use page::Ink;
use projection::{Convention, DepthFormat};
use serde_json::{Value as Json, json};

const CURVE_INK: Ink = [26, 86, 176];
const MODEL_INK: Ink = [230, 159, 0];

/// The size of the page in millimeters.
const PAGE_SIZE: DVec2 = DVec2::new(150.0, 84.0);
/// The upper left corner of the chart in millimeters.
const CHART_CORNER: DVec2 = DVec2::new(16.0, 12.0);
const CHART_SIZE: DVec2 = DVec2::new(126.0, 56.0);

const SAMPLES: u32 = 400;

/// Draws the curve of depth against distance as SVG.
///
/// # Errors
/// Returns an error if the view volume lacks a near or a far plane.
pub(crate) fn depth_svg(
    facts: &Facts,
    conventions: ApiConventions,
) -> Result<String, ExplorerError> {
    let [Some(near), Some(far)] = facts.planes else {
        let help = "choose a lesson with near and far planes";
        return Err(ExplorerError::new("nothing_to_show", "there is no far plane", help));
    };
    let depth = |distance: f64| Some([distance, depth_in(facts, conventions, distance)?]);
    let samples = |from: f64, to: f64| -> Vec<[f64; 2]> {
        let at = |k: u32| from + (to - from) * (f64::from(k) / f64::from(SAMPLES));
        (0..=SAMPLES).filter_map(|k| depth(at(k))).collect()
    };
    let curve = |id: &str, title: &str, ink, points| {
        let (id, title) = (id.to_owned(), title.to_owned());
        Curve { id, title, ink, dashed: false, points }
    };
    let mut curves = vec![curve("depth", "depth", CURVE_INK, samples(near, far))];
    let mut marks = Vec::new();
    let [low, high] = facts.model_range.unwrap_or([far, near]).map(|d| d.clamp(near, far));
    if low < high {
        curves.push(curve("model", "the model", MODEL_INK, samples(low, high)));
        let mark = |value: f64, what: &str| AxisMark {
            value,
            text: format!("{what} {}", decimals(value, 2)),
        };
        marks = vec![mark(low, "model from"), mark(high, "to")];
    }
    let ends = [near, far].map(|distance| depth_in(facts, conventions, distance).unwrap_or(0.0));
    let chart = Chart {
        id: "depth".to_owned(),
        x: Axis {
            title: "distance along the line of sight".to_owned(),
            from: near,
            to: far,
            spacing: Spacing::Linear,
        },
        y: Axis {
            title: "depth after the divide".to_owned(),
            from: ends[0].min(ends[1]),
            to: ends[0].max(ends[1]),
            spacing: Spacing::Linear,
        },
        curves,
        marks,
    };
    let mut page = Page::new(PAGE_SIZE, "Depth after the perspective divide", Some([255; 3]));
    page.layers.extend(chart.to_layers(CHART_CORNER, CHART_SIZE));
    Ok(page.to_svg())
}

/// Returns the NDC depth at a distance in these conventions.
fn depth_in(facts: &Facts, conventions: ApiConventions, distance: f64) -> Option<f64> {
    let own = facts.depth_at(distance)?;
    Some(match conventions {
        ApiConventions::OpenGl => -own,
        ApiConventions::Vulkan | ApiConventions::Direct3d | ApiConventions::WebGpu => {
            0.5 - 0.5 * own
        }
        _ => own,
    })
}

/// Returns distances with their depths and the smallest step that a 24-bit buffer can resolve, or
/// `None` in a parallel projection.
pub(crate) fn depth_table_json(facts: &Facts, conventions: ApiConventions) -> Option<Json> {
    facts.apex?;
    let [near, far] = [facts.planes[0]?, facts.planes[1]?];
    let convention = match conventions {
        ApiConventions::OpenGl => Convention::OPENGL,
        _ => Convention::CHAPTER,
    };
    let table = DepthTable::new(near, far, convention, DepthFormat::FixedPoint(24)).ok()?;
    let row = |distance: f64| {
        let row = table.row_at(distance).ok()?;
        Some(json!([row.distance, row.depths[0], row.steps[0]]))
    };
    let rows: Vec<Json> = table.default_distances().into_iter().filter_map(row).collect();
    let half = 2.0 * far * near / (far + near);
    let columns = [
        words("distance", "距离"),
        words("depth", "深度"),
        words("smallest step with 24 bits", "24 位深度的最小步长"),
    ];
    let columns = columns.map(Words::to_json);
    Some(json!({"columns": columns, "rows": rows, "half_range_distance": half}))
}
