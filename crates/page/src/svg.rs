//! SVG output: writes a page as Scalable Vector Graphics 1.1, in millimeters.
//!
//! ```text
//!  <svg width="210mm" viewBox="0 0 210 297">      user units are millimeters
//!    <title>…</title>
//!    <rect fill="#fff"/>                          the paper, unless transparent
//!    <image href="data:image/png;base64,…"/>      flat fills
//!    <g id="visible-crease" stroke="#1a1f26" …>   one group for each layer, with its pen
//!      <g id="visible-crease.1">                  one group for each object
//!        <title>cube</title>
//!        <path d="M10 5h20v20h-20z"/>             one path for all continuous strokes
//!      </g>
//!    </g>
//!  </svg>
//! ```
//!
//! Path data uses relative commands (`m`, `l`, `h`, `v`), because steps are shorter to write than
//! absolute coordinates. Each step is a whole number of micrometers, so sums have no rounding
//! error: a closed outline with a thousand points ends exactly where it began. Text is drawn as
//! strokes, so the file needs no font. Names from files are escaped by [`escape_markup`].

use super::fixed_decimal::{format_millimeters, format_thousandths, write_thousandths};
use super::markup::escape_markup;
use super::page::{
    Cap, Group, GroupContent, Ink, Join, Layer, Page, PageContent, PagePoint, Pen, PlacedImage,
    Polyline,
};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use std::fmt::Write;

impl<W> Page<W> {
    /// Returns the page as the text of an SVG file.
    ///
    /// ```
    /// use page::{Group, Layer, Page, Pen, Polyline};
    /// use glam::DVec2;
    ///
    /// let mut page: Page = Page::new(DVec2::new(40.0, 30.0), "a line", None);
    /// let mut layer = Layer::new("lines", "lines", Pen::solid(0.5, [0, 0, 0]));
    /// let line = Polyline::through_points(&[DVec2::new(5.0, 5.0), DVec2::new(35.0, 5.0)], false);
    /// layer.groups.push(Group { strokes: line.into_iter().collect(), ..Group::default() });
    /// page.layers.push(layer);
    /// assert!(page.to_svg().contains(r#"<path d="M5 5h30"/>"#));
    /// ```
    #[must_use]
    pub fn to_svg(&self) -> String {
        write_page(self.content())
    }
}

fn write_page(page: PageContent<'_>) -> String {
    let [width, height] = page.size.to_array().map(format_millimeters);
    let mut svg = String::new();
    let _ = write!(
        svg,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}mm\" height=\"{height}mm\" \
         viewBox=\"0 0 {width} {height}\">\n<title>{}</title>\n",
        escape_markup(page.title)
    );
    if let Some(paper) = page.paper {
        let paper = css_color(paper);
        let _ = writeln!(svg, "<rect width=\"{width}\" height=\"{height}\" fill=\"{paper}\"/>");
    }
    for pasted in page.images {
        write_image(&mut svg, pasted);
    }
    for layer in page.layers {
        write_layer(&mut svg, layer);
    }
    svg += "</svg>\n";
    svg
}

/// Writes an image element with its pixels embedded as a PNG.
///
/// `preserveAspectRatio="none"` stretches the image to fill its rectangle, which is rounded to
/// micrometers.
fn write_image(svg: &mut String, pasted: &PlacedImage) {
    let [x, y, width, height] =
        [pasted.corner[0], pasted.corner[1], pasted.size[0], pasted.size[1]]
            .map(|n| format_thousandths(n.into()));
    let _ = write!(
        svg,
        "<image id=\"{}\" x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" \
         preserveAspectRatio=\"none\" href=\"data:image/png;base64,",
        escape_markup(&pasted.id)
    );
    STANDARD.encode_string(pasted.picture.to_png(), svg);
    *svg += "\"/>\n";
}

