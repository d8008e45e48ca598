"""The empty stage in Blender: camera, sun, sky light, and rendering one layer of objects at a time."""

import argparse
import contextlib
import math
import os
import sys
import tempfile

import bpy
import numpy as np
from mathutils import Matrix, Vector

bpy.utils.expose_bundled_modules()


def asked(description: str, folder: str, width: int = 1280, shape: tuple[int, int] = (8, 5)) -> argparse.Namespace:
    """The command line of a scene: width, height (by the picture's shape, width : height) and output folder."""
    arguments = argparse.ArgumentParser(description=description)
    arguments.add_argument("--width", type=int, default=width, help="pixels; the brushes shrink with it")
    arguments.add_argument("--output", default=folder, help="folder of the picture, mattes/ and behind/")
    given = arguments.parse_args()
    given.height = given.width * shape[1] // shape[0]
    return given


def clear(width: int, height: int, samples: int = 24) -> None:
    """An empty scene that renders with Cycles on the CPU, linear, without a view transform."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = samples
    scene.cycles.use_denoising = True
    scene.cycles.use_adaptive_sampling = True
    scene.cycles.adaptive_threshold = 0.05
    scene.cycles.max_bounces = 4
    scene.cycles.seed = 0
    scene.render.use_persistent_data = True
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.image_settings.color_mode = "RGBA"
    scene.view_settings.view_transform = "Standard"
    scene.world = bpy.data.worlds.new("sky")


def camera(at: tuple, towards: tuple, fov: float, roll: float = 0.0) -> bpy.types.Object:
    """A camera at `at` that looks towards a point; fov horizontal, roll clockwise (the horizon then rises left to
    right), both in degrees."""
    data = bpy.data.cameras.new("camera")
    data.sensor_fit = "HORIZONTAL"
    data.angle = math.radians(fov)
    data.clip_end = 1e5
    eye = bpy.data.objects.new("camera", data)
    eye.location = at
    look = (Vector(towards) - Vector(at)).to_track_quat("-Z", "Y")
    eye.rotation_euler = (look.to_matrix() @ _turn(-roll)).to_euler()
    bpy.context.scene.collection.objects.link(eye)
    bpy.context.scene.camera = eye
    bpy.context.view_layer.update()
    return eye


def _turn(degrees: float):
    return Matrix.Rotation(math.radians(degrees), 3, "Z")


def place(point) -> tuple[float, float]:
    """Where a point of the world stands in the picture, in pixels from the top left corner."""
    from bpy_extras.object_utils import world_to_camera_view

    scene = bpy.context.scene
    u = world_to_camera_view(scene, scene.camera, Vector(point))
    return round(u.x * scene.render.resolution_x, 1), round((1 - u.y) * scene.render.resolution_y, 1)


def horizon() -> list[list[float]]:
    """The horizon as a line from the picture's left border to its right one."""
    scene = bpy.context.scene
    eye = scene.camera.matrix_world.translation
    ahead = scene.camera.matrix_world.to_quaternion() @ Vector((0, 0, -1))
    heading = math.atan2(ahead.y, ahead.x)
    far = [place((eye.x + 1e6 * math.cos(heading + a), eye.y + 1e6 * math.sin(heading + a), eye.z))
           for a in (0.2, -0.2)]
    slope = (far[1][1] - far[0][1]) / (far[1][0] - far[0][0])
    ends = (0.0, float(scene.render.resolution_x))
    return [[x, round(far[0][1] + slope * (x - far[0][0]), 1)] for x in ends]


def sun(azimuth: float, elevation: float, colour: tuple, strength: float, size: float = 2.0,
        mirrored: bool = True) -> None:
    """Sunlight that comes from azimuth (degrees, 0 = +X, 90 = +Y) and elevation; size: the sun's disc, degrees.

    mirrored: its disc shows in what mirrors; a glow of the sky (see `sky`) may stand for it instead.
    """
    data = bpy.data.lights.new("sun", "SUN")
    data.color, data.energy, data.angle = colour, strength, math.radians(size)
    lamp = bpy.data.objects.new("sun", data)
    a, e = math.radians(azimuth), math.radians(elevation)
    back = Vector((math.cos(a) * math.cos(e), math.sin(a) * math.cos(e), math.sin(e)))
    lamp.rotation_euler = back.to_track_quat("Z", "Y").to_euler()
    lamp.visible_glossy = mirrored
    bpy.context.scene.collection.objects.link(lamp)


def glimmer(at: tuple, colour: tuple, watts: float, size: float) -> None:
    """Light that comes from a ball of radius `size` metres round `at`, which isn't seen itself."""
    data = bpy.data.lights.new("glimmer", "POINT")
    data.color, data.energy, data.shadow_soft_size = colour, watts, size
    lamp = bpy.data.objects.new("glimmer", data)
    lamp.location = at
    lamp.visible_camera = False
    bpy.context.scene.collection.objects.link(lamp)


