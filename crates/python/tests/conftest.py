"""Fixtures shared by the tests: folders, models, and the program."""

import os
import shutil
from pathlib import Path

import alberti
import numpy as np
import pytest

PROJECT = Path(__file__).resolve().parents[3]


def assets_folder():
    """Return the folder of external test models: `ASSETS`, or one next to the repository."""
    given = os.environ.get("ASSETS")
    folder = Path(given) if given else PROJECT.parent / "shared" / "assets"
    return folder if folder.is_dir() else None


@pytest.fixture(scope="session")
def models():
    """Return the folder of the scene models."""
    return PROJECT / "scenes" / "models"


@pytest.fixture(scope="session")
def assets():
    """Return the folder of external test models."""
    folder = assets_folder()
    if folder is None:
        pytest.skip("SKIPPED: no folder of test models; set ASSETS")
    return folder


@pytest.fixture(scope="session")
def program():
    """Return the path of the program: `ALBERTI`, or the command installed by the wheel."""
    command = os.environ.get("ALBERTI") or shutil.which("alberti")
    if command is None:
        pytest.skip("SKIPPED: the program alberti is not installed; set ALBERTI")
    return command


@pytest.fixture(scope="session")
def teapot(models):
    return alberti.load(models / "teapot.glb")


@pytest.fixture
def plane():
    """Return a square with side 20 in the plane z = 0."""
    corners = np.array([[-10, -10, 0], [10, -10, 0], [10, 10, 0], [-10, 10, 0]], float)
    return alberti.Model.from_arrays(corners, [[0, 1, 2, 3]])


def random_rotation(rng):
    """Return a uniformly distributed rotation matrix, from four normally distributed numbers."""
    w, x, y, z = (q := rng.normal(size=4)) / np.linalg.norm(q)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def _report_skip(name, reason):
    """Report skipped tests in the form that the summary of `cargo xtask test` reads."""
    reason = reason.removeprefix("Skipped: ").removeprefix("SKIPPED: ").splitlines()[0]
    log = os.environ.get("SKIP_LOG")
    if log:
        with open(log, "a", encoding="utf-8") as file:
            file.write(f"SKIPPED python {name}: {reason}\n")


def _skip_reason(report):
    return report.longrepr[2] if isinstance(report.longrepr, tuple) else str(report.longrepr)


def pytest_runtest_logreport(report):
    if report.skipped:
        _report_skip(report.nodeid, _skip_reason(report))


def pytest_collectreport(report):
    if report.skipped:
        _report_skip(report.nodeid, _skip_reason(report))
