//! Checks the invariants that the documentation promises for a loaded model.

use model::{Model, Primitive};

/// Checks every verifiable sentence in the model's documentation.
pub fn check_model(model: &Model) -> Result<(), String> {
    for (at, mesh) in model.meshes.iter().enumerate() {
        for (part, primitive) in mesh.primitives.iter().enumerate() {
            check_primitive(model, primitive)
                .map_err(|e| format!("mesh {at}, primitive {part}: {e}"))?;
        }
    }
    check_nodes(model)?;
    for material in &model.materials {
        let used = material.base_color_texture;
        require(
            used.is_none_or(|used| used.texture < model.textures.len()),
            "a texture is missing",
        )?;
        let numbers =
            [material.metallic, material.roughness].into_iter().chain(material.base_color);
        require(numbers.chain(material.emissive).all(f32::is_finite), "a factor is not finite")?;
        let uv_map = used.map(|used| used.uv_matrix);
        let finite = |map: [[f32; 3]; 2]| map.as_flattened().iter().all(|x| x.is_finite());
        require(uv_map.is_none_or(finite), "a texture transform is not finite")?;
    }
    for texture in &model.textures {
        require(
            texture.image.is_none_or(|image| image < model.images.len()),
            "an image is missing",
        )?;
    }
    for image in model.images.iter().flatten() {
        let texels = u64::from(image.width) * u64::from(image.height);
        require(texels > 0 && image.rgba.len() as u64 == texels, "an image is incomplete")?;
    }
    check_instances(model)?;
    for animation in 0..model.animations.len().min(2) {
        let mut posed = model.clone();
        for seconds in [-1.0, 0.0, 0.7, f64::INFINITY, f64::NAN] {
            posed.apply_animation(animation, seconds);
            check_instances(&posed)
                .map_err(|e| format!("animation {animation}, {seconds} s: {e}"))?;
        }
    }
    Ok(())
}

/// Checks every instance in the scene and its vertices.
fn check_instances(model: &Model) -> Result<(), String> {
    for instance in model.node_instances() {
        require(instance.node_to_model.is_finite(), "an instance transform is not finite")?;
    }
    for instance in model.mesh_instances() {
        require(instance.node_to_model.is_finite(), "a transform of GPU instancing is not finite")?;
        let mesh = model.nodes[instance.node].mesh.map(|mesh| &model.meshes[mesh]);
        for primitive in mesh.iter().flat_map(|mesh| &mesh.primitives) {
            check_posed(model, instance, primitive)?;
        }
    }
    Ok(())
}

fn require(truth: bool, otherwise: &str) -> Result<(), String> {
    if truth { Ok(()) } else { Err(otherwise.to_owned()) }
}

fn check_primitive(model: &Model, primitive: &Primitive) -> Result<(), String> {
    let vertices = primitive.positions.len();
    let whole = primitive.indices.len().is_multiple_of(primitive.topology.vertices_per_item());
    require(whole, "a triangle, line or point is incomplete")?;
    require(
        primitive.indices.iter().all(|&i| (i as usize) < vertices),
        "an index is out of range",
    )?;
    require(
        primitive.positions.as_flattened().iter().all(|x| x.is_finite()),
        "a position is not finite",
    )?;
    let lengths = [
        primitive.normals.as_ref().map(Vec::len),
        primitive.colors.as_ref().map(Vec::len),
        primitive.tangents.as_ref().map(Vec::len),
    ];
    let skins = primitive
        .joint_indices
        .iter()
        .map(Vec::len)
        .chain(primitive.joint_weights.iter().map(Vec::len));
    let uvs = primitive.uvs.iter().map(Vec::len).chain(skins);
    require(
        primitive.joint_indices.len() == primitive.joint_weights.len(),
        "the joint and weight counts differ",
    )?;
    let targets = primitive
        .morph_targets
        .iter()
        .flat_map(|t| [&t.positions, &t.normals, &t.tangents])
        .flatten();
    require(targets.map(Vec::len).all(|n| n == vertices), "a morph target has the wrong length")?;
    let looks = primitive
        .morph_targets
        .iter()
        .flat_map(|t| t.colors.iter().map(Vec::len).chain(t.uvs.iter().flatten().map(Vec::len)));
    require(
        looks.into_iter().all(|n| n == vertices),
        "a morph target attribute has the wrong length",
    )?;
    check_edge_lines(model, primitive)?;
    require(
        lengths.into_iter().flatten().chain(uvs).all(|n| n == vertices),
        "an attribute has the wrong length",
    )?;
    require(primitive.normals.iter().flatten().all(is_unit), "a normal is not of unit length")?;
    let uvs = primitive.uvs.iter().flatten().flatten();
    require(uvs.into_iter().all(|x| x.is_finite()), "a texture coordinate is not finite")?;
    let colors = primitive.colors.iter().flatten().flatten();
    require(colors.into_iter().all(|x| (0.0..=1.0).contains(x)), "a color is not in [0, 1]")?;
    require(primitive.material.is_none_or(|at| at < model.materials.len()), "a material is missing")
}

