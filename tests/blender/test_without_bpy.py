"""What needs no Blender is used without it."""

import ast
import importlib.util
import subprocess
import sys
from pathlib import Path

import pytest

ADDON = Path(__file__).resolve().parents[2] / "addon"
PLAIN = sorted((ADDON / "recipe").glob("*.py"))
PLAIN += [ADDON / "bake" / name for name in ("worker.py", "progress.py", "folders.py")]
PLAIN += [ADDON / name for name in ("compositor/frames.py", "layers/missing.py")]
WITH_NUMPY = [ADDON / f"strokes/{name}.py" for name in ("control_points", "curves", "lines", "projection", "roles")]


def load(path: Path):
    """A module of the source folder by itself, without the extension around it."""
    spec = importlib.util.spec_from_file_location(f"plain_{path.stem}", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


frames = load(ADDON / "compositor/frames.py")


def imported(path: Path) -> set[str]:
    nodes = [node for node in ast.walk(ast.parse(path.read_text())) if isinstance(node, ast.Import | ast.ImportFrom)]
    absolute = [alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names]
    absolute += [node.module for node in nodes if isinstance(node, ast.ImportFrom) and node.level == 0]
    beyond = [node.module or "" for node in nodes if isinstance(node, ast.ImportFrom) and node.level > 1]
    return {name.split(".")[0] for name in absolute} | {f"..{name}" for name in beyond}


@pytest.mark.parametrize("path", PLAIN, ids=lambda path: f"{path.parent.name}/{path.name}")
def test_it_imports_python_alone_and_its_own_room(path):
    assert imported(path) <= sys.stdlib_module_names


@pytest.mark.parametrize("path", WITH_NUMPY, ids=lambda path: path.name)
def test_geometry_imports_numpy_besides(path):
    assert imported(path) <= sys.stdlib_module_names | {"numpy"}


def test_the_recipe_s_room_works_where_there_is_no_bpy():
    program = f"""
import sys
sys.modules["bpy"] = None
sys.path.insert(0, {str(ADDON)!r})
import recipe.read, recipe.write
from recipe.numbers import plain
assert plain(0.6000000238418579) == 0.6
assert recipe.write.frames_to_sample(10, 20) == range(1, 22)
assert recipe.write.frames_to_sample(-3, 0) == range(-3, 3)
"""
    done = subprocess.run([sys.executable, "-I", "-c", program], capture_output=True, text=True, timeout=30)
    assert done.returncode == 0, done.stderr


def test_only_one_file_imports_the_engine():
    doors = [path for path in ADDON.rglob("*.py") if {"stillwater", "msgspec"} & imported(path)]
    assert doors == [ADDON / "engine.py"]


def test_no_python_thread_is_ever_started():
    for path in ADDON.rglob("*.py"):
        assert not {"threading", "concurrent", "asyncio", "_thread", "multiprocessing"} & imported(path), path


def test_versions_are_told_apart_in_one_file():
    telling = ("bpy.app.version", "compositing_node_group", "CompositorNodeComposite")
    tellers = [path.name for path in ADDON.rglob("*.py") if any(word in path.read_text() for word in telling)]
    assert tellers == ["versions.py"]


def test_frames_are_found_by_their_names(tmp_path):
    for name in ("a_0001.exr", "a_0010.exr", "a_12345.exr", "a_1.exr", "b_0003.exr", "a_0004.exr.part", "xa_0005.exr"):
        (tmp_path / name).touch()
    assert frames.present(tmp_path, "a") == [1, 10, 12345]
    assert frames.present(tmp_path / "none", "a") == []
    assert frames.path_of(tmp_path, "a", 10) == tmp_path / "a_0010.exr"


@pytest.mark.parametrize("there", [[5, 6, 7, 8], [6], [5, 8], [7, 8], [5, 7]])
def test_a_missing_frame_is_sent_to_the_nearest(there):
    """Frame in the file = frame - frame_start + 1 + frame_offset."""
    changes = dict(frames.offsets(5, 8, there))
    for frame in range(5, 9):
        offset = changes[max(start for start in changes if start <= frame)]
        shown = frame - 5 + 1 + offset
        assert shown in there and abs(shown - frame) == min(abs(other - frame) for other in there)
    assert 5 in changes and (len(changes) == 1) == (there == [5, 6, 7, 8])
