"""The worker process and its lines. Knows nothing of Blender.

The worker writes to files, not to pipes: nobody has to read for it to go on, and nothing here ever waits. It is given
an open standard input and `--parent`: where Blender ends, however it ends, the worker ends too.
"""

import contextlib
import json
import shutil
import signal
import subprocess
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

PATIENCE = 2.0  # s: how long a worker that was asked to end may take


class Worker:
    """One `python -m stillwater`: a bake, or the server of live work."""

    def __init__(self, command: list[str], scratch: str | None = None):
        """Starts `command`; its lines go to files below `scratch`. Throws OSError where it can't be started."""
        self._folder = Path(tempfile.mkdtemp(prefix="stillwater-", dir=scratch))
        self._said = self._folder / "progress.jsonl"
        self._complained = self._folder / "errors.txt"
        self._rest = b""
        self._asked = None
        try:
            with open(self._said, "wb") as said, open(self._complained, "wb") as complained:
                self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=said, stderr=complained)
            self._lines = open(self._said, "rb")  # noqa: SIM115  closed by close()
        except OSError:
            shutil.rmtree(self._folder)
            raise

    def poll(self) -> tuple[list[dict], int | None]:
        """What the worker said since the last call, and its exit code once it has ended."""
        code = self._process.poll()  # before reading: what it said last is not missed
        if code is None and self._asked is not None and time.monotonic() - self._asked > PATIENCE:
            self._process.kill()
        *lines, self._rest = (self._rest + self._lines.read()).split(b"\n")
        if code is not None:
            lines.append(self._rest)
        return [event for line in lines if (event := _event(line))], code

    def tell(self, request: dict) -> None:
        """Writes a line of JSON to its standard input. Throws OSError where it has ended."""
        self._process.stdin.write(json.dumps(request).encode() + b"\n")
        self._process.stdin.flush()

    def cancel(self) -> None:
        """Asks the worker to end; it is killed where it does not. Frames that are done stay."""
        if self._asked is None and self._process.poll() is None:
            self._asked = time.monotonic()
            self._process.terminate()

    def last_words(self) -> str:
        """The last line of its standard error."""
        lines = self._complained.read_text(errors="replace").strip().splitlines()
        return lines[-1] if lines else ""

    def close(self) -> None:
        """Ends the worker where it still runs, and removes what it wrote its lines to."""
        if self._process.poll() is None:
            self._process.kill()
        self._process.wait()
        with contextlib.suppress(OSError):  # a request that it never read
            self._process.stdin.close()
        self._lines.close()
        shutil.rmtree(self._folder, ignore_errors=True)


def _event(line: bytes) -> dict | None:
    """One line as an event; None for a line that is none (a library's own message)."""
    try:
        event = json.loads(line)
    except ValueError:
        return None
    return event if isinstance(event, dict) and isinstance(event.get("event"), str) else None


def ending(code: int, words: str, said: Callable[[str], str] = str) -> str:
    """A sentence for a worker that ended without saying why."""
    if code < 0:
        try:
            how = said("The worker was ended by {signal}").format(signal=signal.Signals(-code).name)
        except ValueError:
            how = said("The worker was ended by signal {number}").format(number=-code)
    else:
        how = said("The worker ended with code {code}").format(code=code)
    return f"{how}: {words}" if words else said("{how} and gave no reason").format(how=how)
