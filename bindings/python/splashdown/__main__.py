"""The command `splashdown`: `python -m splashdown`."""

import sys

from splashdown._core import execute


def main() -> int:
    """Runs the command with the arguments of this process; returns its exit code."""
    return execute(["splashdown", *sys.argv[1:]], [sys.executable, "-m", "splashdown"])


if __name__ == "__main__":
    sys.exit(main())
