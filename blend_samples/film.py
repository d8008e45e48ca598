"""A baked sample in Blender: installs the extension, opens the recipe, saves the .blend, opens it and renders it.

    python film.py -- --zip ZIP --recipe FILE --work FOLDER [--frames A-B]     (a Python that has the bpy package)
    blender --background --python film.py -- ...

FOLDER/frames holds the bake; FOLDER/NAME.blend and FOLDER/film/0001.png, ... are written. The process ends by os._exit:
Blender 4.5 as a module can hang at its exit once it has read an image sequence.
"""

import argparse
import os
import re
import sys
import traceback
from pathlib import Path

import bpy


def install(zip_file: Path) -> None:
    """Installs the extension's zip into the profile that BLENDER_USER_RESOURCES names, and enables it."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.extensions.package_install_files(repo="user_default", filepath=str(zip_file), enable_on_install=True)
    if not hasattr(bpy.types.Scene, "stillwater"):
        raise RuntimeError(f"{zip_file}: Blender {bpy.app.version_string} did not take the extension")


def make_blend(recipe: Path, frames: Path, blend: Path) -> None:
    """Saves a .blend whose compositor shows the frames that were baked from `recipe`."""
    bpy.context.preferences.filepaths.save_version = 0  # no .blend1 beside it
    bpy.ops.wm.save_as_mainfile(filepath=str(blend))  # first, so that the paths in it are relative
    bpy.ops.stillwater.load_recipe(filepath=str(recipe))
    bpy.context.scene.stillwater.active().tree.stillwater.folder = bpy.path.relpath(str(frames))
    bpy.ops.stillwater.refresh()
    bpy.ops.wm.save_as_mainfile(filepath=str(blend))


def render(folder: Path, first: int, last: int) -> None:
    """Renders frames through the scene's compositor to PNG; the progress goes to standard error."""
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob("*.png"):
        old.unlink()
    scene = bpy.context.scene
    scene.view_settings.view_transform = "Standard"
    scene.render.image_settings.file_format = "PNG"
    scene.render.image_settings.color_mode = "RGB"
    scene.render.image_settings.compression = 15
    scene.render.dither_intensity = 0
    for frame in range(first, last + 1):
        scene.frame_set(frame)
        scene.render.filepath = str(folder / f"{frame:04d}.png")
        bpy.ops.render.render(write_still=True)
        print(f"\rrendered frame {frame} ({frame - first + 1} of {last - first + 1})", end="", file=sys.stderr,
              flush=True)
    print(file=sys.stderr)


def main() -> None:
    arguments = argparse.ArgumentParser(description="Renders a baked sample in Blender.")
    arguments.add_argument("--zip", type=Path, required=True)
    arguments.add_argument("--recipe", type=Path, required=True)
    arguments.add_argument("--work", type=Path, required=True)
    arguments.add_argument("--frames", default="")
    given = arguments.parse_args(sys.argv[sys.argv.index("--") + 1 :])
    work = given.work.resolve()
    blend = work / f"{given.recipe.resolve().parent.name}.blend"

    install(given.zip.resolve())
    make_blend(given.recipe.resolve(), work / "frames", blend)
    bpy.ops.wm.open_mainfile(filepath=str(blend))
    scene = bpy.context.scene
    asked = re.fullmatch(r"(\d+)-(\d+)", given.frames)
    first, last = map(int, asked.groups()) if asked else (scene.frame_start, scene.frame_end)
    render(work / "film", first, last)


if __name__ == "__main__":
    code = 0
    try:
        main()
    except BaseException:
        traceback.print_exc()
        code = 1
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)
