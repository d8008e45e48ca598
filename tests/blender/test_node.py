"""The node gives what the frames' files hold, on every output, whatever happens to the file around it."""

import addon_utils
import bpy
import numpy as np
import pytest
from pixels import HEIGHT, PACKAGE, WIDTH, oiio, render, same, set_up, write_frame


def test_every_output_is_the_file_s(scene, baked, tmp_path):
    for frame, wanted in baked[1].items():
        same(render(scene, frame, tmp_path), wanted)


def test_frames_are_found_in_any_order(scene, baked, tmp_path):
    for frame in (8, 5, 7):
        same(render(scene, frame, tmp_path), baked[1][frame])


def halved(frame: dict) -> dict:
    """A frame at half its size: each pixel is four; and half as many pixels from frame to frame."""
    quarters = {name: pixels.reshape(HEIGHT // 2, 2, WIDTH // 2, 2, -1) for name, pixels in frame.items()}
    small = {name: pixels.mean((1, 3)) for name, pixels in quarters.items()}
    return {**small, "Flow": small["Flow"] / 2, "Render": small["Image"]}


def is_halved(shown: dict, frame: dict) -> None:
    for name, wanted in halved(frame).items():
        np.testing.assert_allclose(shown[name], wanted, rtol=1e-5, atol=1e-5, err_msg=name)


def test_a_render_at_a_percentage_shows_the_whole_frame(scene, baked, tmp_path):
    scene.render.resolution_percentage = 50
    is_halved(render(scene, 6, tmp_path), baked[1][6])
    scene.render.resolution_percentage = 100
    same(render(scene, 7, tmp_path), baked[1][7])


def test_each_scene_has_its_own_percentage(extension, scene, baked, tmp_path):
    other = bpy.data.scenes.new("Other")
    set_up(other)
    extension.compositor.tree.wire(other, baked[0])
    other.render.resolution_percentage = 50
    for _ in range(2):
        is_halved(render(other, 6, tmp_path), baked[1][6])
        same(render(scene, 6, tmp_path), baked[1][6])
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "saved.blend"))
    addon_utils.disable(PACKAGE)
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "saved.blend"))
    try:
        is_halved(render(bpy.data.scenes["Other"], 6, tmp_path), baked[1][6])
    finally:
        addon_utils.enable(PACKAGE)


def test_before_the_first_frame_it_is_transparent_and_after_the_last_it_holds(scene, baked, tmp_path):
    assert render(scene, 4, tmp_path)["Render"][..., :3].max() == 0
    same(render(scene, 11, tmp_path), baked[1][8])


def test_a_bake_may_start_at_frame_0(extension, scene, baked, tmp_path):
    tree, frames = baked
    first = write_frame(tmp_path / "frames" / "frame_0000.exr", 99)
    second = write_frame(tmp_path / "frames" / "frame_0001.exr", 98)
    tree.stillwater.first, tree.stillwater.last = 0, 1
    extension.compositor.tree.show(tree)
    same(render(scene, 0, tmp_path), first)
    same(render(scene, 1, tmp_path), second)


def test_a_missing_frame_shows_the_nearest(extension, scene, baked, tmp_path):
    tree, frames = baked
    (tmp_path / "frames" / "frame_0005.exr").unlink()
    (tmp_path / "frames" / "frame_0007.exr").unlink()
    extension.compositor.tree.show(tree)
    for frame, shown in {5: 6, 6: 6, 7: 6, 8: 8}.items():
        same(render(scene, frame, tmp_path), frames[shown])
    frames[7] = write_frame(tmp_path / "frames" / "frame_0007.exr", 77)
    frames[5] = write_frame(tmp_path / "frames" / "frame_0005.exr", 55)
    extension.compositor.tree.show(tree)
    for frame in frames:
        same(render(scene, frame, tmp_path), frames[frame])


