"""What a person prefers, whatever file is open, `preferences.of(context)`, and where what is theirs lies, `user_folder`."""

import os
from pathlib import Path

import bpy
from bpy.app.translations import pgettext_iface as iface_
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import EnumProperty, FloatProperty, IntProperty, StringProperty

from .. import engine

PACKAGE = __package__.rpartition(".")[0]


def of(context):
    """The extension's preferences."""
    return context.preferences.addons[PACKAGE].preferences


def user_folder(name: str) -> Path:
    """A folder of the extension's in the user's folder, which outlives updates; made where it is missing."""
    return Path(bpy.utils.extension_path_user(PACKAGE, path=name, create=True))


def _try_python(self, context) -> None:
    self.python_problem = engine.python_problem(self.python) if self.python else ""


class STILLWATER_AP_preferences(bpy.types.AddonPreferences):
    """Cache, threads, live preview, the worker's Python, renders of a stale bake."""

    bl_idname = PACKAGE

    cache_folder: StringProperty(
        name="Cache Folder", subtype="DIR_PATH",
        description="Where layers that were cut out are kept, for all pictures. Empty: beside each picture's recipe",
    )
    cache_limit: FloatProperty(
        name="Cache Limit", description="The least recently used goes first beyond it [GB]",
        default=4, min=0.1, max=10000, soft_min=1, soft_max=100, precision=1, step=50,
    )
    threads: IntProperty(
        name="Threads", description="How many threads a bake uses; 0 is one for each core",
        default=0, min=0, max=1024, soft_max=64,
    )
    preview_size: IntProperty(
        name="Preview Size", description="Longer side of the picture while it plays live [px]",
        default=960, min=64, max=8192, soft_min=240, soft_max=1920, subtype="PIXEL",
    )
    python: StringProperty(
        name="Python", subtype="FILE_PATH", update=_try_python,
        description="The program that runs bakes. Empty: the Python that Blender itself runs",
    )
    python_problem: StringProperty(options={"HIDDEN", "SKIP_SAVE"})
    stale_render: EnumProperty(
        name="Rendering an Old Bake", default="WARN",
        description="What Render Image and Render Animation do where frames are missing or out of date",
        items=[
            ("WARN", "Warn", "Render what there is, and say what is out of date"),
            ("BAKE", "Bake First", "Bring the frames up to date before rendering"),
            ("NOTHING", "Render As It Is", "Render what there is, and say nothing"),
        ],
    )

    def cache(self) -> Path | None:
        """The folder of the cache; None where each picture has its own, beside its recipe."""
        return Path(os.path.abspath(bpy.path.abspath(self.cache_folder))) if self.cache_folder else None

    def worker_options(self) -> list[str]:
        """How these reach `python -m stillwater`, `render` and `serve`."""
        options = ["--cache-limit", f"{self.cache_limit:.6g}"]
        if cache := self.cache():
            options += ["--cache", str(cache)]
        return [*options, "--threads", str(self.threads)] if self.threads else options

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        column = layout.column()
        column.prop(self, "cache_folder", placeholder=iface_("Beside each picture's recipe"))
        column.prop(self, "cache_limit")
        _to_the_right(column).operator("stillwater.clear_unsaved", icon="TRASH")
        column = layout.column()
        column.prop(self, "threads")
        column.prop(self, "preview_size")
        layout.prop(self, "stale_render")
        column = layout.column()
        column.prop(self, "python", placeholder=iface_("Blender's own"))
        _to_the_right(column).operator("stillwater.try_python", icon="CHECKMARK")
        problem = self.python_problem or engine.problem()
        if problem:
            column.label(text=problem, icon="ERROR")


def _to_the_right(layout):
    row = layout.row()
    row.alignment = "RIGHT"
    return row


class STILLWATER_OT_try_python(bpy.types.Operator):
    """Start the worker's Python and load the engine in it: say whether bakes can run, and if not, why"""

    bl_idname = "stillwater.try_python"
    bl_label = "Try Python"

    def execute(self, context):
        chosen = of(context)
        chosen.python_problem = engine.python_problem(chosen.python)
        if chosen.python_problem:
            self.report({"ERROR"}, chosen.python_problem)
            return {"CANCELLED"}
        self.report({"INFO"}, rpt_("Bakes can run: engine {version}").format(version=engine.version()))
        return {"FINISHED"}


CLASSES = [STILLWATER_AP_preferences, STILLWATER_OT_try_python]


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
