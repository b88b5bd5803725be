"""Render one picture or many, and explain how points become pixels."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal, TypedDict, Union

from . import _native
from ._camera import Camera
from ._errors import AlbertiError, warn_all
from ._frame import Frame
from ._lights import Environment, Light, light_options
from ._model import Model

if TYPE_CHECKING:
    from concurrent.futures import Future

    from numpy.typing import ArrayLike

    Size = Union[tuple[int, int], Sequence[int]]
    PassName = Literal[
        "rgb",
        "rgba",
        "depth",
        "distance",
        "normal",
        "view_normal",
        "position",
        "uv",
        "barycentric",
        "ids",
        "model_ids",
        "object_ids",
        "node_ids",
        "mesh_ids",
        "material_ids",
        "overdraw",
        "coverage",
    ]
    Passes = Union[PassName, Sequence[PassName]]
    StyleName = Literal[
        "shaded",
        "flat",
        "unlit",
        "gouraud",
        "clay",
        "matcap",
        "normals",
        "depth",
        "uv",
        "ids",
        "toon",
        "x-ray",
        "wireframe",
        "lines",
        "dashed",
        "silhouette",
        "outline",
        "technical",
        "patent",
        "blueprint",
        "sketch",
        "depth-cued",
    ]
    Lights = Union[Literal["camera", "world"], Light, Sequence[Light]]
    Color = Union[str, Sequence[int]]

    class _JobOptions(TypedDict, total=False):
        camera: Camera | str | None
        size: Size | None
        passes: Passes
        style: StyleName | None
        background: Color | None
        samples: Literal[1, 4, 8, 16] | None
        lights: Lights | None
        environment: str | Environment | None
        shadows: bool | float | None
        ground: bool | float | None
        exposure: float | None
        tone_mapping: str | None

    class Job(_JobOptions):
        """The arguments of :func:`render` for one picture of :func:`render_many`."""

        model: Model


def render(
    model: Model | Any,
    *,
    camera: Camera | str | None = None,
    size: Size | None = None,
    passes: Passes = ("rgb",),
    style: StyleName | None = None,
    background: Color | None = None,
    samples: Literal[1, 4, 8, 16] | None = None,
    lights: Lights | None = None,
    environment: str | Environment | None = None,
    shadows: bool | float | None = None,
    ground: bool | float | None = None,
    exposure: float | None = None,
    tone_mapping: str | None = None,
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
            ``model_ids``, ``object_ids``, ``node_ids``, ``mesh_ids``, ``material_ids``,
            ``overdraw``, ``coverage``. All except the first describe the surface at the center of
            each pixel.
        style: ``shaded``, ``flat`` (one normal per triangle), ``unlit`` (base colors, without
            light), ``gouraud``, ``clay``, ``matcap``, ``normals``, ``depth``, ``uv``, ``ids``,
            ``toon``, ``x-ray``, ``wireframe``, ``lines``, ``dashed``, ``silhouette``,
            ``outline``, ``technical``, ``patent``, ``blueprint``, ``sketch`` or ``depth-cued``.
        background: ``transparent``, ``#rgb``, ``#rrggbb``, a CSS color name, or (r, g, b) from 0
            to 255.
        samples: Samples per pixel for anti-aliasing: 1, 4, 8 or 16; 4 by default.
        lights: Lights, which replace those of the scene and the models; see
            :class:`DirectionalLight`. By default, a model without lights has a key light that
            moves with the camera, and a studio around it. With ``world``, this light stays in
            place, so that views from different directions show the same surface alike. Lights in
            a list shine alone; add an ``environment`` if metals should reflect something.
        environment: ``studio``, ``sky``, ``uniform`` or ``dark``, or an :class:`Environment`.
        shadows: Whether lights cast shadows; or the angle that lights subtend, in degrees from 0
            to 30, for soft shadows.
        ground: Whether shadows fall on a ground below the models; or its y coordinate.
        exposure: Exposure in stops; each stop doubles all light.
        tone_mapping: Curve that brings bright light into range, such as ``neutral`` or ``aces``.
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
        "lights": lights,
        "environment": environment,
        "shadows": shadows,
        "ground": ground,
        "exposure": exposure,
        "tone_mapping": tone_mapping,
        "threads": threads,
    }
    model, options = _job(model, options)
    frame = _frame(model, options, _native.render(model._native, options))
    warn_all(frame.warnings)
    return frame


def render_many(
    jobs: Iterable[Job | Mapping[str, Any]], *, threads: int | None = None
) -> list[Frame]:
    """Render many pictures in parallel, one per thread.

    Args:
        jobs: The arguments of :func:`render` for each picture, as dictionaries with ``model``.
        threads: Maximum number of threads; by default one per processor.

    Returns:
        The frames, in the order of the jobs. All are kept in memory; use :func:`render_each` for
        very large numbers of views.

    Raises:
        AlbertiError: For the first job that fails; ``pointer`` begins with ``jobs[index]``.

    Warns:
        AlbertiWarning: For missing parts of a picture, with the index of the job.

    >>> model = Model.from_arrays([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> views = [{"model": model, "camera": view, "size": (32, 32)} for view in ("front", "back")]
    >>> [frame.size for frame in render_many(views)]
    [(32, 32), (32, 32)]
    """
    read = [_read_job(number, job) for number, job in enumerate(jobs)]
    _check_threads(threads)
    parts = [(model._native, options) for model, options in read]
    rendered = zip(read, _native.render_many(parts, threads))
    frames = [_frame(model, options, parts) for (model, options), parts in rendered]
    warn_all(
        f"jobs[{number}]: {text}" for number, frame in enumerate(frames) for text in frame.warnings
    )
    return frames


def render_each(
    jobs: Iterable[Job | Mapping[str, Any]], *, threads: int | None = None
) -> Iterator[Frame]:
    """Render many pictures in parallel, and yield each frame in the order of the jobs.

    Jobs are read as they are needed, and at most two frames per thread are kept in memory, so
    ``jobs`` may be a generator without an end.

    Args:
        jobs: As for :func:`render_many`.
        threads: As for :func:`render_many`.

    Raises:
        AlbertiError: For the first job that fails; ``pointer`` begins with ``jobs[index]``.

    >>> model = Model.from_arrays([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> views = ({"model": model, "camera": view, "size": (32, 32)} for view in ("front", "back"))
    >>> [frame.size for frame in render_each(views)]
    [(32, 32), (32, 32)]
    """
    import os
    from concurrent.futures import ThreadPoolExecutor

    _check_threads(threads)
    count = threads or os.cpu_count() or 1

    def work(number: int, job: Job | Mapping[str, Any]) -> Frame:
        model, options = _read_job(number, job)
        [parts] = _native.render_many([(model._native, options)], 1, number)
        return _frame(model, options, parts)

    with ThreadPoolExecutor(count) as pool:
        pending: deque[tuple[int, Future[Frame]]] = deque()

        def finish() -> Frame:
            number, future = pending.popleft()
            frame = future.result()
            warn_all((f"jobs[{number}]: {text}" for text in frame.warnings), stacklevel=4)
            return frame

        try:
            for number, job in enumerate(jobs):
                pending.append((number, pool.submit(work, number, job)))
                if len(pending) == 2 * count:
                    yield finish()
            while pending:
                yield finish()
        finally:
            for _, future in pending:
                future.cancel()


def _read_job(number: int, job: Job | Mapping[str, Any]) -> tuple[Model, dict[str, Any]]:
    """Check the arguments of a job."""
    try:
        options: dict[str, Any] = dict(job)
    except (TypeError, ValueError):
        message = f"is a {type(job).__name__}, expected a dictionary of arguments"
        raise AlbertiError(message, pointer=f"jobs[{number}]") from None
    unknown = sorted(set(options) - _JOB_ARGUMENTS, key=str)
    if unknown or "model" not in options:
        wrong = f"has no argument {unknown[0]!r}" if unknown else "has no model"
        raise AlbertiError(wrong, pointer=f"jobs[{number}]")
    options.setdefault("passes", ("rgb",))
    try:
        return _job(options.pop("model"), options)
    except AlbertiError as error:
        error.pointer = f"jobs[{number}].{error.pointer}"
        raise


_JOB_ARGUMENTS = {
    "model",
    "camera",
    "size",
    "passes",
    "style",
    "background",
    "samples",
    "lights",
    "environment",
    "shadows",
    "ground",
    "exposure",
    "tone_mapping",
}


def _check_threads(threads: int | None) -> None:
    """Raise an error if the number of threads is not at least 1."""
    if threads is not None and (not isinstance(threads, int) or threads < 1):
        raise AlbertiError(f"is {threads!r}, expected 1 or more", pointer="threads")


def _frame(model: Model, options: dict[str, Any], parts: _native.FrameParts) -> Frame:
    """Return a frame, with the objects of the model if ids were rendered."""
    passes = options["passes"]
    passes = (passes,) if isinstance(passes, str) else passes
    has_ids = any(str(name).endswith("ids") for name in passes)
    return Frame(*parts, model.objects if has_ids else ())


def explain(
    model: Model | Any,
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
        ``schema``, ``subject``, ``introduction``, ``verdict`` and ``steps``. A step has ``id``, ``title``, ``formula`` and
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
    model, options = _job(model, options)
    explained: dict[str, Any] = json.loads(_native.explain(model._native, options))
    return explained


def _job(model: Any, options: dict[str, Any]) -> tuple[Model, dict[str, Any]]:
    """Return the model and the options for the extension, including the native camera."""
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
    light_options(options)
    return model, options
