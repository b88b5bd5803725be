"""Frames: rendering results as arrays."""

from __future__ import annotations

import os
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

from . import _native
from ._camera import Camera
from ._errors import AlbertiError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


class Object(NamedTuple):
    """An object of a scene: an instance of a mesh."""

    #: The value in :attr:`Frame.object_ids`.
    id: int
    #: The model's value in :attr:`Frame.model_ids`.
    model_id: int
    #: The model's name.
    model: str
    #: The node's value in :attr:`Frame.node_ids`.
    node_id: int
    #: The node names from the root to the object's node, separated by slashes.
    path: str
    #: The mesh's value in :attr:`Frame.mesh_ids`.
    mesh_id: int
    #: The mesh's name.
    mesh: str | None
    #: The materials' values in :attr:`Frame.material_ids`; 0 is the default material.
    material_ids: tuple[int, ...]


class Frame:
    """A rendered picture and its passes, as arrays with the top row first.

    Each array is created only once. Accessing a pass that was not rendered raises
    :class:`AlbertiError`. Passes are also available by name: ``frame["depth"]``.
    """

    __slots__ = ("_arrays", "camera", "objects", "warnings")

    #: The camera used, with its position and the size of the frame.
    camera: Camera
    #: Warnings about missing parts; usually empty.
    warnings: tuple[str, ...]

    #: The objects of the scene, in the order of their ids, if an id pass was rendered.
    objects: tuple[Object, ...]

    def __init__(
        self,
        arrays: dict[str, Any],
        camera: _native.Camera,
        warnings: list[str],
        objects: tuple[Object, ...] = (),
    ) -> None:
        self._arrays: dict[str, NDArray[Any]] = arrays
        self.camera = Camera(camera)
        self.warnings = tuple(warnings)
        self.objects = objects

    @property
    def passes(self) -> tuple[str, ...]:
        """The rendered passes, by name."""
        return tuple("rgb" if name == "rgba" else name for name in self._arrays if name != "rgb")

    @property
    def size(self) -> tuple[int, int]:
        """Width and height in pixels."""
        size = self.camera.size
        assert size is not None
        return size

    @property
    def rgba(self) -> NDArray[np.uint8]:
        """Colors (height, width, 4), sRGB with straight alpha, as written by the program."""
        return self._pass("rgba", "rgb")

    @property
    def rgb(self) -> NDArray[np.uint8]:
        """Colors (height, width, 3), sRGB.

        A transparent background is replaced with white, in linear light.
        """
        if "rgb" not in self._arrays:
            self._arrays["rgb"] = _native.over_white(self.rgba)
        return self._arrays["rgb"]

    @property
    def depth(self) -> NDArray[np.float32]:
        """Depth (height, width) along the view axis, in scene units; inf for background."""
        return self._pass("depth")

    @property
    def distance(self) -> NDArray[np.float32]:
        """Distance (height, width) from the eye along the ray; inf for background.

        Computed from the depth if only the depth was rendered.
        """
        if "distance" not in self._arrays and "depth" in self._arrays:
            self._arrays["distance"] = self.camera._native.distances(self.depth)
        return self._pass("distance")

    @property
    def normal(self) -> NDArray[np.float32]:
        """World-space unit normals (height, width, 3) of the visible side; 0 for background."""
        return self._pass("normal")

    @property
    def view_normal(self) -> NDArray[np.float32]:
        """Unit normals in view space: x right, y up, z toward the viewer."""
        return self._pass("view_normal")

    @property
    def position(self) -> NDArray[np.float32]:
        """World-space positions (height, width, 3); 0 for background."""
        return self._pass("position")

    @property
    def uv(self) -> NDArray[np.float32]:
        """Texture coordinates (height, width, 2), with v down in the texture; 0 where missing."""
        return self._pass("uv")

    @property
    def barycentric(self) -> NDArray[np.float32]:
        """Barycentric weights (height, width, 3) of the triangle's vertices; their sum is 1."""
        return self._pass("barycentric")

    @property
    def coverage(self) -> NDArray[np.float32]:
        """Fraction (height, width) of each pixel's samples that a surface covers, 0 to 1."""
        return self._pass("coverage")

    @property
    def overdraw(self) -> NDArray[np.uint32]:
        """Number (height, width) of surfaces at each pixel's center, including hidden surfaces."""
        return self._pass("overdraw")

    @property
    def ids(self) -> NDArray[np.uint32]:
        """Triangle, point or line of each pixel, counted from 1 in scene order; 0 for background.

        For a model with one mesh, ``ids - 1`` is the row of ``faces``.
        """
        return self._pass("ids")

    @property
    def model_ids(self) -> NDArray[np.uint32]:
        """Model of each pixel, counted from 1 in scene order; 0 for background."""
        return self._pass("model_ids")

    @property
    def object_ids(self) -> NDArray[np.uint32]:
        """Object of each pixel: its index in :attr:`objects` plus 1; 0 for background.

        Every instance of a mesh is a separate object, so this is an instance segmentation.
        """
        return self._pass("object_ids")

    @property
    def node_ids(self) -> NDArray[np.uint32]:
        """Node of each pixel: its index in ``Model.nodes`` plus 1; 0 for background."""
        return self._pass("node_ids")

    @property
    def mesh_ids(self) -> NDArray[np.uint32]:
        """Mesh of each pixel: its index in ``Model.meshes`` plus 1; 0 for background."""
        return self._pass("mesh_ids")

    @property
    def material_ids(self) -> NDArray[np.uint32]:
        """Material of each pixel: its index in ``Model.materials`` plus 1.

        0 for background and for the default material.
        """
        return self._pass("material_ids")

    @property
    def mask(self) -> NDArray[np.bool_]:
        """Whether the center of each pixel (height, width) shows a surface.

        Requires a depth, distance, normal or id pass other than ``material_ids``.
        """
        import numpy as np

        hit: NDArray[np.bool_]
        for name in ("depth", "distance"):
            if name in self._arrays:
                hit = np.isfinite(self._arrays[name])
                return hit
        for name in ("ids", "object_ids", "node_ids", "model_ids", "mesh_ids", "overdraw"):
            if name in self._arrays:
                hit = np.greater(self._arrays[name], 0)
                return hit
        message = "the frame has no pass that distinguishes surfaces from the background"
        help = 'add one to the passes: passes=(…, "ids")'
        raise AlbertiError(message, "NO_SUCH_PASS", "mask", help)

    def points(self) -> NDArray[np.float64]:
        """Return the world points (N, 3) of all pixels with a finite depth, row by row."""
        import numpy as np

        depth = self.depth
        return self.camera.unproject(depth)[np.isfinite(depth)]

    def png(self) -> bytes:
        """Return the picture as the bytes of a PNG file, identical to the program's output."""
        return _native.encode_png(self.rgba)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the picture as a PNG file; the path must end in ``.png``."""
        ending = os.path.splitext(os.fspath(path))[1]
        if str(ending).lower() != ".png":
            help = "convert frame.rgb with a library such as Pillow for other formats"
            raise AlbertiError(f"ends in {ending!r}, expected .png", pointer="path", help=help)
        content = self.png()
        with open(path, "wb") as file:
            file.write(content)

    def _repr_png_(self) -> bytes | None:
        """Return the picture for Jupyter."""
        return self.png() if "rgba" in self._arrays else None

    def __getitem__(self, name: str) -> NDArray[Any]:
        """Return the array of a pass by name, such as ``rgb`` or ``depth``."""
        if name in ("rgb", "rgba", "distance"):
            array: NDArray[Any] = getattr(self, name)
            return array
        return self._pass(name)

    def __iter__(self) -> Iterator[str]:
        """Iterate over the rendered passes by name."""
        return iter(self.passes)

    def __reduce__(self) -> tuple[Any, ...]:
        return Frame._restore, (self._arrays, self.camera, self.warnings, self.objects)

    @staticmethod
    def _restore(arrays: Any, camera: Camera, warnings: Any, objects: Any) -> Frame:
        """Return a frame from the parts that were pickled."""
        return Frame(arrays, camera._native, warnings, objects)

    def __repr__(self) -> str:
        width, height = self.size
        return f"Frame({width} x {height}: {', '.join(self.passes)})"

    def _pass(self, name: str, asked: str | None = None) -> NDArray[Any]:
        """Return the array of a pass."""
        try:
            return self._arrays[name]
        except KeyError:
            asked = asked or name
            message = f"the frame has no {asked}"
            help = f'add it to the passes: passes=(…, "{asked}")'
            raise AlbertiError(message, "NO_SUCH_PASS", asked, help) from None
