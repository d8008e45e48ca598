"""The artist's guide names what is on the screen, and shows pictures that are there, small, and used."""

import re
from pathlib import Path

ADDON = Path(__file__).resolve().parents[2] / "addon"
GUIDE = (ADDON / "README.md").read_text()
SHOWN = set(re.findall(r"!\[[^\]]+\]\(([^)]+)\)", GUIDE))
LARGEST = 120_000  # bytes, a screenshot
# Where the extension says what is written on a button, a panel, a field, an item of a list.
WRITTEN = r'(?:bl_label = |bl_category = |name=|text=|fold\(\w+, "\w+", |\(\s*"[\w-]+", )"([^"]+)"'


def on_screen() -> set[str]:
    """Every word that the extension can write on a button, and the names of its presets."""
    sources = "\n".join(path.read_text() for path in ADDON.rglob("*.py"))
    presets = {path.stem.replace("_", " ") for path in ADDON.glob("layers/presets/**/*.json")}
    return set(re.findall(WRITTEN, sources)) | presets


def test_what_it_names_is_on_the_screen():
    named = set(re.findall(r"\*\*([^*]+)\*\*", GUIDE))
    assert len(named) > 40 and named - on_screen() == set()


def test_its_script_calls_what_there_is():
    operators = {name for path in ADDON.rglob("*.py") for name in re.findall(r'bl_idname = "(\S+)"', path.read_text())}
    called = set(re.findall(r"bpy\.ops\.(\w+\.\w+)\(", GUIDE))
    assert called and called <= operators


def test_its_links_lead_somewhere():
    links = set(re.findall(r"\]\(([^)#]+)\)", GUIDE))
    assert [link for link in links if not (ADDON / link).exists()] == []


def test_its_screenshots_are_small_and_all_of_them_are_shown():
    there = {f"guide/{path.name}": path.stat().st_size for path in (ADDON / "guide").iterdir()}
    assert set(there) == SHOWN
    assert {name: size for name, size in there.items() if size > LARGEST} == {}
