"""The engine's rooms stay in their order, its files short, and its AVX2 files free of code that others share."""

import re
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[2]
NATIVE = REPOSITORY / "native"
ROOMS = ["core", "picture", "patches", "layers", "motion", "flow", "appearance", "example", "library", "fluid", "morph"]
ROOMS += ["frame", "bindings"]
LONGEST = {".h": 500, ".cpp": 500, ".py": 500, ".sh": 500}
C_HEADERS = {"math.h", "stdint.h", "stddef.h", "string.h", "immintrin.h", "emmintrin.h", "smmintrin.h"}

SOURCES = sorted(path for room in ROOMS for path in (NATIVE / room).rglob("*") if path.suffix in (".h", ".cpp"))


def includes(path: Path) -> list[str]:
    return re.findall(r'^#include ["<]([^">]+)[">]', path.read_text(), re.MULTILINE)


def named(path: Path) -> str:
    return str(path.relative_to(REPOSITORY))


@pytest.mark.parametrize("source", SOURCES, ids=named)
def test_a_room_includes_only_itself_and_rooms_above(source):
    allowed = ROOMS[: ROOMS.index(source.relative_to(NATIVE).parts[0]) + 1]
    below = [name for name in includes(source) if (room := name.split("/")[0]) in ROOMS and room not in allowed]
    assert not below


@pytest.mark.parametrize("source", [path for path in SOURCES if path.stem.endswith("_avx2")], ids=named)
def test_a_file_for_avx2_includes_nothing_that_the_linker_could_share(source):
    headers = [name for name in includes(source) if name not in C_HEADERS]
    assert all(name.endswith(("_avx2.h", "_kernel.h")) for name in headers), headers


@pytest.mark.parametrize("header", [path for path in SOURCES if path.suffix == ".h"], ids=named)
def test_a_header_can_be_included_twice(header):
    assert "#pragma once" in header.read_text()


def test_no_file_holds_more_than_one_thing():
    written = [path for room in ("native", "addon", "tests", "blend_samples") for path in (REPOSITORY / room).rglob("*")]
    lengths = {named(p): len(p.read_text().splitlines()) for p in written if p.suffix in LONGEST}
    assert {name: lines for name, lines in lengths.items() if lines > LONGEST[Path(name).suffix]} == {}


def test_threads_come_through_one_door():
    doors = [path for path in SOURCES if re.search(r"parallel_for_|std::thread|std::async|#pragma omp", path.read_text())]
    # process.cpp: one that waits for the end of standard input and never computes.
    assert [named(path) for path in doors] == ["native/core/parallel.cpp", "native/core/process.cpp"]


def test_the_operating_system_is_called_in_one_file():
    system = r"#include <(unistd|signal|csignal|sys/\w+|windows|fcntl|io)\.?h?>"
    callers = [path for path in SOURCES if re.search(system, path.read_text())]
    assert [named(path) for path in callers] == ["native/core/process.cpp"]


def test_the_extension_finds_its_own_name_in_one_place():
    """Blender's preferences and folders of an extension are found by it."""
    finders = [path for path in (REPOSITORY / "addon").rglob("*.py") if "__package__" in path.read_text()]
    assert [named(path) for path in finders] == ["addon/preferences/__init__.py"]
