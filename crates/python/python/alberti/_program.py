"""The command ``alberti``: the same program as the one that is built with Cargo."""

from __future__ import annotations

import signal
import sys

from . import _native


def main() -> None:
    """Runs the program with the arguments of the command line, and exits with its code."""
    # Ctrl-C ends the program at once, as it ends the one without Python.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    program = [sys.executable, "-m", "alberti"]
    sys.exit(_native.run_program(program, ["alberti", *sys.argv[1:]]))


if __name__ == "__main__":
    main()
