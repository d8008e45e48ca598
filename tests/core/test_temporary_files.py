"""Temporary files: their names say whose they are, and only what nobody writes any more is swept."""

import os
import socket
import subprocess
import sys
from pathlib import Path

import pytest
from stillwater import _stillwater as engine


def dead_process():
    ended = subprocess.Popen([sys.executable, "-c", ""])
    ended.wait(30)
    return ended.pid


def test_a_temporary_name_stands_beside_the_file_and_tells_host_and_process():
    expected = f"some/folder/.frame_0001.{socket.gethostname()}.{os.getpid()}.tmp.exr"
    assert engine.temporary_name("some/folder/frame_0001.exr") == expected
    assert "/" not in engine.temporary_name("frame.exr")


def test_only_what_dead_processes_of_this_machine_left_is_swept(tmp_path):
    host, dead = socket.gethostname(), dead_process()
    left = [f".frame_0001.{host}.{dead}.tmp.exr", f".a.b.{host}.{dead}.tmp.npy", f".own.{host}.{os.getpid()}.tmp.exr"]
    kept = [
        f".frame_0002.{host}.{os.getppid()}.tmp.exr",  # another process that runs
        f".frame_0003.elsewhere-{host}.{dead}.tmp.exr",  # another machine's
        f"frame_0004.{host}.{dead}.tmp.exr",
        f".frame_0005.{host}.{dead}.exr",
        f".frame_0006.{host}.{dead}x.tmp.exr",
        f".frame_0007.{host}.-1.tmp.exr",
        f".frame_0008.{host}.99999999999999999999.tmp.exr",
        f".{host}.{dead}.tmp.exr",
        ".tmp.exr",
        "frame_0001.exr",
        ".hidden",
    ]
    for name in left + kept:
        (tmp_path / name).write_bytes(b"x")
    assert engine.sweep_temporaries(str(tmp_path)) == sorted(str(tmp_path / name) for name in left)
    assert sorted(p.name for p in tmp_path.iterdir()) == sorted(kept)


def test_a_folder_that_is_not_there_holds_nothing(tmp_path):
    assert engine.sweep_temporaries(str(tmp_path / "none")) == []


def test_a_file_is_no_folder_to_sweep(tmp_path):
    (tmp_path / "file").touch()
    with pytest.raises(OSError, match=r"file: cannot be swept \(Not a directory\)$"):
        engine.sweep_temporaries(str(Path(tmp_path / "file")))
