"""Leaving: on a signal, and when whoever started the process is gone; temporary files go with it."""

import os
import signal
import subprocess
import sys
import time

import pytest
from stillwater import _stillwater as engine

START = "from stillwater import _stillwater as e; e.install_signal_handler(); f = e.TemporaryFile({path!r});"
START += "open({path!r}, 'w').close();"
BUSY = "print('busy', flush=True); e.random_uniform(1); x = sum(i for i in range(10**12))"


@pytest.fixture
def busy(tmp_path):
    """A process that is deep in work and holds a temporary file."""
    started = []

    def start(line="", **how):
        program = START.format(path=str(tmp_path / "half.exr")) + line + BUSY
        process = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True, **how)
        started.append(process)
        assert process.stdout.readline() == "busy\n"
        return process

    yield start
    for process in started:
        process.kill()
        process.wait()


@pytest.mark.parametrize("number, code", [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_a_signal_ends_the_process_at_once_and_cleans_up(busy, tmp_path, number, code):
    process = busy()
    start = time.monotonic()
    process.send_signal(number)
    assert process.wait(10) == code
    assert time.monotonic() - start < 0.2
    assert list(tmp_path.iterdir()) == []


HELD = """
import os, sys, time
from stillwater import _stillwater as e
e.install_signal_handler()
with e.EndHeld():
    open(sys.argv[1], "w").close()
    print("made", flush=True)
    time.sleep(0.05)
    file = e.TemporaryFile(sys.argv[1])
time.sleep(10)
"""


@pytest.mark.parametrize("number, code", [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_a_file_that_is_just_made_is_cleaned_up_too(tmp_path, number, code):
    process = subprocess.Popen([sys.executable, "-c", HELD, tmp_path / "lock"], stdout=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "made\n"
    process.send_signal(number)
    assert process.wait(10) == code
    assert list(tmp_path.iterdir()) == []


def test_who_holds_for_ever_is_not_waited_for(tmp_path):
    line = "e.end_with_standard_input(); held = e.EndHeld(); held.__enter__();"
    program = START.format(path=str(tmp_path / "half.exr")) + line + BUSY
    process = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, stdin=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "busy\n"
    start = time.monotonic()
    process.stdin.close()
    assert process.wait(10) == 143
    assert time.monotonic() - start < 0.3 and list(tmp_path.iterdir()) == []


def test_the_end_of_standard_input_ends_the_process(busy, tmp_path):
    process = busy("e.end_with_standard_input();", stdin=subprocess.PIPE)
    process.stdin.write("what is read is thrown away\n" * 100)
    process.stdin.flush()
    time.sleep(0.1)
    assert process.poll() is None
    start = time.monotonic()
    process.stdin.close()
    assert process.wait(10) == 143
    assert time.monotonic() - start < 0.2
    assert list(tmp_path.iterdir()) == []


def test_a_process_runs_until_it_is_over():
    process = subprocess.Popen(["sleep", "60"])
    assert engine.process_runs(process.pid)
    process.kill()
    process.wait()
    assert not engine.process_runs(process.pid)
    assert engine.process_runs(os.getpid()) and engine.process_runs(1)


def test_a_temporary_file_is_kept_or_gone(tmp_path):
    (tmp_path / "a").write_text("whole")
    engine.TemporaryFile(str(tmp_path / "a")).keep_as(str(tmp_path / "b"))
    assert [(path.name, path.read_text()) for path in tmp_path.iterdir()] == [("b", "whole")]
    (tmp_path / "c").write_text("half")
    file = engine.TemporaryFile(str(tmp_path / "c"))
    del file
    assert not (tmp_path / "c").exists()


def test_a_temporary_file_that_cannot_be_renamed_is_a_sentence(tmp_path):
    (tmp_path / "a").write_text("whole")
    with pytest.raises(engine.FileError, match=r"none/b: cannot be written \(No such file or directory\)"):
        engine.TemporaryFile(str(tmp_path / "a")).keep_as(str(tmp_path / "none" / "b"))
