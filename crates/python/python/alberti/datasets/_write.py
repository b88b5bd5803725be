"""Renders the views of a data set and passes them to the writer of a format."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

from .._errors import AlbertiError
from .._native import __version__
from .._render import render_each
from ._folder import Folder
from ._formats import FORMATS

if TYPE_CHECKING:
    import os
    from collections.abc import Iterable, Iterator
    from pathlib import Path

    from .._camera import Camera
    from .._model import Model
    from .._render import Color, Lights

    Format = Literal["nerf", "colmap", "coco", "bop", "webdataset", "parquet"]


def write(
    folder: str | os.PathLike[str],
    model: Model,
    cameras: Iterable[Camera],
    *,
    format: Format = "nerf",
    lights: Lights | None = "world",
    background: Color | None = None,
    samples: Literal[1, 4, 8, 16] | None = None,
    threads: int | None = None,
) -> Path:
    """Render a model from each camera and write a data set.

    Args:
        folder: The folder to create. It appears when the data set is complete.
        model: The model or scene.
        cameras: Cameras with a size.
        format: The format; see the table in :mod:`alberti.datasets`.
        lights: As for :func:`alberti.render`, but the default light stays in the world.
        background: As for :func:`alberti.render`.
        samples: As for :func:`alberti.render`.
        threads: Number of pictures rendered at the same time; by default, one for each processor.

    Returns:
        The path of the folder.

    Raises:
        AlbertiError: If the folder is not empty, or a picture cannot be rendered. Nothing is
            written in that case.
    """
    if format not in FORMATS:
        expected = ", ".join(FORMATS)
        raise AlbertiError(f"is {format!r}, expected one of {expected}", pointer="format")
    target = Folder(folder)
    writer = FORMATS[format](target, model)
    look: dict[str, Any] = {"lights": lights, "background": background, "samples": samples}

    def jobs() -> Iterator[dict[str, Any]]:
        for number, camera in enumerate(cameras):
            if camera.size is None:
                help = "pass size=(width, height) when you make the camera"
                raise AlbertiError("has no size", pointer=f"cameras[{number}]", help=help)
            yield {"model": model, "camera": camera, "passes": writer.passes, **look}

    count = 0
    try:
        for count, frame in enumerate(render_each(jobs(), threads=threads), 1):
            writer.add(count - 1, frame)
        if count == 0:
            raise AlbertiError("is empty", pointer="cameras")
        writer.finish()
        return target.finish({"program": f"alberti {__version__}", "format": format, "views": count})
    finally:
        target.discard()
