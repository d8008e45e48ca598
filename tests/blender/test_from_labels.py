"""Layers from masks and from passes of a render: label maps, checked against Blender's own renders of both."""

import importlib

import bpy
import cutting
import numpy as np
import pytest
import stillwater
from layered import now, said
from pixels import PACKAGE, oiio
from stillwater import _stillwater as engine

label_maps = importlib.import_module(f"{PACKAGE}.layers.label_maps")
versions = importlib.import_module(f"{PACKAGE}.versions")
SIZE = (96, 54)


@pytest.fixture
def picture(scene, tmp_path):
    picture = cutting.open_picture(scene, tmp_path, SIZE)
    bpy.ops.stillwater.remove_layer()
    return picture


def labels_of(layer) -> np.ndarray:
    return engine.read_labels(bpy.path.abspath(layer.matte.labels))


def add_mask(name="Mask", **shapes) -> None:
    """A mask with a layer for each shape, a list of corners with the handles at them unless given."""
    mask = bpy.data.masks.new(name)
    for name, corners in shapes.items():
        spline = mask.layers.new(name=name).splines.new()
        spline.use_cyclic = True
        spline.points.add(len(corners) - 1)
        for point, (x, y, *bend) in zip(spline.points, corners, strict=True):
            dx, dy = bend or (0, 0)
            point.handle_type = "FREE"
            point.co, point.handle_left, point.handle_right = (x, y), (x - dx, y - dy), (x + dx, y + dy)


BLOB = [(0.2, 0.3, 0.1, -0.05), (0.6, 0.4, 0.0, 0.1), (0.3, 0.7, -0.15, 0.0)]
BAR = [(0.55, 0.35), (0.95, 0.4), (0.9, 0.55), (0.5, 0.5)]


def rendered_mask(folder, mask) -> np.ndarray:
    """What Blender's compositor makes of a mask at the picture's size."""
    scene = bpy.data.scenes.new("mask")
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = *SIZE, 100
    scene.view_settings.view_transform = "Raw"
    versions.use_compositor(scene)
    tree = versions.compositor_tree(scene, create=True)
    node = tree.nodes.new("CompositorNodeMask")
    node.mask = mask
    tree.links.new(node.outputs[0], versions.output_socket(tree))
    settings = scene.render.image_settings
    settings.file_format, settings.color_depth = "OPEN_EXR", "32"
    scene.render.filepath = str(folder / "mask.exr")
    camera = bpy.data.objects.new("eye", bpy.data.cameras.new("eye"))
    scene.collection.objects.link(camera)
    scene.camera, scene.render.engine = camera, "BLENDER_WORKBENCH"
    bpy.context.window.scene = scene
    bpy.ops.render.render(write_still=True)
    return oiio.ImageBuf(str(folder / "mask.exr")).get_pixels("float")[..., 0]


def test_a_mask_becomes_a_layer_for_each_of_its_layers(extension, picture, tmp_path):
    add_mask(oak=BAR, lake=BLOB)
    assert bpy.ops.stillwater.layers_from_mask("EXEC_DEFAULT", True) == {"FINISHED"}
    assert [layer.name for layer in now().layers] == ["oak", "lake", "Background"] or [
        layer.name for layer in now().layers] == ["lake", "oak", "Background"]
    front, back = now().layers[0], now().layers[1]
    assert front.matte.form == back.matte.form == "labels" and front.matte.labels.startswith("//")
    labels = labels_of(front)
    assert labels.shape == SIZE[::-1] and set(np.unique(labels)) == {0, front.matte.value, back.matte.value}
    assert stillwater.parse(said(extension))


def test_its_shape_is_blender_s_own(picture, tmp_path):
    for name, corners in (("blob", BLOB), ("bar", BAR)):
        add_mask(name, part=corners)
        assert bpy.ops.stillwater.layers_from_mask(mask=name) == {"FINISHED"}
        ours = labels_of(now().layers[0]) > 0
        scene = bpy.context.scene
        theirs = rendered_mask(tmp_path, bpy.data.masks[name]) > 0.5
        bpy.context.window.scene = scene
        assert theirs.sum() > 200 and (ours != theirs).sum() < 0.04 * theirs.sum()


def test_which_mask_is_asked_where_it_is_not_known(picture):
    with pytest.raises(RuntimeError, match="There is no mask in this file"):
        bpy.ops.stillwater.layers_from_mask()
    add_mask("One", oak=BAR)
    add_mask("Two", elm=BLOB)
    with pytest.raises(RuntimeError, match="Say which mask: there are several"):
        bpy.ops.stillwater.layers_from_mask()
    with pytest.raises(RuntimeError, match="Three: there is no such mask"):
        bpy.ops.stillwater.layers_from_mask(mask="Three")
    assert bpy.ops.stillwater.layers_from_mask(mask="Two") == {"FINISHED"}
    assert now().layers[0].name == "elm"


def test_a_mask_of_nothing_is_a_sentence(picture):
    add_mask("Empty", oak=[(3, 3), (3.1, 3), (3.1, 3.1)])
    with pytest.raises(RuntimeError, match="Empty: nothing is marked in it"):
        bpy.ops.stillwater.layers_from_mask()
    assert len(now().layers) == 1


def test_undo_takes_the_layers_away(picture):
    add_mask(oak=BAR)
    bpy.ops.ed.undo_push(message="before")
    bpy.ops.stillwater.layers_from_mask("EXEC_DEFAULT", True)
    assert len(now().layers) == 2
    bpy.ops.ed.undo()
    assert len(now().layers) == 1
    bpy.ops.ed.redo()
    assert len(now().layers) == 2


