"""`stillwater inpaint PICTURE HOLE -o OUT`."""

import numpy as np
import pytest
import stillwater
from PIL import Image


@pytest.fixture
def files(tmp_path):
    """A picture with stripes, and a hole in it."""
    y, x = np.mgrid[:60, :80]
    picture = np.stack([120 + 90 * ((y // 6) % 2), 100 + x, 40 + y], axis=2)
    Image.fromarray(picture.astype(np.uint8)).save(tmp_path / "picture.png")
    hole = 255 * (np.hypot(y - 30, x - 40) < 10)
    Image.fromarray(hole.astype(np.uint8)).save(tmp_path / "hole.png")
    return tmp_path


def test_a_hole_is_filled(command, files):
    done = command("inpaint", files / "picture.png", files / "hole.png", "-o", files / "out.png")
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    out, picture = (np.asarray(Image.open(files / name), int)[..., :3] for name in ("out.png", "picture.png"))
    hole = np.asarray(Image.open(files / "hole.png")) > 0
    assert np.array_equal(out[~hole], picture[~hole])
    assert np.abs(out - picture)[hole].mean() < 12


def test_patch_radius_and_seed_are_those_of_the_function(command, files):
    options = ["--patch", "7", "--radius", "40", "--seed", "3"]
    assert (
        command("inpaint", files / "picture.png", files / "hole.png", "-o", files / "out.exr", *options).returncode == 0
    )
    picture, hole = stillwater.read(files / "picture.png"), stillwater.read(files / "hole.png")[..., 0]
    expected = stillwater.inpaint(picture, hole, patch=7, radius=40, seed=3)
    assert np.abs(stillwater.read(files / "out.exr") - expected).max() < 2e-3


@pytest.mark.parametrize(
    "change, sentence",
    [
        (["--patch", "8"], "stillwater: patch: 8 is not odd (px)\n"),
        (["--radius", "1"], "stillwater: radius: within 1 px of "),
        (["--seed", "-1"], "stillwater: argument --seed: -1 is not a number from 0 up"),
        (["--seed", "x"], "stillwater: argument --seed: x is not a number from 0 up"),
    ],
)
def test_bad_numbers_are_a_sentence(command, files, change, sentence):
    done = command("inpaint", files / "picture.png", files / "hole.png", "-o", files / "out.png", *change)
    assert done.returncode == 2 and done.stderr.startswith(sentence)
    assert not (files / "out.png").exists()


def test_files_that_are_not_there_or_don_t_fit_are_a_sentence(command, files):
    done = command("inpaint", files / "none.png", files / "hole.png", "-o", files / "out.png")
    assert done.returncode == 2 and "none.png" in done.stderr and done.stderr.count("\n") == 1
    Image.new("L", (5, 4)).save(files / "small.png")
    done = command("inpaint", files / "picture.png", files / "small.png", "-o", files / "out.png")
    assert (done.returncode, done.stderr) == (2, "stillwater: hole: 5 x 4 is not the size of the picture, 80 x 60\n")
    Image.new("L", (80, 60), 255).save(files / "all.png")
    done = command("inpaint", files / "picture.png", files / "all.png", "-o", files / "out.png")
    assert (done.returncode, done.stderr) == (
        2,
        "stillwater: hole: it covers the whole picture; nothing is left to copy from\n",
    )


def test_what_can_t_be_written_is_a_failure(command, files):
    done = command("inpaint", files / "picture.png", files / "hole.png", "-o", files / "nowhere" / "out.png")
    assert done.returncode == 1 and "nowhere" in done.stderr
