"""Convert trimesh objects to arrays. trimesh is never imported; only attributes are read."""

from __future__ import annotations

from typing import Any

from ._errors import AlbertiError


def collect_meshes(scene: Any) -> tuple[list[dict[str, Any]], list[tuple[str | None, int, Any]]]:
    """Return the meshes of a scene or a geometry, and the nodes that place them."""
    import numpy as np

    if not hasattr(scene, "geometry") or not hasattr(scene, "graph"):
        name = getattr(scene, "metadata", {}).get("name") or "mesh"
        mesh = _mesh(scene, str(name))
        return [mesh], [(str(name), 0, np.eye(4))]
    indices: dict[str, int] = {}
    meshes: list[dict[str, Any]] = []
    for name, geometry in scene.geometry.items():
        indices[name] = len(meshes)
        meshes.append(_mesh(geometry, str(name)))
    nodes: list[tuple[str | None, int, Any]] = []
    for node in scene.graph.nodes_geometry:
        transform, name = scene.graph[node]
        nodes.append((str(node), indices[name], transform))
    return meshes, nodes


def _mesh(geometry: Any, name: str) -> dict[str, Any]:
    """Return the arrays of a Trimesh, a PointCloud or a Path3D."""
    import numpy as np

    if not hasattr(geometry, "vertices"):
        message = f"is a {type(geometry).__name__}, expected a trimesh object with vertices"
        raise AlbertiError(message, pointer="scene")
    mesh: dict[str, Any] = {"name": name, "vertices": np.asarray(geometry.vertices)}
    if hasattr(geometry, "faces"):
        mesh["faces"] = np.asarray(geometry.faces).reshape(-1, 3)
        _add_normals(mesh, geometry)
        _add_visual(mesh, geometry.visual)
    elif hasattr(geometry, "entities"):
        ends = [
            pair
            for entity in geometry.entities
            for pair in zip(entity.points[:-1], entity.points[1:])
        ]
        mesh["lines"] = np.asarray(ends, dtype=np.int64).reshape(-1, 2)
    else:
        colors = getattr(geometry, "colors", None)
        if colors is not None and len(colors) == len(mesh["vertices"]):
            mesh["colors"] = np.asarray(colors)
    return mesh


def _add_normals(mesh: dict[str, Any], geometry: Any) -> None:
    """Add normals only if they are cached, because trimesh computes missing normals on access."""
    cache = getattr(getattr(geometry, "_cache", None), "cache", {})
    if "vertex_normals" in cache:
        mesh["normals"] = cache["vertex_normals"]


def _add_visual(mesh: dict[str, Any], visual: Any) -> None:
    """Add colors, or a texture and a material."""
    import numpy as np

    kind = getattr(visual, "kind", None)
    if kind == "vertex":
        mesh["colors"] = np.asarray(visual.vertex_colors)
    elif kind == "face":
        mesh["colors"] = np.asarray(visual.face_colors)
    elif kind == "texture":
        uv = getattr(visual, "uv", None)
        if uv is not None and len(uv) == len(mesh["vertices"]):
            mesh["uv"] = np.asarray(uv)
        _add_material(mesh, visual.material)


def _add_material(mesh: dict[str, Any], material: Any) -> None:
    """Add the image and factors of a material, including Phong factors."""
    import numpy as np

    image = getattr(material, "baseColorTexture", None)
    image = getattr(material, "image", None) if image is None else image
    if image is not None and "uv" in mesh and not _is_placeholder(image):
        mesh["texture"] = np.asarray(image.convert("RGBA"))
    keys = {str(key).lower(): value for key, value in getattr(material, "kwargs", {}).items()}
    if "kd" in keys or "ks" in keys:
        numbers = {key: _numbers(keys[key]) for key in _MTL_KEYS if key in keys}
        mesh["mtl"] = {key: number for key, number in numbers.items() if number is not None}
        return
    factor = getattr(material, "baseColorFactor", None)
    color = _diffuse(material) if factor is None else factor
    if color is not None:
        mesh["color"] = np.asarray(color)
    if hasattr(material, "metallicFactor"):
        # Missing factors are 1 in glTF.
        metallic, roughness = material.metallicFactor, material.roughnessFactor
        mesh["metallic"] = 1.0 if metallic is None else float(metallic)
        mesh["roughness"] = 1.0 if roughness is None else float(roughness)
        mesh["double_sided"] = bool(material.doubleSided)


def _is_placeholder(image: Any) -> bool:
    """Whether the image is trimesh's placeholder: four texels of one color."""
    return image.size == (2, 2) and image.getcolors(1) is not None


def _diffuse(material: Any) -> Any:
    """Return the diffuse color of a simple material; None for trimesh's default color."""
    color = getattr(material, "diffuse", None)
    if color is None or list(color) == [102, 102, 102, 255]:
        return None
    return color


def _numbers(value: Any) -> Any:
    """Return one or more numbers from an MTL key; None if they are not valid numbers."""
    import numpy as np

    try:
        numbers = np.asarray(value, dtype=float).ravel()
    except (TypeError, ValueError):
        return None
    if numbers.size == 0 or not np.isfinite(numbers).all():
        return None
    return float(numbers[0]) if numbers.size == 1 else numbers


_MTL_KEYS = ("kd", "ks", "ns", "illum", "d", "tr")
