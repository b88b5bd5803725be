"""Pictures as observations of Gymnasium environments that simulate with MuJoCo.

    import gymnasium
    from gymnasium.wrappers import AddRenderObservation
    from alberti.gym import wrap

    environment = AddRenderObservation(wrap(gymnasium.make("Hopper-v5"), height=84, width=84))

Requires the packages ``gymnasium`` and ``mujoco``.
"""

from __future__ import annotations

from functools import lru_cache
from importlib import import_module
from typing import Any

from ._errors import AlbertiError

__all__ = ["wrap"]


def wrap(
    environment: Any,
    *,
    height: int = 480,
    width: int = 480,
    camera: int | str | None = None,
    **options: Any,
) -> Any:
    """Return an environment whose ``render`` returns colors, as with ``rgb_array``.

    Make the environment without a ``render_mode``, so that nothing needs OpenGL.

    Args:
        environment: A Gymnasium environment with the attributes ``model`` and ``data`` of MuJoCo.
        height: Height of the pictures in pixels.
        width: Width of the pictures in pixels.
        camera: Name or number of a camera in the model; by default the free camera, with the
            environment's own settings of it.
        options: Further options of :class:`alberti.mujoco.Renderer`.

    Raises:
        AlbertiError: If Gymnasium is missing, or the environment has no model.
    """
    inner = environment.unwrapped
    if not hasattr(inner, "model") or not hasattr(inner, "data"):
        message = f"{type(inner).__name__} has no MuJoCo model and data"
        raise AlbertiError(message, pointer="environment")
    options.update(height=height, width=width)
    return _wrapper_class()(environment, camera, options)


@lru_cache(1)
def _wrapper_class() -> Any:
    """Return the wrapper, whose base class is known only with Gymnasium."""
    try:
        gymnasium = import_module("gymnasium")
    except ImportError:
        message, help = "the package gymnasium is not installed", "pip install gymnasium"
        raise AlbertiError(message, "MISSING_PACKAGE", "gymnasium", help) from None
    base: Any = gymnasium.Wrapper

    class RenderWithAlberti(base):  # type: ignore[misc]
        """An environment that alberti renders."""

        def __init__(self, environment: Any, camera: Any, options: dict[str, Any]) -> None:
            super().__init__(environment)
            self._camera, self._options = camera, options
            self._renderer: Any = None

        @property
        def render_mode(self) -> str:
            """The mode that Gymnasium's own wrappers look for."""
            return "rgb_array"

        def render(self) -> Any:
            """Return the colors (height, width, 3) of the current state."""
            from .mujoco import Renderer

            inner = self.env.unwrapped
            if self._renderer is None or self._renderer.model is not inner.model:
                self._renderer = Renderer(inner.model, **self._options)
            camera = _free_camera(inner) if self._camera is None else self._camera
            self._renderer.update_scene(inner.data, camera)
            return self._renderer.render()

        def close(self) -> None:
            """Free the renderer, and close the environment."""
            self._renderer = None
            super().close()

    return RenderWithAlberti


def _free_camera(inner: Any) -> Any:
    """Return Gymnasium's free camera: around the middle of the geoms, with its own settings."""
    import numpy as np

    mujoco = import_module("mujoco")
    camera = mujoco.MjvCamera()
    camera.type = int(mujoco.mjtCamera.mjCAMERA_FREE)
    camera.fixedcamid = -1
    camera.lookat[:] = np.median(inner.data.geom_xpos, axis=0)
    camera.distance = inner.model.stat.extent
    settings = getattr(getattr(inner, "mujoco_renderer", None), "default_cam_config", None)
    for name, value in (settings or {}).items():
        if isinstance(value, np.ndarray):
            getattr(camera, name)[:] = value
        else:
            setattr(camera, name, value)
    return camera
