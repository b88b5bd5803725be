"""Models and scenes."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeVar, Union

from . import _native
from ._errors import AlbertiError, warn_all

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Source = Union[str, os.PathLike[str], bytes, bytearray, memoryview]


class Model:
    """A model: meshes with materials, in one pose.

    Create one with :func:`load`, :meth:`from_arrays` or :meth:`from_trimesh`. Models are immutable
    and can be rendered any number of times.
    """

    __slots__ = ("_native",)

    def __init__(self, native: _native.Subject) -> None:
        self._native = native

    @classmethod
    def from_arrays(
        cls,
        vertices: ArrayLike,
        faces: ArrayLike | Sequence[Sequence[int]] | None = None,
        *,
        normals: ArrayLike | None = None,
        colors: ArrayLike | None = None,
        uv: ArrayLike | None = None,
        texture: ArrayLike | bytes | None = None,
        color: str | ArrayLike | None = None,
        metallic: float | None = None,
        roughness: float | None = None,
        double_sided: bool = True,
        crease: float | None = None,
        up: str = "y",
        unit: str | None = None,
        name: str = "mesh",
        limits: Mapping[str, int] | None = None,
    ) -> Model:
        """Make a model from one mesh or a point cloud.

        Args:
            vertices: Positions (V, 3), any real dtype; converted to float32.
            faces: Indices (F, 3) of triangles or (F, n) of polygons, counterclockwise seen from
                outside; or a list of polygons with any number of corners; or None for points.
            normals: Normals (V, 3) of any length; without them, faces that meet at up to
                ``crease`` degrees are shaded smoothly.
            colors: sRGB colors of vertices (V, 3 or 4) or faces (F, 3 or 4): uint8, or floats
                from 0 to 1.
            uv: Texture coordinates (V, 2) with (0, 0) at the lower left, as in OBJ and trimesh.
            texture: sRGB image uint8 (height, width, 3 or 4), or the bytes of a PNG, JPEG or WebP
                file; requires ``uv``, and replaces ``colors``.
            color: Color of the whole surface: "#rrggbb", a CSS color name, or 3 or 4 sRGB channels
                as for ``colors``.
            metallic: Metalness from 0 to 1; 0 by default.
            roughness: Roughness from 0 to 1; 0.6 by default.
            double_sided: Whether back faces are drawn.
            crease: Angle in degrees, 0 to 180; 30 by default, 0 for flat faces.
            up: Up axis of the vertices, ``x``, ``y`` or ``z``; the model is rotated so that it
                becomes y.
            unit: Unit of length, for drawings to scale; meters by default.
            name: Name of the mesh.
            limits: Limits on sizes, by name; see :func:`load`.

        Raises:
            AlbertiError: For wrong shapes or dtypes, out-of-range indices, NaN, or data that
                exceeds the limits; ``pointer`` names the argument and the element.

        >>> triangle = Model.from_arrays([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        >>> triangle.triangle_count
        1
        """
        mesh = {
            "name": name,
            "vertices": vertices,
            "faces": faces,
            "normals": normals,
            "colors": colors,
            "uv": uv,
            "texture": texture,
            "color": color,
            "metallic": metallic,
            "roughness": roughness,
            "double_sided": double_sided,
        }
        options = {"crease": crease, "up": up, "unit": unit, "name": name, "limits": limits}
        return _warned(cls(_native.build_model([mesh], None, options)))

    @classmethod
    def from_trimesh(
        cls, scene: Any, *, up: str = "y", crease: float | None = None, unit: str | None = None
    ) -> Model:
        """Make a model from a ``trimesh.Trimesh``, ``Scene``, ``PointCloud`` or ``Path3D``.

        The model includes the transforms of the scene graph, normals if trimesh loaded them from a
        file, vertex and face colors, texture coordinates and materials.

        Args:
            scene: The object; trimesh itself is not imported here.
            up: Up axis; trimesh keeps file coordinates, so use ``z`` for STL and 3MF files.
            crease: As for :meth:`from_arrays`.
            unit: As for :meth:`from_arrays`.
        """
        from . import _trimesh

        meshes, nodes = _trimesh.collect_meshes(scene)
        options = {"crease": crease, "up": up, "unit": unit, "name": "scene"}
        return _warned(cls(_native.build_model(meshes, nodes, options)))

    @property
    def name(self) -> str:
        """The name of the file or of the mesh."""
        return self._native.name

    @property
    def bounds(self) -> NDArray[np.float64] | None:
        """Minimum and maximum corners (2, 3) of the bounding box; None if it is empty."""
        return self._native.bounds()

    @property
    def triangle_count(self) -> int:
        """Number of visible triangles."""
        return self._native.item_counts()[2]

    @property
    def nodes(self) -> list[str | None]:
        """Names of the nodes; ``Frame.node_ids - 1`` is an index into them."""
        return self._names("nodes")

    @property
    def meshes(self) -> list[str | None]:
        """Names of the meshes; ``Frame.mesh_ids - 1`` is an index into them."""
        return self._names("meshes")

    @property
    def materials(self) -> list[str | None]:
        """Names of the materials; ``Frame.material_ids - 1`` is an index into them."""
        return self._names("materials")

    @property
    def warnings(self) -> list[str]:
        """Warnings from loading: parts that were skipped or corrected."""
        return self._native.warnings()

    def _names(self, what: str) -> list[str | None]:
        return [name for model in self._native.part_names(what) for name in model]

    def _repr_png_(self) -> bytes:
        """Return a picture for Jupyter."""
        from ._render import render

        return render(self, size=(480, 360)).png()

    def __repr__(self) -> str:
        points, lines, triangles = self._native.item_counts()
        counts = ((points, "points"), (lines, "lines"), (triangles, "triangles"))
        parts = [f"{count} {what}" for count, what in counts if count]
        kind = type(self).__name__
        return f"{kind}({self.name!r}, {', '.join(parts) or 'empty'})"


class Scene(Model):
    """Placed models, or a scene file with cameras, lights, styles and overlays."""

    __slots__ = ()

    def __init__(
        self,
        models: Sequence[Model] | _native.Subject,
        poses: Sequence[ArrayLike] | ArrayLike | None = None,
    ) -> None:
        """Make a scene from models.

        Args:
            models: The models; the first has the id 1 in ``Frame.model_ids``.
            poses: Matrix (4, 4) from each model to the world; the identity by default.
        """
        if isinstance(models, _native.Subject):
            super().__init__(models)
            return
        import numpy as np

        models = list(models)
        try:
            placed = [np.eye(4)] * len(models) if poses is None else list(poses)  # type: ignore[arg-type]
        except TypeError:
            message = f"is {poses!r}, expected a (4, 4) matrix for each model"
            raise AlbertiError(message, pointer="poses") from None
        if len(placed) != len(models):
            message = f"{len(placed)} for {len(models)} models"
            raise AlbertiError(message, pointer="poses")
        for index, model in enumerate(models):
            if not isinstance(model, Model):
                message = f"is a {type(model).__name__}, expected a Model"
                raise AlbertiError(message, pointer=f"models[{index}]")
        parts = [(model._native, pose) for model, pose in zip(models, placed)]
        super().__init__(_native.compose(parts))


def load(
    source: Source,
    *,
    name: str = "model",
    up: str | None = None,
    unit: str | None = None,
    crease: float | None = None,
    scene: str | int | None = None,
    variant: str | int | None = None,
    animation: str | int | None = None,
    time: float | None = None,
    lenient: bool = False,
    limits: Mapping[str, int] | None = None,
) -> Model:
    """Load a model: glTF, GLB, STL, OBJ, PLY or 3MF.

    Args:
        source: Path of the file, or its content as bytes; bytes must not refer to other files.
        name: Name used in messages; a name such as ``part.obj`` also indicates the format.
        up: Up axis of the file; by default z for STL and 3MF, y for all others.
        unit: Unit of length, such as ``millimeter`` or ``meter``; by default the file's unit.
        crease: Maximum angle in degrees between faces that are shaded as one smooth surface if
            the file has no normals; 30 by default.
        scene: Scene of a glTF file, by name or index.
        variant: Material variant, by name or index.
        animation: Animation for the pose, by name or index; the first if only ``time`` is set.
        time: Time of the animation in seconds.
        lenient: Whether broken parts are skipped with a warning instead of causing an error.
        limits: Maximum accepted sizes, by name, such as ``{"array_bytes": 1 << 30}``:
            file_bytes, total_bytes, json_depth, json_values, array_bytes, array_growth,
            image_side, image_texels, nodes, node_depth, scene_items.

    Raises:
        AlbertiError: If the file cannot be read, violates its format, or exceeds a limit.

    Warns:
        AlbertiWarning: For parts that were skipped or corrected.
    """
    options = {
        "up": up,
        "unit": unit,
        "crease": crease,
        "scene": scene,
        "variant": variant,
        "animation": animation,
        "time": time,
        "lenient": lenient,
        "limits": limits,
    }
    content = _content(source)
    if isinstance(content, str) and content.lower().endswith(".ron"):
        help = "call load_scene(path)"
        raise AlbertiError("this is a scene file, not a model", pointer="source", help=help)
    return _warned(Model(_native.load_model(content, name, options)))


def load_scene(
    path: str | os.PathLike[str] | None = None,
    *,
    text: str | None = None,
    folder: str | os.PathLike[str] = "",
    limits: Mapping[str, int] | None = None,
) -> Scene:
    """Load a scene file (``.ron``) with its models, or a scene from text.

    Args:
        path: Path of the scene file.
        text: Scene text, instead of a path.
        folder: Folder to which paths in the text are relative.
        limits: As for :func:`load`.

    Raises:
        AlbertiError: If the scene has mistakes; the message locates each of them.
    """
    if (path is None) == (text is None):
        raise AlbertiError("expected exactly one of path and text", pointer="path")
    place = os.fspath(folder if path is None else path)
    return _warned(Scene(_native.load_scene(place, text, {"limits": limits})))


def _content(source: Source) -> str | bytes:
    """Return the path of a file, or its content."""
    if isinstance(source, (bytes, bytearray, memoryview)):
        return bytes(source)
    try:
        return os.fspath(source)
    except TypeError:
        message = f"is a {type(source).__name__}, expected a path or bytes"
        raise AlbertiError(message, pointer="source") from None


_AnyModel = TypeVar("_AnyModel", bound=Model)


def _warned(model: _AnyModel) -> _AnyModel:
    """Warn about everything that the importer reports."""
    warn_all(model.warnings)
    return model
