"""Files that are wrong: one sentence, exit code 2, nothing written."""

import struct
import zlib

import numpy as np
import pytest
from PIL import Image
from stillwater import _stillwater as engine


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png_of_size(width, height):
    """A PNG that says so in its header and holds next to nothing."""
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(b"")) + chunk(b"IEND", b"")


def missing(path):
    path.unlink()


def empty(path):
    path.write_bytes(b"")


def truncated(path):
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])


def no_image(path):
    path.write_text("Once upon a time there was a picture.\n" * 20)


def folder(path):
    path.unlink()
    path.mkdir()


def nothing(path):
    path.write_bytes(png_of_size(0, 0))


def huge(path):
    path.write_bytes(png_of_size(30000, 30000))


def other_size(path):
    Image.new("L", (20, 10)).save(path)


PICTURE, LABELS, TREE = "picture.png", "labels.png", "tree.png"
PLACES = {PICTURE: "picture", LABELS: "layers[0].matte.labels", TREE: "layers[2].matte.file"}
CASES = [
    *((name, harm) for name in PLACES for harm in (missing, empty, truncated, no_image, folder, nothing, huge)),
    (LABELS, other_size),
    (TREE, other_size),
]
WORDS = {missing: "there is no such file", folder: "folder", huge: "30000", other_size: "20 x 10 is not the size of the picture, 48 x 36"}


@pytest.mark.parametrize("name, harm", CASES, ids=[f"{name}-{harm.__name__}" for name, harm in CASES])
def test_a_wrong_file(scene, tmp_path, command, name, harm):
    path = scene()
    harm(tmp_path / name)
    before = sorted(tmp_path.rglob("*"))
    done = command("render", path)
    assert (done.returncode, done.stdout) == (2, "")
    said = done.stderr.splitlines()
    assert said[0].startswith(f"stillwater: {path}: {PLACES[name]}: "), done.stderr
    assert WORDS.get(harm, name) in said[0]
    layers = {line.split(": ")[2] for line in said}
    assert len(layers) == len(said)  # one sentence a place
    assert sorted(tmp_path.rglob("*")) == before


def test_all_wrong_files_come_at_once(scene, tmp_path, command):
    path = scene()
    (tmp_path / TREE).unlink()
    (tmp_path / PICTURE).unlink()
    assert command("render", path).stderr.splitlines() == [
        f"stillwater: {path}: picture: {tmp_path}/picture.png: there is no such file",
        f"stillwater: {path}: layers[2].matte.file: {tmp_path}/tree.png: there is no such file",
    ]


def test_a_painted_background_of_another_size(scene, tmp_path, command):
    path = scene(lambda recipe: recipe["layers"][1].update(fill={"file": "painted.png"}))
    Image.new("RGB", (5, 5)).save(tmp_path / "painted.png")
    done = command("render", path)
    assert (done.returncode, done.stderr) == (
        2, f"stillwater: {path}: layers[1].fill.file: painted.png: 5 x 5 is not the size of the picture, 48 x 36\n"
    )  # fmt: skip


def test_a_channel_that_is_not_there(scene, command):
    done = command("render", scene(lambda recipe: recipe["layers"][2]["matte"].update(channel="depth")))
    assert done.returncode == 2
    assert "layers[2].matte.file: " in done.stderr and "depth is not one of its channels" in done.stderr


@pytest.mark.parametrize("horizon", [[[0, 36], [48, 36]], [[0, 60], [48, 50]], [[48, 40], [0, 37]]])
def test_a_horizon_below_all_water(scene, tmp_path, command, horizon):
    path = scene(lambda recipe: recipe["view"].update(horizon=horizon))
    before = sorted(tmp_path.rglob("*"))
    done = command("render", path)
    line = [[float(x), float(y)] for x, y in horizon]
    assert (done.returncode, done.stderr) == (
        2,
        f"stillwater: {path}: view.horizon: {line} is not above any part of layers[3], a ripple"
        " (water lies below the horizon)\n",
    )
    assert sorted(tmp_path.rglob("*")) == before


@pytest.mark.parametrize("horizon", [[[0, -500], [48, -400]], [[0, 30], [48, 18]], [[0, 35], [48, 35]]])
def test_a_horizon_outside_the_picture_or_within_the_water_is_fine(scene, command, horizon):
    assert command("render", scene(lambda recipe: recipe["view"].update(horizon=horizon)), "--frames", "1").returncode == 0


def test_pixels_that_are_no_numbers_are_counted_and_rendered(scene, tmp_path, command):
    picture = np.full((36, 48, 4), 0.5, np.float32)
    picture[1, 2, 0], picture[3, 4, 1] = np.nan, np.inf
    engine.write_frame(str(tmp_path / "bad.exr"), picture, options=engine.FrameOptions(half=False))
    done = command("render", scene(lambda recipe: recipe.update(picture="bad.exr")), "--frames", "1")
    assert done.returncode == 0
    assert "warning: picture: 2 pixels are not finite numbers and count as 0\n" in done.stderr
    assert np.isfinite(engine.read_frame(str(tmp_path / "frames" / "frame_0001.exr"))).all()


def test_a_recipe_that_is_wrong_is_not_rendered(scene, tmp_path, command):
    path = scene(lambda recipe: recipe.update(frames=[6, 1]))
    done = command("render", path)
    assert (done.returncode, done.stderr) == (
        2, f"stillwater: {path}: frames: [6, 1] runs backwards (the first is not above the last)\n"
    )  # fmt: skip
    assert not (tmp_path / "frames").exists() and not (tmp_path / ".stillwater-cache").exists()
