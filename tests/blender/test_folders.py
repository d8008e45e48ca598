"""Which folder is which picture's, and what of it may be deleted."""

import importlib.util
import json
from pathlib import Path

import pytest

SOURCE = Path(__file__).resolve().parents[2] / "addon" / "bake" / "folders.py"
spec = importlib.util.spec_from_file_location("plain_folders", SOURCE)
folders = importlib.util.module_from_spec(spec)
spec.loader.exec_module(folders)


def test_a_picture_keeps_its_folder_under_any_name(tmp_path):
    first = folders.folder_for(tmp_path, "a1", "Lake")
    assert first == tmp_path / "Lake" and first.is_dir()
    assert folders.folder_for(tmp_path, "a1", "Pond") == first == folders.known_folder(tmp_path, "a1")
    assert json.loads((tmp_path / "pictures.json").read_text()) == {"a1": "Lake"}


def test_two_pictures_of_one_name_have_two_folders(tmp_path):
    pictures = (("a", "Lake"), ("b", "Lake"), ("c", "lake"))
    names = [folders.folder_for(tmp_path, key, name).name for key, name in pictures]
    assert names == ["Lake", "Lake.001", "lake.002"]  # also where a disk knows no capitals


@pytest.mark.parametrize("name, wanted", [("a/b c", "a_b_c"), ("", "picture"), ("Frühe See", "Frühe_See")])
def test_any_name_is_a_folder(tmp_path, name, wanted):
    assert folders.folder_for(tmp_path, "a", name).name == wanted


def test_a_folder_from_before_there_was_an_index_is_found_again(tmp_path):
    (tmp_path / "Lake" / "frames").mkdir(parents=True)
    assert folders.known_folder(tmp_path, "a") is None
    assert folders.folder_for(tmp_path, "a", "Lake") == tmp_path / "Lake"


@pytest.mark.parametrize("text", ["", "[1]", '{"a": 1}', "{"])
def test_an_index_that_is_none_is_written_anew(tmp_path, text):
    (tmp_path / "pictures.json").write_text(text)
    assert folders.folder_for(tmp_path, "a", "Lake") == tmp_path / "Lake"
    assert json.loads((tmp_path / "pictures.json").read_text()) == {"a": "Lake"}


def test_a_folder_moves_over_another(tmp_path):
    for place, text in (("old/frames", "new"), ("target/frames", "old")):
        (tmp_path / place).mkdir(parents=True)
        (tmp_path / place / "frame_0001.exr").write_text(text)
    (tmp_path / "target" / "note.txt").write_text("kept")
    (tmp_path / "old" / "recipe.json").write_text("{}")
    folders.move(tmp_path / "old", tmp_path / "target")
    assert (tmp_path / "target" / "frames" / "frame_0001.exr").read_text() == "new"
    assert not (tmp_path / "old").exists()
    assert sorted(path.name for path in (tmp_path / "target").iterdir()) == ["frames", "note.txt", "recipe.json"]


def test_only_ours_is_deleted(tmp_path):
    folder = folders.folder_for(tmp_path / "stillwater", "a", "Lake")
    folders.folder_for(tmp_path / "stillwater", "b", "Pond")
    for name in ("recipe.json", "frames/frame_0001.exr", "frames/frame_12345.exr", ".stillwater-cache/x"):
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).touch()
    files = folders.Files(folder, folder / "frames", "frame", "a")
    for name in ("frames/frame_1.exr", "frames/other_0001.exr", "notes.txt"):
        (folder / name).touch()
    assert files.delete() == 4
    assert sorted(path.name for path in folder.rglob("*")) == ["frame_1.exr", "frames", "notes.txt", "other_0001.exr"]
    for name in ("frames/frame_1.exr", "frames/other_0001.exr", "notes.txt"):
        (folder / name).unlink()
    (folder / "recipe.json").touch()
    assert files.delete() == 1
    assert {path.name for path in (tmp_path / "stillwater").iterdir()} == {"pictures.json", "Pond"}
    assert json.loads((tmp_path / "stillwater" / "pictures.json").read_text()) == {"b": "Pond"}
