"""Makes the .blend that is kept of a version of the properties: one picture, one layer of each kind, keys.

    python tests/blender/files/make.py --zip ZIP --output tests/blender/files/version_N.blend

Runs in a Python that has the bpy package, with the extension's zip of that version: Blender 4.5, so that every later
one reads the file. A file that is kept is never made anew: it is what people have.
"""

import argparse
import os
import shutil
import sys
import tempfile
from pathlib import Path

PICTURE = Path(__file__).with_name("lake.png")


def fill(picture) -> None:
    """A swaying tree before a rippling lake before the rest, in a keyed wind. Nothing is at its default."""
    arrange = sys.modules["bl_ext.user_default.stillwater.properties.arrange"]
    while len(picture.layers):
        arrange.remove_layer(picture, 0)
    for name in ("tree", "lake", "sky"):
        arrange.add_layer(picture, name)
    tree, lake, _ = picture.layers
    tree.matte.form, tree.matte.file = "file", "//lake.png"
    tree.motion.type = "sway"
    tree.motion.sway.armature_root, tree.motion.sway.armature_tip = (4, 7), (5, 1)
    lake.matte.form, lake.matte.labels, lake.matte.value = "labels", "//lake.png", 3
    lake.motion.type, lake.motion.ripple.tile = "ripple", 80
    picture.view.use_horizon, picture.view.horizon_end = True, (16, 3)
    for frame, speed in ((1, 3), (24, 9)):
        picture.wind.speed = speed
        picture.wind.keyframe_insert("speed", frame=frame)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--zip", type=Path, required=True)
    parser.add_argument("--output", type=Path, required=True)
    arguments = parser.parse_args()
    work = Path(tempfile.mkdtemp(prefix="stillwater-"))
    os.environ["BLENDER_USER_RESOURCES"], os.environ["HOME"] = str(work / "profile"), str(work)  # a .blend holds paths
    import bpy

    shutil.copy(PICTURE, work)
    path = work / arguments.output.name

    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    zip_file = str(arguments.zip.resolve())
    bpy.ops.extensions.package_install_files(repo="user_default", filepath=zip_file, enable_on_install=True)
    scene = bpy.context.scene
    bpy.context.preferences.filepaths.save_version = 0
    bpy.ops.wm.save_as_mainfile(filepath=str(path), compress=True)
    if hasattr(bpy.types, "STILLWATER_OT_open_picture"):
        bpy.ops.stillwater.open_picture(filepath=str(work / PICTURE.name))
    else:  # before there was one
        bpy.ops.stillwater.add_picture()
        scene.stillwater.active().picture = f"//{PICTURE.name}"
    scene.stillwater.active().name = "Lake"
    fill(scene.stillwater.active())
    bpy.ops.wm.save_mainfile(compress=True)
    shutil.copy(path, arguments.output)
    sys.stdout.flush()
    os._exit(0)  # Blender 4.5 as a module can hang at its exit


if __name__ == "__main__":
    main()
