"""A file that says: one worker at a time.

Made in one step (it must not exist before), so that of several workers one has it. It names its machine and process
and is touched while the work goes on, its heartbeat; a lock whose worker is gone counts as free and is taken over.
The signal handler removes it when the worker is interrupted.
"""

import contextlib
import os
import secrets
import socket
import time
from collections.abc import Callable
from pathlib import Path

from .. import _stillwater as engine

SILENT = 60.0  # seconds without a heartbeat, after which a worker on another machine counts as gone
SILENT_HERE = 300.0  # the same on this machine, while a process of its number runs
UNSIGNED = 5.0  # seconds within which whoever made the file must have written its name into it
PATIENCE = 0.05  # seconds between two looks

_ours: set[str] = set()  # marks of the locks that this process has


def as_progress(beat: Callable[[], None]) -> Callable[[str, float], bool]:
    """What the engine tells its progress, for whoever only has to be called again and again."""

    def still_there(phase: str, share: float) -> bool:
        beat()
        return True

    return still_there


class Lock:
    """The lock at `path`; held between take() and release()."""

    def __init__(self, path: Path):
        self.path = path
        self._mark = ""
        self._file = None
        self._beat = 0.0

    def take(self) -> bool:
        """Takes the lock, if no worker that lives has it. Throws OSError where the file can't be made."""
        with engine.EndHeld():
            if not self._make():
                if holder(self.path) is not None:
                    return False
                self._clear_away()
                if not self._make():
                    return False
            self._file = engine.TemporaryFile(str(self.path))
        _ours.add(self._mark)
        return True

    def wait(self, between=lambda: None) -> None:
        """Takes the lock, after whoever has it."""
        while not self.take():
            between()
            time.sleep(PATIENCE)

    def beat(self) -> None:
        """Says that the worker lives, at most once a second."""
        if self._file is None or time.monotonic() - self._beat < 1:
            return
        self._beat = time.monotonic()
        try:
            os.utime(self.path)
        except OSError:
            pass  # taken away by somebody: the work is still good

    def release(self) -> None:
        self._file = None  # removes the file
        _ours.discard(self._mark)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.release()

    def _make(self) -> bool:
        self._mark = f"{socket.gethostname()} {os.getpid()} {secrets.token_hex(8)}"
        try:
            handle = os.open(self.path, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o666)
        except FileExistsError:
            return False
        with open(handle, "w") as file:
            file.write(self._mark)
        return True

    def _clear_away(self) -> None:
        """Removes a lock that nobody holds. One worker at a time looks and removes: what another one takes meanwhile stays."""
        guard = self.path.with_name(f"{self.path.name}.clearing")
        try:
            os.close(os.open(guard, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o666))
        except FileExistsError:
            with contextlib.suppress(FileNotFoundError):
                if time.time() - guard.stat().st_mtime > UNSIGNED:  # who made it is gone
                    guard.unlink()
            return
        try:
            if holder(self.path) is None:
                self.path.unlink(missing_ok=True)
        finally:
            guard.unlink(missing_ok=True)


def holder(path: Path) -> str | None:
    """Who holds the lock, "process 12 on HOST"; None where it is free, or its worker gone."""
    try:
        mark = path.read_text()
        silent = time.time() - path.stat().st_mtime
    except FileNotFoundError:
        return None
    words = mark.split()
    if len(words) != 3 or not words[1].isdigit():
        return "a worker that just starts" if silent < UNSIGNED else None
    host, process = words[0], int(words[1])
    if host == socket.gethostname():
        another = process != os.getpid() or mark in _ours  # a worker before us may have had our number
        alive = another and engine.process_runs(process) and silent < SILENT_HERE
    else:
        alive = silent < SILENT
    return f"process {process} on {host}" if alive else None
