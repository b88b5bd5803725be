//! Numbers as colors: scalar vertex attributes, and depth in a colormap.

use crate::gltf_builder::GltfBuilder;
use crate::sandbox::Sandbox;
use model::Colormap;
use serde_json::json;

/// Three squares side by side, facing +z, with the qualities 0, 1 and NaN.
const QUALITIES: &str = "ply
format ascii 1.0
element vertex 12
property float x
property float y
property float z
property float quality
element face 3
property list uchar int vertex_indices
end_header
0 0 0 0
1 0 0 0
1 1 0 0
0 1 0 0
2 0 0 1
3 0 0 1
3 1 0 1
2 1 0 1
4 0 0 nan
5 0 0 nan
5 1 0 nan
4 1 0 nan
4 0 1 2 3
4 4 5 6 7
4 8 9 10 11
";

/// Returns the 8-bit codes of the color at `t` in a colormap.
fn codes(colormap: Colormap, t: f32) -> [u8; 3] {
    colormap.srgb_at(t).map(|fraction| (fraction * 255.0).round() as u8)
}

/// Returns the colors of a picture at the centers of `parts` equal columns, and the messages.
fn column_colors(sandbox: &Sandbox, arguments: &[&str], parts: u32) -> (Vec<[u8; 3]>, String) {
    let picture = ["-o", "out.png", "--size", "100x20", "--view", "front", "--samples", "1"];
    let lens = ["--projection", "orthographic"];
    let run = sandbox.run(&[&["render"], arguments, &picture, &lens].concat());
    assert_eq!(run.code, 0, "{arguments:?}: {}", run.stderr);
    let (width, height, pixels) = sandbox.read_picture("out.png");
    let row = &pixels[(height / 2 * width) as usize..][..width as usize];
    let covered: Vec<usize> = (0..row.len()).filter(|&x| row[x][3] > 0).collect();
    let (first, last) = (covered[0], covered[covered.len() - 1]);
    let center = |part: u32| {
        let place = (2 * part + 1) as usize * (last + 1 - first) / (2 * parts) as usize;
        let [r, g, b, _] = row[first + place];
        [r, g, b]
    };
    ((0..parts).map(center).collect(), run.stderr)
}

fn assert_close(color: [u8; 3], expected: [u8; 3], what: &str) {
    let is_close = color.iter().zip(expected).all(|(a, b)| a.abs_diff(b) <= 1);
    assert!(is_close, "{what}: {color:?} instead of {expected:?}");
}

/// Returns an unlit scene, so that the picture shows the exact colors.
fn scene(model: &str, scalars: &str) -> String {
    format!(
        "Scene(models: [(path: \"{model}\", materials: [(unlit: true)], scalars: ({scalars}))])"
    )
}

#[test]
fn ply_qualities_are_shown_in_colormap_colors() {
    let sandbox = Sandbox::new("colormap_ply");
    sandbox.write_file("scan.ply", QUALITIES);
    sandbox.write_file("scan.ron", scene("scan.ply", "attribute: \"quality\", colormap: Turbo"));
    let gray = [128; 3];
    let turbo = |t| codes(Colormap::Turbo, t);
    for (flags, expected) in [
        (&["scan.ron"][..], [turbo(0.0), turbo(1.0), gray]),
        (&["scan.ron", "--scalar-range", "-1,3"], [turbo(0.25), turbo(0.5), gray]),
        (
            &["scan.ron", "--colormap", "cool-warm", "--scalar-range", "1,2"],
            [codes(Colormap::CoolWarm, 0.0), codes(Colormap::CoolWarm, 0.0), gray],
        ),
    ] {
        let (colors, told) = column_colors(&sandbox, flags, 5);
        for (column, color) in [0, 2, 4].into_iter().zip(expected) {
            assert_close(colors[column], color, &format!("{flags:?} {column}"));
        }
        assert!(told.contains("4 of 12 values of `quality` are not finite"), "{told}");
    }
}

#[test]
fn flags_color_a_bare_model_which_stays_shaded() {
    let sandbox = Sandbox::new("colormap_flags");
    sandbox.write_file("scan.ply", QUALITIES);
    let (colors, _) = column_colors(&sandbox, &["scan.ply", "--scalars", "quality"], 5);
    let [[r, g, b], [red, green, blue]] = [colors[0], colors[2]];
    assert!(r > g && b > r, "violet: {:?}", colors[0]);
    assert!(red > 150 && green > 150 && blue < 100, "yellow: {:?}", colors[2]);
}

