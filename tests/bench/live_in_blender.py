"""Measures live frames of the lake in this process's Blender; prints a line "ms NAME VALUE" for each. Run by live.py.

    python live_in_blender.py ZIP
"""

import importlib
import os
import statistics
import sys
import tempfile
import time
from pathlib import Path

import bpy

PACKAGE = "bl_ext.user_default.stillwater"
LAKE = Path(__file__).resolve().parents[2] / "blend_samples" / "lake" / "recipe.json"
SIZE = (864, 540)  # px: what of it fits into 960 x 540
FRAMES = 40


def opened(extension, folder: str):
    """The lake in a saved file, on a plane, prepared."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    extension.preferences.of(bpy.context).preview_size = SIZE[0]
    bpy.ops.wm.save_as_mainfile(filepath=str(Path(folder, "lake.blend")))
    bpy.ops.stillwater.load_recipe(filepath=str(LAKE))
    scene = bpy.context.scene
    picture = scene.stillwater.pictures[0]
    plane = bpy.data.objects.new("Plane", None)
    plane.empty_display_type = "IMAGE"
    scene.collection.objects.link(plane)
    picture.image = bpy.data.images.load(str(LAKE.parent / "picture.png"))
    picture.plane, picture.picture_size, plane.data = plane, picture.image.size, picture.image
    scene.frame_set(1)
    while extension.play.server.tick() is not None:
        time.sleep(0.05)
    scene.frame_set(2)
    stage = extension.play.show.stage_of(scene, picture)
    if stage.live is None:
        sys.exit(f"the lake is not live: {stage.problem}")
    if stage.live.size != SIZE:
        sys.exit(f"the lake is {stage.live.size}, not {SIZE}")
    return scene, picture, stage


def median(work, frames) -> float:
    taken = []
    for frame in frames:
        start = time.perf_counter()
        work(frame)
        taken.append((time.perf_counter() - start) * 1e3)
    return statistics.median(taken)


def main() -> None:
    bpy.ops.extensions.package_install_files(repo="user_default", filepath=sys.argv[1], enable_on_install=True)
    extension = importlib.import_module(PACKAGE)
    extension.play.show.seen = True
    extension.play.handlers._playing = lambda: True
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        scene, picture, stage = opened(extension, folder)
        frames = range(3, 3 + FRAMES)
        bare = extension.play.handlers.HANDLERS[0][1]
        bpy.app.handlers.frame_change_post.remove(bare)
        without = median(scene.frame_set, frames)
        bpy.app.handlers.frame_change_post.append(bare)
        print("ms all", median(scene.frame_set, frames) - without)
        print("ms engine", median(stage.live.frame, frames))

        def slide(frame):
            picture.wind.speed = frame / 4
            extension.play.show.scene(scene)

        print("ms slider", median(slide, frames), flush=True)
        extension.play.server.end()
    os._exit(0)


if __name__ == "__main__":
    main()
