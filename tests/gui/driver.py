"""Runs one file of window tests inside a Blender that shows a window, and quits it.

    blender --enable-event-simulate --python tests/gui/driver.py -- FILE REPORT SCREENS

A test is a generator `def test_NAME(window)`. The tests of a file are one person's way: they run in the order in which
they stand there, each from where the one before has left Blender. After a failed one the rest count as failed too.
"""

import importlib.util
import sys
import time
import traceback
import xml.etree.ElementTree as xml
from pathlib import Path

import bpy

bpy.context.preferences.view.show_splash = False  # before the first redraw
sys.path.insert(0, str(Path(__file__).parent))
from window import Window  # noqa: E402

TEST_LIMIT = 180  # s, one test


def tests_of(path: Path) -> list:
    """The file's tests in their order."""
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return [function for name, function in vars(module).items() if name.startswith("test_")]


class Run:
    """What is left to do of a file, pumped by a timer: each tick goes on with the test until its next yield."""

    def __init__(self, file: Path, report: Path, screens: Path):
        self._report, self._screens = report, screens
        self._suite = xml.Element("testsuite", name=file.stem)
        self._file = file
        self._steps = self._all()

    def tick(self) -> float | None:
        try:
            return next(self._steps) or 0.0
        except StopIteration:
            xml.ElementTree(self._suite).write(self._report)
            bpy.context.preferences.view.use_save_prompt = False
            bpy.ops.wm.quit_blender()

    def _all(self):
        window = Window(self._screens)
        yield from window.settle()
        failed = ""
        for test in tests_of(self._file):
            case = xml.SubElement(self._suite, "testcase", classname=self._file.stem, name=test.__name__)
            if failed:
                xml.SubElement(case, "failure", message=f"not reached: {failed} failed")
                continue
            start = time.monotonic()
            try:
                yield from _within_limit(test(window))
            except Exception as error:
                traceback.print_exc()
                print(f"failed: {test.__name__}", flush=True)
                xml.SubElement(case, "failure", message=str(error)).text = traceback.format_exc()
                yield from window.screenshot(f"failed-{test.__name__}")
                failed = test.__name__
            case.set("time", f"{time.monotonic() - start:.1f}")
            print(f"{time.monotonic() - start:6.1f} s  {test.__name__}", flush=True)


def _within_limit(steps):
    start = time.monotonic()
    for pause in steps:
        assert time.monotonic() - start < TEST_LIMIT, f"not done after {TEST_LIMIT} s"
        yield pause


if __name__ == "__main__":
    bpy.app.timers.register(Run(*map(Path, sys.argv[sys.argv.index("--") + 1 :])).tick, persistent=True)
