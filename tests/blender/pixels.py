"""Frames as the engine writes them, and what the compositor makes of them."""

import importlib
from pathlib import Path

import bpy
import numpy as np

bpy.utils.expose_bundled_modules()
import OpenImageIO as oiio  # noqa: E402  Blender's own

PACKAGE = "bl_ext.user_default.stillwater"
PASSES = {"Combined": "RGBA", "Flow": "XYZ", "Matte": "V"}
CHANNELS = [*"RGBA", *(f"Stillwater.{name}.{part}" for name, parts in PASSES.items() for part in parts)]
KINDS = {"Image": "RGBA", "Alpha": "FLOAT", "Flow": "VECTOR", "Matte": "FLOAT"}
WIDTH, HEIGHT = 16, 8


def write_frame(path: Path, seed: int) -> dict[str, np.ndarray]:
    """A frame as the engine writes it, of random numbers that are not zero; returns what the node is to give."""
    noise = np.random.default_rng(seed)
    pixels = noise.uniform(0.1, 1, (HEIGHT, WIDTH, 8)).astype(np.float32)
    pixels[..., :3] *= 2 * pixels[..., 3:4]  # premultiplied, some above 1
    pixels[..., 4:6] = noise.uniform(1, 30, (HEIGHT, WIDTH, 2)) * noise.choice([-1, 1], (HEIGHT, WIDTH, 2))
    pixels[..., 6] = 0
    pixels = np.concatenate([1 - pixels[..., :4], pixels], 2)  # not the pass: the node must show that one
    spec = oiio.ImageSpec(WIDTH, HEIGHT, 12, "float")
    spec.channelnames = CHANNELS
    spec.channelformats = ("half",) * 8 + ("float",) * 3 + ("half",)
    path.parent.mkdir(parents=True, exist_ok=True)
    file = oiio.ImageOutput.create(str(path))
    assert file.open(str(path), spec) and file.write_image(pixels) and file.close(), file.geterror()
    return read_frame(path)


def read_frame(path: Path) -> dict[str, np.ndarray]:
    """A frame's file, under the names of the node's outputs."""
    image = oiio.ImageBuf(str(path))
    pixels, names = image.get_pixels("float"), image.spec().channelnames
    passes = {"Image": ("Combined", "RGBA"), "Alpha": ("Combined", "A"), "Flow": ("Flow", "XYZ")}
    passes["Matte"] = ("Matte", "V")
    return {
        output: np.stack([pixels[..., names.index(f"Stillwater.{name}.{part}")] for part in parts], -1)
        for output, (name, parts) in passes.items()
    }


def _file_output(tree, folder: Path):
    """A File Output node that writes every output of the Stillwater node at full precision."""
    node = tree.nodes.new("CompositorNodeOutputFile")
    if hasattr(node, "file_output_items"):  # 5.0 and later
        node.format.media_type = "MULTI_LAYER_IMAGE"
        node.directory, node.file_name = str(folder), "shown_"
        add = lambda name: node.file_output_items.new(KINDS[name], name)  # noqa: E731
    else:
        node.base_path = str(folder / "shown_")
        node.layer_slots.clear()
        add = node.layer_slots.new
    node.format.file_format, node.format.color_depth = "OPEN_EXR_MULTILAYER", "32"
    for name in KINDS:
        add(name)
    return node


def render(scene, frame: int, folder: Path) -> dict[str, np.ndarray]:
    """Renders one frame and returns every output of the scene's Stillwater node, and the picture as "Render"."""
    extension = importlib.import_module(f"{PACKAGE}.versions")
    tree = extension.compositor_tree(scene)
    shown = next(node for node in tree.nodes if node.bl_idname == "CompositorNodeGroup")
    file = _file_output(tree, folder)
    for name in KINDS:
        tree.links.new(shown.outputs[name], file.inputs[name])
    settings = scene.render.image_settings
    settings.file_format, settings.color_mode, settings.color_depth = "OPEN_EXR", "RGBA", "32"
    scene.render.filepath = str(folder / "render.exr")
    bpy.context.window.scene = scene
    scene.frame_set(frame)
    bpy.ops.render.render(write_still=True)
    tree.nodes.remove(file)

    result = _read_output(folder)
    result["Render"] = oiio.ImageBuf(str(folder / "render.exr")).get_pixels("float")
    return result


def _read_output(folder: Path) -> dict[str, np.ndarray]:
    """What the File Output node wrote, under the names of the Stillwater node's outputs."""
    path = next(folder.glob("shown_*.exr"), None)  # 4.5 puts the frame's number into a still's name, 5.2 does not
    if path is None:  # 5.2 writes no file of nothing
        return {}
    channels = {}
    file = oiio.ImageInput.open(str(path))
    part = 0
    while file.seek_subimage(part, 0):  # 4.5 writes one part, 5.2 one for each output
        pixels = file.read_image("float")
        channels |= {name: pixels[..., i] for i, name in enumerate(file.spec().channelnames)}
        part += 1
    file.close()
    path.unlink()
    parts = {"Image": "RGBA", "Alpha": "V", "Flow": "XYZ", "Matte": "V"}
    return {name: np.stack([channels[f"{name}.{letter}"] for letter in letters], -1) for name, letters in parts.items()}


def same(shown: dict, frame: dict) -> None:
    """Every output of the node equals the frame's file, bit by bit, and none is empty."""
    for name, wanted in frame.items():
        assert np.abs(wanted[..., :2]).min() > 0
        np.testing.assert_array_equal(shown[name], wanted, name)
    np.testing.assert_array_equal(shown["Render"], frame["Image"], "Render")


def set_up(scene) -> None:
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = WIDTH, HEIGHT, 100
    scene.view_settings.view_transform = "Standard"
    scene.frame_start, scene.frame_end = 5, 8
