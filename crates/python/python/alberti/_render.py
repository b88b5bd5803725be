"""Render one picture or many, and explain how points become pixels."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Union

from . import _native
from ._camera import Camera
from ._errors import AlbertiError, warn_all
from ._frame import Frame
from ._model import Model

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    Size = tuple[int, int]
    Passes = Union[str, Sequence[str]]


def render(
    model: Model,
    *,
    camera: Camera | str | None = None,
    size: Size | None = None,
    passes: Passes = ("rgb",),
    style: str | None = None,
    background: str | None = None,
    samples: int | None = None,
    threads: int | None = None,
) -> Frame:
    """Render a model or a scene.

    The picture is bit-identical to the output of the command ``alberti render`` with the same
    options, with any number of threads. Other Python threads keep running during the call, and
    Ctrl+C cancels it.

    Args:
        model: A :class:`Model` or a :class:`Scene`; or a trimesh object, which is converted.
        camera: A :class:`Camera`, or the name of a direction from which to frame the model, as for
            ``Camera.frame``. By default the scene's camera, otherwise a three-quarter view.
        size: ``(width, height)`` in pixels; by default the camera's size, otherwise the scene's,
            otherwise (960, 720).
        passes: Names of the passes to render: ``rgb`` (or ``rgba``), ``depth``, ``distance``,
            ``normal``, ``view_normal``, ``position``, ``uv``, ``barycentric``, ``ids``,
            ``model_ids``, ``node_ids``, ``mesh_ids``, ``material_ids``, ``overdraw``,
            ``coverage``. All except the first describe the surface at the center of each pixel.
        style: ``shaded``, ``flat``, ``gouraud``, ``clay``, ``matcap``, ``normals``, ``depth``,
            ``uv``, ``ids``, ``toon``, ``x-ray``, ``wireframe``, ``lines``, ``dashed``,
            ``silhouette``, ``outline``, ``technical``, ``patent``, ``blueprint``, ``sketch`` or
            ``depth-cued``.
        background: ``transparent``, ``#rrggbb``, or a CSS color name.
        samples: Samples per pixel for anti-aliasing: 1, 4, 8 or 16; 4 by default.
        threads: Maximum number of threads; by default one per processor.

    Raises:
        AlbertiError: If an argument is invalid, or the picture is too large for memory.

    Warns:
        AlbertiWarning: For missing parts of the picture.

    >>> model = Model.from_arrays([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> camera = Camera.look_at((0.3, 0.3, 2), (0.3, 0.3, 0))
    >>> frame = render(model, camera=camera, size=(64, 48), passes=("rgb", "depth"))
    >>> float(frame.depth.min()), float(frame.depth[0, 0])
    (2.0, inf)
    """
    options = {
        "camera": camera,
        "size": size,
        "passes": passes,
        "style": style,
        "background": background,
        "samples": samples,
        "threads": threads,
    }
    subject, options = _job(model, options)
    frame = Frame(*_native.render(subject, options))
    warn_all(frame.warnings)
    return frame


def render_many(jobs: Iterable[Mapping[str, Any]], *, threads: int | None = None) -> list[Frame]:
    """Render many pictures in parallel, one per thread.

    Args:
        jobs: The arguments of :func:`render` for each picture, as dictionaries with ``model``.
        threads: Maximum number of threads; by default one per processor.

    Returns:
        The frames, in the order of the jobs. All are kept in memory, so render very large numbers
        of views in batches.

    Raises:
        AlbertiError: For the first job that fails; ``pointer`` contains its index.

    >>> model = Model.from_arrays([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> views = [{"model": model, "camera": view, "size": (32, 32)} for view in ("front", "back")]
    >>> [frame.size for frame in render_many(views)]
    [(32, 32), (32, 32)]
    """
    known = {"model", "camera", "size", "passes", "style", "background", "samples"}
    read = []
    for number, job in enumerate(jobs):
        options: dict[str, Any] = dict(job)
        unknown = sorted(set(options) - known)
        if unknown or "model" not in options:
            wrong = f"has no argument {unknown[0]!r}" if unknown else "has no model"
            raise AlbertiError(wrong, pointer=f"jobs[{number}]")
        options.setdefault("passes", ("rgb",))
        read.append(_job(options.pop("model"), options))
    if threads is not None and (not isinstance(threads, int) or threads < 1):
        raise AlbertiError(f"is {threads!r}, expected 1 or more", pointer="threads")
    return [Frame(*parts) for parts in _native.render_many(read, threads)]


def explain(
    model: Model,
    *,
    point: ArrayLike | None = None,
    segment: ArrayLike | None = None,
    pixel: tuple[int, int] | None = None,
    node: str | int | None = None,
    camera: Camera | str | None = None,
    size: Size | None = None,
    conventions: str = "alberti",
) -> dict[str, Any]:
    """Explain how a point, segment, pixel or node passes through the viewing pipeline.

    Args:
        model: As for :func:`render`.
        point: Point (3,) in world space, or homogeneous (4,).
        segment: The two endpoints (2, 3) of a segment in world space.
        pixel: Column and row of a pixel, to explain its surface and its color.
        node: Name or index of a node, to explain why it is visible or not.
        camera: As for :func:`render`.
        size: As for :func:`render`.
        conventions: ``alberti``, ``opengl``, ``vulkan``, ``direct3d``, ``metal`` or ``webgpu``.

    Returns:
        ``subject``, ``verdict`` and ``steps``. A step has ``id``, ``title``, ``formula`` and
        ``items``; an item has ``id``, ``name`` and ``value``, with the renderer's exact numbers.

    >>> model = Model.from_arrays([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> [step["id"] for step in explain(model, point=(0.5, 0.5, 0))["steps"]][:2]
    ['camera', 'projection']
    """
    import json

    options = {
        "point": point,
        "segment": segment,
        "pixel": pixel,
        "node": node,
        "camera": camera,
        "size": size,
        "conventions": conventions,
    }
    subject, options = _job(model, options)
    explained: dict[str, Any] = json.loads(_native.explain(subject, options))
    return explained


def _job(model: Any, options: dict[str, Any]) -> tuple[_native.Subject, dict[str, Any]]:
    """Return the subject and options for the extension, including the native camera."""
    if not isinstance(model, Model):
        if not type(model).__module__.startswith("trimesh"):
            message = f"is a {type(model).__name__}, expected a Model"
            help = "create one with load(path), Model.from_arrays(…) or Model.from_trimesh(…)"
            raise AlbertiError(message, pointer="model", help=help)
        model = Model.from_trimesh(model)
    camera = options.get("camera")
    if isinstance(camera, str):
        camera = Camera.frame(camera)
    if camera is not None:
        if not isinstance(camera, Camera):
            message = f"is a {type(camera).__name__}, expected a Camera or a direction"
            raise AlbertiError(message, pointer="camera")
        options["camera"] = camera._native
    return model._native, options
