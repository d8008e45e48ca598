"""What becomes of a bake: freed, collected for a farm, or written as a recipe."""

import contextlib
import shutil
from pathlib import Path

import bpy
from bpy.props import BoolProperty, StringProperty

from .. import engine, preferences
from ..compositor import frames, tree
from . import collect, job, outdated, places
from .operators import OfPicture

CACHE = ".stillwater-cache"


def frames_of(picture) -> list[Path]:
    """The picture's frames on disk: files of its name that we wrote."""
    folder, name = places.frames_of(picture), picture.output.name
    there = [frames.path_of(folder, name, frame) for frame in frames.present(folder, name)]
    return [path for path in there if engine.read_mark(path)[0]]


class STILLWATER_OT_free_bake(OfPicture, bpy.types.Operator):
    """Delete the picture's frames and what was prepared for them from the disk. This can't be undone"""

    bl_idname = "stillwater.free_bake"
    bl_label = "Free Bake"

    def invoke(self, context, event):
        return context.window_manager.invoke_confirm(self, event)

    def act(self, context, picture):
        if picture.tree is not None and job.running(picture.tree):
            raise ValueError(f"{picture.name}: is being baked; cancel it first")
        gone, folder = frames_of(picture), places.folder_of(picture)
        for path in gone:
            path.unlink()
        if (folder / CACHE).exists():
            shutil.rmtree(folder / CACHE)
        if shared := preferences.of(context).cache():
            with contextlib.suppress(ValueError):  # a picture that can't be read: nothing is known to be its own
                engine.forget_layers(engine.parse(job.describe(context.scene, picture, folder), folder), shared)
        for empty in (places.frames_of(picture), folder):
            if empty.is_dir() and not any(empty.iterdir()):
                empty.rmdir()
        if picture.tree is not None:
            state = picture.tree.stillwater
            state.state, state.message, state.warning, state.left, state.share = "none", "", "", "", 0
            tree.show(picture.tree)
        outdated.look(context.scene, picture, play=False)
        self.report({"INFO"}, f"{len(gone)} frame{'' if len(gone) == 1 else 's'} deleted")
        return {"FINISHED"}


class _ToFile(OfPicture):
    """Asks for a file first."""

    def invoke(self, context, event):
        if not self.filepath:
            picture = context.scene.stillwater.active()
            self.filepath = str(Path(bpy.data.filepath).with_name(f"{picture.name}{self.ending}"))
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def path(self) -> Path:
        """Where to write. Throws ValueError where that was not said."""
        if not self.filepath:
            raise ValueError("No file is named to write to")
        return Path(bpy.path.abspath(self.filepath)).absolute()


class STILLWATER_OT_collect(_ToFile, bpy.types.Operator):
    """Copy the picture's recipe, every file that it needs and its frames into a folder or a zip, for a farm or for
    another machine: "python -m stillwater render recipe.json" renders there what is missing"""

    bl_idname = "stillwater.collect"
    bl_label = "Collect Files"

    filepath: StringProperty(
        name="Folder or Zip", description="Becomes a zip where it ends with .zip, else a new folder",
        subtype="FILE_PATH", options={"SKIP_SAVE"},
    )
    frames: BoolProperty(name="Frames", description="Take along what is baked already", default=True)
    ending = ".zip"

    def act(self, context, picture):
        target, folder = self.path(), places.folder_of(picture)
        recipe = job.describe(context.scene, picture, folder)
        engine.parse(recipe, folder)  # what is wrong is said here, not on the farm
        written = collect.collect(recipe, folder, target, frames_of(picture) if self.frames else [])
        self.report({"INFO"}, f"{target}: {len(written)} files collected")
        return {"FINISHED"}


class STILLWATER_OT_export_recipe(_ToFile, bpy.types.Operator):
    """Write the picture's recipe, which renders to the same frames without Blender"""

    bl_idname = "stillwater.export_recipe"
    bl_label = "Export Recipe"

    filepath: StringProperty(name="Recipe", subtype="FILE_PATH", options={"SKIP_SAVE"})
    filter_glob: StringProperty(default="*.json", options={"HIDDEN"})
    ending = ".json"

    def act(self, context, picture):
        path = self.path()
        engine.parse(job.describe(context.scene, picture, path.parent), path.parent)
        self.report({"INFO"}, f"Written: {job.write_recipe(context.scene, picture, path)}")
        return {"FINISHED"}


CLASSES = [STILLWATER_OT_free_bake, STILLWATER_OT_collect, STILLWATER_OT_export_recipe]
