"""Opening a recipe sets up the scene so that its render is the frames."""

import json

import bpy
import pytest
import recipes
from pixels import HEIGHT, WIDTH, render, same, write_frame


@pytest.fixture
def opened(scene, tmp_path):
    """Opens a recipe, changed as asked, beside which frames 3 to 6 lie already; returns the frames."""

    def open_it(**changes):
        path = recipes.write(tmp_path / "lake", {**recipes.whole(), **changes})
        bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
        folder = tmp_path / "stillwater" / "lake" / "made"
        frames = {number: write_frame(folder / f"lake_{number:04d}.exr", number) for number in range(3, 7)}
        assert bpy.ops.stillwater.load_recipe(filepath=str(path)) == {"FINISHED"}
        return frames

    return open_it


def test_the_render_is_the_frames(opened, tmp_path):
    """The recipe's picture is 32 x 16 and its scale 0.5: the frames' 16 x 8."""
    frames = opened()
    for frame, wanted in frames.items():
        same(render(bpy.context.scene, frame, tmp_path), wanted)


def test_the_scene_is_set_up(opened):
    opened()
    scene = bpy.context.scene
    assert (scene.render.resolution_x, scene.render.resolution_y) == (WIDTH, HEIGHT)
    assert (scene.frame_start, scene.frame_end) == (3, 6)
    assert scene.render.fps / scene.render.fps_base == pytest.approx(23.976, abs=1e-3)
    assert scene.view_settings.view_transform == "Standard"
    assert scene.stillwater.active().name == "lake"


@pytest.mark.parametrize("fps", [24, 25, 23.976, 29.97, 12.5, 60])
def test_frame_rates_come_back(extension, opened, fps):
    opened(fps=fps)
    scene = bpy.context.scene
    with open(extension.bake.job.write_recipe(scene, scene.stillwater.active())) as file:
        assert json.load(file)["fps"] == pytest.approx(fps, abs=1e-3)


def test_it_can_be_drawn_on(opened):
    opened()
    picture = bpy.context.scene.stillwater.active()
    assert bpy.context.scene.camera == picture.camera and picture.plane.data == picture.image
    assert tuple(picture.picture_size) == (32, 16) and bpy.context.view_layer.objects.active == picture.strokes


def test_a_render_renders_no_3d(extension, opened):
    opened()
    tree = extension.versions.compositor_tree(bpy.context.scene)
    assert all(node.bl_idname != "CompositorNodeRLayers" for node in tree.nodes)


def test_two_recipes_are_two_pictures(opened):
    opened()
    bpy.ops.stillwater.load_recipe(filepath=bpy.path.abspath("//lake/recipe.json"))
    pictures = bpy.context.scene.stillwater.pictures
    assert [picture.name for picture in pictures] == ["lake", "lake.001"]
    assert pictures[0].tree != pictures[1].tree


LIBRARY = {"name": "a", "motion": {"type": "library", "library": "clips"}}
STROKE = {"points": [[1, 1], [2, 2]]}
TOUCHED = {"name": "a", "fill": {"method": "exemplar", "touch_up": [{"stroke": STROKE, "seed": 2**31 - 1}]}}


@pytest.mark.parametrize(
    "changes, sentence",
    [
        ({"fps": -1}, "fps: -1 is not above 0"),
        ({"size": [3, 4]}, r"size: \[3, 4\] is not the picture's \(\[32, 16\]\)"),
        ({"picture": "none.png"}, "none.png"),
        ({"picture": "recipe.json"}, "recipe.json"),
        ({"seed": 2**40}, r"seed: 1099511627776 is above what Blender can hold \(2147483647\)"),
        ({"layers": [TOUCHED]}, r"layers.0..fill.touch_up.0..seed: 2147483648 is above what Blender can hold"),
        ({"layers": [LIBRARY]}, 'motion.type: "library"'),
        ({"picture": None, "size": [32, 16]}, "picture: missing"),
    ],
)
def test_what_can_t_be_opened_is_a_sentence_and_changes_nothing(opened, changes, sentence):
    with pytest.raises(RuntimeError, match=sentence):
        opened(**changes)
    scene = bpy.context.scene
    assert len(scene.stillwater.pictures) == 0
    assert scene.frame_start == 5 and len(bpy.data.images) == 0


def test_no_such_recipe(scene):
    with pytest.raises(RuntimeError, match="No such file or directory"):
        bpy.ops.stillwater.load_recipe(filepath="/nowhere/recipe.json")
