"""What needs no Blender is used without it."""

import ast
import importlib
import importlib.util
import subprocess
import sys
from pathlib import Path
from types import ModuleType, SimpleNamespace

import numpy as np
import pytest

ADDON = Path(__file__).resolve().parents[2] / "addon"
PLAIN = sorted((ADDON / "recipe").glob("*.py"))
PLAIN += [ADDON / "bake" / name for name in ("worker.py", "progress.py", "folders.py", "report.py", "collect.py")]
PLAIN += [ADDON / name for name in ("compositor/frames.py", "layers/missing.py", "layers/placing.py", "layers/label_maps.py", "play/draft.py")]
PLAIN += [ADDON / "overlay" / name for name in ("cutting.py", "outline.py", "shapes.py", "water.py")]
WITH_NUMPY = [ADDON / f"strokes/{name}.py" for name in ("control_points", "curves", "lines", "projection", "roles")]


def load(path: Path):
    """A module of the source folder by itself, without the extension around it."""
    spec = importlib.util.spec_from_file_location(f"plain_{path.stem}", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def load_from_its_room(name: str):
    """A module that uses others of its room, in a package of these alone."""
    package = ModuleType("plain_room")
    package.__path__ = [str((ADDON / name).parent)]
    sys.modules["plain_room"] = package
    return importlib.import_module(f"plain_room.{Path(name).stem}")


frames = load(ADDON / "compositor/frames.py")
report = load(ADDON / "bake/report.py")
progress = load_from_its_room("bake/progress.py")


def imported(path: Path) -> set[str]:
    nodes = [node for node in ast.walk(ast.parse(path.read_text())) if isinstance(node, ast.Import | ast.ImportFrom)]
    absolute = [alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names]
    absolute += [node.module for node in nodes if isinstance(node, ast.ImportFrom) and node.level == 0]
    beyond = [node.module or "" for node in nodes if isinstance(node, ast.ImportFrom) and node.level > 1]
    return {name.split(".")[0] for name in absolute} | {f"..{name}" for name in beyond}


@pytest.mark.parametrize("path", PLAIN, ids=lambda path: f"{path.parent.name}/{path.name}")
def test_it_imports_python_alone_and_its_own_room(path):
    assert imported(path) <= sys.stdlib_module_names | {"numpy"}


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
from recipe.sentences import named
assert named("layers[1].fill: none; layers[9]: gone", ["Oak", "Lake"]) == "Lake, fill: none; layers[9]: gone"
assert plain(0.6000000238418579) == 0.6
assert recipe.write.frames_to_sample(10, 20) == range(1, 22)
assert recipe.write.frames_to_sample(-3, 0) == range(-3, 3)
"""
    done = subprocess.run([sys.executable, "-I", "-c", program], capture_output=True, text=True, timeout=30)
    assert done.returncode == 0, done.stderr


def test_many_numbers_are_written_as_each_alone():
    numbers = load(ADDON / "recipe/numbers.py")
    noise = np.random.default_rng(1)
    odd = [0, -0.0, 0.6, 1e5, 1e6]
    values = [noise.uniform(-10, 10, 3000), 10 ** noise.uniform(-30, 30, 1000), np.arange(999) / 8, odd]
    values = np.concatenate(values).astype(np.float32).astype(float)
    for subtype in ("NONE", "ANGLE"):
        alone = [numbers.plain(value, subtype) for value in values.tolist()]
        assert list(map(repr, numbers.plain_all(values, subtype))) == list(map(repr, alone))


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


def test_ranges_are_written_short():
    assert frames.spans([1, 2, 3, 4, 7, 9, 10]) == "1-4,7,9-10"
    assert frames.spans([]) == "" and frames.spans([-2, -1]) == "-2--1"


def span(first, last, state, *why):
    return SimpleNamespace(first=first, last=last, state=state, why=why)


REPORTS = [
    ([span(1, 120, "ready")], {}, "ready", ["All 120 frames are ready"]),
    ([span(5, 5, "ready")], {}, "ready", ["The frame is ready"]),
    ([span(1, 9, "missing")], {}, "not baked", ["Not baked yet"]),
    ([span(1, 8, "ready"), span(9, 9, "missing")], {}, "frames missing", ["Missing, the nearest is shown: frame 9"]),
    (
        [span(1, 39, "ready"), span(40, 120, "stale")],
        {"wind changed": [(40, 120)]}, "out of date", ["Wind changed: frames 40-120"],
    ),
    (
        [span(1, 1, "stale"), span(2, 2, "missing")],
        {"wind changed": [(1, 1)]}, "out of date", ["Wind changed: frame 1", "Missing, the nearest is shown: frame 2"],
    ),
    (
        [span(1, 9, "stale")],
        {"a changed": [(1, 1), (3, 3), (5, 6), (8, 8), (9, 9)]},
        "out of date", ["A changed: frames 1, 3, 5-6, 2 more"],
    ),
    (
        [span(1, 9, "stale")],
        {f"{n} changed": [(1, 9)] for n in range(8)},
        "out of date", [*(f"{n} changed: frames 1-9" for n in range(6)), "And 2 more changes"],
    ),
]  # fmt: skip


@pytest.mark.parametrize("spans, reasons, words, lines", REPORTS)
def test_what_is_out_of_date_in_words(spans, reasons, words, lines):
    found = report.report(spans, reasons)
    assert (found.words, found.lines) == (words, lines)
    assert found.is_ready == (words == "ready")
    assert {frame: found.at(frame) for span in spans for frame in (span.first, span.last)} == {
        frame: span.state for span in spans for frame in (span.first, span.last)
    }


def test_what_can_t_be_said_is_a_sentence():
    found = report.Report(problem="picture: none.png: there is no such file")
    assert (found.words, found.lines, found.is_ready) == ("", ["picture: none.png: there is no such file"], False)


def test_the_time_left_follows_from_the_frames_that_were_rendered():
    now = [100.0]
    bake = progress.Progress(now=lambda: now[0])
    frame = lambda number, **more: bake.take({"event": "frame", "frame": number, "of": 10, **more})  # noqa: E731
    assert bake.left() == ""
    frame(1, seconds=0.001, kept=True)
    assert bake.left() == ""  # kept ones say nothing
    frame(2, seconds=20)
    frame(3, seconds=40)
    assert bake.left() == "4 min left"  # 7 x 30 s
    now[0] += 60
    assert bake.left() == "2 min left"
    now[0] += 600
    assert bake.left() == "1 s left"
    bake.cancelled = True
    assert bake.left() == ""
    said = [progress.duration(seconds) for seconds in (0, 59, 60, 3599, 4800)]
    assert said == ["1 s", "59 s", "1 min", "1 h 0 min", "1 h 20 min"]
    frame(4, seconds="soon")  # no number: nothing breaks
