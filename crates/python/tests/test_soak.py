"""Make many calls: none of them may crash the process, and memory use must not grow."""

import subprocess
import sys
from pathlib import Path

import pytest

FUZZ = Path(__file__).with_name("fuzz_calls.py")

LEAK = """
import alberti, sys

def resident():
    with open("/proc/self/status") as file:
        return next(int(line.split()[1]) for line in file if line.startswith("VmRSS"))

model = alberti.load(sys.argv[1])
camera = alberti.Camera.frame("front")
def render():
    frame = alberti.render(model, camera=camera, size=(64, 48), passes=("rgb", "depth", "ids"), threads=1)
    frame.rgb, frame.depth, frame.ids, frame.png()

for _ in range(100):
    render()
begin = resident()
for _ in range(int(sys.argv[2]) - 100):
    render()
print(resident() - begin)
"""


def test_ten_thousand_random_calls():
    done = subprocess.run([sys.executable, str(FUZZ), "10000", "1"], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr[-3000:]
    assert done.stdout.startswith("10000 calls: ")


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="SKIPPED: needs /proc")
def test_ten_thousand_renders_do_not_leak_memory(models):
    command = [sys.executable, "-c", LEAK, str(models / "table.glb"), "10000"]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert int(done.stdout) < 5 * 1024, f"{done.stdout} kB more than after 100"