def test_beyond_the_last_frame_it_is_held_without_a_key(extension, scene, baked, tmp_path):
    tree, frames = baked
    for number in (7, 8):
        (tmp_path / "frames" / f"frame_000{number}.exr").unlink()
    extension.compositor.tree.show(tree)
    assert tree.animation_data is None or extension.versions.channelbags(tree.animation_data) == []
    for frame, shown in {5: 5, 6: 6, 7: 6, 8: 6, 9: 6}.items():
        same(render(scene, frame, tmp_path), frames[shown])


def test_without_frames_it_gives_nothing(extension, scene, baked, tmp_path):
    for file in (tmp_path / "frames").iterdir():
        file.unlink()
    assert extension.compositor.tree.show(baked[0]) == []
    assert render(scene, 6, tmp_path)["Render"][..., :3].max() == 0


def test_new_frames_under_old_names_are_seen(extension, scene, baked, tmp_path):
    same(render(scene, 6, tmp_path), baked[1][6])
    new = write_frame(tmp_path / "frames" / "frame_0006.exr", 66)
    bpy.ops.stillwater.refresh()
    same(render(scene, 6, tmp_path), new)


def test_it_survives_saving_and_opening(scene, baked, tmp_path):
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "saved.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "saved.blend"))
    tree = next(tree for tree in bpy.data.node_groups if tree.stillwater.picture)
    assert tree.stillwater.picture == bpy.context.scene.stillwater.pictures[0].id
    assert (tree.stillwater.first, tree.stillwater.last) == (5, 8)
    same(render(bpy.context.scene, 6, tmp_path), baked[1][6])


def test_it_goes_with_its_folder(extension, scene, baked, tmp_path):
    (tmp_path / "here").mkdir()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "here" / "saved.blend"))
    (tmp_path / "frames").rename(tmp_path / "here" / "frames")
    baked[0].stillwater.folder = "//frames"
    extension.compositor.tree.show(baked[0])
    bpy.ops.wm.save_mainfile()
    (tmp_path / "here").rename(tmp_path / "there")
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "there" / "saved.blend"))
    same(render(bpy.context.scene, 6, tmp_path), baked[1][6])


@pytest.fixture
def disabled(scene, baked, tmp_path):
    """The file opened with the extension disabled."""
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "saved.blend"))
    addon_utils.disable(PACKAGE)
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "saved.blend"))
    yield bpy.context.scene
    addon_utils.enable(PACKAGE)


def test_it_shows_the_same_with_the_extension_disabled(disabled, baked, tmp_path):
    assert not hasattr(disabled, "stillwater")
    same(render(disabled, 7, tmp_path), baked[1][7])


def test_what_it_knows_survives_a_save_with_the_extension_disabled(disabled, baked, tmp_path):
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "again.blend"))
    addon_utils.enable(PACKAGE)
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "again.blend"))
    picture = bpy.context.scene.stillwater.pictures[0]
    assert (picture.name, picture.layers[0].name) == ("Lake", "all")
    assert [tree.stillwater.last for tree in bpy.data.node_groups if tree.stillwater.picture == picture.id] == [8]


def test_it_survives_undo(scene, baked, tmp_path):
    bpy.ops.ed.undo_push(message="before")
    scene.stillwater.pictures[0].wind.speed = 11
    bpy.ops.ed.undo_push(message="after")
    bpy.ops.ed.undo()
    scene = bpy.context.scene
    assert scene.stillwater.pictures[0].wind.speed == 5
    same(render(scene, 6, tmp_path), baked[1][6])
    bpy.ops.ed.redo()
    assert bpy.context.scene.stillwater.pictures[0].wind.speed == 11
    same(render(bpy.context.scene, 6, tmp_path), baked[1][6])


