"""What becomes of a bake: freed, collected for a farm, or written as a recipe."""

import contextlib
import shutil
from pathlib import Path

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
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


def forget_prepared(scene, picture) -> None:
    """Removes what was prepared for the picture from the cache that all pictures share. Throws OSError."""
    shared, folder = preferences.of(bpy.context).cache(), Path(bpy.app.tempdir)  # any: files are told by what they hold
    if shared is None or not shared.is_dir():
        return
    with contextlib.suppress(ValueError):  # a picture that can't be read: nothing is known to be its own
        engine.forget_layers(engine.parse(job.describe(scene, picture, folder), folder), shared)


class STILLWATER_OT_free_bake(OfPicture, bpy.types.Operator):
    """Delete the picture's frames and what was prepared for them from the disk. This can't be undone"""

    bl_idname = "stillwater.free_bake"
    bl_label = "Free Bake"

    def invoke(self, context, event):
        return context.window_manager.invoke_confirm(self, event)

    def act(self, context, picture):
        if picture.tree is not None and job.running(picture.tree):
            raise ValueError(rpt_("{name}: is being baked; cancel it first").format(name=picture.name))
        gone, folder = frames_of(picture), places.folder_of(picture)
        for path in gone:
            path.unlink()
        if (folder / CACHE).exists():
            shutil.rmtree(folder / CACHE)
        forget_prepared(context.scene, picture)
        for empty in (places.frames_of(picture), folder):
            if empty.is_dir() and not any(empty.iterdir()):
                empty.rmdir()
        if picture.tree is not None:
            state = picture.tree.stillwater
            state.state, state.message, state.warning, state.left, state.share = "none", "", "", "", 0
            tree.show(picture.tree)
        outdated.look(context.scene, picture, play=False)
        sentence = rpt_("1 frame deleted") if len(gone) == 1 else rpt_("{count} frames deleted")
        self.report({"INFO"}, sentence.format(count=len(gone)))
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
            raise ValueError(rpt_("No file is named to write to"))
        return Path(bpy.path.abspath(self.filepath)).absolute()


class STILLWATER_OT_collect(_ToFile, bpy.types.Operator):
    """Its recipe, all files and its frames, for a farm: `python -m stillwater render recipe.json` there does the rest."""

    bl_idname = "stillwater.collect"
    bl_label = "Collect Files"
    bl_description = (
        "Copy the picture's recipe, every file that it needs and its frames into a folder or a zip, for a farm or"
        ' another machine: "python -m stillwater render recipe.json" renders there what is missing'
    )

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
        written = collect.collect(recipe, folder, target, frames_of(picture) if self.frames else [], rpt_)
        self.report({"INFO"}, rpt_("{target}: {count} files collected").format(target=target, count=len(written)))
        return {"FINISHED"}


class STILLWATER_OT_export_recipe(_ToFile, bpy.types.Operator):
    """Write the picture's recipe, which renders to the same frames without Blender"""

    bl_idname = "stillwater.export_recipe"
    bl_label = "Export Recipe"

    filepath: StringProperty(
        name="Recipe", description="File to write the recipe to", subtype="FILE_PATH", options={"SKIP_SAVE"}
    )
    filter_glob: StringProperty(default="*.json", options={"HIDDEN"})
    ending = ".json"

    def act(self, context, picture):
        path = self.path()
        engine.parse(job.describe(context.scene, picture, path.parent), path.parent)
        self.report({"INFO"}, rpt_("Written: {path}").format(path=job.write_recipe(context.scene, picture, path)))
        return {"FINISHED"}


CLASSES = [STILLWATER_OT_free_bake, STILLWATER_OT_collect, STILLWATER_OT_export_recipe]
