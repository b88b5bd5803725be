//! Tests of handwritten 3MF files: the resulting models, and the messages about broken and hostile
//! files.

use crate::load_bytes;
use gltf_import::{ImportError, ImportOptions, Limits};
use model::{AlphaMode, LengthUnit, Model, UpAxis};

/// Returns a zip archive with stored (method 0) or deflated (8) entries.
fn zip(entries: &[(&str, &[u8])], method: u16) -> Vec<u8> {
    let (mut file, mut directory) = (Vec::new(), Vec::new());
    for (name, content) in entries {
        let data = match method {
            8 => {
                let framed = fdeflate::compress_to_vec(content);
                framed[2..framed.len() - 4].to_vec()
            }
            _ => content.to_vec(),
        };
        let offset = file.len() as u32;
        let mut common = [20_u16, 0, method, 0, 0].map(u16::to_le_bytes).concat();
        common.extend(crc32fast::hash(content).to_le_bytes());
        common.extend((data.len() as u32).to_le_bytes());
        common.extend((content.len() as u32).to_le_bytes());
        common.extend((name.len() as u16).to_le_bytes());
        common.extend([0, 0]);
        file.extend([b"PK\x03\x04", &common[..], name.as_bytes(), &data].concat());
        directory.extend([b"PK\x01\x02\x14\0", &common[..], &[0; 10]].concat());
        directory.extend([&offset.to_le_bytes(), name.as_bytes()].concat());
    }
    let (offset, count) = (file.len() as u32, entries.len() as u16);
    file.extend(&directory);
    file.extend(b"PK\x05\x06\0\0\0\0");
    file.extend([count.to_le_bytes(), count.to_le_bytes()].concat());
    file.extend([(directory.len() as u32).to_le_bytes(), offset.to_le_bytes()].concat());
    file.extend([0, 0]);
    file
}

const RELATIONSHIPS: &[u8] = br#"<Relationships><Relationship Target="/3D/3dmodel.model" Id="r"
    Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>"#;

/// The namespace declarations for a model.
const XMLNS: &str = r#"xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
    xmlns:m="http://schemas.microsoft.com/3dmanufacturing/material/2015/02"
    xmlns:p="http://schemas.microsoft.com/3dmanufacturing/production/2015/06"
    xmlns:b="http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02"
    xmlns:x="http://example.com/unheard-of""#;

/// Returns an object with one triangle, with corners at the origin, (x, 0, 0) and (0, 1, 0).
fn object(id: u32, x: u32, attributes: &str, triangle: &str) -> String {
    format!(
        r#"<object id="{id}" {attributes}><mesh><vertices><vertex x="0" y="0" z="0"/>
        <vertex x="{x}" y="0" z="0"/><vertex x="0" y="1" z="0"/></vertices>
        <triangles><triangle v1="0" v2="1" v3="2" {triangle}/></triangles></mesh></object>"#
    )
}

/// Returns the XML of a model with resources and build items.
fn model_text(attributes: &str, resources: &str, build: &str) -> String {
    format!(
        "<?xml version=\"1.0\"?><model {XMLNS} {attributes}><resources>{resources}</resources>\
         <build>{build}</build></model>"
    )
}

/// Returns a package with a model.
fn package(attributes: &str, resources: &str, build: &str) -> Vec<u8> {
    let model = model_text(attributes, resources, build);
    zip(&[("_rels/.rels", RELATIONSHIPS), ("3D/3dmodel.model", model.as_bytes())], 8)
}

fn load(bytes: &[u8]) -> Result<Model, ImportError> {
    load_bytes("a.3mf", bytes, &ImportOptions::default())
}

fn load_leniently(bytes: &[u8]) -> Model {
    load_bytes("a.3mf", bytes, &ImportOptions { lenient: true, ..ImportOptions::default() })
        .unwrap()
}

fn fault(bytes: &[u8]) -> String {
    load(bytes).unwrap_err().diagnostic.sentence()
}

fn messages(model: &Model) -> Vec<String> {
    model.warnings.iter().map(model::Diagnostic::sentence).collect()
}

/// Returns the bounds in the file's coordinates, which have z up.
fn bounds(bytes: &[u8]) -> [[f64; 3]; 2] {
    let options = ImportOptions { up: Some(UpAxis::Y), ..ImportOptions::default() };
    let bounds = load_bytes("a.3mf", bytes, &options).unwrap().bounds().unwrap();
    [bounds.min().into(), bounds.max().into()]
}

