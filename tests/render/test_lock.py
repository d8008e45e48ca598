"""One worker at a time: taken, kept alive, given back, taken over from the dead."""

import os
import socket
import subprocess
import sys
import time

import pytest
from stillwater.render.lock import SILENT, SILENT_HERE, Lock, holder

HERE = socket.gethostname()


@pytest.fixture
def path(tmp_path):
    return tmp_path / "work.lock"


def leave(path, host, process, silent=0.0):
    path.write_text(f"{host} {process} {'0' * 16}")
    os.utime(path, (time.time() - silent,) * 2)


def dead_process():
    process = subprocess.Popen([sys.executable, "-c", ""])
    process.wait()
    return process.pid


def test_one_has_it_until_it_is_given_back(path):
    first, second = Lock(path), Lock(path)
    assert first.take() and not second.take()
    assert holder(path) == f"process {os.getpid()} on {HERE}"
    first.release()
    assert not path.exists() and second.take()


def test_a_lock_that_was_not_taken_gives_nothing_back(path):
    first, second = Lock(path), Lock(path)
    first.take()
    with second:
        assert not second.take()
    assert path.exists()


@pytest.mark.parametrize(
    "host, process, silent, held",
    [
        (HERE, os.getppid(), 0, True),
        (HERE, os.getppid(), SILENT + 5, True),
        (HERE, os.getppid(), SILENT_HERE + 5, False),
        (HERE, os.getpid(), 0, False),  # of a worker before us, whose number we have now
        (HERE, None, 0, False),
        ("elsewhere", 1, 0, True),
        ("elsewhere", 1, SILENT + 5, False),
    ],
)
def test_whose_worker_is_gone_is_free(path, host, process, silent, held):
    leave(path, host, dead_process() if process is None else process, silent)
    assert (holder(path) is not None) == held
    assert Lock(path).take() != held


def test_an_unsigned_lock_belongs_to_whoever_just_makes_it(path):
    path.touch()
    assert not Lock(path).take()
    os.utime(path, (time.time() - 10,) * 2)
    assert Lock(path).take()


def test_a_heartbeat_keeps_it(path):
    lock = Lock(path)
    lock.take()
    os.utime(path, (time.time() - 100,) * 2)
    lock.beat()
    assert time.time() - path.stat().st_mtime < 5


def test_waiting_ends_when_it_is_given_back(path):
    first, second, rounds = Lock(path), Lock(path), []
    first.take()
    second.wait(lambda: (rounds.append(1), first.release() if len(rounds) == 3 else None))
    assert len(rounds) == 3 and path.exists()


def test_of_many_workers_one_takes_over(path):
    leave(path, HERE, dead_process())
    program = (
        "import sys, time; from pathlib import Path; from stillwater.render.lock import Lock; import stillwater._stillwater;"
        "time.sleep(max(0, float(sys.argv[2]) - time.time()));"
        "print(Lock.take(lock := Lock(Path(sys.argv[1]))), flush=True); sys.stdin.read()"
    )
    start = str(time.time() + 1.0)
    workers = [
        subprocess.Popen([sys.executable, "-c", program, str(path), start], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        for _ in range(6)
    ]
    taken = [worker.stdout.readline() for worker in workers]
    for worker in workers:
        worker.communicate(timeout=20)
    assert taken.count("True\n") == 1, taken


def test_one_worker_at_a_time_clears_away(path):
    """What another one takes meanwhile stays; a guard whose worker is gone is no obstacle for ever."""
    leave(path, HERE, dead_process())
    guard = path.with_name(f"{path.name}.clearing")
    guard.touch()
    assert not Lock(path).take() and path.exists() and guard.exists()
    os.utime(guard, (1, 1))
    assert not Lock(path).take() and not guard.exists()
    lock = Lock(path)
    assert lock.take() and not guard.exists()
    lock.release()
    assert not path.exists()
