"""Preparations are kept whole or not at all, found again, and the oldest go first."""

import json
import os
import time

import numpy as np
import pytest
from stillwater.render import cache as cache_module
from stillwater.render.cache import Cache, Prepared


@pytest.fixture
def cache(tmp_path):
    return Cache(tmp_path / "cache")


def something(size=100, fill=1.0):
    return Prepared({"a": np.full((size, 4), fill, np.float32), "b": np.arange(5, dtype=np.float32)}, {"boxes": [[1, 2]]})


def test_nothing_is_written_until_something_is_kept(cache):
    assert cache.find("key") is None
    assert not cache.folder.exists()


def test_what_is_kept_is_found_again_mapped(cache):
    cache.store("key", something())
    found = Cache(cache.folder).find("key")
    assert found.facts == {"boxes": [[1, 2]]}
    assert all(isinstance(array, np.memmap) for array in found.arrays.values())
    np.testing.assert_array_equal(found.arrays["a"], something().arrays["a"])


def test_no_half_written_preparation_is_ever_seen(cache, monkeypatch):
    seen = []
    whole = cache_module._write_array
    monkeypatch.setattr(cache_module, "_write_array", lambda *a: (seen.append(Cache(cache.folder).find("key")), whole(*a)))
    cache.store("key", something())
    assert seen == [None, None] and [path.name for path in cache.folder.iterdir()] == ["key"]


@pytest.mark.parametrize("harm", [lambda p: (p / "a.npy").unlink(), lambda p: (p / "meta.json").write_text("{"),
                                  lambda p: (p / "b.npy").write_bytes(b"\x93NUMPY")])  # fmt: skip
def test_a_damaged_preparation_is_none(cache, harm):
    cache.store("key", something())
    harm(cache.folder / "key")
    assert Cache(cache.folder).find("key") is None
    cache.store("key", something())
    assert Cache(cache.folder).find("key") is not None


def test_the_least_recently_used_go_first(tmp_path):
    size = sum(a.nbytes for a in something(1000).arrays.values())
    for i, key in enumerate(("old", "older", "used")):
        Cache(tmp_path).store(key, something(1000))
        os.utime(tmp_path / key / "meta.json", (time.time() - 1000 + (i != 1),) * 2)
    Cache(tmp_path).find("used")
    Cache(tmp_path, limit=int(3.5 * size)).store("new", something(1000))
    assert sorted(path.name for path in tmp_path.iterdir()) == ["new", "old", "used"]


def test_what_is_in_use_stays_whatever_the_limit(tmp_path):
    cache = Cache(tmp_path, limit=10)
    cache.store("one", something())
    cache.store("two", something())
    assert cache.find("one") and cache.find("two")


def test_a_folder_that_cannot_be_written_is_a_warning(tmp_path):
    (tmp_path / "cache").write_text("a file stands in its place")
    cache = Cache(tmp_path / "cache")
    with cache.lock("key"):
        kept = cache.store("key", something())
    np.testing.assert_array_equal(kept.arrays["a"], something().arrays["a"])
    assert cache.trouble == f"{tmp_path}/cache: cannot be written (Not a directory); preparations are kept in memory only"


def test_leavings_of_dead_workers_are_swept_and_those_of_living_ones_are_not(cache):
    cache.store("key", something())
    import socket

    dead, alive = (cache.folder / f"new-{socket.gethostname()}-{process}-0" for process in (2**22 + 1, os.getpid()))
    dead.mkdir()
    (dead / "a.npy").write_text("half")
    alive.mkdir()
    cache.sweep()
    assert not dead.exists() and alive.exists()


class TestDigests:
    def test_a_file_is_known_by_what_it_holds(self, cache, tmp_path):
        (tmp_path / "a").write_text("same")
        (tmp_path / "b").write_text("same")
        (tmp_path / "c").write_text("other")
        a, b, c = (cache.digest(tmp_path / name) for name in "abc")
        assert a == b != c

    def test_it_is_read_once(self, cache, tmp_path):
        path = tmp_path / "a"
        path.write_text("first")
        os.utime(path, (1e9, 1e9))
        before = cache.digest(path)
        cache.keep_digests()
        path.write_text("other")
        os.utime(path, (1e9, 1e9))  # as if it had not been touched
        assert Cache(cache.folder).digest(path) == before
        os.utime(path, (1e9, 1e9 + 1))
        assert Cache(cache.folder).digest(path) != before

    def test_a_file_changed_just_now_is_read_again(self, cache, tmp_path):
        path = tmp_path / "a"
        path.write_text("first")
        state = path.stat()
        before = cache.digest(path)
        path.write_text("other")
        os.utime(path, ns=(state.st_atime_ns, state.st_mtime_ns))
        assert cache.digest(path) != before

    def test_a_damaged_memory_is_forgotten(self, cache, tmp_path):
        cache.folder.mkdir()
        (cache.folder / "files.json").write_text(json.dumps([1]))
        (tmp_path / "a").write_text("x")
        assert Cache(cache.folder).digest(tmp_path / "a")
