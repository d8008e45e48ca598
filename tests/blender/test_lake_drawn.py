"""The lake sample, its layers cut out by strokes in a .blend: its film is close to the one made from matte files."""

import json
from pathlib import Path

import bpy
import numpy as np
import pytest
from pixels import oiio, read_frame

LAKE = Path(__file__).resolve().parents[2] / "blend_samples" / "lake"
SMALLER = 2  # times smaller, so that it takes seconds
FRAMES = (40, 41)
PLACES = ("horizon", "armature", "waterline", "points", "width", "velocity")  # of a recipe, in pixels


def shrunk(part, name=""):
    """A recipe with every place in it brought nearer to the upper left corner."""
    if isinstance(part, dict):
        return {key: shrunk(value, key) for key, value in part.items()}
    if isinstance(part, list):
        return [shrunk(item, name) for item in part]
    return part / SMALLER if name in PLACES and isinstance(part, int | float) else part


@pytest.fixture
def small(tmp_path):
    """Both recipes, and all their files, smaller."""
    for path in (LAKE / "picture.png", *LAKE.glob("mattes/*"), *LAKE.glob("behind/*")):
        image = oiio.ImageBuf(str(path))
        to = tmp_path / "lake" / path.relative_to(LAKE)
        to.parent.mkdir(parents=True, exist_ok=True)
        width, height = image.spec().width // SMALLER, image.spec().height // SMALLER
        made = oiio.ImageBufAlgo.resize(image, roi=oiio.ROI(0, width, 0, height, 0, 1, 0, image.nchannels))
        assert made.write(str(to)), made.geterror()
    for name in ("recipe.json", "drawn.json"):
        (tmp_path / "lake" / name).write_text(json.dumps(shrunk(json.loads((LAKE / name).read_text()))))
    return tmp_path / "lake"


def film(folder: Path, name: str) -> np.ndarray:
    """Opens a recipe in a .blend of its own, which is saved and opened again, and bakes; the frames, as seen."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    blend = folder / name / "lake.blend"
    blend.parent.mkdir()
    bpy.ops.wm.save_as_mainfile(filepath=str(blend))
    assert bpy.ops.stillwater.load_recipe(filepath=str(folder / f"{name}.json")) == {"FINISHED"}
    bpy.ops.wm.save_mainfile()
    bpy.ops.wm.open_mainfile(filepath=str(blend))
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = FRAMES
    assert bpy.ops.stillwater.bake() == {"FINISHED"}
    made = sorted(blend.parent.glob("stillwater/*/frames/*.exr"))
    assert len(made) == len(FRAMES)
    linear = np.stack([read_frame(path)["Image"][..., :3] for path in made]).clip(0, 1)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def test_strokes_and_matte_files_make_nearly_the_same_film(extension, scene, small):
    files, drawn = film(small, "recipe"), film(small, "drawn")
    scene = bpy.context.scene
    forms = [layer.matte.form for layer in scene.stillwater.active().layers]
    assert forms == ["scribbles"] * 8 + ["none"]
    difference = np.abs(files - drawn)
    assert difference.mean() < 0.006 and np.percentile(difference, 99) < 0.12, (
        difference.mean(), np.percentile(difference, 99))
    assert np.abs(files[0] - files[1]).mean() > 1e-3  # it moves
