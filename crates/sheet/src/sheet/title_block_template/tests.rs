//! Tests for valid templates, and for error positions in invalid templates.

use super::*;

/// Returns a template with this content.
fn parse(content: &str) -> Result<TitleBlockTemplate, TemplateError> {
    TitleBlockTemplate::parse(&format!("<svg viewBox=\"0 0 90 30\">\n{content}\n</svg>"))
}

/// Returns the points of the only line.
fn points(content: &str) -> Vec<[f64; 2]> {
    let template = parse(content).expect("a template");
    assert_eq!(template.lines.len(), 1, "{content}");
    template.lines[0].points.iter().map(DVec2::to_array).collect()
}

#[test]
fn shapes_become_lines() {
    let square = [[1.0, 2.0], [4.0, 2.0], [4.0, 7.0], [1.0, 7.0]];
    for content in [
        "<rect x='1' y='2' width='3' height='5'/>",
        "<polygon points='1,2 4,2 4,7 1,7'/>",
        "<path d='M1 2 H4 V7 H1 Z'/>",
        "<path d='m1,2 3,0 0,5-3,0z'/>",
        "<path d='M1 2L4 2 4 7L1.0.7e1z'/>",
    ] {
        assert_eq!(points(content), square, "{content}");
    }
    assert_eq!(points("<line x1='1' y1='2' x2='3mm'/>"), [[1.0, 2.0], [3.0, 0.0]]);
    let two = parse("<g><path d='M0 0 h5 z l0 3' stroke-width='.7' fill='none'/></g>");
    let two = two.expect("a template").lines;
    assert_eq!((two.len(), two[0].closed, two[1].closed, two[0].width), (2, true, false, 0.7));
    assert_eq!(two[1].points, [DVec2::ZERO, DVec2::new(0.0, 3.0)]);
}

#[test]
fn fields_are_filled_in() {
    let template = parse(
        "<?xml version='1.0'?><!-- a comment --><title>no {field}</title>\n\
         <text x='2' y='9' font-size='5' text-anchor='middle' textLength='60'>{title} &amp; \n\
         {{{ scale }, {sheet}/{sheets} &#x41;</text><text>{projection}</text>",
    );
    let template = template.expect("a template");
    let texts = TitleBlockText { sheet: Some([2, 5]), ..TitleBlockText::default() };
    let values =
        FieldValues { texts: &texts, title: "Bearing", scale: "1:2", paper: "A4", unit: "mm" };
    let [text, symbol] = &template.texts[..] else { panic!("{:?}", template.texts) };
    assert_eq!(text.content(&values), "Bearing &  {1:2, 2/5 A");
    assert_eq!((text.align, text.most_width), (TextAlign::Middle, Some(60.0)));
    assert!((text.height - 3.5).abs() < 1e-12);
    assert!(symbol.is_symbol() && !text.is_symbol());
    for (name, field) in FIELDS {
        assert_eq!(field.to_string(), name);
    }
}

#[test]
fn unsupported_markup_is_reported_with_its_location() {
    for (content, place, words) in [
        ("<circle r='2'/>", (2, 1), "`circle` is not supported"),
        ("<path d='M0 0 C1 1 2 2 3 3'/>", (2, 15), "the command `C` is not supported"),
        ("<path d='M0 0 L1'/>", (2, 17), "missing number"),
        ("<path d='L1 1'/>", (2, 10), "must begin with M"),
        ("<path d='M0 0 L1 x'/>", (2, 18), "missing number"),
        ("<path d='5 5'/>", (2, 10), "does not follow a command"),
        ("<rect x='1e9'/>", (2, 10), "not a number for `x`"),
        ("<rect transform='scale(2)'/>", (2, 18), "`transform` of `rect` is not supported"),
        ("<text style='font-size:3'>a</text>", (2, 14), "as attributes"),
        ("<text>{titel}</text>", (2, 1), "there is no field `titel`"),
        ("<text>{title</text>", (2, 1), "`{` without `}`"),
        ("<text>{projection} {title}</text>", (2, 1), "a separate text element"),
        ("<text><tspan>a</tspan></text>", (2, 7), "inside a text element"),
        ("<text text-anchor='left'>a</text>", (2, 1), "not a text-anchor"),
        ("<text>a &b</text>", (2, 7), "write &amp;"),
        ("<text>a &b; c</text>", (2, 7), "unknown reference `&b;`"),
        ("<rect stroke-width='0'/>", (2, 21), "greater than 0"),
        ("<text font-size='-3'>a</text>", (2, 18), "greater than 0"),
        ("<g><rect/>", (3, 1), "closed but not open"),
        ("<g", (3, 1), "missing name"),
        ("<g id=3>", (2, 7), "quotes"),
        ("<!DOCTYPE svg>", (2, 1), "document types"),
        ("<!-- never closed", (2, 1), "missing `-->`"),
    ] {
        let error = parse(content).expect_err(content);
        assert_eq!((error.line, error.column), place, "{content}: {error}");
        assert!(error.message.contains(words), "{content}: {error}");
    }
    for (svg, words) in [
        ("", "an SVG file"),
        ("<html/>", "an SVG file"),
        ("<svg/>", "viewBox"),
        ("<svg viewBox='0 0 0 9'/>", "from 1 to 1000"),
        ("<svg viewBox='0 5 9 9'/>", "must begin at 0 0"),
        ("<svg viewBox='0 0 9 9'>", "`svg` is not closed"),
    ] {
        let error = TitleBlockTemplate::parse(svg).expect_err(svg);
        assert!(error.to_string().contains(words), "{svg}: {error}");
    }
    let long = parse(&" ".repeat(2 << 20)).expect_err("too long");
    assert!(long.message.contains("at most 1048576 bytes"), "{long}");
    let deep = "<g>".repeat(1000);
    assert!(parse(&deep).expect_err("too deep").message.contains("too deeply"));
}

#[test]
fn corrupt_files_give_errors_without_panics() {
    let good = "<svg viewBox='0 0 90 30'><!-- é --><g><path d='M0 0h5.5.5z'/></g>\
                <text x='2' font-size='5'>{title} &amp; {{ü</text></svg>";
    let pieces =
        ["<", ">", "/", "'", "{", "}", "&", ";", "é", "=", "-", ".", "e", " ", "M", "</g>"];
    let (mut state, mut read) = (1_u64, 0);
    let mut below = |limit: usize| {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % limit
    };
    for _ in 0..20_000 {
        let mut characters: Vec<char> = good.chars().collect();
        for _ in 0..=below(3) {
            let (at, length) = (below(characters.len()), below(4));
            let end = (at + length).min(characters.len());
            characters.splice(at..end, pieces[below(pieces.len())].chars());
        }
        let text: String = characters.into_iter().collect();
        read += usize::from(TitleBlockTemplate::parse(&text).is_ok());
    }
    assert!((100..10_000).contains(&read), "{read}");
}
