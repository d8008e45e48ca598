"""Fluids from Blender's Mantaflow, for the clips that samples take their motion from.

A real Blender must run this: the bpy package can't bake Mantaflow. Only bpy and numpy are needed.
"""

import shutil
import subprocess
import tempfile
from pathlib import Path

import bpy
import numpy as np

TIME_LIMIT = 300  # seconds for ffmpeg


def box(name: str, low, high) -> bpy.types.Object:
    """A box from corner `low` to corner `high`, metres; its own origin is its middle."""
    low, high = np.asarray(low, float), np.asarray(high, float)
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * (high - low) / 2
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    data = bpy.data.meshes.new(name)
    data.from_pydata(corners.tolist(), [], faces)
    thing = bpy.data.objects.new(name, data)
    thing.location = (low + high) / 2
    bpy.context.scene.collection.objects.link(thing)
    return thing


def ball(name: str, at, radii) -> bpy.types.Object:
    """A ball of the given radii (metres) round `at`."""
    tilt, turn = np.meshgrid(np.linspace(0, np.pi, 13), np.linspace(0, 2 * np.pi, 24, endpoint=False), indexing="ij")
    points = np.stack([np.sin(tilt) * np.cos(turn), np.sin(tilt) * np.sin(turn), np.cos(tilt)], axis=-1) * np.asarray(radii)
    rows, around = tilt.shape
    faces = [(r * around + c, (r + 1) * around + c, (r + 1) * around + (c + 1) % around, r * around + (c + 1) % around)
             for r in range(rows - 1) for c in range(around)]
    data = bpy.data.meshes.new(name)
    data.from_pydata(points.reshape(-1, 3).tolist(), [], faces)
    thing = bpy.data.objects.new(name, data)
    thing.location = at
    bpy.context.scene.collection.objects.link(thing)
    return thing


def domain(kind: str, low, high, cells: int, frames: tuple[int, int]):
    """An empty scene at 24 fps with a fluid domain of `cells` along its longest side; kind: "GAS" or "LIQUID".
    Returns the domain's object and its settings."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.fps = 24
    scene.frame_start, scene.frame_end = frames
    room = box("domain", low, high)
    settings = _fluid(room, "DOMAIN").domain_settings
    settings.domain_type = kind
    settings.resolution_max = cells
    settings.cache_type = "ALL"
    settings.cache_frame_start, settings.cache_frame_end = frames
    for side in ("front", "back", "left", "right", "top", "bottom"):
        setattr(settings, f"use_collision_border_{side}", False)
    return room, settings


def source(thing: bpy.types.Object, kind: str):
    """Makes `thing` an inflow of "FIRE", "SMOKE" or "LIQUID"; returns its settings."""
    settings = _fluid(thing, "FLOW").flow_settings
    settings.flow_type, settings.flow_behavior = kind, "INFLOW"
    return settings


def obstacle(thing: bpy.types.Object) -> None:
    _fluid(thing, "EFFECTOR").effector_settings.effector_type = "COLLISION"


def _fluid(thing: bpy.types.Object, kind: str):
    fluid = thing.modifiers.new("Fluid", "FLUID")
    fluid.fluid_type = kind
    return fluid


def baked(room: bpy.types.Object, first: int):
    """Bakes the domain and yields, for each frame from `first` on, its number and the domain's object in it."""
    scene = bpy.context.scene
    with tempfile.TemporaryDirectory() as cache:
        room.modifiers["Fluid"].domain_settings.cache_directory = cache
        bpy.context.view_layer.objects.active = room
        room.select_set(True)
        if bpy.ops.fluid.bake_all() != {"FINISHED"}:
            raise RuntimeError("Mantaflow did not bake")
        for frame in range(first, scene.frame_end + 1):
            scene.frame_set(frame)
            yield frame, room.evaluated_get(bpy.context.evaluated_depsgraph_get())


def volume(seen: bpy.types.Object, name: str) -> np.ndarray:
    """A grid of a gas, "flame" or "density", as (z, y, x)."""
    settings = seen.modifiers["Fluid"].domain_settings
    values = np.array(getattr(settings, f"{name}_grid"), np.float32)
    x, y, z = settings.domain_resolution
    finer = round((len(values) / (x * y * z)) ** (1 / 3)) if len(values) else 1
    if len(values) != x * y * z * finer**3:
        raise RuntimeError(f"{name}: {len(values)} values are not {x} x {y} x {z} cells")
    return values.reshape(z * finer, y * finer, x * finer)


def drops(seen: bpy.types.Object) -> tuple[np.ndarray, np.ndarray]:
    """The particles of a liquid: where they are (N, 3), metres, and how fast (N, 3), metres a second."""
    particles = seen.particle_systems[0].particles
    at, speed = np.empty((2, len(particles) * 3), np.float32)
    particles.foreach_get("location", at)
    particles.foreach_get("velocity", speed)
    return at.reshape(-1, 3), speed.reshape(-1, 3)


def write_clip(frames: list[np.ndarray], path: Path, quality: int = 18) -> None:
    """H.264 at 24 fps of display values (H, W, 3), 0..1; quality: x264's, less is better."""
    height, width = frames[0].shape[:2]
    ffmpeg = shutil.which("ffmpeg")
    if ffmpeg is None:
        raise RuntimeError("ffmpeg is not installed")
    command = [ffmpeg, "-y", "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}", "-r", "24",
               "-i", "-", "-vf", "scale=out_color_matrix=bt709", "-pix_fmt", "yuv420p", "-colorspace", "bt709",
               "-color_primaries", "bt709", "-color_trc", "bt709", "-c:v", "libx264", "-crf", str(quality),
               "-preset", "slow", "-movflags", "+faststart", str(path)]
    data = b"".join((np.clip(frame, 0, 1) * 255 + 0.5).astype(np.uint8).tobytes() for frame in frames)
    subprocess.run(command, input=data, check=True, timeout=TIME_LIMIT)