@pytest.mark.parametrize("kind", ["LINK_COPY", "FULL_COPY"])
def test_a_copied_scene_shows_the_same_until_it_is_baked(extension, scene, baked, tmp_path, kind):
    bpy.ops.scene.new(type=kind)
    copy, theirs = bpy.data.scenes["Scene.001"], baked[0]
    same(render(copy, 6, tmp_path), baked[1][6])
    assert extension.compositor.tree.claim(scene, scene.stillwater.pictures[0]) == theirs

    ours = extension.compositor.tree.claim(copy, copy.stillwater.pictures[0])
    assert ours != theirs and copy.stillwater.pictures[0].id != scene.stillwater.pictures[0].id
    assert [p.name for p in (scene.stillwater.pictures[0], copy.stillwater.pictures[0])] == ["Lake", "Lake.001"]
    own = write_frame(tmp_path / "own" / "frame_0006.exr", 1)
    ours.stillwater.folder, ours.stillwater.first, ours.stillwater.last = str(tmp_path / "own"), 5, 8
    extension.compositor.tree.show(ours)
    for _ in range(2):
        same(render(bpy.data.scenes["Scene.001"], 6, tmp_path), own)
        same(render(bpy.data.scenes["Scene"], 6, tmp_path), baked[1][6])
        bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "two.blend"))
        bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "two.blend"))


def test_a_scene_appended_to_another_file_shows_the_same(scene, baked, tmp_path):
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "saved.blend"))
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    (tmp_path / "elsewhere").mkdir()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "elsewhere" / "other.blend"))
    with bpy.data.libraries.load(str(tmp_path / "saved.blend")) as (_, wanted):
        wanted.scenes = ["Scene"]
    appended = wanted.scenes[0]
    same(render(appended, 6, tmp_path), baked[1][6])
    assert appended.stillwater.pictures[0].name == "Lake"


def test_a_tree_appended_to_another_file_shows_the_same(extension, scene, baked, tmp_path):
    name = baked[0].name
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "saved.blend"))
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    with bpy.data.libraries.load(str(tmp_path / "saved.blend")) as (_, wanted):
        wanted.node_groups = [name]
    assert len(bpy.data.scenes) == 1
    set_up(bpy.context.scene)
    extension.compositor.tree.wire(bpy.context.scene, wanted.node_groups[0])
    same(render(bpy.context.scene, 6, tmp_path), baked[1][6])


def test_one_tree_serves_all_nodes_of_a_picture(extension, scene, picture, baked):
    for _ in range(3):
        bpy.ops.stillwater.add_node()
    nodes = extension.compositor.tree.nodes_of(scene, picture.id)
    assert len(nodes) == 4 and baked[0].users == 5  # the picture is one
    assert [output.name for output in nodes[0].outputs] == ["Image", "Alpha", "Flow", "Matte"]


def grouped(extension, scene, tree, depth):
    """Moves the scene's node into a group, in a group, ..., and wires that to the output."""
    top = extension.versions.compositor_tree(scene)
    top.nodes.remove(extension.compositor.tree.nodes_of(scene, tree.stillwater.picture)[0])
    inner = tree
    for _ in range(depth):
        outer = bpy.data.node_groups.new("Mine", "CompositorNodeTree")
        outer.interface.new_socket("Image", in_out="OUTPUT", socket_type="NodeSocketColor")
        node, output = outer.nodes.new("CompositorNodeGroup"), outer.nodes.new("NodeGroupOutput")
        node.node_tree = inner
        outer.links.new(node.outputs["Image"], output.inputs[0])
        inner = outer
    node = top.nodes.new("CompositorNodeGroup")
    node.node_tree = inner
    top.links.new(node.outputs["Image"], extension.versions.output_socket(top))


def rendered(scene, frame, folder):
    """What the scene's render shows."""
    settings = scene.render.image_settings
    settings.file_format, settings.color_mode, settings.color_depth = "OPEN_EXR", "RGBA", "32"
    scene.render.filepath = str(folder / "render.exr")
    bpy.context.window.scene = scene
    scene.frame_set(frame)
    bpy.ops.render.render(write_still=True)
    return oiio.ImageBuf(scene.render.filepath).get_pixels("float")


