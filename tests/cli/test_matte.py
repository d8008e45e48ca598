"""`stillwater matte`: what it writes, and what it says of bad input."""

import json

import numpy as np
import pytest
import stillwater
from PIL import Image
from stillwater import _stillwater as engine

FOREGROUND, BACKGROUND = {"points": [[20, 12], [28, 12]], "width": 4}, {"points": [[4, 4], [4, 20], [40, 20]], "width": 3}
SCRIBBLES = {"foreground": [FOREGROUND], "background": [BACKGROUND]}


@pytest.fixture
def folder(tmp_path):
    rng = np.random.default_rng(1)
    y, x = np.mgrid[:24, :48]
    inside = (np.hypot((x - 24) / 2, y - 12) < 6)[..., None]
    picture = np.where(inside, [230, 140, 40], [30, 60, 120]) + rng.integers(-9, 9, (24, 48, 3))
    Image.fromarray(picture.astype(np.uint8)).save(tmp_path / "picture.png")
    (tmp_path / "scribbles.json").write_text(json.dumps(SCRIBBLES))
    trimap = np.full((24, 48), 128, np.uint8)
    trimap[10:14, 20:28], trimap[:3] = 255, 0
    Image.fromarray(trimap).save(tmp_path / "trimap.png")
    return tmp_path


@pytest.fixture
def cut(folder, command):
    def run(*arguments):
        return command("matte", "picture.png", *arguments, "-o", "alpha.png", cwd=folder)

    return run


def right(alpha):
    assert alpha[12, 24] == 1 and alpha[2, 2] == 0 and alpha[22, 44] < 0.1 and alpha[12, 15] > 0.9


def test_scribbles_cut_out(cut, folder):
    done = cut("--scribbles", "scribbles.json", "--foreground", "front.png")
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    alpha = engine.read_matte(str(folder / "alpha.png"), "A")
    right(alpha)
    front = stillwater.read(folder / "front.png")
    assert np.abs(front[..., 3] - alpha).max() < 0.01
    assert np.abs(front[12, 24, :3] - np.array([230, 140, 40]) / 255).max() < 0.06


def test_a_trimap_cuts_out(cut, folder):
    assert cut("--trimap", "trimap.png").returncode == 0
    right(engine.read_matte(str(folder / "alpha.png"), "A"))


@pytest.mark.parametrize("form", [{"scribbles": SCRIBBLES, "method": "bayesian"}, {"lasso": [[8, 3], [40, 3], [40, 21], [8, 21]], "feather": 4}])
def test_the_recipes_matte_forms_do_too(cut, folder, form):
    (folder / "form.json").write_text(json.dumps(form))
    done = cut("--scribbles", "form.json")
    assert (done.returncode, done.stderr) == (0, "")
    alpha = engine.read_matte(str(folder / "alpha.png"), "A")
    assert alpha[12, 24] > 0.95 and alpha[1, 1] == 0


def test_the_method_is_the_commands_or_the_files(cut, folder):
    def alpha(*arguments):
        assert cut(*arguments).returncode == 0
        return engine.read_matte(str(folder / "alpha.png"), "A")

    (folder / "form.json").write_text(json.dumps({"scribbles": SCRIBBLES, "method": "bayesian"}))
    closed, bayesian = alpha("--scribbles", "scribbles.json"), alpha("--scribbles", "scribbles.json", "--method", "bayesian")
    assert not np.array_equal(closed, bayesian)
    assert np.array_equal(alpha("--scribbles", "form.json"), bayesian)
    assert np.array_equal(alpha("--scribbles", "form.json", "--method", "closed-form"), closed)


@pytest.mark.parametrize("name", ["alpha.exr", "alpha.tif", "alpha.PNG"])
def test_every_format_gives_the_matte_back(folder, command, name):
    for path in ("alpha.png", name):
        assert command("matte", "picture.png", "--scribbles", "scribbles.json", "-o", path, cwd=folder).returncode == 0
    read = [engine.read_matte(str(folder / path), "A") for path in ("alpha.png", name)]
    assert np.abs(read[0] - read[1]).max() < 0.003