/// Writes a layer as a group that contains a group for each object.
///
/// Ids are unique because an object's id is prefixed with its layer's id. Titles become tooltips in
/// browsers. A text group with an id but without a title has its text as the title.
fn write_layer(svg: &mut String, layer: &Layer) {
    let id = escape_markup(&layer.id);
    let _ = write!(
        svg,
        "<g id=\"{id}\" {}>\n<title>{}</title>\n",
        pen_attributes(&layer.pen),
        escape_markup(&layer.title)
    );
    for group in &layer.groups {
        if group.id.is_empty() {
            write_paths(svg, group, &layer.pen);
            continue;
        }
        let _ = writeln!(svg, "<g id=\"{id}.{}\">", escape_markup(&group.id));
        let title = match &group.content {
            GroupContent::Text(line) if group.title.is_empty() => &line.text,
            _ => &group.title,
        };
        if !title.is_empty() {
            let _ = writeln!(svg, "<title>{}</title>", escape_markup(title));
        }
        write_paths(svg, group, &layer.pen);
        *svg += "</g>\n";
    }
    *svg += "</g>\n";
}

/// Writes the strokes and fills of a group, with one path for all continuous strokes and one for
/// each dashed stroke.
///
/// Each dashed stroke has its own dash pattern, fitted to its length. Fills are written last and
/// cover the strokes.
fn write_paths(svg: &mut String, group: &Group, pen: &Pen) {
    let (dashed, whole): (Vec<_>, Vec<_>) = group
        .strokes
        .iter()
        .map(|line| (line, pen.fitted_dashes(line)))
        .partition(|(_, d)| !d.is_empty());
    if !whole.is_empty() {
        let _ =
            writeln!(svg, "<path d=\"{}\"/>", path_data(whole.into_iter().map(|(line, _)| line)));
    }
    for (line, dashes) in dashed {
        let dashes: Vec<String> = dashes.into_iter().map(format_millimeters).collect();
        let (path, dashes) = (path_data([line]), dashes.join(" "));
        let _ = writeln!(svg, "<path d=\"{path}\" stroke-dasharray=\"{dashes}\"/>");
    }
    if !group.fills.is_empty() {
        let (path, ink) = (path_data(&group.fills), css_color(pen.ink));
        let _ = writeln!(
            svg,
            "<path d=\"{path}\" fill=\"{ink}\" fill-rule=\"evenodd\" stroke=\"none\"/>"
        );
    }
}

/// Returns the presentation attributes of a pen, except those with SVG defaults (butt caps, miter
/// joins with limit 4).
fn pen_attributes(pen: &Pen) -> String {
    let mut words = format!(
        "fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"",
        css_color(pen.ink),
        format_millimeters(pen.width)
    );
    match pen.cap {
        Cap::Butt => {}
        Cap::Round => words += " stroke-linecap=\"round\"",
        Cap::Square => words += " stroke-linecap=\"square\"",
    }
    match pen.join {
        Join::Miter => {}
        Join::Round => words += " stroke-linejoin=\"round\"",
        Join::Bevel => words += " stroke-linejoin=\"bevel\"",
    }
    words
}

/// Returns a color as `#rrggbb`, or as `#rgb` if that is the same color.
fn css_color([r, g, b]: Ink) -> String {
    if [r, g, b].iter().all(|c| c % 17 == 0) {
        return format!("#{:x}{:x}{:x}", r / 17, g / 17, b / 17);
    }
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// Returns the `d` attribute of a path that contains all the lines.
fn path_data<'a>(lines: impl IntoIterator<Item = &'a Polyline>) -> String {
    let mut path = PathWriter { out: Vec::new(), position: [0, 0], has_started: false };
    for line in lines {
        path.push_polyline(line);
    }
    String::from_utf8_lossy(&path.out).into_owned()
}

/// SVG path data under construction, as ASCII bytes.
struct PathWriter {
    out: Vec<u8>,
    /// The current point in micrometers.
    position: PagePoint,
    /// Whether the absolute `M` command at the start has been written.
    has_started: bool,
}

