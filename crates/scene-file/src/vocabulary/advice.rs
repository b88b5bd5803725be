//! Words for which there is no field, with advice on getting the same effect.

/// The struct, variant or enum around the word; lowercase words without separators, separated by
/// spaces; and the help.
const ADVICE: &[(&str, &str, &str)] = &[
    (
        "Sheet",
        "view layout arrangement",
        "a sheet has a front, a top and a side view and a fourth one: choose side_view: Left or Right, and axonometric_view: Isometric, Dimetric, Trimetric, ThreeQuarter or None; or name all of them: views: [View(from: Front), View(from: Top)]",
    ),
    (
        "CameraPath",
        "turntable orbit spin circle rotate",
        "`alberti animate SCENE --turntable -o turn.png` rotates the models without a path; a path is written camera_path: (keys: [(time: 0, eye: (0, 2, 6), target: (0, 0, 0)), (time: 2, eye: (6, 2, 0), target: (0, 0, 0))])",
    ),
    (
        "Camera",
        "rotation rotationeuler orientation",
        "a camera has no rotation angles: write camera: (view: LookAt(eye: (4, 3, 6), target: (0, 0, 0)))",
    ),
    (
        "Scene",
        "frame",
        "the moment of an animation is a model's `time`, in seconds, or `--time 1.5`; sheet: (frame: …) is the border of a drawing",
    ),
    ("Scene", "resolution", "the size of the picture is written image: (size: (640, 480))"),
    ("Scene", "exposure exposureev exposurevalue ev", "write it as image: (exposure_ev: …)"),
    ("Image", "width height", "the size is written size: (640, 480)"),
    ("Scene", "width height", "the size of the picture is written image: (size: (640, 480))"),
    (
        "Scene",
        "time",
        "write models: [(path: \"model.glb\", time: …)] for an animation; a still of a camera path is `alberti render SCENE --time 2`",
    ),
    (
        "Section",
        "plane cut clip clippingplane x y z front top side axis offset distance at",
        "write sections: [(point: (0, 0, 0), normal: (0, 0, 1))]: a point of the plane, and the direction of what is removed",
    ),
    (
        "Projection::OnePoint",
        "fov fovy fovydegrees fieldofview angle focallength",
        "write distance: 3, the distance of the eye in half heights of the picture: the greater, the narrower",
    ),
    (
        "Projection::OnePoint",
        "vanishingpoint vp center z",
        "write at: (0.35, 0.45), from −1 at the bottom of the picture to 1 at its top",
    ),
    (
        "Projection::TwoPoint",
        "fov fovy fovydegrees fieldofview angle focallength distance",
        "the vanishing points decide: x: (-3.2, 0.4), z: (2.4, 0.4), where farther apart is narrower; or choose projection: Perspective(fov_y_degrees: 35)",
    ),
    (
        "Projection::TwoPoint",
        "at vanishingpoint vanishingpoints vp left right points horizon",
        "both vanishing points have a name: x: (-3.2, 0.4), z: (2.4, 0.4), from −1 at the bottom of the picture to 1 at its top",
    ),
    (
        "Projection::ThreePoint",
        "fov fovy fovydegrees fieldofview angle focallength distance at vanishingpoint vanishingpoints",
        "the vanishing points decide: x: (-3.2, 1.2), y: (0.1, -5), z: (2.4, 1.2), where farther apart is narrower",
    ),
    (
        "View::Frame",
        "distance zoom eye position target lookat scale height elevation",
        "Frame finds the distance itself: camera: (zoom: 2) beside the view makes everything twice as large, padding_percent: 20 moves the eye away; with view: LookAt(eye: (0, 2, 6), target: (0, 0, 0)) you place it",
    ),
    (
        "View::Frame",
        "angle azimuth yaw pitch",
        "write from: Direction((1, 1, 1)), the direction from which everything is seen",
    ),
    (
        "Overlay",
        "dimensions dimension measure measures",
        "dimensions are drawn on sheets: remove it, write sheet: (dimensions: true) and draw with `alberti sheet`",
    ),
    (
        "Ground::Shadow",
        "color colour material texture size albedo basecolor",
        "the ground only shows shadows; what is behind them is the background: image: (background: Color(\"#f4f1ea\"))",
    ),
    (
        "Ground::Shadow",
        "opacity alpha strength intensity darkness softness blur",
        "lights decide: with Ambient(intensity: 1) or an environment a shadow is paler, with shadows: On(softness_degrees: 4) softer",
    ),
    (
        "Background::Gradient",
        "top bottom from to start end first second left right",
        "write Gradient(colors: [\"#ffffff\", \"#c8d0d8\"]), from top to bottom",
    ),
    (
        "Light::Spot",
        "target lookat towards",
        "write direction: (x, y, z), the target minus the position",
    ),
    (
        "Light::Directional",
        "target lookat towards",
        "write direction: (-1, -2, -1), the way in which the light travels: from the light to the models",
    ),
    (
        "Light",
        "arealight area rectarealight rectlight",
        "there are no area lights: write environment: Studio(), which has soft boxes, or lights: [Directional(direction: (-1, -2, -1), intensity: 3)] with shadows: On(softness_degrees: 4)",
    ),
    (
        "Ground",
        "plane floor grid",
        "write ground: Shadow(), which shows the shadows of the models; overlays: [Grid()] draws a grid",
    ),
    (
        "Lines",
        "hatch hatching hatched",
        "write face_fill: Hatching; cuts of `sections` are always hatched, at hatch_spacing_mm",
    ),
    (
        "Lines",
        "hatchangle hatchdirection hatchdegrees",
        "the direction of hatch lines is fixed; hatch_spacing_mm: 2 is their distance",
    ),
    (
        "Lines",
        "stroke line pen",
        "write width: Px(2) for how wide the lines are, color: \"black\" for their color",
    ),
    (
        "Light",
        "softbox softlight studiolight keylight filllight rimlight",
        "write lights: [Directional(direction: (-1, -2, -1), intensity: 3)]; environment: Studio() has soft boxes",
    ),
    (
        "Image",
        "format filetype file output path name",
        "remove it: the name of the output says it, as in `alberti render SCENE -o picture.png`, .svg, .pdf or .dxf",
    ),
    (
        "Instances",
        "random scatter poisson points array",
        "write instances: List([(translation: (1, 0, 2), rotation_degrees: (0, 40, 0)), (translation: (4, 0, 1))])",
    ),
    (
        "Instances::Grid",
        "rows columns cols layers nx ny nz x y z size",
        "write count: (5, 1, 4), along x, y and z; y is up",
    ),
    (
        "Instances::Grid",
        "spacing distance pitch gap offset",
        "write step: (2, 0, 2), the distances along x, y and z; y is up",
    ),
    (
        "CameraPath",
        "duration seconds length loop closed time times fps frames speed",
        "the times of the keys decide: the path ends at the last key, and closes if that is like the first: keys: [(time: 0, eye: (0, 2, 6), target: (0, 0, 0)), (time: 2, eye: (6, 2, 0), target: (0, 0, 0))]",
    ),
    (
        "Viewport",
        "x y width height left top w h rect region area position size rectangle bounds",
        "write at: (0.5, 0, 0.5, 0.5): left, top, width and height as fractions of the picture",
    ),
    (
        "Stereo",
        "true yes on enabled stereo",
        "write stereo: SideBySide(), or Anaglyph() for red and cyan glasses",
    ),
    (
        "Style",
        "depthcued depthcue depthcueing",
        "write style: Lines(edges: Facets, hidden: Drawn, depth_cue_percent: 80)",
    ),
    ("Style", "dashed", "write style: Lines(hidden: Dashed)"),
    ("Style", "silhouette", "write style: Lines(edges: Silhouette)"),
    ("Style", "outline", "write style: Lines(edges: Outline)"),
    ("Style", "technical", "write style: Lines(edges: Tangents, hidden: Dashed, width: Iso(0.5))"),
    (
        "Style",
        "patent",
        "write style: Lines(width: Iso(0.35), color: \"#000000\", hatch_spacing_mm: 1.2, face_fill: ShadeHatching)",
    ),
    (
        "Style",
        "blueprint",
        "write style: Lines(edges: Tangents, hidden: Dashed, width: Iso(0.5), color: \"#ffffff\", paper: \"#1d4279\")",
    ),
    (
        "Style",
        "sketch",
        "write style: Lines(width: Mm(0.3), color: \"#444240\", hand_drawn_mm: 0.35)",
    ),
    (
        "EdgeSelection",
        "technical blueprint",
        "`--style technical` stands for Lines(edges: Tangents, hidden: Dashed, width: Iso(0.5))",
    ),
    ("Style", "hatched hatching hatch engraving", "write style: Lines(face_fill: Hatching)"),
];

/// Advice for a word in `owner` that is not one of its fields; `word` is lowercase and without
/// separators.
pub(super) fn find_advice(owner: &str, word: &str) -> Option<&'static str> {
    let is_meant = |(place, words, _): &&(&str, &str, &str)| {
        *place == owner && words.split(' ').any(|known| known == word)
    };
    ADVICE.iter().find(is_meant).map(|(.., help)| *help)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::StyleFile;
    use crate::parse_scene;

    /// The flag's names for line drawings lead to the same style in a scene.
    #[test]
    fn advice_on_line_styles_is_what_the_flags_stand_for() {
        let mut checked = 0;
        for (name, style) in StyleFile::NAMED {
            let word: String = name.chars().filter(char::is_ascii_alphabetic).collect();
            let Some(help) = find_advice("Style", &word) else { continue };
            let field = help.strip_prefix("write ").expect("a field");
            let source = format!("Scene(models: [(path: \"a.glb\")], {field})");
            let scene = parse_scene("scene.ron", &source).expect(help);
            assert_eq!(scene.style, style(), "{name}");
            checked += 1;
        }
        assert_eq!(checked, 8);
    }
}
