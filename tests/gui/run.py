"""The window tests: a Blender with a window on a screen of its own (Xvfb), used with mouse and keys.

    python3 tests/gui/run.py --zip ZIP --junitxml=REPORT --screens FOLDER [FILE ...]

Each file has a Blender, a screen and a profile of its own, with the zip installed as a user installs it. Needs Blender,
Xvfb and ImageMagick; runs in any Python. Blender has a time limit, and the screen ends with the last program on it.
"""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as xml
from contextlib import contextmanager
from pathlib import Path

HERE = Path(__file__).resolve().parent
FILE_LIMIT = 600  # s, one file
SIZE = (1600, 1000)


@contextmanager
def screen():
    """An X server without a monitor; gives its name. It ends by itself when its last client has gone (-terminate)."""
    listen, tell = os.pipe()
    command = ["Xvfb", "-displayfd", str(tell), "-terminate", "-nolisten", "tcp", "-dpi", "96"]
    server = subprocess.Popen(
        [*command, "-screen", "0", f"{SIZE[0]}x{SIZE[1]}x24"], pass_fds=[tell], stderr=subprocess.DEVNULL
    )
    os.close(tell)
    try:
        with open(listen) as told:
            number = told.readline().strip()
        if not number:
            sys.exit(f"Xvfb ended with code {server.wait()}")
        yield f":{number}"
    finally:
        server.kill()
        server.wait()


def profile_with(zip_file: Path, folder: Path) -> dict[str, str]:
    """Installs the zip into an empty profile; returns the environment in which Blender uses it."""
    (folder / "tmp").mkdir()
    environment = {**os.environ, "BLENDER_USER_RESOURCES": str(folder), "TMPDIR": str(folder / "tmp")}
    environment["LIBGL_ALWAYS_SOFTWARE"] = "1"
    environment.pop("WAYLAND_DISPLAY", None)
    command = ["blender", "--command", "extension", "install-file", "-r", "user_default", "-e", str(zip_file)]
    subprocess.run(command, env=environment, stdin=subprocess.DEVNULL, timeout=120, check=True)
    return environment


def run_blender(arguments, file: Path, report: Path, log: Path) -> str:
    """Runs one file; returns how Blender ended where that was not well, else nothing."""
    with tempfile.TemporaryDirectory(prefix="stillwater-profile-", ignore_cleanup_errors=True) as profile:
        environment = profile_with(arguments.zip, Path(profile))
        with screen() as display, open(log, "wb") as said:
            command = ["blender", "--enable-event-simulate", "--gpu-backend", "opengl"]
            command += ["--window-geometry", "0", "0", *map(str, SIZE), "--python-exit-code", "1"]
            command += ["--python", str(HERE / "driver.py"), "--", str(file), str(report), str(arguments.screens)]
            try:
                code = subprocess.run(
                    command, env={**environment, "DISPLAY": display}, timeout=FILE_LIMIT,
                    stdin=subprocess.DEVNULL, stdout=said, stderr=subprocess.STDOUT,
                ).returncode
            except subprocess.TimeoutExpired:
                return f"Blender was not done after {FILE_LIMIT} s"
    return f"Blender ended with code {code}" if code else ""


def run_file(arguments, file: Path, report: Path) -> list[xml.Element]:
    """Runs one file; returns its test cases, and failed ones where Blender ended badly or a traceback was shown."""
    log = arguments.screens / f"{file.stem}.log"
    start = time.monotonic()
    wrong = run_blender(arguments, file, report, log)
    said = log.read_text(errors="replace")
    cases = list(xml.parse(report).getroot().iter("testcase")) if report.exists() else []
    if not cases:
        wrong = wrong or "Blender ran no test"
    elif not failed(cases) and "Traceback (most recent call last)" in said:
        wrong = wrong or "a traceback was shown"
    if wrong:
        case = xml.Element("testcase", classname=file.stem, name="Blender", time=f"{time.monotonic() - start:.1f}")
        xml.SubElement(case, "failure", message=wrong)
        cases.append(case)
    if failed(cases):
        print(f"---- what Blender said\n{said}\n----")
    print(f"{file.stem}: {len(cases) - len(failed(cases))} of {len(cases)} passed, {time.monotonic() - start:.1f} s", flush=True)
    return cases


def failed(cases) -> list[xml.Element]:
    return [case for case in cases if case.find("failure") is not None]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--zip", type=Path, required=True)
    parser.add_argument("--junitxml", type=Path, required=True)
    parser.add_argument("--screens", type=Path, required=True)
    parser.add_argument("files", nargs="*", type=Path)
    arguments = parser.parse_args()
    shutil.rmtree(arguments.screens, ignore_errors=True)
    arguments.screens.mkdir(parents=True)
    suite = xml.Element("testsuite", name="gui")
    with tempfile.TemporaryDirectory(prefix="stillwater-reports-") as folder:
        for file in arguments.files or sorted(HERE.glob("test_*.py")):
            suite.extend(run_file(arguments, file.resolve(), Path(folder, f"{file.stem}.xml")))
    root = xml.Element("testsuites")
    root.append(suite)
    xml.ElementTree(root).write(arguments.junitxml, encoding="utf-8", xml_declaration=True)
    for case in failed(suite):
        print(f"failed: {case.get('classname')}: {case.get('name')}: {case.find('failure').get('message')}")
    return 1 if failed(suite) or not len(suite) else 0


if __name__ == "__main__":
    sys.exit(main())
