"""What Stillwater made goes with a picture; what the artist made, and files on disk, stay."""

import bpy
import pytest
from pictures import paint
from pixels import write_frame

KINDS = ("objects", "cameras", "collections", "images", "node_groups", "actions", "materials", "meshes", "scenes")


def data() -> dict[str, set[str]]:
    kinds = [*KINDS, "grease_pencils_v3" if hasattr(bpy.data, "grease_pencils_v3") else "grease_pencils"]
    ours = {kind: set(getattr(bpy.data, kind).keys()) for kind in kinds}
    ours["images"] -= {"Render Result", "Viewer Node"}
    return ours


@pytest.fixture
def path(tmp_path):
    return str(paint(tmp_path / "lake.png"))


def settings(scene):
    render, view = scene.render, scene.view_settings
    return (scene.camera, render.resolution_x, render.resolution_y, render.resolution_percentage, render.pixel_aspect_x,
            view.view_transform, view.look, view.exposure, getattr(scene, "compositing_node_group", None))  # fmt: skip


@pytest.fixture
def default(scene):
    """A scene as Blender starts with it."""
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    scene = bpy.context.scene
    scene.render.resolution_percentage, scene.render.pixel_aspect_x = 50, 2
    return scene


def test_nothing_is_left_and_the_scene_is_as_it_was(default, path):
    before = data(), settings(default)
    bpy.ops.stillwater.open_picture(filepath=path)
    picture = default.stillwater.active()
    picture.wind.keyframe_insert("speed", frame=1)
    for item in (picture.plane, picture.camera, picture.strokes):
        item.keyframe_insert("location", frame=1)
    picture.camera.data.keyframe_insert("ortho_scale", frame=1)
    material = bpy.data.materials.new("Sway Line")
    picture.strokes.data.materials.append(material)
    assert bpy.ops.stillwater.remove_picture("EXEC_DEFAULT", True) == {"FINISHED"}
    for curves in (default.animation_data.action.layers[0].strips[0].channelbags[0].fcurves,):
        assert len(curves) == 0
    bpy.data.actions.remove(default.animation_data.action)  # the scene's own
    assert (data(), settings(default)) == before


def test_undo_brings_it_all_back(scene, path):
    bpy.ops.stillwater.open_picture(filepath=path)
    bpy.ops.ed.undo_push(message="opened")
    before = data()
    bpy.ops.stillwater.remove_picture("EXEC_DEFAULT", True)
    assert data() != before
    bpy.ops.ed.undo()
    assert data() == before
    picture = bpy.context.scene.stillwater.active()
    assert bpy.context.scene.camera == picture.camera and picture.plane.data == picture.image
    bpy.ops.ed.redo()
    assert bpy.context.scene.stillwater.active() is None and len(bpy.data.objects) == 0


@pytest.mark.parametrize("mode", ["PAINT_GREASE_PENCIL", "EDIT"])
def test_it_goes_while_it_is_being_drawn_on(scene, path, mode):
    bpy.ops.stillwater.open_picture(filepath=path)
    bpy.ops.object.mode_set(mode=mode)
    bpy.ops.ed.undo_push(message="drawing")
    bpy.ops.stillwater.remove_picture("EXEC_DEFAULT", True)
    assert len(bpy.data.objects) == 0 and bpy.context.mode == "OBJECT"
    bpy.ops.ed.undo()
    assert bpy.context.scene.stillwater.active().strokes is not None
    bpy.ops.stillwater.open_picture(filepath=path)
    assert bpy.context.mode == "OBJECT" and len(bpy.data.objects) == 6


def test_what_the_artist_made_stays(extension, scene, path):
    bpy.ops.stillwater.open_picture(filepath=path)
    picture = scene.stillwater.active()
    cube = bpy.data.objects.new("Cube", bpy.data.meshes.new("Cube"))
    picture.collection.objects.link(cube)
    cube.parent, cube.location = picture.plane, (1, 2, 3)
    picture.plane.location.x = 4
    bpy.context.view_layer.update()
    where = cube.matrix_world.copy()
    top = extension.versions.compositor_tree(scene)
    blur = top.nodes.new("CompositorNodeBlur")
    kept = bpy.data.materials.new("Kept")
    picture.strokes.data.materials.append(kept)
    cube.data.materials.append(kept)
    cube.data.materials.append(bpy.data.materials.new("Picture"))
    scene.world = bpy.data.worlds.new("World")
    bpy.ops.stillwater.remove_picture()
    assert list(bpy.data.objects) == [cube] and cube.name in scene.collection.objects and cube.parent is None
    assert (cube.matrix_world.translation - where.translation).length < 1e-5
    assert [node.bl_idname for node in top.nodes if node == blur] == ["CompositorNodeBlur"]
    assert {"Kept", "Picture"} <= set(bpy.data.materials.keys())


def test_an_image_that_the_artist_uses_stays(scene, path):
    bpy.ops.stillwater.open_picture(filepath=path)
    image = scene.stillwater.active().image
    empty = bpy.data.objects.new("Reference", None)
    empty.empty_display_type, empty.data = "IMAGE", image
    bpy.ops.stillwater.remove_picture()
    assert empty.data == image


def test_nodes_within_other_groups_go(extension, scene, path):
    bpy.ops.stillwater.open_picture(filepath=path)
    tree = scene.stillwater.active().tree
    group = bpy.data.node_groups.new("Grade", "CompositorNodeTree")
    group.nodes.new("CompositorNodeGroup").node_tree = tree
    bpy.ops.stillwater.remove_picture()
    assert len(group.nodes) == 0 and [item.name for item in bpy.data.node_groups if "Stillwater" in item.name] == []


