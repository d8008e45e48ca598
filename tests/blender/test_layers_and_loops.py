"""The node gives each layer that the frames hold alone, and goes round with a recipe that loops."""

import bpy
import numpy as np
from pixels import oiio, read_frame, render, same, write_frame


def shown(scene, extension, socket, frame, folder):
    """What one output of the scene's node gives at a frame."""
    picture = scene.stillwater.pictures[0]
    node = extension.compositor.tree.nodes_of(scene, picture.id)[0]
    top = extension.versions.compositor_tree(scene)
    top.links.new(node.outputs[socket], extension.versions.output_socket(top))
    settings = scene.render.image_settings
    settings.file_format, settings.color_mode, settings.color_depth = "OPEN_EXR", "RGBA", "32"
    scene.render.filepath = str(folder / "shown.exr")
    scene.frame_set(frame)
    bpy.ops.render.render(write_still=True)
    top.links.new(node.outputs["Image"], extension.versions.output_socket(top))
    return oiio.ImageBuf(scene.render.filepath).get_pixels("float")


def layer_of(path, layer):
    image = oiio.ImageBuf(str(path))
    names = image.spec().channelnames
    return image.get_pixels("float")[..., [names.index(f"{layer}.Combined.{part}") for part in "RGBA"]]


def outputs(extension):
    scene = bpy.context.scene
    node = extension.compositor.tree.nodes_of(scene, scene.stillwater.pictures[0].id)[0]
    return [output.name for output in node.outputs if output.enabled and output.name]


def test_each_layer_is_an_output_with_what_its_file_holds(extension, painted, tmp_path):
    scene = bpy.context.scene
    picture = scene.stillwater.pictures[0]
    picture.layers[1].name = "far. sky"
    picture.output.layers = True
    bpy.ops.stillwater.bake()
    assert outputs(extension) == ["Image", "Alpha", "Flow", "Matte", "tree", "far. sky"]
    for frame in (5, 8):
        path = painted / f"frame_{frame:04d}.exr"
        same(render(scene, frame, tmp_path), read_frame(path))
        for socket, layer in (("tree", "tree"), ("far. sky", "far%2E sky")):
            wanted = layer_of(path, layer)
            assert wanted.max() > 0.1
            np.testing.assert_array_equal(shown(scene, extension, socket, frame, tmp_path), wanted)


def test_layers_come_and_go_and_links_of_the_others_stay(extension, painted, tmp_path):
    scene = bpy.context.scene
    picture = scene.stillwater.pictures[0]
    picture.output.layers = True
    bpy.ops.stillwater.bake()
    top = extension.versions.compositor_tree(scene)
    picture.layers[1].visible = False
    picture.layers[0].name = "Matte"
    bpy.ops.stillwater.bake()
    assert outputs(extension) == ["Image", "Alpha", "Flow", "Matte", "Matte.001"]
    assert extension.versions.output_socket(top).links[0].from_socket.name == "Image"
    picture.output.layers = False
    bpy.ops.stillwater.bake()
    assert outputs(extension) == ["Image", "Alpha", "Flow", "Matte"]
    assert sorted(n.name for n in picture.tree.nodes if n.bl_idname == "CompositorNodeImage") == ["Frames", "Picture"]
    picture.layers[1].visible = True
    same(render(scene, 6, tmp_path), read_frame(painted / "frame_0006.exr"))


def test_frames_that_hold_no_layers_yet_give_nothing_there(extension, painted):
    scene = bpy.context.scene
    picture = scene.stillwater.pictures[0]
    bpy.ops.stillwater.bake()
    picture.output.layers = True
    tree = picture.tree
    tree.stillwater.layers = '[["tree", "tree"]]'
    extension.compositor.tree.show(tree)
    assert outputs(extension)[-1] == "tree" and tree.nodes["Frames tree"].image is None
    bpy.ops.stillwater.bake()
    assert tree.nodes["Frames tree"].image == tree.nodes["Frames"].image != None  # noqa: E711


def test_a_loop_goes_round(extension, scene, baked, tmp_path):
    tree, frames = baked
    tree.stillwater.loop = True
    extension.compositor.tree.show(tree)
    for frame, wanted in {4: 8, 9: 5, 12: 8, 14: 6, 1: 5}.items():
        same(render(scene, frame, tmp_path), frames[wanted])


def test_a_loop_with_frames_missing_goes_round_too(extension, scene, baked, tmp_path):
    tree, frames = baked
    (tmp_path / "frames" / "frame_0005.exr").unlink()
    (tmp_path / "frames" / "frame_0007.exr").unlink()
    tree.stillwater.loop = True
    extension.compositor.tree.show(tree)
    for frame, wanted in {5: 6, 7: 6, 8: 8, 9: 6, 11: 6, 12: 8, 4: 8, 3: 6}.items():
        same(render(scene, frame, tmp_path), frames[wanted])
    frames[5] = write_frame(tmp_path / "frames" / "frame_0005.exr", 5)
    frames[7] = write_frame(tmp_path / "frames" / "frame_0007.exr", 7)
    extension.compositor.tree.show(tree)
    same(render(scene, 9, tmp_path), frames[5])


def test_a_recipe_that_loops_makes_the_node_loop(extension, painted, tmp_path):
    scene = bpy.context.scene
    picture = scene.stillwater.pictures[0]
    picture.loop = True
    bpy.ops.stillwater.bake()
    assert picture.tree.nodes["Frames"].use_cyclic
    same(render(scene, 9, tmp_path), read_frame(painted / "frame_0005.exr"))
    picture.loop = False
    bpy.ops.stillwater.bake()
    assert not picture.tree.nodes["Frames"].use_cyclic
