"""`render` as whoever starts it sees it: lines, codes, signals, other workers, full disks."""

import contextlib
import json
import os
import select
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import pytest
from PIL import Image
from stillwater import _stillwater as engine
from stillwater.render.cache import Cache

ROOT = os.name == "posix" and os.geteuid() == 0


@pytest.fixture
def start():
    """`start("render", ...)`: a worker that runs on; it is gone when the test is over."""
    started = []

    def run(*arguments, **how):
        line = [sys.executable, "-m", "stillwater", *map(str, arguments)]
        how = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True, "bufsize": 1} | how
        started.append(subprocess.Popen(line, **how))
        return started[-1]

    yield run
    for process in started:
        process.kill()
        process.wait()
        for pipe in filter(None, (process.stdin, process.stdout, process.stderr)):
            pipe.close()


@pytest.fixture
def long_scene(scene):
    """A scene with far more frames than a test waits for."""
    return scene(lambda recipe: recipe.update(frames=[1, 5000]), "long.json")


def wait_for(process, event, frame=None):
    """Reads a worker's lines up to an event (of a frame)."""
    deadline = time.monotonic() + 30
    while time.monotonic() < deadline and select.select([process.stdout], [], [], 30)[0]:
        line = process.stdout.readline()
        assert line, process.stderr.read()
        told = json.loads(line)
        if told["event"] == event and (frame is None or told["frame"] >= frame):
            return told
    raise AssertionError(f"no {event} within 30 s")


def frames_in(folder):
    return {path.name: path.read_bytes() for path in folder.glob("frame_*.exr")}


def leavings(folder):
    return [path.name for path in folder.iterdir() if path.name.startswith(".")]


def test_json_lines(scene, tmp_path, command):
    done = command("render", scene(), "--progress", "json")
    assert (done.returncode, done.stderr) == (0, "")
    lines = [json.loads(line) for line in done.stdout.splitlines()]
    assert {line["event"] for line in lines} == {"started", "preparing", "frame", "done"}
    assert lines[0] == {"event": "started", "first": 1, "last": 6, "of": 6, "size": [48, 36], "folder": str(tmp_path / "frames")}
    frames = [line for line in lines if line["event"] == "frame"]
    assert [line["frame"] for line in frames] == [1, 2, 3, 4, 5, 6]
    for line in frames:
        assert set(line) == {"event", "frame", "of", "seconds", "path"}
        assert line["of"] == 6 and 0 < line["seconds"] < 10 and os.path.exists(line["path"])
    shares = [line["share"] for line in lines if line["event"] == "preparing"]
    assert shares == sorted(shares) and shares[-1] == 1
    assert lines[-1]["event"] == "done" and lines[-1]["rendered"] == 6


def test_every_line_is_told_at_once(start, long_scene):
    process = start("render", long_scene, "--progress", "json")
    first = wait_for(process, "frame")
    assert first["frame"] == 1 and process.poll() is None


def test_without_a_terminal_only_warnings_are_said(scene, command):
    done = command("render", scene(lambda recipe: recipe["layers"][0]["matte"].update(value=77)))
    assert (done.returncode, done.stdout) == (0, "")
    assert [line.startswith("stillwater: warning: ") for line in done.stderr.splitlines()] == [True]


def test_a_bar(scene, command):
    done = command("render", scene(), "--progress", "bar")
    assert done.returncode == 0 and done.stdout == ""
    assert "6/6" in done.stderr


