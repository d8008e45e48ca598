"""The zip holds the extension, one version and the wheels that it needs."""

import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[2]
VERSION = "0.1.0"


def wheel(folder: Path, name: str, *needs: str) -> None:
    with zipfile.ZipFile(folder / name, "w") as archive:
        lines = "".join(f"Requires-Dist: {need}\n" for need in needs)
        archive.writestr(f"{name.split('-')[0]}-1.dist-info/METADATA", f"Metadata-Version: 2.1\n{lines}")


@pytest.fixture
def folder(tmp_path):
    """Wheels for two Pythons, with some that are not wanted."""
    source = (REPOSITORY / "CMakeLists.txt").read_text()
    assert f"VERSION {VERSION} LANGUAGES" in source
    wheels = tmp_path / "wheels"
    wheels.mkdir()
    for python in ("cp311-cp311", "cp313-cp313"):
        needs = ("numpy>=1", "msgspec>=0.18", 'scipy; extra == "x"')
        wheel(wheels, f"stillwater-{VERSION}-{python}-linux_x86_64.whl", *needs)
        wheel(wheels, f"msgspec-0.20.0-{python}-manylinux_2_17_x86_64.whl")
    wheel(wheels, "numpy-2.0.0-cp311-cp311-manylinux_2_17_x86_64.whl")
    wheel(wheels, "scipy-1.0.0-cp311-cp311-manylinux_2_17_x86_64.whl")
    wheel(wheels, "stillwater-0.0.1-cp311-cp311-linux_x86_64.whl")
    return tmp_path


def build(folder: Path):
    command = [sys.executable, str(REPOSITORY / "addon/build_zip.py"), "--wheels", str(folder / "wheels")]
    return subprocess.run([*command, "--output", str(folder)], capture_output=True, text=True, timeout=60)


def test_the_zip_holds_the_wheels_of_all_pythons_and_no_others(folder):
    done = build(folder)
    assert done.returncode == 0, done.stdout + done.stderr
    with zipfile.ZipFile(folder / f"stillwater-{VERSION}.zip") as archive:
        names = archive.namelist()
        manifest = tomllib.loads(archive.read("blender_manifest.toml").decode())
    carried = sorted(Path(name).name for name in names if name.endswith(".whl"))
    assert len(carried) == 4 and {name.split("-")[0] for name in carried} == {"msgspec", "stillwater"}
    assert all(VERSION in name for name in carried if name.startswith("stillwater"))
    assert sorted(Path(path).name for path in manifest["wheels"]) == carried
    assert (manifest["id"], manifest["version"]) == ("stillwater", VERSION)
    assert manifest["license"] == ["SPDX:GPL-3.0-or-later"] and manifest["blender_version_min"] == "4.5.0"
    assert {"__init__.py", "LICENSE", "ui/sidebar.py"} <= set(names)
    own = ("build_zip", "__pycache__", "README", "guide")
    assert not [name for name in names if any(word in name for word in own)]


@pytest.mark.parametrize(
    "pattern, sentence",
    [("msgspec-*", "holds no wheel of msgspec"), ("stillwater-*", f"holds no wheel of stillwater {VERSION}")],
)
def test_a_missing_wheel_is_a_sentence_and_no_zip(folder, pattern, sentence):
    for path in (folder / "wheels").glob(pattern):
        path.unlink()
    done = build(folder)
    assert done.returncode == 1 and sentence in done.stderr
    assert not list(folder.glob("*.zip"))