@pytest.fixture
def rendered(scene, tmp_path):
    """A render of two cubes with both passes, as Blender writes it; returns its path."""
    made = bpy.data.scenes.new("cubes")
    made.render.engine, made.cycles.samples, made.cycles.device = "CYCLES", 1, "CPU"
    made.render.resolution_x, made.render.resolution_y, made.render.resolution_percentage = *SIZE, 100
    camera = bpy.data.objects.new("eye", bpy.data.cameras.new("eye"))
    camera.location, camera.data.type, camera.data.ortho_scale = (0, 0, 10), "ORTHO", 10
    made.collection.objects.link(camera)
    made.camera = camera
    for name, index, x in (("Left Cube", 3, -2.5), ("Right Cube", 7, 2.5)):
        mesh = bpy.data.meshes.new(name)
        mesh.from_pydata([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], [], [(0, 1, 2, 3)])
        cube = bpy.data.objects.new(name, mesh)
        cube.location.x, cube.pass_index = x, index
        made.collection.objects.link(cube)
    settings = made.render.image_settings
    if hasattr(settings, "media_type"):
        settings.media_type = "MULTI_LAYER_IMAGE"
    settings.file_format, settings.color_depth = "OPEN_EXR_MULTILAYER", "32"

    def render(**passes) -> str:
        for name, on in passes.items():
            setattr(made.view_layers[0], name, on)
        made.render.filepath = str(tmp_path / "cubes.exr")
        before = bpy.context.window.scene
        bpy.context.window.scene = made
        bpy.ops.render.render(write_still=True)
        bpy.context.window.scene = before
        return made.render.filepath

    return render


def squares(labels) -> None:
    """Left and right of the middle, a fifth of the width each."""
    values = labels[27, 24], labels[27, 72]
    assert labels[27, 48] == 0 and 0 not in values and values[0] != values[1]
    for value, left in ((values[0], 14.4), (values[1], 62.4)):
        rows, columns = np.nonzero(labels == value)
        assert abs(columns.min() - left) <= 1 and abs(columns.max() + 1 - left - 19.2) <= 1
        assert abs(rows.min() - 17.4) <= 1 and abs(rows.max() + 1 - 36.6) <= 1


def test_a_cryptomatte_becomes_layers_with_its_names(extension, picture, rendered):
    path = rendered(use_pass_cryptomatte_object=True)
    assert bpy.ops.stillwater.layers_from_pass("EXEC_DEFAULT", True, filepath=path) == {"FINISHED"}
    assert {layer.name for layer in now().layers} == {"Left Cube", "Right Cube", "Background"}
    squares(labels_of(now().layers[0]))
    assert stillwater.parse(said(extension))


def test_an_object_index_becomes_layers(picture, rendered):
    path = rendered(use_pass_object_index=True)
    assert bpy.ops.stillwater.layers_from_pass(filepath=path) == {"FINISHED"}
    assert [layer.name for layer in now().layers] == ["3", "7", "Background"]
    squares(labels_of(now().layers[0]))


def test_files_that_say_nothing_are_sentences(picture, rendered, tmp_path):
    with pytest.raises(RuntimeError, match="has neither an Object Index nor a Cryptomatte pass"):
        bpy.ops.stillwater.layers_from_pass(filepath=rendered())
    with pytest.raises(RuntimeError, match="none.exr: there is no such file"):
        bpy.ops.stillwater.layers_from_pass(filepath=str(tmp_path / "none.exr"))
    (tmp_path / "broken.exr").write_bytes(b"no picture")
    with pytest.raises(RuntimeError, match="can't be read"):
        bpy.ops.stillwater.layers_from_pass(filepath=str(tmp_path / "broken.exr"))
    assert len(now().layers) == 1


def test_another_size_is_a_sentence(extension, picture, scene, tmp_path, rendered):
    path = rendered(use_pass_object_index=True)
    picture.picture_size = (97, 54)
    with pytest.raises(RuntimeError, match="96 x 54 px is not the picture's size, 97 x 54"):
        bpy.ops.stillwater.layers_from_pass(filepath=path)


def test_a_pixel_is_of_what_covers_most_of_it():
    ids = np.array([0x3F000001, 0x3F000002], np.uint32).view(np.float32)
    first, second = np.full((1, 4), ids[0]), np.full((1, 4), ids[1])
    ranks = [(first, np.array([[0.6, 0.3, 0.45, 0.0]])), (second, np.array([[0.4, 0.6, 0.1, 0.0]]))]
    found = label_maps.from_cryptomatte(ranks, {"oak": "3f000001"})
    assert found.labels.tolist() == [[1, 2, 0, 0]] or found.labels.tolist() == [[1, 2, 1, 0]]
    assert found.names == {1: "oak", 2: "3f000002"}


def test_more_parts_than_a_map_holds_are_a_sentence(extension, picture):
    from_labels = importlib.import_module(f"{PACKAGE}.layers.from_labels")
    labels = np.arange(SIZE[0] * SIZE[1]).reshape(SIZE[::-1]) % 300
    with pytest.raises(ValueError, match="299 parts are more than a label map holds"):
        from_labels.add_layers(picture, "Many", label_maps.from_index(labels))
    assert len(picture.layers) == 1
