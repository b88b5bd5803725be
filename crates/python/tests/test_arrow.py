"""Arrow tables: rows become pictures or errors, with every engine the same."""

import hashlib
import io
import os
import shutil
import subprocess
import sys

import alberti
import numpy as np
import pytest
from conftest import PROJECT

pyarrow = pytest.importorskip("pyarrow", reason="SKIPPED: pyarrow is not installed")

from alberti import arrow  # noqa: E402

TEAPOT = str(PROJECT / "scenes/models/teapot.glb")
CRATE = str(PROJECT / "scenes/models/crate.glb")


def rows(**columns):
    return pyarrow.table({"uri": [TEAPOT, CRATE], "width": [48, 64], "height": [32, 64], **columns})


def test_rows_hold_the_pictures_and_passes():
    made = arrow.render_table(rows(view=["front", None]), passes=("rgb", "depth")).to_pylist()
    first, second = made
    frame = alberti.render(
        alberti.load(TEAPOT),
        camera="front",
        size=(48, 32),
        passes=("rgb", "depth"),
        lights="world",
    )
    assert first["image"] == {"bytes": frame.png(), "path": None}
    assert first["sha256"] == hashlib.sha256(frame.png()).hexdigest()
    assert np.array_equal(np.load(io.BytesIO(first["depth"])), frame.depth)
    assert second["image"]["bytes"].startswith(b"\x89PNG")
    assert [row["error"] for row in made] == [None, None]
    assert all(row["seconds"] > 0 for row in made)


def test_calibrated_cameras_are_used():
    camera = alberti.Camera.look_at((4, 3, 5), (0, 0, 0), size=(64, 64))
    table = pyarrow.table(
        {
            "uri": [CRATE],
            "K": [camera.K.ravel().tolist()],
            "pose": [camera.pose().ravel().tolist()],
            "width": [64],
            "height": [64],
        }
    )
    [row] = arrow.render_table(table, passes=["depth"]).to_pylist()
    expected = alberti.render(alberti.load(CRATE), camera=camera, passes="depth").depth
    assert np.allclose(np.load(io.BytesIO(row["depth"])), expected)


def test_errors_are_rows(tmp_path):
    broken = tmp_path / "broken.glb"
    broken.write_bytes(b"glTF\2\0\0\0")
    table = pyarrow.table(
        {
            "uri": [TEAPOT, str(broken), "missing.glb", None, TEAPOT, TEAPOT, TEAPOT, TEAPOT],
            "width": [32, 32, 32, 32, -1, 32, 32, 32],
            "height": [32] * 8,
            "view": [None, None, None, None, None, "behind", None, None],
            "K": [None, None, None, None, None, None, [1.0, 2.0], None],
            "style": [None, None, None, None, None, None, None, "cubist"],
        }
    )
    made = arrow.render_table(table).to_pylist()
    errors = [row["error"] for row in made]
    for error, told in zip(
        errors,
        (None, "broken.glb", "there is no file missing.glb", "uri: is None", "size", "behind")
        + ("K: has 2 numbers, expected 9", "cubist"),
    ):
        assert error is None if told is None else told in error, (error, told)
    assert all((row["image"] is None) == (row["error"] is not None) for row in made)
    with pytest.raises(alberti.AlbertiError, match="has no column uri, only a"):
        arrow.render_table(pyarrow.table({"a": [1]}))


def test_batches_of_any_size_give_the_same_rows():
    table = pyarrow.concat_tables([rows()] * 3)
    whole = arrow.render_table(table).drop_columns("seconds")
    batches = arrow.render_batches(table.to_batches(max_chunksize=2))
    parts = pyarrow.Table.from_batches(list(batches)).drop_columns("seconds")
    assert parts.to_pylist() == whole.to_pylist()


def test_pictures_are_those_of_the_program(tmp_path):
    program = os.environ.get("ALBERTI")
    if not program:
        pytest.skip("SKIPPED: ALBERTI does not name the program")
    [row] = arrow.render_table(rows().slice(0, 1), lights=None).to_pylist()
    picture = tmp_path / "a.png"
    command = [program, "render", TEAPOT, "--size", "48x32", "-o", picture]
    subprocess.run(command, check=True, capture_output=True)
    assert picture.read_bytes() == row["image"]["bytes"]


