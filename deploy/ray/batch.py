"""Render many models on a Ray cluster with the package `alberti`.

    ray job submit -- python deploy/ray/batch.py MODELS OUT --size 256

Each model is a task for one core. Ray assigns it to any free node, and restarts it elsewhere if its worker
or its node dies. A picture gets its final name only when it is complete, and a model that has its picture
is not drawn again, so the same command resumes after any interruption. Broken models are listed at the end
and do not stop the others.

`alberti batch` does more (time and memory limits for each model, reports, content hashes as keys); use this
script if your work is in Python anyway. `OUT` and `MODELS` must be on a file system that all nodes share.
"""

import argparse
import os
import socket
from collections.abc import Iterator
from pathlib import Path

import alberti
import ray

FORMATS = {".gltf", ".glb", ".stl", ".obj", ".ply", ".3mf"}


@ray.remote(num_cpus=1, max_retries=3)
def draw(model: Path, picture: Path, size: int) -> str | None:
    """Draw one model, and return an error message if it is broken."""
    try:
        frame = alberti.render(alberti.load(model), size=(size, size), threads=1)
    except alberti.AlbertiError as error:
        return f"{model}: {error}"
    picture.parent.mkdir(parents=True, exist_ok=True)
    # Two attempts at one task may run at once on two nodes, so their partial files need different names.
    part = picture.with_name(f".{picture.name}.{socket.gethostname()}.{os.getpid()}.part")
    part.write_bytes(frame.png())
    os.replace(part, picture)
    return None


def draw_missing(given: argparse.Namespace) -> Iterator[str | None]:
    """Draw the models that have no picture, and yield the result of `draw` as each task ends."""
    waiting = []
    for path in sorted(given.models.rglob("*")):
        below = path.relative_to(given.models)
        picture = given.out / below.with_name(f"{below.name}.png")
        if path.suffix.lower() not in FORMATS or picture.exists():
            continue
        waiting.append(draw.remote(path.resolve(), picture.resolve(), given.size))
        while len(waiting) >= given.in_flight:
            ready, waiting = ray.wait(waiting)
            yield from ray.get(ready)
    while waiting:
        ready, waiting = ray.wait(waiting)
        yield from ray.get(ready)


def main() -> int:
    """Draw the missing pictures, and return the number of models that failed."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("models", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--size", type=int, default=256)
    parser.add_argument("--in-flight", type=int, default=1000, help="maximum number of pending tasks")
    given = parser.parse_args()
    ray.init(ignore_reinit_error=True)
    results = list(draw_missing(given))
    failures = [result for result in results if result is not None]
    for failure in failures:
        print(f"failed: {failure}")
    print(f"{len(results) - len(failures)} rendered, {len(failures)} failed")
    return len(failures)


if __name__ == "__main__":
    raise SystemExit(min(main(), 1))
