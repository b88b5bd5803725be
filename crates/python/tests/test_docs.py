"""Run the examples in the modules and in docs/python.md, and each row of its tables."""

import doctest
import importlib
import os
import pkgutil
import re

import alberti
import numpy as np
import pytest
from conftest import PROJECT

PAGE = PROJECT / "docs" / "python.md"


@pytest.fixture(autouse=True)
def in_the_project(monkeypatch):
    monkeypatch.chdir(PROJECT)


MODULES = {module.name for module in pkgutil.iter_modules(alberti.__path__)}


@pytest.mark.parametrize("name", sorted(MODULES - {"__main__", "_native"}))
def test_module_examples(name):
    module = importlib.import_module(f"alberti.{name}")
    assert doctest.testmod(module).failed == 0


def test_package_example():
    assert doctest.testmod(alberti).attempted > 0
    assert doctest.testmod(alberti).failed == 0


def test_page_examples():
    result = doctest.testfile(str(PAGE), module_relative=False)
    assert result.attempted > 10 and result.failed == 0


def table_rows():
    """Return the right column of every table whose left column lists another package's names."""
    rows = []
    for line in PAGE.read_text().splitlines():
        cells = re.split(r" \| ", line.strip("| \n"))
        if line.startswith("|") and len(cells) == 2 and cells[1] not in ("alberti", "---"):
            rows.append((cells[0], cells[1]))
    return rows


def namespace(folder):
    """Return the names used in the rows."""
    trimesh = pytest.importorskip("trimesh", reason="SKIPPED: trimesh is not installed")
    mesh = trimesh.creation.icosphere()
    model = alberti.load(PROJECT / "scenes" / "models" / "teapot.glb")
    camera = alberti.Camera.look_at((1, 2, 8), (0, 0, 0), size=(64, 48))
    scene = trimesh.Scene(mesh)
    names = {
        "alberti": alberti,
        "np": np,
        "Camera": alberti.Camera,
        "mesh": mesh,
        "scene": scene,
        "model": model,
        "camera": camera,
        "frame": alberti.render(model, camera=camera, passes=("rgb", "depth")),
        "path": PROJECT / "scenes" / "models" / "teapot.glb",
        "folder": folder,
        "pose": np.eye(4),
        "extrinsic": np.eye(4),
        "size": (64, 48),
        "vertices": np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], float),
        "faces": np.array([[0, 1, 2], [0, 2, 3]]),
        "colors": np.full((4, 3), 200, np.uint8),
        "ymag": 1.5,
        "K": np.array([[60, 0, 31.5], [0, 60, 23.5], [0, 0, 1]]),
        "R": np.eye(3),
        "T": np.zeros(3),
        "t": np.zeros(3),
        "eye": (0, 0, 5),
        "target": (0, 0, 0),
        "center": (0, 0, 0),
        "up": (0, 1, 0),
    }
    names = {**names, "intensity": 3, "inner": 0.1, "outer": 0.5, "a": 0.02}
    return {**names, "fx": 60, "fy": 60, "cx": 32, "cy": 24}


@pytest.mark.parametrize(("theirs", "ours"), table_rows(), ids=lambda cell: cell[:50])
def test_table_rows(theirs, ours, tmp_path):
    if ours == "not needed":
        for variable in ("DISPLAY", "PYOPENGL_PLATFORM"):
            os.environ.pop(variable, None)
        return
    codes = re.findall(r"`([^`]+)`", ours)
    assert codes, ours
    for code in codes:
        assert eval(code, namespace(tmp_path)) is not None or ".save(" in code


def test_tables_are_found():
    rows = table_rows()
    assert len(rows) > 30
    assert {cell[1] for cell in rows if "xvfb" in cell[0]} == {"not needed"}