def test_a_picture_with_alpha_is_said(cut, folder):
    picture = Image.open(folder / "picture.png").convert("RGBA")
    picture.putpixel((47, 23), (0, 0, 0, 0))
    picture.save(folder / "picture.png")
    done = cut("--scribbles", "scribbles.json")
    assert done.returncode == 0
    assert done.stderr == "stillwater: warning: picture.png: has an alpha of its own; the matte is solved over black\n"


def test_a_trimap_without_unknown_is_the_matte(cut, folder):
    hard = np.zeros((24, 48), np.uint8)
    hard[5:9, 5:9] = 255
    Image.fromarray(hard).save(folder / "trimap.png")
    assert cut("--trimap", "trimap.png").returncode == 0
    assert np.array_equal(engine.read_matte(str(folder / "alpha.png"), "A"), hard / 255)


def scribbles(**changes):
    return lambda folder: (folder / "scribbles.json").write_text(json.dumps(SCRIBBLES | changes))


def written(name, text):
    return lambda folder: (folder / name).write_bytes(text)


def grey(value, size=(48, 24)):
    return lambda folder: Image.new("L", size, value).save(folder / "trimap.png")


def gone(name):
    return lambda folder: (folder / name).unlink()


@pytest.mark.parametrize(
    "source, harm, sentence",
    [
        ("scribbles", scribbles(foreground=[]), "scribbles.json: scribbles.foreground: no stroke is not one stroke or more"),
        ("scribbles", scribbles(background=[]), "scribbles.json: scribbles.background: no stroke is not one stroke or more"),
        ("scribbles", scribbles(background=[{"points": [[99, 99]]}]), "scribbles.json: scribbles.background: no stroke touches the picture"),
        ("scribbles", scribbles(background=[BACKGROUND, FOREGROUND]),
         "scribbles.json: scribbles: foreground[0] and background[1] contradict each other at [19, 10] (a pixel is one or the other)"),
        ("scribbles", scribbles(background=[{"points": [[1, 2]], "width": 0}]), "scribbles.json: background[0].width: 0 is not above 0 (px)"),
        ("scribbles", written("scribbles.json", b"{"), "scribbles.json: recipe: not JSON (line 1, column 2: "
         "Expecting property name enclosed in double quotes)"),
        ("scribbles", written("scribbles.json", b"[1]"), "scribbles.json: [1] is neither scribbles (foreground, background) nor a lasso"),
        ("scribbles", gone("scribbles.json"), "scribbles.json: there is no such file"),
        ("trimap", grey(128), "trimap.png: all of it is unknown (some pixels must be foreground, and some background)"),
        ("trimap", grey(255, (20, 10)), "trimap.png: 20 x 10 is not the size of the picture, 48 x 24"),
        ("trimap", gone("trimap.png"), "trimap.png: there is no such file"),
        ("trimap", gone("picture.png"), "picture.png: there is no such file"),
        ("trimap", written("picture.png", b""), "picture.png: "),
    ],
)  # fmt: skip
def test_bad_input_is_one_sentence_and_code_2(cut, folder, source, harm, sentence):
    harm(folder)
    done = cut(f"--{source}", f"{source}.{'json' if source == 'scribbles' else 'png'}")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith(f"stillwater: {sentence}") and done.stderr.count("\n") == 1
    assert not (folder / "alpha.png").exists()


@pytest.mark.parametrize(
    "arguments, sentence",
    [
        (["-o", "a.png"], "one of the arguments --scribbles --trimap is required"),
        (["-o", "a.png", "--scribbles", "s.json", "--trimap", "t.png"], "not allowed with argument"),
        (["--trimap", "trimap.png"], "the following arguments are required: -o/--output"),
        (["-o", "a.bmp", "--trimap", "trimap.png"], "a.bmp: its ending is not one of .exr, .jpeg, .jpg, .png, .tif, .tiff"),
        (["-o", "a.png", "--trimap", "trimap.png", "--method", "magic"], "invalid choice: 'magic'"),
    ],
)
def test_wrong_arguments(folder, command, arguments, sentence):
    done = command("matte", "picture.png", *arguments, cwd=folder)
    assert done.returncode == 2 and sentence in done.stderr and done.stderr.count("\n") == 1


def test_a_matte_that_cannot_be_written(folder, command):
    done = command("matte", "picture.png", "--trimap", "trimap.png", "-o", "none/alpha.png", cwd=folder)
    assert done.returncode == 1 and done.stderr.startswith("stillwater: none/alpha.png: ")