def test_frames_output_scale_threads(scene, tmp_path, command):
    done = command("render", scene(), "--frames", "2-3", "--output", "there", "--scale", "0.5", "--threads", "1", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert sorted(frames_in(tmp_path / "there")) == ["frame_0002.exr", "frame_0003.exr"]
    facts = engine.inspect_picture(str(tmp_path / "there" / "frame_0002.exr"))
    assert (facts.width, facts.height) == (24, 18)
    assert command("render", scene(), "--frames", "5").returncode == 0
    assert sorted(frames_in(tmp_path / "frames")) == ["frame_0005.exr"]


def test_a_cache_elsewhere_is_used_and_kept_within_its_limit(scene, tmp_path, command):
    def preparations():
        return {path.parent.name for path in (tmp_path / "kept").glob("*/meta.json")}

    def render(change=lambda recipe: None):
        done = command("render", scene(change), "--frames", "1", "--cache", tmp_path / "kept", "--cache-limit", "0.001")
        assert done.returncode == 0, done.stderr
        return preparations()

    first = render()
    assert len(first) == 1 + 5 + 1 and not (tmp_path / ".stillwater-cache").exists()
    assert render() == first
    for key in first:
        (tmp_path / "kept" / key / "large.npy").write_bytes(bytes(1_000_000))
    second = render(lambda recipe: recipe["layers"][0].update(feather=3))
    assert len(second) == 1 + 5 + 1 and not second & first


@pytest.mark.parametrize(
    "arguments, sentence",
    [
        (["--frames", "5-99"], "--frames: 5-99 is not within the recipe's 1-6"),
        (["--frames", "6-2"], "--frames: 6-2 runs backwards (the first is not above the last)"),
        (["--frames", "all"], "argument --frames: all is not a frame or FIRST-LAST"),
        (["--frames", "1-9999999999"], "argument --frames: 1-9999999999 is not a frame or FIRST-LAST"),
        (["--scale", "0"], "argument --scale: 0 is not between 0.001 and 16"),
        (["--scale", "nan"], "argument --scale: nan is not between 0.001 and 16"),
        (["--scale", "big"], "argument --scale: big is not between 0.001 and 16"),
        (["--threads", "-1"], "argument --threads: -1 is not between 0 and 1024"),
        (["--threads", "1025"], "argument --threads: 1025 is not between 0 and 1024"),
        (["--cache-limit", "0"], "argument --cache-limit: 0 is not between 0.001 and 1000000"),
        (["--cache-limit", "all"], "argument --cache-limit: all is not between 0.001 and 1000000"),
        (["--progress", "loud"], "argument --progress: invalid choice: 'loud'"),
        (["--movie", "nowhere/film.mp4"], "--movie: nowhere: there is no such folder"),
    ],
)
def test_wrong_arguments(scene, tmp_path, command, arguments, sentence):
    path = scene()
    before = sorted(tmp_path.iterdir())
    done = command("render", path, *arguments)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith(f"stillwater: {sentence}") and done.stderr.count("\n") == 1
    assert sorted(tmp_path.iterdir()) == before


def test_an_error_is_a_line_too(scene, command):
    path = scene(lambda recipe: recipe.update(picture="none.png"))
    done = command("render", path, "--progress", "json")
    sentence = f"picture: {path.parent}/none.png: there is no such file"
    assert json.loads(done.stdout) == {"event": "error", "sentence": sentence}
    assert (done.returncode, done.stderr) == (2, f"stillwater: {path}: {sentence}\n")


@pytest.mark.parametrize("number, code", [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
@pytest.mark.parametrize("event, frame", [("started", None), ("preparing", None), ("frame", 1), ("frame", 7)])
def test_a_signal_ends_it_at_once(start, long_scene, tmp_path, number, code, event, frame):
    process = start("render", long_scene, "--progress", "json")
    wait_for(process, event, frame)
    sent = time.monotonic()
    process.send_signal(number)
    assert process.wait(10) == code
    assert time.monotonic() - sent < 0.2
    if (tmp_path / "frames").exists():
        assert leavings(tmp_path / "frames") == []
        for path in (tmp_path / "frames").iterdir():
            engine.read_frame(str(path))


@pytest.fixture
def huge_scene(scene, tmp_path):
    """The scene at 60 times its size: cutting its layers takes seconds."""
    path = scene(lambda recipe: recipe["view"].update(horizon=[[0, 1020], [2880, 1080]]))
    for name in ("picture.png", "labels.png", "tree.png"):
        with Image.open(tmp_path / name) as image:
            large = image.resize((60 * image.width, 60 * image.height), Image.Resampling.NEAREST)
        large.save(tmp_path / name)
    return path


@pytest.mark.parametrize("moment", [0.05, 0.4, 1.0])
def test_a_signal_ends_it_also_in_the_middle_of_cutting_layers(start, command, huge_scene, tmp_path, moment):
    process = start("render", huge_scene, "--progress", "json", "--frames", "1")
    wait_for(process, "preparing")
    time.sleep(moment)
    assert process.poll() is None, "it was over before it could be asked to end"
    sent = time.monotonic()
    process.send_signal(signal.SIGTERM)
    assert process.wait(10) == 143
    assert time.monotonic() - sent < 0.2
    assert not [path for path in tmp_path.rglob("*") if path.name.startswith(".") and path.is_file()]
    assert not list(tmp_path.rglob("frame_*.exr"))


def test_it_ends_with_its_parent_where_asked_to(start, long_scene):
    process = start("render", long_scene, "--progress", "json", "--parent", stdin=subprocess.PIPE)
    wait_for(process, "frame")
    sent = time.monotonic()
    process.stdin.close()
    assert process.wait(10) == 143
    assert time.monotonic() - sent < 0.2


def test_without_parent_the_end_of_standard_input_is_nothing(scene, command):
    assert command("render", scene(), stdin=subprocess.DEVNULL).returncode == 0


@pytest.mark.parametrize("moment", [0.0, 0.013, 0.047, 0.11])
def test_killed_at_any_moment_it_goes_on_where_it_stopped(start, command, scene, tmp_path, moment):
    path = scene(lambda recipe: recipe.update(frames=[1, 40]))
    process = start("render", path, "--progress", "json")
    wait_for(process, "frame")
    time.sleep(moment)
    process.kill()
    process.wait()
    before = frames_in(tmp_path / "frames")
    for name in before:
        engine.read_frame(str(tmp_path / "frames" / name))
    done = command("render", path, "--progress", "json")
    assert done.returncode == 0, done.stderr
    lines = [json.loads(line) for line in done.stdout.splitlines()]
    assert {f"frame_{line['frame']:04d}.exr" for line in lines if line["event"] == "frame" and "kept" in line} == set(before)
    assert leavings(tmp_path / "frames") == []
    assert command("render", path, "--output", tmp_path / "whole").returncode == 0
    assert frames_in(tmp_path / "frames") == frames_in(tmp_path / "whole")


def test_no_half_written_file_is_seen_under_a_final_name(start, scene, tmp_path):
    process = start("render", scene(lambda recipe: recipe.update(frames=[1, 24])), "--scale", "4")
    seen = set()
    while process.poll() is None:
        for path in (tmp_path / "frames").glob("frame_*.exr"):
            if path not in seen:
                engine.read_frame(str(path))
                seen.add(path)
    assert process.returncode == 0 and len(seen) > 10


class TestTwoWorkers:
    def test_disjoint_frames_share_folder_and_cache(self, start, command, scene, tmp_path):
        path = scene(lambda recipe: recipe.update(frames=[1, 20]))
        workers = [start("render", path, "--frames", frames) for frames in ("1-10", "11-20")]
        assert [(worker.wait(60), worker.stderr.read().count("\n")) for worker in workers] == [(0, 0), (0, 0)]
        kept = Cache(tmp_path / ".stillwater-cache").facts().values()
        assert len([facts for facts in kept if "layers" in facts]) == 1 and len(kept) == 1 + 5 + 1  # what drifts, endless
        command("render", path, "--output", tmp_path / "whole")
        assert frames_in(tmp_path / "frames") == frames_in(tmp_path / "whole")
        assert leavings(tmp_path / "frames") == []

    def test_the_same_frames_are_refused_and_nothing_is_lost(self, start, command, long_scene):
        first = start("render", long_scene, "--progress", "json")
        wait_for(first, "frame")
        second = command("render", long_scene, "--frames", "7-9")
        assert second.returncode == 2
        said = [line for line in second.stderr.splitlines() if "warning" not in line]
        assert len(said) == 1 and f"another worker (process {first.pid} on " in said[0]
        assert "is rendering the frames 1 to 5000 (wait for it, or give --frames that it has not)" in said[0]
        wait_for(first, "frame", 10)
        assert first.poll() is None


@contextlib.contextmanager
def mounted(folder, options):
    folder.mkdir(exist_ok=True)
    subprocess.run(["mount", "-t", "tmpfs", "-o", options, "none", folder], check=True, timeout=10)
    try:
        yield
    finally:
        subprocess.run(["umount", "-l", folder], check=True, timeout=10)


def can_mount():
    if not ROOT or not shutil.which("mount"):
        return False
    with tempfile.TemporaryDirectory() as folder:
        if subprocess.run(["mount", "-t", "tmpfs", "none", folder], capture_output=True, timeout=10).returncode:
            return False
        subprocess.run(["umount", "-l", folder], check=True, timeout=10)
    return True


needs_mounts = pytest.mark.skipif(not can_mount(), reason="only root can mount a small disk")


@needs_mounts
def test_a_full_disk_is_one_sentence_and_keeps_what_is_there(scene, tmp_path, command):
    path = scene()
    with mounted(tmp_path / "frames", "size=64k"):
        done = command("render", path, "--scale", "4", "--progress", "json")
        assert done.returncode == 1
        said = [line for line in done.stderr.splitlines() if "warning" not in line]
        assert len(said) == 1 and "cannot be written: the disk is full (" in said[0]
        assert json.loads(done.stdout.splitlines()[-1])["event"] == "error"
        assert leavings(tmp_path / "frames") == []
        for name in frames_in(tmp_path / "frames"):
            engine.read_frame(str(tmp_path / "frames" / name))


@needs_mounts
def test_a_read_only_output_folder(scene, tmp_path, command):
    path = scene()
    with mounted(tmp_path / "frames", "ro"):
        done = command("render", path, "--progress", "none")
        said = [line for line in done.stderr.splitlines() if "warning" not in line]
        assert done.returncode == 2
        assert said == [f"stillwater: output.folder: {tmp_path}/frames: cannot be written (Read-only file system)"]
    assert not (tmp_path / ".stillwater-cache").exists()


@needs_mounts
def test_a_full_cache_is_a_warning(scene, tmp_path, command):
    path = scene()
    with mounted(tmp_path / ".stillwater-cache", "size=16k"):
        done = command("render", path)
        assert done.returncode == 0
        assert f"{tmp_path}/.stillwater-cache: cannot be written (No space left on device)" in done.stderr
    assert len(frames_in(tmp_path / "frames")) == 6