#[test]
fn a_custom_gltf_attribute_has_colormap_colors() {
    let sandbox = Sandbox::new("colormap_gltf");
    let mut document = GltfBuilder::square();
    let bytes = json!({"componentType": 5121, "type": "SCALAR", "count": 4});
    let scalars = document.add_accessor(&[10, 10, 10, 10], &bytes);
    document.json["meshes"][0]["primitives"][0]["attributes"]["_TEMPERATURE"] = json!(scalars);
    // The neighboring square lacks the attribute and stays red.
    let plain = json!({"primitives": [{"attributes": {"POSITION": 0}, "mode": 6, "material": 0}]});
    let mesh = document.push_item("/meshes", plain);
    let node = document.push_item("/nodes", json!({"mesh": mesh, "translation": [2, 0, 0]}));
    document.json["scenes"][0]["nodes"] = json!([0, node]);
    document.write_file(&sandbox, "heat");
    for name in ["_TEMPERATURE", "TEMPERATURE", "temperature"] {
        let scalars = format!("attribute: \"{name}\", colormap: Inferno, range: (0, 20)");
        sandbox.write_file("heat.ron", scene("heat.gltf", &scalars));
        let (colors, told) = column_colors(&sandbox, &["heat.ron"], 2);
        assert_close(colors[0], codes(Colormap::Inferno, 0.5), name);
        assert_close(colors[1], [255, 0, 0], "without the attribute");
        assert_eq!(told, "");
    }
    let info = sandbox.run(&["info", "heat.gltf"]);
    assert!(info.stdout.contains("scalars     _TEMPERATURE"), "{}", info.stdout);
    let run = sandbox.run(&["render", "heat.gltf", "--scalars", "mass"]);
    assert_eq!(run.code, 1);
    let message = "no scalar attribute `mass`; choose one of `_TEMPERATURE`";
    assert!(run.stderr.contains(message), "{}", run.stderr);
}

#[test]
fn a_format_without_scalars_is_refused() {
    let sandbox = Sandbox::new("colormap_formats");
    sandbox.write_file("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let run = sandbox.run(&["render", "a.obj", "--scalars", "quality"]);
    assert_eq!(run.code, 1);
    assert!(run.stderr.contains("have no scalar attributes such as `quality`"), "{}", run.stderr);
}

#[test]
fn the_nearest_and_farthest_vertices_have_the_end_colors_of_the_colormap() {
    let sandbox = Sandbox::new("colormap_depth");
    // Two squares that face +z, the right one farther away.
    let square = "0 0 Z\n1 0 Z\n1 1 Z\n0 1 Z\n";
    let vertices = [square.replace('Z', "0"), square.replace('Z', "-5")].concat();
    let vertices =
        vertices.replacen("0 0 -5\n1 0 -5\n1 1 -5\n0 1 -5", "1 0 -5\n2 0 -5\n2 1 -5\n1 1 -5", 1);
    let header = "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\n\
                  property float z\nelement face 2\nproperty list uchar int vertex_indices\n\
                  end_header\n";
    sandbox.write_file("steps.ply", format!("{header}{vertices}4 0 1 2 3\n4 4 5 6 7\n"));
    let depth = ["steps.ply", "--style", "depth"];
    let (gray, _) = column_colors(&sandbox, &depth, 2);
    assert_close(gray[0], [255; 3], "near");
    assert_close(gray[1], [26; 3], "far");
    let (colors, told) =
        column_colors(&sandbox, &[&depth[..], &["--colormap", "turbo"]].concat(), 2);
    assert_close(colors[0], codes(Colormap::Turbo, 1.0), "near");
    assert_close(colors[1], codes(Colormap::Turbo, 0.0), "far");
    assert_eq!(told, "");
    let file = "Scene(models: [(path: \"steps.ply\")], style: Depth, depth_colormap: Turbo)";
    sandbox.write_file("steps.ron", file);
    assert_eq!(column_colors(&sandbox, &["steps.ron"], 2).0, colors);
}

#[test]
fn flags_without_numbers_to_show_are_reported() {
    let sandbox = Sandbox::new("colormap_unused");
    sandbox.write_file("scan.ply", QUALITIES);
    for (flags, told) in [
        (
            &["--colormap", "turbo"][..],
            "--colormap does nothing here: it needs --scalars or --style depth",
        ),
        (&["--scalar-range", "0,1"], "--scalar-range does nothing here: it needs --scalars"),
        (
            &["--scalars", "quality", "--style", "normals"],
            "--scalars does nothing here: the `normals` style does not show vertex colors",
        ),
        (
            &["--scalars", "quality", "--style", "lines"],
            "--scalars does nothing here: a line drawing does not show vertex colors",
        ),
    ] {
        let (_, messages) = column_colors(&sandbox, &[&["scan.ply"], flags].concat(), 5);
        assert!(messages.contains(told), "{flags:?}: {messages}");
    }
    let run = sandbox.run(&["render", "scan.ply", "--scalars", "quality", "--scalar-range", "2,1"]);
    assert_eq!(run.code, 2);
    assert!(run.stderr.contains("the smaller value first"), "{}", run.stderr);
}