impl PathWriter {
    /// Appends a subpath.
    ///
    /// The first subpath starts with an absolute `M`. Later subpaths start with `m`, relative to
    /// the current point, which after `z` is the start of the closed subpath.
    fn push_polyline(&mut self, line: &Polyline) {
        let [start, rest @ ..] = line.points.as_slice() else { return };
        self.out.push(if self.has_started { b'm' } else { b'M' });
        self.push_move_to(*start);
        self.has_started = true;
        let mut command = 0;
        for point in rest {
            command = self.push_line_to(*point, command);
        }
        if line.closed {
            self.out.push(b'z');
            self.position = *start;
        }
    }

    /// Appends a straight line with the shortest command and returns the command letter.
    ///
    /// ```text
    ///   dy = 0   h dx        a command letter equal to the previous one is omitted,
    ///   dx = 0   v dy        as is the space before a minus sign:  l.5 .5-.5 .5
    ///   else     l dx dy
    /// ```
    fn push_line_to(&mut self, to: PagePoint, last: u8) -> u8 {
        let (dx, dy) = (self.relative_step(0, to), self.relative_step(1, to));
        let command = match (dx, dy) {
            (_, 0) => b'h',
            (0, _) => b'v',
            _ => b'l',
        };
        if command != last {
            self.out.push(command);
        } else if (if command == b'v' { dy } else { dx }) >= 0 {
            self.out.push(b' ');
        }
        match command {
            b'h' => write_thousandths(&mut self.out, dx),
            b'v' => write_thousandths(&mut self.out, dy),
            _ => self.push_pair(dx, dy),
        }
        self.position = to;
        command
    }

    /// Returns the step along one axis from the current point.
    fn relative_step(&self, axis: usize, to: PagePoint) -> i64 {
        i64::from(to[axis]) - i64::from(self.position[axis])
    }

    /// Appends the coordinates of a move.
    fn push_move_to(&mut self, to: PagePoint) {
        self.push_pair(self.relative_step(0, to), self.relative_step(1, to));
        self.position = to;
    }

    /// Appends two numbers. A space separates them unless the second starts with a minus sign.
    fn push_pair(&mut self, x: i64, y: i64) {
        write_thousandths(&mut self.out, x);
        if y >= 0 {
            self.out.push(b' ');
        }
        write_thousandths(&mut self.out, y);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;

    fn polyline(points: &[[i32; 2]], closed: bool) -> Polyline {
        Polyline { points: points.to_vec(), closed }
    }

    #[test]
    fn path_data_is_compact_and_exact() {
        let lines = [
            polyline(
                &[
                    [1000, 2000],
                    [1500, 2000],
                    [1250, 2000],
                    [1250, 1000],
                    [1000, 1250],
                    [900, 1350],
                    [1000, 1400],
                ],
                false,
            ),
            polyline(&[[0, 0], [500, 500], [0, 1000]], true),
            polyline(&[[10, 10], [20, 10]], false),
        ];
        assert_eq!(
            path_data(&lines),
            "M1 2h.5-.25v-1l-.25 .25-.1 .1 .1 .05m-1-1.4l.5 .5-.5 .5zm.01 .01h.01"
        );
    }

    #[test]
    fn names_are_escaped() {
        let nasty = "</title><script>\u{0}\u{1b}alert(\"1 & 2\")</script>\u{ffff}";
        let mut page: Page = Page::new(DVec2::new(10.0, 10.0), nasty, Some([255; 3]));
        let mut layer = Layer::new("a\"b", nasty, Pen::solid(0.1, [1, 2, 3]));
        let strokes = vec![polyline(&[[0, 0], [1, 1]], false)];
        layer.groups.push(Group {
            id: "1".into(),
            title: nasty.into(),
            strokes,
            ..Group::default()
        });
        page.layers.push(layer);
        let svg = page.to_svg();
        assert!(
            !svg.contains("<script") && svg.contains("&lt;script&gt;alert(&quot;1 &amp; 2&quot;)")
        );
        assert!(svg.contains("id=\"a&quot;b.1\""));
        assert!(svg.chars().all(|c| c >= ' ' || c == '\n'), "{svg}");
    }

    #[test]
    fn colors_use_the_shortest_css_form() {
        assert_eq!(css_color([255, 0, 0x33]), "#f03");
        assert_eq!(css_color([1, 0, 0x33]), "#010033");
    }
}