def sky(stops: list[tuple[float, tuple]], strength: float = 1.0, *glows: tuple) -> None:
    """The world as a gradient over the sine of the elevation (0..1): stops (sine, linear colour).

    glows: each (direction, colour, power) adds light around a direction, the tighter the higher its power.
    """
    world = bpy.context.scene.world
    world.use_nodes = True
    tree = world.node_tree
    tree.nodes.clear()
    out = tree.nodes.new("ShaderNodeOutputWorld")
    shade = tree.nodes.new("ShaderNodeBackground")
    shade.inputs["Strength"].default_value = strength
    ramp = tree.nodes.new("ShaderNodeValToRGB")
    _fill_ramp(ramp, stops)
    split = tree.nodes.new("ShaderNodeSeparateXYZ")
    where = tree.nodes.new("ShaderNodeTexCoord")
    link = tree.links.new
    link(where.outputs["Generated"], split.inputs[0])
    link(split.outputs["Z"], ramp.inputs[0])
    colour = ramp.outputs[0]
    for direction, tint, power in glows:
        dot = tree.nodes.new("ShaderNodeVectorMath")
        dot.operation = "DOT_PRODUCT"
        dot.inputs[1].default_value = Vector(direction).normalized()
        link(where.outputs["Generated"], dot.inputs[0])
        clip = tree.nodes.new("ShaderNodeMath")
        clip.operation = "MAXIMUM"
        clip.inputs[1].default_value = 0.0
        link(dot.outputs["Value"], clip.inputs[0])
        raise_ = tree.nodes.new("ShaderNodeMath")
        raise_.operation = "POWER"
        raise_.inputs[1].default_value = power
        link(clip.outputs[0], raise_.inputs[0])
        add = tree.nodes.new("ShaderNodeMix")
        add.data_type, add.blend_type, add.clamp_factor = "RGBA", "ADD", False
        link(raise_.outputs[0], add.inputs["Factor"])
        link(colour, add.inputs["A"])
        add.inputs["B"].default_value = (*tint, 1)
        colour = add.outputs["Result"]
    link(colour, shade.inputs["Color"])
    link(shade.outputs[0], out.inputs[0])


def _fill_ramp(ramp, stops) -> None:
    elements = ramp.color_ramp.elements
    while len(elements) > 1:
        elements.remove(elements[-1])
    for k, (position, colour) in enumerate(stops):
        stop = elements[0] if k == 0 else elements.new(position)
        stop.position, stop.color = position, (*colour, 1)


def render(shown: list, hold_out: list = (), unseen: list = (), unmirrored: list = (),
           transparent: bool = True) -> np.ndarray:
    """Linear premultiplied RGBA (H, W, 4) of the objects `shown` as the camera sees them alone.

    All other objects still throw their shadows and light, but the `hold_out` ones cut what they hide, and the
    `unseen` ones are not there at all, and the `unmirrored` ones don't show in water.
    """
    import OpenImageIO as oiio

    scene = bpy.context.scene
    scene.render.film_transparent = transparent
    for thing in scene.objects:
        if thing.type in {"MESH", "CURVE"}:
            thing.visible_camera = thing in shown or thing in hold_out
            thing.is_holdout = thing in hold_out
            thing.hide_render = thing in unseen
            thing.visible_glossy = thing not in unmirrored
    with tempfile.TemporaryDirectory() as folder:
        scene.render.filepath = os.path.join(folder, "layer.exr")
        with _quiet():
            bpy.ops.render.render(write_still=True)
        image = oiio.ImageInput.open(scene.render.filepath)
        pixels = image.read_image("float")
        image.close()
    return np.ascontiguousarray(pixels[..., :4], np.float32)


def render_mirrored(shown: list, unseen: list = ()) -> np.ndarray:
    """What a calm sea at z = 0 would show of the objects `shown`: seen by the camera's mirror image, turned over."""
    eye = bpy.context.scene.camera
    upright = eye.matrix_world.copy()
    eye.matrix_world = Matrix.Diagonal((1, 1, -1, 1)) @ upright @ Matrix.Diagonal((1, -1, 1, 1))
    bpy.context.view_layer.update()
    image = render(shown, unseen=unseen)
    eye.matrix_world = upright
    bpy.context.view_layer.update()
    return np.ascontiguousarray(image[::-1])


@contextlib.contextmanager
def _quiet():
    """Blender's progress lines, written by its C code, go nowhere."""
    sys.stdout.flush()
    kept = os.dup(1)
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    try:
        yield
    finally:
        os.dup2(kept, 1)
        os.close(kept)
        os.close(nowhere)


def display(linear: np.ndarray, exposure: float = 1.0, purity: float = 1.1) -> np.ndarray:
    """Premultiplied linear RGBA to premultiplied display RGBA: a film's soft shoulder, then the sRGB curve."""
    alpha = np.clip(linear[..., 3:], 0, 1)
    straight = np.clip(linear[..., :3] / np.maximum(alpha, 1e-4), 0, None) * exposure
    straight = np.where(straight < 0.6, straight, 0.6 + 0.4 * (1 - np.exp(-(straight - 0.6) / 0.4)))
    grey = straight @ np.array([[0.3], [0.6], [0.1]], np.float32)
    straight = np.clip(grey + (straight - grey) * purity, 0, 1)
    curve = np.where(straight <= 0.0031308, 12.92 * straight, 1.055 * np.maximum(straight, 1e-6) ** (1 / 2.4) - 0.055)
    return np.concatenate([curve * alpha, alpha], axis=2).astype(np.float32)
