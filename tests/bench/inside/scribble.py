"""Runs in Blender, see ../scribble.py: seconds from a scribble to the sketched matte and to the final one."""

import importlib
import json
import os
import statistics
import sys
import tempfile
import time
from pathlib import Path

import bpy

bpy.ops.extensions.package_install_files(repo="user_default", filepath=sys.argv[1], enable_on_install=True)
bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
sys.path.insert(0, str(Path(__file__).parents[2] / "blender"))
import cutting  # noqa: E402
import stage  # noqa: E402
from pixels import PACKAGE  # noqa: E402

SIZE, RUNS = (1280, 720), 5


def main() -> None:
    extension = importlib.import_module(PACKAGE)
    extension.play.show.seen = True
    lifted, interval = extension.play.handlers.LIFTED, extension.play.server.INTERVAL
    sketched, final = [], []
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        picture = cutting.open_picture(bpy.context.scene, Path(folder), SIZE)
        scene = bpy.context.scene
        cutting.scribble(scene, picture)
        stage.wait(extension)
        for i in range(RUNS):
            began = time.perf_counter()
            cutting.lay(scene, picture, picture.layers[0], background=[cutting.across(picture, 1.7 + 0.03 * i)])
            cutting.wait_for_sketch(extension, scene, picture, interval=interval)
            sketched.append(lifted + time.perf_counter() - began)
            stage.wait(extension, 40)
            final.append(lifted + time.perf_counter() - began)
        extension.play.server.end()
    print(json.dumps({"sketch": statistics.median(sketched), "final": statistics.median(final)}))


main()
sys.stdout.flush()
os._exit(0)  # Blender as a module can hang at its exit
