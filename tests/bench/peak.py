"""Runs one command line of Stillwater's; prints how many bytes it held at most, beyond those when all was imported.

The system counts a child's peak from its parent's size on, so the process asks for its own.
"""

from __future__ import annotations

import sys
from pathlib import Path

from stillwater.command_line import show  # noqa: F401
from stillwater.command_line.main import run
from stillwater.render import loop  # noqa: F401


def held(what: str) -> int:
    """A line of the kernel's account of this process, in bytes."""
    (line,) = (line for line in Path("/proc/self/status").read_text().splitlines() if line.startswith(what))
    return int(line.split()[1]) * 1024


if __name__ == "__main__":
    imported = held("VmRSS")
    code = run(sys.argv[1:])
    print(held("VmHWM") - imported)
    sys.exit(code)
