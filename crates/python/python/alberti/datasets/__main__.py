"""Data sets from a shell: ``python -m alberti.datasets MODEL FOLDER``."""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING

from .. import AlbertiError, load
from . import forward_facing, hammersley, turntable, verify, write
from ._formats import FORMATS

if TYPE_CHECKING:
    from collections.abc import Callable

    from .. import Camera

VIEWS: dict[str, Callable[..., list[Camera]]] = {
    "turntable": turntable,
    "hammersley": hammersley,
    "forward-facing": forward_facing,
}


def _size(text: str) -> tuple[int, int]:
    width, _, height = text.partition("x")
    if not (width.isdecimal() and height.isdecimal()):
        raise argparse.ArgumentTypeError(f"expected WIDTHxHEIGHT, such as 512x512, found {text}")
    return int(width), int(height)


def main() -> int:
    """Run the command; return the exit code."""
    parser = argparse.ArgumentParser(
        prog="python -m alberti.datasets",
        description="Render views of a model and write them as a data set.",
    )
    parser.add_argument("model", help="model to load; with --verify, the data set's folder")
    parser.add_argument("folder", nargs="?", help="folder to create")
    parser.add_argument("--views", choices=VIEWS, default="hammersley", help="kind of cameras")
    parser.add_argument("--count", type=int, default=100, help="number of cameras")
    parser.add_argument("--size", type=_size, default=(512, 512), metavar="WxH", help="512x512")
    parser.add_argument("--seed", type=int, default=0, help="seed of the cameras")
    parser.add_argument("--format", choices=FORMATS, default="nerf", help="format to write")
    parser.add_argument("--threads", type=int, help="number of threads")
    parser.add_argument("--verify", action="store_true", help="check a data set")
    given = parser.parse_args()
    try:
        if given.verify:
            faults = verify(given.model)
            print("\n".join(faults) or "intact")
            return 1 if faults else 0
        if given.folder is None:
            parser.error("the folder to create is missing")
        model = load(given.model)
        seed = {} if given.views == "turntable" else {"seed": given.seed}
        cameras = VIEWS[given.views](model, given.count, size=given.size, **seed)
        folder = write(given.folder, model, cameras, format=given.format, threads=given.threads)
    except AlbertiError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    print(f"{given.count} views in {folder}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