def test_another_picture_takes_over(extension, scene, tmp_path):
    for name, size in (("a", (40, 30)), ("b", (30, 60))):
        bpy.ops.stillwater.open_picture(filepath=str(paint(tmp_path / f"{name}.png", size)))
    bpy.ops.stillwater.remove_picture()
    left = scene.stillwater.active()
    assert left.name == "a" and scene.camera == left.camera and scene.render.resolution_x == 40
    top = extension.versions.compositor_tree(scene)
    assert extension.versions.output_socket(top).links[0].from_node.node_tree == left.tree
    assert scene.view_settings.view_transform == "Standard"


def test_a_size_and_a_camera_of_the_artist_s_own_stay(default, path):
    bpy.ops.stillwater.open_picture(filepath=path)
    default.render.resolution_x = 1000
    other = bpy.data.objects.new("Mine", bpy.data.cameras.new("Mine"))
    default.collection.objects.link(other)
    default.camera = other
    bpy.ops.stillwater.remove_picture()
    assert default.camera == other and default.render.resolution_x == 1000


@pytest.mark.parametrize("kind", ["LINK_COPY", "FULL_COPY", "EMPTY"])
def test_a_copied_scene_keeps_its_own(scene, path, kind):
    bpy.ops.stillwater.open_picture(filepath=path)
    bpy.ops.scene.new(type=kind)
    copy = bpy.context.scene
    assert copy != scene and len(copy.stillwater.pictures) == 1
    bpy.ops.stillwater.remove_picture()
    left = scene.stillwater.active()
    assert {item.name for item in (left.plane, left.camera, left.strokes)} <= set(scene.objects.keys())
    assert left.tree is not None and left.image is not None and left.collection.name in scene.collection.children
    assert len([item for item in copy.objects if item.name in scene.objects]) == 0
    bpy.context.window.scene = scene
    bpy.ops.stillwater.remove_picture()
    assert len(bpy.data.objects) == 0 and len(bpy.data.collections) == 0


@pytest.fixture
def baked(extension, scene, path, tmp_path):
    """A saved picture with frames and what its worker leaves beside them; its folder."""
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
    bpy.ops.stillwater.open_picture(filepath=path)
    folder = extension.bake.places.folder_of(scene.stillwater.active())
    for number in (5, 6):
        write_frame(folder / "frames" / f"frame_{number:04d}.exr", number)
    (folder / "recipe.json").write_text("{}")
    (folder / ".stillwater-cache" / "key").mkdir(parents=True)
    return folder


def test_files_on_disk_stay(baked):
    bpy.ops.stillwater.remove_picture()
    assert sorted(item.name for item in baked.iterdir()) == [".stillwater-cache", "frames", "recipe.json"]


def test_files_are_deleted_where_that_is_asked(baked):
    (baked / "frames" / "note.txt").write_text("the artist's")
    bpy.ops.stillwater.remove_picture(delete_files=True)
    assert [path.name for path in baked.rglob("*")] == ["frames", "note.txt"]


def test_no_empty_folder_is_left(baked, tmp_path, path):
    bpy.ops.stillwater.remove_picture(delete_files=True)
    assert sorted(item.name for item in tmp_path.iterdir()) == ["file.blend", "lake.png"]
    assert path.endswith("lake.png")


@pytest.mark.parametrize("baked_first", [True, False])
def test_the_cache_of_all_pictures_is_cleared_of_it(extension, scene, path, tmp_path, baked_first):
    chosen = extension.preferences.of(bpy.context)
    chosen.cache_folder = str(tmp_path / "cache")
    try:
        bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
        paint(tmp_path / "pond.png", (30, 20))
        for name in ("lake.png", "pond.png"):
            bpy.ops.stillwater.open_picture(filepath=str(tmp_path / name))
            scene.frame_start = scene.frame_end = 1
            bpy.ops.stillwater.bake()
        kept = lambda: len(list((tmp_path / "cache").glob("*/meta.json")))  # noqa: E731
        both = kept()
        if not baked_first:
            bpy.ops.stillwater.free_bake()
        bpy.ops.stillwater.remove_picture(delete_files=True)
        assert kept() == both / 2 and not (tmp_path / "stillwater" / "pond").exists()
        bpy.ops.stillwater.remove_picture()
        assert kept() == both / 2, "its files stay: undo brings it back with all of them"
    finally:
        chosen.cache_folder = ""


def test_a_cache_that_can_t_be_cleared_is_told(extension, scene, path, monkeypatch):
    def fail(*_):
        raise OSError(13, "Permission denied", "/cache")

    told = []
    monkeypatch.setattr(extension.bake.keeping, "forget_prepared", fail)
    bpy.ops.stillwater.open_picture(filepath=path)
    monkeypatch.setattr(extension.pictures.remove, "rpt_", lambda text: told.append(text) or text)
    assert bpy.ops.stillwater.remove_picture(delete_files=True) == {"FINISHED"}
    assert told == ["{name} is removed, its files are not: {why}"] and len(scene.stillwater.pictures) == 0


def test_a_worker_that_bakes_it_is_ended(extension, scene, baked, monkeypatch):
    import sys

    command = [sys.executable, "-c", "import time; time.sleep(60)"]
    monkeypatch.setattr(extension.engine, "worker_command", lambda python: command)
    extension.bake.job.start(scene, scene.stillwater.active())
    process = next(iter(extension.bake.job._jobs.values()))[0]._process
    bpy.ops.stillwater.remove_picture()
    assert process.poll() is not None and not extension.bake.job._jobs


def test_without_a_picture_it_says_why(scene):
    with pytest.raises(RuntimeError, match="no Stillwater picture yet: open one first"):
        bpy.ops.stillwater.remove_picture()
