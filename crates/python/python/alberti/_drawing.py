"""Line drawings: exact hidden-line removal, as SVG, PDF and arrays."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Union

from . import _native
from ._camera import Camera
from ._errors import AlbertiError, warn_all
from ._render import _job

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ._model import Model

    Size = Union[tuple[int, int], Sequence[int]]


def draw(
    model: Model | Any,
    *,
    camera: Camera | str | None = None,
    size: Size | None = None,
    style: str | None = None,
    background: str | Sequence[int] | None = None,
    threads: int | None = None,
) -> Drawing:
    """Draw the edges of a model or a scene, with hidden lines removed.

    Args:
        model: As for :func:`alberti.render`.
        camera: As for :func:`alberti.render`.
        size: As for :func:`alberti.render`; 96 pixels correspond to one inch on paper.
        style: ``lines``, ``dashed`` (hidden lines dashed), ``silhouette``, ``outline`` (the
            silhouette as closed loops), ``technical`` (line types of ISO 128), ``patent``,
            ``blueprint``, ``sketch``, ``wireframe`` or ``depth-cued``; ``lines`` by default.
        background: As for :func:`alberti.render`; sets the color of the paper.
        threads: As for :func:`alberti.render`.

    >>> from alberti import Model
    >>> model = Model.from_arrays([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> drawing = draw(model, camera="front", size=(200, 150))
    >>> drawing.svg[:4], drawing.lines.shape
    ('<svg', (3, 2, 2))
    """
    options: dict[str, Any] = {
        "camera": camera,
        "size": size,
        "style": style,
        "background": background,
        "threads": threads,
    }
    call = dict(options)
    model, options = _job(model, options)
    drawing = Drawing(_native.draw(model._native, options), (model, call))
    warn_all(drawing.warnings)
    return drawing


class Drawing:
    """A line drawing: a page as SVG, PDF or DXF, and its segments as arrays."""

    __slots__ = ("_call", "_native", "_segments")

    def __init__(self, native: _native.Drawing, call: tuple[Model, dict[str, Any]]) -> None:
        self._native = native
        #: The arguments of :func:`draw`, which draws the same lines after unpickling.
        self._call = call
        self._segments: dict[str, Any] | None = None

    @property
    def svg(self) -> str:
        """The page as an SVG document."""
        return self._native.svg()

    @property
    def pdf(self) -> bytes:
        """The page as a PDF file."""
        return self._native.pdf()

    @property
    def dxf(self) -> bytes:
        """The page as a DXF file (R2000).

        The unit is the model's unit if the view is parallel, otherwise millimeters on paper.
        """
        return self._native.dxf()

    @property
    def camera(self) -> Camera:
        """The camera used, with its position and the size of the drawing."""
        return Camera(self._native.camera())

    @property
    def lines(self) -> NDArray[np.float64]:
        """Endpoints (N, 2, 2) of all segments: column and row in pixels, with y down.

        Includes hidden segments if the style shows them; see :attr:`visible`.
        """
        return self._arrays()["ends"]  # type: ignore[no-any-return]

    @property
    def visible(self) -> NDArray[np.bool_]:
        """Whether each segment (N,) is visible."""
        return self._arrays()["visible"]  # type: ignore[no-any-return]

    @property
    def classes(self) -> list[str]:
        """Class of each segment, such as ``silhouette``, ``boundary`` or ``crease``."""
        return self._arrays()["class"]  # type: ignore[no-any-return]

    @property
    def edges(self) -> NDArray[np.uint32]:
        """Index (N,) of the edge to which each segment belongs."""
        return self._arrays()["edge"]  # type: ignore[no-any-return]

    @property
    def objects(self) -> list[str]:
        """Name of the object to which each segment belongs."""
        names: list[str] = self._arrays()["names"]
        return [names[index] for index in self._arrays()["object"]]

    @property
    def warnings(self) -> list[str]:
        """Warnings about missing parts; usually empty."""
        return self._native.warnings()

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the drawing as SVG, PDF or DXF, according to the path's extension."""
        ending = os.path.splitext(os.fspath(path))[1].lower()
        if ending not in (".svg", ".pdf", ".dxf"):
            raise AlbertiError(f"ends in {ending!r}, expected .svg, .pdf or .dxf", pointer="path")
        content = self.svg.encode() if ending == ".svg" else getattr(self, ending[1:])
        with open(path, "wb") as file:
            file.write(content)

    def __reduce__(self) -> tuple[Any, ...]:
        return _draw_again, self._call

    def __repr__(self) -> str:
        width, height = self.camera.size or (0, 0)
        return f"Drawing({width} x {height}: {len(self.lines)} lines)"

    def _repr_svg_(self) -> str:
        """Return the drawing for Jupyter."""
        return self.svg

    def _arrays(self) -> dict[str, Any]:
        """Return the segments, computed on first use."""
        if self._segments is None:
            self._segments = self._native.lines()
        return self._segments


def _draw_again(model: Model, options: dict[str, Any]) -> Drawing:
    """Draw a pickled drawing again; the lines are the same on every machine."""
    return draw(model, **options)
