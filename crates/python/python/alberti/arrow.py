"""Rendering of Arrow tables, for Ray Data, Spark and Hugging Face ``datasets``.

A row names a model and, if needed, a camera; the result has the picture, or an error as text. A row
never raises an exception, so that one broken file does not stop a job of a million rows. Equal rows
give equal bytes on every machine, with any engine and any size of batches.

======================  =====================================================================
column of the input     meaning
======================  =====================================================================
``uri``                 path of the model; required
``view``                direction from which to frame the model, such as ``front``
``K``                   matrix of the camera (9 numbers, row by row)
``pose``                pose of the camera (16 numbers, row by row; OpenGL axes)
``width``, ``height``   size in pixels; 512 by default
``style``               style, such as ``lines``
======================  =====================================================================

Columns and values may be missing. All columns of the input are kept, and these are added:
``image`` (a struct of ``bytes`` and ``path``, as in Hugging Face ``datasets``), one binary column
with a NumPy file for each further pass, ``sha256`` of the picture, ``seconds`` and ``error``.

Each engine calls the same function::

    ray.data.from_arrow(table).map_batches(render_table, batch_format="pyarrow")
    frame.mapInArrow(render_batches, schema)  # Spark
    dataset.with_format("arrow").map(render_table, batched=True)  # Hugging Face
"""

from __future__ import annotations

import functools
import hashlib
import io
import time
import warnings
from typing import TYPE_CHECKING, Any

from ._camera import Camera
from ._errors import AlbertiError, AlbertiWarning
from ._model import Model, load
from ._render import render

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

__all__ = ["render_batches", "render_table"]

#: The number of models that a process keeps.
MODELS = 8
#: The width and height of a picture whose row has none.
DEFAULT_SIDE = 512


def render_table(
    table: Any, *, passes: Sequence[str] = ("rgb",), lights: Any = "world", threads: int = 1
) -> Any:
    """Render the rows of a ``pyarrow.Table`` or ``RecordBatch``.

    Args:
        table: The rows; see the table of columns in :mod:`alberti.arrow`.
        passes: Passes to render, as for :func:`alberti.render`; ``rgb`` becomes ``image``.
        lights: Lights, as for :func:`alberti.render`.
        threads: Number of threads for each picture.

    Returns:
        The same rows with the new columns, of the same type as the argument.

    Raises:
        AlbertiError: If there is no column ``uri``. Errors in rows are in the column ``error``.
    """
    import pyarrow  # type: ignore[import-not-found,import-untyped,unused-ignore]

    if "uri" not in table.schema.names:
        found = ", ".join(table.schema.names) or "nothing"
        raise AlbertiError(f"has no column uri, only {found}", pointer="table")
    wanted = tuple(passes)
    rows = [_render_row(row, wanted, lights, threads) for row in table.to_pylist()]
    columns = dict(zip(table.schema.names, table.columns))
    for name, kind in _result_types(wanted).items():
        columns[name] = pyarrow.array([row[name] for row in rows], kind)
    return type(table).from_pydict(columns)


def render_batches(batches: Iterable[Any], **options: Any) -> Iterator[Any]:
    """Render record batches one after the other, as Spark's ``mapInArrow`` expects.

    Args:
        batches: The batches.
        options: Options of :func:`render_table`.
    """
    for batch in batches:
        yield render_table(batch, **options)


def _result_types(passes: Sequence[str]) -> dict[str, Any]:
    """Return the names and types of the new columns."""
    import pyarrow  # type: ignore[import-not-found,import-untyped,unused-ignore]

    image = pyarrow.struct([("bytes", pyarrow.binary()), ("path", pyarrow.string())])
    types: dict[str, Any] = {"image": image} if "rgb" in passes else {}
    types.update((name, pyarrow.binary()) for name in passes if name != "rgb")
    return {
        **types,
        "sha256": pyarrow.string(),
        "seconds": pyarrow.float64(),
        "error": pyarrow.string(),
    }


def _render_row(
    row: dict[str, Any], passes: tuple[str, ...], lights: Any, threads: int
) -> dict[str, Any]:
    """Render a row; an error becomes text."""
    import numpy as np

    start = time.perf_counter()
    result: dict[str, Any] = dict.fromkeys(("image", *passes, "sha256", "error"))
    try:
        with warnings.catch_warnings():
            # Thousands of rows would print thousands of warnings.
            warnings.simplefilter("ignore", AlbertiWarning)
            frame = render(
                _model(row["uri"]),
                camera=_camera(row),
                size=(row.get("width") or DEFAULT_SIDE, row.get("height") or DEFAULT_SIDE),
                passes=passes,  # type: ignore[arg-type]
                style=row.get("style"),
                lights=lights,
                threads=threads,
            )
        if "rgb" in passes:
            picture = frame.png()
            result["image"] = {"bytes": picture, "path": None}
            result["sha256"] = hashlib.sha256(picture).hexdigest()
        for name in passes:
            if name != "rgb":
                content = io.BytesIO()
                np.save(content, frame[name])
                result[name] = content.getvalue()
    except (AlbertiError, OSError, TypeError, ValueError) as error:
        result["error"] = str(error) or type(error).__name__
    result["seconds"] = time.perf_counter() - start
    return result


@functools.lru_cache(maxsize=MODELS)
def _model(uri: str) -> Model:
    """Load a model; neighboring rows often show the same."""
    if not isinstance(uri, str):
        raise AlbertiError(f"is {uri!r}, expected a path", pointer="uri")
    return load(uri[7:] if uri.startswith("file://") else uri)


def _camera(row: dict[str, Any]) -> Camera | str | None:
    """Return the camera of a row: calibrated, framed from a direction, or the default."""
    K, pose = row.get("K"), row.get("pose")
    if K is None:
        if pose is not None:
            raise AlbertiError("needs a column K with the matrix of the camera", pointer="pose")
        view: str | None = row.get("view")
        return view
    size = (row.get("width") or DEFAULT_SIDE, row.get("height") or DEFAULT_SIDE)
    matrices = [_matrix(K, 3, "K"), None if pose is None else _matrix(pose, 4, "pose")]
    return Camera.from_intrinsics(matrices[0], size, pose=matrices[1])


def _matrix(numbers: Any, side: int, name: str) -> Any:
    """Return a matrix from its entries, row by row, or from its rows."""
    import numpy as np

    values = np.asarray(numbers, dtype=np.float64).ravel()
    if values.size != side * side:
        message = f"has {values.size} numbers, expected {side * side}"
        raise AlbertiError(message, pointer=name)
    return values.reshape(side, side)
