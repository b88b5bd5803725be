"""The shapes of MuJoCo's visual geoms, with the same vertices as in MuJoCo's own renderer."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]


class Shape(NamedTuple):
    """Triangles with separate corners: vertices (3 F, 3), and normals and coordinates of them."""

    vertices: Floats
    normals: Floats
    #: Texture coordinates (3 F, 2) with (0, 0) at the upper left; None if they are generated.
    uv: Floats | None = None
    #: Whether the vertices are the endpoints of line segments instead.
    is_lines: bool = False


class Placement(NamedTuple):
    """A part of a geom: its shape, and how the size of the geom scales and shifts it."""

    shape: str
    #: Matrix (3, 3): the scale along x, y and z as combinations of the three sizes.
    scale: tuple[tuple[float, float, float], ...]
    #: The shift along z as a combination of the three sizes.
    shift: tuple[float, float, float] = (0.0, 0.0, 0.0)
    #: Whether the part is turned by 180 degrees about x.
    is_turned: bool = False


_EACH = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
_DOME = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.5, 0.5, 0.0))
_UNIT = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))


def _arrow(radius: float, length: float) -> tuple[tuple[float, float, float], ...]:
    """Return the scale of a part of an arrow."""
    return ((radius, 0.0, 0.0), (0.0, radius, 0.0), (0.0, 0.0, length))


#: The parts of each type of geom, by the name of the type in ``mujoco.mjtGeom``.
PLACEMENTS: dict[str, tuple[Placement, ...]] = {
    "SPHERE": (Placement("sphere", _EACH),),
    "ELLIPSOID": (Placement("sphere", _EACH),),
    "BOX": (Placement("box", _EACH),),
    "CYLINDER": (Placement("cylinder", _EACH),),
    "CAPSULE": (
        Placement("tube", _EACH),
        Placement("dome", _DOME, (0.0, 0.0, 1.0)),
        Placement("dome", _DOME, (0.0, 0.0, -1.0), True),
    ),
    "ARROW": (
        Placement("cylinder", _arrow(1.0, 1 / 6), (0.0, 0.0, 1 / 6)),
        Placement("cone", _arrow(1.75, 1 / 6), (0.0, 0.0, 1 / 3)),
    ),
    "ARROW1": (
        Placement("cylinder", _arrow(1.0, 1 / 6), (0.0, 0.0, 1 / 6)),
        Placement("cone", _arrow(1.0, 1 / 6), (0.0, 0.0, 1 / 3)),
    ),
    "ARROW2": (
        Placement("tube", _arrow(1.0, 1 / 3)),
        Placement("cone", _arrow(1.75, 1 / 6), (0.0, 0.0, 1 / 3)),
        Placement("cone", _arrow(1.75, 1 / 6), (0.0, 0.0, -1 / 3), True),
    ),
    "TRIANGLE": (Placement("triangle", _EACH),),
    "LINE": (Placement("line", _EACH),),
    "LINEBOX": (Placement("frame", _EACH),),
    "PLANE": (Placement("plane", ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 0.0))),),
    # Vertices of these shapes already have their size.
    "MESH": (Placement("mesh", _UNIT),),
    "SDF": (Placement("mesh", _UNIT),),
    "HFIELD": (Placement("hfield", _UNIT),),
    "SKIN": (Placement("skin", _UNIT),),
    "FLEX": (Placement("flex", _UNIT),),
}


def unit_shape(name: str, slices: int, stacks: int) -> Shape:
    """Return a shape of size 1, with the subdivisions of ``vis.quality``."""
    half = max(stacks // 2, 1)
    if name == "sphere":
        rings = np.arange(-half, half + 1) * (0.5 * np.pi / half)
        return _revolve(np.cos(rings), np.sin(rings), np.cos(rings), np.sin(rings), slices)
    if name == "dome":
        rings = np.arange(half + 1) * (0.5 * np.pi / half)
        return _revolve(np.cos(rings), np.sin(rings), np.cos(rings), np.sin(rings), slices)
    if name == "tube":
        return _revolve([1, 1], [-1, 1], [1, 1], [0, 0], slices)
    if name == "cylinder":
        parts = [
            _revolve([0, 1], [-1, -1], [0, 0], [-1, -1], slices),
            _revolve([1, 1], [-1, 1], [1, 1], [0, 0], slices),
            _revolve([1, 0], [1, 1], [0, 0], [1, 1], slices),
        ]
        return _join(parts)
    if name == "cone":
        slope = np.sqrt(0.5)
        return _revolve([1, 0], [0, 1], [slope, slope], [slope, slope], slices)
    if name == "box":
        return _box()
    return _flat_shape(name)


def _revolve(radii: Any, heights: Any, across: Any, along: Any, slices: int) -> Shape:
    """Return a profile revolved about z; ``across`` and ``along`` are components of its normals."""
    angles = np.arange(slices + 1) * (2 * np.pi / slices)
    around = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    around[-1] = around[0]

    def grid(radii: Any, heights: Any) -> Floats:
        radii, heights = np.asarray(radii, float), np.asarray(heights, float)
        shape = (len(radii), slices + 1, 3)
        points = np.empty(shape)
        points[..., :2] = radii[:, None, None] * around
        points[..., 2] = heights[:, None]
        return points

    corners = _grid_corners(len(radii), slices + 1)
    points = grid(np.where(np.abs(radii) < 1e-12, 0, radii), heights).reshape(-1, 3)[corners]
    normals = grid(across, along).reshape(-1, 3)[corners]
    # Triangles at a pole have two equal corners.
    first, second, third = (points.reshape(-1, 3, 3)[:, corner] for corner in range(3))
    area = np.abs(np.cross(second - first, third - first)).sum(axis=1)
    kept = np.repeat(area > 1e-12, 3)
    return Shape(points[kept], normals[kept])


def _grid_corners(rows: int, columns: int) -> NDArray[np.int64]:
    """Return the corners of two triangles for each cell of a grid of vertices."""
    row, column = np.mgrid[0 : rows - 1, 0 : columns - 1]
    first = (row * columns + column).ravel()
    cells = [first, first + 1, first + columns + 1, first, first + columns + 1, first + columns]
    return np.stack(cells, axis=1).ravel()


def _box() -> Shape:
    """Return the cube from -1 to 1."""
    vertices, normals = [], []
    for axis in range(3):
        for side in (-1.0, 1.0):
            u, v = (axis + 1) % 3, (axis + 2) % 3
            corners = np.zeros((4, 3))
            corners[:, axis] = side
            corners[:, u] = [-1, 1, 1, -1]
            corners[:, v] = [-1, -1, 1, 1]
            if side < 0:
                corners = corners[::-1]
            normal = np.zeros(3)
            normal[axis] = side
            vertices.append(corners[[0, 1, 2, 0, 2, 3]])
            normals.append(np.tile(normal, (6, 1)))
    return Shape(np.concatenate(vertices), np.concatenate(normals))


def _flat_shape(name: str) -> Shape:
    """Return a plane, a triangle, a line or the edges of a box."""
    if name == "plane":
        square = np.array([[-1.0, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
        return Shape(square[[0, 1, 2, 0, 2, 3]], np.tile([0.0, 0, 1], (6, 1)))
    if name == "triangle":
        corners = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
        return Shape(corners, np.tile([0.0, 0, 1], (3, 1)))
    if name == "line":
        ends = np.array([[0.0, 0, 0], [0, 0, 1]])
        return Shape(ends, np.zeros((2, 3)), None, True)
    corners = np.array([[x, y, z] for x in (-1.0, 1) for y in (-1.0, 1) for z in (-1.0, 1)])
    pairs = [(a, b) for a in range(8) for b in range(a) if bin(a ^ b).count("1") == 1]
    ends = corners[np.array(pairs).ravel()]
    return Shape(ends, np.zeros((len(ends), 3)), None, True)


def mesh_shape(model: Any, dataid: int) -> Shape:
    """Return a mesh of the model, or for an odd number its convex hull."""
    mesh = dataid // 2
    start = model.mesh_vertadr[mesh]
    vertices = model.mesh_vert[start : start + model.mesh_vertnum[mesh]].astype(float)
    coordinates = model.mesh_texcoordadr[mesh]
    if dataid % 2 and model.mesh_graphadr[mesh] >= 0:
        graph = model.mesh_graph[model.mesh_graphadr[mesh] :]
        count, faces = graph[0], graph[1]
        begin = 2 + 3 * count + 3 * faces
        corners = vertices[graph[begin : begin + 3 * faces]]
        return Shape(corners, np.repeat(_face_normals(corners), 3, axis=0))
    rows = slice(model.mesh_faceadr[mesh], model.mesh_faceadr[mesh] + model.mesh_facenum[mesh])
    corners = vertices[model.mesh_face[rows].ravel()]
    normals = model.mesh_normal[
        model.mesh_facenormal[rows].ravel() + model.mesh_normaladr[mesh]
    ].astype(float)
    if coordinates >= 0:
        texcoord = model.mesh_texcoord[model.mesh_facetexcoord[rows].ravel() + coordinates]
        return Shape(corners, normals, texcoord.astype(float))
    # MuJoCo does not smooth over edges of more than about 37 degrees.
    faces = np.repeat(_face_normals(corners), 3, axis=0)
    is_sharp = (faces * normals).sum(axis=1) < 0.8
    return Shape(corners, np.where(is_sharp[:, None], faces, normals))


def height_field_shape(model: Any, index: int) -> Shape:
    """Return a height field with its sides and bottom."""
    rows, columns = model.hfield_nrow[index], model.hfield_ncol[index]
    start = model.hfield_adr[index]
    heights = model.hfield_data[start : start + rows * columns].reshape(rows, columns)
    x_size, y_size, z_size, depth = model.hfield_size[index]
    x, y = np.linspace(-x_size, x_size, columns), np.linspace(-y_size, y_size, rows)
    top = np.empty((rows, columns, 3))
    top[..., 0], top[..., 1], top[..., 2] = x, y[:, None], heights * z_size
    below = top.copy()
    below[..., 2] = -depth
    walls = [
        np.stack([below[0], top[0]]),
        np.stack([top[-1], below[-1]]),
        np.stack([top[:, 0], below[:, 0]]),
        np.stack([below[:, -1], top[:, -1]]),
        below[::-1][:: max(rows - 1, 1), :: max(columns - 1, 1)],
    ]
    corners = [
        face.reshape(-1, 3)[_grid_corners(face.shape[0], face.shape[1])] for face in [top, *walls]
    ]
    vertices = np.concatenate(corners)
    return Shape(vertices, np.repeat(_face_normals(vertices), 3, axis=0))


def _face_normals(corners: Floats) -> Floats:
    """Return a unit normal for every three corners; z for triangles without area."""
    first, second, third = (corners.reshape(-1, 3, 3)[:, corner] for corner in range(3))
    normals = np.cross(second - first, third - first)
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    return np.where(lengths > 0, normals / np.where(lengths > 0, lengths, 1), [0.0, 0, 1])


def skin_shape(model: Any, scene: Any, index: int) -> Shape:
    """Return a skin in its current pose."""
    first, count = scene.skinvertadr[index], scene.skinvertnum[index]
    vertices = scene.skinvert.reshape(-1, 3)[first : first + count]
    normals = scene.skinnormal.reshape(-1, 3)[first : first + count]
    begin = model.skin_faceadr[index]
    corners = model.skin_face[begin : begin + model.skin_facenum[index]].ravel()
    uv = None
    if model.skin_texcoordadr[index] >= 0:
        start = model.skin_texcoordadr[index]
        uv = model.skin_texcoord[start : start + count][corners].astype(float)
    return Shape(vertices[corners].astype(float), normals[corners].astype(float), uv)


def flex_shape(scene: Any, geom: Any, tube: Shape, ball: Shape) -> Shape | None:
    """Return a flexible body: its faces, or the tubes and balls at its edges and vertices."""
    index, radius = geom.objid, float(geom.size[0])
    used = scene.flexfaceused[index]
    parts: list[Shape] = []
    if radius > 0 and not (scene.flexskinopt and used):
        first = scene.flexvertadr[index]
        vertices = scene.flexvert.reshape(-1, 3)[first : first + scene.flexvertnum[index]]
        if scene.flexvertopt:
            parts += [Shape(ball.vertices * radius + at, ball.normals) for at in vertices]
        if scene.flexedgeopt:
            begin = scene.flexedgeadr[index]
            edges = scene.flexedge.reshape(-1, 2)[begin : begin + scene.flexedgenum[index]]
            ends = vertices[edges].astype(float)
            parts += [_tube_between(tube, start, end, radius) for start, end in ends]
    uv = None
    if used:
        begin = 3 * scene.flexfaceadr[index]
        rows = slice(begin, begin + 3 * used)
        vertices = scene.flexface.reshape(-1, 3)[rows].astype(float)
        normals = scene.flexnormal.reshape(-1, 3)[rows].astype(float)
        parts.append(Shape(vertices, normals))
        if geom.texcoord:
            uv = np.zeros((sum(len(part.vertices) for part in parts), 2))
            uv[-len(vertices) :] = scene.flextexcoord.reshape(-1, 2)[rows]
    if not parts:
        return None
    return _join(parts)._replace(uv=uv)


def _join(parts: list[Shape]) -> Shape:
    """Return several shapes as one, without texture coordinates."""
    vertices = np.concatenate([part.vertices for part in parts])
    return Shape(vertices, np.concatenate([part.normals for part in parts]))


def _tube_between(tube: Shape, start: Floats, end: Floats, radius: float) -> Shape:
    """Return an open cylinder between two points."""
    axis = end - start
    length = float(np.linalg.norm(axis)) or 1e-12
    axis = axis / length
    helper = np.array([1.0, 0, 0]) if abs(axis[0]) < 0.9 else np.array([0.0, 1, 0])
    across = np.cross(axis, helper)
    across /= np.linalg.norm(across)
    basis = np.stack([across, np.cross(axis, across), axis])
    scaled = tube.vertices * [radius, radius, length / 2]
    return Shape(scaled @ basis + (start + end) / 2, tube.normals @ basis)
