"""Preparations, kept in a folder beside the recipe under the hash of all that they depend on.

A preparation is a folder of .npy files and a meta.json, written under another name and renamed. Arrays come back
mapped, not read. The least recently used go first when the folder grows beyond its limit.
"""

import contextlib
import hashlib
import json
import os
import secrets
import shutil
import socket
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .. import _stillwater as engine
from .lock import Lock

FOLDER = ".stillwater-cache"
LIMIT = 4_000_000_000  # bytes
FRESH = 2.0  # seconds: a file changed so shortly ago may change again without a new time


@dataclass(frozen=True)
class Prepared:
    """What a preparation gave: arrays by name, and a few facts that JSON can say."""

    arrays: dict[str, np.ndarray]
    facts: dict


class Cache:
    """The cache in `folder`, which is made when first written. `trouble` says why it can't be written, if so."""

    def __init__(self, folder: Path, limit: int = LIMIT):
        self.folder, self.limit = folder, limit
        self.trouble: str | None = None
        self._digests = self._read_digests()
        self._new_digests = False
        self._in_use: set[str] = set()

    def find(self, key: str) -> Prepared | None:
        """The preparation with this key, if it is there, whole."""
        place = self.folder / key
        try:
            facts = json.loads((place / "meta.json").read_text())
            arrays = {path.stem: np.load(path, mmap_mode="r") for path in sorted(place.glob("*.npy"))}
        except (OSError, ValueError):
            return None
        if len(arrays) != facts.pop("arrays", None):
            return None
        with contextlib.suppress(OSError):
            os.utime(place / "meta.json")
        self._in_use.add(key)
        return Prepared(arrays, facts)

    def store(self, key: str, prepared: Prepared) -> Prepared:
        """Keeps a preparation and answers it as find() does; as it is where the cache can't be written."""
        aside = self.folder / f"new-{socket.gethostname()}-{os.getpid()}-{secrets.token_hex(4)}"
        try:
            aside.mkdir(parents=True)
            for name, array in prepared.arrays.items():
                _write_array(aside / f"{name}.npy", np.ascontiguousarray(array))
            (aside / "meta.json").write_text(json.dumps({**prepared.facts, "arrays": len(prepared.arrays)}))
            shutil.rmtree(self.folder / key, ignore_errors=True)
            os.rename(aside, self.folder / key)
        except OSError as error:
            self._note(error)
            shutil.rmtree(aside, ignore_errors=True)
            return prepared
        self._in_use.add(key)
        self._trim()
        return self.find(key) or prepared

    @contextlib.contextmanager
    def lock(self, key: str, beat: Callable[[], None] = lambda: None) -> Iterator[Callable[[], None]]:
        """One worker at a time prepares what has this key. `beat` is called while another one does; whoever has the lock calls
        what comes instead, again and again: `beat`, and the lock's own."""
        lock = Lock(self.folder / f"{key}.lock")
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            lock.wait(beat)
        except OSError as error:
            self._note(error)

        def still_there() -> None:
            beat()
            lock.beat()

        with lock:
            yield still_there

    def known(self, path: Path) -> str | None:
        """The hash of a file's bytes where it is remembered by size and time. Throws OSError where there is no file."""
        state = path.stat()
        known = self._digests.get(str(path.resolve()))
        return known[2] if known and known[:2] == [state.st_size, state.st_mtime_ns] else None

    def learn(self, digests: dict[str, list]) -> None:
        """Remembers what another process found: size, time in ns and hash by the file's path."""
        self._digests |= digests

    def digest(self, path: Path) -> str:
        """The hash of a file's bytes, remembered by its size and time. Throws OSError where it can't be read."""
        if known := self.known(path):
            return known
        state = path.stat()
        facts = [state.st_size, state.st_mtime_ns]
        with open(path, "rb") as file:
            digest = hashlib.file_digest(file, lambda: hashlib.blake2b(digest_size=16)).hexdigest()
        if time.time() - state.st_mtime > FRESH:
            self._digests[str(path.resolve())] = [*facts, digest]
            self._new_digests = True
        return digest

    def keep_digests(self) -> None:
        """Writes down what digest() found, for the next run."""
        if not self._new_digests:
            return
        aside = self.folder / f"new-{socket.gethostname()}-{os.getpid()}-{secrets.token_hex(4)}.json"
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            aside.write_text(json.dumps(self._digests))
            os.replace(aside, self.folder / "files.json")
            self._new_digests = False
        except OSError as error:
            self._note(error)
            with contextlib.suppress(OSError):
                aside.unlink()

    def forget(self, key: str) -> None:
        """Removes a preparation and those made from it (their fact "of"). Throws OSError."""
        for place in self._places():
            if place.name == key or _facts(place).get("of") == key:
                shutil.rmtree(place)

    def facts(self) -> dict[str, dict]:
        """The facts of all preparations by key; their arrays are not opened."""
        return {place.name: _facts(place) for place in self._places()}

    def size(self) -> int:
        """Bytes of all preparations."""
        return sum(_size(place) for place in self._places())

    def sweep(self) -> None:
        """Removes what workers of this machine that are gone left half written."""
        for aside in self.folder.glob(f"new-{socket.gethostname()}-*"):
            process = aside.name.removeprefix(f"new-{socket.gethostname()}-").split("-")[0]
            if process.isdigit() and not engine.process_runs(int(process)):
                with contextlib.suppress(OSError):
                    shutil.rmtree(aside) if aside.is_dir() else aside.unlink()

    def _places(self) -> list[Path]:
        return [meta.parent for meta in self.folder.glob("*/meta.json") if not meta.parent.name.startswith("new-")]

    def _trim(self) -> None:
        places = {place: _size(place) for place in self._places()}
        total = sum(places.values())
        for place in sorted(places, key=_last_used):
            if total <= self.limit:
                return
            if place.name not in self._in_use:
                shutil.rmtree(place, ignore_errors=True)
                total -= places[place]

    def _note(self, error: OSError) -> None:
        self.trouble = f"{self.folder}: cannot be written ({error.strerror}); preparations are kept in memory only"

    def _read_digests(self) -> dict:
        try:
            digests = json.loads((self.folder / "files.json").read_text())
        except (OSError, ValueError):
            return {}
        return digests if isinstance(digests, dict) else {}


def _write_array(path: Path, array: np.ndarray) -> None:
    """An .npy file. np.save would not tell why a disk took only a part of it."""
    with open(path, "wb") as file:
        np.lib.format.write_array_header_1_0(file, np.lib.format.header_data_from_array_1_0(array))
        file.write(array.data)


def _facts(place: Path) -> dict:
    try:
        return json.loads((place / "meta.json").read_text())
    except (OSError, ValueError):  # another worker removed it, or it is none
        return {}


def _size(place: Path) -> int:
    try:
        return sum(path.stat().st_size for path in place.iterdir())
    except OSError:  # another worker removed it
        return 0


def _last_used(place: Path) -> float:
    try:
        return (place / "meta.json").stat().st_mtime
    except OSError:
        return 0.0
