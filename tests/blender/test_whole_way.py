"""The whole way: the installed engine bakes a small recipe, and the node gives what its frames hold."""

import bpy
import numpy as np
import pytest
import recipes
from pixels import HEIGHT, WIDTH, oiio, read_frame, render, same

TREE = {"type": "sway", "armature": [[16, 16], [16, -16]], "amount": 3}


@pytest.fixture
def painted(scene, tmp_path):
    """A recipe of a picture of 16 x 8, all of which sways in a strong wind, opened in a saved file."""
    recipe = {
        "stillwater": 1,
        "picture": "picture.exr",
        "frames": [5, 8],
        "wind": {"speed": 20},
        "layers": [{"name": "tree", "matte": {"file": "matte.png"}, "motion": TREE}, {"name": "behind"}],
        "output": {"depth": "float"},
    }
    path = recipes.write(tmp_path / "lake", recipe)
    noise = np.random.default_rng(1)
    picture = noise.uniform(0.2, 0.8, (HEIGHT, WIDTH, 3)).astype(np.float32)
    matte = np.ones((HEIGHT, WIDTH, 1), np.float32)
    for name, pixels, kind in (("picture.exr", picture, "float"), ("matte.png", matte, "uint8")):
        image = oiio.ImageBuf(oiio.ImageSpec(WIDTH, HEIGHT, pixels.shape[2], kind))
        image.set_pixels(oiio.ROI(), pixels)
        assert image.write(str(tmp_path / "lake" / name))
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
    bpy.ops.stillwater.load_recipe(filepath=str(path))
    return tmp_path / "stillwater" / "lake" / "frames"


def test_the_node_gives_what_the_engine_made(painted, tmp_path):
    assert bpy.ops.stillwater.bake() == {"FINISHED"}
    state = bpy.context.scene.stillwater.pictures[0].tree.stillwater
    assert (state.state, state.message) == ("done", "Baked 4 frames")
    for frame in range(5, 9):
        same(render(bpy.context.scene, frame, tmp_path), read_frame(painted / f"frame_{frame:04d}.exr"))


def test_frames_that_are_right_are_kept_and_others_made_anew(painted):
    bpy.ops.stillwater.bake()
    times = lambda: {path.name: path.stat().st_mtime_ns for path in painted.glob("*.exr")}  # noqa: E731
    before = times()
    bpy.ops.stillwater.bake()
    assert times() == before and len(before) == 4
    bpy.context.scene.stillwater.pictures[0].wind.speed = 10
    bpy.ops.stillwater.bake()
    assert not set(times().items()) & set(before.items())


def test_the_engine_s_sentence_reaches_the_artist(painted):
    bpy.context.scene.stillwater.pictures[0].layers[0].matte.form = "none"
    with pytest.raises(RuntimeError, match=r"layers\[0\].matte: missing \(only the last layer needs none\)"):
        bpy.ops.stillwater.bake()
