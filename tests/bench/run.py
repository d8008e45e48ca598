"""Prints the benches' table. Called by run.sh; names pick benches (the files' names without .py)."""

from __future__ import annotations

import importlib
import platform
import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE))


def cpu_name() -> str:
    """The processor's name as the system tells it."""
    table = Path("/proc/cpuinfo")
    if table.exists():
        for line in table.read_text().splitlines():
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    return platform.processor() or platform.machine()


def main() -> int:
    benches = sorted(path.stem for path in HERE.glob("*.py") if "\ndef rows(" in path.read_text())
    names = sys.argv[1:] or benches
    if unknown := [name for name in names if name not in benches]:
        print(f"{', '.join(unknown)}: no such bench; there are {', '.join(benches)}", file=sys.stderr)
        return 2
    print(cpu_name())
    print(f"{'work':<62}{'ours':>10}{'reference':>11}  {'unit':<5}{'ratio':>7}{'limit':>7}")
    for name in names:
        for row in importlib.import_module(name).rows():
            verdict = "" if row.reached else "  not reached"
            note = f"  ({row.note})" if row.note else ""
            print(
                f"{row.work:<62}{row.ours:>10.2f}{row.reference:>11.2f}  {row.unit:<5}"
                f"{row.ratio:>7.2f}{row.limit:>7.2f}{verdict}{note}",
                flush=True,
            )
    return 0


if __name__ == "__main__":
    sys.exit(main())