def test_hugging_face_map_gives_the_same_rows():
    datasets = pytest.importorskip("datasets", reason="SKIPPED: datasets is not installed")
    made = datasets.Dataset(rows()).with_format("arrow").map(arrow.render_table, batched=True)
    expected = arrow.render_table(rows()).column("sha256").to_pylist()
    assert list(made.with_format(None)["sha256"]) == expected


def test_ray_data_gives_the_same_rows_although_a_worker_dies(tmp_path):
    pytest.importorskip("ray", reason="SKIPPED: ray is not installed")
    script = tmp_path / "job.py"
    script.write_text(RAY_JOB)
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    run = subprocess.run(
        [sys.executable, script, TEAPOT, CRATE, tmp_path / "died"],
        capture_output=True,
        text=True,
        env=environment,
        timeout=600,
    )
    assert run.returncode == 0, run.stderr[-4000:]
    assert run.stdout.splitlines()[-1] == "120 rows, 2 pictures, 1 death"


#: A job of 120 rows on two workers. The first that meets row 50 kills itself.
RAY_JOB = """
import os, signal, sys
import pyarrow, ray, ray.data
from alberti.arrow import render_table

teapot, crate, marker = sys.argv[1:]
table = pyarrow.table({
    "row": list(range(120)), "uri": [teapot, crate] * 60, "width": [32] * 120, "height": [32] * 120,
})

def work(batch):
    if 50 in batch.column("row").to_pylist() and not os.path.exists(marker):
        open(marker, "w").close()
        os.kill(os.getpid(), signal.SIGKILL)
    return render_table(batch)

ray.init(num_cpus=2, include_dashboard=False, logging_level="ERROR")
ray.data.DataContext.get_current().enable_progress_bars = False
made = ray.data.from_arrow(table).repartition(12).map_batches(
    work, batch_format="pyarrow", batch_size=10
).take_all()
assert sorted(row["row"] for row in made) == list(range(120))
expected = render_table(table.slice(0, 2)).column("sha256").to_pylist()
for row in made:
    assert row["error"] is None and row["sha256"] == expected[row["row"] % 2], row["error"]
deaths = int(os.path.exists(marker))
print(f"{len(made)} rows, {len(set(row['sha256'] for row in made))} pictures, {deaths} death")
"""


def test_spark_gives_the_same_rows_although_a_worker_dies(tmp_path):
    pytest.importorskip("pyspark", reason="SKIPPED: pyspark is not installed")
    if not shutil.which("java"):
        pytest.skip("SKIPPED: there is no java for Spark")
    script = tmp_path / "job.py"
    script.write_text(SPARK_JOB)
    environment = {
        **os.environ,
        "PYTHONPATH": os.pathsep.join(sys.path),
        "PYSPARK_PYTHON": sys.executable,
    }
    run = subprocess.run(
        [sys.executable, script, TEAPOT, CRATE, tmp_path / "died"],
        capture_output=True,
        text=True,
        env=environment,
        timeout=600,
    )
    assert run.returncode == 0, run.stderr[-4000:]
    assert run.stdout.splitlines()[-1] == "120 rows, 2 pictures, 1 death"


#: The same job for Spark.
SPARK_JOB = """
import os, signal, sys
import pyarrow
from pyspark.sql import SparkSession
from pyspark.sql.pandas.types import from_arrow_schema
from alberti.arrow import render_batches, render_table

teapot, crate, marker = sys.argv[1:]
table = pyarrow.table({
    "row": list(range(120)), "uri": [teapot, crate] * 60, "width": [32] * 120, "height": [32] * 120,
})

def work(batches):
    def watched():
        for batch in batches:
            if 50 in batch.column("row").to_pylist() and not os.path.exists(marker):
                open(marker, "w").close()
                os.kill(os.getpid(), signal.SIGKILL)
            yield batch
    return render_batches(watched())

builder = SparkSession.builder.master("local[2,4]").config("spark.ui.enabled", "false")
spark = builder.getOrCreate()
frame = spark.createDataFrame(table.to_pylist()).select(*table.column_names).repartition(12)
schema = from_arrow_schema(render_table(table.slice(0, 0)).schema)
made = frame.mapInArrow(work, schema).collect()
assert sorted(row["row"] for row in made) == list(range(120))
expected = render_table(table.slice(0, 2)).column("sha256").to_pylist()
for row in made:
    assert row["error"] is None and row["sha256"] == expected[row["row"] % 2], row["error"]
deaths = int(os.path.exists(marker))
print(f"{len(made)} rows, {len(set(row['sha256'] for row in made))} pictures, {deaths} death")
"""
