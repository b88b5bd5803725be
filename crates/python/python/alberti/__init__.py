"""Pictures, depth, normals and ids of 3D models as NumPy arrays.

Renders on the CPU, without a display, a window or OpenGL. Results are bit-identical on every
machine.

>>> import alberti
>>> cube = alberti.Model.from_arrays(
...     [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
...     [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
... )
>>> frame = alberti.render(cube, size=(320, 240), passes=("rgb", "depth", "ids"))
>>> frame.rgb.shape, frame.depth.dtype, int(frame.ids.max()) <= 4
((240, 320, 3), dtype('float32'), True)
"""

from ._camera import Camera
from ._drawing import Drawing, draw
from ._errors import AlbertiError, AlbertiWarning, MissingFileError
from ._frame import Frame, Object
from ._lights import (
    AmbientLight,
    DirectionalLight,
    Environment,
    Light,
    ModelLights,
    PointLight,
    SpotLight,
)
from ._model import Animation, Model, Scene, load, load_scene
from ._native import __version__
from ._render import explain, render, render_each, render_many

__all__ = [
    "AlbertiError",
    "AlbertiWarning",
    "AmbientLight",
    "Animation",
    "Camera",
    "DirectionalLight",
    "Drawing",
    "Environment",
    "Frame",
    "Light",
    "MissingFileError",
    "Model",
    "ModelLights",
    "Object",
    "PointLight",
    "Scene",
    "SpotLight",
    "__version__",
    "draw",
    "explain",
    "load",
    "load_scene",
    "render",
    "render_each",
    "render_many",
]
