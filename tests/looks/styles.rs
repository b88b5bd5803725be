//! Checks every model in every style, as a still and as a thumbnail: no picture is empty, and lines
//! leave some paper visible.

use super::BareModel;
use alberti_tests::harness::is_thorough;
use scene::Style;
use scene_file::file::StyleFile;

/// The size of a thumbnail.
const THUMBNAIL: (u32, u32) = (64, 64);
/// The minimum fraction of the picture in its most frequent color, which is the paper in line
/// drawings.
const LEAST_PAPER: f64 = 0.25;
/// The minimum fraction of pixels that differ from the most frequent color.
const LEAST_DRAWN: f64 = 0.0005;

/// The number of pictures per model in the first tier.
const FEW_CASES: usize = 2;

/// Returns all styles of the command line, with their names.
pub fn all_styles() -> Vec<(&'static str, StyleFile)> {
    vec![
        ("shaded", StyleFile::Shaded),
        ("flat", StyleFile::Flat),
        ("unlit", StyleFile::Unlit),
        ("gouraud", StyleFile::Gouraud),
        ("clay", StyleFile::Clay),
        ("matcap", StyleFile::Matcap),
        ("normals", StyleFile::Normals),
        ("depth", StyleFile::Depth),
        ("uv", StyleFile::UvChecker),
        ("ids", StyleFile::Ids),
        ("toon", StyleFile::Toon),
        ("x-ray", StyleFile::XRay),
        ("wireframe", StyleFile::Wireframe),
        ("depth-cued", StyleFile::lines_depth_cued()),
        ("lines", StyleFile::lines_hidden_removed()),
        ("dashed", StyleFile::lines_hidden_dashed()),
        ("silhouette", StyleFile::lines_silhouette()),
        ("outline", StyleFile::lines_outline()),
        ("technical", StyleFile::lines_technical()),
        ("patent", StyleFile::lines_patent()),
        ("blueprint", StyleFile::lines_blueprint()),
        ("sketch", StyleFile::lines_sketch()),
    ]
}

/// Keeps a few cases, chosen by the model name so that each style is tested with some of the
/// models. Keeps all if the environment variable `THOROUGH` is set.
pub fn keep_few<T>(cases: &mut Vec<T>, name: &str, count: usize) {
    if !is_thorough() {
        let turn =
            name.bytes().fold(0, |sum, byte| (31 * sum + usize::from(byte)) % 10_007) % cases.len();
        cases.rotate_left(turn);
        cases.truncate(count);
    }
}

/// Returns the defects in a model's pictures in some or all of the styles.
pub(super) fn judge_styles(model: &BareModel<'_>, name: &str) -> Vec<String> {
    let mut cases: Vec<_> = all_styles()
        .into_iter()
        .flat_map(|style| [super::SIZE, THUMBNAIL].map(|size| (style.clone(), size)))
        .collect();
    keep_few(&mut cases, name, FEW_CASES);
    let mut faults = Vec::new();
    for ((style_name, style), size) in cases {
        let fault = judge_picture(model, style.with_fitting_lines(size), size);
        // A drawing of many copies, with millions of triangles, may be rejected with a message that
        // names this flag.
        let is_refused = |fault: &String| fault.contains("--no-line-limits");
        let (width, height) = size;
        let in_style = |fault| format!("{style_name}, {width} x {height}: {fault}");
        faults.extend(fault.err().filter(|fault| !is_refused(fault)).map(in_style));
    }
    faults
}

/// Renders a model in a style and checks the picture.
fn judge_picture(model: &BareModel<'_>, style: StyleFile, size: (u32, u32)) -> Result<(), String> {
    let (picture, scene, warnings) = model.render(style, size)?;
    if let Some(empty) =
        warnings.iter().find(|it| matches!(it, drawing::Warning::PictureEmpty { .. }))
    {
        return Err(empty.to_string());
    }
    let mut counts = std::collections::BTreeMap::new();
    for pixel in &picture.pixels {
        *counts.entry(pixel).or_insert(0_usize) += 1;
    }
    let most = counts.values().max().copied().unwrap_or_default();
    let share = most as f64 / picture.pixels.len() as f64;
    if 1.0 - share < LEAST_DRAWN {
        return Err(format!("{:.3} % of the picture has one color", 100.0 * share));
    }
    let is_drawing = matches!(scene.style, Style::Wireframe | Style::Lines(_));
    if is_drawing && share < LEAST_PAPER {
        return Err(format!("lines leave only {:.1} % of the paper", 100.0 * share));
    }
    Ok(())
}
