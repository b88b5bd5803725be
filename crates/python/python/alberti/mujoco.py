"""A renderer for MuJoCo with the interface of ``mujoco.Renderer``, without OpenGL.

    import mujoco
    from alberti.mujoco import Renderer

    with Renderer(model, height=240, width=320) as renderer:
        renderer.update_scene(data, camera="overview")
        pixels = renderer.render()

Requires the package ``mujoco``, version 3 or later: ``pip install alberti[mujoco]``.
"""

from __future__ import annotations

import warnings
from importlib import import_module
from typing import TYPE_CHECKING, Any, Literal, Union

from ._errors import AlbertiError, AlbertiWarning

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ._mujoco_scene import Stage

    Camera = Union[int, str, Any]

__all__ = ["Renderer"]


class Renderer:
    """Renders scenes of a MuJoCo model.

    It has the same methods as ``mujoco.Renderer``. Its pictures are the same on every machine, and
    any number of renderers can work in any number of threads and processes.

    What differs: lighting is computed per pixel, highlights are similar rather than equal, surfaces
    do not mirror each other, labels and the frame of the picture are not drawn, and pictures may
    be larger than the model's offscreen buffer. Meshes, height fields, materials and textures of
    the model are read when they are first drawn; after changing them, make a new renderer.
    """

    def __init__(
        self,
        model: Any,
        height: int = 240,
        width: int = 320,
        max_geom: int = 10000,
        font_scale: Any = None,
        *,
        samples: Literal[1, 4, 8, 16] = 4,
        shadow_degrees: float = 0.0,
        threads: int | None = 1,
    ) -> None:
        """Make a renderer.

        Args:
            model: A ``mujoco.MjModel``.
            height: Height of the pictures in pixels.
            width: Width of the pictures in pixels.
            max_geom: Maximum number of geoms in a scene.
            font_scale: Not used; there are no labels.
            samples: Samples per pixel for anti-aliasing: 1, 4, 8 or 16.
            shadow_degrees: Angle that lights subtend, from 0 to 30 degrees; larger angles make
                shadows softer.
            threads: Maximum number of threads, or None for one per processor.

        Raises:
            AlbertiError: If the package mujoco is missing, or an argument is invalid.
        """
        mujoco = _import_mujoco()
        from ._mujoco_scene import Stage

        for name, side in (("height", height), ("width", width)):
            if side < 1:
                raise AlbertiError(f"is {side}, expected 1 or more", pointer=name)
        self._mujoco = mujoco
        self._model = model
        self._height, self._width = int(height), int(width)
        self._scene = mujoco.MjvScene(model, maxgeom=max_geom)
        self._scene_option = mujoco.MjvOption()
        options = {"samples": samples, "softness": shadow_degrees, "threads": threads}
        self._stage: Stage | None = Stage(mujoco, model, self._scene, options)
        self._mode = "rgb"

    @property
    def model(self) -> Any:
        """The ``mujoco.MjModel``."""
        return self._model

    @property
    def scene(self) -> Any:
        """The ``mujoco.MjvScene``; geoms and lights may be added and changed before rendering."""
        return self._scene

    @property
    def height(self) -> int:
        """The height of the pictures in pixels."""
        return self._height

    @property
    def width(self) -> int:
        """The width of the pictures in pixels."""
        return self._width

    def enable_depth_rendering(self) -> None:
        """Make :meth:`render` return depth along the view axis, in meters."""
        self._mode = "depth"

    def disable_depth_rendering(self) -> None:
        """Make :meth:`render` return colors instead of depth."""
        if self._mode == "depth":
            self._mode = "rgb"

    def enable_segmentation_rendering(self) -> None:
        """Make :meth:`render` return the id and the type of the object at each pixel."""
        self._mode = "segmentation"

    def disable_segmentation_rendering(self) -> None:
        """Make :meth:`render` return colors instead of ids."""
        if self._mode == "segmentation":
            self._mode = "rgb"

    def update_scene(self, data: Any, camera: Camera = -1, scene_option: Any = None) -> None:
        """Update the scene to the state in ``data``.

        Args:
            data: A ``mujoco.MjData``.
            camera: Name or number of a camera in the model, -1 for the free camera, or a
                ``mujoco.MjvCamera``.
            scene_option: A ``mujoco.MjvOption``, such as for the groups of geoms to show.

        Raises:
            ValueError: If there is no such camera.
        """
        mujoco = self._mujoco
        if not isinstance(camera, mujoco.MjvCamera):
            camera = self._find_camera(camera)
        mujoco.mjv_updateScene(
            self._model,
            data,
            scene_option or self._scene_option,
            None,
            camera,
            int(mujoco.mjtCatBit.mjCAT_ALL),
            self._scene,
        )

    def _find_camera(self, camera: int | str) -> Any:
        """Return a camera by its name or number."""
        mujoco = self._mujoco
        number = camera
        if isinstance(number, str):
            number = mujoco.mj_name2id(self._model, int(mujoco.mjtObj.mjOBJ_CAMERA), number)
            if number == -1:
                raise ValueError(f'The camera "{camera}" does not exist.')
        if number < -1 or number >= self._model.ncam:
            raise ValueError(
                f"The camera id {number} is out of range [-1, {self._model.ncam})."
            )
        found = mujoco.MjvCamera()
        found.fixedcamid = number
        if number == -1:
            found.type = int(mujoco.mjtCamera.mjCAMERA_FREE)
            mujoco.mjv_defaultFreeCamera(self._model, found)
        else:
            found.type = int(mujoco.mjtCamera.mjCAMERA_FIXED)
        return found

    def render(self, *, out: NDArray[Any] | None = None) -> NDArray[Any]:
        """Render the scene.

        Args:
            out: Array for the result, of the same shape; elements are cast if necessary.

        Returns:
            ``out``, or a new array: colors (height, width, 3) as uint8; depth (height, width) as
            float32, which is the distance of the far plane in the background; or the id and the
            ``mujoco.mjtObj`` of each pixel (height, width, 2) as int32, -1 in the background.

        Raises:
            RuntimeError: After :meth:`close`.
            ValueError: If ``out`` has another shape.
        """
        import numpy as np

        if self._stage is None:
            raise RuntimeError("render cannot be called after close.")
        channels: tuple[int, ...] = {"rgb": (3,), "depth": (), "segmentation": (2,)}[self._mode]
        shape = (self._height, self._width, *channels)
        if out is not None and out.shape != shape:
            raise ValueError(f"Expected `out.shape == {shape}`. Got `out.shape={out.shape}`")
        size = (self._width, self._height)
        pixels: NDArray[Any] = getattr(self._stage, self._mode)(size)
        for text in self._stage.take_notes():
            warnings.warn(AlbertiWarning(text), stacklevel=2)
        if out is None:
            return pixels
        np.copyto(out, pixels, casting="unsafe")
        return out

    def close(self) -> None:
        """Free the memory for meshes and textures. The renderer cannot be used afterward."""
        self._stage = None

    def __enter__(self) -> Renderer:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()


def _import_mujoco() -> Any:
    """Import the package mujoco."""
    try:
        return import_module("mujoco")
    except ImportError:
        help = "pip install alberti[mujoco]"
        message = "the package mujoco is not installed"
        raise AlbertiError(message, "MISSING_PACKAGE", "mujoco", help) from None
