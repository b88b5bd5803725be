"""``python -m alberti``: the command."""

from ._program import main

main()
