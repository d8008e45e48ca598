"""A file that is written comes whole or not at all: full disks, folders that take nothing, signals in the middle."""

import os
import shutil
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from stillwater import _stillwater as engine

NOISE = np.random.default_rng(7).random((600, 600, 4)).astype(np.float32)
NOISE[..., 3] = 1


def frame(path):
    engine.write_frame(str(path), NOISE)


def picture(path):
    engine.write_picture(str(path), NOISE, 16 if path.suffix in (".png", ".tif") else 0)


WRITERS = [("f.exr", frame), ("p.exr", picture), ("p.png", picture), ("p.tif", picture), ("p.jpg", picture)]
by_name = pytest.mark.parametrize(("name", "write"), WRITERS, ids=[f"{w.__name__} {n}" for n, w in WRITERS])


@by_name
def test_a_folder_that_is_not_there(tmp_path, name, write):
    path = tmp_path / "none" / name
    with pytest.raises(engine.FileError) as caught:
        write(path)
    assert str(caught.value) == f"{path}: cannot be written (No such file or directory)"


@by_name
def test_a_folder_of_that_name(tmp_path, name, write):
    (tmp_path / name).mkdir()
    with pytest.raises(engine.FileError) as caught:
        write(tmp_path / name)
    assert str(caught.value) == f"{tmp_path / name}: cannot be written (Is a directory)"
    assert [path.name for path in tmp_path.iterdir()] == [name]


@pytest.fixture(scope="module")
def small_disk(tmp_path_factory):
    folder = tmp_path_factory.mktemp("small")
    mount = ["mount", "-t", "tmpfs", "-o", "size=512k", "tmpfs", str(folder)]
    may = os.geteuid() == 0 and shutil.which("mount")
    if not may or subprocess.run(mount, capture_output=True, timeout=20).returncode != 0:
        pytest.skip("a small disk can be mounted by root only")
    yield folder
    subprocess.run(["umount", str(folder)], timeout=20, check=True)


@pytest.fixture
def empty_disk(small_disk):
    for path in small_disk.iterdir():
        path.unlink()
    return small_disk


@by_name
def test_a_full_disk(empty_disk, name, write):
    (empty_disk / name).write_bytes(b"what was there before")
    with pytest.raises(engine.FileError) as caught:
        write(empty_disk / name)
    assert str(caught.value) == f"{empty_disk / name}: cannot be written (No space left on device)"
    assert [path.name for path in empty_disk.iterdir()] == [name]
    assert (empty_disk / name).read_bytes() == b"what was there before"


@pytest.mark.parametrize("write", [frame, picture])
def test_a_disk_that_is_full_at_the_very_end(empty_disk, write):
    """The last bytes are flushed when the file is closed: an error there counts too."""
    path = empty_disk / "f.exr"
    small = np.ascontiguousarray(NOISE[:40, :200])
    engine.write_frame(str(path), small) if write is frame else engine.write_picture(str(path), small)
    size = path.stat().st_size
    path.unlink()
    with open(empty_disk / "ballast", "wb", buffering=0) as ballast:
        try:
            while ballast.write(bytes(4096)):
                pass
        except OSError:
            ballast.truncate(ballast.tell() - size // 4096 * 4096)
    with pytest.raises(engine.FileError, match="No space left on device"):
        engine.write_frame(str(path), small) if write is frame else engine.write_picture(str(path), small)
    assert [p.name for p in empty_disk.iterdir()] == ["ballast"]


def test_a_folder_that_may_not_be_written(tmp_path):
    program = (
        "import os, sys, numpy as np\nfrom stillwater import _stillwater as e\n"
        "if os.geteuid() == 0: os.setuid(65534)\n"
        "try: e.write_frame(sys.argv[1], np.ones((4, 4, 4)))\nexcept OSError as error: print(error)"
    )
    tmp_path.chmod(0o555)
    for folder in tmp_path.parents[:-2]:
        if os.geteuid() == 0:
            folder.chmod(folder.stat().st_mode | 0o011)
    path = tmp_path / "f.exr"
    run = subprocess.run([sys.executable, "-c", program, str(path)], capture_output=True, text=True, timeout=60)
    tmp_path.chmod(0o755)
    assert run.stdout == f"{path}: cannot be written (Permission denied)\n"


ENDLESS = """
import sys, numpy as np
from stillwater import _stillwater as engine
engine.install_signal_handler()
image = np.random.default_rng(1).random((1500, 1500, 4)).astype(np.float32)
print("ready", flush=True)
while True:
    engine.write_frame(sys.argv[1], image)
"""


@pytest.mark.parametrize(("number", "code"), [(signal.SIGTERM, 143), (signal.SIGINT, 130)])
def test_a_signal_in_the_middle_of_a_write(tmp_path, number, code):
    path = tmp_path / "f.exr"
    worker = subprocess.Popen([sys.executable, "-c", ENDLESS, str(path)], stdout=subprocess.PIPE)
    try:
        assert worker.stdout.readline() == b"ready\n"
        deadline = time.monotonic() + 30
        while not any(".tmp." in p.name and p.stat().st_size > 100_000 for p in tmp_path.iterdir()):
            assert time.monotonic() < deadline
            time.sleep(0.002)
        sent = time.monotonic()
        worker.send_signal(number)
        assert worker.wait(10) == code
        assert time.monotonic() - sent < 0.2
    finally:
        worker.kill()
        worker.wait(10)
    assert [p for p in tmp_path.iterdir() if p != path] == []


def test_what_a_killed_process_leaves_is_swept(tmp_path):
    path = tmp_path / "f.exr"
    worker = subprocess.Popen([sys.executable, "-c", ENDLESS, str(path)], stdout=subprocess.PIPE)
    try:
        assert worker.stdout.readline() == b"ready\n"
        deadline = time.monotonic() + 30
        while not (left := [p for p in tmp_path.iterdir() if ".tmp." in p.name and p.stat().st_size > 100_000]):
            assert time.monotonic() < deadline
            time.sleep(0.002)
        assert engine.sweep_temporaries(str(tmp_path)) == []
    finally:
        worker.kill()
        worker.wait(10)
    left = sorted(str(p) for p in tmp_path.iterdir() if p != path)
    assert len(left) == 1
    assert engine.sweep_temporaries(str(tmp_path)) == left
    assert [p for p in tmp_path.iterdir() if p != path] == []