fn check_edge_lines(model: &Model, primitive: &Primitive) -> Result<(), String> {
    let Some(edges) = &primitive.edges else { return Ok(()) };
    let visibility = edges.visibility.as_ref().map(Vec::len);
    require(
        visibility.is_none_or(|n| n == primitive.item_count()),
        "a triangle has missing edges",
    )?;
    let ends = edges.lines.iter().flat_map(|lines| lines.vertex_pairs.as_flattened());
    let vertices = primitive.positions.len();
    require(
        ends.into_iter().all(|&end| (end as usize) < vertices),
        "an edge index is out of range",
    )?;
    let materials = edges.lines.iter().filter_map(|lines| lines.material).chain(edges.material);
    require(materials.into_iter().all(|at| at < model.materials.len()), "an edge has no material")
}

fn is_unit(normal: &[f32; 3]) -> bool {
    let square: f64 = normal.iter().map(|&x| f64::from(x) * f64::from(x)).sum();
    (square - 1.0).abs() < 1e-5
}

fn check_nodes(model: &Model) -> Result<(), String> {
    for (at, node) in model.nodes.iter().enumerate() {
        require(node.to_parent.is_finite(), "a transform is not finite")?;
        require(node.mesh.is_none_or(|mesh| mesh < model.meshes.len()), "a mesh is missing")?;
        require(
            node.camera.is_none_or(|camera| camera < model.cameras.len()),
            "a camera is missing",
        )?;
        let skin =
            node.skin.map(|skin| model.skins.get(skin).is_some_and(|s| !s.joints.is_empty()));
        require(skin != Some(false), "a skin is missing")?;
        let child_knows =
            |&child: &usize| model.nodes.get(child).is_some_and(|c| c.parent == Some(at));
        require(node.children.iter().all(child_knows), "a child has the wrong parent")?;
    }
    for skin in &model.skins {
        require(
            skin.joints.len() == skin.inverse_bind_matrices.len(),
            "the joint and matrix counts differ",
        )?;
        require(skin.joints.iter().all(|&joint| joint < model.nodes.len()), "a joint is missing")?;
    }
    require(model.roots.iter().all(|&root| root < model.nodes.len()), "a root is missing")
}

fn check_posed(
    model: &Model,
    instance: model::MeshInstance,
    primitive: &Primitive,
) -> Result<(), String> {
    let posed = model.skin_primitive(instance, primitive);
    let finite = posed.positions.as_flattened().iter().all(|x| x.is_finite());
    require(finite, "a posed position is not finite")?;
    require(
        posed.positions.len() == primitive.positions.len(),
        "posing changes the number of vertices",
    )?;
    require(
        posed.normals.iter().flat_map(|n| n.iter()).all(is_unit),
        "a posed normal is not of unit length",
    )
}
