"""The command ``alberti``: the same program as built with Cargo."""

from __future__ import annotations

import signal
import sys

from . import _native


def main() -> None:
    """Run the program with the command-line arguments, and exit with the code it returns."""
    # Ctrl+C ends the program immediately, as it does without Python.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    program = [sys.executable, "-m", "alberti"]
    sys.exit(_native.run_program(program, ["alberti", *sys.argv[1:]]))


if __name__ == "__main__":
    main()
