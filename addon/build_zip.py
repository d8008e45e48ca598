"""Builds the extension's zip: this folder, the version of CMakeLists.txt and the engine's wheels.

    python addon/build_zip.py --wheels FOLDER --output FOLDER [--blender PROGRAM]

Runs in any Python that has the bpy package, or with a Blender program. The folder of wheels may hold those of several
Pythons; the engine's and those it needs go into the zip (numpy is Blender's own).
"""

import argparse
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

ADDON = Path(__file__).resolve().parent
BLENDERS_OWN = {"numpy"}
LEFT_OUT = shutil.ignore_patterns("build_zip.py", "README.md", "guide", "__pycache__", "*.pyc")


def version() -> str:
    """The one version, of the engine and the extension."""
    text = (ADDON.parent / "CMakeLists.txt").read_text()
    return re.search(r"VERSION (?P<value>[0-9.]+) LANGUAGES", text)["value"]


def distribution(name: str) -> str:
    """A distribution's name as wheels' files are named by it."""
    return re.sub(r"[-_.]+", "_", name).lower()


def requirements(wheel: Path) -> set[str]:
    """The distributions that a wheel needs always (extras and markers left aside)."""
    with zipfile.ZipFile(wheel) as archive:
        metadata = next(name for name in archive.namelist() if name.endswith(".dist-info/METADATA"))
        lines = archive.read(metadata).decode().splitlines()
    needed = [line.removeprefix("Requires-Dist: ") for line in lines if line.startswith("Requires-Dist: ")]
    return {distribution(re.match(r"[\w.-]+", line)[0]) for line in needed if ";" not in line}


def wheels_in(folder: Path) -> list[Path]:
    """The engine's wheels of this version and what they need. Exits with a sentence where one is missing."""
    engines = sorted(folder.glob(f"stillwater-{version()}-*.whl"))
    if not engines:
        sys.exit(f"{folder}: holds no wheel of stillwater {version()}")
    wanted = set().union(*map(requirements, engines)) - BLENDERS_OWN
    found = [wheel for wheel in sorted(folder.glob("*.whl")) if distribution(wheel.name.split("-")[0]) in wanted]
    missing = wanted - {distribution(wheel.name.split("-")[0]) for wheel in found}
    if missing:
        sys.exit(f"{folder}: holds no wheel of {', '.join(sorted(missing))}")
    return engines + found


def stage(folder: Path, wheels: list[Path]) -> None:
    """Lays out in `folder` what the zip holds."""
    shutil.copytree(ADDON, folder, ignore=LEFT_OUT)
    (folder / "wheels").mkdir()
    for wheel in wheels:
        shutil.copy(wheel, folder / "wheels")
    shutil.copy(ADDON.parent / "LICENSE", folder)
    manifest = folder / "blender_manifest.toml"
    listed = ",\n".join(f'  "./wheels/{wheel.name}"' for wheel in wheels)
    text = manifest.read_text().replace('"@VERSION@"', f'"{version()}"').replace('["@WHEELS@"]', f"[\n{listed},\n]")
    manifest.write_text(text)


def build_command(blender: str | None) -> list[str]:
    """Blender's own builder of extensions: in a Blender program, or the file of the bpy package."""
    if blender:
        return [blender, "--factory-startup", "--command", "extension", "build"]
    import bpy

    builder = Path(bpy.utils.resource_path("LOCAL"), "scripts", "addons_core", "bl_pkg", "cli", "blender_ext.py")
    return [sys.executable, str(builder), "build"]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--wheels", type=Path, required=True)
    parser.add_argument("--output", type=Path, required=True)
    parser.add_argument("--blender", help="a Blender program, instead of the bpy package")
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        source = Path(scratch, "stillwater")
        stage(source, wheels_in(arguments.wheels))
        folders = ["--source-dir", str(source), "--output-dir", str(arguments.output)]
        return subprocess.run([*build_command(arguments.blender), *folders], timeout=300).returncode


if __name__ == "__main__":
    sys.exit(main())
