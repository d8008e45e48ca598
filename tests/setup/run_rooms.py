"""Runs the rooms of tests/ one after the other and closes with a table: what each took, and what was left out.

Called by tests/run.sh. A room is a folder of tests/ with test files in it. `blender` runs in the Blender that fits
this machine's Python; `other-blender` runs the same in a folder of the other Debian; `gui` runs in a Blender that shows
a window, in a folder of Debian sid.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import time
import xml.etree.ElementTree as xml
from dataclasses import dataclass, field
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]
TESTS = REPOSITORY / "tests"
BLENDER_ROOMS = {"blender": "blender.sh", "other-blender": "other_debian.sh", "gui": "gui.sh"}  # each with its script
ROOM_LIMIT = 1500  # seconds
TEST_LIMIT = 120  # seconds, one test


@dataclass
class Outcome:
    """What one room's run gave."""

    room: str
    seconds: float = 0.0
    passed: int = 0
    failed: int = 0
    skipped: int = 0
    left_out: list[str] = field(default_factory=list)


def rooms() -> list[str]:
    """Every folder of tests/ that holds test files, in the engine's order as far as it has one."""
    order = ["structure", "core", "picture", "layers", "motion", "flow", "appearance", "frame", "recipe", "render", "cli", "fuzz", "golden"]
    found = {path.parent.relative_to(TESTS).parts[0] for path in TESTS.rglob("test_*.py")} - BLENDER_ROOMS.keys()
    return sorted(found, key=lambda room: (order.index(room) if room in order else len(order), room))


def read_report(path: Path, outcome: Outcome) -> None:
    """Adds pytest's own count to the outcome; a run without a report has failed."""
    if not path.exists():
        outcome.failed += 1
        return
    for case in xml.parse(path).getroot().iter("testcase"):
        if case.find("failure") is not None or case.find("error") is not None:
            outcome.failed += 1
        elif (skip := case.find("skipped")) is not None:
            outcome.skipped += 1
            outcome.left_out.append(f"{case.get('name')}: {skip.get('message')}")
        else:
            outcome.passed += 1


def run(outcome: Outcome, command: list[str], report: Path, environment: dict[str, str] | None = None) -> None:
    """Runs one command that leaves a report of pytest's, within ROOM_LIMIT."""
    report.unlink(missing_ok=True)
    start = time.monotonic()
    try:
        code = subprocess.run(
            command, cwd=REPOSITORY, timeout=ROOM_LIMIT, stdin=subprocess.DEVNULL, env=environment
        ).returncode
    except subprocess.TimeoutExpired:
        print(f"{outcome.room}: not done after {ROOM_LIMIT} s", flush=True)
        code = 1
    outcome.seconds += time.monotonic() - start
    before = outcome.failed
    read_report(report, outcome)
    if code != 0 and outcome.failed == before:
        outcome.failed += 1


def run_engine_room(build: Path, room: str, files: list[str]) -> Outcome:
    """A room of the engine, in the environment that has it installed."""
    outcome = Outcome(room)
    report = build / "reports" / f"{room}.xml"
    command = [sys.executable, "-m", "pytest", "-q", "--import-mode=importlib", f"--timeout={TEST_LIMIT}"]
    command += ["-p", "no:cacheprovider", f"--junitxml={report}", *(files or [f"tests/{room}"])]
    run(outcome, command, report)
    return outcome


def run_blender_room(build: Path, room: str, files: list[str]) -> Outcome:
    """The extension's tests: here, or in a folder of another Debian."""
    outcome = Outcome(room)
    report = build / "reports" / f"{room}.xml"
    command = ["bash", f"tests/setup/{BLENDER_ROOMS[room]}", str(report), *files]
    run(outcome, command, report, {**os.environ, "STILLWATER_BUILD": str(build)})
    return outcome


def chosen(names: list[str]) -> dict[str, list[str]]:
    """Rooms and, where files were named, the files of each. Exits with 2 for a name that is neither."""
    known = [*rooms(), *BLENDER_ROOMS]
    if not names:
        return {room: [] for room in known}
    picked: dict[str, list[str]] = {}
    for name in names:
        if name in known:
            picked.setdefault(name, [])
        elif (path := Path(name)).exists() and TESTS in path.resolve().parents:
            file = path.resolve()
            picked.setdefault(file.relative_to(TESTS).parts[0], []).append(str(file.relative_to(REPOSITORY)))
        else:
            sys.exit(f"{name}: neither a file under tests/ nor a room ({', '.join(known)})")
    return picked


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--build", type=Path, required=True)
    parser.add_argument("names", nargs="*")
    arguments = parser.parse_args()
    (arguments.build / "reports").mkdir(parents=True, exist_ok=True)
    outcomes = []
    for room, files in chosen(arguments.names).items():
        print(f"\n== {room}", flush=True)
        run_room = run_blender_room if room in BLENDER_ROOMS else run_engine_room
        outcomes.append(run_room(arguments.build, room, files))

    print(f"\n{'room':<16}{'seconds':>9}{'passed':>9}{'failed':>9}{'left out':>10}")
    for o in outcomes:
        print(f"{o.room:<16}{o.seconds:>9.1f}{o.passed:>9}{o.failed:>9}{o.skipped:>10}")
    for o in outcomes:
        for sentence in o.left_out:
            print(f"left out: {o.room}: {sentence}")
    passed, failed, skipped = (sum(getattr(o, name) for o in outcomes) for name in ("passed", "failed", "skipped"))
    print(f"\n{passed} passed, {failed} failed, {skipped} skipped")
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main())
