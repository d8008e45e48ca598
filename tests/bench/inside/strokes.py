"""Runs in Blender, see ../strokes.py: milliseconds for each type of curve."""

import json
import os
import statistics
import sys
import time
from pathlib import Path

import bpy
import numpy as np

bpy.ops.extensions.package_install_files(repo="user_default", filepath=sys.argv[1], enable_on_install=True)
bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
sys.path.insert(0, str(Path(__file__).parents[2] / "blender"))
import drawings  # noqa: E402
from drawings import strokes  # noqa: E402

COUNT, RUNS = 10000, 15


def stroke() -> dict[str, np.ndarray]:
    """A loop through the whole picture with a hand's tremor, pressed harder and softer."""
    t = np.linspace(0, 1, COUNT)
    points = np.stack([3.5 * np.cos(9 * t) * (1 - 0.5 * t), 2 * np.sin(7 * t) * (1 - 0.3 * t), 0 * t], axis=1)
    points[:, :2] += np.random.default_rng(1).normal(0, 0.0003, (COUNT, 2))
    handle = np.gradient(points, axis=0) / 3
    radius = 0.02 + 0.01 * np.sin(40 * t)
    return {"position": points, "radius": radius, "handle_left": points - handle, "handle_right": points + handle}


def main() -> None:
    scene = bpy.context.scene
    picture = scene.stillwater.pictures.add()
    picture.id, picture.name = "0123456789ab", "Lake"
    drawings.lay_out(scene, picture)
    drawings.add_camera(scene, picture, "PERSP")
    role = strokes.roles.by_key("waterline")
    part = strokes.gp_layers.ensure(picture, "0123456789ab", role)
    drawing = part.frames.new(1).drawing
    drawing.add_strokes([COUNT])
    for name, values in stroke().items():
        kind, domain = drawings.KINDS[name]
        stored = drawing.attributes.get(name) or drawing.attributes.new(name, kind, domain)
        stored.data.foreach_set("vector" if values.ndim == 2 else "value", values.astype(np.float32).ravel())
    measured = {}
    for kind in ("POLY", "CATMULL_ROM", "BEZIER"):
        drawing.set_types(type=kind)
        taken = []
        for _ in range(RUNS):
            start = time.perf_counter()
            line = strokes.drawn(scene, picture)("0123456789ab", "waterline")
            taken.append(time.perf_counter() - start)
        assert len(line) >= COUNT
        measured[kind] = statistics.median(taken) * 1e3
    print(json.dumps(measured))


main()
sys.stdout.flush()
os._exit(0)  # Blender as a module can hang at its exit
