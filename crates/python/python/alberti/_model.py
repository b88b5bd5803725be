"""Models and scenes."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import IO, TYPE_CHECKING, Any, NamedTuple, TypeVar, Union

from . import _native
from ._errors import AlbertiError, MissingFileError, warn_all
from ._frame import Object

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Source = Union[str, os.PathLike[str], bytes, bytearray, memoryview, IO[bytes]]


class Animation(NamedTuple):
    """An animation of a model."""

    #: The name, if the file has one.
    name: str | None
    #: The time of the last keyframe in seconds.
    duration: float


class Model:
    """A model: meshes with materials, in one pose.

    Create one with :func:`load`, :meth:`from_arrays` or :meth:`from_trimesh`. Models are immutable
    and can be rendered any number of times. They can be pickled: a model from a file is loaded
    again from the same path, and any other takes its arrays along.
    """

    __slots__ = ("_arrays", "_native", "_objects", "_origin")

    def __init__(
        self,
        native: _native.Subject | None = None,
        origin: tuple[str, tuple[Any, ...]] | None = None,
    ) -> None:
        if not isinstance(native, _native.Subject):
            help = "call load(path), Model.from_arrays(…) or Model.from_trimesh(…)"
            raise AlbertiError("models are not created directly", pointer="Model", help=help)
        self._native = native
        #: The function in this module that makes the same model, and its arguments.
        self._origin = origin
        self._arrays: tuple[NDArray[np.float64], NDArray[np.uint32]] | None = None
        self._objects: tuple[Object, ...] | None = None

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
        return _build([mesh], None, options)

    @classmethod
    def from_trimesh(
        cls, scene: Any, *, up: str = "y", crease: float | None = None, unit: str | None = None
    ) -> Model:
        """Make a model from a ``trimesh.Trimesh``, ``Scene``, ``PointCloud`` or ``Path3D``.

        The model includes the transforms of the scene graph, normals if trimesh loaded them from a
        file, vertex and face colors, texture coordinates and materials. Lights and cameras of the
        scene are not part of a model; pass ``lights`` and ``camera`` to :func:`alberti.render`.

        Args:
            scene: The object; trimesh itself is not imported here.
            up: Up axis; trimesh keeps file coordinates, so use ``z`` for STL and 3MF files.
            crease: As for :meth:`from_arrays`.
            unit: As for :meth:`from_arrays`.

        Warns:
            AlbertiWarning: If the scene has lights.
        """
        from . import _trimesh

        meshes, nodes = _trimesh.collect_meshes(scene)
        if getattr(scene, "_lights", None):
            warn_all(["the lights of the trimesh scene are not used; pass lights to render()"])
        options = {"crease": crease, "up": up, "unit": unit, "name": "scene"}
        return _build(meshes, nodes, options)

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
    def vertices(self) -> NDArray[np.float64]:
        """World positions (V, 3) of the vertices of all visible meshes, in this pose."""
        return self._mesh_arrays()[0]

    @property
    def faces(self) -> NDArray[np.uint32]:
        """Indices (F, 3) into :attr:`vertices`; ``Frame.ids - 1`` is a row of them.

        Lines and points also have a row, which repeats their last index.
        """
        return self._mesh_arrays()[1]

    @property
    def objects(self) -> tuple[Object, ...]:
        """The objects, that is, mesh instances; ``Frame.object_ids - 1`` is an index into them.

        >>> triangle = Model.from_arrays([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], name="a")
        >>> [(object.id, object.model_id, object.path) for object in Scene([triangle] * 2).objects]
        [(1, 1, 'a'), (2, 2, 'a')]
        """
        if self._objects is None:
            self._objects = tuple(
                Object(id, *model, node, "/".join(name or "" for name in path), *mesh, tuple(parts))
                for id, (model, (node, path), mesh, parts) in enumerate(self._native.objects(), 1)
            )
        return self._objects

    @property
    def nodes(self) -> list[str | None]:
        """Names of the nodes; ``Frame.node_ids - 1`` is an index into them.

        In a scene, each copy of a model has separate nodes.
        """
        return self._native.part_names("nodes")

    @property
    def meshes(self) -> list[str | None]:
        """Names of the meshes; ``Frame.mesh_ids - 1`` is an index into them.

        In a scene, copies of a model share its meshes and materials.
        """
        return self._native.part_names("meshes")

    @property
    def materials(self) -> list[str | None]:
        """Names of the materials; ``Frame.material_ids - 1`` is an index into them."""
        return self._native.part_names("materials")

    @property
    def animations(self) -> list[Animation]:
        """The animations, for :meth:`posed`."""
        return [Animation(*animation) for animation in _native.animations(self._native)]

    @property
    def variants(self) -> list[str]:
        """Names of the material variants, for :func:`load`."""
        return _native.variants(self._native)

    def posed(self, animation: str | int | None = None, time: float = 0.0) -> Model:
        """Return the model in the pose of an animation, without loading it again.

        Args:
            animation: Name or index; the first animation by default.
            time: Time in seconds.
        """
        return _pose(self, animation, time)

    @property
    def warnings(self) -> list[str]:
        """Warnings from loading: parts that were skipped or corrected."""
        return self._native.warnings()

    def _mesh_arrays(self) -> tuple[NDArray[np.float64], NDArray[np.uint32]]:
        """Return the vertices and faces, computed on first use."""
        if self._arrays is None:
            self._arrays = _native.mesh_arrays(self._native)
        return self._arrays

    def __reduce__(self) -> tuple[Any, ...]:
        if self._origin is None:
            raise AlbertiError("this model cannot be pickled", pointer="model")
        name, arguments = self._origin
        return _make_again, (name, arguments)

    def __copy__(self: _AnyModel) -> _AnyModel:
        return self

    def __deepcopy__(self: _AnyModel, memo: object) -> _AnyModel:
        return self

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

        Warns:
            AlbertiWarning: If a part is a scene file with lights, a camera or other settings,
                which do not become part of the new scene.
        """
        if isinstance(models, _native.Subject):
            super().__init__(models)
            return
        import numpy as np

        if isinstance(models, Model):
            raise AlbertiError("is one model, expected a list of models", pointer="models")
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
        lost = [
            f"models[{index}]: only the scene's models are used, not its {', '.join(settings)}"
            for index, model in enumerate(models)
            if (settings := model._native.scene_settings())
        ]
        warn_all(lost, stacklevel=2)
        native = _native.compose(parts)
        super().__init__(native, ("Scene", (models, [np.array(pose) for pose in placed])))


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
        source: Path of the file, or its content as bytes or an open binary file; such content
            must not refer to other files.
        name: Name used in messages; a name such as ``part.obj`` also indicates the format.
        up: Up axis of the file; the model is rotated so that it becomes y. By default, coordinates
            stay as in the file. Use ``z`` for STL and 3MF files; the command-line program does so by
            default.
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
        MissingFileError: If there is no such file; also a ``FileNotFoundError``.
        AlbertiError: If the file cannot be read, violates its format, or exceeds a limit.

    Warns:
        AlbertiWarning: For parts that were skipped or corrected.
    """
    options = {
        "up": "y" if up is None else up,
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
    return _load(content, name, options)


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
    if path is not None and not os.path.exists(place):
        raise MissingFileError(place)
    return _load_scene(os.path.abspath(place), text, {"limits": limits})


def _content(source: Source) -> str | bytes:
    """Return the absolute path of a file, or its content."""
    if isinstance(source, (bytes, bytearray, memoryview)):
        return bytes(source)
    if hasattr(source, "read"):
        content = source.read()
        if not isinstance(content, bytes):
            message = "is a text file, expected a file opened in binary mode"
            raise AlbertiError(message, pointer="source", help='call open(path, "rb")')
        return content
    try:
        path = os.fspath(source)
    except TypeError:
        message = f"is a {type(source).__name__}, expected a path, bytes or a binary file"
        raise AlbertiError(message, pointer="source") from None
    if not os.path.exists(path):
        raise MissingFileError(path)
    return path


_AnyModel = TypeVar("_AnyModel", bound=Model)


def _warned(model: _AnyModel) -> _AnyModel:
    """Warn about everything that the importer reports."""
    warn_all(model.warnings, stacklevel=4)
    return model


def _load(content: str | bytes, name: str, options: dict[str, Any]) -> Model:
    """Load a model. A pickled model finds its file by its absolute path."""
    lasting = os.path.abspath(content) if isinstance(content, str) else content
    native = _native.load_model(content, name, options)
    return _warned(Model(native, ("_load", (lasting, name, options))))


def _load_scene(place: str, text: str | None, options: dict[str, Any]) -> Scene:
    """Load a scene from a file, or from text with a folder."""
    scene = Scene(_native.load_scene(place, text, options))
    scene._origin = ("_load_scene", (place, text, options))
    return _warned(scene)


def _build(meshes: list[dict[str, Any]], nodes: Any, options: dict[str, Any]) -> Model:
    """Make a model from arrays, and keep copies of them for pickling."""
    native = _native.build_model(meshes, nodes, options)
    kept = [{name: _kept(value) for name, value in mesh.items()} for mesh in meshes]
    return _warned(Model(native, ("_build", (kept, nodes, options))))


def _pose(model: Model, animation: str | int | None, time: float) -> Model:
    """Pose a model."""
    native = _native.pose(model._native, {"animation": animation, "time": time})
    return Model(native, ("_pose", (model, animation, time)))


def _make_again(name: str, arguments: tuple[Any, ...]) -> Model:
    """Make a pickled model by calling the function that made it."""
    model: Model = globals()[name](*arguments)
    return model


def _kept(value: Any) -> Any:
    """Return a copy of an array, which its owner may change later."""
    import numpy as np

    if value is None or isinstance(value, (str, bytes, int, float, dict)):
        return value
    try:
        return np.array(value)
    except ValueError:
        return [list(row) for row in value]
