"""The presets of the motion Example: the published ones, for a picture of any size."""

import importlib

import bpy
import pytest
from layered import now
from pixels import PACKAGE

files = importlib.import_module(f"{PACKAGE}.layers.preset_files")


def call(operator: str, **arguments) -> None:
    assert getattr(bpy.ops.stillwater, operator)("EXEC_DEFAULT", True, **arguments) == {"FINISHED"}


PUBLISHED = {  # METHODS.md 2
    "River": (254, 176, 12, 16, 0.1, 8, 4, 3, 3),
    "Campfire": (360, 480, 40, 16, 0.4, 16, 4, 4, 3),
    "Water_Surface": (500, 208, 20, 16, 0.2, 10, 8, 4, 3),
    "Brook": (288, 384, 30, 16, 0.1, 8, 5, 7, 3),
    "Waterfall": (405, 399, 30, 16, 0.1, 4, 8, 8, 3),
    "Wide_Waterfall": (617, 224, 30, 16, 0.2, 8, 10, 4, 3),
    "Smoke": (283, 307, 40, 16, 0.27, 14, 8, 8, 3),
    "Thin_Smoke": (236, 314, 30, 16, 0.33, 14, 4, 7, 3),
}


def look(example) -> tuple:
    return (example.refine_width, example.life, example.shutter, example.average_blur, *example.grid, example.repetitions)


@pytest.mark.parametrize("path", files.paths("example"), ids=lambda path: path.stem)
def test_presets_are_the_published_ones_and_scale_with_the_picture(extension, picture, path):
    width, height, *numbers = PUBLISHED[path.stem]
    picture.layers[0].motion.type = "example"
    picture.picture_size = width, height
    call("apply_preset", filepath=str(path))
    assert look(now().layers[0].motion.example) == pytest.approx(tuple(numbers))
    now().picture_size = 4 * width, 2 * height
    call("apply_preset", filepath=str(path))
    example, larger = now().layers[0].motion.example, 8**0.5
    wide = [larger * numbers[0], numbers[1], numbers[2], larger * numbers[3], 4 * numbers[4], 2 * numbers[5], numbers[6]]
    assert look(example) == pytest.approx(tuple(wide), rel=1e-5) and example.use_grid


def test_there_is_a_preset_for_each():
    assert {path.stem for path in files.paths("example") if files.is_shipped(path)} == set(PUBLISHED)


def test_an_own_preset_says_for_which_size_it_is(scene, picture):
    picture.layers[0].motion.type, picture.picture_size = "example", (400, 300)
    example = picture.layers[0].motion.example
    example.average_blur, example.use_grid, example.grid = 6, True, (8, 50)
    call("save_preset", name="Mine for 400", of="MOTION")
    path = next(path for path in files.paths("example") if path.stem.startswith("Mine_for"))
    try:
        now().picture_size = 800, 600
        call("apply_preset", filepath=str(path))
        example = now().layers[0].motion.example
        assert example.average_blur == pytest.approx(12) and list(example.grid) == [16, 64]  # at most 64 cells
        assert files.read(path).scaled((0, 0)) == files.read(path).numbers
    finally:
        path.unlink()
