"""The extension's tests, against the zip as a user installs it.

    python tests/blender/run.py --zip ZIP --junitxml=REPORT [FILE or pytest's argument ...]

Runs in a Python that has the bpy package. Each test file has a process and an empty profile of its own: a Blender that
crashes or hangs fails that file and no other. The process ends with pytest's code by os._exit, because Blender 4.5 as a
module can hang at its exit once it has read an image sequence.
"""

import argparse
import os
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as xml
from pathlib import Path

HERE = Path(__file__).resolve().parent
FILE_LIMIT = 240  # seconds, one file
TEST_LIMIT = 60  # seconds, one test


def run_here(zip_file: Path, file: Path, report: Path, options: list[str]) -> None:
    """Installs the zip into this process's Blender, runs one file, never returns."""
    import bpy
    import pytest
    from pixels import PACKAGE

    bpy.ops.extensions.package_install_files(repo="user_default", filepath=str(zip_file), enable_on_install=True)
    if PACKAGE not in bpy.context.preferences.addons:
        print(f"{zip_file}: could not be installed", flush=True)
        os._exit(1)
    command = [str(file), "-q", "--import-mode=importlib", "-p", "no:cacheprovider", f"--timeout={TEST_LIMIT}"]
    code = pytest.main([*command, f"--rootdir={HERE}", f"--junitxml={report}", *options])
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(int(code))


def run_apart(arguments, file: Path, report: Path) -> list[xml.Element]:
    """Runs one file in a process of its own; returns its test cases, a failed one where it ended without a report."""
    command = [sys.executable, str(Path(__file__)), "--zip", str(arguments.zip), f"--junitxml={report}"]
    start = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="stillwater-profile-", ignore_cleanup_errors=True) as profile:
        environment = {**os.environ, "BLENDER_USER_RESOURCES": profile}
        try:
            code = subprocess.run(
                [*command, "--here", str(file), *arguments.options],
                env=environment, stdin=subprocess.DEVNULL, timeout=FILE_LIMIT,
            ).returncode
            ended = f"ended with code {code}"
        except subprocess.TimeoutExpired:
            code, ended = 1, f"not done after {FILE_LIMIT} s"
    cases = list(xml.parse(report).getroot().iter("testcase")) if report.exists() else []
    told = any(case.find("failure") is not None or case.find("error") is not None for case in cases)
    if not cases or (code != 0 and not told):
        case = xml.Element("testcase", classname=file.stem, name="Blender", time=f"{time.monotonic() - start:.1f}")
        xml.SubElement(case, "failure", message=ended)
        print(f"{file.name}: Blender {ended}", flush=True)
        cases.append(case)
    return cases


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--zip", type=Path, required=True)
    parser.add_argument("--junitxml", type=Path, required=True)
    parser.add_argument("--here", type=Path, help="run this one file in this process")
    arguments, rest = parser.parse_known_args()
    arguments.zip, arguments.junitxml = arguments.zip.resolve(), arguments.junitxml.resolve()
    if arguments.here:
        run_here(arguments.zip, arguments.here, arguments.junitxml, rest)
    files = [Path(name).resolve() for name in rest if name.endswith(".py")]
    arguments.options = [name for name in rest if not name.endswith(".py")]
    suite = xml.Element("testsuite", name="blender")
    with tempfile.TemporaryDirectory(prefix="stillwater-reports-") as folder:
        for file in files or sorted(HERE.glob("test_*.py")):
            suite.extend(run_apart(arguments, file, Path(folder, f"{file.stem}.xml")))
    root = xml.Element("testsuites")
    root.append(suite)
    xml.ElementTree(root).write(arguments.junitxml, encoding="utf-8", xml_declaration=True)
    failed = [case for case in suite if case.find("failure") is not None or case.find("error") is not None]
    for case in failed:
        print(f"failed: {case.get('classname')}: {case.get('name')}")
    return 1 if failed or not len(suite) else 0


if __name__ == "__main__":
    sys.exit(main())
