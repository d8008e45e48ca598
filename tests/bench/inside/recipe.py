"""Runs in Blender, see ../recipe.py: milliseconds for a bake's recipe."""

import importlib
import json
import os
import statistics
import sys
import time
from pathlib import Path

import bpy

PACKAGE = "bl_ext.user_default.stillwater"
LAYERS, FRAMES, RUNS = 30, 1000, 15
KEYS = [(1, 0.2), (300, 1.7), (650, 0.4), (1000, 1.1)]

bpy.ops.extensions.package_install_files(repo="user_default", filepath=sys.argv[1], enable_on_install=True)
bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
extension = importlib.import_module(PACKAGE)


def main() -> None:
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = 1, FRAMES
    picture = scene.stillwater.pictures.add()
    picture.id, picture.name = "0123456789ab", "Lake"
    for i in range(LAYERS):
        extension.properties.arrange.add_layer(picture, f"tree {i}").motion.type = "sway"
    for i in range(LAYERS):
        path = f"stillwater.pictures[0].layers[{i}].motion.sway.amount"
        extension.versions.set_curve(scene, path, 0, KEYS, "BEZIER")
    taken = []
    for _ in range(RUNS):
        start = time.perf_counter()
        recipe = extension.bake.job.describe(scene, picture, Path("/"))
        taken.append(time.perf_counter() - start)
    assert all(len(layer["motion"]["amount"]["values"]) == FRAMES + 1 for layer in recipe["layers"])
    print(json.dumps({"recipe": statistics.median(taken) * 1e3}))


main()
sys.stdout.flush()
os._exit(0)  # Blender as a module can hang at its exit
