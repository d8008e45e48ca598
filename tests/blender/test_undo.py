"""Every operator on pictures, called with its undo flag, through undo, redo, saving and opening."""

import bpy
import pytest
import recipes
from pictures import paint


def state() -> dict:
    """What the file holds, as far as these operators may change it."""
    scene = bpy.context.scene
    settings, render, view = scene.stillwater, scene.render, scene.view_settings
    name = lambda thing: thing.name if thing else None  # noqa: E731
    pictures = [
        {
            **{kind: name(getattr(p, kind)) for kind in ("plane", "camera", "strokes", "collection", "tree", "image")},
            **{kind: getattr(p, kind) for kind in ("id", "name", "picture", "colour_space", "missing")},
            "size": (*p.picture_size, *p.image.size),
            "stretched": [round(x, 5) for row in p.strokes.matrix_parent_inverse for x in row],
            "root": tuple(p.layers[0].motion.sway.armature_root),
        }
        for p in settings.pictures
    ]
    return {
        "pictures": pictures, "active": settings.active_picture, "former": settings.former.view_transform,
        "camera": name(scene.camera), "size": (render.resolution_x, render.resolution_y), "rate": render.fps,
        "view": (view.view_transform, view.look, view.exposure),
        "objects": sorted(item.name for item in scene.objects), "groups": sorted(bpy.data.node_groups.keys()),
        "images": sorted(image.name for image in bpy.data.images if image.source == "FILE"),
    }  # fmt: skip


@pytest.fixture
def two(scene, tmp_path):
    """Two pictures, the second one active; the first one changes on disk and moves."""
    scene.view_settings.view_transform = "AgX"
    for name, size in (("pond", (30, 20)), ("lake", (48, 32))):
        bpy.ops.stillwater.open_picture(filepath=str(paint(tmp_path / f"{name}.png", size)))
    scene.stillwater.active().layers[0].motion.sway.armature_root = (12, 8)
    scene.render.use_compositing = True
    bpy.ops.ed.undo_push(message="two pictures")
    return tmp_path


CALLS = {
    "open_picture": lambda folder: {"filepath": str(paint(folder / "sea.png")), "frame_rate": "25"},
    "load_recipe": lambda folder: {"filepath": str(recipes.write(folder / "made", recipes.whole()))},
    "replace_picture": lambda folder: {"filepath": str(paint(folder / "sea.png", (24, 64)))},
    "reload_picture": lambda folder: {} if paint(folder / "lake.png", (96, 32)) else {},
    "show_picture": lambda folder: {"index": 0},
    "former_view": lambda folder: {},
    "remove_picture": lambda folder: {},
}


@pytest.mark.parametrize("saved", [False, True])
@pytest.mark.parametrize("name", CALLS)
def test_it_is_undone_and_done_again(two, name, saved):
    arguments = CALLS[name](two)
    before = state()
    assert getattr(bpy.ops.stillwater, name)("EXEC_DEFAULT", True, **arguments) == {"FINISHED"}
    after = state()
    assert after != before
    for _ in range(2):
        bpy.ops.ed.undo()
        undone = state()
        assert {**undone, "pictures": _but_pixels(undone)} == {**before, "pictures": _but_pixels(before)}
        bpy.ops.ed.redo()
        assert state() == after
    if saved:
        bpy.ops.wm.save_as_mainfile(filepath=str(two / "file.blend"))
        after = state()
        bpy.ops.wm.open_mainfile(filepath=str(two / "file.blend"))
        assert state() == after


def _but_pixels(state: dict) -> list[dict]:
    """A file that changed on disk has its new pixels, whatever is undone."""
    return [{**picture, "size": picture["size"][:2]} for picture in state["pictures"]]


def test_the_standard_view_too(two):
    bpy.ops.stillwater.former_view()
    bpy.ops.ed.undo_push(message="AgX")
    before = state()
    bpy.ops.stillwater.standard_view("EXEC_DEFAULT", True)
    after = state()
    bpy.ops.ed.undo()
    assert state() == before != after
    bpy.ops.ed.redo()
    assert state() == after
