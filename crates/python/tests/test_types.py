"""The types of the package accept what the documentation shows, and reject misspelled names."""

import subprocess
import sys
from pathlib import Path

import alberti
import pytest

USE = """
import alberti
import trimesh

model = alberti.load("a.glb")
frame = alberti.render(model, size=[64, 48], passes=("rgb", "object_ids"), style="flat")
lights = [alberti.PointLight((0, 0, 1), 3), alberti.AmbientLight(1)]
alberti.render(model, lights=lights, environment=alberti.Environment("sky"), background=(0, 0, 0))
alberti.render(trimesh.creation.box(), lights="world")
jobs = [{"model": model, "camera": alberti.Camera.frame("front"), "size": (64, 48)}]
names: list[str] = [object.path for frame in alberti.render_each(jobs) for object in frame.objects]
"""
WRONG = {
    "style": 'alberti.render(model, style="oil")',
    "passes": 'alberti.render(model, passes=("rgb", "depht"))',
    "samples": "alberti.render(model, samples=5)",
    "lights": 'alberti.render(model, lights="sun")',
}


def messages(tmp_path, code):
    """Return what mypy reports about the code."""
    pytest.importorskip("mypy", reason="SKIPPED: mypy is not installed")
    path = tmp_path / "use.py"
    path.write_text(code)
    command = [sys.executable, "-m", "mypy", "--strict", "--ignore-missing-imports", path.name]
    folder = Path(alberti.__file__).parents[1]
    # mypy finds installed packages itself, and rejects their folder.
    places = {} if folder.name == "site-packages" else {"MYPYPATH": str(folder)}
    run = subprocess.run(
        [*command, "--cache-dir", str(tmp_path)],
        cwd=tmp_path,
        env=places,
        capture_output=True,
        text=True,
    )
    return run.stdout + run.stderr


def test_documented_calls_are_typed(tmp_path):
    assert "Success" in messages(tmp_path, USE)


@pytest.mark.parametrize("argument", WRONG)
def test_misspelled_names_are_type_errors(tmp_path, argument):
    found = messages(tmp_path, USE + WRONG[argument] + "\n")
    assert f'"{argument}"' in found and "Found 1 error" in found