const ITEM: &str = r#"<item objectid="1"/>"#;

#[test]
fn units_and_up_axis_come_from_the_file() {
    for (attributes, unit) in [
        ("", LengthUnit::Millimeter),
        (r#"unit="inch""#, LengthUnit::Inch),
        (r#"unit="micron""#, LengthUnit::Micrometer),
    ] {
        let model = load(&package(attributes, &object(1, 1, "", ""), ITEM)).unwrap();
        assert_eq!((model.length_unit, model.up_axis), (unit, UpAxis::Z));
        assert!(model.warnings.is_empty(), "{:?}", messages(&model));
    }
}

#[test]
fn transforms_apply_to_row_vectors() {
    // The component is rotated by 90° about z and moved; the item then transforms it again.
    let components = r#"<object id="2"><components>
        <component objectid="1" transform="0 1 0 -1 0 0 0 0 1 10 0 0"/></components></object>"#;
    let item = r#"<item objectid="2" transform="2 0 0 0 2 0 0 0 2 0 0 5"/>"#;
    let file = package("", &(object(1, 3, "", "") + components), item);
    // (0,0,0), (3,0,0), (0,1,0) → (10,0,0), (10,3,0), (9,0,0) → doubled and raised by 5.
    assert_eq!(bounds(&file), [[18.0, 0.0, 5.0], [20.0, 6.0, 5.0]]);
}

#[test]
fn production_extension_parts_are_found() {
    let other = model_text("", &object(1, 7, "", ""), "");
    let item = r#"<item objectid="1" p:path="/3D/Objects/other%201.model" p:UUID="u"/>"#;
    let main = model_text(r#"requiredextensions="p""#, &object(1, 1, "", ""), item);
    let entries: [(&str, &[u8]); 3] = [
        ("_rels/.rels", RELATIONSHIPS),
        ("3D/3dmodel.model", main.as_bytes()),
        ("3D/Objects/Other 1.model", other.as_bytes()),
    ];
    for method in [0, 8] {
        assert_eq!(bounds(&zip(&entries, method))[1], [7.0, 1.0, 0.0]);
    }
    let message = fault(&zip(&entries[..2], 0));
    assert!(
        message.contains("the archive has no entry \"/3D/Objects/other%201.model\""),
        "{message}"
    );
}

#[test]
fn supports_and_helpers_are_skipped_and_counted() {
    let resources = object(1, 1, "", "")
        + &object(2, 9, r#"type="support""#, "")
        + &object(3, 9, r#"type="other""#, "");
    let items = r#"<item objectid="1"/><item objectid="2"/><item objectid="3"/>"#;
    let file = package("", &resources, items);
    assert_eq!(bounds(&file)[1], [1.0, 1.0, 0.0]);
    let expected = "skipped 2 objects of type support or other";
    assert_eq!(messages(&load(&file).unwrap()), [expected]);
}

#[test]
fn base_materials_have_their_display_color() {
    let bases = r##"<basematerials id="5"><base name="red &amp; hot" displaycolor="#FF0000"/>
        <base name="glass" displaycolor="#0000FF33"/><base name="cad" displaycolor="#80808000"/>
        </basematerials>"##;
    for (pindex, name, color, mode) in [
        (0, "red & hot", [1.0, 0.0, 0.0, 1.0], AlphaMode::Opaque),
        (1, "glass", [0.0, 0.0, 1.0, 0.2], AlphaMode::Blend),
        (2, "cad", [0.215_860_53, 0.215_860_53, 0.215_860_53, 1.0], AlphaMode::Opaque),
    ] {
        let pid = format!(r#"pid="5" pindex="{pindex}""#);
        let model =
            load(&package("", &(bases.to_owned() + &object(1, 1, &pid, "")), ITEM)).unwrap();
        let primitive = &model.meshes[0].primitives[0];
        let material = &model.materials[primitive.material.unwrap()];
        assert_eq!(material.name.as_deref(), Some(name));
        assert_eq!((material.base_color, material.alpha_mode), (color, mode));
        assert!(primitive.colors.is_none());
    }
}

#[test]
fn corner_colors_come_from_properties() {
    let group = r##"<m:colorgroup id="5"><m:color color="#FF0000"/><m:color color="#00FF00FF"/>
        <m:color color="#0000FF"/></m:colorgroup>"##;
    let (red, green, blue) = ([1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0], [0.0, 0.0, 1.0, 1.0]);
    for (attributes, triangle, expected) in [
        (r#"pid="5" pindex="2""#, "", [blue; 3]),
        (r#"pid="5" pindex="2""#, r#"p1="0" p2="1" p3="2""#, [red, green, blue]),
        ("", r#"pid="5" p1="1""#, [green; 3]),
    ] {
        let file = package("", &(group.to_owned() + &object(1, 1, attributes, triangle)), ITEM);
        let model = load(&file).unwrap();
        let primitive = &model.meshes[0].primitives[0];
        let colors = primitive.colors.as_ref().unwrap();
        assert_eq!([0, 1, 2].map(|at| colors[primitive.indices[at] as usize]), expected);
    }
    let file = package("", &(group.to_owned() + &object(1, 1, "", r#"pid="5" p1="77""#)), ITEM);
    let said = messages(&load(&file).unwrap());
    assert!(said[0].contains("1 triangle names a property that does not exist"), "{said:?}");
}

#[test]
fn mixed_materials_and_layers_have_mean_colors() {
    let groups = r##"<basematerials id="5"><base name="a" displaycolor="#FF0000"/>
        <base name="b" displaycolor="#0000FF"/></basematerials>
        <m:compositematerials id="6" matid="5" matindices="0 1"><m:composite values="1 3"/>
        </m:compositematerials><m:colorgroup id="7"><m:color color="#FFFFFF80"/></m:colorgroup>
        <m:multiproperties id="8" pids="5 7" blendmethods="mix"><m:multi pindices="0 0"/>
        </m:multiproperties>"##;
    let half = 128.0 / 255.0;
    for (group, expected) in [(6, [0.25, 0.0, 0.75, 1.0]), (8, [1.0, half, half, 1.0])] {
        let attributes = format!(r#"pid="{group}" pindex="0""#);
        let file = package("", &(groups.to_owned() + &object(1, 1, &attributes, "")), ITEM);
        let model = load(&file).unwrap();
        assert_eq!(model.meshes[0].primitives[0].colors.as_ref().unwrap()[0], expected);
        assert_eq!(model.warnings.len(), 2, "{:?}", messages(&model));
    }
}

#[test]
fn textures_come_from_the_archive_and_are_flipped() {
    let mut image = Vec::new();
    let mut encoder = png::Encoder::new(&mut image, 1, 1);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header().unwrap().write_image_data(&[1, 2, 3]).unwrap();
    let resources = r#"<m:texture2d id="4" path="/3D/Textures/a.png" contenttype="image/png"
        tilestyleu="mirror"/><m:texture2dgroup id="5" texid="4"><m:tex2coord u="0" v="0"/>
        <m:tex2coord u="1" v="0.25"/></m:texture2dgroup>"#
        .to_owned()
        + &object(1, 1, "", r#"pid="5" p1="0" p2="1" p3="0""#);
    let model = model_text("", &resources, ITEM);
    let entries: [(&str, &[u8]); 3] = [
        ("_rels/.rels", RELATIONSHIPS),
        ("3D/3dmodel.model", model.as_bytes()),
        ("3D/Textures/a.png", &image),
    ];
    let model = load(&zip(&entries, 8)).unwrap();
    assert!(model.warnings.is_empty(), "{:?}", messages(&model));
    assert_eq!(model.images[0].as_ref().unwrap().rgba, [[1, 2, 3, 255]]);
    assert_eq!(model.textures[0].sampler.wrap_u, model::WrapMode::MirroredRepeat);
    let primitive = &model.meshes[0].primitives[0];
    let uv_at = |corner: usize| primitive.uvs[0][primitive.indices[corner] as usize];
    assert_eq!([uv_at(0), uv_at(1)], [[0.0, 1.0], [1.0, 0.75]]);
    // Without the image the surface is plain, and a warning gives the reason.
    let model = load(&zip(&entries[..2], 8)).unwrap();
    assert!(messages(&model)[0].contains("the archive has no entry"), "{:?}", messages(&model));
    assert!(model.materials.iter().all(|material| material.base_color_texture.is_none()));
}

#[test]
fn extensions_are_reported_by_name() {
    let lattice = object(1, 1, "", "").replace("</mesh>", "<b:beamlattice radius=\"1\"/></mesh>");
    let model = load(&package(r#"requiredextensions="b""#, &lattice, ITEM)).unwrap();
    let said = messages(&model);
    assert!(said[0].contains("skipped beam lattices, which the file requires"), "{said:?}");
    assert!(said[1].contains("skipped unsupported beam lattices"), "{said:?}");
    let file = package(r#"requiredextensions="x""#, &object(1, 1, "", ""), ITEM);
    assert!(fault(&file).contains("unknown required extension \"x\""));
    assert_eq!(load_leniently(&file).meshes.len(), 1);
    // Extensions that are not required are ignored.
    let unknown = format!("<x:object id=\"9\"/>{}", object(1, 1, "x:v1=\"2\"", ""));
    assert!(load(&package("", &unknown, ITEM)).unwrap().warnings.is_empty());
}

#[test]
fn an_empty_build_section_shows_all_top_level_objects() {
    let components =
        r#"<object id="2"><components><component objectid="1"/></components></object>"#;
    let model = load(&package("", &(object(1, 1, "", "") + components), "")).unwrap();
    assert_eq!(messages(&model), ["the build section is empty; all objects are shown"]);
    assert_eq!(model.mesh_instances().count(), 1);
}

#[test]
fn model_errors_have_a_location() {
    let broken =
        |from: &str, to: &str| fault(&package("", &object(1, 1, "", "").replace(from, to), ITEM));
    for (from, to, expected) in [
        ("v3=\"2\"", "v3=\"3\"", "there is no vertex 3: the mesh has 3"),
        ("v3=\"2\"", "", "the triangle lacks a vertex"),
        ("z=\"0\"", "z=\"nan\"", "the vertex does not have three finite coordinates"),
        ("x=\"1\"", "x=\"1e39\"", "the vertex does not have three finite coordinates"),
        ("id=\"1\"", "", "the object has no id"),
        ("id=\"1\"", "id=\"3\"", "there is no object 1"),
        ("</mesh>", "</mash>", "this end tag does not match the innermost element"),
        ("<mesh>", "<!DOCTYPE a>", "document type declarations are not allowed"),
    ] {
        let message = broken(from, to);
        assert!(message.starts_with("3D/3dmodel.model: line "), "{message}");
        assert!(message.contains(expected), "{message}");
    }
    let file = package("", &object(1, 1, "", ""), r#"<item objectid="1" transform="1 2 3"/>"#);
    assert!(fault(&file).contains("the transform must be twelve finite numbers"));
}

#[test]
fn component_cycles_are_rejected() {
    let object = |id: u32, other: u32| {
        format!(
            "<object id=\"{id}\"><components><component objectid=\"{other}\"/></components></object>"
        )
    };
    let file = package("", &(object(1, 2) + &object(2, 1)), ITEM);
    assert!(fault(&file).contains("the object contains itself"));
    assert_eq!(load_leniently(&file).nodes.len(), 3);
}

#[test]
fn exponential_assemblies_are_rejected_before_building() {
    let mut resources = object(1, 1, "", "");
    for id in 2..60 {
        let component = format!("<component objectid=\"{}\"/>", id - 1);
        resources += &format!(
            "<object id=\"{id}\"><components>{component}{component}</components></object>"
        );
    }
    let file = package("", &resources, r#"<item objectid="59"/>"#);
    let message = fault(&file);
    assert!(message.contains("more than the limit of 1000000"), "{message}");
    // Fewer nodes, but still more than such a small file may have.
    let message = fault(&package("", &resources, r#"<item objectid="18"/>"#));
    assert!(message.contains("array_growth"), "{message}");
    let mut deep = object(1, 1, "", "");
    for id in 2..1_100 {
        deep += &format!(
            "<object id=\"{id}\"><components><component objectid=\"{}\"/></components></object>",
            id - 1
        );
    }
    let message = fault(&package("", &deep, r#"<item objectid="1099"/>"#));
    assert!(message.contains("levels deep, more than the limit of 1024"), "{message}");
}

#[test]
fn bombs_are_rejected_by_size_and_ratio() {
    let zeros = "\0".repeat(40 << 20);
    let file = package("", &zeros, "");
    assert!(file.len() < 1 << 20);
    let message = fault(&file);
    assert!(message.contains("array_growth"), "{message}");
    let limits = Limits { array_bytes: 1 << 10, ..Limits::default() };
    let options = ImportOptions { limits, ..ImportOptions::default() };
    let file = package("", &" ".repeat(2 << 10), "");
    let message = load_bytes("a.3mf", &file, &options).unwrap_err().to_string();
    assert!(message.contains("array_bytes"), "{message}");
}

#[test]
fn memory_of_short_tags_is_charged() {
    let limits = Limits { array_growth: 1, ..Limits::default() };
    let options = ImportOptions { limits, ..ImportOptions::default() };
    let many = |tag: &str| tag.repeat(150_000);
    let bases = format!("<basematerials id='5'>{}</basematerials>", many("<base/>"));
    let components = many("<component objectid='1'/>");
    let components = format!("<object id='2'><components>{components}</components></object>");
    for (resources, build) in [
        (many("<object id='7'/>"), String::new()),
        (String::new(), many("<item objectid='1'/>")),
        (components, String::new()),
        (bases, String::new()),
    ] {
        let file = package("", &resources, &build);
        let message = load_bytes("a.3mf", &file, &options).unwrap_err().to_string();
        assert!(message.contains("array_growth"), "{message}");
    }
}

#[test]
fn many_objects_are_read() {
    // Ids and item counts exceed 16 bits.
    let count = 65_537;
    let ids = || 1..=count;
    let resources: String = ids().map(|id| object(id, id, "", "")).collect();
    let items: String = ids().map(|id| format!("<item objectid=\"{id}\"/>")).collect();
    let model = load(&package("", &resources, &items)).unwrap();
    assert_eq!((model.meshes.len(), model.mesh_instances().count()), (65_537, 65_537));
    assert_eq!(model.bounds().unwrap().max().raw().x, f64::from(count));
}

#[test]
fn broken_archives_are_errors() {
    let file = package("", &object(1, 1, "", ""), ITEM);
    let find = |signature: &[u8]| file.windows(4).rposition(|window| window == signature).unwrap();
    let directory = find(b"PK\x01\x02");
    let patched = |at: usize, byte: u8| {
        let mut file = file.clone();
        file[at] = byte;
        fault(&file)
    };
    assert!(patched(directory + 8, 1).contains("the archive entry is encrypted"));
    assert!(patched(directory + 10, 14).contains("the unsupported compression method 14"));
    assert!(patched(directory + 16, 0).contains("checksum"));
    assert!(patched(directory + 27, 1).contains("too many for"), "a size of at least 16 MiB");
    assert!(patched(directory + 24, 0xFF).contains("size"));
    assert!(patched(directory, b'X').contains("the directory of the zip archive is broken"));
    assert!(patched(directory + 44, 0xFF).contains("truncated"));
    assert!(patched(find(b"PK\x05\x06"), b'X').contains("the zip archive has no directory"));
    for length in 0..file.len() {
        assert!(load(&file[..length]).is_err());
    }
    let other = zip(&[("word/document.xml", b"<a/>")], 0);
    assert!(fault(&other).contains("this zip archive is not a 3MF file"));
}

#[test]
fn names_stay_within_the_archive_and_are_unique() {
    let model = model_text("", &object(1, 1, "", ""), ITEM);
    let entries: [(&str, &[u8]); 5] = [
        ("_rels/.rels", RELATIONSHIPS),
        ("3D/3dmodel.model", model.as_bytes()),
        ("../../etc/passwd", b"a"),
        ("/etc/shadow", b"a"),
        ("3d/3DMODEL.model", b"a"),
    ];
    let model = load(&zip(&entries[..4], 0)).unwrap();
    assert_eq!(messages(&model).len(), 2);
    assert!(messages(&model)[0].contains("the name points outside the archive"));
    let twice = zip(&entries, 0);
    assert!(fault(&twice).contains("the archive has two entries with this name"));
    assert_eq!(load_leniently(&twice).meshes.len(), 1);
    // Without a relationship the model is found by its name.
    let model = load(&zip(&entries[1..2], 0)).unwrap();
    assert!(messages(&model)[0].contains("3D/3dmodel.model is used"));
}
