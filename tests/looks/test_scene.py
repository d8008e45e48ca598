"""What the scripts write is a recipe that the engine takes, for every picture that polygons.json knows."""

import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from scene import scene_of_labels, scene_of_polygons, write_recipe
from stillwater.recipe import load

DRAWN = json.loads((Path(__file__).with_name("polygons.json")).read_text(encoding="utf-8"))


@pytest.fixture
def picture(tmp_path):
    path = tmp_path / "any.png"
    Image.fromarray(np.random.default_rng(1).integers(0, 256, (60, 80, 3), dtype=np.uint8)).save(path)
    return path


@pytest.mark.parametrize("name", DRAWN)
def test_polygons_make_a_recipe(name, picture, tmp_path):
    scene = scene_of_polygons(name, picture, DRAWN[name])
    assert all(part.matte is None or part.matte.any() for part in scene.parts)
    load(write_recipe(scene, tmp_path / name, 24))


def test_a_label_map_makes_a_recipe_with_the_sky_behind_all(picture, tmp_path):
    labels = np.zeros((60, 80, 3), np.uint8)
    labels[30:] = (0, 0, 255)
    labels[10:40, 60:76] = (255, 0, 0)
    Image.fromarray(labels).save(tmp_path / "labels.png")
    scene = scene_of_labels("any", picture, tmp_path / "labels.png")
    assert [part.motion["type"] for part in scene.parts] == ["sway", "ripple", "drift"]
    assert scene.parts[-1].matte is None
    assert scene.view["horizon"] == [[0, 30], [80, 30]]
    load(write_recipe(scene, tmp_path / "any", 24))
