"""Runs the rooms of tests/ and closes with a table: what each took, and what was left out.

Called by tests/run.sh. A room is a folder of tests/ with test files in it. `blender` runs in the Blender that fits
this machine's Python; `other-blender` runs the same in a folder of the other Debian; `gui` runs in a Blender that shows
a window, in a folder of Debian sid. These last two spend half of their time making folders and building; they run one
after the other beside all other rooms, with what is left of the processor, and what they print follows at the end.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import time
import xml.etree.ElementTree as xml
from concurrent.futures import ThreadPoolExecutor
from contextlib import nullcontext
from dataclasses import dataclass, field
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]
TESTS = REPOSITORY / "tests"
BLENDER_ROOMS = {"blender": "blender.sh", "other-blender": "other_debian.sh", "gui": "gui.sh"}  # each with its script
BESIDE = ("other-blender", "gui")  # rooms that run beside the others
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


def run(
    outcome: Outcome, command: list[str], report: Path, log: Path | None = None, environment: dict[str, str] | None = None
) -> None:
    """Runs one command that leaves a report of pytest's, within ROOM_LIMIT. With a log, what it prints goes there, and it
    gives way to what runs beside it.
    """
    report.unlink(missing_ok=True)
    start = time.monotonic()
    if log:
        command = ["nice", "-n", "5", *command]
    with open(log, "wb") if log else nullcontext() as printed:
        try:
            code = subprocess.run(
                command, cwd=REPOSITORY, timeout=ROOM_LIMIT, stdin=subprocess.DEVNULL, env=environment,
                stdout=printed, stderr=subprocess.STDOUT if log else None,
            ).returncode
        except subprocess.TimeoutExpired:
            print(f"{outcome.room}: not done after {ROOM_LIMIT} s", flush=True)
            code = 1
    outcome.seconds = time.monotonic() - start
    read_report(report, outcome)
    if code != 0 and not outcome.failed:
        outcome.failed = 1


def run_room(build: Path, room: str, files: list[str], log: Path | None = None) -> Outcome:
    """A room of the engine, in the environment that has it installed, or of the extension: here, or in another Debian."""
    outcome = Outcome(room)
    report = build / "reports" / f"{room}.xml"
    if room in BLENDER_ROOMS:
        command = ["bash", f"tests/setup/{BLENDER_ROOMS[room]}", str(report), *files]
        run(outcome, command, report, log, {**os.environ, "STILLWATER_BUILD": str(build)})
    else:
        command = [sys.executable, "-m", "pytest", "-q", "--import-mode=importlib", f"--timeout={TEST_LIMIT}"]
        command += ["-p", "no:cacheprovider", f"--junitxml={report}", *(files or [f"tests/{room}"])]
        run(outcome, command, report, log)
    return outcome


def run_beside(build: Path, picked: dict[str, list[str]], beside: list[str]) -> list[Outcome]:
    """All picked rooms, those named `beside` after each other in a thread of their own."""

    def run_all_beside() -> list[Outcome]:
        return [run_room(build, room, picked[room], build / "reports" / f"{room}.log") for room in beside]

    with ThreadPoolExecutor(1) as thread:
        there = thread.submit(run_all_beside)
        here = []
        for room in picked:
            if room not in beside:
                print(f"\n== {room}", flush=True)
                here.append(run_room(build, room, picked[room]))
        if not there.done():
            print(f"\n== {' and '.join(beside)}, until now beside the others", flush=True)
        there = there.result()
    for room in beside:
        print(f"\n== {room}", flush=True)
        print((build / "reports" / f"{room}.log").read_text(errors="replace"), end="", flush=True)
    return [*here, *there]


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
    picked = chosen(arguments.names)
    beside = [room for room in BESIDE if room in picked] if picked.keys() - set(BESIDE) else []
    outcomes = run_beside(arguments.build, picked, beside)

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
