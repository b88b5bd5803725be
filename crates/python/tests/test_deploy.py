"""Test `deploy`: check the Kubernetes job against its published schema, and run the Ray example."""

import os
import shutil
import subprocess
import sys
import tempfile

import pytest
from conftest import PROJECT

DEPLOY = PROJECT / "deploy"
KUBERNETES_VERSION = "1.33"


@pytest.fixture
def job():
    yaml = pytest.importorskip("yaml", reason="SKIPPED: kubernetes-validate is not installed")
    return yaml.safe_load((DEPLOY / "kubernetes" / "batch.yaml").read_text())


def test_job_matches_the_published_schema(job):
    validator = pytest.importorskip(
        "kubernetes_validate", reason="SKIPPED: kubernetes-validate is not installed"
    )
    validator.validate(job, KUBERNETES_VERSION, strict=True)
    job["spec"]["podFailurePolicy"]["rules"][0]["action"] = 1
    with pytest.raises(validator.ValidationError):
        validator.validate(job, KUBERNETES_VERSION, strict=True)


def test_shard_count_matches_completions(job):
    arguments = job["spec"]["template"]["spec"]["containers"][0]["args"]
    assert f"--shard=auto/{job['spec']['completions']}" in arguments


def test_exit_codes_are_handled_by_meaning(job):
    rules = job["spec"]["podFailurePolicy"]["rules"]
    by_code = {
        code: rule["action"]
        for rule in rules
        for code in rule.get("onExitCodes", {}).get("values", [])
    }
    # No rule mentions 3, so it counts as an attempt.
    assert by_code == {1: "FailIndex", 2: "FailJob"}


def test_job_has_memory_for_all_workers(job):
    container = job["spec"]["template"]["spec"]["containers"][0]
    flags = dict(word[2:].split("=") for word in container["args"] if "=" in word)
    gibibytes = int(flags["threads"]) * int(flags["job-memory"].removesuffix("GiB"))
    assert int(container["resources"]["limits"]["memory"].removesuffix("Gi")) > gibibytes
    assert container["resources"]["requests"]["cpu"] == flags["threads"]


def test_program_accepts_the_flags_of_the_job(job, program):
    arguments = job["spec"]["template"]["spec"]["containers"][0]["args"]
    text = subprocess.run([program, "batch", "--help"], capture_output=True, text=True).stdout
    for word in arguments[1:]:
        assert word.split("=")[0] in text, word


@pytest.fixture
def short_folder():
    with tempfile.TemporaryDirectory(prefix="ray-") as folder:
        yield folder


def test_ray_draws_all_models_and_resumes(models, tmp_path, short_folder):
    pytest.importorskip("ray", reason="SKIPPED: ray is not installed")
    inputs, out = tmp_path / "models", tmp_path / "out"
    (inputs / "below").mkdir(parents=True)
    shutil.copy(models / "teapot.glb", inputs)
    shutil.copy(models / "table.glb", inputs / "below")
    (inputs / "broken.glb").write_text("broken")
    # No user settings are read or written.
    environment = os.environ | {
        "HOME": str(tmp_path),
        "RAY_AUTH_MODE": "disabled",
        # Socket paths must be short.
        "RAY_TMPDIR": str(short_folder),
        "RAY_USAGE_STATS_ENABLED": "0",
    }

    def run():
        command = [sys.executable, DEPLOY / "ray" / "batch.py", inputs, out, "--size", "64"]
        run = subprocess.run(
            command, env=environment, capture_output=True, text=True, timeout=300
        )
        lines = run.stdout.splitlines()
        assert run.returncode == 1, run.stderr
        assert any(line.startswith("failed: ") and "broken.glb" in line for line in lines)
        return lines[-1]

    assert run() == "2 rendered, 1 failed"
    pictures = sorted(path.relative_to(out).as_posix() for path in out.rglob("*") if path.is_file())
    assert pictures == ["below/table.glb.png", "teapot.glb.png"]
    before = [path.stat() for path in sorted(out.rglob("*.png"))]
    assert run() == "0 rendered, 1 failed"
    assert [path.stat() for path in sorted(out.rglob("*.png"))] == before