@pytest.mark.parametrize("depth", [1, 2])
def test_it_works_inside_other_groups(extension, scene, picture, baked, tmp_path, depth):
    grouped(extension, scene, baked[0], depth)
    assert (rendered(scene, 6, tmp_path) == baked[1][6]["Image"]).all()
    assert len(extension.compositor.tree.nodes_of(scene, picture.id)) == 1
    new = write_frame(tmp_path / "frames" / "frame_0006.exr", 66)
    bpy.ops.stillwater.refresh()
    assert (rendered(scene, 6, tmp_path) == new["Image"]).all()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "saved.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "saved.blend"))
    assert (rendered(bpy.context.scene, 7, tmp_path) == baked[1][7]["Image"]).all()


@pytest.mark.parametrize("kind", ["LINK_COPY", "FULL_COPY"])
def test_a_copied_scene_gets_groups_of_its_own_when_it_is_baked(extension, scene, baked, tmp_path, kind):
    grouped(extension, scene, baked[0], 2)
    bpy.ops.scene.new(type=kind)
    copy = bpy.data.scenes["Scene.001"]
    ours = extension.compositor.tree.claim(copy, copy.stillwater.pictures[0])
    own = write_frame(tmp_path / "own" / "frame_0006.exr", 1)
    ours.stillwater.folder, ours.stillwater.first, ours.stillwater.last = str(tmp_path / "own"), 5, 8
    extension.compositor.tree.show(ours)
    assert (rendered(copy, 6, tmp_path) == own["Image"]).all()
    assert (rendered(bpy.data.scenes["Scene"], 6, tmp_path) == baked[1][6]["Image"]).all()


def test_it_works_in_a_second_scene(extension, scene, baked, tmp_path):
    """Another scene shows the first one's picture: one tree, two compositors."""
    other = bpy.data.scenes.new("Other")
    set_up(other)
    extension.compositor.tree.wire(other, baked[0])
    for frame in (5, 8):
        same(render(other, frame, tmp_path), baked[1][frame])
        same(render(scene, frame, tmp_path), baked[1][frame])


def test_a_duplicated_node_shows_the_same_and_goes_alone(extension, scene, picture, baked, tmp_path):
    first = extension.compositor.tree.nodes_of(scene, picture.id)[0]
    second = extension.compositor.tree.add_node(scene, first.node_tree)
    top = extension.versions.compositor_tree(scene)
    top.links.new(second.outputs["Image"], extension.versions.output_socket(top))
    top.nodes.remove(first)
    same(render(scene, 6, tmp_path), baked[1][6])


def test_undoing_a_new_node_and_redoing_it(extension, scene, picture, baked, tmp_path):
    bpy.ops.ed.undo_push(message="before")
    identifier = picture.id
    bpy.ops.stillwater.add_node("EXEC_DEFAULT", True)
    bpy.ops.ed.undo()
    count = lambda: len(extension.compositor.tree.nodes_of(bpy.context.scene, identifier))  # noqa: E731
    assert count() == 1
    bpy.ops.ed.redo()
    assert count() == 2
    same(render(bpy.context.scene, 6, tmp_path), baked[1][6])


def test_without_a_picture_no_node_is_offered(scene):
    assert not bpy.ops.stillwater.add_node.poll()


def test_an_artist_s_compositor_is_kept(extension, scene, picture):
    top = extension.versions.compositor_tree(scene, create=True)
    blur = top.nodes.new("CompositorNodeBlur")
    top.links.new(blur.outputs[0], extension.versions.output_socket(top))
    tree = extension.compositor.tree.ensure(scene, picture)
    extension.compositor.tree.wire(scene, tree)
    assert blur.name in top.nodes
    assert extension.versions.output_socket(top).links[0].from_node.node_tree == tree


def test_frames_of_an_earlier_longer_bake_do_not_count(extension, baked, tmp_path):
    write_frame(tmp_path / "frames" / "frame_0004.exr", 4)
    assert extension.compositor.tree.show(baked[0]) == [5, 6, 7, 8]
