"""`stillwater flow`: painted, corrected and proposed fields, streaks, and what it says of bad input."""

import json

import numpy as np
import pytest
import stillwater
from PIL import Image

STROKES = [
    {"points": [[4, 8], [90, 8]], "speed": 3},
    {"points": [[4, 50, 0.5], [90, 50, 1]], "kind": "orientation", "width": 6},
    {"points": [[50, 30], [60, 30]], "kind": "speed", "speed": 5, "local": True, "alpha": 0.5, "frame": None},
]


@pytest.fixture
def folder(tmp_path):
    rng = np.random.default_rng(1)
    stripes = np.repeat(np.repeat(rng.integers(40, 220, (32, 1, 3)), 2, axis=0), 96, axis=1)
    Image.fromarray(stripes.astype(np.uint8)).save(tmp_path / "picture.png")
    (tmp_path / "strokes.json").write_text(json.dumps(STROKES))
    return tmp_path


@pytest.fixture
def flow(folder, command):
    def run(*arguments):
        return command("flow", "picture.png", *arguments, cwd=folder)

    return run


@pytest.mark.parametrize("name", ["f.flo", "f.exr"])
def test_strokes_are_painted_and_refined(flow, folder, name):
    done = flow("--strokes", "strokes.json", "-o", name)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    picture, strokes = stillwater.read(folder / "picture.png"), [dict(stroke) for stroke in STROKES]
    del strokes[2]["frame"]
    expected = stillwater.refine_flow(stillwater.paint_flow(strokes, (96, 64)), picture)
    assert np.array_equal(stillwater.read_flow(folder / name), expected)


def test_width_is_the_refinement_s(flow, folder):
    for width in ("2", "30"):
        assert flow("--strokes", "strokes.json", "--width", width, "-o", f"{width}.flo").returncode == 0
    assert not np.array_equal(*(stillwater.read_flow(folder / f"{width}.flo") for width in ("2", "30")))


def test_strokes_may_stand_under_their_name(flow, folder):
    (folder / "named.json").write_text(json.dumps({"strokes": STROKES}))
    assert flow("--strokes", "strokes.json", "-o", "a.flo").returncode == flow("--strokes", "named.json", "-o", "b.flo").returncode == 0
    assert (folder / "a.flo").read_bytes() == (folder / "b.flo").read_bytes()


def test_without_strokes_the_picture_proposes(flow, folder):
    assert flow("-o", "f.flo").returncode == flow("--kind", "water", "-o", "water.flo").returncode == 0
    assert (folder / "f.flo").read_bytes() == (folder / "water.flo").read_bytes()
    field = stillwater.read_flow(folder / "f.flo")
    assert (field[..., 0] > 0).all() and np.abs(field[..., 1]).max() < 0.2 * field[..., 0].max()


def test_strokes_correct_what_a_kind_proposes(flow, folder):
    (folder / "back.json").write_text(json.dumps([{"points": [[90, 30], [4, 30]], "speed": 2}]))
    assert flow("--kind", "sky", "--strokes", "back.json", "-o", "f.flo").returncode == 0
    field = stillwater.read_flow(folder / "f.flo")
    assert (field[..., 0] < 0).all() and np.abs(np.linalg.norm(field, axis=2) - 2).max() < 0.1


def test_streaks_lie_over_the_picture(flow, folder):
    assert flow("-o", "f.flo", "--streaks", "s.png").returncode == 0
    picture, shown = stillwater.read(folder / "picture.png"), stillwater.read(folder / "s.png")
    expected = stillwater.over(stillwater.streaks(stillwater.read_flow(folder / "f.flo")), picture)
    assert np.abs(shown - expected).max() < 0.003 and np.abs(shown - picture).max() > 0.3


def written(name, text):
    return lambda folder: (folder / name).write_bytes(text)


def strokes(*given):
    return written("strokes.json", json.dumps(given).encode())


@pytest.mark.parametrize(
    "harm, sentence",
    [
        (strokes(), "strokes.json: holds no stroke; without --strokes the picture proposes a flow"),
        (strokes({"points": [[1, 1]]}), "strokes.json: strokes[0].points: a line shorter than 1 px is not a direction"),
        (strokes({"points": [[1, 1], [9, 9]], "kind": "speed"}),
         "strokes.json: strokes: none that touches the picture is of kind orientation or both, with an alpha above 0"),
        (strokes({"points": [[1, 1], [9, 9]], "frame": 4}),
         "strokes.json: strokes[0].frame: 4 is not null (the field is that of one moment)"),
        (strokes({"points": [[1, 1], [9, 9]], "speed": -1}), "strokes.json: strokes[0].speed: -1"),
        (strokes({"points": [[1, 1], [9, 9]], "colour": 1}), "strokes.json: strokes[0]"),
        (written("strokes.json", b"{"), "strokes.json: recipe: not JSON (line 1"),
        (written("strokes.json", b"3"), "strokes.json: "),
        (lambda folder: (folder / "strokes.json").unlink(), "strokes.json: there is no such file"),
        (lambda folder: (folder / "picture.png").unlink(), "picture.png: there is no such file"),
        (written("picture.png", b"no picture"), "picture.png: is not a picture or clip that can be read"),
    ],
)  # fmt: skip
def test_bad_input_is_one_sentence_and_code_2(flow, folder, harm, sentence):
    harm(folder)
    done = flow("--strokes", "strokes.json", "-o", "f.flo")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith(f"stillwater: {sentence}") and done.stderr.count("\n") == 1
    assert not (folder / "f.flo").exists()


@pytest.mark.parametrize(
    "arguments, sentence",
    [
        ([], "the following arguments are required: -o/--output"),
        (["-o", "f.png"], "f.png: its ending is not one of .exr, .flo"),
        (["-o", "f.flo", "--streaks", "s.bmp"], "s.bmp: its ending is not one of .exr, .jpeg, .jpg, .png, .tif, .tiff"),
        (["-o", "f.flo", "--kind", "lava"], "invalid choice: 'lava'"),
        (["-o", "f.flo", "--width", "3"], "--width: a proposed flow is not refined"),
        (["-o", "f.flo", "--strokes", "strokes.json", "--width", "-3"], "width: -3 is not between 0 and 1000 (px)"),
    ],
)
def test_wrong_arguments(flow, folder, arguments, sentence):
    done = flow(*arguments)
    assert done.returncode == 2 and sentence in done.stderr and done.stderr.count("\n") == 1
    assert not (folder / "f.flo").exists()


def test_a_flow_that_cannot_be_written(flow):
    done = flow("-o", "none/f.flo")
    assert done.returncode == 1 and done.stderr == "stillwater: none/f.flo: cannot be written (No such file or directory)\n"
